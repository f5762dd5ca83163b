"""Prints Andrews' squeezer at 0.03 s, by two programs of our own beside the published figures (needs numpy and scipy).

One takes the seven angles of the test set, the other centre and angle of every body with Newton's law for
each and the pins at points: no formula is shared but the geometry. Both solve for accelerations and multipliers,
project positions and velocities onto the pins in short intervals, and integrate with order 8 at 1e-13.
"""

import numpy as np
from scipy.integrate import solve_ivp

MASS = np.array([0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498])
INERTIA = np.array([2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5])
RR, RA, DD, DA = 7e-3, 92e-5, 28e-3, 115e-4
SS, SA, SB, SC, SD = 35e-3, 1874e-5, 1043e-5, 18e-3, 2e-2
EE, EA, ZF, FA, ZT, TA, TB = 2e-2, 1421e-5, 2e-2, 1421e-5, 4e-2, 2308e-5, 916e-5
UU, UA, UB = 4e-2, 1228e-5, 449e-5
A, B, C = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072])
STIFFNESS, LENGTH, TORQUE = 4530.0, 0.07785, 0.033
# beta, theta, gamma, phi, delta, omega, epsilon
START = np.array(
    [
        -0.0617138900142764496358948458001,
        0.0,
        0.455279819163070380255912382449,
        0.222668390165885884674473185609,
        0.487364979543842550225598953530,
        -0.222668390165885884674473185609,
        1.23054744454982119249735015568,
    ]
)
PUBLISHED = np.array(
    [
        0.1581077119629904e2,
        -0.1575637105984298e2,
        0.4082224013073101e-1,
        -0.5347301163226948e0,
        0.5244099658805304e0,
        0.5347301163226948e0,
        0.1048080741042263e1,
    ]
)

# In bodies' frames, origin at the pivot or first pin, x along the angle: centre of mass.
CENTRE = np.array(
    [(RA, 0), (-DA, 0), (SB, -SA), (0, -(EE - EA)), (TB, TA), (ZF - FA, 0), (UB, -UA)]
)
# Pins: body and its point, then another body and its point, or the ground's point.
PINS = [
    (0, (0, 0), None, (0, 0)),
    (1, (0, 0), 0, (RR, 0)),
    (2, (0, 0), None, B),
    (4, (0, 0), None, A),
    (6, (0, 0), None, A),
    (3, (0, 0), 4, (ZT, 0)),
    (5, (0, 0), 6, (0, -UU)),
    (1, (-DD, 0), 2, (0, -SS)),
    (1, (-DD, 0), 3, (0, -EE)),
    (1, (-DD, 0), 5, (ZF, 0)),
]
ANGLES = np.array(
    [
        [1, 0, 0, 0, 0, 0, 0],
        [1, 1, 0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 1, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 1, 1],
        [0, 0, 0, 0, 0, 0, 1],
    ]
)


def turned(angle, vector):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def spring(gamma):
    """Force on the end of the spring that body 3 carries, and that end from the pivot of the body."""
    arm = turned(gamma, (SD, -SC))
    line = B + arm - C
    length = np.hypot(*line)
    return -STIFFNESS * (length - LENGTH) / length * line, arm


class Angles:
    """The seven angles, as the test set has them."""

    size = 7

    def start(self):
        return START

    def angles(self, q):
        return q

    def equations(self, q, v):
        _, th, ga, ph, de, om, ep = q
        bed, thd, _, phd, ded, omd, epd = v
        m, i = MASS, INERTIA
        e, f = EE - EA, ZF - FA
        mass = np.zeros((7, 7))
        mass[0, 0] = m[0] * RA**2 + m[1] * (RR**2 - 2 * DA * RR * np.cos(th) + DA**2) + i[0] + i[1]
        mass[1, 0] = mass[0, 1] = m[1] * (DA**2 - DA * RR * np.cos(th)) + i[1]
        mass[1, 1] = m[1] * DA**2 + i[1]
        mass[2, 2] = m[2] * (SA**2 + SB**2) + i[2]
        mass[3, 3] = m[3] * e**2 + i[3]
        mass[4, 3] = mass[3, 4] = m[3] * (e**2 + ZT * e * np.sin(ph)) + i[3]
        mass[4, 4] = m[3] * (ZT**2 + 2 * ZT * e * np.sin(ph) + e**2) + m[4] * (TA**2 + TB**2) + i[3] + i[4]
        mass[5, 5] = m[5] * f**2 + i[5]
        mass[6, 5] = mass[5, 6] = m[5] * (f**2 - UU * f * np.sin(om)) + i[5]
        mass[6, 6] = m[5] * (f**2 - 2 * UU * f * np.sin(om) + UU**2) + m[6] * (UA**2 + UB**2) + i[5] + i[6]
        force, arm = spring(ga)
        load = np.array(
            [
                TORQUE - m[1] * DA * RR * thd * (thd + 2 * bed) * np.sin(th),
                m[1] * DA * RR * bed**2 * np.sin(th),
                arm[0] * force[1] - arm[1] * force[0],
                m[3] * ZT * e * ded**2 * np.cos(ph),
                -m[3] * ZT * e * phd * (phd + 2 * ded) * np.cos(ph),
                -m[5] * UU * f * epd**2 * np.cos(om),
                m[5] * UU * f * omd * (omd + 2 * epd) * np.cos(om),
            ]
        )
        return mass, load

    def constraints(self, q, v):
        """Residual, Jacobian, and what the Jacobian's rate leaves on the right."""
        sums = [0, 1], [2], [3, 4], [4], [5, 6], [6]
        parts = [
            (RR, 0, [0], (0, 1, 2)),
            (-DD, 0, sums[0], (0, 1, 2)),
            (0, -SS, sums[1], (0,)),
            (0, -EE, sums[2], (1,)),
            (ZT, 0, sums[3], (1,)),
            (ZF, 0, sums[4], (2,)),
            (0, -UU, sums[5], (2,)),
        ]
        residual, jacobian, right = np.concatenate([-B, -A, -A]), np.zeros((6, 7)), np.zeros(6)
        for x, y, angle, loops in parts:
            sign = 1 if angle in ([0], [0, 1]) else -1
            r = sign * turned(q[angle].sum(), (x, y))
            for loop in loops:
                at = slice(2 * loop, 2 * loop + 2)
                residual[at] += r
                for column in angle:
                    jacobian[at, column] += (-r[1], r[0])
                right[at] += v[angle].sum() ** 2 * r
        return residual, jacobian, right


class Bodies:
    """Centre of mass and angle of every body."""

    size = 21

    def start(self):
        angle = ANGLES @ START
        origin = np.zeros((7, 2))
        origin[1] = turned(angle[0], (RR, 0))
        origin[2], origin[4], origin[6] = B, A, A
        origin[3], origin[5] = A + turned(angle[4], (ZT, 0)), A + turned(angle[6], (0, -UU))
        centre = [origin[i] + turned(angle[i], CENTRE[i]) for i in range(7)]
        return np.column_stack([centre, angle]).ravel()

    def angles(self, q):
        return np.linalg.solve(ANGLES, q[2::3])

    def equations(self, q, _v):
        mass = np.diag(np.column_stack([MASS, MASS, INERTIA]).ravel())
        load = np.zeros(21)
        load[2] = TORQUE
        force, _ = spring(q[8])
        arm = turned(q[8], np.array([SD, -SC]) - CENTRE[2])
        load[6:9] = *force, arm[0] * force[1] - arm[1] * force[0]
        return mass, load

    def constraints(self, q, v):
        residual, jacobian, right = np.zeros(20), np.zeros((20, 21)), np.zeros(20)
        for number, (first, point, second, other) in enumerate(PINS):
            at = slice(2 * number, 2 * number + 2)
            for sign, body, place in ((1, first, point), (-1, second, other)):
                if body is None:
                    residual[at] -= place
                    continue
                r = turned(q[3 * body + 2], np.array(place) - CENTRE[body])
                residual[at] += sign * (q[3 * body : 3 * body + 2] + r)
                jacobian[at, 3 * body : 3 * body + 2] += sign * np.eye(2)
                jacobian[at, 3 * body + 2] += sign * np.array([-r[1], r[0]])
                right[at] += sign * v[3 * body + 2] ** 2 * r
        return residual, jacobian, right


def project(model, y):
    q, v = np.split(y, 2)
    for _ in range(4):
        residual, jacobian, _ = model.constraints(q, v)
        q = q - np.linalg.pinv(jacobian) @ residual
    _, jacobian, _ = model.constraints(q, v)
    return np.concatenate([q, v - np.linalg.pinv(jacobian) @ (jacobian @ v)])


def rate(model, y):
    q, v = np.split(y, 2)
    mass, load = model.equations(q, v)
    _, jacobian, right = model.constraints(q, v)
    count = len(right)
    whole = np.block([[mass, jacobian.T], [jacobian, np.zeros((count, count))]])
    return np.concatenate([v, np.linalg.solve(whole, np.concatenate([load, right]))[: model.size]])


def run(model, tolerance, parts=60):
    y = project(model, np.concatenate([model.start(), np.zeros(model.size)]))
    for k in range(parts):
        span = (0.03 * k / parts, 0.03 * (k + 1) / parts)
        y = solve_ivp(lambda _, y: rate(model, y), span, y, method="DOP853", rtol=tolerance, atol=tolerance).y[:, -1]
        y = project(model, y)
    return model.angles(y[: model.size]), model.angles(y[model.size :])


if __name__ == "__main__":
    np.set_printoptions(precision=13, linewidth=150)
    for model in (Angles(), Bodies()):
        for tolerance in (1e-11, 1e-13):
            angles, rates = run(model, tolerance)
            worst = np.abs(angles / PUBLISHED - 1).max()
            print(type(model).__name__, tolerance, f"largest relative difference from the published {worst:.1e}")
            print(angles, rates, sep="\n")
