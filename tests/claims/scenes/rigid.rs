//! Free rigid bodies and masses.

use serde_json::json;

use super::{cross, dot, extra, left, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![flight(), lumped(), plain(), disc()]
}

/// A body in free flight: mechanics of the rigid body at one instant.
fn flight() -> Specimen {
    let (m, j, angle, spin) = (2.0, 0.3, 0.5, 0.8);
    let (place, speed, g) = ([0.4, -0.7], [1.1, -0.6], [0.7, -9.0]);
    let scene = json!({
        "name": "flight", "dimension": 2, "gravity": g,
        "experiment": {"stop_time": 1.7, "step": 0.013},
        "accuracy": {"relative_tolerance": 3e-5},
        "bodies": [{"element": "rigid", "name": "plate", "mass": m, "inertia": j, "position": place,
                    "angle": angle, "motion": {"velocity": speed, "spin": spin},
                    "markers": {"p": [0.3, 0.2], "q": [-0.4, 0.1]}}],
        "outputs": [{"kind": "position", "marker": "plate.p"}, {"kind": "velocity", "marker": "plate.p"},
                    {"kind": "acceleration", "marker": "plate.p"},
                    {"kind": "direction", "marker": "plate.p"}, {"kind": "angle", "marker": "plate.p"},
                    {"kind": "angular_velocity", "marker": "plate.p"}, {"kind": "energy"},
                    {"kind": "momentum"}, {"kind": "center_of_mass"}]});
    let arm = turned(angle, [0.3, 0.2]);
    let kinetic = 0.5 * m * dot(speed, speed) + 0.5 * j * spin * spin;
    Specimen::new("flight", scene)
        .fact("fmiModelDescription/modelName", "flight")
        .fact("DefaultExperiment/stopTime", 1.7)
        .fact("DefaultExperiment/stepSize", 0.013)
        .fact("DefaultExperiment/tolerance", "3e-5")
        .vector("plate.p.position", "m", sum(place, arm))
        .vector(
            "plate.p.velocity",
            "m/s",
            sum(speed, times(spin, left(arm))),
        )
        .vector(
            "plate.p.acceleration",
            "m/s2",
            sum(g, times(-spin * spin, arm)),
        )
        .vector("plate.p.direction", "", turned(angle, [1.0, 0.0]))
        .claim("plate.p.angle", "rad", angle)
        .claim("plate.p.angular_velocity", "rad/s", spin)
        .claim("energy.kinetic", "J", kinetic)
        .claim("energy.gravity", "J", -m * dot(g, place))
        .vector("momentum", "N.s", times(m, speed))
        .claim(
            "angular_momentum",
            "N.m.s",
            m * cross(place, speed) + j * spin,
        )
        .vector("center_of_mass", "m", place)
}

/// Everything that may be left out is: no gravity, no rotation, no motion, the first experiment.
fn plain() -> Specimen {
    let scene = json!({
        "name": "plain", "dimension": 2,
        "bodies": [{"element": "rigid", "name": "plate", "mass": 2.0, "inertia": 0.3,
                    "position": [0.4, -0.7], "markers": {"p": [0.3, 0.2]}},
                   {"element": "rigid", "name": "puck", "mass": 1.0, "inertia": 0.1,
                    "position": [1.5, 0.3], "motion": {}, "markers": {"p": [0.1, 0.0]}}],
        "outputs": [{"kind": "position", "marker": "plate.p"}, {"kind": "velocity", "marker": "plate.p"},
                    {"kind": "acceleration", "marker": "plate.p"}, {"kind": "position", "marker": "puck.p"}]});
    Specimen::new("plain", scene)
        .fact("DefaultExperiment/stopTime", 1)
        .fact("DefaultExperiment/stepSize", 0.01)
        .fact("DefaultExperiment/tolerance", "1e-7")
        .vector("plate.p.position", "m", [0.7, -0.5])
        .vector("plate.p.velocity", "m/s", [0.0, 0.0])
        .vector("plate.p.acceleration", "m/s2", [0.0, 0.0])
        .at(0.5)
        .vector("plate.p.position", "m", [0.7, -0.5])
        .vector("puck.p.position", "m", [1.6, 0.3])
        .fact("method", "rk4")
}

/// A disc on a spring at its middle: nothing holds its rotation, which a body without inertia would not have.
fn disc() -> Specimen {
    let scene = json!({
        "name": "disc", "dimension": 2,
        "bodies": [{"element": "rigid", "name": "disc", "mass": 2.0, "inertia": 0.3,
                    "position": [0.4, -0.7], "markers": {"c": [0.0, 0.0]}}],
        "loads": [{"name": "spring", "kind": "spring_damper", "markers": ["ground", "disc.c"],
                   "point": [0.4, -0.7], "stiffness": 18.0, "length": 0.0}],
        "outputs": [{"kind": "natural_frequency", "count": 2}]});
    Specimen::new("disc", scene)
        .claim("natural_frequency[1]", "rad/s", 0.0)
        .claim("natural_frequency[2]", "rad/s", 3.0)
}

/// Masses on a cable that rotates about its first end, and on a rigid body.
fn lumped() -> Specimen {
    let (spin, length, line, mass, inertia, on_rigid) = (1.3, 0.8_f64, 1.5, 0.4, 0.07, 0.9);
    let scene = json!({
        "name": "lumped", "dimension": 2,
        "bodies": [
            {"element": "cable", "name": "rod", "elements": 2,
             "material": {"youngs_modulus": 1e6, "density": 1500.0},
             "section": {"area": 1e-3, "second_moment": 1e-6},
             "shape": {"line": {"from": [0.0, 0.0], "to": [length, 0.0]}},
             "motion": {"spin": spin}, "markers": {"tip": 1.0, "middle": 0.5}},
            {"element": "rigid", "name": "block", "mass": 1.1, "inertia": 0.2, "position": [0.2, 0.5],
             "motion": {"velocity": [0.3, 0.0], "spin": 0.6}, "markers": {"a": [0.3, 0.1], "b": [0.0, 0.2]}},
            extra()],
        "masses": [{"marker": "rod.tip", "mass": mass, "inertia": inertia},
                   {"marker": "block.a", "mass": on_rigid}],
        "outputs": [{"kind": "energy"}, {"kind": "momentum"}, {"kind": "center_of_mass"}]});
    let about_end = line * length.powi(3) / 3.0 + mass * length * length + inertia;
    let arm = [0.3, 0.1];
    let on_block = sum([0.3, 0.0], times(0.6, left(arm)));
    let at_block = sum([0.2, 0.5], arm);
    let rod = [0.0, spin * (line * length * 0.5 * length + mass * length)];
    let block = sum(times(1.1, [0.3, 0.0]), times(on_rigid, on_block));
    let other = times(0.7, [0.4, 0.9]);
    let kinetic = 0.5 * about_end * spin * spin
        + 0.5 * (1.1 * 0.09 + 0.2 * 0.36 + on_rigid * dot(on_block, on_block))
        + 0.5 * (0.7 * dot([0.4, 0.9], [0.4, 0.9]) + 0.2 * 0.36);
    let angular = about_end * spin
        + 1.1 * cross([0.2, 0.5], [0.3, 0.0])
        + 0.2 * 0.6
        + on_rigid * cross(at_block, on_block)
        + 0.7 * cross([3.1, -2.3], [0.4, 0.9])
        - 0.2 * 0.6;
    let total = line * length + mass + 1.1 + on_rigid + 0.7;
    let first = sum(
        [line * length * 0.5 * length + mass * length, 0.0],
        times(1.1, [0.2, 0.5]),
    );
    let first = sum(
        first,
        sum(times(on_rigid, at_block), times(0.7, [3.1, -2.3])),
    );
    Specimen::new("lumped", scene)
        .claim("energy.kinetic", "J", kinetic)
        .vector("momentum", "N.s", sum(sum(rod, block), other))
        .claim("angular_momentum", "N.m.s", angular)
        .vector("center_of_mass", "m", times(1.0 / total, first))
}
