//! Parameters.

use super::unit::*;
use super::{AXES, List, Parameter, Source, Unit, component};
use crate::scene::{Body, CableBody, JointKind, LoadKind, RigidBody, Scene};

/// Key, meaning, unit, what it stands for, start value.
type Row<'a> = (&'a str, &'a str, Option<Unit>, Parameter, f64);

/// Adds the parameters of a scene.
pub(super) fn add(list: &mut List, scene: &Scene) {
    for (i, body) in scene.bodies.iter().enumerate() {
        match body {
            Body::Cable(body) => add_cable(list, i, body),
            Body::Rigid(body) => add_rigid(list, i, body),
        }
    }
    for (i, mass) in scene.masses.iter().enumerate() {
        let what = "Mass lumped";
        let parameter = Parameter::LumpedMass(i);
        let row = ("mass", what, Some(KILOGRAM), parameter, mass.mass);
        list.parameters(&mass.marker, "at", &[row]);
    }
    add_dampers(list, scene);
    for axis in 0..2 {
        let what = format!("Gravitational acceleration, component {}", AXES[axis]);
        let (unit, parameter) = (Some(METRE_PER_SECOND_2), Parameter::Gravity(axis));
        let name = component("gravity", axis);
        list.parameter(name, what, unit, parameter, scene.gravity[axis]);
    }
    if scene.rotation != 0.0 {
        let what = "Rate of the frame that the scene is described in, about its origin";
        let (unit, parameter) = (Some(RADIAN_PER_SECOND), Parameter::Rotation);
        list.parameter("rotation", what, unit, parameter, scene.rotation);
    }
    let what = "Error in time that a step may make, relative to the size of the scene";
    let (parameter, start) = (
        Parameter::RelativeTolerance,
        scene.accuracy.relative_tolerance,
    );
    list.parameter("relative_tolerance", what, None, parameter, start);
}

fn add_cable(list: &mut List, i: usize, body: &CableBody) {
    use Parameter::*;
    let (material, section) = (&body.material, &body.section);
    let elements = f64::from(body.elements);
    #[rustfmt::skip] // a table
    let rows: [Row<'_>; 6] = [
        ("youngs_modulus", "Young's modulus", Some(PASCAL), YoungsModulus(i), material.youngs_modulus),
        ("density", "Density", Some(DENSITY), Density(i), material.density),
        ("damping_time", "Kelvin-Voigt damping time", Some(SECOND), DampingTime(i), material.damping_time),
        ("area", "Area of the cross section", Some(SQUARE_METRE), Area(i), section.area),
        ("second_moment", "Second moment of area", Some(METRE_4), SecondMoment(i), section.second_moment),
        ("elements", "Number of elements", None, Elements(i), elements),
    ];
    list.parameters(&body.name, "of", &rows);
}

fn add_rigid(list: &mut List, i: usize, body: &RigidBody) {
    let (mass, inertia) = (Parameter::Mass(i), Parameter::Inertia(i));
    let about = "Moment of inertia about the centre of mass";
    let rows = [
        ("mass", "Mass", Some(KILOGRAM), mass, body.mass),
        ("inertia", about, Some(INERTIA), inertia, body.inertia),
    ];
    list.parameters(&body.name, "of", &rows);
}

/// Stiffness and damping of hinges, spring-dampers and couplings.
fn add_dampers(list: &mut List, scene: &Scene) {
    use Parameter::*;
    let hinges = scene.joints.iter().enumerate();
    for (i, joint) in hinges.filter(|(_, joint)| joint.kind == JointKind::Hinge) {
        let units = [NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN];
        let parameters = [HingeStiffness(i), HingeDamping(i)];
        let starts = [joint.stiffness, joint.damping];
        list.damper(&joint.name, units, parameters, starts);
    }
    let springs = scene.loads.iter().enumerate();
    for (i, load) in springs.filter(|(_, load)| load.kind == LoadKind::SpringDamper) {
        let units = [NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE];
        let parameters = [SpringStiffness(i), SpringDamping(i)];
        let starts = [load.stiffness, load.damping];
        list.damper(&load.name, units, parameters, starts);
    }
    let ports = scene.ports.iter().enumerate();
    for (i, port) in ports.filter(|(_, port)| port.is_coupling()) {
        let units = [NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE];
        let parameters = [CouplingStiffness(i), CouplingDamping(i)];
        list.damper(
            &port.name,
            units,
            parameters,
            [port.stiffness, port.damping],
        );
        if port.turns() {
            #[rustfmt::skip] // a table
            let rows = [
                ("rotational_stiffness", "Rotational stiffness", Some(NEWTON_METRE_PER_RADIAN),
                    TurningStiffness(i), port.rotational_stiffness.unwrap_or(0.0)),
                ("rotational_damping", "Rotational damping", Some(NEWTON_METRE_SECOND_PER_RADIAN),
                    TurningDamping(i), port.rotational_damping.unwrap_or(0.0)),
            ];
            list.parameters(&port.name, "of", &rows);
        }
    }
}

impl List {
    fn parameter(
        &mut self,
        name: impl Into<String>,
        what: impl Into<String>,
        unit: Option<Unit>,
        parameter: Parameter,
        start: f64,
    ) {
        let source = Source::Parameter(parameter);
        self.add(name, what, unit, source, Some(start));
    }

    fn parameters(&mut self, of: &str, preposition: &str, rows: &[Row<'_>]) {
        for (key, what, unit, parameter, start) in rows {
            let name = format!("{of}.{key}");
            let what = format!("{what} {preposition} {of}");
            self.parameter(name, what, *unit, *parameter, *start);
        }
    }

    fn damper(
        &mut self,
        of: &str,
        units: [Unit; 2],
        parameters: [Parameter; 2],
        starts: [Option<f64>; 2],
    ) {
        let keys = [("stiffness", "Stiffness"), ("damping", "Damping")];
        for (i, (key, what)) in keys.into_iter().enumerate() {
            let start = starts[i].unwrap_or(0.0);
            let row = (key, what, Some(units[i]), parameters[i], start);
            self.parameters(of, "of", &[row]);
        }
    }
}
