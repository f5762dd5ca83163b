//! Choice of the integrator and the scales of its error.

use crate::integrators::{Method, Radau, Rk4, Tolerance};
use crate::scene::{Integrator, Scene};
use crate::system::{System, Work};

/// The explicit method pays up to a frequency of this many natural rates, times the cube root of the
/// inverse tolerance: where both methods cost the same on soft, middling and steel pendulums
/// (docs/decisions/0004-integrators.md).
const EXPLICIT: f64 = 130.0;

/// Tolerance and integrator for a scene.
pub(super) fn choose(
    scene: &Scene,
    system: &System,
    work: &mut Work,
) -> (Tolerance, Box<dyn Method>) {
    let body = system.body();
    let (length, root_mass) = (body.length(), body.mass().sqrt());
    let rate = natural_rate(scene, system, work);
    let relative = scene.accuracy.relative_tolerance;
    let tolerance = Tolerance {
        relative,
        position: root_mass * length,
        time: 1.0 / rate,
    };
    let n = body.coordinates();
    let frequency = body.frequency_bound();
    let decay = scene.bodies[0].material.damping_time * frequency * frequency;
    let explicit = match scene.method.integrator {
        Integrator::Radau => false,
        Integrator::Rk4 => true,
        Integrator::Auto => frequency.max(decay) <= EXPLICIT * rate / relative.cbrt(),
    };
    let method: Box<dyn Method> = if explicit {
        Box::new(Rk4::new(n, frequency, decay))
    } else {
        Box::new(Radau::new(n))
    };
    (tolerance, method)
}

/// Rates of the scene's initial rigid motion.
pub(super) fn rigid_motion(scene: &Scene, system: &System, work: &mut Work, rates: &mut [f64]) {
    let motion = &scene.bodies[0].motion;
    system.rigid_rates(motion.velocity.into(), motion.spin, work, rates);
}

/// How fast the scene moves, 1/s: by gravity, by its initial motion, or where neither is given by
/// its slowest bending (or stretching).
fn natural_rate(scene: &Scene, system: &System, work: &mut Work) -> f64 {
    let body = system.body();
    let length = body.length();
    let mut rates = vec![0.0; body.coordinates()];
    rigid_motion(scene, system, work, &mut rates);
    let kinetic: f64 = rates.iter().map(|v| v * v).sum();
    let by_motion = (kinetic / body.mass()).sqrt() / length;
    let by_gravity = (system.gravity().norm() / length).sqrt();
    let rate = by_motion.max(by_gravity);
    if rate > 0.0 {
        return rate;
    }
    let (material, section) = (&scene.bodies[0].material, &scene.bodies[0].section);
    let speed = (material.youngs_modulus / material.density).sqrt();
    if section.second_moment > 0.0 {
        speed * (section.second_moment / section.area).sqrt() / (length * length)
    } else {
        speed / length
    }
}
