//! The start of a scene, tried with coarse meshes before anything is planned: what no mesh mends is told at once.

use super::divisions::open_divisions;
use super::given::TrialConditions;
use super::search::{cables, fewest, open_reduced, with_counts};
use crate::scene::{Accuracy, Error, MOST_DIVISIONS, Scene};
use crate::simulation::{Error as Reason, InputTable, Simulation};

/// How many times as fine as the coarsest a mesh is tried where the mesh is hardly the reason.
const FINER: u32 = 4;
/// Elements of all cables up to which finer meshes are tried where the mesh may be the reason; at least [`FINER`] times the
/// coarsest mesh.
const ELEMENTS: u32 = 64;
/// Tolerance of the tries. The start does not depend on it.
const TOLERANCE: f64 = 1e-4;

/// Finds out whether a scene that leaves numbers to the planner has a start with its coarsest mesh, or with one some times finer.
///
/// # Errors
/// The reason why it has none.
pub(super) fn check_start(scene: &Scene, given: &TrialConditions) -> Result<(), Error> {
    let coarsest = fewest(scene)?;
    let is_free: Vec<bool> = cables(scene)
        .map(|(_, cable)| cable.elements.is_none() && cable.model.has_elements())
        .chain(open_reduced(scene).map(|_| false))
        .chain(open_divisions(scene).map(|_| true))
        .collect();
    let most = ELEMENTS.max(FINER * coarsest.iter().sum::<u32>());
    let moved = given.moved(scene)?;
    let mut finer = 1;
    loop {
        let divided = cables(scene).count() + open_reduced(scene).count();
        let elements: Vec<u32> = (coarsest.iter().zip(&is_free).enumerate())
            .map(|(place, (count, is_free))| match place < divided {
                _ if !is_free => *count,
                true => finer * count,
                // As often doubled as there may be.
                false => {
                    let doubled = (0..=finer.ilog2()).rev().map(|power| count << power);
                    let mut doubled = doubled.filter(|count| *count <= MOST_DIVISIONS);
                    doubled.next().unwrap_or(*count)
                }
            })
            .collect();
        let Err(reason) = tried(scene, &elements, given, moved.as_ref()) else {
            return Ok(());
        };
        let may_be_the_mesh = matches!(
            reason,
            Reason::Equilibrium(_) | Reason::ElementOverDeformed(_)
        );
        let is_last = !is_free.contains(&true)
            || 2 * elements.iter().sum::<u32>() > most
            || finer >= FINER && !may_be_the_mesh;
        if is_last {
            return Err(with_mesh(reason, &elements, finer));
        }
        finer *= 2;
    }
}

/// Tries to find the start of a scene with these numbers of elements.
fn tried(
    scene: &Scene,
    elements: &[u32],
    given: &TrialConditions,
    moved: Option<&InputTable>,
) -> Result<(), Reason> {
    // Spectra are outputs, and ask for finer meshes.
    let mut scene = with_counts(scene.clone().without_outputs(), elements);
    scene.accuracy = Accuracy {
        relative_tolerance: Some(TOLERANCE),
        ..Accuracy::default()
    };
    let mut simulation = Simulation::new(scene);
    given.set(&mut simulation)?;
    let refused = |error: String| Reason::Scene(Error::new("accuracy.input_profiles", error));
    if let Some(moved) = moved {
        let signals = moved.signals(simulation.variables());
        let signals = signals.map_err(|error| refused(error.to_string()))?;
        let set = simulation.set_inputs(&signals);
        set.map_err(|error| refused(error.to_string()))?;
    }
    simulation.initialize(0.0)
}

/// A reason as an error of the scene, with the meshes that were tried.
fn with_mesh(reason: Reason, elements: &[u32], finer: u32) -> Error {
    let mut error = match reason {
        Reason::Scene(error) => error,
        other => {
            let words = other.to_string();
            let (path, message) = words.split_once(": ").unwrap_or(("scene", &words));
            Error::new(path, message)
        }
    };
    if finer > 1 {
        let count: u32 = elements.iter().sum();
        error.message += &format!(" (with {count} elements, and with fewer)");
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{Budget, plan};
    use std::fs;
    use std::path::Path;

    /// A cable of one metre that is held at both ends, and what else is said.
    fn cable(far: f64, rest: &str) -> Scene {
        let text = format!(
            r#"{{ "name": "start", "dimension": 2, "gravity": [0.0, -9.81], "initial": "static_equilibrium", "bodies": [
                {{ "name": "cable", "element": "cable",
                  "material": {{ "youngs_modulus": 1.0e10, "density": 5000.0 }},
                  "section": {{ "area": 1.0e-4, "second_moment": 1.0e-9 }},
                  "shape": {{ "line": {{ "from": [0.0, 0.0], "to": [1.0, 0.0] }} }},
                  "markers": {{ "a": 0.0, "b": 1.0 }} }},
                {{ "name": "link", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [0.5, 1.0],
                  "markers": {{ "a": [-0.5, 0.0], "b": [0.5, 0.0] }} }}],
              "joints": [
                {{ "name": "first", "kind": "revolute", "markers": ["ground", "cable.a"] }},
                {{ "name": "one", "kind": "revolute", "markers": ["ground", "link.a"], "point": [0.0, 1.0] }}
                {rest} ],
              "outputs": [{{ "kind": "position", "marker": "cable.b" }}],
              "experiment": {{ "stop_time": 1.0, "step": 0.1 }} }}"#
        );
        let text = text.replace("FAR", &format!("{far:?}"));
        Scene::from_json(&text).expect("a valid scene")
    }

    const HELD: &str = r#", { "name": "last", "kind": "revolute", "markers": ["ground", "cable.b"], "point": [1.0, 0.0] },
        { "name": "other", "kind": "revolute", "markers": ["ground", "link.b"], "point": [FAR, 1.0] }"#;

    /// A rigid link of one metre does not reach over two, whatever the mesh of a cable beside it.
    #[test]
    fn bodies_that_do_not_fit_are_told_before_any_run() {
        assert_eq!(
            check_start(&cable(1.0, HELD), &TrialConditions::default()),
            Ok(())
        );
        let scene = cable(2.0, HELD);
        let mut runs = 0;
        let found = plan(&scene, &Budget::default(), &mut |_, _, _| runs += 1);
        let error = found.expect_err("a start").to_string();
        assert_eq!(runs, 0);
        assert!(
            error.starts_with("joints: expected bodies that fit together"),
            "{error}"
        );
        assert!(error.contains("joint `o"), "{error}");
    }

    #[test]
    fn ready_scenes_have_a_start() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        for entry in fs::read_dir(&folder).expect("ready scenes") {
            let path = entry.expect("a file").path();
            let name = path.to_string_lossy();
            if !name.ends_with(".json") || name.ends_with(".schema.json") {
                continue;
            }
            let text = fs::read_to_string(&path).expect("a text");
            let read = Scene::from_json_with(&text, &crate::scene::beside(&folder));
            let scene = read.expect("a valid scene");
            if scene.is_to_be_planned() {
                assert_eq!(
                    check_start(&scene, &TrialConditions::default()),
                    Ok(()),
                    "{}",
                    path.display()
                );
            }
        }
    }
}
