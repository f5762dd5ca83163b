//! What joints, motions, gears, couplings and loads exert.

use nalgebra::Vector3;

use super::evaluation::Evaluation;
use crate::math::jet::Number;
use crate::math::space::{Vector, moment, vector};
use crate::system::joints::{Constraint, View};
use crate::system::loads::{AppliedLoad, ForceElement as _};
use crate::system::{Attachment, System};

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Force (N) and moment (N m), in the plane its third component, of a joint or motion on its second end.
    pub fn reaction(&self, system: &System<D>, joint: usize) -> (Vector<D, N>, [N; 3]) {
        if let Some(clamp) = system.joints[joint].clamp() {
            return self.clamped(system, clamp);
        }
        if let Some(edge) = system.joints[joint].edge() {
            return self.on_edge(system, (joint, edge));
        }
        let mut force = Vector::zeros();
        let second = system.joints[joint].ends[1].lift();
        let u = second.direction(&self.x);
        let mut turning = Vector3::zeros();
        for (row, linear) in system.linear.iter().enumerate() {
            if linear.joint == Some(joint) {
                let lambda = system.row_multiplier(row, |node| self.linear_constraint_forces[node]);
                let [position, direction] = linear.on_ends[1].map(|on| on.map(N::of) * lambda);
                force += position;
                turning += Vector3::from(moment(&u, &direction));
            }
        }
        let (at, view) = (self.instant(system), self.view(system));
        for (constraint, lambda) in system.constraints.iter().zip(&self.lambda) {
            if constraint.joint == Some(joint) {
                let (on, about) = self.held_by(constraint, *lambda, &view);
                force += on;
                turning += about;
            }
        }
        if let Some(load) = system.joints[joint].spring
            && let AppliedLoad::JointSpring(spring) = &system.loads[load]
        {
            let pair = spring.coordinate.gradient(&self.x);
            let (end, [_, direction]) = &pair.ends[1];
            let on = direction * spring.force(at);
            turning += Vector3::from(moment(&end.direction(&self.x), &on));
        }
        (force, turning.into())
    }

    /// Force (N) and moment (N m), in the plane its third component, of a constraint on its second end.
    fn held_by(
        &self,
        constraint: &Constraint<D>,
        lambda: N,
        view: &View<'_, D, N>,
    ) -> (Vector<D, N>, Vector3<N>) {
        let (mut force, mut turning) = (Vector::zeros(), Vector3::zeros());
        constraint.for_each_pair(view, |pair| {
            let (end, [position, direction]) = pair.ends[1];
            force -= position * lambda;
            turning -= Vector3::from(moment(&end.direction(&self.x), &(direction * lambda)));
        });
        (force, turning)
    }

    /// Force (N) or torque (N m) of a gear on the coordinate of its second joint, or of a latch on that of its joint.
    pub fn gear(&self, system: &System<D>, gear: usize) -> N {
        let rows = system.constraints.iter().zip(&self.lambda);
        let mut own = rows.filter(|(constraint, _)| constraint.joint == Some(gear));
        own.next().map_or(N::of(0.0), |(_, lambda)| -*lambda)
    }

    /// State of a latch: 1 closed, 0 open.
    pub fn latch_state(&self, system: &System<D>, latch: usize) -> N {
        let mut constraints = system.constraints.iter();
        let own = constraints.find(|constraint| constraint.joint == Some(latch));
        let is_closed = own.is_some_and(|own| !own.is_released(&self.released));
        N::of(f64::from(u8::from(is_closed)))
    }

    /// Force (N) and moment (N m), in the plane its third component, of a coupling on what it couples to.
    pub fn coupling(&self, system: &System<D>, load: usize) -> (Vector<D, N>, [N; 3]) {
        match &system.loads[load] {
            AppliedLoad::Bushing(coupling) => {
                let [force, moment] = coupling.reaction(self.instant(system));
                (vector(force.into()), moment.into())
            }
            _ => (Vector::zeros(), [N::of(0.0); 3]),
        }
    }

    /// Tension of a load that pulls along a line, N.
    pub fn tension(&self, system: &System<D>, load: usize) -> N {
        let at = self.instant(system);
        match &system.loads[load] {
            AppliedLoad::Reeving(rope) => rope.tension(at),
            AppliedLoad::Spring(spring) => spring.tension(at),
            AppliedLoad::TableSpring(spring) => spring.force(at),
            AppliedLoad::ForceLaw(law) => law.against_growth(at),
            _ => N::of(0.0),
        }
    }

    /// Length of the line that a load pulls along, m, and the rate of that, m/s.
    pub fn length(&self, system: &System<D>, load: usize) -> [N; 2] {
        let at = self.instant(system);
        match &system.loads[load] {
            AppliedLoad::Reeving(rope) => rope.path(at),
            AppliedLoad::Spring(spring) => spring.path(at),
            AppliedLoad::TableSpring(spring) => [spring.value(at), spring.rate(at)],
            AppliedLoad::ForceLaw(law) => law.path(at),
            _ => [N::of(0.0); 2],
        }
    }

    /// Force (N) and moment (N m), in the plane its third component, of a load on its second end, or on the one that it has; of
    /// airfoils and of contact along or over a body the whole force, without a moment.
    pub fn exerted(&self, system: &System<D>, load: usize) -> (Vector<D, N>, [N; 3]) {
        let sticks = system.frictions.iter().find(|of| of.load == load);
        let (load, at) = (&system.loads[load], self.instant(system));
        let (mut force, mut turning) = (Vector::zeros(), Vector3::zeros());
        if let Some(place) = sticks.filter(|of| !self.released[of.release]) {
            let (constraint, view) = (&system.constraints[place.constraint], self.view(system));
            let (force, turning) = self.held_by(constraint, self.lambda[place.constraint], &view);
            return (force, turning.into());
        }
        match load {
            AppliedLoad::Airfoil(airfoil) => return (airfoil.whole(at), turning.into()),
            AppliedLoad::Contact(contact) => return (contact.whole(at), turning.into()),
            AppliedLoad::SurfaceContact(contact) => return (contact.whole(at), turning.into()),
            _ => {}
        }
        // Loads call with their first end, then with their second one if there is one, then with what else they act on.
        let (mut calls, mut second) = (0, None);
        load.act(at, |end, _| {
            calls += 1;
            if calls <= 2 {
                second = Some(*end);
            }
        });
        let Some(Attachment::Body(second)) = second else {
            return (force, turning.into());
        };
        load.act(at, |end, [position, direction]| {
            if *end == Attachment::Body(second) {
                force += position;
            }
            // Along other axes of the same body too.
            if let Attachment::Body(marker) = end
                && (marker.body, marker.nodes) == (second.body, second.nodes)
            {
                turning += Vector3::from(moment(&end.direction(&self.x), &direction));
            }
        });
        (force, turning.into())
    }
}

impl<const D: usize> Evaluation<D> {
    /// Force per reference length of a contact along a body at a material coordinate, N/m.
    pub fn contact(&self, system: &System<D>, load: usize, s: f64) -> Vector<D> {
        match &system.loads[load] {
            AppliedLoad::Contact(contact) => contact.nearest(self.instant(system), s),
            _ => Vector::zeros(),
        }
    }
}

impl<const D: usize> Evaluation<D> {
    /// The first load whose law has no finite value where it comes within a time, s, before or after this instant: its index, and the
    /// length or coordinate, m or rad, and rate there.
    pub fn without_value(&self, system: &System<D>, within: f64) -> Option<(usize, [f64; 2])> {
        let mut loads = system.loads.iter().enumerate();
        loads.find_map(|(index, load)| match load {
            AppliedLoad::ForceLaw(law) => {
                Some((index, law.without_value(self.instant(system), within)?))
            }
            _ => None,
        })
    }
}
