//! Slider along a flexible body: the end is on the curve of a cable, `(p - r(s)) . n(s) = 0` with `s` the
//! foot of `p` on the curve. It transmits a force across the curve only.

use nalgebra::Vector2;

use super::{Gradient, View};
use crate::body::{Marker, Node, left};
use crate::system::PlanarChain;
use crate::system::end::End;

/// Iterations for the foot of a point on a curve.
const ITERATIONS: usize = 20;

/// A point on a chain.
#[derive(Clone, Debug)]
pub struct Along {
    /// The chain.
    pub chain: usize,
    /// What slides along it.
    pub end: End,
    /// Number of the slide: where it is, is part of the state.
    pub slide: usize,
}

/// A place on a chain.
struct Foot {
    marker: Marker,
    /// Second derivative of the curve by length.
    bend: Vector2<f64>,
}

fn foot(chain: &PlanarChain, length: f64, x: &[Node<4>]) -> Foot {
    let (part, xi) = chain.find(length);
    Foot {
        marker: Marker::inside(0, chain, part, xi),
        bend: chain.bend(part, xi, x),
    }
}

impl Along {
    /// Length along the chain of the point nearest to the end, m; searched from `hint` on.
    pub fn travel(&self, chain: &PlanarChain, x: &[Node<4>], hint: f64) -> f64 {
        let p = self.end.position(x);
        let mut s = hint;
        for _ in 0..ITERATIONS {
            let at = foot(chain, s, x);
            let slope = at.marker.direction(x);
            let away = p - at.marker.position(x);
            let stiffness = slope.norm_squared() - away.dot(&at.bend);
            // Far off the curve only the slope counts.
            let step = away.dot(&slope) / stiffness.max(0.5 * slope.norm_squared());
            s += step;
            if step.abs() <= 1e-15 * chain.length() {
                break;
            }
        }
        s
    }

    /// The nearest point of the whole chain, m: where a search begins.
    pub fn nearest(&self, chain: &PlanarChain, x: &[Node<4>]) -> f64 {
        let near = chain.near(&self.end.position(x), x);
        self.travel(chain, x, near)
    }

    fn foot(&self, view: &View<'_>) -> (Foot, Vector2<f64>, f64) {
        let at = foot(&view.chains[self.chain], view.travel[self.slide], view.x);
        let slope = at.marker.direction(view.x);
        let stretch = slope.norm();
        (at, slope / stretch, stretch)
    }

    pub(super) fn value(&self, view: &View<'_>) -> f64 {
        let (at, tangent, _) = self.foot(view);
        let away = self.end.position(view.x) - at.marker.position(view.x);
        left(tangent).dot(&away)
    }

    pub(super) fn gradient(&self, view: &View<'_>) -> Gradient {
        let none = Vector2::zeros();
        let (at, tangent, _) = self.foot(view);
        let normal = left(tangent);
        Gradient {
            ends: [
                (End::Body(at.marker), [-normal, none]),
                (self.end, [normal, none]),
            ],
        }
    }

    /// With the point on the curve: `n . (p'' - r'' - 2 s' dr'/dt - s'^2 d^2r/ds^2)`.
    pub(super) fn bias(&self, view: &View<'_>) -> f64 {
        let (at, tangent, stretch) = self.foot(view);
        let relative = self.end.velocity(view.v) - at.marker.position(view.v);
        let speed = tangent.dot(&relative) / stretch;
        let slope_rate = at.marker.direction(view.v);
        -left(tangent).dot(&(slope_rate * (2.0 * speed) + at.bend * (speed * speed)))
    }
}
