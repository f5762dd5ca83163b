//! Configuration, forces and tangent of a system at a state, over its nodes.

use crate::bodies::{NodalMotion, Node, NodeBlock, add_node, map_node};
use crate::math::jet::Number;
use crate::math::sparse::Matrix;
use crate::system::instant::Instant;
use crate::system::joints::{Constraint, ConstraintKind, View};
use crate::system::loads::ForceElement as _;
use crate::system::signal::Drive;
use crate::system::workspace::{Kinematics, NodalForces, Scratch};
use crate::system::{System, Workspace};

impl<const D: usize> System<D> {
    /// Puts the nodal coordinates and, if given, rates of a state into `work`.
    pub(in crate::system) fn forward_kinematics(
        &self,
        time: f64,
        q: &[f64],
        v: Option<&[f64]>,
        work: &mut Workspace<D>,
    ) {
        let clock = self.clock(time, &work.kinematics);
        let mut trajectories = work.kinematics.trajectories.iter();
        let drives = self.drives.iter().zip(&mut work.kinematics.recent);
        for (value, (drive, recent)) in work.kinematics.drives.iter_mut().zip(drives) {
            *value = match drive {
                Drive::Function(function) => recent.derivatives(function, clock),
                Drive::Input { .. } | Drive::Turned { .. } | Drive::Kept => {
                    let course = trajectories.next();
                    course.map_or([0.0; 3], |course| course.derivatives(time))
                }
            };
        }
        for (target, driven) in work.kinematics.targets.iter_mut().zip(&self.driven) {
            *target = self.linear[driven.row]
                .target
                .derivatives(&work.kinematics.drives);
        }
        self.elimination.expand_from(
            &self.bodies.reference,
            q,
            &mut work.scratch.y,
            &mut work.kinematics.x,
        );
        self.add_driven(&work.kinematics.targets, 0, &mut work.kinematics.x);
        let Kinematics {
            frames,
            drives,
            rotations,
            x,
            ..
        } = &mut work.kinematics;
        self.bodies.place(frames, drives, rotations, x);
        self.find_travel(&work.kinematics.x, &mut work.kinematics.travel);
        if let Some(v) = v {
            self.rate_kinematics(v, work);
        }
    }

    /// Where slides are on their cables, searched from where they were.
    pub(in crate::system) fn find_travel<N: Number>(&self, x: &[Node<D, N>], travel: &mut [N]) {
        for (constraint, travel) in self.slides.iter().zip(travel) {
            if let ConstraintKind::PointOnCurve(along) = &self.constraints[*constraint].kind {
                *travel = along.travel(&self.bodies.lines()[along.chain], x, *travel);
            }
        }
    }

    /// Puts nodal rates into `work`; what drives them is that of the last [`System::forward_kinematics`].
    pub(in crate::system) fn rate_kinematics(&self, v: &[f64], work: &mut Workspace<D>) {
        self.elimination
            .expand(v, &mut work.scratch.y, &mut work.kinematics.v);
        self.add_driven(&work.kinematics.targets, 1, &mut work.kinematics.v);
        let Kinematics {
            drives,
            rotations,
            x,
            v,
            ..
        } = &mut work.kinematics;
        self.bodies.place_rates(drives, rotations, x, v);
    }

    /// Adds what nodes follow of driven rows: coordinates, rates (`order` 1) or accelerations (2).
    pub(in crate::system) fn add_driven(
        &self,
        targets: &[[f64; 3]],
        order: usize,
        out: &mut [Node<D>],
    ) {
        for (driven, target) in self.driven.iter().zip(targets) {
            let mut value = target[order];
            if order == 0 {
                value -= driven.reference;
            }
            add(&driven.follow, value, out);
        }
    }

    pub(in crate::system) fn instant<'a>(
        &'a self,
        time: f64,
        at: &'a Kinematics<D>,
    ) -> Instant<'a, D> {
        Instant {
            time: self.clock(time, at),
            inputs: &at.inputs,
            input_rates: &at.input_rates,
            drives: &at.drives,
            x: &at.x,
            v: &at.v,
            bodies: &self.bodies,
            angles: (&self.angles, &at.angles),
        }
    }

    /// Total force on the nodes in `work`, but for constraints, and what damping of cables takes out.
    pub(in crate::system) fn forces(&self, time: f64, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            forces,
            scratch,
            ..
        } = work;
        let motion = kinematics.motion();
        let NodalForces {
            f,
            torques,
            dissipated,
            ..
        } = forces;
        f.copy_from_slice(&self.weight);
        let out = (&mut f[..], &mut torques[..]);
        *dissipated = (self.bodies).add_forces(motion, out, &mut scratch.other);
        let at = self.instant(time, kinematics);
        for load in &self.loads {
            load.add_force(at, f);
        }
        if self.is_rotating() {
            (self.bodies).add_frame_inertia(self.rotation, motion, &mut scratch.other, f);
        }
    }

    /// Computes `T^T (f - M G c'')` of the nodal forces in `work`, which stay, into `work.acceleration`.
    pub(in crate::system) fn reduce(&self, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            forces,
            scratch,
            acceleration,
            ..
        } = work;
        let change = |sign: f64, f: &mut [Node<D>]| {
            for (driven, [_, _, second]) in self.driven.iter().zip(&kinematics.targets) {
                add(&driven.inertia, sign * second, f);
            }
        };
        change(-1.0, &mut forces.f);
        let Scratch { y, other } = scratch;
        if self.bodies.has_identity_map() {
            self.elimination.reduce(&forces.f, y, acceleration);
        } else {
            other.copy_from_slice(&forces.f);
            (self.bodies).pull_back_motion(kinematics.motion(), &forces.torques, other);
            self.elimination.reduce(other, y, acceleration);
        }
        change(1.0, &mut forces.f);
    }

    /// Whether the tangent needs an acceleration: multipliers and forces on bodies that rotate stiffen, and solves need the
    /// Jacobian.
    pub(in crate::system) fn stiffens(&self) -> bool {
        !(self.constraints.is_empty() && self.bodies.has_no_frames())
    }

    /// Tangent at the state in `work`, with the multipliers of its last acceleration.
    pub(in crate::system) fn assemble(&self, time: f64, work: &mut Workspace<D>) {
        let assembly = &self.elimination.assembly;
        if !self.bodies.has_no_frames() {
            self.add_multiplied(work);
        }
        self.set_base(work);
        let Workspace {
            kinematics,
            forces,
            constraints,
            linearization,
            ..
        } = work;
        let tangent = &mut linearization.tangent;
        let (x, drives) = (&kinematics.x, &kinematics.drives);
        tangent.clear();
        let (stiffness, damping) = (&mut tangent.stiffness, &mut tangent.damping);
        let matrices = [&mut *stiffness, &mut *damping];
        let motion = NodalMotion {
            from: linearization.predicts.then_some(&linearization.from),
            ..kinematics.motion()
        };
        (self.bodies).add_tangent(motion, assembly, matrices);
        let at = self.instant(time, kinematics);
        for load in &self.loads {
            load.add_tangent(
                at,
                &mut |a, b, block| self.add_block((a, b), block, (x, drives), stiffness),
                &mut |a, b, block| self.add_block((a, b), block, (x, drives), damping),
            );
        }
        if self.is_rotating() {
            (self.bodies).add_centrifugal(self.rotation, x, assembly, stiffness);
        }
        let view = self.view(kinematics);
        for (constraint, lambda) in self.constraints.iter().zip(&constraints.lambda) {
            constraint.stiffness(*lambda, &view, &mut |a, b, block| {
                self.add_block((a, b), block, (x, drives), &mut tangent.stiffness);
            });
        }
        let (of, stiffness) = (&forces.linear_constraint_forces, &mut tangent.stiffness);
        self.bodies.add_geometric(of, x, assembly, stiffness);
        tangent.hold(assembly, &constraints.jacobian, &self.multipliers);
        self.add_multipliers(&view, &constraints.jacobian, &mut tangent.stiffness);
    }

    /// Adds `s C^T C` to the stiffness, where `C` are the derivatives of the constraints that count and `s` gives each of them this stiffness,
    /// 1/s^2, by itself. Motions that keep the constraints do not feel it. Bodies that constraints alone hold have pivots of that size in place
    /// of none (M. Benzi, G. H. Golub, J. Liesen, Acta Numerica 14 (2005), section 8.1: augmented Lagrangian).
    pub(in crate::system) fn add_held(&self, stiffness: f64, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            constraints,
            linearization,
            ..
        } = work;
        let (view, assembly) = (self.view(kinematics), &self.elimination.assembly);
        let (jacobian, matrix) = (&constraints.jacobian, &mut linearization.tangent.stiffness);
        let mut terms: Vec<(usize, Node<D>)> = Vec::new();
        let rows = self.constraints.iter().enumerate();
        for (row, constraint) in rows.filter(|(row, _)| jacobian.is_independent(*row)) {
            let square = jacobian.rows().square(row);
            if square == 0.0 {
                continue;
            }
            terms.clear();
            constraint.for_each_pulled(&view, |node, term| {
                let term = self.bodies.pull_back_force(node, view.drives, term);
                match terms.iter_mut().find(|(other, _)| *other == node) {
                    Some((_, sum)) => add_node(sum, 1.0, &term),
                    None => terms.push((node, term)),
                }
            });
            for (place, (a, by_a)) in terms.iter().enumerate() {
                for (b, by_b) in &terms[place..] {
                    let block = map_node(by_a, |u| map_node(by_b, |w| stiffness / square * u * w));
                    assembly.add(*a, *b, &block, matrix);
                }
            }
        }
    }

    /// Adds second derivatives by nodal coordinates to a matrix over the free ones.
    #[inline(always)]
    fn add_block(
        &self,
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        (x, drives): (&[Node<D>], &[[f64; 3]]),
        matrix: &mut Matrix<f64>,
    ) {
        let assembly = &self.elimination.assembly;
        (self.bodies).pull_block((a, b), block, (x, drives), |a, b, block| {
            assembly.add(a, b, block, matrix);
        });
    }

    /// Forces over the nodes, those of constraints that keep multipliers among them, into `work.forces.linear_constraint_forces`.
    pub(in crate::system) fn add_multiplied(&self, work: &mut Workspace<D>) {
        let NodalForces {
            f,
            linear_constraint_forces: sum,
            ..
        } = &mut work.forces;
        sum.copy_from_slice(f);
        let view = self.view(&work.kinematics);
        for (constraint, lambda) in self.constraints.iter().zip(&work.constraints.lambda) {
            constraint.for_each(&view, |node, term| {
                add(&[(node, *term)], -lambda, sum);
            });
        }
    }

    /// Computes the forces of linear constraints at the accelerations in `work`, over the nodes, into
    /// `work.forces.linear_constraint_forces`: `M x'' - f + J^T lambda`; nodal accelerations into `work.scratch.other`.
    pub(in crate::system) fn linear_constraint_forces(&self, work: &mut Workspace<D>) {
        let Workspace {
            kinematics,
            forces,
            constraints,
            scratch,
            acceleration,
            ..
        } = work;
        let motion = kinematics.motion();
        let (drives, Scratch { y, other }) = (&kinematics.drives, scratch);
        self.elimination.expand(acceleration, y, other);
        self.bodies.place_changes(drives, motion.x, other);
        self.bodies.add_bias(motion, other);
        self.add_driven(&kinematics.targets, 2, other);
        let found = &mut forces.linear_constraint_forces;
        for (found, f) in found.iter_mut().zip(&forces.f) {
            *found = map_node(f, |f| -f);
        }
        self.bodies.add_inertia_now(drives, other, found);
        let view = self.view(kinematics);
        for (constraint, lambda) in self.constraints.iter().zip(&constraints.lambda) {
            constraint.for_each(&view, |node, term| {
                add(&[(node, *term)], *lambda, found);
            });
        }
    }

    /// Power that comes in through loads and motions and that is dissipated, W, at the state, forces and
    /// accelerations in place.
    pub(in crate::system) fn powers(&self, time: f64, work: &mut Workspace<D>) -> [f64; 2] {
        if !self.driven.is_empty() {
            self.linear_constraint_forces(work);
        }
        let multiplied = self
            .constraints
            .iter()
            .zip(work.constraints.lambda.iter().copied());
        let at = self.instant(time, &work.kinematics);
        self.power(
            at,
            &self.view(&work.kinematics),
            |place| work.kinematics.targets[place][1],
            (
                &work.forces.linear_constraint_forces,
                work.forces.dissipated,
            ),
            multiplied,
        )
    }

    /// Power that comes in and that is dissipated, W, with the rates of the targets of driven rows, the forces that linear
    /// constraints supply, what damping of cables takes out, and the multipliers of the other constraints.
    pub(in crate::system) fn power<'a, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        view: &View<'_, D, N>,
        rate_of: impl Fn(usize) -> N,
        (linear_constraint_forces, by_cables): (&[Node<D, N>], N),
        multiplied: impl Iterator<Item = (&'a Constraint<D>, N)>,
    ) -> [N; 2] {
        let mut power = [N::of(0.0), by_cables];
        if !self.drives.is_empty() {
            for (place, driven) in self.driven.iter().enumerate() {
                let rate = rate_of(place);
                for (node, c) in &driven.follow {
                    power[0] += weighted(c, &linear_constraint_forces[*node]) * rate;
                }
            }
            for (constraint, lambda) in multiplied {
                power[0] += lambda * constraint.rate(view);
            }
        }
        for load in &self.loads {
            let [supplied, dissipated] = load.power(at);
            power[0] += supplied;
            power[1] += dissipated;
        }
        power
    }
}

/// Inner product of weights and numbers of any kind.
pub(in crate::system) fn weighted<const D: usize, N: Number>(
    weights: &Node<D>,
    numbers: &Node<D, N>,
) -> N {
    let products = weights
        .as_flattened()
        .iter()
        .zip(numbers.as_flattened())
        .map(|(w, n)| *n * N::of(*w));
    products.fold(N::of(0.0), |sum, product| sum + product)
}

fn add<const D: usize>(terms: &[(usize, Node<D>)], factor: f64, out: &mut [Node<D>]) {
    for (node, term) in terms {
        add_node(&mut out[*node], factor, term);
    }
}
