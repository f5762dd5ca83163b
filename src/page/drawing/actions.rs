//! Loads and inputs: what acts, where and which way.

use super::picture::{Picture, seen};
use crate::math::function::Function;
use crate::page::canvas::{Point, direction, moved};
use crate::page::symbols;
use crate::scene::{self, Cable, Input, InputKind, LoadKind, Marker, On, PortKind, Resolved};
use crate::system::Signal;

/// Arrows that stand for a distributed force.
const ARROWS: u32 = 7;

/// A load or an input that is drawn as an arrow.
pub(super) struct Action<'a> {
    pub action: &'a scene::Action<'a>,
    /// What is written beside it.
    pub label: &'a str,
    /// Components of a force at the start.
    components: Vec<f64>,
}

/// All loads and inputs of a scene, those of ports included, but not those of springs.
pub(super) fn actions<'a>(resolved: &'a Resolved<'a>) -> Vec<Action<'a>> {
    let input = |input: &'a Input<'a>, label: Option<&'a str>| match &input.kind {
        InputKind::Action(action) => Some(Action {
            action,
            label: label.unwrap_or(action.kind.words()[0]),
            components: at_start(action, &input.start),
        }),
        InputKind::RestLength(_) | InputKind::Release(_) => None,
    };
    let inputs = resolved.inputs.iter().filter_map(|own| input(own, None));
    let loads = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Action { action, .. } => Some(Action {
            action,
            label: load.name,
            components: at_start(action, &[]),
        }),
        _ => None,
    });
    let ports = resolved.ports.iter().flat_map(|port| {
        let inputs: &[_] = match &port.kind {
            PortKind::Force { inputs, .. } => inputs,
            PortKind::Motion { .. } | PortKind::Coupling { .. } => &[],
        };
        inputs.iter().filter_map(|own| input(own, Some(port.name)))
    });
    inputs.chain(loads).chain(ports).collect()
}

/// Components of a force at the start, from those of an input; moments have none.
/// What changes along a body is taken in the middle.
fn at_start(action: &scene::Action<'_>, inputs: &[f64]) -> Vec<f64> {
    if !action.kind.is_force() {
        return Vec::new();
    }
    let values = action.components.iter().enumerate();
    let value = |(axis, component): (usize, &Signal)| match component {
        Signal::Function(function) => function.value(0.0),
        Signal::Input(_) => inputs[axis],
    };
    let mut components: Vec<f64> = values.map(value).collect();
    for (axis, text) in &action.along {
        let middle = Function::along(text, 0.5);
        components[*axis] = middle.map_or(0.0, |function| function.value(0.0));
    }
    components
}

impl<'a> Action<'a> {
    /// The marker that it acts on, or the second one of a joint; none on a cable as a whole.
    pub(super) fn marker(&self) -> Option<Marker<'a>> {
        match self.action.on {
            On::Marker(marker) => Some(marker),
            On::Joint(pivot) => Some(pivot.ends.second),
            On::Cable(_) => None,
        }
    }

    /// Direction of a force in the image, from the direction at its marker. One that starts at zero
    /// has none yet; obliquely from below it keeps clear of the names above.
    pub(super) fn way(&self, [x, y]: Point) -> Point {
        match self.components[..] {
            _ if self.components.iter().all(|part| *part == 0.0) => direction([-1.0, -1.0]),
            // Along, and across to the left; y points down the page.
            [a, b] if self.action.follower => direction([a * x + b * y, a * y - b * x]),
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
            match action.action.on {
                On::Marker(marker) if action.action.kind.is_force() => self.force(&action, marker),
                On::Marker(marker) => self.turn(marker),
                On::Joint(pivot) => self.turn(pivot.ends.second),
                On::Cable(cable) => self.distributed(&action, cable),
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
            let tail = match action.action.kind.is_force() {
                true => symbols::force(&mut self.canvas, at, along, 0.6 * self.unit),
                false => {
                    symbols::turn(&mut self.canvas, at, 0.6 * self.unit, symbols::LOAD);
                    moved(at, along.map(|part| -part), self.unit)
                }
            };
            if arrow == ARROWS / 2 {
                self.name_force(tail, along, action.label);
            }
        }
    }

    fn name_force(&mut self, tail: Point, along: Point, label: &str) {
        if self.names {
            let back = along.map(|part| -part);
            self.write(tail, back, 0.8 * self.unit, &[(label, symbols::LOAD)]);
        }
    }
}
