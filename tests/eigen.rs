//! Eigenvalues of dense matrices, held against faer, which shares no code with them, and closed forms.

use flexbody::math::eigen::{eigenvalues, symmetric_eigenvalues};

type Matrix = Box<dyn Fn(usize, usize) -> f64>;

/// Largest difference of two sets of numbers, each matched with the nearest that is left.
fn distance(found: &[(f64, f64)], expected: &[(f64, f64)]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let mut left = expected.to_vec();
    let mut worst = 0.0_f64;
    for (re, im) in found {
        let away = |z: &(f64, f64)| (z.0 - re).hypot(z.1 - im);
        let nearest = (0..left.len()).min_by(|i, j| away(&left[*i]).total_cmp(&away(&left[*j])));
        worst = worst.max(away(&left.swap_remove(nearest.expect("as many"))));
    }
    worst
}

/// Numbers between -1 and 1 that depend on nothing but their place.
fn noise(i: usize, j: usize) -> f64 {
    let mut bits = (i as u64) << 32 | j as u64;
    for _ in 0..3 {
        bits = (bits ^ bits >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    }
    (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Bending of a beam, whose entries spread over five diagonals.
fn bending(i: usize, j: usize) -> f64 {
    [6e9, -4e9, 1e9].get(i.abs_diff(j)).copied().unwrap_or(0.0)
}

/// Symmetric matrices that iterations have failed on: no diagonal, many equal or no eigenvalues, entries of
/// all sizes.
fn symmetric() -> Vec<(&'static str, Matrix)> {
    vec![
        ("random", Box::new(|i, j| noise(i.min(j), i.max(j)))),
        ("nothing", Box::new(|_, _| 0.0)),
        ("ones", Box::new(|_, _| 1.0)),
        (
            "no diagonal",
            Box::new(|i, j| f64::from(i.abs_diff(j) == 1)),
        ),
        (
            "of rank three",
            Box::new(|i, j| (0..3).map(|k| noise(i, k) * noise(j, k)).sum()),
        ),
        (
            "graded",
            Box::new(|i, j| (1.0 + 0.3 * noise(i + j, 7)) * 10_f64.powf(-0.2 * (i + j) as f64)),
        ),
        ("Hilbert's", Box::new(|i, j| 1.0 / (i + j + 1) as f64)),
        ("huge", Box::new(|i, j| 1e300 * noise(i + j, 1))),
        ("tiny", Box::new(|i, j| 1e-300 * noise(i + j, 1))),
        ("bending", Box::new(bending)),
    ]
}

/// Others: cycles, chains of gyroscopes and Jordan blocks stop an iteration without exceptional shifts.
fn general(n: usize) -> Vec<(&'static str, f64, Matrix)> {
    let half = n / 2;
    vec![
        ("random", 1e-13, Box::new(noise)),
        ("nothing", 0.0, Box::new(|_, _| 0.0)),
        ("skew", 1e-13, Box::new(|i, j| noise(i, j) - noise(j, i))),
        (
            "cycle",
            1e-13,
            Box::new(move |i, j| f64::from(j == (i + 1) % n)),
        ),
        (
            "gyroscopes",
            1e-13,
            Box::new(|i, j| f64::from(j == i + 1) - f64::from(i == j + 1)),
        ),
        ("Jordan's", 0.0, Box::new(|i, j| f64::from(i == j + 1))),
        (
            "of rank three",
            1e-13,
            Box::new(|i, j| (0..3).map(|k| noise(i, k) * noise(k, j)).sum()),
        ),
        (
            "vibrations",
            1e-12,
            Box::new(move |i, j| match (i < half, j < half) {
                (true, _) => f64::from(j == i + half),
                (false, true) => -1e-9 * bending(i - half, j),
                (false, false) => f64::from(j == i + 1) - f64::from(i == j + 1),
            }),
        ),
    ]
}

/// Reference: faer, which shares no code with nalgebra or the iteration here.
#[test]
fn agrees_with_faer_on_hard_symmetric_matrices() {
    for n in [1, 2, 3, 5, 12, 40, 90] {
        for (name, entry) in symmetric() {
            let found = symmetric_eigenvalues(n, &entry).expect(name);
            let matrix = faer::Mat::from_fn(n, n, &entry);
            let expected = matrix
                .self_adjoint_eigenvalues(faer::Side::Lower)
                .expect(name);
            let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            for (a, b) in found.iter().zip(&expected) {
                assert!(
                    (a - b).abs() <= 1e-14 * size * (n as f64).sqrt(),
                    "{name} {n}: {a} {b}"
                );
            }
        }
    }
    assert_eq!(symmetric_eigenvalues(0, |_, _| 1.0), Some(Vec::new()));
}

/// Reference: faer.
#[test]
fn agrees_with_faer_on_hard_general_matrices() {
    for n in [1, 2, 3, 4, 6, 8, 20, 40, 90] {
        for (name, limit, entry) in general(n) {
            let found = eigenvalues(n, &entry).unwrap_or_else(|| panic!("{name} {n}"));
            let matrix = faer::Mat::from_fn(n, n, &entry);
            let expected = matrix.eigenvalues().expect(name);
            let expected: Vec<_> = expected.iter().map(|z| (z.re, z.im)).collect();
            let size = expected.iter().fold(0.0_f64, |m, z| m.max(z.0.hypot(z.1)));
            let error = distance(&found, &expected);
            assert!(error <= limit * size, "{name} {n}: {error:e} of {size:e}");
        }
    }
    assert_eq!(eigenvalues(0, |_, _| 1.0), Some(Vec::new()));
    assert!(eigenvalues(3, |_, _| f64::INFINITY).is_none());
}

/// Small integers give every kind of coincidence.
#[test]
fn matrices_of_small_integers_all_have_eigenvalues() {
    for number in 0..30_000 {
        let n = 3 + number % 6;
        let entry = |i: usize, j: usize| (2.0 * noise(number, 8 * i + j)).trunc();
        let found = eigenvalues(n, entry).unwrap_or_else(|| panic!("number {number}"));
        let trace: f64 = (0..n).map(|i| entry(i, i)).sum();
        let (re, im) = found
            .iter()
            .fold((0.0, 0.0), |sum, z| (sum.0 + z.0, sum.1 + z.1));
        assert!(
            (re - trace).abs() < 1e-13 && im.abs() < 1e-13,
            "number {number}: {found:?}"
        );
    }
}

/// Four eigenvalues that are zero but for roundoff: what the iteration was once left with.
#[test]
fn ends_on_nearly_defective_matrices() {
    let rows = [
        [1.2e-10, 5.8e-5, 5.0e-3, -1.7e-2],
        [-5.3e-12, 7.7e-8, 6.5e-6, 7.4e-4],
        [0.0, -8.9e-10, -7.5e-8, -8.5e-6],
        [0.0, 0.0, 2.3e-11, -1.7e-9],
    ];
    // Beside others of size 1, which the roundoff is measured by.
    let entry = |i: usize, j: usize| match (i < 4, j < 4) {
        (true, true) => rows[i][j],
        (false, false) => 2.0 * noise(i, j),
        _ => 0.0,
    };
    let found = eigenvalues(12, entry).expect("eigenvalues");
    let small = found.iter().filter(|z| z.0.hypot(z.1) < 1e-6);
    assert_eq!((found.len(), small.count()), (12, 4));
}

#[test]
fn finds_the_eigenvalues_of_a_chain() {
    // Fixed-fixed chain of springs: 2 - 2 cos(k pi / (n + 1)).
    let n = 12;
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let values = symmetric_eigenvalues(n, entry).expect("a finite matrix");
    for (k, value) in values.iter().enumerate() {
        let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
        assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-14);
    }
    assert!(symmetric_eigenvalues(2, |_, _| f64::NAN).is_none());
}

/// A stiff fixed-fixed chain of masses: +-i w with w = 1e5 sqrt(2 - 2 cos(k pi / (n + 1))). Without balancing
/// the squares of the frequencies lend their roundoff.
#[test]
fn finds_frequencies_beside_their_squares() {
    let n = 12;
    let entry = |i: usize, j: usize| match (i < n, j < n) {
        (true, _) => f64::from(j == i + n),
        (false, true) => [-2e10, 1e10]
            .get((i - n).abs_diff(j))
            .copied()
            .unwrap_or(0.0),
        (false, false) => 0.0,
    };
    let found = eigenvalues(2 * n, entry).expect("a finite matrix");
    let frequency = |k: usize| {
        let angle = k as f64 * std::f64::consts::PI / (n + 1) as f64;
        1e5 * (2.0 - 2.0 * angle.cos()).sqrt()
    };
    let both = |k: usize| [(0.0, frequency(k)), (0.0, -frequency(k))];
    let expected: Vec<_> = (1..=n).flat_map(both).collect();
    assert!(distance(&found, &expected) < 1e-13 * frequency(n) * n as f64);
}

#[test]
fn finds_the_eigenvalues_of_a_turning_pair() {
    // Two oscillators coupled by a gyroscopic force: x'' = -x + g y', y'' = -4 y - g x'.
    let g = 0.7;
    let rows = [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-1.0, 0.0, 0.0, g],
        [0.0, -4.0, -g, 0.0],
    ];
    let values = eigenvalues(4, |i, j| rows[i][j]).expect("a finite matrix");
    for (re, im) in values {
        // w^4 - (5 + g^2) w^2 + 4 = 0
        let square = im * im;
        let left = square * square - (5.0 + g * g) * square + 4.0;
        assert!(re.abs() < 1e-13 && left.abs() < 1e-12);
    }
}
