//! Contact of a marker, or of the line of a body, with a fixed surface. Where a point is below the surface, the surface
//! pushes along its normal with the force `N` of a [`OneSidedSpring`] that is compressed by the depth.
//! Friction is `-mu N v / sqrt(v^2 + w^2)`, `v` the velocity along the surface, `w` the speed of slip: smooth, and none at rest.
//! Along a body all of this is per reference length and counts at the Gauss points of its segments.
//!
//! Source: as for the spring; P. Wriggers, Computational Contact Mechanics, 2nd ed. (2006), section 5.2 (Coulomb's law with a square
//! root in place of its corner).

use nalgebra::SMatrix;

use super::one_sided_spring::Compression;
use super::{Add, ForceElement, Instant, OneSidedSpring};
use crate::bodies::winch::{PaidOut, length_ratio};
use crate::bodies::{Bodies, Marker, Node};
use crate::elements::shape::Values;
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::system::end::{Attachment, between};

/// Surface of a contact, fixed in the frame of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactSurface<const D: usize = 2> {
    /// All that is below a point along a unit vector.
    Plane {
        /// The point, m.
        point: Vector<D>,
        /// The unit vector.
        normal: Vector<D>,
    },
    /// A circle or a sphere; a cylinder where there is an axis.
    Round {
        /// A point in the middle, m.
        center: Vector<D>,
        /// Unit vector along the axis.
        axis: Option<Vector<D>>,
        /// Radius, m.
        radius: f64,
    },
}

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
}

/// Law of contact with a surface.
#[derive(Clone, Copy, Debug)]
pub struct ContactLaw<const D: usize = 2> {
    /// Surface that is touched.
    pub surface: ContactSurface<D>,
    /// Spring along the normal.
    pub spring: OneSidedSpring,
    /// Coefficient of friction.
    pub friction: f64,
    /// Speed of slip at which friction has `1 / sqrt(2)` of its size, m/s; positive where there is friction.
    pub slip_velocity: f64,
}

/// How a point touches.
pub(super) struct Touch<const D: usize, N> {
    /// Spring along the normal, compressed by how far the point is below the surface.
    compression: Compression<N>,
    /// Unit vector out of the surface.
    normal: Vector<D, N>,
    /// Velocity along the surface, m/s.
    slip: Vector<D, N>,
    /// Size of the slip velocity, with the speed at which friction is smooth, m/s.
    speed: N,
}

impl<const D: usize> ContactSurface<D> {
    /// How far a point is below, m, and the unit vector out of the surface there; none in the middle of what is round.
    fn under<N: Number>(&self, at: &Vector<D, N>) -> Option<(N, Vector<D, N>)> {
        match self {
            Self::Plane { point, normal } => {
                let normal = normal.map(N::of);
                Some((normal.dot(&(point.map(N::of) - at)), normal))
            }
            Self::Round {
                center,
                axis,
                radius,
            } => {
                let mut arm = at - center.map(N::of);
                if let Some(axis) = axis.map(|axis| axis.map(N::of)) {
                    arm -= axis * axis.dot(&arm);
                }
                let square = arm.norm_squared();
                (square.plain() > 0.0).then(|| {
                    let distance = square.sqrt();
                    (N::of(*radius) - distance, arm / distance)
                })
            }
        }
    }

    /// How the unit vector out of the surface rotates with the point, 1/m.
    fn curvature(&self, depth: f64, normal: &Vector<D>) -> SMatrix<f64, D, D> {
        match self {
            Self::Plane { .. } => SMatrix::zeros(),
            Self::Round { axis, radius, .. } => {
                let mut across = SMatrix::identity() - normal * normal.transpose();
                if let Some(axis) = axis {
                    across -= axis * axis.transpose();
                }
                across / (radius - depth)
            }
        }
    }
}

impl<const D: usize> ContactLaw<D> {
    /// How a point touches, by its position and its velocity; none above the surface.
    #[inline(always)]
    pub(super) fn touch<N: Number>(
        &self,
        position: &Vector<D, N>,
        velocity: impl FnOnce() -> Vector<D, N>,
    ) -> Option<Touch<D, N>> {
        let (depth, normal) = self.surface.under(position)?;
        if depth.plain() <= 0.0 {
            return None;
        }
        let velocity = velocity();
        let rate = -normal.dot(&velocity);
        let slip = velocity + normal * rate;
        Some(Touch {
            compression: self.spring.compressed(depth, rate),
            normal,
            slip,
            speed: (slip.norm_squared() + N::of(self.slip_velocity * self.slip_velocity)).sqrt(),
        })
    }

    /// Force on a point that touches.
    pub(super) fn force<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        let push = touch.compression.force();
        if self.friction == 0.0 {
            return touch.normal * push;
        }
        touch.normal * push - touch.slip * (N::of(self.friction) * push / touch.speed)
    }

    /// Stiffness and damping of a point that touches. A part is left out: how friction follows from the depth. It is not symmetric, and
    /// acts one way, from the normal force to friction, so that iterations find it.
    pub(super) fn tangents(&self, touch: &Touch<D, f64>) -> [SMatrix<f64, D, D>; 2] {
        let (push, normal) = (touch.compression.force(), &touch.normal);
        let [by_depth, by_rate] = touch.compression.slopes();
        let along: SMatrix<f64, D, D> = normal * normal.transpose();
        // A round surface pushes aside.
        let curved = self.surface.curvature(touch.compression.depth, normal) * push;
        let mut damped = along * by_rate;
        if self.friction > 0.0 {
            let way = touch.slip / touch.speed;
            let across = SMatrix::identity() - along - way * way.transpose();
            damped += across * (self.friction * push / touch.speed);
        }
        [along * by_depth - curved, damped]
    }

    /// Energy of the spring at a point that touches.
    pub(super) fn energy<N: Number>(&self, touch: &Touch<D, N>) -> N {
        self.spring.energy(touch.compression.depth)
    }

    /// Power that damping and friction dissipate at a point that touches.
    pub(super) fn dissipation<N: Number>(&self, touch: &Touch<D, N>) -> N {
        let pushed = touch.compression.dissipation();
        if self.friction == 0.0 {
            return pushed;
        }
        let rubbed = N::of(self.friction) * touch.compression.force() / touch.speed;
        pushed + rubbed * touch.slip.norm_squared()
    }

    /// Whether it dissipates.
    pub(super) fn is_damped(&self) -> bool {
        self.spring.damping > 0.0 || self.friction > 0.0
    }
}

impl<const D: usize> Contact<D> {
    /// The body, if a winch pays it out.
    fn paid_out<'a, N: Number>(&self, at: Instant<'a, D, N>) -> Option<PaidOut<'a, D, N>> {
        if self.is_distributed() {
            at.paid_out(self.first_node())
        } else {
            None
        }
    }

    /// How a point touches; none above the surface.
    #[inline(always)]
    fn touch<N: Number>(
        &self,
        marker: &Marker<N>,
        at: Instant<'_, D, N>,
        paid_out: Option<&PaidOut<'_, D, N>>,
    ) -> Option<Touch<D, N>> {
        self.law.touch(&marker.position(at.x), || {
            let mut velocity: Vector<D, N> = marker.position(at.v);
            if let (Some(paid_out), Some(place)) = (paid_out, marker.element) {
                velocity += paid_out.convective_velocity(place, marker.direction(at.x));
            }
            velocity
        })
    }

    /// Force on a point, N or N/m.
    fn force<N: Number>(
        &self,
        marker: &Marker<N>,
        at: Instant<'_, D, N>,
        paid_out: Option<&PaidOut<'_, D, N>>,
    ) -> Vector<D, N> {
        let touch = self.touch(marker, at, paid_out);
        touch.map_or_else(Vector::zeros, |touch| self.law.force(&touch))
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
        let places = &self.places[segment * GAUSS_5.len()..];
        let paid_out = self.paid_out(at);
        let longer = length_ratio(paid_out.as_ref());
        std::array::from_fn(|k| {
            self.force(&places[k].marker.lift(), at, paid_out.as_ref()) * longer
        })
    }

    /// The whole force, N.
    pub(in crate::system) fn whole<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let mut sum = Vector::zeros();
        self.each_force(at, 0..self.places.len(), |_, [force, _]| sum += force);
        sum
    }

    /// Force at the point that is nearest to a material coordinate of the body, N/m; that of a marker, N.
    pub(in crate::system) fn nearest(&self, at: Instant<'_, D>, s: f64) -> Vector<D> {
        let length: f64 = self.places.iter().map(|place| place.weight).sum();
        let mut before = 0.0;
        let place = self.places.iter().find(|place| {
            before += place.weight;
            before >= s * length
        });
        let place = place.or(self.places.last());
        let paid_out = self.paid_out(at);
        place.map_or_else(Vector::zeros, |place| {
            self.force(&place.marker, at, paid_out.as_ref())
        })
    }

    fn each_force<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        places: std::ops::Range<usize>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let paid_out = self.paid_out(at);
        let longer = length_ratio(paid_out.as_ref());
        for place in &self.places[places] {
            let marker = place.marker.lift();
            let force = self.force(&marker, at, paid_out.as_ref());
            let force = force * (N::of(place.weight) * longer);
            call(&Attachment::Body(marker), [force, Vector::zeros()]);
        }
    }

    /// The sum over all points of what touching takes or holds there, by their weights.
    fn sum<N: Number>(&self, at: Instant<'_, D, N>, of: impl Fn(&Touch<D, N>) -> N) -> N {
        let (mut sum, paid_out) = (N::of(0.0), self.paid_out(at));
        for place in &self.places {
            if let Some(touch) = self.touch(&place.marker.lift(), at, paid_out.as_ref()) {
                sum += of(&touch) * N::of(place.weight);
            }
        }
        sum * length_ratio(paid_out.as_ref())
    }

    fn dissipation<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.sum(at, |touch| self.law.dissipation(touch))
    }
}

impl<const D: usize> ForceElement<D> for Contact<D> {
    /// Nodes of the segments of a body, or of the marker.
    fn parts(&self, _bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let segments = self.places.chunks(GAUSS_5.len());
        let nodes = segments.map(|places| places[0].marker.nodes.to_vec());
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
        let paid_out = self.paid_out(at);
        let longer = length_ratio(paid_out.as_ref());
        for place in &self.places {
            let Some(touch) = self.touch(&place.marker, at, paid_out.as_ref()) else {
                continue;
            };
            let weight = place.weight * longer;
            let ends = [
                Attachment::Ground(Vector::zeros()),
                Attachment::Body(place.marker),
            ];
            let [stiff, damped] = self.law.tangents(&touch);
            between(&ends, stiff * weight, 0, &mut *stiffness);
            between(&ends, damped * weight, 0, &mut *damping);
        }
    }

    /// Returns the power of touching material that a winch pays out, and the dissipated power, W.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let mut comes_in = N::of(0.0);
        if let Some(paid_out) = self.paid_out(at) {
            let end = Vector::from(at.x[paid_out.winch.end()][0]);
            if let Some((depth, _)) = self.law.surface.under(&end)
                && depth.plain() > 0.0
            {
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
    }

    fn is_conservative(&self) -> bool {
        self.law.friction == 0.0
    }

    fn has_contact(&self) -> bool {
        true
    }

    fn is_damped(&self) -> bool {
        self.law.is_damped()
    }

    /// Elements of a body couple their nodes already.
    fn ends(&self) -> Vec<Attachment<D>> {
        if self.is_distributed() {
            return Vec::new();
        }
        vec![Attachment::Body(self.places[0].marker)]
    }
}
