//! Airfoils on rigid bodies in free flight: accelerations at the start tell force and moment, key by key.

use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::claims::specimen::Specimen;

type V = Vector3<f64>;

/// Time of the start, s.
const T: f64 = 0.3;
const MASS: f64 = 1.6;
/// Moments of inertia about the axes, kg m^2; in the plane the third.
const INERTIA: [f64; 3] = [0.2, 0.3, 0.4];

pub fn all() -> Vec<Specimen> {
    vec![planar(), in_time(), inputs(), spatial(), along()]
}

/// Airfoil as its equations know it.
#[derive(Clone)]
struct Strip {
    place: V,
    chord_direction: V,
    lift_direction: V,
    chord: f64,
    span: f64,
    density: f64,
    wind: V,
    /// Coefficients of lift, drag and moment by angle and reduced rate.
    coefficients: fn(f64, f64) -> [f64; 3],
}

fn strip() -> Strip {
    Strip {
        place: V::new(0.3, -0.2, 0.0),
        chord_direction: V::new(0.8, -0.6, 0.0),
        lift_direction: V::new(0.6, 0.8, 0.0),
        chord: 0.5,
        span: 0.8,
        density: 1.3,
        wind: V::new(4.0, 1.5, 0.0),
        coefficients: |a, q| [3.0 * a + 0.4 * q, 0.1 + a * a, -0.2],
    }
}

fn keys() -> Value {
    json!({"marker": "p", "chord_direction": [1.6, -1.2], "chord": 0.5, "span": 0.8, "density": 1.3, "wind": [4.0, 1.5],
           "lift": "3*a+0.4*q", "drag": "0.1+a^2", "moment": -0.2})
}

const SPEED: [f64; 3] = [0.5, -0.3, 0.0];
const SPIN: f64 = 0.7;

impl Strip {
    /// Acceleration of the centre and the angular one of a body with this velocity and spin.
    fn accelerations(&self, speed: V, spin: V) -> [V; 2] {
        let (d, n) = (self.chord_direction, self.lift_direction);
        let past = self.wind - speed - spin.cross(&(self.place + 0.5 * self.chord * d));
        let (along, across) = (past.dot(&d), past.dot(&n));
        let square = along * along + across * across;
        let rate = 0.5 * self.chord * -spin.cross(&d).dot(&n) / square.sqrt();
        let [lift, drag, moment] = (self.coefficients)(across.atan2(along), rate);
        let faced = 0.5 * self.density * self.chord * self.span;
        let lifted = lift * (n * along - d * across) + drag * (d * along + n * across);
        let force = faced * square.sqrt() * lifted;
        let nose_up = -d.cross(&n) * faced * square * self.chord * moment;
        let about = self.place.cross(&force) + nose_up;
        let inertia = V::from(INERTIA);
        let gyroscopic = spin.cross(&inertia.component_mul(&spin));
        [force / MASS, (about - gyroscopic).component_div(&inertia)]
    }
}

type Row = (&'static str, Value, Strip);

fn with(key: &str, value: Value) -> Value {
    let mut keys = keys();
    keys[key] = value;
    keys
}

fn without(key: &str) -> Value {
    let mut keys = keys();
    keys.as_object_mut().expect("keys").remove(key);
    keys
}

fn changed(name: &'static str, keys: Value, change: fn(&mut Strip)) -> Row {
    let mut strip = strip();
    change(&mut strip);
    (name, keys, strip)
}

fn scene(name: &str, rows: &[Row]) -> Value {
    let bodies = rows.iter().map(|(name, ..)| {
        json!({"element": "rigid", "name": name, "mass": MASS, "inertia": INERTIA[2], "position": [0.0, 0.0],
               "motion": {"velocity": [SPEED[0], SPEED[1]], "spin": SPIN},
               "markers": {"c": [0.0, 0.0], "p": [0.3, -0.2], "o": [-0.1, 0.4]}})
    });
    let loads = rows.iter().map(|(name, keys, _)| {
        let mut load = keys.clone();
        load["name"] = json!(format!("on_{name}"));
        load["kind"] = json!("airfoil");
        load["marker"] = json!(format!(
            "{name}.{}",
            keys["marker"].as_str().expect("a marker")
        ));
        load
    });
    let outputs = rows.iter().flat_map(|(name, ..)| {
        let marker = format!("{name}.c");
        [
            json!({"kind": "acceleration", "marker": marker}),
            json!({"kind": "angular_acceleration", "marker": marker}),
        ]
    });
    json!({"name": name, "dimension": 2, "bodies": bodies.collect::<Vec<_>>(), "loads": loads.collect::<Vec<_>>(),
           "outputs": outputs.collect::<Vec<_>>()})
}

fn claimed(mut specimen: Specimen, rows: &[Row]) -> Specimen {
    for (name, _, strip) in rows {
        let [linear, angular] = strip.accelerations(SPEED.into(), V::z() * SPIN);
        specimen = specimen
            .vector(
                &format!("{name}.c.acceleration"),
                "m/s2",
                [linear.x, linear.y],
            )
            .claim(
                &format!("{name}.c.angular_acceleration"),
                "rad/s2",
                angular.z,
            );
    }
    specimen
}

/// Every key changed, and each left out that may be.
fn planar() -> Specimen {
    let listed = |points: Value| json!({"table": points});
    let rows = [
        changed("all", keys(), |_| ()),
        changed("elsewhere", with("marker", json!("o")), |s| {
            s.place = V::new(-0.1, 0.4, 0.0);
        }),
        changed("back", with("chord_direction", json!([0.0, 1.0])), |s| {
            (s.chord_direction, s.lift_direction) = (V::y(), -V::x());
        }),
        changed("wide", with("chord", json!(0.9)), |s| s.chord = 0.9),
        changed("forward", with("ahead", json!(0.2)), |s| {
            s.place -= 0.2 * s.chord * s.chord_direction;
        }),
        changed("long", with("span", json!(2.1)), |s| s.span = 2.1),
        changed("thin", with("density", json!(0.4)), |s| s.density = 0.4),
        changed("still", without("wind"), |s| s.wind = V::zeros()),
        changed("slippery", without("drag"), |s| {
            s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.0, -0.2];
        }),
        changed("even", without("moment"), |s| {
            s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.1 + a * a, 0.0];
        }),
        changed("numbers", with("lift", json!(0.7)), |s| {
            s.coefficients = |a, _| [0.7, 0.1 + a * a, -0.2];
        }),
        changed(
            "lists",
            with("lift", listed(json!([[-1.0, -0.5], [3.0, 7.5]]))),
            |s| {
                s.coefficients = |a, _| [2.0 * a + 1.5, 0.1 + a * a, -0.2];
            },
        ),
        changed(
            "dragged",
            with("drag", listed(json!([[-1.0, 0.5], [3.0, 2.5]]))),
            |s| {
                s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.5 * a + 1.0, -0.2];
            },
        ),
        changed("dragging", with("drag", json!(0.6)), |s| {
            s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.6, -0.2];
        }),
        changed("pitched", with("moment", json!("0.3*a-2*q")), |s| {
            s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.1 + a * a, 0.3 * a - 2.0 * q];
        }),
        changed(
            "nosed",
            with("moment", listed(json!([[-1.0, -0.5], [3.0, 1.5]]))),
            |s| {
                s.coefficients = |a, q| [3.0 * a + 0.4 * q, 0.1 + a * a, 0.5 * a];
            },
        ),
    ];
    let specimen = Specimen::new("airfoils", scene("airfoils", &rows));
    let total = 0.5 * MASS * (0.25 + 0.09) + 0.5 * INERTIA[2] * SPIN * SPIN;
    let mut specimen = claimed(specimen, &rows);
    let outputs = specimen.scene["outputs"].as_array_mut().expect("outputs");
    outputs.push(json!({"kind": "load_force", "load": "on_all"}));
    outputs.push(json!({"kind": "energy"}));
    let [linear, _] = strip().accelerations(SPEED.into(), V::z() * SPIN);
    let force = linear * MASS;
    specimen
        .vector("on_all.force", "N", [force.x, force.y])
        .claim("energy.kinetic", "J", 16.0 * total)
}

/// Winds and coefficients that change in time.
fn in_time() -> Specimen {
    let listed = json!({"table": [[0.1, 1.2], [0.9, 2.8]]});
    let rows = [
        changed(
            "swung",
            with("wind", json!(["1.3*t+2", "-0.7*cos(t)"])),
            |s| {
                s.wind = V::new(1.3 * T + 2.0, -0.7 * T.cos(), 0.0);
            },
        ),
        changed("listed", with("wind", json!([listed, 0.4])), |s| {
            s.wind = V::new(1.6, 0.4, 0.0);
        }),
        changed("flapped", with("lift", json!("3*a+2*t")), |s| {
            s.coefficients = |a, _| [3.0 * a + 2.0 * T, 0.1 + a * a, -0.2];
        }),
    ];
    let specimen = Specimen::new("airfoils_in_time", scene("airfoils_in_time", &rows));
    claimed(specimen.from(T), &rows)
}

/// Winds that the master sets: with a start of their own, with that of the airfoil, later.
fn inputs() -> Specimen {
    let rows = [
        changed("started", keys(), |s| s.wind = V::new(0.2, -0.9, 0.0)),
        changed("given", keys(), |_| ()),
        changed("set", without("wind"), |s| s.wind = V::new(-0.4, 0.8, 0.0)),
    ];
    let mut scene = scene("airfoil_inputs", &rows);
    let input = |of: &str| json!({"kind": "current", "load": format!("on_{of}")});
    let mut inputs = ["started", "given", "set"].map(input);
    inputs[0]["start"] = json!([0.2, -0.9]);
    scene["inputs"] = json!(inputs);
    let specimen = Specimen::new("airfoil_inputs", scene)
        .set("on_set.current[1]", -0.4)
        .set("on_set.current[2]", 0.8);
    claimed(specimen, &rows)
        .vector("on_started.current", "m/s", [0.2, -0.9])
        .vector("on_given.current", "m/s", [4.0, 1.5])
}

/// Length of the bars, m.
const LENGTH: f64 = 2.0;
/// Mass of the bars, kg.
const BAR: f64 = 3.0;

/// A bar with an airfoil all along it.
struct Wing {
    keys: Value,
    /// Wind, chord, centre ahead of the line over the chord, and coefficients, by place.
    wind: fn(f64) -> V,
    chord: fn(f64) -> f64,
    ahead: fn(f64) -> f64,
    coefficients: fn(f64, f64, f64) -> [f64; 3],
}

impl Wing {
    /// Acceleration of the middle and the angular one: the sum of many strips.
    fn accelerations(&self) -> [V; 2] {
        const STRIPS: usize = 400;
        let inertia = BAR * LENGTH * LENGTH / 12.0;
        let mut sums = [V::zeros(); 2];
        // Gauss's rule of two points in each, of fourth order.
        for (k, side) in (0..STRIPS).flat_map(|k| [-1.0, 1.0].map(|side| (k, side))) {
            let s = (k as f64 + 0.5 + 0.5 * side / 3.0_f64.sqrt()) / STRIPS as f64;
            let (d, n) = (V::new(0.8, -0.6, 0.0), V::new(0.6, 0.8, 0.0));
            let (chord, place) = ((self.chord)(s), V::x() * ((s - 0.5) * LENGTH));
            let place = place - d * ((self.ahead)(s) * chord);
            let past =
                (self.wind)(s) - V::from(SPEED) - (V::z() * SPIN).cross(&(place + 0.5 * chord * d));
            let (along, across) = (past.dot(&d), past.dot(&n));
            let speed = along.hypot(across);
            let rate = -0.5 * chord * SPIN / speed;
            let [lift, drag, moment] = (self.coefficients)(across.atan2(along), rate, s);
            let faced = 0.5 * 1.3 * chord * LENGTH / (2 * STRIPS) as f64;
            let lifted = lift * (n * along - d * across) + drag * (d * along + n * across);
            let force = faced * speed * lifted;
            let nose_up = -V::z() * (faced * speed * speed * chord * moment);
            sums[0] += force / BAR;
            sums[1] += (place.cross(&force) + nose_up) / inertia;
        }
        sums
    }
}

/// Bars that fly, with these airfoils.
fn bars(wings: &[(&str, Wing)]) -> Value {
    let bodies = wings.iter().map(|(name, _)| {
        json!({"element": "cable", "model": "rigid", "name": name, "material": {"youngs_modulus": 1e11, "density": 1500},
               "section": {"area": 1e-3, "second_moment": 1e-8}, "shape": {"line": {"from": [-1, 0], "to": [1, 0]}},
               "motion": {"velocity": [SPEED[0], SPEED[1] - SPIN], "spin": SPIN}, "markers": {"c": 0.5}})
    });
    let loads = wings.iter().map(|(name, wing)| {
        let mut load = wing.keys.clone();
        load["name"] = json!(format!("on_{name}"));
        load["kind"] = json!("airfoil");
        load["body"] = json!(name);
        load
    });
    let mut outputs = vec![json!({"kind": "load_force", "load": "on_tapered"})];
    for (name, _) in wings {
        let marker = format!("{name}.c");
        outputs.push(json!({"kind": "acceleration", "marker": marker}));
        outputs.push(json!({"kind": "angular_acceleration", "marker": marker}));
    }
    json!({"name": "wings", "dimension": 2, "bodies": bodies.collect::<Vec<_>>(), "loads": loads.collect::<Vec<_>>(), "outputs": outputs})
}

/// Along rigid bars, with what changes along them and what does not.
fn along() -> Specimen {
    let keys = |changes: Value| {
        let mut keys = keys();
        keys.as_object_mut().expect("keys").remove("marker");
        keys.as_object_mut().expect("keys").remove("span");
        for (key, value) in changes.as_object().expect("changes") {
            keys[key] = value.clone();
        }
        keys
    };
    let even = Wing {
        keys: keys(json!({})),
        wind: |_| V::new(4.0, 1.5, 0.0),
        chord: |_| 0.5,
        ahead: |_| 0.0,
        coefficients: |a, q, _| [3.0 * a + 0.4 * q, 0.1 + a * a, -0.2],
    };
    let listed = |points: Value| json!({"table": points});
    let wings = [
        (
            "tapered",
            Wing {
                keys: keys(json!({"chord": "0.5-0.3*s"})),
                chord: |s| 0.5 - 0.3 * s,
                ..even
            },
        ),
        (
            "listed",
            Wing {
                keys: keys(
                    json!({"chord": listed(json!([[0, 0.2], [1, 0.6]])), "ahead": listed(json!([[0, 0.1], [1, 0.3]]))}),
                ),
                chord: |s| 0.2 + 0.4 * s,
                ahead: |s| 0.1 + 0.2 * s,
                ..even
            },
        ),
        (
            "swept",
            Wing {
                keys: keys(json!({"ahead": "0.4*s-0.1"})),
                ahead: |s| 0.4 * s - 0.1,
                ..even
            },
        ),
        (
            "sheared",
            Wing {
                keys: keys(json!({"wind": ["4+s", "1.5*t*s"]})),
                wind: |s| V::new(4.0 + s, 0.0, 0.0),
                ..even
            },
        ),
        (
            "changed",
            Wing {
                keys: keys(json!({"lift": "3*a*s+0.4*q", "drag": "0.1+s", "moment": "-0.2*s"})),
                coefficients: |a, q, s| [3.0 * a * s + 0.4 * q, 0.1 + s, -0.2 * s],
                ..even
            },
        ),
        ("even", even),
    ];
    let mut specimen = Specimen::new("wings", bars(&wings));
    let force = wings[0].1.accelerations()[0] * BAR;
    specimen = specimen.vector("on_tapered.force", "N", [force.x, force.y]);
    for (name, wing) in wings {
        let [linear, angular] = wing.accelerations();
        let at = |key: &str| format!("{name}.c.{key}");
        specimen = specimen
            .vector(&at("acceleration"), "m/s2", [linear.x, linear.y])
            .claim(&at("angular_acceleration"), "rad/s2", angular.z);
    }
    specimen
}

/// In space, with an inclined direction of lift.
fn spatial() -> Specimen {
    let (speed, spin) = (V::new(0.5, -0.3, 0.2), V::new(0.4, -0.2, 0.3));
    let place = V::new(0.3, -0.2, 0.1);
    let wind = V::new(4.0, 1.5, -2.0);
    let bodies = ["a", "b"].map(|name| {
        json!({"element": "rigid", "name": name, "mass": MASS, "inertia": INERTIA, "position": [0, 0, 0],
               "motion": {"velocity": speed.as_slice(), "spin": spin.as_slice()},
               "markers": {"c": [0, 0, 0], "p": place.as_slice()}})
    });
    let load = |name: &str, lift: [f64; 3]| {
        let mut load = keys();
        load["name"] = json!(format!("on_{name}"));
        load["kind"] = json!("airfoil");
        load["marker"] = json!(format!("{name}.p"));
        load["chord_direction"] = json!([0.0, -1.5, 0.0]);
        load["lift_direction"] = json!(lift);
        load["wind"] = json!(wind.as_slice());
        load
    };
    let lifts = [[0.3, 0.2, 1.0], [-1.0, 0.0, 0.0]];
    let outputs = ["a", "b"].map(|name| {
        let marker = format!("{name}.c");
        [
            json!({"kind": "acceleration", "marker": marker}),
            json!({"kind": "angular_acceleration", "marker": marker}),
        ]
    });
    let scene = json!({"name": "airfoils_in_space", "dimension": 3, "bodies": bodies,
        "loads": [load("a", lifts[0]), load("b", lifts[1])], "outputs": outputs.concat()});
    let mut specimen = Specimen::new("airfoils_in_space", scene);
    for (name, lift) in ["a", "b"].into_iter().zip([V::new(0.3, 0.0, 1.0), -V::x()]) {
        let of = Strip {
            place,
            chord_direction: -V::y(),
            lift_direction: lift.normalize(),
            wind,
            ..strip()
        };
        let [linear, angular] = of.accelerations(speed, spin);
        for k in 0..3 {
            let of = |key: &str| format!("{name}.c.{key}[{}]", k + 1);
            specimen = specimen
                .claim(&of("acceleration"), "m/s2", linear[k])
                .claim(&of("angular_acceleration"), "rad/s2", angular[k]);
        }
    }
    specimen
}
