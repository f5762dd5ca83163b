//! Tests of the sparse factorization against dense ones.

use super::*;
use nalgebra::{Complex, ComplexField, DMatrix, DVector};

/// Repeatable numbers in [-0.5, 0.5).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    }

    fn below(&mut self, end: usize) -> usize {
        ((self.number() + 0.5) * end as f64) as usize
    }
}

type Graph = (Vec<usize>, Vec<(usize, usize)>);

/// Chains, a loop, trees, stars with odd sizes, empty vertices, separate parts, anything.
fn graphs() -> Vec<Graph> {
    let chain = |n: usize| (1..n).map(|v| (v - 1, v)).collect::<Vec<_>>();
    let mut random = Random(7);
    let mut graphs = vec![
        (vec![], vec![]),
        (vec![0], vec![(0, 0)]),
        (vec![4], vec![]),
        (vec![4; 12], chain(12)),
        (vec![2; 9], chain(9)),
        (vec![4, 4, 0, 4, 4, 4], chain(6)),
        (vec![2, 4, 4, 7, 4, 4, 1], chain(7)),
        (vec![4; 8], [chain(8), vec![(7, 0)]].concat()),
        (
            vec![4; 9],
            [chain(4), vec![(5, 6), (8, 6), (7, 8), (3, 3), (3, 2)]].concat(),
        ),
        (
            vec![4, 4, 4, 4, 13, 4, 4, 0, 3],
            vec![
                (0, 4),
                (1, 0),
                (4, 2),
                (3, 4),
                (5, 4),
                (6, 5),
                (7, 4),
                (8, 7),
                (8, 4),
            ],
        ),
        (
            vec![61, 4, 4, 4, 4, 4, 4, 4],
            [chain(4), vec![(0, 4), (4, 5), (5, 6), (6, 7), (7, 0)]].concat(),
        ),
    ];
    for n in 2..30 {
        let sizes = (0..n).map(|_| random.below(7)).collect();
        let mut edges: Vec<_> = (1..n).map(|v| (random.below(v), v)).collect();
        for _ in 0..random.below(n) {
            edges.push((random.below(n), random.below(n)));
        }
        edges.truncate(edges.len() - random.below(3).min(edges.len()));
        graphs.push((sizes, edges));
    }
    graphs
}

/// A random matrix with `bump` on its diagonal, sparse and dense.
fn matrix<T: Number + ComplexField>(
    graph: &Graph,
    pattern: &Pattern,
    random: &mut Random,
    number: fn(f64, f64) -> T,
    bump: f64,
) -> (Matrix<T>, DMatrix<T>) {
    let mut a = Matrix::zeros(pattern);
    let mut dense =
        DMatrix::from_element(pattern.len(), pattern.len(), <T as From<f64>>::from(0.0));
    let own = (0..graph.0.len()).map(|v| (v, v));
    for (v, w) in graph.1.iter().copied().chain(own) {
        let slot = pattern.slot(v, w).expect("stored");
        assert_eq!(pattern.slot(w, v).map(|s| s.at), Some(slot.at));
        for (r, i) in pattern.range(v).enumerate() {
            for (c, j) in pattern.range(w).enumerate() {
                let bump = if i == j { bump } else { 0.0 };
                let value = number(random.number() + bump, random.number() + bump / 2.0);
                a.values[slot.entry(r, c)] = value;
                dense[(i, j)] = value;
                if v == w {
                    a.values[slot.entry(c, r)] = value;
                }
                dense[(j, i)] = value;
            }
        }
    }
    (a, dense)
}

fn error<T: Number>(a: &[T], b: &[T]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| (*a - *b).size())
        .fold(0.0, f64::max)
}

fn check<T: Number + ComplexField>(number: fn(f64, f64) -> T) {
    for (g, graph) in graphs().iter().enumerate() {
        let pattern = Pattern::new(&graph.0, &graph.1);
        let mut random = Random(g as u64);
        let (mut a, dense) = matrix(graph, &pattern, &mut random, number, 70.0);
        let x = DVector::from_fn(pattern.len(), |_, _| {
            number(random.number(), random.number())
        });
        let b = &dense * &x;
        let mut y = vec![<T as From<f64>>::from(1.0); pattern.len()];
        a.multiply(&pattern, x.as_slice(), &mut y);
        assert!(error(&y, b.as_slice()) < 1e-12, "product, graph {g}");
        for v in 0..graph.0.len() {
            let slot = pattern.slot(v, v).expect("stored");
            for r in 0..graph.0[v] {
                for c in r + 1..graph.0[v] {
                    a.values[slot.entry(r, c)] = <T as From<f64>>::from(f64::NAN); // not read
                }
            }
        }
        assert_eq!(a.factor(&pattern), Some(0));
        a.solve(&pattern, &mut y);
        assert!(error(&y, x.as_slice()) < 1e-13, "solution, graph {g}");
        if !pattern.is_empty() {
            let lu = dense.lu().solve(&b).expect("regular");
            assert!(
                error(&y, lu.as_slice()) < 1e-13,
                "dense solution, graph {g}"
            );
        }
    }
}

#[test]
fn solves_real_and_complex_systems() {
    check::<f64>(|re, _| re);
    check::<Complex<f64>>(Complex::new);
}

#[test]
fn counts_negative_pivots_and_refuses_zero_ones() {
    for (g, graph) in graphs().iter().enumerate() {
        let pattern = Pattern::new(&graph.0, &graph.1);
        if pattern.is_empty() {
            continue;
        }
        let (mut a, dense) = matrix(graph, &pattern, &mut Random(g as u64), |re, _| re, 0.3);
        let negative = dense
            .symmetric_eigenvalues()
            .iter()
            .filter(|v| **v < 0.0)
            .count();
        assert_eq!(a.factor(&pattern), Some(negative), "graph {g}");
    }
    let pattern = Pattern::new(&[1, 1], &[(0, 1)]);
    for bad in [1.0, f64::NAN, f64::INFINITY] {
        let mut a = Matrix {
            values: vec![1.0, 1.0, bad],
            scratch: Vec::new(),
        };
        assert_eq!(a.factor(&pattern), None);
    }
    let one = Complex::new(0.0, 1.0);
    assert_eq!(
        Matrix {
            values: vec![one; 3],
            scratch: Vec::new(),
        }
        .factor(&pattern),
        None
    );
}

/// Checks all products and solves with the factor of a matrix.
fn check_cholesky(pattern: &Pattern, (a, dense): (&Matrix<f64>, &DMatrix<f64>), seed: usize) {
    let mut random = Random(seed as u64);
    let w = Cholesky::new(pattern, a).expect("positive definite");
    let lower = nalgebra::Cholesky::new(dense.clone())
        .expect("positive definite")
        .l();
    let x = DVector::from_fn(pattern.len(), |_, _| random.number());
    let mut y = x.as_slice().to_vec();
    w.multiply_transposed(pattern, &mut y);
    let transposed = lower.transpose() * &x;
    assert!(error(&y, transposed.as_slice()) < 1e-12, "graph {seed}");
    w.multiply(pattern, &mut y);
    assert!(error(&y, (dense * &x).as_slice()) < 1e-12, "graph {seed}");
    let order = pattern.order();
    for (first, count) in (0..order.len()).flat_map(|first| [(first, 1), (first, 2)]) {
        let vertices: Vec<usize> = (0..count)
            .map(|k| order[(first + k) % order.len()])
            .collect();
        let mut part = vec![0.0; pattern.len()];
        for v in &vertices {
            part[pattern.range(*v)].fill_with(|| random.number());
        }
        let mut whole = part.clone();
        w.forward(pattern, &mut whole);
        w.forward_within(pattern, &w.reach(pattern, &vertices), &mut part);
        assert!(
            error(&part, &whole) < 1e-15,
            "vertices {vertices:?}, graph {seed}"
        );
    }
    w.forward(pattern, &mut y);
    assert!(error(&y, transposed.as_slice()) < 1e-12, "graph {seed}");
    let z = y.clone();
    w.backward(pattern, &z, &mut y);
    assert!(error(&y, x.as_slice()) < 1e-13, "graph {seed}");
}

#[test]
fn cholesky_factors_multiply_and_solve() {
    for (g, graph) in graphs().iter().enumerate() {
        let pattern = Pattern::new(&graph.0, &graph.1);
        let mut random = Random(g as u64);
        let (a, dense) = matrix(graph, &pattern, &mut random, |re, _| re, 70.0);
        check_cholesky(&pattern, (&a, &dense), g);
    }
    let pattern = Pattern::new(&[2], &[]);
    assert!(
        Cholesky::new(
            &pattern,
            &Matrix {
                values: vec![1.0, 2.0, 2.0, 1.0],
                scratch: Vec::new(),
            }
        )
        .is_none()
    );
}

/// Matrices that are the same in all directions, as masses of cables are: nodes of two vectors, and of one where a node is
/// pinned, in chains and apart.
#[test]
fn cholesky_factors_of_isotropic_matrices_multiply_and_solve() {
    let chain = |n: usize| (1..n).map(|v| (v - 1, v)).collect::<Vec<_>>();
    let graphs = [
        (vec![2], vec![]),
        (vec![1, 2], chain(2)),
        (vec![1, 2, 2, 2], chain(4)),
        (vec![2, 2, 2, 2, 1], chain(5)),
        (vec![1, 2, 2, 3, 2, 2, 1], chain(7)),
        (vec![1, 2, 2, 1, 2], [chain(3), vec![(3, 4)]].concat()),
    ];
    for (g, graph) in graphs.iter().enumerate() {
        let mut random = Random(g as u64);
        let single = Pattern::new(&graph.0, &graph.1);
        let (_, numbers) = matrix(graph, &single, &mut random, |re, _| re, 70.0);
        for axes in 1..4 {
            let sizes: Vec<usize> = graph.0.iter().map(|size| axes * size).collect();
            let pattern = Pattern::new(&sizes, &graph.1);
            let n = pattern.len();
            let dense = DMatrix::from_fn(n, n, |i, j| {
                let is_along = i % axes == j % axes;
                if is_along {
                    numbers[(i / axes, j / axes)]
                } else {
                    0.0
                }
            });
            let mut a = Matrix::zeros(&pattern);
            let own = (0..sizes.len()).map(|v| (v, v));
            for (v, w) in graph.1.iter().copied().chain(own) {
                let slot = pattern.slot(v, w).expect("stored");
                for (r, i) in pattern.range(v).enumerate() {
                    for (c, j) in pattern.range(w).enumerate() {
                        a.values[slot.entry(r, c)] = dense[(i, j)];
                    }
                }
            }
            check_cholesky(&pattern, (&a, &dense), g);
        }
    }
}

/// A mesh of so many nodes a side, whose nodes are coupled with all around them, and further vertices at its first line.
fn surface_edges(side: usize, further: usize) -> Vec<(usize, usize)> {
    let node = |i: usize, j: usize| i * side + j;
    let mut edges = Vec::new();
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        for (k, l) in [(i, j + 1), (i + 1, j), (i + 1, j + 1)] {
            if k < side && l < side {
                edges.push((node(i, j), node(k, l)));
            }
        }
        if i + 1 < side && j > 0 {
            edges.push((node(i, j), node(i + 1, j - 1)));
        }
    }
    for k in 0..further {
        let own = side * side + k;
        let near = k.saturating_sub(1)..(k + 2).min(side);
        edges.extend(near.map(|j| (own, j)));
        edges.extend((k > 0).then_some((own - 1, own)));
    }
    edges
}

/// Masses of surfaces: nodes of two vectors in space, and at an edge vertices whose blocks depend on the direction. Nodes go three directions at
/// once, also where blocks to the edge do not.
#[test]
fn cholesky_factors_of_surfaces_multiply_and_solve() {
    for (side, further) in [(2, 0), (7, 0), (9, 0), (7, 7), (9, 4)] {
        let (nodes, edges) = (side * side, surface_edges(side, further));
        let all = nodes + further;
        let sizes: Vec<usize> = (0..all).map(|v| if v < nodes { 6 } else { 2 }).collect();
        let late: Vec<bool> = (0..all).map(|v| v >= nodes).collect();
        let pattern = Pattern::new(&sizes, &edges).of_part(&sizes, &edges, &late);
        assert!((nodes..all).all(|v| pattern.range(v).start >= 6 * nodes));
        let mut random = Random((side + further) as u64);
        let mut a = Matrix::zeros(&pattern);
        let mut dense = DMatrix::zeros(pattern.len(), pattern.len());
        for (v, w) in edges.iter().copied().chain((0..all).map(|v| (v, v))) {
            let slot = pattern.slot(v, w).expect("stored");
            let numbers: [f64; 36] = std::array::from_fn(|_| random.number());
            let is_directed = v.max(w) >= nodes;
            for (r, i) in pattern.range(v).enumerate() {
                for (c, j) in pattern.range(w).enumerate() {
                    let own = if v == w { (r.max(c), r.min(c)) } else { (r, c) };
                    let value = match (is_directed, own.0 % 3 == own.1 % 3) {
                        (true, _) => numbers[6 * own.0 + own.1],
                        (false, true) => numbers[6 * (own.0 / 3) + own.1 / 3],
                        (false, false) => 0.0,
                    };
                    let value = value + if i == j { 30.0 } else { 0.0 };
                    a.values[slot.entry(r, c)] = value;
                    (dense[(i, j)], dense[(j, i)]) = (value, value);
                }
            }
        }
        check_cholesky(&pattern, (&a, &dense), side);
        let factor = Cholesky::new(&pattern, &a).expect("positive definite");
        let most = if side > 2 { 3 * nodes } else { 0 };
        assert!(
            factor.in_vectors() >= most,
            "{} of {}",
            factor.in_vectors(),
            6 * nodes
        );
    }
}

#[test]
fn components_are_contiguous() {
    for (sizes, edges) in graphs() {
        let pattern = Pattern::new(&sizes, &edges);
        let mut sorted = pattern.order().to_vec();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..sizes.len()));
        let (mut variables, mut vertices, mut lowest) = (0, 0, None);
        for (c, component) in pattern.components().iter().enumerate() {
            assert_eq!(component.variables.start, variables);
            assert_eq!(component.vertices.start, vertices);
            for &v in &pattern.order()[component.vertices.clone()] {
                assert_eq!(pattern.component_of(v), c);
                assert_eq!(pattern.range(v), variables..variables + sizes[v]);
                variables += sizes[v];
            }
            assert_eq!(component.variables.end, variables);
            vertices = component.vertices.end;
            let first = pattern.order()[component.vertices.clone()]
                .iter()
                .min()
                .copied();
            assert!(first > lowest);
            lowest = first;
        }
        assert_eq!((variables, vertices), (pattern.len(), sizes.len()));
        for (v, w) in edges {
            let apart = pattern.component_of(v) != pattern.component_of(w);
            assert!(!apart || sizes[v] == 0 || sizes[w] == 0);
        }
    }
}

#[test]
fn chains_and_trees_have_no_fill() {
    let n = 100_000;
    let chain: Vec<_> = (1..n).map(|v| (v, v - 1)).collect();
    let pattern = Pattern::new(&vec![4; n], &chain);
    assert!(pattern.order().iter().copied().eq(0..n));
    assert_eq!(
        Matrix::<f64>::zeros(&pattern).values.len(),
        16 * (2 * n - 1)
    );
    let star: Vec<_> = (1..n).map(|v| (0, v)).collect();
    let tree: Vec<_> = (1..n).map(|v| (v, v / 3)).collect();
    for edges in [star, tree] {
        let pattern = Pattern::new(&vec![1; n], &edges);
        assert_eq!(Matrix::<f64>::zeros(&pattern).values.len(), 2 * n - 1);
    }
    assert_eq!(Pattern::new(&[4; 4], &[(0, 1), (2, 3)]).slot(1, 2), None);
}

/// A matrix that is not symmetric: product, solution, determinant, and what is not symmetric about it.
fn check_general<T: Number + ComplexField>(number: fn(f64, f64) -> T) {
    for (g, graph) in graphs().iter().enumerate() {
        let pattern = Pattern::new(&graph.0, &graph.1);
        let (mut random, n) = (Random(g as u64), pattern.len());
        let zero = <T as From<f64>>::from(0.0);
        let (mut a, mut dense) = (General::zeros(&pattern), DMatrix::from_element(n, n, zero));
        let own = (0..graph.0.len()).map(|v| (v, v));
        for (v, w) in graph.1.iter().copied().chain(own) {
            for (v, w) in [(v, w), (w, v)] {
                let slot = pattern.slot(v, w).expect("stored");
                for (r, i) in pattern.range(v).enumerate() {
                    for (c, j) in pattern.range(w).enumerate() {
                        // The largest entries of a block stand off its diagonal.
                        let next = graph.0[v] - 1 - r == c && v == w;
                        let bump = if next { 40.0 } else { 0.0 };
                        let value = number(random.number() + bump, random.number());
                        a.add_entry(slot, r, c, value);
                        dense[(i, j)] += value;
                    }
                }
            }
        }
        let x = DVector::from_fn(n, |_, _| number(random.number(), random.number()));
        let b = &dense * &x;
        let mut y = vec![zero; n];
        a.multiply(&pattern, x.as_slice(), &mut y);
        assert!(error(&y, b.as_slice()) < 1e-12, "product, graph {g}");
        let [whole, skew] = a.largest(&pattern);
        let exact = [&dense, &(&dense - dense.transpose())]
            .map(|m| error(m.as_slice(), &vec![zero; n * n]));
        assert!(
            (whole - exact[0]).abs() + (skew - exact[1]).abs() < 1e-12,
            "sizes, graph {g}"
        );
        let factors = a.factor(&pattern).expect("regular");
        factors.solve(&pattern, &mut y);
        assert!(error(&y, x.as_slice()) < 1e-12, "solution, graph {g}");
        let one = <T as From<f64>>::from(1.0);
        let found = factors
            .blocks(&pattern)
            .fold(one, |product, (pivots, is_odd)| {
                let sign = <T as From<f64>>::from(if is_odd { -1.0 } else { 1.0 });
                pivots
                    .iter()
                    .fold(product * sign, |product, pivot| product * *pivot)
            });
        let exact = dense.determinant();
        assert!(
            (found - exact).size() < 1e-10 * exact.size(),
            "determinant, graph {g}"
        );
    }
}

#[test]
fn factors_of_matrices_that_are_not_symmetric_solve() {
    check_general::<f64>(|re, _| re);
    check_general::<Complex<f64>>(Complex::new);
}

/// Multipliers between vertices: solutions are those of the dense matrix, every pivot of a multiplier is negative.
#[test]
fn multipliers_come_after_what_they_hold() {
    let mut random = Random(5);
    for count in [2, 5, 30] {
        let sizes: Vec<usize> = (0..count).map(|v| [4, 6, 3][v % 3]).collect();
        let mut edges = Vec::new();
        // Two on every pair of neighbours, one on the first and last.
        let mut multipliers = Vec::new();
        for v in 1..count {
            edges.extend([(count + v - 1, v - 1), (count + v - 1, v)]);
            multipliers.push(2);
        }
        edges.extend([(2 * count - 1, 0), (2 * count - 1, count - 1)]);
        multipliers.push(1);
        let all: Vec<usize> = sizes.iter().copied().chain(multipliers).collect();
        let pattern = Pattern::with_multipliers(&all, &edges, count);
        let n = pattern.len();
        let (mut a, mut dense) = (Matrix::zeros(&pattern), DMatrix::zeros(n, n));
        let mut set = |v: usize, w: usize, value: &mut dyn FnMut(usize, usize) -> f64| {
            let slot = pattern.slot(v, w).expect("an edge");
            for (r, i) in pattern.range(v).enumerate() {
                for (c, j) in pattern.range(w).enumerate() {
                    let x = value(r, c);
                    a.values[slot.entry(r, c)] = x;
                    dense[(i, j)] = x;
                    dense[(j, i)] = x;
                }
            }
        };
        for v in 0..count {
            set(v, v, &mut |r, c| if r == c { 2.0 + v as f64 } else { 0.0 });
        }
        for (m, v) in &edges {
            set(*m, *v, &mut |_, _| random.number());
        }
        let b = DVector::from_fn(n, |_, _| random.number());
        let mut x = b.as_slice().to_vec();
        let negative = a.factor(&pattern).expect("regular");
        a.solve(&pattern, &mut x);
        assert_eq!(negative, 2 * (count - 1) + 1);
        let expected = dense.lu().solve(&b).expect("regular");
        assert!(error(&x, expected.as_slice()) < 1e-11, "{count} vertices");
    }
}

/// A chain that is held at its first vertex is eliminated from its last one, so that forces on the held one stay there.
#[test]
fn of_equal_degrees_what_multipliers_hold_comes_last() {
    let edges = [(0, 1), (1, 2), (2, 3), (4, 0)];
    let pattern = Pattern::with_multipliers(&[6, 6, 6, 6, 3], &edges, 4);
    assert_eq!(pattern.order(), [3, 2, 1, 0, 4]);
    let free = Pattern::with_multipliers(&[6, 6, 6, 6], &edges[..3], 4);
    assert_eq!(free.order(), [0, 1, 2, 3]);
}

/// Vertices of two chains that only other edges join: in a part without these each chain stands by itself, in one piece.
#[test]
fn chains_stand_together_in_a_part() {
    let sizes = [6, 1, 6, 1, 6, 1];
    let chains = [(0, 2), (2, 4), (1, 3), (3, 5)];
    let across = [(0, 1), (2, 3), (4, 5), (0, 3), (1, 2), (2, 5), (3, 4)];
    let pattern = Pattern::new(&sizes, &[&chains[..], &across].concat());
    let part = pattern.of_part(&sizes, &chains, &vec![false; sizes.len()]);
    let of = |part: &[usize], is_even: bool| {
        let chosen = part.iter().filter(|v| (**v % 2 == 0) == is_even);
        chosen.copied().collect::<Vec<_>>()
    };
    let order = part.order();
    assert_eq!(of(&order[..3], true).len() % 3, 0, "{order:?}");
    for is_even in [true, false] {
        assert_eq!(of(order, is_even), of(pattern.order(), is_even));
    }
    assert_eq!(part.components().len(), 1);
}

#[test]
fn rows_with_little_pivots_drop_out() {
    // Every row twice, in blocks of every kind: chains of equal blocks, other columns, one dense block.
    for sizes in [&[1; 6][..], &[2; 3], &[3; 2], &[2, 1, 3], &[1, 5], &[6]] {
        let rows: [[f64; 3]; 6] = [
            [1.0, 2.0, 0.3],
            [0.5, -1.0, 0.0],
            [1.0, 2.0, 0.3],
            [-0.2, 0.1, 0.7],
            [0.5, -1.0, 0.0],
            [-0.2, 0.1, 0.7],
        ];
        let dot = |a: usize, b: usize| (0..3).map(|k| rows[a][k] * rows[b][k]).sum::<f64>();
        let blocks = 0..sizes.len();
        let edges: Vec<_> = blocks
            .clone()
            .flat_map(|v| (0..v).map(move |w| (v, w)))
            .collect();
        let pattern = Pattern::new(sizes, &edges);
        let first: Vec<usize> = blocks.clone().map(|v| sizes[..v].iter().sum()).collect();
        let mut a = Matrix::zeros(&pattern);
        for (v, w) in edges.iter().copied().chain(blocks.clone().map(|v| (v, v))) {
            let slot = pattern.slot(v, w).expect("stored");
            for r in 0..sizes[v] {
                for c in 0..sizes[w] {
                    a.values[slot.entry(r, c)] = dot(first[v] + r, first[w] + c);
                }
            }
        }
        let place = |v: usize, r: usize| (first[v] + r, pattern.range(v).start + r);
        let places: Vec<(usize, usize)> = blocks
            .flat_map(|v| (0..sizes[v]).map(move |r| place(v, r)))
            .collect();
        let (mut squares, mut counts, mut b) = ([0.0; 6], [true; 6], [0.0; 6]);
        let mut pivots = [0.0; 6];
        let x = [0.3, -0.7, 0.4];
        for &(row, at) in &places {
            squares[at] = dot(row, row);
            b[at] = (0..3).map(|k| rows[row][k] * x[k]).sum();
        }
        a.factor_semidefinite(
            &pattern,
            &squares.map(|square| 1e-8 * square),
            &mut counts,
            &mut pivots,
        );
        assert_eq!(
            counts.iter().filter(|stays| **stays).count(),
            3,
            "{sizes:?}"
        );
        for &(row, at) in &places {
            assert_eq!(counts[at], pivots[at] > 1e-8 * squares[at], "{sizes:?}");
            if !counts[at] {
                b[at] = 0.0;
            }
            let twin = |(other, _): &&(usize, usize)| *other != row && rows[*other] == rows[row];
            let twin = places.iter().find(twin).expect("every row stands twice");
            assert_ne!(counts[at], counts[twin.1], "{sizes:?}");
        }
        a.solve(&pattern, &mut b);
        let found: [f64; 3] =
            std::array::from_fn(|k| places.iter().map(|(row, at)| rows[*row][k] * b[*at]).sum());
        assert!(error(&found, &x) < 1e-14, "{sizes:?}");
    }
}

/// Two vertices of six variables at every node of a square mesh, each linked to all others of the elements around it.
fn mesh(elements: usize) -> Graph {
    let side = elements + 1;
    let mut edges = Vec::new();
    for corner in (0..elements * elements).map(|k| k / elements * side + k % elements) {
        let nodes = [corner, corner + 1, corner + side, corner + side + 1];
        let vertices: Vec<usize> = nodes.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
        for (k, v) in vertices.iter().enumerate() {
            edges.extend(vertices[..k].iter().map(|w| (*v, *w)));
        }
    }
    (vec![6; 2 * side * side], edges)
}

fn panels_are_plain_factors<T: Number + ComplexField>(number: fn(f64, f64) -> T, bump: f64) {
    let graph = mesh(8);
    let pattern = Pattern::new(&graph.0, &graph.1);
    assert!(pattern.panels.len() > 4, "{}", pattern.panels.len());
    let mut plain = pattern.clone();
    plain.panels.clear();
    let (a, _) = matrix(&graph, &pattern, &mut Random(3), number, bump);
    let right: Vec<T> = (0..pattern.len())
        .map(|k| number((k as f64).sin(), 0.5))
        .collect();
    let mut solved = [&pattern, &plain].map(|pattern| {
        let (mut factors, mut x) = (a.clone(), right.clone());
        let negative = factors.factor(pattern).expect("a regular matrix");
        factors.solve(pattern, &mut x);
        (negative, x)
    });
    let [panels, plain] = &mut solved;
    assert_eq!(panels.0, plain.0);
    assert!(
        error(&panels.1, &plain.1) < 1e-12 * error(&plain.1, &vec![number(0.0, 0.0); right.len()])
    );
}

#[test]
fn panels_factor_as_column_after_column_does() {
    panels_are_plain_factors(|re, _| re, 40.0);
    panels_are_plain_factors(|re, _| re, -40.0);
    panels_are_plain_factors(Complex::new, 40.0);
}

#[test]
fn panels_drop_dependent_rows_as_columns_do() {
    let graph = mesh(8);
    let pattern = Pattern::new(&graph.0, &graph.1);
    let mut plain = pattern.clone();
    plain.panels.clear();
    let (mut a, _) = matrix(&graph, &pattern, &mut Random(3), |re, _| re, 40.0);
    // A row of zeros in the middle of a panel.
    let lost = pattern.columns[pattern.panels[3].columns.start].start + 7;
    for k in 0..pattern.len() {
        clear_entry(&pattern, &mut a, (lost, k));
    }
    let bounds = vec![1e-9; pattern.len()];
    let [of_panels, of_columns] = [&pattern, &plain].map(|pattern| {
        let (mut factors, mut x) = (a.clone(), vec![1.0; pattern.len()]);
        let (mut counts, mut pivots) = (vec![true; pattern.len()], vec![0.0; pattern.len()]);
        factors.factor_semidefinite(pattern, &bounds, &mut counts, &mut pivots);
        factors.solve(pattern, &mut x);
        assert_eq!(counts.iter().filter(|stays| !**stays).count(), 1);
        assert!(!counts[lost] && x[lost] == 0.0);
        x
    });
    assert!(error(&of_panels, &of_columns) < 1e-13);
}

/// Sets the entry of two variables to zero where it is stored.
fn clear_entry(pattern: &Pattern, a: &mut Matrix<f64>, (row, column): (usize, usize)) {
    let vertex = |k: usize| {
        pattern
            .order()
            .iter()
            .position(|v| pattern.range(*v).contains(&k))
    };
    let of = [row, column].map(|k| pattern.order()[vertex(k).expect("a vertex")]);
    if let Some(slot) = pattern.slot(of[0], of[1]) {
        let [r, c] = [0, 1].map(|k| [row, column][k] - pattern.range(of[k]).start);
        a.values[slot.entry(r, c)] = 0.0;
        if of[0] == of[1] {
            a.values[slot.entry(c, r)] = 0.0;
        }
    }
}
