//! How fast a line rotates across itself.

use crate::bodies::LineChain;
use crate::math::space::{Vector, components};
use crate::system::{Evaluation, System};

impl<const D: usize> Evaluation<D> {
    /// Square of the largest angular velocity across the tangent, against space, at the nodes of a line, rad^2/s^2.
    pub fn turning_across(&self, system: &System<D>, chain: &LineChain<D>) -> f64 {
        let rotation = system.rotation;
        let count = chain.elements().len();
        let nodes = (0..=count).map(|k| match k {
            0 => chain.first_node(),
            _ => chain.nodes(k - 1)[1],
        });
        let square = |node: usize| {
            let [slope, rate] = [&self.x, &self.v].map(|of| Vector::<D>::from(of[node][1]));
            let length = slope.norm();
            let t = components(&(slope / length));
            let change = components(&(rate / length));
            let cross = |a: [f64; 3], b: [f64; 3]| {
                [
                    a[1] * b[2] - a[2] * b[1],
                    a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0],
                ]
            };
            let along: f64 = rotation.iter().zip(t).map(|(a, b)| a * b).sum();
            let own = cross(t, change);
            (0..3)
                .map(|k| (own[k] + rotation[k] - along * t[k]).powi(2))
                .sum::<f64>()
        };
        nodes.map(square).fold(0.0, f64::max)
    }
}
