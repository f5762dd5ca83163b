//! The tangent: second derivatives of the energy along a motion with constant rates of the line, angular velocities of the sections,
//! internal twist and shear rotations.
//!
//! Source: twice the derivative by time of the equations of `beam/mod.rs`. At a point the energy changes by the squares of the rates
//! of stretch, rotating, shear rotation and its change (`beam/shear_rotation.rs`), and by the second derivatives of the first two, those of rotating the
//! rod's; at the ends by those of shear rotation and of rotation of the tangent's frame (`beam/end.rs`).

use super::end::End;
use super::kernel::{Kernel, Placed, Shapes};
use super::shear_rotation::{Eight, Local};
use super::{At, Matrix, Rates, Tangent, VELOCITIES};
use crate::elements::line::{Sample, times};
use crate::elements::rod;
use crate::elements::rod::geometry::{POINTS, PlacedSection, Sum};
use crate::elements::rod::kernel::product;
use crate::elements::rod::stretch::LengthDerivatives;
use crate::elements::rod::tangent::Curved;
use crate::elements::rod::vectors::{add, plus};
use crate::math::lanes::Real;

/// Places of the velocities of a rod.
const ROD: [usize; rod::VELOCITIES] = [0, 1, 2, 3, 4, 5, 6, 9, 10, 11, 12, 13, 14, 15, 18];

/// Places of position and slope at the first end, and at the last.
const SLOPES: [usize; 4] = [0, 3, 9, 12];

/// Places of the shear rotations at the first end, at the last and inside.
const SHEAR_ROTATIONS: [usize; 6] = [7, 8, 16, 17, 19, 20];

/// Lengths of the slope at the first end, in the middle and at the last end, then the shear rotations.
const MORE: usize = 9;

/// Second derivatives of the energy, summed over sections.
struct Total<N> {
    rod: Curved<N>,
    /// Second derivatives by the coordinates of a rod and by lengths of the slope and shear rotations.
    mixed: [Sum<N>; MORE],
    more: [[N; MORE]; MORE],
    /// First derivatives by the same.
    factors: [N; MORE],
}

impl<N: Real> Kernel<N> {
    /// The tangent: stiffness with the stresses that damping adds where there are rates, or damping matrix; rows with columns up to
    /// the diagonal.
    #[inline(always)]
    pub fn tangent(&self, at: &At<N>, rates: Option<&Rates<N>>, kind: Tangent) -> Matrix<N> {
        let (geometry, placed) = (&self.geometry, self.placed(at));
        let moving = of_rate!(rates, rates => self.moving(&placed, rates));
        let zero = geometry.number(0.0);
        let mut sum = Total {
            rod: Curved::nothing(zero),
            mixed: [Sum::nothing(zero); MORE],
            more: [[zero; MORE]; MORE],
            factors: [zero; MORE],
        };
        for (index, point) in POINTS.iter().enumerate() {
            let (section, sheared) = self.section(point, &placed);
            let rows = sheared.rows();
            let (squares, turning) = match kind {
                Tangent::Damping => (rows.squares(&self.law.damping[index]), None),
                Tangent::Stiffness => {
                    let strains = add(&sheared.strains(), &self.law.offset[index]);
                    let mut stress = product(&self.law.stiffness[index], &strains);
                    if let Some(moving) = &moving {
                        let local = self.local_rates(point, &section, &placed, moving);
                        let rate = rows.rates(&local);
                        stress = add(&stress, &product(&self.law.damping[index], &rate));
                    }
                    let mut squares = rows.squares(&self.law.stiffness[index]);
                    sheared.add_second(&stress, &mut squares);
                    let factors = rows.factors(&times(&stress, geometry.number(point.weight)));
                    self.add_factors(point, &factors, &mut sum.factors);
                    (squares, Some(factors.turning))
                }
            };
            let at = PlacedSection {
                point,
                section: &section,
                frame: &placed.frame,
            };
            self.add_point(at, &squares, turning.as_ref(), &mut sum);
        }
        self.assemble(&placed, &mut sum, kind)
    }

    /// Adds what factors at a point count by lengths of the slope and shear rotations.
    #[inline(always)]
    fn add_factors(&self, point: &Sample, local: &Local<N>, factors: &mut [N; MORE]) {
        let (geometry, shapes) = (&self.geometry, Shapes::new(point.at));
        for k in 0..3 {
            let value = geometry.number(shapes.shear_rotation[k]);
            let slope = geometry.inverse_length * geometry.number(shapes.change[k]);
            factors[k] = local
                .stretch
                .times_plus(geometry.number(shapes.stretch[k]), factors[k]);
            for part in 0..2 {
                let both = local.shear_rotation[part].times_plus(value, local.change[part] * slope);
                factors[3 + 2 * k + part] += both;
            }
        }
    }

    /// Adds a point: squares of the rates there, and the second derivatives of rotating taken with its factors.
    #[inline(always)]
    fn add_point(
        &self,
        at: PlacedSection<'_, N>,
        squares: &Eight<N>,
        turning: Option<&[N; 3]>,
        sum: &mut Total<N>,
    ) {
        let point = at.point;
        let (geometry, zero) = (&self.geometry, self.geometry.number(0.0));
        let mut by = [[zero; 3]; 3];
        for r in 0..3 {
            by[r].copy_from_slice(&squares[1 + r][1..4]);
        }
        geometry.add_curved(at, &by, turning, &mut sum.rod);
        // Columns of stretch, shear rotation and its change, weighted.
        let weight = geometry.number(point.weight);
        let mut columns = [[zero; 8]; 5];
        for (column, c) in columns.iter_mut().zip([0, 4, 5, 6, 7]) {
            *column = times(&squares[c], weight);
        }
        let shapes = Shapes::new(point.at);
        let mut wide = [[zero; 8]; MORE];
        for k in 0..3 {
            wide[k] = times(&columns[0], geometry.number(shapes.stretch[k]));
            let value = geometry.number(shapes.shear_rotation[k]);
            let slope = geometry.inverse_length * geometry.number(shapes.change[k]);
            for part in 0..2 {
                let of_shear_rotation = times(&columns[1 + part], value);
                wide[3 + 2 * k + part] = plus(&columns[3 + part], slope, &of_shear_rotation);
            }
        }
        for (e, column) in wide.iter().enumerate() {
            let local = Local {
                stretch: column[0],
                turning: [column[1], column[2], column[3]],
                shear_rotation: [column[4], column[5]],
                change: [column[6], column[7]],
            };
            geometry.add_section(at, &local.turning, &mut sum.mixed[e]);
            self.add_factors(point, &local, &mut sum.more[e]);
        }
    }

    /// From the sums to all velocities, in rows with columns up to the diagonal.
    #[inline(always)]
    fn assemble(&self, placed: &Placed<N>, sum: &mut Total<N>, kind: Tangent) -> Matrix<N> {
        let (geometry, frame, l) = (&self.geometry, &placed.frame, self.geometry.length);
        let zero = geometry.number(0.0);
        let mut matrix = [[zero; VELOCITIES]; VELOCITIES];
        let torques = geometry.torques(&sum.rod);
        let rod = geometry.whole(frame, &mut sum.rod);
        for r in 0..ROD.len() {
            for c in 0..ROD.len() {
                matrix[ROD[r]][ROD[c]] = rod[r][c];
            }
        }
        // The slopes' lengths with all others.
        let mut mixed_lengths = [[zero; VELOCITIES]; 3];
        for e in 0..MORE {
            let mixed = geometry.spread(frame, &sum.mixed[e]).flat();
            for k in 0..ROD.len() {
                let value = -mixed[k];
                if e < 3 {
                    mixed_lengths[e][ROD[k]] = value;
                } else {
                    let place = SHEAR_ROTATIONS[e - 3];
                    (matrix[place][ROD[k]], matrix[ROD[k]][place]) = (value, value);
                }
            }
            for k in 0..6 {
                let value = sum.more[e][3 + k] * l;
                if e < 3 {
                    mixed_lengths[e][SHEAR_ROTATIONS[k]] = value;
                } else {
                    matrix[SHEAR_ROTATIONS[e - 3]][SHEAR_ROTATIONS[k]] = value;
                }
            }
        }
        let mut lengths = LengthDerivatives {
            first: [sum.factors[0], sum.factors[1], sum.factors[2]],
            second: each!([[zero; 3]; 3], i => [sum.more[i][0], sum.more[i][1], sum.more[i][2]]),
            mixed: mixed_lengths,
        };
        geometry.add_second_lengths(frame, SLOPES, &mut lengths, &mut matrix);
        by_sections(&placed.ends, &mut matrix);
        if kind == Tangent::Stiffness {
            for k in 0..2 {
                let f = &sum.factors[3 + 2 * k..5 + 2 * k];
                let second = placed.ends[k].second(torques[k], &[f[0] * l, f[1] * l]);
                for r in 0..6 {
                    for c in 0..6 {
                        matrix[9 * k + 3 + r][9 * k + 3 + c] += second[r][c];
                    }
                }
            }
        }
        matrix
    }
}

/// From rotations of the tangents' frames and shear rotations at the ends to angular velocities of the sections: rows with columns up to the
/// diagonal.
#[inline(always)]
fn by_sections<N: Real>(ends: &[End<N>; 2], matrix: &mut Matrix<N>) {
    for k in 0..2 {
        let (end, u, s) = (&ends[k], 9 * k + 3, 9 * k + 6);
        for c in 0..u {
            let (by_u, moment) = end.load(matrix[s][c], &[matrix[s + 1][c], matrix[s + 2][c]]);
            for d in 0..3 {
                matrix[u + d][c] += by_u[d];
                matrix[s + d][c] = moment[d];
            }
        }
        for row in &mut matrix[s + 3..] {
            let (by_u, moment) = end.load(row[s], &[row[s + 1], row[s + 2]]);
            for d in 0..3 {
                row[u + d] += by_u[d];
            }
            row[s..s + 3].copy_from_slice(&moment);
        }
        // The end with itself: columns, then rows.
        let zero = ends[0].size.constant(0.0);
        let (mut with_u, mut own) = ([[zero; 3]; 3], [[zero; 3]; 3]);
        for i in 0..3 {
            let old = each!([zero; 3], j => matrix[s + i.max(j)][s + i.min(j)]);
            let (by_u, moment) = end.load(old[0], &[old[1], old[2]]);
            for j in 0..3 {
                with_u[j][i] = matrix[s + i][u + j] + by_u[j];
                own[j][i] = moment[j];
            }
        }
        for j in 0..3 {
            let old = each!([zero; 3], i => matrix[s + i][u + j]);
            let (first, _) = end.load(old[0], &[old[1], old[2]]);
            let (second, mixed) = end.load(with_u[j][0], &[with_u[j][1], with_u[j][2]]);
            let (_, moment) = end.load(own[j][0], &[own[j][1], own[j][2]]);
            for i in 0..3 {
                matrix[u + j][u + i] += first[i];
                matrix[u + i][u + j] += second[i];
                matrix[s + i][u + j] = mixed[i];
                matrix[s + i][s + j] = moment[i];
            }
        }
    }
}
