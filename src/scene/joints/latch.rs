//! Latches on coordinates of joints.

use super::*;
use crate::scene::description::is_false;
use crate::scene::resolved::JointCoordinate;
use crate::system::joints::LatchConditions;

/// A latch: it closes when the coordinate of a joint passes a value, and holds it there. It closes as in a plastic impact: no
/// energy is won, and momentum is kept where nothing holds the bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Latch {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// The joint whose coordinate is held.
    pub joint: String,
    /// Which coordinate of the joint; by default the angle of one with an axis, else the displacement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Value of the coordinate that the latch holds, m or rad; by default that in the shapes and positions of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// Whether it is closed at the start. The scene is then put together with the coordinate at `at`.
    #[serde(default, skip_serializing_if = "is_false")]
    pub closed: bool,
    /// Time from which on it may close, s.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub from_time: f64,
    /// Least force on the coordinate (N, or N m for an angle): below it the latch opens. By default there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_force: Option<f64>,
    /// Largest force on the coordinate (N, or N m for an angle): above it the latch opens. By default there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most_force: Option<f64>,
    /// Time at which it opens for good, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub release_time: Option<f64>,
}

/// A latch with its references resolved.
#[derive(Clone, Debug)]
pub struct ResolvedLatch<'a> {
    /// Name.
    pub name: &'a str,
    /// Which holder it is.
    pub holder: ConstraintOwnerId,
    /// Coordinate that it holds.
    pub coordinate: JointCoordinate<'a>,
    /// Value that it holds, m or rad, where one is given.
    pub at: Option<f64>,
    /// When it closes and opens.
    pub conditions: LatchConditions,
    /// Time at which it opens for good, s.
    pub release_time: Option<f64>,
}

impl ResolvedLatch<'_> {
    /// Describes the coordinate, the value, and when the latch closes and opens.
    pub fn words(&self) -> [String; 3] {
        let [unit, force] = if self.coordinate.is_angle() {
            ["rad", "N m"]
        } else {
            ["m", "N"]
        };
        let at = match self.at {
            Some(at) => format!("{} {unit}", number(at)),
            None => "as drawn".into(),
        };
        let conditions = &self.conditions;
        let start = if conditions.is_closed {
            "closed"
        } else {
            "open"
        };
        let mut found = vec![start.to_owned()];
        if conditions.from > 0.0 {
            found.push(format!("may close from {} s on", number(conditions.from)));
        }
        if conditions.input.is_some() {
            found.push("armed and opened by an input".into());
        }
        let [least, most] = conditions.range;
        if least.is_finite() {
            found.push(format!("opens below {} {force}", number(least)));
        }
        if most.is_finite() {
            found.push(format!("opens above {} {force}", number(most)));
        }
        if let Some(time) = self.release_time {
            found.push(format!("opens for good at {} s", number(time)));
        }
        [words::coordinate(&self.coordinate), at, found.join("; ")]
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the latches.
    ///
    /// # Errors
    /// A joint that does not exist or has no such coordinate, or a value out of range.
    pub(in crate::scene) fn resolve_latches(&mut self) -> Result<(), Error> {
        for (index, latch) in self.scene.latches.iter().enumerate() {
            let path = format!("latches[{index}]");
            let at = |key: &str| format!("{path}.{key}");
            let (joint, kind) = (at("joint"), CoordinateKind::Angle);
            let coordinate =
                self.require_coordinate(&joint, &latch.joint, latch.coordinate, kind)?;
            let [least, most] = [latch.least_force, latch.most_force];
            let values = [
                ("at", latch.at),
                ("least_force", least),
                ("most_force", most),
            ];
            for (key, value) in values {
                finite(&at(key), value.unwrap_or(0.0))?;
            }
            not_negative(&at("from_time"), "s", latch.from_time)?;
            not_negative(&at("release_time"), "s", latch.release_time.unwrap_or(0.0))?;
            let range = [
                least.unwrap_or(f64::NEG_INFINITY),
                most.unwrap_or(f64::INFINITY),
            ];
            if range[0] >= range[1] {
                let wanted = format!("more than least_force = {}", number(range[0]));
                return Err(expected(&at("most_force"), &wanted, range[1]));
            }
            let holder = self.hold(&path, &latch.name);
            self.latches.push(ResolvedLatch {
                name: &latch.name,
                holder,
                coordinate,
                at: latch.at,
                conditions: LatchConditions {
                    is_closed: latch.closed,
                    from: latch.from_time,
                    input: None,
                    range,
                },
                release_time: latch.release_time,
            });
        }
        Ok(())
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds all latches.
    pub(in crate::scene) fn latches(&mut self) {
        for latch in &self.resolved.latches {
            let coordinate = self.coordinate(&latch.coordinate);
            let offset = latch.at.unwrap_or_else(|| self.at_start(&coordinate));
            let ends = coordinate.ends();
            let release = Release {
                time: latch.release_time,
                input: None,
                latch: Some(latch.conditions),
                friction: None,
            };
            let held = self.held(coordinate, offset, None);
            self.hold_until(Some(release), held, ends);
        }
    }
}
