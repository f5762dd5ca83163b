//! What a version of the standard calls the things that messages speak of.

use super::lifecycle::InstanceState;

/// Names in a version of the standard.
pub struct Names {
    /// The function that makes an instance.
    pub instantiate: &'static str,
    /// The argument that tells which model is meant.
    pub token: &'static str,
    /// The function that takes the stop time.
    pub experiment: &'static str,
    /// The argument with the changes of the inputs that a directional derivative follows.
    pub seeds: &'static str,
    /// The type of real numbers.
    pub real: &'static str,
    /// The type of integers.
    pub integer: &'static str,
    /// The states of an instance.
    pub state: fn(InstanceState) -> &'static str,
}
