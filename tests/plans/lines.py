"""Lines that are clamped or on two supports, loaded across, at once or by inputs that rested while the unit was planned."""

import math

import numpy as np
from drawing import TWELFTHS, Case, amplitude, body, components, course, experiment, finish, plane
from frame import Frame


def loaded_line(random, at_rest=False):
    """A cantilever or a beam between a pin and a roller, with a mass or a spring or none, loaded across."""
    space = random.chance(0.45)
    wanted = random.one([1e-2, 1e-3])
    own = body(random, space)
    length, s = own.length, own.section
    rotation = random.rotation() if space else random.turn()
    held = "clamp" if space or random.chance(0.7) else "pins"
    extra = random.one(["", "", "", "mass", "spring"]) if held == "clamp" else ""
    where = 12 if held == "clamp" else random.one([3, 4, 6, 8])
    mass = random.wide(0.05, 5) * s.density * s.area * length
    stiffness = random.wide(0.3, 10) * 3 * s.youngs * min(s.i1, s.i2) / length**3
    # Along the first axis, which is what the plane knows.
    direction = np.array([0.0, 1.0, 0.0])
    if space:
        angle = random.between(0, 2 * math.pi)
        direction = np.array([0.0, math.cos(angle), math.sin(angle)])
    shape = random.one(["point", "point", "moment", "uniform"])
    if shape == "moment" and ((space and s.element == "cable") or at_rest):
        shape = "point"
    twist = random.chance(0.3) and space and s.element != "cable" and shape == "moment"

    def build(level, damping_time):
        frame = Frame(damping_time, planar=not space)
        ends = frame.node(), frame.node()
        nodes = frame.line(*ends, (0, 0, 0), (length, 0, 0), 24 * 2**level, s)
        frame.hold(ends[0], range(6) if held == "clamp" else (0, 1, 2, 3))
        if held == "pins":
            frame.hold(ends[1], (1, 2))
        if extra == "mass":
            frame.mass(ends[1], mass)
        if extra == "spring":
            frame.spring(ends[1], 1, stiffness)
        return frame, nodes

    frame, _ = build(0, 0.0)
    omega = frame.modes()[0]
    if extra == "spring" and space:
        extra = ""
        omega = build(0, 0.0)[0].modes()[0]
    period = 2 * math.pi / float(omega[0])
    name = random.one(["at once", "ramp", "harmonic", "kick"])
    if at_rest:
        name = random.one(["at once", "ramp"])
    damped = extra != "spring" and (name in ("at once", "kick") or random.chance(0.4))
    if extra == "spring" and name in ("at once", "kick"):
        name = "ramp"
    tau = 2 * random.wide(0.005, 0.05) / omega[0] if damped else 0.0
    own.damping_time = float(f"{tau:.4g}")
    acting, text = course(random, name, period)
    position = where / TWELFTHS
    inner = random.one([0, 3, 6, 8]) if held == "clamp" else random.one([3, 6, 8])

    def loads(frame, nodes, size):
        node = nodes[where * (len(nodes) - 1) // TWELFTHS]
        if shape == "uniform":
            return frame.uniform(nodes, size * direction / length)
        if shape == "moment":
            return frame.point(node, (0, 0, 0), size * length * turning)
        return frame.point(node, size * direction)

    turning = np.array([1.0, 0, 0]) if twist else np.array([0, -direction[2], direction[1]])
    if shape == "moment" and not space:
        turning = np.array([0.0, 0.0, 1.0])
    # The size of the load from the deflection wanted.
    frame, nodes = build(0, own.damping_time)
    k, _, _, free = frame.assemble()
    unit = np.zeros(frame.count)
    unit[free] = np.linalg.solve(k[np.ix_(free, free)], loads(frame, nodes, 1.0)[free])
    largest = max(np.abs(unit[i]) * (length if i % 6 > 2 else 1.0) for i in range(frame.count))
    size = float(amplitude(random, wanted) * length / largest)
    if name == "harmonic" and not damped:
        size *= 0.1

    experiment_ = experiment(random, period, (3, 12))
    markers = {"root": 0.0, "tip": 1.0, "load": position, "inner": inner / TWELFTHS}
    if extra == "spring":
        markers["tip"] = 1.0
    scene = {"dimension": 3 if space else 2, "experiment": experiment_}
    start, end = rotation @ [0, 0, 0], rotation @ [length, 0, 0]
    axis = [float(part) for part in rotation @ [0, 0, 1.0]]
    written = own.written("line", components(start, space), components(end, space), axis, markers)
    scene["bodies"] = [written]
    if held == "clamp":
        scene["joints"] = [{"name": "clamp", "kind": "weld", "markers": ["ground", "line.root"]}]
    else:
        along = components(rotation @ [1, 0, 0], space)
        scene["joints"] = [
            {"name": "clamp", "kind": "revolute", "markers": ["ground", "line.root"]},
            {"name": "roller", "kind": "point_on_line", "markers": ["ground", "line.tip"], "direction": along},
        ]
    scene["loads"] = []
    if extra == "mass":
        scene["masses"] = [{"marker": "line.tip", "mass": mass}]
    if extra == "spring":
        across = rotation @ [length, 1.0 * length, 0]
        spring = {"name": "stay", "kind": "spring_damper", "markers": ["ground", "line.tip"]}
        scene["loads"].append(spring | {"stiffness": stiffness, "point": components(across, space)})
    total = size * direction
    if shape == "uniform":
        load, vector = {"kind": "distributed_force", "body": "line"}, components(rotation @ total / length, space)
    elif shape == "moment":
        vector = components(rotation @ turning * size * length, space)
        load = {"kind": "moment", "marker": "line.load"}
        vector = vector if space else size * length
    else:
        load, vector = {"kind": "force", "marker": "line.load"}, components(rotation @ total, space)
    inputs = []
    if at_rest:
        inputs = moved_inputs(random, load, shape, vector, name, acting, experiment_)
        scene["inputs"] = [load]
    else:
        value = [f"{part!r}*{text}" for part in vector] if isinstance(vector, list) else f"{vector!r}*{text}"
        if name == "at once":
            value = vector
        scene["loads"].append(load | {"name": "load", "value": value})

    watched = random.one(["tip", "load", "inner"]) if held == "clamp" else "load"
    if markers[watched] == 0.0:
        watched = "tip"
    outputs = [({"kind": "position", "marker": f"line.{watched}"}, f"line.{watched}.position")]
    undamped_start = name in ("at once", "kick") and not damped
    if not undamped_start:
        if damped:
            outputs.append(({"kind": "reaction", "joint": "clamp"}, "clamp.reaction"))
        if held == "clamp" and not (space and s.element == "cable"):
            outputs.append(({"kind": "reaction_moment", "joint": "clamp"}, "clamp.reaction_moment"))
        if (shape != "moment" or name != "at once") and not (space and s.element == "cable"):
            outputs.append(({"kind": "bending_moment", "marker": "line.inner"}, "line.inner.bending_moment"))
    wanted_name = f"{held}_{s.element}_{'space' if space else 'plane'}"
    finish(random, "fuzz", scene, outputs, wanted)
    drawn_at = rotation @ [markers[watched] * length, 0, 0]

    def right(times, level):
        frame, nodes = build(level, own.damping_time)
        number = len(nodes) - 1
        motion = frame.respond(times, [(loads(frame, nodes, size), acting)])
        seen = nodes[int(round(markers[watched] * number))]
        force, moment = motion.support(nodes[0])
        spread = (size * direction / length, acting.at(times)) if shape == "uniform" else None
        within = motion.section(nodes, min(inner * number // TWELFTHS, number - 1), spread)[1]
        found = {f"line.{watched}.position": drawn_at + motion.place(seen) @ rotation.T, "clamp.reaction": force @ rotation.T}
        found["clamp.reaction_moment"] = moment @ rotation.T
        found["line.inner.bending_moment"] = within @ rotation.T
        return {name: plane(name, values, space) for name, values in found.items()}

    label = f"{wanted_name} {shape} {name}{' ' + extra if extra else ''}{' damped' if damped else ''}"
    if at_rest:
        label = f"at_rest {label}"
    dynamic = {name for _, name in outputs} - {f"line.{watched}.position"}
    case = Case(label, scene, right, {f"line.{watched}.position": plane("x", drawn_at[None], space)[0]}, dynamic)
    case.inputs = inputs
    return case


def moved_inputs(random, load, shape, vector, name, acting, experiment):
    """A table of inputs that rest while the unit is planned; `name` is what they do then."""
    variable = "line.load.force" if shape == "point" else "line.distributed_force"
    names = [f"{variable}[{i + 1}]" for i in range(len(vector))]
    stop = experiment["stop_time"]
    corners = [0.0, *(delay for _, _, delay, _ in acting.terms if 0 < delay < stop), stop]
    rows = [[time, *(part * acting.at(np.array([time, stop]))[0] for part in vector)] for time in corners]
    return [["time", *names], *rows]


def input_at_rest(random):
    return loaded_line(random, at_rest=True)
