//! Tangent stiffness and damping of an element of a plate or shell, by pairs of corners.
//!
//! Source: J. Kiendl et al., Comput. Methods Appl. Mech. Eng. 198 (2009), Eqs. 30-45 (second variations), written with dual vectors.

use super::grid::{AT, Corners, Grid, PLACES};
use super::kernel::{
    Components, Kernel, Read, Strain, SurfaceFrame, apply, at, at_samples, curvature, strain_rate,
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
    moment: Components<N>,
    /// At inner places, by the functions of both directions.
    rows: [[[[Rows<N>; 4]; 4]; 3]; 3],
    /// Stiffness of membrane forces, which is the same in all directions: by the functions of the first direction of the one and of the
    /// other vector, then by those of the second direction.
    tensions: [[[[N; 4]; 4]; 4]; 4],
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
    /// Room for one.
    #[inline(always)]
    pub fn zeros(like: N) -> Self {
        let zero = like.constant(0.0);
        let vector = [zero; 3];
        let frame = SurfaceFrame {
            normal: vector,
            dual: [vector; 2],
        };
        let rows = Rows {
            membrane: [vector; 3],
            bending: vector,
            dual: vector,
            moment: zero,
        };
        Self {
            grid: Grid::zeros(zero),
            frames: [[frame; 3]; 3],
            moment: [[vector; 3]; 3],
            rows: [[[[rows; 4]; 4]; 3]; 3],
            tensions: [[[[zero; 4]; 4]; 4]; 4],
        }
    }

    /// Overwrites it with that at coordinates, with rates where damping acts, or with the stress that a linear step from other coordinates
    /// predicts.
    #[inline(always)]
    pub fn find<P, R: Read<P, N>>(
        &mut self,
        kernel: &Kernel<P>,
        e: &Corners<N>,
        (rates, from): (Option<&Corners<N>>, Option<&Corners<N>>),
        read: R,
    ) {
        self.grid.fill(e);
        let (curved, frames) = curvature(&self.grid);
        let strain = match from {
            None => kernel.strain(&self.grid, &curved, read),
            Some(from) => predicted(kernel, from, e, read),
        };
        let mut stress = kernel.stress(&strain, read);
        if let Some(rates) = rates {
            let damped = kernel.stress(&strain_rate(&self.grid, &frames, &Grid::of(rates)), read);
            stress = stress.plus(&damped, read.read(&kernel.damping_time));
        }
        self.frames = frames;
        self.moment = stress.moment;
        self.find_tensions(&at_samples(&stress.membrane));
        self.find_rows();
    }

    /// Stiffness of membrane forces at samples.
    #[inline(always)]
    fn find_tensions(&mut self, [n11, n22, n12]: &Components<N>) {
        let zero = n11[0][0].constant(0.0);
        let number = |value: f64| zero.constant(value);
        for a in 0..4 {
            for b in 0..4 {
                let mut sums = [[zero; 3]; 4];
                for i in 0..3 {
                    sums[0] = plus(&n11[i], number(SLOPES[a][b][i]), &sums[0]);
                    sums[1] = plus(&n22[i], number(VALUES[a][b][i]), &sums[1]);
                    sums[2] = plus(&n12[i], number(SLOPE_VALUES[a][b][i]), &sums[2]);
                    sums[3] = plus(&n12[i], number(SLOPE_VALUES[b][a][i]), &sums[3]);
                }
                for c in 0..4 {
                    for d in 0..4 {
                        let mut sum = zero;
                        for j in 0..3 {
                            sum = sums[0][j].times_plus(number(VALUES[c][d][j]), sum);
                            sum = sums[1][j].times_plus(number(SLOPES[c][d][j]), sum);
                            sum = sums[2][j].times_plus(number(SLOPE_VALUES[d][c][j]), sum);
                            sum = sums[3][j].times_plus(number(SLOPE_VALUES[c][d][j]), sum);
                        }
                        self.tensions[a][b][c][d] = sum;
                    }
                }
            }
        }
    }

    /// Rows of all vectors at all inner places, summed one direction after the other.
    #[inline(always)]
    fn find_rows(&mut self) {
        let zero = [self.frames[0][0].normal[0].constant(0.0); 3];
        let number = |value: f64| zero[0].constant(value);
        for i in 0..3 {
            // Of the second and of the first derivatives, by the function and the place of Lobatto along the second direction.
            let (mut of_second, mut of_first) = ([[zero; 3]; 4], [[zero; 3]; 4]);
            for alpha in 0..4 {
                for t in 0..3 {
                    for s in 0..3 {
                        let slope = TABLE[1][alpha][2 * s] * TO_INNER[i][s];
                        let value = TABLE[0][alpha][2 * s] * TO_INNER[i][s];
                        let [first, second] = &self.grid.first;
                        let sum = &mut of_second[alpha][t];
                        *sum = plus(&second[2 * s][2 * t], number(slope), sum);
                        let sum = &mut of_first[alpha][t];
                        *sum = plus(&first[2 * s][2 * t], number(value), sum);
                    }
                }
            }
            for j in 0..3 {
                self.find_rows_at((i, j), &of_first, &of_second);
            }
        }
    }

    /// Rows of all vectors at an inner place.
    #[inline(always)]
    fn find_rows_at(
        &mut self,
        (i, j): (usize, usize),
        of_first: &[[Vector<N>; 3]; 4],
        of_second: &[[Vector<N>; 3]; 4],
    ) {
        let zero = [self.frames[0][0].normal[0].constant(0.0); 3];
        let number = |value: f64| zero[0].constant(value);
        let (mut along, mut across) = ([zero; 4], [zero; 4]);
        for k in 0..4 {
            for s in 0..3 {
                let weight = number(TABLE[1][k][2 * s] * TO_INNER[i][s]);
                along[k] = plus(&self.grid.first[0][2 * s][j + 1], weight, &along[k]);
                let weight = number(TABLE[1][k][2 * s] * TO_INNER[j][s]);
                across[k] = plus(&self.grid.first[1][i + 1][2 * s], weight, &across[k]);
            }
        }
        for alpha in 0..4 {
            for beta in 0..4 {
                let mut shear = zero;
                for t in 0..3 {
                    let value = number(TABLE[0][beta][2 * t] * TO_INNER[j][t]);
                    let slope = number(TABLE[1][beta][2 * t] * TO_INNER[j][t]);
                    shear = plus(&of_second[alpha][t], value, &shear);
                    shear = plus(&of_first[alpha][t], slope, &shear);
                }
                let membrane = [
                    times(&along[alpha], number(TABLE[0][beta][j + 1])),
                    times(&across[beta], number(TABLE[0][alpha][i + 1])),
                    shear,
                ];
                self.rows[i][j][alpha][beta] = self.rows_of((alpha, beta), (i, j), membrane);
            }
        }
    }

    /// Rows of a function at an inner place.
    #[inline(always)]
    fn rows_of(
        &self,
        functions: (usize, usize),
        (i, j): (usize, usize),
        membrane: [Vector<N>; 3],
    ) -> Rows<N> {
        let SurfaceFrame { dual, .. } = &self.frames[i][j];
        let (place, like) = ((i + 1, j + 1), dual[0][0]);
        let number = |value: f64| like.constant(value);
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
        let mut bending = dual;
        for c in 0..3 {
            let twice = number(if c == 2 { 2.0 } else { 1.0 });
            bending[c] = number(direct[c]) - dot(&self.grid.second[c][i][j], &dual) * twice;
        }
        let moment = dot(&at(&self.moment, i, j), &bending);
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
            for k in 0..4 {
                for l in 0..4 {
                    let (of_k, of_l) = (functions(a, k), functions(b, l));
                    let tension = self.tensions[of_k.0][of_l.0][of_k.1][of_l.1];
                    for d in 0..3 {
                        out[k][l][d][d] += tension;
                    }
                }
            }
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
        let normal = self.frames[i][j].normal;
        let zero = [normal[0].constant(0.0); 3];
        let (stiff, bend) = (kernel.law(0, i, j, read), kernel.law(2, i, j, read));
        let m = at(&self.moment, i, j);
        let [r11, r22, r12] = &self.grid.second;
        let twist = dot(&r12[i][j], &normal);
        let curved = [
            dot(&r11[i][j], &normal),
            dot(&r22[i][j], &normal),
            twist + twist,
        ];
        let curved = -dot(&m, &curved);
        let (coupling, mut coupled) = (kernel.law(1, i, j, read), [zero; 4]);
        if kernel.is_coupled {
            for k in 0..4 {
                let (alpha, beta) = functions(a, k);
                coupled[k] = apply(&coupling, self.rows[i][j][alpha][beta].bending);
            }
        }
        for l in 0..4 {
            let (alpha, beta) = functions(b, l);
            let of_l = &self.rows[i][j][alpha][beta];
            let [x, y, z] = &of_l.membrane;
            let mut stressed = [zero; 3];
            for d in 0..3 {
                let force = apply(&stiff, [x[d], y[d], z[d]]);
                for c in 0..3 {
                    stressed[c][d] = force[c];
                }
            }
            let bent = apply(&bend, of_l.bending);
            let mut coupled_l = zero;
            if kernel.is_coupled {
                coupled_l = apply(&coupling, of_l.bending);
            }
            let (minus, curved_dual) = (-of_l.moment, times(&of_l.dual, curved));
            for k in 0..4 {
                if a == b && k < l {
                    continue;
                }
                let (alpha, beta) = functions(a, k);
                let of_k = &self.rows[i][j][alpha][beta];
                let mut factor = dot(&of_k.bending, &bent);
                let (mut on_left, mut on_right) = (zero, zero);
                if part == Part::Whole {
                    factor += dot(&of_k.dual, &curved_dual);
                    on_left = times(&of_l.dual, -of_k.moment);
                    on_right = times(&of_k.dual, minus);
                }
                if kernel.is_coupled {
                    for c in 0..3 {
                        on_left = plus(&of_k.membrane[c], -coupled_l[c], &on_left);
                        on_right = plus(&of_l.membrane[c], -coupled[k][c], &on_right);
                    }
                }
                on_right = plus(&normal, factor, &on_right);
                let [x, y, z] = of_k.membrane;
                let left = [x, y, z, on_left, normal];
                let [x, y, z] = stressed;
                let right = [x, y, z, normal, on_right];
                add_products(&left, &right, &mut out[k][l]);
            }
        }
    }
}

/// Adds products of vectors.
#[inline(always)]
fn add_products<N: Real>(
    left: &[Vector<N>; 5],
    right: &[Vector<N>; 5],
    block: &mut [Vector<N>; 3],
) {
    for r in 0..3 {
        let mut row = block[r];
        for c in 0..5 {
            row = plus(&right[c], left[c][r], &row);
        }
        block[r] = row;
    }
}

/// Products of values or slopes of the functions of a direction at Lobatto's places or at inner ones: `[function][function][place]`.
type Products = [[[f64; 3]; 4]; 4];

const fn products_of(orders: (usize, usize), places: [usize; 3]) -> Products {
    let (mut out, mut k) = ([[[0.0; 3]; 4]; 4], 0);
    while k < 48 {
        let (a, b, place) = (k / 12, k / 3 % 4, places[k % 3]);
        out[a][b][k % 3] = TABLE[orders.0][a][place] * TABLE[orders.1][b][place];
        k += 1;
    }
    out
}

const LOBATTO: [usize; 3] = [0, 2, 4];
const SLOPES: Products = products_of((1, 1), LOBATTO);
const SLOPE_VALUES: Products = products_of((1, 0), LOBATTO);
const VALUES: Products = products_of((0, 0), [1, 2, 3]);

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
