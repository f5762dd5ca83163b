//! Surfaces of reduced bodies as triangles, whole or with fewer points.
//!
//! Source: J. Rossignac, P. Borrel, Multi-resolution 3D approximations for rendering complex scenes, in: Modeling in Computer Graphics (1993)
//! 455-465 (points in a cell of a grid become one).

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use crate::scene::Container;

/// Cosine of the angle between two triangles from which on their edge is drawn.
const CREASE: f64 = 0.8;
/// Part by which cells grow until points are few enough.
const GROWTH: f64 = 1.15;

/// The surface of a reduced body.
#[derive(Clone, Debug)]
pub struct Skin<'a> {
    container: &'a Container,
    /// Indices of its points among those of the file.
    pub points: Vec<usize>,
    /// Triangles by the indices of their corners among `points`.
    pub triangles: Vec<[usize; 3]>,
}

/// A triangle at an edge: its normal, positive where it goes along the edge from the lower to the higher corner.
type Neighbours = Vec<Vector3<f64>>;

impl<'a> Skin<'a> {
    /// The surface with all points of the file that triangles have; none of a file without a surface.
    pub fn whole(container: &'a Container) -> Option<Self> {
        Self::of(container, |point| point)
    }

    /// The surface with so many points at most.
    pub fn thinned(container: &'a Container, most: usize) -> Option<Self> {
        let whole = Self::whole(container)?;
        let corners = |pick: fn(f64, f64) -> f64| {
            let points = whole.points.iter().map(|point| place(container, *point));
            points.reduce(|a, b| a.zip_map(&b, pick))
        };
        let (low, high) = (corners(f64::min)?, corners(f64::max)?);
        let mut cell = (high - low).max() / (most as f64).sqrt();
        let mut skin = whole;
        while skin.points.len() > most && cell > 0.0 {
            let mut first = BTreeMap::new();
            let cell_of = |point: usize| {
                let way = (place(container, point) - low) / cell;
                <[i64; 3]>::from(way.map(|part| part.floor() as i64))
            };
            for point in 0..container.details.points.len() {
                first.entry(cell_of(point)).or_insert(point);
            }
            skin = Self::of(container, |point| first[&cell_of(point)])?;
            cell *= GROWTH;
        }
        Some(skin)
    }

    /// The surface with every point replaced by another one. Triangles without area fall out.
    fn of(container: &'a Container, other: impl Fn(usize) -> usize) -> Option<Self> {
        let mut numbers = BTreeMap::new();
        let (mut points, mut triangles, mut seen) = (Vec::new(), Vec::new(), BTreeSet::new());
        for corners in &container.details.triangles {
            let corners = corners.map(|corner| other(corner as usize));
            let mut sorted = corners;
            sorted.sort_unstable();
            if sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted) {
                continue;
            }
            triangles.push(corners.map(|corner| {
                *numbers.entry(corner).or_insert_with(|| {
                    points.push(corner);
                    points.len() - 1
                })
            }));
        }
        (!triangles.is_empty()).then_some(Self {
            container,
            points,
            triangles,
        })
    }

    /// Place of a point without deformation in the file's axes, m.
    pub fn place(&self, point: usize) -> Vector3<f64> {
        place(self.container, self.points[point])
    }

    /// Displacement of a point by a mode in the file's axes, m.
    pub fn mode(&self, point: usize, mode: usize) -> Vector3<f64> {
        let modes = self.container.model.modes();
        self.container.details.modes[modes * self.points[point] + mode].cast()
    }

    /// Whether the file has stresses at its points.
    pub fn has_stress(&self) -> bool {
        !self.container.details.point_stresses.is_empty()
    }

    /// Stress at a point by the strain of a mode, `xx yy zz xy xz yz` in the file's axes, Pa, where the file has stresses.
    pub fn stress(&self, point: usize, mode: usize) -> [f64; 6] {
        let modes = self.container.model.modes();
        self.container.details.point_stresses[modes * self.points[point] + mode].map(f64::from)
    }

    /// Edges that are drawn, by the indices of their ends: those of one triangle alone, and creases; seen along a direction also those
    /// between a triangle that faces the viewer and one that does not.
    pub fn edges(&self, seen_along: Option<Vector3<f64>>) -> Vec<[usize; 2]> {
        let edges = self.neighbours().into_iter();
        let drawn = edges.filter(|(_, neighbours)| {
            let [a, b] = neighbours[..] else {
                return true;
            };
            // Triangles of one side go along their edge in opposite directions.
            let outline = seen_along.is_some_and(|along| a.dot(&along) * b.dot(&along) > 0.0);
            -a.dot(&b) < CREASE || outline
        });
        drawn.map(|(edge, _)| edge).collect()
    }

    /// Normals of the triangles at every edge. Points at one place are one.
    fn neighbours(&self) -> BTreeMap<[usize; 2], Neighbours> {
        let mut first = BTreeMap::new();
        let same: Vec<usize> = (0..self.points.len())
            .map(|point| {
                let bits = <[f64; 3]>::from(self.place(point)).map(f64::to_bits);
                *first.entry(bits).or_insert(point)
            })
            .collect();
        let mut edges: BTreeMap<_, Neighbours> = BTreeMap::new();
        for corners in &self.triangles {
            let [p, q, r] = corners.map(|corner| self.place(corner));
            let Some(normal) = (q - p).cross(&(r - p)).try_normalize(0.0) else {
                continue;
            };
            for k in 0..3 {
                let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|corner| same[corner]);
                let signed = if a < b { normal } else { -normal };
                edges.entry([a.min(b), a.max(b)]).or_default().push(signed);
            }
        }
        edges
    }
}

/// Place of a point of the file, m.
fn place(container: &Container, point: usize) -> Vector3<f64> {
    container.details.points[point].cast()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of the book with another surface.
    fn with_surface(points: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Container {
        let bytes = include_bytes!("../../docs/book/examples/bodies/strip.safetensors");
        let mut container = Container::from_bytes(bytes).expect("a file of a reduced model");
        let modes = container.model.modes();
        container.details.modes = vec![Vector3::x(); modes * points.len()];
        container.details.points = points.into_iter().map(Vector3::from).collect();
        container.details.triangles = triangles;
        container
    }

    fn bits(corner: u8) -> [f32; 3] {
        [0, 1, 2].map(|k| f32::from(corner >> k & 1))
    }

    /// Of a cube, with points of their own on every side or not, its twelve edges are drawn, and no diagonal.
    #[test]
    fn edges_of_a_cube_are_its_creases() {
        let sides: [[u8; 4]; 6] = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let shared = sides.map(|[a, b, c, d]| [[a, b, c], [a, c, d]].map(|t| t.map(u32::from)));
        let one = with_surface((0..8).map(bits).collect(), shared.concat());
        let apart = sides.iter().flatten().map(|corner| bits(*corner)).collect();
        let own = (0..6).map(|k| [[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]]);
        let other = with_surface(apart, own.flatten().collect());
        for container in [one, other] {
            let skin = Skin::whole(&container).expect("a surface");
            for along in [None, Some(Vector3::new(1.0, 2.0, 3.0))] {
                let edges = skin.edges(along);
                assert_eq!(edges.len(), 12);
                for [a, b] in edges {
                    assert_eq!((skin.place(a) - skin.place(b)).norm(), 1.0);
                }
            }
        }
    }

    /// A roof whose sides meet at a flat angle has an edge there where one side is not seen.
    #[test]
    fn outlines_are_edges_of_what_is_seen() {
        let points = vec![
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.5, 1.0, -0.1],
            [0.5, -1.0, -0.1],
        ];
        let container = with_surface(points, vec![[0, 1, 2], [1, 0, 3]]);
        let skin = Skin::whole(&container).expect("a surface");
        assert_eq!(skin.edges(Some(Vector3::z())).len(), 4);
        assert_eq!(skin.edges(Some(Vector3::y())).len(), 5);
    }

    /// A fine sheet keeps its extent with few points.
    #[test]
    fn surfaces_are_thinned() {
        let side = 60_u32;
        let points = (0..side * side).map(|k| [(k % side) as f32, (k / side) as f32, 0.0]);
        let squares = (0..side - 1).flat_map(|i| (0..side - 1).map(move |k| side * i + k));
        let triangles =
            squares.flat_map(|k| [[k, k + 1, k + side], [k + 1, k + side + 1, k + side]]);
        let container = with_surface(points.collect(), triangles.collect());
        let skin = Skin::thinned(&container, 200).expect("a surface");
        assert!(
            (100..=200).contains(&skin.points.len()),
            "{}",
            skin.points.len()
        );
        assert!(skin.triangles.len() > 150, "{}", skin.triangles.len());
        let far = (0..skin.points.len()).map(|point| skin.place(point).max());
        assert!(far.fold(0.0, f64::max) > 0.9 * f64::from(side - 1));
        let whole = Skin::thinned(&container, 5000).expect("a surface");
        assert_eq!([whole.points.len(), whole.triangles.len()], [3600, 6962]);
        assert!(Skin::whole(&with_surface(vec![[0.0; 3]], Vec::new())).is_none());
    }
}
