//! Loads and inputs: what acts, where and which way.

use super::bodies::outline;
use super::picture::{Picture, seen};
use crate::math::function::Function;
use crate::page::canvas::{Point, direction, moved};
use crate::picture::palette::LOAD;
use crate::picture::symbols;
use crate::picture::{KnownAction, known_actions};
use crate::scene::{
    self, ActionKind, BodyReference, Cable, InputKind, LoadPlace, Plate, Resolved, ResolvedMarker,
};
use crate::system::Signal;

/// Arrows at most that stand for a distributed force: on a short body as many as have room.
const ARROWS: u32 = 7;
/// Arrows along each coordinate of a plate or shell.
const RASTER: usize = 3;

/// A load or an input that is drawn as an arrow.
pub(super) struct DrawnAction<'a> {
    pub action: &'a scene::Action<'a>,
    /// Text beside the arrow.
    pub label: &'a str,
    /// Components of a force at the start.
    components: Vec<f64>,
}

/// All loads and inputs of a scene, those of ports included, but not those of springs.
pub(super) fn actions<'a>(resolved: &'a Resolved<'a>) -> Vec<DrawnAction<'a>> {
    let known = known_actions(resolved).into_iter();
    let drawn = known.map(
        |KnownAction {
             name,
             action,
             start,
         }| DrawnAction {
            action,
            label: name,
            components: at_start(action, start),
        },
    );
    drawn.collect()
}

/// Components of a force at the start, from those of an input; moments have none.
/// Values that change along a body are taken in the middle.
fn at_start(action: &scene::Action<'_>, inputs: &[f64]) -> Vec<f64> {
    if !action.kind.is_force() && action.kind != ActionKind::Pressure {
        return Vec::new();
    }
    in_middle(&action.components, &action.along, inputs)
}

/// Components at the start, from those of an input; what changes along a body is taken in the middle.
fn in_middle(components: &[Signal], along: &[(usize, &str)], inputs: &[f64]) -> Vec<f64> {
    let values = components.iter().enumerate();
    let value = |(axis, component): (usize, &Signal)| match component {
        Signal::Function(function) => function.value(0.0),
        Signal::Input(_) => inputs[axis],
    };
    let mut components: Vec<f64> = values.map(value).collect();
    for (axis, text) in along {
        let middle = Function::at(text, &["s", "s1", "s2"].map(|name| (name, 0.5)));
        components[*axis] = middle.map_or(0.0, |function| function.value(0.0));
    }
    components
}

/// Direction of a vector in the image. One that starts at zero has none yet; obliquely from below it keeps clear of the names above.
fn way(components: &[f64]) -> Point {
    let part = |k: usize| components.get(k).copied().unwrap_or(0.0);
    if components.iter().all(|part| *part == 0.0) {
        return direction([-1.0, -1.0]);
    }
    let [across, up] = match components.len() {
        2 => [part(0), part(1)],
        count => seen(count, [part(0), part(1), part(2)]),
    };
    direction([across, -up])
}

impl<'a> DrawnAction<'a> {
    /// Direction of a force in the image, from the direction at its marker.
    pub(super) fn way(&self, [x, y]: Point) -> Point {
        match self.components[..] {
            // Along, and across to the left; y points down the page.
            [a, b] if self.action.follower && [a, b] != [0.0; 2] => {
                direction([a * x + b * y, a * y - b * x])
            }
            ref components => way(components),
        }
    }
}

impl<'a> Picture<'a> {
    pub(super) fn actions(&mut self) {
        for action in actions(self.resolved) {
            let (on, is_force) = (action.action.on, action.action.kind.is_force());
            match (on, on.second()) {
                (LoadPlace::Line(cable), _) => {
                    let along = action.way([1.0, 0.0]);
                    self.distributed(action.label, cable, along, is_force);
                }
                (LoadPlace::Surface(plate), _) => {
                    let size = &action.components;
                    let is_normal = action.action.kind == ActionKind::Pressure;
                    self.over(action.label, plate, |normal| {
                        if is_normal {
                            let sign = if size[0] < 0.0 { -1.0 } else { 1.0 };
                            way(&normal.map(|part| sign * part))
                        } else {
                            way(size)
                        }
                    });
                }
                (_, Some(marker)) if is_force => self.force(&action, marker),
                (_, Some(marker)) => self.turn(marker),
                (_, None) => {}
            }
        }
        self.fluids();
    }

    /// Fluids that stream, as arrows of their currents.
    fn fluids(&mut self) {
        for load in &self.resolved.loads {
            let Some(fluid) = load.kind.fluid() else {
                continue;
            };
            let mut inputs = self.resolved.inputs.iter();
            let input = inputs
                .find(|input| matches!(input.kind, InputKind::Current(name) if name == load.name));
            let start = input.map_or(&[][..], |input| &input.start);
            let current = in_middle(&fluid.current, &fluid.varying, start);
            if input.is_some() || current.iter().any(|part| *part != 0.0) {
                let along = way(&current);
                match fluid.on {
                    LoadPlace::Line(line) => self.distributed(load.name, line, along, true),
                    LoadPlace::Surface(plate) => self.over(load.name, plate, |_| along),
                    _ => {}
                }
            }
        }
    }

    fn turn(&mut self, marker: ResolvedMarker<'_>) {
        let at = self.at(marker.position);
        self.moment(at, self.unit);
    }

    /// A moment is an arc, in space too.
    fn moment(&mut self, at: Point, unit: f64) {
        self.symbol(&symbols::load(true, 2, LOAD), [at; 2], unit);
    }

    /// An arrow that ends at a body; gives back where it begins.
    fn arrow(&mut self, at: Point, along: Point, unit: f64) -> Point {
        let ends = [-3.6, -0.5].map(|end| moved(at, along, end * unit));
        self.symbol(&symbols::arrow(LOAD), ends, unit);
        ends[0]
    }

    fn force(&mut self, action: &DrawnAction<'a>, marker: ResolvedMarker<'a>) {
        let place = self.place(marker);
        let along = action.way(place.direction);
        let tail = self.arrow(place.point, along, self.unit);
        self.name_force(tail, along, action.label);
    }

    fn distributed(&mut self, label: &str, cable: Cable<'_>, along: Point, is_vector: bool) {
        let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| self.at(cable.body.shape.point(s)));
        let ways = places.windows(2);
        let length: f64 = ways
            .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
            .sum();
        let arrows = (length / (0.5 * self.unit)).clamp(1.0, f64::from(ARROWS)) as u32;
        for arrow in 0..arrows {
            let s = (f64::from(arrow) + 0.5) / f64::from(arrows);
            let at = self.at(cable.body.shape.point(s));
            let tail = if is_vector {
                self.arrow(at, along, 0.6 * self.unit)
            } else {
                self.moment(at, 0.6 * self.unit);
                moved(at, along.map(|part| -part), self.unit)
            };
            if arrow == arrows / 2 {
                self.name_force(tail, along, label);
            }
        }
    }

    /// Arrows all over a plate or shell, by its unit normal where each stands.
    fn over(&mut self, label: &str, plate: Plate<'_>, way: impl Fn([f64; 3]) -> Point) {
        let grid = plate.body.grid();
        let points = outline(BodyReference::Plate(plate), 3);
        let raster = grid.raster(RASTER);
        let normals = grid.normals(&points, &raster);
        for (number, (point, normal)) in raster.iter().zip(normals).enumerate() {
            let along = way(normal);
            let tail = self.arrow(self.at(points[*point]), along, 0.6 * self.unit);
            if number == raster.len() / 2 {
                self.name_force(tail, along, label);
            }
        }
    }

    fn name_force(&mut self, tail: Point, along: Point, label: &str) {
        if self.names {
            let back = along.map(|part| -part);
            self.write(tail, back, 0.8 * self.unit, &[(label, LOAD)]);
        }
    }
}
