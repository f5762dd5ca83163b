//! Ends of joints: which markers a joint can connect, and directions in the axes of the first one's body.

use nalgebra::Vector3;

use super::primitive::ThinRod;
use super::*;
use crate::scene::marker::GROUND;
use crate::scene::validate::refuse_point;

impl<'a> Resolved<'a> {
    /// Resolves the ends of a joint.
    ///
    /// # Errors
    /// A marker that does not exist or that the joint cannot hold.
    pub(super) fn joint_ends(
        &self,
        path: &str,
        markers: &'a [String; 2],
        parts: &JointParts,
    ) -> Found<Ends<'a>> {
        let places = [0, 1].map(|side| format!("{path}.markers[{side}]"));
        let [a, b] = markers;
        if parts.has(|of| matches!(of, PointOnCurve)) {
            let (cable, _) = self.require_flexible(&places[0], a)?;
            let second = self.require_marker(&places[1], b)?;
            self.require_two(path, [cable.id.body_index(), second.place.body_index()])?;
            let first = First::Cable(cable);
            return Ok(Ends { first, second });
        }
        let ends = self.require_pair(path, markers, parts.point)?;
        if self.scene.dimension == 3 {
            require_axes(path, parts, &ends)?;
            require_moments(path, parts, &ends)?;
            return Ok(ends);
        }
        let holds_direction =
            parts.has(|of| matches!(of, Orientation(_) | JointPrimitive::Spring { .. }));
        let has_line = parts.has(|of| matches!(of, Inline(_)));
        if a != GROUND && (holds_direction || has_line) {
            self.require_directed(&places[0], a)?;
        }
        if holds_direction {
            self.require_directed(&places[1], b)?;
        }
        Ok(ends)
    }

    /// Primitives with directions in global axes at the start, in space.
    pub(super) fn directed(
        &self,
        mut primitives: Vec<JointPrimitive>,
        ends: &Ends<'a>,
    ) -> Vec<JointPrimitive> {
        if self.scene.dimension == 3 {
            for direction in primitives
                .iter_mut()
                .flat_map(JointPrimitive::directions_mut)
            {
                *direction = global(ends, *direction);
            }
        }
        primitives
    }
}

/// Markers of both ends, each with its index among the markers of the joint.
fn sides<'a>(ends: &Ends<'a>) -> impl Iterator<Item = (usize, ResolvedMarker<'a>)> {
    let markers = ends.markers();
    let missing = 2 - markers.len();
    let markers = markers.into_iter().enumerate();
    markers.map(move |(index, marker)| (missing + index, marker))
}

/// In space: axes belong to the ground and to rigid bodies with inertia; a cable has a direction alone, which the ground
/// or such a body can hold.
fn require_axes(path: &str, parts: &JointParts, ends: &Ends<'_>) -> Found<()> {
    let is_cable = |marker: &ResolvedMarker<'_>| {
        matches!(marker.place, Place::Along(..)) && !marker.place.is_framed()
    };
    let needs_frames = parts.needs_axes || parts.has(JointPrimitive::needs_axes);
    let has_line = parts.has(|of| matches!(of, Inline(_)));
    let holds_direction = parts.has(|of| matches!(of, Orientation(_)));
    let are_cables = sides(ends).filter(|(_, marker)| is_cable(marker)).count() == 2;
    for (side, marker) in sides(ends) {
        let needs_frame = needs_frames || has_line && side == 0;
        if !needs_frame && !holds_direction {
            continue;
        }
        let place = format!("{path}.markers[{side}]");
        refuse_point(&place, marker)?;
        if needs_frame && is_cable(&marker) || !marker.place.turns() {
            let wanted = "a marker of a rigid body with inertia or of a rod, which has axes";
            return Err(expected(&place, wanted, quoted(marker.name)));
        }
        if holds_direction && are_cables {
            let wanted = "a rigid body or the ground beside a cable, which has no axes";
            return Err(expected(&format!("{path}.markers"), wanted, "two cables"));
        }
    }
    Ok(())
}

/// In space: a thin rod has no inertia that could follow a joint which rotates it about its own axis, and does not rotate
/// about it. So a joint holds that axis alone, or stands on the ground and rotates the rod across it.
fn require_moments(path: &str, parts: &JointParts, ends: &Ends<'_>) -> Found<()> {
    let [direction, second] = parts.directions;
    let directions = [direction, second.or(direction)].map(|of| {
        let of = of.map_or([1.0, 0.0, 0.0], |of| of.full());
        Vector3::from(global(ends, of)).normalize()
    });
    for (side, marker) in sides(ends) {
        let Place::Point(rigid, _) = marker.place else {
            continue;
        };
        let Some(axis) = rigid.body.inertia().thin() else {
            continue;
        };
        let axis = Vector3::from(rigid.body.directed(axis.into()));
        let cosine = directions[side].dot(&axis).abs();
        let rod = ThinRod {
            side,
            is_along: 1.0 - cosine < RIGHT,
            is_across: cosine < RIGHT,
            on_ground: ends.markers().len() == 1,
        };
        if parts.needs_axes || !parts.primitives.iter().all(|of| of.suits(&rod)) {
            let wanted = "a body with a moment of inertia about every axis, about which the joint rotates it";
            let place = format!("{path}.markers[{side}]");
            return Err(expected(&place, wanted, quoted(marker.name)));
        }
    }
    Ok(())
}

/// A direction in the axes of the first end's body, in global axes at the start.
fn global(ends: &Ends<'_>, direction: [f64; 3]) -> [f64; 3] {
    match ends.first {
        First::Marker(ResolvedMarker {
            place: Place::Point(rigid, _),
            ..
        }) => rigid.body.directed(direction),
        First::Marker(ResolvedMarker {
            place: Place::Along(cable, s),
            ..
        }) if cable.body.is_rod() => cable.body.directed(s, direction),
        First::Marker(ResolvedMarker {
            place: Place::Interface(reduced, _),
            ..
        }) => reduced.body.directed(direction),
        First::Marker(ResolvedMarker {
            place: Place::Patch(plate, index),
            ..
        }) => plate.directed(index, direction),
        _ => direction,
    }
}
