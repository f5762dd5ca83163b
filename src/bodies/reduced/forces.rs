//! How forces on a reduced body act on what is integrated.

use nalgebra::Vector3;

use super::changes::Tilt;
use super::{ReducedBody, Site, coupling_at, numbers_mut};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{Axes, RigidBodyFrame, axes_at};
use crate::math::jet::Number;
use crate::math::space::{components, is_nothing, vector};

/// A force along the axes of a body and a moment along the axes of a place of it.
#[derive(Clone, Copy, Debug)]
struct LocalForce<N> {
    force: Vector3<N>,
    moment: Vector3<N>,
}

impl ReducedBody {
    /// Force on a mode of forces at an interface.
    #[inline(always)]
    fn modal_force<N: Number>(
        &self,
        (index, k): (usize, usize),
        eta: &[N],
        on: &LocalForce<N>,
        pulled: &Vector3<N>,
    ) -> N {
        let interface = &self.model.interfaces[index];
        let shape = interface.shape(k, eta, self.model.paired);
        let mut sum = shape.dot(&on.force);
        if let Some(rotation) = &interface.rotation {
            sum += rotation[k].map(N::of).dot(pulled);
        }
        sum
    }

    /// Takes a force in global components and a moment along the axes of a place of the body to what is integrated: passed to `term`, node
    /// by node.
    pub(in crate::bodies) fn pull_marker<const D: usize, N: Number>(
        &self,
        site: Site,
        (force, moment): (&[N; D], &Vector3<N>),
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        let (scale, coupling) = self.derived_of(x);
        let node = self.frame.node;
        let Site::Interface(index) = site else {
            let moment = scale.transposed_times(moment);
            return term(node, &[*force, vector::<D, N>(moment.into()).into()]);
        };
        let axes = self.axes(x);
        let eta = self.amplitudes(x);
        let on = LocalForce {
            force: along(&axes, force),
            moment: *moment,
        };
        let tilt = Tilt::new(self.model.interfaces[index].turn(eta));
        let pulled = tilt.pull(&on.moment);
        let arm = self.arm(self.interface(index), &axes, x);
        let mut turning = arm.cross(&on.force) + tilt.forth(&on.moment);
        let size = 2 * D;
        for (at, modal) in self.modal().enumerate() {
            let mut part = [[N::of(0.0); D]; 2];
            let numbers = part.as_flattened_mut().iter_mut().enumerate();
            for (k, number) in numbers.map(|(place, number)| (size * at + place, number)) {
                if k < self.model.modes() {
                    *number = self.modal_force((index, k), eta, &on, &pulled);
                    turning -= coupling_at(coupling, k) * *number;
                }
            }
            term(modal, &part);
        }
        let moment = scale.transposed_times(&turning);
        term(node, &[*force, vector::<D, N>(moment.into()).into()]);
    }

    /// Adds forces on interfaces to those on the centre and on modes. Returns their moment along the axes.
    fn gather<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        f: &mut [Node<D, N>],
    ) -> Vector3<N> {
        let axes = self.axes(x);
        let eta = self.amplitudes(x);
        let mut sum = Vector3::from_element(N::of(0.0));
        for index in 0..self.model.interfaces.len() {
            let node = self.interface(index);
            let force = f[node][0];
            let moment = RigidBodyFrame::moment(&axes_at(node, x), &axes_at(node, f));
            f[node..][..2].fill([[N::of(0.0); D]; 2]);
            let is_free = is_nothing::<D, N>(&force.into());
            if is_free && moment.iter().all(|m| m.largest() == 0.0) {
                continue;
            }
            let on = LocalForce {
                force: along(&axes, &force),
                moment,
            };
            let tilt = Tilt::new(self.model.interfaces[index].turn(eta));
            let pulled = tilt.pull(&moment);
            sum += self.arm(node, &axes, x).cross(&on.force) + tilt.forth(&moment);
            let center = f[self.frame.node][0].iter_mut().zip(&force);
            center.for_each(|(sum, force)| *sum += *force);
            for (k, on_mode) in self.amplitudes_mut(f).iter_mut().enumerate() {
                *on_mode += self.modal_force((index, k), eta, &on, &pulled);
            }
        }
        sum
    }

    /// Takes forces over the nodes to what is integrated, with the forces of inertia that rates ask for.
    pub(super) fn pull_back_all<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        let mut turning = RigidBodyFrame::moment(&self.axes(x), &self.axes(f));
        turning += self.gather(x, f);
        if let Some(v) = v {
            let spin = self.frame.spin(x, v);
            let motion = (self.amplitudes(x), self.amplitudes(v));
            turning += self
                .model
                .add_inertial(motion, &spin, self.amplitudes_mut(f));
        }
        let (scale, coupling) = self.derived_of(x);
        for (k, force) in self.amplitudes_mut(f).iter().enumerate() {
            turning -= coupling_at(coupling, k) * *force;
        }
        let moment = scale.transposed_times(&turning);
        let node = self.frame.node;
        f[node][1] = vector::<D, N>(moment.into()).into();
        f[node + 1] = [[N::of(0.0); D]; 2];
    }

    /// Adds elastic and damping forces on modes. Returns the power that damping dissipates, W.
    pub(super) fn add_modal_force<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        f: &mut [Node<D, N>],
    ) -> N {
        let force = self.amplitudes_mut(f);
        self.strain.add_force(self.amplitudes(x), force);
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
        let turning = self.model.angular_momentum((eta, rates), &spin);
        let on_axes = RigidBodyFrame::on_axes(&self.axes(x), &turning);
        let mut sum = self.axes(momentum);
        (0..3).for_each(|k| sum[k] += on_axes[k]);
        self.frame.set_axes(&sum, momentum);
        let (_, coupling) = self.derived_of(x);
        let of_modes = numbers_mut(&mut momentum[self.inner()..]);
        for (k, rate) in rates.iter().enumerate() {
            of_modes[k] += rate + coupling_at(coupling, k).dot(&spin);
        }
    }
}

/// Components of a vector along axes.
#[inline(always)]
fn along<const D: usize, N: Number>(axes: &Axes<N>, v: &[N; D]) -> Vector3<N> {
    let v = Vector3::from(components(&(*v).into()));
    Vector3::from_fn(|k, _| axes[k].dot(&v))
}
