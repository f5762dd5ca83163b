//! A cable and a particle that fly through space.

use nalgebra::Vector3;
use serde_json::json;

use crate::specimen::Specimen;

fn array(v: Vector3<f64>) -> [f64; 3] {
    v.into()
}

/// All components of a vector.
fn vector(mut specimen: Specimen, of: &str, unit: &'static str, value: Vector3<f64>) -> Specimen {
    for (k, value) in value.iter().enumerate() {
        specimen = specimen.claim(&format!("{of}[{}]", k + 1), unit, *value);
    }
    specimen
}

pub fn all() -> Vec<Specimen> {
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
    vec![
        specimen
            .claim("energy.kinetic", "J", kinetic)
            .claim("energy.gravity", "J", fall),
    ]
}
