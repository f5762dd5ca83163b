"""Runs scenes in Exudyn: `run.py SCENE --marker rod.tip --elements 20 --step 1e-3 --stop-time 1.1 --every 0.1`,
or `run.py --serve`: one JSON object of the same options a line in, one answer a line out, in one warm process."""

import sys

# The build without range checks: its faster one.
sys.exudynFast = True

import argparse
import json
import time

import exudyn as exu

from model import Model
from serve import serve
from space import SpaceModel

LINEAR = {"dense": exu.LinearSolverType.EXUdense, "sparse": exu.LinearSolverType.EigenSparse}
EXPLICIT = {
    "verlet": exu.DynamicSolverType.VelocityVerlet,
    "rk4": exu.DynamicSolverType.RK44,
    "rk67": exu.DynamicSolverType.RK67,
    "dopri5": exu.DynamicSolverType.DOPRI5,
    "ode23": exu.DynamicSolverType.ODE23,
}


def settings_of(options):
    """Exudyn's settings for a run: no files, one thread."""
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
    integration.verboseMode = 0
    integration.stepInformation = 0
    integration.newton.useModifiedNewton = options.get("newton", "modified") == "modified"
    integration.newton.relativeTolerance = options.get("newton_tolerance", 1e-8)
    integration.newton.absoluteTolerance = options.get("newton_absolute", 1e-10)
    if "contractivity" in options:
        integration.newton.modifiedNewtonContractivity = options["contractivity"]
    if "restart" in options:
        integration.newton.maxModifiedNewtonRestartIterations = options["restart"]
        integration.newton.maxModifiedNewtonIterations = options["restart"] + 1
    integration.newton.modifiedNewtonJacUpdatePerStep = options.get("every_step", False)
    integration.adaptiveStep = False
    integration.computeLoadsJacobian = options.get("loads_jacobian", 0)
    alpha = integration.generalizedAlpha
    alpha.spectralRadius = options.get("rho", 0.9)
    if options.get("solver") == "newmark":
        alpha.useNewmark = True
        alpha.useIndex2Constraints = True
    integration.explicit.computeEndOfStepAccelerations = False
    integration.explicit.useLieGroupIntegration = options.get("nodes") == "vectors"
    if options.get("solver") in ("dopri5", "ode23"):
        integration.automaticStepSize = True
        integration.relativeTolerance = options["tolerance"]
        integration.absoluteTolerance = options["tolerance"]
    return settings


def run(options):
    """One run: path of the marker and CPU time of the steps."""
    with open(options["scene"], encoding="utf-8") as file:
        scene = json.load(file)
    for index, share in enumerate(options.get("shares", [])):
        scene["bodies"][index]["share"] = share
    model = (SpaceModel if scene.get("dimension") == 3 else Model)(scene, options)
    settings = settings_of(options)
    solver = options.get("solver", "alpha")
    if solver in EXPLICIT:
        main = exu.MainSolverExplicit()
        settings.timeIntegration.solverType = EXPLICIT[solver]
    else:
        main = exu.MainSolverImplicitSecondOrder()
    model.mbs.sys["solver"] = main
    begun = time.thread_time()
    good = main.InitializeSolver(model.mbs, settings)
    started, process = time.thread_time(), time.process_time()
    if good:
        good = main.SolveSteps(model.mbs, settings)
    cpu, whole = time.thread_time() - started, time.process_time() - process
    main.FinalizeSolver(model.mbs, settings)
    path = model.mbs.GetSensorStoredData(model.sensor)[:, : 1 + scene["dimension"]].tolist()
    return {
        "good": bool(good),
        "cpu_time": cpu,
        "process_time": whole,
        "set_up": started - begun,
        "steps": main.it.currentStepIndex,
        "newton": main.it.newtonStepsCount,
        "jacobians": main.it.newtonJacobiCount,
        "path": path,
    }


def main():
    if sys.argv[1:] == ["--serve"]:
        return serve(run)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--marker", default="rod.tip")
    parser.add_argument("--elements", type=int, default=20)
    parser.add_argument("--step", type=float, default=1e-3)
    parser.add_argument("--stop-time", type=float, default=1.1)
    parser.add_argument("--every", type=float, default=0.1)
    parser.add_argument("--solver", default="alpha", choices=["alpha", "newmark", *EXPLICIT])
    parser.add_argument("--set", action="append", default=[], metavar="OPTION=JSON", help="any option of settings.json")
    arguments = vars(parser.parse_args())
    extra = dict(pair.split("=", 1) for pair in arguments.pop("set"))
    arguments.update({key: json.loads(value) for key, value in extra.items()})
    answer = run(arguments)
    for row in answer.pop("path"):
        print(",".join(repr(value) for value in row))
    print(json.dumps({**answer, "settings": arguments}))


if __name__ == "__main__":
    main()
