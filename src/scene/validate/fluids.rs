//! Checks of fluids along bodies.

use super::checks::{components, expected, finite, not_negative, positive, quoted, unknown};
use super::loads::component;
use crate::scene::Error;
use crate::scene::description::{self, Value};
use crate::scene::resolved::{self, LoadKind, Resolved, ResolvedFluid};
use crate::system::Signal;

impl<'a> Resolved<'a> {
    /// Resolves a fluid along a body.
    ///
    /// # Errors
    /// A missing key, a body that does not exist, or a coefficient out of range.
    pub(super) fn fluid(
        &self,
        path: &str,
        load: &'a description::FluidLoad,
    ) -> Result<ResolvedFluid<'a>, Error> {
        let at = |key: &str| format!("{path}.{key}");
        let on = self.require_cable(&at("body"), &load.body)?;
        for (key, unit, value) in [
            ("density", "kg/m^3", Some(load.density)),
            ("diameter", "m", load.diameter),
            ("area", "m^2", load.area),
        ] {
            value.map_or(Ok(()), |value| positive(&at(key), unit, value))?;
        }
        let coefficients = [
            ("drag", load.drag),
            ("tangential_drag", load.tangential_drag),
            ("added_mass", load.added_mass),
        ];
        for (key, value) in coefficients {
            not_negative(&at(key), "1", value.unwrap_or_default())?;
        }
        let [drag, tangential, added_mass] = coefficients.map(|(_, of)| of.unwrap_or_default());
        if load.diameter.is_none() && on.body.all_sections().any(|s| s.numbers().area == 0.0) {
            let wanted = "a diameter, as the section has no area";
            return Err(expected(&at("diameter"), wanted, "nothing"));
        }
        if self.scene.turns() {
            let wanted = "0 where a fluid acts, which does not turn with the frame";
            let found = format!("{:?}", self.scene.rotation.full());
            return Err(expected("rotation", wanted, found));
        }
        let given = load.current.as_deref().unwrap_or_default();
        let dimension = self.scene.dimension;
        let current = match given {
            [] if load.current.is_none() => {
                let zero = Value::Number(0.0);
                let zeros = vec![zero; dimension];
                components(path, dimension, &zeros, |path, of| {
                    component(path, of, true)
                })?
            }
            _ => components(&at("current"), dimension, given, |path, of| {
                component(path, of, true)
            })?,
        };
        let along = given.iter().enumerate();
        Ok(ResolvedFluid {
            on,
            density: load.density,
            current,
            along: along.filter_map(|(k, of)| Some((k, of.along()?))).collect(),
            given,
            drag: [drag, tangential],
            added_mass,
            diameter: load.diameter,
            area: load.area,
            buoyancy: load.buoyancy.unwrap_or(true),
        })
    }

    /// Makes the current of a fluid an input. Returns its components until then, m/s.
    ///
    /// # Errors
    /// A fluid that does not exist, or a current that is not given by finite numbers.
    pub(super) fn set_current(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<Vec<f64>, Error> {
        let fluid = self.loads.iter_mut().find_map(|load| match &mut load.kind {
            LoadKind::Fluid(fluid) if load.name == name => Some(fluid),
            _ => None,
        });
        let Some(fluid) = fluid else {
            let fluids =
                |load: &&resolved::ResolvedLoad<'_>| matches!(load.kind, LoadKind::Fluid(_));
            let known = self.loads.iter().filter(fluids).map(|load| load.name);
            return Err(unknown(path, "a fluid of this scene", name, known));
        };
        let mut start = vec![0.0; fluid.current.len()];
        for (start, value) in start.iter_mut().zip(fluid.given) {
            let Value::Number(value) = value else {
                let wanted = "a fluid whose current is numbers";
                let found = format!("{}, whose current changes", quoted(name));
                return Err(expected(path, wanted, found));
            };
            finite(path, *value)?;
            *start = *value;
        }
        let inputs = (0..start.len()).map(|k| Signal::Input(first + k));
        fluid.current = inputs.collect();
        Ok(start)
    }
}
