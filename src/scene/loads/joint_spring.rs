//! Springs with dampers on coordinates of joints.

use super::*;

/// A spring and a damper on a coordinate of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct JointSpringLoad {
    /// Name of the joint that the spring acts in.
    pub joint: String,
    /// Coordinate of the joint that the spring acts on; by default the displacement of a joint that has one, else the angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordinate: Option<CoordinateKind>,
    /// Stiffness, N/m for a displacement and N m/rad for an angle; 0 by default. A stiffness or a damping is needed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping, N s/m for a displacement and N m s/rad for an angle; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
    /// Coordinate at which the spring is unloaded, m or rad; by default the coordinate at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
}

/// A spring and a damper on a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ResolvedJointSpring<'a> {
    /// As described.
    given: &'a JointSpringLoad,
    /// Coordinate that spring and damper act on.
    on: JointCoordinate<'a>,
    /// Stiffness (N/m or N m/rad) and damping (N s/m or N m s/rad).
    sizes: [f64; 2],
}

impl SceneLoad for JointSpringLoad {
    type Acting<'a> = ResolvedJointSpring<'a>;

    const EXERTS: Exerts = Exerts::ByCoordinate;

    fn resolve<'a>(&'a self, path: &str, scene: &Resolved<'a>) -> Found<Self::Acting<'a>> {
        let on = scene.require_loaded(path, &self.joint, self.coordinate)?;
        if let Some(rest) = self.rest {
            finite(&format!("{path}.rest"), rest)?;
        }
        let units = spring_units(on.is_angle());
        let sizes = spring_damper(path, self.stiffness, self.damping, units)?;
        Ok(ResolvedJointSpring {
            given: self,
            on,
            sizes,
        })
    }

    fn numbers(&mut self, on: LoadExtent) -> Vec<LoadNumber<'_>> {
        damper(
            spring_units(on == LoadExtent::Angle),
            Optional(&mut self.stiffness),
            Optional(&mut self.damping),
        )
    }
}

impl<'a> ActingLoad<'a> for ResolvedJointSpring<'a> {
    fn place(&self) -> LoadPlace<'a> {
        LoadPlace::Coordinate(self.on)
    }

    fn stiffness(&self) -> [f64; 2] {
        self.on.stiffness(self.sizes[0])
    }

    fn assemble<const D: usize>(
        &self,
        builder: &mut Builder<'_, D>,
        _path: &str,
    ) -> AssembledLoad<D> {
        let coordinate = builder.coordinate(&self.on);
        Ok(builder.joint_spring(coordinate, self.sizes, self.given.rest))
    }

    fn words(&self, _dimension: usize) -> LoadWords {
        let [k, c] = self.sizes.map(number);
        let [by_way, by_rate] = spring_units(self.on.is_angle()).map(|unit| unit.symbol());
        let rest = words::given(", at rest at", self.given.rest, self.on.unit().name);
        LoadWords {
            kind: "spring and damper".into(),
            on: words::coordinate(&self.on),
            size: format!("{k} {by_way}, {c} {by_rate}{rest}"),
        }
    }
}
