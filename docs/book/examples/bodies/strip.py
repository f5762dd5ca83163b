"""Writes strip.safetensors, here and for the outputs: a steel strip as a reduced model, by Ritz' method with polynomials.

    python docs/book/examples/bodies/strip.py

The strip is a slender beam along x that bends in both directions. Its section does not shear, and its line keeps its
length: second-order displacements are u_kl(x) = -integral of w_k' w_l'.
"""

import json
from pathlib import Path

import numpy as np
from numpy.polynomial import Polynomial

LENGTH, WIDTH, THICKNESS = 0.5, 0.03, 0.003  # m, along x, y, z
YOUNG, DENSITY = 2.1e11, 7850.0  # Pa, kg/m^3
SHAPES = [("z", THICKNESS, 4), ("y", WIDTH, 2)]
LINE = DENSITY * WIDTH * THICKNESS  # kg/m
X = Polynomial([0.0, 1.0])
AXES = {"y": 1, "z": 2}


def along(p):
    """Integral over the length."""
    whole = p.integ()
    return whole(LENGTH) - whole(0.0)


def free_modes(height, count):
    """Eigenvalues and modes of the free strip. They span polynomials that vanish with their slope at the root, but for
    rigid motions."""
    middle = X - LENGTH / 2
    rigid = [Polynomial([1.0]), middle]
    scaled = X / LENGTH
    shapes = [scaled ** (k + 2) for k in range(count)]
    shapes = [w - sum(r * (along(w * r) / along(r * r)) for r in rigid) for w in shapes]
    mass = np.array([[LINE * along(a * b) for b in shapes] for a in shapes])
    bending = YOUNG * WIDTH * THICKNESS * height**2 / 12.0
    stiffness = np.array([[bending * along(a.deriv(2) * b.deriv(2)) for b in shapes] for a in shapes])
    lower = np.linalg.cholesky(mass)
    inverse = np.linalg.inv(lower)
    values, vectors = np.linalg.eigh(inverse @ stiffness @ inverse.T)
    mixed = inverse.T @ vectors
    return [(value, sum(w * c for w, c in zip(shapes, column))) for value, column in zip(values, mixed.T)]


def model():
    """Arrays of the reduced model by name."""
    modes = [(value, AXES[axis], w) for axis, height, count in SHAPES for value, w in free_modes(height, count)]
    modes.sort(key=lambda mode: mode[0])
    n, mass = len(modes), LINE * LENGTH
    about = [LINE * (WIDTH**2 + THICKNESS**2) * LENGTH / 12.0] + [
        mass * (LENGTH**2 + h**2) / 12.0 for h in (THICKNESS, WIDTH)
    ]
    arrays = {
        "mass": np.array([mass]),
        "centre": np.array([LENGTH / 2, 0.0, 0.0]),
        "inertia": np.array([*about, 0.0, 0.0, 0.0]),
        "eigenvalues": np.array([value for value, _, _ in modes]),
        "inertia_1": np.zeros((n, 6)),
        "inertia_2": np.zeros((n, n, 6)),
        "coupling": np.zeros((n, n, 3)),
        "cubic": np.zeros((n, n, n)),
    }
    shortening = {}
    for k, (_, a, v) in enumerate(modes):
        for l, (_, b, w) in enumerate(modes):
            moved = -(v.deriv() * w.deriv()).integ() if a == b else Polynomial([0.0])
            moved = moved - along(moved) / LENGTH
            shortening[k, l] = moved
            terms = np.zeros((3, 3))
            terms[a, b] = LINE * along(v * w)
            terms[0, 0] = LINE * along(moved * (X - LENGTH / 2))
            inertia = np.trace(terms) * np.eye(3) - (terms + terms.T) / 2
            arrays["inertia_2"][k, l] = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            arrays["coupling"][k, l] = LINE * along(v * w) * np.cross(np.eye(3)[a], np.eye(3)[b])
    arrays["inertia_2"] = (arrays["inertia_2"] + arrays["inertia_2"].transpose(1, 0, 2)) / 2
    for name, at in (("root", 0.0), ("tip", LENGTH)):
        place, turn, second = np.zeros((3, n)), np.zeros((3, n)), np.zeros((3, n, n))
        for k, (_, axis, w) in enumerate(modes):
            place[axis, k] = w(at)
            turn[3 - axis, k] = w.deriv()(at) * (1.0 if axis == 1 else -1.0)
            for l in range(n):
                second[0, k, l] = shortening[k, l](at)
        arrays[f"{name}.position"] = np.array([at, 0.0, 0.0])
        arrays.update({f"{name}.modes": place, f"{name}.rotation": turn, f"{name}.second": second})
    stress = np.zeros((6, n))
    for k, (_, axis, w) in enumerate(modes):
        half = (WIDTH if axis == 1 else THICKNESS) / 2
        stress[0, k] = -YOUNG * half * w.deriv(2)(0.0)
    arrays["stress.root"] = stress
    arrays.update(surface(modes))
    return arrays


def surface(modes, parts=8):
    """Two edges of the middle plane and the triangles between them."""
    points = [[LENGTH * k / parts, side * WIDTH / 2, 0.0] for k in range(parts + 1) for side in (-1, 1)]
    moved = np.zeros((len(points), 3, len(modes)))
    for k, (_, axis, w) in enumerate(modes):
        for at, point in enumerate(points):
            moved[at, axis, k] = w(point[0])
            moved[at, 0, k] = -point[1] * w.deriv()(point[0]) if axis == 1 else 0.0
    triangles = [t for k in range(0, 2 * parts, 2) for t in ([k, k + 2, k + 1], [k + 1, k + 2, k + 3])]
    return {
        "surface.points": np.array(points),
        "surface.modes": moved.astype(np.float32),
        "surface.triangles": np.array(triangles, dtype=np.uint32),
    }


def write(path, arrays, metadata):
    """Writes arrays in the layout of safetensors."""
    names = {"float64": "F64", "float32": "F32", "uint32": "U32"}
    header, place = {"__metadata__": metadata}, 0
    for name, array in arrays.items():
        end = place + array.nbytes
        header[name] = {"dtype": names[str(array.dtype)], "shape": list(array.shape), "data_offsets": [place, end]}
        place = end
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    data = b"".join(np.ascontiguousarray(array).tobytes() for array in arrays.values())
    path.write_bytes(len(text).to_bytes(8, "little") + text + data)


if __name__ == "__main__":
    texts = {"format": "flexbody reduced body", "version": "1", "source": "Ritz polynomials of a slender strip"}
    examples = Path(__file__).resolve().parents[1]
    for group in ("bodies", "outputs"):
        write(examples / group / "strip.safetensors", model(), texts)
