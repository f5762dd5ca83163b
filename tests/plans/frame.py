"""Small vibrations of frames: fine finite elements, integrated exactly in time mode by mode.

Bodies are straight lines of elements with three displacements and three rotations a node. Transverse displacements are
those of Friedman and Kosmatka (1993): cubic, exact in static bending with shear; without shear they are Hermite's.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

GAUSS, WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(5))
GAUSS = GAUSS + 0.5


@dataclass(frozen=True)
class Section:
    """A cross section with its material. `i1` is the second moment about the first axis, `i2` about the second."""

    youngs: float
    density: float
    area: float
    i1: float
    i2: float
    shear: float = 0.0
    torsion: float = 0.0
    factors: tuple = (0.0, 0.0)
    element: str = "cable"


def bending(length, stiffness, shear_stiffness, mass, rotary):
    """Stiffness, mass and load of a uniform force per length, of `(w1, w1', w2, w2')` of an element."""
    phi = 12 * stiffness / (shear_stiffness * length**2) if shear_stiffness else 0.0
    total = 1 + phi
    k, m, load = np.zeros((4, 4)), np.zeros((4, 4)), np.zeros(4)
    for x, weight in zip(GAUSS, WEIGHTS, strict=True):
        w = np.array([
            2 * x**3 - 3 * x**2 - phi * x + total,
            length * (x**3 - (2 + phi / 2) * x**2 + (1 + phi / 2) * x),
            -(2 * x**3 - 3 * x**2 - phi * x),
            length * (x**3 - (1 - phi / 2) * x**2 - phi / 2 * x),
        ]) / total
        slope = np.array([
            6 * x**2 - 6 * x - phi,
            length * (3 * x**2 - (4 + phi) * x + 1 + phi / 2),
            -(6 * x**2 - 6 * x - phi),
            length * (3 * x**2 - (2 - phi) * x - phi / 2),
        ]) / (total * length)
        turn = np.array([
            6 * (x**2 - x) / length,
            3 * x**2 - (4 + phi) * x + total,
            -6 * (x**2 - x) / length,
            3 * x**2 - (2 - phi) * x,
        ]) / total
        bend = np.array([
            6 * (2 * x - 1) / length,
            6 * x - 4 - phi,
            -6 * (2 * x - 1) / length,
            6 * x - 2 + phi,
        ]) / (total * length)
        k += weight * length * (stiffness * np.outer(bend, bend) + shear_stiffness * np.outer(slope - turn, slope - turn))
        m += weight * length * (mass * np.outer(w, w) + rotary * np.outer(turn, turn))
        load += weight * length * w
    return k, m, load


def element(section, length):
    """Stiffness, mass and the loads of uniform forces along the axes, in local axes: tangent, first, second axis."""
    k, m, load = np.zeros((12, 12)), np.zeros((12, 12)), np.zeros((12, 3))
    bar, consistent = np.array([[1, -1], [-1, 1]]), np.array([[2, 1], [1, 2]]) / 6
    line = np.ix_([0, 6], [0, 6])
    k[line] = section.youngs * section.area / length * bar
    m[line] = section.density * section.area * length * consistent
    load[[0, 6], 0] = length / 2
    if section.element != "cable":
        twist = np.ix_([3, 9], [3, 9])
        k[twist] = section.shear * section.torsion / length * bar
        m[twist] = section.density * (section.i1 + section.i2) * length * consistent
    leans = section.element == "beam"
    # Along the first axis sections turn about the second; along the second, backwards about the first.
    for axis, places, moment, sign in [(1, [1, 5, 7, 11], section.i2, 1), (2, [2, 4, 8, 10], section.i1, -1)]:
        shear = section.shear * section.area * section.factors[axis - 1] if leans else 0.0
        rotary = section.density * moment if leans else 0.0
        own = bending(length, section.youngs * moment, shear, section.density * section.area, rotary)
        signs = np.array([1, sign, 1, sign])
        k[np.ix_(places, places)] = own[0] * np.outer(signs, signs)
        m[np.ix_(places, places)] = own[1] * np.outer(signs, signs)
        load[places, axis] = own[2] * signs
    return k, m, load


class Frame:
    """Lines of elements, lumped masses and springs. All lines have the damping time of the frame."""

    def __init__(self, damping_time=0.0, planar=False):
        self.damping_time, self.planar = damping_time, planar
        self.elements, self.lumped, self.springs = [], [], []
        self.fixed, self.count = set(), 0

    def node(self):
        """A node of six numbers of its own."""
        self.count += 6
        return list(range(self.count - 6, self.count))

    def line(self, first, last, start, end, number, section, axis=(0, 0, 1)):
        """A body; `first` and `last` are its end nodes. Gives its nodes."""
        start, end, axis = (np.asarray(part, float) for part in (start, end, axis))
        tangent = (end - start) / np.linalg.norm(end - start)
        if self.planar:
            # What a scene of the plane gives is for bending in it: by the second moment about the second axis.
            axis = np.cross([0, 0, 1], tangent)
        one = axis - tangent * (axis @ tangent)
        one /= np.linalg.norm(one)
        rotation = np.array([tangent, one, np.cross(tangent, one)])
        full = np.kron(np.eye(4), rotation)
        nodes = [first, *(self.node() for _ in range(number - 1)), last]
        own = element(section, np.linalg.norm(end - start) / number)
        k, m = (full.T @ part @ full for part in own[:2])
        load = full.T @ own[2] @ rotation
        for before, after in zip(nodes, nodes[1:], strict=False):
            self.elements.append((before + after, k, m, load))
            if section.element == "cable" and not self.planar:
                self.hold(before, [3]), self.hold(after, [3])
        return nodes

    def hold(self, node, places):
        self.fixed |= {node[place] for place in places}

    def mass(self, node, mass, inertia=(0, 0, 0)):
        self.lumped += [(node[i], value) for i, value in enumerate([mass] * 3 + list(inertia)) if value]

    def spring(self, node, place, stiffness):
        self.springs.append((node[place], stiffness))

    def assemble(self):
        """Stiffness, stiffness of bodies alone, mass; the numbers that are free."""
        k, m = np.zeros((self.count, self.count)), np.zeros((self.count, self.count))
        for places, own_k, own_m, _ in self.elements:
            where = np.ix_(places, places)
            k[where] += own_k
            m[where] += own_m
        if self.planar:
            self.fixed |= {i for i in range(self.count) if i % 6 in (2, 3, 4)}
        elastic = k.copy()
        for place, value in self.lumped:
            m[place, place] += value
        for place, value in self.springs:
            k[place, place] += value
        free = np.array([i for i in range(self.count) if i not in self.fixed])
        return k, elastic, m, free

    def modes(self):
        """Angular frequencies and modes of what is free, mass normalized."""
        k, _, m, free = self.assemble()
        where = np.ix_(free, free)
        scale = 1 / np.sqrt(np.diag(m)[free])
        squares, modes = eigh(k[where] * np.outer(scale, scale), m[where] * np.outer(scale, scale))
        return np.sqrt(np.abs(squares)), modes * scale[:, None]

    def respond(self, times, loads, base=None):
        """The motion from rest under `loads`, pairs of a vector of nodal forces and a course, and of a support that
        moves rigidly: `base`, the rigid motion of all numbers and the course with that of its acceleration.
        """
        k, elastic, m, free = self.assemble()
        omega, modes = self.modes()
        # Damping is proportional where springs are no part of it, or where there is none.
        if self.damping_time and self.springs:
            raise ValueError("damped bodies beside springs")
        rate = self.damping_time * omega**2
        parts = [(modes.T @ force[free], course) for force, course in loads]
        if base is not None:
            shape, _, acceleration = base
            parts.append((-modes.T @ (m @ shape)[free], acceleration))
        kinds = np.zeros((3, len(omega), len(times)))
        for share, course in parts:
            kinds += share[None, :, None] * response(omega, rate, course, times)
        full = np.zeros((3, self.count, len(times)))
        full[:, free] = modes @ kinds
        if base is not None:
            shape, course, acceleration = base
            moved = [course.at(times), np.zeros(len(times)), acceleration.at(times)]
            # A rigid motion strains nothing: its rate is not needed for forces.
            full[:] += shape[None, :, None] * np.array(moved)[:, None, :]
        held = np.zeros((self.count, len(times)))
        held += k @ full[0] + self.damping_time * (elastic @ full[1]) + m @ full[2]
        for force, course in loads:
            held -= np.outer(force, course.at(times))
        return Motion(self, full, held)

    def uniform(self, nodes, force):
        """Nodal forces of a uniform force per length on a line."""
        total = np.zeros(self.count)
        inside = {tuple(before + after) for before, after in zip(nodes, nodes[1:], strict=False)}
        for places, _, _, load in self.elements:
            if tuple(places) in inside:
                total[places] += load @ np.asarray(force, float)
        return total

    def point(self, node, force, moment=(0, 0, 0)):
        total = np.zeros(self.count)
        total[node] = [*force, *moment]
        return total


@dataclass
class Motion:
    """A motion with its rates and the forces that supports exert, at all times."""

    frame: Frame
    numbers: np.ndarray
    held: np.ndarray

    def place(self, node):
        return self.numbers[0, node[:3]].T

    def turn(self, node):
        return self.numbers[0, node[3:]].T

    def acceleration(self, node):
        return self.numbers[2, node[:3]].T

    def support(self, node):
        """Force and moment of what holds a node."""
        return self.held[node[:3]].T, self.held[node[3:]].T

    def section(self, nodes, index, spread=None):
        """Force and moment of the part after a node on the part before it; `spread` is a uniform load with its course values."""
        places = nodes[index] + nodes[index + 1]
        for own, k, m, load in self.frame.elements:
            if own == places:
                x = self.numbers[:, places]
                total = k @ (x[0] + self.frame.damping_time * x[1]) + m @ x[2]
                if spread is not None:
                    total -= np.outer(load @ np.asarray(spread[0], float), spread[1])
                return -total[:3].T, -total[3:6].T
        raise ValueError("no such element")


@dataclass(frozen=True)
class Course:
    """A course in time: delayed `one`, `ramp`, `sin` and `cos`, each with factor, delay and angular frequency."""

    terms: tuple

    def at(self, times):
        total = np.zeros(len(times))
        for kind, factor, delay, omega in self.terms:
            since = times - delay
            shape = {"one": 1.0, "ramp": since, "sin": np.sin(omega * since), "cos": np.cos(omega * since)}[kind]
            total += factor * np.where(since >= -1e-12 * times[-1], shape, 0.0)
        return total

    def times(self, factor):
        return Course(tuple((kind, factor * own, delay, omega) for kind, own, delay, omega in self.terms))


def response(omega, rate, course, times):
    """Displacement, velocity, acceleration of oscillators `q'' + rate q' + omega^2 q = course` from rest."""
    half = rate / 2
    root = np.emath.sqrt(half**2 - omega**2).astype(complex)
    root = np.where(abs(root) < 1e-5 * omega, 1e-5 * omega, root)
    one, two = -half + root, -half - root
    total = np.zeros((3, len(omega), len(times)))
    for kind, factor, delay, own in course.terms:
        since = times - delay
        on = since >= -1e-12 * times[-1]
        since = np.where(on, since, 0.0)
        exponentials = []
        if kind in ("one", "sin", "cos"):
            forced = 1j * own if kind != "one" else 0.0
            exponentials = [
                (1 / ((forced - one) * (forced - two)), np.full(len(omega), forced)),
                (1 / ((one - forced) * (one - two)), one),
                (1 / ((two - forced) * (two - one)), two),
            ]
            extra = None
        else:
            exponentials = [(1 / (one**2 * (one - two)), one), (1 / (two**2 * (two - one)), two)]
            extra = (1 / (one * two), (one + two) / (one * two) ** 2)
        value = np.zeros((3, len(omega), len(times)), complex)
        for weight, exponent in exponentials:
            wave = weight[:, None] * np.exp(exponent[:, None] * since[None, :])
            for order in range(3):
                value[order] += exponent[:, None] ** order * wave
        if extra is not None:
            value[0] += extra[0][:, None] * since + extra[1][:, None]
            value[1] += extra[0][:, None]
        part = value.imag if kind == "sin" else value.real
        total += factor * part * on
    return total
