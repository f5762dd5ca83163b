"""Reference of a uniform rod that falls about a pin from the horizontal: writes `reference.csv`.

The angle `p` below the horizontal from `p'' = 3 g cos p / (2 L)` by a Runge-Kutta method with steps of 1e-4 s; all else
is in closed form: `p'^2 = 3 g sin p / L`, and of the part of the rod beyond `x`, weight less inertia,
`N = rho A (p'^2 (L^2 - x^2) / 2 + g sin p (L - x))`, `M = rho A g cos p x (L - x)^2 / (4 L)`.
"""

import math
from pathlib import Path

G, LENGTH, LINE = 9.81, 1.5, 0.3
STEP, EVERY, ROWS = 1e-4, 500, 40
PLACES = {"root": 0.0, "third": 1.0 / 3.0, "middle": 0.5}


def slopes(angle, rate):
    return rate, 1.5 * G / LENGTH * math.cos(angle)


def step(angle, rate):
    a = slopes(angle, rate)
    b = slopes(angle + 0.5 * STEP * a[0], rate + 0.5 * STEP * a[1])
    c = slopes(angle + 0.5 * STEP * b[0], rate + 0.5 * STEP * b[1])
    d = slopes(angle + STEP * c[0], rate + STEP * c[1])
    moved = [(a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) * STEP / 6.0 for k in range(2)]
    return angle + moved[0], rate + moved[1]


def row(time, angle):
    values = [time, LENGTH * math.cos(angle), -LENGTH * math.sin(angle)]
    square = 3.0 * G * math.sin(angle) / LENGTH
    for part in PLACES.values():
        x = part * LENGTH
        rest = LENGTH - x
        values.append(LINE * (0.5 * square * (LENGTH**2 - x**2) + G * math.sin(angle) * rest))
        values.append(LINE * G * math.cos(angle) * x * rest**2 / (4.0 * LENGTH))
    return ",".join(repr(value) for value in values)


def main():
    angle, rate = 0.0, 0.0
    names = [f"{what}_{place}" for place in PLACES for what in ("axial", "bending")]
    lines = [",".join(["t", "x", "y", *names])]
    for number in range(ROWS + 1):
        lines.append(row(round(number * EVERY * STEP, 6), angle))
        for _ in range(EVERY):
            angle, rate = step(angle, rate)
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


main()
