"""Bodies from modes that another program found: no stiffness matrix is needed."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.body import ReducedBody
from flexbody.reduction.elastic import with_signs
from flexbody.reduction.invariants import components, invariants, rigid_body_mass
from flexbody.reduction.model import node_numbers, scaled_model
from flexbody.reduction.outputs import BodyOutputs
from flexbody.reduction.units import unit_system

# Share of the mass of a mode that its rigid motion has: above the second it is rigid, between both it is a mode of a
# body that is held.
RIGID_SHARES = (1e-6, 1 - 1e-6)
# Largest cosine between modes in the mass. OP2 has seven digits.
ORTHOGONAL = 1e-4


@dataclass
class ModalModel:
    """Natural modes of a free body and its mass.

    mass: sparse matrix [dofs, dofs], consistent or lumped.
    modes: displacements [dofs, modes], of any size; rigid ones may be among them.
    eigenvalues: squares of angular frequencies [modes], in units of `units`.
    nodes, dofs, labels, units, source: as in `FiniteElementModel`.
    """

    mass: object
    modes: object
    eigenvalues: object
    nodes: object
    dofs: object = None
    labels: object = None
    units: str = "m-kg-s"
    source: str = ""

    def indices(self, labels):
        """Finds nodes by their numbers in the program that the model comes from: as `FiniteElementModel.indices`."""
        return node_numbers(self.labels, labels)

    def reduce(self, interfaces, *, modes=None, triangles=None, stress=None, nodal_stress=None, highest_frequency=None):
        """Makes a reduced body of the modes.

        interfaces: an `Interface` of the kind `mean`, or indices of nodes (from 0), by name. The basis has no static
            shapes of what is held or loaded there: many modes take their place.
        modes: how many modes are taken, beside rigid ones, in order of frequency; all if it is not given.
        triangles, stress, nodal_stress, highest_frequency: as in `flexbody.reduce`.

        Returns a `ReducedBody` without second-order terms. Raises `flexbody.Error` if the modes are not orthogonal in
        the mass, or not those of a free body.
        """
        empty = sparse.csc_array(np.shape(self.mass))
        model = scaled_model(self.mass, empty, self.nodes, self.dofs, unit_system(self.units))
        outputs = BodyOutputs(model, interfaces, triangles, stress, nodal_stress)
        for interface in outputs.interfaces:
            if interface.kind != "mean":
                raise Error(
                    f"interfaces[{interface.name!r}].kind: expected mean, because modes are given; found "
                    f"{interface.kind!r}"
                )
        at_rest = rigid_body_mass(model)
        eigenvalues, shapes = self._orthonormal(model, at_rest.centre)
        if modes is not None:
            if isinstance(modes, bool) or not isinstance(modes, (int, np.integer)) or not 0 < modes <= len(eigenvalues):
                raise Error(f"modes: expected 1 to {len(eigenvalues)} modes, found {modes!r}")
            eigenvalues, shapes = eigenvalues[:modes], shapes[:, :modes]
        integrals = invariants(model, at_rest.centre, shapes)
        return ReducedBody(
            mass=at_rest.mass,
            centre=at_rest.centre,
            inertia=components(at_rest.inertia),
            eigenvalues=eigenvalues,
            inertia_1=integrals.first,
            inertia_2=integrals.second,
            coupling=integrals.coupling,
            source=self.source,
            highest_frequency=highest_frequency,
            shapes=shapes,
            **outputs.of(shapes),
        )

    def _orthonormal(self, model, centre):
        """Eigenvalues [n] in (rad/s)^2 and modes [dofs, n] in SI units, orthonormal in the mass, without rigid ones."""
        modes = np.asarray(self.modes, float)
        values = np.asarray(self.eigenvalues, float) / model.units.time**2
        if modes.ndim != 2 or modes.shape[0] != model.size or values.shape != modes.shape[1:]:
            raise Error(
                f"modes: expected displacements of shape [{model.size}, modes] and as many eigenvalues, found shapes "
                f"{list(modes.shape)} and {list(values.shape)}"
            )
        if not (np.isfinite(modes).all() and np.isfinite(values).all()):
            raise Error("modes: expected finite numbers, found others")
        shapes = modes / model.to_model[:, None]
        masses = np.einsum("dk,dk->k", shapes, model.mass @ shapes)
        if not (masses > 0).all():
            raise Error(f"modes: expected modes that move mass, found mode {int(np.argmin(masses > 0)) + 1} without")
        shapes = shapes / np.sqrt(masses)
        rigid = model.rigid_motions(centre)
        inertia = rigid.T @ (model.mass @ rigid)
        moved = rigid.T @ (model.mass @ shapes)
        parts = np.linalg.solve(inertia, moved)
        shares = np.einsum("rk,rk->k", parts, moved)
        between = (shares > RIGID_SHARES[0]) & (shares < RIGID_SHARES[1])
        if between.any():
            first = int(np.argmax(between))
            raise Error(
                f"modes: expected modes of a free body, found that mode {first + 1} moves the centre of mass or "
                f"rotates the body ({shares[first]:.3g} of its mass norm): was the body held, or has it another mass?"
            )
        elastic = shares < RIGID_SHARES[0]
        if not elastic.any():
            raise Error("modes: expected at least one mode that deforms the body, found rigid ones only")
        values, shapes = values[elastic], (shapes - rigid @ parts)[:, elastic]
        if not (values > 0).all():
            raise Error(f"eigenvalues: expected positive ones of modes that deform the body, found {values.min():.3g}")
        return _natural(model, values, shapes, np.flatnonzero(elastic) + 1)


def _natural(model, values, shapes, numbers):
    """Natural modes in the span of modes that are nearly orthonormal in the mass."""
    products = shapes.T @ (model.mass @ shapes)
    cosines = np.abs(products - np.eye(len(products)))
    if cosines.max() > ORTHOGONAL:
        first, second = sorted(np.unravel_index(np.argmax(cosines), cosines.shape))
        raise Error(
            f"modes: expected modes that are orthogonal in the mass, found {cosines.max():.3g} between the modes "
            f"{numbers[first]} and {numbers[second]}: is the mass that of another model?"
        )
    values, vectors = scipy.linalg.eigh(np.diag(values), products)
    return values, with_signs(shapes @ vectors)
