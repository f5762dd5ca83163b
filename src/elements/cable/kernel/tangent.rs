//! The tangent: sums of products of vectors over the three vectors, then over the coordinates.
//!
//! Source: second derivatives of the energy of `cable/mod.rs`.

use super::{
    BENDING, BETWEEN, Curvature, Kernel, LOBATTO, Line, Motion, RADAU, RADAU_LAST, Sampling,
    Square, TURNS, contract, inner, turns,
};
use crate::elements::EndBlocks;
use crate::elements::line::{Components, Sample, combine, times};
use crate::math::lanes::Real;

/// Weights of the parts of a tangent matrix.
#[derive(Clone, Copy)]
pub(in crate::elements::cable) struct Factors<N> {
    /// Weight of the geometric part, 0 or 1.
    pub stress: N,
    /// Weights of the squares of the gradients of axial strain and of curvature.
    pub axial: N,
    pub bending: N,
    /// Whether, in space, the size of the curvature counts alone.
    pub of_size: bool,
}

impl<N: Copy> Factors<N> {
    /// Returns the weights of the stiffness matrix.
    #[inline(always)]
    pub fn elastic(one: N) -> Self {
        Self {
            stress: one,
            axial: one,
            bending: one,
            of_size: false,
        }
    }

    /// Returns the weights of the damping matrix.
    #[inline(always)]
    pub fn damped(zero: N, kernel: &Kernel<N>) -> Self {
        Self {
            stress: zero,
            axial: kernel.axial_damping_time,
            bending: kernel.bending_damping_time,
            of_size: true,
        }
    }
}

/// A bending point: the line and its curvature there, and what the three vectors count in `u` and in `w`.
#[derive(Clone, Copy)]
struct BendingPoint<'a, N, const D: usize> {
    at: &'a Line<N, D>,
    now: &'a Curvature<N>,
    s: &'a [N; 3],
    c: &'a [N; 3],
}

/// A matrix over the three vectors that grows, lower triangle: products of vectors, and multiples of 1.
struct Sum<N, const D: usize> {
    products: [[Square<N, D>; 3]; 3],
    multiples: [[N; 3]; 3],
}

impl<N: Real, const D: usize> Sum<N, D> {
    /// Adds `a b^T` to a block.
    #[inline(always)]
    fn add_block(&mut self, i: usize, j: usize, a: &Components<N, D>, b: &Components<N, D>) {
        for r in 0..D {
            for c in 0..if i == j { r + 1 } else { D } {
                let sum = &mut self.products[i][j][r][c];
                *sum = a[r].times_plus(b[c], *sum);
            }
        }
    }

    /// Adds `a b^T` over all three vectors.
    #[inline(always)]
    fn add_products(&mut self, a: &[Components<N, D>; 3], b: &[Components<N, D>; 3]) {
        for i in 0..3 {
            for j in 0..=i {
                self.add_block(i, j, &a[i], &b[j]);
            }
        }
    }

    /// Adds the antisymmetric matrix of `contract` to a block.
    #[inline(always)]
    fn add_twist(&mut self, i: usize, j: usize, m: &[N; TURNS]) {
        let (block, mut k) = (&mut self.products[i][j], 0);
        for r in 0..D {
            for c in r + 1..D {
                block[r][c] += m[k];
                block[c][r] = block[c][r] - m[k];
                k += 1;
            }
        }
    }

    #[inline(always)]
    fn whole(mut self) -> [[Square<N, D>; 3]; 3] {
        for i in 0..3 {
            for j in 0..=i {
                let block = &mut self.products[i][j];
                for r in 0..D {
                    block[r][r] += self.multiples[i][j];
                    if i == j {
                        for c in 0..r {
                            block[c][r] = block[r][c];
                        }
                    }
                }
            }
        }
        self.products
    }
}

impl<N: Real> Kernel<N> {
    /// Tangent over the three vectors, lower triangle.
    #[inline(always)]
    pub fn tangent<const D: usize>(
        &self,
        e: &[Components<N, D>; 4],
        rate: Option<&[Components<N, D>; 4]>,
        factors: Factors<N>,
    ) -> [[Square<N, D>; 3]; 3] {
        let v = self.vectors(e);
        let dv = of_rate!(rate, rate => self.vectors(rate));
        let zero = self.number(0.0);
        let mut sum = Sum {
            products: [[[[zero; D]; D]; 3]; 3],
            multiples: [[zero; 3]; 3],
        };
        let motion = Motion { v: &v, dv: &dv };
        at_axial_points!(self, add_axial_tangent(motion, factors, &mut sum));
        if self.bends {
            at_bending_points!(self, add_bending_tangent(motion, factors, &mut sum));
        }
        sum.whole()
    }

    #[inline(always)]
    fn add_axial_tangent<const D: usize>(
        &self,
        index: usize,
        point: &Sample,
        Motion { v, dv }: Motion<N, D>,
        factors: Factors<N>,
        sum: &mut Sum<N, D>,
    ) {
        let u = combine(&point.slope, v);
        let du = of_rate!(dv, dv => combine(&point.slope, dv));
        let ((force, f, g), _) = self.axial_force(index, &u, du);
        let force = factors.stress * force;
        let along = factors.axial * self.axial_stiffness[index] * f * f + force * g;
        let (scaled, multiple) = (times(&u, along), force * f);
        for i in 0..3 {
            for j in 0..=i {
                let weight = point.weight * point.slope[i] * point.slope[j];
                if weight == 0.0 {
                    continue;
                }
                let weight = self.number(weight);
                sum.multiples[i][j] = multiple.times_plus(weight, sum.multiples[i][j]);
                let weighted = times(&scaled, weight);
                sum.add_block(i, j, &weighted, &u);
            }
        }
    }

    /// With `g` the gradient of a curvature and `m` the moment, the second derivatives of the energy by
    /// `u` and `w` are `EI g g^T` and `m` times those of the curvature; combined with the weights of the
    /// three vectors all of them are products of vectors, multiples of 1 and multiples of `contract`.
    #[inline(always)]
    fn add_bending_tangent<const D: usize>(
        &self,
        index: usize,
        point: &Sample,
        Motion { v, dv }: Motion<N, D>,
        factors: Factors<N>,
        sum: &mut Sum<N, D>,
    ) {
        let at = self.line(point, v);
        let rate = of_rate!(dv, dv => self.line(point, dv));
        let now = self.curvature(&at);
        let weight = self.number(point.weight);
        let m = times(
            &self.moment(index, &at, rate, &now).0,
            factors.stress * weight,
        );
        let s: [N; 3] = each!([weight; 3], i => self.number(point.slope[i]));
        let c: [N; 3] = each!([weight; 3], i => {
            self.number(point.curvature[i]) * self.inverse_length
        });
        let stiffness = factors.bending * self.bending_stiffness[index] * weight;
        let place = BendingPoint {
            at: &at,
            now: &now,
            s: &s,
            c: &c,
        };
        self.add_material(place, stiffness, factors.of_size, sum);
        let along = now.decay * inner::<N, D>(&m, &now.value);
        let m = times(&m, now.scale);
        let (mu, mw) = (contract(&m, &at.u), contract(&m, &at.w));
        // 4 p (p + 1) / a^2 = (2 p / a) (2 p / a + 2 / a), half of it on both sides.
        let half = along * (self.number(0.5) * now.decay + now.inverse);
        let (mut a, mut b) = ([at.u; 3], [at.u; 3]);
        for i in 0..3 {
            a[i] = times(&at.u, s[i]);
            b[i] = each!(at.u, d => {
                at.u[d].times_plus(half * s[i], now.decay * (mw[d] * s[i] - mu[d] * c[i]))
            });
        }
        sum.add_products(&a, &b);
        sum.add_products(&b, &a);
        for i in 0..3 {
            for j in 0..=i {
                let multiple = along * self.number(point.slope[i] * point.slope[j]);
                sum.multiples[i][j] = sum.multiples[i][j] - multiple;
                if i != j {
                    let twist = s[i] * c[j] - c[i] * s[j];
                    sum.add_twist(i, j, &times(&m, twist));
                }
            }
        }
    }

    /// Adds products of the gradients of the curvature, or in space of its size alone.
    #[inline(always)]
    fn add_material<const D: usize>(
        &self,
        BendingPoint { at, now, s, c }: BendingPoint<'_, N, D>,
        stiffness: N,
        of_size: bool,
        sum: &mut Sum<N, D>,
    ) {
        let (plane, straight) = self.plane::<D>(now);
        let of_size = D > 2 && of_size;
        for k in 0..if of_size { 1 + turns(D) } else { turns(D) } {
            let (mut unit, mut stiffness) = ([self.number(0.0); TURNS], stiffness);
            if k == turns(D) {
                unit = plane;
            } else {
                unit[k] = self.number(1.0);
                if of_size {
                    stiffness = stiffness * straight;
                }
            }
            let along = now.decay * inner::<N, D>(&unit, &now.value);
            let unit = times(&unit, now.scale);
            let (by_w, across) = (contract(&unit, &at.u), contract(&unit, &at.w));
            let by_u = each!(at.u, d => at.u[d].times_plus(along, across[d]));
            let mut g = [by_u; 3];
            for i in 0..3 {
                g[i] = each!(by_u, d => by_w[d] * c[i] - by_u[d] * s[i]);
            }
            let scaled = [
                times(&g[0], stiffness),
                times(&g[1], stiffness),
                times(&g[2], stiffness),
            ];
            sum.add_products(&scaled, &g);
        }
    }

    /// From the three vectors back to the coordinates: blocks of the second end with the first,
    /// and of each end with itself, both vectors of an end together: first end, second with
    /// first, second end.
    #[inline(always)]
    pub fn ends<const D: usize>(&self, sum: &[[Square<N, D>; 3]; 3]) -> EndBlocks<N, D> {
        let l = self.length;
        let chord = scaled(&sum[0][0], self.inverse_length);
        let (a, b) = (sum[1][0], sum[2][0]);
        let (aa, ba, bb) = (
            scaled(&sum[1][1], l),
            scaled(&sum[2][1], l),
            scaled(&sum[2][2], l),
        );
        let minus = self.number(-1.0);
        let away = scaled(&chord, minus);
        [
            [
                [chord, transposed(&scaled(&a, minus))],
                [scaled(&a, minus), aa],
            ],
            [[away, transposed(&a)], [scaled(&b, minus), ba]],
            [[chord, transposed(&b)], [b, bb]],
        ]
    }
}

#[inline(always)]
fn scaled<N: Real, const D: usize>(a: &Square<N, D>, factor: N) -> Square<N, D> {
    let mut out = *a;
    for row in &mut out {
        *row = times(row, factor);
    }
    out
}

#[inline(always)]
pub(in crate::elements::cable) fn transposed<N: Real, const D: usize>(
    a: &Square<N, D>,
) -> Square<N, D> {
    let mut out = *a;
    for i in 0..D {
        for j in 0..D {
            out[i][j] = a[j][i];
        }
    }
    out
}
