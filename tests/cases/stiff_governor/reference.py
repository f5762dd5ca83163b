"""Writes reference.csv: the stiff flyball governor, in three coordinates (needs numpy and scipy).

A shaft and a slider on it turn by an angle whose momentum stays, I(a) w = I(a0) w0; both rods hang by the angle a below the horizontal; the
slider is at the height s. With a rod of length L, mass m, moments J across and j along, the ball M at its end, hinges b from the axis:
    A = 2 (J + m L^2 / 4 + M L^2)
    I = Jz + 2 (j sin^2 a + J cos^2 a + m (b + L/2 cos a)^2 + M (b + L cos a)^2)
    A a'' = w^2 I' / 2 + 2 g (m L/2 + M L) cos a - 2 F dl/da,   n s'' = -n g - 2 F dl/ds,   F = K (l - l0) + C l',
    l^2 = (L/2 cos a)^2 + (H - L/2 sin a - s)^2.
Springs are as stiff as dampers are strong: 26,000 1/s against 2 pi. Radau IIA of order 5 at 1e-12, 1e-11 beside it.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY, DENSITY, LENGTH, THICK, EDGE, OFF, HEIGHT, BALL = 9.81, 3000.0, 1.0, 0.01, 0.1, 0.05, 1.0, 5.0
STIFFNESS, DAMPING, REST = 8e5, 4e4, 0.5
ROD, SLIDER = DENSITY * LENGTH * THICK**2, DENSITY * EDGE**3
ACROSS, ALONG = ROD * (LENGTH**2 + THICK**2) / 12, ROD * THICK**2 / 6
UPRIGHT = ROD * THICK**2 / 6 + SLIDER * EDGE**2 / 6
HALF = LENGTH / 2
SWING = 2 * (ACROSS + ROD * HALF**2 + BALL * LENGTH**2)


def turning(a):
    """Moment of inertia about the shaft and its derivative."""
    sin, cos = np.sin(a), np.cos(a)
    rod, ball = OFF + HALF * cos, OFF + LENGTH * cos
    inertia = UPRIGHT + 2 * (ALONG * sin**2 + ACROSS * cos**2 + ROD * rod**2 + BALL * ball**2)
    slope = 4 * ((ALONG - ACROSS) * sin * cos - ROD * rod * HALF * sin - BALL * ball * LENGTH * sin)
    return inertia, slope


START = np.array([np.pi / 6, 0.5, 0.0, 0.0])
MOMENTUM = turning(START[0])[0] * 2 * np.pi


def rate(_, y):
    a, s, da, ds = y
    sin, cos = np.sin(a), np.cos(a)
    inertia, slope = turning(a)
    across, up = HALF * cos, HEIGHT - HALF * sin - s
    length = np.hypot(across, up)
    by_a, by_s = (-across * HALF * sin - up * HALF * cos) / length, -up / length
    force = STIFFNESS * (length - REST) + DAMPING * (by_a * da + by_s * ds)
    turn = (MOMENTUM / inertia) ** 2 * slope / 2 + 2 * GRAVITY * (ROD * HALF + BALL * LENGTH) * cos - 2 * force * by_a
    return [da, ds, turn / SWING, -GRAVITY - 2 * force * by_s / SLIDER]


def run(tolerance, times):
    made = solve_ivp(rate, (0.0, times[-1]), START, "Radau", times, rtol=tolerance, atol=1e-2 * tolerance)
    return made.y


if __name__ == "__main__":
    times = np.linspace(0.0, 10.0, 101)
    coarse, fine = run(1e-11, times), run(1e-12, times)
    print("largest difference of both tolerances", abs(fine - coarse).max(axis=1))
    lines = ["t,s,ds,ball,w"]
    for t, (a, s, _, ds) in zip(times, fine.T):
        row = [t, s, ds, HEIGHT - LENGTH * np.sin(a), MOMENTUM / turning(a)[0]]
        lines.append(",".join(f"{x:.13g}" for x in row))
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n")
