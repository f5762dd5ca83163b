//! Inputs: loads, then driven motions, then what comes into ports.

use super::{AXES, DrivePart, List, PARTS, Source, component};
use crate::scene::unit::*;
use crate::scene::{
    ActionKind, Coupling, Driven, Incoming, Input, InputKind, PortKind, ROTATION_ORDERS, Resolved,
    ResolvedMarker,
};
use crate::system::{Attitude, Drive};

/// Adds the inputs of a scene.
pub(super) fn add(list: &mut List, resolved: &Resolved<'_>) {
    for input in &resolved.inputs {
        add_load(list, input, None);
    }
    for motion in &resolved.motions {
        add_motion(list, &motion.driven, motion.name, "drives");
    }
    for port in &resolved.ports {
        match &port.kind {
            PortKind::Force { inputs, .. } => {
                for input in inputs {
                    add_load(list, input, Some(port.name));
                }
            }
            PortKind::Motion { position, angle } => {
                for motion in [position].into_iter().chain(angle) {
                    add_motion(list, &motion.driven, port.name, "drives");
                }
            }
            PortKind::Coupling { position, angle } => {
                for coupling in [position].into_iter().chain(angle) {
                    add_coupling(list, coupling, port.name);
                }
            }
        }
    }
}

/// Adds the inputs of a spring and a damper, which act at once.
fn add_coupling(list: &mut List, coupling: &Coupling<'_>, port: &str) {
    let before = list.variables.len();
    // Coordinates come first, then their rates.
    let coordinates = match &coupling.incoming {
        Incoming::Motion(motion) => {
            add_motion(list, motion, port, "pulls");
            motion.drives.len()
        }
        Incoming::Orientation(marker) => {
            let attitude = Attitude {
                first: coupling.first,
                derivatives: 1,
            };
            add_orientation(list, attitude, port, "pulls", marker);
            4
        }
    };
    list.mark_direct(before);
    for (i, variable) in list.variables[before..].iter_mut().enumerate() {
        variable.coupling = Some(coupling.id);
        variable.sets_length = i < coordinates;
    }
}

/// How the frame of a rigid body is to stand, and how it is to rotate: what a motion or a port of this name drives, or pulls.
fn add_orientation(
    list: &mut List,
    attitude: Attitude,
    of: &str,
    verb: &str,
    marker: &ResolvedMarker<'_>,
) {
    let (first, what) = (
        attitude.first,
        format!("to which {of} {verb} {}", marker.name),
    );
    for (k, start) in marker.place.quaternion().into_iter().enumerate() {
        let name = component(&format!("{of}.quaternion"), k);
        let what = format!("Quaternion {what}, {}", PARTS[k]);
        list.add(name, what, None, Source::Input(first + k), Some(start));
        list.mark_drive(DrivePart::Orientation {
            first,
            order: 0,
            component: k,
        });
    }
    let place = list.variables.len();
    for (order, (key, kind, unit)) in ROTATION_ORDERS.iter().enumerate().skip(1) {
        for (k, axis) in AXES
            .iter()
            .enumerate()
            .filter(|_| order <= attitude.derivatives)
        {
            let name = component(&format!("{of}.{key}"), k);
            let what = format!("{kind} {what}, component {axis}");
            let source = Source::Input(first + 1 + 3 * order + k);
            list.add(name, what, Some(*unit), source, Some(0.0));
            list.mark_drive(DrivePart::Orientation {
                first,
                order,
                component: k,
            });
        }
    }
    // As of other motions, an acceleration may jump.
    if attitude.derivatives == 2 {
        list.mark_direct(place + 3);
    }
}

/// Directions of the components of a force that rotates with a marker in the plane.
const ALONG: [&str; 2] = [
    "along the direction there",
    "across, to the left of the direction",
];
/// Meaning of an input that sets the force of friction.
const FRICTIONS: &str = "Force against sliding of";
/// Meaning of an input that releases a joint.
const RELEASES: &str = "Releases a joint permanently if it is above 0 as a step begins:";

/// Key, meaning and unit of a load's variables, and what its components are along.
fn words(
    input: &Input<'_>,
) -> (
    &'static str,
    &'static str,
    Option<Unit>,
    &'static [&'static str],
) {
    const AXES: [&str; 3] = ["component x", "component y", "component z"];
    const ROTATION: [&str; 3] = [
        "along the x axis of its frame",
        "along the y axis of its frame",
        "along the z axis of its frame",
    ];
    const SECTIONS: [&str; 3] = [
        "along their first axes",
        "along their second axes",
        "along their third axes",
    ];
    let action = match &input.kind {
        InputKind::Action(action) => action,
        InputKind::RestLength(_) => {
            return ("rest_length", "Length at rest of", Some(METRE), &[""]);
        }
        InputKind::Release(_) => return ("release", RELEASES, None, &[""]),
        InputKind::Latch(_) => return ("armed", "Arming (above 0) of", None, &[""]),
        InputKind::Friction(_, true) => {
            return ("friction_torque", FRICTIONS, Some(NEWTON_METRE), &[""]);
        }
        InputKind::Friction(_, false) => return ("friction_force", FRICTIONS, Some(NEWTON), &[""]),
        InputKind::Control(_) => return ("control", "Value `u` of", None, &[""]),
        InputKind::Current(_) => {
            return ("current", "Velocity of", Some(METRE_PER_SECOND), &AXES);
        }
    };
    let is_spatial = input.start.len() == 3;
    let (key, what, unit, ways): (_, _, _, &[_]) = match (action.kind, action.follower) {
        (ActionKind::Force, true) => {
            let ways: &[_] = if is_spatial { &ROTATION } else { &ALONG };
            ("follower_force", "Force that turns along, on", NEWTON, ways)
        }
        (ActionKind::Force, false) => ("force", "Force on", NEWTON, &AXES),
        (ActionKind::Moment, true) => {
            let what = "Moment that turns along, on";
            ("follower_moment", what, NEWTON_METRE, &ROTATION)
        }
        (ActionKind::Moment, false) => {
            let ways: &[_] = if is_spatial {
                &AXES
            } else {
                &["counter-clockwise"]
            };
            ("moment", "Moment on", NEWTON_METRE, ways)
        }
        (ActionKind::Torque, _) => {
            let ways = &["on its second marker, opposite on its first"];
            ("torque", "Torque in", NEWTON_METRE, ways)
        }
        (ActionKind::DistributedForce, _) => {
            let what = "Force per reference length on";
            ("distributed_force", what, NEWTON_PER_METRE, &AXES)
        }
        (ActionKind::Pressure, _) => ("pressure", "Pressure along the normal of", PASCAL, &[""]),
        (ActionKind::AreaForce, _) => (
            "area_force",
            "Force per area without stress on",
            PASCAL,
            &AXES,
        ),
        (ActionKind::DistributedMoment, false) => {
            let what = "Moment per reference length on";
            ("distributed_moment", what, NEWTON_METRE_PER_METRE, &AXES)
        }
        (ActionKind::DistributedMoment, true) => {
            let what = "Moment per reference length that turns with the sections, on";
            let key = "distributed_follower_moment";
            (key, what, NEWTON_METRE_PER_METRE, &SECTIONS)
        }
    };
    (key, what, Some(unit), ways)
}

/// A load; its variables bear the name of a port or of what it acts on.
fn add_load(list: &mut List, input: &Input<'_>, port: Option<&str>) {
    let (key, what, unit, ways) = words(input);
    let of = match &input.kind {
        InputKind::Action(action) => action.on.name(),
        InputKind::RestLength(of)
        | InputKind::Release(of)
        | InputKind::Latch(of)
        | InputKind::Friction(of, _)
        | InputKind::Control(of)
        | InputKind::Current(of) => of,
    };
    let (name, before) = (
        format!("{}.{key}", port.unwrap_or(of)),
        list.variables.len(),
    );
    let ways = &ways[..input.start.len()];
    for (axis, (start, way)) in input.start.iter().zip(ways).enumerate() {
        let name = match ways.len() {
            1 => name.clone(),
            _ => component(&name, axis),
        };
        let comma = if way.is_empty() { "" } else { ", " };
        let (what, source) = (
            format!("{what} {of}{comma}{way}"),
            Source::Input(input.first + axis),
        );
        list.add(name, what, unit, source, Some(*start));
    }
    list.mark_direct(before);
    for variable in &mut list.variables[before..] {
        variable.sets_length = matches!(input.kind, InputKind::RestLength(_));
    }
}

/// Inputs of a motion that the master sets, if it does. The variables are listed derivative by derivative;
/// the numbers of each driven coordinate lie side by side.
fn add_motion(list: &mut List, driven: &Driven<'_>, name: &str, verb: &str) {
    let (drives, quantity) = (&driven.drives, driven.quantity());
    if let (Some(Drive::Turned { attitude, .. }), Some(marker)) =
        (drives.first(), quantity.place.second())
    {
        return add_orientation(list, *attitude, name, verb, &marker);
    }
    for (order, (key, what, unit)) in quantity.orders.into_iter().enumerate() {
        let coordinates = drives.iter().zip(&quantity.start);
        for (axis, (drive, &start)) in coordinates.enumerate() {
            let first = match drive {
                Drive::Input { first, derivatives } if order <= *derivatives => *first,
                Drive::Input { .. } | Drive::Turned { .. } | Drive::Kept | Drive::Function(_) => {
                    continue;
                }
            };
            let what = format!("{what} to which {name} {verb} {}", quantity.place.name());
            let name = format!("{name}.{key}");
            let start = if order == 0 { start } else { 0.0 };
            let (name, what) = match drives.len() {
                1 => (name, what),
                _ => (
                    component(&name, axis),
                    format!("{what}, component {}", AXES[axis]),
                ),
            };
            let (place, source) = (list.variables.len(), Source::Input(first + order));
            list.add(name, what, Some(unit), source, Some(start));
            list.mark_drive(DrivePart::Coordinate { first, order });
            // Positions and rates go on from where they are; an acceleration may jump.
            if order == 2 {
                list.mark_direct(place);
            }
        }
    }
}
