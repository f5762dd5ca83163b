"""Runs a rod that is clamped at its start in PyElastica, whose rods have shear and rotary inertia as Exudyn's beams:
`elastica_rod.py --serve`, one JSON object of options a line in, one answer a line out, in one warm process."""

import json
import sys
import time

import elastica
import numpy as np

# Shear coefficient of a section, as in space.py.
SHEAR = 5 / 6


class Simulator(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):
    """What a simulation is made of."""


def rod_of(scene, count):
    """The rod of a scene. PyElastica's sections are circles; another one's stiffness and inertia take their place."""
    body = scene["bodies"][0]
    material, section = body["material"], body["section"]
    start, end = (np.array(body["shape"]["line"][key], dtype=float) for key in ("from", "to"))
    length, area = np.linalg.norm(end - start), section["area"]
    young, shear, density = (material[key] for key in ("youngs_modulus", "shear_modulus", "density"))
    first, second = section["second_moments"]
    rod = elastica.CosseratRod.straight_rod(
        count,
        start,
        (end - start) / length,
        np.array(body["axis"], dtype=float),
        length,
        np.sqrt(area / np.pi),
        density,
        youngs_modulus=young,
        shear_modulus=shear,
    )
    diagonal = lambda values, like: np.diag(values)[:, :, None] * np.ones(like.shape[2])
    inertia = np.array([first, second, first + second]) * density * length / count
    rod.mass_second_moment_of_inertia[:] = diagonal(inertia, rod.mass_second_moment_of_inertia)
    rod.inv_mass_second_moment_of_inertia[:] = diagonal(1.0 / inertia, rod.inv_mass_second_moment_of_inertia)
    across = SHEAR * shear * area
    rod.shear_matrix[:] = diagonal([across, across, young * area], rod.shear_matrix)
    twisting = shear * section["torsion_constant"]
    rod.bend_matrix[:] = diagonal([young * first, young * second, twisting], rod.bend_matrix)
    return rod


def run(options):
    """One run: path of the last node and CPU time of the steps."""
    with open(options["scene"], encoding="utf-8") as file:
        scene = json.load(file)
    rod = rod_of(scene, options["elements"])
    simulator = Simulator()
    simulator.append(rod)
    simulator.constrain(rod).using(
        elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    gravity = np.array(scene["gravity"], dtype=float)
    simulator.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=gravity)
    simulator.finalize()
    stepper = elastica.PositionVerlet()
    points = round(options["stop_time"] / options["every"])
    between = round(options["every"] / options["step"])
    path, now, cpu = [[0.0, *rod.position_collection[:, -1]]], 0.0, 0.0
    for point in range(points):
        begun = time.thread_time()
        for _ in range(between):
            now = stepper.step(simulator, now, options["every"] / between)
        cpu += time.thread_time() - begun
        path.append([(point + 1) * options["every"], *rod.position_collection[:, -1]])
    return {"good": bool(np.isfinite(path).all()), "cpu_time": cpu, "path": [list(map(float, row)) for row in path]}


def serve():
    # Kernels are compiled at the first call.
    warmed = False
    for line in sys.stdin:
        try:
            options = json.loads(line)
            if not warmed:
                run({**options, "stop_time": options["every"]})
                warmed = True
            answer = run(options)
        except Exception as failure:
            answer = {"good": False, "failure": f"{type(failure).__name__}: {failure}"[:300]}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    serve()
