"""Readers of finite element models: CalculiX itself where it is installed, and files in the formats of others."""

import shutil
import subprocess

import flexbody
import numpy as np
import pytest
import scipy.io
import scipy.linalg
import scipy.sparse as sparse
from flexbody.reduction import Interface
from flexbody.reduction.readers import read_abaqus, read_calculix, read_matrix_market
from flexbody.reduction.readers.scikit_fem import Solid, nodes_and_dofs
from skfem import Basis, ElementHex1, ElementTetP1, ElementVector, MeshHex, MeshTet

LENGTH, WIDTH, HEIGHT = 200.0, 30.0, 10.0
# Steel in mm, t, s.
MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.85e-9\n"


def bar():
    """Mesh of hexahedra in mm."""
    return MeshHex.init_tensor(np.linspace(0, LENGTH, 11), np.linspace(0, WIDTH, 3), np.linspace(0, HEIGHT, 2))


def element_nodes(mesh):
    """Corners of each hexahedron in the order of CalculiX and Abaqus: around the lower face, then the upper."""
    corners = []
    for element in mesh.t.T:
        lower, upper = sorted(element, key=lambda node: mesh.p[2, node])[:4], []
        middle = mesh.p[:2, element].mean(axis=1)
        lower.sort(key=lambda node: np.arctan2(*(mesh.p[:2, node] - middle)[::-1]))
        for node in lower:
            upper += [other for other in element if other != node and np.allclose(mesh.p[:2, other], mesh.p[:2, node])]
        corners.append(lower + upper)
    return np.array(corners)


def deck(mesh, step, labels):
    """Input file of CalculiX."""
    nodes = "".join(
        f"{label}, {x!r}, {y!r}, {z!r}\n" for label, (x, y, z) in zip(labels, mesh.p.T.tolist(), strict=True)
    )
    elements = "".join(
        f"{number + 1}, {', '.join(str(labels[node]) for node in corners)}\n"
        for number, corners in enumerate(element_nodes(mesh))
    )
    return (
        f"** A bar\n*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=C3D8, ELSET=BAR\n{elements}{MATERIAL}"
        f"*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL\n{step}"
    )


def run_calculix(folder, job, text):
    (folder / f"{job}.inp").write_text(text, encoding="ascii")
    result = subprocess.run(["ccx", job], cwd=folder, capture_output=True, text=True, check=False)
    assert result.returncode == 0 and "Job finished" in result.stdout, result.stdout
    return folder / f"{job}.inp"


@pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed")
def test_frequencies_are_those_of_calculix(tmp_path):
    """CalculiX fixes one end; the reduced body of the free matrices has this end as a rigid, held interface."""
    mesh = bar()
    # Some numbers end in zeros, and they are no row numbers.
    labels = [10 * node + 100 for node in range(mesh.nvertices)]
    root = np.flatnonzero(mesh.p[0] < 1e-9)
    free = run_calculix(tmp_path, "free", deck(mesh, "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n", labels))
    fixed = "".join(f"{labels[node]}, 1, 3\n" for node in root)
    step = f"*BOUNDARY\n{fixed}*STEP\n*FREQUENCY\n8\n*END STEP\n"
    run_calculix(tmp_path, "fixed", deck(mesh, step, labels))
    expected = []
    for line in (tmp_path / "fixed.dat").read_text(encoding="ascii").splitlines():
        words = line.split()
        if len(words) == 5 and words[0].isdigit():
            expected.append(float(words[3]))
        elif "P A R T I C I P A T I O N" in line:
            break
    assert len(expected) == 8

    model = read_calculix(free, units="mm-t-s")
    assert model.source == "CalculiX: free.inp"
    held = model.indices([labels[node] for node in root])
    body = model.reduce({"root": Interface(held, kind="rigid", held="frame")}, modes=10)
    assert body.mass == pytest.approx(7850 * LENGTH * WIDTH * HEIGHT * 1e-9, rel=1e-6)
    assert held_frequencies(body, "root")[:8] == pytest.approx(expected, rel=1e-4)


def held_frequencies(body, name):
    """Frequencies of a reduced body whose interface is held in position and orientation, Hz."""
    motion = body.interfaces[name]
    x, y, z = motion.position - body.centre
    arm = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    count = len(body.eigenvalues)
    rows = np.block([[np.eye(3), -arm, motion.modes], [np.zeros((3, 3)), np.eye(3), motion.rotation]])
    xx, yy, zz, xy, xz, yz = body.inertia
    mass = np.eye(count + 6)
    mass[:3, :3] *= body.mass
    mass[3:6, 3:6] = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    stiffness = np.diag(np.concatenate([np.zeros(6), body.eigenvalues]))
    free = scipy.linalg.null_space(rows)
    return np.sqrt(scipy.linalg.eigvalsh(free.T @ stiffness @ free, free.T @ mass @ free)) / (2 * np.pi)


@pytest.fixture(scope="module")
def solid():
    """A solid of another mesh in m, with three degrees of freedom a node in order of the nodes."""
    mesh = MeshHex.init_tensor(np.linspace(0, 0.2, 4), np.linspace(0, 0.03, 2), np.linspace(0, 0.01, 2))
    return Solid(Basis(mesh, ElementVector(ElementHex1())), youngs_modulus=2.1e11, poissons_ratio=0.3, density=7850)


def triangle(matrix, which):
    """Rows, columns and values of a triangle of a matrix, or of both."""
    parts = {"lower": sparse.tril, "upper": sparse.triu, "both": sparse.coo_array}
    found = sparse.coo_array(parts[which](matrix))
    return zip(found.row.tolist(), found.col.tolist(), found.data.tolist(), strict=True)


def write_abaqus(folder, model, form, which):
    """Files in the forms of `*MATRIX OUTPUT`, and an input file; numbers of nodes begin with 7."""
    paths = []
    for name, matrix in [("MASS", model.mass), ("STIF", model.stiffness)]:
        lines = ["** written by a test"] if form == "MATRIX INPUT" else []
        for row, column, value in triangle(matrix, which):
            if form == "MATRIX INPUT":
                at = [f"{model.dofs[end, 0] + 7},{model.dofs[end, 1] + 1}" for end in (row, column)]
                lines.append(f"{at[0]}, {at[1]}, {value:.16e}")
            else:
                order = [3 * model.dofs[end, 0] + model.dofs[end, 1] + 1 for end in (row, column)]
                lines.append(f"{order[0]}  {order[1]}  {value:.16e}")
        paths.append(folder / f"job_{name}1.mtx")
        paths[-1].write_text("\n".join(lines) + "\n", encoding="ascii")
    nodes = "".join(f"{node + 7}, {x!r}, {y!r}, {z!r}\n" for node, (x, y, z) in enumerate(model.nodes.tolist()))
    (folder / "nodes.txt").write_text(nodes, encoding="ascii")
    (folder / "job.inp").write_text("*Heading\n a bar\n** comment\n*Node, input=nodes.txt\n*Step\n", encoding="ascii")
    return [*paths, folder / "job.inp"]


@pytest.mark.parametrize("form", ["MATRIX INPUT", "COORDINATE"])
@pytest.mark.parametrize("which", ["lower", "upper", "both"])
def test_abaqus_matrices_are_read(solid, tmp_path, form, which):
    files = write_abaqus(tmp_path, solid.model, form, which)
    model = read_abaqus(*files, units="m-kg-s")
    assert model.labels.tolist() == list(range(7, 7 + len(solid.model.nodes)))
    ends = {"left": np.flatnonzero(solid.model.nodes[:, 0] < 1e-9)}
    expected = solid.model.reduce(ends, modes=5)
    found = model.reduce({"left": model.indices(ends["left"] + 7)}, modes=5)
    assert found.eigenvalues == pytest.approx(expected.eigenvalues, rel=1e-9)
    assert found.interfaces["left"].position == pytest.approx(expected.interfaces["left"].position)


def test_files_of_abaqus_that_do_not_fit_are_refused(solid, tmp_path):
    mass, stiffness, deck_path = write_abaqus(tmp_path, solid.model, "MATRIX INPUT", "lower")

    def refused(message, *files):
        with pytest.raises(flexbody.Error, match=message):
            read_abaqus(*files, units="m-kg-s")

    refused(
        "expected coordinates of the nodes of the matrices; 1 are missing",
        mass,
        stiffness,
        {label: [0.0, 0.0, 0.0] for label in range(8, 40)},
    )
    other = tmp_path / "other.mtx"
    other.write_text("1 1 2.0\n", encoding="ascii")
    refused("expected one format, found 5 and 3 numbers a line", mass, other, deck_path)
    refused("expected rows and columns from 1 to 3 .1 nodes., found 9 to 9: give `dofs`", *far(tmp_path))
    other.write_text("1, 2.0\n", encoding="ascii")
    refused("expected lines of node, direction", mass, other, deck_path)
    other.write_text(stiffness.read_text() + "8,1, 8,1, 1e36\n", encoding="ascii")
    refused("expected a body without supports", mass, other, deck_path)
    other.write_text("*Heading\n", encoding="ascii")
    refused("expected nodes .*NODE., found none", mass, stiffness, other)


def far(folder):
    """Files whose rows are more than the nodes have."""
    path = folder / "far.mtx"
    path.write_text("9 9 2.0\n", encoding="ascii")
    return path, path, {1: [0.0, 0.0, 0.0]}


def test_files_of_calculix_that_do_not_fit_are_refused(tmp_path):
    (tmp_path / "job.inp").write_text("*NODE\n10, 0, 0, 0\n", encoding="ascii")
    with pytest.raises(flexbody.Error, match=r"job.sti: expected the file that \*FREQUENCY"):
        read_calculix(tmp_path / "job", units="mm-t-s")
    for extension in (".sti", ".mas"):
        (tmp_path / f"job{extension}").write_text("1 1 1.0\n4 4 2.0\n", encoding="ascii")
    (tmp_path / "job.dof").write_text("10.1\n10.2\n10.3\n", encoding="ascii")
    with pytest.raises(flexbody.Error, match="expected rows and columns from 1 to 3, found up to 4"):
        read_calculix(tmp_path / "job", units="mm-t-s")
    (tmp_path / "job.dof").write_text("10.1\n10.2\n10.3\n20.1\n", encoding="ascii")
    with pytest.raises(flexbody.Error, match=r"1 are missing, such as \[20\]"):
        read_calculix(tmp_path / "job", units="mm-t-s")


def test_matrix_market_is_read(solid, tmp_path):
    model = solid.model
    for name, matrix in [("mass", model.mass), ("stiffness", model.stiffness)]:
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", sparse.coo_array(matrix), symmetry="symmetric")
    files = tmp_path / "mass.mtx", tmp_path / "stiffness.mtx"
    read = read_matrix_market(*files, model.nodes, units="m-kg-s", dofs=model.dofs)
    expected = model.reduce({"left": [0, 1, 2]}, modes=3)
    assert read.reduce({"left": [0, 1, 2]}, modes=3).eigenvalues == pytest.approx(expected.eigenvalues, rel=1e-9)
    files[0].write_text("1 2 3\n", encoding="ascii")
    with pytest.raises(flexbody.Error, match="mass.mtx: expected a file of Matrix Market"):
        read_matrix_market(*files, model.nodes, units="m-kg-s")


def test_bases_of_scikit_fem_that_are_no_solids_are_refused():
    mesh = MeshTet()
    with pytest.raises(flexbody.Error, match="basis: expected"):
        nodes_and_dofs(Basis(mesh, ElementTetP1()))
