//! From the damping ratio of a body's first mode to a Kelvin-Voigt time. The scene swings without dampers about its start; the first mode
//! in which at least half of the energy is strain of the body is meant. With its displacements `w`, of unit mass, and the stiffness `K_e` of
//! the body alone, Kelvin-Voigt damping takes `tau w^T K_e w` there, which is to be `2 zeta omega`.
//!
//! Source: R. W. Clough, J. Penzien, Dynamics of Structures, 3rd ed. (2003), section 12-4 (damping in modal coordinates; in proportion to
//! stiffness).

use super::search::{counted, fewest};
use crate::scene::{Accuracy, Error, Scene};
use crate::simulation::dimension::AnyEngine;
use crate::simulation::inputs::Inputs;
use crate::simulation::variables::{start_inputs, variables};

/// Elements that a body whose number is still open has at least: they miss a first frequency by less than 1e-5.
const ELEMENTS: u32 = 16;
/// Part of the energy of a mode that is strain of the body, but for roundoff.
const SHARE: f64 = 0.5 - 1e-9;
/// Modes that are looked at first, how many times as many next, and at most.
const FIRST: usize = 12;
const TIMES: usize = 4;
const MOST: usize = 768;

/// A damping ratio that became a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Damped {
    /// The body.
    pub name: String,
    /// Damping ratio of the mode.
    pub ratio: f64,
    /// Angular frequency without damping, rad/s.
    pub frequency: f64,
    /// Part of its energy that is strain of the body.
    pub share: f64,
    /// Kelvin-Voigt damping time of the body, s.
    pub time: f64,
}

/// A mode as a body sees it: its frequency (rad/s) and `w^T K_e w` (1/s^2).
type ModeOfBody = (f64, f64);

/// The scene with the damping times that its damping ratios make, and where they come from.
///
/// # Errors
/// What is not valid, no start, and no mode that is a body's.
pub(in crate::simulation) fn damp(scene: &Scene) -> Result<(Scene, Vec<Damped>), Error> {
    let (mut damped, mut asked) = (scene.clone(), Vec::new());
    for (index, body) in damped.bodies.iter_mut().enumerate() {
        let ratio = body
            .cable_mut()
            .and_then(|of| of.material.damping_ratio.take());
        asked.extend(
            ratio
                .filter(|ratio| *ratio > 0.0)
                .map(|ratio| (index, ratio)),
        );
    }
    if asked.is_empty() {
        return Ok((damped, Vec::new()));
    }
    let open: Vec<usize> = asked.iter().map(|(index, _)| *index).collect();
    let mut account = Vec::new();
    for ((index, ratio), (frequency, stiffness)) in asked.into_iter().zip(modes_of(&damped, &open)?)
    {
        let time = 2.0 * ratio * frequency / stiffness;
        let body = &mut damped.bodies[index];
        if let Some(line) = body.cable_mut() {
            line.material.damping_time = time;
        }
        account.push(Damped {
            name: body.name().to_owned(),
            ratio,
            frequency,
            share: stiffness / (frequency * frequency),
            time,
        });
    }
    Ok((damped, account))
}

/// The scene as it swings: with meshes where they are open, and with nothing that is read.
fn swinging(scene: &Scene) -> Result<Scene, Error> {
    let mut scene = scene.clone().plain().without_outputs();
    let fewest = fewest(&scene)?;
    // Stiffeners have the number of their lines.
    let open = &fewest[counted(&scene).count()..];
    let open: Vec<u32> = { open.iter() }
        .map(|least| least * ELEMENTS.div_ceil(*least))
        .collect();
    scene.divide(open);
    let lines = scene.bodies.iter_mut().filter_map(|body| body.cable_mut());
    for (line, fewest) in lines.zip(fewest) {
        line.elements.get_or_insert(fewest.max(ELEMENTS));
    }
    scene.accuracy = Accuracy {
        relative_tolerance: Some(scene.relative_tolerance()),
        ..Accuracy::default()
    };
    Ok(scene)
}

/// The first mode of every one of these bodies.
fn modes_of(scene: &Scene, open: &[usize]) -> Result<Vec<ModeOfBody>, Error> {
    let scene = swinging(scene)?;
    let place = |index: usize| format!("bodies[{index}].material.damping_ratio");
    let refused = |told: String| {
        let message =
            format!("expected modes about the start, found none ({told}); write `damping_time`");
        Error::new(place(open[0]), message)
    };
    let variables = variables(&scene);
    let inputs = Inputs::at_rest(start_inputs(&variables));
    let engine = |scene: &Scene| {
        let resolved = scene.resolve()?;
        AnyEngine::new(&resolved, &variables).map_err(|error| refused(error.to_string()))
    };
    let mut still = engine(&scene)?;
    let (state, _) =
        (still.initial_state(0.0, &inputs)).map_err(|error| refused(error.to_string()))?;
    // With a time of 1 s a body is damped by its stiffness.
    let damped = open.iter().map(|index| {
        let mut scene = scene.clone();
        if let Some(line) = scene.bodies[*index].cable_mut() {
            line.material.damping_time = 1.0;
        }
        engine(&scene)
    });
    let mut damped = damped.collect::<Result<Vec<_>, Error>>()?;
    let mut count = FIRST;
    loop {
        let modes = still
            .modes(&state, &inputs.values, count)
            .map_err(refused)?;
        let (ways, squares): (Vec<_>, Vec<_>) = modes
            .into_iter()
            .map(|mode| (mode.way, mode.square))
            .unzip();
        let others = still.damping_along(&state, &inputs.values, &ways);
        let found: Vec<Option<ModeOfBody>> = damped
            .iter_mut()
            .map(|engine| {
                let whole = engine.damping_along(&state, &inputs.values, &ways);
                let own = whole
                    .iter()
                    .zip(&others)
                    .map(|(whole, other)| whole - other);
                let mut modes = squares.iter().zip(own);
                let is_its =
                    |(square, own): &(&f64, f64)| **square > 0.0 && *own >= SHARE * **square;
                modes.find(is_its).map(|(square, own)| (square.sqrt(), own))
            })
            .collect();
        let missing = found.iter().position(Option::is_none);
        let Some(missing) = missing else {
            return Ok(found.into_iter().flatten().collect());
        };
        if squares.len() < count || count >= MOST {
            let name = scene.bodies[open[missing]].name();
            let message = format!(
                "expected a mode in which at least half of the energy is strain of \"{name}\", found none among the {} lowest; \
                 write `damping_time`",
                squares.len()
            );
            return Err(Error::new(place(open[missing]), message));
        }
        count *= TIMES;
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn scene(changes: &Value) -> Value {
        let mut body = json!({"name": "rod", "element": "cable", "elements": 4,
            "material": {"youngs_modulus": 2e9, "density": 1200.0, "damping_ratio": 0.02},
            "section": {"area": 1e-3, "second_moment": 1e-8},
            "shape": {"line": {"from": [0.0, 0.0], "to": [2.0, 0.0]}}, "markers": {"a": 0.0, "e": 1.0}});
        for (key, value) in changes.as_object().into_iter().flatten() {
            body[key] = value.clone();
        }
        json!({"name": "damped", "dimension": 2, "bodies": [body],
            "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.a"]}],
            "inputs": [{"kind": "force", "marker": "rod.e", "start": [0.0, 0.1]}]})
    }

    fn damped(scene: &Value) -> Result<(Scene, Vec<Damped>), Error> {
        damp(&Scene::from_json(&scene.to_string())?)
    }

    #[test]
    fn what_nothing_strains_has_no_ratio() {
        let told = damped(&scene(&json!({"model": "rigid"})))
            .expect_err("nothing strains it")
            .to_string();
        assert!(
            told.starts_with(
                "bodies[0].material.damping_ratio: expected a mode in which at least half"
            ) && told.ends_with("write `damping_time`"),
            "{told}"
        );
    }

    /// Modes that gravity and a tight string alone hold are passed over.
    #[test]
    fn a_hanging_rope_is_damped_where_it_stretches() {
        let mut scene = scene(&json!({"section": {"area": 1e-3, "second_moment": 0.0},
            "shape": {"line": {"from": [0.0, 0.0], "to": [0.0, -2.0]}}, "elements": 8}));
        scene["gravity"] = json!([0.0, -9.81]);
        scene["initial"] = json!("static_equilibrium");
        let (_, account) = damped(&scene).expect("a mode");
        // The bar that is clamped at one end: pi c / (2 L).
        let exact = std::f64::consts::FRAC_PI_4 * (2e9_f64 / 1200.0).sqrt();
        assert!(
            (account[0].frequency / exact - 1.0).abs() < 1e-4,
            "{account:?}"
        );
        assert!(
            (account[0].time * exact / 0.04 - 1.0).abs() < 1e-4,
            "{account:?}"
        );
    }

    /// The mesh of a body whose number of elements is open is fine enough, and none without damping needs no modes.
    #[test]
    fn open_meshes_and_zero_are_taken() {
        let [given, open] = [json!({}), json!({"elements": "auto"})]
            .map(|changes| damped(&scene(&changes)).expect("a mode").1[0].frequency);
        assert!((given / open - 1.0).abs() < 1e-4, "{given} {open}");
        let mut none = scene(&json!({"model": "rigid"}));
        none["bodies"][0]["material"]["damping_ratio"] = json!(0.0);
        let (scene, account) = damped(&none).expect("no damping");
        assert!(account.is_empty() && !scene.has_ratios());
    }
}
