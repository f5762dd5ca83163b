"""Writes reference.csv: a rigid four-bar linkage at constant crank speed, with 30 digits (needs mpmath).

Closed form of the positions, its derivatives by solving the differentiated loop, then the nine
Newton-Euler equations for four joint forces and the driving torque.
"""

from pathlib import Path

from mpmath import acos, atan2, cos, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 30
A, B, C, D = mpf("0.1"), mpf("0.3"), mpf("0.25"), mpf("0.3")  # crank, coupler, rocker, ground, m
SPEED, GRAVITY = 10, mpf("9.81")
MASS = [mpf("0.2"), mpf("0.5"), mpf("0.4")]
INERTIA = [mpf("0.0002"), mpf("0.005"), mpf("0.0025")]
# Centres of mass in the bodies' frames, x along the link from its first pin: crank, coupler, rocker.
CENTRE = [(A / 2, 0), (mpf("0.14"), mpf("0.03")), (C / 2, 0)]


def cross(r, f):
    return r[0] * f[1] - r[1] * f[0]


def turned(angle, vector):
    c, s = cos(angle), sin(angle)
    return (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1])


def accelerated(start, angle, rate, rate2, vector):
    """Acceleration of a point of a body whose origin has acceleration `start`."""
    x, y = turned(angle, vector)
    return (start[0] - rate2 * y - rate**2 * x, start[1] + rate2 * x - rate**2 * y)


def row(time):
    phi = SPEED * time
    a = turned(phi, (A, 0))
    span = (D - a[0], -a[1])  # from the crank pin to the rocker's pivot
    length = sqrt(span[0] ** 2 + span[1] ** 2)
    # The open branch: the other pin lies to the left of that line.
    inner = (B**2 + length**2 - C**2) / (2 * B * length)
    three = atan2(span[1], span[0]) + acos(inner)
    b = (a[0] + B * cos(three), a[1] + B * sin(three))
    four = atan2(b[1], b[0] - D)
    # a' + w3 x B e3 = w4 x C e4, and the same once more.
    loop = matrix([[-B * sin(three), C * sin(four)], [B * cos(three), -C * cos(four)]])
    w3, w4 = lu_solve(loop, matrix([SPEED * A * sin(phi), -SPEED * A * cos(phi)]))
    right = [
        SPEED**2 * A * cos(phi) + w3**2 * B * cos(three) - w4**2 * C * cos(four),
        SPEED**2 * A * sin(phi) + w3**2 * B * sin(three) - w4**2 * C * sin(four),
    ]
    w3d, w4d = lu_solve(loop, matrix(right))
    angles, rates, rates2 = (phi, three, four), (mpf(SPEED), w3, w4), (mpf(0), w3d, w4d)
    starts = [(mpf(0), mpf(0)), accelerated((0, 0), phi, SPEED, 0, (A, 0)), (mpf(0), mpf(0))]
    centre = [accelerated(starts[i], angles[i], rates[i], rates2[i], CENTRE[i]) for i in range(3)]
    # Unknown: force on the crank at O, on the coupler at A, on the rocker at B and at D, torque on the crank.
    system, load = matrix(9, 9), matrix(9, 1)
    pins = [
        [(0, 1, (0, 0)), (2, -1, (A, 0))],
        [(2, 1, (0, 0)), (4, -1, (B, 0))],
        [(4, 1, (C, 0)), (6, 1, (0, 0))],
    ]
    for body, acting in enumerate(pins):
        at = 3 * body
        for column, sign, place in acting:
            arm = turned(angles[body], (place[0] - CENTRE[body][0], place[1] - CENTRE[body][1]))
            system[at, column] += sign
            system[at + 1, column + 1] += sign
            system[at + 2, column] -= sign * arm[1]
            system[at + 2, column + 1] += sign * arm[0]
        load[at] = MASS[body] * centre[body][0]
        load[at + 1] = MASS[body] * (centre[body][1] + GRAVITY)
        load[at + 2] = INERTIA[body] * rates2[body]
    system[2, 8] += 1
    forces = list(lu_solve(system, load))
    velocity = (-C * sin(four) * w4, C * cos(four) * w4)
    acceleration = accelerated((0, 0), four, w4, w4d, (C, 0))
    check_power(angles, rates, rates2, centre, forces[8])
    return [time, phi, *a, *b, *velocity, *acceleration, three, four, w3, w4, *forces]


def check_power(angles, rates, rates2, centre, torque):
    """The torque's power is what kinetic energy and height gain: virtual power, body by body."""
    velocities = [turned(angles[0], (-rates[0] * CENTRE[0][1], rates[0] * CENTRE[0][0]))]
    start = turned(angles[0], (0, rates[0] * A))
    own = turned(angles[1], (-rates[1] * CENTRE[1][1], rates[1] * CENTRE[1][0]))
    velocities.append((start[0] + own[0], start[1] + own[1]))
    velocities.append(turned(angles[2], (-rates[2] * CENTRE[2][1], rates[2] * CENTRE[2][0])))
    gained = sum(
        MASS[i] * (velocities[i][0] * centre[i][0] + velocities[i][1] * (centre[i][1] + GRAVITY))
        for i in range(3)
    )
    gained += sum(INERTIA[i] * rates[i] * rates2[i] for i in range(3))
    assert abs(gained - torque * SPEED) < mpf("1e-20"), (gained, torque * SPEED)


NAMES = "t phi x_A y_A x_B y_B vx_B vy_B ax_B ay_B theta3 theta4 w3 w4 Ox Oy Ax Ay Bx By Dx Dy tau"

lines = [NAMES.replace(" ", ",")]
lines += [",".join(nstr(value, 16) for value in row(k * pi / 60)) for k in range(13)]
Path(__file__).with_name("reference.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
