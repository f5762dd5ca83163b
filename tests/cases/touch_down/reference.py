"""A cable that lies on the ground and rises to a support, in closed form.

The catenary that stretches, with the length L_s off the ground, H the tension on it, w the weight per length, V = w L_s:
x = L - L_s + H / w asinh(V / H) + H L / EA, z = H / w (sqrt(1 + (V / H)^2) - 1) + V^2 / (2 EA w)
(J. M. Jonkman, Dynamics modeling and loads analysis of an offshore floating wind turbine, NREL/TP-500-41958, 2007, Eqs. 2-37, without
friction: H is the same all along the ground).

On ground of stiffness k per length the cable lies w / k deep, and rises to level over the length sqrt(H / k): a string on Winkler's ground,
d = w / k (1 - exp(x / sqrt(H / k))) up to where it is free. The parabola beyond is the one that touches at the depth w / (2 k).
"""

import math

LENGTH, STIFFNESS, WEIGHT = 100.0, 1e7, 10.0 * 9.81
WAY, HEIGHT, GROUND = 88.0, 30.0, 1e5


def bisected(function, low, high):
    """Where a function that grows is zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def free(tension, height):
    """Length off the ground."""

    def rise(length):
        v = WEIGHT * length
        return tension / WEIGHT * (math.hypot(1.0, v / tension) - 1.0) + v * v / (2.0 * STIFFNESS * WEIGHT)

    return bisected(lambda length: rise(length) - height, 0.0, LENGTH)


def touch_down(way, height):
    def span(tension):
        length = free(tension, height)
        lying = LENGTH - length
        return lying + tension / WEIGHT * math.asinh(WEIGHT * length / tension) + tension * LENGTH / STIFFNESS

    tension = bisected(lambda tension: span(tension) - way, 1.0, 1e5)
    return tension, WEIGHT * free(tension, height)


if __name__ == "__main__":
    for ground in (1e4, 1e5):
        tension, lift = touch_down(WAY, HEIGHT + WEIGHT / (2.0 * ground))
        print("ground", ground, "H", repr(tension), "V", repr(lift), "free", lift / WEIGHT, "on the ground", -WEIGHT / ground)
