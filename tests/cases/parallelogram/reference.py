"""Writes heavy.csv: a rigid parallelogram linkage under gravity (needs numpy and scipy).

The coupler only translates, so the linkage is a pendulum: I phi'' = -W cos(phi). Order 8, tolerance
1e-13, checked against conservation of energy. Without gravity the linkage turns at constant speed.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

CRANK, MASS, COUPLER, GRAVITY = 0.2, 0.3, 0.5, 9.81  # length, mass of each crank, mass of the coupler
START, SPEED, STOP, STEPS = 1.0, 10.0, 2.0, 80
INERTIA = 2 * MASS * CRANK**2 / 3 + COUPLER * CRANK**2
WEIGHT = (MASS + COUPLER) * CRANK * GRAVITY


def energy(phi, rate):
    return 0.5 * INERTIA * rate**2 + WEIGHT * np.sin(phi)


times = np.linspace(0.0, STOP, STEPS + 1)
solution = solve_ivp(
    lambda _, y: [y[1], -WEIGHT / INERTIA * np.cos(y[0])],
    (0.0, STOP),
    [START, SPEED],
    method="DOP853",
    t_eval=times,
    rtol=1e-13,
    atol=1e-13,
)
phi, rate = solution.y
assert np.ptp(energy(phi, rate)) < 1e-11
x, y = CRANK * np.cos(phi), CRANK * np.sin(phi)
columns = [times, phi, rate, x, y, -rate * y, rate * x, 0.0 * x]
lines = ["t,phi,phi_dot,x_A,y_A,vx_A,vy_A,zero"]
lines += [",".join(f"{value:.15g}" for value in row) for row in zip(*columns)]
Path(__file__).with_name("heavy.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
