"""Matrices of Abaqus: text files .mtx of `*MATRIX OUTPUT`."""

from pathlib import Path

import numpy as np

from flexbody._errors import Error
from flexbody.reduction.model import FiniteElementModel
from flexbody.reduction.readers.input_deck import read_nodes
from flexbody.reduction.readers.triplets import dof_table, placed_nodes, read_columns, symmetric_matrix

# Abaqus writes this on the diagonal where a degree of freedom is supported.
SUPPORTED = 1e35


def read_abaqus(mass, stiffness, nodes, *, units, dofs=None):
    """Reads the mass and the stiffness that Abaqus wrote with `*MATRIX GENERATE` and `*MATRIX OUTPUT`.

    mass, stiffness: paths of the files `<job>_MASS1.mtx` and `<job>_STIF1.mtx`, in one of two forms. FORMAT=MATRIX
        INPUT, the default, has node, direction, node, direction and value in each line. FORMAT=COORDINATE has row,
        column and value.
    nodes: path of the input file with the nodes, or coordinates [3] by number of the node.
    units: consistent unit system of the model, such as `mm-t-s`.
    dofs: number of the node and of the direction (1 to 6) of each row [dofs, 2], for FORMAT=COORDINATE. If it is not
        given, every node has three translations, in order of their numbers.

    Returns a `FiniteElementModel` whose labels are numbers of nodes. Raises `flexbody.Error` if the model is supported,
    or the files do not fit each other. The formats follow the Abaqus Keywords Reference Guide, *MATRIX INPUT and
    *MATRIX OUTPUT; no file of Abaqus itself was at hand.
    """
    where = nodes if isinstance(nodes, (str, Path)) else "nodes"
    nodes = read_nodes(Path(nodes)) if isinstance(nodes, (str, Path)) else nodes
    tables = [_table(Path(path)) for path in (mass, stiffness)]
    widths = [table.shape[1] for table in tables]
    if widths[0] != widths[1]:
        raise Error(f"{mass}, {stiffness}: expected one format, found {widths[0]} and {widths[1]} numbers a line")
    if widths[0] == 5:
        labels, dofs, matrices = _by_nodes(tables)
    else:
        labels, dofs, matrices = _by_rows(tables, nodes, dofs)
    for path, matrix in zip((mass, stiffness), matrices, strict=True):
        if np.abs(matrix.diagonal()).max() > SUPPORTED:
            raise Error(f"{path}: expected a body without supports, found supported degrees of freedom (1e36)")
    return FiniteElementModel(
        mass=matrices[0],
        stiffness=matrices[1],
        nodes=placed_nodes(where, labels, nodes),
        dofs=dofs,
        labels=labels,
        units=units,
        source=f"Abaqus: {Path(stiffness).name}",
    )


def _table(path):
    """Numbers of a file [lines, 3 or 5], separated by commas or spaces."""
    lines = [line.strip() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line and not line.startswith(("*", "%"))]
    separator = "," if lines and "," in lines[0] else None
    width = len(lines[0].split(separator)) if lines else 0
    if width not in (3, 5):
        raise Error(
            f"{path}: expected lines of node, direction, node, direction, value (FORMAT=MATRIX INPUT) or of "
            f"row, column, "
            f"value (FORMAT=COORDINATE), found {lines[0] if lines else 'nothing'!r}"
        )
    return read_columns(path, width, separator)


def _by_nodes(tables):
    """Labels, table of degrees of freedom and matrices of FORMAT=MATRIX INPUT."""
    ends = [table[:, first : first + 2] for table in tables for first in (0, 2)]
    pairs, places = np.unique(np.vstack(ends).astype(np.int64), axis=0, return_inverse=True)
    if pairs[:, 0].min() < 1:
        raise Error(
            f"matrices: expected numbers of nodes from 1, found the internal node {pairs[:, 0].min()} of Abaqus"
        )
    places = places.ravel()
    lengths = np.cumsum([len(end) for end in ends])[:-1]
    parts = np.split(places, lengths)
    matrices = [
        symmetric_matrix(rows, columns, table[:, 4], len(pairs))
        for rows, columns, table in zip(parts[::2], parts[1::2], tables, strict=True)
    ]
    return *dof_table(pairs), matrices


def _by_rows(tables, nodes, dofs):
    """Labels, table of degrees of freedom and matrices of FORMAT=COORDINATE."""
    if dofs is None:
        dofs = [(label, direction) for label in sorted(nodes) for direction in (1, 2, 3)]
    size = len(dofs)
    matrices = []
    for table in tables:
        places = table[:, :2].astype(np.int64) - 1
        if places.min() < 0 or places.max() >= size:
            raise Error(
                f"matrices: expected rows and columns from 1 to {size} ({len(nodes)} nodes), found "
                f"{places.min() + 1} to "
                f"{places.max() + 1}: give `dofs`"
            )
        matrices.append(symmetric_matrix(places[:, 0], places[:, 1], table[:, 2], size))
    return *dof_table(dofs), matrices
