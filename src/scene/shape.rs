//! Geometry of unstressed shapes, and how sections stand along them.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::marker::{difference, length};
use super::{LineBody, SceneVector, Shape};
use crate::math::vector::dot;

/// A sum of two vectors with factors, from a point on.
fn sum(from: [f64; 3], [a, b]: [([f64; 3], f64); 2]) -> [f64; 3] {
    std::array::from_fn(|k| from[k] + a.0[k] * a.1 + b.0[k] * b.1)
}

/// The unit vector along what of a vector is across a unit vector.
fn across(of: [f64; 3], along: [f64; 3]) -> [f64; 3] {
    unit(sum(of, [(along, -dot(&of, &along)), (along, 0.0)]))
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    Vector3::from(*a).cross(&Vector3::from(*b)).into()
}

/// The unit vector along another.
fn unit(of: [f64; 3]) -> [f64; 3] {
    of.map(|part| part / length(of))
}

impl Shape {
    /// First and last end; of a helix those of its axis.
    pub fn ends(&self) -> [SceneVector; 2] {
        let (Self::Line { from, to } | Self::Arc { from, to, .. } | Self::Helix { from, to, .. }) =
            self;
        [*from, *to]
    }

    /// Distance of the ends, m.
    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        length(difference(to.full(), from.full()))
    }

    /// Length along the shape, m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line { .. } => self.chord(),
            Self::Arc { length, .. } => *length,
            Self::Helix { radius, turns, .. } => self.chord().hypot(TAU * turns * radius),
        }
    }

    /// Point at `s` in [0, 1] of the length, m.
    pub fn point(&self, s: f64) -> [f64; 3] {
        let [from, to] = self.ends().map(|end| end.full());
        if let Self::Helix { radius, turns, .. } = self {
            let ([along, out], (sin, cos)) = (self.axes(), (TAU * turns * s).sin_cos());
            let on_axis = sum(from, [(along, s * self.chord()), (out, radius * cos)]);
            return sum(on_axis, [(cross(&along, &out), radius * sin), (along, 0.0)]);
        }
        match self.half_angle() {
            None => std::array::from_fn(|i| from[i] + s * (to[i] - from[i])),
            Some(_) if s == 1.0 => to,
            Some(half) => {
                let radius = self.length() / (2.0 * half);
                let ([along, out], angle) = (self.axes(), half * (2.0 * s - 1.0));
                let along = (along, radius * (angle.sin() + half.sin()));
                sum(from, [along, (out, radius * (angle.cos() - half.cos()))])
            }
        }
    }

    /// Unit tangent at `s` in [0, 1] of the length.
    pub fn tangent(&self, s: f64) -> [f64; 3] {
        if let Self::Helix { radius, turns, .. } = self {
            let ([along, out], (sin, cos)) = (self.axes(), (TAU * turns * s).sin_cos());
            let around = TAU * turns * radius / self.length();
            let rise = (along, self.chord() / self.length());
            let tangent = sum([0.0; 3], [rise, (out, -around * sin)]);
            return sum(tangent, [(cross(&along, &out), around * cos), (along, 0.0)]);
        }
        let ([along, out], half) = (self.axes(), self.half_angle().unwrap_or(0.0));
        let angle = half * (2.0 * s - 1.0);
        sum([0.0; 3], [(along, angle.cos()), (out, -angle.sin())])
    }

    /// Rotates a direction perpendicular to the tangent at the first end along the shape to `s`, by the smallest
    /// rotations of tangents.
    ///
    /// Source: R. L. Bishop, There is more than one way to frame a curve, Am. Math. Mon. 82 (1975) 246-251: against the normal such a
    /// direction rotates by minus the torsion of the curve, of a helix its angle times rise over length.
    pub fn carried(&self, across: [f64; 3], s: f64) -> [f64; 3] {
        let frame = |s: f64| {
            let (tangent, normal) = (self.tangent(s), self.normal(s, across));
            [normal, cross(&tangent, &normal)]
        };
        let torsion = match self {
            Self::Helix { turns, .. } => TAU * turns * s * self.chord() / self.length(),
            Self::Line { .. } | Self::Arc { .. } => 0.0,
        };
        let ([normal, side], [now, beside]) = (frame(0.0), frame(s));
        let angle = dot(&across, &side).atan2(dot(&across, &normal)) - torsion;
        let size = length(across);
        let parts = [(now, size * angle.cos()), (beside, size * angle.sin())];
        sum([0.0; 3], parts)
    }

    /// The unit vector across the tangent at `s` that points away from the centre of curvature; of a line along the direction across it.
    fn normal(&self, s: f64, across: [f64; 3]) -> [f64; 3] {
        let [along, out] = self.axes();
        match self {
            Self::Line { .. } => unit(across),
            Self::Arc { .. } => {
                let angle = self.half_angle().unwrap_or(0.0) * (2.0 * s - 1.0);
                sum([0.0; 3], [(out, angle.cos()), (along, angle.sin())])
            }
            Self::Helix { turns, .. } => {
                let (sin, cos) = (TAU * turns * s).sin_cos();
                sum([0.0; 3], [(out, cos), (cross(&along, &out), sin)])
            }
        }
    }

    /// Whether a plane holds it.
    pub fn is_plane(&self) -> bool {
        !matches!(self, Self::Helix { .. })
    }

    /// Whether the shape is straight.
    pub fn is_straight(&self) -> bool {
        matches!(self, Self::Line { .. })
    }

    /// Unit vectors from end to end, and to the side that an arc bulges to: to the right in the plane, down in space.
    /// The second is not finite where that is along the first. Of a helix: along its axis, and to its first end.
    fn axes(&self) -> [[f64; 3]; 2] {
        let [from, to] = self.ends();
        let along = unit(difference(to.full(), from.full()));
        let out = match (self, to.given().len()) {
            (Self::Line { .. }, _) => [0.0; 3],
            (Self::Helix { start, .. }, _) => across(start.full(), along),
            (_, 2) => [along[1], -along[0], 0.0],
            _ => across([0.0, 0.0, -1.0], along),
        };
        [along, out]
    }

    /// Half the angle of an arc: `sin(x) / x` is chord over length.
    fn half_angle(&self) -> Option<f64> {
        let Self::Arc { length, .. } = self else {
            return None;
        };
        let ratio = self.chord() / length;
        let (mut low, mut high) = (0.0, std::f64::consts::PI);
        // Bisection to the last bit: once per scene, and nothing can go wrong.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if middle.sin() > ratio * middle {
                low = middle
            } else {
                high = middle
            }
        }
        Some(0.5 * (low + high))
    }
}

impl LineBody {
    /// The first axis of a rod's section at its first end: as described; else level, so that the second is as far upright as can be; of
    /// an upright rod as far along `y` as can be, of one along `y` along `z`.
    pub fn first_axis(&self) -> [f64; 3] {
        const NEAR: f64 = 1e-6;
        let tangent = Vector3::from(self.shape.tangent(0.0));
        let across = |axis: Vector3<f64>| axis - tangent * tangent.dot(&axis);
        let vertical = match Vector3::from(self.vertical) {
            unsaid if unsaid == Vector3::zeros() => Vector3::z(),
            vertical => vertical.normalize(),
        };
        let level = vertical.cross(&tangent);
        let axis = match self.axis {
            Some(axis) => across(axis.full().into()),
            None if level.norm() > NEAR => level,
            None if across(Vector3::y()).norm() > NEAR => across(Vector3::y()),
            None => across(Vector3::z()),
        };
        axis.normalize().into()
    }

    /// A direction along the tangent and the axes of a rod's section at a material coordinate as described, in global components.
    pub fn directed(&self, s: f64, [along, first, second]: [f64; 3]) -> [f64; 3] {
        let tangent = Vector3::from(self.shape.tangent(s));
        let carried = Vector3::from(self.shape.carried(self.first_axis(), s));
        let (sin, cos) = self.sections_about(s)(s).1.sin_cos();
        let axis = carried * cos + tangent.cross(&carried) * sin;
        (tangent * along + axis * first + tangent.cross(&axis) * second).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second axis, which a rectangle's height is along, points against gravity.
    #[test]
    fn sections_stand_upright() {
        let tilted = [0.6, 0.0, 0.8];
        for (gravity, to, second) in [
            ([0.0; 3], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, -9.81], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, -9.81], [0.0, -3.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, -1.62, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, -9.81], tilted, [-0.8, 0.0, 0.6]),
            // Upright: the first axis along `y`, or along `z` as in the plane.
            ([0.0, 0.0, -9.81], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]),
            ([0.0, -9.81, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        ] {
            let text = format!(
                r#"{{"name": "s", "dimension": 3, "gravity": {gravity:?}, "bodies": [{{"name": "r", "element": "rod", "elements": 2,
                   "material": {{"youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1e3}},
                   "section": {{"shape": {{"rectangle": {{"width": 0.01, "height": 0.02}}}}}},
                   "shape": {{"line": {{"from": [0, 0, 0], "to": {to:?}}}}}}}],
                   "experiment": {{"stop_time": 1, "step": 0.1}}}}"#
            );
            let scene = crate::scene::Scene::from_json(&text).expect("a scene");
            let found = scene.bodies[0]
                .cable()
                .expect("a rod")
                .directed(0.0, [0.0, 0.0, 1.0]);
            for (found, wanted) in found.into_iter().zip(second) {
                assert!(
                    (found - wanted).abs() < 1e-14,
                    "{to:?}: {found}, expected {wanted}"
                );
            }
        }
    }

    #[test]
    fn an_arc_has_its_length_and_ends_and_sags() {
        let arc = Shape::Arc {
            from: [0.5, 1.0].into(),
            to: [1.5, 1.0].into(),
            length: 1.4,
        };
        assert_eq!(arc.point(0.0), [0.5, 1.0, 0.0]);
        let n = 20_000;
        let points: Vec<_> = (0..=n)
            .map(|i| arc.point(f64::from(i) / f64::from(n)))
            .collect();
        let length: f64 = points
            .windows(2)
            .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
            .sum();
        assert!((length - 1.4).abs() < 1e-8);
        assert!((points[n as usize - 1][0] - 1.5).abs() < 1e-4);
        assert!(arc.point(0.5)[1] < 0.7 && (arc.point(0.5)[0] - 1.0).abs() < 1e-12);
        let (a, b) = (arc.point(0.3), arc.point(0.3 + 1e-6));
        let tangent = arc.tangent(0.3);
        assert!(((b[0] - a[0]) / 1.4e-6 - tangent[0]).abs() < 1e-5);
        assert!(((b[1] - a[1]) / 1.4e-6 - tangent[1]).abs() < 1e-5);
    }

    #[test]
    fn a_helix_turns_about_its_axis_at_even_pace() {
        let helix = Shape::Helix {
            from: [1.0, 2.0, 3.0].into(),
            to: [1.0, 2.0, 3.5].into(),
            radius: 0.2,
            turns: -2.5,
            start: [0.0, 3.0, 4.0].into(),
        };
        // Left-handed: from +y it rotates to +x on its way up.
        let at = |s: f64| {
            let angle = 5.0 * std::f64::consts::PI * s;
            [
                1.0 + 0.2 * angle.sin(),
                2.0 + 0.2 * angle.cos(),
                3.0 + 0.5 * s,
            ]
        };
        let (h, pace) = (1e-4, helix.length());
        assert!((pace - 0.5_f64.hypot(std::f64::consts::PI)).abs() < 1e-15);
        for s in [0.0, 0.3, 1.0] {
            assert!(length(difference(helix.point(s), at(s))) < 1e-15);
            let way = difference(at(s + h), at(s - h)).map(|way| way / (2.0 * h * pace));
            assert!(length(difference(helix.tangent(s), way)) < 1e-6);
        }
    }

    #[test]
    fn in_space_an_arc_sags_in_its_upright_plane() {
        let (flat, tilted) = (
            Shape::Arc {
                from: [0.0, 0.0].into(),
                to: [5.0, 1.0].into(),
                length: 7.0,
            },
            Shape::Arc {
                from: [1.0, 2.0, 3.0].into(),
                to: [4.0, 6.0, 4.0].into(),
                length: 7.0,
            },
        );
        for s in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let turned = |[x, y, _]: [f64; 3]| [0.6 * x, 0.8 * x, y];
            let ([a, b], from) = (
                [flat.point(s), flat.tangent(s)].map(turned),
                [1.0, 2.0, 3.0],
            );
            assert!(length(difference(tilted.point(s), sum(from, [(a, 1.0), (a, 0.0)]))) < 1e-14);
            assert!(length(difference(tilted.tangent(s), b)) < 1e-14);
        }
    }

    /// Directions across the tangent, transported by many small rotations.
    #[test]
    fn what_is_across_is_carried_by_the_smallest_rotations() {
        let shapes = [
            Shape::Helix {
                from: [1.0, 2.0, 3.0].into(),
                to: [1.2, 2.0, 3.5].into(),
                radius: 0.2,
                turns: -1.3,
                start: [0.0, 3.0, 4.0].into(),
            },
            Shape::Arc {
                from: [1.0, 2.0, 3.0].into(),
                to: [4.0, 6.0, 4.0].into(),
                length: 17.0,
            },
            Shape::Line {
                from: [1.0, 2.0, 3.0].into(),
                to: [4.0, 6.0, 4.0].into(),
            },
        ];
        for shape in shapes {
            let start = Vector3::from(shape.tangent(0.0));
            let first = Vector3::new(0.3, -0.8, 0.5);
            let first = first - start * start.dot(&first);
            let (mut carried, mut from, steps) = (first, start, 4000);
            for step in 1..=steps {
                let s = f64::from(step) / f64::from(steps);
                let to = Vector3::from(shape.tangent(s));
                carried -= (from + to) * (to.dot(&carried) / (1.0 + from.dot(&to)));
                from = to;
                if step % 1000 == 0 {
                    let found = Vector3::from(shape.carried(first.into(), s));
                    assert!((found - carried).norm() < 1e-5, "{shape:?} {s}");
                }
            }
        }
    }
}
