//! Reduced bodies that deform beyond what their models hold.
//!
//! Source: S. R. Idelsohn, A. Cardona, A reduction method for nonlinear structural dynamic analysis, Comput. Methods Appl. Mech. Eng. 49
//! (1985) 253-279 (modes with second-order terms hold moderate displacements).

use std::fmt;

use super::engine::Engine;
use super::inputs::Inputs;
use super::once::Once;
use crate::scene::{BodyReference, Resolved};
use crate::system::State;

/// Displacement of an interface, relative to the size of its body, up to which a reduced model holds.
const DISPLACEMENT: f64 = 0.1;
/// Rotation of an interface up to which it holds, rad.
const ROTATION: f64 = 0.3;

/// Reduced bodies of a scene.
#[derive(Default)]
pub(super) struct DeformationWatch {
    bodies: Vec<Watched>,
}

struct Watched {
    /// Index of the body in the scene.
    body: usize,
    /// Displacement and rotation when they were first too large.
    found: Once<[f64; 2]>,
}

/// A reduced body whose deformation has left the range of its model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverDeformed<'a> {
    /// The body.
    pub body: &'a str,
    /// Largest displacement of an interface against the axes of the body, relative to its size.
    pub displacement: f64,
    /// Largest rotation of an interface against these axes, rad.
    pub rotation: f64,
}

impl fmt::Display for OverDeformed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: its deformation leaves the range of a reduced model: interfaces have moved by {:.2} of its size (expected at most {DISPLACEMENT}) and \
             rotated by {:.2} rad (expected at most {ROTATION}); several reduced bodies welded together hold more",
            self.body, self.displacement, self.rotation
        )
    }
}

impl DeformationWatch {
    /// Collects the reduced bodies of a scene.
    pub(super) fn new(resolved: &Resolved<'_>) -> Self {
        let bodies = resolved.bodies.iter().enumerate();
        let reduced = bodies.filter(|(_, body)| match body {
            BodyReference::Reduced(of) => !of.body.is_rigid(),
            BodyReference::Cable(cable) => cable.is_modal(),
            BodyReference::Rigid(_) | BodyReference::Plate(_) => false,
        });
        Self {
            bodies: reduced
                .map(|(body, _)| Watched {
                    body,
                    found: Once::default(),
                })
                .collect(),
        }
    }
}

impl<const D: usize> Engine<D> {
    /// Looks at a communication point at how far reduced bodies have deformed.
    pub(super) fn watch_deformation(&mut self, state: &State, inputs: &Inputs) {
        let mut watch = std::mem::take(&mut self.deformation);
        for (index, watched) in watch.bodies.iter_mut().enumerate() {
            if !watched.found.is_open() {
                continue;
            }
            let (assembled, values) = self.placed(state, inputs);
            let body = &assembled.system.bodies().reduced()[index];
            let found = body.deformation(&values.x);
            let [displacement, rotation] = found;
            let is_beyond = displacement > DISPLACEMENT || rotation > ROTATION;
            watched.found.find(is_beyond.then_some(found));
        }
        self.deformation = watch;
    }

    /// A reduced body that has deformed too far and that has not been told of.
    pub(super) fn next_over_deformed(&mut self) -> Option<OverDeformed<'_>> {
        let mut bodies = self.deformation.bodies.iter_mut();
        let next = bodies.find_map(|watched| Some((watched.body, watched.found.tell()?)));
        let (body, [displacement, rotation]) = next?;
        Some(OverDeformed {
            body: &self.bodies[body],
            displacement,
            rotation,
        })
    }
}
