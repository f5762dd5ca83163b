//! Dry friction on coordinates of joints.

use super::*;
use crate::system::joints::Release;
use crate::system::loads::JointFriction;
use crate::system::{Drive, FrictionState};

/// Dry friction on a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointFrictionLoad {
    /// Name of the joint that has friction.
    pub joint: String,
    /// Coordinate of the joint with friction; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Force against sliding, N for a displacement and N m for an angle. A number, an expression in `t` or a table; where it is negative
    /// there is no friction.
    pub force: Value,
    /// Largest force while the coordinate sticks, in parts of that against sliding; 1 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1.0))]
    pub static_ratio: Option<f64>,
    /// Speed `w` of sliding over which the force falls from the largest one to that against sliding, m/s or rad/s: by `exp(-(v/w)^2)` (Stribeck); 0
    /// by default, for at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stribeck_speed: Option<f64>,
}

/// Dry friction on a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ResolvedJointFriction<'a> {
    /// As described.
    given: &'a JointFrictionLoad,
    /// Coordinate with friction.
    on: JointCoordinate<'a>,
    /// Force against sliding, N or N m.
    force: Signal,
}

/// Units of the force and of the speed.
fn units(is_angle: bool) -> [Unit; 2] {
    if is_angle {
        [NEWTON_METRE, RADIAN_PER_SECOND]
    } else {
        [NEWTON, METRE_PER_SECOND]
    }
}

/// Checks the largest friction at rest over that while sliding, of a load with this path.
///
/// # Errors
/// It is less than 1.
pub(super) fn check_static_ratio(path: &str, ratio: Option<f64>) -> Found<()> {
    match ratio {
        Some(ratio) if !(ratio.is_finite() && ratio >= 1.0) => {
            let at = format!("{path}.static_ratio");
            Err(expected(&at, "a number from 1 on", ratio))
        }
        _ => Ok(()),
    }
}

impl SceneLoad for JointFrictionLoad {
    type Acting<'a> = ResolvedJointFriction<'a>;

    const EXERTS: Exerts = Exerts::ByCoordinate;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let on = scene.require_loaded(path, &self.joint, self.coordinate)?;
        let at = |key: &str| format!("{path}.{key}");
        let force = Signal::Function(value(&at("force"), &self.force, false)?);
        check_static_ratio(path, self.static_ratio)?;
        let unit = units(on.is_angle())[1].text();
        let speed = self.stribeck_speed.unwrap_or_default();
        not_negative(&at("stribeck_speed"), &unit, speed)?;
        Ok(ResolvedJointFriction {
            given: self,
            on,
            force,
        })
    }

    fn timed(&self) -> Option<TimedKey<'_>> {
        Some(TimedKey {
            key: "force",
            values: std::slice::from_ref(&self.force),
            order: 0,
        })
    }

    fn numbers(&mut self, on: LoadExtent) -> Vec<LoadNumber<'_>> {
        let [_, speed] = units(on == LoadExtent::Angle);
        let (key, what) = ("stribeck_speed", "Speed over which the force falls");
        let of = Optional(&mut self.stribeck_speed);
        vec![LoadNumber::new(key, what, Some(speed), of)]
    }
}

impl<'a> ActingLoad<'a> for ResolvedJointFriction<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Coordinate(self.on)
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let coordinate = builder.coordinate(&self.on);
        let place = builder.parts.drives.len();
        builder.parts.drives.extend([Drive::Kept, Drive::Kept]);
        let state = FrictionState {
            place,
            direction: place + 1,
        };
        let release = Release {
            friction: Some(state),
            ..Release::default()
        };
        let ends = coordinate.ends();
        let held = builder.held(coordinate.clone(), 0.0, Some(place));
        builder.hold_until(Some(release), held, ends);
        Ok(AppliedLoad::JointFriction(JointFriction {
            coordinate: Box::new(coordinate),
            force: self.force.clone(),
            static_ratio: self.given.static_ratio.unwrap_or(1.0),
            stribeck_speed: self.given.stribeck_speed.unwrap_or_default(),
            state,
        }))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let [force, speed] = units(self.on.is_angle());
        let mut size = format!("{} {}", words::value(&self.given.force), force.symbol());
        if let Some(ratio) = self.given.static_ratio {
            size += &format!(", {} times that while it sticks", number(ratio));
        }
        size += &words::given(", falls over", self.given.stribeck_speed, speed.name);
        LoadWords {
            kind: "dry friction".into(),
            on: words::coordinate(&self.on),
            size,
        }
    }
}

impl<'a> Resolved<'a> {
    /// Makes the force of friction against sliding an input; what it was, N or N m.
    ///
    /// # Errors
    /// There is no such load, or its force changes in time.
    pub(in crate::scene) fn set_friction(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<f64, Error> {
        let wanted = "a joint_friction of this scene";
        let friction = self.require_load(path, name, wanted, |load| match load {
            ResolvedLoadKind::JointFriction(friction) => Some(friction),
            _ => None,
        })?;
        let Value::Number(force) = friction.given.force else {
            let wanted = "friction whose force is a number";
            let found = format!("{}, whose force changes in time", quoted(name));
            return Err(expected(path, wanted, found));
        };
        friction.force = Signal::Input(first);
        Ok(force)
    }
}

impl ResolvedLoadKind<'_> {
    /// Whether it is friction of a joint, which a constraint belongs to.
    pub fn is_friction(&self) -> bool {
        matches!(self, Self::JointFriction(_))
    }
}
