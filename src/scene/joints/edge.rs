//! Joints of edges of plates and shells: rows of the nodes there, which are eliminated.

use nalgebra::Vector3;

use super::*;
use crate::scene::marker::GROUND;
use crate::scene::resolved::{BodyReference, EdgeHold, Plate, ResolvedEdge};
use crate::scene::validate::checks::unknown;

/// Part of an edge, relative to its size, by which it may be off a plane of symmetry.
const OFF: f64 = 1e-6;
/// Edges by name.
const EDGES: [&str; 4] = ["s1=0", "s1=1", "s2=0", "s2=1"];

/// Holds an edge of a plate or shell and the normal along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClampedEdge {
    /// `ground`, then the edge, `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
    #[serde(rename = "edges")]
    pub markers: [String; 2],
}

/// Holds an edge of a plate or shell, which may rotate about itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PinnedEdge {
    /// `ground`, then the edge, `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
    #[serde(rename = "edges")]
    pub markers: [String; 2],
}

/// Continues a plate or shell beyond an edge by its mirror image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SymmetryEdge {
    /// `ground`, then the edge, `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
    #[serde(rename = "edges")]
    pub markers: [String; 2],
    /// Normal of the plane of symmetry, of any length. The edge lies in the plane, and the surface crosses it at a right angle.
    pub normal: SceneVector,
}

impl SceneJoint for ClampedEdge {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Weld, [])
    }

    fn edge(&self) -> Option<EdgeHold> {
        Some(EdgeHold::Clamped)
    }
}

impl SceneJoint for PinnedEdge {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Pin, [])
    }

    fn edge(&self) -> Option<EdgeHold> {
        Some(EdgeHold::Pinned)
    }
}

impl SceneJoint for SymmetryEdge {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Slider, [])
    }

    fn edge(&self) -> Option<EdgeHold> {
        Some(EdgeHold::Symmetry(self.normal.full()))
    }

    fn check_dimension(&self, path: &str, dimension: usize) -> Result<(), Error> {
        direction(&format!("{path}.normal"), dimension, &self.normal)
    }
}

impl<'a> Resolved<'a> {
    /// Resolves a joint of an edge.
    ///
    /// # Errors
    /// An edge that does not exist, another first end than the ground, a release, or an edge that is not in its plane of symmetry.
    pub(super) fn resolve_edge(
        &mut self,
        path: &str,
        Joint {
            name,
            kind,
            release_time,
        }: &'a Joint,
        hold: EdgeHold,
    ) -> Found<()> {
        let [first, second] = kind.markers();
        if first != GROUND {
            let wanted = "\"ground\" (edges of two bodies are not joined yet)";
            return Err(expected(&format!("{path}.edges[0]"), wanted, quoted(first)));
        }
        if let Some(time) = release_time {
            let wanted = "nothing: the joint of an edge is not released";
            return Err(expected(&format!("{path}.release_time"), wanted, time));
        }
        let (plate, across, is_last) = self.require_edge(&format!("{path}.edges[1]"), second)?;
        let edge = ResolvedEdge {
            name,
            kind: kind.name(),
            plate,
            across,
            is_last,
            hold,
        };
        if let EdgeHold::Symmetry(normal) = hold {
            check_symmetry(path, &edge, normal.into())?;
        }
        self.edges.push(edge);
        Ok(())
    }

    /// Finds an edge: its body, the coordinate that is the same along it, and whether that is 1.
    fn require_edge(&self, path: &str, text: &str) -> Found<(Plate<'a>, usize, bool)> {
        let (body, edge) = text.split_once('.').unwrap_or((text, ""));
        let Some(BodyReference::Plate(plate)) = self.bodies_by_name.get(body) else {
            let known = self.bodies.iter().filter_map(|of| match of {
                BodyReference::Plate(plate) => Some(plate.body.name.as_str()),
                _ => None,
            });
            let wanted = "an edge of a plate or shell of this scene, `body.s1=0`";
            return Err(unknown(path, wanted, body, known));
        };
        let Some(index) = EDGES.iter().position(|of| *of == edge) else {
            return Err(unknown(path, "an edge", edge, EDGES));
        };
        Ok((*plate, index / 2, index % 2 == 1))
    }
}

/// An edge in a plane that the surface crosses at a right angle.
fn check_symmetry(path: &str, edge: &ResolvedEdge<'_>, normal: Vector3<f64>) -> Found<()> {
    let (normal, geometry) = (normal.normalize(), edge.plate.body.geometry());
    let [first, second] = edge.plate.body.mesh;
    let nodes = [second, first][edge.across];
    let corners: Vec<[Vector3<f64>; 4]> = (0..=nodes)
        .map(|k| edge.at(f64::from(k) / f64::from(nodes)))
        .map(|at| geometry.corner(at).map(Vector3::from))
        .collect();
    let size = geometry.lengths.into_iter().fold(0.0, f64::max);
    let (along, across) = (2 - edge.across, 1 + edge.across);
    for corner in &corners {
        let height = (corner[0] - corners[0][0]).dot(&normal).abs() / size;
        let tilt = corner[along].normalize().dot(&normal).abs();
        let slant = corner[across].normalize().cross(&normal).norm();
        if height.max(tilt).max(slant) > OFF {
            let place = format!("{path}.normal");
            let wanted = "the normal of a plane that the edge lies in and the surface crosses at a right angle";
            let at = corner[0].as_slice();
            return Err(expected(
                &place,
                wanted,
                format!("one that is not at {at:?}"),
            ));
        }
    }
    Ok(())
}

impl ResolvedEdge<'_> {
    /// Coordinates `[s1, s2]` of a place along the edge in [0, 1].
    pub fn at(&self, along: f64) -> [f64; 2] {
        let held = if self.is_last { 1.0 } else { 0.0 };
        match self.across {
            0 => [held, along],
            _ => [along, held],
        }
    }

    /// Name of the edge: `body.s1=0`.
    pub fn place(&self) -> String {
        let index = 2 * self.across + usize::from(self.is_last);
        format!("{}.{}", self.plate.body.name, EDGES[index])
    }

    /// Describes what the joint holds.
    pub fn words(&self) -> String {
        match self.hold {
            EdgeHold::Clamped => "the edge and the normal along it".into(),
            EdgeHold::Pinned => "the edge".into(),
            EdgeHold::Symmetry(normal) => {
                let normal = words::vector(3, normal);
                format!("the edge in the plane across {normal}, and the normal in it")
            }
        }
    }
}
