//! Contacts of markers and of bodies with surfaces of the ground and of rigid bodies.

use super::joint_friction::check_static_ratio;
use super::*;
use crate::bodies::PANELS;
use crate::bodies::{Marker, RigidRod};
use crate::elements::Element;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::{components, vector};
use crate::scene::assemble::unit;
use crate::scene::description::Surface;
use crate::scene::resolved::{BodyReference, Place, Rigid};
use crate::scene::validate::checks;
use crate::scene::validate::checks::unknown;
use crate::system::Drive;
use crate::system::loads::{
    Contact, ContactLaw, ContactPoint, ContactSurface, OneSidedSpring, RigidFrame, SurfaceContact,
    TangentialSpring,
};

/// Contact with a surface of the ground, or of a rigid body, which moves with it and takes the opposite force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["marker"], ["body"]]))]
pub struct ContactLoad {
    /// Marker that touches the surface, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the cable, rod or beam whose line, or of the plate or shell whose middle surface touches the surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Distance at which it touches, m: radius of a ball or wheel about the marker, half the thickness of a body; 0 by default. With a
    /// radius, friction rotates the rigid body of a marker. Bodies along a line take friction on their line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub radius: Option<f64>,
    /// Name of the rigid body with inertia that the surface belongs to, such as a pulley, in whose frame the surface is given. By default
    /// it belongs to the ground.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface_of: Option<String>,
    /// Stiffness `k` of the surface, N/m at a marker; N/m per reference length along a line, per reference area of a plate or shell.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping `a` in the normal force `k d (1 + a d')` at the depth `d` below the surface, s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Surface that is touched, in the frame of the body that it belongs to.
    pub surface: Surface,
    /// Coulomb's coefficient of friction `mu`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub friction: Option<f64>,
    /// With friction only: `w` in the friction `mu N v / sqrt(v^2 + w^2)` at the velocity `v` along the surface, m/s. A contact that
    /// would stick creeps at a fraction of it, unless `tangential_stiffness` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub slip_velocity: Option<f64>,
    /// With friction only, at a marker: stiffness along the surface while the marker sticks, N/m. It sticks where its speed falls to
    /// `slip_velocity`, and rests without creep. It slides where the force of this stiffness exceeds the largest friction. By default
    /// nothing sticks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub tangential_stiffness: Option<f64>,
    /// With `tangential_stiffness` only: damping along the surface while the marker sticks, N s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub tangential_damping: Option<f64>,
    /// With `tangential_stiffness` only: largest friction while the marker sticks, in parts of `mu N`; 1 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1.0))]
    pub static_ratio: Option<f64>,
}

/// Contact with a surface.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedContact<'a> {
    /// As described.
    given: &'a ContactLoad,
    /// Marker, line body, plate or shell that touches the surface.
    by: LoadPlace<'a>,
    /// Rigid body that the surface belongs to; none of the ground.
    surface_of: Option<Rigid<'a>>,
}

impl ContactLoad {
    /// Law of the contact, in its number of dimensions.
    fn law<const D: usize>(&self, surface: ContactSurface<D>) -> ContactLaw<D> {
        ContactLaw {
            surface,
            radius: self.radius.unwrap_or_default(),
            spring: OneSidedSpring {
                stiffness: self.stiffness,
                damping: self.damping.unwrap_or_default(),
            },
            friction: self.friction.unwrap_or_default(),
            slip_velocity: self.slip_velocity.unwrap_or_default(),
            sticking: (self.tangential_stiffness).map(|stiffness| TangentialSpring {
                stiffness,
                damping: self.tangential_damping.unwrap_or_default(),
                static_ratio: self.static_ratio.unwrap_or(1.0),
            }),
        }
    }

    /// Checks what is said of points that stick.
    ///
    /// # Errors
    /// A number is out of its range, or nothing can stick.
    fn check_sticking(&self, path: &str, by: &LoadPlace<'_>, dimension: usize) -> Found<()> {
        let at = |key: &str| format!("{path}.{key}");
        let Some(stiffness) = self.tangential_stiffness else {
            if self.tangential_damping.is_some() || self.static_ratio.is_some() {
                let wanted = "a stiffness along the surface";
                needed(path, "tangential_stiffness", wanted, None::<f64>)?;
            }
            return Ok(());
        };
        needed(path, "friction", "a coefficient", self.friction)?;
        needed(path, "slip_velocity", "a speed", self.slip_velocity)?;
        let refused = |why: &str| {
            let wanted = format!("nothing {why}");
            Err(expected(&at("tangential_stiffness"), &wanted, "a number"))
        };
        match by {
            LoadPlace::Surface(_) => return refused("at a plate or shell, which does not stick"),
            LoadPlace::Line(_) => return refused("along a line, which does not stick"),
            _ => {}
        }
        let rotates = by.rigid().is_some_and(|rigid| rotates(rigid, dimension));
        if self.radius.is_some() && rotates {
            return refused("at a rigid body with a radius, which rolls");
        }
        positive(&at("tangential_stiffness"), "N/m", stiffness)?;
        let damping = self.tangential_damping.unwrap_or_default();
        not_negative(&at("tangential_damping"), "N.s/m", damping)?;
        check_static_ratio(path, self.static_ratio)
    }

    /// Unit of the stiffness at a place.
    fn unit(on: LoadExtent) -> Unit {
        match on {
            LoadExtent::Line => NEWTON_PER_SQUARE_METRE,
            LoadExtent::Surface => NEWTON_PER_CUBIC_METRE,
            _ => NEWTON_PER_METRE,
        }
    }
}

impl SceneLoad for ContactLoad {
    type Acting<'a> = ResolvedContact<'a>;

    const EXERTS: Exerts = Exerts::Force;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let at = |key: &str| format!("{path}.{key}");
        let by = match (&self.marker, &self.body) {
            (Some(_), Some(_)) => {
                return Err(expected(&at("body"), "nothing beside `marker`", "a name"));
            }
            (Some(marker), None) => LoadPlace::Marker(scene.require_marker(&at("marker"), marker)?),
            (None, body) => {
                let body = needed(path, "body", "a name", body.as_deref())?;
                scene.require_line_or_surface(&at("body"), body)?
            }
        };
        let surface_of = match &self.surface_of {
            None => None,
            Some(name) => Some(scene.require_owner(&at("surface_of"), name, &by)?),
        };
        (self.surface).validate(&at("surface"), scene.scene.dimension)?;
        not_negative(&at("radius"), "m", self.radius.unwrap_or_default())?;
        if self.radius.is_some()
            && by
                .rigid()
                .is_some_and(|rigid| is_thin(rigid, scene.scene.dimension))
        {
            let wanted = "nothing at a thin rod, whose rotation about itself is not known";
            return Err(expected(&at("radius"), wanted, "a number"));
        }
        let unit = Self::unit(by.extent()).text();
        positive(&at("stiffness"), &unit, self.stiffness)?;
        not_negative(&at("damping"), "s/m", self.damping.unwrap_or_default())?;
        let friction = self.friction.unwrap_or_default();
        not_negative(&at("friction"), "1", friction)?;
        if friction > 0.0 {
            needed(path, "slip_velocity", "a speed", self.slip_velocity)?;
        }
        if let Some(slip_velocity) = self.slip_velocity {
            needed(path, "friction", "a coefficient", self.friction)?;
            positive(&at("slip_velocity"), "m/s", slip_velocity)?;
        }
        self.check_sticking(path, &by, scene.scene.dimension)?;
        Ok(ResolvedContact {
            given: self,
            by,
            surface_of,
        })
    }

    fn numbers(&mut self, on: LoadExtent) -> Vec<LoadNumber<'_>> {
        let units = [Self::unit(on), SECOND_PER_METRE];
        let mut numbers = damper(
            units,
            Needed(&mut self.stiffness),
            Optional(&mut self.damping),
        );
        // Without a speed of slip there can be none.
        if self.slip_velocity.is_some() {
            let what = "Coefficient of friction";
            numbers.push(LoadNumber::new(
                "friction",
                what,
                None,
                Optional(&mut self.friction),
            ));
        }
        if self.tangential_stiffness.is_some() {
            let (stiffness, damping) = (
                Optional(&mut self.tangential_stiffness),
                Optional(&mut self.tangential_damping),
            );
            numbers.extend([
                LoadNumber::new(
                    "tangential_stiffness",
                    "Stiffness along the surface",
                    Some(NEWTON_PER_METRE),
                    stiffness,
                ),
                LoadNumber::new(
                    "tangential_damping",
                    "Damping along the surface",
                    Some(NEWTON_SECOND_PER_METRE),
                    damping,
                ),
            ]);
        }
        numbers
    }
}

impl<'a> ActingLoad<'a> for ResolvedContact<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.by
    }

    fn bodies(&self) -> Vec<usize> {
        let owner = self.surface_of.iter().map(|rigid| rigid.id.index());
        self.by.bodies().into_iter().chain(owner).collect()
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.given.stiffness, 0.0]
    }

    fn is_one_sided(&self) -> bool {
        true
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let places = match self.by {
            LoadPlace::Surface(plate) => {
                return Ok(AppliedLoad::SurfaceContact(Box::new(SurfaceContact {
                    on: builder.surface(plate),
                    law: self.given.law(surface(&self.given.surface)),
                })));
            }
            LoadPlace::Line(cable) => builder.places(cable),
            on => { on.markers().into_iter() }
                .map(|marker| ContactPoint {
                    marker: builder.marker(marker),
                    weight: 1.0,
                })
                .collect(),
        };
        let owner = self.surface_of;
        let kept = self.given.tangential_stiffness.map(|_| {
            let drives = &mut builder.parts.drives;
            let first = drives.len();
            drives.extend(std::iter::repeat_n(Drive::Kept, Contact::<D>::KEPT));
            first
        });
        Ok(AppliedLoad::Contact(Box::new(Contact {
            law: self.given.law(match owner {
                Some(rigid) => builder.surface_of(rigid, &self.given.surface),
                None => surface(&self.given.surface),
            }),
            surface_frame: owner.map(|rigid| RigidFrame::of(&builder.point(rigid, [0.0; 3]))),
            rolling: self.rolling::<D>(&places),
            kept,
            places,
        })))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        let unit = match self.by {
            LoadPlace::Line(_) => "N/m per length",
            LoadPlace::Surface(_) => "N/m per area",
            _ => "N/m",
        };
        let vector = |of: &SceneVector| words::vector(dimension, of.full());
        let surface = match &self.given.surface {
            Surface::Plane { point, normal } => {
                format!("through {}, normal {}", vector(point), vector(normal))
            }
            Surface::Circle { center, radius } | Surface::Sphere { center, radius } => {
                format!("of radius {} m about {}", number(*radius), vector(center))
            }
            Surface::Cylinder {
                point,
                axis,
                radius,
            } => format!(
                "of radius {} m about the axis through {} along {}",
                number(*radius),
                vector(point),
                vector(axis)
            ),
        };
        let sizes = [
            Some(self.given.stiffness),
            self.given.damping,
            self.given.friction,
        ];
        let [k, a, friction] = sizes.map(|size| number(size.unwrap_or_default()));
        let owner = self.surface_of.map_or(String::new(), |rigid| {
            format!(" of {}", words::code(&rigid.body.name))
        });
        let radius = self.given.radius.map_or(String::new(), |radius| {
            format!(", touches at {} m", number(radius))
        });
        let friction = self.given.slip_velocity.map_or(String::new(), |speed| {
            format!(", friction {friction}, smooth below {} m/s", number(speed))
        });
        let sticks = self.given.tangential_stiffness.map(|stiffness| {
            let largest = words::given(", at most", self.given.static_ratio, "times that friction");
            format!(
                ", sticks with {} {unit} along the surface{largest}",
                number(stiffness)
            )
        });
        let sticks = sticks.unwrap_or_default();
        LoadWords {
            kind: format!("contact with a {}{owner}", self.given.surface.name()),
            on: words::code(self.by.name()),
            size: format!("{surface}{radius}; {k} {unit}, {a} s/m{friction}{sticks}"),
        }
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// Surface that the load is a contact with, and the rigid body that it belongs to; none of the ground.
    pub fn surface(&self) -> Option<(&'a Surface, Option<Rigid<'a>>)> {
        match self {
            Self::Contact(contact) => Some((&contact.given.surface, contact.surface_of)),
            _ => None,
        }
    }
}

impl<'a> LoadPlace<'a> {
    /// The rigid body of a marker.
    fn rigid(&self) -> Option<Rigid<'a>> {
        match self {
            Self::Marker(marker) => match marker.place {
                Place::Point(rigid, _) => Some(rigid),
                _ => None,
            },
            _ => None,
        }
    }
}

/// Whether a rigid body of space has inertia, but none about an axis.
fn is_thin(rigid: Rigid<'_>, dimension: usize) -> bool {
    dimension == 3 && rigid.body.inertia().thin().is_some()
}

/// Whether a rigid body has inertia about every axis about which it can rotate.
fn rotates(rigid: Rigid<'_>, dimension: usize) -> bool {
    rigid.body.inertia().is_some() && !is_thin(rigid, dimension)
}

impl ResolvedContact<'_> {
    /// Frame of the rigid body that touches with a radius.
    fn rolling<const D: usize>(&self, places: &[ContactPoint]) -> Option<RigidFrame> {
        let rolls =
            self.given.radius.is_some() && self.by.rigid().is_some_and(|rigid| rotates(rigid, D));
        rolls.then(|| RigidFrame::of(&places[0].marker))
    }
}

impl<'a> Resolved<'a> {
    /// Finds the rigid body that a surface belongs to, which another body touches.
    ///
    /// # Errors
    /// There is no such rigid body, it lacks inertia about an axis or touches itself, or it is touched by a plate or shell.
    fn require_owner(&self, path: &str, name: &str, by: &LoadPlace<'a>) -> Found<Rigid<'a>> {
        let rigid = |body: &BodyReference<'a>| match body {
            BodyReference::Rigid(rigid) if rotates(*rigid, self.scene.dimension) => Some(*rigid),
            _ => None,
        };
        let Some(found) = self.bodies_by_name.get(name).and_then(rigid) else {
            let known = self.bodies.iter().filter_map(rigid);
            let known = known.map(|rigid| &*rigid.body.name);
            let wanted = "the name of a rigid body with a moment of inertia about every axis";
            return Err(unknown(path, wanted, name, known));
        };
        if let LoadPlace::Surface(_) = by {
            let wanted = "nothing beside a plate or shell, which touches surfaces of the ground";
            return Err(expected(path, wanted, quoted(name)));
        }
        if by.bodies().contains(&found.id.index()) {
            let wanted = "the name of another body than the one that touches";
            return Err(expected(path, wanted, quoted(name)));
        }
        Ok(found)
    }
}

impl Surface {
    fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let kind = format!("{path}.{}", self.name());
        let at = |key: &str| format!("{kind}.{key}");
        let fits = match self {
            Self::Plane { .. } => true,
            Self::Circle { .. } => dimension == 2,
            Self::Sphere { .. } | Self::Cylinder { .. } => dimension == 3,
        };
        if !fits {
            let wanted = match dimension {
                2 => "plane or circle in the plane",
                _ => "plane, sphere or cylinder in space",
            };
            return Err(expected(path, wanted, self.name()));
        }
        match self {
            Self::Plane { point, normal } => {
                checks::vector(&at("point"), dimension, point)?;
                direction(&at("normal"), dimension, normal)
            }
            Self::Circle { center, radius } | Self::Sphere { center, radius } => {
                checks::vector(&at("center"), dimension, center)?;
                positive(&at("radius"), "m", *radius)
            }
            Self::Cylinder {
                point,
                axis,
                radius,
            } => {
                checks::vector(&at("point"), dimension, point)?;
                direction(&at("axis"), dimension, axis)?;
                positive(&at("radius"), "m", *radius)
            }
        }
    }
}

impl<const D: usize> Builder<'_, D> {
    /// A surface in the frame of a rigid body, in the one that the system keeps of it.
    fn surface_of(&self, rigid: Rigid<'_>, of: &Surface) -> ContactSurface<D> {
        let given = surface(of);
        if D == 2 {
            return given;
        }
        let solid = self.resolved.solid(rigid);
        given.map(
            |point| vector(solid.along(components(point))),
            |direction| vector(solid.directed(components(direction))),
        )
    }

    /// The Gauss points of the elements of a cable, or of even parts of one that does not bend.
    fn places(&self, cable: Cable<'_>) -> Vec<ContactPoint> {
        let body = cable.id.body;
        match cable.id.form {
            Form::Chain(chain) => {
                let chain = &self.parts.bodies.lines()[chain];
                let elements = chain.elements().iter().enumerate();
                let places = elements.flat_map(|(j, element)| {
                    GAUSS_5.map(|point| ContactPoint {
                        marker: Marker::within(body, chain, j, point.at),
                        weight: point.weight * element.length(),
                    })
                });
                places.collect()
            }
            Form::Rod(rod) => {
                let RigidRod { node, length, .. } = self.parts.bodies.rods()[rod];
                let part = length / PANELS as f64;
                let places = (0..PANELS).flat_map(|panel| {
                    GAUSS_5.map(|point| {
                        let arm = (panel as f64 + point.at) * part - 0.5 * length;
                        ContactPoint {
                            marker: Marker::rigid(body, node, [arm, 0.0]),
                            weight: point.weight * part,
                        }
                    })
                });
                places.collect()
            }
            Form::Modal => unreachable!("{}", line::NOT_ALONG_MODES),
        }
    }
}

fn surface<const D: usize>(of: &Surface) -> ContactSurface<D> {
    match of {
        Surface::Plane { point, normal } => ContactSurface::Plane {
            point: vector(point.full()),
            normal: unit(normal.full()),
        },
        Surface::Circle { center, radius } | Surface::Sphere { center, radius } => {
            ContactSurface::Round {
                center: vector(center.full()),
                axis: None,
                radius: *radius,
            }
        }
        Surface::Cylinder {
            point,
            axis,
            radius,
        } => ContactSurface::Round {
            center: vector(point.full()),
            axis: Some(unit(axis.full())),
            radius: *radius,
        },
    }
}
