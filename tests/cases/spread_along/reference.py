"""Deflection of a beam between supports under a pressure that travels along it, from its modes.

The beam of `travelling.json` has length, bending stiffness and mass per length 1. Its modes are sin(n pi s) with the frequencies
(n pi)^2, and q sin(pi s - v t) is q sin(pi s) cos(v t) - q cos(pi s) sin(v t): the first acts on the first mode, the second on those
of even number with 2 times the integral of cos(pi s) sin(n pi s), 4 n / (pi (n^2 - 1)). Each mode starts at rest.
"""

import csv
import math
from pathlib import Path

LOAD, RATE, PLACE, MODES = 1e-2, 4.0, 0.3, 80


def deflection(t):
    frequency = math.pi**2
    share = LOAD / (frequency**2 - RATE**2)
    total = share * (math.cos(RATE * t) - math.cos(frequency * t)) * math.sin(math.pi * PLACE)
    for n in range(2, MODES, 2):
        frequency = (n * math.pi) ** 2
        share = -LOAD * 4 * n / (math.pi * (n * n - 1)) / (frequency**2 - RATE**2)
        course = math.sin(RATE * t) - RATE / frequency * math.sin(frequency * t)
        total += share * course * math.sin(n * math.pi * PLACE)
    return total


with Path(__file__).with_name("reference.csv").open("w", newline="", encoding="utf-8") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["t", "y"])
    for step in range(41):
        t = step / 20
        writer.writerow([repr(t), repr(deflection(t))])
