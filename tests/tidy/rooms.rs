//! What may know what.

use crate::tidy::source::{Source, no_complaints, sources, words};

/// Rooms from the ground up; a file imports lower floors or its own room.
const FLOORS: [&str; 12] = [
    "math",
    "elements",
    "bodies",
    "system",
    "integrators",
    "scene",
    "simulation",
    "picture",
    "view",
    "page",
    "fmi",
    "fmi2",
];

fn floor(room: &str) -> Option<usize> {
    FLOORS.iter().position(|name| *name == room)
}

/// First segments of all paths that start at `crate`.
fn imports(source: &Source) -> Vec<(usize, String)> {
    segments(source, "crate::")
}

/// What follows a prefix in all paths that start with it.
fn segments(source: &Source, prefix: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (at, _) in source.code.match_indices(prefix) {
        let rest = &source.code[at + prefix.len()..];
        let names = match rest.strip_prefix('{') {
            Some(list) => first_segments(list),
            None => vec![identifier(rest)],
        };
        found.extend(names.into_iter().map(|name| (source.line(at), name)));
    }
    found
}

fn identifier(text: &str) -> String {
    text.chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

/// First segments of a braced list, without what is nested in it.
fn first_segments(list: &str) -> Vec<String> {
    let (mut depth, mut item, mut items) = (1, String::new(), Vec::new());
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => items.push(std::mem::take(&mut item)),
            c if depth == 1 => item.push(c),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    items.push(item);
    let names = items.iter().map(|item| identifier(item.trim()));
    names.filter(|name| !name.is_empty()).collect()
}

#[test]
fn a_file_imports_lower_floors_or_its_own_room() {
    let mut complaints = Vec::new();
    for source in sources(&["src"]) {
        let Some(room) = source.room() else {
            continue;
        };
        let own = floor(room);
        if own.is_none() {
            complaints.push(format!("{}: no floor for the room {room}", source.path));
        }
        for (line, name) in imports(&source) {
            let allowed = name == room || floor(&name).is_some_and(|f| Some(f) < own);
            if !allowed {
                complaints.push(format!(
                    "{}:{line}: {room} imports crate::{name}",
                    source.path
                ));
            }
        }
        // A way around the check above.
        for (at, _) in source.code.match_indices("super::super") {
            let line = source.line(at);
            complaints.push(format!(
                "{}:{line}: write crate:: for super::super",
                source.path
            ));
        }
    }
    no_complaints(&complaints);
}

/// Rooms inside `system/` from the ground up; a file in one imports lower ones, its own, and the files beside them.
const INNER: [&str; 6] = ["joints", "loads", "motion", "spectra", "outputs", "start"];

/// Names that `system/mod.rs` hands on, each with its room.
fn handed_on() -> Vec<(String, usize)> {
    let face = Source::read("src/system/mod.rs");
    let mut names = Vec::new();
    for (room, name) in INNER.iter().enumerate() {
        let prefix = format!("pub use {name}::");
        for (at, _) in face.code.match_indices(&prefix) {
            let path = face.code[at + prefix.len()..]
                .split(';')
                .next()
                .unwrap_or_default();
            let last = path.rsplit("::").next().unwrap_or_default();
            let list = last.trim_start_matches('{').trim_end_matches('}');
            names.extend(list.split(',').map(|name| (identifier(name.trim()), room)));
        }
    }
    names
}

#[test]
fn inside_the_system_too_a_file_imports_lower_rooms_or_its_own() {
    let handed_on = handed_on();
    assert!(handed_on.iter().any(|(name, _)| name == "DrivenSystem"));
    let mut complaints = Vec::new();
    for source in sources(&["src/system"]) {
        let inside = source.inside().unwrap_or_default();
        let parts: Vec<&str> = inside.split('/').collect();
        let [_, room, file, ..] = parts[..] else {
            continue;
        };
        let Some(own) = INNER.iter().position(|name| *name == room) else {
            continue;
        };
        let mut paths = segments(&source, "crate::system::");
        if file == "mod.rs" {
            // Above a room is the system itself.
            paths.extend(segments(&source, "super::"));
        }
        for (line, name) in paths {
            let room = INNER.iter().position(|room| *room == name);
            let through = || {
                let mut named = handed_on.iter().filter(|(handed, _)| *handed == name);
                named.next().map(|(_, room)| *room)
            };
            if room.or_else(through).is_some_and(|room| room > own) {
                complaints.push(format!(
                    "{}:{line}: {} imports {name}",
                    source.path, INNER[own]
                ));
            }
        }
    }
    no_complaints(&complaints);
}

#[test]
fn lists_of_imports_are_understood() {
    let source = Source {
        path: "src/bodies/planted.rs".into(),
        text: String::new(),
        code: "use crate::{elements::{Element, Nodal}, math};\nuse crate::fmi2::abi;".into(),
    };
    let names: Vec<String> = imports(&source).into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["elements", "math", "fmi2"]);
}

/// Words that only some files may use: word, files by prefix below `src/`.
const OWNERS: [(&str, &[&str]); 14] = [
    ("faer", &["math/"]),
    ("pulp", &["math/lanes.rs"]),
    ("num_dual", &["math/expression.rs", "math/jet.rs"]),
    ("serde", &["scene/", "picture/stroke.rs"]),
    ("serde_json", &["scene/", "picture/stroke.rs"]),
    ("serde_path_to_error", &["scene/"]),
    ("schemars", &["scene/"]),
    ("libc", &["fmi2/abi.rs", "fmi/place.rs"]),
    ("quick_xml", &["page/canvas.rs", "fmi/xml.rs"]),
    (
        "sha2",
        &["fmi/guid.rs", "fmi/state.rs", "scene/container.rs"],
    ),
    ("cpu_time", &["stopwatch.rs"]),
    ("clap", &["main.rs", "viewing.rs"]),
    ("strsim", &["scene/alike.rs"]),
    ("indicatif", &["main.rs", "planning.rs", "viewing.rs"]),
];

#[test]
fn libraries_are_used_in_their_own_room_only() {
    let mut complaints = Vec::new();
    for source in sources(&["src"]) {
        let inside = source.inside().unwrap_or_default();
        for (word, owners) in OWNERS {
            if owners.iter().any(|owner| inside.starts_with(owner)) {
                continue;
            }
            if let Some(at) = words(source.product(), word).next() {
                let line = source.line(at);
                complaints.push(format!(
                    "{}:{line}: {word} belongs to {owners:?}",
                    source.path
                ));
            }
        }
    }
    no_complaints(&complaints);
}

/// A version gives its names to what is shared: these rooms say none themselves, not even in a text.
#[test]
fn what_versions_of_fmi_share_names_no_function_of_one() {
    let mut complaints = Vec::new();
    for source in sources(&["src/page", "src/fmi"]) {
        let lines = source.text.lines().enumerate();
        let names = |line: &str| {
            ["fmi2", "fmi3"]
                .iter()
                .any(|version| line.contains(version))
        };
        let found = lines.filter(|(_, line)| !line.trim_start().starts_with("//") && names(line));
        complaints.extend(found.map(|(at, line)| format!("{}:{}: {line}", source.path, at + 1)));
    }
    no_complaints(&complaints);
}

/// What a step must not do: talk to the world, look at clocks, keep anything global.
const WORLD: [&str; 14] = [
    "std::fs",
    "std::io",
    "std::env",
    "std::time",
    "std::net",
    "std::process",
    "std::thread",
    "println!",
    "eprintln!",
    "static mut",
    "thread_local!",
    "OnceLock",
    "LazyLock",
    "HashMap",
];

#[test]
fn below_the_scene_and_in_the_simulation_nothing_sees_the_world() {
    let rooms = [
        "math",
        "elements",
        "bodies",
        "system",
        "integrators",
        "simulation",
    ];
    let mut complaints = Vec::new();
    for source in sources(&["src"]) {
        if !source.room().is_some_and(|room| rooms.contains(&room)) {
            continue;
        }
        for word in WORLD {
            if let Some(at) = source.product().find(word) {
                complaints.push(format!("{}:{}: {word}", source.path, source.line(at)));
            }
        }
        // The same in the form of a grouped import.
        for word in ["fs", "io", "env", "time", "net", "process", "thread"] {
            let lines = source.product().lines();
            let mut imports = lines.filter(|line| line.trim_start().starts_with("use std::{"));
            if imports.any(|line| words(line, word).next().is_some()) {
                complaints.push(format!("{}: use std::{{{word}}}", source.path));
            }
        }
    }
    no_complaints(&complaints);
}

/// Lists of a scene whose parts name others. Only `scene/` reads them and finds what the names refer to;
/// parameters are written into them.
const NAMED: [&str; 7] = [
    "masses", "joints", "motions", "loads", "inputs", "outputs", "ports",
];

/// Where a list of a scene as described is read: `.scene.joints` or `scene.joints`, not
/// `resolved.joints`, and not to set a value (`scene.joints[i].stiffness = ...`).
fn reads_of_names(code: &str) -> Vec<usize> {
    let mut found = Vec::new();
    for at in words(code, "scene") {
        let rest = code[at + "scene".len()..].trim_start();
        let Some(rest) = rest
            .strip_prefix("()")
            .unwrap_or(rest)
            .trim_start()
            .strip_prefix('.')
        else {
            continue;
        };
        let rest = rest.trim_start();
        let line = rest.split(&['\n', ';', ','][..]).next().unwrap_or_default();
        if NAMED.contains(&&*identifier(rest)) && !line.contains(" = ") {
            found.push(at);
        }
    }
    found
}

#[test]
fn what_a_scene_names_is_found_in_its_own_room_only() {
    let mut complaints = Vec::new();
    for source in sources(&["src"]) {
        if source.room() == Some("scene") {
            continue;
        }
        for at in reads_of_names(source.product()) {
            let line = source.line(at);
            complaints.push(format!(
                "{}:{line}: reads names, not what they refer to",
                source.path
            ));
        }
    }
    no_complaints(&complaints);
    let planted =
        "let j = scene\n    .joints.iter(); self.scene().loads; scene.ports[i].damping = Some(v);";
    assert_eq!(reads_of_names(planted).len(), 2);
    assert!(reads_of_names("resolved.joints.iter(); scene.bodies[0]").is_empty());
}

/// Files by prefix below `src/`, with rooms that they must not know although those are below them.
const STRANGERS: [(&str, &[&str]); 6] = [
    ("system/joints/", &["elements", "Cable", "integrators"]),
    ("system/loads/", &["Cable", "joints", "integrators"]),
    (
        "integrators/",
        &[
            "bodies",
            "elements",
            "joints",
            "loads",
            "System",
            "Constraints",
            "Marker",
        ],
    ),
    ("elements/", &["node", "nodes", "joint", "body"]),
    ("bodies/", &["joint", "joints", "load", "loads", "drive"]),
    (
        "math/",
        &[
            "body", "bodies", "element", "joint", "joints", "load", "marker",
        ],
    ),
];

#[test]
fn no_element_knows_nodes_no_joint_elements_no_integrator_joints() {
    let mut complaints = Vec::new();
    for source in sources(&["src"]) {
        let inside = source.inside().unwrap_or_default();
        for (place, strangers) in STRANGERS {
            for stranger in strangers {
                let mut found = words(source.product(), stranger);
                if let Some(at) = found.next().filter(|_| inside.starts_with(place)) {
                    let line = source.line(at);
                    complaints.push(format!("{}:{line}: knows {stranger}", source.path));
                }
            }
        }
    }
    no_complaints(&complaints);
}

/// Kinds of joints, motions and loads: their names stand in their own rooms, where parts are put together,
/// and nowhere in what computes with them.
#[test]
fn what_computes_does_not_know_kinds_of_joints_and_loads() {
    let kinds = [
        "JointKind",
        "Revolute",
        "Weld",
        "Slider",
        "Hinge",
        "Rotational",
        "Distributed",
    ];
    let mut complaints = Vec::new();
    for file in [
        "motion/dynamics.rs",
        "motion/forces.rs",
        "motion/multipliers.rs",
        "spectra/fastest.rs",
        "workspace.rs",
    ] {
        let source = Source::read(&format!("src/system/{file}"));
        for kind in kinds {
            if let Some(at) = words(source.product(), kind).next() {
                complaints.push(format!("{}:{}: knows {kind}", source.path, source.line(at)));
            }
        }
    }
    no_complaints(&complaints);
}

#[test]
fn every_element_and_integrator_names_its_source() {
    let mut complaints = Vec::new();
    for source in sources(&["src/elements", "src/integrators"]) {
        let docs = source
            .text
            .lines()
            .take_while(|line| line.starts_with("//!"));
        let named = docs.map(|line| line.trim_start_matches("//!").trim_start());
        let has_source = { named }.any(|line| line.starts_with("Source:"));
        if !source.path.ends_with("/mod.rs") && !has_source {
            complaints.push(format!("{}: no line \"//! Source: ...\"", source.path));
        }
    }
    no_complaints(&complaints);
}

#[test]
fn every_integrator_has_its_row_in_the_test_of_order() {
    let order = Source::read("tests/order/mod.rs").text;
    let methods = sources(&["src/integrators"]).into_iter();
    for source in methods.filter(|source| source.text.contains("Method for ")) {
        let file = source.path.rsplit('/').next().unwrap_or_default();
        let stem = file.trim_end_matches(".rs");
        // A file with several methods names each.
        let parts = source.text.split("name: \"").skip(1);
        let named: Vec<&str> = parts.filter_map(|part| part.split('"').next()).collect();
        let names = if named.is_empty() { vec![stem] } else { named };
        for name in names {
            let row = format!("name: \"{name}\"");
            assert!(order.contains(&row), "{name}: no row in tests/order/mod.rs");
        }
    }
}
