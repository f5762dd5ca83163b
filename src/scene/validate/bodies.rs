//! Checks of bodies and masses.

use std::collections::BTreeSet;

use super::ELEMENTS;
use super::checks::{expected, finite, name, not_negative, positive, quoted, vector};
use crate::math::expression::Expression;
use crate::scene::resolved::{Mass, Place, Resolved};
use crate::scene::{Body, CableBody, Error, InitialMotion, RigidBody, Shape};

impl Body {
    pub(super) fn validate(&self, path: &str) -> Result<(), Error> {
        match self {
            Self::Cable(body) => body.validate(path),
            Self::Rigid(body) => body.validate(path),
        }?;
        self.motion().validate(&format!("{path}.motion"))?;
        let mut names = BTreeSet::new();
        for marker in self.marker_names() {
            name(&format!("{path}.markers.{marker}"), marker, &mut names)?;
        }
        Ok(())
    }
}

impl InitialMotion {
    fn validate(&self, path: &str) -> Result<(), Error> {
        vector(&format!("{path}.velocity"), self.velocity)?;
        finite(&format!("{path}.spin"), self.spin)?;
        for (k, text) in self.deformation.iter().flatten().enumerate() {
            let place = format!("{path}.deformation[{k}]");
            let field = Expression::of(text, "s").map_err(|error| Error::new(&place, error))?;
            for s in [0.0, 0.5, 1.0] {
                let values = field.derivatives(s);
                if let Some(found) = values[..2].iter().find(|value| !value.is_finite()) {
                    let wanted = format!("a finite velocity and slope at s = {s}");
                    return Err(expected(&place, &wanted, found));
                }
            }
        }
        Ok(())
    }
}

impl CableBody {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let (material, section) = (&self.material, &self.section);
        let at = |key: &str| format!("{path}.{key}");
        if !ELEMENTS.contains(&self.elements) {
            let wanted = format!("an integer from {} to {}", ELEMENTS.start(), ELEMENTS.end());
            return Err(expected(&at("elements"), &wanted, self.elements));
        }
        positive(
            &at("material.youngs_modulus"),
            "Pa",
            material.youngs_modulus,
        )?;
        positive(&at("material.density"), "kg/m^3", material.density)?;
        not_negative(&at("material.damping_time"), "s", material.damping_time)?;
        positive(&at("section.area"), "m^2", section.area)?;
        not_negative(&at("section.second_moment"), "m^4", section.second_moment)?;
        self.shape.validate(&at("shape"))?;
        for (marker, coordinate) in &self.markers {
            if !(0.0..=1.0).contains(coordinate) {
                let place = at(&format!("markers.{marker}"));
                return Err(expected(&place, "a number from 0 to 1", coordinate));
            }
        }
        Ok(())
    }
}

impl RigidBody {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        positive(&at("mass"), "kg", self.mass)?;
        not_negative(&at("inertia"), "kg m^2", self.inertia)?;
        vector(&at("position"), self.position)?;
        finite(&at("angle"), self.angle)?;
        for (marker, point) in &self.markers {
            let place = at(&format!("markers.{marker}"));
            vector(&place, *point)?;
            if self.inertia == 0.0 && *point != [0.0; 2] {
                let wanted = "[0, 0] in a body without inertia, which does not turn";
                return Err(expected(&place, wanted, format!("{point:?}")));
            }
        }
        if self.motion.deformation.is_some() {
            return Err(expected(
                &at("motion.deformation"),
                "none of a rigid body",
                "one",
            ));
        }
        if self.inertia == 0.0 && self.motion.spin != 0.0 {
            let wanted = "0 in a body without inertia, which does not turn";
            return Err(expected(&at("motion.spin"), wanted, self.motion.spin));
        }
        Ok(())
    }
}

impl Shape {
    fn validate(&self, path: &str) -> Result<(), Error> {
        let kind = if self.is_straight() { "line" } else { "arc" };
        let (Self::Line { from, to } | Self::Arc { from, to, .. }) = self;
        vector(&format!("{path}.{kind}.from"), *from)?;
        vector(&format!("{path}.{kind}.to"), *to)?;
        let distance = (to[0] - from[0]).hypot(to[1] - from[1]);
        if distance <= 0.0 {
            let wanted = "two ends that differ";
            return Err(expected(path, wanted, "the same point twice"));
        }
        if let Self::Arc { length, .. } = self {
            let place = format!("{path}.arc.length");
            finite(&place, *length)?;
            if *length <= distance {
                let wanted = format!("more than the distance between the ends ({distance} m)");
                return Err(expected(&place, &wanted, length));
            }
        }
        Ok(())
    }
}

impl Resolved<'_> {
    pub(super) fn resolve_masses(&mut self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, mass) in self.scene.masses.iter().enumerate() {
            let path = format!("masses[{index}]");
            let at = |key: &str| format!("{path}.{key}");
            let marker = self.require_marker(&at("marker"), &mass.marker)?;
            if !seen.insert(&mass.marker) {
                let wanted = "a marker without a mass so far";
                return Err(expected(&at("marker"), wanted, quoted(&mass.marker)));
            }
            not_negative(&at("mass"), "kg", mass.mass)?;
            not_negative(&at("inertia"), "kg m^2", mass.inertia)?;
            if mass.inertia > 0.0 && matches!(marker.place, Place::Point(..)) {
                let wanted = "0 at a marker of a rigid body, which has its own inertia";
                return Err(expected(&at("inertia"), wanted, mass.inertia));
            }
            if mass.mass + mass.inertia <= 0.0 {
                return Err(expected(&at("mass"), "a positive number (kg)", mass.mass));
            }
            let (mass, inertia) = (mass.mass, mass.inertia);
            self.masses.push(Mass {
                marker,
                mass,
                inertia,
            });
        }
        Ok(())
    }
}
