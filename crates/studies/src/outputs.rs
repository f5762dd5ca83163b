//! What runs write: the same columns for every method.

use flexbody::bodies::Marker;
use flexbody::scene::{Output, OutputKind, OutputTarget};
use flexbody::system::{Evaluation, State, Workspace};

use crate::scene::Start;

/// Positions of markers that the scene reads, energies, momenta and residuals, as CSV.
pub struct Outputs {
    markers: Vec<Marker>,
    evaluation: Evaluation,
    /// The file so far.
    pub text: String,
}

impl Outputs {
    /// The header.
    pub fn new(start: &Start) -> Self {
        let resolved = start.scene.resolved();
        let read: Vec<_> = (resolved.outputs.iter())
            .filter_map(|output| match output {
                Output {
                    kind: OutputKind::Position,
                    of: OutputTarget::Marker(marker),
                    ..
                } => Some(*marker),
                _ => None,
            })
            .collect();
        let mut header = vec!["time".to_owned()];
        for marker in &read {
            let name = marker.name;
            header.extend([format!("{name}.position[1]"), format!("{name}.position[2]")]);
        }
        let rest = ["kinetic", "strain", "gravity"].map(|kind| format!("energy.{kind}"));
        header.extend(rest);
        header.extend(["momentum[1]", "momentum[2]", "angular_momentum"].map(str::to_owned));
        header.extend(["residual.position", "residual.velocity"].map(str::to_owned));
        Self {
            markers: (read.iter())
                .map(|marker| *start.assembled.marker(marker.id))
                .collect(),
            evaluation: Evaluation::new(&start.assembled.system),
            text: header.join(",") + "\n",
        }
    }

    /// A row at a state.
    pub fn add(&mut self, start: &Start, state: &State, work: &mut Workspace) {
        let (system, values) = (&start.assembled.system, &mut self.evaluation);
        values.kinematics(system, state, work);
        let mut row = vec![state.time];
        for marker in &self.markers {
            let position = marker.position(&values.x);
            row.extend([position[0], position[1]]);
        }
        row.push(values.kinetic_energy(system));
        row.push(values.strain_energy(system));
        row.push(values.gravity_energy(system));
        let (momentum, [.., angular]) = values.momentum(system);
        row.extend([momentum[0], momentum[1], angular]);
        row.extend(values.residuals(system));
        let words: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
        self.text += &(words.join(",") + "\n");
    }
}
