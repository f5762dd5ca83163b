//! What the sections of a rod or of a beam add to their line, seen alike: through the coordinates of a beam, of which a rod has fewer.
//! A rod's section rotates about the tangent alone; its first component of spins, moments and internal coordinates is all that there is.
//!
//! Source: J. C. Simo, L. Vu-Quoc, On the dynamics in space of rods undergoing large motions, Comput. Methods Appl. Mech. Eng. 66 (1988)
//! 125-161 (rotary inertia of sections along their own axes).

use nalgebra::Matrix3;

use super::beam::planar::{self, Planar};
use super::beam::{self, At, Beam, Force, Rates};
use super::rod::{self, Rod};
use crate::math::lanes::Real;
use crate::math::quadrature::{GAUSS_5, QuadraturePoint};

/// Inertia of an element against spins at its ends and the rates of its internal coordinates between them, kg m^2, in the order first end,
/// inside, last end: blocks over the three components, of rods the first alone.
pub type SpinInertia = [[[[f64; 3]; 3]; 3]; 3];

/// Integrates the inertia of an element of this length (m) from the rotary inertia of its sections, kg m. Spins about
/// the line are interpolated like the twist of a rod. Rotations of sections across the line are summed at the ends by
/// the trapezoidal rule. Between the ends a section rotates with the line, and the internal shear rotations are only a
/// part of that. Interpolation with them has a much larger error (docs/decisions/0050-beams-lean-on-rods.md).
pub fn spin_inertia(length: f64, section: impl Fn(f64) -> Matrix3<f64>) -> SpinInertia {
    let mut inertia = SpinInertia::default();
    for QuadraturePoint { at, weight } in GAUSS_5 {
        let shapes = [1.0 - at, 4.0 * at * (1.0 - at), at];
        let here = section(at) * (weight * length);
        for (row, a) in inertia.iter_mut().zip(shapes) {
            for (block, b) in row.iter_mut().zip(shapes) {
                block[0][0] += a * b * here[(0, 0)];
            }
        }
        let at_places = [shapes[0], shapes[1] * shapes[1], shapes[2]];
        for (k, part) in at_places.into_iter().enumerate() {
            for (r, c) in (1..3).flat_map(|r| (1..3).map(move |c| (r, c))) {
                inertia[k][k][r][c] += part * here[(r, c)];
            }
        }
    }
    inertia
}

/// Integrates the inertia of a planar beam of this length (m) from the rotary inertia of its sections, kg m. The three
/// sections whose directions are coordinates share it by Simpson's rule, with errors of order 4.
pub fn planar_inertia(length: f64, section: impl Fn(f64) -> f64) -> SpinInertia {
    let mut inertia = SpinInertia::default();
    for (k, (at, weight)) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)].into_iter().enumerate() {
        inertia[k][k][1][1] = section(at) * weight * length / 6.0;
    }
    inertia
}

/// An element of a rod or of a beam.
#[derive(Clone, Debug)]
pub enum SectionElement {
    /// Bending and torsion.
    Rod(Box<Rod>),
    /// Stretching, shear, bending and torsion.
    Beam(Box<Beam>),
    /// Stretching, shear and bending in the plane.
    Planar(Box<Planar>),
}

/// Elements that are computed in lanes.
#[derive(Clone, Debug)]
pub enum SectionPack {
    /// Elements of rods.
    Rod(Box<rod::Pack>),
    /// Elements of beams.
    Beam(Box<beam::Pack>),
    /// Elements of planar beams.
    Planar(Box<planar::Pack>),
}

/// A rod's view of coordinates.
#[inline(always)]
pub fn rod_at<N: Copy>(at: &At<N>) -> rod::At<N> {
    rod::At {
        e: at.e,
        d: [at.axes[0][1], at.axes[1][1]],
        bubble: at.inner[0],
    }
}

/// A rod's view of rates.
#[inline(always)]
pub fn rod_rates<N: Copy>(rates: &Rates<N>) -> rod::Rates<N> {
    rod::Rates {
        e: rates.e,
        spin: [rates.spin[0][0], rates.spin[1][0]],
        bubble: rates.inner[0],
    }
}

/// A rod's force in the places of a beam's.
#[inline(always)]
fn of_rod<N: Real>(force: rod::Force<N>) -> Force<N> {
    let zero = force.bubble.constant(0.0);
    Force {
        e: force.e,
        moment: force.torque.map(|torque| [torque, zero, zero]),
        inner: [force.bubble, zero, zero],
    }
}

/// Vectors at the points of [`GAUSS_5`].
pub type Vectors<N> = [[N; 3]; GAUSS_5.len()];

impl SectionElement {
    /// Spins of a section, and numbers inside an element: 1 of a rod, 3 of a beam, 1 of one in the plane.
    pub fn rotations(&self) -> usize {
        match self {
            Self::Rod(_) => 1,
            Self::Beam(_) => 3,
            Self::Planar(_) => 1,
        }
    }

    /// Whether it dissipates.
    pub fn is_damped(&self) -> bool {
        match self {
            Self::Rod(rod) => rod.is_damped(),
            Self::Beam(beam) => beam.is_damped(),
            Self::Planar(beam) => beam.is_damped(),
        }
    }

    /// Strain energy, J.
    pub fn energy<N: Real>(&self, at: &At<N>) -> N {
        match self {
            Self::Rod(rod) => rod.energy(&rod_at(at)),
            Self::Beam(beam) => beam.energy(at),
            Self::Planar(beam) => beam.energy(at),
        }
    }

    /// Elastic force and, with rates, that of damping; and the power that damping takes out, W.
    pub fn force<N: Real>(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        match self {
            Self::Rod(rod) => {
                let (force, power) = rod.force(&rod_at(at), rates.map(rod_rates).as_ref());
                (of_rod(force), power)
            }
            Self::Beam(beam) => beam.force(at, rates),
            Self::Planar(beam) => beam.force(at, rates),
        }
    }

    /// Vectors along the axes of the sections at five Gauss points, in global components; in the plane those across it stay.
    pub fn outward<N: Real>(&self, at: &At<N>, vectors: &Vectors<N>) -> Vectors<N> {
        match self {
            Self::Rod(rod) => rod.outward(&rod_at(at), vectors),
            Self::Beam(beam) => beam.outward(at, vectors),
            Self::Planar(_) => *vectors,
        }
    }

    /// Returns the force of distributed moments on the coordinates of the element. `moments` holds global components
    /// per reference length at five Gauss points, N m/m. Their power is the integral of the products with the angular
    /// velocities of the sections.
    pub fn loaded<N: Real>(&self, at: &At<N>, moments: &Vectors<N>) -> Force<N> {
        match self {
            Self::Rod(rod) => of_rod(rod.loaded(&rod_at(at), moments)),
            Self::Beam(beam) => beam.loaded(at, moments),
            Self::Planar(beam) => beam.loaded(at, moments),
        }
    }

    /// The larger of the angles between the tangents at the ends and that at the middle, and the size of the twist, rad.
    pub fn angles(&self, at: &At<f64>) -> [f64; 2] {
        match self {
            Self::Rod(rod) => rod.angles(&rod_at(at)),
            Self::Beam(beam) => beam.angles(at),
            Self::Planar(beam) => beam.angles(at),
        }
    }

    /// Whether this element and another can be in one pack.
    pub fn goes_with(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rod(a), Self::Rod(b)) => a.goes_with(b),
            (Self::Beam(a), Self::Beam(b)) => a.goes_with(b),
            (Self::Planar(a), Self::Planar(b)) => a.goes_with(b),
            _ => false,
        }
    }

    /// Elements that go together, up to [`PACK`](crate::math::lanes::PACK).
    pub fn pack(elements: &[&Self]) -> SectionPack {
        // What goes together is of one kind.
        let (mut rods, mut beams, mut planar) = (Vec::new(), Vec::new(), Vec::new());
        for element in elements {
            match element {
                Self::Rod(rod) => rods.push((**rod).clone()),
                Self::Beam(beam) => beams.push((**beam).clone()),
                Self::Planar(beam) => planar.push((**beam).clone()),
            }
        }
        if !rods.is_empty() {
            return SectionPack::Rod(Box::new(Rod::pack(&rods)));
        }
        if !planar.is_empty() {
            return SectionPack::Planar(Box::new(Planar::pack(&planar)));
        }
        SectionPack::Beam(Box::new(Beam::pack(&beams)))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    /// An element that is bent, twisted and, of a beam, sheared, with axes that are orthonormal.
    fn bent(has_shear: bool) -> At<f64> {
        let e = [
            [0.1, -0.2, 0.3],
            [1.1, 0.3, -0.2],
            [0.9, 0.2, 0.1],
            [0.8, 0.7, 0.4],
        ];
        let normals = [[0.2, -0.1, 0.3], [-0.1, 0.2, 0.25]].map(Vector3::from);
        let thirds = [[0.1, 0.2, 1.0], [0.5, -0.3, 1.0]].map(Vector3::from);
        let axes = [0, 1].map(|end| {
            let tangent = Vector3::from(e[2 * end + 1]).normalize();
            let shear_rotation = if has_shear {
                normals[end]
            } else {
                Vector3::zeros()
            };
            let first = (tangent + shear_rotation).normalize();
            let second = thirds[end].cross(&first).normalize();
            [first, second, first.cross(&second)].map(Into::into)
        });
        let inner = if has_shear {
            [0.2, 0.1, -0.15]
        } else {
            [0.2, 0.0, 0.0]
        };
        At { e, axes, inner }
    }

    /// Moves an element for a short time at given rates.
    fn moved(at: &At<f64>, rates: &Rates<f64>, time: f64, has_shear: bool) -> At<f64> {
        let vector = |x: &[f64; 3], v: &[f64; 3]| Vector3::from(*x) + Vector3::from(*v) * time;
        let e: [[f64; 3]; 4] = std::array::from_fn(|k| vector(&at.e[k], &rates.e[k]).into());
        let axes = [0, 1].map(|end| {
            let axes = at.axes[end].map(Vector3::from);
            let [u, du] = [at.e[2 * end + 1], rates.e[2 * end + 1]].map(Vector3::from);
            let spin = rates.spin[end];
            let velocity = if has_shear {
                axes[0] * spin[0] + axes[1] * spin[1] + axes[2] * spin[2]
            } else {
                u.cross(&du) / u.norm_squared() + axes[0] * spin[0]
            };
            let turn = nalgebra::Rotation3::new(velocity * time);
            let [mut first, second, _] = axes.map(|axis| turn * axis);
            if !has_shear {
                first = Vector3::from(e[2 * end + 1]).normalize();
            }
            let second = (second - first * first.dot(&second)).normalize();
            [first, second, first.cross(&second)].map(Into::into)
        });
        let inner = vector(&at.inner, &rates.inner).into();
        At { e, axes, inner }
    }

    fn elements() -> [(SectionElement, bool); 2] {
        let (length, one) = (0.9, Matrix3::<f64>::identity());
        let rod = rod::Parameters {
            length,
            stiffness: [one.into(); 3],
            damping_times: [0.0; 3],
            axial: None,
        };
        let beam = beam::Parameters {
            length,
            stiffness: [nalgebra::Matrix6::identity().into(); 3],
            damping_times: [0.0; 6],
        };
        let rod = Rod::new(rod, &rod_at(&bent(false)));
        let beam = Beam::new(beam, &bent(true));
        [
            (SectionElement::Rod(Box::new(rod)), false),
            (SectionElement::Beam(Box::new(beam)), true),
        ]
    }

    /// The power of moments along an element is that with the angular velocities with which its sections are seen to rotate.
    #[test]
    fn moments_do_work_where_sections_turn() {
        let moments = [
            [0.3, -0.8, 0.5],
            [-0.2, 0.9, 0.1],
            [0.7, 0.4, -0.6],
            [0.2, 0.2, 0.9],
            [-0.5, 0.6, 0.3],
        ];
        for (section, has_shear) in elements() {
            let inside = if has_shear {
                [0.7, -0.4, 0.3]
            } else {
                [0.7, 0.0, 0.0]
            };
            let spin = |of: [f64; 3]| if has_shear { of } else { [of[0], 0.0, 0.0] };
            let rates = Rates {
                e: [
                    [0.2, 0.5, -0.3],
                    [0.4, -0.6, 0.8],
                    [-0.7, 0.1, 0.6],
                    [0.3, 0.9, -0.5],
                ],
                spin: [spin([0.8, -0.3, 0.4]), spin([-0.6, 0.5, 0.9])],
                inner: inside,
            };
            let at = bent(has_shear);
            let force = section.loaded(&at, &moments);
            let sum = |a: &[[f64; 3]], b: &[[f64; 3]]| -> f64 {
                let pairs = a.as_flattened().iter().zip(b.as_flattened());
                pairs.map(|(a, b)| a * b).sum()
            };
            let power = sum(&force.e, &rates.e)
                + sum(&force.moment, &rates.spin)
                + sum(&[force.inner], &[rates.inner]);
            let h = 1e-5;
            let [before, after] = [-h, h].map(|time| moved(&at, &rates, time, has_shear));
            let mut wanted = 0.0;
            for (k, point) in GAUSS_5.iter().enumerate() {
                let mut velocity = Vector3::zeros();
                for axis in 0..3 {
                    let mut unit = [[0.0; 3]; 5];
                    unit[k][axis] = 1.0;
                    let [a, now, b] = [&before, &at, &after]
                        .map(|at| Vector3::from(section.outward(at, &unit)[k]));
                    assert!((now.norm() - 1.0).abs() < 1e-14);
                    velocity += now.cross(&(b - a)) * (0.25 / h);
                }
                wanted += 0.9 * point.weight * velocity.dot(&Vector3::from(moments[k]));
            }
            assert!((power - wanted).abs() < 1e-8, "{power} {wanted}");
        }
    }
}
