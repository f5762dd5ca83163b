//! Stress at points of reduced bodies.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (stresses by modes); R. von Mises, Mechanik
//! der festen Körper im plastisch-deformablen Zustand, Göttinger Nachrichten (1913) 582-592 (equivalent stress).

use super::evaluation::Evaluation;
use crate::math::jet::Number;
use crate::system::System;

/// Symmetric tensor `xx yy zz xy xz yz`.
type Stress<N = f64> = [N; 6];

/// A point of a reduced body whose stress is read.
#[derive(Clone, Debug)]
pub struct Gauge {
    /// Index among the reduced bodies of the system.
    pub body: usize,
    /// Stress by modes, `xx yy zz xy xz yz`, `[modes]`, Pa.
    pub by_modes: Vec<Stress>,
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Stress at a point of a reduced body, `xx yy zz xy xz yz` along the axes that the stresses by modes have, Pa.
    pub fn stress_tensor(&self, system: &System<D>, gauge: &Gauge) -> Stress<N> {
        system.bodies.reduced()[gauge.body].stress(&gauge.by_modes, &self.x)
    }
}

/// Equivalent stress of von Mises, Pa. Where there is no stress its derivatives are zero: it has a kink there.
pub fn von_mises<N: Number>(stress: Stress<N>) -> N {
    let [xx, yy, zz, xy, xz, yz] = stress;
    let square = |of: N| of * of;
    let normal = square(xx - yy) + square(yy - zz) + square(zz - xx);
    let shear = square(xy) + square(xz) + square(yz);
    let sum = normal * N::of(0.5) + shear * N::of(3.0);
    sum.map(f64::sqrt, |sum| {
        let root = sum.sqrt();
        if root > 0.0 {
            [root, 0.5 / root, -0.25 / (sum * root)]
        } else {
            [0.0; 3]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::jet::Jet;

    /// Tension, pressure from all sides, shear, and a plane state with both.
    #[test]
    fn equivalent_stress_is_that_of_tension() {
        for (stress, expected) in [
            ([3.0, 0.0, 0.0, 0.0, 0.0, 0.0], 3.0),
            ([0.0, -3.0, 0.0, 0.0, 0.0, 0.0], 3.0),
            ([5.0, 5.0, 5.0, 0.0, 0.0, 0.0], 0.0),
            ([0.0, 0.0, 0.0, 2.0, 0.0, 0.0], 12.0_f64.sqrt()),
            ([0.0, 0.0, 0.0, 0.0, 2.0, 0.0], 12.0_f64.sqrt()),
            ([0.0, 0.0, 0.0, 0.0, 0.0, 2.0], 12.0_f64.sqrt()),
            ([4.0, 1.0, 0.0, 0.0, 0.0, 1.0], 4.0),
        ] {
            let found = von_mises::<f64>(stress);
            assert!((found - expected).abs() < 1e-15, "{stress:?}: {found}");
        }
    }

    /// Along a way in which all components change, against finite differences; zero where there is no stress.
    #[test]
    fn equivalent_stress_has_its_derivatives() {
        let (at, rate) = (
            [3.0, -1.0, 2.0, 0.5, 1.5, -2.0],
            [1.0, 2.0, -1.0, 0.5, 0.25, 3.0],
        );
        let jets: [Jet; 6] = std::array::from_fn(|k| Jet::new(at[k], rate[k], 0.0));
        let value = |s: f64| von_mises::<f64>(std::array::from_fn(|k| at[k] + s * rate[k]));
        let (h, found) = (1e-3, von_mises(jets));
        let first = (value(h) - value(-h)) / (2.0 * h);
        let second = (value(h) - 2.0 * value(0.0) + value(-h)) / (h * h);
        assert!((found.re - value(0.0)).abs() < 1e-14);
        assert!((found.v1 - first).abs() < 1e-5, "{} {first}", found.v1);
        assert!((found.v2 - second).abs() < 1e-5, "{} {second}", found.v2);
        let none = von_mises([Jet::new(0.0, 1.0, 1.0); 6]);
        assert_eq!([none.re, none.v1, none.v2], [0.0; 3]);
        let kink = von_mises(std::array::from_fn(|k| Jet::new(0.0, rate[k], 0.0)));
        assert_eq!([kink.re, kink.v1, kink.v2], [0.0; 3]);
    }
}
