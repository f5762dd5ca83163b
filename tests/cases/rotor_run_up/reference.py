"""Writes `reference.csv`: a rotor of Jeffcott that is run up through its critical speed at a constant angular acceleration, by SciPy
(an adaptive method of order 8). Also prints what a rotor at a constant speed does when all else has decayed, in closed form.

    m z'' + c z' + k z = m_d e (w^2 - i a) exp(i p),    z = y + i z of the shaft's middle, p' = w, w' = a

with the mass of the disc m_d, and m = m_d + 13/35 of the shaft's (Rayleigh, by the shape of its deflection under a force in the middle).
"""

import cmath
import csv
import pathlib

from scipy.integrate import solve_ivp

STIFFNESS = 192.0 * 2.0  # E I = 2 N m^2, 1 m between clamps
DISC, SHAFT, OFF = 0.5, 1e-4, 1e-3
MASS = DISC + 13.0 / 35.0 * SHAFT
DAMPING = 2.8
SPEED = 56.0  # rad/s, at the end
TIME = 2.0
POINTS = 41


def turning(time, state):
    place, velocity = complex(*state[:2]), complex(*state[2:])
    faster = SPEED / TIME
    speed, angle = faster * time, 0.5 * faster * time * time
    push = DISC * OFF * (speed * speed - 1j * faster) * cmath.exp(1j * angle)
    acceleration = (push - DAMPING * velocity - STIFFNESS * place) / MASS
    return [velocity.real, velocity.imag, acceleration.real, acceleration.imag]


def steady(speed, time):
    place = DISC * OFF * speed * speed / (STIFFNESS - MASS * speed * speed + 1j * DAMPING * speed)
    return place * cmath.exp(1j * speed * time)


def main():
    times = [TIME * k / (POINTS - 1) for k in range(POINTS)]
    found = solve_ivp(turning, (0.0, TIME), [0.0] * 4, method="DOP853", t_eval=times, rtol=1e-12, atol=1e-15)
    path = pathlib.Path(__file__).with_name("reference.csv")
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["t", "y", "z"])
        rows.writerows([repr(float(x)) for x in row] for row in zip(found.t, found.y[0], found.y[1], strict=True))
    for speed in (14.0, 56.0):
        print(speed, steady(speed, 4.0))


if __name__ == "__main__":
    main()
