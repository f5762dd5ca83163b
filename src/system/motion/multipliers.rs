//! Non-linear constraints: accelerations with multipliers, projection of positions and velocities.
//!
//! With identity inertia the augmented system (report Eq. 35 with `C_q = C_e T`)
//! `[I J^T; J 0] [q''; lambda] = [Q; b]` is solved by taking the rows of `J` out of `Q` and adding the smallest
//! acceleration that `b` asks for. Rows that depend on others, always or in a singular configuration, drop
//! out: what is left is the minimum-norm solution. After a step, positions and velocities are brought
//! back to the constraints along the shortest way in the mass norm: no drift, nothing to tune, and the
//! order of the integrator stays.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), section 7; projection: E. Hairer, C. Lubich, G. Wanner,
//! Geometric Numerical Integration, 2nd ed., section IV.4; minimum norm in singular configurations:
//! F. E. Udwadia, R. E. Kalaba, Analytical Dynamics (1996).

use crate::bodies::{Jacobian, Node, SparseRows, no_node};
use crate::math::jet::Number;
use crate::math::sparse::Matrix;
use crate::system::joints::{Constraint, Equation as _, View};
use crate::system::workspace::Constraints;
use crate::system::{Kinematics, System, Workspace};

/// Most iterations of a projection.
const ITERATIONS: usize = 20;
/// Part of a row of the Jacobian that others must leave for it to count. Close to a singular configuration (at a
/// distance `d`) a residual of roundoff tilts the dependent row by `1e-15 / d^2`; leaving it out lets inertia rule for
/// a time in proportion to `d`. This is in between (docs/decisions/0029-constraints-at-linear-cost.md).
pub(super) const RANK: f64 = 1e-3;
/// Part of a row for a state that dependent rows have left by more than roundoff: where a motion dwells at a singular
/// configuration.
const FINE_RANK: f64 = 1e-5;
/// Residual beyond which a state is off the constraints by more than roundoff.
const ROUNDOFF: f64 = 1e-12;
/// Residual at which positions are on the constraints.
const EXACT: f64 = 2e-15;

/// A non-linear constraint `g(q, t) = 0` at a time, coordinates and rates.
pub struct ConstraintRow<'a, const D: usize> {
    constraint: &'a Constraint<D>,
    view: &'a View<'a, D>,
    /// Reference size of residuals.
    pub size: f64,
    rows: &'a SparseRows,
    row: usize,
}

impl<const D: usize> ConstraintRow<'_, D> {
    /// `g`.
    pub fn value(&self) -> f64 {
        self.constraint.value(self.view)
    }

    /// `dg/dt`.
    pub fn rate(&self) -> f64 {
        constraint_rate(self.constraint, self.view)
    }

    /// Returns the derivatives with respect to the coordinates, a row of `J`.
    pub fn gradient(&self, coordinates: usize) -> Vec<f64> {
        let mut gradient = vec![0.0; coordinates];
        self.rows.add(self.row, 1.0, &mut gradient);
        gradient
    }
}

impl<const D: usize> System<D> {
    /// Fills in the Jacobian at the nodal coordinates in `work`, unless it is that already.
    pub(super) fn jacobians(&self, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            constraints,
            ..
        } = work;
        if !constraints.outdates_jacobian(kinematics) {
            return;
        }
        let view = self.view(kinematics);
        for (row, constraint) in self.constraints.iter().enumerate() {
            if !constraints.jacobian.needs(row) {
                continue;
            }
            (constraints.jacobian).fill(&self.elimination, row, |tell| {
                constraint.for_each_pulled(&view, |node, term| {
                    tell(node, &self.bodies.pull_back_force(node, view.drives, term));
                });
            });
        }
    }

    /// Shows every non-linear constraint at a time, coordinates and, where its rate is read, rates.
    pub fn visit_constraints(
        &self,
        time: f64,
        q: &[f64],
        v: Option<&[f64]>,
        work: &mut Workspace<D>,
        mut visit: impl FnMut(ConstraintRow<'_, D>),
    ) {
        self.forward_kinematics(time, q, v, work);
        self.jacobians(work);
        let view = self.view(&work.kinematics);
        for (row, constraint) in self.constraints.iter().enumerate() {
            visit(ConstraintRow {
                constraint,
                view: &view,
                size: constraint.kind.size(&self.bodies),
                rows: work.constraints.jacobian.rows(),
                row,
            });
        }
    }

    /// A configuration as constraints see it.
    pub(in crate::system) fn view<'a>(&'a self, at: &'a Kinematics<D>) -> View<'a, D> {
        View {
            x: &at.x,
            v: &at.v,
            drives: &at.drives,
            bodies: &self.bodies,
            travel: &at.travel,
            angles: &at.angles,
            released: &at.released,
        }
    }

    /// Adds the rows and columns of multipliers to a matrix over the free coordinates: the derivatives of the constraints
    /// that count. A multiplier of what does not count stands alone: it is zero.
    pub(in crate::system) fn add_multipliers(
        &self,
        view: &View<'_, D>,
        jacobian: &Jacobian,
        matrix: &mut Matrix<f64>,
    ) {
        let assembly = &self.elimination.assembly;
        (0..assembly.constraints()).for_each(|index| assembly.add_corner(index, -1.0, matrix));
        let constraints = self.constraints.iter().zip(&self.multipliers).enumerate();
        for (_, (constraint, index)) in constraints.filter(|(row, _)| jacobian.is_independent(*row))
        {
            assembly.add_corner(*index, 1.0, matrix);
            constraint.for_each_pulled(view, |node, term| {
                let term = self.bodies.pull_back_force(node, view.drives, term);
                assembly.add_gradient((*index, node), &term, matrix);
            });
        }
    }

    /// Converts free accelerations in `work.acceleration` into constrained ones, at the coordinates and rates in `work`, and finds multipliers.
    pub(in crate::system) fn constrain(&self, work: &mut Workspace<D>) {
        self.jacobians(work);
        self.ask_accelerations(work);
        let Constraints {
            jacobian,
            right,
            lambda,
            is_without_multipliers,
            ..
        } = &mut work.constraints;
        jacobian.factor(RANK);
        jacobian.solve_minimum_norm(2, |row| right[row], &mut work.acceleration);
        lambda.copy_from_slice(jacobian.multipliers());
        *is_without_multipliers = false;
    }

    /// Takes the part of `q` out that constraints do not allow where the last acceleration was.
    pub(in crate::system) fn project_on_tangent_plane(
        &self,
        constraints: &mut Constraints<D>,
        q: &mut [f64],
    ) {
        if constraints.is_without_multipliers {
            constraints.right.fill(0.0);
            self.bring_tree(constraints, q);
        } else {
            constraints.jacobian.solve_minimum_norm(2, |_| 0.0, q);
        }
    }

    /// Computes the right-hand side of the constraints on accelerations, into `work.constraints.right`.
    pub(in crate::system) fn ask_accelerations(&self, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            constraints,
            scratch,
            ..
        } = work;
        // Accelerations that do not follow from the coordinates': of what is driven, and of axes that rotate.
        let is_still = self.driven.is_empty() && !self.bodies.pays_out();
        let is_driven = !(is_still && self.bodies.has_no_frames());
        if is_driven {
            self.driven_acceleration(&kinematics.targets, &mut scratch.other);
            (self.bodies).add_bias(kinematics.motion(), &mut scratch.other);
        }
        self.fill_right(
            &self.view(kinematics),
            &mut constraints.right,
            |end| end.velocity(&scratch.other),
            |constraint, view| {
                if is_driven {
                    constraint.bias(view) + constraint.along(view, &scratch.other)
                } else {
                    constraint.bias(view)
                }
            },
            false,
        );
    }

    /// Nodal accelerations of what is driven.
    pub(in crate::system) fn driven_acceleration(&self, targets: &[[f64; 3]], out: &mut [Node<D>]) {
        out.fill(no_node());
        self.add_driven(targets, 2, out);
    }

    /// Projects positions onto the constraints at a time. Returns the largest residual left, relative
    /// to the size of its constraint.
    pub(in crate::system) fn project_positions(
        &self,
        time: f64,
        q: &mut [f64],
        work: &mut Workspace<D>,
    ) -> f64 {
        let (mut before, mut rank) = (f64::INFINITY, RANK);
        for _ in 0..ITERATIONS {
            self.forward_kinematics(time, q, None, work);
            let missing = self.missing(work, true);
            let residual = larger(missing, self.settled_residual(&self.view(&work.kinematics)));
            // Two and more iterations are quadratic; what does not shrink is roundoff, or in rows that do not count.
            if residual <= EXACT || residual > 0.5 * before {
                let is_left = residual > ROUNDOFF && !self.has_full_rank(work);
                if !is_left || rank == FINE_RANK {
                    return residual;
                }
                (before, rank) = (f64::INFINITY, FINE_RANK);
            }
            // After the first one, the Jacobian in place shrinks the residual as much once more.
            if before.is_infinite() || residual * (residual / before) > EXACT {
                self.prepare(work);
            }
            before = residual;
            self.correct(q, work, (1, rank));
        }
        before
    }

    /// Projects velocities onto the constraints at the positions and drives in `work`.
    pub(in crate::system) fn project_velocities(&self, v: &mut [f64], work: &mut Workspace<D>) {
        self.prepare(work);
        self.missing_rates(v, work);
        self.correct(v, work, (2, RANK));
        if !self.has_full_rank(work) && self.missing_rates(v, work) > ROUNDOFF {
            self.correct(v, work, (2, FINE_RANK));
        }
    }

    /// Takes velocities for what is missing. Returns the largest residual, relative to the size of its constraint, 1/s.
    fn missing_rates(&self, v: &[f64], work: &mut Workspace<D>) -> f64 {
        self.rate_kinematics(v, work);
        self.missing(work, false)
    }

    /// Prepares corrections: factors the tree of constraints, or computes the Jacobian.
    fn prepare(&self, work: &mut Workspace<D>) {
        if !self.factor_tree(work) {
            self.jacobians(work);
        }
    }

    /// Whether all constraints count where corrections were found last.
    fn has_full_rank(&self, work: &Workspace<D>) -> bool {
        work.constraints.is_tree || work.constraints.jacobian.has_full_rank()
    }

    /// Takes the residuals of positions or rates at what is in `work` for what is missing. Returns the largest one, relative
    /// to the size of its constraint.
    fn missing(&self, work: &mut Workspace<D>, is_position: bool) -> f64 {
        let (at, right) = (&work.kinematics, &mut work.constraints.right);
        self.fill_right(
            &self.view(at),
            right,
            |end| {
                if is_position {
                    end.position(&at.x)
                } else {
                    end.velocity(&at.v)
                }
            },
            |constraint, view| {
                if is_position {
                    constraint.value(view)
                } else {
                    constraint_rate(constraint, view)
                }
            },
            is_position,
        );
        let mut largest = 0.0;
        for (right, constraint) in right.iter().zip(&self.constraints) {
            largest = larger(largest, right.abs() / constraint.kind.size(&self.bodies));
        }
        largest
    }

    /// Adds what is missing to first order, with the Jacobian in `work`, in so many passes and by rows that others
    /// leave so much of.
    fn correct(&self, q: &mut [f64], work: &mut Workspace<D>, (passes, rank): (usize, f64)) {
        let Workspace {
            kinematics,
            constraints,
            scratch,
            change,
            ..
        } = work;
        change.fill(0.0);
        if constraints.is_tree {
            self.bring_tree(constraints, change);
        } else {
            let Constraints {
                jacobian, right, ..
            } = constraints;
            jacobian.factor(rank);
            jacobian.solve_minimum_norm(passes, |row| right[row], change);
        }
        self.to_rotations(kinematics, scratch, change);
        q.iter_mut().zip(&*change).for_each(|(q, c)| *q += c);
    }

    /// Largest residual of positions, relative to the size of the constraint.
    pub(in crate::system) fn position_residual<N: Number>(&self, view: &View<'_, D, N>) -> f64 {
        let kept = self.constraints.iter().map(|c| self.relative(c, view));
        kept.fold(self.settled_residual(view), larger)
    }

    /// Returns the residual of the constraints that no free coordinate can violate.
    fn settled_residual<N: Number>(&self, view: &View<'_, D, N>) -> f64 {
        let settled = self.settled.iter().map(|c| self.relative(c, view));
        settled.fold(0.0, larger)
    }

    /// Residual of a constraint, relative to its size.
    fn relative<N: Number>(&self, constraint: &Constraint<D>, view: &View<'_, D, N>) -> f64 {
        constraint.value(view).plain().abs() / constraint.kind.size(&self.bodies)
    }

    /// Largest residual of velocities, relative to the size of the constraint, 1/s.
    pub(in crate::system) fn velocity_residual<N: Number>(&self, view: &View<'_, D, N>) -> f64 {
        let residual =
            |c: &Constraint<D>| constraint_rate(c, view).plain().abs() / c.kind.size(&self.bodies);
        self.constraints.iter().map(residual).fold(0.0, larger)
    }
}

/// `dg/dt` at the coordinates and rates in place.
fn constraint_rate<const D: usize, N: Number>(
    constraint: &Constraint<D>,
    view: &View<'_, D, N>,
) -> N {
    constraint.rate(view) + constraint.along(view, view.v)
}

/// The larger number; unlike `f64::max` it does not hide a NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b + 0.0 * a }
}
