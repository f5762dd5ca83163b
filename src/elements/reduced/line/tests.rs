//! Lines reduced to modes against the integration of finite rotations.
//!
//! Source: J. C. Simo, A finite strain beam formulation. The three-dimensional dynamic problem. Part I, Comput. Methods Appl. Mech. Eng. 49
//! (1985) 55-70 (strains).

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use super::{LineModes, LineSection, StraightLine};
use crate::elements::reduced::ReducedModel;
use crate::math::quadrature::GAUSS_5;

/// Steps of the midpoint rule in a segment.
const STEPS: usize = 400;
const LENGTH: f64 = 1.3;

/// A tapered beam with coupled sections, with three segments.
fn beam() -> (LineModes, StraightLine) {
    let ends = [0.0, 0.4, 0.7, LENGTH];
    let section = |s: f64| {
        let mut stiffness =
            Matrix6::from_diagonal(&Vector6::new(900.0, 400.0, 300.0, 2.0, 4.0, 3.0));
        (stiffness[(3, 4)], stiffness[(4, 3)]) = (0.4, 0.4);
        (stiffness[(0, 5)], stiffness[(5, 0)]) = (5.0, 5.0);
        LineSection {
            density: 2.0 - s,
            rotary: Matrix3::new(0.03, 0.004, 0.0, 0.004, 0.02, 0.0, 0.0, 0.0, 0.01),
            stiffness: stiffness * (1.5 - 0.5 * s),
        }
    };
    let segments = ends.windows(2);
    let line = StraightLine {
        ends: ends.to_vec(),
        sections: segments
            .map(|ends| GAUSS_5.map(|point| section(ends[0] + point.at * (ends[1] - ends[0]))))
            .collect(),
        strains: &[0, 1, 2, 3, 4, 5],
        markers: vec![("first".into(), 0), ("inner".into(), 1), ("last".into(), 3)],
    };
    let principal = |rows: [[f64; 3]; 3]| {
        let tensor = Matrix3::from_fn(|i, j| rows[i][j]);
        let eigen = tensor.symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        (eigen.eigenvalues.into(), axes)
    };
    let modes = LineModes::new(line.clone(), principal).expect("modes");
    (modes, line)
}

/// Place and rotation of every end of a segment from the first one, at these numbers of strains.
fn integrated(line: &StraightLine, numbers: &[f64]) -> Vec<(Vector3<f64>, Rotation3<f64>)> {
    let (mut at, mut rotation) = (Vector3::zeros(), Rotation3::identity());
    let mut found = vec![(at, rotation)];
    for (segment, ends) in line.ends.windows(2).enumerate() {
        let step = (ends[1] - ends[0]) / STEPS as f64;
        for k in 0..STEPS {
            let part = (k as f64 + 0.5) / STEPS as f64;
            let own = &numbers[18 * segment..18 * (segment + 1)];
            let weights = super::shapes(part);
            let strain = |of: usize| (0..3).map(|k| own[3 * of + k] * weights[k]).sum::<f64>();
            let stretch = Vector3::x() + Vector3::new(strain(0), strain(1), strain(2));
            let curvature = Vector3::new(strain(3), strain(4), strain(5));
            let half = rotation * Rotation3::new(curvature * (0.5 * step));
            at += half * stretch * step;
            rotation *= Rotation3::new(curvature * step);
        }
        found.push((at, rotation));
    }
    found
}

/// Ways between markers in the frame of the first one, from the model: second-order places, rotations to first order.
fn modelled(model: &ReducedModel, axes: &Matrix3<f64>, eta: &[f64]) -> Vec<Vector3<f64>> {
    let place = |k: usize| model.interfaces[k].deformed(eta);
    let ways = [1, 2].map(|k| axes * (place(k) - place(0)));
    ways.to_vec()
}

/// Distances between markers do not depend on rotations: what the model leaves is of third order.
#[test]
fn places_are_those_of_finite_rotations_to_second_order() {
    let (modes, line) = beam();
    let basis = modes
        .linear()
        .fixed_interface_modes(&[0, 2], 3)
        .expect("a basis");
    let (model, drawn) = modes.in_basis(&basis);
    assert_eq!(drawn.len(), 4);
    let n = basis.eigenvalues.len();
    let shape: Vec<f64> = (0..n)
        .map(|k| [0.9, -0.7, 0.5, 0.8][k % 4] / (1.0 + k as f64))
        .collect();
    let missed = |size: f64| {
        let most = basis.eigenvalues[0].sqrt();
        let eta: Vec<f64> = (shape.iter().zip(&basis.eigenvalues))
            .map(|(of, eigenvalue)| size * of * most / eigenvalue.sqrt())
            .collect();
        let columns = &modes.columns * &basis.columns;
        let numbers = columns * nalgebra::DVector::from_column_slice(&eta);
        let exact = integrated(&line, numbers.as_slice());
        let found = modelled(&model, &modes.axes, &eta);
        let of = |way: &Vector3<f64>, at: usize| way.norm() - exact[at].0.norm();
        of(&found[0], 1).abs().max(of(&found[1], 3).abs())
    };
    let [coarse, fine] = [0.1, 0.05].map(missed);
    assert!(coarse > 1e-6, "{coarse}");
    assert!(fine < 0.15 * coarse, "{coarse} {fine}");
}

/// Modes are orthonormal in the mass, against mean axes: derivatives of the inertia by differences of places are those of the arrays.
#[test]
fn strain_energy_and_static_shapes_are_those_of_the_line() {
    let (modes, line) = beam();
    let all = modes.linear();
    let basis = all.first_modes(all.modes());
    let columns = &modes.columns * &basis.columns;
    let stiffness = columns.tr_mul(&(line.stiffness() * &columns));
    for (k, eigenvalue) in basis.eigenvalues.iter().enumerate() {
        for l in 0..basis.eigenvalues.len() {
            let exact = if k == l { *eigenvalue } else { 0.0 };
            let scale = (eigenvalue * basis.eigenvalues[l]).sqrt();
            assert!((stiffness[(k, l)] - exact).abs() < 1e-7 * scale, "{k} {l}");
        }
    }
    // Forces across the last end against the first: the moment is linear along the line, and so are strains of a uniform one.
    let (model, _) = modes.in_basis(&basis);
    let [first, last] = [0, 2].map(|k| &model.interfaces[k]);
    let across = modes.axes.tr_mul(&Vector3::z());
    let compliance: f64 = (0..model.modes())
        .map(|k| {
            let rotation = first
                .rotation
                .as_ref()
                .map_or_else(Vector3::zeros, |of| of[k]);
            let way = last.position - first.position;
            let moved = last.modes[k] - first.modes[k] - rotation.cross(&way);
            across.dot(&moved).powi(2) / model.eigenvalues[k]
        })
        .sum();
    assert!(compliance > 0.0);
    let exact = quadrature(&line);
    assert!(
        (compliance / exact - 1.0).abs() < 2e-4,
        "{compliance} {exact}"
    );
}

/// Deflection along the second axis of a unit force there at the last end of the clamped line: the work of section forces.
fn quadrature(line: &StraightLine) -> f64 {
    let mut sum = 0.0;
    for (sections, ends) in line.sections.iter().zip(line.ends.windows(2)) {
        for (section, point) in sections.iter().zip(GAUSS_5) {
            let length = ends[1] - ends[0];
            let arm = LENGTH - ends[0] - point.at * length;
            let forces = Vector6::new(0.0, 0.0, 1.0, 0.0, -arm, 0.0);
            let strains = section.stiffness.lu().solve(&forces).expect("a stiffness");
            sum += forces.dot(&strains) * point.weight * length;
        }
    }
    sum
}
