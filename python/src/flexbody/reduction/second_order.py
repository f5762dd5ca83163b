"""Second-order displacements: what follows the square of the amplitudes of modes.

The quadratic part of the internal force gives cubic coefficients T_mkl of the strain energy and displacements u_kl, see
Idelsohn and Cardona (1985, modal derivatives) and Wallrapp (1993, geometric stiffening).
"""

from itertools import combinations_with_replacement

import numpy as np

from flexbody._errors import Error

# Most modes in second-order terms where nothing else is asked for.
MOST_MODES = 40
# Largest displacement over the size of the body at which internal forces are evaluated.
AMPLITUDE = 1e-3
# Largest asymmetry of the cubic coefficients, over the largest sum of their terms without signs.
ASYMMETRY = 1e-4


class QuadraticForces:
    """Quadratic part f2 of the internal force, as a symmetric bilinear map of two displacement fields in SI units.

    Exactly one source is given:

    quadratic_force: function of displacements [dofs] that returns f2 [dofs].
    internal_force: function of displacements that returns the whole internal force; f2 is its even part.
    prestressed_stiffness: function of displacements that returns the tangent stiffness [dofs, dofs] there.

    All take and return the units of the model.
    """

    def __init__(self, model, quadratic_force, internal_force, prestressed_stiffness, amplitude):
        self.model = model
        self.quadratic_force = quadratic_force
        self.internal_force = internal_force
        self.prestressed_stiffness = prestressed_stiffness
        self.amplitude = AMPLITUDE if amplitude is None else float(amplitude)
        given = [source for source in (quadratic_force, internal_force, prestressed_stiffness) if source is not None]
        if len(given) > 1:
            raise Error(
                "quadratic_force, internal_force, prestressed_stiffness: expected at most one of them, found "
                f"{len(given)}"
            )
        self.known = bool(given)
        if not 0 < self.amplitude < 1:
            raise Error(f"amplitude: expected a number between 0 and 1, found {self.amplitude}")

    def pairs(self, modes):
        """Forces f2 of all pairs of modes [dofs, m]: [dofs, m, m], N."""
        if self.prestressed_stiffness is not None:
            return self._from_stiffness(modes)
        count = modes.shape[1]
        forces = np.zeros((self.model.size, count, count))
        for k, other in combinations_with_replacement(range(count), 2):
            if k == other:
                force = self._square(modes[:, k])
            else:
                force = (self._square(modes[:, k] + modes[:, other]) - self._square(modes[:, k] - modes[:, other])) / 4
            forces[:, k, other] = forces[:, other, k] = force
        return forces

    def _scale(self, mode):
        """Amplitude at which the largest translation of a mode is small against the size of the body."""
        size = np.ptp(self.model.nodes, axis=0).max()
        components = self.model.dofs[:, 1]
        largest = np.abs(mode[(components >= 0) & (components < 3)]).max()
        return self.amplitude * size / largest

    def _square(self, mode):
        """The force f2 of a mode, N."""
        scale = self._scale(mode)
        if self.quadratic_force is not None:
            return self._called("quadratic_force", scale * mode) / scale**2
        both = self._called("internal_force", scale * mode) + self._called("internal_force", -scale * mode)
        return both / (2 * scale**2)

    def _called(self, name, displacements):
        """A force of the caller in N, checked."""
        force = np.asarray(getattr(self, name)(displacements * self.model.to_model), float)
        if force.shape != (self.model.size,) or not np.isfinite(force).all():
            raise Error(f"{name}: expected {self.model.size} finite forces, found shape {list(force.shape)}")
        return force * self.model.to_model * self.model.units.energy

    def _from_stiffness(self, modes):
        count = modes.shape[1]
        forces = np.zeros((self.model.size, count, count))
        factors = self.model.to_model
        for k in range(count):
            scale = self._scale(modes[:, k])
            moved = factors * modes[:, k] * scale
            softer, stiffer = (self.prestressed_stiffness(sign * moved) for sign in (-1, 1))
            for matrix in (softer, stiffer):
                if getattr(matrix, "shape", None) != (self.model.size, self.model.size):
                    raise Error(
                        f"prestressed_stiffness: expected a matrix of shape {[self.model.size] * 2}, "
                        f"found {getattr(matrix, 'shape', type(matrix).__name__)}"
                    )
            moved = factors[:, None] * modes
            change = (stiffer @ moved - softer @ moved) / (4 * scale)
            forces[:, k] = factors[:, None] * change * self.model.units.energy
        return (forces + forces.transpose(0, 2, 1)) / 2


def cubic_coefficients(modes, forces):
    """Cubic coefficients T_mkl = psi_m . f2(psi_k, psi_l) of the strain energy.

    modes: [dofs, n]; forces: f2 of pairs of the first m2 modes [dofs, m2, m2].

    Returns an array [n, m2, m2], exactly symmetric where all three indices are below m2. Raises `flexbody.Error` if the
    forces are not those of an energy.
    """
    cubic = np.einsum("dm,dkl->mkl", modes, forces)
    count = forces.shape[1]
    inner = cubic[:count]
    permuted = [inner.transpose(order) for order in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0)]]
    mean = sum(permuted) / 6
    asymmetry = np.abs(inner - mean).max()
    # Sums without cancellation: symmetric bodies have coefficients that are zero but for roundoff.
    natural = np.einsum("dm,dkl->mkl", np.abs(modes[:, :count]), np.abs(forces)).max()
    if asymmetry > ASYMMETRY * natural:
        raise Error(
            "quadratic force: expected the gradient of an energy, whose coefficients do not depend on the order "
            "of modes; "
            f"they differ by {asymmetry:.3g}, the largest is {np.abs(inner).max():.3g}"
        )
    cubic[:count] = mean
    return cubic


def second_order_displacements(elastic, to_coordinates, eigenvalues, modes, forces, cubic):
    """Displacements u_kl of second order: static ones with inertia relief, without what belongs to the modes.

    elastic: an `ElasticModel`; to_coordinates: sparse matrix [coordinates, dofs] of its coordinates; modes:
    [coordinates, n]; forces: [dofs, m2, m2]; cubic: [n, m2, m2].

    Returns displacements [coordinates, m2, m2], orthogonal to the modes in the stiffness.
    """
    count = forces.shape[1]
    first, second = np.triu_indices(count)
    static = -2 * elastic.static(to_coordinates @ forces[:, first, second])
    kept = 2 * modes @ (cubic[:, first, second] / eigenvalues[:, None])
    displacements = np.zeros((modes.shape[0], count, count))
    displacements[:, first, second] = displacements[:, second, first] = static + kept
    return displacements
