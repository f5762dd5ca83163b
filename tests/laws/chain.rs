//! Random cables with joints at their nodes, and the same bodies as dense matrices over the coordinates
//! of all elements, not yet connected.

use std::f64::consts::PI;

use flexbody::bodies::{Bodies, LineChain, Marker, Node};
use flexbody::elements::cable::{Cable, Inertia, Parameters};
use flexbody::elements::{Blocks, Element, Nodal};
use flexbody::system::joints::{JointEquations, Primitive};
use flexbody::system::loads::AppliedLoad;
use flexbody::system::{Attachment, Parts, State, System, Workspace};
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::laws::specimen::{decades, noise, strains};

/// Kind of a joint to the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    Revolute,
    Weld,
    /// Along a line in this direction.
    Slider(Vector2<f64>),
    Orientation,
}

/// A joint at a node.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    pub hold: Hold,
    pub node: usize,
}

/// Everything a random body is made from.
#[derive(Clone, Debug)]
pub struct Chain {
    pub elements: Vec<Cable<2>>,
    /// Position and slope.
    pub nodes: Vec<[Vector2<f64>; 2]>,
    pub joints: Vec<Held>,
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

type Material = (f64, f64, f64, flexbody::elements::StrainMeasure);

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
            inertia: Inertia::Corrected,
            length: *length,
            axial_stiffness,
            bending_stiffness,
            line_of: flexbody::elements::cable::LineOf::Cable,
            line_density: *line_density,
            axial_damping_time: damping_time,
            bending_damping_time: damping_time,
            strain,
        };
        let [a, b] = [nodes[nodes.len() - 2], nodes[nodes.len() - 1]];
        let shape = Nodal::from_columns(&[a[0], a[1], b[0], b[1]]);
        cables.push(Cable::new(parameters, Some(&shape)));
    }
    let joint = |(kind, place, angle): &(usize, f64, f64)| {
        let node = (place * nodes.len() as f64) as usize;
        let hold = match kind {
            0 => Hold::Revolute,
            1 => Hold::Weld,
            2 => Hold::Slider(direction(*angle)),
            _ => Hold::Orientation,
        };
        Held { hold, node }
    };
    Chain {
        joints: joints.iter().map(joint).collect(),
        elements: cables,
        nodes,
        noise,
    }
}

impl Chain {
    /// The flexible body.
    pub fn flexible(&self) -> LineChain {
        LineChain::new(self.elements.clone(), 0)
    }

    /// The element that a node belongs to, the last for the last two, and which end it is.
    pub fn place(&self, node: usize) -> (usize, usize) {
        let element = node.min(self.elements.len() - 1);
        (element, node - element)
    }

    /// A node as a point of the body.
    pub fn marker(&self, node: usize) -> Marker {
        let (element, end) = self.place(node);
        Marker::inside(0, &self.flexible(), element, end as f64)
    }

    fn joint(&self, held: &Held) -> JointEquations {
        let [position, slope] = self.nodes[held.node];
        let angle = slope.y.atan2(slope.x);
        let holds = match held.hold {
            Hold::Revolute => vec![Primitive::Coincident],
            Hold::Weld => vec![Primitive::Coincident, Primitive::Direction(angle)],
            Hold::Slider(along) => vec![Primitive::Line(along)],
            Hold::Orientation => vec![Primitive::Direction(angle)],
        };
        let second = Attachment::Body(self.marker(held.node));
        JointEquations {
            holds,
            ends: [Attachment::Ground(position), second],
            spring: None,
            turn: None,
            way: None,
            release: None,
        }
    }

    /// Returns the parts of the system.
    pub fn parts(&self) -> Parts {
        let node = |node: &[Vector2<f64>; 2]| node.map(Into::into);
        let nodes: Vec<Node> = self.nodes.iter().map(node).collect();
        let joints = self.joints.iter();
        let ranges = std::iter::once(0..nodes.len()).collect();
        let mut bodies = Bodies::new(nodes, ranges);
        bodies.add_line(self.flexible());
        Parts {
            bodies,
            rigid: Vec::new(),
            joints: joints.map(|held| self.joint(held)).collect(),
            drives: Vec::new(),
            winches: Vec::new(),
            loads: Vec::new(),
            initial_loads: Vec::new(),
            angles: Vec::new(),
            gravity: Vector2::zeros(),
            rotation: [0.0; 3],
            tracks_work: false,
        }
    }

    /// The system, without gravity.
    pub fn system(&self) -> System {
        System::new(self.parts()).expect("a body with mass")
    }

    /// The system under loads.
    pub fn loaded(&self, loads: Vec<AppliedLoad>) -> System {
        let parts = Parts {
            loads,
            ..self.parts()
        };
        System::new(parts).expect("a body with mass")
    }

    /// Number of coordinates of all elements.
    pub fn size(&self) -> usize {
        8 * self.elements.len()
    }

    /// Rows of connectivity and joints over all elements, with the joint that asks for each.
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
        for (index, joint) in self.joints.iter().enumerate() {
            let (element, end) = self.place(joint.node);
            let first = 8 * element + 4 * end;
            let row = |at: usize, v: Vector2<f64>| {
                let mut row = DVector::zeros(self.size());
                row[first + at] = v.x;
                row[first + at + 1] = v.y;
                (Some(index), row)
            };
            if matches!(joint.hold, Hold::Revolute | Hold::Weld) {
                rows.push(row(0, Vector2::x()));
                rows.push(row(0, Vector2::y()));
            }
            match joint.hold {
                Hold::Revolute => {}
                Hold::Slider(along) => rows.push(row(0, across(along))),
                Hold::Weld | Hold::Orientation => {
                    rows.push(row(2, across(self.nodes[joint.node][1])));
                }
            }
        }
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
    pub fn coordinates(&self, system: &System, fraction: f64) -> Vec<f64> {
        let lengths = self.elements.iter().map(Element::length);
        let shortest = lengths.fold(f64::INFINITY, f64::min);
        let displacement = |j: usize| -> Node {
            let noise = &self.noise[j];
            let positions = noise.column(0) * (shortest * fraction);
            let slopes = noise.column(1) * fraction;
            [positions.into(), slopes.into()]
        };
        let displacements: Vec<Node> = (0..self.nodes.len()).map(displacement).collect();
        project(system, &displacements)
    }
}

/// Coordinates whose rates come closest to nodal ones in the mass norm.
pub fn project(system: &System, rates: &[Node]) -> Vec<f64> {
    let mut f = vec![[[0.0; 2]; 2]; rates.len()];
    system.bodies().add_inertia(1.0, rates, &mut f);
    let (mut y, mut q) = scratch(system);
    system.elimination().reduce(&f, &mut y, &mut q);
    q
}

/// Scratch of the elimination and storage of coordinates.
pub fn scratch(system: &System) -> (Vec<f64>, Vec<f64>) {
    let elimination = system.elimination();
    let y = vec![0.0; elimination.scratch()];
    (y, vec![0.0; elimination.coordinates()])
}

/// A state of these coordinates and rates with all that it needs beside.
pub fn state(system: &System, q: &[f64], v: &[f64]) -> (State, Workspace) {
    let mut state = system.blank_state(0.0);
    state.coordinates.copy_from_slice(q);
    state.rates.copy_from_slice(v);
    (state, Workspace::new(system))
}

/// Nodal rates from those of the coordinates.
pub fn expand(system: &System, q: &[f64]) -> Vec<Node> {
    let (mut y, _) = scratch(system);
    let mut x = vec![[[0.0; 2]; 2]; system.bodies().reference.len()];
    system.elimination().expand(q, &mut y, &mut x);
    x
}

/// Numbers of all elements in one vector, from those of the nodes.
pub fn flat(chain: &LineChain, x: &[Node]) -> DVector<f64> {
    let elements = 0..chain.elements().len();
    let numbers = elements.flat_map(|j| chain.nodes(j).map(|node| x[node]));
    DVector::from_vec(numbers.flatten().flatten().collect())
}

/// The matrix `T` over all elements, column by column.
pub fn expansion(system: &System) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..system.coordinates())
        .map(|column| {
            let mut q = vec![0.0; system.coordinates()];
            q[column] = 1.0;
            flat(&system.bodies().lines()[0], &expand(system, &q))
        })
        .collect();
    if columns.is_empty() {
        DMatrix::zeros(8 * system.bodies().lines()[0].elements().len(), 0)
    } else {
        DMatrix::from_columns(&columns)
    }
}

/// The transposed matrix as `reduce` applies it to forces on elements, column by column.
pub fn reduction(system: &System) -> DMatrix<f64> {
    let chain = &system.bodies().lines()[0];
    let size = 8 * chain.elements().len();
    let mut t = DMatrix::zeros(system.coordinates(), size);
    for column in 0..size {
        let mut force = vec![[[0.0; 2]; 2]; system.bodies().reference.len()];
        let node = chain.nodes(column / 8)[column % 8 / 4];
        force[node].as_flattened_mut()[column % 4] = 1.0;
        let (mut y, mut q) = scratch(system);
        system.elimination().reduce(&force, &mut y, &mut q);
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
