//! Strains and curvatures of an element at its places of Gauss, which section forces and stress are recovered from.
//!
//! Source: J. Kiendl et al., Comput. Methods Appl. Mech. Eng. 198 (2009), Eqs. 6-19 (strains and curvatures).

use super::grid::Grid;
use super::kernel::{Single, curvature, strain_rate};
use super::{ElementCorners, Shell, scaled};
use crate::math::jet::Number;

/// Membrane strains and changes of curvature (1/m) at the 3 x 3 places of Gauss of an element: by component 11, 22 and 12 (twice the strain and
/// the curvature) and by place along both directions. Covariant components, by the lengths along both directions.
pub type GaussStrains<N = f64> = [[[[N; 3]; 3]; 3]; 2];

impl Shell {
    /// Strains and changes of curvature at the places of Gauss; with rates of the coordinates plus the damping time times their rates.
    pub fn strains<N: Number>(
        &self,
        e: &ElementCorners<N>,
        rate: Option<&ElementCorners<N>>,
    ) -> GaussStrains<N> {
        let scales = self.scales_of();
        let grid = Grid::of(&scaled(e, &scales));
        let (curved, frames) = curvature(&grid);
        let strain = self.kernel.strain(&grid, &curved, Single);
        let mut out = [strain.membrane, strain.curvature];
        if let Some(rate) = rate.filter(|_| self.is_damped()) {
            let rates = strain_rate(&grid, &frames, &Grid::of(&scaled(rate, &scales)));
            let time = N::of(self.kernel.damping_time);
            for (sums, rates) in out.iter_mut().zip([rates.membrane, rates.curvature]) {
                let sums = sums.as_flattened_mut().as_flattened_mut().iter_mut();
                let rates = rates.as_flattened().as_flattened();
                sums.zip(rates).for_each(|(sum, rate)| *sum += time * *rate);
            }
        }
        let [a, b] = self.sizes;
        for components in &mut out {
            for (component, by) in components.iter_mut().zip([a * a, b * b, a * b]) {
                let values = component.as_flattened_mut().iter_mut();
                values.for_each(|value| *value *= N::of(by.recip()));
            }
        }
        out
    }
}
