//! A chain that is longer than its reference length is one of that length, whose slopes are by it.

use flexbody::bodies::{Assembly, Chain, Links, Node, map_node, no_node};
use flexbody::elements::cable::{Cable, Inertia, LineOf, Parameters};
use flexbody::elements::{Element, StrainMeasure};
use flexbody::math::sparse::Matrix;

/// Reference length over the length now, and the rate by which that grows, 1/s.
const LONGER: [f64; 2] = [0.7, 0.4];
const COUNT: usize = 11;

fn chain<const D: usize>(length: f64) -> Chain<Cable<D>, D> {
    let parameters = Parameters {
        length,
        axial_stiffness: 50.0,
        bending_stiffness: 3.0,
        line_of: LineOf::Cable,
        line_density: 1.3,
        axial_damping_time: 0.02,
        bending_damping_time: 0.05,
        strain: StrainMeasure::ThetaPrime,
        inertia: Inertia::Corrected,
    };
    Chain::new(vec![Cable::new(parameters, None); COUNT], 0)
}

/// A chain that is bent and stretched everywhere, or other nodal vectors.
fn wavy<const D: usize>(phase: f64) -> Vec<Node<D>> {
    let at = |node: usize| {
        let s = 0.3 * node as f64 + phase;
        let vector = |v: [f64; 3]| -> [f64; D] { std::array::from_fn(|d| v[d]) };
        [
            vector([
                s + 0.1 * s.sin(),
                0.4 * (1.3 * s).cos(),
                0.2 * (2.0 * s).sin(),
            ]),
            vector([
                1.4 + 0.1 * s.cos(),
                -0.5 * (1.3 * s).sin(),
                0.4 * (2.0 * s).cos(),
            ]),
        ]
    };
    (0..=COUNT).map(at).collect()
}

/// Slopes, or rates of slopes or forces on them, by another length.
fn by_length<const D: usize>(of: &[Node<D>]) -> Vec<Node<D>> {
    let slope = |[place, slope]: &Node<D>| [*place, slope.map(|x| LONGER[0] * x)];
    of.iter().map(slope).collect()
}

fn largest<const D: usize>(a: &[Node<D>], b: &[Node<D>]) -> f64 {
    let pairs = a.as_flattened().as_flattened().iter();
    let pairs = pairs.zip(b.as_flattened().as_flattened());
    pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

/// The product of a matrix over the nodes of a chain.
fn product<const D: usize>(
    assembly: &Assembly<D>,
    matrix: &Matrix<f64>,
    of: &[Node<D>],
) -> Vec<Node<D>> {
    let pattern = assembly.pattern();
    let (mut y, mut out) = (vec![0.0; assembly.free()], vec![no_node(); of.len()]);
    let [mut padded, mut sum] = [vec![0.0; pattern.len()], vec![0.0; pattern.len()]];
    assembly.restrict(of, &mut y);
    assembly.put(&y, &mut padded);
    matrix.multiply(pattern, &padded, &mut sum);
    assembly.take(&sum, &mut y);
    assembly.prolong(&y, &mut out);
    out
}

fn is_one_of_that_length<const D: usize>() {
    let [by, growth] = LONGER;
    let (own, other) = (chain::<D>(0.3), chain::<D>(0.3 / by));
    let (x, v) = (wavy::<D>(0.2), wavy::<D>(1.7));
    let still = v.iter().zip(&x).map(|(v, x)| {
        let mut rate = *v;
        let numbers = rate.as_flattened_mut().iter_mut();
        (numbers.zip(x.as_flattened())).for_each(|(v, x)| *v -= growth * x);
        rate
    });
    let (there, moving) = (by_length(&x), by_length(&still.collect::<Vec<_>>()));
    let mut forces = [(); 3].map(|()| vec![no_node(); COUNT + 1]);
    let [lanes, single, wanted] = &mut forces;
    let powers = [
        own.add_force((&x, &v), LONGER, lanes),
        own.dissipation((&x, &v), LONGER),
        other.add_force((&there, &moving), [1.0, 0.0], wanted),
    ];
    own.add_force_of((&x, &v), LONGER, single);
    let wanted = by_length(wanted);
    assert!(
        largest(lanes, &wanted) < 1e-11,
        "{:e}",
        largest(lanes, &wanted)
    );
    assert!(largest(single, &wanted) < 1e-11);
    assert!(powers[2] > 0.1 && (powers[0] - powers[2]).abs() < 1e-11 * powers[2]);
    assert!((powers[1] - powers[2]).abs() < 1e-11 * powers[2]);
    let energies = [own.strain_energy(&x, by), other.strain_energy(&there, 1.0)];
    assert!((energies[0] / energies[1] - 1.0).abs() < 1e-13);

    let mut links = Links::default();
    links.mass.extend((0..COUNT).map(|j| (j, j + 1)));
    let (assembly, _) = Assembly::<D>::new(COUNT + 1, &[], &links);
    let zeros = || Matrix::zeros(assembly.pattern());
    let [mut own_k, mut own_r, mut other_k, mut other_r] = [zeros(), zeros(), zeros(), zeros()];
    own.add_tangent((&x, &v), LONGER, &assembly, (&mut own_k, &mut own_r));
    let tangent = (&mut other_k, &mut other_r);
    other.add_tangent((&there, &moving), [1.0, 0.0], &assembly, tangent);
    let along = wavy::<D>(2.9);
    for (found, wanted) in [(own_k, other_k), (own_r, other_r)] {
        let found = product(&assembly, &found, &along);
        let wanted = by_length(&product(&assembly, &wanted, &by_length(&along)));
        // Coordinates are those of the nodes over the root of `by`.
        let wanted: Vec<Node<D>> = wanted.iter().map(|n| map_node(n, |x| by * x)).collect();
        let size = largest(&wanted, &[no_node(); COUNT + 1]);
        assert!(size > 1.0 && largest(&found, &wanted) < 1e-12 * size);
    }
}

#[test]
fn a_longer_chain_is_one_of_that_length() {
    is_one_of_that_length::<2>();
    is_one_of_that_length::<3>();
    // It bends: without that the test would tell nothing of it.
    assert!(chain::<2>(0.3).elements().iter().all(Element::bends));
}
