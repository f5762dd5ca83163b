//! Rigid bodies of space: their natural coordinates, and how these follow from what is integrated.
//!
//! Joints, loads and outputs see the centre of mass `c` and the principal axes `e1 e2 e3` of a body, in two nodes: `(c, e1)`
//! and `(e2, e3)`. Points of the body are linear in these, as points of cables are in theirs. What is integrated
//! are the coordinates of the first node alone: `c`, and the rotation `p` from the frame that the state holds; the second
//! has none. With rates along the body's own axes the mass is constant, `diag(m, m, m, J1, J2, J3)`,
//! and so the identity in `q` as everywhere:
//!
//! `m c'' = F`, `J w' = sum e_i x f_i - w x J w`, `e_i' = w x e_i`,
//!
//! with `f_i` the force on the axis `e_i`. The rotation is the vector of Rodrigues, twice the tangent of half the angle
//! along the axis: `R = R0 (I + ([p] + [p]^2 / 2) / (1 + p.p / 4))`, as a quaternion `q0 (1, p / 2)` but for its length, `p' = w + p x w / 2 + p (p.w) / 4`. It begins at zero
//! anew before it is large ([`RENEWED`]), so that it is nowhere singular and nearly the angle.
//!
//! Source: J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), section 2.2 (natural
//! coordinates); M. Borri, L. Trainelli, C. L. Bottasso, On representations and parameterizations of motion,
//! Multibody System Dynamics 4 (2000) 129-193 (Cayley-Gibbs-Rodrigues parameters); H. Munthe-Kaas, BIT 38 (1998) 92-111
//! (one-step methods in coordinates that are renewed every step).

mod body;
mod derivatives;
mod section_frame;
mod shear_rotation;
mod tangent;
mod turn;

use nalgebra::{Matrix3, Vector3};

use super::connectivity::Node;
use super::map::Rotations;
use super::marker::Marker;
use crate::math::jet::Number;
use crate::math::rotation::{Quaternion, axes, normalized, quaternion};
use crate::math::space::{Vector, components, is_nothing, vector};

pub(super) use body::unplaced;
pub use derivatives::{AngularAccelerations, AxisMotion};
pub use section_frame::{Derivative, SectionFrame, SectionFrameState};
pub use tangent::turning_block;
pub use turn::RotationIncrement;

/// Size of the rotation `p` from which on the frame that the state holds is renewed.
pub const RENEWED: f64 = 0.5;

/// The principal axes of a body, in global components.
pub type Axes<N = f64> = [Vector3<N>; 3];

/// A rigid body of space.
#[derive(Clone, Debug)]
pub struct RigidBodyFrame {
    /// Index of the first node. The second node follows it.
    pub node: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Principal moments of inertia, kg m^2; zero about the axis of a thin rod.
    pub moments: [f64; 3],
    /// For every axis where its rotation is among the coordinates `q`, and how many of that make a radian; none about an axis
    /// without inertia.
    pub places: [Option<(usize, f64)>; 3],
}

/// The vector with these components along axes.
pub fn combined<N: Number>(axes: &Axes<N>, components: &Vector3<N>) -> Vector3<N> {
    axes[0] * components[0] + axes[1] * components[1] + axes[2] * components[2]
}

/// Rates of axes that turn at a spin along themselves.
pub fn turned<N: Number>([a, b, c]: &Axes<N>, spin: &Vector3<N>) -> Axes<N> {
    [
        b * spin[2] - c * spin[1],
        c * spin[0] - a * spin[2],
        a * spin[1] - b * spin[0],
    ]
}

/// The axes in a node and the one after it, or their rates where `x` holds rates.
pub fn axes_at<const D: usize, N: Number>(node: usize, x: &[Node<D, N>]) -> Axes<N> {
    let [[_, a], [b, c]] = [&x[node], &x[node + 1]];
    [a, b, c].map(|axis| components(&(*axis).into()).into())
}

/// Angular velocity along these axes, rad/s.
pub fn spin_at<const D: usize, N: Number>(
    node: usize,
    x: &[Node<D, N>],
    v: &[Node<D, N>],
) -> Vector3<N> {
    let ([a, b, c], [ra, rb, rc]) = (axes_at(node, x), axes_at(node, v));
    Vector3::new(c.dot(&rb), a.dot(&rc), b.dot(&ra))
}

/// Sets them.
fn set_axes_at<const D: usize, N: Number>(node: usize, axes: &Axes<N>, x: &mut [Node<D, N>]) {
    let [a, b, c] = axes.map(|axis| vector::<D, N>(axis.into()).into());
    x[node][1] = a;
    x[node + 1] = [b, c];
}

impl RigidBodyFrame {
    /// Returns the axes of the body, or their rates where `x` holds rates.
    pub fn axes<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> Axes<N> {
        axes_at(self.node, x)
    }

    /// Sets its axes, or their rates.
    pub fn set_axes<const D: usize, N: Number>(&self, axes: &Axes<N>, x: &mut [Node<D, N>]) {
        set_axes_at(self.node, axes, x);
    }

    /// Masses that the axes would need as coordinates, kg m^2: `J1 = m2 + m3` and so on.
    pub fn axis_masses(&self) -> [f64; 3] {
        let [a, b, c] = self.moments;
        [b + c - a, c + a - b, a + b - c].map(|twice| 0.5 * twice)
    }

    /// Returns the largest radius of gyration, m.
    pub fn gyration(&self) -> f64 {
        let largest = self.moments.iter().fold(0.0, |m, j| f64::max(m, *j));
        (largest / self.mass).sqrt()
    }

    /// Node and part of each of its vectors, and the mass that it would have as a coordinate: kg, then kg m^2.
    pub fn masses(&self) -> [(usize, usize, f64); 4] {
        let [a, b, c] = self.axis_masses();
        let [first, second] = [self.node, self.node + 1];
        [
            (first, 0, self.mass),
            (first, 1, a),
            (second, 0, b),
            (second, 1, c),
        ]
    }

    /// Angular velocity along its axes, rad/s.
    pub fn spin<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        v: &[Node<D, N>],
    ) -> Vector3<N> {
        spin_at(self.node, x, v)
    }

    /// Moment along its axes of forces on them, N m.
    pub fn moment<N: Number>([a, b, c]: &Axes<N>, [fa, fb, fc]: &Axes<N>) -> Vector3<N> {
        Vector3::new(
            c.dot(fb) - b.dot(fc),
            a.dot(fc) - c.dot(fa),
            b.dot(fa) - a.dot(fb),
        )
    }

    /// Forces on axes whose moment along them is this, N.
    pub fn on_axes<N: Number>([a, b, c]: &Axes<N>, moment: &Vector3<N>) -> Axes<N> {
        [b * moment[2], c * moment[0], a * moment[1]]
    }

    /// `-w x J w`, N m, along its axes.
    pub fn gyroscopic<N: Number>(&self, spin: &Vector3<N>) -> Vector3<N> {
        let [a, b, c] = self.moments.map(N::of);
        Vector3::new(
            (b - c) * spin[1] * spin[2],
            (c - a) * spin[2] * spin[0],
            (a - b) * spin[0] * spin[1],
        )
    }

    /// Angular momentum along its axes, N m s.
    pub fn momentum(&self, spin: &Vector3<f64>) -> Vector3<f64> {
        Vector3::from(self.moments).component_mul(spin)
    }

    /// Rate of its inertia over axes that stand still, `w J - J w` with the matrix of the cross product by the spin, N m s.
    pub fn inertia_rate(&self, spin: &Vector3<f64>) -> Matrix3<f64> {
        let (inertia, turn) = (
            Matrix3::from_diagonal(&self.moments.into()),
            spin.cross_matrix(),
        );
        turn * inertia - inertia * turn
    }

    /// Whether it has no rotation about an axis: a thin rod.
    pub fn is_thin(&self) -> bool {
        self.places.iter().any(Option::is_none)
    }

    /// Adds a moment along its axes to forces on the free coordinates.
    pub fn add_moment(&self, moment: &Vector3<f64>, y: &mut [f64]) {
        for (place, moment) in self.places.iter().zip(moment) {
            if let Some((at, _)) = place {
                y[*at] += moment;
            }
        }
    }

    /// Reads the rotation about the body's axes from the coordinates `q`.
    pub fn read(&self, q: &[f64]) -> Vector3<f64> {
        let value = |place: Option<(usize, f64)>| place.map_or(0.0, |(at, scale)| q[at] / scale);
        self.places.map(value).into()
    }
}

/// Meaning of the two vectors of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A position and a direction.
    Point,
    /// Two axes.
    Axes,
    /// Neither: numbers inside an element.
    Inner,
}

/// Stands for no frame in [`RotationMaps::of_node`].
const NO_FRAME: usize = usize::MAX;

/// The rigid bodies of a system in space, and the frames that its rods carry; none in the plane, so that what is asked of them
/// there is nothing when it is compiled (`D == 2`).
#[derive(Clone, Debug, Default)]
pub struct RotationMaps {
    list: Vec<RigidBodyFrame>,
    carried: Vec<SectionFrame>,
    /// For every node its body, or after those its carried frame, and whether it is the second node of that.
    of_node: Vec<Option<(usize, bool)>>,
}

impl RotationMaps {
    /// For these bodies and carried frames, among so many nodes, of which these are inside elements, and these hold directions of
    /// planar sections.
    pub fn new(
        list: Vec<RigidBodyFrame>,
        carried: Vec<SectionFrame>,
        nodes: (
            usize,
            impl Iterator<Item = usize>,
            impl Iterator<Item = usize>,
        ),
    ) -> Self {
        let (nodes, inner, planar) = nodes;
        let mut of_node = vec![None; nodes];
        inner.for_each(|node| of_node[node] = Some((NO_FRAME, false)));
        planar.for_each(|node| of_node[node] = Some((NO_FRAME, true)));
        let firsts = list.iter().map(|frame| frame.node);
        let firsts = firsts.chain(carried.iter().map(|frame| frame.node));
        for (index, first) in firsts.enumerate() {
            of_node[first] = Some((index, false));
            of_node[first + 1] = Some((index, true));
        }
        Self {
            list,
            carried,
            of_node,
        }
    }

    /// How many there are: bodies, then carried ones, in the order of the state's.
    pub fn count(&self) -> usize {
        self.list.len() + self.carried.len()
    }

    /// The bodies.
    pub fn list(&self) -> &[RigidBodyFrame] {
        &self.list
    }

    /// Adds a rigid body. [`Bodies::complete`](super::Bodies::complete) finds its nodes.
    pub fn push(&mut self, frame: RigidBodyFrame) {
        self.list.push(frame);
    }

    /// The bodies, to be changed.
    pub fn list_mut(&mut self) -> &mut [RigidBodyFrame] {
        &mut self.list
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty() && self.carried.is_empty()
    }

    /// The body that a node belongs to, and whether it is its second node.
    #[inline(always)]
    pub fn of_node<const D: usize>(&self, node: usize) -> Option<(&RigidBodyFrame, bool)> {
        if D == 2 || self.list.is_empty() {
            return None;
        }
        let (index, is_second) = self.of_node[node]?;
        Some((self.list.get(index)?, is_second))
    }

    /// Which body of [`Self::list`] a node is the first of.
    pub fn body_of(&self, node: usize) -> Option<usize> {
        let of = self.of_node.get(node).copied().flatten();
        let index = of
            .filter(|(_, is_second)| !is_second)
            .map(|(index, _)| index);
        index.filter(|index| *index < self.list.len())
    }

    /// Axes at coordinates over the nodes, which hold rotations before.
    pub fn place<const D: usize>(
        &self,
        from: &[Quaternion],
        rotations: &mut Rotations,
        x: &mut [Node<D>],
    ) {
        if D == 2 {
            return;
        }
        self.place_carried(&from[self.list.len()..], &mut rotations.sections, x);
        for ((frame, from), turn) in self.list.iter().zip(from).zip(&mut rotations.rigid) {
            turn.rotation = components(&x[frame.node][1].into()).into();
            frame.set_axes(&axes(&turn.quaternion(from)), x);
        }
    }

    /// Rates of axes, whose places hold rates of rotations before.
    pub fn place_rates<const D: usize>(
        &self,
        x: &[Node<D>],
        rotations: &mut Rotations,
        v: &mut [Node<D>],
    ) {
        if D == 2 {
            return;
        }
        self.place_carried_rates(x, &mut rotations.sections, v);
        for (frame, turn) in self.list.iter().zip(&mut rotations.rigid) {
            turn.rate = components(&v[frame.node][1].into()).into();
            turn.spin = turn.spin_of(&turn.rate);
            frame.set_axes(&turned(&frame.axes(x), &turn.spin), v);
        }
    }

    /// Changes of axes to first order, whose places hold small rotations about them before.
    pub fn place_changes<const D: usize, N: Number>(
        &self,
        x: &[Node<D, N>],
        dx: &mut [Node<D, N>],
    ) {
        if D == 2 {
            return;
        }
        self.place_carried_changes(x, dx);
        for frame in &self.list {
            let turn = components(&dx[frame.node][1].into()).into();
            frame.set_axes(&turned(&frame.axes(x), &turn), dx);
        }
    }

    /// Adds to accelerations of axes what their spins alone ask for: `w x (w x e)`.
    pub fn add_centripetal<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        a: &mut [Node<D, N>],
    ) {
        if D == 2 {
            return;
        }
        self.add_carried_centripetal((x, v), a);
        for frame in &self.list {
            let by_spin = turned(&frame.axes(v), &frame.spin(x, v));
            let sum = frame.axes(a);
            frame.set_axes(&std::array::from_fn(|k| sum[k] + by_spin[k]), a);
        }
    }

    /// Pulls forces on position and direction of a marker back to the coordinates of its body: forces and moments per
    /// node, passed to `term`. Returns false if the marker is on no body with a frame.
    #[inline(always)]
    pub fn pull_marker<const D: usize, N: Number>(
        &self,
        marker: &Marker<N>,
        forces: [&Vector<D, N>; 2],
        x: &[Node<D, N>],
        term: &mut impl FnMut(usize, &Node<D, N>),
    ) -> bool {
        if D == 2 || self.is_empty() || !marker.is_framed() {
            return false;
        }
        let axes = axes_at(marker.nodes[0], x);
        let along = |force: &Vector<D, N>| {
            let force = Vector3::from(components(force));
            Vector3::new(
                axes[0].dot(&force),
                axes[1].dot(&force),
                axes[2].dot(&force),
            )
        };
        let [point, direction] = marker.components();
        let mut moment = point.cross(&along(forces[0]));
        if !is_nothing(forces[1]) {
            moment += direction.cross(&along(forces[1]));
        }
        let force = (*forces[0]).into();
        match self.carried_of::<D>(marker.nodes[0]) {
            Some((frame, _)) => Self::pull_on_carried(frame, (&force, &moment), x, term),
            None => term(
                marker.nodes[0],
                &[force, vector::<D, N>(moment.into()).into()],
            ),
        }
        true
    }

    /// Forces over the nodes become those on centres of mass and moments along axes; with the spins of `v`, less what
    /// these ask for.
    pub fn pull_back<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], Option<&[Node<D, N>]>),
        f: &mut [Node<D, N>],
    ) {
        if D == 2 {
            return;
        }
        self.pull_carried(x, f);
        for frame in &self.list {
            let mut moment = RigidBodyFrame::moment(&frame.axes(x), &frame.axes(f));
            if let Some(v) = v {
                moment += frame.gyroscopic(&frame.spin(x, v));
            }
            f[frame.node][1] = vector::<D, N>(moment.into()).into();
            f[frame.node + 1] = [[N::of(0.0); D]; 2];
        }
    }

    /// Frames at nodal coordinates.
    pub fn frames_at<const D: usize>(&self, x: &[Node<D>], frames: &mut [Quaternion]) {
        let nodes = self.list.iter().map(|frame| frame.node);
        let nodes = nodes.chain(self.carried.iter().map(|frame| frame.node));
        for (node, at) in nodes.zip(frames) {
            *at = normalized(quaternion(&axes_at(node, x)));
        }
    }

    /// For every body its first node, its frame, and the quaternion at coordinates on the same side of it.
    pub fn quaternions<'a>(
        &'a self,
        frames: &'a mut [Quaternion],
        q: &'a [f64],
    ) -> impl Iterator<Item = (usize, &'a mut Quaternion, Quaternion)> {
        (self.list.iter().zip(frames)).map(|(frame, from)| {
            let now = normalized(frame.turn(q).quaternion(from));
            (frame.node, from, now)
        })
    }

    /// Returns the meaning of the two vectors of a node.
    pub fn kind(&self, node: usize) -> NodeKind {
        match self.of_node.get(node).copied().flatten() {
            Some((NO_FRAME, false)) => NodeKind::Inner,
            Some((_, true)) => NodeKind::Axes,
            _ => NodeKind::Point,
        }
    }

    /// Whether a node belongs to a frame or is inside an element: rows between its numbers are none that joints see.
    pub fn holds(&self, node: usize) -> bool {
        let of = self.of_node.get(node).copied().flatten();
        of.is_some_and(|of| of != (NO_FRAME, true))
    }

    /// Whether a node is the first of a frame, which its axes begin in.
    pub fn has_axes(&self, node: usize) -> bool {
        self.kind(node) == NodeKind::Point && self.holds(node)
    }

    /// The place of the frame that a node belongs to, in the order of the state's.
    pub fn index_of(&self, node: usize) -> Option<usize> {
        self.of_node
            .get(node)
            .copied()
            .flatten()
            .map(|(index, _)| index)
    }
}
