"""Finite element models: mass and stiffness matrices with what their degrees of freedom mean."""

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.interface import cross_matrix

# Largest relative asymmetry of a matrix, and of mass in different directions.
SYMMETRY = 1e-6


@dataclass
class FiniteElementModel:
    """Matrices of an unconstrained linear finite element model.

    mass, stiffness: sparse matrices [dofs, dofs], symmetric.
    nodes: coordinates [nodes, 3].
    dofs: node (from 0) and component of each degree of freedom [dofs, 2]: components 0, 1, 2 are translations along x,
        y, z and 3, 4, 5 rotations about them. If it is not given, each node has three translations, one node after the
        other. A row (-1, -1) is the amplitude of an inner mode of a superelement, zero in rigid motions.
    labels: number of each node in the program that the model comes from [nodes], if there are such numbers.
    units: consistent unit system, such as `mm-t-s`.
    source: where the model comes from, as text for the container.
    triangles: surface as indices of nodes [triangles, 3], for pictures, or None.
    interfaces: node sets of the model by name, each an `Interface`; they are there to choose from.
    """

    mass: object
    stiffness: object
    nodes: object
    dofs: object = None
    labels: object = None
    units: str = "m-kg-s"
    source: str = ""
    triangles: object = None
    interfaces: dict = field(default_factory=dict)

    def indices(self, labels):
        """Finds nodes by their numbers in the program that the model comes from.

        labels: numbers of nodes.

        Returns indices from 0. Raises `flexbody.Error` if a number is unknown.
        """
        return node_numbers(self.labels, labels)

    def reduce(self, interfaces, **options):
        """Reduces the model: calls `flexbody.reduce` with its matrices, nodes, dofs, units, source and triangles."""
        from flexbody.reduction.craig_bampton import reduce

        given = {"dofs": self.dofs, "units": self.units, "source": self.source, "triangles": self.triangles}
        return reduce(self.mass, self.stiffness, self.nodes, interfaces, **{**given, **options})


def node_numbers(known, labels):
    """Indices of nodes by their numbers: `known` are those of all nodes, or None.

    Raises `flexbody.Error` if a number is unknown.
    """
    if known is None:
        raise Error("labels: expected a model with numbers of nodes, found one without")
    places = {int(label): index for index, label in enumerate(known)}
    wanted = [int(label) for label in np.atleast_1d(labels)]
    missing = [label for label in wanted if label not in places]
    if missing:
        raise Error(f"labels: expected numbers of nodes of the model, found {missing[:5]}")
    return np.array([places[label] for label in wanted])


@dataclass
class ScaledModel:
    """Finite element model in SI units, checked.

    mass, stiffness: sparse matrices [dofs, dofs].
    nodes: coordinates [nodes, 3], m.
    dofs: node and component of each degree of freedom [dofs, 2].
    columns: degree of freedom of each component of each node [nodes, 6], -1 where there is none.
    to_model: factor of each degree of freedom from SI to the units of the model [dofs].
    units: unit system of the model.
    """

    mass: object
    stiffness: object
    nodes: np.ndarray
    dofs: np.ndarray
    columns: np.ndarray = field(repr=False)
    to_model: np.ndarray = field(repr=False)
    units: object = None

    @property
    def size(self):
        """Number of degrees of freedom."""
        return len(self.dofs)

    @property
    def inner_modes(self):
        """Number of degrees of freedom that are amplitudes of inner modes of a superelement."""
        return int((self.dofs[:, 0] < 0).sum())

    def rigid_motions(self, centre):
        """Displacements [dofs, 6] of unit translations along the axes and unit rotations about them through a point."""
        motions = np.zeros((self.size, 6))
        arms = self.nodes - centre
        for axis in range(3):
            # The last column is that of inner modes.
            moved = np.zeros((len(self.nodes), 7))
            moved[:, axis] = 1
            motions[:, axis] = moved[self.dofs[:, 0], self.dofs[:, 1]]
            moved = np.zeros((len(self.nodes), 7))
            moved[:, :3] = arms @ cross_matrix(np.eye(3)[axis]).T
            moved[:, 3 + axis] = 1
            motions[:, 3 + axis] = moved[self.dofs[:, 0], self.dofs[:, 1]]
        return motions

    def quadratic_fields(self, centre):
        """Displacements [dofs, 18]: products of two coordinates along each axis, scaled to the size of the body.

        Rotations of nodes are half the curl. Bending and torsion of slender bodies are nearly among them.
        """
        size = np.abs(self.nodes - centre).max()
        arms = (self.nodes - centre) / size
        fields = []
        for first in range(3):
            for second in range(first, 3):
                gradient = np.zeros_like(arms)
                gradient[:, first] += arms[:, second]
                gradient[:, second] += arms[:, first]
                for axis in np.eye(3):
                    moved = np.outer(arms[:, first] * arms[:, second], axis)
                    moved = np.hstack([moved, np.cross(gradient, axis) / (2 * size), np.zeros((len(moved), 1))])
                    fields.append(moved[self.dofs[:, 0], self.dofs[:, 1]])
        return np.column_stack(fields)

    def rotated(self, displacements):
        """Cross products [3, dofs, columns] of the axes with translations and with rotations of the nodes."""
        result = np.zeros((3, *displacements.shape))
        for axis in range(3):
            matrix = cross_matrix(np.eye(3)[axis])
            for row, column in zip(*np.nonzero(matrix), strict=True):
                for shift in (0, 3):
                    to, source = self.columns[:, shift + row], self.columns[:, shift + column]
                    both = (to >= 0) & (source >= 0)
                    result[axis, to[both]] = matrix[row, column] * displacements[source[both]]
        return result


def scaled_model(mass, stiffness, nodes, dofs, units):
    """Checks a model and converts it to SI units.

    mass, stiffness: sparse matrices [dofs, dofs]; nodes: coordinates [nodes, 3]; dofs: as in `FiniteElementModel`;
    units: a `UnitSystem`.

    Returns a `ScaledModel`. Raises `flexbody.Error` if shapes do not fit or numbers are not finite.
    """
    nodes = np.asarray(nodes, float)
    if nodes.ndim != 2 or nodes.shape[1] != 3 or not np.isfinite(nodes).all():
        raise Error(f"nodes: expected finite coordinates of shape [nodes, 3], found shape {list(nodes.shape)}")
    mass, stiffness = (_matrix(name, matrix) for name, matrix in [("mass", mass), ("stiffness", stiffness)])
    size = mass.shape[0]
    if stiffness.shape != mass.shape:
        raise Error(f"stiffness: expected the shape of the mass {list(mass.shape)}, found {list(stiffness.shape)}")
    dofs = _dofs(dofs, size, len(nodes))
    columns = np.full((len(nodes), 6), -1, dtype=np.int64)
    nodal = np.flatnonzero(dofs[:, 0] >= 0)
    columns[dofs[nodal, 0], dofs[nodal, 1]] = nodal
    to_model = np.where(dofs[:, 1] < 3, 1 / units.length, 1.0)
    scale = sparse.diags_array(to_model)
    return ScaledModel(
        mass=((units.mass * units.length**2) * (scale @ mass @ scale)).tocsc(),
        stiffness=(units.energy * (scale @ stiffness @ scale)).tocsc(),
        nodes=nodes * units.length,
        dofs=dofs,
        columns=columns,
        to_model=to_model,
        units=units,
    )


def _matrix(name, matrix):
    """Checks that a matrix is square, finite and symmetric; returns it exactly symmetric."""
    matrix = sparse.csc_array(matrix, dtype=float)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise Error(f"{name}: expected a square matrix, found shape {list(matrix.shape)}")
    if not np.isfinite(matrix.data).all():
        raise Error(f"{name}: expected finite numbers, found others")
    largest = np.abs(matrix.data).max(initial=0)
    asymmetry = np.abs((matrix - matrix.T).data).max(initial=0)
    if asymmetry > SYMMETRY * largest:
        raise Error(
            f"{name}: expected a symmetric matrix, both triangles of it; entries and their mirror images differ "
            f"by {asymmetry:.3g}, "
            f"the largest entry is {largest:.3g}"
        )
    matrix = ((matrix + matrix.T) / 2).tocsc()
    # Assemblers store zeros between directions, which a factorization would keep.
    matrix.eliminate_zeros()
    return matrix


def _dofs(dofs, size, count):
    """Node and component of each degree of freedom, checked."""
    if dofs is None:
        if size != 3 * count:
            raise Error(
                f"dofs: expected three degrees of freedom a node, {3 * count} of {count} nodes; the matrices "
                f"have {size}: "
                "give the node and component of each"
            )
        return np.column_stack([np.repeat(np.arange(count), 3), np.tile(np.arange(3), count)])
    dofs = np.asarray(dofs)
    if dofs.shape != (size, 2) or dofs.dtype.kind not in "iu":
        raise Error(f"dofs: expected integers of shape [{size}, 2] (node, component), found shape {list(dofs.shape)}")
    nodal = dofs[~(dofs == -1).all(axis=1)]
    if not len(nodal):
        raise Error("dofs: expected degrees of freedom of nodes, found none")
    for column, limit, what in [(0, count, "nodes"), (1, 6, "components")]:
        least, largest = nodal[:, column].min(), nodal[:, column].max()
        if least < 0 or largest >= limit:
            raise Error(f"dofs: expected {what} from 0 to {limit - 1}, found {least} to {largest}")
    if len(np.unique(nodal, axis=0)) != len(nodal):
        raise Error("dofs: expected each component of each node once, found one twice")
    return dofs.astype(np.int64)
