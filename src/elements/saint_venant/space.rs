//! Piecewise polynomials over a mesh, and the equations of Laplace's operator on them.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor, The Finite Element Method, 5th ed. (2000), volume 1, chapters 7 and 8.

use std::collections::BTreeMap;

use super::basis::{DEGREE, IN_EDGE, INSIDE, NODES, Nodal, Pairs, Reference, Shapes, lattice};
use super::mesh::{Mesh, Point, cross};
use crate::math::sparse::{Matrix, Pattern};

/// Continuous functions that are polynomials in each triangle. Their numbers stand in the order of elimination.
pub struct Space<'a> {
    /// Triangles.
    pub mesh: &'a Mesh,
    /// Matrices of the reference triangle.
    pub reference: &'a Reference,
    pattern: Pattern,
    /// Vertices of the graph of each triangle: its corners, with the edges that these own, and its inside.
    parts: Vec<[usize; 4]>,
    /// Part of each triangle that each node is of, and its place among the numbers of the vertex there.
    places: Vec<[(usize, usize); NODES]>,
    /// Numbers of the nodes of each triangle.
    numbers: Vec<[usize; NODES]>,
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
    pub fn lattice(&self) -> [Point; NODES] {
        let part = |of: usize| of as f64 / DEGREE as f64;
        lattice().map(|[_, p, q]| self.point([part(p), part(q)]))
    }
}

/// Sum of products.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<'a> Space<'a> {
    /// Numbers the nodes of a mesh. Edges are with one of their ends, so that the graph is that of the points: it is small.
    pub fn new(mesh: &'a Mesh, reference: &'a Reference) -> Self {
        let points = mesh.points.len();
        let mut owners: BTreeMap<[usize; 2], (usize, usize)> = BTreeMap::new();
        let mut sizes = vec![1; points];
        let mut places = Vec::with_capacity(mesh.triangles.len());
        for triangle in &mesh.triangles {
            let corners = triangle.corners;
            let mut of = [(0, 0); NODES];
            for k in 0..3 {
                let [from, to] = [corners[k], corners[(k + 1) % 3]];
                let ends = [from.min(to), from.max(to)];
                let (owner, first) = *owners.entry(ends).or_insert_with(|| {
                    let owner = if sizes[from] <= sizes[to] { from } else { to };
                    sizes[owner] += IN_EDGE;
                    (owner, sizes[owner] - IN_EDGE)
                });
                let part = if owner == from { k } else { (k + 1) % 3 };
                of[k] = (k, 0);
                for step in 0..IN_EDGE {
                    let along = if from < to { step } else { IN_EDGE - 1 - step };
                    of[3 + k * IN_EDGE + step] = (part, first + along);
                }
            }
            for inside in 0..INSIDE {
                of[NODES - INSIDE + inside] = (3, inside);
            }
            places.push(of);
        }
        sizes.resize(points + mesh.triangles.len(), INSIDE);
        let numbered = mesh.triangles.iter().enumerate();
        let parts = numbered.map(|(t, of)| {
            let [a, b, c] = of.corners;
            [a, b, c, points + t]
        });
        let parts: Vec<[usize; 4]> = parts.collect();
        let pairs = [(1, 0), (2, 0), (2, 1), (3, 0), (3, 1), (3, 2)];
        let joined = (parts.iter()).flat_map(|of| pairs.map(|(j, k)| (of[j], of[k])));
        let pattern = Pattern::new(&sizes, &joined.collect::<Vec<_>>());
        let of_triangle = |(of, places): (&[usize; 4], &[(usize, usize); NODES])| {
            places.map(|(part, place)| pattern.range(of[part]).start + place)
        };
        let numbers: Vec<[usize; NODES]> = parts.iter().zip(&places).map(of_triangle).collect();
        let mut loops = vec![None; pattern.len()];
        for (triangle, numbers) in mesh.triangles.iter().zip(&numbers) {
            for k in 0..3 {
                let on = mesh.loops[triangle.corners[k]];
                loops[numbers[k]] = on;
                if triangle.beyond[k].is_none() {
                    let first = 3 + k * IN_EDGE;
                    (first..first + IN_EDGE).for_each(|place| loops[numbers[place]] = on);
                }
            }
        }
        Self {
            mesh,
            reference,
            numbers,
            pattern,
            parts,
            places,
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
        self.numbers[t].map(|number| function[number])
    }

    /// Adds numbers of a triangle to those of the mesh.
    pub fn add(&self, t: usize, local: &Nodal, to: &mut [f64]) {
        for (number, value) in self.numbers[t].into_iter().zip(local) {
            to[number] += value;
        }
    }

    /// Factors the matrix of Laplace's operator, with the numbers that are held at zero in rows of their own.
    pub fn factor(&self, is_held: &dyn Fn(usize) -> bool) -> Option<Matrix<f64>> {
        let mut matrix = Matrix::zeros(&self.pattern);
        for t in 0..self.mesh.triangles.len() {
            let stiffness = Map::new(self.mesh, t).stiffness(self.reference);
            let (places, parts) = (self.places[t], self.parts[t]);
            let slots: [[_; 4]; 4] = std::array::from_fn(|a| {
                std::array::from_fn(|b| self.pattern.slot(parts[a], parts[b]))
            });
            for (i, (a, row)) in places.into_iter().enumerate() {
                for (j, (b, column)) in places.into_iter().enumerate() {
                    let is_free = !is_held(self.numbers[t][i]) && !is_held(self.numbers[t][j]);
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
        let vertices = 0..self.parts.last()?[3] + 1;
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
