//! Choice of the integrator and the scales of its error.

use std::f64::consts::PI;

use crate::integrators::{
    Bounds, DOPRI853, Methods, Nystrom, OneStepMethod, RK4, RKN43, RKN64, Radau, RungeKutta,
    Tolerance, VERLET,
};
use crate::math::vector::norm;
use crate::scene::{Error, Integrator, Model, Resolved};
use crate::system::{State, System, Workspace, fastest};

/// Explicit methods pay up to a frequency of this many natural rates, times the cube root of the inverse
/// tolerance: where both kinds cost the same on pendulums of 10 to 80 elements from soft to stiff
/// (docs/decisions/0004-integrators.md).
const EXPLICIT: f64 = 75.0;
/// Limit for the method that integrates dampers and constraints, whose evaluations advance it less.
const EXPLICIT_WITH_RATES: f64 = 42.0;
/// Tolerance above which the implicit method takes no longer steps.
const LOOSE: f64 = 1e-4;
/// Tolerance from which stability alone sets the steps of the method of order 4, and one of order 2 is
/// cheaper.
const LOOSEST: f64 = 5e-3;

/// Cost of the projection at the end of a step and of the acceleration there, in accelerations.
const PROJECTION: f64 = 2.2;

/// Rate of motion at the start, relative to what else there is, up to which it is rest: a motion that begins at rest may begin with roundoff.
const REST: f64 = 1e-6;

/// Start of a run, from which the integrator is chosen.
pub(super) struct Start<'a, const D: usize> {
    /// The system.
    pub system: &'a System<D>,
    /// The state that it starts from.
    pub state: &'a State,
    /// Kinetic energy of the state, J.
    pub kinetic: f64,
    /// Inputs.
    pub inputs: &'a [f64],
}

/// Tolerance and integrator for a scene.
///
/// # Errors
/// When the integrator that the scene names cannot take this system.
pub(super) fn choose<const D: usize>(
    resolved: &Resolved<'_>,
    start: &Start<'_, D>,
    work: &mut Workspace<D>,
) -> Result<(Tolerance, Methods), Error> {
    let (scene, system) = (resolved.scene, start.system);
    let rate = natural_rate(resolved, system, start.kinetic);
    let relative = scene.relative_tolerance();
    let tolerance = Tolerance {
        relative,
        position: system.scale(),
        time: 1.0 / rate,
    };
    let n = system.coordinates();
    let radau = || -> Box<dyn OneStepMethod> {
        let radau = Radau::new(n);
        Box::new(if system.has_belt_friction() {
            radau.on_belts()
        } else {
            radau
        })
    };
    let named = scene.method.integrator;
    if named == Integrator::Radau || (named == Integrator::Auto && system.has_contacts()) {
        return Ok((tolerance, Methods::one(radau())));
    }
    if system.reads_rates() {
        takes_rates(named)?;
    }
    let (frequency, decay) = fastest(system, start.inputs, work, start.state);
    let nystrom =
        |tableau| -> Box<dyn OneStepMethod> { Box::new(Nystrom::new(tableau, n, frequency)) };
    let both =
        || -> Box<dyn OneStepMethod> { Box::new(Nystrom::pair([&RKN43, &RKN64], n, frequency)) };
    let runge_kutta = |method| -> Box<dyn OneStepMethod> {
        Box::new(RungeKutta::new(method, n, frequency, decay))
    };
    let with_rates = || -> Box<dyn OneStepMethod> {
        let projection = if system.is_projected() {
            PROJECTION
        } else {
            0.0
        };
        let bounds = Bounds {
            frequency,
            decay,
            projection,
        };
        Box::new(RungeKutta::pair([&RK4, &DOPRI853], n, bounds, relative))
    };
    let explicit = match named {
        Integrator::Verlet => nystrom(&VERLET),
        Integrator::Rkn43 => nystrom(&RKN43),
        Integrator::Rkn64 => nystrom(&RKN64),
        Integrator::Rk4 => runge_kutta(&RK4),
        Integrator::Dopri853 => runge_kutta(&DOPRI853),
        _ if system.reads_rates() => with_rates(),
        _ if relative >= LOOSEST => nystrom(&VERLET),
        _ => both(),
    };
    if named != Integrator::Auto {
        return Ok((tolerance, Methods::one(explicit)));
    }
    let explicit_up_to = if system.reads_rates() {
        EXPLICIT_WITH_RATES
    } else {
        EXPLICIT
    };
    let explicit_up_to = explicit_up_to * system.implicit_price();
    let is_soft = frequency.max(decay) <= explicit_up_to * rate / relative.min(LOOSE).cbrt();
    Ok((
        tolerance,
        if is_soft {
            Methods::two(explicit, radau())
        } else {
            Methods::two(radau(), explicit)
        },
    ))
}

/// Whether an integrator takes accelerations that read rates.
///
/// # Errors
/// That it does not.
fn takes_rates(named: Integrator) -> Result<(), Error> {
    if !matches!(
        named,
        Integrator::Verlet | Integrator::Rkn43 | Integrator::Rkn64
    ) {
        return Ok(());
    }
    let found = format!("{named:?}").to_lowercase();
    let message = format!(
        "expected \"auto\", \"radau\", \"rk4\" or \"dopri853\" where accelerations read rates (damping, joints that \
         keep multipliers, a rotating frame, the energy of inputs), found \"{found}\""
    );
    Err(Error::new("method.integrator", message))
}

/// How fast the scene moves, 1/s: by gravity, by its motion at the start, by the rotation of its frame;
/// where it has none of them, by its slowest bending (or stretching) or by its springs, whichever is slower: bodies that springs move swing
/// as slowly as those, however stiff they are themselves, and an error of velocity grows for as long.
fn natural_rate<const D: usize>(resolved: &Resolved<'_>, system: &System<D>, kinetic: f64) -> f64 {
    let (size, mass) = (system.size(), system.mass());
    let by_motion = (2.0 * kinetic / mass).sqrt() / size;
    let by_gravity = (system.gravity().norm() / size).sqrt();
    let rate = by_motion
        .max(by_gravity)
        .max(norm(&resolved.scene.rotation.full()));
    let slow = [elastic_rate(resolved), spring_rate(resolved, size, mass)];
    let slow = slow
        .into_iter()
        .filter(|rate| *rate > 0.0 && rate.is_finite());
    let otherwise = slow.reduce(f64::min).unwrap_or(1.0);
    if rate > REST * otherwise && rate.is_finite() {
        rate
    } else {
        otherwise
    }
}

/// Slowest bending (or stretching) of the first line that bends, with elements or else as modes, between supports; 0 without one. Free
/// frequencies of a reduced body of a file say too little about it where joints hold it.
fn elastic_rate(resolved: &Resolved<'_>) -> f64 {
    let bodies = || resolved.scene.bodies.iter();
    let as_modes = bodies().filter_map(|body| body.cable());
    let as_modes = as_modes.filter(|line| line.model == Model::Modal);
    let mut lines = (bodies().filter_map(|body| body.flexible())).chain(as_modes);
    let Some(cable) = lines.next() else {
        return 0.0;
    };
    let (length, middle) = (cable.shape.length(), cable.section_at(0.5));
    let per_mass = |stiffness: f64| (stiffness / cable.line_density_of(&middle)).sqrt();
    let bending = cable.bending_stiffness_of(&middle);
    if bending > 0.0 {
        PI * PI * per_mass(bending) / (length * length)
    } else {
        PI * per_mass(cable.axial_stiffness_of(&middle)) / length
    }
}

/// Rate of the whole mass on the stiffest spring; 0 without one.
fn spring_rate(resolved: &Resolved<'_>, size: f64, mass: f64) -> f64 {
    // A joint limit or a surface is met now and then.
    let loads = resolved.loads.iter();
    let loads = loads.filter(|load| !load.kind.is_one_sided());
    let of_springs = loads.map(|load| {
        let [against_ways, against_turns] = load.kind.stiffness();
        against_ways.max(against_turns / (size * size))
    });
    let of_hinges = resolved.joints.iter().filter_map(|joint| joint.spring());
    let stiffest = of_springs
        .chain(of_hinges.map(|[stiffness, _]| stiffness / (size * size)))
        .fold(0.0, f64::max);
    (stiffest / mass).sqrt()
}
