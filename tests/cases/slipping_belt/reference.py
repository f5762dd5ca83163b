"""A flat belt around two equal pulleys, one of which is driven, the other one held by friction that is larger. The pulleys are pressed apart by a
force F, so that both spans together carry F. The belt slips on the driver all around its half: T2 / T1 = exp(mu pi) (Euler, Eytelwein). The torque
is (T2 - T1) R at the radius where the belt runs, which is the depth T / (R k) below that of the pulley: 1e-3 to 3e-3 of it."""

import math

FORCE, FRICTION, RADIUS, STIFFNESS = 400.0, 0.3, 0.1, 1e7

if __name__ == "__main__":
    ratio = math.exp(FRICTION * math.pi)
    slack, tight = FORCE / (1.0 + ratio), FORCE * ratio / (1.0 + ratio)
    print("slack", repr(slack), "tight", repr(tight))
    print("torque", repr((slack - tight) * RADIUS), "depths", [part / (RADIUS * STIFFNESS) / RADIUS for part in (slack, tight)])
