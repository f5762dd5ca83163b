"""Lines in equilibrium: cantilevers that bend far, cables that hang."""

import math

import numpy as np
from drawing import MATERIALS, Case, body, components, finish, plane
from statics import cantilever, catenary


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
        load = {"kind": "distributed_force", "body": "line", "value": components(rotation @ vector / length, space)}
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
        tolerance = [1e-9, 1e-11, 1e-12, 1e-13][level]
        found = cantilever(length, stiffness, s.youngs * s.area, shear, force, moment, load, [0.5, 1.0], tolerance)
        rows = lambda vector: plane("x", (rotation @ vector)[None] * np.ones((len(times), 1)), space)  # noqa: E731
        moments = (rotation @ [0, 0, found[2]])[None] * np.ones((len(times), 1))
        values = {"line.inner.position": rows([*found[0][0, :2], 0]), "line.tip.position": rows([*found[0][1, :2], 0])}
        values["clamp.reaction"] = rows([*-found[1], 0])
        values["clamp.reaction_moment"] = plane("moment", -moments, space)
        return values

    places = {"line.tip.position": length, "line.inner.position": length / 2}
    drawn = {name: plane("x", (rotation @ [at, 0, 0])[None], space)[0] for name, at in places.items()}
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
    kind = f"hung_{'space' if space else 'plane'} {next(iter(line))}"
    return Case(kind, scene, right, {"line.mid.position": drawn}, {"anchor.reaction"})


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
