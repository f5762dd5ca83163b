//! Tables of inputs and values that are set, as options of the program: what is planned is what will be run.

mod place;
#[path = "place/printed.rs"]
mod printed;

use place::Place;

/// A beam between two pins with a force at its middle, whose mesh is left to the planner.
const SCENE: &str = include_str!("place/beam.json");
const TABLE: &str = "time,rod.middle.force[2]\n0,0\n0.02,-10\n";
/// What is said of inputs that were held.
const HELD: &str = "inputs held at their start values: ";

/// A folder with the scene and a table.
fn place(name: &str) -> Place {
    let files = [("scene.json", SCENE), ("table.csv", TABLE)];
    Place::new(&format!("inputs-{name}"), &files)
}

/// The force that a table moves is not among those that are held; without the table both components are.
#[test]
fn a_plan_is_made_for_the_table_that_is_run() {
    let place = place("plan");
    let both = format!("{HELD}rod.middle.force[1], rod.middle.force[2]");
    let one = format!("{HELD}rod.middle.force[1]");
    let table = ["--input", "table.csv"];
    for command in ["plan", "simulate"] {
        let (done, printed) = place.printed(&[command, "scene.json"]);
        assert!(done && printed.contains(&both), "{printed}");
        let (done, printed) = place.printed(&[&[command, "scene.json"][..], &table].concat());
        assert!(
            done && printed.contains(&one) && !printed.contains(&both),
            "{printed}"
        );
    }
    let view = ["view", "scene.json", "--output", "page.html", "--no-open"];
    let spline = ["--interpolation", "spline"];
    let (done, printed) = place.printed(&[&view[..], &table, &spline].concat());
    assert!(
        done && printed.contains(&one) && !printed.contains(&both),
        "{printed}"
    );
}

#[test]
fn what_cannot_be_planned_for_is_refused_by_name() {
    let place = place("refused");
    for (option, expected) in [
        ("rod.densty=1", "did you mean `rod.density`?"),
        (
            "rod.elements=4",
            "rod.elements: expected a parameter that is not planned",
        ),
        ("rod.density", "expected NAME=VALUE"),
    ] {
        let (done, printed) = place.printed(&["plan", "scene.json", "--set", option]);
        assert!(!done && printed.contains(expected), "{printed}");
    }
    std::fs::write(
        place.0.join("table.csv"),
        "time,rod.midle.force[2]\n0,0\n1,0\n",
    )
    .expect("a table");
    let (done, printed) = place.printed(&["plan", "scene.json", "--input", "table.csv"]);
    assert!(
        !done && printed.contains("did you mean `rod.middle.force[2]`"),
        "{printed}"
    );
}

/// A run holds inputs at their start values, whatever the scene says for the planner, and tells so.
#[test]
fn a_run_without_a_table_tells_that_profiles_are_for_planning() {
    let place = place("profiles");
    let accuracy = r#""accuracy": {"error": 1e-3, "input_profiles": [{"input": "rod.middle.force[2]", "from": 0.0, "to": -10.0}]}"#;
    let scene = SCENE.replace(r#""accuracy": {"error": 1e-3}"#, accuracy);
    std::fs::write(place.0.join("scene.json"), scene).expect("a writable temporary directory");
    let told = "inputs stay at their start values";
    let (done, printed) = place.printed(&["simulate", "scene.json"]);
    assert!(done && printed.contains(told), "{printed}");
    let (done, printed) = place.printed(&["simulate", "scene.json", "--input", "table.csv"]);
    assert!(done && !printed.contains(told), "{printed}");
}
