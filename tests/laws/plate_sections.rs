//! Forces, strains and stress in sections of plates and shells against closed forms.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use serde_json::{Value, json};

use super::plates::ALL;
use super::runs::{Run, is_near};

/// A rectangular plate along the first two axes with keys of its section, and all outputs of sections at some markers.
fn plate(sides: [f64; 2], mesh: [u32; 2], keys: &Value, markers: &Value) -> Value {
    let mut body = json!({"name": "p", "element": "plate", "mesh": mesh, "markers": markers,
        "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[sides[0], 0, 0], [0, sides[1], 0]]}}});
    let keys = keys.as_object().expect("keys");
    (body.as_object_mut().expect("a body")).extend(keys.clone());
    let kinds = [
        "membrane_strain",
        "curvature",
        "membrane_force",
        "bending_moment",
    ];
    let markers = markers.as_object().expect("markers").keys();
    let outputs: Vec<Value> = markers
        .flat_map(|marker| kinds.map(|kind| json!({"kind": kind, "marker": format!("p.{marker}")})))
        .collect();
    json!({"name": "plate", "dimension": 3, "gravity": [0, 0, 0], "bodies": [body], "outputs": outputs})
}

/// A material with D = 1 for a thickness.
fn material(h: f64, poisson: f64) -> Value {
    let modulus = 12.0 * (1.0 - poisson * poisson) / h.powi(3);
    json!({"thickness": h, "material": {"youngs_modulus": modulus, "poisson_ratio": poisson, "density": 1.0 / h}})
}

fn hold(scene: &mut Value, kind: &str, edges: &[&str]) {
    let joint = |edge: &&str| json!({"name": edge.replace('=', "_"), "kind": kind, "edges": ["ground", format!("p.{edge}")]});
    scene["joints"] = edges.iter().map(joint).collect();
}

/// Moments of a plate with D = 1 under a small uniform pressure, over the pressure, at some markers.
fn moments(sides: [f64; 2], mesh: [u32; 2], kind: &str, markers: &Value) -> Vec<[f64; 3]> {
    let mut scene = plate(sides, mesh, &material(0.01, 0.3), markers);
    hold(&mut scene, kind, &ALL);
    let load = json!([{"name": "q", "kind": "pressure", "body": "p", "value": 1e-4}]);
    let mut run = Run::at_rest(scene, &load);
    let markers = markers.as_object().expect("markers").keys();
    let read = |marker: &String| run.read_all(&format!("p.{marker}.bending_moment"));
    markers
        .map(read)
        .map(|m| m.map(|m: f64| m / 1e-4))
        .collect()
}

/// S. P. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells (1959), articles 30 (moments in the middle of a supported square,
/// and the force at its corners, twice the twisting moment) and 44 (clamped).
#[test]
fn moments_of_squares_are_those_of_the_series() {
    let markers =
        json!({"a_middle": [0.5, 0.5], "b_edge": [1, 0.5], "c_edge": [0.5, 0], "d_corner": [1, 1]});
    let off = |elements: u32| {
        let found = moments([1.0; 2], [elements; 2], "pinned", &markers);
        let middle = -0.047_886_378_3;
        // A free corner of the supported square is a weak singularity.
        is_near(found[3][2], 0.032_482, 8e-3 / f64::from(elements.pow(2)));
        let bent = (found[0][0] - middle)
            .abs()
            .max((found[0][1] - middle).abs());
        bent.max(found[1][0].abs()).max(found[2][1].abs())
    };
    let [coarse, fine] = [4, 8].map(off);
    assert!(coarse < 3e-5 && fine < 2e-6, "{coarse:e} {fine:e}");
    let found = moments([1.0; 2], [8; 2], "clamped", &markers);
    is_near(found[0][0], -0.022_905, 6e-6);
    is_near(found[1][0], 0.051_334, 6e-6);
    is_near(found[2][1], 0.051_334, 6e-6);
    is_near(found[1][1], 0.3 * 0.051_334, 1e-5);
}

/// The same source, table 8: a plate that is twice as long as wide.
#[test]
fn moments_of_a_rectangle_are_told_apart() {
    let markers = json!({"a_middle": [0.5, 0.5]});
    let [[across, along, twist]] = moments([1.0, 2.0], [4, 7], "pinned", &markers)[..] else {
        panic!("one marker");
    };
    is_near(across, -0.1017, 1e-4);
    is_near(along, -0.0464, 1e-4);
    is_near(twist, 0.0, 1e-8);
}

/// A strip under tension and an end force is a beam: the tension over the width, and the force times the rest of its length; stress at its
/// faces by both. At the ends, on mesh lines and between them.
#[test]
fn strips_are_beams() {
    let (length, width, h, poisson) = (2.0, 0.1, 0.01, 0.0);
    let places = [0.0, 0.25, 0.4, 0.5, 1.0];
    let mut markers = json!({"end": {"at": [1, 0.5], "pad": [1e-9, width]}});
    for (k, at) in places.iter().enumerate() {
        markers[format!("m{k}")] = json!([at, 0.3]);
    }
    let mut scene = plate([length, width], [4, 1], &material(h, poisson), &markers);
    hold(&mut scene, "clamped", &["s1=0"]);
    for k in 0..places.len() {
        let output = json!({"kind": "surface_stress", "marker": format!("p.m{k}")});
        scene["outputs"]
            .as_array_mut()
            .expect("outputs")
            .push(output);
    }
    // One at a time: tension straightens what is bent.
    for (tension, force) in [(2e-4, 0.0), (0.0, 3e-5)] {
        let load = json!([{"name": "F", "kind": "force", "marker": "p.end", "value": [tension, 0, force]}]);
        let mut run = Run::at_rest(scene.clone(), &load);
        for (k, at) in places.iter().enumerate() {
            let name = |what: &str| format!("p.m{k}.{what}");
            let [n, _, _] = run.read_all(&name("membrane_force"));
            let [m, _, _] = run.read_all(&name("bending_moment"));
            let exact = force / width * length * (1.0 - at);
            is_near(
                n,
                tension / width,
                1e-5 * tension / width + 3e-3 * force / width,
            );
            is_near(m, exact, 1e-5 * force / width * length + 1e-12);
            let [strain, _, _] = run.read_all(&name("membrane_strain"));
            let [curvature, _, _] = run.read_all(&name("curvature"));
            is_near(strain, n * h * h / 12.0, 1e-15);
            is_near(curvature, m, 1e-12);
            for (side, sign) in [("bottom", 1.0), ("top", -1.0)] {
                let [along, across, shear] = run.read_all(&name(&format!("{side}_stress")));
                let exact = n / h + sign * 6.0 * m / (h * h);
                is_near(along, exact, 1e-9 * exact.abs().max(1.0));
                is_near(across.abs() + shear.abs(), 0.0, 2e-3);
                let von_mises = run.read(&name(&format!("{side}_von_mises_stress")));
                is_near(von_mises, along.abs(), 3e-3);
            }
        }
    }
}

/// A strip whose layers are not symmetric stretches by `T D / (A D - B^2)` and bends by `T B / (A D - B^2)` under tension
/// (R. M. Jones, Mechanics of Composite Materials (1999), section 4.4), without a moment.
#[test]
fn coupled_strips_bend_under_tension() {
    let (a, b, d, tension, width) = (1e4, 20.0, 1.0, 1e-4, 0.1);
    let diagonal =
        |first: f64, others: f64| [[first, 0.0, 0.0], [0.0, others, 0.0], [0.0, 0.0, others]];
    let keys = json!({"area_density": 1.0,
        "stiffness": {"A": diagonal(a, a), "B": diagonal(b, 0.0), "D": diagonal(d, d)}});
    let markers =
        json!({"end": {"at": [1, 0.5], "pad": [1e-9, width]}, "m": [0.4, 0.5], "root": [0, 0.5]});
    let mut scene = plate([1.0, width], [4, 1], &keys, &markers);
    hold(&mut scene, "clamped", &["s1=0"]);
    let load = json!([{"name": "F", "kind": "force", "marker": "p.end", "value": [width * tension, 0, 0]}]);
    let mut run = Run::at_rest(scene, &load);
    let determinant = a * d - b * b;
    let (strain, curvature) = (tension * d / determinant, tension * b / determinant);
    for marker in ["m", "root"] {
        let mut read = |what: &str| run.read_all::<3>(&format!("p.{marker}.{what}"))[0];
        is_near(read("membrane_strain"), strain, 1e-4 * strain);
        is_near(read("curvature"), curvature, 1e-4 * curvature);
        is_near(read("membrane_force"), tension, 1e-5 * tension);
        is_near(read("bending_moment"), 0.0, 1e-4 * b * strain);
    }
}

/// A quarter of a tube between planes of symmetry under inner pressure: `p R` around, nothing along.
#[test]
fn tubes_carry_pressure_around() {
    let (radius, pressure, h) = (0.5, 3.0, 1e-3);
    let keys = json!({"thickness": h, "element": "shell",
        "surface": {"cylinder": {"from": [0, 0, 0], "to": [0.4, 0, 0], "radius": radius, "start": [0, 1, 0], "angle": FRAC_PI_2}},
        "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.3, "density": 1000}});
    let markers = json!({"m": [0.5, 0.5], "seam": [1, 0.2]});
    let mut scene = plate([1.0; 2], [6, 2], &keys, &markers);
    let plane = |edge: &str, normal: [f64; 3]| {
        json!({"name": edge.replace('=', "_"), "kind": "symmetry",
        "edges": ["ground", format!("p.{edge}")], "normal": normal})
    };
    scene["joints"] = json!([
        plane("s2=0", [1.0, 0.0, 0.0]),
        plane("s1=0", [0.0, 0.0, 1.0]),
        plane("s1=1", [0.0, 1.0, 0.0]),
    ]);
    let load = json!([{"name": "q", "kind": "pressure", "body": "p", "value": pressure}]);
    let mut run = Run::at_rest(scene, &load);
    for marker in ["m", "seam"] {
        let [around, along, shear] = run.read_all(&format!("p.{marker}.membrane_force"));
        is_near(around, pressure * radius, 1e-3 * pressure * radius);
        is_near(along.abs() + shear.abs(), 0.0, 1e-3 * pressure * radius);
    }
}

/// Reduced stiffness of a ply at an angle by the invariants of S. W. Tsai, N. J. Pagano, Composite Materials Workshop (1968).
fn off_axis([e1, e2]: [f64; 2], nu: f64, shear: f64, angle: f64) -> [[f64; 3]; 3] {
    let over = 1.0 - nu * nu * e2 / e1;
    let (q11, q22, q12) = (e1 / over, e2 / over, nu * e2 / over);
    let u1 = (3.0 * q11 + 3.0 * q22 + 2.0 * q12 + 4.0 * shear) / 8.0;
    let u2 = (q11 - q22) / 2.0;
    let u3 = (q11 + q22 - 2.0 * q12 - 4.0 * shear) / 8.0;
    let u4 = (q11 + q22 + 6.0 * q12 - 4.0 * shear) / 8.0;
    let ((s2, c2), (s4, c4)) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
    let (a, b) = (u2 * s2 / 2.0 + u3 * s4, u2 * s2 / 2.0 - u3 * s4);
    [
        [u1 + u2 * c2 + u3 * c4, u4 - u3 * c4, a],
        [u4 - u3 * c4, u1 - u2 * c2 + u3 * c4, b],
        [a, b, (u1 - u4) / 2.0 - u3 * c4],
    ]
}

/// Stress `[11, 22, 12]` along axes that are rotated by an angle.
fn turned([xx, yy, xy]: [f64; 3], angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    [
        xx * c * c + yy * s * s + 2.0 * xy * s * c,
        xx * s * s + yy * c * c - 2.0 * xy * s * c,
        (yy - xx) * s * c + xy * (c * c - s * s),
    ]
}

/// A balanced, symmetric laminate under tension: strains by its membrane stiffness, stress of plies by theirs. The axes of the section do
/// not matter to plies, and rotate forces.
#[test]
fn plies_have_the_stress_of_laminate_theory() {
    let (moduli, nu, shear, thickness, tension) = ([1.4e5, 1e4], 0.3, 5e3, 5e-4, 2e-4);
    let angles = [
        FRAC_PI_4, -FRAC_PI_4, -FRAC_PI_4, FRAC_PI_4, 0.0, 0.0, FRAC_PI_4, -FRAC_PI_4, -FRAC_PI_4,
        FRAC_PI_4,
    ];
    let mut membrane = [[0.0; 3]; 3];
    for angle in angles {
        let own = off_axis(moduli, nu, shear, angle);
        (0..9).for_each(|k| membrane[k / 3][k % 3] += own[k / 3][k % 3] * thickness);
    }
    let [[a11, a12, a16], [_, a22, _], _] = membrane;
    assert!(a16.abs() < 1e-12 * a11);
    let determinant = a11 * a22 - a12 * a12;
    let strain = [
        tension * a22 / determinant,
        -tension * a12 / determinant,
        0.0,
    ];
    for axis in [0.0, 0.4] {
        let material = json!({"youngs_modulus": moduli, "poisson_ratio": nu, "shear_modulus": shear, "density": 1000});
        let plies: Vec<Value> = angles
            .map(|angle| json!({"material": material, "thickness": thickness, "angle": angle - axis}))
            .into();
        let keys = json!({"laminate": plies, "axis_angle": axis});
        let markers =
            json!({"end": {"at": [1, 0.5], "pad": [1e-9, 0.6]}, "m": [0.4, 0.3], "edge": [1, 1]});
        let mut scene = plate([1.0, 0.6], [3, 2], &keys, &markers);
        let numbers = [1, 2, 5];
        for marker in ["m", "edge"] {
            let outputs = scene["outputs"].as_array_mut().expect("outputs");
            outputs.push(
                json!({"kind": "ply_stress", "marker": format!("p.{marker}"), "plies": numbers}),
            );
        }
        let plane = |edge: &str, normal: [f64; 3]| {
            json!({"name": edge.replace('=', "_"), "kind": "symmetry",
            "edges": ["ground", format!("p.{edge}")], "normal": normal})
        };
        scene["joints"] = json!([plane("s1=0", [1.0, 0.0, 0.0]), plane("s2=0", [0.0, 1.0, 0.0]),
            {"name": "level", "kind": "generic", "markers": ["ground", "p.m"],
                "free": ["x", "y", "rotation_x", "rotation_y", "rotation_z"]}]);
        let load = json!([{"name": "F", "kind": "force", "marker": "p.end", "value": [0.6 * tension, 0, 0]}]);
        let mut run = Run::at_rest(scene, &load);
        for marker in ["m", "edge"] {
            let force: [f64; 3] = run.read_all(&format!("p.{marker}.membrane_force"));
            for (found, exact) in force.into_iter().zip(turned([tension, 0.0, 0.0], axis)) {
                is_near(found, exact, 2e-3 * tension);
            }
            for number in numbers {
                let angle = angles[number - 1];
                let law = off_axis(moduli, nu, shear, angle);
                let stress = law.map(|row| row[0] * strain[0] + row[1] * strain[1]);
                let exact = turned(stress, angle);
                let size = exact[0].abs();
                for side in ["bottom", "top"] {
                    let name = format!("p.{marker}.ply{number}_{side}_stress");
                    let found: [f64; 3] = run.read_all(&name);
                    for (found, exact) in found.into_iter().zip(exact) {
                        is_near(found, exact, 2e-3 * size);
                    }
                }
            }
        }
    }
}

/// Forces of a damped plate that moves are those of strains plus the damping time times their rates; outputs have derivatives.
#[test]
fn forces_are_damped() {
    let (h, time) = (0.02, 0.03);
    let mut keys = material(h, 0.0);
    keys["material"]["damping_time"] = json!(time);
    let markers = json!({"m": [0.3, 0.6]});
    let mut scene = plate([1.0, 0.8], [3, 2], &keys, &markers);
    hold(&mut scene, "clamped", &["s1=0"]);
    scene["loads"] =
        json!([{"name": "q", "kind": "pressure", "body": "p", "value": "20*sin(9*t)"}]);
    scene["accuracy"] = json!({"relative_tolerance": 1e-10});
    let mut run = Run::started(&scene);
    let names = [
        "membrane_strain",
        "curvature",
        "membrane_force",
        "bending_moment",
    ];
    let dt = 1e-4;
    let mut rows = Vec::new();
    for k in 0..3 {
        run.step(0.3 + f64::from(k) * dt);
        rows.push(names.map(|name| run.read_all::<3>(&format!("p.m.{name}"))));
    }
    let stiffness = 12.0 / (h * h);
    for (part, by) in [(0, stiffness), (1, 1.0)] {
        let rate = (rows[2][part][0] - rows[0][part][0]) / (2.0 * dt);
        let elastic = by * rows[1][part][0];
        let damped = by * time * rate;
        assert!(damped.abs() > 3e-3 * elastic.abs(), "{elastic} {damped}");
        let found = rows[1][part + 2][0];
        is_near(
            found,
            elastic + damped,
            1e-4 * (elastic.abs() + damped.abs()),
        );
    }
}

/// A strip whose thickness falls to the half is a tapered beam: `w'' = F (L - x) / EI(x)`, elongation `N / (E h(x))`, and stress at the faces
/// `6 M / h^2`. Its mass is that of a trapezoid, and a thickness that varies across the strip is found across it.
#[test]
fn tapered_strips_are_tapered_beams() {
    let (length, width, h, modulus): (f64, f64, f64, f64) = (2.0, 0.1, 0.02, 1e9);
    let strip = |thickness: &str, load: Value| {
        let keys = json!({"thickness": thickness,
            "material": {"youngs_modulus": modulus, "poisson_ratio": 0.0, "density": 1000}});
        let markers = json!({"end": {"at": [1, 0.5], "pad": [1e-9, width]}, "middle": [0.5, 0.5]});
        let mut scene = plate([length, width], [8, 1], &keys, &markers);
        hold(&mut scene, "clamped", &["s1=0"]);
        let outputs = scene["outputs"].as_array_mut().expect("outputs");
        outputs.extend([
            json!({"kind": "position", "marker": "p.end"}),
            json!({"kind": "surface_stress", "marker": "p.middle"}),
            json!({"kind": "momentum"}),
        ]);
        let load = json!([{"name": "F", "kind": "force", "marker": "p.end", "value": load}]);
        Run::at_rest(scene, &load)
    };
    let taper = |x: f64| h * (1.0 - 0.5 * x / length);
    let over = |of: &dyn Fn(f64) -> f64| {
        let parts = 2000;
        let d = length / f64::from(parts);
        let middles = (0..parts).map(|k| d * (f64::from(k) + 0.5));
        middles.map(|x| of(x) * d).sum::<f64>()
    };
    let bending = |x: f64| modulus * width * taper(x).powi(3) / 12.0;
    let force = 1e-3;
    let mut run = strip("0.02*(1-0.5*s1)", json!([0, 0, force]));
    let exact = over(&|x| force * (length - x).powi(2) / bending(x));
    is_near(run.read("p.end.position[3]") / exact, 1.0, 2e-4);
    let moment = force * 0.5 * length / width;
    let stress = 6.0 * moment / taper(0.5 * length).powi(2);
    is_near(run.read("p.middle.bottom_stress[1]") / stress, 1.0, 2e-3);
    is_near(run.read("p.middle.top_stress[1]") / stress, -1.0, 2e-3);
    let tension = 10.0;
    let mut run = strip("0.02*(1-0.5*s1)", json!([tension, 0, 0]));
    let exact = over(&|x| tension / (modulus * width * taper(x)));
    is_near((run.read("p.end.position[1]") - length) / exact, 1.0, 1e-4);
    // A wedge across the strip: the mean thickness carries tension, the mean of its cube bends.
    let mut run = strip("0.02*(0.5+s2)", json!([0, 0, force]));
    let cubes = (1.5_f64.powi(4) - 0.5_f64.powi(4)) / 4.0;
    let exact = force * length.powi(3) / (3.0 * modulus * width * h.powi(3) / 12.0 * cubes);
    is_near(run.read("p.end.position[3]") / exact, 1.0, 2e-3);
}

/// A free plate whose thickness varies has the momentum of its mass about the origin.
#[test]
fn tapered_plates_have_their_mass() {
    let keys = json!({"thickness": "0.01*(1+s1)*(2-s2)",
        "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.3, "density": 1000},
        "motion": {"velocity": [0, 0, 1]}});
    let mut scene = plate([2.0, 0.5], [3, 2], &keys, &json!({"corner": [1, 1]}));
    scene["outputs"] = json!([{"kind": "momentum"}]);
    let mut run = Run::started(&scene);
    let mass = 1000.0 * 0.01 * 1.5 * 1.5;
    is_near(run.read("momentum[3]") / mass, 1.0, 1e-9);
    // First moments: of `1 + s1` 5/6 over its mean of 3/2, of `2 - s2` 2/3.
    let (x, y) = (2.0 * (5.0 / 6.0) / 1.5, 0.5 * (2.0 / 3.0) / 1.5);
    is_near(run.read("angular_momentum[1]") / (mass * y), 1.0, 1e-9);
    is_near(run.read("angular_momentum[2]") / (-mass * x), 1.0, 1e-9);
}
