//! Floor 3. A system: bodies, joints and loads, constant after assembly; its state, plain numbers;
//! and scratch. `System` computes with `State` and `Work` and keeps nothing of its own.

pub mod dynamics;
pub mod equilibrium;
pub mod joints;
pub mod loads;
mod outputs;
mod state;

pub use dynamics::{Dynamics, Model};
pub use outputs::Evaluation;
pub use state::State;

use nalgebra::Vector2;

use crate::body::{FlexibleBody, Marker, Scratch, Tangent};
use crate::elements::cable::Cable;
use crate::elements::{Element, Nodal};
use joints::Joint;
use loads::Load;

/// Bodies of a planar system.
pub type PlanarBody = FlexibleBody<Cable<2, 1>, 2, 4>;

/// Everything about a system that does not change in time.
#[derive(Clone, Debug)]
pub struct System {
    body: PlanarBody,
    gravity: Vector2<f64>,
    /// Forces of gravity on the elements, N.
    weight: Vec<Nodal<2>>,
    joints: Vec<Joint>,
    loads: Vec<Load>,
    /// Markers whose angle is counted on over full turns.
    angles: Vec<Marker>,
}

/// Scratch of a system: nothing allocates in a step.
#[derive(Clone, Debug)]
pub struct Work {
    pub(crate) scratch: Scratch<2>,
    pub(crate) tangent: Tangent<2, 4>,
    /// A vector of generalized coordinates.
    pub(crate) q: Vec<f64>,
}

impl System {
    /// A system of one body; `angles` are the markers whose angle its states count.
    pub fn new(
        body: PlanarBody,
        gravity: Vector2<f64>,
        joints: Vec<Joint>,
        loads: Vec<Load>,
        angles: Vec<Marker>,
    ) -> Self {
        let weight = body
            .elements()
            .iter()
            .map(|element| gravity * element.weight().transpose())
            .collect();
        Self {
            body,
            gravity,
            weight,
            joints,
            loads,
            angles,
        }
    }

    /// The body.
    pub fn body(&self) -> &PlanarBody {
        &self.body
    }

    /// Gravitational acceleration, m/s^2.
    pub fn gravity(&self) -> Vector2<f64> {
        self.gravity
    }

    /// Number of components of all inputs.
    pub fn inputs(&self) -> usize {
        self.loads.iter().map(Load::components).sum()
    }

    /// Scratch for this system.
    pub fn work(&self) -> Work {
        Work {
            scratch: self.body.scratch(),
            tangent: self.body.tangent(),
            q: vec![0.0; self.body.coordinates()],
        }
    }

    /// The reference configuration at rest; angles are those of the slopes in (-pi, pi] once accepted.
    pub fn reference_state(&self, time: f64) -> State {
        let n = self.body.coordinates();
        State {
            time,
            step: 0.0,
            coordinates: vec![0.0; n],
            rates: vec![0.0; n],
            angles: vec![0.0; self.angles.len()],
        }
    }

    /// Whether a state has the sizes of this system.
    pub fn fits(&self, state: &State) -> bool {
        let n = self.body.coordinates();
        let found = (
            state.coordinates.len(),
            state.rates.len(),
            state.angles.len(),
        );
        found == (n, n, self.angles.len())
    }

    /// Rates of a rigid motion: `velocity` of the first end and `spin` about it, as close as the
    /// constraints allow in the mass norm.
    pub fn rigid_rates(
        &self,
        velocity: Vector2<f64>,
        spin: f64,
        work: &mut Work,
        rates: &mut [f64],
    ) {
        let reference = self.body.reference();
        let turn = nalgebra::Matrix2::new(0.0, -spin, spin, 0.0);
        let origin: Vector2<f64> = reference[0].column(0).into();
        let motion: Vec<Nodal<2>> = reference
            .iter()
            .map(|e| {
                let mut rate = turn * e;
                for column in [0, 2] {
                    let position = velocity - turn * origin + rate.column(column);
                    rate.set_column(column, &position);
                }
                rate
            })
            .collect();
        self.body.project(&motion, &mut work.scratch, rates);
    }

    /// Total force on the elements at `work.scratch.e`, `.rate` into `.force`, under a fraction of gravity.
    fn forces(&self, inputs: &[f64], gravity: f64, work: &mut Work) {
        let Scratch { e, rate, force, .. } = &mut work.scratch;
        force
            .iter_mut()
            .zip(&self.weight)
            .for_each(|(f, w)| *f = w * gravity);
        self.body.add_force(e, rate, force);
        let mut first = 0;
        for load in &self.loads {
            load.add_force(&inputs[first..], e, force);
            first += load.components();
        }
    }

    /// Adds what loads contribute to the tangent.
    fn load_stiffness(&self, inputs: &[f64], work: &mut Work) {
        let mut first = 0;
        for load in &self.loads {
            load.add_stiffness(&inputs[first..], &work.scratch.e, &mut work.tangent);
            first += load.components();
        }
    }
}
