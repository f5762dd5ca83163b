//! Loads and inputs: what acts, where and which way.

use super::picture::{Picture, seen};
use crate::page::canvas::{Point, direction, moved};
use crate::page::symbols;
use crate::scene::{Action as Kind, Cable, InputKind, LoadKind, Marker, PortKind, Resolved};
use crate::system::Signal;

/// Arrows that stand for a distributed force.
const ARROWS: u32 = 7;

/// A load or an input that is drawn as an arrow.
pub(super) struct Action<'a> {
    pub kind: &'a Kind<'a>,
    /// What is written beside it.
    pub label: &'a str,
    /// Components of a force at the start.
    components: Vec<f64>,
}

/// All loads and inputs of a scene, those of ports included, but not those of springs.
pub(super) fn actions<'a>(resolved: &'a Resolved<'a>) -> Vec<Action<'a>> {
    let inputs = resolved.inputs.iter().filter_map(|input| {
        let InputKind::Action(kind) = &input.kind else {
            return None;
        };
        let label = match kind {
            Kind::Force { .. } => "force",
            Kind::Moment(..) => "moment",
            Kind::Torque(..) => "torque",
            Kind::Distributed(..) => "distributed force",
        };
        let components = at_start(kind, &input.start);
        Some(Action {
            kind,
            label,
            components,
        })
    });
    let loads = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Action { action: kind, .. } => Some(Action {
            kind,
            label: load.name,
            components: at_start(kind, &[]),
        }),
        LoadKind::Spring(_) => None,
    });
    let ports = resolved.ports.iter().flat_map(|port| {
        let inputs: &[_] = match &port.kind {
            PortKind::Force { inputs, .. } => inputs,
            PortKind::Motion { .. } | PortKind::Coupling { .. } => &[],
        };
        inputs.iter().filter_map(|input| match &input.kind {
            InputKind::Action(kind) => Some(Action {
                kind,
                label: port.name,
                components: at_start(kind, &input.start),
            }),
            InputKind::RestLength(_) => None,
        })
    });
    inputs.chain(loads).chain(ports).collect()
}

/// Components of a force at the start, from those of an input; moments have none.
fn at_start(kind: &Kind<'_>, inputs: &[f64]) -> Vec<f64> {
    let (Kind::Force { components, .. } | Kind::Distributed(_, components)) = kind else {
        return Vec::new();
    };
    let values = components.iter().enumerate();
    let value = |(axis, component): (usize, &Signal)| match component {
        Signal::Function(function) => function.value(0.0),
        Signal::Input(_) => inputs[axis],
    };
    values.map(value).collect()
}

impl<'a> Action<'a> {
    /// The marker that it acts on, or the second one of a joint; none on a cable as a whole.
    pub(super) fn marker(&self) -> Option<Marker<'a>> {
        match self.kind {
            Kind::Force { marker, .. } | Kind::Moment(marker, _) => Some(*marker),
            Kind::Torque(pivot, _) => Some(pivot.ends.second),
            Kind::Distributed(..) => None,
        }
    }

    /// Direction of a force in the image, from the direction at its marker. One that starts at zero
    /// has none yet; obliquely from below it keeps clear of the names above.
    pub(super) fn way(&self, [x, y]: Point) -> Point {
        match self.components[..] {
            _ if self.components.iter().all(|part| *part == 0.0) => direction([-1.0, -1.0]),
            // Along, and across to the left; y points down the page.
            [a, b] if matches!(self.kind, Kind::Force { follower: true, .. }) => {
                direction([a * x + b * y, a * y - b * x])
            }
            [a, b] => direction([a, -b]),
            ref components => {
                let part = |k: usize| components.get(k).copied().unwrap_or(0.0);
                let [across, up] = seen(components.len(), [part(0), part(1), part(2)]);
                direction([across, -up])
            }
        }
    }
}

impl<'a> Picture<'a> {
    pub(super) fn actions(&mut self) {
        for action in actions(self.resolved) {
            match action.kind {
                Kind::Force { marker, .. } => self.force(&action, *marker),
                Kind::Moment(marker, _) => self.turn(*marker),
                Kind::Torque(pivot, _) => self.turn(pivot.ends.second),
                Kind::Distributed(cable, _) => self.distributed(&action, *cable),
            }
        }
    }

    fn turn(&mut self, marker: Marker<'_>) {
        let at = self.at(marker.position);
        symbols::turn(&mut self.canvas, at, self.unit, symbols::LOAD);
    }

    fn force(&mut self, action: &Action<'a>, marker: Marker<'a>) {
        let place = self.place(marker);
        let along = action.way(place.direction);
        let tail = symbols::force(&mut self.canvas, place.point, along, self.unit);
        self.name_force(tail, along, action.label);
    }

    fn distributed(&mut self, action: &Action<'a>, cable: Cable<'_>) {
        let along = action.way([1.0, 0.0]);
        for arrow in 0..ARROWS {
            let s = (f64::from(arrow) + 0.5) / f64::from(ARROWS);
            let at = self.at(cable.body.shape.point(s));
            let tail = symbols::force(&mut self.canvas, at, along, 0.6 * self.unit);
            if arrow == ARROWS / 2 {
                self.name_force(tail, along, action.label);
            }
        }
    }

    fn name_force(&mut self, tail: Point, along: Point, label: &str) {
        if self.names {
            let back = along.map(|part| -part);
            let at = moved(tail, back, 0.8 * self.unit);
            self.canvas.texts(at, back, &[(label, symbols::LOAD)]);
        }
    }
}
