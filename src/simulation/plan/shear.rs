//! Bodies whose element is chosen: whether shear moves an output by more than the error wanted, by runs with the mesh that was
//! found and the same bodies as beams.

use super::ladder::Choice;
use super::search::{Search, cables, fewest};
use super::time::tenth;
use crate::scene::{Body, Chosen, Error, LineBody, Scene};

/// A body that may be a beam.
pub(super) struct Beam {
    /// Index among the bodies.
    body: usize,
    /// Index among the line bodies.
    cable: usize,
    /// As a beam.
    made: LineBody,
    /// The fewest elements it has then: markers of a cable need no nodes.
    fewest: u32,
}

/// Influence of the shear of a body on the outputs.
pub(super) struct Sheared {
    /// Place of the body among those of the scene.
    body: usize,
    /// The output that it moves most, and by how much, relative; nothing where that could not be run.
    moved: Option<(String, f64)>,
}

impl Beam {
    /// Bodies of a scene that may be beams.
    ///
    /// # Errors
    /// Markers that are too close for nodes.
    pub fn all(scene: &Scene, chosen: &[Chosen]) -> Result<Vec<Self>, Error> {
        let mut found = Vec::new();
        for of in chosen {
            let Some(made) = &of.beam else { continue };
            let mut beam = Self {
                body: of.body,
                cable: cables(scene)
                    .take_while(|(body, _)| *body < of.body)
                    .count(),
                made: (**made).clone(),
                fewest: 1,
            };
            let mut with = scene.clone();
            beam.put_into(&mut with);
            beam.fewest = fewest(&with)?[beam.cable];
            found.push(beam);
        }
        Ok(found)
    }

    /// Puts the beam in the place of what the body is.
    pub fn put_into(&self, scene: &mut Scene) {
        scene.bodies[self.body] = Body::Beam(self.made.clone());
    }
}

impl Search<'_, '_> {
    /// Measures the influence of shear with the chosen mesh: for all possible beams together, and for each alone if the
    /// first exceeds the wanted error. If none alone exceeds it, all count.
    pub fn shear(&mut self, choice: &Choice) -> Vec<Sheared> {
        let all: Vec<usize> = (0..self.beams.len()).collect();
        if all.is_empty() {
            return Vec::new();
        }
        let together = self.sheared(choice, &all);
        let error = self.error;
        let is_more = |moved: &Option<(String, f64)>| {
            moved.as_ref().is_none_or(|(_, largest)| *largest > error)
        };
        let mut each = vec![together.clone(); all.len()];
        if all.len() > 1 && is_more(&together) {
            let alone: Vec<_> = all.iter().map(|k| self.sheared(choice, &[*k])).collect();
            if alone.iter().any(is_more) {
                each = alone;
            }
        }
        let bodies = self.beams.iter().map(|beam| beam.body);
        let sheared = bodies
            .zip(each)
            .map(|(body, moved)| Sheared { body, moved });
        sheared.collect()
    }

    /// The output that changes most where these bodies are beams: at a tenth of the tolerance, since errors of time of two runs
    /// would be taken for shear.
    fn sheared(&mut self, choice: &Choice, beams: &[usize]) -> Option<(String, f64)> {
        let mut same = choice.clone();
        same.tolerance = tenth(choice.tolerance);
        for beam in beams {
            let Beam { cable, fewest, .. } = self.beams[*beam];
            same.elements[cable] = same.elements[cable].max(fewest);
        }
        let sheared = Choice {
            beams: beams.to_vec(),
            ..same.clone()
        };
        let changes = self.compare(&same, &sheared, self.error).ok()?;
        let named = changes.iter().enumerate();
        let named = named.map(|(index, change)| (self.name(index), change.largest));
        named.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Sheared {
    /// Decides whether the body is a beam.
    pub fn judge(&self, chosen: &mut [Chosen], error: f64, dimension: usize) {
        let Some(of) = chosen.iter_mut().find(|of| of.body == self.body) else {
            return;
        };
        match &self.moved {
            Some((name, part)) => {
                of.judge_shear(*part, error, &format!("moves {name} by {part:.1e}"))
            }
            None => of.estimate_shear(error, dimension),
        }
    }
}
