"""Lines with a hub, a support that moves, or an arm at a right angle."""

import math

import numpy as np
from drawing import Case, amplitude, body, components, course, experiment, finish, plane
from frame import Course, Frame


def motor(random):
    """A hub on a spring that carries an arm, driven by a torque."""
    wanted = random.one([1e-2, 1e-3])
    own = body(random, False)
    length, s = own.length, own.section
    rotation = random.turn()
    arm = s.density * s.area * length**3 / 3
    inertia = random.wide(0.05, 5) * arm
    stiffness = random.wide(0.1, 10) * 3 * s.youngs * s.i2 / length

    def build(level):
        frame = Frame(0.0, planar=True)
        ends = frame.node(), frame.node()
        nodes = frame.line(*ends, (0, 0, 0), (length, 0, 0), 24 * 2**level, s)
        frame.hold(ends[0], (0, 1))
        frame.mass(ends[0], 0.0, (0, 0, inertia))
        frame.spring(ends[0], 5, stiffness)
        return frame, nodes

    period = 2 * math.pi / float(build(0)[0].modes()[0][0])
    name = random.one(["at once", "ramp", "harmonic"])
    acting, text = course(random, name, period)
    torque = amplitude(random, wanted) * stiffness * (0.1 if name == "harmonic" else 1.0)
    scene = {"dimension": 2, "experiment": experiment(random, period, (3, 12))}
    end = components(rotation @ [length, 0, 0], False)
    angle = math.atan2(rotation[1, 0], rotation[0, 0])
    hub = {"name": "hub", "element": "rigid", "mass": 3 * arm / length**2, "inertia": inertia, "position": [0.0, 0.0]}
    scene["bodies"] = [hub | {"angle": angle, "markers": {"c": [0.0, 0.0]}}, own.written("arm", [0.0, 0.0], end)]
    shaft = {"name": "shaft", "kind": "revolute", "markers": ["ground", "hub.c"], "stiffness": stiffness, "angle": angle}
    scene["joints"] = [shaft, {"name": "flange", "kind": "weld", "markers": ["hub.c", "arm.root"]}]
    value = torque if name == "at once" else f"{torque!r}*{text}"
    scene["loads"] = [{"name": "motor", "kind": "torque", "joint": "shaft", "value": value}]
    outputs = [
        ({"kind": "position", "marker": "arm.tip"}, "arm.tip.position"),
        ({"kind": "reaction_moment", "joint": "flange"}, "flange.reaction_moment"),
        ({"kind": "bending_moment", "marker": "arm.root"}, "arm.root.bending_moment"),
    ]
    finish(random, "fuzz", scene, outputs, wanted)
    drawn = rotation @ [length, 0, 0]

    def right(times, level):
        frame, nodes = build(level + 1)
        motion = frame.respond(times, [(frame.point(nodes[0], (0, 0, 0), (0, 0, torque)), acting)])
        moment = motion.section(nodes, 0)[1][:, 2:3]
        place = (drawn + motion.place(nodes[-1]) @ rotation.T)[:, :2]
        return {"arm.tip.position": place, "flange.reaction_moment": -moment, "arm.root.bending_moment": moment}

    dynamic = {"flange.reaction_moment", "arm.root.bending_moment"}
    return Case(f"motor_{s.element} {name}", scene, right, {"arm.tip.position": drawn[:2]}, dynamic)


def moved_support(random):
    """A clamp that is displaced across the line, from rest to rest or to and fro."""
    wanted = random.one([1e-2, 1e-3])
    own = body(random, False)
    length, s = own.length, own.section

    def build(level, damping_time=0.0):
        frame = Frame(damping_time, planar=True)
        ends = frame.node(), frame.node()
        nodes = frame.line(*ends, (0, 0, 0), (length, 0, 0), 24 * 2**level, s)
        frame.hold(ends[0], range(6))
        return frame, nodes

    omega = float(build(0)[0].modes()[0][0])
    period = 2 * math.pi / omega
    own.damping_time = float(f"{2 * random.wide(0.005, 0.05) / omega:.4g}")
    way = amplitude(random, wanted) * length
    if random.chance(0.5):
        own_omega, text = math.pi / (random.between(0.5, 3) * period), None
        time = math.pi / own_omega
        moved = Course((("one", way / 2, 0, 0), ("cos", -way / 2, 0, own_omega)))
        moved = Course((*moved.terms, ("one", way / 2, time, 0), ("cos", -way / 2, time, own_omega)))
        text = f"{way!r}*if({time!r}-t,(1-cos({own_omega!r}*t))/2,1)"
        name = "rest to rest"
    else:
        own_omega = 0.9 * omega
        way *= 0.2
        moved = Course((("one", way, 0, 0), ("cos", -way, 0, own_omega)))
        text = f"{way!r}*(1-cos({own_omega!r}*t))"
        name = "to and fro"
    waves = (term for term in moved.terms if term[0] == "cos")
    acceleration = Course(tuple(("cos", -factor * own_omega**2, delay, w) for _, factor, delay, w in waves))
    scene = {"dimension": 2, "experiment": experiment(random, period, (3, 10))}
    base = {"name": "base", "element": "rigid", "mass": s.density * s.area * length, "inertia": s.density * s.area * length**3}
    base |= {"position": [0.0, 0.0], "markers": {"c": [0.0, 0.0]}}
    scene["bodies"] = [base, own.written("line", [0.0, 0.0], [length, 0.0])]
    scene["joints"] = [
        {"name": "guide", "kind": "prismatic", "markers": ["ground", "base.c"], "direction": [0.0, 1.0]},
        {"name": "clamp", "kind": "weld", "markers": ["base.c", "line.root"]},
    ]
    scene["motions"] = [{"name": "drive", "kind": "displacement", "joint": "guide", "value": text}]
    outputs = [
        ({"kind": "position", "marker": "line.tip"}, "line.tip.position"),
        ({"kind": "reaction_moment", "joint": "clamp"}, "clamp.reaction_moment"),
        ({"kind": "reaction", "joint": "clamp"}, "clamp.reaction"),
    ]
    finish(random, "fuzz", scene, outputs, wanted)

    def right(times, level):
        frame, nodes = build(level, own.damping_time)
        shape = np.zeros(frame.count)
        shape[[i for i in range(frame.count) if i % 6 == 1]] = 1.0
        motion = frame.respond(times, [], (shape, moved, acceleration))
        force, moment = motion.section(nodes, 0)
        found = {"clamp.reaction": -force[:, :2], "clamp.reaction_moment": -moment[:, 2:3]}
        return found | {"line.tip.position": np.array([length, 0.0]) + motion.place(nodes[-1])[:, :2]}

    dynamic = {"clamp.reaction", "clamp.reaction_moment"}
    return Case(f"moved_support_{s.element} {name}", scene, right, {"line.tip.position": np.array([length, 0.0])}, dynamic)


def elbow(random):
    """A clamped shaft with an arm at a right angle: bending and torsion in space, an elbow in the plane."""
    space = random.chance(0.6)
    wanted = random.one([1e-2, 1e-3])
    own = body(random, space, elements=["rod", "beam"] if space else None)
    length, s = own.length, own.section
    other = length * random.between(0.3, 1.5)
    rotation = random.rotation() if space else random.turn()
    corner, end = np.array([length, 0, 0]), np.array([length, other, 0])
    up = np.array([0, 0, 1.0])

    def build(level, damping_time):
        frame = Frame(damping_time, planar=not space)
        root, middle, tip = frame.node(), frame.node(), frame.node()
        one = frame.line(root, middle, (0, 0, 0), corner, 24 * 2**level, s, up)
        two = frame.line(middle, tip, corner, end, 24 * 2**level, s, up)
        frame.hold(root, range(6))
        return frame, one, two

    omega = float(build(0, 0.0)[0].modes()[0][0])
    period = 2 * math.pi / omega
    name = random.one(["at once", "ramp", "harmonic", "kick"])
    own.damping_time = float(f"{2 * random.wide(0.005, 0.05) / omega:.4g}")
    acting, text = course(random, name, period)
    direction = up if space else np.array([1.0, 0, 0])
    bending = s.youngs * min(s.i1, s.i2)
    size = amplitude(random, wanted) * bending / (length + other) ** 2 * (0.2 if name == "harmonic" else 1)
    scene = {"dimension": 3 if space else 2, "experiment": experiment(random, period, (3, 10))}
    at = [components(rotation @ place, space) for place in (np.zeros(3), corner, end)]
    axis = components(rotation @ up, True)
    scene["bodies"] = [own.written("shaft", at[0], at[1], axis), own.written("arm", at[1], at[2], axis)]
    scene["joints"] = [
        {"name": "clamp", "kind": "weld", "markers": ["ground", "shaft.root"]},
        {"name": "elbow", "kind": "weld", "markers": ["shaft.tip", "arm.root"]},
    ]
    vector = components(rotation @ direction * size, space)
    value = vector if name == "at once" else [f"{part!r}*{text}" for part in vector]
    scene["loads"] = [{"name": "load", "kind": "force", "marker": "arm.tip", "value": value}]
    outputs = [
        ({"kind": "position", "marker": "arm.tip"}, "arm.tip.position"),
        ({"kind": "reaction_moment", "joint": "clamp"}, "clamp.reaction_moment"),
        ({"kind": "reaction_moment", "joint": "elbow"}, "elbow.reaction_moment"),
    ]
    finish(random, "fuzz", scene, outputs, wanted)
    drawn = rotation @ end

    def right(times, level):
        frame, one, two = build(level, own.damping_time)
        motion = frame.respond(times, [(frame.point(two[-1], size * direction), acting)])
        found = {"arm.tip.position": drawn + motion.place(two[-1]) @ rotation.T}
        found["clamp.reaction_moment"] = motion.support(one[0])[1] @ rotation.T
        found["elbow.reaction_moment"] = -motion.section(two, 0)[1] @ rotation.T
        return {name: plane(name, values, space) for name, values in found.items()}

    dynamic = {"clamp.reaction_moment", "elbow.reaction_moment"}
    drawn_at = {"arm.tip.position": plane("x", drawn[None], space)[0]}
    return Case(f"elbow_{s.element}_{'space' if space else 'plane'} {name}", scene, right, drawn_at, dynamic)
