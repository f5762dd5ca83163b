//! Joints, motions, loads, ports and masses of a scene in words, as tables of the documentation.

use super::number::number;
use super::table::{code, row, table};
use crate::scene::{
    ContactBody, DirectionSource, Ends, JointCoordinate, JointPrimitive, LoadKind, MotionKind,
    PortKind, ResolvedContact, ResolvedFluid, ResolvedGear, ResolvedJoint, ResolvedLoad,
    ResolvedMotion, ResolvedPort, Scene, SceneVector, Surface, Value,
};
use crate::system::{Drive, Signal};

/// Tables of the parts of a scene; nothing for what it has none of.
pub(super) fn parts(scene: &Scene) -> String {
    let resolved = scene.resolved();
    let joints = resolved.joints.iter();
    let joints = joints.map(|joint| joint_in_words(scene.dimension, joint));
    let gears = resolved.gears.iter().map(gear_in_words);
    let motions = resolved.motions.iter().map(|motion| {
        let what = format!("{} {}", driven(motion), code(motion.kind.of()));
        row(&[&code(motion.name), &what, &course(motion)])
    });
    let loads = resolved.loads.iter().map(|load| {
        let (acts, on, size) = load_in_words(scene.dimension, load);
        row(&[&code(load.name), &acts, &on, &size])
    });
    let ports = resolved.ports.iter();
    let ports = ports.map(|port| {
        row(&[
            &code(port.name),
            &code(port.marker.name),
            &crosses(port, scene.dimension),
        ])
    });
    let masses = resolved.masses.iter().map(|mass| {
        let (size, inertia) = (number(mass.mass), number(mass.inertia));
        row(&[&code(mass.marker.name), &size, &inertia])
    });
    let heads = ["Name", "Kind", "Between", "Holds"];
    let note = "<p>The reaction of a joint is what it exerts on its second marker.</p>\n";
    [
        table("Joints", note, &heads, joints.collect()),
        table(
            "Gears",
            "",
            &["Name", "First", "Second", "Second per first"],
            gears.collect(),
        ),
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
            &["At", "Mass, kg", "Inertia, kg·m²"],
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

/// Describes what comes in and what goes out.
fn crosses(port: &ResolvedPort<'_>, dimension: usize) -> String {
    let given = port.given;
    let (turn, turns) = match (given.turns(), dimension) {
        (true, 2) => (" and moment", ", angle and its rates"),
        (true, _) => (
            " and moment",
            ", quaternion, angular velocity, angular acceleration",
        ),
        (false, _) => ("", ""),
    };
    match &port.kind {
        PortKind::Force { .. } => {
            format!("force{turn} in; position, velocity, acceleration{turns} out")
        }
        PortKind::Motion { .. } => {
            format!("position, velocity, acceleration{turns} in; force{turn} on the outside out")
        }
        PortKind::Coupling { .. } => {
            let units = ["N/m", "N·s/m", "N·m/rad", "N·m·s/rad"];
            let springs = given.springs().into_iter().zip(units);
            let sizes = springs.filter_map(|(size, unit)| {
                let size = size?;
                Some(format!("{} {unit}", number(size)))
            });
            let sizes: Vec<String> = sizes.collect();
            let turns = match (given.turns(), dimension) {
                (true, 2) => ", angle and its rate",
                (true, _) => ", quaternion, angular velocity",
                (false, _) => "",
            };
            format!(
                "position, velocity{turns} in, through {}; force{turn} on the outside out",
                sizes.join(", ")
            )
        }
    }
}

fn ends_in_words(ends: &Ends<'_>) -> String {
    format!("{}, {}", code(ends.first_name()), code(ends.second.name))
}

/// The point of the ground, where one is given.
fn at_point(dimension: usize, ends: &Ends<'_>) -> String {
    let point = ends.point();
    point.map_or(String::new(), |point| {
        format!(" at {}", vector(dimension, point))
    })
}

/// A number with words around it, where one is given.
fn given(before: &str, value: Option<f64>, unit: &str) -> String {
    value.map_or(String::new(), |value| {
        format!("{before} {} {unit}", number(value))
    })
}

/// The row of a joint.
fn joint_in_words(dimension: usize, joint: &ResolvedJoint<'_>) -> String {
    let kind = joint.kind_name();
    let holds = joint.primitives.iter();
    let holds = holds.map(|hold| hold_in_words(dimension, joint, hold));
    let until = joint.release.and_then(|release| release.time);
    let until = until.map(|time| format!("lets go at {} s", number(time)));
    let holds = holds.chain(until).collect::<Vec<_>>().join("; ");
    row(&[&code(joint.name), kind, &ends_in_words(&joint.ends), &holds])
}

/// Describes what a joint holds.
fn hold_in_words(dimension: usize, joint: &ResolvedJoint<'_>, hold: &JointPrimitive) -> String {
    let point = at_point(dimension, &joint.ends);
    match hold {
        JointPrimitive::AtPoint => format!("the position{point}"),
        JointPrimitive::Inline(direction) => {
            let axes = if joint.ends.is_grounded() {
                ""
            } else {
                " of the first"
            };
            let along = vector(dimension, *direction);
            format!("the position on a line along {along}{axes}{point}")
        }
        JointPrimitive::Orientation(angle) => {
            format!("the direction{}", given(" at", *angle, "rad"))
        }
        JointPrimitive::Distance(length) => {
            format!("the distance{}{point}", given(" of", *length, "m"))
        }
        JointPrimitive::ParallelAxes(axis) => {
            let axis = vector(dimension, *axis);
            format!("the axis that is along {axis} at the start")
        }
        JointPrimitive::Perpendicular(a, b) => {
            let [a, b] = [*a, *b].map(|of| vector(dimension, of));
            format!("a right angle between the axes that are along {a} and {b} at the start")
        }
        JointPrimitive::Homokinetic(a, b) => {
            let [a, b] = [*a, *b].map(|of| vector(dimension, of));
            format!("equal rotation about the axes that are along {a} and {b} at the start")
        }
        JointPrimitive::Inplane(across) => format!(
            "the position in the plane across {} at the start{point}",
            vector(dimension, *across)
        ),
        JointPrimitive::Screw(pitch) => format!("{} m along it a full turn", number(*pitch)),
        JointPrimitive::PointOnCurve => "the position on the line of the cable".into(),
        JointPrimitive::Spring {
            rest,
            stiffness,
            damping,
        } => {
            let [k, c] = [*stiffness, *damping].map(number);
            let rest = given(", at rest at", *rest, "rad");
            format!("{k} N·m/rad and {c} N·m·s/rad against rotation{rest}")
        }
    }
}

fn gear_in_words(gear: &ResolvedGear<'_>) -> String {
    let [first, second] = gear.coordinates.map(|of| coordinate_in_words(&of));
    row(&[&code(gear.name), &first, &second, &number(gear.ratio)])
}

fn coordinate_in_words(of: &JointCoordinate<'_>) -> String {
    let what = match of {
        JointCoordinate::Displacement(_) => "displacement of",
        JointCoordinate::Angle(_) => "angle of",
    };
    format!("{what} {}", code(of.name()))
}

fn driven(motion: &ResolvedMotion<'_>) -> &'static str {
    match &motion.kind {
        MotionKind::Angle(DirectionSource::Marker(_), _) => "the direction of",
        MotionKind::Angle(DirectionSource::Pivot(_), _) => "the angle of",
        MotionKind::Position(..) => "the position of",
        MotionKind::Orientation(..) => "the orientation of",
        MotionKind::Displacement(..) => "the way along",
        MotionKind::Winch(..) => "the length paid out at",
    }
}

fn course(motion: &ResolvedMotion<'_>) -> String {
    let derivatives = motion.kind.drives().iter().find_map(|drive| match drive {
        Drive::Input { derivatives, .. } => Some(*derivatives),
        Drive::Turned { attitude, .. } => Some(attitude.derivatives),
        Drive::Function(_) => None,
    });
    match derivatives {
        None => values(motion.values),
        Some(0) => "input".into(),
        Some(1) => "input, with its rate".into(),
        Some(_) => "input, with its rate and acceleration".into(),
    }
}

/// Describes a load, its target and its size.
fn load_in_words(dimension: usize, load: &ResolvedLoad<'_>) -> (String, String, String) {
    match &load.kind {
        LoadKind::Action {
            action,
            values: as_written,
        } => {
            let [what, unit] = action.kind.words();
            let turning = if action.follower {
                " that turns along (along and across)"
            } else {
                ""
            };
            (
                format!("{what}{turning}, {unit}"),
                code(action.on()),
                values(as_written),
            )
        }
        LoadKind::Spring(spring) => {
            let (first, second) = (spring.ends.first_name(), spring.ends.second.name);
            let point = at_point(dimension, &spring.ends);
            let [k, c] = [spring.stiffness, spring.damping].map(number);
            let length = spring.given.map_or(String::new(), |length| {
                format!(", length at rest {} m", value(length))
            });
            let size = format!("{k} N/m, {c} N·s/m{length}");
            (
                "spring and damper".into(),
                format!("{}{point}, {}", code(first), code(second)),
                size,
            )
        }
        LoadKind::TableSpring(spring) => {
            let point = at_point(dimension, &spring.ends);
            let damper = spring.damper.as_ref().map(|_| ", and over its rate");
            (
                "spring and damper by tables".into(),
                format!("{}{point}", ends_in_words(&spring.ends)),
                format!("force over length{}", damper.unwrap_or_default()),
            )
        }
        LoadKind::Fluid(fluid) => (
            "fluid".into(),
            code(&fluid.on.body.name),
            fluid_in_words(fluid),
        ),
        _ => spring_in_words(dimension, load),
    }
}

fn fluid_in_words(fluid: &ResolvedFluid<'_>) -> String {
    let is_input = fluid
        .current
        .iter()
        .any(|of| matches!(of, Signal::Input(_)));
    let current = match (is_input, fluid.given) {
        (true, _) => "current: input".into(),
        (false, []) => "at rest".into(),
        (false, given) => format!("current ({}) m/s", values(given)),
    };
    let [across, along] = fluid.drag;
    let coefficients = [
        ("drag", across),
        ("drag along the line", along),
        ("added mass", fluid.added_mass),
    ];
    let coefficients = coefficients.map(|(what, of)| format!(", {what} {}", number(of)));
    let lengths = given(", diameter", fluid.diameter, "m") + &given(", area", fluid.area, "m²");
    let lifts = if fluid.buoyancy { "" } else { ", no buoyancy" };
    let density = number(fluid.density);
    format!(
        "{density} kg/m³, {current}{}{lengths}{lifts}",
        coefficients.concat()
    )
}

/// Describes springs, dampers and limits of joints.
fn spring_in_words(dimension: usize, load: &ResolvedLoad<'_>) -> (String, String, String) {
    let units = |on: &JointCoordinate<'_>| {
        if on.is_angle() {
            ["N·m/rad", "N·m·s/rad", "s/rad", "rad"]
        } else {
            ["N/m", "N·s/m", "s/m", "m"]
        }
    };
    match &load.kind {
        LoadKind::JointSpring { on, sizes, rest } => {
            let ([k, c], unit) = (sizes.map(number), units(on));
            let rest = given(", at rest at", *rest, unit[3]);
            (
                "spring and damper".into(),
                coordinate_in_words(on),
                format!("{k} {}, {c} {}{rest}", unit[0], unit[1]),
            )
        }
        LoadKind::JointLimit { on, sizes, limits } => {
            let ([k, c], unit) = (sizes.map(number), units(on));
            let sides = [("below", limits[0]), ("above", limits[1])];
            let sides = sides.map(|(side, limit)| given(&format!(", {side}"), limit, unit[3]));
            (
                "stops".into(),
                coordinate_in_words(on),
                format!("{k} {}, {c} {}{}", unit[0], unit[2], sides.concat()),
            )
        }
        LoadKind::Bushing(bushing) => {
            let units = [["N/m", "N·m/rad"], ["N·s/m", "N·m·s/rad"]];
            let sizes = [bushing.stiffness, bushing.damping];
            let sizes = sizes.iter().zip(units).flat_map(|(sizes, units)| {
                let sizes = sizes.iter().zip(units);
                sizes.map(|(axes, unit)| format!("{} {unit}", vector(3, *axes)))
            });
            let point = at_point(3, &bushing.ends);
            (
                "bushing".into(),
                format!("{}{point}", ends_in_words(&bushing.ends)),
                sizes.collect::<Vec<_>>().join(", "),
            )
        }
        LoadKind::Contact(contact) => contact_in_words(dimension, contact),
        LoadKind::Action { .. }
        | LoadKind::Spring(_)
        | LoadKind::TableSpring(_)
        | LoadKind::Fluid(_) => Default::default(),
    }
}

/// Describes a contact.
fn contact_in_words(dimension: usize, contact: &ResolvedContact<'_>) -> (String, String, String) {
    let (by, unit) = match contact.by {
        ContactBody::Marker(marker) => (code(marker.name), "N/m"),
        ContactBody::Cable(cable) => (code(&cable.body.name), "N/m per length"),
    };
    let vector = |of: &SceneVector| vector(dimension, of.full());
    let surface = match &contact.surface {
        Surface::Plane { point, normal } => {
            format!("through {}, normal {}", vector(point), vector(normal))
        }
        Surface::Circle { center, radius } | Surface::Sphere { center, radius } => {
            format!("of radius {} m about {}", number(*radius), vector(center))
        }
        Surface::Cylinder {
            point,
            axis,
            radius,
        } => format!(
            "of radius {} m about the axis through {} along {}",
            number(*radius),
            vector(point),
            vector(axis)
        ),
    };
    let [k, a] = contact.sizes.map(number);
    let friction = contact.slip_velocity.map_or(String::new(), |speed| {
        let friction = number(contact.friction);
        format!(", friction {friction}, smooth below {} m/s", number(speed))
    });
    (
        format!("contact with a {}", contact.surface.name()),
        by,
        format!("{surface}; {k} {unit}, {a} s/m{friction}"),
    )
}

/// A point or a direction, with as many components as there are dimensions.
fn vector(dimension: usize, point: [f64; 3]) -> String {
    let components: Vec<String> = point[..dimension].iter().map(|c| number(*c)).collect();
    format!("({})", components.join(", "))
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
