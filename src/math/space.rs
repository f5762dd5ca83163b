//! Vectors of the plane and of space, by one set of formulas: the plane is that of the first two axes, and rotates
//! counter-clockwise about the third.

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

use super::jet::Number;

/// A vector in `D` dimensions.
pub type Vector<const D: usize, N = f64> = SVector<N, D>;

/// The unit vector along an axis.
pub fn axis<const D: usize, N: Number>(k: usize) -> Vector<D, N> {
    Vector::from_fn(|i, _| N::of(f64::from(u8::from(i == k))))
}

/// All three components: across the plane there is none.
pub fn components<const D: usize, N: Number>(v: &Vector<D, N>) -> [N; 3] {
    std::array::from_fn(|k| if k < D { v[k] } else { N::of(0.0) })
}

/// The vector of those of three components that there are in so many dimensions.
pub fn vector<const D: usize, N: Number>(components: [N; 3]) -> Vector<D, N> {
    Vector::from_row_slice(&components[..D])
}

/// Orthonormal axes of the plane that two vectors span: along the first, across it on the side of the second, and the normal.
pub fn tangent_axes(first: &Vector3<f64>, second: &Vector3<f64>) -> [Vector3<f64>; 3] {
    let (along, normal) = (first.normalize(), first.cross(second).normalize());
    [along, normal.cross(&along), normal]
}

/// Whether a vector and its derivatives are zero; `==` compares values alone.
pub fn is_nothing<const D: usize, N: Number>(v: &Vector<D, N>) -> bool {
    v.iter().all(|part| part.largest() == 0.0)
}

/// Whether a matrix of so many rows and columns is numbers times the identity of space, pair of vectors by pair of vectors. Of each row the first
/// entries are read, as many as `read` tells.
pub fn is_isotropic_below<const D: usize>(
    (rows, columns): (usize, usize),
    read: impl Fn(usize) -> usize,
    entry: impl Fn(usize, usize) -> f64,
) -> bool {
    rows.is_multiple_of(D)
        && columns.is_multiple_of(D)
        && (0..rows).all(|r| {
            (0..read(r)).all(|c| {
                let is_of_axis = r % D == c % D;
                let expected = is_of_axis.then(|| entry(r - r % D, c - c % D));
                entry(r, c) == expected.unwrap_or(0.0)
            })
        })
}

/// The part in the plane, rotated left by a right angle.
pub fn perpendicular<const D: usize, N: Number>(v: Vector<D, N>) -> Vector<D, N> {
    let mut turned = Vector::zeros();
    (turned[0], turned[1]) = (-v[1], v[0]);
    turned
}

/// [`left`] as a matrix.
pub fn perpendicular_matrix<const D: usize>() -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|r, c| perpendicular(axis::<D, f64>(c))[r])
}

/// `perpendicular(a) . b`: the third component of the cross product.
pub fn cross<const D: usize, N: Number>(a: &Vector<D, N>, b: &Vector<D, N>) -> N {
    a[0] * b[1] - a[1] * b[0]
}

/// The part in the plane rotated left by the angle with this sine and cosine; what is across the plane stays.
pub fn turned<const D: usize, N: Number>(v: Vector<D, N>, (sin, cos): (N, N)) -> Vector<D, N> {
    let mut turned = v;
    (turned[0], turned[1]) = (cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]);
    turned
}

/// All components of `a x b`, in the plane the third alone.
pub fn moment<const D: usize, N: Number>(a: &Vector<D, N>, b: &Vector<D, N>) -> [N; 3] {
    let (a, b) = (components(a), components(b));
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// Axes that a body can rotate about: the third in the plane.
pub fn spins(dimension: usize) -> std::ops::Range<usize> {
    if dimension == 2 { 2..3 } else { 0..3 }
}

/// Rotated about an axis by an angle: the direction and the length of a vector.
pub fn rotated<const D: usize>(v: Vector<D>, turn: [f64; 3]) -> Vector<D> {
    if D == 2 {
        return turned(v, turn[2].sin_cos());
    }
    vector((Rotation3::new(turn.into()) * Vector3::from(components(&v))).into())
}

/// `spin x v`; in the plane the third component of the spin alone counts.
#[inline(always)]
pub fn spun<const D: usize, N: Number>(spin: [f64; 3], v: Vector<D, N>) -> Vector<D, N> {
    if D == 2 {
        return perpendicular(v) * N::of(spin[2]);
    }
    let ([a, b, c], [x, y, z]) = (spin.map(N::of), components(&v));
    vector([b * z - c * y, c * x - a * z, a * y - b * x])
}

/// [`spun`] as a matrix.
pub fn spin_matrix<const D: usize>(spin: [f64; 3]) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|r, c| spun(spin, axis::<D, f64>(c))[r])
}

/// Centripetal and Coriolis acceleration `W x (W x r) + 2 W x v` of a point that is at `r` and moves at `v` in a frame that
/// rotates about the origin at the constant rate `W`: what its acceleration is more than that seen in the frame.
///
/// Source: A. A. Shabana, Dynamics of Multibody Systems, 5th ed., section 2.5.
#[inline(always)]
pub fn frame_acceleration<const D: usize, N: Number>(
    rate: [f64; 3],
    r: Vector<D, N>,
    v: Vector<D, N>,
) -> Vector<D, N> {
    spun(rate, spun(rate, r) + v * N::of(2.0))
}

/// Unit vectors perpendicular to a unit vector and to each other, as many as there are; the first is that to the left in
/// the plane.
pub fn normals<const D: usize, N: Number>(
    along: &Vector<D, N>,
) -> impl Iterator<Item = Vector<D, N>> {
    (0..D - 1).map(|k| normal(along, k))
}

/// One of the [`normals`], counted from 0.
pub fn normal<const D: usize, N: Number>(along: &Vector<D, N>, k: usize) -> Vector<D, N> {
    if D == 2 {
        return perpendicular(*along);
    }
    // The axis that is most across it.
    let size = |k: &usize| along[*k].plain().abs();
    let across = (0..D).min_by(|a, b| size(a).total_cmp(&size(b)));
    let across = across.expect("space has an axis");
    let away = axis(across) - *along * along[across];
    let first: Vector<D, N> = away / away.norm();
    match k {
        0 => first,
        _ => vector(moment(along, &first)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_perpendicular_unit_vectors() {
        for along in [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.6, 0.0, 0.8],
            [0.48, 0.6, 0.64],
        ] {
            let along = Vector::<3>::from(along);
            let found: Vec<_> = normals(&along).collect();
            assert_eq!(found.len(), 2);
            assert!(found[0].dot(&found[1]).abs() < 1e-15);
            for normal in found {
                assert!((normal.norm() - 1.0).abs() < 1e-15 && normal.dot(&along).abs() < 1e-15);
            }
        }
        let flat: Vec<_> = normals(&Vector::<2>::new(0.6, 0.8)).collect();
        assert_eq!(flat, [Vector::<2>::new(-0.8, 0.6)]);
    }

    #[test]
    fn a_moment_is_the_cross_product() {
        let (a, b) = (
            Vector::<3>::new(1.0, 2.0, 3.0),
            Vector::<3>::new(-2.0, 0.5, 4.0),
        );
        assert_eq!(moment(&a, &b), <[f64; 3]>::from(a.cross(&b)));
        assert_eq!(spun(a.into(), b), a.cross(&b));
        assert_eq!(spin_matrix::<3>(a.into()) * b, a.cross(&b));
        let (a, b) = (Vector::<2>::new(1.0, 2.0), Vector::<2>::new(-2.0, 0.5));
        assert_eq!(moment(&a, &b), [0.0, 0.0, cross(&a, &b)]);
        assert_eq!(cross(&a, &b), perpendicular(a).dot(&b));
    }
}
