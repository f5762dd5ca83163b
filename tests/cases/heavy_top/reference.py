"""Writes nutating.csv, let_go.csv and ../thin_rod/reference.csv: a heavy symmetric top about a fixed point (needs mpmath).

Height of the axis u = cos(theta) between its turning points by Jacobi's function:
u = u1 + (u2 - u1) sn^2(w t), u'^2 = (alpha - beta u) (1 - u^2) - (b - a u)^2; precession and spin are integrals of
(b - a u) / (1 - u^2) and n - u precession. The thin rod is the top without spin or moment about its axis: a spherical pendulum.
Checked by the equations of the unit vector along the axis, A e'' = ..., by Taylor's method at 20 digits.
H. Goldstein, C. Poole, J. Safko, Classical Mechanics, 3rd ed., section 5.7.
"""

from pathlib import Path

from mpmath import acos, cos, ellipfun, ellipk, matrix, mp, mpf, nstr, odefun, polyroots, quad, sin, sqrt

mp.dps = 25
GRAVITY = mpf("9.81")


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


class Top:
    """Moments about the fixed point, distance of the centre of mass, spin about the axis; at the start the axis leans
    towards x and moves along y."""

    def __init__(self, mass, reach, moments, spin, lean, precession):
        (self.across, self.about), self.spin, self.reach = moments, spin, reach
        u0 = cos(lean)
        self.load = mass * GRAVITY * reach
        self.a = self.about * spin / self.across
        self.b = precession * (1 - u0**2) + self.a * u0
        self.beta = 2 * self.load / self.across
        self.alpha = (1 - u0**2) * precession**2 + self.beta * u0
        a, b, c, d = self.beta, -self.alpha - self.a**2, 2 * self.a * self.b - self.beta, self.alpha - self.b**2
        self.u1, self.u2, self.u3 = sorted(x.real for x in polyroots([a, b, c, d], maxsteps=200, extraprec=200))
        self.m = (self.u2 - self.u1) / (self.u3 - self.u1)
        self.w = sqrt(self.beta * (self.u3 - self.u1)) / 2
        self.phase = mpf(0) if abs(u0 - self.u1) < abs(u0 - self.u2) else ellipk(self.m)
        self.precessed, self.spun, self.until = mpf(0), mpf(0), mpf(0)
        self.start = (u0, precession)

    def height(self, time):
        return self.u1 + (self.u2 - self.u1) * ellipfun("sn")(self.w * time + self.phase, m=self.m) ** 2

    def precession(self, time):
        u = self.height(time)
        return (self.b - self.a * u) / (1 - u**2)

    def at(self, time):
        """The centre of mass, and the first axis across; times must rise."""
        if time > self.until:
            self.precessed += quad(self.precession, [self.until, time])
            self.spun += quad(lambda t: self.spin - self.height(t) * self.precession(t), [self.until, time])
            self.until = time
        u, (c, s) = self.height(time), (cos(self.precessed), sin(self.precessed))
        lean = sqrt(1 - u**2)
        axis = matrix([lean * c, lean * s, u])
        # Across the axis, downwards and to its left, from where the top is turned by its spin.
        down, left = matrix([u * c, u * s, -lean]), matrix([-s, c, 0])
        return axis * self.reach, down * cos(self.spun) + left * sin(self.spun)

    def by_taylor(self):
        """With L = A e x e' + C n e and L' = reach e x weight: A e'' = ((L' - C n e') x e) - A |e'|^2 e."""
        u0, precession = self.start
        lean = sqrt(1 - u0**2)

        def rates(_, y):
            e, v = matrix(y[:3]), matrix(y[3:])
            moment = cross(e, matrix([0, 0, -self.load])) - v * (self.about * self.spin)
            turn = cross(moment, e) / self.across
            return [*v, *(turn - e * sum(x * x for x in v))]

        return odefun(rates, 0, [lean, mpf(0), u0, mpf(0), lean * precession, mpf(0)], tol=mpf(10) ** -18)


def write(path, top, stop, step):
    check, worst = top.by_taylor(), mpf(0)
    lines = ["t,x,y,z,ax,ay,az"]
    for k in range(round(stop / step) + 1):
        time = mpf(str(step)) * k
        center, across = top.at(time)
        if time <= 1:
            worst = max([worst, *(abs(a * top.reach - b) for a, b in zip(check(time)[:3], center))])
        lines.append(",".join(nstr(x, 17) for x in [time, *center, *across]))
    assert worst < mpf(10) ** -15, worst
    Path(__file__).parent.joinpath(path).write_text("\n".join(lines) + "\n")
    print(path, "latitudes", nstr(acos(top.u2), 8), nstr(acos(top.u1), 8), "both ways within", nstr(worst, 2))


# Mass 1.2 kg, centre of mass 0.08 m from the foot; moments about it 0.0011 and 0.0018 kg m^2.
MASS, REACH, MOMENTS = mpf("1.2"), mpf("0.08"), (mpf("0.0011") + mpf("1.2") * mpf("0.08") ** 2, mpf("0.0018"))
write("nutating.csv", Top(MASS, REACH, MOMENTS, mpf(90), mpf("0.6"), mpf(14)), 3, 0.05)
write("let_go.csv", Top(MASS, REACH, MOMENTS, mpf(150), mpf("0.9"), mpf(0)), 3, 0.05)
# A rod of 1.5 m and 2 kg that hangs by its end.
LENGTH = mpf("1.5")
write("../thin_rod/reference.csv", Top(mpf(2), LENGTH / 2, (2 * LENGTH**2 / 3, mpf(0)), mpf(0), mpf("2.2"), mpf("1.7")), 5, 0.05)


def steady():
    """Both rates of steady precession, A cos(theta) W^2 - C n W + m g l = 0, for a spin of 120 rad/s at 0.7 rad."""
    (across, about), lean, spin, load = MOMENTS, mpf("0.7"), mpf(120), MASS * GRAVITY * REACH
    root = sqrt((about * spin) ** 2 - 4 * across * cos(lean) * load)
    for rate in ((about * spin - root) / (2 * across * cos(lean)), (about * spin + root) / (2 * across * cos(lean))):
        print("precession", nstr(rate, 17), "rad/s; about the axis besides", nstr(spin - rate * cos(lean), 17), "rad/s")


steady()
