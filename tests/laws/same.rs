//! One thing said in two ways moves in one way: pairs of scenes of which every output is compared along a run. Each pair puts two keys
//! together that cases and claims have one by one.

use serde_json::{Value, json};

use crate::laws::runs::Run;

const STEP: f64 = 0.02;
const STEPS: u32 = 6;

/// A scene with entries more: lists grow, other keys are set.
fn with(mut scene: Value, more: Value) -> Value {
    for (key, value) in more.as_object().expect("keys").clone() {
        match (scene[&key].as_array_mut(), value) {
            (Some(list), Value::Array(more)) => list.extend(more),
            (_, value) => scene[&key] = value,
        }
    }
    scene
}

/// Compares outputs along runs, relative to the largest value of each in the first.
fn move_alike(what: &str, scenes: [&Value; 2], within: f64) {
    let [(names, one), (_, other)] = scenes.map(|scene| {
        let mut run = Run::started(scene);
        let mut rows = vec![run.outputs()];
        rows.extend(run.steps(0..STEPS, STEP, |_, _| ()));
        (run.names(), rows)
    });
    assert_eq!(one[0].len(), other[0].len(), "{what}");
    let mut moved = false;
    for (k, name) in names.iter().enumerate() {
        let family = name.split('[').next().unwrap_or(name);
        let of_family = |k: &usize| names[*k].split('[').next() == Some(family);
        let family: Vec<usize> = (0..names.len()).filter(of_family).collect();
        let most = |rows: &[Vec<f64>]| {
            let values = rows
                .iter()
                .flat_map(|row| family.iter().map(|k| row[*k].abs()));
            values.fold(1e-6, f64::max)
        };
        let size = most(&one);
        for (point, (a, b)) in one.iter().zip(&other).enumerate() {
            let off = (a[k] - b[k]).abs() / size;
            assert!(
                off < within,
                "{what}: {name} at point {point}: {} {}",
                a[k],
                b[k]
            );
            moved |= (a[k] - one[0][k]).abs() > 1e-4 * size;
        }
    }
    assert!(moved, "{what}: nothing moves");
}

const RADIUS: f64 = 0.02;

fn round() -> Value {
    json!({"shape": {"circle": {"radius": RADIUS}}})
}

/// A line of an element, straight along the first axis, with its markers.
fn line(element: &str, dimension: usize, section: Value) -> Value {
    let [mut from, mut to] = [vec![0.0; dimension], vec![0.0; dimension]];
    (from[dimension - 1], to[0], to[dimension - 1]) = (0.1, 1.2, 0.1);
    let mut body = json!({"element": element, "name": "line", "elements": 2,
        "material": {"youngs_modulus": 1e6, "density": 1250.0, "damping_time": 1e-3},
        "section": section, "shape": {"line": {"from": from, "to": to}}, "markers": {"root": 0.0, "inside": 0.4, "tip": 1.0}});
    if element != "cable" {
        body["material"]["shear_modulus"] = json!(4e5);
    }
    body
}

/// A line that is free, with what can be read of any of them.
fn scene(dimension: usize, gravity: f64, body: Value) -> Value {
    let mut down = vec![0.0; dimension];
    down[dimension - 1] = -gravity;
    json!({"name": "same", "dimension": dimension, "gravity": down, "bodies": [body],
        "outputs": [{"kind": "position", "marker": "line.tip"}, {"kind": "velocity", "marker": "line.inside"},
                    {"kind": "acceleration", "marker": "line.root"}, {"kind": "momentum"}, {"kind": "energy"}, {"kind": "work"}],
        "accuracy": {"relative_tolerance": 1e-7}, "experiment": {"stop_time": 1.0, "step": STEP}})
}

/// What pulls the tip to all sides.
fn pull(dimension: usize) -> Value {
    let value = match dimension {
        2 => json!(["3*cos(4*t)", 2.0]),
        _ => json!(["3*cos(4*t)", 0.0, 2.0]),
    };
    json!({"name": "pull", "kind": "force", "marker": "line.tip", "value": value})
}

/// The lines that there are: element, dimension, whether it bends.
const LINES: [(&str, usize, bool); 7] = [
    ("cable", 2, true),
    ("cable", 2, false),
    ("cable", 3, true),
    ("rod", 3, true),
    ("beam", 2, true),
    ("beam", 3, true),
    ("auto", 3, true),
];

fn made((element, dimension, bends): (&str, usize, bool), section: Value) -> Value {
    let mut body = line(element, dimension, section);
    if !bends {
        body["model"] = json!("rigid");
        body.as_object_mut().expect("keys").remove("elements");
    }
    body
}

fn fluid(more: Value) -> Value {
    let fluid = json!({"name": "sea", "kind": "fluid", "body": "line", "density": 800.0});
    with(fluid, more)
}

/// In a fluid at rest, without buoyancy and gravity, mass that moves along is mass: beams are left out, whose sections have rotary inertia.
#[test]
fn added_mass_is_mass_without_weight() {
    let kinds = LINES.iter().filter(|(element, ..)| *element != "beam");
    for (kind, settled) in kinds.flat_map(|kind| [(kind, false), (kind, true)]) {
        let dimension = kind.1;
        let mut light = made(*kind, round());
        if settled {
            light["axial"] = json!("critically_damped");
        }
        let mut heavy = light.clone();
        heavy["material"]["density"] = json!(1250.0 + 0.9 * 800.0);
        let sea = fluid(json!({"added_mass": 0.9, "buoyancy": false}));
        let more = json!({"loads": [pull(dimension)]});
        let pair = [
            with(
                with(scene(dimension, 0.0, light), json!({"loads": [sea]})),
                json!({"loads": [pull(dimension)]}),
            ),
            with(scene(dimension, 0.0, heavy), more),
        ];
        move_alike(&format!("{kind:?} {settled}"), [&pair[0], &pair[1]], 1e-6);
    }
}

/// Stations that are all alike are one section.
#[test]
fn stations_that_are_alike_are_one_section() {
    for kind in LINES.into_iter().filter(|(.., bends)| *bends) {
        let dimension = kind.1;
        let one = made(kind, round());
        let mut many = one.clone();
        let keys = many.as_object_mut().expect("keys");
        keys.remove("section");
        let station = |at: f64| json!({"at": at, "section": round()});
        many["stations"] = json!([station(0.0), station(1.0)]);
        let current = if dimension == 2 {
            json!([0.4, 0.3])
        } else {
            json!([0.4, 0.0, 0.3])
        };
        let sea = fluid(
            json!({"drag": 1.2, "tangential_drag": 0.05, "added_mass": 0.9, "current": current}),
        );
        let mut normal = vec![0.0; dimension];
        normal[dimension - 1] = 1.0;
        let floor = json!({"name": "floor", "kind": "contact", "body": "line", "stiffness": 500.0, "damping": 0.1,
            "surface": {"plane": {"point": vec![0.0; dimension], "normal": normal}}});
        for (what, loads) in [
            ("fluid", json!([sea, pull(dimension)])),
            ("contact", json!([floor, pull(dimension)])),
        ] {
            for axial in ["waves", "critically_damped"] {
                let pair = [&one, &many].map(|body| {
                    let mut body = body.clone();
                    body["axial"] = json!(axial);
                    with(scene(dimension, 9.81, body), json!({"loads": loads}))
                });
                move_alike(
                    &format!("{kind:?} {what} {axial}"),
                    [&pair[0], &pair[1]],
                    1e-6,
                );
            }
        }
    }
}

/// A place that is driven to stay is a pin, also where bodies have to be brought there first and settle.
#[test]
fn a_position_that_is_driven_to_stay_is_a_pin() {
    let bend = LINES.iter().filter(|(.., bends)| *bends);
    for kind in bend.filter(|(element, ..)| *element != "auto") {
        let dimension = kind.1;
        let pin = ["revolute", "spherical"][dimension - 2];
        for (axial, initial) in [("waves", "undeformed"), ("critically_damped", "undeformed")] {
            let mut body = made(*kind, round());
            body["axial"] = json!(axial);
            let mut place = vec![0.05; dimension];
            place[dimension - 1] = 0.14;
            let joint = json!({"name": "hold", "kind": pin, "markers": ["ground", "line.root"], "point": place});
            let motion =
                json!({"name": "hold", "kind": "position", "marker": "line.root", "value": place});
            let pair = [("joint", joint), ("motion", motion)].map(|(key, hold)| {
                let read = json!({"kind": "reaction", key: "hold"});
                let scene = with(
                    scene(dimension, 9.81, body.clone()),
                    json!({"initial": initial, "loads": [pull(dimension)], "outputs": [read]}),
                );
                with(scene, json!({format!("{key}s"): [hold]}))
            });
            move_alike(
                &format!("{kind:?} {axial} {initial}"),
                [&pair[0], &pair[1]],
                1e-6,
            );
        }
    }
}

/// Along a body it is all one which components are written as expressions of the place.
#[test]
fn components_that_are_even_or_change_along_a_body_are_the_same_beside_each_other() {
    for kind in [("rod", 3, true), ("beam", 3, true), ("cable", 3, true)] {
        let weld = json!({"joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "line.root"]}],
                          "outputs": [{"kind": "reaction", "joint": "clamp"}]});
        let base = with(scene(3, 0.0, made(kind, round())), weld);
        let pairs = [
            (
                "distributed_force",
                json!([0.5, "2*s", -0.7]),
                json!(["0.5+0*s", "2*s", "-0.7+0*s"]),
            ),
            (
                "distributed_moment",
                json!([0.02, "0.01*s", -0.03]),
                json!(["0.02+0*s", "0.01*s", "-0.03+0*s"]),
            ),
        ];
        for (name, some, all) in pairs
            .iter()
            .filter(|(name, ..)| kind.0 != "cable" || *name == "distributed_force")
        {
            let followers: &[bool] = if *name == "distributed_force" {
                &[false]
            } else {
                &[false, true]
            };
            for follower in followers {
                let pair = [some, all].map(|value| {
                    let mut load =
                        json!({"name": "wind", "kind": name, "body": "line", "value": value});
                    if *follower {
                        load["follower"] = json!(true);
                    }
                    with(base.clone(), json!({"loads": [load]}))
                });
                move_alike(
                    &format!("{kind:?} {name} {follower}"),
                    [&pair[0], &pair[1]],
                    1e-8,
                );
            }
        }
        let sea = |current: Value| fluid(json!({"drag": 1.2, "current": current}));
        let pair = [
            json!([0.5, "2*s", -0.7]),
            json!(["0.5+0*s", "2*s", "-0.7+0*s"]),
        ]
        .map(|current| with(base.clone(), json!({"loads": [sea(current)]})));
        move_alike(&format!("{kind:?} current"), [&pair[0], &pair[1]], 1e-8);
    }
}

/// A table and the expression that goes through its points, at kinks that are communication points and at others.
#[test]
fn a_table_is_the_expression_through_its_points() {
    let expression = "20*min(t,0.1)-10*min(max(t-0.1,0),0.07)";
    let table = json!({"table": [[0.0, 0.0], [0.1, 2.0], [0.17, 1.3]], "interpolation": "linear"});
    let pair = [table, json!(expression)].map(|value| {
        let load =
            json!({"name": "pull", "kind": "force", "marker": "line.tip", "value": [0.4, value]});
        with(
            scene(2, 0.0, made(LINES[0], round())),
            json!({"loads": [load]}),
        )
    });
    move_alike("table", [&pair[0], &pair[1]], 1e-4);
}

/// A rope that a winch pays out on a floor, drawn from either of its ends.
#[test]
fn a_rope_on_a_winch_may_be_drawn_from_either_end() {
    let rope = |is_reversed: bool| {
        let mut ends = [[0.0, 0.0], [1.2, 0.05]];
        let mut places = [0.0, 0.4, 1.0];
        if is_reversed {
            ends.reverse();
            places = places.map(|s| 1.0 - s);
        }
        let [root, inside, tip] = places;
        let body = json!({"element": "cable", "name": "line", "elements": 2,
            "material": {"youngs_modulus": 1e6, "density": 1250.0, "damping_time": 0.01},
            "section": {"area": 1e-3, "second_moment": 0.0}, "shape": {"line": {"from": ends[0], "to": ends[1]}},
            "markers": {"root": root, "inside": inside, "tip": tip}});
        let more = json!({
            "joints": [{"name": "drum", "kind": "revolute", "markers": ["ground", "line.root"]}],
            "motions": [{"name": "winch", "kind": "winch", "marker": "line.root", "value": "0.3*t+0.5*t^2"}],
            "loads": [{"name": "floor", "kind": "contact", "body": "line", "stiffness": 2000.0, "damping": 0.2, "friction": 0.1,
                       "slip_velocity": 0.05, "surface": {"plane": {"point": [0.0, 0.02], "normal": [0.0, 1.0]}}},
                      {"name": "sea", "kind": "fluid", "body": "line", "density": 800.0, "drag": 1.2, "tangential_drag": 0.1,
                       "current": [0.3, 0.1]},
                      {"name": "wind", "kind": "distributed_force", "body": "line", "value": [0.2, -0.1]}, pull(2)],
            "outputs": [{"kind": "reaction", "joint": "drum"}, {"kind": "axial_force", "marker": "line.inside"}]});
        let mut scene = with(scene(2, 9.81, body), more);
        scene["accuracy"]["relative_tolerance"] = json!(1e-7);
        scene
    };
    let pair = [false, true].map(rope);
    move_alike("winch", [&pair[0], &pair[1]], 1e-6);
}

/// What has touched the floor already where a winch pays it out brings the energy of the contact there with it. The rope is straight and
/// without stress, so that its mesh leaves nothing.
#[test]
fn what_is_paid_out_under_a_surface_brings_its_energy_along() {
    let (speed, stiffness, depth) = (0.3, 0.1, 0.1);
    for is_reversed in [false, true] {
        let mut ends = [[0.0, 0.0], [0.8, 0.6]];
        if is_reversed {
            ends.reverse();
        }
        let body = json!({"element": "cable", "name": "line", "elements": 4,
            "material": {"youngs_modulus": 1e5, "density": 1250.0},
            "section": {"area": 1e-3, "second_moment": 0.0}, "shape": {"line": {"from": ends[0], "to": ends[1]}},
            "motion": {"velocity": [0.8 * speed, 0.6 * speed]},
            "markers": {"root": if is_reversed { 1.0 } else { 0.0 }, "inside": 0.5, "tip": if is_reversed { 0.0 } else { 1.0 }}});
        let more = json!({
            "joints": [{"name": "drum", "kind": "revolute", "markers": ["ground", "line.root"]}],
            "motions": [{"name": "winch", "kind": "winch", "marker": "line.root", "value": format!("{speed}*t")}],
            "loads": [{"name": "floor", "kind": "contact", "body": "line", "stiffness": stiffness,
                       "surface": {"plane": {"point": [0.0, depth], "normal": [0.0, 1.0]}}}]});
        let mut run = Run::started(&with(scene(2, 0.0, body), more));
        let of = |run: &mut Run| -> f64 {
            let parts = ["kinetic", "strain", "spring"];
            parts
                .iter()
                .map(|part| run.read(&format!("energy.{part}")))
                .sum()
        };
        let start = of(&mut run);
        run.steps(0..STEPS, STEP, |_, _| ());
        let gained = of(&mut run) - start;
        let brought = 0.5 * stiffness * depth * depth * speed * f64::from(STEPS) * STEP;
        let missed = gained - run.read("energy.input") + run.read("energy.dissipated");
        assert!(missed.abs() < 0.05 * brought, "{missed:e} {brought:e}");
    }
}

/// A joint of kind `generic` is the named one that lets go the same.
#[test]
fn a_generic_joint_is_the_named_one() {
    let named = [
        (json!([]), json!({"kind": "weld"})),
        (
            json!(["rotation_y"]),
            json!({"kind": "revolute", "direction": [0.0, 1.0, 0.0]}),
        ),
        (
            json!(["x"]),
            json!({"kind": "prismatic", "direction": [1.0, 0.0, 0.0]}),
        ),
        (
            json!(["z", "rotation_z"]),
            json!({"kind": "cylindrical", "direction": [0.0, 0.0, 1.0]}),
        ),
        (
            json!(["x", "z", "rotation_y"]),
            json!({"kind": "planar", "direction": [0.0, 1.0, 0.0]}),
        ),
        (
            json!(["rotation_x", "rotation_y", "rotation_z"]),
            json!({"kind": "spherical"}),
        ),
        (
            json!(["rotation_y", "rotation_x"]),
            json!({"kind": "universal", "direction": [0.0, 1.0, 0.0], "second_direction": [1.0, 0.0, 0.0]}),
        ),
        (
            json!(["rotation_z", "rotation_y"]),
            json!({"kind": "universal", "direction": [0.0, 0.0, 1.0], "second_direction": [0.0, 1.0, 0.0]}),
        ),
    ];
    for (free, joint) in named {
        let body = |name: &str, place: f64, turn: f64| {
            json!({"element": "rigid", "name": name, "mass": 1.0, "inertia": [0.2, 0.3, 0.4], "position": [place, 0.0, 0.1 * place],
                   "orientation": {"rotation_vector": [0.3 * turn, turn, -0.5 * turn]}, "motion": {"spin": [turn, 2.0, 3.0 * turn]},
                   "markers": {"root": [0.0, 0.0, 0.0], "inside": [0.1, 0.0, 0.0], "tip": [0.5, 0.2, 0.0]}})
        };
        let base = json!({"bodies": [body("b", 0.0, 0.7)],
            "loads": [pull(3)], "outputs": [{"kind": "reaction", "joint": "j"}, {"kind": "orientation", "marker": "line.tip"}]});
        let mut base = with(scene(3, 9.81, body("line", 0.0, 0.2)), base);
        if joint["kind"] != "spherical" {
            base = with(
                base,
                json!({"outputs": [{"kind": "reaction_moment", "joint": "j"}]}),
            );
        }
        let generic = json!({"name": "j", "kind": "generic", "free": free, "markers": ["b.root", "line.root"]});
        let own = with(
            json!({"name": "j", "markers": ["b.root", "line.root"]}),
            joint.clone(),
        );
        let held = json!({"name": "h", "kind": "spherical", "markers": ["ground", "b.tip"]});
        let pair = [generic, own].map(|joint| with(base.clone(), json!({"joints": [held, joint]})));
        move_alike(&joint.to_string(), [&pair[0], &pair[1]], 1e-6);
    }
}
