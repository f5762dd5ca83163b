//! Initial configurations: bodies are moved, each as a whole, until all joints fit. Where that is not enough,
//! joints are closed little by little while flexible bodies deform with the least strain energy. Then rates are
//! found that come closest to those given.
//!
//! The way is a Gauss-Newton iteration with the smallest steps (E. J. Haug, Computer Aided Kinematics and
//! Dynamics of Mechanical Systems (1989)), started from the bodies as described.

use nalgebra::{DVector, Vector3};

use super::equilibrium;
use super::held::OpenGaps;
use crate::bodies::{LineChain, Node, add_node, no_node};
use crate::math::least::Least;
use crate::math::space::{Vector, spins};
use crate::system::instant::Instant;
use crate::system::joints::{ConstraintKind, View};
use crate::system::loads::{AppliedLoad, BushingMeasure};
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};

/// Most iterations.
const ITERATIONS: usize = 200;
/// Gap at which joints fit, relative to the size of the system.
const CLOSE: f64 = 1e-9;
/// Gap that is roundoff.
const EXACT: f64 = 1e-15;

/// Part of the largest entry below which what others leave of a joint is nothing.
const DEPENDENT: f64 = 1e-9;

/// Rotation, rad, from which on a body whose orientation is driven is rotated at once.
const FAR: f64 = 0.1;

/// Gap, in sizes of the largest body, from which on joints as described cannot be meant.
const ABSURD: f64 = 100.0;

/// Mean strain of a cable from which on joints that it would have to close cannot be meant.
const STRETCHED: f64 = 0.5;

/// Gap of a joint that bodies do not close at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// The joint, by index.
    pub joint: usize,
    /// How much: m, or rad.
    pub size: f64,
    /// Whether it is an angle.
    pub is_angle: bool,
}

/// Joints that do not fit together.
#[derive(Clone, Debug, PartialEq)]
pub struct NotAssembled {
    /// The gaps that are left, or those as described where they are absurd.
    pub gaps: Vec<Gap>,
}

impl<const D: usize> System<D> {
    /// The state to start from: bodies as near to the reference as joints and motions allow, and rates
    /// as near to `rates` (over the nodes) in the mass norm.
    ///
    /// # Errors
    /// Joints that cannot be fitted.
    pub fn initial_state(
        &self,
        time: f64,
        inputs: &[f64],
        described: (&[Node<D>], &[Node<D>]),
        work: &mut Workspace<D>,
    ) -> Result<State, NotAssembled> {
        let mut state = self.blank_state(time);
        self.start_courses(&mut state, inputs);
        let (nodes, rates) = described;
        work.resume(&state);
        // Drives first: targets of the rows depend on them.
        self.forward_kinematics(time, &state.coordinates, None, work);
        self.find_slides(nodes, &mut work.kinematics.travel);
        let drawn = self.gaps_by_joint(nodes, work, 0.0);
        let bound = ABSURD * self.body_size();
        if (drawn.iter()).any(|gap| !gap.is_angle && bound > 0.0 && gap.size > bound) {
            return Err(NotAssembled { gaps: drawn });
        }
        let mut x = nodes.to_vec();
        self.rotate_driven(&mut x, work);
        let left = self.fit(&mut x, work);
        self.start_hints(&mut state, &x, inputs);
        (self.bodies).start_frames(nodes, &mut x, &mut state.frames);
        work.resume(&state);
        self.forward_kinematics(time, &state.coordinates, None, work);
        match left {
            Ok(()) => self.approach(&x, work, &mut state),
            Err(error) => self
                .close((nodes, &x), inputs, work, &mut state)
                .ok_or(error)?,
        }
        if self.start_moving(rates, inputs, work, &mut state) {
            Ok(state)
        } else {
            Err(NotAssembled { gaps: Vec::new() })
        }
    }

    /// Gives a state rates as near to those given over the nodes, in the mass norm, as joints and motions allow.
    /// False where they allow none.
    pub fn start_moving(
        &self,
        rates: &[Node<D>],
        inputs: &[f64],
        work: &mut Workspace<D>,
        state: &mut State,
    ) -> bool {
        work.resume(state);
        self.forward_kinematics(state.time, &state.coordinates, None, work);
        let mut start = work.scratch.other.clone();
        start.fill(no_node());
        self.add_driven(&work.kinematics.targets, 1, &mut start);
        work.kinematics.v = difference(rates, &start);
        work.scratch.other.fill(no_node());
        self.rates_of(work, &mut state.rates);
        let mut model = DrivenSystem::new(self, inputs, work, state);
        let holds = model.project(state);
        if holds {
            model.accepted(state);
            model.start_frictions(state);
        }
        holds
    }

    /// Nodal coordinates of a state.
    pub fn nodes_of(&self, state: &State, work: &mut Workspace<D>) -> Vec<Node<D>> {
        work.resume(state);
        self.forward_kinematics(state.time, &state.coordinates, None, work);
        work.kinematics.x.clone()
    }

    /// Coordinates that come closest to nodal ones in the mass norm.
    fn approach(&self, x: &[Node<D>], work: &mut Workspace<D>, state: &mut State) {
        let missing = difference(x, &work.kinematics.x);
        if missing.iter().any(|m| *m != no_node()) {
            self.coordinates_of(&missing, work, &mut state.coordinates);
        }
    }

    /// From bodies at `x`, whose joints are apart, to deformed ones that fit; nothing where flexible bodies cannot
    /// close the joints.
    fn close(
        &self,
        (nodes, x): (&[Node<D>], &[Node<D>]),
        inputs: &[f64],
        work: &mut Workspace<D>,
        state: &mut State,
    ) -> Option<()> {
        if self.bodies.lines().is_empty() {
            return None;
        }
        let mut open = OpenGaps {
            reference: vec![no_node(); x.len()],
            offsets: Vec::new(),
        };
        for (linear, holds) in self.linear.iter().zip(&self.holds) {
            let Some((cluster, row)) = holds else {
                continue;
            };
            let gap = self.gap_of(linear, x, work);
            let cluster = &self.elimination.assembly.clusters()[*cluster];
            let follow = cluster.multipliers.row(*row);
            for (i, node) in cluster.nodes.iter().enumerate() {
                let place = open.reference[*node].as_flattened_mut();
                for (k, place) in place.iter_mut().enumerate() {
                    *place += follow[2 * D * i + k] * gap;
                }
            }
        }
        let view = View {
            x,
            ..self.view(&work.kinematics)
        };
        open.offsets = self.constraints.iter().map(|c| c.value(&view)).collect();
        for (place, change) in work.kinematics.x.iter_mut().zip(&open.reference) {
            add_node(place, 1.0, change);
        }
        self.approach(x, work, state);
        equilibrium::close(self, inputs, (&open, nodes), work, state).ok()?;
        work.resume(state);
        self.forward_kinematics(state.time, &state.coordinates, None, work);
        let gaps = self.gaps(
            &work.kinematics.x,
            work,
            self.bodies.extent(&work.kinematics.x),
        );
        let fits = gaps.iter().all(|gap| gap.abs() <= CLOSE);
        let stretched =
            (self.bodies.lines().iter()).any(|c| c.mean_strain(&work.kinematics.x) > STRETCHED);
        (fits && !stretched).then_some(())
    }

    /// Size of the largest body, with what joins it: length of a cable, reach of the ends of joints from the centre
    /// of mass of a rigid body, length of a distance, m. 0 where there are only particles.
    pub fn body_size(&self) -> f64 {
        let cables = self.bodies.lines().iter().map(LineChain::length);
        let joints = self.joints.iter().flat_map(|joint| {
            let reach = joint.ends.each_ref().map(|end| match end.marker() {
                Some(marker) if marker.element.is_none() => marker.arm(),
                _ => 0.0,
            });
            [reach[0], reach[1], joint.length().unwrap_or(0.0)]
        });
        cables.chain(joints).fold(0.0, f64::max)
    }

    /// Gaps of joints in a described configuration that are larger than a part of the largest body, or than this
    /// angle in rad.
    pub fn initial_gaps(
        &self,
        (time, inputs): (f64, &[f64]),
        nodes: &[Node<D>],
        part: f64,
        work: &mut Workspace<D>,
    ) -> Vec<Gap> {
        let mut state = self.blank_state(time);
        self.start_courses(&mut state, inputs);
        work.resume(&state);
        self.forward_kinematics(time, &state.coordinates, None, work);
        self.find_slides(nodes, &mut work.kinematics.travel);
        let size = self.body_size();
        let gaps = self.gaps_by_joint(nodes, work, 0.0).into_iter();
        gaps.filter(|gap| gap.size > part * if gap.is_angle { 1.0 } else { size })
            .collect()
    }

    /// `q = T^T M dx`: coordinates that come closest to a nodal displacement in the mass norm.
    pub(in crate::system) fn coordinates_of(
        &self,
        dx: &[Node<D>],
        work: &mut Workspace<D>,
        q: &mut [f64],
    ) {
        self.bodies
            .momentum_of(dx, &work.kinematics.x, &mut work.forces.f);
        self.reduce_momentum(work, q);
    }

    /// `T^T` of the momentum in `work.forces.f`, in terms of rotations.
    fn reduce_momentum(&self, work: &mut Workspace<D>, q: &mut [f64]) {
        let Workspace {
            kinematics,
            forces,
            scratch,
            ..
        } = work;
        self.elimination.reduce(&forces.f, &mut scratch.y, q);
        self.to_rotations(kinematics, scratch, q);
    }

    /// Rates of coordinates that come closest, in the mass norm, to the rates `work.kinematics.v` of nodes less those that are driven, and to
    /// the momentum in `work.scratch.other` of material that passed through the mesh of cables before. Changes `work.kinematics.v`.
    pub(in crate::system) fn rates_of(&self, work: &mut Workspace<D>, rates: &mut [f64]) {
        let Workspace {
            kinematics,
            forces,
            scratch,
            change,
            ..
        } = &mut *work;
        if self.bodies.pays_out() {
            let (drives, x) = (&kinematics.drives, &kinematics.x);
            self.bodies
                .add_convective_momentum(drives, -1.0, x, &mut scratch.other);
            self.bodies.pull_back_scaled(drives, &mut scratch.other);
            (self.elimination).reduce(&scratch.other, &mut scratch.y, change);
            self.bodies.unscale_rates(drives, x, &mut kinematics.v);
        }
        self.bodies
            .momentum_of(&kinematics.v, &kinematics.x, &mut forces.f);
        self.reduce_momentum(work, rates);
        if self.bodies.pays_out() {
            (rates.iter_mut().zip(&work.change)).for_each(|(rate, more)| *rate += more);
        }
    }

    /// Motions that inputs drive start where the inputs say.
    fn start_courses(&self, state: &mut State, inputs: &[f64]) {
        for (driven, given) in state.driven.iter_mut().zip(self.trajectories()) {
            driven[..3].copy_from_slice(&given.start(inputs));
        }
    }

    /// Rotates bodies, each about its centre, whose orientations are driven to where they are to be: conditions that are sines of
    /// angles lead there from less than a quarter of a turn away.
    fn rotate_driven(&self, x: &mut [Node<D>], work: &Workspace<D>) {
        for constraint in &self.constraints {
            let ConstraintKind::DrivenOrientation(driven) = &constraint.kind else {
                continue;
            };
            let turn = driven.missing(x, &work.kinematics.drives);
            if driven.about == 0 && turn.norm() > FAR {
                let body = driven.axes[0].body;
                let about = self.center(body, x);
                self.move_body(
                    (self.bodies.ranges[body].clone(), about),
                    Vector::zeros(),
                    turn.into(),
                    x,
                );
            }
        }
    }

    /// Where angles and slides are counted from.
    fn start_hints(&self, state: &mut State, x: &[Node<D>], inputs: &[f64]) {
        for (value, angle) in state.angles.iter_mut().zip(&self.angles) {
            *value = angle.value(x, 0.0);
        }
        for load in &self.loads {
            // What a coupling rotates along with may have rotated fully before.
            if let AppliedLoad::Bushing(bushing) = load
                && let BushingMeasure::Angle(turning) = &bushing.measure
            {
                let outside = turning.angle.value(Instant {
                    time: self.now(state.time),
                    inputs,
                    input_rates: &[],
                    drives: &[],
                    x,
                    v: x,
                    bodies: &self.bodies,
                    angles: (&self.angles, &state.angles),
                });
                state.angles[turning.counted] = self.angles[turning.counted].value(x, outside);
            }
        }
        self.find_slides(x, &mut state.travel);
    }

    /// Moves bodies as a whole until rows and constraints hold, or else to where the least of them is missing that was found.
    fn fit(&self, x: &mut [Node<D>], work: &mut Workspace<D>) -> Result<(), NotAssembled> {
        let (size, free) = (self.bodies.extent(x), D + spins(D).len());
        let mut best = f64::INFINITY;
        // Sum of squares of gaps where it is least, and where that is.
        let (mut least, mut nearest) = (f64::INFINITY, x.to_vec());
        for iteration in 0..=ITERATIONS {
            self.find_slides(x, &mut work.kinematics.travel);
            let gaps = self.gaps(x, work, size);
            let largest = gaps.iter().map(|gap| gap.abs()).fold(0.0, f64::max);
            let done = largest <= EXACT || (largest <= CLOSE && largest > 0.5 * best);
            if done {
                return Ok(());
            }
            if iteration == ITERATIONS || !largest.is_finite() {
                break;
            }
            best = largest.min(best);
            let squares = gaps.iter().map(|gap| gap * gap).sum();
            if squares < least {
                least = squares;
                nearest.copy_from_slice(x);
            }
            let jacobian = self.rigid_jacobian(x, work, size);
            let gaps = DVector::from_vec(gaps);
            let step = Least::new(&jacobian, DEPENDENT).solve(&gaps);
            // Far from the solution a long step may rotate bodies over.
            let turn = |body: usize| {
                let mut turn = [0.0; 3];
                for (i, k) in spins(D).enumerate() {
                    turn[k] = step[free * body + D + i];
                }
                turn
            };
            let bodies = 0..self.bodies.ranges.len();
            let turns = bodies.map(|body| Vector3::from(turn(body)).norm());
            let fraction = (0.5 / turns.fold(0.0, f64::max)).min(1.0);
            for (body, nodes) in self.bodies.ranges.iter().enumerate() {
                let way = Vector::from_fn(|k, _| -fraction * step[free * body + k] * size);
                let turn = turn(body).map(|part| -fraction * part);
                let about = self.center(body, x);
                self.move_body((nodes.clone(), about), way, turn, x);
            }
        }
        // Steps do not end where they come closest: joints depend on each other there.
        x.copy_from_slice(&nearest);
        self.find_slides(x, &mut work.kinematics.travel);
        let gaps = self.gaps_by_joint(x, work, CLOSE);
        Err(NotAssembled { gaps })
    }
}

fn difference<const D: usize>(a: &[Node<D>], b: &[Node<D>]) -> Vec<Node<D>> {
    let pairs = a.iter().zip(b);
    let difference = |(a, b): (&Node<D>, &Node<D>)| {
        let mut difference = *a;
        add_node(&mut difference, -1.0, b);
        difference
    };
    pairs.map(difference).collect()
}
