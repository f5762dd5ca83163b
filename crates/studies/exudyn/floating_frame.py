"""A reduced body in Exudyn: its floating frame with modes (ObjectFFRFreducedOrder), from the file that the product reads. It is linear:
files must have no second-order displacements. Frame and modes are orthogonal in the mass and to each other, and interfaces
are the nodes of the mesh."""

import json
import pathlib

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadMassProportional,
    MarkerBodyMass,
    MarkerSuperElementPosition,
    NodeGenericODE2,
    NodeRigidBodyEP,
    ObjectFFRFreducedOrder,
)

# Components of symmetric tensors in files.
TENSOR = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def read(path):
    """Arrays of 64-bit floats of a file by name."""
    content = pathlib.Path(path).read_bytes()
    start = 8 + int.from_bytes(content[:8], "little")
    header = json.loads(content[8:start])
    arrays = {}
    for name, entry in header.items():
        if entry.get("dtype") == "F64":
            first, last = entry["data_offsets"]
            arrays[name] = np.frombuffer(content[start + first : start + last], "<f8").reshape(entry["shape"])
    return arrays


def tensors(components):
    """Symmetric tensors [..., 3, 3] of their components [..., 6]."""
    result = np.zeros((*components.shape[:-1], 3, 3))
    for index, (row, column) in enumerate(TENSOR):
        result[..., row, column] = result[..., column, row] = components[..., index]
    return result


def skew(vectors):
    """Matrices [..., 3, 3] of cross products with vectors [..., 3]."""
    return np.cross(vectors[..., None, :], np.eye(3)).swapaxes(-1, -2)


def diagonal(values):
    matrix = exu.MatrixContainer()
    matrix.SetWithDenseMatrix(np.diag(values), useDenseMatrix=False)
    return matrix


def add(model, body):
    """Adds a reduced body at rest, its weight and its interfaces to a model."""
    file = pathlib.Path(model.options["scene"]).parent / body["file"]
    arrays = read(file)
    if "cubic" in arrays:
        raise ValueError(f"{file}: expected a model without second-order displacements")
    count, place = len(arrays["eigenvalues"]), arrays["centre"] + body["position"]
    frame = NodeRigidBodyEP(referenceCoordinates=[*place, 1.0, 0.0, 0.0, 0.0])
    modal = NodeGenericODE2(
        referenceCoordinates=[0.0] * count,
        initialCoordinates=[0.0] * count,
        initialCoordinates_t=[0.0] * count,
        numberOfODE2Coordinates=count,
    )
    coupling = arrays["coupling"]
    # Blocks of a mode or of a pair of modes. In mean axes that of the position and a mode is symmetric.
    turned = tensors(arrays["inertia_2"]) - 0.5 * skew(coupling)
    names = list(body["markers"].values())
    shapes = [arrays[f"{name}.modes"] for name in names]
    points = [arrays[f"{name}.position"] - arrays["centre"] for name in names]
    number = model.mbs.AddObject(
        ObjectFFRFreducedOrder(
            nodeNumbers=[model.mbs.AddNode(frame), model.mbs.AddNode(modal)],
            massMatrixReduced=diagonal(np.ones(count)),
            stiffnessMatrixReduced=diagonal(arrays["eigenvalues"]),
            modeBasis=np.vstack(shapes),
            referencePositions=np.concatenate(points),
            mass=arrays["mass"][0],
            inertia=tensors(arrays["inertia"]),
            centerOfMass=[0.0, 0.0, 0.0],
            mPsiTildePsi=-coupling.transpose(0, 2, 1).reshape(3 * count, count),
            mPsiTildePsiTilde=turned.transpose(0, 2, 1, 3).reshape(3 * count, 3 * count),
            mPhitTPsi=np.zeros((3, count)),
            mPhitTPsiTilde=np.zeros((3, 3 * count)),
            mXRefTildePsi=np.zeros((3, count)),
            mXRefTildePsiTilde=0.5 * np.hstack(tensors(arrays["inertia_1"])),
            computeFFRFterms=True,
        )
    )
    weight = model.mbs.AddMarker(MarkerBodyMass(bodyNumber=number))
    model.mbs.AddLoad(LoadMassProportional(markerNumber=weight, loadVector=model.scene["gravity"]))
    for index, (name, point) in enumerate(zip(body["markers"], points)):
        marker = MarkerSuperElementPosition(bodyNumber=number, meshNodeNumbers=[index], weightingFactors=[1.0])
        model.points[f"{body['name']}.{name}"] = model.mbs.AddMarker(marker), place + point
    model.axes[body["name"]] = np.eye(3)
