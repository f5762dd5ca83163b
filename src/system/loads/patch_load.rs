//! Loads over the surface of a plate or shell.

use super::{ForceElement, Instant};
use crate::math::jet::Number;
use crate::system::signal::Signal;

/// A load over a plate or shell.
#[derive(Clone, Debug)]
pub struct PatchLoad {
    /// Index among the patches.
    pub patch: usize,
    /// Force on an area.
    pub kind: PatchLoadKind,
}

/// Force on an area.
#[derive(Clone, Debug)]
pub enum PatchLoadKind {
    /// Along the normal, by the present area, Pa.
    Pressure(Signal),
    /// In global axes, by the area without stress, N/m^2.
    Dead([Signal; 3]),
}

impl<const D: usize> ForceElement<D> for PatchLoad {
    fn power<N: Number>(&self, _at: Instant<'_, D, N>) -> [N; 2] {
        [N::of(0.0); 2]
    }
}
