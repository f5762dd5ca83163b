"""Matrices in the Matrix Market format, which Ansys (`*EXPORT,,MMF`) and most programs of linear algebra write."""

from pathlib import Path

import scipy.io

from flexbody._errors import Error
from flexbody.reduction.model import FiniteElementModel


def read_matrix_market(mass, stiffness, nodes, *, units, dofs=None, labels=None):
    """Reads mass and stiffness from two files of Matrix Market.

    mass, stiffness: paths of the files.
    nodes: coordinates [nodes, 3].
    units: consistent unit system, such as `mm-t-s`.
    dofs, labels: as in `FiniteElementModel`. If `dofs` is not given, each node has three translations, one node after
        the other.

    Returns a `FiniteElementModel`. Raises `flexbody.Error` if a file is of another format.
    """
    matrices = []
    for path in (mass, stiffness):
        try:
            matrices.append(scipy.io.mmread(path))
        except ValueError as wrong:
            raise Error(f"{path}: expected a file of Matrix Market, found {wrong}") from None
    return FiniteElementModel(*matrices, nodes, dofs, labels, units, f"Matrix Market: {Path(stiffness).name}")
