//! Strips of airfoils at markers.

use nalgebra::Vector3;

use super::fluid::stream_words;
use super::*;
use crate::math::function::Function;
use crate::math::space::vector;
use crate::math::state_expression::StateExpression;
use crate::scene::validate::checks::direction;
use crate::system::loads::{Airfoil, AirfoilAxes, AirfoilCoefficient, StateLaw};

/// Variables of expressions of coefficients.
const VARIABLES: [&str; 2] = ["a", "q"];

/// Lift, drag and moment of a strip of an airfoil.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AirfoilLoad {
    /// Marker at the aerodynamic centre of the strip, about which the moment is: of a rigid body with inertia, of a rod or beam, or of a
    /// cable in the plane.
    pub marker: String,
    /// Direction from the leading to the trailing edge, of any length: along the axes of the frame of a rigid body, or of the section of a
    /// rod or beam (tangent, first axis, second axis). In the plane along the direction of the marker and to its left.
    pub chord_direction: SceneVector,
    /// In space, direction of the lift at no angle of attack, along the same axes, of any length. What of it is along the chord does not
    /// count. In the plane it is the chord rotated left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lift_direction: Option<SceneVector>,
    /// Chord, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub chord: f64,
    /// Length of the strip along the span, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub span: f64,
    /// Density of the air, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Velocity of the air in global axes, m/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 3))]
    pub wind: Option<Vec<Value>>,
    /// Coefficient of lift for chord times span: a number, a table over the angle of attack in rad, whose ends hold outside of it, or an
    /// expression in the angle of attack `a` (rad, between -pi and pi), in the reduced rate of pitch `q`, nose up, and in the time `t`. `q` is
    /// the rate in rad/s times the chord over twice the speed of the air.
    pub lift: Value,
    /// Coefficient of drag for chord times span, as `lift`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drag: Option<Value>,
    /// Coefficient of the moment about the marker, nose up, for the square of the chord times span, as `lift`; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment: Option<Value>,
}

/// A strip of an airfoil with its references resolved.
#[derive(Clone, Debug)]
pub struct ResolvedAirfoil<'a> {
    /// As described.
    given: &'a AirfoilLoad,
    /// Aerodynamic centre.
    marker: ResolvedMarker<'a>,
    /// Unit vectors along the chord and across it, along axes of the body.
    axes: [Vector3<f64>; 2],
    /// Coefficients of lift, drag and moment.
    coefficients: [AirfoilCoefficient; 3],
    /// Velocity of the air, m/s.
    wind: Vec<Signal>,
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

/// Reads a coefficient.
fn coefficient(path: &str, of: Option<&Value>) -> Result<AirfoilCoefficient, Error> {
    Ok(match of {
        None => AirfoilCoefficient::Curve(Function::constant(0.0)),
        Some(Value::Expression(text)) => {
            let read = StateExpression::with_names(text, &VARIABLES);
            let read = read.map_err(|message| Error::new(path, message))?;
            AirfoilCoefficient::Expression(StateLaw::new(read))
        }
        Some(other) => AirfoilCoefficient::Curve(value(path, other, false)?),
    })
}

impl SceneLoad for AirfoilLoad {
    type Acting<'a> = ResolvedAirfoil<'a>;

    const EXERTS: Exerts = Exerts::Force;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let at = |key: &str| format!("{path}.{key}");
        let dimension = scene.scene.dimension;
        let marker = scene.require_spinning(&at("marker"), &self.marker)?;
        for (key, unit, value) in [
            ("chord", "m", self.chord),
            ("span", "m", self.span),
            ("density", "kg/m^3", self.density),
        ] {
            positive(&at(key), unit, value)?;
        }
        scene.require_still_frame("air")?;
        let rest = vec![Value::Number(0.0); dimension];
        let wind = self.wind.as_ref().unwrap_or(&rest);
        let wind = components(&at("wind"), dimension, wind, |path, of| {
            value(path, of, false).map(Signal::Function)
        })?;
        Ok(ResolvedAirfoil {
            given: self,
            marker,
            axes: self.directions(path, dimension)?,
            coefficients: [
                coefficient(&at("lift"), Some(&self.lift))?,
                coefficient(&at("drag"), self.drag.as_ref())?,
                coefficient(&at("moment"), self.moment.as_ref())?,
            ],
            wind,
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
        vec![
            LoadNumber::new("chord", "Chord", Some(METRE), Needed(&mut self.chord)),
            LoadNumber::new(
                "span",
                "Length along the span",
                Some(METRE),
                Needed(&mut self.span),
            ),
            LoadNumber::new(
                "density",
                "Density of the air",
                Some(DENSITY),
                Needed(&mut self.density),
            ),
        ]
    }
}

impl<'a> ActingLoad<'a> for ResolvedAirfoil<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Marker(self.marker)
    }

    fn is_one_sided(&self) -> bool {
        let mut coefficients = self.coefficients.iter();
        coefficients.any(AirfoilCoefficient::has_kinks)
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let point = builder.marker(self.marker);
        let axes = match D {
            2 => AirfoilAxes::Angle(self.axes[0].y.atan2(self.axes[0].x)),
            _ => {
                let axes = self.axes.map(|axis| builder.directed(self.marker, axis));
                AirfoilAxes::Markers(Box::new(axes))
            }
        };
        Ok(AppliedLoad::Airfoil(Box::new(Airfoil {
            point,
            axes,
            inert: 0.5 * self.given.density * self.given.chord * self.given.span,
            chord: self.given.chord,
            coefficients: self.coefficients.clone(),
            wind: std::array::from_fn(|k| self.wind[k].clone()),
            carried: (vector([0.0; 3]), [0.0; 3]),
            fraction: 1.0,
        })))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let of = self.given;
        let wind = stream_words(["wind", "still air"], &self.wind, of.components());
        let [chord, span, density] = [of.chord, of.span, of.density].map(number);
        let coefficients = [
            ("lift", Some(&of.lift)),
            ("drag", of.drag.as_ref()),
            ("moment", of.moment.as_ref()),
        ];
        let coefficients = coefficients
            .into_iter()
            .filter_map(|(name, value)| Some(format!(", {name} {}", words::value(value?))));
        let coefficients: String = coefficients.collect();
        LoadWords {
            kind: "airfoil".into(),
            on: words::code(self.marker.name),
            size: format!("chord {chord} m, span {span} m, {density} kg/m³, {wind}{coefficients}"),
        }
    }
}

impl ResolvedAirfoil<'_> {
    /// Velocity of the air, which an input may set, and its components at the start as written.
    pub(super) fn stream(&mut self) -> (&mut Vec<Signal>, &[Value]) {
        (&mut self.wind, self.given.components())
    }
}
