//! Stress at the bottom and the top of a patch at a grid of points, for pictures.

use super::recovery::{RecoveryLine, stress_at, times};
use super::{GaussStrains, Patch};
use crate::bodies::connectivity::Node;
use crate::elements::shell::{ShellSection, Stiffness};

/// Section of a patch whose stress is known, with heights (m) of its bottom and top and stress there of strains along its axes, Pa.
#[derive(Clone, Copy, Debug)]
pub struct SectionFaces {
    /// The section.
    pub section: ShellSection,
    /// Height along the normal, and stress of strains: of the bottom, then of the top.
    pub faces: [(f64, Stiffness); 2],
}

/// Reader of stress at a grid of points.
#[derive(Clone, Debug)]
pub struct GridStress {
    /// Heights and laws of bottom and top, at every point.
    faces: Vec<[(f64, Stiffness); 2]>,
    lines: [Vec<RecoveryLine>; 2],
    /// Takes covariant components to those along the axes of the section, at every point.
    to_axes: Vec<[[f64; 3]; 3]>,
    /// Scratch: strains of all elements.
    strains: Vec<GaussStrains>,
}

impl Patch {
    /// Reader of stress at a grid of points, whose coordinates along both directions are in [0, 1]; none where the section does not tell it.
    pub fn grid_stress(
        &self,
        of: impl Fn([f64; 2]) -> Option<SectionFaces>,
        at: &[Vec<f64>; 2],
    ) -> Option<GridStress> {
        let line = |k: usize| at[k].iter().map(move |at| self.recovery_line(k, *at));
        let points = at[0].iter().flat_map(|a| at[1].iter().map(|b| [*a, *b]));
        let (mut faces, mut to_axes) = (Vec::new(), Vec::new());
        for at in points {
            let of = of(at)?;
            let (element, xi) = self.find(at);
            faces.push(of.faces);
            to_axes.push(of.section.axes_transformation(&self.tangents(element, xi)));
        }
        Some(GridStress {
            faces,
            lines: [line(0).collect(), line(1).collect()],
            to_axes,
            strains: vec![[[[[0.0; 3]; 3]; 3]; 2]; self.elements.len()],
        })
    }
}

impl GridStress {
    /// Stress 11, 22 and 12 at the bottom, then at the top, along the axes of the section at every point, with that of damping, Pa.
    pub fn read<const D: usize>(
        &mut self,
        patch: &Patch,
        (x, v): (&[Node<D>], &[Node<D>]),
    ) -> Vec<[f64; 6]> {
        for (element, strains) in self.strains.iter_mut().enumerate() {
            let [e, rate] = [x, v].map(|x| patch.element(element, x));
            *strains = patch.elements[element].strains(&e, Some(&rate));
        }
        let across = self.lines[1].iter();
        let pairs = (self.lines[0].iter()).flat_map(|a| across.clone().map(move |b| [a, b]));
        let stress = |(lines, point): (_, usize)| {
            let (faces, to_axes) = (&self.faces[point], &self.to_axes[point]);
            let of = patch.recovered(lines, |element| self.strains[element]);
            let of = of.map(|of| times(to_axes, of));
            let [bottom, top] = faces
                .each_ref()
                .map(|(height, law)| stress_at((*height, law), of));
            [bottom[0], bottom[1], bottom[2], top[0], top[1], top[2]]
        };
        pairs.zip(0..).map(stress).collect()
    }
}
