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
use crate::bodies::body::BodyPart;
use crate::bodies::connectivity::{Node, map_node};
use crate::bodies::frame::{along, completed};
use crate::bodies::linearized::{LinearTerms, LinearizationPoint};
use crate::bodies::probe::Nodes;
use crate::elements::reduced::CentrifugalStiffness;
use crate::math::jet::{Jet, Number};
use crate::math::space::{Vector, spun};

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
        let (axes, spin) = (completed::<D, N>(self.axes(x)), self.frame.spin(x, v));
        let carried = along(&axes, &rotation.map(N::of).into());
        let (eta, rates) = (self.amplitudes(x), self.amplitudes(v));
        let force = self.amplitudes_mut(f);
        let negate = |force: &mut [N]| force.iter_mut().for_each(|force| *force = -*force);
        negate(force);
        let (motion, terms) = ((eta, rates), [self.terms(x), self.terms(v)]);
        let own = self.model.add_inertial(motion, terms, &spin, force);
        negate(force);
        let whole = (self.model).add_inertial(motion, terms, &(spin + carried), force);
        let change = carried.cross(&spin);
        for (k, force) in force.iter_mut().enumerate() {
            *force -= terms[0].coupling(k).dot(&change);
        }
        let moment = whole - own - self.model.momentum_of_spin(eta, terms[0], &change);
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

    /// Adds the Coriolis forces of small motions to the linearized equations: derivatives by what is counted, at rest.
    pub(super) fn linearize_coriolis<const D: usize>(
        &self,
        at: &mut LinearizationPoint<'_, D>,
        terms: &mut LinearTerms,
    ) {
        let (node, rotation, mass) = (self.frame.node, at.rotation, self.model.mass);
        let nodes: Vec<usize> = self.acted().collect();
        let force = |x: &Nodes<D>, v: &Nodes<D>, f: &mut Nodes<D>| {
            let at_rest = |rate: Jet| rate - Jet::from_re(rate.re);
            let mut rates: Vec<Node<D, Jet>> = v.iter().map(|v| map_node(v, at_rest)).collect();
            self.place_changes(x, &mut rates);
            self.add_frame_forces((x, &rates), rotation, f);
            self.pull_back_all((x, None), f);
            let coriolis = spun(rotation, Vector::<D, Jet>::from(rates[node][0]));
            let sums = f[node][0].iter_mut().zip(&coriolis);
            sums.for_each(|(sum, part)| *sum -= *part * Jet::from_re(2.0 * mass));
        };
        let blocks = at.probe.differentiate(&nodes, true, &force);
        blocks.add(at.assembly, &mut terms.damping, &mut |_, _, _| {});
    }

    /// Kinetic energy at rest in a scene that rotates, J, without that of the centre of mass.
    pub(super) fn frame_energy<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        rotation: [f64; 3],
    ) -> N {
        let axes = completed::<D, N>(self.axes(x));
        let carried = along(&axes, &rotation.map(N::of).into());
        let (eta, terms) = (self.amplitudes(x), self.terms(x));
        let momentum = self.model.momentum_of_spin(eta, terms, &carried);
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
            terms: self.terms(x),
            rotation: along(&completed::<D, _>(self.axes(x)), &rotation.into()),
        };
        self.blocks(&stiffness, x, add);
    }
}
