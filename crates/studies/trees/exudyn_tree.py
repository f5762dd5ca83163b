"""Exudyn: rigid bodies with joints as constraints, or its kinematic tree in joint angles."""

import sys

# The build without range checks: its faster one.
sys.exudynFast = True

import time

import exudyn as exu
import numpy as np
from exudyn.itemInterface import NodeGenericODE2, ObjectGround, ObjectKinematicTree, SensorBody, SensorKinematicTree
from exudyn.utilities import RigidBodyInertia

NODES = {
    "euler parameters": exu.NodeType.RotationEulerParameters,
    "rotation vectors": exu.NodeType.RotationRotationVector,
}
EXPLICIT = {"rk4": exu.DynamicSolverType.RK44, "rk67": exu.DynamicSolverType.RK67}
LINEAR = {"dense": exu.LinearSolverType.EXUdense, "sparse": exu.LinearSolverType.EigenSparse}
KEPT = {"storeInternal": True, "outputVariableType": exu.OutputVariableType.Position}


def bodies(tree, nodes):
    """One body a link, one joint each; the sensor of the point."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(ObjectGround())
    made = []
    for link in tree.links:
        inertia = RigidBodyInertia(mass=link.mass, com=[0, 0, 0], inertiaTensor=link.axes.T @ link.inertia @ link.axes)
        body = mbs.CreateRigidBody(
            inertia=inertia,
            referencePosition=link.centre,
            referenceRotationMatrix=link.axes,
            gravity=tree.gravity,
            nodeType=NODES[nodes],
        )
        base = ground if link.parent < 0 else made[link.parent]
        mbs.CreateRevoluteJoint(itemNumbers=[base, body], position=link.joint, axis=link.axis)
        made.append(body)
    last = tree.links[-1]
    point = last.axes.T @ (tree.point - last.centre)
    return mbs, mbs.AddSensor(SensorBody(bodyNumber=made[-1], localPosition=point, **KEPT))


def frame(axis):
    """A frame whose z axis is that of a joint."""
    across = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
    across /= np.linalg.norm(across)
    return np.array([across, np.cross(axis, across), axis]).T


def kinematic_tree(tree):
    """All links in one object; the sensor of the point."""
    mbs = exu.SystemContainer().AddSystem()
    count = len(tree.links)
    zeros = [0.0] * count
    node = mbs.AddNode(
        NodeGenericODE2(
            referenceCoordinates=zeros, initialCoordinates=zeros, initialCoordinates_t=zeros, numberOfODE2Coordinates=count
        )
    )
    frames = [frame(link.axis) for link in tree.links]
    under = [np.eye(3) if link.parent < 0 else frames[link.parent] for link in tree.links]
    own = list(zip(tree.links, frames, under))
    matrices = lambda values: exu.Matrix3DList([np.ascontiguousarray(value) for value in values])
    vectors = lambda values: exu.Vector3DList([np.ascontiguousarray(value) for value in values])
    made = mbs.AddObject(
        ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[exu.JointType.RevoluteZ] * count,
            linkParents=[link.parent for link in tree.links],
            jointTransformations=matrices(below.T @ at for _, at, below in own),
            jointOffsets=vectors(below.T @ (link.joint - tree.base(link)) for link, _, below in own),
            linkInertiasCOM=matrices(at.T @ link.inertia @ at for link, at, _ in own),
            linkCOMs=vectors(at.T @ (link.centre - link.joint) for link, at, _ in own),
            linkMasses=[link.mass for link in tree.links],
            gravity=list(tree.gravity),
        )
    )
    point = frames[-1].T @ (tree.point - tree.links[-1].joint)
    return mbs, mbs.AddSensor(SensorKinematicTree(objectNumber=made, linkNumber=count - 1, localPosition=point, **KEPT))


def settings_of(options):
    """Settings of a run: no files, one thread."""
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = options["stop_time"]
    integration.numberOfSteps = round(options["stop_time"] / options["step"])
    settings.linearSolverType = LINEAR[options.get("linear", "sparse")]
    settings.solutionSettings.writeSolutionToFile = False
    # A little less than asked for, so that rounding leaves no point out.
    settings.solutionSettings.sensorsWritePeriod = options["every"] * (1.0 - 1e-6)
    settings.solutionSettings.solutionInformation = ""
    settings.displayComputationTime = False
    integration.verboseMode = integration.stepInformation = 0
    integration.adaptiveStep = False
    integration.newton.useModifiedNewton = options.get("newton", "modified") == "modified"
    alpha = integration.generalizedAlpha
    alpha.spectralRadius = options.get("rho", 0.9)
    if options["method"] == "trapezoidal":
        alpha.useNewmark = alpha.useIndex2Constraints = True
    return settings


def run(tree, options):
    """One run: path of the point and CPU time of the steps."""
    if options["model"] == "kinematic tree":
        mbs, sensor = kinematic_tree(tree)
    else:
        mbs, sensor = bodies(tree, options["model"])
    mbs.Assemble()
    settings = settings_of(options)
    if options["method"] in EXPLICIT:
        solver = exu.MainSolverExplicit()
        settings.timeIntegration.solverType = EXPLICIT[options["method"]]
    else:
        solver = exu.MainSolverImplicitSecondOrder()
    mbs.sys["solver"] = solver
    good = solver.InitializeSolver(mbs, settings)
    begun = time.thread_time()
    good = good and solver.SolveSteps(mbs, settings)
    cpu = time.thread_time() - begun
    solver.FinalizeSolver(mbs, settings)
    path = mbs.GetSensorStoredData(sensor)[:, 1:4]
    if not good or not np.isfinite(path).all():
        return {"good": False, "failure": "no convergence"}
    # The first row is the start.
    return {"good": True, "cpu_time": cpu, "path": path[1:].tolist()}
