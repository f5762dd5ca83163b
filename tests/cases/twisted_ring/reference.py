"""Small motions of a twisted ring, cut and clamped at a seam, by the linearized equations of Kirchhoff's rod.

A naturally straight round rod, bent to a ring of radius 1 (EI = 1, EA = 1e4, rho A = 1), under the torque M that twists it. As it stands it
carries the moment m = z + M t and the force f = M z (t along it, n towards the centre, z along the ring's axis). A small displacement u and a
small turn a of the sections change them by dm and df:

    u' = a x t + t (t . df + f . (a x t)) / EA        dm = a x m + C a',  C = 1 across t and GJ along it
    df' = -w^2 u                                      dm' = -u' x f - t x df - w^2 rho I_p t (t . a)

In axes that turn along with t the coefficients are constant: a matrix exponential solves them. u = 0 and a = 0 at the first end; u = 0,
a . n = a . z = 0 and dm . t = 0 at the last, which turns about the tangent; u . z = 0 half-way, held by a force along z. Motions exp(i w t) are where
the determinant of these conditions vanishes; a square of w below zero is that of a rate of growth.
"""

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

AXIAL, POLAR, TORSION = 1e4, 2e-4, 0.8
T, N, Z = np.eye(3)
NONE = np.zeros((3, 3))


def cross(v):
    """Matrix of v x."""
    return np.cross(v, np.eye(3)).T


def conditions(square, torque):
    moment, force = Z + torque * T, torque * Z
    turning, along = -cross(Z), np.outer(T, T)
    compliance = np.diag([1 / TORSION, 1.0, 1.0])
    tilting = (np.eye(3) + np.outer(T, force) / AXIAL) @ -cross(T)
    slope = np.hstack([NONE, tilting, along / AXIAL, NONE])
    line = slope + np.hstack([turning, NONE, NONE, NONE])
    section = np.hstack([NONE, turning + compliance @ cross(moment), NONE, compliance])
    forces = np.hstack([-square * np.eye(3), NONE, turning, NONE])
    moments = np.hstack([NONE, -square * POLAR * along, -cross(T), turning]) + cross(force) @ slope
    half = expm(np.pi * np.vstack([line, section, forces, moments]))
    # Unknown: force and moment at the first end, then the force that holds half-way.
    middle = np.hstack([half[:, 6:], np.zeros((12, 1))])
    held = middle.copy()
    held[8, 6] = 1.0
    end = half @ held
    return np.linalg.det(np.vstack([end[[0, 1, 2, 4, 5, 9]], middle[2]]))


def squares(torque, low, high, count=4001):
    """Squares of frequencies in a range."""
    places = np.linspace(low, high, count)
    values = [conditions(p, torque) for p in places]
    rows = zip(places, places[1:], values, values[1:])
    return [brentq(conditions, a, b, args=(torque,), xtol=1e-15) for a, b, x, y in rows if x * y < 0]


def main():
    for share in (0.9, 0.99, 1.01):
        found = squares(share * np.sqrt(3), -0.5, 3.0)
        print(share, [float(np.sign(p) * np.sqrt(abs(p))) for p in found])


main()
