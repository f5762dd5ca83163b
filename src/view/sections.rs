//! How wide bodies are drawn.

use crate::scene::{LineBody, Profile, SectionNumbers};

/// Half of what a section measures along its first and its second axis, m; in the plane the first is across it. Where its shape is not
/// said, that of the ellipse with its radii of gyration; without second moments, of the circle with its area.
fn halves(numbers: &SectionNumbers) -> [f64; 2] {
    match &numbers.shape {
        Some(
            Profile::Rectangle { width, height }
            | Profile::Ellipse { width, height }
            | Profile::HollowEllipse { width, height, .. },
        ) => [0.5 * width, 0.5 * height],
        Some(Profile::Circle { radius } | Profile::Tube { radius, .. }) => [*radius; 2],
        Some(shape) => shape.outline().map_or([0.0; 2], |outline| {
            let [low, high] = outline.bounds();
            [0, 1].map(|k| 0.5 * (high[k] - low[k]))
        }),
        None => {
            let [first, second] = numbers.second_moments;
            let area = numbers.area.max(f64::MIN_POSITIVE);
            let round = (numbers.area / std::f64::consts::PI).sqrt();
            let half = |moment: f64| {
                if moment > 0.0 {
                    2.0 * (moment / area).sqrt()
                } else {
                    round
                }
            };
            // The second moment about an axis is that of the distances along the other.
            let (along_first, along_second) = (half(second), half(first));
            [along_first, along_second].map(|half| if half.is_finite() { half } else { 0.0 })
        }
    }
}

/// Halves of the sections at both ends of every element between material coordinates.
pub(super) fn sections(body: &LineBody, mesh: &[f64]) -> Vec<[[f64; 2]; 2]> {
    let pairs = mesh.windows(2);
    pairs
        .map(|ends| {
            let numbers = body.sections_about(0.5 * (ends[0] + ends[1]));
            [ends[0], ends[1]].map(|s| halves(&numbers(s).0))
        })
        .collect()
}

/// How the largest normal stress of a section follows from what acts in it.
pub(super) struct SectionStress {
    /// By axial force, 1/m^2.
    by_force: f64,
    /// By bending moments about the first and the second axis, 1/m^3.
    by_moments: [f64; 2],
    /// Whether both moments are largest at one point, a corner.
    has_corners: bool,
    /// By both moments at the corners of a polygon, 1/m^3.
    at_corners: Vec<[f64; 2]>,
}

impl SectionStress {
    /// Computes the factors of sections at material coordinates in so many dimensions; 0 where a section's stiffness is given as a whole.
    pub fn of(body: &LineBody, mesh: &[f64], dimension: usize) -> Vec<Self> {
        let at = |s: &f64| {
            let numbers = body.section_after(*s);
            let [along_first, along_second] = halves(&numbers);
            let [first, second] = numbers.second_moments;
            let found = [
                1.0 / numbers.area,
                along_second / first,
                along_first / second,
            ];
            let [by_force, by_first, by_second] = found.map(|by| {
                if numbers.given.is_none() && by.is_finite() {
                    by
                } else {
                    0.0
                }
            });
            Self {
                by_force,
                by_moments: [by_first, by_second],
                has_corners: has_corners(body),
                at_corners: at_corners(body, &numbers, dimension),
            }
        };
        mesh.iter().map(at).collect()
    }

    /// Largest size of the normal stress under an axial force (N) and two bending moments (N m), Pa.
    pub fn largest(&self, [force, first, second]: [f64; 3]) -> f64 {
        if !self.at_corners.is_empty() {
            let stress = |[by_first, by_second]: &[f64; 2]| {
                force * self.by_force + first * by_first + second * by_second
            };
            let sizes = self.at_corners.iter().map(|corner| stress(corner).abs());
            return sizes.fold(0.0, f64::max);
        }
        let bending = [first * self.by_moments[0], second * self.by_moments[1]].map(f64::abs);
        let both = if self.has_corners {
            bending[0] + bending[1]
        } else {
            bending[0].hypot(bending[1])
        };
        force.abs() * self.by_force + both
    }
}

/// Stress by both moments at the corners of a polygon, 1/m^3; none of other shapes. In the plane and in cables the first moment stands for
/// either direction.
fn at_corners(body: &LineBody, numbers: &SectionNumbers, dimension: usize) -> Vec<[f64; 2]> {
    let outline = numbers.shape.as_ref().and_then(Profile::outline);
    let Some(outline) = outline else {
        return Vec::new();
    };
    let corners = outline.loops.into_iter().next().unwrap_or_default();
    let [first, _] = numbers.second_moments;
    let both = |way: f64| [[way / first, 0.0], [-way / first, 0.0]];
    match (dimension, body.is_rod()) {
        (2, _) => corners.iter().flat_map(|[_, z]| both(*z)).collect(),
        (_, false) => corners
            .iter()
            .flat_map(|[y, z]| both(y.hypot(*z)))
            .collect(),
        _ => (corners.into_iter())
            .map(|corner| numbers.stress_by_moments(corner))
            .collect(),
    }
}

/// Whether sections have corners.
pub(super) fn has_corners(body: &LineBody) -> bool {
    match body.section_after(0.0).shape {
        Some(
            Profile::Ellipse { .. }
            | Profile::HollowEllipse { .. }
            | Profile::Circle { .. }
            | Profile::Tube { .. },
        )
        | None => false,
        Some(_) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Body, Scene};

    fn stress(section: &str) -> f64 {
        let text = format!(
            r#"{{ "name": "one", "dimension": 3, "gravity": [0.0, 0.0, 0.0], "bodies": [ {{ "name": "bar", "element": "rod", "elements": 1,
              "material": {{ "youngs_modulus": 1e9, "shear_modulus": 4e8, "density": 1000.0 }}, "section": {{ {section} }},
              "shape": {{ "line": {{ "from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0] }} }} }} ] }}"#
        );
        let scene = Scene::from_json(&text).expect("a valid scene");
        let body = scene.bodies.iter().find_map(Body::flexible).expect("a rod");
        SectionStress::of(body, &[0.0, 1.0], 3)[0].largest([-6.0, 3.0, -4.0])
    }

    #[test]
    fn stress_is_largest_at_a_corner_or_across_the_whole_moment() {
        let [width, height] = [0.2, 0.1];
        let rectangle = stress(r#""shape": { "rectangle": { "width": 0.2, "height": 0.1 } }"#);
        let wanted = 6.0 / (width * height)
            + 3.0 / (width * height * height / 6.0)
            + 4.0 / (height * width * width / 6.0);
        assert!(
            (rectangle / wanted - 1.0).abs() < 1e-12,
            "{rectangle} {wanted}"
        );
        let circle = stress(r#""shape": { "circle": { "radius": 0.1 } }"#);
        let area = std::f64::consts::PI * 0.01;
        let wanted = 6.0 / area + 5.0 / (area * 0.1 / 4.0);
        assert!((circle / wanted - 1.0).abs() < 1e-12, "{circle} {wanted}");
    }

    /// An angle is stressed most at a corner, where both moments of the product of inertia count.
    #[test]
    fn stress_of_an_angle_is_largest_at_one_of_its_corners() {
        let found = stress(
            r#""shape": { "l": { "width": 0.1, "height": 0.2, "web_thickness": 0.02, "flange_thickness": 0.02 } }"#,
        );
        // Rectangles of 20 x 200 and 80 x 20 mm.
        let parts = [[0.01, 0.1, 0.02, 0.2], [0.06, 0.01, 0.08, 0.02]];
        let sum = |of: &dyn Fn([f64; 4]) -> f64| parts.iter().map(|part| of(*part)).sum::<f64>();
        let area = sum(&|[_, _, a, b]| a * b);
        let [y, z] = [0, 1].map(|k| sum(&|of| of[k] * of[2] * of[3]) / area);
        let square = |p: f64, edge: f64| p * p + edge * edge / 12.0;
        let first = sum(&|of| of[2] * of[3] * square(of[1] - z, of[3]));
        let second = sum(&|of| of[2] * of[3] * square(of[0] - y, of[2]));
        let product = sum(&|of| of[2] * of[3] * (of[0] - y) * (of[1] - z));
        let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.02], [0.02, 0.2], [0.0, 0.2]];
        let stresses = corners.map(|[p, q]| {
            let [p, q] = [p - y, q - z];
            let bent = [second * q - product * p, product * q - first * p];
            let by_moments = 3.0 * bent[0] - 4.0 * bent[1];
            (-6.0 / area + by_moments / (first * second - product * product)).abs()
        });
        let wanted = stresses.into_iter().fold(0.0, f64::max);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{found} {wanted}");
    }
}
