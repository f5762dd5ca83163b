//! Rigid bodies in space: how they stand, what their inertia does, what moments and forces do to them.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        standing(),
        lumped(),
        precession(),
        acted("acted", Acted::Loads),
        acted("inputs_started", Acted::Started),
        acted("inputs_set", Acted::Set),
    ]
}

/// The rotation about an axis of the frame that a vector is given in.
pub fn about(k: usize, angle: f64) -> Matrix3<f64> {
    let ((sin, cos), i, j) = (angle.sin_cos(), (k + 1) % 3, (k + 2) % 3);
    let mut turned = Matrix3::identity();
    (turned[(i, i)], turned[(j, j)]) = (cos, cos);
    (turned[(i, j)], turned[(j, i)]) = (-sin, sin);
    turned
}

/// Rodrigues' formula: `cos a + sin a [n] + (1 - cos a) n n^T`.
pub fn rotation(vector: Vector3<f64>) -> Matrix3<f64> {
    let angle = vector.norm();
    let (n, (sin, cos)) = (vector / angle, angle.sin_cos());
    Matrix3::identity() * cos + n.cross_matrix() * sin + n * n.transpose() * (1.0 - cos)
}

/// A rigid body as mechanics sees it.
#[derive(Clone)]
pub struct Body {
    pub name: &'static str,
    pub mass: f64,
    /// Inertia in the axes of the frame.
    pub inertia: Matrix3<f64>,
    /// The axes of the frame as columns.
    pub axes: Matrix3<f64>,
    pub place: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
}

/// Where the marker `p` of every body is, in its frame.
pub const ARM: Vector3<f64> = Vector3::new(0.3, -0.2, 0.5);

impl Body {
    /// A body with these moments of inertia.
    pub fn new(name: &'static str, moments: [f64; 3]) -> Self {
        Self {
            name,
            mass: 1.7,
            inertia: Matrix3::from_diagonal(&moments.into()),
            axes: rotation(Vector3::new(0.4, -0.3, 0.6)),
            place: Vector3::new(0.3, -0.4, 0.8),
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        }
    }

    /// The body in a scene, with an orientation that is described otherwise than by its matrix where one is given.
    pub fn described(&self, orientation: Value) -> Value {
        let rows = |of: &Matrix3<f64>| json!([0, 1, 2].map(|i| [0, 1, 2].map(|j| of[(i, j)])));
        let is_diagonal = self.inertia == Matrix3::from_diagonal(&self.inertia.diagonal());
        let inertia = if is_diagonal {
            json!(array(self.inertia.diagonal()))
        } else {
            rows(&self.inertia)
        };
        let orientation = if orientation.is_null() {
            json!({"matrix": rows(&self.axes)})
        } else {
            orientation
        };
        json!({"element": "rigid", "name": self.name, "mass": self.mass, "inertia": inertia,
               "position": array(self.place), "orientation": orientation,
               "motion": {"velocity": array(self.velocity), "spin": array(self.spin)},
               "markers": {"c": [0.0, 0.0, 0.0], "p": array(ARM)}})
    }

    /// From the centre of mass to the marker `p`.
    pub fn arm(&self) -> Vector3<f64> {
        self.axes * ARM
    }

    /// Inertia in global axes.
    pub fn tensor(&self) -> Matrix3<f64> {
        self.axes * self.inertia * self.axes.transpose()
    }

    /// Returns the moment that keeps the rotation constant: `w x J w`.
    pub fn gyroscopic(&self) -> Vector3<f64> {
        self.spin.cross(&(self.tensor() * self.spin))
    }

    /// Angular acceleration by a moment about the centre of mass (Euler).
    pub fn turning(&self, moment: Vector3<f64>) -> Vector3<f64> {
        let inverse = self.tensor().try_inverse().expect("inertia about all axes");
        inverse * (moment - self.gyroscopic())
    }

    /// Acceleration of what is so far from a point of the body with this acceleration.
    pub fn carried(&self, turning: Vector3<f64>, arm: Vector3<f64>) -> Vector3<f64> {
        turning.cross(&arm) + self.spin.cross(&self.spin.cross(&arm))
    }
}

fn outputs(name: &str, kinds: &[&str]) -> Vec<Value> {
    let output = |kind: &&str| json!({"kind": kind, "marker": format!("{name}.p")});
    kinds.iter().map(output).collect()
}

/// The matrix of an orientation by rows.
fn stands(mut specimen: Specimen, of: &str, axes: &Matrix3<f64>) -> Specimen {
    for (k, entry) in axes.transpose().iter().enumerate() {
        specimen = specimen.claim(&format!("{of}.orientation[{}]", k + 1), "", *entry);
    }
    specimen
}

/// Bodies that stand as each description of an orientation says, one with products of inertia, and that.
fn stood() -> Vec<(Body, Value)> {
    let turned = Vector3::new(0.5, -0.8, 0.3);
    let (cardan, euler) = ([0.4, -0.7, 1.1], [0.6, 0.9, -0.4]);
    let [w, x, y, z] = [1.2, -0.5, 0.8, 0.3];
    let quaternion = {
        let v = Vector3::new(x, y, z);
        let square = w * w + v.norm_squared();
        let matrix = Matrix3::identity() * (w * w - v.norm_squared());
        (matrix + v * v.transpose() * 2.0 + v.cross_matrix() * (2.0 * w)) / square
    };
    let about_three = |[i, j, k]: [usize; 3], angles: [f64; 3]| {
        about(i, angles[0]) * about(j, angles[1]) * about(k, angles[2])
    };
    let stood = [
        (
            "v",
            rotation(turned),
            json!({"rotation_vector": array(turned)}),
        ),
        (
            "d",
            about_three([0, 1, 2], cardan),
            json!({"cardan": cardan}),
        ),
        ("e", about_three([2, 0, 2], euler), json!({"euler": euler})),
        ("q", quaternion, json!({"quaternion": [w, x, y, z]})),
        ("m", rotation(Vector3::new(-0.9, 0.2, 0.7)), Value::Null),
    ];
    let products = Matrix3::new(1.1, 0.2, -0.1, 0.2, 0.9, 0.3, -0.1, 0.3, 1.3);
    let mut bodies = Vec::new();
    for (n, (name, axes, orientation)) in stood.into_iter().enumerate() {
        let shift = n as f64;
        let mut body = Body::new(name, [0.5, 0.8 + 0.05 * shift, 1.0]);
        if name == "m" {
            body.inertia = products;
        }
        body.axes = axes;
        body.place = Vector3::new(3.0 * shift, 0.2 - shift, 0.7);
        body.velocity = Vector3::new(0.3, -0.5, 0.1 * shift);
        body.spin = Vector3::new(0.9, 0.4 - 0.3 * shift, -0.7);
        bodies.push((body, orientation));
    }
    bodies
}

/// Bodies that stand in every way, in free flight.
fn standing() -> Specimen {
    let bodies = stood();
    let gravity = Vector3::new(0.2, 0.5, -9.0);
    let kinds = [
        "orientation",
        "direction",
        "position",
        "velocity",
        "acceleration",
        "angular_velocity",
        "angular_acceleration",
    ];
    let read = (bodies.iter()).flat_map(|(body, _)| outputs(body.name, &kinds));
    let described = (bodies.iter()).map(|(body, orientation)| body.described(orientation.clone()));
    let described: Vec<Value> = described.collect();
    let whole = ["energy", "momentum"].map(|kind| json!({"kind": kind}));
    let scene = json!({"name": "standing", "dimension": 3, "gravity": array(gravity), "bodies": described,
                       "outputs": read.chain(whole).collect::<Vec<_>>()});
    let mut specimen = Specimen::new("standing in space", scene);
    let (mut kinetic, mut momentum, mut angular) = (0.0, Vector3::zeros(), Vector3::zeros());
    for (body, _) in &bodies {
        let p = format!("{}.p", body.name);
        let (arm, turning) = (body.arm(), body.turning(Vector3::zeros()));
        specimen = stands(specimen, &p, &body.axes);
        for (of, unit, value) in [
            ("direction", "", body.axes.column(0).into_owned()),
            ("position", "m", body.place + arm),
            ("velocity", "m/s", body.velocity + body.spin.cross(&arm)),
            ("acceleration", "m/s2", gravity + body.carried(turning, arm)),
            ("angular_velocity", "rad/s", body.spin),
            ("angular_acceleration", "rad/s2", turning),
        ] {
            specimen = vector(specimen, &format!("{p}.{of}"), unit, value);
        }
        let spun = body.tensor() * body.spin;
        kinetic += 0.5 * (body.mass * body.velocity.norm_squared() + body.spin.dot(&spun));
        momentum += body.velocity * body.mass;
        angular += body.place.cross(&body.velocity) * body.mass + spun;
    }
    specimen = vector(specimen, "momentum", "N.s", momentum);
    specimen = vector(specimen, "angular_momentum", "N.m.s", angular);
    specimen.claim("energy.kinetic", "J", kinetic)
}

/// A mass lumped at a marker off the centre of mass: the body has another centre of mass, and inertia about that
/// (parallel axes), `J + m n / (m + n) (r^2 - r r^T)`.
fn lumped() -> Specimen {
    let mut body = Body::new("plate", [0.5, 0.8, 1.0]);
    body.velocity = Vector3::new(0.3, -0.5, 0.4);
    body.spin = Vector3::new(0.9, 0.4, -0.7);
    let (added, gravity) = (0.6, Vector3::new(0.2, 0.5, -9.0));
    let mut bare = body.described(Value::Null);
    bare.as_object_mut().expect("keys").remove("orientation");
    body.axes = Matrix3::identity();
    let scene = json!({"name": "lumped", "dimension": 3, "gravity": array(gravity), "bodies": [bare],
        "masses": [{"marker": "plate.p", "mass": added}],
        "outputs": [{"kind": "acceleration", "marker": "plate.c"}, {"kind": "angular_acceleration", "marker": "plate.c"},
                    {"kind": "energy"}, {"kind": "momentum"}, {"kind": "center_of_mass"}]});
    let (arm, total) = (body.arm(), body.mass + added);
    let shift = arm * (added / total);
    let mut whole = body.clone();
    let square = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
    whole.inertia += square * (body.mass * added / total);
    let turning = whole.turning(Vector3::zeros());
    let mean = body.velocity + body.spin.cross(&shift);
    let spun = whole.tensor() * body.spin;
    let middle = body.place + shift;
    let mut specimen = Specimen::new("lumped in space", scene);
    for (of, unit, value) in [
        (
            "plate.c.acceleration",
            "m/s2",
            gravity + body.carried(turning, -shift),
        ),
        ("plate.c.angular_acceleration", "rad/s2", turning),
        ("momentum", "N.s", mean * total),
        (
            "angular_momentum",
            "N.m.s",
            middle.cross(&mean) * total + spun,
        ),
        ("center_of_mass", "m", middle),
    ] {
        specimen = vector(specimen, of, unit, value);
    }
    let kinetic = 0.5 * (total * mean.norm_squared() + body.spin.dot(&spun));
    specimen.claim("energy.kinetic", "J", kinetic).claim(
        "energy.gravity",
        "J",
        -total * gravity.dot(&middle),
    )
}

/// A free body with an axis of symmetry: it rotates about its angular momentum `L` at the rate `L / a`, and about its own
/// axis at `w3 (a - c) / a` beside, with the moments `a, a, c` (Poinsot).
fn precession() -> Specimen {
    let (a, c, t) = (0.6, 1.0, 0.7);
    let mut body = Body::new("top", [a, a, c]);
    let own = Vector3::new(1.5, 0.0, 4.0);
    body.spin = body.axes * own;
    let momentum = body.tensor() * body.spin;
    let scene = json!({"name": "precession", "dimension": 3, "bodies": [body.described(Value::Null)],
        "accuracy": {"relative_tolerance": 1e-10},
        "outputs": [{"kind": "orientation", "marker": "top.p"}, {"kind": "angular_velocity", "marker": "top.p"},
                    {"kind": "momentum"}, {"kind": "energy"}]});
    let beside = about(2, own[2] * (a - c) / a * t);
    let axes = rotation(momentum * (t / a)) * body.axes * beside;
    // The part of the spin across the axis of symmetry rotates against the body.
    let spin = axes * beside.transpose() * own;
    let energy = 0.5 * momentum.dot(&body.spin);
    let mut specimen = vector(
        Specimen::new("precession", scene),
        "angular_momentum",
        "N.m.s",
        momentum,
    )
    .at(t);
    for (k, entry) in axes.transpose().iter().enumerate() {
        specimen =
            specimen.claim_within(&format!("top.p.orientation[{}]", k + 1), "", *entry, 1e-7);
    }
    for k in 0..3 {
        specimen = specimen
            .claim_within(
                &format!("top.p.angular_velocity[{}]", k + 1),
                "rad/s",
                spin[k],
                1e-6,
            )
            .claim_within(
                &format!("angular_momentum[{}]", k + 1),
                "N.m.s",
                momentum[k],
                1e-7,
            );
    }
    specimen.claim_within("energy.kinetic", "J", energy, 1e-7)
}

/// By what bodies are pushed.
#[derive(Clone, Copy, PartialEq)]
enum Acted {
    /// Loads of the scene.
    Loads,
    /// Inputs by their start values.
    Started,
    /// Inputs that the master sets before the start.
    Set,
}

/// Angular acceleration of a body, and acceleration of its marker `p`, where a force acts or a moment.
fn moved_by(pushed: Vector3<f64>, is_force: bool, body: &Body) -> [Vector3<f64>; 2] {
    let (moment, push) = if is_force {
        (body.arm().cross(&pushed), pushed / body.mass)
    } else {
        (pushed, Vector3::zeros())
    };
    let turning = body.turning(moment);
    [turning, push + body.carried(turning, body.arm())]
}

/// A moment in global axes, one in those of the body, and a force in those of the body at a point of it, on bodies that
/// rotate.
fn acted(name: &'static str, by: Acted) -> Specimen {
    let acting = [
        ("moment", false, "moment", Vector3::new(0.7, -1.1, 0.4)),
        (
            "moment",
            true,
            "follower_moment",
            Vector3::new(-0.6, 0.9, 1.3),
        ),
        (
            "force",
            true,
            "follower_force",
            Vector3::new(1.4, -0.8, 2.1),
        ),
        ("force", false, "force", Vector3::new(0.9, 1.5, -1.2)),
    ];
    let (mut bodies, mut parts, mut read) = (Vec::new(), Vec::new(), Vec::new());
    let mut claims: Vec<(String, &str, Vector3<f64>)> = Vec::new();
    let mut settings = Vec::new();
    for ((kind, follower, word, value), name) in acting.into_iter().zip(["a", "b", "d", "e"]) {
        let mut body = Body::new(name, [0.5, 0.8, 1.0]);
        body.spin = Vector3::new(0.9, 0.4, -0.7);
        body.velocity = Vector3::new(0.1, 0.2, -0.3);
        let mut part = json!({"kind": kind, "marker": format!("{name}.p")});
        if follower {
            part["follower"] = json!(true);
        }
        match by {
            Acted::Loads => {
                part["name"] = json!(format!("on_{name}"));
                part["value"] = json!([value[0], format!("{}+0.3*t", value[1]), value[2]]);
            }
            Acted::Started => part["start"] = json!(array(value)),
            Acted::Set => settings.push((format!("{name}.p.{word}"), value)),
        }
        let pushed = if follower { body.axes * value } else { value };
        let [turning, at] = moved_by(pushed, kind == "force", &body);
        claims.push((format!("{name}.p.angular_acceleration"), "rad/s2", turning));
        claims.push((format!("{name}.p.acceleration"), "m/s2", at));
        read.extend(outputs(name, &["acceleration", "angular_acceleration"]));
        bodies.push(body.described(Value::Null));
        parts.push(part);
    }
    let list = if by == Acted::Loads {
        "loads"
    } else {
        "inputs"
    };
    let scene =
        json!({"name": name, "dimension": 3, "bodies": bodies, list: parts, "outputs": read});
    let mut specimen = Specimen::new(name, scene);
    for (of, value) in settings {
        for k in 0..3 {
            specimen = specimen.set(&format!("{of}[{}]", k + 1), value[k]);
        }
    }
    for (of, unit, value) in claims {
        specimen = vector(specimen, &of, unit, value);
    }
    specimen
}
