//! A beam in space: stretching, shear along two axes of the section, torsion and bending about two axes, of one element, all of them
//! coupled by one 6 x 6 matrix. Mass and weight are those of the cable element on the same line.
//!
//! Source: J. C. Simo, A finite strain beam formulation, Comput. Methods Appl. Mech. Eng. 49 (1985) (strains of sections that need
//! not stay normal to the line); R. Echter, B. Oesterle, M. Bischoff, Comput. Methods Appl. Mech. Eng. 254 (2013) (shear as a
//! correction of a shear-free line, which does not lock); the frames of [`rod`](super::rod), which this one is built on.
//!
//! At both ends there are position `r`, slope `u = dr/ds`, and the axes `e1`, `e2`, `e3` of the section; `e1` is its normal, which
//! shear makes shear rotation away from the unit tangent `t = u / |u|`. The tangent's frame is `t`, `d = carry(e1, t, e2)`, `t x d`; in it the
//! section is rotated by the rational vector
//!
//! ```text
//! c = 2 (t x e1) / (1 + t . e1),   [c] v = v + (c x v + c x (c x v) / 2) / (1 + |c|^2 / 4),   e_j = [c] d_j
//! ```
//!
//! which has two components, about `d` and about `t x d`. On the tangent's frames stands the rod with its internal twist: its twist
//! and curvatures `k`. The shear rotation is interpolated between the ends in the transported and twisted frame, and an internal one of either
//! component is added with `4 xi (1 - xi)`. With the stretch `n`, the parabola through `|u|` at both ends and in the middle, strains
//! are, along the axes of the section and by the reference length,
//!
//! ```text
//! (axial, shear)   = n [c]^T (1, 0, 0) - (1, 0, 0)                                                          (1)
//! (twist, bending) = [c]^T k + (c' - c x c' / 2) / (1 + |c|^2 / 4)                                          (2)
//! ```
//!
//! and the energy `1/2 l sum w (s - s0)^T C (s - s0)` over three Gauss points, with the strains `s0` of the unstressed shape. It is
//! the same from all frames, and of order 4 in the length. Seen from the last end `e1` and `e3` are opposite, and so are the
//! internal twist and the internal shear rotation about the third axis: shear along the second axis and bending about it change their signs.
//!
//! Velocities are those of `e`, the angular velocities of the sections at the ends along their own axes, and the rates of what is
//! inside; axes follow by `e_j' = omega x e_j`. Forces are the factors of these in the power.

mod end;
mod kernel;
mod loaded;
pub mod planar;
mod shear_rotation;
#[cfg(test)]
mod statics;
mod tangent;
#[cfg(test)]
mod tests;

use crate::elements::ElementMotion;
use crate::elements::constitutive::Law;
use crate::elements::line::{sample, times};
use crate::elements::rod::geometry::{Geometry, POINTS};
use crate::elements::rod::read;
use crate::elements::rod::vectors::{Vector, plus};
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::QuadraturePoint;
use kernel::Kernel;

pub use crate::elements::rod::Tangent;

/// Velocities of an element: `r`, `u`, spin of the first end, the same of the last, what is inside.
pub const VELOCITIES: usize = 21;

/// A matrix over the velocities of an element in the order `r_A, u_A, spin_A, r_B, u_B, spin_B, inner`.
pub type Matrix<N = f64> = [[N; VELOCITIES]; VELOCITIES];

/// Parameters of a beam. Components of strain and stress are in the order axial, shear along the second axis of the section, shear
/// along the third, twist, bending about the second axis, bending about the third.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Reference length, m.
    pub length: f64,
    /// Symmetric positive matrices of forces (N) and moments (N m) by strains and curvatures (1/m) at the three Gauss points.
    pub stiffness: [[[f64; 6]; 6]; 3],
    /// Kelvin-Voigt damping times `T` of the components, s: stress is `C (s - s0) + T^1/2 C T^1/2 s'`.
    pub damping_times: [f64; 6],
}

/// Where an element is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<N> {
    /// Position (m) and slope at the first end, position and slope at the last.
    pub e: [[N; 3]; 4],
    /// Axes of the section at both ends, orthonormal: its normal, then both across it.
    pub axes: [[[N; 3]; 3]; 2],
    /// Internal twist (rad), internal shear rotations about the second and the third axis.
    pub inner: [N; 3],
}

/// Velocities of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates<N> {
    /// Rates of positions (m/s) and slopes (1/s).
    pub e: [[N; 3]; 4],
    /// Angular velocities of the sections at both ends along their own axes, rad/s.
    pub spin: [[N; 3]; 2],
    /// Rates of internal twist and shear rotations, 1/s.
    pub inner: [N; 3],
}

/// Forces on an element: their power is the sum of products with [`Rates`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force<N> {
    /// On positions (N) and slopes (N m).
    pub e: [[N; 3]; 4],
    /// Moments on the sections at both ends along their own axes, N m.
    pub moment: [[N; 3]; 2],
    /// On internal twist and shear rotations, N m.
    pub inner: [N; 3],
}

impl<N: Real> Force<N> {
    /// Adds another force on the same element.
    pub fn add(&mut self, other: &Self) {
        let pairs = self.e.iter_mut().zip(&other.e);
        let pairs = pairs.chain(self.moment.iter_mut().zip(&other.moment));
        let pairs = pairs.chain([(&mut self.inner, &other.inner)]);
        for (sum, more) in pairs {
            sum.iter_mut().zip(more).for_each(|(sum, f)| *sum += *f);
        }
    }
}

/// Elasticity and damping of an element of a beam.
#[derive(Clone, Debug)]
pub struct Beam {
    kernel: Kernel<f64>,
}

/// Up to [`PACK`] beams.
#[derive(Clone, Debug)]
pub struct Pack {
    kernel: Kernel<[f64; PACK]>,
    count: usize,
}

impl Beam {
    /// A beam whose unstressed shape is this one; its internal twist and shear rotations do not count. Strains that are roundoff are none.
    pub fn new(parameters: Parameters, shape: &At<f64>) -> Self {
        let l = parameters.length;
        let mut kernel = Kernel {
            geometry: Geometry {
                length: l,
                inverse_length: 1.0 / l,
                is_round: false,
            },
            law: Law::new(parameters.stiffness, parameters.damping_times),
        };
        let shape = At {
            inner: [0.0; 3],
            ..*shape
        };
        let components = shape.e.as_flattened();
        let far = components.iter().fold(l, |far, x| far.max(x.abs()));
        let strains = std::array::from_fn(|k| kernel.strains(&shape, &POINTS[k]));
        let per = [l, l, l, l * l, l * l, l * l];
        kernel.law.unstressed_at(strains, per, far);
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
        self.kernel.lift(at.inner[0]).force(at, rates)
    }

    /// Strains at `xi` in [0, 1], those of the unstressed shape included: axial and shear, twist and curvatures (1/m).
    pub fn strains<N: Real>(&self, at: &At<N>, xi: f64) -> [N; 6] {
        let point = sample(QuadraturePoint {
            at: xi,
            weight: 0.0,
        });
        self.kernel.lift(at.inner[0]).strains(at, &point)
    }

    /// The larger of the angles between the tangents at the ends and that at the middle, and the size of the twist, rad. Frames hold
    /// while the first is less than a right angle and the second less than half a turn; a mesh with more than 1 is coarse.
    pub fn angles(&self, at: &At<f64>) -> [f64; 2] {
        let d = self.kernel.placed(at).ends.map(|end| end.across[0]);
        self.kernel.geometry.angles(&at.e, &d)
    }

    /// Tangent stiffness, the derivative of minus the force along velocities, its symmetric part: the second derivatives of the energy
    /// where slopes and angular velocities change evenly. With rates that which matters of it: the stresses that
    /// damping adds are taken as given.
    pub fn stiffness(&self, at: &At<f64>, rates: Option<&Rates<f64>>) -> Matrix {
        whole(self.kernel.tangent(at, rates, Tangent::Stiffness))
    }

    /// Damping matrix, the derivative of minus the force by velocities, symmetric.
    pub fn damping(&self, at: &At<f64>) -> Matrix {
        whole(self.kernel.tangent(at, None, Tangent::Damping))
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
            geometry: Geometry {
                length: lanes(&|k| k.geometry.length),
                inverse_length: lanes(&|k| k.geometry.inverse_length),
                is_round: false,
            },
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
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group);
            let at = motion.at.group(simd, group);
            let rates = of_rate!(motion.rates, rates => rates.group(simd, group));
            let (force, power) = kernel.force(&at, rates.as_ref());
            for d in 0..3 {
                for k in 0..4 {
                    force.e[k][d].write(&mut out.e[k][d], group);
                }
                for k in 0..2 {
                    force.moment[k][d].write(&mut out.moment[k][d], group);
                }
                force.inner[d].write(&mut out.inner[d], group);
            }
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

/// The symmetric matrix whose rows with columns up to the diagonal are these.
fn whole(mut matrix: Matrix) -> Matrix {
    for r in 0..VELOCITIES {
        for c in 0..r {
            matrix[c][r] = matrix[r][c];
        }
    }
    matrix
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
        let [inner] = read(simd, &[self.inner], group);
        At {
            e: read(simd, &self.e, group),
            axes: [
                read(simd, &self.axes[0], group),
                read(simd, &self.axes[1], group),
            ],
            inner,
        }
    }
}

impl Rates<&[f64; PACK]> {
    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: usize) -> Rates<Lanes<S>> {
        let [inner] = read(simd, &[self.inner], group);
        Rates {
            e: read(simd, &self.e, group),
            spin: read(simd, &self.spin, group),
            inner,
        }
    }
}

impl<N: Real> At<N> {
    /// Rates of the axes of an end, 1/s.
    #[inline(always)]
    pub fn axes_rate(&self, rates: &Rates<N>, end: usize) -> [Vector<N>; 3] {
        let ([first, second, third], [p, q, r]) = (&self.axes[end], rates.spin[end]);
        [
            plus(second, r, &times(third, -q)),
            plus(third, p, &times(first, -r)),
            plus(first, q, &times(second, -p)),
        ]
    }
}

impl<N: Copy> Force<N> {
    /// In the order of [`Matrix`].
    pub fn flat(&self) -> [N; VELOCITIES] {
        let ([ra, ua, rb, ub], [ma, mb]) = (&self.e, &self.moment);
        let parts = [ra, ua, ma, rb, ub, mb, &self.inner];
        std::array::from_fn(|k| parts[k / 3][k % 3])
    }
}
