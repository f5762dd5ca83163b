"""Random small scenes, each with the values of its outputs by a reference that the program has no part in."""

import math
from dataclasses import dataclass, field

import numpy as np
from frame import Course, Frame, Section
from statics import cantilever, catenary

MATERIALS = [(2.1e11, 7850.0), (7e10, 2700.0), (3e9, 1200.0), (5e6, 1000.0)]
# Places of markers are twelfths, where nodes of all references are.
TWELFTHS = 12


@dataclass
class Case:
    """A scene, what a run of it gets as inputs, and the right values of its outputs."""

    kind: str
    scene: dict
    # `right(times, level)` gives name to values `[times][components]`; level 1 has twice the elements of level 0.
    right: object
    # Places at which markers are drawn, of positions.
    drawn: dict
    # Outputs that follow at once from loads: their first instant does not count.
    dynamic: set
    inputs: list = field(default_factory=list)

    @property
    def wanted(self):
        return self.scene["accuracy"]["error"]

    @property
    def counted(self):
        return self.scene["accuracy"].get("of") or sorted({*self.drawn, *self.dynamic})


class Random:
    """Draws of one seed."""

    def __init__(self, seed):
        self.generator = np.random.default_rng([37, seed])

    def between(self, low, high):
        return float(self.generator.uniform(low, high))

    def wide(self, low, high):
        return float(10 ** self.generator.uniform(math.log10(low), math.log10(high)))

    def one(self, choices):
        return choices[int(self.generator.integers(len(choices)))]

    def chance(self, share):
        return self.generator.random() < share

    def rotation(self):
        """A rotation matrix of space."""
        matrix, upper = np.linalg.qr(self.generator.normal(size=(3, 3)))
        matrix = matrix * np.sign(np.diag(upper))
        return matrix * np.linalg.det(matrix)

    def turn(self):
        """A rotation matrix of the plane, as one of space; often none."""
        angle = self.one([0.0, self.between(-math.pi, math.pi)])
        return np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1.0]])


@dataclass
class Body:
    """A straight body: its length, section and how it is written in a scene."""

    length: float
    section: Section
    damping_time: float
    space: bool

    def written(self, name, start, end, axis=None, markers=None):
        s = self.section
        material = {"youngs_modulus": s.youngs, "density": s.density, "damping_time": self.damping_time}
        section = {"area": s.area}
        if s.element == "cable" or not self.space:
            section["second_moment"] = s.i2
        else:
            section |= {"second_moments": [s.i1, s.i2], "torsion_constant": s.torsion}
        if s.element != "cable":
            material["shear_modulus"] = s.shear
        if s.element == "beam":
            section |= {"shear_factors": list(s.factors)} if self.space else {"shear_factor": s.factors[0]}
        shape = {"line": {"from": list(start), "to": list(end)}}
        body = {"name": name, "element": s.element, "material": material, "section": section, "shape": shape}
        if self.space and s.element != "cable":
            body["axis"] = list(axis)
        return body | {"markers": markers or {"root": 0.0, "tip": 1.0}}


def body(random, space, slender=(20, 300), elements=None):
    """A body of any size."""
    length = random.wide(1e-3, 1e3)
    youngs, density = random.one(MATERIALS)
    element = random.one(elements or (["cable", "rod", "beam"] if space else ["cable", "cable", "beam"]))
    ratio = random.wide(6, 60) if element == "beam" else random.wide(*slender)
    height = length / ratio
    width = height * (random.between(0.5, 2) if element != "cable" else 1.0)
    # Along the first axis the width is seen by the second moment about the second.
    i1, i2 = width * height**3 / 12, height * width**3 / 12
    shear = youngs / 2.6
    factors = (0.85, 0.8)
    section = Section(youngs, density, width * height, i1, i2, shear, random.between(0.5, 0.9) * (i1 + i2), factors, element)
    return Body(length, section, 0.0, space)


def course(random, name, period):
    """A course by name for a first period: as a reference and as an expression of a scene, both from 0 to 1."""
    if name == "at once":
        return Course((("one", 1.0, 0.0, 0.0),)), "1"
    if name == "ramp":
        time = random.between(0.3, 3) * period
        return Course((("ramp", 1 / time, 0.0, 0.0), ("ramp", -1 / time, time, 0.0))), f"min(t/{time!r},1)"
    if name == "harmonic":
        omega = random.one([0.9, 0.9, 0.3, 1.1]) * 2 * math.pi / period
        return Course((("sin", 1.0, 0.0, omega),)), f"sin({omega!r}*t)"
    if name == "kick":
        time = random.between(0.1, 0.4) * period
        omega = math.pi / time
        return Course((("sin", 1.0, 0.0, omega), ("sin", 1.0, time, omega))), f"if({time!r}-t,sin({omega!r}*t),0)"
    raise ValueError(name)


def components(vector, space):
    return [float(part) for part in vector[: 3 if space else 2]]


def finish(random, name, scene, outputs, wanted):
    """Writes what is asked of a scene; half of them count one output."""
    scene["name"] = name
    scene["outputs"] = [written for written, _ in outputs]
    scene["accuracy"] = {"error": wanted}
    if random.chance(0.5):
        scene["accuracy"]["of"] = [random.one([name for _, name in outputs])]


def amplitude(random, wanted):
    """A deflection over the length that is small enough for straight theory: its square and sine do not count."""
    return random.wide(1e-8, 0.05 * wanted)


def experiment(random, period, periods):
    """About twenty-five rows a period."""
    step = float(f"{period / random.between(18, 40):.3g}")
    return {"stop_time": step * max(60, round(random.between(*periods) * period / step)), "step": step}


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
            {"name": "roller", "kind": "slider", "markers": ["ground", "line.tip"], "direction": along},
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
        load, vector = {"kind": "distributed", "body": "line"}, components(rotation @ total / length, space)
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


def plane(name, values, space):
    """The components that a scene of the plane has."""
    if space:
        return values
    return values[:, 2:3] if name.endswith("moment") else values[:, :2]


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
    shaft = {"name": "shaft", "kind": "hinge", "markers": ["ground", "hub.c"], "stiffness": stiffness, "angle": angle}
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
    acceleration = Course(tuple(("cos", -factor * own_omega**2, delay, w) for kind, factor, delay, w in moved.terms if kind == "cos"))
    scene = {"dimension": 2, "experiment": experiment(random, period, (3, 10))}
    base = {"name": "base", "element": "rigid", "mass": s.density * s.area * length, "inertia": s.density * s.area * length**3}
    scene["bodies"] = [base | {"position": [0.0, 0.0], "markers": {"c": [0.0, 0.0]}}, own.written("line", [0.0, 0.0], [length, 0.0])]
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


def bent(random):
    """A cantilever in equilibrium, bent by up to half its length and more, or hardly at all."""
    space = random.chance(0.3)
    wanted = random.one([1e-2, 1e-3])
    own = body(random, space, slender=(50, 1000))
    length, s = own.length, own.section
    rotation = random.rotation() if space else random.turn()
    # In space the load is along the second axis, and what bends turns about the first.
    stiffness = s.youngs * (s.i1 if space else s.i2)
    size = random.wide(1e-7, 12) * stiffness / length**2
    shape = random.one(["force", "force", "uniform", "moment"])
    if space and s.element == "cable" and shape == "moment":
        shape = "force"
    angle = math.pi / 2 + random.between(-0.7, 0.7) * (size * length**2 / stiffness > 1e-2)
    vector = size * np.array([math.cos(angle), math.sin(angle), 0])
    moment = size * length if shape == "moment" else 0.0
    scene = {"dimension": 3 if space else 2, "experiment": {"stop_time": 0.01, "step": 0.01}, "initial": "static_equilibrium"}
    axis = components(rotation @ [0, 0, 1.0], True)
    end = rotation @ [length, 0, 0]
    markers = {"root": 0.0, "tip": 1.0, "inner": 0.5}
    scene["bodies"] = [own.written("line", [0.0] * (3 if space else 2), components(end, space), axis, markers)]
    scene["joints"] = [{"name": "clamp", "kind": "weld", "markers": ["ground", "line.root"]}]
    if shape == "force":
        load = {"kind": "force", "marker": "line.tip", "value": components(rotation @ vector, space)}
    elif shape == "uniform":
        load = {"kind": "distributed", "body": "line", "value": components(rotation @ vector / length, space)}
    else:
        load = {"kind": "moment", "marker": "line.tip"}
        load["value"] = components(rotation @ [0, 0, moment], True) if space else moment
    scene["loads"] = [load | {"name": "load"}]
    outputs = [({"kind": "position", "marker": "line.tip"}, "line.tip.position")]
    outputs.append(({"kind": "position", "marker": "line.inner"}, "line.inner.position"))
    if shape != "moment":
        outputs.append(({"kind": "reaction", "joint": "clamp"}, "clamp.reaction"))
    if not (space and s.element == "cable"):
        outputs.append(({"kind": "reaction_moment", "joint": "clamp"}, "clamp.reaction_moment"))
    finish(random, "fuzz", scene, outputs, wanted)
    shear = s.shear * s.area * s.factors[1 if space else 0] if s.element == "beam" else None
    at = {"force": vector[:2], "uniform": vector[:2] / length}
    none = np.zeros(2)

    def right(times, level):
        force, load = at["force"] if shape == "force" else none, at["uniform"] if shape == "uniform" else none
        found = cantilever(length, stiffness, s.youngs * s.area, shear, force, moment, load, [0.5, 1.0], [1e-9, 1e-11, 1e-12, 1e-13][level])
        rows = lambda vector: plane("x", (rotation @ vector)[None] * np.ones((len(times), 1)), space)  # noqa: E731
        moments = (rotation @ [0, 0, found[2]])[None] * np.ones((len(times), 1))
        values = {"line.inner.position": rows([*found[0][0, :2], 0]), "line.tip.position": rows([*found[0][1, :2], 0])}
        values["clamp.reaction"] = rows([*-found[1], 0])
        values["clamp.reaction_moment"] = plane("moment", -moments, space)
        return values

    drawn = {f"line.{name}.position": plane("x", (rotation @ [share * length, 0, 0])[None], space)[0] for name, share in [("tip", 1.0), ("inner", 0.5)]}
    names = {name for _, name in outputs} - set(drawn)
    return Case(f"bent_{s.element}_{'space' if space else 'plane'} {shape}", scene, right, drawn, names)


def hung(random):
    """A cable without bending stiffness between two points, drawn as an arc or straight."""
    space = random.chance(0.4)
    wanted = random.one([1e-2, 1e-3])
    length = random.wide(1e-2, 1e3)
    area = (length / random.wide(100, 3000)) ** 2
    youngs, density = random.one(MATERIALS[:3])
    slack = random.one([random.between(0.3, 0.98), random.between(0.3, 0.98), random.between(0.99, 0.999)])
    angle = random.one([0.0, random.between(-0.8, 0.8)])
    span, rise = slack * length * math.cos(angle), slack * length * math.sin(angle)
    heading = random.between(0, 2 * math.pi) if space else 0.0
    weight = density * area * 9.81

    def spread(x, z):
        return [x * math.cos(heading), x * math.sin(heading), z] if space else [x, z]

    line = {"arc": {"from": spread(0.0, 0.0), "to": spread(span, rise), "length": length}}
    if random.chance(0.3):
        straight = length / (slack * length)
        line = {"line": {"from": spread(0.0, 0.0), "to": spread(span * straight, rise * straight)}}
    scene = {"dimension": 3 if space else 2, "gravity": spread(0.0, -9.81), "initial": "static_equilibrium"}
    scene["experiment"] = {"stop_time": 0.01, "step": 0.01}
    material = {"youngs_modulus": youngs, "density": density}
    own = {"name": "line", "element": "cable", "material": material, "section": {"area": area, "second_moment": 0.0}}
    scene["bodies"] = [own | {"shape": line, "markers": {"a": 0.0, "mid": 0.5, "b": 1.0}}]
    ball = "spherical" if space else "revolute"
    scene["joints"] = [
        {"name": "anchor", "kind": ball, "markers": ["ground", "line.a"], "point": spread(0.0, 0.0)},
        {"name": "fairlead", "kind": ball, "markers": ["ground", "line.b"], "point": spread(span, rise)},
    ]
    outputs = [({"kind": "position", "marker": "line.mid"}, "line.mid.position")]
    outputs.append(({"kind": "reaction", "joint": "anchor"}, "anchor.reaction"))
    finish(random, "fuzz", scene, outputs, wanted)

    def right(times, level):
        places, support = catenary(length, weight, youngs * area, span, rise, [0.5])
        rows = np.ones((len(times), 1))
        return {"line.mid.position": np.array(spread(*places[0])) * rows, "anchor.reaction": np.array(spread(*support)) * rows}

    if "line" in line:
        drawn = np.array(spread(span * straight / 2, rise * straight / 2))
    else:
        drawn = arc_middle(np.array(spread(0.0, 0.0)), np.array(spread(span, rise)), length)
    return Case(f"hung_{'space' if space else 'plane'} {next(iter(line))}", scene, right, {"line.mid.position": drawn}, {"anchor.reaction"})


def arc_middle(start, end, length):
    """The middle of a circular arc that sags."""
    chord = np.linalg.norm(end - start)
    low, high = 1e-9, math.pi - 1e-12
    for _ in range(200):
        half = (low + high) / 2
        low, high = (half, high) if math.sin(half) / half > chord / length else (low, half)
    along = (end - start) / chord
    down = np.zeros(len(start))
    down[-1] = -1.0
    down -= along * (along @ down)
    down /= np.linalg.norm(down)
    return (start + end) / 2 + down * (length / (2 * half)) * (1 - math.cos(half))


KINDS = [loaded_line, loaded_line, loaded_line, input_at_rest, motor, moved_support, elbow, bent, bent, hung]


def case(seed):
    """The case of a seed."""
    random = Random(seed)
    return KINDS[seed % len(KINDS)](random)
