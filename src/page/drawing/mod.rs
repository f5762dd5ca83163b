//! A drawing of a scene: with names for the documentation, square and without text as an icon.

mod actions;
mod bodies;
mod labels;
mod names;
mod picture;
mod surfaces;
mod symbols;

use super::canvas::Point;
use crate::scene::{Resolved, Scene};
use picture::Picture;

/// Width of a drawing, and its margin where no block of names needs more, pixels.
const WIDTH: f64 = 760.0;
const MARGIN: f64 = 84.0;

/// The scene as an SVG image, with the names of its parts.
pub fn drawing(scene: &Scene) -> String {
    let resolved = scene.resolved();
    let corners = bounds(&resolved);
    let picture = |margin: f64| {
        let [low, high] = corners;
        let [across, up] = [high[0] - low[0], high[1] - low[1]];
        let inner = (WIDTH - 2.0 * margin) * up / across.max(1e-3 * up);
        let height = inner.clamp(40.0, 360.0) + 2.0 * margin;
        Picture::new(&resolved, corners, [WIDTH, height], margin, 11.0, true)
    };
    let room = picture(MARGIN).room();
    picture(MARGIN.max(room)).draw()
}

/// The scene as a square SVG image without text.
pub fn icon(scene: &Scene) -> String {
    let resolved = scene.resolved();
    Picture::new(
        &resolved,
        bounds(&resolved),
        [256.0, 256.0],
        56.0,
        17.0,
        false,
    )
    .draw()
}

/// The corners of the box around all bodies and all points of the ground as they are seen, m.
fn bounds(resolved: &Resolved<'_>) -> [Point; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let joints = resolved
        .joints
        .iter()
        .filter_map(|joint| joint.ends.point());
    let loads = resolved.loads.iter();
    let loads = loads.filter_map(|load| load.kind.place().ends()?.point());
    let outlines = resolved
        .bodies
        .iter()
        .flat_map(|body| bodies::outline(*body, resolved.scene.dimension));
    let surfaces = surfaces::outlines(resolved);
    for point in outlines.chain(joints).chain(loads).chain(surfaces) {
        let point = picture::seen(resolved.scene.dimension, point);
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

impl Picture<'_> {
    /// The finished image.
    fn draw(mut self) -> String {
        self.surfaces();
        for body in &self.resolved.bodies {
            self.body(*body);
        }
        self.symbols();
        self.marks();
        self.actions();
        if self.names {
            self.name_all();
            self.gravity();
            self.axes();
        }
        self.canvas
            .finish(&format!("Drawing of the scene {}", self.scene.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::example;

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
            let written = [">", "."].map(|before| format!("{before}{name}</text>"));
            assert!(written.iter().any(|text| picture.contains(text)), "{name}");
        }
        // Markers bear the name of their body.
        assert!(picture.contains(">rod.root</text>"));
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }

    /// One shape of its 16 triangles, and one of its 18 edges at the boundary.
    #[test]
    fn a_reduced_body_is_drawn_by_its_surface() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/book/examples/bodies");
        let folder = std::path::Path::new(folder);
        let text = std::fs::read_to_string(folder.join("reduced.json")).expect("a scene");
        let scene = Scene::from_json_with(&text, &crate::scene::beside(folder));
        let picture = drawing(&scene.expect("a valid scene"));
        let shapes: Vec<&str> = picture
            .lines()
            .filter(|line| line.contains("<path"))
            .collect();
        let has = |begins: usize, ends: usize| {
            let count = |line: &str, letter: char| line.matches(letter).count();
            (shapes.iter()).any(|line| [count(line, 'M'), count(line, 'Z')] == [begins, ends])
        };
        assert!(has(16, 16) && has(18, 0), "{shapes:?}");
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
    }

    #[test]
    fn axes_are_named_and_wheels_have_the_ratio_of_their_gear() {
        let wheel = |name: &str, x: f64| {
            format!(
                r#"{{ "name": "{name}", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [{x:?}, 0.0], "markers": {{ "centre": [0.0, 0.0] }} }}"#
            )
        };
        let text = format!(
            r#"{{ "name": "gears", "dimension": 2, "bodies": [ {}, {} ],
              "joints": [ {{ "name": "left", "kind": "revolute", "markers": ["ground", "a.centre"] }},
                          {{ "name": "right", "kind": "revolute", "markers": ["ground", "b.centre"] }} ],
              "gears": [ {{ "name": "mesh", "joints": ["left", "right"], "ratio": -3.0 }} ] }}"#,
            wheel("a", 0.0),
            wheel("b", 1.0)
        );
        let picture = drawing(&Scene::from_json(&text).expect("a valid scene"));
        for name in ["x", "y", "a.centre"] {
            assert!(picture.contains(&format!(">{name}</text>")), "{name}");
        }
        assert!(!picture.contains(">z</text>"));
        let document = roxmltree::Document::parse(&picture).expect("a valid drawing");
        let number = |node: roxmltree::Node<'_, '_>, name: &str| -> f64 {
            let text = node.attribute(name).expect("an attribute");
            text.parse().expect("a number")
        };
        let circles = document
            .descendants()
            .filter(|node| node.has_tag_name("circle"));
        let mut wheels: Vec<[f64; 2]> = circles
            .map(|node| [number(node, "cx"), number(node, "r")])
            .collect();
        wheels.sort_by(|a, b| b[1].total_cmp(&a[1]));
        let [[first, large], [second, small], ..] = wheels[..] else {
            panic!("two wheels");
        };
        // They touch, and the second turns three times as fast.
        assert!(
            (large - 3.0 * small).abs() < 0.3 && (large + small - (second - first)).abs() < 0.3
        );
    }

    /// Edges of the texts of a drawing, from what stands in it: letters of 13 pixels are some 7.2 wide.
    fn texts(drawing: &str) -> Vec<(String, [f64; 4])> {
        let document = roxmltree::Document::parse(drawing).expect("a valid drawing");
        let texts = document
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        let boxes = texts.map(|node| {
            let number = |name: &str| -> f64 {
                node.attribute(name)
                    .and_then(|text| text.parse().ok())
                    .expect("a number")
            };
            let text = node.text().unwrap_or_default().to_owned();
            let (x, y, width) = (number("x"), number("y"), 7.2 * text.len() as f64);
            let left = match node.attribute("text-anchor") {
                Some("start") => x,
                Some("end") => x - width,
                _ => x - 0.5 * width,
            };
            (text, [left, y - 10.0, left + width, y + 2.5])
        });
        boxes.collect()
    }

    #[test]
    fn names_of_ready_scenes_cover_no_others() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        let files = std::fs::read_dir(&folder).expect("ready scenes");
        let mut drawings = vec![("example".to_owned(), drawing(&example()))];
        for file in files.map(|file| file.expect("a readable folder").path()) {
            let name = file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if name.ends_with(".json") && !name.ends_with(".schema.json") {
                let text = std::fs::read_to_string(&file).expect("a readable scene");
                let read = Scene::from_json_with(&text, &crate::scene::beside(&folder));
                let scene = read.expect("a valid scene");
                drawings.push((name, drawing(&scene)));
            }
        }
        assert!(drawings.len() > 20);
        let mut covered = Vec::new();
        for (scene, drawing) in &drawings {
            let texts = texts(drawing);
            for (k, (a, first)) in texts.iter().enumerate() {
                for (b, second) in &texts[..k] {
                    let is_apart = (0..2).any(|axis| {
                        first[axis + 2] <= second[axis] || second[axis + 2] <= first[axis]
                    });
                    if !is_apart {
                        covered.push(format!("{scene}: {a} and {b}"));
                    }
                }
            }
        }
        assert!(covered.is_empty(), "{covered:#?}");
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
                from: [0.0, 0.0].into(),
                to: to.into(),
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
