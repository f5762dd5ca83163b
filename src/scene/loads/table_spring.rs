//! Springs with dampers by tables, between two points or on coordinates of joints.

use super::measure::ResolvedMeasure;
use super::*;
use crate::math::curve::Curve;
use crate::system::loads::TableSpring;

/// A spring and a damper by tables, between two points or on a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TableSpringLoad {
    /// Ends: `ground` or `body.marker`, then `body.marker`. The load acts along the line between them. Either these or `joint`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub markers: Option<[String; 2]>,
    /// With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Name of the joint on whose coordinate the load acts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Coordinate of the joint that the load acts on; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Force of the spring against growth, by the length or the coordinate: two points `[m, N]` or more (`[rad, N m]` of an angle), in
    /// increasing order. The curve through them is cubic and monotone where they are, and straight outside.
    #[schemars(length(min = 2))]
    pub spring: Vec<[f64; 2]>,
    /// Force of the damper against growth, by the rate: points `[m/s, N]` as of `spring` (`[rad/s, N m]` of an angle), one of them `[0, 0]`;
    /// by default there is no damper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2))]
    pub damper: Option<Vec<[f64; 2]>>,
}

/// A spring and a damper by tables, between two ends or on a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ResolvedTableSpring<'a> {
    /// Length or coordinate.
    on: ResolvedMeasure<'a>,
    /// Force of the spring against growth, N or N m, over length or coordinate, m or rad.
    spring: Curve,
    /// Force of the damper against growth, N or N m, over the rate, m/s or rad/s.
    damper: Option<Curve>,
}

impl SceneLoad for TableSpringLoad {
    type Acting<'a> = ResolvedTableSpring<'a>;

    const EXERTS: Exerts = Exerts::ByCoordinate;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let curve = |key: &str, points: &[[f64; 2]]| {
            Curve::new(points).map_err(|message| Error::new(format!("{path}.{key}"), message))
        };
        let between = (self.markers.as_ref(), self.point);
        let on = scene.require_measure(path, between, (self.joint.as_deref(), self.coordinate))?;
        let spring = curve("spring", &self.spring)?;
        let damper = self.damper.as_ref();
        let damper = damper.map(|points| curve("damper", points)).transpose()?;
        let rests = |points: &Vec<[f64; 2]>| points.contains(&[0.0; 2]);
        if !self.damper.as_ref().is_none_or(rests) {
            let wanted = "a point [0, 0], since a damper at rest has no force";
            return Err(expected(&format!("{path}.damper"), wanted, "none"));
        }
        Ok(ResolvedTableSpring { on, spring, damper })
    }
}

impl<'a> ActingLoad<'a> for ResolvedTableSpring<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.on.place()
    }

    fn stiffness(&self) -> [f64; 2] {
        self.on.stiffness(self.spring.steepest())
    }

    fn has_tension(&self) -> bool {
        matches!(self.on, ResolvedMeasure::Length(_))
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        Ok(AppliedLoad::TableSpring(TableSpring {
            on: Box::new(builder.measure(&self.on)),
            spring: self.spring.clone(),
            damper: self.damper.clone(),
        }))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        let damper = self.damper.as_ref().map(|_| ", and over its rate");
        let over = if matches!(self.on, ResolvedMeasure::Length(_)) {
            "length"
        } else {
            "coordinate"
        };
        LoadWords {
            kind: "spring and damper by tables".into(),
            on: self.on.words(dimension),
            size: format!("force over {over}{}", damper.unwrap_or_default()),
        }
    }
}
