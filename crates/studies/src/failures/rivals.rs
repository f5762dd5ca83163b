//! The formulations that the report argues against, where they fail: cantilever, spin-up, a rotation without strain. What
//! each does where it works is measured by `studies rivals`.

use serde_json::json;

use super::support::{Product, Row, figure, json, short};
use crate::rivals::{
    Choice, Interpolation, Kind, Played, adaptive, apart, converged, elastica, energy_turned, run,
    stretch_of_a_turn,
};
use crate::scene::Outcome;

const ELASTIC: &str = include_str!("../../../../tests/cases/elastica/scene.json");
const ELEMENTS: usize = 16;
/// EA L^2/EI, and GA L^2/EI where there is shear.
const SLENDERNESS: f64 = 1e8;

/// How far the product's tip is from the elastica, over L.
fn product_elastica() -> Outcome<f64> {
    let mut scene = json(ELASTIC)?;
    scene["bodies"][0]["elements"] = json!(ELEMENTS);
    scene["inputs"][0]["start"] = json!([0.0, 10.0]);
    let [x, y] = Product::start(&scene)?.position("rod.tip")?;
    Ok((x - 0.445_004_402_246_248_7).hypot(y - 0.810_609_024_880_296_5))
}

const fn rotations(degree: usize, reduced: bool) -> Choice {
    Choice::Rotations(ELEMENTS, Interpolation { degree, reduced })
}

/// Shear locking.
pub fn shear_locking() -> Outcome<Row> {
    let tip = elastica(rotations(1, false), SLENDERNESS)?;
    let cured = elastica(rotations(1, true), SLENDERNESS)?;
    let found = product_elastica()?;
    Ok(Row {
        place: "Slender beams with rotations as coordinates",
        method: "large rotation vector (Simo & Vu-Quoc), 16 linear elements fully integrated, GA L^2/EI = 1e8".into(),
        failing: figure(
            tip,
            format!("shear locks: tip {} L from the elastica (reduced integration {})", short(tip), short(cured)),
        ),
        product: figure(found, format!("tip {} L from the elastica", short(found))),
        test: "shear_locks_and_reduced_integration_cures",
    })
}

#[test]
fn shear_locks_and_reduced_integration_cures() {
    let row = shear_locking().expect("a row");
    assert!(row.failing.value > 0.8, "{}", row.failing.text);
    assert!(row.product.value < 2e-5, "{}", row.product.text);
    for (choice, within) in [(rotations(1, true), 5e-3), (rotations(2, true), 5e-5)] {
        let tip = elastica(choice, SLENDERNESS).expect("an equilibrium");
        assert!(tip < within, "{choice:?}: {tip:e}");
    }
}

/// Modes do not bend far.
pub fn large_bending_by_modes() -> Outcome<Row> {
    let tip = |bending: usize| elastica(Choice::Frame(bending, 4, true), SLENDERNESS);
    let (few, many) = (tip(4)?, tip(16)?);
    let found = product_elastica()?;
    Ok(Row {
        place: "Bending beyond small angles",
        method: "floating frame with foreshortening, modes of a clamped rod, F L^2/EI = 10".into(),
        failing: figure(
            many,
            format!(
                "tip {} L from the elastica with 4 bending modes, {} L with 16",
                short(few),
                short(many)
            ),
        ),
        product: figure(found, format!("tip {} L from the elastica", short(found))),
        test: "more_modes_do_not_bend_further",
    })
}

#[test]
fn more_modes_do_not_bend_further() {
    let row = large_bending_by_modes().expect("a row");
    assert!(row.failing.value > 0.5, "{}", row.failing.text);
    assert!(row.product.value < 2e-5, "{}", row.product.text);
}

/// How far the tip of the beam that is spun up is from the product's, over L; `Err` with the time at which it is lost.
fn spun_up(choice: Choice, reference: &[Vec<[f64; 2]>]) -> Result<f64, f64> {
    let scene = Played::SpinUp;
    let (times, step) = (scene.times(), Kind::Alpha(0.01));
    let seen = run(&mut scene.system(choice), step, &times, scene.places())?;
    Ok(apart(
        &seen.positions,
        &reference.to_vec(),
        scene.rod().length,
    ))
}

/// Spin without the stiffness that it gives.
pub fn softening() -> Outcome<Row> {
    let scene = Played::SpinUp;
    let (reference, _) = converged(scene)?;
    let (found, _) = adaptive(scene, 8, 1e-5)?;
    let found = apart(&found, &reference, scene.rod().length);
    let without = spun_up(Choice::Frame(3, 0, false), &reference);
    let with = spun_up(Choice::Frame(3, 0, true), &reference)
        .map_err(|time| format!("foreshortened modes end at {time} s"))?;
    let (value, words) = match without {
        Ok(off) => (off, format!("tip {} L off", short(off))),
        Err(time) => (
            f64::INFINITY,
            format!("the tip is lost after {} s", short(time)),
        ),
    };
    Ok(Row {
        place: "Spin beyond the first natural frequency",
        method: "floating frame without foreshortening, 3 modes; beam spun up to 6 rad/s".into(),
        failing: figure(
            value,
            format!(
                "loses its stiffness: {words} (with foreshortening {} L)",
                short(with)
            ),
        ),
        product: figure(
            found,
            format!("tip {} L off its converged path", short(found)),
        ),
        test: "frames_without_foreshortening_soften",
    })
}

#[test]
fn frames_without_foreshortening_soften() {
    let row = softening().expect("a row");
    assert!(row.failing.value > 0.5, "{}", row.failing.text);
    assert!(row.product.value < 1e-3, "{}", row.product.text);
    let reference = converged(Played::SpinUp).expect("the product").0;
    let with = spun_up(Choice::Frame(3, 0, true), &reference).expect("a run");
    assert!(with < 5e-3, "with foreshortening {with:e}");
}

/// Increments through linear strains.
pub fn increments() -> Outcome<Row> {
    let strain = stretch_of_a_turn(36);
    let rod = Played::SteelPendulum.rod();
    let energy = energy_turned(Played::SteelPendulum, 8, 8)?;
    let found = (2.0 * energy / (rod.axial * rod.length)).sqrt();
    Ok(Row {
        place: "A whole turn of an undeformed beam",
        method: "increments of 10 degrees through linear strains of a conventional element".into(),
        failing: figure(
            strain,
            format!(
                "feels an axial strain of {} (corotational: none)",
                short(strain)
            ),
        ),
        product: figure(found, format!("strain {}", short(found))),
        test: "linear_increments_strain_a_turn",
    })
}

#[test]
fn linear_increments_strain_a_turn() {
    let row = increments().expect("a row");
    assert!(row.failing.value < -0.5, "{}", row.failing.text);
    assert!(row.product.value < 1e-12, "{}", row.product.text);
}
