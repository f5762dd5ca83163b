//! Springs with dampers between two points, by tables.

use super::*;
use crate::math::curve::Curve;
use crate::system::loads::TableSpring;

/// A spring and a damper by tables between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TableSpringLoad {
    /// Ends of the spring: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the spring on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Force with which the spring pulls, by its length: two points `[length in m, force in N]` or more, by increasing length. The curve
    /// through them is cubic and monotone where they are, and straight outside.
    #[schemars(length(min = 2))]
    pub spring: Vec<[f64; 2]>,
    /// Force with which the damper pulls, by the rate of the length: points `[rate in m/s, force in N]` as of `spring`, one of them
    /// `[0, 0]`; by default there is no damper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2))]
    pub damper: Option<Vec<[f64; 2]>>,
}

/// A spring and a damper between two ends, by tables.
#[derive(Clone, Debug)]
pub struct ResolvedTableSpring<'a> {
    /// Ends of the spring.
    pub ends: Ends<'a>,
    /// Force with which the spring pulls, N, over its length, m.
    pub spring: Curve,
    /// Force with which the damper pulls, N, over the rate of the length, m/s.
    pub damper: Option<Curve>,
}

impl SceneLoad for TableSpringLoad {
    type Acting<'a> = ResolvedTableSpring<'a>;

    const EXERTS: Exerts = Exerts::Force;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let curve = |key: &str, points: &[[f64; 2]]| {
            Curve::new(points).map_err(|message| Error::new(format!("{path}.{key}"), message))
        };
        let ends = scene.require_pair(path, &self.markers, self.point)?;
        let spring = curve("spring", &self.spring)?;
        let damper = self.damper.as_ref();
        let damper = damper.map(|points| curve("damper", points)).transpose()?;
        let rests = |points: &Vec<[f64; 2]>| points.contains(&[0.0; 2]);
        if !self.damper.as_ref().is_none_or(rests) {
            let wanted = "a point [0, 0], since a damper at rest has no force";
            return Err(expected(&format!("{path}.damper"), wanted, "none"));
        }
        Ok(ResolvedTableSpring {
            ends,
            spring,
            damper,
        })
    }
}

impl<'a> ActingLoad<'a> for ResolvedTableSpring<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Ends(self.ends)
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.spring.steepest(), 0.0]
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        Ok(AppliedLoad::TableSpring(TableSpring {
            ends: builder.ends(self.ends),
            spring: self.spring.clone(),
            damper: self.damper.clone(),
        }))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        let point = words::at_point(dimension, &self.ends);
        let damper = self.damper.as_ref().map(|_| ", and over its rate");
        LoadWords {
            kind: "spring and damper by tables".into(),
            on: format!("{}{point}", words::ends(&self.ends)),
            size: format!("force over length{}", damper.unwrap_or_default()),
        }
    }
}
