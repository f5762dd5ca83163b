//! Reduced models of fewer modes.
//!
//! Source: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA Journal 6 (1968) 1313-1319 (modes and static
//! shapes).

use nalgebra::Vector3;

use super::{Interface, ReducedModel};

impl ReducedModel {
    /// Returns the model with its first modes alone. What second-order displacements leave to a mode that is cut off, as energy, they take back:
    /// `u_kl -= 2 psi_m T_mkl / lambda_m`, `J2_kl -= T_mkl J1_m / lambda_m`.
    #[must_use]
    pub fn truncated(&self, modes: usize) -> Self {
        let (all, n) = (self.modes(), modes.min(self.modes()));
        let (before, paired) = (self.paired, self.paired.min(n));
        let square = |of: &dyn Fn(usize, usize) -> usize| -> Vec<usize> {
            (0..n * n).map(|at| of(at / n, at % n)).collect()
        };
        let places = square(&|k, l| all * k + l);
        let cubic = |m: usize, k: usize, l: usize| self.cubic[(m * before + k) * before + l];
        let mut inertia_2: Vec<_> = places.iter().map(|at| self.inertia_2[*at]).collect();
        for m in n..all {
            for k in 0..paired {
                for l in 0..paired {
                    let part = cubic(m, k, l) / self.eigenvalues[m];
                    let terms = inertia_2[n * k + l].iter_mut().zip(&self.inertia_1[m]);
                    terms.for_each(|(sum, by_mode)| *sum -= part * by_mode);
                }
            }
        }
        let of_pairs =
            (0..n).flat_map(|m| (0..paired * paired).map(move |at| (m, at / paired, at % paired)));
        let cubic = if paired == 0 {
            Vec::new()
        } else {
            of_pairs.map(|(m, k, l)| cubic(m, k, l)).collect()
        };
        Self {
            mass: self.mass,
            moments: self.moments,
            eigenvalues: self.eigenvalues[..n].to_vec(),
            inertia_1: self.inertia_1[..n].to_vec(),
            inertia_2,
            coupling: places.iter().map(|at| self.coupling[*at]).collect(),
            paired,
            cubic,
            interfaces: self
                .interfaces
                .iter()
                .map(|interface| self.truncated_interface(interface, n))
                .collect(),
        }
    }

    /// An interface with the first modes alone.
    fn truncated_interface(&self, interface: &Interface, n: usize) -> Interface {
        let (before, paired) = (self.paired, self.paired.min(n));
        let second = |at: usize| -> Vector3<f64> {
            let (k, l) = (at / paired, at % paired);
            let cut = (n..self.modes()).fold(Vector3::zeros(), |sum: Vector3<f64>, m| {
                let part = self.cubic[(m * before + k) * before + l] / self.eigenvalues[m];
                sum + interface.modes[m] * (2.0 * part)
            });
            interface.second[before * k + l] - cut
        };
        let has_second = !interface.second.is_empty();
        let pairs = if has_second { paired * paired } else { 0 };
        Interface {
            name: interface.name.clone(),
            position: interface.position,
            modes: interface.modes[..n].to_vec(),
            rotation: interface.rotation.as_ref().map(|r| r[..n].to_vec()),
            second: (0..pairs).map(second).collect(),
        }
    }
}
