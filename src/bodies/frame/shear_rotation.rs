//! Frames of sections with a shear rotation against the tangent of their line, those of beams: how they follow from the slope and three coordinates.
//!
//! With `R0` the frame that the state holds, `tau = R0^T u / |u|` the tangent along its axes, `cay(x)` the rotation by the vector of
//! Rodrigues `x` (twice the tangent of half the angle along the axis) and `roll(p_1)` that by the angle `p_1` about the first axis, the
//! frame is
//!
//! ```text
//! R = R0 cay(s) cay(e) roll(p_1),   s = 2 (0, -tau_3, tau_2) / (1 + tau_1),   e = (0, p_2, p_3) - s         (1)
//! ```
//!
//! The first rotation is the smallest that takes the first axis of `R0` to the tangent, so that where `e` stays, the section follows
//! the tangent and its shear does not change, however far the tangent rotates: a shear stiffness of any size leaves increments of `u` and
//! `p` that are found from linearized equations what they are. At `p = 0` the frame is `R0` whatever the shear rotation. A section that spins about
//! its normal moves by an angle, at a constant rate: what methods integrate without error.
//!
//! With the angular velocity `w(x, x') = (x' - x x x' / 2) / (1 + x.x / 4)` of `cay(x)` along its own axes, that of the section is
//!
//! ```text
//! w = (p_1', 0, 0) + roll(p_1)^T (w(e, e') + cay(e)^T w(s, s'))                                             (2)
//! ```
//!
//! Source: M. Borri, L. Trainelli, C. L. Bottasso, On representations and parameterizations of motion, Multibody System Dynamics 4
//! (2000) 129-193 (Rodrigues' vectors); M. Bergou et al., Discrete elastic rods, ACM Trans. Graph. 27 (2008) 63 (smallest rotations).

use nalgebra::{Matrix3, Vector3};

use super::increment::{spin_of, turned_back};
use crate::math::jet::{Jet, Number, part};
use crate::math::lanes::Real;
use crate::math::rotation::{Quaternion, axes, product};

/// Rotation of the frame of a sheared section from the one that the state holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ShearRotation {
    /// The frame of the state: its axes are the columns.
    from: Matrix3<f64>,
    /// Slope and its rate, 1/s.
    slope: [Vector3<f64>; 2],
    /// `p`, rad, its rate, and the angular velocity along the axes of the section, rad/s.
    rotation: Vector3<f64>,
    rate: Vector3<f64>,
    pub spin: Vector3<f64>,
}

/// `s` of (1), and its rate.
fn smallest<N: Number>(tau: &Vector3<N>, rate: &Vector3<N>) -> [Vector3<N>; 2] {
    let scale = N::of(2.0) / (N::of(1.0) + tau[0]);
    let normal = |of: &Vector3<N>| Vector3::new(N::of(0.0), -of[2], of[1]);
    let s = normal(tau) * scale;
    [s, normal(rate) * scale - s * (rate[0] * scale * N::of(0.5))]
}

/// The part across the first axis.
fn across<N: Number>(x: &Vector3<N>) -> Vector3<N> {
    Vector3::new(N::of(0.0), x[1], x[2])
}

/// A vector along axes that have rotated about the first one, by an angle of this sine and cosine, along those before.
fn unrolled<N: Number>(v: &Vector3<N>, (sine, cosine): (N, N)) -> Vector3<N> {
    Vector3::new(
        v[0],
        v[1] * cosine - v[2] * sine,
        v[2] * cosine + v[1] * sine,
    )
}

/// Rate of `p` from the angular velocity of the section along its axes, at a tangent and its rate.
fn rotation_rate<N: Number>(
    p: &Vector3<N>,
    [tau, rate]: [&Vector3<N>; 2],
    spin: &Vector3<N>,
) -> Vector3<N> {
    let [s, s_rate] = smallest(tau, rate);
    let e = across(p) - s;
    let by_tangent = turned_back(&e, &spin_of(&s, &s_rate));
    let own = across(&(unrolled(spin, p[0].sine_cosine()) - by_tangent));
    let e_rate = own * (N::of(1.0) + N::of(0.25) * e.norm_squared());
    let mut turning = s_rate + e_rate;
    turning[0] = spin[0] - by_tangent[0] - spin_of(&e, &e_rate)[0];
    turning
}

impl ShearRotation {
    /// Computes the section axes for a rotation and a slope relative to the frame of the state. Returns the
    /// intermediate values together with the axes.
    pub fn placed(
        from: &Quaternion,
        slope: Vector3<f64>,
        rotation: Vector3<f64>,
    ) -> (Self, [Vector3<f64>; 3]) {
        let shear_rotation = Self {
            from: Matrix3::from_columns(&axes(from)),
            slope: [slope, Vector3::zeros()],
            rotation,
            ..Self::default()
        };
        let [s, _] = smallest(&shear_rotation.tangent()[0], &Vector3::zeros());
        let half = |x: Vector3<f64>| [1.0, 0.5 * x.x, 0.5 * x.y, 0.5 * x.z];
        let sheared = product(&product(from, &half(s)), &half(across(&rotation) - s));
        let (sine, cosine) = (0.5 * rotation[0]).sin_cos();
        (
            shear_rotation,
            axes(&product(&sheared, &[cosine, sine, 0.0, 0.0])),
        )
    }

    /// The tangent along the axes of the state's frame, and its rate, 1/s.
    fn tangent(&self) -> [Vector3<f64>; 2] {
        self.tangent_and(&self.slope[1])
    }

    /// The tangent along the axes of the state's frame, and its change at one of the slope.
    fn tangent_and(&self, change: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let slope = &self.slope[0];
        let [tau, change] = [slope, change].map(|v| self.from.tr_mul(v) / slope.norm());
        [tau, change - tau * tau.dot(&change)]
    }

    /// Takes a rate of the slope and of the rotation: its angular velocity follows.
    pub fn set_rates(&mut self, slope: Vector3<f64>, rate: Vector3<f64>) {
        (self.slope[1], self.rate) = (slope, rate);
        self.spin = self.spin_of(&rate, &slope);
    }

    /// Angular velocity along the section's axes, or a small rotation about them, of a change of the rotation and one of the slope.
    pub fn spin_of(&self, rate: &Vector3<f64>, slope: &Vector3<f64>) -> Vector3<f64> {
        let [tau, change] = self.tangent_and(slope);
        let [s, s_rate] = smallest(&tau, &change);
        let e = across(&self.rotation) - s;
        let sheared =
            spin_of(&e, &(across(rate) - s_rate)) + turned_back(&e, &spin_of(&s, &s_rate));
        let (sine, cosine) = self.rotation[0].sin_cos();
        let spin = unrolled(&sheared, (-sine, cosine));
        Vector3::new(spin[0] + rate[0], spin[1], spin[2])
    }

    /// Change of the rotation by a small rotation along the section's axes and a change of the slope.
    pub fn change_of(&self, spin: &Vector3<f64>, slope: &Vector3<f64>) -> Vector3<f64> {
        let [tau, change] = self.tangent_and(slope);
        rotation_rate(&self.rotation, [&tau, &change], spin)
    }

    /// Second derivative of the rotation, rad/s^2, of those of the angular velocity and of the slope: the derivative of its rate along
    /// the motion.
    pub fn second_of(&self, spin_rate: &Vector3<f64>, slope: &Vector3<f64>) -> Vector3<f64> {
        let [u, rate] = self.slope.map(|v| self.from.tr_mul(&v));
        let second = self.from.tr_mul(slope);
        let moving = |k: usize| Jet::new(u[k], rate[k], second[k]);
        let u = Vector3::from_fn(|k, _| moving(k));
        let tau = u / u.norm_squared().root();
        let along = |order: usize| {
            Vector3::from_fn(|k, _| {
                let [now, later] = [order, order + 1].map(|order| part(tau[k], order));
                Jet::new(now, later, 0.0)
            })
        };
        let p = Vector3::from_fn(|k, _| Jet::new(self.rotation[k], self.rate[k], 0.0));
        let spin = Vector3::from_fn(|k, _| Jet::new(self.spin[k], spin_rate[k], 0.0));
        rotation_rate(&p, [&along(0), &along(1)], &spin).map(|rate| rate.v1)
    }

    /// The rate of the rotation where it is counted from the frame with these axes, at the same motion.
    pub fn rate_anew(&self, axes: &[Vector3<f64>; 3]) -> Vector3<f64> {
        let anew = Self {
            from: Matrix3::from_columns(axes),
            rotation: Vector3::zeros(),
            ..*self
        };
        let [tau, rate] = anew.tangent();
        rotation_rate(&anew.rotation, [&tau, &rate], &self.spin)
    }

    /// How far it has rotated, rad: itself, or the tangent.
    pub fn size(&self) -> f64 {
        let [s, _] = smallest(&self.tangent()[0], &Vector3::zeros());
        self.rotation.norm().max(s.norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::frame::Axes;
    use crate::math::rotation::normalized;

    const FROM: Quaternion = [0.6, -0.3, 0.5, 0.4];

    /// Slope and rotation that change in time, and their rates.
    fn path(t: f64) -> [[Vector3<f64>; 3]; 2] {
        let from = Matrix3::from_columns(&axes(&normalized(FROM)));
        let u = |k: usize| {
            // 1.1 + t, 0.3 - 0.5 t^2, 0.2 + 0.4 t along the axes of the state's frame.
            let along = match k {
                0 => Vector3::new(1.1 + t, 0.3 - 0.5 * t * t, 0.2 + 0.4 * t),
                1 => Vector3::new(1.0, -t, 0.4),
                _ => Vector3::new(0.0, -1.0, 0.0),
            };
            from * along
        };
        let p = |k: usize| match k {
            0 => Vector3::new(0.1 + 0.7 * t, 0.2 * t * t, 0.3 - 0.4 * t),
            1 => Vector3::new(0.7, 0.4 * t, -0.4),
            _ => Vector3::new(0.0, 0.4, 0.0),
        };
        [[u(0), u(1), u(2)], [p(0), p(1), p(2)]]
    }

    fn at(t: f64) -> (ShearRotation, Axes) {
        let [[u, rate, _], [p, p_rate, _]] = path(t);
        let (mut shear_rotation, axes) = ShearRotation::placed(&normalized(FROM), u, p);
        shear_rotation.set_rates(rate, p_rate);
        (shear_rotation, axes)
    }

    fn near(a: Vector3<f64>, b: Vector3<f64>, bound: f64) {
        assert!((a - b).norm() < bound, "{a} {b}");
    }

    #[test]
    fn rates_and_second_derivatives_are_those_of_the_motion() {
        let (h, t) = (1e-4, 0.3);
        let (shear_rotation, frame) = at(t);
        let [(before, back), (after, forth)] = [t - h, t + h].map(at);
        let rate: Axes = std::array::from_fn(|k| (forth[k] - back[k]) / (2.0 * h));
        let spin = Vector3::new(
            frame[2].dot(&rate[1]),
            frame[0].dot(&rate[2]),
            frame[1].dot(&rate[0]),
        );
        near(spin, shear_rotation.spin, 1e-8);
        let spin_rate = (after.spin - before.spin) / (2.0 * h);
        let [[_, slope, second], [_, rate, wanted]] = path(t);
        near(shear_rotation.second_of(&spin_rate, &second), wanted, 1e-7);
        near(
            shear_rotation.change_of(&shear_rotation.spin, &slope),
            rate,
            1e-14,
        );
        near(
            shear_rotation.spin_of(&rate, &slope),
            shear_rotation.spin,
            1e-14,
        );
    }

    #[test]
    fn frames_that_begin_anew_go_on() {
        let (shear_rotation, frame) = at(0.3);
        let quaternion = crate::math::rotation::quaternion(&frame);
        let [[u, rate, _], _] = path(0.3);
        let (mut anew, same) = ShearRotation::placed(&quaternion, u, Vector3::zeros());
        for (a, b) in frame.iter().zip(&same) {
            near(*a, *b, 1e-14);
        }
        anew.set_rates(rate, shear_rotation.rate_anew(&frame));
        near(anew.spin, shear_rotation.spin, 1e-14);
    }

    #[test]
    fn a_steady_spin_about_the_normal_is_an_angle_that_grows_steadily() {
        let from = normalized(FROM);
        let [normal, ..] = axes(&from);
        let still = Vector3::zeros();
        let (mut shear_rotation, _) =
            ShearRotation::placed(&from, normal * 1.2, Vector3::new(2.5, 0.0, 0.0));
        let rate = Vector3::new(300.0, 0.0, 0.0);
        shear_rotation.set_rates(still, rate);
        near(shear_rotation.spin, rate, 1e-13);
        near(shear_rotation.second_of(&still, &still), still, 1e-10);
    }

    #[test]
    fn a_section_follows_its_tangent_where_the_coordinates_do() {
        let from = normalized(FROM);
        let axes_of = |u| axes(&from).map(|axis: Vector3<f64>| axis.dot(&u));
        let u = Vector3::new(0.4, 0.9, -0.3);
        let (shear_rotation, _) = ShearRotation::placed(&from, u, Vector3::zeros());
        let [s, _] = smallest(&shear_rotation.tangent()[0], &Vector3::zeros());
        let (_, [normal, ..]) = ShearRotation::placed(&from, u, s);
        near(normal, u.normalize(), 1e-14);
        assert!(axes_of(u)[0].abs() > 0.1);
    }
}
