//! How frames and interfaces of a reduced body follow from what is integrated, with rates and accelerations.

use nalgebra::Vector3;

use super::{ModalState, ReducedBody, coupling_at, numbers_mut};
use crate::bodies::body::BodyPart;
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{
    Axes, along, axes_at, axis_rates, combined, set_axes_at, spin_of, turned_back,
};
use crate::elements::reduced::SPIN_SCALE;
use crate::math::jet::{Jet, Number, part, set_part};
use crate::math::space::{components, vector};

/// The force on a rotation `p` of a moment along the turned axes: the transpose of [`spin_of`].
pub(super) fn force_of<N: Number>(p: &Vector3<N>, moment: &Vector3<N>) -> Vector3<N> {
    (moment + p.cross(moment) * N::of(0.5)) / (N::of(1.0) + N::of(0.25) * p.norm_squared())
}

/// Rate of the spin along axes that are turned by `p` against a body, without `p''` and without the angular acceleration of the body.
fn spin_bias<N: Number>(p: &Vector3<N>, rate: &Vector3<N>, of_body: &Vector3<N>) -> Vector3<N> {
    let own = spin_of(p, rate);
    let shrink = N::of(0.5) * p.dot(rate) / (N::of(1.0) + N::of(0.25) * p.norm_squared());
    -own.cross(&turned_back(p, of_body)) - own * shrink
}

impl ReducedBody {
    /// Writes the numbers that follow from the amplitudes in `x` into `x` and into a state.
    pub(super) fn place_derived<const D: usize>(&self, state: &mut ModalState, x: &mut [Node<D>]) {
        let (before, derived) = x.split_at_mut(self.derived());
        let eta = self.amplitudes(before);
        let derived = numbers_mut(derived);
        let (scale, coupling) = derived.split_at_mut(SPIN_SCALE);
        for (k, out) in state.coupling.iter_mut().enumerate() {
            *out = self.model.coupling_of(k, eta);
            coupling[3 * k..][..3].copy_from_slice(out.as_slice());
        }
        let coupling = &coupling[..3 * self.model.modes()];
        state.scale = self.model.spin_scale(eta, coupling);
        scale.copy_from_slice(&state.scale.0);
    }

    /// Writes the rates of the numbers that follow from amplitudes, whose rates stand in `v`.
    pub(super) fn place_derived_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        v: &mut [Node<D, N>],
    ) {
        let (before, derived) = v.split_at_mut(self.derived());
        let rates = self.amplitudes(before);
        let (scale, coupling) = numbers_mut(derived).split_at_mut(SPIN_SCALE);
        for k in 0..rates.len() {
            let rate = self.model.coupling_of(k, rates);
            coupling[3 * k..][..3].copy_from_slice(rate.as_slice());
        }
        let (at, h) = self.derived_of(x);
        let pairs = [self.amplitudes(x), rates];
        let couplings = [h, &coupling[..h.len()]];
        let change = self.model.spin_scale_change(&at, pairs, couplings);
        scale.copy_from_slice(&change.0);
    }

    /// Places and axes of interfaces at the frame and the amplitudes in `x`.
    pub(super) fn place_interfaces<const D: usize>(&self, x: &mut [Node<D>]) {
        let axes = self.axes(x);
        let center = Vector3::from(components(&x[self.frame.node][0].into()));
        let (outer, inner) = x.split_at_mut(self.inner());
        let eta = &super::numbers(inner)[..self.model.modes()];
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let node = self.interface(index);
            let at = center + combined(&axes, &interface.place(eta, self.model.paired));
            let back = -interface.turn(eta);
            let own =
                [0, 1, 2].map(|k| combined(&axes, &turned_back(&back, &Vector3::ith(k, 1.0))));
            set_axes_at(node, &own, outer);
            outer[node][0] = vector::<D, f64>(at.into()).into();
        }
    }

    /// Rates of interfaces at rates of the frame, its spin, and rates of the amplitudes in `v`; or changes.
    pub(super) fn place_interface_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        spin: &Vector3<N>,
        v: &mut [Node<D, N>],
    ) {
        let axes = self.axes(x);
        let velocity = Vector3::from(components(&v[self.frame.node][0].into()));
        let (outer, inner) = v.split_at_mut(self.inner());
        let rates = &super::numbers(inner)[..self.model.modes()];
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let node = self.interface(index);
            let arm = self.arm(node, &axes, x);
            let moved =
                velocity + combined(&axes, &(spin.cross(&arm) + self.moved(index, x, rates)));
            let turn = interface.turn(self.amplitudes(x));
            let own = turned_back(&turn, spin) + spin_of(&turn, &interface.turn(rates));
            set_axes_at(node, &axis_rates(&axes_at(node, x), &own), outer);
            outer[node][0] = vector::<D, N>(moved.into()).into();
        }
    }

    /// Adds to accelerations of interfaces what rates alone ask for.
    pub(super) fn add_interface_bias<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        let axes = self.axes(x);
        let spin = self.frame.spin(x, v);
        let rates = self.amplitudes(v);
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let node = self.interface(index);
            let arm = self.arm(node, &axes, x);
            let moved = self.moved(index, x, rates) * N::of(2.0);
            let along = spin.cross(&(spin.cross(&arm) + moved))
                + interface.second_rate(rates, self.model.paired);
            let bias = combined(&axes, &along);
            let bias = vector::<D, N>(bias.into());
            a[node][0].iter_mut().zip(&bias).for_each(|(a, b)| *a += *b);
            let turn = interface.turn(self.amplitudes(x));
            let rate = interface.turn(rates);
            let own = turned_back(&turn, &spin) + spin_of(&turn, &rate);
            let by_rates = axis_rates(&axes_at(node, v), &own);
            let by_bias = axis_rates(&axes_at(node, x), &spin_bias(&turn, &rate, &spin));
            let sum: Axes<N> = axes_at(node, a);
            let sum = std::array::from_fn(|k| sum[k] + by_rates[k] + by_bias[k]);
            set_axes_at(node, &sum, a);
        }
    }

    /// Place of an interface by its node, along the axes from the centre of mass, m.
    pub(super) fn arm<const D: usize, N: Number>(
        &self,
        node: usize,
        axes: &Axes<N>,
        x: &[Node<D, N>],
    ) -> Vector3<N> {
        let [at, center] =
            [node, self.frame.node].map(|node| Vector3::from(components(&x[node][0].into())));
        along(axes, &(at - center))
    }

    /// Velocity of an interface against the axes at these rates of the amplitudes, m/s.
    fn moved<const D: usize, N: Number>(
        &self,
        index: usize,
        x: &[Node<D, N>],
        rates: &[N],
    ) -> Vector3<N> {
        let (interface, eta) = (&self.model.interfaces[index], self.amplitudes(x));
        let zero = Vector3::from_element(N::of(0.0));
        rates.iter().enumerate().fold(zero, |sum, (k, rate)| {
            sum + interface.shape(k, eta, self.model.paired) * *rate
        })
    }

    /// Spins and changes of amplitudes that belong to what is counted alike, in place: `w = S^-1 nu`, `eta' = zeta - h^T w`. Returns the
    /// spin.
    pub(super) fn resolve<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        change: &mut [Node<D, N>],
    ) -> Vector3<N> {
        let (scale, coupling) = self.derived_of(x);
        let counted = Vector3::from(components(&change[self.frame.node][1].into()));
        let spin = scale.times(&counted);
        for (k, amplitude) in self.amplitudes_mut(change).iter_mut().enumerate() {
            *amplitude -= coupling_at(coupling, k).dot(&spin);
        }
        spin
    }

    /// Number of what is counted besides the centre of mass: spins and rates of amplitudes.
    pub(in crate::bodies) fn count(&self) -> usize {
        3 + self.model.modes()
    }

    /// Iterates over all that is counted besides the centre of mass, which stands in the places of rotations and amplitudes.
    pub(in crate::bodies) fn counted<'a, const D: usize>(
        &self,
        found: &'a [Node<D>],
    ) -> impl Iterator<Item = &'a f64> {
        found[self.frame.node][1]
            .iter()
            .chain(self.amplitudes(found))
    }

    /// Derivative `k` of accelerations of its nodes, from those of what is counted, spins first. The centre of mass has its own already.
    pub(in crate::bodies) fn differentiate<const D: usize>(
        &self,
        k: usize,
        counted: &[Jet],
        (x, bias): (&[Node<D, Jet>], &[Node<D, Jet>]),
        acceleration: &mut [Node<D, Jet>],
    ) {
        let center = acceleration[self.frame.node][0];
        let (spins, amplitudes) = counted.split_at(3);
        for (to, from) in acceleration[self.frame.node][1].iter_mut().zip(spins) {
            *to = *from;
        }
        self.amplitudes_mut(acceleration)
            .copy_from_slice(amplitudes);
        BodyPart::place_changes(self, x, acceleration);
        for node in self.all() {
            let by_bias = bias[node].as_flattened().iter();
            for (to, by_bias) in acceleration[node]
                .as_flattened_mut()
                .iter_mut()
                .zip(by_bias)
            {
                let value = part(*to, k) + part(*by_bias, k);
                set_part(to, k, value);
                to.re += by_bias.re;
            }
        }
        acceleration[self.frame.node][0] = center;
    }

    /// Adds to the second derivatives of what follows from amplitudes what rates alone ask for.
    pub(in crate::bodies) fn add_derived_bias<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        let ((scale, h), (_, h_rates)) = (self.derived_of(x), self.derived_of(v));
        let pairs = [self.amplitudes(x), self.amplitudes(v)];
        let bias = self.model.spin_scale_bias(&scale, pairs, [h, h_rates]);
        let sums = numbers_mut(&mut a[self.derived()..]).iter_mut();
        sums.zip(bias.0).for_each(|(sum, bias)| *sum += bias);
    }
}
