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

/// Spring with a damper along a surface, from where a point sticks to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentialSpring {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Largest force, in parts of the friction of a point that slides, at least 1.
    pub static_ratio: f64,
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
    /// Speed of slip at which friction has `1 / sqrt(2)` of its size, m/s; positive where there is friction. Where points stick, the
    /// speed at which they do.
    pub slip_velocity: f64,
    /// Spring that holds a point which sticks; none where all points slide.
    pub sticking: Option<TangentialSpring>,
    /// Distance from the point or line of what touches to its own surface, m.
    pub radius: f64,
}

/// State of friction at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// Friction follows the velocity, and vanishes at rest.
    Free,
    /// Friction holds the point where it is.
    Sticks,
    /// Friction is as large as it can be, whatever the speed.
    Slides,
}

impl Grip {
    /// The one that a saved state keeps by a number.
    #[inline(always)]
    pub(in crate::system) fn of(number: f64) -> Self {
        if number == 0.0 {
            Self::Free
        } else if number == 1.0 {
            Self::Sticks
        } else {
            Self::Slides
        }
    }

    /// Number by which a saved state keeps this one.
    pub(in crate::system) fn number(self) -> f64 {
        match self {
            Self::Free => 0.0,
            Self::Sticks => 1.0,
            Self::Slides => 2.0,
        }
    }
}

/// State of friction at a point, with the vector that friction follows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Hold<const D: usize, N> {
    /// See [`Grip`].
    Free,
    /// Way from where the point sticks, m.
    Sticks(Vector<D, N>),
    /// Unit vector along which the point slid last.
    Slides(Vector<D, N>),
}

/// How a point touches.
pub(in crate::system::loads) struct Touch<const D: usize, N> {
    /// Spring along the normal, compressed by how far the point is below the surface.
    compression: Compression<N>,
    /// Unit vector out of the surface.
    pub(super) normal: Vector<D, N>,
    /// Velocity along the surface, m/s.
    slip: Vector<D, N>,
    /// Direction that friction acts against, of unit length where it is as large as it can be.
    against: Vector<D, N>,
    /// Speed over which that direction changes, m/s.
    speed: N,
    /// Spring that holds the point, and the way along the surface from where it sticks, m; none of a point that does not.
    stuck: Option<(TangentialSpring, Vector<D, N>)>,
    /// State of friction.
    grip: Grip,
}

/// Friction at a point, as it decides whether the point sticks.
#[derive(Clone, Copy, Debug)]
pub struct StickMotion<const D: usize = 2> {
    /// Whether the point touches.
    pub touches: bool,
    /// Velocity along the surface, in the frame of the surface, m/s.
    pub slip: Vector<D>,
    /// Size of friction, N.
    pub friction: f64,
    /// Largest friction of a point that sticks, N; negative above the surface.
    pub largest: f64,
    /// Unit vector against friction, in the frame of the surface; zero without friction.
    pub against: Vector<D>,
    /// Where the end of the spring on the surface is with the force that friction has now, in the frame of the surface, m.
    pub end: Vector<D>,
    /// Energy of the spring with that force, J.
    pub energy: f64,
}

impl<const D: usize> Default for StickMotion<D> {
    fn default() -> Self {
        Self {
            touches: false,
            slip: Vector::zeros(),
            friction: 0.0,
            largest: 0.0,
            against: Vector::zeros(),
            end: Vector::zeros(),
            energy: 0.0,
        }
    }
}

/// Speed below which the direction of friction follows that of the last sliding, in parts of the speed at which a point sticks.
const SLOW: f64 = 0.1;

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
    pub(super) fn under(&self, at: &Vector<D, N>) -> Option<(N, Vector<D, N>)> {
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

impl<const D: usize, N: Number> Touch<D, N> {
    /// Force along the surface on a point that sticks.
    #[inline(always)]
    fn held(&self) -> Option<Vector<D, N>> {
        self.stuck.as_ref().map(|(spring, way)| {
            -*way * N::of(spring.stiffness) - self.slip * N::of(spring.damping)
        })
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
        under: (N, Vector<D, N>),
        velocity: Vector<D, N>,
    ) -> Touch<D, N> {
        self.touch_held(under, velocity, Hold::Free)
    }

    /// How it touches there, at a velocity against the surface, in a state of friction.
    #[inline(always)]
    pub(super) fn touch_held<N: Number>(
        &self,
        (depth, normal): (N, Vector<D, N>),
        velocity: Vector<D, N>,
        hold: Hold<D, N>,
    ) -> Touch<D, N> {
        let rate = -normal.dot(&velocity);
        let slip = velocity + normal * rate;
        let along = |of: Vector<D, N>| of - normal * normal.dot(&of);
        let freely = || {
            let smooth = N::of(self.slip_velocity * self.slip_velocity);
            let speed = (slip.norm_squared() + smooth).sqrt();
            (slip * (N::of(1.0) / speed), speed)
        };
        let (grip, stuck, (against, speed)) = match hold {
            Hold::Free => (Grip::Free, None, freely()),
            Hold::Sticks(way) => {
                let spring = self.sticking;
                let stuck = spring.map(|spring| (spring, along(way)));
                (Grip::Sticks, stuck, freely())
            }
            Hold::Slides(last) => (Grip::Slides, None, self.sliding(slip, along(last))),
        };
        Touch {
            compression: self.spring.compressed(depth, rate),
            normal,
            slip,
            against,
            speed,
            stuck,
            grip,
        }
    }

    /// Direction of slip of a point that slid in another direction last, and the speed over which it changes. Where the point moves back, its
    /// way back counts as forward: steps within which it stops are smooth beyond the stop.
    fn sliding<N: Number>(&self, slip: Vector<D, N>, last: Vector<D, N>) -> (Vector<D, N>, N) {
        let along = slip.dot(&last);
        let forward = if along.plain() < 0.0 {
            slip - last * (N::of(2.0) * along)
        } else {
            slip
        };
        let slid = forward + last * N::of(SLOW * self.slip_velocity);
        let speed = slid.norm_squared().sqrt();
        (slid / speed, speed)
    }

    /// Force on a point that touches, without friction of slip: that of the springs.
    pub(in crate::system::loads) fn push<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        touch.normal * touch.compression.force() + touch.held().unwrap_or(Vector::zeros())
    }

    /// Friction on a point that touches.
    #[inline(always)]
    fn rub<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        touch.held().unwrap_or_else(|| {
            let push = touch.compression.force();
            touch.against * (-N::of(self.friction) * push)
        })
    }

    /// Force on a point that touches.
    pub(in crate::system::loads) fn force<N: Number>(&self, touch: &Touch<D, N>) -> Vector<D, N> {
        let push = touch.normal * touch.compression.force();
        if self.friction == 0.0 {
            return push;
        }
        push + self.rub(touch)
    }

    /// Friction as it decides whether a point sticks by a spring, with vectors in the frame of the scene. A point that has left the surface
    /// has a negative depth.
    pub(super) fn stick_motion(
        &self,
        spring: TangentialSpring,
        position: Vector<D>,
        touch: &Touch<D, f64>,
    ) -> StickMotion<D> {
        let depth = touch.compression.depth;
        let touches = depth > 0.0;
        let push = if touches {
            touch.compression.force()
        } else {
            self.spring.stiffness * depth
        };
        let force = self.rub(touch);
        let stretched = touch
            .stuck
            .map_or(force / spring.stiffness, |(_, way)| -way);
        StickMotion {
            touches,
            slip: touch.slip,
            friction: force.norm(),
            largest: spring.static_ratio * self.friction * push,
            against: (-force).try_normalize(0.0).unwrap_or(Vector::zeros()),
            end: position + stretched,
            energy: 0.5 * spring.stiffness * stretched.norm_squared(),
        }
    }

    /// Stiffness and damping of a point that touches a surface. A part is left out: how friction follows from the depth. It is not
    /// symmetric, and acts one way, from the normal force to friction, so that iterations find it. So is how a round surface rotates the way
    /// from where a point sticks, which is short. A point that may stick counts as one that does where it does not slide or is at rest:
    /// explicit steps have to be stable while it sticks.
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
        let (mut stiff, mut damped) = (along * by_depth - curved, along * by_rate);
        let across = SMatrix::identity() - along;
        if let Some(spring) = self.sticking
            && (touch.grip != Grip::Slides || touch.slip.norm_squared() == 0.0)
        {
            stiff += across * spring.stiffness;
            damped += across * spring.damping;
        } else if self.friction > 0.0 {
            let way = touch.against * touch.against.transpose();
            damped += (across - way) * (self.friction * push / touch.speed);
        }
        [stiff, damped]
    }

    /// Energy of the springs at a point that touches.
    pub(in crate::system::loads) fn energy<N: Number>(&self, touch: &Touch<D, N>) -> N {
        let pushed = self.spring.energy(touch.compression.depth);
        match &touch.stuck {
            Some((spring, way)) => pushed + N::of(0.5 * spring.stiffness) * way.norm_squared(),
            None => pushed,
        }
    }

    /// Power that damping and friction dissipate at a point that touches.
    pub(in crate::system::loads) fn dissipation<N: Number>(&self, touch: &Touch<D, N>) -> N {
        let pushed = touch.compression.dissipation();
        if self.friction == 0.0 {
            return pushed;
        }
        let rubbed = match &touch.stuck {
            Some((spring, _)) => N::of(spring.damping) * touch.slip.norm_squared(),
            None => {
                let friction = N::of(self.friction) * touch.compression.force();
                friction * touch.against.dot(&touch.slip)
            }
        };
        pushed + rubbed
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
