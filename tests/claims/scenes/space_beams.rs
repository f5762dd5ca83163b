//! Beams: all that holds of rods whose sections do not shear, and shear, whole matrices, rotary inertia.

use std::f64::consts::PI;

use nalgebra::{Matrix6, Vector3, Vector6};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::{space_rods, tapers};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let rods = space_rods::statics().into_iter().chain(tapers::rods());
    let mut all: Vec<Specimen> = rods.map(as_beams).collect();
    all.extend([false, true].map(sheared));
    all.extend([false, true].map(whole));
    all.extend([false, true].map(turning_matrices));
    all.extend([turning(), damped()]);
    all
}

/// The same with rods as beams; sections by numbers so stiff in shear that it does not count.
fn as_beams(rods: Specimen) -> Specimen {
    let mut beams = rods;
    beams.name = Box::leak(format!("{}, as beam", beams.name).into_boxed_str());
    for body in beams.scene["bodies"].as_array_mut().expect("bodies") {
        if body["element"] != "rod" {
            continue;
        }
        body["element"] = json!("beam");
        let mut sections: Vec<&mut Value> = Vec::new();
        let keys = body.as_object_mut().expect("a body").iter_mut();
        for (key, value) in keys {
            match key.as_str() {
                "section" => sections.push(value),
                "stations" => {
                    let stations = value.as_array_mut().into_iter().flatten();
                    sections.extend(stations.map(|station| &mut station["section"]));
                }
                _ => {}
            }
        }
        for section in sections
            .into_iter()
            .filter(|section| section["area"].is_number())
        {
            section["shear_factors"] = json!([30.0, 30.0]);
        }
    }
    beams
}

const YOUNG: f64 = 3.0e6;
const SHEAR: f64 = 1.2e6;
const DENSITY: f64 = 700.0;
const LENGTH: f64 = 0.4;
/// So small that deflections are linear in them, to 1e-7.
const FORCES: [f64; 2] = [3e-2, -2e-2];

/// A beam along x with the first axis along y, clamped.
fn body(name: &str, place: f64) -> Value {
    json!({"name": name, "element": "beam", "elements": 16, "axial": "waves",
           "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": DENSITY},
           "axis": [0.0, 1.0, 0.0], "shape": {"line": {"from": [0.0, place, 0.0], "to": [LENGTH, place, 0.0]}},
           "markers": {"root": 0.0, "tip": 1.0}})
}

fn clamped(names: &[&str], bodies: Vec<Value>, load: impl Fn(&str) -> Vec<Value>) -> Value {
    let joint = |name: &&str| json!({"name": format!("wall_{name}"), "kind": "weld", "markers": ["ground", format!("{name}.root")]});
    let joints: Vec<Value> = names.iter().map(joint).collect();
    let loads: Vec<Value> = names.iter().flat_map(|name| load(name)).collect();
    let read = |name: &&str| {
        [
            json!({"kind": "position", "marker": format!("{name}.tip")}),
            json!({"kind": "orientation", "marker": format!("{name}.tip")}),
        ]
    };
    let outputs: Vec<Value> = names.iter().flat_map(read).collect();
    json!({"name": "beams", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": bodies, "joints": joints, "loads": loads,
           "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-10}, "outputs": outputs})
}

fn push(name: &str) -> Vec<Value> {
    vec![
        json!({"name": format!("push_{name}"), "kind": "force", "marker": format!("{name}.tip"),
                "value": [0.0, FORCES[0], FORCES[1]]}),
    ]
}

/// Deflection at the end: the integral of `F (L - x)^2 / (E I) + F / (k G A)`, by Simpson's rule.
fn deflection(force: f64, bending: impl Fn(f64) -> f64, shear: impl Fn(f64) -> f64) -> f64 {
    let pieces = 2000;
    let h = 1.0 / f64::from(pieces);
    let at = |s: f64| {
        let arm = LENGTH * (1.0 - s);
        force * (arm * arm / bending(s) + 1.0 / shear(s))
    };
    let piece = |k: i32| {
        let s = h * f64::from(k);
        (at(s) + 4.0 * at(s + 0.5 * h) + at(s + h)) * h / 6.0
    };
    LENGTH * (0..pieces).map(piece).sum::<f64>()
}

/// Cowper's factor (1966) of a shape for shear along its first axis, and its area and second moments.
fn cowper(shape: &str, [a, b]: [f64; 2]) -> ([f64; 2], f64, [f64; 2]) {
    let nu = 0.5 * YOUNG / SHEAR - 1.0;
    match shape {
        "rectangle" => {
            let factor = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
            let area = a * b;
            (
                [factor; 2],
                area,
                [area * b * b / 12.0, area * a * a / 12.0],
            )
        }
        "ellipse" => {
            let factor = |n: f64| {
                12.0 * (1.0 + nu) * n * n * (3.0 * n * n + 1.0)
                    / ((40.0 + 37.0 * nu) * n.powi(4) + (16.0 + 10.0 * nu) * n * n + nu)
            };
            let area = 0.25 * PI * a * b;
            let moments = [area * b * b / 16.0, area * a * a / 16.0];
            ([factor(a / b), factor(b / a)], area, moments)
        }
        "circle" => {
            let area = PI * a * a;
            let factor = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
            ([factor; 2], area, [0.25 * area * a * a; 2])
        }
        _ => {
            let m = (b / a) * (b / a);
            let square = (1.0 + m) * (1.0 + m);
            let factor =
                6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m);
            let area = PI * (a * a - b * b);
            ([factor; 2], area, [0.25 * area * (a * a + b * b); 2])
        }
    }
}

/// A section by numbers, times this.
fn numbers(t: f64) -> Value {
    json!({"area": 0.01 * t, "second_moments": [9e-6 * t, 6e-6 * t], "torsion_constant": 1e-5,
           "shear_factors": [0.7 * t, 0.4 * t]})
}

/// Short cantilevers bend and shear: shapes with Cowper's factors and with given ones, and numbers; uniform, or along stations.
fn sheared(is_tapered: bool) -> Specimen {
    let shapes = [
        ("rectangle", ["width", "height"], [0.10, 0.07]),
        ("ellipse", ["width", "height"], [0.08, 0.12]),
        ("circle", ["radius", ""], [0.05, 0.0]),
        ("tube", ["radius", "inner_radius"], [0.06, 0.03]),
    ];
    // Lengths of shapes and factors at the last end, over those at the first.
    let taper = |s: f64| if is_tapered { 1.0 - 0.3 * s } else { 1.0 };
    let place = |name: &str, k: usize, section: &dyn Fn(f64) -> Value| {
        let mut made = body(name, k as f64);
        if is_tapered {
            let station = |at: f64| json!({"at": at, "section": section(at)});
            made["stations"] = json!([station(0.0), station(1.0)]);
        } else {
            made["section"] = section(0.0);
        }
        made
    };
    let section = |k: usize, s: f64, factors: Option<[f64; 2]>| {
        let (shape, keys, lengths) = shapes[k];
        let mut of = json!({});
        for (key, length) in keys.iter().zip(lengths).filter(|(key, _)| !key.is_empty()) {
            of[key] = json!(length * taper(s));
        }
        let mut section = json!({"shape": {}});
        section["shape"][shape] = of;
        if let Some(factors) = factors {
            section["shear_factors"] = json!(factors.map(|factor| factor * taper(s)));
        }
        section
    };
    let numbers = |s: f64| numbers(taper(s));
    let own = [0.5, 0.9];
    let names = ["rectangle", "ellipse", "circle", "tube", "own", "numbers"];
    let by_shape = (0..4).map(|k| place(names[k], k, &|s| section(k, s, None)));
    let mut bodies: Vec<Value> = by_shape.collect();
    bodies.push(place("own", 4, &|s| section(0, s, Some(own))));
    bodies.push(place("numbers", 5, &numbers));
    let title = if is_tapered { "tapered shear" } else { "shear" };
    let mut specimen = Specimen::new(title, clamped(&names, bodies, push));
    for (k, name) in names.iter().enumerate() {
        // Shear along the first axis, y, bends about the second.
        let of = |s: f64, axis: usize| -> [f64; 2] {
            let t = taper(s);
            if k == 5 {
                let ([a, i, j], [p, q]) = ([0.01 * t, 9e-6 * t, 6e-6 * t], [0.7 * t, 0.4 * t]);
                return [[YOUNG * j, p * SHEAR * a], [YOUNG * i, q * SHEAR * a]][axis];
            }
            let (shape, _, lengths) = shapes[k % 4];
            let (factors, area, [first, second]) = cowper(shape, lengths.map(|l| l * t));
            let factors = if k == 4 { own.map(|f| f * t) } else { factors };
            [YOUNG * [second, first][axis], factors[axis] * SHEAR * area]
        };
        for axis in 0..2 {
            let value = deflection(FORCES[axis], |s| of(s, axis)[0], |s| of(s, axis)[1]);
            let place = if axis == 0 { k as f64 } else { 0.0 };
            let (name, within) = (
                format!("{name}.tip.position[{}]", axis + 2),
                1e-4 * value.abs(),
            );
            specimen = specimen.claim_within(&name, "m", place + value, within);
        }
    }
    specimen
}

/// Stiffness about a point of the section, and that point.
const WHOLE: [[f64; 6]; 6] = [
    [2.0e4, 2.5e3, -2.0e3, 4.0e2, 5.0e2, -3.0e2],
    [2.5e3, 8.0e3, 1.2e3, -2.5e2, 3.0e2, 2.0e2],
    [-2.0e3, 1.2e3, 5.0e3, 2.0e2, -2.4e2, 1.8e2],
    [4.0e2, -2.5e2, 2.0e2, 2.0e2, 5.0e1, -3.0e1],
    [5.0e2, 3.0e2, -2.4e2, 5.0e1, 3.0e2, 4.0e1],
    [-3.0e2, 2.0e2, 1.8e2, -3.0e1, 4.0e1, 1.6e2],
];
const ABOUT: [f64; 2] = [0.02, -0.03];

/// Inertia per length about that point: mass `m` with the centre on the line, at minus the point from there, and moments of inertia
/// about it with the product of a section across the line.
fn inertia_about() -> ([[f64; 6]; 6], f64, [[f64; 3]; 3]) {
    let mass = 5.0;
    let own = [[0.05, 0.0, 0.0], [0.0, 0.03, 0.005], [0.0, 0.005, 0.02]];
    let [y, z] = ABOUT.map(|way| -way);
    // Of velocities `v + w x c`, momentum and moment of momentum, `c = (0, y, z)`.
    let mut rows = [[0.0; 6]; 6];
    for k in 0..3 {
        rows[k][k] = mass;
    }
    let cross = [[0.0, -z, y], [z, 0.0, 0.0], [-y, 0.0, 0.0]];
    for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
        rows[3 + i][k] = mass * cross[i][k];
        rows[i][3 + k] = -mass * cross[i][k];
        let square: f64 = (0..3).map(|j| -cross[i][j] * cross[j][k]).sum();
        rows[3 + i][3 + k] = own[i][k] + mass * square;
    }
    (rows, mass, own)
}

fn matrices() -> Value {
    json!({"stiffness": WHOLE, "inertia": inertia_about().0, "about": ABOUT})
}

fn place_matrices(is_at_stations: bool, made: &mut Value) {
    if is_at_stations {
        let stations = [0.0, 1.0].map(|at| json!({"at": at, "section": matrices()}));
        made["stations"] = json!(stations);
    } else {
        made["section"] = matrices()
    }
}

/// Displacement and rotation of the tip of a clamped beam of this length along x under a force and a moment there: integrals of strains,
/// found with the stiffness about a point of the section.
pub fn moved_tip(
    (stiffness, point): (&[[f64; 6]; 6], Vector3<f64>),
    length: f64,
    [force, moment]: [Vector3<f64>; 2],
) -> (Vector3<f64>, Vector3<f64>) {
    let compliance = Matrix6::from_fn(|r, c| stiffness[r][c])
        .try_inverse()
        .expect("stiffness");
    let (mut way, mut turn) = (Vector3::zeros(), Vector3::zeros());
    let pieces = 1000;
    for k in 0..pieces {
        // Of degree 2 in x: the midpoint rule errs by 1e-7.
        let x = length * (f64::from(k) + 0.5) / f64::from(pieces);
        let arm = Vector3::new(length - x, 0.0, 0.0);
        let about = moment + (arm - point).cross(&force);
        let mut stress = Vector6::zeros();
        stress.fixed_rows_mut::<3>(0).copy_from(&force);
        stress.fixed_rows_mut::<3>(3).copy_from(&about);
        let strain = compliance * stress * (length / f64::from(pieces));
        let [stretch, bend] =
            [0, 3].map(|row| -> Vector3<f64> { strain.fixed_rows::<3>(row).into() });
        // Of the point; the tip is further by the arm.
        way += stretch + bend.cross(&(arm - point));
        turn += bend;
    }
    (way, turn)
}

/// Forces and a moment on the tip of a beam whose section is a whole matrix about another line: displacements and rotations are integrals of
/// strains, found about that line.
fn whole(is_at_stations: bool) -> Specimen {
    let force = Vector3::new(5e-2, 4e-2, -3e-2);
    let moment = Vector3::new(8e-3, -6e-3, 7e-3);
    let mut made = body("beam", 0.0);
    made["material"] = json!({});
    place_matrices(is_at_stations, &mut made);
    let load = |_: &str| {
        vec![
            json!({"name": "pull", "kind": "force", "marker": "beam.tip", "value": array(force)}),
            json!({"name": "turn", "kind": "moment", "marker": "beam.tip", "value": array(moment)}),
        ]
    };
    let scene = clamped(&["beam"], vec![made], load);
    let point = Vector3::new(0.0, ABOUT[0], ABOUT[1]);
    let (way, turn) = moved_tip((&WHOLE, point), LENGTH, [force, moment]);
    let title = if is_at_stations {
        "whole matrices at stations"
    } else {
        "whole matrices"
    };
    let mut specimen = Specimen::new(title, scene);
    for (k, name) in ["beam.tip.position[2]", "beam.tip.position[3]"]
        .iter()
        .enumerate()
    {
        specimen = specimen.claim_within(name, "m", way[k + 1], 1e-4 * way.norm());
    }
    let within = 1e-4 * way.norm();
    specimen = specimen.claim_within("beam.tip.position[1]", "m", LENGTH + way.x, within);
    // e2.z, -e1.z and e1.y of small rotations.
    let angles = [("[8]", turn.x), ("[7]", -turn.y), ("[4]", turn.z)];
    for (place, angle) in angles {
        let name = format!("beam.tip.orientation{place}");
        specimen = specimen.claim_within(&name, "", angle, 1e-4 * turn.norm());
    }
    specimen
}

/// A free beam that rotates as a whole has the energy and the angular momentum of a body with its line's mass and the rotary inertia of its
/// sections.
fn turning() -> Specimen {
    let mut made = body("beam", 0.0);
    let [area, first, second] = [0.01, 9e-6, 6e-6];
    made["section"] = json!({"area": area, "second_moments": [first, second], "torsion_constant": 1e-5,
                             "shear_factors": [0.7, 0.4]});
    let line = DENSITY * area * LENGTH.powi(3) / 12.0;
    let about = [first + second, first, second].map(|moment| DENSITY * moment * LENGTH);
    let inertia = [about[0], about[1] + line, about[2] + line];
    // Its sections' axes are those of space.
    spun("turning beam", made, |w| {
        Vector3::new(inertia[0] * w.x, inertia[1] * w.y, inertia[2] * w.z)
    })
}

/// The same with a whole matrix.
fn turning_matrices(is_at_stations: bool) -> Specimen {
    let mut made = body("beam", 0.0);
    made["material"] = json!({});
    place_matrices(is_at_stations, &mut made);
    let (_, mass, own) = inertia_about();
    let line = mass * LENGTH.powi(3) / 12.0;
    let title = if is_at_stations {
        "turning whole matrices at stations"
    } else {
        "turning whole matrices"
    };
    spun(title, made, |w| {
        let row = |k: usize| (0..3).map(|j| own[k][j] * w[j]).sum::<f64>() * LENGTH;
        Vector3::new(row(0), row(1) + line * w.y, row(2) + line * w.z)
    })
}

fn spun(
    title: &'static str,
    mut made: Value,
    momentum: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Specimen {
    let spin = Vector3::new(0.7, -0.4, 0.9);
    // The centre stands still at the origin.
    made["shape"] =
        json!({"line": {"from": [-0.5 * LENGTH, 0.0, 0.0], "to": [0.5 * LENGTH, 0.0, 0.0]}});
    let start = spin.cross(&Vector3::new(-0.5 * LENGTH, 0.0, 0.0));
    made["motion"] = json!({"velocity": array(start), "spin": array(spin)});
    let scene = json!({"name": "beam", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [made],
        "outputs": [{"kind": "energy"}, {"kind": "momentum"}]});
    let found = momentum(&spin);
    let specimen = Specimen::new(title, scene).claim("energy.kinetic", "J", 0.5 * spin.dot(&found));
    vector(specimen, "angular_momentum", "N.m.s", found)
}

/// A clamped beam that is stiff but for torsion rotates at `w = pi c / (2 L)`, `c^2 = G J / (rho (I1 + I2))`; with damping in proportion to
/// stiffness that decays at `tau w^2 / 2`.
fn damped() -> Specimen {
    let (time, moment, torsion) = (0.02, 1e-3, 1e-6);
    let mut made = body("beam", 0.0);
    made["material"]["damping_time"] = json!(time);
    made["section"] = json!({"area": 0.01, "second_moments": [moment, moment], "torsion_constant": torsion,
                             "shear_factors": [30.0, 30.0]});
    let mut scene = clamped(&["beam"], vec![made], |_| Vec::new());
    scene["outputs"] = json!([{"kind": "eigenvalue", "count": 1}]);
    let speed = (SHEAR * torsion / (DENSITY * 2.0 * moment)).sqrt();
    let frequency = 0.5 * PI * speed / LENGTH;
    let decay = 0.5 * time * frequency * frequency;
    Specimen::new("damped beam", scene).claim_within(
        "eigenvalue.decay_rate[1]",
        "1/s",
        decay,
        1e-4 * decay,
    )
}
