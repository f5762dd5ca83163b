//! Inertia and orientation of rigid bodies.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::de::Deserializer;
use serde::{Deserialize, Serialize};

use super::strict::{Strict, typed};

/// Inertia about the centre of mass, kg m^2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Inertia {
    /// In the plane; 0 is a particle, in space too.
    Number(#[schemars(range(min = 0.0))] f64),
    /// Moments about the axes of the body's frame.
    Moments([f64; 3]),
    /// Tensor in the body's frame, by rows; products of inertia are minus the integrals of `x y` and so on.
    Tensor([[f64; 3]; 3]),
}

impl Default for Inertia {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl<'de> Deserialize<'de> for Inertia {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Strict::deserialize(deserializer)?.0;
        match value.as_array().and_then(|rows| rows.first()) {
            Some(first) if first.is_array() => typed(value).map(Self::Tensor),
            Some(_) => typed(value).map(Self::Moments),
            None => typed(value).map(Self::Number),
        }
    }
}

impl Inertia {
    /// The number that stands for it in the plane: about the third axis.
    pub fn number(&self) -> f64 {
        match *self {
            Self::Number(number) => number,
            Self::Moments(moments) => moments[2],
            Self::Tensor(rows) => rows[2][2],
        }
    }

    /// Whether there is any: the body rotates.
    pub fn is_some(&self) -> bool {
        match self {
            Self::Number(number) => *number > 0.0,
            Self::Moments(moments) => *moments != [0.0; 3],
            Self::Tensor(tensor) => *tensor != [[0.0; 3]; 3],
        }
    }

    /// The tensor in space.
    pub fn tensor(&self) -> Matrix3<f64> {
        match *self {
            Self::Number(_) => Matrix3::zeros(),
            Self::Moments(moments) => Matrix3::from_diagonal(&moments.into()),
            Self::Tensor(rows) => Matrix3::from_fn(|i, j| rows[i][j]),
        }
    }

    /// Principal moments, and principal axes as columns, right-handed; the axes of the frame where these are principal
    /// already. A moment that is zero but for rounding is zero: one of 1e-17 would be taken for an inertia.
    pub fn principal(&self) -> ([f64; 3], Matrix3<f64>) {
        let (moments, axes) = self.eigen();
        let least = ROUNDOFF * self.tensor().amax();
        (moments.map(|m| if m.abs() > least { m } else { 0.0 }), axes)
    }

    /// In the body's frame, the axis of a thin rod, about which there is no moment.
    pub fn thin(&self) -> Option<Vector3<f64>> {
        let (moments, axes) = self.principal();
        let axis = moments.iter().position(|moment| *moment <= 0.0);
        axis.filter(|_| self.is_some())
            .map(|axis| axes.column(axis).into_owned())
    }

    fn eigen(&self) -> ([f64; 3], Matrix3<f64>) {
        let tensor = self.tensor();
        let products = [tensor[(0, 1)], tensor[(0, 2)], tensor[(1, 2)]];
        if products == [0.0; 3] {
            return (tensor.diagonal().into(), Matrix3::identity());
        }
        let eigen = tensor.symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        (eigen.eigenvalues.into(), axes)
    }
}

/// Part of the largest moment that rounding leaves of one that is zero.
const ROUNDOFF: f64 = 1e-12;

/// How the frame of a body stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Orientation {
    /// Rotated from the global axes about an axis, in global components, by its length as angle, rad.
    #[schemars(title = "RotationVector")]
    RotationVector([f64; 3]),
    /// Rotated about x, then about the y axis as it is then, then about the z axis as it is then (Cardan angles), rad.
    #[schemars(title = "Cardan")]
    Cardan([f64; 3]),
    /// Rotated about z, then about the x axis as it is then, then about the z axis as it is then (Euler's angles: precession,
    /// nutation, spin), rad.
    #[schemars(title = "Euler")]
    Euler([f64; 3]),
    /// Matrix by rows; its columns are the axes of the frame in global components, orthonormal to 1e-6.
    #[schemars(title = "Matrix")]
    Matrix([[f64; 3]; 3]),
    /// Quaternion `[w, x, y, z]`, the real part first, of any length but zero.
    #[schemars(title = "Quaternion")]
    Quaternion([f64; 4]),
}

/// Deviation from orthonormal axes that is taken for rounding.
const ROUNDED: f64 = 1e-6;

impl Orientation {
    /// The axes of the frame in global components, as columns; nothing where the numbers are none of an orientation.
    pub fn axes(&self) -> Option<Matrix3<f64>> {
        let about = |axis: usize, angle: f64| Rotation3::new(Vector3::ith(axis, angle));
        let turned = |axes: [usize; 3], [a, b, c]: [f64; 3]| {
            (about(axes[0], a) * about(axes[1], b) * about(axes[2], c)).into_inner()
        };
        match *self {
            Self::RotationVector(vector) => Some(Rotation3::new(vector.into()).into_inner()),
            Self::Cardan(angles) => Some(turned([0, 1, 2], angles)),
            Self::Euler(angles) => Some(turned([2, 0, 2], angles)),
            Self::Matrix(rows) => {
                let given = Matrix3::from_fn(|i, j| rows[i][j]);
                let off = (given.transpose() * given - Matrix3::identity()).amax();
                let a = given.column(0).normalize();
                let b = given.column(1) - a * a.dot(&given.column(1));
                let b = b.normalize();
                let axes = Matrix3::from_columns(&[a, b, a.cross(&b)]);
                (off <= ROUNDED && given.determinant() > 0.0).then_some(axes)
            }
            Self::Quaternion([w, x, y, z]) => {
                let quaternion = Quaternion::new(w, x, y, z);
                let is_one = quaternion.norm() > 0.0 && quaternion.norm().is_finite();
                let rotation = || UnitQuaternion::from_quaternion(quaternion);
                is_one.then(|| rotation().to_rotation_matrix().into_inner())
            }
        }
    }

    /// Numbers of the value.
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::RotationVector(numbers) | Self::Cardan(numbers) | Self::Euler(numbers) => numbers,
            Self::Matrix(rows) => rows.as_flattened(),
            Self::Quaternion(numbers) => numbers,
        }
    }
}
