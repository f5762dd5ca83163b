//! Contacts of markers and of bodies with surfaces of the ground and of rigid bodies: forces from depth, its rate and the slip along the surface.

use nalgebra::{Rotation3, Vector3};
use serde_json::{Value, json};

use super::space::{array, vector};
use super::{cross, dot, extra, resting, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        on_a_plane(),
        on_a_circle(),
        that_sticks(),
        in_space(),
        on_a_moving_body(),
        on_a_moving_body_in_space(),
        along_a_cable_on_a_moving_body(),
        along_a_rigid_body(),
        along_a_cable(),
        along_a_rod(),
        sections_of_a_rigid_body(),
        sections_of_a_beam(),
        at_rest(),
        at_rest_on_a_body(),
    ]
}

const STIFFNESS: f64 = 700.0;
const DAMPING: f64 = 0.6;
const FRICTION: f64 = 0.45;
const SLIP: f64 = 0.8;
const MASS: f64 = 1.6;
const INERTIA: f64 = 0.4;
const ANGLE: f64 = 0.5;

fn norm(a: [f64; 2]) -> f64 {
    dot(a, a).sqrt()
}

/// Force at a depth under the surface with this unit normal of a point with this velocity.
fn force(depth: f64, normal: [f64; 2], velocity: [f64; 2]) -> [f64; 2] {
    let out = dot(normal, velocity);
    let push = STIFFNESS * depth * (1.0 - DAMPING * out);
    let slip = sum(velocity, times(-out, normal));
    let rub = FRICTION * push / norm([norm(slip), SLIP]);
    sum(times(push, normal), times(-rub, slip))
}

fn body(name: &str, place: [f64; 2], velocity: [f64; 2], spin: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": MASS, "inertia": INERTIA, "position": place, "angle": ANGLE,
           "motion": {"velocity": velocity, "spin": spin}, "markers": {"c": [0.0, 0.0], "p": [0.5, -0.2]}})
}

fn contact(name: &str, marker: &str, surface: &Value) -> Value {
    json!({"name": name, "kind": "contact", "marker": marker, "surface": surface, "stiffness": STIFFNESS,
           "damping": DAMPING, "friction": FRICTION, "slip_velocity": SLIP})
}

/// A body that touches with its marker at an arm, with what it is accelerated by.
fn pushed(specimen: Specimen, name: &str, force: [f64; 2]) -> Specimen {
    let arm = turned(ANGLE, [0.5, -0.2]);
    specimen
        .vector(
            &format!("{name}.c.acceleration"),
            "m/s2",
            times(1.0 / MASS, force),
        )
        .claim(
            &format!("{name}.c.angular_acceleration"),
            "rad/s2",
            cross(arm, force) / INERTIA,
        )
}

fn read(names: &[&str]) -> Vec<Value> {
    let both = |name: &&str| {
        [
            json!({"kind": "acceleration", "marker": format!("{name}.c")}),
            json!({"kind": "angular_acceleration", "marker": format!("{name}.c")}),
        ]
    };
    let energy = [json!({"kind": "energy"})];
    names.iter().flat_map(both).chain(energy).collect()
}

/// One goes deeper, one leaves, one leaves too fast to be pushed, one is above.
fn on_a_plane() -> Specimen {
    let (normal, point) = ([0.28, 0.96], [0.7, -1.1]);
    let arm = turned(ANGLE, [0.5, -0.2]);
    let along = [0.96, -0.28];
    let place = |way: f64, depth: f64| {
        let at = sum(point, sum(times(way, along), times(-depth, normal)));
        sum(at, times(-1.0, arm))
    };
    let spin = 0.9;
    let at_marker = |velocity| sum(velocity, times(spin, [-arm[1], arm[0]]));
    let (deeper, leaving, fast) = ([0.7, -0.9], [-0.4, 0.5], [0.3, 2.6]);
    let surface = json!({"plane": {"point": point, "normal": times(2.5, normal)}});
    let mut outputs = read(&["a", "b", "c", "d"]);
    outputs.push(json!({"kind": "load_force", "load": "of_b"}));
    let scene = json!({"name": "plane", "dimension": 2,
        "bodies": [body("a", place(0.0, 0.03), deeper, spin), body("b", place(1.0, 0.05), leaving, spin),
                   body("c", place(2.0, 0.02), fast, spin), body("d", place(3.0, -0.01), deeper, spin), extra()],
        "loads": [contact("of_a", "a.p", &surface), contact("of_b", "b.p", &surface),
                  contact("of_c", "c.p", &surface), contact("of_d", "d.p", &surface)],
        "outputs": outputs});
    let mut specimen = Specimen::new("on a plane", scene);
    specimen = pushed(specimen, "a", force(0.03, normal, at_marker(deeper)));
    specimen = pushed(specimen, "b", force(0.05, normal, at_marker(leaving)));
    specimen = pushed(specimen, "c", [0.0; 2]);
    specimen = pushed(specimen, "d", [0.0; 2]);
    let depths = 0.03 * 0.03 + 0.05 * 0.05 + 0.02 * 0.02;
    specimen = specimen.vector("of_b.force", "N", force(0.05, normal, at_marker(leaving)));
    specimen.claim("energy.spring", "J", 0.5 * STIFFNESS * depths)
}

/// The normal is along the way from the centre; without damping and friction there is a push alone.
fn on_a_circle() -> Specimen {
    let (center, radius) = ([0.4, 0.3], 1.3);
    let arm = turned(ANGLE, [0.5, -0.2]);
    let place = |normal: [f64; 2], depth: f64| {
        let at = sum(center, times(radius - depth, normal));
        sum(at, times(-1.0, arm))
    };
    let (first, second) = ([0.6, 0.8], [-0.8, 0.6]);
    let (velocity, spin) = ([-0.3, -0.5], -0.7);
    let at_marker = sum(velocity, times(spin, [-arm[1], arm[0]]));
    let surface = json!({"circle": {"center": center, "radius": radius}});
    let scene = json!({"name": "circle", "dimension": 2,
        "bodies": [body("a", place(first, 0.04), velocity, spin), body("b", place(second, 0.07), velocity, spin), extra()],
        "loads": [contact("of_a", "a.p", &surface),
                  {"name": "of_b", "kind": "contact", "marker": "b.p", "surface": surface, "stiffness": STIFFNESS}],
        "outputs": read(&["a", "b"])});
    let mut specimen = Specimen::new("on a circle", scene);
    specimen = pushed(specimen, "a", force(0.04, first, at_marker));
    specimen = pushed(specimen, "b", times(STIFFNESS * 0.07, second));
    let depths = 0.04 * 0.04 + 0.07 * 0.07;
    specimen.claim("energy.spring", "J", 0.5 * STIFFNESS * depths)
}

/// Markers that may stick to a plane. A slow one does: the spring along the surface begins with the friction that there is, and its damper
/// acts beside it. A fast one slides, with the whole friction.
fn that_sticks() -> Specimen {
    const ALONG: f64 = 900.0;
    const DAMPER: f64 = 7.0;
    let (normal, point) = ([0.28, 0.96], [0.7, -1.1]);
    let along = [0.96, -0.28];
    let arm = turned(ANGLE, [0.5, -0.2]);
    let depth = 0.04;
    let place = |way: f64| {
        let at = sum(point, sum(times(way, along), times(-depth, normal)));
        sum(at, times(-1.0, arm))
    };
    let (slow, fast) = (0.5 * SLIP, -3.0 * SLIP);
    let surface = json!({"plane": {"point": point, "normal": normal}});
    let on = |name: &str, marker: &str| {
        let mut load = contact(name, marker, &surface);
        load["tangential_stiffness"] = json!(ALONG);
        load["tangential_damping"] = json!(DAMPER);
        load["static_ratio"] = json!(1.3);
        load
    };
    let scene = json!({"name": "that_sticks", "dimension": 2,
        "bodies": [body("a", place(0.0), times(slow, along), 0.0), body("b", place(1.0), times(fast, along), 0.0), extra()],
        "loads": [on("of_a", "a.p"), on("of_b", "b.p")],
        "outputs": read(&["a", "b"])});
    let push = STIFFNESS * depth;
    let rub = FRICTION * push * slow / norm([slow, SLIP]);
    let force = |friction: f64| sum(times(push, normal), times(-friction, along));
    let mut specimen = Specimen::new("that sticks", scene);
    specimen = pushed(specimen, "a", force(rub + DAMPER * slow));
    specimen = pushed(specimen, "b", force(-FRICTION * push));
    let stored = STIFFNESS * depth * depth + 0.5 * rub * rub / ALONG;
    specimen.claim("energy.spring", "J", stored)
}

/// Particles on a plane, a sphere and a cylinder.
fn in_space() -> Specimen {
    let normal = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    let (point, center) = (Vector3::new(0.3, 0.2, -0.5), Vector3::new(4.0, 1.0, 0.5));
    let (foot, radius) = (Vector3::new(-3.0, 0.5, 1.0), 0.9);
    let axis = Vector3::new(0.6, 0.8, 0.0);
    let across = Vector3::new(0.48, -0.36, 0.8);
    let velocity = Vector3::new(0.5, -0.8, -0.6);
    let particle = |name: &str, place: Vector3<f64>| {
        json!({"element": "rigid", "name": name, "mass": MASS, "position": array(place),
               "motion": {"velocity": array(velocity)}, "markers": {"c": [0.0, 0.0, 0.0]}})
    };
    let force = |depth: f64, normal: Vector3<f64>| {
        let out = normal.dot(&velocity);
        let push = STIFFNESS * depth * (1.0 - DAMPING * out);
        let slip = velocity - normal * out;
        normal * push - slip * (FRICTION * push / slip.norm().hypot(SLIP))
    };
    let plane = json!({"plane": {"point": array(point), "normal": array(normal * 3.0)}});
    let sphere = json!({"sphere": {"center": array(center), "radius": radius}});
    let cylinder =
        json!({"cylinder": {"point": array(foot), "axis": array(axis * 2.0), "radius": radius}});
    let scene = json!({"name": "surfaces", "dimension": 3,
        "bodies": [particle("a", point - normal * 0.02), particle("b", center + across * (radius - 0.05)),
                   particle("c", foot + axis * 0.7 + across * (radius - 0.03))],
        "loads": [contact("of_a", "a.c", &plane), contact("of_b", "b.c", &sphere), contact("of_c", "c.c", &cylinder)],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "b.c"},
                    {"kind": "acceleration", "marker": "c.c"}, {"kind": "energy"}, {"kind": "load_force", "load": "of_a"}]});
    let mut specimen = Specimen::new("on surfaces in space", scene);
    for (name, force) in [
        ("a", force(0.02, normal)),
        ("b", force(0.05, across)),
        ("c", force(0.03, across)),
    ] {
        specimen = vector(
            specimen,
            &format!("{name}.c.acceleration"),
            "m/s2",
            force / MASS,
        );
    }
    specimen = vector(specimen, "of_a.force", "N", force(0.02, normal));
    let depths = 0.02 * 0.02 + 0.05 * 0.05 + 0.03 * 0.03;
    specimen.claim("energy.spring", "J", 0.5 * STIFFNESS * depths)
}

/// A body that rotates and moves has a circle and a line beside its centre. A marker touches the circle, and a ball that rotates the line.
fn on_a_moving_body() -> Specimen {
    let (place, angle, velocity, spin) = ([0.6, -0.4], 0.3, [0.4, -0.2], 1.1);
    let (mass, inertia) = (2.2, 0.7);
    let owner = json!({"element": "rigid", "name": "owner", "mass": mass, "inertia": inertia, "position": place, "angle": angle,
        "motion": {"velocity": velocity, "spin": spin}, "markers": {"c": [0.0, 0.0]}});
    let moves_at = |point: [f64; 2]| {
        let arm = sum(point, times(-1.0, place));
        sum(velocity, times(spin, [-arm[1], arm[0]]))
    };
    // The circle, in the frame of the body, and where the marker touches it.
    let (center, radius, first) = ([0.3, 0.2], 0.5, [0.6, 0.8]);
    let first_at = sum(
        sum(place, turned(angle, center)),
        times(radius - 0.04, first),
    );
    let arm = turned(ANGLE, [0.5, -0.2]);
    let (of_a, spin_a) = ([-0.3, -0.5], -0.7);
    let own = sum(of_a, times(spin_a, [-arm[1], arm[0]]));
    let on_a = force(0.04, first, sum(own, times(-1.0, moves_at(first_at))));
    // The line below a ball: its deepest point touches.
    let (foot, normal, ball) = ([-0.4, 0.1], [-0.96, -0.28], 0.25);
    let second = turned(angle, normal);
    let middle = sum(sum(place, turned(angle, foot)), times(ball - 0.03, second));
    let touching = sum(middle, times(-ball, second));
    let (of_b, spin_b) = ([0.9, 0.3], 2.3);
    let rolling = sum(of_b, times(spin_b, [ball * second[1], -ball * second[0]]));
    let on_b = force(0.03, second, sum(rolling, times(-1.0, moves_at(touching))));
    let mut of_ball = contact(
        "of_b",
        "b.c",
        &json!({"plane": {"point": foot, "normal": normal}}),
    );
    of_ball["radius"] = json!(ball);
    let mut of_marker = contact(
        "of_a",
        "a.p",
        &json!({"circle": {"center": center, "radius": radius}}),
    );
    for load in [&mut of_ball, &mut of_marker] {
        load["surface_of"] = json!("owner");
    }
    let mut outputs = read(&["a", "b", "owner"]);
    outputs.extend(["of_a", "of_b"].map(|load| json!({"kind": "load_force", "load": load})));
    let scene = json!({"name": "moving", "dimension": 2,
        "bodies": [owner, body("a", sum(first_at, times(-1.0, arm)), of_a, spin_a), body("b", middle, of_b, spin_b), extra()],
        "loads": [of_marker, of_ball], "outputs": outputs});
    let specimen = pushed(Specimen::new("on a moving body", scene), "a", on_a);
    let [to_first, to_second] = [first_at, touching].map(|point| sum(point, times(-1.0, place)));
    let moment = cross(to_first, on_a) + cross(to_second, on_b);
    specimen
        .vector("b.c.acceleration", "m/s2", times(1.0 / MASS, on_b))
        .claim(
            "b.c.angular_acceleration",
            "rad/s2",
            cross(times(-ball, second), on_b) / INERTIA,
        )
        .vector(
            "owner.c.acceleration",
            "m/s2",
            times(-1.0 / mass, sum(on_a, on_b)),
        )
        .claim("owner.c.angular_acceleration", "rad/s2", -moment / inertia)
        .vector("of_a.force", "N", on_a)
        .vector("of_b.force", "N", on_b)
        .claim(
            "energy.spring",
            "J",
            0.5 * STIFFNESS * (0.04 * 0.04 + 0.03 * 0.03),
        )
}

/// The same in space with a cylinder on a body whose centre of mass lies beside the origin of its frame, which a particle touches at a distance.
fn on_a_moving_body_in_space() -> Specimen {
    let axes = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    let (place, velocity, particle) = (
        Vector3::new(0.5, -0.3, 0.8),
        Vector3::new(0.2, -0.4, 0.3),
        Vector3::new(-0.6, 0.5, -0.2),
    );
    let (mass, lump, inertia) = (1.4, 0.6, 0.35);
    // A mass on an axis of the frame: the moments about the common centre are those of two points more.
    let lumped = Vector3::new(0.0, 0.0, 0.5);
    let center = lumped * (lump / (mass + lump));
    let more = mass * lump / (mass + lump) * lumped.norm_squared();
    let moments = Vector3::new(inertia + more, inertia + more, inertia);
    let (foot, axis, radius, thick) = (
        Vector3::new(0.3, -0.2, 0.1),
        Vector3::new(0.6, 0.0, 0.8),
        0.4,
        0.05,
    );
    let across = Vector3::new(-0.48, 0.8, 0.36);
    let local = foot + axis * 0.3 + across * (radius + thick - 0.04);
    let (normal, at) = (axes * across, place + axes * local);
    let touched = local - across * thick;
    // Spins would mix components of the inertia: the body only translates.
    let relative = particle - velocity;
    let out = normal.dot(&relative);
    let push = STIFFNESS * 0.04 * (1.0 - DAMPING * out);
    let slip = relative - normal * out;
    let force = normal * push - slip * (FRICTION * push / slip.norm().hypot(SLIP));
    let mut load = contact(
        "of_a",
        "a.c",
        &json!({"cylinder": {"point": array(foot), "axis": array(axis * 2.0), "radius": radius}}),
    );
    load["surface_of"] = json!("owner");
    load["radius"] = json!(thick);
    let rows: Vec<[f64; 3]> = axes
        .matrix()
        .row_iter()
        .map(|row| [row[0], row[1], row[2]])
        .collect();
    let scene = json!({"name": "moving_in_space", "dimension": 3,
        "bodies": [{"element": "rigid", "name": "owner", "mass": mass, "inertia": [inertia, inertia, inertia], "position": array(place),
                    "orientation": {"matrix": rows}, "motion": {"velocity": array(velocity)},
                    "markers": {"m": array(lumped), "c": [0.0, 0.0, 0.0]}},
                   {"element": "rigid", "name": "a", "mass": MASS, "position": array(at), "motion": {"velocity": array(particle)},
                    "markers": {"c": [0.0, 0.0, 0.0]}}],
        "masses": [{"marker": "owner.m", "mass": lump}],
        "loads": [load],
        "outputs": [{"kind": "acceleration", "marker": "a.c"}, {"kind": "acceleration", "marker": "owner.c"},
                    {"kind": "angular_acceleration", "marker": "owner.c"}, {"kind": "load_force", "load": "of_a"}, {"kind": "energy"}]});
    let turning = -(touched - center)
        .cross(&(axes.inverse() * force))
        .component_div(&moments);
    let acceleration = -force / (mass + lump) - (axes * turning.cross(&center));
    let specimen = Specimen::new("on a moving body in space", scene);
    let specimen = vector(specimen, "a.c.acceleration", "m/s2", force / MASS);
    let specimen = vector(specimen, "owner.c.acceleration", "m/s2", acceleration);
    let specimen = vector(
        specimen,
        "owner.c.angular_acceleration",
        "rad/s2",
        axes * turning,
    );
    let specimen = vector(specimen, "of_a.force", "N", force);
    specimen.claim("energy.spring", "J", 0.5 * STIFFNESS * 0.04 * 0.04)
}

/// A cable lies evenly deep on a plate that moves, with half its thickness.
fn along_a_cable_on_a_moving_body() -> Specimen {
    let (velocity, plate, depth, thick, mass) = ([0.9, -0.4], [-0.5, 0.7], 0.03, 0.02, 6.0);
    let scene = json!({"name": "on_a_plate", "dimension": 2,
        "bodies": [line(&json!({"motion": {"velocity": velocity}})),
                   {"element": "rigid", "name": "plate", "mass": mass, "inertia": 1e9, "position": [0.3, -0.5],
                    "motion": {"velocity": plate}, "markers": {"c": [0.0, 0.0]}}, extra()],
        "loads": [{"name": "floor", "kind": "contact", "body": "rod", "radius": thick, "surface_of": "plate",
                   "stiffness": STIFFNESS, "damping": DAMPING, "friction": FRICTION, "slip_velocity": SLIP,
                   "surface": {"plane": {"point": [0.0, 0.5 + depth - thick], "normal": [0.0, 1.0]}}}],
        "outputs": [{"kind": "acceleration", "marker": "rod.p"}, {"kind": "acceleration", "marker": "plate.c"},
                    {"kind": "load_force", "load": "floor"}]});
    let force = force(depth, [0.0, 1.0], sum(velocity, times(-1.0, plate)));
    Specimen::new("along a cable on a moving body", scene)
        .vector("rod.p.acceleration", "m/s2", times(1.0 / 2.5, force))
        .vector("plate.c.acceleration", "m/s2", times(-1.0 / mass, force))
        .vector("floor.force", "N", force)
}

/// A cable on the ground from `x = 0` to `x = 1`.
fn line(extra: &Value) -> Value {
    let mut body = json!({"element": "cable", "name": "rod", "elements": 2,
        "material": {"youngs_modulus": 1e6, "density": 1250.0}, "section": {"area": 2e-3, "second_moment": 1e-7},
        "shape": {"line": {"from": [0.0, 0.0], "to": [1.0, 0.0]}}, "markers": {"a": 0.0, "p": 0.3, "e": 1.0}});
    for (key, value) in extra.as_object().into_iter().flatten() {
        body[key] = value.clone();
    }
    body
}

/// All of it is below a plane that is inclined to it, and it rotates: depth and its rate are linear in `s`.
fn along_a_rigid_body() -> Specimen {
    let (mass, normal) = (2.5, [0.28, 0.96]);
    let (velocity, spin) = ([0.0, -0.4], 0.7);
    let scene = json!({"name": "lying", "dimension": 2,
        "bodies": [line(&json!({"model": "rigid", "motion": {"velocity": velocity, "spin": spin}})), extra()],
        "loads": [{"name": "floor", "kind": "contact", "body": "rod", "stiffness": STIFFNESS, "damping": DAMPING,
                   "surface": {"plane": {"point": [0.0, 0.4], "normal": normal}}}],
        "outputs": [{"kind": "acceleration", "marker": "rod.p"}, {"kind": "energy"}]});
    // `d = d0 + d1 s`, `1 + a d' = b0 + b1 s`.
    let [d0, d1] = [0.4 * 0.96, -0.28];
    let [b0, b1] = [
        1.0 - DAMPING * dot(normal, velocity),
        -DAMPING * spin * normal[1],
    ];
    let product = [d0 * b0, d0 * b1 + d1 * b0, d1 * b1];
    let moment = |power: usize| -> f64 {
        let terms = product.iter().enumerate();
        let term = |(n, c): (usize, &f64)| STIFFNESS * c / (n + power + 1) as f64;
        terms.map(term).sum()
    };
    let turning = normal[1] * (moment(1) - 0.5 * moment(0));
    let turn = turning / (mass / 12.0);
    let place = sum(
        times(moment(0) / mass, normal),
        [0.2 * spin * spin, -0.2 * turn],
    );
    let energy = 0.5 * STIFFNESS * (d0 * d0 + d0 * d1 + d1 * d1 / 3.0);
    Specimen::new("along a rigid body", scene)
        .vector("rod.p.acceleration", "m/s2", place)
        .claim("energy.spring", "J", energy)
}

/// Evenly deep and moving as a whole, it is pushed and rubbed evenly.
fn along_a_cable() -> Specimen {
    let (density, velocity, depth) = (2.5, [0.9, -0.4], 0.03);
    // Touches nothing.
    let above =
        line(&json!({"name": "above", "shape": {"line": {"from": [0.0, 0.5], "to": [1.0, 0.5]}}}));
    let scene = json!({"name": "dragged", "dimension": 2,
        "bodies": [line(&json!({"motion": {"velocity": velocity}})), above],
        "loads": [{"name": "floor", "kind": "contact", "body": "rod", "stiffness": STIFFNESS, "damping": DAMPING,
                   "friction": FRICTION, "slip_velocity": SLIP,
                   "surface": {"plane": {"point": [5.0, depth], "normal": [0.0, 1.0]}}}],
        "outputs": [{"kind": "acceleration", "marker": "rod.p"}, {"kind": "acceleration", "marker": "rod.e"}, {"kind": "energy"},
                    {"kind": "load_force", "load": "floor"}]});
    let even = times(1.0 / density, force(depth, [0.0, 1.0], velocity));
    Specimen::new("along a cable", scene)
        .vector("rod.p.acceleration", "m/s2", even)
        .vector("rod.e.acceleration", "m/s2", even)
        .vector("floor.force", "N", force(depth, [0.0, 1.0], velocity))
        .claim("energy.spring", "J", 0.5 * STIFFNESS * depth * depth)
}

/// The same of a rod in space, in a groove: two planes that it lies on.
fn along_a_rod() -> Specimen {
    let [left, right] = [[0.0, 0.6, 0.8], [0.0, -0.8, 0.6]].map(Vector3::from);
    let depths = [0.02, 0.05];
    let plane = |normal: Vector3<f64>, depth: f64| json!({"plane": {"point": array(normal * depth), "normal": array(normal)}});
    let scene = json!({"name": "groove", "dimension": 3,
        "bodies": [{"element": "rod", "name": "rod", "elements": 3, "axial": "waves",
            "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1250.0},
            "section": {"area": 2e-3, "second_moments": [1e-7, 2e-7], "torsion_constant": 2e-7},
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0]}}, "markers": {"p": 0.3, "e": 1.0}}],
        "loads": [{"name": "left", "kind": "contact", "body": "rod", "stiffness": STIFFNESS, "surface": plane(left, depths[0])},
                  {"name": "right", "kind": "contact", "body": "rod", "stiffness": 300.0, "surface": plane(right, depths[1])}],
        "outputs": [{"kind": "acceleration", "marker": "rod.p"}, {"kind": "acceleration", "marker": "rod.e"}, {"kind": "energy"}]});
    let force = left * (STIFFNESS * depths[0]) + right * (300.0 * depths[1]);
    let energy = 0.5 * (STIFFNESS * depths[0] * depths[0] + 300.0 * depths[1] * depths[1]);
    let specimen = Specimen::new("along a rod", scene);
    let specimen = vector(specimen, "rod.p.acceleration", "m/s2", force / 2.5);
    let specimen = vector(specimen, "rod.e.acceleration", "m/s2", force / 2.5);
    specimen.claim("energy.spring", "J", energy)
}

/// Clamped at its first end on an inclined plane: what acts beyond a section is carried by it.
fn sections_of_a_rigid_body() -> Specimen {
    let normal = [0.28, 0.96];
    let scene = json!({"name": "carried", "dimension": 2,
        "bodies": [line(&json!({"model": "rigid"})), resting()],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "rod.a"]}],
        "loads": [{"name": "floor", "kind": "contact", "body": "rod", "stiffness": STIFFNESS,
                   "surface": {"plane": {"point": [0.0, 0.4], "normal": normal}}}],
        "outputs": [{"kind": "axial_force", "marker": "rod.p"}, {"kind": "bending_moment", "marker": "rod.p"}]});
    let ([d0, d1], s) = ([0.4 * 0.96, -0.28], 0.3_f64);
    // Integrals from s to 1 of x^n and of x^n (x - s).
    let power = |n: i32| (1.0 - s.powi(n + 1)) / f64::from(n + 1);
    let arm = |n: i32| power(n + 1) - s * power(n);
    let force = STIFFNESS * (d0 * power(0) + d1 * power(1));
    let turning = STIFFNESS * (d0 * arm(0) + d1 * arm(1));
    Specimen::new("sections on a plane", scene)
        .claim("rod.p.axial_force", "N", normal[0] * force)
        .claim("rod.p.bending_moment", "N.m", normal[1] * turning)
}

/// A stiff beam, free but for the ground below, in equilibrium under a force at its middle: a rigid beam on Winkler's ground stands
/// evenly deep, and the moment in its middle is `F L / 8`.
fn sections_of_a_beam() -> Specimen {
    let (load, stiffness) = (0.5, 1e3);
    let scene = json!({"name": "winkler", "dimension": 2, "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [line(&json!({"section": {"area": 2e-3, "second_moment": 1e-2},
                                "markers": {"a": 0.0, "m": 0.5, "q": 0.25}}))],
        "joints": [{"name": "rail", "kind": "point_on_line", "markers": ["ground", "rod.m"], "direction": [0.0, 1.0]}],
        "loads": [{"name": "floor", "kind": "contact", "body": "rod", "stiffness": stiffness,
                   "surface": {"plane": {"point": [0.0, 0.0], "normal": [0.0, 1.0]}}},
                  {"name": "press", "kind": "force", "marker": "rod.m", "value": [0.0, -load]}],
        "outputs": [{"kind": "position", "marker": "rod.a"}, {"kind": "bending_moment", "marker": "rod.q"}]});
    // Stiffer than the ground by `8 E I / (k L^4)` = 80, which bends it by some 1e-4 of the depth.
    Specimen::new("sections on the ground", scene)
        .claim_within(
            "rod.a.position[2]",
            "m",
            -load / stiffness,
            1e-3 * load / stiffness,
        )
        .claim_within(
            "rod.q.bending_moment",
            "N.m",
            load / 32.0,
            1e-3 * load / 32.0,
        )
}

/// A body on a rail stands `m g / k` deep in equilibrium, where friction is none.
fn at_rest() -> Specimen {
    let gravity = 9.81;
    let scene = json!({"name": "standing", "dimension": 2, "gravity": [0.0, -gravity], "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [{"element": "rigid", "name": "a", "mass": MASS, "inertia": INERTIA, "position": [0.0, -0.001],
                    "markers": {"c": [0.0, 0.0]}}],
        "joints": [{"name": "rail", "kind": "point_on_line", "markers": ["ground", "a.c"], "direction": [0.0, 1.0]},
                   {"name": "upright", "kind": "orientation", "markers": ["ground", "a.c"]}],
        "loads": [contact("floor", "a.c", &json!({"plane": {"point": [0.0, 0.0], "normal": [0.0, 1.0]}}))],
        "outputs": [{"kind": "position", "marker": "a.c"}, {"kind": "natural_frequency", "count": 1}]});
    Specimen::new("standing on the ground", scene)
        .claim("a.c.position[2]", "m", -MASS * gravity / STIFFNESS)
        .claim("natural_frequency[1]", "rad/s", (STIFFNESS / MASS).sqrt())
}

/// A body stands on a plate on a spring: both are as deep as their weights ask, and swing as two masses on two springs.
fn at_rest_on_a_body() -> Specimen {
    let (gravity, plate, spring) = (9.81, 2.4, 900.0);
    let rail = |name: &str, body: &str| {
        [
            json!({"name": name, "kind": "point_on_line", "markers": ["ground", format!("{body}.c")], "direction": [0.0, 1.0]}),
            json!({"name": format!("{name}_upright"), "kind": "orientation", "markers": ["ground", format!("{body}.c")]}),
        ]
    };
    let mut floor = contact(
        "floor",
        "a.c",
        &json!({"plane": {"point": [0.0, 0.1], "normal": [0.0, 1.0]}}),
    );
    floor["surface_of"] = json!("plate");
    floor["radius"] = json!(0.2);
    let joints = [rail("first", "a"), rail("second", "plate")].concat();
    let scene = json!({"name": "standing_on_a_plate", "dimension": 2, "gravity": [0.0, -gravity], "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-9},
        "bodies": [{"element": "rigid", "name": "a", "mass": MASS, "inertia": INERTIA, "position": [0.0, 0.29],
                    "markers": {"c": [0.0, 0.0]}},
                   {"element": "rigid", "name": "plate", "mass": plate, "inertia": INERTIA, "position": [0.0, 0.0],
                    "markers": {"c": [0.0, 0.0]}}],
        "joints": joints,
        "loads": [floor, {"name": "spring", "kind": "spring_damper", "markers": ["ground", "plate.c"], "point": [0.0, -1.0],
                          "stiffness": spring, "length": 1.0}],
        "outputs": [{"kind": "position", "marker": "a.c"}, {"kind": "position", "marker": "plate.c"},
                    {"kind": "natural_frequency", "count": 2}]});
    let sinks = (MASS + plate) * gravity / spring;
    // Roots of `(k + s - M w) (k - m w) = k^2` in the square of the frequency.
    let (k, s) = (STIFFNESS, spring);
    let half = 0.5 * ((k + s) / plate + k / MASS);
    let root = (half * half - k * s / (MASS * plate)).sqrt();
    Specimen::new("standing on a body", scene)
        .claim("plate.c.position[2]", "m", -sinks)
        .claim(
            "a.c.position[2]",
            "m",
            0.3 - sinks - MASS * gravity / STIFFNESS,
        )
        .claim("natural_frequency[1]", "rad/s", (half - root).sqrt())
        .claim("natural_frequency[2]", "rad/s", (half + root).sqrt())
}
