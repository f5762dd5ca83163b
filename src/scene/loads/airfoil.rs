//! Airfoils at markers and along lines.

use nalgebra::Vector3;

use super::fluid::stream_words;
use super::line::{component, uniform, varying};
use super::*;
use crate::bodies::Marker;
use crate::math::function::Function;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::vector;
use crate::math::state_expression::StateExpression;
use crate::scene::description::ALONG_LINE;
use crate::scene::validate::checks::direction;
use crate::system::loads::{
    Airfoil, AirfoilAxes, AirfoilCoefficient, AirfoilLine, AirfoilStrip, StateLaw,
};

/// Variables of expressions of coefficients at a marker, and along a body.
const VARIABLES: [&str; 3] = ["a", "q", "s"];

/// Lift, drag and moment of an airfoil: of a strip at a marker, or of a wing or blade along a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AirfoilLoad {
    /// Marker of a strip: of a rigid body with inertia, of a rod or beam, or of a cable in the plane. Either this or `body` is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<String>,
    /// Name of the rod or beam, in the plane also of the cable, that is an airfoil all along.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Direction from the leading to the trailing edge, of any length: along the axes of the frame of a rigid body, or of the section of a
    /// rod or beam (tangent, first axis, second axis). In the plane along the direction of the marker and to its left.
    pub chord_direction: SceneVector,
    /// In space, direction of the lift at no angle of attack, along the same axes, of any length. What of it is along the chord does not
    /// count. In the plane it is the chord rotated left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lift_direction: Option<SceneVector>,
    /// Chord, m: a number above 0. Along a body also a table over its material coordinate `s`, which is 0 at the first end and 1 at the last,
    /// or an expression in `s`; there is no airfoil where it is 0.
    pub chord: Value,
    /// Length of a strip at a marker along the span, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub span: Option<f64>,
    /// Distance of the aerodynamic centre ahead of the marker, or of the line of the body, towards the leading edge, over the chord: a
    /// number, along a body also a table over `s` or an expression in it; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead: Option<Box<Value>>,
    /// Density of the air, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Velocity of the air in global axes, m/s; zero by default. Along a body expressions may contain `s`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub wind: Option<Vec<Value>>,
    /// Coefficient of lift for chord times span: a number, a table over the angle of attack in rad, whose ends hold outside of it, or an
    /// expression in the angle of attack `a` (rad, between -pi and pi), in the reduced rate of pitch `q`, nose up, in the time `t` and along a
    /// body in `s`. `q` is the rate in rad/s times the chord over twice the speed of the air.
    pub lift: Value,
    /// Coefficient of drag for chord times span, as `lift`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drag: Option<Box<Value>>,
    /// Coefficient of the moment about the aerodynamic centre, nose up, for the square of the chord times span, as `lift`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment: Option<Box<Value>>,
}

/// An airfoil with its references resolved.
#[derive(Clone, Debug)]
pub struct ResolvedAirfoil<'a> {
    /// As described.
    given: &'a AirfoilLoad,
    /// Marker or line.
    on: LoadPlace<'a>,
    /// Unit vectors along the chord and across it, along axes of the body.
    axes: [Vector3<f64>; 2],
    /// Coefficients of lift, drag and moment.
    coefficients: Box<[AirfoilCoefficient; 3]>,
    /// Velocity of the air, m/s. Components that vary along the body are zero here.
    wind: Vec<Signal>,
    /// Components that change along the body, and their expressions.
    varying: Vec<(usize, &'a str)>,
    /// Chord, m, and distance of the aerodynamic centre ahead of the line over it.
    lengths: Box<[AlongSpan; 2]>,
}

impl AirfoilLoad {
    /// Components of the wind as written; none in still air.
    fn components(&self) -> &[Value] {
        self.wind.as_deref().unwrap_or_default()
    }

    /// Unit vectors along the chord and across it.
    fn directions(&self, path: &str, dimension: usize) -> Result<[Vector3<f64>; 2], Error> {
        let place = format!("{path}.chord_direction");
        direction(&place, dimension, &self.chord_direction)?;
        let chord = Vector3::from(self.chord_direction.full()).normalize();
        let place = format!("{path}.lift_direction");
        let Some(lift) = &self.lift_direction else {
            if dimension == 3 {
                return Err(expected(&place, "a direction, in space", "nothing"));
            }
            return Ok([chord, Vector3::new(-chord.y, chord.x, 0.0)]);
        };
        if dimension == 2 {
            let wanted = "nothing in the plane, where it is the chord rotated left";
            return Err(expected(&place, wanted, format!("{:?}", lift.given())));
        }
        direction(&place, dimension, lift)?;
        let lift = Vector3::from(lift.full()).normalize();
        let across = lift - chord * chord.dot(&lift);
        if across.norm() < 1e-6 {
            let wanted = "a direction other than that of the chord";
            return Err(expected(&place, wanted, "one along it"));
        }
        Ok([chord, across.normalize()])
    }
}

/// Reads a coefficient, whose expressions have these variables.
fn coefficient(
    path: &str,
    of: Option<&Value>,
    variables: &[&'static str],
) -> Result<AirfoilCoefficient, Error> {
    Ok(match of {
        None => AirfoilCoefficient::Curve(Function::constant(0.0)),
        Some(Value::Expression(text)) => {
            let read = StateExpression::with_names(text, variables);
            let read = read.map_err(|message| Error::new(path, message))?;
            AirfoilCoefficient::Expression(StateLaw::new(read))
        }
        Some(other) => AirfoilCoefficient::Curve(value(path, other, false)?),
    })
}

/// A number, or what is one at every place of a body.
#[derive(Clone, Debug)]
enum AlongSpan {
    /// By a number or a table.
    Curve(Function),
    /// By an expression in the material coordinate.
    Expression(StateExpression),
}

impl AlongSpan {
    /// Reads one. At a marker it is a number.
    ///
    /// # Errors
    /// Anything else there; a table or an expression that is not valid, or one in the time.
    fn read(path: &str, of: &Value, on: &LoadPlace<'_>) -> Result<Self, Error> {
        if let (LoadPlace::Marker(_), false) = (on, matches!(of, Value::Number(_))) {
            return Err(expected(
                path,
                "a number at a marker",
                words::value_over(of, ""),
            ));
        }
        let Value::Expression(text) = of else {
            return value(path, of, false).map(Self::Curve);
        };
        let read = StateExpression::with_names(text, &["s"]);
        let read = read.map_err(|message| Error::new(path, message))?;
        if read.is_timed() {
            return Err(expected(path, "an expression in `s` alone", quoted(text)));
        }
        Ok(Self::Expression(read))
    }

    fn value(&self, s: f64) -> f64 {
        match self {
            Self::Curve(curve) => curve.value(s),
            Self::Expression(of) => of.value(0.0, [s, 0.0, 0.0]),
        }
    }
}

impl SceneLoad for AirfoilLoad {
    type Acting<'a> = ResolvedAirfoil<'a>;

    const EXERTS: Exerts = Exerts::Force;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let at = |key: &str| format!("{path}.{key}");
        let dimension = scene.scene.dimension;
        let on = self.place(path, scene)?;
        if let Value::Number(chord) = self.chord {
            positive(&at("chord"), "m", chord)?;
        }
        let chord = AlongSpan::read(&at("chord"), &self.chord, &on)?;
        let none = Value::Number(0.0);
        let ahead = self.ahead.as_deref().unwrap_or(&none);
        let ahead = AlongSpan::read(&at("ahead"), ahead, &on)?;
        positive(&at("density"), "kg/m^3", self.density)?;
        scene.require_still_frame("air")?;
        let (coordinates, variables) = match on {
            LoadPlace::Line(_) => (ALONG_LINE, &VARIABLES[..]),
            _ => (&[][..], &VARIABLES[..2]),
        };
        let rest = vec![Value::Number(0.0); dimension];
        let wind = self.wind.as_ref().unwrap_or(&rest);
        let wind = components(&at("wind"), dimension, wind, |path, of| {
            component(path, of, coordinates)
        })?;
        let read = |key: &str, of| coefficient(&at(key), of, variables);
        Ok(ResolvedAirfoil {
            given: self,
            axes: self.directions(path, dimension)?,
            coefficients: Box::new([
                read("lift", Some(&self.lift))?,
                read("drag", self.drag.as_deref())?,
                read("moment", self.moment.as_deref())?,
            ]),
            wind,
            varying: varying(self.components()),
            lengths: Box::new([chord, ahead]),
            on,
        })
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        Some(TimedKey {
            key: "wind",
            values: self.components(),
            order: 0,
        })
    }

    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        let chord = match &mut self.chord {
            Value::Number(chord) => Some(chord),
            _ => None,
        };
        let of = |key, what, value| LoadNumber::new(key, what, Some(METRE), Needed(value));
        let chord = chord.map(|value| of("chord", "Chord", value));
        let span = self.span.as_mut();
        let span = span.map(|value| of("span", "Length along the span", value));
        let density = LoadNumber::new(
            "density",
            "Density of the air",
            Some(DENSITY),
            Needed(&mut self.density),
        );
        chord.into_iter().chain(span).chain([density]).collect()
    }
}

impl AirfoilLoad {
    /// Finds the marker or the line.
    ///
    /// # Errors
    /// Both or none, one that does not exist or has no sections, a line that a winch pays out, or a span where there is none.
    fn place<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Result<LoadPlace<'a>, Error> {
        let at = |key: &str| format!("{path}.{key}");
        match (&self.marker, &self.body) {
            (Some(marker), None) => {
                let marker = scene.require_spinning(&at("marker"), marker)?;
                let Some(span) = self.span else {
                    return Err(expected(&at("span"), "a length at a marker", "nothing"));
                };
                positive(&at("span"), "m", span)?;
                Ok(LoadPlace::Marker(marker))
            }
            (None, Some(body)) => {
                let line = scene.require_cable(&at("body"), body)?;
                if !line.body.is_rod() && scene.scene.dimension == 3 {
                    let wanted = "a rod or beam, whose sections have axes";
                    return Err(expected(&at("body"), wanted, quoted(body)));
                }
                if scene.is_paid_out(line) {
                    let wanted = "a line that no winch pays out";
                    return Err(expected(&at("body"), wanted, quoted(body)));
                }
                if let Some(span) = self.span {
                    let wanted = "nothing along a body, whose length it is";
                    return Err(expected(&at("span"), wanted, span));
                }
                Ok(LoadPlace::Line(line))
            }
            (None, None) => Err(expected(&at("marker"), "a marker, or a `body`", "nothing")),
            (Some(_), Some(body)) => {
                let wanted = "nothing beside `marker`";
                Err(expected(&at("body"), wanted, quoted(body)))
            }
        }
    }
}

impl<'a> ActingLoad<'a> for ResolvedAirfoil<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.on
    }

    fn is_one_sided(&self) -> bool {
        let mut coefficients = self.coefficients.iter();
        coefficients.any(AirfoilCoefficient::has_kinks)
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        path: &str,
    ) -> AssembledLoad<D> {
        let mut wind = uniform(&self.wind);
        let (on, strips) = match self.on {
            LoadPlace::Marker(marker) => {
                let point = builder.marker(marker);
                let axes = match D {
                    2 => self.angled(point),
                    _ => AirfoilAxes::Markers(self.axes.map(|axis| builder.directed(marker, axis))),
                };
                let span = self.given.span.unwrap_or_default();
                let sections = [(1.0, axes), (0.0, axes)];
                (
                    None,
                    vec![self.strip(path, (point, sections), (span, 0.5))?],
                )
            }
            LoadPlace::Line(line) => {
                let at = format!("{path}.wind");
                builder.fill(line, &self.varying, &at, &mut wind.along)?;
                let on = AirfoilLine {
                    line: builder.line(line),
                    sections: builder.sections_of(line),
                };
                (Some(on), self.along(line, builder, path)?)
            }
            _ => unreachable!("an airfoil is at a marker or along a line"),
        };
        Ok(AppliedLoad::Airfoil(Box::new(Airfoil {
            on,
            strips,
            density: self.given.density,
            coefficients: *self.coefficients.clone(),
            wind,
            carried: (vector([0.0; 3]), [0.0; 3]),
            fraction: 1.0,
        })))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let of = self.given;
        let wind = stream_words(["wind", "still air"], &self.wind, of.components());
        let (chord, density) = (words::value_over(&of.chord, ""), number(of.density));
        let span = words::given(", span", of.span, "m");
        let ahead = (of.ahead.as_ref())
            .map(|ahead| format!(", centre {} chords ahead", words::value_over(ahead, "")));
        let coefficients = [
            ("lift", Some(&of.lift)),
            ("drag", of.drag.as_deref()),
            ("moment", of.moment.as_deref()),
        ];
        let coefficients = coefficients
            .into_iter()
            .filter_map(|(name, of)| Some(format!(", {name} {}", words::value_over(of?, " rad"))));
        let coefficients: String = coefficients.collect();
        let ahead = ahead.unwrap_or_default();
        LoadWords {
            kind: "airfoil".into(),
            on: words::code(self.on.name()),
            size: format!("chord {chord} m{ahead}{span}, {density} kg/m³, {wind}{coefficients}"),
        }
    }
}

/// Sections between which a strip lies, with their weights.
type Sections = [(f64, AirfoilAxes); 2];

impl ResolvedAirfoil<'_> {
    /// Velocity of the air, which an input may set, and its components at the start as written.
    pub(super) fn stream(&mut self) -> (&mut Vec<Signal>, &[Value]) {
        (&mut self.wind, self.given.components())
    }

    /// Directions in the plane, from that of a marker.
    fn angled(&self, of: Marker) -> AirfoilAxes {
        AirfoilAxes::Angle(of, self.axes[0].y.atan2(self.axes[0].x))
    }

    /// A strip with its length along the span, m, and its material coordinate.
    ///
    /// # Errors
    /// A chord below 0, or a chord or a centre without a value.
    fn strip(
        &self,
        path: &str,
        (point, sections): (Marker, Sections),
        (span, s): (f64, f64),
    ) -> Result<AirfoilStrip, Error> {
        let [chord, ahead] = self.lengths.each_ref().map(|of| of.value(s));
        for (key, value) in [("chord", chord), ("ahead", ahead)] {
            finite(&format!("{path}.{key}"), value)?;
        }
        not_negative(&format!("{path}.chord"), "m", chord)?;
        Ok(AirfoilStrip {
            point,
            sections,
            span,
            chord,
            ahead: ahead * chord,
            s,
        })
    }

    /// Strips at the Gauss points of the segments of a line.
    ///
    /// # Errors
    /// A mesh that is not possible, and as [`Self::strip`].
    fn along<const D: usize>(
        &self,
        line: Cable<'_>,
        builder: &Builder<'_, D>,
        path: &str,
    ) -> Result<Vec<AirfoilStrip>, Error> {
        let mesh = builder.segments(line)?;
        let length = line.body.shape.length();
        let has_sections = builder.sections_of(line).is_some();
        let section = |s: f64| {
            let section = builder.along(line, s);
            match D {
                2 => self.angled(section),
                _ => {
                    let axes = self.axes.map(|axis| section.directed(axis.into()));
                    AirfoilAxes::Markers(axes)
                }
            }
        };
        let mut strips = Vec::new();
        for ends in mesh.windows(2) {
            let whole = ends[1] - ends[0];
            let [first, last] = [section(ends[0]), section(ends[1])];
            for point in GAUSS_5 {
                let s = ends[0] + point.at * whole;
                let on = builder.on_line_of(line, s);
                let sections = if has_sections {
                    [(1.0 - point.at, first), (point.at, last)]
                } else {
                    [(1.0, self.angled(on)), (0.0, self.angled(on))]
                };
                strips.push(self.strip(
                    path,
                    (on, sections),
                    (point.weight * whole * length, s),
                )?);
            }
        }
        Ok(strips)
    }
}
