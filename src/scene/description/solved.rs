//! Numbers of shapes that finite elements give. Each shape is solved once: scenes ask for the same one at many places and at each change of a
//! parameter.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use nalgebra::Matrix2;

use super::profile::Profile;
use crate::elements::saint_venant::{
    Outline, STRESS_ERROR, ShearNumbers, TORSION_ERROR, Torsion, flaw,
};

/// Most shapes whose numbers are kept, before they are forgotten all at once.
const MOST_NUMBERS: usize = 10_000;
/// Most shapes whose stress is kept.
const MOST_FIELDS: usize = 16;
/// Shapes between two stations that are solved; numbers of others follow by interpolation.
const BETWEEN: usize = 9;

/// Kind of a shape, and all its numbers bit by bit.
type Key = (&'static str, Vec<u64>);

static NUMBERS: Mutex<BTreeMap<Key, Option<ShearNumbers>>> = Mutex::new(BTreeMap::new());
static FIELDS: Mutex<VecDeque<(Key, Arc<Torsion>)>> = Mutex::new(VecDeque::new());

/// What is kept is whole even where a thread has panicked.
fn locked<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

fn key(shape: &Profile, loops: &[Vec<[f64; 2]>]) -> Key {
    let loops = loops.iter();
    let bits = loops.flat_map(|corners| {
        let numbers = corners.iter().flatten().map(|number| number.to_bits());
        [corners.len() as u64].into_iter().chain(numbers)
    });
    (shape.key(), bits.collect())
}

/// Torsion constant, shear centre and shear compliance of a shape without closed form; `None` of an outline that is none.
pub fn numbers(shape: &Profile) -> Option<ShearNumbers> {
    let loops = shape.solved_loops()?;
    let key = key(shape, &loops);
    if let Some(known) = locked(&NUMBERS).get(&key) {
        return *known;
    }
    let found = solve(loops, TORSION_ERROR).map(|(outline, torsion)| {
        let (mut numbers, closed) = (torsion.numbers, shape.numbers_with(None));
        if shape.loops().is_none() {
            // The torsion constant of a hollow ellipse is known, and its area is not that of the polygon.
            numbers.torsion_constant = closed.torsion_constant;
            numbers.shear_center = [0.0; 2];
            let ratio = outline.area / closed.area;
            numbers.compliance = numbers.compliance.map(|of| of * ratio);
        }
        numbers
    });
    let mut all = locked(&NUMBERS);
    if all.len() >= MOST_NUMBERS {
        all.clear();
    }
    all.insert(key, found);
    found
}

/// Solution of torsion over a shape that is a polygon.
pub fn field(shape: &Profile) -> Option<Arc<Torsion>> {
    let loops = shape.loops()?;
    let key = key(shape, &loops);
    if let Some((_, known)) = locked(&FIELDS).iter().find(|(of, _)| *of == key) {
        return Some(known.clone());
    }
    let found = Arc::new(solve(loops, STRESS_ERROR)?.1);
    let mut all = locked(&FIELDS);
    if all.len() >= MOST_FIELDS {
        all.pop_front();
    }
    all.push_back((key, found.clone()));
    Some(found)
}

fn solve(loops: Vec<Vec<[f64; 2]>>, error: f64) -> Option<(Outline, Torsion)> {
    let is_finite = loops
        .iter()
        .flatten()
        .flatten()
        .all(|number| number.is_finite());
    if !is_finite || flaw(&loops).is_some() {
        return None;
    }
    let outline = Outline::new(loops);
    let torsion = Torsion::new(&outline, error)?;
    Some((outline, torsion))
}

/// Places between two stations of the shapes that are solved, as parts of the way: Chebyshev's points.
pub fn between_parts() -> impl Iterator<Item = f64> {
    let last = (BETWEEN - 1) as f64;
    (0..BETWEEN).map(move |k| 0.5 - 0.5 * (std::f64::consts::PI * k as f64 / last).cos())
}

/// Numbers of a shape between two of a kind, by interpolation between shapes of which the first and the last are among them: a body with
/// stations has another shape at each point of each mesh.
pub fn between(shapes: [&Profile; 2], part: f64) -> Option<ShearNumbers> {
    if shapes[0] == shapes[1] {
        return shapes[0].shear();
    }
    // Barycentric interpolation at Chebyshev's points (J.-P. Berrut, L. N. Trefethen, SIAM Review 46 (2004) 501-517). Compliance times the area
    // changes little.
    let last = BETWEEN - 1;
    let (mut sum, mut all) = ([0.0; 10], 0.0);
    for (k, at) in between_parts().enumerate() {
        let shape = shapes[0].between(shapes[1], at)?;
        let found = shape.shear()?;
        if (part - at).abs() < 1e-12 {
            return Some(found);
        }
        let half = if k == 0 || k == last { 0.5 } else { 1.0 };
        let sign = if k % 2 == 0 { half } else { -half };
        let weight = sign / (part - at);
        all += weight;
        let found = with_compliance_times(found, shape.area());
        for (sum, number) in sum.iter_mut().zip(flat(&found)) {
            *sum += weight * number;
        }
    }
    let found = unflat(sum.map(|of| of / all));
    let area = shapes[0].between(shapes[1], part)?.area();
    Some(with_compliance_times(found, 1.0 / area))
}

fn with_compliance_times(mut of: ShearNumbers, factor: f64) -> ShearNumbers {
    of.compliance = of.compliance.map(|of| of * factor);
    of
}

/// All numbers one after the other.
fn flat(of: &ShearNumbers) -> [f64; 10] {
    let [first, second] = of.compliance;
    let [y, z] = of.shear_center;
    [
        of.torsion_constant,
        of.error,
        y,
        z,
        first[(0, 0)],
        first[(0, 1)],
        first[(1, 1)],
        second[(0, 0)],
        second[(0, 1)],
        second[(1, 1)],
    ]
}

fn unflat([torsion_constant, error, y, z, a, b, c, d, e, f]: [f64; 10]) -> ShearNumbers {
    ShearNumbers {
        torsion_constant,
        error,
        shear_center: [y, z],
        compliance: [Matrix2::new(a, b, b, c), Matrix2::new(d, e, e, f)],
    }
}

/// Linear between numbers on both sides, of which the part of the second counts.
pub fn mixed(sides: [&ShearNumbers; 2], part: f64) -> ShearNumbers {
    let [a, b] = sides.map(flat);
    unflat(std::array::from_fn(|k| a[k] + part * (b[k] - a[k])))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box whose sizes change to less than half and a letter L, at places between the shapes that are solved.
    #[test]
    fn numbers_between_stations_are_those_of_the_shape_there() {
        let ends = |t: f64| {
            [
                Profile::Box {
                    width: 0.3 * t,
                    height: 0.2,
                    web_thickness: 0.02 * t,
                    flange_thickness: 0.03 * t,
                },
                Profile::L {
                    width: 0.1,
                    height: 0.2 * t,
                    web_thickness: 0.02,
                    flange_thickness: 0.03 * t,
                },
            ]
        };
        for (first, last) in ends(1.0).into_iter().zip(ends(0.4)) {
            for part in [0.0, 0.2, 0.63] {
                let shape = first.between(&last, part).expect("one kind");
                let [found, wanted] =
                    [between([&first, &last], part), shape.shear()].map(|of| of.expect("numbers"));
                let pairs = flat(&found).into_iter().zip(flat(&wanted)).enumerate();
                // All but the error; shear centres by the size of the section.
                for (k, (found, wanted)) in pairs.filter(|(k, _)| *k != 1) {
                    let size = if matches!(k, 2 | 3) {
                        0.1
                    } else {
                        flat(&found_size(&shape))[k]
                    };
                    assert!(
                        (found - wanted).abs() < 2e-4 * size,
                        "{part} {k} {found} {wanted}"
                    );
                }
            }
        }
    }

    /// Numbers with sizes in place of those that may be zero.
    fn found_size(shape: &Profile) -> ShearNumbers {
        let mut size = shape.shear().expect("numbers");
        let of = |matrix: &Matrix2<f64>| matrix[(0, 0)].abs().max(matrix[(1, 1)].abs());
        let largest = of(&size.compliance[0]).max(of(&size.compliance[1]));
        size.compliance = [Matrix2::from_element(largest); 2];
        size
    }

    /// What is solved once is found again with the same bits, and an outline that crosses itself has no numbers.
    #[test]
    fn a_shape_is_solved_once() {
        let shape = Profile::Polygon {
            outline: vec![[0.0, 0.0], [3.0, 0.0], [1.0, 1.0]],
            holes: Vec::new(),
        };
        let first = numbers(&shape);
        assert!(first.is_some());
        assert_eq!(numbers(&shape), first);
        let key = key(&shape, &shape.loops().expect("loops"));
        assert_eq!(locked(&NUMBERS).get(&key), Some(&first));
        let crossed = Profile::Polygon {
            outline: vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
            holes: Vec::new(),
        };
        assert_eq!(numbers(&crossed), None);
        assert_eq!(crossed.numbers().torsion_constant, 0.0);
    }
}
