"""Models of Nastran and OptiStruct, by pyNastran: bulk data, DMIG entries, OP4 matrices and modes in OP2."""

import warnings
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody._program import FlexbodyWarning
from flexbody.reduction.modal import ModalModel
from flexbody.reduction.model import FiniteElementModel
from flexbody.reduction.readers.triplets import dof_table, symmetric_matrix

# Entries of bulk data that are read.
COORDINATES = ("CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S")
EQUATIONS = ("MPC", "RBAR", "RBAR1", "RBE1", "RBE2", "RBE3", "RROD", "RSPLINE")
# Forms of DMIG entries: all entries, or those of one triangle.
SQUARE, SYMMETRIC = 1, 6
# Names of the matrices: those of EXTSEOUT, and those of all degrees of freedom.
DMIG_NAMES = ("MAAX", "KAAX")
OP4_NAMES = ("MGG", "KGG")


@dataclass
class BulkData:
    """Bulk data of one or several files.

    where: names of the files, for messages.
    nodes: coordinates [3] by number of the node, in the basic system.
    axes: axes [3, 3] of displacements as columns, by number of the node, where they are not those of the basic system.
    scalars: numbers of scalar points.
    matrices: DMIG entries by name, as objects of pyNastran.
    equations: kinds of rigid elements and equations that there are.
    boundary: points and directions [rows, 2] of an external superelement (EXTRN), in order of its matrices; empty where
        there is none.
    """

    where: str
    nodes: dict = field(default_factory=dict)
    axes: dict = field(default_factory=dict)
    scalars: set = field(default_factory=set)
    matrices: dict = field(default_factory=dict)
    equations: set = field(default_factory=set)
    boundary: list = field(default_factory=list)


def read_nastran(bulk, *, units, matrices=None, mass=None, stiffness=None, dofs=None):
    """Reads nodes and matrices that Nastran or OptiStruct wrote. Needs pyNastran (`pip install "flexbody[nastran]"`).

    bulk: path of the bulk data, or paths of several files: an input file (`.bdf`, `.dat`) with the nodes, and a punch
        file (`.pch`) with DMIG entries, such as EXTSEOUT(DMIGPCH) writes.
    units: consistent unit system of the bulk data, such as `mm-t-s`.
    matrices: path of an OP4 file with the matrices, text or binary, dense or sparse; or paths of two. If it is not
        given, they are DMIG entries of the bulk data.
    mass, stiffness: names of the matrices. Without names they are MAAX and KAAX in DMIG entries, MGG and KGG in OP4.
    dofs: number of the point and direction (1 to 6, 0 for a scalar point) of each row of OP4 matrices [dofs, 2]. If it
        is not given, the rows are those of EXTRN entries, or of all points in order of their numbers (g-set), six for a
        node.

    Returns a `FiniteElementModel` whose labels are numbers of nodes. Displacements are rotated from the systems that
    nodes name (field CD) to the basic one. Rows without mass and stiffness are left out. Scalar points, such as
    amplitudes of modes of a superelement, stay as amplitudes of inner modes.

    Warns (`flexbody.FlexbodyWarning`) of matrices that hold few of the nodes, and of rigid elements that matrices of
    all points do not contain. Raises `flexbody.Error` if files do not fit each other.
    """
    bulk = read_bulk_data(bulk)
    names = OP4_NAMES if matrices is not None else DMIG_NAMES
    names = [names[0] if mass is None else mass, names[1] if stiffness is None else stiffness]
    if matrices is None:
        where = bulk.where
        pairs, found = _dmig_matrices(bulk, names)
    else:
        where = _listed(matrices)
        pairs = _rows(bulk, dofs)
        found = [_op4_matrix(matrices, name, len(pairs)) for name in names]
    _warn_of_equations(bulk, names)
    return _model(bulk, where, pairs, found, _loaded(found), units)


def read_nastran_modes(modes, bulk, *, units, matrices=None, mass=None, dofs=None, subcase=None):
    """Reads modes of the free body from OP2, with the mass that they are orthogonal in. Needs pyNastran.

    modes: path of the OP2 file of a modal analysis (SOL 103, `DISPLACEMENT(PLOT) = ALL`) without supports.
    bulk, units, matrices, mass, dofs: as in `read_nastran`; the stiffness is not needed.
    subcase: number of the subcase; the only one if it is not given.

    Returns a `ModalModel`. Raises `flexbody.Error` if files do not fit each other.
    """
    bulk = read_bulk_data(bulk)
    name = mass or (OP4_NAMES if matrices is not None else DMIG_NAMES)[0]
    if matrices is None:
        pairs, (found,) = _dmig_matrices(bulk, [name])
    else:
        pairs = _rows(bulk, dofs)
        found = _op4_matrix(matrices, name, len(pairs))
    table = _eigenvectors(modes, subcase)
    shapes = _shapes(modes, table, pairs, _loaded([found]), bulk.axes)
    # Lumped masses have no rotary inertia, but interfaces read rotations.
    used = _loaded([found]) | (np.abs(shapes).max(axis=1) > 0)
    model = _model(bulk, _listed(modes), pairs, [found, found], used, units)
    return ModalModel(
        mass=model.mass,
        modes=shapes[used],
        eigenvalues=np.asarray(table.eigns, float),
        nodes=model.nodes,
        dofs=model.dofs,
        labels=model.labels,
        units=units,
        source=f"Nastran: {Path(modes).name}",
    )


def read_bulk_data(paths):
    """Reads nodes, coordinate systems, DMIG entries and the kinds of rigid elements: a `BulkData`.

    paths: path of a file, or paths of several. Files that INCLUDE names are read with them.
    """
    found = BulkData(_listed(paths))
    for path in _each(paths):
        path = Path(path)
        if not path.is_file():
            raise Error(f"{path}: expected a file of bulk data, found none")
        try:
            model = _parsed(path)
        except ImportError:
            raise
        except Exception as wrong:  # pyNastran has errors of many kinds.
            raise Error(f"{path}: expected bulk data of Nastran, found {_first_line(wrong)}") from None
        for number, node in model.nodes.items():
            found.nodes[number] = np.array(node.get_position())
            axes = _axes(node)
            if axes is not None:
                found.axes[number] = axes
        found.scalars.update(model.spoints)
        found.matrices.update(model.dmig)
        found.equations.update(element.type for element in model.rigid_elements.values())
        found.equations.update("MPC" for _ in model.mpcs)
        found.boundary += _boundary(path)
    if not found.nodes:
        raise Error(f"{found.where}: expected nodes (GRID), found none")
    return found


def _parsed(path):
    """A file of bulk data as an object of pyNastran, whose nodes know their coordinate systems."""
    model = _imported("pyNastran.bdf.bdf").BDF(debug=None)
    model.enable_cards([*COORDINATES, *EQUATIONS, "GRID", "GRDSET", "SPOINT", "DMIG", "INCLUDE", "ENDDATA", "/"])
    text = path.read_text(encoding="utf-8", errors="replace")
    starts = [line.upper().split()[:2] for line in text.splitlines() if line[:5].upper() == "BEGIN"]
    if ["BEGIN", "SUPER"] in starts:
        # Bulk data of an external superelement, to be included in those of an assembly.
        lines = [line for line in text.splitlines() if line[:5].upper() != "BEGIN"]
        model.read_bdf(StringIO("\n".join(lines) + "\n"), xref=False, punch=True)
    else:
        model.read_bdf(path, xref=False, punch=not starts)
    model.cross_reference(**{f"xref_{kind}": False for kind in _NOT_LINKED})
    return model


def _boundary(path):
    """Points and directions of the EXTRN entries of a file, which pyNastran does not read."""
    to_fields = _imported("pyNastran.bdf.bdf_interface.utils").to_fields
    pairs = []
    lines = [line for line in path.read_text(encoding="utf-8", errors="replace").splitlines() if line[:1] != "$"]
    for start, line in enumerate(lines):
        if line[:5].upper() != "EXTRN":
            continue
        end = start + 1
        while end < len(lines) and lines[end][:1] in (" ", "+", "*", ","):
            end += 1
        fields = [text.strip() for text in to_fields(lines[start:end], "EXTRN")[1:]]
        fields = [text for text in fields if text]
        for number, directions in zip(fields[::2], fields[1::2], strict=True):
            pairs += [(int(number), int(direction)) for direction in directions]
    return pairs


# What pyNastran would link beside nodes and coordinate systems.
_NOT_LINKED = ("elements", "properties", "masses", "materials", "loads", "constraints", "aero", "sets", "optimization")


def _axes(node):
    """Axes of the displacements of a node as columns [3, 3] in the basic system, or None where they are its axes."""
    system = node.cd_ref
    if system is None or node.Cd() in (0, -1):
        return None
    # Rows are the axes of the system.
    turn = np.array(system.beta())
    kind = system.type[-1]
    if kind == "R":
        return turn.T
    local = turn @ (node.get_position() - system.origin)
    along = np.hypot(local[0], local[1])
    if along == 0:
        raise Error(
            f"node {node.nid}: expected a node beside the axis of the coordinate system {node.Cd()}, found it on it"
        )
    radial = np.array([local[0] / along, local[1] / along, 0.0])
    around = np.array([-radial[1], radial[0], 0.0])
    if kind == "C":
        return turn.T @ np.column_stack([radial, around, [0.0, 0.0, 1.0]])
    outward = local / np.linalg.norm(local)
    return turn.T @ np.column_stack([outward, np.cross(around, outward), around])


def _dmig_matrices(bulk, names):
    """Points and directions of the rows [dofs, 2], and matrices of DMIG entries."""
    entries = []
    for name in names:
        if name not in bulk.matrices:
            known = ", ".join(sorted(bulk.matrices)) or "none"
            raise Error(f"{bulk.where}: expected the DMIG matrix {name}, found {known}")
        entry = bulk.matrices[name]
        if entry.is_complex:
            raise Error(f"{bulk.where}: {name}: expected real numbers, found complex ones")
        if entry.matrix_form not in (SQUARE, SYMMETRIC):
            raise Error(f"{bulk.where}: {name}: expected a square or symmetric matrix, found form {entry.matrix_form}")
        entries.append(entry)
    ends = [np.array(end, np.int64).reshape(-1, 2) for entry in entries for end in (entry.GCi, entry.GCj)]
    pairs, places = np.unique(np.vstack(ends), axis=0, return_inverse=True)
    parts = np.split(places.ravel(), np.cumsum([len(end) for end in ends])[:-1])
    matrices = []
    for entry, rows, columns in zip(entries, parts[::2], parts[1::2], strict=True):
        matrix = sparse.coo_array((np.asarray(entry.Real, float), (rows, columns)), shape=[len(pairs)] * 2).tocsc()
        if entry.matrix_form == SYMMETRIC:
            matrix = matrix + matrix.T - sparse.diags_array(matrix.diagonal())
        matrices.append(matrix)
    return pairs, matrices


def _rows(bulk, dofs):
    """Points and directions of the rows of OP4 matrices [dofs, 2]."""
    if dofs is not None:
        found = np.asarray(dofs)
        if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
            raise Error(
                f"dofs: expected integers of shape [rows, 2] (point, direction), found shape {list(found.shape)}"
            )
        return found
    if bulk.boundary:
        return np.array(bulk.boundary, np.int64)
    pairs = [(number, direction) for number in bulk.nodes for direction in range(1, 7)]
    pairs += [(number, 0) for number in bulk.scalars]
    return np.array(sorted(pairs), np.int64)


def _op4_matrix(paths, name, size):
    """A square matrix of an OP4 file."""
    reader = _imported("pyNastran.op4.op4")
    known = []
    for path in _each(paths):
        if not Path(path).is_file():
            raise Error(f"{path}: expected an OP4 file, found none")
        try:
            found = reader.read_op4(str(path), debug=None)
        except Exception as wrong:
            raise Error(f"{path}: expected an OP4 file, found {_first_line(wrong)}") from None
        known += list(found)
        if name not in found:
            continue
        matrix = sparse.coo_array(found[name].data)
        if matrix.shape != (size, size):
            raise Error(
                f"{path}: {name}: expected {size} rows and columns, those of the points in order, found "
                f"{list(matrix.shape)}: give `dofs`"
            )
        if matrix.dtype.kind == "c":
            raise Error(f"{path}: {name}: expected real numbers, found complex ones")
        return symmetric_matrix(matrix.row, matrix.col, matrix.data.astype(float), size)
    raise Error(f"{_listed(paths)}: expected the matrix {name}, found {', '.join(sorted(known)) or 'none'}")


def _loaded(matrices):
    """Rows that have an entry in one of the matrices [rows]."""
    return sum(abs(matrix) @ np.ones(matrix.shape[0]) for matrix in matrices) > 0


def _model(bulk, where, pairs, matrices, used, units):
    """Matrices in the axes of the basic system as a `FiniteElementModel`: mass, then stiffness; rows that are used."""
    turn = _to_basic(bulk.axes, pairs[used])
    pairs = pairs[used]
    matrices = [matrix[used][:, used].tocsc() for matrix in matrices]
    if turn is not None:
        matrices = [(turn @ matrix @ turn.T).tocsc() for matrix in matrices]
    inner = pairs[:, 1] == 0
    missing = sorted(set(pairs[~inner, 0].tolist()) - set(bulk.nodes))
    if missing:
        raise Error(
            f"{where}: expected matrices of the nodes of {bulk.where}; {len(missing)} are none, such as {missing[:3]}"
        )
    if inner.all():
        raise Error(
            f"{where}: expected matrices of nodes, found {len(pairs)} rows with mass or stiffness, none of a node"
        )
    labels, table = dof_table(pairs[~inner])
    dofs = np.full((len(pairs), 2), -1)
    dofs[~inner] = table
    if len(labels) < len(bulk.nodes) / 2:
        _warn(
            f"{where}: the matrices hold {len(labels)} of {len(bulk.nodes)} nodes: forces of inertia between them are "
            f"missing in part when the body rotates; reduce the matrices of all nodes where that counts"
        )
    return FiniteElementModel(
        mass=matrices[0],
        stiffness=matrices[1],
        nodes=np.array([bulk.nodes[label] for label in labels]),
        dofs=dofs,
        labels=labels,
        units=units,
        source=f"Nastran: {where}",
    )


def _to_basic(axes, pairs):
    """Sparse matrix [dofs, dofs] from displacements in the systems of nodes to the basic one; None if they are it."""
    rows = {(int(number), int(direction)): row for row, (number, direction) in enumerate(pairs)}
    blocks = []
    for number, turn in axes.items():
        for first in (1, 4):
            own = [rows.get((number, direction)) for direction in range(first, first + 3)]
            if own == [None] * 3:
                continue
            if None in own:
                raise Error(
                    f"node {number}: expected all three {'translations' if first == 1 else 'rotations'} in the "
                    f"matrices, because its displacements have other axes (CD), found some"
                )
            blocks.append((np.array(own), turn))
    if not blocks:
        return None
    turned = np.concatenate([own for own, _ in blocks])
    single = np.setdiff1d(np.arange(len(pairs)), turned)
    row = np.concatenate([single, *[np.repeat(own, 3) for own, _ in blocks]])
    column = np.concatenate([single, *[np.tile(own, 3) for own, _ in blocks]])
    values = np.concatenate([np.ones(len(single)), *[turn.ravel() for _, turn in blocks]])
    return sparse.coo_array((values, (row, column)), shape=[len(pairs)] * 2).tocsc()


def _eigenvectors(path, subcase):
    """Table of eigenvectors of an OP2 file, as an object of pyNastran."""
    reader = _imported("pyNastran.op2.op2")
    if not Path(path).is_file():
        raise Error(f"{path}: expected an OP2 file, found none")
    try:
        results = reader.read_op2(str(path), debug=None, build_dataframe=False)
    except Exception as wrong:
        raise Error(f"{path}: expected an OP2 file, found {_first_line(wrong)}") from None
    tables = results.eigenvectors
    if subcase is None and len(tables) == 1:
        return next(iter(tables.values()))
    if subcase is None or subcase not in tables:
        wanted = "one subcase" if subcase is None else f"the subcase {subcase}"
        raise Error(f"{path}: expected eigenvectors of {wanted}, found those of {sorted(tables) or 'none'}")
    return tables[subcase]


def _shapes(path, table, pairs, heavy, axes):
    """Modes [rows, modes] along the axes of the basic system; zero where the table has no such point.

    heavy: rows that have mass [rows].
    """
    numbers = table.node_gridtype[:, 0]
    known = np.isin(pairs[:, 0], numbers)
    missing = np.unique(pairs[heavy & ~known, 0]).tolist()
    if missing:
        raise Error(
            f"{path}: expected modes of all points with mass; {len(missing)} are missing, such as {missing[:3]}"
        )
    if (heavy & (pairs[:, 1] == 0)).any():
        raise Error(f"{path}: expected modes of nodes, found scalar points with mass")
    data = np.array(table.data, float)
    # Tables whose names begin with B are along the axes of the basic system.
    if not table.table_name_str.startswith("B"):
        for place, number in enumerate(numbers.tolist()):
            turn = axes.get(number)
            if turn is not None:
                data[:, place, :3] = data[:, place, :3] @ turn.T
                data[:, place, 3:] = data[:, place, 3:] @ turn.T
    rows = np.flatnonzero(known & (pairs[:, 1] > 0))
    order = np.argsort(numbers)
    places = order[np.searchsorted(numbers, pairs[rows, 0], sorter=order)]
    shapes = np.zeros((len(pairs), len(data)))
    shapes[rows] = data[:, places, pairs[rows, 1] - 1].T
    return shapes


def _warn_of_equations(bulk, names):
    # Other names are those of sets from which equations are eliminated.
    if bulk.equations and any(name in OP4_NAMES for name in names):
        _warn(
            f"{bulk.where}: {', '.join(sorted(bulk.equations))} are not part of the matrices {' and '.join(names)}: "
            f"make interfaces of their nodes, `rigid` for an RBE2 and `mean` for an RBE3"
        )


def _warn(text):
    warnings.warn(text, FlexbodyWarning, stacklevel=4)


def _each(paths):
    return [paths] if isinstance(paths, (str, Path)) else list(paths)


def _listed(paths):
    return ", ".join(Path(path).name for path in _each(paths))


def _first_line(wrong):
    return (str(wrong).strip().splitlines() or [type(wrong).__name__])[0]


def _imported(name):
    """A module of pyNastran. Raises `ImportError` that says what to install."""
    from importlib import import_module

    try:
        return import_module(name)
    except ModuleNotFoundError as missing:
        raise ImportError(f'readers of Nastran: expected {missing.name}; pip install "flexbody[nastran]"') from None
