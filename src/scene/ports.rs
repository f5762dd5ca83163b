//! What ports are, by what is given.

use super::description::{Port, PortKind};

impl Port {
    /// Whether its motion comes in through a spring and a damper.
    pub fn is_coupling(&self) -> bool {
        self.stiffness.is_some() || self.damping.is_some()
    }

    /// Whether angles and moments belong to it.
    pub fn turns(&self) -> bool {
        let springs = [self.rotational_stiffness, self.rotational_damping];
        self.rotation || springs.iter().any(Option::is_some)
    }

    /// Whether it drives its marker.
    pub fn drives(&self) -> bool {
        self.kind == PortKind::Motion && !self.is_coupling()
    }
}
