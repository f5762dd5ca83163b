"""Prints lines at rest in a current, by the equilibrium of an elastic line alone: r' = (1 + |n| / EA) t, n' = -f(t), t = n / |n|, with the drag f of
the current by the direction of the line; shot from end to end (needs numpy and scipy)."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

LENGTH, DIAMETER, DENSITY, DRAG = 50.0, 0.02, 1025.0, 1.2
STIFFNESS = 1e8 * 0.25 * np.pi * DIAMETER**2


def force(tangent, current, skin):
    current = np.array(current)
    along = current @ tangent
    across = current - along * tangent
    faced = 0.5 * DENSITY * DIAMETER
    return faced * (DRAG * np.linalg.norm(across) * across + np.pi * skin * abs(along) * along * tangent)


def line(first, current, skin, where=LENGTH):
    dimension = len(first)

    def rates(s, y):
        n = y[dimension:]
        tension = np.linalg.norm(n)
        tangent = n / tension
        return np.concatenate([(1.0 + tension / STIFFNESS) * tangent, -force(tangent, current(s / LENGTH), skin)])

    start = np.concatenate([np.zeros(dimension), first])
    return solve_ivp(rates, (0.0, where), start, method="DOP853", rtol=1e-13, atol=1e-11).y[:, -1]


def main():
    for name, far, current, skin, guess in [
        ("plane", [30.0, 0.0], lambda s: [0.0, -1.0], 0.0, [30.0, -100.0]),
        ("slanted", [30.0, 0.0], lambda s: [0.6, -0.8], 0.02, [60.0, -50.0]),
        ("sheared", [30.0, 0.0], lambda s: [0.3, -0.5 - s * s], 0.02, [40.0, -50.0]),
        ("space", [30.0, 0.0, 0.0], lambda s: [0.5, 0.6, -0.8], 0.02, [75.0, 55.0, -75.0]),
    ]:
        far = np.array(far)
        found = root(lambda n, current=current, far=far, skin=skin: line(n, current, skin)[: len(far)] - far, guess, tol=1e-13)
        middle = line(found.x, current, skin, 0.5 * LENGTH)
        n = middle[len(far) :]
        print(name, "reaction:", (-found.x).tolist(), "middle:", middle[: len(far)].tolist(), "tension:", float(np.linalg.norm(n)))


if __name__ == "__main__":
    main()
