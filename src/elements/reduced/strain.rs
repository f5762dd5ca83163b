//! Strain energy of a reduced model: `1/2 sum lambda_m e_m^2`, `e_m = eta_m - 1/2 sum theta^m_kl eta_k eta_l`. A pair of amplitudes changes
//! the strain of every mode that is at least as stiff, so that every triple of modes counts once.
//!
//! Source: S. R. Idelsohn, A. Cardona, A reduction method for nonlinear structural dynamic analysis, Comput. Methods Appl. Mech. Eng. 49
//! (1985) 253-279 (derivatives of modes).

use super::{ModalTerms, PAIRED, ReducedModel};
use crate::math::jet::Number;

/// Strain energy over amplitudes of the modes.
#[derive(Clone, Debug)]
pub struct ModalStrain {
    eigenvalues: Vec<f64>,
    paired: usize,
    /// `theta^m_kl`, `[n paired paired]`.
    pairs: Vec<f64>,
}

impl ModalStrain {
    /// Strain energy of a model.
    pub fn new(model: &ReducedModel) -> Self {
        // Without cubic terms strains are amplitudes.
        let has_pairs = model.cubic.iter().any(|cubic| *cubic != 0.0);
        let paired = if has_pairs { model.paired } else { 0 };
        let weight = |at: usize| {
            let (m, k, l) = (at / (paired * paired), at / paired % paired, at % paired);
            if m < k || m < l {
                return 0.0;
            }
            let share = [1.0, 0.5, 1.0 / 3.0][usize::from(m == k) + usize::from(m == l)];
            -2.0 * share * model.cubic[at] / model.eigenvalues[m]
        };
        Self {
            eigenvalues: model.eigenvalues.clone(),
            paired,
            pairs: (0..model.modes() * paired * paired).map(weight).collect(),
        }
    }

    /// Number of first modes whose pairs change strains.
    pub(super) fn paired(&self) -> usize {
        self.paired
    }

    /// `theta^m_kl`, `[n paired paired]`.
    pub(super) fn weights(&self) -> &[f64] {
        &self.pairs
    }

    /// Strain `e_m` of a mode at amplitudes of the modes: the amplitude without what pairs of others move without strain.
    #[inline(always)]
    pub fn of_mode<N: Number>(&self, m: usize, eta: &[N], terms: ModalTerms<'_, N>) -> N {
        let pairs = terms.pairs(m).iter().take(m + 1).zip(eta);
        let moved = pairs.fold(N::of(0.0), |sum, (turned, eta)| sum + *eta * *turned);
        eta[m] - moved * N::of(0.5)
    }

    /// Energy at amplitudes of the modes, J.
    pub fn energy<N: Number>(&self, eta: &[N], terms: ModalTerms<'_, N>) -> N {
        let modes = self.eigenvalues.iter().enumerate();
        modes.fold(N::of(0.0), |energy, (m, eigenvalue)| {
            let strain = self.of_mode(m, eta, terms);
            energy + strain * strain * N::of(0.5 * eigenvalue)
        })
    }

    /// Adds elastic forces on the modes.
    pub fn add_force<N: Number>(&self, eta: &[N], terms: ModalTerms<'_, N>, force: &mut [N]) {
        for (m, eigenvalue) in self.eigenvalues.iter().enumerate() {
            let pull = self.of_mode(m, eta, terms) * N::of(*eigenvalue);
            force[m] -= pull;
            for (force, turned) in force.iter_mut().zip(terms.pairs(m).iter().take(m + 1)) {
                *force += pull * *turned;
            }
        }
    }

    /// Second derivatives of the energy at amplitudes of the modes.
    pub fn stiffness<'a>(&'a self, eta: &[f64], terms: ModalTerms<'a>) -> ModalStiffness<'a> {
        let mut pairs = [[0.0; PAIRED]; PAIRED];
        let paired = self.paired;
        for (m, eigenvalue) in self.eigenvalues.iter().enumerate() {
            let mut by = [0.0; PAIRED];
            let strain = self.of_mode(m, eta, terms);
            for (by, turned) in by.iter_mut().zip(terms.pairs(m)) {
                *by = -turned;
            }
            if m < paired {
                by[m] += 1.0;
            }
            let weights = &self.pairs[m * paired * paired..(m + 1) * paired * paired];
            for (k, sums) in pairs.iter_mut().enumerate().take(paired) {
                for (l, sum) in sums.iter_mut().enumerate().take(paired) {
                    *sum += eigenvalue * (by[k] * by[l] - strain * weights[paired * k + l]);
                }
            }
        }
        ModalStiffness {
            strain: self,
            terms,
            pairs,
        }
    }
}

/// Second derivatives of a strain energy over amplitudes of the modes.
#[derive(Clone, Debug)]
pub struct ModalStiffness<'a> {
    strain: &'a ModalStrain,
    terms: ModalTerms<'a>,
    /// Those by the amplitudes that form pairs.
    pairs: [[f64; PAIRED]; PAIRED],
}

impl ModalStiffness<'_> {
    /// Second derivative of the energy by two amplitudes.
    pub fn at(&self, k: usize, l: usize) -> f64 {
        let (low, high) = (k.min(l), k.max(l));
        let eigenvalue = self.strain.eigenvalues[high];
        match (low < self.strain.paired, high < self.strain.paired) {
            (true, true) => self.pairs[k][l],
            (true, false) => -eigenvalue * self.terms.pairs(high)[low],
            _ if low == high => eigenvalue,
            _ => 0.0,
        }
    }
}
