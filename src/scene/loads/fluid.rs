//! Fluids along bodies, and the mass that moves along with these.

use std::f64::consts::PI;

use super::line::{component, uniform, varying};
use super::*;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::vector;
use crate::scene::assemble::each;
use crate::scene::description::{ALONG_LINE, OVER_SURFACE, SectionNumbers};
use crate::scene::resolved::Plate;
use crate::system::loads::{AreaValues, Fluid, FluidSegment, SurfaceFluid};

/// A fluid along a line or a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FluidLoad {
    /// Name of the cable, rod, beam, plate or shell that the fluid streams past.
    pub body: String,
    /// Density of the fluid, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Velocity of the fluid in global axes, m/s; zero by default. Expressions may contain the material coordinate `s` of a line, which is
    /// 0 at the first end and 1 at the last, and the coordinates `s1` and `s2` of a plate or shell, each from 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub current: Option<Vec<Value>>,
    /// Coefficient of drag across a line, for the area `diameter` times length, or along the normal of a plate or shell, for its area; 0 by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub drag: Option<f64>,
    /// Coefficient of drag along a line, for the area `pi diameter` times length, or in the surface of a plate or shell, both sides
    /// together, for its area; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub tangential_drag: Option<f64>,
    /// Coefficient of added mass of a line: the mass of fluid that moves along, divided by the mass of displaced fluid; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub added_mass: Option<f64>,
    /// Diameter of a line for drag, m; by default the outer diameter of a circle or tube, else that of a circle with the area of the section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: Option<f64>,
    /// Area of the section of a line that displaces fluid, m^2; by default the area of a circle of this `diameter`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: Option<f64>,
    /// Whether the weight of the displaced fluid lifts the body; true by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = true))]
    pub buoyancy: Option<bool>,
}

/// A fluid along a body.
#[derive(Clone, Debug)]
pub struct ResolvedFluid<'a> {
    /// As described.
    given: &'a FluidLoad,
    /// Line or surface that the fluid acts on.
    pub on: LoadPlace<'a>,
    /// Velocity of the fluid, m/s. Components that vary along the body are zero here.
    pub current: Vec<Signal>,
    /// Components that change along the body, and their expressions.
    pub varying: Vec<(usize, &'a str)>,
}

impl FluidLoad {
    /// Components of the current as written; none where the fluid rests.
    fn components(&self) -> &[Value] {
        self.current.as_deref().unwrap_or_default()
    }

    /// Whether the weight of the displaced fluid lifts the body.
    fn lifts(&self) -> bool {
        self.buoyancy.unwrap_or(true)
    }

    /// Checks what a line needs.
    fn check_line(&self, path: &str, line: Cable<'_>) -> Result<(), Error> {
        let mut sections = line.body.all_sections();
        if self.diameter.is_none() && sections.any(|s| s.numbers().area == 0.0) {
            let wanted = "a diameter, as the section has no area";
            return Err(expected(&format!("{path}.diameter"), wanted, "nothing"));
        }
        Ok(())
    }

    /// Refuses keys that a surface does not have.
    fn check_surface(&self, path: &str, plate: Plate<'_>) -> Result<(), Error> {
        for (key, value) in [
            ("added_mass", self.added_mass),
            ("diameter", self.diameter),
            ("area", self.area),
        ] {
            if let Some(value) = value {
                let wanted = "nothing for a plate or shell";
                return Err(expected(&format!("{path}.{key}"), wanted, value));
            }
        }
        if self.lifts() && plate.body.layers([0.5; 2]).is_empty() {
            let wanted = "false for a section whose thickness is not given";
            return Err(expected(&format!("{path}.buoyancy"), wanted, true));
        }
        Ok(())
    }
}

impl SceneLoad for FluidLoad {
    type Acting<'a> = ResolvedFluid<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let at = |key: &str| format!("{path}.{key}");
        let on = scene.require_line_or_surface(&at("body"), &self.body)?;
        for (key, unit, value) in [
            ("density", "kg/m^3", Some(self.density)),
            ("diameter", "m", self.diameter),
            ("area", "m^2", self.area),
        ] {
            value.map_or(Ok(()), |value| positive(&at(key), unit, value))?;
        }
        for (key, value) in [
            ("drag", self.drag),
            ("tangential_drag", self.tangential_drag),
            ("added_mass", self.added_mass),
        ] {
            not_negative(&at(key), "1", value.unwrap_or_default())?;
        }
        match on {
            LoadPlace::Surface(plate) => self.check_surface(path, plate)?,
            LoadPlace::Line(line) => self.check_line(path, line)?,
            _ => {}
        }
        scene.require_still_frame("a fluid")?;
        let dimension = scene.scene.dimension;
        let rest = vec![Value::Number(0.0); dimension];
        let current = self.current.as_ref().unwrap_or(&rest);
        let current = components(&at("current"), dimension, current, |path, of| {
            let coordinates = match on {
                LoadPlace::Surface(_) => &OVER_SURFACE,
                _ => ALONG_LINE,
            };
            component(path, of, coordinates)
        })?;
        Ok(ResolvedFluid {
            given: self,
            on,
            current,
            varying: varying(self.components()),
        })
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        Some(TimedKey {
            key: "current",
            values: self.components(),
            // The fluid pushes as it is accelerated.
            order: 1,
        })
    }

    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        #[rustfmt::skip] // a table
        let numbers = vec![
            LoadNumber::new("density", "Density", Some(DENSITY), Needed(&mut self.density)),
            LoadNumber::new("drag", "Coefficient of drag across the line", None, Optional(&mut self.drag)),
            LoadNumber::new("tangential_drag", "Coefficient of drag along the line", None, Optional(&mut self.tangential_drag)),
            LoadNumber::new("added_mass", "Coefficient of added mass", None, Optional(&mut self.added_mass)),
        ];
        numbers
    }
}

impl<'a> ActingLoad<'a> for ResolvedFluid<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.on
    }

    /// Along a cable that a winch pays out there is no added mass.
    fn has_number(&self, key: &str, scene: &Resolved<'_>) -> bool {
        key != "added_mass" || self.line().is_some_and(|line| !scene.is_paid_out(line))
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D> {
        match self.on {
            LoadPlace::Line(line) => self.along(line, builder, path),
            LoadPlace::Surface(plate) => self.over(plate, builder, path),
            _ => unreachable!("a fluid acts on a line or a surface"),
        }
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let of = self.given;
        let current = stream_words(["current", "at rest"], &self.current, of.components());
        let coefficients = [
            ("drag", of.drag),
            ("drag along the line", of.tangential_drag),
            ("added mass", of.added_mass),
        ];
        let coefficients = coefficients
            .map(|(what, of)| format!(", {what} {}", number(of.unwrap_or_default())))
            .concat();
        let lengths =
            words::given(", diameter", of.diameter, "m") + &words::given(", area", of.area, "m²");
        let lifts = if of.lifts() { "" } else { ", no buoyancy" };
        let density = number(of.density);
        LoadWords {
            kind: "fluid".into(),
            on: words::code(self.on.name()),
            size: format!("{density} kg/m³, {current}{coefficients}{lengths}{lifts}"),
        }
    }
}

impl<'a> ResolvedFluid<'a> {
    /// Line that the fluid acts on.
    pub fn line(&self) -> Option<Cable<'a>> {
        match self.on {
            LoadPlace::Line(line) => Some(line),
            _ => None,
        }
    }

    fn along<const D: usize>(
        &self,
        cable: Cable<'_>,
        builder: &Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D> {
        let mut strips = Vec::new();
        for ends in builder.segments(cable)?.windows(2) {
            let sections = cable.body.sections_about(0.5 * (ends[0] + ends[1]));
            for point in GAUSS_5 {
                let section = match cable.id.form {
                    Form::Chain(_) => sections(ends[0] + point.at * (ends[1] - ends[0])).0,
                    // All along it that of its middle, as its mass.
                    Form::Rod(_) | Form::Modal => cable.body.section_at(0.5),
                };
                strips.push(self.strip(&section));
            }
        }
        let mut current = uniform(&self.current);
        let path = format!("{path}.current");
        builder.fill(cable, &self.varying, &path, &mut current.along)?;
        Ok(AppliedLoad::Fluid(Box::new(Fluid {
            on: builder.line(cable),
            strips,
            current,
            gravity: vector(builder.resolved.scene.gravity.full()),
            carried: (vector([0.0; 3]), [0.0; 3]),
            fraction: 1.0,
        })))
    }

    fn over<const D: usize>(
        &self,
        plate: Plate<'_>,
        builder: &Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D> {
        let mut current = each(&self.current).map(AreaValues::uniform);
        for (k, text) in &self.varying {
            let path = format!("{path}.current[{k}]");
            current[*k].places = builder.over_places(plate, text, &path)?;
        }
        let coefficients = [self.given.tangential_drag, self.given.drag];
        let (density, lifts) = (self.given.density, self.given.lifts());
        let drag = coefficients.map(|of| 0.5 * density * of.unwrap_or_default());
        let segment = |at: [f64; 2]| {
            let displaced = density * plate.body.whole_thickness(at);
            FluidSegment {
                drag,
                buoyant: if lifts { displaced } else { 0.0 },
                inert: displaced,
            }
        };
        let places = builder.patch_of(plate).area_places();
        Ok(AppliedLoad::SurfaceFluid(Box::new(SurfaceFluid {
            on: builder.surface(plate),
            places: places.map(segment).collect(),
            current,
            gravity: builder.resolved.scene.gravity.full(),
            carried: [[0.0; 3]; 2],
            fraction: 1.0,
        })))
    }

    /// Coefficient of added mass.
    pub fn added_mass(&self) -> f64 {
        self.given.added_mass.unwrap_or_default()
    }

    /// Diameter that drag counts with at a section, m.
    fn diameter(&self, section: &SectionNumbers) -> f64 {
        self.given.diameter.unwrap_or_else(|| section.diameter())
    }

    /// Mass of the fluid that is displaced at a section, kg/m.
    fn displaced(&self, section: &SectionNumbers) -> f64 {
        let circle = 0.25 * PI * self.diameter(section).powi(2);
        self.given.density * self.given.area.unwrap_or(circle)
    }

    /// Mass of the fluid that moves along at a section, kg/m.
    fn added(&self, section: &SectionNumbers) -> f64 {
        self.added_mass() * self.displaced(section)
    }

    fn strip(&self, section: &SectionNumbers) -> FluidSegment {
        let coefficients = [self.given.drag, self.given.tangential_drag];
        let [across, along] = coefficients.map(Option::unwrap_or_default);
        let faced = 0.5 * self.given.density * self.diameter(section);
        let displaced = self.displaced(section);
        let lifts = self.given.lifts();
        FluidSegment {
            drag: [faced * across, faced * PI * along],
            buoyant: if lifts { displaced } else { 0.0 },
            inert: displaced + self.added(section),
        }
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// The fluid, if the load is one.
    pub fn fluid(&self) -> Option<&ResolvedFluid<'a>> {
        match self {
            Self::Fluid(fluid) => Some(fluid),
            _ => None,
        }
    }
}

/// Describes a stream by its name and by what it is called without components, with its signals and how its components are written.
pub(super) fn stream_words([name, rest]: [&str; 2], signals: &[Signal], given: &[Value]) -> String {
    let mut signals = signals.iter();
    let is_input = signals.any(|of| matches!(of, Signal::Input(_)));
    match (is_input, given) {
        (true, _) => format!("{name}: input"),
        (false, []) => rest.into(),
        (false, given) => format!("{name} ({}) m/s", words::values(given)),
    }
}

impl Resolved<'_> {
    /// Checks that the frame of the scene, in which what streams would rotate, stands still.
    ///
    /// # Errors
    /// It rotates.
    pub(super) fn require_still_frame(&self, what: &str) -> Result<(), Error> {
        if !self.scene.turns() {
            return Ok(());
        }
        let wanted = format!("0 where {what} acts, which does not rotate with the frame");
        let found = format!("{:?}", self.scene.rotation.full());
        Err(expected("rotation", &wanted, found))
    }

    /// Mass of all fluids that move along with a body at a section, kg/m.
    pub(crate) fn added_mass(&self, body: usize, section: &SectionNumbers) -> f64 {
        let fluids = self.loads.iter().filter_map(|load| load.kind.fluid());
        let fluids = fluids.filter(|fluid| fluid.on.bodies() == [body]);
        fluids.map(|fluid| fluid.added(section)).sum()
    }

    /// Makes the current of a fluid or the wind on an airfoil an input. Returns its components until then, m/s.
    ///
    /// # Errors
    /// A fluid that does not exist, or a current that is not given by finite numbers.
    pub(crate) fn set_current(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<Vec<f64>, Error> {
        let wanted = "a fluid or an airfoil of this scene";
        let (stream, given) = self.require_load(path, name, wanted, |load| match load {
            ResolvedLoadKind::Fluid(fluid) => Some((&mut fluid.current, fluid.given.components())),
            ResolvedLoadKind::Airfoil(strip) => Some(strip.stream()),
            _ => None,
        })?;
        let mut start = vec![0.0; stream.len()];
        for (start, value) in start.iter_mut().zip(given) {
            let Value::Number(value) = value else {
                let wanted = "a load whose current or wind is numbers";
                let found = format!("{}, whose current changes", quoted(name));
                return Err(expected(path, wanted, found));
            };
            finite(path, *value)?;
            *start = *value;
        }
        let inputs = (0..start.len()).map(|k| Signal::Input(first + k));
        *stream = inputs.collect();
        Ok(start)
    }
}
