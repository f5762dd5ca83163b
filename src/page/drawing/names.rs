//! Names beside what they name.

use std::borrow::Cow;

use super::actions::actions;
use super::bodies::rigid_outline;
use super::picture::{Picture, seen};
use crate::page::canvas::{LINE, Point, direction};
use crate::picture::palette::{BODY, INK, LOAD};
use crate::picture::{MarkLabel, marks};
use crate::scene::{BodyReference, Ends, LineBody, Place as On, RigidBody};

/// With more bodies than this, names would only cover each other.
const MOST_BODIES: usize = 32;

/// A block of names beside a point.
struct Label<'a> {
    at: Point,
    side: Point,
    lines: Vec<(Cow<'a, str>, &'static str)>,
    /// Whether a symbol needs room between the point and the names.
    is_far: bool,
}

impl<'a> Label<'a> {
    fn add(&mut self, text: impl Into<Cow<'a, str>>, colour: &'static str) {
        let text = text.into();
        if !self.lines.iter().any(|(other, _)| *other == text) {
            self.lines.push((text, colour));
        }
    }
}

impl<'a> Picture<'a> {
    pub(super) fn name_all(&mut self) {
        if self.scene.bodies.len() > MOST_BODIES {
            return;
        }
        for label in self.labels() {
            let distance = if label.is_far { 2.8 } else { 1.5 };
            let lines = label.lines.iter().map(|(text, colour)| (&**text, *colour));
            let lines: Vec<(&str, &'static str)> = lines.collect();
            self.write(label.at, label.side, distance * self.unit, &lines);
        }
        self.name_bodies();
        self.name_links();
    }

    /// Room that the longest block of names takes, pixels.
    pub(super) fn room(&self) -> f64 {
        let lines = self.labels().into_iter().map(|label| label.lines.len());
        LINE * lines.max().unwrap_or(0) as f64 + 2.8 * self.unit
    }

    /// Names at markers; none where they would only cover each other.
    fn labels(&self) -> Vec<Label<'a>> {
        if self.scene.bodies.len() > MOST_BODIES {
            return Vec::new();
        }
        let mut labels = self.marker_labels();
        self.add_particles(&mut labels);
        self.add_joints(&mut labels);
        self.add_actions(&mut labels);
        labels
    }

    /// A particle has no side of its own to be named at.
    fn add_particles(&self, labels: &mut [Label<'a>]) {
        for body in &self.resolved.bodies {
            if let BodyReference::Rigid(rigid) = body
                && let [point] = rigid_outline(rigid.body, self.scene.dimension)[..]
                && let Some(label) = self.label_at(labels, self.at(point))
            {
                label.lines.insert(0, (body.name().into(), BODY));
            }
        }
    }

    /// One label for all markers at the same place.
    fn marker_labels(&self) -> Vec<Label<'a>> {
        let mut labels: Vec<Label<'a>> = Vec::new();
        for marker in &self.resolved.markers {
            let point = self.at(marker.position);
            let name: Cow<'a, str> = match self.scene.bodies.len() {
                1 => marker.name.into(),
                _ => format!("{}.{}", marker.place.body().name(), marker.name).into(),
            };
            match self.label_at(&mut labels, point) {
                Some(label) => label.add(name, INK),
                None => labels.push(Label {
                    at: point,
                    side: self.side(marker.place),
                    lines: vec![(name, INK)],
                    is_far: false,
                }),
            }
        }
        labels
    }

    fn label_at<'b>(&self, labels: &'b mut [Label<'a>], at: Point) -> Option<&'b mut Label<'a>> {
        let way = |label: &Label<'_>| (label.at[0] - at[0]).hypot(label.at[1] - at[1]);
        labels.iter_mut().find(|label| way(label) < 0.8 * self.unit)
    }

    /// Names of joints, motions and ports at their second markers.
    fn add_joints(&self, labels: &mut [Label<'a>]) {
        for mark in marks(self.resolved) {
            if mark.label != MarkLabel::Second {
                continue;
            }
            if let Some(label) = self.label_at(labels, self.at(mark.ends.second.position)) {
                label.add(mark.name, mark.name_colour);
                label.is_far = true;
            }
        }
    }

    /// Names of moments; forces have theirs at the tail and take the side that they come from.
    fn add_actions(&self, labels: &mut [Label<'a>]) {
        for action in actions(self.resolved) {
            let Some(place) = action.action.on.second().map(|marker| self.place(marker)) else {
                continue;
            };
            let Some(label) = self.label_at(labels, place.point) else {
                continue;
            };
            if !action.action.kind.is_force() {
                label.add(action.label, LOAD);
                label.is_far = true;
            } else {
                let [x, y] = action.way(place.direction);
                if label.side[0] * x + label.side[1] * y < -0.5 {
                    label.side = label.side.map(|part| -part);
                }
            }
        }
    }

    fn name_bodies(&mut self) {
        for body in &self.resolved.bodies {
            let (at, side, distance) = match body {
                // A quarter along the way, where markers are rare, on the side without their names.
                BodyReference::Cable(cable) => {
                    let side = self.cable_side(cable.body, 0.25).map(|part| -part);
                    (self.at(cable.body.shape.point(0.25)), side, 1.5)
                }
                BodyReference::Rigid(rigid) => {
                    let rigid = rigid.body;
                    if rigid_outline(rigid, self.scene.dimension).len() < 2
                        && !rigid.markers.is_empty()
                    {
                        continue;
                    }
                    let side = rigid_side(rigid, self.scene.dimension, [0.0; 3]).map(|part| -part);
                    (self.at(rigid.position.full()), side, 1.8)
                }
                BodyReference::Reduced(reduced) => {
                    (self.at(reduced.body.center()), [0.0, 1.0], 1.8)
                }
                BodyReference::Plate(plate) => {
                    let [middle, ..] = plate.body.geometry().corner([0.5; 2]);
                    (self.at(middle), [0.0, 1.0], 0.0)
                }
            };
            self.write(at, side, distance * self.unit, &[(body.name(), BODY)]);
        }
    }

    /// The side of a body for the name of a place on it, in the image.
    fn side(&self, on: On<'_>) -> Point {
        match on {
            On::Along(cable, s) => self.cable_side(cable.body, s),
            On::Point(rigid, point) => rigid_side(rigid.body, self.scene.dimension, point),
            On::Interface(reduced, index) => {
                let places = [reduced.body.place(index), reduced.body.center()];
                let [p, centre] = places.map(|at| seen(self.scene.dimension, at));
                away(p, centre)
            }
            On::Patch(plate, index) => {
                let [middle, ..] = plate.body.geometry().corner([0.5; 2]);
                let places = [plate.position(index), middle];
                let [p, centre] = places.map(|at| seen(self.scene.dimension, at));
                away(p, centre)
            }
        }
    }

    /// Above a cable, or to the right if it is upright.
    fn cable_side(&self, body: &LineBody, along: f64) -> Point {
        let [x, y] = direction(self.seen(body.shape.tangent(along)));
        upper([-y, -x])
    }

    /// Names of springs and links in their middle.
    fn name_links(&mut self) {
        for mark in marks(self.resolved) {
            if mark.label == MarkLabel::Middle {
                self.name_link(&mark.ends, mark.name, mark.name_colour);
            }
        }
    }

    fn name_link(&mut self, ends: &Ends<'_>, name: &str, colour: &'static str) {
        let [a, b] = self.ends(ends);
        let side = upper(direction([a[1] - b[1], b[0] - a[0]]));
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        self.write(middle, side, 1.4 * self.unit, &[(name, colour)]);
    }
}

fn rigid_side(rigid: &RigidBody, dimension: usize, point: [f64; 3]) -> Point {
    let corners: Vec<Point> = rigid_outline(rigid, dimension)
        .iter()
        .map(|corner| seen(dimension, *corner))
        .collect();
    let [p, centre] = [rigid.point(point), rigid.position.full()].map(|at| seen(dimension, at));
    match corners[..] {
        // A rod: above it.
        [a, b] => upper(direction([a[1] - b[1], a[0] - b[0]])),
        _ => away(p, centre),
    }
}

/// The side of a point that looks away from the centre.
fn away(p: Point, centre: Point) -> Point {
    let out = [p[0] - centre[0], p[1] - centre[1]];
    if out[0].hypot(out[1]) > 0.0 {
        direction([out[0], -out[1]])
    } else {
        [0.0, -1.0]
    }
}

/// A normal or its opposite: the one that points up the page, or to the right if both are level.
fn upper(normal: Point) -> Point {
    let is_wrong = if normal[1].abs() < 0.3 {
        normal[0] < 0.0
    } else {
        normal[1] > 0.0
    };
    if is_wrong {
        normal.map(|part| -part)
    } else {
        normal
    }
}
