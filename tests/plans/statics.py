"""Equilibria at any deflection: cantilevers by shooting, hanging cables by the elastic catenary."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve


def cantilever(length, bending, axial, shear, force, moment, load, places, tolerance=1e-11):
    """A cantilever along x from the origin in the plane: Reissner's beam, by shooting from its free end.

    `force` and `moment` act at the end, `load` per reference length, all dead. `axial` and `shear` are stiffnesses or
    None where nothing gives. Gives `(x, y, rotation)` at `places`, force and moment on the section at the clamp.
    """
    force_x, force_y = (float(part) for part in force)
    load_x, load_y = (float(part) for part in load)

    def run(end, share, tolerance, **options):
        def rate(s, y):
            angle, m = y[2], y[3]
            n_x, n_y = share * (force_x + load_x * (length - s)), share * (force_y + load_y * (length - s))
            cos, sin = math.cos(angle), math.sin(angle)
            stretch = 1 + ((n_x * cos + n_y * sin) / axial if axial else 0.0)
            lean = (n_y * cos - n_x * sin) / shear if shear else 0.0
            x, y = cos * stretch - sin * lean, sin * stretch + cos * lean
            return [x, y, m / bending, n_x * y - x * n_y]

        start = [0.0, 0.0, end, share * moment]
        return solve_ivp(rate, (length, 0), start, method="DOP853", rtol=tolerance, atol=1e-14 * length, **options)

    # The rotation at the free end is followed from none of the load to all of it.
    size = abs(moment) * length / bending + math.hypot(force_x, force_y) * length**2 / bending
    size += math.hypot(load_x, load_y) * length**3 / bending
    end = 0.0
    shares = np.expm1(np.linspace(0, np.log1p(size), 3 + int(10 * np.log1p(size)))[1:]) / size
    for share, before in zip(shares, [0.0, *shares[:-1]], strict=True):
        guess = end * share / before if before and share * size < 1 else end
        own = tolerance if share == shares[-1] else 1e-7
        miss = lambda angle: run(angle, share, own).y[2, -1]  # noqa: B023, E731
        end = secant(miss, guess, guess + 1e-3 * max(share * size, 1e-12) / (1 + share * size), 10 * own)
    found = run(end, 1.0, tolerance, dense_output=True)
    origin = found.y[:2, -1]
    at = found.sol(np.asarray(places) * length)
    clamp = np.array([force_x + load_x * length, force_y + load_y * length])
    return np.array([at[0] - origin[0], at[1] - origin[1], at[2]]).T, clamp, found.y[3, -1]


def secant(miss, one, two, tolerance):
    """A root near two guesses."""
    first, second = miss(one), miss(two)
    size = max(abs(one), abs(two))
    for _ in range(60):
        if second == first:
            return two
        one, two, first = two, two - second * (two - one) / (second - first), second
        size = max(size, abs(two))
        if abs(two - one) <= tolerance * size:
            return two
        second = miss(two)
    raise ValueError("shooting does not converge")


def catenary(length, weight, axial, span, rise, places):
    """The elastic catenary (Irvine 1981) from the origin to `(span, rise)`: weight per reference length, `axial` stiffness.

    Gives `(x, z)` at `places` and the force that the first end's support exerts: `(-H, V)`.
    """
    total = weight * length

    def form(h, v, s):
        # v is the vertical force that the first support carries; the tension's vertical part at s is weight * s - v.
        left, right = -v / h, (weight * s - v) / h
        x = h * s / axial + h / weight * (np.arcsinh(right) - np.arcsinh(left))
        z = (weight * s**2 / 2 - v * s) / axial + h / weight * (np.hypot(1, right) - np.hypot(1, left))
        return x, z

    def miss(unknown):
        x, z = form(np.exp(unknown[0]) * total, unknown[1] * total, length)
        return [(x - span) / length, (z - rise) / length]

    chord = np.hypot(span, rise)
    if length > chord:
        # Of the inextensible one: sinh(a) / a, Irvine's start.
        ratio = np.sqrt(length**2 - rise**2) / span
        a = brentq(lambda a: np.sinh(a) / a - ratio, 1e-9, 700)
        h = weight * span / (2 * a)
        v = weight / 2 * (length - rise / np.tanh(a))
    else:
        h = axial * (chord / length - 1) + weight * length
        v = total / 2
    found, _, status, _ = fsolve(miss, [np.log(h / total), v / total], xtol=1e-13, full_output=True)
    if status != 1 and max(abs(np.array(miss(found)))) > 1e-10:
        raise ValueError("the catenary does not converge")
    h, v = np.exp(found[0]) * total, found[1] * total
    return np.array([form(h, v, share * length) for share in places]), np.array([-h, v])
