//! From the error wanted to meshes and a tolerance: the default experiment is run with one mesh and with one of twice as
//! many elements, at one tolerance and at a tenth of it, until what doubling changes is below the error. Everything is
//! compared by counts, never by clocks, so that the same scene gives the same plan. Units that run hold nothing of this:
//! a planned scene is a scene with plain numbers.

mod account;
mod belief;
mod courses;
mod damping;
mod divisions;
mod experiment;
mod given;
mod ladder;
mod modal;
mod motion;
mod outputs;
mod report;
mod response;
mod search;
mod settled;
mod shear;
mod space;
mod start;
mod time;

pub use courses::courses;
pub use damping::Damped;
pub(super) use damping::damp;
pub use given::TrialConditions;
pub use outputs::RelativeTo;
pub use report::{Plan, PlannedBody, PlannedOutput, Price, Settled, Settles};

use crate::scene::{Chosen, Error, Scene};
use search::Search;
use shear::Beam;

/// Progress report of a run: number of the run, elements of all cables, tolerance.
pub type Progress<'a> = &'a mut dyn FnMut(usize, u32, f64);

/// Limit of the effort of planning.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    /// Time, s: runs are counted by their work, so that the same scene gives the same plan.
    pub seconds: f64,
    /// Whether the time is over: ends what counts do not see.
    pub is_over: &'a dyn Fn() -> bool,
}

impl Default for Budget<'_> {
    fn default() -> Self {
        Self {
            seconds: 60.0,
            is_over: &|| false,
        }
    }
}

impl Budget<'_> {
    /// The work of all runs (operations times parts), of a fuzzer little.
    fn work(&self) -> f64 {
        if cfg!(fuzzing) {
            1e5
        } else {
            WORK * self.seconds
        }
    }
}

/// Work in a second of the budget: a part of what a processor of 2024 does, which leaves time for what is not counted.
const WORK: f64 = 1.5e6;

/// Findings of planning, with reasons.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planned {
    /// Elements that were chosen, of bodies of `"element": "auto"`.
    pub elements: Vec<Chosen>,
    /// Damping times that were made of damping ratios.
    pub damping: Vec<Damped>,
    /// Numbers of elements and a tolerance; nothing where none are left to the planner.
    pub numbers: Option<Plan>,
}

/// A scene with damping times, elements, numbers of them and a tolerance, and where they come from; as it is where nothing is left to the
/// planner.
///
/// # Errors
/// A body with a damping ratio that has no mode; a name in `accuracy` that the scene does not have; a start that does not exist; an experiment that cannot be run with any mesh.
pub fn plan(
    scene: &Scene,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<(Scene, Planned), Error> {
    plan_for(scene, &TrialConditions::default(), budget, progress)
}

/// Plans with given parameters and inputs, as a run will have them. The planned scene keeps its own values.
///
/// # Errors
/// As [`plan`]; what is given is not what the scene has, or is a number of elements or the tolerance.
pub fn plan_for(
    scene: &Scene,
    given: &TrialConditions,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<(Scene, Planned), Error> {
    let (scene, damping) = damp(scene)?;
    let mut elements = scene.choose_elements()?;
    let plain = scene.with_elements(&elements);
    if !plain.is_to_be_planned() {
        let planned = Planned {
            elements,
            damping,
            numbers: None,
        };
        return Ok((plain, planned));
    }
    given.check(&plain)?;
    start::check_start(&plain, given)?;
    let beams = Beam::all(&plain, &elements)?;
    let mut search = Search::new(&plain, given, beams, budget, &mut *progress)?;
    let (mut planned, mut plan, sheared) = search.find()?;
    for of in sheared {
        of.judge(&mut elements, plan.error, scene.dimension);
    }
    // What shears takes a mesh of its own.
    let sheared = scene.with_elements(&elements);
    if sheared != plain {
        let (runs, work) = (search.runs.len(), search.work);
        let mut search = Search::new(&sheared, given, Vec::new(), budget, progress)?;
        (planned, plan, _) = search.find()?;
        plan.runs += runs;
        plan.runs_cost *= 1.0 + work / search.work.max(f64::MIN_POSITIVE);
    }
    let numbers = Some(plan);
    let account = Planned {
        elements,
        damping,
        numbers,
    };
    Ok((planned, account))
}
