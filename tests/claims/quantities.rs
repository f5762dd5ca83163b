//! Every output has a claim with its value: not zero, so that its sign shows, and of vectors with
//! components that differ, so that axes show. The list of kinds is the compiler's: a new one does not
//! compile before it stands here.

use std::collections::BTreeMap;

use flexbody::scene::{Along, Scene};
use flexbody::simulation::{Quantity, Simulation, Source};

use crate::claims::scenes;
use crate::claims::specimen::{Expected, Specimen};

/// Names all variants of an enumeration by patterns.
macro_rules! named {
    ($function:ident, $list:ident, $of:ty: $($pattern:pat => $name:literal,)*) => {
        const $list: &[&str] = &[$($name),*];
        fn $function(of: $of) -> &'static str {
            use Quantity::*;
            match of {
                $($pattern => $name,)*
            }
        }
    };
}

named! { label, LABELS, Quantity:
    Position(_, 0) => "position x", Position(_, 1) => "position y", Position(..) => "position z",
    Deflection(_, None, 0) => "deflection x", Deflection(_, None, 1) => "deflection y", Deflection(_, None, _) => "deflection z",
    Deflection(_, _, 0) => "deflection x from a marker", Deflection(_, _, 1) => "deflection y from a marker", Deflection(..) => "deflection z from a marker",
    Velocity(_, 0) => "velocity x", Velocity(_, 1) => "velocity y", Velocity(..) => "velocity z",
    Acceleration(_, 0) => "acceleration x", Acceleration(_, 1) => "acceleration y", Acceleration(..) => "acceleration z",
    Direction(_, 0) => "direction x", Direction(_, 1) => "direction y", Direction(..) => "direction z",
    Quaternion(_, 0) => "quaternion w", Quaternion(_, 1) => "quaternion x", Quaternion(_, 2) => "quaternion y", Quaternion(..) => "quaternion z",
    RotationVector(_, 0) => "rotation vector x", RotationVector(_, 1) => "rotation vector y", RotationVector(..) => "rotation vector z",
    Orientation(..) => "orientation", Angle(_) => "angle",
    AngularVelocity(_, 0, Along::Global) => "angular velocity x", AngularVelocity(_, 1, Along::Global) => "angular velocity y", AngularVelocity(_, _, Along::Global) => "angular velocity",
    AngularVelocity(_, 0, Along::Body) => "angular velocity x along the body", AngularVelocity(_, 1, Along::Body) => "angular velocity y along the body", AngularVelocity(_, _, Along::Body) => "angular velocity along the body",
     JointVelocity(_) => "joint velocity",
    AngularAcceleration(_, 0, Along::Global) => "angular acceleration x", AngularAcceleration(_, 1, Along::Global) => "angular acceleration y", AngularAcceleration(_, _, Along::Global) => "angular acceleration",
    AngularAcceleration(_, 0, Along::Body) => "angular acceleration x along the body", AngularAcceleration(_, 1, Along::Body) => "angular acceleration y along the body", AngularAcceleration(_, _, Along::Body) => "angular acceleration along the body", JointAcceleration(_) => "joint acceleration",
    Strain(_) => "strain", Curvature(_) => "curvature", AxialForce(_) => "axial force", Torque(_) => "torque", Stress(_) => "stress", TorsionStress(_) => "torsion stress", StressTensor(..) => "stress tensor", VonMisesStress(_) => "von Mises stress",
    MembraneStrain(..) => "membrane strain", SurfaceCurvature(..) => "curvature of a surface", MembraneForce(..) => "membrane force", SurfaceMoment(..) => "moment of a surface",
    LayerStress(..) => "stress of a layer", LayerVonMises(_) => "von Mises stress of a layer",
    BendingMoment(_, 0) => "bending moment x", BendingMoment(_, 1) => "bending moment y", BendingMoment(..) => "bending moment",
    ConnectivityForce(_, 0) => "connectivity force x", ConnectivityForce(_, 1) => "connectivity force y", ConnectivityForce(..) => "connectivity force z",
    Displacement(_) => "displacement", SlidingVelocity(_) => "sliding velocity", SlidingAcceleration(_) => "sliding acceleration",
    GearForce(_) => "gear force", GearTorque(_) => "gear torque", LatchState(_) => "latch state",
    Tension(_) => "tension", Length(_) => "length", LengthRate(_) => "rate of a length", LoadForce(_, 0) => "load force x", LoadForce(_, 1) => "load force y", LoadForce(..) => "load force z",
    FrictionForce(_, 0) => "friction force x", FrictionForce(_, 1) => "friction force y", FrictionForce(..) => "friction force z",
    FrictionMoment(_, 0) => "friction moment x", FrictionMoment(_, 1) => "friction moment y", FrictionMoment(..) => "friction moment",
    LoadMoment(_, 0) => "load moment x", LoadMoment(_, 1) => "load moment y", LoadMoment(..) => "load moment",
    Travel(_) => "travel", Reaction(_, 0, Along::Global) => "reaction x", Reaction(_, 1, Along::Global) => "reaction y", Reaction(_, _, Along::Global) => "reaction z",
    Reaction(_, 0, Along::Body) => "reaction x along the body", Reaction(_, 1, Along::Body) => "reaction y along the body", Reaction(_, _, Along::Body) => "reaction z along the body",
    ReactionMoment(_, 0, Along::Global) => "reaction moment x", ReactionMoment(_, 1, Along::Global) => "reaction moment y", ReactionMoment(_, _, Along::Global) => "reaction moment",
    ReactionMoment(_, 0, Along::Body) => "reaction moment x along the body", ReactionMoment(_, 1, Along::Body) => "reaction moment y along the body", ReactionMoment(_, _, Along::Body) => "reaction moment along the body",
    MotionForce(_, 0) => "motion force x", MotionForce(_, 1) => "motion force y", MotionForce(..) => "motion force z",
    MotionMoment(..) => "motion moment",
    CouplingForce(_, 0) => "coupling force x", CouplingForce(_, 1) => "coupling force y", CouplingForce(..) => "coupling force z",
    CouplingMoment(_, 0) => "coupling moment x", CouplingMoment(_, 1) => "coupling moment y", CouplingMoment(..) => "coupling moment",
    KineticEnergy => "kinetic energy", StrainEnergy => "strain energy", GravityEnergy => "gravity energy",
    SpringEnergy => "spring energy", Input => "input", Dissipated => "dissipated",
    Momentum(0) => "momentum x", Momentum(1) => "momentum y", Momentum(_) => "momentum z", AngularMomentum(0) => "angular momentum x", AngularMomentum(1) => "angular momentum y", AngularMomentum(_) => "angular momentum",
    CenterOfMass(0) => "center of mass x", CenterOfMass(1) => "center of mass y", CenterOfMass(_) => "center of mass z",
    Resolution => "resolution", Residual(0) => "residual of positions", Residual(_) => "residual of velocities",
}

/// Outputs of what needs a file, which have their claims in `reduced.rs`.
const OF_FILES: [&str; 2] = ["stress tensor", "von Mises stress"];

/// Outputs of plates and shells, which have their claims in `tests/laws/plate_sections.rs`.
const OF_SURFACES: [&str; 6] = [
    "membrane strain",
    "curvature of a surface",
    "membrane force",
    "moment of a surface",
    "stress of a layer",
    "von Mises stress of a layer",
];

/// Outputs that are zero where all is well: their claim is that they are, to roundoff.
const ZERO: [&str; 2] = ["residual of positions", "residual of velocities"];

/// Quantities of a specimen's variables by their names.
fn quantities(specimen: &Specimen) -> BTreeMap<String, Quantity> {
    let scene = Scene::from_json(&specimen.scene.to_string()).expect("a scene");
    let simulation = Simulation::new(scene);
    let variables = simulation.variables().iter();
    let found = variables.filter_map(|variable| match variable.source {
        Source::Output(quantity) => Some((variable.name.clone(), quantity)),
        _ => None,
    });
    found.collect()
}

/// Whether a claim tells a value from its opposite.
fn tells(value: f64, within: f64) -> bool {
    value.abs() > 10.0 * within
}

#[test]
fn every_output_has_a_claim_that_tells_sign_and_axis() {
    let mut told: BTreeMap<&str, bool> = LABELS.iter().map(|label| (*label, false)).collect();
    for specimen in scenes::all() {
        let quantities = quantities(&specimen);
        let value = |name: &str| {
            let claims = specimen.claims.iter().filter(|claim| claim.of == name);
            let numbers = claims.filter_map(|claim| match claim.expected {
                Expected::Number { value, within } => Some((value, within)),
                Expected::Text(_) => None,
            });
            numbers.collect::<Vec<_>>()
        };
        for (name, quantity) in &quantities {
            // The first component beside the second, others beside the first.
            let other = match name.split_once('[') {
                Some((stem, "1]")) => format!("{stem}[2]"),
                Some((stem, _)) => format!("{stem}[1]"),
                None => name.clone(),
            };
            let (mine, others) = (value(name), value(&other));
            let label = label(*quantity);
            let is_told = mine.iter().any(|(a, within)| {
                // Of a scalar the other is itself.
                let axis = other == *name || others.iter().any(|(b, _)| tells(a - b, *within));
                (tells(*a, *within) && axis) || (ZERO.contains(&label) && *within <= 1e-9)
            });
            *told.entry(label).or_default() |= is_told;
        }
    }
    let missing: Vec<&str> = told
        .iter()
        .filter(|(label, told)| {
            !**told && !OF_FILES.contains(label) && !OF_SURFACES.contains(label)
        })
        .map(|(label, _)| *label)
        .collect();
    println!("{} outputs", told.len());
    assert!(
        missing.is_empty(),
        "expected claims about {}",
        missing.join(", ")
    );
}
