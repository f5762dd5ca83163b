//! What is spread along bodies and changes along them: forces and moments per length.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space::array;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        pushed(),
        carried(),
        deflected(),
        twisted("rod"),
        twisted("beam"),
        turned("rod", false),
        turned("beam", true),
        set(),
        tabled(),
        started(),
        let_go(),
    ]
}

/// A rigid rod from the origin along this unit vector.
fn rigid(way: [f64; 2]) -> Value {
    json!({"element": "cable", "name": "rod", "elements": 2, "model": "rigid",
           "material": {"youngs_modulus": 1e6, "density": 1250.0},
           "section": {"area": 2e-3, "second_moment": 1e-7},
           "shape": {"line": {"from": [0.0, 0.0], "to": way}}, "markers": {"a": 0.0, "p": 0.3}})
}

/// A force along a free rigid body moves its centre by its integral and rotates it by its first moment.
fn pushed() -> Specimen {
    let (way, mass, time) = ([0.6, 0.8], 2.5, 0.4_f64);
    let scene = json!({"name": "pushed", "dimension": 2, "bodies": [rigid(way)],
        "loads": [{"name": "wind", "kind": "distributed_force", "body": "rod",
                   "value": ["0.5*s^2+t", "3*s^3-1.2*sin(PI*s)*cos(t)"]}],
        "outputs": [{"kind": "acceleration", "marker": "rod.p"}]});
    let force = [0.5 / 3.0 + time, 0.75 - 2.4 / PI * time.cos()];
    // Integrals of (s - 1/2) times both; the sine is even about the middle.
    let moment = way[0] * 0.225 - way[1] / 24.0;
    let turn = moment / (mass / 12.0) * (0.3 - 0.5);
    let place = [
        force[0] / mass - turn * way[1],
        force[1] / mass + turn * way[0],
    ];
    Specimen::new("pushed along", scene)
        .from(time)
        .vector("rod.p.acceleration", "m/s2", place)
}

/// A section of a clamped rigid rod carries what acts beyond it.
fn carried() -> Specimen {
    let way = [0.6, 0.8];
    let scene = json!({"name": "carried", "dimension": 2, "bodies": [rigid(way)],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.a"]}],
        "loads": [{"name": "wind", "kind": "distributed_force", "body": "rod", "value": ["2*s^3", "s-4*s^2"]}],
        "outputs": [{"kind": "axial_force", "marker": "rod.p"}, {"kind": "bending_moment", "marker": "rod.p"}]});
    let s: f64 = 0.3;
    // Integrals from s to 1 of x^n and of x^n (x - s).
    let power = |n: i32| (1.0 - s.powi(n + 1)) / f64::from(n + 1);
    let arm = |n: i32| power(n + 1) - s * power(n);
    let force = [2.0 * power(3), power(1) - 4.0 * power(2)];
    let turning = [2.0 * arm(3), arm(1) - 4.0 * arm(2)];
    Specimen::new("carried along", scene)
        .claim(
            "rod.p.axial_force",
            "N",
            way[0] * force[0] + way[1] * force[1],
        )
        .claim(
            "rod.p.bending_moment",
            "N.m",
            way[0] * turning[1] - way[1] * turning[0],
        )
}

/// A cantilever under `q s`: the tip goes by `11 q L^4 / (120 E I)`, the moment is `q L^2 ((1 - s^3) / 3 - s (1 - s^2) / 2)`.
fn deflected() -> Specimen {
    let (length, stiffness, load) = (1.5, 1e3, 1e-3);
    let scene = json!({"name": "deflected", "dimension": 2, "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [{"element": "cable", "name": "rod", "elements": 3, "model": "flexible",
            "material": {"youngs_modulus": 1e9, "density": 1000.0}, "section": {"area": 1e-3, "second_moment": 1e-6},
            "shape": {"line": {"from": [0.0, 0.0], "to": [length, 0.0]}}, "markers": {"a": 0.0, "p": 0.3, "e": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.a"]}],
        "loads": [{"name": "snow", "kind": "distributed_force", "body": "rod", "value": [0.0, format!("-{load}*s")]}],
        "outputs": [{"kind": "position", "marker": "rod.e"}, {"kind": "bending_moment", "marker": "rod.p"}]});
    let s: f64 = 0.3;
    let moment = load * length * length * ((1.0 - s.powi(3)) / 3.0 - s * (1.0 - s * s) / 2.0);
    let tip = 11.0 * load * length.powi(4) / (120.0 * stiffness);
    Specimen::new("deflected along", scene)
        .claim_within("rod.e.position[2]", "m", -tip, 1e-6 * tip)
        .claim_within("rod.p.bending_moment", "N.m", -moment, 1e-6 * moment)
}

const YOUNG: f64 = 3.0e5;
const SHEAR: f64 = 1.1e5;
const MOMENTS: [f64; 2] = [3.0e-7, 7.0e-7];
const TORSION: f64 = 5.0e-7;
const LENGTH: f64 = 1.4;

/// A rod or beam along `x`, whose second axis is `y`, clamped at its first end, in equilibrium.
fn clamped(element: &str, rest: Value) -> Value {
    let mut scene = json!({"name": "moments", "dimension": 3, "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [{"name": "rod", "element": element, "elements": 4, "axial": "waves",
            "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": 700.0},
            "section": {"area": 2e-3, "second_moments": MOMENTS, "torsion_constant": TORSION},
            "axis": [0.0, 1.0, 0.0], "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [LENGTH, 0.0, 0.0]}},
            "markers": {"root": 0.0, "mid": 0.4, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]}]});
    if element == "beam" {
        scene["bodies"][0]["section"]["shear_factors"] = json!([0.8, 0.7]);
    }
    for (key, value) in rest.as_object().into_iter().flatten() {
        scene[key] = value.clone();
    }
    scene
}

/// Under a torque `m (1 + 2 s^2)` per length a shaft carries `m L ((1 - s) + 2 (1 - s^3) / 3)` and its end rotates by `m L^2 / (G J)`.
fn twisted(element: &str) -> Specimen {
    let torque = 0.012;
    let scene = clamped(
        element,
        json!({"loads": [{"name": "drag", "kind": "distributed_moment", "body": "rod", "follower": false,
                          "value": [format!("{torque}*(1+2*s^2)"), 0.0, 0.0]}],
               "outputs": [{"kind": "orientation", "marker": "rod.tip"}, {"kind": "torque", "marker": "rod.root"},
                           {"kind": "torque", "marker": "rod.mid"}]}),
    );
    let angle = torque * LENGTH * LENGTH / (SHEAR * TORSION);
    let carried = |s: f64| torque * LENGTH * (1.0 - s + 2.0 * (1.0 - s.powi(3)) / 3.0);
    Specimen::new("twisted along", scene)
        .claim("rod.root.torque", "N.m", carried(0.0))
        .claim("rod.mid.torque", "N.m", carried(0.4))
        .claim("rod.tip.orientation[5]", "", angle.cos())
        .claim("rod.tip.orientation[8]", "", angle.sin())
}

/// Under a moment `m (1 + s)` about `z` and no force a cantilever carries `m L ((1 - s) + (1 - s^2) / 2)`, however far it bends, and its
/// end rotates by `5 m L^2 / (6 E I)`: whether the moment stays about `z` or rotates along.
fn turned(element: &str, follower: bool) -> Specimen {
    let moment = 0.03;
    let mut load = json!({"name": "drag", "kind": "distributed_moment", "body": "rod", "follower": false,
                          "value": [0.0, 0.0, format!("{moment}*(1+s)")]});
    if follower {
        load["follower"] = json!(true);
        // The third axis is `-y`, the second `z`.
        load["value"] = json!([0.0, format!("{moment}*(1+s)"), 0.0]);
    }
    let mut scene = clamped(
        element,
        json!({"loads": [load],
               "outputs": [{"kind": "bending_moment", "marker": "rod.root"}, {"kind": "bending_moment", "marker": "rod.mid"},
                           {"kind": "direction", "marker": "rod.tip"}]}),
    );
    let mut second = MOMENTS[1];
    if follower {
        scene["bodies"][0]["axis"] = json!([0.0, 0.0, 1.0]);
        second = MOMENTS[0];
    }
    let angle = 5.0 * moment * LENGTH * LENGTH / (6.0 * YOUNG * second);
    let carried = |s: f64| moment * LENGTH * (1.0 - s + (1.0 - s * s) / 2.0);
    Specimen::new("turned along", scene)
        .claim("rod.root.bending_moment[3]", "N.m", carried(0.0))
        .claim("rod.mid.bending_moment[3]", "N.m", carried(0.4))
        .claim_within("rod.tip.direction[1]", "", angle.cos(), 1e-5)
        .claim_within("rod.tip.direction[2]", "", angle.sin(), 1e-5)
}

/// Moments that the master sets: the wall carries `L` times their sum, of those that rotate along where the rod is nearly straight.
fn set() -> Specimen {
    let (dead, follower) = (
        Vector3::new(3e-7, -2e-7, 5e-7),
        Vector3::new(1e-7, 4e-7, -2e-7),
    );
    let scene = clamped(
        "rod",
        json!({"inputs": [{"kind": "distributed_moment", "body": "rod", "start": array(dead)},
                          {"kind": "distributed_moment", "body": "rod", "follower": true, "start": array(follower)}],
               "outputs": [{"kind": "bending_moment", "marker": "rod.root"}]}),
    );
    let mut specimen = Specimen::new("set along", scene);
    for k in 0..3 {
        let name = |of: &str| format!("rod.{of}[{}]", k + 1);
        specimen = specimen
            .set(&name("distributed_moment"), dead[k])
            .set(&name("distributed_follower_moment"), follower[k]);
    }
    let moment = (dead + follower) * LENGTH;
    for k in 0..3 {
        let of = format!("rod.root.bending_moment[{}]", k + 1);
        specimen = specimen.claim_within(&of, "N.m", moment[k], 1e-11);
    }
    specimen
}

/// Along `y`, where moments in global axes and in those of sections differ, and another that nothing acts on.
fn upright(rest: Value) -> Value {
    let rod = |name: &str, place: f64| {
        json!({"name": name, "element": "rod", "elements": 4, "axial": "waves",
            "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": 100.0},
            "section": {"area": 1e-3, "second_moments": MOMENTS, "torsion_constant": TORSION}, "axis": [0.0, 0.0, 1.0],
            "shape": {"line": {"from": [place, 0.0, 0.0], "to": [place, LENGTH, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}})
    };
    let wall = |name: &str| json!({"name": format!("wall_{name}"), "kind": "weld", "markers": ["ground", format!("{name}.root")]});
    let mut scene = json!({"name": "upright", "dimension": 3, "bodies": [rod("rod", 0.0), rod("other", 1.0)],
        "joints": [wall("rod"), wall("other")], "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9},
        "outputs": [{"kind": "torque", "marker": "rod.root"}, {"kind": "torque", "marker": "other.root"},
                    {"kind": "orientation", "marker": "rod.tip"}]});
    for (key, value) in rest.as_object().into_iter().flatten() {
        scene[key] = value.clone();
    }
    scene
}

/// A torque along the tangent by a table: `m L` at the wall.
fn tabled() -> Specimen {
    let value = json!([{"table": [[0.0, 0.01], [2.0, 0.03]]}, 0.0, 0.0]);
    let scene = upright(
        json!({"loads": [{"name": "drag", "kind": "distributed_moment", "body": "rod",
        "follower": true, "value": value}]}),
    );
    Specimen::new("tabled along", scene)
        .from(0.5)
        .claim("rod.root.torque", "N.m", 0.015 * LENGTH)
        .claim("other.root.torque", "N.m", 0.0)
}

/// The same as an input that starts at a value.
fn started() -> Specimen {
    let scene = upright(
        json!({"inputs": [{"kind": "distributed_moment", "body": "rod", "follower": true,
        "start": [0.02, 0.0, 0.0]}]}),
    );
    Specimen::new("started along", scene)
        .claim("rod.root.torque", "N.m", 0.02 * LENGTH)
        .claim("other.root.torque", "N.m", 0.0)
}

/// Moments that hold only before the start: number, table and expression in `s` add up, and the end rotates by the integral of `m(s) s` times
/// `L^2 / (G J)`.
fn let_go() -> Specimen {
    let load = |name: &str, value: Value| {
        json!({"name": name, "kind": "distributed_moment", "body": "rod", "follower": true,
               "value": [value, 0.0, 0.0]})
    };
    let loads = [
        load("plain", json!(0.002)),
        load("table", json!({"table": [[0.0, 0.001], [2.0, 0.003]]})),
        load("along", json!("0.006*s")),
    ];
    let scene = upright(json!({"initial": {"state": "static_equilibrium", "loads": loads}}));
    // Twist at the end: the integral of m(s) s.
    let density = 0.5 * (0.002 + 0.0015) + 0.006 / 3.0;
    let angle = density * LENGTH * LENGTH / (SHEAR * TORSION);
    // The first axis is `z`, and rotates about `y` towards `x`.
    Specimen::new("let go along", scene)
        .from(0.5)
        .claim_within("rod.tip.orientation[2]", "", angle.sin(), 1e-8)
        .claim_within("rod.tip.orientation[8]", "", angle.cos(), 1e-8)
}
