//! Primitives that joints are made of.

use super::*;

/// Primitive that a joint is made of: what it holds of its second marker, seen from the first one. Directions are in the axes of the first
/// marker's body at the start. An angle or a length that is not given is that at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointPrimitive {
    /// The position, at that of the first marker.
    AtPoint,
    /// The position, on a line through the first marker in this direction.
    Inline([f64; 3]),
    /// The position, in a plane through the first marker across this direction, in space.
    Inplane([f64; 3]),
    /// The position, on the curve of the cable that stands in place of the first marker.
    PointOnCurve,
    /// The direction, at this angle, rad; in space all axes.
    Orientation(Option<f64>),
    /// An axis, which stays along that of the first body, in space.
    ParallelAxes([f64; 3]),
    /// A right angle between an axis of the first body and one of the second, in space.
    Perpendicular([f64; 3], [f64; 3]),
    /// Equal rotation about an axis of the first body and one of the second, in space.
    Homokinetic([f64; 3], [f64; 3]),
    /// Displacement along a line in proportion to the angle about it, in space: that of one full rotation, m.
    Screw(f64),
    /// The distance, m.
    Distance(Option<f64>),
    /// Nothing: a spring and a damper act against the rotation.
    Spring {
        /// Angle at rest, rad.
        rest: Option<f64>,
        /// Stiffness, N m/rad.
        stiffness: f64,
        /// Damping, N m s/rad.
        damping: f64,
    },
}

impl JointPrimitive {
    /// Whether it holds directions alone.
    pub fn is_directional(&self) -> bool {
        matches!(
            self,
            Self::Orientation(_)
                | Self::ParallelAxes(_)
                | Self::Perpendicular(..)
                | Self::Homokinetic(..)
        )
    }

    /// Whether both markers need axes: those of a rigid body with inertia, a rod or a beam.
    pub(super) fn needs_axes(&self) -> bool {
        matches!(
            self,
            Self::ParallelAxes(_)
                | Self::Perpendicular(..)
                | Self::Homokinetic(..)
                | Self::Inplane(_)
        )
    }

    /// Whether it can hold a thin rod, which has no inertia about its own axis.
    pub(super) fn suits(&self, rod: &ThinRod) -> bool {
        let is_pivot = rod.on_ground && rod.is_across;
        match self {
            Self::ParallelAxes(_) | Self::Inplane(_) => rod.is_along || is_pivot,
            Self::Perpendicular(..) => rod.is_along,
            Self::Inline(_) => rod.side == 1 || rod.is_along,
            Self::Orientation(_) => rod.on_ground,
            Self::Spring { .. } => is_pivot,
            Self::Homokinetic(..) | Self::Screw(_) => false,
            Self::AtPoint | Self::Distance(_) | Self::PointOnCurve => true,
        }
    }

    /// Returns the directions of lines, axes and normals.
    pub(super) fn directions_mut(&mut self) -> Vec<&mut [f64; 3]> {
        match self {
            Self::Inline(of) | Self::Inplane(of) | Self::ParallelAxes(of) => vec![of],
            Self::Perpendicular(first, second) | Self::Homokinetic(first, second) => {
                vec![first, second]
            }
            Self::AtPoint
            | Self::PointOnCurve
            | Self::Orientation(_)
            | Self::Screw(_)
            | Self::Distance(_)
            | Self::Spring { .. } => Vec::new(),
        }
    }

    /// Returns the direction of a line, an axis or a normal; the first of two.
    pub fn direction(mut self) -> Option<[f64; 3]> {
        self.directions_mut().first().map(|of| **of)
    }

    /// Builds the equations of a joint with these ends; none of a spring.
    pub(super) fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        joint: &ResolvedJoint<'_>,
        ends: [Attachment<D>; 2],
    ) -> Vec<Primitive<D>> {
        let one = match *self {
            Self::AtPoint => Primitive::Coincident,
            Self::Inline(along) if D == 3 && !joint.ends.is_grounded() => {
                return builder.on_line(ends, along);
            }
            Self::Inline(along) => Primitive::Line(unit(along)),
            Self::Inplane(across) => builder.across_way(ends, unit(across)),
            Self::PointOnCurve => match joint.ends.first {
                First::Cable(cable) => {
                    return cable.id.chain().map(Primitive::Curve).into_iter().collect();
                }
                First::Ground(_) | First::Marker(_) => return Vec::new(),
            },
            Self::Orientation(given) if D == 2 => Primitive::Direction(builder.angle(ends, given)),
            Self::Orientation(_) if ends.iter().any(Attachment::is_framed) => {
                return builder.standing(ends);
            }
            Self::Orientation(_) => Primitive::Clamped(vector(joint.ends.second.direction)),
            Self::ParallelAxes(axis) => return builder.along_axis(ends, axis),
            Self::Perpendicular(first, second) => {
                builder.right_angle(ends, [first, second].map(vector))
            }
            Self::Homokinetic(first, second) => {
                builder.equal_rotation(ends, [first, second].map(vector))
            }
            Self::Screw(pitch) => {
                let both = joint.pivot().zip(joint.slider());
                let screw = both.map(|(pivot, slider)| builder.screw(pivot, slider, pitch));
                return screw.into_iter().collect();
            }
            Self::Distance(given) => {
                Primitive::Distance(given.unwrap_or_else(|| builder.distance_at_start(&ends)))
            }
            Self::Spring { .. } => return Vec::new(),
        };
        vec![one]
    }

    /// Describes what a joint with these ends holds.
    pub(super) fn words(&self, dimension: usize, ends: &Ends<'_>) -> String {
        let vector = |of: &[f64; 3]| words::vector(dimension, *of);
        let point = words::at_point(dimension, ends);
        match self {
            Self::AtPoint => format!("the position{point}"),
            Self::Inline(direction) => {
                let axes = if ends.is_grounded() {
                    ""
                } else {
                    " of the first"
                };
                let along = vector(direction);
                format!("the position on a line along {along}{axes}{point}")
            }
            Self::Orientation(angle) => {
                format!("the direction{}", words::given(" at", *angle, "rad"))
            }
            Self::Distance(length) => {
                format!("the distance{}{point}", words::given(" of", *length, "m"))
            }
            Self::ParallelAxes(axis) => {
                format!("the axis that is along {} at the start", vector(axis))
            }
            Self::Perpendicular(a, b) => {
                let [a, b] = [a, b].map(vector);
                format!("a right angle between the axes that are along {a} and {b} at the start")
            }
            Self::Homokinetic(a, b) => {
                let [a, b] = [a, b].map(vector);
                format!("equal rotation about the axes that are along {a} and {b} at the start")
            }
            Self::Inplane(across) => {
                let across = vector(across);
                format!("the position in the plane across {across} at the start{point}")
            }
            Self::Screw(pitch) => format!("{} m along it a full turn", number(*pitch)),
            Self::PointOnCurve => "the position on the line of the cable".into(),
            Self::Spring {
                rest,
                stiffness,
                damping,
            } => {
                let [k, c] = [*stiffness, *damping].map(number);
                let rest = words::given(", at rest at", *rest, "rad");
                format!("{k} N·m/rad and {c} N·m·s/rad against rotation{rest}")
            }
        }
    }
}

/// A thin rod at an end of a joint.
pub(super) struct ThinRod {
    /// Index of the end.
    pub side: usize,
    /// Whether the direction of the joint is that of the rod.
    pub is_along: bool,
    /// Whether the direction of the joint is perpendicular to the rod.
    pub is_across: bool,
    /// Whether the first end is the ground.
    pub on_ground: bool,
}
