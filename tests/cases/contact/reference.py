"""Points that touch, in closed form.

Rebound under the force k d (1 + a d'): with e(v) = v / a - ln(1 + a v) / a^2 the deepest place is at k d^2 / (2 m) = e(v), and the point
leaves at the speed u with e(-u) = e(v) (Hunt and Crossley 1975, linear in d).

A block on level ground, friction mu m g v / S with S = sqrt(v^2 + w^2): v' = -mu g v / S has the integral
S + w ln(v / (w + S)) + mu g t = constant.

On a slope below the angle of friction, r = tan(slope) / mu < 1, it creeps at the speed at which both are equal, v = w r / sqrt(1 - r^2). Above it
gains g (sin(slope) - mu cos(slope)) every second, but for w^2 / (2 v^2) of the friction.
"""

import math

GRAVITY, FRICTION, SLIP = 9.81, 0.4, 1e-3
SPEED, DAMPING = 2.0, 0.35


def energy(speed):
    return speed / DAMPING - math.log1p(DAMPING * speed) / DAMPING**2


def bisected(function, low, high):
    """Where a function that grows is zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return low


def rebound():
    return bisected(lambda u: energy(-u) - energy(SPEED), 0.0, min(SPEED, (1.0 - 1e-15) / DAMPING))


def slowed(speed, slip, time):
    """Speed of a block that slides on level ground."""

    def integral(v):
        whole = math.hypot(v, slip)
        return whole + slip * math.log(v / (slip + whole))

    return bisected(lambda v: integral(v) - integral(speed) + FRICTION * GRAVITY * time, 1e-300, speed)


if __name__ == "__main__":
    print("rebound", repr(rebound()))
    for slip in (SLIP, 0.5):
        print("slowed", slip, [repr(slowed(2.0, slip, time)) for time in (0.2, 0.4)], "stuck after", 2.0 / FRICTION / GRAVITY)
    for slope in (0.2, 0.7):
        share = math.tan(slope) / FRICTION
        way = [math.cos(slope), -math.sin(slope)]
        normal = [math.sin(slope), math.cos(slope)]
        depth = GRAVITY * math.cos(slope) / 1e5
        print("slope", slope, "along", way, "normal", normal, "start", [-depth * part for part in normal])
        if share < 1.0:
            speed = SLIP * share / math.sqrt(1.0 - share**2)
            print("  creeps at", speed)
        else:
            gain = GRAVITY * (math.sin(slope) - FRICTION * math.cos(slope))
            speed = 1.0 + 0.4 * gain
            print("  gains", gain, "to", speed)
        print("  velocity", [repr(speed * part) for part in way])
    # A ball on a plank: the impulse P of friction until it rolls, u = P r^2 / J, with the reduced mass of both.
    ball, plank, inertia, radius, speed = 2.0, 3.0, 0.05, 0.2, 2.0
    reduced = ball * plank / (ball + plank)
    against = speed / (1.0 + inertia / (reduced * radius**2))
    impulse = against * inertia / radius**2
    print("rolls", repr(speed - impulse / ball), "plank", repr(impulse / plank), "spin", repr(-against / radius))
