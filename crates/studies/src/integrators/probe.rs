//! A system that counts what integrators ask of it, and that keeps its constraints as the product does or by
//! coordinate partitioning.

use std::sync::{Arc, Mutex};

use flexbody::bodies::Node;
use flexbody::integrators::StateView;
use flexbody::system::{DrivenSystem, Dynamics, State, StepOutcome};
use nalgebra::Complex;

use super::partitioning::Partition;

/// Counts of operations.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Accelerations.
    pub accelerations: u64,
    /// Tangents.
    pub linearizations: u64,
    /// Factorizations; a complex one counts as one.
    pub factorizations: u64,
    /// Solves; one for three stages counts as one.
    pub solves: u64,
}

impl Tally {
    /// Adds another one.
    pub fn add(&mut self, other: &Self) {
        self.accelerations += other.accelerations;
        self.linearizations += other.linearizations;
        self.factorizations += other.factorizations;
        self.solves += other.solves;
    }
}

/// A model that counts, and leaves the nodal coordinates of every acceleration where told.
pub struct Probe<'a> {
    model: DrivenSystem<'a>,
    nodes: Option<Arc<Mutex<Vec<Node>>>>,
    partition: Option<Partition>,
    /// Operations so far.
    pub tally: Tally,
}

impl<'a> Probe<'a> {
    /// Wraps a model.
    pub fn new(model: DrivenSystem<'a>, nodes: Option<Arc<Mutex<Vec<Node>>>>) -> Self {
        let tally = Tally::default();
        Self {
            model,
            nodes,
            partition: None,
            tally,
        }
    }

    /// With constraints kept by coordinate partitioning, chosen at a state. For explicit methods: tangents are
    /// those of projection.
    pub fn partitioned(mut self, state: &State) -> Self {
        self.partition = Some(Partition::new(&mut self.model, state));
        self
    }

    /// Brings a state onto the constraints, dependent coordinates chosen as before; false where that fails.
    pub fn project(&mut self, state: &mut State) -> bool {
        match &mut self.partition {
            Some(partition) => partition.project(&mut self.model, state),
            None => self.model.project(state),
        }
    }
}

impl Dynamics for Probe<'_> {
    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        self.tally.accelerations += 1;
        let model = &mut self.model;
        match &mut self.partition {
            Some(partition) => {
                let state = StateView {
                    time,
                    coordinates: q,
                    rates: v,
                };
                partition.completed(model, state, |model, q, v| {
                    model.acceleration(time, q, v, a);
                });
            }
            None => model.acceleration(time, q, v, a),
        }
        if let Some(nodes) = &self.nodes
            && let Ok(mut nodes) = nodes.lock()
        {
            nodes.copy_from_slice(&self.model.work.kinematics.x);
        }
    }

    fn power(&mut self) -> [f64; 2] {
        self.model.power()
    }

    fn steps_in(&self, time: f64, h: f64) -> f64 {
        self.model.steps_in(time, h)
    }

    fn dissipates(&self) -> bool {
        self.model.dissipates()
    }

    fn take_out_normal(&mut self, a: &mut [f64]) {
        self.model.take_out_normal(a);
    }

    fn linearize(&mut self, time: f64, q: &[f64], v: &[f64]) {
        self.tally.linearizations += 1;
        self.model.linearize(time, q, v);
    }

    fn factor(&mut self, weights: [f64; 2]) -> bool {
        self.tally.factorizations += 1;
        self.model.factor(weights)
    }

    fn factor_complex(&mut self, weights: [Complex<f64>; 2]) -> bool {
        self.tally.factorizations += 1;
        self.model.factor_complex(weights)
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.tally.solves += 1;
        self.model.solve(x);
    }

    fn set_stage(&mut self, stage: usize) {
        self.model.set_stage(stage);
    }

    fn solve_stages(&mut self, forward: &[f64], back: &[f64], stages: &mut [Vec<f64>]) {
        self.tally.solves += 1;
        self.model.solve_stages(forward, back, stages);
    }

    fn apply_damping(&mut self, x: &mut [f64]) {
        self.model.apply_damping(x);
    }

    fn largest_rotation(&mut self, from: &[f64], to: &[f64]) -> f64 {
        self.model.largest_rotation(from, to)
    }

    fn accepted(&mut self, state: &mut State) -> StepOutcome {
        let model = &mut self.model;
        let Some(partition) = &mut self.partition else {
            return model.accepted(state);
        };
        if !partition.project(model, state) {
            return StepOutcome::ConstraintsViolated;
        }
        partition.choose(model, state);
        match model.count(state) {
            StepOutcome::AsIs => StepOutcome::Moved,
            other => other,
        }
    }

    fn is_exhausted(&self) -> bool {
        self.model.is_exhausted()
    }

    fn begin_smooth_interval(&mut self, from: f64, until: f64) -> f64 {
        self.model.begin_smooth_interval(from, until)
    }

    fn end_smooth_interval(&mut self, state: &mut State) -> StepOutcome {
        self.model.end_smooth_interval(state)
    }
}
