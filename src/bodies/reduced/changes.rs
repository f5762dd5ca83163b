//! How frames and interfaces of a reduced body follow from what is integrated, with rates and accelerations.

use nalgebra::Vector3;

use super::{ModalState, ReducedBody, numbers_mut, rotated_axes};
use crate::bodies::body::BodyPart;
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{
    Axes, along, axes_at, axis_rates, combined, rotation_of, set_axes_at, spin_of, turned_back,
};
use crate::math::jet::{Jet, Number, part, set_part};
use crate::math::space::{components, vector};

/// The force on a rotation `p` of a moment along the rotated axes: the transpose of [`spin_of`].
pub(super) fn force_of<N: Number>(p: &Vector3<N>, moment: &Vector3<N>) -> Vector3<N> {
    (moment + p.cross(moment) * N::of(0.5)) / (N::of(1.0) + N::of(0.25) * p.norm_squared())
}

/// Rate of the spin along axes that are rotated by `p` against a body, without `p''` and without the angular acceleration of the body.
fn spin_bias<N: Number>(p: &Vector3<N>, rate: &Vector3<N>, of_body: &Vector3<N>) -> Vector3<N> {
    let own = spin_of(p, rate);
    let shrink = N::of(0.5) * p.dot(rate) / (N::of(1.0) + N::of(0.25) * p.norm_squared());
    -own.cross(&turned_back(p, of_body)) - own * shrink
}

impl ReducedBody {
    /// Writes the numbers that follow from the amplitudes in `x` into `x`, which holds them without deformation, and into a state.
    pub(super) fn place_derived<const D: usize>(&self, state: &mut ModalState, x: &mut [Node<D>]) {
        let (before, derived) = x.split_at_mut(self.derived());
        let (eta, (scale, terms)) = (self.amplitudes(before), self.derived_mut(derived));
        self.matrix.deform(eta, terms);
        let terms = self.matrix.read(terms);
        for (out, coupling) in state.coupling.iter_mut().zip(terms.couplings()) {
            *out = (*coupling).into();
        }
        state.scale = self.model.spin_scale(eta, terms);
        scale.copy_from_slice(&state.scale.0);
    }

    /// Writes the rates of terms that velocities and forces depend on. Derivatives ask for all: [`Self::place_derived_rates`].
    pub(super) fn place_velocity_terms<const D: usize>(&self, v: &mut [Node<D>]) {
        let (before, derived) = v.split_at_mut(self.derived());
        let (rates, (_, term_rates)) = (self.amplitudes(before), self.derived_mut(derived));
        self.matrix.rates_of_velocities(rates, term_rates);
    }

    /// Writes the rates of the numbers that follow from amplitudes, whose rates stand in `v`.
    pub(in crate::bodies) fn place_derived_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        v: &mut [Node<D, N>],
    ) {
        let (before, derived) = v.split_at_mut(self.derived());
        let (rates, (scale, term_rates)) = (self.amplitudes(before), self.derived_mut(derived));
        self.matrix.rates(rates, term_rates);
        let (at, terms) = self.derived_of(x);
        let terms = [terms, self.matrix.read(term_rates)];
        let change = self.model.spin_scale_change(&at, rates, terms);
        scale.copy_from_slice(&change.0);
    }

    /// Places and axes of interfaces at the frame and the amplitudes in `x`.
    pub(super) fn place_interfaces<const D: usize>(&self, x: &mut [Node<D>]) {
        let axes = self.axes(x);
        let center = Vector3::from(components(&x[self.frame.node][0].into()));
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let (node, eta) = (self.interface(index), self.amplitudes(x));
            let place = interface.place(eta, self.terms(x).shapes(index));
            let own = interface.rotation.as_ref().map_or(axes, |_| {
                let unit = [0, 1, 2].map(|k| Vector3::ith(k, 1.0));
                rotated_axes(interface, eta, &axes, &unit)
            });
            set_axes_at(node, &own, x);
            x[node][0] = vector::<D, f64>((center + combined(&axes, &place)).into()).into();
        }
    }

    /// Rates of interfaces at rates of the frame, its spin, and rates of the amplitudes in `v`; or changes.
    pub(super) fn place_interface_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        spin: &Vector3<N>,
        v: &mut [Node<D, N>],
    ) {
        let (axes, eta, terms) = (self.axes(x), self.amplitudes(x), self.terms(x));
        let of_points = axis_rates(&axes, spin);
        let velocity = Vector3::from(components(&v[self.frame.node][0].into()));
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let (node, rates) = (self.interface(index), self.amplitudes(v));
            let arm = self.arm(node, &axes, x);
            let along = spin.cross(&arm) + terms.velocity(index, rates);
            let moved = velocity + combined(&axes, &along);
            let own = interface.rotation.as_ref().map_or(of_points, |_| {
                let turn = interface.turn(eta);
                let own =
                    turned_back(&turn, spin) + spin_of(&turn, &interface.turn_rate(eta, rates));
                axis_rates(&axes_at(node, x), &own)
            });
            set_axes_at(node, &own, v);
            v[node][0] = vector::<D, N>(moved.into()).into();
        }
    }

    /// Adds to accelerations of interfaces what rates alone ask for.
    pub(super) fn add_interface_bias<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        let (axes, spin) = (self.axes(x), self.frame.spin(x, v));
        let (eta, rates) = (self.amplitudes(x), self.amplitudes(v));
        let (terms, term_rates) = (self.terms(x), self.terms(v));
        let of_points = axis_rates(&self.axes(v), &spin);
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            let node = self.interface(index);
            let arm = self.arm(node, &axes, x);
            let moved = terms.velocity(index, rates) * N::of(2.0);
            let along = spin.cross(&(spin.cross(&arm) + moved)) + term_rates.velocity(index, rates);
            let bias = vector::<D, N>(combined(&axes, &along).into());
            a[node][0].iter_mut().zip(&bias).for_each(|(a, b)| *a += *b);
            let own = interface.rotation.as_ref().map_or(of_points, |_| {
                let (turn, rate) = (interface.turn(eta), interface.turn_rate(eta, rates));
                let own = turned_back(&turn, &spin) + spin_of(&turn, &rate);
                let by_rates = axis_rates(&axes_at(node, v), &own);
                let second = spin_of(&turn, &interface.turn_bias(rates));
                let bias = spin_bias(&turn, &rate, &spin) + second;
                let by_bias = axis_rates(&axes_at(node, x), &bias);
                std::array::from_fn(|k| by_rates[k] + by_bias[k])
            });
            let sum: Axes<N> = axes_at(node, a);
            set_axes_at(node, &std::array::from_fn(|k| sum[k] + own[k]), a);
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

    /// Spins and changes of amplitudes that belong to what is counted alike, in place: `w = S^-1 nu`, `eta' = zeta - h^T w`. Returns the
    /// spin.
    pub(super) fn resolve<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        change: &mut [Node<D, N>],
    ) -> Vector3<N> {
        let (scale, terms) = self.derived_of(x);
        let counted = rotation_of(&change[self.frame.node][1]);
        let spin = scale.times(&counted);
        let couplings = terms.couplings().iter();
        for (amplitude, coupling) in self.amplitudes_mut(change).iter_mut().zip(couplings) {
            *amplitude -= Vector3::from(*coupling).dot(&spin);
        }
        spin
    }

    /// Number of what is counted besides the centre of mass: spins and rates of amplitudes.
    pub(in crate::bodies) fn count(&self) -> usize {
        self.rotations() + self.model.modes()
    }

    /// Iterates over all that is counted besides the centre of mass, which stands in the places of rotations and amplitudes.
    pub(in crate::bodies) fn counted<'a, const D: usize>(
        &self,
        found: &'a [Node<D>],
    ) -> impl Iterator<Item = &'a f64> {
        found[self.frame.node][1][..self.rotations()]
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
        let (spins, amplitudes) = counted.split_at(self.rotations());
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
        let ((scale, terms), term_rates) = (self.derived_of(x), self.terms(v));
        let (rates, terms) = (self.amplitudes(v), [terms, term_rates]);
        let bias = self.model.spin_scale_bias(&scale, rates, terms);
        let sums = numbers_mut(&mut a[self.derived()..]).iter_mut();
        sums.zip(bias.0).for_each(|(sum, bias)| *sum += bias);
    }
}
