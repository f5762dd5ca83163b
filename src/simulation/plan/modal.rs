//! Rods and beams that bend little, as modes.

use super::ladder::Choice;
use super::outputs::Difference;
use super::search::{OF_SPACE, Search, cables};
use crate::scene::{LineBody, Model, Scene};

/// Most natural modes with held interfaces that are tried: deflections that more of them do not describe better are too large for modes.
const MOST_MODES: u32 = 8;
/// Part of the work with elements that modes may take.
const CHEAPER: f64 = 0.8;

/// The scene with a line reduced to modes, by its place among the bodies.
fn with_modes(mut scene: Scene, body: usize, modes: u32) -> Scene {
    if let Some(line) = scene.bodies[body].cable_mut() {
        line.model = Model::Modal;
        line.modes = Some(modes);
    }
    scene
}

/// The scene with the modes of a choice, over a scene with its elements.
pub(super) fn with_all_modes(scene: Scene, choice: &Choice) -> Scene {
    let bodies: Vec<usize> = cables(&scene).map(|(body, _)| body).collect();
    let modal = bodies.into_iter().zip(&choice.modes);
    modal.fold(scene, |scene, (body, modes)| match modes {
        Some(modes) => with_modes(scene, body, *modes),
        None => scene,
    })
}

impl Search<'_, '_> {
    /// Reduces lines that were found to bend to modes where these change no output by more than may be against twice the mesh, and cost less.
    /// Returns what they change, or what was found with elements.
    pub(super) fn reduce_lines(
        &mut self,
        choice: &mut Choice,
        found: Vec<Difference>,
    ) -> Vec<Difference> {
        let may_be: Vec<bool> = cables(self.scene)
            .zip(&choice.elements)
            .map(|((body, line), count)| *count > 0 && self.may_be_modal(body, line))
            .collect();
        let with = |choice: &Choice, count: u32| Choice {
            modes: may_be
                .iter()
                .map(|may_be| may_be.then_some(count))
                .collect(),
            ..choice.clone()
        };
        let mut closer = choice.clone();
        if self.is_cut || !may_be.contains(&true) || !self.refine(&mut closer) {
            return found;
        }
        let closer = self.with_more_modes(&closer);
        let mut before = f64::INFINITY;
        let mut count = 1;
        while count <= MOST_MODES {
            let tried = with(choice, count);
            let Ok(now) = self.compare(&tried, &closer, self.error) else {
                return found;
            };
            if now.iter().all(|of| of.largest <= OF_SPACE * self.error) {
                let works = [&tried, choice].map(|made| self.known(made).map(|run| run.work));
                let is_cheaper = works[0] < works[1].map(|work| CHEAPER * work);
                if is_cheaper {
                    *choice = tried;
                    return now;
                }
                return found;
            }
            let largest = now.iter().map(|of| of.largest).fold(0.0, f64::max);
            // More modes do not come closer: deflections are too large.
            if largest > 0.5 * before {
                return found;
            }
            (before, count) = (largest, 2 * count);
        }
        found
    }

    /// Whether modes are left to the planner and valid of a line.
    fn may_be_modal(&self, body: usize, line: &LineBody) -> bool {
        let is_open = line.elements.is_none() && line.model == Model::Auto;
        is_open && with_modes(self.scene.clone(), body, 1).resolve().is_ok()
    }
}
