"""Writes reference.csv: a heavy top on a ball joint whose orientation is driven, in closed form (needs numpy).

It is tilted by 0.4 rad and turns steadily about the vertical and about its own axis: w = A z + B e, w' = A z x B e. Newton's and Euler's
equations give the force of the joint and the moment of what drives it, about the joint.
"""

from pathlib import Path

import numpy as np

MASS, MOMENTS, ARM, GRAVITY = 1.2, np.diag([0.012, 0.017, 0.021]), np.array([0, 0, 0.08]), np.array([0, 0, -9.81])
TILT, TURNING, SPINNING = 0.4, 3.0, 5.0


def turn(axis, angle):
    skew = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def main():
    parts = ["x", "y", "z", "wx", "wy", "wz", "fx", "fy", "fz", "mx", "my", "mz"]
    lines = [",".join(["t", *parts])]
    for time in np.arange(41) / 4:
        standing = turn([0, 0, 1], TURNING * time) @ turn([1, 0, 0], TILT)
        axes = standing @ turn([0, 0, 1], SPINNING * time)
        about, own = np.array([0, 0, TURNING]), axes[:, 2] * SPINNING
        spin, second = about + own, np.cross(about, own)
        center, inertia = axes @ ARM, axes @ MOMENTS @ axes.T
        force = MASS * (np.cross(second, center) + np.cross(spin, np.cross(spin, center)) - GRAVITY)
        moment = inertia @ second + np.cross(spin, inertia @ spin) + np.cross(center, force)
        lines.append(",".join(f"{x:.16g}" for x in [time, *center, *spin, *force, *moment]))
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n")


main()
