"""Reduced bodies against closed forms, sums over nodes, and frequencies found by other programs."""

import math
import re
import subprocess
import sys

import flexbody
import numpy as np
import pytest
import safetensors.numpy
import scipy.linalg
import scipy.sparse as sparse
from conftest import ROOT
from finite_elements import beam, bent_frame, tensor
from flexbody.reduction import Interface, ModalModel, ReducedBody
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex2, ElementVector, MeshHex

EXAMPLE = ROOT / "python" / "examples" / "reduced_bodies.py"
NOTHING = {"first": Interface([0], held="nothing")}


@pytest.fixture(scope="module")
def example():
    namespace = {"__name__": "reduced_bodies"}
    exec(compile(EXAMPLE.read_text(encoding="utf-8"), EXAMPLE, "exec"), namespace)
    return namespace


@pytest.fixture(scope="module")
def bracket(example):
    return example["bracket"](modes=6)


@pytest.fixture(scope="module")
def block():
    """A small solid away from the origin."""
    mesh = MeshHex.init_tensor(np.linspace(0, 0.2, 3), np.linspace(0, 0.03, 2), np.linspace(0, 0.01, 2))
    basis = Basis(mesh.translated((0.1, -0.2, 0.05)), ElementVector(ElementHex2()), intorder=4)
    return Solid(basis, youngs_modulus=2e9, poissons_ratio=0.3, density=1500)


@pytest.fixture(scope="module")
def ends(block):
    along = block.model.nodes[:, 0]
    return {"left": np.flatnonzero(along < 0.1001), "right": np.flatnonzero(along > 0.2999)}


def by_nodes(model):
    """Permutation of degrees of freedom to three a node, one node after the other."""
    return np.lexsort((model.dofs[:, 1], model.dofs[:, 0]))


def with_rows_of_nodes(model):
    """Mass and stiffness with three degrees of freedom a node, one node after the other."""
    order = by_nodes(model)
    return [sparse.csc_array(matrix)[order][:, order] for matrix in (model.mass, model.stiffness)]


def test_free_frequencies_are_those_of_the_solids(example):
    """The references are of another program on the same meshes: quadratic hexahedra, consistent mass."""
    for make, expected in [
        ("bracket", [26.443, 81.159, 167.69, 184.97, 246.51]),
        ("blade", [36.051, 100.23, 176.44, 199.04]),
    ]:
        found = example[make](interfaces=NOTHING, modes=6, quadratic_force=None).frequencies
        assert found[: len(expected)] == pytest.approx(expected, rel=6e-5)


def test_free_frequencies_of_a_uniform_rod():
    """Roots of cos b cosh b = 1 for bending towards both sides, c / (2 l) for tension and torsion."""
    length, width, height, modulus, density = 1.3, 0.02, 0.01, 2e11, 7800.0
    found = beam(40).reduce(NOTHING, modes=14).frequencies
    roots = np.array([4.730040745, 7.853204624, 10.995607838, 14.137165491, 17.278759657, 20.420352251])
    bending = [
        roots**2 * math.sqrt(modulus / (12 * density)) * side / (2 * math.pi * length**2) for side in (width, height)
    ]
    axial = np.array([1, 2]) * math.sqrt(modulus / density) / (2 * length)
    torsion = np.array([1, 2]) * math.sqrt(modulus / 2.6 / density) / (2 * length)
    expected = np.sort(np.concatenate([*bending, axial, torsion]))
    # The next root of the flat side lies above the fourteen.
    assert found[:10] == pytest.approx(expected[:10], rel=1.5e-3)
    assert found[:4] == pytest.approx(expected[:4], rel=1e-5)


def test_a_cantilever_bends_under_a_force_at_its_tip_as_in_closed_form():
    """Static shapes of what is held and loaded make this exact without any natural mode."""
    length, width, height, modulus = 1.3, 0.02, 0.01, 2e11
    model = beam(6)
    interfaces = {"root": Interface(0, held="frame"), "tip": Interface(6)}
    body = model.reduce(interfaces, modes=0)
    root, tip = body.interfaces["root"], body.interfaces["tip"]

    def rigid(at):
        x, y, z = at - body.centre
        return np.hstack([np.eye(3), -np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])])

    count = len(body.eigenvalues)
    held = np.vstack(
        [
            np.hstack([rigid(root.position), root.modes]),
            np.hstack([np.zeros((3, 3)), np.eye(3), root.rotation]),
        ]
    )
    loaded = np.hstack([rigid(tip.position), tip.modes])
    system = np.zeros((count + 12, count + 12))
    system[6 : 6 + count, 6 : 6 + count] = np.diag(body.eigenvalues)
    system[-6:, : 6 + count] = held
    system[: 6 + count, -6:] = held.T
    for force, expected in [
        ([0, 0, 1.0], length**3 / (3 * modulus * width * height**3 / 12)),
        ([0, 1.0, 0], length**3 / (3 * modulus * height * width**3 / 12)),
        ([1.0, 0, 0], length / (modulus * width * height)),
    ]:
        right = np.zeros(count + 12)
        right[: 6 + count] = loaded.T @ force
        moved = loaded @ np.linalg.solve(system, right)[: 6 + count]
        assert moved == pytest.approx(np.multiply(force, expected), rel=1e-7, abs=1e-9 * expected)


def test_mass_of_a_block(block, ends):
    body = block.model.reduce(ends, modes=4)
    sides = np.array([0.2, 0.03, 0.01])
    mass = 1500 * sides.prod()
    assert body.mass == pytest.approx(mass, rel=1e-12)
    assert body.centre == pytest.approx(np.array([0.1, -0.2, 0.05]) + sides / 2, rel=1e-12)
    expected = mass / 12 * (np.diag([(sides**2).sum()] * 3) - np.diag(sides**2))
    assert tensor(body.inertia) == pytest.approx(expected, abs=1e-14)


def test_integrals_are_sums_over_the_nodes_of_a_lumped_model(block, ends):
    model = block.model
    _, stiffness = with_rows_of_nodes(model)
    order = by_nodes(model)
    count = len(model.nodes)
    masses = np.random.default_rng(3).uniform(0.5, 1.5, count) * 1e-3
    lumped = sparse.diags_array(np.repeat(masses, 3))

    def force(displacements):
        given = np.empty_like(displacements)
        given[order] = displacements
        return block.quadratic_force(given)[order]

    every = {f"n{node}": Interface(node, held="nothing") for node in range(count)}
    body = flexbody.reduce(
        lumped, stiffness, model.nodes, {**ends, **every}, modes=3, quadratic_force=force, second_order_modes=3
    )
    size = len(body.eigenvalues)
    amplitudes = np.random.default_rng(4).standard_normal(size) * 1e-3
    first = np.array([body.interfaces[name].modes for name in every])
    second = np.zeros((count, 3, size, size))
    second[:, :, :3, :3] = [body.interfaces[name].second for name in every]
    arms = model.nodes - body.centre

    def inertia(scale):
        at = arms + scale * first @ amplitudes + scale**2 / 2 * second @ amplitudes @ amplitudes
        return np.einsum("p,pi,pj->ij", masses, at, at)

    def turned(moments):
        return np.trace(moments) * np.eye(3) - moments

    # Inertia is a polynomial of fourth degree in the scale; its coefficients from five values.
    scales = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    found = np.linalg.solve(np.vander(scales, increasing=True), [turned(inertia(scale)).ravel() for scale in scales])
    expected = [
        tensor(body.inertia),
        np.tensordot(amplitudes, tensor(body.inertia_1), 1),
        np.einsum("k,l,klij->ij", amplitudes, amplitudes, tensor(body.inertia_2)),
    ]
    for degree, part in enumerate(expected):
        assert found[degree].reshape(3, 3) == pytest.approx(part, abs=1e-9 * np.abs(part).max())
    crossed = np.cross(first.transpose(0, 2, 1)[:, :, None], first.transpose(0, 2, 1)[:, None])
    coupling = np.einsum("p,pkli->kli", masses, crossed)
    assert body.coupling == pytest.approx(coupling, abs=1e-10 * np.abs(coupling).max())
    # Mean axes, and modes orthonormal in the mass.
    products = np.einsum("p,pik,pil->kl", masses, first, first)
    assert products == pytest.approx(np.eye(size), abs=1e-10)
    for shapes in (first, second.reshape(count, 3, -1)):
        scale = np.abs(shapes).max()
        assert np.einsum("p,pik->ik", masses, shapes) == pytest.approx(0, abs=1e-12 * scale)
        moments = np.einsum("p,pki->ki", masses, np.cross(arms[:, None], shapes.transpose(0, 2, 1)))
        assert moments == pytest.approx(0, abs=1e-12 * scale)


def test_origin_and_axes_of_the_model_do_not_matter(block, ends):
    mass, stiffness = with_rows_of_nodes(block.model)
    turn = scipy.linalg.expm(np.cross(np.eye(3), [0.3, -0.7, 1.1]))
    big = sparse.kron(sparse.eye_array(len(block.model.nodes)), turn).tocsc()
    moved = block.model.nodes @ turn.T + [3.0, -1.0, 2.0]
    here = flexbody.reduce(mass, stiffness, block.model.nodes, ends, modes=4)
    there = flexbody.reduce(big @ mass @ big.T, big @ stiffness @ big.T, moved, ends, modes=4)
    assert there.eigenvalues == pytest.approx(here.eigenvalues, rel=1e-7)
    assert there.centre == pytest.approx(turn @ here.centre + [3.0, -1.0, 2.0], abs=1e-12)
    signs = np.sign(np.einsum("ik,ik->k", there.interfaces["left"].modes, turn @ here.interfaces["left"].modes))
    for name in ends:
        for part in ("modes", "rotation"):
            expected = turn @ getattr(here.interfaces[name], part) * signs
            found = getattr(there.interfaces[name], part)
            assert found == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())
    expected = turn @ tensor(here.inertia_1) @ turn.T * signs[:, None, None]
    assert tensor(there.inertia_1) == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())
    expected = np.einsum("klc,ic,k,l->kli", here.coupling, turn, signs, signs)
    assert there.coupling == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())


def test_axes_of_a_model_with_rotations_of_nodes_do_not_matter():
    model = beam(6)
    turn = scipy.linalg.expm(np.cross(np.eye(3), [0.3, -0.7, 1.1]))
    big = sparse.kron(sparse.eye_array(14), turn).tocsc()
    moved = model.nodes @ turn.T + [3.0, -1.0, 2.0]
    ends = {"root": Interface(0, held="frame"), "tip": Interface(6, held="nothing")}
    here = model.reduce(ends, modes=3)
    there = flexbody.reduce(
        big @ model.mass @ big.T, big @ model.stiffness @ big.T, moved, ends, modes=3, dofs=model.dofs
    )
    assert there.eigenvalues == pytest.approx(here.eigenvalues, rel=1e-6)
    assert tensor(there.inertia) == pytest.approx(turn @ tensor(here.inertia) @ turn.T, rel=1e-9)
    signs = np.sign(np.einsum("ik,ik->k", there.interfaces["tip"].modes, turn @ here.interfaces["tip"].modes))
    for part in ("modes", "rotation"):
        expected = turn @ getattr(here.interfaces["tip"], part) * signs
        assert getattr(there.interfaces["tip"], part) == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())
    expected = turn @ tensor(here.inertia_2) @ turn.T * np.multiply.outer(signs, signs)[:, :, None, None]
    assert tensor(there.inertia_2) == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_units_are_converted(block, ends):
    """The same body in millimetres, tonnes and seconds, with stress in MPa."""
    model = block.model
    rows = sparse.random_array((6, model.mass.shape[0]), density=0.2, rng=np.random.default_rng(5)) * 1e12
    options = {"modes": 3, "dofs": model.dofs}
    ends = {**ends, "corner": Interface(0, held="nothing")}
    force = {"quadratic_force": block.quadratic_force}
    si = flexbody.reduce(model.mass, model.stiffness, model.nodes, ends, stress={"s": rows}, **force, **options)
    force = {"quadratic_force": lambda displacements: block.quadratic_force(displacements * 1e-3)}
    # N/mm, t, MPa by mm.
    given = model.mass / 1e3, model.stiffness / 1e3, model.nodes * 1e3, ends
    mm = flexbody.reduce(*given, stress={"s": rows * 1e-9}, units="mm-t-s", **force, **options)
    for name in ["mass", "centre", "inertia", "eigenvalues", "inertia_1", "inertia_2", "coupling", "cubic"]:
        expected = np.asarray(getattr(si, name))
        assert np.asarray(getattr(mm, name)) == pytest.approx(expected, abs=1e-7 * np.abs(expected).max()), name
    assert mm.stress["s"] == pytest.approx(si.stress["s"], abs=1e-6 * np.abs(si.stress["s"]).max())
    expected = si.interfaces["corner"].second
    assert mm.interfaces["corner"].second == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())
    with pytest.raises(flexbody.Error, match="expected a unit of mass .*, found 'stone'"):
        flexbody.reduce(*given, units="mm-stone-s")


def test_the_quadratic_force_undoes_rotations(block):
    """A rigid rotation needs no force to second order: f2 (r x X) = - K (r x (r x X)) / 2."""
    nodes, dofs = block.model.nodes, block.model.dofs
    turn = np.array([0.2, -0.5, 0.7])
    first = np.cross(turn, nodes)
    second = np.cross(turn, first) / 2
    expected = -block.model.stiffness @ second[dofs[:, 0], dofs[:, 1]]
    found = block.quadratic_force(first[dofs[:, 0], dofs[:, 1]])
    assert found == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_second_order_terms_from_three_sources_agree(block, ends):
    model = block.model
    size = model.mass.shape[0]

    def bilinear(one, other):
        return (block.quadratic_force(one + other) - block.quadratic_force(one - other)) / 4

    def internal(displacements):
        cubic = 1e9 * displacements**3
        return model.stiffness @ displacements + block.quadratic_force(displacements) + cubic

    def prestressed(displacements):
        columns = [bilinear(displacements, column) for column in np.eye(size)]
        return sparse.csr_array(model.stiffness + 2 * np.column_stack(columns))

    options = {"modes": 2, "second_order_modes": 2}
    middle = np.argmin(np.abs(model.nodes - [0.2, -0.2, 0.05]).sum(axis=1))
    interfaces = {**ends, "middle": Interface(middle, held="nothing")}
    bodies = [
        model.reduce(interfaces, **{source: function}, **options)
        for source, function in [
            ("quadratic_force", block.quadratic_force),
            ("internal_force", internal),
            ("prestressed_stiffness", prestressed),
        ]
    ]
    for other in bodies[1:]:
        for expected, found in [
            (bodies[0].cubic, other.cubic),
            (bodies[0].inertia_2, other.inertia_2),
            (bodies[0].interfaces["middle"].second, other.interfaces["middle"].second),
        ]:
            assert found == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())
    with pytest.raises(flexbody.Error, match="expected at most one of them, found 2"):
        model.reduce(ends, quadratic_force=internal, internal_force=internal)
    with pytest.raises(flexbody.Error, match="expected the gradient of an energy"):
        model.reduce(ends, quadratic_force=lambda displacements: np.abs(displacements) * displacements.max() * 1e9)


def test_bending_shortens_a_blade(example):
    """The distance of its ends changes by the integral of the squared slope, times half the squared amplitude."""
    _, made = example["blade_solid"]()
    nodes = made.model.nodes
    line = np.flatnonzero(np.abs(nodes[:, 1:]).max(axis=1) < 1e-9)
    line = line[np.argsort(nodes[line, 0])]
    interfaces = {f"p{index}": Interface(node, held="nothing") for index, node in enumerate(line)}
    body = made.model.reduce(interfaces, modes=3, quadratic_force=made.quadratic_force)
    motions = list(body.interfaces.values())
    deflection = np.polynomial.Polynomial.fit(nodes[line, 0], [motion.modes[2, 0] for motion in motions], 10)
    shortening = (deflection.deriv() ** 2).integ()
    found = motions[-1].second[0, 0, 0] - motions[0].second[0, 0, 0]
    assert found == pytest.approx(shortening(0.0) - shortening(0.4), rel=5e-3)


def test_a_rigid_set_moves_rigidly(block, ends):
    """Displacements of its nodes follow from translation and rotation of the reference point, to second order too."""
    model = block.model
    face = ends["right"]
    interfaces = {"right": Interface(face, kind="rigid", held="frame"), "left": ends["left"]}
    corners = {f"n{node}": Interface(node, held="nothing") for node in face}
    body = model.reduce({**interfaces, **corners}, modes=4, quadratic_force=block.quadratic_force)
    right = body.interfaces["right"]
    for node in face:
        corner = body.interfaces[f"n{node}"]
        arm = model.nodes[node] - right.position
        expected = right.modes + np.cross(right.rotation, arm, axisa=0).T
        assert corner.modes == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())
    free = model.reduce(ends, modes=4)
    assert body.frequencies[0] > free.frequencies[0]
    with pytest.raises(flexbody.Error, match="expected nodes in one rigid set"):
        model.reduce({**interfaces, "again": Interface(face[:4], kind="rigid")}, modes=4)


def test_a_reference_point_beside_the_nodes_moves_with_their_rotation(block, ends):
    point = [0.35, -0.19, 0.06]
    at = Interface(ends["right"], position=point)
    body = block.model.reduce({"mean": ends["right"], "beside": at}, modes=4)
    mean, beside = body.interfaces["mean"], body.interfaces["beside"]
    assert beside.position == pytest.approx(point)
    expected = mean.modes + np.cross(mean.rotation, np.subtract(point, mean.position), axisa=0).T
    assert beside.modes == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_fewer_modes_are_those_of_a_smaller_basis(block):
    """Free modes are nested: the first of eight are those of a basis of five."""
    options = {"quadratic_force": block.quadratic_force, "second_order_modes": 4}
    interfaces = {"first": Interface([0], held="nothing"), "right": Interface([30, 31, 32, 40], held="nothing")}
    large = block.model.reduce(interfaces, modes=8, **options).cut(5)
    small = block.model.reduce(interfaces, modes=5, **options)
    signs = np.sign(np.einsum("dk,dk->k", large.shapes, small.shapes))
    pairs = signs[:, None] * signs
    assert large.eigenvalues == pytest.approx(small.eigenvalues, rel=1e-9)
    for found, expected in [
        (large.inertia_1, small.inertia_1 * signs[:, None]),
        (large.inertia_2, small.inertia_2 * pairs[:, :, None]),
        (large.coupling, small.coupling * pairs[:, :, None]),
        (large.cubic, small.cubic * np.multiply.outer(signs, pairs[:4, :4])),
        (large.interfaces["right"].second, small.interfaces["right"].second * pairs[:4, :4]),
        (large.interfaces["right"].modes, small.interfaces["right"].modes * signs),
    ]:
        assert found == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


def test_nodes_without_rotary_inertia_are_condensed():
    """The reference condenses the rotations of a frame whose masses are lumped."""
    frame = bent_frame()
    body = frame.reduce(NOTHING, modes=27)
    masses, stiffness = frame.mass.diagonal(), frame.stiffness.toarray()
    heavy, light = np.flatnonzero(masses), np.flatnonzero(masses == 0)
    inner = np.linalg.solve(stiffness[np.ix_(light, light)], stiffness[np.ix_(light, heavy)])
    condensed = stiffness[np.ix_(heavy, heavy)] - stiffness[np.ix_(heavy, light)] @ inner
    expected = np.sqrt(scipy.linalg.eigvalsh(condensed, np.diag(masses[heavy]))[6:]) / (2 * np.pi)
    assert len(body.frequencies) == len(expected)
    assert body.frequencies == pytest.approx(expected, rel=1e-8)
    assert frame.reduce(NOTHING, modes=5).frequencies == pytest.approx(expected[:5], rel=1e-8)


def test_modes_in_other_units_make_the_same_body(block):
    """Modes of any size, with rigid ones among them, in millimetres, kilograms and milliseconds."""
    mass, stiffness = with_rows_of_nodes(block.model)
    nodes = block.model.nodes
    values, shapes = scipy.linalg.eigh(stiffness.toarray(), mass.toarray())
    expected = flexbody.reduce(mass, stiffness, nodes, NOTHING, modes=5)
    sizes = np.linspace(0.1, 40.0, 11)
    model = ModalModel(mass, shapes[:, :11] * sizes, values[:11] * 1e-6, nodes * 1e3, units="mm-kg-ms")
    body = model.reduce(NOTHING)
    assert body.eigenvalues == pytest.approx(expected.eigenvalues, rel=1e-9)
    for part in ("mass", "centre", "inertia", "inertia_1", "inertia_2", "coupling"):
        wanted = np.asarray(getattr(expected, part))
        assert np.asarray(getattr(body, part)) == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max()), part
    wanted = expected.interfaces["first"].modes
    assert body.interfaces["first"].modes == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())
    # Rotations of nodes have no unit.
    frame = bent_frame()
    reduced = frame.reduce(NOTHING, modes=5)
    shapes = reduced.shapes * np.where(frame.dofs[:, 1] < 3, 1e3, 1.0)[:, None]
    values = reduced.eigenvalues * 1e-6
    again = ModalModel(frame.mass, shapes, values, frame.nodes * 1e3, frame.dofs, units="mm-kg-ms").reduce(NOTHING)
    for part in ("modes", "rotation"):
        wanted = getattr(reduced.interfaces["first"], part)
        assert getattr(again.interfaces["first"], part) == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())
    with pytest.raises(
        flexbody.Error, match="expected displacements of shape .* and as many eigenvalues, found shapes"
    ):
        ModalModel(mass, shapes, values[:3], nodes).reduce(NOTHING)


def test_stress_on_the_surface_is_that_of_the_material(block, tmp_path):
    """Uniform strains have the stress of Hooke's law at every node, and modes that of their displacements."""
    model = block.model
    rows = block.nodal_stress()
    gradient = np.random.default_rng(5).normal(size=(3, 3))
    moved = (model.nodes @ gradient.T)[model.dofs[:, 0], model.dofs[:, 1]]
    strain = (gradient + gradient.T) / 2
    expected = 2e9 / 1.3 * (strain + 0.3 / 0.4 * np.trace(strain) * np.eye(3))
    expected = expected[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    assert (rows @ moved).reshape(-1, 6) == pytest.approx(np.tile(expected, (len(model.nodes), 1)), rel=1e-9)
    triangles = np.array([[7, 3, 5], [7, 5, 12]])
    body = model.reduce(NOTHING, modes=4, triangles=triangles, nodal_stress=rows)
    # Corners are sorted: 3, 5, 7, 12.
    assert body.surface.stress.shape == (4, 6, 4)
    assert body.surface.stress[2] == pytest.approx((rows @ body.shapes)[42:48])
    again = ReducedBody.load(body.cut(3).save(tmp_path / "stress.safetensors"))
    assert again.surface.stress == pytest.approx(body.surface.stress[:, :, :3], rel=1e-6)
    assert "4 points, 2 triangles, with stress" in again.describe()


def test_rows_of_inner_modes_do_not_move_with_the_body(block):
    """Half the nodes are replaced by amplitudes of modes with the others held: the same frequencies, and a warning."""
    mass, stiffness = (matrix.toarray() for matrix in with_rows_of_nodes(block.model))
    kept = np.arange(len(block.model.nodes) // 2)
    outer = np.arange(3 * len(kept))
    inner = np.arange(3 * len(kept), len(mass))
    _, held = scipy.linalg.eigh(stiffness[np.ix_(inner, inner)], mass[np.ix_(inner, inner)])
    basis = scipy.linalg.block_diag(np.eye(len(outer)), held)
    basis[inner[0] :, outer] = -np.linalg.solve(stiffness[np.ix_(inner, inner)], stiffness[np.ix_(inner, outer)])
    # Amplitudes come first.
    basis = np.hstack([basis[:, inner], basis[:, outer]])
    dofs = np.vstack([np.full((len(inner), 2), -1), [(node, axis) for node in kept for axis in range(3)]])
    matrices = [basis.T @ matrix @ basis for matrix in (mass, stiffness)]
    nodes = block.model.nodes
    with pytest.warns(flexbody.FlexbodyWarning, match=f"{len(inner)} of {len(mass)} are amplitudes of inner modes"):
        body = flexbody.reduce(*matrices, nodes[kept], NOTHING, dofs=dofs, modes=5)
    expected = flexbody.reduce(mass, stiffness, nodes, NOTHING, modes=5)
    assert body.eigenvalues == pytest.approx(expected.eigenvalues, rel=1e-8)
    assert body.inertia == pytest.approx(expected.inertia, rel=1e-9, abs=1e-12)


def test_the_file_is_what_safetensors_reads(bracket, tmp_path):
    path = bracket.save(tmp_path / "bracket.safetensors")
    arrays = safetensors.numpy.load_file(path)
    count, pairs = len(bracket.eigenvalues), bracket.cubic.shape[1]
    shapes = {
        "mass": (1,),
        "centre": (3,),
        "inertia": (6,),
        "eigenvalues": (count,),
        "inertia_1": (count, 6),
        "inertia_2": (count, count, 6),
        "coupling": (count, count, 3),
        "cubic": (count, pairs, pairs),
        "surface.points": (len(bracket.surface.points), 3),
        "surface.modes": (len(bracket.surface.points), 3, count),
        "surface.triangles": (len(bracket.surface.triangles), 3),
    }
    for name in ("A1", "A2", "B"):
        shapes |= {f"{name}.position": (3,), f"{name}.modes": (3, count), f"{name}.second": (3, pairs, pairs)}
    shapes["B.rotation"] = (3, count)
    assert {name: array.shape for name, array in arrays.items()} == shapes
    types = {name: array.dtype for name, array in arrays.items()}
    assert types.pop("surface.modes") == np.float32
    assert types.pop("surface.triangles") == np.uint32
    assert set(types.values()) == {np.dtype(np.float64)}
    with safetensors.safe_open(path, "numpy") as file:
        metadata = file.metadata()
    expected = {"format": "flexbody reduced body", "version": "1", "source": "scikit-fem", "highest_frequency": "450.0"}
    assert metadata == expected
    assert (np.diff(arrays["eigenvalues"]) >= 0).all() and arrays["eigenvalues"][0] > 0
    assert path.stat().st_size < 500_000
    again = ReducedBody.load(path)
    again.save(tmp_path / "again.safetensors")
    assert (tmp_path / "again.safetensors").read_bytes() == path.read_bytes()
    assert again.describe() == bracket.describe()
    assert "interface A1: position, at (0, -0.004, -0.02) m" in again.describe()


def test_files_of_other_kinds_are_refused(bracket, tmp_path):
    path = bracket.save(tmp_path / "bracket.safetensors")
    content = path.read_bytes()
    for changed, message in [
        (b"", "expected the length of a header within the file of 0 bytes"),
        (content[:100], "expected the length of a header within the file of 100 bytes"),
        (content[:-1], "is the file complete"),
        (content.replace(b'"version":"1"', b'"version":"2"'), "in version 1, found .*'version': '2'"),
        (content.replace(b'"mass"', b'"moss"'), "missing: mass"),
        (content.replace(b'"dtype":"F64"', b'"dtype":"F16"', 1), "mass: expected one of the types"),
        (content.replace(b"{", b"[", 1), "expected a header of JSON"),
        (content.replace(b'"A1.modes"', b'"A1.moods"'), "expected the arrays of a reduced body"),
    ]:
        path.write_bytes(changed)
        with pytest.raises(flexbody.Error, match=message):
            ReducedBody.load(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mass": np.eye(4)}, r"stiffness: expected the shape of the mass \[4, 4\]"),
        (
            {"nodes": np.zeros((3, 2))},
            r"nodes: expected finite coordinates of shape \[nodes, 3\], found shape \[3, 2\]",
        ),
        ({"nodes": np.zeros((3, 3))}, "dofs: expected three degrees of freedom a node, 9 of 3 nodes"),
        ({"dofs": np.zeros((2, 2), int)}, "dofs: expected integers of shape"),
        ({"units": "mm"}, "units: expected length-mass-time such as mm-t-s, found 'mm'"),
        ({"modes": -1}, "modes: expected a number of modes, found -1"),
        ({"interfaces": {}}, "interfaces: expected interfaces by name"),
        ({"interfaces": {"left side": [0]}}, "expected a name of letters, digits and underscores"),
        ({"interfaces": {"stress": [0]}}, "not surface or stress, found 'stress'"),
        ({"interfaces": {"a": [10**6]}}, r"interfaces\['a'\].nodes: expected indices from 0 to"),
        ({"interfaces": {"a": [1, 1]}}, "expected each node once"),
        ({"interfaces": {"a": Interface([0], kind="soft")}}, "expected mean or rigid, found 'soft'"),
        ({"interfaces": {"a": Interface([0], held="yes")}}, "expected position or frame or nothing, found 'yes'"),
        ({"interfaces": {"a": Interface([0], held="frame")}}, "expected nodes that are not on a line for a frame"),
        ({"interfaces": {"a": Interface([0, 1], weights=[1.0])}}, "expected 2 numbers, one a node"),
        ({"interfaces": {"a": Interface([0], position=[9, 9, 9])}}, "nodes on a line have no rotation"),
        ({"triangles": [[0, 1, 10**6]]}, "triangles: expected indices of nodes from 0"),
        ({"stress": {"a": np.zeros((6, 2))}}, r"stress\['a'\]: expected a matrix of shape \[6, "),
        ({"nodal_stress": np.zeros((6, 2))}, "nodal_stress: expected triangles beside it"),
        ({"nodal_stress": np.zeros((6, 2)), "triangles": [[0, 1, 2]]}, r"nodal_stress: expected a matrix of shape \["),
        ({"second_order_modes": 99, "quadratic_force": np.zeros_like}, "second_order_modes: expected 1 to"),
        ({"quadratic_force": lambda displacements: displacements[1:]}, "quadratic_force: expected .* finite forces"),
        ({"prestressed_stiffness": lambda displacements: 1.0}, "expected a matrix of shape .*, found float"),
    ],
)
def test_what_does_not_fit_is_refused(block, change, message):
    model = block.model
    given = {"mass": model.mass, "stiffness": model.stiffness, "nodes": model.nodes, "dofs": model.dofs}
    if "nodes" in change:
        given["dofs"] = None
        given["mass"] = given["stiffness"] = np.eye(12)
    given = {**given, "interfaces": {"first": [0]}, "modes": 2, **change}
    with pytest.raises(flexbody.Error, match=message):
        flexbody.reduce(**given)


def test_bodies_that_are_not_free_are_refused(block, ends):
    model = block.model
    mass, stiffness = with_rows_of_nodes(model)
    half = stiffness.copy().tolil()
    half[0, 1] += 0.1 * stiffness.max()
    with pytest.raises(flexbody.Error, match="stiffness: expected a symmetric matrix"):
        flexbody.reduce(mass, half, model.nodes, ends)
    support = sparse.diags_array(np.where(np.arange(mass.shape[0]) < 9, stiffness.max(), 0.0))
    with pytest.raises(flexbody.Error, match="expected a free body, whose rigid motions need no force"):
        flexbody.reduce(mass, stiffness + support, model.nodes, ends)
    with pytest.raises(flexbody.Error, match="expected a free body, whose rigid motions need no force"):
        flexbody.reduce(mass, stiffness, model.nodes[::-1] * [1, 2, 1], ends)
    along = sparse.diags_array(np.where(np.arange(mass.shape[0]) % 3 == 0, 1.1, 1.0))
    with pytest.raises(flexbody.Error, match="expected the same mass in all directions"):
        flexbody.reduce(along @ mass @ along, stiffness, model.nodes, ends)
    two = [sparse.block_diag([matrix, matrix]).tocsc() for matrix in (mass, stiffness)]
    nodes = np.vstack([model.nodes, model.nodes + [1, 0, 0]])
    with pytest.raises(flexbody.Error, match="expected a body with six rigid motions, found another"):
        flexbody.reduce(*two, nodes, ends)


def test_the_tutorial_prints_what_the_book_shows(tmp_path):
    files = ROOT / "docs" / "book" / "src" / "tutorial" / "files"
    command = [sys.executable, files / "arm.py"]
    printed = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    shown = (files / "arm.txt").read_text(encoding="utf-8")
    number = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
    assert number.sub("", printed) == number.sub("", shown)
    found, expected = ([float(text) for text in number.findall(all_of_it)] for all_of_it in (printed, shown))
    # The last digit depends on roundoff.
    assert found == pytest.approx(expected, rel=1e-4)
    assert ReducedBody.load(tmp_path / "arm.safetensors").source == "arm of the tutorial"


def test_the_package_works_without_numpy(tmp_path):
    """Scenes need neither numpy nor scipy; who asks for a reduction is told what to install."""
    code = """
import sys
sys.modules["scipy"] = sys.modules["numpy"] = None
import flexbody
from flexbody import *
try:
    flexbody.reduce
except ImportError as error:
    print(error)
"""
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert 'pip install "flexbody[fe]"' in printed
