//! Lines that are reduced to modes.

use nalgebra::{Matrix3, Vector3};

use super::Builder;
use super::reduced::damping_ratios;
use crate::bodies::{Marker, Node, ReducedBody};
use crate::elements::reduced::{Interface, LineModes, LineSection, StraightLine};
use crate::math::quadrature::GAUSS_5;
use crate::scene::resolved::{Cable, Place, Resolved};
use crate::scene::{Error, Inertia, LineBody};

/// Strains of a rod and of a beam: without shear, and with it.
const OF_ROD: &[usize] = &[0, 3, 4, 5];
const OF_BEAM: &[usize] = &[0, 1, 2, 3, 4, 5];
/// Strains of a cable and of a beam in the plane, whose first axis is across it.
const OF_PLANAR_CABLE: &[usize] = &[0, 4];
const OF_PLANAR_BEAM: &[usize] = &[0, 2, 4];

/// A line that is reduced to modes, in the system.
#[derive(Clone, Debug)]
pub struct ModalLine {
    /// Principal axes in the axes of its sections, as columns.
    pub axes: Matrix3<f64>,
    /// Place of the centre of mass from the first end in the axes of its sections, m.
    pub center: Vector3<f64>,
    /// Places along the line from which it is drawn, in principal axes.
    pub nodes: Vec<Interface>,
    /// First nodes in the system of its markers, and the material coordinates of these.
    markers: Vec<(f64, usize)>,
}

impl<const D: usize> Builder<'_, D> {
    /// Adds a line that is reduced to modes. Returns the body in the system and its first end along its principal axes, m.
    ///
    /// # Errors
    /// Modes that cannot be computed, or places that are too close for nodes.
    pub(super) fn modal(&mut self, cable: Cable<'_>) -> Result<(ReducedBody, [f64; 3]), Error> {
        let index = cable.id.body_index();
        let mesh = self.resolved.nodes(cable)?;
        let modes = self.resolved.line_modes(cable, &mesh);
        let made = modes.as_ref().and_then(|modes| {
            let held = self.resolved.held_markers(cable);
            let count = cable.body.modes.unwrap_or_default() as usize;
            let basis = modes.linear().fixed_interface_modes(&held, count)?;
            Some((modes, basis))
        });
        let Some((modes, basis)) = made else {
            let message = "the modes of the line could not be computed: expected stiffness and mass that \
                           differ less along it";
            return Err(Error::new(format!("bodies[{index}].model"), message));
        };
        let time = cable.body.material.damping_time;
        let ratios = damping_ratios(&basis, true, |eigenvalue| 0.5 * time * eigenvalue.sqrt());
        let (model, nodes) = modes.in_basis(&basis);
        let (model, sections) = if D == 2 {
            let [along, left] = planar_line_axes(cable.body.shape.tangent(0.0));
            let sections = Matrix3::from_columns(&[along, -Vector3::z(), left]);
            (model.in_plane(&Matrix3::identity()), sections)
        } else {
            let axis = |k: usize| cable.body.directed(0.0, Vector3::ith(k, 1.0).into()).into();
            (model, Matrix3::from_columns(&[axis(0), axis(1), axis(2)]))
        };
        let center = Vector3::from(cable.body.shape.point(0.0)) + sections * modes.center;
        let axes = sections * modes.axes;
        let body = self.modal_body((model, ratios), center.into(), &axes);
        let markers = cable.body.markers.values().enumerate();
        let line = ModalLine {
            axes: modes.axes,
            center: modes.center,
            nodes,
            markers: markers.map(|(at, s)| (*s, body.interface(at))).collect(),
        };
        let arm = line.axes.tr_mul(&-line.center);
        self.lines.insert(index, line);
        Ok((body, arm.into()))
    }

    /// A marker of a line that is reduced to modes, with the tangent as direction.
    pub(super) fn on_modes(&self, cable: Cable<'_>, s: f64) -> Marker {
        let index = cable.id.body_index();
        let line = &self.lines[&index];
        let (_, node) = (line.markers.iter().copied())
            .min_by(|(a, _), (b, _)| (a - s).abs().total_cmp(&(b - s).abs()))
            .unwrap_or_else(|| unreachable!("what is on a line of modes is one of its markers"));
        Marker::framed(index, node, [0.0; 3], line.directed([1.0, 0.0, 0.0]))
    }
}

impl ModalLine {
    /// Places of its nodes, m, and axes of the sections there, for its body in the system.
    pub fn sections<const D: usize>(
        &self,
        body: &ReducedBody,
        x: &[Node<D>],
    ) -> Vec<([f64; 3], [[f64; 3]; 3])> {
        let axes = std::array::from_fn(|k| self.axes.row(k).transpose());
        self.nodes
            .iter()
            .map(|node| body.directed(node, &axes, x))
            .collect()
    }

    /// Largest distance of a node from where it is without deformation, against the axes of the body, m.
    pub fn deflection<const D: usize>(&self, body: &ReducedBody, x: &[Node<D>]) -> f64 {
        let eta = body.amplitudes(x);
        let moved = |node: &Interface| (node.deformed(eta) - node.position).norm();
        self.nodes.iter().map(moved).fold(0.0, f64::max)
    }

    /// A direction in the axes of its sections along its principal axes.
    pub fn directed(&self, direction: [f64; 3]) -> [f64; 3] {
        self.axes.tr_mul(&Vector3::from(direction)).into()
    }
}

impl Resolved<'_> {
    /// Indices of the markers of a line that something acts on, in alphabetical order.
    fn held_markers(&self, cable: Cable<'_>) -> Vec<usize> {
        let markers: Vec<f64> = cable.body.markers.values().copied().collect();
        self.interfaces_acted_on(&|place| match place {
            Place::Along(of, s) if of.id == cable.id => {
                markers.iter().position(|marker| *marker == s)
            }
            _ => None,
        })
    }

    /// All modes of a line with nodes at these material coordinates.
    fn line_modes(&self, cable: Cable<'_>, mesh: &[f64]) -> Option<LineModes> {
        let (body, length) = (cable.body, cable.body.shape.length());
        let node = |s: f64| {
            let far = |at: usize| (mesh[at] - s).abs();
            (0..mesh.len()).min_by(|a, b| far(*a).total_cmp(&far(*b)))
        };
        let markers = body.markers.iter();
        let line = StraightLine {
            ends: mesh.iter().map(|s| s * length).collect(),
            sections: mesh.windows(2).map(|ends| sections(body, ends)).collect(),
            strains: match (self.scene.dimension, body.is_beam()) {
                (2, false) => OF_PLANAR_CABLE,
                (2, true) => OF_PLANAR_BEAM,
                (_, false) => OF_ROD,
                (_, true) => OF_BEAM,
            },
            markers: markers
                .map(|(name, s)| (name.clone(), node(*s).unwrap_or_default()))
                .collect(),
        };
        LineModes::new(line, |rows| {
            if self.scene.dimension == 2 {
                // Axes along the line, to its left, and across the plane.
                let axes = Matrix3::from_columns(&[Vector3::x(), Vector3::z(), -Vector3::y()]);
                return ([rows[1][1]; 3], axes);
            }
            Inertia::Tensor(rows).principal()
        })
    }
}

/// Unit vectors along a line in the plane, and to its left.
fn planar_line_axes(tangent: [f64; 3]) -> [Vector3<f64>; 2] {
    let along = Vector3::from(tangent).normalize();
    [along, Vector3::z().cross(&along)]
}

/// Sections at the points of a segment.
fn sections(body: &LineBody, ends: &[f64]) -> [LineSection; GAUSS_5.len()] {
    let numbers = body.sections_about(0.5 * (ends[0] + ends[1]));
    GAUSS_5.map(|point| {
        let section = numbers(ends[0] + point.at * (ends[1] - ends[0])).0;
        let mut rotary = body.rotary_inertia_of(&section);
        if !body.is_rod() {
            rotary = Matrix3::zeros();
        } else if !body.is_beam() {
            // Sections of rods have inertia about the line alone.
            let about_line = rotary[(0, 0)];
            rotary = Matrix3::zeros();
            rotary[(0, 0)] = about_line;
        }
        LineSection {
            density: body.line_density_of(&section),
            rotary,
            stiffness: body.whole_stiffness(&section),
        }
    })
}
