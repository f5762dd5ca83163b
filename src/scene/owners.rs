//! Which bodies an output belongs to.

use super::resolved::Resolved;

impl Resolved<'_> {
    /// Places of the bodies that an output is read at, by its name without an index: of a joint, motion, load or port those that it joins,
    /// moves or acts on.
    pub fn bodies_read_by(&self, output: &str) -> Vec<usize> {
        let Some((first, _)) = output.split_once('.') else {
            return Vec::new();
        };
        let bodies = self.bodies.iter().enumerate();
        let bodies = bodies.filter(|(_, body)| body.name() == first);
        let mut found: Vec<usize> = bodies.map(|(index, _)| index).collect();
        for joint in self.joints.iter().filter(|joint| joint.name == first) {
            found.extend(joint.ends.bodies());
        }
        for motion in self.motions.iter().filter(|motion| motion.name == first) {
            found.extend(motion.driven.quantity().place.bodies());
        }
        for load in self.loads.iter().filter(|load| load.name == first) {
            found.extend(load.kind.bodies());
        }
        let ports = self.ports.iter().filter(|port| port.name == first);
        found.extend(ports.map(|port| port.marker.place.body_index()));
        found.sort_unstable();
        found.dedup();
        found
    }
}
