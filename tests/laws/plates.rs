//! Plates and shells against closed forms and laws of mechanics.

use std::f64::consts::{PI, TAU};

use serde_json::{Value, json};

use super::runs::Run;

/// A rectangular plate along the first two axes with D = 1, thickness `h` and so many elements.
pub(super) fn plate(sides: [f64; 2], mesh: [u32; 2], h: f64, poisson: f64) -> Value {
    let modulus = 12.0 * (1.0 - poisson * poisson) / h.powi(3);
    json!({"name": "plate", "dimension": 3, "gravity": [0, 0, 0],
        "bodies": [{"name": "p", "element": "plate", "mesh": mesh, "thickness": h,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[sides[0], 0, 0], [0, sides[1], 0]]}},
            "material": {"youngs_modulus": modulus, "poisson_ratio": poisson, "density": 1.0 / h},
            "markers": {"middle": [0.5, 0.5], "corner": [1, 1], "end": {"at": [1, 0.5], "pad": [1e-6, sides[1]]}}}],
        "joints": [], "loads": [], "outputs": [{"kind": "position", "marker": "p.middle"},
            {"kind": "position", "marker": "p.corner"}, {"kind": "position", "marker": "p.end"}]})
}

/// Holds edges of the plate.
pub(super) fn hold(scene: &mut Value, kind: &str, edges: &[&str]) {
    for (k, edge) in edges.iter().enumerate() {
        let joint = json!({"name": format!("edge{k}"), "kind": kind, "edges": ["ground", format!("p.{edge}")]});
        scene["joints"].as_array_mut().expect("joints").push(joint);
    }
}

pub(super) const ALL: [&str; 4] = ["s1=0", "s1=1", "s2=0", "s2=1"];

/// The scene in static equilibrium under a load.
fn at_rest(scene: Value, load: &Value) -> Run {
    Run::at_rest(scene, &json!([load]))
}

/// Deflection of the middle of a square under a small uniform pressure, over the pressure.
fn deflection(kind: &str, elements: u32) -> f64 {
    let mut scene = plate([1.0, 1.0], [elements; 2], 0.01, 0.3);
    hold(&mut scene, kind, &ALL);
    let load = json!({"name": "q", "kind": "pressure", "body": "p", "value": 1e-4});
    at_rest(scene, &load).read("p.middle.position[3]") / 1e-4
}

/// Series of Navier and of Timoshenko and Woinowsky-Krieger (1959), articles 30 and 44, for a square.
#[test]
fn squares_under_pressure_bend_as_the_series_say() {
    let off = |kind, elements, exact: f64| (deflection(kind, elements) / exact - 1.0).abs();
    let [coarse, fine] = [4, 8].map(|elements| off("pinned", elements, 0.004_062_352_66));
    assert!(
        fine < 1e-4 && coarse / fine > 2_f64.powf(3.7),
        "{coarse:e} {fine:e}"
    );
    assert!(off("clamped", 8, 0.001_265_32) < 1e-4);
}

/// A square under `q sin(pi s1) sin(pi s2)` deflects by `q / (4 pi^4 D)` in its middle (Navier). A pressure that grows along it acts beside its middle.
#[test]
fn loads_vary_over_a_surface() {
    let text = "1e-4*sin(PI*s1)*sin(PI*s2)";
    for (kind, value) in [
        ("pressure", json!(text)),
        ("area_force", json!([0, 0, text])),
    ] {
        let mut scene = plate([1.0, 1.0], [8, 8], 0.01, 0.3);
        hold(&mut scene, "pinned", &ALL);
        let load = json!({"name": "q", "kind": kind, "body": "p", "value": value});
        let found = at_rest(scene, &load).read("p.middle.position[3]") / 1e-4;
        let exact = 0.25 / PI.powi(4);
        assert!(
            (found / exact - 1.0).abs() < 1e-4,
            "{kind}: {found} {exact}"
        );
    }
    let mut scene = plate([1.0, 0.5], [3, 2], 0.01, 0.3);
    hold(&mut scene, "clamped", &["s1=0"]);
    scene["outputs"] = json!([{"kind": "reaction", "joint": "edge0"}, {"kind": "reaction_moment", "joint": "edge0"}]);
    let load =
        json!({"name": "q", "kind": "area_force", "body": "p", "value": [0, 0, "1e-4*s1*(1+s2)"]});
    let mut run = at_rest(scene, &load);
    let ([_, _, force], [about_x, about_y, _]) = (
        run.read_all("edge0.reaction"),
        run.read_all::<3>("edge0.reaction_moment"),
    );
    // Sums over `s1` and over `1 + s2`, about the middle of the edge.
    let (total, arm) = (1e-4 * 0.5 * 0.5 * 1.5, 2.0 / 3.0);
    let across = 1e-4 * 0.5 * 0.25 * (0.5 + 1.0 / 3.0 - 0.75);
    assert!((force / -total - 1.0).abs() < 1e-8, "{force} {total}");
    assert!((about_y / (total * arm) - 1.0).abs() < 1e-4, "{about_y}");
    assert!((about_x / -across - 1.0).abs() < 1e-3, "{about_x} {across}");
}

/// A strip that an end moment rolls to a circle. A cubic of the arc misses a circle by 2e-3 of the radius for elements of 45 degrees.
#[test]
fn an_end_moment_rolls_a_strip_to_a_circle() {
    let width = 0.1;
    let mut scene = plate([1.0, width], [16, 1], 1e-3, 0.0);
    hold(&mut scene, "clamped", &["s1=0"]);
    // The moment that rotates the end by one revolution; against the second axis it lifts the end.
    let moment =
        json!({"name": "M", "kind": "moment", "marker": "p.end", "value": [0, -TAU * width, 0]});
    let mut run = at_rest(scene, &moment);
    let [x, y, z] = run.read_all("p.end.position");
    let off = x.hypot(z).max((y - 0.5 * width).abs());
    assert!(off < 1e-4, "{x} {y} {z}");
    let [mx, _, mz] = run.read_all("p.middle.position");
    assert!(mx.abs() < 1e-4 && (mz - 1.0 / PI).abs() < 1e-4, "{mx} {mz}");
}

/// The elastica under an end force of 4 EI / L^2 (K. E. Bisshopp, D. C. Drucker, Quart. Appl. Math. 3 (1945)): tip at 0.67106 L and 0.66997 L.
#[test]
fn a_strip_under_an_end_force_is_the_elastica() {
    for h in [0.01, 1e-4] {
        let mut scene = plate([1.0, 0.1], [16, 1], h, 0.0);
        hold(&mut scene, "clamped", &["s1=0"]);
        let force = json!({"name": "F", "kind": "force", "marker": "p.end", "value": [0, 0, 0.4]});
        let [x, _, z] = at_rest(scene, &force).read_all("p.end.position");
        assert!(
            (x - 0.671_06).abs() < 3e-5 && (z - 0.669_97).abs() < 3e-5,
            "{h}: {x} {z}"
        );
    }
}

/// A. W. Leissa, J. Sound Vib. 31 (1973): `omega a^2 sqrt(rho h / D)` of squares.
#[test]
fn frequencies_of_squares_are_the_published_ones() {
    let clamped = [35.985, 73.394, 73.394, 108.217, 131.581];
    let free = [13.468, 19.596, 24.270, 34.801, 34.801, 61.093];
    let pinned = [2.0, 5.0, 5.0, 8.0, 10.0].map(|sum| sum * PI * PI);
    let cases: [(&str, usize, &[f64]); 3] = [
        ("clamped", 0, &clamped),
        ("pinned", 0, &pinned),
        ("free", 6, &free),
    ];
    for (kind, rigid, exact) in cases {
        let mut scene = plate([1.0, 1.0], [8, 8], 0.01, 0.3);
        if kind != "free" {
            hold(&mut scene, kind, &ALL);
        }
        scene["outputs"] = json!([{"kind": "natural_frequency", "count": rigid + exact.len()}]);
        let mut run = Run::started(&scene);
        for k in 0..rigid {
            assert!(
                run.read(&format!("natural_frequency[{}]", k + 1)) < 1e-3,
                "{kind} {k}"
            );
        }
        for (k, exact) in exact.iter().enumerate() {
            let found = run.read(&format!("natural_frequency[{}]", rigid + k + 1));
            assert!(
                (found / exact - 1.0).abs() < 1.2e-3,
                "{kind} {k}: {found} for {exact}"
            );
        }
    }
}

/// A strip whose layers are not symmetric bends under tension by `T B / (A D - B^2)` and stretches by `T D / (A D - B^2)` (R. M. Jones,
/// Mechanics of Composite Materials (1999), section 4.4, one direction alone).
#[test]
fn a_laminate_bends_under_tension() {
    let (a, b, d, tension) = (1e4, 20.0, 1.0, 1e-4);
    let mut scene = plate([1.0, 0.1], [4, 1], 0.01, 0.0);
    let body = scene["bodies"][0].as_object_mut().expect("a body");
    body.remove("material");
    body.remove("thickness");
    let diagonal =
        |first: f64, others: f64| [[first, 0.0, 0.0], [0.0, others, 0.0], [0.0, 0.0, others]];
    body.insert(
        "stiffness".into(),
        json!({"A": diagonal(a, a), "B": diagonal(b, 0.0), "D": diagonal(d, d)}),
    );
    body.insert("area_density".into(), json!(1.0));
    hold(&mut scene, "clamped", &["s1=0"]);
    let force =
        json!({"name": "F", "kind": "force", "marker": "p.end", "value": [0.1 * tension, 0, 0]});
    let [x, _, z] = at_rest(scene, &force).read_all("p.corner.position");
    let determinant = a * d - b * b;
    let (curvature, strain) = (tension * b / determinant, tension * d / determinant);
    assert!(
        (z.abs() / (0.5 * curvature) - 1.0).abs() < 1e-3,
        "{z} for {}",
        0.5 * curvature
    );
    assert!(
        ((x - 1.0) / strain - 1.0).abs() < 1e-3,
        "{} for {strain}",
        x - 1.0
    );
}

/// A thin soft plate that flies and spins about an axis that is none of its principal ones.
fn flying(method: &str) -> Value {
    let mut scene = plate([1.0, 0.7], [3, 2], 0.02, 0.3);
    scene["bodies"][0]["motion"] = json!({"velocity": [0.3, -0.2, 0.5], "spin": [0.4, 0.7, 1.1]});
    scene["outputs"] =
        json!([{"kind": "energy"}, {"kind": "momentum"}, {"kind": "center_of_mass"}]);
    scene["method"] = json!({"integrator": method});
    scene["accuracy"] = json!({"relative_tolerance": 1e-8});
    scene
}

#[test]
fn a_plate_that_flies_keeps_momentum_and_energy() {
    for method in ["radau", "dopri853"] {
        let mut run = Run::started(&flying(method));
        let (momenta, energy) = (run.momenta(), run.mechanical_energy());
        assert!(momenta.len() >= 3, "{momenta:?}");
        run.step(1.5);
        for (before, after) in momenta.iter().zip(run.momenta()) {
            assert!((after - before).abs() < 1e-8, "{method} {before} {after}");
        }
        let last = run.mechanical_energy();
        assert!(
            (last - energy).abs() < 1e-6 * energy && energy > 0.0,
            "{method} {energy} {last}"
        );
    }
}

/// A stiff square that hangs from the middle of an edge: a physical pendulum about the first axis.
#[test]
fn a_plate_on_a_hinge_is_a_physical_pendulum() {
    let (side, gravity) = (0.6, 9.81);
    let mut scene = plate([side, side], [2, 2], 0.05, 0.3);
    scene["bodies"][0]["material"]["youngs_modulus"] = json!(1e11);
    scene["bodies"][0]["surface"] =
        json!({"rectangle": {"corner": [0, 0, 0], "edges": [[side, 0, 0], [0, 0, -side]]}});
    scene["bodies"][0]["markers"]["top"] = json!({"at": [0.5, 0], "pad": [0.2, 1e-6]});
    scene["gravity"] = json!([0, 0, -gravity]);
    scene["joints"] = json!([{"name": "hinge", "kind": "revolute", "markers": ["ground", "p.top"], "direction": [1, 0, 0]}]);
    scene["initial"] = json!("static_equilibrium");
    scene["outputs"] = json!([{"kind": "natural_frequency", "count": 1}]);
    let found = Run::started(&scene).read("natural_frequency[1]");
    let exact = (gravity * 0.5 * side / (side * side / 3.0)).sqrt();
    assert!((found / exact - 1.0).abs() < 1e-5, "{found} for {exact}");
}

/// Pressure that swells a damped sheet: what it supplies is stored, moves, or is dissipated.
#[test]
fn pressure_and_damping_keep_the_books() {
    let mut scene = plate([1.0, 0.8], [3, 3], 0.02, 0.3);
    scene["bodies"][0]["material"]["damping_time"] = json!(1e-3);
    hold(&mut scene, "pinned", &["s1=0"]);
    scene["loads"] = json!([{"name": "q", "kind": "pressure", "body": "p", "value": "3*sin(5*t)"}]);
    scene["outputs"] = json!([{"kind": "energy"}, {"kind": "work"}]);
    scene["accuracy"] = json!({"relative_tolerance": 1e-8});
    let mut run = Run::started(&scene);
    let names = run.names();
    let before = run.outputs();
    run.step(0.8);
    let after = run.outputs();
    let of = |values: &[f64], part: &str| {
        let own = names
            .iter()
            .zip(values)
            .filter(|(name, _)| name.contains(part));
        own.map(|(_, value)| *value).sum::<f64>()
    };
    let stored: f64 = ["kinetic", "strain"]
        .iter()
        .map(|part| of(&after, part) - of(&before, part))
        .sum();
    let supplied = of(&after, "input");
    let dissipated = of(&after, "dissipated");
    let off = (supplied - dissipated - stored).abs();
    assert!(
        supplied > 0.1 && dissipated > 1e-4,
        "{names:?} {supplied} {dissipated}"
    );
    assert!(
        off < 1e-6 * supplied,
        "{supplied} {dissipated} {stored}: {off:e}"
    );
}

/// Which direction comes first does not matter.
#[test]
fn directions_may_be_exchanged() {
    let run = |edges: Value, mesh: [u32; 2], edge: &str, corner: [u32; 2]| {
        let mut scene = plate([1.0, 1.0], mesh, 0.01, 0.3);
        scene["bodies"][0]["surface"]["rectangle"]["edges"] = edges;
        scene["bodies"][0]["markers"]["corner"] = json!(corner);
        hold(&mut scene, "clamped", &[edge]);
        let force =
            json!({"name": "F", "kind": "force", "marker": "p.corner", "value": [0.1, -0.2, 2]});
        at_rest(scene, &force).read_all::<3>("p.corner.position")
    };
    let first = run(json!([[1.2, 0, 0], [0, 0.7, 0.1]]), [3, 2], "s1=0", [1, 1]);
    let second = run(json!([[0, 0.7, 0.1], [1.2, 0, 0]]), [2, 3], "s2=0", [1, 1]);
    let off = first
        .iter()
        .zip(&second)
        .fold(0.0, |sum: f64, (a, b)| sum.max((a - b).abs()));
    assert!(off < 1e-9, "{first:?} {second:?}");
}
