//! Configuration, forces and tangent of a system at a state, over its nodes.

use nalgebra::SMatrix;

use crate::body::{
    Assembly, Node, NodeBlock, RigidBodyFrame, RotationMaps, add_node, carried_node, map_node,
    no_block, turning_block,
};
use crate::elements::{Element, Nodal};
use crate::math::jet::Number;
use crate::math::space::{Vector, spin_matrix, spun};
use crate::math::sparse::Matrix;
use crate::system::end::{Attachment, coupling};
use crate::system::instant::Instant;
use crate::system::joints::{Constraint, ConstraintKind, View};
use crate::system::signal::Drive;
use crate::system::workspace::{Forces, Kinematics, Scratch};
use crate::system::{LineChain, LumpedMass, System, Workspace};

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
                Drive::Input { .. } | Drive::Turned { .. } => {
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
            &self.reference,
            q,
            &mut work.scratch.y,
            &mut work.kinematics.x,
        );
        self.add_driven(&work.kinematics.targets, 0, &mut work.kinematics.x);
        self.lengthen(work);
        let turns = (
            &mut work.kinematics.turns[..],
            &mut work.kinematics.carries[..],
        );
        (self.frames).place(&work.kinematics.frames, turns, &mut work.kinematics.x);
        self.find_travel(&work.kinematics.x, &mut work.kinematics.travel);
        if let Some(v) = v {
            self.rate_kinematics(v, work);
        }
    }

    /// Where slides are on their cables, searched from where they were.
    pub(in crate::system) fn find_travel<N: Number>(&self, x: &[Node<D, N>], travel: &mut [N]) {
        for (constraint, travel) in self.slides.iter().zip(travel) {
            if let ConstraintKind::PointOnCurve(along) = &self.constraints[*constraint].kind {
                *travel = along.travel(&self.chains[along.chain], x, *travel);
            }
        }
    }

    /// Puts nodal rates into `work`; what drives them is that of the last [`System::forward_kinematics`].
    pub(in crate::system) fn rate_kinematics(&self, v: &[f64], work: &mut Workspace<D>) {
        self.elimination
            .expand(v, &mut work.scratch.y, &mut work.kinematics.v);
        self.add_driven(&work.kinematics.targets, 1, &mut work.kinematics.v);
        self.lengthen_rates(work);
        let turns = (
            &mut work.kinematics.turns[..],
            &mut work.kinematics.carries[..],
        );
        (self.frames).place_rates(&work.kinematics.x, turns, &mut work.kinematics.v);
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
            chains: &self.chains,
            sections: (&self.rod_chains, &self.frames),
            angles: (&self.angles, &at.angles),
            winches: &self.winches,
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
        let motion @ (x, v) = (&kinematics.x[..], &kinematics.v[..]);
        let Forces {
            f,
            torques,
            dissipated,
            ..
        } = forces;
        f.copy_from_slice(&self.weight);
        *dissipated = 0.0;
        if !self.winches.is_empty() {
            self.add_lengthening(&kinematics.drives, motion, &mut scratch.other, f);
        }
        for chain in &self.chains {
            let longer = self.length_now(chain, &kinematics.drives).longer();
            *dissipated += chain.add_force(motion, longer, f);
        }
        if !self.rod_chains().is_empty() {
            torques.fill([0.0; 3]);
        }
        for chain in self.rod_chains() {
            let out = (&mut f[..], &mut torques[..]);
            *dissipated += chain.add_force(motion, &self.frames, out);
        }
        let at = self.instant(time, kinematics);
        for load in &self.loads {
            load.add_force(at, f);
        }
        if self.is_turning() {
            for (carried, (x, v)) in scratch.other.iter_mut().zip(x.iter().zip(v)) {
                *carried = carried_node(self.rotation, x, v);
            }
            self.add_inertia(-1.0, &scratch.other, f);
            for chain in self.rod_chains() {
                chain.add_turning(motion, self.rotation, &self.frames, f);
            }
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
        if self.has_no_frames() && self.winches.is_empty() {
            self.elimination.reduce(&forces.f, y, acceleration);
        } else {
            let motion @ (x, v) = (&kinematics.x[..], &kinematics.v[..]);
            other.copy_from_slice(&forces.f);
            self.pull_back(&kinematics.drives, other);
            (self.frames).pull_back((x, Some(v)), other);
            self.add_rod_forces(motion, &forces.torques, other);
            self.elimination.reduce(other, y, acceleration);
        }
        change(1.0, &mut forces.f);
    }

    /// Tangent at the state in `work`, with the multipliers of its last acceleration.
    pub(in crate::system) fn assemble(&self, time: f64, work: &mut Workspace<D>) {
        let assembly = &self.elimination.assembly;
        if !self.has_no_frames() {
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
        let (x, v, drives) = (&kinematics.x, &kinematics.v, &kinematics.drives);
        tangent.clear();
        let (stiffness, damping) = (&mut tangent.stiffness, &mut tangent.damping);
        for chain in &self.chains {
            let longer = self.length_now(chain, drives).longer();
            let matrices = (&mut *stiffness, &mut *damping);
            chain.add_tangent((x, v), longer, assembly, matrices);
        }
        for chain in self.rod_chains() {
            let matrices = [&mut *stiffness, &mut *damping];
            chain.add_tangent((x, v), &self.frames, assembly, matrices);
        }
        let at = self.instant(time, kinematics);
        for load in &self.loads {
            load.add_tangent(
                at,
                &mut |a, b, block| self.add_block((a, b), block, (x, drives), stiffness),
                &mut |a, b, block| self.add_block((a, b), block, (x, drives), damping),
            );
        }
        if self.is_turning() {
            self.add_centrifugal(x, stiffness);
        }
        let view = self.view(kinematics);
        for (constraint, lambda) in self.constraints.iter().zip(&constraints.lambda) {
            constraint.stiffness(*lambda, &view, &mut |a, b, block| {
                self.add_block((a, b), block, (x, drives), &mut tangent.stiffness);
            });
        }
        for frame in self.frames.list() {
            let turned = RotationMaps::geometric(frame, &forces.linear_constraint_forces, x);
            let block = turning_block(&((turned + turned.transpose()) * 0.5));
            assembly.add(frame.node, frame.node, &block, &mut tangent.stiffness);
        }
        for frame in self.frames.carried() {
            RotationMaps::geometric_of_carried(
                frame,
                &forces.linear_constraint_forces,
                x,
                |a, b, block| {
                    assembly.add(a, b, block, &mut tangent.stiffness);
                },
            );
        }
        tangent.hold(assembly, &constraints.jacobian, &self.multipliers);
        self.add_multipliers(&view, &constraints.jacobian, &mut tangent.stiffness);
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
        let shortened;
        let block = if self.winches.is_empty() {
            block
        } else {
            shortened = self.shorten_block((a, b), drives, block);
            &shortened
        };
        if self.has_no_frames() {
            return assembly.add(a, b, block, matrix);
        }
        self.frames.pull_block((a, b), block, x, |a, b, block| {
            assembly.add(a, b, block, matrix);
        });
    }

    /// Forces over the nodes, those of constraints that keep multipliers among them, into `work.forces.linear_constraint_forces`.
    pub(in crate::system) fn add_multiplied(&self, work: &mut Workspace<D>) {
        let Forces {
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
        let motion @ (x, _) = (&kinematics.x[..], &kinematics.v[..]);
        let (drives, Scratch { y, other }) = (&kinematics.drives, scratch);
        self.elimination.expand(acceleration, y, other);
        self.pull_back(drives, other);
        self.frames.place_changes(x, other);
        self.frames.add_centripetal(motion, other);
        self.add_driven(&kinematics.targets, 2, other);
        self.add_lengthened(drives, motion, other);
        let found = &mut forces.linear_constraint_forces;
        for (found, f) in found.iter_mut().zip(&forces.f) {
            *found = map_node(f, |f| -f);
        }
        self.add_inertia_now(drives, other, found);
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
        if !self.drives.is_empty() {
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

    /// Adds the stiffness of the centrifugal force, `[W]^2` times the mass.
    pub(in crate::system) fn add_centrifugal(&self, x: &[Node<D>], matrix: &mut Matrix<f64>) {
        let spin = spin_matrix::<D>(self.rotation);
        let (axes, assembly) = (spin * spin, &self.elimination.assembly);
        let linear = (&self.chains[..], &self.lumped_masses[..]);
        add_mass(linear, &axes, assembly, matrix);
        for (node, part, mass) in self.frames.list().iter().flat_map(RigidBodyFrame::masses) {
            let mut block = no_block();
            for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
                block[part][r][part][c] = mass * axes[(r, c)];
            }
            self.add_block((node, node), &block, (x, &[]), matrix);
        }
    }

    /// Energy of the centrifugal force in a turning frame, with the other sign, J: that of the velocities `W x r` and of spins.
    pub(in crate::system) fn centrifugal<N: Number>(&self, x: &[Node<D, N>]) -> N {
        let spins = self.rod_chains().iter();
        let spins = spins.map(|chain| chain.turning_energy(x, self.rotation, &self.frames));
        spins.fold(
            self.quadratic(x, |v| spun(self.rotation, v)),
            |sum, energy| sum + energy,
        )
    }

    /// Kinetic energy at coordinates `x` and rates `v`, J.
    pub(in crate::system) fn kinetic<N: Number>(
        &self,
        drives: &[[N; 3]],
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
    ) -> N {
        let spins = self.rod_chains().iter();
        let spins = spins.map(|chain| chain.spin_energy((x, v), &self.frames));
        let paid_out = self.winches.iter().map(|winch| {
            let chain = &self.chains[winch.chain];
            winch.kinetic(chain, (x, v), &winch.now(drives))
        });
        let others = spins.chain(paid_out);
        others.fold(self.quadratic(v, |v| v), |sum, energy| sum + energy)
    }

    /// `x^T M x / 2` of vectors that are mapped one by one; without cables that are paid out.
    fn quadratic<N: Number>(
        &self,
        x: &[Node<D, N>],
        map: impl Fn(Vector<D, N>) -> Vector<D, N>,
    ) -> N {
        let mut sum = N::of(0.0);
        let chains = self.chains.iter();
        for chain in chains.filter(|chain| self.winch_of(chain).is_none()) {
            for (j, element) in chain.elements().iter().enumerate() {
                let e: Nodal<D, N> = chain.element(j, x);
                let e = Nodal::from_columns(&[0, 1, 2, 3].map(|k| map(e.column(k).into())));
                sum += (e * element.mass().map(N::of)).dot(&e);
            }
        }
        for lump in &self.lumped_masses {
            let marker = lump.marker.lift();
            let (at, on) = (map(marker.position(x)), map(marker.direction(x)));
            sum +=
                at.norm_squared() * N::of(lump.moved()) + on.norm_squared() * N::of(lump.inertia);
        }
        for (node, part, mass) in self.frames.list().iter().flat_map(RigidBodyFrame::masses) {
            sum += map(x[node][part].into()).norm_squared() * N::of(mass);
        }
        N::of(0.5) * sum
    }
}

/// Adds the mass of cables and of what is lumped at points, times a matrix over the axes, to a matrix over the free
/// coordinates.
pub(in crate::system) fn add_mass<const D: usize>(
    (chains, lumped_masses): (&[LineChain<D>], &[LumpedMass]),
    axes: &SMatrix<f64, D, D>,
    assembly: &Assembly<D>,
    matrix: &mut Matrix<f64>,
) {
    for chain in chains {
        chain.add_mass(axes, assembly, matrix);
    }
    for lump in lumped_masses {
        let ends = [
            Attachment::Body(lump.marker),
            Attachment::Ground(Vector::zeros()),
        ];
        for (part, size) in [lump.moved(), lump.inertia].into_iter().enumerate() {
            let (k, zero) = (axes * size, SMatrix::zeros());
            coupling(
                &ends,
                [[k, zero], [zero, zero]],
                part,
                &mut |a, b, block| {
                    assembly.add(a, b, block, matrix);
                },
            );
        }
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
