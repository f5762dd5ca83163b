//! Surfaces of plates and shells as maps of a square, with the derivatives that elements take.

use nalgebra::Vector3;

use super::PARTS;
use crate::math::quadrature::GAUSS_3;
use crate::math::space::tangent_axes;
use crate::scene::SceneVector;
use crate::scene::description::PatchSurface;

type SurfacePoint = Vector3<f64>;

/// A surface as a map of `[s1, s2]` in `[0, 1]`.
#[derive(Clone, Debug)]
pub enum SurfaceMap {
    /// Straight lines between opposite edges, by the corners at `[0, 0]`, `[1, 0]`, `[1, 1]` and `[0, 1]`.
    Bilinear([SurfacePoint; 4]),
    /// A curve that rotates about an axis.
    Revolved(Revolved),
    /// Straight lines between two curves, of points with their derivatives.
    Ruled([Vec<[SurfacePoint; 2]>; 2]),
    /// Smooth surface through a grid, `[s1][s2]`, of points with both derivatives and the mixed one.
    Spline(Vec<Vec<[SurfacePoint; 4]>>),
}

/// A curve that rotates about an axis.
#[derive(Clone, Debug)]
pub struct Revolved {
    origin: SurfacePoint,
    /// Direction of the curve's plane at the start, the one a right angle further, and the axis: unit vectors.
    axes: [SurfacePoint; 3],
    angle: f64,
    profile: Meridian,
    /// Which of both coordinates goes around.
    around: usize,
}

/// A curve that rotates, beside its axis.
#[derive(Clone, Copy, Debug)]
enum Meridian {
    /// A line: from and to a height above the origin and a distance from the axis, m.
    Line([[f64; 2]; 2]),
    /// A circle about the origin with a radius, m, between two latitudes, rad.
    Circle(f64, [f64; 2]),
}

impl Meridian {
    /// Height and distance from the axis, with their derivatives.
    fn at(self, w: f64) -> [[f64; 2]; 2] {
        match self {
            Self::Line([from, to]) => {
                let way = [to[0] - from[0], to[1] - from[1]];
                [[from[0] + w * way[0], from[1] + w * way[1]], way]
            }
            Self::Circle(radius, [from, to]) => {
                let (sin, cos) = (from + w * (to - from)).sin_cos();
                let speed = radius * (to - from);
                [[radius * sin, radius * cos], [speed * cos, -speed * sin]]
            }
        }
    }
}

impl Revolved {
    fn at(&self, at: [f64; 2]) -> [SurfacePoint; 4] {
        let (sin, cos) = (self.angle * at[self.around]).sin_cos();
        let [[height, radius], [rise, growth]] = self.profile.at(at[1 - self.around]);
        let [a, b, axis] = self.axes;
        let (out, on) = (a * cos + b * sin, (b * cos - a * sin) * self.angle);
        let point = self.origin + axis * height + out * radius;
        let along = axis * rise + out * growth;
        let (turned, mixed) = (on * radius, on * growth);
        match self.around {
            0 => [point, turned, along, mixed],
            _ => [point, along, turned, mixed],
        }
    }
}

fn point(of: &SceneVector) -> SurfacePoint {
    of.full().into()
}

/// Axes of a rotation about `axis` that begins along what of `start` is across it.
fn axes(axis: SurfacePoint, start: SurfacePoint) -> [SurfacePoint; 3] {
    let axis = axis.normalize();
    let out = (start - axis * axis.dot(&start)).normalize();
    [out, axis.cross(&out), axis]
}

impl SurfaceMap {
    /// Map of a surface as described.
    pub fn new(surface: &PatchSurface) -> Self {
        use PatchSurface::*;
        match surface {
            Rectangle { corner, edges } => {
                let (corner, [a, b]) = (point(corner), edges.each_ref().map(point));
                Self::Bilinear([corner, corner + a, corner + a + b, corner + b])
            }
            Quadrilateral { corners } => Self::Bilinear(corners.each_ref().map(point)),
            Annulus {
                center,
                normal,
                start,
                radii,
                angle,
            } => Self::Revolved(Revolved {
                origin: point(center),
                axes: axes(point(normal), point(start)),
                angle: *angle,
                profile: Meridian::Line(radii.map(|radius| [0.0, radius])),
                around: 1,
            }),
            Cylinder {
                from,
                to,
                radius,
                start,
                angle,
            } => around(from, to, [*radius; 2], start, *angle),
            Cone {
                from,
                to,
                radii,
                start,
                angle,
            } => around(from, to, *radii, start, *angle),
            Sphere {
                center,
                radius,
                axis,
                start,
                latitudes,
                angle,
            } => Self::Revolved(Revolved {
                origin: point(center),
                axes: axes(point(axis), point(start)),
                angle: *angle,
                profile: Meridian::Circle(*radius, *latitudes),
                around: 0,
            }),
            Ruled { curves } => Self::Ruled(curves.each_ref().map(|points| {
                let points: Vec<SurfacePoint> = points.iter().map(point).collect();
                let slopes = slopes(&points);
                points.into_iter().zip(slopes).map(Into::into).collect()
            })),
            Points { grid } => Self::Spline(through(grid)),
        }
    }

    /// Position, its derivatives by `s1` and `s2`, and the mixed one, m.
    pub fn at(&self, [u, v]: [f64; 2]) -> [SurfacePoint; 4] {
        match self {
            Self::Bilinear([a, b, c, d]) => {
                let mixed = a - b + c - d;
                let (first, second) = (b - a + mixed * v, d - a + mixed * u);
                [
                    a + (b - a) * u + (d - a) * v + mixed * (u * v),
                    first,
                    second,
                    mixed,
                ]
            }
            Self::Revolved(of) => of.at([u, v]),
            Self::Ruled(curves) => {
                let [[p, dp], [q, dq]] = curves.each_ref().map(|curve| on_curve(curve, u));
                let between = |a: SurfacePoint, b: SurfacePoint| a + (b - a) * v;
                [between(p, q), between(dp, dq), q - p, dq - dp]
            }
            Self::Spline(grid) => {
                let (row, column) = (
                    CurvePiece::at(grid.len(), u),
                    CurvePiece::at(grid[0].len(), v),
                );
                // Along `s2` of both rows: the value and the derivative by `s1`, each with its derivative by `s2`.
                let along = [0, 1].map(|k| {
                    let ends = [0, 1].map(|l| grid[row.first + k][column.first + l]);
                    [0, 1].map(|part| column.between(ends.map(|of| [of[part], of[part + 2]])))
                });
                let [[r, first], [second, mixed]] = [0, 1].map(|part| {
                    row.between(along.map(|[value, slope]| [value[part], slope[part]]))
                });
                [r, first, second, mixed]
            }
        }
    }

    /// Axes at a place, unit vectors: along the lines along `s1`, across them in the surface, and the normal.
    pub fn axes(&self, at: [f64; 2]) -> [SurfacePoint; 3] {
        let [_, first, second, _] = self.at(at);
        tangent_axes(&first, &second)
    }

    /// Mean lengths of the lines along `s1` and `s2`, m.
    pub fn lengths(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let part = f64::from(PARTS).recip();
        let places = || {
            (0..PARTS)
                .flat_map(|k| GAUSS_3.map(|p| ((f64::from(k) + p.at) * part, p.weight * part)))
        };
        for (u, a) in places() {
            for (v, b) in places() {
                let [_, first, second, _] = self.at([u, v]);
                sums[0] += a * b * first.norm();
                sums[1] += a * b * second.norm();
            }
        }
        sums
    }
}

/// Sector of a cone or a cylinder.
fn around(
    from: &SceneVector,
    to: &SceneVector,
    radii: [f64; 2],
    start: &SceneVector,
    angle: f64,
) -> SurfaceMap {
    let [from, to] = [from, to].map(point);
    let (axis, [first, last]) = (to - from, radii);
    SurfaceMap::Revolved(Revolved {
        origin: from,
        axes: axes(axis, point(start)),
        angle,
        profile: Meridian::Line([[0.0, first], [axis.norm(), last]]),
        around: 0,
    })
}

/// Derivatives at a grid of points, such that they belong to one smooth surface.
fn through(grid: &[Vec<SceneVector>]) -> Vec<Vec<[SurfacePoint; 4]>> {
    let points = grid.iter().map(|row| row.iter().map(point).collect());
    let points: Vec<Vec<SurfacePoint>> = points.collect();
    let along_second =
        |rows: &[Vec<SurfacePoint>]| rows.iter().map(|row| slopes(row)).collect::<Vec<_>>();
    let along_first = |rows: &[Vec<SurfacePoint>]| {
        let columns = (0..rows[0].len()).map(|j| {
            let column: Vec<SurfacePoint> = rows.iter().map(|row| row[j]).collect();
            slopes(&column)
        });
        let columns: Vec<Vec<SurfacePoint>> = columns.collect();
        let row = |i: usize| columns.iter().map(|column| column[i]).collect();
        (0..rows.len()).map(row).collect::<Vec<Vec<SurfacePoint>>>()
    };
    let (first, second) = (along_first(&points), along_second(&points));
    let mixed = along_second(&first);
    let of = |i: usize, j: usize| [points[i][j], first[i][j], second[i][j], mixed[i][j]];
    let row = |i: usize| (0..points[i].len()).map(|j| of(i, j)).collect();
    (0..points.len()).map(row).collect()
}

/// Derivatives, over the whole curve from 0 to 1, of the cubic spline through points at even steps; without a knot at the points beside the
/// ends, so that cubics come out exactly.
///
/// Source: C. de Boor, A Practical Guide to Splines (1978), chapter 4.
fn slopes(points: &[SurfacePoint]) -> Vec<SurfacePoint> {
    let last = points.len() - 1;
    let step = |k: usize| (points[k + 1] - points[k]) * last as f64;
    match last {
        1 => return vec![step(0); 2],
        2 => {
            let bend = (step(1) - step(0)) * 0.5;
            return vec![step(0) - bend, step(0) + bend, step(1) + bend];
        }
        _ => {}
    }
    // Each row: what counts before, at and after a point, and the sum.
    let mut rows: Vec<([f64; 2], SurfacePoint)> =
        vec![([1.0, 2.0], (step(0) * 5.0 + step(1)) * 0.5)];
    for k in 1..=last {
        let (mut row, mut sum, before) = if k < last {
            ([4.0, 1.0], (step(k - 1) + step(k)) * 3.0, 1.0)
        } else {
            (
                [1.0, 0.0],
                (step(last - 1) * 5.0 + step(last - 2)) * 0.5,
                2.0,
            )
        };
        let ([at, after], of) = rows[k - 1];
        let factor = before / at;
        row[0] -= factor * after;
        sum -= of * factor;
        rows.push((row, sum));
    }
    let mut found = vec![SurfacePoint::zeros(); last + 1];
    for (k, ([at, after], sum)) in rows.into_iter().enumerate().rev() {
        let beyond = found.get(k + 1).copied().unwrap_or_default();
        found[k] = (sum - beyond * after) / at;
    }
    found
}

/// Value and derivative of a curve through points with derivatives at even steps.
fn on_curve(points: &[[SurfacePoint; 2]], s: f64) -> [SurfacePoint; 2] {
    let piece = CurvePiece::at(points.len(), s);
    piece.between([points[piece.first], points[piece.first + 1]])
}

/// A place on a curve through points at even steps.
#[derive(Clone, Copy)]
struct CurvePiece {
    /// Point before it.
    first: usize,
    /// Part of the way to the next point.
    x: f64,
    /// Way to the next point, of that along the whole curve.
    size: f64,
}

impl CurvePiece {
    fn at(points: usize, s: f64) -> Self {
        let count = points - 1;
        let first = ((s * count as f64) as usize).min(count - 1);
        Self {
            first,
            x: s * count as f64 - first as f64,
            size: (count as f64).recip(),
        }
    }

    /// Value and derivative, from those of the points before and after.
    fn between(&self, [[p, dp], [q, dq]]: [[SurfacePoint; 2]; 2]) -> [SurfacePoint; 2] {
        let (x, size) = (self.x, self.size);
        let (dp, dq, way) = (dp * size, dq * size, q - p);
        // In powers of x.
        let (square, cube) = (way * 3.0 - dp * 2.0 - dq, dp + dq - way * 2.0);
        let value = p + (dp + (square + cube * x) * x) * x;
        let slope = dp + (square * 2.0 + cube * (3.0 * x)) * x;
        [value, slope / size]
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn surfaces() -> Vec<SurfaceMap> {
        let wave = |k: usize, j: usize| {
            let (u, v) = (k as f64 / 4.0, j as f64 / 3.0);
            json!([u, v + 0.2 * u * u, 0.3 * u * v - 0.2 * v * v * v])
        };
        let grid: Vec<Vec<_>> = (0..5)
            .map(|k| (0..4).map(|j| wave(k, j)).collect())
            .collect();
        let given = [
            json!({"rectangle": {"corner": [1, 2, 3], "edges": [[2, 0, 1], [0.5, 3, 0]]}}),
            json!({"quadrilateral": {"corners": [[0, 0, 0], [2, 0, 0.5], [3, 2, 0], [-1, 1, 1]]}}),
            json!({"annulus": {"center": [1, 0, 0], "normal": [0, 1, 2], "start": [1, 0, 0],
                "radii": [0.5, 2], "angle": 2.5}}),
            json!({"cylinder": {"from": [0, 0, 0], "to": [1, 1, 2], "radius": 0.7,
                "start": [1, 0, 0], "angle": 4}}),
            json!({"cone": {"from": [0, 0, 0], "to": [1, 1, 2], "radii": [0.7, 0.2],
                "start": [1, 0, 0], "angle": 4}}),
            json!({"sphere": {"center": [1, 1, 0], "radius": 2, "axis": [0, 0, 1],
                "start": [1, 1, 0], "latitudes": [-0.5, 1.2], "angle": 1.6}}),
            json!({"ruled": {"curves": [[[0, 0, 0], [1, 0, 0.2], [2, 0.1, 0]],
                [[0, 1, 0], [0.7, 1, 0], [1.5, 1, 0.3], [2, 1.2, 0]]]}}),
            json!({"points": {"grid": grid}}),
        ];
        let read = given.map(|given| serde_json::from_value(given).expect("a surface"));
        read.iter().map(SurfaceMap::new).collect()
    }

    #[test]
    fn derivatives_are_those_of_positions() {
        let h = 1e-4;
        for map in surfaces() {
            for at in [[0.13, 0.21], [0.4, 0.9], [0.77, 0.58]] {
                let of = |p: f64, q: f64| map.at([at[0] + p * h, at[1] + q * h])[0];
                let [_, first, second, mixed] = map.at(at);
                let by = [
                    (of(1.0, 0.0) - of(-1.0, 0.0)) / (2.0 * h),
                    (of(0.0, 1.0) - of(0.0, -1.0)) / (2.0 * h),
                    (of(1.0, 1.0) - of(1.0, -1.0) - of(-1.0, 1.0) + of(-1.0, -1.0)) / (4.0 * h * h),
                ];
                for (found, by) in [first, second, mixed].into_iter().zip(by) {
                    assert!((found - by).norm() < 1e-6, "{map:?} {found} {by}");
                }
            }
        }
    }

    /// Normals of surfaces about an axis point away from it; that of a ring is along its axis.
    #[test]
    fn normals_are_as_said() {
        let maps = surfaces();
        let normal = |map: &SurfaceMap| map.axes([0.3, 0.6])[2];
        assert!((normal(&maps[2]) - SurfacePoint::new(0.0, 1.0, 2.0).normalize()).norm() < 1e-14);
        let axis = SurfacePoint::new(1.0, 1.0, 2.0).normalize();
        let at = maps[3].at([0.3, 0.6])[0];
        let out = (at - axis * axis.dot(&at)) / 0.7;
        assert!((normal(&maps[3]) - out).norm() < 1e-14);
        let out = (maps[5].at([0.3, 0.6])[0] - SurfacePoint::new(1.0, 1.0, 0.0)) / 2.0;
        assert!((normal(&maps[5]) - out).norm() < 1e-14);
    }

    /// The grid is of a cubic polynomial, which the spline gives back, and mean lengths of a sector are those of circles.
    #[test]
    fn splines_give_cubics_back() {
        let maps = surfaces();
        let (u, v): (f64, f64) = (0.37, 0.81);
        let wanted = SurfacePoint::new(u, v + 0.2 * u * u, 0.3 * u * v - 0.2 * v * v * v);
        assert!((maps[7].at([u, v])[0] - wanted).norm() < 1e-14);
        let [along, around] = maps[2].lengths();
        assert!((along - 1.5).abs() < 1e-12 && (around - 2.5 * 1.25).abs() < 1e-12);
    }
}
