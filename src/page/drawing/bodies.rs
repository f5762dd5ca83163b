//! Bodies, their markers and masses.

use super::picture::{Picture, seen};
use crate::page::canvas::Point;
use crate::picture::palette::{BODY, INK, INSIDE};
use crate::picture::{Skin, Style};
use crate::scene::{BodyReference, Cable, FileBody, LineBody, PatchBody, RigidBody};

/// Parts of the polyline that stands for a cable, or for an edge that is held.
const PARTS: u32 = 96;
/// Most points of the surface of a reduced body.
const SURFACE_POINTS: usize = 300;
/// Direction from the viewer of space, and back.
const SEEN_ALONG: [f64; 3] = [1.0, -1.0, 1.0];
/// With more elements than this, nodes would only blacken the line.
const MOST_NODES: u32 = 64;

/// Points along a cable, of a rigid one its ends; corners of a rigid body, m.
pub(super) fn outline(body: BodyReference<'_>, dimension: usize) -> Vec<[f64; 3]> {
    match body {
        BodyReference::Cable(cable) if cable.is_rigid() => {
            [0.0, 1.0].map(|s| cable.body.shape.point(s)).into()
        }
        BodyReference::Cable(cable) => cable_outline(cable.body),
        BodyReference::Rigid(rigid) => rigid_outline(rigid.body, dimension),
        BodyReference::Reduced(reduced) => match skin(reduced.body) {
            Some(skin) => (0..skin.points.len())
                .map(|point| reduced.body.point(skin.place(point).into()))
                .collect(),
            None => star(reduced.body),
        },
        BodyReference::Plate(plate) => {
            let geometry = plate.body.geometry();
            let places = plate.body.grid().places();
            places.map(|at| geometry.corner(at)[0]).collect()
        }
    }
}

fn cable_outline(cable: &LineBody) -> Vec<[f64; 3]> {
    (0..=PARTS)
        .map(|part| cable.shape.point(f64::from(part) / f64::from(PARTS)))
        .collect()
}

/// Corners, as it is seen, of a rigid body's shape; where it has none, around its markers and its centre, m.
pub(super) fn rigid_outline(rigid: &RigidBody, dimension: usize) -> Vec<[f64; 3]> {
    let points = rigid.extent().into_iter();
    hull(dimension, points.map(|point| rigid.point(point)).collect())
}

/// The surface of a reduced body, if its file has one.
fn skin(reduced: &FileBody) -> Option<Skin<'_>> {
    Skin::thinned(reduced.contained(), SURFACE_POINTS)
}

/// Interfaces of a reduced body, which stand for it as a star around its centre, m.
pub(super) fn star(reduced: &FileBody) -> Vec<[f64; 3]> {
    let interfaces = 0..reduced.contained().model.interfaces.len();
    interfaces.map(|index| reduced.place(index)).collect()
}

/// Corners of the smallest convex polygon around points in the plane, or in the image of space, counter-clockwise; the two
/// ends where all lie on a line.
///
/// Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
fn hull(dimension: usize, mut points: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let at = |point: &[f64; 3]| seen(dimension, *point);
    points.sort_by(|a, b| {
        let [a, b] = [at(a), at(b)];
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = &[f64; 3]>| {
        let mut corners: Vec<[f64; 3]> = Vec::new();
        for point in points {
            while let [.., a, b] = corners[..] {
                let [a, b, point] = [at(&a), at(&b), at(point)];
                let left = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
                if left > 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(*point);
        }
        corners.pop();
        corners
    };
    let mut corners = half(&mut points.iter());
    corners.extend(half(&mut points.iter().rev()));
    corners
}

impl Picture<'_> {
    pub(super) fn body(&mut self, body: BodyReference<'_>) {
        let corners = outline(body, self.scene.dimension);
        let points: Vec<Point> = corners.iter().map(|point| self.at(*point)).collect();
        match body {
            BodyReference::Cable(cable) if cable.is_rigid() => {
                self.rigid(cable.body.shape.point(0.5), &points);
            }
            BodyReference::Cable(cable) => self.cable(cable, &points),
            BodyReference::Rigid(rigid) => self.rigid(rigid.body.position.full(), &points),
            BodyReference::Reduced(reduced) => match skin(reduced.body) {
                Some(skin) => self.skin(reduced.body, &skin, &points),
                None => self.reduced(reduced.body.center(), &points),
            },
            BodyReference::Plate(plate) => self.sheet(plate.body, &points),
        }
    }

    fn cable(&mut self, cable: Cable<'_>, points: &[Point]) {
        let body = cable.body;
        let style = Style::line(BODY, 0.42 * self.unit);
        self.canvas.polyline(points, style);
        if !self.names || body.elements > Some(MOST_NODES) {
            return;
        }
        let node = Style {
            stroke: BODY,
            width: 0.8,
            fill: INSIDE,
        };
        // A mesh that is too coarse is drawn without nodes, and refused when it is built.
        for along in self.resolved.nodes(cable).into_iter().flatten() {
            let centre = self.at(body.shape.point(along));
            self.canvas.circle(centre, 0.26 * self.unit, node);
        }
    }

    fn rigid(&mut self, centre: [f64; 3], points: &[Point]) {
        let style = Style {
            stroke: BODY,
            width: 0.28 * self.unit,
            fill: INSIDE,
        };
        let centre = self.at(centre);
        if points.len() > 1 {
            self.canvas.polyline(points, style);
            self.canvas.circle(centre, 0.34 * self.unit, style);
        } else {
            self.canvas.circle(centre, 0.8 * self.unit, style);
        }
    }

    /// Triangles of the surface of a reduced body, and its outline and creases.
    fn skin(&mut self, reduced: &FileBody, skin: &Skin<'_>, points: &[Point]) {
        let inside = Style {
            stroke: "none",
            width: 0.0,
            fill: INSIDE,
        };
        let triangles = skin.triangles.iter();
        let triangles: Vec<[Point; 3]> = triangles
            .map(|corners| corners.map(|corner| points[corner]))
            .collect();
        self.canvas.triangles(&triangles, inside);
        let along = reduced.axes().tr_mul(&SEEN_ALONG.into());
        let edges = skin.edges(Some(along)).into_iter();
        let edges: Vec<[Point; 2]> = edges.map(|ends| ends.map(|end| points[end])).collect();
        let width = 0.14 * self.unit;
        self.canvas.segments(&edges, Style::line(BODY, width));
    }

    /// Triangles of a plate or shell, and the lines of its mesh, or of a fine one its edges.
    fn sheet(&mut self, body: &PatchBody, points: &[Point]) {
        let grid = body.grid();
        let inside = Style {
            stroke: "none",
            width: 0.0,
            fill: INSIDE,
        };
        let triangles = grid.triangles().into_iter();
        let triangles: Vec<[Point; 3]> = triangles
            .map(|corners| corners.map(|corner| points[corner]))
            .collect();
        self.canvas.triangles(&triangles, inside);
        let lines = grid.lines().into_iter();
        let lines: Vec<[Point; 2]> = lines.map(|ends| ends.map(|end| points[end])).collect();
        let width = 0.14 * self.unit;
        self.canvas.segments(&lines, Style::line(BODY, width));
    }

    /// Lines from the centre to the interfaces.
    fn reduced(&mut self, centre: [f64; 3], points: &[Point]) {
        let style = Style {
            stroke: BODY,
            width: 0.28 * self.unit,
            fill: INSIDE,
        };
        let centre = self.at(centre);
        for point in points {
            self.canvas.polyline(&[centre, *point], style);
        }
        self.canvas.circle(centre, 0.34 * self.unit, style);
    }

    /// Edges that joints hold, masses, then markers.
    pub(super) fn marks(&mut self) {
        for edge in &self.resolved.edges {
            let geometry = edge.line.plate.body.geometry();
            let places = (0..=PARTS).map(|part| f64::from(part) / f64::from(PARTS));
            let places = places.map(|along| geometry.corner(edge.line.at(along))[0]);
            let points: Vec<Point> = places.map(|place| self.at(place)).collect();
            self.canvas
                .polyline(&points, Style::line(INK, 0.42 * self.unit));
        }
        for of in &self.resolved.masses {
            let centre = self.at(of.marker.position);
            self.canvas
                .circle(centre, 0.7 * self.unit, Style::solid(BODY));
        }
        for marker in &self.resolved.markers {
            let centre = self.at(marker.position);
            self.canvas
                .circle(centre, 0.3 * self.unit, Style::solid(INK));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::hull;

    #[test]
    fn a_hull_keeps_corners_and_ends() {
        let found = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let flat = hull(2, points.iter().map(|[x, y]| [*x, *y, 0.0]).collect());
            flat.iter().map(|[x, y, _]| [*x, *y]).collect()
        };
        let square = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 1.0]];
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(found(&square), corners);
        let line = [[2.0, 2.0], [0.0, 0.0], [1.0, 1.0]];
        assert_eq!(found(&line), [[0.0, 0.0], [2.0, 2.0]]);
        assert_eq!(found(&[[1.0, 2.0]; 3]), [[1.0, 2.0]]);
    }
}
