//! Axes of joints in space that are meant to be one: they differ by what a table of six digits leaves. Two hinges of a door would lock
//! it, if their axes were taken as they are written.

use nalgebra::Vector3;

use super::*;

/// Angle between axes, rad, up to which they are one: the error of directions that are written with six digits, or with five and a
/// length below one.
const ONE: f64 = 1e-5;

/// Angle between axes, rad, that is roundoff.
const SAME: f64 = 1e-14;

impl Resolved<'_> {
    /// Lets joints between the same two rigid bodies have one axis where theirs nearly agree: the line through both points where
    /// both hold one, else the axis of the first.
    pub(super) fn unite_axes(&mut self) {
        if self.scene.dimension != 3 {
            return;
        }
        for second in 1..self.joints.len() {
            for first in 0..second {
                let (one, other) = (&self.joints[first], &self.joints[second]);
                let (Some(a), Some(b)) = (bodies(one), bodies(other)) else {
                    continue;
                };
                let Some(axis) = (a == b).then(|| common(one, other)).flatten() else {
                    continue;
                };
                for joint in [first, second] {
                    turn(&mut self.joints[joint], axis);
                }
            }
        }
    }
}

/// The two rigid bodies of a joint in order, the ground first.
fn bodies(joint: &ResolvedJoint<'_>) -> Option<[Option<usize>; 2]> {
    let rigid = |place: Place<'_>| match place {
        Place::Point(..) => Some(place.body_index()),
        // Markers of a body that deforms rotate each on its own.
        Place::Along(..) | Place::Interface(..) | Place::Patch(..) => None,
    };
    let second = rigid(joint.ends.second.place)?;
    let mut both = match joint.ends.first {
        First::Ground(_) => [None, Some(second)],
        First::Marker(marker) => [Some(rigid(marker.place)?), Some(second)],
        First::Cable(_) => return None,
    };
    both.sort_unstable();
    Some(both)
}

/// The axis about which a joint lets its bodies rotate.
fn axis_of(joint: &ResolvedJoint<'_>) -> Option<Vector3<f64>> {
    joint.primitives.iter().find_map(|hold| match hold {
        ParallelAxes(axis) => Vector3::from(*axis).try_normalize(0.0),
        _ => None,
    })
}

/// The point that a joint holds, as described.
fn point(joint: &ResolvedJoint<'_>) -> Option<Vector3<f64>> {
    let holds = |hold: &JointPrimitive| matches!(hold, AtPoint);
    let at = match joint.ends.first {
        First::Ground(Some(point)) => point,
        _ => joint.ends.second.position,
    };
    (joint.primitives.iter().any(holds)).then(|| Vector3::from(at))
}

/// The axis that two joints have in common, if theirs nearly agree.
fn common(a: &ResolvedJoint<'_>, b: &ResolvedJoint<'_>) -> Option<Vector3<f64>> {
    let axes = [axis_of(a), axis_of(b)];
    let way = point(a).zip(point(b)).map(|(a, b)| b - a);
    let line = way.and_then(|way| way.try_normalize(0.0));
    let axis = match (line, axes) {
        (Some(line), _) => line,
        (None, [Some(first), Some(_)]) => first,
        _ => return None,
    };
    let agrees = |of: &Vector3<f64>| of.cross(&axis).norm() <= ONE;
    let mut given = axes.iter().flatten();
    (given.clone().next().is_some() && given.all(agrees)).then_some(axis)
}

/// Gives a joint an axis, in the sense of its own.
fn turn(joint: &mut ResolvedJoint<'_>, axis: Vector3<f64>) {
    for hold in &mut joint.primitives {
        if let ParallelAxes(own) | Inline(own) = hold {
            let along = Vector3::from(*own).dot(&axis);
            let off = Vector3::from(*own).cross(&axis).norm();
            // A line of a joint may have another direction than its axis; what agrees stays as it is.
            if off > SAME * along.abs() && off <= ONE * along.abs() {
                *own = (axis * along.signum()).into();
            }
        }
    }
}
