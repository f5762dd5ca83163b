//! What joints and loads are fixed to: the ground or a body.

use nalgebra::SMatrix;

use crate::bodies::{ConnectivityRow, Marker, Node, NodeBlock, block_of};
use crate::math::jet::Number;
use crate::math::space::{Vector, axis, cross, perpendicular, perpendicular_matrix};
use crate::system::direction::AxisRotation;

/// A point of the ground or of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attachment<const D: usize = 2, N: Number = f64> {
    /// A fixed point, m. Its direction is the x axis.
    Ground(Vector<D, N>),
    /// A marker.
    Body(Marker<N>),
}

impl<const D: usize, N: Number> Attachment<D, N> {
    /// Position, m.
    #[inline(always)]
    pub fn position(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Ground(point) => *point,
            Self::Body(marker) => marker.position(x),
        }
    }

    /// Velocity, m/s.
    #[inline(always)]
    pub fn velocity(&self, v: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Ground(_) => Vector::zeros(),
            Self::Body(marker) => marker.position(v),
        }
    }

    /// Direction; its length is the stretch of a cable.
    #[inline(always)]
    pub fn direction(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Ground(_) => axis(0),
            Self::Body(marker) => marker.direction(x),
        }
    }

    /// Rate of the direction, 1/s.
    #[inline(always)]
    pub fn direction_rate(&self, v: &[Node<D, N>]) -> Vector<D, N> {
        match self {
            Self::Ground(_) => Vector::zeros(),
            Self::Body(marker) => marker.direction(v),
        }
    }

    /// Angular velocity of the direction, rad/s.
    pub fn spin(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        let u = self.direction(x);
        cross(&u, &self.direction_rate(v)) / u.norm_squared()
    }

    /// Angular acceleration of the direction, rad/s^2, under nodal accelerations `a`.
    pub fn spin_rate(&self, x: &[Node<D, N>], v: &[Node<D, N>], a: &[Node<D, N>]) -> N {
        let (u, rate) = (self.direction(x), self.direction_rate(v));
        let second = cross(&u, &self.direction_rate(a));
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

    /// Whether its direction keeps its length and is linear in what is integrated: that of the ground or of a rigid body in the plane.
    pub fn has_linear_direction(&self) -> bool {
        self.is_rigid() && !self.is_framed()
    }

    /// Whether it belongs to a rigid body of space that rotates, or to a reduced body: its axes are no coordinates.
    pub fn is_framed(&self) -> bool {
        self.marker().is_some_and(Marker::is_framed)
    }

    /// Adds forces on position and direction.
    #[inline(always)]
    pub fn add_force(&self, position: Vector<D, N>, direction: Vector<D, N>, f: &mut [Node<D, N>]) {
        if let Self::Body(marker) = self {
            marker.add_force(position, direction, f);
        }
    }

    /// Forces on position and direction of a moment, counter-clockwise: `M d(angle)` with
    /// `d(angle) = (u x du) / u.u`.
    pub fn turn(&self, moment: N, x: &[Node<D, N>]) -> [Vector<D, N>; 2] {
        let u = self.direction(x);
        let on_direction = perpendicular(u) * (moment / u.norm_squared());
        [Vector::zeros(), on_direction]
    }
}

impl<const D: usize> Attachment<D> {
    /// Converts the end to constants of another number type.
    #[inline(always)]
    pub fn lift<N: Number>(&self) -> Attachment<D, N> {
        match self {
            Self::Ground(point) => Attachment::Ground(point.map(N::of)),
            Self::Body(marker) => Attachment::Body(marker.lift()),
        }
    }

    /// Adds what forces on position and direction would do to a row.
    pub fn add_terms(
        &self,
        position: Vector<D>,
        direction: Vector<D>,
        row: &mut ConnectivityRow<D>,
    ) {
        if let Self::Body(marker) = self {
            marker.add_terms(position, direction, row);
        }
    }

    /// Minus the second derivative of the angle of its direction.
    pub fn curl(&self, x: &[Node<D>]) -> SMatrix<f64, D, D> {
        let u = self.direction(x);
        let a = u.norm_squared();
        (perpendicular(u) * u.transpose() * (2.0 / a) - perpendicular_matrix()) / a
    }

    /// Nodes that it depends on.
    pub fn nodes(&self) -> impl Iterator<Item = usize> + use<D> {
        let nodes = self.marker().map(|marker| marker.nodes);
        nodes.into_iter().flatten()
    }
}

/// How far markers of rigid bodies are from their centres of mass at most, m.
pub fn reach<const D: usize>(ends: &[Attachment<D>; 2]) -> f64 {
    let arm = |end: &Attachment<D>| end.marker().map_or(0.0, |marker| marker.arm());
    ends.iter().map(arm).fold(0.0, f64::max)
}

/// Relative direction of two ends, counted on over full turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle<const D: usize = 2> {
    /// From here to there.
    pub ends: [Attachment<D>; 2],
    /// In space, about what.
    pub turn: Option<AxisRotation<D>>,
}

impl<const D: usize> Angle<D> {
    /// In space, about what; nothing in the plane, which is known when compiling.
    #[inline(always)]
    pub fn about(&self) -> Option<&AxisRotation<D>> {
        match D {
            2 => None,
            _ => self.turn.as_ref(),
        }
    }

    /// The angle that is nearest to `hint`, rad.
    pub fn value<N: Number>(&self, x: &[Node<D, N>], hint: N) -> N {
        let [along, across] = match self.about() {
            Some(turn) => turn.products(x),
            None => {
                let [a, b] = self.ends.map(|end| end.lift().direction(x));
                [a.dot(&b), cross(&a, &b)]
            }
        };
        let (sin, cos) = hint.sin_cos();
        // A step rotates nothing by half a turn.
        hint + (cos * across - sin * along).angle(cos * along + sin * across)
    }

    /// Returns the rate of the angle, rad/s.
    pub fn rate<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        if let Some(turn) = self.about() {
            return turn.rate(x, v);
        }
        let [a, b] = self.ends.map(|end| end.lift().spin(x, v));
        b - a
    }
}

/// Adds a block times a factor to a matrix over nodes: row node, column node, block.
pub type Add<'a, const D: usize> = &'a mut dyn FnMut(usize, usize, &NodeBlock<D>);

/// Stiffness of a potential whose second derivative by the way between two ends is `k` times the
/// identity.
pub fn isotropic<const D: usize>(ends: &[Attachment<D>; 2], k: f64, add: Add<'_, D>) {
    between(ends, SMatrix::identity() * k, 0, add);
}

/// Stiffness `k` between the positions (`part` 0) or directions (1) of two ends.
pub fn between<const D: usize>(
    ends: &[Attachment<D>; 2],
    k: SMatrix<f64, D, D>,
    part: usize,
    add: Add<'_, D>,
) {
    coupling(ends, [[k, -k], [-k, k]], part, add);
}

/// Adds the symmetric matrix `k` over positions (`part` 0) or directions (1) of two ends.
pub fn coupling<const D: usize>(
    ends: &[Attachment<D>; 2],
    k: [[SMatrix<f64, D, D>; 2]; 2],
    part: usize,
    add: Add<'_, D>,
) {
    let none = (usize::MAX, [SMatrix::zeros(); 2]);
    let mut terms = [none; 4];
    for (i, end) in ends.iter().enumerate() {
        if let Attachment::Body(marker) = end {
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
            let mut block = block_of(of_a, of_b, &k[i / 2][j / 2]);
            if a == b && i != j {
                add_transposed(&mut block);
            }
            add(*a, *b, &block);
        }
    }
}

/// Adds the second derivatives of a product `p . k q` of positions (part 0) or directions (part 1) of two markers.
pub fn bilinear<const D: usize>(
    parts: [(&Marker, usize); 2],
    k: SMatrix<f64, D, D>,
    add: Add<'_, D>,
) {
    let [of_first, of_second] = parts.map(|(marker, part)| marker.jacobian(part));
    for (a, of_a) in of_first {
        for (b, of_b) in of_second {
            let mut block = block_of(&of_a, &of_b, &k);
            if a == b {
                add_transposed(&mut block);
            }
            add(a, b, &block);
        }
    }
}

/// A pair of vectors on one node counts both ways.
fn add_transposed<const D: usize>(block: &mut NodeBlock<D>) {
    let copy = *block;
    for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        for r in 0..D {
            for c in 0..D {
                block[p][r][q][c] = copy[p][r][q][c] + copy[q][c][p][r];
            }
        }
    }
}
