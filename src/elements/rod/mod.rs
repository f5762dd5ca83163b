//! A rod in space: bending about two axes of the section and torsion, of one element. Stretching, mass and weight are those of the
//! cable element without bending stiffness on the same line.
//!
//! Source: M. Bergou, M. Wardetzky, S. Robinson, B. Audoly, E. Grinspun, Discrete elastic rods, ACM Trans. Graph. 27 (2008)
//! (parallel transport and its variation); C. Meier, A. Popp, W. A. Wall, Geometrically exact finite element formulations for
//! slender beams, Arch. Comput. Methods Eng. 26 (2019), doi 10.1007/s11831-017-9232-5 (shear-free rods on Hermite lines, frames
//! by the smallest rotation); J. Gerstmayr, H. Irschik, J. Sound Vib. 318 (2008) (curvature by reference length).
//!
//! At both ends there are position `r`, slope `u = dr/ds`, and a unit vector `d` of the section across `u`; `t = u / |u|`. The
//! line is cubic; at a point of it `u = r'` and `w = r''`. The smallest rotation that takes the unit vector `a` to `b` takes what
//! is across `a` by
//!
//! ```text
//! carry(a, b, v) = v - (b . v) / (1 + a . b) (a + b)
//! spin about b = spin about a - h(a, b) . (da + db),   h(a, b) = a x b / (1 + a . b)                        (1)
//! ```
//!
//! With `z` the unit tangent at the middle, `D = carry(t, z, d)` of both ends, and the twist `Phi` the angle from the first to
//! the last about `z`, the section at `xi` in [0, 1] is rotated by `phi = Phi xi + 4 xi (1 - xi) beta`, with `beta` the internal
//! twist of the element: `d1 = carry(z, t, cos(phi) D_A + sin(phi) z x D_A)`, `d2 = t x d1`. Strains are
//!
//! ```text
//! kappa = u x w / (u . u),   K1 = kappa . d1,   K2 = kappa . d2
//! twist = Phi / l + 4 (1 - 2 xi) beta / l - (z . kappa) / (1 + z . t)                                       (2)
//! ```
//!
//! and the energy `1/2 l sum w (s - s0)^T C (s - s0)` over three Gauss points, with the strains `s0` of the unstressed shape. It
//! is the same seen from both ends (`beta` changes its sign) and from all frames, and of order 4 in the length. Where stretching is
//! coupled with twist or bending (an elastic centre off the line, a rope of wires) it belongs to the same energy, and `C` to four
//! strains: the first is the parabola through `|u|` at both ends and in the middle, less 1.
//!
//! Velocities are those of `e`, the angular velocity about the tangent at both ends, and the rate of `beta`; `d` follows by
//! `d' = spin t x d - (d . u') u / (u . u)`. Forces are the factors of these in the power.

pub(in crate::elements) mod geometry;
pub(in crate::elements) mod kernel;
pub(in crate::elements) mod loaded;
mod quadratic;
mod second;
#[cfg(test)]
mod statics;
pub(in crate::elements) mod stretch;
pub(in crate::elements) mod tangent;
#[cfg(test)]
pub(crate) mod tests;
pub(in crate::elements) mod vectors;

use crate::elements::ElementMotion;
use crate::elements::constitutive::Law;
use crate::elements::line::{dot, sample, times};
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::QuadraturePoint;
use geometry::{Geometry, POINTS};
use kernel::Kernel;
use stretch::{Axial, Coupled};
use vectors::{cross, plus, unit};

/// Velocities of an element: `r`, `u`, spin of the first end, the same of the last, internal twist.
pub const VELOCITIES: usize = 15;

/// A matrix over the velocities of an element in the order `r_A, u_A, spin_A, r_B, u_B, spin_B, beta`.
pub type Matrix<N = f64> = [[N; VELOCITIES]; VELOCITIES];

/// Parameters of a rod's bending and torsion. Components of strain are in the order twist, bending about `d`, bending about
/// `t x d`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Reference length, m.
    pub length: f64,
    /// Symmetric positive matrices of torque and moments by twist and curvatures at the three Gauss points, N m^2.
    pub stiffness: [[[f64; 3]; 3]; 3],
    /// Kelvin-Voigt damping times `T` of the components, s: stress is `C (s - s0) + T^1/2 C T^1/2 s'`.
    pub damping_times: [f64; 3],
    /// Stretching, where it is coupled with twist or bending: the line then has none of its own.
    pub axial: Option<Stretch>,
}

/// Stretching that is coupled with twist or bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Axial force by stretch at the three Gauss points, N.
    pub stiffness: [f64; 3],
    /// Axial force by twist and curvatures there, and torque and moments by stretch, N m.
    pub coupling: [[f64; 3]; 3],
    /// Damping time of stretching, s.
    pub damping_time: f64,
}

/// Where an element is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<N> {
    /// Position (m) and slope at the first end, position and slope at the last.
    pub e: [[N; 3]; 4],
    /// Unit vector of the section across the slope at both ends.
    pub d: [[N; 3]; 2],
    /// Internal twist, rad.
    pub bubble: N,
}

/// Velocities of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates<N> {
    /// Rates of positions (m/s) and slopes (1/s).
    pub e: [[N; 3]; 4],
    /// Angular velocity about the tangent at both ends, rad/s.
    pub spin: [N; 2],
    /// Rate of the internal twist, rad/s.
    pub bubble: N,
}

/// Forces on an element: their power is the sum of products with [`Rates`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force<N> {
    /// On positions (N) and slopes (N m).
    pub e: [[N; 3]; 4],
    /// Torque about the tangent at both ends, N m.
    pub torque: [N; 2],
    /// On the internal twist, N m.
    pub bubble: N,
}

/// Which derivative of the force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tangent {
    /// Minus that along displacements (`d` rotated as by [`At::section_rate`]).
    Stiffness,
    /// Minus that by velocities.
    Damping,
}

/// Bending and torsion of an element of a rod.
#[derive(Clone, Debug)]
pub struct Rod {
    kernel: Kernel<f64>,
}

/// Up to [`PACK`] rods.
#[derive(Clone, Debug)]
pub struct Pack {
    kernel: Kernel<[f64; PACK]>,
    count: usize,
}

/// Numbers of the points.
const POINT: [usize; 3] = [0, 1, 2];

/// Strain times length, by the size of numbers that it comes from, below which an unstressed shape counts as straight or
/// untwisted.
pub(in crate::elements) const ROUNDOFF: f64 = 1e-14;

impl Rod {
    /// A rod whose unstressed shape is this one; its internal twist does not count. Strains that are roundoff are none.
    pub fn new(parameters: Parameters, shape: &At<f64>) -> Self {
        let (l, times) = (parameters.length, parameters.damping_times);
        let mut kernel = Kernel {
            geometry: Geometry {
                length: l,
                inverse_length: 1.0 / l,
                is_round: false,
            },
            law: Law::new(parameters.stiffness, times),
            axial: parameters.axial.map(|axial| axial.damped_with(times)),
        };
        let is_damped = |axial: Stretch| axial.damping_time > 0.0;
        kernel.law.is_damped |= parameters.axial.is_some_and(is_damped);
        let shape = At {
            bubble: 0.0,
            ..*shape
        };
        let components = shape.e.as_flattened();
        let far = components.iter().fold(l, |far, x| far.max(x.abs()));
        let strains = POINT.map(|k| kernel.strains(&shape, &POINTS[k]));
        kernel.law.unstressed_at(strains, [l * l; 3], far);
        for (index, point) in POINTS.iter().enumerate() {
            if let Some(axial) = &mut kernel.axial {
                let stretch = kernel.geometry.stretch(&shape, point);
                axial.offset[index] = -stretch;
                if (stretch - 1.0).abs() * l <= ROUNDOFF * far {
                    axial.offset[index] = -1.0;
                }
            }
        }
        kernel.geometry.is_round = is_round(&kernel);
        Self { kernel }
    }

    /// Whether the element dissipates.
    pub fn is_damped(&self) -> bool {
        self.kernel.law.is_damped
    }

    /// Strain energy, J.
    pub fn energy<N: Real>(&self, at: &At<N>) -> N {
        self.kernel.lift(at.bubble).energy(at)
    }

    /// Elastic force and, with rates, that of damping; and the power that damping takes out, W.
    pub fn force<N: Real>(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        self.kernel.lift(at.bubble).force(at, rates)
    }

    /// Strains at `xi` in [0, 1], those of the unstressed shape included, 1/m.
    pub fn strains<N: Real>(&self, at: &At<N>, xi: f64) -> [N; 3] {
        let point = sample(QuadraturePoint {
            at: xi,
            weight: 0.0,
        });
        self.material().lift(at.bubble).strains(at, &point)
    }

    /// The larger of the angles between the tangents at the ends and that at the middle, and the size of the twist, rad. Frames hold
    /// while the first is less than a right angle and the second less than half a turn; a mesh with more than 1 is coarse.
    pub fn angles(&self, at: &At<f64>) -> [f64; 2] {
        self.kernel.geometry.angles(&at.e, &at.d)
    }

    /// Tangent stiffness, the derivative of minus the force along velocities, symmetric: the second derivatives of the energy
    /// where `d` is rotated about the tangent after the smallest rotation with it. With rates its symmetric part
    /// that matters: the stresses that damping adds are taken as given.
    pub fn stiffness(&self, at: &At<f64>, rates: Option<&Rates<f64>>) -> Matrix {
        self.kernel.tangent(at, rates, Tangent::Stiffness)
    }

    /// Damping matrix, the derivative of minus the force by velocities, symmetric.
    pub fn damping(&self, at: &At<f64>) -> Matrix {
        self.kernel.tangent(at, None, Tangent::Damping)
    }

    /// The formulas with sections as they are rotated: round ones do not notice.
    fn material(&self) -> Kernel<f64> {
        let mut kernel = self.kernel.clone();
        kernel.geometry.is_round = false;
        kernel
    }

    /// Whether this element and another can be in one pack.
    pub fn goes_with(&self, other: &Self) -> bool {
        let kind = |k: &Kernel<f64>| (k.geometry.is_round, k.law.is_damped, k.axial.is_some());
        kind(&self.kernel) == kind(&other.kernel)
    }

    /// Up to [`PACK`] elements, for [`Self::pack_force`]; entries beyond the number of elements do not count.
    pub fn pack(elements: &[Self]) -> Pack {
        let last = elements.len() - 1;
        let lanes = |of: &dyn Fn(&Kernel<f64>) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(&elements[lane.min(last)].kernel))
        };
        let laws: Vec<_> = elements.iter().map(|rod| &rod.kernel.law).collect();
        let first = &elements[0].kernel;
        let kernel = Kernel {
            geometry: Geometry {
                length: lanes(&|k| k.geometry.length),
                inverse_length: lanes(&|k| k.geometry.inverse_length),
                is_round: first.geometry.is_round,
            },
            law: Law::pack(&laws),
            axial: Axial::pack(elements.iter().map(|rod| &rod.kernel.axial)),
        };
        Pack {
            kernel,
            count: elements.len(),
        }
    }

    /// [`Self::force`] of a pack, with rates where it is damped, and the power that damping takes out of all its elements, W.
    #[inline(always)]
    pub fn pack_force<S: Simd>(
        simd: S,
        pack: &Pack,
        motion: ElementMotion<&At<&[f64; PACK]>, &Rates<&[f64; PACK]>>,
        out: &mut Force<[f64; PACK]>,
    ) -> f64 {
        let mut powers = [0.0; PACK];
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group);
            let at = motion.at.group(simd, group);
            let rates = of_rate!(motion.rates, rates => rates.group(simd, group));
            let (force, power) = kernel.force(&at, rates.as_ref());
            for k in 0..4 {
                for d in 0..3 {
                    force.e[k][d].write(&mut out.e[k][d], group);
                }
            }
            for k in 0..2 {
                force.torque[k].write(&mut out.torque[k], group);
            }
            force.bubble.write(&mut out.bubble, group);
            if rates.is_some() {
                power.write(&mut powers, group);
            }
        }
        powers[..pack.count].iter().sum()
    }

    /// [`Self::stiffness`], with rates where it is damped, or [`Self::damping`] of a pack: rows with columns up to the
    /// diagonal.
    #[inline(always)]
    pub fn pack_tangent<S: Simd>(
        simd: S,
        pack: &Pack,
        motion: ElementMotion<&At<&[f64; PACK]>, &Rates<&[f64; PACK]>>,
        kind: Tangent,
        out: &mut Matrix<[f64; PACK]>,
    ) {
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group);
            let at = motion.at.group(simd, group);
            let rates = of_rate!(motion.rates, rates => rates.group(simd, group));
            let matrix = kernel.tangent(&at, rates.as_ref(), kind);
            for r in 0..VELOCITIES {
                for c in 0..=r {
                    matrix[r][c].write(&mut out[r][c], group);
                }
            }
        }
    }
}

impl Pack {
    /// Number of groups of as many elements as there are lanes.
    #[inline(always)]
    fn groups<S: Simd>(&self) -> usize {
        self.count.div_ceil(S::F64_LANES)
    }
}

impl At<&[f64; PACK]> {
    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: usize) -> At<Lanes<S>> {
        At {
            e: read(simd, &self.e, group),
            d: read(simd, &self.d, group),
            bubble: Lanes::read(simd, self.bubble, group),
        }
    }
}

impl Rates<&[f64; PACK]> {
    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: usize) -> Rates<Lanes<S>> {
        Rates {
            e: read(simd, &self.e, group),
            spin: [
                Lanes::read(simd, self.spin[0], group),
                Lanes::read(simd, self.spin[1], group),
            ],
            bubble: Lanes::read(simd, self.bubble, group),
        }
    }
}

#[inline(always)]
pub(in crate::elements) fn read<S: Simd, const K: usize>(
    simd: S,
    pack: &[[&[f64; PACK]; 3]; K],
    group: usize,
) -> [[Lanes<S>; 3]; K] {
    let mut vectors = [[Lanes::read(simd, pack[0][0], group); 3]; K];
    for k in 0..K {
        for d in 0..3 {
            vectors[k][d] = Lanes::read(simd, pack[k][d], group);
        }
    }
    vectors
}

/// Whether the stresses do not notice a rotation of the sections about the tangent.
fn is_round(kernel: &Kernel<f64>) -> bool {
    let straight = kernel
        .law
        .offset
        .iter()
        .all(|offset| offset[1..] == [0.0; 2]);
    let turns = |m: &[[f64; 3]; 3]| {
        let coupled = [m[0][1], m[0][2], m[1][2]];
        coupled == [0.0; 3] && m[1][1] == m[2][2]
    };
    let mut all = kernel.law.stiffness.iter().chain(&kernel.law.damping);
    let bends = |of: &Coupled<f64>| of.with.iter().any(|with| with[1..] != [0.0; 2]);
    let pulls = |axial: &Axial<f64>| bends(&axial.stiffness) || bends(&axial.damping);
    straight && all.all(turns) && !kernel.axial.as_ref().is_some_and(pulls)
}

impl<N: Real> At<N> {
    /// Rate of `d` of an end, 1/s.
    #[inline(always)]
    pub fn section_rate(&self, rates: &Rates<N>, end: usize) -> [N; 3] {
        let (u, d) = (&self.e[2 * end + 1], &self.d[end]);
        let (t, inverse) = unit(u);
        let back = dot(d, &rates.e[2 * end + 1]) * inverse;
        plus(&t, -back, &times(&cross(&t, d), rates.spin[end]))
    }
}

impl<N: Copy> Force<N> {
    /// In the order of [`Matrix`].
    pub fn flat(&self) -> [N; VELOCITIES] {
        let [ra, ua, rb, ub] = self.e;
        let ([p, q], b) = (self.torque, self.bubble);
        [
            ra[0], ra[1], ra[2], ua[0], ua[1], ua[2], p, rb[0], rb[1], rb[2], ub[0], ub[1], ub[2],
            q, b,
        ]
    }
}
