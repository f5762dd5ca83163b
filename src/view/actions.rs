//! What acts, to be drawn as arrows: loads, inputs, currents of fluids, and the forces of joints and motions.

use crate::math::function::Function;
use crate::scene::{self, HolderId, Input, InputKind, LoadKind, MarkerId, On, PortKind, Resolved};
use crate::simulation::{Error, Simulation};
use crate::system::Signal;

/// Arrows that stand for what acts all along a body.
const ARROWS: u32 = 9;

/// Something that acts.
pub(super) struct Action<'a> {
    /// Its name, or what it is.
    pub name: &'a str,
    /// Unit of its components.
    pub unit: &'static str,
    /// Whether it is a moment, not a force.
    pub is_moment: bool,
    /// Whether its components turn with what it acts on.
    pub follower: bool,
    /// Components of every arrow.
    pub components: usize,
    /// Where it acts.
    pub on: Where,
    of: Origin<'a>,
}

/// Where something acts.
#[derive(Clone, Copy)]
pub(super) enum Where {
    /// At a marker.
    Marker(MarkerId),
    /// At a marker about the axis of a joint, by its place among the joints.
    Joint(MarkerId, usize),
    /// All along a body, by its place.
    Body(usize),
}

/// What its components follow from.
enum Origin<'a> {
    /// Its components, and expressions of those that change along a body.
    Components(&'a [Signal], &'a [(usize, &'a str)]),
    Reaction(HolderId),
}

/// Everything that acts in a scene.
pub(super) fn actions<'a>(resolved: &'a Resolved<'a>) -> Vec<Action<'a>> {
    let dimension = resolved.scene.dimension;
    let loads = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Action { action, .. } => Some((load.name, action)),
        _ => None,
    });
    let of_input = |input: &'a Input<'a>, name: Option<&'a str>| match &input.kind {
        InputKind::Action(action) => Some((name.unwrap_or(action.kind.words()[0]), action)),
        InputKind::RestLength(_) | InputKind::Current(_) => None,
    };
    let inputs = resolved.inputs.iter();
    let inputs = inputs.filter_map(|input| of_input(input, None));
    let ports = resolved.ports.iter().flat_map(|port| match &port.kind {
        PortKind::Force { inputs, .. } => inputs
            .iter()
            .filter_map(|input| of_input(input, Some(port.name)))
            .collect(),
        PortKind::Motion { .. } | PortKind::Coupling { .. } => Vec::new(),
    });
    let known = loads.chain(inputs).chain(ports);
    let known = known.map(|(name, action)| of_action(name, action, dimension));
    let fluids = resolved.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Fluid(fluid) => Some(of_fluid(load.name, fluid)),
        _ => None,
    });
    let joints = resolved.joints.iter();
    let joints = joints.map(|joint| (joint.name, joint.holder, joint.ends.second.id));
    let motions = resolved.motions.iter();
    let motions = motions.map(|motion| (motion.name, motion.holder, motion.kind.marker().id));
    let reactions = joints.chain(motions);
    let reactions = reactions.map(|(name, holder, marker)| Action {
        name,
        unit: "N",
        is_moment: false,
        follower: false,
        components: dimension,
        on: Where::Marker(marker),
        of: Origin::Reaction(holder),
    });
    known.chain(fluids).chain(reactions).collect()
}

/// The current of a fluid.
fn of_fluid<'a>(name: &'a str, fluid: &'a scene::Fluid<'a>) -> Action<'a> {
    Action {
        name,
        unit: "m/s",
        is_moment: false,
        follower: false,
        components: fluid.current.len(),
        on: Where::Body(fluid.on.id.body_index()),
        of: Origin::Components(&fluid.current, &fluid.along),
    }
}

fn of_action<'a>(name: &'a str, action: &'a scene::Action<'a>, dimension: usize) -> Action<'a> {
    Action {
        name,
        unit: action.kind.words()[1],
        is_moment: !action.kind.is_force(),
        follower: action.follower,
        components: action.kind.components(dimension),
        on: match action.on {
            On::Marker(marker) => Where::Marker(marker.id),
            On::Joint(pivot) => Where::Joint(pivot.ends.second.id, pivot.joint.index()),
            On::Cable(cable) => Where::Body(cable.id.body_index()),
        },
        of: Origin::Components(&action.components, &action.along),
    }
}

impl Action<'_> {
    /// Whether it is the force of a joint or motion.
    pub fn is_reaction(&self) -> bool {
        matches!(self.of, Origin::Reaction(_))
    }

    /// Its components now, arrow by arrow.
    pub fn values(&self, simulation: &mut Simulation) -> Result<Vec<f64>, Error> {
        let (components, along) = match self.of {
            Origin::Reaction(holder) => {
                let force = simulation.reaction(holder)?;
                return Ok(force[..self.components].to_vec());
            }
            Origin::Components(components, along) => (components, along),
        };
        let (time, inputs) = (simulation.time(), simulation.inputs());
        let same: Vec<f64> = (components.iter())
            .map(|component| match component {
                Signal::Function(function) => function.value(time),
                Signal::Input(place) => inputs[*place],
            })
            .collect();
        if !matches!(self.on, Where::Body(_)) {
            return Ok(same);
        }
        let mut values = Vec::new();
        for arrow in 0..ARROWS {
            let s = (f64::from(arrow) + 0.5) / f64::from(ARROWS);
            let mut at = same.clone();
            for (axis, text) in along {
                let function = Function::along(text, s);
                at[*axis] = function.map_or(0.0, |function| function.value(time));
            }
            values.extend(at);
        }
        Ok(values)
    }
}
