//! Shapes of cross sections, and the numbers that follow from them.

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::section::SectionNumbers;
use super::solved;
use crate::elements::saint_venant::{Outline, ShearNumbers};

/// Corners of the polygon that the shear compliance of a hollow ellipse is computed with.
const ROUND: u32 = 96;

/// Shape of a cross section, from which its numbers follow. Its centroid is on the line of the body. Axes are those of the section of a rod; a
/// cable in the plane has the first across the plane, so that its height lies in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Profile {
    /// Rectangle.
    #[schemars(title = "Rectangle")]
    Rectangle {
        /// Edge along the first axis, m.
        width: f64,
        /// Edge along the second axis, m.
        height: f64,
    },
    /// Ellipse.
    #[schemars(title = "Ellipse")]
    Ellipse {
        /// Diameter along the first axis, m.
        width: f64,
        /// Diameter along the second axis, m.
        height: f64,
    },
    /// Circle.
    #[schemars(title = "Circle")]
    Circle {
        /// Radius, m.
        radius: f64,
    },
    /// Circle with a round hole in its middle.
    #[schemars(title = "Tube")]
    Tube {
        /// Outer radius, m.
        radius: f64,
        /// Radius of the hole, m.
        inner_radius: f64,
    },
    /// Ellipse with a hole of the same proportions in its middle.
    #[schemars(title = "HollowEllipse")]
    HollowEllipse {
        /// Diameter along the first axis, m.
        width: f64,
        /// Diameter along the second axis, m.
        height: f64,
        /// Diameter of the hole along the first axis, m. Along the second it is the same part of the height.
        inner_width: f64,
    },
    /// Rectangle with a rectangular hole in its middle.
    #[schemars(title = "Box")]
    Box {
        /// Outer edge along the first axis, m.
        width: f64,
        /// Outer edge along the second axis, m.
        height: f64,
        /// Thickness of the two walls along the second axis, m.
        web_thickness: f64,
        /// Thickness of the two walls along the first axis, m.
        flange_thickness: f64,
    },
    /// Letter I: a web along the second axis between two equal flanges along the first.
    #[schemars(title = "IProfile")]
    I {
        /// Length of the flanges along the first axis, m.
        width: f64,
        /// Whole height along the second axis, m.
        height: f64,
        /// Thickness of the web, m.
        web_thickness: f64,
        /// Thickness of each flange, m.
        flange_thickness: f64,
    },
    /// Channel: a web along the second axis, from whose ends two equal flanges go along the first axis, to its positive side.
    #[schemars(title = "Channel")]
    C {
        /// Length of the flanges with the web, m.
        width: f64,
        /// Whole height along the second axis, m.
        height: f64,
        /// Thickness of the web, m.
        web_thickness: f64,
        /// Thickness of each flange, m.
        flange_thickness: f64,
    },
    /// Letter T: a flange along the first axis, from whose middle a web goes down, to the negative side of the second axis.
    #[schemars(title = "TProfile")]
    T {
        /// Length of the flange along the first axis, m.
        width: f64,
        /// Whole height along the second axis, m.
        height: f64,
        /// Thickness of the web, m.
        web_thickness: f64,
        /// Thickness of the flange, m.
        flange_thickness: f64,
    },
    /// Angle: a leg along the second axis, from whose lower end another goes along the first axis, to its positive side.
    #[schemars(title = "Angle")]
    L {
        /// Length of the leg along the first axis with the other one, m.
        width: f64,
        /// Length of the leg along the second axis with the other one, m.
        height: f64,
        /// Thickness of the leg along the second axis, m.
        web_thickness: f64,
        /// Thickness of the leg along the first axis, m.
        flange_thickness: f64,
    },
    /// Polygon, with holes that are polygons. Its corners are about any origin: the centroid comes to the line.
    #[schemars(title = "Polygon")]
    Polygon {
        /// Corners around it, in either direction: first and second coordinate, m.
        #[schemars(length(min = 3, max = 200))]
        outline: Vec<[f64; 2]>,
        /// Corners around each hole.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        holes: Vec<Vec<[f64; 2]>>,
    },
}

impl Profile {
    /// Lengths of the shape, m, with their keys and meanings. A polygon has none.
    pub fn lengths(&mut self) -> Vec<(&'static str, &'static str, &mut f64)> {
        const RADIUS: &str = "Radius of the cross section";
        const WIDTH: &str = "Width of the cross section";
        const HEIGHT: &str = "Height of the cross section";
        match self {
            Self::Rectangle { width, height } | Self::Ellipse { width, height } => {
                vec![("width", WIDTH, width), ("height", HEIGHT, height)]
            }
            Self::Circle { radius } => vec![("radius", RADIUS, radius)],
            Self::Tube {
                radius,
                inner_radius,
            } => {
                let hole = "Radius of the hole in the cross section";
                vec![
                    ("radius", RADIUS, radius),
                    ("inner_radius", hole, inner_radius),
                ]
            }
            Self::HollowEllipse {
                width,
                height,
                inner_width,
            } => {
                let hole = "Width of the hole in the cross section";
                vec![
                    ("width", WIDTH, width),
                    ("height", HEIGHT, height),
                    ("inner_width", hole, inner_width),
                ]
            }
            Self::Box {
                width,
                height,
                web_thickness,
                flange_thickness,
            }
            | Self::I {
                width,
                height,
                web_thickness,
                flange_thickness,
            }
            | Self::C {
                width,
                height,
                web_thickness,
                flange_thickness,
            }
            | Self::T {
                width,
                height,
                web_thickness,
                flange_thickness,
            }
            | Self::L {
                width,
                height,
                web_thickness,
                flange_thickness,
            } => {
                let web = "Thickness of walls along the second axis of the cross section";
                let flange = "Thickness of walls along the first axis of the cross section";
                vec![
                    ("width", WIDTH, width),
                    ("height", HEIGHT, height),
                    ("web_thickness", web, web_thickness),
                    ("flange_thickness", flange, flange_thickness),
                ]
            }
            Self::Polygon { .. } => Vec::new(),
        }
    }

    /// Key of the shape in a scene.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "rectangle",
            Self::Ellipse { .. } => "ellipse",
            Self::Circle { .. } => "circle",
            Self::Tube { .. } => "tube",
            Self::HollowEllipse { .. } => "hollow_ellipse",
            Self::Box { .. } => "box",
            Self::I { .. } => "i",
            Self::C { .. } => "c",
            Self::T { .. } => "t",
            Self::L { .. } => "l",
            Self::Polygon { .. } => "polygon",
        }
    }

    /// Width, height, thickness of walls along the second axis and along the first, m, of a shape of such walls.
    pub fn walls(&self) -> Option<[f64; 4]> {
        let mut shape = self.clone();
        let lengths = shape.lengths().into_iter();
        let lengths: Vec<f64> = lengths.map(|(.., length)| *length).collect();
        lengths.try_into().ok()
    }

    /// Corners around the shape and around its holes, where it is a polygon.
    pub fn loops(&self) -> Option<Vec<Vec<[f64; 2]>>> {
        if let Self::Polygon { outline, holes } = self {
            return Some([outline].into_iter().chain(holes).cloned().collect());
        }
        let [width, height, web, flange] = self.walls()?;
        let [y, z] = [0.5 * width, 0.5 * height];
        let rectangle = |y: f64, z: f64| vec![[-y, -z], [y, -z], [y, z], [-y, z]];
        let lower = [[0.0, 0.0], [width, 0.0], [width, flange], [web, flange]];
        let outline: Vec<_> = match self {
            Self::I { .. } => {
                let [s, f] = [0.5 * web, z - flange];
                let right = [[y, -z], [y, -f], [s, -f], [s, f], [y, f], [y, z]];
                let left = right.map(|[y, z]| [-y, -z]);
                right.into_iter().chain(left).collect()
            }
            Self::C { .. } => {
                let upper = lower.map(|[y, z]| [y, height - z]).into_iter().rev();
                lower.into_iter().chain(upper).collect()
            }
            Self::T { .. } => {
                let [s, f] = [0.5 * web, height - flange];
                let right = [[s, 0.0], [s, f], [y, f], [y, height]];
                let left = right.map(|[y, z]| [-y, z]).into_iter().rev();
                right.into_iter().chain(left).collect()
            }
            Self::L { .. } => {
                let upper = [[web, height], [0.0, height]];
                lower.into_iter().chain(upper).collect()
            }
            Self::Box { .. } => {
                return Some(vec![rectangle(y, z), rectangle(y - web, z - flange)]);
            }
            _ => return None,
        };
        Some(vec![outline])
    }

    /// Whether finite elements give its shear compliance.
    pub fn solved_by_elements(&self) -> bool {
        self.loops().is_some() || matches!(self, Self::HollowEllipse { .. })
    }

    /// Outline about the centroid, where the shape is a polygon.
    pub fn outline(&self) -> Option<Outline> {
        self.loops().map(Outline::new)
    }

    /// Polygon that torsion and flexure are solved on, where these have no closed form. That of a hollow ellipse has corners on both ellipses.
    pub(super) fn solved_loops(&self) -> Option<Vec<Vec<[f64; 2]>>> {
        let Self::HollowEllipse {
            width,
            height,
            inner_width,
        } = *self
        else {
            return self.loops();
        };
        let ring = |part: f64| {
            let corner = |k: u32| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(ROUND)).sin_cos();
                [0.5 * part * width * cos, 0.5 * part * height * sin]
            };
            (0..ROUND).map(corner).collect()
        };
        Some(vec![ring(1.0), ring(inner_width / width)])
    }

    /// Numbers of the section (S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), sections 106, 107 and 109; those of
    /// polygons by finite elements).
    pub fn numbers(&self) -> SectionNumbers {
        self.numbers_with(solved::numbers(self))
    }

    /// Numbers of the section with what finite elements give, where they do.
    pub(super) fn numbers_with(&self, shear: Option<ShearNumbers>) -> SectionNumbers {
        let mut numbers = SectionNumbers {
            shear,
            shape: Some(self.clone()),
            ..SectionNumbers::default()
        };
        if let Some(outline) = self.outline() {
            return SectionNumbers {
                area: outline.area,
                second_moments: outline.second_moments,
                product_moment: outline.product_moment,
                torsion_constant: shear.map_or(0.0, |of| of.torsion_constant),
                ..numbers
            };
        }
        let (area, second_moments, torsion_constant) = self.closed_numbers();
        (numbers.area, numbers.second_moments) = (area, second_moments);
        numbers.torsion_constant = torsion_constant;
        numbers
    }

    /// Area, second moments and torsion constant by closed forms.
    fn closed_numbers(&self) -> (f64, [f64; 2], f64) {
        match *self {
            Self::Rectangle { width, height } => {
                let area = width * height;
                let moments = [height, width].map(|edge| area * edge * edge / 12.0);
                (area, moments, torsion_of_rectangle(width, height))
            }
            Self::Ellipse { width, height } => {
                let area = 0.25 * PI * width * height;
                let moments = [height, width].map(|axis| area * axis * axis / 16.0);
                let [first, second] = moments;
                (area, moments, 4.0 * first * second / (first + second))
            }
            Self::HollowEllipse {
                width,
                height,
                inner_width,
            } => {
                let whole = Self::Ellipse { width, height };
                let (area, moments, torsion) = whole.closed_numbers();
                let square = (inner_width / width).powi(2);
                let left = 1.0 - square * square;
                let moments = moments.map(|moment| moment * left);
                (area * (1.0 - square), moments, torsion * left)
            }
            Self::Circle { radius } => {
                let area = PI * radius * radius;
                let moment = 0.25 * area * radius * radius;
                (area, [moment; 2], 2.0 * moment)
            }
            Self::Tube {
                radius,
                inner_radius,
            } => {
                let area = PI * (radius - inner_radius) * (radius + inner_radius);
                let squares = radius * radius + inner_radius * inner_radius;
                let moment = 0.25 * area * squares;
                (area, [moment; 2], 2.0 * moment)
            }
            Self::Box { .. }
            | Self::I { .. }
            | Self::C { .. }
            | Self::T { .. }
            | Self::L { .. }
            | Self::Polygon { .. } => unreachable!("polygons have numbers of their outline"),
        }
    }

    /// Ratios of the areas that carry shear along both axes to the area, at a ratio of Poisson, where they have a closed form (G. R. Cowper,
    /// The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340).
    pub fn shear_factors(&self, poisson: f64) -> Option<[f64; 2]> {
        let once = 1.0 + poisson;
        Some(match *self {
            Self::Rectangle { .. } => [10.0 * once / (12.0 + 11.0 * poisson); 2],
            Self::Ellipse { width, height } => [width / height, height / width].map(|ratio| {
                let n = ratio * ratio;
                let under = (40.0 + 37.0 * poisson) * n * n + (16.0 + 10.0 * poisson) * n;
                12.0 * once * n * (3.0 * n + 1.0) / (under + poisson)
            }),
            Self::Circle { .. } => [6.0 * once / (7.0 + 6.0 * poisson); 2],
            Self::Tube {
                radius,
                inner_radius,
            } => {
                let hole = (inner_radius / radius).powi(2);
                let square = (1.0 + hole).powi(2);
                let under = (7.0 + 6.0 * poisson) * square + (20.0 + 12.0 * poisson) * hole;
                [6.0 * once * square / under; 2]
            }
            _ => return None,
        })
    }

    /// Torsion constant, shear centre and shear compliance. `None` of an outline that is none.
    pub fn shear(&self) -> Option<ShearNumbers> {
        let Some([early, late]) = self
            .shear_factors(0.0)
            .zip(self.shear_factors(1.0))
            .map(<[_; 2]>::from)
        else {
            return solved::numbers(self);
        };
        // Closed forms are linear in Poisson's ratio over one plus this ratio.
        let (area, _, torsion_constant) = self.closed_numbers();
        let diagonal = |of: [f64; 2]| Matrix2::from_diagonal(&of.into());
        let first = early.map(|factor| 2.0 / (factor * area));
        let both = late.map(|factor| 4.0 / (factor * area));
        Some(ShearNumbers {
            torsion_constant,
            error: 0.0,
            shear_center: [0.0; 2],
            compliance: [diagonal(first), diagonal(both) - diagonal(first)],
        })
    }

    /// Whether there is a hole in it.
    pub fn has_hole(&self) -> bool {
        match self {
            Self::Tube { .. } | Self::HollowEllipse { .. } | Self::Box { .. } => true,
            Self::Polygon { holes, .. } => !holes.is_empty(),
            _ => false,
        }
    }

    /// Area, m^2.
    pub(super) fn area(&self) -> f64 {
        match self.outline() {
            Some(outline) => outline.area,
            None => self.closed_numbers().0,
        }
    }

    /// Area inside the outline, holes included, m^2.
    pub fn whole_area(&self) -> f64 {
        match *self {
            Self::HollowEllipse { width, height, .. } => 0.25 * PI * width * height,
            Self::Tube { radius, .. } => PI * radius * radius,
            _ => match self.outline() {
                Some(outline) => outline.whole_area(),
                None => self.closed_numbers().0,
            },
        }
    }

    /// Shape between this one and another of its kind, whose part counts. Polygons with as many corners and holes are of one kind.
    pub fn between(&self, other: &Self, part: f64) -> Option<Self> {
        let (mut shape, mut other) = (self.clone(), other.clone());
        if !shape.is_like(&other) {
            return None;
        }
        let lengths = shape.lengths().into_iter().zip(other.lengths());
        for ((.., length), (.., end)) in lengths {
            *length += part * (*end - *length);
        }
        let corners = shape.corners().zip(other.corners());
        for (at, end) in corners {
            *at += part * (*end - *at);
        }
        Some(shape)
    }

    /// Whether shapes between this one and another exist.
    pub fn is_like(&self, other: &Self) -> bool {
        let counts = |of: &Self| {
            let loops = of.loops().into_iter().flatten();
            loops.map(|corners| corners.len()).collect::<Vec<_>>()
        };
        self.key() == other.key() && counts(self) == counts(other)
    }

    /// Coordinates of the corners of a polygon, m.
    fn corners(&mut self) -> impl Iterator<Item = &mut f64> {
        let (outline, holes): (&mut [_], &mut [_]) = match self {
            Self::Polygon { outline, holes } => (outline, holes),
            _ => (&mut [], &mut []),
        };
        let corners = outline.iter_mut().chain(holes.iter_mut().flatten());
        corners.flatten()
    }
}

/// Torsion constant of a rectangle, m^4: the series for the stress function, whose terms fall with the fifth power.
fn torsion_of_rectangle(width: f64, height: f64) -> f64 {
    let (long, short) = (width.max(height), width.min(height));
    let term = |k: u32| {
        let n = f64::from(2 * k + 1);
        (0.5 * n * PI * long / short).tanh() / n.powi(5)
    };
    let sum: f64 = (0..200).rev().map(term).sum();
    long * short.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * short / long * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Timoshenko and Goodier, section 109, table: `J / (long short^3)`.
    #[test]
    fn torsion_constants_of_rectangles_are_those_of_the_table() {
        for (ratio, wanted) in [
            (1.0, 0.1406),
            (1.5, 0.196),
            (2.0, 0.229),
            (4.0, 0.281),
            (10.0, 0.312),
        ] {
            let found = torsion_of_rectangle(3.0, 3.0 * ratio) / (81.0 * ratio);
            assert!((found - wanted).abs() < 6e-4, "{ratio} {found}");
        }
        // A square, to ten digits (144 times 0.140577014955).
        let square = torsion_of_rectangle(1.0, 1.0);
        assert!((square - 0.140_577_014_955).abs() < 1e-11, "{square}");
        assert_eq!(
            torsion_of_rectangle(0.3, 0.1),
            torsion_of_rectangle(0.1, 0.3)
        );
    }

    #[test]
    fn shapes_that_coincide_have_the_same_numbers() {
        let circle = Profile::Circle { radius: 0.02 }.numbers();
        let ellipse = Profile::Ellipse {
            width: 0.04,
            height: 0.04,
        };
        let tube = Profile::Tube {
            radius: 0.02,
            inner_radius: 0.0,
        };
        for shape in [ellipse, tube] {
            let found = shape.numbers();
            assert!((found.area / circle.area - 1.0).abs() < 1e-15);
            assert!((found.second_moments[0] / circle.second_moments[0] - 1.0).abs() < 1e-15);
            assert!((found.torsion_constant / circle.torsion_constant - 1.0).abs() < 1e-15);
        }
        let flat = Profile::Rectangle {
            width: 0.3,
            height: 0.1,
        };
        let [first, second] = flat.numbers().second_moments;
        assert!(
            (first - 0.3 * 1e-3 / 12.0).abs() < 1e-18
                && (second - 0.1 * 0.027 / 12.0).abs() < 1e-18
        );
    }
}
