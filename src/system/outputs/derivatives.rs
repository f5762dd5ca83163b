//! Derivatives of everything that outputs are made of, exact: along the motion by time, or by inputs at a
//! point in time.
//!
//! Forces, constraints and outputs are formulas over numbers of any kind; here they run on numbers with
//! two derivatives ([`Jet`]). What is linear (`T`, mass, rows) works on one derivative after the other. The
//! equations of motion differentiated `k` times have the matrix of the ones at hand:
//! `q_k = f_k - sum_i C(k, i) J_i^T lambda_(k-i)`, `sum_i C(k, i) J_i q_(k-i) = b_k`, where the index counts
//! derivatives; jerk and snap follow one from the other.
//!
//! Source: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), chapter 13.

use crate::bodies::{AngularAccelerations, AxisMotion, Node, add_node, map_node, no_node, product};
use crate::math::jet::{Jet, Number, part, set_part};
use crate::system::joints::View;
use crate::system::loads::ForceElement as _;
use crate::system::signal::Drive;
use crate::system::{Evaluation, State, System, Workspace};

/// An evaluation with derivatives, and what it takes to make one.
#[derive(Clone, Debug)]
pub struct Derivatives<const D: usize> {
    /// The evaluation: derivatives in time, or the first one along a direction of the inputs.
    pub values: Evaluation<D, Jet>,
    /// Forces on the nodes, but for constraints.
    f: Vec<Node<D, Jet>>,
    /// Forces on what is integrated, over the nodes.
    pulled: Vec<Node<D, Jet>>,
    /// Moments of sections.
    torques: Vec<[Jet; 3]>,
    /// Angular accelerations of rigid bodies and sections.
    angular: AngularAccelerations,
    /// Nodal accelerations of what is driven, and of axes that rotate.
    driven: Vec<Node<D, Jet>>,
    /// First and second derivative of generalized accelerations.
    q: [Vec<f64>; 2],
    /// One derivative of a nodal vector, and another one.
    one: Vec<Node<D>>,
    other: Vec<Node<D>>,
    /// Nodal accelerations of the free coordinates and their derivatives.
    moved: [Vec<Node<D>>; 2],
    /// Right-hand side of constraints.
    right: Vec<f64>,
    /// Multipliers and their derivatives.
    lambda: [Vec<f64>; 3],
}

impl<const D: usize> Derivatives<D> {
    /// Storage for a system.
    pub fn new(system: &System<D>) -> Self {
        let nodes = vec![[[Jet::from_re(0.0); D]; 2]; system.bodies.reference.len()];
        let q = vec![0.0; system.coordinates()];
        let none = vec![no_node(); system.bodies.reference.len()];
        let lambda = vec![0.0; system.constraints.len()];
        Self {
            values: Evaluation::new(system),
            f: nodes.clone(),
            pulled: nodes.clone(),
            angular: AngularAccelerations::of(&system.bodies),
            torques: vec![[Jet::from_re(0.0); 3]; system.bodies.moments()],
            driven: nodes,
            q: [q.clone(), q],
            one: none.clone(),
            other: none.clone(),
            moved: [none.clone(), none],
            right: lambda.clone(),
            lambda: [lambda.clone(), lambda.clone(), lambda],
        }
    }

    /// First, and with `order` 2 second derivatives in time of what [`Evaluation::dynamics`] has just
    /// computed with this scratch; inputs move with these derivatives.
    pub fn in_time(
        &mut self,
        system: &System<D>,
        (plain, state): (&Evaluation<D>, &State),
        slopes: &[[f64; 2]],
        order: usize,
        work: &mut Workspace<D>,
    ) {
        let time = system.now(state.time);
        self.values.time = Jet::new(time, 1.0, 0.0);
        let slope = |i: usize| slopes.get(i).copied().unwrap_or_default();
        self.set_inputs(plain, |i| {
            let [first, second] = slope(i);
            ([first, second], [first, second, 0.0])
        });
        let mut trajectories = system.trajectories().enumerate();
        for ((drive, set), now) in
            (system.drives.iter().zip(&mut self.values.drives)).zip(&plain.drives)
        {
            let [_, _, _, third, fourth] = match drive {
                Drive::Function(function) => function.orders(time),
                Drive::Input { .. } | Drive::Turned { .. } | Drive::Kept => {
                    trajectories.next().map_or([0.0; 5], |(place, given)| {
                        let (known, mut orders) = (&state.driven[..], state.driven[place]);
                        if let Some(higher) = given.higher((place, known), &plain.inputs, slope) {
                            [orders[3], orders[4]] = higher;
                        }
                        orders
                    })
                }
            };
            let [p, v, a] = *now;
            *set = [
                Jet::new(p, v, a),
                Jet::new(v, a, third),
                Jet::new(a, third, fourth),
            ];
        }
        self.values.forget();
        lift(
            &mut self.values.x,
            [&plain.x, &plain.v, &plain.acceleration],
        );
        self.one.fill(no_node());
        lift(
            &mut self.values.v,
            [&plain.v, &plain.acceleration, &self.one],
        );
        self.follow(system, plain);
        for k in 1..=order {
            if k == 2 {
                take(&self.values.acceleration, 1, &mut self.one);
                for (v, jerk) in self.values.v.iter_mut().zip(&self.one) {
                    let v = v.as_flattened_mut().iter_mut();
                    (v.zip(jerk.as_flattened())).for_each(|(v, jerk)| v.v2 = *jerk);
                }
            }
            self.forces(system, true);
            self.accelerations(system, plain, k, work);
        }
        self.linear_constraint_forces(system, order);
    }

    /// Derivatives, of the first order, along a direction of the inputs of what
    /// [`Evaluation::dynamics`] has just computed with this scratch. Positions and velocities do not
    /// depend on inputs.
    pub fn by_inputs(
        &mut self,
        system: &System<D>,
        plain: &Evaluation<D>,
        direction: &[f64],
        work: &mut Workspace<D>,
    ) {
        self.values.time = Jet::from_re(plain.time);
        self.set_inputs(plain, |i| {
            ([direction[i], 0.0], [plain.input_rates[i], 0.0, 0.0])
        });
        let mut trajectories = system.trajectories();
        let drives = system.drives.iter().zip(&mut self.values.drives);
        for (place, (drive, set)) in drives.enumerate() {
            *set = plain.drives[place].map(Jet::from_re);
            if !matches!(drive, Drive::Function(_))
                && let Some(given) = trajectories.next()
            {
                set[2].v1 = given.second_along(place, &plain.drives, direction);
            }
        }
        self.one.fill(no_node());
        self.values.forget();
        lift(&mut self.values.x, [&plain.x, &self.one, &self.one]);
        lift(&mut self.values.v, [&plain.v, &self.one, &self.one]);
        self.follow(system, plain);
        self.forces(system, false);
        self.accelerations(system, plain, 1, work);
        self.linear_constraint_forces(system, 1);
    }

    /// Inputs with derivatives, and their rates with derivatives.
    fn set_inputs(
        &mut self,
        plain: &Evaluation<D>,
        derivatives: impl Fn(usize) -> ([f64; 2], [f64; 3]),
    ) {
        self.values.inputs.clear();
        self.values.input_rates.clear();
        for (i, input) in plain.inputs.iter().enumerate() {
            let ([first, second], [rate, by_one, by_two]) = derivatives(i);
            self.values.inputs.push(Jet::new(*input, first, second));
            let rate = Jet::new(rate, by_one, by_two);
            self.values.input_rates.push(rate);
        }
    }

    /// Angles and slides follow the coordinates.
    fn follow(&mut self, system: &System<D>, plain: &Evaluation<D>) {
        let values = &mut self.values;
        values.frames.copy_from_slice(&plain.frames);
        values.released.copy_from_slice(&plain.released);
        for ((set, angle), now) in (values.angles.iter_mut().zip(&system.angles)).zip(&plain.angles)
        {
            *set = angle.value(&values.x, Jet::from_re(*now));
        }
        for (set, now) in values.travel.iter_mut().zip(&plain.travel) {
            *set = Jet::from_re(*now);
        }
        system.find_travel(&values.x, &mut values.travel);
    }

    /// Forces on the nodes, but for constraints; without those of elements where nothing moves.
    fn forces(&mut self, system: &System<D>, elastic: bool) {
        for (f, weight) in self.f.iter_mut().zip(&system.weight) {
            *f = map_node(weight, Jet::from_re);
        }
        let values = &self.values;
        let out = (&mut self.f[..], &mut self.torques[..]);
        (system.bodies).add_forces_of(values.motion(), out, &mut self.pulled, elastic);
        let at = values.instant(system);
        for load in &system.loads {
            load.add_force(at, &mut self.f);
        }
        if system.is_rotating() {
            let (motion, other) = (values.motion(), &mut self.pulled);
            (system.bodies).add_frame_inertia(system.rotation, motion, other, &mut self.f);
        }
    }

    /// Derivative `k` of accelerations and multipliers from those below.
    fn accelerations(
        &mut self,
        system: &System<D>,
        plain: &Evaluation<D>,
        k: usize,
        work: &mut Workspace<D>,
    ) {
        self.pull(system, k, work);
        self.driven.fill([[Jet::from_re(0.0); D]; 2]);
        for driven in &system.driven {
            let [_, _, second] = system.linear[driven.row]
                .target
                .derivatives(&self.values.drives);
            for (node, c) in &driven.inertia {
                add_node(&mut self.one[*node], -part(second, k), c);
            }
            for (node, c) in &driven.follow {
                let driven = self.driven[*node].as_flattened_mut().iter_mut();
                (driven.zip(c.as_flattened())).for_each(|(d, c)| *d += second * Jet::of(*c));
            }
        }
        let motion = self.values.motion();
        system.bodies.add_bias(motion, &mut self.driven);
        system.bodies.add_derived_bias(motion, &mut self.driven);
        if !system.constraints.is_empty() {
            self.differentiate_constraints(system, k, work);
        }
        let q = &mut self.q[k - 1];
        system.elimination.reduce(&self.one, &mut work.scratch.y, q);
        if !system.constraints.is_empty() {
            let (jacobian, right) = (&mut work.constraints.jacobian, &self.right);
            jacobian.solve_minimum_norm(2, |row| right[row], q);
            self.lambda[k].copy_from_slice(jacobian.multipliers());
            for (row, value) in self.values.lambda.iter_mut().enumerate() {
                value.re = self.lambda[0][row];
                set_part(value, k, self.lambda[k][row]);
            }
        }
        let (elimination, q) = (&system.elimination, &self.q[k - 1]);
        elimination.expand(q, &mut work.scratch.y, &mut self.other);
        let known = (&self.driven[..], &self.values.acceleration[..]);
        let (drives, value) = (&self.values.drives, &plain.acceleration);
        (system.bodies).differentiate_scaled(k, drives, value, known, &mut self.other);
        let accelerations = self.values.acceleration.iter_mut().zip(&plain.acceleration);
        for ((a, plain), (moved, driven)) in accelerations.zip(self.other.iter().zip(&self.driven))
        {
            let [plain, moved] = [plain, moved].map(|node| node.as_flattened());
            for (i, a) in a.as_flattened_mut().iter_mut().enumerate() {
                a.re = plain[i];
                set_part(a, k, moved[i] + part(driven.as_flattened()[i], k));
            }
        }
        let axes = AxisMotion {
            x: &self.values.x,
            bias: &self.driven,
            acceleration: &mut self.values.acceleration,
        };
        (system.bodies).differentiate_axes(k, &self.other, &mut self.angular, axes);
    }

    /// Derivative `k` of forces on the nodes; of moments on rigid bodies of space, along their axes.
    fn pull(&mut self, system: &System<D>, k: usize, work: &mut Workspace<D>) {
        if system.bodies.has_identity_map() {
            return take(&self.f, k, &mut self.one);
        }
        self.pulled.copy_from_slice(&self.f);
        let motion = self.values.motion();
        (system.bodies).pull_back_motion(motion, &self.torques, &mut self.pulled);
        take(&self.pulled, k, &mut self.one);
        let elimination = &system.elimination;
        elimination.expand(&work.acceleration, &mut work.scratch.y, &mut self.other);
        (system.bodies).set_angular_accelerations(&self.other, &mut self.angular);
    }

    /// Computes derivative `k` of the right-hand side of constraints. The effect of the present multipliers through the
    /// change of the Jacobian is subtracted from the forces.
    fn differentiate_constraints(&mut self, system: &System<D>, k: usize, work: &mut Workspace<D>) {
        let below = if k == 1 {
            &work.acceleration
        } else {
            &self.q[0]
        };
        let moved = &mut self.moved[k - 1];
        system.elimination.expand(below, &mut work.scratch.y, moved);
        self.lambda[0].copy_from_slice(&work.constraints.lambda);
        let view = self.values.view(system);
        for (row, constraint) in system.constraints.iter().enumerate() {
            let bias = constraint.bias(&view);
            let mut right = -part(bias, k);
            right -= part(constraint.along(&view, &self.driven), k);
            constraint.for_each_pulled(&view, |node, term| {
                // Derivatives of a product: of the Jacobian by the order, of the other factor by the rest.
                let term = system.bodies.pull_back_force(node, view.drives, term);
                for order in 1..=k {
                    let times = if (k, order) == (2, 1) { 2.0 } else { 1.0 };
                    let term = map_node(&term, |term| part(term, order));
                    right -= times * product(&term, &self.moved[k - order][node]);
                    let force = times * self.lambda[k - order][row];
                    add_node(&mut self.one[node], -force, &term);
                }
            });
            self.right[row] = right;
        }
    }

    /// Forces that linear constraints supply.
    fn linear_constraint_forces(&mut self, system: &System<D>, order: usize) {
        for (linear_constraint_forces, f) in
            self.values.linear_constraint_forces.iter_mut().zip(&self.f)
        {
            *linear_constraint_forces = map_node(f, |f| -f);
        }
        for k in 0..=order {
            take(&self.values.acceleration, k, &mut self.one);
            self.other.fill(no_node());
            system.bodies.add_inertia(1.0, &self.one, &mut self.other);
            add_order(&self.other, k, &mut self.values.linear_constraint_forces);
        }
        let values = &mut self.values;
        let (of, supplied) = (&values.acceleration, &mut values.linear_constraint_forces);
        (system.bodies).add_inertia_of_paid_out(&values.drives, of, supplied);
        let Evaluation {
            x,
            v,
            drives,
            travel,
            angles,
            released,
            lambda,
            linear_constraint_forces: found,
            ..
        } = &mut self.values;
        let view = View {
            x,
            v,
            drives,
            bodies: &system.bodies,
            travel,
            angles,
            released,
        };
        for (constraint, lambda) in system.constraints.iter().zip(lambda) {
            constraint.for_each(&view, |node, term| {
                let found = found[node].as_flattened_mut().iter_mut();
                (found.zip(term.as_flattened()))
                    .for_each(|(found, term)| *found += *term * *lambda);
            });
        }
    }
}

/// Numbers from their values and derivatives.
fn lift<const D: usize>(to: &mut [Node<D, Jet>], orders: [&[Node<D>]; 3]) {
    for (node, to) in to.iter_mut().enumerate() {
        for (i, to) in to.as_flattened_mut().iter_mut().enumerate() {
            let [value, first, second] = orders.map(|order| order[node].as_flattened()[i]);
            *to = Jet::new(value, first, second);
        }
    }
}

/// One derivative of a nodal vector.
fn take<const D: usize>(from: &[Node<D, Jet>], order: usize, to: &mut [Node<D>]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = map_node(from, |number| part(number, order));
    }
}

/// Adds to one derivative of a nodal vector.
fn add_order<const D: usize>(from: &[Node<D>], order: usize, to: &mut [Node<D, Jet>]) {
    for (to, from) in to.iter_mut().zip(from) {
        let to = to.as_flattened_mut().iter_mut();
        for (to, from) in to.zip(from.as_flattened()) {
            set_part(to, order, part(*to, order) + from);
        }
    }
}
