"""Mass integrals of a reduced body: how its inertia depends on the amplitudes of its modes."""

from dataclasses import dataclass

import numpy as np

from flexbody._errors import Error

# Components of a symmetric tensor in the order of the container.
TENSOR = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
# Largest relative difference of the mass in different directions.
ISOTROPY = 1e-4


def components(tensor):
    """The six components xx yy zz xy xz yz of symmetric tensors [..., 3, 3]: [..., 6]."""
    return np.stack([tensor[..., row, column] for row, column in TENSOR], axis=-1)


@dataclass
class RigidBodyMass:
    """Mass properties of a model at rest.

    mass: kg.
    centre: centre of mass [3], m.
    inertia: inertia tensor about the centre of mass [3, 3], kg m^2.
    """

    mass: float
    centre: np.ndarray
    inertia: np.ndarray


def rigid_body_mass(model):
    """Mass, centre and inertia of a `ScaledModel`, by its rigid motions.

    Raises `flexbody.Error` if the mass is not the same in all directions, or not positive.
    """
    middle = model.nodes.mean(axis=0)
    motions = model.rigid_motions(middle)
    inertia = motions.T @ (model.mass @ motions)
    mass = np.trace(inertia[:3, :3]) / 3
    if not mass > 0:
        raise Error(f"mass: expected a positive mass, found {mass:.6g} kg")
    if np.abs(inertia[:3, :3] - mass * np.eye(3)).max() > ISOTROPY * mass:
        raise Error(
            "mass: expected the same mass in all directions, found "
            + ", ".join(f"{inertia[axis, axis]:.6g} kg along {'xyz'[axis]}" for axis in range(3))
            + ": are the degrees of freedom in another order?"
        )
    # The upper right block is mass times the cross matrix of the centre, transposed.
    coupling = inertia[:3, 3:] / mass
    offset = (
        np.array([coupling[1, 2] - coupling[2, 1], coupling[2, 0] - coupling[0, 2], coupling[0, 1] - coupling[1, 0]])
        / 2
    )
    centre = middle + offset
    motions = model.rigid_motions(centre)[:, 3:]
    inertia = motions.T @ (model.mass @ motions)
    if not np.linalg.eigvalsh(inertia)[0] > 1e-12 * np.trace(inertia):
        raise Error(f"mass: expected inertia about all axes, found the tensor {inertia.tolist()} kg m^2")
    return RigidBodyMass(float(mass), centre, (inertia + inertia.T) / 2)


@dataclass
class Invariants:
    """Mass integrals of modes.

    first: J1 [n, 6], kg^(1/2) m. second: J2 [n, n, 6]. coupling: N [n, n, 3], N_kl = integral of rho psi_k x psi_l.
    """

    first: np.ndarray
    second: np.ndarray
    coupling: np.ndarray


def invariants(model, centre, modes, displacements=None):
    """Mass integrals of modes and of second-order displacements.

    model: a `ScaledModel`; its mass matrix may be consistent or lumped, with or without rotations of nodes.
    centre: centre of mass [3], m.
    modes: [dofs, n].
    displacements: second-order displacements [dofs, m2, m2], or None.

    Returns `Invariants`. Rotations of nodes take part to first order.
    """
    count = modes.shape[1]
    motions = model.rigid_motions(centre)[:, 3:]
    moved = model.mass @ motions
    rotated = model.rotated(modes)
    heavy = [model.mass @ part for part in rotated]
    first = np.zeros((count, 3, 3))
    second = np.zeros((count, count, 3, 3))
    coupling = np.zeros((count, count, 3))
    for row in range(3):
        coupling[:, :, row] = heavy[row].T @ modes
        for column in range(3):
            first[:, row, column] += moved[:, row] @ rotated[column]
            first[:, column, row] += moved[:, row] @ rotated[column]
            second[:, :, row, column] = heavy[row].T @ rotated[column]
    if displacements is not None:
        pairs = displacements.shape[1]
        turned = model.rotated(displacements.reshape(model.size, -1))
        for row in range(3):
            for column in range(3):
                part = (moved[:, row] @ turned[column]).reshape(pairs, pairs) / 2
                second[:pairs, :pairs, row, column] += part
                second[:pairs, :pairs, column, row] += part
    second = (second + second.transpose(1, 0, 2, 3)) / 2
    second = (second + second.transpose(0, 1, 3, 2)) / 2
    coupling = (coupling - coupling.transpose(1, 0, 2)) / 2
    return Invariants(components(first), components(second), coupling)
