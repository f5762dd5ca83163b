//! What ports are, by what is given.

use super::description::{ForcePort, MotionPort, Port, PortKind};

impl Port {
    /// Whether angles and moments belong to it.
    pub fn turns(&self) -> bool {
        match &self.kind {
            PortKind::Force(ForcePort { rotation }) => *rotation,
            PortKind::Motion(motion) => motion.turns(),
        }
    }

    /// Whether it drives its marker.
    pub fn drives(&self) -> bool {
        matches!(&self.kind, PortKind::Motion(motion) if !motion.is_coupling())
    }

    /// Stiffness (N/m), damping (N s/m), rotational stiffness (N m/rad) and rotational damping (N m s/rad) that are given.
    pub fn springs(&self) -> [Option<f64>; 4] {
        match &self.kind {
            PortKind::Force(_) => [None; 4],
            PortKind::Motion(of) => [
                of.stiffness,
                of.damping,
                of.rotational_stiffness,
                of.rotational_damping,
            ],
        }
    }
}

impl MotionPort {
    /// Whether the motion comes in through a spring and a damper.
    pub fn is_coupling(&self) -> bool {
        self.stiffness.is_some() || self.damping.is_some()
    }

    /// Whether angles and moments belong to it.
    pub fn turns(&self) -> bool {
        let springs = [self.rotational_stiffness, self.rotational_damping];
        self.rotation || springs.iter().any(Option::is_some)
    }
}
