//! Checks of the chosen method.

use super::checks::{expected, positive, quoted};
use crate::scene::description::{Input, InputKind, Joint, JointKind};
use crate::scene::marker::GROUND;
use crate::scene::{Error, Formulation, Integrator, Scene};

impl Scene {
    pub(super) fn validate_method(&self) -> Result<(), Error> {
        let method = &self.method;
        positive(
            "method.work_limit",
            "evaluations times parts",
            method.work_limit,
        )?;
        let as_printed = method.formulation == Formulation::AsPrinted;
        if method.integrator != Integrator::Rk4 && as_printed {
            let wanted =
                "\"rk4\": the implicit solve needs the exact connectivity that as_printed breaks";
            let found = format!("{:?}", method.integrator).to_lowercase();
            return Err(expected("method.integrator", wanted, quoted(&found)));
        }
        match self.beyond_print().filter(|_| as_printed) {
            Some((wanted, found)) => {
                let wanted = format!("{wanted} under \"as_printed\"");
                Err(expected("method.formulation", &wanted, found))
            }
            None => Ok(()),
        }
    }

    /// What the printed formulation cannot do with this scene: what it can do, and what was found.
    fn beyond_print(&self) -> Option<(&'static str, String)> {
        if self.bodies.len() != 1 {
            return Some(("one cable only", format!("{} bodies", self.bodies.len())));
        }
        if let Some(body) = self.bodies.iter().find(|body| body.cable().is_none()) {
            return Some(("one cable only", quoted(body.name())));
        }
        let is_pin = |joint: &&Joint| {
            joint.kind == JointKind::Revolute && joint.markers[0] == GROUND && joint.point.is_none()
        };
        if let Some(joint) = self.joints.iter().find(|joint| !is_pin(joint)) {
            let wanted = "revolute joints to ground, where the cable is, only";
            return Some((wanted, quoted(&joint.name)));
        }
        let plain = |input: &&Input| {
            matches!(input.kind, InputKind::Force | InputKind::Moment) && !input.follower
        };
        let lists = [
            ("no masses", self.masses.len(), "masses"),
            ("no motions", self.motions.len(), "motions"),
            ("no loads but inputs", self.loads.len(), "loads"),
            ("no ports", self.ports.len(), "ports"),
            (
                "no inputs but dead forces and moments",
                self.inputs.iter().filter(|input| !plain(input)).count(),
                "others",
            ),
        ];
        let many = lists.into_iter().find(|(_, count, _)| *count > 0);
        if let Some((wanted, count, what)) = many {
            return Some((wanted, format!("{count} {what}")));
        }
        (self.rotation != 0.0).then(|| ("a frame that does not turn", self.rotation.to_string()))
    }
}
