//! What acts, to be drawn as arrows: loads, inputs, springs, currents of fluids, and the forces and moments of joints and motions.

use crate::math::function::Function;
use crate::math::space::spins;
use crate::scene::{
    self, HolderId, Input, InputKind, JointCoordinate, LoadKind, MarkerId, MotionKind, On,
    PortKind, Resolved,
};
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
    ReactionMoment(HolderId),
    /// A spring or a stop, by its place among the loads.
    Spring(usize),
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
        InputKind::RestLength(_) | InputKind::Release(_) | InputKind::Current(_) => None,
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
    let springs = resolved.loads.iter().enumerate();
    let springs = springs.filter_map(|(place, load)| of_spring(place, load, dimension));
    let reactions = reactions(resolved);
    (known.chain(fluids))
        .chain(springs)
        .chain(reactions)
        .collect()
}

/// Forces and moments of joints and motions, those that they may have.
fn reactions<'a>(resolved: &'a Resolved<'a>) -> impl Iterator<Item = Action<'a>> {
    let dimension = resolved.scene.dimension;
    let joints = resolved.joints.iter().map(|joint| {
        let holds = [
            joint.holds_position(),
            joint.holds_direction() || joint.spring().is_some(),
        ];
        (joint.name, joint.holder, joint.ends.second.id, holds)
    });
    let is_winch = |kind: &MotionKind<'_>| matches!(kind, MotionKind::Winch(..));
    let motions = resolved
        .motions
        .iter()
        .filter(move |motion| !is_winch(&motion.kind));
    let motions = motions.map(|motion| {
        let turns = matches!(
            motion.kind,
            MotionKind::Angle(..) | MotionKind::Orientation(..)
        );
        let marker = motion.kind.marker().id;
        (motion.name, motion.holder, marker, [!turns, turns])
    });
    let of = move |(name, holder, marker, holds): (&'a str, HolderId, MarkerId, [bool; 2])| {
        let [force, moment] = [false, true].map(|is_moment| Action {
            name,
            unit: if is_moment { "N m" } else { "N" },
            is_moment,
            follower: false,
            components: match is_moment {
                true => spins(dimension).len(),
                false => dimension,
            },
            on: Where::Marker(marker),
            of: match is_moment {
                true => Origin::ReactionMoment(holder),
                false => Origin::Reaction(holder),
            },
        });
        let found = holds.into_iter().zip([force, moment]);
        found.filter_map(|(is_there, action)| is_there.then_some(action))
    };
    joints.chain(motions).flat_map(of)
}

/// What a spring, a bushing or a stop does to its second end; none of other loads.
fn of_spring<'a>(place: usize, load: &'a scene::Load<'a>, dimension: usize) -> Option<Action<'a>> {
    let (on, is_moment) = match &load.kind {
        LoadKind::Spring(_) | LoadKind::Bushing(_) => {
            (Where::Marker(load.kind.between()?.second.id), false)
        }
        LoadKind::JointSpring { on, .. } | LoadKind::Stop { on, .. } => match on {
            JointCoordinate::Displacement(slider) => (Where::Marker(slider.ends.second.id), false),
            JointCoordinate::Angle(pivot) => {
                let marker = pivot.ends.second.id;
                (Where::Joint(marker, pivot.joint.index()), true)
            }
        },
        LoadKind::Action { .. } | LoadKind::Fluid(_) | LoadKind::Contact(_) => return None,
    };
    Some(Action {
        name: load.name,
        unit: if is_moment { "N m" } else { "N" },
        is_moment,
        follower: false,
        components: if is_moment { 1 } else { dimension },
        on,
        of: Origin::Spring(place),
    })
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
    /// Whether it is a force or moment of a joint or motion.
    pub fn is_reaction(&self) -> bool {
        matches!(self.of, Origin::Reaction(_) | Origin::ReactionMoment(_))
    }

    /// Its components now, arrow by arrow.
    pub fn values(&self, simulation: &mut Simulation) -> Result<Vec<f64>, Error> {
        let (components, along) = match self.of {
            Origin::Reaction(holder) => {
                let force = simulation.reaction(holder)?;
                return Ok(force[..self.components].to_vec());
            }
            Origin::ReactionMoment(holder) => {
                let moment = simulation.reaction_moment(holder)?;
                return Ok(moment[3 - self.components..].to_vec());
            }
            Origin::Spring(place) => {
                return Ok(simulation.pull(place)?[..self.components].to_vec());
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
