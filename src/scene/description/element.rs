//! Bodies by their element: how they are read, what all have, and what a line becomes as an element of a kind.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::body::{Body, InitialMotion, LineBody, LineModel, RigidBody};
use super::patch::PatchBody;
use super::reduced::FileBody;
use super::section::Section;
use super::strict::{Strict, at, typed};

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wrong = |found: &str| {
            let message = format!(
                "expected \"cable\", \"rod\", \"beam\", \"auto\", \"rigid\", \"reduced\", \"plate\" or \"shell\", found {found}"
            );
            D::Error::custom(at("element", &message))
        };
        let mut value = Strict::deserialize(deserializer)?.0;
        let Some(keys) = value.as_object_mut() else {
            return Err(D::Error::custom(format!(
                "expected a body {{ ... }}, found {value}"
            )));
        };
        let element = keys.remove("element").ok_or_else(|| wrong("nothing"))?;
        match element.as_str() {
            Some("cable") => typed(value).map(Self::Cable),
            Some("rod") => with_sections(value, LineModel::Kirchhoff).map(Self::Rod),
            Some("beam") => with_sections(value, LineModel::Reissner).map(Self::Beam),
            Some("auto") => typed(value).map(Self::Auto),
            Some("rigid") => typed(value).map(Self::Rigid),
            Some("reduced") => typed(value).map(Self::Reduced),
            Some("plate") => typed(value).map(Self::Plate),
            Some("shell") => typed(value).map(Self::Shell),
            _ => Err(wrong(&element.to_string())),
        }
    }
}

fn with_sections<E: serde::de::Error>(value: Value, sections: LineModel) -> Result<LineBody, E> {
    let body: LineBody = typed(value)?;
    Ok(LineBody { sections, ..body })
}

impl Body {
    /// Name of the body.
    pub fn name(&self) -> &str {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => &body.name,
            Self::Rigid(body) => &body.name,
            Self::Reduced(body) => &body.name,
            Self::Plate(body) | Self::Shell(body) => &body.name,
        }
    }

    /// Motion at the start.
    pub fn motion(&self) -> &InitialMotion {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => {
                &body.motion
            }
            Self::Rigid(body) => &body.motion,
            Self::Reduced(body) => &body.motion,
            Self::Plate(body) | Self::Shell(body) => &body.motion,
        }
    }

    /// Motion at the start, to be changed.
    pub fn motion_mut(&mut self) -> &mut InitialMotion {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => {
                &mut body.motion
            }
            Self::Rigid(body) => &mut body.motion,
            Self::Reduced(body) => &mut body.motion,
            Self::Plate(body) | Self::Shell(body) => &mut body.motion,
        }
    }

    /// Names of its markers, in alphabetical order.
    pub fn marker_names(&self) -> Vec<&str> {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => {
                body.markers.keys().map(String::as_str).collect()
            }
            Self::Rigid(body) => body.markers.keys().map(String::as_str).collect(),
            Self::Reduced(body) => body.markers.keys().map(String::as_str).collect(),
            Self::Plate(body) | Self::Shell(body) => {
                body.markers.keys().map(String::as_str).collect()
            }
        }
    }

    /// The body if it is a cable or a rod, rigid or not.
    pub fn cable(&self) -> Option<&LineBody> {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => Some(body),
            _ => None,
        }
    }

    /// The body if it is a cable of elements that bend.
    pub fn flexible(&self) -> Option<&LineBody> {
        self.cable().filter(|cable| cable.model.has_elements())
    }

    /// The body, to be changed, if it is a cable or a rod.
    pub fn cable_mut(&mut self) -> Option<&mut LineBody> {
        match self {
            Self::Cable(body) | Self::Rod(body) | Self::Beam(body) | Self::Auto(body) => Some(body),
            _ => None,
        }
    }

    /// The body if it is one of kind `rigid`.
    pub fn rigid(&self) -> Option<&RigidBody> {
        match self {
            Self::Rigid(body) => Some(body),
            _ => None,
        }
    }

    /// The body, to be changed, if it is one of kind `rigid`.
    pub fn rigid_mut(&mut self) -> Option<&mut RigidBody> {
        match self {
            Self::Rigid(body) => Some(body),
            _ => None,
        }
    }

    /// The body if it is one of kind `reduced`.
    pub fn reduced(&self) -> Option<&FileBody> {
        match self {
            Self::Reduced(body) => Some(body),
            _ => None,
        }
    }

    /// The body, to be changed, if it is one of kind `reduced`.
    pub fn reduced_mut(&mut self) -> Option<&mut FileBody> {
        match self {
            Self::Reduced(body) => Some(body),
            _ => None,
        }
    }

    /// The body if it is a plate or a shell.
    pub fn patch(&self) -> Option<&PatchBody> {
        match self {
            Self::Plate(body) | Self::Shell(body) => Some(body),
            _ => None,
        }
    }

    /// The body, to be changed, if it is a plate or a shell.
    pub fn patch_mut(&mut self) -> Option<&mut PatchBody> {
        match self {
            Self::Plate(body) | Self::Shell(body) => Some(body),
            _ => None,
        }
    }
}

impl LineBody {
    /// The body as an element whose sections do this in so many dimensions, without what it has no use for.
    pub fn made(&self, sections: LineModel, dimension: usize) -> Body {
        let mut body = Self {
            sections,
            ..self.clone()
        };
        if sections == LineModel::Cable {
            body.material.shear_modulus = None;
        }
        body.sections_mut()
            .for_each(|of| of.make(sections, dimension));
        match sections {
            LineModel::Cable => Body::Cable(body),
            LineModel::Kirchhoff => Body::Rod(body),
            LineModel::Reissner => Body::Beam(body),
        }
    }

    /// Iterates over the cross section and those at stations.
    pub fn sections_mut(&mut self) -> impl Iterator<Item = &mut Section> {
        let at_stations = self.stations.iter_mut();
        let at_stations = at_stations.map(|station| &mut station.section);
        at_stations.chain([&mut self.section])
    }
}

impl Section {
    /// Leaves out what an element has no use for, and says second moments as it does.
    fn make(&mut self, sections: LineModel, dimension: usize) {
        let is_cable = sections == LineModel::Cable;
        let has_one_axis = is_cable || dimension == 2;
        match (has_one_axis, self.second_moment, self.second_moments) {
            (true, None, Some([first, _])) => {
                (self.second_moment, self.second_moments) = (Some(first), None);
            }
            (false, Some(moment), None) => {
                (self.second_moment, self.second_moments) = (None, Some([moment; 2]));
            }
            _ => (),
        }
        if has_one_axis && self.shape.is_none() {
            self.torsion_constant = None;
        }
        if sections != LineModel::Reissner {
            (self.shear_factors, self.shear_factor) = (None, None);
        }
    }
}
