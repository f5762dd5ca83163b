"""Ready scenes with reduced bodies: their files, and what runs of them say, against whole finite element models and closed forms."""

import csv
import json
import math
import subprocess

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import ROOT, read
from flexbody.reduction import ReducedBody
from flexbody.reduction.container import read_arrays
from scipy.sparse.linalg import eigsh, spsolve

SCENES = ROOT / "scenes"
SCRIPT = SCENES / "make_containers.py"


@pytest.fixture(scope="module")
def script():
    namespace = {"__name__": "make_containers"}
    exec(compile(SCRIPT.read_text(encoding="utf-8"), SCRIPT, "exec"), namespace)
    return namespace


@pytest.fixture(scope="module")
def parts(script):
    """The solids by name."""
    return {make.__name__: make() for make in script["PARTS"]}


@pytest.fixture
def simulated(program, tmp_path):
    """Runs a scene; returns outputs by name, and what was calculated before the run."""

    def run(scene):
        path, table, report = (tmp_path / f"{scene['name']}.{end}" for end in ("json", "csv", "report.json"))
        for body in scene["bodies"]:
            if "file" in body:
                (tmp_path / body["file"]).write_bytes((SCENES / body["file"]).read_bytes())
        path.write_text(json.dumps(scene), encoding="utf-8")
        subprocess.run([program, "simulate", path, "--output", table, "--report", report], check=True)
        with table.open(encoding="utf-8") as file:
            names, *rows = csv.reader(file)
        outputs = dict(zip(names, np.array(rows, float).T, strict=True))
        return outputs, json.loads(report.read_text(encoding="utf-8"))["calculated"]

    return run


def vector(table, name):
    """A vector output of a run [times, components]."""
    columns = [values for key, values in table.items() if key.startswith(f"{name}[")]
    return np.column_stack(columns)


def cross(vectors):
    """Matrices of cross products by vectors from the left."""
    return -np.cross(np.asarray(vectors)[..., None, :], np.eye(3)).swapaxes(-1, -2)


def rigid_map(part, name, about):
    """Map [dofs, free dofs + 6] from the free nodes of a solid and the motion of a point to which an interface is rigidly fixed."""
    nodes, dofs = part.nodes, part.solid.model.dofs
    is_held = np.isin(dofs[:, 0], part.interfaces[name].nodes)
    free = np.flatnonzero(~is_held)
    rows = sparse.lil_array((len(dofs), len(free) + 6))
    rows[free, np.arange(len(free))] = 1
    for dof in np.flatnonzero(is_held):
        node, component = dofs[dof]
        rows[dof, len(free) + component] = 1
        rows[[dof], len(free) + 3 :] = -cross(nodes[node] - about)[component]
    return rows.tocsc()


def frequencies(mass, stiffness, count):
    """Lowest natural frequencies of a sparse model, Hz."""
    values = eigsh(stiffness.tocsc(), count, mass.tocsc(), sigma=-1.0, return_eigenvectors=False, tol=1e-12)
    return np.sqrt(np.maximum(np.sort(values), 0)) / (2 * math.pi)


@pytest.mark.parametrize("name", ["bracket", "crank", "panel"])
def test_files_of_ready_scenes_are_those_of_their_script(parts, name, tmp_path):
    committed, about = read_arrays(SCENES / f"{name}.safetensors")
    made, about_made = read_arrays(parts[name].reduce().save(tmp_path / f"{name}.safetensors"))
    assert about == about_made
    assert list(committed) == list(made)
    assert (SCENES / f"{name}.safetensors").stat().st_size < 100_000
    for key, array in committed.items():
        found, expected = (np.asarray(of, float) for of in (made[key], array))
        # Surfaces have single precision.
        relative = 1e-6 if key in ("surface.modes", "surface.stress") else 1e-9
        assert np.abs(found - expected).max() <= relative * np.abs(expected).max(), key


@pytest.fixture(scope="module")
def bolted(parts):
    """Mass, stiffness and tip [free, 3] of the whole bracket: one bolt holds its nodes, the other lets them rotate and slide along z."""
    part = parts["bracket"]
    model = part.solid.model
    lower = part.interfaces["lower"].nodes
    to_dofs = rigid_map(part, "lower", part.nodes[lower].mean(axis=0))
    count = to_dofs.shape[1] - 6
    clamped = np.isin(model.dofs[:, 0], part.interfaces["upper"].nodes)
    kept = [k for k in range(count) if not (to_dofs[:, [k]].toarray().ravel().astype(bool) & clamped).any()]
    to_dofs = to_dofs[:, [*kept, *range(count + 2, count + 6)]]
    tip = part.interfaces["tip"].nodes
    mean = sparse.lil_array((3, len(model.dofs)))
    for dof in np.flatnonzero(np.isin(model.dofs[:, 0], tip)):
        mean[model.dofs[dof, 1], dof] = 1 / len(tip)
    mass, stiffness = (to_dofs.T @ matrix @ to_dofs for matrix in (model.mass, model.stiffness))
    return mass, stiffness, (mean.tocsr() @ to_dofs).T


def test_the_bracket_bends_and_vibrates_as_the_whole_model(bolted, simulated):
    mass, stiffness, tip = bolted
    force = np.array([3.0, -4.0, -10.0])
    scene = read(SCENES / "bracket.json")
    del scene["bodies"][1], scene["joints"][2], scene["gravity"]
    load = {"name": "push", "kind": "force", "marker": "bracket.tip", "value": [0, 0, 0]}
    changes = {
        "loads": [load],
        "outputs": [{"kind": "position", "marker": "bracket.tip"}, {"kind": "natural_frequency", "count": 2}],
        "initial": "static_equilibrium",
        "accuracy": {"relative_tolerance": 1e-6},
        "experiment": {"stop_time": 1e-5, "step": 1e-5},
    }
    table, calculated = simulated({**scene, **changes})
    found = [calculated[f"natural_frequency[{k}]"] / (2 * math.pi) for k in (1, 2)]
    assert found == pytest.approx(frequencies(mass, stiffness, 2), rel=2e-3)
    straight = vector(table, "bracket.tip.position")[0]
    load["value"] = force.tolist()
    bent = vector(simulated({**scene, **changes})[0], "bracket.tip.position")[0]
    expected = tip.T @ spsolve(stiffness.tocsc(), tip @ force)
    # Forces of 10 N bend the arm by 0.5 mm: what follows from squares is a thousandth of that.
    assert np.linalg.norm(bent - straight - expected) < 2e-3 * np.linalg.norm(expected)


def test_pistons_move_as_those_of_a_rigid_crank(simulated):
    """Distance from the crank's axis r cos a + sqrt(l^2 - r^2 sin^2 a), and the moment of a rigid crank of the same mass."""
    scene = read(SCENES / "crank_train.json")
    table, _ = simulated(scene)
    radius, length, time = 0.04, 0.14, table["time"]
    angle = 200 * (time - 0.05 * np.tanh(time / 0.05))
    for number, inclined in [(1, math.pi / 4), (2, -math.pi / 4)]:
        across = radius * np.sin(angle + inclined)
        place = radius * np.cos(angle + inclined) + np.sqrt(length**2 - across**2)
        assert np.abs(table[f"cylinder_{number}.displacement"] - (place - place[0])).max() < 5e-5

    body = ReducedBody.load(SCENES / "crank.safetensors")
    assert np.abs(body.inertia[3:]).max() < 1e-9 and np.abs(body.centre[[0, 2]]).max() < 1e-9
    crank = {key: scene["bodies"][0][key] for key in ("name", "orientation")}
    scene["bodies"][0] = {
        **crank,
        "element": "rigid",
        "mass": body.mass,
        "inertia": body.inertia[:3].tolist(),
        "position": [0, 0, body.centre[1]],
        "markers": {name: (at.position - body.centre).tolist() for name, at in body.interfaces.items()},
    }
    rigid, _ = simulated({**scene, "name": "rigid"})
    name = "drive.reaction_moment[1]"
    differences = np.abs(table[name] - rigid[name])
    size = np.abs(rigid[name]).max()
    # The flexible crank vibrates.
    assert differences.mean() < 0.02 * size and differences.max() < 0.05 * size


def test_a_satellite_has_the_momentum_of_its_torques(simulated):
    scene = read(SCENES / "satellite.json")
    scene["outputs"] = [{"kind": "momentum"}, {"kind": "rotation_vector", "marker": "bus.centre"}]
    scene["accuracy"] = {"relative_tolerance": 1e-7}
    table, _ = simulated(scene)
    first, second, third = scene["loads"][0]["value"]
    assert third == "4*sin(0.6*t)"
    fine = np.linspace(0, table["time"][-1], 20_001)
    expected = []
    for value in (first, second):
        torque = np.interp(fine, *np.array(value["table"]).T)
        impulse = np.concatenate([[0], np.cumsum((torque[1:] + torque[:-1]) / 2 * np.diff(fine))])
        expected.append(np.interp(table["time"], fine, impulse))
    expected.append(4 / 0.6 * (1 - np.cos(0.6 * table["time"])))
    found = vector(table, "angular_momentum")
    assert np.abs(vector(table, "momentum")).max() < 1e-9
    assert np.abs(found - np.column_stack(expected)).max() < 1e-5 * np.abs(found).max()
    assert np.linalg.norm(vector(table, "bus.centre.rotation_vector")[-1]) > 1


def test_a_satellite_vibrates_as_two_whole_panels_on_a_free_bus(parts, simulated):
    scene = read(SCENES / "satellite.json")
    scene["outputs"] = [{"kind": "natural_frequency", "count": 12}]
    scene["accuracy"] = {"relative_tolerance": 1e-6}
    scene["experiment"] = {"stop_time": 0.01, "step": 0.01}
    _, calculated = simulated(scene)
    found = np.array([calculated[f"natural_frequency[{k}]"] for k in range(1, 13)]) / (2 * math.pi)

    part = parts["panel"]
    model = part.solid.model
    to_dofs = rigid_map(part, "root", np.array([-0.5, 0, 0]))
    count = to_dofs.shape[1] - 6
    own, shared = to_dofs[:, :count], to_dofs[:, count:]
    opposite = shared @ sparse.diags_array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
    right = sparse.hstack([own, sparse.csc_array(own.shape), shared]).tocsc()
    left = sparse.hstack([sparse.csc_array(own.shape), own, opposite]).tocsc()
    mass, stiffness = (right.T @ matrix @ right + left.T @ matrix @ left for matrix in (model.mass, model.stiffness))
    bus = 250 * 1.2
    inertia = bus / 12 * np.array([1 + 1.2**2, 1 + 1.2**2, 2])
    mass = mass + sparse.diags_array(np.concatenate([np.zeros(2 * count), [bus] * 3, inertia]))
    expected = frequencies(mass, stiffness, 12)
    assert found[:6] == pytest.approx(np.zeros(6), abs=1e-6) and expected[5] < 0.01
    assert found[6:] == pytest.approx(expected[6:], rel=1e-4)
