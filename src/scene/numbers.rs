//! Numbers of a scene that are parameters of its unit. What has none of the kind asked for is an error of the caller.

use super::Scene;
use super::description::{
    BushingLoad, ContactLoad, FluidLoad, JointKind, LoadKind, MotionPort, PortKind, Revolute,
};

impl Scene {
    /// Sets the stiffness of the load at this place in the list.
    pub fn set_load_stiffness(&mut self, load: usize, value: f64) {
        match &mut self.loads[load].kind {
            LoadKind::SpringDamper(of) => of.stiffness = Some(value),
            LoadKind::JointSpring(of) => of.stiffness = Some(value),
            LoadKind::JointLimit(of) => of.stiffness = value,
            LoadKind::Contact(of) => of.stiffness = value,
            other => unreachable!("a load with a stiffness, not {other:?}"),
        }
    }

    /// Sets the damping of the load at this place in the list.
    pub fn set_load_damping(&mut self, load: usize, value: f64) {
        let damping = match &mut self.loads[load].kind {
            LoadKind::SpringDamper(of) => &mut of.damping,
            LoadKind::JointSpring(of) => &mut of.damping,
            LoadKind::JointLimit(of) => &mut of.damping,
            LoadKind::Contact(of) => &mut of.damping,
            other => unreachable!("a load with a damping, not {other:?}"),
        };
        *damping = Some(value);
    }

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

    /// Mutable access to the bushing at this place in the list of loads.
    pub fn bushing_mut(&mut self, load: usize) -> &mut BushingLoad {
        match &mut self.loads[load].kind {
            LoadKind::Bushing(bushing) => bushing,
            other => unreachable!("a bushing, not {other:?}"),
        }
    }

    /// Mutable access to the fluid at this place in the list of loads.
    pub fn fluid_mut(&mut self, load: usize) -> &mut FluidLoad {
        match &mut self.loads[load].kind {
            LoadKind::Fluid(fluid) => fluid,
            other => unreachable!("a fluid, not {other:?}"),
        }
    }

    /// Mutable access to the contact at this place in the list of loads.
    pub fn contact_mut(&mut self, load: usize) -> &mut ContactLoad {
        match &mut self.loads[load].kind {
            LoadKind::Contact(contact) => contact,
            other => unreachable!("a contact, not {other:?}"),
        }
    }
}
