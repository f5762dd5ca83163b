//! What acts, to be drawn as arrows: loads, inputs, springs, currents of fluids, and the forces and moments of joints and motions.

use crate::math::function::Function;
use crate::math::space::spins;
use crate::picture::known_actions;
use crate::scene::{
    self, ActionKind, Along, ConstraintOwnerId, LoadId, LoadPlace, MarkerId, PatchBody, Resolved,
};
use crate::simulation::{Error, Pose, Quantity, Simulation};
use crate::system::Signal;

/// Arrows that stand for what acts all along a body.
const ARROWS: u32 = 9;
/// Arrows along each coordinate of a plate or shell.
const RASTER: usize = 5;

/// Something that acts.
pub(super) struct MovingAction<'a> {
    /// Name of the action, or its kind.
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
    pub on: Where<'a>,
    of: Origin<'a>,
}

/// Where something acts.
#[derive(Clone, Copy)]
pub(super) enum Where<'a> {
    /// At a marker.
    Marker(MarkerId),
    /// At a marker about the axis of a joint, by its place among the joints.
    Joint(MarkerId, usize),
    /// All along a body, by its place.
    Body(usize),
    /// All over a plate or shell, by its place.
    Surface(usize, &'a PatchBody),
}

/// Source of the components.
enum Origin<'a> {
    /// Components, and expressions of those that change along a body.
    Components(&'a [Signal], &'a [(usize, &'a str)]),
    /// One component along the normal of a surface, in the same way.
    Pressure(&'a [Signal], &'a [(usize, &'a str)]),
    /// Quantities of a joint or a motion, one an axis.
    Reaction(Vec<Quantity>),
    /// Quantities of a spring, a joint limit or a contact, one an axis.
    Load(Vec<Quantity>),
    /// Contact along a body.
    Contact(LoadId),
}

/// Everything that acts in a scene.
pub(super) fn actions<'a>(resolved: &'a Resolved<'a>) -> Vec<MovingAction<'a>> {
    let dimension = resolved.scene.dimension;
    let known = known_actions(resolved).into_iter();
    let known = known.map(|known| of_action(known.name, known.action, dimension));
    let fluids = resolved.loads.iter();
    let fluids = fluids.filter_map(|load| of_fluid(load.name, load.kind.fluid()?));
    let springs = resolved.numbered_loads();
    let springs = springs.flat_map(|(id, load)| of_spring(id, load, dimension));
    let reactions = reactions(resolved);
    (known.chain(fluids))
        .chain(springs)
        .chain(reactions)
        .collect()
}

/// Forces and moments of joints and motions, those that they may have.
fn reactions<'a>(resolved: &'a Resolved<'a>) -> impl Iterator<Item = MovingAction<'a>> {
    let dimension = resolved.scene.dimension;
    let joints = resolved.joints.iter().map(|joint| {
        let holds = [
            joint.holds_position(),
            joint.holds_direction() || joint.spring().is_some(),
        ];
        (joint.name, joint.holder, joint.ends.second.id, holds)
    });
    let motions = resolved.motions.iter().filter_map(|motion| {
        let quantity = motion.driven.quantity();
        let marker = quantity.place.second()?.id;
        Some((motion.name, motion.holder, marker, quantity.exerts))
    });
    let of =
        move |(name, holder, marker, holds): (&'a str, ConstraintOwnerId, MarkerId, [bool; 2])| {
            let quantity = move |is_moment, axis| {
                if is_moment {
                    Quantity::ReactionMoment(holder, axis, Along::Global)
                } else {
                    Quantity::Reaction(holder, axis, Along::Global)
                }
            };
            let on = MarkerActions {
                name,
                marker,
                dimension,
                is_there: holds,
            };
            exerted(on, quantity, Origin::Reaction)
        };
    joints.chain(motions).flat_map(of)
}

/// What acts on a marker.
struct MarkerActions<'a> {
    name: &'a str,
    marker: MarkerId,
    dimension: usize,
    /// Whether there is a force, and whether there is a moment.
    is_there: [bool; 2],
}

/// A force and a moment on a marker, those that are there.
fn exerted<'a>(
    on: MarkerActions<'a>,
    quantity: impl Fn(bool, usize) -> Quantity,
    of: impl Fn(Vec<Quantity>) -> Origin<'a>,
) -> impl Iterator<Item = MovingAction<'a>> {
    let MarkerActions {
        name,
        marker,
        dimension,
        is_there,
    } = on;
    let both = [(is_there[0], false), (is_there[1], true)].into_iter();
    both.filter(|(is_there, _)| *is_there)
        .map(move |(_, is_moment)| {
            let axes = if is_moment {
                spins(dimension)
            } else {
                0..dimension
            };
            MovingAction {
                name,
                unit: if is_moment { "N·m" } else { "N" },
                is_moment,
                follower: false,
                components: axes.len(),
                on: Where::Marker(marker),
                of: of(axes.map(|axis| quantity(is_moment, axis)).collect()),
            }
        })
}

/// Returns the action of a spring, a bushing, friction or a joint limit on its second end, or of a contact on its marker or along its body; none of other loads.
fn of_spring<'a>(
    id: LoadId,
    load: &'a scene::ResolvedLoad<'a>,
    dimension: usize,
) -> Vec<MovingAction<'a>> {
    let is_friction = load.kind.is_friction();
    let quantity = move |is_moment, axis| match (is_moment, is_friction) {
        (true, true) => Quantity::FrictionMoment(id, axis),
        (true, false) => Quantity::LoadMoment(id, axis),
        (false, true) => Quantity::FrictionForce(id, axis),
        (false, false) => Quantity::LoadForce(id, axis),
    };
    if let Some(marker) = load.kind.exerts_on() {
        let on = MarkerActions {
            name: load.name,
            marker: marker.id,
            dimension,
            is_there: load.kind.exerts(),
        };
        return exerted(on, quantity, Origin::Load).collect();
    }
    let (LoadPlace::Line(on), [true, _]) = (load.kind.place(), load.kind.exerts()) else {
        return Vec::new();
    };
    vec![MovingAction {
        name: load.name,
        unit: "N/m",
        is_moment: false,
        follower: false,
        components: dimension,
        on: Where::Body(on.id.body_index()),
        of: Origin::Contact(id),
    }]
}

/// The current of a fluid along a line or over a surface.
fn of_fluid<'a>(name: &'a str, fluid: &'a scene::ResolvedFluid<'a>) -> Option<MovingAction<'a>> {
    let on = match fluid.on {
        LoadPlace::Line(line) => Where::Body(line.id.body_index()),
        LoadPlace::Surface(plate) => Where::Surface(plate.id.index(), plate.body),
        _ => return None,
    };
    (!fluid.current.is_empty()).then_some(MovingAction {
        name,
        unit: "m/s",
        is_moment: false,
        follower: false,
        components: fluid.current.len(),
        on,
        of: Origin::Components(&fluid.current, &fluid.varying),
    })
}

fn of_action<'a>(
    name: &'a str,
    action: &'a scene::Action<'a>,
    dimension: usize,
) -> MovingAction<'a> {
    let is_pressure = action.kind == ActionKind::Pressure;
    let of = if is_pressure {
        Origin::Pressure
    } else {
        Origin::Components
    };
    MovingAction {
        name,
        unit: action.kind.words()[1],
        is_moment: !(action.kind.is_force() || is_pressure),
        follower: action.follower,
        components: if is_pressure {
            dimension
        } else {
            action.kind.components(dimension)
        },
        on: match action.on {
            LoadPlace::Marker(marker) => Where::Marker(marker.id),
            LoadPlace::Ends(ends) => Where::Marker(ends.second.id),
            LoadPlace::Coordinate(on) => Where::Joint(on.ends().second.id, on.joint().index()),
            LoadPlace::Line(cable) => Where::Body(cable.id.body_index()),
            LoadPlace::Surface(plate) => Where::Surface(plate.id.index(), plate.body),
        },
        of: of(&action.components, &action.along),
    }
}

/// Material coordinates of the arrows along a body.
fn places() -> Vec<f64> {
    let arrows = 0..ARROWS;
    let place = |arrow| (f64::from(arrow) + 0.5) / f64::from(ARROWS);
    arrows.map(place).collect()
}

impl MovingAction<'_> {
    /// Whether it is a force or moment of a joint or motion.
    pub fn is_reaction(&self) -> bool {
        matches!(self.of, Origin::Reaction(_))
    }

    /// Points of the drawn surface at which arrows stand; none of what acts elsewhere.
    pub fn points(&self) -> Vec<usize> {
        match self.on {
            Where::Surface(_, patch) => patch.grid().raster(RASTER),
            Where::Marker(_) | Where::Joint(..) | Where::Body(_) => Vec::new(),
        }
    }

    /// Returns the components now, arrow by arrow, where bodies stand so.
    ///
    /// # Errors
    /// A quantity that cannot be computed in the present state.
    pub fn values(&self, simulation: &mut Simulation, poses: &[Pose]) -> Result<Vec<f64>, Error> {
        let (components, along) = match &self.of {
            Origin::Reaction(quantities) | Origin::Load(quantities) => {
                let values = quantities.iter().map(|of| simulation.read(*of));
                return values.collect();
            }
            Origin::Contact(load) => {
                let forces = simulation.contact(*load, &places())?;
                let forces = forces.iter().flat_map(|force| &force[..self.components]);
                return Ok(forces.copied().collect());
            }
            Origin::Components(components, along) | Origin::Pressure(components, along) => {
                (components, along)
            }
        };
        let (time, inputs) = (simulation.time(), simulation.inputs());
        let same: Vec<f64> = (components.iter())
            .map(|component| match component {
                Signal::Function(function) => function.value(time),
                Signal::Input(place) => inputs[*place],
            })
            .collect();
        let at = |place: &[(&'static str, f64)]| {
            let mut at = same.clone();
            for (axis, text) in *along {
                let function = Function::at(text, place);
                at[*axis] = function.map_or(0.0, |function| function.value(time));
            }
            at
        };
        Ok(match self.on {
            Where::Marker(_) | Where::Joint(..) => same,
            Where::Body(_) => (places().into_iter())
                .flat_map(|s| at(&[("s", s)]))
                .collect(),
            Where::Surface(body, patch) => {
                let (grid, points) = (patch.grid(), self.points());
                let places: Vec<[f64; 2]> = grid.places().collect();
                let values = |point: &usize| {
                    let [s1, s2] = places[*point];
                    at(&[("s1", s1), ("s2", s2)])
                };
                if !matches!(self.of, Origin::Pressure(..)) {
                    return Ok(points.iter().flat_map(values).collect());
                }
                let normals = grid.normals(&poses[body].surface, &points);
                let along_normal = |(point, normal): (&usize, [f64; 3])| {
                    let pressure = values(point)[0];
                    normal.map(|part| pressure * part)
                };
                points.iter().zip(normals).flat_map(along_normal).collect()
            }
        })
    }
}
