//! Nothing allocates once a simulation has started: neither a step, nor setting inputs, nor reading
//! outputs, natively and through the C interface.

#[path = "abi/support.rs"]
#[allow(dead_code, reason = "shared with the tests of the C interface")]
mod support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use flexbody::scene::Scene;
use flexbody::simulation::{Simulation, Source, Variable};
use support::{Instance, Status, Unit, call};

/// The system's allocator, counting what each thread asks of it.
struct Counting;

thread_local! {
    static REQUESTS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // A thread that is ending has no counter any more, and nobody looks.
    let _ = REQUESTS.try_with(|requests| requests.set(requests.get() + 1));
}

// SAFETY: every call is passed on to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // Giving back is work as well, and a sign of what was taken.
        count();
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Requests to the allocator that this thread makes during `action`.
fn requests(action: impl FnOnce()) -> u64 {
    let before = REQUESTS.get();
    action();
    REQUESTS.get() - before
}

/// A scene with every kind of input and output; `holder` is a joint that transmits a moment.
fn scene(integrator: &str, damping_time: f64, (joints, holder): (&str, &str)) -> String {
    let moment = match holder {
        "" => String::new(),
        holder => format!(r#"{{ "kind": "reaction_moment", "joint": "{holder}" }},"#),
    };
    format!(
        r#"{{ "name": "all", "dimension": 2, "gravity": [0.0, -9.81],
          "bodies": [ {{ "name": "rod", "element": "cable", "elements": 6,
            "material": {{ "youngs_modulus": 7.0e5, "density": 5540.0, "damping_time": {damping_time} }},
            "section": {{ "area": 1.8e-3, "second_moment": 1.215e-8 }},
            "shape": {{ "arc": {{ "from": [0.0, 0.0], "to": [1.0, 0.1], "length": 1.2 }} }},
            "markers": {{ "root": 0.0, "middle": 0.5, "tip": 1.0 }} }} ],
          "joints": [ {joints} ],
          "inputs": [ {{ "kind": "force", "marker": "rod.tip" }},
                      {{ "kind": "moment", "marker": "rod.middle" }} ],
          "outputs": [
            {{ "kind": "deflection", "marker": "rod.tip" }},
            {{ "kind": "deflection", "marker": "rod.tip", "from": "rod.root" }},
            {{ "kind": "position", "marker": "rod.tip" }}, {{ "kind": "velocity", "marker": "rod.tip" }},
            {{ "kind": "acceleration", "marker": "rod.tip" }}, {{ "kind": "angle", "marker": "rod.tip" }},
            {{ "kind": "angle", "marker": "rod.middle" }},
            {{ "kind": "angular_velocity", "marker": "rod.tip" }},
            {{ "kind": "strain", "marker": "rod.middle" }}, {{ "kind": "curvature", "marker": "rod.middle" }},
            {{ "kind": "reaction", "joint": "joint" }}, {moment}
            {{ "kind": "energy" }}, {{ "kind": "resolution" }}, {{ "kind": "natural_frequency", "body": "rod", "count": 3 }} ],
          "accuracy": {{ "relative_tolerance": 1.0e-4 }},
          "method": {{ "integrator": "{integrator}" }} }}"#
    )
}

const PIN: &str = r#"{ "name": "joint", "kind": "revolute", "markers": ["ground", "rod.root"] }"#;
const CLAMP: &str = r#"{ "name": "joint", "kind": "weld", "markers": ["ground", "rod.root"] }"#;
const SLIDERS: &str = r#"
    { "name": "joint", "kind": "point_on_line", "markers": ["ground", "rod.root"], "direction": [1.0, 0.5] },
    { "name": "other", "kind": "point_on_line", "markers": ["ground", "rod.middle"], "direction": [0.0, 1.0] },
    { "name": "third", "kind": "orientation", "markers": ["ground", "rod.root"] },
    { "name": "fourth", "kind": "point_on_line", "markers": ["ground", "rod.root"], "direction": [1.0, 0.5] }"#;

/// Many bodies: joints, motions and loads of every kind, linear and not, by number, expression, table and
/// input; outputs of every kind that a single cable has not.
const MANY: &str = r#"{ "name": "many", "dimension": 2, "gravity": [0.0, -1.0],
          "bodies": [
            { "name": "crank", "element": "rigid", "mass": 1.0, "inertia": 0.05, "position": [0.2, 0.0],
               "markers": { "root": [-0.2, 0.0], "pin": [0.2, 0.0] } },
            { "name": "rope", "element": "cable", "elements": 4,
               "material": { "youngs_modulus": 7.0e5, "density": 5540.0, "damping_time": 1e-3 },
               "section": { "area": 1.8e-3, "second_moment": 1.215e-8 },
               "shape": { "line": { "from": [0.4, 0.0], "to": [1.4, 0.0] } },
               "markers": { "root": 0.0, "inside": 0.4, "middle": 0.5, "tip": 1.0 } },
            { "name": "ring", "element": "rigid", "mass": 0.3, "inertia": 0.0, "position": [0.8, 0.0],
               "markers": { "eye": [0.0, 0.0] } },
            { "name": "bar", "element": "rigid", "mass": 0.4, "inertia": 0.01, "position": [1.7, 0.0],
               "markers": { "near": [-0.3, 0.0], "far": [0.3, 0.1] } },
            { "name": "arm", "element": "cable", "model": "rigid",
               "material": { "youngs_modulus": 7.0e5, "density": 1000.0 },
               "section": { "area": 6.6e-4, "second_moment": 1.0e-8 },
               "shape": { "line": { "from": [2.0, 0.1], "to": [2.6, 0.1] } },
               "markers": { "near": 0.0, "middle": 0.5, "far": 1.0 } },
            { "name": "cart", "element": "rigid", "mass": 0.5, "inertia": 0.0, "position": [0.0, 2.0],
               "markers": { "eye": [0.0, 0.0] } },
            { "name": "bob", "element": "rigid", "mass": 0.5, "inertia": 0.0, "position": [0.0, 1.5],
               "markers": { "eye": [0.0, 0.0] } },
            { "name": "sledge", "element": "rigid", "mass": 0.5, "inertia": 0.0, "position": [-1.0, 0.0],
               "markers": { "eye": [0.0, 0.0] } } ],
          "masses": [ { "marker": "rope.inside", "mass": 0.2, "inertia": 0.001 } ],
          "joints": [
            { "name": "pivot", "kind": "revolute", "markers": ["ground", "crank.root"] },
            { "name": "clamp", "kind": "weld", "markers": ["crank.pin", "rope.root"] },
            { "name": "slide", "kind": "point_on_cable", "markers": ["rope", "ring.eye"] },
            { "name": "elbow", "kind": "revolute", "markers": ["rope.tip", "bar.near"], "stiffness": 3.0,
               "damping": 0.1 },
            { "name": "fixed", "kind": "weld", "markers": ["bar.far", "arm.near"] },
            { "name": "again", "kind": "revolute", "markers": ["bar.far", "arm.near"] },
            { "name": "link", "kind": "distance", "markers": ["cart.eye", "bob.eye"] },
            { "name": "rail", "kind": "point_on_line", "markers": ["ground", "sledge.eye"],
               "direction": [1.0, 0.0] } ],
          "motions": [
            { "name": "drive", "kind": "angle", "joint": "pivot", "value": "0.3*abs(sin(2*t - 0.2))" },
            { "name": "carry", "kind": "position", "marker": "cart.eye", "value": { "input": 2 } },
            { "name": "feed", "kind": "displacement", "joint": "rail",
               "value": { "table": [[0.0, 0.0], [0.1, 0.02], [0.3, 0.0]], "interpolation": "linear" } } ],
          "loads": [
            { "name": "push", "kind": "force", "marker": "arm.far", "follower": true,
               "value": [0.5, "step(t - 0.12)*sin(t)"] },
            { "name": "turn", "kind": "moment", "marker": "rope.middle",
               "value": { "table": [[0.0, 0.0], [0.15, 0.1]] } },
            { "name": "motor", "kind": "torque", "joint": "elbow", "value": 0.1 },
            { "name": "wind", "kind": "distributed_force", "body": "rope", "value": [0.1, "0.2*sin(PI*s - t)"] },
            { "name": "sail", "kind": "airfoil", "marker": "bar.far", "chord_direction": [1, 0.2], "chord": 0.1, "span": 0.2,
               "density": 1.2, "wind": ["1 + sin(t)", 0.3], "lift": "2*sin(a) + q", "drag": { "table": [[-3, 1], [0, 0.1], [3, 1]] } },
            { "name": "wing", "kind": "airfoil", "body": "rope", "chord_direction": [1, 0.2], "chord": "0.1 - 0.05*s", "ahead": 0.2,
               "density": 1.2, "wind": ["1 + sin(t)*s", 0.3], "lift": "2*sin(a) + q*s", "drag": 0.1, "moment": 0.02 },
            { "name": "stream", "kind": "fluid", "body": "rope", "density": 900.0, "drag": 1.2, "tangential_drag": 0.02,
               "added_mass": 1.0, "current": [0.1, "0.2*s*sin(t)"] },
            { "name": "breeze", "kind": "fluid", "body": "arm", "density": 1.2, "drag": 1.2, "added_mass": 1.0 },
            { "name": "spring", "kind": "spring_damper", "markers": ["ground", "bob.eye"],
               "point": [1.0, 1.5], "stiffness": 20.0, "damping": 0.3 } ],
          "inputs": [ { "kind": "torque", "joint": "elbow" },
                      { "kind": "distributed_force", "body": "rope" },
                      { "kind": "force", "marker": "arm.far", "follower": true },
                      { "kind": "rest_length", "load": "spring" },
                      { "kind": "current", "load": "breeze" } ],
          "outputs": [
            { "kind": "angle", "joint": "elbow" }, { "kind": "angular_velocity", "joint": "elbow" },
            { "kind": "axial_force", "marker": "rope.inside" },
            { "kind": "bending_moment", "marker": "rope.inside" },
            { "kind": "connectivity_force", "marker": "rope.middle" },
            { "kind": "axial_force", "marker": "arm.middle" },
            { "kind": "bending_moment", "marker": "arm.near" },
            { "kind": "connectivity_force", "marker": "arm.far" },
            { "kind": "travel", "joint": "slide" },
            { "kind": "reaction", "joint": "slide" }, { "kind": "reaction", "joint": "link" },
            { "kind": "reaction", "joint": "fixed" }, { "kind": "reaction_moment", "joint": "clamp" },
            { "kind": "reaction", "motion": "carry" },
            { "kind": "reaction_moment", "motion": "drive" },
            { "kind": "momentum" }, { "kind": "center_of_mass" }, { "kind": "residual" },
            { "kind": "work" }, { "kind": "energy" }, { "kind": "resolution" },
            { "kind": "eigenvalue", "count": 2 } ],
          "accuracy": { "relative_tolerance": 1.0e-4 },
          "method": { METHOD } }"#;

/// A block that stops and rotates back under friction, one that a latch catches, and one that falls, slides and sticks.
const EVENTS: &str = r#"{ "name": "events", "dimension": 2,
          "bodies": [
            { "name": "block", "element": "rigid", "mass": 2.0, "inertia": 0.1, "position": [0.0, 0.0],
               "motion": { "velocity": [1.0, 0.0] }, "markers": { "c": [0.0, 0.0] } },
            { "name": "other", "element": "rigid", "mass": 2.0, "inertia": 0.1, "position": [0.0, 1.0],
               "motion": { "velocity": [1.0, 0.0] }, "markers": { "c": [0.0, 0.0] } },
            { "name": "crate", "element": "rigid", "mass": 2.0, "inertia": 0.1, "position": [0.0, -1.0],
               "motion": { "velocity": [0.5, -1.0] }, "markers": { "c": [0.0, 0.0] } } ],
          "joints": [
            { "name": "guide", "kind": "prismatic", "markers": ["ground", "block.c"], "direction": [1.0, 0.0] },
            { "name": "rail", "kind": "prismatic", "markers": ["ground", "other.c"], "direction": [1.0, 0.0] } ],
          "latches": [ { "name": "catch", "joint": "rail", "at": 0.13 } ],
          "loads": [
            { "name": "brake", "kind": "joint_friction", "joint": "guide", "force": 3.0, "static_ratio": 1.2, "stribeck_speed": 0.1 },
            { "name": "spring", "kind": "joint_spring", "joint": "guide", "stiffness": 400.0 },
            { "name": "floor", "kind": "contact", "marker": "crate.c", "surface": { "plane": { "point": [0.0, -1.02], "normal": [0.0, 1.0] } },
               "stiffness": 4000.0, "damping": 0.5, "friction": 0.4, "slip_velocity": 0.01, "tangential_stiffness": 3000.0, "tangential_damping": 30.0 } ],
          "inputs": [ { "kind": "friction", "load": "brake" }, { "kind": "latch", "latch": "catch" } ],
          "outputs": [ { "kind": "load_force", "load": "brake" }, { "kind": "latch_force", "latch": "catch" }, { "kind": "work" } ],
          "accuracy": { "relative_tolerance": 1.0e-4 },
          "method": { METHOD } }"#;

fn scenes() -> Vec<String> {
    let mut scenes: Vec<String> = [r#""integrator": "radau""#, r#""integrator": "rk4""#]
        .map(|method| MANY.replace("METHOD", method))
        .into();
    let methods = [r#""integrator": "radau""#, r#""integrator": "dopri853""#];
    scenes.extend(methods.map(|method| EVENTS.replace("METHOD", method)));
    for integrator in [
        "radau", "rk4", "dopri853", "rkn43", "rkn64", "verlet", "auto",
    ] {
        let reads_rates = !matches!(integrator, "rkn43" | "rkn64" | "verlet");
        for damping_time in [0.0, 1e-4].into_iter().take(1 + usize::from(reads_rates)) {
            for joints in [(PIN, ""), (CLAMP, "joint"), (SLIDERS, "third")] {
                scenes.push(scene(integrator, damping_time, joints));
            }
        }
    }
    scenes.extend(in_space());
    // Points and a cable that touch.
    scenes.push(include_str!("cases/contact/slide.json").into());
    scenes.push(include_str!("cases/slipping_belt/scene.json").into());
    scenes.push(include_str!("../scenes/mooring_line.json").into());
    scenes.push(include_str!("cases/hoisted_mass/space.json").into());
    scenes
}

/// Ready scenes of rigid bodies in space, with a tolerance in place of an error.
fn in_space() -> impl Iterator<Item = String> {
    let ready = [
        include_str!("../scenes/gyroscope.json"),
        include_str!("../scenes/robot_6_axis.json"),
        include_str!("../scenes/stewart_platform.json"),
        include_str!("../scenes/crane_3d.json"),
        include_str!("cases/driven_orientation/scene.json"),
        include_str!("cases/driven_orientation/port.json"),
        include_str!("cases/planar_beam_statics/swing.json"),
    ];
    ready.into_iter().flat_map(|text| {
        ["radau", "rk4", "dopri853", "auto"].map(|integrator| {
            let mut scene: serde_json::Value = serde_json::from_str(text).expect("JSON");
            scene["accuracy"] = serde_json::json!({ "relative_tolerance": 1e-4 });
            scene["method"] = serde_json::json!({ "integrator": integrator });
            let bodies = scene["bodies"].as_array_mut().expect("bodies");
            let cables = bodies.iter_mut().filter(|body| body["element"] == "cable");
            cables.for_each(|cable| cable["elements"] = serde_json::json!(2));
            scene.to_string()
        })
    })
}

/// What an input starts from: what it drives should not be torn away.
fn held(variable: &Variable) -> f64 {
    variable.start.unwrap_or(0.0)
}

#[test]
fn the_counter_counts() {
    assert!(requests(|| drop(std::hint::black_box(vec![1_u8; 100]))) >= 2);
    assert_eq!(requests(|| ()), 0);
}

#[test]
fn a_started_simulation_allocates_nothing() {
    for text in scenes() {
        let scene = Scene::from_json(&text).expect("a valid scene");
        let mut simulation = Simulation::new(scene);
        simulation.initialize(0.0).expect("a valid scene");
        simulation.start().expect("a valid scene");
        let variables = simulation.variables().to_vec();
        let mut sum = 0.0;
        let found = requests(|| {
            for step in 1..=20 {
                for (index, variable) in variables.iter().enumerate() {
                    if matches!(variable.source, Source::Input(..)) {
                        let value = held(variable) + 0.01 * f64::from(step % 5 - 2);
                        simulation.set_real(index, value).expect("an input");
                    }
                    if !variable.is_integer() {
                        // Before the step and after it, with the inputs just set.
                        sum += simulation.real(index).expect("a real variable");
                    }
                }
                simulation.step(0.02 * f64::from(step)).expect("a step");
                for (index, variable) in variables.iter().enumerate() {
                    if !variable.is_integer() {
                        sum += simulation.real(index).expect("a real variable");
                    }
                }
            }
        });
        assert!(sum.is_finite());
        assert_eq!(found, 0, "requests in {text}");
    }
}

#[test]
fn a_started_instance_allocates_nothing() {
    for text in scenes() {
        let unit = Unit::of(&text);
        let instance = Instance::with_logging(&unit, false);
        instance.start();
        let reals: Vec<u32> = (0_u32..)
            .zip(&unit.variables)
            .filter(|(_, variable)| !variable.is_integer())
            .map(|(reference, _)| reference)
            .collect();
        let inputs: Vec<u32> = (0_u32..)
            .zip(&unit.variables)
            .filter(|(_, variable)| matches!(variable.source, Source::Input(..)))
            .map(|(reference, _)| reference)
            .collect();
        let mut values = vec![0.0; reals.len()];
        let starts: Vec<f64> = (unit.variables.iter())
            .filter(|variable| matches!(variable.source, Source::Input(..)))
            .map(held)
            .collect();
        let mut forces = vec![0.0; inputs.len()];
        let (c, mut last) = (instance.component, 0.0);
        let found = requests(|| {
            for step in 0..20 {
                let change = 0.01 * f64::from(step % 5 - 2);
                forces
                    .iter_mut()
                    .zip(&starts)
                    .for_each(|(f, s)| *f = s + change);
                let (vr, n) = (inputs.as_ptr(), inputs.len());
                assert_eq!(call!(fmi2SetReal, c, vr, n, forces.as_ptr()), Status::Ok);
                let time = 0.02 * f64::from(step);
                assert_eq!(call!(fmi2DoStep, c, time, 0.02, 1), Status::Ok);
                let (vr, n) = (reals.as_ptr(), reals.len());
                assert_eq!(
                    call!(fmi2GetReal, c, vr, n, values.as_mut_ptr()),
                    Status::Ok
                );
                assert_eq!(call!(fmi2GetRealStatus, c, 2, &mut last), Status::Ok);
            }
        });
        assert!((last - 0.4).abs() < 1e-12 && values.iter().all(|v| v.is_finite()));
        assert_eq!(found, 0, "requests in {text}");
    }
}
