//! Straight lines of sections reduced to modes: rods and beams that bend little.
//!
//! Strains `e` (stretch and shear) and `k` (twist and curvatures) along the axes of the sections are linear in amplitudes. A section rotates by
//! `Q' = Q k~` and its point moves by `r' = Q (e1 + e)`, so that both follow to second order by integration from the first end:
//! `Q = I + phi~ + W / 2`, `phi' = k`, `W_kl' = phi_k~ k_l~ + phi_l~ k_k~`, and `r_k' = phi_k x e1 + e_k`,
//! `r_kl' = W_kl e1 + phi_k x e_l + phi_l x e_k`. The strain energy is quadratic without cubic terms. Strains are of degree 2 in every segment.
//!
//! Source: J. C. Simo, A finite strain beam formulation. The three-dimensional dynamic problem. Part I, Comput. Methods Appl. Mech. Eng. 49
//! (1985) 55-70 (strains); T. R. Kane, R. R. Ryan, A. K. Banerjee, Dynamics of a cantilever beam attached to a moving base, J. Guid. Control
//! Dyn. 10 (1987) 139-151 (second-order displacements of beams).

#[cfg(test)]
mod tests;

use std::ops::{Add, Mul, Sub};

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::{Interface, ModalBasis, ReducedModel, Symmetric};
use crate::math::eigen::symmetric_eigenvectors;
use crate::math::quadrature::{GAUSS_5, integrals_to};

/// Points of a segment at which sections are read.
const POINTS: usize = GAUSS_5.len();
/// Numbers of a strain in a segment: its values at both ends and in the middle.
const SHAPES: usize = 3;
/// Part of the largest square of a period below which modes are left out: roundoff.
const FASTEST: f64 = 1e-12;

/// A section of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSection {
    /// Mass per length, kg/m.
    pub density: f64,
    /// Rotary inertia per length about the line and both axes, kg m.
    pub rotary: Matrix3<f64>,
    /// Forces and moments by stretch, shear along both axes, twist and both curvatures, N, N m, N m^2.
    pub stiffness: Matrix6<f64>,
}

/// A straight line of sections, along the first of its axes, from its first end.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightLine {
    /// Places of the ends of its segments, ascending from 0, m.
    pub ends: Vec<f64>,
    /// Sections at the points of [`GAUSS_5`] of every segment.
    pub sections: Vec<[LineSection; POINTS]>,
    /// Strains that are not held, by their places among six: without 1 and 2 sections stay across the line.
    pub strains: &'static [usize],
    /// Names of its markers and the ends of segments that they are at.
    pub markers: Vec<(String, usize)>,
}

/// A straight line reduced to all modes that its segments allow, from which bases are taken.
#[derive(Clone, Debug, PartialEq)]
pub struct LineModes {
    line: StraightLine,
    /// Place of the centre of mass from the first end, m.
    pub center: Vector3<f64>,
    /// Principal axes in the axes of the line, as columns.
    pub axes: Matrix3<f64>,
    /// Masses at the points of all segments.
    masses: Vec<SectionMass>,
    /// Places of the points, and of the ends of segments, without deformation.
    places: Field,
    /// Strains of the modes, `[strains of all segments][modes]`.
    columns: DMatrix<f64>,
    /// The model without second-order terms.
    linear: ReducedModel,
}

/// Mass of a section at a point of a quadrature.
#[derive(Clone, Debug, PartialEq)]
struct SectionMass {
    /// Mass, kg.
    mass: f64,
    /// Integral of ways from the line by themselves, kg m^2.
    spread: Matrix3<f64>,
}

/// A displacement of a section: of its point on the line, and of ways from it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moved {
    at: Vector3<f64>,
    by: Matrix3<f64>,
}

/// Displacements of sections at the points of all segments and at their ends.
#[derive(Clone, Debug, PartialEq)]
struct Field {
    points: Vec<Moved>,
    ends: Vec<Moved>,
}

/// A field along a line.
struct Along<const C: usize> {
    points: Vec<SMatrix<f64, 3, C>>,
    ends: Vec<SMatrix<f64, 3, C>>,
}

/// A mode: strains, rotations and the field against the first end, and against mean axes.
struct Mode {
    /// Stretch and shear, and twist and curvatures, at the points of all segments.
    strains: Vec<[Vector3<f64>; 2]>,
    rotation: Along<1>,
    /// Rotation of the mean axes, in principal axes.
    turn: Vector3<f64>,
    /// Displacements against the mean axes, in principal axes.
    field: Field,
}

impl Add for Moved {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            at: self.at + other.at,
            by: self.by + other.by,
        }
    }
}

impl Sub for Moved {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Moved {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            at: self.at * factor,
            by: self.by * factor,
        }
    }
}

impl Moved {
    /// Carries it by a matrix from the left.
    fn carried(&self, by: &Matrix3<f64>) -> Self {
        Self {
            at: by * self.at,
            by: by * self.by,
        }
    }

    /// In axes that stand as the columns of a matrix.
    fn in_axes(&self, axes: &Matrix3<f64>) -> Self {
        Self {
            at: axes.tr_mul(&self.at),
            by: axes.tr_mul(&self.by) * axes,
        }
    }
}

impl Field {
    fn map(&self, of: impl Fn(&Moved) -> Moved) -> Self {
        Self {
            points: self.points.iter().map(&of).collect(),
            ends: self.ends.iter().map(&of).collect(),
        }
    }

    fn plus(&self, factor: f64, other: &Self) -> Self {
        let sum =
            |a: &[Moved], b: &[Moved]| a.iter().zip(b).map(|(a, b)| *a + *b * factor).collect();
        Self {
            points: sum(&self.points, &other.points),
            ends: sum(&self.ends, &other.ends),
        }
    }

    fn of(at: &Along<1>, by: impl Fn(usize, bool) -> Matrix3<f64>) -> Self {
        let moved = |of: &[Vector3<f64>], is_end| {
            let all = of.iter().enumerate();
            all.map(|(index, at)| Moved {
                at: *at,
                by: by(index, is_end),
            })
            .collect()
        };
        Self {
            points: moved(&at.points, false),
            ends: moved(&at.ends, true),
        }
    }
}

impl StraightLine {
    /// Lengths of its segments, m.
    fn lengths(&self) -> impl Iterator<Item = f64> {
        self.ends.windows(2).map(|ends| ends[1] - ends[0])
    }

    /// Numbers of strains that describe its deformation.
    fn count(&self) -> usize {
        SHAPES * self.strains.len() * self.sections.len()
    }

    /// Integrals from the first end of rates at the points of all segments.
    fn integrated<const C: usize>(&self, rates: impl Fn(usize) -> SMatrix<f64, 3, C>) -> Along<C> {
        let mut start = SMatrix::zeros();
        let mut sums = Along {
            points: Vec::new(),
            ends: vec![start],
        };
        for (segment, length) in self.lengths().enumerate() {
            let rates: [_; POINTS] = std::array::from_fn(|point| rates(POINTS * segment + point));
            let sum = |weights: [f64; POINTS]| {
                let terms = rates.iter().zip(weights);
                terms.fold(start, |sum, (rate, weight)| sum + rate * (weight * length))
            };
            sums.points
                .extend(GAUSS_5.map(|point| sum(integrals_to(point.at))));
            start = sum(GAUSS_5.map(|point| point.weight));
            sums.ends.push(start);
        }
        sums
    }

    /// Strains at the points of all segments, from their values at both ends and in the middle of every segment.
    fn strains_of(&self, numbers: &[f64]) -> Vec<[Vector3<f64>; 2]> {
        let of_segment = numbers.chunks_exact(SHAPES * self.strains.len());
        let strains = of_segment.flat_map(|numbers| {
            GAUSS_5.map(|point| {
                let mut strains = Vector6::zeros();
                let shapes = shapes(point.at);
                for (values, strain) in numbers.chunks_exact(SHAPES).zip(self.strains) {
                    let terms = values.iter().zip(shapes);
                    strains[*strain] = terms.map(|(value, shape)| value * shape).sum();
                }
                [
                    strains.fixed_rows::<3>(0).into_owned(),
                    strains.fixed_rows::<3>(3).into_owned(),
                ]
            })
        });
        strains.collect()
    }

    /// Strain energy by numbers of strains: a symmetric matrix.
    fn stiffness(&self) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(self.count(), self.count());
        let own = SHAPES * self.strains.len();
        for (segment, length) in self.lengths().enumerate() {
            for (point, section) in GAUSS_5.iter().zip(&self.sections[segment]) {
                let shapes = shapes(point.at);
                for (a, b) in (0..own).flat_map(|a| (0..own).map(move |b| (a, b))) {
                    let stiffness =
                        section.stiffness[(self.strains[a / SHAPES], self.strains[b / SHAPES])];
                    let weight = point.weight * length * shapes[a % SHAPES] * shapes[b % SHAPES];
                    sum[(own * segment + a, own * segment + b)] += stiffness * weight;
                }
            }
        }
        sum
    }

    fn masses(&self) -> Vec<SectionMass> {
        let of_segment = self.lengths().zip(&self.sections);
        let masses = of_segment.flat_map(|(length, sections)| {
            GAUSS_5.iter().zip(sections).map(move |(point, section)| {
                let half = Matrix3::identity() * (0.5 * section.rotary.trace());
                SectionMass {
                    mass: section.density * point.weight * length,
                    spread: (half - section.rotary) * (point.weight * length),
                }
            })
        });
        masses.collect()
    }
}

impl LineModes {
    /// Modes of the free line. Returns `None` where its stiffness is not positive or an eigenproblem has no solution.
    ///
    /// - `principal`: principal moments and, as columns, principal axes of a tensor of inertia by rows.
    pub fn new(
        line: StraightLine,
        principal: impl Fn([[f64; 3]; 3]) -> ([f64; 3], Matrix3<f64>),
    ) -> Option<Self> {
        let masses = line.masses();
        let first = line.integrated(|_| Vector3::x());
        let first = Field::of(&first, |_, _| Matrix3::identity());
        let mass: f64 = masses.iter().map(|of| of.mass).sum();
        let center = first_moment(&masses, &first) / mass;
        let places = first.map(|of| Moved {
            at: of.at - center,
            by: of.by,
        });
        let spread = moment(&masses, &places, &places);
        let tensor = Matrix3::identity() * spread.trace() - spread;
        let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| tensor[(i, j)]));
        let (moments, axes) = principal(rows);
        let mut made = Self {
            masses: masses
                .into_iter()
                .map(|of| SectionMass {
                    spread: axes.tr_mul(&of.spread) * axes,
                    ..of
                })
                .collect(),
            places: places.map(|of| of.in_axes(&axes)),
            center,
            axes,
            columns: DMatrix::zeros(0, 0),
            linear: ReducedModel {
                mass,
                moments,
                ..ReducedModel::default()
            },
            line,
        };
        made.find_modes()?;
        Some(made)
    }

    /// The model without second-order terms, with all modes.
    pub fn linear(&self) -> &ReducedModel {
        &self.linear
    }

    fn find_modes(&mut self) -> Option<()> {
        let count = self.line.count();
        let units: Vec<Mode> = (0..count)
            .map(|at| {
                let mut unit = vec![0.0; count];
                unit[at] = 1.0;
                self.mode(&unit)
            })
            .collect();
        let mut mass = DMatrix::zeros(count, count);
        for (a, b) in (0..count).flat_map(|a| (0..=a).map(move |b| (a, b))) {
            let value = moment(&self.masses, &units[a].field, &units[b].field).trace();
            (mass[(a, b)], mass[(b, a)]) = (value, value);
        }
        let lower = self.line.stiffness().cholesky()?.unpack();
        let half = lower.solve_lower_triangular(&mass)?;
        let scaled = lower.solve_lower_triangular(&half.transpose())?;
        let (squares, vectors) = symmetric_eigenvectors(scaled)?;
        let largest = squares.last().copied().unwrap_or_default();
        let taken: Vec<usize> = (0..count)
            .rev()
            .filter(|at| squares[*at] > FASTEST * largest)
            .collect();
        let shapes = lower.tr_solve_lower_triangular(&vectors)?;
        let columns: Vec<DVector<f64>> = taken
            .iter()
            .map(|at| shapes.column(*at) / squares[*at].sqrt())
            .collect();
        self.columns = DMatrix::from_columns(&columns);
        self.linear.eigenvalues = taken.iter().map(|at| 1.0 / squares[*at]).collect();
        let modes: Vec<Mode> = columns.iter().map(|of| self.mode(of.as_slice())).collect();
        self.linear.interfaces = self.interfaces(&modes, &[]);
        Some(())
    }

    /// The mode of these numbers of strains.
    fn mode(&self, numbers: &[f64]) -> Mode {
        let strains = self.line.strains_of(numbers);
        let rotation = self.line.integrated(|point| strains[point][1]);
        let moved = self
            .line
            .integrated(|point| rotation.points[point].cross(&Vector3::x()) + strains[point][0]);
        let field = Field::of(&moved, |at, is_end| {
            let of = if is_end {
                &rotation.ends
            } else {
                &rotation.points
            };
            of[at].cross_matrix()
        });
        let (field, turn) = self.in_mean_axes(&field.map(|of| of.in_axes(&self.axes)));
        Mode {
            strains,
            rotation,
            turn,
            field,
        }
    }

    /// A field against mean axes, and how these rotate, in principal axes.
    fn in_mean_axes(&self, field: &Field) -> (Field, Vector3<f64>) {
        let way = first_moment(&self.masses, field) / self.linear.mass;
        let momentum = axial(&moment(&self.masses, &self.places, field));
        let turn = momentum.component_div(&Vector3::from(self.linear.moments));
        let rotation = turn.cross_matrix();
        let rigid = self.places.map(|of| {
            let turned = of.carried(&rotation);
            Moved {
                at: turned.at + way,
                ..turned
            }
        });
        (field.plus(-1.0, &rigid), turn)
    }

    /// Second-order displacements of a pair of modes, in principal axes.
    fn second(&self, a: &Mode, b: &Mode) -> Field {
        let line = &self.line;
        let turned = |point: usize| {
            let product = |of: &Mode, by: &Mode| {
                of.rotation.points[point].cross_matrix() * by.strains[point][1].cross_matrix()
            };
            product(a, b) + product(b, a)
        };
        let rotation = line.integrated(turned);
        let moved = line.integrated(|point| {
            let stretched =
                |of: &Mode, by: &Mode| of.rotation.points[point].cross(&by.strains[point][0]);
            rotation.points[point] * Vector3::x() + stretched(a, b) + stretched(b, a)
        });
        let field = Field::of(&moved, |at, is_end| {
            if is_end {
                rotation.ends[at]
            } else {
                rotation.points[at]
            }
        });
        let mut field = field.map(|of| of.in_axes(&self.axes));
        let [p, q] = [a.turn, b.turn].map(|turn| turn.cross_matrix());
        field = field.plus(-1.0, &b.field.map(|of| of.carried(&p)));
        field = field.plus(-1.0, &a.field.map(|of| of.carried(&q)));
        let twice = (p * q + q * p) * 0.5;
        field = field.plus(-1.0, &self.places.map(|of| of.carried(&twice)));
        self.in_mean_axes(&field).0
    }

    fn interfaces(&self, modes: &[Mode], pairs: &[Field]) -> Vec<Interface> {
        let markers = self.line.markers.iter();
        markers
            .map(|(name, end)| self.interface(name, *end, modes, pairs))
            .collect()
    }

    fn interface(&self, name: &str, end: usize, modes: &[Mode], pairs: &[Field]) -> Interface {
        let rotation = modes.iter().map(|of| rotation_of(&of.field.ends[end].by));
        Interface {
            name: name.into(),
            position: self.places.ends[end].at,
            modes: modes.iter().map(|of| of.field.ends[end].at).collect(),
            rotation: Some(rotation.collect()),
            second: pairs.iter().map(|of| of.ends[end].at).collect(),
            second_rotation: pairs
                .iter()
                .map(|of| rotation_of(&of.ends[end].by))
                .collect(),
        }
    }

    /// Returns the model in a basis of the modes, with interfaces at markers, and the ends of segments as interfaces without names.
    pub fn in_basis(&self, basis: &ModalBasis) -> (ReducedModel, Vec<Interface>) {
        let columns = &self.columns * &basis.columns;
        let modes: Vec<Mode> = columns
            .column_iter()
            .map(|of| self.mode(of.into_owned().as_slice()))
            .collect();
        // Strains are exact, so that pairs of stiff modes do no harm; without them held modes, which consist of all free ones, lose stiffening.
        let n = modes.len();
        let pairs: Vec<Field> = (0..n * n)
            .map(|at| self.second(&modes[at / n], &modes[at % n]))
            .collect();
        let of = |a: &Field, b: &Field| moment(&self.masses, a, b);
        let products: Vec<Matrix3<f64>> = (0..n * n)
            .map(|at| of(&modes[at / n].field, &modes[at % n].field))
            .collect();
        let inertia_2 = (0..n * n).map(|at| {
            let product = products[at] + of(&pairs[at], &self.places);
            inertia_of(&product, 0.5)
        });
        let ends = (0..self.line.ends.len()).map(|end| self.interface("", end, &modes, &pairs));
        let model = ReducedModel {
            eigenvalues: basis.eigenvalues.clone(),
            inertia_1: (modes.iter())
                .map(|mode| inertia_of(&of(&mode.field, &self.places), 1.0))
                .collect(),
            inertia_2: inertia_2.collect(),
            coupling: products.iter().map(axial).collect(),
            paired: n,
            interfaces: self.interfaces(&modes, &pairs),
            ..self.linear.clone()
        };
        (model, ends.collect())
    }
}

/// Polynomials of degree 2 that are 1 at one end, in the middle, and at the other end.
fn shapes(at: f64) -> [f64; SHAPES] {
    [
        (1.0 - at) * (1.0 - 2.0 * at),
        4.0 * at * (1.0 - at),
        at * (2.0 * at - 1.0),
    ]
}

/// Integral of displacements over the mass.
fn first_moment(masses: &[SectionMass], field: &Field) -> Vector3<f64> {
    masses
        .iter()
        .zip(&field.points)
        .map(|(of, moved)| moved.at * of.mass)
        .sum()
}

/// Integral of the products of two displacements, `a b^T`, over the mass.
fn moment(masses: &[SectionMass], a: &Field, b: &Field) -> Matrix3<f64> {
    let pairs = a.points.iter().zip(&b.points);
    let terms = masses.iter().zip(pairs).map(|(of, (a, b))| {
        a.at * b.at.transpose() * of.mass + a.by * of.spread * b.by.transpose()
    });
    terms.sum()
}

/// `a x b` of a product `a b^T`.
fn axial(of: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(
        of[(1, 2)] - of[(2, 1)],
        of[(2, 0)] - of[(0, 2)],
        of[(0, 1)] - of[(1, 0)],
    )
}

/// Rotation vector of the skew part of a matrix: of a small rotation, or of second order, where its symmetric part is the square of the first.
fn rotation_of(of: &Matrix3<f64>) -> Vector3<f64> {
    let skew = (of - of.transpose()) * 0.5;
    Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
}

/// `2 f tr A I - f (A + A^T)`: change of the inertia with products `A` of places.
fn inertia_of(product: &Matrix3<f64>, factor: f64) -> Symmetric {
    let whole = Matrix3::identity() * (2.0 * factor * product.trace())
        - (product + product.transpose()) * factor;
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| whole[at])
}
