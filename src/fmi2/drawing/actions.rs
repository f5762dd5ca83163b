//! Loads and inputs: what acts, where and which way.

use super::Picture;
use crate::fmi2::canvas::{Point, direction, moved};
use crate::fmi2::symbols;
use crate::scene::{At, InputKind, LoadKind, PortKind, Scene};

/// Arrows that stand for a distributed force.
const ARROWS: u32 = 7;

/// A load or an input that is drawn as an arrow.
pub(super) struct Action<'a> {
    pub kind: ActionKind,
    /// Name of the marker, joint or body that it acts on.
    pub on: &'a str,
    /// What is written beside it.
    pub label: &'a str,
    components: [f64; 2],
    follower: bool,
}

/// What acts.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ActionKind {
    /// At a marker.
    Force,
    /// At a marker.
    Moment,
    /// In a joint.
    Torque,
    /// On a cable.
    Distributed,
}

/// All loads and inputs of a scene, those of ports included, but not those of springs.
pub(super) fn actions(scene: &Scene) -> Vec<Action<'_>> {
    let inputs = scene.inputs.iter().filter_map(|input| {
        let (kind, on, label) = match input.kind {
            InputKind::Force => (ActionKind::Force, &input.marker, "force"),
            InputKind::Moment => (ActionKind::Moment, &input.marker, "moment"),
            InputKind::Torque => (ActionKind::Torque, &input.joint, "torque"),
            InputKind::Distributed => (ActionKind::Distributed, &input.body, "distributed force"),
            InputKind::RestLength => return None,
        };
        Some(Action {
            kind,
            on: on.as_deref()?,
            label,
            components: pair(&input.start),
            follower: input.follower,
        })
    });
    let loads = scene.loads.iter().filter_map(|load| {
        let (kind, on) = match load.kind {
            LoadKind::Force => (ActionKind::Force, &load.marker),
            LoadKind::Moment => (ActionKind::Moment, &load.marker),
            LoadKind::Torque => (ActionKind::Torque, &load.joint),
            LoadKind::Distributed => (ActionKind::Distributed, &load.body),
            LoadKind::SpringDamper => return None,
        };
        let values = load.value.iter().flat_map(|value| value.components());
        let starts = values.map(|value| value.function().map_or(0.0, |f| f.value(0.0)));
        Some(Action {
            kind,
            on: on.as_deref()?,
            label: &load.name,
            components: pair(&starts.collect::<Vec<_>>()),
            follower: load.follower,
        })
    });
    let ports = scene.ports.iter().filter(|p| p.kind == PortKind::Force);
    let ports = ports.flat_map(|port| {
        let kinds = [ActionKind::Force, ActionKind::Moment];
        let count = if port.turns() { 2 } else { 1 };
        kinds.into_iter().take(count).map(|kind| Action {
            kind,
            on: &port.marker,
            label: &port.name,
            components: [0.0; 2],
            follower: false,
        })
    });
    inputs.chain(loads).chain(ports).collect()
}

fn pair(values: &[f64]) -> [f64; 2] {
    match *values {
        [x, y] => [x, y],
        _ => [0.0; 2],
    }
}

impl Action<'_> {
    /// Direction of a force in the image, from the direction at its marker. One that starts at zero
    /// has none yet; obliquely from below it keeps clear of the names above.
    pub(super) fn way(&self, [x, y]: Point) -> Point {
        match self.components {
            [0.0, 0.0] => direction([-1.0, -1.0]),
            // Along, and across to the left; y points down the page.
            [a, b] if self.follower => direction([a * x + b * y, a * y - b * x]),
            [a, b] => direction([a, -b]),
        }
    }
}

impl<'a> Picture<'a> {
    pub(super) fn actions(&mut self) {
        for action in actions(self.scene) {
            match action.kind {
                ActionKind::Force => self.force(&action),
                ActionKind::Moment => self.turn(action.on),
                ActionKind::Torque => {
                    let joint = self.scene.joint(action.on);
                    let marker = joint.map(|joint| self.scene.joints[joint].markers[1].as_str());
                    self.turn(marker.unwrap_or_default());
                }
                ActionKind::Distributed => self.distributed(&action),
            }
        }
    }

    fn turn(&mut self, marker: &str) {
        if let Some(place) = self.place(marker) {
            symbols::turn(&mut self.canvas, place.point, self.unit, symbols::LOAD);
        }
    }

    fn force(&mut self, action: &Action<'a>) {
        let Some(place) = self.place(action.on) else {
            return;
        };
        let along = action.way(place.direction);
        let tail = symbols::force(&mut self.canvas, place.point, along, self.unit);
        self.name_force(tail, along, action.label);
    }

    fn distributed(&mut self, action: &Action<'a>) {
        let Some(body) = self.scene.body(action.on) else {
            return;
        };
        let body = &self.scene.bodies[body];
        let along = action.way([1.0, 0.0]);
        for arrow in 0..ARROWS {
            let s = (f64::from(arrow) + 0.5) / f64::from(ARROWS);
            let at = self.at(body.position(At::Along(s)));
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
