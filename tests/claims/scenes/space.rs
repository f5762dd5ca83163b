//! Cables and particles in space.

use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::claims::specimen::Specimen;

pub fn array(v: Vector3<f64>) -> [f64; 3] {
    v.into()
}

/// All components of a vector.
pub fn vector(
    mut specimen: Specimen,
    of: &str,
    unit: &'static str,
    value: Vector3<f64>,
) -> Specimen {
    for (k, value) in value.iter().enumerate() {
        specimen = specimen.claim(&format!("{of}[{}]", k + 1), unit, *value);
    }
    specimen
}

pub fn all() -> Vec<Specimen> {
    vec![flight(), coupled(), cantilever()]
}

/// Particles and a cable that the master moves, pushes and couples.
fn coupled() -> Specimen {
    let (mass, gravity) = (0.8, Vector3::new(0.2, -0.6, -9.0));
    let (place, speed) = (Vector3::new(0.4, -0.3, 0.9), Vector3::new(0.5, 0.7, -0.2));
    let (push, line) = (Vector3::new(1.4, -0.9, 2.2), Vector3::new(0.8, 1.7, -0.6));
    let (driven, rate, second) = (
        place * 0.8,
        Vector3::new(0.1, -0.4, 0.6),
        Vector3::new(1.1, 0.6, -1.3),
    );
    let (stiffness, damping) = (35.0, 0.9);
    let particle = |name: &str| {
        json!({"element": "rigid", "name": name, "mass": mass, "position": array(place),
               "motion": {"velocity": array(speed)}, "markers": {"c": [0.0, 0.0, 0.0]}})
    };
    let rod = json!({"element": "cable", "name": "rod", "elements": 2,
        "material": {"youngs_modulus": 1e6, "density": 1250.0}, "section": {"area": 2e-3, "second_moment": 0.0},
        "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.6, 0.8, 1.0]}}, "markers": {"p": 0.3}});
    let read = |kind: &'static str, markers: &[&str]| -> Vec<Value> {
        let output = |marker: &&str| json!({"kind": kind, "marker": marker});
        markers.iter().map(output).collect()
    };
    let outputs = [
        read("acceleration", &["a.c", "d.c", "e.c", "rod.p"]),
        read("velocity", &["b.c", "e.c", "rod.p"]),
        read("position", &["b.c", "e.c"]),
    ];
    let scene = json!({"name": "coupled", "dimension": 3, "gravity": array(gravity),
        "bodies": [particle("a"), particle("b"), particle("d"), particle("e"), rod],
        "motions": [{"name": "lift", "kind": "position", "marker": "e.c", "value": {"input": 2}}],
        "inputs": [{"kind": "distributed_force", "body": "rod"}],
        "ports": [{"name": "hook", "marker": "a.c", "kind": "force"}, {"name": "grip", "marker": "b.c", "kind": "motion"},
                  {"name": "mount", "marker": "d.c", "kind": "motion", "stiffness": stiffness, "damping": damping}],
        "outputs": Value::from(outputs.concat())});
    let held = (place - driven) * stiffness + (speed - rate) * damping;
    let mut specimen = Specimen::new("coupled in space", scene);
    for (of, value) in [
        ("hook.force", push),
        ("mount.position", driven),
        ("mount.velocity", rate),
        ("grip.position", driven),
        ("grip.velocity", rate),
        ("grip.acceleration", second),
        ("lift.position", driven),
        ("lift.velocity", rate),
        ("lift.acceleration", second),
        ("rod.distributed_force", line),
    ] {
        for k in 0..3 {
            specimen = specimen.set(&format!("{of}[{}]", k + 1), value[k]);
        }
    }
    for (of, unit, value) in [
        ("a.c.acceleration", "m/s2", gravity + push / mass),
        ("grip.force", "N", (gravity - second) * mass),
        ("mount.force", "N", held),
        ("d.c.acceleration", "m/s2", gravity - held / mass),
        ("e.c.acceleration", "m/s2", second),
        ("rod.p.acceleration", "m/s2", gravity + line / 2.5),
        ("rod.p.velocity", "m/s", Vector3::zeros()),
        ("b.c.position", "m", driven),
        ("b.c.velocity", "m/s", rate),
        ("e.c.position", "m", driven),
        ("e.c.velocity", "m/s", rate),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    specimen
}

/// A stiff cantilever that a small force at its tip holds bent: the deflection changes its arm by less than 1e-8 of it.
fn cantilever() -> Specimen {
    let (from, way) = (Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.6, 0.48, 0.64));
    let force = Vector3::new(0.03, -0.02, 0.05);
    let scene = json!({"name": "cantilever", "dimension": 3, "initial": "static_equilibrium",
        "bodies": [{"element": "cable", "name": "beam", "elements": 4,
            "material": {"youngs_modulus": 1e9, "density": 1000.0}, "section": {"area": 1e-3, "second_moment": 1e-6},
            "shape": {"line": {"from": array(from), "to": array(from + way)}},
            "markers": {"root": 0.0, "middle": 0.5, "tip": 1.0}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "beam.tip", "value": array(force)}],
        "outputs": [{"kind": "connectivity_force", "marker": "beam.middle"},
                    {"kind": "bending_moment", "marker": "beam.middle"}, {"kind": "reaction", "joint": "clamp"},
                    {"kind": "reaction_moment", "joint": "clamp"}]});
    let mut specimen = Specimen::new("cantilever in space", scene);
    for (of, unit, value) in [
        ("beam.middle.connectivity_force", "N", -force),
        (
            "beam.middle.bending_moment",
            "N.m",
            (way * 0.5).cross(&force),
        ),
        ("clamp.reaction", "N", -force),
        ("clamp.reaction_moment", "N.m", -way.cross(&force)),
    ] {
        for k in 0..3 {
            specimen = specimen.claim_within(&format!("{of}[{}]", k + 1), unit, value[k], 1e-5);
        }
    }
    specimen
}

/// A cable and a particle that fly.
fn flight() -> Specimen {
    let (rho, area, mass) = (1300.0, 2e-3, 0.7);
    let gravity = Vector3::new(0.3, -0.5, -9.0);
    let (from, way) = (Vector3::new(0.1, 0.2, 0.3), Vector3::new(1.2, -0.4, 0.6));
    let (speed, spin) = (Vector3::new(0.4, -0.9, 0.2), Vector3::new(0.7, -0.3, 1.1));
    let (place, flight) = (Vector3::new(-1.0, 2.0, 0.5), Vector3::new(0.2, 0.1, -0.6));
    let pull = Vector3::new(1.5, -0.7, 0.9);
    let scene = json!({
        "name": "flight", "dimension": 3, "gravity": array(gravity),
        "bodies": [
            {"element": "cable", "name": "rod", "elements": 2,
             "material": {"youngs_modulus": 1e6, "density": rho}, "section": {"area": area, "second_moment": 0.0},
             "shape": {"line": {"from": array(from), "to": array(from + way)}},
             "motion": {"velocity": array(speed), "spin": array(spin), "deformation": ["0", "0.3*s", "0"]},
             "markers": {"first": 0.0, "p": 0.3}},
            {"element": "rigid", "name": "ball", "mass": mass, "position": array(place),
             "motion": {"velocity": array(flight)}, "markers": {"eye": [0.0, 0.0, 0.0]}}],
        "loads": [{"name": "pull", "kind": "force", "marker": "ball.eye", "value": array(pull)}],
        "outputs": [
            {"kind": "position", "marker": "rod.p"}, {"kind": "direction", "marker": "rod.p"},
            {"kind": "velocity", "marker": "rod.p"},
            {"kind": "velocity", "marker": "ball.eye"}, {"kind": "acceleration", "marker": "ball.eye"},
            {"kind": "momentum"}, {"kind": "center_of_mass"}, {"kind": "energy"}]});
    let rod = rho * area * way.norm();
    // Velocity of the rod is linear in the material coordinate.
    let change = spin.cross(&way) + Vector3::new(0.0, 0.3, 0.0);
    let momentum = (speed + change * 0.5) * rod + flight * mass;
    let turning = from.cross(&speed)
        + (from.cross(&change) + way.cross(&speed)) * 0.5
        + way.cross(&change) / 3.0;
    let square = speed.norm_squared() + speed.dot(&change) + change.norm_squared() / 3.0;
    let middle = ((from + way * 0.5) * rod + place * mass) / (rod + mass);
    let kinetic = 0.5 * (rod * square + mass * flight.norm_squared());
    let mut specimen = Specimen::new("flight in space", scene);
    for (of, unit, value) in [
        ("rod.p.position", "m", from + way * 0.3),
        ("rod.p.direction", "", way.normalize()),
        ("rod.p.velocity", "m/s", speed + change * 0.3),
        ("ball.eye.velocity", "m/s", flight),
        ("ball.eye.acceleration", "m/s2", gravity + pull / mass),
        ("momentum", "N.s", momentum),
        (
            "angular_momentum",
            "N.m.s",
            turning * rod + place.cross(&flight) * mass,
        ),
        ("center_of_mass", "m", middle),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    let fall = -(rod + mass) * gravity.dot(&middle);
    specimen
        .claim("energy.kinetic", "J", kinetic)
        .claim("energy.gravity", "J", fall)
        // A particle has a mass alone.
        .fact("variables", 40)
}
