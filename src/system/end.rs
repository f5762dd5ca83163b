//! What joints and loads are fixed to: the ground or a body.

use nalgebra::{Matrix2, Vector2};

use crate::body::{Marker, Node, NodeBlock, Row, left};
use crate::math::jet::Number;

/// A point of the ground or of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End<N: Number = f64> {
    /// A fixed point, m. Its direction is the x axis.
    Ground(Vector2<N>),
    /// A marker.
    Body(Marker<N>),
}

impl<N: Number> End<N> {
    /// Position, m.
    pub fn position(&self, x: &[Node<4, N>]) -> Vector2<N> {
        match self {
            Self::Ground(point) => *point,
            Self::Body(marker) => marker.position(x),
        }
    }

    /// Velocity, m/s.
    pub fn velocity(&self, v: &[Node<4, N>]) -> Vector2<N> {
        match self {
            Self::Ground(_) => Vector2::zeros(),
            Self::Body(marker) => marker.position(v),
        }
    }

    /// Direction; its length is the stretch of a cable.
    pub fn direction(&self, x: &[Node<4, N>]) -> Vector2<N> {
        match self {
            Self::Ground(_) => Vector2::x(),
            Self::Body(marker) => marker.direction(x),
        }
    }

    /// Rate of the direction, 1/s.
    pub fn direction_rate(&self, v: &[Node<4, N>]) -> Vector2<N> {
        match self {
            Self::Ground(_) => Vector2::zeros(),
            Self::Body(marker) => marker.direction(v),
        }
    }

    /// Angular velocity of the direction, rad/s.
    pub fn spin(&self, x: &[Node<4, N>], v: &[Node<4, N>]) -> N {
        let u = self.direction(x);
        u.perp(&self.direction_rate(v)) / u.norm_squared()
    }

    /// Angular acceleration of the direction, rad/s^2, under nodal accelerations `a`.
    pub fn spin_rate(&self, x: &[Node<4, N>], v: &[Node<4, N>], a: &[Node<4, N>]) -> N {
        let (u, rate) = (self.direction(x), self.direction_rate(v));
        let second = u.perp(&self.direction_rate(a));
        (second - N::of(2.0) * u.dot(&rate) * self.spin(x, v)) / u.norm_squared()
    }

    /// The marker, if it is one.
    pub fn marker(&self) -> Option<&Marker<N>> {
        match self {
            Self::Ground(_) => None,
            Self::Body(marker) => Some(marker),
        }
    }

    /// Whether it is the ground or belongs to a rigid body: its direction keeps its length.
    pub fn is_rigid(&self) -> bool {
        self.marker().is_none_or(|m| m.element.is_none())
    }

    /// Adds forces on position and direction.
    pub fn add_force(&self, position: Vector2<N>, direction: Vector2<N>, f: &mut [Node<4, N>]) {
        if let Self::Body(marker) = self {
            marker.add_force(position, direction, f);
        }
    }

    /// Adds a moment, counter-clockwise: `M d(angle)` with `d(angle) = (u x du) / u.u`.
    pub fn add_moment(&self, moment: N, x: &[Node<4, N>], f: &mut [Node<4, N>]) {
        let u = self.direction(x);
        let on_direction = left(u) * (moment / u.norm_squared());
        self.add_force(Vector2::zeros(), on_direction, f);
    }
}

impl End {
    /// The same end in another kind of numbers.
    #[inline(always)]
    pub fn lift<N: Number>(&self) -> End<N> {
        match self {
            Self::Ground(point) => End::Ground(point.map(N::of)),
            Self::Body(marker) => End::Body(marker.lift()),
        }
    }

    /// Adds what forces on position and direction would do to a row.
    pub fn add_terms(&self, position: Vector2<f64>, direction: Vector2<f64>, row: &mut Row<4>) {
        if let Self::Body(marker) = self {
            marker.add_terms(position, direction, row);
        }
    }

    /// Nodes that it depends on.
    pub fn nodes(&self) -> impl Iterator<Item = usize> + use<> {
        let nodes = self.marker().map(|marker| marker.nodes);
        nodes.into_iter().flatten()
    }
}

/// Relative direction of two ends, counted on over full turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// From here to there.
    pub ends: [End; 2],
}

impl Angle {
    /// The angle that is nearest to `hint`, rad.
    pub fn value<N: Number>(&self, x: &[Node<4, N>], hint: N) -> N {
        let [a, b] = self.ends.map(|end| end.lift().direction(x));
        let (along, across) = (a.dot(&b), a.perp(&b));
        let (sin, cos) = hint.sin_cos();
        // A step turns nothing by half a turn.
        hint + (cos * across - sin * along).atan2(cos * along + sin * across)
    }

    /// Its rate, rad/s.
    pub fn rate<N: Number>(&self, x: &[Node<4, N>], v: &[Node<4, N>]) -> N {
        let [a, b] = self.ends.map(|end| end.lift().spin(x, v));
        b - a
    }
}

/// Adds a block times a factor to a matrix over nodes: row node, column node, block.
pub type Add<'a> = &'a mut dyn FnMut(usize, usize, &NodeBlock<4>);

/// Stiffness of a potential whose second derivative by the way between two ends is `k` times the
/// identity.
pub fn isotropic(ends: &[End; 2], k: f64, add: Add<'_>) {
    between(ends, Matrix2::identity() * k, 0, add);
}

/// Stiffness `k` between the positions (`part` 0) or directions (1) of two ends.
pub fn between(ends: &[End; 2], k: Matrix2<f64>, part: usize, add: Add<'_>) {
    coupling(ends, [[k, -k], [-k, k]], part, add);
}

/// Adds the symmetric matrix `k` over positions (`part` 0) or directions (1) of two ends.
pub fn coupling(ends: &[End; 2], k: [[Matrix2<f64>; 2]; 2], part: usize, add: Add<'_>) {
    let none = (usize::MAX, [Matrix2::zeros(); 2]);
    let mut terms = [none; 4];
    for (i, end) in ends.iter().enumerate() {
        if let End::Body(marker) = end {
            let jacobian = marker.jacobian(part);
            terms[2 * i] = jacobian[0];
            if !marker.is_nodal() {
                terms[2 * i + 1] = jacobian[1];
            }
        }
    }
    for (i, (a, of_a)) in terms.iter().enumerate() {
        for (j, (b, of_b)) in terms.iter().enumerate() {
            // Each pair of nodes once; a node that both ends share in full.
            if *a == usize::MAX || *b == usize::MAX || a > b || (a == b && i > j) {
                continue;
            }
            let mut block = product(of_a, of_b, &k[i / 2][j / 2]);
            if a == b && i != j {
                add_transposed(&mut block);
            }
            add(*a, *b, &block);
        }
    }
}

/// Adds the second derivatives of a product `p . k q` of positions (part 0) or directions (part 1) of two markers.
pub fn bilinear(parts: [(&Marker, usize); 2], k: Matrix2<f64>, add: Add<'_>) {
    let [of_first, of_second] = parts.map(|(marker, part)| marker.jacobian(part));
    for (a, of_a) in of_first {
        for (b, of_b) in of_second {
            let mut block = product(&of_a, &of_b, &k);
            if a == b {
                add_transposed(&mut block);
            }
            add(a, b, &block);
        }
    }
}

/// `p^T k q` of the derivatives of two vectors by position and direction of a node each.
fn product(p: &[Matrix2<f64>; 2], q: &[Matrix2<f64>; 2], k: &Matrix2<f64>) -> NodeBlock<4> {
    let mut block = [[0.0; 4]; 4];
    for (i, p) in p.iter().enumerate() {
        for (j, q) in q.iter().enumerate() {
            let part = p.transpose() * k * q;
            for r in 0..2 {
                for c in 0..2 {
                    block[2 * i + r][2 * j + c] = part[(r, c)];
                }
            }
        }
    }
    block
}

/// A pair of vectors on one node counts both ways.
fn add_transposed(block: &mut NodeBlock<4>) {
    let copy = *block;
    for r in 0..4 {
        for c in 0..4 {
            block[r][c] = copy[r][c] + copy[c][r];
        }
    }
}
