//! Points of patches against differences.

use nalgebra::{Rotation3, Vector3};

use super::{Patch, PatchPoint};
use crate::bodies::Bodies;
use crate::bodies::assembly::NodeBlock;
use crate::bodies::body::{BodyPart, NodalMotion};
use crate::bodies::connectivity::{Node, add_node, no_node};
use crate::bodies::frame::axes_at;
use crate::elements::rod::tests::Noise;
use crate::elements::shell::{Corner, ShellSection};

type Nodes = Vec<Node<3>>;

/// Nodes that look random; those of points are zero.
fn field(patch: &Patch, size: f64, seed: &mut Noise) -> Nodes {
    let mut nodes = vec![no_node(); patch.all().end];
    for node in patch.mesh() {
        nodes[node] = nodes[node].map(|v| v.map(|_| size * seed.next()));
    }
    nodes
}

/// Two by three elements of a cylinder after two other nodes, with a bare point and one with a pad over several elements.
fn patch() -> Patch {
    let (radius, angle, width) = (0.4, 1.2, 0.5);
    let lines = [
        [0.0, 0.3, radius * angle].to_vec(),
        [0.0, 0.1, 0.3, width].to_vec(),
    ];
    let corner = |s: f64, y: f64| -> Corner {
        let (sin, cos) = (s / radius).sin_cos();
        [
            [radius * sin, y, radius * cos],
            [cos, 0.0, -sin],
            [0.0, 1.0, 0.0],
            [0.0; 3],
        ]
    };
    let nodes: Vec<Corner> = (lines[0].iter())
        .flat_map(|s| lines[1].iter().map(move |y| corner(*s, *y)))
        .collect();
    let section = ShellSection {
        damping_time: 0.01,
        ..ShellSection::isotropic(2e5, 0.3, 1200.0, 0.01)
    };
    let points = [
        PatchPoint {
            at: [0.3, 0.7],
            pad: [0.0; 2],
        },
        PatchPoint {
            at: [0.6, 0.4],
            pad: [0.2, 0.3],
        },
    ];
    Patch::new(2, lines, &nodes, |_| section, &points)
}

/// A configuration that is not the reference, with its points.
fn configuration(patch: &Patch, seed: &mut Noise) -> Nodes {
    let mut x: Nodes = vec![no_node(); 2];
    x.extend(patch.reference::<3>());
    let disturbed = field(patch, 0.05, seed);
    x.iter_mut()
        .zip(&disturbed)
        .for_each(|(x, by)| add_node(x, 1.0, by));
    patch.place_points(&mut x);
    x
}

fn moved(patch: &Patch, x: &[Node<3>], v: &[Node<3>], h: f64) -> Nodes {
    let mut out = x.to_vec();
    out.iter_mut().zip(v).for_each(|(x, v)| add_node(x, h, v));
    patch.place_points(&mut out);
    out
}

fn difference(a: &[Node<3>], b: &[Node<3>]) -> f64 {
    let pairs = a
        .as_flattened()
        .as_flattened()
        .iter()
        .zip(b.as_flattened().as_flattened());
    pairs.fold(0.0, |sum: f64, (a, b)| sum.max((a - b).abs()))
}

fn product(a: &[Node<3>], b: &[Node<3>]) -> f64 {
    let pairs = a
        .as_flattened()
        .as_flattened()
        .iter()
        .zip(b.as_flattened().as_flattened());
    pairs.map(|(a, b)| a * b).sum()
}

#[test]
fn points_lie_on_the_surface_and_rotate_with_it() {
    let patch = patch();
    let mut x: Nodes = vec![no_node(); 2];
    x.extend(patch.reference::<3>());
    let node = patch.point_node(0);
    let (sin, cos) = (0.3 * 1.2_f64).sin_cos();
    let place = Vector3::from(x[node][0]) - Vector3::new(0.4 * sin, 0.35, 0.4 * cos);
    // Cubic interpolation over an angle of 0.75 rad: R a^4 / 384.
    assert!(place.norm() < 0.4 * 0.75_f64.powi(4) / 384.0, "{place}");
    let rotation = Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let before = axes_at(node, &x);
    for node in patch.mesh() {
        x[node] = x[node].map(|v| (rotation * Vector3::from(v)).into());
    }
    patch.place_points(&mut x);
    for (axis, before) in axes_at(node, &x).iter().zip(&before) {
        assert!((axis - rotation * before).norm() < 1e-14);
    }
}

#[test]
fn rates_and_accelerations_of_points_are_derivatives() {
    let (patch, mut seed) = (patch(), Noise(3));
    let x = configuration(&patch, &mut seed);
    let [mut v, mut a] = [0, 1].map(|_| field(&patch, 1.0, &mut seed));
    patch.place_point_rates(&x, &mut v);
    let h = 1e-4;
    let [before, after] = [-h, h].map(|h| moved(&patch, &x, &v, h));
    let rate = |k: usize| {
        let points = patch.followers();
        let of = |node: usize| -> Node<3> {
            std::array::from_fn(|p| {
                std::array::from_fn(|d| match k {
                    1 => (after[node][p][d] - before[node][p][d]) / (2.0 * h),
                    _ => (after[node][p][d] - 2.0 * x[node][p][d] + before[node][p][d]) / (h * h),
                })
            })
        };
        points.map(of).collect::<Nodes>()
    };
    let points = patch.followers();
    assert!(difference(&v[points.clone()], &rate(1)) < 1e-6);
    // Along a straight way of the mesh nodes accelerations of points are what rates alone ask for.
    a.fill(no_node());
    patch.add_point_bias((&x, &v), &mut a);
    assert!(difference(&a[points], &rate(2)) < 1e-5);
}

#[test]
fn forces_on_points_do_the_same_work_on_the_mesh() {
    let (patch, mut seed) = (patch(), Noise(11));
    let x = configuration(&patch, &mut seed);
    let mut v = field(&patch, 1.0, &mut seed);
    patch.place_point_rates(&x, &mut v);
    let mut f = vec![no_node(); x.len()];
    for node in patch.followers() {
        f[node] = f[node].map(|v| v.map(|_| seed.next()));
    }
    let power = product(&f, &v);
    // The same through derivatives.
    let mut by_partials = 0.0;
    for (k, node) in patch.followers().enumerate() {
        patch.for_each_partial((k / 2, k % 2 == 1), &x, |owner, partial: &NodeBlock<3>| {
            for (r, row) in partial.as_flattened().iter().enumerate() {
                for (c, entry) in row.as_flattened().iter().enumerate() {
                    by_partials += f[node].as_flattened()[r] * entry * v[owner].as_flattened()[c];
                }
            }
        });
    }
    patch.pull_points(&x, &mut f);
    assert!((product(&f, &v) - power).abs() < 1e-13 * power.abs());
    assert!((by_partials - power).abs() < 1e-13 * power.abs());
    assert!(patch.followers().all(|node| f[node] == no_node()));
}

#[test]
fn stiffness_of_forces_on_axes_is_the_symmetric_derivative() {
    let (patch, mut seed) = (patch(), Noise(23));
    let x = configuration(&patch, &mut seed);
    let mut on_points = vec![no_node(); x.len()];
    for node in patch.followers() {
        on_points[node] = on_points[node].map(|v| v.map(|_| seed.next()));
    }
    let [u, v] = [0, 1].map(|_| field(&patch, 1.0, &mut seed));
    let mut by_blocks = 0.0;
    patch.geometric_blocks(&on_points, &x, &mut |a, b, block: &NodeBlock<3>| {
        for (r, row) in block.as_flattened().iter().enumerate() {
            for (c, entry) in row.as_flattened().iter().enumerate() {
                let of = |p: &Nodes, node: usize, k: usize| p[node].as_flattened()[k];
                by_blocks += entry * of(&u, a, r) * of(&v, b, c);
                if a != b {
                    by_blocks += entry * of(&v, a, r) * of(&u, b, c);
                }
            }
        }
    });
    let along = |way: &Nodes, other: &Nodes| {
        let h = 1e-5;
        let [before, after] = [-h, h].map(|h| {
            let x = moved(&patch, &x, way, h);
            let mut f = on_points.clone();
            patch.pull_points(&x, &mut f);
            product(&f, other)
        });
        (before - after) / (2.0 * h)
    };
    let expected = 0.5 * (along(&u, &v) + along(&v, &u));
    assert!(
        (by_blocks - expected).abs() < 1e-7 * expected.abs(),
        "{by_blocks} {expected}"
    );
}

#[test]
fn forces_of_a_patch_in_lanes_are_those_of_its_elements() {
    let (patch, mut seed) = (patch(), Noise(31));
    let (x, v) = (
        configuration(&patch, &mut seed),
        field(&patch, 1.0, &mut seed),
    );
    let motion = NodalMotion {
        drives: &[],
        x: &x,
        v: &v,
        from: None,
    };
    let [mut lanes, mut single] = [0, 1].map(|_| vec![no_node(); x.len()]);
    let power = BodyPart::add_force(&patch, motion, (&mut lanes, &mut []));
    BodyPart::add_force_of(&patch, motion, (&mut single, &mut []));
    let largest = difference(&single, &vec![no_node(); x.len()]);
    assert!(difference(&lanes, &single) < 1e-13 * largest);
    let dissipated = BodyPart::dissipation(&patch, motion);
    assert!((power - dissipated).abs() < 1e-12 * power && power > 0.0);
    let mut bodies = Bodies::<3>::new(patch.reference(), std::iter::once(patch.all()).collect());
    let mass = 1200.0 * 0.01 * 0.48 * 0.5;
    bodies.add_patch(patch);
    assert!((bodies.mass() - mass).abs() < 1e-3 * mass);
}
