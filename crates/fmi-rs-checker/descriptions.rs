//! The checker fmi-rs, on the model description of every scene and on planted faults.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use fmi_rs::model_description::fmi2::ModelDescription;
use serde_json::Value;

use flexbody::fmi2::model_description;
use flexbody::scene::{Scene, beside};

const GOOD: &str = include_str!("../../tests/checkers/good.xml");
/// Each a text of the good description with what stands there instead, and who must notice;
/// `tests/fmpy/test_checkers.py` asks the other checkers.
const FAULTS: &str = include_str!("../../tests/checkers/faults.json");

/// The checker reads names with a C parser that has one state for all threads.
static CHECKER: Mutex<()> = Mutex::new(());

/// What the checker says about a model description.
fn problems(text: &str) -> Vec<String> {
    let _alone = CHECKER.lock().expect("a checker that did not panic");
    let document = match roxmltree::Document::parse(text) {
        Ok(document) => document,
        Err(error) => return vec![error.to_string()],
    };
    match ModelDescription::from_node(&document.root_element()) {
        Ok(description) => { description.validate() }
            .into_iter()
            .map(|problem| problem.message)
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}

/// Every scene below a folder of the project.
fn scenes(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            scenes(&path, found);
        } else if name.ends_with(".json") && name != "case.json" && !name.ends_with(".schema.json")
        {
            found.push(path);
        }
    }
}

#[test]
fn nothing_is_wrong_with_any_scene() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut paths = Vec::new();
    for folder in ["scenes", "tests/cases", "tests/fmpy"] {
        scenes(&root.join(folder), &mut paths);
    }
    assert!(
        paths.len() > 40,
        "expected every scene, found {}",
        paths.len()
    );
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable scene");
        let files = beside(path.parent().expect("a folder"));
        let scene = Scene::from_json_with(&text, &files).expect("a valid scene");
        let found = problems(&model_description(&scene));
        assert!(found.is_empty(), "{}: {found:?}", path.display());
    }
}

#[test]
fn nothing_is_wrong_with_the_good_description() {
    assert_eq!(problems(GOOD), [""; 0]);
}

#[test]
fn planted_faults_are_noticed_as_the_table_says() {
    let faults: Vec<Value> = serde_json::from_str(FAULTS).expect("a table of faults");
    let mut wrong = Vec::new();
    for fault in faults {
        let text = |key: &str| {
            fault[key]
                .as_str()
                .unwrap_or_else(|| panic!("{fault}: no {key}"))
        };
        let (name, old) = (text("fault"), text("old"));
        assert_eq!(GOOD.matches(old).count(), 1, "{name}: cannot be planted");
        let found = problems(&GOOD.replace(old, text("new")));
        let noticed_by = fault["noticed_by"].as_array().expect("a list of checkers");
        if noticed_by.iter().any(|checker| checker == "fmi-rs") == found.is_empty() {
            wrong.push(format!("{name}: {found:?}"));
        }
    }
    assert_eq!(wrong, [""; 0]);
}
