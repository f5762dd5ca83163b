//! From the error wanted to meshes and a tolerance: the default experiment is run with one mesh and with one of twice as
//! many elements, at one tolerance and at a tenth of it, until what doubling changes is below the error. Everything is
//! compared by counts, never by clocks, so that the same scene gives the same plan. Units that run hold nothing of this:
//! a planned scene is a scene with plain numbers.

mod account;
mod experiment;
mod ladder;
mod outputs;
mod report;
mod search;
mod settled;
mod time;

pub use experiment::courses;
pub use report::{Plan, PlannedBody, PlannedOutput, Price, Settled, Settles};

use crate::scene::{Error, Scene};
use search::Search;

/// What is under way, for a person who waits: the number of the run, elements of all cables, tolerance.
pub type Progress<'a> = &'a mut dyn FnMut(usize, u32, f64);

/// A scene with numbers of elements and a tolerance, and where they come from; as it is and without a plan where nothing
/// is left to the planner.
///
/// # Errors
/// A name in `accuracy` that the scene does not have; an experiment that cannot be run with any mesh.
pub fn plan(scene: &Scene, progress: Progress<'_>) -> Result<(Scene, Option<Plan>), Error> {
    if !scene.is_to_be_planned() {
        return Ok((scene.clone(), None));
    }
    let (scene, plan) = Search::new(scene, progress)?.find()?;
    Ok((scene, Some(plan)))
}
