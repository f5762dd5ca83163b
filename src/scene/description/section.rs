//! Cross sections of cables, rods and beams.

use std::f64::consts::PI;

use nalgebra::{Matrix6, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cross section of a cable or a rod: its shape, or its numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Shape of the section, from which all numbers follow. Without it the numbers are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Profile>,
    /// Area, m^2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area: Option<f64>,
    /// Second moment of area of cables and of planar beams, m^4; 0 is a cable without bending stiffness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub second_moment: Option<f64>,
    /// Second moments of area of rods and beams in space for bending about the first and about the second axis of the section, m^4.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_moments: Option<[f64; 2]>,
    /// Torsion constant (of Saint-Venant) of rods and beams in space, m^4; of a circle its polar second moment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torsion_constant: Option<f64>,
    /// Stiffness of rods of layered or otherwise anisotropic material that couples twist with bending about the first axis, twist
    /// with bending about the second, and both bendings, N m^2; none where nothing is said. Torque is the first times the curvature
    /// about the first axis, and so on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coupling: Option<[f64; 3]>,
    /// Stiffness of rods that couples stretching with twist, with bending about the first axis and with bending about the second, N m; none
    /// where nothing is said. The axial force is the first times the twist, and so on: ropes of wires untwist when they are pulled. An
    /// elastic centre at `[y, z]` is `[0, E A z, -E A y]`, with second moments about the line and `coupling` `-E A y z` of both bendings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axial_coupling: Option<[f64; 3]>,
    /// Ratios, for beams in space, of the areas that carry shear along the first and along the second axis to the area. Of a shape, where
    /// nothing is said, those of Cowper, which take the material's ratio of Poisson.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_factors: Option<[f64; 2]>,
    /// Ratio of the area that carries shear to the area, for beams in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_factor: Option<f64>,
    /// Whole stiffness matrix of the section of beams, instead of a shape or numbers and of the moduli of the material. Symmetric, in the
    /// order axial force, shear along the first axis, along the second, torque, moment about the first axis, about the second; N, N m, N m^2.
    /// In the plane, which the first axis is across, axial force, shear along the second and moment about the first count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<[[f64; 6]; 6]>,
    /// Mass and inertia per length of beams with `stiffness`, in the same order: kg/m, kg, kg m. The centre of mass is on the line, and
    /// the section lies across it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[[f64; 6]; 6]>,
    /// Where both are given about: coordinates along the first and the second axis from the line of the body, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<[f64; 2]>,
}

/// Shape of a cross section, from which its numbers follow. Its centre is on the line of the body. Axes are those of the section of a rod; a
/// cable in the plane has the first across the plane, so that its height lies in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
}

/// The cross section at a place along a body. Between two stations shapes of one kind change their sizes linearly, numbers
/// change linearly themselves; two stations at one place are a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Station {
    /// Material coordinate: 0 is the first end, 1 the last.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f64,
    /// Cross section there.
    pub section: Section,
    /// Angle of rods and beams about the tangent by which the section's axes are turned there, without stress, from where they would be
    /// untwisted, rad.
    #[serde(default)]
    pub twist: f64,
}

/// Numbers of a cross section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionNumbers {
    /// Area, m^2.
    pub area: f64,
    /// Second moments of area about the first and the second axis, m^4; in the plane the first counts.
    pub second_moments: [f64; 2],
    /// Torsion constant of Saint-Venant, m^4.
    pub torsion_constant: f64,
    /// Stiffness that couples twist with bending about both axes, and both bendings, N m^2.
    pub coupling: [f64; 3],
    /// Stiffness that couples stretching with twist and with bending about both axes, N m.
    pub axial_coupling: [f64; 3],
    /// Ratios of shear areas to the area, where they are said.
    pub shear_factors: Option<[f64; 2]>,
    /// The shape that these are of.
    pub shape: Option<Profile>,
    /// The whole section of a beam, where it is given.
    pub given: Option<Given>,
}

/// Stiffness and inertia per length of a beam's section about its line, as whole matrices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Stiffness, N, N m, N m^2.
    pub stiffness: Matrix6<f64>,
    /// Mass and inertia per length, kg/m, kg, kg m.
    pub inertia: Matrix6<f64>,
}

impl Profile {
    /// Lengths of the shape, m, with their keys and meanings.
    pub fn lengths(&mut self) -> Vec<(&'static str, &'static str, &mut f64)> {
        const RADIUS: &str = "Radius of the cross section";
        match self {
            Self::Rectangle { width, height } | Self::Ellipse { width, height } => vec![
                ("width", "Width of the cross section", width),
                ("height", "Height of the cross section", height),
            ],
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
        }
    }

    /// Key of the shape in a scene.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "rectangle",
            Self::Ellipse { .. } => "ellipse",
            Self::Circle { .. } => "circle",
            Self::Tube { .. } => "tube",
        }
    }

    /// Area, second moments and torsion constant (S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), sections
    /// 106, 107 and 109).
    pub fn numbers(&self) -> SectionNumbers {
        let (area, second_moments, torsion_constant) = match *self {
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
        };
        SectionNumbers {
            area,
            second_moments,
            torsion_constant,
            shape: Some(*self),
            ..SectionNumbers::default()
        }
    }

    /// Ratios of the areas that carry shear along both axes to the area, at a ratio of Poisson (G. R. Cowper, The shear coefficient in
    /// Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335-340).
    pub fn shear_factors(&self, poisson: f64) -> [f64; 2] {
        let once = 1.0 + poisson;
        match *self {
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
        }
    }

    /// The shape between this one and another of its kind, whose part counts.
    fn between(&self, other: &Self, part: f64) -> Option<Self> {
        let (mut shape, mut other) = (*self, *other);
        if shape.key() != other.key() {
            return None;
        }
        let lengths = shape.lengths().into_iter().zip(other.lengths());
        for ((.., length), (.., end)) in lengths {
            *length += part * (*end - *length);
        }
        Some(shape)
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

impl Section {
    /// Whether nothing is said of it.
    pub fn is_unsaid(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the numbers of the section, as given or of its shape.
    pub fn numbers(&self) -> SectionNumbers {
        if let Some(shape) = &self.shape {
            return SectionNumbers {
                coupling: self.coupling.unwrap_or_default(),
                axial_coupling: self.axial_coupling.unwrap_or_default(),
                shear_factors: self.shear_factors(),
                ..shape.numbers()
            };
        }
        let alike = [self.second_moment.unwrap_or_default(); 2];
        SectionNumbers {
            area: self.area.unwrap_or_default(),
            second_moments: self.second_moments.unwrap_or(alike),
            torsion_constant: self.torsion_constant.unwrap_or_default(),
            coupling: self.coupling.unwrap_or_default(),
            axial_coupling: self.axial_coupling.unwrap_or_default(),
            shear_factors: self.shear_factors(),
            shape: None,
            given: self.given(),
        }
    }

    /// Ratios of shear areas to the area as said, in the plane the same twice.
    pub fn shear_factors(&self) -> Option<[f64; 2]> {
        let planar = self.shear_factor.map(|factor| [factor; 2]);
        self.shear_factors.or(planar)
    }

    /// Stiffness and inertia as given, about the line.
    pub fn given(&self) -> Option<Given> {
        let [y, z] = self.about.unwrap_or_default();
        // What is seen at a point `p` of the section: `v + w x p`.
        let mut seen = Matrix6::identity();
        let back = -Vector3::new(0.0, y, z).cross_matrix();
        seen.fixed_view_mut::<3, 3>(0, 3).copy_from(&back);
        let moved = |rows: [[f64; 6]; 6]| seen.transpose() * Matrix6::from(rows) * seen;
        Some(Given {
            stiffness: moved(self.stiffness?),
            inertia: moved(self.inertia?),
        })
    }

    /// Numbers of the section between this one and another, whose part counts.
    fn between(&self, other: &Self, part: f64) -> SectionNumbers {
        if let (Some(shape), Some(end)) = (&self.shape, &other.shape)
            && let Some(shape) = shape.between(end, part)
        {
            let mixed = self.numbers().mixed(&other.numbers(), part);
            let section = Self {
                shape: Some(shape),
                coupling: Some(mixed.coupling),
                axial_coupling: Some(mixed.axial_coupling),
                shear_factors: mixed.shear_factors,
                ..Self::default()
            };
            return section.numbers();
        }
        self.numbers().mixed(&other.numbers(), part)
    }
}

impl SectionNumbers {
    /// Diameter of its outline, m: the outer one of a circle or tube, else that of a circle of its area.
    pub fn diameter(&self) -> f64 {
        match self.shape {
            Some(Profile::Circle { radius } | Profile::Tube { radius, .. }) => 2.0 * radius,
            Some(Profile::Rectangle { .. } | Profile::Ellipse { .. }) | None => {
                2.0 * (self.area / PI).sqrt()
            }
        }
    }

    /// Linear between these and others, whose part counts.
    fn mixed(&self, other: &Self, part: f64) -> Self {
        let mix = |a: f64, b: f64| a + part * (b - a);
        let three = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| mix(a[k], b[k]));
        let [first, second] = self.second_moments;
        Self {
            area: mix(self.area, other.area),
            second_moments: [
                mix(first, other.second_moments[0]),
                mix(second, other.second_moments[1]),
            ],
            torsion_constant: mix(self.torsion_constant, other.torsion_constant),
            coupling: three(self.coupling, other.coupling),
            axial_coupling: three(self.axial_coupling, other.axial_coupling),
            shear_factors: (self.shear_factors.zip(other.shear_factors))
                .map(|([a, b], [c, d])| [mix(a, c), mix(b, d)]),
            shape: None,
            given: self.given.zip(other.given).map(|(a, b)| Given {
                stiffness: a.stiffness + (b.stiffness - a.stiffness) * part,
                inertia: a.inertia + (b.inertia - a.inertia) * part,
            }),
        }
    }
}

/// Numbers of the section at a part in [0, 1] of the way from one station to the next, and its twist, rad.
pub fn between(first: &Station, last: &Station, part: f64) -> (SectionNumbers, f64) {
    let numbers = first.section.between(&last.section, part);
    (numbers, first.twist + part * (last.twist - first.twist))
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
