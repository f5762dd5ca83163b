//! States that are restored after things have moved on: what follows is what followed before, bit for bit, in the same simulation and in one
//! that did nothing else. Joints hold again, work and steps under way are those of then.

use serde_json::{Value, json};

use crate::laws::runs::Run;

const STEP: f64 = 0.02;
/// Steps of a run.
const ALL: u32 = 30;

/// A scene with what is set before a step.
struct Told {
    scene: Value,
    set: fn(&mut Run, u32),
}

fn bar(dimension: usize) -> Value {
    let zeros = vec![0.0; dimension];
    let mut place = zeros.clone();
    place[0] = 0.5;
    let mut end = zeros.clone();
    end[0] = -0.5;
    let mut tip = zeros;
    tip[0] = 0.5;
    let inertia = if dimension == 2 {
        json!(0.2)
    } else {
        json!([0.1, 0.2, 0.25])
    };
    json!({"element": "rigid", "name": "bar", "mass": 2.0, "inertia": inertia, "position": place,
           "markers": {"end": end, "tip": tip, "c": vec![0.0; dimension]}})
}

fn read(dimension: usize) -> Value {
    let gravity = if dimension == 2 {
        json!([0.0, -9.81])
    } else {
        json!([0.0, 0.0, -9.81])
    };
    json!({"name": "told", "dimension": dimension, "gravity": gravity,
        "bodies": [bar(dimension)],
        "outputs": [{"kind": "position", "marker": "bar.tip"}, {"kind": "velocity", "marker": "bar.tip"},
                    {"kind": "acceleration", "marker": "bar.tip"}, {"kind": "energy"}, {"kind": "work"}],
        "experiment": {"stop_time": 1.0, "step": STEP}})
}

fn with(dimension: usize, more: Value) -> Value {
    let mut scene = read(dimension);
    for (key, value) in more.as_object().expect("keys").clone() {
        match (scene[&key].as_array_mut(), value) {
            (Some(list), Value::Array(more)) => list.extend(more),
            (_, value) => scene[&key] = value,
        }
    }
    scene
}

/// Joints that let go, at a time and by an input that falls back.
fn releases() -> Vec<Told> {
    let mut found = Vec::new();
    for dimension in [2, 3] {
        let joint = |more: Value| {
            let mut joint =
                json!({"name": "hold", "kind": "revolute", "markers": ["ground", "bar.end"]});
            let keys = more.as_object().expect("keys").clone();
            joint.as_object_mut().expect("a joint").extend(keys);
            if dimension == 3 {
                joint["direction"] = json!([0.0, 1.0, 0.0]);
            }
            joint
        };
        found.push(Told {
            scene: with(
                dimension,
                json!({"joints": [joint(json!({"release_time": 0.3}))]}),
            ),
            set: |_, _| (),
        });
        found.push(Told {
            scene: with(
                dimension,
                json!({"joints": [joint(json!({}))], "inputs": [{"kind": "release", "joint": "hold"}]}),
            ),
            set: |run, k| run.set("hold.release", f64::from(u8::from((15..17).contains(&k)))),
        });
    }
    found
}

/// A latch that catches a bar, is opened by an input, and catches it again.
fn latched() -> Vec<Told> {
    let scene = |dimension: usize| {
        let mut joint =
            json!({"name": "hold", "kind": "revolute", "markers": ["ground", "bar.end"]});
        if dimension == 3 {
            joint["direction"] = json!([0.0, 1.0, 0.0]);
        }
        let at = if dimension == 3 { 0.4 } else { -0.4 };
        let latch = json!({"name": "catch", "joint": "hold", "at": at});
        let input = json!({"kind": "latch", "latch": "catch"});
        with(
            dimension,
            json!({"joints": [joint], "latches": [latch], "inputs": [input]}),
        )
    };
    let told = |dimension: usize| Told {
        scene: scene(dimension),
        set: |run, k| run.set("catch.armed", f64::from(u8::from(k != 20))),
    };
    vec![told(2), told(3)]
}

/// A ball on a spring with a damper that is pulled slowly, under Radau, whose steps lead far beyond communication points.
fn dense() -> Told {
    let scene = json!({"name": "dense", "dimension": 2, "gravity": [0.0, 0.0],
        "bodies": [{"element": "rigid", "name": "ball", "mass": 1.0, "position": [2.0, 0.0], "markers": {"c": [0.0, 0.0]}}],
        "loads": [{"name": "pull", "kind": "force", "marker": "ball.c", "value": ["cos(0.5*t)", 0.1]},
                  {"name": "rope", "kind": "spring_damper", "markers": ["ground", "ball.c"], "point": [0.0, 0.0],
                   "stiffness": 2.0, "damping": 0.5, "length": 1.9}],
        "outputs": [{"kind": "position", "marker": "ball.c"}, {"kind": "acceleration", "marker": "ball.c"},
                    {"kind": "energy"}, {"kind": "work"}],
        "method": {"integrator": "radau"}, "accuracy": {"relative_tolerance": 1e-4},
        "experiment": {"stop_time": 1.0, "step": STEP}});
    Told {
        scene,
        set: |_, _| (),
    }
}

/// A driven orientation whose quaternion changes its sign, beside what is driven by position.
fn driven() -> Told {
    let scene = with(
        3,
        json!({"ports": [{"name": "p", "marker": "bar.c", "kind": "motion", "rotation": true}]}),
    );
    let set = |run: &mut Run, k: u32| {
        let t = f64::from(k) * STEP;
        let (sin, cos) = (1.5 * t).sin_cos();
        let sign = if k % 3 == 1 { -1.0 } else { 1.0 };
        run.set_all("p.quaternion", &[sign * cos, 0.0, sign * sin, 0.0]);
        run.set_all("p.angular_velocity", &[0.0, 3.0, 0.0]);
        run.set_all("p.position", &[0.5 + t, 0.0, 0.0]);
        run.set_all("p.velocity", &[1.0, 0.0, 0.0]);
    };
    Told { scene, set }
}

/// A run that is cut at every few steps: it goes on, is restored, and goes on again.
fn goes_on_as_it_did(told: &Told) {
    let name = told.scene.to_string();
    let begun = |told: &Told| {
        let mut run = Run::ready(&told.scene);
        (told.set)(&mut run, 0);
        run.start();
        run
    };
    let expected = begun(told).steps(0..ALL, STEP, told.set);
    let mut run = begun(told);
    let mut saved = vec![run.snapshot()];
    for k in 0..ALL {
        run.steps(k..k + 1, STEP, told.set);
        saved.push(run.snapshot());
    }
    // From the end back, so that everything has moved on that can.
    for (k, snapshot) in (0..ALL).zip(&saved).rev().step_by(3) {
        run.restore(snapshot);
        let found = run.steps(k..ALL, STEP, told.set);
        assert_eq!(
            found,
            expected[k as usize..],
            "restored at step {k}: {name}"
        );
        let mut other = Run::ready(&told.scene);
        other.restore(snapshot);
        let found = other.steps(k..ALL, STEP, told.set);
        assert_eq!(
            found,
            expected[k as usize..],
            "elsewhere at step {k}: {name}"
        );
    }
}

#[test]
fn what_follows_a_restored_state_is_what_followed_it() {
    releases().iter().for_each(goes_on_as_it_did);
    latched().iter().for_each(goes_on_as_it_did);
    goes_on_as_it_did(&driven());
}

#[test]
fn so_it_is_within_a_step_that_leads_beyond_communication_points() {
    let told = dense();
    goes_on_as_it_did(&told);
    // Some of these states stand within such a step.
    let mut run = Run::started(&told.scene);
    let mut within = 0;
    for k in 0..ALL {
        run.steps(k..k + 1, STEP, told.set);
        within += u32::from(run.snapshot().state.dense.is_under_way());
    }
    assert!(within > 5, "{within}");
}

/// A joint that has let go stays loose when its input falls back: what hung on it falls freely.
#[test]
fn a_joint_does_not_take_hold_again_when_its_input_falls_back() {
    for told in releases() {
        let dimension = told.scene["dimension"].as_u64().expect("a number") as usize;
        let mut run = Run::started(&told.scene);
        run.steps(0..20, STEP, told.set);
        let center = |run: &mut Run| {
            let tip = run.read(&format!("bar.tip.acceleration[{dimension}]"));
            let height = run.read("energy.gravity") / (2.0 * 9.81);
            [tip, height]
        };
        let [_, before] = center(&mut run);
        run.steps(20..21, STEP, told.set);
        let [_, middle] = center(&mut run);
        run.steps(21..22, STEP, told.set);
        let [_, after] = center(&mut run);
        let falls = (before + after - 2.0 * middle) / (STEP * STEP);
        assert!((falls + 9.81).abs() < 1e-3, "{falls}: {}", told.scene);
    }
}
