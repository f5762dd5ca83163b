//! Rods in the linearized equations of motion.

use super::linearization::Linearization;
use crate::body::{Frames, NodeBlock, no_block};
use crate::math::sparse::General;
use crate::system::{System, Work};

impl<const D: usize> System<D> {
    /// Bending and torsion of rods, at rest, and what forces on the axes that they carry add where these turn.
    pub(super) fn linearize_rods(
        &self,
        work: &Work<D>,
        at_rest: bool,
        made: &mut Linearization<'_, D>,
    ) {
        let assembly = &self.elimination.assembly;
        let mut none = |_: usize, _: usize, _: f64| {};
        let mut put = |(a, b): (usize, usize), block: &NodeBlock<D>, matrix: &mut General<f64>| {
            assembly.add_block((a, b), block, matrix, &mut none);
            if a != b {
                let mut back = no_block();
                for (p, r, q, c) in entries::<D>() {
                    back[q][c][p][r] = block[p][r][q][c];
                }
                assembly.add_block((b, a), &back, matrix, &mut none);
            }
        };
        for chain in &self.rod_chains {
            let is_damped = chain.is_damped() && !at_rest;
            made.is_damped |= is_damped;
            for j in 0..chain.count() {
                let (rod, at) = (chain.element(j), chain.at(j, &work.x));
                chain.for_each_block(j, &rod.stiffness(&at, None), |a, b, block| {
                    put((a, b), block, &mut made.stiffness);
                });
                if is_damped {
                    chain.for_each_block(j, &rod.damping(&at), |a, b, block| {
                        put((a, b), block, &mut made.damping);
                    });
                }
            }
        }
        for frame in self.frames.carried() {
            for (nodes, block) in Frames::geometric_of_carried(frame, &work.supply, &work.x) {
                put(nodes, &block, &mut made.stiffness);
            }
        }
    }
}

/// Parts and axes of the rows and columns of a block.
fn entries<const D: usize>() -> impl Iterator<Item = (usize, usize, usize, usize)> {
    let places = || (0..2).flat_map(|part| (0..D).map(move |axis| (part, axis)));
    places().flat_map(move |(p, r)| places().map(move |(q, c)| (p, r, q, c)))
}
