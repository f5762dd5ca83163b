//! Where bodies are, for pictures.

use super::engine::Engine;
use super::{Error, Simulation};
use crate::body::{Marker, Node};
use crate::math::space::{Vector, components};
use crate::system::{State, System};

impl Simulation {
    /// Where all markers are now, m: body by body, in the order of their names; the third component is zero in the
    /// plane.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn markers(&mut self) -> Result<Vec<[f64; 3]>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut();
        let markers = engine.map(|engine| engine.markers(&self.state, &self.inputs.values));
        Ok(markers.unwrap_or_default())
    }

    /// Where points along every body are now, m: the ends of as many equal lengths of a cable as `parts` makes of its
    /// number of elements, the centre of mass of a rigid body; the third component is zero in the plane.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn outlines(&mut self, parts: impl Fn(usize) -> u32) -> Result<Vec<Vec<[f64; 3]>>, Error> {
        self.refresh()?;
        let engine = self.engine.as_mut();
        let inputs = &self.inputs.values;
        let outlines = engine.map(|engine| engine.outlines(&self.state, inputs, &parts));
        Ok(outlines.unwrap_or_default())
    }
}

impl<const D: usize> Engine<D> {
    /// Where all markers are.
    pub(super) fn markers(&mut self, state: &State, inputs: &[f64]) -> Vec<[f64; 3]> {
        let (assembled, x) = self.nodes(state, inputs);
        let markers = assembled.markers().iter();
        markers
            .map(|marker| components(&marker.position(x)))
            .collect()
    }

    /// Where points along every body are.
    pub(super) fn outlines(
        &mut self,
        state: &State,
        inputs: &[f64],
        parts: &dyn Fn(usize) -> u32,
    ) -> Vec<Vec<[f64; 3]>> {
        let (assembled, x) = self.nodes(state, inputs);
        outlines(&assembled.system, x, parts)
    }
}

fn outlines<const D: usize>(
    system: &System<D>,
    x: &[Node<D>],
    parts: &dyn Fn(usize) -> u32,
) -> Vec<Vec<[f64; 3]>> {
    let first = |body: usize| system.bodies()[body].start;
    let mut found: Vec<Vec<[f64; 3]>> = (0..system.bodies().len())
        .map(|body| vec![components(&Vector::from(x[first(body)][0]))])
        .collect();
    for chain in system.chains() {
        let parts = parts(chain.elements().len());
        let along = |part: u32| chain.length() * f64::from(part) / f64::from(parts);
        let body = (0..found.len()).find(|body| first(*body) == chain.nodes(0)[0]);
        if let Some(body) = body {
            let place = |part| Marker::along(body, chain, along(part)).position(x);
            found[body] = (0..=parts).map(|part| components(&place(part))).collect();
        }
    }
    for rod in system.rods() {
        if let Some(body) = (0..found.len()).find(|body| first(*body) == rod.node) {
            let ends = [-0.5, 0.5].map(|part| [part * rod.length, 0.0]);
            let ends = ends.map(|end| Marker::rigid(body, rod.node, end).position(x));
            found[body] = ends.iter().map(components).collect();
        }
    }
    found
}
