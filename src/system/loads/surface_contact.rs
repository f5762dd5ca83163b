//! Contact of a plate or shell with a fixed surface, per area of the unstressed surface, at its places of quadrature.
//!
//! Source: as for contact of a point.

use nalgebra::{Matrix3, Vector3};

use super::contact::{ContactLaw, Touch};
use super::{Add, ForceElement, Instant, LoadedSurface};
use crate::bodies::{Bodies, Node};
use crate::elements::shell::AREA_PLACES;
use crate::math::jet::Number;
use crate::math::space::{Vector, vector};

/// Contact of a plate or shell with a surface.
#[derive(Clone, Debug)]
pub struct SurfaceContact {
    /// Surface that it acts on.
    pub on: LoadedSurface,
    /// Surface that is touched and its force per area.
    pub law: ContactLaw<3>,
}

impl SurfaceContact {
    /// How the places of quadrature of an element touch; none where none does.
    fn touches<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> Option<[Option<Touch<3, N>>; AREA_PLACES]> {
        let patch = self.on.patch(at.bodies);
        let of = &patch.elements()[element];
        let (x, v) = (patch.element(element, at.x), patch.element(element, at.v));
        let (surface, mut found) = (self.law.surface.lift(), false);
        let touches = std::array::from_fn(|place| {
            let under = self.law.depth(&surface, &of.at_place(&x, place));
            let touch = under.map(|under| self.law.touch(under, of.at_place(&v, place)));
            found |= touch.is_some();
            touch
        });
        found.then_some(touches)
    }

    /// Sum over all places that touch, by their areas.
    fn sum<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut add: impl FnMut(&Touch<3, N>, N),
    ) {
        for (index, element) in self.on.patch(at.bodies).elements().iter().enumerate() {
            let Some(touches) = self.touches(at, index) else {
                continue;
            };
            for (touch, area) in touches.iter().zip(element.place_areas()) {
                if let Some(touch) = touch {
                    add(touch, N::of(*area));
                }
            }
        }
    }

    /// The whole force, N.
    pub(in crate::system) fn whole<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
    ) -> Vector<D, N> {
        let mut sum = Vector3::zeros();
        self.sum(at, |touch, area| sum += self.law.force(touch) * area);
        vector(sum.into())
    }
}

impl<const D: usize> ForceElement<D> for SurfaceContact {
    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        self.on.parts(bodies)
    }

    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        let Some(touches) = self.touches(at, part) else {
            return;
        };
        let load = touches.map(|touch| {
            let force = touch.map_or_else(Vector3::zeros, |touch| self.law.force(&touch));
            force.into()
        });
        let patch = self.on.patch(at.bodies);
        let force = patch.elements()[part].varying_area_force(&load);
        self.on.add(at.bodies, part, (&force, f));
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for element in 0..self.on.count(at.bodies) {
            self.add_part(at, element, f);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let patch = self.on.patch(at.bodies);
        for (index, element) in patch.elements().iter().enumerate() {
            let Some(touches) = self.touches(at, index) else {
                continue;
            };
            let [mut stiff, mut damped] = [[Matrix3::zeros(); AREA_PLACES]; 2];
            for (place, touch) in touches.iter().enumerate() {
                if let Some(touch) = touch {
                    [stiff[place], damped[place]] = self.law.tangents(&self.law.surface, touch);
                }
            }
            let stiff = element.area_matrix(&stiff);
            self.on
                .add_matrix(at.bodies, index, (&stiff, &mut *stiffness));
            if self.law.is_damped() {
                let damped = element.area_matrix(&damped);
                self.on
                    .add_matrix(at.bodies, index, (&damped, &mut *damping));
            }
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let mut lost = N::of(0.0);
        self.sum(at, |touch, area| lost += self.law.dissipation(touch) * area);
        [N::of(0.0), lost]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let mut stored = N::of(0.0);
        self.sum(at, |touch, area| stored += self.law.energy(touch) * area);
        stored
    }

    /// Friction is absent at rest.
    fn hold(&mut self, _at: Instant<'_, D>, _fraction: f64) {
        self.law.friction = 0.0;
    }

    fn is_conservative(&self) -> bool {
        self.law.friction == 0.0
    }

    fn has_contact(&self) -> bool {
        true
    }

    fn has_belt_friction(&self) -> bool {
        self.law.has_belt_friction()
    }

    fn is_damped(&self) -> bool {
        self.law.is_damped()
    }
}
