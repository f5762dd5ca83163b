//! Beams in the plane: shear, rotary inertia, whole matrices, in closed form.

use std::f64::consts::PI;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::space_beams::moved_tip;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    let mut all: Vec<Specimen> = [false, true].map(sheared).into();
    all.extend([false, true].map(whole));
    all.extend([false, true].map(turning));
    all.extend([vibrating(), turned_along()]);
    all
}

const YOUNG: f64 = 3.0e6;
const SHEAR: f64 = 1.2e6;
const DENSITY: f64 = 700.0;
const LENGTH: f64 = 0.4;
/// So small that deflections are linear in it, to 1e-7.
const FORCE: f64 = 3e-2;

fn body(name: &str, place: f64) -> Value {
    json!({"name": name, "element": "beam", "elements": 16, "axial": "waves",
           "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": DENSITY},
           "shape": {"line": {"from": [0.0, place], "to": [LENGTH, place]}},
           "markers": {"root": 0.0, "tip": 1.0}})
}

fn clamped(names: &[&str], bodies: &[Value], loads: &[Value]) -> Value {
    let joint = |name: &&str| json!({"name": format!("wall_{name}"), "kind": "weld", "markers": ["ground", format!("{name}.root")]});
    let joints: Vec<Value> = names.iter().map(joint).collect();
    let read = |name: &&str| {
        ["position", "angle"].map(|kind| json!({"kind": kind, "marker": format!("{name}.tip")}))
    };
    let outputs: Vec<Value> = names.iter().flat_map(read).collect();
    json!({"name": "planar_beams", "dimension": 2, "gravity": [0.0, 0.0], "bodies": bodies, "joints": joints, "loads": loads,
           "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-10}, "outputs": outputs})
}

/// The integral over the length by Simpson's rule.
fn integral(of: impl Fn(f64) -> f64) -> f64 {
    let pieces = 2000;
    let h = LENGTH / f64::from(pieces);
    let piece = |k: i32| {
        let x = h * f64::from(k);
        (of(x) + 4.0 * of(x + 0.5 * h) + of(x + h)) * h / 6.0
    };
    (0..pieces).map(piece).sum()
}

/// Area, second moment against bending in the plane and Cowper's factor (1966) for shear in it, of shapes that are `a` wide across
/// the plane and `b` high in it, or have the radii `a` and `b`.
fn numbers(shape: &str, [a, b]: [f64; 2]) -> [f64; 3] {
    let nu = 0.5 * YOUNG / SHEAR - 1.0;
    let once = 1.0 + nu;
    match shape {
        "rectangle" => {
            let area = a * b;
            [area, area * b * b / 12.0, 10.0 * once / (12.0 + 11.0 * nu)]
        }
        "ellipse" => {
            let (area, n) = (0.25 * PI * a * b, (b / a).powi(2));
            let under = (40.0 + 37.0 * nu) * n * n + (16.0 + 10.0 * nu) * n + nu;
            let factor = 12.0 * once * n * (3.0 * n + 1.0) / under;
            [area, area * b * b / 16.0, factor]
        }
        "circle" => {
            let area = PI * a * a;
            [area, 0.25 * area * a * a, 6.0 * once / (7.0 + 6.0 * nu)]
        }
        _ => {
            let area = PI * (a * a - b * b);
            let (m, second) = ((b / a).powi(2), 0.25 * area * (a * a + b * b));
            let square = (1.0 + m).powi(2);
            let under = (7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m;
            [area, second, 6.0 * once * square / under]
        }
    }
}

/// Shapes with the keys and values of their lengths, m.
const SHAPES: [(&str, [&str; 2], [f64; 2]); 5] = [
    ("rectangle", ["width", "height"], [0.10, 0.07]),
    ("ellipse", ["width", "height"], [0.08, 0.12]),
    ("circle", ["radius", ""], [0.05, 0.0]),
    ("tube", ["radius", "inner_radius"], [0.06, 0.03]),
    ("rectangle", ["width", "height"], [0.10, 0.07]),
];
/// Shear factor given beside the last of them; area, second moment and shear factor given in place of a shape.
const OWN: f64 = 0.5;
const SAID: [f64; 3] = [0.01, 9e-6, 0.7];

/// One of these sections, or numbers after the last; lengths, factors and numbers so many times as large.
fn sheared_section(k: usize, t: f64) -> Value {
    let Some((shape, keys, lengths)) = SHAPES.get(k) else {
        let [area, second, factor] = SAID.map(|number| number * t);
        return json!({"area": area, "second_moment": second, "shear_factor": factor});
    };
    let mut of = json!({});
    for (key, length) in keys.iter().zip(lengths).filter(|(key, _)| !key.is_empty()) {
        of[key] = json!(length * t);
    }
    let mut section = json!({"shape": {}});
    section["shape"][shape] = of;
    if k == 4 {
        section["shear_factor"] = json!(OWN * t);
    }
    section
}

/// Short cantilevers under a force at the end bend by `F (L - x) / (E I)` and shear by `F / (k G A)`: shapes with Cowper's factor and with
/// a given one, and numbers; uniform, or along stations.
fn sheared(is_tapered: bool) -> Specimen {
    // Lengths of shapes, factors and numbers, over those at the first end.
    let taper = |x: f64| {
        if is_tapered {
            1.0 - 0.3 * x / LENGTH
        } else {
            1.0
        }
    };
    let names = ["rectangle", "ellipse", "circle", "tube", "own", "numbers"];
    let place = |k: usize| {
        let mut made = body(names[k], k as f64);
        if is_tapered {
            let station =
                |at: f64| json!({"at": at, "section": sheared_section(k, taper(at * LENGTH))});
            made["stations"] = json!([station(0.0), station(1.0)]);
        } else {
            made["section"] = sheared_section(k, 1.0)
        }
        made
    };
    let bodies: Vec<Value> = (0..names.len()).map(place).collect();
    let push = |name: &&str| {
        json!({"name": format!("push_{name}"), "kind": "force", "marker": format!("{name}.tip"),
               "value": [0.0, FORCE]})
    };
    let loads: Vec<Value> = names.iter().map(push).collect();
    let title = if is_tapered {
        "tapered planar shear"
    } else {
        "planar shear"
    };
    let mut specimen = Specimen::new(title, clamped(&names, &bodies, &loads));
    for (k, name) in names.iter().enumerate() {
        let at = |x: f64| {
            let t = taper(x);
            match SHAPES.get(k) {
                Some((shape, _, lengths)) => {
                    let [area, second, factor] = numbers(shape, lengths.map(|l| l * t));
                    [area, second, if k == 4 { OWN * t } else { factor }]
                }
                None => SAID.map(|number| number * t),
            }
        };
        let angle = integral(|x| FORCE * (LENGTH - x) / (YOUNG * at(x)[1]));
        let way = integral(|x| {
            let ([area, second, factor], arm) = (at(x), LENGTH - x);
            FORCE * (arm * arm / (YOUNG * second) + 1.0 / (factor * SHEAR * area))
        });
        let position = format!("{name}.tip.position[2]");
        specimen = specimen
            .claim_within(&position, "m", k as f64 + way, 1e-4 * way)
            .claim_within(&format!("{name}.tip.angle"), "rad", angle, 1e-4 * angle);
    }
    specimen
}

/// Stiffness about a point of the section, without what would lead out of the plane, and how far that point is along the second axis, which
/// is to the right of the line.
const WHOLE: [[f64; 6]; 6] = [
    [2.0e4, 0.0, -2.0e3, 0.0, 5.0e2, 0.0],
    [0.0, 8.0e3, 0.0, -2.5e2, 0.0, 2.0e2],
    [-2.0e3, 0.0, 5.0e3, 0.0, -2.4e2, 0.0],
    [0.0, -2.5e2, 0.0, 2.0e2, 0.0, -3.0e1],
    [5.0e2, 0.0, -2.4e2, 0.0, 3.0e2, 0.0],
    [0.0, 2.0e2, 0.0, -3.0e1, 0.0, 1.6e2],
];
const ABOUT: f64 = -0.03;
const MASS: f64 = 5.0;
const ROTARY: f64 = 0.03;

/// Inertia per length about that point, with the centre of mass on the line.
fn inertia() -> [[f64; 6]; 6] {
    // Of a point that is `z` along the second axis from there: velocities are `v + w x c`.
    let z = -ABOUT;
    let own = [0.05, ROTARY, 0.02];
    let mut rows = [[0.0; 6]; 6];
    for k in 0..3 {
        (rows[k][k], rows[3 + k][3 + k]) = (MASS, own[k]);
    }
    let pairs = [(0, 1, -z), (1, 0, z)];
    for (row, column, entry) in pairs {
        rows[3 + row][column] = MASS * entry;
        rows[column][3 + row] = MASS * entry;
        rows[3 + row][3 + row] += MASS * z * z;
    }
    rows
}

fn place_matrices(is_at_stations: bool, made: &mut Value) {
    let section = json!({"stiffness": WHOLE, "inertia": inertia(), "about": [0.0, ABOUT]});
    made["material"] = json!({});
    if is_at_stations {
        let stations = [0.0, 1.0].map(|at| json!({"at": at, "section": section}));
        made["stations"] = json!(stations);
    } else {
        made["section"] = section
    }
}

/// Force and moment on the tip of a beam whose section is a whole matrix about another line: displacement and rotation are integrals of
/// strains, found about that line. Axes of the section are x, across the plane, and to the right.
fn whole(is_at_stations: bool) -> Specimen {
    let ([along, across], moment) = ([5e-2, 4e-2], 7e-3);
    let mut made = body("beam", 0.0);
    place_matrices(is_at_stations, &mut made);
    let loads = [
        json!({"name": "pull", "kind": "force", "marker": "beam.tip", "value": [along, across]}),
        json!({"name": "turn", "kind": "moment", "marker": "beam.tip", "value": moment}),
    ];
    let scene = clamped(&["beam"], &[made], &loads);
    let loads = [
        Vector3::new(along, 0.0, -across),
        Vector3::new(0.0, moment, 0.0),
    ];
    let point = Vector3::new(0.0, 0.0, ABOUT);
    let (way, turn) = moved_tip((&WHOLE, point), LENGTH, loads);
    let title = if is_at_stations {
        "planar whole matrices at stations"
    } else {
        "planar whole matrices"
    };
    let within = 1e-4 * way.norm();
    Specimen::new(title, scene)
        .claim_within("beam.tip.position[1]", "m", LENGTH + way.x, within)
        .claim_within("beam.tip.position[2]", "m", -way.z, within)
        .claim_within("beam.tip.angle", "rad", turn.y, 1e-4 * turn.norm())
}

/// A free beam that rotates as a whole has the energy and the angular momentum of a body with its line's mass and the rotary inertia of its
/// sections; so it has where these are given as whole matrices.
fn turning(is_at_stations: bool) -> Specimen {
    let mut made = body("beam", 0.0);
    let (mass, rotary, title) = if is_at_stations {
        place_matrices(true, &mut made);
        (MASS, ROTARY, "turning planar beam of whole matrices")
    } else {
        let (area, second) = (0.01, 9e-6);
        made["section"] = json!({"area": area, "second_moment": second, "shear_factor": 0.7});
        (DENSITY * area, DENSITY * second, "turning planar beam")
    };
    let spin = 0.9;
    // The centre stands still at the origin.
    made["shape"] = json!({"line": {"from": [-0.5 * LENGTH, 0.0], "to": [0.5 * LENGTH, 0.0]}});
    made["motion"] = json!({"velocity": [0.0, -0.5 * LENGTH * spin], "spin": spin});
    let scene = json!({"name": "beam", "gravity": [0.0, 0.0], "dimension": 2, "bodies": [made],
        "outputs": [{"kind": "energy"}, {"kind": "momentum"}]});
    let inertia = mass * LENGTH.powi(3) / 12.0 + rotary * LENGTH;
    Specimen::new(title, scene)
        .claim("energy.kinetic", "J", 0.5 * inertia * spin * spin)
        .claim("angular_momentum", "N.m.s", inertia * spin)
}

/// A beam on pins vibrates in sines: with `b = pi / L` and `S = k G A`, `(S b^2 - rho A w^2) (E I b^2 + S - rho I w^2) = (S b)^2` (S. P.
/// Timoshenko, Phil. Mag. 41 (1921)); with damping in proportion to stiffness that decays at `tau w^2 / 2`.
fn vibrating() -> Specimen {
    let ([area, second, factor], time) = ([0.01, 2e-5, 0.7], 1e-4);
    let mut made = body("beam", 0.0);
    made["material"]["damping_time"] = json!(time);
    made["section"] = json!({"area": area, "second_moment": second, "shear_factor": factor});
    let scene = json!({"name": "beam", "gravity": [0.0, 0.0], "dimension": 2, "bodies": [made],
        "joints": [{"name": "left", "kind": "revolute", "markers": ["ground", "beam.root"]},
                   {"name": "right", "kind": "point_on_line", "markers": ["ground", "beam.tip"],
                    "direction": [1.0, 0.0]}],
        "outputs": [{"kind": "eigenvalue", "count": 2}, {"kind": "natural_frequency", "count": 1}]});
    let (b, shear) = (PI / LENGTH, factor * SHEAR * area);
    let [line, rotary] = [area, second].map(|number| DENSITY * number);
    let [a, c] = [line * rotary, shear * b * b * YOUNG * second * b * b];
    let middle = line * (YOUNG * second * b * b + shear) + rotary * shear * b * b;
    let square = (middle - (middle * middle - 4.0 * a * c).sqrt()) / (2.0 * a);
    let decay = 0.5 * time * square;
    Specimen::new("vibrating planar beam", scene)
        .claim_within(
            "natural_frequency[1]",
            "rad/s",
            square.sqrt(),
            1e-5 * square.sqrt(),
        )
        .claim_within("eigenvalue.decay_rate[1]", "1/s", decay, 1e-4 * decay)
}

/// Moments along a clamped beam bend it: those of `m (1 + s)` by `M = m (L - x) (1 + (1 + x / L) / 2)`. There is no shear force.
fn turned_along() -> Specimen {
    let (second, size) = (9e-6, 2e-2);
    let mut made = body("beam", 0.0);
    made["section"] = json!({"area": 0.01, "second_moment": second, "shear_factor": 0.7});
    let load = json!({"name": "turn", "kind": "distributed_moment", "body": "beam",
                      "value": format!("{size}*(1 + s)")});
    let moment = |x: f64| size * (LENGTH - x) * (1.0 + 0.5 * (1.0 + x / LENGTH));
    let angle = integral(|x| moment(x) / (YOUNG * second));
    let way = integral(|x| moment(x) * (LENGTH - x) / (YOUNG * second));
    Specimen::new("planar moments along", clamped(&["beam"], &[made], &[load]))
        .claim_within("beam.tip.position[2]", "m", way, 1e-4 * way)
        .claim_within("beam.tip.angle", "rad", angle, 1e-4 * angle)
}
