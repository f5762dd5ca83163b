//! How far bodies move in a run, and how far they deform: what of a motion a tolerance must resolve.

use nalgebra::{Matrix3, Vector3};

use crate::simulation::{Error, Simulation};

/// Points of an element that its shape is told by, and most points of a body.
const AN_ELEMENT: u32 = 2;
const LEAST: u32 = 4;
const MOST: u32 = 64;

/// The largest displacements of bodies so far.
pub(super) struct Motion {
    drawn: Vec<Vec<Vector3<f64>>>,
    /// Largest displacement of every body from where it was drawn, m.
    pub moved: Vec<f64>,
    /// Largest displacement of every body from the rigid motion of its drawn shape that is nearest to it, m: zero of rigid ones.
    pub deformed: Vec<f64>,
}

/// Parts that a body of so many elements is cut into.
fn parts(elements: usize) -> u32 {
    let elements = u32::try_from(elements).unwrap_or(MOST);
    elements.saturating_mul(AN_ELEMENT).clamp(LEAST, MOST)
}

fn vectors(outlines: Vec<Vec<[f64; 3]>>) -> Vec<Vec<Vector3<f64>>> {
    let of_body = |body: Vec<[f64; 3]>| body.into_iter().map(Vector3::from).collect();
    outlines.into_iter().map(of_body).collect()
}

impl Motion {
    /// Of a simulation that has been initialized.
    pub fn new(simulation: &Simulation) -> Self {
        let drawn = vectors(simulation.drawn_outlines(parts));
        let bodies = drawn.len();
        Self {
            drawn,
            moved: vec![0.0; bodies],
            deformed: vec![0.0; bodies],
        }
    }

    /// Takes the present state into account.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn take(&mut self, simulation: &mut Simulation) -> Result<(), Error> {
        let now = vectors(simulation.outlines(parts)?);
        for (body, (drawn, now)) in self.drawn.iter().zip(&now).enumerate() {
            let far = drawn.iter().zip(now).map(|(a, b)| (b - a).norm());
            self.moved[body] = far.fold(self.moved[body], f64::max);
            self.deformed[body] = self.deformed[body].max(deformation(drawn, now));
        }
        Ok(())
    }
}

/// The largest distance of points from where the nearest rigid motion carries them, m.
///
/// Source: K. S. Arun, T. S. Huang, S. D. Blostein, Least-squares fitting of two 3-D point sets, IEEE Trans. Pattern Anal. Mach. Intell. 9
/// (1987): the rotation by a singular value decomposition.
fn deformation(drawn: &[Vector3<f64>], now: &[Vector3<f64>]) -> f64 {
    if drawn.len() < 3 {
        return 0.0;
    }
    let mean = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let [from, to] = [mean(drawn), mean(now)];
    let pairs = drawn.iter().zip(now);
    let moments = pairs.clone().fold(Matrix3::zeros(), |sum, (a, b)| {
        sum + (b - to) * (a - from).transpose()
    });
    let found = moments.svd(true, true);
    let (Some(u), Some(v)) = (found.u, found.v_t) else {
        return 0.0;
    };
    // A mirror image is no rotation.
    let sign = (u * v).determinant().signum();
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
    let far = pairs.map(|(a, b)| (b - to - rotation * (a - from)).norm());
    far.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line that bends to an arc of small height deforms by about half that height; one that turns does not.
    #[test]
    fn rigid_motions_deform_nothing() {
        let line: Vec<_> = (0..9)
            .map(|k| Vector3::new(f64::from(k), 0.0, 0.0))
            .collect();
        let turned: Vec<_> = (line.iter())
            .map(|p| Vector3::new(1.0 - p.y, 2.0, p.x + 3.0))
            .collect();
        assert!(deformation(&line, &turned) < 1e-12);
        let height = 1e-6;
        let bent: Vec<_> = (turned.iter().zip(&line))
            .map(|(p, l)| p + Vector3::x() * height * l.x * (8.0 - l.x) / 16.0)
            .collect();
        let found = deformation(&line, &bent);
        assert!((0.5 * height..height).contains(&found), "{found}");
    }
}
