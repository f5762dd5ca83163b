//! Where bodies are, for pictures.

use super::{Error, Simulation};
use crate::body::{Marker, Node};
use crate::system::System;

impl Simulation {
    /// Where all markers are now, m: body by body, in the order of their names.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn markers(&mut self) -> Result<Vec<[f64; 2]>, Error> {
        self.refresh()?;
        let Some(engine) = &mut self.engine else {
            return Ok(Vec::new());
        };
        let (assembled, x) = engine.nodes(&self.state, &self.inputs.values);
        let position = |marker: &Marker| marker.position(x).into();
        Ok(assembled.markers().iter().map(position).collect())
    }

    /// Where points along every body are now, m: the ends of as many equal lengths of a cable as `parts` makes of its
    /// number of elements, the centre of mass of a rigid body.
    ///
    /// # Errors
    /// The initial state cannot be computed.
    pub fn outlines(&mut self, parts: impl Fn(usize) -> u32) -> Result<Vec<Vec<[f64; 2]>>, Error> {
        self.refresh()?;
        let Some(engine) = &mut self.engine else {
            return Ok(Vec::new());
        };
        let (assembled, x) = engine.nodes(&self.state, &self.inputs.values);
        Ok(outlines(&assembled.system, x, parts))
    }
}

fn outlines(system: &System, x: &[Node<4>], parts: impl Fn(usize) -> u32) -> Vec<Vec<[f64; 2]>> {
    let first = |body: usize| system.bodies()[body].start;
    let mut found: Vec<Vec<[f64; 2]>> = (0..system.bodies().len())
        .map(|body| vec![[x[first(body)][0], x[first(body)][1]]])
        .collect();
    for chain in system.chains() {
        let parts = parts(chain.elements().len());
        let along = |part: u32| chain.length() * f64::from(part) / f64::from(parts);
        let body = (0..found.len()).find(|body| first(*body) == chain.nodes(0)[0]);
        if let Some(body) = body {
            let point = |part| Marker::along(body, chain, along(part)).position(x).into();
            found[body] = (0..=parts).map(point).collect();
        }
    }
    found
}
