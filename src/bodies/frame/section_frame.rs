//! Frames that rods and beams transport along their lines. Of rods the first axis is the tangent, the others are rotated about it; sections of
//! beams have a shear rotation against it, three coordinates and are in `shear_rotation.rs`.
//!
//! Of a rod what is integrated is position and slope `(r, u)` of the node of the line and one rotation `p` about the tangent `t = u / |u|`,
//! measured from where the smallest rotation that takes the tangent `t0` of the frame which the state holds to `t` carries its second
//! axis: `e2 = turn(p, t) carry(t0, t, d0)`. With `h = t0 x t / (1 + t0.t)` the spin about the tangent is `w = p' - h.t'`, the angular
//! velocity `t x t' + w t`. A moment `m` is `(m x u) / u.u` on the slope and `m.t` on the rotation; conjugate to the spin, which is
//! no rate of a coordinate, a momentum `P` puts the force `P (t x t') / |u|` on the slope.
//!
//! Source: M. Bergou et al., Discrete elastic rods, ACM Trans. Graph. 27 (2008) 63 (transported frames and their variation); C. Meier,
//! A. Popp, W. A. Wall, Geometrically exact finite element formulations for slender beams, Arch. Comput. Methods Eng. 26 (2019)
//! 163-243, section 4 (smallest rotations on Hermite lines).

use nalgebra::Vector3;

use super::shear_rotation::ShearRotation;
use super::{Axes, axes_at, axis_rates, combined, set_axes_at, spin_at};
use crate::bodies::connectivity::Node;
use crate::bodies::stages::rotated;
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, axes, normalized, quaternion_near};
use crate::math::space::{components, vector};

/// A frame at a node of a rod or beam.
#[derive(Clone, Debug)]
pub struct SectionFrame {
    /// Index of the first node. The second node follows it. Both hold position and axes, like the nodes of a rigid
    /// body.
    pub node: usize,
    /// The node of the line that it is at.
    pub line: usize,
    /// Whether it has a shear rotation against the tangent, as those of beams do: three coordinates; else one, the rotation about the tangent.
    pub has_shear: bool,
    /// Where its rotations are among the free coordinates, and how many of that make a radian; none where the ground holds it.
    pub places: [Option<(usize, f64)>; 3],
}

/// Conversion of a vector between spins and rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// Spins become rates of rotations, or small rotations about axes become changes of rotations.
    First,
    /// Rates of spins become second derivatives of rotations.
    Second,
    /// Rates of rotations become spins, or changes of rotations become small rotations about axes.
    Back,
}

/// How a transported frame has rotated from the one that the state holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionFrameState {
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
    /// Shear rotation of a beam's section.
    shear_rotation: ShearRotation,
}

impl SectionFrameState {
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

    /// How far it has rotated, rad: as a whole or about the tangent.
    pub fn size(&self, frame: &SectionFrame) -> f64 {
        if frame.has_shear {
            return self.shear_rotation.size();
        }
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
pub(super) fn angular<N: Number>(slope: &Vector3<N>, rate: &Vector3<N>, spin: N) -> Vector3<N> {
    slope.cross(rate) / slope.norm_squared() + slope * (spin / slope.norm_squared().sqrt())
}

/// Rates of axes that rotate at an angular velocity in global components.
fn axis_rates_by<N: Number>(axes: &Axes<N>, velocity: &Vector3<N>) -> Axes<N> {
    axes.map(|axis| velocity.cross(&axis))
}

impl SectionFrame {
    /// At a node of a line, with its own first node. A system finds where its rotations are.
    pub fn new(node: usize, line: usize, has_shear: bool) -> Self {
        Self {
            node,
            line,
            has_shear,
            places: [None; 3],
        }
    }

    /// Returns the axes of the section, or their rates where `x` holds rates.
    pub fn axes<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Axes<N> {
        axes_at(self.node, x)
    }

    /// How many coordinates it has.
    pub fn rotations(&self) -> usize {
        if self.has_shear { 3 } else { 1 }
    }

    /// Returns the free rotation rates along the section axes, rad/s: the angular velocity of a beam's section, only
    /// the part about the tangent for a rod. Where `v` holds changes, the result is a small rotation, rad.
    pub fn spin<const D: usize, N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> [N; 3] {
        if self.has_shear {
            return spin_at(self.node, x, v).into();
        }
        let ([_, _, third], [_, second, _]) = (self.axes(x), self.axes(v));
        [third.dot(&second), N::of(0.0), N::of(0.0)]
    }

    /// Rates of these, rad/s^2, at these accelerations: `sum e x e'' / 2` along the axes.
    pub fn spin_rate<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        a: &[Node<D, N>],
    ) -> [N; 3] {
        let (axes, rates) = (self.axes(x), self.axes(a));
        let mut along = [N::of(0.0); 3];
        for (k, along) in along.iter_mut().enumerate().take(self.rotations()) {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            *along = (axes[j].dot(&rates[i]) - axes[i].dot(&rates[j])) * N::of(0.5);
        }
        along
    }

    /// Returns the angular velocity in global axes, rad/s.
    pub fn velocity<const D: usize>(&self, x: &[Node<D>], v: &[Node<D>]) -> Vector3<f64> {
        let spin = self.spin(x, v);
        if self.has_shear {
            combined(&self.axes(x), &spin.into())
        } else {
            angular(&self.slope(x), &self.slope(v), spin[0])
        }
    }

    /// Sets its axes, or their rates.
    pub fn set_axes<const D: usize, N: Number>(&self, axes: &Axes<N>, x: &mut [Node<D, N>]) {
        set_axes_at(self.node, axes, x);
    }

    pub(in crate::bodies) fn slope<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
    ) -> Vector3<N> {
        part(&x[self.line], 1)
    }

    /// Reads the three rotations from the free coordinates.
    fn read(&self, y: &[f64]) -> Vector3<f64> {
        let value = |place: Option<(usize, f64)>| place.map_or(0.0, |(at, scale)| y[at] / scale);
        self.places.map(value).into()
    }

    fn write(&self, rotations: &Vector3<f64>, y: &mut [f64]) {
        for (place, value) in self.places.into_iter().zip(rotations) {
            if let Some((at, scale)) = place {
                y[at] = value * scale;
            }
        }
    }

    /// Changes of its axes by small rotations along them; of a rod's by one about the tangent and by the change of the slope in `dx`.
    /// So do angular accelerations.
    pub fn axis_rates<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        dx: &[Node<D, N>],
        spin: [N; 3],
    ) -> Axes<N> {
        let axes = self.axes(x);
        if self.has_shear {
            return axis_rates(&axes, &spin.into());
        }
        axis_rates_by(&axes, &angular(&self.slope(x), &self.slope(dx), spin[0]))
    }

    /// Returns the gyroscopic term of a momentum conjugate to the spins, N m s. For a rod it is the force `P (t x t') /
    /// |u|` on the slope. For a beam it is the moment `-w x P` along the axes, N m.
    pub fn gyroscopic<N: Number>(
        &self,
        momentum: [N; 3],
        [slope, rate, spin]: [&Vector3<N>; 3],
    ) -> Vector3<N> {
        if self.has_shear {
            return Vector3::from(momentum).cross(spin);
        }
        let square = slope.norm_squared();
        slope.cross(rate) * (momentum[0] / (square * square.sqrt()))
    }

    /// Adds the gyroscopic term at coordinates and rates of the nodes to forces: on the slope of the line for a rod, on
    /// the frame for a beam.
    pub fn add_gyroscopic<const D: usize, N: Number>(
        &self,
        momentum: [N; 3],
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        force: &mut [Node<D, N>],
    ) {
        let (slope, rate, spin) = (self.slope(x), self.slope(v), self.spin(x, v).into());
        let asked = self.gyroscopic(momentum, [&slope, &rate, &spin]);
        let node = if self.has_shear { self.node } else { self.line };
        for (sum, f) in force[node][1].iter_mut().zip(&asked) {
            *sum += *f;
        }
    }

    /// Adds what a moment along its axes does to forces over the nodes that have coordinates.
    fn add_moment<const D: usize, N: Number>(
        &self,
        [_, second, third]: &Axes<N>,
        moment: &Vector3<N>,
        stretch: N,
        f: &mut impl FnMut(usize, usize, [N; D]),
    ) {
        if self.has_shear {
            return f(self.node, 1, vector::<D, N>((*moment).into()).into());
        }
        let across = (second * moment[2] - third * moment[1]) / stretch;
        f(self.line, 1, vector::<D, N>(across.into()).into());
        let zero = N::of(0.0);
        f(self.node, 1, vector::<D, N>([moment[0], zero, zero]).into());
    }
}

impl SectionFrame {
    /// Whether the ground holds it.
    pub fn is_held(&self) -> bool {
        self.places[0].is_none()
    }

    /// Axes at coordinates over the nodes, which hold rotations before.
    pub fn place<const D: usize>(
        &self,
        from: &Quaternion,
        carry: &mut SectionFrameState,
        x: &mut [Node<D>],
    ) {
        let slope = self.slope(x);
        x[self.node][0] = x[self.line][0];
        if self.has_shear {
            let rotation = part(&x[self.node], 1);
            let (shear_rotation, axes) = ShearRotation::placed(from, slope, rotation);
            carry.shear_rotation = shear_rotation;
            return self.set_axes(&axes, x);
        }
        let [tangent, second, _] = axes(from);
        let (t, stretch) = (slope / slope.norm(), slope.norm());
        let rotation = x[self.node][1][0];
        let base = rotated(&tangent, &t, &second);
        let second = base * rotation.cos() + t.cross(&base) * rotation.sin();
        *carry = SectionFrameState {
            from: tangent,
            tangent: t,
            stretch,
            rotation,
            ..SectionFrameState::default()
        };
        self.set_axes(&[t, second, t.cross(&second)], x);
    }

    /// Rates of axes, whose places hold rates of rotations before.
    pub fn place_rates<const D: usize>(
        &self,
        x: &[Node<D>],
        carry: &mut SectionFrameState,
        v: &mut [Node<D>],
    ) {
        let rate = self.slope(v);
        v[self.node][0] = v[self.line][0];
        if self.has_shear {
            let rotation_rate = part(&v[self.node], 1);
            carry.shear_rotation.set_rates(rate, rotation_rate);
            let axes = self.axis_rates(x, v, carry.shear_rotation.spin.into());
            return self.set_axes(&axes, v);
        }
        carry.stretching = carry.tangent.dot(&rate) / carry.stretch;
        carry.rate = rate / carry.stretch - carry.tangent * carry.stretching;
        carry.spin = v[self.node][1][0] - carry.by_tangent().dot(&carry.rate);
        let axes = self.axis_rates(x, v, [carry.spin, 0.0, 0.0]);
        self.set_axes(&axes, v);
    }

    /// Changes of axes to first order, whose places hold small rotations before: along them, of rods about the tangents.
    pub fn place_changes<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        dx: &mut [Node<D, N>],
    ) {
        let small: Vector3<N> = part(&dx[self.node], 1);
        let axes = self.axis_rates(x, dx, small.into());
        self.set_axes(&axes, dx);
        dx[self.node][0] = dx[self.line][0];
    }

    /// Adds to accelerations of axes what rates alone ask for.
    pub fn add_centripetal<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        let spin = self.spin(x, v);
        if self.has_shear {
            let by_spin = axis_rates(&self.axes(v), &spin.into());
            let sum = self.axes(a);
            let sum = std::array::from_fn(|k| sum[k] + by_spin[k]);
            return self.set_axes(&sum, a);
        }
        let (slope, rate, spin) = (self.slope(x), self.slope(v), spin[0]);
        let square = slope.norm_squared();
        let velocity = angular(&slope, &rate, spin);
        let turn = slope.cross(&rate) / square;
        let tangent_rate = turn.cross(&slope) / square.sqrt();
        let change = tangent_rate * spin - turn * (N::of(2.0) * slope.dot(&rate) / square);
        let (axes, rates, mut sum) = (self.axes(x), self.axes(v), self.axes(a));
        for k in 0..3 {
            sum[k] += velocity.cross(&rates[k]) + change.cross(&axes[k]);
        }
        self.set_axes(&sum, a);
    }

    /// Forces over the nodes become those on lines, and moments about tangents.
    pub fn pull_back<const D: usize, N: Number>(&self, x: &[Node<D, N>], f: &mut [Node<D, N>]) {
        let axes = self.axes(x);
        let moment = super::RigidBodyFrame::moment(&axes, &self.axes(f));
        let on_center = f[self.node][0];
        f[self.node] = [[N::of(0.0); D]; 2];
        f[self.node + 1] = [[N::of(0.0); D]; 2];
        let stretch = self.slope(x).norm_squared().sqrt();
        let mut add = |node: usize, part: usize, force: [N; D]| {
            for (sum, force) in f[node][part].iter_mut().zip(force) {
                *sum += force;
            }
        };
        add(self.line, 0, on_center);
        self.add_moment::<D, N>(&axes, &moment, stretch, &mut add);
    }

    /// Part of forces over the nodes of the frame that acts on position and slope of the line.
    pub fn on_line<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        f: &[Node<D, N>],
    ) -> Node<D, N> {
        let (axes, stretch) = (self.axes(x), self.slope(x).norm_squared().sqrt());
        let moment = super::RigidBodyFrame::moment(&axes, &self.axes(f));
        let mut sum = [f[self.node][0], [N::of(0.0); D]];
        self.add_moment::<D, N>(&axes, &moment, stretch, &mut |node, part, by| {
            if node == self.line {
                sum[part] = by;
            }
        });
        sum
    }

    /// Pulls a force on the position of a marker and a moment along the axes of its section frame back to nodal
    /// coordinates, passed to `term`.
    pub fn pull_marker<const D: usize, N: Number>(
        &self,
        (force, moment): (&[N; D], &Vector3<N>),
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) {
        let zero = [N::of(0.0); D];
        let stretch = self.slope(x).norm_squared().sqrt();
        term(self.line, &[*force, zero]);
        self.add_moment::<D, N>(&self.axes(x), moment, stretch, &mut |node, _, by| {
            term(node, &[zero, by]);
        });
    }

    /// Adds to its rotations among free coordinates, small rotations about tangents or derivatives of spins, what the same derivatives of
    /// slopes make of them; `dx` are those over the nodes.
    pub fn convert<const D: usize>(
        &self,
        order: Derivative,
        carry: &SectionFrameState,
        dx: &[Node<D>],
        y: &mut [f64],
    ) {
        let slope = self.slope(dx);
        if self.has_shear {
            let spin = self.read(y);
            let changed = match order {
                Derivative::First => carry.shear_rotation.change_of(&spin, &slope),
                Derivative::Second => carry.shear_rotation.second_of(&spin, &slope),
                Derivative::Back => carry.shear_rotation.spin_of(&spin, &slope),
            };
            return self.write(&changed, y);
        }
        let Some((at, scale)) = self.places[0] else {
            return;
        };
        y[at] += scale
            * match order {
                Derivative::First => carry.rate_of(0.0, &slope),
                Derivative::Second => carry.second_of(0.0, &slope),
                Derivative::Back => -carry.rate_of(0.0, &slope),
            };
    }

    /// Lets the rotation begin at zero anew: the frame of the state becomes the one at these coordinates; what is in `q`
    /// and in `v`, both over the free coordinates, stands for nothing and for spins.
    pub fn renew<const D: usize>(
        &self,
        (x, carry): (&[Node<D>], &SectionFrameState),
        from: &mut Quaternion,
        [q, v]: [&mut [f64]; 2],
    ) {
        let axes = self.axes(x);
        *from = normalized(quaternion_near(&axes, from));
        if self.has_shear {
            self.write(&Vector3::zeros(), q);
            return self.write(&carry.shear_rotation.rate_anew(&axes), v);
        }
        if let Some((at, scale)) = self.places[0] {
            (q[at], v[at]) = (0.0, scale * carry.spin);
        }
    }
}
