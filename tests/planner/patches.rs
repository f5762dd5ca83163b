//! Meshes of plates and shells that the planner finds: errors against series, the elastica and a program of others, one number of elements
//! along joined edges, the direction along which a strip bends, and the bound.

use flexbody::scene::{Body, Scene};
use flexbody::simulation::{Plan, Simulation};
use serde_json::{Value, json};

use super::{at_the_end, planned};

/// A rectangle of unit bending stiffness with nothing said about its mesh.
fn plate(name: &str, corner: [f64; 2], sides: [f64; 2], poisson: f64) -> Value {
    let thickness: f64 = 0.01;
    let modulus = 12.0 * (1.0 - poisson * poisson) / thickness.powi(3);
    json!({"name": name, "element": "plate", "thickness": thickness,
        "surface": {"rectangle": {"corner": [corner[0], corner[1], 0], "edges": [[sides[0], 0, 0], [0, sides[1], 0]]}},
        "material": {"youngs_modulus": modulus, "poisson_ratio": poisson, "density": 1.0 / thickness},
        "markers": {"middle": [0.5, 0.5], "corner": [1, 1], "end": {"at": [1, 0.5], "pad": [1e-6, sides[1]]}}})
}

/// A scene in static equilibrium with one output that counts, the place of a marker.
fn scene(bodies: &[Value], joints: &[[&str; 3]], load: &Value, seen: &str, error: f64) -> Value {
    let joints = joints.iter().enumerate().map(|(k, [kind, first, second])| {
        json!({"name": format!("edge{k}"), "kind": kind, "edges": [first, second]})
    });
    json!({"name": "plates", "dimension": 3, "bodies": bodies, "joints": joints.collect::<Vec<_>>(),
        "loads": [load], "initial": "static_equilibrium", "outputs": [{"kind": "position", "marker": seen}],
        "accuracy": {"error": error}, "experiment": {"stop_time": 1e-3, "step": 1e-3}})
}

fn read(scene: &Value) -> Scene {
    Scene::from_json(&scene.to_string()).unwrap_or_else(|error| panic!("{error}: {scene}"))
}

fn found(scene: &Value) -> (Scene, Plan) {
    let (scene, plan) = planned(&read(scene)).expect("a plan");
    (scene, plan.expect("a plan"))
}

fn meshes(scene: &Scene) -> Vec<[u32; 2]> {
    let patches = scene.bodies.iter().filter_map(Body::patch);
    patches.map(|patch| patch.mesh.counts).collect()
}

fn with_mesh(scene: &Value, mesh: [u32; 2]) -> Scene {
    let mut scene = scene.clone();
    scene["bodies"][0]["mesh"] = json!(mesh);
    scene["accuracy"] = json!({"relative_tolerance": 1e-6});
    read(&scene)
}

/// Place of a marker at the end of a run, m.
fn place(scene: Scene, marker: &str) -> [f64; 3] {
    let names = [1, 2, 3].map(|k| format!("{marker}.position[{k}]"));
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let found = at_the_end(scene, &names);
    [found[0], found[1], found[2]]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// A square between hinges under a small uniform load.
fn square(error: f64) -> Value {
    let edges = ["p.s1=0", "p.s1=1", "p.s2=0", "p.s2=1"].map(|edge| ["pinned", "ground", edge]);
    let load = json!({"name": "q", "kind": "area_force", "body": "p", "value": [0, 0, 1e-3]});
    scene(
        &[plate("p", [0.0; 2], [1.0; 2], 0.3)],
        &edges,
        &load,
        "p.middle",
        error,
    )
}

/// Deflection of the middle, by Navier's series (Timoshenko and Woinowsky-Krieger (1959), article 30), over its load.
const NAVIER: f64 = 0.004_062_352_66;

#[test]
fn a_square_takes_as_many_elements_as_the_error_asks_for() {
    let error_of = |scene: Scene| (place(scene, "p.middle")[2] / (1e-3 * NAVIER) - 1.0).abs();
    for error in [1e-2, 1e-3, 1e-4] {
        let open = square(error);
        let (chosen, plan) = found(&open);
        assert_eq!(plan.missed(), Vec::<String>::new());
        let [n, m] = meshes(&chosen)[0];
        assert!(
            n <= 2 * m && m <= 2 * n,
            "a square loaded alike along both sides: {n} x {m}"
        );
        let (is, told) = (error_of(chosen), plan.outputs[0].error);
        assert!(
            is <= error && told <= error,
            "{error:e}: {is:e}, told {told:e}"
        );
        // Order 4: a quarter of the elements is 256 times worse, and must not do.
        if n.min(m) >= 4 {
            let coarse = error_of(with_mesh(&open, [n / 4, m / 4]));
            assert!(
                coarse > error,
                "{error:e}: {coarse:e} with a quarter of {n} x {m}"
            );
        }
    }
}

/// A strip without lateral contraction is the elastica, here with `P L^2 / (E I) = 4`: one element across carries it, however many there are
/// along. Place of its end by integration of the equation of the elastica.
#[test]
fn a_strip_is_refined_along_the_direction_that_it_bends_in() {
    let width = 0.1;
    let end = [1.0 - 0.328_941_2, 0.5 * width, 0.669_964_2];
    for error in [1e-2, 1e-3] {
        for is_across in [false, true] {
            let sides = [1.0, width];
            let mut body = plate("p", [0.0; 2], sides, 0.0);
            let mut edge = "p.s1=0";
            if is_across {
                // The same strip with its coordinates exchanged.
                body["surface"]["rectangle"]["edges"] = json!([[0, width, 0], [1, 0, 0]]);
                body["markers"] = json!({"end": {"at": [0.5, 1], "pad": [width, 1e-6]}});
                edge = "p.s2=0";
            }
            let load = json!({"name": "f", "kind": "force", "marker": "p.end", "value": [0, 0, 4.0 * width]});
            let open = scene(
                &[body],
                &[["clamped", "ground", edge]],
                &load,
                "p.end",
                error,
            );
            let (chosen, plan) = found(&open);
            assert_eq!(plan.missed(), Vec::<String>::new());
            let mut mesh = meshes(&chosen)[0];
            if is_across {
                mesh.reverse();
            }
            assert!(mesh[1] == 1 && mesh[0] > 1, "{mesh:?}");
            let off = distance(place(chosen, "p.end"), end) / end[2].hypot(1.0 - end[0]);
            assert!(off <= error, "{error:e}: {off:e} with {mesh:?}");
        }
    }
}

/// A square that one edge holds and a force at a free corner bends and twists far. What a mesh of 16 x 16 says instead is what it is off by.
#[test]
fn a_corner_that_is_bent_far_keeps_the_error() {
    for error in [1e-2, 1e-3] {
        let load = json!({"name": "f", "kind": "force", "marker": "p.corner", "value": [0, 0, 3]});
        let body = plate("p", [0.0; 2], [1.0; 2], 0.3);
        let open = scene(
            &[body],
            &[["clamped", "ground", "p.s1=0"]],
            &load,
            "p.corner",
            error,
        );
        let (chosen, plan) = found(&open);
        assert_eq!(plan.missed(), Vec::<String>::new());
        let fine = place(with_mesh(&open, [16; 2]), "p.corner");
        let off = distance(place(chosen, "p.corner"), fine) / distance(fine, [1.0, 1.0, 0.0]);
        assert!(off <= error, "{error:e}: {off:e}");
    }
}

/// A plate that is thrown with bending, twist and spin. Places at 0.2 s to which Exudyn 1.13.6 comes within 9e-4 m (decision 80).
#[test]
fn a_thrown_plate_keeps_the_error() {
    let (error, [p, q, r]) = (1e-2, [2.0, 1.0, 3.0]);
    let body = json!({"name": "p", "element": "plate", "thickness": 0.01, "mesh": "auto",
        "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[1, 0, 0], [0, 1, 0]]}},
        "material": {"youngs_modulus": 1e8, "poisson_ratio": 0.3, "density": 1000},
        "markers": {"far": [1, 1], "near": [1, 0]},
        "motion": {"velocity": [0.5 * r, -0.5 * r, 0.5 * (q - p)], "spin": [p, q, r],
            "deformation": ["0", "0", "3*(2*s1-1)^2 + 3*(2*s1-1)*(2*s2-1)"]}});
    let open = json!({"name": "thrown", "dimension": 3, "bodies": [body],
        "outputs": [{"kind": "position", "marker": "p.far"}, {"kind": "position", "marker": "p.near"}],
        "accuracy": {"error": error}, "experiment": {"stop_time": 0.2, "step": 0.01}});
    let (chosen, plan) = found(&open);
    assert_eq!(plan.missed(), Vec::<String>::new());
    for (marker, drawn, end) in [
        ("p.far", [1.0, 1.0, 0.0], [0.590_43, 1.197_22, 0.221_99]),
        ("p.near", [1.0, 0.0, 0.0], [1.167_63, 0.411_88, -0.012_34]),
    ] {
        let off = distance(place(chosen.clone(), marker), end) / distance(drawn, end);
        assert!(off <= error, "{marker}: {off:e}");
    }
}

/// Two halves of a square and a rib over their common edge, as one square with a rib inside: the common edge has one number of elements.
#[test]
fn joined_edges_and_stiffeners_get_one_number() {
    let rib = |x: f64| {
        json!({"name": "rib", "element": "rod",
            "material": {"youngs_modulus": 1.2e7, "shear_modulus": 6e6, "density": 100},
            "section": {"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 1e-9},
            "shape": {"line": {"from": [x, 0, 0], "to": [x, 1, 0]}}})
    };
    let load = |marker: &str| json!({"name": "f", "kind": "force", "marker": marker, "value": [0, 0, 0.03]});
    let halves = [
        plate("left", [0.0; 2], [0.5, 1.0], 0.3),
        plate("right", [0.5, 0.0], [0.5, 1.0], 0.3),
        rib(0.5),
    ];
    let joints = [
        ["clamped", "ground", "left.s1=0"],
        ["smooth", "left.s1=1", "right.s1=0"],
        ["pinned", "rib", "left.s1=1"],
    ];
    let open = scene(
        &halves,
        &joints,
        &load("right.corner"),
        "right.corner",
        1e-3,
    );
    let (chosen, plan) = found(&open);
    assert_eq!(plan.missed(), Vec::<String>::new());
    let [left, right] = meshes(&chosen)[..] else {
        panic!("two plates");
    };
    let of_rib = chosen.bodies[2].cable().and_then(|line| line.elements);
    assert_eq!(
        (left[1], Some(left[1])),
        (right[1], of_rib),
        "{left:?} {right:?}"
    );
    let rib_is = &plan.bodies[2];
    assert_eq!(rib_is.elements, of_rib);
    assert_eq!(rib_is.why, "as many as the line that it stiffens has");
    // One square with the rib on a line that every mesh has.
    let whole = [plate("p", [0.0; 2], [1.0; 2], 0.3), rib(0.5)];
    let joints = [
        ["clamped", "ground", "p.s1=0"],
        ["pinned", "rib", "p.s1=0.5"],
    ];
    let one = scene(&whole, &joints, &load("p.corner"), "p.corner", 1e-3);
    let (one, plan) = found(&one);
    assert_eq!(plan.missed(), Vec::<String>::new());
    let [n, m] = meshes(&one)[0];
    assert!(n.is_multiple_of(2), "{n} x {m}");
    let ends = [place(chosen, "right.corner"), place(one, "p.corner")];
    let off = distance(ends[0], ends[1]) / distance(ends[1], [1.0, 1.0, 0.0]);
    assert!(off <= 2e-3, "{off:e} {ends:?}");
}

/// A number that is given stays, the other one is found; a planned scene is one of plain numbers, and the same every time.
#[test]
fn one_number_may_be_given() {
    let mut open = square(1e-3);
    open["bodies"][0]["mesh"] = json!([3, "auto"]);
    let first = found(&open);
    let [n, m] = meshes(&first.0)[0];
    assert!(n == 3 && m > 1, "{n} x {m}");
    assert_eq!(first.1.bodies[0].mesh, Some([n, m]));
    assert_eq!(first, found(&open));
    let again = read(&serde_json::from_str(&first.0.to_json()).expect("JSON"));
    assert_eq!(again, first.0);
    assert_eq!(
        planned(&again),
        Ok((again.clone(), None)),
        "nothing is left to plan"
    );
    // A scene that was not planned does not run with numbers that nobody chose.
    let mut simulation = Simulation::new(read(&open));
    let told = simulation.initialize(0.0).expect_err("not planned");
    assert!(told.to_string().contains("left to the planner"), "{told}");
}

/// A joint at 1/128 of the length: 128 elements are the fewest, and twice as many are more than there may be.
#[test]
fn the_bound_is_named_with_the_body_and_the_direction() {
    let load = json!({"name": "f", "kind": "force", "marker": "p.end", "value": [0, 0, 1e-4]});
    let mut body = plate("p", [0.0; 2], [1.0, 0.1], 0.0);
    body["mesh"] = json!(["auto", 1]);
    let joints = [
        ["clamped", "ground", "p.s1=0"],
        ["pinned", "ground", "p.s1=0.0078125"],
    ];
    let (chosen, plan) = found(&scene(&[body], &joints, &load, "p.end", 1e-3));
    assert_eq!(meshes(&chosen), [[128, 1]]);
    let told = plan.missed();
    assert_eq!(
        told,
        [
            "p.end.position: the error of the plan is not known, 1e-3 is wanted",
            "p: its mesh has 128 elements along s1, twice as many are above the bound of 200",
        ]
    );
    assert_eq!(chosen.accuracy.notes, told, "the planned scene keeps it");
}

/// A strip without lateral contraction that a small load `q s` bends is a cable of the plane: its mesh is as good or bad. Both are exact at
/// nodes (P. Tong, AIAA J. 7 (1969) 178-180). Between them they are the cubics of these values and slopes, whose curvature jumps by
/// `q l^3 / (15 E I)` at nodes and is off by `q l^3 / (20 E I)` at the end of one element.
#[test]
fn resolution_of_a_strip_is_that_of_a_cable() {
    let (width, thickness, load) = (0.1_f64, 0.01_f64, 1e-3);
    let told = |scene: &Value| {
        let mut simulation = Simulation::new(read(scene));
        simulation.initialize(0.0).expect("a start");
        let mut variables = simulation.variables().iter();
        let place = variables.position(|v| v.name == "resolution");
        simulation
            .real(place.expect("an output"))
            .expect("a number")
    };
    let of_strip = |elements: u32| {
        let load = json!({"name": "f", "kind": "area_force", "body": "p", "value": [0, 0, format!("{load}*s1")]});
        let mut body = plate("p", [0.0; 2], [1.0, width], 0.0);
        body["mesh"] = json!([elements, 1]);
        let edges = [["clamped", "ground", "p.s1=0"]];
        let mut strip = scene(&[body], &edges, &load, "p.end", 1e-3);
        strip["accuracy"] = json!({"relative_tolerance": 1e-4});
        strip["outputs"] = json!([{"kind": "resolution"}]);
        told(&strip)
    };
    let of_cable = |elements: u32| {
        let modulus = 12.0 / thickness.powi(3);
        told(&json!({"name": "cable", "dimension": 2,
            "bodies": [{"name": "c", "element": "cable", "elements": elements,
                "material": {"youngs_modulus": modulus, "density": 100.0},
                "section": {"area": width * thickness, "second_moment": width * thickness.powi(3) / 12.0},
                "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"root": 0, "tip": 1}}],
            "joints": [{"name": "root", "kind": "weld", "markers": ["ground", "c.root"]}],
            "loads": [{"name": "f", "kind": "distributed_force", "body": "c", "value": [0, format!("{}*s", load * width)]}],
            "initial": "static_equilibrium", "outputs": [{"kind": "resolution"}],
            "accuracy": {"relative_tolerance": 1e-4}}))
    };
    // What is wanted is relative to the size, and 1e-3 where the tolerance is 1e-4.
    let size = 1.0_f64.hypot(width);
    for elements in [1, 3, 4, 6, 9] {
        let told = [of_strip(elements) * size, of_cable(elements)];
        let wanted = match elements {
            1 => 0.2 * load / 20.0 / 1e-3,
            _ => 0.2 * 0.5 * load / 15.0 / f64::from(elements).powi(5) / 1e-3,
        };
        for told in told {
            let off = (told / wanted - 1.0).abs();
            assert!(off < 1e-4, "{elements}: {told:e} of {wanted:e}");
        }
    }
}
