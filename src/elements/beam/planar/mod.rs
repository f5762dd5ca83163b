//! A beam in the plane: stretching, shear and bending of one element, coupled by one 3 x 3 matrix; the beam of space that moves in a plane.
//!
//! Source: E. Reissner, On one-dimensional finite-strain beam theory: the plane problem, J. Appl. Math. Phys. 23 (1972) 795-804 (strains);
//! R. Echter, B. Oesterle, M. Bischoff, Comput. Methods Appl. Mech. Eng. 254 (2013) (shear as a correction of a shear-free line, which does
//! not lock).
//!
//! There are three places: the first end, the middle and the last end. At each the line has its slope `u` (in the middle that of the
//! position field), of length `n`, and the section a direction `d`, its normal, which shear makes shear rotation away from `u` by the angle `theta`,
//! counter-clockwise. The shear rotation `c = 2 tan(theta / 2)` and the stretch are the parabolas through their values at the three places. With
//! `D = 1 / (1 + c^2 / 4)` and the curvature `k = (u x u') / u.u` of the line strains are, by the reference length,
//!
//! ```text
//! axial = n cos(theta) - 1,   shear = n sin(theta),   bending = k + D c'                                       (1)
//! cos(theta) = 2 D - 1,       sin(theta) = D c
//! ```
//!
//! and the energy `1/2 l sum w (s - s0)^T C (s - s0)` over three Gauss points. Shear is that along the axis of the section that is to
//! the right of its normal.
//!
//! Coordinates are those of [`At`] as far as they lie in the plane: of the axes of a section its normal, of spins and moments the second
//! component, as the second axis is across the plane. The middle section has its normal in the first two internal coordinates, its
//! angular velocity and its moment in the second ones.

mod kernel;
mod tangent;
#[cfg(test)]
mod tests;

use super::{At, Force, Matrix, Rates, Tangent, VELOCITIES, whole};
use crate::elements::ElementMotion;
use crate::elements::constitutive::Law;
use crate::elements::line::sample;
use crate::elements::rod::geometry::{LOADED, POINTS};
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::QuadraturePoint;
use kernel::{Kernel, Motion, Three};

/// Parameters of a planar beam. Components of strain and stress are in the order axial, shear, bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Reference length, m.
    pub length: f64,
    /// Symmetric positive matrices of forces (N) and moment (N m) by strains and curvature (1/m) at the three Gauss points.
    pub stiffness: [[[f64; 3]; 3]; 3],
    /// Kelvin-Voigt damping times `T` of the components, s: stress is `C (s - s0) + T^1/2 C T^1/2 s'`.
    pub damping_times: [f64; 3],
}

/// Elasticity and damping of an element of a planar beam.
#[derive(Clone, Debug)]
pub struct Planar {
    kernel: Kernel<f64>,
}

/// Up to [`PACK`] planar beams.
#[derive(Clone, Debug)]
pub struct Pack {
    kernel: Kernel<[f64; PACK]>,
    count: usize,
}

/// Where the numbers of the plane are among [`VELOCITIES`]: position and slope of the first end, its spin, the same of the last end,
/// the spin of the middle.
pub(super) const PLACES: [usize; 11] = [0, 1, 3, 4, 7, 9, 10, 12, 13, 16, 19];

impl Planar {
    /// A beam whose unstressed shape is this one. Strains that are roundoff are none.
    pub fn new(parameters: Parameters, shape: &At<f64>) -> Self {
        let l = parameters.length;
        let mut kernel = Kernel {
            length: l,
            inverse_length: 1.0 / l,
            law: Law::new(parameters.stiffness, parameters.damping_times),
        };
        let components = shape.e.as_flattened();
        let far = components.iter().fold(l, |far, x| far.max(x.abs()));
        let strains = std::array::from_fn(|k| kernel.strains(shape, &POINTS[k]));
        kernel.law.unstressed_at(strains, [l, l, l * l], far);
        Self { kernel }
    }

    /// Whether the element dissipates.
    pub fn is_damped(&self) -> bool {
        self.kernel.law.is_damped
    }

    /// Strain energy, J.
    pub fn energy<N: Real>(&self, at: &At<N>) -> N {
        self.kernel.lift(at.inner[0]).energy(at)
    }

    /// Elastic force and, with rates, that of damping; and the power that damping takes out, W.
    pub fn force<N: Real>(&self, at: &At<N>, rates: Option<&Rates<N>>) -> (Force<N>, N) {
        let rates = rates.map(Motion::of);
        self.kernel.lift(at.inner[0]).force(at, rates.as_ref())
    }

    /// Strains at `xi` in [0, 1], those of the unstressed shape included: axial, shear and curvature (1/m).
    pub fn strains<N: Real>(&self, at: &At<N>, xi: f64) -> Three<N> {
        let point = sample(QuadraturePoint {
            at: xi,
            weight: 0.0,
        });
        self.kernel.lift(at.inner[0]).strains(at, &point)
    }

    /// The larger of the angles between the tangents at the ends and that at the middle, and no twist, rad.
    pub fn angles(&self, at: &At<f64>) -> [f64; 2] {
        let [first, middle, last] = self.kernel.slopes(&self.kernel.vectors(at));
        let from = |u: [f64; 2]| {
            let turn = middle[0] * u[1] - middle[1] * u[0];
            turn.atan2(middle[0] * u[0] + middle[1] * u[1]).abs()
        };
        [from(first).max(from(last)), 0.0]
    }

    /// Returns the force of distributed moments across the plane on an element. `moments` holds values per reference
    /// length at the Gauss points [`LOADED`], N m/m. Their power is the integral of the products with the angular
    /// velocities of the sections.
    pub fn loaded<N: Real>(&self, at: &At<N>, moments: &[[N; 3]; LOADED.len()]) -> Force<N> {
        self.kernel.lift(at.inner[0]).loaded(at, moments)
    }

    /// Tangent stiffness, the derivative of minus the force along velocities, symmetric; with rates that which matters of it: the
    /// stresses that damping adds are taken as given.
    pub fn stiffness(&self, at: &At<f64>, rates: Option<&Rates<f64>>) -> Matrix {
        let rates = rates.map(Motion::of);
        spread(self.kernel.tangent(at, rates.as_ref(), Tangent::Stiffness))
    }

    /// Damping matrix, the derivative of minus the force by velocities, symmetric.
    pub fn damping(&self, at: &At<f64>) -> Matrix {
        spread(self.kernel.tangent(at, None, Tangent::Damping))
    }

    /// Whether this element and another can be in one pack.
    pub fn goes_with(&self, other: &Self) -> bool {
        self.is_damped() == other.is_damped()
    }

    /// Up to [`PACK`] elements, for [`Self::pack_force`]; entries beyond the number of elements do not count.
    pub fn pack(elements: &[Self]) -> Pack {
        let last = elements.len() - 1;
        let lanes = |of: &dyn Fn(&Kernel<f64>) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(&elements[lane.min(last)].kernel))
        };
        let laws: Vec<_> = elements.iter().map(|beam| &beam.kernel.law).collect();
        let kernel = Kernel {
            length: lanes(&|k| k.length),
            inverse_length: lanes(&|k| k.inverse_length),
            law: Law::pack(&laws),
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
        for group in 0..pack.count.div_ceil(S::F64_LANES) {
            let kernel = pack.kernel.group(simd, group);
            let at = motion.at.group(simd, group);
            let rates = of_rate!(motion.rates, rates => Motion::of(&rates.group(simd, group)));
            let (force, power) = kernel.force(&at, rates.as_ref());
            for d in 0..2 {
                for k in 0..4 {
                    force.e[k][d].write(&mut out.e[k][d], group);
                }
            }
            for k in 0..2 {
                force.moment[k][1].write(&mut out.moment[k][1], group);
            }
            force.inner[1].write(&mut out.inner[1], group);
            if rates.is_some() {
                power.write(&mut powers, group);
            }
        }
        powers[..pack.count].iter().sum()
    }

    /// [`Self::stiffness`], with rates where it is damped, or [`Self::damping`] of a pack: rows with columns up to the
    /// diagonal, as far as they lie in the plane.
    #[inline(always)]
    pub fn pack_tangent<S: Simd>(
        simd: S,
        pack: &Pack,
        motion: ElementMotion<&At<&[f64; PACK]>, &Rates<&[f64; PACK]>>,
        kind: Tangent,
        out: &mut Matrix<[f64; PACK]>,
    ) {
        for group in 0..pack.count.div_ceil(S::F64_LANES) {
            let kernel = pack.kernel.group(simd, group);
            let at = motion.at.group(simd, group);
            let rates = of_rate!(motion.rates, rates => Motion::of(&rates.group(simd, group)));
            let matrix = kernel.tangent(&at, rates.as_ref(), kind);
            for r in 0..PLACES.len() {
                for c in 0..=r {
                    matrix[r][c].write(&mut out[PLACES[r]][PLACES[c]], group);
                }
            }
        }
    }
}

/// A matrix of the plane among the velocities of space, which has rows with columns up to the diagonal.
fn spread(matrix: [[f64; PLACES.len()]; PLACES.len()]) -> Matrix {
    let mut out = [[0.0; VELOCITIES]; VELOCITIES];
    for (r, row) in matrix.iter().enumerate() {
        for (c, entry) in row.iter().enumerate().take(r + 1) {
            out[PLACES[r]][PLACES[c]] = *entry;
        }
    }
    whole(out)
}

impl Kernel<[f64; PACK]> {
    /// A group of the elements of a pack.
    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: usize) -> Kernel<Lanes<S>> {
        Kernel {
            length: Lanes::read(simd, &self.length, group),
            inverse_length: Lanes::read(simd, &self.inverse_length, group),
            law: self.law.group(simd, group),
        }
    }
}
