"""Interfaces: node sets where joints and loads act on a reduced body."""

import re
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error

# Parts of the container that are no interfaces.
RESERVED = ("surface", "stress")
# Least ratio of the second moments of a node set for which a rotation by least squares is defined.
COLLINEAR = 1e-6


@dataclass(frozen=True)
class Interface:
    """A node set that moves as one point, or as one frame, of the reduced body.

    nodes: indices of the nodes (from 0), or one index.
    weights: weights of the nodes, positive in sum; equal if they are not given. For the mean displacement of a face,
        use the integrals of the shape functions over it.
    kind: `mean` (RBE3: weighted mean displacement, rotation by least squares; adds no stiffness) or `rigid` (RBE2: the
        nodes are rigidly connected, by rotations of first order also in second-order terms).
    held: what joints hold, or loads act on: `position` (three translations), `frame` (translations and rotations) or
        `nothing` (the interface is only read). Static shapes are made for what is held.
    position: reference point [3] in the axes and length unit of the model; the weighted mean of the nodes if it is
        not given.
    """

    nodes: object
    weights: object = None
    kind: str = "mean"
    held: str = "position"
    position: object = None


class InterfaceRows:
    """Linear maps from degrees of freedom to the motion of one interface.

    position: reference point [3], m.
    translation: sparse matrix [3, dofs].
    rotation: sparse matrix [3, dofs], or None where the nodes lie on a line.
    """

    def __init__(self, name, interface, model):
        """interface: an `Interface`; model: a `ScaledModel`."""
        nodes, columns, units = model.nodes, model.columns, model.units
        if not re.fullmatch(r"[A-Za-z0-9_]+", name) or name in RESERVED:
            raise Error(
                f"interfaces: expected a name of letters, digits and underscores, not {' or '.join(RESERVED)}, "
                f"found {name!r}"
            )
        where = f"interfaces[{name!r}]"
        chosen(where, "kind", interface.kind, ("mean", "rigid"))
        chosen(where, "held", interface.held, ("position", "frame", "nothing"))
        self.name = name
        self.kind = interface.kind
        self.held = interface.held
        self.nodes = node_indices(where, interface.nodes, len(nodes))
        weights = node_weights(where, interface.weights, len(self.nodes))
        points = nodes[self.nodes]
        mean = weights @ points
        self.position = mean if interface.position is None else np.asarray(interface.position, float) * units.length
        if self.position.shape != (3,) or not np.isfinite(self.position).all():
            raise Error(f"{where}.position: expected three finite numbers, found {interface.position!r}")
        own = columns[self.nodes]
        if (own[:, :3] < 0).any():
            raise Error(
                f"{where}.nodes: expected nodes with three translations, found node "
                f"{self.nodes[(own[:, :3] < 0).any(1)][0]} without"
            )
        size = model.size
        self.translation = _selected(own, np.multiply.outer(weights, np.eye(3)), size)
        self.rotation = self._rotation(points - mean, weights, own, size)
        arm = self.position - mean
        if np.linalg.norm(arm) > 1e-9 * np.abs(nodes).max():
            if self.rotation is None:
                raise Error(
                    f"{where}.position: expected the mean of the nodes {mean}, because nodes on a line have no "
                    f"rotation; found {self.position}"
                )
            self.translation = (self.translation - sparse.csr_array(cross_matrix(arm)) @ self.rotation).tocsr()
        if self.held == "frame" and self.rotation is None:
            raise Error(
                f"{where}.held: expected nodes that are not on a line for a frame, found {len(self.nodes)} on one"
            )

    @staticmethod
    def _rotation(arms, weights, own, size):
        """Rotation that fits the displacements best: the weighted least squares of an RBE3."""
        if len(arms) == 1 and (own[0, 3:] >= 0).all():
            return _selected(own[:, 3:], np.eye(3)[None], size)
        second = np.einsum("p,pi,pj->ij", weights, arms, arms)
        moments = np.trace(second) * np.eye(3) - second
        least, *_, largest = np.linalg.eigvalsh(moments)
        if largest <= 0 or least < COLLINEAR * largest:
            return None
        crosses = np.array([cross_matrix(arm) for arm in arms])
        return _selected(own, np.linalg.inv(moments) @ (weights[:, None, None] * crosses), size)

    @property
    def rows(self):
        """Rows that joints hold or loads act on: sparse matrix [0, 3 or 6, dofs]."""
        if self.held == "nothing":
            return sparse.csr_array((0, self.translation.shape[1]))
        if self.held == "position":
            return self.translation
        return sparse.vstack([self.translation, self.rotation]).tocsr()


def _selected(own, blocks, size):
    """Sparse matrix [3, size] of blocks [p, 3, 3] at three columns of each node."""
    rows = np.broadcast_to(np.arange(3)[None, :, None], blocks.shape)
    columns = np.broadcast_to(own[:, None, :3], blocks.shape)
    return sparse.coo_array((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(3, size)).tocsr()


def cross_matrix(vector):
    """Matrix [3, 3] of the cross product by a vector from the left."""
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def chosen(where, key, value, known):
    """Checks that a value is one of those known."""
    if value not in known:
        raise Error(f"{where}.{key}: expected {' or '.join(known)}, found {value!r}")


def node_indices(where, nodes, count):
    """Indices of a node set, checked: integers from 0, each once."""
    found = np.atleast_1d(np.asarray(nodes))
    if found.ndim != 1 or not len(found) or found.dtype.kind not in "iu":
        raise Error(f"{where}.nodes: expected indices of nodes, found {nodes!r}")
    if found.min() < 0 or found.max() >= count:
        raise Error(f"{where}.nodes: expected indices from 0 to {count - 1}, found {found.min()} to {found.max()}")
    if len(np.unique(found)) != len(found):
        raise Error(f"{where}.nodes: expected each node once, found one of them twice")
    return found.astype(np.int64)


def node_weights(where, weights, count):
    """Weights of a node set with sum 1, checked."""
    if weights is None:
        return np.full(count, 1 / count)
    found = np.atleast_1d(np.asarray(weights, float))
    if found.shape != (count,):
        raise Error(f"{where}.weights: expected {count} numbers, one a node, found shape {found.shape}")
    if not np.isfinite(found).all() or found.sum() <= 0:
        raise Error(f"{where}.weights: expected finite numbers with a positive sum, found the sum {found.sum()}")
    return found / found.sum()
