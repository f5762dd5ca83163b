//! Bodies and masses.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Matrix3, Matrix4, Matrix6, Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::accuracy::elements;
use super::section::between;
use super::{
    FileBody, Inertia, Orientation, PatchBody, SceneVector, Section, SectionNumbers, Solid, Spin,
    Station,
};

/// A body; `element` says of which kind.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "element", rename_all = "snake_case")]
pub enum Body {
    /// Flexible, of ANCF cables: two nodes with position and slope; stretches and bends, does not
    /// shear. Where `model` says so, a rigid rod.
    #[schemars(title = "Cable")]
    Cable(LineBody),
    /// Flexible line of which the sections rotate about the tangent: bends about two axes with their own stiffness, and twists; does not
    /// shear. In space.
    #[schemars(title = "Rod")]
    Rod(LineBody),
    /// Flexible line of which the sections rotate freely: shears too, with the rotary inertia of its sections.
    #[schemars(title = "Beam")]
    Beam(LineBody),
    /// A cable, a rod or a beam, as needed: a cable where nothing asks for its sections; else in space a rod; a beam
    /// where shear moves an output by more than the error wanted, or whole matrices are given. Takes the keys of all three; those
    /// that the element chosen has no use for are not used. Found while packaging; the page of the unit says why.
    #[schemars(title = "AutoBody")]
    Auto(LineBody),
    /// Rigid.
    #[schemars(title = "RigidBody")]
    Rigid(RigidBody),
    /// Finite element model reduced to modes, from a file. It moves freely, with small deformations.
    #[schemars(title = "ReducedBody")]
    Reduced(FileBody),
    /// Thin plate, flat without stress: stretches and bends. In space.
    #[schemars(title = "Plate")]
    Plate(PatchBody),
    /// Thin shell, flat or curved without stress: stretches and bends. In space.
    #[schemars(title = "Shell")]
    Shell(PatchBody),
}

/// A body of cable elements, or a rigid rod where they need not bend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineBody {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// Number of elements; `"auto"`, or nothing said, is as many as the accuracy asks for, found while packaging.
    #[serde(default, with = "elements")]
    #[schemars(with = "elements::InJson")]
    pub elements: Option<u32>,
    /// Whether it bends and stretches.
    #[serde(default)]
    pub model: Model,
    /// Natural modes of model `modal` with held interfaces, beside the static shapes of the markers that joints, motions, loads and ports act
    /// on; 0 takes the static shapes alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modes: Option<u32>,
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
    /// Treatment of axial vibrations.
    #[serde(default)]
    pub axial: Axial,
    /// First axis of the section at the first end of rods and beams in space, of any length; its part along the tangent does not count. From
    /// there sections are untwisted, but for what `stations` say. Where nothing is said it is level, and the second axis (`height` of a
    /// rectangle) stands as upright as the line lets it: against the scene's gravity, or along `z` without gravity. Of an upright line it is
    /// then along `y`, or along `z` where that is the line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<SceneVector>,
    /// Unstressed shape, and the configuration at the start.
    pub shape: Shape,
    /// Rigid motion at the start; velocity of the first end.
    #[serde(default)]
    pub motion: InitialMotion,
    /// Named material coordinates: 0 is the first end, 1 the last.
    #[serde(default)]
    pub markers: BTreeMap<String, f64>,
    /// Kinematics of its sections, as its element says or as chosen.
    #[serde(skip)]
    pub sections: LineModel,
    /// Against gravity as the scene was written, of any length; zero without gravity. A parameter that changes gravity later does not rotate sections.
    #[serde(skip)]
    pub vertical: [f64; 3],
}

/// Kinematics of the sections of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LineModel {
    /// A line without sections that rotate: a cable.
    #[default]
    Cable,
    /// Sections that rotate about the line and stay across it: a rod (Kirchhoff).
    Kirchhoff,
    /// Sections that rotate freely, with shear: a beam (Reissner).
    Reissner,
}

impl LineModel {
    /// Name of the element that a line of this model is.
    pub fn element(self) -> &'static str {
        match self {
            Self::Cable => "cable",
            Self::Kirchhoff => "rod",
            Self::Reissner => "beam",
        }
    }
}

/// Whether a cable bends and stretches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// Flexible, unless its number of elements is left to the planner, which finds that another model changes no output by more than
    /// the error wanted: then it says `rigid` or `modal` here.
    #[default]
    Auto,
    /// Flexible.
    Flexible,
    /// Rigid: a rod, uniform along its length. In the plane, straight, and not deforming at the start. Axial
    /// force and bending moment follow from its balance with inertia; strain and curvature are refused, as is what slides
    /// along it. Elements, Young's modulus, second moment and damping have no effect and are no parameters of its unit.
    Rigid,
    /// Reduced to `modes`: it moves freely, and deflections are exact to second order (beyond a tenth of its length a run says so). Of
    /// straight lines that are not twisted at rest: rods and beams, in the plane cables that resist bending and beams. Strains, section forces and stresses are not read of it, and nothing
    /// acts or slides along it but gravity. Static shapes far above the natural modes are critically damped. Elements have no effect.
    Modal,
}

impl Model {
    /// Whether a line of this model is one of elements that bend.
    pub fn has_elements(self) -> bool {
        matches!(self, Self::Auto | Self::Flexible)
    }
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
    /// frame, or the whole tensor. Zero (and where nothing is said) is a particle, which does not rotate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
    /// Shape. With `density` it gives mass and inertia. Beside `mass` and `inertia` it is drawn only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Solid>,
    /// Density of that shape, kg/m^3, instead of `mass` and `inertia`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: Option<f64>,
    /// Centre of mass at the start, m.
    pub position: SceneVector,
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
    pub markers: BTreeMap<String, SceneVector>,
}

/// Material of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus: Option<f64>,
    /// Shear modulus of rods and beams, Pa.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_modulus: Option<f64>,
    /// Density, kg/m^3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: Option<f64>,
    /// Kelvin-Voigt damping: ratio of viscosity to stiffness, s.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping_time: f64,
    /// In place of `damping_time`: damping ratio of the first mode of the scene, about its start, in which at least half of the energy is
    /// strain of this body. Packaging makes of it the `damping_time` with which the body gives the mode this ratio; a mode of twice the
    /// frequency has about twice the ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping_ratio: Option<f64>,
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

/// Treatment of axial vibrations of a cable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axial {
    /// Axial vibrations decay as the material says: never where it has no damping.
    #[default]
    Waves,
    /// Axial vibrations are damped critically: Kelvin-Voigt damping of the rate of axial strain alone, with the time `2 / omega_1`
    /// (`damping_time` where that is longer), so that the first axial mode is damped critically. `omega_1` is `pi c / L`,
    /// or `pi c / (2 L)` where joints or motions hold one end only; `c` the speed of sound. Bending is not touched, nor
    /// slow stretching; what is lost is counted in `energy.dissipated`. For forces that ring from loads or speeds that
    /// begin at once, where no one asked for the ringing.
    CriticallyDamped,
}

/// Unstressed shape of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// Straight line.
    #[schemars(title = "Line")]
    Line {
        /// First end, m.
        from: SceneVector,
        /// Last end, m.
        to: SceneVector,
    },
    /// Circular arc that bulges to the right of the way from `from` to `to`: drawn from left to
    /// right it sags. In space it sags towards -z in the upright plane through both ends, and the cable has no
    /// bending stiffness.
    #[schemars(title = "Arc")]
    Arc {
        /// First end, m.
        from: SceneVector,
        /// Last end, m.
        to: SceneVector,
        /// Length along the arc, m; more than the distance between the ends.
        length: f64,
    },
    /// Circular helix in space: of rods, and of cables without bending stiffness.
    #[schemars(title = "Helix")]
    Helix {
        /// Where its axis begins, m.
        from: SceneVector,
        /// Where its axis ends, m.
        to: SceneVector,
        /// Distance of the line from the axis, m.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
        /// Number of turns; positive of a right-handed helix, negative of a left-handed one.
        turns: f64,
        /// Direction from the axis to the first end, of any length; what of it is along the axis does not count.
        start: SceneVector,
    },
}

/// Rigid motion of a body at the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialMotion {
    /// Velocity of the first end of a cable, of the centre of mass of a rigid body or of the origin of a reduced body's file, m/s; zero by default.
    #[serde(default, skip_serializing_if = "SceneVector::is_unsaid")]
    pub velocity: SceneVector,
    /// Angular velocity, counter-clockwise in the plane, in global axes in space, rad/s.
    #[serde(default)]
    pub spin: Spin,
    /// Velocity of deformation, m/s, beside both: its components as expressions in the material coordinate `s`,
    /// 0 at the first end and 1 at the last, e.g. `["0", "sin(PI*s)"]`; of plates and shells in `s1` and `s2`, e.g. `["0", "0", "s1*s2"]`.
    /// Cables, rods, beams, plates and shells only. Sections of rods and beams rotate with the line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub deformation: Option<Vec<String>>,
}

impl InitialMotion {
    /// Whether all of it is zero.
    pub fn is_none(&self) -> bool {
        let mut rates = self.velocity.full().into_iter().chain(self.spin.full());
        rates.all(|rate| rate == 0.0) && self.deformation.is_none()
    }
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
    /// Moment of inertia that rotates with the slope, kg m^2; markers of cables only.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub inertia: f64,
}

impl LineBody {
    /// Whether its sections rotate about its line: a rod or a beam.
    pub fn is_rod(&self) -> bool {
        self.sections != LineModel::Cable
    }

    /// Whether they lean against it, too.
    pub fn is_beam(&self) -> bool {
        self.sections == LineModel::Reissner
    }

    /// Whether sections couple twist and bending, or either with stretching.
    pub fn is_coupled(&self) -> bool {
        let says = |of: &Section| of.coupling.is_some() || of.axial_coupling.is_some();
        self.is_given() || self.all_sections().any(says)
    }

    /// Whether sections couple stretching with twist or bending.
    pub fn is_coupled_axially(&self) -> bool {
        let mut numbers = self.all_sections().map(Section::numbers);
        numbers.any(|numbers| numbers.axial_coupling != [0.0; 3])
    }

    /// Iterates over the cross sections: those at stations, or the one that is uniform.
    pub fn all_sections(&self) -> impl Iterator<Item = &Section> {
        let at_stations = self.stations.iter().map(|station| &station.section);
        at_stations.chain(self.stations.is_empty().then_some(&self.section))
    }

    /// Whether its sections are given as whole matrices.
    pub fn is_given(&self) -> bool {
        (self.all_sections()).any(|section| section.stiffness.is_some())
    }

    /// Numbers of its section, and how it is twisted without stress (rad), over a part without stations inside that this
    /// material coordinate is in.
    pub fn sections_about(&self, inside: f64) -> impl Fn(f64) -> (SectionNumbers, f64) {
        let is_around = |pair: &&[Station]| pair[0].at <= inside && inside <= pair[1].at;
        let pairs = self.stations.windows(2);
        let pair = pairs.filter(|pair| pair[0].at < pair[1].at).find(is_around);
        move |s| match pair {
            Some([first, last]) => between(first, last, (s - first.at) / (last.at - first.at)),
            _ => (self.section.numbers(), 0.0),
        }
    }

    /// Numbers of its section just after a material coordinate, at the last end those there.
    pub fn section_after(&self, s: f64) -> SectionNumbers {
        let mut stations = self.stations.iter().map(|station| station.at);
        // What roundoff keeps apart is one place.
        let next = stations.find(|at| *at > s + 1e-12);
        let inside = next.map_or(s, |next| 0.5 * (s + next));
        self.sections_about(inside)(s).0
    }

    /// Numbers of its section at a material coordinate, on one side of a step.
    pub fn section_at(&self, s: f64) -> SectionNumbers {
        self.sections_about(s)(s).0
    }

    /// Bending stiffness in its middle, N m^2: the larger of a rod, in the plane that about the axis across it.
    pub fn bending_stiffness(&self) -> f64 {
        self.bending_stiffness_of(&self.section_at(0.5))
    }

    /// Returns the bending stiffness for these numbers of a section, N m^2.
    pub fn bending_stiffness_of(&self, numbers: &SectionNumbers) -> f64 {
        if let Some(given) = &numbers.given {
            return given.stiffness[(4, 4)].max(given.stiffness[(5, 5)]);
        }
        self.material.young()
            * if self.is_rod() {
                numbers.largest_moment()
            } else {
                numbers.second_moments[0]
            }
    }

    /// Axial stiffness, N.
    pub fn axial_stiffness_of(&self, numbers: &SectionNumbers) -> f64 {
        match &numbers.given {
            Some(given) => given.stiffness[(0, 0)],
            None => self.material.young() * numbers.area,
        }
    }

    /// Mass per length, kg/m.
    pub fn line_density_of(&self, numbers: &SectionNumbers) -> f64 {
        match &numbers.given {
            Some(given) => given.inertia[(0, 0)],
            None => self.material.density.unwrap_or_default() * numbers.area,
        }
    }

    /// Inertia of a section against rotation about the line and the two axes, per length, kg m.
    pub fn rotary_inertia_of(&self, numbers: &SectionNumbers) -> Matrix3<f64> {
        match &numbers.given {
            Some(given) => given.inertia.fixed_view::<3, 3>(3, 3).into_owned(),
            None => {
                let [first, second] = numbers.second_moments;
                let moments = Vector3::new(first + second, first, second);
                let mut moments = Matrix3::from_diagonal(&moments);
                (moments[(1, 2)], moments[(2, 1)]) =
                    (-numbers.product_moment, -numbers.product_moment);
                moments * self.material.density.unwrap_or_default()
            }
        }
    }

    /// Returns the stiffness of a rod: torque and moments about both axes by twist and curvatures, N m^2.
    pub fn stiffness(&self, numbers: &SectionNumbers) -> Matrix3<f64> {
        let torsion = self.material.shear_modulus.unwrap_or_default() * numbers.torsion_constant;
        let [first, second] = numbers
            .second_moments
            .map(|moment| self.material.young() * moment);
        let [p, q, mut r] = numbers.coupling;
        if numbers.product_moment != 0.0 {
            r -= self.material.young() * numbers.product_moment;
        }
        Matrix3::from([[torsion, p, q], [p, first, r], [q, r, second]])
    }

    /// Returns the stiffness of a rod with the axial force by stretch first, then torque and moments by twist and curvatures.
    pub fn coupled_stiffness(&self, numbers: &SectionNumbers) -> Matrix4<f64> {
        let mut stiffness = Matrix4::zeros();
        stiffness[(0, 0)] = self.axial_stiffness_of(numbers);
        let turns = self.stiffness(numbers);
        stiffness.fixed_view_mut::<3, 3>(1, 1).copy_from(&turns);
        for (k, entry) in numbers.axial_coupling.into_iter().enumerate() {
            (stiffness[(0, 1 + k)], stiffness[(1 + k, 0)]) = (entry, entry);
        }
        stiffness
    }

    /// Returns the stiffness of a beam: axial and shear forces, torque and moments by stretch, shear, twist and curvatures, N, N m, N m^2.
    pub fn whole_stiffness(&self, numbers: &SectionNumbers) -> Matrix6<f64> {
        if let Some(given) = &numbers.given {
            return given.stiffness;
        }
        let mut stiffness = Matrix6::zeros();
        stiffness[(0, 0)] = self.axial_stiffness_of(numbers);
        let shear = self.shear_stiffness(numbers);
        stiffness.fixed_view_mut::<2, 2>(1, 1).copy_from(&shear);
        let turns = self.stiffness(numbers);
        stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&turns);
        let [y, z] = numbers.shear_center();
        if self.is_beam() && [y, z] != [0.0; 2] {
            // Shear strain at the shear centre is that of the line and what twist adds.
            let arm = Vector2::new(-z, y);
            let coupled = shear * arm;
            stiffness.fixed_view_mut::<2, 1>(1, 3).copy_from(&coupled);
            (stiffness.fixed_view_mut::<1, 2>(3, 1)).copy_from(&coupled.transpose());
            stiffness[(3, 3)] += arm.dot(&coupled);
        }
        for (k, entry) in numbers.axial_coupling.into_iter().enumerate() {
            (stiffness[(0, 3 + k)], stiffness[(3 + k, 0)]) = (entry, entry);
        }
        stiffness
    }

    /// Returns the stiffness of a beam in the plane: axial force, shear force and moment. The first axis of sections is across the plane.
    pub fn planar_stiffness(&self, numbers: &SectionNumbers) -> Matrix3<f64> {
        let whole = self.whole_stiffness(numbers);
        Matrix3::from_fn(|r, c| whole[(2 * r, 2 * c)])
    }

    /// Shear forces along both axes by shear strains at the shear centre, N: by factors as said or of the shape, or by its whole compliance. Zero
    /// where that is not positive. Moduli with a ratio of Poisson that no isotropic solid in use has, below 0 or above 0.5, take the compliance at
    /// the nearer end: contraction to the sides is not known of them.
    pub fn shear_stiffness(&self, numbers: &SectionNumbers) -> Matrix2<f64> {
        let (young, shear) = (self.material.young(), self.material.shear_modulus);
        let ratio = shear.map_or(0.0, |shear| 0.5 * young / shear - 1.0);
        let modulus = shear.unwrap_or_default();
        let shape = numbers.shape.as_ref();
        let closed = shape.and_then(|shape| shape.shear_factors(ratio));
        let factors = numbers.shear_factors.or(closed);
        if let (None, Some(of)) = (factors, &numbers.shear) {
            let [first, second] = of.compliance;
            let ratio = ratio.clamp(0.0, 0.5);
            let compliance = (first + second * ratio).cholesky();
            let modulus = 2.0 * (1.0 + ratio) * modulus;
            return compliance.map_or_else(Matrix2::zeros, |of| of.inverse() * modulus);
        }
        let along = factors.unwrap_or([1.0; 2]);
        Matrix2::from_diagonal(&along.map(|factor| factor * modulus * numbers.area).into())
    }
}

impl Material {
    /// Young's modulus, Pa; zero where none is said.
    pub fn young(&self) -> f64 {
        self.youngs_modulus.unwrap_or_default()
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
        match (self.shape, self.density) {
            (Some(shape), Some(_)) => shape.inertia(self.mass()),
            _ => self.inertia.unwrap_or_default(),
        }
    }
}
