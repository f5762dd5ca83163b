"""Two bodies with a spring and a damper between them, cut in units in three ways:

FD  the first unit has the spring; motion goes to it, force to the second
DD  both have it; motions go both ways
FF  a unit of its own has it; motions go to it, forces to both"""

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
from references import cantilever_with_sprung_mass

HERE = Path(__file__).parent
FIGURES = json.loads((HERE / "two_masses.json").read_text(encoding="utf-8"))
WAYS = ("FD", "DD", "FF")


class Names(NamedTuple):
    """What a unit calls its variables."""

    position: str
    velocity: str
    force: str
    other_position: str
    other_velocity: str
    pull: str


PARTNER = Names("position", "velocity", "force", "other_position", "other_velocity", "coupling_force")


def port(marker, axis):
    """Names in a scene whose marker has an output and the port `port`."""
    own, outside = ([f"{key}.{kind}[{axis}]" for kind in ("position", "velocity", "force")] for key in (marker, "port"))
    return Names(own[0], own[1], outside[2], outside[0], outside[1], outside[2])


class Body(NamedTuple):
    """A unit that is one of the bodies."""

    fmu: str
    names: Names
    start: dict


def coupled(way, one, two, spring=None):
    """The system that masters are told; `spring` is the FMU and start of the spring of FF."""
    a, b = one.names, two.names
    units = {"one": {"fmu": str(one.fmu), "start": one.start}, "two": {"fmu": str(two.fmu), "start": two.start}}
    connections = []
    if way in ("FD", "DD"):
        connections += [
            [f"two.{b.position}", f"one.{a.other_position}"],
            [f"two.{b.velocity}", f"one.{a.other_velocity}"],
        ]
    if way == "FD":
        connections += [[f"one.{a.pull}", f"two.{b.force}"]]
    if way == "DD":
        connections += [
            [f"one.{a.position}", f"two.{b.other_position}"],
            [f"one.{a.velocity}", f"two.{b.other_velocity}"],
        ]
    if way == "FF":
        units["spring"] = spring
        connections += [
            [f"one.{a.position}", "spring.position_a"],
            [f"one.{a.velocity}", "spring.velocity_a"],
            [f"two.{b.position}", "spring.position_b"],
            [f"two.{b.velocity}", "spring.velocity_b"],
            ["spring.force_a", f"one.{a.force}"],
            ["spring.force_b", f"two.{b.force}"],
        ]
    # For ECCO, which couples two units by the power that goes from one to the other.
    bonds = [[connections[1], connections[2]]] if way == "FD" else []
    return {"units": units, "connections": connections, "bonds": bonds, "outputs": [f"one.{a.position}"]}


class TwoMasses:
    """Two equal masses on springs to the ground: set S1 of the figures."""

    values = FIGURES["masses"]
    output = "position"

    def __init__(self, partners, block=None):
        """Of partners; of scenes where `block` gives an FMU of a mass with a port and its position."""
        self.partners, self.block = Path(partners), block
        s = self.values
        k, d, kc, dc = s["stiffness"], s["damping"], s["coupling_stiffness"], s["coupling_damping"]
        m = s["mass"]
        rates = np.array([[0, 1, 0, 0], [-k - kc, -d - dc, kc, dc], [0, 0, 0, 1], [kc, dc, -k - kc, -d - dc]], float)
        rates[[1, 3]] /= m
        self.roots, self.modes = np.linalg.eig(rates)
        self.weights = np.linalg.solve(self.modes, [s["initial_position"][0], 0, s["initial_position"][1], 0])

    def exact(self, time):
        """Position and velocity of the first mass, then of the second."""
        return ((self.modes * self.weights) @ np.exp(self.roots * time)).real

    def inputs(self, way, time):
        """Exact values of what goes through the connections."""
        x = self.exact(time)
        force = self.values["coupling_stiffness"] * (x[0] - x[2]) + self.values["coupling_damping"] * (x[1] - x[3])
        return {"FD": np.array([x[2], x[3], force]), "DD": x[[2, 3, 0, 1]]}[way]

    def body(self, number, has_spring):
        position = self.values["initial_position"][number]
        if self.block:
            return Body(self.block(has_spring, position), port("block.centre", 1), {})
        keys = ["mass", "stiffness", "damping"] + ["coupling_stiffness", "coupling_damping"] * has_spring
        start = {key: self.values[key] for key in keys}
        return Body(self.partners / "mass.fmu", PARTNER, {**start, "initial_position": position})

    def system(self, way):
        one, two = self.body(0, way in ("FD", "DD")), self.body(1, way == "DD")
        return coupled(way, one, two, spring(self.partners, self.values))


def spring(partners, values):
    """A partner between two bodies."""
    start = {"stiffness": values["coupling_stiffness"], "damping": values["coupling_damping"]}
    return {"fmu": str(Path(partners) / "spring_damper.fmu"), "start": start}


def edited(name, **changes):
    """A scene of the tests with changes; null leaves a key out."""
    scene = json.loads((HERE / "scenes" / f"{name}.json").read_text(encoding="utf-8"))
    return {key: value for key, value in {**scene, **changes}.items() if value is not None}


def mass_scene(has_spring, position):
    """One of the masses of S1 as a scene, with a port that has the spring or none."""
    s = TwoMasses.values
    block = edited("load")["bodies"][0]
    wall = {"kind": "spring_damper", "name": "wall", "markers": ["ground", "block.centre"], "point": [-10.0, 0.0]}
    return edited(
        "load",
        bodies=[{**block, "mass": s["mass"], "position": [position, 0.0]}],
        loads=[{**wall, "length": 10.0, "stiffness": s["stiffness"], "damping": s["damping"]}],
        ports=[port_of("block.centre", s if has_spring else None)],
        inputs=None,
    )


def port_of(marker, spring):
    """The port of a scene: force in and motion out, or with a spring motion in and force out."""
    if spring is None:
        return {"name": "port", "marker": marker, "kind": "force"}
    owned = {"stiffness": spring["coupling_stiffness"], "damping": spring["coupling_damping"]}
    return {"name": "port", "marker": marker, "kind": "motion", **owned}


class BeamAndMass:
    """A mass thrown against the tip of a cantilever, with a stiff spring between them."""

    mass, velocity = 0.5, 0.01
    values = {"coupling_stiffness": 2000.0, "coupling_damping": 2.0}
    damping_time = 2e-4
    # Of the mode in which the mass moves against the tip, s: closed form without damping.
    period = 0.05188
    # FD with the spring in the beam's port, then in the mass.
    ways = ("FD", "FD'", "FF")

    @classmethod
    def closed_form(cls, stop):
        """Where beam and mass would be without damping, from the modes of both."""
        return cantilever_with_sprung_mass(
            length=1.0,
            bending_stiffness=175.0,
            line_density=0.785,
            stiffness=cls.values["coupling_stiffness"],
            mass=cls.mass,
            velocity=cls.velocity,
            stop=stop,
        )

    def __init__(self, partners, beam):
        """`beam` gives an FMU of the beam with a port that has the spring or none."""
        self.partners, self.beam = Path(partners), beam

    @classmethod
    def beam_scene(cls, has_spring):
        return edited("beam", bodies=[cls.flexible()], ports=[port_of("beam.tip", cls.values if has_spring else None)], inputs=None)

    @classmethod
    def flexible(cls, damping_time=damping_time):
        body = edited("beam")["bodies"][0]
        return {**body, "material": {**body["material"], "damping_time": damping_time}}

    @classmethod
    def whole_scene(cls, is_damped):
        """Both in one scene, the mass a metre below the tip: the spring is upright but for the square of the motion."""
        block, rail = edited("load")["bodies"][0], edited("load")["joints"][0]
        block = {**block, "mass": cls.mass, "position": [1.0, -1.0], "motion": {"velocity": [0.0, cls.velocity]}}
        spring = {"kind": "spring_damper", "name": "spring", "markers": ["block.centre", "beam.tip"]}
        owned = {"stiffness": cls.values["coupling_stiffness"], "damping": cls.values["coupling_damping"] * is_damped}
        return edited(
            "beam",
            bodies=[cls.flexible(cls.damping_time * is_damped), block],
            joints=[*edited("beam")["joints"], {**rail, "direction": [0.0, 1.0]}],
            loads=[{**spring, **owned, "length": 1.0}],
            inputs=None,
            accuracy={"relative_tolerance": 1e-9},
        )

    def system(self, way):
        owner = {"FD": "beam", "FD'": "mass", "FF": "none"}[way]
        start = {"mass": self.mass, "initial_velocity": self.velocity, **(self.values if owner == "mass" else {})}
        beam = Body(self.beam(owner == "beam"), port("beam.tip", 2), {})
        mass = Body(self.partners / "mass.fmu", PARTNER, start)
        one, two = (mass, beam) if way == "FD'" else (beam, mass)
        return coupled(way[:2], one, two, spring(self.partners, self.values))
