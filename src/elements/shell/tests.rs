//! Laws of one element. Elements in a mesh are tested from outside.
//!
//! Source: docs/decisions/0076-plates-and-shells.md; S. P. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells (1959), Eqs. 37-44.

use nalgebra::{Matrix3, Rotation3, SMatrix, Vector3};

use super::*;
use crate::elements::rod::tests::Noise;
use crate::math::jet::Jet;
use crate::math::lanes::{Vectorized, vectorized};

fn laminate() -> ShellSection {
    let ply = |angle: f64, thickness: f64| Ply {
        youngs_moduli: [140.0, 10.0],
        poisson_ratio: 0.3,
        shear_modulus: 5.0,
        density: 1.6,
        thickness,
        angle,
    };
    ShellSection {
        angle: 0.3,
        damping_time: 0.02,
        ..ShellSection::laminate(&[ply(0.2, 0.1), ply(-0.7, 0.15)])
    }
}

/// A curved surface of 0.8 x 0.5 m, disturbed by `by`.
fn corners(by: f64, seed: &mut Noise) -> ElementCorners {
    std::array::from_fn(|corner| {
        let (x, y) = (0.8 * (corner / 2) as f64, 0.5 * (corner % 2) as f64);
        let flat = [
            [x, y, 0.3 * x * y + 0.2 * x * x],
            [1.0, 0.0, 0.3 * y + 0.4 * x],
            [0.1, 1.0, 0.3 * x],
            [0.0, 0.0, 0.3],
        ];
        flat.map(|v| v.map(|component| component + by * seed.next()))
    })
}

fn element(section: &ShellSection) -> Shell {
    Shell::new(
        |_| *section,
        ([0.8, 0.5], 0.3),
        &corners(0.03, &mut Noise(5)),
    )
}

fn changed(e: &ElementCorners, by: &ElementCorners, factor: f64) -> ElementCorners {
    std::array::from_fn(|c| {
        std::array::from_fn(|k| std::array::from_fn(|d| e[c][k][d] + factor * by[c][k][d]))
    })
}

fn product(a: &ElementCorners, b: &ElementCorners) -> f64 {
    let (a, b) = (
        a.as_flattened().as_flattened(),
        b.as_flattened().as_flattened(),
    );
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn forces_are_slopes_of_the_energy() {
    let (element, mut seed) = (element(&laminate()), Noise(17));
    let at = corners(0.1, &mut seed);
    let (force, _) = element.force(&at, &[[[0.0; 3]; 4]; 4]);
    let mut largest = 0.0_f64;
    for _ in 0..8 {
        let way = changed(&[[[0.0; 3]; 4]; 4], &corners(1.0, &mut seed), 1.0);
        let jets = std::array::from_fn(|c| {
            std::array::from_fn(|k| {
                std::array::from_fn(|d| Jet::new(at[c][k][d], way[c][k][d], 0.0))
            })
        });
        let slope = element.energy(&jets).v1;
        largest = largest.max((slope + product(&force, &way)).abs() / slope.abs());
    }
    assert!(largest < 1e-12, "{largest:e}");
}

#[test]
fn rigid_motion_stores_no_energy() {
    let (element, at) = (element(&laminate()), corners(0.03, &mut Noise(5)));
    let rotation = Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let moved = at.map(|corner| {
        let mut vectors = corner.map(|v| <[f64; 3]>::from(rotation * Vector3::from(v)));
        vectors[0] = std::array::from_fn(|d| vectors[0][d] + 0.7);
        vectors
    });
    let strained = element.energy(&corners(0.1, &mut Noise(9)));
    assert!(
        element.energy(&moved).abs() < 1e-26 * strained,
        "{:e}",
        element.energy(&moved)
    );
}

/// Force, power, stiffness and damping of one element by lanes.
struct InLanes<'a> {
    pack: &'a ShellPack,
    at: &'a [ElementCorners],
    rates: &'a [ElementCorners],
    from: Option<&'a [ElementCorners]>,
    force: &'a mut CornerPack,
    power: &'a mut f64,
    /// Stiffness and damping of one element, by corner.
    matrices: &'a mut [[[CornerBlocks; 4]; 4]; 2],
    lane: usize,
}

fn side_by_side(elements: &[ElementCorners]) -> CornerPack {
    std::array::from_fn(|c| {
        std::array::from_fn(|k| {
            std::array::from_fn(|d| {
                std::array::from_fn(|lane| elements[lane.min(elements.len() - 1)][c][k][d])
            })
        })
    })
}

impl Vectorized for InLanes<'_> {
    fn run<S: Simd>(self, simd: S) {
        let (at, rates) = (side_by_side(self.at), side_by_side(self.rates));
        let from = self.from.map(side_by_side);
        *self.power = self.pack.force(simd, (&at, Some(&rates)), self.force);
        let mut blocks = [[[[[0.0; PACK]; 3]; 3]; 4]; 4];
        let (lane, matrices) = (self.lane, self.matrices);
        self.pack.tangent(
            simd,
            &at,
            (Some(&rates), from.as_ref()),
            &mut blocks,
            |(a, b), group, is_damping, blocks| {
                if lane / S::F64_LANES != group {
                    return;
                }
                for (k, l) in (0..4).flat_map(|k| (0..4).map(move |l| (k, l))) {
                    for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
                        let entry = blocks[k][l][r][c][lane];
                        if a == b && k < l {
                            continue;
                        }
                        let matrix = &mut matrices[usize::from(is_damping)];
                        matrix[a][b][k][l][r][c] = entry;
                        matrix[b][a][l][k][c][r] = entry;
                    }
                }
            },
        );
    }
}

type Matrices = [SMatrix<f64, 48, 48>; 2];

/// Force and power of three elements, stiffness and damping of one of them.
fn in_lanes(
    element: &Shell,
    motion: (&[ElementCorners], &[ElementCorners]),
    from: Option<&[ElementCorners]>,
    lane: usize,
) -> (CornerPack, f64, Matrices) {
    let pack = Shell::pack(&[element.clone(), element.clone(), element.clone()]);
    let mut force = [[[[0.0; PACK]; 3]; 4]; 4];
    let mut blocks = [[[[[[[0.0; 3]; 3]; 4]; 4]; 4]; 4]; 2];
    let mut power = 0.0;
    vectorized(InLanes {
        pack: &pack,
        at: motion.0,
        rates: motion.1,
        from,
        force: &mut force,
        power: &mut power,
        matrices: &mut blocks,
        lane,
    });
    let matrices = blocks.map(|of| {
        SMatrix::from_fn(|r, c| of[r / 12][c / 12][r % 12 / 3][c % 12 / 3][r % 3][c % 3])
    });
    (force, power, matrices)
}

#[test]
fn lanes_agree_with_numbers_and_tangents_with_differences() {
    let (element, mut seed) = (element(&laminate()), Noise(29));
    let at: Vec<_> = (0..3).map(|_| corners(0.1, &mut seed)).collect();
    let rates: Vec<_> = (0..3).map(|_| corners(1.0, &mut seed)).collect();
    let still = [[[0.0; 3]; 4]; 4];
    let numbers = |corners: &ElementCorners| {
        SMatrix::<f64, 48, 1>::from_column_slice(corners.as_flattened().as_flattened())
    };
    let (mut worst, mut power) = ([0.0_f64; 4], 0.0);
    for lane in 0..3 {
        let (force, of_lanes, [stiffness, damping]) = in_lanes(&element, (&at, &rates), None, lane);
        let (single, own) = element.force(&at[lane], &rates[lane]);
        power += own;
        for (c, k, d) in
            (0..4).flat_map(|c| (0..4).flat_map(move |k| (0..3).map(move |d| (c, k, d))))
        {
            let off = (force[c][k][d][lane] - single[c][k][d]).abs();
            worst[0] = worst[0].max(off / numbers(&single).amax());
        }
        if lane == 2 {
            assert!((of_lanes - power).abs() < 1e-12 * power);
        }
        // Along a way, at rest for stiffness: with damping only its symmetric part is taken.
        let (_, _, [elastic, _]) = in_lanes(&element, (&at, &[still, still, still]), None, lane);
        let way = corners(1.0, &mut seed);
        let h = 1e-5;
        let differences = |e: &dyn Fn(f64) -> ElementCorners, v: &dyn Fn(f64) -> ElementCorners| {
            let [a, b] = [h, -h].map(|h| numbers(&element.force(&e(h), &v(h)).0));
            (b - a) / (2.0 * h)
        };
        let by_place = differences(&|h| changed(&at[lane], &way, h), &|_| still);
        let by_rate = differences(&|_| at[lane], &|h| changed(&rates[lane], &way, h));
        let of = |matrix: &SMatrix<f64, 48, 48>| matrix * numbers(&way);
        worst[1] = worst[1].max((of(&elastic) - by_place).amax() / by_place.amax());
        worst[2] = worst[2].max((of(&damping) - by_rate).amax() / by_rate.amax());
        worst[3] = worst[3].max((stiffness - stiffness.transpose()).amax());
    }
    assert!(
        worst[0] < 1e-13 && worst[1] < 1e-8 && worst[2] < 1e-8,
        "{worst:?}"
    );
}

#[test]
fn predicted_stress_is_that_of_a_linear_step() {
    let (element, mut seed) = (element(&laminate()), Noise(41));
    let from = corners(0.05, &mut seed);
    let way = corners(1.0, &mut seed);
    let still = [[[0.0; 3]; 4]; 4];
    // For a small step both stresses agree to second order, and so do tangents.
    let off = |h: f64| {
        let to = changed(&from, &way, h);
        let still = [still; 3];
        let (_, _, [own, _]) = in_lanes(&element, (&[to; 3], &still), None, 0);
        let (_, _, [predicted, _]) = in_lanes(&element, (&[to; 3], &still), Some(&[from; 3]), 0);
        (own - predicted).amax()
    };
    let ratio = off(1e-3) / off(5e-4);
    assert!((ratio - 4.0).abs() < 0.05, "{ratio}");
}

#[test]
fn mass_keeps_momentum_and_rigid_kinetic_energy() {
    let section = laminate();
    let flat: ElementCorners = std::array::from_fn(|corner| {
        let (x, y) = (0.8 * (corner / 2) as f64, 0.5 * (corner % 2) as f64);
        [[x, y, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]
    });
    let element = Shell::new(|_| section, ([0.8, 0.5], 0.3), &flat);
    let mass = section.area_density * 0.4;
    let weight = element.weight();
    let total: f64 = (0..4).map(|corner| weight[VECTORS * corner]).sum();
    assert!((total - mass).abs() < 1e-14);
    let spin = Matrix3::new(0.0, -2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let rates = SMatrix::<f64, 3, 16>::from_fn(|d, k| {
        (spin * Vector3::from(flat[k / VECTORS][k % VECTORS]))[d]
    });
    let energy = 0.5 * (rates * element.mass()).dot(&rates);
    let expected = 0.5 * 4.0 * mass * (0.8 * 0.8 + 0.5 * 0.5) / 3.0;
    assert!((energy - expected).abs() < 1e-14, "{energy} for {expected}");
}

/// A strip that tension bends: Timoshenko's bimetal by plane stress of one direction.
#[test]
fn sections_follow_closed_forms() {
    let (e, nu, h) = (70e9, 0.33, 2e-3);
    let section = ShellSection::isotropic(e, nu, 2700.0, h);
    let stiffness = e * h / (1.0 - nu * nu);
    let expected = [
        [stiffness, nu * stiffness, 0.0],
        [nu * stiffness, stiffness, 0.0],
        [0.0, 0.0, 0.5 * (1.0 - nu) * stiffness],
    ];
    for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
        assert!((section.membrane[r][c] - expected[r][c]).abs() < 1e-12 * stiffness);
        let bending = expected[r][c] * h * h / 12.0;
        assert!((section.bending[r][c] - bending).abs() < 1e-12 * stiffness * h * h);
    }
    assert_eq!(section.coupling, [[0.0; 3]; 3]);
    assert!((section.area_density - 5.4).abs() < 1e-14);
    assert!(section.is_positive());
    assert!(!ShellSection::isotropic(e, 1.01, 2700.0, h).is_positive());
}
