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
//! (docs/decisions/0003-quadrature.md).

use nalgebra::{SMatrix, SVector};

use super::{Blocks, Element, Nodal, Strain, shape};
use crate::math::quadrature::{GAUSS_2, GAUSS_3, LOBATTO_3, Point};

/// Slenderness EA l^2 / EI up to which axial strain is sampled at Gauss points: they halve the error
/// of stretching waves and cost bending less than they gain; beyond it they lock.
const SLENDER: f64 = 200.0;

/// Parameters of a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Reference length, m.
    pub length: f64,
    /// Axial stiffness EA, N.
    pub axial_stiffness: f64,
    /// Bending stiffness EI, N m^2.
    pub bending_stiffness: f64,
    /// Mass per reference length, kg/m.
    pub line_density: f64,
    /// Kelvin-Voigt damping time: stress is stiffness times (strain + time x strain rate), s.
    pub damping_time: f64,
    /// Strain measure.
    pub strain: Strain,
}

/// An ANCF cable element in `D` dimensions; `C = D (D - 1) / 2` is the number of components of a
/// curvature: `Cable<2, 1>` in the plane, `Cable<3, 3>` in space. Natural curvature and damping of
/// bending are planar: in space a cable without torsion has no frame to measure them in.
#[derive(Clone, Debug)]
pub struct Cable<const D: usize, const C: usize> {
    parameters: Parameters,
    /// Where axial strain is sampled.
    axial: &'static [Sample; 3],
    /// Axial strain of the unstressed shape at the axial points.
    natural_strain: [f64; 3],
    /// Curvature of the unstressed shape at the bending points, 1/m.
    natural_curvature: [[f64; C]; 2],
}

/// Weights of the vectors `(r_B - r_A) / l`, slope at A, slope at B in `r'` and `l r''`. Rigid
/// translation drops out, which is why forces and tangents are summed over three vectors, not four.
type Combination = [f64; 3];

/// A quadrature point with the weights of the vectors there.
#[derive(Debug)]
struct Sample {
    weight: f64,
    slope: Combination,
    curvature: Combination,
}

const fn sample(point: Point) -> Sample {
    let at = point.at;
    let square = at * at;
    Sample {
        weight: point.weight,
        slope: [
            6.0 * (at - square),
            1.0 - 4.0 * at + 3.0 * square,
            3.0 * square - 2.0 * at,
        ],
        curvature: [6.0 - 12.0 * at, 6.0 * at - 4.0, 6.0 * at - 2.0],
    }
}

static GAUSS: [Sample; 3] = [sample(GAUSS_3[0]), sample(GAUSS_3[1]), sample(GAUSS_3[2])];
static LOBATTO: [Sample; 3] = [
    sample(LOBATTO_3[0]),
    sample(LOBATTO_3[1]),
    sample(LOBATTO_3[2]),
];
static BENDING: [Sample; 2] = [sample(GAUSS_2[0]), sample(GAUSS_2[1])];

fn combine<const D: usize>(weights: Combination, v: &[SVector<f64, D>; 3]) -> SVector<f64, D> {
    v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
}

/// Exterior product u ^ w: the signed area in the plane, the cross product (reordered) in space.
fn wedge<const D: usize, const C: usize>(u: &SVector<f64, D>, w: &SVector<f64, D>) -> [f64; C] {
    let (mut c, mut k) = ([0.0; C], 0);
    for i in 0..D {
        for j in i + 1..D {
            c[k] = u[i] * w[j] - u[j] * w[i];
            k += 1;
        }
    }
    c
}

/// Contraction with the exterior product: `act(m, u) . w = m . (u ^ w)`.
fn act<const D: usize, const C: usize>(m: &[f64; C], u: &SVector<f64, D>) -> SVector<f64, D> {
    let (mut out, mut k) = (SVector::zeros(), 0);
    for i in 0..D {
        for j in i + 1..D {
            out[j] += m[k] * u[i];
            out[i] -= m[k] * u[j];
            k += 1;
        }
    }
    out
}

fn dot<const C: usize>(a: &[f64; C], b: &[f64; C]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Second derivatives of an energy density by `u = r'` and `w = r''`.
struct Hessian<const D: usize> {
    uu: SMatrix<f64, D, D>,
    uw: SMatrix<f64, D, D>,
    ww: SMatrix<f64, D, D>,
}

impl<const D: usize, const C: usize> Cable<D, C> {
    /// A cable whose unstressed shape is the straight line or, with `shape` its coordinates, the
    /// curve through them.
    pub fn new(parameters: Parameters, shape: Option<&Nodal<D>>) -> Self {
        let p = &parameters;
        let slender = p.axial_stiffness * p.length * p.length > SLENDER * p.bending_stiffness;
        let mut cable = Self {
            parameters,
            axial: if slender { &LOBATTO } else { &GAUSS },
            natural_strain: [0.0; 3],
            natural_curvature: [[0.0; C]; 2],
        };
        if let Some(e) = shape {
            let v = cable.vectors(e);
            cable.natural_strain = cable
                .axial
                .each_ref()
                .map(|p| cable.axial(combine(p.slope, &v).norm_squared()).0);
            cable.natural_curvature = BENDING.each_ref().map(|p| {
                let (u, w) = cable.derivatives(p, &v);
                cable.curvature(&u, &w).0
            });
        }
        cable
    }

    fn vectors(&self, e: &Nodal<D>) -> [SVector<f64, D>; 3] {
        let chord = (e.column(2) - e.column(0)) / self.parameters.length;
        [chord, e.column(1).into(), e.column(3).into()]
    }

    fn derivatives(
        &self,
        at: &Sample,
        v: &[SVector<f64, D>; 3],
    ) -> (SVector<f64, D>, SVector<f64, D>) {
        (
            combine(at.slope, v),
            combine(at.curvature, v) / self.parameters.length,
        )
    }

    /// Axial strain and its derivatives as functions of `a = r'.r'`: strain, `f` and `g` in
    /// `d strain = f u.du`, `d^2 strain = f du.du + g (u.du)^2`.
    fn axial(&self, a: f64) -> (f64, f64, f64) {
        match self.parameters.strain {
            Strain::GreenLagrangeFrenetKappa => (0.5 * (a - 1.0), 1.0, 0.0),
            Strain::ThetaPrime | Strain::EngStrainFrenetKappa => {
                let stretch = a.sqrt();
                let inverse = 1.0 / stretch;
                (stretch - 1.0, inverse, -inverse / a)
            }
        }
    }

    /// Curvature `c a^-p` with `c = u ^ w`, `a^-p`, and `p / a`; `p` is 1 for the rotation per
    /// reference length and 3/2 for the curvature of the deformed line.
    fn curvature(&self, u: &SVector<f64, D>, w: &SVector<f64, D>) -> ([f64; C], f64, f64) {
        let inverse = 1.0 / u.norm_squared();
        let (scale, power) = match self.parameters.strain {
            Strain::ThetaPrime => (inverse, 1.0),
            _ => (inverse * inverse.sqrt(), 1.5),
        };
        (wedge(u, w).map(|c: f64| c * scale), scale, power * inverse)
    }

    /// Rate of curvature (planar).
    fn curvature_rate(
        &self,
        (u, w): (&SVector<f64, D>, &SVector<f64, D>),
        (du, dw): (&SVector<f64, D>, &SVector<f64, D>),
    ) -> [f64; C] {
        let (curvature, scale, decay) = self.curvature(u, w);
        let (first, second) = (wedge::<D, C>(du, w), wedge::<D, C>(u, dw));
        let shrink = 2.0 * decay * u.dot(du);
        std::array::from_fn(|k| scale * (first[k] + second[k]) - shrink * curvature[k])
    }

    /// Gradient of `m . curvature` by u and w.
    fn curvature_gradient(
        (u, w): (&SVector<f64, D>, &SVector<f64, D>),
        (curvature, scale, decay): ([f64; C], f64, f64),
        m: &[f64; C],
    ) -> (SVector<f64, D>, SVector<f64, D>) {
        let by_u = -act(m, w) * scale - u * (2.0 * decay * dot(m, &curvature));
        (by_u, act(m, u) * scale)
    }

    fn axial_stress(
        &self,
        index: usize,
        u: &SVector<f64, D>,
        du: &SVector<f64, D>,
    ) -> (f64, f64, f64) {
        let p = &self.parameters;
        let (strain, f, g) = self.axial(u.norm_squared());
        let mut total = strain - self.natural_strain[index];
        if p.damping_time > 0.0 {
            total += p.damping_time * f * u.dot(du);
        }
        (p.axial_stiffness * total, f, g)
    }

    fn moment(
        &self,
        index: usize,
        at: (&SVector<f64, D>, &SVector<f64, D>),
        rate: (&SVector<f64, D>, &SVector<f64, D>),
        curvature: &[f64; C],
    ) -> [f64; C] {
        let p = &self.parameters;
        let natural = &self.natural_curvature[index];
        let mut m: [f64; C] = std::array::from_fn(|k| curvature[k] - natural[k]);
        if p.damping_time > 0.0 && C == 1 {
            let change = self.curvature_rate(at, rate);
            m.iter_mut()
                .zip(change)
                .for_each(|(m, c)| *m += p.damping_time * c);
        }
        m.map(|m| p.bending_stiffness * m)
    }

    /// Second derivatives of the bending energy density; `material` EI sums the squares of the
    /// gradients, `m` multiplies the second derivatives of the curvature.
    fn bending_hessian(
        &self,
        (u, w): (&SVector<f64, D>, &SVector<f64, D>),
        material: f64,
        m: &[f64; C],
    ) -> Hessian<D> {
        let all = self.curvature(u, w);
        let (curvature, scale, decay) = all;
        let mut h = Hessian {
            uu: SMatrix::zeros(),
            uw: SMatrix::zeros(),
            ww: SMatrix::zeros(),
        };
        for k in 0..C {
            let mut unit = [0.0; C];
            unit[k] = 1.0;
            let (gu, gw) = Self::curvature_gradient((u, w), all, &unit);
            h.uu += gu * gu.transpose() * material;
            h.uw += gu * gw.transpose() * material;
            h.ww += gw * gw.transpose() * material;
        }
        let (mu, mw) = (act(m, u) * scale, act(m, w) * scale);
        let mixed = u * mw.transpose() * (2.0 * decay);
        let along = 2.0 * decay * dot(m, &curvature);
        // 4 p (p + 1) / a^2 = (2 p / a) (2 p / a + 2 / a)
        let twice = along * (2.0 * decay + 2.0 / u.norm_squared());
        h.uu += mixed + mixed.transpose() + u * u.transpose() * twice;
        h.uw -= u * mu.transpose() * (2.0 * decay);
        let mut k = 0;
        for i in 0..D {
            h.uu[(i, i)] -= along;
            for j in i + 1..D {
                h.uw[(i, j)] += scale * m[k];
                h.uw[(j, i)] -= scale * m[k];
                k += 1;
            }
        }
        h
    }

    /// Tangent matrix: `stress` weights the geometric part (0 or 1), `material` the squares of the
    /// strain gradients.
    fn tangent(&self, e: &Nodal<D>, rate: &Nodal<D>, stress: f64, material: f64) -> Blocks<D> {
        let p = &self.parameters;
        let (v, dv) = (self.vectors(e), self.vectors(rate));
        let mut sum = [[SMatrix::<f64, D, D>::zeros(); 3]; 3];
        for (index, point) in self.axial.iter().enumerate() {
            let weights = point.slope;
            let u = combine(weights, &v);
            let (force, f, g) = self.axial_stress(index, &u, &combine(weights, &dv));
            let force = stress * force;
            let along = material * p.axial_stiffness * f * f + force * g;
            let mut h = u * u.transpose() * along;
            for i in 0..D {
                h[(i, i)] += force * f;
            }
            for i in 0..3 {
                for j in 0..=i {
                    sum[i][j] += h * (point.weight * weights[i] * weights[j]);
                }
            }
        }
        for (index, point) in BENDING.iter().enumerate() {
            let (s, c) = (point.slope, point.curvature.map(|c| c / p.length));
            let (u, w) = self.derivatives(point, &v);
            let (du, dw) = self.derivatives(point, &dv);
            let curvature = self.curvature(&u, &w).0;
            let m = self
                .moment(index, (&u, &w), (&du, &dw), &curvature)
                .map(|m| m * stress);
            let h = self.bending_hessian((&u, &w), material * p.bending_stiffness, &m);
            for i in 0..3 {
                for j in 0..=i {
                    let mixed = h.uw * (s[i] * c[j]) + h.uw.transpose() * (c[i] * s[j]);
                    sum[i][j] +=
                        (h.uu * (s[i] * s[j]) + mixed + h.ww * (c[i] * c[j])) * point.weight;
                }
            }
        }
        self.expand(&sum)
    }

    /// From the three vectors back to the four coordinate vectors, by the lower triangle.
    fn expand(&self, sum: &[[SMatrix<f64, D, D>; 3]; 3]) -> Blocks<D> {
        let l = self.parameters.length;
        let chord = sum[0][0] / l;
        let (a, b) = (sum[1][0], sum[2][0]);
        let (aa, ba, bb) = (sum[1][1] * l, sum[2][1] * l, sum[2][2] * l);
        let (at, bt) = (a.transpose(), b.transpose());
        [
            [chord, -at, -chord, -bt],
            [-a, aa, a, ba.transpose()],
            [-chord, at, chord, bt],
            [-b, ba, b, bb],
        ]
    }
}

impl<const D: usize, const C: usize> Element<D> for Cable<D, C> {
    fn length(&self) -> f64 {
        self.parameters.length
    }

    fn mass(&self) -> SMatrix<f64, 4, 4> {
        let l = self.parameters.length;
        let (a, b) = (13.0 / 35.0, 9.0 / 70.0);
        let (c, d) = (11.0 * l / 210.0, 13.0 * l / 420.0);
        let (f, g) = (l * l / 105.0, l * l / 140.0);
        SMatrix::from([[a, c, b, -d], [c, f, d, -g], [b, d, a, -c], [-d, -g, -c, f]])
            * (self.parameters.line_density * l)
    }

    fn weight(&self) -> SVector<f64, 4> {
        let l = self.parameters.length;
        SVector::from([0.5, l / 12.0, 0.5, -l / 12.0]) * (self.parameters.line_density * l)
    }

    fn energy(&self, e: &Nodal<D>) -> f64 {
        let p = &self.parameters;
        let v = self.vectors(e);
        let mut sum = 0.0;
        for (point, natural) in self.axial.iter().zip(self.natural_strain) {
            let strain = self.axial(combine(point.slope, &v).norm_squared()).0 - natural;
            sum += point.weight * p.axial_stiffness * strain * strain;
        }
        for (point, natural) in BENDING.iter().zip(&self.natural_curvature) {
            let (u, w) = self.derivatives(point, &v);
            let mut curvature = self.curvature(&u, &w).0;
            curvature.iter_mut().zip(natural).for_each(|(c, n)| *c -= n);
            sum += point.weight * p.bending_stiffness * dot(&curvature, &curvature);
        }
        0.5 * p.length * sum
    }

    fn force(&self, e: &Nodal<D>, rate: &Nodal<D>) -> Nodal<D> {
        let p = &self.parameters;
        let v = self.vectors(e);
        // Rates are only read where they are multiplied by a damping time.
        let dv = if p.damping_time > 0.0 {
            self.vectors(rate)
        } else {
            v
        };
        let mut sum = [SVector::<f64, D>::zeros(); 3];
        for (index, point) in self.axial.iter().enumerate() {
            let weights = point.slope;
            let u = combine(weights, &v);
            let (force, f, _) = self.axial_stress(index, &u, &combine(weights, &dv));
            let gradient = u * (point.weight * force * f);
            for i in 0..3 {
                sum[i] += gradient * weights[i];
            }
        }
        if p.bending_stiffness > 0.0 {
            for (index, point) in BENDING.iter().enumerate() {
                let (s, c) = (point.slope, point.curvature);
                let (u, w) = self.derivatives(point, &v);
                let (du, dw) = self.derivatives(point, &dv);
                let all = self.curvature(&u, &w);
                let m = self.moment(index, (&u, &w), (&du, &dw), &all.0);
                let (by_u, by_w) = Self::curvature_gradient((&u, &w), all, &m);
                let (by_u, by_w) = (by_u * point.weight, by_w * (point.weight / p.length));
                for i in 0..3 {
                    sum[i] += by_u * s[i] + by_w * c[i];
                }
            }
        }
        let l = p.length;
        Nodal::from_columns(&[sum[0], -sum[1] * l, -sum[0], -sum[2] * l])
    }

    fn stiffness(&self, e: &Nodal<D>, rate: &Nodal<D>) -> Blocks<D> {
        self.tangent(e, rate, 1.0, 1.0)
    }

    fn damping(&self, e: &Nodal<D>) -> Blocks<D> {
        self.tangent(e, &Nodal::zeros(), 0.0, self.parameters.damping_time)
    }

    fn is_damped(&self) -> bool {
        self.parameters.damping_time > 0.0
    }

    fn strain(&self, e: &Nodal<D>, xi: f64) -> (f64, f64) {
        let l = self.parameters.length;
        let (u, w) = (e * shape::slopes(xi, l), e * shape::curvatures(xi, l));
        let curvature = self.curvature(&u, &w).0;
        let signed = if C == 1 {
            curvature[0]
        } else {
            dot(&curvature, &curvature).sqrt()
        };
        (self.axial(u.norm_squared()).0, signed)
    }

    fn section(&self, e: &Nodal<D>, rate: &Nodal<D>, xi: f64) -> (f64, f64) {
        let p = &self.parameters;
        let (slopes, curvatures) = (shape::slopes(xi, p.length), shape::curvatures(xi, p.length));
        let (u, w) = (e * slopes, e * curvatures);
        let (du, dw) = (rate * slopes, rate * curvatures);
        let (strain, f, _) = self.axial(u.norm_squared());
        let [n0, n1, n2] = self.natural_strain;
        let natural = (n0 + n1 + n2) / 3.0;
        let stretching = strain - natural + p.damping_time * f * u.dot(&du);
        let bending: [f64; C] = if p.bending_stiffness > 0.0 {
            let (now, speed) = (
                self.curvature(&u, &w).0,
                self.curvature_rate((&u, &w), (&du, &dw)),
            );
            let [a, b] = &self.natural_curvature;
            std::array::from_fn(|i| now[i] - 0.5 * (a[i] + b[i]) + p.damping_time * speed[i])
        } else {
            [0.0; C]
        };
        let moment = if C == 1 {
            bending[0]
        } else {
            dot(&bending, &bending).sqrt()
        };
        (p.axial_stiffness * stretching, p.bending_stiffness * moment)
    }
}
