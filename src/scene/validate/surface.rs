//! Sections of lines, plates and shells that are read.

use super::checks::{expected, quoted};
use crate::bodies::SectionFaces;
use crate::scene::Error;
use crate::scene::description::{Output, PlyStressOutput};
use crate::scene::resolved::{
    LayerId, OutputTarget, Place, Plate, Resolved, ResolvedMarker, SectionLayer,
};

/// Most plies that one output reads.
const MOST_PLIES: usize = 200;

impl<'a> Resolved<'a> {
    /// Resolves an output of a section, of a line or of a plate or shell.
    ///
    /// # Errors
    /// A marker that does not exist or is on a body without such a section, a section whose stress is not known, or plies that are not there.
    pub(super) fn section_output(
        &mut self,
        path: &str,
        output: &'a Output,
    ) -> Result<OutputTarget<'a>, Error> {
        let place = format!("{path}.marker");
        let name = output.names()[0].unwrap_or_default();
        let is_on_surface = self.is_on_surface(name);
        let marker = match output {
            Output::Strain(_) => self.require_flexible_marker(&place, name)?,
            Output::AxialForce(_) | Output::ConnectivityForce(_) => {
                self.require_cable_marker(&place, name)?
            }
            Output::Torque(_) => self.require_rod_marker(&place, name)?,
            Output::Curvature(_) if !is_on_surface => self.require_flexible_marker(&place, name)?,
            Output::BendingMoment(_) if !is_on_surface => {
                self.require_cable_marker(&place, name)?
            }
            _ => self.require_surface_marker(&place, name)?.0,
        };
        match output {
            Output::SurfaceStress(of) => self.faces(&place, &of.marker),
            Output::PlyStress(of) => self.plies(path, of),
            _ => Ok(OutputTarget::Marker(marker)),
        }
    }

    /// Whether a marker is on a plate or shell.
    fn is_on_surface(&self, name: &'a str) -> bool {
        let marker = self.require_marker("", name);
        marker.is_ok_and(|marker| matches!(marker.place, Place::Patch(..)))
    }

    /// Finds a marker of a plate or shell, its body and its material coordinates.
    fn require_surface_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<(ResolvedMarker<'a>, Plate<'a>, [f64; 2]), Error> {
        let marker = self.require_marker(path, name)?;
        match marker.place {
            Place::Patch(plate, index) => Ok((marker, plate, plate.place(index))),
            Place::Along(..) | Place::Point(..) | Place::Interface(..) => {
                let wanted = "a marker of a plate or shell";
                Err(expected(path, wanted, quoted(name)))
            }
        }
    }

    /// Bottom and top of the section at a marker.
    fn faces(&mut self, path: &str, name: &'a str) -> Result<OutputTarget<'a>, Error> {
        let (marker, plate, at) = self.require_surface_marker(path, name)?;
        let Some(SectionFaces { faces, .. }) = plate.body.faces(at) else {
            let wanted = "a marker of a plate or shell with a material or a laminate: a whole `stiffness` does not say how stress is \
                          spread through the thickness";
            return Err(expected(path, wanted, quoted(name)));
        };
        let first = LayerId(self.layers.len());
        (self.layers).extend(faces.map(|(height, law)| SectionLayer {
            marker,
            height,
            law,
        }));
        Ok(OutputTarget::Faces(marker, first))
    }

    /// Bottom and top of plies of the section at a marker.
    fn plies(&mut self, path: &str, of: &'a PlyStressOutput) -> Result<OutputTarget<'a>, Error> {
        let place = format!("{path}.marker");
        let (marker, plate, at) = self.require_surface_marker(&place, &of.marker)?;
        let layers = plate.body.layers(at);
        if plate.body.laminate.is_empty() {
            let wanted = "a marker of a plate or shell with a laminate";
            return Err(expected(&place, wanted, quoted(&of.marker)));
        }
        let path = format!("{path}.plies");
        if !(1..=MOST_PLIES).contains(&of.plies.len()) {
            let wanted = format!("1 to {MOST_PLIES} numbers of plies");
            return Err(expected(&path, &wanted, of.plies.len()));
        }
        let first = LayerId(self.layers.len());
        for (k, number) in of.plies.iter().enumerate() {
            let path = format!("{path}[{k}]");
            let index = (*number as usize).wrapping_sub(1);
            let Some(layer) = layers.get(index) else {
                let wanted = format!("the number of a ply, from 1 to {}", layers.len());
                return Err(expected(&path, &wanted, number));
            };
            if of.plies[..k].contains(number) {
                return Err(expected(&path, "a ply not named before", number));
            }
            (self.layers).extend(layer.heights.map(|height| SectionLayer {
                marker,
                height,
                law: layer.ply.fibre_stress(),
            }));
        }
        Ok(OutputTarget::Plies(marker, first, &of.plies))
    }
}
