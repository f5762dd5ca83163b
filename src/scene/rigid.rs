//! A cable that need not bend, as a rigid body of the same name with the same markers.

use super::description::{Body, CableBody, InitialMotion, Model, RigidBody, Vector};
use super::{Error, Scene};

impl CableBody {
    /// The body as a uniform rigid rod: mass `rho A l`, inertia `m l^2 / 12` about its middle; nothing where it is curved or
    /// starts deforming.
    fn as_rigid(&self) -> Option<RigidBody> {
        let motion = &self.motion;
        if !self.shape.is_straight() || motion.deformation.is_some() {
            return None;
        }
        let length = self.shape.length();
        let mass = self.material.density * self.section.area * length;
        let [middle, along] = [self.shape.point(0.5), self.shape.tangent(0.5)];
        let [_, _, spin] = motion.spin.full();
        let [x, y, _] = motion.velocity.full();
        // Of its middle instead of its first end.
        let velocity = [
            x - 0.5 * length * spin * along[1],
            y + 0.5 * length * spin * along[0],
        ];
        let at = |s: &f64| Vector::from([(s - 0.5) * length, 0.0]);
        let markers = self.markers.iter();
        Some(RigidBody {
            name: self.name.clone(),
            mass,
            inertia: mass * length * length / 12.0,
            position: Vector::from([middle[0], middle[1]]),
            angle: along[1].atan2(along[0]),
            motion: InitialMotion {
                velocity: Vector::from(velocity),
                ..motion.clone()
            },
            markers: markers.map(|(name, s)| (name.clone(), at(s))).collect(),
        })
    }
}

impl Scene {
    /// The scene with a cable, by its place among the bodies, as a rigid body.
    ///
    /// # Errors
    /// A scene in space, a curved cable, one that starts deforming, and whatever reads of it or does to it what takes a
    /// cable: the place, and why.
    pub fn with_rigid(&self, body: usize) -> Result<Self, Error> {
        let path = format!("bodies[{body}].model");
        let refused = |found: &str| {
            Err(Error::new(
                &path,
                format!("expected a cable that can be rigid, found {found}"),
            ))
        };
        if self.dimension != 2 {
            return refused("one in space");
        }
        let Some(rigid) = self.bodies[body].cable().and_then(CableBody::as_rigid) else {
            return refused("one that is curved or starts deforming");
        };
        let mut scene = self.clone();
        scene.bodies[body] = Body::Rigid(rigid);
        match scene.resolve() {
            Ok(_) => Ok(scene),
            Err(error) => refused(&format!("{error} (which takes a cable)")),
        }
    }

    /// Whether a cable, by its place among the bodies, may be rigid where its bending changes nothing.
    pub fn may_be_rigid(&self, body: usize) -> bool {
        let cable = self.bodies[body].cable();
        let is_open = |cable: &CableBody| cable.elements.is_none() && cable.model == Model::Auto;
        cable.is_some_and(is_open) && self.with_rigid(body).is_ok()
    }
}
