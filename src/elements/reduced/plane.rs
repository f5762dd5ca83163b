//! Reduced models in the plane: mean axes move in it and rotate about its normal alone, while their displacement across it and their tilt are
//! held.
//!
//! Kinetic energy, strain energy and places of interfaces in the plane need the third component of couplings and of rotations, the moment of
//! inertia about the normal and displacements along the plane. All else is zero, so that the equations in space are those of the plane.
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems, 5th ed. (2020), section 5.4 (planar motion of deformable bodies).

use nalgebra::{Matrix3, Vector3};

use super::inertia::times;
use super::{Interface, ReducedModel, Symmetric};

/// Part of what a mode may do to the plane below which it does nothing: displacements beside `1 / sqrt(m)`, for a mode of unit mass.
const NOTHING: f64 = 1e-6;

/// Entries of an array over pairs of the first `paired` modes, for these modes.
fn of_pairs<T: Copy>(array: &[T], paired: usize, modes: &[usize]) -> Vec<T> {
    if array.is_empty() {
        return Vec::new();
    }
    let modes = || modes.iter().copied().filter(|mode| *mode < paired);
    let pairs = modes().flat_map(|k| modes().map(move |l| paired * k + l));
    pairs.map(|at| array[at]).collect()
}

impl ReducedModel {
    /// Returns the model in the plane across the third of given axes, along these. It has all modes, some of which may do nothing in the plane.
    ///
    /// - `axes`: principal axes of the model in these axes, as columns.
    #[must_use]
    pub fn in_plane(&self, axes: &Matrix3<f64>) -> Self {
        let normal: Vector3<f64> = axes.row(2).transpose();
        let way = |of: &Vector3<f64>| {
            let along = axes * of;
            Vector3::new(along.x, along.y, 0.0)
        };
        let about = |of: &Vector3<f64>| Vector3::new(0.0, 0.0, normal.dot(of));
        let moment = |of: &Symmetric| {
            let moment = normal.dot(&times(*of, &normal));
            [0.0, 0.0, moment, 0.0, 0.0, 0.0]
        };
        let ways = |of: &[Vector3<f64>]| of.iter().map(way).collect();
        let rotations = |of: &[Vector3<f64>]| of.iter().map(about).collect();
        let [a, b, c] = self.moments;
        let inertia = normal.dot(&times([a, b, c, 0.0, 0.0, 0.0], &normal));
        let interface = |of: &Interface| Interface {
            name: of.name.clone(),
            position: way(&of.position),
            modes: ways(&of.modes),
            rotation: of.rotation.as_deref().map(rotations),
            second: ways(&of.second),
            second_rotation: rotations(&of.second_rotation),
        };
        Self {
            moments: [inertia; 3],
            inertia_1: self.inertia_1.iter().map(moment).collect(),
            inertia_2: self.inertia_2.iter().map(moment).collect(),
            coupling: rotations(&self.coupling),
            interfaces: self.interfaces.iter().map(interface).collect(),
            ..self.clone()
        }
    }

    /// Lists the modes of a model in the plane that interfaces, rotations or other such modes excite, in ascending order; the first one where
    /// there are none.
    pub fn excited_in_plane(&self) -> Vec<usize> {
        let n = self.modes();
        let (mass, inertia) = (self.mass.sqrt(), self.moments[2].sqrt());
        let is_something = |size: f64| size > NOTHING;
        let directly = |k: usize| {
            let moved = |of: &Interface| {
                let rotation = of
                    .rotation
                    .as_ref()
                    .map_or(0.0, |by| by[k].norm() * inertia);
                is_something(f64::max(of.modes[k].norm() * mass, rotation))
            };
            is_something(self.inertia_1[k][2].abs() / inertia) || self.interfaces.iter().any(moved)
        };
        let mut is_excited: Vec<bool> = (0..n).map(directly).collect();
        loop {
            let by_others = |k: &usize| !is_excited[*k] && self.is_coupled(*k, &is_excited);
            let found: Vec<usize> = (0..n).filter(by_others).collect();
            if found.is_empty() {
                break;
            }
            found.into_iter().for_each(|k| is_excited[k] = true);
        }
        let mut excited: Vec<usize> = (0..n).filter(|k| is_excited[*k]).collect();
        if excited.is_empty() {
            excited.push(0);
        }
        excited
    }

    /// Whether motions of other modes excite a mode: a term of the energy or of the places of interfaces is linear in its amplitude.
    fn is_coupled(&self, k: usize, others: &[bool]) -> bool {
        let (n, paired) = (self.modes(), self.paired);
        let (by_second, size) = ((self.mass * self.moments[2]).sqrt(), self.moments[2].sqrt());
        let of_pair = |l: usize| {
            let at = n * k + l;
            let coupled = self.coupling[at][2].abs().max(self.inertia_2[at][2].abs());
            let has_pair = k < paired && l < paired;
            let second = |of: &Interface| {
                let second = of.second.get(paired * k + l).filter(|_| has_pair);
                second.map_or(0.0, |second| second.norm() * by_second)
            };
            let moved = self.interfaces.iter().map(second);
            moved.fold(coupled, f64::max) > NOTHING
        };
        let cubic = |m: usize, l: usize| {
            let at = |[m, k, l]: [usize; 3]| {
                let is_stored = k < paired && l < paired;
                let stored = self.cubic.get((m * paired + k) * paired + l);
                stored.filter(|_| is_stored).map_or(0.0, |of| of.abs())
            };
            let largest = at([m, k, l]).max(at([k, m, l]));
            let stiffest = self.eigenvalues[m.max(k).max(l)];
            largest * size / stiffest > NOTHING
        };
        let is_other = |l: &usize| others[*l];
        (0..n)
            .filter(is_other)
            .any(|l| of_pair(l) || (0..n).filter(is_other).any(|m| cubic(m, l)))
    }

    /// Returns the model with these of its modes alone, which counts as the model of a file.
    #[must_use]
    pub fn of_modes(&self, modes: &[usize]) -> Self {
        let (all, paired) = (self.modes(), self.paired);
        fn of<T: Copy>(array: &[T], modes: &[usize]) -> Vec<T> {
            modes.iter().map(|k| array[*k]).collect()
        }
        let interface = |whole: &Interface| Interface {
            name: whole.name.clone(),
            position: whole.position,
            modes: of(&whole.modes, modes),
            rotation: whole.rotation.as_ref().map(|rotation| of(rotation, modes)),
            second: of_pairs(&whole.second, paired, modes),
            second_rotation: of_pairs(&whole.second_rotation, all, modes),
        };
        let cubic = self.cubic.chunks_exact((paired * paired).max(1));
        let cubic: Vec<&[f64]> = cubic.collect();
        let kept = modes.iter().filter_map(|m| cubic.get(*m));
        Self {
            mass: self.mass,
            moments: self.moments,
            eigenvalues: of(&self.eigenvalues, modes),
            inertia_1: of(&self.inertia_1, modes),
            inertia_2: of_pairs(&self.inertia_2, all, modes),
            coupling: of_pairs(&self.coupling, all, modes),
            paired: modes.iter().filter(|mode| **mode < paired).count(),
            cubic: kept.flat_map(|of| of_pairs(of, paired, modes)).collect(),
            interfaces: self.interfaces.iter().map(interface).collect(),
            of_file: None,
        }
    }
}
