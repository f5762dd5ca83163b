"""Standard input data of flexible bodies: bodies of our own as files in other frames, and back to the same arrays."""

import flexbody
import numpy as np
import pytest
import scipy.sparse as sparse
from flexbody.reduction import Interface
from flexbody.reduction.interface import cross_matrix
from flexbody.reduction.readers import read_sid_fem
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex2, ElementVector, MeshHex

# Order of the components of a tensor in `J`, and of products of spins in `Oe` by the standard.
TENSOR = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
QUADRATIC = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]
TIP = "tip"


class Lumped:
    """A solid with lumped masses, reduced with all its nodes as interfaces: modes and displacements as arrays of nodes.

    nodes [p, 3] from the centre of mass, masses [p], modes [p, 3, n], second [p, 3, n, n], root and tip: indices.
    """

    def __init__(self, second_order):
        mesh = MeshHex.init_tensor(np.linspace(0, 0.2, 3), np.linspace(0, 0.03, 2), np.linspace(0, 0.01, 2))
        basis = Basis(mesh.translated((0.1, -0.2, 0.05)), ElementVector(ElementHex2()), intorder=4)
        solid = Solid(basis, youngs_modulus=2e9, poissons_ratio=0.3, density=1500)
        model = solid.model
        order = np.lexsort((model.dofs[:, 1], model.dofs[:, 0]))
        count = len(model.nodes)
        self.masses = np.random.default_rng(3).uniform(0.5, 1.5, count) * 1e-3
        self.root = np.flatnonzero(model.nodes[:, 0] < 0.1001)
        self.tip = int(np.argmax(model.nodes.sum(axis=1)))

        def force(displacements):
            given = np.empty_like(displacements)
            given[order] = displacements
            return solid.quadratic_force(given)[order]

        every = {f"n{node}": Interface(node, held="nothing") for node in range(count)}
        self.body = flexbody.reduce(
            sparse.diags_array(np.repeat(self.masses, 3)),
            sparse.csc_array(model.stiffness)[order][:, order],
            model.nodes,
            {"root": self.root, **every},
            modes=3,
            quadratic_force=force if second_order else None,
        )
        size = len(self.body.eigenvalues)
        self.nodes = model.nodes - self.body.centre
        self.modes = np.array([self.body.interfaces[name].modes for name in every])
        self.second = np.zeros((count, 3, size, size))
        if second_order:
            self.second += np.array([self.body.interfaces[name].second for name in every])
        self.rotations = self.body.interfaces["root"].rotation


def combined(modes, second, combination):
    """Modes and second-order displacements of other amplitudes."""
    return modes @ combination, np.einsum("pakl,km,ln->pamn", second, combination, combination)


def combination_of(size):
    """Amplitudes of no meaning: combinations of the modes, of sizes from a tenth to ten."""
    random = np.random.default_rng(7)
    return random.standard_normal((size, size)) * 10.0 ** random.uniform(-1, 1, size)


def in_linear_frame(lumped):
    """Nodes and modes in the frame of the root: no displacement and no rotation there, to first order."""
    origin = lumped.nodes[lumped.root].mean(axis=0)
    modes = lumped.modes - lumped.modes[lumped.root].mean(axis=0)
    modes = modes - np.cross(lumped.rotations.T[None], (lumped.nodes - origin)[:, None]).transpose(0, 2, 1)
    return lumped.nodes - origin, modes, np.zeros_like(lumped.second)


def in_nonlinear_frame(lumped):
    """Nodes, modes and second-order displacements in a frame that rotates with three nodes, by differentiation."""
    corners = lumped.root[[0, 3, 5]]
    size = lumped.modes.shape[2]

    def axes(at):
        first, second = at[corners[1]] - at[corners[0]], at[corners[2]] - at[corners[0]]
        x = first / np.sqrt(first @ first)
        z = np.cross(x, second)
        z = z / np.sqrt(z @ z)
        return np.column_stack([x, np.cross(z, x), z])

    def seen(amplitudes):
        at = lumped.nodes + lumped.modes @ amplitudes + lumped.second @ amplitudes @ amplitudes / 2
        return (at - at[corners[0]]) @ axes(at) @ axes(lumped.nodes).T

    def slope(amplitudes, mode):
        # Complex steps have no cancellation.
        return seen(amplitudes + 1e-30j * np.eye(size)[mode]).imag / 1e-30

    modes = np.stack([slope(np.zeros(size), mode) for mode in range(size)], axis=-1)
    second = np.zeros((*modes.shape, size))
    for k in range(size):
        step = 1e-3 * 0.01 / np.abs(modes[:, :, k]).max() * np.eye(size)[k]
        for other in range(size):
            one, two = ((slope(n * step, other) - slope(-n * step, other)) / (2 * n * step[k]) for n in (1, 2))
            second[:, :, other, k] = (4 * one - two) / 3
    return seen(np.zeros(size)), modes, (second + second.transpose(0, 1, 3, 2)) / 2


def arrays(nodes, masses, modes, second):
    """Matrices of standard input data as sums over the nodes: constant, and by modes [rows, modes, columns]."""
    size = modes.shape[2]
    sums = {}
    sums["mdCM"] = (masses @ nodes)[:, None], np.einsum("p,pak->ak", masses, modes)[:, :, None]
    moments = np.einsum("p,pa,pb->ab", masses, nodes, nodes)
    first = np.einsum("p,pak,pb->kab", masses, modes, nodes)
    turned = 2 * np.trace(first, axis1=1, axis2=2)[:, None, None] * np.eye(3) - first - first.transpose(0, 2, 1)
    sums["J"] = np.trace(moments) * np.eye(3) - moments, turned.transpose(1, 0, 2)
    sums["Ct"] = np.einsum("p,pak->ka", masses, modes), np.einsum("p,pakl->kla", masses, second)
    crossed = np.cross(nodes[:, None], modes.transpose(0, 2, 1))
    each = modes.transpose(0, 2, 1)
    pairs = np.cross(each[:, None], each[:, :, None])
    by_second = np.cross(nodes[:, None, None], second.transpose(0, 2, 3, 1))
    sums["Cr"] = np.einsum("p,pka->ka", masses, crossed), np.einsum("p,pkla->kla", masses, pairs + by_second)
    sums["Me"] = np.einsum("p,pak,pal->kl", masses, modes, modes), None
    gyroscopic = [2 * np.trace(one) * np.eye(3) - 2 * one for one in first]
    sums["Gr"] = np.hstack(gyroscopic), None
    coriolis = 2 * np.einsum("p,pkla->kla", masses, pairs)
    sums["Ge"] = coriolis.reshape(size, -1), None
    # Centripetal accelerations w x (w x r) by products of spins.
    quadratic = np.zeros((6, 3, 3))
    for at, (row, column) in enumerate(QUADRATIC):
        one, other = cross_matrix(np.eye(3)[row]), cross_matrix(np.eye(3)[column])
        quadratic[at] = one @ other if row == column else one @ other + other @ one
    constant = np.einsum("p,pak,qab,pb->kq", masses, modes, quadratic, nodes)
    by_modes = np.einsum("p,pak,qab,pbl->klq", masses, modes, quadratic, modes)
    by_modes = by_modes + np.einsum("p,pakl,qab,pb->klq", masses, second, quadratic, nodes)
    sums["Oe"] = constant, by_modes
    return sums


def taylor(name, zeroth, first, modes, structure=3):
    """Text of a matrix."""
    order = 0 if first is None else 1
    sizes = {"order": order, "nrow": zeroth.shape[0], "ncol": zeroth.shape[1], "nq": modes, "nqn": 0}
    lines = [f"{name}", *(f"  {key:<22}= {value:4d}" for key, value in {**sizes, "structure": structure}.items())]
    for (row, column), value in np.ndenumerate(zeroth):
        if value != 0 and (structure != 2 or row <= column):
            lines.append(f"  m0( {row + 1}, {column + 1})   ={value:22.15E}".replace("E", "D"))
    if first is not None:
        for (row, mode, column), value in np.ndenumerate(first):
            if value != 0 and (structure != 2 or row <= column):
                lines.append(f"  m1( {row + 1}, {mode + 1}, {column + 1})   ={value:22.15E}".replace("E", "D"))
    return [*lines, f"end {name}"]


def write(path, lumped, frame, second_order, combination, changes=None, layout="standard"):
    """A file of standard input data with two nodes: 11 is the first of the root, 23 the tip."""
    nodes, modes, second = frame(lumped)
    modes, second = combined(modes, second, combination)
    size = modes.shape[2]
    sums = arrays(nodes, lumped.masses, modes, second)
    sums["ksigma"] = np.zeros((size, 1)), None
    sums["Ke"] = combination.T @ np.diag(lumped.body.eigenvalues) @ combination, None
    if layout == "other":
        # J with six rows, Oe with xz before yz and not symmetric in the modes, Ge by axes.
        inertia, inertia_1 = sums["J"]
        rows, columns = zip(*TENSOR, strict=True)
        sums["J"] = inertia[rows, columns][:, None], inertia_1.transpose(0, 2, 1)[rows, columns][:, :, None]
        constant, by_modes = (part[..., [0, 1, 2, 3, 5, 4]] for part in sums["Oe"])
        skew = np.random.default_rng(1).standard_normal(by_modes.shape)
        sums["Oe"] = constant, by_modes + skew - skew.transpose(1, 0, 2)
        coriolis = sums["Ge"][0].reshape(size, size, 3)
        sums["Ge"] = coriolis.transpose(0, 2, 1).reshape(size, -1), None
    sums.update(changes(sums) if changes else {})
    lines = [f"  2 {size} :No. nodes, No. modes: written by a test", "part", "new modal =", "refmod"]
    lines += [f"mass = {lumped.masses.sum():.15E}", f"nelastq = {size}"]
    lines += [f"ielastq ( {mode + 1}) = Eigen Mode {mode + 1} : 1.0 Hz" for mode in range(size)]
    lines += ["end refmod", "frame"]
    for number, node in ((11, lumped.root[0]), (23, lumped.tip)):
        lines += [f"new node = {number}", "rframe = body ref"]
        lines += taylor("origin", nodes[node][:, None], modes[node][:, :, None], size)
        stiffening = second[node].transpose(0, 2, 1) if second_order else None
        lines += taylor("phi", modes[node], stiffening, size)
        # The tip rotates by one about each axis in every mode, the root does not.
        lines += taylor("psi", np.full((3, size), float(number == 23)), None, size, 3 if number == 23 else 0)
        lines += taylor("AP", np.eye(3), None, size, 4)
        lines += ["end node"]
    lines.append("end frame")
    for name, (zeroth, first) in sums.items():
        if name == "Me" and np.abs(zeroth - np.eye(len(zeroth))).max() < 1e-9:
            lines += taylor(name, np.zeros_like(zeroth), None, size, 4)
            continue
        lines += taylor(name, zeroth, first, size, 2 if name == "Ke" else 3)
    path.write_text("\n".join([*lines, "end modal", "end part"]) + "\n", encoding="ascii")
    return path


def same(found, lumped, second_order, rel=1e-9):
    """The arrays are those of the body, but for the signs of modes."""
    expected = lumped.body
    assert found.mass == pytest.approx(expected.mass, rel=1e-12)
    assert found.inertia == pytest.approx(expected.inertia, rel=1e-9, abs=1e-12)
    assert found.eigenvalues == pytest.approx(expected.eigenvalues, rel=rel)
    tip = found.interfaces[TIP]
    wanted = lumped.modes[lumped.tip]
    signs = np.sign(np.einsum("ak,ak->k", tip.modes, wanted))
    pairs = signs[:, None] * signs
    compared = [
        (tip.position - found.centre, lumped.nodes[lumped.tip]),
        (tip.modes * signs, wanted),
        (found.inertia_1 * signs[:, None], expected.inertia_1),
        (found.inertia_2 * pairs[:, :, None], expected.inertia_2),
        (found.coupling * pairs[:, :, None], expected.coupling),
    ]
    if second_order:
        compared.append((tip.second * pairs, lumped.second[lumped.tip]))
        assert not found.cubic.any()
    else:
        assert tip.second is None and found.cubic is None
    for one, other in compared:
        assert one == pytest.approx(other, abs=rel * np.abs(other).max())
    return signs


@pytest.fixture(scope="module")
def linear():
    return Lumped(second_order=False)


@pytest.fixture(scope="module")
def stiffened():
    return Lumped(second_order=True)


@pytest.mark.parametrize("layout", ["standard", "other"])
def test_a_body_in_the_frame_of_its_root_comes_back(linear, tmp_path, layout):
    """Amplitudes of the file are combinations of the modes; its frame is held at the root."""
    size = len(linear.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, combination_of(size), layout=layout)
    found = read_sid_fem(path, {TIP: 23, "root": 11})
    same(found, linear, second_order=False)
    assert found.source == "SID_FEM: bar.SID_FEM"
    assert found.interfaces["root"].rotation is None
    found.save(tmp_path / "bar.safetensors")


def test_rotations_of_nodes_are_those_in_mean_axes(linear, tmp_path):
    """A node that rotates by one in every mode: its rotation less that of the mean axes in the frame of the root."""
    size = len(linear.body.eigenvalues)
    modes = in_linear_frame(linear)[1]
    # Modes of mass 1, as most writers have them.
    mass = np.einsum("p,pak,pal->kl", linear.masses, modes, modes)
    unit = np.linalg.inv(np.linalg.cholesky(mass)).T
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, unit)
    assert "structure             =    4" in path.read_text(encoding="ascii").split("Me", 1)[1]
    same(read_sid_fem(path, {TIP: 23}), linear, second_order=False)
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, np.eye(size))
    found = read_sid_fem(path, {TIP: 23})
    signs = same(found, linear, second_order=False)
    # Mean axes rotate in the frame of the root as much as the root rotates in them, the other way.
    expected = 1.0 + linear.rotations
    assert found.interfaces[TIP].rotation * signs == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


def test_geometric_stiffness_comes_back_as_second_order_displacements(stiffened, tmp_path):
    """The frame rotates with three nodes without limits: its second-order displacements follow by differentiation."""
    size = len(stiffened.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", stiffened, in_nonlinear_frame, True, combination_of(size))
    same(read_sid_fem(path, {TIP: 23}), stiffened, second_order=True, rel=1e-8)


def test_stiffening_of_accelerations_alone_is_known_at_the_integrals(stiffened, tmp_path):
    """Nodes without stiffening have the second-order displacements of the frame; integrals have all of it."""
    size = len(stiffened.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", stiffened, in_nonlinear_frame, False, np.eye(size))
    found = read_sid_fem(path, {TIP: 23})
    signs = np.sign(np.einsum("ak,ak->k", found.interfaces[TIP].modes, stiffened.modes[stiffened.tip]))
    pairs = signs[:, None] * signs
    expected = stiffened.body.inertia_2
    assert found.inertia_2 * pairs[:, :, None] == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())
    expected = stiffened.second[stiffened.tip] - in_nonlinear_frame(stiffened)[2][stiffened.tip]
    assert found.interfaces[TIP].second * pairs == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


def test_without_cr_of_order_1_the_coupling_is_that_of_ge(linear, tmp_path):
    size = len(linear.body.eigenvalues)
    for layout in ("standard", "other"):
        path = tmp_path / f"{layout}.SID_FEM"

        def changed(sums):
            return {"Cr": (sums["Cr"][0], None), "J": (sums["J"][0], None)}

        write(path, linear, in_linear_frame, False, combination_of(size), changed, layout)
        same(read_sid_fem(path, {TIP: 23}), linear, second_order=False)


def test_units_are_converted(stiffened, tmp_path):
    """The same numbers in mm, t and s: lengths a thousandth, masses a thousand times."""
    size = len(stiffened.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", stiffened, in_nonlinear_frame, True, np.eye(size))
    si, mm = read_sid_fem(path, {TIP: 23}), read_sid_fem(path, {TIP: 23}, units="mm-t-s")
    assert mm.mass == pytest.approx(1e3 * si.mass)
    assert mm.centre == pytest.approx(1e-3 * si.centre)
    assert mm.inertia == pytest.approx(1e-3 * si.inertia)
    # By amplitudes in sqrt(kg) m: mass times length over that.
    assert mm.inertia_1 == pytest.approx(1e-3 * si.inertia_1 / np.sqrt(1e-3), rel=1e-9, abs=1e-12)
    assert mm.eigenvalues == pytest.approx(si.eigenvalues, rel=1e-9)
    for part, factor in (("modes", 1e-3 / np.sqrt(1e-3)), ("second", 1.0)):
        wanted = factor * getattr(si.interfaces[TIP], part)
        assert getattr(mm.interfaces[TIP], part) == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())


def test_a_uniform_cantilever_has_the_frequencies_of_a_free_rod(tmp_path):
    """Modes of a clamped rod in the frame of its root, as most files have them, span nearly those of the free rod."""
    length, mass, rigidity, count = 3.0, 7.0, 11.0, 400
    roots = np.array([1.8751040687, 4.6940911330, 7.8547574382, 10.9955407349])
    along = (np.arange(count) + 0.5) / count
    shapes = []
    for root in roots:
        ratio = (np.cos(root) + np.cosh(root)) / (np.sin(root) + np.sinh(root))
        shapes.append(
            np.cosh(root * along) - np.cos(root * along) - ratio * (np.sinh(root * along) - np.sin(root * along))
        )

    class Rod:
        """Masses along x that are not on one line, and modes along z."""

        masses = np.full(2 * count, mass / (2 * count))
        nodes = np.column_stack([np.tile(along, 2) * length, np.repeat([-1e-3, 1e-3], count), np.zeros(2 * count)])
        modes = np.zeros((2 * count, 3, len(roots)))
        root = np.array([0, 1, count])
        tip = count - 1

    Rod.modes[:, 2] = np.tile(np.array(shapes).T, (2, 1))
    stiffness = rigidity * roots**4 / length**3
    Rod.body = type("Body", (), {"eigenvalues": stiffness})

    def frame(rod):
        return rod.nodes, rod.modes, np.zeros((*rod.modes.shape, len(roots)))

    path = write(tmp_path / "rod.SID_FEM", Rod, frame, False, np.eye(len(roots)))
    found = read_sid_fem(path, {TIP: 23})
    expected = np.array([4.730040745, 7.853204624]) ** 2 * np.sqrt(rigidity / (mass * length**3)) / (2 * np.pi)
    assert found.frequencies[:2] == pytest.approx(expected, rel=2e-2)
    assert (found.frequencies[:2] >= expected).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("nelastq", "modes"), "expected the number of modes .nelastq. .* found none"),
        (lambda text: text[: len(text) // 2], "line [0-9]+: expected end .*, found 'the end of the file'"),
        (lambda text: text.replace("m0( 1, 1)   =", "m0( 1, 1)   =x", 1), "line [0-9]+: expected a number, found"),
        (lambda text: text.replace("m0( 1, 1)", "m0( 9, 1)", 1), r"line [0-9]+: expected indices up to \[3, 3\]"),
        (
            lambda text: text.replace("m1( 1, 1, 1)", "m1( 1, 1)", 1),
            r"expected m0\(row, column\) or m1\(row, mode, column\)",
        ),
        (
            lambda text: text.replace("  order ", "  degree", 1),
            "expected order, nrow, ncol, nq and structure of origin",
        ),
        (lambda text: text.replace("body ref", "node 3", 1), "expected nodes in the frame `body ref`, found 'node 3'"),
        (lambda text: text.replace("\nOe", "\nOther", 1), "expected the matrix Oe, found mdCM"),
        (lambda text: text.replace("new node =", "new node = x", 1), "expected a whole number, found"),
    ],
)
def test_what_is_no_standard_input_data_is_refused(linear, tmp_path, change, message):
    size = len(linear.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, np.eye(size))
    path.write_text(change(path.read_text(encoding="ascii")), encoding="ascii")
    with pytest.raises(flexbody.Error, match="bar.SID_FEM: .*" + message):
        read_sid_fem(path, {TIP: 23})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (lambda sums: {"ksigma": (1.0 + sums["ksigma"][0], None)}, "ksigma: expected a body without initial stresses"),
        (lambda sums: {"Oe": (sums["Oe"][0], None)}, "Oe: expected order 1, found order 0"),
        (lambda sums: {"Oe": (1.1 * sums["Oe"][0], sums["Oe"][1])}, "Oe: expected centrifugal forces that are half"),
        (
            lambda sums: {"Ct": (10 * sums["Ct"][0], sums["Ct"][1])},
            "expected a positive mass of body and modes together",
        ),
        (lambda sums: {"Ke": (-sums["Ke"][0], None)}, "stiffness: expected a positive matrix"),
        (lambda sums: {"Me": (np.eye(2), None)}, "Me: expected [0-9]+ rows and [0-9]+ columns"),
        (lambda sums: {"mdCM": (10 * sums["mdCM"][0], None)}, "inertia: expected a positive tensor"),
        (
            lambda sums: {"Cr": (sums["Cr"][0], None), "Ge": (np.ones_like(sums["Ge"][0]), None)},
            "Ge: expected an array that is antisymmetric in the modes",
        ),
    ],
)
def test_integrals_that_contradict_each_other_are_refused(linear, tmp_path, changes, message):
    size = len(linear.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, np.eye(size), changes)
    with pytest.raises(flexbody.Error, match=message):
        read_sid_fem(path, {TIP: 23})


def test_nodes_that_are_not_there_are_named(linear, tmp_path):
    size = len(linear.body.eigenvalues)
    path = write(tmp_path / "bar.SID_FEM", linear, in_linear_frame, False, np.eye(size))
    with pytest.raises(flexbody.Error, match=r"expected the number of a node .11, 23., found 12"):
        read_sid_fem(path, {TIP: 12})
    with pytest.raises(flexbody.Error, match="expected a name of letters, digits and underscores, found 'the tip'"):
        read_sid_fem(path, {"the tip": 23})
    with pytest.raises(flexbody.Error, match="interfaces: expected numbers of nodes by name, found"):
        read_sid_fem(path, [23])
    with pytest.raises(flexbody.Error, match="none.SID_FEM: expected a file of standard input data, found none"):
        read_sid_fem(tmp_path / "none.SID_FEM", {TIP: 23})
