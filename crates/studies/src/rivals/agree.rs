//! Every formulation against the others and the product on the scenes.

use super::corotational::{Inertia, Local};
use super::march::{Kind, run};
use super::product::converged;
use super::rotations::Interpolation;
use super::scenes::{Choice, Played, Rod};
use super::system::System;
use super::table::apart;

const fn rotations(elements: usize, degree: usize, reduced: bool) -> Choice {
    Choice::Rotations(elements, Interpolation { degree, reduced })
}

/// Largest distance from the converged product over the length.
fn off(scene: Played, mut system: System, step: f64) -> f64 {
    let (path, _) = converged(scene).expect("the product");
    let seen = run(
        &mut system,
        Kind::Alpha(step),
        &scene.times(),
        scene.places(),
    );
    apart(&seen.expect("a run").positions, &path, scene.rod().length)
}

#[test]
fn rivals_and_product_agree_on_the_slider_crank() {
    let scene = Played::SliderCrank;
    for (choice, within) in [
        (Choice::Frame(3, 1, true), 1e-3),
        (
            Choice::Corotational(8, Local::ShallowArch, Inertia::Cubic),
            1e-3,
        ),
        // Shear and rotary inertia.
        (rotations(8, 2, true), 2e-3),
    ] {
        let off = off(scene, scene.system(choice), 2e-4);
        assert!(off < within, "{choice:?}: {off:e}");
    }
}

/// What floating frames leave out is of higher order: a rod four times as stiff, that bends a fourth as far, is off by
/// much less than a fourth.
#[test]
fn frames_are_off_by_a_power_of_the_deflection() {
    let scene = Played::SliderCrank;
    let between = |stiffer: f64| {
        let rod = scene.rod();
        let rod = Rod {
            bending: stiffer * rod.bending,
            ..rod
        };
        let path = |choice: Choice| {
            let mut system = scene.with(rod, choice);
            let seen = run(
                &mut system,
                Kind::Alpha(1e-4),
                &scene.times(),
                scene.places(),
            );
            seen.expect("a run").positions
        };
        let beams = path(Choice::Corotational(24, Local::ShallowArch, Inertia::Cubic));
        apart(&path(Choice::Frame(4, 3, true)), &beams, rod.length)
    };
    let (soft, stiff) = (between(1.0), between(4.0));
    println!("{soft:.1e} L, {stiff:.1e} L where four times as stiff");
    assert!(stiff < soft / 8.0, "{soft:e} {stiff:e}");
}

#[test]
fn without_shear_and_rotary_inertia_rotations_follow_the_product() {
    let (scene, choice) = (Played::Spaghetti, rotations(32, 2, true));
    let rod = scene.rod();
    let stiff = Rod {
        shear: 1e3 * rod.shear,
        rotary: 1e-3 * rod.rotary,
        ..rod
    };
    let shearing = off(scene, scene.system(choice), 5e-3);
    let shearless = off(scene, scene.with(stiff, choice), 5e-3);
    println!("{shearing:.1e} L from the product with shear, {shearless:.1e} L without");
    assert!(
        shearing > 0.02 && shearless < 0.1 * shearing,
        "{shearing:e} {shearless:e}"
    );
}

/// What the derivatives that the corotational tangent leaves out cost: beams with rotations have all of them.
#[test]
fn corotational_tangents_settle_nearly_as_fast_as_exact_ones() {
    let scene = Played::Spaghetti;
    let iterations = |choice: Choice| {
        let mut system = scene.system(choice);
        let seen = run(
            &mut system,
            Kind::Alpha(0.01),
            &scene.times(),
            scene.places(),
        );
        let [steps, iterations] = seen.expect("a run").counts.map(|count| count as f64);
        iterations / steps
    };
    let local = Local::ShallowArch;
    let found = iterations(Choice::Corotational(16, local, Inertia::Cubic));
    let exact = iterations(rotations(16, 1, true));
    println!("{found} iterations a step, {exact} with exact tangents");
    assert!(found < exact + 0.7, "{found} {exact}");
}
