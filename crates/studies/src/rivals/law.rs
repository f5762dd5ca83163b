//! What the report claims of the floating frame (section 2, after Eq. 12): with local slopes in place of infinitesimal
//! rotations as elastic coordinates it is equivalent to the absolute nodal coordinate formulation.
//!
//! Held here: for any state, positions, kinetic energy and accelerations are the same to roundoff, if the local field is
//! the whole cubic one (both components of all slopes, less the three coordinates that fix the frame) and if the elastic
//! energy is that of the absolute formulation. Not held, and shown: with the linear energy of small deflections, as floating
//! frames have it, accelerations differ in proportion to the deformation.

use flexbody::elements::StrainMeasure;
use flexbody::elements::cable::{Inertia, Parameters};
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use super::basis::{Basis, Lump, Shape};
use super::frame::FloatingFrame;
use super::{Body, Marker, Motion, Vector, plus, quarter, shape_functions, turned};
use crate::elements::rule::Rule;
use crate::formulations::{Node, Rod, uniform};

const GRAVITY: Vector = [1.3, -9.81];
const LENGTH: f64 = 1.2;
/// EA (N), EI (N m^2), kg/m.
const STIFFNESS: [f64; 2] = [40.0, 0.6];
const DENSITY: f64 = 1.7;

fn rod(elements: usize, gravity: Vector) -> Rod {
    let parameters = Parameters {
        length: LENGTH,
        axial_stiffness: STIFFNESS[0],
        bending_stiffness: STIFFNESS[1],
        line_of: flexbody::elements::cable::LineOf::Cable,
        line_density: DENSITY,
        axial_damping_time: 0.0,
        bending_damping_time: 0.0,
        strain: StrainMeasure::ThetaPrime,
        inertia: Inertia::Consistent,
    };
    Rod::new(uniform(parameters, elements), true, gravity)
}

/// Node, position or slope, and component of every local coordinate: all but the start and the direction there.
fn locals(elements: usize) -> Vec<(usize, usize, usize)> {
    let all = (0..4 * (elements + 1)).map(|i| (i / 4, i / 2 % 2, i % 2));
    all.filter(|place| ![(0, 0, 0), (0, 0, 1), (0, 1, 1)].contains(place))
        .collect()
}

/// The local shapes at a place.
fn shape(elements: usize, x: f64, times: usize) -> Shape {
    let l = LENGTH / elements as f64;
    let j = ((x / l) as usize).min(elements - 1);
    let values = shape_functions(x / l - j as f64, l, times);
    let places = locals(elements);
    let of = |d: usize| {
        let value = |&(node, kind, component): &(usize, usize, usize)| match node.checked_sub(j) {
            Some(end) if end < 2 && component == d => values[2 * end + kind],
            _ => 0.0,
        };
        places.iter().map(value).collect::<Vec<f64>>()
    };
    let n = places.len();
    Shape {
        x,
        u: of(0),
        w: of(1),
        slope: vec![0.0; n],
        shortening: vec![0.0; n * n],
    }
}

fn gauss(elements: usize) -> impl Iterator<Item = (f64, f64)> {
    let l = LENGTH / elements as f64;
    let points = Rule::Gauss(4).points();
    (0..elements).flat_map(move |j| {
        let points = points.clone();
        points
            .into_iter()
            .map(move |p| (l * (j as f64 + p.at), l * p.weight))
    })
}

/// The floating frame with local slopes; its elastic forces are added apart.
fn frame(elements: usize) -> FloatingFrame {
    let lumps: Vec<Lump> = gauss(elements)
        .map(|(x, weight)| Lump {
            shape: shape(elements, x, 0),
            mass: DENSITY * weight,
        })
        .collect();
    let markers = [0.0, 0.5 * LENGTH, LENGTH].map(|x| shape(elements, x, 0));
    let rest = vec![0.0; locals(elements).len()];
    FloatingFrame::new(Basis::new(&lumps, markers, rest, false))
}

/// Nodes in the frame for local coordinates, or for rates of them.
fn nodes(elements: usize, e: &[f64], reference: f64) -> Vec<Node> {
    let l = LENGTH / elements as f64;
    let straight = |i: usize| [[reference * l * i as f64, 0.0], [reference, 0.0]];
    let mut nodes: Vec<Node> = (0..=elements).map(straight).collect();
    for (&(node, kind, component), value) in locals(elements).iter().zip(e) {
        nodes[node][kind][component] += value;
    }
    nodes
}

/// Coordinates of the absolute formulation, their rates and their accelerations, from those of the floating frame.
fn absolute(elements: usize, q: &[f64], v: &[f64], a: &[f64]) -> [Vec<Node>; 3] {
    let (s, c) = q[2].sin_cos();
    let local = [
        nodes(elements, &q[3..], 1.0),
        nodes(elements, &v[3..], 0.0),
        nodes(elements, &a[3..], 0.0),
    ];
    let mut out = local.clone();
    for i in 0..=elements {
        for kind in 0..2 {
            let [at, rate, second] = [0, 1, 2].map(|k| local[k][i][kind]);
            let spun = plus(rate, v[2], quarter(at));
            let turning = plus(plus(second, 2.0 * v[2], quarter(rate)), a[2], quarter(at));
            let values = [at, spun, plus(turning, -v[2] * v[2], at)];
            for (k, whole) in [q, v, a].into_iter().enumerate() {
                let moved = turned([c, s], values[k]);
                out[k][i][kind] = match kind {
                    0 => plus([whole[0], whole[1]], 1.0, moved),
                    _ => moved,
                };
            }
        }
    }
    out
}

/// The scalar mass of the chain.
fn mass(rod: &Rod) -> DMatrix<f64> {
    let n = 2 * (rod.count() + 1);
    let mut mass = DMatrix::zeros(n, n);
    for (j, element) in rod.masses().iter().enumerate() {
        for (r, c) in (0..16).map(|i| (i / 4, i % 4)) {
            mass[(2 * j + r, 2 * j + c)] += element[r][c];
        }
    }
    mass
}

fn rows(nodes: &[Node]) -> DMatrix<f64> {
    DMatrix::from_fn(2 * nodes.len(), 2, |r, d| nodes[r / 2][r % 2][d])
}

/// Part of a deformation at which forces are linear.
const SMALL: f64 = 1e-4;

/// Elastic forces on the local coordinates: those of the product's cable in the frame, or the same made linear.
fn elastic(elements: usize, e: &[f64], linear: bool) -> Vec<f64> {
    if linear {
        let by = |part: f64| {
            let small: Vec<f64> = e.iter().map(|e| part * e).collect();
            elastic(elements, &small, false)
        };
        let (plus, minus) = (by(SMALL), by(-SMALL));
        let slope = |(p, m): (f64, f64)| (p - m) / (2.0 * SMALL);
        return plus.into_iter().zip(minus).map(slope).collect();
    }
    let local = nodes(elements, e, 1.0);
    let mut forces = local.clone();
    rod(elements, [0.0; 2]).force(&local, &mut forces);
    locals(elements)
        .iter()
        .map(|&(node, kind, d)| forces[node][kind][d])
        .collect()
}

/// Mass and accelerations of the floating frame.
fn accelerations(elements: usize, q: &[f64], v: &[f64], linear: bool) -> (DMatrix<f64>, Vec<f64>) {
    let (frame, n) = (frame(elements), q.len());
    let residual = |a: &[f64]| {
        let mut r = vec![0.0; n];
        frame.residual(Motion { q, v, a }, GRAVITY, &mut r);
        r
    };
    let rest = residual(&vec![0.0; n]);
    let mass = DMatrix::from_fn(n, n, |_, _| 0.0);
    let mass = (0..n).fold(mass, |mut mass, j| {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        let column = residual(&unit);
        (0..n).for_each(|i| mass[(i, j)] = column[i] - rest[i]);
        mass
    });
    let mut force = DVector::from_iterator(n, rest.iter().map(|r| -r));
    for (k, f) in elastic(elements, &q[3..], linear).into_iter().enumerate() {
        force[3 + k] += f;
    }
    let a = mass.clone().lu().solve(&force).expect("a regular mass");
    (mass, a.as_slice().to_vec())
}

/// Relative differences of positions, kinetic energy and accelerations of the two formulations.
fn apart(elements: usize, q: &[f64], v: &[f64], linear: bool) -> [f64; 3] {
    let (floating, a) = accelerations(elements, q, v, linear);
    let [x, rates, seconds] = absolute(elements, q, v, &a);
    let whole = rod(elements, GRAVITY);
    let mass = mass(&whole);
    let mut force = x.clone();
    whole.force(&x, &mut force);
    let expected = mass
        .clone()
        .lu()
        .solve(&rows(&force))
        .expect("a regular mass");
    let off = (rows(&seconds) - &expected).norm() / expected.norm();

    let spatial = rows(&rates);
    let kinetic = 0.5 * spatial.dot(&(&mass * &spatial));
    let v = DVector::from_column_slice(v);
    let energy = (0.5 * v.dot(&(floating * &v)) / kinetic - 1.0).abs();

    let body = frame(elements);
    let place = |(marker, at): (Marker, f64)| {
        let l = LENGTH / elements as f64;
        let j = ((at / l) as usize).min(elements - 1);
        let values = shape_functions(at / l - j as f64, l, 0);
        let sum = |d: usize| {
            (0..4)
                .map(|k| values[k] * x[j + k / 2][k % 2][d])
                .sum::<f64>()
        };
        let [a, b] = body.position(marker, q);
        (a - sum(0)).hypot(b - sum(1)) / LENGTH
    };
    let markers = [
        (Marker::Start, 0.0),
        (Marker::Middle, 0.5 * LENGTH),
        (Marker::End, LENGTH),
    ];
    [
        markers.map(place).into_iter().fold(0.0, f64::max),
        energy,
        off,
    ]
}

/// A state with local coordinates of a size.
fn state(elements: usize, size: f64, numbers: &[f64]) -> [Vec<f64>; 2] {
    let n = 3 + locals(elements).len();
    let q = (0..n).map(|i| {
        if i < 3 {
            3.0 * numbers[i]
        } else {
            size * numbers[i]
        }
    });
    let v = (0..n).map(|i| 2.0 * numbers[n + i]);
    [q.collect(), v.collect()]
}

proptest! {
    #[test]
    fn local_slopes_make_the_floating_frame_absolute(
        elements in 1_usize..5,
        numbers in vec(-1.0..1.0_f64, 48),
    ) {
        let [q, v] = state(elements, 0.3, &numbers);
        let [positions, energy, accelerations] = apart(elements, &q, &v, false);
        prop_assert!(positions < 1e-14, "positions {:e}", positions);
        prop_assert!(energy < 1e-12, "kinetic energy {:e}", energy);
        prop_assert!(accelerations < 1e-8, "accelerations {:e}", accelerations);
    }
}

#[test]
fn linear_strains_make_them_differ_with_the_deformation() {
    let numbers: Vec<f64> = (0..48).map(|i| (1.3 * f64::from(i) + 0.4).sin()).collect();
    let off = |size: f64| {
        let [q, v] = state(2, size, &numbers);
        apart(2, &q, &v, true)[2]
    };
    let (large, small) = (off(0.1), off(0.01));
    println!("accelerations apart by {large:.1e} at slopes of 0.1, {small:.1e} at 0.01");
    assert!(large > 0.02 && large > 5.0 * small, "{large:e} {small:e}");
}

#[test]
fn figures_of_the_equivalence() {
    let worst = (1..5).map(|elements| {
        let numbers: Vec<f64> = (0..48).map(|i| (2.1 * f64::from(i) + 0.7).sin()).collect();
        let [q, v] = state(elements, 0.3, &numbers);
        apart(elements, &q, &v, false)
    });
    let worst = worst.fold([0.0; 3], |w: [f64; 3], off| {
        std::array::from_fn(|k| w[k].max(off[k]))
    });
    println!("positions, kinetic energy, accelerations apart by {worst:?}");
    assert!(worst[2] < 1e-10, "{worst:?}");
}
