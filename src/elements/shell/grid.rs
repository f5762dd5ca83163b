//! The surface of an element at the points that forces are computed at: bicubic Hermite polynomials, one direction after the other.
//!
//! Source: F. K. Bogner, R. L. Fox, L. A. Schmit, The generation of interelement-compatible stiffness and mass matrices by the use of
//! interpolation formulas (1965), section 5.

use crate::elements::rod::vectors::Vector;
use crate::math::lanes::Real;

/// Coordinates of an element, or rates of them or forces on them, by the function along either direction: position and slope at the first
/// end, position and slope at the second. Slopes are by `xi` and `eta`, which go from 0 to 1 over the element.
pub(super) type Corners<N> = [[Vector<N>; 4]; 4];

/// Places in either direction: both ends and the middle (Lobatto), and the middle and two places beside it (Gauss). Even ones are the former,
/// the three inner ones the latter.
pub(super) const PLACES: usize = 5;

/// Distances of places from the middle.
pub(super) const AT: [f64; PLACES] = [-0.5, -GAUSS, 0.0, GAUSS, 0.5];

/// sqrt(15) / 10.
const GAUSS: f64 = 0.387_298_334_620_741_7;

/// Weights of the three inner places.
pub(super) const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

/// Derivatives of the position at the places of an element, or forces conjugate to them. First derivatives are there where membrane strains
/// or curvatures ask for them, second ones at inner places.
#[derive(Clone, Copy)]
pub(super) struct Grid<N> {
    /// By `xi` and by `eta`.
    pub first: [[[Vector<N>; PLACES]; PLACES]; 2],
    /// By `xi` twice, by `eta` twice, by both.
    pub second: [[[Vector<N>; 3]; 3]; 3],
}

/// Values, slopes and second derivatives at the three inner places of a cubic, or forces on them.
struct Inner<N> {
    values: [N; 3],
    slopes: [N; 3],
    bends: [N; 3],
}

/// Coefficients of a cubic of the distance from the middle.
type Coefficients<N> = [N; 4];

impl<N: Real> Inner<N> {
    /// From values and slopes at both ends: value, slope, value, slope.
    #[inline(always)]
    fn of([f, s, g, t]: [N; 4]) -> Self {
        let number = |value: f64| f.constant(value);
        let (rise, slopes, bend, x) = (g - f, s + t, t - s, GAUSS);
        let first = rise.times_plus(number(1.5), slopes * number(-0.25));
        let third = slopes - (rise + rise);
        let middle = bend.times_plus(number(-0.125), (f + g) * number(0.5));
        let value_even = bend.times_plus(number(0.5 * x * x), middle);
        let value_odd = third.times_plus(number(x * x * x), first * number(x));
        let slope_even = third.times_plus(number(3.0 * x * x), first);
        let (slope_odd, bend_odd) = (bend * number(x), third * number(6.0 * x));
        Self {
            values: [value_even - value_odd, middle, value_even + value_odd],
            slopes: [slope_even - slope_odd, first, slope_even + slope_odd],
            bends: [bend - bend_odd, bend, bend + bend_odd],
        }
    }

    /// Forces on values and slopes at both ends.
    #[inline(always)]
    fn back(&self) -> [N; 4] {
        on_ends(on_bends(
            &self.bends,
            on_slopes(&self.slopes, on_values(&self.values)),
        ))
    }
}

/// Forces on coefficients, of forces on values.
#[inline(always)]
fn on_values<N: Real>(f: &[N; 3]) -> Coefficients<N> {
    let number = |value: f64| f[0].constant(value);
    let (sum, odd, x) = (f[0] + f[2], f[2] - f[0], GAUSS);
    [
        sum + f[1],
        odd * number(x),
        sum * number(x * x),
        odd * number(x * x * x),
    ]
}

/// Adds forces on coefficients, of forces on slopes.
#[inline(always)]
fn on_slopes<N: Real>(f: &[N; 3], [c0, c1, c2, c3]: Coefficients<N>) -> Coefficients<N> {
    let number = |value: f64| f[0].constant(value);
    let (sum, odd, x) = (f[0] + f[2], f[2] - f[0], GAUSS);
    [
        c0,
        c1 + (sum + f[1]),
        odd.times_plus(number(2.0 * x), c2),
        sum.times_plus(number(3.0 * x * x), c3),
    ]
}

/// Adds forces on coefficients, of forces on second derivatives.
#[inline(always)]
fn on_bends<N: Real>(f: &[N; 3], [c0, c1, c2, c3]: Coefficients<N>) -> Coefficients<N> {
    let number = |value: f64| f[0].constant(value);
    let (sum, odd) = (f[0] + f[1] + f[2], f[2] - f[0]);
    [
        c0,
        c1,
        sum.times_plus(number(2.0), c2),
        odd.times_plus(number(6.0 * GAUSS), c3),
    ]
}

/// Forces on values and slopes at both ends, of those on coefficients.
#[inline(always)]
fn on_ends<N: Real>([c0, c1, c2, c3]: Coefficients<N>) -> [N; 4] {
    let number = |value: f64| c0.constant(value);
    let (even, odd) = (c0 * number(0.5), c1.times_plus(number(1.5), -(c3 + c3)));
    let slope = c1.times_plus(number(-0.25), c3);
    let bend = c0.times_plus(number(0.125), c2 * number(-0.5));
    [even - odd, slope + bend, even + odd, slope - bend]
}

/// A component of three vectors, from the `first` on.
#[inline(always)]
fn component<N: Real, const K: usize>(of: &[Vector<N>; K], first: usize, d: usize) -> [N; 3] {
    [of[first][d], of[first + 1][d], of[first + 2][d]]
}

/// Values, slopes and second derivatives by `xi` at a place, each by the function along `eta`, of one component.
type Line<N> = [[N; 4]; 3];

impl<N: Real> Grid<N> {
    /// Zeros.
    #[inline(always)]
    pub fn zeros(like: N) -> Self {
        let zero = [like.constant(0.0); 3];
        Self {
            first: [[[zero; PLACES]; PLACES]; 2],
            second: [[[zero; 3]; 3]; 3],
        }
    }

    /// From coordinates of the element.
    #[inline(always)]
    pub fn of(e: &Corners<N>) -> Self {
        let mut grid = Self::zeros(e[0][0][0]);
        grid.fill(e);
        grid
    }

    /// Overwrites it with that of coordinates of the element. What no strain needs stays.
    #[inline(always)]
    pub fn fill(&mut self, e: &Corners<N>) {
        for d in 0..3 {
            let mut lines: [Line<N>; PLACES] = [[[e[0][0][d]; 4]; 3]; PLACES];
            for beta in 0..4 {
                let ends = [e[0][beta][d], e[1][beta][d], e[2][beta][d], e[3][beta][d]];
                let inner = Inner::of(ends);
                for i in 0..3 {
                    lines[i + 1][0][beta] = inner.values[i];
                    lines[i + 1][1][beta] = inner.slopes[i];
                    lines[i + 1][2][beta] = inner.bends[i];
                }
                for end in 0..2 {
                    lines[4 * end][0][beta] = ends[2 * end];
                    lines[4 * end][1][beta] = ends[2 * end + 1];
                }
            }
            self.fill_end(0, d, &lines[0]);
            self.fill_inner::<false>(1, d, &lines[1]);
            self.fill_inner::<true>(2, d, &lines[2]);
            self.fill_inner::<false>(3, d, &lines[3]);
            self.fill_end(4, d, &lines[4]);
        }
    }

    /// At an end of the first direction.
    #[inline(always)]
    fn fill_end(&mut self, i: usize, d: usize, [value, slope, _]: &Line<N>) {
        let inner = Inner::of(*slope).values;
        self.first[0][i][0][d] = slope[0];
        for j in 0..3 {
            self.first[0][i][j + 1][d] = inner[j];
        }
        self.first[0][i][4][d] = slope[2];
        self.first[1][i][0][d] = value[1];
        self.first[1][i][2][d] = Inner::of(*value).slopes[1];
        self.first[1][i][4][d] = value[3];
    }

    /// At an inner place of the first direction; the middle is one of Lobatto's too.
    #[inline(always)]
    fn fill_inner<const IS_MIDDLE: bool>(
        &mut self,
        i: usize,
        d: usize,
        [value, slope, bend]: &Line<N>,
    ) {
        let (of_value, of_slope) = (Inner::of(*value), Inner::of(*slope));
        let of_bend = Inner::of(*bend).values;
        if IS_MIDDLE {
            self.first[0][i][0][d] = slope[0];
            self.first[0][i][4][d] = slope[2];
        }
        self.first[1][i][0][d] = value[1];
        self.first[1][i][4][d] = value[3];
        for j in 0..3 {
            self.first[0][i][j + 1][d] = of_slope.values[j];
            self.first[1][i][j + 1][d] = of_value.slopes[j];
            self.second[0][i - 1][j][d] = of_bend[j];
            self.second[1][i - 1][j][d] = of_value.bends[j];
            self.second[2][i - 1][j][d] = of_slope.slopes[j];
        }
    }

    /// Forces on the coordinates of the element.
    #[inline(always)]
    pub fn back(&self) -> Corners<N> {
        let mut e = [[self.first[0][0][0]; 4]; 4];
        for d in 0..3 {
            let lines = [
                self.back_end(0, d),
                self.back_inner::<false>(1, d),
                self.back_inner::<true>(2, d),
                self.back_inner::<false>(3, d),
                self.back_end(4, d),
            ];
            for beta in 0..4 {
                let [_, a, b, c, _] = &lines;
                let forces = Inner {
                    values: [a[0][beta], b[0][beta], c[0][beta]],
                    slopes: [a[1][beta], b[1][beta], c[1][beta]],
                    bends: [a[2][beta], b[2][beta], c[2][beta]],
                };
                let forces = forces.back();
                for end in 0..2 {
                    let line = &lines[4 * end];
                    e[2 * end][beta][d] = forces[2 * end] + line[0][beta];
                    e[2 * end + 1][beta][d] = forces[2 * end + 1] + line[1][beta];
                }
            }
        }
        e
    }

    /// The transpose of [`Self::fill_end`].
    #[inline(always)]
    fn back_end(&self, i: usize, d: usize) -> Line<N> {
        let [along, across] = &self.first;
        let mut slope = on_ends(on_values(&component(&along[i], 1, d)));
        slope[0] += along[i][0][d];
        slope[2] += along[i][4][d];
        let middle = across[i][2][d];
        let rise = middle * middle.constant(1.5);
        let turn = middle * middle.constant(-0.25);
        let value = [-rise, turn + across[i][0][d], rise, turn + across[i][4][d]];
        [value, slope, value]
    }

    /// The transpose of [`Self::fill_inner`].
    #[inline(always)]
    fn back_inner<const IS_MIDDLE: bool>(&self, i: usize, d: usize) -> Line<N> {
        let [along, across] = &self.first;
        let zero = along[i][1][d].constant(0.0);
        let [by_first, by_second, mixed] = &self.second;
        let of_slope = on_slopes(
            &component(&mixed[i - 1], 0, d),
            on_values(&component(&along[i], 1, d)),
        );
        let mut slope = on_ends(of_slope);
        if IS_MIDDLE {
            slope[0] += along[i][0][d];
            slope[2] += along[i][4][d];
        }
        let of_value = on_slopes(&component(&across[i], 1, d), [zero; 4]);
        let of_value = on_bends(&component(&by_second[i - 1], 0, d), of_value);
        let mut value = on_ends(of_value);
        value[1] += across[i][0][d];
        value[3] += across[i][4][d];
        let bend = on_ends(on_values(&component(&by_first[i - 1], 0, d)));
        [value, slope, bend]
    }
}
