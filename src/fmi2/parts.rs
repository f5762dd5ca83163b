//! Joints, motions, loads, ports and masses of a scene in words, as tables of the documentation.

use super::canvas::escape;
use super::documentation::{row, table};
use super::number::number;
use crate::scene::{
    GROUND, Joint, JointKind, Load, LoadKind, Motion, MotionKind, MotionValue, Port, PortKind,
    Scene, Value,
};

/// Tables of the parts of a scene; nothing for what it has none of.
pub(super) fn parts(scene: &Scene) -> String {
    let joints = scene.joints.iter().map(|joint| {
        let between = joint.markers.each_ref().map(|name| code(name));
        let between = between.join(", ");
        row(&[&code(&joint.name), kind(joint), &between, &holds(joint)])
    });
    let motions = scene.motions.iter().map(|motion| {
        let of = motion.marker.as_ref().or(motion.joint.as_ref());
        let what = format!("{} {}", driven(motion), code(of.map_or("", String::as_str)));
        row(&[&code(&motion.name), &what, &course(motion)])
    });
    let loads = scene.loads.iter();
    let loads = loads.map(|load| row(&[&code(&load.name), acts(load), &on(load), &size(load)]));
    let ports = scene.ports.iter();
    let ports = ports.map(|port| row(&[&code(&port.name), &code(&port.marker), &crosses(port)]));
    let masses = scene.masses.iter().map(|mass| {
        let (size, inertia) = (number(mass.mass), number(mass.inertia));
        row(&[&code(&mass.marker), &size, &inertia])
    });
    let heads = ["Name", "Kind", "Between", "Holds"];
    let note = "<p>The reaction of a joint is what it exerts on its second marker.</p>\n";
    [
        table("Joints", note, &heads, joints.collect()),
        table(
            "Motions",
            "",
            &["Name", "Drives", "Course"],
            motions.collect(),
        ),
        table(
            "Loads",
            "",
            &["Name", "Kind", "On", "Size"],
            loads.collect(),
        ),
        table(
            "Ports",
            PORTS,
            &["Name", "At", "In and out"],
            ports.collect(),
        ),
        table(
            "Masses at markers",
            "",
            &["At", "Mass, kg", "Inertia, kg m2"],
            masses.collect(),
        ),
    ]
    .concat()
}

/// How to use ports.
const PORTS: &str = "<p>Connect a port that forces come into with one that motions come into, member by \
    member; <code>terminalsAndIcons.xml</code> lists them, and what both have is connected. A spring and \
    damper belong into the unit that feels them as loads, so that its solver meets their stiffness and \
    not the communication step; without one, give accelerations too, and step short.</p>\n";

/// What comes in and what goes out.
fn crosses(port: &Port) -> String {
    let (turn, turns) = match port.turns() {
        true => (" and moment", ", angle and its rates"),
        false => ("", ""),
    };
    match (port.kind, port.is_coupling()) {
        (PortKind::Force, _) => {
            format!("force{turn} in; position, velocity, acceleration{turns} out")
        }
        (PortKind::Motion, false) => {
            format!("position, velocity, acceleration{turns} in; force{turn} on the outside out")
        }
        (PortKind::Motion, true) => {
            let springs = [
                (port.stiffness, "N/m"),
                (port.damping, "N s/m"),
                (port.rotational_stiffness, "N m/rad"),
                (port.rotational_damping, "N m s/rad"),
            ];
            let sizes = springs.into_iter().filter_map(|(size, unit)| {
                let size = size?;
                Some(format!("{} {unit}", number(size)))
            });
            let sizes: Vec<String> = sizes.collect();
            let turns = if port.turns() {
                ", angle and its rate"
            } else {
                ""
            };
            format!(
                "position, velocity{turns} in, through {}; force{turn} on the outside out",
                sizes.join(", ")
            )
        }
    }
}

fn code(text: &str) -> String {
    format!("<code>{}</code>", escape(text))
}

fn kind(joint: &Joint) -> &'static str {
    match joint.kind {
        JointKind::Revolute => "revolute",
        JointKind::Weld => "weld",
        JointKind::Slider => "slider",
        JointKind::Orientation => "orientation",
        JointKind::Distance => "distance",
        JointKind::Hinge => "hinge",
        JointKind::Along => "along",
    }
}

fn holds(joint: &Joint) -> String {
    let angle = joint
        .angle
        .map(|angle| format!(" at {} rad", number(angle)));
    let angle = angle.unwrap_or_default();
    let point = joint.point.map(|p| format!(" at {}", vector(p)));
    let point = point.unwrap_or_default();
    match joint.kind {
        JointKind::Revolute => format!("the position{point}"),
        JointKind::Weld => format!("position{point} and direction{angle}"),
        JointKind::Slider => {
            let along = vector(joint.direction.unwrap_or_default());
            format!("the position on a line along {along}{point}")
        }
        JointKind::Orientation => format!("the direction{angle}"),
        JointKind::Distance => {
            let length = joint
                .length
                .map(|length| format!(" of {} m", number(length)));
            let from = if joint.markers[0] == GROUND {
                &point
            } else {
                ""
            };
            format!("the distance{}{from}", length.unwrap_or_default())
        }
        JointKind::Hinge => {
            let [k, c] = [joint.stiffness, joint.damping].map(|v| number(v.unwrap_or(0.0)));
            let rest = if angle.is_empty() {
                String::new()
            } else {
                format!(", at rest{angle}")
            };
            format!("the position{point}; {k} N m/rad and {c} N m s/rad against rotation{rest}")
        }
        JointKind::Along => "the position on the line of the cable".into(),
    }
}

fn driven(motion: &Motion) -> &'static str {
    match (motion.kind, &motion.joint) {
        (MotionKind::Angle, None) => "the direction of",
        (MotionKind::Angle, Some(_)) => "the angle of",
        (MotionKind::Position, _) => "the position of",
        (MotionKind::Displacement, _) => "the way along",
    }
}

fn course(motion: &Motion) -> String {
    match &motion.value {
        MotionValue::Input(input) => match input.input {
            0 => "input".into(),
            1 => "input, with its rate".into(),
            _ => "input, with its rate and acceleration".into(),
        },
        known => values(known.components()),
    }
}

fn acts(load: &Load) -> &'static str {
    match load.kind {
        LoadKind::Force if load.follower => "force that turns along (along and across)",
        LoadKind::Force => "force, N",
        LoadKind::Moment => "moment, N m",
        LoadKind::Torque => "torque, N m",
        LoadKind::Distributed => "force per reference length, N/m",
        LoadKind::SpringDamper => "spring and damper",
    }
}

fn on(load: &Load) -> String {
    let one = [&load.marker, &load.joint, &load.body];
    let names = one
        .into_iter()
        .flatten()
        .chain(load.markers.iter().flatten());
    let mut names: Vec<String> = names.map(|name| code(name)).collect();
    if let Some(point) = load.point {
        names[0] += &format!(" at {}", vector(point));
    }
    names.join(", ")
}

fn size(load: &Load) -> String {
    if load.kind != LoadKind::SpringDamper {
        return load
            .value
            .as_ref()
            .map_or(String::new(), |value| values(value.components()));
    }
    let [k, c] = [load.stiffness, load.damping].map(|v| number(v.unwrap_or(0.0)));
    let length = load
        .length
        .as_ref()
        .map(|length| format!(", length at rest {} m", value(length)));
    format!("{k} N/m, {c} N s/m{}", length.unwrap_or_default())
}

fn vector(point: [f64; 2]) -> String {
    format!("({}, {})", number(point[0]), number(point[1]))
}

fn values(values: &[Value]) -> String {
    values.iter().map(value).collect::<Vec<_>>().join(", ")
}

fn value(value: &Value) -> String {
    match value {
        Value::Number(value) => number(*value),
        Value::Expression(text) => code(text),
        Value::Table(table) => {
            let points = &table.table;
            let times = points.first().zip(points.last());
            let [from, to] = times.map_or([0.0; 2], |(a, b)| [a[0], b[0]]);
            let (from, to) = (number(from), number(to));
            format!("table of {} points from {from} s to {to} s", points.len())
        }
    }
}
