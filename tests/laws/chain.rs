//! Random bodies with joints, and the same bodies as dense matrices.

use std::f64::consts::PI;

use flexbody::body::Formulation;
use flexbody::elements::cable::{Cable, Parameters};
use flexbody::elements::{Blocks, Element, Nodal};
use flexbody::system::PlanarBody;
use flexbody::system::joints::{Joint, JointKind};
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::specimen::{decades, noise, strains};

/// Everything a random body is made from.
#[derive(Clone, Debug)]
pub struct Chain {
    pub elements: Vec<Cable<2, 1>>,
    /// Position and slope.
    pub nodes: Vec<[Vector2<f64>; 2]>,
    pub joints: Vec<Joint>,
    /// As many random numbers as anybody needs, in (-1, 1).
    pub noise: Vec<Nodal<2>>,
}

/// How different neighbours may be, in powers of ten.
#[derive(Clone, Copy)]
pub struct Spread {
    pub length: f64,
    pub density: f64,
}

/// Lengths within a factor of three, densities within one of ten.
pub const ORDINARY: Spread = Spread {
    length: 0.5,
    density: 1.0,
};

/// Random bodies of 1 to 12 elements with up to 4 joints.
pub fn chains(spread: Spread) -> impl Strategy<Value = Chain> {
    let element = (
        decades(-spread.length, 0.0),
        decades(-spread.density, 0.0),
        -0.4..0.4,
    );
    let joint = (0..4_usize, 0.0..1.0, -PI..PI);
    let material = (
        decades(1.0, 3.0),
        decades(-1.0, 1.0),
        prop_oneof![Just(0.0), Just(0.05)],
        strains(),
    );
    (
        vec(element, 1..=12),
        vec(joint, 0..=4),
        material,
        vec(noise(), 13),
    )
        .prop_map(|(elements, joints, material, noise)| build(&elements, &joints, material, noise))
}

type Material = (f64, f64, f64, flexbody::elements::Strain);

fn build(
    elements: &[(f64, f64, f64)],
    joints: &[(usize, f64, f64)],
    (axial_stiffness, bending_stiffness, damping_time, strain): Material,
    noise: Vec<Nodal<2>>,
) -> Chain {
    let (mut position, mut heading) = (Vector2::new(0.3, -0.2), 0.5_f64);
    let direction = |heading: f64| Vector2::new(heading.cos(), heading.sin());
    let mut nodes = vec![[position, direction(heading)]];
    let mut cables = Vec::new();
    for (length, line_density, turn) in elements {
        position += direction(heading + 0.5 * turn) * *length;
        heading += turn;
        nodes.push([position, direction(heading)]);
        let parameters = Parameters {
            length: *length,
            axial_stiffness,
            bending_stiffness,
            line_density: *line_density,
            damping_time,
            strain,
        };
        let [a, b] = [nodes[nodes.len() - 2], nodes[nodes.len() - 1]];
        let shape = Nodal::from_columns(&[a[0], a[1], b[0], b[1]]);
        cables.push(Cable::new(parameters, Some(&shape)));
    }
    let joint = |(kind, place, angle): &(usize, f64, f64)| {
        let node = (place * nodes.len() as f64) as usize;
        let kind = match kind {
            0 => JointKind::Revolute,
            1 => JointKind::Weld,
            2 => JointKind::Slider(direction(*angle) * 3.0),
            _ => JointKind::Orientation,
        };
        let slope = nodes[node][1];
        Joint { kind, node, slope }
    };
    Chain {
        joints: joints.iter().map(joint).collect(),
        elements: cables,
        nodes,
        noise,
    }
}

impl Chain {
    /// The body itself.
    pub fn body(&self, formulation: Formulation) -> PlanarBody {
        let constraints: Vec<_> = (self.joints.iter().enumerate())
            .flat_map(|(index, joint)| joint.constraints(index))
            .collect();
        PlanarBody::new(
            self.elements.clone(),
            &self.nodes,
            &constraints,
            formulation,
        )
    }

    /// Number of coordinates of all elements.
    pub fn size(&self) -> usize {
        8 * self.elements.len()
    }

    /// Rows of connectivity and joints over all elements, with the joint that asks for each; a
    /// joint's position comes before anybody's component, as in the elimination.
    pub fn constraints(&self) -> Vec<(Option<usize>, DVector<f64>)> {
        let mut rows = Vec::new();
        for left in 0..self.elements.len() - 1 {
            for component in 0..4 {
                let mut row = DVector::zeros(self.size());
                row[8 * left + 4 + component] = 1.0;
                row[8 * (left + 1) + component] = -1.0;
                rows.push((None, row));
            }
        }
        let across = |v: Vector2<f64>| Vector2::new(-v.y, v.x) / v.norm();
        let mut positions = Vec::new();
        let mut components = Vec::new();
        for (index, joint) in self.joints.iter().enumerate() {
            let element = joint.node.min(self.elements.len() - 1);
            let first = 8 * element + 4 * (joint.node - element);
            let row = |at: usize, v: Vector2<f64>| {
                let mut row = DVector::zeros(self.size());
                row[first + at] = v.x;
                row[first + at + 1] = v.y;
                (Some(index), row)
            };
            if matches!(joint.kind, JointKind::Revolute | JointKind::Weld) {
                positions.push(row(0, Vector2::x()));
                positions.push(row(0, Vector2::y()));
            }
            match joint.kind {
                JointKind::Revolute => {}
                JointKind::Slider(along) => components.push(row(0, across(along))),
                JointKind::Weld | JointKind::Orientation => {
                    components.push(row(2, across(joint.slope)));
                }
            }
        }
        rows.append(&mut positions);
        rows.append(&mut components);
        rows
    }

    /// The rows that do not follow from rows before them.
    pub fn independent(&self) -> Vec<(Option<usize>, DVector<f64>)> {
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let mut kept = Vec::new();
        for (owner, row) in self.constraints() {
            let mut rest = row.clone();
            for _ in 0..2 {
                for unit in &basis {
                    rest -= unit * unit.dot(&rest);
                }
            }
            if rest.norm() > 1e-8 {
                basis.push(rest.normalize());
                kept.push((owner, row));
            }
        }
        kept
    }

    /// Mass of all elements, unassembled.
    pub fn mass(&self) -> DMatrix<f64> {
        let mut mass = DMatrix::zeros(self.size(), self.size());
        for (j, element) in self.elements.iter().enumerate() {
            let m = element.mass();
            for a in 0..4 {
                for b in 0..4 {
                    for axis in 0..2 {
                        mass[(8 * j + 2 * a + axis, 8 * j + 2 * b + axis)] = m[(a, b)];
                    }
                }
            }
        }
        mass
    }

    /// A deformed state that respects the constraints: coordinates from random displacements of a
    /// fraction of the shortest element.
    pub fn coordinates(&self, body: &PlanarBody, fraction: f64) -> Vec<f64> {
        let shortest = self
            .elements
            .iter()
            .map(Element::length)
            .fold(f64::INFINITY, f64::min);
        let displacements: Vec<Nodal<2>> = (0..self.elements.len())
            .map(|j| {
                let (a, b) = (&self.noise[j], &self.noise[j + 1]);
                let positions = shortest * fraction;
                Nodal::from_columns(&[
                    a.column(0) * positions,
                    a.column(1) * fraction,
                    b.column(0) * positions,
                    b.column(1) * fraction,
                ])
            })
            .collect();
        let mut q = vec![0.0; body.coordinates()];
        body.project(&displacements, &mut body.scratch(), &mut q);
        q
    }

    /// Random forces on all elements.
    pub fn forces(&self) -> Vec<Nodal<2>> {
        self.noise[..self.elements.len()].to_vec()
    }
}

/// Numbers of all elements in one vector.
pub fn flat(elements: &[Nodal<2>]) -> DVector<f64> {
    DVector::from_iterator(8 * elements.len(), elements.iter().flatten().copied())
}

/// The matrix `T`, column by column.
pub fn expansion(body: &PlanarBody) -> DMatrix<f64> {
    let (n, mut scratch) = (body.coordinates(), body.scratch());
    let mut t = DMatrix::zeros(8 * body.elements().len(), n);
    for column in 0..n {
        let mut q = vec![0.0; n];
        q[column] = 1.0;
        body.rates(&q, &mut scratch.border, &mut scratch.rate);
        t.set_column(column, &flat(&scratch.rate));
    }
    t
}

/// The transposed matrix as `reduce` applies it, column by column.
pub fn reduction(body: &PlanarBody) -> DMatrix<f64> {
    let (n, mut scratch) = (body.coordinates(), body.scratch());
    let size = 8 * body.elements().len();
    let mut t = DMatrix::zeros(n, size);
    for column in 0..size {
        let mut force = vec![Nodal::<2>::zeros(); body.elements().len()];
        force[column / 8].as_mut_slice()[column % 8] = 1.0;
        let mut q = vec![0.0; n];
        body.reduce(&force, &mut scratch.border, &mut q);
        t.set_column(column, &DVector::from_vec(q));
    }
    t
}

/// A block-diagonal matrix from the blocks of all elements.
pub fn diagonal(blocks: &[Blocks<2>]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(8 * blocks.len(), 8 * blocks.len());
    for (j, blocks) in blocks.iter().enumerate() {
        for (a, row) in blocks.iter().enumerate() {
            for (b, block) in row.iter().enumerate() {
                let corner = (8 * j + 2 * a, 8 * j + 2 * b);
                matrix.view_mut(corner, (2, 2)).copy_from(block);
            }
        }
    }
    matrix
}
