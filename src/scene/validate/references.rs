//! Checks of names that refer to other parts of a scene.

use super::checks::{expected, quoted};
use crate::scene::{Error, GROUND, Joint, JointKind, MarkerReference, Scene};

impl Scene {
    pub(super) fn require_marker(&self, path: &str, name: &str) -> Result<MarkerReference, Error> {
        self.marker(name).ok_or_else(|| {
            let of = |body: &crate::scene::Body| {
                let named = |marker: &str| format!("{}.{marker}", body.name());
                body.marker_names()
                    .into_iter()
                    .map(named)
                    .collect::<Vec<_>>()
            };
            let known: Vec<String> = self.bodies.iter().flat_map(of).collect();
            let wanted = format!("a marker of this scene ({})", known.join(", "));
            expected(path, &wanted, quoted(name))
        })
    }

    /// A marker with a direction: of a cable, or of a rigid body that has inertia.
    pub(super) fn require_turning(&self, path: &str, name: &str) -> Result<(), Error> {
        let marker = self.require_marker(path, name)?;
        if self.turns(marker) {
            return Ok(());
        }
        let wanted = "a marker that can turn";
        let found = format!("{}, whose body has no inertia", quoted(name));
        Err(expected(path, wanted, found))
    }

    fn turns(&self, marker: MarkerReference) -> bool {
        let rigid = self.bodies[marker.body].rigid();
        rigid.is_none_or(|body| body.inertia > 0.0)
    }

    pub(super) fn require_cable_marker(&self, path: &str, name: &str) -> Result<(), Error> {
        let marker = self.require_marker(path, name)?;
        if self.bodies[marker.body].cable().is_some() {
            return Ok(());
        }
        Err(expected(path, "a marker of a cable", quoted(name)))
    }

    /// Index of a cable.
    pub(super) fn require_cable(&self, path: &str, name: &str) -> Result<usize, Error> {
        let body = self.body(name);
        body.filter(|body| self.bodies[*body].cable().is_some())
            .ok_or_else(|| expected(path, "the name of a cable of this scene", quoted(name)))
    }

    /// Two markers of different bodies, the first of which may be the ground, and a point that is
    /// given with the ground only.
    pub(super) fn require_pair(
        &self,
        path: &str,
        markers: &[String; 2],
        point: Option<[f64; 2]>,
    ) -> Result<(), Error> {
        let second = self.require_marker(&format!("{path}.markers[1]"), &markers[1])?;
        let place = format!("{path}.point");
        if markers[0] == GROUND {
            return point.map_or(Ok(()), |point| super::checks::vector(&place, point));
        }
        let first = self.require_marker(&format!("{path}.markers[0]"), &markers[0])?;
        if point.is_some() {
            return Err(expected(
                &place,
                "nothing between two bodies",
                "a point [x, y]",
            ));
        }
        self.require_two(path, first.body, second.body)
    }

    pub(super) fn require_two(&self, path: &str, a: usize, b: usize) -> Result<(), Error> {
        if a != b {
            return Ok(());
        }
        let found = format!("{} twice", quoted(self.bodies[a].name()));
        Err(expected(
            &format!("{path}.markers"),
            "markers of two bodies",
            found,
        ))
    }

    pub(super) fn require_joint(&self, path: &str, name: &str) -> Result<&Joint, Error> {
        let found = self.joint(name).map(|joint| &self.joints[joint]);
        found.ok_or_else(|| expected(path, "a joint of this scene", quoted(name)))
    }

    /// A joint with an angle of its own.
    pub(super) fn require_pivot(&self, path: &str, name: &str) -> Result<(), Error> {
        let joint = self.require_joint(path, name)?;
        if !matches!(joint.kind, JointKind::Revolute | JointKind::Hinge) {
            return Err(expected(path, "a revolute joint or a hinge", quoted(name)));
        }
        let markers = joint.markers.iter().filter(|marker| *marker != GROUND);
        for marker in markers.filter_map(|marker| self.marker(marker)) {
            if !self.turns(marker) {
                let body = quoted(self.bodies[marker.body].name());
                let found = format!("{}, where {body} has no inertia", quoted(name));
                return Err(expected(
                    path,
                    "a joint between bodies that can turn",
                    found,
                ));
            }
        }
        Ok(())
    }
}
