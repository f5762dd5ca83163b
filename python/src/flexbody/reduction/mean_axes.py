"""Bodies whose integrals and modes are known in a frame of another program, moved to mean axes.

The frame of the other program may follow an interface, or any other part of the body. Amplitudes stay what they are,
and the mean axes move in that frame with them, to second order. Sources: Schwertassek and Wallrapp, Dynamik flexibler
Mehrkoerpersysteme (1999), chapter 6; Shabana, Dynamics of Multibody Systems.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from flexbody._errors import Error
from flexbody.reduction.body import InterfaceMotion, ReducedBody
from flexbody.reduction.interface import cross_matrix
from flexbody.reduction.invariants import components
from flexbody.reduction.second_order import MOST_MODES

# Least eigenvalue of the mass of modes without rigid motions, over the largest of the mass with them.
LEAST_MASS = 1e-9
IDENTITY = np.eye(3)


@dataclass
class FrameIntegrals:
    """Mass integrals of a body in a frame of its own, in SI units, with modes phi and second-order displacements u.

    mass: kg.
    moment: integral of the position r [3].
    moments: integral of r r^T [3, 3].
    translation: integrals of phi_k [n, 3].
    first: integrals of phi_k r^T [n, 3, 3].
    modal_mass: integrals of phi_k . phi_l [n, n].
    products: symmetric part of the integrals of phi_k phi_l^T + u_kl r^T [n, n, 3, 3].
    coupling: integrals of phi_k x phi_l [n, n, 3].
    second_translation: integrals of u_kl [n, n, 3].
    second_rotation: integrals of r x u_kl [n, n, 3].
    """

    mass: float
    moment: np.ndarray
    moments: np.ndarray
    translation: np.ndarray
    first: np.ndarray
    modal_mass: np.ndarray
    products: np.ndarray
    coupling: np.ndarray
    second_translation: np.ndarray
    second_rotation: np.ndarray


def body_in_mean_axes(integrals, stiffness, points, *, second_order, source):
    """Moves a body to mean axes at its centre of mass and combines its modes to natural ones.

    integrals: `FrameIntegrals`.
    stiffness: [n, n], strain energy by products of amplitudes, J.
    points: `InterfaceMotion` by name, with modes, rotations and second-order displacements in the frame of `integrals`.
    second_order: whether displacements of second order are known. Then those of the frame are part of them. Otherwise
        displacements are linear in mean axes.
    source: text for the container.

    Returns a `ReducedBody`; all of a second-order displacement is a displacement, none of it energy (`cubic` is zero).
    Raises `flexbody.Error` if mass, inertia, mass of the modes or stiffness is not positive.
    """
    frame = _MeanAxes(integrals)
    eigenvalues, combined = _natural(integrals.modal_mass, frame.modal_mass(), stiffness)
    first, coupling = frame.first, frame.coupling()
    products = frame.products(second_order)
    inertia_1 = 2 * np.trace(first, axis1=1, axis2=2)[:, None, None] * IDENTITY - first - first.transpose(0, 2, 1)
    inertia_2 = np.trace(products, axis1=2, axis2=3)[:, :, None, None] * IDENTITY - products
    pairs = min(MOST_MODES, len(eigenvalues))
    motions = {}
    for name, point in points.items():
        modes = frame.modes_at(point) @ combined
        rotation = None if point.rotation is None else (point.rotation - frame.rotations.T) @ combined
        second = None
        if second_order:
            second = np.einsum("akl,km,ln->amn", frame.second_at(point), combined, combined)[:, :pairs, :pairs]
        motions[name] = InterfaceMotion(point.position, modes, rotation, second)
    return ReducedBody(
        mass=integrals.mass,
        centre=frame.centre,
        inertia=components(frame.inertia),
        eigenvalues=eigenvalues,
        inertia_1=combined.T @ components(inertia_1),
        inertia_2=np.einsum("klc,km,ln->mnc", components(inertia_2), combined, combined),
        coupling=np.einsum("klc,km,ln->mnc", coupling, combined, combined),
        cubic=np.zeros((len(eigenvalues), pairs, pairs)) if second_order else None,
        interfaces=motions,
        source=source,
    )


class _MeanAxes:
    """Mean axes of a body, by its amplitudes.

    centre: centre of mass [3], m. inertia: tensor about it [3, 3].
    translations, rotations: motion of the mean axes in the frame [n, 3].
    first: integrals of psi_k X^T in mean axes [n, 3, 3].
    """

    def __init__(self, integrals):
        given = self._given = integrals
        if not given.mass > 0:
            raise Error(f"mass: expected a positive mass, found {given.mass:.6g} kg")
        self.centre = given.moment / given.mass
        self._moments = given.moments - given.mass * np.outer(self.centre, self.centre)
        self.inertia = np.trace(self._moments) * IDENTITY - self._moments
        if not np.linalg.eigvalsh(self.inertia)[0] > 0:
            raise Error(
                f"inertia: expected a positive tensor about the centre of mass, found {self.inertia.tolist()} kg m^2"
            )
        self.translations = given.translation / given.mass
        # About the centre of mass, with the modes of the frame.
        self._about = given.first - given.translation[:, :, None] * self.centre
        self._turned = _axial(self._about)
        self.rotations = np.linalg.solve(self.inertia, self._turned.T).T
        self._crosses = np.array([cross_matrix(rotation) for rotation in self.rotations]).reshape(-1, 3, 3)
        self.first = self._about - self._crosses @ self._moments

    def modal_mass(self):
        """Mass of the modes without rigid motions [n, n]."""
        given = self._given
        return given.modal_mass - given.translation @ self.translations.T - self._turned @ self.rotations.T

    def coupling(self):
        """Integrals of psi_k x psi_l [n, n, 3]."""
        given = self._given
        shifted = given.coupling - np.cross(self.translations[:, None], given.translation[None])
        shifted = shifted + self._crossed(self._about).transpose(1, 0, 2) - self._crossed(self.first)
        return (shifted - shifted.transpose(1, 0, 2)) / 2

    def _crossed(self, first):
        """Integrals of psi_k x (theta_l x X) [n, n, 3], where the integrals of psi_k X^T are `first`."""
        traces = np.trace(first, axis1=1, axis2=2)
        return traces[:, None, None] * self.rotations - np.einsum("kba,lb->kla", first, self.rotations)

    def products(self, second_order):
        """Symmetric part of the integrals of psi_k psi_l^T + u_kl X^T [n, n, 3, 3] in mean axes."""
        given = self._given
        found = given.products - given.second_translation[..., None] * self.centre
        # Integrals of phi_k (t_l + theta_l x X)^T, and of the product of two such motions.
        mixed = given.translation[:, None, :, None] * self.translations[None, :, None, :]
        mixed = mixed + np.einsum("kab,lcb->klac", self._about, self._crosses)
        both = given.mass * self.translations[:, None, :, None] * self.translations[None, :, None, :]
        both = both + np.einsum("kab,bc,ldc->klad", self._crosses, self._moments, self._crosses)
        found = found - mixed - mixed.transpose(1, 0, 3, 2) + both
        if second_order:
            moved = self._double() @ self._moments / 2 + np.einsum("kab,lbc->klac", self._crosses, self.first)
            moved = moved + np.einsum("lab,kbc->klac", self._crosses, self.first)
            turned = np.array([[cross_matrix(one) for one in row] for row in self.second_rotations()])
            found = found - moved - turned @ self._moments
        found = (found + found.transpose(1, 0, 2, 3)) / 2
        return (found + found.transpose(0, 1, 3, 2)) / 2

    def second_rotations(self):
        """Second-order rotation of the mean axes in the frame [n, n, 3]."""
        given = self._given
        turned = given.second_rotation - np.cross(self.centre, given.second_translation)
        double = np.cross(self.rotations[:, None], (self.rotations @ self._moments)[None])
        turned = turned + (double + double.transpose(1, 0, 2)) / 2
        traces = np.trace(self.first, axis1=1, axis2=2)
        mixed = traces[None, :, None] * self.rotations[:, None] - np.einsum("lab,kb->kla", self.first, self.rotations)
        turned = turned - mixed - mixed.transpose(1, 0, 2)
        return np.linalg.solve(self.inertia, turned.reshape(-1, 3).T).T.reshape(turned.shape)

    def _double(self):
        """Products theta_k x (theta_l x .) + theta_l x (theta_k x .) as matrices [n, n, 3, 3]."""
        products = self._crosses[:, None] @ self._crosses[None]
        return products + products.transpose(1, 0, 2, 3)

    def modes_at(self, point):
        """Modes [3, n] at a point in mean axes."""
        arm = point.position - self.centre
        return point.modes - self.translations.T - np.cross(self.rotations, arm).T

    def second_at(self, point):
        """Second-order displacements [3, n, n] at a point in mean axes."""
        arm = point.position - self.centre
        modes = self.modes_at(point).T
        mixed = np.cross(self.rotations[:, None], modes[None])
        found = -self._given.second_translation / self._given.mass - np.cross(self.second_rotations(), arm)
        found = found - self._double() @ arm / 2 - mixed - mixed.transpose(1, 0, 2)
        found = found.transpose(2, 0, 1)
        return found if point.second is None else found + point.second


def _axial(matrices):
    """Integrals of r x phi_k [n, 3] from those of phi_k r^T [n, 3, 3]."""
    skew = matrices - matrices.transpose(0, 2, 1)
    return np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)


def _natural(with_rigid, modal_mass, stiffness):
    """Eigenvalues [n] in (rad/s)^2 and combinations [n, n] of modes that are natural ones of the free body."""
    modal_mass, stiffness = (modal_mass + modal_mass.T) / 2, (stiffness + stiffness.T) / 2
    least = np.linalg.eigvalsh(modal_mass)[0]
    if not least > LEAST_MASS * np.abs(with_rigid).max():
        raise Error(
            f"modes: expected a positive mass of body and modes together, found the eigenvalue {least:.3g} of the "
            f"modes without rigid motions, beside {np.abs(with_rigid).max():.3g} with them: is a mode rigid, or are "
            f"integrals of modes less exact than their mass, such as sums over few nodes?"
        )
    values, vectors = scipy.linalg.eigh(stiffness, modal_mass)
    if not values[0] > 0:
        raise Error(f"stiffness: expected a positive matrix, found the eigenvalue {values[0]:.3g} (rad/s)^2")
    signs = np.cos(np.arange(len(vectors))) @ vectors
    return values, vectors * np.where(signs < 0, -1.0, 1.0)
