"""Writes latitude.csv and pole.csv: Foucault's pendulum in a frame that turns with the ground (needs mpmath).

With r from the pivot, |r| = L, W the rate of the frame and gravity constant in it:
r'' = g - 2 W x r' - W x (W x r) - lambda r,   lambda L^2 = r'^2 + r . (g - 2 W x r' - W x (W x r)).
latitude.csv by Taylor's method with 20 digits. pole.csv is the thin rod of ../thin_rod, whose motion in an inertial frame is
known by Jacobi's functions, seen from a frame that turns about the vertical.
L. D. Landau, E. M. Lifshitz, Mechanics, 3rd ed., section 39.
"""

from pathlib import Path

from mpmath import cos, matrix, mp, mpf, nstr, odefun, sin

HERE = Path(__file__).parent
mp.dps = 20
LENGTH, RATE, LATITUDE, LEAN = mpf("1.5"), mpf("0.35"), mpf("0.8"), mpf("0.4")
FRAME = [mpf(0), RATE * cos(LATITUDE), RATE * sin(LATITUDE)]
GRAVITY = [mpf(0), mpf(0), mpf("-9.81")]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def slope(_, state):
    r, v = list(state[:3]), list(state[3:])
    coriolis, centripetal = cross(FRAME, v), cross(FRAME, cross(FRAME, r))
    free = [g - 2 * c - p for g, c, p in zip(GRAVITY, coriolis, centripetal)]
    tension = (dot(v, v) + dot(r, free)) / dot(r, r)
    return v + [f - tension * x for f, x in zip(free, r)]


def latitude():
    start = [LENGTH * sin(LEAN), mpf(0), -LENGTH * cos(LEAN), mpf(0), mpf(0), mpf(0)]
    at = odefun(slope, 0, start)
    lines = ["t,x,y,z"]
    for step in range(81):
        time = mpf(step) / 10
        lines.append(",".join([nstr(time, 12)] + [nstr(x, 17) for x in at(time)[:3]]))
    (HERE / "latitude.csv").write_text("\n".join(lines) + "\n")


def pole():
    rows = (HERE / "../thin_rod/reference.csv").read_text().split()
    lines = ["t,x,y,z"]
    for row in rows[1:]:
        time, x, y, z = (mpf(value) for value in row.split(",")[:4])
        c, s = cos(RATE * time), sin(RATE * time)
        seen = matrix([c * x + s * y, c * y - s * x, z])
        lines.append(",".join([nstr(time, 12)] + [nstr(value, 17) for value in seen]))
    (HERE / "pole.csv").write_text("\n".join(lines) + "\n")


latitude()
pole()
