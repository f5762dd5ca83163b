//! Checks of inputs.

use std::collections::BTreeSet;

use super::checks::{Key, expected, finite, keys, needed, not_negative, quoted, unknown};
use crate::scene::Error;
use crate::scene::description::{Input, InputKind, Kind as _, Value};
use crate::scene::resolved::{self, LoadKind, Resolved};
use crate::system::Signal;

impl Input {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 5] = [
            ("marker", self.marker.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("body", self.body.is_some(), "a name"),
            ("load", self.load.is_some(), "a name"),
            ("follower", self.follower, "true"),
        ];
        keys(path, "input", &all, self.kind.keys())
    }

    fn validate_start(&self, path: &str, dimension: usize) -> Result<(), Error> {
        let components = self.components(dimension);
        if !self.start.is_empty() && self.start.len() != components {
            let wanted = format!("{components} component(s)");
            let place = format!("{path}.start");
            return Err(expected(&place, &wanted, self.start.len()));
        }
        for (axis, value) in self.start.iter().enumerate() {
            let place = format!("{path}.start[{axis}]");
            match self.kind {
                InputKind::RestLength => not_negative(&place, "m", *value)?,
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
    /// A missing key, a reference that does not exist, a name that is used twice, or start values out of range.
    pub(super) fn resolve_inputs(&mut self) -> Result<(), Error> {
        let (mut seen, mut first) = (BTreeSet::new(), 0);
        for (index, input) in self.scene.inputs.iter().enumerate() {
            let path = format!("inputs[{index}]");
            input.validate_keys(&path)?;
            let (kind, start) = self.resolve_input(&path, input, first)?;
            let of = match &kind {
                resolved::InputKind::Action(action) => action.on(),
                resolved::InputKind::RestLength(name)
                | resolved::InputKind::Release(name)
                | resolved::InputKind::Current(name) => name,
            };
            if !seen.insert((input.kind as u8, of, input.follower)) {
                let wanted = "an input not declared before";
                return Err(expected(&path, wanted, quoted(of)));
            }
            input.validate_start(&path, self.scene.dimension)?;
            let start = if input.start.is_empty() {
                start
            } else {
                input.start.clone()
            };
            self.inputs.push(resolved::Input { kind, first, start });
            first += input.components(self.scene.dimension);
        }
        Ok(())
    }

    /// Resolves the quantity of an input, with its default start values.
    fn resolve_input(
        &mut self,
        path: &str,
        input: &'a Input,
        first: usize,
    ) -> Result<(resolved::InputKind<'a>, Vec<f64>), Error> {
        if input.kind == InputKind::Release {
            let name = needed(path, "joint", "a name", input.joint.as_deref())?;
            self.set_release(&format!("{path}.joint"), name, first)?;
            return Ok((resolved::InputKind::Release(name), vec![0.0]));
        }
        let Some(kind) = input.kind.action() else {
            let name = needed(path, "load", "a name", input.load.as_deref())?;
            let place = format!("{path}.load");
            if input.kind == InputKind::Current {
                let start = self.set_current(&place, name, first)?;
                return Ok((resolved::InputKind::Current(name), start));
            }
            let start = self.set_rest_length(&place, name, first)?;
            return Ok((resolved::InputKind::RestLength(name), vec![start]));
        };
        let count = input.components(self.scene.dimension);
        let components = (0..count).map(|k| Signal::Input(first + k)).collect();
        let of = [&input.marker, &input.joint, &input.body];
        let action = self.resolve_action(path, (kind, input.follower), of, components)?;
        Ok((resolved::InputKind::Action(action), vec![0.0; count]))
    }

    /// Makes the rest length of a spring-damper, which nothing else changes, an input; what it was, m.
    fn set_rest_length(&mut self, path: &str, name: &str, first: usize) -> Result<f64, Error> {
        let spring = self.loads.iter_mut().find_map(|load| match &mut load.kind {
            LoadKind::Spring(spring) if load.name == name => Some(spring),
            _ => None,
        });
        let Some(spring) = spring else {
            let springs = |load: &&resolved::Load<'_>| matches!(load.kind, LoadKind::Spring(_));
            let known = self.loads.iter().filter(springs).map(|load| load.name);
            return Err(unknown(path, "a spring-damper of this scene", name, known));
        };
        let length = match spring.given {
            None => spring.ends.distance(),
            Some(Value::Number(length)) => *length,
            Some(_) => {
                let wanted = "a spring-damper whose length is a number";
                let found = format!("{}, whose length changes in time", quoted(name));
                return Err(expected(path, wanted, found));
            }
        };
        spring.length = Some(Signal::Input(first));
        Ok(length)
    }
}
