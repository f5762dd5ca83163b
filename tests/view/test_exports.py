"""Motion for other programs, read by VTK's own readers: where points are is held against the outputs of the same scene."""

import json
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from project import ROOT, xtask
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

# Scene, marker, body, and which of its points are around the marker: rings of 16 points, 48 along a body at least.
PLACES = [
    ("robot_cable", "hose.middle", 3, slice(24 * 16, 25 * 16)),
    ("pendulum", "rod.tip", 0, slice(-16, None)),
    ("gyroscope", "rotor.centre", 0, slice(None)),
]
# Reads a file of glTF at times and writes points: apart, as a reader that fails may end its process.
READ = """
import sys
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader

file, target, *times = sys.argv[1:]
reader = vtkGLTFReader()
reader.SetFileName(file)
reader.ApplyDeformationsToGeometryOn()
reader.SetFrameRate(1000)
reader.UpdateInformation()
for number in range(reader.GetNumberOfAnimations()):
    reader.EnableAnimation(number)
reader.UpdateInformation()

def points(block):
    if block is None:
        return []
    if block.IsA("vtkPolyData"):
        return [vtk_to_numpy(block.GetPoints().GetData())]
    return [found for k in range(block.GetNumberOfBlocks()) for found in points(block.GetBlock(k))]

frames = []
for time in times:
    reader.UpdateTimeStep(float(time))
    frames.append(np.concatenate(points(reader.GetOutputDataObject(0))))
np.save(target, np.stack(frames))
"""


def polygons(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def points(data, body=None):
    found = vtk_to_numpy(data.GetPoints().GetData())
    if body is None:
        return found
    bodies = vtk_to_numpy(data.GetCellData().GetArray("body"))
    ends, corners = (vtk_to_numpy(array) for array in (data.GetPolys().GetOffsetsArray(), data.GetPolys().GetConnectivityArray()))
    own = [corners[ends[cell] : ends[cell + 1]] for cell in np.flatnonzero(bodies == body)]
    return found[np.unique(np.concatenate(own))]


@pytest.fixture(scope="module", params=PLACES, ids=lambda place: place[0])
def exported(request, pages, tmp_path_factory):
    name, *place = request.param
    folder = tmp_path_factory.mktemp(name)
    xtask("view", pages.scene(name), "--vtk", folder / "vtk", "--gltf", folder / "motion.glb")
    series = ET.parse(folder / "vtk" / "motion.pvd").iter("DataSet")
    frames = [(float(entry.get("timestep")), folder / "vtk" / entry.get("file")) for entry in series]
    assert not list(folder.glob("*.html"))
    return name, place, frames, folder / "motion.glb"


def test_points_of_vtk_are_around_their_markers(exported, pages):
    name, (marker, body, around), frames, _ = exported
    _, table = pages.table(name)
    assert [frames[0][0], frames[-1][0]] == [table["time"][0], table["time"][-1]]
    for time, path in frames[::10]:
        row = table["time"].index(time)
        place = [table.get(f"{marker}.position[{axis}]", [0.0] * (row + 1))[row] for axis in (1, 2, 3)]
        found = points(polygons(path), body)[around].mean(axis=0)
        assert found == pytest.approx(place, abs=1e-5)


def test_surfaces_of_vtk_are_closed_and_face_outwards(exported):
    _, _, frames, _ = exported
    data = polygons(frames[0][1])
    edges = vtkFeatureEdges()
    edges.SetInputData(data)
    edges.BoundaryEdgesOn()
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOn()
    edges.ManifoldEdgesOff()
    edges.Update()
    assert edges.GetOutput().GetNumberOfCells() == 0
    triangles = vtkTriangleFilter()
    triangles.SetInputData(data)
    triangles.Update()
    mass = vtkMassProperties()
    mass.SetInputData(triangles.GetOutput())
    assert mass.GetVolume() > 0
    # The sum of the volumes below all faces, signed by the side that they face.
    cells = vtk_to_numpy(triangles.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = np.moveaxis(points(triangles.GetOutput())[cells].astype(float), 1, 0)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(mass.GetVolume(), rel=0.02)


def test_gltf_moves_as_the_frames_of_vtk(exported, pages, tmp_path):
    name, _, frames, file = exported
    some = [frames[0], frames[len(frames) // 3], frames[-1]]
    is_space = name != "pendulum"
    compare(file, some, is_space, tmp_path)


def compare(file, frames, is_space, folder):
    """Points of glTF at the times of frames, and those of VTK."""
    target = folder / "points.npy"
    command = [sys.executable, "-c", READ, file, target, *(repr(time) for time, _ in frames)]
    result = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr[-2000:]
    for found, (_, path) in zip(np.load(target), frames):
        wanted = points(polygons(path))
        if is_space:
            # Up is y there.
            wanted = wanted[:, [0, 2, 1]] * [1, 1, -1]
        assert np.sort(found, axis=0) == pytest.approx(np.sort(wanted, axis=0), abs=2e-5)


def test_a_finite_element_model_deforms(tmp_path):
    """The strip of the book, bent by 3 mm. The last two points of its surface are the corners of its end."""
    model = ROOT / "docs/book/examples/outputs/strip.safetensors"
    shutil.copy(model, tmp_path)
    scene = json.loads((model.parent / "stress_tensor.json").read_text(encoding="utf-8"))
    scene["outputs"] = [{"kind": "position", "marker": "strip.tip"}]
    path = tmp_path / "strip.json"
    path.write_text(json.dumps(scene), encoding="utf-8")
    xtask("view", path, "--vtk", tmp_path / "vtk", "--gltf", tmp_path / "motion.glb")
    xtask("simulate", path, "--output", tmp_path / "strip.csv")
    table = np.genfromtxt(tmp_path / "strip.csv", delimiter=",", names=True)
    series = ET.parse(tmp_path / "vtk" / "motion.pvd").iter("DataSet")
    frames = [(float(entry.get("timestep")), tmp_path / "vtk" / entry.get("file")) for entry in series]
    tips = np.array([list(row)[1:] for row in table])
    assert tips[-1, 2] > 0.0025
    for time, file in frames[::10]:
        tip = tips[np.argmin(np.abs(table["time"] - time))]
        found = points(polygons(file), 0)[-2:].mean(axis=0)
        # Modes do not shorten what they bend: (3 mm)^2 / 0.5 m.
        assert found == pytest.approx(tip, abs=2e-5)
    compare(tmp_path / "motion.glb", frames[::50], True, tmp_path)
