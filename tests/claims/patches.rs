//! Keys of plates and shells, of their edges and of loads on them: claims in closed form. Most are of strips under small loads, of which
//! bicubic elements find the displacements of nodes exactly.

use serde_json::{Value, json};

use crate::laws::runs::Run;

/// Length and width of the strip, m.
const LENGTH: f64 = 2.0;
const WIDTH: f64 = 0.5;
/// Thickness, m, Young's modulus, Pa, Poisson's ratio and density, kg/m^3.
const THICKNESS: f64 = 0.02;
const YOUNG: f64 = 3e9;
const RATIO: f64 = 0.3;
const DENSITY: f64 = 1200.0;

/// A run of a scene with parameters or inputs set.
fn started_with(scene: &Value, values: &[(&str, f64)]) -> Run {
    let mut run = Run::ready(scene);
    values
        .iter()
        .for_each(|(name, value)| run.set(name, *value));
    run.start();
    run
}

fn near(found: f64, expected: f64, within: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= within,
        "expected {expected}, found {found}, {off} off"
    );
}

fn all_near(found: [f64; 3], expected: [f64; 3], within: f64) {
    for (found, expected) in found.into_iter().zip(expected) {
        near(found, expected, within);
    }
}

/// A body of an element with a surface and a mesh, of the material above unless keys say otherwise.
fn body(element: &str, surface: &Value, mesh: [u32; 2], keys: &Value) -> Value {
    let mut body = json!({"name": "p", "element": element, "surface": surface, "mesh": mesh,
        "material": {"youngs_modulus": YOUNG, "poisson_ratio": RATIO, "density": DENSITY},
        "thickness": THICKNESS, "markers": {"tip": [1, 0.5]}});
    for (key, value) in keys.as_object().into_iter().flatten() {
        if value.is_null() {
            body.as_object_mut().expect("an object").remove(key);
        } else {
            body[key] = value.clone();
        }
    }
    body
}

/// The strip along `x` that cannot contract: its long edges are planes of symmetry. It stands in equilibrium under a force per area.
fn strip(keys: &Value, value: [f64; 3]) -> Value {
    let surface =
        json!({"rectangle": {"corner": [0, 0, 0], "edges": [[LENGTH, 0, 0], [0, WIDTH, 0]]}});
    let edge = |name: &str, kind: &str, edge: &str| json!({"name": name, "kind": kind, "edges": ["ground", format!("p.{edge}")]});
    let mut sides = [
        edge("left", "symmetry", "s2=0"),
        edge("right", "symmetry", "s2=1"),
    ];
    for side in &mut sides {
        side["normal"] = json!([0, 1, 0]);
    }
    let [left, right] = sides;
    json!({"name": "strip", "dimension": 3, "bodies": [body("plate", &surface, [3, 1], keys)],
        "joints": [edge("root", "clamped", "s1=0"), left, right],
        "loads": [{"name": "push", "kind": "area_force", "body": "p", "value": value}],
        "initial": "static_equilibrium",
        "outputs": [{"kind": "position", "marker": "p.tip"}, {"kind": "acceleration", "marker": "p.tip"}]})
}

fn tip(scene: &Value) -> [f64; 3] {
    let [x, y, z] = Run::started(scene).read_all::<3>("p.tip.position");
    [x - LENGTH, y - 0.5 * WIDTH, z]
}

/// Stiffness against stretching and bending of a strip of the material that cannot contract.
fn stiffness(young: f64, ratio: f64, thickness: f64) -> [f64; 2] {
    let stretching = young * thickness / (1.0 - ratio * ratio);
    [stretching, stretching * thickness * thickness / 12.0]
}

/// `material`, `thickness`, `clamped`, `symmetry` and `area_force`: tip of a strip by a force along it and one across it.
#[test]
fn strips_stretch_and_bend() {
    let claims = |young: f64, ratio: f64, thickness: f64| {
        let keys = json!({"thickness": thickness,
            "material": {"youngs_modulus": young, "poisson_ratio": ratio, "density": DENSITY}});
        let [stretching, bending] = stiffness(young, ratio, thickness);
        let along = 1e-6 * stretching;
        let wanted = along * LENGTH.powi(2) / (2.0 * stretching);
        near(
            tip(&strip(&keys, [along, 0.0, 0.0]))[0],
            wanted,
            1e-5 * wanted,
        );
        let across = 1e-5 * bending;
        let wanted = across * LENGTH.powi(4) / (8.0 * bending);
        near(
            tip(&strip(&keys, [0.0, 0.0, across]))[2],
            wanted,
            1e-5 * wanted,
        );
    };
    claims(YOUNG, RATIO, THICKNESS);
    claims(2.0 * YOUNG, -0.2, 0.7 * THICKNESS)
}

/// Parameters do what their keys do.
#[test]
fn parameters_are_keys() {
    let [_, bending] = stiffness(YOUNG, RATIO, THICKNESS);
    let scene = strip(&json!({}), [0.0, 0.0, 1e-5 * bending]);
    let deflection = |young: f64, ratio: f64, thickness: f64| {
        let now = stiffness(young, ratio, thickness)[1];
        1e-5 * bending * LENGTH.powi(4) / (8.0 * now)
    };
    for (name, value, wanted) in [
        ("p.youngs_modulus", 2e9, deflection(2e9, RATIO, THICKNESS)),
        ("p.poisson_ratio", 0.1, deflection(YOUNG, 0.1, THICKNESS)),
        ("p.thickness", 0.03, deflection(YOUNG, RATIO, 0.03)),
    ] {
        let found = started_with(&scene, &[(name, value)]).read_all::<3>("p.tip.position")[2];
        near(found, wanted, 1e-5 * wanted);
    }
    // Without edges and in no equilibrium it is accelerated as a whole.
    let mut free = scene.clone();
    (free["joints"], free["initial"]) = (json!([]), json!("undeformed"));
    let found = started_with(&free, &[("p.density", 700.0)]).read_all::<3>("p.tip.acceleration");
    let wanted = 1e-5 * bending / (700.0 * THICKNESS);
    near(found[2], wanted, 1e-9 * wanted);
}

/// `damping_time`, of a material and of matrices, and its parameter: the power that a strip dissipates as it begins to vibrate.
#[test]
fn damping_slows_a_strip() {
    let [_, bending] = stiffness(YOUNG, RATIO, THICKNESS);
    let damped = |time: f64| json!({"youngs_modulus": YOUNG, "poisson_ratio": RATIO, "density": DENSITY, "damping_time": time});
    let lost = |keys: &Value, values: &[(&str, f64)]| -> f64 {
        let mut scene = strip(keys, [0.0, 0.0, 1e-3 * bending]);
        scene["initial"] = json!("undeformed");
        scene["outputs"] = json!([{"kind": "work"}]);
        let mut run = started_with(&scene, values);
        run.step(2e-3);
        run.read("energy.dissipated")
    };
    let one = lost(&json!({"material": damped(1e-6)}), &[]);
    assert!(one > 0.0);
    near(
        lost(&json!({"material": damped(2e-6)}), &[]) / one,
        2.0,
        0.02,
    );
    near(
        lost(&json!({}), &[("p.damping_time", 2e-6)]) / one,
        2.0,
        0.02,
    );
    let matrices = matrices();
    let of_matrices = lost(&matrices, &[("p.damping_time", 2e-6)]);
    let mut keys = matrices;
    keys["damping_time"] = json!(1e-6);
    near(of_matrices / lost(&keys, &[]), 2.0, 0.02);
}

/// The section of the material as matrices.
fn matrices() -> Value {
    let part = |size: f64| {
        let shear = 0.5 * (1.0 - RATIO) * size;
        json!([
            [size, RATIO * size, 0],
            [RATIO * size, size, 0],
            [0, 0, shear]
        ])
    };
    let [stretching, bending] = stiffness(YOUNG, RATIO, THICKNESS);
    json!({"material": null, "thickness": null, "area_density": DENSITY * THICKNESS,
        "stiffness": {"A": part(stretching), "D": part(bending)}})
}

/// `stiffness` with `area_density`: a strip of matrices, with and without coupling, and `axis_angle`, which rotates them.
#[test]
fn strips_of_matrices_couple() {
    let (a, d, b) = (5e7, 2e3, 1e5);
    let diagonal = |first: f64, others: f64| json!([[first, 0, 0], [0, others, 0], [0, 0, others]]);
    let keys = |first: f64, angle: f64| {
        json!({"material": null, "thickness": null, "area_density": 20, "axis_angle": angle,
            "stiffness": {"A": diagonal(a, 2.0 * a), "B": diagonal(first, 0.0), "D": diagonal(d, 2.0 * d)}})
    };
    // So small that tension does not stiffen it.
    let load = 1e-9 * a;
    let along = |keys: &Value| tip(&strip(keys, [load, 0.0, 0.0]));
    let found = along(&keys(0.0, 0.0));
    let plain = load * LENGTH.powi(2) / (2.0 * a);
    near(found[0], plain, 1e-4 * plain);
    // N = A e - B k, M = D k - B e = 0.
    let (whole, found) = (a * d - b * b, along(&keys(b, 0.0)));
    near(found[0], plain * a * d / whole, 1e-4 * plain);
    let bent = load * LENGTH.powi(3) * b / (3.0 * whole);
    near(found[2], bent, 1e-4 * bent);
    let quarter = std::f64::consts::FRAC_PI_2;
    let turned = along(&keys(0.0, quarter));
    near(turned[0], 0.5 * plain, 1e-4 * plain);
    let scene = strip(&keys(0.0, 0.0), [load, 0.0, 0.0]);
    let set = started_with(&scene, &[("p.axis_angle", quarter)]).read_all::<3>("p.tip.position");
    near(set[0] - LENGTH, turned[0], 1e-4 * plain);
    let mut free = strip(&keys(0.0, 0.0), [load, 0.0, 0.0]);
    (free["joints"], free["initial"]) = (json!([]), json!("undeformed"));
    let found = Run::started(&free).read_all::<3>("p.tip.acceleration");
    // Strains of rounding against one of 1e-9.
    near(found[0], load / 20.0, 1e-6 * load / 20.0);
}

/// `laminate`: two plies across each other, from the bottom to the top, stretch and bend a strip as their integrals say.
#[test]
fn plies_add_up() {
    let (first, second, ratio, shear, density) = (4e10, 1e10, 0.3, 4e9, 1900.0);
    let (thin, thick) = (2e-3, 5e-3);
    let quarter = std::f64::consts::FRAC_PI_2;
    let ply = |thickness: f64, angle: f64| {
        json!({"material": {"youngs_modulus": [first, second], "poisson_ratio": ratio, "shear_modulus": shear,
            "density": density}, "thickness": thickness, "angle": angle})
    };
    let keys = json!({"material": null, "thickness": null, "laminate": [ply(thin, 0.0), ply(thick, quarter)]});
    let factor = 1.0 / (1.0 - ratio * ratio * second / first);
    let (bottom, top) = (-0.5 * (thin + thick), 0.5 * (thin + thick));
    let between = bottom + thin;
    let sum = |power: i32| {
        let part = |from: f64, to: f64| (to.powi(power) - from.powi(power)) / f64::from(power);
        factor * (first * part(bottom, between) + second * part(between, top))
    };
    let [a, b, d] = [1, 2, 3].map(sum);
    let (load, whole) = (1e-10 * a, a * d - b * b);
    let found = tip(&strip(&keys, [load, 0.0, 0.0]));
    let wanted = [
        load * LENGTH.powi(2) * d / (2.0 * whole),
        load * LENGTH.powi(3) * b / (3.0 * whole),
    ];
    near(found[0], wanted[0], 1e-3 * wanted[0]);
    near(found[2], wanted[1], 1e-3 * wanted[1].abs());
    let load = 1e-4 * a;
    let mut free = strip(&keys, [load, 0.0, 0.0]);
    (free["joints"], free["initial"]) = (json!([]), json!("undeformed"));
    let found = Run::started(&free).read_all::<3>("p.tip.acceleration");
    near(found[0], load / (density * (thin + thick)), 1e-9 * load);
}

/// Twist of a rectangle, of which three corners are held and the fourth is pushed: `w = P a b / 4 D66`. The markers are points.
#[test]
fn corners_twist_a_plate() {
    let shear = 4e9;
    let keys = |given: bool| {
        let markers = json!({"a": [0, 0], "b": [1, 0], "c": [0, 1], "d": [1, 1]});
        let ply = json!({"material": {"youngs_modulus": [4e10, 1e10], "poisson_ratio": 0.3, "shear_modulus": shear,
            "density": 1900}, "thickness": THICKNESS});
        if given {
            json!({"material": null, "thickness": null, "laminate": [ply], "markers": markers})
        } else {
            json!({"markers": markers})
        }
    };
    for (given, modulus) in [(false, 0.5 * YOUNG / (1.0 + RATIO)), (true, shear)] {
        let surface =
            json!({"rectangle": {"corner": [0, 0, 0], "edges": [[LENGTH, 0, 0], [0, WIDTH, 0]]}});
        let pin = |of: &str| json!({"name": of, "kind": "spherical", "markers": ["ground", format!("p.{of}")]});
        let twisting = modulus * THICKNESS.powi(3) / 12.0;
        let push = 1e-3 * twisting;
        let scene = json!({"name": "twist", "dimension": 3, "bodies": [body("shell", &surface, [2, 2], &keys(given))],
            "joints": [pin("a"), pin("b"), pin("c")],
            "loads": [{"name": "push", "kind": "force", "marker": "p.d", "value": [0, 0, push]}],
            "initial": "static_equilibrium", "outputs": [{"kind": "position", "marker": "p.d"}]});
        let found = Run::started(&scene).read_all::<3>("p.d.position")[2];
        let wanted = push * LENGTH * WIDTH / (4.0 * twisting);
        near(found, wanted, 1e-4 * wanted);
    }
}

/// `pinned`, and the load and input `pressure`: a strip between hinges that may slide along it would have a deflection of
/// `5 q L^4 / 384 D`, and one between clamps a fifth of it.
#[test]
fn pressures_bend_a_strip_between_edges() {
    let [_, bending] = stiffness(YOUNG, RATIO, THICKNESS);
    let pressure = 1e-5 * bending;
    let scene = |kind: &str, by_input: bool| {
        let mut scene = strip(
            &json!({"markers": {"tip": [0.5, 0.5]}, "mesh": [4, 1]}),
            [0.0; 3],
        );
        let edge = |name: &str, edge: &str| json!({"name": name, "kind": kind, "edges": ["ground", format!("p.{edge}")]});
        scene["joints"][0] = edge("root", "s1=0");
        let joints = scene["joints"].as_array_mut().expect("a list");
        joints.push(edge("end", "s1=1"));
        if by_input {
            scene["loads"] = json!([]);
            scene["inputs"] = json!([{"kind": "pressure", "body": "p", "start": [pressure]}]);
        } else {
            scene["loads"] =
                json!([{"name": "q", "kind": "pressure", "body": "p", "value": pressure}]);
        }
        scene
    };
    for (kind, part) in [("pinned", 5.0), ("clamped", 1.0)] {
        for by_input in [false, true] {
            let found = Run::started(&scene(kind, by_input)).read_all::<3>("p.tip.position")[2];
            let wanted = part * pressure * LENGTH.powi(4) / (384.0 * bending);
            near(found, wanted, 1e-4 * wanted);
        }
    }
    let mut set = started_with(&scene("pinned", true), &[("p.pressure", 0.0)]);
    near(set.read_all::<3>("p.tip.position")[2], 0.0, 1e-15);
}

/// A body in place of the first edge, of `clamped` and `pinned`: a rib along the middle of the strip, alone loaded, adds its stiffness,
/// `q L^4 / 8 (EI + D b)`.
#[test]
fn ribs_stiffen_a_strip() {
    let [_, bending] = stiffness(YOUNG, RATIO, THICKNESS);
    let (bending, load) = (bending * WIDTH, 1e-5 * bending);
    for (kind, element, part) in [
        ("clamped", "rod", 1.0),
        ("pinned", "rod", 2.0),
        ("pinned", "cable", 4.0),
    ] {
        let moment = part * bending / YOUNG;
        let mut rib = json!({"name": "rib", "element": element, "elements": 6,
            "shape": {"line": {"from": [0, 0.5 * WIDTH, 0], "to": [LENGTH, 0.5 * WIDTH, 0]}},
            "material": {"youngs_modulus": YOUNG, "density": DENSITY}, "section": {"area": 0.01, "second_moment": moment}});
        if element == "rod" {
            rib["material"]["shear_modulus"] = json!(YOUNG);
            rib["section"] = json!({"area": 0.01, "second_moments": [moment, moment], "torsion_constant": moment});
            rib["axis"] = json!([0, 1, 0]);
        }
        let mut scene = strip(&json!({"mesh": [6, 2]}), [0.0; 3]);
        scene["bodies"].as_array_mut().expect("bodies").push(rib);
        let joints = scene["joints"].as_array_mut().expect("joints");
        joints.push(json!({"name": "glue", "kind": kind, "edges": ["rib", "p.s2=0.5"]}));
        scene["loads"] = json!([{"name": "q", "kind": "distributed_force", "body": "rib", "value": [0, 0, load]}]);
        let found = Run::started(&scene).read_all::<3>("p.tip.position")[2];
        let wanted = load * LENGTH.powi(4) / (8.0 * bending * (1.0 + part));
        near(found, wanted, 5e-3 * wanted);
    }
}

/// The input `area_force`, `motion`, and the directions of pressure: a free plate is accelerated as a whole.
#[test]
fn free_plates_are_accelerated() {
    let surface = json!({"rectangle": {"corner": [1, 2, 3], "edges": [[0, 1, 0], [0, 0, 1]]}});
    let keys = json!({"motion": {"velocity": [1, 2, 3], "spin": [0.1, 0, 0]}});
    let outputs = ["position", "velocity", "acceleration", "orientation"];
    let outputs = outputs.map(|kind| json!({"kind": kind, "marker": "p.tip"}));
    let scene = json!({"name": "free", "dimension": 3, "bodies": [body("plate", &surface, [2, 2], &keys)],
        "loads": [{"name": "q", "kind": "pressure", "body": "p", "value": 12}],
        "inputs": [{"kind": "area_force", "body": "p", "start": [2, 3, 4]}],
        "outputs": outputs});
    let mut run = Run::started(&scene);
    all_near(run.read_all::<3>("p.tip.position"), [1.0, 3.0, 3.5], 1e-14);
    // The velocity is that of the corner.
    all_near(
        run.read_all::<3>("p.tip.velocity"),
        [1.0, 2.0 - 0.05, 3.0 + 0.1],
        1e-12,
    );
    // The normal is x. Nothing pulls it to the middle before it has stretched.
    let mass = DENSITY * THICKNESS;
    let wanted = [14.0 / mass, 3.0 / mass, 4.0 / mass];
    all_near(run.read_all::<3>("p.tip.acceleration"), wanted, 1e-9);
    let mut set = started_with(&scene, &[("p.area_force[1]", -12.0)]);
    near(set.read_all::<3>("p.tip.acceleration")[0], 0.0, 1e-9);
}

/// Markers of all surfaces are where these say, with pads at the mean.
#[test]
fn surfaces_are_as_described() {
    let (sin, cos) = 0.5_f64.sin_cos();
    let cases = [
        (
            json!({"quadrilateral": {"corners": [[0, 0, 0], [2, 0, 0], [3, 2, 0], [0, 1, 0]]}}),
            "plate",
            [1.25, 0.75, 0.0],
        ),
        (
            json!({"annulus": {"center": [1, 0, 0], "normal": [0, 0, 1], "start": [1, 0, 0], "radii": [1, 2], "angle": 1}}),
            "plate",
            [1.0 + 1.5 * cos, 1.5 * sin, 0.0],
        ),
        (
            json!({"cylinder": {"from": [0, 0, 1], "to": [0, 0, 3], "radius": 2, "start": [1, 0, 0], "angle": 1}}),
            "shell",
            [2.0 * cos, 2.0 * sin, 2.0],
        ),
        (
            json!({"cone": {"from": [0, 0, 1], "to": [0, 0, 3], "radii": [2, 1], "start": [1, 0, 0], "angle": 1}}),
            "shell",
            [1.5 * cos, 1.5 * sin, 2.0],
        ),
        (
            json!({"sphere": {"center": [0, 0, 1], "radius": 2, "axis": [0, 0, 1], "start": [1, 0, 0], "latitudes": [0, 1], "angle": 1}}),
            "shell",
            [2.0 * cos * cos, 2.0 * cos * sin, 1.0 + 2.0 * sin],
        ),
        (
            json!({"ruled": {"curves": [[[0, 0, 0], [1, 0, 1], [2, 0, 0]], [[0, 1, 0], [2, 1, 0]]]}}),
            "shell",
            [1.0, 0.5, 0.5],
        ),
        (
            json!({"points": {"grid": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 1], [1, 1, 1]], [[2, 0, 0], [2, 1, 0]]]}}),
            "shell",
            [1.0, 0.5, 1.0],
        ),
    ];
    for (surface, element, wanted) in cases {
        let keys = json!({"markers": {"tip": [0.5, 0.5]}});
        let scene = json!({"name": "surface", "dimension": 3, "bodies": [body(element, &surface, [2, 2], &keys)],
            "outputs": [{"kind": "position", "marker": "p.tip"}]});
        let found = Run::started(&scene).read_all::<3>("p.tip.position");
        for (found, wanted) in found.into_iter().zip(wanted) {
            near(found, wanted, 1e-12);
        }
    }
    let surface = json!({"rectangle": {"corner": [0, 0, 0], "edges": [[2, 0, 0], [0, 1, 0]]}});
    let keys = json!({"markers": {"tip": {"at": [0, 0.5], "pad": [0.2, 0.4]}}});
    let scene = json!({"name": "pad", "dimension": 3, "bodies": [body("plate", &surface, [2, 2], &keys)],
        "outputs": [{"kind": "position", "marker": "p.tip"}]});
    all_near(
        Run::started(&scene).read_all::<3>("p.tip.position"),
        [0.05, 0.5, 0.0],
        1e-14,
    );
}

/// A plate that is thrown with a velocity of deformation beside spin: between nodes too, the field is a product of cubics.
#[test]
fn plates_deform_at_the_start() {
    let surface =
        json!({"rectangle": {"corner": [0, 0, 0], "edges": [[LENGTH, 0, 0], [0, WIDTH, 0]]}});
    let motion = json!({"velocity": [0.1, 0.2, 0.3], "spin": [0, 0, 2],
        "deformation": ["0.5*s1^2*s2", "s1*s2", "s1^3*s2^2-0.1"]});
    let keys = json!({"motion": motion, "markers": {"tip": [1, 1], "inside": [0.4, 0.3]}});
    let scene = json!({"name": "thrown", "dimension": 3, "gravity": [0, 0, 0],
        "bodies": [body("plate", &surface, [3, 2], &keys)],
        "outputs": [{"kind": "velocity", "marker": "p.tip"}, {"kind": "velocity", "marker": "p.inside"},
            {"kind": "angular_velocity", "marker": "p.inside"}]});
    let mut run = Run::started(&scene);
    for (name, [u, v]) in [("tip", [1.0, 1.0]), ("inside", [0.4, 0.3_f64])] {
        let exact = [
            0.1 - 2.0 * v * WIDTH + 0.5 * u * u * v,
            0.2 + 2.0 * u * LENGTH + u * v,
            0.3 + u.powi(3) * v * v - 0.1,
        ];
        all_near(run.read_all(&format!("p.{name}.velocity")), exact, 1e-12);
    }
    // The normal rotates with the slopes, the frame about it with half the difference of both shears.
    let ([u, v], [a, b]) = ([0.4, 0.3_f64], [LENGTH, WIDTH]);
    let slopes = [3.0 * u * u * v * v / a, 2.0 * u.powi(3) * v / b];
    let turn = 2.0 + 0.5 * (v / a - 0.5 * u * u / b);
    let exact = [slopes[1], -slopes[0], turn];
    all_near(run.read_all("p.inside.angular_velocity"), exact, 1e-12);
}
