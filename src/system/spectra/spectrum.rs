//! Eigenvalues of small motions about a state: natural frequencies of what is conservative, decay rates and
//! frequencies of anything.

use std::ops::Range;

use nalgebra::{Complex, DMatrix, Matrix3, Vector3};

use super::dense::{general, noise, quadratic, roots, sort, symmetric};
use super::iteration::{self, NoEigenvalues};
use super::linearization::Linearization;
use crate::bodies::{Node, add_node, no_node};
use crate::math::space::{Vector, components};
use crate::system::loads::ForceElement as _;
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};

/// Free coordinates up to which all eigenvalues are computed, with dense matrices; and up to which they are
/// where this many times the number that is wanted exceeds them.
const SMALL: usize = 64;
pub(super) const MIDDLE: usize = 400;
const SHARE: usize = 3;
/// An eigenvalue `s = -decay_rate + i frequency`, or a pair of conjugate ones: `x = c e^(s t)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Rate at which the motion decays, 1/s; negative where it grows.
    pub decay_rate: f64,
    /// Angular frequency of the oscillation, rad/s, not negative; 0 of a real eigenvalue.
    pub frequency: f64,
}

/// Rate of rotation that counts as none, rad/s: a revolution in two centuries. Rates at the start are found by solving, so they have roundoff.
const STILL: f64 = 1e-9;

/// Why there is no spectrum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// More were wanted than there are: wanted, present.
    #[error("expected no more than the {1} that there are, found a count of {0}")]
    Count(usize, usize),
    /// A force that follows a marker of this body has no potential: there are no natural frequencies.
    #[error("expected forces with a potential, found one that follows body {0}")]
    NotConservative(usize),
    /// Cables rotate as a whole at this rate, rad/s.
    #[error(
        "expected cables that do not turn as a whole, found {0} rad/s: describe the scene in a frame that turns \
         with them (\"rotation\")"
    )]
    Turns(f64),
    /// A thin rigid rod of space, a section of a rod or a reduced body rotates at this rate, rad/s.
    #[error(
        "expected thin rods, rods and reduced bodies that do not turn in space, found one at {0} rad/s: describe the \
         scene in a frame that turns with them (\"rotation\")"
    )]
    Spins(f64),
    /// The cable of this body has been paid out by a length, m, at a rate, m/s.
    #[error(
        "expected winches that stand with cables as long as at the start, found {1} m of body {0} paid out, at {2} m/s"
    )]
    PaidOut(usize, f64, f64),
    /// Numbers that are not finite.
    #[error("expected a linearization of finite numbers, found others")]
    NotFinite,
    /// The iteration did not find them all: how many were wanted.
    #[error(
        "expected the {0} slowest for certain, found that the iteration does not converge: damped material gathers \
         eigenvalues at -1/damping_time, so ask for fewer"
    )]
    NotConverged(usize),
}

impl From<NoEigenvalues> for SpectrumError {
    fn from(error: NoEigenvalues) -> Self {
        match error {
            NoEigenvalues::NotFinite => Self::NotFinite,
            NoEigenvalues::Missing(wanted) => Self::NotConverged(wanted),
        }
    }
}

/// The equations of motion linearized at a state, `x'' + R x' + K x = 0`: an orthonormal basis, in the coordinates `q`,
/// of the motions that keep the constraints, then `K` and `R` in that basis.
pub fn linearized<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> [DMatrix<f64>; 3] {
    let linear = at(system, inputs, work, state);
    let (basis, [stiffness, damping]) = linear.dense();
    let columns = |i: usize, k: usize| basis[k][i];
    let basis = DMatrix::from_fn(linear.elimination.coordinates(), basis.len(), columns);
    [basis, stiffness, damping]
}

/// The equations linearized at a state as it is.
fn at<'a, const D: usize>(
    system: &'a System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> Linearization<'a, D> {
    let (q, v) = (&state.coordinates, &state.rates);
    DrivenSystem::new(system, inputs, work, state).linearize(state.time, q, v);
    system.linearization(state.time, work, false)
}

/// Lowest natural frequencies at rest, without dampers, rad/s: roots of the eigenvalues of `K`, those of negative
/// ones negative.
///
/// In a rotating frame they are the imaginary parts of the eigenvalues of `q'' + G q' + K q = 0` with the gyroscopic
/// matrix `G`; that a motion grows is said by minus its rate.
///
/// # Errors
/// Loads that follow, more frequencies than modes, and what the iteration does not find.
pub fn natural_frequencies<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
    count: usize,
) -> Result<Vec<f64>, SpectrumError> {
    let linear = at_rest(system, inputs, work, state)?;
    let modes = linear.modes();
    if count > modes {
        return Err(SpectrumError::Count(count, modes));
    }
    let signed = |square: &f64| square.abs().sqrt().copysign(*square);
    if !system.is_rotating() {
        let squares = match &linear {
            linear if is_small(linear, count) => {
                symmetric(&linear.dense().1[0]).ok_or(SpectrumError::NotFinite)?
            }
            linear if linear.terms.is_symmetric => {
                match iteration::lowest(system, work, linear, count) {
                    Err(NoEigenvalues::Missing(_))
                        if linear.elimination.coordinates() <= MIDDLE =>
                    {
                        symmetric(&linear.dense().1[0]).ok_or(SpectrumError::NotFinite)?
                    }
                    found => found?.iter().map(|mode| mode.square).collect(),
                }
            }
            linear => {
                let found = iteration::slowest(system, work, linear, count)?;
                let mut squares: Vec<f64> = found.iter().map(|s| -(s * s).re).collect();
                squares.sort_by(f64::total_cmp);
                squares
            }
        };
        return Ok(squares.iter().take(count).map(signed).collect());
    }
    let found = if is_small(&linear, count) {
        let (_, [stiffness, damping]) = linear.dense();
        quadratic(&stiffness, &damping).ok_or(SpectrumError::NotFinite)?
    } else {
        iteration::slowest(system, work, &linear, count)?
    };
    let size = found.iter().fold(0.0_f64, |m, s| m.max(s.norm()));
    // A mode at rest without stiffness is 0 twice.
    let is_zero = |s: &&Complex<f64>| s.norm() == 0.0;
    let zeros = found.iter().filter(is_zero).count().div_ceil(2);
    let mut frequencies: Vec<f64> = (found.iter())
        .filter(|s| !is_zero(s))
        .filter(|s| s.im > 1e-12 * size || s.re >= 0.0)
        .map(|s| if s.re > 1e-6 * size { -s.re } else { s.im })
        .chain(std::iter::repeat_n(0.0, zeros))
        .collect();
    if count > frequencies.len() {
        return Err(SpectrumError::Count(count, frequencies.len()));
    }
    frequencies.sort_by(f64::total_cmp);
    frequencies.truncate(count);
    Ok(frequencies)
}

/// Slowest eigenvalues (of least size) of `s^2 I + s R + K` at a state as it is, moving or not; pairs of conjugate
/// ones once, real ones each by itself.
///
/// # Errors
/// More eigenvalues than there are, and what the iteration does not find.
pub fn eigenvalues<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
    count: usize,
) -> Result<Vec<Eigenvalue>, SpectrumError> {
    let linear = at(system, inputs, work, state);
    refuse_paid_out(system, work, false)?;
    refuse_driven(system, work)?;
    // Nothing tells the spin of a thin rod about itself, and gyroscopic terms of sections are not linearized. Modes of a reduced body are
    // displacements along axes that rotate, so small motions beside a spin have no constant equations in axes that stand still (decision 73).
    let spin = system.bodies.largest_spin(work.kinematics.motion());
    if spin > STILL {
        return Err(SpectrumError::Spins(spin));
    }
    refuse_rotating(system, &linear, state)?;
    linear.hand_over(work);
    let mut found = if is_small(&linear, count) {
        all(&linear)?
    } else {
        let found = if linear.terms.is_symmetric && !linear.terms.is_damped {
            iteration::slowest_conservative(system, work, &linear, count)
        } else {
            iteration::slowest(system, work, &linear, count)
        };
        match found {
            // Eigenvalues that lie next to each other without end, as those of damped material do.
            Err(NoEigenvalues::Missing(_)) if linear.elimination.coordinates() <= MIDDLE => {
                all(&linear)?
            }
            found => found?,
        }
    };
    if count > found.len() {
        return Err(SpectrumError::Count(count, found.len()));
    }
    sort(&mut found);
    let eigenvalue = |s: &Complex<f64>| Eigenvalue {
        decay_rate: 0.0 - s.re,
        frequency: s.im.abs(),
    };
    Ok(found.iter().take(count).map(eigenvalue).collect())
}

/// All eigenvalues, by dense matrices; of a pair the one with the positive imaginary part.
fn all<const D: usize>(linear: &Linearization<'_, D>) -> Result<Vec<Complex<f64>>, SpectrumError> {
    let (basis, [stiffness, damping]) = linear.dense();
    if linear.terms.is_damped {
        return quadratic(&stiffness, &damping).ok_or(SpectrumError::NotFinite);
    }
    let terms = basis.iter().map(|q| linear.size(q)).fold(0.0, f64::max);
    if linear.terms.is_symmetric {
        let squares = symmetric(&stiffness).ok_or(SpectrumError::NotFinite)?;
        let real = squares.iter().map(|k| Complex::new(*k, 0.0));
        return Ok(roots(real, noise(squares.iter().copied(), terms)));
    }
    let squares = general(&stiffness).ok_or(SpectrumError::NotFinite)?;
    let noise = noise(squares.iter().map(|k| k.norm()), terms);
    Ok(roots(squares.into_iter(), noise))
}

/// Refuses cables of another length than that of reference, over whose coordinates nothing is linearized, and such that are paid out,
/// whose equations change in time.
fn refuse_paid_out<const D: usize>(
    system: &System<D>,
    work: &Workspace<D>,
    at_rest: bool,
) -> Result<(), SpectrumError> {
    for (_, winch) in system.bodies.winches() {
        let [travel, rate, _] = work.kinematics.drives[winch.coordinate];
        if travel.abs() > 1e-9 * winch.length || !(at_rest || rate == 0.0) {
            let body = system.bodies.body_from(winch.nodes.start);
            return Err(SpectrumError::PaidOut(
                body.expect("a winch pays out a body"),
                travel,
                rate,
            ));
        }
    }
    Ok(())
}

/// Refuses cables that rotate as a whole and as fast as they please: their stiffness rotates with them, so nothing is an
/// eigenvalue for longer than an instant, and in the frame that rotates with them gyroscopic forces act.
fn refuse_rotating<const D: usize>(
    system: &System<D>,
    linear: &Linearization<'_, D>,
    state: &State,
) -> Result<(), SpectrumError> {
    let elimination = &system.elimination;
    let (mut y, mut v) = (
        vec![0.0; elimination.scratch()],
        vec![no_node(); system.bodies.reference.len()],
    );
    elimination.expand(&state.coordinates, &mut y, &mut v);
    let mut x = v.clone();
    for (x, reference) in x.iter_mut().zip(&system.bodies.reference) {
        add_node(x, 1.0, reference);
    }
    elimination.expand(&state.rates, &mut y, &mut v);
    for chain in system.bodies.lines() {
        let shared = rotation(&x, &v, chain.range());
        let Some(turn) = shared.filter(|turn| turn.norm() > STILL) else {
            continue;
        };
        let [stiffness, _] = linear.project(std::slice::from_ref(&state.rates));
        if stiffness[(0, 0)].abs() <= 1e-9 * linear.size(&state.rates) {
            return Err(SpectrumError::Turns(match D {
                2 => turn.z,
                _ => turn.norm(),
            }));
        }
    }
    Ok(())
}

/// Refuses cables, rods and beams that rotate as a whole while a prescribed motion moves: centrifugal and gyroscopic terms of small motions
/// beside that rotation are not in the linearization. The nodes are those of the state with its rates.
fn refuse_driven<const D: usize>(
    system: &System<D>,
    work: &Workspace<D>,
) -> Result<(), SpectrumError> {
    if work
        .kinematics
        .drives
        .iter()
        .all(|[_, rate, _]| *rate == 0.0)
    {
        return Ok(());
    }
    let (x, v) = (&work.kinematics.x, &work.kinematics.v);
    let chains = system.bodies.lines().iter();
    let turns = chains.map(|chain| rotation(x, v, chain.range()));
    if let Some(turn) = turns.flatten().find(|turn| turn.norm() > STILL) {
        return Err(SpectrumError::Turns(turn.norm()));
    }
    let spin = (system.bodies).largest_section_spin(work.kinematics.motion());
    if spin > STILL {
        return Err(SpectrumError::Spins(spin));
    }
    Ok(())
}

/// Returns the angular velocity (rad/s) with which all slopes of some nodes rotate, if there is one that they share.
fn rotation<const D: usize>(
    x: &[Node<D>],
    v: &[Node<D>],
    nodes: Range<usize>,
) -> Option<Vector3<f64>> {
    let slope = |x: &Node<D>| Vector3::from(components(&Vector::from(x[1])));
    let turn = spin(nodes.clone().map(|node| [x, v].map(|x| slope(&x[node]))));
    let mut pairs = nodes.map(|node| [x, v].map(|x| slope(&x[node])));
    let is_shared =
        pairs.all(|[u, rate]| (rate - turn.cross(&u)).norm() <= 1e-9 * turn.norm() * u.norm());
    is_shared.then_some(turn)
}

/// The spin that comes closest to the rates of vectors: vectors and rates.
fn spin(vectors: impl Iterator<Item = [Vector3<f64>; 2]>) -> Vector3<f64> {
    let (mut inertia, mut momentum) = (Matrix3::zeros(), Vector3::zeros());
    for [u, rate] in vectors {
        inertia += Matrix3::identity() * u.norm_squared() - u * u.transpose();
        momentum += u.cross(&rate);
    }
    // A straight cable does not notice a rotation about itself.
    let solved = inertia
        .svd(true, true)
        .solve(&momentum, 1e-12 * inertia.norm());
    solved.unwrap_or_else(|_| Vector3::zeros())
}

/// The equations linearized at rest, assembled in `work` too.
///
/// # Errors
/// Loads that follow, cables that rotate as a whole.
pub(super) fn at_rest<'a, const D: usize>(
    system: &'a System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> Result<Linearization<'a, D>, SpectrumError> {
    let (q, v) = (&state.coordinates, &state.rates);
    if !work.kinematics.drives.is_empty() {
        DrivenSystem::new(system, inputs, work, state).linearize(state.time, q, v);
        refuse_driven(system, work)?;
    }
    let rest = vec![0.0; v.len()];
    DrivenSystem::new(system, inputs, work, state).linearize(state.time, q, &rest);
    refuse_paid_out(system, work, true)?;
    let linear = system.linearization(state.time, work, true);
    if let Some(load) = linear.follower {
        let parts = system.loads[load].parts(&system.bodies);
        let acted = parts.into_iter().flatten();
        let body = acted.filter_map(|node| system.bodies.body_of(node)).min();
        return Err(SpectrumError::NotConservative(
            body.expect("a load acts on a body"),
        ));
    }
    refuse_rotating(system, &linear, state)?;
    linear.hand_over(work);
    Ok(linear)
}

pub(super) fn is_small<const D: usize>(linear: &Linearization<'_, D>, count: usize) -> bool {
    let n = linear.elimination.coordinates();
    n <= SMALL || (n <= MIDDLE && SHARE * count > n)
}
