"""Solids of scikit-fem, with the quadratic part of their internal force."""

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.invariants import TENSOR
from flexbody.reduction.model import FiniteElementModel


def nodes_and_dofs(basis):
    """Nodes and degrees of freedom of a scikit-fem basis of vectors in space.

    basis: `skfem.Basis` of an `ElementVector` of a Lagrange element, such as `ElementVector(ElementHex2())`.

    Returns coordinates of the nodes [nodes, 3], and node and component of each degree of freedom [dofs, 2]. Raises
    `flexbody.Error` for other elements.
    """
    dofs = basis.dofs
    size = basis.N
    table = np.full((size, 2), -1, dtype=np.int64)
    points = []
    count = 0
    for numbers in (dofs.nodal_dofs, dofs.edge_dofs, dofs.facet_dofs, dofs.interior_dofs):
        if not numbers.size:
            continue
        if len(numbers) % 3:
            raise Error(
                f"basis: expected three translations a node (ElementVector), found {len(numbers)} degrees of freedom"
            )
        for first in range(0, len(numbers), 3):
            own = numbers[first : first + 3]
            if np.ptp(basis.doflocs[:, own], axis=1).max() > 0:
                raise Error("basis: expected the three translations of a node at one place, found several")
            table[own, 0] = count + np.arange(own.shape[1])
            table[own, 1] = np.arange(3)[:, None]
            points.append(basis.doflocs[:, own[0]].T)
            count += own.shape[1]
    if basis.doflocs.shape[0] != 3 or (table < 0).any():
        raise Error("basis: expected an ElementVector in space, found another element")
    return np.vstack(points), table


class Solid:
    """Solid of St. Venant-Kirchhoff material on a scikit-fem basis, in SI units.

    model: a `FiniteElementModel` with consistent mass.
    quadratic_force: function for `flexbody.reduce`.
    """

    def __init__(self, basis, *, youngs_modulus, poissons_ratio, density, source="scikit-fem"):
        """Assembles a solid.

        basis: `skfem.Basis` of an `ElementVector` of a Lagrange element.
        youngs_modulus: Pa. poissons_ratio: no unit. density: kg/m^3. source: text for the container.
        """
        from skfem import BilinearForm
        from skfem.helpers import dot
        from skfem.models.elasticity import lame_parameters, linear_elasticity

        self.basis = basis
        self.lame = lame_parameters(youngs_modulus, poissons_ratio)
        nodes, dofs = nodes_and_dofs(basis)

        @BilinearForm
        def inertia(u, v, _):
            return density * dot(u, v)

        self.model = FiniteElementModel(
            mass=inertia.assemble(basis),
            stiffness=linear_elasticity(*self.lame).assemble(basis),
            nodes=nodes,
            dofs=dofs,
            source=source,
        )

    def quadratic_force(self, displacements):
        """Quadratic part of the internal force [dofs], N, of displacements [dofs], m.

        With the gradient H: the stress of the linear strain times H, and the stress of the strain H^T H / 2.
        """
        from skfem import LinearForm
        from skfem.helpers import ddot, grad

        gradient = grad(self.basis.interpolate(displacements))
        linear = self._stress((gradient + gradient.swapaxes(0, 1)) / 2)
        square = self._stress(np.einsum("ki...,kj...->ij...", gradient, gradient) / 2)
        piola = np.einsum("ik...,kj...->ij...", gradient, linear) + square

        @LinearForm
        def force(v, w):
            return ddot(w["piola"], grad(v))

        return force.assemble(self.basis, piola=piola)

    def nodal_stress(self):
        """Stress at the nodes by displacements, for `flexbody.reduce`: the mean of what the elements at a node have there.

        Returns a sparse matrix [6 nodes, dofs], Pa/m.
        """
        from skfem import Basis

        table = self.model.dofs
        # Degrees of freedom of the elements come in threes, those of one node.
        own = self.basis.element_dofs
        places = self.basis.elem.doflocs[::3].T
        at_nodes = Basis(self.basis.mesh, self.basis.elem, quadrature=(places, np.ones(places.shape[1])))
        node = table[own[::3], 0]
        elements = np.bincount(node.ravel(), minlength=len(self.model.nodes))
        rows, columns, values = [], [], []
        for dof, column in enumerate(own):
            gradient = at_nodes.basis[dof][0].grad
            stress = self._stress((gradient + gradient.swapaxes(0, 1)) / 2)
            for part, (first, second) in enumerate(TENSOR):
                value = np.broadcast_to(stress[first, second], (own.shape[1], len(node)))
                rows.append((6 * node.T + part).ravel())
                columns.append(np.repeat(column, len(node)))
                values.append((value / elements[node.T]).ravel())
        data = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        return sparse.coo_array(data, shape=(6 * len(self.model.nodes), self.basis.N)).tocsr()

    def _stress(self, strain):
        first, shear = self.lame
        trace = np.einsum("ii...->...", strain)
        return first * np.einsum("ij,...->ij...", np.eye(3), trace) + 2 * shear * strain
