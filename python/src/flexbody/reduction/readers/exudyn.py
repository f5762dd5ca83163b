"""Models of Exudyn: a `FEMinterface`, as an object or as the file that its `SaveToFile` writes."""

import io
import pickle
import zipfile
from pathlib import Path

import numpy as np
import scipy.sparse as sparse

from flexbody._errors import Error
from flexbody.reduction.interface import Interface
from flexbody.reduction.modal import ModalModel
from flexbody.reduction.model import FiniteElementModel

# What a file may contain beside numbers and texts, by module and name. Its other objects are refused, because a pickled
# object can run any code.
ALLOWED = {
    ("numpy", "ndarray"): np.ndarray,
    ("numpy", "dtype"): np.dtype,
    ("multiarray", "_reconstruct"): np.empty(0).__reduce__()[0],
    ("multiarray", "scalar"): np.float64(0).__reduce__()[0],
    **{("sparse", name): getattr(sparse, name) for name in ("csr_matrix", "csc_matrix", "coo_matrix", "csr_array")},
}
# Entries of a file that are read; others are left alone.
ENTRIES = ("nodes", "massMatrix", "stiffnessMatrix", "surface", "nodeSets", "modeBasis")


def read_exudyn(fem, *, units="m-kg-s"):
    """Reads mass, stiffness, nodes, surface and node sets of Exudyn.

    fem: an `exudyn.FEM.FEMinterface` with nodes of the type `Position`, or the path of the file `.npz` that its method
        `SaveToFile` writes. Exudyn need not be installed.
    units: consistent unit system, such as `m-kg-s`.

    Returns a `FiniteElementModel` with `interfaces` (node sets with their weights, kind `mean`) and `triangles`
    (quadrilaterals are divided). Its labels are the indices of nodes. Raises `flexbody.Error` if something is missing,
    or of another kind.
    """
    where, data = _entries(fem)
    nodes = _nodes(where, data)
    size = 3 * len(nodes)
    return FiniteElementModel(
        mass=_matrix(where, data, "massMatrix", size),
        stiffness=_matrix(where, data, "stiffnessMatrix", size),
        nodes=nodes,
        labels=np.arange(len(nodes)),
        units=units,
        source=f"Exudyn: {where}",
        triangles=_triangles(where, data),
        interfaces=_interfaces(where, data),
    )


def read_exudyn_modes(fem, *, units="m-kg-s"):
    """Reads the modes of `FEMinterface.ComputeEigenmodes`, of the free body, with the mass.

    fem, units: as in `read_exudyn`. Eigenvalues follow from modes, mass and stiffness.

    Returns a `ModalModel`. Raises `flexbody.Error` if there are no modes. Its `reduce` refuses modes that are not those
    of the free body, such as those of Hurty, Craig and Bampton: `read_exudyn` makes a body with such a basis.
    """
    model = read_exudyn(fem, units=units)
    where, data = _entries(fem)
    basis = data.get("modeBasis")
    modes = basis.get("matrix") if isinstance(basis, dict) else None
    size = model.mass.shape[0]
    modes = np.asarray(0.0 if modes is None else modes, float)
    if modes.ndim != 2 or modes.shape[0] != size:
        raise Error(f"{where}: modeBasis: expected modes of shape [{size}, modes], found shape {list(modes.shape)}")
    masses, energies = (np.einsum("dk,dk->k", modes, matrix @ modes) for matrix in (model.mass, model.stiffness))
    with np.errstate(divide="ignore", invalid="ignore"):
        eigenvalues = energies / masses
    return ModalModel(
        model.mass, modes, eigenvalues, model.nodes, labels=model.labels, units=units, source=model.source
    )


def _entries(fem):
    """Name of the source for messages, and its entries by name."""
    if not isinstance(fem, (str, Path)):
        missing = [name for name in ENTRIES[:3] if not hasattr(fem, name)]
        if missing:
            raise Error(f"fem: expected a FEMinterface or the path of its file, found {type(fem).__name__}")
        return "FEMinterface", {name: getattr(fem, name, None) for name in ENTRIES}
    path = Path(fem)
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            return path.name, {
                name: _array(path, name, archive.read(f"{name}.npy")) for name in ENTRIES if f"{name}.npy" in names
            }
    except FileNotFoundError:
        raise Error(f"{path}: expected a file of FEMinterface.SaveToFile, found none") from None
    except zipfile.BadZipFile:
        raise Error(f"{path}: expected a file .npz of FEMinterface.SaveToFile, found another kind of file") from None


class _Unpickler(pickle.Unpickler):
    """Makes arrays, sparse matrices and plain values, and nothing else."""

    def find_class(self, module, name):
        """The object with a name, or an error if it is none of those allowed."""
        parts = module.split(".")
        known = ALLOWED.get((parts[0] if name in ("ndarray", "dtype") else parts[-1], name))
        if parts[:2] == ["scipy", "sparse"]:
            known = ALLOWED.get(("sparse", name))
        if known is None or parts[0] not in ("numpy", "scipy"):
            raise pickle.UnpicklingError(f"an object {module}.{name}")
        return known


def _array(path, name, content):
    """An entry of the file: an array, or the Python object in it."""
    file = io.BytesIO(content)
    try:
        version = np.lib.format.read_magic(file)
        header = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}[version]
        shape, _, kind = header(file)
        if not kind.hasobject:
            return np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)
        found = _Unpickler(file).load()
    except Exception as wrong:
        raise Error(f"{path}: {name}: expected arrays, sparse matrices and plain values, found {wrong}") from None
    return found.item() if shape == () else list(found)


def _nodes(where, data):
    nodes = data.get("nodes")
    kinds = list(nodes) if isinstance(nodes, dict) else []
    if kinds != ["Position"]:
        raise Error(f"{where}: nodes: expected nodes of the type Position, found {', '.join(kinds) or 'none'}")
    found = np.asarray(nodes["Position"], float)
    if found.ndim != 2 or found.shape[1] != 3:
        raise Error(f"{where}: nodes: expected positions of shape [nodes, 3], found shape {list(found.shape)}")
    return found


def _matrix(where, data, name, size):
    """A matrix: sparse, or the rows, columns and values [entries, 3] of earlier versions."""
    matrix = data.get(name)
    if matrix is None:
        raise Error(f"{where}: {name}: expected a sparse matrix, found none")
    if not sparse.issparse(matrix):
        matrix = _from_triplets(where, name, matrix, size)
    if matrix.shape != (size, size):
        raise Error(
            f"{where}: {name}: expected {size} rows and columns, three a node, found shape {list(matrix.shape)}"
        )
    try:
        # Indices of a file may lead anywhere.
        if matrix.format in ("csr", "csc"):
            matrix.check_format(full_check=True)
        return sparse.csc_array(matrix, dtype=float)
    except (ValueError, AttributeError, TypeError) as wrong:
        raise Error(f"{where}: {name}: expected a sparse matrix, found one that is none: {wrong}") from None


def _from_triplets(where, name, given, size):
    """Sparse matrix from rows, columns and values [entries, 3]."""
    try:
        table = np.asarray(given, float)
    except (ValueError, TypeError):
        table = np.empty(0)
    if table.ndim != 2 or table.shape[1] != 3:
        raise Error(f"{where}: {name}: expected a sparse matrix, or rows, columns and values, found {given!r:.60}")
    rows, columns = table[:, :2].astype(np.int64).T
    if len(table) and (min(rows.min(), columns.min()) < 0 or max(rows.max(), columns.max()) >= size):
        raise Error(f"{where}: {name}: expected rows and columns from 0 to {size - 1}, found others")
    return sparse.coo_array((table[:, 2], (rows, columns)), shape=(size, size))


def _triangles(where, data):
    """Surface as indices of nodes [triangles, 3], or None."""
    parts = []
    for part in data.get("surface") or []:
        for name, corners in (("Trigs", [[0, 1, 2]]), ("Quads", [[0, 1, 2], [0, 2, 3]])):
            faces = np.asarray(part.get(name, []))
            if not faces.size:
                continue
            if faces.ndim != 2 or faces.shape[1] != (3 if name == "Trigs" else 4) or faces.dtype.kind not in "iu":
                raise Error(f"{where}: surface: expected {name} as indices of nodes, found shape {list(faces.shape)}")
            parts += [faces[:, corner] for corner in corners]
    return np.vstack(parts) if parts else None


def _interfaces(where, data):
    found = {}
    for part in data.get("nodeSets") or []:
        numbers = np.asarray(part.get("NodeNumbers", []))
        if not numbers.size:
            continue
        if numbers.ndim != 1 or numbers.dtype.kind not in "iu":
            raise Error(f"{where}: nodeSets: expected indices of nodes, found {numbers!r:.60}")
        weights = np.asarray(part.get("NodeWeights", []), float)
        found[str(part.get("Name"))] = Interface(numbers, weights if weights.shape == numbers.shape else None)
    return found
