//! Static equilibrium: where all forces balance and, where the loads have a potential, it has a minimum.
//!
//! A path of systems leads there, from little load to all of it, or from joints that do not fit yet to ones that
//! do; the whole way is tried first, then it is halved where that fails. Each system on it is solved by Newton's
//! method (`newton.rs`). An equilibrium that is found is tested by the inertia of its tangent and left along
//! its lowest mode where it is not stable, as a straight column beyond its buckling load.
//!
//! Source: J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed., sections 3.4 and 10.3 (descent);
//! E. Riks, An incremental approach to the solution of snapping and buckling problems, Int. J. Solids Struct. 15
//! (1979) (branches).

mod balance;
mod motion;
mod newton;
mod predict;
mod unfold;
mod unsymmetric;

use std::cell::Cell;

use super::held::OpenGaps;
use super::steady::Steady;
use crate::bodies::Node;
use crate::math::space::Vector;
use crate::math::vector::norm;
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};
use newton::{AcceptanceTest, EDGE, Newton, stiffest};

/// Smallest step of the way.
const SMALLEST: f64 = 1.0 / 256.0;
/// Most steps, those that fail included.
const STEPS: usize = 2000;
/// Largest rotation of a slope in one step, where smaller ones are left to try, rad.
const BRANCH: f64 = 1.5;
/// Rotation of a slope that the next step aims at, rad.
const AIM: f64 = 1.2;
/// Rotation under all of the load, were the response linear, from which on the first step is shorter, rad.
const FAR: f64 = 6.0;
/// Largest step that closes joints with such a rotation.
const FOLDING: f64 = 2.0 * SMALLEST;
/// Most steps with larger rotations where smaller steps do not help. A hanging body then falls into place, or an arch
/// snaps through. More of them lead to equilibria with additional full rotations.
const LEAPS: usize = 2;
/// First step of a way that closes joints.
const CLOSING: f64 = 1.0 / 8.0;
/// Bending stiffness, relative to `EA L^2`, of ropes while joints are closed: they bend rather than fold.
const BENT: f64 = 1e-4;
/// Tolerance of the force balance, in units of one rounding of every coordinate and every sum. An element takes some
/// hundred operations, and Newton's method may end 45 roundings off (its `EXACT`). Of 95 scenes with equilibrium, 17 of
/// them without load, the balance was above 1 in nine and at most 51. Wrong states of the same tests showed 5e5 and
/// more.
const ROUNDINGS: f64 = 1e3;

/// Why no equilibrium was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no static equilibrium found beyond {reached:.4} of the load: {why}")]
pub struct NoEquilibrium {
    /// Fraction of the way that was reached.
    pub reached: f64,
    /// Reason why the search stopped there.
    pub why: Failure,
}

/// Why Newton's method found none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The last correction, relative to the size of the system.
    #[error(
        "the last Newton correction is {0:.1e} of the system's size; expected bodies that are held against their loads"
    )]
    Correction(f64),
    /// A rod, among the bodies, with an element that a correction bent or twisted beyond what its frames hold, and which that is.
    #[error("an element is bent or twisted beyond what it holds")]
    ElementOverDeformed(usize, usize),
    /// A body that moves away without end, among the bodies.
    #[error("a body moves away without end under the loads; expected bodies that are held")]
    Away(usize),
    /// The damped motion did not come to rest.
    #[error(
        "a damped motion from there came to no rest; expected loads under which bodies come to rest"
    )]
    Restless,
    /// The work was done that is allowed.
    #[error("the work limit is reached; expected an equilibrium within it")]
    Work,
    /// The iteration ended where forces do not balance.
    #[error(
        "expected forces that cancel to roundoff, found {:.1e} {} left, {:.1e} times that", .0.size, .0.unit(), .0.relative()
    )]
    Rest(Rest),
}

/// Residual of the force balance of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// The body.
    pub body: usize,
    /// Whether it is moments that are left, in N m, or forces, in N.
    pub is_moment: bool,
    /// Residual over the body's nodes, N or N m.
    pub size: f64,
    /// Roundoff expected there, N or N m.
    pub roundoff: f64,
}

impl Rest {
    /// Returns the residual relative to roundoff.
    pub fn relative(&self) -> f64 {
        self.size / self.roundoff
    }

    fn unit(&self) -> &'static str {
        if self.is_moment { "N m" } else { "N" }
    }
}

/// Properties of an equilibrium that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoundEquilibrium {
    /// Whether no motion lowers the potential, as far as roundoff lets see; true where the loads have none.
    pub is_stable: bool,
}

/// A steady rotation of all bodies about one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyRotation<const D: usize = 2> {
    /// Angular velocity, rad/s; in the plane the third component alone.
    pub rate: [f64; 3],
    /// The point, m.
    pub center: Vector<D>,
}

/// Finds the equilibrium under gravity, inputs, loads and those of the initial state, all held as they are at the
/// time of `state`, from its configuration; in a steady motion where one is given. Counts angles on the way and
/// leaves the rates at zero.
///
/// # Errors
/// When the smallest step of the loads does not converge; `state` is then that of the last one that did.
pub fn find<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &mut State,
    (steady, most_work): (Option<Steady<D>>, f64),
) -> Result<FoundEquilibrium, NoEquilibrium> {
    let mut held = system.held_at(inputs, work, state);
    if let Some(Steady { velocity, rate }) = steady {
        held.carry(velocity, rate);
    }
    let turning = steady.and_then(|steady| steady.turning());
    if let Some(SteadyRotation { rate, center }) = turning {
        held.turn(rate, center);
    }
    let way = |fraction: f64, work: &Workspace<D>| {
        let mut part = held.clone();
        part.scale_loads(fraction, work);
        part
    };
    let first = first_step(&held, inputs, work, state);
    let path = Path {
        inputs,
        predicts: false,
        kept: 0.0,
        swings: turning.is_none(),
        left: Cell::new(most_work),
    };
    let before = state.clone();
    let found = path.follow(first, way, work, state);
    let found = found.map(|found| path.unfold(&held, found, &before, work, state));
    match turning {
        // A rotation that nothing drives is neutral, and the tangent singular.
        Some(SteadyRotation { rate, .. }) if found.is_err() => {
            state.copy_from(&before);
            let kept = norm(&rate);
            let path = Path { kept, ..path };
            path.follow(first, way, work, state)
        }
        _ => found,
    }
}

/// Closes the joints that have gaps at `state`, step by step and without loads. The result is the configuration of
/// least strain energy near the one described.
///
/// # Errors
/// [`NoEquilibrium`] with the fraction of the path that was reached.
pub(super) fn close<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    (open, described): (&OpenGaps<D>, &[Node<D>]),
    work: &mut Workspace<D>,
    state: &mut State,
) -> Result<FoundEquilibrium, NoEquilibrium> {
    let mut held = system.held_at(inputs, work, state);
    held.unload();
    let ropes = held.clone();
    // A rope without bending stiffness would fold from element to element.
    held.stiffen(1.0, described);
    let way = |fraction: f64, _: &Workspace<D>| {
        let mut part = held.clone();
        part.open(open, 1.0 - fraction);
        part
    };
    let closing = Path {
        inputs,
        predicts: true,
        kept: 0.0,
        swings: true,
        left: Cell::new(f64::INFINITY),
    };
    let found = closing.follow(CLOSING, way, work, state)?;
    let bent = state.clone();
    let last = Path {
        predicts: false,
        ..closing
    };
    let relaxed = last.follow(1.0, |_, _| ropes.clone(), work, state);
    if relaxed.is_ok() && ropes.is_folded(state, work) {
        state.copy_from(&bent);
        return Ok(found);
    }
    relaxed
}

impl<const D: usize> System<D> {
    fn held_at(&self, inputs: &[f64], work: &mut Workspace<D>, state: &State) -> Self {
        let model = DrivenSystem::new(self, inputs, work, state);
        self.forward_kinematics(state.time, &state.coordinates, None, model.work);
        self.held(state.time, model.work, true)
    }
}

/// Which step of a way is tried.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tries {
    /// From where the way begins, as far as it may be.
    First,
    /// From an equilibrium on the way, with smaller ones left to try.
    Between,
    /// The smallest one.
    Last,
}

impl Tries {
    fn of(step: f64, reached: f64) -> Self {
        match (step < 2.0 * SMALLEST, reached > 0.0) {
            (true, _) => Self::Last,
            (false, true) => Self::Between,
            (false, false) => Self::First,
        }
    }
}

/// A way through systems.
struct Path<'a> {
    inputs: &'a [f64],
    /// Whether what changes along it moves nodes, so that a step starts from where that takes all others.
    predicts: bool,
    /// Shift that Newton's method keeps, 1/s.
    kept: f64,
    /// Whether the damped motion is tried where steps fail.
    swings: bool,
    /// Work that is left to do, operations times parts.
    left: Cell<f64>,
}

impl Path<'_> {
    /// Follows systems from 0 to 1, in a first step that is given.
    fn follow<const D: usize>(
        &self,
        first: f64,
        way: impl Fn(f64, &Workspace<D>) -> System<D>,
        work: &mut Workspace<D>,
        state: &mut State,
    ) -> Result<FoundEquilibrium, NoEquilibrium> {
        let (mut reached, mut step) = (0.0, first);
        let mut why = Failure::Correction(f64::INFINITY);
        let (mut from, mut before) = (state.clone(), way(0.0, work));
        let mut found = FoundEquilibrium { is_stable: true };
        let mut leaps = 0;
        for _ in 0..STEPS {
            if reached >= 1.0 {
                return Ok(found);
            }
            let target = f64::min(1.0, reached + step);
            let next = way(target, work);
            let tries = Tries::of(step, reached);
            let mut outcome = self.attempt((&before, &next), tries, work, (&from, state));
            // Far from the last equilibrium there may be another one, with a revolution more.
            let mut model = DrivenSystem::new(&next, self.inputs, work, &from);
            let turn = model.rotation_between([&from, state]);
            let leaps_on = turn > BRANCH;
            // Where joints close, it is an element that folded.
            let largest = if self.predicts {
                FOLDING
            } else {
                SMALLEST.sqrt()
            };
            if leaps_on && (step > largest || leaps == LEAPS) {
                outcome = Err(why);
            }
            match outcome {
                Ok(now) => {
                    leaps += usize::from(leaps_on);
                    (reached, found) = (target, now);
                    // As far as the next one rotates no slope too far either.
                    step *= (AIM / turn).clamp(0.5, 2.0);
                    from.copy_from(state);
                    before = next;
                }
                Err(left) => {
                    state.copy_from(&from);
                    why = left;
                    step /= 2.0;
                    if step < SMALLEST || why == Failure::Work {
                        break;
                    }
                }
            }
        }
        if self.swings && !self.predicts && why != Failure::Work {
            let whole = way(1.0, work);
            match self.with_newton(&whole, work, state, |newton, state| newton.swing(state)) {
                Ok(found) => return Ok(found),
                Err(error) => {
                    state.copy_from(&from);
                    let is_known =
                        matches!(why, Failure::ElementOverDeformed(..) | Failure::Rest(_));
                    if !(is_known && error == Failure::Restless) {
                        why = error;
                    }
                }
            }
        }
        Err(NoEquilibrium { reached, why })
    }

    /// One step of the way: under one guard after the other, and at last by a damped motion where joints close.
    fn attempt<const D: usize>(
        &self,
        (before, next): (&System<D>, &System<D>),
        tries: Tries,
        work: &mut Workspace<D>,
        (from, state): (&State, &mut State),
    ) -> Result<FoundEquilibrium, Failure> {
        let guards = if next.is_conservative() {
            [AcceptanceTest::Turns, AcceptanceTest::Potential]
        } else {
            [AcceptanceTest::Turns, AcceptanceTest::Transient]
        };
        let start = |work: &mut Workspace<D>, state: &mut State| {
            state.copy_from(from);
            if self.predicts {
                self.predict((before, next), work, state);
            }
        };
        let mut outcome = Err(Failure::Correction(f64::INFINITY));
        for guard in guards {
            if outcome.is_err() {
                start(work, state);
                let is_hasty = tries == Tries::Between;
                outcome = self.with_newton(next, work, state, |newton, state| {
                    newton.is_hasty = is_hasty;
                    newton.settle(state, guard)
                });
            }
        }
        if outcome.is_err() && tries == Tries::Last && self.predicts && self.swings {
            start(work, state);
            outcome = self.with_newton(next, work, state, |newton, state| newton.swing(state));
        }
        outcome
    }

    /// An iteration on a system within the work that is left.
    fn with_newton<const D: usize, T>(
        &self,
        system: &System<D>,
        work: &mut Workspace<D>,
        state: &mut State,
        find: impl FnOnce(&mut Newton<'_, '_, D>, &mut State) -> T,
    ) -> T {
        let least = smallest_shift(system, self.inputs, work, state);
        let mut model =
            DrivenSystem::new(system, self.inputs, work, state).limited(self.left.get());
        let found = find(&mut Newton::new(&mut model, least, self.kept), state);
        let done = model.operations() * system.parts() as f64;
        self.left.set(self.left.get() - done);
        found
    }

    /// Moves all nodes as the tangent asks for when those that joints hold move on to the next system, and onto the constraints of that one.
    fn predict<const D: usize>(
        &self,
        (before, next): (&System<D>, &System<D>),
        work: &mut Workspace<D>,
        state: &mut State,
    ) {
        let least = smallest_shift(before, self.inputs, work, state);
        let mut model = DrivenSystem::new(before, self.inputs, work, state);
        Newton::new(&mut model, least, 0.0).predict(state, next);
        // Where this fails, so does Newton's method, which tells.
        DrivenSystem::new(next, self.inputs, work, state).accepted(state);
    }
}

/// First step of the way to all of the load: a part of it where moments that have no potential would rotate rods and beams far.
/// Newton's method fails there, and takes long to do so.
fn first_step<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> f64 {
    if system.is_conservative() || system.bodies.all_sections().is_empty() {
        return 1.0;
    }
    let least = smallest_shift(system, inputs, work, state);
    let n = state.coordinates.len();
    let (rest, mut x) = (vec![0.0; n], vec![0.0; n]);
    let mut model = DrivenSystem::new(system, inputs, work, state);
    model.acceleration(state.time, &state.coordinates, &rest, &mut x);
    model.linearize(state.time, &state.coordinates, &rest);
    if !model.factor([least * least, least]) {
        return 1.0;
    }
    model.solve_small(&mut x);
    let part = 1e-3 * system.scale() / norm(&x);
    if !part.is_finite() {
        return 1.0;
    }
    let pairs = state.coordinates.iter().zip(&x);
    let moved: Vec<f64> = pairs.map(|(q, x)| q + part * x).collect();
    let turn = model.largest_rotation(&state.coordinates, &moved) / part;
    if turn > FAR {
        (AIM / turn).max(SMALLEST)
    } else {
        1.0
    }
}

/// Root of the smallest multiple of the mass that regularizes the tangent: a part of the stiffest mode that is at
/// the edge of roundoff; without stiffness, what lets the forces there are move the system by a part of its size.
fn smallest_shift<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> f64 {
    let mut model = DrivenSystem::new(system, inputs, work, state);
    let stiffest = stiffest(&mut model, state);
    if stiffest > 0.0 {
        return EDGE * stiffest.sqrt();
    }
    let n = state.coordinates.len();
    let (rest, mut force) = (vec![0.0; n], vec![0.0; n]);
    model.acceleration(state.time, &state.coordinates, &rest, &mut force);
    (norm(&force) / system.scale()).sqrt()
}
