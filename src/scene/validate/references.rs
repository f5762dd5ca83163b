//! Names that refer to other parts of a scene, and what they refer to.

use super::checks::{expected, quoted, unknown, vector};
use crate::scene::joints::{CoordinateKind, ResolvedJoint};
use crate::scene::marker::GROUND;
use crate::scene::resolved::{
    BodyReference, Cable, Ends, First, Form, JointCoordinate, Pivot, Place, Plate, Resolved,
    ResolvedMarker, Slider,
};
use crate::scene::{Error, LineBody, SceneVector};

impl<'a> Resolved<'a> {
    /// Finds a marker.
    ///
    /// # Errors
    /// The marker does not exist. The error lists similar names.
    pub(crate) fn require_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        self.marker(name).ok_or_else(|| {
            let of = |marker: &ResolvedMarker<'_>| {
                format!("{}.{}", marker.place.body().name(), marker.name)
            };
            let known: Vec<String> = self.markers.iter().map(of).collect();
            let known = known.iter().map(String::as_str);
            unknown(path, "a marker of this scene", name, known)
        })
    }

    /// Finds a marker with an angle, which exists in the plane only. `instead` names the replacement in space.
    ///
    /// # Errors
    /// The marker does not exist or has no direction, or the scene is in space.
    pub(crate) fn require_turning(
        &self,
        path: &str,
        name: &'a str,
        instead: &str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        match self.scene.dimension {
            2 => self.require_directed(path, name),
            _ => Err(expected(path, instead, quoted(name))),
        }
    }

    /// Finds a marker that a moment can rotate: one with a direction in the plane, one on a rigid body with inertia or
    /// on a rod in space.
    ///
    /// # Errors
    /// The marker does not exist, or its body does not rotate.
    pub(crate) fn require_spinning(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        match self.scene.dimension {
            2 => self.require_directed(path, name),
            _ => self.require_standing(path, name),
        }
    }

    /// Finds a marker with an orientation in space: on a rigid body with inertia or on a rod.
    ///
    /// # Errors
    /// The marker does not exist or has no orientation, or the scene is planar.
    pub(crate) fn require_standing(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_marker(path, name)?;
        refuse_point(path, marker)?;
        let wanted = match self.scene.dimension {
            2 => "nothing in the plane, where \"angle\" says how a body stands",
            _ => {
                "a marker of a rigid body with inertia or of a rod; a cable without torsion has a direction alone"
            }
        };
        if self.scene.dimension == 3 && marker.place.is_framed() {
            Ok(marker)
        } else {
            Err(expected(path, wanted, quoted(name)))
        }
    }

    /// Finds a marker of a body with inertia about every axis, whose orientation can be driven.
    ///
    /// # Errors
    /// The marker does not exist, is on a rod, or its body lacks inertia about an axis.
    pub(crate) fn require_driven(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_standing(path, name)?;
        match marker.place {
            Place::Along(..) => {
                let wanted = "a rigid body; drive one that is welded to the rod";
                Err(expected(path, wanted, quoted(name)))
            }
            Place::Interface(..) => {
                let wanted = "a rigid body; drive one that is welded to the interface";
                Err(expected(path, wanted, quoted(name)))
            }
            Place::Patch(..) => {
                let wanted = "a rigid body; drive one that is welded to the plate or shell";
                Err(expected(path, wanted, quoted(name)))
            }
            Place::Point(rigid, _) if rigid.body.inertia().thin().is_some() => {
                let wanted = "a body with a moment of inertia about every axis";
                Err(expected(path, wanted, quoted(name)))
            }
            _ => Ok(marker),
        }
    }

    /// Finds a marker with a direction: on a line body, or on a rigid body with inertia.
    ///
    /// # Errors
    /// The marker does not exist, or its body has no inertia.
    pub(crate) fn require_directed(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_marker(path, name)?;
        refuse_point(path, marker)?;
        if marker.place.turns() {
            return Ok(marker);
        }
        let wanted = "a marker that can rotate";
        let found = format!("{}, whose body has no inertia", quoted(name));
        Err(expected(path, wanted, found))
    }

    /// Finds a marker of a line body or a reduced body.
    ///
    /// # Errors
    /// The marker does not exist, or is on a rigid body.
    pub(crate) fn require_deformable_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_marker(path, name)?;
        match marker.place {
            Place::Along(..) | Place::Interface(..) | Place::Patch(..) => Ok(marker),
            Place::Point(..) => {
                let wanted = "a marker of a cable or a reduced body";
                Err(expected(path, wanted, quoted(name)))
            }
        }
    }

    /// Finds a marker of a line body whose sections are read.
    ///
    /// # Errors
    /// The marker does not exist, is on another body, or on a line that is reduced to modes.
    pub(crate) fn require_cable_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_marker(path, name)?;
        let wanted = "a marker of a cable";
        match marker.place {
            Place::Along(cable, _) if cable.is_modal() => {
                Err(modal(path, "a line whose sections are read", &cable))
            }
            Place::Along(..) => Ok(marker),
            Place::Point(..) | Place::Interface(..) | Place::Patch(..) => {
                Err(expected(path, wanted, quoted(name)))
            }
        }
    }

    /// Finds a marker of a rod or beam in space.
    ///
    /// # Errors
    /// The marker does not exist, is on another body, or the scene is planar.
    pub(crate) fn require_rod_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_cable_marker(path, name)?;
        if self.scene.dimension == 2 {
            let wanted = "a marker of a rod or beam in space: nothing is twisted in the plane";
            return Err(expected(path, wanted, quoted(name)));
        }
        if marker.place.is_framed() {
            Ok(marker)
        } else {
            Err(expected(path, "a marker of a rod", quoted(name)))
        }
    }

    /// Finds a marker of a flexible line body.
    ///
    /// # Errors
    /// The marker does not exist, or its body is rigid.
    pub(crate) fn require_flexible_marker(
        &self,
        path: &str,
        name: &'a str,
    ) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_cable_marker(path, name)?;
        if let Place::Along(cable, _) = marker.place {
            chain(path, "a marker of a cable that bends", cable)?;
        }
        Ok(marker)
    }

    /// Finds a line body that something acts along.
    ///
    /// # Errors
    /// The body does not exist, is of kind `rigid`, or is reduced to modes.
    pub(crate) fn require_cable(&self, path: &str, name: &str) -> Result<Cable<'a>, Error> {
        match self.bodies_by_name.get(name) {
            Some(BodyReference::Cable(cable)) if cable.is_modal() => Err(modal(
                path,
                "a line of elements, along which something acts",
                cable,
            )),
            Some(BodyReference::Cable(cable)) => Ok(*cable),
            _ => Err(self.no_line(path, "cable", |_| true, name)),
        }
    }

    /// Finds a plate or shell that something acts on.
    ///
    /// # Errors
    /// The body does not exist, or is no plate or shell.
    pub(crate) fn require_plate(&self, path: &str, name: &str) -> Result<Plate<'a>, Error> {
        if let Some(BodyReference::Plate(plate)) = self.bodies_by_name.get(name) {
            return Ok(*plate);
        }
        let known = self.bodies.iter().filter_map(|body| match body {
            BodyReference::Plate(plate) => Some(&*plate.body.name),
            _ => None,
        });
        let wanted = "the name of a plate or shell of this scene";
        Err(unknown(path, wanted, name, known))
    }

    /// Finds a rod or a beam that something acts along.
    ///
    /// # Errors
    /// The body does not exist, is no rod or beam, or is reduced to modes.
    pub(crate) fn require_sections(&self, path: &str, name: &str) -> Result<Cable<'a>, Error> {
        match self.bodies_by_name.get(name) {
            Some(BodyReference::Cable(cable)) if cable.is_modal() => Err(modal(
                path,
                "a line of elements, along which something acts",
                cable,
            )),
            Some(BodyReference::Cable(cable)) if cable.body.is_rod() => Ok(*cable),
            _ => Err(self.no_line(path, "rod or beam", LineBody::is_rod, name)),
        }
    }

    /// Describes a reference to a line body, or to one of a kind, that does not exist.
    fn no_line(
        &self,
        path: &str,
        what: &str,
        is_meant: fn(&LineBody) -> bool,
        name: &str,
    ) -> Error {
        let known = self.bodies.iter().filter_map(|body| match body {
            BodyReference::Cable(cable) if is_meant(cable.body) => Some(&*cable.body.name),
            _ => None,
        });
        let wanted = format!("the name of a {what} of this scene");
        unknown(path, &wanted, name, known)
    }

    /// Finds a flexible line body, with its index among the chains.
    ///
    /// # Errors
    /// The body does not exist, or is rigid.
    pub(crate) fn require_flexible(
        &self,
        path: &str,
        name: &str,
    ) -> Result<(Cable<'a>, usize), Error> {
        let cable = self.require_cable(path, name)?;
        Ok((cable, chain(path, "the name of a cable that bends", cable)?))
    }

    /// Resolves the two ends of a joint or a load: markers, or the ground at `point`.
    ///
    /// # Errors
    /// A marker that does not exist, both ends on one body, or a point where there is no ground.
    pub(crate) fn require_pair(
        &self,
        path: &str,
        markers: &'a [String; 2],
        point: Option<SceneVector>,
    ) -> Result<Ends<'a>, Error> {
        let second = self.require_marker(&format!("{path}.markers[1]"), &markers[1])?;
        let place = format!("{path}.point");
        if markers[0] == GROUND {
            if let Some(point) = point {
                vector(&place, self.scene.dimension, &point)?;
            }
            let first = First::Ground(point.map(|point| point.full()));
            return Ok(Ends { first, second });
        }
        let first = self.require_marker(&format!("{path}.markers[0]"), &markers[0])?;
        if point.is_some() {
            return Err(expected(
                &place,
                "nothing between two bodies",
                "a point [x, y]",
            ));
        }
        let bodies = [first, second].map(|marker| marker.place.body_index());
        self.require_two(path, bodies)?;
        let first = First::Marker(first);
        Ok(Ends { first, second })
    }

    /// Checks that two joined markers are on different bodies.
    ///
    /// # Errors
    /// Both markers are on one body.
    pub(crate) fn require_two(&self, path: &str, [a, b]: [usize; 2]) -> Result<(), Error> {
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

    /// Finds a joint.
    ///
    /// # Errors
    /// The joint does not exist. The error lists similar names.
    pub(crate) fn require_joint(
        &self,
        path: &str,
        name: &str,
    ) -> Result<&ResolvedJoint<'a>, Error> {
        let found = self.joints.iter().find(|joint| joint.name == name);
        found.ok_or_else(|| self.no_joint(path, name))
    }

    /// Describes a reference to a joint that does not exist.
    pub(crate) fn no_joint(&self, path: &str, name: &str) -> Error {
        if self.edges.iter().any(|edge| edge.name == name) {
            let wanted = "a joint of markers (of a joint of edges only its reaction is read)";
            return expected(path, wanted, quoted(name));
        }
        let known = self.joints.iter().map(|joint| joint.name);
        unknown(path, "a joint of this scene", name, known)
    }

    /// Finds a joint along a line of the ground or of a rigid body.
    ///
    /// # Errors
    /// The joint does not exist, or has no displacement.
    pub(crate) fn require_slider(&self, path: &str, name: &str) -> Result<Slider<'a>, Error> {
        let slider = self.require_joint(path, name)?.slider();
        let wanted = "a joint along a line of the ground or of a rigid body";
        slider.ok_or_else(|| expected(path, wanted, quoted(name)))
    }

    /// Finds a coordinate of a joint: the one that is `asked` for, or the `default` one, or the only one.
    ///
    /// # Errors
    /// The joint does not exist, or has no such coordinate.
    pub(crate) fn require_coordinate(
        &self,
        path: &str,
        name: &str,
        asked: Option<CoordinateKind>,
        default: CoordinateKind,
    ) -> Result<JointCoordinate<'a>, Error> {
        let slider = || {
            self.require_slider(path, name)
                .map(JointCoordinate::Displacement)
        };
        let pivot = || self.require_pivot(path, name).map(JointCoordinate::Angle);
        match (asked, default) {
            (Some(CoordinateKind::Displacement), _) => slider(),
            (Some(CoordinateKind::Angle), _) => pivot(),
            (None, CoordinateKind::Displacement) => slider().or_else(|_| pivot()),
            (None, CoordinateKind::Angle) => pivot().or_else(|_| slider()),
        }
        .map_err(|error| match (asked, self.require_joint(path, name)) {
            (None, Ok(_)) => {
                let wanted =
                    "a joint with an angle or along a line of the ground or of a rigid body";
                expected(path, wanted, quoted(name))
            }
            _ => error,
        })
    }

    /// Finds a joint with an angle.
    ///
    /// # Errors
    /// The joint does not exist, or has no angle.
    pub(crate) fn require_pivot(&self, path: &str, name: &str) -> Result<Pivot<'a>, Error> {
        let joint = self.require_joint(path, name)?;
        let is_in_plane = self.scene.dimension == 2;
        let pivot = joint.pivot();
        let Some(pivot) = pivot.filter(|pivot| is_in_plane || pivot.axis.is_some()) else {
            let wanted = match self.scene.dimension {
                2 => "a revolute joint",
                _ => "a revolute joint with a direction, or a cylindrical one",
            };
            return Err(expected(path, wanted, quoted(name)));
        };
        for marker in pivot.ends.markers() {
            refuse_point(path, marker)?;
            if !marker.place.turns() {
                let body = quoted(marker.place.body().name());
                let found = format!("{}, where {body} has no inertia", quoted(name));
                return Err(expected(
                    path,
                    "a joint between bodies that can rotate",
                    found,
                ));
            }
        }
        Ok(pivot)
    }
}

/// Refuses a marker at an interface of a reduced body without rotations, where something needs axes.
///
/// # Errors
/// The marker is at such an interface.
pub(in crate::scene) fn refuse_point(path: &str, marker: ResolvedMarker<'_>) -> Result<(), Error> {
    let Some(interface) = marker.place.point_interface() else {
        return Ok(());
    };
    let wanted =
        "an interface with rotations (reduce the model with rotations there, NAME.rotation)";
    let found = format!(
        "{}, whose interface {} has none",
        quoted(marker.name),
        quoted(interface)
    );
    Err(expected(path, wanted, found))
}

/// Place of a cable among the chains.
fn chain(path: &str, wanted: &str, cable: Cable<'_>) -> Result<usize, Error> {
    match cable.id.form {
        Form::Chain(chain) => Ok(chain),
        Form::Rod(_) => {
            let name = quoted(&cable.body.name);
            let found = format!("{name}, which is rigid (bodies[{}].model)", cable.id.body);
            Err(expected(path, wanted, found))
        }
        Form::Modal => Err(modal(path, wanted, &cable)),
    }
}

/// An error for a line body that is reduced to modes where another one is wanted.
fn modal(path: &str, wanted: &str, cable: &Cable<'_>) -> Error {
    let name = quoted(&cable.body.name);
    let found = format!(
        "{name}, which is reduced to modes (bodies[{}].model)",
        cable.id.body
    );
    expected(path, wanted, found)
}
