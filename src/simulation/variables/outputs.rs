//! Outputs, natural frequencies, eigenvalues, and what goes out of ports.

use super::unit::*;
use super::{AXES, List, Quantity, Source, Unit, component};
use crate::scene::{
    HolderId, InputKind, JointKind, LoadKind, Marker, MarkerId, Output, Port, PortKind, Reaction,
    Resolved, SlideId, Turning,
};

/// Adds the outputs of a scene.
pub(super) fn add(list: &mut List, resolved: &Resolved<'_>) {
    for output in &resolved.outputs {
        add_output(list, resolved, output, None);
    }
    for port in &resolved.ports {
        if let PortKind::Force { outputs, .. } = &port.kind {
            for output in outputs {
                add_output(list, resolved, output, Some(port.name));
            }
        }
        add_port_force(list, port);
    }
}

/// An output; the variables of a port bear its name.
fn add_output(list: &mut List, resolved: &Resolved<'_>, output: &Output<'_>, port: Option<&str>) {
    let first = list.variables.len();
    match output {
        Output::Position(m) => {
            let words = ("position", "Position of", METRE);
            list.vector_at(m, port, words, Quantity::Position);
        }
        Output::Velocity(m) => {
            let words = ("velocity", "Velocity of", METRE_PER_SECOND);
            list.vector_at(m, port, words, Quantity::Velocity);
        }
        Output::Acceleration(m) => {
            let words = ("acceleration", "Acceleration of", METRE_PER_SECOND_2);
            list.vector_at(m, port, words, Quantity::Acceleration);
            list.mark_direct(first);
        }
        Output::ConnectivityForce(m) => {
            let what = "Force of the part before on the part after";
            let words = ("connectivity_force", what, NEWTON);
            list.vector_at(m, port, words, Quantity::ConnectivityForce);
            list.mark_direct(first);
        }
        Output::Strain(m) => {
            list.scalar_at(m, ("strain", "Axial strain at", None), Quantity::Strain);
        }
        Output::Curvature(m) => {
            let words = ("curvature", "Curvature at", Some(PER_METRE));
            list.scalar_at(m, words, Quantity::Curvature);
        }
        Output::AxialForce(m) => {
            let words = ("axial_force", "Axial force at", Some(NEWTON));
            list.scalar_at(m, words, Quantity::AxialForce);
            list.mark_direct(first);
        }
        Output::BendingMoment(m) => {
            let (name, what) = (
                format!("{}.bending_moment", m.name),
                format!("Bending moment at {}", m.name),
            );
            let quantity = |axis| Quantity::BendingMoment(m.id, axis);
            list.turning(&name, &what, NEWTON_METRE, quantity);
            list.mark_direct(first);
        }
        Output::Angle(turning, angle) => {
            add_angle(list, (turning, port), Quantity::Angle(*angle));
        }
        Output::AngularVelocity(turning) => add_angular_velocity(list, (turning, port)),
        Output::AngularAcceleration(turning) => add_angular_acceleration(list, (turning, port)),
        Output::Travel(joint, slide) => add_travel(list, joint, *slide),
        Output::Reaction(reaction) => add_reaction(list, reaction, false),
        Output::ReactionMoment(reaction) => add_reaction(list, reaction, true),
        Output::Energy => add_energies(list, resolved),
        Output::Work => add_work(list, resolved),
        Output::Momentum => add_momentum(list),
        Output::CenterOfMass => {
            let quantity = Quantity::CenterOfMass;
            list.vector("center_of_mass", "Centre of mass", METRE, quantity);
        }
        Output::Residual => add_residuals(list),
        Output::NaturalFrequency(body, count) => add_frequencies(list, *body, *count),
        Output::Eigenvalue(body, count) => add_eigenvalues(list, *body, *count),
    }
}

fn add_angle(list: &mut List, (turning, port): (&Turning<'_>, Option<&str>), quantity: Quantity) {
    let what = match turning {
        Turning::Pivot(pivot) => format!(
            "Direction of the second marker of {} less that of its first, counted on over full turns",
            pivot.name
        ),
        Turning::Marker(marker) => {
            format!("Direction at {}, counted on over full turns", marker.name)
        }
    };
    let name = format!("{}.angle", port.unwrap_or(turning.name()));
    list.scalar(&name, &what, Some(RADIAN), quantity);
}

fn add_angular_velocity(list: &mut List, of: (&Turning<'_>, Option<&str>)) {
    let words = ("angular_velocity", "Angular velocity", RADIAN_PER_SECOND);
    let quantities = (Quantity::AngularVelocity, Quantity::JointVelocity);
    add_angular_rate(list, of, words, quantities);
}

fn add_angular_acceleration(list: &mut List, of: (&Turning<'_>, Option<&str>)) {
    let (key, what) = ("angular_acceleration", "Angular acceleration");
    let quantities = (Quantity::AngularAcceleration, Quantity::JointAcceleration);
    let first = list.variables.len();
    add_angular_rate(list, of, (key, what, RADIAN_PER_SECOND_2), quantities);
    list.mark_direct(first);
}

/// Angular velocity or acceleration, of a marker or a joint.
fn add_angular_rate(
    list: &mut List,
    (turning, port): (&Turning<'_>, Option<&str>),
    (key, what, unit): (&str, &str, Unit),
    (of_marker, of_joint): (impl Fn(MarkerId) -> Quantity, impl Fn(HolderId) -> Quantity),
) {
    let (what, quantity) = match turning {
        Turning::Pivot(pivot) => (
            format!(
                "{what} of the second marker of {} less that of its first",
                pivot.name
            ),
            of_joint(pivot.joint),
        ),
        Turning::Marker(marker) => (
            format!("{what} of the direction at {}", marker.name),
            of_marker(marker.id),
        ),
    };
    let name = format!("{}.{key}", port.unwrap_or(turning.name()));
    list.scalar(&name, &what, Some(unit), quantity);
}

/// What a port that motions come into exerts on the outside.
fn add_port_force(list: &mut List, port: &Port<'_>) {
    use Quantity::{CouplingForce, CouplingMoment, MotionForce, MotionMoment};
    let first = list.variables.len();
    let what = format!(
        "of {} on what {} couples it to",
        port.marker.name, port.name
    );
    let (force, force_what) = (format!("{}.force", port.name), format!("Force {what}"));
    let moment = match &port.kind {
        PortKind::Force { .. } => return,
        PortKind::Motion { position, angle } => {
            let quantity = |axis| MotionForce(position.holder, axis);
            list.vector(&force, &force_what, NEWTON, quantity);
            angle.as_ref().map(|angle| MotionMoment(angle.holder))
        }
        PortKind::Coupling { position, angle } => {
            let quantity = |axis| CouplingForce(position.id, axis);
            list.vector(&force, &force_what, NEWTON, quantity);
            angle.as_ref().map(|angle| CouplingMoment(angle.id))
        }
    };
    if let Some(quantity) = moment {
        let (name, what) = (format!("{}.moment", port.name), format!("Moment {what}"));
        list.scalar(&name, &what, Some(NEWTON_METRE), quantity);
    }
    list.mark_direct(first);
}

fn add_travel(list: &mut List, joint: &str, slide: SlideId) {
    let what = format!("Length along the cable at which {joint} stands");
    let quantity = Quantity::Travel(slide);
    list.scalar(&format!("{joint}.travel"), &what, Some(METRE), quantity);
}

fn add_reaction(list: &mut List, reaction: &Reaction<'_>, is_moment: bool) {
    let (name, holder) = (reaction.name, reaction.holder);
    let on = match reaction.is_motion {
        true => "what it drives",
        false => "its second marker",
    };
    let first = list.variables.len();
    if is_moment {
        let what = format!("Moment of {name} on {on}");
        let (name, quantity) = (
            format!("{name}.reaction_moment"),
            Quantity::ReactionMoment(holder),
        );
        list.scalar(&name, &what, Some(NEWTON_METRE), quantity);
    } else {
        let what = format!("Force of {name} on {on}");
        let quantity = |axis| Quantity::Reaction(holder, axis);
        list.vector(&format!("{name}.reaction"), &what, NEWTON, quantity);
    }
    list.mark_direct(first);
}

fn add_energies(list: &mut List, resolved: &Resolved<'_>) {
    use Quantity::{GravityEnergy, KineticEnergy, SpringEnergy, StrainEnergy};
    let gravity = if resolved.scene.rotation == 0.0 {
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
    if stiffnesses(resolved).into_iter().any(|k| k > 0.0) {
        let (what, first) = (
            "Energy in springs, hinges and couplings",
            list.variables.len(),
        );
        list.scalar("energy.spring", what, Some(JOULE), SpringEnergy);
        if sets_springs(resolved) {
            list.mark_direct(first);
        }
    }
}

/// Stiffnesses of springs, hinges and couplings.
fn stiffnesses(resolved: &Resolved<'_>) -> Vec<f64> {
    let springs = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Spring(spring) => Some(spring.stiffness),
        LoadKind::Action { .. } => None,
    });
    let hinges = resolved.joints.iter().filter_map(|joint| match joint.kind {
        JointKind::Hinge { stiffness, .. } => Some(stiffness),
        _ => None,
    });
    let couplings = resolved.ports.iter().filter_map(|port| match &port.kind {
        PortKind::Coupling { position, angle } => {
            let turning = angle.as_ref().map_or(0.0, |angle| angle.stiffness);
            Some(position.stiffness.max(turning))
        }
        PortKind::Force { .. } | PortKind::Motion { .. } => None,
    });
    springs.chain(hinges).chain(couplings).collect()
}

/// Whether the master sets the length of a spring or where one ends: it then works on the spring at once.
pub(in crate::simulation) fn sets_springs(resolved: &Resolved<'_>) -> bool {
    let mut inputs = resolved.inputs.iter();
    inputs.any(|input| matches!(input.kind, InputKind::RestLength(_))) || resolved.couplings > 0
}

fn add_work(list: &mut List, resolved: &Resolved<'_>) {
    let what = "Work that loads, inputs and motions have done since the start";
    let first = list.variables.len();
    list.scalar("energy.input", what, Some(JOULE), Quantity::Input);
    if sets_springs(resolved) {
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
    list.turning(name, what, NEWTON_METRE_SECOND, quantity);
}

fn add_residuals(list: &mut List) {
    let what = "Largest residual of the positions that constraints hold, relative";
    list.scalar("residual.position", what, None, Quantity::Residual(0));
    let what = "Largest residual of the velocities that constraints hold, relative";
    let unit = Some(PER_SECOND);
    list.scalar("residual.velocity", what, unit, Quantity::Residual(1));
}

fn add_frequencies(list: &mut List, body: Option<&str>, count: u32) {
    let name = match body {
        Some(body) => format!("{body}.natural_frequency"),
        None => "natural_frequency".into(),
    };
    for number in 0..count as usize {
        let what = format!(
            "Natural frequency {} at rest in the initial configuration; an unstable one is negative",
            number + 1
        );
        let source = Source::NaturalFrequency(number);
        let unit = Some(RADIAN_PER_SECOND);
        list.add(component(&name, number), what, unit, source, None);
    }
}

fn add_eigenvalues(list: &mut List, body: Option<&str>, count: u32) {
    let name = body.map_or("eigenvalue".into(), |body| format!("{body}.eigenvalue"));
    let parts = [
        (
            "decay_rate",
            "Decay rate",
            "; a growing one is negative",
            PER_SECOND,
        ),
        (
            "frequency",
            "Frequency",
            ", 0 of a real one",
            RADIAN_PER_SECOND,
        ),
    ];
    for (part, (key, what, note, unit)) in parts.into_iter().enumerate() {
        for number in 0..count as usize {
            let name = component(&format!("{name}.{key}"), number);
            let what = format!(
                "{what} of eigenvalue {} about the initial state{note}",
                number + 1
            );
            list.add(
                name,
                what,
                Some(unit),
                Source::Eigenvalue(number, part),
                None,
            );
        }
    }
}

impl List {
    /// The components of a vector at a marker; of a port, by its name.
    fn vector_at(
        &mut self,
        marker: &Marker<'_>,
        port: Option<&str>,
        (key, what, unit): (&str, &str, Unit),
        quantity: fn(MarkerId, usize) -> Quantity,
    ) {
        let name = format!("{}.{key}", port.unwrap_or(marker.name));
        let what = format!("{what} {}", marker.name);
        self.vector(&name, &what, unit, |axis| quantity(marker.id, axis));
    }

    fn scalar_at(
        &mut self,
        marker: &Marker<'_>,
        (key, what, unit): (&str, &str, Option<Unit>),
        quantity: fn(MarkerId) -> Quantity,
    ) {
        let (name, what) = (
            format!("{}.{key}", marker.name),
            format!("{what} {}", marker.name),
        );
        self.scalar(&name, &what, unit, quantity(marker.id));
    }

    /// What turns: a number in the plane, three components in space.
    fn turning(&mut self, name: &str, what: &str, unit: Unit, of: impl Fn(usize) -> Quantity) {
        match self.dimension {
            2 => self.scalar(name, what, Some(unit), of(2)),
            _ => self.vector(name, what, unit, of),
        }
    }

    /// The components of a vector.
    fn vector(&mut self, name: &str, what: &str, unit: Unit, quantity: impl Fn(usize) -> Quantity) {
        for axis in 0..self.dimension {
            let what = format!("{what}, component {}", AXES[axis]);
            self.scalar(&component(name, axis), &what, Some(unit), quantity(axis));
        }
    }

    fn scalar(&mut self, name: &str, what: &str, unit: Option<Unit>, quantity: Quantity) {
        self.add(name, what, unit, Source::Output(quantity), None);
    }
}
