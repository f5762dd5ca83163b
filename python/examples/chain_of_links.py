"""A chain of twenty links, written in a loop, packaged, run under fmpy and plotted.

    python chain_of_links.py [--plot FILE.png]

Links are steel bars joined end to end. Both ends of the chain hang on the ground, as far apart as half its length; at
the start it is straight down to its middle and up again. It swings about the catenary of links and comes to rest in it.
"""

import argparse
import math
from pathlib import Path

import flexbody
from flexbody.scene import (
    Accuracy,
    EnergyOutput,
    Experiment,
    PositionOutput,
    Revolute,
    RigidBody,
    Scene,
)

LINKS = 20
LENGTH = 0.1  # of a link, m
MASS = 0.05  # of a link, kg
DAMPING = 1e-2  # of a joint, N m s/rad
SPAN = LINKS * LENGTH / 2  # between the ends, m
GRAVITY = 9.81  # m/s^2
STOP_TIME = 6.0  # s
STEP = 0.02  # s


def corners():
    """Ends of the links: two straight halves that make a V."""
    drop = math.sqrt((LINKS * LENGTH / 2) ** 2 - (SPAN / 2) ** 2)
    points = []
    for number in range(LINKS + 1):
        along = number / LINKS
        points.append((SPAN * along, -drop * (1 - abs(2 * along - 1))))
    return points


def link(number, start, end):
    """A rigid bar from one corner to the next."""
    return RigidBody(
        name=f"link{number}",
        mass=MASS,
        inertia=MASS * LENGTH**2 / 12,
        position=[(start[0] + end[0]) / 2, (start[1] + end[1]) / 2],
        angle=math.atan2(end[1] - start[1], end[0] - start[0]),
        markers={"first": [-LENGTH / 2, 0], "last": [LENGTH / 2, 0]},
    )


def chain():
    """The scene."""
    points = corners()
    scene = Scene(
        name="chain_of_links",
        dimension=2,
        gravity=[0, -GRAVITY],
        bodies=[link(number + 1, *points[number : number + 2]) for number in range(LINKS)],
        joints=[Revolute(name="left", markers=["ground", "link1.first"])],
        experiment=Experiment(stop_time=STOP_TIME, step=STEP),
        accuracy=Accuracy(relative_tolerance=1e-5),
    )
    for number in range(1, LINKS):
        ends = [f"link{number}.last", f"link{number + 1}.first"]
        scene.joints.append(Revolute(name=f"joint{number}", markers=ends, damping=DAMPING))
        scene.outputs.append(PositionOutput(marker=ends[0]))
    scene.joints.append(Revolute(name="right", markers=["ground", f"link{LINKS}.last"], point=[SPAN, 0]))
    scene.outputs.append(EnergyOutput())
    return scene


def run(fmu):
    """Outputs over time, from the unit."""
    import fmpy

    return fmpy.simulate_fmu(str(fmu), stop_time=STOP_TIME, output_interval=STEP)


def plot(result, file):
    import matplotlib.pyplot as plt

    figure, (shapes, energies) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    times = [0, 0.1, 0.2, 0.3, 0.5, STOP_TIME]
    for number, time in enumerate(times):
        row = result[round(time / STEP)]
        x = [0.0, *(row[f"link{n}.last.position[1]"] for n in range(1, LINKS)), SPAN]
        y = [0.0, *(row[f"link{n}.last.position[2]"] for n in range(1, LINKS)), 0.0]
        shapes.plot(x, y, "o-", markersize=3, color=plt.cm.viridis(number / len(times)), label=f"{time:g} s")
    shapes.set(xlabel="x in m", ylabel="y in m", aspect="equal", title=f"A chain of {LINKS} links")
    shapes.legend()
    fallen = result["energy.gravity"] - result["energy.gravity"][0]
    energies.plot(result["time"], result["energy.kinetic"], label="kinetic")
    energies.plot(result["time"], fallen, label="of gravity, since the start")
    energies.plot(result["time"], fallen + result["energy.kinetic"], label="both: what the joints have taken")
    energies.set(xlabel="time in s", ylabel="energy in J", title="Energy")
    energies.legend()
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", type=Path, default=Path("chain_of_links.png"))
    arguments = parser.parse_args()
    fmu = flexbody.package(chain())
    result = run(fmu)
    plot(result, arguments.plot)
    print(
        f"{fmu}, {arguments.plot}: lowest point {min(result[-1][f'link{n}.last.position[2]'] for n in range(1, LINKS)):.4f} m"
    )


if __name__ == "__main__":
    main()
