//! Spectra of many coordinates beside frames in space: rigid bodies and rods. Against dense matrices where these are used, and against
//! closed forms or equations written here where they are not.

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use nalgebra::DMatrix;
use serde_json::{Value, json};

use crate::laws::moved_rods::{line, rod};

/// Coordinates up to which dense matrices are used where a third of all is asked for.
const MIDDLE: usize = 400;

/// The first numbers of an output of a scene that is not moving unless it is said to: frequencies, or decay rates and frequencies.
fn found(scene: &Value, kind: &str, count: usize) -> Vec<Vec<f64>> {
    let mut scene = scene.clone();
    scene["outputs"] = json!([{"kind": kind, "count": count}]);
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let mut simulation = Simulation::new(scene);
    simulation.initialize(0.0).expect("a start");
    let names: &[&str] = match kind {
        "eigenvalue" => &["eigenvalue.decay_rate", "eigenvalue.frequency"],
        _ => &["natural_frequency"],
    };
    let mut read = |name: String| {
        let mut variables = simulation.variables().iter();
        let index = variables.position(|variable| variable.name == name);
        simulation
            .real(index.expect("a variable"))
            .expect("a number")
    };
    let mut number = |k: usize| (names.iter().map(|name| read(format!("{name}[{k}]")))).collect();
    (1..=count).map(&mut number).collect()
}

fn frequencies(scene: &Value, count: usize) -> Vec<f64> {
    found(scene, "natural_frequency", count).concat()
}

fn largest_difference(found: &[f64], exact: &[f64]) -> f64 {
    let pairs = found.iter().zip(exact);
    let off = pairs.map(|(found, exact)| (found / exact - 1.0).abs());
    off.fold(0.0, f64::max)
}

/// A uniform thin link that hangs along the third axis below a height, m, of mass and length 1 but for rotation about itself.
fn link(k: usize, top: f64) -> Value {
    json!({"name": format!("link{k}"), "element": "rigid", "mass": 1.0, "inertia": [1.0 / 12.0, 1.0 / 12.0, 0.02],
           "position": [0.0, 0.0, top - 0.5], "markers": {"top": [0.0, 0.0, 0.5], "end": [0.0, 0.0, -0.5]}})
}

/// Links below each other on joints of a kind.
fn chain(links: usize, kind: &str) -> Value {
    let above = |k: usize| match k {
        0 => "ground".into(),
        _ => format!("link{}.end", k - 1),
    };
    let joint = |k: usize| {
        let mut joint = json!({"name": format!("joint{k}"), "kind": kind, "markers": [above(k), format!("link{k}.top")]});
        if kind == "universal" {
            joint["direction"] = json!([1.0, 0.0, 0.0]);
            joint["second_direction"] = json!([0.0, 1.0, 0.0]);
        }
        joint
    };
    let bodies: Vec<Value> = (0..links).map(|k| link(k, -(k as f64))).collect();
    let joints: Vec<Value> = (0..links).map(joint).collect();
    json!({"name": "chain", "dimension": 3, "gravity": [0.0, 0.0, -9.81], "bodies": bodies, "joints": joints})
}

/// A body that is not symmetric at the tip of a rod.
fn rod_with_body(elements: usize, damping_time: f64) -> Value {
    let mut rod = rod(
        "rod",
        elements,
        line([0.0; 3], [1.0, 0.0, 0.0]),
        [0.0, 1.0, 0.0],
    );
    rod["material"]["damping_time"] = json!(damping_time);
    let section = rod["section"].as_object_mut().expect("a section");
    section.remove("coupling");
    let body = json!({"name": "body", "element": "rigid", "mass": TIP[0], "inertia": [TIP[1], TIP[2], TIP[3]],
                      "position": [1.0, 0.0, 0.0], "markers": {"c": [0.0, 0.0, 0.0]}});
    json!({"name": "rod_with_body", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [rod, body],
           "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.root"]},
                      {"name": "seat", "kind": "weld", "markers": ["rod.tip", "body.c"]}]})
}

/// Mass, kg, and moments of inertia, kg m^2, of the body at the tip of the rod.
const TIP: [f64; 4] = [0.07, 2e-5, 4e-5, 3e-5];

/// What is found by iteration is the beginning of what is found by dense matrices.
#[test]
fn few_frequencies_beside_frames_are_those_of_dense_matrices() {
    let mut sprung = chain(30, "spherical");
    let mount = |k: usize| {
        json!({"name": format!("spring{k}"), "kind": "bushing", "markers": [format!("link{}.end", k), format!("link{}.top", k + 1)],
               "rotational_stiffness": [3.0 + k as f64, 5.0, 2.0], "rotational_damping": [0.01, 0.02, 0.01]})
    };
    let mut loads: Vec<Value> = (0..29).map(mount).collect();
    loads.push(json!({"name": "wall", "kind": "bushing", "markers": ["ground", "link0.top"], "rotational_stiffness": [4.0, 7.0, 3.0]}));
    loads.push(json!({"name": "wind", "kind": "force", "marker": "link20.end", "value": [20.0, -9.0, 4.0]}));
    sprung["loads"] = json!(loads);
    sprung["initial"] = json!("static_equilibrium");
    let mut bent = rod_with_body(20, 1e-3);
    bent["gravity"] = json!([0.0, 0.4, -1.0]);
    bent["bodies"][1]["markers"]["edge"] = json!([0.02, 0.01, -0.03]);
    bent["joints"][1]["markers"][1] = json!("body.edge");
    bent["bodies"][1]["position"] = json!([0.98, -0.01, 0.03]);
    bent["initial"] = json!("static_equilibrium");
    for (scene, coordinates) in [(sprung, 180), (bent, 173)] {
        assert!(coordinates <= MIDDLE);
        let dense = coordinates / 3 + 1;
        for (kind, of) in [("natural_frequency", 1), ("eigenvalue", 2)] {
            let few = found(&scene, kind, 8).concat();
            let all = found(&scene, kind, dense).concat();
            let size = |k: usize| {
                all[k / of * of..][..of]
                    .iter()
                    .map(|x| x * x)
                    .sum::<f64>()
                    .sqrt()
            };
            let off = |k: usize| (few[k] - all[k]).abs() / size(k);
            let largest = (0..few.len()).map(off).fold(0.0, f64::max);
            assert!(
                largest < 1e-9,
                "{largest:e}: {few:?} instead of {:?}",
                &all[..few.len()]
            );
        }
    }
}

/// Roots of a function between zero and a bound, in ascending order, between which it changes its sign within steps of this size.
fn roots(bound: f64, step: f64, of: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut roots = Vec::new();
    let mut a = step;
    while a < bound {
        let (mut low, mut high) = (a, a + step);
        if of(low).signum() != of(high).signum() {
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if of(middle).signum() == of(low).signum() {
                    low = middle
                } else {
                    high = middle
                }
            }
            roots.push(0.5 * (low + high));
        }
        a += step;
    }
    roots
}

/// Bending (Euler and Bernoulli) about both axes, torsion and stretching of a clamped rod of length 1 with a rigid body at its tip. Of
/// bending with `w = a (cosh b x - cos b x) + c (sinh b x - sin b x)` at the tip `w'' = b^4 j w'`, `w''' = -b^4 m w`.
fn of_rod_with_body() -> Vec<f64> {
    let (e, g, line_density, area) = (1e9, 4e8, 0.1, 1e-4);
    let ([first, second], torsion) = ([1e-9, 3e-9], 1.5e-9);
    let [mass, about, across_y, across_z] = TIP;
    let mut all = Vec::new();
    // The first axis of the section is the second of space.
    for (moment, inertia) in [(first, across_y), (second, across_z)] {
        let (m, j) = (mass / line_density, inertia / line_density);
        let of = |b: f64| {
            let (s, c, sh, ch) = (b.sin(), b.cos(), b.sinh(), b.cosh());
            let (w, slope) = ([ch - c, sh - s], [b * (sh + s), b * (ch - c)]);
            let (bend, shear) = ([ch + c, sh + s], [sh - s, ch + c]);
            let turning = |k: usize| b * b * bend[k] - b.powi(4) * j * slope[k];
            let pushing = |k: usize| b.powi(3) * shear[k] + b.powi(4) * m * w[k];
            (turning(0) * pushing(1) - turning(1) * pushing(0)) / ch
        };
        let unit = (e * moment / line_density).sqrt();
        all.extend(roots(30.0, 0.01, of).into_iter().map(|b| unit * b * b));
    }
    // w sin k, clamped: stiffness w'(1) = k^2 ratio w(1).
    let bar = |ratio: f64| roots(30.0, 0.01, move |k| k.cos() - k * ratio * k.sin());
    let polar = 1000.0 * (first + second);
    let slow = (g * torsion / polar).sqrt();
    all.extend(bar(about / polar).into_iter().map(|k| slow * k));
    let fast = (e * area / line_density).sqrt();
    all.extend(bar(mass / line_density).into_iter().map(|k| fast * k));
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn a_long_rod_with_a_body_has_the_frequencies_of_a_bar_with_one() {
    let found = frequencies(&rod_with_body(200, 0.0), 12);
    let exact = of_rod_with_body();
    let all = largest_difference(&found, &exact);
    // Of the slowest it is roundoff that counts, of the others the mesh.
    let slowest = largest_difference(&found[..4], &exact);
    assert!(
        slowest < 1e-9 && all < 5e-8,
        "{slowest:e} {all:e}: {found:?}"
    );
}

/// Kelvin-Voigt damping: `s^2 + tau w^2 s + w^2 = 0` of every mode.
#[test]
fn a_long_damped_rod_with_a_body_decays_as_its_frequencies_say() {
    let tau = 1e-4;
    let found = found(&rod_with_body(500, tau), "eigenvalue", 6);
    for (found, w) in found.iter().zip(of_rod_with_body()) {
        let ratio = 0.5 * tau * w;
        let exact = [ratio * w, w * (1.0 - ratio * ratio).sqrt()];
        let off = (found[0] - exact[0]).hypot(found[1] - exact[1]) / w;
        assert!(off < 1e-6, "{off:e}: {found:?} instead of {exact:?}");
    }
}

/// Small swings of a chain of uniform bars of mass and length 1 by Lagrange's equations in their angles: `T` is that of
/// the rates `sum_(i<k) a_i' + a_k' / 2` of the middles and of the rotations, `V` grows by `g a_i^2 / 2` where arm `i` lifts a weight.
fn lagrange(links: usize) -> [DMatrix<f64>; 2] {
    let mut mass = DMatrix::<f64>::zeros(links, links);
    let mut stiffness = DMatrix::<f64>::zeros(links, links);
    for k in 0..links {
        let arm = |i: usize| if i == k { 0.5 } else { 1.0 };
        for i in 0..=k {
            for j in 0..=k {
                mass[(i, j)] += arm(i) * arm(j);
            }
            stiffness[(i, i)] += 9.81 * arm(i);
        }
        mass[(k, k)] += 1.0 / 12.0;
    }
    [mass, stiffness]
}

/// Their frequencies, ascending.
fn swings(links: usize) -> Vec<f64> {
    let [mass, stiffness] = lagrange(links);
    // Of the inverse problem the largest are the most exact.
    let root = stiffness.diagonal().map(|k| 1.0 / k.sqrt());
    let scaled = DMatrix::from_fn(links, links, |i, j| root[i] * mass[(i, j)] * root[j]);
    let values = scaled.symmetric_eigenvalues();
    let mut found: Vec<f64> = values.iter().map(|x: &f64| 1.0 / x.sqrt()).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Decay rates and frequencies, slowest first, with a damper in every joint: `M s^2 + R s + K` as a matrix of first order, by faer.
fn damped_swings(links: usize, damping: f64) -> Vec<[f64; 2]> {
    let [mass, stiffness] = lagrange(links);
    let dampers = DMatrix::from_fn(links, links, |i, j| match (i.abs_diff(j), i + 1 == links) {
        (0, false) => 2.0 * damping,
        (0, true) => damping,
        (1, _) => -damping,
        _ => 0.0,
    });
    let factor = mass.cholesky().expect("a positive mass");
    let [stiff, damped] = [stiffness, dampers].map(|matrix| factor.solve(&matrix));
    let matrix = faer::Mat::from_fn(2 * links, 2 * links, |i, j| match (i < links, j < links) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(j - links == i)),
        (false, true) => -stiff[(i - links, j)],
        (false, false) => -damped[(i - links, j - links)],
    });
    let values = matrix.eigenvalues().expect("eigenvalues").into_iter();
    let upper = values.filter(|s| s.im >= 0.0).map(|s| [-s.re, s.im]);
    let mut all: Vec<[f64; 2]> = upper.collect();
    all.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
    all
}

#[test]
fn many_links_with_dampers_decay() {
    let (links, damping) = (100, 1.0);
    let mut scene = chain(links, "universal");
    let joints = scene["joints"].as_array().expect("joints");
    let damper = |joint: &Value| {
        let (name, markers) = (joint["name"].as_str().expect("a name"), &joint["markers"]);
        json!({"name": format!("in_{name}"), "kind": "bushing", "markers": markers, "rotational_damping": [damping, damping, damping]})
    };
    scene["loads"] = joints.iter().map(damper).collect();
    let found = found(&scene, "eigenvalue", 8);
    let exact = damped_swings(links, damping);
    let exact = exact.into_iter().flat_map(|s| [s; 2]);
    let mut largest = 0.0_f64;
    for (found, exact) in found.iter().zip(exact) {
        let off = (found[0] - exact[0]).hypot(found[1] - exact[1]);
        largest = largest.max(off / exact[0].hypot(exact[1]));
        assert!(
            largest < 1e-9,
            "{largest:e}: {found:?} instead of {exact:?}"
        );
    }
}

/// What no load damps is found as its frequencies are.
#[test]
fn eigenvalues_of_what_nothing_damps_are_frequencies() {
    for scene in [chain(100, "universal"), rod_with_body(100, 0.0)] {
        let frequencies = frequencies(&scene, 6);
        for (found, w) in found(&scene, "eigenvalue", 6).iter().zip(frequencies) {
            assert!(
                found[0] == 0.0 && (found[1] / w - 1.0).abs() < 1e-9,
                "{found:?} instead of {w}"
            );
        }
    }
}

/// Zeros of the Bessel function `J0` (M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, table 9.5).
const ZEROS: [f64; 4] = [
    2.404_825_557_7,
    5.520_078_110_3,
    8.653_727_912_9,
    11.791_534_439_1,
];

/// Every frequency twice, in two planes; those of a heavy chain, `z / 2 sqrt(g / L)`, but for the square of a link over the length.
#[test]
fn many_links_swing_as_a_hanging_chain() {
    let links = 200;
    let found = frequencies(&chain(links, "universal"), 8);
    let exact: Vec<f64> = swings(links).into_iter().flat_map(|w| [w; 2]).collect();
    let off = largest_difference(&found, &exact);
    assert!(
        off < 1e-9,
        "{off:e}: {found:?} instead of {:?}",
        &exact[..8]
    );
    for (found, zero) in found.iter().step_by(2).zip(ZEROS) {
        let limit = 0.5 * zero * (9.81 / links as f64).sqrt();
        assert!(
            (found / limit - 1.0).abs() < 1e-3,
            "{found} instead of {limit}"
        );
    }
}

/// Tops that hang from points and spin, each faster than the one before, `A z'' - i C n z' + m g l z = 0` for `z = x + i y`, their
/// spins free; beside a chain at rest.
#[test]
fn hanging_tops_nod_by_gyroscopic_forces_beside_many_links() {
    let (tops, links, mass, arm, along) = (4, 66, 2.0, 0.3, 0.03);
    let (across, gravity) = (0.05 + mass * arm * arm, 9.81);
    let spin = |k: usize| 100.0 + 50.0 * k as f64;
    let mut scene = chain(links, "universal");
    for k in 0..tops {
        let x = 1.0 + k as f64;
        let top = json!({"name": format!("top{k}"), "element": "rigid", "mass": mass, "inertia": [0.05, 0.05, along],
                         "position": [x, 0.0, -arm], "motion": {"spin": [0.0, 0.0, spin(k)]}, "markers": {"peg": [0.0, 0.0, arm]}});
        let peg = json!({"name": format!("peg{k}"), "kind": "spherical", "markers": ["ground", format!("top{k}.peg")]});
        for (list, part) in [("bodies", top), ("joints", peg)] {
            scene[list].as_array_mut().expect("a list").push(part);
        }
    }
    let nodding = (0..tops).flat_map(|k| {
        let half = 0.5 * along * spin(k) / across;
        let root = (half * half + mass * gravity * arm / across).sqrt();
        [root - half, root + half]
    });
    let mut exact: Vec<f64> = nodding.collect();
    exact.extend(swings(links).into_iter().flat_map(|w| [w; 2]));
    exact.extend(vec![0.0; 2 * tops]);
    exact.sort_by(f64::total_cmp);
    let found = found(&scene, "eigenvalue", 20);
    for (found, exact) in found.iter().zip(&exact) {
        let off = found[0].hypot(found[1] - exact);
        // A free spin is zero twice: the root of roundoff.
        let allowed = if *exact == 0.0 { 1e-6 } else { 1e-9 };
        assert!(off < allowed, "{found:?} instead of {exact}");
    }
}

/// What is found by solving rotates by roundoff: that is rest. What rotates faster has frequencies of its own kind, and is refused.
#[test]
fn rotation_by_roundoff_is_rest() {
    let scene = |spin: f64| {
        json!({"name": "spun", "dimension": 3, "bodies": [{"name": "rod", "element": "rod", "elements": 3, "axis": [0.0, 1.0, 0.0],
            "material": {"youngs_modulus": 2e9, "shear_modulus": 8e8, "density": 1e3},
            "section": {"area": 2e-4, "second_moments": [2e-9, 6e-9], "torsion_constant": 4e-9},
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0]}}, "motion": {"spin": [0.0, 0.0, spin]}}]})
    };
    // Six of them are free motions.
    let [still, noise] = [0.0, 1e-12].map(|spin| frequencies(&scene(spin), 9));
    assert!(largest_difference(&noise[6..], &still[6..]) < 1e-9);
    let mut fast = scene(1e-6);
    fast["outputs"] = json!([{"kind": "natural_frequency", "count": 9}]);
    let fast = Scene::from_json(&fast.to_string()).expect("a scene");
    let told = Simulation::new(fast).initialize(0.0);
    let told = told.expect_err("a rotation").to_string();
    assert!(told.contains("rad/s"), "{told}");
}
