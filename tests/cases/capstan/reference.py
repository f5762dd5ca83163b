"""A rope drawn over a fixed drum: T2 / T1 = exp(mu theta) (Euler 1762, Eytelwein 1808), theta the angle that it is wound by, here between the
directions of its two free ends. Its own mass takes rho A v^2 = 1e-3 N of 100 N, the smooth law of friction w^2 / (2 v^2) = 5e-5 of mu."""

import math

TENSION, FRICTION, HALF_ANGLE = 100.0, 0.3, 1.2

if __name__ == "__main__":
    pull = TENSION * math.exp(FRICTION * 2.0 * HALF_ANGLE)
    print("T2", repr(pull), "components", [repr(pull * part) for part in (math.cos(HALF_ANGLE), -math.sin(HALF_ANGLE))])
