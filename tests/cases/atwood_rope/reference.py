"""Atwood's machine with a rope that has mass and a pulley that has inertia, without slip and without stretch: with the way x of the heavier mass,
(m1 + m2 + rho L + J / R^2) x'' = (m1 - m2) g + 2 rho g x, so x = a (cosh(w t) - 1) / w^2. The rope stretches by 1e-5 of its length, runs 1e-4 of
the radius deep and creeps on the pulley at a small part of the speed of slip."""

import math

G, RADIUS, SPAN, DENSITY, HEAVY, LIGHT, INERTIA = 9.81, 0.3, 1.0, 0.5, 3.0, 2.0, 0.18

if __name__ == "__main__":
    mass = HEAVY + LIGHT + DENSITY * (2.0 * SPAN + math.pi * RADIUS) + INERTIA / RADIUS**2
    start, square = (HEAVY - LIGHT) * G / mass, 2.0 * DENSITY * G / mass
    for time in (0.25, 0.5):
        way = start / square * (math.cosh(math.sqrt(square) * time) - 1.0)
        print(time, "heavy", repr(-SPAN - way), "light", repr(-SPAN + way), "angle", repr(-way / RADIUS))
