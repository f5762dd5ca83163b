//! How wide bodies are drawn.

use crate::scene::{LineBody, Profile, SectionNumbers};

/// Half of what a section measures along its first and its second axis, m; in the plane the first is across it. Where its shape is not
/// said, that of the ellipse with its radii of gyration; without second moments, of the circle with its area.
fn halves(numbers: &SectionNumbers) -> [f64; 2] {
    match numbers.shape {
        Some(Profile::Rectangle { width, height } | Profile::Ellipse { width, height }) => {
            [0.5 * width, 0.5 * height]
        }
        Some(Profile::Circle { radius } | Profile::Tube { radius, .. }) => [radius; 2],
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

/// Whether sections have corners.
pub(super) fn has_corners(body: &LineBody) -> bool {
    matches!(
        body.section_after(0.0).shape,
        Some(Profile::Rectangle { .. })
    )
}
