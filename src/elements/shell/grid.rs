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

/// Whether the place is one of Lobatto's.
pub(super) const fn is_lobatto(place: usize) -> bool {
    place.is_multiple_of(2)
}

/// Whether the place is one of Gauss.
pub(super) const fn is_gauss(place: usize) -> bool {
    place > 0 && place < 4
}

/// Derivatives of the position at the places of an element, or forces conjugate to them. First derivatives are there where membrane strains
/// or curvatures ask for them, second ones at inner places.
#[derive(Clone, Copy)]
pub(super) struct Grid<N> {
    /// By `xi` and by `eta`.
    pub first: [[[Vector<N>; PLACES]; PLACES]; 2],
    /// By `xi` twice, by `eta` twice, by both.
    pub second: [[[Vector<N>; 3]; 3]; 3],
}

/// Whether the first derivative by direction `of` is needed at a place: at inner ones for curvatures, elsewhere for membrane strains.
pub(super) const fn is_needed(of: usize, i: usize, j: usize) -> bool {
    let (own, other) = if of == 0 { (i, j) } else { (j, i) };
    (is_gauss(own) && is_gauss(other)) || is_lobatto(own)
}

/// A cubic polynomial of the distance from the middle, or what forces on its values do to its coefficients.
#[derive(Clone, Copy)]
pub(super) struct Cubic<N>([Vector<N>; 4]);

impl<N: Real> Cubic<N> {
    /// From values and slopes at both ends: value, slope, value, slope.
    #[inline(always)]
    fn through(e: &[Vector<N>; 4]) -> Self {
        let mut c = [e[0]; 4];
        for d in 0..3 {
            let number = |value: f64| e[0][d].constant(value);
            let [f, s, g, t] = [e[0][d], e[1][d], e[2][d], e[3][d]];
            let (rise, slopes) = (g - f, s + t);
            c[0][d] = (f + g) * number(0.5) + (s - t) * number(0.125);
            c[1][d] = rise * number(1.5) - slopes * number(0.25);
            c[2][d] = (t - s) * number(0.5);
            c[3][d] = slopes - rise - rise;
        }
        Self(c)
    }

    /// Forces on values and slopes at both ends, of those on the coefficients.
    #[inline(always)]
    fn back(&self) -> [Vector<N>; 4] {
        let Self(k) = self;
        let mut e = *k;
        for d in 0..3 {
            let number = |value: f64| k[0][d].constant(value);
            let [c0, c1, c2, c3] = [k[0][d], k[1][d], k[2][d], k[3][d]];
            let (even, odd) = (c0 * number(0.5), c1 * number(1.5) - c3 - c3);
            let (slope, bend) = (
                c3 - c1 * number(0.25),
                c0 * number(0.125) - c2 * number(0.5),
            );
            e[0][d] = even - odd;
            e[1][d] = slope + bend;
            e[2][d] = even + odd;
            e[3][d] = slope - bend;
        }
        e
    }

    #[inline(always)]
    fn zero(like: N) -> Self {
        Self([[like.constant(0.0); 3]; 4])
    }

    /// Value at a place.
    #[inline(always)]
    fn value(&self, place: usize) -> Vector<N> {
        let (Self(c), x) = (self, AT[place]);
        let mut out = c[0];
        if place == 2 {
            return out;
        }
        for d in 0..3 {
            let number = |value: f64| c[0][d].constant(value);
            let even = c[2][d].times_plus(number(x * x), c[0][d]);
            let odd = c[3][d].times_plus(number(x * x), c[1][d]);
            out[d] = odd.times_plus(number(x), even);
        }
        out
    }

    /// Derivative at a place.
    #[inline(always)]
    fn slope(&self, place: usize) -> Vector<N> {
        let (Self(c), x) = (self, AT[place]);
        let mut out = c[1];
        if place == 2 {
            return out;
        }
        for d in 0..3 {
            let number = |value: f64| c[0][d].constant(value);
            let even = c[3][d].times_plus(number(3.0 * x * x), c[1][d]);
            out[d] = c[2][d].times_plus(number(2.0 * x), even);
        }
        out
    }

    /// Second derivative at a place.
    #[inline(always)]
    fn bend(&self, place: usize) -> Vector<N> {
        let (Self(c), x) = (self, AT[place]);
        let mut out = c[2];
        for d in 0..3 {
            let number = |value: f64| c[0][d].constant(value);
            out[d] = c[3][d].times_plus(number(6.0 * x), c[2][d] + c[2][d]);
        }
        out
    }

    /// Adds a force on the value at a place.
    #[inline(always)]
    fn on_value(&mut self, place: usize, force: &Vector<N>) {
        let (Self(k), x) = (self, AT[place]);
        for d in 0..3 {
            let number = |value: f64| force[d].constant(value);
            k[0][d] += force[d];
            if place != 2 {
                k[1][d] = force[d].times_plus(number(x), k[1][d]);
                k[2][d] = force[d].times_plus(number(x * x), k[2][d]);
                k[3][d] = force[d].times_plus(number(x * x * x), k[3][d]);
            }
        }
    }

    /// Adds a force on the derivative at a place.
    #[inline(always)]
    fn on_slope(&mut self, place: usize, force: &Vector<N>) {
        let (Self(k), x) = (self, AT[place]);
        for d in 0..3 {
            let number = |value: f64| force[d].constant(value);
            k[1][d] += force[d];
            if place != 2 {
                k[2][d] = force[d].times_plus(number(2.0 * x), k[2][d]);
                k[3][d] = force[d].times_plus(number(3.0 * x * x), k[3][d]);
            }
        }
    }

    /// Adds a force on the second derivative at a place.
    #[inline(always)]
    fn on_bend(&mut self, place: usize, force: &Vector<N>) {
        let (Self(k), x) = (self, AT[place]);
        for d in 0..3 {
            let number = |value: f64| force[d].constant(value);
            k[2][d] += force[d] + force[d];
            if place != 2 {
                k[3][d] = force[d].times_plus(number(6.0 * x), k[3][d]);
            }
        }
    }
}

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
        let mut along = [Cubic::zero(e[0][0][0]); 4];
        for beta in 0..4 {
            along[beta] = Cubic::through(&[e[0][beta], e[1][beta], e[2][beta], e[3][beta]]);
        }
        for i in 0..PLACES {
            let (mut values, mut slopes, mut bends) = ([e[0][0]; 4], [e[0][0]; 4], [e[0][0]; 4]);
            for beta in 0..4 {
                values[beta] = along[beta].value(i);
                slopes[beta] = along[beta].slope(i);
                bends[beta] = along[beta].bend(i);
            }
            let value = Cubic::through(&values);
            let slope = Cubic::through(&slopes);
            for j in 0..PLACES {
                if is_needed(0, i, j) {
                    grid.first[0][i][j] = slope.value(j);
                }
                if is_needed(1, i, j) {
                    grid.first[1][i][j] = value.slope(j);
                }
            }
            if is_gauss(i) {
                let bend = Cubic::through(&bends);
                for j in 1..4 {
                    grid.second[0][i - 1][j - 1] = bend.value(j);
                    grid.second[1][i - 1][j - 1] = value.bend(j);
                    grid.second[2][i - 1][j - 1] = slope.slope(j);
                }
            }
        }
        grid
    }

    /// Forces on the coordinates of the element.
    #[inline(always)]
    pub fn back(&self) -> Corners<N> {
        let like = self.first[0][0][0][0];
        let mut along = [Cubic::zero(like); 4];
        for i in 0..PLACES {
            let [mut value, mut slope, mut bend] = [Cubic::zero(like); 3];
            for j in 0..PLACES {
                if is_needed(0, i, j) {
                    slope.on_value(j, &self.first[0][i][j]);
                }
                if is_needed(1, i, j) {
                    value.on_slope(j, &self.first[1][i][j]);
                }
            }
            if is_gauss(i) {
                for j in 1..4 {
                    bend.on_value(j, &self.second[0][i - 1][j - 1]);
                    value.on_bend(j, &self.second[1][i - 1][j - 1]);
                    slope.on_slope(j, &self.second[2][i - 1][j - 1]);
                }
            }
            let (values, slopes, bends) = (value.back(), slope.back(), bend.back());
            for beta in 0..4 {
                along[beta].on_value(i, &values[beta]);
                along[beta].on_slope(i, &slopes[beta]);
                if is_gauss(i) {
                    along[beta].on_bend(i, &bends[beta]);
                }
            }
        }
        let mut e = [[[like.constant(0.0); 3]; 4]; 4];
        for beta in 0..4 {
            let forces = along[beta].back();
            for alpha in 0..4 {
                e[alpha][beta] = forces[alpha];
            }
        }
        e
    }
}
