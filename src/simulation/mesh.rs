//! Meshes that do not carry the shapes that bodies have: what is read of it, and told once.

use super::Quantity;
use super::engine::Engine;
use super::inputs::Inputs;
use super::once::Once;
use super::watch::is_sampled;
use crate::bodies::{LineChain, Patch};
use crate::math::jet::Number;
use crate::scene::Assembled;
use crate::system::{Evaluation, State};

/// Part of [`Evaluation::missed`] that positions are off by, about: mostly 0.03 to 0.6 on 22 scenes, for errors of
/// 1e-6 to 1 of their sizes (docs/decisions/0036-resolution.md).
const OFF: f64 = 0.2;

/// Error in position that meshes make in the present shapes, over the error wanted.
pub(super) fn resolution<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
) -> N {
    let system = &assembled.system;
    let mut largest = N::of(0.0);
    for chain in system.bodies().lines() {
        let off = off(values, assembled, chain);
        if off > largest {
            largest = off;
        }
    }
    for patch in system.bodies().patches() {
        let off = off_surface(values, assembled, patch);
        if off > largest {
            largest = off;
        }
    }
    largest * N::of(1.0 / (system.size() * assembled.error))
}

/// Error in position that the mesh of a plate or shell makes in its present shape, m.
fn off_surface<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    patch: &Patch,
) -> N {
    let Assembled { system, nodes, .. } = assembled;
    let mut largest = values.surface_bent_away(patch, nodes);
    for along in 0..2 {
        let missed = values.missed_along(system, (patch, nodes), along);
        let jumps = missed.map_or(N::of(0.0), |missed| missed * N::of(OFF));
        if jumps > largest {
            largest = jumps;
        }
    }
    largest
}

/// Error in position that the mesh of a chain makes in its present shape, m.
fn off<const D: usize, N: Number>(
    values: &Evaluation<D, N>,
    assembled: &Assembled<D>,
    chain: &LineChain<D>,
) -> N {
    let Assembled { system, nodes, .. } = assembled;
    let jumps = values.missed(system, chain) * N::of(OFF);
    let bends = values.bent_away(chain, nodes);
    if bends > jumps { bends } else { jumps }
}

/// Whether meshes have been found too coarse.
#[derive(Default)]
pub(super) struct MeshWatch {
    /// Communication points so far.
    points: u64,
    /// The body, and the resolution when it first passed 1.
    found: Once<(usize, f64)>,
}

/// A mesh that is too coarse for the error wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unresolved<'a> {
    /// The body.
    pub body: &'a str,
    /// The resolution.
    pub resolution: f64,
    /// The error wanted.
    pub error: f64,
}

impl std::fmt::Display for Unresolved<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            body,
            resolution,
            error,
        } = self;
        write!(
            f,
            "resolution: {resolution:.1}, expected at most 1: the mesh of {body} does not carry its shape for an error of \
             {error:e}; give it more elements"
        )
    }
}

impl<const D: usize> Engine<D> {
    /// Error in position (m) that the mesh of every plate and shell makes along `s1` and `s2`, by jumps of curvature: infinite where no
    /// node tells. In the order of the bodies, by their places.
    pub(super) fn missed_by_patches(
        &mut self,
        state: &State,
        inputs: &Inputs,
    ) -> Vec<(usize, [f64; 2])> {
        let bodies = self.assembled.system.bodies().ranges.len();
        let (assembled, values) = self.placed(state, inputs);
        let Assembled { system, nodes, .. } = assembled;
        let of = |body: usize| {
            let patch = assembled.patch(body)?;
            let missed = [0, 1].map(|along| {
                let missed = values.missed_along(system, (patch, nodes), along);
                missed.map_or(f64::INFINITY, |missed| OFF * missed)
            });
            Some((body, missed))
        };
        (0..bodies).filter_map(of).collect()
    }

    /// Looks at the meshes at communication points that are sampled until they are first too coarse.
    pub(super) fn watch_mesh(&mut self, state: &State, inputs: &Inputs) {
        self.mesh.points += 1;
        if !self.mesh.found.is_open() || !is_sampled(self.mesh.points) {
            return;
        }
        let resolution = self.output(Quantity::Resolution, state, inputs);
        if resolution <= 1.0 {
            return;
        }
        let (assembled, values) = self.placed(state, inputs);
        let system = &assembled.system;
        let bodies = system.bodies();
        let lines = bodies.lines().iter();
        let lines = lines.map(|chain| (chain.first_node(), off(values, assembled, chain)));
        let patches = bodies.patches().iter();
        let patches =
            patches.map(|patch| (patch.mesh_node(0, 0), off_surface(values, assembled, patch)));
        let worst = lines.chain(patches).max_by(|a, b| a.1.total_cmp(&b.1));
        let body = worst.and_then(|(first, _)| bodies.body_from(first));
        self.mesh.found.find(body.map(|body| (body, resolution)));
    }

    /// A mesh that has become too coarse for its shape and that has not been told of.
    pub(super) fn next_unresolved(&mut self) -> Option<Unresolved<'_>> {
        let (body, resolution) = self.mesh.found.tell()?;
        Some(Unresolved {
            body: &self.bodies[body],
            resolution,
            error: self.assembled.error,
        })
    }
}
