//! From coordinates that are integrated to nodal coordinates `x`, and forces back. Nodes of cables are what is integrated. Nodes of rigid
//! bodies and of sections follow from rotations (`frame.rs`), those of a cable on a winch from its length (`winch/lengthening.rs`).

use super::Bodies;
use super::assembly::NodeBlock;
use super::connectivity::Node;
use super::frame::Rotations;
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;

impl<const D: usize> Bodies<D> {
    /// Takes what is integrated, which `x` holds before, to nodal coordinates. Rotations count from the frames `from`.
    #[inline(always)]
    pub fn place(
        &self,
        from: &[Quaternion],
        drives: &[[f64; 3]],
        rotations: Rotations<'_>,
        x: &mut [Node<D>],
    ) {
        self.lengthen(drives, x);
        self.frames.place(from, rotations, x);
    }

    /// Takes rates of what is integrated, which `v` holds before, to nodal rates at coordinates `x`.
    #[inline(always)]
    pub fn place_rates(
        &self,
        drives: &[[f64; 3]],
        rotations: Rotations<'_>,
        x: &[Node<D>],
        v: &mut [Node<D>],
    ) {
        self.lengthen_rates(drives, x, v);
        self.frames.place_rates(x, rotations, v);
    }

    /// Takes small changes of what is integrated, of rotations about the axes, which `dx` holds before, to changes of nodal coordinates.
    #[inline(always)]
    pub fn place_changes<N: Number>(
        &self,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
        dx: &mut [Node<D, N>],
    ) {
        self.shorten(drives, dx);
        self.frames.place_changes(x, dx);
    }

    /// Adds to nodal accelerations what follows from positions `x` and rates `v` alone.
    #[inline(always)]
    pub fn add_bias<N: Number>(
        &self,
        drives: &[[N; 3]],
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        self.frames.add_centripetal((x, v), a);
        self.add_lengthened(drives, (x, v), a);
    }

    /// Takes forces on nodes back to what is integrated: forces, moments along axes. With `torques` and rates, gyroscopic moments and the
    /// moments `torques` of sections are added.
    #[inline(always)]
    pub fn pull_back_motion<N: Number>(
        &self,
        drives: &[[N; 3]],
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        torques: &[[N; 3]],
        f: &mut [Node<D, N>],
    ) {
        self.shorten(drives, f);
        self.frames.pull_back((x, Some(v)), f);
        for (frame, torque) in self.frames.carried().iter().zip(torques) {
            let moment = f[frame.node][1].iter_mut().zip(torque);
            moment.for_each(|(sum, torque)| *sum += *torque);
        }
        for chain in &self.rod_chains {
            chain.add_gyroscopic((x, v), &self.frames, f);
        }
    }

    /// Takes second derivatives by two nodes back to what is integrated, and hands on the blocks.
    #[inline(always)]
    pub fn pull_block(
        &self,
        (a, b): (usize, usize),
        block: &NodeBlock<D>,
        (x, drives): (&[Node<D>], &[[f64; 3]]),
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let shortened;
        let block = if !self.pays_out {
            block
        } else {
            shortened = self.shorten_block((a, b), drives, block);
            &shortened
        };
        if self.has_no_frames() {
            return add(a, b, block);
        }
        self.frames.pull_block((a, b), block, x, add);
    }
}
