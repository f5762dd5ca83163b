//! Loads of inputs and ports: what comes in, and springs and dampers to what moves outside.

use super::Builder;
use crate::scene::resolved::{Coupling, InputKind, PortKind, ResolvedPort};
use crate::system::Signal;
use crate::system::loads::{
    AppliedLoad, Bushing, BushingMeasure, FromAngle, FromOrientation, FromPoint,
};

impl<const D: usize> Builder<'_, D> {
    pub(super) fn inputs(&mut self) {
        for input in &self.resolved.inputs {
            self.input(&input.kind);
        }
    }

    /// A load whose size is an input; a spring whose length is one has been built.
    fn input(&mut self, input: &InputKind<'_>) {
        if let InputKind::Action(action) = input {
            let built = self.action(action);
            self.parts.loads.push(built);
        }
    }

    pub(super) fn ports(&mut self) {
        for port in &self.resolved.ports {
            match &port.kind {
                PortKind::Force { inputs, .. } => {
                    inputs.iter().for_each(|input| self.input(&input.kind));
                }
                PortKind::Motion { .. } => {}
                PortKind::Coupling { position, angle } => {
                    self.couple_position(port, position);
                    match angle {
                        Some(angle) if D == 2 => self.couple_angle(port, angle),
                        Some(angle) => self.couple_orientation(port, angle),
                        None => {}
                    }
                }
            }
        }
    }

    fn couple_position(&mut self, port: &ResolvedPort<'_>, coupling: &Coupling<'_>) {
        let signal = |k| Signal::Input(coupling.first + k);
        let of = BushingMeasure::Point(FromPoint {
            marker: self.marker(port.marker),
            position: std::array::from_fn(|k| signal(2 * k)),
            velocity: std::array::from_fn(|k| signal(2 * k + 1)),
        });
        self.couple(of, 0, coupling);
    }

    fn couple_angle(&mut self, port: &ResolvedPort<'_>, coupling: &Coupling<'_>) {
        let of = BushingMeasure::Angle(FromAngle {
            marker: self.marker(port.marker),
            counted: self.count_angle(self.on_marker(port.marker), None),
            angle: Signal::Input(coupling.first),
            velocity: Signal::Input(coupling.first + 1),
        });
        self.couple(of, 1, coupling);
    }

    fn couple_orientation(&mut self, port: &ResolvedPort<'_>, coupling: &Coupling<'_>) {
        let signal = |k| Signal::Input(coupling.first + k);
        let axes = self.frame_axes(port.marker);
        let of = BushingMeasure::Orientation(FromOrientation {
            axes: std::array::from_fn(|k| axes[k]),
            quaternion: std::array::from_fn(signal),
            velocity: std::array::from_fn(|k| signal(4 + k)),
        });
        self.couple(of, 1, coupling);
    }

    /// Adds a bushing whose stiffness and damping are the same along (part 0) or about (part 1) all axes.
    fn couple(&mut self, measure: BushingMeasure<D>, part: usize, coupling: &Coupling<'_>) {
        let all = |value: f64| {
            let mut parts = [[0.0; 3]; 2];
            parts[part] = [value; 3];
            parts
        };
        self.couplings.push(self.parts.loads.len());
        self.parts
            .loads
            .push(AppliedLoad::Bushing(Box::new(Bushing {
                measure,
                stiffness: all(coupling.stiffness),
                damping: all(coupling.damping),
            })));
    }
}
