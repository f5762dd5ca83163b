//! `fmi2Instantiate`: from its arguments to an instance, or to the reason why there is none.

use std::path::PathBuf;

use super::lifecycle::state_name;
use super::location::{LocationError, directory};
use crate::fmi::{self, Instance, Logger, Names, open, own_place};
use crate::simulation::Simulation;

/// Names of FMI 2.0.
static NAMES: Names = Names {
    instantiate: "fmi2Instantiate",
    token: "fmuGUID",
    experiment: "fmi2SetupExperiment",
    seeds: "dvKnown",
    real: "Real",
    integer: "Integer",
    state: state_name,
};

/// Arguments of `fmi2Instantiate`.
pub struct Request<'a> {
    /// Name of the instance.
    pub name: &'a str,
    /// Whether the master asks for co-simulation.
    pub co_simulation: bool,
    /// GUID of the model description that the master has read.
    pub guid: &'a str,
    /// URI of the directory `resources`, or nothing in it: that beside this library; none where a saved state will bring the scene.
    pub location: Option<&'a str>,
}

/// Why an instance could not be made.
#[derive(Debug, thiserror::Error)]
enum NoInstance {
    /// Model exchange.
    #[error("fmuType: expected fmi2CoSimulation, the only kind that this unit offers")]
    Kind,
    /// A bad resource location.
    #[error(transparent)]
    Location(#[from] LocationError),
    /// Refusal that any version of FMI shares.
    #[error(transparent)]
    Shared(#[from] fmi::NoSimulation),
}

/// The instance that is asked for. A refusal is logged even when logging is off.
pub fn instantiate(request: &Request<'_>, logger: Logger) -> Option<Instance> {
    Instance::instantiate(&NAMES, request.guid, logger, || simulation(request))
}

/// The simulation of the unit; nothing where a saved state will bring the scene.
fn simulation(request: &Request<'_>) -> Result<Option<Simulation>, NoInstance> {
    if request.name.trim().is_empty() {
        return Err(fmi::NoSimulation::Missing("instanceName").into());
    }
    if !request.co_simulation {
        return Err(NoInstance::Kind);
    }
    if request.guid.is_empty() {
        return Err(fmi::NoSimulation::Missing(NAMES.token).into());
    }
    let Some(location) = request.location else {
        return Ok(None);
    };
    let folder = match location.trim() {
        "" => beside()?,
        _ => directory(location)?,
    };
    Ok(Some(open(&folder, &NAMES, request.guid)?))
}

/// The directory `resources` of the unit that this library is in: `binaries/<platform>/<library>` beside it.
fn beside() -> Result<PathBuf, LocationError> {
    let library = own_place();
    let root = library.as_deref().and_then(|file| file.ancestors().nth(3));
    let root = root.ok_or_else(|| LocationError::Scheme(String::new()))?;
    Ok(root.join("resources"))
}
