//! In which order vertices are eliminated.
//!
//! Source: A. George, J. W. H. Liu, The evolution of the minimum degree ordering algorithm, SIAM Review 31 (1989) 1-19.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// The vertices of every connected part, lowest first vertices first.
pub fn parts(graph: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; graph.len()];
    let mut parts = Vec::new();
    for first in 0..graph.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut part = vec![first];
        let mut next = 0;
        while let Some(&v) = part.get(next) {
            for &w in &graph[v] {
                if !seen[w] {
                    seen[w] = true;
                    part.push(w);
                }
            }
            next += 1;
        }
        parts.push(part);
    }
    parts
}

/// The neighbours of every vertex.
pub fn graph(sizes: &[usize], edges: &[(usize, usize)]) -> Vec<BTreeSet<usize>> {
    let mut graph = vec![BTreeSet::new(); sizes.len()];
    for &(v, w) in edges {
        if v != w && sizes[v] > 0 && sizes[w] > 0 {
            graph[v].insert(w);
            graph[w].insert(v);
        }
    }
    graph
}

/// Takes a vertex out of the graph, joining its neighbours, which are returned; tells of every new pair of them, both
/// ways round.
pub(super) fn take_out(
    v: usize,
    graph: &mut [BTreeSet<usize>],
    mut joined: impl FnMut(usize, usize),
) -> Vec<usize> {
    let neighbours: Vec<usize> = std::mem::take(&mut graph[v]).into_iter().collect();
    for &u in &neighbours {
        graph[u].remove(&v);
        for &w in &neighbours {
            if w != u && graph[u].insert(w) {
                joined(u, w);
            }
        }
    }
    neighbours
}

/// The vertices in the order of least degree (variables of the neighbours, those that elimination joins among them),
/// at ties those that are not to come late, then by lowest index, one component after the other in the order of their lowest
/// vertices.
pub(super) fn least_degree(
    sizes: &[usize],
    edges: &[(usize, usize)],
    is_late: &[bool],
) -> Vec<usize> {
    const ELIMINATED: usize = usize::MAX;
    let mut graph = graph(sizes, edges);
    let degree = |near: &BTreeSet<usize>| near.iter().map(|&w| sizes[w]).sum();
    let mut degrees: Vec<usize> = graph.iter().map(degree).collect();
    let mut order = Vec::with_capacity(sizes.len());
    for part in parts(&graph) {
        let rank = |degree: usize, v: usize| Reverse((degree, is_late[v], v));
        let mut queue: BinaryHeap<_> = part.iter().map(|&v| rank(degrees[v], v)).collect();
        while let Some(Reverse((degree, _, v))) = queue.pop() {
            if degrees[v] != degree {
                continue; // out of date
            }
            degrees[v] = ELIMINATED;
            let neighbours = take_out(v, &mut graph, |u, w| degrees[u] += sizes[w]);
            for &u in &neighbours {
                degrees[u] -= sizes[v];
                queue.push(rank(degrees[u], u));
            }
            order.push(v);
        }
    }
    order
}
