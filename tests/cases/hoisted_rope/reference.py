"""A heavy rope with a load swings while a winch takes it in: small motions to the side, by Galerkin's method with polynomials over all of it.

A point of the rope at the length `s` from the load obeys `rho A u_tt = (T u_s)_s`, `T = (m + rho A s)(g - L'')`, the load
`m u_tt = T u_s`, the winch `u(L(t), t) = 0`. On `s = L(t) (1 + y) / 2`, with `w = y_t = -(1 + y) L'/L` of a point of the rope and rates
at a fixed place, `u_tt = d^2u/dt^2 + 2 w du_y/dt + w^2 u_yy + w_t u_y`, `w_t = -(1 + y)(L''/L - 2 (L'/L)^2)` along the point.

Source: W. D. Zhu, J. Ni, Energetics and stability of translating media with an arbitrarily varying length, J. Vib. Acoust. 122 (2000)
295-304 (equation of motion).
"""

import csv
import sys

import numpy as np
from numpy.polynomial import Legendre
from scipy.integrate import solve_ivp

GRAVITY, LOAD, LINE, START, END, STEP = 9.81, 2.0, 1.5, 4.0, 2.0, 0.05
# Force to the side at the load that holds both until the start, N.
FORCE = 0.01


def travel(t):
    """Length paid out, with two derivatives: taken in from rest to rest."""
    s = t / END
    return (
        -2.0 * (10 * s**3 - 15 * s**4 + 6 * s**5),
        -2.0 / END * (30 * s**2 - 60 * s**3 + 30 * s**4),
        -2.0 / END**2 * (60 * s - 180 * s**2 + 120 * s**3),
    )


def run(n):
    """Positions of the load and of the point at half the length of the rope at all times, of `n` polynomials that vanish at the winch."""
    y, weights = np.polynomial.legendre.leggauss(n + 4)
    basis = [Legendre.basis(k) * Legendre([0.5, -0.5]) for k in range(n)]
    value, first, second = ([f.deriv(order)(y) if order else f(y) for f in basis] for order in range(3))
    value, first, second = map(np.array, (value, first, second))
    at_load = np.array([f(-1.0) for f in basis])
    at_half = np.array([f(0.0) for f in basis])

    def rates(t, state):
        paid, speed, faster = travel(t)
        length = START + paid
        grown = speed / length
        place, rate = state[:n], state[n:]
        moving, pushed = -(1 + y) * grown, -(1 + y) * (faster / length - 2 * grown**2)
        passing = 2 * moving * (rate @ first) + moving**2 * (place @ second) + pushed * (place @ first)
        tension = (LOAD + LINE * length * (1 + y) / 2) * (GRAVITY - faster)
        half = length / 2
        force = -(value * weights) @ (LINE * half * passing) - (first * weights) @ (tension / half * (place @ first))
        mass = LINE * half * (value * weights) @ value.T + LOAD * np.outer(at_load, at_load)
        return np.r_[rate, np.linalg.solve(mass, force)]

    times = np.linspace(0, END, round(END / STEP) + 1)
    # At rest T u_s is the force all along.
    still = FORCE / (LINE * GRAVITY) * np.log((LOAD + LINE * START) / (LOAD + LINE * START * (1 + y) / 2))
    start = np.r_[np.linalg.lstsq(value.T, still, rcond=None)[0], np.zeros(n)]
    found = solve_ivp(rates, (0, END), start, "DOP853", times, rtol=1e-11, atol=1e-15)
    assert found.success
    return times, at_load @ found.y[:n], at_half @ found.y[:n]


def main():
    times, load, inside = run(40)
    _, coarse, within = run(32)
    print("off by", abs(load - coarse).max(), abs(inside - within).max(), "of", abs(load).max(), file=sys.stderr)
    with open("reference.csv", "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["t", "load", "inside", "tension"])
        for t, u, w in zip(times, load, inside):
            paid, _, second = travel(t)
            tension = (LOAD + LINE * (START + paid)) * (GRAVITY - second)
            rows.writerow([repr(float(x)) for x in (t, u, w, tension)])


main()
