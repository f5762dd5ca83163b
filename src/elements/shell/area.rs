//! Loads per area on an element: pressure that follows the normal, and dead forces per area of the unstressed surface.
//!
//! Source: K.-J. Bathe, Finite Element Procedures, 2nd ed. (2014), section 6.2.3 (loads that depend on deformations).

use nalgebra::{Matrix3, Vector3};

use super::tangent::shape;
use super::{ElementCorners, Shell, VECTORS, mass};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_3;

/// Places of quadrature of an element, those along `eta` one after the other.
pub const AREA_PLACES: usize = 9;

/// A place of quadrature, `xi` and `eta` in [0, 1].
pub fn area_place(place: usize) -> [f64; 2] {
    [GAUSS_3[place / 3].at, GAUSS_3[place % 3].at]
}

/// Weight of a place.
fn weight(place: usize) -> f64 {
    GAUSS_3[place / 3].weight * GAUSS_3[place % 3].weight
}

/// Value of the function of number `k` of an element at a place, and its derivatives by `xi` and `eta`.
fn functions(k: usize, place: usize) -> [f64; 3] {
    let (functions, at) = (mass::functions(k), (place / 3 + 1, place % 3 + 1));
    [(0, 0), (1, 0), (0, 1)].map(|orders| shape(functions, orders, at))
}

impl Shell {
    /// Factor of number `k` that makes it one by `xi` and `eta`.
    fn scale(&self, k: usize) -> f64 {
        match k % VECTORS {
            0 => 1.0,
            vector => self.scales[vector - 1],
        }
    }

    /// Value of a field at a place of quadrature from its values and derivatives at the corners.
    pub fn at_place<N: Number>(&self, e: &ElementCorners<N>, place: usize) -> Vector3<N> {
        let vectors = e.as_flattened().iter().enumerate();
        vectors.fold(Vector3::zeros(), |sum, (k, vector)| {
            sum + Vector3::from(*vector) * N::of(functions(k, place)[0] * self.scale(k))
        })
    }

    /// Derivatives of the position by `xi` and `eta` at a place of quadrature, m.
    pub fn tangents<N: Number>(&self, e: &ElementCorners<N>, place: usize) -> [Vector3<N>; 2] {
        let mut sums = [Vector3::zeros(); 2];
        for (k, vector) in e.as_flattened().iter().enumerate() {
            let ([_, along, across], scale) = (functions(k, place), self.scale(k));
            let vector = Vector3::from(*vector);
            sums[0] += vector * N::of(along * scale);
            sums[1] += vector * N::of(across * scale);
        }
        sums
    }

    /// Areas of the unstressed surface that its places of quadrature stand for, m^2.
    pub fn place_areas(&self) -> &[f64; AREA_PLACES] {
        &self.areas
    }

    /// Areas that places of quadrature stand for on a surface, m^2.
    pub(super) fn areas(&self, unstressed: &ElementCorners) -> [f64; AREA_PLACES] {
        std::array::from_fn(|place| {
            let [first, second] = self.tangents(unstressed, place);
            first.cross(&second).norm() * weight(place)
        })
    }

    /// Forces on the functions per force per area of the unstressed surface, m^2 (and m^3 of derivatives).
    pub(super) fn area_weights(&self) -> [f64; 16] {
        std::array::from_fn(|k| {
            let places = self.areas.iter().enumerate();
            let sum: f64 = places
                .map(|(place, area)| functions(k, place)[0] * area)
                .sum();
            sum * self.scale(k)
        })
    }

    /// Forces of a pressure along the normal at the places of quadrature, Pa.
    pub fn pressure_force<N: Number>(
        &self,
        e: &ElementCorners<N>,
        pressure: &[N; AREA_PLACES],
    ) -> ElementCorners<N> {
        self.on_values(|place| {
            let [first, second] = self.tangents(e, place);
            first.cross(&second) * (pressure[place] * N::of(weight(place)))
        })
    }

    /// Forces of a dead load per area of the unstressed surface, N/m^2.
    pub fn area_force<N: Number>(&self, load: &[N; 3]) -> ElementCorners<N> {
        std::array::from_fn(|corner| {
            std::array::from_fn(|k| {
                load.map(|component| component * N::of(self.area_weights[VECTORS * corner + k]))
            })
        })
    }

    /// Forces of a dead load per area of the unstressed surface at the places of quadrature, N/m^2.
    pub fn varying_area_force<N: Number>(&self, load: &[[N; 3]; AREA_PLACES]) -> ElementCorners<N> {
        self.on_values(|place| Vector3::from(load[place]) * N::of(self.areas[place]))
    }

    /// Forces on the coordinates of a force at every place, N.
    fn on_values<N: Number>(&self, force: impl Fn(usize) -> Vector3<N>) -> ElementCorners<N> {
        let mut out = [[[N::of(0.0); 3]; VECTORS]; 4];
        for place in 0..AREA_PLACES {
            let force = force(place);
            for (k, out) in out.as_flattened_mut().iter_mut().enumerate() {
                let part = force * N::of(functions(k, place)[0] * self.scale(k));
                out.iter_mut()
                    .zip(&part)
                    .for_each(|(out, part)| *out += *part);
            }
        }
        out
    }

    /// Blocks over the vectors of all corners of a matrix per area of the unstressed surface at the places of quadrature.
    pub fn area_matrix(&self, of: &[Matrix3<f64>; AREA_PLACES]) -> [[Matrix3<f64>; 16]; 16] {
        let mut out = [[Matrix3::zeros(); 16]; 16];
        for (place, matrix) in of.iter().enumerate() {
            let values: [f64; 16] = std::array::from_fn(|k| functions(k, place)[0] * self.scale(k));
            for (row, out) in out.iter_mut().enumerate() {
                for (column, out) in out.iter_mut().enumerate() {
                    *out += matrix * (self.areas[place] * values[row] * values[column]);
                }
            }
        }
        out
    }

    /// Symmetric part of the stiffness of a pressure at the places of quadrature (Pa), block by block over the vectors of all corners.
    pub fn pressure_stiffness(
        &self,
        e: &ElementCorners,
        pressure: &[f64; AREA_PLACES],
    ) -> [[Matrix3<f64>; 16]; 16] {
        let mut out = [[Matrix3::zeros(); 16]; 16];
        for place in 0..AREA_PLACES {
            let [first, second] = self.tangents(e, place).map(|v| v.cross_matrix());
            let half = 0.5 * pressure[place] * weight(place);
            for row in 0..16 {
                let [value, ..] = functions(row, place);
                for column in 0..16 {
                    let [_, along, across] = functions(column, place);
                    let by = half * value * self.scale(row) * self.scale(column);
                    let part = (second * along - first * across) * by;
                    out[row][column] += part;
                    out[column][row] += part.transpose();
                }
            }
        }
        out
    }
}
