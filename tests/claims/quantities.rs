//! Every output has a claim with its value: not zero, so that its sign shows, and of vectors with
//! components that differ, so that axes show. The list of kinds is the compiler's: a new one does not
//! compile before it stands here.

use std::collections::BTreeMap;

use flexbody::scene::Scene;
use flexbody::simulation::{Quantity, Simulation, Source};

use crate::scenes;
use crate::specimen::{Expected, Specimen};

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
    Position(_, 0) => "position x", Position(..) => "position y",
    Velocity(_, 0) => "velocity x", Velocity(..) => "velocity y",
    Acceleration(_, 0) => "acceleration x", Acceleration(..) => "acceleration y",
    Direction(_, 0) => "direction x", Direction(..) => "direction y",
    Orientation(..) => "orientation", Angle(_) => "angle", AngularVelocity(..) => "angular velocity", JointVelocity(_) => "joint velocity",
    AngularAcceleration(..) => "angular acceleration", JointAcceleration(_) => "joint acceleration",
    Strain(_) => "strain", Curvature(_) => "curvature", AxialForce(_) => "axial force",
    BendingMoment(..) => "bending moment",
    ConnectivityForce(_, 0) => "connectivity force x", ConnectivityForce(..) => "connectivity force y",
    Travel(_) => "travel", Reaction(_, 0) => "reaction x", Reaction(..) => "reaction y",
    ReactionMoment(..) => "reaction moment",
    MotionForce(_, 0) => "motion force x", MotionForce(..) => "motion force y",
    MotionMoment(_) => "motion moment",
    CouplingForce(_, 0) => "coupling force x", CouplingForce(..) => "coupling force y",
    CouplingMoment(_) => "coupling moment",
    KineticEnergy => "kinetic energy", StrainEnergy => "strain energy", GravityEnergy => "gravity energy",
    SpringEnergy => "spring energy", Input => "input", Dissipated => "dissipated",
    Momentum(0) => "momentum x", Momentum(_) => "momentum y", AngularMomentum(_) => "angular momentum",
    CenterOfMass(0) => "center of mass x", CenterOfMass(_) => "center of mass y",
    Resolution => "resolution", Residual(0) => "residual of positions", Residual(_) => "residual of velocities",
}

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
            let other = match name.strip_suffix("[1]") {
                Some(stem) => format!("{stem}[2]"),
                None => name.replace("[2]", "[1]"),
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
        .filter(|(_, told)| !**told)
        .map(|(label, _)| *label)
        .collect();
    println!("{} outputs", told.len());
    assert!(
        missing.is_empty(),
        "expected claims about {}",
        missing.join(", ")
    );
}
