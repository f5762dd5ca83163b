//! How far bodies move in a run, and how far they deform: what of a motion a tolerance must resolve.

use nalgebra::Vector3;

use crate::simulation::{Error, Simulation};

/// Points of an element that its place is told by, and fewest and most points of a body.
const AN_ELEMENT: u32 = 2;
const LEAST: u32 = 4;
const MOST: u32 = 64;

/// The largest displacements of bodies so far.
pub(super) struct LargestDisplacements {
    drawn: Vec<Vec<[f64; 3]>>,
    /// Places among the bodies of those along lines, plates and shells.
    lines: Vec<usize>,
    /// Largest displacement of every body from where it was drawn, m.
    pub moved: Vec<f64>,
    /// Largest elastic displacement of every body, m: zero of rigid ones.
    pub deformed: Vec<f64>,
    /// Largest error (m) that the meshes of plates and shells make along both directions, with the places of the bodies.
    pub missed: Vec<(usize, [f64; 2])>,
}

/// Parts that a body of so many elements is cut into.
fn parts(elements: usize) -> u32 {
    let elements = u32::try_from(elements).unwrap_or(MOST);
    elements.saturating_mul(AN_ELEMENT).clamp(LEAST, MOST)
}

impl LargestDisplacements {
    /// Starts to record an initialized simulation.
    pub fn new(simulation: &Simulation) -> Self {
        let drawn = simulation.drawn_outlines(parts);
        let bodies = drawn.len();
        let lines = simulation.scene().bodies.iter().enumerate();
        let lines = lines.filter(|(_, body)| body.cable().is_some() || body.patch().is_some());
        Self {
            drawn,
            lines: lines.map(|(index, _)| index).collect(),
            moved: vec![0.0; bodies],
            deformed: vec![0.0; bodies],
            missed: Vec::new(),
        }
    }

    /// Takes the present state into account.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn take(&mut self, simulation: &mut Simulation) -> Result<(), Error> {
        let now = simulation.outlines(parts)?;
        for (moved, (drawn, now)) in self.moved.iter_mut().zip(self.drawn.iter().zip(&now)) {
            let pairs = drawn.iter().zip(now);
            let far = pairs.map(|(a, b)| (Vector3::from(*b) - Vector3::from(*a)).norm());
            *moved = far.fold(*moved, f64::max);
        }
        let elastic = simulation.elastic_displacements()?;
        for (body, elastic) in self.lines.iter().zip(elastic) {
            self.deformed[*body] = self.deformed[*body].max(elastic);
        }
        let missed = simulation.missed_by_patches()?;
        if self.missed.is_empty() {
            self.missed = missed;
            return Ok(());
        }
        for ((_, largest), (_, now)) in self.missed.iter_mut().zip(&missed) {
            for (largest, now) in largest.iter_mut().zip(now) {
                *largest = largest.max(*now);
            }
        }
        Ok(())
    }
}
