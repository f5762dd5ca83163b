//! Files of reduced models: read, rotated, and refused by name.

use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::{Map, Value, json};

use super::*;

/// A file in the making: every array with its type, shape and bytes, and texts.
#[derive(Clone)]
pub struct File {
    pub arrays: Vec<(String, &'static str, Vec<usize>, Vec<u8>)>,
    pub texts: Map<String, Value>,
}

impl File {
    fn set(&mut self, name: &str, dtype: &'static str, shape: &[usize], bytes: Vec<u8>) {
        self.arrays.retain(|(known, ..)| known != name);
        let array = (name.to_owned(), dtype, shape.to_vec(), bytes);
        self.arrays.push(array);
    }

    /// Puts in an array of F64.
    pub fn numbers(&mut self, name: &str, shape: &[usize], numbers: &[f64]) {
        let bytes = numbers.iter().flat_map(|of| of.to_le_bytes()).collect();
        self.set(name, "F64", shape, bytes);
    }

    fn get(&self, name: &str) -> Vec<f64> {
        let mut arrays = self.arrays.iter();
        let (.., bytes) = arrays.find(|(known, ..)| known == name).expect("the array");
        let (chunks, _) = bytes.as_chunks::<8>();
        chunks.iter().map(|of| f64::from_le_bytes(*of)).collect()
    }

    fn header(&self) -> Value {
        let (mut header, mut place) = (Map::new(), 0);
        header.insert("__metadata__".into(), self.texts.clone().into());
        for (name, dtype, shape, bytes) in &self.arrays {
            let end = place + bytes.len();
            let entry = json!({"dtype": dtype, "shape": shape, "data_offsets": [place, end]});
            header.insert(name.clone(), entry);
            place = end;
        }
        header.into()
    }

    fn with_header(&self, header: &Value) -> Vec<u8> {
        let header = header.to_string();
        let data = self.arrays.iter().flat_map(|(.., bytes)| bytes.clone());
        let length = (header.len() as u64).to_le_bytes();
        length
            .into_iter()
            .chain(header.into_bytes())
            .chain(data)
            .collect()
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        self.with_header(&self.header())
    }
}

/// Numbers between -1 and 1 that are always the same.
fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let next = |_| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..count).map(next).collect()
}

/// A file of three modes, two of them paired, a frame `A1` and a point `B`.
pub fn example() -> File {
    let mut file = File {
        arrays: Vec::new(),
        texts: Map::from_iter([
            ("format".into(), "flexbody reduced body".into()),
            ("version".into(), "1".into()),
            ("source".into(), "a test".into()),
            ("highest_frequency".into(), "3e3".into()),
        ]),
    };
    file.numbers("mass", &[1], &[2.0]);
    file.numbers("centre", &[3], &[0.3, -0.1, 0.2]);
    file.numbers("inertia", &[6], &[0.04, 0.05, 0.07, 0.006, -0.004, 0.003]);
    file.numbers("eigenvalues", &[3], &[4e4, 9e4, 2.5e5]);
    file.numbers("inertia_1", &[3, 6], &noise(18, 1));
    let square = |block: usize, sign: f64, seed: u64| {
        let given = noise(9 * block, seed);
        let entry = |at: usize| {
            let (k, l, c) = (at / block / 3, at / block % 3, at % block);
            let [a, b] = [(k, l), (l, k)].map(|(k, l)| given[block * (3 * k + l) + c]);
            0.2 * (a + sign * b)
        };
        (0..9 * block).map(entry).collect::<Vec<_>>()
    };
    file.numbers("inertia_2", &[3, 3, 6], &square(6, 1.0, 2));
    file.numbers("coupling", &[3, 3, 3], &square(3, -1.0, 3));
    let pairs = |count: usize, seed: u64| {
        let given = noise(4 * count, seed);
        let of = |at: usize| [given[at], given[at + 1], given[at + 1], given[at + 3]];
        (0..count).flat_map(|k| of(4 * k)).collect::<Vec<_>>()
    };
    file.numbers("cubic", &[3, 2, 2], &pairs(3, 4));
    for (name, seed) in [("A1", 5), ("B", 9)] {
        let at = |key: &str| format!("{name}.{key}");
        file.numbers(&at("position"), &[3], &noise(3, seed));
        file.numbers(&at("modes"), &[3, 3], &noise(9, seed + 1));
    }
    file.numbers("A1.rotation", &[3, 3], &noise(9, 20));
    file.numbers("A1.second", &[3, 2, 2], &pairs(3, 21));
    file.numbers("surface.points", &[3, 3], &noise(9, 22));
    let modes = noise(27, 23)
        .into_iter()
        .flat_map(|of| (of as f32).to_le_bytes());
    file.set("surface.modes", "F32", &[3, 3, 3], modes.collect());
    let stresses = noise(54, 25)
        .into_iter()
        .flat_map(|of| (1e6 * of as f32).to_le_bytes());
    file.set("surface.stress", "F32", &[3, 6, 3], stresses.collect());
    let corners = [0u32, 1, 2].into_iter().flat_map(u32::to_le_bytes);
    file.set("surface.triangles", "U32", &[1, 3], corners.collect());
    file.numbers("stress.fillet", &[6, 3], &noise(18, 24));
    file
}

fn refused(file: &File) -> String {
    Container::from_bytes(&file.bytes()).expect_err("a refusal")
}

#[test]
fn a_file_is_read() -> Result<(), String> {
    let bytes = example().bytes();
    let read = Container::from_bytes(&bytes)?;
    assert_eq!(
        (&*read.source, read.highest_frequency),
        ("a test", Some(3e3))
    );
    assert_eq!(read.digest().len(), 64);
    assert_eq!(**read.bytes(), bytes);
    let model = &read.model;
    assert_eq!((model.modes(), model.paired, model.mass), (3, 2, 2.0));
    let names: Vec<&str> = model.interfaces.iter().map(|of| &*of.name).collect();
    assert_eq!(names, ["A1", "B"]);
    assert!(model.interfaces[0].rotation.is_some() && model.interfaces[1].rotation.is_none());
    assert_eq!(
        model
            .interfaces
            .iter()
            .map(|of| of.second.len())
            .sum::<usize>(),
        4
    );
    assert_eq!(read.details.points.len(), 3);
    assert_eq!(read.details.modes.len(), 9);
    assert_eq!(read.details.triangles, [[0, 1, 2]]);
    // Point 1, mode 2, component `xy`, which is number 3.
    let of_file = noise(54, 25)[(6 + 3) * 3 + 2];
    assert_eq!(read.details.point_stresses[3 + 2][3], 1e6 * of_file as f32);
    assert_eq!(read.details.stresses["fillet"].len(), 3);
    // Back in the file's axes: places, the tensor of inertia, displacements.
    let place = Vector3::from_column_slice(&example().get("B.position"));
    assert!((read.place(1) - place).norm() < 1e-15);
    assert_eq!(read.interface("B"), Some(1));
    let tensor = read.axes * Matrix3::from_diagonal(&model.moments.into()) * read.axes.transpose();
    assert!((tensor - matrix(&symmetric(&example().get("inertia")))).amax() < 1e-15);
    let given = example().get("B.modes");
    let moved = read.axes * model.interfaces[1].modes[2];
    assert!((moved - Vector3::new(given[2], given[5], given[8])).norm() < 1e-15);
    let hertz = read.frequencies()[0];
    assert!((hertz - 200.0 / std::f64::consts::TAU).abs() < 1e-12);
    Ok(())
}

/// The same body in axes that are rotated about another origin: `x' = R (x - o)`.
fn turned(file: &File, rotation: &Matrix3<f64>, origin: &Vector3<f64>) -> File {
    let mut other = file.clone();
    let vectors = |numbers: &[f64], stride: usize| {
        let mut numbers = numbers.to_vec();
        for block in numbers.chunks_exact_mut(3 * stride) {
            for k in 0..stride {
                let way = Vector3::new(block[k], block[stride + k], block[2 * stride + k]);
                let way = rotation * way;
                (0..3).for_each(|c| block[c * stride + k] = way[c]);
            }
        }
        numbers
    };
    let tensors = |numbers: &[f64]| {
        let blocks = numbers.chunks_exact(6).flat_map(|block| {
            let t = rotation * matrix(&symmetric(block)) * rotation.transpose();
            [
                t[(0, 0)],
                t[(1, 1)],
                t[(2, 2)],
                t[(0, 1)],
                t[(0, 2)],
                t[(1, 2)],
            ]
        });
        blocks.collect::<Vec<_>>()
    };
    let moved = |numbers: &[f64]| {
        let points = numbers.chunks_exact(3).flat_map(|of| {
            let point = rotation * (Vector3::from_column_slice(of) - origin);
            <[f64; 3]>::from(point)
        });
        points.collect::<Vec<_>>()
    };
    for (name, dtype, shape, _) in &file.arrays {
        if *dtype != "F64" {
            continue;
        }
        let given = file.get(name);
        let numbers = match name.rsplit('.').next().unwrap_or(name) {
            "centre" | "position" | "points" => moved(&given),
            "inertia" | "inertia_1" | "inertia_2" => tensors(&given),
            "coupling" => vectors(&given, 1),
            "modes" | "rotation" => vectors(&given, 3),
            "second" => vectors(&given, 4),
            _ => continue,
        };
        other.numbers(name, shape, &numbers);
    }
    other
}

#[test]
fn axes_and_origin_of_the_file_do_not_matter() -> Result<(), String> {
    let file = example();
    let first = Container::from_bytes(&file.bytes())?;
    for seed in 30..50 {
        let drawn = noise(6, seed);
        let rotation = Rotation3::new(Vector3::from_column_slice(&drawn[..3]) * 3.0).into_inner();
        let origin = Vector3::from_column_slice(&drawn[3..]);
        let other = Container::from_bytes(&turned(&file, &rotation, &origin).bytes())?;
        // Principal axes may change their order and signs: a rotation by right angles from the one to the other.
        let between = other.axes.transpose() * rotation * first.axes;
        for part in &between {
            assert!(
                part.abs() < 1e-9 || (part.abs() - 1.0).abs() < 1e-9,
                "{between}"
            );
        }
        let near = |a: &Vector3<f64>, b: &Vector3<f64>| {
            assert!((between * a - b).norm() < 1e-9, "{a} {b}");
        };
        let [a, b] = [&first.model, &other.model];
        let all = |model: &ReducedModel| {
            let interfaces = model.interfaces.iter().flat_map(|of| {
                let rotation = of.rotation.iter().flatten();
                let places = of.modes.iter().chain(&of.second).chain(rotation);
                places.chain([&of.position]).copied().collect::<Vec<_>>()
            });
            interfaces.chain(model.coupling.clone()).collect::<Vec<_>>()
        };
        let [of_a, of_b] = [all(a), all(b)];
        assert_eq!(of_a.len(), of_b.len());
        of_a.iter().zip(&of_b).for_each(|(a, b)| near(a, b));
        let tensors = |model: &ReducedModel| [&model.inertia_1[..], &model.inertia_2].concat();
        for (a, b) in tensors(a).iter().zip(&tensors(b)) {
            let a = between * matrix(a) * between.transpose();
            assert!((a - matrix(b)).amax() < 1e-9);
        }
        let way = rotation * (first.center - origin) - other.center;
        assert!(way.norm() < 1e-12);
        assert_eq!((&a.eigenvalues, &a.cubic), (&b.eigenvalues, &b.cubic));
    }
    Ok(())
}

/// The example with another array.
fn with(name: &str, shape: &[usize], numbers: &[f64]) -> String {
    let mut file = example();
    file.numbers(name, shape, numbers);
    refused(&file)
}

/// The example with another number.
fn changed(name: &str, at: usize, value: f64) -> String {
    let file = example();
    let (.., shape, _) = (file.arrays.iter().find(|(known, ..)| known == name)).expect("it");
    let mut numbers = file.get(name);
    numbers[at] = value;
    with(name, &shape.clone(), &numbers)
}

fn check(cases: &[(String, &str)]) {
    for (found, wanted) in cases {
        assert!(found.contains(wanted), "{found}\nnot with {wanted}");
    }
}

#[test]
fn arrays_that_are_no_reduced_model_are_refused_by_name() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            changed("mass", 0, 0.0),
            "mass: expected a positive number (kg), found 0",
        ),
        (
            changed("mass", 0, f64::NAN),
            "mass: expected numbers of a size below 1e150, found NaN",
        ),
        (
            changed("inertia", 0, -0.04),
            "inertia: expected principal moments of inertia that are positive",
        ),
        (
            changed("inertia", 2, 0.2),
            "inertia: expected principal moments",
        ),
        (
            changed("inertia", 0, 1e140),
            "inertia: expected principal moments",
        ),
        (
            changed("eigenvalues", 0, 0.0),
            "eigenvalues: expected squares of the natural frequencies",
        ),
        (changed("eigenvalues", 2, 8e4), "found 80000 at [2]"),
        (
            changed("coupling", 4, 0.9),
            "coupling: expected an array that is antisymmetric in its modes",
        ),
        (
            changed("inertia_2", 8, 0.9),
            "inertia_2: expected an array that is symmetric in its modes",
        ),
        (
            changed("cubic", 1, 9.0),
            "cubic: expected an array that is symmetric",
        ),
        (
            changed("A1.second", 1, 9.0),
            "A1.second: expected an array that is symmetric",
        ),
        (
            changed("B.modes", 1, f64::INFINITY),
            "B.modes: expected numbers of a size below 1e150, found inf",
        ),
    ];
    check(&cases);
}

#[test]
fn arrays_of_other_shapes_and_names_are_refused_by_name() {
    #[rustfmt::skip] // a table
    let cases = [
        (
            with("cubic", &[3, 4, 4], &noise(48, 1)),
            "cubic: expected the shape [3, m, m], m from 1 to 3, found [3, 4, 4]",
        ),
        (
            with("eigenvalues", &[201], &[1.0; 201]),
            "eigenvalues: expected the shape [n], n from 1 to 200, found [201]",
        ),
        (with("eigenvalues", &[0], &[]), "n from 1 to 200, found [0]"),
        (
            with("inertia_1", &[6, 3], &noise(18, 1)),
            "inertia_1: expected the shape [3, 6], found [6, 3]",
        ),
        (
            with("stres.a", &[6, 3], &noise(18, 1)),
            "stres.position: expected an array of this name, found none",
        ),
        (
            with("couplng", &[1], &[0.0]),
            "found \"couplng\"; did you mean `coupling`?",
        ),
        (
            with("B.second", &[3], &[0.0; 3]),
            "B.second: expected the shape [3, 2, 2]",
        ),
        (
            with("B.rotatio", &[3], &[0.0; 3]),
            "found \"B.rotatio\"; did you mean `B.rotation`",
        ),
        (
            with("coupling", &[3, 3, 3], &{
                let mut of = vec![0.0; 27];
                (of[3], of[9]) = (1.5, -1.5);
                of
            }),
            "coupling: expected vectors of length 1 at most",
        ),
    ];
    check(&cases);
}

#[test]
fn arrays_that_lack_something_are_refused() {
    let without = |name: &str| {
        let mut file = example();
        file.arrays.retain(|(known, ..)| !known.starts_with(name));
        refused(&file)
    };
    for name in ["mass", "centre", "eigenvalues", "B.modes", "surface.modes"] {
        let found = without(name);
        assert_eq!(
            found,
            format!("{name}: expected an array of this name, found none")
        );
    }
    let found = without("cubic");
    assert!(
        found.starts_with("A1.second: expected `cubic` beside"),
        "{found}"
    );
    let mut file = example();
    file.arrays.retain(|(name, ..)| !name.contains('.'));
    assert!(refused(&file).contains("at least one interface"));
    let mut file = example();
    file.set("surface.triangles", "U32", &[1, 3], vec![3; 12]);
    assert!(refused(&file).starts_with("surface.triangles: expected numbers of the 3 points"));
    let refused_stress = |dtype: &'static str, shape: &[usize], number: [u8; 4]| {
        let mut file = example();
        let numbers = shape.iter().product();
        file.set("surface.stress", dtype, shape, number.repeat(numbers));
        refused(&file)
    };
    let none = 0.0_f32.to_le_bytes();
    for (found, wanted) in [
        (
            refused_stress("F32", &[3, 6, 2], none),
            "surface.stress: expected the shape [3, 6, 3], found [3, 6, 2]",
        ),
        (
            refused_stress("U32", &[3, 6, 3], none),
            "surface.stress: expected numbers of the type F32, found \"U32\"",
        ),
        (
            refused_stress("F32", &[3, 6, 3], f32::NAN.to_le_bytes()),
            "surface.stress: expected numbers of a size below 1e150, found NaN",
        ),
    ] {
        assert_eq!(found, wanted);
    }
    let mut file = example();
    let is_of_surface = |name: &str| name.starts_with("surface.") && name != "surface.stress";
    file.arrays.retain(|(name, ..)| !is_of_surface(name));
    let found = refused(&file);
    assert!(found.contains("found \"surface.stress\""), "{found}");
    for (key, text, wanted) in [
        (
            "format",
            "other",
            "__metadata__.format: expected \"flexbody reduced body\"",
        ),
        (
            "version",
            "2",
            "__metadata__.version: expected \"1\", found \"2\"",
        ),
        (
            "highest_frequency",
            "high",
            "__metadata__.highest_frequency: expected a positive",
        ),
    ] {
        let mut file = example();
        file.texts.insert(key.into(), text.into());
        let found = refused(&file);
        assert!(found.starts_with(wanted), "{found}");
    }
}

#[test]
fn headers_that_lie_are_refused() {
    let file = example();
    let lie = |path: &str, value: Value| {
        let mut header = file.header();
        *header.pointer_mut(path).expect("a place") = value;
        Container::from_bytes(&file.with_header(&header)).expect_err("a refusal")
    };
    let huge = u64::MAX;
    let size: usize = file.arrays.iter().map(|(.., bytes)| bytes.len()).sum();
    #[rustfmt::skip] // a table
    let cases = [
        (
            lie("/centre/data_offsets", json!([0, 24])),
            "centre: expected data that begins at 8, found 0, which overlaps mass",
        ),
        (
            lie("/mass/data_offsets", json!([0, 7])),
            "centre: expected data that begins at 7, found 8, which leaves a gap to mass",
        ),
        (
            lie("/stress.fillet/data_offsets", json!([size, size - 8])),
            "stress.fillet: expected data_offsets",
        ),
        (
            lie("/stress.fillet/data_offsets/1", json!(size + 8)),
            "stress.fillet: expected data_offsets",
        ),
        (
            lie("/mass/data_offsets", json!([0, -8])),
            "mass.data_offsets[1]: expected",
        ),
        (
            lie("/mass/dtype", json!("F32")),
            "mass: expected numbers of the type F64, found \"F32\"",
        ),
        (
            lie("/surface.points/shape", json!([huge, 3])),
            "surface.points: expected",
        ),
        (
            lie("/surface.points/shape", json!([])),
            "surface.points: expected the shape [0, 3], found []",
        ),
        (lie("/mass", json!(3)), "mass: expected an object"),
        (
            lie("/mass", json!({"dtype": "F64"})),
            "mass.shape: expected",
        ),
        (
            lie("/__metadata__", json!({"format": 3})),
            "__metadata__.format: expected",
        ),
    ];
    check(&cases);
}

#[test]
fn every_cut_is_refused() {
    let bytes = example().bytes();
    for length in 0..bytes.len() {
        assert!(Container::from_bytes(&bytes[..length]).is_err(), "{length}");
    }
    let mut more = bytes.clone();
    more.push(0);
    let found = Container::from_bytes(&more).expect_err("a refusal");
    assert!(found.starts_with("data: expected"), "{found}");
    let mut long = bytes;
    long[..8].copy_from_slice(&u64::MAX.to_le_bytes());
    let found = Container::from_bytes(&long).expect_err("a refusal");
    assert!(found.starts_with("header: expected the length"), "{found}");
    let twice = br#"{"mass": 1, "mass": 2}"#;
    let file = [&(twice.len() as u64).to_le_bytes(), &twice[..]].concat();
    let found = Container::from_bytes(&file).expect_err("a refusal");
    assert!(found.contains("every key once"), "{found}");
}

/// Bytes that are changed at random are read or refused.
#[test]
fn changed_bytes_are_read_or_refused() {
    let bytes = example().bytes();
    let places = noise(6000, 60);
    for drawn in places.chunks_exact(3) {
        let [at, value, again] = [0, 1, 2].map(|k| 0.5 * (drawn[k] + 1.0));
        let place = |share: f64| (share * (bytes.len() - 1) as f64) as usize;
        let mut changed = bytes.clone();
        changed[place(at)] = (255.0 * value) as u8;
        // The header is a third of the file, and more often of interest.
        changed[place(0.3 * again)] ^= 1 << (7.0 * value) as u8;
        if let Ok(read) = Container::from_bytes(&changed) {
            assert!(read.model.moments.iter().all(|moment| *moment > 0.0));
        }
    }
}
