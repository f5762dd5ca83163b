"""Writes reference.csv: a rigid slider-crank running free under gravity (needs numpy and scipy).

One degree of freedom: I(phi) phi'' + I'(phi) phi'^2 / 2 + V'(phi) = 0. Order 8, tolerance 1e-13, checked
against conservation of energy and by Radau IIA at 1e-12. Joint forces are Newton's law body by body.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

R, L, LINE, BLOCK, GRAVITY = 0.152, 0.304, 2770 * 7.854e-5, 0.1, 9.81
CRANK, ROD = LINE * R, LINE * L
SPEED, STOP, STEPS = 30.0, 1.0, 50


def geometry(phi):
    """Rod angle psi, and psi, slider and rod's centre differentiated by phi once and twice."""
    psi = -np.arcsin(R / L * np.sin(phi))
    first = -R * np.cos(phi) / (L * np.cos(psi))
    second = (R * np.sin(phi) + L * np.sin(psi) * first**2) / (L * np.cos(psi))
    slider = R * np.cos(phi) + L * np.cos(psi)
    slider1 = -R * np.sin(phi) - L * np.sin(psi) * first
    slider2 = -R * np.cos(phi) - L * (np.cos(psi) * first**2 + np.sin(psi) * second)
    x1, x2 = (slider1 - R * np.sin(phi)) / 2, (slider2 - R * np.cos(phi)) / 2
    y1, y2 = R * np.cos(phi) / 2, -R * np.sin(phi) / 2
    return psi, (first, second), (slider, slider1, slider2), (x1, x2), (y1, y2)


def inertia(phi):
    """I(phi) and half its derivative."""
    _, (p1, p2), (_, s1, s2), (x1, x2), (y1, y2) = geometry(phi)
    whole = CRANK * R**2 / 3 + ROD * (x1**2 + y1**2 + L**2 / 12 * p1**2) + BLOCK * s1**2
    half = ROD * (x1 * x2 + y1 * y2 + L**2 / 12 * p1 * p2) + BLOCK * s1 * s2
    return whole, half


def rate2(phi, rate):
    whole, half = inertia(phi)
    return -(half * rate**2 + (CRANK + ROD) * GRAVITY * R / 2 * np.cos(phi)) / whole


def solve(method, tolerance):
    times = np.linspace(0.0, STOP, STEPS + 1)
    start, span = [0.0, SPEED], (0.0, STOP)
    options = {"method": method, "t_eval": times, "rtol": tolerance, "atol": 1e-13}
    return solve_ivp(lambda _, y: [y[1], rate2(*y)], span, start, **options)


solution = solve("DOP853", 1e-13)
assert np.abs(solution.y - solve("Radau", 1e-12).y).max() < 1e-8
t, (phi, rate) = solution.t, solution.y
energy = 0.5 * inertia(phi)[0] * rate**2 + (CRANK + ROD) * GRAVITY * R / 2 * np.sin(phi)
assert np.ptp(energy) < 1e-11
turn = rate2(phi, rate)
psi, (p1, p2), (x_b, s1, s2), (x1, x2), (y1, y2) = geometry(phi)
a_b, a_x, a_y = (one * turn + two * rate**2 for one, two in ((s1, s2), (x1, x2), (y1, y2)))
spin, spin2 = p1 * rate, p1 * turn + p2 * rate**2
b_x = -BLOCK * a_b  # the block on the rod
force_x, force_y = ROD * a_x - b_x, ROD * (a_y + GRAVITY)
# Moments about the rod's centre; A is at -L/2, B at L/2: (B - A) x L/2 = J psi''.
b_y = force_y / 2 + (ROD * L / 12 * spin2 + np.sin(psi) * (b_x - force_x) / 2) / np.cos(psi)
a_force = (force_x, force_y - b_y)
o_x = a_force[0] - CRANK * R / 2 * (np.cos(phi) * rate**2 + np.sin(phi) * turn)
o_y = a_force[1] + CRANK * (R / 2 * (np.cos(phi) * turn - np.sin(phi) * rate**2) + GRAVITY)
# Moments on the crank about its pivot, not used so far, must come out.
moments = R * (np.sin(phi) * a_force[0] - np.cos(phi) * (a_force[1] + CRANK * GRAVITY / 2))
assert np.abs(moments - CRANK * R**2 / 3 * turn).max() < 1e-11
names = "t phi phi_dot x_B v_B a_B psi psi_dot Ax Ay Bx By N Ox Oy"
columns = [t, phi, rate, x_b, s1 * rate, a_b, psi, spin, *a_force, b_x, b_y, b_y + BLOCK * GRAVITY, o_x, o_y]
lines = [names.replace(" ", ",")]
lines += [",".join(f"{value:.15g}" for value in row) for row in zip(*columns)]
Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
