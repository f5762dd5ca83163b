//! Loads of ports: what comes in, and springs and dampers to what moves outside.

use super::Builder;
use crate::scene::resolved::{Coupling, PortKind, ResolvedPort};
use crate::system::Signal;
use crate::system::loads::{self, AppliedLoad, OrientationBushing, RotationalBushing};

impl<const D: usize> Builder<'_, D> {
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
        self.couple(AppliedLoad::Bushing(loads::Bushing {
            marker: self.marker(port.marker),
            stiffness: coupling.stiffness,
            damping: coupling.damping,
            position: std::array::from_fn(|k| signal(2 * k)),
            velocity: std::array::from_fn(|k| signal(2 * k + 1)),
        }));
    }

    fn couple_angle(&mut self, port: &ResolvedPort<'_>, coupling: &Coupling<'_>) {
        let counted = self.count_angle(self.on_marker(port.marker), None);
        self.couple(AppliedLoad::RotationalBushing(RotationalBushing {
            marker: self.marker(port.marker),
            counted,
            stiffness: coupling.stiffness,
            damping: coupling.damping,
            angle: Signal::Input(coupling.first),
            velocity: Signal::Input(coupling.first + 1),
        }));
    }

    fn couple_orientation(&mut self, port: &ResolvedPort<'_>, coupling: &Coupling<'_>) {
        let signal = |k| Signal::Input(coupling.first + k);
        let axes = self.frame_axes(port.marker);
        let bushing = OrientationBushing {
            axes: std::array::from_fn(|k| axes[k]),
            stiffness: coupling.stiffness,
            damping: coupling.damping,
            quaternion: std::array::from_fn(signal),
            velocity: std::array::from_fn(|k| signal(4 + k)),
        };
        self.couple(AppliedLoad::OrientationBushing(Box::new(bushing)));
    }

    fn couple(&mut self, load: AppliedLoad<D>) {
        self.couplings.push(self.parts.loads.len());
        self.parts.loads.push(load);
    }
}
