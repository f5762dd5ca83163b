//! Writes states of every scene, saved along its life, into the folder that is named: what fuzzing saved states starts from,
//! in the format of the day.

#[path = "../inputs/saved.rs"]
mod saved;
#[path = "../../../tests/abi/support.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "shared with the tests of the C interface"
)]
mod support;

use std::path::PathBuf;

use saved::{SCENES, opened, sealed, written};
use support::{Instance, InstanceState, Status, Unit};

fn main() {
    let folder = PathBuf::from(std::env::args().nth(1).expect("a folder to write into"));
    std::fs::create_dir_all(&folder).expect("a writable folder");
    for (number, text) in (0_u8..).zip(SCENES) {
        let (unit, scene) = (Unit::of(text), written(text));
        for (name, state, steps) in [
            ("instantiated", InstanceState::Instantiated, 0),
            ("initialization", InstanceState::Initialization, 0),
            ("start", InstanceState::StepComplete, 0),
            ("moving", InstanceState::StepComplete, 3),
            ("terminated", InstanceState::Terminated, 0),
        ] {
            let instance = Instance::in_state(&unit, state);
            instance.run(0, steps);
            let bytes = instance.fingerprint();
            let body = opened(&bytes, &scene);
            let other = Instance::new(&unit);
            let sealed = sealed(&other.fingerprint(), body, &scene);
            let read = other.deserialize(&sealed).expect("a whole state");
            assert_eq!(other.restore(read), Status::Ok);
            assert_eq!(other.fingerprint(), bytes, "{number}-{name}");
            other.free(read);
            let seed = [&[number], body].concat();
            let file = folder.join(format!("{number}-{name}"));
            std::fs::write(file, seed).expect("a writable folder");
        }
    }
}
