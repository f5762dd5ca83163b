//! Checks of gears.

use super::checks::{expected, not_zero, quoted};
use crate::scene::Error;
use crate::scene::description::CoordinateKind;
use crate::scene::resolved::{Resolved, ResolvedGear};

impl<'a> Resolved<'a> {
    /// Resolves the gears.
    ///
    /// # Errors
    /// A joint that does not exist or has no coordinate, the same joint twice, or a ratio of 0.
    pub(super) fn resolve_gears(&mut self) -> Result<(), Error> {
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
