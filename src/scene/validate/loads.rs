//! Checks of loads.

use super::checks::{components, expected, not_negative, spring_damper, value};
use crate::math::expression::Expression;
use crate::math::function::Function;
use crate::scene::Error;
use crate::scene::description::{
    Acting, ActionKind, ActsOn, Load, LoadKind, LoadValue, SpringDamper, Value,
};
use crate::scene::resolved::{self, Action, LoadTarget, Resolved, ResolvedSpring};
use crate::system::Signal;

/// Builds a component of a load as a function of time. Components that vary along a body are built by
/// [`function_along`].
///
/// # Errors
/// A number, an expression or a table that is not valid.
pub(super) fn component(path: &str, of: &Value, is_distributed: bool) -> Result<Signal, Error> {
    let function = match of {
        Value::Expression(text) if is_distributed => function_along(path, text),
        _ => value(path, of, false),
    };
    function.map(Signal::Function)
}

/// The function of time that a component is all along a body; zero of one that changes along it.
fn function_along(path: &str, text: &str) -> Result<Function, Error> {
    if Function::is_along(text) {
        return Ok(Function::constant(0.0));
    }
    // Where it is neither, names along the body are known too.
    let function = match Expression::along(text, 0.5) {
        Ok(_) => Function::expression(text),
        Err(told) => Err(told),
    };
    function.map_err(|told| Error::new(path, told))
}

impl<'a> Resolved<'a> {
    /// Resolves the loads.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.scene.loads.iter().enumerate() {
            let path = format!("loads[{index}]");
            let kind = self.resolve_load(&path, load)?;
            let name = &load.name;
            self.loads.push(resolved::ResolvedLoad { name, kind });
        }
        Ok(())
    }

    /// Resolves the loads of the initial state.
    ///
    /// # Errors
    /// A kind other than forces and moments, a missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_initial_loads(&mut self) -> Result<(), Error> {
        for (index, load) in self.scene.initial.loads().iter().enumerate() {
            let path = format!("initial.loads[{index}]");
            if load.kind.action().is_none() {
                let wanted = "a force, a moment, a torque or a distributed one";
                let place = format!("{path}.kind");
                let found = match load.kind {
                    LoadKind::Fluid(_) => "a fluid",
                    _ => "springs and dampers",
                };
                return Err(expected(&place, wanted, found));
            }
            let kind = self.resolve_load(&path, load)?;
            let name = &load.name;
            self.initial_loads
                .push(resolved::ResolvedLoad { name, kind });
        }
        Ok(())
    }

    fn resolve_load(&self, path: &str, load: &'a Load) -> Result<resolved::LoadKind<'a>, Error> {
        let Some((acting, given)) = load.kind.action() else {
            return self.resolve_springs(path, &load.kind);
        };
        let components = self.signals(&format!("{path}.value"), acting.kind, given)?;
        let mut action = self.resolve_action(path, acting, components)?;
        if acting.kind.is_distributed() {
            let values = given.components().iter().enumerate();
            action.along = values
                .filter_map(|(k, of)| Some((k, of.along()?)))
                .collect();
        }
        Ok(resolved::LoadKind::Action {
            action,
            values: given.components(),
        })
    }

    /// Resolves a force or a moment with its components, on the marker, joint or body that it names. A follower rotates
    /// with its marker.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a moment in the plane that follows.
    pub(super) fn resolve_action(
        &self,
        path: &str,
        Acting { kind, on, follower }: Acting<'a>,
        components: Vec<Signal>,
    ) -> Result<Action<'a>, Error> {
        if follower && !kind.is_force() && self.scene.dimension == 2 {
            let wanted = "nothing for a moment in the plane";
            return Err(expected(&format!("{path}.follower"), wanted, "true"));
        }
        let at = |key: &str| format!("{path}.{key}");
        let on = match kind.acts_on() {
            // A direction is what a moment turns and what a follower turns with.
            ActsOn::Marker => LoadTarget::Marker(if follower || !kind.is_force() {
                self.require_spinning(&at("marker"), on)?
            } else {
                self.require_marker(&at("marker"), on)?
            }),
            ActsOn::Joint => LoadTarget::Joint(self.require_pivot(&at("joint"), on)?),
            ActsOn::Cable => LoadTarget::Cable(self.require_cable(&at("body"), on)?),
            ActsOn::Sections => LoadTarget::Cable(self.require_sections(&at("body"), on)?),
        };
        Ok(Action {
            kind,
            on,
            follower,
            components,
            along: Vec::new(),
        })
    }

    /// The components of a load as functions of time.
    fn signals(
        &self,
        path: &str,
        kind: ActionKind,
        given: &LoadValue,
    ) -> Result<Vec<Signal>, Error> {
        let signal = |path: &str, of: &Value| component(path, of, kind.is_distributed());
        match (kind.is_force(), given) {
            (true, _) => components(path, self.scene.dimension, given.components(), signal),
            (false, _) if kind.components(self.scene.dimension) > 1 => {
                components(path, self.scene.dimension, given.components(), signal)
            }
            (false, LoadValue::One(of)) => Ok(vec![signal(path, of)?]),
            (false, LoadValue::Vector(values)) => Err(expected(path, "one value", values.len())),
        }
    }

    /// Resolves a spring and a damper between two points.
    ///
    /// # Errors
    /// A missing key, a marker that does not exist, or a stiffness, damping or length out of range.
    pub(super) fn spring(
        &self,
        path: &str,
        load: &'a SpringDamper,
    ) -> Result<ResolvedSpring<'a>, Error> {
        let ends = self.require_pair(path, &load.markers, load.point)?;
        let units = ["N/m", "N s/m"];
        let [stiffness, damping] = spring_damper(path, load.stiffness, load.damping, units)?;
        let place = format!("{path}.length");
        if let Some(Value::Number(length)) = &load.length {
            not_negative(&place, "m", *length)?;
        }
        let length = load.length.as_ref();
        let length = length.map(|length| value(&place, length, false));
        Ok(ResolvedSpring {
            ends,
            stiffness,
            damping,
            given: load.length.as_ref(),
            length: length.transpose()?.map(Signal::Function),
        })
    }
}
