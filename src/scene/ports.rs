//! Ports written out: the inputs, motions and outputs that a scene could name one by one.

use super::{
    Input, InputKind, MasterInput, Motion, MotionKind, MotionValue, Output, OutputKind, Port,
    PortKind, Scene,
};

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

    /// The loads that come in.
    pub fn inputs(&self) -> Vec<Input> {
        let input = |kind| Input {
            kind,
            marker: Some(self.marker.clone()),
            joint: None,
            body: None,
            load: None,
            follower: false,
            start: Vec::new(),
        };
        match self.kind {
            PortKind::Motion => Vec::new(),
            PortKind::Force if self.turns() => {
                vec![input(InputKind::Force), input(InputKind::Moment)]
            }
            PortKind::Force => vec![input(InputKind::Force)],
        }
    }

    /// The motions that come in: of the marker or, with a spring and damper, of their other end, where
    /// accelerations are not felt.
    pub fn motions(&self) -> Vec<Motion> {
        let input = if self.is_coupling() { 1 } else { 2 };
        let motion = |kind| Motion {
            name: self.name.clone(),
            kind,
            marker: Some(self.marker.clone()),
            joint: None,
            value: MotionValue::Input(MasterInput { input }),
        };
        match self.kind {
            PortKind::Force => Vec::new(),
            PortKind::Motion if self.turns() => {
                vec![motion(MotionKind::Position), motion(MotionKind::Angle)]
            }
            PortKind::Motion => vec![motion(MotionKind::Position)],
        }
    }

    /// What goes out of a port that forces come into.
    pub fn outputs(&self) -> Vec<Output> {
        use OutputKind::*;
        let output = |kind: &OutputKind| Output {
            kind: *kind,
            marker: Some(self.marker.clone()),
            joint: None,
            motion: None,
            body: None,
            count: None,
        };
        let kinds: &[OutputKind] = match self.kind {
            PortKind::Motion => &[],
            PortKind::Force if self.turns() => &[
                Position,
                Velocity,
                Acceleration,
                Angle,
                AngularVelocity,
                AngularAcceleration,
            ],
            PortKind::Force => &[Position, Velocity, Acceleration],
        };
        kinds.iter().map(output).collect()
    }

    /// How many numbers the master sets.
    pub fn input_count(&self) -> usize {
        let loads: usize = self.inputs().iter().map(Input::components).sum();
        let motions = self.motions();
        loads
            + motions
                .iter()
                .filter_map(Motion::input_count)
                .sum::<usize>()
    }
}

impl Scene {
    /// Number of joints of the system before those of a port that drives its marker: joints, motions,
    /// ports. A port has one for its position and, if it turns, one for its angle.
    pub fn joints_before_port(&self, port: usize) -> usize {
        let ports = self.ports[..port].iter().filter(|port| port.drives());
        let of_ports: usize = ports.map(|port| port.motions().len()).sum();
        self.joints.len() + self.motions.len() + of_ports
    }

    /// Number of couplings before those of a port, counted as joints are.
    pub fn couplings_before_port(&self, port: usize) -> usize {
        let ports = self.ports[..port].iter().filter(|port| port.is_coupling());
        ports.map(|port| port.motions().len()).sum()
    }

    /// What a joint of the system is in the scene: the list that it stands in, its place there, and
    /// its name.
    pub fn holder(&self, joint: usize) -> (&'static str, usize, &str) {
        if let Some(found) = self.joints.get(joint) {
            return ("joints", joint, &found.name);
        }
        let motion = joint - self.joints.len();
        if let Some(found) = self.motions.get(motion) {
            return ("motions", motion, &found.name);
        }
        let ports = (0..self.ports.len()).filter(|port| self.ports[*port].drives());
        let before = ports.take_while(|port| self.joints_before_port(*port) <= joint);
        let port = before.last().unwrap_or(0);
        let name = self.ports.get(port).map_or("", |port| &port.name);
        ("ports", port, name)
    }
}
