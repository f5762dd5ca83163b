//! The outline of a section: a polygon with holes that are polygons.
//!
//! Source: C. Steger, On the calculation of arbitrary moments of polygons, Technical Report FGBV-96-05, TU München (1996) (area, centroid and
//! second moments as sums over edges).

use super::mesh::{Point, cross, meet};

/// Loops of a section about its centroid: first the outline counter-clockwise, then the holes clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Corners of each loop, m.
    pub loops: Vec<Vec<Point>>,
    /// Area, m^2.
    pub area: f64,
    /// The centroid in the coordinates that the corners were given in, m.
    pub centroid: Point,
    /// Integrals of `z^2` and of `y^2`, m^4.
    pub second_moments: [f64; 2],
    /// Integral of `y z`, m^4.
    pub product_moment: f64,
}

/// Fault of loops that are no outline; loops are counted from the outline on, edges from the first corner on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutlineFlaw {
    /// A loop has fewer than three corners.
    Few(usize),
    /// Two corners of a loop that follow each other are one, at this place.
    Repeated(usize, usize),
    /// An edge of a loop meets one of another loop or of this one.
    Meeting([(usize, usize); 2]),
    /// A hole is not inside the outline, or is inside another.
    Apart(usize),
}

/// Integrals over the inside of a loop, positive if it is counter-clockwise.
#[derive(Clone, Copy, Default)]
struct Integrals {
    area: f64,
    first: [f64; 2],
    second: [f64; 2],
    product: f64,
}

fn integrals(corners: &[Point]) -> Integrals {
    let mut sum = Integrals::default();
    for (k, [y, z]) in corners.iter().enumerate() {
        let [v, w] = corners[(k + 1) % corners.len()];
        let size = y * w - v * z;
        sum.area += 0.5 * size;
        sum.first[0] += size * (y + v) / 6.0;
        sum.first[1] += size * (z + w) / 6.0;
        sum.second[0] += size * (z * z + z * w + w * w) / 12.0;
        sum.second[1] += size * (y * y + y * v + v * v) / 12.0;
        sum.product += size * (2.0 * (y * z + v * w) + y * w + v * z) / 24.0;
    }
    sum
}

/// Whether a point is inside a loop.
fn is_inside(corners: &[Point], [y, z]: Point) -> bool {
    let mut is_inside = false;
    for (k, a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        let is_across = (a[1] > z) != (b[1] > z);
        if is_across && y < a[0] + (z - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            is_inside = !is_inside;
        }
    }
    is_inside
}

/// Finds what is wrong with the loops of an outline, in any direction.
pub fn flaw(loops: &[Vec<Point>]) -> Option<OutlineFlaw> {
    for (number, corners) in loops.iter().enumerate() {
        if corners.len() < 3 {
            return Some(OutlineFlaw::Few(number));
        }
        let next = |k: usize| corners[(k + 1) % corners.len()];
        if let Some(k) = (0..corners.len()).find(|k| corners[*k] == next(*k)) {
            return Some(OutlineFlaw::Repeated(number, k));
        }
    }
    let edges = loops.iter().enumerate().flat_map(|(number, corners)| {
        let count = corners.len();
        (0..count).map(move |k| ((number, k), [corners[k], corners[(k + 1) % count]]))
    });
    let edges: Vec<_> = edges.collect();
    for (place, (of, edge)) in edges.iter().enumerate() {
        for (other, with) in &edges[place + 1..] {
            let count = loops[of.0].len();
            let are_next =
                |a: &(usize, usize), b: &(usize, usize)| a.0 == b.0 && (a.1 + 1) % count == b.1;
            let is_wrong = if are_next(of, other) {
                turns_back(*edge, with[1])
            } else if are_next(other, of) {
                turns_back(*with, edge[1])
            } else {
                meet(*edge, *with)
            };
            if is_wrong {
                return Some(OutlineFlaw::Meeting([*of, *other]));
            }
        }
    }
    let is_apart = |number: &usize| {
        let corner = loops[*number][0];
        let mut others = loops.iter().enumerate().skip(1);
        !is_inside(&loops[0], corner)
            || others.any(|(other, of)| other != *number && is_inside(of, corner))
    };
    (1..loops.len()).find(is_apart).map(OutlineFlaw::Apart)
}

/// Whether an edge is followed by one to this point that lies on it.
fn turns_back([a, b]: [Point; 2], c: Point) -> bool {
    let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    cross([a, b], c) == 0.0 && forward < 0.0
}

impl Outline {
    /// The section between an outline and its holes, given in any direction about any origin.
    pub fn new(loops: Vec<Vec<Point>>) -> Self {
        let mut loops = loops;
        // Integrals about a corner lose no figures to a far origin.
        let origin = loops.first().and_then(|corners| corners.first());
        let origin = origin.copied().unwrap_or_default();
        let moved = |loops: &mut [Vec<Point>], [y, z]: Point| {
            for corner in loops.iter_mut().flatten() {
                *corner = [corner[0] - y, corner[1] - z];
            }
        };
        moved(&mut loops, origin);
        for (number, corners) in loops.iter_mut().enumerate() {
            if (integrals(corners).area > 0.0) != (number == 0) {
                corners.reverse();
            }
        }
        let sum = |of: &dyn Fn(&Integrals) -> f64, loops: &[Vec<Point>]| -> f64 {
            loops.iter().map(|corners| of(&integrals(corners))).sum()
        };
        let area = sum(&|of| of.area, &loops);
        let centroid = [0, 1].map(|k| sum(&|of| of.first[k], &loops) / area);
        moved(&mut loops, centroid);
        Self {
            area,
            centroid: [0, 1].map(|k| origin[k] + centroid[k]),
            second_moments: [0, 1].map(|k| sum(&|of| of.second[k], &loops)),
            product_moment: sum(&|of| of.product, &loops),
            loops,
        }
    }

    /// Area inside the outline with the holes, m^2.
    pub fn whole_area(&self) -> f64 {
        integrals(&self.loops[0]).area
    }

    /// Areas of the holes, m^2.
    pub fn holes(&self) -> impl Iterator<Item = f64> {
        self.loops[1..].iter().map(|hole| -integrals(hole).area)
    }

    /// Corners where the material reaches around more than a straight angle and stress of torsion is unbounded, beyond this angle, rad: as
    /// numbers of all corners one after the other.
    pub fn reentrant(&self, beyond: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let mut first = 0;
        for corners in &self.loops {
            let count = corners.len();
            for k in 0..count {
                let [a, b, c] = [k + count - 1, k, k + 1].map(|k| corners[k % count]);
                let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
                if -cross([a, b], c).atan2(forward) > beyond {
                    found.push(first + k);
                }
            }
            first += count;
        }
        found
    }

    /// Smallest and largest coordinates, m.
    pub fn bounds(&self) -> [Point; 2] {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in &self.loops[0] {
            for k in 0..2 {
                bounds[0][k] = bounds[0][k].min(corner[k]);
                bounds[1][k] = bounds[1][k].max(corner[k]);
            }
        }
        bounds
    }
}
