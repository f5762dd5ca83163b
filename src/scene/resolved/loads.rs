//! Loads of a resolved scene: forces and moments, springs, dampers, stops and contacts.

use std::f64::consts::PI;

use super::{Cable, Ends, JointCoordinate, LoadId, Pivot, Resolved, ResolvedMarker};
use crate::math::curve::Curve;
use crate::scene::description::{ActionKind, SectionNumbers, Surface, Value};
use crate::system::Signal;

/// A load that the scene knows.
#[derive(Clone, Debug)]
pub struct ResolvedLoad<'a> {
    /// Name.
    pub name: &'a str,
    /// Kind of load with its parameters.
    pub kind: LoadKind<'a>,
}

/// Kind of a load with its parameters.
#[derive(Clone, Debug)]
pub enum LoadKind<'a> {
    /// A force or a moment.
    Action {
        /// Which and where.
        action: Action<'a>,
        /// Components as written in the scene.
        values: &'a [Value],
    },
    /// A spring and a damper side by side.
    Spring(ResolvedSpring<'a>),
    /// A spring and a damper side by side, by tables.
    TableSpring(ResolvedTableSpring<'a>),
    /// A spring and a damper on a coordinate of a joint.
    JointSpring {
        /// Coordinate that spring and damper act on.
        on: JointCoordinate<'a>,
        /// Stiffness (N/m or N m/rad) and damping (N s/m or N m s/rad).
        sizes: [f64; 2],
        /// Coordinate at rest; that at the start if there is none.
        rest: Option<f64>,
    },
    /// Springs and dampers along and about three axes.
    Bushing(ResolvedBushing<'a>),
    /// Stops of a coordinate of a joint.
    JointLimit {
        /// Coordinate that the stops limit.
        on: JointCoordinate<'a>,
        /// Stiffness (N/m or N m/rad) and damping (s/m or s/rad).
        sizes: [f64; 2],
        /// Limits below and above.
        limits: [Option<f64>; 2],
    },
    /// A fluid along a body.
    Fluid(ResolvedFluid<'a>),
    /// Contact with a surface of the ground.
    Contact(ResolvedContact<'a>),
}

/// A fluid along a body.
#[derive(Clone, Debug)]
pub struct ResolvedFluid<'a> {
    /// Line body that the fluid acts on.
    pub on: Cable<'a>,
    /// Density of the fluid, kg/m^3.
    pub density: f64,
    /// Velocity of the fluid, m/s. Components that vary along the body are zero here.
    pub current: Vec<Signal>,
    /// Components that change along the body, and their expressions.
    pub along: Vec<(usize, &'a str)>,
    /// The components as written; none where it rests.
    pub given: &'a [Value],
    /// Coefficients of drag across the line and along it.
    pub drag: [f64; 2],
    /// Coefficient of added mass.
    pub added_mass: f64,
    /// Diameter that drag counts with, m, where it is not that of the section.
    pub diameter: Option<f64>,
    /// Area that displaces fluid, m^2, where it is not that of a circle of this diameter.
    pub area: Option<f64>,
    /// Whether it lifts.
    pub buoyancy: bool,
}

impl ResolvedFluid<'_> {
    /// Diameter that drag counts with at a section, m.
    pub fn diameter(&self, section: &SectionNumbers) -> f64 {
        self.diameter.unwrap_or_else(|| section.diameter())
    }

    /// Mass of the fluid that is displaced at a section, kg/m.
    pub fn displaced(&self, section: &SectionNumbers) -> f64 {
        let circle = 0.25 * PI * self.diameter(section).powi(2);
        self.density * self.area.unwrap_or(circle)
    }

    /// Mass of the fluid that moves along at a section, kg/m.
    pub fn added(&self, section: &SectionNumbers) -> f64 {
        self.added_mass * self.displaced(section)
    }
}

/// Contact with a surface of the ground.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedContact<'a> {
    /// Marker or line body that touches the surface.
    pub by: ContactBody<'a>,
    /// Surface that is touched.
    pub surface: Surface,
    /// Stiffness (N/m, of a body N/m per length) and damping (s/m).
    pub sizes: [f64; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Speed of slip below which friction is smooth, m/s, if there is one.
    pub slip_velocity: Option<f64>,
}

/// Marker or line body that touches a surface.
#[derive(Clone, Copy, Debug)]
pub enum ContactBody<'a> {
    /// A marker.
    Marker(ResolvedMarker<'a>),
    /// A cable along its line.
    Cable(Cable<'a>),
}

impl<'a> ContactBody<'a> {
    /// The marker, if it is one.
    pub fn marker(self) -> Option<ResolvedMarker<'a>> {
        match self {
            Self::Marker(marker) => Some(marker),
            Self::Cable(_) => None,
        }
    }
}

/// Springs and dampers along and about the axes of the first end's body.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedBushing<'a> {
    /// Ends of the bushing.
    pub ends: Ends<'a>,
    /// Stiffness along (N/m) and about (N m/rad) the axes.
    pub stiffness: [[f64; 3]; 2],
    /// Damping along (N s/m) and about (N m s/rad) the axes.
    pub damping: [[f64; 3]; 2],
}

impl<'a> LoadKind<'a> {
    /// Returns the ends of springs between two points. `None` for other loads.
    pub fn between(&self) -> Option<Ends<'a>> {
        match self {
            Self::Spring(spring) => Some(spring.ends),
            Self::TableSpring(spring) => Some(spring.ends),
            Self::Bushing(bushing) => Some(bushing.ends),
            Self::Action { .. }
            | Self::JointSpring { .. }
            | Self::JointLimit { .. }
            | Self::Fluid(_)
            | Self::Contact(_) => None,
        }
    }

    /// Whether it has a force, and whether it has a moment, that follows from the motion.
    pub fn exerts(&self) -> [bool; 2] {
        match self {
            Self::Action { .. } | Self::Fluid(_) => [false; 2],
            Self::Spring(_) | Self::TableSpring(_) | Self::Contact(_) => [true, false],
            Self::Bushing(_) => [true; 2],
            Self::JointSpring { on, .. } | Self::JointLimit { on, .. } => {
                [!on.is_angle(), on.is_angle()]
            }
        }
    }

    /// The marker that such a force or moment acts on; none of a contact of a body.
    pub fn exerts_on(&self) -> Option<ResolvedMarker<'a>> {
        match self {
            Self::Action { .. } | Self::Fluid(_) => None,
            Self::Spring(_) | Self::TableSpring(_) | Self::Bushing(_) => {
                self.between().map(|ends| ends.second)
            }
            Self::Contact(contact) => contact.by.marker(),
            Self::JointSpring { on, .. } | Self::JointLimit { on, .. } => Some(match on {
                JointCoordinate::Displacement(slider) => slider.ends.second,
                JointCoordinate::Angle(pivot) => pivot.ends.second,
            }),
        }
    }

    /// Returns the largest stiffness against displacements (N/m, of contacts of bodies N/m per length) and against
    /// rotations (N m/rad).
    pub fn stiffness(&self) -> [f64; 2] {
        match self {
            Self::Action { .. } | Self::Fluid(_) => [0.0; 2],
            Self::Spring(spring) => [spring.stiffness, 0.0],
            Self::TableSpring(spring) => [spring.spring.steepest(), 0.0],
            Self::Contact(contact) => [contact.sizes[0], 0.0],
            Self::Bushing(bushing) => bushing
                .stiffness
                .map(|axes| axes.into_iter().fold(0.0, f64::max)),
            Self::JointSpring { on, sizes, .. } | Self::JointLimit { on, sizes, .. } => {
                if on.is_angle() {
                    [0.0, sizes[0]]
                } else {
                    [sizes[0], 0.0]
                }
            }
        }
    }
}

/// A spring and a damper between two ends, by tables.
#[derive(Clone, Debug)]
pub struct ResolvedTableSpring<'a> {
    /// Ends of the spring.
    pub ends: Ends<'a>,
    /// Force with which the spring pulls, N, over its length, m.
    pub spring: Curve,
    /// Force with which the damper pulls, N, over the rate of the length, m/s.
    pub damper: Option<Curve>,
}

/// A spring and a damper between two ends.
#[derive(Clone, Debug)]
pub struct ResolvedSpring<'a> {
    /// Ends of the spring.
    pub ends: Ends<'a>,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Length at rest as written, m.
    pub given: Option<&'a Value>,
    /// Length at rest, m; the distance at the start if there is none.
    pub length: Option<Signal>,
}

/// A force or a moment, known or an input.
#[derive(Clone, Debug)]
pub struct Action<'a> {
    /// Which.
    pub kind: ActionKind,
    /// Marker, joint or line body that the load acts on, depending on its kind.
    pub on: LoadTarget<'a>,
    /// Whether it turns with the marker.
    pub follower: bool,
    /// Components, as many as the kind has. Components that vary along a body are zero here.
    pub components: Vec<Signal>,
    /// Components that change along a body, and their expressions.
    pub along: Vec<(usize, &'a str)>,
}

/// Marker, joint or line body that a force or a moment acts on.
#[derive(Clone, Copy, Debug)]
pub enum LoadTarget<'a> {
    /// A marker.
    Marker(ResolvedMarker<'a>),
    /// A joint: its second marker, and the opposite on its first.
    Joint(Pivot<'a>),
    /// A cable, per reference length.
    Cable(Cable<'a>),
}

impl<'a> Resolved<'a> {
    /// Loads with their numbers.
    pub fn numbered_loads(&self) -> impl Iterator<Item = (LoadId, &ResolvedLoad<'a>)> {
        let loads = self.loads.iter().enumerate();
        loads.map(|(place, load)| (LoadId(place), load))
    }
}
