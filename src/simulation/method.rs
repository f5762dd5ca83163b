//! Choice of the integrator and the scales of its error.

use std::f64::consts::PI;

use crate::integrators::{Method, Radau, Rk4, Tolerance};
use crate::scene::{Integrator, JointKind, LoadKind, Scene};
use crate::system::{State, System, Work, fastest};

/// The explicit method pays up to a frequency of this many natural rates, times the cube root of the
/// inverse tolerance: where both methods cost the same on soft, middling and steel pendulums
/// (docs/decisions/0004-integrators.md).
const EXPLICIT: f64 = 75.0;

/// What a choice is made from.
pub(super) struct Start<'a> {
    /// The system.
    pub system: &'a System,
    /// The state that it starts from.
    pub state: &'a State,
    /// Its kinetic energy, J.
    pub kinetic: f64,
    /// Inputs.
    pub inputs: &'a [f64],
}

/// Tolerance and integrator for a scene.
pub(super) fn choose(
    scene: &Scene,
    start: &Start<'_>,
    work: &mut Work,
) -> (Tolerance, Box<dyn Method>) {
    let system = start.system;
    let rate = natural_rate(scene, system, start.kinetic);
    let relative = scene.accuracy.relative_tolerance;
    let tolerance = Tolerance {
        relative,
        position: system.scale(),
        time: 1.0 / rate,
    };
    let n = system.coordinates();
    let radau = || -> Box<dyn Method> { Box::new(Radau::new(n)) };
    if scene.method.integrator == Integrator::Radau {
        return (tolerance, radau());
    }
    let (frequency, decay) = fastest(system, start.inputs, work, start.state);
    let is_soft = frequency.max(decay) <= EXPLICIT * rate / relative.cbrt();
    let method = match scene.method.integrator {
        Integrator::Auto if !is_soft => radau(),
        _ => Box::new(Rk4::new(n, frequency, decay)),
    };
    (tolerance, method)
}

/// How fast the scene moves, 1/s: by gravity, by its motion at the start, by the turning of its frame;
/// where it has none of them, by its slowest bending (or stretching) or by its springs.
fn natural_rate(scene: &Scene, system: &System, kinetic: f64) -> f64 {
    let (size, mass) = (system.size(), system.mass());
    let by_motion = (2.0 * kinetic / mass).sqrt() / size;
    let by_gravity = (system.gravity().norm() / size).sqrt();
    let rate = by_motion.max(by_gravity).max(scene.rotation.abs());
    let slow = [rate, elastic_rate(scene), spring_rate(scene, size, mass)];
    let found = slow
        .into_iter()
        .find(|rate| *rate > 0.0 && rate.is_finite());
    found.unwrap_or(1.0)
}

/// Slowest bending (or stretching) of the first cable between supports; 0 without one.
fn elastic_rate(scene: &Scene) -> f64 {
    let mut cables = scene.bodies.iter().filter_map(|body| body.cable());
    let Some(cable) = cables.next() else {
        return 0.0;
    };
    let (material, section, length) = (&cable.material, &cable.section, cable.shape.length());
    let speed = (material.youngs_modulus / material.density).sqrt();
    if section.second_moment > 0.0 {
        PI * PI * speed * (section.second_moment / section.area).sqrt() / (length * length)
    } else {
        PI * speed / length
    }
}

/// Rate of the whole mass on the stiffest spring or hinge; 0 without one.
fn spring_rate(scene: &Scene, size: f64, mass: f64) -> f64 {
    let springs = scene.loads.iter();
    let springs = springs.filter(|load| load.kind == LoadKind::SpringDamper);
    let hinges = scene.joints.iter();
    let hinges = hinges.filter(|joint| joint.kind == JointKind::Hinge);
    let of_springs = springs.filter_map(|load| load.stiffness);
    let of_hinges = hinges.filter_map(|joint| joint.stiffness);
    let stiffest = of_springs
        .chain(of_hinges.map(|stiffness| stiffness / (size * size)))
        .fold(0.0, f64::max);
    (stiffest / mass).sqrt()
}
