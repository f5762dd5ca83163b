//! Checks of bodies and masses.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use super::checks::{
    components, expected, finite, name, needed, not_negative, planar, positive, quoted, spin,
    vector,
};
use super::{ELEMENTS, LINE_MODES};
use crate::math::expression::Expression;
use crate::scene::description::{ALONG_LINE, OVER_SURFACE};
use crate::scene::resolved::{Place, Resolved, ResolvedMass};
use crate::scene::{
    Body, Error, Inertia, InitialMotion, LineBody, Model, Orientation, RigidBody, SceneVector,
    Solid,
};

impl Body {
    /// Checks a body on its own, without references to other parts.
    ///
    /// # Errors
    /// The first key that is missing, of another kind of body, or out of range.
    pub(super) fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) => {
                body.validate_sections(path, dimension)?;
                body.validate(path, dimension)
            }
            Self::Auto(body) => {
                body.validate_spare(path)?;
                return body
                    .made(body.sections, dimension)
                    .validate(path, dimension);
            }
            Self::Rigid(body) => body.validate(path, dimension),
            Self::Reduced(body) => body.validate(path, dimension),
            Self::Plate(body) => body.validate(path, dimension, true),
            Self::Shell(body) => body.validate(path, dimension, false),
        }?;
        let coordinates = match self {
            Self::Plate(_) | Self::Shell(_) => &OVER_SURFACE[..],
            _ => ALONG_LINE,
        };
        let motion = format!("{path}.motion");
        self.motion().validate(&motion, dimension, coordinates)?;
        let mut names = BTreeSet::new();
        for marker in self.marker_names() {
            name(&format!("{path}.markers.{marker}"), marker, &mut names)?;
        }
        Ok(())
    }
}

impl InitialMotion {
    /// Checks it for a body with these coordinates in expressions.
    fn validate(
        &self,
        path: &str,
        dimension: usize,
        coordinates: &[&'static str],
    ) -> Result<(), Error> {
        vector(&format!("{path}.velocity"), dimension, &self.velocity)?;
        spin(&format!("{path}.spin"), dimension, &self.spin)?;
        let place = format!("{path}.deformation");
        if let Some(field) = &self.deformation {
            components(&place, dimension, field, |_, _| Ok(()))?;
        }
        for (k, text) in self.deformation.iter().flatten().enumerate() {
            let place = format!("{place}[{k}]");
            if coordinates == OVER_SURFACE {
                check_surface_field(&place, text)?;
                continue;
            }
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

/// Checks a component of a velocity of deformation of a plate or shell in its middle and at its edges.
fn check_surface_field(place: &str, text: &str) -> Result<(), Error> {
    let along = [0.0, 0.5, 1.0];
    for at in along.iter().flat_map(|u| along.map(|v| [*u, v])) {
        let rates = Expression::of_two(text, OVER_SURFACE, at);
        let rates = rates.map_err(|error| Error::new(place, error))?;
        if let Some(found) = rates.iter().find(|rate| !rate.is_finite()) {
            let [u, v] = at;
            let wanted =
                format!("a finite velocity and finite derivatives at [s1, s2] = [{u}, {v}]");
            return Err(expected(place, &wanted, found));
        }
    }
    Ok(())
}

impl LineBody {
    fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let material = &self.material;
        let at = |key: &str| format!("{path}.{key}");
        if let Some(count) = self.elements
            && !ELEMENTS.contains(&count)
        {
            let wanted = format!("an integer from {} to {}", ELEMENTS.start(), ELEMENTS.end());
            return Err(expected(&at("elements"), &wanted, count));
        }
        self.validate_material(path)?;
        not_negative(&at("material.damping_time"), "s", material.damping_time)?;
        if let Some(ratio) = material.damping_ratio {
            let place = at("material.damping_ratio");
            not_negative(&place, "1", ratio)?;
            if material.damping_time > 0.0 {
                return Err(expected(&place, "nothing beside a `damping_time`", ratio));
            }
        }
        self.shape.validate(&at("shape"), dimension)?;
        self.validate_model(&at("model"), dimension)?;
        self.validate_modes(&at("modes"))?;
        let found = self.section_at(0.5).second_moments[0];
        if !self.shape.is_straight() && !self.is_rod() && found > 0.0 {
            let place = at("section.second_moment");
            planar(
                &place,
                dimension,
                "0 of a cable that is curved without stress, which has no frame to be curved in,",
                &found.to_string(),
            )?;
        }
        for (marker, coordinate) in &self.markers {
            if !(0.0..=1.0).contains(coordinate) {
                let place = at(&format!("markers.{marker}"));
                return Err(expected(&place, "a number from 0 to 1", coordinate));
            }
        }
        Ok(())
    }

    /// Moduli and density, but where the section has them.
    fn validate_material(&self, path: &str) -> Result<(), Error> {
        let material = &self.material;
        let values = [
            (
                "material.youngs_modulus",
                "Pa",
                material.youngs_modulus,
                true,
            ),
            ("material.density", "kg/m^3", material.density, true),
            (
                "material.shear_modulus",
                "Pa",
                material.shear_modulus,
                self.is_rod(),
            ),
        ];
        for (key, unit, value, is_needed) in values {
            let place = format!("{path}.{key}");
            if self.is_given() {
                if value.is_some() {
                    let wanted = "nothing beside `stiffness` and `inertia` of the section";
                    return Err(expected(&place, wanted, "a value"));
                }
            } else if is_needed {
                positive(&place, unit, needed(path, key, "a value", value)?)?;
            }
        }
        Ok(())
    }

    /// A rigid rod is a body of the plane; one of modes has axes in space, and bends. Both are straight and undeformed.
    fn validate_model(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let wanted = "\"auto\" or \"flexible\"";
        let model = match self.model {
            Model::Auto | Model::Flexible => return Ok(()),
            Model::Rigid => "\"rigid\"",
            Model::Modal => "\"modal\"",
        };
        let line = if self.model == Model::Rigid {
            "cable"
        } else {
            "line"
        };
        if self.model == Model::Rigid {
            planar(path, dimension, wanted, model)?;
        } else if !self.is_rod() && dimension == 2 {
            if self.bending_stiffness() <= 0.0 {
                let wanted = format!("{wanted} of a cable that does not resist bending");
                return Err(expected(path, &wanted, model));
            }
        } else if !self.is_rod() {
            let wanted = format!("{wanted} of a cable, which has no axes (a rod or a beam does)");
            return Err(expected(path, &wanted, model));
        }
        if !self.shape.is_straight() {
            let wanted = format!("{wanted} of a {line} that is curved without stress");
            return Err(expected(path, &wanted, model));
        }
        if self.model == Model::Modal && self.stations.iter().any(|station| station.twist != 0.0) {
            let wanted = format!("{wanted} of a line that is twisted without stress");
            return Err(expected(path, &wanted, model));
        }
        if self.motion.deformation.is_some() {
            let wanted = format!("{wanted} of a {line} that deforms at the start");
            return Err(expected(path, &wanted, model));
        }
        Ok(())
    }

    /// Modes belong to model `modal`, which needs them.
    fn validate_modes(&self, path: &str) -> Result<(), Error> {
        let wanted = format!(
            "an integer from {} to {}",
            LINE_MODES.start(),
            LINE_MODES.end()
        );
        match (self.model, self.modes) {
            (Model::Modal, None) => Err(expected(path, &wanted, "nothing")),
            (Model::Modal, Some(modes)) if !LINE_MODES.contains(&modes) => {
                Err(expected(path, &wanted, modes))
            }
            (Model::Auto | Model::Flexible | Model::Rigid, Some(modes)) => {
                Err(expected(path, "nothing but with model \"modal\"", modes))
            }
            _ => Ok(()),
        }
    }
}

impl RigidBody {
    fn validate(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        self.validate_substance(path, dimension)?;
        vector(&at("position"), dimension, &self.position)?;
        finite(&at("angle"), self.angle)?;
        if self.angle != 0.0 {
            let instead = "0 beside `orientation`, which says how a body stands,";
            planar(&at("angle"), dimension, instead, &self.angle.to_string())?;
        }
        self.validate_orientation(&at("orientation"), dimension)?;
        for (marker, point) in &self.markers {
            let place = at(&format!("markers.{marker}"));
            vector(&place, dimension, point)?;
            if !self.inertia().is_some() && point.full() != [0.0; 3] {
                let wanted = match dimension {
                    2 => "[0, 0] in a body without inertia, which does not rotate",
                    _ => "[0, 0, 0] in a body without inertia, which does not rotate",
                };
                return Err(expected(&place, wanted, format!("{:?}", point.given())));
            }
            self.validate_thin(&place, dimension, point)?;
        }
        if self.motion.deformation.is_some() {
            return Err(expected(
                &at("motion.deformation"),
                "none of a rigid body",
                "one",
            ));
        }
        let spin = self.motion.spin.full();
        if !self.inertia().is_some() && spin != [0.0; 3] {
            let wanted = "0 in a body without inertia, which does not rotate";
            let found = match dimension {
                2 => spin[2].to_string(),
                _ => format!("{spin:?}"),
            };
            return Err(expected(&at("motion.spin"), wanted, found));
        }
        Ok(())
    }
}

impl RigidBody {
    /// Mass and inertia, with or without a shape that is drawn; or a shape and its density.
    fn validate_substance(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let at = |key: &str| format!("{path}.{key}");
        if let Some(shape) = &self.shape {
            shape.validate(&at("shape"))?;
        }
        let Some(density) = self.density else {
            if self.shape.is_some() && self.mass.is_none() {
                let wanted = "a positive number (kg/m^3) beside `shape`, or `mass` instead";
                return Err(expected(&at("density"), wanted, "nothing"));
            }
            let what = "a positive number (kg), or `shape` and `density`";
            let mass = needed(path, "mass", what, self.mass)?;
            positive(&at("mass"), "kg", mass)?;
            return self.validate_inertia(&at("inertia"), dimension);
        };
        if self.shape.is_none() {
            let wanted = "`shape` beside `density`, or `mass` instead of both";
            return Err(expected(&at("shape"), wanted, "nothing"));
        }
        let said = [
            ("mass", self.mass.is_some()),
            ("inertia", self.inertia.is_some()),
        ];
        if let Some((key, _)) = said.into_iter().find(|(_, is_said)| *is_said) {
            let wanted = "nothing beside `shape` and `density`, from which it follows";
            return Err(expected(&at(key), wanted, "a value"));
        }
        positive(&at("density"), "kg/m^3", density)?;
        let mass = self.mass();
        if !mass.is_normal()
            || !self
                .inertia()
                .tensor()
                .iter()
                .all(|entry| entry.is_finite())
        {
            let wanted =
                "a shape and a density whose mass (kg) and inertia are numbers of the machine";
            return Err(expected(&at("shape"), wanted, mass));
        }
        Ok(())
    }

    /// A number in the plane; moments that a body can have in space.
    fn validate_inertia(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let (shown, is_number) = match self.inertia() {
            Inertia::Number(number) => {
                not_negative(path, "kg m^2", number)?;
                (number.to_string(), true)
            }
            Inertia::Moments(moments) => (format!("{moments:?}"), false),
            Inertia::Tensor(rows) => (format!("{rows:?}"), false),
        };
        match (dimension, is_number) {
            (2, true) => return Ok(()),
            (2, false) => return Err(expected(path, "a number in the plane", shown)),
            (_, true) if !self.inertia().is_some() => return Ok(()),
            (_, true) => {
                let wanted =
                    "three moments of inertia or a tensor of a body in space (0 of a particle)";
                return Err(expected(path, wanted, shown));
            }
            (_, false) => {}
        }
        let tensor = self.inertia().tensor();
        if tensor.iter().any(|entry| !entry.is_finite()) {
            return Err(expected(path, "finite numbers", shown));
        }
        let largest = tensor.amax();
        if (tensor - tensor.transpose()).amax() > 1e-9 * largest {
            return Err(expected(path, "a symmetric tensor", shown));
        }
        let mut moments = self.inertia().principal().0;
        moments.sort_by(f64::total_cmp);
        let [a, b, c] = moments;
        if b <= 0.0 || a < -1e-9 * c {
            let wanted = "moments of inertia that are positive, one of them 0 at most (a thin rod)";
            return Err(expected(
                path,
                wanted,
                format!("the principal moments {moments:?}"),
            ));
        }
        if c > (a + b) * (1.0 + 1e-9) {
            let wanted = "moments of inertia of which none is more than the sum of the other two";
            return Err(expected(
                path,
                wanted,
                format!("the principal moments {moments:?}"),
            ));
        }
        Ok(())
    }

    /// In space a thin rod has no points beside its axis: nothing says how they rotate about it.
    fn validate_thin(
        &self,
        place: &str,
        dimension: usize,
        point: &SceneVector,
    ) -> Result<(), Error> {
        let Some(axis) = self.inertia().thin().filter(|_| dimension == 3) else {
            return Ok(());
        };
        let point = Vector3::from(point.full());
        if axis.cross(&point).norm() > 1e-9 * point.norm() {
            let wanted =
                "a point on the axis of a thin rod, about which it has no moment of inertia";
            return Err(expected(place, wanted, format!("{:?}", point.as_slice())));
        }
        Ok(())
    }

    fn validate_orientation(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let Some(orientation) = &self.orientation else {
            return Ok(());
        };
        if dimension == 2 {
            return Err(expected(
                path,
                "nothing beside `angle` in the plane",
                "an orientation",
            ));
        }
        if !self.inertia().is_some() {
            let wanted = "nothing of a body without inertia, which does not rotate";
            return Err(expected(path, wanted, "an orientation"));
        }
        orientation.validate(path)
    }
}

impl Orientation {
    /// Checks the numbers of an orientation.
    ///
    /// # Errors
    /// Numbers that are not finite, or none of an orientation.
    pub(super) fn validate(&self, path: &str) -> Result<(), Error> {
        let numbers = self.numbers();
        match self.axes() {
            Some(_) if numbers.iter().all(|number| number.is_finite()) => Ok(()),
            _ => {
                let wanted = "finite numbers, of a matrix orthonormal right-handed axes, of a quaternion not all zero";
                Err(expected(path, wanted, format!("{numbers:?}")))
            }
        }
    }
}

impl Solid {
    fn validate(mut self, path: &str) -> Result<(), Error> {
        let path = format!("{path}.{}", self.key());
        for (key, place, length) in self.lengths() {
            let place = place.map(|k| format!("[{k}]")).unwrap_or_default();
            positive(&format!("{path}.{key}{place}"), "m", *length)?;
        }
        if let Self::Tube {
            radius,
            inner_radius,
            ..
        } = self
            && inner_radius >= radius
        {
            let wanted = format!("less than the outer radius ({radius} m)");
            let place = format!("{path}.inner_radius");
            return Err(expected(&place, &wanted, inner_radius));
        }
        if let Some(axis) = self.axis() {
            let norm = Vector3::from(axis).norm();
            if !norm.is_normal() {
                let (place, found) = (format!("{path}.axis"), format!("{axis:?}"));
                let wanted = "three finite numbers, not all zero";
                return Err(expected(&place, wanted, found));
            }
        }
        Ok(())
    }
}

impl Resolved<'_> {
    /// Resolves the masses at markers.
    ///
    /// # Errors
    /// A marker that does not exist, a second mass at a marker, or a mass or inertia out of range.
    pub(super) fn resolve_masses(&mut self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, mass) in self.scene.masses.iter().enumerate() {
            let path = format!("masses[{index}]");
            let at = |key: &str| format!("{path}.{key}");
            let marker = self.require_marker(&at("marker"), &mass.marker)?;
            let is_reduced = match marker.place {
                Place::Patch(..) => {
                    let wanted =
                        "a marker of another body than a plate or shell; weld a rigid body there";
                    return Err(expected(&at("marker"), wanted, quoted(&mass.marker)));
                }
                Place::Interface(..) => true,
                Place::Along(cable, _) => cable.is_modal(),
                Place::Point(..) => false,
            };
            if is_reduced {
                let wanted = "a marker of another body than a reduced one, whose modes have their mass; \
                              weld a rigid body there";
                return Err(expected(&at("marker"), wanted, quoted(&mass.marker)));
            }
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
            if mass.inertia > 0.0 {
                let (dimension, found) = (self.scene.dimension, mass.inertia.to_string());
                planar(&at("inertia"), dimension, "0", &found)?;
            }
            if mass.mass + mass.inertia <= 0.0 {
                return Err(expected(&at("mass"), "a positive number (kg)", mass.mass));
            }
            let (mass, inertia) = (mass.mass, mass.inertia);
            self.masses.push(ResolvedMass {
                marker,
                mass,
                inertia,
            });
        }
        Ok(())
    }
}
