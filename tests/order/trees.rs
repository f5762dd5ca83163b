//! Coefficients of explicit Runge-Kutta methods against all conditions of their order, one for every rooted tree.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.2.

use flexbody::integrators::{Coefficients, DOPRI853, RK4};

/// A rooted tree: how many vertices it has, its density, and what the stages make of it.
struct Tree {
    order: usize,
    density: f64,
    stages: Vec<f64>,
}

/// Weights times the values of stages.
fn sum(weights: &[(usize, f64)], stages: &[f64]) -> f64 {
    weights.iter().map(|(stage, w)| w * stages[*stage]).sum()
}

/// All trees up to an order, each made of a root and of smaller trees in the order in which they are found.
fn trees(method: &Coefficients, most: usize) -> Vec<Tree> {
    let mut trees = vec![Tree {
        order: 1,
        density: 1.0,
        stages: vec![1.0; method.c.len()],
    }];
    for order in 2..=most {
        let mut grown = Vec::new();
        grow(&trees, 0, order - 1, &mut Vec::new(), &mut |branches| {
            let mut tree = Tree {
                order,
                density: order as f64,
                stages: vec![1.0; method.c.len()],
            };
            for branch in branches {
                tree.density *= trees[*branch].density;
                for (stage, weights) in tree.stages.iter_mut().zip(method.a) {
                    *stage *= sum(weights, &trees[*branch].stages);
                }
            }
            grown.push(tree);
        });
        trees.extend(grown);
    }
    trees
}

/// Shows all choices of trees from one on that have so many vertices together.
fn grow(
    trees: &[Tree],
    from: usize,
    vertices: usize,
    chosen: &mut Vec<usize>,
    show: &mut impl FnMut(&[usize]),
) {
    if vertices == 0 {
        return show(chosen);
    }
    for next in (from..trees.len()).filter(|tree| trees[*tree].order <= vertices) {
        chosen.push(next);
        grow(trees, next, vertices - trees[next].order, chosen, show);
        chosen.pop();
    }
}

#[test]
fn coefficients_meet_every_condition_of_their_order() {
    // Order of the method, of the embedded one, and of the second.
    for (method, [order, embedded, lower]) in [(&RK4, [4, 3, 0]), (&DOPRI853, [8, 5, 3])] {
        let trees = trees(method, order);
        let counts = [1, 2, 4, 8, 17, 37, 85, 200];
        assert_eq!(trees.len(), counts[order - 1], "trees up to order {order}");
        for (c, weights) in method.c.iter().zip(method.a) {
            let row = sum(weights, &trees[0].stages);
            assert!((row - c).abs() < 2e-14, "{}: {row} at {c}", method.name);
        }
        let end = method.a[method.a.len() - 1];
        for tree in &trees {
            let missed = |weights, exact: f64| (sum(weights, &tree.stages) - exact).abs();
            let name = method.name;
            assert!(
                missed(end, 1.0 / tree.density) < 1e-13,
                "{name}: order {}",
                tree.order
            );
            let estimates = [(method.error, embedded), (method.lower, lower)];
            for (weights, _) in estimates.iter().filter(|(_, order)| tree.order <= *order) {
                assert!(
                    missed(weights, 0.0) < 1e-13,
                    "{name}: estimate, order {}",
                    tree.order
                );
            }
        }
        // No estimate is of a higher order than it says, and each sees an error.
        for (weights, order) in [(method.error, embedded), (method.lower, lower)] {
            let next = trees.iter().filter(|tree| tree.order == order + 1);
            let seen = next.map(|tree| sum(weights, &tree.stages).abs());
            let seen = seen.fold(0.0, f64::max);
            assert!(weights.is_empty() || seen > 1e-4, "{}: {seen}", method.name);
        }
    }
}
