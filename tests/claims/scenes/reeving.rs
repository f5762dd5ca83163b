//! Ropes over points: each key, the viscous part within its limits, lengths that change, a drum.

use serde_json::{Value, json};

use super::{extra, sum, times};
use crate::claims::specimen::Specimen;

/// Time of the start, s.
const T: f64 = 0.3;

pub fn all() -> Vec<Specimen> {
    vec![ropes(), courses(), drums(), steered(), lengths()]
}

fn bead(name: &str, place: [f64; 2], speed: [f64; 2]) -> Value {
    json!({"element": "rigid", "name": name, "mass": 1.6, "inertia": 0.0, "position": place,
           "motion": {"velocity": speed}, "markers": {"c": [0.0, 0.0]}})
}

/// A rope of `EA` = 40 N from a point of the ground over a bead at (0.6, 0.8) from there to another one beyond it at 1 m.
fn rope(name: &str, k: usize, mut keys: Value) -> Value {
    keys["name"] = json!(name);
    keys["kind"] = json!("reeving");
    keys["markers"] = json!(["ground", format!("a{k}.c"), format!("b{k}.c")]);
    keys["points"] = json!([[k as f64, 0.0]]);
    keys["axial_stiffness"] = json!(40.0);
    keys
}

fn pair(k: usize, speeds: [[f64; 2]; 2]) -> [Value; 2] {
    let x = k as f64;
    [
        bead(&format!("a{k}"), [x + 0.6, 0.8], speeds[0]),
        bead(&format!("b{k}"), [x + 1.6, 0.8], speeds[1]),
    ]
}

/// Accelerations of both beads under a tension.
fn pulled(tension: f64) -> [[f64; 2]; 2] {
    let by = tension / 1.6;
    let (back, on) = ([-0.6, -0.8], [1.0, 0.0]);
    [times(by, sum(back, on)), times(-by, on)]
}

/// The path is 2 m long; it grows at -0.4 m/s, of the third and fourth at 1.4 m/s and -1.6 m/s.
fn ropes() -> Specimen {
    let slow = [[0.7, -0.4], [0.2, 0.3]];
    let apart = [[0.7, -0.4], [2.0, 0.3]];
    let together = [[0.7, -0.4], [-1.0, 0.3]];
    let speeds = [slow, slow, apart, together, slow];
    let bodies = speeds.iter().enumerate();
    let mut bodies: Vec<Value> = bodies.flat_map(|(k, speeds)| pair(k, *speeds)).collect();
    bodies.push(extra());
    let keys = |length: f64, damping: f64| json!({"length": length, "damping_time": damping});
    let mut outputs = vec![json!({"kind": "energy"})];
    let names = ["full", "undamped", "fast", "falling", "relaxed"];
    for (k, name) in names.iter().enumerate() {
        outputs.push(json!({"kind": "tension", "load": name}));
        outputs.push(json!({"kind": "length", "load": name}));
        outputs.push(json!({"kind": "acceleration", "marker": format!("a{k}.c")}));
        outputs.push(json!({"kind": "acceleration", "marker": format!("b{k}.c")}));
    }
    let scene = json!({
        "name": "ropes", "dimension": 2, "bodies": bodies,
        "loads": [rope("full", 0, keys(1.5, 0.02)), rope("undamped", 1, json!({"length": 1.5})), rope("fast", 2, keys(1.9, 0.2)),
                  rope("falling", 3, keys(1.9, 0.2)), rope("relaxed", 4, json!({"damping_time": 0.02}))],
        "outputs": outputs});
    // Where the path grows fast the viscous part is as large as the elastic one, where it shortens fast it takes that away.
    let tensions = [
        40.0 / 1.5 * (0.5 - 0.02 * 0.4),
        40.0 / 1.5 * 0.5,
        40.0 / 1.9 * 0.2,
        0.0,
        0.0,
    ];
    let stored = 20.0 * (2.0 * 0.25 / 1.5 + 2.0 * 0.01 / 1.9);
    let mut specimen = Specimen::new("ropes", scene).claim("energy.spring", "J", stored);
    let rates = [-0.4, -0.4, 1.4, -1.6, -0.4];
    for (k, (name, tension)) in names.iter().zip(tensions).enumerate() {
        let [first, second] = pulled(tension);
        specimen = specimen
            .claim(&format!("{name}.length"), "m", 2.0)
            .claim(&format!("{name}.length_rate"), "m/s", rates[k])
            .claim(&format!("{name}.tension"), "N", tension)
            .vector(&format!("a{k}.c.acceleration"), "m/s2", first)
            .vector(&format!("b{k}.c.acceleration"), "m/s2", second);
    }
    specimen
}

/// Lines between a point and a bead that is 0.5 m away and moves off at 1.2 m/s: length, its rate and tension of what pulls along them.
fn lengths() -> Specimen {
    let line = |name: &str, mut keys: Value| {
        keys["name"] = json!(name);
        keys["markers"] = json!(["ground", "bead.c"]);
        keys["point"] = json!([0.3, -0.4]);
        keys
    };
    let spring = json!({"kind": "spring_damper", "stiffness": 30.0, "damping": 0.5, "length": 0.4});
    let table = json!({"kind": "table_spring", "spring": [[0.3, -4.0], [0.7, 12.0]]});
    let law = json!({"kind": "force_law", "force": "20*x+3*v"});
    let drag = json!({"kind": "force_law", "force": "3*v"});
    let names = ["spring", "table", "law", "drag"];
    let read = |kind: &str| names.map(|name| json!({"kind": kind, "load": name}));
    let outputs = [read("length"), read("tension")].concat();
    let scene = json!({
        "name": "lengths", "dimension": 2, "bodies": [bead("bead", [0.6, 0.0], [2.0, 0.0]), extra()],
        "loads": [line("spring", spring), line("table", table), line("law", law), line("drag", drag),
                  // One whose length is not read, so that the others could be read of it.
                  json!({"name": "spare", "kind": "spring_damper", "markers": ["ground", "bead.c"], "point": [0.0, 0.9], "stiffness": 0.0, "damping": 1.0})],
        "outputs": outputs});
    let tensions = [
        30.0 * 0.1 + 0.5 * 1.2,
        4.0,
        20.0 * 0.5 + 3.0 * 1.2,
        3.0 * 1.2,
    ];
    let mut specimen = Specimen::new("lengths", scene);
    for (name, tension) in names.into_iter().zip(tensions) {
        specimen = specimen
            .claim(&format!("{name}.length"), "m", 0.5)
            .claim(&format!("{name}.length_rate"), "m/s", 1.2)
            .claim(&format!("{name}.tension"), "N", tension);
    }
    specimen
}

/// Lengths that change in time: what shortens the rope stretches it, so that its rate counts too.
fn courses() -> Specimen {
    let table = json!({"table": [[0.1, 1.2], [0.9, 2.0]]});
    let still = [[0.0, 0.0]; 2];
    let mut bodies: Vec<Value> = (0..2).flat_map(|k| pair(k, still)).collect();
    bodies.push(extra());
    let scene = json!({
        "name": "courses", "dimension": 2, "bodies": bodies,
        "loads": [rope("expression", 0, json!({"length": "1.8-0.4*t", "damping_time": 0.1})),
                  rope("listed", 1, json!({"length": table, "damping_time": 0.1}))],
        "outputs": [{"kind": "tension", "load": "expression"}, {"kind": "tension", "load": "listed"},
                    {"kind": "acceleration", "marker": "b0.c"}, {"kind": "acceleration", "marker": "b1.c"}]});
    let tension = |length: f64, rate: f64| 40.0 / length * (2.0 - length - 0.1 * rate);
    let (first, second) = (tension(1.8 - 0.4 * T, -0.4), tension(1.2 + T - 0.1, 1.0));
    Specimen::new("courses", scene)
        .from(T)
        .claim("expression.tension", "N", first)
        .claim("listed.tension", "N", second)
        .vector("b0.c.acceleration", "m/s2", pulled(first)[1])
        .vector("b1.c.acceleration", "m/s2", pulled(second)[1])
}

/// Drums of 0.25 m that wind up and pay out at 2 rad/s.
fn drums() -> Specimen {
    let drum = |name: &str, x: f64| {
        json!({"element": "rigid", "name": name, "mass": 3.0, "inertia": 0.5, "position": [x, -2.0], "motion": {"spin": 2.0},
            "markers": {"c": [0.0, 0.0]}})
    };
    let axle =
        |name: &str, of: &str| json!({"name": name, "kind": "revolute", "markers": ["ground", of]});
    let still = [[0.0, 0.0]; 2];
    let mut bodies: Vec<Value> = (0..2).flat_map(|k| pair(k, still)).collect();
    bodies.extend([drum("in", 0.0), drum("out", 1.0), extra()]);
    let wound = |name: &str, k: usize, joint: &str, radius: f64| {
        rope(
            name,
            k,
            json!({"length": 1.6, "damping_time": 0.05, "drum": joint, "drum_radius": radius}),
        )
    };
    let scene = json!({
        "name": "drums", "dimension": 2, "bodies": bodies, "joints": [axle("one", "in.c"), axle("two", "out.c")],
        "loads": [wound("hauled", 0, "one", 0.25), wound("slacked", 1, "two", -0.25)],
        "outputs": [{"kind": "tension", "load": "hauled"}, {"kind": "tension", "load": "slacked"},
                    {"kind": "acceleration", "marker": "b0.c"}, {"kind": "acceleration", "marker": "b1.c"},
                    {"kind": "angular_acceleration", "joint": "one"}, {"kind": "angular_acceleration", "joint": "two"}]});
    let tension = |radius: f64| 40.0 / 1.6 * (0.4 + 0.05 * 2.0 * radius);
    let slowed = |radius: f64| -(tension(radius) + 20.0 * (0.4_f64 / 1.6).powi(2)) * radius / 0.5;
    Specimen::new("drums", scene)
        .claim("hauled.tension", "N", tension(0.25))
        .claim("slacked.tension", "N", tension(-0.25))
        .vector("b0.c.acceleration", "m/s2", pulled(tension(0.25))[1])
        .vector("b1.c.acceleration", "m/s2", pulled(tension(-0.25))[1])
        .claim("one.angular_acceleration", "rad/s2", slowed(0.25))
        .claim("two.angular_acceleration", "rad/s2", slowed(-0.25))
}

/// A length that an input sets, and tensions of other loads that pull along a line.
fn steered() -> Specimen {
    let still = [[0.0, 0.0]; 2];
    let mut bodies = pair(0, still).to_vec();
    bodies.push(extra());
    let to = |name: &str, kind: &str, mut keys: Value| {
        keys["name"] = json!(name);
        keys["kind"] = json!(kind);
        keys["markers"] = json!(["ground", "b0.c"]);
        keys["point"] = json!([1.6, 0.0]);
        keys
    };
    let scene = json!({
        "name": "steered", "dimension": 2, "bodies": bodies,
        "loads": [rope("rope", 0, json!({"length": 1.9})), to("spring", "spring_damper", json!({"stiffness": 5.0, "length": 0.5})),
                  to("table", "table_spring", json!({"spring": [[0.5, 0.0], [1.0, 2.0]]})),
                  to("law", "force_law", json!({"force": "3*x^2"})),
                  // One whose tension is not read, so that the others could be read of it.
                  to("spare", "spring_damper", json!({"stiffness": 1.0, "length": 0.7}))],
        "inputs": [{"kind": "rest_length", "load": "rope", "start": [1.6]}],
        "outputs": [{"kind": "tension", "load": "rope"}, {"kind": "tension", "load": "spring"}, {"kind": "tension", "load": "table"},
                    {"kind": "tension", "load": "law"}]});
    Specimen::new("steered", scene)
        .claim("rope.tension", "N", 40.0 / 1.6 * 0.4)
        .claim("spring.tension", "N", 5.0 * 0.3)
        .claim("table.tension", "N", 1.2)
        .claim("law.tension", "N", 3.0 * 0.64)
}
