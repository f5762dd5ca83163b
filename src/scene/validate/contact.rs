//! Checks of contacts.

use super::checks::{direction, expected, needed, not_negative, positive, vector};
use crate::scene::Error;
use crate::scene::description::{self, Surface};
use crate::scene::resolved::{ContactBody, Resolved, ResolvedContact};

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
                vector(&at("point"), dimension, point)?;
                direction(&at("normal"), dimension, normal)
            }
            Self::Circle { center, radius } | Self::Sphere { center, radius } => {
                vector(&at("center"), dimension, center)?;
                positive(&at("radius"), "m", *radius)
            }
            Self::Cylinder {
                point,
                axis,
                radius,
            } => {
                vector(&at("point"), dimension, point)?;
                direction(&at("axis"), dimension, axis)?;
                positive(&at("radius"), "m", *radius)
            }
        }
    }
}

impl<'a> Resolved<'a> {
    /// Resolves a contact: marker or body, surface and coefficients.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a coefficient or size out of range.
    pub(super) fn contact(
        &self,
        path: &str,
        load: &'a description::ContactLoad,
    ) -> Result<ResolvedContact<'a>, Error> {
        let at = |key: &str| format!("{path}.{key}");
        let by = match (&load.marker, &load.body) {
            (Some(_), Some(_)) => {
                return Err(expected(&at("body"), "nothing beside `marker`", "a name"));
            }
            (Some(marker), None) => {
                ContactBody::Marker(self.require_marker(&at("marker"), marker)?)
            }
            (None, body) => {
                let body = needed(path, "body", "a name", body.as_deref())?;
                ContactBody::Cable(self.require_cable(&at("body"), body)?)
            }
        };
        (load.surface).validate(&at("surface"), self.scene.dimension)?;
        let unit = match by {
            ContactBody::Marker(_) => "N/m",
            ContactBody::Cable(_) => "N/m^2",
        };
        positive(&at("stiffness"), unit, load.stiffness)?;
        let damping = load.damping.unwrap_or(0.0);
        not_negative(&at("damping"), "s/m", damping)?;
        let friction = load.friction.unwrap_or(0.0);
        not_negative(&at("friction"), "1", friction)?;
        if friction > 0.0 {
            needed(path, "slip_velocity", "a speed", load.slip_velocity)?;
        }
        if let Some(slip_velocity) = load.slip_velocity {
            needed(path, "friction", "a coefficient", load.friction)?;
            positive(&at("slip_velocity"), "m/s", slip_velocity)?;
        }
        Ok(ResolvedContact {
            by,
            surface: load.surface,
            sizes: [load.stiffness, damping],
            friction,
            slip_velocity: load.slip_velocity,
        })
    }
}
