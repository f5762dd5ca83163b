//! Numbers of a scene that are parameters of its unit. What has none of the kind asked for is an error of the caller.

use super::Scene;
use super::description::{MotionPort, PortKind};
use super::joints::{JointKind, Revolute};

impl Scene {
    /// Mutable access to the revolute joint at this place in the list of joints.
    pub fn revolute_mut(&mut self, joint: usize) -> &mut Revolute {
        match &mut self.joints[joint].kind {
            JointKind::Revolute(revolute) => revolute,
            other => unreachable!("a revolute joint, not {other:?}"),
        }
    }

    /// Mutable access to the port that takes a motion at this place in the list of ports.
    pub fn motion_port_mut(&mut self, port: usize) -> &mut MotionPort {
        match &mut self.ports[port].kind {
            PortKind::Motion(motion) => motion,
            other => unreachable!("a port that takes a motion, not {other:?}"),
        }
    }
}
