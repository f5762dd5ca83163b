//! Floor 1. Finite elements: parameters, mass, force and tangent of one element. An element knows
//! neither nodes nor bodies; it sees its own coordinates `e` and their rates.
//!
//! Vectors are stored as the columns of a `D` x 4 matrix (position and slope at both ends), so that
//! one file serves the plane and space. Mass is a scalar 4 x 4 matrix times the identity of space.

#[macro_use]
mod line;
mod along;
pub mod beam;
pub mod cable;
mod constitutive;
pub mod reduced;
pub mod rod;
pub mod saint_venant;
pub mod section;
pub mod shape;
pub mod shell;

pub use along::ElementPolynomial;
use nalgebra::{SMatrix, SVector};

use crate::math::jet::Number;
use crate::math::lanes::{PACK, Simd};

/// Coordinates of an element, their rates, or forces on them: the columns are position and slope at
/// the first end, position and slope at the second (report Eqs. 10-11).
pub type Nodal<const D: usize, N = f64> = SMatrix<N, D, 4>;

/// A symmetric matrix over the coordinates of an element, as 4 x 4 blocks of `D` x `D`.
pub type Blocks<const D: usize> = [[SMatrix<f64, D, D>; 4]; 4];

/// Forces on the coordinates of a pack of elements: every coordinate of all elements side by side.
pub type NodalPack<const D: usize> = [[[f64; PACK]; D]; 4];

/// Coordinates of a pack of elements, or their rates, wherever they stand: every coordinate of all elements side by side.
pub type NodalView<'a, const D: usize> = [[&'a [f64; PACK]; D]; 4];

/// Motion of the elements of a pack: coordinates and rates, wherever they stand.
#[derive(Clone, Copy, Debug)]
pub struct ElementMotion<A, R = A> {
    /// Coordinates.
    pub at: A,
    /// Rates of the coordinates, where the elements are damped.
    pub rates: Option<R>,
}

impl<A, R> ElementMotion<A, R> {
    /// Coordinates, and rates where the elements are damped.
    #[inline(always)]
    pub fn new(at: A, rates: Option<R>) -> Self {
        Self { at, rates }
    }
}

/// [`EndBlocks`] of a pack of elements.
pub type BlockPack<const D: usize> = EndBlocks<[f64; PACK], D>;

/// The lower triangle of a symmetric matrix over the coordinates of an element: first end, second end
/// with first, second end; each 2 x 2 blocks of `D` x `D`.
pub type EndBlocks<N, const D: usize> = [[[[[N; D]; D]; 2]; 2]; 3];

/// Strain measures. They agree only for small strains; the energy is half the integral of
/// `EA axial^2 + EI bending^2` over the reference length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrainMeasure {
    /// Axial `|r'| - 1`, bending: rotation per reference length (Gerstmayr & Irschik 2008).
    ThetaPrime,
    /// Axial `(r'.r' - 1) / 2`, bending: curvature of the deformed line (Berzeri & Shabana 2000).
    GreenLagrangeFrenetKappa,
    /// Axial `|r'| - 1`, bending: curvature of the deformed line.
    EngStrainFrenetKappa,
}

/// Interface of an element to its body.
pub trait Element<const D: usize>: Clone + Send + Sync {
    /// Elements that are computed in lanes.
    type Pack: Clone + Send + Sync + std::fmt::Debug;
    /// Reference length, m.
    fn length(&self) -> f64;
    /// Returns a copy for an element with free ends. `free` tells whether nothing is joined to the first and to the
    /// last end, nor acts there. `shape` holds the coordinates of the unstressed shape.
    fn with_free_ends(&self, shape: &Nodal<D>, free: [bool; 2]) -> Self;
    /// Axial stiffness EA, N.
    fn axial_stiffness(&self) -> f64;
    /// Returns a copy with at least this bending stiffness, N m^2, for an element that has none.
    fn with_bending(&self, shape: &Nodal<D>, stiffness: f64) -> Self;
    /// Scalar mass matrix, kg (report Eq. 12); the full one is its Kronecker product with I.
    fn mass(&self) -> SMatrix<f64, 4, 4>;
    /// Forces on the coordinates per unit of uniform acceleration of space, kg: mass times the
    /// integral of the shape functions.
    fn weight(&self) -> SVector<f64, 4>;
    /// Strain energy, J.
    fn energy<N: Number>(&self, e: &Nodal<D, N>) -> N {
        self.energy_by(e, N::of(1.0))
    }
    /// Elastic and damping force on the coordinates, `-dU/de - R(e) de/dt`, N and N m.
    fn force<N: Number>(&self, e: &Nodal<D, N>, rate: &Nodal<D, N>) -> Nodal<D, N> {
        self.force_by(e, rate, N::of(1.0)).0
    }
    /// [`Self::energy`] where the element is longer than its reference length; `by` is that length over the one now. Coordinates
    /// stay those by the reference length.
    fn energy_by<N: Number>(&self, e: &Nodal<D, N>, by: N) -> N;
    /// [`Self::force`] where the element is longer than its reference length, and the power that damping takes out, W; rates are those
    /// without what lengthening by itself adds.
    fn force_by<N: Number>(&self, e: &Nodal<D, N>, rate: &Nodal<D, N>, by: N) -> (Nodal<D, N>, N);
    /// Tangent stiffness `-d force / de`, symmetric; with damping its symmetric part that matters,
    /// the rate of strain taken as given.
    fn stiffness(&self, e: &Nodal<D>, rate: &Nodal<D>) -> Blocks<D>;
    /// Damping matrix `R = -d force / d rate`, symmetric.
    fn damping(&self, e: &Nodal<D>) -> Blocks<D>;
    /// Whether the element dissipates.
    fn is_damped(&self) -> bool;
    /// Whether it has forces of its own: not the line of a beam, whose sections have them.
    fn resists(&self) -> bool;
    /// Whether the element has bending stiffness.
    fn bends(&self) -> bool;
    /// Axial strain and curvature (1/m) of the position field at `xi` in [0, 1], in the strain measure of the element.
    fn strain<N: Number>(&self, e: &Nodal<D, N>, xi: f64) -> (N, N);
    /// Axial strain at `xi` in [0, 1] as it balances loads: of a higher order than that of the position
    /// field. With rates it counts what damping adds.
    fn recovered_strain<N: Number>(
        &self,
        e: &Nodal<D, N>,
        rate: Option<&Nodal<D, N>>,
        xi: f64,
    ) -> N;
    /// Whether this element and another can be in one pack.
    fn goes_with(&self, other: &Self) -> bool;
    /// Up to [`PACK`] elements, for the calls below; entries beyond the number of elements do not count.
    fn pack(elements: &[Self]) -> Self::Pack;
    /// [`Self::force_by`] of a pack; with rates where it is damped. Coordinates and rates are given times `by`. The power that damping
    /// takes out of all its elements, by the reference length, W.
    fn pack_force<S: Simd>(
        simd: S,
        pack: &Self::Pack,
        motion: ElementMotion<NodalView<'_, D>>,
        by: f64,
        out: &mut NodalPack<D>,
    ) -> f64;
    /// [`Self::stiffness`] of a pack over its coordinates times the root of `by`; with rates where it is damped.
    fn pack_stiffness<S: Simd>(
        simd: S,
        pack: &Self::Pack,
        motion: ElementMotion<NodalView<'_, D>>,
        by: f64,
        out: &mut BlockPack<D>,
    );
    /// [`Self::damping`] of a pack over the same coordinates.
    fn pack_damping<S: Simd>(
        simd: S,
        pack: &Self::Pack,
        e: NodalView<'_, D>,
        by: f64,
        out: &mut BlockPack<D>,
    );
}
