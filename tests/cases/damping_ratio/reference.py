"""A beam between supports starts with the velocity v sin(pi s) of its first mode and decays freely:
y = v / w_d exp(-zeta w t) sin(w_d t), w = (pi / L)^2 sqrt(EI / (rho A)), w_d = w sqrt(1 - zeta^2), whatever the damping time has to be."""

import csv
import math
from pathlib import Path

LENGTH, YOUNG, MOMENT, DENSITY, AREA = 2.0, 2e9, 1e-8, 1200.0, 1e-3
RATIO, SPEED = 0.02, 0.01
STOP, STEP = 3.0, 0.05

if __name__ == "__main__":
    rate = (math.pi / LENGTH) ** 2 * math.sqrt(YOUNG * MOMENT / (DENSITY * AREA))
    damped = rate * math.sqrt(1.0 - RATIO**2)
    with open(Path(__file__).parent / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", "y"])
        for step in range(round(STOP / STEP) + 1):
            t = step * STEP
            y = SPEED / damped * math.exp(-RATIO * rate * t) * math.sin(damped * t)
            writer.writerow([f"{t:.15g}", f"{y:.15g}"])
    print("rate", rate, "decay", RATIO * rate, "second", RATIO * 16.0 * rate, "time", 2.0 * RATIO / rate)
    cantilever = (1.875104068711961 / LENGTH) ** 2 * math.sqrt(YOUNG * MOMENT / (DENSITY * AREA))
    second = cantilever * (4.694091132974175 / 1.875104068711961) ** 2
    print("cantilever", cantilever, "decay", RATIO * cantilever, RATIO * second**2 / cantilever)
