//! Joints of edges and other mesh lines of plates and shells.

use nalgebra::Vector3;

use super::*;
use crate::elements::shell::Corner;
use crate::scene::description::PatchMesh;
use crate::scene::divisions::{Division, MOST_DIVISIONS, OFF, coordinate, line_at, multiples};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{
    BodyReference, Cable, EdgeBase, EdgeHold, MeshLine, Plate, ResolvedEdge,
};
use crate::scene::validate::checks::unknown;
use crate::scene::validate::refuse_point;

/// Holds an edge of a plate or shell and the normal along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClampedEdge {
    /// `ground`, a marker of a body with axes, a rod or beam along the edge (a stiffener), or an edge at the same place; then the
    /// edge: `body.s1=0`, `body.s1=1`, `body.s2=0`, `body.s2=1`, or another line of the mesh, such as `body.s1=0.5`.
    #[serde(rename = "edges")]
    pub markers: [String; 2],
}

/// Holds an edge of a plate or shell, which may rotate about itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PinnedEdge {
    /// `ground`, a marker of a body with axes, a cable, rod or beam along the edge, or an edge at the same place; then the edge:
    /// `body.s1=0`, `body.s1=1`, `body.s2=0`, `body.s2=1`, or another line of the mesh, such as `body.s1=0.5`.
    #[serde(rename = "edges")]
    pub markers: [String; 2],
}

/// Continues a plate or shell beyond an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SmoothEdges {
    /// Two edges at the same place, of different bodies or of one that closes: `body.s1=0`, `body.s1=1`, `body.s2=0` or `body.s2=1`.
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

impl SceneJoint for SmoothEdges {
    fn parts(&self) -> JointParts {
        JointParts::new(Symbol::Weld, [])
    }

    fn edge(&self) -> Option<EdgeHold> {
        Some(EdgeHold::Smooth)
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
    /// A line of the mesh that does not exist; a base without axes; lines that are not at the same place or do not fit; a release; an edge
    /// that is not in its plane of symmetry.
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
        let ([first, second], at) = (kind.markers(), |end: usize| format!("{path}.edges[{end}]"));
        if let Some(time) = release_time {
            let wanted = "nothing: the joint of an edge is not released";
            return Err(expected(&format!("{path}.release_time"), wanted, time));
        }
        let line = self.require_line(&at(1), second, hold)?;
        let base = self.edge_base(&at(0), (first, hold), &line)?;
        if let EdgeHold::Symmetry(normal) = hold {
            check_symmetry(path, &line, normal.into())?;
        }
        let holder = self.hold(path, name);
        self.edges.push(ResolvedEdge {
            name,
            kind: kind.name(),
            holder,
            base,
            line,
            hold,
        });
        Ok(())
    }

    /// Object that holds a line.
    fn edge_base(
        &self,
        path: &str,
        (text, hold): (&'a str, EdgeHold),
        line: &MeshLine<'a>,
    ) -> Found<EdgeBase<'a>> {
        let is_line = text.contains('=');
        match hold {
            EdgeHold::Symmetry(_) if text != GROUND => {
                return Err(expected(path, "\"ground\"", quoted(text)));
            }
            EdgeHold::Smooth if !is_line => {
                let wanted = "an edge of a plate or shell of this scene, `body.s1=0`";
                return Err(expected(path, wanted, quoted(text)));
            }
            _ => {}
        }
        if text == GROUND {
            return Ok(EdgeBase::Ground);
        }
        if is_line {
            let other = self.require_line(path, text, hold)?;
            let is_reversed = meet(path, [&other, line], hold)?;
            return Ok(EdgeBase::Line(other, is_reversed));
        }
        if let Some(BodyReference::Cable(body)) = self.bodies_by_name.get(text) {
            return stiffener(path, *body, line, hold);
        }
        let marker = self.require_marker(path, text)?;
        refuse_point(path, marker)?;
        let is_on_body = !matches!(marker.place, Place::Along(..));
        if !is_on_body || !marker.place.is_framed() {
            let wanted = "\"ground\", an edge, a cable, rod or beam along it, or a marker of a rigid body with inertia, a reduced body, a plate or a shell";
            return Err(expected(path, wanted, quoted(text)));
        }
        Ok(EdgeBase::Marker(marker))
    }

    /// Checks the nodes of stiffeners, which depend on all that acts on them.
    ///
    /// # Errors
    /// A winch that pays out a stiffener; nodes or slopes that are not those of its mesh line.
    pub(in crate::scene) fn check_stiffeners(&self) -> Result<(), Error> {
        let divisions = self.scene.divisions();
        for edge in &self.edges {
            let EdgeBase::Stiffener(body, is_reversed) = edge.base else {
                continue;
            };
            let path = format!("{}.edges[0]", self.holders[edge.holder.index()].path);
            if self.is_paid_out(body) {
                let wanted = "a body that no winch pays out";
                return Err(expected(&path, wanted, quoted(&body.body.name)));
            }
            let count = self.stiffener_elements(&path, body, (&edge.line, &divisions))?;
            let nodes = self.nodes_of(body, count)?;
            lie_on(&path, (body, &nodes), &edge.line, is_reversed)?;
        }
        Ok(())
    }

    /// Elements of a stiffener: a number that is left to the planner becomes that of the line.
    fn stiffener_elements(
        &self,
        path: &str,
        body: Cable<'_>,
        (line, divisions): (&MeshLine<'_>, &[Division]),
    ) -> Found<u32> {
        if let Some(count) = body.body.elements {
            return Ok(count);
        }
        let direction = (line.plate.id.index(), 1 - line.across);
        let mut open = divisions.iter().filter(|of| of.is_open);
        if !open.any(|of| of.directions.contains(&direction)) {
            return Ok(line.elements());
        }
        self.evenly(&[body], line.elements()).ok_or_else(|| {
            let wanted = format!(
                "a body whose markers and loads are at nodes of up to {MOST_DIVISIONS} elements of equal lengths"
            );
            expected(path, &wanted, quoted(&body.body.name))
        })
    }

    /// First multiple of a number of elements of which those of equal lengths have nodes where these bodies need them.
    pub fn evenly(&self, bodies: &[Cable<'_>], count: u32) -> Option<u32> {
        let places: Vec<f64> = { bodies.iter() }
            .flat_map(|body| self.loaded_coordinates(*body))
            .collect();
        let has_nodes = |count: &u32| places.iter().all(|at| line_at(*at, *count).is_some());
        multiples(count).find(has_nodes)
    }

    /// Finds a line of the mesh of a plate or shell.
    fn require_line(&self, path: &str, text: &str, hold: EdgeHold) -> Found<MeshLine<'a>> {
        let (body, place) = text.split_once('.').unwrap_or((text, ""));
        let Some(BodyReference::Plate(plate)) = self.bodies_by_name.get(body) else {
            let known = self.bodies.iter().filter_map(|of| match of {
                BodyReference::Plate(plate) => Some(plate.body.name.as_str()),
                _ => None,
            });
            let wanted = "an edge of a plate or shell of this scene, `body.s1=0`";
            return Err(unknown(path, wanted, body, known));
        };
        let needs_edge = matches!(hold, EdgeHold::Symmetry(_) | EdgeHold::Smooth);
        let found = MeshLine::of(*plate, place);
        found
            .filter(|line| line.is_edge() || !needs_edge)
            .ok_or_else(|| {
                let PatchMesh {
                    counts: [n, m],
                    is_open,
                } = plate.body.mesh;
                let wanted = if needs_edge {
                    "an edge (s1=0, s1=1, s2=0, s2=1)".to_owned()
                } else if is_open.contains(&true) && may_have(place, is_open).is_none() {
                    format!(
                        "an edge (s1=0, s1=1, s2=0, s2=1) or a line that up to {MOST_DIVISIONS} elements of equal parts of the coordinate may have"
                    )
                } else {
                    format!(
                        "an edge (s1=0, s1=1, s2=0, s2=1) or another line of the mesh of {n} x {m} elements"
                    )
                };
                expected(path, &wanted, quoted(place))
            })
    }
}

/// A number of elements of which a mesh line is at a place such as `s1=0.5`, along a coordinate of which the number is open.
fn may_have(place: &str, is_open: [bool; 2]) -> Option<u32> {
    let (across, value) = coordinate(place)?;
    let mut counts = (1..=MOST_DIVISIONS).filter(|_| is_open[across]);
    counts.find(|count| line_at(value, *count).is_some())
}

/// Checks that two lines are at the same place with the same places of their nodes, and for a smooth continuation that derivatives across
/// them are proportional. Returns whether they run in opposite directions.
fn meet(path: &str, [first, second]: [&MeshLine<'_>; 2], hold: EdgeHold) -> Found<bool> {
    if first.elements() != second.elements() {
        let wanted = format!(
            "a line of {} elements, as many as {} has",
            second.elements(),
            second.place()
        );
        let found = format!("{} of {}", first.place(), first.elements());
        return Err(expected(path, &wanted, found));
    }
    let (ours, theirs) = (second.corners(), first.corners());
    let backwards: Vec<_> = theirs.iter().rev().copied().collect();
    let off = |of: &[[Vector3<f64>; 4]]| {
        let gaps = of.iter().zip(&ours).map(|(a, b)| (a[0] - b[0]).norm());
        gaps.fold(0.0, f64::max)
    };
    let size = second.plate.body.geometry().lengths[1 - second.across];
    let is_reversed = off(&backwards) < off(&theirs);
    let theirs = if is_reversed { backwards } else { theirs };
    let gap = off(&theirs);
    if gap > OFF * size
        || (first.plate.id, first.across, first.line)
            == (second.plate.id, second.across, second.line)
    {
        let wanted = format!("another line at the place of {}", second.place());
        let found = format!("{} (nodes up to {} m off)", first.place(), number(gap));
        return Err(expected(path, &wanted, found));
    }
    let (along, across) = (
        [first, second].map(|line| 2 - line.across),
        [first, second].map(|line| 1 + line.across),
    );
    let ratio =
        |k: [usize; 2]| ours[0][k[1]].dot(&theirs[0][k[0]]) / theirs[0][k[0]].norm_squared();
    let is_off = |k: [usize; 2], ratio: f64, size: [usize; 2]| {
        let mut pairs = theirs.iter().zip(&ours);
        pairs.any(|(a, b)| (b[k[1]] - a[k[0]] * ratio).norm() > OFF * b[size[1]].norm())
    };
    let (p, q) = (ratio(along), ratio(across));
    if is_off(along, p, along) {
        let wanted = format!(
            "a line whose points are at the same parts of the length as those of {}",
            second.place()
        );
        return Err(expected(path, &wanted, first.place()));
    }
    let is_bent = matches!(hold, EdgeHold::Smooth)
        && (is_off(across, q, across) || is_off([3, 3], p * q, across));
    if is_bent {
        let wanted = format!(
            "a surface that {} continues with one ratio of lengths all along the edge (`clamped` keeps the angle between any two surfaces)",
            second.place()
        );
        return Err(expected(path, &wanted, first.place()));
    }
    Ok(is_reversed)
}

/// Checks that a body can be a stiffener of a line. Finds whether both run in opposite directions.
fn stiffener<'a>(
    path: &str,
    of: Cable<'a>,
    line: &MeshLine<'_>,
    hold: EdgeHold,
) -> Found<EdgeBase<'a>> {
    let body = of.body;
    if of.id.chain().is_none() {
        let wanted = "a cable, rod or beam with elements, neither rigid nor reduced to modes";
        return Err(expected(path, wanted, quoted(&body.name)));
    }
    if hold == EdgeHold::Clamped && !body.is_rod() {
        let wanted = "a rod or beam, whose sections rotate with the surface (`pinned` holds an edge on a cable)";
        let found = format!("the cable {}", body.name);
        return Err(expected(path, wanted, found));
    }
    if body.elements.is_some_and(|count| count != line.elements()) {
        let wanted = format!(
            "a body of {} elements, as many as {} has",
            line.elements(),
            line.place()
        );
        let found = format!("{} of {}", body.name, body.elements.unwrap_or_default());
        return Err(expected(path, &wanted, found));
    }
    let ends = [0.0, 1.0].map(|along| {
        let corner: Corner = line.plate.body.geometry().corner(line.at(along));
        (Vector3::from(corner[0]) - Vector3::from(body.shape.point(0.0))).norm()
    });
    Ok(EdgeBase::Stiffener(of, ends[1] < ends[0]))
}

/// Checks that the nodes of a body, at these material coordinates, and its line between them are those of a mesh line.
fn lie_on(
    path: &str,
    (of, nodes): (Cable<'_>, &[f64]),
    line: &MeshLine<'_>,
    is_reversed: bool,
) -> Found<()> {
    let (shape, along) = (&of.body.shape, 1 - line.across);
    let count = nodes.len() as u32 - 1;
    let mut corners = line.corners_of(count);
    if is_reversed {
        corners.reverse();
    }
    let size = line.plate.body.geometry().lengths[along];
    let gaps = corners.iter().zip(nodes);
    let gaps = gaps.map(|(corner, s)| (corner[0] - Vector3::from(shape.point(*s))).norm());
    let gap = gaps.fold(0.0, f64::max);
    let name = &of.body.name;
    if gap > OFF * size {
        let wanted = format!("a body whose nodes are those of {}", line.place());
        let found = format!("{name} (nodes up to {} m off)", number(gap));
        return Err(expected(path, &wanted, found));
    }
    let element = size / f64::from(count) * if is_reversed { -1.0 } else { 1.0 };
    let is_off = (0..nodes.len() - 1).any(|k| {
        let length = (nodes[k + 1] - nodes[k]) * shape.length();
        [k, k + 1].into_iter().any(|end| {
            let slope = Vector3::from(shape.tangent(nodes[end])) * length;
            (slope - corners[end][1 + along] * element).norm() > OFF * length
        })
    });
    if is_off {
        let wanted = format!(
            "a body whose points between its nodes are those of {}",
            line.place()
        );
        return Err(expected(path, &wanted, name));
    }
    Ok(())
}

/// Checks that an edge is in a plane that the surface crosses at a right angle.
fn check_symmetry(path: &str, line: &MeshLine<'_>, normal: Vector3<f64>) -> Found<()> {
    let (normal, corners) = (normal.normalize(), line.corners());
    let lengths = line.plate.body.geometry().lengths;
    let size = lengths.into_iter().fold(0.0, f64::max);
    let (along, across) = (2 - line.across, 1 + line.across);
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

impl<'a> MeshLine<'a> {
    /// The line of a mesh at a place such as `s1=0.5`, if there is one.
    fn of(plate: Plate<'a>, place: &str) -> Option<Self> {
        let (across, value) = coordinate(place)?;
        let line = line_at(value, plate.body.mesh.counts[across])?;
        Some(Self {
            plate,
            across,
            line,
        })
    }

    /// Whether the line is an edge.
    fn is_edge(&self) -> bool {
        self.line == 0 || self.line == self.plate.body.mesh.counts[self.across]
    }

    /// Number of elements along the line.
    pub fn elements(&self) -> u32 {
        self.plate.body.mesh.counts[1 - self.across]
    }

    /// Coordinates `[s1, s2]` of a place along the line in [0, 1].
    pub fn at(&self, along: f64) -> [f64; 2] {
        let held = f64::from(self.line) / f64::from(self.plate.body.mesh.counts[self.across]);
        match self.across {
            0 => [held, along],
            _ => [along, held],
        }
    }

    /// Vectors of the described surface at the nodes of the line, as [`Corner`] has them.
    fn corners(&self) -> Vec<[Vector3<f64>; 4]> {
        self.corners_of(self.elements())
    }

    /// Vectors of the described surface at the nodes of so many elements along the line.
    fn corners_of(&self, count: u32) -> Vec<[Vector3<f64>; 4]> {
        let geometry = self.plate.body.geometry();
        let places = (0..=count).map(|k| self.at(f64::from(k) / f64::from(count)));
        let corners = places.map(|at| geometry.corner(at));
        corners
            .map(|corner: Corner| corner.map(Vector3::from))
            .collect()
    }

    /// Name of the line: `body.s1=0`.
    pub fn place(&self) -> String {
        let at = self.at(0.0)[self.across];
        format!(
            "{}.s{}={}",
            self.plate.body.name,
            self.across + 1,
            number(at)
        )
    }
}

impl ResolvedEdge<'_> {
    /// Name of the object that holds the line.
    pub fn base_name(&self) -> String {
        match &self.base {
            EdgeBase::Ground => GROUND.into(),
            EdgeBase::Marker(marker) => format!("{}.{}", marker.place.body().name(), marker.name),
            EdgeBase::Line(line, _) => line.place(),
            EdgeBase::Stiffener(of, _) => of.body.name.clone(),
        }
    }

    /// Describes what the joint holds.
    pub fn words(&self) -> String {
        match (self.hold, &self.base) {
            (EdgeHold::Clamped, EdgeBase::Line(..)) => {
                "the edge and the angle between both surfaces".into()
            }
            (EdgeHold::Clamped, EdgeBase::Stiffener(..)) => {
                "the line, and the rotation of its sections about it with the surface".into()
            }
            (EdgeHold::Pinned, EdgeBase::Stiffener(..)) => "the line".into(),
            (EdgeHold::Clamped, _) => "the edge and the normal along it".into(),
            (EdgeHold::Pinned, _) => "the edge".into(),
            (EdgeHold::Smooth, _) => "the edge and all derivatives of the surface along it".into(),
            (EdgeHold::Symmetry(normal), _) => {
                let normal = words::vector(3, normal);
                format!("the edge in the plane across {normal}, and the normal in it")
            }
        }
    }
}
