//! Coordinates: the way of the second end of a joint along a direction of the first, `s = d . (r2 - r1)`, the angle between both, counted
//! on over full turns, and the length between two points, `|r2 - r1|`. What drives, couples or springs them, and what is read of them, stands on
//! their values and first and second derivatives.

use nalgebra::SMatrix;

use super::direction::Direction;
use super::end::{Add, Angle, Attachment, between, bilinear, coupling};
use super::gradient::Gradient;
use crate::bodies::Node;
use crate::math::jet::Number;
use crate::math::space::{Vector, axis, cross, turned};

/// A coordinate of a joint, or a length.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there are few")]
pub enum Coordinate<const D: usize> {
    /// A way, m.
    Translation(Translation<D>),
    /// A length between two ends, m.
    Length([Attachment<D>; 2]),
    /// An angle, rad, and its index among those that the system counts.
    Angle(Angle<D>, usize),
}

/// The way from a point to another along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translation<const D: usize> {
    /// From here to there.
    pub ends: [Attachment<D>; 2],
    /// A unit vector of the first end's body, or fixed in space.
    pub direction: Direction<D>,
    /// In the plane of a body, sine and cosine of the angle from that to the way.
    pub turn: [f64; 2],
}

impl<const D: usize> Translation<D> {
    /// The unit vector, or its rate where `x` holds rates of bodies.
    fn along<N: Number>(&self, x: &[Node<D, N>], is_rate: bool) -> Vector<D, N> {
        let [sin, cos] = self.turn.map(N::of);
        match self.direction {
            Direction::Of(marker) => turned(marker.lift().direction(x), (sin, cos)),
            Direction::Fixed(_) if is_rate => Vector::zeros(),
            Direction::Fixed(along) => along.map(N::of),
        }
    }

    fn between<N: Number>(&self, x: &[Node<D, N>]) -> Vector<D, N> {
        let [a, b] = self.ends.map(|end| end.lift());
        b.position(x) - a.position(x)
    }

    /// The way, m.
    pub fn value<N: Number>(&self, x: &[Node<D, N>]) -> N {
        self.along(x, false).dot(&self.between(x))
    }

    /// Returns the derivatives with respect to positions and directions of the ends.
    pub fn gradient<N: Number>(&self, x: &[Node<D, N>]) -> Gradient<D, N> {
        let (none, along) = (Vector::zeros(), self.along(x, false));
        let [sin, cos] = self.turn.map(N::of);
        let first = match self.direction {
            Direction::Of(marker) => {
                let back = turned(self.between(x), (-sin, cos));
                (Attachment::Body(marker.lift()), [-along, back])
            }
            Direction::Fixed(_) => (self.ends[0].lift(), [-along, none]),
        };
        Gradient {
            ends: [first, (self.ends[1].lift(), [along, none])],
        }
    }

    /// Returns the second time derivative at zero nodal accelerations, m/s^2.
    pub fn bend<N: Number>(&self, v: &[Node<D, N>]) -> N {
        let [a, b] = self.ends.map(|end| end.lift().velocity(v));
        N::of(2.0) * self.along(v, true).dot(&(b - a))
    }

    /// Adds its second derivatives by coordinates, times a factor.
    pub fn add_hessian(&self, factor: f64, add: Add<'_, D>) {
        let Direction::Of(first) = &self.direction else {
            return;
        };
        let [sin, cos] = self.turn;
        let product = SMatrix::from_fn(|r, c| turned(axis::<D, f64>(r), (sin, cos))[c]) * factor;
        if let Attachment::Body(second) = &self.ends[1] {
            bilinear([(first, 1), (second, 0)], product, add);
        }
        bilinear([(first, 1), (first, 0)], -product, add);
    }
}

impl<const D: usize> Angle<D> {
    /// Returns the derivatives with respect to positions and directions of the ends.
    #[inline(always)]
    pub fn gradient<N: Number>(&self, x: &[Node<D, N>]) -> Gradient<D, N> {
        if let Some(turn) = self.about() {
            return turn.gradient(x);
        }
        let one = N::of(1.0);
        let [first, second] = self.ends.map(|end| end.lift());
        Gradient {
            ends: [(first, first.turn(-one, x)), (second, second.turn(one, x))],
        }
    }

    /// Returns the second time derivative at zero nodal accelerations, rad/s^2.
    pub fn bend<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        if let Some(turn) = self.about() {
            return turn.bend(x, v);
        }
        let [first, second] = self.ends.map(|end| {
            let end = end.lift();
            let (u, rate) = (end.direction(x), end.direction_rate(v));
            let square = u.norm_squared();
            N::of(-2.0) * u.dot(&rate) * cross(&u, &rate) / (square * square)
        });
        second - first
    }

    /// Adds its second derivatives by coordinates, times a factor; in space without what is zero where the joint has one axis.
    pub fn add_hessian(&self, factor: f64, x: &[Node<D>], add: Add<'_, D>) {
        let Some(turn) = self.about() else {
            let zero = SMatrix::zeros();
            let [first, second] = self.ends.map(|end| end.curl(x) * factor);
            return coupling(&self.ends, [[first, zero], [zero, -second]], 1, add);
        };
        let [p, q] = turn.products(x);
        let size = p.hypot(q);
        let first = turn.turned([q / size, p / size]);
        if let (Attachment::Body(first), Direction::Of(second)) = (&first, &turn.of) {
            let product = SMatrix::identity() * (factor / size);
            bilinear([(first, 1), (second, 1)], product, add);
        }
    }
}

/// Unit vector from the first end to the second, and the length, m. At length zero no direction is better than another, and none is taken.
pub(super) fn line<const D: usize, N: Number>(
    ends: &[Attachment<D>; 2],
    x: &[Node<D, N>],
) -> (Vector<D, N>, N) {
    let [a, b] = ends.map(|end| end.lift());
    let way = b.position(x) - a.position(x);
    let square = way.norm_squared();
    if square > N::of(0.0) {
        let length = square.sqrt();
        (way / length, length)
    } else {
        (Vector::zeros(), square)
    }
}

impl<const D: usize> Coordinate<D> {
    /// Returns the value, m or rad. An angle is the one nearest to its entry in `angles`.
    pub fn value<N: Number>(&self, x: &[Node<D, N>], angles: &[N]) -> N {
        match self {
            Self::Translation(way) => way.value(x),
            Self::Length(ends) => line(ends, x).1,
            Self::Angle(angle, counted) => angle.value(x, angles[*counted]),
        }
    }

    /// Returns the derivatives with respect to positions and directions of the ends. The second entry belongs to the
    /// second body.
    #[inline(always)]
    pub fn gradient<N: Number>(&self, x: &[Node<D, N>]) -> Gradient<D, N> {
        match self {
            Self::Translation(way) => way.gradient(x),
            Self::Length(ends) => {
                let (none, (along, _)) = (Vector::zeros(), line(ends, x));
                let [first, second] = ends.map(|end| end.lift());
                Gradient {
                    ends: [(first, [-along, none]), (second, [along, none])],
                }
            }
            Self::Angle(angle, _) => angle.gradient(x),
        }
    }

    /// Returns the time derivative, m/s or rad/s.
    #[inline(always)]
    pub fn rate<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        self.gradient(x).along(v)
    }

    /// Returns the second time derivative at zero nodal accelerations, m/s^2 or rad/s^2.
    pub fn bend<N: Number>(&self, x: &[Node<D, N>], v: &[Node<D, N>]) -> N {
        match self {
            Self::Translation(way) => way.bend(v),
            Self::Length(ends) => {
                let (along, length) = line(ends, x);
                let [a, b] = ends.map(|end| end.lift().velocity(v));
                let (velocity, rate) = (b - a, along.dot(&(b - a)));
                if length > N::of(0.0) {
                    (velocity.norm_squared() - rate * rate) / length
                } else {
                    N::of(0.0)
                }
            }
            Self::Angle(angle, _) => angle.bend(x, v),
        }
    }

    /// Adds its second derivatives by coordinates, times a factor.
    pub fn add_hessian(&self, factor: f64, x: &[Node<D>], add: Add<'_, D>) {
        match self {
            Self::Translation(way) => way.add_hessian(factor, add),
            Self::Length(ends) => {
                let (along, length) = line(ends, x);
                if length > 0.0 {
                    let across = SMatrix::identity() - along * along.transpose();
                    between(ends, across * (factor / length), 0, add);
                }
            }
            Self::Angle(angle, _) => angle.add_hessian(factor, x, add),
        }
    }

    /// Adds the square of its derivatives, times a factor: the stiffness of a spring at rest.
    pub fn add_square(&self, factor: f64, x: &[Node<D>], add: Add<'_, D>) {
        self.gradient(x).add_square(factor, add);
    }

    /// Calls with both ends and the forces there of a force on it, N or N m.
    #[inline(always)]
    pub fn act<N: Number>(
        &self,
        force: N,
        x: &[Node<D, N>],
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        for (end, on) in &self.gradient(x).scaled(force).ends {
            call(end, *on);
        }
    }

    /// Returns the two ends that the coordinate is measured between.
    pub fn ends(&self) -> [Attachment<D>; 2] {
        match self {
            Self::Translation(way) => way.ends,
            Self::Length(ends) => *ends,
            Self::Angle(angle, _) => angle.ends,
        }
    }

    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Angle(..))
    }

    /// Whether it is the length from a point of the ground.
    pub fn is_grounded_length(&self) -> bool {
        match self {
            Self::Length(ends) => ends.iter().any(|end| end.marker().is_none()),
            Self::Translation(_) | Self::Angle(..) => false,
        }
    }
}
