//! Forces by expressions in a length or a coordinate of a joint, its rate, a control and the time.

use super::measure::ResolvedMeasure;
use super::*;
use crate::math::function::Function;
use crate::math::state_expression::StateExpression;
use crate::system::loads::ForceLaw;

/// A force by an expression, between two points or on a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceLawLoad {
    /// Ends: `ground` or `body.marker`, then `body.marker`. The load acts along the line between them. Either these or `joint`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub markers: Option<[String; 2]>,
    /// With `ground` only: end on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Name of the joint on whose coordinate the load acts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Coordinate of the joint that the load acts on; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Force against growth of the length or of the coordinate, N, or N m on an angle: an expression in the length or coordinate `x` (m or
    /// rad), its rate `v` (m/s or rad/s), the time `t` (s) and the value `u` of an input `control`.
    pub force: String,
}

/// A force by an expression between two ends or on a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ResolvedForceLaw<'a> {
    /// As described.
    given: &'a ForceLawLoad,
    /// Length or coordinate.
    on: ResolvedMeasure<'a>,
    /// Force against growth, N or N m.
    law: StateExpression,
    /// Value of `u`, if an input sets it.
    control: Option<Signal>,
}

impl SceneLoad for ForceLawLoad {
    type Acting<'a> = ResolvedForceLaw<'a>;

    const EXERTS: Exerts = Exerts::ByCoordinate;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let between = (self.markers.as_ref(), self.point);
        let on = scene.require_measure(path, between, (self.joint.as_deref(), self.coordinate))?;
        let law = StateExpression::new(&self.force);
        let law = law.map_err(|message| Error::new(format!("{path}.force"), message))?;
        if let Some((x, jump)) = law.jump_at_rest() {
            let wanted = "a force that does not jump where `v` changes its sign, since nothing could come to rest there (dry friction is a \
                          `joint_friction`)";
            let found = format!("a jump by {jump} at x = {x}");
            return Err(expected(&format!("{path}.force"), wanted, found));
        }
        Ok(ResolvedForceLaw {
            given: self,
            on,
            law,
            control: None,
        })
    }
}

impl<'a> ActingLoad<'a> for ResolvedForceLaw<'a> {
    fn place(&self) -> LoadPlace<'a> {
        self.on.place()
    }

    fn stiffness(&self) -> [f64; 2] {
        let slope = self.law.slope(0.0, [0.0; 3], 0).abs();
        let known = if slope.is_finite() { slope } else { 0.0 };
        self.on.stiffness(known)
    }

    fn is_one_sided(&self) -> bool {
        self.law.has_switches()
    }

    fn has_tension(&self) -> bool {
        matches!(self.on, ResolvedMeasure::Length(_))
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let measure = builder.measure(&self.on);
        let control = self.control.clone();
        let control = control.unwrap_or(Signal::Function(Function::constant(0.0)));
        let law = ForceLaw::new(measure, self.law.clone(), control);
        Ok(AppliedLoad::ForceLaw(Box::new(law)))
    }

    fn words(&self, dimension: usize) -> LoadWords {
        LoadWords {
            kind: "force law".into(),
            on: self.on.words(dimension),
            size: format!(
                "`{}` {} against growth",
                self.given.force,
                self.on.unit().symbol()
            ),
        }
    }
}

impl<'a> Resolved<'a> {
    /// Makes the value `u` of a force law an input.
    ///
    /// # Errors
    /// There is no such load, or its force does not depend on `u`.
    pub(in crate::scene) fn set_control(
        &mut self,
        path: &str,
        name: &str,
        first: usize,
    ) -> Result<(), Error> {
        let wanted = "a force_law of this scene";
        let law = self.require_load(path, name, wanted, |load| match load {
            ResolvedLoadKind::ForceLaw(law) => Some(law),
            _ => None,
        })?;
        if !law.law.depends()[2] {
            let wanted = "a force_law whose `force` depends on `u`";
            let found = format!("{}, whose `force` is {:?}", quoted(name), law.given.force);
            return Err(expected(path, wanted, found));
        }
        law.control = Some(Signal::Input(first));
        Ok(())
    }

    /// Checks that inputs set `u` of all force laws that depend on it.
    ///
    /// # Errors
    /// An input of kind `control` is missing.
    pub(in crate::scene) fn require_controls(&self) -> Result<(), Error> {
        for (index, load) in self.loads.iter().enumerate() {
            if let ResolvedLoadKind::ForceLaw(law) = &load.kind
                && law.law.depends()[2]
                && law.control.is_none()
            {
                let wanted = "an input of kind `control` for this load, which sets `u`";
                return Err(expected(&format!("loads[{index}].force"), wanted, "none"));
            }
        }
        Ok(())
    }
}
