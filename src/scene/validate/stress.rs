//! Points of sections whose stress is read.

use super::checks::{expected, finite, quoted};
use crate::scene::Error;
use crate::scene::resolved::{
    OutputTarget, Place, PointId, Resolved, ResolvedMarker, SectionPoint,
};

/// Most points of a section.
const MOST_POINTS: usize = 100;

impl<'a> Resolved<'a> {
    /// Resolves the points of the section at a marker where stress is read.
    ///
    /// # Errors
    /// A marker that does not exist, a section whose stress is not known, or points that are missing, too many or of
    /// another dimension.
    pub(super) fn stress_points(
        &mut self,
        path: &str,
        marker: &'a str,
        points: &'a [Vec<f64>],
    ) -> Result<OutputTarget<'a>, Error> {
        let place = format!("{path}.marker");
        let marker = match self.scene.dimension {
            2 => self.require_cable_marker(&place, marker)?,
            _ => self.require_rod_marker(&place, marker)?,
        };
        self.section_points(path, marker, points, false)
    }

    /// Resolves the points of the section at a marker of a rod or beam where shear stress of torsion is read.
    ///
    /// # Errors
    /// A marker that does not exist, a section without a shape, or points that are missing, too many or of another dimension.
    pub(super) fn torsion_points(
        &mut self,
        path: &str,
        marker: &'a str,
        points: &'a [Vec<f64>],
    ) -> Result<OutputTarget<'a>, Error> {
        let marker = self.require_rod_marker(&format!("{path}.marker"), marker)?;
        self.section_points(path, marker, points, true)
    }

    fn section_points(
        &mut self,
        path: &str,
        marker: ResolvedMarker<'a>,
        points: &'a [Vec<f64>],
        is_torsion: bool,
    ) -> Result<OutputTarget<'a>, Error> {
        let (place, name) = (format!("{path}.marker"), marker.name);
        let Place::Along(cable, at) = marker.place else {
            return Err(expected(&place, "a marker of a cable or rod", quoted(name)));
        };
        let section = cable.body.section_after(at);
        if cable.body.is_coupled() {
            let wanted = "a marker of a body whose section has area and second moments and no `coupling`: a whole `stiffness` does \
                          not say how stress is spread over the section";
            return Err(expected(&place, wanted, quoted(name)));
        }
        if is_torsion && section.shape.is_none() {
            let wanted = "a marker of a body whose section has a `shape` there";
            return Err(expected(&place, wanted, quoted(name)));
        }
        let path = format!("{path}.points");
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
        Ok(OutputTarget::Points(marker, PointId(first), points))
    }
}
