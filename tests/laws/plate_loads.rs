//! Plates in fluids and on surfaces of the ground, against closed forms.

use serde_json::{Value, json};

use super::runs::{Run, is_near};

/// Sides, m, thickness, m, and density of the plate, kg/m^3.
const SIDES: [f64; 2] = [1.0, 0.5];
const THICKNESS: f64 = 0.01;
const DENSITY: f64 = 3000.0;
const AREA: f64 = SIDES[0] * SIDES[1];
const GRAVITY: f64 = 9.81;

/// A stiff plate along the first two axes under gravity, with a load on it.
fn plate(mesh: [u32; 2], load: &Value) -> Value {
    let mut load = load.clone();
    load["name"] = json!("load");
    load["body"] = json!("p");
    json!({"name": "plate", "dimension": 3, "gravity": [0, 0, -GRAVITY],
        "bodies": [{"name": "p", "element": "plate", "mesh": mesh, "thickness": THICKNESS,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[SIDES[0], 0, 0], [0, SIDES[1], 0]]}},
            "material": {"youngs_modulus": 7e10, "poisson_ratio": 0.3, "density": DENSITY},
            "markers": {"middle": [0.5, 0.5], "corner": [1, 1]}}],
        "loads": [load],
        "outputs": [{"kind": "position", "marker": "p.middle"}, {"kind": "velocity", "marker": "p.middle"}, {"kind": "energy"}, {"kind": "work"}]})
}

/// Kinetic, strain and potential energy with what was dissipated, less the work of the fluid, J.
fn balance(run: &mut Run) -> f64 {
    let stored =
        ["kinetic", "strain", "gravity", "dissipated"].map(|of| run.read(&format!("energy.{of}")));
    stored.iter().sum::<f64>() - run.read("energy.input")
}

/// A plate that falls flat through a fluid at rest: its speed is `w tanh(g' t / w)`, `g'` the gravitational acceleration less the share
/// of buoyancy and `w` the terminal speed.
#[test]
fn a_plate_falls_as_drag_and_buoyancy_let_it() {
    let (density, drag) = (1000.0, 1.2);
    for buoyancy in [true, false] {
        let load = json!({"kind": "fluid", "density": density, "drag": drag, "buoyancy": buoyancy});
        let mut run = Run::started(&plate([2, 1], &load));
        let share = if buoyancy {
            1.0 - density / DENSITY
        } else {
            1.0
        };
        let fall = GRAVITY * share;
        let terminal = (2.0 * DENSITY * THICKNESS * fall / (drag * density)).sqrt();
        for t in [0.05_f64, 0.2, 0.5] {
            run.step(t);
            let way = terminal * terminal / fall * (fall * t / terminal).cosh().ln();
            is_near(run.read("p.middle.position[3]"), -way, 1e-5);
            let speed = terminal * (fall * t / terminal).tanh();
            is_near(run.read("p.middle.velocity[3]"), -speed, 1e-4);
            is_near(balance(&mut run), 0.0, 1e-4 * DENSITY * THICKNESS);
        }
    }
}

/// The reaction of a plate that is held on one edge in a current across it, along it and oblique, steady and accelerated.
#[test]
fn a_current_pushes_along_the_normal_and_along_the_surface() {
    let (density, normal, tangential) = (1.2, 1.8, 0.02);
    let push = |current: Value, t: f64| -> [f64; 3] {
        let load = json!({"kind": "fluid", "density": density, "drag": normal, "tangential_drag": tangential,
            "current": current, "buoyancy": false});
        let mut scene = plate([2, 2], &load);
        scene["gravity"] = json!([0, 0, 0]);
        // As it bends, its normal rotates.
        scene["bodies"][0]["material"]["youngs_modulus"] = json!(7e12);
        scene["joints"] =
            json!([{"name": "wall", "kind": "clamped", "edges": ["ground", "p.s1=0"]}]);
        scene["outputs"] = json!([{"kind": "reaction", "joint": "wall"}]);
        scene["initial"] = json!("static_equilibrium");
        let mut run = Run::ready(&scene);
        run.0.initialize(t).expect("an initial state");
        run.0.start().expect("a start");
        run.read_all::<3>("wall.reaction").map(|part| -part)
    };
    let pressure = 0.5 * density * AREA;
    let [_, _, across] = push(json!([0, 0, 5]), 0.0);
    is_near(across, pressure * normal * 25.0, 1e-4);
    let [along, aside, across] = push(json!([-6, 8, 0]), 0.0);
    is_near(along, -pressure * tangential * 60.0, 1e-5);
    is_near(aside, pressure * tangential * 80.0, 1e-5);
    is_near(across, 0.0, 1e-4);
    let [along, _, across] = push(json!([12, 0, -5]), 0.0);
    is_near(along, pressure * tangential * 144.0, 1e-3);
    is_near(across, -pressure * normal * 25.0, 1e-3);
    // A velocity that grows along the plate: the mean of its square is a third.
    let [_, _, across] = push(json!([0, 0, "5*s1"]), 0.0);
    is_near(across, pressure * normal * 25.0 / 3.0, 1e-4);
    let [_, _, across] = push(json!([0, 0, "5*s2*s2"]), 0.0);
    is_near(across, pressure * normal * 25.0 / 5.0, 1e-4);
}

/// A fluid that is accelerated takes a plate along by the ratio of the densities.
#[test]
fn an_accelerated_fluid_takes_a_plate_along() {
    let load = json!({"kind": "fluid", "density": 1000, "current": ["4*t", "-2*t", "7*t"], "buoyancy": false});
    let mut scene = plate([2, 2], &load);
    scene["gravity"] = json!([0, 0, 0]);
    scene["outputs"] = json!([{"kind": "acceleration", "marker": "p.corner"}]);
    let found = Run::started(&scene).read_all::<3>("p.corner.acceleration");
    for (found, rate) in found.into_iter().zip([4.0, -2.0, 7.0]) {
        is_near(found, rate * 1000.0 / DENSITY, 1e-9);
    }
}

/// A plate on a soft ground sinks by its weight over the stiffness. A force on its middle is carried by the ground.
#[test]
fn a_plate_rests_on_a_plane() {
    let stiffness = 1e6;
    let load = json!({"kind": "contact", "stiffness": stiffness, "surface": {"plane": {"point": [0, 0, -0.1], "normal": [0, 0, 1]}}});
    let mut scene = plate([3, 2], &load);
    scene["bodies"][0]["surface"]["rectangle"]["corner"] = json!([0, 0, -0.1]);
    let mass = DENSITY * THICKNESS * AREA;
    scene["outputs"] = json!([{"kind": "position", "marker": "p.middle"}, {"kind": "position", "marker": "p.corner"},
        {"kind": "load_force", "load": "load"}]);
    scene["initial"] = json!("static_equilibrium");
    scene["bodies"][0]["markers"]["middle"] = json!({"at": [0.5, 0.5], "pad": [0.1, 0.1]});
    scene["joints"] = json!([{"name": "pole", "kind": "prismatic", "markers": ["ground", "p.middle"], "direction": [0, 0, 1]}]);
    let mut run = Run::started(&scene);
    let sunk = mass * GRAVITY / (stiffness * AREA);
    is_near(run.read("p.middle.position[3]"), -0.1 - sunk, 1e-10);
    is_near(run.read("p.corner.position[3]"), -0.1 - sunk, 1e-10);
    is_near(run.read("load.force[3]"), mass * GRAVITY, 1e-6);
}

/// A strip on a soft ground under a force in its middle is a beam on an elastic foundation: `w = F b / (2 k)`, `b^4 = k / (4 EI)`.
///
/// M. Hetenyi, Beams on Elastic Foundation (1946), section 4: an infinite beam; this one is ten lengths `1 / b` long.
#[test]
fn a_strip_on_soft_ground_is_a_beam_on_an_elastic_foundation() {
    let (width, h, modulus, stiffness): (f64, f64, f64, f64) = (0.1, 0.01, 1e9, 1e5);
    let bending = modulus * width * h.powi(3) / 12.0;
    let (ground, density) = (stiffness * width, 2000.0);
    let rate = (ground / (4.0 * bending)).powf(0.25);
    let length = 10.0 / rate;
    let force = 1.0;
    // Its weight keeps it on the ground.
    let sunk = density * h * GRAVITY / stiffness;
    let scene = json!({"name": "strip", "dimension": 3, "gravity": [0, 0, -GRAVITY],
        "bodies": [{"name": "p", "element": "plate", "mesh": [16, 1], "thickness": h,
            "surface": {"rectangle": {"corner": [0, 0, 0], "edges": [[length, 0, 0], [0, width, 0]]}},
            "material": {"youngs_modulus": modulus, "poisson_ratio": 0, "density": density},
            "markers": {"middle": {"at": [0.5, 0.5], "pad": [1e-6, width]}}}],
        "joints": [{"name": "pole", "kind": "prismatic", "markers": ["ground", "p.middle"], "direction": [0, 0, 1]}],
        "loads": [{"name": "soil", "kind": "contact", "body": "p", "stiffness": stiffness,
            "surface": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}},
            {"name": "F", "kind": "force", "marker": "p.middle", "value": [0, 0, -force]}],
        "initial": "static_equilibrium",
        "outputs": [{"kind": "position", "marker": "p.middle"}]});
    let found = -Run::started(&scene).read("p.middle.position[3]") - sunk;
    let exact = force * rate / (2.0 * ground);
    is_near(found / exact, 1.0, 2e-3);
}

/// A plate that slides on a plane slows down by the coefficient of friction times the gravitational acceleration.
#[test]
fn friction_slows_a_sliding_plate() {
    let (friction, speed) = (0.3, 4.0);
    let load = json!({"kind": "contact", "stiffness": 1e6, "damping": 1.0, "friction": friction, "slip_velocity": 1e-3,
        "surface": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}});
    let mut scene = plate([2, 1], &load);
    let sunk = DENSITY * THICKNESS * GRAVITY / 1e6;
    scene["bodies"][0]["surface"]["rectangle"]["corner"] = json!([0, 0, -sunk]);
    scene["bodies"][0]["motion"] = json!({"velocity": [speed, 0, 0]});
    let mut run = Run::started(&scene);
    let mass = DENSITY * THICKNESS * AREA;
    let before = balance(&mut run);
    for t in [0.1, 0.5] {
        run.step(t);
        is_near(
            run.read("p.middle.velocity[1]"),
            speed - friction * GRAVITY * t,
            1e-4,
        );
        let lost = friction * mass * GRAVITY * (run.read("p.middle.position[1]") - 0.5 * SIDES[0]);
        is_near(run.read("energy.dissipated"), lost, 1e-4 * lost);
        is_near(balance(&mut run), before, 1e-3);
    }
}

/// A plate that is dropped flat on a hard plane without damping jumps back to where it was.
#[test]
fn a_plate_bounces() {
    let height = 0.05;
    let load = json!({"kind": "contact", "stiffness": 1e7, "surface": {"plane": {"point": [0, 0, -height], "normal": [0, 0, 1]}}});
    let mut scene = plate([2, 1], &load);
    scene["accuracy"] = json!({"relative_tolerance": 1e-9});
    let mut run = Run::started(&scene);
    let stiff = 1e7 / (DENSITY * THICKNESS);
    let speed = (2.0_f64 * GRAVITY * height).sqrt();
    // Half an oscillation about the depth at which it would rest.
    let (rest, rate) = (GRAVITY / stiff, stiff.sqrt());
    let half = 2.0 * (std::f64::consts::FRAC_PI_2 + (rest * rate / speed).atan()) / rate;
    run.step(2.0 * speed / GRAVITY + half);
    is_near(run.read("p.middle.position[3]"), 0.0, 1e-4);
    is_near(run.read("p.middle.velocity[3]"), 0.0, 2e-3);
}
