//! Resources that are missing, broken or read-only, and a disk that is full: a unit says what it could
//! not read, and never writes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr;
use std::time::{Duration, Instant};

use crate::support::{CO_SIMULATION, Instance, Record, SCENE, State, Status, Unit, call};

/// Where the child process of a test finds its unit.
const UNIT: &str = "FLEXBODY_TEST_UNIT";

/// Why a unit is not instantiated.
fn refusal(unit: &Unit) -> String {
    let record = Record::default();
    let callbacks = record.callbacks();
    let (name, guid, location) = (c"instance", unit.guid.as_ptr(), unit.location.as_ptr());
    let component = call!(
        fmi2Instantiate,
        name.as_ptr(),
        CO_SIMULATION,
        guid,
        location,
        &callbacks,
        0,
        0
    );
    assert_eq!(component, ptr::null_mut());
    record.last()
}

#[test]
fn missing_resources_are_named() {
    let unit = Unit::new();
    let scene = unit.folder().join("scene.json");
    fs::remove_file(&scene).expect("a file to remove");
    assert!(refusal(&unit).contains("scene.json"));
    // Something that opens but cannot be read.
    fs::create_dir(&scene).expect("a writable folder");
    assert!(refusal(&unit).contains("scene.json"));
    fs::remove_dir_all(unit.folder()).expect("a folder to remove");
    assert!(refusal(&unit).contains("scene.json"));
}

/// What never ends, or would fill the memory, is refused at once.
#[cfg(unix)]
#[test]
fn a_scene_is_a_regular_file_of_bounded_size() {
    let unit = Unit::new();
    let scene = unit.folder().join("scene.json");
    let began = Instant::now();
    let refused = |found: &str| {
        let reason = refusal(&unit);
        let expected = format!("expected a regular file of at most 67108864 bytes, found {found}");
        assert!(reason.contains("scene.json"), "{reason}");
        assert!(reason.ends_with(&expected), "{reason}");
        fs::remove_file(&scene).expect("a file to remove");
    };
    fs::remove_file(&scene).expect("a file to remove");
    std::os::unix::fs::symlink("/dev/zero", &scene).expect("a writable folder");
    refused("a device or a pipe");
    let made = Command::new("mkfifo").arg(&scene).status();
    assert!(made.expect("mkfifo").success());
    refused("a device or a pipe");
    let large = fs::File::create(&scene).expect("a writable folder");
    large.set_len(10 << 30).expect("a file with a hole");
    refused("10737418240");
    let large = fs::File::create(&scene).expect("a writable folder");
    large.set_len(1 + (1 << 26)).expect("a file with a hole");
    refused("67108865");
    assert!(
        began.elapsed() < Duration::from_secs(5),
        "{:?}",
        began.elapsed()
    );
}

#[test]
fn a_scene_cut_off_anywhere_is_refused() {
    let unit = Unit::new();
    let whole = SCENE.trim_end();
    for length in (0..whole.len()).step_by(13).chain([whole.len() - 1]) {
        unit.overwrite(&whole.as_bytes()[..length]);
        assert!(refusal(&unit).contains("scene.json"), "{length} bytes");
    }
    unit.overwrite(whole.as_bytes());
    drop(Instance::new(&unit));
}

/// Every kind of call, failing ones among them.
fn life(unit: &Unit) {
    let instance = Instance::started(unit);
    let expected = instance.run(0, 3);
    let bytes = instance.fingerprint();
    assert_eq!(instance.set("rod.tip.force[1]", 1e300), Status::Ok);
    assert_eq!(instance.step(0.06, 0.1), Status::Discard);
    let state = instance.deserialize(&bytes).expect("its own bytes");
    assert_eq!(instance.restore(state), Status::Ok);
    instance.free(state);
    assert_eq!(call!(fmi2Reset, instance.component), Status::Ok);
    instance.start();
    assert_eq!(instance.run(0, 3), expected);
    drop(Instance::in_state(unit, State::Error));
}

#[test]
fn read_only_resources_are_enough_and_stay_as_they_are() {
    let unit = Unit::new();
    let set = |read_only| {
        for path in [unit.folder().join("scene.json"), unit.folder().into()] {
            let mut rights = fs::metadata(&path).expect("a file").permissions();
            rights.set_readonly(read_only);
            fs::set_permissions(&path, rights).expect("its owner");
        }
    };
    set(true);
    life(&unit);
    set(false);
    let left = fs::read_dir(unit.folder()).expect("the folder").count();
    assert_eq!(left, 1);
    let scene = fs::read_to_string(unit.folder().join("scene.json"));
    assert_eq!(scene.expect("the scene"), SCENE);
}

/// A file that grows by a byte ends the child: so would any on a full disk.
#[cfg(unix)]
#[test]
fn a_unit_runs_on_a_full_disk() {
    let unit = Unit::new();
    let child = |test: &str| {
        let program = std::env::current_exe().expect("this program");
        let output = Command::new("sh")
            .args(["-c", "ulimit -f 0; exec \"$@\"", "sh"])
            .arg(program)
            .args(["--exact", test, "--ignored"])
            .env(UNIT, unit.folder())
            .current_dir(unit.folder())
            .output();
        output.expect("a shell")
    };
    let lived = child("resources::child_that_lives");
    assert!(lived.status.success(), "{lived:?}");
    assert!(String::from_utf8_lossy(&lived.stdout).contains("1 passed"));
    let wrote = child("resources::child_that_writes");
    assert!(!wrote.status.success(), "the limit does not hold");
}

fn given() -> PathBuf {
    std::env::var_os(UNIT).expect("a folder").into()
}

#[test]
#[ignore = "run by another test, in a process that cannot write"]
fn child_that_lives() {
    let unit = Unit::at(given(), SCENE);
    life(&unit);
    // The folder belongs to the test that started this process.
    std::mem::forget(unit);
}

#[test]
#[ignore = "run by another test, in a process that cannot write"]
fn child_that_writes() {
    let folder: &Path = &given();
    fs::write(folder.join("other.txt"), "text").expect("room");
}
