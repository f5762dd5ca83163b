//! Grid of points that a plate or shell is drawn with.

use nalgebra::Vector3;

use crate::scene::description::PatchBody;

/// Most parts of an element, and parts of a body along a coordinate up to which there are more than one.
const PARTS: usize = 4;
const FEW: usize = 24;

/// Points on a plate or shell, some in each element: those along `s2` side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatchGrid {
    /// Numbers of elements.
    mesh: [usize; 2],
    /// Parts of an element.
    parts: [usize; 2],
}

impl PatchBody {
    /// Grid that it is drawn with.
    pub fn grid(&self) -> PatchGrid {
        PatchGrid::new(self.mesh.counts.map(|count| count as usize))
    }
}

impl PatchGrid {
    /// Grid of a mesh.
    pub fn new(mesh: [usize; 2]) -> Self {
        let parts = mesh.map(|count| (FEW / count).clamp(1, PARTS));
        Self { mesh, parts }
    }

    /// Numbers of cells along both coordinates.
    fn cells(&self) -> [usize; 2] {
        [0, 1].map(|k| self.mesh[k] * self.parts[k])
    }

    fn index(&self, i: usize, j: usize) -> usize {
        i * (self.cells()[1] + 1) + j
    }

    /// Points near the middles of the fields of a raster with so many fields along each coordinate, where there are as many cells.
    pub fn raster(&self, fields: usize) -> Vec<usize> {
        let at = self.cells().map(|cells| {
            let fields = fields.min(cells);
            let middle = move |k: usize| ((2 * k + 1) * cells + fields) / (2 * fields);
            (0..fields).map(move |k| middle(k).min(cells))
        });
        let [first, second] = at;
        first
            .flat_map(|i| second.clone().map(move |j| self.index(i, j)))
            .collect()
    }

    /// Unit normals at some of the points, from the positions of all, by differences.
    pub fn normals(&self, points: &[[f64; 3]], of: &[usize]) -> Vec<[f64; 3]> {
        let [n, m] = self.cells();
        let normal = |point: &usize| {
            let (i, j) = (point / (m + 1), point % (m + 1));
            let between = |a: usize, b: usize| Vector3::from(points[b]) - Vector3::from(points[a]);
            let first = between(
                self.index(i.saturating_sub(1), j),
                self.index((i + 1).min(n), j),
            );
            let second = between(
                self.index(i, j.saturating_sub(1)),
                self.index(i, (j + 1).min(m)),
            );
            let normal = first.cross(&second);
            <[f64; 3]>::from(normal.try_normalize(0.0).unwrap_or_default())
        };
        of.iter().map(normal).collect()
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.cells().map(|cells| cells + 1).iter().product()
    }

    /// Coordinates `[s1, s2]` of all points.
    pub fn places(self) -> impl Iterator<Item = [f64; 2]> {
        let [n, m] = self.cells();
        let place = move |i: usize, j: usize| [i as f64 / n as f64, j as f64 / m as f64];
        (0..=n).flat_map(move |i| (0..=m).map(move |j| place(i, j)))
    }

    /// Coordinates of its lines across `s1` and across `s2`, in [0, 1].
    pub fn lines_at(&self) -> [Vec<f64>; 2] {
        let along = |cells: usize| (0..=cells).map(|k| k as f64 / cells as f64).collect();
        self.cells().map(along)
    }

    /// Element of every point, and its place there, in [0, 1].
    pub fn in_elements(self) -> impl Iterator<Item = ([usize; 2], [f64; 2])> {
        let (of, [n, m]) = (self, self.cells());
        let along = move |k: usize, at: usize| {
            let element = (at / of.parts[k]).min(of.mesh[k] - 1);
            let xi = (at - element * of.parts[k]) as f64 / of.parts[k] as f64;
            (element, xi)
        };
        (0..=n).flat_map(move |i| {
            (0..=m).map(move |j| {
                let [(a, p), (b, q)] = [along(0, i), along(1, j)];
                ([a, b], [p, q])
            })
        })
    }

    /// Quadrangles between points, counter-clockwise about the normal.
    pub fn quads(&self) -> Vec<[usize; 4]> {
        let [n, m] = self.cells();
        let cell = |i: usize, j: usize| {
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| self.index(i, j))
        };
        (0..n)
            .flat_map(|i| (0..m).map(move |j| cell(i, j)))
            .collect()
    }

    /// Triangles between points.
    pub fn triangles(&self) -> Vec<[usize; 3]> {
        let quads = self.quads().into_iter();
        quads
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect()
    }

    /// Segments of the lines of the mesh, by the points at their ends.
    pub fn lines(&self) -> Vec<[usize; 2]> {
        let ([n, m], [p, q]) = (self.cells(), self.parts);
        let first = (0..=m)
            .step_by(q)
            .flat_map(|j| (0..n).map(move |i| [self.index(i, j), self.index(i + 1, j)]));
        let second = (0..=n)
            .step_by(p)
            .flat_map(|i| (0..m).map(move |j| [self.index(i, j), self.index(i, j + 1)]));
        first.chain(second).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_points_lines_and_cells() {
        let grid = PatchGrid::new([8, 30]);
        let counts = [grid.count(), grid.quads().len(), grid.triangles().len()];
        assert_eq!(counts, [25 * 31, 24 * 30, 48 * 30]);
        assert_eq!(grid.lines().len(), 31 * 24 + 9 * 30);
        let by_element = grid
            .in_elements()
            .map(|([i, j], [p, q])| [(i as f64 + p) / 8.0, (j as f64 + q) / 30.0]);
        let places: Vec<_> = grid.places().collect();
        let raster: Vec<_> = grid.raster(3).iter().map(|point| places[*point]).collect();
        assert_eq!(raster[0], [4.0 / 24.0, 5.0 / 30.0]);
        assert_eq!((raster.len(), raster[8]), (9, [20.0 / 24.0, 25.0 / 30.0]));
        assert_eq!(PatchGrid::new([30, 2]).raster(5).len(), 25);
        let tilted: Vec<_> = places.iter().map(|[a, b]| [*a, *b, -a]).collect();
        for normal in grid.normals(&tilted, &[0, 40, grid.count() - 1]) {
            let [x, y, z] = normal.map(|part| part * 2.0_f64.sqrt());
            assert!(
                (x - 1.0).abs() + y.abs() + (z - 1.0).abs() < 1e-12,
                "{normal:?}"
            );
        }
        for (a, b) in places.iter().zip(by_element) {
            assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-14);
        }
    }
}
