//! The one list of variables that a scene gives rise to. A variable's index is its FMI value
//! reference; the XML, get and set, axis labels, the GUID and the documentation derive from it.

use crate::scene::{Body, Input, InputKind, Output, OutputKind, Scene};

/// A scalar variable of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Structured name, e.g. `rod.tip.position[1]`.
    pub name: String,
    /// One sentence for a person.
    pub description: String,
    /// Unit, where the variable has one.
    pub unit: Option<Unit>,
    /// What it stands for; everything else about it follows from this.
    pub source: Source,
    /// Start value of parameters and inputs, from the scene.
    pub start: Option<f64>,
}

/// What a variable stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Simulated time.
    Time,
    /// Parameter that may be set until initialization ends.
    Parameter(Parameter),
    /// Component of an input: index into `scene.inputs`, component.
    Input(usize, usize),
    /// Output computed from the state.
    Output(Quantity),
    /// Natural frequency about the initial configuration, lowest is 0.
    NaturalFrequency(usize),
}

/// Parameters by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Young's modulus of a body.
    YoungsModulus(usize),
    /// Density of a body.
    Density(usize),
    /// Kelvin-Voigt damping time of a body.
    DampingTime(usize),
    /// Area of a body's cross section.
    Area(usize),
    /// Second moment of area of a body's cross section.
    SecondMoment(usize),
    /// Number of elements of a body; the one integer variable.
    Elements(usize),
    /// Component of gravity.
    Gravity(usize),
    /// Relative tolerance of the integrator.
    RelativeTolerance,
}

/// Outputs; markers by material coordinate, joints by index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// Component of the position of a marker.
    Position(f64, usize),
    /// Component of the velocity of a marker.
    Velocity(f64, usize),
    /// Component of the acceleration of a marker.
    Acceleration(f64, usize),
    /// Continuous angle of the slope at a marker; the second is its place among the angles.
    Angle(f64, usize),
    /// Angular velocity of the slope at a marker.
    AngularVelocity(f64),
    /// Axial strain at a marker.
    Strain(f64),
    /// Curvature at a marker.
    Curvature(f64),
    /// Component of a joint's reaction force.
    Reaction(usize, usize),
    /// A joint's reaction moment.
    ReactionMoment(usize),
    /// Kinetic energy.
    KineticEnergy,
    /// Strain energy.
    StrainEnergy,
    /// Potential energy of gravity, zero at the origin.
    GravityEnergy,
}

/// A unit: its name and exponents of the SI base units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Name as written in the model description.
    pub name: &'static str,
    /// Exponents of kg, m, s and rad.
    pub exponents: [i32; 4],
}

const fn unit(name: &'static str, kg: i32, m: i32, s: i32, rad: i32) -> Unit {
    Unit {
        name,
        exponents: [kg, m, s, rad],
    }
}

const SECOND: Unit = unit("s", 0, 0, 1, 0);
const METRE: Unit = unit("m", 0, 1, 0, 0);
const SQUARE_METRE: Unit = unit("m2", 0, 2, 0, 0);
const METRE_4: Unit = unit("m4", 0, 4, 0, 0);
const PER_METRE: Unit = unit("1/m", 0, -1, 0, 0);
const METRE_PER_SECOND: Unit = unit("m/s", 0, 1, -1, 0);
const METRE_PER_SECOND_2: Unit = unit("m/s2", 0, 1, -2, 0);
const RADIAN: Unit = unit("rad", 0, 0, 0, 1);
const RADIAN_PER_SECOND: Unit = unit("rad/s", 0, 0, -1, 1);
const PASCAL: Unit = unit("Pa", 1, -1, -2, 0);
const DENSITY: Unit = unit("kg/m3", 1, -3, 0, 0);
const NEWTON: Unit = unit("N", 1, 1, -2, 0);
const NEWTON_METRE: Unit = unit("N.m", 1, 2, -2, 0);
const JOULE: Unit = unit("J", 1, 2, -2, 0);

impl Variable {
    /// Whether the value is an integer; all others are real numbers.
    pub fn is_integer(&self) -> bool {
        matches!(self.source, Source::Parameter(Parameter::Elements(_)))
    }

    /// Whether the value of an output follows at once from the inputs (direct feedthrough).
    pub fn depends_on_inputs(&self) -> bool {
        matches!(
            self.source,
            Source::Output(
                Quantity::Acceleration(..) | Quantity::Reaction(..) | Quantity::ReactionMoment(_)
            )
        )
    }
}

/// The variables of a scene: time, parameters, inputs, outputs, natural frequencies.
///
/// The scene must be valid.
pub fn variables(scene: &Scene) -> Vec<Variable> {
    let mut list = List(Vec::new());
    list.add("time", "Simulated time", Some(SECOND), Source::Time, None);
    add_parameters(&mut list, scene);
    for (index, input) in scene.inputs.iter().enumerate() {
        add_input(&mut list, index, input);
    }
    let mut angles = 0;
    for output in &scene.outputs {
        add_output(&mut list, scene, output, &mut angles);
    }
    list.0
}

struct List(Vec<Variable>);

impl List {
    fn add(
        &mut self,
        name: impl Into<String>,
        description: impl Into<String>,
        unit: Option<Unit>,
        source: Source,
        start: Option<f64>,
    ) {
        self.0.push(Variable {
            name: name.into(),
            description: description.into(),
            unit,
            source,
            start,
        });
    }

    fn parameter(
        &mut self,
        name: String,
        what: String,
        unit: Option<Unit>,
        p: Parameter,
        start: f64,
    ) {
        self.add(name, what, unit, Source::Parameter(p), Some(start));
    }

    /// The two components of a vector output.
    fn vector(&mut self, name: &str, what: &str, unit: Unit, quantity: impl Fn(usize) -> Quantity) {
        for axis in 0..2 {
            let source = Source::Output(quantity(axis));
            let description = format!("{what}, component {}", ["x", "y"][axis]);
            self.add(
                format!("{name}[{}]", axis + 1),
                description,
                Some(unit),
                source,
                None,
            );
        }
    }

    fn scalar(&mut self, name: &str, what: &str, unit: Option<Unit>, quantity: Quantity) {
        self.add(name, what, unit, Source::Output(quantity), None);
    }
}

fn add_parameters(list: &mut List, scene: &Scene) {
    for (i, body) in scene.bodies.iter().enumerate() {
        add_body_parameters(list, i, body);
    }
    for axis in 0..2 {
        let what = format!("Gravitational acceleration, component {}", ["x", "y"][axis]);
        let unit = Some(METRE_PER_SECOND_2);
        list.parameter(
            format!("gravity[{}]", axis + 1),
            what,
            unit,
            Parameter::Gravity(axis),
            scene.gravity[axis],
        );
    }
    let what = "Error in time that a step may make, relative to the length of the body".into();
    let start = scene.accuracy.relative_tolerance;
    list.parameter(
        "relative_tolerance".into(),
        what,
        None,
        Parameter::RelativeTolerance,
        start,
    );
}

fn add_body_parameters(list: &mut List, i: usize, body: &Body) {
    use Parameter::*;
    let (material, section) = (&body.material, &body.section);
    let elements = f64::from(body.elements);
    for (key, what, unit, parameter, start) in [
        (
            "youngs_modulus",
            "Young's modulus",
            Some(PASCAL),
            YoungsModulus(i),
            material.youngs_modulus,
        ),
        (
            "density",
            "Density",
            Some(DENSITY),
            Density(i),
            material.density,
        ),
        (
            "damping_time",
            "Kelvin-Voigt damping time",
            Some(SECOND),
            DampingTime(i),
            material.damping_time,
        ),
        (
            "area",
            "Area of the cross section",
            Some(SQUARE_METRE),
            Area(i),
            section.area,
        ),
        (
            "second_moment",
            "Second moment of area",
            Some(METRE_4),
            SecondMoment(i),
            section.second_moment,
        ),
        (
            "elements",
            "Number of elements",
            None,
            Elements(i),
            elements,
        ),
    ] {
        let (name, what) = (
            format!("{}.{key}", body.name),
            format!("{what} of {}", body.name),
        );
        list.parameter(name, what, unit, parameter, start);
    }
}

fn add_input(list: &mut List, index: usize, input: &Input) {
    let marker = &input.marker;
    for component in 0..input.components() {
        let (name, what, unit) = match input.kind {
            InputKind::Force => (
                format!("{marker}.force[{}]", component + 1),
                format!("Force on {marker}, component {}", ["x", "y"][component]),
                NEWTON,
            ),
            InputKind::Moment => (
                format!("{marker}.moment"),
                format!("Moment on {marker}, counter-clockwise"),
                NEWTON_METRE,
            ),
        };
        let start = input.start.get(component).copied().unwrap_or(0.0);
        list.add(
            name,
            what,
            Some(unit),
            Source::Input(index, component),
            Some(start),
        );
    }
}

fn add_output(list: &mut List, scene: &Scene, output: &Output, angles: &mut usize) {
    match output.kind {
        OutputKind::Position
        | OutputKind::Velocity
        | OutputKind::Acceleration
        | OutputKind::Angle
        | OutputKind::AngularVelocity
        | OutputKind::Strain
        | OutputKind::Curvature => add_marker_output(list, scene, output, angles),
        OutputKind::Reaction | OutputKind::ReactionMoment => add_joint_output(list, scene, output),
        OutputKind::Energy => add_energies(list),
        OutputKind::NaturalFrequency => add_frequencies(list, output),
    }
}

fn add_marker_output(list: &mut List, scene: &Scene, output: &Output, angles: &mut usize) {
    let marker = output.marker.as_deref().unwrap_or_default();
    let at = scene.marker(marker).map_or(0.0, |marker| marker.coordinate);
    match output.kind {
        OutputKind::Position => list.vector(
            &format!("{marker}.position"),
            &format!("Position of {marker}"),
            METRE,
            |axis| Quantity::Position(at, axis),
        ),
        OutputKind::Velocity => list.vector(
            &format!("{marker}.velocity"),
            &format!("Velocity of {marker}"),
            METRE_PER_SECOND,
            |axis| Quantity::Velocity(at, axis),
        ),
        OutputKind::Acceleration => list.vector(
            &format!("{marker}.acceleration"),
            &format!("Acceleration of {marker}"),
            METRE_PER_SECOND_2,
            |axis| Quantity::Acceleration(at, axis),
        ),
        OutputKind::Angle => {
            list.scalar(
                &format!("{marker}.angle"),
                &format!("Direction of the slope at {marker}, counted on over full turns"),
                Some(RADIAN),
                Quantity::Angle(at, *angles),
            );
            *angles += 1;
        }
        OutputKind::AngularVelocity => list.scalar(
            &format!("{marker}.angular_velocity"),
            &format!("Angular velocity of the slope at {marker}"),
            Some(RADIAN_PER_SECOND),
            Quantity::AngularVelocity(at),
        ),
        OutputKind::Strain => list.scalar(
            &format!("{marker}.strain"),
            &format!("Axial strain at {marker}"),
            None,
            Quantity::Strain(at),
        ),
        OutputKind::Curvature => list.scalar(
            &format!("{marker}.curvature"),
            &format!("Curvature at {marker}"),
            Some(PER_METRE),
            Quantity::Curvature(at),
        ),
        OutputKind::Reaction
        | OutputKind::ReactionMoment
        | OutputKind::Energy
        | OutputKind::NaturalFrequency => {}
    }
}

fn add_joint_output(list: &mut List, scene: &Scene, output: &Output) {
    let name = output.joint.as_deref().unwrap_or_default();
    let joint = scene
        .joints
        .iter()
        .position(|j| j.name == name)
        .unwrap_or(0);
    if output.kind == OutputKind::Reaction {
        list.vector(
            &format!("{name}.reaction"),
            &format!("Force of {name} on its second marker"),
            NEWTON,
            |axis| Quantity::Reaction(joint, axis),
        );
    } else {
        list.scalar(
            &format!("{name}.reaction_moment"),
            &format!("Moment of {name} on its second marker"),
            Some(NEWTON_METRE),
            Quantity::ReactionMoment(joint),
        );
    }
}

fn add_energies(list: &mut List) {
    list.scalar(
        "energy.kinetic",
        "Kinetic energy",
        Some(JOULE),
        Quantity::KineticEnergy,
    );
    list.scalar(
        "energy.strain",
        "Strain energy",
        Some(JOULE),
        Quantity::StrainEnergy,
    );
    list.scalar(
        "energy.gravity",
        "Potential energy of gravity, zero at the origin",
        Some(JOULE),
        Quantity::GravityEnergy,
    );
}

fn add_frequencies(list: &mut List, output: &Output) {
    let body = output.body.as_deref().unwrap_or_default();
    for number in 0..output.count.unwrap_or(0) as usize {
        let what = format!(
            "Natural frequency {} about the initial configuration; an unstable one is negative",
            number + 1
        );
        list.add(
            format!("{body}.natural_frequency[{}]", number + 1),
            what,
            Some(RADIAN_PER_SECOND),
            Source::NaturalFrequency(number),
            None,
        );
    }
}
