//! Rods in the linearized equations of motion.

use super::linearization::Linearization;
use crate::body::{Frames, RodChain};
use crate::math::sparse::Matrix;
use crate::system::{System, Work};

impl<const D: usize> System<D> {
    /// Bending and torsion of rods, at rest, and what forces on the axes that they carry add where these turn.
    pub(super) fn linearize_rods(
        &self,
        work: &Work<D>,
        at_rest: bool,
        made: &mut Linearization<'_, D>,
    ) {
        if self.rod_chains.is_empty() {
            return;
        }
        let assembly = &self.elimination.assembly;
        let [mut stiffness, mut damping] = [0, 1].map(|_| Matrix::zeros(assembly.pattern()));
        let motion = (&work.x[..], &work.v[..]);
        for chain in &self.rod_chains {
            let matrices = [&mut stiffness, &mut damping];
            chain.add_tangent(motion, &self.frames, assembly, matrices);
        }
        for frame in self.frames.carried() {
            Frames::geometric_of_carried(frame, &work.supply, &work.x, |a, b, block| {
                assembly.add(a, b, block, &mut stiffness);
            });
        }
        made.stiffness.add_symmetric(1.0, &stiffness);
        if !at_rest && self.rod_chains.iter().any(RodChain::is_damped) {
            made.is_damped = true;
            made.damping.add_symmetric(1.0, &damping);
        }
    }
}
