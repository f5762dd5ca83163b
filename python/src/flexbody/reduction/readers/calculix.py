"""Matrices of CalculiX: files .sti, .mas and .dof of `*FREQUENCY, SOLVER=MATRIXSTORAGE`."""

from pathlib import Path

import numpy as np

from flexbody._errors import Error
from flexbody.reduction.model import FiniteElementModel
from flexbody.reduction.readers.input_deck import read_nodes
from flexbody.reduction.readers.triplets import dof_table, placed_nodes, read_columns, symmetric_matrix


def read_calculix(job, *, units, nodes=None):
    """Reads a model that CalculiX wrote in a step with `*FREQUENCY, SOLVER=MATRIXSTORAGE`.

    job: path of the input file, with or without `.inp`; `.sti`, `.mas` and `.dof` lie beside it. It has no supports
        (`*BOUNDARY`) and no equations.
    units: consistent unit system of the input file, such as `mm-t-s`.
    nodes: coordinates [3] by number of the node; those of the input file if they are not given. CalculiX makes nodes of
        its own for shells and beams, which it writes to the file `.frd` only.

    Returns a `FiniteElementModel` whose labels are numbers of nodes. Raises `flexbody.Error` if files do not fit.
    """
    job = Path(job)
    if job.suffix != ".inp":
        job = job.with_name(job.name + ".inp")
    files = {extension: job.with_suffix(extension) for extension in (".sti", ".mas", ".dof")}
    for path in files.values():
        if not path.is_file():
            raise Error(f"{path}: expected the file that *FREQUENCY, SOLVER=MATRIXSTORAGE writes, found none")
    try:
        # Numbers of nodes may end in zeros: a number is text until it is split.
        pairs = [[int(part) for part in line.split(".")] for line in files[".dof"].read_text().split()]
    except ValueError:
        raise Error(f"{files['.dof']}: expected node.direction in each line, found another text") from None
    labels, dofs = dof_table(np.array(pairs, ndmin=2))
    matrices = {}
    for extension in (".sti", ".mas"):
        table = read_columns(files[extension], 3)
        places = table[:, :2].astype(np.int64) - 1
        if places.min() < 0 or places.max() >= len(dofs):
            raise Error(
                f"{files[extension]}: expected rows and columns from 1 to {len(dofs)}, found up to {places.max() + 1}"
            )
        matrices[extension] = symmetric_matrix(places[:, 0], places[:, 1], table[:, 2], len(dofs))
    nodes = read_nodes(job) if nodes is None else nodes
    return FiniteElementModel(
        mass=matrices[".mas"],
        stiffness=matrices[".sti"],
        nodes=placed_nodes(job, labels, nodes),
        dofs=dofs,
        labels=labels,
        units=units,
        source=f"CalculiX: {job.name}",
    )
