//! Systems in which nothing changes: loads and motions held as they are at an instant, loads at a fraction of
//! their size, joints still apart by a fraction of their gaps. What equilibria are sought in.

use crate::bodies::{Node, add_node, no_node};
use crate::math::function::Function;
use crate::math::space::{Vector, components, frame_acceleration};
use crate::system::loads::{AppliedLoad, ForceElement as _};
use crate::system::signal::Drive;
use crate::system::{Instant, System, Workspace};

/// How far joints are apart: what has to be added to the reference, and values of the constraints.
#[derive(Clone, Debug, Default)]
pub(in crate::system) struct OpenGaps<const D: usize> {
    /// Change of the reference that holds the linear rows where they are, m.
    pub reference: Vec<Node<D>>,
    /// Values of the non-linear constraints.
    pub offsets: Vec<f64>,
}

impl<const D: usize> System<D> {
    /// Returns a system whose loads and motions are frozen at the time and under the inputs in `work`. `with_initial`
    /// adds the loads of the initial state.
    pub(in crate::system) fn held(
        &self,
        time: f64,
        work: &Workspace<D>,
        with_initial: bool,
    ) -> Self {
        let at = self.instant(time, &work.kinematics);
        let mut held = self.clone();
        if with_initial {
            held.loads.extend(self.initial_loads.iter().cloned());
        }
        held.initial_loads.clear();
        for load in &mut held.loads {
            *load = load.held(at, 1.0);
        }
        for (drive, [value, ..]) in held.drives.iter_mut().zip(&work.kinematics.drives) {
            *drive = Drive::Function(Function::constant(*value));
        }
        // Directions of sliding are among the drives that stand still now.
        held.frictions.clear();
        held.sticking.clear();
        held.tracks_work = false;
        held
    }

    /// Scales gravity, the speed of rotation squared, and all loads but springs.
    pub(in crate::system) fn scale_loads(&mut self, fraction: f64, work: &Workspace<D>) {
        for load in &mut self.loads {
            let at = Instant {
                time: 0.0,
                inputs: &work.kinematics.inputs,
                input_rates: &work.kinematics.input_rates,
                drives: &work.kinematics.drives,
                x: &work.kinematics.x,
                v: &work.kinematics.v,
                bodies: &self.bodies,
                angles: (&self.angles, &work.kinematics.angles),
            };
            *load = load.held(at, fraction);
        }
        for weight in self.weight.iter_mut().flatten().flatten() {
            *weight *= fraction;
        }
        self.rotation = self.rotation.map(|rate| rate * fraction.sqrt());
    }

    /// Takes all loads, springs, gravity and rotation away.
    pub(in crate::system) fn unload(&mut self) {
        self.loads.clear();
        self.weight.fill(no_node());
        self.rotation = [0.0; 3];
    }

    /// Rotates about a point at a rate, rad/s: loads get the centrifugal force.
    pub(in crate::system) fn turn(&mut self, rate: [f64; 3], center: Vector<D>) {
        let arm = frame_acceleration(rate, center, Vector::zeros());
        let mut arms = vec![[arm.into(), [0.0; D]]; self.bodies.reference.len()];
        self.bodies.clear_axes(&mut arms);
        let mut weight = std::mem::take(&mut self.weight);
        self.bodies.add_inertia(1.0, &arms, &mut weight);
        self.weight = weight;
        self.rotation = rate;
        // The Coriolis force is that of the rates at rest, not of those that the scratch still holds.
        self.needs_rates = true;
    }

    /// Takes bodies at rest through fluids, as a whole: velocity of the origin, m/s, and angular velocity, rad/s.
    pub(in crate::system) fn carry(&mut self, velocity: Vector<D>, rate: [f64; 3]) {
        for load in &mut self.loads {
            match load {
                AppliedLoad::Fluid(fluid) => fluid.carried = (velocity, rate),
                AppliedLoad::Airfoil(airfoil) => airfoil.carried = (velocity, rate),
                AppliedLoad::SurfaceFluid(fluid) => fluid.carried = [components(&velocity), rate],
                _ => {}
            }
        }
    }

    /// Holds joints apart by a fraction of their gaps.
    pub(in crate::system) fn open(&mut self, open: &OpenGaps<D>, fraction: f64) {
        for (x, change) in self.bodies.reference.iter_mut().zip(&open.reference) {
            add_node(x, fraction, change);
        }
        for (constraint, offset) in self.constraints.iter_mut().zip(&open.offsets) {
            constraint.offset = fraction * offset;
        }
    }

    /// Whether the loads have a potential, so that the tangent is symmetric: follower forces do not.
    pub fn is_conservative(&self) -> bool {
        self.loads.iter().all(|load| load.is_conservative())
    }
}
