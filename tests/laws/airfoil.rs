//! Airfoils against closed forms: bodies with drag, twist under lift, flutter of a section, wings on beams.

use nalgebra::{Matrix2, Matrix4, Vector3};
use serde_json::{Value, json};

use super::runs::{Run, is_near, settings, vector};

const DENSITY: f64 = 1.2;

fn strip(marker: &str, mut keys: Value) -> Value {
    keys["name"] = json!("air");
    keys["kind"] = json!("airfoil");
    keys["marker"] = json!(marker);
    keys["density"] = json!(DENSITY);
    keys
}

fn inertia(dimension: usize, about: f64) -> Value {
    match dimension {
        2 => json!(about),
        _ => json!([about, about, about]),
    }
}

/// A body that falls with drag alone: `v = v_t tanh(g t / v_t)`; what the air takes is what gravity gives beyond the kinetic energy.
#[test]
fn a_body_falls_with_drag() {
    for (dimension, method) in settings() {
        let mut scene = json!({"name": "drop", "dimension": dimension, "gravity": vector(dimension, [0.0, -9.81]),
            "bodies": [{"name": "b", "element": "rigid", "mass": 3.0, "inertia": inertia(dimension, 0.4),
                "position": vector(dimension, [0.0, 0.0]), "markers": {"c": vector(dimension, [0.0, 0.0])}}],
            "outputs": [{"kind": "velocity", "marker": "b.c"}, {"kind": "energy"}, {"kind": "work"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}});
        let mut keys = json!({"chord_direction": vector(dimension, [0.0, 2.0]), "chord": 0.4, "span": 0.5, "lift": 0, "drag": 1.3});
        if dimension == 3 {
            keys["lift_direction"] = json!([-1.0, 0.5, 0.0]);
        }
        scene["loads"] = json!([strip("b.c", keys)]);
        let mut run = Run::started(&scene);
        let slowest = (2.0 * 3.0 * 9.81 / (DENSITY * 0.2 * 1.3)).sqrt();
        for k in 1..=4 {
            let time = 0.8 * f64::from(k);
            run.step(time);
            let speed = slowest * (9.81 * time / slowest).tanh();
            is_near(run.read("b.c.velocity[2]"), -speed, 1e-7);
            let energy = run.read("energy.kinetic") + run.read("energy.gravity");
            is_near(run.read("energy.input"), energy, 1e-6);
        }
    }
}

/// A strip on an arm that spins in still air: `w = w_0 / (1 + k w_0 t / J)` with `k = rho S C_d R^3 / 2`.
#[test]
fn drag_of_blades_stops_a_rotor() {
    for (dimension, method) in settings() {
        let axis = match dimension {
            2 => json!({"name": "axle", "kind": "revolute", "markers": ["ground", "b.c"]}),
            _ => {
                json!({"name": "axle", "kind": "revolute", "markers": ["ground", "b.c"], "direction": [0, 0, 1]})
            }
        };
        let spin = match dimension {
            2 => json!(12.0),
            _ => json!([0.0, 0.0, 12.0]),
        };
        let mut keys = json!({"chord_direction": vector(dimension, [0.0, -1.0]), "chord": 0.3, "span": 0.7, "lift": "2*a", "drag": 0.9});
        if dimension == 3 {
            keys["lift_direction"] = json!([0, 0, 1]);
        } else {
            // In the plane the lift is radial, and the point whose velocity counts is beside the marker.
            keys["lift"] = json!(0);
        }
        let scene = json!({"name": "rotor", "dimension": dimension,
            "bodies": [{"name": "b", "element": "rigid", "mass": 3.0, "inertia": inertia(dimension, 0.8), "motion": {"spin": spin},
                "position": vector(dimension, [0.0, 0.0]),
                "markers": {"c": vector(dimension, [0.0, 0.0]), "tip": vector(dimension, [1.1, 0.0])}}],
            "joints": [axis], "loads": [strip("b.tip", keys)], "outputs": [{"kind": "angular_velocity", "joint": "axle"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-10}});
        let mut run = Run::started(&scene);
        // In the plane the flow has a radial part too, of half a chord over the radius.
        let beside = if dimension == 2 {
            (1.0 + (0.15_f64 / 1.1).powi(2)).sqrt()
        } else {
            1.0
        };
        let k = 0.5 * DENSITY * 0.21 * 0.9 * 1.1_f64.powi(3) * beside;
        for step in 1..=4 {
            let time = 0.5 * f64::from(step);
            run.step(time);
            is_near(
                run.read("axle.angular_velocity"),
                12.0 / (1.0 + k * 12.0 * time / 0.8),
                1e-7,
            );
        }
    }
}

/// Numbers of a section that plunges and pitches: masses, where its mass and its aerodynamic centre are from the elastic axis.
struct Section {
    carriage: f64,
    mass: f64,
    inertia: f64,
    behind: f64,
    ahead: f64,
    stiffness: [f64; 2],
    chord: f64,
    span: f64,
}

const SECTION: Section = Section {
    carriage: 0.5,
    mass: 4.0,
    inertia: 0.06,
    behind: 0.05,
    ahead: 0.08,
    stiffness: [900.0, 60.0],
    chord: 0.5,
    span: 1.2,
};

impl Section {
    /// The scene in a wind along the first axis. Coefficients are those of a thin airfoil.
    fn scene(&self, dimension: usize, wind: f64) -> Value {
        let v = |x, y| vector(dimension, [x, y]);
        let slide = json!({"name": "slide", "kind": "prismatic", "markers": ["ground", "carriage.c"], "direction": v(0.0, 1.0)});
        let mut pin =
            json!({"name": "pin", "kind": "revolute", "markers": ["carriage.c", "wing.axis"]});
        if dimension == 3 {
            pin["direction"] = json!([0, 0, 1]);
        }
        let [plunge, pitch] = self.stiffness;
        let mut keys = json!({"chord_direction": v(1.0, 0.0), "chord": self.chord, "span": self.span, "wind": v(wind, 0.0),
            "lift": "2*PI*sin(a)", "moment": "-PI/2*q"});
        if dimension == 3 {
            keys["lift_direction"] = json!([0, 1, 0]);
        }
        json!({"name": "section", "dimension": dimension,
            "bodies": [
                {"name": "carriage", "element": "rigid", "mass": self.carriage, "inertia": inertia(dimension, 0.1), "position": v(0.0, 0.0),
                    "markers": {"c": v(0.0, 0.0)}},
                {"name": "wing", "element": "rigid", "mass": self.mass, "inertia": inertia(dimension, self.inertia),
                    "position": v(self.behind, 0.0), "markers": {"axis": v(-self.behind, 0.0), "quarter": v(-self.behind - self.ahead, 0.0)}}],
            "joints": [slide, pin],
            "loads": [strip("wing.quarter", keys),
                {"name": "plunge", "kind": "joint_spring", "joint": "slide", "stiffness": plunge},
                {"name": "pitch", "kind": "joint_spring", "joint": "pin", "stiffness": pitch}],
            "outputs": [{"kind": "eigenvalue", "count": 2}]})
    }

    /// Largest growth rate and both frequencies by the equations of Theodorsen without lag and mass of air, for plunge (up) and pitch
    /// (nose up).
    fn roots(&self, wind: f64) -> Vec<[f64; 2]> {
        let static_moment = self.mass * self.behind;
        let mass = Matrix2::new(
            self.mass + self.carriage,
            -static_moment,
            -static_moment,
            self.inertia + self.mass * self.behind * self.behind,
        );
        let slope = DENSITY * wind * wind * self.chord * self.span * std::f64::consts::PI;
        let back = 0.5 * self.chord - self.ahead;
        // The angle of attack is `pitch - (plunge' - back pitch') / U`; the moment about the axis is that of the lift and `C_m`.
        let arm = nalgebra::Vector2::new(1.0, self.ahead);
        let stiffness = Matrix2::from_diagonal(&self.stiffness.into())
            - slope * arm * nalgebra::RowVector2::new(0.0, 1.0);
        let pressure = 0.5 * DENSITY * wind * wind * self.chord * self.chord * self.span;
        let rate = std::f64::consts::FRAC_PI_2 * 0.5 * self.chord / wind;
        let damping = slope / wind * arm * nalgebra::RowVector2::new(1.0, -back)
            + Matrix2::new(0.0, 0.0, 0.0, pressure * rate);
        let inverse = mass.try_inverse().expect("a mass");
        let mut whole = Matrix4::zeros();
        whole.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
        whole
            .fixed_view_mut::<2, 2>(2, 0)
            .copy_from(&(-inverse * stiffness));
        whole
            .fixed_view_mut::<2, 2>(2, 2)
            .copy_from(&(-inverse * damping));
        let all = whole.complex_eigenvalues();
        let mut roots: Vec<_> = (all.iter().filter(|root| root.im > 0.0))
            .map(|root| [-root.re, root.im])
            .collect();
        roots.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        roots
    }
}

/// Decay and frequency of plunge and pitch at speeds around that of flutter, which the roots of the equations tell.
#[test]
fn a_section_flutters_at_the_speed_that_theodorsen_says() {
    let growth = |wind: f64| {
        SECTION
            .roots(wind)
            .iter()
            .map(|root| -root[0])
            .fold(f64::MIN, f64::max)
    };
    let (mut calm, mut wild) = (5.0, 80.0);
    assert!(growth(calm) < 0.0 && growth(wild) > 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (calm + wild);
        *(if growth(middle) < 0.0 {
            &mut calm
        } else {
            &mut wild
        }) = middle;
    }
    for dimension in [2, 3] {
        for part in [0.5, 0.99, 1.01] {
            let wind = part * calm;
            let mut run = Run::started(&SECTION.scene(dimension, wind));
            let exact = SECTION.roots(wind);
            for (k, [decay, frequency]) in exact.iter().enumerate() {
                is_near(
                    run.read(&format!("eigenvalue.decay_rate[{}]", k + 1)),
                    *decay,
                    1e-6,
                );
                is_near(
                    run.read(&format!("eigenvalue.frequency[{}]", k + 1)),
                    *frequency,
                    1e-6,
                );
            }
            let grows = exact.iter().any(|root| root[0] < 0.0);
            assert_eq!(grows, part > 1.0, "{exact:?}");
        }
    }
}

/// A wing on a torsion spring twists until the spring holds the moment of the lift: `K t = rho U^2 S e C (t + a) cos(t) / 2`.
#[test]
fn lift_twists_a_wing_to_where_its_spring_holds_it() {
    for dimension in [2, 3] {
        let v = |x, y| vector(dimension, [x, y]);
        let mut pin = json!({"name": "pin", "kind": "revolute", "markers": ["ground", "wing.c"]});
        // Built in at 0.1 rad, nose up.
        let (sin, cos) = 0.1_f64.sin_cos();
        let mut keys = json!({"chord_direction": v(cos, -sin), "chord": 0.5, "span": 1.0, "wind": v(20.0, 0.0), "lift": "5*a"});
        if dimension == 3 {
            pin["direction"] = json!([0, 0, 1]);
            keys["lift_direction"] = json!([sin, cos, 0.0]);
        }
        let scene = json!({"name": "wing", "dimension": dimension,
            "bodies": [{"name": "wing", "element": "rigid", "mass": 2.0, "inertia": inertia(dimension, 0.1), "position": v(0.0, 0.0),
                "markers": {"c": v(0.0, 0.0), "quarter": v(-0.1, 0.0)}}],
            "joints": [pin], "loads": [strip("wing.quarter", keys), {"name": "spring", "kind": "joint_spring", "joint": "pin", "stiffness": 150.0}],
            "outputs": [{"kind": "angle", "joint": "pin"}, {"kind": "load_force", "load": "air"}],
            "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9}});
        let mut run = Run::started(&scene);
        let pressure = 0.5 * DENSITY * 400.0 * 0.5;
        let mut twist = 0.0_f64;
        for _ in 0..200 {
            twist = pressure * 0.1 * 5.0 * (twist + 0.1) * twist.cos() / 150.0;
        }
        is_near(run.read("pin.angle"), -twist, 1e-9);
        is_near(
            run.read("air.force[2]"),
            pressure * 5.0 * (twist + 0.1),
            1e-6,
        );
        is_near(run.read("air.force[1]"), 0.0, 1e-6);
    }
}

/// Velocity of the air past clamped wings, m/s.
const WIND: Vector3<f64> = Vector3::new(3.0, 20.0, 2.0);
/// Direction of their chord along the axes of the section: the tangent, its first axis and its second one.
const CHORD: Vector3<f64> = Vector3::new(0.1, 1.0, 0.0);
/// Coefficients of lift, drag and moment.
const COEFFICIENTS: [f64; 3] = [0.8, 0.15, -0.3];

/// A wing that is clamped along the first axis, with a strip at its tip.
fn wing(dimension: usize, element: &str) -> Value {
    let mut section = match dimension {
        2 => json!({"area": 4e-4, "second_moment": 1e-8}),
        _ => json!({"area": 4e-4, "second_moments": [1e-8, 2e-8], "torsion_constant": 1e-8}),
    };
    let mut material = json!({"youngs_modulus": 2e9, "density": 1e3});
    if element != "cable" {
        material["shear_modulus"] = json!(8e8);
    }
    match (dimension, element) {
        (2, "beam") => section["shear_factor"] = json!(0.8),
        (3, "beam") => section["shear_factors"] = json!([0.8, 0.8]),
        _ => {}
    }
    let v = |of: &Vector3<f64>| json!(of.as_slice()[..dimension]);
    let mut body = json!({"name": "wing", "element": element, "elements": 4, "section": section, "material": material,
        "shape": {"line": {"from": v(&Vector3::zeros()), "to": v(&Vector3::x())}}, "markers": {"root": 0, "tip": 1}});
    let [lift, drag, moment] = COEFFICIENTS;
    let mut keys = json!({"chord_direction": v(&CHORD), "chord": 0.3, "span": 0.5, "wind": v(&WIND), "lift": lift, "drag": drag,
        "moment": moment});
    let stands = if dimension == 2 {
        "angle"
    } else {
        "orientation"
    };
    if dimension == 3 {
        body["axis"] = json!([0, 1, 0]);
        keys["lift_direction"] = json!([0, 0, 1]);
    }
    json!({"name": "wing", "dimension": dimension, "bodies": [body],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "wing.root"]}], "loads": [strip("wing.tip", keys)],
        "outputs": [{"kind": "position", "marker": "wing.tip"}, {"kind": stands, "marker": "wing.tip"},
            {"kind": "reaction", "joint": "clamp"}, {"kind": "reaction_moment", "joint": "clamp"}],
        "initial": "static_equilibrium", "accuracy": {"relative_tolerance": 1e-9}})
}

/// Wings on rods, beams and cables that are clamped: the clamp holds the force and the moment that follow from how the section at the tip
/// stands.
#[test]
fn clamps_of_wings_hold_lift_drag_and_moment() {
    for (dimension, element) in [(2, "cable"), (2, "beam"), (3, "rod"), (3, "beam")] {
        let scene = wing(dimension, element);
        let mut run = Run::started(&scene);
        let mut read = |name: &str| {
            let mut found = Vector3::zeros();
            (0..dimension).for_each(|k| found[k] = run.read(&format!("{name}[{}]", k + 1)));
            found
        };
        let (tip, force) = (read("wing.tip.position"), read("clamp.reaction"));
        let along = |run: &mut Run, of: [f64; 3]| {
            let of = Vector3::from(of);
            if dimension == 2 {
                let (sin, cos) = run.read("wing.tip.angle").sin_cos();
                return Vector3::new(cos * of.x - sin * of.y, sin * of.x + cos * of.y, 0.0);
            }
            Vector3::from_fn(|i, _| {
                let axis = |j: usize| run.read(&format!("wing.tip.orientation[{}]", 3 * i + j + 1));
                (0..3)
                    .map(axis)
                    .zip(of.iter())
                    .map(|(axis, of)| axis * of)
                    .sum()
            })
        };
        let chord = along(&mut run, CHORD.normalize().into());
        let up = match dimension {
            2 => Vector3::new(-chord.y, chord.x, 0.0),
            _ => along(&mut run, [0.0, 0.0, 1.0]),
        };
        let (back, across) = (WIND.dot(&chord), WIND.dot(&up));
        let square = back * back + across * across;
        let pressure = 0.5 * DENSITY * 0.15;
        let [lift, drag, moment] = COEFFICIENTS;
        let exerted = pressure
            * square.sqrt()
            * (lift * (up * back - chord * across) + drag * (chord * back + up * across));
        let about = tip.cross(&exerted) - chord.cross(&up) * (pressure * square * 0.3 * moment);
        assert!(
            (force + exerted).norm() < 1e-6 * exerted.norm(),
            "{element} {force} {exerted}"
        );
        let held = match dimension {
            2 => Vector3::z() * run.read("clamp.reaction_moment"),
            _ => Vector3::from_fn(|k, _| run.read(&format!("clamp.reaction_moment[{}]", k + 1))),
        };
        let about = if dimension == 2 {
            Vector3::z() * about.z
        } else {
            about
        };
        assert!(
            (held + about).norm() < 1e-6 * about.norm(),
            "{element} {held} {about}"
        );
        assert!((tip - Vector3::x()).norm() > 1e-3, "it bends: {tip}");
    }
}

/// Half a millisecond of lift while nothing else moves: `m v = rho S U^2 C_l t / 2`, which steps that do not mind the time in a coefficient
/// would miss.
#[test]
fn a_pulse_of_lift_is_not_missed() {
    for (dimension, method) in settings() {
        let v = |x, y| vector(dimension, [x, y]);
        let mut keys = json!({"chord_direction": v(1.0, 0.0), "chord": 0.4, "span": 0.5, "wind": v(10.0, 0.0),
            "lift": "50*(step(t - 0.5) - step(t - 0.5005))"});
        if dimension == 3 {
            keys["lift_direction"] = json!([0, 1, 0]);
        }
        let scene = json!({"name": "pulse", "dimension": dimension,
            "bodies": [{"name": "b", "element": "rigid", "mass": 3.0, "inertia": inertia(dimension, 0.4), "position": v(0.0, 0.0),
                "markers": {"c": v(0.0, 0.0)}}],
            "joints": [{"name": "slide", "kind": "prismatic", "markers": ["ground", "b.c"], "direction": v(0.0, 1.0)}],
            "loads": [strip("b.c", keys)], "outputs": [{"kind": "velocity", "joint": "slide"}],
            "method": {"integrator": method}, "accuracy": {"relative_tolerance": 1e-6}});
        let mut run = Run::started(&scene);
        run.step(1.0);
        let speed = 0.5 * DENSITY * 0.2 * 100.0 * 50.0 * 0.0005 / 3.0;
        is_near(run.read("slide.velocity"), speed, 1e-3 * speed);
    }
}
