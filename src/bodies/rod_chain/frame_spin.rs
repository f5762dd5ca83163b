//! What a scene that rotates adds to the inertia of spins (`"rotation"`): sections that are at rest in it rotate with it. With `W` its
//! rotation along the axes of a section (of a rod about the tangent alone), the spin against space is `w + W`, and with momenta `P` of
//! `w` and `Q` of `W` the equations of motion in space ask, beside what they ask for where nothing rotates,
//!
//! - of a beam for the moment `-dQ + P x W + Q x (w + W)`, with `dQ` that of `W' = W x w`;
//! - of a rod for the moment `-dQ` about the tangent, with `dQ` that of `W' = W . t'`, and for the force
//!   `(Q t x t' + (P + Q) (W - t t . W)) / |u|` on the slope.
//!
//! Half the product of `Q` and `W` is their energy, part of that of the centrifugal force.
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems, 5th ed. (2020), sections 3.6 and 5.4 (inertia in frames that move), for the
//! equations of `frame/section_frame.rs` and `frame/shear_rotation.rs`.

use nalgebra::Vector3;

use super::RodChain;
use crate::bodies::connectivity::Node;
use crate::bodies::frame::SectionFrame;
use crate::elements::beam::{Force, Rates};
use crate::math::jet::Number;

/// Rotation of the scene, rad/s.
type Rotation = [f64; 3];

impl RodChain {
    /// Returns the force that the rotation of the scene adds to the spin inertia of element `j`.
    pub fn frame_spin_force<const D: usize, N: Number>(
        &self,
        j: usize,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        rotation: Rotation,
    ) -> Force<N> {
        let rates = self.rates(j, (x, v));
        let ends = [j, j + 1].map(|k| self.frame(k));
        let carried = ends.map(|frame| along(frame, rotation, x));
        let changes = [0, 1].map(|k| {
            if ends[k].has_shear {
                let [turn, spin] = [carried[k], rates.spin[k]].map(Vector3::from);
                spin.cross(&turn).map(|change| -change).into()
            } else {
                along(ends[k], rotation, v)
            }
        });
        let own = self.momenta_of(j, &rates);
        let [with, changing] = [carried, changes].map(|spin| self.momenta_of_spins(j, spin));
        let (none, minus) = ([N::of(0.0); 3], |p: N| -p);
        let mut force = Force {
            e: [none; 4],
            moment: [changing[0], changing[2]].map(|p| p.map(minus)),
            inner: changing[1].map(minus),
        };
        for (k, frame) in ends.into_iter().enumerate() {
            let [own, with] = [&own, &with].map(|momenta| Vector3::from(momenta[2 * k]));
            let turn = Vector3::from(carried[k]);
            if frame.has_shear {
                let spin = turn + Vector3::from(rates.spin[k]);
                let asked = own.cross(&turn) + with.cross(&spin);
                (force.moment[k].iter_mut().zip(&asked)).for_each(|(sum, f)| *sum += *f);
                continue;
            }
            let ([tangent, ..], [change, ..]) = (frame.axes(x), frame.axes(v));
            let across = Vector3::from(rotation.map(N::of)) - tangent * turn[0];
            let asked = tangent.cross(&change) * with[0] + across * (own[0] + with[0]);
            let stretch = frame.slope(x).norm_squared().sqrt();
            force.e[2 * k + 1] = (asked / stretch).into();
        }
        force
    }

    /// Momenta of spins at both ends alone.
    pub(super) fn momenta_of_spins<N: Number>(&self, j: usize, spin: [[N; 3]; 2]) -> [[N; 3]; 3] {
        let none = [N::of(0.0); 3];
        let (e, inner) = ([none; 4], none);
        self.momenta_of(j, &Rates { e, spin, inner })
    }
}

/// Components of the rotation along the axes about which a section spins freely, or their rates where `x` holds rates.
pub(super) fn along<const D: usize, N: Number>(
    frame: &SectionFrame,
    rotation: Rotation,
    x: &[Node<D, N>],
) -> [N; 3] {
    let rotation = Vector3::from(rotation.map(N::of));
    let mut along = frame.axes(x).map(|axis| axis.dot(&rotation));
    along[frame.rotations()..].fill(N::of(0.0));
    along
}
