//! Shear stress by torsion in the shapes of cross sections.
//!
//! Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), sections 107 (ellipse) and 109 (rectangle:
//! stress function, whose derivatives the stresses are).

use std::f64::consts::PI;

use super::profile::Profile;
use super::solved;

/// Most terms of the series; it takes so many in corners alone, where it is good to 2e-5 of the largest stress.
const TERMS: u32 = 20_000;

impl Profile {
    /// Whether a point is in the section, where that is a polygon; in others every point is taken to be.
    pub fn holds(&self, point: [f64; 2]) -> bool {
        let is_polygon = self.loops().is_some();
        !is_polygon || solved::field(self).is_some_and(|field| field.stress(point).is_some())
    }

    /// Saint-Venant's shear stress at a point of the section, first and second coordinate in m, by the torque, 1/m^3. Outside of a polygon
    /// there is none.
    pub fn torsion_stress(&self, [y, z]: [f64; 2]) -> f64 {
        if self.loops().is_some() {
            let found = solved::field(self).and_then(|field| field.stress([y, z]));
            return found.map_or(0.0, |[first, second]| first.hypot(second));
        }
        let constant = self.numbers().torsion_constant;
        match *self {
            Self::HollowEllipse {
                width,
                height,
                inner_width,
            } => {
                // Lines of the stress of a whole ellipse are ellipses like it: the hole cuts along one.
                let whole = Self::Ellipse { width, height };
                whole.torsion_stress([y, z]) / (1.0 - (inner_width / width).powi(4))
            }
            Self::Box { .. }
            | Self::I { .. }
            | Self::C { .. }
            | Self::T { .. }
            | Self::L { .. }
            | Self::Polygon { .. } => unreachable!("polygons are solved"),
            Self::Circle { .. } | Self::Tube { .. } => y.hypot(z) / constant,
            Self::Ellipse { width, height } => {
                let [a, b] = [0.5 * width, 0.5 * height];
                2.0 * (y / (a * a)).hypot(z / (b * b)) / (PI * a * b)
            }
            Self::Rectangle { width, height } => {
                let edges = [0.5 * width, 0.5 * height];
                let [y, z] = [y.abs(), z.abs()];
                // The series runs in the coordinate that is closer to its edge: it converges the faster.
                if y * edges[1] >= z * edges[0] {
                    of_rectangle(edges, [y, z]) / constant
                } else {
                    of_rectangle([edges[1], edges[0]], [z, y]) / constant
                }
            }
        }
    }
}

/// Stress in a rectangle by shear modulus and twist, m, from half its edges, m.
fn of_rectangle([a, b]: [f64; 2], [y, z]: [f64; 2]) -> f64 {
    let (mut along, mut across) = (0.0, 0.0);
    for k in 0..TERMS {
        let n = f64::from(2 * k + 1);
        let [wave, at, edge] = [y, z, b].map(|way| 0.5 * n * PI * way / a);
        // sinh and cosh of `at` over cosh of `edge`, without their size.
        let (over, decay) = ((at - edge).exp(), (-2.0 * at).exp());
        let part = over / (1.0 + (-2.0 * edge).exp()) / (n * n);
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        along += sign * part * (1.0 + decay) * wave.sin();
        across += sign * part * (1.0 - decay) * wave.cos();
        if part < 1e-17 {
            break;
        }
    }
    let factor = 16.0 * a / (PI * PI);
    (2.0 * y - factor * along).hypot(factor * across)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Timoshenko and Goodier, section 109, table: the largest stress, in the middle of the longer edges, is
    /// `T / (k2 long short^2)`.
    #[test]
    fn largest_stress_of_a_rectangle_is_that_of_the_table() {
        for (ratio, wanted) in [
            (1.0, 0.208),
            (1.5, 0.231),
            (2.0, 0.246),
            (4.0, 0.282),
            (10.0, 0.312),
        ] {
            for (width, height, point) in [
                (0.3, 0.3 * ratio, [0.15, 0.0]),
                (0.3 * ratio, 0.3, [0.0, -0.15]),
            ] {
                let shape = Profile::Rectangle { width, height };
                let found = 1.0 / (shape.torsion_stress(point) * 0.027 * ratio);
                assert!((found - wanted).abs() < 6e-4, "{ratio} {found}");
            }
        }
    }

    /// Where either series of a rectangle may run both give the same; on the edges nothing crosses them; in corners nothing is left.
    #[test]
    fn stress_in_a_rectangle_is_the_same_by_either_series() {
        let (a, b) = (0.3, 0.2);
        for [y, z] in [
            [0.1, 0.1],
            [0.25, 0.05],
            [0.03, 0.15],
            [0.2, 0.0],
            [0.0, 0.1],
        ] {
            let one = of_rectangle([a, b], [y, z]);
            let other = of_rectangle([b, a], [z, y]);
            assert!((one - other).abs() < 1e-9, "{y} {z}: {one} {other}");
        }
        assert!(of_rectangle([a, b], [a, b]) < 3e-5 * a);
        assert_eq!(of_rectangle([a, b], [0.0, 0.0]), 0.0);
    }

    /// The torque is what the stress makes about the middle, integrated over the section (in a circle as well as in an ellipse of
    /// nearly equal axes).
    #[test]
    fn an_ellipse_that_is_nearly_a_circle_is_stressed_like_one() {
        let circle = Profile::Circle { radius: 0.1 };
        let ellipse = Profile::Ellipse {
            width: 0.2,
            height: 0.2,
        };
        for point in [[0.1, 0.0], [0.03, -0.05], [0.0, 0.08]] {
            let (one, other) = (circle.torsion_stress(point), ellipse.torsion_stress(point));
            assert!((one - other).abs() < 1e-12 * one, "{one} {other}");
        }
        // At the end of the shorter axis the largest, `2 T / (pi a b^2)`.
        let flat = Profile::Ellipse {
            width: 0.4,
            height: 0.2,
        };
        let largest = flat.torsion_stress([0.0, 0.1]);
        assert!((largest * PI * 0.2 * 0.01 - 2.0).abs() < 1e-12);
    }
}
