//! Shapes of rigid bodies of uniform density.

use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Inertia;

/// Shape of a rigid body, its centre at the origin of the body's frame. Lists have three components, in the plane too.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Solid {
    /// Box with edges along the axes of the frame.
    #[schemars(title = "Box")]
    Box {
        /// Lengths of the edges along x, y and z, m.
        size: [f64; 3],
    },
    /// Cylinder.
    #[schemars(title = "Cylinder")]
    Cylinder {
        /// Radius, m.
        radius: f64,
        /// Length along the axis, m.
        length: f64,
        /// Direction of its axis in the frame, of any length but zero.
        #[serde(default = "third")]
        axis: [f64; 3],
    },
    /// Sphere.
    #[schemars(title = "Sphere")]
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// Cylinder with a round hole all along its axis.
    #[schemars(title = "TubeSolid")]
    Tube {
        /// Outer radius, m.
        radius: f64,
        /// Radius of the hole, m.
        inner_radius: f64,
        /// Length along the axis, m.
        length: f64,
        /// Direction of its axis in the frame, of any length but zero.
        #[serde(default = "third")]
        axis: [f64; 3],
    },
}

/// The z axis.
fn third() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// Points of a circle that stand for it in a picture.
const POINTS: u32 = 48;

impl Solid {
    /// Key of the shape in a scene.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Box { .. } => "box",
            Self::Cylinder { .. } => "cylinder",
            Self::Sphere { .. } => "sphere",
            Self::Tube { .. } => "tube",
        }
    }

    /// Lengths of the shape by their keys, m; entries of a list have their place in it.
    pub fn lengths(&mut self) -> Vec<(&'static str, Option<usize>, &mut f64)> {
        match self {
            Self::Box { size } => (size.iter_mut().enumerate())
                .map(|(k, edge)| ("size", Some(k), edge))
                .collect(),
            Self::Cylinder { radius, length, .. } => {
                vec![("radius", None, radius), ("length", None, length)]
            }
            Self::Sphere { radius } => vec![("radius", None, radius)],
            Self::Tube {
                radius,
                inner_radius,
                length,
                ..
            } => vec![
                ("radius", None, radius),
                ("inner_radius", None, inner_radius),
                ("length", None, length),
            ],
        }
    }

    /// The direction of its axis, where one is asked for.
    pub fn axis(&self) -> Option<[f64; 3]> {
        match *self {
            Self::Cylinder { axis, .. } | Self::Tube { axis, .. } => Some(axis),
            Self::Box { .. } | Self::Sphere { .. } => None,
        }
    }

    /// Volume, m^3.
    pub fn volume(&self) -> f64 {
        use std::f64::consts::PI;
        match *self {
            Self::Box { size } => size.iter().product(),
            Self::Cylinder { radius, length, .. } => PI * radius * radius * length,
            Self::Sphere { radius } => 4.0 / 3.0 * PI * radius.powi(3),
            Self::Tube {
                radius,
                inner_radius,
                length,
                ..
            } => PI * (radius - inner_radius) * (radius + inner_radius) * length,
        }
    }

    /// Inertia about the centre of mass of a body of such a mass (kg) in its frame.
    pub fn inertia(&self, mass: f64) -> Inertia {
        // About the axis and across it.
        let round = |squares: f64, length: f64, axis: [f64; 3]| {
            let along = 0.5 * mass * squares;
            let across = mass * (3.0 * squares + length * length) / 12.0;
            about(along, across, axis)
        };
        match *self {
            Self::Box { size } => {
                let [x, y, z] = size.map(|edge| mass * edge * edge / 12.0);
                Inertia::Moments([y + z, z + x, x + y])
            }
            Self::Cylinder {
                radius,
                length,
                axis,
            } => round(radius * radius, length, axis),
            Self::Sphere { radius } => Inertia::Moments([0.4 * mass * radius * radius; 3]),
            Self::Tube {
                radius,
                inner_radius,
                length,
                axis,
            } => round(radius * radius + inner_radius * inner_radius, length, axis),
        }
    }

    /// Points on its surface whose convex hull is its outline from every side, in the frame, m.
    pub fn points(&self) -> Vec<[f64; 3]> {
        match *self {
            Self::Box { size } => (0..8)
                .map(|corner| {
                    let side = |k: usize| if corner >> k & 1 == 1 { 0.5 } else { -0.5 };
                    std::array::from_fn(|k| side(k) * size[k])
                })
                .collect(),
            Self::Cylinder {
                radius,
                length,
                axis,
            }
            | Self::Tube {
                radius,
                length,
                axis,
                ..
            } => {
                let ends = [-0.5, 0.5].map(|end| circle(axis, end * length, radius));
                ends.concat()
            }
            Self::Sphere { radius } => {
                let heights = 0..=POINTS / 2;
                let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(POINTS);
                heights
                    .map(|k| angle(k).sin_cos())
                    .flat_map(|(sin, cos)| circle(third(), radius * cos, radius * sin))
                    .collect()
            }
        }
    }
}

/// Inertia of a body with an axis of symmetry; along an axis of the frame without products that rounding leaves.
fn about(along: f64, across: f64, axis: [f64; 3]) -> Inertia {
    if let Some(k) = (0..3).find(|k| axis[(k + 1) % 3] == 0.0 && axis[(k + 2) % 3] == 0.0) {
        return Inertia::Moments(std::array::from_fn(|i| if i == k { along } else { across }));
    }
    let unit = Vector3::from(axis).normalize();
    let tensor = Matrix3::identity() * across + unit * unit.transpose() * (along - across);
    Inertia::Tensor([0, 1, 2].map(|i| [0, 1, 2].map(|j| tensor[(i, j)])))
}

/// Points of a circle about an axis, so far along it from the origin.
fn circle(axis: [f64; 3], along: f64, radius: f64) -> Vec<[f64; 3]> {
    let axis = Vector3::from(axis).normalize();
    let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let beside = axis.cross(&across);
    let point = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(POINTS);
        (axis * along + (across * angle.cos() + beside * angle.sin()) * radius).into()
    };
    (0..POINTS).map(point).collect()
}
