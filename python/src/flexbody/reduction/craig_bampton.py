"""Reduction of a finite element model to modes: the basis of Craig and Bampton in mean axes."""

import warnings

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody._program import FlexbodyWarning
from flexbody.reduction.body import ReducedBody
from flexbody.reduction.elastic import ElasticModel, rigid_sets
from flexbody.reduction.invariants import components, invariants, rigid_body_mass
from flexbody.reduction.model import scaled_model
from flexbody.reduction.outputs import BodyOutputs
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
    nodal_stress=None,
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
        given, each node has three translations, one node after the other. A row (-1, -1) is the amplitude of an inner
        mode of a superelement.
    units: consistent unit system of all arguments, such as `mm-t-s`: length, mass, time.
    modes: how many natural modes with held interfaces the basis has, beside static shapes.
    quadratic_force: function of displacements [dofs] that returns the quadratic part of the internal force [dofs];
        makes second-order terms.
    internal_force: function of displacements that returns the internal force; an alternative to `quadratic_force`.
    prestressed_stiffness: function of displacements that returns the tangent stiffness there; an alternative to both.
    amplitude: largest displacement over the size of the body at which these functions are evaluated; 1e-3 by default.
    second_order_modes: how many modes take part in second-order terms; all, at most 40, if it is not given. A scene
        that takes fewer modes than the file has (`fixed_interface`, `auto`) combines those of the file and needs all
        pairs: it tells of a file that lacks them. A body that moves takes pairs of modes below 30 times its first frequency, at most ten.
    triangles: surface as indices of nodes [triangles, 3], for pictures.
    stress: sparse or dense matrix [6, dofs] by name: stress xx yy zz xy xz yz at a point by displacements.
    nodal_stress: sparse matrix [6 nodes, dofs], six rows a node, one node after the other: stress at the nodes by
        displacements. That of the surface goes into the file and colours it in pages.
    source: where the model comes from.
    highest_frequency: highest frequency that the mesh resolves, Hz.

    Returns a `ReducedBody`. Warns (`flexbody.FlexbodyWarning`) of inner modes. Raises `flexbody.Error` with what was
    expected and found.
    """
    if isinstance(modes, bool) or not isinstance(modes, (int, np.integer)) or modes < 0:
        raise Error(f"modes: expected a number of modes, found {modes!r}")
    model = scaled_model(mass, stiffness, nodes, dofs, unit_system(units))
    outputs = BodyOutputs(model, interfaces, triangles, stress, nodal_stress)
    rows = outputs.interfaces
    forces = QuadraticForces(model, quadratic_force, internal_force, prestressed_stiffness, amplitude)
    if model.inner_modes:
        _warn_of_inner_modes(model)

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
        source=source,
        highest_frequency=highest_frequency,
        shapes=shapes,
        **outputs.of(shapes, second),
    )


def _warn_of_inner_modes(model):
    warnings.warn(
        f"dofs: {model.inner_modes} of {model.size} are amplitudes of inner modes, whose nodes are not in the model: "
        f"forces of inertia on them are missing when the body rotates; reduce the matrices of all nodes, or use modes "
        f"(`ModalModel`), where that counts",
        FlexbodyWarning,
        stacklevel=3,
    )


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
