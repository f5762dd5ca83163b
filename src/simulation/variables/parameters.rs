//! Parameters.

use super::{AXES, List, Parameter, Source, component};
use crate::math::space::spins;
use crate::scene::PatchThickness as Thickness;
use crate::scene::unit::*;
use crate::scene::{
    self, BodyReference, Cable, DampingRatio, Inertia, PatchBody, Plate, PortKind, Reduced,
    Resolved, Rigid, Scene,
};

/// Key, meaning, unit, what it stands for, start value.
type ParameterRow<'a> = (&'a str, &'a str, Option<Unit>, Parameter, f64);

/// Adds the parameters of a scene.
pub(super) fn add(list: &mut List, resolved: &Resolved<'_>) {
    for body in &resolved.bodies {
        match body {
            BodyReference::Cable(cable) => add_cable(list, cable, resolved.scene.dimension),
            BodyReference::Rigid(rigid) => add_rigid(list, rigid, resolved.scene.dimension),
            BodyReference::Reduced(reduced) => add_reduced(list, reduced),
            BodyReference::Plate(plate) => add_plate(list, plate),
        }
    }
    for (i, mass) in resolved.masses.iter().enumerate() {
        let what = "Mass lumped";
        let parameter = Parameter::LumpedMass(i);
        let row = ("mass", what, Some(KILOGRAM), parameter, mass.mass);
        list.parameters(mass.marker.name, "at", &[row]);
    }
    for joint in &resolved.joints {
        let i = joint.index;
        if let Some(time) = joint.release.and_then(|release| release.time) {
            let (what, parameter) = ("Time of the release", Parameter::ReleaseTime(i));
            let row = ("release_time", what, Some(SECOND), parameter, time);
            list.parameters(joint.name, "of", &[row]);
        }
    }
    add_dampers(list, resolved);
    let scene = resolved.scene;
    for axis in 0..scene.dimension {
        let what = format!("Gravitational acceleration, component {}", AXES[axis]);
        let (unit, parameter) = (Some(METRE_PER_SECOND_2), Parameter::Gravity(axis));
        let name = component("gravity", axis);
        list.parameter(name, what, unit, parameter, scene.gravity[axis]);
    }
    if scene.turns() {
        for axis in spins(scene.dimension) {
            let what =
                "Angular velocity of the frame that the scene is described in, about its origin";
            let (name, what) = match scene.dimension {
                2 => ("rotation".into(), what.into()),
                _ => (
                    component("rotation", axis),
                    format!("{what}, component {}", AXES[axis]),
                ),
            };
            let (unit, parameter) = (Some(RADIAN_PER_SECOND), Parameter::Rotation(axis));
            list.parameter(name, what, unit, parameter, scene.rotation.full()[axis]);
        }
    }
    let what = "Error in time that a step may make, relative to the size of the scene";
    let (parameter, start) = (Parameter::RelativeTolerance, scene.relative_tolerance());
    list.parameter("relative_tolerance", what, None, parameter, start);
    let what = "Most work of one communication step: evaluations times parts (elements, masses, constraints, \
                and four); a billion takes about a minute";
    let (parameter, start) = (Parameter::WorkLimit, scene.method.work_limit);
    list.parameter("work_limit", what, None, parameter, start);
}

fn add_cable(list: &mut List, cable: &Cable<'_>, dimension: usize) {
    use Parameter::*;
    let (i, body) = (cable.id, cable.body);
    let material = &body.material;
    let numbers = body.section.numbers();
    let elements = f64::from(body.elements.unwrap_or(1));
    #[rustfmt::skip] // a table
    let mut rows: Vec<ParameterRow<'_>> = vec![
        ("youngs_modulus", "Young's modulus", Some(PASCAL), YoungsModulus(i), material.young()),
        ("density", "Density", Some(DENSITY), LineLoad(i), material.density.unwrap_or_default()),
        ("damping_time", "Kelvin-Voigt damping time", Some(SECOND), DampingTime(i), material.damping_time),
        ("area", "Area of the cross section", Some(SQUARE_METRE), Area(i), numbers.area),
        ("second_moment", "Second moment of area", Some(METRE_4), SecondMoment(i), numbers.second_moments[0]),
        ("elements", "Number of elements", None, Elements(i), elements),
    ];
    let has_two_axes = body.is_rod() && dimension == 3;
    if has_two_axes {
        rows.retain(|(.., parameter, _)| !matches!(parameter, SecondMoment(_)));
    }
    if body.is_rod() {
        let modulus = material.shear_modulus.unwrap_or_default();
        rows.push((
            "shear_modulus",
            "Shear modulus",
            Some(PASCAL),
            ShearModulus(i),
            modulus,
        ));
    }
    if body.section.area.is_none() {
        rows.retain(|(.., parameter, _)| !matches!(parameter, Area(_) | SecondMoment(_)));
    } else if has_two_axes {
        add_numbers(list, cable);
    }
    if body.is_given() {
        // Moduli and density are in the matrices of the section.
        rows.retain(|(.., parameter, _)| matches!(parameter, DampingTime(_) | Elements(_)));
    }
    if dimension == 3 && !body.shape.is_straight() {
        // It has no frame to be curved in and no bending stiffness.
        rows.retain(|(.., parameter, _)| !matches!(parameter, SecondMoment(_)));
    }
    if cable.is_modal() {
        rows.retain(|(.., parameter, _)| !matches!(parameter, Elements(_)));
    }
    if cable.is_rigid() {
        // What is left without effect is none: a study of it would find nothing.
        rows.retain(|(.., parameter, _)| matches!(parameter, LineLoad(_) | Area(_)));
    }
    list.parameters(&body.name, "of", &rows);
    add_lengths(list, cable);
}

/// Second moments and torsion constant of a rod's section that is given by numbers.
fn add_numbers(list: &mut List, cable: &Cable<'_>) {
    let (i, name, numbers) = (cable.id, &cable.body.name, cable.body.section.numbers());
    for (k, moment) in numbers.second_moments.into_iter().enumerate() {
        let axis = ["first", "second"][k];
        let what = format!("Second moment of area about the {axis} axis of the section of {name}");
        let key = component(&format!("{name}.second_moments"), k);
        let parameter = Parameter::SecondMoments(i, k);
        list.parameter(key, what, Some(METRE_4), parameter, moment);
    }
    let (what, constant) = ("Torsion constant of the section", numbers.torsion_constant);
    let parameter = Parameter::TorsionConstant(i);
    let row = ("torsion_constant", what, Some(METRE_4), parameter, constant);
    list.parameters(name, "of", &[row]);
}

/// Lengths of a cross section that is given by its shape.
fn add_lengths(list: &mut List, cable: &Cable<'_>) {
    let Some(mut shape) = cable.body.section.shape.clone() else {
        return;
    };
    for (k, (key, what, length)) in shape.lengths().into_iter().enumerate() {
        let parameter = Parameter::SectionLength(cable.id, k);
        list.parameters(
            &cable.body.name,
            "of",
            &[(key, what, Some(METRE), parameter, *length)],
        );
    }
}

fn add_reduced(list: &mut List, reduced: &Reduced<'_>) {
    // Ratios in a table are no number.
    if let DampingRatio::Number(ratio) = reduced.body.damping_ratio {
        let parameter = Parameter::DampingRatio(reduced.id);
        let what = "Damping ratio of the modes";
        let row = ("damping_ratio", what, None, parameter, ratio);
        list.parameters(&reduced.body.name, "of", &[row]);
    }
}

/// Numbers of a plate or shell of one material, and of all the angle of its axes and the damping.
fn add_plate(list: &mut List, plate: &Plate<'_>) {
    use Parameter::*;
    let (i, body) = (plate.id, plate.body);
    let mut rows: Vec<ParameterRow<'_>> = Vec::new();
    let damping = "Kelvin-Voigt damping time";
    if let Some(material) = &body.material {
        #[rustfmt::skip] // a table
        rows.extend([
            ("youngs_modulus", "Young's modulus", Some(PASCAL), PatchModulus(i), material.youngs_modulus),
            ("poisson_ratio", "Poisson's ratio", None, PatchRatio(i), material.poisson_ratio),
            ("density", "Density", Some(DENSITY), PatchDensity(i), material.density),
            ("damping_time", damping, Some(SECOND), PatchDamping(i), material.damping_time),
        ]);
        if let Some(Thickness::Number(thickness)) = &body.thickness {
            rows.push((
                "thickness",
                "Thickness",
                Some(METRE),
                PatchThickness(i),
                *thickness,
            ));
        }
    } else {
        let time = body.damping_time.unwrap_or_default();
        rows.push(("damping_time", damping, Some(SECOND), PatchDamping(i), time));
        let what = "Angle of the first axis of the section";
        rows.push((
            "axis_angle",
            what,
            Some(RADIAN),
            PatchAngle(i),
            body.axis_angle,
        ));
    }
    list.parameters(&body.name, "of", &rows);
}

fn add_rigid(list: &mut List, rigid: &Rigid<'_>, dimension: usize) {
    let (i, body) = (rigid.id, rigid.body);
    if let Some(density) = body.density {
        let parameter = Parameter::SolidDensity(i);
        let row = ("density", "Density", Some(DENSITY), parameter, density);
        list.parameters(&body.name, "of", &[row]);
        return add_sizes(list, rigid);
    }
    let (parameter, mass) = (Parameter::Mass(i), body.mass());
    let row = ("mass", "Mass", Some(KILOGRAM), parameter, mass);
    list.parameters(&body.name, "of", &[row]);
    let about = "Moment of inertia about the centre of mass";
    if dimension == 2 {
        let (inertia, start) = (Parameter::Inertia(i, 0), body.inertia().number());
        let row = ("inertia", about, Some(INERTIA), inertia, start);
        list.parameters(&body.name, "of", &[row]);
    } else if body.inertia().is_some() {
        let tensor = body.inertia().tensor();
        for (axis, name) in AXES.iter().enumerate() {
            let what = format!("{about} of {} and the {name} axis of its frame", body.name);
            let parameter = Parameter::Inertia(i, axis);
            let key = component(&format!("{}.inertia", body.name), axis);
            list.parameter(key, what, Some(INERTIA), parameter, tensor[(axis, axis)]);
        }
    }
}

/// Lengths of a rigid body that is given by its shape.
fn add_sizes(list: &mut List, rigid: &Rigid<'_>) {
    let Some(mut shape) = rigid.body.shape else {
        return;
    };
    for (k, (key, place, length)) in shape.lengths().into_iter().enumerate() {
        let of = &rigid.body.name;
        let (key, what) = match (key, place) {
            (_, Some(axis)) => {
                let (key, name) = (component(key, axis), AXES[axis]);
                let what = format!("Length of the edge of {of} along the {name} axis of its frame");
                (key, what)
            }
            ("radius", _) => (key.into(), format!("Radius of {of}")),
            ("inner_radius", _) => (key.into(), format!("Radius of the hole in {of}")),
            _ => (key.into(), format!("Length of {of} along its axis")),
        };
        let parameter = Parameter::SolidLength(rigid.id, k);
        list.parameter(format!("{of}.{key}"), what, Some(METRE), parameter, *length);
    }
}

/// Numbers of loads, as these declare them.
fn add_loads(list: &mut List, resolved: &Resolved<'_>) {
    for (i, load) in resolved.loads.iter().enumerate() {
        let mut given = load.given.clone();
        let numbers = given.numbers(load.kind.place().extent()).into_iter();
        let numbers = numbers.enumerate();
        for (k, number) in numbers.filter(|(_, of)| load.kind.has_number(of.key, resolved)) {
            let of = load.name;
            for (axis, start) in number.value.get().into_iter().enumerate() {
                let (key, what) = (format!("{of}.{}", number.key), number.what);
                let (name, what) = if number.value.has_axes() {
                    let what = format!("{what} the {} axis of {of}", AXES[axis]);
                    (component(&key, axis), what)
                } else {
                    (key, format!("{what} of {of}"))
                };
                list.parameter(name, what, number.unit, Parameter::Load(i, k, axis), start);
            }
        }
    }
}

/// Stiffness and damping of hinges, loads and couplings.
fn add_dampers(list: &mut List, resolved: &Resolved<'_>) {
    use Parameter::*;
    for joint in &resolved.joints {
        let i = joint.index;
        if let Some(starts) = joint.spring() {
            let parameters = [HingeStiffness(i), HingeDamping(i)];
            list.damper(joint.name, spring_units(true), parameters, starts);
        }
    }
    add_loads(list, resolved);
    for (i, port) in resolved.ports.iter().enumerate() {
        let PortKind::Coupling { position, angle } = &port.kind else {
            continue;
        };
        let parameters = [CouplingStiffness(i), CouplingDamping(i)];
        let starts = [position.stiffness, position.damping];
        list.damper(port.name, spring_units(false), parameters, starts);
        if let Some(angle) = angle {
            #[rustfmt::skip] // a table
            let rows = [
                ("rotational_stiffness", "Rotational stiffness", Some(NEWTON_METRE_PER_RADIAN),
                    RotationalStiffness(i), angle.stiffness),
                ("rotational_damping", "Rotational damping", Some(NEWTON_METRE_SECOND_PER_RADIAN),
                    RotationalDamping(i), angle.damping),
            ];
            list.parameters(port.name, "of", &rows);
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

    fn parameters(&mut self, of: &str, preposition: &str, rows: &[ParameterRow<'_>]) {
        for (key, what, unit, parameter, start) in rows {
            let name = format!("{of}.{key}");
            let what = format!("{what} {preposition} {of}");
            self.parameter(name, what, *unit, *parameter, *start);
        }
    }

    fn damper(&mut self, of: &str, units: [Unit; 2], parameters: [Parameter; 2], starts: [f64; 2]) {
        let keys = [("stiffness", "Stiffness"), ("damping", "Damping")];
        for (i, (key, what)) in keys.into_iter().enumerate() {
            let row = (key, what, Some(units[i]), parameters[i], starts[i]);
            self.parameters(of, "of", &[row]);
        }
    }
}

/// Sets the number of an inertia, or its moment about an axis.
fn set_inertia(inertia: &mut Option<Inertia>, axis: usize, value: f64) {
    match inertia.get_or_insert_default() {
        Inertia::Number(number) => *number = value,
        Inertia::Moments(moments) => moments[axis] = value,
        Inertia::Tensor(rows) => rows[axis][axis] = value,
    }
}

/// Sets a number of the material of a plate or shell, or the damping of its section.
fn set_patch(body: &mut PatchBody, parameter: Parameter, value: f64) {
    use Parameter::*;
    match (parameter, &mut body.material) {
        (PatchModulus(_), Some(material)) => material.youngs_modulus = value,
        (PatchRatio(_), Some(material)) => material.poisson_ratio = value,
        (PatchDensity(_), Some(material)) => material.density = value,
        (PatchDamping(_), Some(material)) => material.damping_time = value,
        (PatchDamping(_), None) => body.damping_time = Some(value),
        (PatchThickness(_), _) => body.thickness = Some(Thickness::Number(value)),
        _ => body.axis_angle = value,
    }
}

/// Puts the value of a parameter into the scene that it came from.
pub(in crate::simulation) fn set_parameter(scene: &mut Scene, parameter: Parameter, value: f64) {
    use Parameter::*;
    match parameter {
        YoungsModulus(id) => scene.cable_mut(id).material.youngs_modulus = Some(value),
        LineLoad(id) => scene.cable_mut(id).material.density = Some(value),
        DampingTime(id) => scene.cable_mut(id).material.damping_time = value,
        Area(id) => scene.cable_mut(id).section.area = Some(value),
        SecondMoment(id) => scene.cable_mut(id).section.second_moment = Some(value),
        ShearModulus(id) => scene.cable_mut(id).material.shear_modulus = Some(value),
        SecondMoments(id, k) => {
            let moments = &mut scene.cable_mut(id).section.second_moments;
            moments.get_or_insert_default()[k] = value;
        }
        TorsionConstant(id) => scene.cable_mut(id).section.torsion_constant = Some(value),
        SectionLength(id, k) => {
            let shape = &mut scene.cable_mut(id).section.shape;
            if let Some((.., length)) = shape.iter_mut().flat_map(|s| s.lengths()).nth(k) {
                *length = value;
            }
        }
        Elements(id) => scene.cable_mut(id).elements = Some(value.max(0.0) as u32),
        DampingRatio(id) => {
            scene.reduced_mut(id).damping_ratio = scene::DampingRatio::Number(value);
        }
        PatchModulus(id) | PatchRatio(id) | PatchDensity(id) | PatchDamping(id)
        | PatchThickness(id) | PatchAngle(id) => {
            set_patch(scene.patch_mut(id), parameter, value);
        }
        Mass(id) => scene.rigid_mut(id).mass = Some(value),
        SolidDensity(id) => scene.rigid_mut(id).density = Some(value),
        SolidLength(id, k) => {
            let shape = &mut scene.rigid_mut(id).shape;
            if let Some((.., length)) = shape.iter_mut().flat_map(|s| s.lengths()).nth(k) {
                *length = value;
            }
        }
        Inertia(id, axis) => set_inertia(&mut scene.rigid_mut(id).inertia, axis, value),
        LumpedMass(i) => scene.masses[i].mass = value,
        ReleaseTime(i) => scene.joints[i].release_time = Some(value),
        HingeStiffness(i) => scene.revolute_mut(i).stiffness = Some(value),
        HingeDamping(i) => scene.revolute_mut(i).damping = Some(value),
        Load(i, number, axis) => scene.set_load_number(i, number, axis, value),
        CouplingStiffness(i) => scene.motion_port_mut(i).stiffness = Some(value),
        CouplingDamping(i) => scene.motion_port_mut(i).damping = Some(value),
        RotationalStiffness(i) => scene.motion_port_mut(i).rotational_stiffness = Some(value),
        RotationalDamping(i) => scene.motion_port_mut(i).rotational_damping = Some(value),
        Gravity(axis) => scene.gravity[axis] = value,
        Rotation(axis) => scene.rotation.set(axis, value),
        RelativeTolerance => scene.set_relative_tolerance(value),
        WorkLimit => scene.method.work_limit = value,
    }
}
