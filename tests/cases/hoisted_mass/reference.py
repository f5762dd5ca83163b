"""A mass on a spring that is as stiff as a rope of the length which a winch has paid out swings widely.

`m x'' = -T x / r + m g`, `T = EA (r / L(t) - 1)`: the rope has no mass of its own.

Source: Newton's second law; integrated by scipy (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed.,
section II.5: DOP853).
"""

import csv

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY, MASS, STIFFNESS, START, ANGLE, END, STEP = 9.81, 10.0, 1e4, 2.0, 0.8, 3.0, 0.05


def length(t):
    return START + 0.8 * (1 - np.cos(2 * t))


def rates(t, state):
    x, z, vx, vz = state
    r = np.hypot(x, z)
    pull = STIFFNESS * (r / length(t) - 1) / (MASS * r)
    return [vx, vz, -pull * x, -pull * z - GRAVITY]


times = np.linspace(0, END, round(END / STEP) + 1)
start = [START * np.sin(ANGLE), -START * np.cos(ANGLE), 0, 0]
found = solve_ivp(rates, (0, END), start, "DOP853", times, rtol=1e-12, atol=1e-13)
tension = STIFFNESS * (np.hypot(found.y[0], found.y[1]) / length(times) - 1)
with open("reference.csv", "w", newline="", encoding="utf-8") as file:
    rows = csv.writer(file)
    rows.writerow(["t", "x", "z", "tension"])
    rows.writerows([repr(float(x)) for x in row] for row in zip(times, found.y[0], found.y[1], tension))
