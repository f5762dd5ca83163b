//! The tangent of a planar beam.
//!
//! Source: derivatives of the equations of `planar/mod.rs`. Over the vectors of the line and the angles of the three sections, second
//! derivatives of stretch, angle and curvature are, with `p` the tangent rotated left,
//!
//! ```text
//! n'' = p p^T / n,   psi'' = -(t p^T + p t^T) / n^2,   c'' = (1 + c^2/4) (c/2 (theta')^2 - psi'')
//! k'' = X'' / q - (k' q'^T + q' k'^T) / q - k q'' / q,   k = X / q,   q = u.u
//! ```

use super::PLACES;
use super::kernel::{Kernel, Local, Motion, Place, Two, left, parabola, product};
use crate::elements::beam::{At, Tangent};
use crate::elements::line::{Sample, times};
use crate::elements::rod::geometry::{MIDDLE, POINTS};
use crate::elements::rod::vectors::{add, plus};
use crate::math::lanes::Real;

/// Vectors of the line and angles of the sections.
const SIZE: usize = 9;
type Row<N> = [N; SIZE];
type Square<N> = [Row<N>; SIZE];
/// A matrix over what moves in the plane.
pub(super) type Plane<N> = [[N; PLACES.len()]; PLACES.len()];

/// How the slope of every place follows the vectors of the line.
const WEIGHTS: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], MIDDLE, [0.0, 0.0, 1.0]];

/// Adds `factor (a b^T + b a^T)` on and below the diagonal.
#[inline(always)]
fn add_pair<N: Real>(a: &Row<N>, b: &Row<N>, factor: N, to: &mut Square<N>) {
    for r in 0..SIZE {
        let (left, right) = (a[r] * factor, b[r] * factor);
        for c in 0..=r {
            to[r][c] = left.times_plus(b[c], right.times_plus(a[c], to[r][c]));
        }
    }
}

/// Adds `factor a a^T` on and below the diagonal.
#[inline(always)]
fn add_square<N: Real>(a: &Row<N>, factor: N, to: &mut Square<N>) {
    for r in 0..SIZE {
        let left = a[r] * factor;
        for c in 0..=r {
            to[r][c] = left.times_plus(a[c], to[r][c]);
        }
    }
}

/// A gradient by a vector that is a combination of those of the line, and nothing by angles.
#[inline(always)]
fn over_line<N: Real>(weights: &[f64; 3], v: &Two<N>) -> Row<N> {
    let zero = v[0].constant(0.0);
    let mut row = [zero; SIZE];
    for k in 0..3 {
        for d in 0..2 {
            row[2 * k + d] = v[d] * zero.constant(weights[k]);
        }
    }
    row
}

impl<N: Real> Place<N> {
    /// Gradients of stretch and of the angle between tangent and section.
    #[inline(always)]
    fn gradients(&self, k: usize) -> [Row<N>; 2] {
        let turning = times(&self.turning(), self.size.constant(-1.0));
        let mut theta = over_line(&WEIGHTS[k], &turning);
        theta[6 + k] = self.size.constant(1.0);
        [over_line(&WEIGHTS[k], &self.tangent), theta]
    }

    /// Adds second derivatives of stretch and shear rotation with these factors.
    #[inline(always)]
    fn add_second(&self, k: usize, [stretch, shear_rotation]: [N; 2], to: &mut Square<N>) {
        let [along, theta] = self.gradients(k);
        let half = self.size.constant(0.5);
        let across = over_line(&WEIGHTS[k], &left(&self.tangent));
        add_square(&across, stretch * self.inverse_size, to);
        let by_angle = shear_rotation * self.gain;
        add_square(&theta, by_angle * self.shear_rotation * half, to);
        let square = self.inverse_size * self.inverse_size;
        add_pair(&along, &across, by_angle * square, to);
    }
}

impl<N: Real> Local<N> {
    /// Adds the square of the rates of strain by a matrix.
    #[inline(always)]
    fn add_squares(&self, rows: &[Row<N>; 4], by: &[[N; 3]; 3], weight: N, to: &mut Square<N>) {
        let mut strains = [rows[0]; 3];
        for c in 0..SIZE {
            let rates = self.rates(&[rows[0][c], rows[1][c], rows[2][c], rows[3][c]]);
            for k in 0..3 {
                strains[k][c] = rates[k];
            }
        }
        for k in 0..3 {
            let mut stress = times(&strains[0], by[k][0] * weight);
            stress = plus(&strains[1], by[k][1] * weight, &stress);
            stress = plus(&strains[2], by[k][2] * weight, &stress);
            for r in 0..SIZE {
                for c in 0..=r {
                    to[r][c] = strains[k][r].times_plus(stress[c], to[r][c]);
                }
            }
        }
    }

    /// Adds `-factor (k' q'^T + q' k'^T) / q` of the curvature's second derivatives; `bending` is `k'`.
    #[inline(always)]
    fn add_by_size(&self, point: &Sample, bending: &Row<N>, factor: N, to: &mut Square<N>) {
        let by = factor * self.inverse;
        let along = over_line(&point.slope, &times(&self.slope, by.constant(2.0)));
        add_pair(bending, &along, -by, to);
    }

    /// Adds `factor (X'' - k q'') / q` of the curvature's second derivatives.
    #[inline(always)]
    fn add_by_slopes(&self, point: &Sample, factor: N, inverse_length: N, to: &mut Square<N>) {
        let by = factor * self.inverse;
        let isotropic = -(by * (self.curvature + self.curvature));
        let skew = by * inverse_length;
        for i in 0..3 {
            for j in 0..=i {
                let (a, b) = (&point.slope, &point.curvature);
                let same = isotropic * by.constant(a[i] * a[j]);
                let turned = skew * by.constant(a[i] * b[j] - b[i] * a[j]);
                to[2 * i][2 * j] += same;
                to[2 * i + 1][2 * j + 1] += same;
                to[2 * i + 1][2 * j] += -turned;
                if j < i {
                    to[2 * i][2 * j + 1] += turned;
                }
            }
        }
    }
}

impl<N: Real> Kernel<N> {
    /// Stiffness or damping, rows with columns up to the diagonal.
    #[inline(always)]
    pub fn tangent(&self, at: &At<N>, motion: Option<&Motion<N>>, kind: Tangent) -> Plane<N> {
        let v = self.vectors(at);
        let places = self.places(&v, at);
        let moving = of_rate!(motion, motion => self.rates(&places, motion));
        let zero = self.number(0.0);
        let mut sum = [[zero; SIZE]; SIZE];
        let mut on_places = [[zero; 2]; 3];
        let gradients = [
            places[0].gradients(0),
            places[1].gradients(1),
            places[2].gradients(2),
        ];
        for (index, point) in POINTS.iter().enumerate() {
            let local = self.local(point, &v, &places);
            let weight = self.number(point.weight);
            let rows = self.rows(point, &local, &places, &gradients);
            let by = match kind {
                Tangent::Stiffness => &self.law.stiffness[index],
                Tangent::Damping => &self.law.damping[index],
            };
            local.add_squares(&rows, by, weight, &mut sum);
            if kind == Tangent::Damping {
                continue;
            }
            let strains = add(&local.strains(), &self.law.offset[index]);
            let mut stress = product(by, &strains);
            if let Some((dv, moving)) = &moving {
                let rate = self.strain_rates(point, &local, dv, moving);
                stress = add(&stress, &product(&self.law.damping[index], &rate));
            }
            let stress = times(&stress, weight);
            self.add_stressed(&local, &rows, &stress, &mut sum);
            let [stretch, shear_rotation, change, moment] = local.factors(&stress);
            let change = change * self.inverse_length;
            let shapes = parabola(point.at);
            for k in 0..3 {
                let shape = self.number(shapes[0][k]);
                on_places[k][0] = stretch.times_plus(shape, on_places[k][0]);
                on_places[k][1] = shear_rotation.times_plus(shape, on_places[k][1]);
                on_places[k][1] = change.times_plus(self.number(shapes[1][k]), on_places[k][1]);
            }
            local.add_by_size(point, &rows[3], moment, &mut sum);
            local.add_by_slopes(point, moment, self.inverse_length, &mut sum);
        }
        if kind == Tangent::Stiffness {
            for k in 0..3 {
                places[k].add_second(k, on_places[k], &mut sum);
            }
        }
        self.over_nodes(&sum)
    }

    /// Gradients of stretch, shear rotation, its change and curvature at a point.
    #[inline(always)]
    fn rows(
        &self,
        point: &Sample,
        local: &Local<N>,
        places: &[Place<N>; 3],
        gradients: &[[Row<N>; 2]; 3],
    ) -> [Row<N>; 4] {
        let shapes = parabola(point.at);
        let [by_slope, by_second] = local.bending(self.inverse_length);
        let bending = over_line(&point.slope, &by_slope);
        let bending = add(&bending, &over_line(&point.curvature, &by_second));
        let zero = [self.number(0.0); SIZE];
        let mut rows = [zero, zero, zero, bending];
        for k in 0..3 {
            let [along, theta] = &gradients[k];
            let (shape, slope) = (self.number(shapes[0][k]), self.number(shapes[1][k]));
            rows[0] = plus(along, shape, &rows[0]);
            rows[1] = plus(theta, places[k].gain * shape, &rows[1]);
            let slope = slope * self.inverse_length;
            rows[2] = plus(theta, places[k].gain * slope, &rows[2]);
        }
        rows
    }

    /// Adds second derivatives of the strains by stretch, shear rotation and its change, taken with stresses.
    #[inline(always)]
    fn add_stressed(
        &self,
        local: &Local<N>,
        [stretch, shear_rotation, change, _]: &[Row<N>; 4],
        [axial, shear, moment]: &[N; 3],
        to: &mut Square<N>,
    ) {
        let (d, n, half) = (local.shrink, local.stretch, self.number(0.5));
        let (falls, [cosine, sine]) = (local.shrinking(), [local.cosine, local.sine]);
        let across = *shear * cosine - *axial * sine;
        let along = *axial * cosine + *shear * sine;
        // `D'' = -D^2 / 2 + D sin(theta)^2 / 2`.
        let second = half * d * (sine * sine - d);
        add_pair(stretch, shear_rotation, d * across, to);
        let by_shear_rotation =
            n * (falls * across - d * d * along) + *moment * local.change * second;
        add_square(shear_rotation, by_shear_rotation, to);
        add_pair(shear_rotation, change, *moment * falls, to);
    }

    /// From vectors of the line and angles to positions, slopes and spins.
    #[inline(always)]
    fn over_nodes(&self, sum: &Square<N>) -> Plane<N> {
        let zero = self.number(0.0);
        // Of every place: what it is in the sum, and how often.
        let chord = self.inverse_length;
        let one = self.number(1.0);
        let places = [
            (0, -chord),
            (1, -chord),
            (2, one),
            (3, one),
            (6, one),
            (0, chord),
            (1, chord),
            (4, one),
            (5, one),
            (8, one),
            (7, one),
        ];
        let mut out = [[zero; PLACES.len()]; PLACES.len()];
        for r in 0..PLACES.len() {
            for c in 0..=r {
                let ((i, a), (j, b)) = (places[r], places[c]);
                let entry = if i >= j { sum[i][j] } else { sum[j][i] };
                out[r][c] = entry * a * b * self.length;
            }
        }
        out
    }
}
