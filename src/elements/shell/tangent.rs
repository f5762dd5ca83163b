//! Tangent stiffness and damping of an element of a plate or shell, by pairs of corners.
//!
//! Source: J. Kiendl et al., Comput. Methods Appl. Mech. Eng. 198 (2009), Eqs. 30-45 (second variations), written with dual vectors.

use super::grid::{AT, Corners, Grid, PLACES};
use super::kernel::{
    Components, Kernel, Read, Strain, Stress, SurfaceFrame, apply, at, curvature, strain_rate,
};
use crate::elements::line::{dot, times};
use crate::elements::rod::vectors::{Vector, plus};
use crate::math::lanes::Real;

/// Values, slopes and second derivatives of the four functions of a direction at its places: `[order][function][place]`.
const TABLE: [[[f64; PLACES]; 4]; 3] = table();

const fn table() -> [[[f64; PLACES]; 4]; 3] {
    let (mut out, mut place) = ([[[0.0; PLACES]; 4]; 3], 0);
    while place < PLACES {
        let x = AT[place] + 0.5;
        let (x2, x3) = (x * x, x * x * x);
        let columns = [
            [
                1.0 - 3.0 * x2 + 2.0 * x3,
                x - 2.0 * x2 + x3,
                3.0 * x2 - 2.0 * x3,
                x3 - x2,
            ],
            [
                6.0 * x2 - 6.0 * x,
                1.0 - 4.0 * x + 3.0 * x2,
                6.0 * x - 6.0 * x2,
                3.0 * x2 - 2.0 * x,
            ],
            [12.0 * x - 6.0, 6.0 * x - 4.0, 6.0 - 12.0 * x, 6.0 * x - 2.0],
        ];
        let mut k = 0;
        while k < 4 {
            out[0][k][place] = columns[0][k];
            out[1][k][place] = columns[1][k];
            out[2][k][place] = columns[2][k];
            k += 1;
        }
        place += 1;
    }
    out
}

/// Weights of the places of Lobatto at those of Gauss.
const TO_INNER: [[f64; 3]; 3] = [
    [0.3 + AT[3], 0.4, 0.3 - AT[3]],
    [0.0, 1.0, 0.0],
    [0.3 - AT[3], 0.4, 0.3 + AT[3]],
];

/// A corner of an element: end of the first and of the second direction.
pub(super) type Corner = (usize, usize);

/// Pairs of corners: the lower triangle.
pub(super) const PAIRS: [(Corner, Corner); 10] = pairs();

const fn pairs() -> [(Corner, Corner); 10] {
    let (mut out, mut count, mut a) = ([((0, 0), (0, 0)); 10], 0, 0);
    while a < 4 {
        let mut b = 0;
        while b <= a {
            out[count] = ((a / 2, a % 2), (b / 2, b % 2));
            (count, b) = (count + 1, b + 1);
        }
        a += 1;
    }
    out
}

/// Blocks of a pair of corners: by vector of the one (`r`, `r1`, `r2`, `r12`), vector of the other, and both axes.
pub(super) type PairBlocks<N> = [[[[N; 3]; 3]; 4]; 4];

/// Part of the tangent that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Stiffness, that of stresses included.
    Whole,
    /// Stiffness of the material alone.
    Material,
}

/// Functions of both directions of vector `k` at a corner: value and slope are functions 0 and 1 of the first end, 2 and 3 of the second.
#[inline(always)]
const fn functions(corner: Corner, k: usize) -> (usize, usize) {
    (2 * corner.0 + k % 2, 2 * corner.1 + k / 2)
}

/// A function of both directions, differentiated as often in each, at a place.
#[inline(always)]
pub(super) const fn shape(
    (alpha, beta): (usize, usize),
    orders: (usize, usize),
    (i, j): (usize, usize),
) -> f64 {
    TABLE[orders.0][alpha][i] * TABLE[orders.1][beta][j]
}

/// Surface, stress and frames of an element at all places.
pub(super) struct Tangent<N> {
    grid: Grid<N>,
    frames: [[SurfaceFrame<N>; 3]; 3],
    stress: Stress<N>,
    /// Membrane forces at the samples of their strains.
    samples: Components<N>,
}

/// Rows of a vector of a corner at an inner place.
#[derive(Clone, Copy)]
struct Rows<N> {
    /// Changes of membrane strains: vectors by component.
    membrane: [Vector<N>; 3],
    /// Changes of curvatures along the normal, by component.
    bending: [N; 3],
    /// `r^a h_a`.
    dual: Vector<N>,
    /// Second derivatives of the function, times moments, less what the normal takes.
    moment: N,
}

impl<N: Real> Tangent<N> {
    /// At coordinates, with rates where damping acts, or with the stress that a linear step from other coordinates predicts.
    #[inline(always)]
    pub fn new<P, R: Read<P, N>>(
        kernel: &Kernel<P>,
        e: &Corners<N>,
        (rates, from): (Option<&Corners<N>>, Option<&Corners<N>>),
        read: R,
    ) -> Self {
        let grid = Grid::of(e);
        let (curved, frames) = curvature(&grid);
        let strain = match from {
            None => kernel.strain(&grid, &curved, read),
            Some(from) => predicted(kernel, from, e, read),
        };
        let mut stress = kernel.stress(&strain, read);
        if let Some(rates) = rates {
            let damped = kernel.stress(&strain_rate(&grid, &frames, &Grid::of(rates)), read);
            stress = stress.plus(&damped, read.read(&kernel.damping_time));
        }
        Self {
            samples: stress.at_samples(),
            grid,
            frames,
            stress,
        }
    }

    /// Rows of vector `k` of a corner at an inner place. `p` is the sum of second derivatives of the position times moments.
    #[inline(always)]
    fn rows(&self, corner: Corner, k: usize, (i, j): (usize, usize)) -> Rows<N> {
        let (functions, place) = (functions(corner, k), (i + 1, j + 1));
        let like = self.frames[i][j].normal[0];
        let number = |value: f64| like.constant(value);
        let mut membrane = [[number(0.0); 3]; 3];
        for s in 0..3 {
            let along = shape(functions, (1, 0), (2 * s, place.1)) * TO_INNER[i][s];
            membrane[0] = plus(
                &self.grid.first[0][2 * s][place.1],
                number(along),
                &membrane[0],
            );
            let across = shape(functions, (0, 1), (place.0, 2 * s)) * TO_INNER[j][s];
            membrane[1] = plus(
                &self.grid.first[1][place.0][2 * s],
                number(across),
                &membrane[1],
            );
            for t in 0..3 {
                let (at, weight) = ((2 * s, 2 * t), TO_INNER[i][s] * TO_INNER[j][t]);
                let (first, second) = (
                    &self.grid.first[0][at.0][at.1],
                    &self.grid.first[1][at.0][at.1],
                );
                let [h1, h2] = [
                    shape(functions, (1, 0), at) * weight,
                    shape(functions, (0, 1), at) * weight,
                ];
                membrane[2] = plus(second, number(h1), &plus(first, number(h2), &membrane[2]));
            }
        }
        let SurfaceFrame { dual, .. } = &self.frames[i][j];
        let slopes = [
            shape(functions, (1, 0), place),
            shape(functions, (0, 1), place),
        ];
        let direct = [
            shape(functions, (2, 0), place),
            shape(functions, (0, 2), place),
            2.0 * shape(functions, (1, 1), place),
        ];
        let dual = plus(
            &dual[0],
            number(slopes[0]),
            &times(&dual[1], number(slopes[1])),
        );
        let mut bending = [number(0.0); 3];
        for c in 0..3 {
            let twice = number(if c == 2 { 2.0 } else { 1.0 });
            bending[c] = number(direct[c]) - dot(&self.grid.second[c][i][j], &dual) * twice;
        }
        let moment = dot(&at(&self.stress.moment, i, j), &bending);
        Rows {
            membrane,
            bending,
            dual,
            moment,
        }
    }

    /// Blocks of a pair of corners.
    #[inline(always)]
    pub fn blocks<P, R: Read<P, N>>(
        &self,
        kernel: &Kernel<P>,
        (a, b): (Corner, Corner),
        part: Part,
        read: R,
        out: &mut PairBlocks<N>,
    ) {
        let zero = self.frames[0][0].normal[0].constant(0.0);
        *out = [[[[zero; 3]; 3]; 4]; 4];
        for i in 0..3 {
            for j in 0..3 {
                self.add_place((kernel, read), (a, b), (i, j), part, out);
            }
        }
        if part == Part::Whole {
            self.add_tensions((a, b), out);
        }
    }

    /// Adds what an inner place gives.
    #[inline(always)]
    fn add_place<P, R: Read<P, N>>(
        &self,
        (kernel, read): (&Kernel<P>, R),
        (a, b): (Corner, Corner),
        (i, j): (usize, usize),
        part: Part,
        out: &mut PairBlocks<N>,
    ) {
        let normal = &self.frames[i][j].normal;
        let zero = normal[0].constant(0.0);
        let (stiff, bend) = (kernel.law(0, i, j, read), kernel.law(2, i, j, read));
        let coupling = kernel.law(1, i, j, read);
        let first = self.rows(a, 0, (i, j));
        let mut of_a = [first; 4];
        let mut of_b = of_a;
        for k in 1..4 {
            of_a[k] = self.rows(a, k, (i, j));
        }
        for l in 0..4 {
            of_b[l] = if a == b {
                of_a[l]
            } else {
                self.rows(b, l, (i, j))
            };
        }
        let m = at(&self.stress.moment, i, j);
        let second = [
            dot(&self.grid.second[0][i][j], normal),
            dot(&self.grid.second[1][i][j], normal),
            dot(&self.grid.second[2][i][j], normal),
        ];
        let curved = m[0] * second[0] + m[1] * second[1] + m[2] * (second[2] + second[2]);
        for l in 0..4 {
            let of_l = &of_b[l];
            let (mut stressed, mut coupled) = ([[zero; 3]; 3], [zero; 3]);
            for d in 0..3 {
                let [x, y, z] = &of_l.membrane;
                let force = apply(&stiff, [x[d], y[d], z[d]]);
                for c in 0..3 {
                    stressed[c][d] = force[c];
                }
            }
            let bent = apply(&bend, of_l.bending);
            if kernel.is_coupled {
                coupled = apply(&coupling, of_l.bending);
            }
            for k in 0..4 {
                if a == b && k < l {
                    continue;
                }
                let of_k = &of_a[k];
                let mut alpha = dot(&of_k.bending, &bent);
                let (mut on_left, mut on_right) = ([zero; 3], [zero; 3]);
                if part == Part::Whole {
                    alpha = alpha - curved * dot(&of_k.dual, &of_l.dual);
                    on_left = times(&of_l.dual, -of_k.moment);
                    on_right = times(&of_k.dual, -of_l.moment);
                }
                if kernel.is_coupled {
                    let back = apply(&coupling, of_k.bending);
                    for c in 0..3 {
                        on_left = plus(&of_k.membrane[c], -coupled[c], &on_left);
                        on_right = plus(&of_l.membrane[c], -back[c], &on_right);
                    }
                }
                on_right = plus(normal, alpha, &on_right);
                let block = &mut out[k][l];
                for r in 0..3 {
                    let row = &mut block[r];
                    for c in 0..3 {
                        *row = plus(&stressed[c], of_k.membrane[c][r], row);
                    }
                    *row = plus(&on_right, normal[r], row);
                    *row = plus(normal, on_left[r], row);
                }
            }
        }
    }

    /// Adds the stiffness of membrane forces, which is the same in all directions.
    #[inline(always)]
    fn add_tensions(&self, (a, b): (Corner, Corner), out: &mut PairBlocks<N>) {
        let zero = self.frames[0][0].normal[0].constant(0.0);
        for k in 0..4 {
            for l in 0..4 {
                if a == b && k < l {
                    continue;
                }
                let (of_k, of_l) = (functions(a, k), functions(b, l));
                let mut sum = zero;
                for i in 0..3 {
                    for j in 0..3 {
                        let product = |of: (usize, usize), to: (usize, usize), place| {
                            shape(of_k, of, place) * shape(of_l, to, place)
                        };
                        let both = (2 * i, 2 * j);
                        let [n11, n22, n12] = at(&self.samples, i, j);
                        let along = product((1, 0), (1, 0), (2 * i, j + 1));
                        let across = product((0, 1), (0, 1), (i + 1, 2 * j));
                        let shear = product((1, 0), (0, 1), both) + product((0, 1), (1, 0), both);
                        sum = n11.times_plus(sum.constant(along), sum);
                        sum = n22.times_plus(sum.constant(across), sum);
                        sum = n12.times_plus(sum.constant(shear), sum);
                    }
                }
                for d in 0..3 {
                    out[k][l][d][d] += sum;
                }
            }
        }
    }
}

/// Strain that a linear step from coordinates to others predicts.
#[inline(always)]
fn predicted<P, N: Real>(
    kernel: &Kernel<P>,
    from: &Corners<N>,
    to: &Corners<N>,
    read: impl Read<P, N>,
) -> Strain<N> {
    let mut change = *to;
    for alpha in 0..4 {
        for beta in 0..4 {
            for d in 0..3 {
                change[alpha][beta][d] = to[alpha][beta][d] - from[alpha][beta][d];
            }
        }
    }
    let grid = Grid::of(from);
    let (curved, frames) = curvature(&grid);
    let mut strain = kernel.strain(&grid, &curved, read);
    let step = strain_rate(&grid, &frames, &Grid::of(&change));
    for k in 0..3 {
        for i in 0..3 {
            for j in 0..3 {
                strain.membrane[k][i][j] += step.membrane[k][i][j];
                strain.curvature[k][i][j] += step.curvature[k][i][j];
            }
        }
    }
    strain
}
