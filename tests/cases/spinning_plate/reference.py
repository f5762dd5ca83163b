"""Writes reference.csv: a round plate thrown with spin and wobble, in closed form (needs numpy).

A body with equal moments A about two axes and C about the third turns steadily about its angular momentum L at the rate L / A, and
about its own axis at (1 - C / A) w3: twice round in space for one wobble of a plate where C = 2 A.
L. D. Landau, E. M. Lifshitz, Mechanics, 3rd ed., section 33.
"""

from pathlib import Path

import numpy as np

MOMENTS, SPIN = np.array([0.02, 0.02, 0.04]), np.array([2.5, 0.0, 6.0])
CENTER, VELOCITY, RIM = np.array([0.0, 0.0, 1.0]), np.array([0.3, 0.0, 0.2]), np.array([0.4, 0.0, 0.0])


def turn(axis, angle):
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def main():
    momentum = MOMENTS * SPIN
    size = np.linalg.norm(momentum)
    lines = ["t,x,y,z," + ",".join(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))]
    for time in np.arange(41) / 10:
        own = turn([0, 0, 1], (1 - MOMENTS[2] / MOMENTS[0]) * SPIN[2] * time)
        axes = turn(momentum / size, size / MOMENTS[0] * time) @ own
        rim = CENTER + VELOCITY * time + axes @ RIM
        lines.append(",".join(f"{x:.16g}" for x in [time, *rim, *axes.ravel()]))
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n")


main()
