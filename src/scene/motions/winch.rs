//! Winches.

use super::*;
use crate::scene::Model;
use crate::scene::description::{InitialState, LineModel, Shape, Strain};
use crate::scene::joints::JointPrimitive;
use crate::scene::resolved::First;

/// A winch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WinchMotion {
    /// Marker at the end of the cable where the winch is, `body.marker`.
    pub marker: String,
    /// Course of the length paid out in time, m; 0 at the start.
    pub value: MotionValue,
}

impl SceneMotion for WinchMotion {
    type Of<'a> = ResolvedMarker<'a>;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Of<'a>> {
        let marker = scene.require_paid_out(&format!("{path}.marker"), &self.marker)?;
        if let MotionValue::One(Value::Number(number)) = &self.value
            && *number != 0.0
        {
            let wanted =
                "a length that begins at 0, since the cable is as long as its shape at the start";
            return Err(expected(&format!("{path}.value"), wanted, number));
        }
        Ok(marker)
    }

    fn quantity<'a>(of: &Self::Of<'a>) -> DrivenQuantity<'a> {
        DrivenQuantity {
            place: LoadPlace::Marker(*of),
            exerts: [false; 2],
            start: vec![0.0],
            orders: displacement("travel", "Length paid out"),
            words: "the length paid out at",
        }
    }

    fn primitive<const D: usize>(
        of: &Self::Of<'_>,
        builder: &mut Builder<'_, D>,
        drives: &[usize],
    ) -> Primitive<D> {
        if let Place::Along(cable, at) = of.place
            && let Some(chain) = cable.id.chain()
        {
            builder.parts.winches.push((chain, at > 0.5, drives[0]));
        }
        Primitive::PaidOut(drives[0])
    }
}

/// Returns the cable that a motion pays out, if it is a winch.
fn paid_out<'a>(motion: &ResolvedMotion<'a>) -> Option<Cable<'a>> {
    match motion.driven.kind {
        DrivenKind::Winch(ResolvedMarker {
            place: Place::Along(cable, _),
            ..
        }) => Some(cable),
        _ => None,
    }
}

impl<'a> Resolved<'a> {
    /// Finds the marker at which a winch pays out its cable.
    ///
    /// # Errors
    /// The marker does not exist, is not at the end of a flexible cable, or its cable has stations, another strain or a
    /// curved shape that bends.
    fn require_paid_out(&self, path: &str, name: &'a str) -> Result<ResolvedMarker<'a>, Error> {
        let marker = self.require_marker(path, name)?;
        let wanted = "a marker at an end of a cable that bends and stretches";
        let Place::Along(cable, at) = marker.place else {
            return Err(expected(path, wanted, quoted(name)));
        };
        let body = cable.body;
        if body.sections != LineModel::Cable || body.model == Model::Rigid {
            return Err(expected(path, wanted, quoted(name)));
        }
        if ![0.0, 1.0].contains(&at) {
            let found = format!("one at {at} of its length");
            return Err(expected(path, wanted, found));
        }
        let bends = body.section.numbers().second_moments[0] > 0.0;
        let found = match () {
            () if !body.stations.is_empty() => "`stations`",
            () if body.strain != Strain::ThetaPrime => "another `strain` than thetaPrime",
            () if bends && !matches!(body.shape, Shape::Line { .. }) => {
                "a curved `shape` that bends"
            }
            () => return Ok(marker),
        };
        let wanted = "a cable that is the same all along, in strains of kind thetaPrime, straight or without bending \
                      stiffness";
        Err(expected(path, wanted, found))
    }

    /// Cables that winches pay out, each with the index of its winch among the motions.
    fn winches(&self) -> impl Iterator<Item = (usize, Cable<'a>)> {
        let motions = self.motions.iter().enumerate();
        motions.filter_map(|(index, motion)| Some((index, paid_out(motion)?)))
    }

    /// Whether a winch pays out a cable.
    pub fn is_paid_out(&self, cable: Cable<'_>) -> bool {
        self.winches().any(|(_, of)| of.id == cable.id)
    }

    /// Checks cables that winches pay out: one winch for each, a frame at rest, and loads at the ends or all along
    /// only.
    ///
    /// # Errors
    /// A second winch of a cable, a rotating frame, a steady motion at the start, a load between the ends, or an
    /// unsuitable fluid.
    pub(in crate::scene) fn check_winches(&self) -> Result<(), Error> {
        let mut cables: Vec<(usize, Cable<'a>)> = Vec::new();
        for (index, cable) in self.winches() {
            let path = format!("motions[{index}]");
            if cables.iter().any(|(_, other)| other.id == cable.id) {
                return Err(expected(&path, "one winch for a cable", "two"));
            }
            if self.scene.turns() {
                return Err(expected(
                    &path,
                    "a frame that stands still beside a winch",
                    "`rotation`",
                ));
            }
            if self.scene.initial.state() == InitialState::Steady {
                return Err(expected(
                    &path,
                    "no steady motion at the start beside a winch",
                    "one",
                ));
            }
            cables.push((index, cable));
        }
        for (index, cable) in cables {
            if let Some(name) = self.acts_along(cable) {
                let wanted = "a cable at whose markers between its ends nothing acts, and without masses, since a winch pays it out";
                return Err(expected(&format!("motions[{index}]"), wanted, quoted(name)));
            }
            self.check_fluids(cable)?;
        }
        Ok(())
    }

    /// Name of what acts on a cable between its ends, if anything does.
    fn acts_along(&self, cable: Cable<'a>) -> Option<&'a str> {
        let is_inside = |marker: &ResolvedMarker<'a>| match marker.place {
            Place::Along(of, at) => of.id == cable.id && ![0.0, 1.0].contains(&at),
            Place::Point(..) | Place::Interface(..) | Place::Patch(..) => false,
        };
        if let Some(marker) = self.acted_on().into_iter().find(is_inside) {
            return Some(marker.name);
        }
        let on_it = |marker: &ResolvedMarker<'a>| matches!(marker.place, Place::Along(of, _) if of.id == cable.id);
        if let Some(mass) = self.masses.iter().find(|mass| on_it(&mass.marker)) {
            return Some(mass.marker.name);
        }
        for joint in &self.joints {
            let slides = joint
                .primitives
                .iter()
                .any(|hold| matches!(hold, JointPrimitive::PointOnCurve));
            if slides && matches!(joint.ends.first, First::Cable(of) if of.id == cable.id) {
                return Some(joint.name);
            }
        }
        None
    }

    /// Refuses fluids with added mass on a cable through whose mesh material moves.
    fn check_fluids(&self, cable: Cable<'a>) -> Result<(), Error> {
        for (index, load) in self.loads.iter().enumerate() {
            let fluid = load.kind.fluid();
            let fluid = fluid.filter(|fluid| fluid.line().is_some_and(|line| line.id == cable.id));
            let added_mass = fluid.map_or(0.0, |fluid| fluid.added_mass());
            if added_mass > 0.0 {
                let path = format!("loads[{index}].added_mass");
                let wanted = "0 along a cable that a winch pays out, which slides past fluid that it does not take along";
                return Err(expected(&path, wanted, added_mass));
            }
        }
        Ok(())
    }
}
