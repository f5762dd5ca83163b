//! Joints of edges of plates and shells: on bodies and with each other.

use std::f64::consts::PI;

use nalgebra::{Rotation3, Vector3};
use serde_json::{Value, json};

use super::runs::Run;

/// A scene of plates of D = 1 and thickness 0.01, with Poisson's ratio 0 or 0.3.
fn scene(bodies: &Value, joints: &Value, outputs: &Value) -> Value {
    json!({"name": "plates", "dimension": 3, "gravity": [0, 0, 0], "bodies": bodies, "joints": joints,
        "outputs": outputs})
}

/// A rectangle by a corner and two edges.
fn plate(
    name: &str,
    corner: [f64; 3],
    edges: [[f64; 3]; 2],
    mesh: [u32; 2],
    poisson: f64,
) -> Value {
    let (h, markers) = (
        0.01_f64,
        json!({"a": [0, 0], "b": [1, 0], "c": [1, 1], "d": [0, 1], "m": [0.5, 0.5]}),
    );
    let modulus = 12.0 * (1.0 - poisson * poisson) / h.powi(3);
    json!({"name": name, "element": "plate", "mesh": mesh, "thickness": h, "markers": markers,
        "surface": {"rectangle": {"corner": corner, "edges": edges}},
        "material": {"youngs_modulus": modulus, "poisson_ratio": poisson, "density": 1.0 / h}})
}

fn joint(name: &str, kind: &str, first: &str, second: &str) -> Value {
    json!({"name": name, "kind": kind, "edges": [first, second]})
}

fn off<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A square cantilever in one piece, with a force at its corner.
fn whole() -> [f64; 3] {
    let body = plate(
        "p",
        [0.0; 3],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [4, 2],
        0.3,
    );
    let outputs = json!([{"kind": "position", "marker": "p.c"}]);
    let joints = json!([joint("wall", "clamped", "ground", "p.s1=0")]);
    let loads = json!([{"name": "F", "kind": "force", "marker": "p.c", "value": [0.1, -0.2, 2]}]);
    Run::at_rest(scene(&json!([body]), &joints, &outputs), &loads).read_all("p.c.position")
}

/// The same in two parts, of which the second is given by these corner and edges, whose corner of the load is this marker.
fn halves(
    kind: &str,
    [second, other]: [&str; 2],
    (corner, edges, mesh): ([f64; 3], [[f64; 3]; 2], [u32; 2]),
) -> [f64; 3] {
    let first = plate(
        "p",
        [0.0; 3],
        [[0.5, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [2, 2],
        0.3,
    );
    let bodies = json!([first, plate("q", corner, edges, mesh, 0.3)]);
    let joints = json!([
        joint("wall", "clamped", "ground", "p.s1=0"),
        joint("seam", kind, "p.s1=1", second)
    ]);
    let outputs = json!([{"kind": "position", "marker": other}]);
    let loads = json!([{"name": "F", "kind": "force", "marker": other, "value": [0.1, -0.2, 2]}]);
    Run::at_rest(scene(&bodies, &joints, &outputs), &loads).read_all(&format!("{other}.position"))
}

/// A smooth edge is a mesh line like any other, whatever the coordinates of the other part are; an angle of zero that is kept at nodes and
/// middles comes close.
#[test]
fn parts_that_continue_each_other_are_one_plate() {
    let whole = whole();
    let (x, y) = ([0.5, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let back = |v: [f64; 3]| v.map(|part| -part);
    let described = [
        (["q.s1=0", "q.c"], ([0.5, 0.0, 0.0], [x, y], [2, 2])),
        (["q.s1=1", "q.d"], ([1.0, 0.0, 0.0], [back(x), y], [2, 2])),
        (
            ["q.s1=1", "q.a"],
            ([1.0, 1.0, 0.0], [back(x), back(y)], [2, 2]),
        ),
        (["q.s2=0", "q.c"], ([0.5, 0.0, 0.0], [y, x], [2, 2])),
    ];
    for (names, part) in described {
        let found = halves("smooth", names, part);
        assert!(off(&found, &whole) < 1e-8, "{names:?} {found:?} {whole:?}");
        let found = halves("clamped", names, part);
        assert!(off(&found, &whole) < 4e-3, "{names:?} {found:?} {whole:?}");
    }
}

/// A square on three corners twists evenly under a small force `P` at the fourth, which it carries by twice its twisting moment
/// `D (1 - nu) w,xy` (Timoshenko and Woinowsky-Krieger (1959), article 11). Elements of two sizes, whose mixed derivatives have two units, are
/// exact on both sides of a smooth edge.
#[test]
fn an_even_twist_goes_through_a_smooth_edge() {
    let y = [0.0, 1.0, 0.0];
    let bodies = json!([
        plate("p", [0.0; 3], [[0.5, 0.0, 0.0], y], [2, 2], 0.3),
        plate("q", [0.5, 0.0, 0.0], [[0.5, 0.0, 0.0], y], [4, 2], 0.3)
    ]);
    let rest = |name: &str, marker: &str, free: &[&str]| {
        let rotations = ["rotation_x", "rotation_y", "rotation_z"];
        let free: Vec<&str> = free.iter().copied().chain(rotations).collect();
        json!({"name": name, "kind": "generic", "markers": ["ground", marker], "free": free})
    };
    let joints = json!([
        joint("seam", "smooth", "p.s1=1", "q.s1=0"),
        rest("a", "p.a", &[]),
        rest("b", "q.b", &["x"]),
        rest("d", "p.d", &["x", "y"])
    ]);
    let outputs = json!([{"kind": "position", "marker": "q.c"}]);
    let force = 1e-6;
    let loads = json!([{"name": "P", "kind": "force", "marker": "q.c", "value": [0, 0, force]}]);
    let [_, _, z] =
        Run::at_rest(scene(&bodies, &joints, &outputs), &loads).read_all("q.c.position");
    let exact = 0.5 * force / (1.0 - 0.3);
    assert!((z / exact - 1.0).abs() < 1e-5, "{z} {exact}");
}

/// A frame of two legs of length 1 at a right angle, clamped at its foot, with a small force `F` across the end of the second:
/// `F (1 / 3 + 1) / EI` by the theory of beams.
#[test]
fn a_fold_keeps_its_angle() {
    let width = 0.1;
    let first = plate(
        "p",
        [0.0; 3],
        [[1.0, 0.0, 0.0], [0.0, width, 0.0]],
        [4, 1],
        0.0,
    );
    let second = plate(
        "q",
        [1.0, 0.0, 0.0],
        [[0.0, 0.0, 1.0], [0.0, width, 0.0]],
        [4, 1],
        0.0,
    );
    let joints = json!([
        joint("wall", "clamped", "ground", "p.s1=0"),
        joint("fold", "clamped", "p.s1=1", "q.s1=0")
    ]);
    let outputs = json!([{"kind": "position", "marker": "q.end"}, {"kind": "reaction", "joint": "fold"},
        {"kind": "reaction_moment", "joint": "fold"}, {"kind": "reaction_moment", "joint": "wall"}]);
    let mut bodies = json!([first, second]);
    bodies[1]["markers"] = json!({"end": {"at": [1, 0.5], "pad": [1e-9, width]}});
    let force = 1e-4;
    let loads =
        json!([{"name": "F", "kind": "force", "marker": "q.end", "value": [force * width, 0, 0]}]);
    let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
    let [x, _, z] = run.read_all("q.end.position");
    let exact = force * (1.0 / 3.0 + 1.0);
    assert!(((x - 1.0) / exact - 1.0).abs() < 1e-3, "{x} {exact}");
    assert!((z - 1.0 + 0.5 * force).abs() < 1e-3 * force, "{z}");
    let [along, across, up] = run.read_all("fold.reaction");
    assert!((along + force * width).abs() < 1e-9 && across.abs() < 1e-9 && up.abs() < 1e-9);
    for name in ["fold", "wall"] {
        let moment: [f64; 3] = run.read_all(&format!("{name}.reaction_moment"));
        assert!(
            off(&moment, &[0.0, -force * width, 0.0]) < 1e-3 * force * width,
            "{moment:?}"
        );
    }
}

/// A leaf on a hinge: it leans on the other with half of its load, which bends that one as a cantilever does: `P L^3 / (3 EI)`.
#[test]
fn a_hinge_takes_no_moment() {
    let width = 0.1;
    let y = [0.0, width, 0.0];
    let bodies = json!([
        plate("p", [0.0; 3], [[1.0, 0.0, 0.0], y], [4, 1], 0.0),
        plate("q", [1.0, 0.0, 0.0], [[0.5, 0.0, 0.0], y], [2, 1], 0.0)
    ]);
    let joints = json!([
        joint("wall", "clamped", "ground", "p.s1=0"),
        joint("hinge", "pinned", "p.s1=1", "q.s1=0"),
        joint("rest", "pinned", "ground", "q.s1=1")
    ]);
    let outputs = json!([{"kind": "position", "marker": "p.b"}, {"kind": "reaction", "joint": "hinge"},
        {"kind": "reaction_moment", "joint": "hinge"}, {"kind": "reaction", "joint": "rest"}]);
    let load = 1e-4;
    let loads =
        json!([{"name": "weight", "kind": "area_force", "body": "q", "value": [0, 0, load]}]);
    let mut run = Run::at_rest(scene(&bodies, &joints, &outputs), &loads);
    let [_, _, z] = run.read_all("p.b.position");
    let exact = 0.25 * load / 3.0;
    assert!((z / exact - 1.0).abs() < 1e-4, "{z} {exact}");
    for name in ["hinge", "rest"] {
        let force: [f64; 3] = run.read_all(&format!("{name}.reaction"));
        assert!(
            (force[2] + 0.25 * load * width).abs() < 1e-6 * load,
            "{name} {force:?}"
        );
    }
    let moment: [f64; 3] = run.read_all("hinge.reaction_moment");
    assert!(
        moment.iter().all(|part| part.abs() < 1e-6 * load),
        "{moment:?}"
    );
}

/// What holds a square under pressure: all of the load, at the middle of each edge.
#[test]
fn reactions_of_edges_balance_the_load() {
    let body = plate(
        "p",
        [0.0; 3],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [4, 3],
        0.3,
    );
    let edges = ["s1=0", "s1=1", "s2=0", "s2=1"];
    let joints = edges.map(|edge| {
        joint(
            &format!("e{}", edge.replace('=', "_")),
            "clamped",
            "ground",
            &format!("p.{edge}"),
        )
    });
    let names = joints
        .each_ref()
        .map(|joint| joint["name"].as_str().unwrap_or("").to_owned());
    let outputs: Vec<Value> = names
        .iter()
        .flat_map(|name| {
            ["reaction", "reaction_moment"].map(|kind| json!({"kind": kind, "joint": name}))
        })
        .collect();
    let loads = json!([{"name": "q", "kind": "area_force", "body": "p", "value": [0.3, 0.1, 1]}]);
    let mut run = Run::at_rest(
        scene(&json!([body]), &json!(joints), &json!(outputs)),
        &loads,
    );
    let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
    for (name, middle) in names
        .iter()
        .zip([[0.0, 0.5], [1.0, 0.5], [0.5, 0.0], [0.5, 1.0]])
    {
        let f: [f64; 3] = run.read_all(&format!("{name}.reaction"));
        let m: [f64; 3] = run.read_all(&format!("{name}.reaction_moment"));
        let arm = middle.map(|at| at - 0.5);
        let about = [arm[1] * f[2], -arm[0] * f[2], arm[0] * f[1] - arm[1] * f[0]];
        for k in 0..3 {
            force[k] += f[k];
            moment[k] += m[k] + about[k];
        }
    }
    assert!(off(&force, &[-0.3, -0.1, -1.0]) < 1e-8, "{force:?}");
    // The load acts at the places after bending.
    assert!(off(&moment, &[0.0; 3]) < 3e-3, "{moment:?}");
}

/// A plate that is clamped on a heavy body which a joint holds is clamped on the ground; a body that rotates takes it along.
#[test]
fn a_body_holds_an_edge_as_the_ground_does() {
    let body = || {
        plate(
            "p",
            [0.0; 3],
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [2, 2],
            0.3,
        )
    };
    let hub = json!({"name": "hub", "element": "rigid", "mass": 2, "inertia": [1, 2, 3], "position": [-0.3, 0.2, 0.1],
        "orientation": {"rotation_vector": [0.2, 0.4, 0.6]}, "markers": {"c": [0, 0, 0], "far": [0.1, 0.2, 0.3]}});
    let loads = json!([{"name": "F", "kind": "force", "marker": "p.c", "value": [0.1, -0.2, 2]}]);
    let outputs = json!([{"kind": "position", "marker": "p.c"}, {"kind": "reaction", "joint": "edge"},
        {"kind": "reaction_moment", "joint": "edge"}]);
    for kind in ["clamped", "pinned"] {
        let further = if kind == "pinned" {
            json!([joint("far", "pinned", "ground", "p.s1=1")])
        } else {
            json!([])
        };
        let with = |first: &str, hub: Option<&Value>| {
            let mut joints = further.clone();
            let list = joints.as_array_mut().expect("joints");
            list.push(joint("edge", kind, first, "p.s1=0"));
            let mut bodies = json!([body()]);
            let mut outputs = outputs.clone();
            if let Some(hub) = hub {
                let read = outputs.as_array_mut().expect("outputs");
                read.extend(
                    ["reaction", "reaction_moment"]
                        .map(|kind| json!({"kind": kind, "joint": "edge", "axes": "body"})),
                );
                list.push(
                    json!({"name": "weld", "kind": "weld", "markers": ["ground", "hub.far"]}),
                );
                bodies.as_array_mut().expect("bodies").push(hub.clone());
            }
            Run::at_rest(scene(&bodies, &joints, &outputs), &loads)
        };
        let mut on_ground = with("ground", None);
        let mut on_body = with("hub.c", Some(&hub));
        for name in ["p.c.position", "edge.reaction", "edge.reaction_moment"] {
            let found: [[f64; 3]; 2] = [&mut on_ground, &mut on_body].map(|run| run.read_all(name));
            assert!(off(&found[0], &found[1]) < 1e-7, "{kind} {name} {found:?}");
        }
        // Along the axes of the hub.
        let axes = Rotation3::new(Vector3::new(0.2, 0.4, 0.6));
        for name in ["edge.reaction", "edge.reaction_moment"] {
            let global: [f64; 3] = on_body.read_all(name);
            let found: [f64; 3] = on_body.read_all(&format!("{name}_body"));
            let wanted: [f64; 3] = (axes.inverse() * Vector3::from(global)).into();
            assert!(
                off(&found, &wanted) < 1e-9,
                "{kind} {name} {found:?} {wanted:?}"
            );
        }
    }
}

/// Two plates that meet in a fold, clamped on a body, all free: momentum and energy stay, whatever the steps are.
#[test]
fn joints_of_edges_do_no_work() {
    let first = plate(
        "p",
        [0.0; 3],
        [[0.6, 0.0, 0.0], [0.0, 0.5, 0.0]],
        [1, 1],
        0.3,
    );
    let second = plate(
        "q",
        [0.6, 0.0, 0.0],
        [[0.1, 0.0, 0.4], [0.0, 0.5, 0.0]],
        [1, 1],
        0.3,
    );
    let hub = json!({"name": "hub", "element": "rigid", "mass": 0.3, "inertia": [0.01, 0.02, 0.03], "position": [-0.1, 0.2, 0.1],
        "markers": {"c": [0, 0, 0]}});
    let joints = json!([
        joint("root", "clamped", "hub.c", "p.s1=0"),
        joint("fold", "clamped", "p.s1=1", "q.s1=0")
    ]);
    let outputs = json!([{"kind": "energy"}, {"kind": "momentum"}]);
    let mut free = scene(&json!([first, second, hub]), &joints, &outputs);
    free["loads"] = json!([{"name": "kick", "kind": "force", "marker": "q.c", "value": [0, 0, "if(t < 0.01, 3, 0)"]}]);
    Run::check_kept(free, 3);
}

/// A tube that is closed by a smooth seam vibrates as rings do: `omega^2 = E h^2 / (12 rho R^4) n^2 (n^2 - 1)^2 / (n^2 + 1)` (Rayleigh, Theory of
/// Sound (1894), section 233).
#[test]
fn a_seam_closes_a_tube() {
    let (radius, h, modulus, density) = (0.5_f64, 0.01_f64, 2e9_f64, 1000.0_f64);
    let body = json!({"name": "tube", "element": "shell", "mesh": [16, 1], "thickness": h,
        "surface": {"cylinder": {"from": [0, 0, 0], "to": [0, 0, 0.1], "radius": radius, "start": [radius, 0, 0], "angle": 2.0 * PI}},
        "material": {"youngs_modulus": modulus, "poisson_ratio": 0, "density": density}});
    let joints = json!([joint("seam", "smooth", "tube.s1=0", "tube.s1=1")]);
    let outputs = json!([{"kind": "natural_frequency", "count": 10}]);
    let mut run = Run::started(&scene(&json!([body]), &joints, &outputs));
    let found: Vec<f64> = (1..=10)
        .map(|k| run.read(&format!("natural_frequency[{k}]")))
        .collect();
    let size = (modulus * h * h / (12.0 * density * radius.powi(4))).sqrt();
    let exact = size * (4.0 * 9.0 / 5.0_f64).sqrt();
    assert!(
        found[..6].iter().all(|found| *found < 1e-3 * exact),
        "{found:?}"
    );
    // Of the two pairs one is uniform along the tube.
    for k in [6, 7] {
        assert!((found[k] / exact - 1.0).abs() < 2e-3, "{exact} {found:?}");
    }
}
