"""What is read of a reduced body: its interfaces, its surface and its stress."""

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.body import InterfaceMotion, Surface
from flexbody.reduction.interface import Interface, InterfaceRows


class BodyOutputs:
    """Interfaces, surface and stress of a model, checked.

    interfaces: `InterfaceRows`, in the order in which they were given.
    """

    def __init__(self, model, interfaces, triangles=None, stress=None, nodal_stress=None):
        """model: a `ScaledModel`; interfaces, triangles, stress, nodal_stress: as in `flexbody.reduce`.

        Raises `flexbody.Error` with what was expected and found.
        """
        if not hasattr(interfaces, "items") or not interfaces:
            raise Error(f"interfaces: expected interfaces by name, found {interfaces!r}")
        given = {name: one if isinstance(one, Interface) else Interface(one) for name, one in interfaces.items()}
        self._model = model
        self.interfaces = [InterfaceRows(name, one, model) for name, one in given.items()]
        self._triangles = _triangles(triangles, len(model.nodes))
        self._stress = {
            name: _stress_rows(f"stress[{name!r}]", matrix, model, 1) for name, matrix in (stress or {}).items()
        }
        self._nodal_stress = None
        if nodal_stress is not None:
            if triangles is None:
                raise Error("nodal_stress: expected triangles beside it, whose corners have the stress, found none")
            self._nodal_stress = _stress_rows("nodal_stress", nodal_stress, model, len(model.nodes))

    def of(self, shapes, second=None):
        """Fields `interfaces`, `surface` and `stress` of a `ReducedBody`.

        shapes: modes [dofs, n]; second: second-order displacements [dofs, m2, m2], or None.
        """
        return {
            "interfaces": {interface.name: _motion(interface, shapes, second) for interface in self.interfaces},
            "surface": _surface(self._model, self._triangles, shapes, self._nodal_stress),
            "stress": {name: matrix @ shapes for name, matrix in self._stress.items()},
        }


def _motion(interface, shapes, second):
    at = None if second is None else np.tensordot(interface.translation.toarray(), second, 1)
    rotation = None if interface.rotation is None else interface.rotation @ shapes
    return InterfaceMotion(interface.position, interface.translation @ shapes, rotation, at)


def _triangles(triangles, count):
    if triangles is None:
        return None
    found = np.asarray(triangles)
    if found.ndim != 2 or found.shape[1] != 3 or found.dtype.kind not in "iu" or not len(found):
        raise Error(f"triangles: expected indices of nodes of shape [triangles, 3], found shape {list(found.shape)}")
    if found.min() < 0 or found.max() >= count:
        raise Error(f"triangles: expected indices of nodes from 0 to {count - 1}, found {found.min()} to {found.max()}")
    return found


def _surface(model, triangles, shapes, stress):
    if triangles is None:
        return None
    used, renamed = np.unique(triangles, return_inverse=True)
    columns = model.columns[used, :3]
    if (columns < 0).any():
        raise Error("triangles: expected nodes with three translations, found some without")
    if stress is not None:
        rows = (6 * used[:, None] + np.arange(6)).ravel()
        stress = (stress[rows] @ shapes).reshape(len(used), 6, -1)
    return Surface(model.nodes[used], shapes[columns], renamed.reshape(triangles.shape), stress)


def _stress_rows(name, matrix, model, points):
    """Matrix [6 points, dofs] from displacements in SI units to Pa, checked."""
    matrix = sparse.csr_array(matrix, dtype=float)
    if matrix.shape != (6 * points, model.size):
        raise Error(f"{name}: expected a matrix of shape [{6 * points}, {model.size}], found {list(matrix.shape)}")
    if not np.isfinite(matrix.data).all():
        raise Error(f"{name}: expected finite numbers, found others")
    return model.units.stress * (matrix @ sparse.diags_array(model.to_model))
