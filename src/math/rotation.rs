//! Rotations of space as unit quaternions `(w, x, y, z)`, scalar first, over numbers of any kind.
//!
//! Source: M. D. Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993) 439-517; I. Y. Bar-Itzhack,
//! New method for extracting the quaternion from a rotation matrix, J. Guidance 23 (2000) 1085-1087 (`q q^T` from a matrix).

use nalgebra::Vector3;

use super::jet::Number;

/// A unit quaternion, scalar first.
pub type Quaternion<N = f64> = [N; 4];

/// The rotation by nothing.
pub const NO_ROTATION: Quaternion = [1.0, 0.0, 0.0, 0.0];

/// Square of the sine of half an angle up to which the angle is summed as a series.
const SMALL: f64 = 1e-2;

/// `asin(s) / s` as a series in `s^2`, seven terms: 4e-16 off at [`SMALL`].
const ARC_SINE: [f64; 7] = [
    1.0,
    1.0 / 6.0,
    3.0 / 40.0,
    5.0 / 112.0,
    35.0 / 1152.0,
    63.0 / 2816.0,
    231.0 / 13312.0,
];

/// The rotation `a` after `b`, which need not be of unit length.
pub fn product<N: Number>(a: &Quaternion<N>, b: &Quaternion<N>) -> Quaternion<N> {
    let [p, u] = [a[0], b[0]];
    let [v, w] = [a, b].map(|of| Vector3::new(of[1], of[2], of[3]));
    let [x, y, z] = (v * u + w * p + v.cross(&w)).into();
    [p * u - v.dot(&w), x, y, z]
}

/// The rotation back.
pub fn inverse<N: Number>([w, x, y, z]: Quaternion<N>) -> Quaternion<N> {
    [w, -x, -y, -z]
}

/// Scales a quaternion to unit length.
pub fn normalized(q: Quaternion) -> Quaternion {
    let size = q.iter().map(|part| part * part).sum::<f64>().sqrt();
    q.map(|part| part / size)
}

/// The rotation by a vector: the angle, rad, along the axis.
pub fn turn_by(vector: &Vector3<f64>) -> Quaternion {
    let (sin, cos) = (0.5 * vector.norm()).sin_cos();
    let [x, y, z] = match vector.norm() {
        0.0 => [0.0; 3],
        angle => (vector * (sin / angle)).into(),
    };
    [cos, x, y, z]
}

/// A quaternion of any length and its first two derivatives become those of one of unit length.
pub fn unit_with_rates<N: Number>([q, rate, second]: [Quaternion<N>; 3]) -> [Quaternion<N>; 3] {
    let along = |a: &Quaternion<N>, b: &Quaternion<N>| {
        let terms = a.iter().zip(b);
        terms.fold(N::of(0.0), |sum, (a, b)| sum + *a * *b)
    };
    // The inverse length `s`, from `s^2 q.q = 1`.
    let s = N::of(1.0) / along(&q, &q).sqrt();
    let (cube, slope) = (s * s * s, along(&q, &rate));
    let bend = along(&rate, &rate) + along(&q, &second);
    let first = -cube * slope;
    let last = cube * (N::of(3.0) * s * s * slope * slope - bend);
    let two = N::of(2.0);
    [
        q.map(|part| s * part),
        std::array::from_fn(|k| first * q[k] + s * rate[k]),
        std::array::from_fn(|k| last * q[k] + two * first * rate[k] + s * second[k]),
    ]
}

/// The vector part of `a e b*` for the axis `e` of this number: what a unit quaternion `a = b` takes the axis to; symmetric in
/// both, so that derivatives follow by the product rule.
pub fn carried<N: Number>(a: &Quaternion<N>, b: &Quaternion<N>, axis: usize) -> Vector3<N> {
    let mut unit = [N::of(0.0); 4];
    unit[1 + axis] = N::of(1.0);
    let [_, x, y, z] = product(&product(a, &unit), &inverse(*b));
    Vector3::new(x, y, z)
}

/// Rotates the three global axes: the columns of the rotation matrix. The quaternion may have any length.
pub fn axes<N: Number>(q: &Quaternion<N>) -> [Vector3<N>; 3] {
    let [w, x, y, z] = *q;
    let two = N::of(2.0) / (w * w + x * x + y * y + z * z);
    let one = N::of(1.0);
    let part = |sum: N| two * sum;
    [
        Vector3::new(
            one - part(y * y + z * z),
            part(x * y + w * z),
            part(x * z - w * y),
        ),
        Vector3::new(
            part(x * y - w * z),
            one - part(x * x + z * z),
            part(y * z + w * x),
        ),
        Vector3::new(
            part(x * z + w * y),
            part(y * z - w * x),
            one - part(x * x + y * y),
        ),
    ]
}

/// `4 q q^T` of the rotation that takes the axes to these.
fn square<N: Number>([a, b, c]: &[Vector3<N>; 3]) -> [[N; 4]; 4] {
    let one = N::of(1.0);
    let [wx, wy, wz] = [b[2] - c[1], c[0] - a[2], a[1] - b[0]];
    let [xy, xz, yz] = [b[0] + a[1], c[0] + a[2], c[1] + b[2]];
    [
        [one + a[0] + b[1] + c[2], wx, wy, wz],
        [wx, one + a[0] - b[1] - c[2], xy, xz],
        [wy, xy, one - a[0] + b[1] - c[2], yz],
        [wz, xz, yz, one - a[0] - b[1] + c[2]],
    ]
}

/// Returns the quaternion of the rotation to these axes that is on the side of `near`: `q q^T h / |q . h|`. `near` is
/// less than half a turn away.
pub fn quaternion_near<N: Number>(axes: &[Vector3<N>; 3], near: &Quaternion) -> Quaternion<N> {
    let along = |row: &[N; 4]| {
        let terms = row.iter().zip(near);
        terms.fold(N::of(0.0), |sum, (q, h)| sum + *q * N::of(*h))
    };
    let sums = square(axes).map(|row| along(&row));
    let size = along(&sums).sqrt() * N::of(2.0);
    sums.map(|sum| sum / size)
}

/// The quaternion of the rotation that takes the axes to these whose scalar part is not negative.
pub fn quaternion<N: Number>(axes: &[Vector3<N>; 3]) -> Quaternion<N> {
    let squares = square(axes);
    let size = |k: usize| squares[k][k].plain();
    let largest = (1..4).fold(0, |at, k| if size(k) > size(at) { k } else { at });
    let mut near = [0.0; 4];
    near[largest] = 1.0;
    let found = quaternion_near(axes, &near);
    if found[0].plain() < 0.0 {
        found.map(|part| -part)
    } else {
        found
    }
}

/// The rotation vector, the angle (from 0 to pi, rad) along the axis, of the rotation by this quaternion of either sign.
pub fn rotation_vector<N: Number>(q: &Quaternion<N>) -> Vector3<N> {
    let sign = N::of(if q[0].plain() < 0.0 { -1.0 } else { 1.0 });
    let (cosine, along) = (q[0] * sign, Vector3::new(q[1], q[2], q[3]) * sign);
    let square = along.norm_squared();
    let half_over_sine = if square.plain() < SMALL {
        (ARC_SINE.iter().rev()).fold(N::of(0.0), |sum, c| sum * square + N::of(*c))
    } else {
        let sine = square.sqrt();
        sine.angle(cosine) / sine
    };
    along * (half_over_sine * N::of(2.0))
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::math::jet::Jet;

    /// Rotation vectors of all sizes up to half a turn, and matrices from another program.
    fn rotations() -> Vec<(Vector3<f64>, [Vector3<f64>; 3])> {
        let ways = [
            [1.0, 0.0, 0.0],
            [-0.6, 0.0, 0.8],
            [0.48, -0.6, 0.64],
            [-0.36, 0.48, -0.8],
        ];
        let angles = [0.0, 1e-9, 1e-3, 0.1, 0.19, 0.21, 1.0, 2.0, 3.0, 3.1];
        let all = ways.iter().flat_map(|way| angles.map(|angle| (way, angle)));
        all.map(|(way, angle)| {
            let vector = Vector3::from(*way) * angle;
            let matrix = Rotation3::new(vector).into_inner();
            let columns = [0, 1, 2].map(|k| matrix.column(k).into_owned());
            (vector, columns)
        })
        .collect()
    }

    #[test]
    fn a_half_turn_has_a_rate() {
        // By 1 rad/s, where the scalar part is exactly 0.
        let zero = Jet::from(0.0);
        let q = [
            Jet::new(0.0, -0.5, 0.0),
            Jet::new(1.0, 0.0, -0.25),
            zero,
            zero,
        ];
        let turned = rotation_vector(&q)[0];
        assert!((turned.re - std::f64::consts::PI).abs() < 1e-15, "{turned}");
        assert!((turned.v1 - 1.0).abs() < 1e-15, "{turned}");
    }

    #[test]
    fn vectors_quaternions_and_matrices_are_the_same_rotation() {
        for (vector, matrix) in rotations() {
            let q = quaternion(&matrix);
            let (sin, cos) = (0.5 * vector.norm()).sin_cos();
            let way = vector.try_normalize(0.0).unwrap_or_default();
            assert!((q[0] - cos).abs() < 1e-14, "{vector}");
            let miss = Vector3::new(q[1], q[2], q[3]) - way * sin;
            assert!(miss.norm() < 1e-14, "{vector}");
            let found = rotation_vector(&q);
            assert!((found - vector).norm() < 2e-12, "{vector}");
            let twice = rotation_vector(&q.map(|part| -part));
            assert_eq!(found, twice);
            for (a, b) in axes(&q.map(|part| 3.0 * part)).iter().zip(&matrix) {
                assert!((a - b).norm() < 1e-14, "{vector}");
            }
        }
    }

    #[test]
    fn products_are_those_of_matrices() {
        let all = rotations();
        for ((_, a), (_, b)) in all.iter().zip(all.iter().rev()) {
            let [p, q] = [a, b].map(quaternion);
            let found = axes(&product(&p, &q));
            let back = axes(&product(&inverse(p), &product(&p, &q)));
            for k in 0..3 {
                let wanted = a[0] * b[k][0] + a[1] * b[k][1] + a[2] * b[k][2];
                assert!((found[k] - wanted).norm() < 1e-14);
                assert!((back[k] - b[k]).norm() < 1e-14);
            }
        }
    }

    #[test]
    fn the_near_quaternion_is_on_the_side_of_the_other() {
        let mut near = NO_ROTATION;
        for k in 0..200 {
            let angle = 0.1 * f64::from(k);
            let matrix = Rotation3::new(Vector3::new(0.6, 0.0, 0.8) * angle);
            let columns = [0, 1, 2].map(|k| matrix.matrix().column(k).into_owned());
            near = quaternion_near(&columns, &near);
            let (sin, cos) = (0.5 * angle).sin_cos();
            let wanted = [cos, 0.6 * sin, 0.0, 0.8 * sin];
            for (a, b) in near.iter().zip(wanted) {
                assert!((a - b).abs() < 1e-14, "{angle}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_a_steady_turn() {
        let (way, rate) = (Vector3::new(0.48, -0.6, 0.64), 0.7);
        for angle in [0.0, 1e-6, 0.19, 0.21, 2.0, 3.0] {
            let about = way.cross_matrix();
            let (sin, cos) = f64::sin_cos(angle);
            let [value, first, second] = [(sin, 1.0 - cos), (cos, sin), (-sin, cos)]
                .map(|(once, twice)| about * once + about * about * twice);
            let columns = [0, 1, 2].map(|j| {
                Vector3::from_fn(|i, _| {
                    let unit = if i == j { 1.0 } else { 0.0 };
                    Jet::new(
                        unit + value[(i, j)],
                        rate * first[(i, j)],
                        rate * rate * second[(i, j)],
                    )
                })
            });
            let found = rotation_vector(&quaternion(&columns));
            for k in 0..3 {
                assert!((found[k].v1 - rate * way[k]).abs() < 1e-12, "{angle}");
                assert!(found[k].v2.abs() < 1e-9, "{angle}: {}", found[k].v2);
            }
        }
    }
}
