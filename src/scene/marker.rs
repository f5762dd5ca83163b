//! Markers: what their names refer to, and where they are at the start.

use super::{Body, Input, Load, Scene, Value};

/// What stands for the ground where a marker is named.
pub const GROUND: &str = "ground";

/// A place on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// Material coordinate of a cable in [0, 1].
    Along(f64),
    /// Point in the frame of a rigid body, m.
    Point([f64; 2]),
}

/// A marker found by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerReference {
    /// Index of the body.
    pub body: usize,
    /// Where on the body.
    pub at: At,
}

impl Scene {
    /// Finds a marker by `body.marker`.
    pub fn marker(&self, name: &str) -> Option<MarkerReference> {
        let (body_name, marker_name) = name.split_once('.')?;
        let body = self.body(body_name)?;
        let at = self.bodies[body].marker(marker_name)?;
        Some(MarkerReference { body, at })
    }

    /// Index of a body by its name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name() == name)
    }

    /// Index of a joint by its name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Index of a motion by its name.
    pub fn motion(&self, name: &str) -> Option<usize> {
        self.motions.iter().position(|motion| motion.name == name)
    }

    /// Index of a load by its name.
    pub fn load(&self, name: &str) -> Option<usize> {
        self.loads.iter().position(|load| load.name == name)
    }

    /// Where a marker is in the shapes and positions that the scene describes, m.
    pub fn position(&self, marker: MarkerReference) -> [f64; 2] {
        self.bodies[marker.body].position(marker.at)
    }

    /// Direction of a marker in the shapes and positions that the scene describes: a unit vector.
    pub fn direction(&self, marker: MarkerReference) -> [f64; 2] {
        self.bodies[marker.body].direction(marker.at)
    }

    /// Distance at the start between the places that a joint or a spring joins, m. The ground is at
    /// `point`, or where the second marker is.
    pub fn distance(&self, markers: &[String; 2], point: Option<[f64; 2]>) -> f64 {
        let at = |name: &String| Some(self.position(self.marker(name)?));
        let b = at(&markers[1]).unwrap_or_default();
        let a = point.or_else(|| at(&markers[0])).unwrap_or(b);
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Values of an input before the master sets one; a rest length is that of the spring.
    pub fn input_start(&self, input: &Input) -> Vec<f64> {
        if !input.start.is_empty() {
            return input.start.clone();
        }
        let load = input.load.as_deref().and_then(|name| self.load(name));
        match load.map(|load| &self.loads[load]) {
            Some(load) => vec![self.rest_length(load)],
            None => vec![0.0; input.components()],
        }
    }

    /// Length at rest of a spring-damper, m, where it does not change in time.
    fn rest_length(&self, load: &Load) -> f64 {
        match (&load.length, &load.markers) {
            (Some(Value::Number(length)), _) => *length,
            (_, Some(markers)) => self.distance(markers, load.point),
            (_, None) => 0.0,
        }
    }
}

impl Body {
    /// Finds a marker by its name in the body.
    pub fn marker(&self, name: &str) -> Option<At> {
        match self {
            Self::Cable(body) => body.markers.get(name).copied().map(At::Along),
            Self::Rigid(body) => body.markers.get(name).copied().map(At::Point),
        }
    }

    /// Where a place on the body is at the start, m; the origin of the body for a place on another
    /// kind of body.
    pub fn position(&self, at: At) -> [f64; 2] {
        match (self, at) {
            (Self::Cable(body), At::Along(s)) => body.shape.point(s),
            (Self::Cable(body), At::Point(_)) => body.shape.point(0.0),
            (Self::Rigid(body), At::Point(point)) => {
                let (sin, cos) = body.angle.sin_cos();
                [
                    body.position[0] + cos * point[0] - sin * point[1],
                    body.position[1] + sin * point[0] + cos * point[1],
                ]
            }
            (Self::Rigid(body), At::Along(_)) => body.position,
        }
    }

    /// Direction of a place on the body at the start: the tangent of a cable, the first axis of the
    /// frame of a rigid body; a unit vector.
    pub fn direction(&self, at: At) -> [f64; 2] {
        match (self, at) {
            (Self::Cable(body), At::Along(s)) => body.shape.tangent(s),
            (Self::Cable(body), At::Point(_)) => body.shape.tangent(0.0),
            (Self::Rigid(body), _) => [body.angle.cos(), body.angle.sin()],
        }
    }
}
