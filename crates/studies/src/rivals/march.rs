//! The two integrators of all formulations: generalized-alpha at fixed steps, which keeps constraints of positions by
//! multipliers, and the classical method of Runge and Kutta.
//!
//! Source: M. Arnold, O. Bruls, Convergence of the generalized-alpha scheme for constrained mechanical systems, Multibody
//! Syst. Dyn. 18 (2007) 185-202, Eqs. 2-4 and section 5; equations are scaled by the step squared as in C. L. Bottasso,
//! D. Dopico, L. Trainelli, Multibody Syst. Dyn. 19 (2008) 3-20.

use std::time::Duration;

use cpu_time::ThreadTime;

use super::band::Band;
use super::system::{Factors, System};
use super::{BodyMarker, Motion, Vector};

/// Spectral radius at infinite frequency.
const RADIUS: f64 = 0.8;
/// Newton's method ends where this is left of unknowns, m and rad.
const LEFT: f64 = 1e-9;
const ITERATIONS: usize = 25;
/// A factor is made again where corrections shrink less.
const SLOW: f64 = 0.05;
/// Largest stable step of the classical method of Runge and Kutta times the largest frequency.
const STABLE: f64 = 2.828;

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Generalized-alpha with this step at most, s
    Alpha(f64),
    /// Runge-Kutta 4 with this part of the step that is stable at the start
    Explicit(f64),
}

/// Results of a run.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Positions of the markers at every time, m.
    pub positions: Vec<Vec<Vector>>,
    /// CPU time, s.
    pub spent: Duration,
    /// Steps and Newton iterations.
    pub counts: [usize; 2],
    /// Coordinates and rates at the end.
    pub end: [Vec<f64>; 2],
}

/// Integrates to every time and records the markers.
///
/// # Errors
/// The time at which steps fail or numbers are no longer finite, s.
pub fn run(
    system: &mut System,
    kind: Kind,
    times: &[f64],
    markers: &[BodyMarker],
) -> Result<Seen, f64> {
    let longest = match kind {
        Kind::Alpha(step) => step,
        Kind::Explicit(part) => part * STABLE / fastest(system),
    };
    let started = ThreadTime::now();
    let mut state = State::new(system);
    let mut seen = Seen {
        positions: Vec::new(),
        spent: Duration::ZERO,
        counts: [0; 2],
        end: Default::default(),
    };
    let mut from = 0.0;
    for until in times {
        let pieces = ((until - from) / longest - 1e-9).ceil().max(1.0);
        let h = (until - from) / pieces;
        for piece in 0..pieces as usize {
            let time = from + piece as f64 * h;
            let done = match kind {
                Kind::Alpha(_) => state.alpha(system, time, h),
                Kind::Explicit(_) => {
                    state.runge_kutta(system, time, h);
                    Some(0)
                }
            };
            seen.counts[0] += 1;
            seen.counts[1] += done.ok_or(time)?;
        }
        if !state.q.iter().all(|q| q.abs() < 1e6) {
            return Err(from);
        }
        let positions = markers
            .iter()
            .map(|marker| system.position(*marker, &state.q));
        seen.positions.push(positions.collect());
        from = *until;
    }
    seen.spent = started.elapsed();
    seen.end = [state.q, state.v];
    Ok(seen)
}

/// The largest frequency at the start, rad/s: power iteration.
pub fn fastest(system: &mut System) -> f64 {
    let [stiffness, mut mass] = system.matrices_at_rest();
    if mass.factor().is_none() {
        return f64::INFINITY;
    }
    let mut z: Vec<f64> = (0..system.size()).map(|i| (1.7 * i as f64).sin()).collect();
    let mut square = 0.0_f64;
    for _ in 0..400 {
        for (z, multiplier) in z.iter_mut().zip(&system.multiplier) {
            *z = if *multiplier { 0.0 } else { *z };
        }
        let size = z.iter().map(|z| z * z).sum::<f64>().sqrt();
        z.iter_mut().for_each(|z| *z /= size);
        let mut force = stiffness.times(&z);
        for (f, multiplier) in force.iter_mut().zip(&system.multiplier) {
            *f = if *multiplier { 0.0 } else { *f };
        }
        mass.solve(&mut force);
        z = force;
        let free = z.iter().zip(&system.multiplier).filter(|(_, held)| !**held);
        square = free.map(|(z, _)| z * z).sum::<f64>().sqrt();
    }
    square.sqrt()
}

/// Coordinates, rates, accelerations with multipliers, and what the recursion of generalized-alpha carries.
struct State {
    q: Vec<f64>,
    v: Vec<f64>,
    second: Vec<f64>,
    carried: Vec<f64>,
    multipliers: Vec<f64>,
    factors: Factors,
    band: Band,
    r: Vec<f64>,
    next: [Vec<f64>; 4],
}

impl State {
    fn new(system: &mut System) -> Self {
        let [q, v] = system.start.clone();
        let n = q.len();
        let mut state = Self {
            second: vec![0.0; n],
            carried: vec![0.0; n],
            multipliers: vec![0.0; n],
            factors: Factors::new(system),
            band: system.band(),
            r: vec![0.0; n],
            next: std::array::from_fn(|_| vec![0.0; n]),
            q,
            v,
        };
        system.acceleration(
            0.0,
            &state.q,
            &state.v,
            &mut state.factors,
            &mut state.second,
        );
        for i in 0..n {
            if system.multiplier[i] {
                state.multipliers[i] = state.second[i];
                state.second[i] = 0.0;
            }
        }
        state.carried.clone_from(&state.second);
        state
    }

    /// One step of generalized-alpha; the number of iterations, or nothing where they do not settle.
    fn alpha(&mut self, system: &mut System, time: f64, h: f64) -> Option<usize> {
        let inertia = (2.0 * RADIUS - 1.0) / (RADIUS + 1.0);
        let force = RADIUS / (RADIUS + 1.0);
        let beta = 0.25 * (1.0 - inertia + force).powi(2);
        let gamma = 0.5 - inertia + force;
        let by_a = (1.0 - inertia) / (beta * h * h * (1.0 - force));
        let by_v = gamma / (beta * h);
        let scale = 1.0 / by_a;
        let n = self.q.len();
        let (start, band, r) = (&self.q, &mut self.band, &mut self.r);
        let [q, v, a, carried] = &mut self.next;
        for i in 0..n {
            a[i] = self.second[i];
            carried[i] = ((1.0 - force) * a[i] + force * self.second[i]
                - inertia * self.carried[i])
                / (1.0 - inertia);
            let (old, new) = (self.carried[i], carried[i]);
            q[i] = start[i] + h * self.v[i] + h * h * ((0.5 - beta) * old + beta * new);
            v[i] = self.v[i] + h * ((1.0 - gamma) * old + gamma * new);
        }
        let (mut before, mut ratio) = (f64::INFINITY, 1.0);
        for iteration in 1..=ITERATIONS {
            let motion = Motion { q, v, a };
            system.residual(time + h, motion, &self.multipliers, r);
            if ratio > SLOW {
                let weights = [scale, scale * by_v, 1.0];
                system.tangent(time + h, motion, &self.multipliers, weights, band);
                band.factor()?;
            }
            for (r, multiplier) in r.iter_mut().zip(&system.multiplier) {
                *r *= if *multiplier { 1.0 } else { scale };
            }
            band.solve(r);
            let mut size = 0.0_f64;
            for i in 0..n {
                if system.multiplier[i] {
                    self.multipliers[i] -= r[i] * by_a;
                } else {
                    q[i] -= r[i];
                    v[i] -= by_v * r[i];
                    a[i] -= by_a * r[i];
                    size = size.max(r[i].abs());
                }
            }
            if !size.is_finite() {
                return None;
            }
            ratio = size / before;
            // What the next correction would be, where corrections are known to shrink.
            let shrinks = before.is_finite() && ratio < 0.5;
            let left = if shrinks {
                size * ratio / (1.0 - ratio)
            } else {
                size
            };
            before = size;
            if left < LEFT {
                self.carry(inertia, force);
                return Some(iteration);
            }
        }
        None
    }

    fn carry(&mut self, inertia: f64, force: f64) {
        let [q, v, a, carried] = &mut self.next;
        for i in 0..q.len() {
            carried[i] = ((1.0 - force) * a[i] + force * self.second[i]
                - inertia * self.carried[i])
                / (1.0 - inertia);
        }
        std::mem::swap(&mut self.q, q);
        std::mem::swap(&mut self.v, v);
        std::mem::swap(&mut self.second, a);
        std::mem::swap(&mut self.carried, carried);
    }

    /// One step of the classical method of Runge and Kutta.
    fn runge_kutta(&mut self, system: &mut System, time: f64, h: f64) {
        let [q, v, sum_q, sum_v] = &mut self.next;
        for (stage, old) in [
            (&mut *q, &self.q),
            (v, &self.v),
            (sum_q, &self.q),
            (sum_v, &self.v),
        ] {
            stage.copy_from_slice(old);
        }
        let [q, v, sum_q, sum_v] = &mut self.next;
        let stages = [
            (0.0, 1.0, 0.5),
            (0.5, 2.0, 0.5),
            (0.5, 2.0, 1.0),
            (1.0, 1.0, 0.0),
        ];
        for (at, weight, next) in stages {
            system.acceleration(time + at * h, q, v, &mut self.factors, &mut self.r);
            for i in 0..q.len() {
                if system.multiplier[i] {
                    continue;
                }
                let (rate, second) = (v[i], self.r[i]);
                sum_q[i] += h / 6.0 * weight * rate;
                sum_v[i] += h / 6.0 * weight * second;
                q[i] = self.q[i] + h * next * rate;
                v[i] = self.v[i] + h * next * second;
            }
        }
        self.q.copy_from_slice(sum_q);
        self.v.copy_from_slice(sum_v);
    }
}
