//! Elements at free ends.
//!
//! Source: derivatives of the energy by differences; docs/decisions/0021-stable-equilibria.md.

use super::*;

const ROPE: Parameters = Parameters {
    length: 0.7,
    axial_stiffness: 50.0,
    bending_stiffness: 0.0,
    line_of: LineOf::Cable,
    line_density: 1.3,
    axial_damping_time: 0.0,
    bending_damping_time: 0.0,
    strain: StrainMeasure::ThetaPrime,
    inertia: Inertia::Corrected,
};

#[test]
fn forces_at_free_ends_are_derivatives_of_the_energy() {
    let (rest, h) = (Nodal::<2>::zeros(), 1e-6);
    let e = Nodal::<2>::from_column_slice(&[0.1, 0.0, 1.1, 0.2, 0.8, 0.1, 0.9, -0.3]);
    let rope = Cable::<2>::new(ROPE, None);
    for free in [[false, false], [false, true], [true, false], [true, true]] {
        let element = rope.with_free_ends(&e, free);
        let (force, stiffness) = (element.force(&e, &rest), element.stiffness(&e, &rest));
        for k in 0..8 {
            let moved = |sign: f64| {
                let mut e = e;
                e[k] += sign * h;
                e
            };
            let [ahead, behind] = [moved(1.0), moved(-1.0)];
            let slope = (element.energy(&ahead) - element.energy(&behind)) / (2.0 * h);
            assert!((slope + force[k]).abs() < 1e-7, "{free:?} {k}");
            let change = (element.force(&behind, &rest) - element.force(&ahead, &rest)) / (2.0 * h);
            for i in 0..8 {
                let entry = stiffness[i / 2][k / 2][(i % 2, k % 2)];
                assert!((entry - change[i]).abs() < 1e-6, "{free:?} {i} {k}");
            }
        }
    }
}

#[test]
fn the_slope_at_a_free_end_is_held_by_tension_inside() {
    // A hanging element under tension that falls to nothing at its end: stretched by a parabola.
    let strain = |s: f64| 0.02 * (ROPE.length - s);
    let end = 0.02 * (ROPE.length * ROPE.length / 2.0);
    let columns = [
        0.0,
        0.0,
        0.0,
        -1.0 - strain(0.0),
        0.0,
        -ROPE.length - end,
        0.0,
        -1.0,
    ];
    let e = Nodal::<2>::from_column_slice(&columns);
    // The slope rotates and the chord by a sixth of it: the middle does not notice.
    let mode = [0.0, 0.0, 0.0, 0.0, ROPE.length / 6.0, 0.0, 1.0, 0.0];
    let rope = Cable::<2>::new(ROPE, None);
    let held = |element: &Cable<2>| {
        let k = element.stiffness(&e, &Nodal::zeros());
        let entry = |i: usize, j: usize| mode[i] * k[i / 2][j / 2][(i % 2, j % 2)] * mode[j];
        (0..64).map(|n| entry(n / 8, n % 8)).sum::<f64>()
    };
    assert!(held(&rope).abs() < 1e-12);
    assert!(held(&rope.with_free_ends(&e, [false, true])) > 1e-3);
}
