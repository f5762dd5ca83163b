"""A door on a vertical axis under a level acceleration: angle'' = m a r cos(angle) / I, by RK4 with a million steps."""

import math

MASS, ARM, INERTIA, LEVEL = 1.0, 0.5, 0.1 + 0.25, 1.0
STEPS = 1_000_000


def at(time):
    h, angle, rate = time / STEPS, 0.0, 0.0
    turn = lambda angle: MASS * LEVEL * ARM * math.cos(angle) / INERTIA
    for _ in range(STEPS):
        a = turn(angle)
        b = turn(angle + h / 2 * rate)
        c = turn(angle + h / 2 * rate + h * h / 4 * a)
        d = turn(angle + h * rate + h * h / 2 * b)
        angle += h * rate + h * h / 6 * (a + b + c)
        rate += h / 6 * (a + 2 * b + 2 * c + d)
    return math.cos(angle), math.sin(angle)


if __name__ == "__main__":
    print(at(1.0))
