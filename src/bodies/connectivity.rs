//! Linear constraints between nodes, the rows of `Phi`, and how they are eliminated locally.
//!
//! Nodes that rows tie together form a cluster. Inside a cluster one rank-revealing QR of the rows,
//! `Phi^T = Q1 R`, gives the free coordinates `y` of its nodes: `x = N y + Q1 R^-T c` with `N` the
//! rest of `Q`, so that `Phi x = c` whatever `y` is. All other nodes are free as they are. That
//! neighbouring elements share a node is the connectivity of the report's Eqs. 17-18; its QR is known
//! beforehand and never computed.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eqs. 13-20 and 24-28.

use nalgebra::DMatrix;

use crate::math::householder::{reflect, reflector};
use crate::math::jet::Number;
use crate::math::space::{Vector, frame_acceleration, is_isotropic_below, moment};
use crate::math::vector::{dot, norm};

/// Coordinates of a node in `D` dimensions: position, then direction (the slope of a cable, the unit vector of a
/// rigid body). Also rates of them, or forces on them.
pub type Node<const D: usize = 2, N = f64> = [[N; D]; 2];

/// A nodal vector that is zero.
pub const fn no_node<const D: usize>() -> Node<D> {
    [[0.0; D]; 2]
}

/// Inner product of nodal vectors.
pub fn product<const D: usize>(a: &Node<D>, b: &Node<D>) -> f64 {
    dot(a.as_flattened(), b.as_flattened())
}

/// Adds a multiple of a nodal vector to another.
pub fn add_node<const D: usize>(to: &mut Node<D>, factor: f64, node: &Node<D>) {
    let node = node.as_flattened().iter();
    for (to, node) in to.as_flattened_mut().iter_mut().zip(node) {
        *to += factor * node;
    }
}

/// [`carried`] of both vectors of a node.
pub fn node_frame_acceleration<const D: usize, N: Number>(
    rate: [f64; 3],
    x: &Node<D, N>,
    v: &Node<D, N>,
) -> Node<D, N> {
    [0, 1].map(|part| frame_acceleration(rate, x[part].into(), v[part].into()).into())
}

/// A nodal vector of numbers made one by one.
pub fn map_node<const D: usize, A: Copy, B>(node: &Node<D, A>, of: impl Fn(A) -> B) -> Node<D, B> {
    node.map(|vector| vector.map(&of))
}

/// Largest rotation of any direction, rad, and change of any stretch between two configurations, in pairs.
pub(super) fn largest_rotation<'a, const D: usize>(
    directions: impl Iterator<Item = (&'a [f64; D], &'a [f64; D])>,
) -> f64 {
    // Squares of the largest tangent of a rotation, of the least and of the largest stretch; rotations beyond a right angle.
    let (mut tangent, mut least, mut most, mut beyond) = (0.0_f64, 1.0_f64, 1.0_f64, 0.0_f64);
    for (a, b) in directions {
        let [a, b] = [a, b].map(|direction| Vector::from(*direction));
        let (along, across) = (a.dot(&b), Vector::from(moment(&a, &b)).norm_squared());
        if along > 0.0 {
            tangent = tangent.max(across / (along * along));
        } else {
            beyond = beyond.max(across.sqrt().atan2(along));
        }
        let stretch = b.norm_squared() / a.norm_squared();
        (least, most) = (least.min(stretch), most.max(stretch));
    }
    let stretch = 0.5 * most.ln().max(-least.ln());
    tangent.sqrt().atan().max(beyond).max(stretch)
}

/// Part of a row, relative to its size, below which it depends on the rows before.
pub const RANK_TOLERANCE: f64 = 1e-10;

/// A linear constraint `sum over terms of coefficients . x = c`.
#[derive(Clone, Debug, PartialEq)]
pub struct ConnectivityRow<const D: usize = 2> {
    /// Nodes and their coefficients.
    pub terms: Vec<(usize, Node<D>)>,
    /// Whether `c` changes in time.
    pub is_driven: bool,
}

/// A row that can be had from rows before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Dependent {
    /// Index of the row.
    pub row: usize,
    /// Whether it or a row that it depends on is driven: then both can only hold by chance.
    pub is_driven: bool,
}

/// Nodes tied together, and the QR of what ties them.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// Indices of the nodes.
    pub nodes: Vec<usize>,
    /// Orthonormal basis of their free motion: one row per coordinate, one column per free one.
    pub basis: DMatrix<f64>,
    /// Independent rows.
    pub rows: Vec<usize>,
    /// `R^-1 Q1^T`: multipliers of the rows from the forces that they supply; its transpose gives the
    /// coordinates that follow `c`.
    pub multipliers: DMatrix<f64>,
}

impl Cluster {
    /// Whether each of its free vectors moves the vectors of its nodes by numbers times the identity of space.
    pub fn is_isotropic<const D: usize>(&self) -> bool {
        let basis = &self.basis;
        is_isotropic_below::<D>(basis.shape(), |_| basis.ncols(), |r, c| basis[(r, c)])
    }
}

/// With how many nodes each is tied together, itself among them.
pub fn tied_with<const D: usize>(nodes: usize, rows: &[&ConnectivityRow<D>]) -> Vec<usize> {
    let mut groups = Groups::of_rows(nodes, rows.iter().copied());
    let mut sizes = vec![0; nodes];
    (0..nodes).for_each(|node| sizes[groups.find(node)] += 1);
    (0..nodes).map(|node| sizes[groups.find(node)]).collect()
}

/// Ties nodes together.
///
/// Returns the clusters, and rows that depend on others.
pub fn clusters<const D: usize>(
    nodes: usize,
    rows: &[ConnectivityRow<D>],
) -> (Vec<Cluster>, Vec<Dependent>) {
    let mut groups = Groups::of_rows(nodes, rows.iter());
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); nodes];
    let mut tied = vec![false; nodes];
    for (node, _) in rows.iter().flat_map(|row| &row.terms) {
        tied[*node] = true;
    }
    for node in (0..nodes).filter(|node| tied[*node]) {
        members[groups.find(node)].push(node);
    }
    let mut of_group: Vec<Vec<usize>> = vec![Vec::new(); nodes];
    for (index, row) in rows.iter().enumerate() {
        if let Some((node, _)) = row.terms.first() {
            of_group[groups.find(*node)].push(index);
        }
    }
    let mut dependent = Vec::new();
    let clusters = members
        .into_iter()
        .zip(of_group)
        .filter(|(members, _)| !members.is_empty())
        .map(|(members, own)| factor(members, &own, rows, &mut dependent))
        .collect();
    (clusters, dependent)
}

fn factor<const D: usize>(
    nodes: Vec<usize>,
    own: &[usize],
    rows: &[ConnectivityRow<D>],
    dependent: &mut Vec<Dependent>,
) -> Cluster {
    let size = nodes.len() * 2 * D;
    let place = |node: usize| {
        let member = nodes.binary_search(&node);
        member.expect("a row ties the nodes of one cluster") * 2 * D
    };
    let mut reflectors: Vec<(Vec<f64>, f64)> = Vec::new();
    // Columns of R.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut independent: Vec<usize> = Vec::new();
    // Coordinate at every place. The pivot of a row is its largest coefficient, so that coordinates it
    // does not hold stay as they are: positions and slopes of a short element differ in scale.
    let mut order: Vec<usize> = (0..size).collect();
    for index in own {
        let mut plain = vec![0.0; size];
        for (node, coefficients) in &rows[*index].terms {
            let at = place(*node);
            for (value, coefficient) in plain[at..].iter_mut().zip(coefficients.as_flattened()) {
                *value += coefficient;
            }
        }
        let mut column: Vec<f64> = order.iter().map(|at| plain[*at]).collect();
        let scale = norm(&column);
        for (i, (vector, tau)) in reflectors.iter().enumerate() {
            reflect(vector, *tau, &mut column[i..]);
        }
        let rank = reflectors.len();
        if rank == size || norm(&column[rank..]) <= RANK_TOLERANCE * scale {
            let used = combination(&columns, &column);
            let driven = |(i, factor): (usize, &f64)| {
                factor.abs() > RANK_TOLERANCE && rows[independent[i]].is_driven
            };
            dependent.push(Dependent {
                row: *index,
                is_driven: rows[*index].is_driven || used.iter().enumerate().any(driven),
            });
            continue;
        }
        let largest = (rank..size).max_by(|a, b| column[*a].abs().total_cmp(&column[*b].abs()));
        let pivot = largest.expect("a coordinate that no row before takes");
        order.swap(rank, pivot);
        column.swap(rank, pivot);
        for (i, (vector, _)) in reflectors.iter_mut().enumerate() {
            vector.swap(rank - i, pivot - i);
        }
        let (tau, diagonal) = reflector(&mut column[rank..]);
        let mut of_r = column[..rank].to_vec();
        of_r.push(diagonal);
        columns.push(of_r);
        reflectors.push((column[rank..].to_vec(), tau));
        independent.push(*index);
    }
    assemble(nodes, independent, &reflectors, &columns, &order)
}

/// Basis and multipliers from the reflections and the columns of `R`.
fn assemble(
    nodes: Vec<usize>,
    independent: Vec<usize>,
    reflectors: &[(Vec<f64>, f64)],
    columns: &[Vec<f64>],
    order: &[usize],
) -> Cluster {
    let size = order.len();
    let rank = independent.len();
    let mut q = DMatrix::<f64>::zeros(size, size);
    for k in 0..size {
        let mut column = vec![0.0; size];
        column[k] = 1.0;
        for (i, (vector, tau)) in reflectors.iter().enumerate().rev() {
            reflect(vector, *tau, &mut column[i..]);
        }
        for (value, at) in column.iter().zip(order) {
            // What roundoff alone left is zero, and need not be multiplied with.
            q[(*at, k)] = if value.abs() > f64::EPSILON {
                *value
            } else {
                0.0
            };
        }
    }
    let mut multipliers = q.columns(0, rank).transpose();
    for mut column in multipliers.column_iter_mut() {
        for i in (0..rank).rev() {
            let later: f64 = (i + 1..rank).map(|j| columns[j][i] * column[j]).sum();
            column[i] = (column[i] - later) / columns[i][i];
        }
    }
    Cluster {
        basis: q.columns(rank, size - rank).into_owned(),
        nodes,
        rows: independent,
        multipliers,
    }
}

/// Factors with which independent rows add up to a dependent one.
fn combination(columns: &[Vec<f64>], column: &[f64]) -> Vec<f64> {
    let rank = columns.len();
    let mut factors = column[..rank].to_vec();
    for i in (0..rank).rev() {
        for j in i + 1..rank {
            factors[i] -= columns[j][i] * factors[j];
        }
        factors[i] /= columns[i][i];
    }
    factors
}

/// Disjoint sets.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn of_rows<'a, const D: usize>(
        nodes: usize,
        rows: impl Iterator<Item = &'a ConnectivityRow<D>>,
    ) -> Self {
        let mut groups = Self::new(nodes);
        for pair in rows.flat_map(|row| row.terms.windows(2)) {
            groups.join(pair[0].0, pair[1].0);
        }
        groups
    }

    fn find(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}
