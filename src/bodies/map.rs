//! From coordinates that are integrated to nodal coordinates `x`, and forces back. Nodes of cables are what is integrated. Nodes of rigid
//! bodies and of sections follow from rotations (`frame.rs`), those of a cable on a winch from its length (`winch/scaling.rs`).

use super::assembly::NodeBlock;
use super::body::{BodyPart, NodalMotion, each};
use super::connectivity::{Node, largest_rotation};
use super::frame::{Derivative, RotationIncrement, SectionFrameState};
use super::nodes::NodeOwner;
use super::reduced::ModalState;
use super::{Bodies, Elimination};
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;

/// How bodies and sections have rotated, at a configuration, from the frames that the state holds.
#[derive(Clone, Debug, Default)]
pub struct Rotations {
    /// Rotations of rigid bodies of space and of reduced bodies, `[rigid bodies + reduced bodies]`.
    pub(super) rigid: Vec<RotationIncrement>,
    /// Numbers that follow from the amplitudes of reduced bodies, `[reduced bodies]`.
    pub(super) reduced: Vec<ModalState>,
    /// States of section frames, `[section frames]`.
    pub(super) sections: Vec<SectionFrameState>,
}

impl Rotations {
    /// Without any rotation.
    pub fn of<const D: usize>(bodies: &Bodies<D>) -> Self {
        Self {
            rigid: vec![RotationIncrement::default(); bodies.whole_frames()],
            reduced: bodies.reduced.iter().map(ModalState::of).collect(),
            sections: vec![SectionFrameState::default(); bodies.moments()],
        }
    }

    /// Takes over the rotations of rigid bodies and reduced bodies alone.
    pub fn copy_rigid(&mut self, other: &Self) {
        self.rigid.copy_from_slice(&other.rigid);
        let reduced = self.reduced.iter_mut().zip(&other.reduced);
        reduced.for_each(|(to, from)| to.copy_from(from));
    }

    /// Becomes the same as another one, without new memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.copy_rigid(other);
        self.sections.copy_from_slice(&other.sections);
    }
}

/// Vectors over the free coordinates and over the nodes that no one keeps.
pub struct ScratchVectors<'a, const D: usize> {
    /// `[free]`.
    pub y: &'a mut [f64],
    /// `[nodes]`.
    pub nodal: &'a mut [Node<D>],
}

impl<const D: usize> Bodies<D> {
    /// Takes what is integrated, which `x` holds before, to nodal coordinates. Rotations count from the frames `from`.
    #[inline(always)]
    pub fn place(
        &self,
        from: &[Quaternion],
        drives: &[[f64; 3]],
        rotations: &mut Rotations,
        x: &mut [Node<D>],
    ) {
        self.scale(drives, x);
        each!(self, |body| BodyPart::place(body, from, rotations, x));
    }

    /// Takes rates of what is integrated, which `v` holds before, to nodal rates at coordinates `x`.
    #[inline(always)]
    pub fn place_rates(
        &self,
        drives: &[[f64; 3]],
        rotations: &mut Rotations,
        x: &[Node<D>],
        v: &mut [Node<D>],
    ) {
        self.scale_rates(drives, x, v);
        each!(self, |body| BodyPart::place_rates(body, x, rotations, v));
    }

    /// Takes small changes of what is integrated, of rotations about the axes, which `dx` holds before, to changes of nodal coordinates.
    #[inline(always)]
    pub fn place_changes<N: Number>(
        &self,
        drives: &[[N; 3]],
        x: &[Node<D, N>],
        dx: &mut [Node<D, N>],
    ) {
        self.pull_back_scaled(drives, dx);
        each!(self, |body| BodyPart::place_changes(body, x, dx));
    }

    /// Adds to nodal accelerations what follows from positions and rates alone.
    #[inline(always)]
    pub fn add_bias<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        each!(self, |body| BodyPart::add_centripetal(body, motion, a));
        self.add_scaling_bias(motion, a);
    }

    /// Completes nodal rates by what follows from rates of amplitudes of reduced bodies. Velocities and forces do not read it, derivatives do.
    pub fn place_derived_rates(&self, x: &[Node<D>], v: &mut [Node<D>]) {
        let bodies = self.reduced.iter();
        bodies.for_each(|body| body.place_derived_rates(x, v));
    }

    /// Adds to second derivatives of what follows from amplitudes of reduced bodies what follows from positions and rates alone. Accelerations
    /// of places do not read it, derivatives of these do.
    pub fn add_derived_bias<N: Number>(&self, motion: NodalMotion<'_, D, N>, a: &mut [Node<D, N>]) {
        let bodies = self.reduced.iter();
        bodies.for_each(|body| body.add_derived_bias(motion.pair(), a));
    }

    /// Takes forces on nodes back to what is integrated: forces, moments along axes. Gyroscopic moments and the moments `torques` of sections
    /// are added.
    #[inline(always)]
    pub fn pull_back_motion<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        torques: &[[N; 3]],
        f: &mut [Node<D, N>],
    ) {
        self.pull_back_scaled(motion.drives, f);
        let rates = (motion.x, Some(motion.v));
        each!(self, |body| BodyPart::pull_back(body, rates, f));
        each!(self, |body| BodyPart::add_torques(body, torques, f));
        each!(self, |body| BodyPart::add_gyroscopic(body, motion, f));
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
        let block = if self.pays_out {
            shortened = self.pull_back_scaled_block((a, b), drives, block);
            &shortened
        } else {
            block
        };
        if self.has_no_frames() {
            return add(a, b, block);
        }
        self.rotate_block((a, b), block, x, add);
    }

    /// Converts changes of `q` between spins of bodies and sections, or their derivatives, and rotations from the frames that the state
    /// holds.
    #[inline(always)]
    pub fn convert(
        &self,
        order: Derivative,
        at: &Rotations,
        elimination: &Elimination<D>,
        ScratchVectors { y, nodal }: ScratchVectors<'_, D>,
        q: &mut [f64],
    ) {
        if self.has_no_frames() {
            return;
        }
        each!(self, |body| BodyPart::<D>::convert(body, order, at, q));
        if !self.has_section_frames() {
            return;
        }
        elimination.expand(q, y, nodal);
        each!(self, |body| BodyPart::convert_free(
            body, order, at, nodal, y
        ));
        elimination.coordinates_of(y);
        q.copy_from_slice(y);
    }

    /// [`Self::convert`] of reduced bodies alone, whose spins are counted otherwise even where nothing has rotated.
    pub fn convert_reduced(&self, order: Derivative, at: &Rotations, q: &mut [f64]) {
        for body in &self.reduced {
            BodyPart::<D>::convert(body, order, at, q);
        }
    }

    /// Takes over the rotations of a stage that differ from those where a tangent was made: of sections with a shear rotation, whose shear is
    /// stiffer than they are inert. Inertia of all others is linear in `q`.
    pub fn keep_stage(&self, now: &Rotations, stage: &mut Rotations) {
        let kept = stage.sections.iter_mut().zip(&now.sections);
        for ((kept, now), frame) in kept.zip(self.section_frames()) {
            if frame.has_shear {
                *kept = *now;
            }
        }
    }

    /// Whether sections have frames that follow lines: their rotations depend on positions.
    pub fn has_section_frames(&self) -> bool {
        self.moments() > 0
    }

    /// Largest rotation of any direction, rad, and change of any stretch between two configurations of nodes.
    pub fn largest_rotation_between(&self, from: &[Node<D>], to: &[Node<D>]) -> f64 {
        let nodes = from.iter().zip(to);
        if self.reduced.is_empty() && self.patches.is_empty() {
            return largest_rotation(nodes.map(|(from, to)| (&from[1], &to[1])));
        }
        // Amplitudes are no directions. In the plane a second node of a reduced body has none beside its axis. The second node of a mesh node
        // of a plate has one in its first vector.
        let directions =
            nodes
                .enumerate()
                .filter_map(|(node, (from, to))| match self.owner(node) {
                    NodeOwner::Modal => None,
                    NodeOwner::Reduced(.., true) if D == 2 => None,
                    NodeOwner::Surface => Some((&from[0], &to[0])),
                    _ => Some((&from[1], &to[1])),
                });
        largest_rotation(directions)
    }

    /// Largest rotation of rigid bodies in the coordinates `q`, rad.
    pub fn largest_rotation(&self, q: &[f64]) -> f64 {
        let mut largest = 0.0;
        each!(self, |body| largest =
            f64::max(largest, BodyPart::<D>::rotation_in(body, q)));
        largest
    }

    /// Largest rotation of a section from the frame that the state holds, rad.
    pub fn largest_section_rotation(&self, at: &Rotations) -> f64 {
        let mut largest = 0.0;
        each!(self, |body| largest =
            f64::max(largest, BodyPart::<D>::rotation_at(body, at)));
        largest
    }

    /// Rotations of sections begin at zero anew: `frames` become what they are at coordinates `x`. Coordinates and rates are over the free
    /// coordinates.
    pub fn renew_sections(
        &self,
        (x, at): (&[Node<D>], &Rotations),
        frames: &mut [Quaternion],
        [q, v]: [&mut [f64]; 2],
    ) {
        each!(self, |body| BodyPart::renew_free(
            body,
            (x, at),
            frames,
            [&mut *q, &mut *v]
        ));
    }

    /// Rotations of rigid bodies begin at zero anew: `frames` become what they are, and rates in `v` spins.
    pub fn renew_rigid(&self, frames: &mut [Quaternion], q: &mut [f64], v: &mut [f64]) {
        each!(self, |body| BodyPart::<D>::renew(body, frames, q, v));
    }
}
