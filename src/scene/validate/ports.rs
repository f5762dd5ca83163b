//! Checks of ports.

use std::collections::BTreeSet;

use super::checks::{expected, not_negative, quoted, spring_damper};
use crate::scene::Error;
use crate::scene::description::{ActionKind, Along, MotionPort, OutputKind, Port, PortKind};
use crate::scene::loads::{Action, LoadPlace};
use crate::scene::motions::{Driven, DrivenKind, ResolvedMotion};
use crate::scene::resolved::{
    self, Coupling, CouplingId, DirectionSource, Incoming, InputKind, Output, OutputTarget,
    Resolved, ResolvedMarker,
};
use crate::scene::unit::spring_units;
use crate::system::Signal;

impl MotionPort {
    fn validate_springs(&self, path: &str) -> Result<(), Error> {
        let rotational = [
            ("rotational_stiffness", self.rotational_stiffness, "N m/rad"),
            ("rotational_damping", self.rotational_damping, "N m s/rad"),
        ];
        let is_rotational = rotational.iter().any(|(_, value, _)| value.is_some());
        if !self.is_coupling() && !is_rotational {
            return Ok(());
        }
        spring_damper(path, self.stiffness, self.damping, spring_units(false))?;
        if self.rotation && !is_rotational {
            let wanted = "a rotational stiffness or a rotational damping";
            return Err(expected(path, wanted, "neither"));
        }
        for (key, value, unit) in rotational {
            if let Some(value) = value {
                not_negative(&format!("{path}.{key}"), unit, value)?;
            }
        }
        Ok(())
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the ports with their inputs and outputs.
    ///
    /// # Errors
    /// A missing key, a marker that does not exist, has no angle or is driven already, or a stiffness or damping out of
    /// range.
    pub(super) fn resolve_ports(&mut self) -> Result<(), Error> {
        let driven = self.motions.iter().filter_map(|motion| {
            let quantity = motion.driven.quantity();
            match (quantity.place, quantity.exerts) {
                (LoadPlace::Marker(_), [false, false]) => None,
                (LoadPlace::Marker(marker), [_, has_moment]) => Some((has_moment, marker.name)),
                _ => None,
            }
        });
        let mut driven: BTreeSet<(bool, &str)> = driven.collect();
        for (index, port) in self.scene.ports.iter().enumerate() {
            let path = format!("ports[{index}]");
            let place = format!("{path}.marker");
            if let PortKind::Motion(motion) = &port.kind {
                motion.validate_springs(&path)?;
            }
            let is_spatial = self.scene.dimension == 3;
            let marker = if !port.turns() {
                self.require_marker(&place, &port.marker)?
            } else if port.drives() && is_spatial {
                self.require_driven(&place, &port.marker)?
            } else {
                self.require_spinning(&place, &port.marker)?
            };
            if port.drives() {
                for is_angle in [false, true]
                    .into_iter()
                    .take(1 + usize::from(port.turns()))
                {
                    if !driven.insert((is_angle, marker.name)) {
                        let wanted = if is_angle {
                            "a marker whose direction is not driven yet"
                        } else {
                            "a marker that is not driven yet"
                        };
                        return Err(expected(&place, wanted, quoted(&port.marker)));
                    }
                }
            }
            let kind = match &port.kind {
                PortKind::Force(_) => self.force_port(port, marker),
                PortKind::Motion(motion) if motion.is_coupling() => {
                    self.coupling_port(motion, marker)
                }
                PortKind::Motion(_) => self.motion_port(&path, port, marker),
            };
            self.ports.push(resolved::ResolvedPort {
                name: &port.name,
                marker,
                kind,
                given: port,
            });
        }
        Ok(())
    }

    fn force_port(&mut self, port: &'a Port, marker: ResolvedMarker<'a>) -> resolved::PortKind<'a> {
        use OutputKind::*;
        let mut inputs = vec![self.action_input(ActionKind::Force, marker)];
        let of = OutputTarget::Marker(marker);
        let mut outputs = vec![(Position, of), (Velocity, of), (Acceleration, of)];
        if port.turns() {
            inputs.push(self.action_input(ActionKind::Moment, marker));
            let source = DirectionSource::Marker(marker);
            let stands = match self.scene.dimension {
                2 => (Angle, self.count_angle(source)),
                _ => (Quaternion, of),
            };
            let of = OutputTarget::Rotation(source);
            outputs.extend([stands, (AngularVelocity, of), (AngularAcceleration, of)]);
        }
        let outputs = outputs.into_iter();
        let outputs = outputs.map(|(kind, of)| Output {
            kind,
            of,
            along: Along::Global,
        });
        let outputs = outputs.collect();
        resolved::PortKind::Force { inputs, outputs }
    }

    /// A force or a moment that comes in.
    fn action_input(
        &mut self,
        kind: ActionKind,
        marker: ResolvedMarker<'a>,
    ) -> resolved::Input<'a> {
        let count = kind.components(self.scene.dimension);
        let first = self.place(count);
        resolved::Input {
            kind: InputKind::Action(Action {
                kind,
                on: LoadPlace::Marker(marker),
                follower: false,
                components: (0..count).map(|k| Signal::Input(first + k)).collect(),
                along: Vec::new(),
                given: &[],
            }),
            first,
            start: vec![0.0; count],
        }
    }

    /// The motions that come in: with two derivatives or, with a spring and damper, which do not feel
    /// accelerations, with one.
    fn position(&mut self, marker: ResolvedMarker<'a>, derivatives: usize) -> Driven<'a> {
        let coordinates = 0..self.scene.dimension;
        Driven {
            kind: DrivenKind::Position(marker),
            drives: coordinates.map(|_| self.driven(derivatives)).collect(),
        }
    }

    fn angle(&mut self, marker: ResolvedMarker<'a>, derivatives: usize) -> Driven<'a> {
        if self.scene.dimension == 2 {
            return Driven {
                kind: DrivenKind::Angle(DirectionSource::Marker(marker)),
                drives: vec![self.driven(derivatives)],
            };
        }
        Driven {
            kind: DrivenKind::Orientation(marker),
            drives: self.rotation_drives(derivatives),
        }
    }

    fn motion_port(
        &mut self,
        path: &str,
        port: &'a Port,
        marker: ResolvedMarker<'a>,
    ) -> resolved::PortKind<'a> {
        let position = self.position(marker, 2);
        let angle = port.turns().then(|| self.angle(marker, 2));
        let mut motion = |driven| ResolvedMotion {
            name: &port.name,
            holder: self.hold(path, &port.name),
            driven,
            values: &[],
        };
        resolved::PortKind::Motion {
            position: Box::new(motion(position)),
            angle: angle.map(|angle| Box::new(motion(angle))),
        }
    }

    fn coupling_port(
        &mut self,
        port: &MotionPort,
        marker: ResolvedMarker<'a>,
    ) -> resolved::PortKind<'a> {
        let coupling = |resolved: &mut Self, incoming, first, stiffness, damping| {
            resolved.couplings += 1;
            Box::new(Coupling {
                id: CouplingId(resolved.couplings - 1),
                incoming,
                first,
                stiffness: Option::unwrap_or_default(stiffness),
                damping: Option::unwrap_or_default(damping),
            })
        };
        let first = self.numbers;
        let motion = Incoming::Motion(Box::new(self.position(marker, 1)));
        let position = coupling(self, motion, first, port.stiffness, port.damping);
        let angle = port.turns().then(|| {
            let first = self.numbers;
            let turn = match self.scene.dimension {
                2 => Incoming::Motion(Box::new(self.angle(marker, 1))),
                _ => {
                    self.place(4 + 3);
                    Incoming::Orientation(marker)
                }
            };
            let (stiffness, damping) = (port.rotational_stiffness, port.rotational_damping);
            coupling(self, turn, first, stiffness, damping)
        });
        resolved::PortKind::Coupling { position, angle }
    }
}
