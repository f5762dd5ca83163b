//! What the sections of a rod or of a beam add to their line, seen alike: through the coordinates of a beam, of which a rod has fewer.
//! A rod's section turns about the tangent alone; its first component of spins, moments and internal coordinates is all that there is.

use nalgebra::Matrix3;

use super::beam::{self, At, Beam, Force, Rates};
use super::rod::{self, Rod};
use crate::math::lanes::Real;
use crate::math::quadrature::{GAUSS_5, Point};

/// Inertia of an element against spins at its ends and the rates of its internal coordinates between them, kg m^2, in the order first end,
/// inside, last end: blocks over the three components, of rods the first alone.
pub type SpinInertia = [[[[f64; 3]; 3]; 3]; 3];

/// The same of an element of this length (m) from the rotary inertia of its sections along it, kg m: spins are interpolated as the twist of
/// a rod is.
pub fn spin_inertia(length: f64, section: impl Fn(f64) -> Matrix3<f64>) -> SpinInertia {
    let mut inertia = SpinInertia::default();
    for Point { at, weight } in GAUSS_5 {
        let shapes = [1.0 - at, 4.0 * at * (1.0 - at), at];
        let here = section(at) * (weight * length);
        for (row, a) in inertia.iter_mut().zip(shapes) {
            for (block, b) in row.iter_mut().zip(shapes) {
                for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
                    block[r][c] += a * b * here[(r, c)];
                }
            }
        }
    }
    inertia
}

/// An element of a rod or of a beam.
#[derive(Clone, Debug)]
pub enum Section {
    /// Bending and torsion.
    Rod(Box<Rod>),
    /// Stretching, shear, bending and torsion.
    Beam(Box<Beam>),
}

/// Elements that are computed in lanes.
#[derive(Clone, Debug)]
pub enum SectionPack {
    /// Of rods.
    Rod(Box<rod::Pack>),
    /// Of beams.
    Beam(Box<beam::Pack>),
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

impl Section {
    /// Spins of a section, and numbers inside an element: 1 of a rod, 3 of a beam.
    pub fn turns(&self) -> usize {
        match self {
            Self::Rod(_) => 1,
            Self::Beam(_) => 3,
        }
    }

    /// Whether it dissipates.
    pub fn is_damped(&self) -> bool {
        match self {
            Self::Rod(rod) => rod.is_damped(),
            Self::Beam(beam) => beam.is_damped(),
        }
    }

    /// Whether it holds the line's stretching too.
    pub fn stretches(&self) -> bool {
        matches!(self, Self::Beam(_))
    }

    /// Strain energy, J.
    pub fn energy<N: Real>(&self, at: &At<N>) -> N {
        match self {
            Self::Rod(rod) => rod.energy(&rod_at(at)),
            Self::Beam(beam) => beam.energy(at),
        }
    }

    /// Elastic force and, with rates, that of damping; and the power that damping takes out, W.
    pub fn force<N: Real>(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        match self {
            Self::Rod(rod) => {
                let zero = at.inner[0].constant(0.0);
                let (force, power) = rod.force(&rod_at(at), rates.map(rod_rates).as_ref());
                let force = Force {
                    e: force.e,
                    moment: force.torque.map(|torque| [torque, zero, zero]),
                    inner: [force.bubble, zero, zero],
                };
                (force, power)
            }
            Self::Beam(beam) => beam.force(at, rates),
        }
    }

    /// The larger of the angles between the tangents at the ends and that at the middle, and the size of the twist, rad.
    pub fn angles(&self, at: &At<f64>) -> [f64; 2] {
        match self {
            Self::Rod(rod) => rod.angles(&rod_at(at)),
            Self::Beam(beam) => beam.angles(at),
        }
    }

    /// Whether this element and another can be in one pack.
    pub fn goes_with(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rod(a), Self::Rod(b)) => a.goes_with(b),
            (Self::Beam(a), Self::Beam(b)) => a.goes_with(b),
            _ => false,
        }
    }

    /// Elements that go together, up to [`PACK`](crate::math::lanes::PACK).
    pub fn pack(elements: &[&Self]) -> SectionPack {
        let rods = elements.iter().filter_map(|element| match element {
            Self::Rod(rod) => Some((**rod).clone()),
            Self::Beam(_) => None,
        });
        let rods: Vec<Rod> = rods.collect();
        if !rods.is_empty() {
            return SectionPack::Rod(Box::new(Rod::pack(&rods)));
        }
        let beams = elements.iter().filter_map(|element| match element {
            Self::Beam(beam) => Some((**beam).clone()),
            Self::Rod(_) => None,
        });
        let beams: Vec<Beam> = beams.collect();
        SectionPack::Beam(Box::new(Beam::pack(&beams)))
    }
}
