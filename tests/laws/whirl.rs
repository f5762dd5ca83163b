//! Cables that rotate steadily about an upright axis, bent in space: a heavy one that hangs from its top (the conical
//! pendulum of a cable) and one held at both ends (a skipping rope), against the equations of a string.
//!
//! Source: I. I. Kolodner, Heavy rotating string: a nonlinear eigenvalue problem, Comm. Pure Appl. Math. 8 (1955).

use flexbody::integrators::{Radau, Tolerance, advance};
use flexbody::scene::{Assembled, Scene, assemble};
use flexbody::system::{DrivenSystem, Evaluation, Workspace};
use nalgebra::{Matrix2, Rotation3, Vector2, Vector3};
use serde_json::json;

const ELEMENTS: usize = 24;
/// Axial stiffness, N; mass per length, kg/m; length, m.
const STIFFNESS: f64 = 2e3;
const DENSITY: f64 = 0.5;
const LENGTH: f64 = 1.0;
/// Steps of the Runge-Kutta method for the string, an element.
const STEPS: usize = 200;

/// A string in a plane through its axis that rotates with it at a rate under gravity along the axis.
struct String {
    gravity: f64,
    rate: f64,
}

/// Distance from the axis and height, and the force across and along the axis.
type Point = [f64; 4];

impl String {
    /// By reference length: `(T r'/|r'|)' = -density (rate^2 distance, -gravity)`, `|r'| = 1 + T / EA`.
    fn slope(&self, [x, _, fx, fz]: Point) -> Point {
        let tension = fx.hypot(fz);
        let change = [-DENSITY * self.rate * self.rate * x, DENSITY * self.gravity];
        // At a free end the force vanishes, and comes from where it goes.
        let along = if tension > 1e-9 {
            [fx, fz]
        } else {
            change.map(|c| -c)
        };
        let stretch = (1.0 + tension / STIFFNESS) / along[0].hypot(along[1]);
        [stretch * along[0], stretch * along[1], change[0], change[1]]
    }

    /// The string at the nodes of the elements from its first end on, with the forces there.
    fn curve(&self, start: Point) -> Vec<Point> {
        let h = LENGTH / (ELEMENTS * STEPS) as f64;
        let moved = |p: Point, k: Point, h: f64| std::array::from_fn(|i| p[i] + h * k[i]);
        let (mut nodes, mut p) = (vec![start], start);
        for step in 1..=ELEMENTS * STEPS {
            let a = self.slope(p);
            let b = self.slope(moved(p, a, 0.5 * h));
            let c = self.slope(moved(p, b, 0.5 * h));
            let d = self.slope(moved(p, c, h));
            p = std::array::from_fn(|i| p[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
            if step % STEPS == 0 {
                nodes.push(p);
            }
        }
        nodes
    }

    /// The string whose last end misses nothing, by Newton's method on the force at its first end.
    fn fitted(&self, mut force: Vector2<f64>, missing: impl Fn(&Point) -> [f64; 2]) -> Vec<Point> {
        let end = |force: Vector2<f64>| {
            let nodes = self.curve([0.0, 0.0, force.x, force.y]);
            Vector2::from(missing(&nodes[ELEMENTS]))
        };
        for _ in 0..50 {
            let columns = [Vector2::x(), Vector2::y()].map(|axis: Vector2<f64>| {
                let h = 1e-6 * force.norm();
                (end(force + axis * h) - end(force - axis * h)) / (2.0 * h)
            });
            let step = Matrix2::from_columns(&columns).lu().solve(&end(force));
            let step = step.expect("a curve that follows the force");
            force -= step * (0.3 * force.norm() / step.norm()).min(1.0);
            if step.norm() < 1e-12 * force.norm() {
                break;
            }
        }
        self.curve([0.0, 0.0, force.x, force.y])
    }
}

fn assembled(gravity: f64, held: Option<f64>) -> Assembled<3> {
    let mut scene = json!({
        "name": "whirl", "dimension": 3, "gravity": [0.0, 0.0, -gravity],
        "bodies": [{"name": "rope", "element": "cable", "elements": ELEMENTS,
            "material": {"youngs_modulus": STIFFNESS / 1e-4, "density": DENSITY / 1e-4},
            "section": {"area": 1e-4, "second_moment": 0.0},
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.0, 0.0, -LENGTH]}},
            "markers": {"top": 0.0, "end": 1.0}}],
        "joints": [{"name": "hook", "kind": "spherical", "markers": ["ground", "rope.top"]}]});
    if let Some(height) = held {
        let joints = scene["joints"].as_array_mut().expect("joints");
        joints.push(
            json!({"name": "hand", "kind": "spherical", "markers": ["ground", "rope.end"],
            "point": [0.0, 0.0, height]}),
        );
    }
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    assemble(&scene).expect("a system")
}

/// Largest distance of a node, relative to the length, from where the rotating string is after a time.
fn off(string: &String, nodes: &[Point], system: &Assembled<3>, time: f64) -> f64 {
    let (system, mut work) = (&system.system, Workspace::new(&system.system));
    let axis = Vector3::z() * string.rate;
    let at = |p: &Point, turn: f64| {
        let [x, z, ..] = *p;
        let slope = string.slope(*p);
        let [r, u] = [[x, z], [slope[0], slope[1]]].map(|[x, z]| Vector3::new(x, 0.0, z));
        [r, u].map(|v| Rotation3::new(Vector3::z() * turn) * v)
    };
    let described: Vec<_> = nodes.iter().map(|p| at(p, 0.0)).collect();
    let rates: Vec<_> = (described.iter())
        .map(|node| node.map(|v| axis.cross(&v).into()))
        .collect();
    let described: Vec<_> = described.iter().map(|node| node.map(Into::into)).collect();
    let state = system.initial_state(0.0, &[], (&described, &rates), &mut work);
    let mut state = state.expect("a string that fits");
    let tolerance = Tolerance {
        relative: 1e-7,
        position: system.scale(),
        time: 1.0 / string.rate,
    };
    let mut method = Radau::new(system.coordinates());
    let mut model = DrivenSystem::new(system, &[], &mut work, &state);
    let (_, result) = advance(&mut method, &mut model, &mut state, time, &tolerance);
    result.expect("a step");
    let mut values = Evaluation::new(system);
    values.kinematics(system, &state, &mut work);
    let ways = values.x.iter().zip(nodes).map(|(x, p)| {
        let [r, _] = at(p, string.rate * time);
        (Vector3::from(x[0]) - r).norm()
    });
    ways.fold(0.0, f64::max) / LENGTH
}

#[test]
fn a_heavy_cable_turns_as_a_conical_pendulum() {
    let string = String {
        gravity: 9.81,
        rate: 4.5,
    };
    // A little faster than the lowest frequency of small swings, 3.77 rad/s, it stands off by some 40 degrees.
    let weight = DENSITY * LENGTH * string.gravity;
    let nodes = string.fitted(Vector2::new(0.6, -0.9) * weight, |[_, _, fx, fz]| {
        [*fx, *fz]
    });
    assert!(nodes[ELEMENTS][0] > 0.3, "{:?}", nodes[ELEMENTS]);
    let found = off(&string, &nodes, &assembled(string.gravity, None), 1.0);
    assert!(found < 2e-4, "{found:e}");
}

#[test]
fn a_skipping_rope_keeps_its_shape() {
    let string = String {
        gravity: 0.0,
        rate: 15.0,
    };
    let height = -0.7;
    let nodes = string.fitted(Vector2::new(20.0, -15.0), |[x, z, ..]| [*x, z - height]);
    let highest = nodes.iter().map(|p| p[0]).fold(0.0, f64::max);
    assert!(highest > 0.2, "{highest}");
    let found = off(&string, &nodes, &assembled(0.0, Some(height)), 0.5);
    assert!(found < 2e-5, "{found:e}");
}
