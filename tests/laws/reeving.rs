//! Ropes over points against closed forms: Atwood's machine, tackles, a pulley on a rope between two points, ropes that go slack, damping,
//! drums and winches.

use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

const G: f64 = 9.81;

/// A particle of this name and mass at a height.
fn particle(dimension: usize, name: &str, mass: f64, place: [f64; 2]) -> Value {
    json!({"name": name, "element": "rigid", "mass": mass, "position": vector(dimension, place),
        "markers": {"c": vector(dimension, [0.0, 0.0])}})
}

fn scene((dimension, method): (usize, &str), bodies: &Value, rope: &Value) -> Value {
    json!({"name": "reeved", "dimension": dimension, "gravity": vector(dimension, [0.0, -G]), "bodies": bodies, "loads": [rope],
        "outputs": [{"kind": "tension", "load": "rope"}, {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}})
}

fn read(scene: &mut Value, output: Value) {
    let outputs = scene["outputs"].as_array_mut().expect("outputs");
    outputs.push(output);
}

/// Two masses on a rope over a fixed point. Their mean moves like those on a rigid rope, `(m1 - m2) g t`, and the elongation oscillates about
/// `T l / EA`, with the static tension of Atwood's machine.
#[test]
fn masses_over_a_point_move_like_those_of_atwoods_machine() {
    let (heavy, light, stiffness) = (3.0, 2.0, 4000.0);
    for setting in settings() {
        let dimension = setting.0;
        let bodies = json!([
            particle(dimension, "heavy", heavy, [-0.1, -1.5]),
            particle(dimension, "light", light, [0.1, -2.5])
        ]);
        let points = [[-0.1, 0.0], [0.1, 0.0]].map(|point| vector(dimension, point));
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["heavy.c", "ground", "ground", "light.c"],
            "points": points, "axial_stiffness": stiffness * 4.2});
        let mut scene = scene(setting, &bodies, &rope);
        for name in ["heavy.c", "light.c"] {
            read(&mut scene, json!({"kind": "position", "marker": name}));
        }
        let mut run = Run::started(&scene);
        let rate = (stiffness * (1.0 / heavy + 1.0 / light)).sqrt();
        for t in [0.3, 0.8] {
            run.step(t);
            let elongation = 2.0 * G / (rate * rate) * (1.0 - (rate * t).cos());
            is_near(run.read("rope.tension"), stiffness * elongation, 1e-3);
            // m1 y1 - m2 y2 and y1 + y2, downwards.
            let (difference, sum) = (
                0.5 * (heavy - light) * G * t * t + heavy * 1.5 - light * 2.5,
                4.0 + elongation,
            );
            let down = (difference + light * sum) / (heavy + light);
            is_near(run.read("heavy.c.position[2]"), -down, 1e-6);
            is_near(run.read("light.c.position[2]"), down - sum, 1e-6);
        }
    }
}

/// A load on four falls of a tackle: the tension is a quarter of its weight, and it sinks by a quarter of the elongation.
#[test]
fn a_tackle_shares_the_weight_among_its_falls() {
    for setting in settings() {
        let dimension = setting.0;
        let bodies = json!([particle(dimension, "hook", 100.0, [0.0, -3.0])]);
        let zero = vector(dimension, [0.0, 0.0]);
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "hook.c", "ground", "hook.c", "ground"],
            "points": [zero, zero, zero], "axial_stiffness": 1e5});
        let mut scene = scene(setting, &bodies, &rope);
        scene["initial"] = json!("static_equilibrium");
        read(&mut scene, json!({"kind": "position", "marker": "hook.c"}));
        let mut run = Run::started(&scene);
        let tension = 100.0 * G / 4.0;
        is_near(run.read("rope.tension"), tension, 1e-6);
        let sag = 12.0 * tension / 1e5 / 4.0;
        is_near(run.read("hook.c.position[2]"), -3.0 - sag, 1e-9);
    }
}

/// A pulley that runs on a rope between points of unequal height moves on an ellipse about them, and hangs where both parts have the same
/// angle with the vertical: `sin a = d / l`.
#[test]
fn a_pulley_on_a_rope_moves_on_an_ellipse() {
    let points = [[-1.0, 0.0], [1.0, 0.7]];
    for setting in settings() {
        let dimension = setting.0;
        let bodies = json!([particle(dimension, "pulley", 2.0, [0.3, -1.2])]);
        let ends = points.map(|point| vector(dimension, point));
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "pulley.c", "ground"], "points": ends,
            "axial_stiffness": 1e7});
        let mut scene = scene(setting, &bodies, &rope);
        read(
            &mut scene,
            json!({"kind": "position", "marker": "pulley.c"}),
        );
        let path = |run: &mut Run| {
            let place = [1, 2].map(|k| run.read(&format!("pulley.c.position[{k}]")));
            points.map(|[x, y]| (place[0] - x).hypot(place[1] - y))
        };
        let mut still = scene.clone();
        still["initial"] = json!("static_equilibrium");
        let mut run = Run::started(&still);
        let [first, second] = path(&mut run);
        let tension = run.read("rope.tension");
        let length = 1.3_f64.hypot(1.2) + 0.7_f64.hypot(1.9);
        is_near(first + second, length * (1.0 + tension / 1e7), 1e-9);
        let angle = (2.0 / (first + second)).asin();
        let x = run.read("pulley.c.position[1]");
        is_near((x + 1.0) / first, angle.sin(), 1e-8);
        is_near(tension, 2.0 * G / (2.0 * angle.cos()), 1e-4);
        // Let go where it is drawn, it oscillates on the ellipse with the energy that it has.
        let mut run = Run::started(&scene);
        let before = run.balance();
        for t in [0.2, 0.5, 0.9] {
            run.step(t);
            let [first, second] = path(&mut run);
            let stretched = length * (1.0 + run.read("rope.tension") / 1e7);
            is_near(first + second, stretched, 1e-8);
            is_near(run.balance(), before, 1e-5);
        }
    }
}

/// A mass on a rope that is thrown up flies without tension, `2 v / g` long, then bounces on the rope that is taut again.
#[test]
fn a_mass_that_is_thrown_up_flies_until_the_rope_is_taut() {
    for setting in settings() {
        let dimension = setting.0;
        let mut body = particle(dimension, "mass", 2.0, [0.0, -1.0]);
        body["motion"] = json!({"velocity": vector(dimension, [0.0, 2.0])});
        let zero = vector(dimension, [0.0, 0.0]);
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "mass.c"], "points": [zero], "axial_stiffness": 800});
        let mut scene = scene(setting, &json!([body]), &rope);
        read(&mut scene, json!({"kind": "position", "marker": "mass.c"}));
        let mut run = Run::started(&scene);
        run.step(0.2);
        is_near(
            run.read("mass.c.position[2]"),
            -1.0 + 0.4 - 0.5 * G * 0.04,
            1e-8,
        );
        assert_eq!(run.read("rope.tension"), 0.0);
        let (taut, rate) = (4.0 / G, 20.0);
        for after in [0.05, 0.15] {
            run.step(taut + after);
            let (sin, cos) = (rate * after).sin_cos();
            let elongation = G / (rate * rate) * (1.0 - cos) + 2.0 / rate * sin;
            is_near(run.read("mass.c.position[2]"), -1.0 - elongation, 1e-6);
            is_near(run.read("rope.tension"), 800.0 * elongation, 1e-3);
        }
    }
}

/// A damped rope that stays taut is a damped oscillator: `m s'' + EA (s + T s') / l = m g`.
#[test]
fn a_taut_rope_is_damped_like_an_oscillator() {
    for setting in settings() {
        let dimension = setting.0;
        let bodies = json!([particle(dimension, "mass", 5.0, [0.0, -2.02])]);
        let zero = vector(dimension, [0.0, 0.0]);
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "mass.c"], "points": [zero], "axial_stiffness": 4000,
            "damping_time": 0.004, "length": 2.0});
        let mut scene = scene(setting, &bodies, &rope);
        read(&mut scene, json!({"kind": "position", "marker": "mass.c"}));
        let mut run = Run::started(&scene);
        let (stiffness, still) = (2000.0, 5.0 * G / 2000.0);
        let (rate, decay) = ((stiffness / 5.0_f64).sqrt(), 0.5 * 0.004 * stiffness / 5.0);
        let (damped, from) = ((rate * rate - decay * decay).sqrt(), 0.02 - still);
        for t in [0.1, 0.4, 1.0] {
            run.step(t);
            let (sin, cos) = (damped * t).sin_cos();
            let elongation = still + (-decay * t).exp() * from * (cos + decay / damped * sin);
            is_near(run.read("mass.c.position[2]"), -2.0 - elongation, 1e-8);
        }
        is_near(
            run.balance(),
            2.0 * -G * 5.0 * 1.01 + 0.5 * stiffness * 0.0004,
            1e-6,
        );
    }
}

/// A mass that hangs from a drum unwinds it: a drum of inertia `J` feels `N r + E r`, with the energy `E` of a metre of rope. The reference is
/// the method of Runge and Kutta in small steps.
#[test]
fn a_mass_unwinds_a_drum() {
    let (mass, inertia, radius, stiffness) = (4.0, 0.3, 0.2, 6000.0);
    for setting in settings() {
        let dimension = setting.0;
        let moments = if dimension == 2 {
            json!(inertia)
        } else {
            json!([0.3, 0.3, inertia])
        };
        let zero = vector(dimension, [0.0, 0.0]);
        let bodies = json!([particle(dimension, "mass", mass, [0.2, -1.0]),
            {"name": "drum", "element": "rigid", "mass": 1, "inertia": moments, "position": zero, "markers": {"c": zero}}]);
        let rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "mass.c"], "points": [vector(dimension, [0.2, 0.0])],
            "axial_stiffness": stiffness, "drum": "axle", "drum_radius": -radius});
        let mut scene = scene(setting, &bodies, &rope);
        scene["joints"] = if dimension == 2 {
            json!([{"name": "axle", "kind": "revolute", "markers": ["ground", "drum.c"]}])
        } else {
            json!([{"name": "axle", "kind": "revolute", "markers": ["ground", "drum.c"], "direction": [0, 0, 1]}])
        };
        read(&mut scene, json!({"kind": "position", "marker": "mass.c"}));
        read(&mut scene, json!({"kind": "angle", "joint": "axle"}));
        let mut run = Run::started(&scene);
        let before = run.balance();
        run.step(0.9);
        let [down, turned] = unwound(0.9, [mass, inertia, radius, stiffness]);
        is_near(run.read("mass.c.position[2]"), -1.0 - down, 1e-7);
        is_near(run.read("axle.angle"), turned, 1e-6);
        is_near(run.balance(), before, 1e-6);
    }
}

/// Way of the mass and angle of the drum after a time, from rest.
fn unwound(until: f64, [mass, inertia, radius, stiffness]: [f64; 4]) -> [f64; 2] {
    let rates = |[down, turned, speed, spin]: [f64; 4]| {
        let free = 1.0 + radius * turned;
        let strain = ((1.0 + down - free) / free).max(0.0);
        let pull = stiffness * strain;
        let moment = (pull + 0.5 * stiffness * strain * strain) * radius;
        [speed, spin, G - pull / mass, moment / inertia]
    };
    let (mut state, steps) = ([0.0; 4], 40_000);
    let h = until / f64::from(steps);
    for _ in 0..steps {
        let moved = |by: [f64; 4], part: f64| std::array::from_fn(|k| state[k] + part * h * by[k]);
        let a = rates(state);
        let b = rates(moved(a, 0.5));
        let c = rates(moved(b, 0.5));
        let d = rates(moved(c, 1.0));
        state = std::array::from_fn(|k| state[k] + h / 6.0 * (a[k] + 2.0 * (b[k] + c[k]) + d[k]));
    }
    [state[0], state[1]]
}

/// A winch hauls in the rope of a tackle with two falls, by a function of time and by an input: the load rises by half of that. What it does
/// is what the load gains.
#[test]
fn a_winch_lifts_a_tackle_by_half_of_what_it_hauls_in() {
    for setting in settings() {
        let dimension = setting.0;
        let bodies = json!([particle(dimension, "hook", 50.0, [0.0, -4.0])]);
        let ends = [[-0.2, 0.0], [0.2, 0.0]].map(|point| vector(dimension, point));
        let course =
            |t: f64| 8.0 - 2.0 * (0.5 * t).min(1.0).powi(2) * (3.0 - 2.0 * (0.5 * t).min(1.0));
        let mut rope = json!({"name": "rope", "kind": "reeving", "markers": ["ground", "hook.c", "ground"], "points": ends,
            "axial_stiffness": 2e5, "damping_time": 0.05, "length": "8 - 2*min(t/2, 1)^2*(3 - 2*min(t/2, 1))"});
        for by_input in [false, true] {
            if by_input {
                rope["length"] = json!(8.0);
            }
            let mut scene = scene(setting, &bodies, &rope);
            if by_input {
                scene["inputs"] = json!([{"kind": "rest_length", "load": "rope"}]);
            }
            scene["initial"] = json!("static_equilibrium");
            read(&mut scene, json!({"kind": "position", "marker": "hook.c"}));
            let mut run = Run::ready(&scene);
            if by_input {
                run.set("rope.rest_length", course(0.0));
            }
            run.start();
            let before = run.balance();
            for k in 1..=300 {
                let t = 0.01 * f64::from(k);
                if by_input {
                    run.set("rope.rest_length", course(t));
                }
                run.step(t);
            }
            run.step(6.0);
            let tension = run.read("rope.tension");
            let half = 3.0 * (1.0 + tension / 2e5);
            is_near(
                run.read("hook.c.position[2]"),
                -(half * half - 0.04).sqrt(),
                1e-6,
            );
            is_near(
                tension,
                0.5 * 50.0 * G * half / (half * half - 0.04).sqrt(),
                1e-3,
            );
            is_near(run.balance(), before, 1e-4);
        }
    }
}
