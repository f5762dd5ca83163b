//! Which bodies an output belongs to.

use super::Scene;
use super::description::{
    BushingLoad, ContactLoad, DistributedForceLoad, DistributedMomentLoad, FluidLoad, ForceLoad,
    JointLimitLoad, JointSpringLoad, LoadKind, MomentLoad, SpringDamper, TableSpringLoad, Torque,
};

impl Scene {
    /// Places of the bodies that an output is read at, by its name without an index: of a joint, motion, load or port those that it joins,
    /// moves or acts on.
    pub fn bodies_read_by(&self, output: &str) -> Vec<usize> {
        let Some((first, _)) = output.split_once('.') else {
            return Vec::new();
        };
        let owner = |marker: &str| marker.split('.').next().unwrap_or_default().to_owned();
        let joint = |name: &str| self.joints.iter().find(|joint| joint.name == name);
        let of_joint = |name: &str| -> Vec<String> {
            let markers =
                joint(name).map(|joint| joint.kind.markers().iter().map(|marker| owner(marker)));
            markers.into_iter().flatten().collect()
        };
        let mut names = vec![first.to_owned()];
        names.extend(of_joint(first));
        for motion in self.motions.iter().filter(|motion| motion.name == first) {
            names.extend(motion.kind.marker().map(owner));
            names.extend(motion.kind.joint().map(of_joint).into_iter().flatten());
        }
        for load in self.loads.iter().filter(|load| load.name == first) {
            match &load.kind {
                LoadKind::Force(ForceLoad { marker, .. })
                | LoadKind::Moment(MomentLoad { marker, .. }) => {
                    names.push(owner(marker));
                }
                LoadKind::SpringDamper(SpringDamper { markers, .. })
                | LoadKind::TableSpring(TableSpringLoad { markers, .. })
                | LoadKind::Bushing(BushingLoad { markers, .. }) => {
                    names.extend(markers.iter().map(|marker| owner(marker)));
                }
                LoadKind::Torque(Torque { joint, .. })
                | LoadKind::JointSpring(JointSpringLoad { joint, .. })
                | LoadKind::JointLimit(JointLimitLoad { joint, .. }) => {
                    names.extend(of_joint(joint))
                }
                LoadKind::DistributedForce(DistributedForceLoad { body, .. })
                | LoadKind::DistributedMoment(DistributedMomentLoad { body, .. })
                | LoadKind::Fluid(FluidLoad { body, .. }) => names.push(body.clone()),
                LoadKind::Contact(ContactLoad { marker, body, .. }) => {
                    names.extend(marker.iter().map(|marker| owner(marker)));
                    names.extend(body.clone());
                }
            }
        }
        let ports = self.ports.iter().filter(|port| port.name == first);
        names.extend(ports.map(|port| owner(&port.marker)));
        let bodies = self.bodies.iter().enumerate();
        let named = bodies.filter(|(_, body)| names.iter().any(|name| name == body.name()));
        named.map(|(index, _)| index).collect()
    }
}
