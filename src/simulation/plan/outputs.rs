//! Outputs that are compared between runs, and by what their differences are measured.

use super::experiment::Run;
use crate::math::vector::norm;
use crate::scene::{Error, Scene};
use crate::simulation::quantities::{self, Evaluated};
use crate::simulation::{Quantity, Source, Variable};

/// Part of its natural size that an output must reach for its differences to be measured by it.
const SMALLEST: f64 = 1e-3;

/// By what differences of an output are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    /// The size of the scene.
    Size,
    /// One radian, or a unit vector.
    Unit,
    /// Its own largest value.
    Largest,
}

/// An output with all its components.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub name: String,
    /// Indices of its components among the computed variables.
    pub members: Vec<usize>,
    pub measure: Measure,
    /// Whether it follows from accelerations: those of the first instant are of loads that begin at once.
    pub is_dynamic: bool,
    /// Whether it is a force or a moment.
    pub is_force: bool,
}

/// What an output changes from one run to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Difference {
    /// The largest over the experiment, relative.
    pub largest: f64,
    /// The time up to which it stays below the limit asked for, s; nothing where it does to the end.
    pub until: Option<f64>,
}

impl Difference {
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

/// The outputs of a scene that count.
///
/// # Errors
/// A name in `accuracy.of` that no output bears.
pub(super) fn groups(scene: &Scene, variables: &[Variable]) -> Result<Vec<Group>, Error> {
    let wanted = &scene.accuracy.of;
    let mut groups: Vec<Group> = Vec::new();
    for (index, variable) in variables.iter().filter(|v| v.is_computed()).enumerate() {
        let Some((measure, is_dynamic, counts)) = nature(variable.source) else {
            continue;
        };
        let name = variable.name.split('[').next().unwrap_or_default();
        if !(wanted.iter().any(|of| of == name) || wanted.is_empty() && counts) {
            continue;
        }
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => group.members.push(index),
            None => groups.push(Group {
                name: name.to_owned(),
                members: vec![index],
                measure,
                is_dynamic,
                is_force: is_force(variable.source),
            }),
        }
    }
    for (place, of) in wanted.iter().enumerate() {
        if !groups.iter().any(|group| group.name == *of) {
            let message =
                format!("expected the name of an output, without an index, found \"{of}\"");
            return Err(Error::new(format!("accuracy.of[{place}]"), message));
        }
    }
    if groups.is_empty() {
        let message = "expected an output to plan for, found none but energies, work and residuals";
        return Err(Error::new("outputs", message));
    }
    Ok(groups)
}

/// By what an output is measured, whether it follows from accelerations, and whether it counts where none are named;
/// nothing of what is no output.
fn nature(source: Source) -> Option<(Measure, bool, bool)> {
    use Quantity::*;
    let quantity = match source {
        Source::Output(quantity) => quantity,
        Source::NaturalFrequency(_) | Source::Eigenvalue(..) => {
            return Some((Measure::Largest, false, true));
        }
        Source::Time | Source::Parameter(_) | Source::Input(_) => return None,
    };
    let measure = match quantity {
        Position(..) | CenterOfMass(_) | Travel(_) => Measure::Size,
        Angle(_) | Direction(..) | Quaternion(..) | RotationVector(..) => Measure::Unit,
        _ => Measure::Largest,
    };
    let counts = !matches!(
        quantity,
        KineticEnergy
            | StrainEnergy
            | GravityEnergy
            | SpringEnergy
            | Input
            | Dissipated
            | Resolution
            | Residual(_)
    );
    let is_dynamic = quantities::needs(quantity) == Evaluated::Dynamics;
    Some((measure, is_dynamic, counts))
}

/// Whether an output is a force, a moment or a stress.
fn is_force(source: Source) -> bool {
    use Quantity::*;
    let Source::Output(quantity) = source else {
        return false;
    };
    matches!(
        quantity,
        AxialForce(_)
            | BendingMoment(..)
            | Torque(_)
            | Stress(_)
            | TorsionStress(_)
            | ConnectivityForce(..)
            | Reaction(..)
            | ReactionMoment(..)
            | MotionForce(..)
            | MotionMoment(..)
            | CouplingForce(..)
            | CouplingMoment(..)
    )
}

/// Components of an output at a point of a run.
fn at(group: &Group, run: &Run, point: usize) -> Vec<f64> {
    let row = &run.rows[point];
    group.members.iter().map(|member| row[*member]).collect()
}

/// Points of a run at which an output is compared.
fn points(group: &Group, run: &Run) -> std::ops::Range<usize> {
    usize::from(group.is_dynamic && run.rows.len() > 1)..run.rows.len()
}

/// By what differences of an output are measured, in its unit.
pub(super) fn scale(group: &Group, run: &Run) -> f64 {
    match group.measure {
        Measure::Size => run.size,
        Measure::Unit => 1.0,
        Measure::Largest => {
            let sizes = points(group, run).map(|point| norm(&at(group, run, point)));
            let natural = group.members.iter().map(|m| run.natural[*m]);
            sizes.fold(SMALLEST * natural.fold(0.0, f64::max), f64::max)
        }
    }
}

/// What an output changes from a run to one that is closer to the truth; `limit` is asked for.
pub(super) fn difference(group: &Group, run: &Run, closer: &Run, limit: f64) -> Difference {
    let size = scale(group, closer);
    let mut found = Difference {
        largest: 0.0,
        until: None,
    };
    for point in points(group, closer) {
        let (a, b) = (at(group, run, point), at(group, closer, point));
        let apart: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
        let relative = match size > 0.0 {
            true => norm(&apart) / size,
            false => 0.0,
        };
        if relative > limit && found.until.is_none() {
            found.until = Some(closer.times[point.saturating_sub(1)]);
        }
        found.largest = found.largest.max(relative);
    }
    found
}
