//! Forces and moments that a scene describes or that the master sets.

use crate::scene::{Action, Input, InputKind, PortKind, Resolved};

/// A force or a moment by a load, an input or a port.
#[derive(Clone, Copy, Debug)]
pub struct KnownAction<'a> {
    /// Name of the load or the port; of an input its kind.
    pub name: &'a str,
    /// Force or moment with its target.
    pub action: &'a Action<'a>,
    /// Components of an input before the master sets some; empty for a load.
    pub start: &'a [f64],
}

/// Collects forces and moments of loads, inputs and ports. Those of springs, fluids, contacts and joints follow from the motion and are not
/// among them.
pub fn known_actions<'a>(resolved: &'a Resolved<'a>) -> Vec<KnownAction<'a>> {
    let loads = resolved.loads.iter().filter_map(|load| {
        Some(KnownAction {
            name: load.name,
            action: load.kind.action()?,
            start: &[],
        })
    });
    let of_input = |input: &'a Input<'a>, name: Option<&'a str>| match &input.kind {
        InputKind::Action(action) => Some(KnownAction {
            name: name.unwrap_or(action.kind.words()[0]),
            action,
            start: &input.start,
        }),
        InputKind::RestLength(_)
        | InputKind::Release(_)
        | InputKind::Latch(_)
        | InputKind::Friction(..)
        | InputKind::Control(_)
        | InputKind::Current(_) => None,
    };
    let inputs = resolved.inputs.iter();
    let inputs = inputs.filter_map(|input| of_input(input, None));
    let ports = resolved.ports.iter().flat_map(|port| {
        let inputs: &[_] = match &port.kind {
            PortKind::Force { inputs, .. } => inputs,
            PortKind::Motion { .. } | PortKind::Coupling { .. } => &[],
        };
        let inputs = inputs.iter();
        inputs.filter_map(|input| of_input(input, Some(port.name)))
    });
    loads.chain(inputs).chain(ports).collect()
}
