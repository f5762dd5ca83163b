"""Two blocks on rails, in closed form.

One goes to and fro between two springs that it meets without damping: steady between, half a sine in each stop, so that its period
is 2 (gap / v + pi / w), w = sqrt(k / m). The other meets one stop with the force k d (1 + a d'), once: with energy e(v) = v / a - ln(1 + a v) / a^2
its deepest place is at k d^2 / (2 m) = e(v), and it leaves at the speed u with e(-u) = e(v) (Hunt and Crossley 1975, linear in d).
"""

import csv
import math
from pathlib import Path

MASS, STIFFNESS, LIMITS, SPEED = 1.5, 600.0, (-0.2, 0.3), 2.0
DAMPING = 0.35
STOP, STEP = 4.0, 0.1


def between(time):
    """Place and velocity of the block between two stops."""
    rate = math.sqrt(STIFFNESS / MASS)
    lower, upper = LIMITS
    gap = (upper - lower) / SPEED
    half = gap + math.pi / rate
    # From the lower limit upwards.
    turns, rest = divmod(time - lower / SPEED, 2.0 * half)
    sign = 1.0 if rest < half else -1.0
    rest -= 0.0 if rest < half else half
    start, end = (lower, upper) if sign > 0.0 else (upper, lower)
    if rest < gap:
        return start + sign * SPEED * rest, sign * SPEED
    phase = rate * (rest - gap)
    return end + sign * SPEED / rate * math.sin(phase), sign * SPEED * math.cos(phase)


def energy(speed):
    return speed / DAMPING - math.log1p(DAMPING * speed) / DAMPING**2


def rebound():
    """The speed at which the other block leaves."""
    low, high = 0.0, min(SPEED, (1.0 - 1e-15) / DAMPING)
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if energy(-middle) < energy(SPEED) else (low, middle)
    return low


if __name__ == "__main__":
    here = Path(__file__).parent
    with open(here / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", "x", "v"])
        for step in range(round(STOP / STEP) + 1):
            writer.writerow([f"{value:.15g}" for value in (step * STEP, *between(step * STEP))])
    print("rebound", repr(-rebound()), "depth", math.sqrt(2.0 * MASS / STIFFNESS * energy(SPEED)))
