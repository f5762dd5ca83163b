//! Piecewise polynomials over a mesh, and the equations of Laplace's operator on them.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor, The Finite Element Method, 5th ed. (2000), volume 1, chapters 7 and 8.

use std::collections::BTreeMap;

use super::basis::{DEGREE, IN_EDGE, INSIDE, NODES, Nodal, Pairs, Reference, Shapes, nodes};
use super::mesh::{Mesh, Point, cross};
use crate::math::sparse::{Matrix, Pattern};

/// Continuous functions that are polynomials in each triangle. Their numbers stand in the order of elimination.
pub struct Space<'a> {
    /// Triangles.
    pub mesh: &'a Mesh,
    /// Matrices of the reference triangle.
    pub reference: &'a Reference,
    pattern: Pattern,
    /// Vertices of the graph of each triangle: corners, edges and inside.
    parts: Vec<[usize; 7]>,
    /// Numbers of the nodes of each triangle.
    nodes: Vec<[usize; NODES]>,
    /// Loop of the outline that each number is on.
    loops: Vec<Option<usize>>,
}

/// A triangle as the image of the reference.
pub struct Map {
    origin: Point,
    /// Edges from the first corner to the second and to the third.
    edges: [Point; 2],
    /// Twice the area.
    pub size: f64,
}

impl Map {
    /// The map of a triangle of a mesh.
    pub fn new(mesh: &Mesh, t: usize) -> Self {
        let [a, b, c] = mesh.triangles[t].corners.map(|p| mesh.points[p]);
        Self {
            origin: a,
            edges: [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]],
            size: cross([a, b], c),
        }
    }

    /// Image of a point of the reference.
    pub fn point(&self, [p, q]: [f64; 2]) -> Point {
        let [e, f] = self.edges;
        [0, 1].map(|k| self.origin[k] + p * e[k] + q * f[k])
    }

    /// The point of the reference whose image this is.
    pub fn back(&self, point: Point) -> [f64; 2] {
        let [e, f] = self.edges;
        let way = [0, 1].map(|k| point[k] - self.origin[k]);
        [way[0] * f[1] - way[1] * f[0], e[0] * way[1] - e[1] * way[0]].map(|of| of / self.size)
    }

    /// Gradient from the derivatives in the reference.
    pub fn gradient(&self, [p, q]: [f64; 2]) -> [f64; 2] {
        let [e, f] = self.edges;
        [p * f[1] - q * e[1], q * e[0] - p * f[0]].map(|of| of / self.size)
    }

    /// Integrals of products of gradients.
    pub fn stiffness(&self, reference: &Reference) -> Pairs {
        let [e, f] = self.edges;
        let dot = |a: Point, b: Point| (a[0] * b[0] + a[1] * b[1]) / self.size;
        let [first, both, second] = [dot(f, f), -dot(e, f), dot(e, e)];
        let [p, m, q] = &reference.stiffness;
        std::array::from_fn(|i| {
            std::array::from_fn(|j| first * p[i][j] + both * m[i][j] + second * q[i][j])
        })
    }

    /// Integrals of the products of a field, whose components are given at the nodes, and gradients.
    pub fn divergence(&self, reference: &Reference, [first, second]: [&Nodal; 2]) -> Nodal {
        let [e, f] = self.edges;
        let [p, q] = &reference.mixed;
        let mut found = [0.0; NODES];
        for i in 0..NODES {
            let along = [
                first[i] * f[1] - second[i] * f[0],
                second[i] * e[0] - first[i] * e[1],
            ];
            for j in 0..NODES {
                found[j] += along[0] * p[i][j] + along[1] * q[i][j];
            }
        }
        found
    }

    /// Integrals of the products of a function, given at the nodes, and all polynomials.
    pub fn load(&self, reference: &Reference, function: &Nodal) -> Nodal {
        std::array::from_fn(|i| self.size * dot(&reference.mass[i], function))
    }

    /// Positions of the nodes.
    pub fn nodes(&self) -> [Point; NODES] {
        let part = |of: usize| of as f64 / DEGREE as f64;
        nodes().map(|[_, p, q]| self.point([part(p), part(q)]))
    }
}

/// Sum of products.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<'a> Space<'a> {
    /// Numbers the nodes of a mesh.
    pub fn new(mesh: &'a Mesh, reference: &'a Reference) -> Self {
        let mut edges: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let points = mesh.points.len();
        let mut on: Vec<Option<usize>> = mesh.loops.clone();
        let mut parts = Vec::with_capacity(mesh.triangles.len());
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.corners;
            let mut of = [a, b, c, 0, 0, 0, 0];
            for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                let next = points + edges.len();
                let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                of[3 + k] = *edges.entry(ends).or_insert(next);
                if of[3 + k] == next {
                    on.push(mesh.loops[ends[0]].filter(|_| triangle.beyond[k].is_none()));
                }
            }
            parts.push(of);
        }
        let (edges, all) = (edges.len(), points + edges.len() + mesh.triangles.len());
        for (t, of) in parts.iter_mut().enumerate() {
            of[6] = points + edges + t;
        }
        on.resize(all, None);
        let mut sizes = vec![1; points];
        sizes.resize(points + edges, IN_EDGE);
        sizes.resize(all, INSIDE);
        let pairs = (0..7).flat_map(|j| (0..j).map(move |k| (j, k)));
        let pairs: Vec<_> = pairs.collect();
        let joined = parts
            .iter()
            .flat_map(|of| pairs.iter().map(|(j, k)| (of[*j], of[*k])));
        let pattern = Pattern::new(&sizes, &joined.collect::<Vec<_>>());
        let mut loops = vec![None; pattern.len()];
        for (v, of) in on.iter().enumerate() {
            pattern.range(v).for_each(|number| loops[number] = *of);
        }
        let nodes = parts.iter().zip(&mesh.triangles);
        let nodes = nodes.map(|(of, triangle)| {
            let number = |node: usize| match within(node, triangle.corners) {
                (part, place) => pattern.range(of[part]).start + place,
            };
            std::array::from_fn(number)
        });
        Self {
            mesh,
            reference,
            nodes: nodes.collect(),
            pattern,
            parts,
            loops,
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.loops.len()
    }

    /// Loop of the outline that each number is on.
    pub fn loops(&self) -> &[Option<usize>] {
        &self.loops
    }

    /// Numbers of a function in a triangle.
    pub fn local(&self, t: usize, function: &[f64]) -> Nodal {
        self.nodes[t].map(|number| function[number])
    }

    /// Adds numbers of a triangle to those of the mesh.
    pub fn add(&self, t: usize, local: &Nodal, to: &mut [f64]) {
        for (number, value) in self.nodes[t].into_iter().zip(local) {
            to[number] += value;
        }
    }

    /// Factors the matrix of Laplace's operator, with the numbers that are held at zero in rows of their own.
    pub fn factor(&self, is_held: &dyn Fn(usize) -> bool) -> Option<Matrix<f64>> {
        let mut matrix = Matrix::zeros(&self.pattern);
        for t in 0..self.mesh.triangles.len() {
            let stiffness = Map::new(self.mesh, t).stiffness(self.reference);
            let corners = self.mesh.triangles[t].corners;
            let places: [(usize, usize); NODES] = std::array::from_fn(|i| within(i, corners));
            let parts = self.parts[t];
            let slots: [[_; 7]; 7] = std::array::from_fn(|a| {
                std::array::from_fn(|b| self.pattern.slot(parts[a], parts[b]))
            });
            for (i, (a, row)) in places.into_iter().enumerate() {
                for (j, (b, column)) in places.into_iter().enumerate() {
                    let is_free = !is_held(self.nodes[t][i]) && !is_held(self.nodes[t][j]);
                    // What is not on the diagonal is stored once.
                    if let Some(slot) = slots[a][b]
                        && (a == b || !slot.transposed)
                        && is_free
                    {
                        matrix.values[slot.entry(row, column)] += stiffness[i][j];
                    }
                }
            }
        }
        let vertices = 0..self.parts.last()?[6] + 1;
        for v in vertices {
            let slot = self.pattern.slot(v, v)?;
            for (k, number) in self.pattern.range(v).enumerate() {
                if is_held(number) {
                    matrix.values[slot.entry(k, k)] = 1.0;
                }
            }
        }
        (matrix.factor(&self.pattern)? == 0).then_some(matrix)
    }

    /// Solves with a factored matrix.
    pub fn solve(&self, matrix: &Matrix<f64>, mut right: Vec<f64>) -> Vec<f64> {
        matrix.solve(&self.pattern, &mut right);
        right
    }

    /// Product of the matrix of Laplace's operator and a function.
    pub fn stiffness_times(&self, function: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; function.len()];
        for t in 0..self.mesh.triangles.len() {
            let local = self.local(t, function);
            let stiffness = Map::new(self.mesh, t).stiffness(self.reference);
            self.add(t, &stiffness.map(|row| dot(&row, &local)), &mut product);
        }
        product
    }

    /// Gradient of a function, given by its numbers in a triangle.
    pub fn gradient(map: &Map, shapes: &Shapes, local: &Nodal) -> [f64; 2] {
        map.gradient([0, 1].map(|k| dot(&shapes.slopes[k], local)))
    }
}

/// Part of a triangle that a node is on (corners, edges, inside), and its place there: along edges from the lower number.
fn within(node: usize, corners: [usize; 3]) -> (usize, usize) {
    if node < 3 {
        return (node, 0);
    }
    let (edge, place) = ((node - 3) / IN_EDGE, (node - 3) % IN_EDGE);
    if edge >= 3 {
        return (6, node - 3 - 3 * IN_EDGE);
    }
    let is_forward = corners[edge] < corners[(edge + 1) % 3];
    let place = if is_forward {
        place
    } else {
        IN_EDGE - 1 - place
    };
    (3 + edge, place)
}
