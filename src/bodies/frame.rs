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
mod increment;
mod section_frame;
mod shear_rotation;
mod tangent;

use nalgebra::{Matrix3, Vector3};

use super::connectivity::Node;
use crate::math::jet::Number;
use crate::math::space::{Vector, components, vector};

pub(super) use body::unplaced;
pub use derivatives::{AngularAccelerations, AxisMotion};
pub use increment::RotationIncrement;
pub(super) use increment::{spin_of, turned_back};
pub use section_frame::{Derivative, SectionFrame, SectionFrameState};
pub use tangent::rotation_block;
pub(super) use tangent::{geometric, part_block};

/// Size of the rotation `p` from which on the frame that the state holds is renewed.
pub const RENEWED: f64 = 0.5;

/// The principal axes of a body, in global components.
pub type Axes<N = f64> = [Vector3<N>; 3];

/// A rigid body of space.
#[derive(Clone, Debug)]
pub struct RigidBodyFrame {
    /// Index of the first node. The second node follows it.
    pub node: usize,
    /// Index among the rigid bodies of space.
    pub(super) index: usize,
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

/// Components of a vector along axes.
#[inline(always)]
pub(super) fn along<const D: usize, N: Number>(axes: &Axes<N>, v: &Vector<D, N>) -> Vector3<N> {
    let v = Vector3::from(components(v));
    Vector3::from_fn(|k, _| axes[k].dot(&v))
}

/// Rates of axes that rotate at a spin along themselves.
pub fn axis_rates<N: Number>([a, b, c]: &Axes<N>, spin: &Vector3<N>) -> Axes<N> {
    [
        b * spin[2] - c * spin[1],
        c * spin[0] - a * spin[2],
        a * spin[1] - b * spin[0],
    ]
}

/// The axes in a node and the one after it, or their rates where `x` holds rates; the third one is zero in the plane, see [`completed`].
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

/// Axes whose third one nodes of the plane do not hold: there it is across the plane.
#[inline(always)]
pub fn completed<const D: usize, N: Number>(mut axes: Axes<N>) -> Axes<N> {
    if D == 2 {
        axes[2] = Vector3::z().map(N::of);
    }
    axes
}

/// Numbers of a node that count rotations, with the axes of these: in the plane the first one, about the third axis.
pub(super) fn rotation_axes<const D: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..3).skip(if D == 2 { 2 } else { 0 }).enumerate()
}

/// A rotation, spin or moment along the axes of a body, from the numbers of a node.
#[inline(always)]
pub(super) fn rotation_of<const D: usize, N: Number>(numbers: &[N; D]) -> Vector3<N> {
    if D == 2 {
        let zero = N::of(0.0);
        return Vector3::new(zero, zero, numbers[0]);
    }
    components(&(*numbers).into()).into()
}

/// Numbers of a node for a rotation, spin or moment along the axes of a body.
#[inline(always)]
pub(super) fn rotation_numbers<const D: usize, N: Number>(rotation: &Vector3<N>) -> [N; D] {
    if D == 2 {
        return std::array::from_fn(|k| if k == 0 { rotation[2] } else { N::of(0.0) });
    }
    vector::<D, N>((*rotation).into()).into()
}

/// Sets them.
pub(super) fn set_axes_at<const D: usize, N: Number>(
    node: usize,
    axes: &Axes<N>,
    x: &mut [Node<D, N>],
) {
    let [a, b, c] = axes.map(|axis| vector::<D, N>(axis.into()).into());
    x[node][1] = a;
    x[node + 1] = [b, c];
}

impl RigidBodyFrame {
    /// With its first node, mass (kg) and principal moments of inertia (kg m^2). A system finds where its rotations are.
    pub fn new(node: usize, mass: f64, moments: [f64; 3]) -> Self {
        Self {
            node,
            index: 0,
            mass,
            moments,
            places: [None; 3],
        }
    }

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
