//! Scenes that name files: they are read beside the scene and from FMUs, and go into what is packaged.

mod place;
#[path = "place/printed.rs"]
mod printed;

use place::Place;

const SCENE: &str = include_str!("../../../docs/book/examples/bodies/reduced.json");
const MODEL: &[u8] = include_bytes!("../../../docs/book/examples/bodies/strip.safetensors");
/// A file with stress on its surface, and one with second-order displacements of pairs of four of its five modes.
const BRACKET: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/bracket.safetensors"
);
const PAIRS: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/cases/reduced_bracket/bracket.safetensors"
);

/// A folder with the scene in a folder of its own, and the file that it names.
fn place(name: &str) -> Place {
    let place = Place::new(&format!("reduced-{name}"), &[]);
    let folder = place.0.join("scene");
    std::fs::create_dir_all(&folder).expect("a writable temporary directory");
    std::fs::write(folder.join("scene.json"), SCENE).expect("a writable file");
    std::fs::write(folder.join("strip.safetensors"), MODEL).expect("a writable file");
    place
}

#[test]
fn a_file_of_a_reduced_model_is_described() {
    let place = place("describe");
    let (done, printed) = place.printed(&["describe", "scene/strip.safetensors"]);
    assert!(done, "{printed}");
    for line in [
        "source: Ritz polynomials of a slender strip",
        "mass: 0.35325 kg",
        "centre of mass: [0.25, 0, 0] m",
        "inertia about it (xx yy zz xy xz yz): [2.67587e-5, 0.00735964, 0.00738587, 0, 0, 0] kg m^2",
        "modes: 6",
        "interface root: frame (with rotations) at [0, 0, 0] m, with second-order displacements",
        "interface tip: frame (with rotations) at [0.5, 0, 0] m, with second-order displacements",
        "second-order terms: of pairs of the first 6 modes",
        "surface: 18 points, 16 triangles",
        "stresses: root",
    ] {
        assert!(
            printed.lines().any(|found| found == line),
            "{line}\n{printed}"
        );
    }
    for (file, line) in [
        (BRACKET, "surface: 120 points, 236 triangles, with stress"),
        (
            PAIRS,
            "second-order terms: of pairs of the first 4 modes; a basis that combines others lacks theirs",
        ),
    ] {
        let (done, printed) = place.printed(&["describe", file]);
        assert!(
            done && printed.lines().any(|found| found == line),
            "{printed}"
        );
    }
    // A free strip: 22.373 / (2 pi) sqrt(E I / m) / L^2 is 64.0 Hz.
    let frequencies = printed.lines().find(|line| line.starts_with("natural"));
    assert!(
        frequencies.is_some_and(|line| line.contains(": 64.")),
        "{printed}"
    );
    let output = ["--output", "folder"];
    let model = ["describe", "scene/strip.safetensors"];
    let (done, printed) = place.printed(&[&model[..], &output].concat());
    assert!(
        !done && printed.contains("--output: expected a scene beside it"),
        "{printed}"
    );
    let (done, printed) = place.printed(&["describe", "scene/scene.json"]);
    assert!(
        !done && printed.contains("--output: expected a directory"),
        "{printed}"
    );
    std::fs::write(place.0.join("cut.safetensors"), &MODEL[..2000]).expect("a writable file");
    let (done, printed) = place.printed(&["describe", "cut.safetensors"]);
    assert!(
        !done && printed.contains("cut.safetensors: inertia_1: expected data_offsets"),
        "{printed}"
    );
}

#[test]
fn what_an_fmu_holds_has_the_file_and_its_digest() {
    let place = place("package");
    let describe = [
        "describe",
        "scene/scene.json",
        "--output",
        "fmu",
        "--no-animation",
    ];
    let (done, printed) = place.printed(&describe);
    assert!(done, "{printed}");
    let resources = place.0.join("fmu/resources");
    let file = std::fs::read(resources.join("strip.safetensors")).expect("the file");
    assert_eq!(file, MODEL);
    let scene = std::fs::read_to_string(resources.join("scene.json")).expect("the scene");
    assert!(scene.contains("\"sha256\": \""), "{scene}");
    // The scene of the unit is read beside its file, and not beside another one.
    let plan = ["plan", "fmu/resources/scene.json"];
    let (done, printed) = place.printed(&plan);
    assert!(done, "{printed}");
    let mut other = MODEL.to_vec();
    let word = other.windows(4).position(|bytes| bytes == b"Ritz");
    other[word.expect("its source")] = b'r';
    std::fs::write(resources.join("strip.safetensors"), &other).expect("a writable file");
    let (done, printed) = place.printed(&plan);
    assert!(
        !done && printed.contains("bodies[0].sha256: expected the digest"),
        "{printed}"
    );
    std::fs::remove_file(resources.join("strip.safetensors")).expect("a file");
    let (done, printed) = place.printed(&plan);
    assert!(
        !done && printed.contains("bodies[0].file: \"strip.safetensors\": "),
        "{printed}"
    );
}

#[test]
fn a_scene_with_a_file_is_shown() {
    let place = place("view");
    let view = [
        "view",
        "scene/scene.json",
        "--output",
        "page.html",
        "--no-open",
    ];
    let also = ["--vtk", "vtk", "--gltf", "motion.glb"];
    let (done, printed) = place.printed(&[&view[..], &also].concat());
    assert!(done, "{printed}");
    for file in ["page.html", "motion.glb", "vtk/motion.pvd"] {
        assert!(place.0.join(file).is_file(), "{file}");
    }
}
