//! Geometry of unstressed shapes.

use super::Shape;

impl Shape {
    /// Length along the shape, m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line { from, to } => (to[0] - from[0]).hypot(to[1] - from[1]),
            Self::Arc { length, .. } => *length,
        }
    }

    /// Point at `s` in [0, 1] of the length, m.
    pub fn point(&self, s: f64) -> [f64; 2] {
        let (Self::Line { from, to } | Self::Arc { from, to, .. }) = self;
        match self.half_angle() {
            None => std::array::from_fn(|i| from[i] + s * (to[i] - from[i])),
            Some(_) if s == 1.0 => *to,
            Some(half) => {
                let radius = self.length() / (2.0 * half);
                let start = self.angle(0.0);
                let angle = self.angle(s);
                [
                    from[0] + radius * (angle.sin() - start.sin()),
                    from[1] - radius * (angle.cos() - start.cos()),
                ]
            }
        }
    }

    /// Unit tangent at `s` in [0, 1] of the length.
    pub fn tangent(&self, s: f64) -> [f64; 2] {
        match self {
            Self::Line { from, to } => {
                let length = self.length();
                std::array::from_fn(|i| (to[i] - from[i]) / length)
            }
            Self::Arc { .. } => {
                let angle = self.angle(s);
                [angle.cos(), angle.sin()]
            }
        }
    }

    /// Whether the shape is straight.
    pub fn is_straight(&self) -> bool {
        matches!(self, Self::Line { .. })
    }

    /// Direction of the tangent: an arc that bulges to the right turns left all the way.
    fn angle(&self, s: f64) -> f64 {
        let (Self::Line { from, to } | Self::Arc { from, to, .. }) = self;
        let chord = (to[1] - from[1]).atan2(to[0] - from[0]);
        chord + self.half_angle().unwrap_or(0.0) * (2.0 * s - 1.0)
    }

    /// Half the angle of an arc: `sin(x) / x` is chord over length.
    fn half_angle(&self) -> Option<f64> {
        let Self::Arc { from, to, length } = self else {
            return None;
        };
        let ratio = (to[0] - from[0]).hypot(to[1] - from[1]) / length;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_has_its_length_and_ends_and_sags() {
        let arc = Shape::Arc {
            from: [0.5, 1.0],
            to: [1.5, 1.0],
            length: 1.4,
        };
        assert_eq!(arc.point(0.0), [0.5, 1.0]);
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
}
