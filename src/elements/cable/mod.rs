//! ANCF cable: stretches and bends, no shear, no rotary inertia.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eqs. 5-12 (kinematics and mass);
//! J. Gerstmayr, H. Irschik, On the correct representation of bending and axial deformation in the
//! absolute nodal coordinate formulation with an elastic line approach, J. Sound Vib. 318 (2008)
//! (strain measures); M. Berzeri, A. A. Shabana, Development of simple models for the elastic forces
//! in the absolute nodal co-ordinate formulation, J. Sound Vib. 235 (2000) (Green strain).
//!
//! Quadrature decides accuracy: axial strain at three points, of Gauss where the element is short and
//! of Lobatto where it is slender and would lock otherwise; bending at two Gauss points
//! (docs/decisions/0003-quadrature.md); at the free end of a cable without bending stiffness at three points of
//! Radau (docs/decisions/0021-stable-equilibria.md).

mod kernel;
mod section_variation;
#[cfg(test)]
mod tests;

use nalgebra::{SMatrix, SVector};

use super::{
    BlockPack, Blocks, Element, ElementMotion, EndBlocks, Nodal, NodalPack, NodalView,
    StrainMeasure, shape,
};
use crate::math::jet::Number;
use crate::math::lanes::{Lanes, PACK, Real, Simd};
use crate::math::quadrature::{GAUSS_3, GAUSS_5};
use kernel::{Factors, Kernel, Line, Sampling, TURNS, transposed};
pub use section_variation::SectionVariation;
pub(in crate::elements) use section_variation::line_mass;
use section_variation::mass;

/// Slenderness EA l^2 / EI up to which axial strain is sampled at Gauss points: they halve the error
/// of stretching waves and cost bending less than they gain; beyond it they lock.
const SLENDER: f64 = 200.0;

/// Kind of body whose line a cable element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineOf {
    /// A cable: it stretches and bends itself.
    Cable,
    /// A rod, whose sections bend and twist.
    Rod,
    /// A beam, whose sections stretch too; or a rod whose stretching is coupled with twist or bending.
    Beam,
}

/// Parameters of a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Reference length, m.
    pub length: f64,
    /// Axial stiffness EA, N.
    pub axial_stiffness: f64,
    /// Bending stiffness EI, N m^2.
    pub bending_stiffness: f64,
    /// Kind of body whose line the element is. The line of a rod does not resist bending itself, that of a beam neither
    /// bending nor stretching.
    pub line_of: LineOf,
    /// Mass per reference length, kg/m.
    pub line_density: f64,
    /// Kelvin-Voigt damping time of axial strain: force is stiffness times (strain + time x strain rate), s.
    pub axial_damping_time: f64,
    /// Damping time of bending, s.
    pub bending_damping_time: f64,
    /// Strain measure.
    pub strain: StrainMeasure,
    /// Mass matrix.
    pub inertia: Inertia,
}

impl Parameters {
    /// The longer of both damping times, s.
    pub fn longest_damping_time(&self) -> f64 {
        self.axial_damping_time.max(self.bending_damping_time)
    }
}

/// Mass matrices; they differ in what the quadratic and cubic parts of the velocity in an element
/// (Legendre polynomials) count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inertia {
    /// The integral of the shape functions' products (report Eq. 12).
    Consistent,
    /// Consistent matrix for all parts of the velocity that are linear in an element, which leaves momentum and rigid
    /// motion unchanged. Quadratic parts count twice and cubic parts 26/3 times. This makes the dispersion of bending
    /// waves exact to the eighth order in wave number times length, instead of the fourth
    /// (docs/decisions/0012-mass-against-dispersion.md).
    Corrected,
}

/// An ANCF cable element in the plane (`D` = 2) or in space (3). Natural curvature is planar: in space a cable
/// without torsion has no frame to measure it in. Damping of bending acts on the size of the curvature.
#[derive(Clone, Debug)]
pub struct Cable<const D: usize = 2> {
    parameters: Parameters,
    taper: SectionVariation,
    kernel: Kernel<f64>,
    mass: SMatrix<f64, 4, 4>,
}

/// Up to [`PACK`] cables.
#[derive(Clone, Debug)]
pub struct Pack {
    kernel: Kernel<[f64; PACK]>,
    count: usize,
}

impl Pack {
    /// Number of groups of as many elements as there are lanes.
    #[inline(always)]
    fn groups<S: Simd>(&self) -> usize {
        self.count.div_ceil(S::F64_LANES)
    }
}

#[inline(always)]
fn read<S: Simd, const D: usize>(
    simd: S,
    pack: NodalView<'_, D>,
    group: usize,
) -> [[Lanes<S>; D]; 4] {
    let mut e = [[Lanes::read(simd, pack[0][0], group); D]; 4];
    for k in 0..4 {
        for d in 0..D {
            e[k][d] = Lanes::read(simd, pack[k][d], group);
        }
    }
    e
}

#[inline(always)]
fn write<S: Simd, const D: usize>(
    blocks: &EndBlocks<Lanes<S>, D>,
    out: &mut BlockPack<D>,
    group: usize,
) {
    for part in 0..3 {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            for r in 0..D {
                for c in 0..D {
                    blocks[part][i][j][r][c].write(&mut out[part][i][j][r][c], group);
                }
            }
        }
    }
}

impl<const D: usize> Cable<D> {
    /// A cable whose unstressed shape is the straight line or, with `shape` its coordinates, the
    /// curve through them.
    pub fn new(parameters: Parameters, shape: Option<&Nodal<D>>) -> Self {
        Self::tapered(parameters, SectionVariation::default(), shape)
    }

    /// Builds a cable element whose section varies along its length. `shape` holds the coordinates of the unstressed
    /// shape, straight if `None`.
    pub fn tapered(
        parameters: Parameters,
        taper: SectionVariation,
        shape: Option<&Nodal<D>>,
    ) -> Self {
        let p = &parameters;
        let stretching = p.axial_stiffness * p.length * p.length;
        let sampling = if stretching > SLENDER * p.bending_stiffness {
            Sampling::Lobatto
        } else {
            Sampling::Between
        };
        let (own_stretching, own_bending) = match p.line_of {
            LineOf::Cable => (p.axial_stiffness, p.bending_stiffness),
            LineOf::Rod => (p.axial_stiffness, 0.0),
            LineOf::Beam => (0.0, 0.0),
        };
        let mut kernel = Kernel {
            length: p.length,
            inverse_length: 1.0 / p.length,
            axial_stiffness: sampling.of(own_stretching, &taper.axial),
            bending_stiffness: GAUSS_3.map(|point| own_bending * taper.bending.at(point.at)),
            axial_damping_time: p.axial_damping_time,
            bending_damping_time: p.bending_damping_time,
            natural_strain: [0.0; 3],
            natural_curvature: [[0.0; TURNS]; 3],
            sampling,
            strain: p.strain,
            is_damped: p.longest_damping_time() > 0.0,
            bends: own_bending > 0.0,
        };
        if let Some(e) = shape {
            (kernel.natural_strain, kernel.natural_curvature) = kernel.strains(&e.data.0);
        }
        Self {
            mass: mass(&parameters, &taper, p.bending_stiffness > 0.0),
            parameters,
            taper,
            kernel,
        }
    }

    /// Strain and curvature, or their rates, are derived from these.
    fn line<N: Number>(&self, e: &Nodal<D, N>, xi: f64) -> Line<N, D> {
        let (xi, l) = (N::of(xi), self.parameters.length);
        let [u, w] = [shape::slopes(xi, l), shape::curvatures(xi, l)].map(|s| (e * s).into());
        Line { u, w }
    }

    /// [`Element::weight`] of the part of the element up to `xi` in [0, 1], kg and kg m.
    pub fn weight_before(&self, xi: f64) -> SVector<f64, 4> {
        let taper = &self.taper.density;
        if taper.is_uniform() {
            return shape::integrals(xi, self.parameters.length) * self.mean_density();
        }
        self.integral_before(xi, |at| self.parameters.line_density * taper.at(at))
    }

    /// Integrates mass times the shape functions from 0 to `xi` in [0, 1], kg and kg m. Fluid that moves along is
    /// included.
    pub fn moved_before(&self, xi: f64) -> SVector<f64, 4> {
        let (parameters, taper) = (&self.parameters, &self.taper);
        if taper.moves_evenly() {
            return shape::integrals(xi, parameters.length) * taper.mean_moved(parameters);
        }
        self.integral_before(xi, |at| taper.moved(parameters, at))
    }

    /// Integral of a density times the shape functions up to a place.
    fn integral_before(&self, xi: f64, density: impl Fn(f64) -> f64) -> SVector<f64, 4> {
        let l = self.parameters.length;
        let terms = GAUSS_5.iter().map(|point| {
            let at = point.at * xi;
            shape::values(at, l) * (point.weight * xi * l * density(at))
        });
        terms.sum()
    }

    /// Mean mass per reference length, kg/m.
    fn mean_density(&self) -> f64 {
        self.parameters.line_density * self.taper.density.mean()
    }

    /// Curvature of the position field at `xi` in [0, 1] less that of the unstressed shape, in the planes that vectors
    /// span, 1/m.
    pub fn curvature_change<N: Number>(&self, e: &Nodal<D, N>, xi: f64) -> [N; TURNS] {
        let kernel = self.kernel.lift::<N>();
        let mut change = kernel.curvature(&self.line(e, xi)).value;
        for (change, natural) in change.iter_mut().zip(kernel.natural_curvature_at(xi)) {
            *change -= natural;
        }
        change
    }
}

/// Returns the curvature with its sign in the plane, its size in space.
fn signed<N: Number, const D: usize>(curvature: &[N; TURNS]) -> N {
    if D == 2 {
        return curvature[0];
    }
    let square = curvature.iter().fold(N::of(0.0), |sum, c| sum + *c * *c);
    // The size of a straight cable's curvature has no derivatives.
    if square > N::of(0.0) {
        square.root()
    } else {
        N::of(0.0)
    }
}

impl<const D: usize> Element<D> for Cable<D> {
    type Pack = Pack;

    fn length(&self) -> f64 {
        self.parameters.length
    }

    /// Tension vanishes at a free end, and with it all that holds the direction of a cable without bending
    /// stiffness there if strain is sampled at that point; so it is not (docs/decisions/0021-stable-equilibria.md).
    fn with_free_ends(&self, shape: &Nodal<D>, free: [bool; 2]) -> Self {
        let mut element = self.clone();
        if self.bends() || self.kernel.sampling != Sampling::Lobatto {
            return element;
        }
        element.kernel.sampling = match free {
            [false, false] => Sampling::Lobatto,
            [false, true] => Sampling::FreeLast,
            [true, false] => Sampling::FreeFirst,
            [true, true] => Sampling::Between,
        };
        let (stiffness, sampling) = (self.parameters.axial_stiffness, element.kernel.sampling);
        element.kernel.axial_stiffness = sampling.of(stiffness, &self.taper.axial);
        if self.kernel.natural_strain != [0.0; 3] {
            element.kernel.natural_strain = element.kernel.strains(&shape.data.0).0;
        }
        element
    }

    fn axial_stiffness(&self) -> f64 {
        self.parameters.axial_stiffness * self.taper.axial.mean()
    }

    fn with_bending(&self, shape: &Nodal<D>, stiffness: f64) -> Self {
        if self.bends() {
            return self.clone();
        }
        let mut element = self.clone();
        (element.kernel.bends, element.kernel.bending_stiffness) = (true, [stiffness; 3]);
        element.mass = mass(&self.parameters, &self.taper, true);
        if self.kernel.natural_strain != [0.0; 3] {
            element.kernel.natural_curvature = element.kernel.strains(&shape.data.0).1;
        }
        element
    }

    fn mass(&self) -> SMatrix<f64, 4, 4> {
        self.mass
    }

    fn weight(&self) -> SVector<f64, 4> {
        let l = self.parameters.length;
        if self.taper.density.is_uniform() {
            SVector::from([0.5, l / 12.0, 0.5, -l / 12.0]) * (self.mean_density() * l)
        } else {
            self.weight_before(1.0)
        }
    }

    fn energy_by<N: Number>(&self, e: &Nodal<D, N>, by: N) -> N {
        let kernel = self.kernel.lift::<N>().shortened(by);
        kernel.energy(&(e * by).data.0) / by
    }

    fn force_by<N: Number>(&self, e: &Nodal<D, N>, rate: &Nodal<D, N>, by: N) -> (Nodal<D, N>, N) {
        let kernel = self.kernel.lift::<N>().shortened(by);
        let rate = self.kernel.is_damped.then(|| (rate * by).data.0);
        let (force, power) = kernel.force(&(e * by).data.0, rate.as_ref());
        (Nodal::from(force), power / by)
    }

    fn stiffness(&self, e: &Nodal<D>, rate: &Nodal<D>) -> Blocks<D> {
        let rate = self.kernel.is_damped.then_some(&rate.data.0);
        let sum = self.kernel.tangent(&e.data.0, rate, Factors::elastic(1.0));
        whole(&self.kernel.ends(&sum))
    }

    fn damping(&self, e: &Nodal<D>) -> Blocks<D> {
        let factors = Factors::damped(0.0, &self.kernel);
        let sum = self.kernel.tangent(&e.data.0, None, factors);
        whole(&self.kernel.ends(&sum))
    }

    fn is_damped(&self) -> bool {
        self.kernel.is_damped
    }

    fn resists(&self) -> bool {
        self.parameters.line_of != LineOf::Beam
    }

    fn bends(&self) -> bool {
        self.kernel.bends || self.parameters.line_of != LineOf::Cable
    }

    fn strain<N: Number>(&self, e: &Nodal<D, N>, xi: f64) -> (N, N) {
        let (at, kernel) = (self.line(e, xi), self.kernel.lift::<N>());
        let square = at.u.iter().fold(N::of(0.0), |sum, u| sum + *u * *u);
        (
            kernel.axial(square).0,
            signed::<N, D>(&kernel.curvature(&at).value),
        )
    }

    fn recovered_strain<N: Number>(
        &self,
        e: &Nodal<D, N>,
        rate: Option<&Nodal<D, N>>,
        xi: f64,
    ) -> N {
        let kernel = self.kernel.lift::<N>();
        let rate = rate.map(|rate| &rate.data.0);
        kernel.recover(kernel.axial_samples(&e.data.0, rate), xi)
    }

    fn goes_with(&self, other: &Self) -> bool {
        let (a, b) = (&self.kernel, &other.kernel);
        let kind = |k: &Kernel<f64>| (k.strain, k.sampling, k.is_damped, k.bends);
        kind(a) == kind(b)
    }

    fn pack(elements: &[Self]) -> Pack {
        let last = elements.len() - 1;
        let lanes = |of: &dyn Fn(&Kernel<f64>) -> f64| -> [f64; PACK] {
            std::array::from_fn(|lane| of(&elements[lane.min(last)].kernel))
        };
        let first = &elements[0].kernel;
        let kernel = Kernel {
            length: lanes(&|k| k.length),
            inverse_length: lanes(&|k| k.inverse_length),
            axial_stiffness: std::array::from_fn(|i| lanes(&|k| k.axial_stiffness[i])),
            bending_stiffness: std::array::from_fn(|i| lanes(&|k| k.bending_stiffness[i])),
            axial_damping_time: lanes(&|k| k.axial_damping_time),
            bending_damping_time: lanes(&|k| k.bending_damping_time),
            natural_strain: std::array::from_fn(|i| lanes(&|k| k.natural_strain[i])),
            natural_curvature: std::array::from_fn(|i| {
                std::array::from_fn(|c| lanes(&|k| k.natural_curvature[i][c]))
            }),
            sampling: first.sampling,
            strain: first.strain,
            is_damped: first.is_damped,
            bends: first.bends,
        };
        Pack {
            kernel,
            count: elements.len(),
        }
    }

    #[inline(always)]
    fn pack_force<S: Simd>(
        simd: S,
        pack: &Pack,
        motion: ElementMotion<NodalView<'_, D>>,
        by: f64,
        out: &mut NodalPack<D>,
    ) -> f64 {
        let mut powers = [0.0; PACK];
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group, by);
            let e = read(simd, motion.at, group);
            let (f, power) = match motion.rates {
                Some(rate) => kernel.force(&e, Some(&read(simd, rate, group))),
                None => kernel.force(&e, None),
            };
            for k in 0..4 {
                for d in 0..D {
                    f[k][d].write(&mut out[k][d], group);
                }
            }
            if motion.rates.is_some() {
                power.write(&mut powers, group);
            }
        }
        let mut sum = 0.0;
        for power in &powers[..pack.count] {
            sum += power;
        }
        sum
    }

    #[inline(always)]
    fn pack_stiffness<S: Simd>(
        simd: S,
        pack: &Pack,
        motion: ElementMotion<NodalView<'_, D>>,
        by: f64,
        out: &mut BlockPack<D>,
    ) {
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group, by).by_roots(by);
            let e = read(simd, motion.at, group);
            let one = kernel.length.constant(1.0);
            let sum = match motion.rates {
                Some(rate) => {
                    kernel.tangent(&e, Some(&read(simd, rate, group)), Factors::elastic(one))
                }
                None => kernel.tangent(&e, None, Factors::elastic(one)),
            };
            write(&kernel.ends(&sum), out, group);
        }
    }

    #[inline(always)]
    fn pack_damping<S: Simd>(
        simd: S,
        pack: &Pack,
        e: NodalView<'_, D>,
        by: f64,
        out: &mut BlockPack<D>,
    ) {
        for group in 0..pack.groups::<S>() {
            let kernel = pack.kernel.group(simd, group, by).by_roots(by);
            let e = read(simd, e, group);
            let factors = Factors::damped(kernel.length.constant(0.0), &kernel);
            write(&kernel.ends(&kernel.tangent(&e, None, factors)), out, group);
        }
    }
}

/// All blocks from those of the lower triangle.
fn whole<const D: usize>([aa, ba, bb]: &EndBlocks<f64, D>) -> Blocks<D> {
    let block = |of: &[[f64; D]; D]| SMatrix::from_fn(|r, c| of[r][c]);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i / 2, j / 2) {
            (0, 0) => block(&aa[i][j]),
            (1, 0) => block(&ba[i - 2][j]),
            (1, 1) => block(&bb[i - 2][j - 2]),
            _ => block(&transposed(&ba[j - 2][i])),
        })
    })
}
