//! `"element": "auto"`: what a body becomes, why, and that what shear moves is what Timoshenko's beam says.

use std::f64::consts::PI;

use flexbody::fmi2;
use flexbody::scene::{Body, Chosen, Scene};
use flexbody::simulation::{Budget, Planned, Simulation, plan};
use serde_json::{Value, json};

const YOUNG: f64 = 2.0e9;
const SHEAR: f64 = 0.8e9;

/// A line of one metre on a wall, of round section, of which nothing asks for more than a cable.
fn base() -> Value {
    json!({"name": "auto", "dimension": 3,
        "bodies": [
            {"name": "line", "element": "auto", "elements": 4,
             "material": {"youngs_modulus": YOUNG, "shear_modulus": SHEAR, "density": 1000.0},
             "section": {"shape": {"circle": {"radius": 0.005}}},
             "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0.0, "tip": 1.0}},
            {"name": "block", "element": "rigid", "mass": 1.0, "inertia": [0.01, 0.02, 0.03],
             "position": [1, 0, 0], "markers": {"c": [0, 0, 0]}}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "line.root"]}],
        "accuracy": {"relative_tolerance": 1e-6},
        "outputs": [{"kind": "position", "marker": "line.tip"}]})
}

fn read(scene: &Value) -> Result<Scene, String> {
    Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())
}

fn chosen(scene: &Value) -> Result<Chosen, String> {
    let chosen = read(scene)?.choose_elements();
    let chosen = chosen.map_err(|error| error.to_string())?;
    chosen.into_iter().next().ok_or_else(|| "none".into())
}

fn planned(scene: &Scene) -> (Scene, Planned) {
    plan(scene, &Budget::default(), &mut |_, _, _| ()).unwrap_or_else(|error| panic!("{error}"))
}

fn edited(edit: impl Fn(&mut Value)) -> Value {
    let mut scene = base();
    edit(&mut scene);
    scene
}

fn push(scene: &mut Value, list: &str, part: Value) {
    match scene[list].as_array_mut() {
        Some(parts) => parts.push(part),
        None => scene[list] = json!([part]),
    }
}

/// Numbers of a section that bends alike to all sides.
fn numbers() -> Value {
    json!({"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9})
}

type Edit = fn(&mut Value);

/// What is changed, and what is said then.
const REASONS: [(Edit, &str); 19] = [
    (|_| (), "cable: nothing asks how its sections stand"),
    (|s| s["bodies"][0]["section"] = numbers(), "cable: nothing"),
    (
        |s| {
            s["bodies"][0]["section"] =
                json!({"shape": {"rectangle": {"width": 0.01, "height": 0.01}}})
        },
        "cable: nothing",
    ),
    (
        |s| {
            s["bodies"][0]["section"] =
                json!({"shape": {"rectangle": {"width": 0.01, "height": 0.02}}})
        },
        "rod: it does not bend alike to all sides",
    ),
    (
        |s| {
            s["bodies"][0]["section"] = numbers();
            s["bodies"][0]["section"]["second_moments"] = json!([1e-9, 2e-9]);
        },
        "rod: it does not bend alike to all sides",
    ),
    (
        |s| s["bodies"][0]["axis"] = json!([0, 0, 1]),
        "rod: the axis of its section is given",
    ),
    (
        |s| {
            let body = s["bodies"][0].as_object_mut().expect("a body");
            let section = body.remove("section").expect("a section");
            body.insert(
                "stations".into(),
                json!([{"at": 0, "section": section}, {"at": 1, "section": section, "twist": 0.1}]),
            );
        },
        "rod: it is twisted without stress",
    ),
    (
        |s| {
            s["bodies"][0]["section"] = numbers();
            s["bodies"][0]["section"]["coupling"] = json!([0.1, 0, 0]);
        },
        "rod: its twist, bending or stretching are coupled",
    ),
    (
        |s| {
            s["bodies"][0]["shape"] =
                json!({"arc": {"from": [0, 0, 0], "to": [1, 0, 0], "length": 1.5}});
        },
        "rod: it is curved without stress and bends",
    ),
    (
        |s| {
            push(
                s,
                "joints",
                json!({"name": "hold", "kind": "weld", "markers": ["block.c", "line.tip"]}),
            )
        },
        "rod: joint hold holds its orientation",
    ),
    (
        |s| {
            push(
                s,
                "joints",
                json!({"name": "far", "kind": "weld", "markers": ["ground", "line.tip"]}),
            )
        },
        "rod: joints clamp and far hold its orientation",
    ),
    (
        |s| {
            push(
                s,
                "joints",
                json!({"name": "pivot", "kind": "revolute", "markers": ["block.c", "line.tip"], "direction": [0, 0, 1]}),
            )
        },
        "rod: joint pivot holds its orientation",
    ),
    (
        |s| {
            push(
                s,
                "joints",
                json!({"name": "ball", "kind": "spherical", "markers": ["block.c", "line.tip"]}),
            )
        },
        "cable: nothing",
    ),
    (
        |s| {
            push(
                s,
                "loads",
                json!({"name": "twist", "kind": "moment", "marker": "line.tip", "value": [1, 0, 0]}),
            )
        },
        "rod: load twist turns its sections",
    ),
    (
        |s| {
            push(
                s,
                "loads",
                json!({"name": "pull", "kind": "force", "marker": "line.tip", "value": [1, 0, 0]}),
            )
        },
        "cable: nothing",
    ),
    (
        |s| push(s, "inputs", json!({"kind": "moment", "marker": "line.tip"})),
        "rod: an input at line.tip turns its sections",
    ),
    (
        |s| {
            push(
                s,
                "outputs",
                json!({"kind": "quaternion", "marker": "line.tip"}),
            )
        },
        "rod: an output at line.tip reads its sections",
    ),
    (
        |s| {
            push(
                s,
                "ports",
                json!({"name": "flange", "kind": "force", "marker": "line.tip", "rotation": true}),
            )
        },
        "rod: port flange turns with it",
    ),
    (
        |s| {
            let mut matrix = [[0.0; 6]; 6];
            (0..6).for_each(|k| matrix[k][k] = 1.0);
            s["bodies"][0]["section"] = json!({"stiffness": matrix, "inertia": matrix});
            s["bodies"][0]["material"] = json!({});
        },
        "beam: its sections are given as whole matrices",
    ),
];

#[test]
fn every_reason_is_told_and_makes_its_element() {
    for (edit, told) in REASONS {
        let scene = edited(edit);
        let chosen = chosen(&scene).unwrap_or_else(|error| panic!("{told}: {error}"));
        assert!(chosen.in_words().starts_with(told), "{}", chosen.in_words());
        // What is packaged stands alone, and says the element.
        let scene = read(&scene).expect("a scene");
        assert_eq!(
            Scene::from_json(&scene.to_json()).as_ref(),
            Ok(&scene),
            "{told}"
        );
        let (packaged, planned) = planned(&scene);
        let element = told.split(':').next().expect("a word");
        let again: Value = serde_json::from_str(&packaged.to_json()).expect("JSON");
        assert_eq!(again["bodies"][0]["element"], element);
        assert_eq!(
            Scene::from_json(&packaged.to_json()).as_ref(),
            Ok(&packaged)
        );
        let page = fmi2::describe(&packaged, &planned, "");
        let page = page.iter().find(|(name, _)| name.ends_with("index.html"));
        let text = &page.expect("a page").1;
        assert!(
            text.contains(&format!(
                "<td>{element}</td><td>{}",
                &told[element.len() + 2..]
            )),
            "{told}"
        );
        // The same runs unplanned.
        assert_eq!(Simulation::new(scene).scene(), &packaged);
    }
}

#[test]
fn the_plane_knows_cables_and_beams() {
    let of_thickness = |size: f64| {
        let scene = edited(|s| {
            s["dimension"] = json!(2);
            s["bodies"] = json!([s["bodies"][0]]);
            s["bodies"][0]["shape"] = json!({"line": {"from": [0, 0], "to": [1, 0]}});
            s["bodies"][0]["section"] =
                json!({"shape": {"rectangle": {"width": size, "height": size}}});
        });
        chosen(&scene).expect("a choice").in_words()
    };
    let (thin, thick) = (of_thickness(0.005), of_thickness(0.5));
    assert!(
        thin.starts_with("cable: nothing twists in the plane; shear adds 1.8e-5"),
        "{thin}"
    );
    assert!(thick.starts_with("beam: shear adds 1.8e-1"), "{thick}");
}

/// Two lines that are welded to each other need sections both; one that hangs on a ball does not.
#[test]
fn every_body_is_chosen_by_itself() {
    let scene = edited(|s| {
        for (name, from, to) in [("second", 1, 2), ("third", 2, 3)] {
            let mut body = s["bodies"][0].clone();
            body["name"] = json!(name);
            body["shape"] = json!({"line": {"from": [from, 0, 0], "to": [to, 0, 0]}});
            push(s, "bodies", body);
        }
        push(
            s,
            "joints",
            json!({"name": "seam", "kind": "weld", "markers": ["line.tip", "second.root"]}),
        );
        push(
            s,
            "joints",
            json!({"name": "ball", "kind": "spherical", "markers": ["second.tip", "third.root"]}),
        );
    });
    let chosen = read(&scene)
        .expect("a scene")
        .choose_elements()
        .expect("a choice");
    let words: Vec<String> = chosen.iter().map(Chosen::in_words).collect();
    let seam = "rod: joint seam holds its orientation";
    assert!(
        words[0].starts_with(seam) && words[1].starts_with(seam),
        "{words:?}"
    );
    assert!(words[2].starts_with("cable: nothing"), "{words:?}");
}

#[test]
fn what_is_refused_says_why_it_would_be_needed() {
    let refused: [(Edit, &str); 5] = [
        (
            |s| {
                s["bodies"][0]["material"] = json!({"youngs_modulus": YOUNG, "density": 1000.0});
                push(
                    s,
                    "loads",
                    json!({"name": "twist", "kind": "moment", "marker": "line.tip", "value": [1, 0, 0]}),
                );
            },
            "bodies[0].material.shear_modulus: expected a value, found nothing (a rod: load twist turns its sections)",
        ),
        (
            |s| s["bodies"][0]["material"]["shear_modulus"] = json!(-1.0),
            "bodies[0].material.shear_modulus: expected a positive number (Pa), found -1",
        ),
        (
            |s| {
                push(
                    s,
                    "loads",
                    json!({"name": "pull", "kind": "force", "marker": "line.tap", "value": [1, 0, 0]}),
                )
            },
            "loads[0].marker: expected a marker of this scene",
        ),
        (
            |s| {
                push(
                    s,
                    "loads",
                    json!({"name": "pull", "kind": "moment", "marker": "line.tip", "value": [1, 0]}),
                )
            },
            "loads[0].value: expected",
        ),
        (
            |s| s["bodies"][0]["element"] = json!("any"),
            "bodies[0].element: expected \"cable\", \"rod\", \"beam\", \"auto\", \"rigid\", \"reduced\", \"plate\" or \"shell\", found \"any\"",
        ),
    ];
    for (edit, told) in refused {
        let error = read(&edited(edit)).expect_err(told);
        assert!(error.starts_with(told), "{error}");
    }
}

/// Shear factor of a rectangle by Cowper.
fn of_rectangle() -> f64 {
    let poisson = YOUNG / (2.0 * SHEAR) - 1.0;
    10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson)
}

/// A cantilever of height `h` under a force at its tip that bends it, with as much shear as is asked for: the way of the tip by it,
/// `F L / (k G A)` with Cowper's factor, over the length.
fn sheared(height: f64, part: f64) -> Value {
    let factor = of_rectangle();
    let force = part * factor * SHEAR * 0.5 * height * height;
    edited(|s| {
        s["bodies"] = json!([s["bodies"][0]]);
        s["bodies"][0]["section"] =
            json!({"shape": {"rectangle": {"width": 0.5 * height, "height": height}}});
        push(
            s,
            "loads",
            json!({"name": "press", "kind": "force", "marker": "line.tip", "value": [0, 0, force]}),
        );
        s["initial"] = json!("static_equilibrium");
        s["experiment"] = json!({"stop_time": 1e-4, "step": 1e-4});
    })
}

/// Share of shear in the deflection: `3 E I / (k G A L^2)` with `I / A = h^2 / 12`.
#[test]
fn shear_is_estimated_where_nothing_is_planned() {
    let factor = of_rectangle();
    let height = |part: f64| (4.0 * part * factor * SHEAR / YOUNG).sqrt();
    for (part, element) in [(0.9e-3, "rod"), (1.1e-3, "beam")] {
        let chosen = chosen(&sheared(height(part), 1e-6)).expect("a choice");
        assert_eq!(chosen.element(), element, "{}", chosen.why);
        let told = format!("shear adds {part:.1e} to bending by 3 E I / (k G A L^2)");
        assert!(chosen.why.contains(&told), "{}", chosen.why);
    }
    // Given factors count.
    let scene = edited(|s| {
        s["bodies"][0]["section"] = numbers();
        s["bodies"][0]["section"]["shear_factors"] = json!([0.8, 0.05]);
    });
    let chosen = chosen(&scene).expect("a choice");
    let part = 3.0 * YOUNG * 1e-9 / (0.05 * SHEAR * 1e-4);
    assert!(part > 1e-3 && chosen.element() == "beam", "{}", chosen.why);
    assert!(
        chosen.why.contains(&format!("{part:.1e}")),
        "{}",
        chosen.why
    );
}

/// By how much shear moves the tip, as it is told.
fn moved(why: &str) -> f64 {
    let told = why.split("line.tip.position by ").nth(1);
    let number = told.and_then(|told| told.split([',', ';']).next());
    number.and_then(|text| text.parse().ok()).expect("a number")
}

/// What the planner says that shear moves is its share of the way of the tip, `x / (1 + x)` with `x = 3 E I / (k G A L^2)`, and decides.
#[test]
fn shear_decides_by_what_it_moves_in_the_experiment() {
    let factor = of_rectangle();
    for (part, element) in [(0.6e-3_f64, "rod"), (1.6e-3, "beam")] {
        let height = (4.0 * part / (1.0 - part) * factor * SHEAR / YOUNG).sqrt();
        let mut scene = sheared(height, 1e-6);
        scene["accuracy"] = json!({"error": 1e-3});
        scene["bodies"][0]["elements"] = json!("auto");
        scene["bodies"][0]["model"] = json!("flexible");
        let scene = read(&scene).expect("a scene");
        let (packaged, planned) = planned(&scene);
        let chosen = &planned.elements[0];
        assert_eq!(chosen.element(), element, "{}", chosen.why);
        let moved = moved(&chosen.why);
        assert!((moved / part - 1.0).abs() < 0.1, "{moved} of {part}");
        let is_beam = matches!(packaged.bodies[0], Body::Beam(_));
        assert_eq!(is_beam, element == "beam");
        let numbers = planned.numbers.expect("a plan");
        assert_eq!(numbers.bodies[0].kind, element);
        assert!(
            packaged.bodies[0]
                .cable()
                .is_some_and(|line| line.elements.is_some())
        );
    }
}

/// A thick round line of which nothing asks for sections, with a marker that is no node of a cable, beside a thin one: each is
/// judged by itself, and the thick one is a beam.
#[test]
fn bodies_that_shear_are_told_from_those_that_do_not() {
    let part = 1.6e-3_f64;
    let poisson = YOUNG / (2.0 * SHEAR) - 1.0;
    let factor = 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
    // `x = 3 E r^2 / (4 k G L^2)` of bending, `x / (1 + x)` of both.
    let radius = (4.0 * part / (1.0 - part) * factor * SHEAR / (3.0 * YOUNG)).sqrt();
    let force = 1e-6 * factor * SHEAR * PI * radius * radius;
    let scene = edited(|s| {
        let mut thin = s["bodies"][0].clone();
        thin["name"] = json!("thin");
        s["bodies"] = json!([thin, s["bodies"][0]]);
        s["bodies"][1]["section"] = json!({"shape": {"circle": {"radius": radius}}});
        s["bodies"][1]["markers"]["inside"] = json!(0.37);
        for body in [0, 1] {
            s["bodies"][body]["elements"] = json!("auto");
        }
        push(
            s,
            "joints",
            json!({"name": "other", "kind": "weld", "markers": ["ground", "thin.root"]}),
        );
        push(
            s,
            "loads",
            json!({"name": "press", "kind": "force", "marker": "line.tip", "value": [0, 0, force]}),
        );
        push(
            s,
            "loads",
            json!({"name": "touch", "kind": "force", "marker": "thin.tip", "value": [0, 0, 0.01]}),
        );
        push(
            s,
            "outputs",
            json!({"kind": "position", "marker": "thin.tip"}),
        );
        s["initial"] = json!("static_equilibrium");
        s["experiment"] = json!({"stop_time": 1e-4, "step": 1e-4});
        s["accuracy"] = json!({"error": 1e-3});
    });
    let (packaged, planned) = planned(&read(&scene).expect("a scene"));
    let [thin, thick] = &planned.elements[..] else {
        panic!("{:?}", planned.elements)
    };
    let nothing = "nothing asks how its sections stand; shear moves ";
    assert!(
        thin.element() == "cable" && thin.why.starts_with(nothing),
        "{}",
        thin.why
    );
    assert!(thick.element() == "beam", "{}", thick.why);
    let moved = moved(&thick.why);
    assert!((moved / part - 1.0).abs() < 0.1, "{moved} of {part}");
    let kinds = packaged
        .bodies
        .iter()
        .map(|body| matches!(body, Body::Beam(_)));
    assert_eq!(kinds.collect::<Vec<_>>(), [false, true]);
}
