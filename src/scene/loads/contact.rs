//! Contacts of markers and of bodies with surfaces of the ground.

use super::*;
use crate::bodies::PANELS;
use crate::bodies::{Marker, RigidRod};
use crate::elements::Element;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::vector;
use crate::scene::assemble::unit;
use crate::scene::description::Surface;
use crate::scene::validate::checks;
use crate::system::loads::{
    Contact, ContactLaw, ContactPoint, ContactSurface, OneSidedSpring, SurfaceContact,
};

/// Contact with a surface of the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-either" = [["marker"], ["body"]]))]
pub struct ContactLoad {
    /// Marker that touches the surface, `body.marker`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the cable, rod or beam whose line, or of the plate or shell whose middle surface touches the surface; the thickness of the
    /// body does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Stiffness `k` of the surface, N/m at a marker; N/m per reference length along a line, per reference area of a plate or shell.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping `a` in the normal force `k d (1 + a d')` at the depth `d` below the surface, s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Surface that is touched.
    pub surface: Surface,
    /// Coulomb's coefficient of friction `mu`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub friction: Option<f64>,
    /// With friction only: `w` in the friction `mu N v / sqrt(v^2 + w^2)` at the velocity `v` along the surface, m/s. A contact that
    /// would stick creeps at a fraction of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub slip_velocity: Option<f64>,
}

/// Contact with a surface of the ground.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedContact<'a> {
    /// As described.
    given: &'a ContactLoad,
    /// Marker, line body, plate or shell that touches the surface.
    by: LoadPlace<'a>,
}

impl ContactLoad {
    /// Law of the contact, in its number of dimensions.
    fn law<const D: usize>(&self) -> ContactLaw<D> {
        ContactLaw {
            surface: surface(&self.surface),
            spring: OneSidedSpring {
                stiffness: self.stiffness,
                damping: self.damping.unwrap_or_default(),
            },
            friction: self.friction.unwrap_or_default(),
            slip_velocity: self.slip_velocity.unwrap_or_default(),
        }
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
        (self.surface).validate(&at("surface"), scene.scene.dimension)?;
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
        Ok(ResolvedContact { given: self, by })
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
        numbers
    }
}

impl<'a> ActingLoad<'a> for ResolvedContact<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.by
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
                    law: self.given.law(),
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
        Ok(AppliedLoad::Contact(Box::new(Contact {
            places,
            law: self.given.law(),
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
        let friction = self.given.slip_velocity.map_or(String::new(), |speed| {
            format!(", friction {friction}, smooth below {} m/s", number(speed))
        });
        LoadWords {
            kind: format!("contact with a {}", self.given.surface.name()),
            on: words::code(self.by.name()),
            size: format!("{surface}; {k} {unit}, {a} s/m{friction}"),
        }
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// Surface of the ground that the load is a contact with.
    pub fn surface(&self) -> Option<&'a Surface> {
        match self {
            Self::Contact(contact) => Some(&contact.given.surface),
            _ => None,
        }
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
