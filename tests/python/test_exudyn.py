"""Models of Exudyn: its `FEMinterface` where it is installed, a file that it wrote, and objects like it."""

import io
import pickle
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import flexbody
import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse
from finite_elements import block, free_frequencies
from flexbody.reduction import Interface
from flexbody.reduction.readers import read_exudyn, read_exudyn_modes

# Written by FEMinterface.SaveToFile of Exudyn 1.13.6, with what `filled` makes.
STORED = Path(__file__).parent / "files" / "exudyn_block.npz"
NOTHING = {"first": Interface([0], held="nothing")}


def small():
    """The solid of eight nodes that the stored file has."""
    return block(elements=1)


def filled(fem, model):
    """Fills a FEMinterface, or an object like it, with a model."""
    values, shapes = scipy.linalg.eigh(model.stiffness.toarray(), model.mass.toarray())
    fem.nodes = {"Position": model.nodes}
    fem.massMatrix = sparse.csr_matrix(model.mass)
    fem.stiffnessMatrix = sparse.csr_matrix(model.stiffness)
    fem.surface = [{"Name": "skin", "Trigs": np.array([[0, 1, 2]]), "Quads": np.array([[0, 1, 3, 2]])}]
    fem.nodeSets = [{"Name": "left", "NodeNumbers": [0, 1, 2, 4], "NodeWeights": [0.1, 0.2, 0.3, 0.4]}]
    fem.modeBasis = {"matrix": 3.0 * shapes[:, 6:12], "type": "NormalModes"}
    fem.eigenValues = values[6:12]
    return fem


@pytest.mark.parametrize("source", ["object", "stored", "exudyn"])
def test_the_model_is_that_of_exudyn(source, tmp_path):
    if source == "exudyn":
        fem = filled(pytest.importorskip("exudyn.FEM", reason="Exudyn is not installed").FEMinterface(), small())
        fem.SaveToFile(str(tmp_path / "block"))
        fem = tmp_path / "block.npz"
    else:
        fem = filled(SimpleNamespace(), small()) if source == "object" else STORED
    model = read_exudyn(fem)
    expected = small()
    assert free_frequencies(model) == pytest.approx(free_frequencies(expected), rel=1e-9)
    assert model.nodes == pytest.approx(expected.nodes)
    assert model.triangles.tolist() == [[0, 1, 2], [0, 1, 3], [0, 3, 2]]
    left = model.interfaces["left"]
    assert left.weights == pytest.approx([0.1, 0.2, 0.3, 0.4])
    body = model.reduce({"left": replace(left, held="frame"), "corner": [7]}, modes=4)
    assert body.interfaces["left"].position == pytest.approx(left.weights @ expected.nodes[left.nodes])
    assert body.surface.triangles.shape == (3, 3)
    assert body.source.startswith("Exudyn: ")
    # Exudyn's own modes make the body that the matrices make.
    own, reduced = read_exudyn_modes(fem).reduce(NOTHING), model.reduce(NOTHING, modes=6)
    assert own.eigenvalues == pytest.approx(reduced.eigenvalues, rel=1e-9)
    assert own.inertia_2 == pytest.approx(reduced.inertia_2, abs=1e-8)


def test_modes_that_exudyn_computes_make_the_same_body():
    fem = filled(pytest.importorskip("exudyn.FEM", reason="Exudyn is not installed").FEMinterface(), block())
    fem.ComputeEigenmodes(nModes=8, excludeRigidBodyModes=6, useSparseSolver=False)
    own, reduced = read_exudyn_modes(fem).reduce(NOTHING), block().reduce(NOTHING, modes=8)
    assert own.eigenvalues == pytest.approx(reduced.eigenvalues, rel=1e-9)
    inertia = fem.GetRigidBodyInertia()
    assert own.mass == pytest.approx(inertia.Mass())
    assert own.centre == pytest.approx(inertia.COM())
    fem.ComputeHurtyCraigBamptonModes([[0, 1, 2, 4]], 4)
    with pytest.raises(flexbody.Error, match="modes: expected modes"):
        read_exudyn_modes(fem).reduce(NOTHING)


def test_matrices_of_earlier_versions_are_read():
    fem = filled(SimpleNamespace(), small())
    for name in ("massMatrix", "stiffnessMatrix"):
        entries = getattr(fem, name).tocoo()
        setattr(fem, name, np.column_stack([entries.row, entries.col, entries.data]))
    model = read_exudyn(fem)
    for name in ("mass", "stiffness"):
        assert (getattr(model, name) - getattr(small(), name)).count_nonzero() == 0
    fem.massMatrix[0, 0] = 24
    with pytest.raises(flexbody.Error, match="massMatrix: expected rows and columns from 0 to 23, found others"):
        read_exudyn(fem)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"nodes": {}}, "FEMinterface: nodes: expected nodes of the type Position, found none"),
        ({"nodes": {"RigidBodyRxyz": [[0] * 6]}}, "of the type Position, found RigidBodyRxyz"),
        ({"nodes": {"Position": [[0, 0]]}}, r"expected positions of shape \[nodes, 3\], found shape \[1, 2\]"),
        ({"massMatrix": None}, "massMatrix: expected a sparse matrix, found none"),
        ({"stiffnessMatrix": "stiff"}, "stiffnessMatrix: expected a sparse matrix, .* found 'stiff'"),
        ({"stiffnessMatrix": sparse.eye(9)}, r"expected 24 rows and columns, three a node, found shape \[9, 9\]"),
        ({"surface": [{"Trigs": [[0, 1]]}]}, r"surface: expected Trigs as indices of nodes, found shape \[1, 2\]"),
        ({"nodeSets": [{"Name": "a", "NodeNumbers": [0.5]}]}, "nodeSets: expected indices of nodes"),
        ({"modeBasis": {}}, r"modeBasis: expected modes of shape \[24, modes\], found shape"),
    ],
)
def test_what_is_missing_is_named(change, message):
    fem = filled(SimpleNamespace(), small())
    for name, value in change.items():
        setattr(fem, name, value)
    with pytest.raises(flexbody.Error, match=message):
        read_exudyn_modes(fem)


class Harmful:
    """What a pickled object may do: call any function when it is loaded."""

    def __reduce__(self):
        return sys.modules["os"].system, ("exit 1",)


def test_files_that_are_none_of_exudyn_are_refused(tmp_path):
    path = tmp_path / "fem.npz"
    with pytest.raises(flexbody.Error, match="fem.npz: expected a file of FEMinterface.SaveToFile, found none"):
        read_exudyn(path)
    path.write_text("no archive", encoding="ascii")
    with pytest.raises(flexbody.Error, match="expected a file .npz of .*, found another kind of file"):
        read_exudyn(path)
    np.savez(path, other=np.zeros(3))
    with pytest.raises(flexbody.Error, match="fem.npz: nodes: expected nodes of the type Position, found none"):
        read_exudyn(path)
    with pytest.raises(flexbody.Error, match="fem: expected a FEMinterface or the path of its file, found int"):
        read_exudyn(7)
    harmful = np.empty((), object)
    harmful[()] = {"Position": Harmful()}
    np.savez(path, nodes=harmful)
    with pytest.raises(flexbody.Error, match="nodes: expected arrays, .*, found an object (posix|nt).system"):
        read_exudyn(path)
    wild = sparse.csr_matrix(np.eye(3))
    wild.indices = np.array([0, 1, 10**6], np.int32)
    fem = filled(SimpleNamespace(), small())
    fem.nodes, fem.massMatrix = {"Position": fem.nodes["Position"][:1]}, wild
    with pytest.raises(flexbody.Error, match="massMatrix: expected a sparse matrix, found one that is none"):
        read_exudyn(fem)
    # A name of numpy that is no array.
    content = io.BytesIO()
    np.lib.format.write_array_header_1_0(content, {"descr": "|O", "fortran_order": False, "shape": ()})
    content.write(pickle.dumps(np.fft.fft))
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("nodes.npy", content.getvalue())
    with pytest.raises(flexbody.Error, match="found an object numpy.*fft"):
        read_exudyn(path)
