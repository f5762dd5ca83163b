//! Triangles over a section: the coarsest ones are clipped from its outline, and points are added where finer ones are wanted.
//! Every mesh is a constrained Delaunay triangulation.
//!
//! Source: G. H. Meisters, Polygons have ears, Amer. Math. Monthly 82 (1975) 648-651 (the first triangles); C. L. Lawson, Software for C1 surface
//! interpolation, in Mathematical Software III (1977) 161-194 (flips of edges); J. Ruppert, A Delaunay refinement algorithm for quality
//! 2-dimensional mesh generation, J. Algorithms 18 (1995) 548-585 (where points are put).

use std::collections::BTreeMap;

/// A point in the axes of the section, m.
pub type Point = [f64; 2];

/// Sine of the smallest angle that triangles have where the outline permits it (20 degrees).
const SLENDER: f64 = 0.342;
/// Smallest part by which the sum of opposite angles passes a straight one where an edge is flipped, as a sine.
const FLAT: f64 = 1e-9;

/// A triangle, counter-clockwise. Edge `k` goes from corner `k` to the next.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Numbers of its points.
    pub corners: [usize; 3],
    /// Numbers of the triangles beyond its edges; none beyond the outline.
    pub beyond: [Option<usize>; 3],
}

/// Triangulation of a section.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// All points.
    pub points: Vec<Point>,
    /// Number of the loop of the outline that each point is on.
    pub loops: Vec<Option<usize>>,
    /// All triangles.
    pub triangles: Vec<Triangle>,
}

/// Returns twice the area of the triangle of three points, positive if counter-clockwise.
pub fn cross([a, b]: [Point; 2], c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns the distance of two points.
pub fn distance(a: Point, b: Point) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Whether two closed segments have a point in common.
pub fn meet(a: [Point; 2], b: [Point; 2]) -> bool {
    let sides = [
        cross(a, b[0]),
        cross(a, b[1]),
        cross(b, a[0]),
        cross(b, a[1]),
    ];
    let is_within = |of: [Point; 2], p: Point| {
        (0..2).all(|k| of[0][k].min(of[1][k]) <= p[k] && p[k] <= of[0][k].max(of[1][k]))
    };
    (sides[0] * sides[1] < 0.0 && sides[2] * sides[3] < 0.0)
        || (sides[0] == 0.0 && is_within(a, b[0]))
        || (sides[1] == 0.0 && is_within(a, b[1]))
        || (sides[2] == 0.0 && is_within(b, a[0]))
        || (sides[3] == 0.0 && is_within(b, a[1]))
}

impl Mesh {
    /// Triangulates the area inside the first loop, which is counter-clockwise, and outside all others, which are clockwise. `None` where loops
    /// meet each other or themselves.
    pub fn new(loops: &[Vec<Point>]) -> Option<Self> {
        let numbered = loops.iter().enumerate();
        let of_loops =
            numbered.flat_map(|(number, points)| points.iter().map(move |_| Some(number)));
        let mut mesh = Self {
            points: loops.concat(),
            loops: of_loops.collect(),
            triangles: Vec::new(),
        };
        let mut first = 0;
        let mut rings = loops.iter().map(|points| {
            first += points.len();
            (first - points.len()..first).collect::<Vec<usize>>()
        });
        let mut ring = rings.next()?;
        let mut holes: Vec<Vec<usize>> = rings.collect();
        while !holes.is_empty() {
            let (hole, at, from) = mesh.bridge(&ring, &holes)?;
            let mut hole = holes.swap_remove(hole);
            hole.rotate_left(from);
            let there_and_back = [hole[0], ring[at]];
            ring.splice(at + 1..at + 1, hole.into_iter().chain(there_and_back));
        }
        mesh.clip(ring)?;
        mesh.find_neighbours();
        let all = (0..mesh.triangles.len()).flat_map(|t| [(t, 0), (t, 1), (t, 2)]);
        mesh.flip(all.collect());
        Some(mesh)
    }

    /// Finds the shortest way from the ring to a hole along which nothing lies: number of the hole, place in the ring and place in the hole.
    fn bridge(&self, ring: &[usize], holes: &[Vec<usize>]) -> Option<(usize, usize, usize)> {
        let mut ways = Vec::new();
        for (number, hole) in holes.iter().enumerate() {
            for (from, p) in hole.iter().enumerate() {
                for (at, q) in ring.iter().enumerate() {
                    let length = distance(self.points[*p], self.points[*q]);
                    ways.push((length, number, at, from));
                }
            }
        }
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_free = |&(_, number, at, from): &(f64, usize, usize, usize)| {
            let ends = [ring[at], holes[number][from]];
            let way = ends.map(|p| self.points[p]);
            let is_clear = |line: &[usize]| {
                (0..line.len()).all(|k| {
                    let edge = [line[k], line[(k + 1) % line.len()]];
                    let is_at_end = edge.iter().any(|p| ends.contains(p));
                    is_at_end || !meet(way, edge.map(|p| self.points[p]))
                })
            };
            self.opens(ring, at, way[1])
                && self.opens(&holes[number], from, way[0])
                && is_clear(ring)
                && holes.iter().all(|hole| is_clear(hole))
        };
        let found = ways.into_iter().find(is_free)?;
        Some((found.1, found.2, found.3))
    }

    /// Whether the way from a place of a ring to a point begins inside the section.
    fn opens(&self, ring: &[usize], at: usize, to: Point) -> bool {
        let count = ring.len();
        let [before, here, after] =
            [at + count - 1, at, at + 1].map(|k| self.points[ring[k % count]]);
        let (left, right) = (
            cross([here, after], to) > 0.0,
            cross([before, here], to) > 0.0,
        );
        if cross([before, here], after) > 0.0 {
            left && right
        } else {
            left || right
        }
    }

    /// Clips ears from a ring until nothing is left.
    fn clip(&mut self, mut ring: Vec<usize>) -> Option<()> {
        let area = |mesh: &Self, ring: &[usize], at: usize| {
            let count = ring.len();
            let [a, b, c] = [at + count - 1, at, at + 1].map(|k| mesh.points[ring[k % count]]);
            let size = distance(a, b) * distance(b, c);
            (cross([a, b], c) / size, [a, b, c])
        };
        let mut next = 0;
        while ring.len() > 3 {
            let count = ring.len();
            // Points on the edge of an ear or roundoff beside it block it, unless there is no other one. Where ways to holes begin, two places of the ring are one point:
            // the edge of the ear must begin inside at the right ones.
            let is_ear = |at: usize, depth: f64| {
                let (sine, [a, b, c]) = area(self, &ring, at);
                let least = depth * cross([a, b], c);
                let is_blocked = |k: usize| {
                    let p = self.points[ring[k]];
                    let mut edges = [[a, b], [b, c], [c, a]].into_iter();
                    edges.all(|edge| cross(edge, p) >= least)
                        && ![a, b, c].contains(&p)
                        && area(self, &ring, k).0 <= FLAT
                };
                let is_inside =
                    self.opens(&ring, at + count - 1, c) && self.opens(&ring, at + 1, a);
                sine > FLAT && (is_inside || depth > 0.0) && !(0..count).any(is_blocked)
            };
            let places = || (0..count).map(|k| (next + k) % count);
            let mut depths = [-FLAT, 0.0, FLAT].into_iter();
            let at = depths.find_map(|depth| places().find(|at| is_ear(*at, depth)))?;
            let corners = [at + count - 1, at, at + 1].map(|k| ring[k % count]);
            self.add(corners);
            ring.remove(at);
            // Going around leaves no fan of slender triangles.
            next = at + 1;
        }
        self.add([ring[0], ring[1], ring[2]]);
        Some(())
    }

    fn add(&mut self, corners: [usize; 3]) {
        self.triangles.push(Triangle {
            corners,
            beyond: [None; 3],
        });
    }

    fn find_neighbours(&mut self) {
        let mut edges = BTreeMap::new();
        for (t, triangle) in self.triangles.iter().enumerate() {
            for k in 0..3 {
                edges.insert([triangle.corners[k], triangle.corners[(k + 1) % 3]], t);
            }
        }
        for triangle in &mut self.triangles {
            triangle.beyond = std::array::from_fn(|k| {
                let [from, to] = [triangle.corners[k], triangle.corners[(k + 1) % 3]];
                edges.get(&[to, from]).copied()
            });
        }
    }

    /// Flips edges until those on the list and all that this changes are Delaunay.
    fn flip(&mut self, mut edges: Vec<(usize, usize)>) {
        while let Some((t, k)) = edges.pop() {
            let Some(u) = self.triangles[t].beyond[k] else {
                continue;
            };
            let j = self.edge_to(u, t);
            let [a, b, c] = [k, k + 1, k + 2].map(|k| self.triangles[t].corners[k % 3]);
            let d = self.triangles[u].corners[(j + 2) % 3];
            let [pa, pb, pc, pd] = [a, b, c, d].map(|p| self.points[p]);
            let angle = |at: Point| {
                let (p, q) = (
                    [pa[0] - at[0], pa[1] - at[1]],
                    [pb[0] - at[0], pb[1] - at[1]],
                );
                let size = p[0].hypot(p[1]) * q[0].hypot(q[1]);
                let cosine = (p[0] * q[0] + p[1] * q[1]) / size;
                (cosine, (p[0] * q[1] - p[1] * q[0]).abs() / size)
            };
            let ((cos_c, sin_c), (cos_d, sin_d)) = (angle(pc), angle(pd));
            if cos_c * sin_d + sin_c * cos_d >= -FLAT {
                continue;
            }
            let (of_t, of_u) = (self.triangles[t].beyond, self.triangles[u].beyond);
            self.triangles[t] = Triangle {
                corners: [c, a, d],
                beyond: [of_t[(k + 2) % 3], of_u[(j + 1) % 3], Some(u)],
            };
            self.triangles[u] = Triangle {
                corners: [d, b, c],
                beyond: [of_u[(j + 2) % 3], of_t[(k + 1) % 3], Some(t)],
            };
            self.rejoin(of_u[(j + 1) % 3], u, t);
            self.rejoin(of_t[(k + 1) % 3], t, u);
            edges.extend([(t, 0), (t, 1), (u, 0), (u, 1)]);
        }
    }

    /// Edge of a triangle beyond which another is.
    fn edge_to(&self, from: usize, to: usize) -> usize {
        let beyond = self.triangles[from].beyond;
        // Neighbours know each other.
        usize::from(beyond[0] != Some(to))
            + usize::from(beyond[0] != Some(to) && beyond[1] != Some(to))
    }

    /// Tells a triangle that its neighbour is another one now.
    fn rejoin(&mut self, triangle: Option<usize>, old: usize, new: usize) {
        if let Some(triangle) = triangle {
            let k = self.edge_to(triangle, old);
            self.triangles[triangle].beyond[k] = Some(new);
        }
    }

    /// Lengths of the edges of a triangle.
    pub fn lengths(&self, t: usize) -> [f64; 3] {
        let corners = self.triangles[t].corners;
        std::array::from_fn(|k| {
            distance(self.points[corners[k]], self.points[corners[(k + 1) % 3]])
        })
    }

    fn longest(&self, t: usize) -> (usize, f64) {
        let lengths = self.lengths(t);
        let mut longest = 0;
        for k in 1..3 {
            if lengths[k] > lengths[longest] {
                longest = k;
            }
        }
        (longest, lengths[longest])
    }

    /// Splits the longest edge to which longer and longer ones lead from a triangle.
    fn split_towards(&mut self, mut t: usize) {
        let (mut k, mut length) = self.longest(t);
        while let Some(u) = self.triangles[t].beyond[k] {
            let (j, other) = self.longest(u);
            if other <= length * (1.0 + 1e-9) {
                break;
            }
            (t, k, length) = (u, j, other);
        }
        self.split(t, k);
    }

    /// Splits an edge in its middle.
    fn split(&mut self, t: usize, k: usize) {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| self.triangles[t].corners[k % 3]);
        let [before, after] = [k + 2, k + 1].map(|k| self.triangles[t].beyond[k % 3]);
        let (m, other) = (self.points.len(), self.triangles[t].beyond[k]);
        let [p, q] = [self.points[a], self.points[b]];
        self.points.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
        self.loops.push(self.loops[a].filter(|_| other.is_none()));
        let new = self.triangles.len();
        let beside = other.map(|_| new + 1);
        self.triangles[t] = Triangle {
            corners: [a, m, c],
            beyond: [beside, Some(new), before],
        };
        self.triangles.push(Triangle {
            corners: [m, b, c],
            beyond: [other, after, Some(t)],
        });
        self.rejoin(after, t, new);
        let mut edges = vec![(t, 2), (new, 1)];
        if let Some(u) = other {
            let j = self.edge_to(u, t);
            let d = self.triangles[u].corners[(j + 2) % 3];
            let [before, after] = [j + 2, j + 1].map(|k| self.triangles[u].beyond[k % 3]);
            self.triangles[u] = Triangle {
                corners: [b, m, d],
                beyond: [Some(new), Some(new + 1), before],
            };
            self.triangles.push(Triangle {
                corners: [m, a, d],
                beyond: [Some(t), after, Some(u)],
            });
            self.rejoin(after, u, new + 1);
            edges.extend([(u, 2), (new + 1, 1)]);
        }
        self.flip(edges);
    }

    /// Puts a point into the middle of the circle through the corners of a triangle; an edge of the outline that is before it, or too close
    /// to it, is split instead.
    pub fn refine(&mut self, t: usize) {
        let center = self.center(t);
        let mut at = t;
        let mut steps = 0;
        loop {
            let edges = self.edges(at);
            let out = (0..3).find(|k| cross(edges[*k], center) < 0.0);
            steps += 1;
            match out.map(|k| (k, self.triangles[at].beyond[k])) {
                // A walk that goes around has met roundoff: its point is on an edge.
                None => break,
                Some(_) if steps > self.triangles.len() => return self.split_towards(t),
                Some((_, Some(next))) => at = next,
                Some((k, None)) => return self.split(at, k),
            }
        }
        let close = (0..self.triangles.len()).find_map(|u| Some((u, self.too_close(u, center)?)));
        match close {
            Some((u, k)) => self.split(u, k),
            None => self.insert(at, center),
        }
    }

    /// Center of the circle through the corners of a triangle.
    fn center(&self, t: usize) -> Point {
        let [a, b, c] = self.triangles[t].corners.map(|p| self.points[p]);
        let ([e, f], [g, h]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let (first, second) = (e * e + f * f, g * g + h * h);
        let over = 0.5 / (e * h - f * g);
        [
            a[0] + (h * first - f * second) * over,
            a[1] + (e * second - g * first) * over,
        ]
    }

    /// Ends of the edges of a triangle.
    fn edges(&self, t: usize) -> [[Point; 2]; 3] {
        let corners = self.triangles[t].corners;
        std::array::from_fn(|k| [corners[k], corners[(k + 1) % 3]].map(|p| self.points[p]))
    }

    /// Edge of a triangle on the outline in whose circle a point is.
    fn too_close(&self, t: usize, [y, z]: Point) -> Option<usize> {
        let edges = self.edges(t);
        (0..3).find(|k| {
            let [a, b] = edges[*k];
            let size = distance(a, b);
            let dot = (a[0] - y) * (b[0] - y) + (a[1] - z) * (b[1] - z);
            self.triangles[t].beyond[*k].is_none() && dot < -FLAT * size * size
        })
    }

    /// Puts a point into a triangle, or into an edge that it is on.
    fn insert(&mut self, t: usize, point: Point) {
        let edges = self.edges(t);
        let is_on = |k: &usize| {
            let [a, b] = edges[*k];
            cross([a, b], point) <= 1e-6 * distance(a, b).powi(2)
        };
        if let Some(k) = (0..3).find(is_on) {
            return self.split(t, k);
        }
        let Triangle {
            corners: [a, b, c],
            beyond,
        } = self.triangles[t];
        let (p, first, second) = (
            self.points.len(),
            self.triangles.len(),
            self.triangles.len() + 1,
        );
        self.points.push(point);
        self.loops.push(None);
        self.triangles[t] = Triangle {
            corners: [a, b, p],
            beyond: [beyond[0], Some(first), Some(second)],
        };
        self.triangles.push(Triangle {
            corners: [b, c, p],
            beyond: [beyond[1], Some(second), Some(t)],
        });
        self.triangles.push(Triangle {
            corners: [c, a, p],
            beyond: [beyond[2], Some(t), Some(first)],
        });
        self.rejoin(beyond[1], t, first);
        self.rejoin(beyond[2], t, second);
        self.flip(vec![(t, 0), (first, 0), (second, 0)]);
    }

    /// Adds points until triangles are not slender, up to a number of points; edges shorter than a length are left.
    pub fn improve(&mut self, most: usize, least: f64) {
        let mut is_worse = true;
        while is_worse {
            is_worse = false;
            for t in 0..self.triangles.len() {
                let (_, length) = self.longest(t);
                if self.points.len() >= most || length < least {
                    continue;
                }
                let apex = |k: usize| self.points[self.triangles[t].corners[(k + 2) % 3]];
                let close = (0..3).find(|k| self.too_close(t, apex(*k)) == Some(*k));
                match close {
                    Some(k) => self.split(t, k),
                    None if self.is_slender(t) => self.refine(t),
                    None => continue,
                }
                is_worse = true;
            }
        }
    }

    /// Whether a triangle has a small angle that is not one of the outline.
    fn is_slender(&self, t: usize) -> bool {
        let Triangle { corners, beyond } = self.triangles[t];
        let lengths = self.lengths(t);
        let area = cross(
            [0, 1].map(|k| self.points[corners[k]]),
            self.points[corners[2]],
        );
        (0..3).any(|k| {
            let (before, after) = ((k + 2) % 3, k);
            let is_given = beyond[before].is_none() && beyond[after].is_none();
            !is_given && area < SLENDER * lengths[before] * lengths[after]
        })
    }

    /// Length of the shortest height or edge of a triangle, m.
    pub fn shortest(&self) -> f64 {
        let heights = (0..self.triangles.len()).map(|t| {
            let corners = self.triangles[t].corners.map(|p| self.points[p]);
            cross([corners[0], corners[1]], corners[2]) / self.longest(t).1
        });
        heights.fold(f64::INFINITY, f64::min)
    }

    /// Length of the shortest edge at a point, m.
    pub fn size_at(&self, point: usize) -> f64 {
        let at = (0..self.triangles.len()).filter(|t| self.triangles[*t].corners.contains(&point));
        let edges = at.flat_map(|t| {
            let (corners, lengths) = (self.triangles[t].corners, self.lengths(t));
            (0..3).filter_map(move |k| {
                [corners[k], corners[(k + 1) % 3]]
                    .contains(&point)
                    .then_some(lengths[k])
            })
        });
        edges.fold(f64::INFINITY, f64::min)
    }

    /// Splits edges until triangles at a point are no larger than a size, m.
    pub fn grade(&mut self, point: usize, size: f64) {
        let is_large = |mesh: &Self, t: usize| {
            mesh.triangles[t].corners.contains(&point) && mesh.longest(t).1 > size
        };
        while let Some(t) = (0..self.triangles.len()).find(|t| is_large(self, *t)) {
            let (k, _) = self.longest(t);
            self.split(t, k);
        }
    }
}
