//! Laws that hold for every element, in the plane and in space.

use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Element, Nodal, shape};
use nalgebra::{DMatrix, SMatrix, SVector};
use proptest::prelude::*;

use crate::laws::differences::{Outcome, apply, derivative, directions, scaled, within};
use crate::laws::specimen::{RigidMotion, Specimen};

/// Gauss-Legendre with 4 points on [0, 1], exact to degree 7: enough for products of cubics.
fn gauss_4() -> [(f64, f64); 4] {
    let (near, far) = ((6.0_f64 / 5.0).sqrt(), 30.0_f64.sqrt());
    let point = |sign: f64, s: f64| {
        let at = (3.0 / 7.0 - s * 2.0 / 7.0 * near).sqrt();
        (0.5 + 0.5 * sign * at, (18.0 + s * far) / 72.0)
    };
    [
        point(-1.0, -1.0),
        point(-1.0, 1.0),
        point(1.0, 1.0),
        point(1.0, -1.0),
    ]
}

/// The consistent mass is the integral of rho A S^T S and the report's numbers; what is added to it
/// weighs quadratic and cubic parts alone. Weight is the integral of rho A S.
pub fn inertia<const D: usize>(s: &Specimen<D>) -> Outcome {
    let (l, line_density) = (s.parameters.length, s.parameters.line_density);
    // Legendre polynomials up to the third degree, over 0 to 1: their coordinates and norms.
    let polynomials: [fn(f64) -> f64; 4] = [
        |_| 1.0,
        |x| 2.0 * x - 1.0,
        |x| 6.0 * x * x - 6.0 * x + 1.0,
        |x| ((20.0 * x - 30.0) * x + 12.0) * x - 1.0,
    ];
    let slopes: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 2.0], [-6.0, 6.0], [12.0, 12.0]];
    let coordinates = |k: usize| {
        let (p, d) = (polynomials[k], slopes[k]);
        SVector::from([p(0.0), d[0] / l, p(1.0), d[1] / l])
    };
    let mut weight = SVector::<f64, 4>::zeros();
    for (xi, w) in gauss_4() {
        weight += shape::values(xi, l) * (w * l * line_density);
    }
    let size = SVector::from([1.0, l, 1.0, l]);
    let off = (s.cable.weight() - weight).component_div(&size).abs().max();
    within("weight", off, 1e-15 * line_density * l)?;
    let consistent = |inertia| {
        let parameters = Parameters {
            inertia,
            ..s.parameters
        };
        Cable::<D>::new(parameters, None).mass()
    };
    let counts = [
        (Inertia::Consistent, [1.0; 4]),
        (Inertia::Corrected, [1.0, 1.0, 2.0, 26.0 / 3.0]),
    ];
    for (inertia, counts) in counts {
        let mass = consistent(inertia);
        for (i, count) in counts.iter().enumerate() {
            for j in 0..4 {
                let expected = if i == j {
                    count / (2.0 * i as f64 + 1.0)
                } else {
                    0.0
                };
                let found = coordinates(i).dot(&(mass * coordinates(j))) / (line_density * l);
                within("mass of a polynomial", (found - expected).abs(), 1e-13)?;
            }
        }
    }
    // Report Eq. 12, numerators over 420.
    let report = SMatrix::from([
        [156.0, 22.0, 54.0, -13.0],
        [22.0, 4.0, 13.0, -3.0],
        [54.0, 13.0, 156.0, -22.0],
        [-13.0, -3.0, -22.0, 4.0],
    ]) / 420.0;
    let unit = line_density * l * size * size.transpose();
    let found = consistent(Inertia::Consistent).component_div(&unit);
    within("report Eq. 12", (found - report).abs().max(), 1e-15)?;
    within("length", (s.cable.length() - l).abs(), 0.0)
}

/// The elastic force is minus the gradient of the energy.
pub fn force_is_gradient<const D: usize>(s: &Specimen<D>) -> Outcome {
    let l = s.parameters.length;
    let force = s.cable.force(&s.e, &Nodal::zeros());
    for direction in directions::<D>(l) {
        let slope = derivative(5e-4, |t| s.cable.energy(&(s.e + direction * t)));
        let off = (slope + force.dot(&direction)).abs();
        within("force and gradient", off, 1e-9 * s.energy_scale())?;
    }
    Ok(())
}

/// The stiffness is minus the derivative of the elastic force, and symmetric also at a rate.
pub fn stiffness_is_derivative<const D: usize>(s: &Specimen<D>) -> Outcome {
    let (l, rest) = (s.parameters.length, Nodal::zeros());
    let stiffness = s.cable.stiffness(&s.e, &rest);
    for direction in directions::<D>(l) {
        let change = derivative(5e-4, |t| s.cable.force(&(s.e + direction * t), &rest));
        let off = scaled(&(change + apply(&stiffness, &direction)), l)
            .abs()
            .max();
        within("stiffness and derivative", off, 1e-9 * s.energy_scale())?;
    }
    let moving = s.cable.stiffness(&s.e, &s.rate);
    for blocks in [&stiffness, &moving] {
        let (x, y) = (&s.directions[0], &s.directions[1]);
        let off = (x.dot(&apply(blocks, y)) - y.dot(&apply(blocks, x))).abs();
        let scale = s.energy_scale() * (1.0 + s.parameters.longest_damping_time());
        within("symmetry of the stiffness", off, 1e-12 * scale)?;
    }
    Ok(())
}

/// Neither force nor energy notices where space is and how it moves.
pub fn objectivity<const D: usize>(s: &Specimen<D>, motion: &RigidMotion<D>) -> Outcome {
    let l = s.parameters.length;
    let mut motion = motion.clone();
    motion.translation *= l;
    motion.velocity *= l;
    let scale = s.energy_scale() * (1.0 + s.parameters.longest_damping_time());
    let (e, rate) = (motion.place(&s.e), motion.rate(&s.e, &s.rate));
    let turned = motion.rotation * s.cable.force(&s.e, &s.rate);
    let off = scaled(&(s.cable.force(&e, &rate) - turned), l).abs().max();
    within("force in another frame", off, 1e-12 * scale)?;
    let off = (s.cable.energy(&e) - s.cable.energy(&s.e)).abs();
    within("energy in another frame", off, 1e-12 * scale)?;
    // The unstressed shape carries nothing, wherever it is and however it moves.
    let (e, rate) = (
        motion.place(&s.unstressed),
        motion.rate(&s.unstressed, &Nodal::zeros()),
    );
    let off = scaled(&s.cable.force(&e, &rate), l).abs().max();
    within("force without strain", off, 1e-13 * scale)?;
    within(
        "energy without strain",
        s.cable.energy(&e).abs(),
        1e-25 * scale,
    )
}

/// Forces and their moments about the origin sum to zero.
pub fn momentum<const D: usize>(s: &Specimen<D>) -> Outcome {
    let l = s.parameters.length;
    let force = s.cable.force(&s.e, &s.rate);
    let scale = s.energy_scale() * (1.0 + s.parameters.longest_damping_time());
    let sum = (force.column(0) + force.column(2)) * l;
    within("sum of forces", sum.abs().max(), 1e-13 * scale)?;
    for i in 0..D {
        for j in i + 1..D {
            let moment: f64 = (0..4)
                .map(|k| s.e[(i, k)] * force[(j, k)] - s.e[(j, k)] * force[(i, k)])
                .sum();
            within("sum of moments", moment.abs(), 1e-12 * scale)?;
        }
    }
    Ok(())
}

/// The energy falls by what the elastic force does, and damping only takes.
pub fn power<const D: usize>(s: &Specimen<D>) -> Outcome {
    let rate = derivative(5e-4, |t| s.cable.energy(&(s.e + s.rate * t)));
    let elastic = s.cable.force(&s.e, &Nodal::zeros()).dot(&s.rate);
    within("power", (rate + elastic).abs(), 2e-9 * s.energy_scale())?;
    let total = s.cable.force(&s.e, &s.rate).dot(&s.rate);
    let taken = s.rate.dot(&apply(&s.cable.damping(&s.e), &s.rate));
    let scale = s.energy_scale() * (1.0 + s.parameters.longest_damping_time());
    let off = (total + rate + taken).abs();
    within("power of damping", off, 2e-9 * scale)?;
    let dissipated = s.cable.force_by(&s.e, &s.rate, 1.0).1;
    let off = (dissipated - (elastic - total)).abs();
    within("dissipation", off, 1e-12 * scale)?;
    prop_assert!(taken >= -1e-13 * scale, "damping gives {taken:e} W");
    prop_assert_eq!(
        s.cable.is_damped(),
        s.parameters.longest_damping_time() > 0.0
    );
    Ok(())
}

/// The damping matrix is minus the derivative of the force by the rate, symmetric and not negative.
pub fn damping<const D: usize>(s: &Specimen<D>) -> Outcome {
    let (l, time) = (s.parameters.length, s.parameters.longest_damping_time());
    let damping = s.cable.damping(&s.e);
    let (scale, n) = (s.energy_scale() * time, 4 * D);
    let all = directions::<D>(l);
    for direction in &all {
        // The force is linear in the rate: any step is exact but for what cancels.
        let change = (s.cable.force(&s.e, &(s.rate + direction))
            - s.cable.force(&s.e, &(s.rate - direction)))
            * 0.5;
        let off = scaled(&(change + apply(&damping, direction)), l)
            .abs()
            .max();
        let lost = 1e-13 * s.energy_scale();
        within(
            "damping and derivative",
            off,
            1e-12 * scale + lost * time.min(1.0),
        )?;
    }
    let dense = DMatrix::from_fn(n, n, |r, c| all[r].dot(&apply(&damping, &all[c])));
    let off = (&dense - dense.transpose()).abs().max();
    within("symmetry of the damping", off, 1e-13 * scale)?;
    let lowest = dense.symmetric_eigenvalues().min();
    within("negative damping", -lowest, 1e-12 * scale)
}

/// Strains are those of the position field `r = S e`, measured by differences of positions.
pub fn strains<const D: usize>(
    s: &Specimen<D>,
    xi: f64,
    formula: impl Fn(&SVector<f64, D>, &SVector<f64, D>) -> (f64, f64),
) -> Outcome {
    let l = s.parameters.length;
    let position = |t: f64| s.e * shape::values(xi + t, l) / l;
    let slope = derivative(2e-2, position);
    // A cubic has no fourth differences: the plain second difference is exact.
    let h = 0.05;
    let bend = (position(h) - position(0.0) * 2.0 + position(-h)) / (h * h * l);
    let (strain, curvature) = formula(&slope, &bend);
    let (found, bent) = s.cable.strain(&s.e, xi);
    within("strain", (found - strain).abs(), 1e-11)?;
    within("curvature", (bent - curvature).abs() * l, 1e-10)
}
