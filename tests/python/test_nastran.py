"""Models of Nastran, in files that pyNastran writes; the answers are known from closed forms and from scipy."""

import math
import struct
import sys
import warnings

import flexbody
import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse
from finite_elements import FREE_ROD, beam, bent_frame, block, free_frequencies
from flexbody.reduction import FiniteElementModel, Interface
from flexbody.reduction.readers import read_nastran, read_nastran_modes

pytest.importorskip("pyNastran", reason="pyNastran is not installed (tests/python/readers.txt)")

from pyNastran.bdf.bdf import BDF  # noqa: E402
from pyNastran.op2.op2 import OP2  # noqa: E402
from pyNastran.op2.tables.oug.oug_eigenvectors import RealEigenvectorArray  # noqa: E402
from pyNastran.op4.op4 import write_op4  # noqa: E402

NOTHING = {"first": Interface([0], held="nothing")}
# Number of the first node; the others follow in steps of three.
FIRST = 11
# Forms of DMIG entries.
SQUARE, SYMMETRIC = 1, 6


def number(node):
    return FIRST + 3 * int(node)


def write_bulk(path, model, systems=(), scalars=()):
    """Bulk data with the nodes of a model; displacements of node k are in the system `systems[k]`."""
    deck = BDF(debug=None)
    # Origin, a point on the z axis and a point in the xz plane.
    places = [[0.05, -0.3, 0.01], [0.1, -0.32, 1.0], [1.0, -0.1, 0.02]]
    deck.add_cord2r(1, *places)
    deck.add_cord2c(2, *places)
    deck.add_cord2s(3, *places)
    for node, place in enumerate(model.nodes):
        system = systems[node] if node < len(systems) else 0
        deck.add_grid(number(node), place, cd=system)
    if scalars:
        deck.add_spoint(list(scalars))
    deck.write_bdf(path, size=16, is_double=True)
    return path


def local_axes(place, system):
    """Axes of displacements as columns: the definition of the systems of `write_bulk`, by hand."""
    origin, on_axis, in_plane = np.array([[0.05, -0.3, 0.01], [0.1, -0.32, 1.0], [1.0, -0.1, 0.02]])
    z = (on_axis - origin) / np.linalg.norm(on_axis - origin)
    y = np.cross(z, in_plane - origin)
    y /= np.linalg.norm(y)
    if system == 1:
        return np.column_stack([np.cross(y, z), y, z])
    arm = place - origin
    around = np.cross(z, arm)
    around /= np.linalg.norm(around)
    if system == 2:
        return np.column_stack([np.cross(around, z), around, z])
    outward = arm / np.linalg.norm(arm)
    return np.column_stack([outward, np.cross(around, outward), around])


def to_local(model, systems):
    """Matrix from displacements in the systems of the nodes to those along the axes of the model."""
    turn = np.eye(model.mass.shape[0])
    dofs = directions(model)
    for node, system in enumerate(systems):
        for first in (0, 3):
            own = np.flatnonzero((dofs[:, 0] == node) & (dofs[:, 1] // 3 == first // 3))
            if system and len(own):
                turn[np.ix_(own, own)] = local_axes(model.nodes[node], system)
    return turn


def directions(model):
    if model.dofs is not None:
        return np.asarray(model.dofs)
    count = len(model.nodes)
    return np.column_stack([np.repeat(np.arange(count), 3), np.tile(np.arange(3), count)])


def write_dmig(path, matrices, points, form=SYMMETRIC):
    """A punch file with DMIG entries; points: number and direction of each row."""
    deck = BDF(debug=None)
    for name, matrix in matrices.items():
        part = sparse.coo_array(sparse.tril(matrix) if form == SYMMETRIC else matrix)
        # Entries of a column stand together.
        order = np.lexsort((part.row, part.col))
        ends = [[tuple(int(value) for value in points[row]) for row in end[order]] for end in (part.col, part.row)]
        deck.add_dmig(name, form, 2, 0, 0, len(points) if form != SYMMETRIC else None, *ends, part.data[order].tolist())
    deck.write_bdf(path, size=16, is_double=True)
    return path


def points_of(model):
    return [(number(node), direction + 1) for node, direction in directions(model)]


@pytest.mark.parametrize("form", [SQUARE, SYMMETRIC])
@pytest.mark.parametrize("systems", [(), (1, 2, 3, 0, 3, 2, 1)])
def test_dmig_entries_are_the_matrices_of_the_model(tmp_path, form, systems):
    """Frequencies are those of scipy; displacements along axes of other systems are turned back."""
    model = block()
    turn = to_local(model, systems)
    matrices = {"MAAX": turn.T @ model.mass @ turn, "KAAX": turn.T @ model.stiffness @ turn}
    files = [
        write_bulk(tmp_path / "bar.bdf", model, systems),
        write_dmig(
            tmp_path / "bar.pch",
            {name: sparse.csc_array(one) for name, one in matrices.items()},
            points_of(model),
            form,
        ),
    ]
    found = read_nastran(files, units="m-kg-s")
    assert found.labels.tolist() == [number(node) for node in range(len(model.nodes))]
    assert found.nodes == pytest.approx(model.nodes, abs=1e-12)
    assert found.dofs.tolist() == directions(model).tolist()
    for name in ("mass", "stiffness"):
        expected = getattr(model, name).toarray()
        # Fields of sixteen characters have ten digits.
        assert getattr(found, name).toarray() == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())
    body = found.reduce(NOTHING, modes=6)
    assert body.frequencies == pytest.approx(free_frequencies(found)[:6], rel=1e-9)
    assert body.frequencies == pytest.approx(free_frequencies(model)[:6], rel=1e-6)
    assert body.source == "Nastran: bar.bdf, bar.pch"
    assert body.interfaces["first"].position == pytest.approx(model.nodes[0])


def test_a_uniform_rod_has_the_frequencies_of_its_closed_form(tmp_path):
    """Roots of cos b cosh b = 1, in millimetres and tonnes; rotations are degrees of freedom 4 to 6."""
    length, width, height, modulus, density = 1.3, 0.02, 0.01, 2e11, 7800.0
    model = beam(24)
    scale = sparse.diags_array(np.where(model.dofs[:, 1] < 3, 1e-3, 1.0))
    # N mm and t mm^2 by mm and radians.
    matrices = {"KAAX": scale @ model.stiffness @ scale * 1e3, "MAAX": scale @ model.mass @ scale * 1e3}
    points = points_of(model)
    model.nodes = 1e3 * model.nodes
    files = [write_bulk(tmp_path / "rod.bdf", model), write_dmig(tmp_path / "rod.pch", matrices, points)]
    body = read_nastran(files, units="mm-t-s").reduce(NOTHING, modes=14)
    sides = [
        FREE_ROD**2 * math.sqrt(modulus / (12 * density)) * side / (2 * math.pi * length**2) for side in (width, height)
    ]
    expected = np.sort(np.concatenate(sides))
    assert body.frequencies[:2] == pytest.approx(expected[:2], rel=1e-5)
    assert body.frequencies[:4] == pytest.approx(expected[:4], rel=1e-4)
    assert body.mass == pytest.approx(density * length * width * height)
    # Ten digits of a stiffness whose axial part is a million times that of bending.
    assert body.frequencies[:10] == pytest.approx(free_frequencies(beam(24))[:10], rel=1e-5)


def all_directions(model, order):
    """Matrices of the g-set: six rows a node in order of numbers, and where the nodes of the model are."""
    rows = [6 * order.index(number(node)) + direction for node, direction in directions(model)]
    size = 6 * len(order)
    chosen = sparse.coo_array((np.ones(len(rows)), (rows, np.arange(len(rows)))), shape=(size, len(rows))).tocsc()
    return [sparse.coo_matrix(chosen @ matrix @ chosen.T) for matrix in (model.mass, model.stiffness)]


def write_binary_op4(path, matrices, dense=True):
    """A binary OP4 file, record by record; pyNastran 1.4.1 writes such files wrongly and reads those of Nastran."""

    def record(*parts):
        data = b"".join(parts)
        return struct.pack("<i", len(data)) + data + struct.pack("<i", len(data))

    content = b""
    for name, matrix in matrices.items():
        size = matrix.shape[0]
        # Type 2: real numbers of two words.
        content += record(struct.pack("<4i8s", size, size, SYMMETRIC, 2, f"{name:8}".encode()))
        for index, column in enumerate(np.asarray(matrix).T):
            rows = np.flatnonzero(column)
            if not len(rows):
                continue
            if dense:
                values = column[rows[0] : rows[-1] + 1]
                head = struct.pack("<3i", index + 1, rows[0] + 1, 2 * len(values))
                content += record(head, values.astype("<f8").tobytes())
                continue
            strings, words = b"", 0
            for run in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1):
                length = 2 * len(run)
                strings += struct.pack("<i", run[0] + 1 + 65536 * (length + 1)) + column[run].astype("<f8").tobytes()
                words += length + 1
            content += record(struct.pack("<3i", index + 1, 0, words), strings)
        content += record(struct.pack("<3i", size + 1, 1, 2), struct.pack("<d", 1.0))
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("dense", [True, False])
def test_op4_matrices_of_all_points_are_read(tmp_path, binary, dense):
    model = block()
    order = [number(node) for node in range(len(model.nodes))]
    matrices = dict(zip(("MGG", "KGG"), all_directions(model, order), strict=True))
    full = {name: matrix.toarray() for name, matrix in matrices.items()}
    if binary:
        write_binary_op4(tmp_path / "bar.op4", full, dense)
    else:
        given = full if dense else matrices
        write_op4(tmp_path / "bar.op4", {name: (SYMMETRIC, one) for name, one in given.items()}, is_binary=False)
    bulk = write_bulk(tmp_path / "bar.bdf", model)
    found = read_nastran(bulk, matrices=tmp_path / "bar.op4", units="m-kg-s")
    # Rotations of solids have neither mass nor stiffness.
    assert found.dofs.tolist() == directions(model).tolist()
    assert found.reduce(NOTHING, modes=6).frequencies == pytest.approx(free_frequencies(model)[:6], rel=1e-9)
    with pytest.raises(flexbody.Error, match="bar.op4: expected the matrix MAA, found KGG, MGG"):
        read_nastran(bulk, matrices=tmp_path / "bar.op4", mass="MAA", units="m-kg-s")


def superelement(model, boundary, count):
    """Matrices of Craig and Bampton: rows of boundary nodes, then amplitudes of natural modes with these held."""
    dofs = directions(model)
    outer = np.flatnonzero(np.isin(dofs[:, 0], boundary))
    inner = np.setdiff1d(np.arange(len(dofs)), outer)
    mass, stiffness = model.mass.toarray(), model.stiffness.toarray()
    _, held = scipy.linalg.eigh(stiffness[np.ix_(inner, inner)], mass[np.ix_(inner, inner)])
    basis = np.zeros((len(dofs), len(outer) + count))
    basis[outer, np.arange(len(outer))] = 1
    basis[inner, : len(outer)] = -np.linalg.solve(stiffness[np.ix_(inner, inner)], stiffness[np.ix_(inner, outer)])
    basis[inner, len(outer) :] = held[:, :count]
    return dofs[outer], [basis.T @ matrix @ basis for matrix in (mass, stiffness)]


@pytest.mark.parametrize("form", ["DMIG", "OP4"])
def test_a_superelement_keeps_its_inner_modes_and_is_warned_of(tmp_path, form):
    """With all inner modes it is the model itself; rows of OP4 are those of EXTRN entries."""
    model = beam(6)
    outer, (mass, stiffness) = superelement(model, [0, 6], 30)
    ends = FiniteElementModel(mass, stiffness, model.nodes[[0, 6]], None)
    scalars = range(101, 131)
    points = [(number(node // 6), direction + 1) for node, direction in outer] + [(one, 0) for one in scalars]
    bulk = tmp_path / "se.bdf"
    write_bulk(bulk, ends, scalars=scalars)
    if form == "DMIG":
        files, matrices = [bulk, tmp_path / "se.pch"], None
        write_dmig(files[1], {"MAAX": sparse.csc_array(mass), "KAAX": sparse.csc_array(stiffness)}, points)
    else:
        # The second node comes first.
        order = np.concatenate([np.arange(6, 12), np.arange(6), np.arange(12, 42)])
        mass, stiffness = mass[np.ix_(order, order)], stiffness[np.ix_(order, order)]
        first = "".join(f"{one:8d}       0" for one in scalars[:2])
        lines = [f"EXTRN   {number(1):8d}  123456{number(0):8d}  123456{first}"]
        rest = [*scalars][2:]
        for first in range(0, len(rest), 4):
            lines.append(" " * 8 + "".join(f"{one:8d}{0:8d}" for one in rest[first : first + 4]))
        text = bulk.read_text(encoding="utf-8")
        bulk.write_text("BEGIN SUPER     111\n" + "\n".join(lines) + "\n" + text, encoding="utf-8")
        files, matrices = bulk, tmp_path / "se.op4"
        write_binary_op4(matrices, {"MAA": mass, "KAA": stiffness})
    names = {} if form == "DMIG" else {"mass": "MAA", "stiffness": "KAA"}
    found = read_nastran(files, matrices=matrices, units="m-kg-s", **names)
    assert (found.dofs == -1).all(axis=1).sum() == 30
    with pytest.warns(flexbody.FlexbodyWarning, match="30 of 42 are amplitudes of inner modes"):
        body = found.reduce({"root": Interface(0, held="frame"), "tip": Interface(1, held="frame")}, modes=10)
    whole = model.reduce({"root": Interface(0, held="frame"), "tip": Interface(6, held="frame")}, modes=10)
    assert body.frequencies == pytest.approx(whole.frequencies, rel=1e-9 if form == "OP4" else 1e-6)
    for part in ("mass", "centre", "inertia"):
        assert getattr(body, part) == pytest.approx(getattr(whole, part), rel=1e-9, abs=1e-12)
    tip, expected = body.interfaces["tip"], whole.interfaces["tip"]
    assert np.abs(tip.modes) == pytest.approx(np.abs(expected.modes), abs=1e-5 * np.abs(expected.modes).max())
    # Inner modes alone carry most of what the first modes lack here: J2 is not that of the whole model.
    assert np.abs(body.inertia_2 - whole.inertia_2).max() > 1e-3 * np.abs(whole.inertia_2).max()


def write_modes(path, model, values, shapes, systems=(), table="OUGV1"):
    """An OP2 file with modes in the systems of the nodes, in single precision as Nastran writes them."""
    dofs = directions(model)
    local = to_local(model, systems).T @ shapes
    data = np.zeros((len(values), len(model.nodes), 6), np.float32)
    data[:, dofs[:, 0], dofs[:, 1]] = local.T
    grids = np.array([[number(node), 1] for node in range(len(model.nodes))], np.int32)
    given = np.arange(1, len(values) + 1), values.astype(np.float32), np.sqrt(np.abs(values)).astype(np.float32)
    result = RealEigenvectorArray.add_modal_case(table, grids, data, 1, *given)
    # Code of a table of eigenvectors.
    result.table_code = result.data_code["table_code"] = 7
    results = OP2(debug=None)
    results.set_mode("msc")
    results.eigenvectors[1] = result
    results.write_op2(str(path), post=-1, endian=b"<", nastran_format="msc")
    return path


@pytest.mark.parametrize(("systems", "table"), [((), "OUGV1"), ((1, 2, 3, 0, 3, 2, 1), "OUGV1"), ((1, 2, 3), "BOUGV1")])
def test_modes_of_op2_make_the_same_body(tmp_path, systems, table):
    """With the mass of the model they are those of a reduction; OP2 has seven digits."""
    model = block()
    values, shapes = scipy.linalg.eigh(model.stiffness.toarray(), model.mass.toarray())
    modes = write_modes(
        tmp_path / "bar.op2", model, values[:14], 3.0 * shapes[:, :14], () if table[0] == "B" else systems, table
    )
    turn = to_local(model, systems)
    files = [
        write_bulk(tmp_path / "bar.bdf", model, systems),
        write_dmig(tmp_path / "bar.pch", {"MAAX": sparse.csc_array(turn.T @ model.mass @ turn)}, points_of(model)),
    ]
    found = read_nastran_modes(modes, files, units="m-kg-s")
    corner = {"last": Interface([15], held="nothing")}
    body, expected = found.reduce(corner), model.reduce(corner, modes=8)
    assert found.indices([number(15)]).tolist() == [15]
    assert body.frequencies == pytest.approx(expected.frequencies, rel=2e-7)
    for part in ("mass", "centre", "inertia", "inertia_1", "inertia_2", "coupling"):
        wanted = np.asarray(getattr(expected, part))
        assert np.asarray(getattr(body, part)) == pytest.approx(wanted, abs=1e-5 * np.abs(wanted).max()), part
    wanted = expected.interfaces["last"].modes
    assert body.interfaces["last"].modes == pytest.approx(wanted, abs=1e-5 * np.abs(wanted).max())
    assert found.reduce(corner, modes=3).frequencies == pytest.approx(expected.frequencies[:3], rel=2e-7)


def test_rotations_without_mass_are_part_of_modes(tmp_path):
    """Lumped masses: the mass has no rows of rotations, and an interface of one node has its rotation all the same."""
    frame = bent_frame()
    # The inverse problem: the mass is singular.
    shift = 1e3
    values, shapes = scipy.linalg.eigh(frame.mass.toarray(), (frame.stiffness + shift * frame.mass).toarray())
    values, shapes = 1 / values[:-13:-1] - shift, shapes[:, :-13:-1]
    modes = write_modes(tmp_path / "frame.op2", frame, values, shapes, [1, 2])
    order = [number(node) for node in range(len(frame.nodes))]
    mass, _ = all_directions(frame, order)
    write_binary_op4(tmp_path / "frame.op4", {"MGG": mass.toarray()})
    bulk = write_bulk(tmp_path / "frame.bdf", frame, [1, 2])
    end = {"end": Interface([0], held="nothing")}
    found = read_nastran_modes(modes, bulk, matrices=tmp_path / "frame.op4", units="m-kg-s").reduce(end)
    expected = frame.reduce(end, modes=6)
    assert found.frequencies == pytest.approx(expected.frequencies, rel=1e-5)
    signs = np.sign(np.einsum("ak,ak->k", found.interfaces["end"].modes, expected.interfaces["end"].modes))
    wanted = expected.interfaces["end"].rotation
    assert found.interfaces["end"].rotation * signs == pytest.approx(wanted, abs=1e-4 * np.abs(wanted).max())


def test_modes_that_are_not_those_of_the_free_body_are_refused(tmp_path):
    model = block()
    bulk = write_bulk(tmp_path / "bar.bdf", model)
    values, shapes = scipy.linalg.eigh(model.stiffness.toarray(), model.mass.toarray())
    modes = write_modes(tmp_path / "bar.op2", model, values[:9], shapes[:, :9])
    # Masses of another mesh: the first node is heavy.
    heavy = np.repeat(np.where(np.arange(len(model.nodes)) == 0, 2.0, 1.0), 3)
    other = sparse.diags_array(heavy) @ model.mass @ sparse.diags_array(heavy)
    wrong = write_dmig(tmp_path / "wrong.pch", {"MAAX": sparse.csc_array(other)}, points_of(model))
    with pytest.raises(flexbody.Error, match="modes: expected modes of a free body, found that mode"):
        read_nastran_modes(modes, [bulk, wrong], units="m-kg-s").reduce(NOTHING)
    right = write_dmig(tmp_path / "right.pch", {"MAAX": model.mass}, points_of(model))
    found = read_nastran_modes(modes, [bulk, right], units="m-kg-s")
    with pytest.raises(flexbody.Error, match="modes: expected 1 to 3 modes, found 4"):
        found.reduce(NOTHING, modes=4)
    with pytest.raises(flexbody.Error, match="expected mean, because modes are given; found 'rigid'"):
        found.reduce({"face": Interface([0, 1, 2], kind="rigid")})
    mixed = np.array(found.modes)
    mixed[:, 7] += 0.1 * mixed[:, 8]
    found.modes = mixed
    with pytest.raises(flexbody.Error, match="orthogonal in the mass, found 0.0995 between the modes 8 and 9"):
        found.reduce(NOTHING)
    with pytest.raises(flexbody.Error, match="expected eigenvectors of the subcase 2, found those of"):
        read_nastran_modes(modes, [bulk, right], subcase=2, units="m-kg-s")
    (tmp_path / "text.op2").write_text("no results", encoding="ascii")
    with pytest.raises(flexbody.Error, match="text.op2: expected an OP2 file, found"):
        read_nastran_modes(tmp_path / "text.op2", [bulk, right], units="m-kg-s")


def test_files_that_do_not_fit_are_refused(tmp_path):
    model = block()
    bulk = write_bulk(tmp_path / "bar.bdf", model, [2])
    points = points_of(model)

    def refused(message, paths, **options):
        with pytest.raises(flexbody.Error, match=message):
            read_nastran(paths, **{"units": "m-kg-s", **options})

    refused("none.bdf: expected a file of bulk data, found none", tmp_path / "none.bdf")
    (tmp_path / "empty.bdf").write_text("$ nothing\n", encoding="ascii")
    refused("empty.bdf: expected nodes .GRID., found none", tmp_path / "empty.bdf")
    (tmp_path / "words.bdf").write_text("GRID,one,,0.,0.,0.\n", encoding="ascii")
    refused("words.bdf: expected bulk data of Nastran, found", tmp_path / "words.bdf")
    refused("bar.bdf: expected the DMIG matrix MAAX, found none", bulk)
    only = write_dmig(tmp_path / "only.pch", {"MAAX": model.mass}, points)
    refused("expected the DMIG matrix KAAX, found MAAX", [bulk, only])
    # The first node has a cylindrical system: its three translations belong together.
    part = sparse.csc_array(model.mass)[1:, 1:]
    some = write_dmig(tmp_path / "some.pch", {"MAAX": part, "KAAX": part}, points[1:])
    refused("node 11: expected all three translations in the matrices, .* .CD., found some", [bulk, some])
    strange = write_dmig(
        tmp_path / "strange.pch", {"MAAX": model.mass, "KAAX": model.mass}, [(one + 1, way) for one, way in points]
    )
    refused("expected matrices of the nodes of bar.bdf, strange.pch; 16 are none, such as", [bulk, strange])
    write_binary_op4(tmp_path / "bar.op4", {"MGG": model.mass.toarray()})
    refused(
        r"MGG: expected 96 rows and columns, those of the points in order, found \[48, 48\]",
        bulk,
        matrices=tmp_path / "bar.op4",
    )
    refused("no.op4: expected an OP4 file, found none", bulk, matrices=tmp_path / "no.op4")
    axis = BDF(debug=None)
    axis.add_cord2c(2, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    axis.add_grid(7, [0.0, 0.0, 3.0], cd=2)
    axis.write_bdf(tmp_path / "axis.bdf")
    refused("node 7: expected a node beside the axis of the coordinate system 2, found it on it", tmp_path / "axis.bdf")


def test_rigid_elements_beside_matrices_of_all_points_are_warned_of(tmp_path):
    model = block()
    order = [number(node) for node in range(len(model.nodes))]
    matrices = dict(zip(("MGG", "KGG"), all_directions(model, order), strict=True))
    write_binary_op4(tmp_path / "bar.op4", {name: one.toarray() for name, one in matrices.items()})
    bulk = write_bulk(tmp_path / "bar.bdf", model)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_nastran(bulk, matrices=tmp_path / "bar.op4", units="m-kg-s")
    text = bulk.read_text(encoding="utf-8")
    bulk.write_text(text + f"RBE2,900,{number(0)},123456,{number(1)},{number(2)}\n", encoding="utf-8")
    with pytest.warns(flexbody.FlexbodyWarning, match="bar.bdf: RBE2 are not part of the matrices MGG and KGG"):
        read_nastran(bulk, matrices=tmp_path / "bar.op4", units="m-kg-s")


def test_who_reads_nastran_without_its_reader_is_told_what_to_install(tmp_path, monkeypatch):
    (tmp_path / "bar.bdf").write_text("GRID,1,,0.,0.,0.\n", encoding="ascii")
    monkeypatch.setitem(sys.modules, "pyNastran.bdf.bdf", None)
    with pytest.raises(ImportError, match=r'pip install "flexbody\[nastran\]"'):
        read_nastran(tmp_path / "bar.bdf", units="m-kg-s")
