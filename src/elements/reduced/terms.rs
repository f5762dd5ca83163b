//! What is linear in the amplitudes of a reduced model, by one constant matrix: couplings `h_k`, derivatives `dJ / d eta_k` of the inertia,
//! `sum_l theta^m_kl eta_l` of pairs of modes in the strains, and derivatives of the places of interfaces. Rates of the amplitudes give their rates.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (inertia in modes).

use std::ops::Range;

use nalgebra::Vector3;

use super::{ModalStrain, ReducedModel, Symmetric};
use crate::math::jet::Number;
use crate::math::lanes::{AlignedPack, PACK};

/// The matrix, in blocks of terms.
#[derive(Clone, Debug)]
pub struct ModalMatrix {
    layout: Layout,
    /// Terms without deformation, `[terms]`.
    undeformed: Vec<f64>,
    /// Terms of every block.
    rows: [Range<usize>; 4],
    /// Columns of every block, by amplitudes of all modes or of those that form pairs.
    columns: [Vec<AlignedPack>; 4],
}

/// Blocks of terms that velocities depend on: couplings and places.
const OF_VELOCITIES: usize = 2;

/// Where terms stand: `3 n` numbers of couplings, `3 n` an interface of places, `6 n` of the inertia, `n strained` of pairs. Blocks are padded to
/// whole packs.
#[derive(Clone, Copy, Debug)]
struct Layout {
    modes: usize,
    /// Number of first modes whose pairs change strains.
    strained: usize,
    /// First numbers of blocks.
    places: usize,
    inertia: usize,
    pairs: usize,
}

impl ModalMatrix {
    /// Matrix of a model and its strain energy.
    pub fn new(model: &ReducedModel, strain: &ModalStrain) -> Self {
        let (n, paired, strained) = (model.modes(), model.paired, strain.paired());
        let sizes = [3 * n, 3 * n * model.interfaces.len(), 6 * n, n * strained];
        let mut end = 0;
        let rows = sizes.map(|size| {
            let start = end;
            end += size.next_multiple_of(PACK);
            start..end
        });
        let mut undeformed = vec![0.0; end];
        let shapes = model.interfaces.iter().flat_map(|of| &of.modes);
        let shapes = shapes.flat_map(|shape| shape.iter());
        let inertia = model.inertia_1.iter().flatten();
        let places = undeformed[rows[1].start..].iter_mut().zip(shapes);
        places.for_each(|(out, shape)| *out = *shape);
        let inertias = undeformed[rows[2].start..].iter_mut().zip(inertia);
        inertias.for_each(|(out, inertia)| *out = *inertia);
        let mut columns = [const { Vec::<f64>::new() }; 4];
        for l in 0..n {
            let coupling = |k: usize| <[f64; 3]>::from(-model.coupling[n * k + l]);
            columns[0].extend((0..n).flat_map(coupling));
            columns[2].extend((0..n).flat_map(|k| model.inertia_2[n * k + l].map(|j| 2.0 * j)));
            if l < paired {
                for interface in &model.interfaces {
                    let pair = |k: usize| interface.second.get(paired * k + l);
                    let second = |k: usize| pair(k).filter(|_| k < paired).copied();
                    let shape = |k: usize| <[f64; 3]>::from(second(k).unwrap_or_default());
                    columns[1].extend((0..n).flat_map(shape));
                }
            }
            if l < strained {
                let weights = strain.weights();
                columns[3].extend((0..n * strained).map(|at| weights[at * strained + l]));
            }
            for (columns, rows) in columns.iter_mut().zip(&rows) {
                columns.resize(columns.len().next_multiple_of(rows.len().max(1)), 0.0);
            }
        }
        Self {
            layout: Layout {
                modes: n,
                strained,
                places: rows[1].start,
                inertia: rows[2].start,
                pairs: rows[3].start,
            },
            undeformed,
            rows,
            columns: columns.map(|columns| {
                let packs = columns.as_chunks().0.iter();
                packs.map(|pack| AlignedPack(*pack)).collect()
            }),
        }
    }

    /// Terms without deformation, `[terms]`.
    pub fn undeformed(&self) -> &[f64] {
        &self.undeformed
    }

    /// Takes terms without deformation to those at amplitudes of the modes, `[n]`.
    #[inline(always)]
    pub fn deform(&self, eta: &[f64], terms: &mut [f64]) {
        self.add(self.rows.len(), eta, terms);
    }

    /// Writes the rates of the terms at rates of the amplitudes, `[n]`.
    #[inline(always)]
    pub fn rates<N: Number>(&self, rates: &[N], terms: &mut [N]) {
        terms.fill(N::of(0.0));
        self.add(self.rows.len(), rates, terms);
    }

    /// Writes the rates of couplings and places alone, which velocities and forces depend on.
    #[inline(always)]
    pub fn rates_of_velocities(&self, rates: &[f64], terms: &mut [f64]) {
        terms[..self.layout.inertia].fill(0.0);
        self.add(OF_VELOCITIES, rates, terms);
    }

    /// Adds the products of the first blocks.
    #[inline(always)]
    fn add<N: Number>(&self, blocks: usize, eta: &[N], terms: &mut [N]) {
        for (rows, columns) in self.rows.iter().zip(&self.columns).take(blocks) {
            N::add_columns(columns, eta, &mut terms[rows.clone()]);
        }
    }

    /// Reads terms.
    #[inline(always)]
    pub fn read<'a, N>(&self, numbers: &'a [N]) -> ModalTerms<'a, N> {
        ModalTerms {
            layout: self.layout,
            numbers,
        }
    }
}

/// Terms at amplitudes of the modes, or their rates.
#[derive(Clone, Copy, Debug)]
pub struct ModalTerms<'a, N = f64> {
    layout: Layout,
    numbers: &'a [N],
}

impl<'a, N: Number> ModalTerms<'a, N> {
    /// Couplings `h_k = sum_l N_lk eta_l`, `[n]`.
    #[inline(always)]
    pub fn couplings(self) -> &'a [[N; 3]] {
        self.numbers[..3 * self.layout.modes].as_chunks().0
    }

    /// Coupling of a mode.
    #[inline(always)]
    pub fn coupling(self, k: usize) -> Vector3<N> {
        self.couplings()[k].into()
    }

    /// Derivatives `dJ / d eta_k = J1_k + 2 sum_l J2_kl eta_l` of the inertia, `[n]`.
    #[inline(always)]
    pub fn inertia(self) -> &'a [Symmetric<N>] {
        let Layout { modes, inertia, .. } = self.layout;
        self.numbers[inertia..inertia + 6 * modes].as_chunks().0
    }

    /// `sum_l theta^m_kl eta_l` of the pairs of a mode `m` of a strain, `[strained]`.
    #[inline(always)]
    pub fn pairs(self, m: usize) -> &'a [N] {
        let strained = self.layout.strained;
        &self.numbers[self.layout.pairs + m * strained..][..strained]
    }

    /// Derivatives of the place of an interface by the amplitudes, m, `[n]`.
    #[inline(always)]
    pub fn shapes(self, interface: usize) -> &'a [[N; 3]] {
        let size = 3 * self.layout.modes;
        let first = self.layout.places + size * interface;
        self.numbers[first..first + size].as_chunks().0
    }

    /// Velocity of an interface along the axes of the body at rates of the amplitudes, m/s. Of rates of the terms it is what rates alone ask of the
    /// acceleration, `sum u_kl eta_k' eta_l'`.
    #[inline(always)]
    pub fn velocity(self, interface: usize, rates: &[N]) -> Vector3<N> {
        let mut sum = Vector3::from_element(N::of(0.0));
        for (shape, rate) in self.shapes(interface).iter().zip(rates) {
            sum += Vector3::from(*shape) * *rate;
        }
        sum
    }
}
