//! A drawing of a scene: with names for the documentation, square and without text as an icon.

mod actions;
mod bodies;
mod joints;
mod names;

use super::canvas::{Canvas, Point, Style, direction, moved};
use crate::scene::{Ends, LoadKind, Marker, Place as On, Resolved, Scene};

const BODY: &str = "#2b5c8a";
const INSIDE: &str = "#dce6f0";
const INK: &str = "#24292f";
const FAINT: &str = "#8a929b";

/// Width of a drawing, and its margin where no block of names needs more, pixels.
const WIDTH: f64 = 760.0;
const MARGIN: f64 = 84.0;

/// The scene as an SVG image, with the names of its parts.
pub fn drawing(scene: &Scene) -> String {
    let resolved = scene.resolved();
    let picture = |margin: f64| {
        let [low, high] = bounds(&resolved);
        let [across, up] = [high[0] - low[0], high[1] - low[1]];
        let inner = (WIDTH - 2.0 * margin) * up / across.max(1e-3 * up);
        let height = inner.clamp(40.0, 360.0) + 2.0 * margin;
        Picture::new(&resolved, [WIDTH, height], margin, 11.0, true)
    };
    let room = picture(MARGIN).room();
    picture(MARGIN.max(room)).draw()
}

/// The scene as a square SVG image without text.
pub fn icon(scene: &Scene) -> String {
    Picture::new(&scene.resolved(), [256.0, 256.0], 56.0, 17.0, false).draw()
}

/// The corners of the box around all bodies and all points of the ground, m.
fn bounds(resolved: &Resolved<'_>) -> [[f64; 2]; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let joints = resolved.joints.iter().filter_map(|joint| joint.point());
    let loads = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Spring(spring) => spring.ends.point(),
        LoadKind::Action { .. } => None,
    });
    let outlines = resolved
        .bodies
        .iter()
        .flat_map(|body| bodies::outline(*body));
    for point in outlines.chain(joints).chain(loads) {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    if low == high {
        // A single particle.
        return [low.map(|x| x - 0.5), high.map(|x| x + 0.5)];
    }
    [low, high]
}

/// A marker in the image.
#[derive(Clone, Copy)]
struct Place<'a> {
    on: On<'a>,
    /// Where it is, pixels.
    point: Point,
    /// Its direction, y downwards.
    direction: Point,
}

struct Picture<'a> {
    resolved: &'a Resolved<'a>,
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
    fn new(resolved: &'a Resolved<'a>, size: Point, margin: f64, unit: f64, names: bool) -> Self {
        let scene = resolved.scene;
        let [low, high] = bounds(resolved);
        let room = |axis: usize| (size[axis] - 2.0 * margin) / (high[axis] - low[axis]);
        Self {
            resolved,
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
        for body in &self.resolved.bodies {
            self.body(*body);
        }
        self.joints();
        self.springs();
        self.marks();
        self.actions();
        self.motions();
        self.ports();
        if self.names {
            self.name_all();
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

    /// A marker in the image.
    fn place(&self, marker: Marker<'a>) -> Place<'a> {
        let [x, y] = marker.direction;
        Place {
            on: marker.place,
            point: self.at(marker.position),
            direction: [x, -y],
        }
    }

    /// Where the two ends of a joint or spring are.
    fn ends(&self, ends: &Ends<'_>) -> [Point; 2] {
        ends.points().map(|point| self.at(point))
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
            "rod", "root", "middle", "tip", "pivot", "rail", "force", "moment", "g", "crank",
            "elbow", "pin", "drive", "hoist", "push", "wind", "ball", "link", "ring", "torque",
            "plug", "socket", "mount",
        ] {
            assert!(picture.contains(&format!(">{name}</text>")), "{name}");
        }
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }

    #[test]
    fn an_upright_and_a_level_body_fit_into_the_image() {
        let text = r#"{ "name": "one", "dimension": 2,
          "bodies": [ { "name": "rod", "element": "cable", "elements": 2,
            "material": { "youngs_modulus": 7.0e5, "density": 5540.0 },
            "section": { "area": 1.8e-3, "second_moment": 1.215e-8 },
            "shape": { "line": { "from": [0.0, 0.0], "to": [1.0, 0.0] } } } ] }"#;
        let mut scene = Scene::from_json(text).expect("a valid scene");
        for to in [[0.0, 2.0], [2.0, 0.0], [1e-9, -1e-9]] {
            scene.bodies[0].cable_mut().expect("a cable").shape = crate::scene::Shape::Line {
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

    #[test]
    fn a_particle_alone_fits_into_the_image() {
        let text = r#"{ "name": "one", "dimension": 2, "bodies": [ { "name": "ball",
          "element": "rigid", "mass": 1.0, "inertia": 0.0, "position": [3.0, 4.0] } ] }"#;
        let picture = drawing(&Scene::from_json(text).expect("a valid scene"));
        assert!(picture.contains(">ball</text>"));
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }
}
