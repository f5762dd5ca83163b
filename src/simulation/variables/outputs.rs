//! Outputs, natural frequencies, and what goes out of ports.

use super::unit::*;
use super::{AXES, List, Quantity, Source, Unit, component};
use crate::scene::{
    At, InputKind, JointKind, LoadKind, MarkerReference, Output, OutputKind, Port, Scene,
};

/// Adds the outputs of a scene.
pub(super) fn add(list: &mut List, scene: &Scene) {
    let mut angles = 0;
    for output in &scene.outputs {
        add_output(list, scene, (output, None), &mut angles);
    }
    for (place, port) in scene.ports.iter().enumerate() {
        for output in port.outputs() {
            add_output(list, scene, (&output, Some(&port.name)), &mut angles);
        }
        add_port_force(list, scene, place, port);
    }
}

/// An output; the variables of a port bear its name. Angles are numbered in the order of listing.
fn add_output(
    list: &mut List,
    scene: &Scene,
    (output, port): (&Output, Option<&str>),
    angles: &mut usize,
) {
    let of = port.or(output.marker.as_deref()).unwrap_or_default();
    match output.kind {
        OutputKind::Angle => {
            add_angle(list, (output, of), Quantity::Angle(*angles));
            *angles += 1;
        }
        OutputKind::AngularVelocity | OutputKind::AngularAcceleration => {
            add_angular_rate(list, scene, (output, of));
        }
        OutputKind::Travel => add_travel(list, scene, output),
        OutputKind::Reaction | OutputKind::ReactionMoment => add_reaction(list, scene, output),
        OutputKind::Energy => add_energies(list, scene),
        OutputKind::Work => add_work(list, scene),
        OutputKind::Momentum => add_momentum(list),
        OutputKind::CenterOfMass => {
            let quantity = Quantity::CenterOfMass;
            list.vector("center_of_mass", "Centre of mass", METRE, quantity);
        }
        OutputKind::Residual => add_residuals(list),
        OutputKind::NaturalFrequency => add_frequencies(list, output),
        _ => add_marker_output(list, scene, (output, of)),
    }
}

/// Key, meaning and unit of a quantity at a marker.
fn marker_words(kind: OutputKind) -> (&'static str, &'static str, Option<Unit>) {
    match kind {
        OutputKind::Velocity => ("velocity", "Velocity of", Some(METRE_PER_SECOND)),
        OutputKind::Acceleration => ("acceleration", "Acceleration of", Some(METRE_PER_SECOND_2)),
        OutputKind::Strain => ("strain", "Axial strain at", None),
        OutputKind::Curvature => ("curvature", "Curvature at", Some(PER_METRE)),
        OutputKind::AxialForce => ("axial_force", "Axial force at", Some(NEWTON)),
        OutputKind::BendingMoment => ("bending_moment", "Bending moment at", Some(NEWTON_METRE)),
        OutputKind::ConnectivityForce => (
            "connectivity_force",
            "Force of the part before on the part after",
            Some(NEWTON),
        ),
        _ => ("position", "Position of", Some(METRE)),
    }
}

fn add_marker_output(list: &mut List, scene: &Scene, (output, of): (&Output, &str)) {
    use Quantity::*;
    let marker = output.marker.as_deref().unwrap_or_default();
    let at = reference(scene, marker);
    let (key, what, unit) = marker_words(output.kind);
    let (name, what) = (format!("{of}.{key}"), format!("{what} {marker}"));
    let first = list.0.len();
    let scalar = match output.kind {
        OutputKind::Strain => Strain(at),
        OutputKind::Curvature => Curvature(at),
        OutputKind::AxialForce => AxialForce(at),
        OutputKind::BendingMoment => BendingMoment(at),
        kind => {
            let unit = unit.unwrap_or(METRE);
            return match kind {
                OutputKind::Velocity => list.vector(&name, &what, unit, |i| Velocity(at, i)),
                OutputKind::Acceleration => {
                    list.vector(&name, &what, unit, |i| Acceleration(at, i));
                    list.mark_direct(first);
                }
                OutputKind::ConnectivityForce => {
                    list.vector(&name, &what, unit, |i| ConnectivityForce(at, i));
                    list.mark_direct(first);
                }
                _ => list.vector(&name, &what, unit, |i| Position(at, i)),
            };
        }
    };
    list.scalar(&name, &what, unit, scalar);
}

/// The marker of this name; a valid scene has it.
fn reference(scene: &Scene, marker: &str) -> MarkerReference {
    scene.marker(marker).unwrap_or(MarkerReference {
        body: 0,
        at: At::Along(0.0),
    })
}

fn add_angle(list: &mut List, (output, of): (&Output, &str), quantity: Quantity) {
    let unit = Some(RADIAN);
    match (&output.joint, &output.marker) {
        (Some(joint), _) => {
            let what = format!(
                "Direction of the second marker of {joint} less that of its first, counted on over \
                 full turns"
            );
            list.scalar(&format!("{joint}.angle"), &what, unit, quantity);
        }
        (None, marker) => {
            let marker = marker.as_deref().unwrap_or_default();
            let what = format!("Direction at {marker}, counted on over full turns");
            list.scalar(&format!("{of}.angle"), &what, unit, quantity);
        }
    }
}

/// Angular velocity or acceleration.
fn add_angular_rate(list: &mut List, scene: &Scene, (output, of): (&Output, &str)) {
    use Quantity::{AngularAcceleration, AngularVelocity, JointAcceleration, JointVelocity};
    let is_second = output.kind == OutputKind::AngularAcceleration;
    let (key, what, unit) = match is_second {
        true => (
            "angular_acceleration",
            "Angular acceleration",
            RADIAN_PER_SECOND_2,
        ),
        false => ("angular_velocity", "Angular velocity", RADIAN_PER_SECOND),
    };
    let (of, what, quantity) = match (&output.joint, &output.marker) {
        (Some(name), _) => {
            let joint = scene.joint(name).unwrap_or(0);
            let what = format!("{what} of the second marker of {name} less that of its first");
            let second = is_second.then_some(JointAcceleration(joint));
            (name.as_str(), what, second.unwrap_or(JointVelocity(joint)))
        }
        (None, marker) => {
            let marker = marker.as_deref().unwrap_or_default();
            let at = reference(scene, marker);
            let what = format!("{what} of the direction at {marker}");
            let second = is_second.then_some(AngularAcceleration(at));
            (of, what, second.unwrap_or(AngularVelocity(at)))
        }
    };
    let first = list.0.len();
    list.scalar(&format!("{of}.{key}"), &what, Some(unit), quantity);
    if is_second {
        list.mark_direct(first);
    }
}

/// What a port that motions come into exerts on the outside.
fn add_port_force(list: &mut List, scene: &Scene, place: usize, port: &Port) {
    use Quantity::{CouplingForce, CouplingMoment, MotionForce, MotionMoment};
    if port.motions().is_empty() {
        return;
    }
    let first = list.0.len();
    let (joint, coupling) = (
        scene.joints_before_port(place),
        scene.couplings_before_port(place),
    );
    let what = format!("of {} on what {} couples it to", port.marker, port.name);
    let name = format!("{}.force", port.name);
    list.vector(&name, &format!("Force {what}"), NEWTON, |axis| {
        match port.is_coupling() {
            true => CouplingForce(coupling, axis),
            false => MotionForce(joint, axis),
        }
    });
    if port.turns() {
        let quantity = match port.is_coupling() {
            true => CouplingMoment(coupling + 1),
            false => MotionMoment(joint + 1),
        };
        let (name, what) = (format!("{}.moment", port.name), format!("Moment {what}"));
        list.scalar(&name, &what, Some(NEWTON_METRE), quantity);
    }
    list.mark_direct(first);
}

fn add_travel(list: &mut List, scene: &Scene, output: &Output) {
    let name = output.joint.as_deref().unwrap_or_default();
    let before = &scene.joints[..scene.joint(name).unwrap_or(0)];
    let place = before.iter().filter(|joint| joint.kind == JointKind::Along);
    let quantity = Quantity::Travel(place.count());
    let what = format!("Length along the cable at which {name} stands");
    list.scalar(&format!("{name}.travel"), &what, Some(METRE), quantity);
}

fn add_reaction(list: &mut List, scene: &Scene, output: &Output) {
    let (name, index, on) = match (&output.motion, &output.joint) {
        (Some(name), _) => {
            let motion = scene.motion(name).unwrap_or(0);
            (name.as_str(), scene.joints.len() + motion, "what it drives")
        }
        (None, joint) => {
            let name = joint.as_deref().unwrap_or_default();
            (name, scene.joint(name).unwrap_or(0), "its second marker")
        }
    };
    let first = list.0.len();
    if output.kind == OutputKind::Reaction {
        let what = format!("Force of {name} on {on}");
        let quantity = |axis| Quantity::Reaction(index, axis);
        list.vector(&format!("{name}.reaction"), &what, NEWTON, quantity);
    } else {
        let what = format!("Moment of {name} on {on}");
        let (name, quantity) = (
            format!("{name}.reaction_moment"),
            Quantity::ReactionMoment(index),
        );
        list.scalar(&name, &what, Some(NEWTON_METRE), quantity);
    }
    list.mark_direct(first);
}

fn add_energies(list: &mut List, scene: &Scene) {
    use Quantity::{GravityEnergy, KineticEnergy, SpringEnergy, StrainEnergy};
    let gravity = if scene.rotation == 0.0 {
        "Potential energy of gravity, zero at the origin"
    } else {
        "Potential energy of gravity and of the centrifugal force, zero at the origin"
    };
    for (name, what, quantity) in [
        ("energy.kinetic", "Kinetic energy", KineticEnergy),
        ("energy.strain", "Strain energy", StrainEnergy),
        ("energy.gravity", gravity, GravityEnergy),
    ] {
        list.scalar(name, what, Some(JOULE), quantity);
    }
    let stiff = |stiffness: Option<f64>| stiffness.is_some_and(|stiffness| stiffness > 0.0);
    let springs = scene
        .loads
        .iter()
        .filter(|load| load.kind == LoadKind::SpringDamper);
    let hinges = scene
        .joints
        .iter()
        .filter(|joint| joint.kind == JointKind::Hinge);
    let couplings = scene
        .ports
        .iter()
        .flat_map(|port| [port.stiffness, port.rotational_stiffness]);
    let mut stiffnesses = springs
        .map(|load| load.stiffness)
        .chain(hinges.map(|joint| joint.stiffness))
        .chain(couplings);
    if stiffnesses.any(stiff) {
        let (what, first) = ("Energy in springs, hinges and couplings", list.0.len());
        list.scalar("energy.spring", what, Some(JOULE), SpringEnergy);
        if sets_springs(scene) {
            list.mark_direct(first);
        }
    }
}

/// Whether the master sets the length of a spring or where one ends: it then works on the spring at once.
pub(in crate::simulation) fn sets_springs(scene: &Scene) -> bool {
    let mut inputs = scene.inputs.iter();
    inputs.any(|input| input.kind == InputKind::RestLength)
        || scene.ports.iter().any(Port::is_coupling)
}

fn add_work(list: &mut List, scene: &Scene) {
    let what = "Work that loads, inputs and motions have done since the start";
    let first = list.0.len();
    list.scalar("energy.input", what, Some(JOULE), Quantity::Input);
    if sets_springs(scene) {
        list.mark_direct(first);
    }
    let what = "Energy lost in dampers and in damping since the start";
    list.scalar("energy.dissipated", what, Some(JOULE), Quantity::Dissipated);
}

fn add_momentum(list: &mut List) {
    let what = "Linear momentum";
    list.vector("momentum", what, NEWTON_SECOND, Quantity::Momentum);
    let (name, what) = ("angular_momentum", "Angular momentum about the origin");
    let quantity = Quantity::AngularMomentum;
    list.scalar(name, what, Some(NEWTON_METRE_SECOND), quantity);
}

fn add_residuals(list: &mut List) {
    let what = "Largest residual of the positions that constraints hold, relative";
    list.scalar("residual.position", what, None, Quantity::Residual(0));
    let what = "Largest residual of the velocities that constraints hold, relative";
    let unit = Some(PER_SECOND);
    list.scalar("residual.velocity", what, unit, Quantity::Residual(1));
}

fn add_frequencies(list: &mut List, output: &Output) {
    let name = match &output.body {
        Some(body) => format!("{body}.natural_frequency"),
        None => "natural_frequency".into(),
    };
    for number in 0..output.count.unwrap_or(0) as usize {
        let what = format!(
            "Natural frequency {} about the initial configuration; an unstable one is negative",
            number + 1
        );
        let source = Source::NaturalFrequency(number);
        let unit = Some(RADIAN_PER_SECOND);
        list.add(component(&name, number), what, unit, source, None);
    }
}

impl List {
    /// The two components of a vector.
    fn vector(&mut self, name: &str, what: &str, unit: Unit, quantity: impl Fn(usize) -> Quantity) {
        for axis in 0..2 {
            let what = format!("{what}, component {}", AXES[axis]);
            self.scalar(&component(name, axis), &what, Some(unit), quantity(axis));
        }
    }

    fn scalar(&mut self, name: &str, what: &str, unit: Option<Unit>, quantity: Quantity) {
        self.add(name, what, unit, Source::Output(quantity), None);
    }
}
