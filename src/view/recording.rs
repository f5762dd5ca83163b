//! A run, as pictures of it are drawn from: how bodies stand and what acts on them at some communication points, outputs at some or all.

use super::actions::{MovingAction, actions};
use super::sheets::SheetModes;
use super::skins;
use crate::scene::Scene;
use crate::simulation::{Causality, InputTable, Pose, Signals, Simulation, Variable};

/// How much of a run is kept, and how long it may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most frames, communication points at which bodies are drawn, but two at least. They are as evenly among all as can be, the first
    /// and the last with them; between two of them bodies go straight on.
    pub frames: usize,
    /// Most values of outputs. Where there are more, outputs are kept at frames only.
    pub values: usize,
    /// Most bytes of a page for its numbers, which the number of frames is limited by too.
    pub bytes: usize,
    /// Most work (evaluations times parts): the run ends where it has done more. The same on every machine, as time is not.
    pub work: f64,
}

impl Limits {
    /// Budget of a page that is made to look at one run.
    pub const PAGE: Self = Self {
        frames: 600,
        values: 1_000_000,
        bytes: usize::MAX,
        work: f64::INFINITY,
    };

    /// Budget of the page inside a unit, of 300 kB in the plane and 700 kB in space, of which the program takes 215 kB.
    pub const fn unit(dimension: usize) -> Self {
        Self {
            frames: 300,
            values: 0,
            bytes: if dimension == 2 { 50_000 } else { 330_000 },
            work: 1e8,
        }
    }
}

/// Part of its natural size that is roundoff of an output.
const ROUNDOFF: f64 = 1e-9;
/// Fewest frames of a picture that moves.
const FEWEST_FRAMES: usize = 25;

/// An output of a run.
pub(super) struct RecordedOutput {
    /// Name of the variable.
    pub name: String,
    /// Unit, for people.
    pub unit: String,
    /// Largest change that is roundoff, in the unit.
    pub roundoff: f64,
}

/// An input that keeps its value.
pub struct HeldInput {
    /// Name of the variable.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Unit, for people.
    pub unit: String,
}

/// A run of a scene.
pub struct Recording {
    /// The scene as it was simulated.
    pub(super) scene: Scene,
    /// Times of frames, s.
    pub(super) times: Vec<f64>,
    /// How all bodies stand in every frame.
    pub(super) poses: Vec<Vec<Pose>>,
    /// Components of what acts, in every frame, one after the other.
    pub(super) acting: Vec<Vec<Vec<f64>>>,
    /// Where markers are at the start, m.
    pub(super) markers: Vec<[f64; 3]>,
    /// How all bodies stand where the scene draws them.
    pub(super) drawn: Vec<Pose>,
    /// Axial force (N) and bending moments (N m) at the nodes of all bodies, in every frame.
    pub(super) forces: Vec<Vec<Vec<[f64; 3]>>>,
    /// Stress at the bottom and the top of plates and shells, by body and point, in every frame, Pa.
    pub(super) stresses: Vec<Vec<Vec<[f64; 6]>>>,
    /// Outputs.
    pub(super) outputs: Vec<RecordedOutput>,
    /// Inputs that nothing moves.
    held: Vec<HeldInput>,
    /// Times (s) and values of outputs.
    pub(super) row_times: Vec<f64>,
    pub(super) rows: Vec<Vec<f64>>,
    /// Motions of plates and shells, by body.
    pub(super) sheets: Vec<Option<SheetModes>>,
    /// Why it ended before the experiment does.
    pub(super) stopped: Option<String>,
}

impl Recording {
    /// Simulates the default experiment of a scene, with inputs that follow a table where one is given. After every step it is told how
    /// many were made, and of how many.
    ///
    /// # Errors
    /// There is no initial state, or it is too large for the limits; inputs that are none. A run that fails later is kept so far.
    pub fn new(
        scene: &Scene,
        inputs: Option<&InputTable>,
        limits: &Limits,
        told: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, String> {
        let mut simulation = Simulation::new(scene.clone());
        let scene = simulation.scene().clone();
        let resolved = scene.resolve().map_err(|error| error.to_string())?;
        let signals = inputs.map(|table| table.signals(simulation.variables()));
        let signals = signals.transpose().map_err(|error| error.to_string())?;
        if let Some(signals) = &signals {
            simulation
                .set_inputs(signals)
                .map_err(|error| error.to_string())?;
        }
        let started = simulation.initialize(0.0).and_then(|()| simulation.start());
        started.map_err(|error| error.to_string())?;
        let mut run = UnfinishedRecording::new(scene.clone(), simulation, signals.as_ref())?;
        let actions = actions(&resolved);
        run.frame(&actions)?;
        let steps = scene.experiment.steps() as u64;
        let frames = run.frames(limits, steps)?;
        let all_rows = limits.values as f64 >= steps as f64 * run.columns.len() as f64;
        run.row()?;
        let mut work = 0.0;
        for number in 1..=steps {
            let until = (number as f64 * scene.experiment.step).min(scene.experiment.stop_time);
            let stepped = run.step(signals.as_ref(), until, &mut work);
            told(number, steps);
            let is_frame = number * frames / steps != (number - 1) * frames / steps;
            if let Err(reason) = stepped {
                run.recording.stopped = Some(reason);
            } else if work > limits.work {
                run.recording.stopped = Some("it takes more work than a page may".into());
            }
            let is_last = run.recording.stopped.is_some();
            if is_frame || is_last {
                run.frame(&actions)?;
            }
            if is_frame || is_last || all_rows {
                run.row()?;
            }
            if is_last {
                break;
            }
        }
        Ok(run.recording.with_sheets())
    }

    /// With the motions of its plates and shells as modes.
    fn with_sheets(mut self) -> Self {
        let bodies = self.drawn.iter_mut().enumerate();
        let sheets = bodies.map(|(body, drawn)| {
            let is_sheet = !drawn.surface.is_empty();
            let stresses: Vec<&[[f64; 6]]> =
                (self.stresses.iter().map(|bodies| &bodies[body][..])).collect();
            is_sheet.then(|| SheetModes::of(drawn, &mut self.poses, body).with_stress(&stresses))
        });
        self.sheets = sheets.collect();
        self
    }

    /// Times of frames, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Inputs that nothing moves, in the order of the variables.
    pub fn held(&self) -> &[HeldInput] {
        &self.held
    }

    /// Why the run ended before its experiment, if it did.
    pub fn stopped(&self) -> Option<&str> {
        self.stopped.as_deref()
    }
}

/// A recording in the making.
struct UnfinishedRecording {
    simulation: Simulation,
    /// Outputs among the variables.
    columns: Vec<usize>,
    recording: Recording,
}

impl UnfinishedRecording {
    fn new(
        scene: Scene,
        mut simulation: Simulation,
        signals: Option<&Signals>,
    ) -> Result<Self, String> {
        let unit = |variable: &Variable| variable.unit.map_or(String::new(), |u| u.symbol());
        let with = |causality| {
            let variables = simulation.variables().iter().enumerate();
            variables.filter(move |(_, variable)| Causality::of(variable) == causality)
        };
        let output = |(index, variable): (usize, &Variable)| {
            let curve = RecordedOutput {
                name: variable.name.clone(),
                unit: unit(variable),
                roundoff: ROUNDOFF * simulation.natural_size(variable),
            };
            (index, curve)
        };
        let (columns, outputs) = with(Causality::Output).map(output).unzip();
        let held = with(Causality::Input)
            .filter(|(index, _)| signals.is_none_or(|signals| !signals.holds(*index)))
            .map(|(index, variable)| HeldInput {
                name: variable.name.clone(),
                value: simulation.setting(index),
                unit: unit(variable),
            });
        let held = held.collect();
        let markers = simulation.markers().map_err(|error| error.to_string())?;
        let drawn = simulation
            .drawn_poses()
            .map_err(|error| error.to_string())?;
        Ok(Self {
            simulation,
            columns,
            recording: Recording {
                scene,
                drawn,
                forces: Vec::new(),
                stresses: Vec::new(),
                held,
                times: Vec::new(),
                poses: Vec::new(),
                acting: Vec::new(),
                markers,
                outputs,
                row_times: Vec::new(),
                rows: Vec::new(),
                sheets: Vec::new(),
                stopped: None,
            },
        })
    }

    /// How many frames after the first the limits allow.
    fn frames(&self, limits: &Limits, steps: u64) -> Result<u64, String> {
        let recording = &self.recording;
        let [surfaces, skins] = skins::size(&recording.scene);
        let poses = recording.poses[0].iter();
        let numbers = |pose: &Pose| 6 * pose.nodes.len() + 4 * pose.axes.len();
        let stepped: usize = poses.map(numbers).sum::<usize>()
            + recording.acting[0].iter().map(Vec::len).sum::<usize>()
            + 3 * recording.forces[0].iter().map(Vec::len).sum::<usize>()
            + skins;
        let exact = self.columns.len() + 2;
        let fit = limits.bytes.saturating_sub(surfaces) / (2 * stepped + 8 * exact);
        if fit < FEWEST_FRAMES {
            return Err("it is too large to be shown in motion on a page of this size".into());
        }
        let most = limits.frames.min(fit).max(2) as u64 - 1;
        Ok(most.min(steps))
    }

    fn step(
        &mut self,
        signals: Option<&Signals>,
        until: f64,
        work: &mut f64,
    ) -> Result<(), String> {
        let simulation = &mut self.simulation;
        while simulation.time() < until {
            let before = simulation.time();
            match signals {
                Some(signals) => simulation.step_along(signals, until)?,
                None => simulation
                    .step(until)
                    .map_err(|failure| failure.to_string())?,
            }
            *work += simulation.report().work;
            if simulation.time() <= before {
                return Err("it does not go on".into());
            }
        }
        Ok(())
    }

    fn frame(&mut self, actions: &[MovingAction<'_>]) -> Result<(), String> {
        let poses = self.simulation.poses().map_err(|error| error.to_string())?;
        let forces = self.simulation.section_forces();
        let stresses = self.simulation.face_stresses();
        let values = actions
            .iter()
            .map(|action| action.values(&mut self.simulation, &poses));
        let values: Result<Vec<Vec<f64>>, _> = values.collect();
        self.recording.times.push(self.simulation.time());
        self.recording.poses.push(poses);
        self.recording
            .forces
            .push(forces.map_err(|error| error.to_string())?);
        self.recording
            .stresses
            .push(stresses.map_err(|error| error.to_string())?);
        self.recording
            .acting
            .push(values.map_err(|error| error.to_string())?);
        Ok(())
    }

    fn row(&mut self) -> Result<(), String> {
        let simulation = &mut self.simulation;
        let values = self.columns.iter().map(|index| simulation.real(*index));
        let values: Result<Vec<f64>, _> = values.collect();
        self.recording
            .rows
            .push(values.map_err(|error| error.to_string())?);
        self.recording.row_times.push(simulation.time());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let text = r#"{ "name": "swing", "dimension": 2, "gravity": [0.0, -9.81],
          "bodies": [ { "name": "rod", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [0.5, 0.0],
            "markers": { "root": [-0.5, 0.0] } } ],
          "joints": [ { "name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"] } ],
          "outputs": [ { "kind": "position", "marker": "rod.root" } ],
          "experiment": { "stop_time": 1.0, "step": 0.01 } }"#;
        Scene::from_json(text).expect("a valid scene")
    }

    fn record(limits: Limits) -> Result<Recording, String> {
        Recording::new(&scene(), None, &limits, &mut |_, _| ())
    }

    #[test]
    fn frames_are_even_among_communication_points_and_outputs_at_all_that_fit() {
        let run = record(Limits::PAGE).expect("a run");
        assert_eq!([run.times.len(), run.rows.len()], [101, 101]);
        let few = Limits {
            frames: 34,
            values: 100,
            ..Limits::PAGE
        };
        let run = record(few).expect("a run");
        assert_eq!([run.times.len(), run.rows.len()], [34, 34]);
        assert_eq!(run.times, run.row_times);
        assert_eq!([run.times[0], run.times[33]], [0.0, 1.0]);
        let gaps = run.times.windows(2).map(|pair| pair[1] - pair[0]);
        assert!({ gaps }.all(|gap| gap > 0.029 && gap < 0.041));
        assert_eq!(run.stopped(), None);
    }

    #[test]
    fn inputs_without_a_column_are_held_and_roundoff_follows_the_scene() {
        let mut text: serde_json::Value = serde_json::from_str(&scene().to_json()).expect("JSON");
        text["inputs"] = serde_json::json!([{ "kind": "torque", "joint": "pin", "start": [0.25] }]);
        let scene = Scene::from_json(&text.to_string()).expect("a valid scene");
        let held = |inputs: Option<&InputTable>| -> Vec<(String, f64)> {
            let run = Recording::new(&scene, inputs, &Limits::PAGE, &mut |_, _| ());
            let run = run.expect("a run");
            let roundoff: Vec<f64> = run.outputs.iter().map(|output| output.roundoff).collect();
            assert!(
                roundoff.iter().all(|least| (1e-10..1e-8).contains(least)),
                "{roundoff:?}"
            );
            run.held()
                .iter()
                .map(|input| (input.name.clone(), input.value))
                .collect()
        };
        assert_eq!(held(None), [("pin.torque".to_owned(), 0.25)]);
        let table = InputTable {
            text: "time,pin.torque\n0,1\n1,2\n".into(),
            curve: crate::scene::Interpolation::Linear,
        };
        assert_eq!(held(Some(&table)), []);
    }

    #[test]
    fn bytes_bound_frames_and_work_the_run() {
        let bytes = |bytes| Limits {
            bytes,
            ..Limits::PAGE
        };
        // A pose is counted as 6 numbers of two bytes, the force of the joint as 2, two outputs and two times as doubles.
        let run = record(bytes(48 * 40)).expect("a run");
        assert_eq!(run.times.len(), 40);
        assert!(record(bytes(48 * 24)).is_err_and(|told| told.contains("too large")));
        let little = Limits {
            work: 200.0,
            ..Limits::PAGE
        };
        let run = record(little).expect("a run");
        assert!(run.stopped().is_some_and(|reason| reason.contains("work")));
        assert!(run.times.len() > 1 && run.times.last() < Some(&1.0));
        assert_eq!(record(little).expect("a run").times, run.times);
    }

    #[test]
    fn forces_of_joints_are_kept_whether_they_are_outputs_or_not() {
        let run = record(Limits::PAGE).expect("a run");
        // Of a rod that is let go level: m g (1 - m a^2 / (J + m a^2)).
        let [first] = &run.acting[0][..] else {
            panic!("one joint");
        };
        assert!((first[1] - 9.81 * (1.0 - 0.25 / 0.35)).abs() < 1e-9 && first[0].abs() < 1e-9);
    }

    #[test]
    fn what_springs_do_and_moments_of_joints_are_kept() {
        let text = r#"{ "name": "held", "dimension": 2, "gravity": [0.0, -10.0],
          "bodies": [
            { "name": "arm", "element": "rigid", "mass": 2.0, "inertia": 0.1, "position": [0.5, 0.0],
              "markers": { "root": [-0.5, 0.0] } },
            { "name": "vane", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [3.0, 0.0],
              "markers": { "axle": [0.0, 0.0] } },
            { "name": "bead", "element": "rigid", "mass": 1.0, "position": [5.0, 2.0],
              "markers": { "eye": [0.0, 0.0] } } ],
          "joints": [ { "name": "wall", "kind": "weld", "markers": ["ground", "arm.root"] },
                      { "name": "pin", "kind": "revolute", "markers": ["ground", "vane.axle"] },
                      { "name": "rail", "kind": "point_on_line", "markers": ["ground", "bead.eye"], "direction": [0.0, 1.0] } ],
          "loads": [ { "name": "rope", "kind": "spring_damper", "markers": ["ground", "bead.eye"], "point": [5.0, 0.0],
                       "stiffness": 30.0, "length": 1.5 },
                     { "name": "vane_spring", "kind": "joint_spring", "joint": "pin", "stiffness": 5.0, "rest": 0.2 },
                     { "name": "buffer", "kind": "joint_limit", "joint": "rail", "stiffness": 8.0, "lower": 0.25 } ],
          "experiment": { "stop_time": 0.1, "step": 0.1 } }"#;
        let scene = Scene::from_json(text).expect("a valid scene");
        let run = Recording::new(&scene, None, &Limits::PAGE, &mut |_, _| ()).expect("a run");
        // Springs by Hooke's law, joint limits by how far they are passed; then forces and moments of joints.
        let expected: [&[f64]; 7] = [
            &[0.0, -15.0],
            &[1.0],
            &[0.0, 2.0],
            &[0.0, 20.0],
            &[10.0],
            &[0.0, 10.0],
            &[0.0, 0.0],
        ];
        assert_eq!(run.acting[0].len(), expected.len());
        for (found, wanted) in run.acting[0].iter().zip(expected) {
            let near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near && found.len() == wanted.len(), "{found:?} {wanted:?}");
        }
    }
}
