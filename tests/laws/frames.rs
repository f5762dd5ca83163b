//! Constraints one by one, on cables and rigid bodies in random states: derivatives by
//! differences.

use flexbody::bodies::{Bodies, Node, add_node};
use flexbody::elements::Element;
use flexbody::system::Drive;
use flexbody::system::joints::{Constraint, ConstraintKind, View};
use nalgebra::{DMatrix, DVector, Rotation2, Vector2};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::laws::differences::{Outcome, check, within};
use crate::laws::mechanism::{At, Body, Hold, Kind, Mechanism, Place, Point, Wave};
use crate::laws::random::pair;

const CASES: u32 = 200;

/// Two bodies in random states: coordinates, rates, and everything that constraints and loads look at.
pub struct Frame {
    pub made: Mechanism,
    pub bodies: Bodies,
    pub x: Vec<Node>,
    pub v: Vec<Node>,
}

/// Pairs of bodies with a place on each.
pub fn frames() -> impl Strategy<Value = Mechanism> {
    vec(0.0..1.0_f64, 80).prop_map(pair)
}

/// The pair deformed and in motion.
pub fn frame(made: Mechanism) -> Frame {
    let part = |from: usize, size: f64| -> Vec<Node> {
        let numbers = made.random(4 * made.nodes.len(), from);
        numbers
            .chunks_exact(4)
            .map(|x| [[size * x[0], size * x[1]], [size * x[2], size * x[3]]])
            .collect()
    };
    let (dx, v) = (part(5, 0.05), part(29, 1.0));
    let mut x = made.nodes.clone();
    for (x, dx) in x.iter_mut().zip(dx) {
        add_node(x, 1.0, &dx);
    }
    let mut bodies = Bodies::default();
    for line in made.chains() {
        bodies.add_line(line);
    }
    Frame { bodies, made, x, v }
}

/// Nodes moved along others.
pub fn along(x: &[Node], v: &[Node], s: f64) -> Vec<Node> {
    let mut x = x.to_vec();
    x.iter_mut().zip(v).for_each(|(x, v)| add_node(x, s, v));
    x
}

impl Frame {
    /// The non-linear constraints of a hold and what drives it.
    fn constraints(&self, hold: &Hold) -> (Vec<Constraint>, Vec<Drive>) {
        let (mut linear, mut nonlinear, mut drives) = (Vec::new(), Vec::new(), Vec::new());
        let joint = self.made.joint(hold, &mut drives);
        joint.constraints((0, &self.x), &mut linear, &mut nonlinear);
        (nonlinear, drives)
    }

    /// Calls `f` with the constraint's view at coordinates, rates and time.
    fn view<T>(
        &self,
        constraint: &Constraint,
        drives: &[Drive],
        (x, v, t): (&[Node], &[Node], f64),
        f: impl Fn(&Constraint, &View<'_, 2>) -> T,
    ) -> T {
        let drives: Vec<[f64; 3]> = (drives.iter())
            .map(|drive| match drive {
                Drive::Function(function) => function.derivatives(t),
                Drive::Input { .. } | Drive::Turned { .. } | Drive::Kept => [0.0; 3],
            })
            .collect();
        let travel = match &constraint.kind {
            ConstraintKind::PointOnCurve(along) => {
                vec![along.nearest(&self.bodies.lines()[along.chain], x)]
            }
            _ => Vec::new(),
        };
        let view = View {
            x,
            v,
            drives: &drives,
            bodies: &self.bodies,
            travel: &travel,
            angles: &[],
            released: &[],
        };
        f(constraint, &view)
    }

    /// Gradient over all nodes.
    fn gradient(&self, c: &Constraint, drives: &[Drive], x: &[Node], t: f64) -> DVector<f64> {
        self.view(c, drives, (x, &self.v, t), |c, view| {
            let mut gradient = DVector::zeros(4 * x.len());
            c.for_each(view, |node, term| {
                (0..4).for_each(|k| gradient[4 * node + k] += term.as_flattened()[k]);
            });
            gradient
        })
    }

    pub fn unit(&self, i: usize) -> Vec<Node> {
        let mut unit = vec![[[0.0; 2]; 2]; self.x.len()];
        unit[i / 4][i % 4 / 2][i % 2] = 1.0;
        unit
    }
}

/// Derivative by central differences, extrapolated twice.
pub fn slope(step: f64, f: impl Fn(f64) -> f64) -> f64 {
    let central = |h: f64| (f(h) - f(-h)) / (2.0 * h);
    let [a, b, c] = [step, 0.5 * step, 0.25 * step].map(central);
    let (coarse, fine) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
    (16.0 * fine - coarse) / 15.0
}

/// A random function of time.
pub fn wave(made: &Mechanism, k: usize) -> Wave {
    Wave {
        constant: 3.0 * made.noise[k],
        amplitude: made.noise[k + 1],
        frequency: 1.0 + made.noise[k + 2],
    }
}

/// Ends between the two bodies, from the ground to the second, and on one body.
pub fn ends(made: &Mechanism) -> [[Point; 2]; 3] {
    let [between, other] = [0, 1].map(|i| made.holds[i].ends);
    let ground = Vector2::new(made.noise[3], made.noise[4]);
    [between, [Point::Ground(ground), between[1]], other]
}

/// All kinds of holds between the two bodies, and to the ground.
fn holds(made: &Mechanism) -> Vec<Hold> {
    let mut holds = Vec::new();
    for ends in ends(made) {
        let turning = made.turns(ends[0]) && made.turns(ends[1]);
        holds.push((Kind::Distance(0.5 + 0.4 * made.noise[5]), ends));
        if turning {
            holds.push((Kind::Weld(3.0 * made.noise[6]), ends));
            holds.push((Kind::Orientation(3.0 * made.noise[7]), ends));
            let (y, x) = (2.0 * made.noise[8]).sin_cos();
            holds.push((
                Kind::Prismatic(Vector2::new(x, y), 3.0 * made.noise[6]),
                ends,
            ));
            holds.push((Kind::DrivenAngle(wave(made, 8)), ends));
        }
    }
    holds
        .into_iter()
        .map(|(kind, ends)| Hold { kind, ends })
        .collect()
}

fn constraint_derivatives(frame: &Frame, hold: &Hold) -> Outcome {
    let (constraints, drives) = frame.constraints(hold);
    let (x, v, t) = (&frame.x, &frame.v, 0.3);
    // The foot of a point is no polynomial.
    let (step, loss) = match hold.kind {
        Kind::Along => (4e-3, 1e-7),
        _ => (0.02, 1e-9),
    };
    for c in &constraints {
        let value =
            |x: &[Node], t: f64| frame.view(c, &drives, (x, &frame.v, t), |c, view| c.value(view));
        let gradient = frame.gradient(c, &drives, x, t);
        for i in 0..4 * x.len() {
            let unit = frame.unit(i);
            let exact = slope(step, |s| value(&along(x, &unit, s), t));
            within("gradient", (gradient[i] - exact).abs(), loss)?;
        }
        // By time alone.
        let rate = frame.view(c, &drives, (x, v, t), |c, view| c.rate(view));
        let exact = slope(step, |s| value(x, t + s));
        within("rate", (rate - exact).abs(), loss)?;
        // Second derivative along a motion without acceleration: that of dg/dt, which is the rate plus
        // gradient times rates.
        let dg = |s: f64| {
            let x = along(x, v, s);
            let part = frame.gradient(c, &drives, &x, t + s);
            let moving = DVector::from_column_slice(v.as_flattened().as_flattened());
            part.dot(&moving) + frame.view(c, &drives, (&x, v, t + s), |c, view| c.rate(view))
        };
        let bias = frame.view(c, &drives, (x, v, t), |c, view| c.bias(view));
        within("bias", (bias - slope(step, dg)).abs(), 10.0 * loss)?;
        stiffness(frame, c, &drives, t)?;
    }
    Ok(())
}

fn stiffness(frame: &Frame, c: &Constraint, drives: &[Drive], t: f64) -> Outcome {
    let (x, lambda) = (&frame.x, 1.7);
    let size = 4 * x.len();
    let found = frame.view(c, drives, (x, &frame.v, t), |c, view| {
        let mut found = DMatrix::zeros(size, size);
        c.stiffness(lambda, view, &mut |a, b, block| {
            for (r, row) in block.as_flattened().iter().enumerate() {
                for (col, part) in row.as_flattened().iter().enumerate() {
                    found[(4 * a + r, 4 * b + col)] += part;
                    if a != b {
                        found[(4 * b + col, 4 * a + r)] += part;
                    }
                }
            }
        });
        found
    });
    if matches!(c.kind, ConstraintKind::PointOnCurve(_)) {
        return within("no stiffness of slides", found.amax(), 0.0);
    }
    for i in 0..size {
        let unit = frame.unit(i);
        for j in 0..size {
            let exact = slope(0.02, |s| {
                frame.gradient(c, drives, &along(x, &unit, s), t)[j]
            });
            within("stiffness", (found[(j, i)] - lambda * exact).abs(), 1e-8)?;
        }
    }
    Ok(())
}

#[test]
fn derivatives_of_constraints_are_those_by_differences() {
    check(CASES, frames(), |made| {
        let frame = frame(made);
        for hold in holds(&frame.made) {
            constraint_derivatives(&frame, &hold)
                .map_err(|e| TestCaseError::fail(format!("{e} of {hold:?}")))?;
        }
        Ok(())
    });
}

/// A point on a cable: bias holds on the curve alone, so the point is put there.
#[test]
fn a_slide_along_a_cable_keeps_to_the_curve() {
    check(CASES, frames(), |made| {
        let ends = made.holds[0].ends;
        let Point::On(place) = ends[0] else {
            return Ok(());
        };
        // Inside one element: from one to the next the curvature jumps.
        let Body::Cable(elements) = &made.bodies[place.body] else {
            return Ok(());
        };
        let part = (0.5 + 0.2 * made.noise[0]) * elements[0].length();
        let inside = Place {
            at: At::Part(part / made.bodies[place.body].length()),
            ..place
        };
        let mut frame = frame(made);
        let apart = frame.made.apart(&frame.x);
        let [from, tangent] = frame.made.end(Point::On(inside), &apart);
        let way = from - frame.made.end(ends[1], &apart)[0];
        let range = frame.made.firsts[1]..frame.x.len();
        for node in &mut frame.x[range.clone()] {
            node[0][0] += way.x;
            node[0][1] += way.y;
        }
        // Velocities that keep it there: along the curve relative to it.
        let apart = frame.made.apart(&frame.v);
        let relative = frame.made.end_rate(ends[1], &apart)[0]
            - frame.made.end_rate(Point::On(inside), &apart)[0];
        let normal = Rotation2::new(0.5 * std::f64::consts::PI) * tangent.normalize();
        for node in &mut frame.v[range] {
            node[0][0] -= normal.x * normal.dot(&relative);
            node[0][1] -= normal.y * normal.dot(&relative);
        }
        constraint_derivatives(
            &frame,
            &Hold {
                kind: Kind::Along,
                ends,
            },
        )
    });
}
