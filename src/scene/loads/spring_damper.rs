//! Springs with dampers between two points.

use super::*;
use crate::math::function::Function;
use crate::system::loads::Spring;

/// A spring and a damper between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringDamper {
    /// Ends of the spring: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: end of the spring on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Stiffness, N/m; 0 by default. A stiffness or a damping is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping, N s/m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Length at rest, m; by default the distance of the ends at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Value>,
}

/// A spring and a damper between two ends.
#[derive(Clone, Debug)]
pub struct ResolvedSpring<'a> {
    /// As described.
    pub given: &'a SpringDamper,
    /// Ends of the spring.
    pub ends: Ends<'a>,
    /// Length at rest, m; the distance at the start if there is none.
    pub length: Option<Signal>,
}

impl SceneLoad for SpringDamper {
    type Acting<'a> = ResolvedSpring<'a>;

    const EXERTS: Exerts = Exerts::Force;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let ends = scene.require_pair(path, &self.markers, self.point)?;
        spring_damper(path, self.stiffness, self.damping, spring_units(false))?;
        let length = rest_length::course(path, self.length.as_ref(), not_negative)?;
        Ok(ResolvedSpring {
            given: self,
            ends,
            length,
        })
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        rest_length::timed(self.length.as_ref())
    }

    fn numbers(&mut self, _on: LoadExtent) -> Vec<LoadNumber<'_>> {
        damper(
            spring_units(false),
            Optional(&mut self.stiffness),
            Optional(&mut self.damping),
        )
    }
}

impl ResolvedSpring<'_> {
    /// Length at rest, which an input may set.
    pub(super) fn rest_length(&mut self) -> RestLength<'_> {
        RestLength {
            start: rest_length::at_start(self.given.length.as_ref(), || self.ends.distance()),
            course: &mut self.length,
        }
    }
}

impl<'a> ActingLoad<'a> for ResolvedSpring<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Ends(self.ends)
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.given.stiffness.unwrap_or_default(), 0.0]
    }

    fn has_tension(&self) -> bool {
        true
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let ends = builder.ends(self.ends);
        let now = || Signal::Function(Function::Constant(builder.distance_at_start(&ends)));
        Ok(AppliedLoad::Spring(Spring {
            ends,
            stiffness: self.given.stiffness.unwrap_or_default(),
            damping: self.given.damping.unwrap_or_default(),
            length: self.length.clone().unwrap_or_else(now),
        }))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        let first = words::code(self.ends.first_name());
        let point = words::at_point(dimension, &self.ends);
        let sizes = [self.given.stiffness, self.given.damping];
        let [k, c] = sizes.map(|size| number(size.unwrap_or_default()));
        let length = self.given.length.as_ref().map_or(String::new(), |length| {
            format!(", length at rest {} m", words::value(length))
        });
        LoadWords {
            kind: "spring and damper".into(),
            on: format!("{first}{point}, {}", words::code(self.ends.second.name)),
            size: format!("{k} N/m, {c} N·s/m{length}"),
        }
    }
}
