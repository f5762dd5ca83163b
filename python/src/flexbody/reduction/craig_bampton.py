"""Reduction of a finite element model to modes: the basis of Craig and Bampton in mean axes."""

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.body import InterfaceMotion, ReducedBody, Surface
from flexbody.reduction.elastic import ElasticModel, rigid_sets
from flexbody.reduction.interface import Interface, InterfaceRows
from flexbody.reduction.invariants import components, invariants, rigid_body_mass
from flexbody.reduction.model import scaled_model
from flexbody.reduction.second_order import (
    MOST_MODES,
    QuadraticForces,
    cubic_coefficients,
    second_order_displacements,
)
from flexbody.reduction.units import unit_system


def reduce(
    mass,
    stiffness,
    nodes,
    interfaces,
    *,
    dofs=None,
    units="m-kg-s",
    modes=16,
    quadratic_force=None,
    internal_force=None,
    prestressed_stiffness=None,
    amplitude=None,
    second_order_modes=None,
    triangles=None,
    stress=None,
    source="",
    highest_frequency=None,
):
    """Reduces a finite element model to a body with modes.

    The basis consists of static shapes of forces that balance each other at held interfaces, and of natural modes with
    these interfaces held (Craig and Bampton 1968). Rigid motions are removed (mean axes). The natural modes of the free
    body within the basis are kept.

    mass, stiffness: sparse matrices [dofs, dofs] of the unconstrained body.
    nodes: coordinates [nodes, 3].
    interfaces: an `Interface`, or indices of nodes (from 0), by name. Names are those of the markers of a scene.
    dofs: node and component (0 to 2: translations, 3 to 5: rotations) of each degree of freedom [dofs, 2]. If it is not
        given, each node has three translations, one node after the other.
    units: consistent unit system of all arguments, such as `mm-t-s`: length, mass, time.
    modes: how many natural modes with held interfaces the basis has, beside static shapes.
    quadratic_force: function of displacements [dofs] that returns the quadratic part of the internal force [dofs];
        makes second-order terms.
    internal_force: function of displacements that returns the internal force; an alternative to `quadratic_force`.
    prestressed_stiffness: function of displacements that returns the tangent stiffness there; an alternative to both.
    amplitude: largest displacement over the size of the body at which these functions are evaluated; 1e-3 by default.
    second_order_modes: how many modes take part in second-order terms; all, at most 40, if it is not given. A scene
        that takes fewer modes than the file has (`fixed_interface`, `auto`) combines those of the file and needs all
        pairs. A body that moves takes pairs of modes below 30 times its first frequency, at most ten.
    triangles: surface as indices of nodes [triangles, 3], for pictures.
    stress: sparse or dense matrix [6, dofs] by name: stress xx yy zz xy xz yz at a point by displacements.
    source: where the model comes from.
    highest_frequency: highest frequency that the mesh resolves, Hz.

    Returns a `ReducedBody`. Raises `flexbody.Error` with what was expected and found.
    """
    if isinstance(modes, bool) or not isinstance(modes, (int, np.integer)) or modes < 0:
        raise Error(f"modes: expected a number of modes, found {modes!r}")
    model = scaled_model(mass, stiffness, nodes, dofs, unit_system(units))
    rows = _interface_rows(model, interfaces)
    forces = QuadraticForces(model, quadratic_force, internal_force, prestressed_stiffness, amplitude)
    triangles = _triangles(triangles, len(model.nodes))
    stress = {name: _stress_rows(name, matrix, model) for name, matrix in (stress or {}).items()}

    at_rest = rigid_body_mass(model)
    to_dofs = rigid_sets(model, rows)
    elastic = _elastic_model(model, at_rest, to_dofs)
    held = sparse.vstack([interface.rows for interface in rows]).tocsr() @ to_dofs
    eigenvalues, reduced = elastic.natural(_basis(elastic, held, modes))
    shapes = to_dofs @ reduced

    cubic = second = None
    if forces.known:
        count = _second_order_count(second_order_modes, eigenvalues)
        pairs = forces.pairs(shapes[:, :count])
        cubic = cubic_coefficients(shapes, pairs)
        second = second_order_displacements(elastic, to_dofs.T, eigenvalues, reduced, pairs, cubic)
        second = (to_dofs @ second.reshape(len(reduced), -1)).reshape(-1, count, count)
    integrals = invariants(model, at_rest.centre, shapes, second)
    return ReducedBody(
        mass=at_rest.mass,
        centre=at_rest.centre,
        inertia=components(at_rest.inertia),
        eigenvalues=eigenvalues,
        inertia_1=integrals.first,
        inertia_2=integrals.second,
        coupling=integrals.coupling,
        cubic=cubic,
        interfaces={interface.name: _motion(interface, shapes, second) for interface in rows},
        surface=_surface(model, triangles, shapes),
        stress={name: matrix @ shapes for name, matrix in stress.items()},
        source=source,
        highest_frequency=highest_frequency,
        shapes=shapes,
    )


def _interface_rows(model, interfaces):
    if not hasattr(interfaces, "items") or not interfaces:
        raise Error(f"interfaces: expected interfaces by name, found {interfaces!r}")
    given = {name: one if isinstance(one, Interface) else Interface(one) for name, one in interfaces.items()}
    return [InterfaceRows(name, one, model.nodes, model.columns, model.units) for name, one in given.items()]


def _elastic_model(model, at_rest, to_dofs):
    """The free body in coordinates in which rigid sets are rigid."""
    motions = model.rigid_motions(at_rest.centre)
    inertia = motions.T @ (model.mass @ motions)
    motions = motions @ np.linalg.inv(np.linalg.cholesky(inertia)).T
    return ElasticModel(
        (to_dofs.T @ model.mass @ to_dofs).tocsc(),
        (to_dofs.T @ model.stiffness @ to_dofs).tocsc(),
        to_dofs.T @ motions,
        to_dofs.T @ model.quadratic_fields(at_rest.centre),
    )


def _basis(elastic, held, modes):
    """Static shapes of held rows and natural modes with these rows held, without rigid motions."""
    parts = []
    if held.shape[0]:
        parts.append(elastic.static(held.T @ self_equilibrated(held @ elastic.rigid)))
    if modes:
        parts.append(elastic.held_modes(held, modes))
    shapes = np.hstack(parts) if parts else np.zeros((elastic.mass.shape[0], 0))
    if not shapes.shape[1]:
        raise Error("modes: expected at least one mode, or an interface that is held, found neither")
    return shapes


def self_equilibrated(motions):
    """Combinations of forces at held rows that balance each other.

    motions: motions of the rows [rows, 6] by rigid motions of the body.

    Returns forces [rows, combinations]. Static shapes of the others are replaced by natural modes with held rows,
    since a body that is held without them is in balance by its inertia only.
    """
    vectors, values, _ = np.linalg.svd(motions)
    rank = int((values > 1e-9 * values[0]).sum())
    return vectors[:, rank:]


def _second_order_count(wanted, eigenvalues):
    if wanted is None:
        return min(MOST_MODES, len(eigenvalues))
    if isinstance(wanted, bool) or not isinstance(wanted, (int, np.integer)) or not 0 < wanted <= len(eigenvalues):
        raise Error(f"second_order_modes: expected 1 to {len(eigenvalues)} modes, found {wanted!r}")
    return int(wanted)


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


def _surface(model, triangles, shapes):
    if triangles is None:
        return None
    used, renamed = np.unique(triangles, return_inverse=True)
    columns = model.columns[used, :3]
    if (columns < 0).any():
        raise Error("triangles: expected nodes with three translations, found some without")
    return Surface(model.nodes[used], shapes[columns], renamed.reshape(triangles.shape))


def _stress_rows(name, matrix, model):
    """Matrix [6, dofs] from displacements in SI units to Pa, checked."""
    matrix = sparse.csr_array(matrix, dtype=float)
    if matrix.shape != (6, model.size):
        raise Error(f"stress[{name!r}]: expected a matrix of shape [6, {model.size}], found {list(matrix.shape)}")
    return model.units.stress * (matrix @ sparse.diags_array(model.to_model))
