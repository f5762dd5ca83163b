//! Plates and shells: an element of a surface whose position is bicubic, with four vectors at each corner, thin, without shear.
//!
//! Source: F. K. Bogner, R. L. Fox, L. A. Schmit (1965) (bicubic plate); A. A. Shabana, A. P. Christensen, Int. J. Numer. Meth. Eng. 40 (1997)
//! (absolute nodal coordinates of plates); J. Kiendl et al., Comput. Methods Appl. Mech. Eng. 198 (2009) (Kirchhoff-Love shells).

mod area;
mod grid;
mod kernel;
mod mass;
mod section;
mod strain;
mod tangent;
#[cfg(test)]
mod tests;

use nalgebra::{Matrix3, SVector, Vector3};

use super::line::times;
use super::shape;
use crate::math::jet::Number;
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::GAUSS_3;
use crate::math::space::tangent_axes;
pub use area::{AREA_PLACES, area_place};
use grid::{Corners, Grid, WEIGHTS};
pub use kernel::SurfaceFrame;
use kernel::{Group, Kernel, Read, Single, curvature, metric};
pub use mass::Mass;
pub use section::{Ply, ShellSection, Stiffness};
use section::{rotated, strain_transformation};
pub use strain::GaussStrains;
use tangent::{PAIRS, Part, Tangent};

/// Vectors at a corner.
pub const VECTORS: usize = 4;

/// Numbers at a corner: components of all vectors.
pub const NUMBERS: usize = 3 * VECTORS;

/// Vectors of a corner: its position (m), the derivatives by the lengths along both directions, and the mixed one (1/m) times the unit of
/// length of its body (m), so that all but the first are numbers.
pub type Corner<N = f64> = [[N; 3]; VECTORS];

/// All corners: second direction first, so that corner `2 i + j` is at end `i` of the first direction and end `j` of the second.
pub type ElementCorners<N = f64> = [Corner<N>; 4];

/// Corners of a pack of elements, every number side by side.
pub type CornerPack = [[[[f64; PACK]; 3]; VECTORS]; 4];

/// A symmetric matrix over the numbers of two corners, by vector and axis of the one, then of the other.
pub type CornerBlocks<N = f64> = [[[[N; 3]; 3]; VECTORS]; VECTORS];

/// Pairs of corners, the lower triangle, in the order of [`CornerBlocks`].
pub const CORNER_PAIRS: [(usize, usize); 10] = {
    let (mut out, mut k) = ([(0, 0); 10], 0);
    while k < 10 {
        let (a, b) = PAIRS[k];
        out[k] = (2 * a.0 + a.1, 2 * b.0 + b.1);
        k += 1;
    }
    out
};

/// An element of a plate or shell.
#[derive(Clone, Debug)]
pub struct Shell {
    sizes: [f64; 2],
    /// Factor of each vector of a corner but the position that makes it a derivative by `xi` and `eta`, m.
    scales: [f64; 3],
    kernel: Kernel<f64>,
    mass: Mass,
    /// Forces on the functions per uniform acceleration of space, kg.
    weight: [f64; 16],
    /// Areas of the unstressed surface that places of quadrature of loads stand for, m^2.
    areas: [f64; AREA_PLACES],
    /// Forces on the functions per force per area of the unstressed surface, m^2.
    area_weights: [f64; 16],
}

/// Up to [`PACK`] elements.
#[derive(Clone, Debug)]
pub struct ShellPack {
    kernel: Kernel<[f64; PACK]>,
    scales: [[f64; PACK]; 3],
    count: usize,
}

/// Matrices of a pack: blocks of all pairs of corners, one number for each element.
pub type PackBlocks = CornerBlocks<[f64; PACK]>;

/// Coordinates by functions of both directions.
#[inline(always)]
fn scaled<N: Real>(e: &ElementCorners<N>, scales: &[N; 3]) -> Corners<N> {
    let mut out = [[e[0][0]; 4]; 4];
    for corner in 0..4 {
        for k in 0..VECTORS {
            let place = &mut out[2 * (corner / 2) + k % 2][2 * (corner % 2) + k / 2];
            *place = if k == 0 {
                e[corner][k]
            } else {
                times(&e[corner][k], scales[k - 1])
            };
        }
    }
    out
}

/// The transpose of [`scaled`].
#[inline(always)]
fn unscaled<N: Real>(f: &Corners<N>, scales: &[N; 3]) -> ElementCorners<N> {
    let mut out = [[f[0][0]; VECTORS]; 4];
    for corner in 0..4 {
        for k in 0..VECTORS {
            let place = &f[2 * (corner / 2) + k % 2][2 * (corner % 2) + k / 2];
            out[corner][k] = if k == 0 {
                *place
            } else {
                times(place, scales[k - 1])
            };
        }
    }
    out
}

/// Components `f_k . r^a` of orthonormal axes `f_1`, `f_2` of the tangent plane, `[k][a]`: the first is rotated by an angle (rad) about the
/// normal from the first derivative of the position. Derivatives along these axes are sums of those by the coordinates times them.
pub fn axis_components([first, second]: &[Vector3<f64>; 2], angle: f64) -> [[f64; 2]; 2] {
    let dual = SurfaceFrame::of(&(*first).into(), &(*second).into()).dual;
    let [along, across, _] = tangent_axes(first, second);
    let (sin, cos) = angle.sin_cos();
    let axes = [along * cos + across * sin, across * cos - along * sin];
    axes.map(|axis| dual.map(|dual| axis.dot(&Vector3::from(dual))))
}

/// Covariant stiffness at a place times the area that it stands for: derivatives of the unstressed surface there.
fn covariant(section: &ShellSection, tangents: &[Vector3<f64>; 2], weight: f64) -> [[f64; 6]; 3] {
    let area = tangents[0].cross(&tangents[1]).norm();
    let by: Matrix3<f64> = strain_transformation(axis_components(tangents, section.angle));
    [&section.membrane, &section.coupling, &section.bending].map(|law| {
        let law = rotated(law, &by);
        let entry = |r: usize, c: usize| 0.5 * (law[r][c] + law[c][r]) * area * weight;
        [
            entry(0, 0),
            entry(0, 1),
            entry(0, 2),
            entry(1, 1),
            entry(1, 2),
            entry(2, 2),
        ]
    })
}

impl Shell {
    /// An element of these lengths (m) with the coordinates of its unstressed surface and the unit of length (m) of mixed derivatives. Its
    /// section at `xi` and `eta` in [0, 1] may vary in stiffness and mass.
    pub fn new(
        section: impl Fn([f64; 2]) -> ShellSection,
        (sizes, unit): ([f64; 2], f64),
        corners: &ElementCorners,
    ) -> Self {
        let scales = [sizes[0], sizes[1], sizes[0] * sizes[1] / unit];
        let grid = Grid::of(&scaled(corners, &scales));
        let mut laws = [[[[0.0; 6]; 3]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let tangents = [0, 1].map(|of| grid.first[of][i + 1][j + 1].into());
                let own = section([GAUSS_3[i].at, GAUSS_3[j].at]);
                let stiffness = covariant(&own, &tangents, WEIGHTS[i] * WEIGHTS[j]);
                for (law, at) in stiffness.into_iter().enumerate() {
                    laws[law][i][j] = at;
                }
            }
        }
        let middle = section([0.5; 2]);
        let kernel = Kernel {
            laws,
            is_coupled: middle.coupling != [[0.0; 3]; 3],
            metric: metric(&grid),
            curvature: curvature(&grid).0,
            damping_time: middle.damping_time,
        };
        let mass = mass::mass(corners, (sizes, unit), |at| section(at).area_density);
        let ones =
            SVector::<f64, 16>::from_fn(|k, _| f64::from(u8::from(k.is_multiple_of(VECTORS))));
        let mut element = Self {
            sizes,
            scales,
            kernel,
            weight: (mass * ones).into(),
            mass,
            areas: [0.0; AREA_PLACES],
            area_weights: [0.0; 16],
        };
        element.areas = element.areas(corners);
        element.area_weights = element.area_weights();
        element
    }

    /// Lengths along both directions, m.
    pub fn sizes(&self) -> [f64; 2] {
        self.sizes
    }

    /// Mass over the functions, corner by corner; the full one is its Kronecker product with the identity of space.
    pub fn mass(&self) -> &Mass {
        &self.mass
    }

    /// Forces on the functions per uniform acceleration of space, kg.
    pub fn weight(&self) -> &[f64; 16] {
        &self.weight
    }

    /// Whether it dissipates.
    pub fn is_damped(&self) -> bool {
        self.kernel.damping_time > 0.0
    }

    /// Whether another one can be in the same pack.
    pub fn goes_with(&self, other: &Self) -> bool {
        self.kernel.is_coupled == other.kernel.is_coupled && self.is_damped() == other.is_damped()
    }

    fn scales_of<N: Number>(&self) -> [N; 3] {
        self.scales.map(N::of)
    }

    /// Strain energy, J.
    pub fn energy<N: Number>(&self, e: &ElementCorners<N>) -> N {
        self.kernel.energy(&scaled(e, &self.scales_of()), Single)
    }

    /// Elastic and damping force on the coordinates, N and N m, and the power that damping dissipates, W.
    pub fn force<N: Number>(
        &self,
        e: &ElementCorners<N>,
        rate: &ElementCorners<N>,
    ) -> (ElementCorners<N>, N) {
        let scales = self.scales_of();
        let rate = self.is_damped().then(|| scaled(rate, &scales));
        let at = scaled(e, &scales);
        let mut grid = Grid::zeros(N::of(0.0));
        let (force, power) = (self.kernel).force((&at, rate.as_ref()), Single, &mut grid);
        (unscaled(&force, &scales), power)
    }

    /// Weights of the coordinates in the value or in a derivative of the position, `orders` times by the lengths along both directions, at
    /// `xi` and `eta` in [0, 1].
    pub fn weights<N: Number>(&self, at: [N; 2], orders: [usize; 2]) -> [N; 16] {
        let functions: [[N; 4]; 2] = std::array::from_fn(|of| {
            let (at, size) = (at[of], self.sizes[of]);
            match orders[of] {
                0 => shape::values(at, size).into(),
                1 => shape::slopes(at, size).into(),
                _ => shape::curvatures(at, size).into(),
            }
        });
        let unit = N::of(self.scales[2] / (self.sizes[0] * self.sizes[1]));
        std::array::from_fn(|k| {
            let (alpha, beta) = mass::functions(k);
            let weight = functions[0][alpha] * functions[1][beta];
            if k % VECTORS == 3 {
                weight * unit
            } else {
                weight
            }
        })
    }

    /// Up to [`PACK`] elements for the calls below; the last fills up.
    pub fn pack(elements: &[Self]) -> ShellPack {
        let last = elements.len() - 1;
        let lanes = |of: &dyn Fn(&Self) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(&elements[lane.min(last)]))
        };
        let components = |of: &dyn Fn(&Kernel<f64>) -> &kernel::Components<f64>| {
            std::array::from_fn(|k: usize| {
                std::array::from_fn(|i: usize| {
                    std::array::from_fn(|j: usize| lanes(&|e| of(&e.kernel)[k][i][j]))
                })
            })
        };
        let laws = std::array::from_fn(|law: usize| {
            std::array::from_fn(|i: usize| {
                std::array::from_fn(|j: usize| {
                    std::array::from_fn(|k: usize| lanes(&|e| e.kernel.laws[law][i][j][k]))
                })
            })
        });
        ShellPack {
            kernel: Kernel {
                laws,
                is_coupled: elements[0].kernel.is_coupled,
                metric: components(&|k| &k.metric),
                curvature: components(&|k| &k.curvature),
                damping_time: lanes(&|e| e.kernel.damping_time),
            },
            scales: [0, 1, 2].map(|of| lanes(&|e| e.scales[of])),
            count: elements.len(),
        }
    }
}

/// Coordinates of a group of elements by functions of both directions: [`scaled`].
#[inline(always)]
fn read_scaled<S: Simd>(
    pack: &CornerPack,
    scales: &[Lanes<S>; 3],
    group: Group<S>,
) -> Corners<Lanes<S>> {
    let mut out = [[[scales[0]; 3]; 4]; 4];
    for corner in 0..4 {
        for k in 0..VECTORS {
            let place = &mut out[2 * (corner / 2) + k % 2][2 * (corner % 2) + k / 2];
            for d in 0..3 {
                let number: Lanes<S> = group.read(&pack[corner][k][d]);
                place[d] = if k == 0 {
                    number
                } else {
                    number * scales[k - 1]
                };
            }
        }
    }
    out
}

/// Writes forces on the functions as those on coordinates: [`unscaled`].
#[inline(always)]
fn write_unscaled<S: Simd>(
    f: &Corners<Lanes<S>>,
    scales: &[Lanes<S>; 3],
    out: &mut CornerPack,
    group: usize,
) {
    for corner in 0..4 {
        for k in 0..VECTORS {
            let force = &f[2 * (corner / 2) + k % 2][2 * (corner % 2) + k / 2];
            for d in 0..3 {
                let force = if k == 0 {
                    force[d]
                } else {
                    force[d] * scales[k - 1]
                };
                force.write(&mut out[corner][k][d], group);
            }
        }
    }
}

impl ShellPack {
    /// Number of groups of as many elements as there are lanes.
    #[inline(always)]
    fn groups<S: Simd>(&self) -> usize {
        self.count.div_ceil(S::F64_LANES)
    }

    #[inline(always)]
    fn scales<S: Simd>(&self, group: Group<S>) -> [Lanes<S>; 3] {
        let [a, b, c] = &self.scales;
        [group.read(a), group.read(b), group.read(c)]
    }

    /// [`Shell::force`] of all elements; with rates where they are damped. Returns the power that damping dissipates, W.
    #[inline(always)]
    pub fn force<S: Simd>(
        &self,
        simd: S,
        (e, rates): (&CornerPack, Option<&CornerPack>),
        out: &mut CornerPack,
    ) -> f64 {
        let mut powers = [0.0; PACK];
        let mut grid = Grid::zeros(Lanes::read(simd, &powers, 0));
        for group in 0..self.groups::<S>() {
            let reader = Group(simd, group);
            let scales = self.scales(reader);
            let at = read_scaled(e, &scales, reader);
            let rate = match rates {
                Some(rates) => Some(read_scaled(rates, &scales, reader)),
                None => None,
            };
            let (force, power) = self.kernel.force((&at, rate.as_ref()), reader, &mut grid);
            write_unscaled(&force, &scales, out, group);
            power.write(&mut powers, group);
        }
        powers[..self.count].iter().sum()
    }

    /// Tangent stiffness and, of damped elements, damping: `call` gets each pair of corners of [`CORNER_PAIRS`] with its blocks, and whether
    /// they are damping. `from` are coordinates from which a linear step predicts the stress (docs/decisions/0076-plates-and-shells.md).
    #[inline(always)]
    pub fn tangent<S: Simd>(
        &self,
        simd: S,
        e: &CornerPack,
        (rates, from): (Option<&CornerPack>, Option<&CornerPack>),
        out: &mut PackBlocks,
        mut call: impl FnMut((usize, usize), usize, bool, &PackBlocks),
    ) {
        let mut tangent = Tangent::zeros(Lanes::read(simd, &self.scales[0], 0));
        for group in 0..self.groups::<S>() {
            let reader = Group(simd, group);
            let scales = self.scales(reader);
            let at = read_scaled(e, &scales, reader);
            let rates = match rates {
                Some(rates) => Some(read_scaled(rates, &scales, reader)),
                None => None,
            };
            let from = match from {
                Some(from) => Some(read_scaled(from, &scales, reader)),
                None => None,
            };
            tangent.find(&self.kernel, &at, (rates.as_ref(), from.as_ref()), reader);
            let one = scales[0].constant(1.0);
            let by = [one, scales[0], scales[1], scales[2]];
            for pair in 0..PAIRS.len() {
                let mut blocks = [[[[at[0][0][0]; 3]; 3]; VECTORS]; VECTORS];
                tangent.blocks(&self.kernel, PAIRS[pair], Part::Whole, reader, &mut blocks);
                write(&blocks, &by, group, out);
                call(CORNER_PAIRS[pair], group, false, out);
                if rates.is_some() {
                    tangent.blocks(
                        &self.kernel,
                        PAIRS[pair],
                        Part::Material,
                        reader,
                        &mut blocks,
                    );
                    let time = reader.read(&self.kernel.damping_time);
                    let mut damped = by;
                    for k in 0..VECTORS {
                        damped[k] = by[k] * time;
                    }
                    write_scaled(&blocks, (&damped, &by), group, out);
                    call(CORNER_PAIRS[pair], group, true, out);
                }
            }
        }
    }
}

/// Writes blocks in the units of coordinates.
#[inline(always)]
fn write<S: Simd>(
    blocks: &CornerBlocks<Lanes<S>>,
    by: &[Lanes<S>; VECTORS],
    group: usize,
    out: &mut PackBlocks,
) {
    write_scaled(blocks, (by, by), group, out);
}

#[inline(always)]
fn write_scaled<S: Simd>(
    blocks: &CornerBlocks<Lanes<S>>,
    (left, right): (&[Lanes<S>; VECTORS], &[Lanes<S>; VECTORS]),
    group: usize,
    out: &mut PackBlocks,
) {
    for k in 0..VECTORS {
        for l in 0..VECTORS {
            let factor = left[k] * right[l];
            for r in 0..3 {
                for c in 0..3 {
                    (blocks[k][l][r][c] * factor).write(&mut out[k][l][r][c], group);
                }
            }
        }
    }
}
