//! A planar rod that stretches and bends, `U = 1/2 int EA (|r'| - 1)^2 + EI (theta')^2 ds0`, in any
//! shape functions.
//!
//! Source: J. Gerstmayr, H. Irschik, On the correct representation of bending and axial deformation in
//! the absolute nodal coordinate formulation with an elastic line approach, J. Sound Vib. 318 (2008).

use super::band::Band;
use super::basis::{Basis, Jet, MOST, points};
use super::rule::{Rule, legendre};

/// A vector in the plane.
pub type Vector = [f64; 2];

/// Stiffness and mass of the rod.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Axial stiffness EA, N.
    pub axial: f64,
    /// Bending stiffness EI, N m^2.
    pub bending: f64,
    /// Mass per reference length, kg/m.
    pub density: f64,
}

/// Where the integrands are sampled in each element.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// Axial strain.
    pub axial: Rule,
    /// Bending strain.
    pub bending: Rule,
    /// Extra mass of the Legendre polynomials of each degree in an element, relative to their own.
    pub extra: [f64; MOST],
}

/// A discretization.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Shape functions.
    pub basis: Basis,
    /// Ends of elements, m.
    pub breaks: Vec<f64>,
    /// Quadrature.
    pub rules: Rules,
}

/// A quadrature point: weight (m) and derivatives of the functions that are not zero there.
#[derive(Clone, Debug)]
struct Sample<const F: usize> {
    weight: f64,
    slope: [f64; F],
    curvature: [f64; F],
}

/// A rod whose elements have `F` functions each.
#[derive(Clone, Debug)]
pub struct Rod<const F: usize> {
    material: Material,
    mesh: Mesh,
    stride: usize,
    axial: Vec<Sample<F>>,
    bending: Vec<Sample<F>>,
    /// First sample of each element, and one past the last.
    axial_from: Vec<usize>,
    bending_from: Vec<usize>,
}

fn combine<const F: usize>(weights: &[f64; F], c: &[Vector; F]) -> Vector {
    let mut sum = [0.0; 2];
    for (weight, c) in weights.iter().zip(c) {
        sum[0] += weight * c[0];
        sum[1] += weight * c[1];
    }
    sum
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `u x w`.
fn cross(u: Vector, w: Vector) -> f64 {
    u[0] * w[1] - u[1] * w[0]
}

impl<const F: usize> Rod<F> {
    /// A rod on a mesh whose basis has `F` functions an element.
    pub fn new(material: Material, mesh: Mesh) -> Self {
        assert_eq!(mesh.basis.local(), F, "functions of an element");
        let (axial, axial_from) = samples(&mesh, mesh.rules.axial, 1);
        let (bending, bending_from) = samples(&mesh, mesh.rules.bending, 2);
        Self {
            stride: mesh.basis.stride(),
            material,
            mesh,
            axial,
            bending,
            axial_from,
            bending_from,
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.mesh.breaks.len() - 1
    }

    /// Number of shape functions; each has a vector of two coordinates.
    pub fn functions(&self) -> usize {
        self.mesh.basis.functions(self.elements())
    }

    /// The function whose coordinates are the position of the far end; that of the start is 0.
    pub fn end(&self) -> usize {
        match self.mesh.basis {
            Basis::Hermite(vectors) => self.functions() - vectors,
            Basis::Spline { .. } => self.functions() - 1,
        }
    }

    fn local<'a>(&self, element: usize, c: &'a [Vector]) -> &'a [Vector; F] {
        let first = element * self.stride;
        c[first..]
            .first_chunk()
            .expect("functions of every element")
    }

    /// Strain energy, J; what the tests hold forces against.
    #[cfg(test)]
    pub fn energy(&self, c: &[Vector]) -> f64 {
        let mut sum = 0.0;
        for element in 0..self.elements() {
            let local = self.local(element, c);
            for s in &self.axial[self.axial_from[element]..self.axial_from[element + 1]] {
                let u = combine(&s.slope, local);
                sum += s.weight * self.material.axial * (dot(u, u).sqrt() - 1.0).powi(2);
            }
            for s in &self.bending[self.bending_from[element]..self.bending_from[element + 1]] {
                let (u, w) = (combine(&s.slope, local), combine(&s.curvature, local));
                sum += s.weight * self.material.bending * (cross(u, w) / dot(u, u)).powi(2);
            }
        }
        0.5 * sum
    }

    /// Adds the elastic forces, N, to those on the coordinates.
    pub fn add_force(&self, c: &[Vector], f: &mut [Vector]) {
        let bends = self.material.bending > 0.0;
        for element in 0..self.elements() {
            let local = self.local(element, c);
            let mut sum = [[0.0; 2]; F];
            for s in &self.axial[self.axial_from[element]..self.axial_from[element + 1]] {
                let u = combine(&s.slope, local);
                let pull = s.weight * self.material.axial * (1.0 - 1.0 / dot(u, u).sqrt());
                let g = [pull * u[0], pull * u[1]];
                for (sum, slope) in sum.iter_mut().zip(&s.slope) {
                    sum[0] += slope * g[0];
                    sum[1] += slope * g[1];
                }
            }
            if bends {
                let from = self.bending_from[element];
                for s in &self.bending[from..self.bending_from[element + 1]] {
                    let (u, w) = (combine(&s.slope, local), combine(&s.curvature, local));
                    let inverse = 1.0 / dot(u, u);
                    let kappa = cross(u, w) * inverse;
                    let m = s.weight * self.material.bending * kappa * inverse;
                    let along = -2.0 * m * kappa;
                    let gu = [m * w[1] + along * u[0], along * u[1] - m * w[0]];
                    let gw = [-m * u[1], m * u[0]];
                    for j in 0..F {
                        sum[j][0] += s.slope[j] * gu[0] + s.curvature[j] * gw[0];
                        sum[j][1] += s.slope[j] * gu[1] + s.curvature[j] * gw[1];
                    }
                }
            }
            let first = element * self.stride;
            for (f, sum) in f[first..first + F].iter_mut().zip(&sum) {
                f[0] -= sum[0];
                f[1] -= sum[1];
            }
        }
    }

    /// Adds the tangent stiffness, the second derivatives of the energy, by coordinates
    /// `2 function + axis`.
    pub fn add_stiffness(&self, c: &[Vector], k: &mut Band) {
        let none = [0.0; F];
        for element in 0..self.elements() {
            let local = self.local(element, c);
            let mut sum = [[[[0.0; 2]; 2]; F]; F];
            for s in &self.axial[self.axial_from[element]..self.axial_from[element + 1]] {
                let u = combine(&s.slope, local);
                let stretch = dot(u, u).sqrt();
                let ea = s.weight * self.material.axial;
                let (own, outer) = (ea * (1.0 - 1.0 / stretch), ea / stretch.powi(3));
                let uu = symmetric(own, outer, u);
                let zero = [[0.0; 2]; 2];
                let hessian = SectionHessian {
                    uu,
                    uw: zero,
                    ww: zero,
                };
                gather(&mut sum, &s.slope, &none, &hessian);
            }
            if self.material.bending > 0.0 {
                let from = self.bending_from[element];
                for s in &self.bending[from..self.bending_from[element + 1]] {
                    let (u, w) = (combine(&s.slope, local), combine(&s.curvature, local));
                    let hessian = bending_hessian(s.weight * self.material.bending, u, w);
                    gather(&mut sum, &s.slope, &s.curvature, &hessian);
                }
            }
            let first = element * self.stride;
            for i in 0..F {
                for j in 0..=i {
                    for a in 0..2 {
                        for b in 0..2 {
                            let (row, column) = (2 * (first + i) + a, 2 * (first + j) + b);
                            if column <= row {
                                *k.at(row, column) += sum[i][j][a][b];
                            }
                        }
                    }
                }
            }
        }
    }

    /// Scalar mass matrix, kg.
    pub fn mass(&self) -> Band {
        self.gram(self.material.density, &self.mesh.rules.extra)
    }

    /// Integrals of products of the functions with a density; the parts of the functions in the
    /// Legendre polynomials of an element count more by `extra`.
    fn gram(&self, density: f64, extra: &[f64; MOST]) -> Band {
        let mut mass = Band::zeros(self.functions(), F - 1);
        let breaks = &self.mesh.breaks;
        for element in 0..self.elements() {
            // parts[k][j]: the part of function j in the Legendre polynomial of degree k.
            let mut parts = [[0.0; F]; F];
            for (at, weight) in points(&Rule::Gauss(F).points(), breaks, element) {
                let jets = self.mesh.basis.at(breaks, element, at);
                for (k, part) in parts.iter_mut().enumerate() {
                    let value = weight * legendre(k, 2.0 * at - 1.0).0;
                    (0..F).for_each(|j| part[j] += value * jets[j][0]);
                }
            }
            let (first, length) = (element * self.stride, breaks[element + 1] - breaks[element]);
            for (k, part) in parts.iter().enumerate() {
                let weight = (1.0 + extra[k]) * (2 * k + 1) as f64 / length;
                for i in 0..F {
                    for j in 0..=i {
                        *mass.at(first + i, first + j) += density * weight * part[i] * part[j];
                    }
                }
            }
        }
        mass
    }

    /// Integrals of the functions with a line load (vector by reference length): its forces.
    pub fn loads(&self, load: impl Fn(f64) -> Vector) -> Vec<Vector> {
        let mut f = vec![[0.0; 2]; self.functions()];
        for element in 0..self.elements() {
            let breaks = &self.mesh.breaks;
            for (at, weight) in points(&Rule::Gauss(F).points(), breaks, element) {
                let jets = self.mesh.basis.at(breaks, element, at);
                let value = load(breaks[element] + at * (breaks[element + 1] - breaks[element]));
                for j in 0..F {
                    for a in 0..2 {
                        f[element * self.stride + j][a] += weight * jets[j][0] * value[a];
                    }
                }
            }
        }
        f
    }

    /// Coordinates of the curve nearest to a given one, in the mean square.
    pub fn fit(&self, curve: impl Fn(f64) -> Vector) -> Vec<Vector> {
        let mut mass = self.gram(1.0, &[0.0; MOST]);
        mass.factor();
        let mut c = self.loads(curve);
        mass.solve::<2, F>(&mut c);
        c
    }

    /// Functions at `xi` of an element: index of the first, values and derivatives.
    pub fn jets(&self, element: usize, xi: f64) -> (usize, [Jet; F]) {
        let jets = self.mesh.basis.at(&self.mesh.breaks, element, xi);
        (element * self.stride, std::array::from_fn(|j| jets[j]))
    }

    /// Position (0), slope (1) or rate of slope (2) at `xi` of an element.
    pub fn vector(&self, c: &[Vector], element: usize, xi: f64, derivative: usize) -> Vector {
        let (_, jets) = self.jets(element, xi);
        combine(&jets.map(|jet| jet[derivative]), self.local(element, c))
    }
}

/// `own I + outer u u^T`.
fn symmetric(own: f64, outer: f64, u: Vector) -> [[f64; 2]; 2] {
    let mixed = outer * u[0] * u[1];
    [
        [own + outer * u[0] * u[0], mixed],
        [mixed, own + outer * u[1] * u[1]],
    ]
}

type Block = [[f64; 2]; 2];

/// Second derivatives by `u` and `w`.
struct SectionHessian {
    uu: Block,
    uw: Block,
    ww: Block,
}

/// Second derivatives of `1/2 material kappa^2` by `u` and `w`.
fn bending_hessian(material: f64, u: Vector, w: Vector) -> SectionHessian {
    let inverse = 1.0 / dot(u, u);
    let kappa = cross(u, w) * inverse;
    let m = material * kappa;
    let gu = [
        inverse * w[1] - 2.0 * kappa * inverse * u[0],
        -inverse * w[0] - 2.0 * kappa * inverse * u[1],
    ];
    let gw = [-inverse * u[1], inverse * u[0]];
    // d(cross)/du and d(cross)/dw
    let (cu, cw) = ([w[1], -w[0]], [-u[1], u[0]]);
    let (mut uu, mut uw, mut ww) = ([[0.0; 2]; 2], [[0.0; 2]; 2], [[0.0; 2]; 2]);
    let square = inverse * inverse;
    let turn = [[0.0, 1.0], [-1.0, 0.0]];
    for a in 0..2 {
        for b in 0..2 {
            let same = if a == b { 1.0 } else { 0.0 };
            let bend = -2.0 * square * (cu[a] * u[b] + u[a] * cu[b])
                + kappa * inverse * (8.0 * inverse * u[a] * u[b] - 2.0 * same);
            uu[a][b] = material * gu[a] * gu[b] + m * bend;
            uw[a][b] =
                material * gu[a] * gw[b] + m * (inverse * turn[a][b] - 2.0 * square * u[a] * cw[b]);
            ww[a][b] = material * gw[a] * gw[b];
        }
    }
    SectionHessian { uu, uw, ww }
}

fn gather<const F: usize>(
    sum: &mut [[Block; F]; F],
    s: &[f64; F],
    c: &[f64; F],
    SectionHessian { uu, uw, ww }: &SectionHessian,
) {
    for i in 0..F {
        for j in 0..=i {
            let (ss, sc, cs, cc) = (s[i] * s[j], s[i] * c[j], c[i] * s[j], c[i] * c[j]);
            for a in 0..2 {
                for b in 0..2 {
                    sum[i][j][a][b] +=
                        uu[a][b] * ss + uw[a][b] * sc + uw[b][a] * cs + ww[a][b] * cc;
                }
            }
        }
    }
}

/// Samples of all elements; one at the end of an element and one at the start of the next are one
/// where the derivatives up to `derivatives` are continuous.
fn samples<const F: usize>(
    mesh: &Mesh,
    rule: Rule,
    derivatives: usize,
) -> (Vec<Sample<F>>, Vec<usize>) {
    let (rule, breaks) = (rule.points(), &mesh.breaks);
    let shared = mesh.basis.continuity() >= derivatives;
    let mut samples: Vec<Sample<F>> = Vec::new();
    let mut from = vec![0];
    let length = |element: usize| breaks[element + 1] - breaks[element];
    for element in 0..breaks.len() - 1 {
        for (at, mut weight) in points(&rule, breaks, element) {
            if shared && at < 1e-12 && element > 0 {
                continue;
            }
            if shared && at > 1.0 - 1e-12 && element + 2 < breaks.len() {
                weight += rule[0].weight * length(element + 1);
            }
            let jets = mesh.basis.at(breaks, element, at);
            samples.push(Sample {
                weight,
                slope: std::array::from_fn(|j| jets[j][1]),
                curvature: std::array::from_fn(|j| jets[j][2]),
            });
        }
        from.push(samples.len());
    }
    (samples, from)
}
