//! Frames that rods carry along: the first axis of each is the tangent of its line, the others are turned about it.
//!
//! What is integrated is position and slope `(r, u)` of the node of the line and one rotation `p` about the tangent `t = u / |u|`,
//! measured from where the smallest rotation that takes the tangent `t0` of the frame which the state holds to `t` carries its second
//! axis: `e2 = turn(p, t) carry(t0, t, d0)`. With `h = t0 x t / (1 + t0.t)` the spin about the tangent is `w = p' - h.t'`, the angular
//! velocity `t x t' + w t`. A moment `m` is `(m x u) / u.u` on the slope and `m.t` on the rotation; conjugate to the spin, which is
//! no rate of a coordinate, a momentum `P` puts the force `P (t x t') / |u|` on the slope.
//!
//! Source: M. Bergou et al., Discrete elastic rods, ACM Trans. Graph. 27 (2008) 63 (carried frames and their variation); C. Meier,
//! A. Popp, W. A. Wall, Geometrically exact finite element formulations for slender beams, Arch. Comput. Methods Eng. 26 (2019)
//! 163-243, section 4 (smallest rotations on Hermite lines).

use nalgebra::{Matrix3, Vector3};

use super::{Axes, Frames, axes_at, set_axes_at};
use crate::body::assembly::{NodeBlock, no_block};
use crate::body::connectivity::Node;
use crate::body::stages::rotated;
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, axes, normalized, quaternion_near};
use crate::math::space::{components, vector};

/// A frame at a node of a rod.
#[derive(Clone, Debug)]
pub struct Carried {
    /// Its first node; the second one follows. Both hold position and axes, as those of a rigid body do.
    pub node: usize,
    /// The node of the line that it is at.
    pub line: usize,
    /// Where its rotation is among the free coordinates, and how many of that make a radian.
    pub place: (usize, f64),
}

/// Which derivative of rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// Rates, or small changes.
    First,
    /// Second derivatives in time.
    Second,
}

/// How a carried frame has turned from the one that the state holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Carry {
    /// Tangent that it is carried from, tangent, and rate of that, 1/s.
    from: Vector3<f64>,
    tangent: Vector3<f64>,
    rate: Vector3<f64>,
    /// Length of the slope, and its rate over it, 1/s.
    stretch: f64,
    stretching: f64,
    /// Rotation about the tangent, rad, and angular velocity about it, rad/s.
    rotation: f64,
    spin: f64,
}

impl Carry {
    /// `h`: by how much less of the spin about the tangent a change of it takes.
    fn by_tangent(&self) -> Vector3<f64> {
        self.from.cross(&self.tangent) / (1.0 + self.from.dot(&self.tangent))
    }

    /// The rotation that a small rotation about the tangent and a change of the slope make, rad.
    fn rate_of(&self, spin: f64, slope: &Vector3<f64>) -> f64 {
        spin + self.by_tangent().dot(slope) / self.stretch
    }

    /// Second derivative of the rotation, rad/s^2, of that of the spin and of the slope.
    fn second_of(&self, spin_rate: f64, slope: &Vector3<f64>) -> f64 {
        let h = self.by_tangent();
        let bend = self.from.dot(&self.rate) / (1.0 + self.from.dot(&self.tangent));
        self.rate_of(spin_rate, slope) - h.dot(&self.rate) * (2.0 * self.stretching + bend)
    }

    /// How far it has turned, rad: as a whole or about the tangent.
    fn size(&self) -> f64 {
        let across = self.from.cross(&self.tangent).norm();
        across
            .atan2(self.from.dot(&self.tangent))
            .max(self.rotation.abs())
    }
}

/// Three components of a part of a node.
fn part<const D: usize, N: Number>(node: &Node<D, N>, part: usize) -> Vector3<N> {
    components(&node[part].into()).into()
}

/// Angular velocity `t x t' + w t` of a slope and its rate, and a spin about it.
fn angular<N: Number>(slope: &Vector3<N>, rate: &Vector3<N>, spin: N) -> Vector3<N> {
    slope.cross(rate) / slope.norm_squared() + slope * (spin / slope.norm_squared().sqrt())
}

/// Rates of axes that turn at an angular velocity in global components.
fn turned_by<N: Number>(axes: &Axes<N>, velocity: &Vector3<N>) -> Axes<N> {
    axes.map(|axis| velocity.cross(&axis))
}

impl Carried {
    /// Its axes, or their rates where `x` holds rates.
    pub fn axes<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Axes<N> {
        axes_at(self.node, x)
    }

    /// Angular velocity about its tangent, rad/s; or a small rotation about it, rad, where `v` holds changes.
    pub fn spin<const D: usize, N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        let ([_, _, third], [_, second, _]) = (self.axes(x), self.axes(v));
        third.dot(&second)
    }

    /// Rate of its angular velocity about the tangent, rad/s^2, at these accelerations: `t.sum e x e'' / 2`.
    pub fn spin_rate<const D: usize, N: Number>(&self, x: &[Node<D, N>], a: &[Node<D, N>]) -> N {
        let ([_, second, third], [_, second_rate, third_rate]) = (self.axes(x), self.axes(a));
        (third.dot(&second_rate) - second.dot(&third_rate)) * N::of(0.5)
    }

    /// Its angular velocity, rad/s.
    pub fn velocity<const D: usize>(&self, x: &[Node<D>], v: &[Node<D>]) -> Vector3<f64> {
        angular(&self.slope(x), &self.slope(v), self.spin(x, v))
    }

    /// Sets its axes, or their rates.
    pub fn set_axes<const D: usize, N: Number>(&self, axes: &Axes<N>, x: &mut [Node<D, N>]) {
        set_axes_at(self.node, axes, x);
    }

    fn slope<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Vector3<N> {
        part(&x[self.line], 1)
    }

    /// Changes of its axes by those of the slope in `dx` and by a small rotation about the tangent; so do angular accelerations.
    pub fn turned<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        dx: &[Node<D, N>],
        spin: N,
    ) -> Axes<N> {
        let change = angular(&self.slope(x), &self.slope(dx), spin);
        turned_by(&self.axes(x), &change)
    }

    /// Force on its slope of a momentum conjugate to the spin, N m s: `P (t x t') / |u|`, N m.
    pub fn gyroscopic<const D: usize, N: Number>(
        &self,
        momentum: N,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
    ) -> [N; D] {
        let (u, rate) = (self.slope(x), self.slope(v));
        let square = u.norm_squared();
        let force = u.cross(&rate) * (momentum / (square * square.sqrt()));
        vector::<D, N>(force.into()).into()
    }

    /// Adds what a moment along its axes does to forces over the nodes that have coordinates.
    fn add_moment<const D: usize, N: Number>(
        &self,
        [_, second, third]: &Axes<N>,
        moment: &Vector3<N>,
        stretch: N,
        f: &mut impl FnMut(usize, usize, [N; D]),
    ) {
        let across = (second * moment[2] - third * moment[1]) / stretch;
        f(self.line, 1, vector::<D, N>(across.into()).into());
        let zero = N::of(0.0);
        f(self.node, 1, vector::<D, N>([moment[0], zero, zero]).into());
    }

    /// Derivatives of one of its nodes' vectors by the coordinates of the line's node and by its rotation.
    fn partials<const D: usize>(
        &self,
        is_second: bool,
        x: &[Node<D>],
    ) -> [(usize, NodeBlock<D>); 2] {
        let (axes, slope) = (self.axes(x), self.slope(x));
        let [mut by_line, mut by_turn] = [no_block(), no_block()];
        let kept = if is_second { [1, 2] } else { [3, 0] };
        for (p, k) in kept.into_iter().enumerate().filter(|(_, k)| *k < 3) {
            let turn = axes[0].cross(&axes[k]);
            for axis in 0..D {
                by_turn[p][axis][1][0] = turn[axis];
            }
            for along in 0..D {
                let change = angular(&slope, &Vector3::ith(along, 1.0), 0.0).cross(&axes[k]);
                for axis in 0..D {
                    by_line[p][axis][1][along] = change[axis];
                }
            }
        }
        if !is_second {
            (0..D).for_each(|axis| by_line[0][axis][0][axis] = 1.0);
        }
        [(self.line, by_line), (self.node, by_turn)]
    }
}

impl Frames {
    /// Those that rods carry.
    pub fn carried(&self) -> &[Carried] {
        &self.carried
    }

    /// The same, to be changed.
    pub fn carried_mut(&mut self) -> &mut [Carried] {
        &mut self.carried
    }

    /// The carried frame that a node belongs to, and whether it is its second node.
    pub(in crate::body) fn carried_of<const D: usize>(
        &self,
        node: usize,
    ) -> Option<(&Carried, bool)> {
        if D == 2 || self.carried.is_empty() {
            return None;
        }
        let (index, is_second) = self.of_node[node]?;
        let carried = self.carried.get(index.checked_sub(self.list.len())?)?;
        Some((carried, is_second))
    }

    /// Axes at coordinates over the nodes, which hold rotations before.
    pub(super) fn place_carried<const D: usize>(
        &self,
        from: &[Quaternion],
        carries: &mut [Carry],
        x: &mut [Node<D>],
    ) {
        for ((frame, from), carry) in self.carried.iter().zip(from).zip(carries) {
            let [tangent, second, _] = axes(from);
            let slope = frame.slope(x);
            let (t, stretch) = (slope / slope.norm(), slope.norm());
            let rotation = x[frame.node][1][0];
            let base = rotated(&tangent, &t, &second);
            let second = base * rotation.cos() + t.cross(&base) * rotation.sin();
            *carry = Carry {
                from: tangent,
                tangent: t,
                stretch,
                rotation,
                ..Carry::default()
            };
            set_axes_at(frame.node, &[t, second, t.cross(&second)], x);
            x[frame.node][0] = x[frame.line][0];
        }
    }

    /// Rates of axes, whose places hold rates of rotations before.
    pub(super) fn place_carried_rates<const D: usize>(
        &self,
        x: &[Node<D>],
        carries: &mut [Carry],
        v: &mut [Node<D>],
    ) {
        for (frame, carry) in self.carried.iter().zip(carries) {
            let rate = frame.slope(v);
            carry.stretching = carry.tangent.dot(&rate) / carry.stretch;
            carry.rate = rate / carry.stretch - carry.tangent * carry.stretching;
            carry.spin = v[frame.node][1][0] - carry.by_tangent().dot(&carry.rate);
            let axes = frame.turned(x, v, carry.spin);
            set_axes_at(frame.node, &axes, v);
            v[frame.node][0] = v[frame.line][0];
        }
    }

    /// Changes of axes to first order, whose places hold small rotations about the tangents before.
    pub(super) fn place_carried_changes<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        dx: &mut [Node<D, N>],
    ) {
        for frame in &self.carried {
            let axes = frame.turned(x, dx, dx[frame.node][1][0]);
            set_axes_at(frame.node, &axes, dx);
            dx[frame.node][0] = dx[frame.line][0];
        }
    }

    /// Adds to accelerations of axes what rates alone ask for.
    pub(super) fn add_carried_centripetal<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        for frame in &self.carried {
            let (slope, rate, spin) = (frame.slope(x), frame.slope(v), frame.spin(x, v));
            let square = slope.norm_squared();
            let velocity = angular(&slope, &rate, spin);
            let turn = slope.cross(&rate) / square;
            let tangent_rate = turn.cross(&slope) / square.sqrt();
            let change = tangent_rate * spin - turn * (N::of(2.0) * slope.dot(&rate) / square);
            let (axes, rates, mut sum) = (frame.axes(x), frame.axes(v), frame.axes(a));
            for k in 0..3 {
                sum[k] += velocity.cross(&rates[k]) + change.cross(&axes[k]);
            }
            set_axes_at(frame.node, &sum, a);
        }
    }

    /// Forces over the nodes become those on lines, and moments about tangents.
    pub(super) fn pull_carried<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for frame in &self.carried {
            let axes = frame.axes(x);
            let moment = super::Frame::moment(&axes, &frame.axes(f));
            let on_center = f[frame.node][0];
            f[frame.node] = [[N::of(0.0); D]; 2];
            f[frame.node + 1] = [[N::of(0.0); D]; 2];
            let stretch = frame.slope(x).norm_squared().sqrt();
            let mut add = |node: usize, part: usize, force: [N; D]| {
                for (sum, force) in f[node][part].iter_mut().zip(force) {
                    *sum += force;
                }
            };
            add(frame.line, 0, on_center);
            frame.add_moment::<D, N>(&axes, &moment, stretch, &mut add);
        }
    }

    /// What a force on the position of a marker and a moment along the axes of its carried frame do to the nodes that have
    /// coordinates.
    pub(super) fn pull_on_carried<const D: usize, N: Number>(
        frame: &Carried,
        (force, moment): (&[N; D], &Vector3<N>),
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        let zero = [N::of(0.0); D];
        let stretch = frame.slope(x).norm_squared().sqrt();
        term(frame.line, &[*force, zero]);
        frame.add_moment::<D, N>(&frame.axes(x), moment, stretch, &mut |node, _, by| {
            term(node, &[zero, by]);
        });
    }

    /// [`Frames::partials`] of a node of a carried frame.
    pub(super) fn partials_of_carried<const D: usize>(
        &self,
        node: usize,
        x: &[Node<D>],
    ) -> Option<[(usize, NodeBlock<D>); 2]> {
        let (frame, is_second) = self.carried_of::<D>(node)?;
        Some(frame.partials(is_second, x))
    }

    /// Stiffness that forces on the axes of a carried frame add where it turns, over the coordinates of the line's node and its
    /// rotation: pairs of nodes and blocks. Of a rotation `a + p t` with `a = t x du / |u|` the second order is
    /// `p (a x t) / 2 - a (t.du) / |u|`.
    pub fn geometric_of_carried<const D: usize>(
        frame: &Carried,
        f: &[Node<D>],
        x: &[Node<D>],
    ) -> [((usize, usize), NodeBlock<D>); 3] {
        let (axes, forces, slope) = (frame.axes(x), axes_at(frame.node, f), frame.slope(x));
        let (stretch, t) = (slope.norm(), axes[0]);
        // Over small rotations in global components: sum (E.F) I - (F E^T + E F^T) / 2.
        let mut turning = Matrix3::zeros();
        let mut moment = Vector3::zeros();
        for (axis, force) in axes.iter().zip(&forces) {
            let product = force * axis.transpose();
            turning += Matrix3::from_diagonal_element(axis.dot(force))
                - (product + product.transpose()) * 0.5;
            moment += axis.cross(force);
        }
        let by_slope = t.cross_matrix() / stretch;
        let mut on_slope = by_slope.transpose() * turning * by_slope;
        let leaned = moment.cross(&t) * t.transpose() / (stretch * stretch);
        on_slope += leaned + leaned.transpose();
        let across = moment - t * moment.dot(&t);
        let mixed = by_slope.transpose() * turning * t - across * (0.5 / stretch);
        let on_turn = t.dot(&(turning * t));
        let [mut line, mut both, mut turn] = [no_block(), no_block(), no_block()];
        for r in 0..D {
            for c in 0..D {
                line[1][r][1][c] = on_slope[(r, c)];
            }
            both[1][0][1][r] = mixed[r];
        }
        turn[1][0][1][0] = on_turn;
        let (a, b) = (frame.line, frame.node);
        [((a, a), line), ((b, a), both), ((b, b), turn)]
    }

    /// Adds to what stands among free coordinates for rotations, small rotations about tangents or derivatives of spins, what the same
    /// derivatives of slopes make of them; `dx` are those over the nodes.
    pub fn turn_carried<const D: usize>(
        &self,
        order: Derivative,
        carries: &[Carry],
        dx: &[Node<D>],
        y: &mut [f64],
    ) {
        for (frame, carry) in self.carried.iter().zip(carries) {
            let ((at, scale), slope) = (frame.place, frame.slope(dx));
            y[at] += scale
                * match order {
                    Derivative::First => carry.rate_of(0.0, &slope),
                    Derivative::Second => carry.second_of(0.0, &slope),
                };
        }
    }

    /// The largest turn of a carried frame from that of the state, rad.
    pub fn largest_carry(&self, carries: &[Carry]) -> f64 {
        carries.iter().map(Carry::size).fold(0.0, f64::max)
    }

    /// Rotations of carried frames begin at zero anew: the frames of the state become those at these coordinates; what is in `q`
    /// and in `v`, both over the free coordinates, stands for nothing and for spins.
    pub fn renew_carried<const D: usize>(
        &self,
        (x, carries): (&[Node<D>], &[Carry]),
        frames: &mut [Quaternion],
        [q, v]: [&mut [f64]; 2],
    ) {
        let frames = &mut frames[self.list.len()..];
        for ((frame, carry), from) in self.carried.iter().zip(carries).zip(frames) {
            let (at, scale) = frame.place;
            *from = normalized(quaternion_near(&frame.axes(x), from));
            (q[at], v[at]) = (0.0, scale * carry.spin);
        }
    }
}
