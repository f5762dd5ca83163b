//! Joints: what they hold, where, and the force and moment that they hold it with.

use serde_json::{Value, json};

use super::{cross, extra, left, sum, times, turned};
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        pendulum(),
        pins(),
        welds(),
        welded_pair(),
        angles_from_another(),
        hinges(),
        hinged_pair(),
        angle_of_a_joint(),
        telescope(),
        rams(),
        slotted_lever(),
    ]
}

/// A rigid body.
fn body(name: &str, of: [f64; 2], place: [f64; 2], angle: f64, spin: f64) -> Value {
    json!({"element": "rigid", "name": name, "mass": of[0], "inertia": of[1], "position": place,
           "angle": angle, "motion": {"spin": spin},
           "markers": {"c": [0.0, 0.0], "tip": [0.6, 0.0]}})
}

/// A physical pendulum in motion.
fn pendulum() -> Specimen {
    let (m, j, l, angle, spin, g) = (2.0, 0.5, 0.6, 0.4, 1.3, [0.7, -9.0]);
    let arm = turned(angle, [l, 0.0]);
    let pin = [0.2, 0.9];
    let scene = json!({
        "name": "pendulum", "dimension": 2, "gravity": g,
        "bodies": [{"element": "rigid", "name": "bar", "mass": m, "inertia": j,
                    "position": sum(pin, arm), "angle": angle,
                    "motion": {"velocity": times(spin, left(arm)), "spin": spin},
                    "markers": {"root": [-l, 0.0], "tip": [l, 0.0]}}, extra()],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "bar.root"]}],
        "outputs": [{"kind": "angular_acceleration", "marker": "bar.tip"}, {"kind": "position", "marker": "bar.root"},
                    {"kind": "reaction", "joint": "pin"}, {"kind": "residual"},
                    {"kind": "natural_frequency", "count": 1}]});
    let alpha = cross(arm, times(m, g)) / (j + m * l * l);
    let a = sum(times(alpha, left(arm)), times(-spin * spin, arm));
    Specimen::new("pendulum", scene)
        .fact("variables", 17)
        .vector("bar.root.position", "m", pin)
        .claim("bar.tip.angular_acceleration", "rad/s2", alpha)
        .vector("pin.reaction", "N", times(m, sum(a, times(-1.0, g))))
        // What holds, holds to roundoff.
        .claim("residual.position", "", 0.0)
        .claim("residual.velocity", "1/s", 0.0)
}

/// A pin elsewhere than its body, which is moved there; two bodies pinned at their centres of mass, one
/// of which is pulled.
fn pins() -> Specimen {
    let (point, pull) = ([0.45, -0.03], [3.0, -5.0]);
    let scene = json!({
        "name": "pins", "dimension": 2,
        "bodies": [body("moved", [2.0, 0.5], [0.5, 0.0], 0.3, 0.4), body("a", [1.5, 0.4], [0.0, 2.0], 0.1, 0.0),
                   body("b", [0.8, 0.3], [0.0, 2.0], 0.7, 0.0), extra()],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "moved.c"], "point": point},
                   {"name": "pair", "kind": "revolute", "markers": ["a.c", "b.c"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "b.c", "value": pull}],
        "outputs": [{"kind": "position", "marker": "moved.c"}, {"kind": "reaction", "joint": "pair"},
                    {"kind": "position", "marker": "moved.tip"},
                    {"kind": "acceleration", "marker": "a.c"}]});
    Specimen::new("pins", scene)
        .vector("moved.c.position", "m", point)
        .vector(
            "moved.tip.position",
            "m",
            sum(point, turned(0.3, [0.6, 0.0])),
        )
        .vector("pair.reaction", "N", times(-1.5 / 2.3, pull))
        .vector("a.c.acceleration", "m/s2", times(1.0 / 2.3, pull))
}

/// Bodies welded to the ground: at an angle and a point that they are not at, and as they are; one whose
/// direction alone is held.
fn welds() -> Specimen {
    let (g, point) = ([0.6, -9.0], [0.45, -0.03]);
    let scene = json!({
        "name": "welds", "dimension": 2, "gravity": g,
        "bodies": [body("held", [2.0, 0.5], [0.5, 0.0], 0.3, 0.0), body("arm", [1.5, 0.4], [0.0, 2.0], 0.2, 0.0),
                   body("turned", [0.8, 0.3], [-1.0, 0.0], 0.5, 0.0),
                   body("kept", [0.8, 0.3], [-2.0, 0.0], 0.7, 0.0), body("loose", [0.9, 0.2], [-3.0, 1.0], 0.9, 0.0)],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "held.c"], "point": point, "angle": 0.35},
                   {"name": "as_is", "kind": "weld", "markers": ["ground", "arm.tip"]},
                   {"name": "guide", "kind": "orientation", "markers": ["ground", "turned.c"], "angle": 0.45},
                   {"name": "guide_as_is", "kind": "orientation", "markers": ["ground", "kept.c"]}],
        "loads": [{"name": "twist", "kind": "moment", "marker": "turned.c", "value": 1.7}],
        "outputs": [{"kind": "position", "marker": "held.c"}, {"kind": "angle", "marker": "held.c"},
                    {"kind": "reaction", "joint": "clamp"}, {"kind": "angle", "marker": "arm.c"},
                    {"kind": "reaction", "joint": "as_is"}, {"kind": "reaction_moment", "joint": "as_is"},
                    {"kind": "reaction_moment", "joint": "guide"}, {"kind": "angle", "marker": "turned.c"},
                    {"kind": "acceleration", "marker": "turned.tip"}, {"kind": "angle", "marker": "kept.c"}]});
    // The centre of mass of the arm is this way from what holds it.
    let way = turned(0.2, [-0.6, 0.0]);
    Specimen::new("welds", scene)
        .vector("held.c.position", "m", point)
        .claim("held.c.angle", "rad", 0.35)
        .vector("clamp.reaction", "N", times(-2.0, g))
        .claim("arm.c.angle", "rad", 0.2)
        .vector("as_is.reaction", "N", times(-1.5, g))
        .claim("as_is.reaction_moment", "N.m", -cross(way, times(1.5, g)))
        .claim("turned.c.angle", "rad", 0.45)
        .claim("guide.reaction_moment", "N.m", -1.7)
        .vector("turned.tip.acceleration", "m/s2", g)
        .claim("kept.c.angle", "rad", 0.7)
}

/// A body that is clamped, and others held at angles from it: welded to it, and kept in direction only.
fn angles_from_another() -> Specimen {
    let scene = json!({
        "name": "angles_from_another", "dimension": 2,
        "bodies": [body("base", [1.5, 0.4], [0.0, 0.0], 0.1, 0.0), body("fin", [0.8, 0.3], [-0.6, 0.0], 0.3, 0.0),
                   body("vane", [0.8, 0.3], [1.0, 2.0], 0.7, 0.0)],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "base.c"], "angle": 0.2},
                   {"name": "seam", "kind": "weld", "markers": ["base.c", "fin.tip"], "angle": 0.35},
                   {"name": "guide", "kind": "orientation", "markers": ["base.c", "vane.c"], "angle": -0.45}],
        "outputs": [{"kind": "angle", "marker": "base.c"}, {"kind": "angle", "marker": "fin.c"},
                    {"kind": "angle", "marker": "vane.c"}]});
    Specimen::new("angles_from_another", scene)
        .claim("base.c.angle", "rad", 0.2)
        .claim("fin.c.angle", "rad", 0.2 + 0.35)
        .claim("vane.c.angle", "rad", 0.2 - 0.45)
}

/// Two free bodies welded at their centres of mass, and two with their directions held: a moment on one
/// rotates both.
fn welded_pair() -> Specimen {
    let scene = json!({
        "name": "welded_pair", "dimension": 2,
        "bodies": [body("a", [1.5, 0.4], [0.0, 2.0], 0.1, 0.0), body("b", [0.8, 0.3], [0.0, 2.0], 0.7, 0.0),
                   body("c", [1.5, 0.4], [2.0, 2.0], 0.1, 0.0), body("d", [0.8, 0.3], [1.0, 2.0], 0.7, 0.0),
                   super::resting()],
        "joints": [{"name": "weld", "kind": "weld", "markers": ["a.c", "b.c"]},
                   {"name": "guide", "kind": "orientation", "markers": ["c.c", "d.c"]}],
        "loads": [{"name": "twist", "kind": "moment", "marker": "b.c", "value": 1.4},
                  {"name": "turn", "kind": "moment", "marker": "d.c", "value": 2.1},
                  {"name": "pull", "kind": "force", "marker": "b.c", "value": [0.0, 2.3]}],
        "outputs": [{"kind": "angular_acceleration", "marker": "a.c"}, {"kind": "reaction_moment", "joint": "weld"},
                    {"kind": "angular_acceleration", "marker": "c.c"}, {"kind": "reaction_moment", "joint": "guide"},
                    {"kind": "reaction", "joint": "weld"}]});
    Specimen::new("welded_pair", scene)
        .claim("a.c.angular_acceleration", "rad/s2", 2.0)
        .claim("weld.reaction_moment", "N.m", -0.8)
        .claim("c.c.angular_acceleration", "rad/s2", 3.0)
        .claim("guide.reaction_moment", "N.m", -1.2)
        .vector("weld.reaction", "N", [0.0, -1.5])
}

/// Hinges to the ground with everything, and each without a key.
fn hinges() -> Specimen {
    let (k, d, rest, angle, spin, j) = (4.0, 0.2, 0.1, 0.3, 0.8, 0.5);
    let (point, g) = ([0.45, -0.03], [0.7, -9.0]);
    let scene = json!({
        "name": "hinges", "dimension": 2, "gravity": g,
        "bodies": [body("full", [2.0, j], [0.5, 0.0], angle, spin), body("soft", [2.0, j], [1.5, 0.0], angle, spin),
                   body("undamped", [2.0, j], [2.5, 0.0], angle, spin),
                   body("relaxed", [2.0, j], [3.5, 0.0], angle, spin)],
        "joints": [
            {"name": "hinge", "kind": "revolute", "markers": ["ground", "full.c"], "point": point,
             "stiffness": k, "damping": d, "angle": rest},
            {"name": "damper", "kind": "revolute", "markers": ["ground", "soft.c"], "damping": d, "angle": rest},
            {"name": "spring", "kind": "revolute", "markers": ["ground", "undamped.c"], "stiffness": k, "angle": rest},
            {"name": "at_rest", "kind": "revolute", "markers": ["ground", "relaxed.c"], "stiffness": k}],
        "outputs": [{"kind": "angle", "joint": "hinge"}, {"kind": "angular_velocity", "joint": "hinge"},
                    {"kind": "angular_acceleration", "joint": "hinge"}, {"kind": "position", "marker": "full.c"},
                    {"kind": "reaction", "joint": "hinge"},
                    {"kind": "angular_acceleration", "joint": "damper"},
                    {"kind": "angular_acceleration", "joint": "spring"},
                    {"kind": "angular_acceleration", "joint": "at_rest"}, {"kind": "energy"},
                    {"kind": "position", "marker": "soft.c"}]});
    let (elastic, viscous) = (-k * (angle - rest), -d * spin);
    Specimen::new("hinges", scene)
        .claim("hinge.angle", "rad", angle)
        .claim("hinge.angular_velocity", "rad/s", spin)
        .claim(
            "hinge.angular_acceleration",
            "rad/s2",
            (elastic + viscous) / j,
        )
        .vector("full.c.position", "m", point)
        .vector("hinge.reaction", "N", times(-2.0, g))
        .claim("damper.angular_acceleration", "rad/s2", viscous / j)
        .vector("soft.c.position", "m", [1.5, 0.0])
        .claim("spring.angular_acceleration", "rad/s2", elastic / j)
        .claim("at_rest.angular_acceleration", "rad/s2", 0.0)
        .claim("energy.spring", "J", k * (angle - rest).powi(2))
}

/// A hinge between two free bodies at their centres of mass, one of which is pulled.
fn hinged_pair() -> Specimen {
    let (k, d, rest, ja, jb) = (4.0, 0.2, -0.75, 0.4, 0.3);
    let scene = json!({
        "name": "hinged_pair", "dimension": 2,
        "bodies": [body("a", [1.5, ja], [0.0, 2.0], 1.1, 0.5), body("b", [0.8, jb], [0.0, 2.0], 0.3, 1.2), extra()],
        "joints": [{"name": "hinge", "kind": "revolute", "markers": ["a.c", "b.c"], "stiffness": k, "damping": d,
                    "angle": rest}],
        "loads": [{"name": "pull", "kind": "force", "marker": "b.c", "value": [3.0, -5.0]}],
        "outputs": [{"kind": "angle", "joint": "hinge"}, {"kind": "angular_acceleration", "joint": "hinge"},
                    {"kind": "angular_velocity", "joint": "hinge"},
                    {"kind": "angular_acceleration", "marker": "a.c"}, {"kind": "reaction", "joint": "hinge"}]});
    let (angle, rate) = (-0.8, 0.7);
    let moment = -k * (angle - rest) - d * rate;
    Specimen::new("hinged_pair", scene)
        .claim("hinge.angle", "rad", angle)
        .claim("hinge.angular_velocity", "rad/s", rate)
        .claim(
            "hinge.angular_acceleration",
            "rad/s2",
            moment / jb + moment / ja,
        )
        .claim("a.c.angular_acceleration", "rad/s2", -moment / ja)
        .vector("hinge.reaction", "N", times(-1.5 / 2.3, [3.0, -5.0]))
}

/// The angle of a joint is counted on over full turns, whatever the order in which angles are listed.
fn angle_of_a_joint() -> Specimen {
    let scene = json!({
        "name": "angle_of_a_joint", "dimension": 2,
        "bodies": [body("a", [1.5, 0.4], [0.0, 2.0], 0.2, -0.7), body("b", [0.8, 0.3], [0.0, 2.0], 0.9, 8.0)],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["a.c", "b.c"]}],
        "accuracy": {"relative_tolerance": 1e-9},
        "outputs": [{"kind": "angle", "marker": "b.tip"}, {"kind": "angle", "joint": "pin"},
                    {"kind": "angle", "marker": "a.c"}]});
    Specimen::new("angle_of_a_joint", scene)
        .claim("pin.angle", "rad", 0.7)
        .at(1.0)
        .claim_within("b.tip.angle", "rad", 8.9, 1e-6)
        .claim_within("pin.angle", "rad", 9.4, 1e-6)
        .claim_within("a.c.angle", "rad", -0.5, 1e-6)
}

/// A block slides on a line of an arm that is rotated at a steady rate: away from the pivot as a hyperbolic cosine.
fn telescope() -> Specimen {
    let (m, a0, w, r0, t) = (1.3, 0.2, 1.5, 0.4, 0.6);
    let along = |angle: f64, r: f64| turned(angle, [0.6 * r, 0.8 * r]);
    let start = along(a0, r0);
    let scene = json!({
        "name": "telescope", "dimension": 2,
        "bodies": [{"element": "rigid", "name": "arm", "mass": 2.0, "inertia": 0.5, "position": [0.0, 0.0],
                    "angle": a0, "motion": {"spin": w}, "markers": {"root": [0.0, 0.0]}},
                   {"element": "rigid", "name": "block", "mass": m, "inertia": 0.2, "position": start,
                    "angle": a0 + 0.3, "motion": {"velocity": times(w, left(start)), "spin": w},
                    "markers": {"c": [0.0, 0.0]}}],
        "joints": [{"name": "pivot", "kind": "revolute", "markers": ["ground", "arm.root"]},
                   {"name": "rail", "kind": "prismatic", "markers": ["arm.root", "block.c"],
                    "direction": [0.6, 0.8], "angle": 0.3}],
        "motions": [{"name": "turn", "kind": "angle", "joint": "pivot", "value": format!("{a0} + {w}*t")}],
        "accuracy": {"relative_tolerance": 1e-9},
        "outputs": [{"kind": "position", "marker": "block.c"}, {"kind": "angle", "marker": "block.c"},
                    {"kind": "reaction", "joint": "rail"}, {"kind": "residual"}]});
    let (angle, r, rate) = (a0 + w * t, r0 * (w * t).cosh(), r0 * w * (w * t).sinh());
    Specimen::new("telescope", scene)
        .at(t)
        .vector_within("block.c.position", "m", along(angle, r), 1e-6)
        .claim_within("block.c.angle", "rad", angle + 0.3, 1e-6)
        .vector_within(
            "rail.reaction",
            "N",
            times(2.0 * m * w * rate, left(along(angle, 1.0))),
            1e-5,
        )
        .claim("residual.position", "", 0.0)
}

/// Bodies that fall along lines: of a body that is held, in its own direction, and of the ground, to which one is moved.
fn rams() -> Specimen {
    let (g, m, tilt) = ([0.6, -9.0], 1.5, 0.2);
    let (axis, line) = (turned(tilt, [1.0, 0.0]), [0.8, -0.6]);
    let scene = json!({
        "name": "rams", "dimension": 2, "gravity": g,
        "bodies": [body("base", [2.0, 0.5], [0.0, 0.0], tilt, 0.0), body("ram", [m, 0.4], times(2.0, axis), 0.7, 0.0),
                   body("cart", [0.8, 0.3], [0.5, 3.0], 0.4, 0.0), body("bead", [0.8, 0.3], [3.0, 3.0], 0.1, 0.0)],
        "loads": [{"name": "twist", "kind": "moment", "marker": "bead.c", "value": 1.2}],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "base.c"]},
                   {"name": "bore", "kind": "prismatic", "markers": ["base.c", "ram.tip"]},
                   {"name": "track", "kind": "prismatic", "markers": ["ground", "cart.c"], "direction": [1.6, -1.2],
                    "point": [0.0, 3.0], "angle": 0.45},
                   {"name": "wire", "kind": "point_on_line", "markers": ["ground", "bead.c"], "direction": [1.6, -1.2]}],
        "outputs": [{"kind": "acceleration", "marker": "ram.c"}, {"kind": "reaction", "joint": "bore"},
                    {"kind": "reaction_moment", "joint": "bore"}, {"kind": "angle", "marker": "ram.c"},
                    {"kind": "acceleration", "marker": "cart.c"}, {"kind": "position", "marker": "cart.c"},
                    {"kind": "angle", "marker": "cart.c"}, {"kind": "angular_acceleration", "marker": "bead.c"}]});
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // The tip of the ram comes onto the axis, along the shortest way.
    let held = sum(times(m * dot(g, axis), axis), times(-m, g));
    let way = turned(0.7, [0.6, 0.0]);
    let foot = sum([0.0, 3.0], times(dot([0.5, 0.0], line), line));
    Specimen::new("rams", scene)
        .vector("ram.c.acceleration", "m/s2", times(dot(g, axis), axis))
        .vector("bore.reaction", "N", held)
        .claim("bore.reaction_moment", "N.m", -cross(way, held))
        .claim("ram.c.angle", "rad", 0.7)
        .vector("cart.c.acceleration", "m/s2", times(dot(g, line), line))
        .vector("cart.c.position", "m", foot)
        .claim("cart.c.angle", "rad", 0.45)
        // A slider leaves the rotation free.
        .claim("bead.c.angular_acceleration", "rad/s2", 1.2 / 0.3)
}

/// A bead in the slot of a lever that rotates at a steady rate; the slot does not pass through the pivot.
fn slotted_lever() -> Specimen {
    let (g, m, tilt, rate, speed) = ([0.6, -9.0], 1.5, 0.3, 2.0, 0.7);
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let slot = turned(tilt, [0.8, -0.6]);
    let at = sum(turned(tilt, [0.6, 0.0]), times(0.25, slot));
    let mut bead = body("bead", [m, 0.4], at, 0.7, 0.9);
    bead["motion"]["velocity"] = json!(sum(times(rate, left(at)), times(speed, slot)));
    let scene = json!({
        "name": "slotted_lever", "dimension": 2, "gravity": g,
        "bodies": [body("lever", [2.0, 0.5], [0.0, 0.0], tilt, rate), bead],
        "joints": [{"name": "pivot", "kind": "revolute", "markers": ["ground", "lever.c"]},
                   {"name": "slot", "kind": "point_on_line", "markers": ["lever.tip", "bead.c"], "direction": [1.6, -1.2]}],
        "motions": [{"name": "turn", "kind": "angle", "marker": "lever.c", "value": "0.3+2*t"}],
        "outputs": [{"kind": "acceleration", "marker": "bead.c"}, {"kind": "reaction", "joint": "slot"},
                    {"kind": "reaction_moment", "motion": "turn"}, {"kind": "angular_velocity", "marker": "bead.c"}]});
    // Along the slot it falls and is thrown outwards, across it is carried.
    let across = left(slot);
    let carried = 2.0 * rate * speed - rate * rate * dot(at, across);
    let held = times(m * (carried - dot(g, across)), across);
    Specimen::new("slotted_lever", scene)
        .vector(
            "bead.c.acceleration",
            "m/s2",
            sum(times(dot(g, slot), slot), times(carried, across)),
        )
        .vector("slot.reaction", "N", held)
        .claim("turn.reaction_moment", "N.m", cross(at, held))
        .claim("bead.c.angular_velocity", "rad/s", 0.9)
}
