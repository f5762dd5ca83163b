"""Runs square plates in Exudyn: `plates.py --serve`, one JSON object of options a line in, one answer a line out, in one warm process.
Its plate (`ObjectANCFThinPlate`) has positions and both derivatives at its nodes, no mixed derivative."""

import sys

# The build without range checks: its faster one.
sys.exudynFast = True

import time

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    CoordinateConstraint,
    LoadForceVector,
    MarkerNodeCoordinate,
    MarkerNodePosition,
    NodePointGround,
    NodePointSlope12,
    ObjectANCFThinPlate,
)

from serve import serve

LINEAR = {"dense": exu.LinearSolverType.EXUdense, "sparse": exu.LinearSolverType.EigenSparse}


def stiffness(modulus, ratio, thickness):
    """Stiffness of stretching and of bending, isotropic."""
    law = np.array([[1.0, ratio, 0.0], [ratio, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - ratio)]])
    membrane = modulus * thickness / (1.0 - ratio**2) * law
    return membrane, membrane * thickness**2 / 12.0


class Square:
    """A square of 1 m in the plane of the first two axes, with nodes by `[i, j]`."""

    def __init__(self, options):
        self.container = exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        count = options["elements"]
        self.count, thickness = count, options["thickness"]
        membrane, bending = stiffness(options["youngs_modulus"], options["poisson_ratio"], thickness)
        self.nodes = {}
        for i in range(count + 1):
            for j in range(count + 1):
                x, y = i / count, j / count
                rates = thrown(x, y) if options.get("is_thrown") else [0.0] * 9
                node = NodePointSlope12(referenceCoordinates=[x, y, 0, 1, 0, 0, 0, 1, 0], initialVelocities=rates)
                self.nodes[i, j] = self.mbs.AddNode(node)
        for i in range(count):
            for j in range(count):
                around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                plate = ObjectANCFThinPlate(
                    thickness=thickness,
                    density=options["density"],
                    strainCoefficients=membrane,
                    curvatureCoefficients=bending,
                    nodeNumbers=[self.nodes[at] for at in around],
                    useReducedOrderIntegration=options.get("integration", 0),
                )
                self.mbs.AddObject(plate)
        if options.get("is_clamped"):
            self.clamp()
        if "force" in options:
            corner = self.mbs.AddMarker(MarkerNodePosition(nodeNumber=self.nodes[count, count]))
            self.mbs.AddLoad(LoadForceVector(markerNumber=corner, loadVector=options["force"]))
        self.mbs.Assemble()

    def clamp(self):
        """Holds the first edge: its line, and of the derivatives across it what is along the normal."""
        ground = self.mbs.AddNode(NodePointGround(referenceCoordinates=[0, 0, 0]))
        fixed = self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        for j in range(self.count + 1):
            for coordinate in (0, 1, 2, 5, 6, 7, 8):
                marker = MarkerNodeCoordinate(nodeNumber=self.nodes[0, j], coordinate=coordinate)
                held = [fixed, self.mbs.AddMarker(marker)]
                self.mbs.AddObject(CoordinateConstraint(markerNumbers=held))

    def places(self):
        """Places of the corners at (1, 1) and at (1, 0)."""
        ends = [self.nodes[self.count, self.count], self.nodes[self.count, 0]]
        return [list(map(float, self.mbs.GetNodeOutput(node, exu.OutputVariableType.Position))) for node in ends]


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
    moving.generalizedAlpha.spectralRadius = options.get("rho", 0.9)
    return settings


def run(options):
    """One run: places of corners and CPU time of the solver."""
    model, settings = Square(options), settings_of(options)
    is_static = "step" not in options
    main = exu.MainSolverStatic() if is_static else exu.MainSolverImplicitSecondOrder()
    model.mbs.sys["solver"] = main
    good = main.InitializeSolver(model.mbs, settings)
    started = time.thread_time()
    if good:
        good = main.SolveSteps(model.mbs, settings)
    cpu = time.thread_time() - started
    main.FinalizeSolver(model.mbs, settings)
    return {"good": bool(good), "cpu_time": cpu, "newton": main.it.newtonStepsCount, "path": model.places()}


if __name__ == "__main__":
    serve(run)
