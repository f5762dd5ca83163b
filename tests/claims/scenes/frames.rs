//! Frames that rotate, and geometry of cables in free flight.

use nalgebra::Vector3;
use serde_json::json;

use super::space::{array, vector};
use super::{cross, dot, left, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![turning(), turning_in_space(), line(), arc()]
}

/// A particle in a rotating frame: Coriolis and centrifugal force.
fn turning() -> Specimen {
    let (m, rate, place, speed, g) = (1.7, 0.9, [0.6, -0.4], [0.5, 1.2], [0.3, -2.0]);
    let scene = json!({
        "name": "turning", "dimension": 2, "gravity": g, "rotation": rate,
        "bodies": [{"element": "rigid", "name": "bead", "mass": m, "inertia": 0.0, "position": place,
                    "motion": {"velocity": speed}, "markers": {"c": [0.0, 0.0]}}],
        "outputs": [{"kind": "acceleration", "marker": "bead.c"}, {"kind": "energy"}]});
    let inertial = sum(times(rate * rate, place), times(-2.0 * rate, left(speed)));
    let potential = -m * dot(g, place) - 0.5 * m * rate * rate * dot(place, place);
    Specimen::new("turning", scene)
        .vector("bead.c.acceleration", "m/s2", sum(g, inertial))
        .claim("energy.kinetic", "J", 0.5 * m * dot(speed, speed))
        .claim("energy.gravity", "J", potential)
}

/// A particle in a frame that rotates about an axis of space.
fn turning_in_space() -> Specimen {
    let (m, rate, place) = (1.7, [0.4, -0.7, 0.9], [0.6, -0.4, 0.8]);
    let [w, r, v, g] = [rate, place, [0.5, 1.2, -0.3], [0.3, -2.0, -8.0]].map(Vector3::from);
    let scene = json!({
        "name": "turning_in_space", "dimension": 3, "gravity": array(g), "rotation": rate,
        "bodies": [{"element": "rigid", "name": "bead", "mass": m, "position": place,
                    "motion": {"velocity": array(v)}, "markers": {"c": [0.0, 0.0, 0.0]}}],
        "outputs": [{"kind": "acceleration", "marker": "bead.c"}, {"kind": "energy"}]});
    let acceleration = g - w.cross(&v) * 2.0 - w.cross(&w.cross(&r));
    let potential = -m * g.dot(&r) - 0.5 * m * w.cross(&r).norm_squared();
    vector(
        Specimen::new("turning in space", scene),
        "bead.c.acceleration",
        "m/s2",
        acceleration,
    )
    .claim("energy.kinetic", "J", 0.5 * m * v.norm_squared())
    .claim("energy.gravity", "J", potential)
}

/// A straight cable in free flight that rotates.
fn line() -> Specimen {
    let (rho, area, spin, speed) = (1300.0, 2e-3, 0.7, [0.4, -0.9]);
    let (from, to) = ([0.2, 0.1], [0.8, 0.9]);
    let scene = json!({
        "name": "line", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rod", "elements": 2,
                    "material": {"youngs_modulus": 1e6, "density": rho},
                    "section": {"area": area, "second_moment": 1e-7},
                    "shape": {"line": {"from": from, "to": to}},
                    "motion": {"velocity": speed, "spin": spin}, "markers": {"p": 0.3, "q": 0.8}}],
        "outputs": [{"kind": "position", "marker": "rod.p"}, {"kind": "velocity", "marker": "rod.p"},
                    {"kind": "direction", "marker": "rod.p"}, {"kind": "angle", "marker": "rod.p"},
                    {"kind": "angular_velocity", "marker": "rod.p"},
                    {"kind": "momentum"}, {"kind": "center_of_mass"}, {"kind": "energy"}]});
    let (way, length) = ([0.6, 0.8], 1.0);
    let middle = sum(from, times(0.5, way));
    let (mass, mean) = (
        rho * area * length,
        sum(speed, times(0.5 * spin, left(way))),
    );
    let about = mass * length * length / 12.0;
    Specimen::new("line", scene)
        .fact("DefaultExperiment/tolerance", "0.0001")
        .vector("rod.p.position", "m", sum(from, times(0.3, way)))
        .vector(
            "rod.p.velocity",
            "m/s",
            sum(speed, times(0.3 * spin, left(way))),
        )
        .vector("rod.p.direction", "", way)
        .claim("rod.p.angle", "rad", 0.8_f64.atan2(0.6))
        .claim("rod.p.angular_velocity", "rad/s", spin)
        .vector("momentum", "N.s", times(mass, mean))
        .claim(
            "angular_momentum",
            "N.m.s",
            mass * cross(middle, mean) + about * spin,
        )
        .vector("center_of_mass", "m", middle)
        .claim(
            "energy.kinetic",
            "J",
            0.5 * (mass * dot(mean, mean) + about * spin * spin),
        )
}

/// An arc drawn from left to right sags, here along an inclined chord: half its angle is 0.6, its radius 1 m.
fn arc() -> Specimen {
    let (half, slope, rho, area) = (0.6_f64, 0.25, 1300.0, 2e-3);
    let (chord, length) = (2.0 * half.sin(), 2.0 * half);
    let from = [0.3, 1.2];
    let to = sum(from, turned(slope, [chord, 0.0]));
    let scene = json!({
        "name": "arc", "dimension": 2,
        "bodies": [{"element": "cable", "name": "rope", "elements": 4,
                    "material": {"youngs_modulus": 1e6, "density": rho},
                    "section": {"area": area, "second_moment": 1e-7},
                    "shape": {"arc": {"from": from, "to": to, "length": length}},
                    "motion": {"velocity": [0.5, 0.0]},
                    "markers": {"first": 0.0, "middle": 0.5, "last": 1.0}}],
        "outputs": [{"kind": "position", "marker": "rope.middle"}, {"kind": "angle", "marker": "rope.first"},
                    {"kind": "direction", "marker": "rope.first"}, {"kind": "position", "marker": "rope.last"}, {"kind": "angle", "marker": "rope.last"},
                    {"kind": "curvature", "marker": "rope.middle"}, {"kind": "momentum"},
                    {"kind": "energy"}]});
    let lowest = [0.5 * chord, half.cos() - 1.0];
    Specimen::new("arc", scene)
        .vector(
            "rope.middle.position",
            "m",
            sum(from, turned(slope, lowest)),
        )
        .claim("rope.first.angle", "rad", slope - half)
        .vector("rope.first.direction", "", turned(slope - half, [1.0, 0.0]))
        .vector("rope.last.position", "m", to)
        .claim("rope.last.angle", "rad", slope + half)
        // Of the elements, to the second order of their length.
        .claim_within("rope.middle.curvature", "1/m", 1.0, 1e-2)
        .claim("momentum[1]", "N.s", rho * area * length * 0.5)
        .claim("energy.strain", "J", 0.0)
}
