//! Resources that are missing, broken or read-only, and a disk that is full: a unit says what it could
//! not read, and never writes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::{CO_SIMULATION, Instance, InstanceState, Record, SCENE, Status, Unit, call};

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

/// The files that a scene names are read with it, and stand in its GUID.
#[test]
fn files_of_a_scene_are_those_that_were_packaged() {
    let scene = include_str!("../../docs/book/examples/bodies/reduced.json");
    let file: &[u8] = include_bytes!("../../docs/book/examples/bodies/strip.safetensors");
    let unit = Unit::with(scene, &[("strip.safetensors", file)]);
    let path = unit.folder().join("strip.safetensors");
    let instance = Instance::new(&unit);
    instance.start();
    let bytes = instance.fingerprint();
    let state = instance.deserialize(&bytes).expect("its own bytes");
    assert_eq!(instance.restore(state), Status::Ok);
    instance.free(state);
    // A state has no files: an instance without resources says so.
    let bare = Instance::bare(&unit);
    let state = bare.deserialize(&bytes).expect("bytes of its model");
    assert_eq!(bare.restore(state), Status::Error);
    let told = bare.record.last();
    assert!(
        told.contains("has no folder that files are read from"),
        "{told}"
    );
    bare.free(state);
    // Another file with another source in words is another model.
    let mut other = file.to_vec();
    let word = other.windows(4).position(|bytes| bytes == b"Ritz");
    other[word.expect("its source")] = b'r';
    fs::write(&path, &other).expect("a writable folder");
    let told = refusal(&unit);
    assert!(told.contains("fmuGUID"), "{told}");
    fs::write(&path, &file[..1000]).expect("a writable folder");
    let told = refusal(&unit);
    assert!(
        told.contains("bodies[0].file: \"strip.safetensors\": header"),
        "{told}"
    );
    fs::remove_file(&path).expect("a file to remove");
    let told = refusal(&unit);
    assert!(
        told.contains("bodies[0].file: \"strip.safetensors\": "),
        "{told}"
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
    drop(Instance::in_state(unit, InstanceState::Error));
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
    let lived = child("abi::resources::child_that_lives");
    assert!(lived.status.success(), "{lived:?}");
    assert!(String::from_utf8_lossy(&lived.stdout).contains("1 passed"));
    let wrote = child("abi::resources::child_that_writes");
    assert!(!wrote.status.success(), "the limit does not hold");
}

/// A program stands for the library here: what matters is that it is asked where it is.
#[cfg(target_os = "linux")]
#[test]
fn an_empty_location_is_that_beside_the_library() {
    let unit = Unit::new();
    let root = unit.folder().join("unit");
    for folder in ["resources", "binaries/linux64"] {
        fs::create_dir_all(root.join(folder)).expect("a writable folder");
    }
    fs::write(root.join("resources/scene.json"), SCENE).expect("a writable folder");
    let library = root.join("binaries/linux64/flexbody.so");
    fs::copy(std::env::current_exe().expect("this program"), &library).expect("a copy");
    let lived = Command::new(&library)
        .args([
            "--exact",
            "abi::resources::child_beside_its_resources",
            "--ignored",
        ])
        .env(UNIT, unit.folder())
        .output()
        .expect("a copy that runs");
    assert!(lived.status.success(), "{lived:?}");
    assert!(String::from_utf8_lossy(&lived.stdout).contains("1 passed"));
    // Where nothing is beside it, what was looked for is told.
    let mut bare = Unit::new();
    bare.location = c"".into();
    assert!(refusal(&bare).contains("resources/scene.json"));
}

#[test]
#[ignore = "run by another test, as a program beside resources"]
fn child_beside_its_resources() {
    let mut unit = Unit::at(given(), SCENE);
    unit.location = c"".into();
    drop(Instance::started(&unit));
    // The folder belongs to the test that started this process.
    std::mem::forget(unit);
}

/// Kinds of bodies, each so large that it takes more memory than the child may have.
const LARGE: [&str; 4] = ["cable", "rod", "beam", "rigid"];

fn large(element: &str) -> String {
    let bodies = match element {
        "rigid" => (0..21_000)
            .map(|index| {
                json!({"name": format!("b{index}"), "element": "rigid", "mass": 1, "inertia": [0.1, 0.2, 0.15],
                    "position": [index, 0, 0]})
            })
            .collect(),
        _ => vec![line(element)],
    };
    json!({"name": "large", "dimension": 3, "bodies": bodies,
        "accuracy": {"relative_tolerance": 1e-3}})
    .to_string()
}

fn line(element: &str) -> Value {
    let mut material = json!({"youngs_modulus": 2e11, "density": 7800});
    let mut section = json!({"area": 1e-4, "second_moment": 1e-9});
    if element != "cable" {
        material["shear_modulus"] = json!(8e10);
        section = json!({"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9});
    }
    if element == "beam" {
        section["shear_factors"] = json!([0.85, 0.85]);
    }
    json!({"name": "line", "element": element, "elements": 50_000, "material": material, "section": section,
        "shape": {"line": {"from": [0, 0, 0], "to": [5000, 0, 0]}}})
}

/// A kind of body whose memory is not asked for before it is taken ends the child.
#[cfg(target_os = "linux")]
#[test]
fn memory_that_runs_out_is_an_error_for_every_kind_of_body() {
    for element in LARGE {
        let program = std::env::current_exe().expect("this program");
        let output = Command::new("sh")
            .args(["-c", "ulimit -v 400000; exec \"$@\"", "sh"])
            .arg(program)
            .args([
                "--exact",
                "abi::resources::child_without_memory",
                "--ignored",
                "--test-threads=1",
            ])
            .env(UNIT, element)
            .output()
            .expect("a shell");
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success() && told.contains("1 passed"),
            "{element}: {output:?}"
        );
    }
}

#[test]
#[ignore = "run by another test, in a process with little memory"]
fn child_without_memory() {
    let element = given();
    let unit = Unit::of(&large(element.to_str().expect("a name")));
    let instance = Instance::new(&unit);
    let c = instance.component;
    assert_eq!(
        call!(fmi2SetupExperiment, c, 0, 0.0, 0.0, 0, 0.0),
        Status::Ok
    );
    assert_eq!(call!(fmi2EnterInitializationMode, c), Status::Error);
    let told = instance.record.last();
    assert!(told.contains("expected memory for"), "{told}");
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
