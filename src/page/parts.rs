//! Joints, motions, loads, ports and masses of a scene in words, as tables of the documentation.

use super::table::{table, worded};
use crate::scene::words::{code, ends, number, values};
use crate::scene::{
    EdgeBase, PortKind, ResolvedEdge, ResolvedGear, ResolvedJoint, ResolvedMotion, ResolvedPort,
    Scene,
};
use crate::system::Drive;

/// Tables of the parts of a scene; nothing for what it has none of.
pub(super) fn parts(scene: &Scene) -> String {
    let resolved = scene.resolved();
    let joints = resolved.joints.iter();
    let joints = joints.map(|joint| joint_in_words(scene.dimension, joint));
    let joints = joints.chain(resolved.edges.iter().map(edge_in_words));
    let gears = resolved.gears.iter().map(gear_in_words);
    let latches = resolved.latches.iter().map(|latch| {
        let [coordinate, at, conditions] = latch.words();
        worded(&[&code(latch.name), &coordinate, &at, &conditions])
    });
    let motions = resolved.motions.iter().map(|motion| {
        let quantity = motion.driven.quantity();
        let what = format!("{} {}", quantity.words, code(quantity.place.name()));
        worded(&[&code(motion.name), &what, &course(motion)])
    });
    let loads = resolved.loads.iter().map(|load| {
        let words = load.kind.words(scene.dimension);
        worded(&[&code(load.name), &words.kind, &words.on, &words.size])
    });
    let ports = resolved.ports.iter();
    let ports = ports.map(|port| {
        worded(&[
            &code(port.name),
            &code(port.marker.name),
            &crosses(port, scene.dimension),
        ])
    });
    let masses = resolved.masses.iter().map(|mass| {
        let (size, inertia) = (number(mass.mass), number(mass.inertia));
        worded(&[&code(mass.marker.name), &size, &inertia])
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
            "Latches",
            "",
            &[
                "Name",
                "Holds",
                "At",
                "State at the start, and when it opens",
            ],
            latches.collect(),
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

/// The row of a joint.
fn joint_in_words(dimension: usize, joint: &ResolvedJoint<'_>) -> String {
    let holds = joint.words(dimension);
    worded(&[
        &code(joint.name),
        joint.kind_name(),
        &ends(&joint.ends),
        &holds,
    ])
}

/// The row of a joint of an edge.
fn edge_in_words(edge: &ResolvedEdge<'_>) -> String {
    let base = edge.base_name();
    let base = match edge.base {
        EdgeBase::Ground => base,
        _ => code(&base),
    };
    let between = format!("{base}, {}", code(&edge.line.place()));
    worded(&[&code(edge.name), edge.kind, &between, &edge.words()])
}

fn gear_in_words(gear: &ResolvedGear<'_>) -> String {
    let [first, second] = gear.words();
    worded(&[&code(gear.name), &first, &second, &number(gear.ratio)])
}

fn course(motion: &ResolvedMotion<'_>) -> String {
    let derivatives = motion.driven.drives.iter().find_map(|drive| match drive {
        Drive::Input { derivatives, .. } => Some(*derivatives),
        Drive::Turned { attitude, .. } => Some(attitude.derivatives),
        Drive::Function(_) | Drive::Kept => None,
    });
    match derivatives {
        None => values(motion.values),
        Some(0) => "input".into(),
        Some(1) => "input, with its rate".into(),
        Some(_) => "input, with its rate and acceleration".into(),
    }
}
