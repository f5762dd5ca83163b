//! What a scene that rotates adds to the inertia of a reduced body.
//!
//! With `W` the rotation of the scene along the axes of the body, its spin against space is `w + W`, and `W' = W x w`. Beside the forces of
//! inertia that `w` alone asks for, the equations in space ask for the moment `t(w + W) - t(w) - J W'` and the forces on modes
//! `Q(w + W) - Q(w) - h^T W'`.
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems, 5th ed. (2020), sections 3.6 and 5.4 (inertia in frames that move), for the equations
//! of `elements/reduced/inertia.rs`.

use nalgebra::{Matrix3, Vector3};

use super::ReducedBody;
use super::linearized::Stiffness;
use crate::bodies::assembly::NodeBlock;
use crate::bodies::connectivity::Node;
use crate::bodies::frame::along;
use crate::elements::reduced::CentrifugalStiffness;
use crate::math::jet::Number;

impl Stiffness for CentrifugalStiffness<'_> {
    fn rotations(&self) -> Matrix3<f64> {
        self.of_rotations()
    }

    fn mixed(&self, k: usize) -> Vector3<f64> {
        self.of_rotation_and_mode(k)
    }

    fn modal(&self, k: usize, l: usize) -> f64 {
        self.of_modes(k, l)
    }
}

impl ReducedBody {
    /// Adds these moments and forces on modes, without those on the centre of mass.
    pub(super) fn add_frame_forces<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        rotation: [f64; 3],
        f: &mut [Node<D, N>],
    ) {
        let (axes, spin) = (self.axes(x), self.frame.spin(x, v));
        let carried = along(&axes, &rotation.map(N::of).into());
        let (eta, rates) = (self.amplitudes(x), self.amplitudes(v));
        let force = self.amplitudes_mut(f);
        let negate = |force: &mut [N]| force.iter_mut().for_each(|force| *force = -*force);
        negate(force);
        let own = self.model.add_inertial((eta, rates), &spin, force);
        negate(force);
        let whole = (self.model).add_inertial((eta, rates), &(spin + carried), force);
        let change = carried.cross(&spin);
        for (k, force) in force.iter_mut().enumerate() {
            *force -= self.model.coupling_of(k, eta).dot(&change);
        }
        let moment = whole - own - self.model.momentum_of_spin(eta, &change);
        // Forces on axes that have this moment, and no stiffness against small rotations.
        let half = moment * N::of(0.5);
        let [a, b, c] = axes;
        let on_axes = [
            b * half[2] - c * half[1],
            c * half[0] - a * half[2],
            a * half[1] - b * half[0],
        ];
        let mut sum = self.axes(f);
        (0..3).for_each(|k| sum[k] += on_axes[k]);
        self.frame.set_axes(&sum, f);
    }

    /// Kinetic energy at rest in a scene that rotates, J, without that of the centre of mass.
    pub(super) fn frame_energy<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        rotation: [f64; 3],
    ) -> N {
        let carried = along(&self.axes(x), &rotation.map(N::of).into());
        let momentum = (self.model).momentum_of_spin(self.amplitudes(x), &carried);
        momentum.dot(&carried) * N::of(0.5)
    }

    /// Calls with the second derivatives of the potential of centrifugal forces, without those on the centre of mass.
    pub(super) fn centrifugal_blocks<const D: usize>(
        &self,
        rotation: [f64; 3],
        x: &[Node<D>],
        add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let stiffness = CentrifugalStiffness {
            model: &self.model,
            eta: self.amplitudes(x),
            rotation: along(&self.axes(x), &rotation.into()),
        };
        self.blocks(&stiffness, x, add);
    }
}
