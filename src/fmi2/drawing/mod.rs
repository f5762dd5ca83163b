//! A drawing of a scene: with names for the documentation, square and without text as an icon.

use super::canvas::{Canvas, Point, Style, direction, moved};
use super::symbols;
use crate::scene::{Body, Input, InputKind, JointKind, Scene};

const BODY: &str = "#2b5c8a";
const INK: &str = "#24292f";
const FAINT: &str = "#8a929b";
/// Parts of the polyline that stands for a curved body.
const PARTS: u32 = 96;
/// With more elements than this, nodes would only blacken the line.
const MOST_NODES: u32 = 64;

/// The scene as an SVG image, with the names of its parts.
pub fn drawing(scene: &Scene) -> String {
    let [low, high] = bounds(scene);
    let (width, margin) = (760.0, 84.0);
    let [across, up] = [high[0] - low[0], high[1] - low[1]];
    let inner = (width - 2.0 * margin) * up / across.max(1e-3 * up);
    let height = inner.clamp(40.0, 360.0) + 2.0 * margin;
    Picture::new(scene, [width, height], margin, 11.0, true).draw()
}

/// The scene as a square SVG image without text.
pub fn icon(scene: &Scene) -> String {
    Picture::new(scene, [256.0, 256.0], 56.0, 17.0, false).draw()
}

/// The corners of the box around all bodies, m.
fn bounds(scene: &Scene) -> [[f64; 2]; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for point in scene.bodies.iter().flat_map(outline) {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    [low, high]
}

/// Points along a body, m.
fn outline(body: &Body) -> impl Iterator<Item = [f64; 2]> {
    (0..=PARTS).map(|part| body.shape.point(f64::from(part) / f64::from(PARTS)))
}

struct Picture<'a> {
    scene: &'a Scene,
    canvas: Canvas,
    /// Pixels a metre.
    scale: f64,
    /// The point of the scene in the middle of the image, m.
    middle: [f64; 2],
    /// The middle of the image, pixels.
    centre: Point,
    /// Size of symbols, pixels.
    unit: f64,
    names: bool,
}

impl<'a> Picture<'a> {
    fn new(scene: &'a Scene, size: Point, margin: f64, unit: f64, names: bool) -> Self {
        let [low, high] = bounds(scene);
        let room = |axis: usize| (size[axis] - 2.0 * margin) / (high[axis] - low[axis]);
        Self {
            scene,
            canvas: Canvas::new(size[0], size[1]),
            // One extent of a straight line is zero and asks for no room; the other is not.
            scale: room(0).min(room(1)),
            middle: [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])],
            centre: [0.5 * size[0], 0.5 * size[1]],
            unit,
            names,
        }
    }

    fn draw(mut self) -> String {
        for body in &self.scene.bodies {
            self.body(body);
        }
        self.joints();
        self.markers();
        self.inputs();
        if self.names {
            self.gravity();
        }
        self.canvas
            .finish(&format!("Drawing of the scene {}", self.scene.name))
    }

    /// From metres to pixels.
    fn at(&self, point: [f64; 2]) -> Point {
        [
            self.centre[0] + self.scale * (point[0] - self.middle[0]),
            self.centre[1] - self.scale * (point[1] - self.middle[1]),
        ]
    }

    fn body(&mut self, body: &Body) {
        let points: Vec<Point> = outline(body).map(|point| self.at(point)).collect();
        let style = Style {
            stroke: BODY,
            width: 0.42 * self.unit,
            fill: "none",
        };
        self.canvas.polyline(&points, false, style);
        if self.names && body.elements <= MOST_NODES {
            let node = Style {
                stroke: BODY,
                width: 0.8,
                fill: "#dce6f0",
            };
            let same = |other: &Body| other.name == body.name;
            let index = self.scene.bodies.iter().position(same).unwrap_or(0);
            for along in self.scene.nodes(index).unwrap_or_default() {
                let centre = self.at(body.shape.point(along));
                self.canvas.circle(centre, 0.26 * self.unit, node);
            }
        }
        if self.names {
            // A quarter along the way, where markers are rare, on the side without their names.
            let side = self.name_side(body, 0.25).map(|part| -part);
            let at = moved(self.at(body.shape.point(0.25)), side, 1.5 * self.unit);
            self.canvas.texts(at, side, &[(&body.name, BODY)]);
        }
    }

    /// The side of the body for names, in the image: above it, or to the right if it is upright.
    fn name_side(&self, body: &Body, along: f64) -> Point {
        let [x, y] = body.shape.tangent(along);
        let normal = [-y, -x];
        let wrong = if normal[1].abs() < 0.3 {
            normal[0] < 0.0
        } else {
            normal[1] > 0.0
        };
        if wrong {
            normal.map(|part| -part)
        } else {
            normal
        }
    }

    /// Body, material coordinate and place of a marker.
    fn marker(&self, name: &str) -> Option<(&'a Body, f64, Point)> {
        let marker = self.scene.marker(name)?;
        let body = &self.scene.bodies[marker.body];
        Some((
            body,
            marker.coordinate,
            self.at(body.shape.point(marker.coordinate)),
        ))
    }

    fn joints(&mut self) {
        for joint in &self.scene.joints {
            let Some((body, along, at)) = self.marker(&joint.markers[1]) else {
                continue;
            };
            let [x, y] = body.shape.tangent(along);
            let (tangent, unit) = ([x, -y], self.unit);
            let outward = if along < 0.5 {
                tangent.map(|part| -part)
            } else {
                tangent
            };
            let canvas = &mut self.canvas;
            match joint.kind {
                JointKind::Revolute => symbols::revolute(canvas, at, unit),
                JointKind::Weld => symbols::weld(canvas, at, outward, unit),
                JointKind::Slider => {
                    let [x, y] = joint.direction.unwrap_or([1.0, 0.0]);
                    symbols::slider(canvas, at, direction([x, -y]), unit);
                }
                JointKind::Orientation => symbols::orientation(canvas, at, tangent, unit),
            }
        }
    }

    fn markers(&mut self) {
        let style = Style {
            stroke: INK,
            width: 0.0,
            fill: INK,
        };
        for body in &self.scene.bodies {
            for (name, along) in &body.markers {
                let at = self.at(body.shape.point(*along));
                self.canvas.circle(at, 0.3 * self.unit, style);
                if self.names {
                    self.names_at(body, name, *along);
                }
            }
        }
    }

    /// The name of a marker and of all that is there, but for forces, which have theirs at the
    /// tail.
    fn names_at(&mut self, body: &Body, marker: &str, along: f64) {
        let full = format!("{}.{marker}", body.name);
        let mut lines = vec![(marker, INK)];
        let joints = self
            .scene
            .joints
            .iter()
            .filter(|joint| joint.markers[1] == full);
        lines.extend(joints.map(|joint| (joint.name.as_str(), FAINT)));
        let mut side = self.name_side(body, along);
        for input in self
            .scene
            .inputs
            .iter()
            .filter(|input| input.marker == full)
        {
            match input.kind {
                InputKind::Moment => lines.push(("moment", symbols::LOAD)),
                InputKind::Force => {
                    let [x, y] = force_direction(input);
                    // The side from which the arrow comes is taken.
                    if side[0] * x + side[1] * y < -0.5 {
                        side = side.map(|part| -part);
                    }
                }
            }
        }
        let distance = if lines.len() > 1 { 2.8 } else { 1.5 };
        let at = moved(self.at(body.shape.point(along)), side, distance * self.unit);
        self.canvas.texts(at, side, &lines);
    }

    fn inputs(&mut self) {
        for input in &self.scene.inputs {
            let Some((_, _, at)) = self.marker(&input.marker) else {
                continue;
            };
            match input.kind {
                InputKind::Moment => symbols::moment(&mut self.canvas, at, self.unit),
                InputKind::Force => {
                    let along = force_direction(input);
                    let tail = symbols::force(&mut self.canvas, at, along, self.unit);
                    if self.names {
                        let back = along.map(|part| -part);
                        let at = moved(tail, back, 0.8 * self.unit);
                        self.canvas.texts(at, back, &[("force", symbols::LOAD)]);
                    }
                }
            }
        }
    }

    /// An arrow in the upper right corner, where no body is drawn.
    fn gravity(&mut self) {
        let [x, y] = self.scene.gravity;
        if x == 0.0 && y == 0.0 {
            return;
        }
        let style = Style {
            stroke: FAINT,
            width: 0.2 * self.unit,
            fill: "none",
        };
        let corner = [self.canvas.width() - 2.6 * self.unit, 2.6 * self.unit];
        let along = direction([x, -y]);
        let ends = [-1.7, 1.7].map(|end| moved(corner, along, end * self.unit));
        self.canvas.arrow(ends[0], ends[1], 0.7 * self.unit, style);
        let side = [-along[1].abs(), along[0].abs()];
        let at = moved(corner, side, 0.8 * self.unit);
        self.canvas.texts(at, side, &[("g", FAINT)]);
    }
}

/// Direction of a force in the image. One that starts at zero has none yet; obliquely from below it
/// keeps clear of the names above.
fn force_direction(input: &Input) -> Point {
    match input.start[..] {
        [x, y] if x != 0.0 || y != 0.0 => direction([x, -y]),
        _ => direction([-1.0, -1.0]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::example;

    #[test]
    fn the_icon_is_square_and_without_text() {
        let icon = icon(&example());
        assert!(icon.contains("viewBox=\"0 0 256.0 256.0\""));
        assert!(!icon.contains("<text"));
        assert_eq!(icon, super::icon(&example()));
    }

    #[test]
    fn every_name_is_in_the_drawing_and_every_number_is_finite() {
        let picture = drawing(&example());
        for name in [
            "rod", "root", "middle", "tip", "pivot", "rail", "force", "moment", "g",
        ] {
            assert!(picture.contains(&format!(">{name}</text>")), "{name}");
        }
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }

    #[test]
    fn an_upright_and_a_level_body_fit_into_the_image() {
        let mut scene = example();
        for to in [[0.0, 2.0], [2.0, 0.0], [1e-9, -1e-9]] {
            scene.bodies[0].shape = crate::scene::Shape::Line {
                from: [0.0, 0.0],
                to,
            };
            let picture = drawing(&scene);
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{to:?}"
            );
        }
    }
}
