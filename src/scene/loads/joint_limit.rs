//! Limits of coordinates of joints.

use super::*;
use crate::system::loads::{JointLimit, OneSidedSpring};

/// Limits of a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointLimitLoad {
    /// Name of the joint whose coordinate is limited.
    pub joint: String,
    /// Coordinate of the joint that is limited; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Stiffness `k` beyond a limit, N/m for a displacement and N m/rad for an angle.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping `a` in the force `k d (1 + a d')` at the coordinate `d` beyond a limit, s/m or s/rad; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Least coordinate without force, m or rad; by default there is no lower limit. One of both limits is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<f64>,
    /// Largest coordinate without force, m or rad; by default there is no upper limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
}

/// Limits of a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ResolvedJointLimit<'a> {
    /// As described.
    given: &'a JointLimitLoad,
    /// Coordinate that is limited.
    on: JointCoordinate<'a>,
}

/// Units of stiffness and damping.
fn units(is_angle: bool) -> [Unit; 2] {
    if is_angle {
        [NEWTON_METRE_PER_RADIAN, SECOND_PER_RADIAN]
    } else {
        [NEWTON_PER_METRE, SECOND_PER_METRE]
    }
}

impl SceneLoad for JointLimitLoad {
    type Acting<'a> = ResolvedJointLimit<'a>;

    const EXERTS: Exerts = Exerts::ByCoordinate;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let on = scene.require_loaded(path, &self.joint, self.coordinate)?;
        let units = units(on.is_angle()).map(|unit| unit.text());
        positive(&format!("{path}.stiffness"), &units[0], self.stiffness)?;
        let damping = self.damping.unwrap_or_default();
        not_negative(&format!("{path}.damping"), &units[1], damping)?;
        for (key, limit) in [("lower", self.lower), ("upper", self.upper)] {
            if let Some(limit) = limit {
                finite(&format!("{path}.{key}"), limit)?;
            }
        }
        match [self.lower, self.upper] {
            [None, None] => Err(expected(path, "a lower or an upper limit", "neither")),
            [Some(lower), Some(upper)] if lower > upper => {
                let wanted = format!("a limit that is not below `lower`, {lower}");
                Err(expected(&format!("{path}.upper"), &wanted, upper))
            }
            _ => Ok(ResolvedJointLimit { given: self, on }),
        }
    }

    fn numbers(&mut self, on: LoadExtent) -> Vec<LoadNumber<'_>> {
        damper(
            units(on == LoadExtent::Angle),
            Needed(&mut self.stiffness),
            Optional(&mut self.damping),
        )
    }
}

impl<'a> ActingLoad<'a> for ResolvedJointLimit<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Coordinate(self.on)
    }

    fn stiffness(&self) -> [f64; 2] {
        self.on.stiffness(self.given.stiffness)
    }

    fn is_one_sided(&self) -> bool {
        true
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        Ok(AppliedLoad::JointLimit(JointLimit {
            coordinate: Box::new(builder.coordinate(&self.on)),
            limits: [
                self.given.lower.unwrap_or(f64::NEG_INFINITY),
                self.given.upper.unwrap_or(f64::INFINITY),
            ],
            spring: OneSidedSpring {
                stiffness: self.given.stiffness,
                damping: self.given.damping.unwrap_or_default(),
            },
        }))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let sizes = [self.given.stiffness, self.given.damping.unwrap_or_default()];
        let [k, a] = sizes.map(number);
        let [by_way, by_rate] = units(self.on.is_angle()).map(|unit| unit.symbol());
        let sides = [(", below", self.given.lower), (", above", self.given.upper)];
        let sides = sides.map(|(side, limit)| words::given(side, limit, self.on.unit().name));
        LoadWords {
            kind: "joint limit".into(),
            on: words::coordinate(&self.on),
            size: format!("{k} {by_way}, {a} {by_rate}{}", sides.concat()),
        }
    }
}

impl<'a> ResolvedLoadKind<'a> {
    /// Coordinate of a joint and its limits below and above, if the load limits one.
    pub fn limits(&self) -> Option<(JointCoordinate<'a>, [Option<f64>; 2])> {
        match self {
            Self::JointLimit(limit) => Some((limit.on, [limit.given.lower, limit.given.upper])),
            _ => None,
        }
    }
}
