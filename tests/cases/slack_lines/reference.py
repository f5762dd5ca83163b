"""Scenes of slack lines and forces at their ends: Irvine's elastic catenary, solved by Newton's method.

`python reference.py` writes the scenes and `case.json` beside it.
"""

import json
import math
import pathlib

MODULUS, DENSITY, AREA, GRAVITY = 7.70085e10, 7850.0, 1.2985579513949757e-05, 9.81
# Span and height of the ends, azimuth of the plane in space or nothing, length, elements, shape as drawn, whether a winch holds it.
LINES = {
    "scene": (0.9, 0.0, None, 1.0, 128, "line", False),
    "narrow": (0.479, 0.0, None, 1.0, 64, "line", False),
    "inclined": (24.918, -14.605, 0.7, 30.0, 64, "line", False),
    "inclined_coarse": (0.63, -0.173, 4.2, 1.0, 24, "line", False),
    "winch": (0.798, 0.0, None, 1.0, 32, "line", True),
    "winch_fine": (848.67, 250.0, None, 902.2, 384, "line", True),
    "level": (477.762, 0.0, None, 900.0, 32, "line", False),
}


def catenary(span, height, length):
    """Horizontal and vertical force at the second end, N."""
    weight, stiffness = DENSITY * AREA * GRAVITY, MODULUS * AREA

    def missing(h, v):
        low, high = (v - weight * length) / h, v / h
        x = h * length / stiffness + h / weight * (math.asinh(high) - math.asinh(low))
        y = length / stiffness * (v - weight * length / 2) + h / weight * (math.hypot(1, high) - math.hypot(1, low))
        return x - span, y - height

    slack = math.sqrt(3 * ((length**2 - height**2) / span**2 - 1))
    h, v = weight * span / 2 / slack, weight / 2 * (height / math.tanh(slack) + length)
    for _ in range(200):
        x, y = missing(h, v)
        small = 1e-7
        by_h = [(b - a) / (h * small) for a, b in zip((x, y), missing(h * (1 + small), v))]
        by_v = [(b - a) / (weight * length * small) for a, b in zip((x, y), missing(h, v + weight * length * small))]
        pivot = by_h[0] * by_v[1] - by_v[0] * by_h[1]
        change = (by_v[0] * y - x * by_v[1]) / pivot, (x * by_h[1] - by_h[0] * y) / pivot
        part = 1.0
        while h + part * change[0] <= 0.2 * h:
            part /= 2
        h, v = h + part * change[0], v + part * change[1]
    assert math.hypot(*missing(h, v)) < 1e-8 * length
    return h, v


def scene(name, line):
    span, height, azimuth, length, elements, drawn, has_winch = line
    assert drawn == "line"

    def place(x, z):
        return [x, z] if azimuth is None else [x * math.cos(azimuth), x * math.sin(azimuth), z]

    kind = "revolute" if azimuth is None else "spherical"
    scene = {
        "name": f"slack_lines_{name}",
        "dimension": 2 if azimuth is None else 3,
        "gravity": place(0.0, -GRAVITY),
        "bodies": [
            {
                "name": "line",
                "element": "cable",
                "material": {"youngs_modulus": MODULUS, "density": DENSITY},
                "section": {"area": AREA, "second_moment": 0.0},
                "shape": {"line": {"from": place(0.0, 0.0), "to": place(length, 0.0)}},
                "markers": {"anchor": 0.0, "top": 1.0},
                "elements": elements,
            }
        ],
        "joints": [
            {"name": "anchor", "kind": kind, "markers": ["ground", "line.anchor"], "point": place(0.0, 0.0)},
            {"name": "fairlead", "kind": kind, "markers": ["ground", "line.top"], "point": place(span, height)},
        ],
        "outputs": [{"kind": "reaction", "joint": "anchor"}, {"kind": "reaction", "joint": "fairlead"}],
        "initial": "static_equilibrium",
        "experiment": {"stop_time": 1.0, "step": 1.0},
    }
    if has_winch:
        scene["motions"] = [{"name": "winch", "kind": "winch", "marker": "line.top", "value": "0.01*t*t"}]
    h, v = catenary(span, height, length)
    forces = {"anchor": place(-h, DENSITY * AREA * GRAVITY * length - v), "fairlead": place(h, v)}
    values = {f"{joint}.reaction[{k + 1}]": part for joint, force in forces.items() for k, part in enumerate(force)}
    claim = {
        "kind": "values",
        "scene": f"{name}.json",
        "values": values,
        "relative": 0.001,
        "scale": math.hypot(h, v),
        "note": f"ends {span} m apart and {height} m up, length {length} m, {elements} elements",
    }
    return scene, claim


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    claims = []
    for name, line in LINES.items():
        described, claim = scene(name, line)
        (here / f"{name}.json").write_text(json.dumps(described, indent=2) + "\n")
        claims.append(claim)
    case = {
        "purpose": "Slack lines drawn straight, between ends nearer than they are long: found whatever the mesh",
        "source": "elastic catenary, Irvine's closed form solved by Newton's method: reference.py",
        "scene": "scene.json",
        "claims": claims,
    }
    (here / "case.json").write_text(json.dumps(case, indent=2) + "\n")
