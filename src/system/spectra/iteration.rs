//! The slowest eigenvalues of many coordinates: Krylov iteration with the inverse near them, and a count that shows
//! that none is missing. Work and storage are linear in the elements.
//!
//! Sources: T. Ericsson, A. Ruhe, The spectral transformation Lanczos method, Math. Comp. 35 (1980) (inverses, counts by
//! inertia); F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001), section 6.3; zeros inside a
//! contour by the argument principle: P. Kravanja, M. Van Barel, Computing the Zeros of Analytic Functions (2000).

use std::f64::consts::PI;

use nalgebra::Complex;

use super::dense::{quadratic, roots, sort};
use super::fastest::largest_eigenvalue;
use super::linearization::Linearization;
use super::modes::{Mode, in_basis};
use crate::math::krylov::{Krylov, Ritz};
use crate::math::row_space::RowSpace;
use crate::system::{System, Workspace};

/// Residual, relative, at which a value counts as found.
const CONVERGED: f64 = 1e-10;
/// Difference, relative, from which on values are apart.
const APART: f64 = 1e-6;
/// Vectors that a basis may have beyond so many times the number wanted.
const BASIS: usize = 160;
const TIMES: usize = 6;
/// Part of the largest eigenvalue in a basis below which one may be nothing but roundoff.
pub(super) const SLOW: f64 = 1e-6;
/// Steps from one look at the values to the next.
const STEPS: usize = 8;
/// Decades that a search for a scale goes through, and factors of 10 for a shift below all values.
const DECADES: i32 = 24;
/// Largest change of an argument from one point of a contour to the next, rad, and most points.
const TURN: f64 = 1.0;
const POINTS: usize = 2000;
/// How often a contour is gone around with four times as many points, where too few values show.
const DENSER: usize = 4;

/// Why eigenvalues were not found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoEigenvalues {
    /// Numbers that are not finite.
    NotFinite,
    /// Not all of so many.
    Missing(usize),
}

/// Computes at least `count` lowest modes of the symmetric `K`, ascending. `work` holds `K` as well. The modes are
/// computed anew in the full basis, without the roundoff of the sparse form.
///
/// # Errors
/// [`NoEigenvalues`] if the iteration does not converge to that many modes.
pub(super) fn lowest<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    linear: &Linearization<'_, D>,
    count: usize,
) -> Result<Vec<Mode>, NoEigenvalues> {
    let modes = linear.modes();
    let scale = scale(system, work, count)?;
    let missing = NoEigenvalues::Missing(count);
    let mut shift = -0.1 * scale;
    let is_below = |shift: f64, work: &mut Workspace<D>| below(system, work, shift) == Some(0);
    for _ in 0..2 * DECADES {
        if is_below(shift, work) {
            break;
        }
        shift *= 4.0;
    }
    let elimination = &system.elimination;
    let mut krylov = Krylov::new(system.coordinates());
    for _ in 0..TIMES * count + BASIS {
        // Beyond what constraints leave there is nothing but roundoff of solves, which would count as directions.
        if krylov.size() == modes || !is_below(shift, work) {
            return Err(missing);
        }
        let steps = if krylov.size() == 0 {
            2 * count + STEPS
        } else {
            STEPS
        };
        let steps = steps.min(modes - krylov.size());
        let more = krylov.extend(steps, |x| work.linearization.tangent.solve(elimination, x));
        if !more {
            krylov.start();
        }
        if krylov.size() > TIMES * count + BASIS {
            return Err(missing);
        }
        let ritz = krylov.symmetric().ok_or(NoEigenvalues::NotFinite)?;
        let found: Vec<f64> = certain(&ritz)
            .map(|ritz| shift + 1.0 / ritz.value.re)
            .collect();
        if found.len() < count {
            continue;
        }
        let distance = |k: f64| k - shift;
        match split(&found, count, modes, distance) {
            None => {}
            Some((at, number)) => match below(system, work, at) {
                Some(present) if present == number && linear.holds(krylov.basis()) => {
                    return in_basis(linear, krylov.basis()).ok_or(NoEigenvalues::NotFinite);
                }
                // A multiple eigenvalue has so far been seen less often than it is there.
                Some(present) if present > number => krylov.start(),
                _ => return Err(missing),
            },
        }
    }
    Err(missing)
}

/// The leading values that have converged.
fn certain(ritz: &[Ritz]) -> impl Iterator<Item = &Ritz> {
    (ritz.iter()).take_while(|ritz| ritz.residual <= CONVERGED * ritz.value.norm())
}

/// A number between the values found so far that the first `count` are not beyond, with how many are below;
/// where the last of them is one of a cluster without end, a number below that cluster.
fn split(
    found: &[f64],
    count: usize,
    modes: usize,
    distance: impl Fn(f64) -> f64,
) -> Option<(f64, usize)> {
    let is_apart =
        |i: usize| distance(found[i]) - distance(found[i - 1]) > APART * distance(found[i]);
    let between = |i: usize| (0.5 * (found[i] + found[i - 1]), i);
    if found.len() == modes {
        let last = found[modes - 1];
        return Some((last + APART * distance(last), modes));
    }
    if let Some(i) = (count..found.len()).find(|i| is_apart(*i)) {
        return Some(between(i));
    }
    // All further copies would be the same: enough of them are there.
    if found.len() <= count + STEPS {
        return None;
    }
    let none = (found[0] - APART * distance(found[0]), 0);
    Some(
        (1..count)
            .rev()
            .find(|i| is_apart(*i))
            .map_or(none, between),
    )
}

/// Number of eigenvalues of `K` below; the shift gives way where it is one of them.
fn below<const D: usize>(system: &System<D>, work: &mut Workspace<D>, shift: f64) -> Option<usize> {
    let mut factor = |shift: f64| {
        work.linearization
            .tangent
            .factor_below(&system.elimination, shift)
    };
    factor(shift).or_else(|| factor(shift * (1.0 + 1e-9)))
}

/// Size of the eigenvalue number `count` of the symmetric `K`, to a factor of ten upwards.
fn scale<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    count: usize,
) -> Result<f64, NoEigenvalues> {
    let n = system.coordinates();
    let tangent = &mut work.linearization.tangent;
    let largest = largest_eigenvalue(n, |x| tangent.apply_stiffness(&system.elimination, x));
    if !largest.is_finite() {
        return Err(NoEigenvalues::NotFinite);
    }
    let largest = if largest > 0.0 { largest } else { 1.0 };
    let (mut few, mut enough) = (-DECADES, 1);
    while enough - few > 1 {
        let middle = (few + enough) / 2;
        let size = largest * 10.0_f64.powi(middle);
        let number = below(system, work, size)
            .zip(below(system, work, -size))
            .map(|(above, under)| above.saturating_sub(under));
        match number {
            Some(number) if number < count => few = middle,
            _ => enough = middle,
        }
    }
    Ok(largest * 10.0_f64.powi(enough))
}

/// Computes at least `count` slowest eigenvalues `s` of a symmetric `K` without `R`.
///
/// # Errors
/// [`NoEigenvalues`] if the iteration does not converge to that many eigenvalues.
pub(super) fn slowest_conservative<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    linear: &Linearization<'_, D>,
    count: usize,
) -> Result<Vec<Complex<f64>>, NoEigenvalues> {
    // Unstable modes come first, however fast they are. At zero itself what joints alone hold has no pivots.
    let zero = -SLOW * scale(system, work, count.min(linear.modes()))?;
    let unstable = below(system, work, zero).ok_or(NoEigenvalues::Missing(count))?;
    let wanted = linear.modes().min(count + unstable);
    let modes = lowest(system, work, linear, wanted)?;
    let mut squares: Vec<f64> = modes.iter().map(|mode| mode.square).collect();
    squares.truncate(wanted);
    squares.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    Ok(roots(
        squares.into_iter().map(|k| Complex::new(k, 0.0)),
        0.0,
    ))
}

/// Computes at least `count` slowest eigenvalues `s` of `s^2 I + s R + K`. Of a conjugate pair it returns the one with
/// the positive imaginary part.
///
/// # Errors
/// [`NoEigenvalues`] if the iteration does not converge to that many eigenvalues.
pub(super) fn slowest<const D: usize>(
    system: &System<D>,
    work: &mut Workspace<D>,
    linear: &Linearization<'_, D>,
    count: usize,
) -> Result<Vec<Complex<f64>>, NoEigenvalues> {
    let missing = NoEigenvalues::Missing(count);
    let rate = scale(system, work, count.min(linear.modes()))?.sqrt();
    let shift = 0.3 * rate;
    let mut shifted = linear.shifted(shift).ok_or(missing)?;
    let n = linear.elimination.coordinates();
    let (mut y, mut product) = (vec![0.0; n], vec![0.0; n]);
    let mut damped = vec![0.0; n];
    // Displacements, then velocities over `rate`: x = -(s^2 I + s R + K)^-1 (b + R a + s a), v = a + s x.
    let mut apply = |z: &mut [f64]| {
        let (a, b) = z.split_at_mut(n);
        b.iter_mut().for_each(|b| *b *= rate);
        if linear.terms.is_damped {
            damped.copy_from_slice(a);
            linear.apply_damping(&mut damped, &mut y, &mut product);
        }
        for i in 0..n {
            damped[i] = -(b[i] + damped[i] + shift * a[i]);
        }
        shifted.solve(&mut damped);
        for i in 0..n {
            b[i] = (a[i] + shift * damped[i]) / rate;
            a[i] = damped[i];
            damped[i] = 0.0;
        }
    };
    let mut krylov = Krylov::new(2 * n);
    for _ in 0..TIMES * count + BASIS {
        let steps = if krylov.size() == 0 {
            4 * count + 2 * STEPS
        } else {
            2 * STEPS
        };
        let more = krylov.extend(steps, &mut apply);
        if !more {
            krylov.start();
        }
        if krylov.size() > 2 * TIMES * count + BASIS {
            return Err(missing);
        }
        let ritz = krylov.general().ok_or(NoEigenvalues::NotFinite)?;
        let (found, beyond) = surely_slowest(&ritz, shift);
        if found.len() < count {
            continue;
        }
        let mut sizes: Vec<f64> = found.iter().map(|s| s.norm()).collect();
        // Others may be next to each other without end, as those of damped material are: they need not be found.
        sizes.extend(beyond);
        let Some((radius, number)) = split(&sizes, count, usize::MAX, |size| size) else {
            continue;
        };
        let roots = |s: &Complex<f64>| if s.im > 0.0 { 2 } else { 1 };
        let number: usize = found[..number].iter().map(roots).sum();
        match present(linear, radius, number) {
            Some(present) if present == number && linear.holds(krylov.basis()) => {
                return Ok(improved(linear, &krylov, found));
            }
            Some(present) if present > number => krylov.start(),
            _ => return Err(missing),
        }
    }
    Err(missing)
}

/// Number of eigenvalues inside a circle about 0, of which so many were found. Determinants of parts of the system rotate faster
/// than that of the whole: too few show where steps round the circle are too large.
fn present<const D: usize>(
    linear: &Linearization<'_, D>,
    radius: f64,
    number: usize,
) -> Option<usize> {
    (0..DENSER)
        .map_while(|k| inside(linear, radius, (number + 8) << (2 * k)))
        .find(|present| *present >= number)
}

/// Eigenvalues that are certain and that no unfound one can be slower than, slowest first; with the size that all
/// unfound ones exceed, as far as they show.
fn surely_slowest(ritz: &[Ritz], shift: f64) -> (Vec<Complex<f64>>, Option<f64>) {
    let mut found: Vec<Complex<f64>> = certain(ritz)
        .map(|ritz| shift + ritz.value.inv())
        .map(|s| Complex::new(s.re, s.im.abs()))
        .collect();
    sort(&mut found);
    // Of these the ones that no unfound one can be slower than.
    let reach = ritz
        .get(found.len())
        .map_or(f64::INFINITY, |ritz| ritz.value.inv().norm());
    found.retain(|s| s.norm() + shift < reach || reach.is_infinite());
    (found, reach.is_finite().then_some(reach - shift))
}

/// The values of the equations in the span of all displacements found, nearest to those found so far: free of the
/// roundoff of the sparse form.
fn improved<const D: usize>(
    linear: &Linearization<'_, D>,
    krylov: &Krylov,
    mut found: Vec<Complex<f64>>,
) -> Vec<Complex<f64>> {
    let n = linear.elimination.coordinates();
    if krylov.size() > BASIS {
        return found;
    }
    let mut rows = RowSpace::new(krylov.size(), n);
    for (i, vector) in krylov.basis().iter().enumerate() {
        rows.row_mut(i).copy_from_slice(&vector[..n]);
    }
    rows.factor(1e-9);
    let basis: Vec<Vec<f64>> = (0..rows.rank()).map(|i| rows.unit(i).to_vec()).collect();
    let [stiffness, damping] = linear.project(&basis);
    let Some(mut better) = quadratic(&stiffness, &damping) else {
        return found;
    };
    let mut zeros = 0;
    for s in &mut found {
        let away = |i: &usize| (better[*i] - *s).norm();
        let nearest = (0..better.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
        if let Some(nearest) = nearest {
            let value = better.swap_remove(nearest);
            // A pair that is nothing but roundoff is 0 twice.
            zeros += usize::from(s.im > 0.0 && value.norm() == 0.0);
            *s = value;
        }
    }
    found.extend(vec![Complex::new(0.0, 0.0); zeros]);
    found
}

/// Number of eigenvalues inside a circle about 0, conjugate ones both: how often the determinant goes around while
/// `s` goes round half of it, in so many parts or more.
fn inside<const D: usize>(
    linear: &Linearization<'_, D>,
    radius: f64,
    parts: usize,
) -> Option<usize> {
    let phases = |angle: f64| {
        let s = Complex::from_polar(radius, angle);
        linear.shifted(s).map(|shifted| shifted.phases())
    };
    let mut points = parts + 1;
    let mut turn = 0.0;
    let mut last = (0.0, phases(0.0)?);
    for part in 1..=parts {
        let end = PI * part as f64 / parts as f64;
        let mut ahead = vec![(end, phases(end)?)];
        while let Some((angle, values)) = ahead.pop() {
            let changes = values
                .iter()
                .zip(&last.1)
                .map(|(a, b)| (a * b.conj()).arg());
            let (sum, largest) = changes.fold((0.0, 0.0_f64), |(sum, largest), change| {
                (sum + change, largest.max(change.abs()))
            });
            if largest <= TURN {
                turn += sum;
                last = (angle, values);
                continue;
            }
            points += 1;
            if points > POINTS {
                return None;
            }
            let middle = 0.5 * (angle + last.0);
            ahead.push((angle, values));
            ahead.push((middle, phases(middle)?));
        }
    }
    let roots = turn / PI;
    ((roots - roots.round()).abs() < 1e-3 && roots >= -0.5).then(|| roots.round() as usize)
}
