//! Shapes that a body takes in its floating frame, and the integrals over them that never change.
//!
//! Source: A. A. Shabana, Dynamics of Multibody Systems (1989), chapter 5 (inertia shape integrals); foreshortening: T. R.
//! Kane, R. R. Ryan, A. K. Banerjee, Dynamics of a cantilever beam attached to a moving base, J. Guid. Control Dyn. 10
//! (1987) 139-151; component modes with interfaces held: R. R. Craig, M. C. C. Bampton, AIAA J. 6 (1968) 1313-1319.

use nalgebra::{DMatrix, SymmetricEigen};

use super::scenes::Rod;
use super::{Marker, Vector, shape_functions};
use crate::elements::rule::Rule;

/// How the ends of a rod are held in its floating frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// The start stands at the origin, the frame rotates as the motion without strain does
    Start,
    /// Both ends stay on the axis and may part: interfaces as Craig and Bampton have them
    BothEnds,
    /// The start stands at the origin and points along the axis
    Clamped,
    /// Nothing: mean axes
    Nothing,
}

/// Which modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modes {
    /// How the ends are held.
    pub held: Held,
    /// Bending modes.
    pub bending: usize,
    /// Axial modes.
    pub axial: usize,
    /// Whether a bent line is shorter along the axis.
    pub foreshortening: bool,
}

/// Shapes at a place: displacements along and across for every coordinate, slopes across, and the shortening matrix
/// `G(x)`, the integral of products of slopes up to the place.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Place on the axis, m.
    pub x: f64,
    /// Along the axis.
    pub u: Vec<f64>,
    /// Across it.
    pub w: Vec<f64>,
    /// Slope of what is across.
    pub slope: Vec<f64>,
    /// `G`, row by row.
    pub shortening: Vec<f64>,
}

/// A place of quadrature and the mass that it stands for, kg.
#[derive(Clone, Debug)]
pub struct Lump {
    /// Shapes there.
    pub shape: Shape,
    /// Mass.
    pub mass: f64,
}

/// The integrals.
#[derive(Clone, Debug)]
pub struct Basis {
    /// Number of shapes.
    pub count: usize,
    /// Whether lines are shortened.
    pub foreshortening: bool,
    /// Mass, kg.
    pub mass: f64,
    /// First moment of the undeformed body along the axis, kg m.
    pub moment: f64,
    /// Moment of inertia of the undeformed body, kg m^2.
    pub inertia: f64,
    /// First moments of shapes.
    pub first: Vec<Vector>,
    /// `int x u`, `int x w`.
    pub along: Vec<f64>,
    /// See `along`.
    pub across: Vec<f64>,
    /// `int u u^T + w w^T`, row by row.
    pub product: Vec<f64>,
    /// `int u w^T - w u^T`.
    pub cross: Vec<f64>,
    /// `int G`.
    pub shortening: Vec<f64>,
    /// `int u u^T + w w^T - x G`.
    pub centrifugal: Vec<f64>,
    /// Stiffness of every shape; they do not couple.
    pub stiffness: Vec<f64>,
    /// Shapes at the start, in the middle and at the end.
    pub markers: [Shape; 3],
}

impl Basis {
    /// From shapes at places of quadrature and at the markers.
    pub fn new(
        lumps: &[Lump],
        markers: [Shape; 3],
        stiffness: Vec<f64>,
        foreshortening: bool,
    ) -> Self {
        let n = stiffness.len();
        let sum =
            |f: &dyn Fn(&Shape) -> f64| lumps.iter().map(|l| l.mass * f(&l.shape)).sum::<f64>();
        let each = |f: &dyn Fn(&Shape, usize) -> f64| (0..n).map(|k| sum(&|s| f(s, k))).collect();
        let pairs = |f: &dyn Fn(&Shape, usize, usize) -> f64| -> Vec<f64> {
            (0..n * n).map(|i| sum(&|s| f(s, i / n, i % n))).collect()
        };
        let short = if foreshortening { 1.0 } else { 0.0 };
        let u: Vec<f64> = each(&|s, k| s.u[k]);
        let w: Vec<f64> = each(&|s, k| s.w[k]);
        Self {
            count: n,
            foreshortening,
            mass: sum(&|_| 1.0),
            moment: sum(&|s| s.x),
            inertia: sum(&|s| s.x * s.x),
            first: u.into_iter().zip(w).map(|(u, w)| [u, w]).collect(),
            along: each(&|s, k| s.x * s.u[k]),
            across: each(&|s, k| s.x * s.w[k]),
            product: pairs(&|s, k, l| s.u[k] * s.u[l] + s.w[k] * s.w[l]),
            cross: pairs(&|s, k, l| s.u[k] * s.w[l] - s.w[k] * s.u[l]),
            shortening: pairs(&|s, k, l| short * s.shortening[n * k + l]),
            centrifugal: pairs(&|s, k, l| {
                let shorter = short * s.x * s.shortening[n * k + l];
                s.u[k] * s.u[l] + s.w[k] * s.w[l] - shorter
            }),
            stiffness,
            markers,
        }
    }

    /// Modes of a uniform rod, from a fine mesh of cubic elements.
    pub fn modes(rod: &Rod, modes: Modes) -> Self {
        let mesh = Mesh::new(rod);
        let bending = mesh.modes(rod.bending, 2, modes.held, modes.bending);
        let axial = mesh.axial_modes(rod, modes.held, modes.axial);
        let all = bending.iter().chain(&axial);
        let stiffness = all.map(|mode| mode.square).collect();
        // Mean axes start in the middle, which shortening leaves where it is.
        let origin = match modes.held {
            Held::Nothing => 0.5 * rod.length,
            _ => 0.0,
        };
        let middle = mesh.shape(&bending, &axial, origin).shortening;
        let from_origin = |x: f64| {
            let mut shape = mesh.shape(&bending, &axial, x);
            shape.x -= origin;
            let entries = shape.shortening.iter_mut().zip(&middle);
            entries.for_each(|(entry, there)| *entry -= there);
            shape
        };
        let points = Rule::Gauss(QUADRATURE).points();
        let lumps = (0..MESH).flat_map(|j| points.iter().map(move |p| (j as f64 + p.at, p.weight)));
        let lumps = lumps.map(|(place, weight)| Lump {
            shape: from_origin(place * mesh.length),
            mass: rod.density * mesh.length * weight,
        });
        let lumps: Vec<Lump> = lumps.collect();
        let markers = [0.0, 0.5, 1.0].map(|part| from_origin(part * rod.length));
        Self::new(&lumps, markers, stiffness, modes.foreshortening)
    }

    /// Shapes at a marker.
    pub fn marker(&self, marker: Marker) -> &Shape {
        &self.markers[marker as usize]
    }
}

/// Elements of the mesh that modes come from; even.
const MESH: usize = 24;
/// Gauss points of its elements: products of two cubics and `x` are exact.
const QUADRATURE: usize = 4;

/// A mode: values and slopes of the nodes, its stiffness (of natural ones the frequency squared).
struct Mode {
    nodes: Vec<f64>,
    square: f64,
}

/// A line of cubic Hermite elements.
struct Mesh {
    length: f64,
    density: f64,
}

impl Mesh {
    fn new(rod: &Rod) -> Self {
        Self {
            length: rod.length / MESH as f64,
            density: rod.density,
        }
    }

    /// Shape functions of an element at a place in it, differentiated so many times.
    fn shapes(&self, at: f64, times: usize) -> [f64; 4] {
        shape_functions(at, self.length, times)
    }

    /// Axial modes. Where both ends are interfaces, forces along the axis act there: the stretch between them comes first,
    /// then modes with both ends held, which share no stiffness with it.
    fn axial_modes(&self, rod: &Rod, held: Held, count: usize) -> Vec<Mode> {
        if held != Held::BothEnds || count == 0 {
            return self.modes(rod.axial, 1, held, count);
        }
        let node = |i: usize| [i as f64 / MESH as f64, 1.0 / rod.length];
        let stretch = Mode {
            nodes: (0..=MESH).flat_map(node).collect(),
            square: rod.axial / rod.length,
        };
        let inside = self.modes(rod.axial, 1, held, count - 1);
        [stretch].into_iter().chain(inside).collect()
    }

    /// Modes at a place, bending first; shortening from the start of the line.
    fn shape(&self, bending: &[Mode], axial: &[Mode], x: f64) -> Shape {
        let across = |times: usize, x: f64| {
            let values = bending.iter().map(|mode| self.value(&mode.nodes, x, times));
            let values = values.chain(axial.iter().map(|_| 0.0));
            values.collect::<Vec<f64>>()
        };
        let along = axial.iter().map(|mode| self.value(&mode.nodes, x, 0));
        let n = bending.len() + axial.len();
        let mut shortening = vec![0.0; n * n];
        let whole = ((x / self.length) as usize).min(MESH - 1);
        for j in 0..=whole {
            let end = (x / self.length - j as f64).min(1.0);
            for point in Rule::Gauss(QUADRATURE).points() {
                let slopes = across(1, self.length * (j as f64 + end * point.at));
                let weight = point.weight * end * self.length;
                for (i, entry) in shortening.iter_mut().enumerate() {
                    *entry += weight * slopes[i / n] * slopes[i % n];
                }
            }
        }
        Shape {
            x,
            u: bending.iter().map(|_| 0.0).chain(along).collect(),
            w: across(0, x),
            slope: across(1, x),
            shortening,
        }
    }

    fn value(&self, nodes: &[f64], x: f64, times: usize) -> f64 {
        let j = ((x / self.length) as usize).min(MESH - 1);
        let shapes = self.shapes(x / self.length - j as f64, times);
        (0..4).map(|k| shapes[k] * nodes[2 * j + k]).sum()
    }

    /// Lowest natural modes with strain (`times` derivatives) and unit mass.
    fn modes(&self, stiffness: f64, times: usize, held: Held, count: usize) -> Vec<Mode> {
        let n = 2 * (MESH + 1);
        let (mut k, mut m) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        for j in 0..MESH {
            for point in Rule::Gauss(QUADRATURE).points() {
                let (value, strain) = (self.shapes(point.at, 0), self.shapes(point.at, times));
                let weight = point.weight * self.length;
                for (r, c) in (0..16).map(|i| (i / 4, i % 4)) {
                    m[(2 * j + r, 2 * j + c)] += self.density * weight * value[r] * value[c];
                    k[(2 * j + r, 2 * j + c)] += stiffness * weight * strain[r] * strain[c];
                }
            }
        }
        let bends = times == 2;
        let is_held = |i: usize| match held {
            Held::Nothing => false,
            Held::Start => i == 0,
            Held::BothEnds => i == 0 || i == n - 2,
            Held::Clamped => i == 0 || bends && i == 1,
        };
        let free: Vec<usize> = (0..n).filter(|i| !is_held(*i)).collect();
        let (k, m) = (
            k.select_rows(&free).select_columns(&free),
            m.select_rows(&free).select_columns(&free),
        );
        let rigid = match (held, bends) {
            (Held::Nothing, true) => 2,
            (Held::Nothing, false) | (Held::Start, true) => 1,
            _ => 0,
        };
        lowest(k, m, rigid, count)
            .into_iter()
            .map(|(square, shape)| {
                let mut nodes = vec![0.0; n];
                free.iter()
                    .zip(shape)
                    .for_each(|(i, value)| nodes[*i] = value);
                Mode { nodes, square }
            })
            .collect()
    }
}

/// Eigenpairs of `K z = square M z` with `z^T M z = 1`, the lowest ones after so many that are skipped.
fn lowest(k: DMatrix<f64>, m: DMatrix<f64>, skip: usize, count: usize) -> Vec<(f64, Vec<f64>)> {
    let Some(factor) = m.cholesky() else {
        return Vec::new();
    };
    let lower = factor.l();
    let solved = |mut matrix: DMatrix<f64>| {
        lower.solve_lower_triangular_mut(&mut matrix);
        matrix
    };
    let inside = solved(solved(k).transpose());
    let symmetric = (&inside + inside.transpose()) * 0.5;
    let eigen = SymmetricEigen::new(symmetric);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let pick = order.into_iter().skip(skip).take(count);
    let shape = |i: usize| {
        let mut z = eigen.eigenvectors.column(i).into_owned();
        lower.tr_solve_lower_triangular_mut(&mut z);
        z.as_slice().to_vec()
    };
    pick.map(|i| (eigen.eigenvalues[i], shape(i))).collect()
}
