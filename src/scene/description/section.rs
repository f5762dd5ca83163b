//! Cross sections of cables, rods and beams.

use std::f64::consts::PI;

use nalgebra::{Matrix6, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::Profile;
use super::solved;
use crate::elements::saint_venant::ShearNumbers;

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
    /// Angle of rods and beams about the tangent by which the section's axes are rotated there, without stress, from where they would be
    /// untwisted, rad.
    #[serde(default)]
    pub twist: f64,
}

/// Numbers of a cross section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionNumbers {
    /// Area, m^2.
    pub area: f64,
    /// Second moments of area about the first and the second axis, m^4; in the plane the first counts.
    pub second_moments: [f64; 2],
    /// Integral of the product of both coordinates, m^4.
    pub product_moment: f64,
    /// Torsion constant of Saint-Venant, m^4.
    pub torsion_constant: f64,
    /// Stiffness that couples twist with bending about both axes, and both bendings, N m^2.
    pub coupling: [f64; 3],
    /// Stiffness that couples stretching with twist and with bending about both axes, N m.
    pub axial_coupling: [f64; 3],
    /// Ratios of shear areas to the area, where they are said.
    pub shear_factors: Option<[f64; 2]>,
    /// Shear compliance and shear centre as they follow from a shape or from shapes on both sides.
    pub shear: Option<ShearNumbers>,
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
            product_moment: 0.0,
            torsion_constant: self.torsion_constant.unwrap_or_default(),
            coupling: self.coupling.unwrap_or_default(),
            axial_coupling: self.axial_coupling.unwrap_or_default(),
            shear_factors: self.shear_factors(),
            shear: None,
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
            && let Some(between) = shape.between(end, part)
        {
            let mixed = self.numbers().mixed(&other.numbers(), part);
            let numbers = match between.solved_loops() {
                Some(_) => between.numbers_with(solved::between([shape, end], part)),
                None => between.numbers(),
            };
            return SectionNumbers {
                coupling: mixed.coupling,
                axial_coupling: mixed.axial_coupling,
                shear_factors: mixed.shear_factors,
                ..numbers
            };
        }
        self.numbers().mixed(&other.numbers(), part)
    }
}

impl SectionNumbers {
    /// Diameter of its outline, m: of a circle with the area inside it, holes included.
    pub fn diameter(&self) -> f64 {
        match &self.shape {
            Some(Profile::Circle { radius } | Profile::Tube { radius, .. }) => 2.0 * radius,
            Some(shape) if shape.has_hole() => 2.0 * (shape.whole_area() / PI).sqrt(),
            _ => 2.0 * (self.area / PI).sqrt(),
        }
    }

    /// Largest second moment of area about any axis, m^4.
    pub fn largest_moment(&self) -> f64 {
        let [first, second] = self.second_moments;
        if self.product_moment == 0.0 {
            return first.max(second);
        }
        0.5 * (first + second + self.principal_difference())
    }

    /// Difference of the second moments about both principal axes, m^4.
    pub fn principal_difference(&self) -> f64 {
        let [first, second] = self.second_moments;
        if self.product_moment == 0.0 {
            return (second - first).abs();
        }
        (second - first).hypot(2.0 * self.product_moment)
    }

    /// Whether it bends alike to all sides, up to roundoff.
    pub fn is_alike(&self) -> bool {
        let [first, second] = self.second_moments;
        first == second && self.product_moment == 0.0
            || self.principal_difference() <= 1e-9 * (first + second)
    }

    /// Shear centre from the line, m.
    pub fn shear_center(&self) -> [f64; 2] {
        self.shear.map_or([0.0; 2], |shear| shear.shear_center)
    }

    /// Whether the shear centre is apart from the line, by more than a thousandth of the radius of gyration.
    pub fn is_eccentric(&self) -> bool {
        let [y, z] = self.shear_center();
        let [first, second] = self.second_moments;
        y.hypot(z) > 1e-3 * ((first + second) / self.area).sqrt()
    }

    /// Normal stress at a point, first and second coordinate in m, by the moments about both axes, 1/m^3.
    pub fn stress_by_moments(&self, [y, z]: [f64; 2]) -> [f64; 2] {
        // On the line of what does not bend there is no more than the force.
        let over = |way: f64, moment: f64| if way == 0.0 { 0.0 } else { way / moment };
        let ([first, second], product) = (self.second_moments, self.product_moment);
        if product == 0.0 {
            return [over(z, first), -over(y, second)];
        }
        let determinant = first * second - product * product;
        [
            (second * z - product * y) / determinant,
            (product * z - first * y) / determinant,
        ]
    }

    /// Shear compliance and shear centre, by a closed form where there is one.
    fn known_shear(&self) -> Option<ShearNumbers> {
        self.shear.or_else(|| self.shape.as_ref()?.shear())
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
            product_moment: mix(self.product_moment, other.product_moment),
            torsion_constant: mix(self.torsion_constant, other.torsion_constant),
            coupling: three(self.coupling, other.coupling),
            axial_coupling: three(self.axial_coupling, other.axial_coupling),
            shear_factors: (self.shear_factors.zip(other.shear_factors))
                .map(|([a, b], [c, d])| [mix(a, c), mix(b, d)]),
            shear: (self.known_shear().zip(other.known_shear()))
                .map(|(a, b)| solved::mixed([&a, &b], part)),
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

    /// Between a square and a circle the shear compliance is linear, as there is no shape in between; it does not fall back to that of the
    /// area alone.
    #[test]
    fn shear_between_shapes_of_two_kinds_is_mixed() {
        let ends = [
            Profile::Rectangle {
                width: 0.1,
                height: 0.1,
            },
            Profile::Circle { radius: 0.05 },
        ];
        let stations = [0.0, 1.0].map(|at| Station {
            at,
            section: Section {
                shape: Some(ends[at as usize].clone()),
                ..Section::default()
            },
            twist: 0.0,
        });
        let [first, last] = &stations;
        let found = between(first, last, 0.25).0.shear.expect("compliance");
        // Cowper, without lateral contraction: 5/6 of a rectangle, 6/7 of a circle, in compliance per (1 + nu) / E.
        let wanted = 0.75 * 2.0 * 6.0 / 5.0 / 0.01 + 0.25 * 2.0 * 7.0 / 6.0 / (PI * 0.0025);
        for k in 0..2 {
            let compliance = found.compliance[0][(k, k)];
            assert!(
                (compliance / wanted - 1.0).abs() < 1e-12,
                "{compliance} {wanted}"
            );
        }
    }
}
