"""A bead in a tube that is turned at a steady rate: r'' = W^2 r - (k (r - r0) + c r') / m, whose roots are real or complex."""

import cmath
import csv
from pathlib import Path

RATE, STIFFNESS, DAMPING, REST, MASS, START, SPEED = 3.0, 40.0, 0.6, 0.5, 1.2, 0.8, -0.4
STOP, STEP = 4.0, 0.1


def main():
    square = STIFFNESS / MASS - RATE**2
    middle = STIFFNESS * REST / MASS / square
    half = 0.5 * DAMPING / MASS
    root = cmath.sqrt(half * half - square)
    roots = (-half + root, -half - root)
    # a + b = r(0) - middle, a s1 + b s2 = r'(0).
    a = (SPEED - roots[1] * (START - middle)) / (roots[0] - roots[1])
    b = START - middle - a
    with open(Path(__file__).parent / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", "r", "v", "a"])
        for step in range(round(STOP / STEP) + 1):
            t = step * STEP
            parts = [(c * cmath.exp(s * t), s) for c, s in ((a, roots[0]), (b, roots[1]))]
            r, v, w = (sum(part * s**order for part, s in parts).real for order in range(3))
            writer.writerow([f"{value:.15g}" for value in (t, middle + r, v, w)])


main()
