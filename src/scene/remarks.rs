//! Values that are allowed and told before anything is planned or run: likely slips of units, and modes that are left out.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::resolved::{BodyReference, Place, Resolved, ResolvedMarker};
use super::{Action, Body, FileBody, LineBody, RigidBody, Scene, Section, SectionNumbers};
use crate::math::function::Function;
use crate::system::Signal;

/// Young's modulus below which hardly any solid is, Pa.
const SOFTEST: f64 = 1e6;
/// Shear modulus of such a solid whose volume does not change, Pa.
const SOFTEST_IN_SHEAR: f64 = SOFTEST / 3.0;
/// Density below which hardly any solid is, kg/m^3.
const LIGHTEST: f64 = 10.0;
/// Lengths between which those of most bodies are, m.
const LENGTHS: [f64; 2] = [1e-3, 1e3];
/// First frequency above which hardly any body is, Hz.
const FASTEST: f64 = 1e6;

/// Lists probable mistakes of units in a scene, and reduced bodies with fewer modes or second-order displacements than they need, in words,
/// with their places. Each kind of mistake is listed once, whatever the number of bodies.
pub fn remarks(scene: &Scene) -> Vec<String> {
    let kinds: [fn(&Body) -> Option<String>; 5] =
        [softness, lightness, length, frequency, left_out];
    let mut found: Vec<String> = (kinds.iter())
        .filter_map(|slip| told(scene.bodies.iter().map(slip)))
        .collect();
    if scene.dimension == 3 {
        found.extend(told(scene.bodies.iter().map(eccentric)));
    }
    // What follows from names is asked of scenes alone that have such bodies.
    let of_names = |body: &Body| body.reduced().is_some() || body.patch().is_some();
    if scene.bodies.iter().any(of_names)
        && let Ok(resolved) = scene.resolve()
    {
        found.extend(unpaired(&resolved));
        found.extend(bare_point(&resolved));
    }
    found
}

/// What is found of bodies in words, as one sentence about the first one.
fn told(found: impl Iterator<Item = Option<String>>) -> Option<String> {
    let mut found = found
        .enumerate()
        .filter_map(|(index, words)| Some((index, words?)));
    let (index, words) = found.next()?;
    let others = match found.count() {
        0 => String::new(),
        1 => "; so is one more body".into(),
        count => format!("; so are {count} more bodies"),
    };
    Some(format!("bodies[{index}]{words}{others}"))
}

/// Reduced bodies whose files lack second-order displacements that they need.
fn unpaired(resolved: &Resolved<'_>) -> Option<String> {
    told(resolved.bodies.iter().map(|body| match body {
        BodyReference::Reduced(reduced) if resolved.lacks_pairs(*reduced) => {
            Some(without_pairs(reduced.body))
        }
        _ => None,
    }))
}

/// What a reduced body lacks whose file has too few pairs of modes.
fn without_pairs(body: &FileBody) -> String {
    let (model, name) = (&body.contained().model, &body.name);
    let found = match model.paired {
        0 => "no second-order displacements".into(),
        paired => format!(
            "second-order displacements of pairs of the first {paired} of {} modes only",
            model.modes()
        ),
    };
    format!(
        ".file: found {found}, where the modes of {name:?} combine others: it lacks stiffening by rotation and shortening by bending (`flexbody.reduce` makes all pairs of up to \
         40 modes from the quadratic force)"
    )
}

/// A rod whose sections twist about their shear centre apart from the line, which needs shear.
fn eccentric(body: &Body) -> Option<String> {
    let Body::Rod(rod) = body else {
        return None;
    };
    let mut sections = rod.all_sections().map(Section::numbers);
    let numbers = sections.find(SectionNumbers::is_eccentric)?;
    let [y, z] = numbers.shear_center();
    Some(format!(
        ".section: found a shear centre at [{y:.3e}, {z:.3e}] m from the centroid of {:?}, which a rod does not have: forces through the centroid do not twist it (expected \"beam\", \
         which has it, or a section whose shear centre is its centroid)",
        rod.name
    ))
}

/// A solid that is hardly stiff.
fn softness(body: &Body) -> Option<String> {
    let material = &body.flexible()?.material;
    let moduli = [
        ("youngs_modulus", material.youngs_modulus, SOFTEST),
        ("shear_modulus", material.shear_modulus, SOFTEST_IN_SHEAR),
    ];
    moduli.into_iter().find_map(|(key, found, softest)| {
        let found = found.filter(|found| *found < softest)?;
        Some(format!(
            ".material.{key}: found {found:e} Pa, softer than any common solid (expected {softest:.1e} Pa or more): is it in Pa?"
        ))
    })
}

/// A solid that weighs hardly anything.
fn lightness(body: &Body) -> Option<String> {
    let (place, found) = match (body.cable(), body.rigid()) {
        (Some(cable), _) => (".material.density", cable.material.density),
        (_, Some(rigid)) => (".density", rigid.density),
        _ => return None,
    };
    let found = found.filter(|found| *found < LIGHTEST)?;
    Some(format!(
        "{place}: found {found} kg/m^3, lighter than any common solid (expected {LIGHTEST} kg/m^3 or more): is it in kg/m^3?"
    ))
}

/// A body that is hardly as long, or as short.
fn length(body: &Body) -> Option<String> {
    let (shape, markers) = match (body.cable(), body.rigid()) {
        (Some(cable), _) => (Some(cable.shape.length()), None),
        (_, Some(rigid)) => (extent(rigid), reach(rigid)),
        _ => return None,
    };
    let [shortest, longest] = LENGTHS;
    let is_told = |found: &f64| *found > 0.0 && !(shortest..=longest).contains(found);
    // Markers may lie as close together as they like.
    let far = markers.filter(|found| *found > longest);
    let (place, found) = match (shape.filter(is_told), far) {
        (Some(found), _) => (".shape", found),
        (None, Some(found)) => (".markers", found),
        (None, None) => return None,
    };
    Some(format!(
        "{place}: found a length of {found} m (expected {shortest} m to {longest} m): is it in m?"
    ))
}

/// The largest length of a rigid body's shape, m.
fn extent(body: &RigidBody) -> Option<f64> {
    let mut shape = body.shape?;
    let lengths = shape.lengths().into_iter();
    let lengths = lengths.map(|(key, _, length)| match key {
        "radius" => 2.0 * *length,
        _ => *length,
    });
    lengths.reduce(f64::max)
}

/// The largest distance of a rigid body's markers from its centre of mass, m.
fn reach(body: &RigidBody) -> Option<f64> {
    let markers = body.markers.values().map(|marker| {
        let [x, y, z] = marker.full();
        x.hypot(y).hypot(z)
    });
    markers.reduce(f64::max)
}

/// A reduced body with fewer modes than its file has. Static shapes, which make joints as compliant as they are, are among the stiffest
/// modes of the free body.
fn left_out(body: &Body) -> Option<String> {
    let Body::Reduced(reduced) = body else {
        return None;
    };
    let (taken, all) = (reduced.first_modes(), reduced.contained().model.modes());
    (0 < taken && taken < all).then(|| {
        format!(
            ".modes: found {taken} of {all} modes, which leaves out the compliance of the others at interfaces: joints there are too stiff (`{{\"fixed_interface\": a number}}` keeps \
             static shapes)"
        )
    })
}

/// A point of a plate or shell without a pad that something holds or loads in the surface: there displacements have no limit.
fn bare_point(resolved: &Resolved<'_>) -> Option<String> {
    let joints = resolved
        .joints
        .iter()
        .filter(|joint| joint.holds_position());
    let joints =
        joints.flat_map(|joint| joint.ends.markers().into_iter().map(|of| (joint.name, of)));
    let loads = resolved.loads.iter().flat_map(|load| {
        let markers = load.kind.markers().into_iter();
        let markers = markers.filter(|of| {
            let action = load.kind.action();
            action.is_none_or(|action| action.kind.is_force() && is_in_surface(action, of))
        });
        markers.map(|of| (load.name, of))
    });
    let mut all = joints.chain(loads);
    let (by, body, marker) = all.find_map(|(name, of)| match of.place {
        Place::Patch(plate, index) if plate.body.marker_at(index).pad() == [0.0; 2] => {
            Some((name, plate, plate.body.markers.keys().nth(index)?))
        }
        _ => None,
    })?;
    Some(format!(
        "bodies[{}].markers.{marker}: {by} acts on it in the surface, at a point: its displacement there grows as meshes get finer (expected a pad, `{{\"at\": [s1, s2], \"pad\": [length, length]}}`)",
        body.id.index()
    ))
}

/// Whether a force at a marker has a part in the surface of its plate or shell; one that changes in time is taken to have one.
fn is_in_surface(action: &Action<'_>, marker: &ResolvedMarker<'_>) -> bool {
    let Place::Patch(plate, index) = marker.place else {
        return false;
    };
    let [first, second, _] = plate.axes(index);
    let constant = |of: &Signal| match of {
        Signal::Function(Function::Constant(value)) => Some(*value),
        _ => None,
    };
    let force: Option<Vec<f64>> = action.components.iter().map(constant).collect();
    let Some(force) = force.filter(|force| force.len() == 3) else {
        return true;
    };
    if action.follower {
        return force[0] != 0.0 || force[1] != 0.0;
    }
    let force = Vector3::from_column_slice(&force);
    let part = force.dot(&first).hypot(force.dot(&second));
    part > 1e-9 * force.norm()
}

/// A body that vibrates hardly as fast.
fn frequency(body: &Body) -> Option<String> {
    let found = first_frequency(body.flexible()?).filter(|found| *found > FASTEST)?;
    Some(format!(
        ": found a first natural frequency of about {found:.1e} Hz (expected {FASTEST:e} Hz or less): are material, section and shape \
         in Pa, kg/m^3 and m?"
    ))
}

/// The lower one of the first frequencies of bending between two hinges and of stretching between free ends, Hz: `pi / (2 L^2)
/// sqrt(E I / m)` and `1 / (2 L) sqrt(E A / m)`, `m` the mass per length (S. P. Timoshenko, Vibration Problems in Engineering,
/// 3rd ed., sections 49 and 55).
fn first_frequency(body: &LineBody) -> Option<f64> {
    let (length, middle) = (body.shape.length(), body.section_at(0.5));
    let speed = |stiffness: f64| (stiffness / body.line_density_of(&middle)).sqrt();
    let stretching = speed(body.axial_stiffness_of(&middle)) / (2.0 * length);
    let bending = 0.5 * PI * speed(body.bending_stiffness_of(&middle)) / (length * length);
    let modes = [stretching, bending].into_iter();
    let modes = modes.filter(|found| *found > 0.0 && found.is_finite());
    modes.reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A steel rod of 1 m and 10 mm, and a sphere of 100 mm.
    const SCENE: &str = r#"{ "name": "units", "dimension": 3, "bodies": [
        { "name": "rod", "element": "rod", "elements": 2,
          "material": { "youngs_modulus": 2.1e11, "shear_modulus": 8.1e10, "density": 7850.0 },
          "section": { "shape": { "circle": { "radius": 5.0e-3 } } },
          "shape": { "line": { "from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0] } } },
        { "name": "ball", "element": "rigid", "shape": { "sphere": { "radius": 0.05 } }, "density": 2700.0,
          "position": [5.0, 0.0, 0.0], "markers": { "c": [0.0, 0.0, 0.0] } }] }"#;

    fn found(changes: &[(&str, &str)]) -> Vec<String> {
        let text = changes
            .iter()
            .fold(SCENE.to_owned(), |text, (old, new)| text.replace(old, new));
        remarks(&Scene::from_json(&text).expect("a valid scene"))
    }

    #[test]
    fn usual_numbers_get_no_remark() {
        assert_eq!(found(&[]), Vec::<String>::new());
    }

    #[test]
    fn every_slip_gets_one_remark_with_its_place_and_its_value() {
        for (old, new, place, told) in [
            (
                "2.1e11",
                "210",
                "bodies[0].material.youngs_modulus",
                "2.1e2 Pa",
            ),
            (
                "8.1e10",
                "81",
                "bodies[0].material.shear_modulus",
                "8.1e1 Pa",
            ),
            (
                "7850.0",
                "7.85",
                "bodies[0].material.density",
                "7.85 kg/m^3",
            ),
            ("2700.0", "2.7", "bodies[1].density", "2.7 kg/m^3"),
            (
                "[1.0, 0.0, 0.0]",
                "[1200.0, 0.0, 0.0]",
                "bodies[0].shape",
                "1200 m",
            ),
            (
                "\"radius\": 0.05",
                "\"radius\": 0.0004",
                "bodies[1].shape",
                "0.0008 m",
            ),
            (
                "\"c\": [0.0,",
                "\"c\": [1500.0,",
                "bodies[1].markers",
                "1500 m",
            ),
        ] {
            let told_of = found(&[(old, new)]);
            assert_eq!(told_of.len(), 1, "{told_of:?}");
            assert!(told_of[0].starts_with(place), "{told_of:?}");
            assert!(told_of[0].contains(told), "{told_of:?}");
        }
    }

    #[test]
    fn slips_of_one_kind_are_told_together() {
        let told = found(&[("7850.0", "7.85"), ("2700.0", "2.7")]);
        assert_eq!(told.len(), 1);
        assert!(told[0].ends_with("so is one more body"), "{told:?}");
    }

    /// The first bending frequency of a round rod of radius r is `pi c r / (4 L^2)`: with 5172 m/s, 5 mm and 1 m it is
    /// 20.3 Hz.
    #[test]
    fn the_first_frequency_is_that_of_bending_between_hinges() {
        let scene = Scene::from_json(SCENE).expect("a valid scene");
        let body = scene.bodies[0].flexible().expect("a rod");
        let wanted = PI * (2.1e11_f64 / 7850.0).sqrt() * 5e-3 / 4.0;
        let off = first_frequency(body).expect("a frequency") / wanted - 1.0;
        assert!(off.abs() < 1e-12, "{off}");
        // A thousand times as stiff in each of 10 mm: beyond a megahertz.
        let told = found(&[
            ("[1.0, 0.0, 0.0]", "[0.01, 0.0, 0.0]"),
            ("2.1e11", "2.1e15"),
        ]);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("bodies[0]: found a first natural frequency"));
    }
}
