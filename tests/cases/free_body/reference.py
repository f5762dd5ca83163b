"""Writes steady.csv and tumbling.csv: free rigid bodies with three unequal moments (needs mpmath).

Spins along the principal axes by Jacobi's elliptic functions, from where the middle one is zero:
w1 = a cn u, w2 = b sn u, w3 = c dn u, u = p t + u0. The angular momentum, which stays in space, gives two angles of
the axes; the third, about it, is the integral of L (J1 w1^2 + J2 w2^2) / (J1^2 w1^2 + J2^2 w2^2).
Checked against Euler's equations with a quaternion by Taylor's method at 20 digits.
L. D. Landau, E. M. Lifshitz, Mechanics, 3rd ed., section 37.
"""

from pathlib import Path

from mpmath import atan2, ellipf, ellipfun, matrix, mp, mpf, nstr, odefun, quad, sqrt

mp.dps = 25
MOMENTS = [mpf("0.3"), mpf("0.5"), mpf("0.7")]


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a):
    return a / sqrt(dot(a, a))


def columns(*vectors):
    return matrix([[v[i] for v in vectors] for i in range(3)])


class Body:
    """Moments in rising order, spins at the start of which the first and the middle one are not below zero."""

    def __init__(self, start):
        (j1, j2, j3), w = MOMENTS, [mpf(x) for x in start]
        energy = sum(j * x * x for j, x in zip(MOMENTS, w))
        self.size = sqrt(sum((j * x) ** 2 for j, x in zip(MOMENTS, w)))
        square = self.size**2
        assert square > energy * j2, "this is the form about the axis of the largest moment"
        self.c = sqrt((square - energy * j1) / (j3 * (j3 - j1)))
        self.a = sqrt((energy * j3 - square) / (j1 * (j3 - j1)))
        self.p = self.c * sqrt((j3 - j2) * (j3 - j1) / (j1 * j2))
        self.b = (j3 - j1) * self.a * self.c / (j2 * self.p)
        self.m = (j2 - j1) * self.a * self.b / (j3 * self.c * self.p)
        self.u0 = ellipf(atan2(w[1] / self.b, w[0] / self.a), self.m)
        assert max(abs(x - y) for x, y in zip(self.spins(0), w)) < mpf(10) ** -18
        self.fixed = self.frame(0)
        self.turned, self.until = mpf(0), mpf(0)

    def spins(self, time):
        u = self.p * time + self.u0
        sn, cn, dn = (ellipfun(name)(u, m=self.m) for name in ("sn", "cn", "dn"))
        return matrix([self.a * cn, self.b * sn, self.c * dn])

    def momentum(self, time):
        return matrix([j * w for j, w in zip(MOMENTS, self.spins(time))])

    def frame(self, time):
        """The direction of the angular momentum last, the third axis in the plane of the last and the first."""
        along = unit(self.momentum(time))
        third = matrix([0, 0, 1])
        first = unit(third - along * along[2])
        return columns(first, cross(along, first), along)

    def rate(self, time):
        (j1, j2, _), (w1, w2, _) = MOMENTS, self.spins(time)
        return self.size * (j1 * w1**2 + j2 * w2**2) / (j1**2 * w1**2 + j2**2 * w2**2)

    def axes(self, time):
        """Axes in global components as columns, from those at the start; times must rise."""
        self.turned += quad(self.rate, [self.until, time]) if time > self.until else 0
        self.until = time
        c, s = mp.cos(self.turned), mp.sin(self.turned)
        about = matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        return self.fixed * about * self.frame(time).T


def by_taylor(start):
    """The same by another way: a function of time that gives the axes."""

    def rates(_, y):
        (j1, j2, j3), (w1, w2, w3, a, b, c, d) = MOMENTS, y
        return [
            (j2 - j3) / j1 * w2 * w3,
            (j3 - j1) / j2 * w3 * w1,
            (j1 - j2) / j3 * w1 * w2,
            (-b * w1 - c * w2 - d * w3) / 2,
            (a * w1 + c * w3 - d * w2) / 2,
            (a * w2 + d * w1 - b * w3) / 2,
            (a * w3 + b * w2 - c * w1) / 2,
        ]

    solution = odefun(rates, 0, [*map(mpf, start), 1, 0, 0, 0], tol=mpf(10) ** -18)

    def axes(time):
        _, _, _, a, b, c, d = solution(time)
        return matrix(
            [
                [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
            ]
        )

    return axes


def write(name, start, stop, step):
    body, check = Body(start), by_taylor(start)
    head = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)] + ["wx", "wy", "wz"]
    lines, worst = [",".join(["t", *head])], mpf(0)
    for k in range(round(stop / step) + 1):
        time = mpf(str(step)) * k
        axes = body.axes(time)
        if time <= 3:
            worst = max([worst, *(abs(x) for x in axes - check(time))])
        spin = axes * body.spins(time)
        lines.append(",".join(nstr(x, 17) for x in [time, *axes, *spin]))
    assert worst < mpf(10) ** -15, worst
    Path(__file__).with_name(name).write_text("\n".join(lines) + "\n")
    print(name, "modulus squared", nstr(body.m, 6), "both ways within", nstr(worst, 2))


write("steady.csv", ("1.5", "1.0", "2.5"), 10, 0.25)
write("tumbling.csv", ("0", "4", "0.04"), 10, 0.25)
