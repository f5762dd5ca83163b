//! Bushings with stiffnesses and dampings along and about three axes.

use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

use super::space::vector;
use super::space_joints::body;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        modes("bushing", Some([3.0, 5.0, 8.0]), Some([4.0, 20.0, 41.0])),
        modes("bushing along", Some([0.1, 0.2, 0.3]), None),
        modes("bushing about", None, Some([0.01, 0.02, 0.04])),
        dampers("dampers along", true),
        dampers("dampers about", false),
    ]
}

/// Small motions of a body on a bushing: `sqrt(k / m)` along the axes of the ground, and about those of a body in them.
fn modes(name: &'static str, along: Option<[f64; 3]>, about: Option<[f64; 3]>) -> Specimen {
    let mut block = body("block");
    block.axes = Matrix3::identity();
    let mut mount = json!({"name": "mount", "kind": "bushing", "markers": ["ground", "block.c"]});
    let mut frequencies = Vec::new();
    let sizes = [
        (
            "translational_stiffness",
            along,
            Vector3::repeat(block.mass),
        ),
        ("rotational_stiffness", about, block.inertia.diagonal()),
    ];
    for (key, given, inertia) in sizes {
        if let Some(given) = given {
            mount[key] = json!(given);
            frequencies.extend(
                given
                    .iter()
                    .zip(inertia.iter())
                    .map(|(k, m)| (k / m).sqrt()),
            );
        }
    }
    frequencies.sort_by(f64::total_cmp);
    let scene = json!({"name": "mounted", "dimension": 3, "bodies": [block.described(Value::Null)], "loads": [mount],
        "outputs": [{"kind": "natural_frequency", "count": 6}]});
    let mut specimen = Specimen::new(name, scene);
    // Those without stiffness are zero and come first.
    let free = 6 - frequencies.len();
    for (k, value) in frequencies.into_iter().enumerate() {
        let of = format!("natural_frequency[{}]", free + k + 1);
        specimen = specimen.claim(&of, "rad/s", value);
    }
    specimen
}

/// Dampers along and about the axes of a body that stands obliquely: of what another moves past it.
fn dampers(name: &'static str, is_along: bool) -> Specimen {
    let ([first, mut second], along, about) =
        (["u", "v"].map(body), [0.3, 0.5, 0.8], [0.4, 0.2, 0.7]);
    second.velocity = Vector3::new(0.7, -0.2, 0.5);
    second.spin = Vector3::new(0.9, 0.4, -0.7);
    let outputs = ["u.c", "v.c"].map(|marker| {
        ["acceleration", "angular_acceleration"].map(|kind| json!({"kind": kind, "marker": marker}))
    });
    let mut outputs = outputs.concat();
    let mut mount = json!({"name": "mount", "kind": "bushing", "markers": ["u.c", "v.c"]});
    let (along, about) = if is_along {
        mount["translational_damping"] = json!(along);
        outputs.push(json!({"kind": "load_force", "load": "mount"}));
        (along, [0.0; 3])
    } else {
        mount["rotational_damping"] = json!(about);
        outputs.push(json!({"kind": "load_moment", "load": "mount"}));
        ([0.0; 3], about)
    };
    let scene = json!({"name": "damped", "dimension": 3, "bodies": [first.described(Value::Null), second.described(Value::Null)],
        "loads": [mount], "outputs": outputs});
    let damping =
        |of: [f64; 3]| first.axes * Matrix3::from_diagonal(&of.into()) * first.axes.transpose();
    let force = -damping(along) * second.velocity;
    // Forces stand at one point: none rotates the bodies.
    let moment = -damping(about) * second.spin;
    let mut specimen = Specimen::new(name, scene);
    specimen = if is_along {
        vector(specimen, "mount.force", "N", force)
    } else {
        vector(specimen, "mount.moment", "N.m", moment)
    };
    for (body, sign) in [(&first, -1.0), (&second, 1.0)] {
        let name = body.name;
        let a = force * (sign / body.mass);
        specimen = vector(specimen, &format!("{name}.c.acceleration"), "m/s2", a);
        let turning = body.turning(moment * sign);
        specimen = vector(
            specimen,
            &format!("{name}.c.angular_acceleration"),
            "rad/s2",
            turning,
        );
    }
    specimen
}
