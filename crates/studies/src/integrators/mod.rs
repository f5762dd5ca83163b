//! Integrators that the product's are compared with: one file a method, all of them methods of the
//! library's trait, so that one that wins moves over as it is.
//!
//! | name | method |
//! |---|---|
//! | `verlet` | velocity Verlet |
//! | `rk4` | the product's, here also at a fixed step |
//! | `dopri5` | Dormand and Prince 5(4) |
//! | `rkn43`, `rkn64` | the product's Nystrom pairs, without a limit of the step, here also at a fixed one |
//! | `gauss6` | Gauss, three stages |
//! | `radau` | the product's, here also at a fixed step |
//! | `alpha_1.0`, `alpha_0.8`, `alpha_0.6` | generalized-alpha by its spectral radius |
//! | `alpha_..._turned` | the same, the tangent rotating along with directions |
//! | `trapezoid`, `midpoint` | trapezoidal rule, implicit midpoint rule |
//! | `energy_momentum` | conserves energy and momenta |

mod alpha;
mod dopri5;
mod energy_momentum;
mod gauss;
#[cfg(test)]
mod mechanisms;
mod midpoint;
mod newton;
#[cfg(test)]
mod order;
mod partitioning;
mod probe;
mod verlet;

use std::sync::{Arc, Mutex};

use flexbody::bodies::Node;
use flexbody::integrators::{Nystrom, OneStepMethod, RK4, RKN43, RKN64, Radau, RungeKutta};
use flexbody::system::fastest;

use crate::scene::{Outcome, Start};

pub use probe::{Probe, Tally};

/// Arguments that methods are built from.
pub struct Build<'a> {
    /// The system at its start.
    pub start: &'a Start,
    /// Where the dynamics leave nodal coordinates, for a method that needs them.
    pub nodes: Arc<Mutex<Vec<Node>>>,
    /// Whether the step is fixed: nothing reads error estimates.
    pub fixed: bool,
}

/// A method by its name.
pub fn build(name: &str, build: &Build<'_>) -> Outcome<Box<dyn OneStepMethod>> {
    let n = build.start.state.rates.len();
    let only_positions = || {
        if build.start.assembled.system.reads_rates() {
            Err(format!(
                "{name}: expected accelerations that do not read rates"
            ))
        } else {
            Ok(())
        }
    };
    let turned = name.ends_with("_turned");
    Ok(match name.trim_end_matches("_turned") {
        "verlet" => Box::new(verlet::Verlet::new(n)),
        "rk4" => {
            let (start, mut work) = (build.start, build.start.work.clone());
            let system = &start.assembled.system;
            let (frequency, decay) = fastest(system, &start.inputs, &mut work, &start.state);
            Box::new(RungeKutta::new(&RK4, n, frequency, decay))
        }
        "dopri5" => Box::new(dopri5::Dopri5::new(n)),
        "rkn43" | "rkn64" => {
            only_positions()?;
            let tableau = match name {
                "rkn43" => &RKN43,
                _ => &RKN64,
            };
            // No frequency, no limit: how far they go is what the chart shows.
            Box::new(Nystrom::new(tableau, n, 0.0))
        }
        "gauss6" => Box::new(gauss::Gauss::new(n)),
        "radau" => Box::new(Radau::new(n)),
        "alpha_1.0" => Box::new(alpha::Alpha::new(
            alpha::Weights::of(1.0),
            n,
            build.fixed,
            turned,
        )),
        "alpha_0.8" => Box::new(alpha::Alpha::new(
            alpha::Weights::of(0.8),
            n,
            build.fixed,
            turned,
        )),
        "alpha_0.6" => Box::new(alpha::Alpha::new(
            alpha::Weights::of(0.6),
            n,
            build.fixed,
            turned,
        )),
        "trapezoid" => Box::new(alpha::Alpha::new(alpha::TRAPEZOID, n, build.fixed, turned)),
        "midpoint" => Box::new(midpoint::Midpoint::new(n)),
        "energy_momentum" => {
            only_positions()?;
            Box::new(energy_momentum::EnergyMomentum::new(build)?)
        }
        _ => return Err(format!("--method {name}: no method of this name")),
    })
}
