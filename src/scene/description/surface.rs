//! Surfaces of the ground that bodies touch.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneVector;

/// Surface of the ground that is touched from outside; it stands still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Surface {
    /// Plane, in the plane a straight line; the ground is below.
    #[schemars(title = "PlaneSurface")]
    Plane {
        /// A point of it, m.
        point: SceneVector,
        /// Direction away from the ground, of any length but zero.
        normal: SceneVector,
    },
    /// Circle, in the plane.
    #[schemars(title = "CircleSurface")]
    Circle {
        /// Centre, m.
        center: SceneVector,
        /// Radius, m.
        radius: f64,
    },
    /// Sphere, in space.
    #[schemars(title = "SphereSurface")]
    Sphere {
        /// Centre, m.
        center: SceneVector,
        /// Radius, m.
        radius: f64,
    },
    /// Cylinder without end, in space.
    #[schemars(title = "CylinderSurface")]
    Cylinder {
        /// A point of its axis, m.
        point: SceneVector,
        /// Direction of its axis, of any length but zero.
        axis: SceneVector,
        /// Radius, m.
        radius: f64,
    },
}

/// Sides of a polygon that stands for a circle in a picture.
const SIDES: u32 = 48;
/// Stretches of a plane between its lines in a picture; marks of the ground below a line.
const PARTS: u32 = 8;

impl Surface {
    /// Returns the name of the surface.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "plane",
            Self::Circle { .. } => "circle",
            Self::Sphere { .. } => "sphere",
            Self::Cylinder { .. } => "cylinder",
        }
    }

    /// The nearest of its points to the middle of points around bodies, of what is round a circle about the nearest of its middle, m.
    pub fn outline(&self, near: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (around, _) = room(near);
        match self {
            Self::Plane { point, normal } => vec![foot(around, point, normal).0.into()],
            Self::Circle { center, radius } | Self::Sphere { center, radius } => {
                circle(center.full().into(), Vector3::z(), *radius)
            }
            Self::Cylinder {
                point,
                axis,
                radius,
            } => {
                let (middle, axis) = on_axis(around, point, axis);
                circle(middle, axis, *radius)
            }
        }
    }

    /// Lines that stand for it in a picture, each through points, as far as points around bodies are from their middle, m.
    pub fn lines(&self, dimension: usize, near: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
        let (around, reach) = room(near);
        match self {
            Self::Plane { point, normal } => {
                let (middle, normal) = foot(around, point, normal);
                match dimension {
                    2 => hatched(middle, normal, reach),
                    _ => grid(middle, normal, reach),
                }
            }
            Self::Circle { center, radius } => {
                vec![circle(center.full().into(), Vector3::z(), *radius)]
            }
            Self::Sphere { center, radius } => {
                let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
                axes.map(|axis| circle(center.full().into(), axis, *radius))
                    .into()
            }
            Self::Cylinder {
                point,
                axis,
                radius,
            } => {
                let (middle, axis) = on_axis(around, point, axis);
                let ends = [-reach, reach].map(|way| circle(middle + axis * way, axis, *radius));
                let (first, last) = (&ends[0], &ends[1]);
                let sides = first.iter().zip(last).step_by(SIDES as usize / 8);
                let sides: Vec<_> = sides.map(|(from, to)| vec![*from, *to]).collect();
                ends.iter().cloned().chain(sides).collect()
            }
        }
    }
}

/// The middle of the box around points, and how far its corners are from there, m; not nothing.
fn room(near: &[[f64; 3]]) -> (Vector3<f64>, f64) {
    let points = || near.iter().map(|point| Vector3::from(*point));
    let Some(first) = points().next() else {
        return (Vector3::zeros(), 1.0);
    };
    let low = points().fold(first, |low, point| low.inf(&point));
    let high = points().fold(first, |high, point| high.sup(&point));
    let reach = 0.5 * (high - low).norm();
    ((low + high) * 0.5, if reach > 0.0 { reach } else { 1.0 })
}

/// The foot of a point on a plane, m, and its unit normal.
fn foot(
    at: Vector3<f64>,
    point: &SceneVector,
    normal: &SceneVector,
) -> (Vector3<f64>, Vector3<f64>) {
    let normal = Vector3::from(normal.full()).normalize();
    let above = normal.dot(&(at - Vector3::from(point.full())));
    (at - normal * above, normal)
}

/// The foot of a point on an axis, m, and its unit vector.
fn on_axis(
    at: Vector3<f64>,
    point: &SceneVector,
    axis: &SceneVector,
) -> (Vector3<f64>, Vector3<f64>) {
    let (point, axis) = (Vector3::from(point.full()), Vector3::from(axis.full()));
    let axis = axis.normalize();
    (point + axis * axis.dot(&(at - point)), axis)
}

/// Two unit vectors across a unit vector and across each other.
fn across(axis: Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    [first, axis.cross(&first)]
}

fn circle(center: Vector3<f64>, axis: Vector3<f64>, radius: f64) -> Vec<[f64; 3]> {
    let [a, b] = across(axis);
    let points = (0..=SIDES).map(|side| {
        let (sin, cos) = (f64::from(side) / f64::from(SIDES) * std::f64::consts::TAU).sin_cos();
        (center + (a * cos + b * sin) * radius).into()
    });
    points.collect()
}

/// A straight line with marks on the side of the ground.
fn hatched(middle: Vector3<f64>, normal: Vector3<f64>, reach: f64) -> Vec<Vec<[f64; 3]>> {
    let along = Vector3::new(normal.y, -normal.x, 0.0);
    let at = |way: f64| middle + along * (way * reach);
    let count = 4 * PARTS;
    let marks = (0..count).map(|mark| {
        let top = at((2.0 * f64::from(mark) + 1.5) / f64::from(count) - 1.0);
        let bottom = top - (along + normal) * (reach / f64::from(count));
        vec![top.into(), bottom.into()]
    });
    let line = vec![at(-1.0).into(), at(1.0).into()];
    std::iter::once(line).chain(marks).collect()
}

/// Lines across each other.
fn grid(middle: Vector3<f64>, normal: Vector3<f64>, reach: f64) -> Vec<Vec<[f64; 3]>> {
    let [a, b] = across(normal);
    let lines = (0..=PARTS).flat_map(|line| {
        let side = (2.0 * f64::from(line) / f64::from(PARTS) - 1.0) * reach;
        [(a, b), (b, a)].map(|(along, across)| {
            let ends = [-reach, reach].map(|way| middle + along * way + across * side);
            ends.map(Into::into).to_vec()
        })
    });
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lie_on_the_surface() {
        let near = [[0.3, -0.7, 2.0], [1.3, 0.7, -2.0]];
        let far = |point: &[f64; 3], from: [f64; 3], axis: Vector3<f64>| {
            let arm = Vector3::from(*point) - Vector3::from(from);
            (arm - axis * axis.dot(&arm)).norm()
        };
        let center = [0.2, 0.1, 0.4];
        let sphere = Surface::Sphere {
            center: center.into(),
            radius: 1.5,
        };
        let axis = Vector3::new(2.0, 1.0, -2.0) / 3.0;
        let cylinder = Surface::Cylinder {
            point: center.into(),
            axis: [2.0, 1.0, -2.0].into(),
            radius: 1.5,
        };
        for (surface, axis) in [(sphere, Vector3::zeros()), (cylinder, axis)] {
            for point in surface.lines(3, &near).concat() {
                assert!((far(&point, center, axis) - 1.5).abs() < 1e-12);
            }
        }
        let plane = Surface::Plane {
            point: center.into(),
            normal: [2.0, 1.0, -2.0].into(),
        };
        for point in plane.lines(3, &near).concat() {
            let arm = Vector3::from(point) - Vector3::from(center);
            assert!(axis.dot(&arm).abs() < 1e-12);
        }
    }
}
