"""Writes reference.csv, over.csv and double.csv: a row of four-bar linkages whose uprights stay parallel, a pendulum (needs numpy and scipy).

n + 1 uprights and n bars of 1 m and 1 kg each: all uprights have the angle f from the horizontal, bars only move along circles.
I f'' = -G cos f with I = (n + 1) J_end + n m l^2 and G = m g l ((n + 1) / 2 + n), by DOP853 at 1e-13.
In a plane it is problem A02 of the IFToMM library of computational benchmark problems for multibody dynamics, there with 40 windows, and with
two (the double four-bar). Here four windows of bars with a radius of 50 mm, and two of bars with one of 10 mm.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81


def write(name, windows, radius, angle, rate, stop):
    across = radius**2 / 4 + 1 / 12
    inertia = (windows + 1) * (across + 0.25) + windows
    load = GRAVITY * ((windows + 1) / 2 + windows)
    times = np.linspace(0, stop, round(stop / 0.1) + 1)
    run = solve_ivp(
        lambda _, y: [y[1], -load / inertia * np.cos(y[0])], (0, stop), [angle, rate], "DOP853", times, rtol=1e-13, atol=1e-14
    )
    lines = ["t,x,z,vx,vz"]
    for t, f, w in zip(times, *run.y):
        row = [t, np.cos(f), np.sin(f), -w * np.sin(f), w * np.cos(f)]
        lines.append(",".join(f"{x:.16g}" for x in row))
    Path(__file__).with_name(name).write_text("\n".join(lines) + "\n")


# Hanging, 0.9 rad from the vertical, let go.
write("reference.csv", 4, 0.05, -np.pi / 2 + 0.9, 0.0, 10.0)
# As in the library: upright at the start, the heads at 1 m/s, over the horizontal, where every bar could fold by itself.
write("over.csv", 4, 0.05, np.pi / 2, -1.0, 10.0)
# The double four-bar, the same way.
write("double.csv", 2, 0.01, np.pi / 2, -1.0, 10.0)
