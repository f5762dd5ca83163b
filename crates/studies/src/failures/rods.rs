//! Rods and beams in space, less a term each: frames, twist, spin, directors; and elements that bend or twist too far.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::support::{Figure, Product, Row, figure, json, short};
use crate::rods::{ALL, Directors, Kept, Real3, Rod, Section, Thrown, equilibrium, torque_at};
use crate::scene::Outcome;

const HELIX: &str = include_str!("../../../../tests/cases/rod_statics/helix.json");
const STRIP: &str = include_str!("../../../../tests/cases/rod_statics/strip.json");
const FREE: &str = include_str!("../../../../tests/cases/free_rod/rk4.json");

/// A rod of unit length and bending stiffness rolled into a helix by a dead moment: closed form (case `rod_statics`).
const MOMENT: [f64; 3] = [1.5, 2.0, 4.0];
const ROLLED: [f64; 3] = [
    -0.089_435_803_598_323_9,
    0.342_363_403_006_412_9,
    0.237_356_724_846_165_1,
];
/// A strip of unit length, 30 x 6 mm, under an oblique force (N): shooting (case `rod_statics`).
const FORCE: [f64; 3] = [0.0, -30.0, 51.961_524_227_066_32];
const PULLED: [f64; 3] = [0.902_883_248_15, -0.020_849_580_45, 0.390_165_021_12];
const STIFF: Section = Section {
    axial: 1.26e7,
    stiffness: [50.823_569_19, 37.8, 945.0],
};

/// Section of the helix, by its slenderness EA L^2/EI.
const fn round(axial: f64) -> Section {
    Section {
        axial,
        stiffness: [0.75, 1.0, 1.0],
    }
}

/// How far the tip of the product's rod is from where it belongs, m.
fn product(scene: &str, elements: usize, exact: [f64; 3]) -> Outcome<f64> {
    let mut scene = json(scene)?;
    scene["bodies"][0]["elements"] = json!(elements);
    let mut product = Product::start(&scene)?;
    let mut tip = Real3::zeros();
    for k in 0..3 {
        tip[k] = product.get(&format!("rod.tip.position[{}]", k + 1))?;
    }
    Ok((tip - Real3::from(exact)).norm())
}

/// How far the tip of a rod is from where it belongs, m; the load in equal parts.
fn off(mut rod: Rod, exact: [f64; 3], parts: u32) -> Outcome<f64> {
    let solved = equilibrium(&mut rod, parts);
    solved.map_err(|part| format!("no equilibrium at part {part}"))?;
    Ok((rod.tip().r - Real3::from(exact)).norm())
}

/// The helix with some terms.
fn rolled(elements: usize, kept: Kept) -> Outcome<f64> {
    let rod = Rod::straight(1.0, elements, round(1e6), kept);
    off(rod.under(Real3::zeros(), MOMENT.into()), ROLLED, 8)
}

/// The strip with some terms.
fn pulled(elements: usize, kept: Kept) -> Outcome<f64> {
    let rod = Rod::straight(1.0, elements, STIFF, kept);
    off(rod.under(FORCE.into(), Real3::zeros()), PULLED, 4)
}

const NO_OWN_TWIST: Kept = Kept {
    own_twist: false,
    internal_twist: true,
};
const NO_INTERNAL_TWIST: Kept = Kept {
    own_twist: true,
    internal_twist: false,
};

/// What a rod does that lacks a term, off by so much with 8 and 16 elements, and the product with 16.
fn of_order([coarse, fine]: [f64; 2], found: f64) -> [Figure; 2] {
    let failing = format!(
        "order {} instead of 4: tip {} L off",
        short((coarse / fine).log2()),
        short(fine)
    );
    let product = format!("tip {} L off", short(found));
    [figure(fine, failing), figure(found, product)]
}

/// Frames that are transported along a line in space rotate about it themselves.
pub fn own_twist() -> Outcome<Row> {
    let off = [rolled(8, NO_OWN_TWIST)?, rolled(16, NO_OWN_TWIST)?];
    let [failing, product] = of_order(off, product(HELIX, 16, ROLLED)?);
    Ok(Row {
        place: "Frames carried along a line in space",
        method: "rod of the product less the twist of the carried frame itself; helix by a dead end moment, 16 elements"
            .into(),
        failing,
        product,
        test: "a_carried_frame_has_a_twist_of_its_own",
    })
}

#[test]
fn a_carried_frame_has_a_twist_of_its_own() {
    let row = own_twist().expect("a row");
    assert!(row.failing.value > 6e-4, "{}", row.failing.text);
    assert!(row.product.value < 5e-5, "{}", row.product.text);
    // With it the rod here is as good.
    let whole = rolled(16, ALL).expect("an equilibrium");
    assert!((whole / row.product.value - 1.0).abs() < 0.1, "{whole:e}");
}

/// Twist that is linear along an element.
pub fn internal_twist() -> Outcome<Row> {
    let off = [
        pulled(8, NO_INTERNAL_TWIST)?,
        pulled(16, NO_INTERNAL_TWIST)?,
    ];
    let [failing, product] = of_order(off, product(STRIP, 16, PULLED)?);
    Ok(Row {
        place: "Sections with two bending stiffnesses",
        method: "rod of the product less its internal twist; strip 30 x 6 mm under an oblique force, 16 elements".into(),
        failing,
        product,
        test: "linear_twist_is_of_order_two",
    })
}

#[test]
fn linear_twist_is_of_order_two() {
    let row = internal_twist().expect("a row");
    assert!(row.failing.value > 4e-5, "{}", row.failing.text);
    assert!(row.product.value < 1e-6, "{}", row.product.text);
    let whole = pulled(16, ALL).expect("an equilibrium");
    assert!(whole < 4e-7, "{whole:e}");
}

/// The rod of the case `free_rod`.
fn thrown(gyroscopic: bool) -> Thrown {
    let [flat, edge] = [1.6667e-9, 6.6667e-9];
    Thrown {
        length: 1.0,
        elements: 8,
        section: Section {
            axial: 1e3,
            stiffness: [2e6 * 4.58e-9, 5e6 * flat, 5e6 * edge],
        },
        inertia: [0.2, 1e3 * (flat + edge)],
        spin: Real3::new(200.0, 3.0, 5.0),
        deformation: |s| {
            [
                Real3::new(0.0, 0.5 * (PI * s).sin(), 0.3 * (2.0 * PI * s).cos()),
                Real3::new(0.0, 0.5 * (PI * s).cos(), -0.6 * (2.0 * PI * s).sin()) * PI,
            ]
        },
        gyroscopic,
    }
}

/// How long it flies, s, and in how many steps.
const FLIGHT: (f64, u32) = (0.25, 1000);

/// Spin about an axis that rotates.
pub fn spin() -> Outcome<Row> {
    let lost = thrown(false).run(FLIGHT.0, FLIGHT.1);
    let mut scene = json(FREE)?;
    scene["method"] = json!({"integrator": "auto"});
    let mut product = Product::start(&scene)?;
    let momentum = |product: &mut Product| -> Outcome<Real3> {
        let [x, y, z] = [1, 2, 3].map(|k| product.get(&format!("angular_momentum[{k}]")));
        Ok(Real3::new(x?, y?, z?))
    };
    let before = momentum(&mut product)?;
    let mut found = 0.0_f64;
    for step in 1..=25 {
        let stepped = product.step(FLIGHT.0 * f64::from(step) / 25.0);
        stepped.map_err(|error| error.to_string())?;
        found = found.max((momentum(&mut product)? - before).norm() / before.norm());
    }
    Ok(Row {
        place: "Sections that spin about a line that turns",
        method: "rod of the product less the gyroscopic force of spin; thrown with 200 rad/s about its axis, 0.25 s".into(),
        failing: figure(
            lost.momentum,
            format!(
                "energy kept to {}, angular momentum {} % off",
                short(lost.energy),
                short(100.0 * lost.momentum)
            ),
        ),
        product: figure(found, format!("angular momentum kept to {}", short(found))),
        test: "spin_without_its_force_loses_angular_momentum",
    })
}

#[test]
fn spin_without_its_force_loses_angular_momentum() {
    let row = spin().expect("a row");
    assert!(row.failing.value > 0.004, "{}", row.failing.text);
    assert!(row.product.value < 1e-7, "{}", row.product.text);
    // Shorter steps change nothing of it; with the force it is kept.
    let [coarse, fine] = [1, 2].map(|times| thrown(false).run(FLIGHT.0, times * FLIGHT.1));
    assert!((fine.momentum / coarse.momentum - 1.0).abs() < 1e-3);
    assert!(fine.energy < 1e-6, "{:e}", fine.energy);
    let whole = thrown(true).run(FLIGHT.0, FLIGHT.1);
    assert!(whole.momentum < 1e-7, "{:e}", whole.momentum);
}

/// Load steps of the helix.
const PARTS: u32 = 40;

fn with_directors(is_reduced: bool) -> Result<f64, u32> {
    let mut line = Directors::straight(1.0, 16, round(1e6), is_reduced, MOMENT.into());
    equilibrium(&mut line, PARTS)?;
    Ok((line.tip() - Real3::from(ROLLED)).norm())
}

/// Interpolated directors.
pub fn directors() -> Outcome<Row> {
    let full = with_directors(false).map_err(|part| format!("no equilibrium at part {part}"))?;
    let reduced = match with_directors(true) {
        Ok(off) => format!("tip {} L off", short(off)),
        Err(part) => format!("Newton's method fails from load step {part} of {PARTS} on"),
    };
    let found = product(HELIX, 16, ROLLED)?;
    Ok(Row {
        place: "Slender rods in space",
        method: "interpolated directors (Betsch & Steinmann), 16 linear elements, EA L^2/EI = 1e6; helix by a dead end moment"
            .into(),
        failing: figure(
            full,
            format!("locks: tip {} L off; with reduced integration {reduced}", short(full)),
        ),
        product: figure(found, format!("tip {} L off", short(found))),
        test: "directors_lock_on_slender_rods",
    })
}

#[test]
fn directors_lock_on_slender_rods() {
    let row = directors().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    assert!(row.product.value < 5e-5, "{}", row.product.text);
    assert!(with_directors(true).is_err());
    // Where they bend little, or are not slender and have many elements, they are right.
    let mut line = Directors::straight(1.0, 64, round(1e3), true, MOMENT.into());
    equilibrium(&mut line, 8).expect("an equilibrium");
    let off = (line.tip() - Real3::from(ROLLED)).norm();
    assert!(off < 6e-3, "{off:e}");
}

/// A rod or beam of one element, clamped, under a moment at its tip (N m) that follows, in equilibrium or let go.
fn alone(element: &str, moment: Value, initial: &str) -> Value {
    let mut section =
        json!({"area": 1e-4, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-9});
    if element == "beam" {
        section["shear_factors"] = json!([0.9, 0.9]);
    }
    json!({"name": "overbent", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "initial": initial,
        "bodies": [{"name": "line", "element": element, "elements": 1,
            "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1e3, "damping_time": 0.02},
            "section": section, "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.4, 0.0, 0.0]}},
            "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]}],
        "loads": [{"name": "turn", "kind": "moment", "marker": "line.tip", "follower": true, "value": moment}],
        "accuracy": {"relative_tolerance": 1e-4}})
}

/// A moment about one axis.
fn about(axis: usize, size: Value) -> Value {
    let mut moment = vec![json!(0.0); 3];
    moment[axis] = size;
    moment.into()
}

/// What the product says of an equilibrium of one element under a moment of this size, N m; nothing where it finds one.
fn refused(element: &str, axis: usize, size: f64) -> String {
    let loaded = alone(element, about(axis, json!(size)), "static_equilibrium");
    Product::start(&loaded).err().unwrap_or_default()
}

/// Rods and beams say which element it is and what to do, in equilibrium and on the way.
#[cfg(test)]
fn all_are_refused(axis: usize, size: f64) {
    for element in ["rod", "beam"] {
        let grows = about(axis, json!(format!("{}*t", 2.0 * size)));
        let mut product = Product::start(&alone(element, grows, "undeformed")).expect("a start");
        let on_the_way = product.step(1.0).expect_err("a step too far").to_string();
        for told in [refused(element, axis, size), on_the_way] {
            let is_named =
                told.contains("found more in element 1") && told.contains("take more elements");
            assert!(is_named, "{element}: {told:?}");
        }
    }
}

/// Twist beyond half a turn.
pub fn half_a_turn() -> Outcome<Row> {
    let part = 1.1;
    let torque = torque_at(part * PI) / PI;
    let told = refused("rod", 0, part * PI * 2e-3);
    Ok(Row {
        place: "Twist beyond half a turn in an element",
        method: "angle by an arc tangent, as it stands; 1.1 half turns in one element".into(),
        failing: figure(
            torque,
            format!(
                "torque of {} pi GJ/L where {part} is right: it springs back",
                short(torque)
            ),
        ),
        product: figure(f64::NAN, format!("refuses: {told}")),
        test: "twist_beyond_half_a_turn_is_refused",
    })
}

#[test]
fn twist_beyond_half_a_turn_is_refused() {
    let row = half_a_turn().expect("a row");
    assert!(row.failing.value < -0.8, "{}", row.failing.text);
    all_are_refused(0, 1.1 * PI * 2e-3);
}

/// Bending beyond a right angle in half an element.
pub fn right_angle() -> Outcome<Row> {
    let rod = Rod::straight(1.0, 1, round(1e6), ALL);
    let rod = rod.under(Real3::zeros(), Real3::z() * (2.0 * PI));
    let tip = off(rod, [0.0; 3], PARTS)?;
    let told = refused("rod", 2, 2.0 * PI * 2.5e-3);
    Ok(Row {
        place: "Bending beyond a right angle in half an element",
        method:
            "element of the product without its bound; rolled up by an end moment to a full turn"
                .into(),
        failing: figure(tip, format!("says nothing: tip {} L off", short(tip))),
        product: figure(f64::NAN, format!("refuses: {told}")),
        test: "bending_beyond_a_right_angle_is_refused",
    })
}

#[test]
fn bending_beyond_a_right_angle_is_refused() {
    let row = right_angle().expect("a row");
    assert!(row.failing.value > 0.5, "{}", row.failing.text);
    all_are_refused(2, 2.0 * PI * 2.5e-3);
}
