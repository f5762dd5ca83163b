"""What coupled systems must do: closed forms."""

import numpy as np


def linear(*, rates, constant, initial, outputs, stop):
    """`y = C x` at the end of `x' = A x + b`: the exponential by Taylor's series and squaring."""
    rates, constant = np.array(rates, float), np.array(constant, float)
    size = len(rates)
    whole = np.block([[rates, constant[:, None]], [np.zeros((1, size + 1))]])
    squarings = max(0, int(np.ceil(np.log2(np.abs(whole * stop).sum()))) + 1)
    flow = term = np.eye(size + 1)
    for order in range(1, 20):
        term = term @ whole * (stop / 2**squarings / order)
        flow = flow + term
    # The last state is 1 for ever and carries the constant part.
    end = np.linalg.matrix_power(flow, 2**squarings) @ np.append(initial, 1.0)
    return np.array(outputs, float) @ end[:size]


def cantilever_with_sprung_mass(*, length, bending_stiffness, line_density, stiffness, mass, velocity, stop, modes=12):
    """Deflections of the tip of a resting Euler-Bernoulli cantilever and of a mass with a velocity
    that a spring joins to it, by modes of the whole.

    In a mode `w = phi(x) sin(omega t)`, `phi = C (cosh z - cos z) + S (sinh z - sin z)`, `z = b x`; at the
    tip the moment is zero, the shear force is that of the spring, `EI phi''' = -F`,
    `F = k m omega^2 / (k - m omega^2) phi`, and the mass moves `k / (k - m omega^2)` as far as the tip."""

    def squared(b):
        return bending_stiffness * b**4 / line_density

    def shape(b):
        """Shape with C = 1, zero moment at the tip."""
        z = b * length
        ratio = -(np.cosh(z) + np.cos(z)) / (np.sinh(z) + np.sin(z))
        tip = np.cosh(z) - np.cos(z) + ratio * (np.sinh(z) - np.sin(z))
        shear = bending_stiffness * b**3 * (np.sinh(z) - np.sin(z) + ratio * (np.cosh(z) + np.cos(z)))
        return ratio, tip, shear

    def equation(b):
        """Zero at a mode, without a pole."""
        _, tip, shear = shape(b)
        inertia = mass * squared(b)
        return shear * (stiffness - inertia) + stiffness * inertia * tip

    tip_end, mass_end = 0.0, 0.0
    for b in roots(equation, modes, 0.01 / length):
        ratio, tip, _ = shape(b)
        omega = np.sqrt(squared(b))
        moved = stiffness / (stiffness - mass * omega**2) * tip
        x = np.linspace(0.0, length, 4001)
        w = np.cosh(b * x) - np.cos(b * x) + ratio * (np.sinh(b * x) - np.sin(b * x))
        modal_mass = line_density * np.trapezoid(w**2, x) + mass * moved**2
        amplitude = mass * velocity * moved / (modal_mass * omega) * np.sin(omega * stop)
        tip_end += amplitude * tip
        mass_end += amplitude * moved
    return np.array([tip_end, mass_end])


def roots(function, count, step):
    """The first positive roots, by bisection between changes of sign."""
    found, left = [], step
    while len(found) < count:
        right = left + step
        if function(left) * function(right) < 0:
            low, high = left, right
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if function(low) * function(middle) <= 0 else (middle, high)
            found.append(low)
        left = right
    return found


def cut_pendulum(
    *, length, mass, gravity, stiffness, damping, rotational_stiffness, rotational_damping, stop, steps=3000
):
    """Tip of two rigid rods on a pin, let go from the horizontal, joined by springs and dampers between their
    ends and between their angles: Newton-Euler equations in absolute coordinates, by Runge-Kutta steps of
    order 4."""

    def along(angle):
        return length * np.array([np.cos(angle), np.sin(angle)])

    def across(angle):
        return length * np.array([-np.sin(angle), np.cos(angle)])

    def cross(a, b):
        return a[0] * b[1] - a[1] * b[0]

    def rates(state):
        (upper, upper_rate, lower, lower_rate), centre, speed = state[:4], state[4:6], state[6:]
        gap = along(upper) + 0.5 * along(lower) - centre
        gap_rate = upper_rate * across(upper) + 0.5 * lower_rate * across(lower) - speed
        force = stiffness * gap + damping * gap_rate
        moment = rotational_stiffness * (upper - lower) + rotational_damping * (upper_rate - lower_rate)
        weight = mass * gravity * np.array([0.0, -1.0])
        upper_moment = cross(0.5 * along(upper), weight) - cross(along(upper), force) - moment
        lower_moment = cross(-0.5 * along(lower), force) + moment
        turning = mass * length**2 * np.array([1 / 3, 1 / 12])
        head = [upper_rate, upper_moment / turning[0], lower_rate, lower_moment / turning[1]]
        return np.concatenate([head, speed, (force + weight) / mass])

    state, step = np.array([0.0, 0.0, 0.0, 0.0, 1.5 * length, 0.0, 0.0, 0.0]), stop / steps
    for _ in range(steps):
        a = rates(state)
        b = rates(state + 0.5 * step * a)
        c = rates(state + 0.5 * step * b)
        d = rates(state + step * c)
        state = state + step / 6 * (a + 2 * b + 2 * c + d)
    return state[4:6] + 0.5 * along(state[2])


def after(a, b):
    """The quaternion of the turn `a` after the turn `b`, scalar first."""
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.concatenate([[a[0] * b[0] - a[1:] @ b[1:]], vector])


def turned(q, v):
    """A vector turned by a unit quaternion."""
    return v + 2.0 * np.cross(q[1:], q[0] * v + np.cross(q[1:], v))


def cut_top(
    *,
    length,
    mass,
    moments,
    gravity,
    spin,
    stiffness,
    damping,
    rotational_stiffness,
    rotational_damping,
    stop,
    steps=3000,
):
    """Tip and quaternion of the second of two equal bars, the first on a ball joint, that lie along x and turn as one; a spring and
    a damper join their ends, others their frames, along the rotation vector between these: Newton-Euler
    equations with quaternions, by Runge-Kutta steps of order 4."""
    moments, half = np.array(moments), np.array([0.5 * length, 0.0, 0.0])
    weight = np.array([0.0, 0.0, -mass * gravity])
    # About the ball joint.
    pivot = moments + mass * np.array([0.0, half[0] ** 2, half[0] ** 2])

    def vector(q):
        size = np.linalg.norm(q[1:])
        return 2.0 * np.arctan2(size, q[0]) * q[1:] / size if size > 0.0 else np.zeros(3)

    def turn(q, w, inertia, moment):
        """Rates of a quaternion and of an angular velocity along the axes of its body, by a moment in global axes."""
        back = np.concatenate([q[:1], -q[1:]])
        euler = (turned(back, moment) - np.cross(w, inertia * w)) / inertia
        return 0.5 * after(q, np.concatenate([[0.0], w])), euler

    def rates(state):
        p, u, q, w, centre, speed = np.split(state, [4, 7, 11, 14, 17])
        p, q = p / np.linalg.norm(p), q / np.linalg.norm(q)
        arms, spins = [turned(p, half), turned(q, half)], [turned(p, u), turned(q, w)]
        gap = 2.0 * arms[0] + arms[1] - centre
        gap_rate = 2.0 * np.cross(spins[0], arms[0]) + np.cross(spins[1], arms[1]) - speed
        force = stiffness * gap + damping * gap_rate
        between = after(p, np.concatenate([q[:1], -q[1:]]))
        moment = rotational_stiffness * vector(between) + rotational_damping * (spins[0] - spins[1])
        inner = turn(p, u, pivot, np.cross(arms[0], weight) - np.cross(2.0 * arms[0], force) - moment)
        outer = turn(q, w, moments, np.cross(-arms[1], force) + moment)
        return np.concatenate([*inner, *outer, speed, (force + weight) / mass])

    spin, upright = np.array(spin), np.array([1.0, 0.0, 0.0, 0.0])
    state = np.concatenate([upright, spin, upright, spin, 3.0 * half, np.cross(spin, 3.0 * half)])
    step = stop / steps
    for _ in range(steps):
        a = rates(state)
        b = rates(state + 0.5 * step * a)
        c = rates(state + 0.5 * step * b)
        d = rates(state + step * c)
        state = state + step / 6 * (a + 2 * b + 2 * c + d)
    q = state[7:11] / np.linalg.norm(state[7:11])
    return np.concatenate([state[14:17] + turned(q, half), q])
