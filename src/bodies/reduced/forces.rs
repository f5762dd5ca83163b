//! How forces on a reduced body act on what is integrated.

use nalgebra::Vector3;

use super::changes::force_of;
use super::{ReducedBody, Site, numbers, numbers_mut};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{RigidBodyFrame, along, axes_at, rotation_numbers, turned_back};
use crate::math::jet::Number;

impl ReducedBody {
    /// Takes a force in global components and a moment along the axes of a place of the body to what is integrated: passed to `term`, node
    /// by node.
    pub(in crate::bodies) fn pull_marker<const D: usize, N: Number>(
        &self,
        site: Site,
        (force, moment): (&[N; D], &Vector3<N>),
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        let (scale, terms) = self.derived_of(x);
        let node = self.frame.node;
        let Site::Interface(index) = site else {
            let moment = scale.transposed_times(moment);
            return term(node, &[*force, rotation_numbers(&moment)]);
        };
        let (axes, eta) = (self.axes(x), self.amplitudes(x));
        let (interface, local) = (
            &self.model.interfaces[index],
            along(&axes, &(*force).into()),
        );
        let arm = self.arm(self.interface(index), &axes, x);
        let mut turning = arm.cross(&local);
        let on_turn = interface.rotation.as_ref().map(|_| {
            let turn = interface.turn(eta);
            turning += turned_back(&-turn, moment);
            force_of(&turn, moment)
        });
        if on_turn.is_none() {
            turning += moment;
        }
        let (shapes, couplings) = (terms.shapes(index), terms.couplings());
        for (at, modal) in self.modal().enumerate() {
            let mut part = [[N::of(0.0); D]; 2];
            let first = 2 * D * at;
            let of_modes = shapes[first..].iter().zip(&couplings[first..]).enumerate();
            for (number, (k, (shape, coupling))) in part.as_flattened_mut().iter_mut().zip(of_modes)
            {
                *number = Vector3::from(*shape).dot(&local);
                if let Some(on_turn) = &on_turn {
                    *number += interface.rotation_shape(first + k, eta).dot(on_turn);
                }
                turning -= Vector3::from(*coupling) * *number;
            }
            term(modal, &part);
        }
        let moment = scale.transposed_times(&turning);
        term(node, &[*force, rotation_numbers(&moment)]);
    }

    /// Takes forces over the nodes to what is integrated, with the forces of inertia that rates ask for.
    pub(super) fn pull_back_all<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        let node = self.frame.node;
        let mut turning = RigidBodyFrame::moment(&self.axes(x), &self.axes(f));
        if let Some(v) = v {
            let spin = self.frame.spin(x, v);
            let motion = (self.amplitudes(x), self.amplitudes(v));
            let terms = [self.terms(x), self.terms(v)];
            let force = self.amplitudes_mut(f);
            turning += self.model.add_inertial(motion, terms, &spin, force);
        }
        let (scale, terms) = self.derived_of(x);
        for (coupling, force) in terms.couplings().iter().zip(self.amplitudes(f)) {
            turning -= Vector3::from(*coupling) * *force;
        }
        let moment = scale.transposed_times(&turning);
        f[node][1] = rotation_numbers(&moment);
        f[node + 1] = [[N::of(0.0); D]; 2];
        for (node, site) in self.sites().skip(1) {
            let on_node = &mut f[node..][..2];
            if numbers(on_node)
                .iter()
                .all(|number| number.largest() == 0.0)
            {
                continue;
            }
            let force = on_node[0][0];
            let moment = RigidBodyFrame::moment(&axes_at(node, x), &axes_at(0, on_node));
            on_node.fill([[N::of(0.0); D]; 2]);
            self.pull_marker(site, (&force, &moment), x, &mut |node, term| {
                let sums = f[node].as_flattened_mut().iter_mut();
                sums.zip(term.as_flattened())
                    .for_each(|(sum, part)| *sum += *part);
            });
        }
    }

    /// Adds elastic and damping forces on modes. Returns the power that damping dissipates, W.
    pub(super) fn add_modal_force<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        f: &mut [Node<D, N>],
    ) -> N {
        let force = self.amplitudes_mut(f);
        self.strain
            .add_force(self.amplitudes(x), self.terms(x), force);
        let mut power = N::of(0.0);
        for ((force, rate), damping) in force.iter_mut().zip(self.amplitudes(v)).zip(&self.damping)
        {
            let held = *rate * N::of(*damping);
            *force -= held;
            power += held * *rate;
        }
        power
    }

    /// Forces on axes that together do as a moment along them and the momenta of modes: those of `M (w, eta')`.
    pub(super) fn add_modal_momentum<const D: usize>(
        &self,
        (x, dx): (&[Node<D>], &[Node<D>]),
        momentum: &mut [Node<D>],
    ) {
        let spin = self.frame.spin(x, dx);
        let (eta, rates) = (self.amplitudes(x), self.amplitudes(dx));
        let terms = self.terms(x);
        let turning = self.model.angular_momentum((eta, rates), terms, &spin);
        let on_axes = RigidBodyFrame::on_axes(&self.axes(x), &turning);
        let mut sum = self.axes(momentum);
        (0..3).for_each(|k| sum[k] += on_axes[k]);
        self.frame.set_axes(&sum, momentum);
        let of_modes = numbers_mut(&mut momentum[self.inner()..]);
        for (k, rate) in rates.iter().enumerate() {
            of_modes[k] += rate + terms.coupling(k).dot(&spin);
        }
    }
}
