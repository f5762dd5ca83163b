//! Outputs that are compared between runs, and by what their differences are measured: the largest change of each.

use super::experiment::TrialRun;
use crate::math::vector::norm;
use crate::scene::{Error, Scene, did_you_mean};
use crate::simulation::quantities::{self, Evaluated};
use crate::simulation::{Quantity, Source, Unit, Variable};

/// Part of what others of its body do that an output is held to where it hardly moves, and of the size of the scene where
/// nothing moves.
const SMALLEST: f64 = 1e-3;
/// Part of its natural size below which what an output does is roundoff; and where its body deforms by less than roundoff.
const NOTHING: f64 = 1e-14;
const STIFF: f64 = 1e-11;

/// Part of the motion that a run must resolve for an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    /// Displacement from where its marker was drawn, m.
    Displacement,
    /// Change of an angle (rad) or of a unit vector from how it was drawn.
    Rotation,
    /// Largest value of a rate, which follows from the displacement of its body.
    Rate,
    /// Largest value of a force, a strain or an acceleration, which follows from the deformation of its body.
    Elastic,
    /// Largest value of a sum over the scene.
    Sum,
    /// Value of a natural frequency or of a part of an eigenvalue.
    Spectrum,
}

/// Reference of the relative errors of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativeTo {
    /// Largest change of the output itself.
    Own,
    /// A thousandth of the largest change of like outputs of its body.
    Body,
    /// A thousandth of the size of the scene, or of a natural force of it: nothing changes.
    Scene,
    /// A thousandth of the absolute value of the eigenvalue that the output is a part of, or of the inverse of the length of
    /// the experiment if that is more.
    Eigenvalue,
}

/// An output with all its components. Each natural frequency and each part of an eigenvalue is an output of its own, since a list
/// of them is no vector.
#[derive(Clone, Debug)]
pub(super) struct OutputGroup {
    /// Name of the output, with an index only if it is one of a list.
    pub name: String,
    /// Indices of its components among the computed variables.
    pub members: Vec<usize>,
    /// Indices of the decay rate and the frequency of the eigenvalue that it is a part of. Empty for other outputs.
    eigenvalue: Vec<usize>,
    pub measure: Measure,
    /// Unit, which like outputs share.
    unit: Option<Unit>,
    /// Bodies that it is read at, by their places; none of what belongs to the whole scene.
    pub bodies: Vec<usize>,
    /// Whether it follows from accelerations: those of the first instant are of loads that begin at once.
    pub is_dynamic: bool,
    /// Whether it is a force or a moment.
    pub is_force: bool,
    /// Whether it is among the outputs that count.
    pub counts: bool,
}

/// Difference of an output between two runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Difference {
    /// The largest over the experiment, relative.
    pub largest: f64,
    /// The time up to which it stays below the limit asked for, s; nothing where it does to the end.
    pub until: Option<f64>,
}

impl Difference {
    /// No difference.
    pub const NONE: Self = Self {
        largest: 0.0,
        until: None,
    };

    /// The larger of two, good for the shorter time.
    pub fn worst(self, other: Self) -> Self {
        let until = [self.until, other.until].into_iter().flatten();
        Self {
            largest: self.largest.max(other.largest),
            until: until.reduce(f64::min),
        }
    }
}

/// Whether no output changes by more than its limit, or than it did before.
pub(super) fn are_kept(now: &[Difference], before: &[Difference], limits: &[f64]) -> bool {
    let mut pairs = now.iter().zip(before).zip(limits);
    pairs.all(|((now, before), limit)| now.largest <= limit.max(before.largest))
}

/// The outputs of a scene: first those that count, then all others.
///
/// # Errors
/// A name in `accuracy.of` that no output bears; no output that counts.
pub(super) fn groups(scene: &Scene, variables: &[Variable]) -> Result<Vec<OutputGroup>, Error> {
    let wanted = &scene.accuracy.of;
    let resolved = scene.resolved();
    let mut groups: Vec<OutputGroup> = Vec::new();
    for (index, variable) in variables.iter().filter(|v| v.is_computed()).enumerate() {
        let Some(nature) = nature(variable.source) else {
            continue;
        };
        let list = without_index(&variable.name);
        let counts = wanted.iter().any(|of| of == list) || wanted.is_empty() && nature.counts;
        let name = if nature.measure == Measure::Spectrum {
            &variable.name
        } else {
            list
        };
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => group.members.push(index),
            None => groups.push(OutputGroup {
                name: name.to_owned(),
                members: vec![index],
                eigenvalue: parts_of_eigenvalue(variable.source, variables),
                measure: nature.measure,
                unit: variable.unit,
                bodies: resolved.bodies_read_by(list),
                is_dynamic: nature.is_dynamic,
                is_force: nature.is_force,
                counts,
            }),
        }
    }
    for (place, of) in wanted.iter().enumerate() {
        let mut names = groups.iter().map(|group| without_index(&group.name));
        if !names.any(|name| name == of) {
            let names = groups.iter().map(|group| without_index(&group.name));
            let meant = did_you_mean(of, names);
            let message =
                format!("expected the name of an output, without an index, found \"{of}\"{meant}");
            return Err(Error::new(format!("accuracy.of[{place}]"), message));
        }
    }
    groups.sort_by_key(|group| !group.counts);
    if !groups.first().is_some_and(|group| group.counts) {
        let message = "expected an output to plan for, found none but energies, work and residuals";
        return Err(Error::new("outputs", message));
    }
    Ok(groups)
}

/// The name of a variable without the index of a component or of a place in a list.
fn without_index(name: &str) -> &str {
    name.split('[').next().unwrap_or(name)
}

/// Indices, among the computed variables, of the decay rate and the frequency of the eigenvalue that a variable is a part of.
/// Empty for other variables.
fn parts_of_eigenvalue(source: Source, variables: &[Variable]) -> Vec<usize> {
    let Source::Eigenvalue(number, _) = source else {
        return Vec::new();
    };
    let computed = variables.iter().filter(|v| v.is_computed()).enumerate();
    let is_part = |of: Source| matches!(of, Source::Eigenvalue(other, _) if other == number);
    let parts = computed.filter(|(_, variable)| is_part(variable.source));
    parts.map(|(index, _)| index).collect()
}

/// How an output is compared between runs.
struct Nature {
    measure: Measure,
    /// Whether it follows from accelerations.
    is_dynamic: bool,
    /// Whether it is a force, a moment or a stress of a body, joint, motion or coupling.
    is_force: bool,
    /// Whether it counts where `accuracy.of` names no outputs.
    counts: bool,
}

/// How a variable is compared; nothing of what is no output.
fn nature(source: Source) -> Option<Nature> {
    use Quantity::*;
    let quantity = match source {
        Source::Output(quantity) => quantity,
        Source::NaturalFrequency(_) | Source::Eigenvalue(..) => {
            return Some(Nature {
                measure: Measure::Spectrum,
                is_dynamic: false,
                is_force: false,
                counts: true,
            });
        }
        Source::Time | Source::Parameter(_) | Source::Input(_) => return None,
    };
    let (measure, is_force, counts) = match quantity {
        Position(..) | Deflection(..) | CenterOfMass(_) | Travel(_) | Displacement(_)
        | Length(_) => (Measure::Displacement, false, true),
        Angle(_) | Direction(..) | Orientation(..) | Quaternion(..) | RotationVector(..) => {
            (Measure::Rotation, false, true)
        }
        Velocity(..) | SlidingVelocity(_) | AngularVelocity(..) | JointVelocity(_)
        | LoadForce(..) | LoadMoment(..) | Tension(_) | LengthRate(_) => {
            (Measure::Rate, false, true)
        }
        CouplingForce(..) | CouplingMoment(..) => (Measure::Rate, true, true),
        Strain(_)
        | Curvature(_)
        | MembraneStrain(..)
        | SurfaceCurvature(..)
        | Acceleration(..)
        | SlidingAcceleration(_)
        | AngularAcceleration(..)
        | JointAcceleration(_) => (Measure::Elastic, false, true),
        AxialForce(_)
        | BendingMoment(..)
        | Torque(_)
        | Stress(_)
        | TorsionStress(_)
        | StressTensor(..)
        | VonMisesStress(_)
        | MembraneForce(..)
        | SurfaceMoment(..)
        | LayerStress(..)
        | LayerVonMises(_)
        | ConnectivityForce(..)
        | Reaction(..)
        | ReactionMoment(..)
        | GearForce(_)
        | FrictionForce(..)
        | FrictionMoment(..)
        | GearTorque(_)
        | MotionForce(..)
        | MotionMoment(..) => (Measure::Elastic, true, true),
        Momentum(_) | AngularMomentum(_) => (Measure::Sum, false, true),
        KineticEnergy | StrainEnergy | GravityEnergy | SpringEnergy | Input | Dissipated
        | Resolution | Residual(_) | LatchState(_) => (Measure::Sum, false, false),
    };
    Some(Nature {
        measure,
        is_dynamic: quantities::needs(quantity) == Evaluated::Dynamics,
        is_force,
        counts,
    })
}

impl Measure {
    /// Whether changes are counted from how the scene was drawn.
    fn is_change(self) -> bool {
        matches!(self, Self::Displacement | Self::Rotation)
    }
}

/// Components of an output at a point of a run.
fn at(group: &OutputGroup, run: &TrialRun, point: usize) -> Vec<f64> {
    let row = &run.rows[point];
    group.members.iter().map(|member| row[*member]).collect()
}

/// Points of a run at which an output is compared.
fn points(group: &OutputGroup, run: &TrialRun) -> std::ops::Range<usize> {
    usize::from(group.is_dynamic && run.rows.len() > 1)..run.rows.len()
}

/// The largest change of an output over a run, in its unit.
fn own(group: &OutputGroup, run: &TrialRun) -> f64 {
    let change = |point| {
        let mut values = at(group, run, point);
        if group.measure.is_change() {
            let drawn = group.members.iter().map(|member| run.drawn[*member]);
            values.iter_mut().zip(drawn).for_each(|(v, d)| *v -= d);
        }
        norm(&values)
    };
    points(group, run).map(change).fold(0.0, f64::max)
}

/// Returns the size of an output, or a thousandth of the largest size of like outputs on its bodies if that is more.
pub(super) fn like(groups: &[OutputGroup], index: usize, sizes: &[f64]) -> f64 {
    let group = &groups[index];
    let is_like = |(_, other): &(usize, &OutputGroup)| {
        let shares = other.bodies.iter().any(|body| group.bodies.contains(body));
        shares && other.unit == group.unit && other.measure == group.measure
    };
    let others = groups.iter().enumerate().filter(is_like);
    let others = others.fold(0.0, |most: f64, (other, _)| most.max(sizes[other]));
    sizes[index].max(SMALLEST * others)
}

/// Computes the reference size of errors of every output in a run, in the output's unit, with its origin.
pub(super) fn scales(groups: &[OutputGroup], run: &TrialRun) -> Vec<(f64, RelativeTo)> {
    let changes: Vec<f64> = groups.iter().map(|group| own(group, run)).collect();
    let scale = |(index, group): (usize, &OutputGroup)| {
        if group.measure == Measure::Spectrum {
            return of_eigenvalue(group, changes[index], run);
        }
        let natural = group.members.iter().map(|m| run.natural[*m]);
        let natural = natural.fold(0.0, f64::max);
        let deformed = run.deformed.iter().copied().fold(0.0, f64::max);
        let nothing = if group.measure == Measure::Elastic && deformed <= NOTHING * run.size {
            STIFF * natural
        } else {
            NOTHING * natural
        };
        match (changes[index], like(groups, index, &changes)) {
            (_, by_body) if by_body <= nothing => (SMALLEST * natural, RelativeTo::Scene),
            (change, by_body) if change < by_body => (by_body, RelativeTo::Body),
            (change, _) => (change, RelativeTo::Own),
        }
    };
    groups.iter().enumerate().map(scale).collect()
}

/// Reference size of the errors of a natural frequency or of a part of an eigenvalue, whose value is `own`: parts that are zero, as
/// decay rates without dampers and frequencies of rigid modes, are roundoff and have no size of their own.
fn of_eigenvalue(group: &OutputGroup, own: f64, run: &TrialRun) -> (f64, RelativeTo) {
    let parts = group.eigenvalue.iter().map(|part| run.rows[0][*part]);
    let whole = norm(&parts.collect::<Vec<f64>>());
    let length = run.times.last().copied().unwrap_or_default();
    let slowest = if length > 0.0 { 1.0 / length } else { 0.0 };
    let least = SMALLEST * whole.max(slowest);
    if own < least {
        (least, RelativeTo::Eigenvalue)
    } else {
        (own, RelativeTo::Own)
    }
}

/// Compares an output between a run and a more accurate one. `limit` is the wanted relative error.
pub(super) fn difference(
    group: &OutputGroup,
    index: usize,
    run: &TrialRun,
    closer: &TrialRun,
    limit: f64,
) -> Difference {
    let size = closer.scales[index].0;
    let mut found = Difference::NONE;
    for point in points(group, closer) {
        let (a, b) = (at(group, run, point), at(group, closer, point));
        let apart: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
        let relative = if size > 0.0 { norm(&apart) / size } else { 0.0 };
        if relative > limit && found.until.is_none() {
            found.until = Some(closer.times[point.saturating_sub(1)]);
        }
        found.largest = found.largest.max(relative);
    }
    found
}

/// Displacement that an output follows from, and that a run must resolve to be believed, m; nothing where it shows none.
pub(super) fn shown(group: &OutputGroup, index: usize, run: &TrialRun) -> Option<f64> {
    let of_bodies = |displacements: &[f64]| {
        let all = displacements.iter().enumerate();
        let own = all.filter(|(body, found)| group.bodies.contains(body) && **found > 0.0);
        let least = own.map(|(_, found)| *found).reduce(f64::min);
        least.or_else(|| displacements.iter().copied().reduce(f64::max))
    };
    let (scale, _) = run.scales[index];
    let found = match group.measure {
        Measure::Displacement => Some(scale),
        Measure::Rotation => Some(scale.min(1.0) * run.size),
        Measure::Rate => of_bodies(&run.moved),
        Measure::Elastic => match of_bodies(&run.deformed) {
            Some(deformed) if deformed > 0.0 => Some(deformed),
            _ => of_bodies(&run.moved),
        },
        Measure::Sum | Measure::Spectrum => None,
    };
    found.filter(|found| *found > ROUNDOFF * run.size)
}

/// Part of the size of a scene below which displacements are roundoff.
const ROUNDOFF: f64 = 1e-13;
