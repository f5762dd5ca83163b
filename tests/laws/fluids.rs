//! Fluids along cables in random states: damping by differences, power.

use flexbody::bodies::{LoadedLine, Node, NodeBlock};
use flexbody::math::quadrature::GAUSS_5;
use flexbody::math::space::Vector;
use flexbody::system::loads::{AppliedLoad, Fluid, FluidSegment, ForceElement as _, LineLoad};
use flexbody::system::{Instant, Signal};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use crate::laws::differences::{Outcome, check, derivative, within};
use crate::laws::frames::{Frame, along, frame, frames, wave};
use crate::laws::mechanism::Body;

const CASES: u32 = 100;
/// Time, s.
const T: f64 = 0.3;

/// A fluid along the first cable, if there is one.
fn fluid(frame: &Frame) -> Option<AppliedLoad> {
    let made = &frame.made;
    let body = made
        .bodies
        .iter()
        .position(|b| matches!(b, Body::Cable(_)))?;
    let chain = made.chain(body);
    let strip = |k: usize| FluidSegment {
        drag: [0.5, 0.2].map(|size| size * (1.0 + made.noise[k % 40])),
        buoyant: 0.3,
        inert: 0.4,
    };
    let points = GAUSS_5.len() * frame.bodies.lines()[chain].elements().len();
    Some(AppliedLoad::Fluid(Box::new(Fluid {
        on: LoadedLine::Chain(chain),
        strips: (0..points).map(strip).collect(),
        current: LineLoad {
            uniform: [40, 43].map(|k| Signal::Function(wave(made, k).function())),
            along: [Vec::new(), Vec::new()],
        },
        gravity: Vector::from([0.4, -9.0]),
        carried: (Vector::from([0.3, -0.2]), [0.0, 0.0, 0.6]),
        fraction: 0.8,
    })))
}

fn at<'a>(frame: &'a Frame, x: &'a [Node], v: &'a [Node]) -> Instant<'a, 2> {
    Instant {
        time: T,
        inputs: &[],
        input_rates: &[],
        drives: &[],
        x,
        v,
        bodies: &frame.bodies,
        angles: (&[], &[]),
    }
}

fn force(frame: &Frame, load: &AppliedLoad, x: &[Node], v: &[Node]) -> DVector<f64> {
    let mut f = vec![[[0.0; 2]; 2]; x.len()];
    load.add_force(at(frame, x, v), &mut f);
    DVector::from_column_slice(f.as_flattened().as_flattened())
}

fn law(frame: &Frame, load: &AppliedLoad) -> Outcome {
    let (x, v) = (&frame.x, &frame.v);
    let size = 4 * x.len();
    let mut damping = DMatrix::zeros(size, size);
    let mut enter = |a: usize, b: usize, block: &NodeBlock<2>| {
        for (r, row) in block.as_flattened().iter().enumerate() {
            for (c, part) in row.as_flattened().iter().enumerate() {
                damping[(4 * a + r, 4 * b + c)] += part;
                if a != b {
                    damping[(4 * b + c, 4 * a + r)] += part;
                }
            }
        }
    };
    load.add_tangent(at(frame, x, v), &mut |_, _, _| {}, &mut enter);
    let exact = |i: usize| {
        let unit = frame.unit(i);
        -derivative(1e-3, |s| force(frame, load, x, &along(v, &unit, s)))
    };
    let exact = DMatrix::from_columns(&(0..size).map(exact).collect::<Vec<_>>());
    // The third derivative jumps where the flow rotates.
    within(
        "damping",
        (&damping - &exact).amax(),
        1e-5 * (1.0 + exact.amax()),
    )?;
    let lowest = damping.clone().symmetric_eigenvalues().min();
    prop_assert!(lowest > -1e-12 * damping.amax());
    let moving = DVector::from_column_slice(v.as_flattened().as_flattened());
    let power = force(frame, load, x, v).dot(&moving);
    let [supplied, dissipated] = load.power(at(frame, x, v));
    within("power", (power - supplied + dissipated).abs(), 1e-10)?;
    prop_assert!(dissipated >= 0.0);
    Ok(())
}

#[test]
fn fluids_damp_and_take_power_as_they_say() {
    check(CASES, frames(), |made| {
        let frame = frame(made);
        fluid(&frame).map_or(Ok(()), |load| law(&frame, &load))
    });
}
