//! Numbers of sections against closed forms and published figures.
//!
//! Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), chapter 10; W. C. Young, R. G. Budynas, Roark's Formulas for Stress
//! and Strain, 7th ed. (2002), table 10.7; G. R. Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340.

use std::f64::consts::PI;

use super::*;

fn solved(loops: &[&[Point]]) -> (Outline, Torsion) {
    let loops: Vec<Vec<Point>> = loops.iter().map(|of| of.to_vec()).collect();
    assert_eq!(flaw(&loops), None);
    let outline = Outline::new(loops);
    let torsion = Torsion::new(&outline, TORSION_ERROR).expect("a section");
    assert!(
        torsion.numbers.error <= TORSION_ERROR,
        "{}",
        torsion.numbers.error
    );
    (outline, torsion)
}

fn rectangle(width: f64, height: f64) -> [Point; 4] {
    let [y, z] = [0.5 * width, 0.5 * height];
    [[-y, -z], [y, -z], [y, z], [-y, z]]
}

/// Web and flanges of a letter I with middle at the origin.
fn letter([width, height, web, flange]: [f64; 4]) -> Vec<Point> {
    let [y, z, s] = [0.5 * width, 0.5 * height, 0.5 * web];
    let f = z - flange;
    let right = [[y, -z], [y, -f], [s, -f], [s, f], [y, f], [y, z]];
    right
        .into_iter()
        .chain(right.map(|[y, z]| [-y, -z]))
        .collect()
}

fn channel([width, height, web, flange]: [f64; 4]) -> Vec<Point> {
    let lower = [[0.0, 0.0], [width, 0.0], [width, flange], [web, flange]];
    let upper = lower.map(|[y, z]| [y, height - z]);
    lower.into_iter().chain(upper.into_iter().rev()).collect()
}

fn ellipse(width: f64, height: f64, part: f64) -> Vec<Point> {
    let corner = |k: u32| {
        let (sin, cos) = (2.0 * PI * f64::from(k) / 96.0).sin_cos();
        [0.5 * part * width * cos, 0.5 * part * height * sin]
    };
    (0..96).map(corner).collect()
}

/// Shear factors along both axes.
fn factors(outline: &Outline, numbers: &ShearNumbers, poisson: f64) -> [f64; 2] {
    let [first, second] = numbers.compliance;
    let compliance = first + second * poisson;
    [0, 1].map(|k| 2.0 * (1.0 + poisson) / (compliance[(k, k)] * outline.area))
}

fn close(found: f64, wanted: f64, error: f64) {
    assert!((found / wanted - 1.0).abs() < error, "{found} {wanted}");
}

/// Series of Timoshenko and Goodier, section 109, and an exact polynomial (section 106).
#[test]
fn torsion_of_rectangles_and_a_triangle_is_that_of_closed_forms() {
    for (width, height) in [(1.0, 1.0), (0.5, 2.0), (0.01, 0.2)] {
        let term =
            |k: i32| (0.5 * f64::from(k) * PI * height / width).tanh() / f64::from(k).powi(5);
        let sum: f64 = (0..100).map(|k| term(2 * k + 1)).sum();
        let part = 1.0 / 3.0 - 64.0 / PI.powi(5) * width / height * sum;
        let found = solved(&[&rectangle(width, height)]).1.numbers;
        close(found.torsion_constant, height * width.powi(3) * part, 3e-5);
    }
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]];
    let found = solved(&[&triangle]).1.numbers;
    close(found.torsion_constant, 3.0_f64.sqrt() / 80.0, 1e-12);
}

/// Cowper's factors of rectangles, of ellipses and of a tube, with polygons in place of what is round; the torsion constant of a hollow
/// ellipse is `pi a^3 b^3 (1 - k^4) / (a^2 + b^2)`.
#[test]
fn shear_factors_are_those_of_cowper() {
    for poisson in [0.0_f64, 0.3, 0.5] {
        let once = 1.0 + poisson;
        let (outline, of) = solved(&[&rectangle(0.3, 0.1)]);
        for found in factors(&outline, &of.numbers, poisson) {
            close(found, 10.0 * once / (12.0 + 11.0 * poisson), 1e-9);
        }
        let (outline, of) = solved(&[&ellipse(0.3, 0.1, 1.0)]);
        for (found, n) in factors(&outline, &of.numbers, poisson)
            .into_iter()
            .zip([9.0, 1.0 / 9.0])
        {
            let under = (40.0 + 37.0 * poisson) * n * n + (16.0 + 10.0 * poisson) * n + poisson;
            close(found, 12.0 * once * n * (3.0 * n + 1.0) / under, 1e-3);
        }
        let (outline, of) = solved(&[&ellipse(0.2, 0.2, 1.0), &ellipse(0.2, 0.2, 0.7)]);
        let (hole, square) = (0.49_f64, 1.49_f64.powi(2));
        let under = (7.0 + 6.0 * poisson) * square + (20.0 + 12.0 * poisson) * hole;
        for found in factors(&outline, &of.numbers, poisson) {
            close(found, 6.0 * once * square / under, 1e-3);
        }
    }
    let (_, of) = solved(&[&ellipse(0.4, 0.2, 1.0), &ellipse(0.4, 0.2, 0.5)]);
    let wanted = PI * (0.2_f64 * 0.1).powi(3) * (1.0 - 0.5_f64.powi(4)) / (0.04 + 0.01);
    close(of.numbers.torsion_constant, wanted, 4e-3);
}

/// Roark's Formulas for Stress and Strain, 7th ed., table 10.7 (letter I without fillets, sizes of IPE 300; angle); Bredt's formula and Cowper's of
/// thin walls for a box and a letter I.
#[test]
fn profiles_are_as_tables_have_them() {
    let sizes = [0.15, 0.3, 0.0071, 0.0107];
    let (outline, of) = solved(&[&letter(sizes)]);
    let [a, _, d, b] = sizes;
    let flange = a * b.powi(3) * (1.0 / 3.0 - 0.21 * b / a);
    let circle = (b * b + 0.25 * d * d) / b;
    let web = 0.2786 * d.powi(3) / 3.0;
    let roark = 2.0 * flange + web + 2.0 * 0.15 * d / b * circle.powi(4);
    close(of.numbers.torsion_constant, roark, 0.01);
    close(
        outline.second_moments[0],
        (a * 0.027 - (a - d) * 0.2786_f64.powi(3)) / 12.0,
        1e-12,
    );
    let (a, b, c, d): (f64, f64, f64, f64) = (0.15, 0.01, 0.09, 0.01);
    let angle = [
        [0.0, 0.0],
        [0.1, 0.0],
        [0.1, 0.01],
        [0.01, 0.01],
        [0.01, 0.15],
        [0.0, 0.15],
    ];
    let first = a * b.powi(3) * (1.0 / 3.0 - 0.21 * b / a);
    let second = c * d.powi(3) * (1.0 / 3.0 - 0.105 * d / c);
    let circle = 2.0 * (b + d - (2.0 * b * d).sqrt());
    let (_, of) = solved(&[&angle]);
    close(
        of.numbers.torsion_constant,
        first + second + 0.07 * circle.powi(4),
        0.02,
    );
    let [t, f] = [5e-4, 1e-3];
    let (outline, of) = solved(&[&rectangle(0.2 + t, 0.3 + f), &rectangle(0.2 - t, 0.3 - f)]);
    let bredt = 4.0 * 0.06_f64.powi(2) / (2.0 * 0.3 / t + 2.0 * 0.2 / f);
    close(of.numbers.torsion_constant, bredt, 3e-3);
    let (m, n): (f64, f64) = (0.2 * f / (0.3 * t), 0.2 / 0.3);
    let (square, cube) = (m * m, m.powi(3));
    for poisson in [0.0, 0.3] {
        let over = 10.0 * (1.0 + poisson) * (1.0 + 3.0 * m).powi(2);
        let under = 12.0
            + 72.0 * m
            + 150.0 * square
            + 90.0 * cube
            + poisson * (11.0 + 66.0 * m + 135.0 * square + 90.0 * cube)
            + 10.0 * n * n * ((3.0 + poisson) * m + 3.0 * square);
        close(
            factors(&outline, &of.numbers, poisson)[1],
            over / under,
            3e-3,
        );
    }
}

/// The shear centre of a thin channel is `b^2 h^2 t / (4 I)` beyond the middle of its web, that of a letter L at the crossing of its legs, and
/// that of what is symmetric its centroid.
#[test]
fn shear_centers_are_those_of_thin_walls() {
    let (b, h, t) = (0.1, 0.2, 1e-3);
    let (outline, of) = solved(&[&channel([b + 0.5 * t, h + t, t, t])]);
    let wanted = b * b * h * h * t / (4.0 * outline.second_moments[0]);
    let [y, z] = of.numbers.shear_center;
    close(0.5 * t - (y + outline.centroid[0]), wanted, 3e-3);
    assert!(z.abs() < 1e-6 * h);
    let angle = [[0.0, 0.0], [b, 0.0], [b, t], [t, t], [t, h], [0.0, h]];
    let (outline, of) = solved(&[&angle]);
    for k in 0..2 {
        let at = of.numbers.shear_center[k] + outline.centroid[k];
        assert!((at - 0.5 * t).abs() < 0.5 * t, "{at}");
    }
    let (_, of) = solved(&[&letter([0.1, 0.2, 0.01, 0.01])]);
    assert!(of.numbers.shear_center.iter().all(|at| at.abs() < 1e-6));
}

/// The mean of bounds on a coarse mesh is off the fine one by no more than half of their difference.
#[test]
fn bounds_hold_on_coarse_meshes() {
    let outline = Outline::new(vec![
        rectangle(1.0, 1.0).to_vec(),
        vec![[-0.3, -0.1], [0.2, -0.3], [0.3, 0.3]],
    ]);
    let fine = Torsion::new(&outline, TORSION_ERROR)
        .expect("a section")
        .numbers;
    let mesh = Mesh::new(&outline.loops).expect("a mesh");
    let coarse = solve(&outline, &mesh, &Reference::new())
        .expect("a solution")
        .numbers;
    let off = (coarse.torsion_constant / fine.torsion_constant - 1.0).abs();
    assert!(coarse.error > 20.0 * fine.error, "{coarse:?}");
    assert!(off < coarse.error + fine.error, "{off} {}", coarse.error);
}

/// The stress makes the torque: its moment about any point, integrated over the section. In the middle of the edges of a square it is
/// `T / (0.208 a^3)`.
#[test]
fn stress_of_torsion_makes_the_torque() {
    let fine = |loops: &[&[Point]]| {
        let loops = loops.iter().map(|of| of.to_vec()).collect();
        Torsion::new(&Outline::new(loops), STRESS_ERROR).expect("a section")
    };
    let of = fine(&[&rectangle(1.0, 1.0)]);
    let [first, second] = of.stress([0.5, 0.0]).expect("a point of it");
    close(second, 1.0 / 0.208_176_5, 1e-3);
    assert!(first.abs() < 1e-2);
    assert_eq!(of.stress([0.51, 0.0]), None);
    let of = fine(&[&rectangle(0.3, 0.2), &rectangle(0.2, 0.1)]);
    let (rows, mut torque) = (120, 0.0);
    for (j, k) in (0..rows).flat_map(|j| (0..rows).map(move |k| (j, k))) {
        let at = |k: i32, size: f64| size * ((f64::from(k) + 0.5) / f64::from(rows) - 0.5);
        let [y, z] = [at(j, 0.3), at(k, 0.2)];
        if let Some([first, second]) = of.stress([y, z]) {
            torque += (y * second - z * first) * 0.06 / f64::from(rows * rows);
        }
    }
    close(torque, 1.0, 2e-3);
}

#[test]
fn flaws_of_outlines_are_found() {
    let square = rectangle(1.0, 1.0).to_vec();
    let far = rectangle(0.1, 0.1).map(|[y, z]| [y + 2.0, z]).to_vec();
    let bow = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let spike = vec![[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.5, 1.0]];
    for (loops, wanted) in [
        (vec![square.clone()], None),
        (vec![vec![[0.0; 2], [1.0; 2]]], Some(OutlineFlaw::Few(0))),
        (
            vec![vec![[0.0; 2], [0.0; 2], [1.0, 0.0]]],
            Some(OutlineFlaw::Repeated(0, 0)),
        ),
        (vec![bow], Some(OutlineFlaw::Meeting([(0, 0), (0, 2)]))),
        (vec![spike], Some(OutlineFlaw::Meeting([(0, 0), (0, 1)]))),
        (vec![square.clone(), far], Some(OutlineFlaw::Apart(1))),
        (
            vec![square.clone(), rectangle(0.2, 2.0).to_vec()],
            Some(OutlineFlaw::Meeting([(0, 0), (1, 1)])),
        ),
        (
            vec![
                square,
                rectangle(0.5, 0.5).to_vec(),
                rectangle(0.2, 0.2).to_vec(),
            ],
            Some(OutlineFlaw::Apart(2)),
        ),
    ] {
        assert_eq!(flaw(&loops), wanted, "{loops:?}");
    }
}

/// A ring of half its size touches the triangle of every third of its corners: no ear reaches into the hole.
#[test]
fn rings_of_all_sizes_have_triangles() {
    for k in 0..40 {
        let size = 0.04 + 4e-4 * f64::from(k);
        let loops = [0.5, 0.8].map(|part| {
            vec![
                ellipse(size, 0.75 * size, 1.0),
                ellipse(size, 0.75 * size, part),
            ]
        });
        for loops in loops {
            let outline = Outline::new(loops);
            let mesh = Mesh::new(&outline.loops).expect("a mesh");
            let area = |t: usize| Map::new(&mesh, t).size;
            let sum: f64 = (0..mesh.triangles.len()).map(area).sum();
            close(0.5 * sum, outline.area, 1e-12);
        }
    }
}
