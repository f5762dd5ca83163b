//! What a cable that is paid out adds to the motion of its nodes ([`Winch`]): coordinates `u` with
//! `x = x_ref + s u`, `s = sqrt(L_0 / L)`, so `x' = s u' + s' u` and `x'' = s u'' + 2 s' u' + s'' u`; forces on `u` are `s` times those on
//! `x`.

use super::{Length, Winch};
use crate::bodies::{Bodies, NodalMotion, Node, NodeBlock, map_node};
use crate::elements::Nodal;
use crate::math::jet::{Jet, Number};

/// Part of the reference length below which a cable cannot be taken in.
const SHORTEST: f64 = 1e-3;
/// Part of the reference length that may have been paid out at the start: roundoff.
const BEGUN: f64 = 1e-9;

/// Changes numbers of one node by those of others.
fn change<const D: usize, N: Number>(to: &mut Node<D, N>, by: &Node<D, N>, of: impl Fn(N, N) -> N) {
    let by = by.as_flattened().iter();
    for (to, by) in to.as_flattened_mut().iter_mut().zip(by) {
        *to = of(*to, *by);
    }
}

impl<const D: usize> Bodies<D> {
    /// Nodes of cables that are paid out, and how long these are.
    fn scaled_nodes<'a, N: Number>(
        &'a self,
        drives: &[[N; 3]],
    ) -> impl Iterator<Item = (&'a Winch<D>, usize, Length<N>)> {
        self.winches().flat_map(move |(_, winch)| {
            let now = winch.now(drives);
            winch.nodes.clone().map(move |node| (winch, node, now))
        })
    }

    /// `s` of a node, 1 where it belongs to no cable that is paid out.
    pub fn root_at<N: Number>(&self, node: usize, drives: &[[N; 3]]) -> N {
        let mut winches = self.winches();
        let winch = winches.find(|(_, winch)| winch.nodes.contains(&node));
        winch.map_or(N::of(1.0), |(_, winch)| winch.now(drives).root[0])
    }

    /// `u` of a node of a cable that is paid out.
    fn way<N: Number>(&self, node: usize, x: &[Node<D, N>], now: &Length<N>) -> Node<D, N> {
        let (mut way, from) = (x[node], map_node(&self.reference[node], N::of));
        change(&mut way, &from, |x, from| (x - from) / now.root[0]);
        way
    }

    /// Takes positions for `x_ref + u` to `x_ref + s u`.
    pub(in crate::bodies) fn scale(&self, drives: &[[f64; 3]], x: &mut [Node<D>]) {
        for (_, node, now) in self.scaled_nodes(drives) {
            let root = now.root[0];
            change(&mut x[node], &self.reference[node], |x, from| {
                from + root * (x - from)
            });
        }
    }

    /// Takes rates from `u'` to `s u' + s' u` at positions `x`.
    pub(in crate::bodies) fn scale_rates(
        &self,
        drives: &[[f64; 3]],
        x: &[Node<D>],
        v: &mut [Node<D>],
    ) {
        for (_, node, now) in self.scaled_nodes(drives) {
            let ([root, rate, _], way) = (now.root, self.way(node, x, &now));
            change(&mut v[node], &way, |v, u| root * v + rate * u);
        }
    }

    /// Takes rates of nodes for `u'` back from `x'` at positions `x`.
    pub fn unscale_rates(&self, drives: &[[f64; 3]], x: &[Node<D>], v: &mut [Node<D>]) {
        for (_, node, now) in self.scaled_nodes(drives) {
            let ([root, rate, _], way) = (now.root, self.way(node, x, &now));
            change(&mut v[node], &way, |v, u| (v - rate * u) / root);
        }
    }

    /// Adds the accelerations of nodes that do not follow from those of coordinates, `2 s' u' + s'' u`.
    pub fn add_scaling_bias<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        out: &mut [Node<D, N>],
    ) {
        for (_, node, now) in self.scaled_nodes(motion.drives) {
            let ([root, rate, second], way) = (now.root, self.way(node, motion.x, &now));
            let twice = N::of(2.0) * rate / root;
            change(&mut out[node], &way, |sum, u| {
                sum + (second - twice * rate) * u
            });
            change(&mut out[node], &motion.v[node], |sum, v| sum + twice * v);
        }
    }

    /// Takes forces on nodes to those on `u`, or second derivatives of `u` to what they are in those of the nodes.
    pub fn pull_back_scaled<N: Number>(&self, drives: &[[N; 3]], of: &mut [Node<D, N>]) {
        for (_, node, now) in self.scaled_nodes(drives) {
            of[node] = map_node(&of[node], |number| number * now.root[0]);
        }
    }

    /// The force on one node as that on its coordinates.
    #[inline(always)]
    pub fn pull_back_force<N: Number>(
        &self,
        node: usize,
        drives: &[[N; 3]],
        force: &Node<D, N>,
    ) -> Node<D, N> {
        if !self.pays_out {
            return *force;
        }
        let root = self.root_at(node, drives);
        map_node(force, |number| number * root)
    }

    /// Takes a block over two nodes to one over their coordinates.
    pub fn pull_back_scaled_block(
        &self,
        (a, b): (usize, usize),
        drives: &[[f64; 3]],
        block: &NodeBlock<D>,
    ) -> NodeBlock<D> {
        let factor = self.root_at(a, drives) * self.root_at(b, drives);
        block.map(|rows| rows.map(|row| map_node(&row, |number| factor * number)))
    }

    /// Adds what a cable that is paid out has more of than its reference to forces on nodes: weight, and inertia forces of the
    /// accelerations that do not follow from those of coordinates. These are left in `moved`.
    pub fn add_paid_out_forces<N: Number>(
        &self,
        motion: NodalMotion<'_, D, N>,
        moved: &mut [Node<D, N>],
        force: &mut [Node<D, N>],
    ) {
        moved.fill([[N::of(0.0); D]; 2]);
        self.add_scaling_bias(motion, moved);
        for (chain, winch) in self.winches() {
            let longer = winch.now(motion.drives).length_ratio();
            chain.add_weight(&(winch.gravity.map(N::of) * (longer - N::of(1.0))), force);
            chain.add_inertia(-longer, moved, force);
        }
    }

    /// The driven coordinate of a winch that has taken in its whole cable.
    pub fn taken_in(&self, drives: &[[f64; 3]]) -> Option<usize> {
        let mut winches = self.winches().map(|(_, winch)| winch);
        let shortest =
            |winch: &&Winch<D>| drives[winch.coordinate][0] <= (SHORTEST - 1.0) * winch.length;
        winches.find(shortest).map(|winch| winch.coordinate)
    }

    /// The driven coordinate of a winch that has paid out cable, and how much, m.
    pub fn paid_out_at_start(&self, drives: &[[f64; 3]]) -> Option<(usize, f64)> {
        self.winches().find_map(|(_, winch)| {
            let [travel, ..] = drives[winch.coordinate];
            (travel.abs() > BEGUN * winch.length).then_some((winch.coordinate, travel))
        })
    }

    /// Adds the momentum of material that passes through cables that are paid out, times a factor, to forces on nodes, kg m/s.
    pub fn add_convective_momentum(
        &self,
        drives: &[[f64; 3]],
        factor: f64,
        x: &[Node<D>],
        f: &mut [Node<D>],
    ) {
        for (chain, winch) in self.winches() {
            let now = winch.now(drives);
            for j in 0..chain.elements().len() {
                let momentum: Nodal<D> = winch.convective_momentum(chain, j, x, &now) * factor;
                chain.add_to(j, &momentum, f);
            }
        }
    }

    /// Takes derivative `k` of accelerations of coordinates `found`, over the nodes, to what it is in that of the nodes: every number of cables
    /// that are paid out changes with their length. `value` are the
    /// nodal accelerations, `acceleration` the same with the derivatives known, and `bias` the part of it that follows from positions and rates
    /// alone.
    pub fn differentiate_scaled(
        &self,
        k: usize,
        drives: &[[Jet; 3]],
        value: &[Node<D>],
        (bias, acceleration): (&[Node<D, Jet>], &[Node<D, Jet>]),
        found: &mut [Node<D>],
    ) {
        for (_, winch) in self.winches() {
            let [root, ..] = winch.now(drives).root;
            for node in winch.nodes.clone() {
                let driven = bias[node].as_flattened();
                let known = acceleration[node].as_flattened();
                let value = value[node].as_flattened();
                let found = found[node].as_flattened_mut().iter_mut();
                for (i, found) in found.enumerate() {
                    let own = (value[i] - driven[i].re) / root.re;
                    let below = match k {
                        1 => root.v1 * own,
                        _ => {
                            let first = known[i].v1 - driven[i].v1 - root.v1 * own;
                            2.0 * root.v1 * first / root.re + root.v2 * own
                        }
                    };
                    *found = root.re * *found + below;
                }
            }
        }
    }

    /// Adds the inertia that cables have more of than their reference at these accelerations, N.
    pub fn add_inertia_of_paid_out<N: Number>(
        &self,
        drives: &[[N; 3]],
        acceleration: &[Node<D, N>],
        f: &mut [Node<D, N>],
    ) {
        for (line, winch) in self.winches() {
            let more = winch.now(drives).length_ratio() - N::of(1.0);
            line.add_inertia(more, acceleration, f);
        }
    }
}
