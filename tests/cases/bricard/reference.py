"""Writes reference.csv: Bricard's orthogonal six-bar linkage under gravity, with one coordinate (needs numpy and scipy).

Six hinges at corners of a unit cube along the bars x, -y, z, -x, y, -z; every hinge is across both of its bars. The angles between
bars are equal at every other hinge, p and q, and keep tan^2(p/2) + tan^2(q/2) + tan^2(p/2) tan^2(q/2) = 3, which a circle parametrizes:
(tan(p/2), tan(q/2)) = r (cos c, sin c). Inertia m(c) and potential V(c) by Fourier series; Hamilton's equations by DOP853.
The loop closes to roundoff and the energy is kept.
R. Bricard, Lecons de cinematique II, Gauthier-Villars 1927; the same linkage is problem A04 of the IFToMM
library of computational benchmark problems for multibody dynamics.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY, STOP, STEPS, POINTS = 9.81, 10.0, 100, 512
# Bars of 1 m and 1 kg with a radius of 50 mm: moments about the axis and across it.
ABOUT, ACROSS = 0.05**2 / 2.0, 0.05**2 / 4.0 + 1.0 / 12.0


def turned(vector, axis, angle):
    return np.cos(angle) * vector + np.sin(angle) * np.cross(axis, vector)


def hinges(c):
    """The six hinges of the loop at a place on the circle and where it ends; bars and the axis at the first end of each."""
    cc, ss = np.cos(c) ** 2, np.sin(c) ** 2
    square = 6.0 / (1.0 + np.sqrt(1.0 + 12.0 * cc * ss))
    r = np.sqrt(square)
    p, q = 2.0 * np.arctan(r * np.cos(c)), 2.0 * np.arctan(r * np.sin(c))
    # The fixed bar leads from (0, 0, 1) to the origin.
    place, bar, axis = np.zeros(3), np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0])
    found, bars, axes = [place], [], []
    for k in range(6):
        angle = (p, q)[k % 2]
        # Right angles at the start: the bar turns by as much as the hinge says.
        bar = turned(bar, axis, SIGNS[k] * angle)
        place = place + bar
        found.append(place)
        bars.append(bar)
        axes.append(axis)
        axis = TWISTS[k] * np.cross(bar, axis)
    return np.array(found), np.array(bars), np.array(axes)


def at_start():
    """Signs with which the loop is the six edges of the cube."""
    edges = np.array([[1, 0, 0], [0, -1, 0], [0, 0, 1], [-1, 0, 0], [0, 1, 0], [0, 0, -1]], float)
    bar, axis, signs, twists = np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]), [], []
    for k in range(6):
        signs.append(float(np.dot(np.cross(axis, bar), edges[k])))
        bar = edges[k]
        across = np.cross(bar, axis)
        # Of both, the one that keeps the twist of bars alternating.
        twists.append(1.0 if k % 2 == 0 else -1.0)
        axis = twists[-1] * across
    return signs, twists


SIGNS, TWISTS = at_start()


def spectral(values):
    """Derivative of a periodic function from its values at equidistant points."""
    n = len(values)
    factors = 1j * np.fft.fftfreq(n, 1.0 / n)
    factors[n // 2] = 0.0
    factors = factors.reshape(-1, *[1] * (values.ndim - 1))
    return np.fft.ifft(factors * np.fft.fft(values, axis=0), axis=0).real


def series(values):
    """The function through values at equidistant points, and its derivative."""
    n = len(values)
    a = np.fft.rfft(values) / n
    k = np.arange(len(a))
    weights = np.where((k == 0) | (k == n // 2), 1.0, 2.0)

    def at(c):
        e = weights * a * np.exp(1j * k * c)
        return e.sum().real, (1j * k * e).sum().real

    return at


def main():
    grid = 2.0 * np.pi * np.arange(POINTS) / POINTS
    places, bars, axes = (np.array(x) for x in zip(*(hinges(c) for c in grid)))
    gap = max(np.abs(places[:, 6]).max(), np.abs(places[:, 5] - [0, 0, 1]).max())
    assert gap < 1e-13, f"the loop stays open by {gap}"
    centers = 0.5 * (places[:, :5] + places[:, 1:6])
    velocity, turn, roll = spectral(centers), spectral(bars[:, :5]), spectral(axes[:, :5])
    spin = (np.cross(bars[:, :5], axes[:, :5]) * roll).sum(2)
    inertia = ((velocity**2).sum(2) + ACROSS * (turn**2).sum(2) + ABOUT * spin**2).sum(1)
    potential = GRAVITY * centers[:, :, 1].sum(1)
    mass, load = series(inertia), series(potential)

    def rates_of(_, y):
        (m, dm), (_, dv) = mass(y[0]), load(y[0])
        speed = y[1] / m
        return [speed, 0.5 * dm * speed**2 - dv]

    start = np.pi / 4.0
    times = np.linspace(0.0, STOP, STEPS + 1)
    run = solve_ivp(rates_of, (0.0, STOP), [start, 0.0], "DOP853", times, rtol=1e-13, atol=1e-14)
    energy = load(start)[0]
    drift = max(abs(y[1] ** 2 / (2 * mass(y[0])[0]) + load(y[0])[0] - energy) for y in run.y.T)
    assert drift < 1e-10 * GRAVITY, drift
    print("loop closes to", gap, "energy to", drift, "coordinate from", run.y[0].min(), "to", run.y[0].max())
    lines = ["t,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4"]
    for time, c in zip(times, run.y[0]):
        places, _, _ = hinges(c)
        lines.append(",".join(f"{x:.15g}" for x in [time, *places[1:5].ravel()]))
    Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
