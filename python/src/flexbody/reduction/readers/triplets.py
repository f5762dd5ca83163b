"""Sparse matrices from rows, columns and values, as programs write them: one triangle, or both."""

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error


def read_columns(path, count, separator=None):
    """Reads a text table of numbers.

    path: path of the file. count: how many columns it has. separator: what separates them; spaces if it is not given.

    Lines that begin with `*` or `#` are comments. Returns an array [lines, count].
    """
    try:
        table = np.loadtxt(path, delimiter=separator, comments=["*", "#"], ndmin=2)
    except ValueError as wrong:
        raise Error(f"{path}: expected {count} numbers a line, found {wrong}") from None
    if table.shape[1] != count:
        raise Error(f"{path}: expected {count} numbers a line, found {table.shape[1]}")
    return table


def symmetric_matrix(rows, columns, values, size):
    """Symmetric sparse matrix [size, size] of entries of one triangle, or of both.

    rows, columns: indices from 0. values: entries; those of one place are added.
    """
    matrix = sparse.coo_array((values, (rows, columns)), shape=(size, size)).tocsc()
    lower, upper = sparse.tril(matrix, -1), sparse.triu(matrix, 1)
    if not lower.count_nonzero() or not upper.count_nonzero():
        matrix = matrix + (lower + upper).T
    return matrix.tocsc()


def dof_table(pairs):
    """Numbering of degrees of freedom.

    pairs: number of the node and of the direction (1 to 6) of each degree of freedom [dofs, 2], in order.

    Returns numbers of nodes [nodes], ascending, and the table [dofs, 2] of `FiniteElementModel`.
    """
    pairs = np.asarray(pairs)
    labels, nodes = np.unique(pairs[:, 0], return_inverse=True)
    return labels, np.column_stack([nodes.ravel(), pairs[:, 1] - 1])


def placed_nodes(path, labels, nodes):
    """Coordinates [nodes, 3] of nodes by their numbers. Raises `flexbody.Error` if one is missing."""
    missing = [int(label) for label in labels if int(label) not in nodes]
    if missing:
        raise Error(
            f"{path}: expected coordinates of the nodes of the matrices; {len(missing)} are missing, such as "
            f"{missing[:3]}"
        )
    return np.array([nodes[int(label)] for label in labels])
