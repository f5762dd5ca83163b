//! Contact of a marker, or of the line of a body, with a surface of the ground or of a rigid body. Where what is within the radius `R` of a
//! point is below the surface, the surface pushes along its normal `n` with the force `N` of a [`OneSidedSpring`] that is compressed by the
//! depth. Friction is `-mu N v / sqrt(v^2 + w^2)`, `v` the velocity along the surface, `w` the speed of slip: smooth, and none at rest.
//! Along a body all of this is per reference length and counts at the Gauss points of its segments.
//!
//! Velocities are those of the points of both bodies that are where they touch, `R` below the point along the normal. The surface takes the
//! opposite force there, so that both together have no force and no moment. A line takes friction on itself, without a moment.
//!
//! A marker may stick. One that sticks is held by a spring with a damper along the surface, from a place of the surface that the state
//! keeps. It slides where the force of the spring exceeds the largest friction, with `mu N` against the velocity whatever the speed, and
//! sticks where it stops. Both happen at events (`motion/sticking.rs`), so that steps are smooth; the force of friction goes on there.
//!
//! Source: as for the spring; P. Wriggers, Computational Contact Mechanics, 2nd ed. (2006), section 5.2 (Coulomb's law with a square
//! root in place of its corner); P. A. Cundall, O. D. L. Strack, A discrete numerical model for granular assemblies, Geotechnique 29 (1979)
//! 47-65 (tangential springs of contacts).

mod frame;
mod law;

pub use frame::RigidFrame;
use law::Hold;
pub use law::{ContactLaw, ContactSurface, Grip, StickMotion, TangentialSpring};

#[cfg(doc)]
use super::OneSidedSpring;
use super::{Add, ForceElement, Instant};
use crate::bodies::winch::{PaidOut, length_ratio};
use crate::bodies::{Bodies, Marker, Node};
use crate::elements::shape::Values;
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::system::end::{Attachment, between};
pub(super) use law::Touch;

/// Where contact counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// The point.
    pub marker: Marker,
    /// The reference length that it stands for, m; 1 of a single marker.
    pub weight: f64,
}

/// Contact with a surface.
#[derive(Clone, Debug)]
pub struct Contact<const D: usize = 2> {
    /// A single marker, or the Gauss points of all segments of a body in turn: of the elements of a chain, of the panels of a rod.
    pub places: Vec<ContactPoint>,
    /// Surface that is touched and its force; along a body per reference length.
    pub law: ContactLaw<D>,
    /// Rigid body that the surface belongs to, in whose frame it is given; none of the ground.
    pub surface_frame: Option<RigidFrame>,
    /// Rigid body that touches with a radius, and rolls.
    pub rolling: Option<RigidFrame>,
    /// Where a marker may stick: index of the first of the driven coordinates in which the state keeps a vector and the number of its
    /// [`Grip`]. The vector, in the frame of the surface, leads to where the marker sticks, or is the direction in which it slid last.
    pub kept: Option<usize>,
}

/// How a place touches.
struct PlaceTouch<const D: usize, N: Number> {
    touch: Touch<D, N>,
    /// Points where both touch: of the surface, and of the marker's body.
    ends: [Attachment<D, N>; 2],
}

/// What all places of a contact share at an instant.
struct Present<'a, const D: usize, N: Number> {
    at: Instant<'a, D, N>,
    /// Surface as it stands in the frame of the scene.
    surface: ContactSurface<D, N>,
    /// The body, if a winch pays it out.
    paid_out: Option<PaidOut<'a, D, N>>,
}

impl<const D: usize, N: Number> Present<'_, D, N> {
    /// Length now over the reference length.
    fn longer(&self) -> N {
        length_ratio(self.paid_out.as_ref())
    }
}

impl<const D: usize> Contact<D> {
    fn present<'a, N: Number>(&self, at: Instant<'a, D, N>) -> Present<'a, D, N> {
        let surface = &self.law.surface;
        let paid_out = self
            .is_distributed()
            .then(|| at.paid_out(self.first_node()));
        Present {
            at,
            surface: match &self.surface_frame {
                None => surface.lift(),
                Some(frame) => surface.map(
                    |point| frame.position(at.x, &point.map(N::of)),
                    |direction| frame.vector(at.x, &direction.map(N::of)),
                ),
            },
            paid_out: paid_out.flatten(),
        }
    }

    /// How a place touches; none above the surface.
    #[inline(always)]
    fn touch<N: Number>(&self, place: usize, now: &Present<'_, D, N>) -> Option<PlaceTouch<D, N>> {
        let marker = self.places[place].marker.lift();
        let position = marker.position(now.at.x);
        let under = self.law.depth(&now.surface, &position)?;
        Some(self.meet(place, under, now))
    }

    /// How a place meets the surface at a depth (m), with the unit vector out of the surface.
    #[inline(always)]
    fn meet<N: Number>(
        &self,
        place: usize,
        (depth, normal): (N, Vector<D, N>),
        now: &Present<'_, D, N>,
    ) -> PlaceTouch<D, N> {
        let at = now.at;
        let marker: Marker<N> = self.places[place].marker.lift();
        let position = marker.position(at.x);
        // A push along the normal alone has the same moment from the middle.
        let rubs = self.law.friction > 0.0;
        let arm = if rubs { self.law.radius } else { 0.0 };
        let point = position - normal * N::of(arm);
        let body = |frame: RigidFrame| Attachment::Body(frame.point(at.x, &point));
        let rolling = self.rolling.filter(|_| rubs);
        let ends = [
            self.surface_frame.map_or(Attachment::Ground(point), body),
            rolling.map_or(Attachment::Body(marker), body),
        ];
        let [surface, touching] = ends.each_ref().map(|end| end.velocity(at.v));
        let mut velocity: Vector<D, N> = touching - surface;
        if let (Some(paid_out), Some(place)) = (&now.paid_out, marker.element) {
            velocity += paid_out.convective_velocity(place, marker.direction(at.x));
        }
        let hold = self.hold_at(at, &position);
        let touch = self.law.touch_held((depth, normal), velocity, hold);
        PlaceTouch { touch, ends }
    }

    /// Number of driven coordinates in which the state keeps the friction of a marker.
    pub const KEPT: usize = D + 1;

    /// State of friction of a marker at a position.
    #[inline(always)]
    fn hold_at<N: Number>(&self, at: Instant<'_, D, N>, position: &Vector<D, N>) -> Hold<D, N> {
        let Some(kept) = self.kept else {
            return Hold::Free;
        };
        let kept = &at.drives[kept..];
        let given = Vector::from_fn(|k, _| kept[k][0]);
        let frame = self.surface_frame.as_ref();
        match Grip::of(kept[D][0].plain()) {
            Grip::Free => Hold::Free,
            Grip::Sticks => {
                let end = frame.map_or(given, |frame| frame.position(at.x, &given));
                Hold::Sticks(position - end)
            }
            Grip::Slides => Hold::Slides(frame.map_or(given, |frame| frame.vector(at.x, &given))),
        }
    }

    /// Friction of a marker as it decides whether the marker sticks; none where it cannot.
    pub(in crate::system) fn stick_motion(&self, at: Instant<'_, D>) -> Option<StickMotion<D>> {
        let (spring, now) = (self.law.sticking?, self.present(at));
        let position = self.places[0].marker.position(at.x);
        let (depth, normal) = now.surface.under(&position)?;
        let on = self.meet(0, (depth + self.law.radius, normal), &now);
        let mut motion = self.law.stick_motion(spring, position, &on.touch);
        if let Some(frame) = self.surface_frame {
            motion.end = frame.components(at.x, &motion.end);
            for vector in [&mut motion.slip, &mut motion.against] {
                *vector = frame.along(at.x, vector);
            }
        }
        Some(motion)
    }

    /// Force on a place, N or N/m.
    fn force<N: Number>(&self, place: usize, now: &Present<'_, D, N>) -> Vector<D, N> {
        let touch = self.touch(place, now);
        touch.map_or_else(Vector::zeros, |on| self.law.force(&on.touch))
    }

    /// Whether it is that of a body, not of a marker.
    pub(in crate::system) fn is_distributed(&self) -> bool {
        self.places.len() > 1
    }

    /// First node of the body or marker that it acts on.
    pub(in crate::system) fn first_node(&self) -> usize {
        self.places[0].marker.nodes[0]
    }

    /// Force per reference length at the Gauss points of a segment of a body, N/m.
    pub(in crate::system) fn values<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        segment: usize,
    ) -> Values<D, N> {
        let first = segment * GAUSS_5.len();
        let now = self.present(at);
        let longer = now.longer();
        std::array::from_fn(|k| self.force(first + k, &now) * longer)
    }

    /// The whole force, N.
    pub(in crate::system) fn whole<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let mut sum = Vector::zeros();
        self.each_pair(at, 0..self.places.len(), |_, force| sum += force);
        sum
    }

    /// Force at the point that is nearest to a material coordinate of the body, N/m; that of a marker, N.
    pub(in crate::system) fn nearest(&self, at: Instant<'_, D>, s: f64) -> Vector<D> {
        let length: f64 = self.places.iter().map(|place| place.weight).sum();
        let mut before = 0.0;
        let place = self.places.iter().position(|place| {
            before += place.weight;
            before >= s * length
        });
        self.force(place.unwrap_or(self.places.len() - 1), &self.present(at))
    }

    /// Calls with both ends of every place that touches, and the force on the second one, N.
    fn each_pair<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        places: std::ops::Range<usize>,
        mut call: impl FnMut(&[Attachment<D, N>; 2], Vector<D, N>),
    ) {
        let now = self.present(at);
        let longer = now.longer();
        for place in places {
            if let Some(on) = self.touch(place, &now) {
                let weight = N::of(self.places[place].weight) * longer;
                call(&on.ends, self.law.force(&on.touch) * weight);
            }
        }
    }

    /// Calls with every end, and the forces on position and direction there.
    fn each_force<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        places: std::ops::Range<usize>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        self.each_pair(at, places, |[surface, touching], force| {
            call(touching, [force, Vector::zeros()]);
            if self.surface_frame.is_some() {
                call(surface, [-force, Vector::zeros()]);
            }
        });
    }

    /// The sum over all points of what touching takes or holds there, by their weights.
    fn sum<N: Number>(&self, at: Instant<'_, D, N>, of: impl Fn(&Touch<D, N>) -> N) -> N {
        let (mut sum, now) = (N::of(0.0), self.present(at));
        for (index, place) in self.places.iter().enumerate() {
            if let Some(on) = self.touch(index, &now) {
                sum += of(&on.touch) * N::of(place.weight);
            }
        }
        sum * now.longer()
    }

    fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.sum(at, |touch| self.law.dissipation(touch))
    }
}

impl<const D: usize> ForceElement<D> for Contact<D> {
    /// Nodes of the segments of a body, or of the marker, with those of the surface.
    fn parts(&self, _bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let surface = self.surface_frame.iter();
        let surface: Vec<usize> = surface.flat_map(RigidFrame::nodes::<D>).collect();
        let segments = self.places.chunks(GAUSS_5.len());
        let nodes = segments.map(|places| {
            let touching = places[0].marker.nodes.into_iter();
            touching.chain(surface.iter().copied()).collect()
        });
        nodes.collect()
    }

    /// Adds the forces of one of these.
    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        let first = part * GAUSS_5.len();
        let last = self.places.len().min(first + GAUSS_5.len());
        self.each_force(at, first..last, |end, [position, direction]| {
            end.add_force(position, direction, f);
        });
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        self.each_force(at, 0..self.places.len(), |end, [position, direction]| {
            end.add_force(position, direction, f);
        });
    }

    /// Calls with the marker and its force; not along a body.
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        if !self.is_distributed() {
            self.each_force(at, 0..1, call);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let now = self.present(at);
        for (index, place) in self.places.iter().enumerate() {
            let Some(PlaceTouch { touch, ends }) = self.touch(index, &now) else {
                continue;
            };
            let weight = place.weight * now.longer();
            let [stiff, damped] = self.law.tangents(&now.surface, &touch);
            between(&ends, damped * weight, 0, &mut *damping);
            // The normal force acts on both bodies at the middle of what touches as well. It rotates with the surface, and so does the force
            // on what sticks.
            let surface = self.surface_frame.map(|frame| {
                let middle = frame.point(at.x, &place.marker.position(at.x));
                let force = self.law.push(&touch) * weight;
                frame.add_rotation(at.x, (&middle, &place.marker), &force, &mut *stiffness);
                middle
            });
            let surface = surface.map_or(Attachment::Ground(Vector::zeros()), Attachment::Body);
            let ends = [surface, Attachment::Body(place.marker)];
            between(&ends, stiff * weight, 0, &mut *stiffness);
        }
    }

    /// Returns the power of touching material that a winch pays out, and the dissipated power, W.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let mut comes_in = N::of(0.0);
        let now = self.present(at);
        if let Some(paid_out) = &now.paid_out {
            let end = Vector::from(at.x[paid_out.winch.end()][0]);
            if let Some((depth, _)) = self.law.depth(&now.surface, &end) {
                comes_in = self.law.spring.energy(depth) * paid_out.speed();
            }
        }
        [comes_in, self.dissipation(at)]
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.sum(at, |touch| self.law.energy(touch))
    }

    fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Values<D, N>> {
        let is_on = self.is_distributed() && self.first_node() == first;
        is_on.then(|| self.values(at, segment))
    }

    /// Friction is absent at rest.
    fn hold(&mut self, _at: Instant<'_, D>, _fraction: f64) {
        self.law.friction = 0.0;
        self.law.sticking = None;
        self.kept = None;
    }

    fn is_conservative(&self) -> bool {
        self.law.friction == 0.0
    }

    fn has_contact(&self) -> bool {
        true
    }

    fn has_belt_friction(&self) -> bool {
        self.is_distributed() && self.law.has_belt_friction()
    }

    fn is_damped(&self) -> bool {
        self.law.is_damped()
    }

    /// The marker, where contact is that of one.
    fn ends(&self) -> Vec<Attachment<D>> {
        if self.is_distributed() {
            return Vec::new();
        }
        vec![Attachment::Body(self.places[0].marker)]
    }
}
