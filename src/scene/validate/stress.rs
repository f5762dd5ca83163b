//! Points of sections and gauges of reduced bodies whose stress is read.

use super::checks::{expected, finite, quoted, unknown};
use crate::scene::Error;
use crate::scene::description::Output;
use crate::scene::resolved::{
    BodyReference, GaugeId, OutputTarget, Place, PointId, Resolved, ResolvedGauge, ResolvedMarker,
    SectionPoint,
};

/// Most points of a section.
const MOST_POINTS: usize = 100;

impl<'a> Resolved<'a> {
    /// Resolves an output of stress at points of the section of a line.
    ///
    /// # Errors
    /// A marker that does not exist, a section whose stress is not known, or points that are missing, too many or of another dimension.
    pub(super) fn point_stress(
        &mut self,
        path: &str,
        output: &'a Output,
    ) -> Result<OutputTarget<'a>, Error> {
        match output {
            Output::TorsionStress(of) => self.torsion_points(path, &of.marker, &of.points),
            Output::Stress(of) => self.stress_points(path, &of.marker, &of.points),
            _ => unreachable!("what else is read is at no points of a section"),
        }
    }

    /// Resolves the points of the section at a marker where stress is read.
    ///
    /// # Errors
    /// A marker that does not exist, a section whose stress is not known, or points that are missing, too many or of
    /// another dimension.
    fn stress_points(
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
    fn torsion_points(
        &mut self,
        path: &str,
        marker: &'a str,
        points: &'a [Vec<f64>],
    ) -> Result<OutputTarget<'a>, Error> {
        let marker = self.require_rod_marker(&format!("{path}.marker"), marker)?;
        self.section_points(path, marker, points, true)
    }

    /// Resolves a gauge of a reduced body.
    ///
    /// # Errors
    /// A gauge that does not exist.
    pub(super) fn gauge(&mut self, path: &str, name: &'a str) -> Result<OutputTarget<'a>, Error> {
        let Some(found) = self.gauges_by_name().find(|(of, _)| of == name) else {
            let known: Vec<String> = self.gauges_by_name().map(|(of, _)| of).collect();
            let known = known.iter().map(String::as_str);
            return Err(unknown(
                path,
                "a gauge of a reduced body of this scene",
                name,
                known,
            ));
        };
        let id = GaugeId(self.gauges.len());
        self.gauges.push(found.1);
        Ok(OutputTarget::Gauge(name, id))
    }

    /// Gauges of all reduced bodies by `body.gauge`.
    fn gauges_by_name(&self) -> impl Iterator<Item = (String, ResolvedGauge<'a>)> {
        let reduced = self.bodies.iter().filter_map(|body| match *body {
            BodyReference::Reduced(reduced) => Some(reduced),
            BodyReference::Cable(_) | BodyReference::Rigid(_) | BodyReference::Plate(_) => None,
        });
        reduced.flat_map(|reduced| {
            let stresses = &reduced.body.contained().details.stresses;
            reduced
                .body
                .gauges
                .iter()
                .filter_map(move |(gauge, stress)| {
                    let name = format!("{}.{gauge}", reduced.body.name);
                    let by_modes = stresses.get(stress)?;
                    Some((name, ResolvedGauge { reduced, by_modes }))
                })
        })
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
            if let (true, Some(shape)) = (is_torsion, &section.shape) {
                shape.validate_point(&path, point)?;
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
