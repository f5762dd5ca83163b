//! Motions of bodies at the start.

use std::ops::Range;

use nalgebra::Vector3;

use crate::bodies::{Node, add_node, no_node, rotate_inner};
use crate::math::expression::Expression;
use crate::math::space::{Vector, components, perpendicular, spun, vector};
use crate::scene::description::OVER_SURFACE;
use crate::scene::patch::PatchGeometry;
use crate::scene::{Error, InitialMotion};

/// Nodes of a body.
#[derive(Clone, Debug)]
pub(super) struct BodyNodes {
    pub all: Range<usize>,
    /// Nodes that hold axes only.
    pub axes: Vec<usize>,
    /// From which node on they hold numbers that do not move.
    pub still: usize,
    /// From which node on these are angles of sections in the plane, which rotate.
    pub angles: usize,
    /// Whether axes are those of sections, which rotate with a line that deforms.
    pub are_sections: bool,
}

/// Motion of a body at the start.
#[derive(Clone, Debug)]
struct InitialVelocity<const D: usize> {
    nodes: BodyNodes,
    /// Velocity, m/s, of the point that is so far from the first node along its direction, and along the axes in the second
    /// one where that holds axes, m.
    velocity: Vector<D>,
    arm: [f64; 3],
    /// Angular velocity, rad/s.
    spin: [f64; 3],
}

/// Motions of all bodies at the start.
#[derive(Clone, Debug, Default)]
pub struct Motions<const D: usize = 2> {
    bodies: Vec<InitialVelocity<D>>,
    /// Rates of deformation of all nodes.
    deformation: Vec<Node<D>>,
}

impl<const D: usize> Motions<D> {
    /// Adds a body by its nodes. The velocity is that of the point so far from its first node along the direction there, and along
    /// its axes, m.
    pub(super) fn push(&mut self, nodes: BodyNodes, motion: &InitialMotion, arm: [f64; 3]) {
        self.deformation.resize(nodes.all.end, no_node());
        self.bodies.push(InitialVelocity {
            nodes,
            velocity: vector(motion.velocity.full()),
            arm,
            spin: motion.spin.full(),
        });
    }

    /// Gives the cable added last a velocity of deformation. `mesh` holds the material coordinates of its nodes,
    /// `length` is its length, m. Nodes of elements that do not share them count twice.
    ///
    /// # Errors
    /// An expression that is not valid.
    pub(super) fn deform(
        &mut self,
        field: &[String],
        mesh: &[f64],
        length: f64,
    ) -> Result<(), Error> {
        let read = |text: &String| Expression::of(text, "s").map_err(|e| Error::new("bodies", e));
        let field = field.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let Some(InitialVelocity { nodes, .. }) = self.bodies.last() else {
            return Ok(());
        };
        let points = match nodes.axes.first() {
            Some(_) => nodes.all.start..nodes.all.start + mesh.len(),
            None => nodes.all.clone(),
        };
        let twice = points.len() > mesh.len();
        for (i, rate) in self.deformation[points].iter_mut().enumerate() {
            let s = mesh[if twice { i.div_ceil(2) } else { i }];
            for (k, component) in field.iter().enumerate() {
                let [value, slope, _] = component.derivatives(s);
                (rate[0][k], rate[1][k]) = (value, slope / length);
            }
        }
        Ok(())
    }

    /// Gives the plate or shell added last a velocity of deformation. Its mixed derivatives are in units of the patch, m.
    ///
    /// # Errors
    /// An expression that is not valid.
    pub(super) fn deform_surface(
        &mut self,
        field: &[String],
        geometry: &PatchGeometry<'_>,
        unit: f64,
    ) -> Result<(), Error> {
        let Some(InitialVelocity { nodes, .. }) = self.bodies.last() else {
            return Ok(());
        };
        let [a, b] = geometry.lengths;
        let pairs = self.deformation[nodes.all.clone()].chunks_exact_mut(2);
        for (at, pair) in geometry.places().zip(pairs) {
            for (k, text) in field.iter().enumerate() {
                let rates = Expression::of_two(text, OVER_SURFACE, at);
                let [value, first, second, mixed] = rates.map_err(|e| Error::new("bodies", e))?;
                (pair[0][0][k], pair[0][1][k]) = (value, first / a);
                (pair[1][0][k], pair[1][1][k]) = (second / b, mixed * unit / (a * b));
            }
        }
        Ok(())
    }

    /// Whether any body moves.
    pub fn is_none(&self) -> bool {
        let rests = |body: &InitialVelocity<D>| {
            body.velocity == Vector::<D>::zeros() && body.spin == [0.0; 3]
        };
        self.bodies.iter().all(rests) && self.deformation.iter().all(|d| *d == no_node())
    }

    /// Rates of nodes at these coordinates.
    pub fn rates(&self, x: &[Node<D>]) -> Vec<Node<D>> {
        let mut rates = self.deformation.clone();
        for InitialVelocity {
            nodes:
                BodyNodes {
                    all: nodes,
                    axes,
                    still,
                    angles,
                    are_sections,
                },
            velocity,
            arm,
            spin,
        } in &self.bodies
        {
            let [first, along] = x[nodes.start];
            let mut origin: [f64; D] = std::array::from_fn(|k| first[k] + arm[0] * along[k]);
            if D == 2 {
                let second = perpendicular(Vector::from(along));
                (0..D).for_each(|k| origin[k] += arm[1] * second[k]);
            } else if arm[1..] != [0.0; 2] {
                let [second, third] = x[nodes.start + 1];
                for k in 0..D {
                    origin[k] += arm[1] * second[k] + arm[2] * third[k];
                }
            }
            for node in *angles..nodes.end {
                rotate_inner(&mut rates[node], spin[2]);
            }
            let moved = nodes.start..*still;
            let of_body = rates[moved.clone()].iter_mut().zip(&x[moved.clone()]);
            for (node, (rate, x)) in moved.zip(of_body) {
                if axes.contains(&node) {
                    add_node(rate, 1.0, &x.map(|axis| spun(*spin, axis.into()).into()));
                    continue;
                }
                let way = std::array::from_fn(|k| x[0][k] - origin[k]);
                let moved = velocity + spun(*spin, way.into());
                add_node(rate, 1.0, &[moved.into(), spun(*spin, x[1].into()).into()]);
            }
            // Sections rotate with the line that deforms: they begin without a rate of shear.
            for (line, second) in (nodes.start..).zip(axes) {
                if !are_sections || self.deformation[line] == no_node() {
                    continue;
                }
                let slope = components(&x[line][1].into()).into();
                let turn = turn_of(
                    &slope,
                    &components(&self.deformation[line][1].into()).into(),
                );
                // In the plane a section is one direction.
                let vectors = [(*second, 1), (*second, 0), (*second - 1, 1)];
                for (node, part) in &vectors[..if D == 2 { 1 } else { 3 }] {
                    let by_line = Vector::from(spun(turn, x[*node][*part].into()));
                    for (rate, by_line) in rates[*node][*part].iter_mut().zip(&by_line) {
                        *rate += by_line;
                    }
                }
            }
        }
        rates
    }
}

/// Angular velocity of the direction of a slope, rad/s, at this rate of it, 1/s.
fn turn_of(slope: &Vector3<f64>, rate: &Vector3<f64>) -> [f64; 3] {
    (slope.cross(rate) / slope.norm_squared()).into()
}
