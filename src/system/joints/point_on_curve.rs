//! Slider along a flexible body: the end is on the curve of a cable, `(p - r(s)) . n(s) = 0` with `s` the
//! foot of `p` on the curve, for every normal `n`. It transmits a force across the curve only.

use super::{ConstraintKind, Equation, Gradient, Rows, View};
use crate::bodies::{Bodies, LineChain, Marker, Node};
use crate::math::jet::Number;
use crate::math::space::{Vector, normal};
use crate::system::end::Attachment;

/// Iterations for the foot of a point on a curve.
const ITERATIONS: usize = 20;

/// A point on a chain.
#[derive(Clone, Debug)]
pub struct PointOnCurve<const D: usize> {
    /// The chain.
    pub chain: usize,
    /// End that slides along the curve.
    pub end: Attachment<D>,
    /// Number of the slide: where it is, is part of the state.
    pub slide: usize,
    /// Which of the normals of the curve it is held along.
    pub normal: usize,
}

/// Holds the second end on a chain, across every normal of it.
pub(super) fn hold<const D: usize>(
    rows: &Rows<'_, D>,
    chain: usize,
    slide: usize,
) -> impl Iterator<Item = ConstraintKind<D>> {
    let end = rows.ends[1];
    (0..D - 1).map(move |normal| {
        ConstraintKind::PointOnCurve(PointOnCurve {
            chain,
            end,
            slide,
            normal,
        })
    })
}

/// A place on a chain.
struct Foot<const D: usize, N: Number> {
    marker: Marker<N>,
    /// Second derivative of the curve by length.
    bend: Vector<D, N>,
}

fn foot<const D: usize, N: Number>(
    chain: &LineChain<D>,
    length: N,
    x: &[Node<D, N>],
) -> Foot<D, N> {
    let (part, xi) = chain.find(length.plain());
    let moved = length - N::of(length.plain());
    let xi = N::of(xi) + moved / N::of(chain.element_length(part));
    Foot {
        marker: Marker::within(0, chain, part, xi),
        bend: chain.bend(part, xi, x),
    }
}

impl<const D: usize> PointOnCurve<D> {
    /// Length along the chain of the point nearest to the end, m; searched from `hint` on.
    pub fn travel<N: Number>(&self, chain: &LineChain<D>, x: &[Node<D, N>], hint: N) -> N {
        let p = self.end.lift().position(x);
        let mut s = hint;
        for _ in 0..ITERATIONS {
            let at = foot(chain, s, x);
            let slope: Vector<D, N> = at.marker.direction(x);
            let away = p - at.marker.position(x);
            let square = slope.norm_squared();
            let stiffness = square - away.dot(&at.bend);
            // Far off the curve only the slope counts.
            let step = away.dot(&slope) / stiffness.max(square * N::of(0.5));
            s += step;
            if step.largest() <= 1e-15 * chain.length() {
                break;
            }
        }
        s
    }

    /// The nearest point of the whole chain, m: where a search begins.
    pub fn nearest(&self, chain: &LineChain<D>, x: &[Node<D>]) -> f64 {
        let near = chain.near(&self.end.position(x), x);
        self.travel(chain, x, near)
    }

    fn foot<N: Number>(&self, view: &View<'_, D, N>) -> (Foot<D, N>, Vector<D, N>, N) {
        let at = foot(
            &view.bodies.lines()[self.chain],
            view.travel[self.slide],
            view.x,
        );
        let slope = at.marker.direction(view.x);
        let stretch = slope.norm();
        (at, slope / stretch, stretch)
    }

    pub(super) fn gradient<N: Number>(&self, view: &View<'_, D, N>) -> Gradient<D, N> {
        let none = Vector::zeros();
        let (at, tangent, _) = self.foot(view);
        let normal = normal(&tangent, self.normal);
        Gradient {
            ends: [
                (Attachment::Body(at.marker), [-normal, none]),
                (self.end.lift(), [normal, none]),
            ],
        }
    }
}

impl<const D: usize> Equation<D> for PointOnCurve<D> {
    fn value<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let (at, tangent, _) = self.foot(view);
        let away = self.end.lift().position(view.x) - at.marker.position(view.x);
        normal(&tangent, self.normal).dot(&away)
    }

    /// With the point on the curve: `n . (p'' - r'' - 2 s' dr'/dt - s'^2 d^2r/ds^2)`.
    fn bias<N: Number>(&self, view: &View<'_, D, N>) -> N {
        let (at, tangent, stretch) = self.foot(view);
        let relative = self.end.lift().velocity(view.v) - at.marker.position(view.v);
        let speed = tangent.dot(&relative) / stretch;
        let slope_rate = at.marker.direction(view.v);
        -normal(&tangent, self.normal)
            .dot(&(slope_rate * (N::of(2.0) * speed) + at.bend * (speed * speed)))
    }

    /// The one that slides.
    fn ends(&self) -> Vec<Attachment<D>> {
        vec![self.end]
    }

    fn nodes(&self, bodies: &Bodies<D>) -> Vec<usize> {
        self.end
            .nodes()
            .chain(bodies.lines()[self.chain].range())
            .collect()
    }

    fn size(&self, bodies: &Bodies<D>) -> f64 {
        bodies.lines()[self.chain].length()
    }
}
