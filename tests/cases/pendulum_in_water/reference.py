"""Writes reference.csv: a rigid bar on a pin that swings through water from the horizontal, and the force at its pin (needs numpy and scipy).

M L^3 / 3 p'' = (m - rho A) g L^2 / 2 cos p - C_d rho D L^4 / 8 |p'| p', M = m + C_a rho A; along the bar M p'^2 L^2 / 2 + (m - rho A) g L sin p.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

LENGTH, DIAMETER, DENSITY, WATER, DRAG, ADDED, GRAVITY = 1.0, 0.02, 3000.0, 1025.0, 1.2, 0.9, 9.81
AREA = 0.25 * np.pi * DIAMETER**2
MOVED = (DENSITY + ADDED * WATER) * AREA
WEIGHT = (DENSITY - WATER) * AREA * GRAVITY


def rates(_, y):
    angle, rate = y
    moment = WEIGHT * LENGTH**2 / 2.0 * np.cos(angle) - DRAG * WATER * DIAMETER * LENGTH**4 / 8.0 * abs(rate) * rate
    return [rate, moment / (MOVED * LENGTH**3 / 3.0)]


def main():
    times = np.linspace(0.0, 3.0, 61)
    found = solve_ivp(rates, (0.0, 3.0), [0.0, 0.0], method="DOP853", rtol=1e-13, atol=1e-14, t_eval=times)
    angle, rate = found.y
    force = MOVED * rate**2 * LENGTH**2 / 2.0 + WEIGHT * LENGTH * np.sin(angle)
    strictly = DENSITY * AREA * rate**2 * LENGTH**2 / 2.0 + WEIGHT * LENGTH * np.sin(angle)
    rows = zip(times, LENGTH * np.cos(angle), -LENGTH * np.sin(angle), force, strict=True)
    lines = ["t,x,y,force", *(",".join(repr(float(value)) for value in row) for row in rows)]
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("largest force:", force.max(), "without added mass along the bar:", strictly.max())


if __name__ == "__main__":
    main()
