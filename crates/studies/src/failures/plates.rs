//! Plates and shells less what makes the product's good, and sheets that a point holds.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use serde_json::{Value, json};

use super::support::{Product, Row, figure, short};
use crate::plates::{Sampling, Stress, bending_stiffness, hemisphere, iterations, pinned_square};
use crate::scene::Outcome;

/// Poisson's ratio where nothing else is said.
const POISSON: f64 = 0.3;
/// Deflection of a pinned square under a uniform load, over `q a^4 / D`: Navier's series (S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates
/// and Shells (1959), article 30).
const NAVIER: f64 = 0.004_062_352_66;
/// Displacement of the pinched hemisphere of a thickness of 4e-4 radii, m: both rules for membrane strains tend to it, on 32 x 32 elements to
/// 0.0916 and 0.0915.
const PINCHED: f64 = 0.0916;
/// Thickness of that hemisphere, m.
const THIN: f64 = 4e-3;

/// A rectangle with a bending stiffness of 1 N m, with this thickness over 1 m.
fn plate(sides: [f64; 2], mesh: [usize; 2], thickness: f64, poisson: f64) -> Value {
    let modulus = 12.0 * (1.0 - poisson * poisson) / thickness.powi(3);
    json!({"name": "plate", "dimension": 3, "gravity": [0, 0, 0], "initial": "static_equilibrium",
        "bodies": [{"name": "p", "element": "plate", "mesh": mesh, "thickness": thickness,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[sides[0], 0, 0], [0, sides[1], 0]]}},
            "material": {"youngs_modulus": modulus, "poisson_ratio": poisson, "density": 1.0 / thickness},
            "markers": {"seen": {"at": [1, 0.5], "pad": [1e-6, sides[1]]}}}],
        "joints": [], "loads": [], "outputs": [{"kind": "position", "marker": "p.seen"}]})
}

/// A joint of an edge with the ground.
fn edge(name: &str, kind: &str, edge: &str) -> Value {
    json!({"name": name, "kind": kind, "edges": ["ground", format!("p.{edge}")]})
}

/// Place of the marker that is seen, in the equilibrium of a scene, m.
fn seen(scene: &Value) -> Outcome<[f64; 3]> {
    let mut product = Product::start(scene)?;
    let [x, y, z] = [1, 2, 3].map(|axis| product.get(&format!("p.seen.position[{axis}]")));
    Ok([x?, y?, z?])
}

/// Deflection of the product's pinned square under a small uniform load, off Navier's series.
fn pinned(count: usize) -> Outcome<f64> {
    let load = 1e-4;
    let mut scene = plate([1.0, 1.0], [count; 2], 0.01, POISSON);
    scene["bodies"][0]["markers"] = json!({"seen": [0.5, 0.5]});
    scene["joints"] = json!([
        edge("a", "pinned", "s1=0"),
        edge("b", "pinned", "s1=1"),
        edge("c", "pinned", "s2=0"),
        edge("d", "pinned", "s2=1")
    ]);
    scene["loads"] =
        json!([{"name": "q", "kind": "area_force", "body": "p", "value": [0, 0, load]}]);
    let [.., deflection] = seen(&scene)?;
    Ok((deflection / (load * NAVIER) - 1.0).abs())
}

/// Something off by so much with 4 and 8 elements, in words.
fn of_order([coarse, fine]: [f64; 2]) -> String {
    format!("{} off, order {:.0}", short(fine), (coarse / fine).log2())
}

/// Plates whose slopes jump between elements.
pub fn no_mixed_derivative() -> Outcome<Row> {
    let without = |count| {
        let found = pinned_square(count, POISSON).ok_or("expected a stiffness that is positive")?;
        Outcome::Ok((found / NAVIER - 1.0).abs())
    };
    let failing = [without(4)?, without(8)?];
    let found = [pinned(4)?, pinned(8)?];
    Ok(Row {
        place: "Bending of plates",
        method: "nodes with both derivatives and no mixed one, not conforming; pinned square under a uniform load, 8 x 8 elements".into(),
        failing: figure(failing[1], format!("deflection {}", of_order(failing))),
        product: figure(found[1], of_order(found)),
        test: "plates_without_a_mixed_derivative_are_of_order_two",
    })
}

#[test]
fn plates_without_a_mixed_derivative_are_of_order_two() {
    let row = no_mixed_derivative().expect("a row");
    // Exudyn 1.13.6 (`crates/studies/exudyn/plates.py`) is off by 1.6e-2 with 8 x 8 elements too.
    assert!(
        (row.failing.value - 1.65e-2).abs() < 1e-4,
        "{}",
        row.failing.text
    );
    assert!(row.failing.text.ends_with("order 2"));
    assert!(row.product.value < 1e-4, "{}", row.product.text);
    assert!(row.product.text.ends_with("order 4"));
}

/// Displacement of the product's pinched hemisphere under the force that pulls, under forces of 2 N times the cube of the thickness over 0.04 m;
/// under a hundredth of them, which displace it little.
fn pinched(count: usize, thickness: f64) -> Outcome<f64> {
    let force = 0.01 * (thickness / 0.04_f64).powi(3);
    let symmetry = |edge: &str, normal: [u32; 3]| json!({"name": edge.replace('=', "_"), "kind": "symmetry", "edges": ["ground", format!("p.{edge}")], "normal": normal});
    let load = |name: &str, value: [f64; 3]| json!({"name": name, "kind": "force", "marker": format!("p.{name}"), "value": value});
    let scene = json!({"name": "hemisphere", "dimension": 3, "gravity": [0, 0, 0], "initial": "static_equilibrium",
        "bodies": [{"name": "p", "element": "shell", "mesh": [count, count], "thickness": thickness,
            "surface": {"sphere": {"center": [0, 0, 0], "radius": 10, "axis": [0, 0, 1], "start": [1, 0, 0],
                "latitudes": [0, 72_f64.to_radians()], "angle": FRAC_PI_2}},
            "material": {"youngs_modulus": 6.825e7, "poisson_ratio": POISSON, "density": 1},
            "markers": {"seen": [0, 0], "press": [1, 0], "top": [0.5, 1]}}],
        "joints": [symmetry("s1=0", [0, 1, 0]), symmetry("s1=1", [1, 0, 0]),
            {"name": "height", "kind": "generic", "markers": ["ground", "p.top"],
                "free": ["x", "y", "rotation_x", "rotation_y", "rotation_z"]}],
        "loads": [load("seen", [force, 0.0, 0.0]), load("press", [0.0, -force, 0.0])],
        "outputs": [{"kind": "position", "marker": "p.seen"}]});
    let [x, ..] = seen(&scene)?;
    Ok(100.0 * (x - 10.0))
}

/// Membrane strains that bending of thin curved elements cannot avoid.
pub fn membrane_locking() -> Outcome<Row> {
    let locked = hemisphere(4, THIN, Sampling::Gauss);
    let locked = locked.ok_or("expected a stiffness that is positive")?;
    let found = pinched(4, THIN)?;
    Ok(Row {
        place: "Thin shells",
        method: "membrane strains at the 3 x 3 points of Gauss; pinched hemisphere with a hole, h/R = 4e-4, 4 x 4 elements".into(),
        failing: figure(
            locked / PINCHED,
            format!("locks: {} of the displacement", short(locked / PINCHED)),
        ),
        product: figure(found / PINCHED, format!("{found:.4} of {PINCHED}")),
        test: "membrane_strains_at_points_of_gauss_lock",
    })
}

#[test]
fn membrane_strains_at_points_of_gauss_lock() {
    let row = membrane_locking().expect("a row");
    assert!(row.failing.value < 0.15, "{}", row.failing.text);
    assert!(
        (row.product.value - 1.0).abs() < 0.02,
        "{}",
        row.product.text
    );
    // The linear element here is the product's but for that, and is right where shells are thicker (MacNeal and Harder: 0.094).
    let own = hemisphere(4, THIN, Sampling::Lobatto).expect("a displacement");
    assert!(
        (own / PINCHED / row.product.value - 1.0).abs() < 2e-3,
        "{own}"
    );
    let thick = hemisphere(8, 0.04, Sampling::Lobatto).expect("a displacement");
    assert!((thick / 0.094 - 1.0).abs() < 0.01, "{thick}");
}

/// Moment per width on the strip in cylindrical bending, N.
const MOMENT: f64 = 1e-3;

/// Bending stiffness over that of a thin plate that the product's strip shows, whose sides are planes of symmetry.
fn cylindrical(count: usize) -> Outcome<f64> {
    let width = 0.1;
    let mut scene = plate([1.0, width], [count, 1], 0.01, POISSON);
    let symmetry = |name: &str, at: &str| {
        let mut joint = edge(name, "symmetry", at);
        joint["normal"] = json!([0, 1, 0]);
        joint
    };
    scene["joints"] = json!([
        edge("wall", "clamped", "s1=0"),
        symmetry("left", "s2=0"),
        symmetry("right", "s2=1")
    ]);
    scene["loads"] = json!([{"name": "M", "kind": "moment", "marker": "p.seen", "value": [0, -MOMENT * width, 0]}]);
    let [.., deflection] = seen(&scene)?;
    // An arc of the curvature of the moment.
    Ok((1.0 - MOMENT.cos()) / MOMENT / deflection)
}

/// Nodes whose derivative through the thickness is too stiff for bending.
pub fn thick_nodes() -> Outcome<Row> {
    let stiff = |count| bending_stiffness(count, 0.01, POISSON);
    let stiff = stiff(16).ok_or("expected a stiffness that is positive")? - 1.0;
    let found = (cylindrical(16)? - 1.0).abs();
    Ok(Row {
        place: "Plates with all derivatives at their nodes",
        method: "nodes with a derivative through the thickness, strains of a solid; strip in cylindrical bending, nu = 0.3, 16 elements".into(),
        failing: figure(
            stiff,
            format!(
                "too stiff by {:.1} % on every mesh, as (1-nu)^2/(1-2nu)",
                100.0 * stiff
            ),
        ),
        product: figure(found, format!("stiffness {} off", short(found))),
        test: "nodes_with_a_derivative_through_the_thickness_are_too_stiff",
    })
}

#[test]
fn nodes_with_a_derivative_through_the_thickness_are_too_stiff() {
    let row = thick_nodes().expect("a row");
    assert!(row.product.value < 1e-5, "{}", row.product.text);
    for poisson in [0.0, 0.2, POISSON] {
        let exact = (1.0 - poisson) * (1.0 - poisson) / (1.0 - 2.0 * poisson);
        for count in [1, 4, 16] {
            let found = bending_stiffness(count, 0.01, poisson).expect("a stiffness");
            assert!((found / exact - 1.0).abs() < 1e-6, "{count}: {found}");
        }
    }
}

/// Elements of the strip, thicknesses over its length, and iterations after which it is given up.
const STRIP: usize = 16;
const SLENDER: [f64; 2] = [1e-3, 1e-4];
const MOST: usize = 200;

/// Iterations in words.
fn counted(stress: Stress) -> [Option<usize>; 2] {
    SLENDER.map(|h| iterations(STRIP, h, stress, MOST).map(|(count, _)| count))
}

/// Iterations of both strips in one sentence.
fn told(counts: [Option<usize>; 2]) -> String {
    let words = counts.map(|count| match count {
        Some(count) => format!("{count} iterations"),
        None => format!("no equilibrium in {MOST} iterations"),
    });
    words.join(", ")
}

/// Rotations that stretch a thin surface at second order.
pub fn newton_of_plates() -> Outcome<Row> {
    let (usual, predicted) = (counted(Stress::Present), counted(Stress::Predicted));
    let number = |count: Option<usize>| count.map_or(f64::INFINITY, |count| count as f64);
    let most = predicted.map(number).into_iter().fold(0.0, f64::max);
    Ok(Row {
        place: "Large static deflection of thin plates",
        method: "Newton's method with the stress of the present state in its tangent; strip of 16 elements under 4 EI/L^2 at once, h/L = 1e-3 and 1e-4".into(),
        failing: figure(number(usual[1]), told(usual)),
        product: figure(
            most,
            format!("stress predicted by the last linear step: {}", told(predicted)),
        ),
        test: "newton_crawls_on_thin_plates",
    })
}

#[test]
fn newton_crawls_on_thin_plates() {
    let row = newton_of_plates().expect("a row");
    // It hits the equilibrium by chance: a load or a thickness a thousandth larger takes a third more or less, or leads elsewhere.
    assert!(row.failing.value > 30.0, "{}", row.failing.text);
    let usual = iterations(STRIP, SLENDER[0], Stress::Present, MOST);
    assert!(usual.is_none_or(|(count, _)| count > 20), "{usual:?}");
    assert!(row.product.value < 9.0, "{}", row.product.text);
    // K. E. Bisshopp, D. C. Drucker, Quart. Appl. Math. 3 (1945).
    let [exact_x, exact_z] = [0.671_06, 0.669_97];
    for thickness in SLENDER {
        let (_, tip) = iterations(STRIP, thickness, Stress::Predicted, MOST).expect("a tip");
        let mut scene = plate([1.0, 0.1], [STRIP, 1], thickness, 0.0);
        scene["joints"] = json!([edge("wall", "clamped", "s1=0")]);
        scene["loads"] =
            json!([{"name": "F", "kind": "force", "marker": "p.seen", "value": [0, 0, 0.4]}]);
        let [x, _, z] = seen(&scene).expect("an equilibrium");
        for [x, z] in [tip, [x, z]] {
            let off = (x - exact_x).abs().max((z - exact_z).abs());
            assert!(off < 3e-5, "{thickness}: {x} {z}");
        }
    }
}

/// Weight over Young's modulus and thickness of a sheet, m: small, so that it sinks in proportion.
const WEIGHT: f64 = 1e-5;
/// Meshes of the sheet, and the pad that holds it, m.
const SHEETS: [usize; 3] = [4, 8, 16];
const PAD: f64 = 0.1;

/// A square sheet of 1 m that hangs from its upper corner or from a pad there; it is read where it is lowest.
fn sheet(count: usize, is_on_pad: bool) -> Value {
    let half = FRAC_1_SQRT_2;
    let held = if is_on_pad {
        json!({"at": [0.5 * PAD, 0.5 * PAD], "pad": [PAD, PAD]})
    } else {
        json!([0, 0])
    };
    json!({"name": "sheet", "dimension": 3, "gravity": [0, 0, -10], "initial": "static_equilibrium",
        "bodies": [{"name": "p", "element": "plate", "mesh": [count, count], "thickness": 0.01,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[half, 0, -half], [-half, 0, -half]]}},
            "material": {"youngs_modulus": 1e3 * 10.0 / WEIGHT, "poisson_ratio": POISSON, "density": 1e3},
            "markers": {"held": held, "side": [1, 0], "seen": [1, 1]}}],
        // The side keeps it from rotating about the vertical line that it hangs on.
        "joints": [{"name": "hook", "kind": "spherical", "markers": ["ground", "p.held"]},
            {"name": "plane", "kind": "generic", "markers": ["ground", "p.side"],
                "free": ["x", "z", "rotation_x", "rotation_y", "rotation_z"]}],
        "loads": [], "outputs": [{"kind": "position", "marker": "p.seen"}]})
}

/// How far the lowest corner sinks, over weight by Young's modulus and thickness.
fn sinks(is_on_pad: bool) -> Outcome<[f64; 3]> {
    let mut found = [0.0; 3];
    for (found, count) in found.iter_mut().zip(SHEETS) {
        let [.., z] = seen(&sheet(count, is_on_pad))?;
        *found = (-2.0 * FRAC_1_SQRT_2 - z) / WEIGHT;
    }
    Ok(found)
}

/// What the last halving of elements changed over what the one before did.
fn falls([coarse, middle, fine]: [f64; 3]) -> f64 {
    (fine - middle) / (middle - coarse)
}

/// A point, on which the displacement of a membrane has no limit.
pub fn held_at_a_point() -> Outcome<Row> {
    let (point, pad) = (sinks(false)?, sinks(true)?);
    let words = |found: [f64; 3]| found.map(|depth| format!("{depth:.3}")).join(", ");
    Ok(Row {
        place: "A sheet that hangs from a corner",
        method: "held at a point; its lowest corner sinks so many times weight/Eh on 4, 8 and 16 elements a side".into(),
        failing: figure(
            falls(point),
            format!("{}: grows as a logarithm, without a limit", words(point)),
        ),
        product: figure(
            falls(pad),
            format!(
                "{} held on a pad of a tenth of its side; remarks on a joint at a point",
                words(pad)
            ),
        ),
        test: "a_point_does_not_hold_a_membrane",
    })
}

#[test]
fn a_point_does_not_hold_a_membrane() {
    use flexbody::scene::{Scene, remarks};
    let row = held_at_a_point().expect("a row");
    // A logarithm grows by as much with each halving.
    assert!(
        (row.failing.value - 1.0).abs() < 0.1,
        "{}",
        row.failing.text
    );
    assert!(row.product.value < 0.6, "{}", row.product.text);
    for (is_on_pad, is_told) in [(false, true), (true, false)] {
        let scene = Scene::from_json(&sheet(4, is_on_pad).to_string()).expect("a scene");
        let found = remarks(&scene);
        let is_of_points = |words: &String| words.contains("hook") && words.contains("pad");
        assert_eq!(found.iter().any(is_of_points), is_told, "{found:?}");
    }
}
