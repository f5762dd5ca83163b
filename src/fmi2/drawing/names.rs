//! Names beside what they name.

use super::actions::{ActionKind, actions};
use super::bodies::outline;
use super::{BODY, FAINT, INK, Picture};
use crate::fmi2::canvas::{LINE, Point, direction, moved};
use crate::fmi2::symbols;
use crate::scene::{At, Body, CableBody, JointKind, LoadKind, PortKind, Scene};

/// With more bodies than this, names would only cover each other.
const MOST_BODIES: usize = 32;

/// A block of names beside a point.
struct Label<'a> {
    at: Point,
    side: Point,
    lines: Vec<(&'a str, &'static str)>,
    /// Whether a symbol needs room between the point and the names.
    is_far: bool,
}

impl<'a> Label<'a> {
    fn add(&mut self, text: &'a str, colour: &'static str) {
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
            let at = moved(label.at, label.side, distance * self.unit);
            self.canvas.texts(at, label.side, &label.lines);
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
        for body in &self.scene.bodies {
            if let [point] = outline(body)[..]
                && let Some(label) = self.label_at(labels, self.at(point))
            {
                label.lines.insert(0, (body.name(), BODY));
            }
        }
    }

    /// One label for all markers at the same place.
    fn marker_labels(&self) -> Vec<Label<'a>> {
        let mut labels: Vec<Label<'a>> = Vec::new();
        let scene: &'a Scene = self.scene;
        for body in &scene.bodies {
            for name in body.marker_names() {
                let Some(at) = body.marker(name) else {
                    continue;
                };
                let point = self.at(body.position(at));
                match self.label_at(&mut labels, point) {
                    Some(label) => label.add(name, INK),
                    None => labels.push(Label {
                        at: point,
                        side: self.side(body, at),
                        lines: vec![(name, INK)],
                        is_far: false,
                    }),
                }
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
        let scene = self.scene;
        let joints = scene
            .joints
            .iter()
            .filter(|joint| joint.kind != JointKind::Distance);
        let joints = joints.map(|joint| (&joint.markers[1], &joint.name, FAINT));
        let motions = scene.motions.iter().filter_map(|motion| {
            let joint = motion.joint.as_deref().and_then(|name| scene.joint(name));
            let second = joint.map(|joint| &scene.joints[joint].markers[1]);
            let marker = motion.marker.as_ref().or(second)?;
            Some((marker, &motion.name, symbols::MOTION))
        });
        let ports = scene.ports.iter().filter(|p| p.kind == PortKind::Motion);
        let ports = ports.map(|port| (&port.marker, &port.name, symbols::MOTION));
        for (marker, name, colour) in joints.chain(motions).chain(ports) {
            let place = self.place(marker);
            if let Some(label) = place.and_then(|place| self.label_at(labels, place.point)) {
                label.add(name, colour);
                label.is_far = true;
            }
        }
    }

    /// Names of moments; forces have theirs at the tail and take the side that they come from.
    fn add_actions(&self, labels: &mut [Label<'a>]) {
        for action in actions(self.scene) {
            let joint = self.scene.joint(action.on);
            let second = joint.map(|joint| self.scene.joints[joint].markers[1].as_str());
            let Some(place) = self.place(second.unwrap_or(action.on)) else {
                continue;
            };
            let Some(label) = self.label_at(labels, place.point) else {
                continue;
            };
            if matches!(action.kind, ActionKind::Moment | ActionKind::Torque) {
                label.add(action.label, symbols::LOAD);
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
        let scene = self.scene;
        for body in &scene.bodies {
            let (at, side, distance) = match body {
                // A quarter along the way, where markers are rare, on the side without their names.
                Body::Cable(cable) => {
                    let side = cable_side(cable, 0.25).map(|part| -part);
                    (self.at(cable.shape.point(0.25)), side, 1.5)
                }
                Body::Rigid(rigid) => {
                    if outline(body).len() < 2 && !rigid.markers.is_empty() {
                        continue;
                    }
                    let side = self.side(body, At::Point([0.0; 2])).map(|part| -part);
                    (self.at(rigid.position), side, 1.8)
                }
            };
            let at = moved(at, side, distance * self.unit);
            self.canvas.texts(at, side, &[(body.name(), BODY)]);
        }
    }

    /// Names of springs and links in their middle.
    fn name_links(&mut self) {
        let scene = self.scene;
        let springs = scene.loads.iter().filter_map(|load| {
            let markers = load.markers.as_ref()?;
            (load.kind == LoadKind::SpringDamper).then_some((
                markers,
                load.point,
                &load.name,
                symbols::SPRING,
            ))
        });
        let links = scene.joints.iter();
        let links = links.filter(|joint| joint.kind == JointKind::Distance);
        let links = links.map(|joint| (&joint.markers, joint.point, &joint.name, FAINT));
        for (markers, point, name, colour) in springs.chain(links) {
            let Some([a, b]) = self.ends(markers, point) else {
                continue;
            };
            let side = upper(direction([a[1] - b[1], b[0] - a[0]]));
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let at = moved(middle, side, 1.4 * self.unit);
            self.canvas.texts(at, side, &[(name, colour)]);
        }
    }

    /// The side of a body for the name of a place on it, in the image.
    fn side(&self, body: &Body, at: At) -> Point {
        match (body, at) {
            (Body::Cable(cable), At::Along(along)) => cable_side(cable, along),
            (Body::Cable(cable), At::Point(_)) => cable_side(cable, 0.0),
            (Body::Rigid(rigid), _) => {
                let corners = outline(body);
                let p = body.position(at);
                let out = [p[0] - rigid.position[0], p[1] - rigid.position[1]];
                match corners[..] {
                    // A rod: above it.
                    [a, b] => upper(direction([a[1] - b[1], a[0] - b[0]])),
                    _ if out[0].hypot(out[1]) > 0.0 => direction([out[0], -out[1]]),
                    _ => [0.0, -1.0],
                }
            }
        }
    }
}

/// Above a cable, or to the right if it is upright.
fn cable_side(body: &CableBody, along: f64) -> Point {
    let [x, y] = body.shape.tangent(along);
    upper([-y, -x])
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
