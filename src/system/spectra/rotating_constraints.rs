//! Directions that constraints hold, and what their rotating adds to the linearized equations (`linearization.rs`).

use super::linearization::Linearization;
use crate::bodies::{Node, map_node, no_node};
use crate::math::jet::{Jet, moving};
use crate::math::row_space::RowSpace;
use crate::math::vector::{dot, norm};
use crate::system::joints::View;
use crate::system::{System, Workspace};

/// Part of a unit displacement against a constraint up to which it is kept.
const HELD: f64 = 1e-6;

impl<const D: usize> Linearization<'_, D> {
    /// Orthonormal directions in `q` that constraints hold, in dense rows: memory grows with coordinates times constraints, work with
    /// the square of these.
    pub fn held(&self) -> RowSpace {
        let n = self.elimination.coordinates();
        let mut space = RowSpace::new(self.independent.len(), n);
        for (i, row) in self.independent.iter().enumerate() {
            self.normals.add(*row, 1.0, space.row_mut(i));
        }
        space.factor(0.0);
        space
    }

    /// Whether displacements in `q`, those that vectors begin with, keep the constraints: where solves lose digits they do not, and
    /// what is found with them are frequencies of another system.
    pub fn holds(&self, basis: &[Vec<f64>]) -> bool {
        let n = self.elimination.coordinates();
        let mut row = vec![0.0; n];
        self.independent.iter().all(|index| {
            row.fill(0.0);
            self.normals.add(*index, 1.0, &mut row);
            let size = norm(&row);
            basis
                .iter()
                .all(|column| dot(&row, &column[..n]).abs() <= HELD * size)
        })
    }
}

impl<const D: usize> System<D> {
    /// Adds the part of `K` due to the rotation of constraint directions.
    pub(super) fn add_rotating_constraints(
        &self,
        work: &Workspace<D>,
        at_rest: bool,
        made: &mut Linearization<'_, D>,
    ) {
        let (elimination, n) = (&self.elimination, self.coordinates());
        let is_still = work.kinematics.v.iter().all(|v| *v == no_node())
            && work.kinematics.drives.iter().all(|drive| drive[1] == 0.0);
        if at_rest || is_still || made.independent.is_empty() {
            return;
        }
        made.terms.is_symmetric = false;
        let space = made.held();
        let rates = space.combine(&self.rotating_rows(work, &made.independent));
        let padded = vec![0.0; elimination.assembly.pattern().len()];
        let (mut y, mut x, mut sum) = (vec![0.0; n], padded.clone(), padded);
        for (i, mut rate) in rates.into_iter().enumerate() {
            let unit = space.unit(i);
            if rate.iter().all(|rate| *rate == 0.0) {
                continue;
            }
            // - ((R - M') Q^T + D^T) D
            elimination.forces(&mut rate);
            elimination.displacements(unit, &mut y);
            let assembly = &elimination.assembly;
            assembly.put(&y, &mut x);
            made.terms
                .damping
                .multiply(assembly.pattern(), &x, &mut sum);
            assembly.take(&sum, &mut y);
            let motion = work.kinematics.motion();
            self.bodies.subtract_inertia_rate(motion, unit, &mut y);
            let column = rate.iter().zip(&y).map(|(rate, damped)| -(rate + damped));
            made.border.columns.push(column.collect());
            made.border.rows.push(rate);
        }
    }

    /// Rates of some rows of the Jacobian, in `q`.
    fn rotating_rows(&self, work: &Workspace<D>, rows: &[usize]) -> Vec<Vec<f64>> {
        let mut rates = work.kinematics.v.clone();
        (self.bodies).place_derived_rates(&work.kinematics.x, &mut rates);
        let pairs = work.kinematics.x.iter().zip(&rates);
        let x: Vec<Node<D, Jet>> = pairs.map(|(x, v)| moving(x, v)).collect();
        let v = work.kinematics.v.iter().map(|v| map_node(v, Jet::from_re));
        let v: Vec<Node<D, Jet>> = v.collect();
        let lift = |[p, v, a]: &[f64; 3]| {
            [
                Jet::new(*p, *v, 0.0),
                Jet::new(*v, *a, 0.0),
                Jet::from_re(*a),
            ]
        };
        let drives: Vec<[Jet; 3]> = work.kinematics.drives.iter().map(lift).collect();
        let mut travel: Vec<Jet> = work
            .kinematics
            .travel
            .iter()
            .map(|s| Jet::from_re(*s))
            .collect();
        self.find_travel(&x, &mut travel);
        let angles: Vec<Jet> = work
            .kinematics
            .angles
            .iter()
            .map(|a| Jet::from_re(*a))
            .collect();
        let view = View {
            x: &x,
            v: &v,
            drives: &drives,
            bodies: &self.bodies,
            travel: &travel,
            angles: &angles,
            released: &work.kinematics.released,
        };
        let rates = rows.iter().map(|row| {
            let mut rate = vec![0.0; self.coordinates()];
            self.constraints[*row].for_each_pulled(&view, |node, term| {
                let mut change = map_node(term, |t| t.v1);
                let (motion, value) = (work.kinematics.motion(), map_node(term, |t| t.re));
                (self.bodies).in_still_axes(node, motion, &value, &mut change);
                (self.elimination.assembly).restrict_node(node, &change, &mut rate);
            });
            self.elimination.project_in_place(&mut rate);
            rate
        });
        rates.collect()
    }
}
