//! Revolute joints.

use super::*;

/// A revolute joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Revolute {
    /// Markers that the joint connects: `ground` or `body.marker`, then `body.marker`.
    pub markers: [String; 2],
    /// With `ground` only: position of the joint on the ground, m; by default the position of the second marker at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<SceneVector>,
    /// Axis of rotation, required in space and absent in the plane. It is given in the axes of the first marker's body at the start:
    /// of `ground` the global axes, of a rod or beam the tangent and both axes of its section.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<SceneVector>,
    /// With `stiffness` or `damping` only: angle at which the spring is unloaded, rad; by default the angle at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Stiffness of a spring against rotation, N m/rad; by default there is no spring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub stiffness: Option<f64>,
    /// Damping of rotation, N m s/rad; by default there is no damper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0))]
    pub damping: Option<f64>,
}

impl SceneJoint for Revolute {
    fn parts(&self) -> JointParts {
        let axis = self.direction.map(|of| ParallelAxes(of.full()));
        let spring = self.is_sprung().then_some(JointPrimitive::Spring {
            rest: self.angle,
            stiffness: self.stiffness.unwrap_or(0.0),
            damping: self.damping.unwrap_or(0.0),
        });
        let symbol = if self.is_sprung() {
            Symbol::Spiral
        } else {
            Symbol::Pin
        };
        let primitives = [AtPoint].into_iter().chain(axis).chain(spring);
        JointParts::new(symbol, primitives)
            .at(self.point)
            .along([self.direction, None])
    }

    fn check_dimension(&self, path: &str, dimension: usize) -> Found<()> {
        let place = format!("{path}.direction");
        match (dimension, self.direction) {
            (3, None) => {
                let wanted = "the axis [x, y, z] that a revolute joint rotates about (a ball joint is `spherical`)";
                Err(expected(&place, wanted, "nothing"))
            }
            (2, Some(_)) => Err(expected(&place, "nothing in the plane", "a direction")),
            _ => Ok(()),
        }
    }

    fn check(&self, path: &str, _ends: &Ends<'_>) -> Found<()> {
        if self.is_sprung() {
            return spring_damper(path, self.stiffness, self.damping, spring_units(true)).map(drop);
        }
        if self.angle.is_some() {
            let wanted = "a stiffness or a damping beside the angle of a revolute joint";
            return Err(expected(&format!("{path}.angle"), wanted, "neither"));
        }
        Ok(())
    }
}

impl Revolute {
    /// Whether a spring or a damper acts against its rotation.
    fn is_sprung(&self) -> bool {
        self.stiffness.is_some() || self.damping.is_some()
    }
}
