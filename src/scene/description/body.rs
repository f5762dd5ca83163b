//! Bodies and masses.

use std::collections::BTreeMap;

use nalgebra::Matrix3;
use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::accuracy::elements;
use super::section::between;
use super::strict::{Strict, at, typed};
use super::{Inertia, Orientation, Section, SectionNumbers, Solid, Spin, Station, Vector};

/// A body; `element` says of which kind.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "element", rename_all = "snake_case")]
pub enum Body {
    /// Flexible, of ANCF cables: two nodes with position and slope; stretches and bends, does not
    /// shear. Where `model` says so, a rigid rod.
    Cable(CableBody),
    /// The same line with sections that turn about it: bends about two axes with their own stiffness, and twists; does not
    /// shear. In space.
    Rod(CableBody),
    /// Rigid.
    Rigid(RigidBody),
}

/// A body of cable elements, or a rigid rod where they need not bend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CableBody {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    #[serde(default, with = "elements")]
    #[schemars(with = "elements::InJson")]
    pub elements: Option<u32>,
    /// Whether it bends and stretches.
    #[serde(default)]
    pub model: Model,
    /// Material.
    pub material: Material,
    /// Cross section, where it is the same all along.
    #[serde(default, skip_serializing_if = "Section::is_unsaid")]
    pub section: Section,
    /// Cross sections that change along the body, from its first end to its last; instead of `section`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stations: Vec<Station>,
    /// Strain measure.
    #[serde(default)]
    pub strain: Strain,
    /// What becomes of waves of stretching.
    #[serde(default)]
    pub axial: Axial,
    /// Of rods: the first axis of the section at the first end, of any length; what of it is along the tangent does not count. From
    /// there sections are untwisted, but for what `stations` say. Across the tangent, and as far along `z` as can be, where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<Vector>,
    /// Unstressed shape, and the configuration at the start.
    pub shape: Shape,
    /// Rigid motion at the start; velocity of the first end.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named material coordinates: 0 is the first end, 1 the last.
    #[serde(default)]
    pub markers: BTreeMap<String, f64>,
}

/// Whether a cable bends and stretches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// It does, unless its number of elements is left to the planner, which finds that this changes no output by more than
    /// the error wanted: then it says `rigid` here.
    #[default]
    Auto,
    /// It does.
    Flexible,
    /// It does not: a rigid rod, uniform along its length. In the plane, straight, and not deforming at the start. Axial
    /// force and bending moment follow from its balance with inertia; strain and curvature are refused, as is what slides
    /// along it. Elements, Young's modulus, second moment and damping have no effect and are no parameters of its unit.
    Rigid,
}

/// A rigid body; without inertia, a particle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RigidBody {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Mass, kg; or `shape` and `density`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: Option<f64>,
    /// Inertia about the centre of mass, kg m^2: a number in the plane; in space the moments about the axes of the body's
    /// frame, or the whole tensor. Zero (and where nothing is said) is a particle, which does not turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
    /// Shape of a body of uniform density, instead of `mass` and `inertia`, which follow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Solid>,
    /// Density of that shape, kg/m^3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: Option<f64>,
    /// Centre of mass at the start, m.
    pub position: Vector,
    /// Direction of the body's frame at the start, counter-clockwise, rad.
    #[serde(default)]
    pub angle: f64,
    /// In space: how the body's frame stands at the start; along the global axes where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// Motion at the start; velocity of the centre of mass.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named points in the body's frame, whose origin is the centre of mass, m.
    #[serde(default)]
    pub markers: BTreeMap<String, Vector>,
}

/// Material of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus: f64,
    /// Of rods: shear modulus, Pa.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_modulus: Option<f64>,
    /// Density, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping_time: f64,
}

/// Strain measures by name; they agree only for small strains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Strain {
    /// Stretch `|r'| - 1` and rotation per reference length: geometrically exact beam theory.
    #[default]
    #[serde(rename = "thetaPrime")]
    ThetaPrime,
    /// Green-Lagrange axial strain and the curvature of the deformed line.
    #[serde(rename = "GreenLagrange_FrenetKappa")]
    GreenLagrangeFrenetKappa,
    /// Stretch `|r'| - 1` and the curvature of the deformed line.
    #[serde(rename = "engStrain_FrenetKappa")]
    EngStrainFrenetKappa,
}

/// What becomes of waves of stretching that run along a cable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axial {
    /// They ring as the material says: for ever where it has no damping.
    #[default]
    Waves,
    /// They settle: Kelvin-Voigt damping of the rate of axial strain alone, with the time `2 / omega_1`
    /// (`damping_time` where that is longer), so that the first axial mode is damped critically. `omega_1` is `pi c / L`,
    /// or `pi c / (2 L)` where joints or motions hold one end only; `c` the speed of sound. Bending is not touched, nor
    /// slow stretching; what is lost is counted in `energy.dissipated`. For forces that ring from loads or speeds that
    /// begin at once, where no one asked for the ringing.
    Settled,
}

/// Unstressed shape of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// Straight line.
    Line {
        /// First end, m.
        from: Vector,
        /// Last end, m.
        to: Vector,
    },
    /// Circular arc that bulges to the right of the way from `from` to `to`: drawn from left to
    /// right it sags. In space it sags towards -z in the upright plane through both ends, and the cable has no
    /// bending stiffness.
    Arc {
        /// First end, m.
        from: Vector,
        /// Last end, m.
        to: Vector,
        /// Length along the arc, m; more than the distance between the ends.
        length: f64,
    },
    /// Circular helix in space: of rods, and of cables without bending stiffness.
    Helix {
        /// Where its axis begins, m.
        from: Vector,
        /// Where its axis ends, m.
        to: Vector,
        /// Distance of the line from the axis, m.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
        /// Number of turns; positive of a right-handed helix, negative of a left-handed one.
        turns: f64,
        /// Direction from the axis to the first end, of any length; what of it is along the axis does not count.
        start: Vector,
    },
}

/// Rigid motion of a body at the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialMotion {
    /// Velocity of the first end of a cable or of the centre of mass of a rigid body, m/s; zero by default.
    #[serde(default, skip_serializing_if = "Vector::is_unsaid")]
    pub velocity: Vector,
    /// Angular velocity, counter-clockwise in the plane, in global axes in space, rad/s.
    #[serde(default)]
    pub spin: Spin,
    /// Velocity of deformation, m/s, beside both: its components as expressions in the material coordinate `s`,
    /// 0 at the first end and 1 at the last, e.g. `["0", "sin(PI*s)"]`; cables only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub deformation: Option<Vec<String>>,
}

/// A mass lumped at a marker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mass {
    /// Where it sits: `body.marker`.
    pub marker: String,
    /// Mass, kg.
    #[schemars(range(min = 0.0))]
    pub mass: f64,
    /// Moment of inertia that turns with the slope, kg m^2; markers of cables only.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub inertia: f64,
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wrong = |found: &str| {
            let message = format!("expected \"cable\", \"rod\" or \"rigid\", found {found}");
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
            Some("rod") => typed(value).map(Self::Rod),
            Some("rigid") => typed(value).map(Self::Rigid),
            _ => Err(wrong(&element.to_string())),
        }
    }
}

impl CableBody {
    /// Whether its sections turn about its line.
    pub fn is_rod(&self) -> bool {
        self.material.shear_modulus.is_some()
    }

    /// Whether sections couple twist and bending.
    pub fn is_coupled(&self) -> bool {
        let at_stations = self.stations.iter().map(|station| &station.section);
        let mut all = at_stations.chain([&self.section]);
        all.any(|section| section.coupling.is_some())
    }

    /// Numbers of its section, and how it is twisted without stress (rad), over a part without stations inside that this
    /// material coordinate is in.
    pub fn sections_about(&self, inside: f64) -> impl Fn(f64) -> (SectionNumbers, f64) {
        let is_around = |pair: &&[Station]| pair[0].at <= inside && inside <= pair[1].at;
        let pairs = self.stations.windows(2);
        let pair = pairs.filter(|pair| pair[0].at < pair[1].at).find(is_around);
        move |s| match pair {
            Some([first, last]) => between([first, last], (s - first.at) / (last.at - first.at)),
            _ => (self.section.numbers(), 0.0),
        }
    }

    /// Numbers of its section at a material coordinate, on one side of a step.
    pub fn section_at(&self, s: f64) -> SectionNumbers {
        self.sections_about(s)(s).0
    }

    /// Second moment of area in its middle, m^4: the larger of a rod, in the plane that about the axis across it.
    pub fn second_moment(&self) -> f64 {
        self.second_moment_of(&self.section_at(0.5))
    }

    /// The same of these numbers.
    pub fn second_moment_of(&self, numbers: &SectionNumbers) -> f64 {
        let [first, second] = numbers.second_moments;
        match self.is_rod() {
            true => first.max(second),
            false => first,
        }
    }

    /// Of a rod: torque and moments about both axes by twist and curvatures, N m^2.
    pub fn stiffness(&self, numbers: &SectionNumbers) -> Matrix3<f64> {
        let young = self.material.youngs_modulus;
        let torsion = self.material.shear_modulus.unwrap_or_default() * numbers.torsion_constant;
        let [first, second] = numbers.second_moments.map(|moment| young * moment);
        let [p, q, r] = numbers.coupling;
        Matrix3::from([[torsion, p, q], [p, first, r], [q, r, second]])
    }
}

impl RigidBody {
    /// Mass as said or of its shape, kg.
    pub fn mass(&self) -> f64 {
        match (self.shape, self.density) {
            (Some(shape), Some(density)) => density * shape.volume(),
            _ => self.mass.unwrap_or_default(),
        }
    }

    /// Inertia about the centre of mass as said or of its shape.
    pub fn inertia(&self) -> Inertia {
        match self.shape {
            Some(shape) => shape.inertia(self.mass()),
            None => self.inertia.unwrap_or_default(),
        }
    }
}

impl Body {
    /// Name of the body.
    pub fn name(&self) -> &str {
        match self {
            Self::Cable(body) | Self::Rod(body) => &body.name,
            Self::Rigid(body) => &body.name,
        }
    }

    /// Motion at the start.
    pub fn motion(&self) -> &InitialMotion {
        match self {
            Self::Cable(body) | Self::Rod(body) => &body.motion,
            Self::Rigid(body) => &body.motion,
        }
    }

    /// Motion at the start, to be changed.
    pub fn motion_mut(&mut self) -> &mut InitialMotion {
        match self {
            Self::Cable(body) | Self::Rod(body) => &mut body.motion,
            Self::Rigid(body) => &mut body.motion,
        }
    }

    /// Names of its markers, in alphabetical order.
    pub fn marker_names(&self) -> Vec<&str> {
        match self {
            Self::Cable(body) | Self::Rod(body) => {
                body.markers.keys().map(String::as_str).collect()
            }
            Self::Rigid(body) => body.markers.keys().map(String::as_str).collect(),
        }
    }

    /// The body if it is a cable or a rod, rigid or not.
    pub fn cable(&self) -> Option<&CableBody> {
        match self {
            Self::Cable(body) | Self::Rod(body) => Some(body),
            Self::Rigid(_) => None,
        }
    }

    /// The body if it is a cable that bends.
    pub fn flexible(&self) -> Option<&CableBody> {
        self.cable().filter(|cable| cable.model != Model::Rigid)
    }

    /// The body, to be changed, if it is a cable or a rod.
    pub fn cable_mut(&mut self) -> Option<&mut CableBody> {
        match self {
            Self::Cable(body) | Self::Rod(body) => Some(body),
            Self::Rigid(_) => None,
        }
    }

    /// The body if it is one of kind `rigid`.
    pub fn rigid(&self) -> Option<&RigidBody> {
        match self {
            Self::Rigid(body) => Some(body),
            Self::Cable(_) | Self::Rod(_) => None,
        }
    }

    /// The body, to be changed, if it is one of kind `rigid`.
    pub fn rigid_mut(&mut self) -> Option<&mut RigidBody> {
        match self {
            Self::Rigid(body) => Some(body),
            Self::Cable(_) | Self::Rod(_) => None,
        }
    }
}
