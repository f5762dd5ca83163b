//! Surfaces that are touched, and the force of contact at a point.

use nalgebra::SMatrix;

use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::loads::OneSidedSpring;
use crate::system::loads::one_sided_spring::Compression;

/// Surface of a contact, fixed in the frame of the scene or in that of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactSurface<const D: usize = 2, N = f64> {
    /// All that is below a point along a unit vector.
    Plane {
        /// The point, m.
        point: Vector<D, N>,
        /// The unit vector.
        normal: Vector<D, N>,
    },
    /// A circle or a sphere; a cylinder where there is an axis.
    Round {
        /// A point in the middle, m.
        center: Vector<D, N>,
        /// Unit vector along the axis.
        axis: Option<Vector<D, N>>,
        /// Radius, m.
        radius: f64,
    },
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
    /// Distance from the point or line of what touches to its own surface, m.
    pub radius: f64,
}

/// How a point touches.
pub(in crate::system::loads) struct Touch<const D: usize, N> {
    /// Spring along the normal, compressed by how far the point is below the surface.
    compression: Compression<N>,
    /// Unit vector out of the surface.
    pub(super) normal: Vector<D, N>,
    /// Velocity along the surface, m/s.
    slip: Vector<D, N>,
    /// Size of the slip velocity, with the speed at which friction is smooth, m/s.
    speed: N,
}

impl<const D: usize> ContactSurface<D> {
    /// The surface with its points and its directions elsewhere.
    pub fn map<N>(
        &self,
        place: impl Fn(&Vector<D>) -> Vector<D, N>,
        turned: impl Fn(&Vector<D>) -> Vector<D, N>,
    ) -> ContactSurface<D, N> {
        match self {
            Self::Plane { point, normal } => ContactSurface::Plane {
                point: place(point),
                normal: turned(normal),
            },
            Self::Round {
                center,
                axis,
                radius,
            } => ContactSurface::Round {
                center: place(center),
                axis: axis.as_ref().map(turned),
                radius: *radius,
            },
        }
    }

    /// Converts it to constants of another number type.
    #[inline(always)]
    pub(in crate::system::loads) fn lift<N: Number>(&self) -> ContactSurface<D, N> {
        let same = |of: &Vector<D>| of.map(N::of);
        self.map(same, same)
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

impl<const D: usize, N: Number> ContactSurface<D, N> {
    /// How far a point is below, m, and the unit vector out of the surface there; none in the middle of what is round.
    #[inline(always)]
    fn under(&self, at: &Vector<D, N>) -> Option<(N, Vector<D, N>)> {
        match self {
            Self::Plane { point, normal } => Some((normal.dot(&(point - at)), *normal)),
            Self::Round {
                center,
                axis,
                radius,
            } => {
                let mut arm = at - center;
                if let Some(axis) = axis {
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
}

impl<const D: usize> ContactLaw<D> {
    /// How deep what is about a point is below the surface, m, and the unit vector out of it; none where it does not touch. The surface is
    /// that of the law as it stands at this instant.
    #[inline(always)]
    pub(in crate::system::loads) fn depth<N: Number>(
        &self,
        surface: &ContactSurface<D, N>,
        position: &Vector<D, N>,
    ) -> Option<(N, Vector<D, N>)> {
        let (depth, normal) = surface.under(position)?;
        let depth = depth + N::of(self.radius);
        (depth.plain() > 0.0).then_some((depth, normal))
    }

    /// How it touches there, at a velocity against the surface.
    #[inline(always)]
    pub(in crate::system::loads) fn touch<N: Number>(
        &self,
        (depth, normal): (N, Vector<D, N>),
        velocity: Vector<D, N>,
    ) -> Touch<D, N> {
        let rate = -normal.dot(&velocity);
        let slip = velocity + normal * rate;
        Touch {
            compression: self.spring.compressed(depth, rate),
            normal,
            slip,
            speed: (slip.norm_squared() + N::of(self.slip_velocity * self.slip_velocity)).sqrt(),
        }
    }

    /// Force along the normal on a point that touches.
    pub(in crate::system::loads) fn push<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        touch.normal * touch.compression.force()
    }

    /// Force on a point that touches.
    pub(in crate::system::loads) fn force<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        let push = touch.compression.force();
        if self.friction == 0.0 {
            return touch.normal * push;
        }
        touch.normal * push - touch.slip * (N::of(self.friction) * push / touch.speed)
    }

    /// Stiffness and damping of a point that touches a surface. A part is left out: how friction follows from the depth. It is not
    /// symmetric, and acts one way, from the normal force to friction, so that iterations find it.
    pub(in crate::system::loads) fn tangents(
        &self,
        surface: &ContactSurface<D>,
        touch: &Touch<D, f64>,
    ) -> [SMatrix<f64, D, D>; 2] {
        let (push, normal) = (touch.compression.force(), &touch.normal);
        let [by_depth, by_rate] = touch.compression.slopes();
        let along: SMatrix<f64, D, D> = normal * normal.transpose();
        // A round surface pushes aside.
        let depth = touch.compression.depth - self.radius;
        let curved = surface.curvature(depth, normal) * push;
        let mut damped = along * by_rate;
        if self.friction > 0.0 {
            let way = touch.slip / touch.speed;
            let across = SMatrix::identity() - along - way * way.transpose();
            damped += across * (self.friction * push / touch.speed);
        }
        [along * by_depth - curved, damped]
    }

    /// Energy of the spring at a point that touches.
    pub(in crate::system::loads) fn energy<N: Number>(&self, touch: &Touch<D, N>) -> N {
        self.spring.energy(touch.compression.depth)
    }

    /// Power that damping and friction dissipate at a point that touches.
    pub(in crate::system::loads) fn dissipation<N: Number>(&self, touch: &Touch<D, N>) -> N {
        let pushed = touch.compression.dissipation();
        if self.friction == 0.0 {
            return pushed;
        }
        let rubbed = N::of(self.friction) * touch.compression.force() / touch.speed;
        pushed + rubbed * touch.slip.norm_squared()
    }

    /// Whether a body that is wound around the surface is rubbed by it.
    pub(in crate::system::loads) fn has_belt_friction(&self) -> bool {
        self.friction > 0.0 && matches!(self.surface, ContactSurface::Round { .. })
    }

    /// Whether it dissipates.
    pub(in crate::system::loads) fn is_damped(&self) -> bool {
        self.spring.damping > 0.0 || self.friction > 0.0
    }
}
