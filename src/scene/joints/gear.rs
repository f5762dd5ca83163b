//! Gears between coordinates of joints.

use super::*;
use crate::scene::resolved::JointCoordinate;

/// A gear between two joints: `c2 = ratio c1`, of their coordinates from the start on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gear {
    /// Name: a letter or `_`, then letters, digits and `_`; at most 100.
    pub name: String,
    /// The joints: the angle of those with an axis, else the displacement.
    pub joints: [String; 2],
    /// How much the coordinate of the second changes with that of the first: 1, m/rad, rad/m; negative where they rotate opposite ways.
    pub ratio: f64,
}

/// A gear between two joints.
#[derive(Clone, Debug)]
pub struct ResolvedGear<'a> {
    /// Name.
    pub name: &'a str,
    /// Which holder it is.
    pub holder: ConstraintOwnerId,
    /// Coordinates of the two joints that the gear couples.
    pub coordinates: [JointCoordinate<'a>; 2],
    /// Change of the second by that of the first.
    pub ratio: f64,
}

impl ResolvedGear<'_> {
    /// Names both coordinates.
    pub fn words(&self) -> [String; 2] {
        self.coordinates.map(|of| words::coordinate(&of))
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the gears.
    ///
    /// # Errors
    /// A joint that does not exist or has no coordinate, the same joint twice, or a ratio of 0.
    pub(in crate::scene) fn resolve_gears(&mut self) -> Result<(), Error> {
        for (index, gear) in self.scene.gears.iter().enumerate() {
            let path = format!("gears[{index}]");
            let coordinate = |side: usize| {
                let at = format!("{path}.joints[{side}]");
                self.require_coordinate(&at, &gear.joints[side], None, CoordinateKind::Angle)
            };
            let coordinates = [coordinate(0)?, coordinate(1)?];
            let [a, b] = &gear.joints;
            if a == b {
                let found = format!("{} twice", quoted(a));
                return Err(expected(&format!("{path}.joints"), "two joints", found));
            }
            let unit = match coordinates.map(|of| of.is_angle()) {
                [true, false] => "m/rad",
                [false, true] => "rad/m",
                _ => "1",
            };
            not_zero(&format!("{path}.ratio"), unit, gear.ratio)?;
            let holder = self.hold(&path, &gear.name);
            self.gears.push(ResolvedGear {
                name: &gear.name,
                holder,
                coordinates,
                ratio: gear.ratio,
            });
        }
        Ok(())
    }
}

impl<const D: usize> Builder<'_, D> {
    /// Builds all gears.
    pub(in crate::scene) fn gears(&mut self) {
        for ResolvedGear {
            coordinates, ratio, ..
        } in &self.resolved.gears
        {
            let related = self.related(coordinates, *ratio);
            self.hold(related, self.ends(coordinates[1].ends()));
        }
    }
}
