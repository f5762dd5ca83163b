//! Checks of joints that can be released.

use super::checks::{expected, quoted, unknown};
use crate::scene::Error;
use crate::scene::loads::LoadPlace;
use crate::scene::resolved::{ConstraintOwnerId, InputKind, Resolved};
use crate::system::Release;

impl Resolved<'_> {
    /// Makes a joint one that an input releases.
    ///
    /// # Errors
    /// The joint does not exist.
    pub(super) fn set_release(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<(), Error> {
        let joint = self.joints.iter_mut().find(|joint| joint.name == name);
        let Some(joint) = joint else {
            return Err(self.no_joint(path, name));
        };
        joint.release.get_or_insert(Release::default()).input = Some(first);
        Ok(())
    }

    /// Makes a latch one that an input arms and opens.
    ///
    /// # Errors
    /// The latch does not exist.
    pub(super) fn set_latch(&mut self, path: &str, name: &str, first: usize) -> Result<(), Error> {
        let place = self.latch_place(path, name)?;
        self.latches[place].conditions.input = Some(first);
        Ok(())
    }

    /// Finds a latch by its name: its place in the list.
    ///
    /// # Errors
    /// The latch does not exist.
    pub(super) fn latch_place(&self, path: &str, name: &str) -> Result<usize, Error> {
        let mut latches = self.latches.iter();
        let known = self.latches.iter().map(|latch| latch.name);
        let place = latches.position(|latch| latch.name == name);
        place.ok_or_else(|| unknown(path, "a latch of this scene", name, known))
    }

    /// Checks that joints with a release have no spring, and that nothing acts on or drives their coordinates.
    ///
    /// # Errors
    /// A joint that breaks this rule.
    pub(super) fn check_releases(&self) -> Result<(), Error> {
        let acting = self.acting();
        for joint in self.joints.iter().filter(|joint| joint.release.is_some()) {
            let path = format!("joints[{}]", joint.index);
            let acts = acting.iter().find(|(on, _)| *on == joint.holder);
            let found = match (joint.spring(), acts) {
                (Some(_), _) => "a spring of its own".into(),
                (None, Some((_, name))) => quoted(name),
                (None, None) => continue,
            };
            let wanted = "nothing that acts on the coordinates of a joint that can be released";
            return Err(expected(&path, wanted, found));
        }
        Ok(())
    }

    /// Joints on whose coordinates something acts, and its name.
    fn acting(&self) -> Vec<(ConstraintOwnerId, &str)> {
        let mut found = Vec::new();
        for gear in &self.gears {
            found.extend(gear.coordinates.iter().map(|on| (on.joint(), gear.name)));
        }
        for latch in &self.latches {
            found.push((latch.coordinate.joint(), latch.name));
        }
        for motion in &self.motions {
            if let LoadPlace::Coordinate(on) = motion.driven.quantity().place {
                found.push((on.joint(), motion.name));
            }
        }
        for load in &self.loads {
            if let LoadPlace::Coordinate(on) = load.kind.place() {
                found.push((on.joint(), load.name));
            }
        }
        for input in &self.inputs {
            if let InputKind::Action(action) = &input.kind
                && let LoadPlace::Coordinate(on) = action.on
            {
                found.push((on.joint(), action.kind.words()[0]));
            }
        }
        found
    }
}
