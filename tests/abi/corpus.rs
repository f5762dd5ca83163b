//! What fuzzing has kept, put through the same checks without sanitizers.

#[path = "../../crates/fuzz/inputs/calls.rs"]
mod calls;
#[path = "../../crates/fuzz/inputs/container.rs"]
mod container;
#[path = "../../crates/fuzz/inputs/scene.rs"]
mod scene;
#[path = "../../crates/fuzz/inputs/state.rs"]
mod state;

/// Puts every stored input of a kind through, in the order of their names.
fn replayed(kind: &str, put_through: fn(&[u8])) {
    let folder = crate::root().join("crates/fuzz/corpus").join(kind);
    let entries = std::fs::read_dir(folder).expect("a folder of inputs");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    assert!(files.len() > 10, "{} inputs", files.len());
    for file in files {
        println!("{}", file.display());
        put_through(&std::fs::read(&file).expect("an input"));
    }
}

#[test]
fn stored_scenes_are_refused_or_simulated() {
    replayed("scene", scene::put_through);
}

#[test]
fn stored_containers_are_refused_or_simulated() {
    replayed("container", container::put_through);
}

#[test]
fn stored_states_are_refused_or_restored() {
    replayed("state", state::put_through);
}

#[test]
fn stored_calls_are_answered_as_the_standard_says() {
    replayed("calls", calls::put_through);
}
