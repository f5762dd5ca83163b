//! What tables and masters give of a prescribed motion: values without rates; and functions of time that steps cannot follow.

use std::f64::consts::PI;

use flexbody::scene::{Interpolation, Scene};
use flexbody::simulation::{Signals, Simulation};
use serde_json::{Value, json};

fn simulation(scene: &Value) -> Simulation {
    let scene = Scene::from_json(&scene.to_string()).unwrap_or_else(|error| panic!("{error}"));
    Simulation::new(scene)
}

fn index(simulation: &Simulation, name: &str) -> usize {
    let mut variables = simulation.variables().iter();
    variables.position(|v| v.name == name).expect(name)
}

fn get(simulation: &mut Simulation, name: &str) -> f64 {
    let index = index(simulation, name);
    simulation.real(index).expect("a number")
}

fn set(simulation: &mut Simulation, name: &str, value: f64) {
    let index = index(simulation, name);
    simulation.set_real(index, value).expect("an input");
}

/// Runs along a table of inputs to a time in even steps; `see` is told every communication point.
fn run_along(
    scene: &Value,
    (table, interpolation): (&str, Interpolation),
    (steps, step): (u32, f64),
    mut see: impl FnMut(f64, &mut Simulation),
) {
    let mut simulation = simulation(scene);
    let signals = Signals::from_csv(table, simulation.variables());
    let signals = signals.and_then(|signals| signals.interpolated(interpolation));
    let signals = signals.unwrap_or_else(|error| panic!("{error}"));
    simulation.set_inputs(&signals).expect("inputs");
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    for number in 0..=steps {
        let until = f64::from(number) * step;
        while simulation.time() < until {
            simulation.step_along(&signals, until).expect("a step");
        }
        see(until, &mut simulation);
    }
}

const AMPLITUDE: f64 = 0.004;
const FREQUENCY: f64 = 2.0 * PI * 1.5;
const MASS: f64 = 50.0;
const STIFFNESS: f64 = 2e4;
const DAMPING: f64 = 1.5e3;
const GRAVITY: f64 = 9.81;

/// A shaken base and a box on a bushing, all upright.
fn isolator(input: u8) -> Value {
    let body = |name: &str, mass: f64, z: f64| {
        json!({"name": name, "element": "rigid", "mass": mass, "inertia": [1.0, 1.0, 1.0], "position": [0.0, 0.0, z],
               "markers": {"c": [0.0, 0.0, 0.0]}})
    };
    json!({"name": "isolator", "dimension": 3, "gravity": [0.0, 0.0, -GRAVITY],
        "bodies": [body("base", 1000.0, 0.0), body("box", MASS, 0.0)],
        "joints": [{"name": "shaker", "kind": "prismatic", "markers": ["ground", "base.c"], "direction": [0, 0, 1]}],
        "motions": [{"name": "road", "kind": "displacement", "joint": "shaker", "value": {"input": input}}],
        "loads": [{"name": "mount", "kind": "bushing", "markers": ["base.c", "box.c"],
                   "translational_stiffness": [1e4, 1e4, STIFFNESS], "translational_damping": [750.0, 750.0, DAMPING],
                   "rotational_stiffness": [1e3, 1e3, 1e3]}],
        "outputs": [{"kind": "acceleration", "marker": "box.c"}, {"kind": "load_force", "load": "mount"},
                    {"kind": "velocity", "marker": "base.c"}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-8},
        "experiment": {"stop_time": 1.0, "step": 0.002}})
}

/// The base goes `AMPLITUDE (1 - cos)`, from rest.
fn road(t: f64) -> [f64; 2] {
    let (sin, cos) = (FREQUENCY * t).sin_cos();
    [AMPLITUDE * (1.0 - cos), AMPLITUDE * FREQUENCY * sin]
}

/// Acceleration of the box and force of the bushing on it, by the classical Runge-Kutta method on the one equation of motion.
fn isolated(steps: u32, step: f64) -> Vec<[f64; 2]> {
    const PARTS: u32 = 20;
    // Position from the equilibrium, and velocity.
    let acceleration = |t: f64, [x, v]: [f64; 2]| {
        let [u, rate] = road(t);
        (STIFFNESS * (u - x) + DAMPING * (rate - v)) / MASS
    };
    let rates = |t: f64, y: [f64; 2]| [y[1], acceleration(t, y)];
    let (mut y, h) = ([0.0; 2], step / f64::from(PARTS));
    let mut found = Vec::new();
    for number in 0..=steps * PARTS {
        let t = f64::from(number) * h;
        if number % PARTS == 0 {
            let a = acceleration(t, y);
            found.push([a, MASS * (a + GRAVITY)]);
        }
        let add = |k: [f64; 2], part: f64| [y[0] + part * h * k[0], y[1] + part * h * k[1]];
        let a = rates(t, y);
        let b = rates(t + 0.5 * h, add(a, 0.5));
        let c = rates(t + 0.5 * h, add(b, 0.5));
        let d = rates(t + h, add(c, 1.0));
        y = std::array::from_fn(|k| y[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    found
}

/// Largest errors of acceleration (of its largest) and force (of the largest beyond the weight).
fn errors(input: u8, interpolation: Interpolation, row: f64) -> [f64; 2] {
    let (steps, step) = (500, 0.002);
    let mut table = String::from("time,road.displacement\n");
    for k in 0..=(1.0 / row).round() as u32 {
        let t = f64::from(k) * row;
        table += &format!("{t:?},{:?}\n", road(t)[0]);
    }
    let reference = isolated(steps, step);
    let largest = [0, 1].map(|k| {
        let weight = if k == 1 { MASS * GRAVITY } else { 0.0 };
        let sizes = reference.iter().map(|row| (row[k] - weight).abs());
        sizes.fold(0.0, f64::max)
    });
    let (mut found, mut number) = ([0.0_f64; 2], 0);
    run_along(
        &isolator(input),
        (&table, interpolation),
        (steps, step),
        |_, simulation| {
            let names = ["box.c.acceleration[3]", "mount.force[3]"];
            for (k, name) in names.into_iter().enumerate() {
                let error = get(simulation, name) - reference[number][k];
                found[k] = found[k].max(error.abs() / largest[k]);
            }
            number += 1;
        },
    );
    found
}

#[test]
fn rates_without_columns_are_those_of_the_curve_through_the_values() {
    for input in [1, 2] {
        // On straight lines the rate at a row is that of the line before it: half a row late.
        let linear = errors(input, Interpolation::Linear, 0.002);
        assert!(linear.iter().all(|error| *error < 0.05), "{linear:?}");
        let finer = errors(input, Interpolation::Linear, 0.001);
        assert!(
            finer.iter().zip(linear).all(|(a, b)| *a < 0.6 * b),
            "{finer:?} {linear:?}"
        );
        let spline = errors(input, Interpolation::Spline, 0.002);
        assert!(spline.iter().all(|error| *error < 2e-5), "{spline:?}");
        // Ten communication steps from row to row: the cube of what the road rotates from one to the next, 0.19 rad.
        let coarse = errors(input, Interpolation::Spline, 0.02);
        assert!(coarse.iter().all(|error| *error < 1e-2), "{coarse:?}");
    }
}

/// A body whose orientation is driven about a slanted axis; the quaternion's length changes on the way.
#[test]
fn the_angular_velocity_of_a_table_of_quaternions_is_that_of_their_curve() {
    let axis = [0.36, 0.48, 0.8];
    let angle = |t: f64| [0.8 * t * t - 0.3 * t.powi(3), 1.6 * t - 0.9 * t * t];
    let scene = json!({"name": "turned", "dimension": 3,
        "bodies": [{"name": "plate", "element": "rigid", "mass": 1.0, "inertia": [0.1, 0.2, 0.25], "position": [0, 0, 0],
                    "markers": {"c": [0, 0, 0], "edge": [0.3, 0, 0]}}],
        "joints": [{"name": "ball", "kind": "spherical", "markers": ["ground", "plate.c"]}],
        "motions": [{"name": "turn", "kind": "orientation", "marker": "plate.c", "value": {"input": 2}}],
        "outputs": [{"kind": "angular_velocity", "marker": "plate.c"}, {"kind": "reaction_moment", "motion": "turn"}],
        "accuracy": {"relative_tolerance": 1e-8}, "experiment": {"stop_time": 1.0, "step": 0.01}});
    let mut table = String::from("time");
    (1..=4).for_each(|k| table += &format!(",turn.quaternion[{k}]"));
    table += "\n";
    for k in 0..=100 {
        let t = f64::from(k) * 0.01;
        let (sin, cos) = (0.5 * angle(t)[0]).sin_cos();
        let length = 1.0 + 0.3 * t;
        let parts = [cos, axis[0] * sin, axis[1] * sin, axis[2] * sin].map(|part| part * length);
        table += &format!(
            "{t:?},{:?},{:?},{:?},{:?}\n",
            parts[0], parts[1], parts[2], parts[3]
        );
    }
    for (interpolation, allowed) in [
        (Interpolation::Linear, 0.012),
        (Interpolation::Spline, 1e-5),
    ] {
        let mut most = 0.0_f64;
        run_along(
            &scene,
            (&table, interpolation),
            (100, 0.01),
            |t, simulation| {
                for (k, part) in axis.into_iter().enumerate() {
                    let name = format!("plate.c.angular_velocity[{}]", k + 1);
                    most = most.max((get(simulation, &name) - part * angle(t)[1]).abs());
                }
            },
        );
        assert!(most < allowed, "{interpolation:?}: {most}");
    }
}

#[test]
fn a_rate_has_its_value_beside_it() {
    let refused = |table: &str| {
        let simulation = simulation(&isolator(2));
        let signals = Signals::from_csv(table, simulation.variables());
        signals.expect_err("no table").to_string()
    };
    assert_eq!(
        refused("time,road.velocity\n0,0\n1,1\n"),
        "column road.velocity: expected a column road.displacement beside it, whose rate it is, found none"
    );
}

/// Columns that are there are taken as they are; what is missing above them follows from the nearest.
#[test]
fn columns_of_rates_are_taken_as_they_are() {
    let table = "time,road.displacement,road.velocity\n0,0,1\n1,1,3\n";
    run_along(
        &isolator(2),
        (table, Interpolation::Linear),
        (2, 0.5),
        |t, simulation| {
            if t == 0.5 {
                let found = ["displacement", "velocity", "acceleration"]
                    .map(|key| simulation.setting(index(simulation, &format!("road.{key}"))));
                assert_eq!(found, [0.5, 2.0, 2.0]);
            }
        },
    );
}

fn warnings(simulation: &mut Simulation) -> Vec<String> {
    let mut told = Vec::new();
    simulation.tell_warnings(|message| told.push(message.to_string()));
    told
}

/// What a master that moves the value of a motion is told, which rates it sets beside it.
fn told(input: u8, rates: &[&str], values: [f64; 6]) -> Vec<String> {
    let mut simulation = simulation(&isolator(input));
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    let mut told = Vec::new();
    for (number, value) in (1_i8..).zip(values) {
        set(&mut simulation, "road.displacement", value);
        for rate in rates {
            set(&mut simulation, rate, 0.0);
        }
        simulation.step(0.01 * f64::from(number)).expect("a step");
        told.extend(warnings(&mut simulation));
    }
    let of_rates = |message: &String| message.contains("never set");
    told.into_iter().filter(of_rates).collect()
}

#[test]
fn a_master_that_never_sets_the_rates_is_told_once() {
    let moving = [1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5];
    let found = told(2, &[], moving);
    assert_eq!(found.len(), 1, "{found:?}");
    let begins = "road.displacement moves, but its rates were never set and count as 0: road.velocity, road.acceleration;";
    assert!(found[0].starts_with(begins), "{found:?}");
    assert_eq!(told(1, &[], moving).len(), 1);
    // Rates that are set are taken as they are, none are asked of `input` 0, and one way is from rest to rest.
    assert!(told(2, &["road.velocity"], moving).is_empty());
    assert!(told(0, &[], moving).is_empty());
    assert!(told(2, &[], [1e-5; 6]).is_empty());
}

/// A particle under a load.
fn pushed(value: &str) -> Value {
    json!({"name": "pushed", "dimension": 2, "gravity": [0.0, 0.0],
        "bodies": [{"name": "ball", "element": "rigid", "mass": 1.0, "position": [0, 0], "markers": {"c": [0, 0]}}],
        "loads": [{"name": "push", "kind": "force", "marker": "ball.c", "value": [value, 0]}],
        "outputs": [{"kind": "position", "marker": "ball.c"}],
        "accuracy": {"relative_tolerance": 1e-6}, "experiment": {"stop_time": 1.0, "step": 0.1}})
}

#[test]
fn a_load_that_no_step_follows_is_refused_or_told_once() {
    let told = |value: &str| {
        let mut simulation = simulation(&pushed(value));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        let mut told = Vec::new();
        for number in 1..=2 {
            if let Err(failure) = simulation.step(0.1 * f64::from(number)) {
                assert_eq!(failure.time, 0.1 * f64::from(number - 1));
                told.push(format!("refused: {}", failure.reason));
                break;
            }
            told.extend(warnings(&mut simulation));
        }
        told.retain(|message| message.contains("periods"));
        told
    };
    let place = "loads[0].value[0]: push goes through ";
    for fast in ["sin(1e9*t)", "1 + 0.1*cos(1e9*t + 1)*t"] {
        let found = told(fast);
        assert_eq!(found.len(), 1, "{fast}: {found:?}");
        assert!(
            found[0].starts_with(&format!("refused: {place}")),
            "{found:?}"
        );
    }
    let found = told("1e-3*sin(7e4*t)");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with(&format!("{place}1.1e3 periods")),
        "{found:?}"
    );
    for slow in ["sin(2*PI*50*t)", "exp(-1e9*t)", "5"] {
        assert!(told(slow).is_empty(), "{slow}");
    }
}

/// A strip of unequal second moments, clamped along x in a scene that rotates about z.
fn turning(element: &str, rate: f64) -> Value {
    json!({"name": "turning", "dimension": 3, "rotation": [0.0, 0.0, rate],
        "bodies": [{"name": "strip", "element": element, "elements": 2,
                    "material": {"youngs_modulus": 7e10, "shear_modulus": 2.6e10, "density": 2700.0},
                    "section": {"shape": {"rectangle": {"width": 0.04, "height": 0.004}}},
                    "shape": {"line": {"from": [0.1, 0, 0], "to": [0.6, 0, 0]}}, "markers": {"root": 0}}],
        "joints": [{"name": "hub", "kind": "weld", "markers": ["ground", "strip.root"]}],
        "outputs": [{"kind": "energy"}], "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-6}, "experiment": {"stop_time": 0.01, "step": 0.001}})
}

/// The frequency of torsion of a strip held at one end is raised by the propeller moment as `1 + share` under the root: by
/// `rho (I2 - I1) W^2` beside `G J (PI / (2 L))^2`, where `J` is about `w h^3 (1 - 0.63 h / w) / 3`.
#[test]
fn a_rod_without_its_propeller_moment_is_told_once() {
    let told = |element: &str, rate: f64| {
        let mut simulation = simulation(&turning(element, rate));
        simulation.initialize(0.0).expect("a start");
        simulation.start().expect("a start");
        let mut told = Vec::new();
        for number in 1..=2 {
            let stepped = simulation.step(0.001 * f64::from(number));
            stepped.expect("a step");
            told.extend(warnings(&mut simulation));
        }
        told.retain(|message| message.contains("propeller"));
        told
    };
    let (width, height, length) = (0.04_f64, 0.004_f64, 0.5_f64);
    let second = width * height * (width * width - height * height) / 12.0;
    let torsion = width * height.powi(3) * (1.0 - 0.63 * height / width) / 3.0;
    let share = |rate: f64| {
        2700.0 * second * rate * rate / (2.6e10 * torsion * (0.5 * PI / length).powi(2))
    };
    let (slow, fast) = (40.0, 100.0);
    assert!(share(slow) < 1e-3 && share(fast) > 1e-3);
    let found = told("rod", fast);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with("strip: rotates so quickly"),
        "{found:?}"
    );
    let wanted = format!("about {:.1e} of its stiffness", share(fast));
    assert!(found[0].contains(&wanted), "{found:?}, expected {wanted}");
    assert!(told("rod", slow).is_empty());
    assert!(told("beam", fast).is_empty());
}
