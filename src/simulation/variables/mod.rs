//! The one list of variables that a scene gives rise to. A variable's index is its FMI value
//! reference; the XML, get and set, axis labels, the GUID and the documentation derive from it.

mod causality;
mod inputs;
mod outputs;
mod parameters;
#[cfg(test)]
mod tests;

pub use crate::scene::unit::Unit;
pub use causality::Causality;
pub(super) use outputs::sets_springs;
pub(super) use parameters::set_parameter;

use super::quantities::Quantity;
use crate::scene::unit::SECOND;
use crate::scene::{CouplingId, LineId, PlateId, ReducedId, Resolved, RigidId, Scene};

/// A scalar variable of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Structured name, e.g. `rod.tip.position[1]`.
    pub name: String,
    /// One sentence for a person.
    pub description: String,
    /// Unit, where the variable has one.
    pub unit: Option<Unit>,
    /// Object that the variable represents.
    pub source: Source,
    /// Start value of parameters and inputs, from the scene.
    pub start: Option<f64>,
    /// Whether the variable has direct feedthrough. An input acts at once if it is a load, and in the next step if it
    /// drives a motion. An output is direct if it depends at once on such inputs.
    pub is_direct: bool,
    /// Whether it is an input that sets the length of a spring or where one ends, and with it the energy
    /// in there.
    pub sets_length: bool,
    /// Coupling of an input, if the input is the motion of one.
    pub coupling: Option<CouplingId>,
    /// Part of an input in a prescribed motion, if it prescribes one.
    pub drive: Option<DrivePart>,
}

/// The part of an input in a prescribed motion. Motions are told apart by the input that gives their value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivePart {
    /// A coordinate or one of its derivatives.
    Coordinate {
        /// Place of the input with the value ([`Source::Input`]).
        first: usize,
        /// Order of the derivative: 0 for the value.
        order: usize,
    },
    /// A part of the quaternion of an orientation (order 0), or a component of its angular velocity (1) or acceleration (2).
    Orientation {
        /// Place of the input with the scalar part ([`Source::Input`]).
        first: usize,
        /// Order of the derivative.
        order: usize,
        /// Number of the part or component.
        component: usize,
    },
}

impl DrivePart {
    /// Place of the input that gives the value, or the scalar part of the quaternion.
    pub fn first(self) -> usize {
        match self {
            Self::Coordinate { first, .. } | Self::Orientation { first, .. } => first,
        }
    }

    /// Order of the derivative.
    pub fn order(self) -> usize {
        match self {
            Self::Coordinate { order, .. } | Self::Orientation { order, .. } => order,
        }
    }
}

/// Object that a variable represents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Simulated time.
    Time,
    /// Parameter that may be set until initialization ends.
    Parameter(Parameter),
    /// Input: its place among the numbers that the master sets ([`Resolved::numbers`]).
    Input(usize),
    /// Output computed from the state.
    Output(Quantity),
    /// Natural frequency about the initial configuration, lowest is 0.
    NaturalFrequency(usize),
    /// Eigenvalue about the initial state, slowest is 0: its decay rate (0) or frequency (1).
    Eigenvalue(usize, usize),
}

/// Parameters by name; masses, joints, loads and ports by their places in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Young's modulus of a cable.
    YoungsModulus(LineId),
    /// Density of a cable.
    LineLoad(LineId),
    /// Kelvin-Voigt damping time of a cable.
    DampingTime(LineId),
    /// Area of a cable's cross section.
    Area(LineId),
    /// Second moment of area of a cable's cross section.
    SecondMoment(LineId),
    /// Shear modulus of a rod.
    ShearModulus(LineId),
    /// Second moment of area of a rod's cross section, about its first axis (0) or its second (1).
    SecondMoments(LineId, usize),
    /// Torsion constant of a rod's cross section.
    TorsionConstant(LineId),
    /// Length of a cross section that is given by its shape, by its place among them.
    SectionLength(LineId, usize),
    /// Number of elements of a cable; the one integer variable.
    Elements(LineId),
    /// Damping ratio of the modes of a reduced body.
    DampingRatio(ReducedId),
    /// Young's modulus of a plate or shell.
    PatchModulus(PlateId),
    /// Poisson's ratio of a plate or shell.
    PatchRatio(PlateId),
    /// Density of a plate or shell.
    PatchDensity(PlateId),
    /// Kelvin-Voigt damping time of a plate or shell.
    PatchDamping(PlateId),
    /// Thickness of a plate or shell.
    PatchThickness(PlateId),
    /// Angle of the first axis of the section of a plate or shell.
    PatchAngle(PlateId),
    /// Mass of a rigid body.
    Mass(RigidId),
    /// Density of a rigid body that has a shape.
    SolidDensity(RigidId),
    /// Length of the shape of a rigid body, by its place among them.
    SolidLength(RigidId, usize),
    /// Moment of inertia of a rigid body.
    Inertia(RigidId, usize),
    /// Time at which a joint is released.
    ReleaseTime(usize),
    /// Mass lumped at a marker.
    LumpedMass(usize),
    /// Stiffness of the spring of a revolute joint.
    HingeStiffness(usize),
    /// Damping of the spring of a revolute joint.
    HingeDamping(usize),
    /// Number of a load: place among those that the load declares, and of several the axis.
    Load(usize, usize, usize),
    /// Stiffness of a coupling.
    CouplingStiffness(usize),
    /// Damping of a coupling.
    CouplingDamping(usize),
    /// Rotational stiffness of a coupling.
    RotationalStiffness(usize),
    /// Rotational damping of a coupling.
    RotationalDamping(usize),
    /// Component of gravity.
    Gravity(usize),
    /// Rate of the frame.
    Rotation(usize),
    /// Relative tolerance of the integrator.
    RelativeTolerance,
    /// Most work of one communication step.
    WorkLimit,
}

impl Variable {
    /// Whether the value is an integer; all others are real numbers.
    pub fn is_integer(&self) -> bool {
        matches!(self.source, Source::Parameter(Parameter::Elements(_)))
    }

    /// Whether it is an output that follows at once from this input (direct feedthrough). Energy follows
    /// from nothing but the lengths of springs, the force of a coupling from what comes in through it.
    pub fn depends_on(&self, input: &Self) -> bool {
        let Source::Output(quantity) = self.source else {
            return false;
        };
        let reaches = match quantity {
            Quantity::SpringEnergy | Quantity::Input => input.sets_length,
            Quantity::CouplingForce(place, _) | Quantity::CouplingMoment(place, _) => {
                input.coupling == Some(place)
            }
            _ => true,
        };
        self.is_direct && input.acts_at_once() && reaches
    }

    /// Whether it is an input that acts at once.
    pub fn acts_at_once(&self) -> bool {
        matches!(self.source, Source::Input(_)) && self.is_direct
    }
}

/// The variables of a scene: time, parameters, inputs, outputs, natural frequencies, eigenvalues.
///
/// # Panics
/// When the scene is not valid ([`Scene::resolved`]).
pub fn variables(scene: &Scene) -> Vec<Variable> {
    list(&scene.resolved())
}

/// The variables of a scene whose references are resolved.
pub(super) fn list(scene: &Resolved<'_>) -> Vec<Variable> {
    let mut list = List {
        variables: Vec::new(),
        dimension: scene.scene.dimension,
        sets_springs: sets_springs(scene),
    };
    list.add("time", "Simulated time", Some(SECOND), Source::Time, None);
    parameters::add(&mut list, scene);
    inputs::add(&mut list, scene);
    outputs::add(&mut list, scene);
    list.variables
}

/// Start values of all inputs, in the order of the system ([`Resolved::numbers`]).
pub(super) fn start_inputs(variables: &[Variable]) -> Vec<f64> {
    let places = variables
        .iter()
        .filter_map(|variable| match variable.source {
            Source::Input(place) => Some((place, variable.start.unwrap_or(0.0))),
            _ => None,
        });
    let mut starts: Vec<(usize, f64)> = places.collect();
    starts.sort_by_key(|(place, _)| *place);
    starts.into_iter().map(|(_, start)| start).collect()
}

/// Name of a component of a vector, counted from 0.
fn component(name: &str, axis: usize) -> String {
    format!("{name}[{}]", axis + 1)
}

const AXES: [&str; 3] = ["x", "y", "z"];
/// Components of a symmetric tensor.
const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];
/// Components of a tensor in a surface.
const SURFACE_COMPONENTS: [&str; 3] = ["11", "22", "12"];
/// Parts of a quaternion.
const PARTS: [&str; 4] = ["scalar part", "part x", "part y", "part z"];

/// Variables, how many components a vector has, and whether the master sets springs.
struct List {
    variables: Vec<Variable>,
    dimension: usize,
    sets_springs: bool,
}

impl List {
    fn add(
        &mut self,
        name: impl Into<String>,
        description: impl Into<String>,
        unit: Option<Unit>,
        source: Source,
        start: Option<f64>,
    ) {
        self.variables.push(Variable {
            name: name.into(),
            description: description.into(),
            unit,
            source,
            start,
            is_direct: false,
            sets_length: false,
            coupling: None,
            drive: None,
        });
    }

    /// Says of the last variable which part it has in a prescribed motion.
    fn mark_drive(&mut self, part: DrivePart) {
        if let Some(variable) = self.variables.last_mut() {
            variable.drive = Some(part);
        }
    }

    /// Inputs from this index on are direct.
    fn mark_direct(&mut self, first: usize) {
        for variable in &mut self.variables[first..] {
            variable.is_direct = true;
        }
    }
}
