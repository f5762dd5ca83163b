//! Points of sections whose stress is read.

use super::checks::{expected, finite, needed, quoted};
use crate::scene::Error;
use crate::scene::description::{Output, OutputKind};
use crate::scene::resolved::{Of, Place, PointId, Resolved, SectionPoint};

/// Most points of a section.
const MOST_POINTS: usize = 100;

impl<'a> Resolved<'a> {
    /// Resolves the points of the section at a marker where stress is read.
    ///
    /// # Errors
    /// A marker that does not exist, a section whose stress is not known, or points that are missing, too many or of
    /// another dimension.
    pub(super) fn section_points(
        &mut self,
        path: &str,
        output: &'a Output,
    ) -> Result<Of<'a>, Error> {
        let place = format!("{path}.marker");
        let name = needed(path, "marker", "a name", output.marker.as_deref())?;
        let marker = match (self.scene.dimension, output.kind) {
            (2, OutputKind::Stress) => self.require_cable_marker(&place, name)?,
            _ => self.require_rod_marker(&place, name)?,
        };
        let Place::Along(cable, at) = marker.place else {
            return Err(expected(&place, "a marker of a cable or rod", quoted(name)));
        };
        let section = cable.body.section_after(at);
        if cable.body.is_coupled() {
            let wanted = "a marker of a body whose section has area and second moments and no `coupling`: a whole `stiffness` does \
                          not say how stress is spread over the section";
            return Err(expected(&place, wanted, quoted(name)));
        }
        if output.kind == OutputKind::TorsionStress && section.shape.is_none() {
            let wanted = "a marker of a body whose section has a `shape` there";
            return Err(expected(&place, wanted, quoted(name)));
        }
        let path = format!("{path}.points");
        let points = output.points.as_deref().unwrap_or_default();
        if !(1..=MOST_POINTS).contains(&points.len()) {
            let wanted = format!("1 to {MOST_POINTS} points");
            return Err(expected(&path, &wanted, points.len()));
        }
        let first = self.points.len();
        for (k, point) in points.iter().enumerate() {
            let path = format!("{path}[{k}]");
            let point = match (&point[..], self.scene.dimension) {
                ([left], 2) => [*left, 0.0],
                ([y, z], 3) => [*y, *z],
                (_, 2) => return Err(expected(&path, "[y] in the plane", format!("{point:?}"))),
                _ => return Err(expected(&path, "[y, z] in space", format!("{point:?}"))),
            };
            for (axis, way) in point.into_iter().enumerate() {
                finite(&format!("{path}[{axis}]"), way)?;
            }
            if point != [0.0; 2] && section.second_moments.contains(&0.0) {
                let wanted = "a point on the line of a cable without bending stiffness";
                return Err(expected(&path, wanted, format!("{point:?}")));
            }
            self.points.push(SectionPoint {
                marker,
                cable,
                at,
                point,
            });
        }
        Ok(Of::Points(marker, PointId(first), points))
    }
}
