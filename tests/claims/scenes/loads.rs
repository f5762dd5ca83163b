//! Loads: constant, as expressions and as tables, at a time that tells them apart.

use serde_json::{Value, json};

use super::{cross, dot, extra, sum, times, turned};
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;

pub fn all() -> Vec<Specimen> {
    vec![
        forces(),
        moments(),
        distributed(),
        springs(),
        table_springs(),
        straight_tables(),
        force_laws(),
        spring_forms(),
        kinks(),
        works(),
        works_of_what_moves(),
        held(),
    ]
}

fn body(name: &str, place: [f64; 2], angle: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.4, "position": place, "angle": angle,
           "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}})
}

/// A table that is 1 + 2 t at the start.
fn table() -> Value {
    json!({"table": [[0.1, 1.2], [0.9, 2.8], [1.3, -5.0]]})
}

fn forces() -> Specimen {
    let scene = json!({
        "name": "forces", "dimension": 2,
        "bodies": [body("a", [0.0, 0.0], 0.5), body("b", [2.0, 0.0], 0.5), body("c", [4.0, 0.0], 0.5), extra()],
        "loads": [{"name": "dead", "kind": "force", "marker": "a.p", "value": [1.3, -0.7]},
                  {"name": "follower", "kind": "force", "marker": "b.p", "follower": true,
                   "value": ["1.3*t+0.5", "-0.7*cos(t)"]},
                  {"name": "listed", "kind": "force", "marker": "c.p", "value": [table(), {"table": [[0.0, -1.0], [0.6, 2.0]]}]}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "angular_acceleration", "marker": "a.c"},
                    {"kind": "acceleration", "marker": "b.c"}, {"kind": "angular_acceleration", "marker": "b.c"},
                    {"kind": "acceleration", "marker": "c.c"}]});
    let arm = [0.5, -0.2];
    let dead = [1.3, -0.7];
    let along = [1.3 * T + 0.5, -0.7 * T.cos()];
    Specimen::new("forces", scene)
        .from(T)
        .vector("a.c.acceleration", "m/s2", times(1.0 / 1.6, dead))
        .claim(
            "a.c.angular_acceleration",
            "rad/s2",
            cross(turned(0.5, arm), dead) / 0.4,
        )
        .vector(
            "b.c.acceleration",
            "m/s2",
            times(1.0 / 1.6, turned(0.5, along)),
        )
        .claim(
            "b.c.angular_acceleration",
            "rad/s2",
            cross(arm, along) / 0.4,
        )
        .vector("c.c.acceleration", "m/s2", [1.0, 0.5 / 1.6])
}

/// Moments on bodies, and torques between two that are pinned at their centres of mass.
fn moments() -> Specimen {
    let pair = |n: usize| {
        [0, 1].map(|k| {
            body(
                &format!("{}{n}", ["a", "b"][k]),
                [0.0, n as f64],
                0.5 + 0.2 * k as f64,
            )
        })
    };
    let mut bodies: Vec<Value> = (1..=3).flat_map(pair).collect();
    bodies.extend((1..=3).map(|n| body(&format!("m{n}"), [2.0, f64::from(n)], 0.1)));
    bodies.push(extra());
    let joint = |n: i32| {
        json!({"name": format!("j{n}"), "kind": "revolute",
                                "markers": [format!("a{n}.c"), format!("b{n}.c")]})
    };
    let values = [json!(1.7), json!("1.7*t-0.2"), table()];
    let mut loads = Vec::new();
    for (n, value) in (1..=3).zip(values) {
        loads.push(json!({"name": format!("moment{n}"), "kind": "moment", "marker": format!("m{n}.c"), "value": value}));
        loads.push(json!({"name": format!("torque{n}"), "kind": "torque", "joint": format!("j{n}"), "value": value}));
    }
    let mut outputs = Vec::new();
    for n in 1..=3 {
        for of in ["a", "b", "m"] {
            outputs.push(json!({"kind": "angular_acceleration", "marker": format!("{of}{n}.c")}));
        }
    }
    let scene = json!({"name": "moments", "dimension": 2, "bodies": bodies,
                       "joints": [joint(1), joint(2), joint(3)], "loads": loads, "outputs": outputs});
    let mut specimen = Specimen::new("moments", scene).from(T);
    for (n, size) in (1..=3).zip([1.7, 1.7 * T - 0.2, 1.6]) {
        specimen = specimen
            .claim(
                &format!("m{n}.c.angular_acceleration"),
                "rad/s2",
                size / 0.4,
            )
            .claim(
                &format!("b{n}.c.angular_acceleration"),
                "rad/s2",
                size / 0.4,
            )
            .claim(
                &format!("a{n}.c.angular_acceleration"),
                "rad/s2",
                -size / 0.4,
            );
    }
    specimen
}

/// Uniform loads move straight free cables as they are.
fn distributed() -> Specimen {
    let rod = |name: &str, y: f64| {
        json!({"element": "cable", "name": name, "elements": 2,
               "material": {"youngs_modulus": 1e6, "density": 1250.0},
               "section": {"area": 2e-3, "second_moment": 1e-7},
               "shape": {"line": {"from": [0.0, y], "to": [0.6, y + 0.8]}}, "markers": {"p": 0.3}})
    };
    let load = |name: &str, of: &str, value: Value| json!({"name": name, "kind": "distributed_force", "body": of, "value": value});
    let scene = json!({
        "name": "distributed", "dimension": 2,
        "bodies": [rod("a", 0.0), rod("b", 1.0), rod("c", 2.0)],
        "loads": [load("number", "a", json!([1.3, -0.7])),
                  load("expression", "b", json!(["1.3*t+0.5", "-0.7*cos(t)"])),
                  load("listed", "c", json!([table(), {"table": [[0.0, -1.0], [0.6, 2.0]]}]))],
        "outputs": [{"kind": "acceleration", "marker": "a.p"}, {"kind": "acceleration", "marker": "b.p"},
                    {"kind": "acceleration", "marker": "c.p"}]});
    let per = |q: [f64; 2]| times(1.0 / 2.5, q);
    Specimen::new("distributed", scene)
        .from(T)
        .vector("a.p.acceleration", "m/s2", per([1.3, -0.7]))
        .vector(
            "b.p.acceleration",
            "m/s2",
            per([1.3 * T + 0.5, -0.7 * T.cos()]),
        )
        .vector("c.p.acceleration", "m/s2", per([1.6, 0.5]))
}

/// Energy of a spring of `table_springs`, J.
const STORED: f64 = 0.34169079704495664;

fn bead(name: &str, place: [f64; 2], speed: [f64; 2]) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.0, "position": place,
           "motion": {"velocity": speed}, "markers": {"c": [0.0, 0.0]}})
}

/// Springs and dampers to the ground, each without a key, and between two bodies.
fn springs() -> Specimen {
    let (k, d, rest, speed) = (30.0, 1.5, 0.8, [0.7, -0.4]);
    let spring = |name: &str, of: &str, mut keys: Value| {
        keys["name"] = json!(name);
        keys["kind"] = json!("spring_damper");
        keys["markers"] = json!(["ground", of]);
        keys
    };
    // All beads are (0.6, 0.8) from where the ground is held.
    let scene = json!({
        "name": "springs", "dimension": 2,
        "bodies": [bead("a", [0.6, 0.8], speed), bead("b", [1.6, 0.8], speed), bead("c", [2.6, 0.8], speed),
                   bead("d", [3.6, 0.8], speed), bead("e", [4.6, 0.8], speed), bead("f", [5.0, 0.0], [0.0, 0.0]),
                   bead("g", [5.6, 0.8], speed), extra()],
        "loads": [spring("full", "a.c", json!({"point": [0.0, 0.0], "stiffness": k, "damping": d, "length": rest})),
                  spring("relaxed", "b.c", json!({"point": [1.0, 0.0], "stiffness": k, "damping": d})),
                  spring("undamped", "c.c", json!({"point": [2.0, 0.0], "stiffness": k, "length": rest})),
                  spring("soft", "d.c", json!({"point": [3.0, 0.0], "damping": d, "length": rest})),
                  // Without length there is no direction, and no force.
                  spring("here", "e.c", json!({"stiffness": k, "length": rest})),
                  {"name": "pair", "kind": "spring_damper", "markers": ["f.c", "g.c"], "stiffness": k, "length": rest,
                   "damping": d}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "b.c"},
                    {"kind": "acceleration", "marker": "c.c"}, {"kind": "acceleration", "marker": "d.c"},
                    {"kind": "acceleration", "marker": "e.c"}, {"kind": "acceleration", "marker": "f.c"},
                    {"kind": "acceleration", "marker": "g.c"}, {"kind": "energy"},
                    {"kind": "load_force", "load": "full"}, {"kind": "load_force", "load": "pair"}]});
    let unit = [0.6, 0.8];
    let (pull, brake) = (-k * (1.0 - rest) / 1.6, -d * dot(speed, unit) / 1.6);
    Specimen::new("springs", scene)
        .vector("a.c.acceleration", "m/s2", times(pull + brake, unit))
        .vector("b.c.acceleration", "m/s2", times(brake, unit))
        .vector("c.c.acceleration", "m/s2", times(pull, unit))
        .vector("d.c.acceleration", "m/s2", times(brake, unit))
        .vector("e.c.acceleration", "m/s2", [0.0, 0.0])
        .vector("f.c.acceleration", "m/s2", times(-pull - brake, unit))
        .vector("g.c.acceleration", "m/s2", times(pull + brake, unit))
        .vector("full.force", "N", times(1.6 * (pull + brake), unit))
        .vector("pair.force", "N", times(1.6 * (pull + brake), unit))
        .claim("energy.spring", "J", 0.5 * k * (3.0 * 0.04 + rest * rest))
}

/// Springs and dampers by tables, at points of these. The energy is that of `scipy.interpolate.PchipInterpolator.integrate`.
fn table_springs() -> Specimen {
    let speed = [0.7, -0.4];
    let force = json!([[0.4, -9.0], [0.8, 0.0], [1.0, 3.5], [1.5, 20.0]]);
    let damper = json!([[-0.5, -4.0], [0.0, 0.0], [0.1, 2.0], [0.4, 2.5]]);
    // All beads are (0.6, 0.8) from where the ground is held.
    let scene = json!({
        "name": "table_springs", "dimension": 2,
        "bodies": [bead("a", [0.6, 0.8], speed), bead("b", [1.6, 0.8], speed), bead("c", [2.0, 0.0], [0.0, 0.0]),
                   bead("d", [2.6, 0.8], speed), extra()],
        "loads": [{"name": "full", "kind": "table_spring", "markers": ["ground", "a.c"], "point": [0.0, 0.0], "spring": force,
                   "damper": damper},
                  {"name": "alone", "kind": "table_spring", "markers": ["ground", "b.c"], "point": [1.0, 0.0], "spring": force},
                  {"name": "pair", "kind": "table_spring", "markers": ["c.c", "d.c"], "spring": force, "damper": damper}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "b.c"},
                    {"kind": "acceleration", "marker": "c.c"}, {"kind": "acceleration", "marker": "d.c"}, {"kind": "energy"},
                    {"kind": "load_force", "load": "full"}, {"kind": "load_force", "load": "pair"}]});
    let (unit, pull, brake) = ([0.6, 0.8], -3.5 / 1.6, -2.0 / 1.6);
    Specimen::new("table_springs", scene)
        .vector("a.c.acceleration", "m/s2", times(pull + brake, unit))
        .vector("b.c.acceleration", "m/s2", times(pull, unit))
        .vector("c.c.acceleration", "m/s2", times(-pull - brake, unit))
        .vector("d.c.acceleration", "m/s2", times(pull + brake, unit))
        .vector("full.force", "N", times(1.6 * (pull + brake), unit))
        .vector("pair.force", "N", times(1.6 * (pull + brake), unit))
        .claim("energy.spring", "J", 3.0 * STORED)
}

/// Tables that are straight lines, also beyond their ends: a damped oscillator.
fn straight_tables() -> Specimen {
    let (k, c, rest, start, t): (f64, f64, f64, f64, f64) = (40.0, 2.0, 0.5, 0.4, 0.7);
    let line = |slope: f64, at: f64, ends: [f64; 2]| ends.map(|x| [x, slope * (x - at)]);
    let damper = [[-0.1, -0.1 * c], [0.0, 0.0], [0.2, 0.2 * c]];
    let scene = json!({
        "name": "straight_tables", "dimension": 2, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [bead("a", [rest + start, 0.0], [0.0, 0.0])],
        "loads": [{"name": "line", "kind": "table_spring", "markers": ["ground", "a.c"], "point": [0.0, 0.0],
                   "spring": line(k, rest, [0.45, 0.6]), "damper": damper}],
        "outputs": [{"kind": "position", "marker": "a.c"}, {"kind": "work"}]});
    // Of 1.6 kg.
    let decay = c / 3.2;
    let rate = (k / 1.6 - decay * decay).sqrt();
    let (sin, cos) = (rate * t).sin_cos();
    let way = start * (-decay * t).exp() * (cos + decay / rate * sin);
    let speed = -start * (-decay * t).exp() * (decay * decay / rate + rate) * sin;
    let lost = 0.5 * k * (start * start - way * way) - 0.8 * speed * speed;
    Specimen::new("straight_tables", scene)
        .at(t)
        .claim_within("a.c.position[1]", "m", rest + way, 1e-8)
        .claim_within("energy.dissipated", "J", lost, 1e-7)
}

/// Forces by expressions between two points: over the length, its rate, the time and what an input sets.
fn force_laws() -> Specimen {
    let speed = [0.7, -0.4];
    let text = "3*x^2 + 0.5*v*abs(v) - 2*t + u";
    let law = |name: &str, keys: Value| {
        let mut law = keys;
        law["name"] = json!(name);
        law["kind"] = json!("force_law");
        law
    };
    // All beads are (0.6, 0.8) from where the ground is held.
    let scene = json!({
        "name": "force_laws", "dimension": 2,
        "bodies": [bead("a", [0.6, 0.8], speed), bead("b", [1.0, 0.0], [0.0, 0.0]), bead("c", [1.6, 0.8], speed),
                   bead("d", [2.6, 0.8], speed), extra()],
        "loads": [law("full", json!({"markers": ["ground", "a.c"], "point": [0.0, 0.0], "force": text})),
                  law("pair", json!({"markers": ["b.c", "c.c"], "force": text})),
                  // Without length there is no direction, and no force.
                  law("here", json!({"markers": ["ground", "d.c"], "force": "2+x"}))],
        "inputs": [{"kind": "control", "load": "full", "start": [1.5]}, {"kind": "control", "load": "pair"}],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "b.c"},
                    {"kind": "acceleration", "marker": "c.c"}, {"kind": "acceleration", "marker": "d.c"},
                    {"kind": "load_force", "load": "full"}, {"kind": "load_force", "load": "pair"}]});
    let (unit, rate) = ([0.6, 0.8], 0.42 - 0.32);
    let pull = |control: f64| 3.0 + 0.5 * rate * rate - 2.0 * T + control;
    Specimen::new("force_laws", scene)
        .from(T)
        .vector("a.c.acceleration", "m/s2", times(-pull(1.5) / 1.6, unit))
        .vector("b.c.acceleration", "m/s2", times(pull(0.0) / 1.6, unit))
        .vector("c.c.acceleration", "m/s2", times(-pull(0.0) / 1.6, unit))
        .vector("d.c.acceleration", "m/s2", [0.0, 0.0])
        .vector("full.force", "N", times(-pull(1.5), unit))
        .vector("pair.force", "N", times(-pull(0.0), unit))
}

/// Lengths at rest that change in time.
fn spring_forms() -> Specimen {
    let spring = |name: &str, of: &str, x: f64, length: Value| {
        json!({"name": name, "kind": "spring_damper", "markers": ["ground", of], "point": [x, 0.0],
               "stiffness": 30.0, "length": length})
    };
    let scene = json!({
        "name": "spring_forms", "dimension": 2,
        "bodies": [bead("a", [0.6, 0.8], [0.0, 0.0]), bead("b", [1.6, 0.8], [0.0, 0.0])],
        "loads": [spring("expression", "a.c", 0.0, json!("0.9-0.4*t")), spring("listed", "b.c", 1.0, table())],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "b.c"}]});
    let pull = |rest: f64| times(-30.0 * (1.0 - rest) / 1.6, [0.6, 0.8]);
    Specimen::new("spring_forms", scene)
        .from(T)
        .vector("a.c.acceleration", "m/s2", pull(0.9 - 0.4 * T))
        .vector("b.c.acceleration", "m/s2", pull(1.6))
}

/// A force that goes straight from point to point: between its kinks the motion is a polynomial of degree
/// 3, which every method of order 4 integrates exactly if no step leads across a kink.
fn kinks() -> Specimen {
    let points = [
        [0.0, 0.0],
        [0.13, 2.0],
        [0.29, -3.0],
        [0.47, 1.0],
        [1.0, 1.0],
    ];
    let scene = json!({
        "name": "kinks", "dimension": 2, "accuracy": {"relative_tolerance": 0.05},
        "bodies": [bead("a", [0.0, 0.0], [0.2, 0.0])],
        "loads": [{"name": "pull", "kind": "force", "marker": "a.c", "value": [{"table": points}, 0.0]}],
        "outputs": [{"kind": "position", "marker": "a.c"}, {"kind": "velocity", "marker": "a.c"}],
        "method": {"integrator": "rkn43"}});
    let (mut x, mut v) = (0.0, 0.2);
    for pair in points.windows(2) {
        let h = pair[1][0] - pair[0][0];
        let [a, b] = [pair[0][1] / 1.6, pair[1][1] / 1.6];
        x += v * h + (2.0 * a + b) * h * h / 6.0;
        v += 0.5 * (a + b) * h;
    }
    Specimen::new("kinks", scene)
        .at(1.0)
        .claim("a.c.position[1]", "m", x)
        .claim("a.c.velocity[1]", "m/s", v)
}

/// Work of a force on a free body, and what a damper takes from one that rotates.
fn works() -> Specimen {
    let (force, speed, j, d, spin) = ([3.0, -2.0], [0.4, 0.1], 0.4, 0.6, 2.5);
    let mut turning = body("wheel", [3.0, 0.0], 0.2);
    turning["motion"] = json!({"spin": spin});
    let scene = json!({
        "name": "works", "dimension": 2, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [bead("a", [0.1, 0.2], speed), turning],
        "joints": [{"name": "axle", "kind": "revolute", "markers": ["ground", "wheel.c"], "damping": d}],
        "loads": [{"name": "pull", "kind": "force", "marker": "a.c", "value": force}],
        "outputs": [{"kind": "work"}, {"kind": "position", "marker": "a.c"}]});
    let t = 0.7;
    let way = sum(times(t, speed), times(0.5 * t * t / 1.6, force));
    let left_over: f64 = spin * f64::exp(-d / j * t);
    Specimen::new("works", scene)
        .claim("energy.input", "J", 0.0)
        .claim("energy.dissipated", "J", 0.0)
        .at(t)
        .vector_within("a.c.position", "m", sum([0.1, 0.2], way), 1e-8)
        .claim_within("energy.input", "J", dot(force, way), 1e-7)
        .claim_within(
            "energy.dissipated",
            "J",
            0.5 * j * (spin * spin - left_over * left_over),
            1e-6,
        )
}

/// Work of a moment and of a uniform load on free bodies.
fn works_of_what_moves() -> Specimen {
    let (moment, line, t) = (1.4, [2.0, -1.5], 0.6);
    let scene = json!({
        "name": "works_of_what_moves", "dimension": 2, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [body("wheel", [3.0, 0.0], 0.2),
                   {"element": "cable", "name": "rod", "elements": 2,
                    "material": {"youngs_modulus": 1e4, "density": 1250.0},
                    "section": {"area": 2e-3, "second_moment": 1e-6},
                    "shape": {"line": {"from": [0.0, 0.0], "to": [0.6, 0.8]}}}],
        "loads": [{"name": "twist", "kind": "moment", "marker": "wheel.c", "value": moment},
                  {"name": "wind", "kind": "distributed_force", "body": "rod", "value": line}],
        "outputs": [{"kind": "work"}]});
    // The rod is 1 m long and weighs 2.5 kg.
    let work = 0.5 * t * t * (moment * moment / 0.4 + dot(line, line) / 2.5);
    Specimen::new("works_of_what_moves", scene)
        .at(t)
        .claim_within("energy.input", "J", work, 1e-7)
}

/// Beads that are held: one on a spring whose length at rest shrinks, one on a damper to a point that comes in
/// and moves, one that rotates against a damper.
fn held() -> Specimen {
    let (k, d, dr, t) = (30.0, 1.5, 0.8, 0.5);
    let hold = |name: &str, of: &str, place: [f64; 2]| json!({"name": name, "kind": "position", "marker": of, "value": place});
    let scene = json!({
        "name": "held", "dimension": 2, "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [bead("a", [0.6, 0.8], [0.0, 0.0]), body("b", [2.0, 0.0], 0.3)],
        "motions": [hold("hold", "a.c", [0.6, 0.8]), hold("keep", "b.c", [2.0, 0.0]),
                    {"name": "still", "kind": "angle", "marker": "b.p", "value": 0.3}],
        "loads": [{"name": "winch", "kind": "spring_damper", "markers": ["ground", "a.c"], "point": [0.0, 0.0],
                   "stiffness": k, "length": "0.9-0.4*t"}],
        "ports": [{"name": "flange", "marker": "b.c", "kind": "motion", "damping": d, "rotational_damping": dr}],
        "outputs": [{"kind": "work"}, {"kind": "energy"}]});
    let (speed, spin) = ([0.4, -0.3], 0.7);
    let stretch = |t: f64| 0.1 + 0.4 * t;
    let stored = |t: f64| 0.5 * k * stretch(t) * stretch(t);
    let lost = t * (d * dot(speed, speed) + dr * spin * spin);
    Specimen::new("held", scene)
        .set("flange.velocity[1]", speed[0])
        .set("flange.velocity[2]", speed[1])
        .set("flange.angular_velocity", spin)
        .at(t)
        .claim_within("energy.spring", "J", stored(t), 1e-8)
        .claim_within("energy.input", "J", stored(t) - stored(0.0) + lost, 1e-7)
        .claim_within("energy.dissipated", "J", lost, 1e-7)
}
