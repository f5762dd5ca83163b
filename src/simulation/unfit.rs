//! Why a scene has no initial state, in words.

use super::Error;
use super::engine::Engine;
use crate::system::equilibrium::{Failure, NoEquilibrium};
use crate::system::{Gap, NotAssembled};

impl<const D: usize> Engine<D> {
    /// Why there is no equilibrium.
    pub(super) fn unsettled(&self, error: NoEquilibrium) -> Error {
        match error.why {
            Failure::ElementOverDeformed(body, element) => {
                let place = format!(
                    " on the way to equilibrium beyond {:.4} of the load",
                    error.reached
                );
                Error::ElementOverDeformed(self.overbent(body, element, &place))
            }
            Failure::Rest(rest) => {
                Error::Equilibrium(format!("{error}, on `{}`", self.bodies[rest.body]))
            }
            Failure::Away(body) => {
                Error::Equilibrium(format!("{error}, found that of `{}`", self.bodies[body]))
            }
            Failure::Correction(_) | Failure::Restless => Error::Equilibrium(error.to_string()),
            Failure::Work => {
                let limit = self.most_work;
                Error::Equilibrium(format!(
                    "{error}, work_limit = {limit:e} (evaluations times parts)"
                ))
            }
        }
    }

    pub(super) fn open_joints(&self, error: &NotAssembled) -> String {
        if error.gaps.is_empty() {
            return "expected joints and motions that agree, found some that contradict each other"
                .into();
        }
        let gaps = self.gaps(&error.gaps);
        format!("expected bodies that fit together, found gaps: {gaps}")
    }

    /// Gaps of joints, in words.
    pub(super) fn gaps(&self, gaps: &[Gap]) -> String {
        let word = |gap: &Gap| {
            let (kind, name) = &self.holders[gap.joint];
            let unit = if gap.is_angle { "rad" } else { "m" };
            if gap.size < 1e-3 {
                format!("{kind} `{name}` {:.1e} {unit}", gap.size)
            } else {
                format!("{kind} `{name}` {:.3} {unit}", gap.size)
            }
        };
        gaps.iter().map(word).collect::<Vec<_>>().join(", ")
    }
}
