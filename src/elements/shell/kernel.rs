//! Strains, stress resultants and forces of an element of a plate or shell.
//!
//! Membrane strains are sampled where they do not lock and interpolated to the nine inner places, where membrane and bending meet in one law
//! (docs/decisions/0076-plates-and-shells.md). All components are covariant, by `xi` and `eta`; the stiffness at a point takes them to the
//! axes of the section. Twists and shears are the engineering ones.
//!
//! Source: J. Kiendl, K.-U. Bletzinger, J. Linhard, R. Wuechner, Isogeometric shell analysis with Kirchhoff-Love elements, Comput. Methods
//! Appl. Mech. Eng. 198 (2009), Eqs. 6-19 (strains and curvatures).

use super::grid::{AT, Corners, Grid};
use crate::elements::line::{dot, times};
use crate::elements::rod::vectors::{Vector, add, cross, plus};
use crate::math::jet::Number;
use crate::math::lanes::{Lanes, PACK, Real, Simd};

/// A number for every component 11, 22 and 12, at the inner places.
pub(super) type Components<N> = [[[N; 3]; 3]; 3];

/// A symmetric matrix over components: 11-11, 11-22, 11-12, 22-22, 22-12, 12-12.
pub(super) type Law<N> = [N; 6];

/// Constants of an element, as stored: numbers, or those of a pack side by side.
#[derive(Clone, Debug)]
pub(super) struct Kernel<P> {
    /// Membrane stiffness, coupling and bending stiffness at inner places, by covariant components and times the area that a place stands
    /// for.
    pub laws: [[[Law<P>; 3]; 3]; 3],
    /// Whether there is coupling.
    pub is_coupled: bool,
    /// Half the metric of the unstressed surface.
    pub metric: Components<P>,
    /// Curvatures of the unstressed surface.
    pub curvature: Components<P>,
    /// Kelvin-Voigt damping time, s.
    pub damping_time: P,
}

/// Reads a stored number.
pub(super) trait Read<P, N>: Copy {
    /// The number.
    fn read(self, stored: &P) -> N;
}

/// Reads numbers of one element.
#[derive(Clone, Copy)]
pub(super) struct Single;

impl<N: Number> Read<f64, N> for Single {
    #[inline(always)]
    fn read(self, stored: &f64) -> N {
        N::of(*stored)
    }
}

/// Reads a group of lanes of a pack.
#[derive(Clone, Copy)]
pub(super) struct Group<S>(pub S, pub usize);

impl<S: Simd> Read<[f64; PACK], Lanes<S>> for Group<S> {
    #[inline(always)]
    fn read(self, stored: &[f64; PACK]) -> Lanes<S> {
        Lanes::read(self.0, stored, self.1)
    }
}

/// Normal and dual vectors of a surface at a place.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceFrame<N> {
    /// Unit normal.
    pub normal: Vector<N>,
    /// Vectors `r^1` and `r^2` with `r^a . r_b = 1` where `a = b`, 0 elsewhere, in the tangent plane.
    pub dual: [Vector<N>; 2],
}

impl<N: Real> SurfaceFrame<N> {
    /// From the derivatives of the position by both coordinates.
    #[inline(always)]
    pub fn of(first: &Vector<N>, second: &Vector<N>) -> Self {
        let across = cross(first, second);
        let square = dot(&across, &across);
        let inverse = square.constant(1.0) / square.root();
        let normal = times(&across, inverse);
        Self {
            dual: [
                times(&cross(second, &normal), inverse),
                times(&cross(&normal, first), inverse),
            ],
            normal,
        }
    }
}

/// Forces by strains: membrane forces, and moments, times the area that a place stands for.
#[derive(Clone, Copy)]
pub(super) struct Stress<N> {
    /// Conjugate to the membrane strains.
    pub membrane: Components<N>,
    /// Conjugate to the curvatures.
    pub moment: Components<N>,
}

/// Strains and curvatures, or their rates.
#[derive(Clone, Copy)]
pub(super) struct Strain<N> {
    pub membrane: Components<N>,
    pub curvature: Components<N>,
}

/// From the places of Lobatto to those of Gauss: a parabola.
#[inline(always)]
fn to_inner<N: Real>(s: [N; 3]) -> [N; 3] {
    let number = |value: f64| s[0].constant(value);
    let even = s[1].times_plus(number(0.4), (s[0] + s[2]) * number(0.3));
    let odd = (s[2] - s[0]) * number(AT[3]);
    [even - odd, s[1], even + odd]
}

/// The transpose of [`to_inner`].
#[inline(always)]
pub(super) fn from_inner<N: Real>(g: [N; 3]) -> [N; 3] {
    let number = |value: f64| g[0].constant(value);
    let (sum, odd) = (g[0] + g[2], (g[2] - g[0]) * number(AT[3]));
    let even = sum * number(0.3);
    [even - odd, sum.times_plus(number(0.4), g[1]), even + odd]
}

/// Runs [`to_inner`] or its transpose along `xi`, for every `eta`.
macro_rules! along_first {
    ($of:expr, $map:ident) => {{
        let mut of = $of;
        for j in 0..3 {
            let mapped = $map([of[0][j], of[1][j], of[2][j]]);
            for i in 0..3 {
                of[i][j] = mapped[i];
            }
        }
        of
    }};
}

/// The same along `eta`, for every `xi`.
macro_rules! along_second {
    ($of:expr, $map:ident) => {{
        let mut of = $of;
        for i in 0..3 {
            of[i] = $map(of[i]);
        }
        of
    }};
}

/// Products of first derivatives at the samples of each membrane strain, carried to the inner places: half of `r1 . s1` for 11, half of
/// `r2 . s2` for 22, half of `r1 . s2 + s1 . r2` for 12, twice where `is_rate`.
#[inline(always)]
fn products<N: Real>(r: &Grid<N>, s: &Grid<N>, is_rate: bool) -> Components<N> {
    let like = r.first[0][0][0][0];
    let half = like.constant(if is_rate { 1.0 } else { 0.5 });
    let mut out = [[[like; 3]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let [along, across] = [(2 * i, j + 1), (i + 1, 2 * j)];
            out[0][i][j] = dot(&r.first[0][along.0][along.1], &s.first[0][along.0][along.1]) * half;
            out[1][i][j] = dot(
                &r.first[1][across.0][across.1],
                &s.first[1][across.0][across.1],
            ) * half;
            let (a, b) = (r.first[0][2 * i][2 * j], r.first[1][2 * i][2 * j]);
            let (c, d) = (s.first[0][2 * i][2 * j], s.first[1][2 * i][2 * j]);
            out[2][i][j] = if is_rate {
                dot(&a, &d) + dot(&c, &b)
            } else {
                dot(&a, &d)
            };
        }
    }
    [
        along_first!(out[0], to_inner),
        along_second!(out[1], to_inner),
        along_second!(along_first!(out[2], to_inner), to_inner),
    ]
}

/// Half the metric, interpolated to the inner places.
#[inline(always)]
pub(super) fn metric<N: Real>(grid: &Grid<N>) -> Components<N> {
    products(grid, grid, false)
}

/// Components `r_ab . v`, twice for 12.
#[inline(always)]
fn along_second_derivatives<N: Real>(
    grid: &Grid<N>,
    (i, j): (usize, usize),
    v: &Vector<N>,
) -> [N; 3] {
    let twist = dot(&grid.second[2][i][j], v);
    [
        dot(&grid.second[0][i][j], v),
        dot(&grid.second[1][i][j], v),
        twist + twist,
    ]
}

/// Curvatures, and the frames that they were found with.
#[inline(always)]
pub(super) fn curvature<N: Real>(grid: &Grid<N>) -> (Components<N>, [[SurfaceFrame<N>; 3]; 3]) {
    let like = grid.first[0][1][1];
    let frame = SurfaceFrame {
        normal: like,
        dual: [like; 2],
    };
    let mut frames = [[frame; 3]; 3];
    let mut out = [[[like[0]; 3]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            frames[i][j] =
                SurfaceFrame::of(&grid.first[0][i + 1][j + 1], &grid.first[1][i + 1][j + 1]);
            let components = along_second_derivatives(grid, (i, j), &frames[i][j].normal);
            for k in 0..3 {
                out[k][i][j] = components[k];
            }
        }
    }
    (out, frames)
}

/// Rates of strains and curvatures, of rates of the surface.
#[inline(always)]
pub(super) fn strain_rate<N: Real>(
    grid: &Grid<N>,
    frames: &[[SurfaceFrame<N>; 3]; 3],
    rates: &Grid<N>,
) -> Strain<N> {
    let membrane = products(grid, rates, true);
    let mut curvature = membrane;
    for i in 0..3 {
        for j in 0..3 {
            let rate = curvature_rate(grid, &frames[i][j], rates, (i, j));
            set(&mut curvature, (i, j), rate);
        }
    }
    Strain {
        membrane,
        curvature,
    }
}

/// Rates of curvatures at an inner place.
#[inline(always)]
fn curvature_rate<N: Real>(
    grid: &Grid<N>,
    SurfaceFrame { normal, dual }: &SurfaceFrame<N>,
    rates: &Grid<N>,
    (i, j): (usize, usize),
) -> [N; 3] {
    let mut rate = along_second_derivatives(rates, (i, j), normal);
    let u1 = dot(&rates.first[0][i + 1][j + 1], normal);
    let u2 = dot(&rates.first[1][i + 1][j + 1], normal);
    let g1 = along_second_derivatives(grid, (i, j), &dual[0]);
    let g2 = along_second_derivatives(grid, (i, j), &dual[1]);
    for k in 0..3 {
        rate[k] = rate[k] - g1[k] * u1 - g2[k] * u2;
    }
    rate
}

/// All components at an inner place.
#[inline(always)]
pub(super) fn at<N: Real>(of: &Components<N>, i: usize, j: usize) -> [N; 3] {
    [of[0][i][j], of[1][i][j], of[2][i][j]]
}

/// A law times components.
#[inline(always)]
pub(super) fn apply<N: Real>(law: &Law<N>, s: [N; 3]) -> [N; 3] {
    let [a, b, c, d, e, f] = *law;
    [
        s[2].times_plus(c, s[1].times_plus(b, s[0] * a)),
        s[2].times_plus(e, s[1].times_plus(d, s[0] * b)),
        s[2].times_plus(f, s[1].times_plus(e, s[0] * c)),
    ]
}

impl<P> Kernel<P> {
    #[inline(always)]
    pub fn law<N: Real>(&self, which: usize, i: usize, j: usize, read: impl Read<P, N>) -> Law<N> {
        let law = &self.laws[which][i][j];
        let first = read.read(&law[0]);
        let mut out = [first; 6];
        for k in 1..6 {
            out[k] = read.read(&law[k]);
        }
        out
    }

    /// Strains and curvatures less those of the unstressed surface.
    #[inline(always)]
    pub fn strain<N: Real>(
        &self,
        grid: &Grid<N>,
        curvature: &Components<N>,
        read: impl Read<P, N>,
    ) -> Strain<N> {
        let mut strain = Strain {
            membrane: metric(grid),
            curvature: *curvature,
        };
        for k in 0..3 {
            for i in 0..3 {
                for j in 0..3 {
                    let (metric, natural) = (&self.metric[k][i][j], &self.curvature[k][i][j]);
                    strain.membrane[k][i][j] = strain.membrane[k][i][j] - read.read(metric);
                    strain.curvature[k][i][j] = strain.curvature[k][i][j] - read.read(natural);
                }
            }
        }
        strain
    }

    /// Stress of strains.
    #[inline(always)]
    pub fn stress<N: Real>(&self, strain: &Strain<N>, read: impl Read<P, N>) -> Stress<N> {
        let mut stress = Stress {
            membrane: strain.membrane,
            moment: strain.curvature,
        };
        for i in 0..3 {
            for j in 0..3 {
                let eps = at(&strain.membrane, i, j);
                let [n, m] = self.stress_at((i, j), eps, at(&strain.curvature, i, j), read);
                set(&mut stress.membrane, (i, j), n);
                set(&mut stress.moment, (i, j), m);
            }
        }
        stress
    }

    /// Strain energy, J.
    #[inline(always)]
    pub fn energy<N: Real>(&self, e: &Corners<N>, read: impl Read<P, N>) -> N {
        let grid = Grid::of(e);
        let strain = self.strain(&grid, &curvature(&grid).0, read);
        work(&self.stress(&strain, read), &strain) * e[0][0][0].constant(0.5)
    }

    /// Elastic and damping force on the coordinates, N and N m, and the power that damping dissipates, W. The surface is put into `grid`.
    #[inline(always)]
    pub fn force<N: Real>(
        &self,
        (e, rate): (&Corners<N>, Option<&Corners<N>>),
        read: impl Read<P, N>,
        grid: &mut Grid<N>,
    ) -> (Corners<N>, N) {
        grid.fill(e);
        let mut power = e[0][0][0].constant(0.0);
        let mut strain = metric(grid);
        let mut on_slopes = [[[e[0][0]; 2]; 3]; 3];
        match rate {
            Some(rate) => {
                let rates = Grid::of(rate);
                let membrane = products(grid, &rates, true);
                let time = read.read(&self.damping_time);
                for i in 0..3 {
                    for j in 0..3 {
                        let place = self.frame_and_stress(grid, &strain, (i, j), read);
                        let (frame, mut stress) = place;
                        let eps = at(&membrane, i, j);
                        let kappa = curvature_rate(grid, &frame, &rates, (i, j));
                        let damped = self.stress_at((i, j), eps, kappa, read);
                        let dissipated = dot(&damped[0], &eps) + dot(&damped[1], &kappa);
                        power = dissipated.times_plus(time, power);
                        for of in 0..2 {
                            stress[of] = plus(&damped[of], time, &stress[of]);
                        }
                        on_slopes[i][j] = turn_into_forces(grid, (i, j), &frame, &stress[1]);
                        set(&mut strain, (i, j), stress[0]);
                    }
                }
            }
            None => {
                for i in 0..3 {
                    for j in 0..3 {
                        let (frame, stress) = self.frame_and_stress(grid, &strain, (i, j), read);
                        on_slopes[i][j] = turn_into_forces(grid, (i, j), &frame, &stress[1]);
                        set(&mut strain, (i, j), stress[0]);
                    }
                }
            }
        }
        forces_on_slopes(grid, &on_slopes, &at_samples(&strain));
        (grid.back(), power)
    }

    /// Membrane forces and moments at an inner place of strains and curvatures.
    #[inline(always)]
    fn stress_at<N: Real>(
        &self,
        (i, j): (usize, usize),
        eps: [N; 3],
        kappa: [N; 3],
        read: impl Read<P, N>,
    ) -> [[N; 3]; 2] {
        let mut n = apply(&self.law(0, i, j, read), eps);
        let mut m = apply(&self.law(2, i, j, read), kappa);
        if self.is_coupled {
            let coupling = self.law(1, i, j, read);
            let (of_kappa, of_eps) = (apply(&coupling, kappa), apply(&coupling, eps));
            for k in 0..3 {
                n[k] = n[k] - of_kappa[k];
                m[k] = m[k] - of_eps[k];
            }
        }
        [n, m]
    }

    /// The frame at an inner place and what [`Self::stress_at`] says there, of half the metric.
    #[inline(always)]
    fn frame_and_stress<N: Real>(
        &self,
        grid: &Grid<N>,
        metric: &Components<N>,
        (i, j): (usize, usize),
        read: impl Read<P, N>,
    ) -> (SurfaceFrame<N>, [[N; 3]; 2]) {
        let frame = SurfaceFrame::of(&grid.first[0][i + 1][j + 1], &grid.first[1][i + 1][j + 1]);
        let mut eps = at(metric, i, j);
        let mut kappa = along_second_derivatives(grid, (i, j), &frame.normal);
        for k in 0..3 {
            eps[k] = eps[k] - read.read(&self.metric[k][i][j]);
            kappa[k] = kappa[k] - read.read(&self.curvature[k][i][j]);
        }
        (frame, self.stress_at((i, j), eps, kappa, read))
    }
}

/// Sets all components at an inner place.
#[inline(always)]
fn set<N: Copy>(of: &mut Components<N>, (i, j): (usize, usize), values: [N; 3]) {
    for k in 0..3 {
        of[k][i][j] = values[k];
    }
}

/// Sum of products of stress and strain.
#[inline(always)]
fn work<N: Real>(stress: &Stress<N>, strain: &Strain<N>) -> N {
    let mut sum = stress.membrane[0][0][0].constant(0.0);
    for k in 0..3 {
        for i in 0..3 {
            sum += dot(&stress.membrane[k][i], &strain.membrane[k][i]);
            sum += dot(&stress.moment[k][i], &strain.curvature[k][i]);
        }
    }
    sum
}

impl<N: Real> Stress<N> {
    /// `self + factor other`.
    #[inline(always)]
    pub fn plus(&self, other: &Self, factor: N) -> Self {
        let mut sum = *self;
        for k in 0..3 {
            for i in 0..3 {
                sum.membrane[k][i] = plus(&other.membrane[k][i], factor, &self.membrane[k][i]);
                sum.moment[k][i] = plus(&other.moment[k][i], factor, &self.moment[k][i]);
            }
        }
        sum
    }
}

/// Membrane forces at the samples of their strains, by component, of those at inner places.
#[inline(always)]
pub(super) fn at_samples<N: Real>(membrane: &Components<N>) -> Components<N> {
    [
        along_first!(membrane[0], from_inner),
        along_second!(membrane[1], from_inner),
        along_second!(along_first!(membrane[2], from_inner), from_inner),
    ]
}

/// Converts the second derivatives at an inner place into the forces of moments on them, against the curvatures. Returns those on the first
/// derivatives.
#[inline(always)]
fn turn_into_forces<N: Real>(
    grid: &mut Grid<N>,
    (i, j): (usize, usize),
    SurfaceFrame { normal, dual }: &SurfaceFrame<N>,
    [m11, m22, m12]: &[N; 3],
) -> [Vector<N>; 2] {
    let m12 = *m12 + *m12;
    let [by_first, by_second, mixed] = &mut grid.second;
    let p = times(&by_first[i][j], *m11);
    let p = plus(&by_second[i][j], *m22, &p);
    let p = plus(&mixed[i][j], m12, &p);
    by_first[i][j] = times(normal, -*m11);
    by_second[i][j] = times(normal, -*m22);
    mixed[i][j] = times(normal, -m12);
    [
        times(normal, dot(&p, &dual[0])),
        times(normal, dot(&p, &dual[1])),
    ]
}

/// Converts the first derivatives into the forces on them, against the strains: those of curvatures at inner places, and those of membrane
/// forces at samples.
#[inline(always)]
fn forces_on_slopes<N: Real>(
    grid: &mut Grid<N>,
    of_curvature: &[[[Vector<N>; 2]; 3]; 3],
    n: &Components<N>,
) {
    let [along, across] = &mut grid.first;
    for i in 0..3 {
        for j in 0..3 {
            let (first, second) = (along[2 * i][2 * j], across[2 * i][2 * j]);
            let mut on_first = times(&second, -n[2][i][j]);
            let mut on_second = times(&first, -n[2][i][j]);
            if j == 1 {
                on_first = plus(&first, -n[0][i][1], &on_first);
            }
            if i == 1 {
                on_second = plus(&second, -n[1][1][j], &on_second);
            }
            (along[2 * i][2 * j], across[2 * i][2 * j]) = (on_first, on_second);
        }
        for side in [0, 2] {
            let place = &mut along[2 * i][side + 1];
            *place = times(place, -n[0][i][side]);
            let place = &mut across[side + 1][2 * i];
            *place = times(place, -n[1][side][i]);
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            let [on_first, on_second] = &of_curvature[i][j];
            let place = &mut along[i + 1][j + 1];
            *place = if i == 1 {
                add(place, on_first)
            } else {
                *on_first
            };
            let place = &mut across[i + 1][j + 1];
            *place = if j == 1 {
                add(place, on_second)
            } else {
                *on_second
            };
        }
    }
}
