//! Shear of thick cantilevers by the coefficients of G. R. Cowper (J. Appl. Mech. 33 (1966) 335-340), which depend on Poisson's ratio and
//! on the axis: `F L^3 / (3 E I) + F L / (k G A)`. And the axis by which shear decides that a body is a beam.

use std::f64::consts::PI;

use flexbody::scene::Scene;
use serde_json::{Value, json};

use crate::laws::runs::Run;

const YOUNG: f64 = 2e9;
const LENGTH: f64 = 0.5;

/// A shape: what a scene says, area, second moments about the first and second axis, and coefficients along both axes by Poisson's ratio.
type Shape = (Value, f64, [f64; 2], fn(f64) -> [f64; 2]);

/// Width (along the first axis) and height of a rectangle and an ellipse, m.
const WIDE: [f64; 2] = [0.1, 0.2];
/// Radii of a tube, m.
const TUBE: [f64; 2] = [0.1, 0.06];

fn of_ellipse(along: f64, across: f64, nu: f64) -> f64 {
    let [a, b] = [along / 2.0, across / 2.0].map(|half| half * half);
    let under = a * a * (40.0 + 37.0 * nu) + a * b * (16.0 + 10.0 * nu) + b * b * nu;
    12.0 * (1.0 + nu) * a * (3.0 * a + b) / under
}

fn shapes() -> Vec<Shape> {
    let [w, h] = WIDE;
    let [outer, inner] = TUBE;
    let circle = PI / 4.0 * outer.powi(4);
    vec![
        (
            json!({"rectangle": {"width": w, "height": h}}),
            w * h,
            [w * h.powi(3) / 12.0, h * w.powi(3) / 12.0],
            |nu| [10.0 * (1.0 + nu) / (12.0 + 11.0 * nu); 2],
        ),
        (
            json!({"ellipse": {"width": w, "height": h}}),
            PI / 4.0 * w * h,
            [PI / 64.0 * w * h.powi(3), PI / 64.0 * h * w.powi(3)],
            |nu| {
                [
                    of_ellipse(WIDE[0], WIDE[1], nu),
                    of_ellipse(WIDE[1], WIDE[0], nu),
                ]
            },
        ),
        (
            json!({"circle": {"radius": outer}}),
            PI * outer * outer,
            [circle; 2],
            |nu| [6.0 * (1.0 + nu) / (7.0 + 6.0 * nu); 2],
        ),
        (
            json!({"tube": {"radius": outer, "inner_radius": inner}}),
            PI * (outer * outer - inner * inner),
            [circle - PI / 4.0 * inner.powi(4); 2],
            |nu| {
                let m = TUBE[1] / TUBE[0];
                let square = (1.0 + m * m).powi(2);
                [6.0 * (1.0 + nu) * square
                    / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m * m); 2]
            },
        ),
    ]
}

/// A cantilever along the first axis, whose section has its first axis along the second one.
fn cantilever(element: &str, section: Value, nu: f64, force: [f64; 3]) -> Value {
    json!({"name": "thick", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "initial": "static_equilibrium",
        "bodies": [{"element": element, "name": "line", "elements": 2,
            "material": {"youngs_modulus": YOUNG, "shear_modulus": 0.5 * YOUNG / (1.0 + nu), "density": 1000.0},
            "section": section, "axis": [0.0, 1.0, 0.0],
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [LENGTH, 0.0, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "push", "kind": "force", "marker": "line.tip", "value": force}],
        "outputs": [{"kind": "position", "marker": "line.tip"}], "accuracy": {"relative_tolerance": 1e-6}})
}

#[test]
fn thick_beams_shear_by_coefficients_of_poissons_ratio_about_both_axes() {
    for (shape, area, moments, factors) in shapes() {
        for nu in [0.0, 0.25, 0.45] {
            let force = 1.0;
            let scene = cantilever("beam", json!({"shape": shape}), nu, [0.0, force, force]);
            let mut run = Run::started(&scene);
            let shear = 0.5 * YOUNG / (1.0 + nu);
            let [first, second] = factors(nu);
            let bent = |moment: f64| force * LENGTH.powi(3) / (3.0 * YOUNG * moment);
            let sheared = |factor: f64| force * LENGTH / (factor * shear * area);
            // Along the first axis it bends about the second.
            let wanted = [
                bent(moments[1]) + sheared(first),
                bent(moments[0]) + sheared(second),
            ];
            for (k, wanted) in wanted.into_iter().enumerate() {
                let found = run.read(&format!("line.tip.position[{}]", k + 2));
                assert!(
                    (found / wanted - 1.0).abs() < 1e-6,
                    "{shape} {nu}: axis {k} {found} {wanted}"
                );
            }
        }
    }
}

/// Which element a body of `auto` becomes follows from the larger of `3 E I / (k G A L^2)` of both axes, each with the shear across its own.
#[test]
fn shear_decides_by_the_axis_that_it_is_across() {
    let (area, nu) = (0.02, 0.25);
    for (moments, factors) in [
        ([1e-6, 4e-6], [1.0, 0.1]),
        ([4e-6, 1e-6], [0.1, 1.0]),
        ([1e-6, 4e-6], [0.1, 1.0]),
        ([4e-6, 1e-6], [1.0, 0.1]),
    ] {
        let shear = 0.5 * YOUNG / (1.0 + nu);
        let part = |moment: f64, factor: f64| {
            3.0 * YOUNG * moment / (factor * shear * area * LENGTH * LENGTH)
        };
        // What bends about the first axis shears along the second.
        let largest = part(moments[0], factors[1]).max(part(moments[1], factors[0]));
        for (factor, wanted) in [(0.8, "beam"), (1.25, "rod")] {
            let section = json!({"area": area, "second_moments": moments, "torsion_constant": 1e-6, "shear_factors": factors});
            let mut scene = cantilever("auto", section, nu, [0.0, 1.0, 1.0]);
            scene["accuracy"]["error"] = json!(factor * largest);
            let scene =
                Scene::from_json(&scene.to_string()).unwrap_or_else(|error| panic!("{error}"));
            let chosen = scene.choose_elements().expect("a choice");
            assert_eq!(
                chosen[0].element(),
                wanted,
                "{moments:?} {factors:?}: {}",
                chosen[0].why
            );
        }
    }
}
