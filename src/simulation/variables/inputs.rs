//! Inputs: loads, then driven motions, then what comes into ports.

use super::unit::*;
use super::{AXES, List, Source, Unit, component};
use crate::scene::{GROUND, Input, InputKind, Joint, Motion, MotionKind, Scene};

/// Adds the inputs of a scene.
pub(super) fn add(list: &mut List, scene: &Scene) {
    let layout = scene.input_layout();
    for (input, first) in scene.inputs.iter().zip(layout.of_inputs) {
        add_load(list, scene, input, (None, first));
    }
    let driven = scene.motions.iter().filter_map(|motion| {
        let derivatives = motion.input_derivatives()?;
        Some((motion, derivatives))
    });
    for ((motion, derivatives), first) in driven.zip(layout.of_motions) {
        add_motion(list, scene, (motion, "drives"), (first, derivatives));
    }
    for (place, first) in layout.of_ports.into_iter().enumerate() {
        add_port(list, scene, place, first);
    }
}

/// What comes into a port; a spring and a damper feel it at once.
fn add_port(list: &mut List, scene: &Scene, place: usize, mut first: usize) {
    let port = &scene.ports[place];
    for input in port.inputs() {
        add_load(list, scene, &input, (Some(&port.name), first));
        first += input.components();
    }
    let (coupling, verb) = match port.is_coupling() {
        true => (Some(scene.couplings_before_port(place)), "pulls"),
        false => (None, "drives"),
    };
    for (part, motion) in port.motions().iter().enumerate() {
        let before = list.0.len();
        let derivatives = motion.input_derivatives().unwrap_or(0);
        add_motion(list, scene, (motion, verb), (first, derivatives));
        first += motion.input_count().unwrap_or(0);
        if let Some(coupling) = coupling {
            list.mark_direct(before);
            // Coordinates come first, then their rates.
            for (i, variable) in list.0[before..].iter_mut().enumerate() {
                variable.coupling = Some(coupling + part);
                variable.sets_length = i < motion.coordinates();
            }
        }
    }
}

/// A load; its variables bear the name of a port or of what it acts on.
fn add_load(list: &mut List, scene: &Scene, input: &Input, (port, first): (Option<&str>, usize)) {
    let of = |name: &Option<String>| name.clone().unwrap_or_default();
    let (of, key, what, unit) = match input.kind {
        InputKind::Force if input.follower => (
            of(&input.marker),
            "follower_force",
            "Force that turns along, on",
            NEWTON,
        ),
        InputKind::Force => (of(&input.marker), "force", "Force on", NEWTON),
        InputKind::Moment => (of(&input.marker), "moment", "Moment on", NEWTON_METRE),
        InputKind::Torque => (of(&input.joint), "torque", "Torque in", NEWTON_METRE),
        InputKind::Distributed => (
            of(&input.body),
            "distributed_force",
            "Force per reference length on",
            NEWTON_PER_METRE,
        ),
        InputKind::RestLength => (of(&input.load), "rest_length", "Length at rest of", METRE),
    };
    let ways = if input.follower {
        [
            "along the direction there",
            "across, to the left of the direction",
        ]
    } else {
        ["component x", "component y"]
    };
    let name = format!("{}.{key}", port.unwrap_or(&of));
    let (starts, before) = (scene.input_start(input), list.0.len());
    for (axis, start) in starts.into_iter().enumerate() {
        let (name, suffix) = match input.kind {
            InputKind::Force | InputKind::Distributed => (component(&name, axis), ways[axis]),
            InputKind::Moment => (name.clone(), "counter-clockwise"),
            InputKind::Torque => (name.clone(), "on its second marker, opposite on its first"),
            InputKind::RestLength => (name.clone(), ""),
        };
        let comma = if suffix.is_empty() { "" } else { ", " };
        let what = format!("{what} {of}{comma}{suffix}");
        list.add(
            name,
            what,
            Some(unit),
            Source::Input(first + axis),
            Some(start),
        );
    }
    list.mark_direct(before);
    for variable in &mut list.0[before..] {
        variable.sets_length = input.kind == InputKind::RestLength;
    }
}

/// Keys, meanings and units of a motion and its derivatives.
fn orders(kind: MotionKind) -> [(&'static str, &'static str, Unit); 3] {
    match kind {
        MotionKind::Angle => [
            ("angle", "Angle", RADIAN),
            ("angular_velocity", "Angular velocity", RADIAN_PER_SECOND),
            (
                "angular_acceleration",
                "Angular acceleration",
                RADIAN_PER_SECOND_2,
            ),
        ],
        MotionKind::Position | MotionKind::Displacement => [
            match kind {
                MotionKind::Position => ("position", "Position", METRE),
                _ => ("displacement", "Displacement", METRE),
            },
            ("velocity", "Velocity", METRE_PER_SECOND),
            ("acceleration", "Acceleration", METRE_PER_SECOND_2),
        ],
    }
}

/// The variables are listed derivative by derivative; the numbers of each driven coordinate lie side
/// by side.
fn add_motion(
    list: &mut List,
    scene: &Scene,
    (motion, verb): (&Motion, &str),
    (first, derivatives): (usize, usize),
) {
    let starts = start(scene, motion);
    let what_moves = motion.marker.as_ref().or(motion.joint.as_ref());
    let of = what_moves.map_or("", String::as_str);
    for (order, (key, what, unit)) in orders(motion.kind).into_iter().enumerate() {
        if order > derivatives {
            break;
        }
        for (axis, start) in starts.iter().enumerate() {
            let name = format!("{}.{key}", motion.name);
            let what = format!("{what} to which {} {verb} {of}", motion.name);
            let source = Source::Input(first + axis * (derivatives + 1) + order);
            let start = if order == 0 { *start } else { 0.0 };
            let (name, what) = match motion.kind {
                MotionKind::Position => (
                    component(&name, axis),
                    format!("{what}, component {}", AXES[axis]),
                ),
                MotionKind::Angle | MotionKind::Displacement => (name, what),
            };
            let place = list.0.len();
            list.add(name, what, Some(unit), source, Some(start));
            // Positions and rates go on from where they are; an acceleration may jump.
            if order == 2 {
                list.mark_direct(place);
            }
        }
    }
}

/// Where what a motion drives is as described.
fn start(scene: &Scene, motion: &Motion) -> Vec<f64> {
    let marker = motion.marker.as_deref().and_then(|name| scene.marker(name));
    let joint = motion.joint.as_deref().and_then(|name| scene.joint(name));
    match (motion.kind, marker, joint.map(|joint| &scene.joints[joint])) {
        (MotionKind::Position, Some(marker), _) => scene.position(marker).to_vec(),
        (MotionKind::Angle, Some(marker), _) => {
            let [x, y] = scene.direction(marker);
            vec![y.atan2(x)]
        }
        (MotionKind::Angle, _, Some(joint)) => vec![angle(scene, joint)],
        (MotionKind::Displacement, _, Some(joint)) => vec![way(scene, joint)],
        // A valid scene names what it drives.
        (kind, ..) => vec![0.0; if kind == MotionKind::Position { 2 } else { 1 }],
    }
}

/// Direction of the second marker of a joint less that of its first, from -pi to pi.
fn angle(scene: &Scene, joint: &Joint) -> f64 {
    let direction = |name: &str| match scene.marker(name) {
        Some(marker) if name != GROUND => scene.direction(marker),
        _ => [1.0, 0.0],
    };
    let [a, b] = [direction(&joint.markers[0]), direction(&joint.markers[1])];
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

/// How far the marker of a slider is from its point, along its direction.
fn way(scene: &Scene, joint: &Joint) -> f64 {
    let marker = scene.marker(&joint.markers[1]);
    let (Some(marker), Some(point), Some(along)) = (marker, joint.point, joint.direction) else {
        return 0.0;
    };
    let [x, y] = scene.position(marker);
    let dot = (x - point[0]) * along[0] + (y - point[1]) * along[1];
    dot / along[0].hypot(along[1])
}
