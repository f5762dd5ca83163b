"""Runs rectangular plates in Exudyn: `plates.py --serve`, one JSON object of options a line in, one answer a line out, in one warm process.
Its plate (`ObjectANCFThinPlate`) has positions and both derivatives at its nodes, no mixed derivative.

| option | meaning |
|---|---|
| `sides`, `mesh` | lengths along both axes, m, and numbers of elements; the corner is at the origin |
| `thickness`, `youngs_modulus`, `poisson_ratio`, `density` | in SI |
| `is_thrown` | starts with bending, twist and spin (a square of 1 m) |
| `edges` | `clamped` or `pinned` by the name of the edge: `s1=0`, `s1=1`, `s2=0`, `s2=1` |
| `gravity` | m/s^2 |
| `area_force` | uniform force per area, N/m^2 |
| `corner_force` | at the corner (1, 1), N |
| `end_force` | spread over the edge `s1=1`, N |
| `points` | where to look, as fractions of both sides: at nodes |
| `stop_time`, `every`, `step` | of a motion, s; without them it is an equilibrium |
| `newton`, `newton_tolerance`, `newton_absolute` | `modified` or `full`; tolerances |
| `rho`, `load_steps` | spectral radius of the generalized-alpha method; parts of the load |
| `integration`, `linear` | 0 full, 1 reduced; `sparse` or `dense` |

An answer has a path for each point: rows of the instant (s) and the position (m). That of an equilibrium has one row.
"""

import sys

# The build without range checks: its faster one.
sys.exudynFast = True

import time

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    CoordinateConstraint,
    LoadCoordinate,
    LoadForceVector,
    LoadMassProportional,
    MarkerBodyMass,
    MarkerNodeCoordinate,
    MarkerNodePosition,
    NodePointGround,
    NodePointSlope12,
    ObjectANCFThinPlate,
    SensorNode,
)

from serve import serve

LINEAR = {"dense": exu.LinearSolverType.EXUdense, "sparse": exu.LinearSolverType.EigenSparse}
# First coordinates of a node's position and of its derivatives along both axes.
POSITION, ALONG = 0, (3, 6)
# The coordinate of a vector along the normal.
NORMAL = 2


def stiffness(modulus, ratio, thickness):
    """Stiffness of stretching and of bending, isotropic."""
    law = np.array([[1.0, ratio, 0.0], [ratio, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - ratio)]])
    membrane = modulus * thickness / (1.0 - ratio**2) * law
    return membrane, membrane * thickness**2 / 12.0


class Plate:
    """A rectangle in the plane of the first two axes, with nodes by `[i, j]`."""

    def __init__(self, options):
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.sides, self.mesh = options["sides"], options["mesh"]
        self.nodes, self.elements = {}, []
        self.add_nodes(options.get("is_thrown", False))
        self.add_elements(options)
        ground = self.mbs.AddNode(NodePointGround(referenceCoordinates=[0, 0, 0]))
        self.fixed = self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        self.held = set()
        for edge, kind in options.get("edges", {}).items():
            self.hold(edge, kind)
        self.load(options)
        self.points = [self.node_at(point) for point in options["points"]]
        self.sensors = []
        if "step" in options:
            kept = {"storeInternal": True, "outputVariableType": exu.OutputVariableType.Position}
            self.sensors = [self.mbs.AddSensor(SensorNode(nodeNumber=node, **kept)) for node in self.points]
        self.mbs.Assemble()

    def add_nodes(self, is_thrown):
        """Nodes at rest or thrown, with derivatives by lengths."""
        for i in range(self.mesh[0] + 1):
            for j in range(self.mesh[1] + 1):
                x, y = self.sides[0] * i / self.mesh[0], self.sides[1] * j / self.mesh[1]
                rates = thrown(x, y) if is_thrown else [0.0] * 9
                node = NodePointSlope12(referenceCoordinates=[x, y, 0, 1, 0, 0, 0, 1, 0], initialVelocities=rates)
                self.nodes[i, j] = self.mbs.AddNode(node)

    def add_elements(self, options):
        """Elements, all the same."""
        thickness = options["thickness"]
        membrane, bending = stiffness(options["youngs_modulus"], options["poisson_ratio"], thickness)
        for i in range(self.mesh[0]):
            for j in range(self.mesh[1]):
                around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                plate = ObjectANCFThinPlate(
                    thickness=thickness,
                    density=options["density"],
                    strainCoefficients=membrane,
                    curvatureCoefficients=bending,
                    nodeNumbers=[self.nodes[at] for at in around],
                    useReducedOrderIntegration=options.get("integration", 0),
                )
                self.elements.append(self.mbs.AddObject(plate))

    def edge(self, name):
        """Nodes of an edge in a row, and the axis that it goes along."""
        direction, end = name.split("=")
        across = {"s1": 0, "s2": 1}[direction]
        along = 1 - across
        fixed = self.mesh[across] * int(end)
        places = [(fixed, k) if across == 0 else (k, fixed) for k in range(self.mesh[along] + 1)]
        return [self.nodes[place] for place in places], along

    def hold(self, edge, kind):
        """Holds the line of an edge and, where it is clamped, of the derivatives across it what is along the normal."""
        nodes, along = self.edge(edge)
        held = [*range(POSITION, POSITION + 3), *range(ALONG[along], ALONG[along] + 3)]
        if kind == "clamped":
            held.append(ALONG[1 - along] + NORMAL)
        elif kind != "pinned":
            raise ValueError(f"edge {edge}: expected clamped or pinned, found {kind}")
        for node in nodes:
            for coordinate in held:
                # Edges that meet at a corner hold some of its numbers twice.
                if (node, coordinate) not in self.held:
                    self.held.add((node, coordinate))
                    markers = [self.fixed, self.coordinate(node, coordinate)]
                    self.mbs.AddObject(CoordinateConstraint(markerNumbers=markers))

    def coordinate(self, node, coordinate):
        """A marker of a number of a node."""
        return self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))

    def load(self, options):
        """Loads on the area, at the corner and along the end."""
        acceleration = np.array(options.get("gravity", [0.0] * 3))
        # A uniform load is that of an acceleration.
        mass = options["density"] * options["thickness"]
        acceleration = acceleration + np.array(options.get("area_force", [0.0] * 3)) / mass
        if acceleration.any():
            for element in self.elements:
                marker = self.mbs.AddMarker(MarkerBodyMass(bodyNumber=element))
                self.mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=acceleration.tolist()))
        if "corner_force" in options:
            corner = self.mbs.AddMarker(MarkerNodePosition(nodeNumber=self.nodes[tuple(self.mesh)]))
            self.mbs.AddLoad(LoadForceVector(markerNumber=corner, loadVector=options["corner_force"]))
        if "end_force" in options:
            self.pull_end(np.array(options["end_force"]))

    def pull_end(self, force):
        """Spreads a force over the edge `s1=1`: on cubics, halves of it at both ends of each element and moments of a twelfth."""
        nodes, along = self.edge("s1=1")
        count = len(nodes) - 1
        length = self.sides[1] / count
        for left, right in zip(nodes, nodes[1:]):
            for node, sign in ((left, 1.0), (right, -1.0)):
                for axis, part in enumerate(force / count):
                    if part:
                        self.pull(node, POSITION + axis, 0.5 * part)
                        self.pull(node, ALONG[along] + axis, sign * part * length / 12.0)

    def pull(self, node, coordinate, load):
        """A load on a number of a node."""
        self.mbs.AddLoad(LoadCoordinate(markerNumber=self.coordinate(node, coordinate), load=float(load)))

    def node_at(self, point):
        """The node at fractions of both sides."""
        at = [fraction * count for fraction, count in zip(point, self.mesh)]
        whole = tuple(round(place) for place in at)
        if any(abs(place - near) > 1e-9 for place, near in zip(at, whole)):
            raise ValueError(f"points: expected a node, found {point} on {self.mesh[0]} x {self.mesh[1]} elements")
        return self.nodes[whole]

    def paths(self, options):
        """Rows of the instant and the position, for each point."""
        if "step" not in options:
            return [[[0.0, *self.place(node)]] for node in self.points]
        times = np.arange(1, round(options["stop_time"] / options["every"]) + 1) * options["every"]
        return [self.path(sensor, times) for sensor in self.sensors]

    def place(self, node):
        """Where a node is."""
        return list(map(float, self.mbs.GetNodeOutput(node, exu.OutputVariableType.Position)))

    def path(self, sensor, times):
        """Rows of a sensor at instants. Steps end there."""
        data = self.mbs.GetSensorStoredData(sensor)
        rows = [data[np.argmin(np.abs(data[:, 0] - time))] for time in times]
        if any(abs(row[0] - time) > 1e-6 * times[-1] for row, time in zip(rows, times)):
            raise ValueError(f"expected steps that end at {list(times)}")
        return [list(map(float, row)) for row in rows]


def thrown(x, y):
    """Velocity `w x (r - centre) + (0, 0, 3 X^2 + 3 X Y)` and its derivatives, with `X = 2 x - 1`, `Y = 2 y - 1`."""
    spin = np.array([2.0, 1.0, 3.0])
    (across, along) = (2.0 * x - 1.0, 2.0 * y - 1.0)
    velocity = np.cross(spin, [x - 0.5, y - 0.5, 0.0]) + [0.0, 0.0, 3.0 * across**2 + 3.0 * across * along]
    first = np.cross(spin, [1.0, 0.0, 0.0]) + [0.0, 0.0, 12.0 * across + 6.0 * along]
    second = np.cross(spin, [0.0, 1.0, 0.0]) + [0.0, 0.0, 6.0 * across]
    return [*velocity, *first, *second]


def settings_of(options):
    """Exudyn's settings for a run: no files, one thread."""
    settings = exu.SimulationSettings()
    settings.linearSolverType = LINEAR[options.get("linear", "sparse")]
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.solutionInformation = ""
    settings.displayComputationTime = False
    static, moving = settings.staticSolver, settings.timeIntegration
    for part in (static, moving):
        part.verboseMode = 0
        part.newton.useModifiedNewton = options.get("newton", "full") == "modified"
        part.newton.relativeTolerance = options.get("newton_tolerance", 1e-8)
        part.newton.absoluteTolerance = options.get("newton_absolute", 1e-10)
    static.numberOfLoadSteps = options.get("load_steps", 1)
    static.adaptiveStep = False
    static.newton.maxIterations = 100
    moving.stepInformation = 0
    moving.adaptiveStep = False
    if "step" in options:
        moving.endTime = options["stop_time"]
        moving.numberOfSteps = round(options["stop_time"] / options["step"])
        # A little less than asked for, so that rounding leaves no point out.
        settings.solutionSettings.sensorsWritePeriod = options["every"] * (1.0 - 1e-6)
    moving.generalizedAlpha.spectralRadius = options.get("rho", 0.9)
    return settings


def run(options):
    """One run: paths of points and CPU time of the solver."""
    model, settings = Plate(options), settings_of(options)
    is_static = "step" not in options
    main = exu.MainSolverStatic() if is_static else exu.MainSolverImplicitSecondOrder()
    model.mbs.sys["solver"] = main
    good = main.InitializeSolver(model.mbs, settings)
    started = time.thread_time()
    if good:
        good = main.SolveSteps(model.mbs, settings)
    cpu = time.thread_time() - started
    main.FinalizeSolver(model.mbs, settings)
    if not good:
        return {"good": False, "failure": "Newton's method did not converge", "cpu_time": cpu}
    return {"good": True, "cpu_time": cpu, "newton": main.it.newtonStepsCount, "paths": model.paths(options)}


if __name__ == "__main__":
    serve(run)
