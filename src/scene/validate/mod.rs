//! Checks that a scene means something, and finds what its names refer to.

mod accuracy;
mod bodies;
pub(super) mod checks;
mod inputs;
mod lines;
mod outputs;
mod patch;
mod ports;
mod profiles;
mod reduced;
mod references;
mod releases;
mod sections;
mod stress;
mod surface;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use super::resolved::{ConstraintOwner, ConstraintOwnerId, Resolved};
use super::{Error, InitialState, PatchBody, Scene};
pub(super) use references::refuse_point;

use checks::{expected, name, positive, scene_name, sentence, spin, vector};

/// Numbers of elements of a body: the limit on memory is far beyond any use.
pub const ELEMENTS: RangeInclusive<u32> = 1..=100_000;
/// Natural modes of a line that is reduced to them.
pub const LINE_MODES: RangeInclusive<u32> = 0..=12;
/// Elements of all bodies together: what a computer of today holds.
const ALL_ELEMENTS: u64 = 1_000_000;
/// Relative tolerances. Below, the error of a step drowns in roundoff whatever moves. Above, it is none at all.
pub const TOLERANCE: RangeInclusive<f64> = 1e-14..=0.1;
impl Scene {
    /// Checks every value of the scene and resolves every reference.
    ///
    /// # Errors
    /// The first value that is out of range or refers to nothing.
    pub fn resolve(&self) -> Result<Resolved<'_>, Error> {
        scene_name(&self.name)?;
        for (key, text) in self.about.texts() {
            sentence(&format!("about.{key}"), text)?;
        }
        if ![2, 3].contains(&self.dimension) {
            let wanted = "2 (the plane) or 3 (space)";
            return Err(expected("dimension", wanted, self.dimension));
        }
        vector("gravity", self.dimension, &self.gravity)?;
        spin("rotation", self.dimension, &self.rotation)?;
        self.validate_names()?;
        self.validate_bodies()?;
        let mut resolved = Resolved::bare(self);
        resolved.resolve_masses()?;
        resolved.resolve_joints()?;
        resolved.resolve_gears()?;
        resolved.resolve_latches()?;
        resolved.resolve_motions()?;
        resolved.resolve_loads()?;
        resolved.resolve_inputs()?;
        resolved.resolve_outputs()?;
        resolved.resolve_ports()?;
        resolved.resolve_initial()?;
        resolved.check_releases()?;
        resolved.check_winches()?;
        resolved.check_stiffeners()?;
        positive("experiment.stop_time", "s", self.experiment.stop_time)?;
        positive("experiment.step", "s", self.experiment.step)?;
        self.validate_accuracy()?;
        positive(
            "method.work_limit",
            "evaluations times parts",
            self.method.work_limit,
        )?;
        Ok(resolved)
    }

    /// The scene with its references resolved.
    ///
    /// # Panics
    /// When the scene is not valid: one that was read is, but values may have been changed since. Where
    /// that may be, [`Self::resolve`] says what is wrong.
    pub fn resolved(&self) -> Resolved<'_> {
        self.resolve().expect("a valid scene")
    }

    /// Bodies, joints, gears, latches, motions, loads and ports share their names.
    fn validate_names(&self) -> Result<(), Error> {
        let mut names = BTreeSet::new();
        let bodies = self.bodies.iter().map(|body| body.name());
        let joints = self.joints.iter().map(|joint| joint.name.as_str());
        let gears = self.gears.iter().map(|gear| gear.name.as_str());
        let latches = self.latches.iter().map(|latch| latch.name.as_str());
        let motions = self.motions.iter().map(|motion| motion.name.as_str());
        let loads = self.loads.iter().map(|load| load.name.as_str());
        let ports = self.ports.iter().map(|port| port.name.as_str());
        let initial = self.initial.loads().iter().map(|load| load.name.as_str());
        let named = |list: &'static str| move |(i, name)| (format!("{list}[{i}].name"), name);
        let all = bodies.enumerate().map(named("bodies"));
        let all = all.chain(joints.enumerate().map(named("joints")));
        let all = all.chain(gears.enumerate().map(named("gears")));
        let all = all.chain(latches.enumerate().map(named("latches")));
        let all = all.chain(motions.enumerate().map(named("motions")));
        let all = all.chain(loads.enumerate().map(named("loads")));
        let all = all.chain(initial.enumerate().map(named("initial.loads")));
        for (path, text) in all.chain(ports.enumerate().map(named("ports"))) {
            name(&path, text, &mut names)?;
        }
        Ok(())
    }

    /// Elements of all bodies together.
    pub(super) fn elements(&self) -> u64 {
        let cables = self.bodies.iter().filter_map(|body| body.flexible());
        let counts = cables.map(|cable| cable.elements.unwrap_or(1));
        let patches = self.bodies.iter().filter_map(|body| body.patch());
        counts
            .map(u64::from)
            .chain(patches.map(PatchBody::elements))
            .sum()
    }

    fn validate_bodies(&self) -> Result<(), Error> {
        if self.bodies.is_empty() {
            return Err(expected("bodies", "at least one body", "none"));
        }
        for (index, body) in self.bodies.iter().enumerate() {
            let path = format!("bodies[{index}]");
            body.validate(&path, self.dimension)?;
        }
        let elements: u64 = self.elements();
        if elements > ALL_ELEMENTS {
            let wanted = format!("at most {ALL_ELEMENTS} elements in all bodies together");
            return Err(expected("bodies", &wanted, elements));
        }
        Ok(())
    }
}

impl<'a> Resolved<'a> {
    fn resolve_initial(&mut self) -> Result<(), Error> {
        let scene = self.scene;
        let state = scene.initial.state();
        if state == InitialState::Undeformed && !scene.initial.loads().is_empty() {
            let wanted = "a state that loads act on, static_equilibrium or steady";
            return Err(expected("initial.state", wanted, "undeformed"));
        }
        if state == InitialState::Steady && scene.turns() {
            let wanted = "0 where the initial state is steady";
            return Err(expected(
                "rotation",
                wanted,
                format!("{:?}", scene.rotation.full()),
            ));
        }
        self.resolve_initial_loads()
    }

    /// Numbers what holds something in the system.
    pub(super) fn hold(&mut self, path: &str, name: &'a str) -> ConstraintOwnerId {
        self.holders.push(ConstraintOwner {
            path: path.into(),
            name,
        });
        ConstraintOwnerId(self.holders.len() - 1)
    }

    /// Places for as many numbers that the master sets; gives back the first.
    pub(super) fn place(&mut self, count: usize) -> usize {
        self.numbers += count;
        self.numbers - count
    }
}
