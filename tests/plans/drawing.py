"""What random scenes are drawn from: numbers, bodies, courses of loads, and how they are written."""

import math
from dataclasses import dataclass, field

import numpy as np
from frame import Course, Section

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


def plane(name, values, space):
    """The components that a scene of the plane has."""
    if space:
        return values
    return values[:, 2:3] if name.endswith("moment") else values[:, :2]
