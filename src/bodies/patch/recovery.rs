//! Strains and curvatures at a place of a patch, recovered from the elements around it to the order of displacements.
//!
//! Elements have cubic displacements, and second derivatives at a place are of order 2 alone. Of a component 11 or 22 the line along its own
//! direction that is nearest to it in an element is of order 4, of 12 the values at the places of Lobatto. A polynomial with these parts over a
//! window of elements gives the value. Weights are products of those along both directions.
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Eng. 33 (1992) 1331-1364 (recovery from patches); J. Barlow, Int. J. Numer.
//! Meth. Eng. 10 (1976) 243-251 (places where stresses are best).

use nalgebra::{DMatrix, DVector};

use super::Patch;
use crate::bodies::connectivity::Node;
use crate::elements::shell::{GaussStrains, ShellSection};
use crate::math::jet::Number;
use crate::math::quadrature::{GAUSS_3, GAUSS_5};

/// Elements of a window, and those of the two windows about a mesh line.
const WINDOW: usize = 3;
const MOST: usize = WINDOW + 1;
/// Places of Lobatto in an element.
const LOBATTO: [f64; 3] = [0.0, 0.5, 1.0];
/// Distance from a mesh line, relative to an element, up to which a place is on it.
const ON_LINE: f64 = 1e-9;
/// Singular values, relative to the largest, that are none.
const SINGULAR: f64 = 1e-9;

/// What values at the places of Gauss of an element are of a smooth function along a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sampling {
    /// Its values.
    Direct,
    /// The parabola through its values at the places of Lobatto.
    Lobatto,
    /// The line that is nearest to it in the mean of squares.
    Projected,
}

/// Samplings of each component, of strains as of curvatures, along both directions.
const SAMPLINGS: [[Sampling; 2]; 3] = [
    [Sampling::Projected, Sampling::Direct],
    [Sampling::Direct, Sampling::Projected],
    [Sampling::Lobatto, Sampling::Lobatto],
];

/// Weights, for the value at a place along a direction, of the places of Gauss of elements around it, by [`Sampling`], element and place.
#[derive(Clone, Copy, Debug)]
pub(super) struct RecoveryLine {
    first: usize,
    count: usize,
    weights: [[[f64; 3]; MOST]; 3],
}

/// A place of a patch where strains are read, with its section.
#[derive(Clone, Debug)]
pub(super) struct PatchSection {
    lines: [RecoveryLine; 2],
    /// Takes covariant components to those along the axes of the section.
    to_axes: [[f64; 3]; 3],
    section: ShellSection,
}

impl Sampling {
    /// Values at the places of Gauss, of the powers up to a degree of the distance from `origin` over `scale`, for an element.
    fn powers(
        self,
        [from, to]: [f64; 2],
        (origin, scale): (f64, f64),
        degree: usize,
    ) -> DMatrix<f64> {
        let power = |at: f64, k: usize| {
            let x = (from + (to - from) * at - origin) / scale;
            x.powi(i32::try_from(k).unwrap_or(i32::MAX))
        };
        DMatrix::from_fn(GAUSS_3.len(), degree + 1, |place, k| {
            let at = GAUSS_3[place].at;
            match self {
                Self::Direct => power(at, k),
                Self::Lobatto => {
                    let [a, b, c] = LOBATTO.map(|at| power(at, k));
                    let y = 2.0 * at - 1.0;
                    b + 0.5 * y * (c - a) + 0.5 * y * y * (a - 2.0 * b + c)
                }
                Self::Projected => {
                    let mean = |of: &dyn Fn(f64) -> f64| -> f64 {
                        let points = GAUSS_5.iter();
                        points.map(|p| p.weight * of(p.at) * power(p.at, k)).sum()
                    };
                    let slope = 3.0 * mean(&|at| 2.0 * at - 1.0);
                    mean(&|_| 1.0) + slope * (2.0 * at - 1.0)
                }
            }
        })
    }

    /// Degree of the polynomial over so many elements.
    fn degree(self, elements: usize) -> usize {
        let least = if self == Self::Projected { 1 } else { 2 };
        (2 * elements - 1).max(least)
    }

    /// Weights of the places of Gauss of the elements between these mesh lines in the value at a place.
    fn weights(self, lines: &[f64], at: f64) -> DVector<f64> {
        let count = lines.len() - 1;
        let scale = 0.5 * (lines[count] - lines[0]);
        let origin = lines[0] + scale;
        let degree = self.degree(count);
        let mut powers = DMatrix::zeros(3 * count, degree + 1);
        let mut roots = DVector::zeros(3 * count);
        for element in 0..count {
            let ends = [lines[element], lines[element + 1]];
            let own = self.powers(ends, (origin, scale), degree);
            powers.rows_mut(3 * element, 3).copy_from(&own);
            for (place, point) in GAUSS_3.iter().enumerate() {
                roots[3 * element + place] = (point.weight * (ends[1] - ends[0])).sqrt();
            }
        }
        for (mut row, root) in powers.row_iter_mut().zip(&roots) {
            row *= *root;
        }
        let mut value = DVector::from_element(degree + 1, 1.0);
        for k in 1..=degree {
            value[k] = value[k - 1] * (at - origin) / scale;
        }
        let inverse = powers.pseudo_inverse(SINGULAR);
        let inverse = inverse.unwrap_or_else(|_| unreachable!("the bound is positive"));
        (inverse.transpose() * value).component_mul(&roots)
    }
}

impl RecoveryLine {
    /// Weights for a place (m) along mesh lines; on an inner line the mean of those of the windows of either side.
    pub fn new(lines: &[f64], at: f64) -> Self {
        let elements = lines.len() - 1;
        let element = |at: f64| lines.partition_point(|line| *line <= at).clamp(1, elements) - 1;
        let slack = |k: usize| ON_LINE * (lines[k + 1] - lines[k]);
        let on = element(at);
        let sides = [at - slack(on), at + slack(on)].map(element);
        let size = WINDOW.min(elements);
        let starts = sides.map(|side| side.saturating_sub(WINDOW / 2).min(elements - size));
        let mut made = Self {
            first: starts[0],
            count: starts[1] + size - starts[0],
            weights: [[[0.0; 3]; MOST]; 3],
        };
        for sampling in [Sampling::Direct, Sampling::Lobatto, Sampling::Projected] {
            let windows = if starts[0] == starts[1] { 1 } else { 2 };
            for start in &starts[..windows] {
                let weights = sampling.weights(&lines[*start..=start + size], at);
                let own = &mut made.weights[sampling as usize][start - starts[0]..];
                let sums = own.as_flattened_mut().iter_mut();
                sums.zip(&weights)
                    .for_each(|(sum, weight)| *sum += weight / windows as f64);
            }
        }
        made
    }
}

impl Patch {
    /// Weights at a place along direction `k`, by its coordinate in [0, 1].
    pub(super) fn recovery_line(&self, k: usize, at: f64) -> RecoveryLine {
        RecoveryLine::new(&self.lines[k], at * self.lengths()[k])
    }

    /// The section at a place, by material coordinates, with what strains there are recovered by.
    pub(super) fn patch_section(&self, at: [f64; 2], section: &ShellSection) -> PatchSection {
        let (element, xi) = self.find(at);
        PatchSection {
            lines: [0, 1].map(|k| self.recovery_line(k, at[k])),
            to_axes: section.axes_transformation(&self.tangents(element, xi)),
            section: *section,
        }
    }

    /// The section of a point that is read.
    fn section_at(&self, point: usize) -> &PatchSection {
        let section = self.sections[point].as_ref();
        section.unwrap_or_else(|| unreachable!("a patch is told which sections are read"))
    }

    /// Membrane strains and changes of curvature (1/m) at a point along the axes of its section, 11, 22 and twice 12; with rates of the
    /// nodes plus the damping time times their rates.
    pub fn section_strain<const D: usize, N: Number>(
        &self,
        point: usize,
        x: &[Node<D, N>],
        v: Option<&[Node<D, N>]>,
    ) -> [[N; 3]; 2] {
        let PatchSection { lines, to_axes, .. } = self.section_at(point);
        let strains = |element: usize| {
            let rates = v.map(|v| self.element(element, v));
            self.elements[element].strains(&self.element(element, x), rates.as_ref())
        };
        let covariant = self.recovered([&lines[0], &lines[1]], strains);
        covariant.map(|of| times(to_axes, of))
    }

    /// Forces (N/m) and moments (N) per length at a point along the axes of its section, of strains and curvatures there.
    pub fn section_force<N: Number>(
        &self,
        point: usize,
        [strain, curvature]: [[N; 3]; 2],
    ) -> [[N; 3]; 2] {
        let ShellSection {
            membrane,
            coupling,
            bending,
            ..
        } = &self.section_at(point).section;
        let less = |a: [N; 3], b: [N; 3]| std::array::from_fn(|k| a[k] - b[k]);
        [
            less(times(membrane, strain), times(coupling, curvature)),
            less(times(bending, curvature), times(coupling, strain)),
        ]
    }

    /// Covariant strains and curvatures at a place, of those at the places of Gauss of each element.
    pub(super) fn recovered<N: Number>(
        &self,
        lines: [&RecoveryLine; 2],
        mut strains: impl FnMut(usize) -> GaussStrains<N>,
    ) -> [[N; 3]; 2] {
        let mut sums = [[N::of(0.0); 3]; 2];
        for i in 0..lines[0].count {
            for j in 0..lines[1].count {
                let across = self.lines[1].len() - 1;
                let of = strains((lines[0].first + i) * across + lines[1].first + j);
                for (part, sums) in sums.iter_mut().enumerate() {
                    for (component, sum) in sums.iter_mut().enumerate() {
                        let [first, second] = SAMPLINGS[component];
                        let first = &lines[0].weights[first as usize][i];
                        let second = &lines[1].weights[second as usize][j];
                        for (row, by) in of[part][component].iter().zip(first) {
                            for (value, weight) in row.iter().zip(second) {
                                *sum += *value * N::of(by * weight);
                            }
                        }
                    }
                }
            }
        }
        sums
    }
}

/// Stress 11, 22 and 12 by a law at a height (m) along the normal, of membrane strains and changes of curvature, Pa.
pub fn stress_at<N: Number>(
    (height, law): (f64, &[[f64; 3]; 3]),
    [strain, curvature]: [[N; 3]; 2],
) -> [N; 3] {
    let strain = |k: usize| strain[k] - N::of(height) * curvature[k];
    times(law, std::array::from_fn(strain))
}

/// A matrix times components.
pub(super) fn times<N: Number>(matrix: &[[f64; 3]; 3], of: [N; 3]) -> [N; 3] {
    matrix.map(|row| N::of(row[0]) * of[0] + N::of(row[1]) * of[1] + N::of(row[2]) * of[2])
}
