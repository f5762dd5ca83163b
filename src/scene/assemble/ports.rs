//! Loads of ports: what comes in, and springs and dampers to what moves outside.

use nalgebra::Vector2;

use super::Builder;
use crate::scene::{Port, PortKind};
use crate::system::loads::{Coupling, Load, Turning};
use crate::system::{End, Signal};

impl Builder<'_> {
    pub(super) fn ports(&mut self) {
        let scene = self.scene;
        for (place, port) in scene.ports.iter().enumerate() {
            let first = self.layout.of_ports[place];
            match port.kind {
                PortKind::Force => self.force_port(port, first),
                PortKind::Motion if port.is_coupling() => self.coupling(port, first),
                PortKind::Motion => {}
            }
        }
    }

    fn force_port(&mut self, port: &Port, mut first: usize) {
        for input in port.inputs() {
            self.input(&input, first);
            first += input.components();
        }
    }

    fn coupling(&mut self, port: &Port, first: usize) {
        let (marker, signal) = (self.marker(&port.marker), |k| Signal::Input(first + k));
        // As with motions, the value and the rate of each coordinate lie side by side.
        self.couple(Load::Coupling(Coupling {
            marker,
            stiffness: port.stiffness.unwrap_or(0.0),
            damping: port.damping.unwrap_or(0.0),
            position: [signal(0), signal(2)],
            velocity: [signal(1), signal(3)],
        }));
        if port.turns() {
            let ends = [End::Ground(Vector2::zeros()), End::Body(marker)];
            let counted = self.count_angle(ends);
            self.couple(Load::Turning(Turning {
                marker,
                counted,
                stiffness: port.rotational_stiffness.unwrap_or(0.0),
                damping: port.rotational_damping.unwrap_or(0.0),
                angle: signal(4),
                velocity: signal(5),
            }));
        }
    }

    fn couple(&mut self, load: Load) {
        self.couplings.push(self.parts.loads.len());
        self.parts.loads.push(load);
    }
}
