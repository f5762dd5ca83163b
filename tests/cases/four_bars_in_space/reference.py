"""Writes reference.csv and over.csv: a row of four-bar linkages whose uprights stay parallel, a pendulum (needs numpy and scipy).

Five uprights and four bars of 1 m and 1 kg each with a radius of 50 mm: all uprights have the angle f from the horizontal, bars
only move along circles. I f'' = -G cos f with I = 5 J_end + 4 m l^2 and G = m g l (5 / 2 + 4), by DOP853 at 1e-13.
In a plane it is problem A02 of the IFToMM library of computational benchmark problems for multibody dynamics, there with 40 windows.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY, WINDOWS = 9.81, 4
ACROSS = 0.05**2 / 4 + 1 / 12
INERTIA = (WINDOWS + 1) * (ACROSS + 0.25) + WINDOWS
LOAD = GRAVITY * ((WINDOWS + 1) / 2 + WINDOWS)


def write(name, angle, rate, stop):
    times = np.linspace(0, stop, round(stop / 0.1) + 1)
    run = solve_ivp(
        lambda _, y: [y[1], -LOAD / INERTIA * np.cos(y[0])], (0, stop), [angle, rate], "DOP853", times, rtol=1e-13, atol=1e-14
    )
    lines = ["t,x,z,vx,vz"]
    for t, f, w in zip(times, *run.y):
        row = [t, np.cos(f), np.sin(f), -w * np.sin(f), w * np.cos(f)]
        lines.append(",".join(f"{x:.16g}" for x in row))
    Path(__file__).with_name(name).write_text("\n".join(lines) + "\n")


# Hanging, 0.9 rad from the vertical, let go.
write("reference.csv", -np.pi / 2 + 0.9, 0.0, 10.0)
# As in the library: upright at the start, the heads at 1 m/s, over the horizontal, where every bar could fold by itself.
write("over.csv", np.pi / 2, -1.0, 10.0)
