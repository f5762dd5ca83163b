"""Writes reference.csv: a rigid double pendulum from the horizontal (needs numpy and scipy).

Lagrange's equations in the two angles by DOP853 at 1e-13, checked against Newton-Euler equations in
absolute coordinates by Radau IIA at 1e-12 and against conservation of energy.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

LENGTH, MASS, GRAVITY, STOP, STEPS = (1.0, 0.8), (1.0, 0.5), 9.81, 3.0, 60
INERTIA = [m * l**2 / 12 for m, l in zip(MASS, LENGTH)]


def lagrange(_, y):
    """Angles against the horizontal, rates."""
    (a, b, u, v), (l, k), (m, n) = y, LENGTH, MASS
    c, s = np.cos(a - b), np.sin(a - b)
    mass = np.array([[m * l**2 / 3 + n * l**2, n * l * k / 2 * c], [n * l * k / 2 * c, n * k**2 / 3]])
    load = -n * l * k / 2 * s * np.array([v**2, -(u**2)])
    load -= GRAVITY * np.array([(m / 2 + n) * l * np.cos(a), n * k / 2 * np.cos(b)])
    return [u, v, *np.linalg.solve(mass, load)]


def newton(a, b, u, v):
    """Accelerations of centres and angles, forces of the pivot on the first and of the pin on the second."""
    arm = [LENGTH[0] / 2 * np.array([np.cos(a), np.sin(a)]), LENGTH[1] / 2 * np.array([np.cos(b), np.sin(b)])]
    across = [np.array([-r[1], r[0]]) for r in arm]
    system, right = np.zeros((10, 10)), np.zeros(10)
    system[:6, :6] = np.diag([MASS[0], MASS[0], INERTIA[0], MASS[1], MASS[1], INERTIA[1]])
    right[[1, 4]] = -MASS[0] * GRAVITY, -MASS[1] * GRAVITY
    # Pivot: c1 - r1 = 0. Pin: c2 - r2 - c1 - r1 = 0.
    jacobian = np.zeros((4, 6))
    jacobian[:2, :2], jacobian[:2, 2] = np.eye(2), -across[0]
    jacobian[2:, :2], jacobian[2:, 2] = -np.eye(2), -across[0]
    jacobian[2:, 3:5], jacobian[2:, 5] = np.eye(2), -across[1]
    system[6:, :6], system[:6, 6:] = jacobian, -jacobian.T
    right[6:8], right[8:] = -(u**2) * arm[0], -(u**2) * arm[0] - v**2 * arm[1]
    return np.linalg.solve(system, right)


def by_newton(_, y):
    found = newton(*y)
    return [y[2], y[3], found[2], found[5]]


def energy(y):
    a, b, u, v = y
    (l, k), (m, n) = LENGTH, MASS
    kinetic = (m / 3 + n) * l**2 * u**2 / 2 + n * k**2 * v**2 / 6 + n * l * k / 2 * u * v * np.cos(a - b)
    return kinetic + GRAVITY * ((m / 2 + n) * l * np.sin(a) + n * k / 2 * np.sin(b))


times = np.linspace(0.0, STOP, STEPS + 1)
start = [0.0, 0.0, 0.0, 0.0]
y = solve_ivp(lagrange, (0.0, STOP), start, method="DOP853", t_eval=times, rtol=1e-13, atol=1e-13).y
other = solve_ivp(by_newton, (0.0, STOP), start, method="Radau", t_eval=times, rtol=1e-11, atol=1e-12).y
assert np.abs(y - other).max() < 1e-6, np.abs(y - other).max()
assert np.ptp(energy(y)) < 1e-10
forces = np.array([newton(*column)[6:] for column in y.T]).T
elbow = LENGTH[0] * np.array([np.cos(y[0]), np.sin(y[0])])
tip = elbow + LENGTH[1] * np.array([np.cos(y[1]), np.sin(y[1])])
lines = ["t,angle1,angle2,rate1,rate2,x_elbow,y_elbow,x_tip,y_tip,Ox,Oy,Px,Py"]
rows = zip(times, *y, *elbow, *tip, *forces)
lines += [",".join(f"{value:.15g}" for value in row) for row in rows]
Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
