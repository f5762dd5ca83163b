//! Checks of inputs.

use std::collections::HashSet;
use std::mem::discriminant;

use super::checks::{expected, finite, not_negative, quoted};
use crate::scene::Error;
use crate::scene::description::Input;
use crate::scene::resolved::{self, Resolved};
use crate::system::Signal;

impl Input {
    fn validate_start(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let components = self.components(dimension);
        let start = self.start();
        if !start.is_empty() && start.len() != components {
            let wanted = format!("{components} component(s)");
            let place = format!("{path}.start");
            return Err(expected(&place, &wanted, start.len()));
        }
        for (axis, value) in start.iter().enumerate() {
            let place = format!("{path}.start[{axis}]");
            match self {
                Self::RestLength(_) => not_negative(&place, "m", *value)?,
                _ => finite(&place, *value)?,
            }
        }
        Ok(())
    }
}

impl<'a> Resolved<'a> {
    /// Resolves the inputs without those of ports.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, a name that is used twice, start values out of range, or a force law whose `u` no
    /// input sets.
    pub(super) fn resolve_inputs(&mut self) -> Result<(), Error> {
        let (mut seen, mut first) = (HashSet::new(), 0);
        for (index, input) in self.scene.inputs.iter().enumerate() {
            let path = format!("inputs[{index}]");
            let (kind, start) = self.resolve_input(&path, input, first)?;
            let of = match &kind {
                resolved::InputKind::Action(action) => action.on.name(),
                resolved::InputKind::RestLength(name)
                | resolved::InputKind::Release(name)
                | resolved::InputKind::Latch(name)
                | resolved::InputKind::Friction(name, _)
                | resolved::InputKind::Control(name)
                | resolved::InputKind::Current(name) => name,
            };
            let follower = input.action().is_some_and(|acting| acting.follower);
            if !seen.insert((discriminant(input), of, follower)) {
                let wanted = "an input not declared before";
                return Err(expected(&path, wanted, quoted(of)));
            }
            input.validate_start(&path, self.scene.dimension)?;
            let start = match input.start() {
                [] => start,
                given => given.to_vec(),
            };
            self.inputs.push(resolved::Input { kind, first, start });
            first += input.components(self.scene.dimension);
        }
        self.require_controls()
    }

    /// Resolves the quantity of an input, with its default start values.
    fn resolve_input(
        &mut self,
        path: &str,
        input: &'a Input,
        first: usize,
    ) -> Result<(resolved::InputKind<'a>, Vec<f64>), Error> {
        if let Some(acting) = input.action() {
            let count = input.components(self.scene.dimension);
            let components = (0..count).map(|k| Signal::Input(first + k)).collect();
            let action = self.resolve_action(path, acting, components)?;
            return Ok((resolved::InputKind::Action(action), vec![0.0; count]));
        }
        let at = |key: &str| format!("{path}.{key}");
        Ok(match input {
            Input::RestLength(of) => {
                let start = self.set_rest_length(&at("load"), &of.load, first)?;
                (resolved::InputKind::RestLength(&of.load), vec![start])
            }
            Input::Release(of) => {
                self.set_release(&at("joint"), &of.joint, first)?;
                (resolved::InputKind::Release(&of.joint), vec![0.0])
            }
            Input::Latch(of) => {
                self.set_latch(&at("latch"), &of.latch, first)?;
                (resolved::InputKind::Latch(&of.latch), vec![1.0])
            }
            Input::Friction(of) => {
                let start = self.set_friction(&at("load"), &of.load, first)?;
                let load = self.loads.iter().find(|load| load.name == of.load);
                let is_angle = load.is_some_and(|load| load.kind.place().is_angle());
                (
                    resolved::InputKind::Friction(&of.load, is_angle),
                    vec![start],
                )
            }
            Input::Control(of) => {
                self.set_control(&at("load"), &of.load, first)?;
                (resolved::InputKind::Control(&of.load), vec![0.0])
            }
            Input::Current(of) => {
                let start = self.set_current(&at("load"), &of.load, first)?;
                (resolved::InputKind::Current(&of.load), start)
            }
            Input::Force(_)
            | Input::Moment(_)
            | Input::Torque(_)
            | Input::DistributedForce(_)
            | Input::DistributedMoment(_)
            | Input::Pressure(_)
            | Input::AreaForce(_) => unreachable!("a force or a moment"),
        })
    }
}
