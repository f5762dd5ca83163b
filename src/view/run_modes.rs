//! What changes at many points in a run as few modes, found in the run.
//!
//! Source: L. Sirovich, Turbulence and the dynamics of coherent structures, Q. Appl. Math. 45 (1987) 561-571 (modes of a run); here they are
//! taken one by one, each from the frame that is farthest from those before.

use nalgebra::SVector;

/// Vectors at all points.
pub(super) type PointVectors<const K: usize> = Vec<SVector<f64, K>>;

/// Modes with their amplitudes in all frames.
#[derive(Clone, Debug)]
pub(super) struct RunModes<const K: usize> {
    /// Vectors at all points by each mode.
    pub modes: Vec<PointVectors<K>>,
    /// Amplitudes, `[frames][modes]`.
    pub amplitudes: Vec<Vec<f64>>,
}

impl<const K: usize> RunModes<K> {
    /// At most so many modes of vectors in all frames, up to a part of the largest vector that is not seen.
    pub fn of(mut left: Vec<PointVectors<K>>, most: usize, unseen: f64) -> Self {
        let far = |ways: &PointVectors<K>| ways.iter().map(SVector::norm).fold(0.0, f64::max);
        let least = unseen * left.iter().map(far).fold(0.0, f64::max);
        let mut modes: Vec<PointVectors<K>> = Vec::new();
        let mut amplitudes: Vec<Vec<f64>> = vec![Vec::new(); left.len()];
        while modes.len() < most {
            let sizes = left.iter().map(far).enumerate();
            let Some((farthest, size)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else {
                break;
            };
            if size <= least || size <= 0.0 {
                break;
            }
            let sum = |a: &PointVectors<K>, b: &PointVectors<K>| -> f64 {
                a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
            };
            let mode = left[farthest].clone();
            let square = sum(&mode, &mode);
            for (ways, amplitudes) in left.iter_mut().zip(&mut amplitudes) {
                let amplitude = sum(ways, &mode) / square;
                amplitudes.push(amplitude);
                for (way, of_mode) in ways.iter_mut().zip(&mode) {
                    *way -= of_mode * amplitude;
                }
            }
            modes.push(mode);
        }
        Self { modes, amplitudes }
    }
}

/// Numbers of modes, point by point, as a table of a page.
pub(super) fn by_points<const K: usize>(modes: &[PointVectors<K>], points: usize) -> Vec<Vec<f64>> {
    (0..points).map(|point| at_point(modes, point)).collect()
}

/// Numbers of modes at a point.
pub(super) fn at_point<const K: usize>(modes: &[PointVectors<K>], point: usize) -> Vec<f64> {
    let modes = modes.iter();
    modes.flat_map(|ways| ways[point].iter().copied()).collect()
}
