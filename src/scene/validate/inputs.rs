//! Checks of inputs.

use std::collections::BTreeSet;

use super::checks::{Key, expected, finite, keys, not_negative, quoted};
use crate::scene::{Error, Input, InputKind, LoadKind, Scene, Value};

impl Input {
    fn validate_keys(&self, path: &str) -> Result<(), Error> {
        let all: [Key; 5] = [
            ("marker", self.marker.is_some(), "a name"),
            ("joint", self.joint.is_some(), "a name"),
            ("body", self.body.is_some(), "a name"),
            ("load", self.load.is_some(), "a name"),
            ("follower", self.follower, "true"),
        ];
        let (must, may): (&[&str], &[&str]) = match self.kind {
            InputKind::Force => (&["marker"], &["follower"]),
            InputKind::Moment => (&["marker"], &[]),
            InputKind::Torque => (&["joint"], &[]),
            InputKind::Distributed => (&["body"], &[]),
            InputKind::RestLength => (&["load"], &[]),
        };
        keys(path, "input", &all, must, may)
    }

    /// The name of what it acts on.
    fn target(&self) -> &str {
        let names = [&self.marker, &self.joint, &self.body, &self.load];
        names
            .into_iter()
            .flatten()
            .next()
            .map_or("", String::as_str)
    }
}

impl Scene {
    pub(super) fn validate_inputs(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (index, input) in self.inputs.iter().enumerate() {
            let path = format!("inputs[{index}]");
            input.validate_keys(&path)?;
            self.validate_target(&path, input)?;
            if !seen.insert((input.kind as u8, input.target(), input.follower)) {
                let wanted = "an input not declared before";
                return Err(expected(&path, wanted, quoted(input.target())));
            }
            let components = input.components();
            if !input.start.is_empty() && input.start.len() != components {
                let wanted = format!("{components} component(s)");
                let place = format!("{path}.start");
                return Err(expected(&place, &wanted, input.start.len()));
            }
            for (axis, value) in input.start.iter().enumerate() {
                let place = format!("{path}.start[{axis}]");
                match input.kind {
                    InputKind::RestLength => not_negative(&place, "m", *value)?,
                    _ => finite(&place, *value)?,
                }
            }
        }
        Ok(())
    }

    fn validate_target(&self, path: &str, input: &Input) -> Result<(), Error> {
        let name = input.target();
        match input.kind {
            InputKind::Force if !input.follower => {
                self.require_marker(&format!("{path}.marker"), name)?;
            }
            InputKind::Force | InputKind::Moment => {
                self.require_turning(&format!("{path}.marker"), name)?;
            }
            InputKind::Torque => self.require_pivot(&format!("{path}.joint"), name)?,
            InputKind::Distributed => {
                self.require_cable(&format!("{path}.body"), name)?;
            }
            InputKind::RestLength => self.require_spring(&format!("{path}.load"), name)?,
        }
        Ok(())
    }

    /// A spring-damper whose rest length nothing else changes.
    fn require_spring(&self, path: &str, name: &str) -> Result<(), Error> {
        let found = self.load(name).map(|load| &self.loads[load]);
        let Some(load) = found.filter(|load| load.kind == LoadKind::SpringDamper) else {
            return Err(expected(
                path,
                "a spring-damper of this scene",
                quoted(name),
            ));
        };
        match load.length {
            None | Some(Value::Number(_)) => Ok(()),
            Some(_) => {
                let wanted = "a spring-damper whose length is a number";
                let found = format!("{}, whose length changes in time", quoted(name));
                Err(expected(path, wanted, found))
            }
        }
    }
}
