//! Numbers of loads that are parameters of the unit.

use super::LoadExtent;
use crate::scene::Scene;
use crate::scene::unit::Unit;

/// A number of a load that is a parameter of the unit. One row declares its name, its start value and what sets it.
#[derive(Debug)]
pub struct LoadNumber<'a> {
    /// Key in the scene, which ends the name of the parameter.
    pub key: &'static str,
    /// Meaning, without the name of the load.
    pub what: &'static str,
    /// Unit, where the number has one.
    pub unit: Option<Unit>,
    /// The number in the description.
    pub value: NumberMut<'a>,
}

/// A number in a description.
#[derive(Debug)]
pub enum NumberMut<'a> {
    /// One that is always there.
    Needed(&'a mut f64),
    /// One that is 0 by default.
    Optional(&'a mut Option<f64>),
    /// One for each axis of a frame; zeros by default.
    Axes(&'a mut Option<[f64; 3]>),
}

impl<'a> LoadNumber<'a> {
    /// Declares a number.
    pub(super) fn new(
        key: &'static str,
        what: &'static str,
        unit: Option<Unit>,
        value: NumberMut<'a>,
    ) -> Self {
        Self {
            key,
            what,
            unit,
            value,
        }
    }
}

/// Declares a stiffness and a damping, with their units.
pub(super) fn damper<'a>(
    [by_way, by_rate]: [Unit; 2],
    stiffness: NumberMut<'a>,
    damping: NumberMut<'a>,
) -> Vec<LoadNumber<'a>> {
    vec![
        LoadNumber::new("stiffness", "Stiffness", Some(by_way), stiffness),
        LoadNumber::new("damping", "Damping", Some(by_rate), damping),
    ]
}

impl NumberMut<'_> {
    /// Whether there is one for each axis.
    pub fn has_axes(&self) -> bool {
        matches!(self, Self::Axes(_))
    }

    /// Returns the number, or those of all axes.
    pub fn get(&self) -> Vec<f64> {
        match self {
            Self::Needed(value) => vec![**value],
            Self::Optional(value) => vec![value.unwrap_or_default()],
            Self::Axes(values) => values.unwrap_or_default().to_vec(),
        }
    }

    /// Sets the number, or that of an axis.
    fn set(self, axis: usize, value: f64) {
        match self {
            Self::Needed(of) => *of = value,
            Self::Optional(of) => *of = Some(value),
            Self::Axes(of) => of.get_or_insert_default()[axis] = value,
        }
    }
}

impl Scene {
    /// Sets a number of the load at this place in the list, of several that of an axis.
    pub fn set_load_number(&mut self, load: usize, number: usize, axis: usize, value: f64) {
        // Units do not matter here.
        let numbers = self.loads[load].kind.numbers(LoadExtent::Point);
        let of = numbers.into_iter().nth(number);
        of.expect("a number of this load").value.set(axis, value);
    }
}
