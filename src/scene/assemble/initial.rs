//! Motions of bodies at the start.

use std::ops::Range;

use crate::body::Node;
use crate::math::expression::Expression;
use crate::scene::{Error, InitialMotion};

/// Motions of all bodies at the start.
#[derive(Clone, Debug, Default)]
pub struct Motions {
    /// Nodes of every body, velocity of the first one, spin.
    bodies: Vec<(Range<usize>, [f64; 2], f64)>,
    /// Rates of deformation of all nodes.
    deformation: Vec<Node<4>>,
}

impl Motions {
    pub(super) fn push(&mut self, nodes: Range<usize>, motion: &InitialMotion) {
        self.deformation.resize(nodes.end, [0.0; 4]);
        self.bodies.push((nodes, motion.velocity, motion.spin));
    }

    /// Gives the cable added last, with nodes at these material coordinates and this length (m), a velocity of
    /// deformation. Nodes of elements that do not share them stand twice.
    pub(super) fn deform(
        &mut self,
        field: &[String; 2],
        mesh: &[f64],
        length: f64,
    ) -> Result<(), Error> {
        let read = |text: &String| Expression::of(text, "s").map_err(|e| Error::new("bodies", e));
        let [x, y] = [read(&field[0])?, read(&field[1])?];
        let Some((nodes, ..)) = self.bodies.last() else {
            return Ok(());
        };
        let twice = nodes.len() > mesh.len();
        for (i, rate) in self.deformation[nodes.clone()].iter_mut().enumerate() {
            let s = mesh[if twice { i.div_ceil(2) } else { i }];
            let [[vx, sx, _], [vy, sy, _]] = [x.derivatives(s), y.derivatives(s)];
            *rate = [vx, vy, sx / length, sy / length];
        }
        Ok(())
    }

    /// Whether any body moves.
    pub fn is_none(&self) -> bool {
        let rests = |(_, velocity, spin): &(Range<usize>, [f64; 2], f64)| {
            *velocity == [0.0; 2] && *spin == 0.0
        };
        self.bodies.iter().all(rests) && self.deformation.iter().flatten().all(|d| *d == 0.0)
    }

    /// Rates of nodes at these coordinates.
    pub fn rates(&self, x: &[Node<4>]) -> Vec<Node<4>> {
        let mut rates = self.deformation.clone();
        for (nodes, [vx, vy], spin) in &self.bodies {
            let origin = x[nodes.start];
            for (rate, x) in rates[nodes.clone()].iter_mut().zip(&x[nodes.clone()]) {
                let way = [x[0] - origin[0], x[1] - origin[1]];
                rate[0] += vx - spin * way[1];
                rate[1] += vy + spin * way[0];
                rate[2] -= spin * x[3];
                rate[3] += spin * x[2];
            }
        }
        rates
    }
}
