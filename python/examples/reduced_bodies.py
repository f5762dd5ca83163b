"""Reduced bodies of two solids of scikit-fem: an L-shaped bracket and a blade.

    python reduced_bodies.py [FOLDER]

writes bracket.safetensors and blade.safetensors. Needs `pip install "flexbody[fe]" scikit-fem`.
"""

import sys
from pathlib import Path

import numpy as np
from flexbody.reduction import Interface
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex2, ElementVector, MeshHex

# Polypropylene, about: Pa, 1, kg/m^3.
MATERIAL = {"youngs_modulus": 1e9, "poissons_ratio": 0.35, "density": 1150.0}
# Meshes twice as fine have frequencies lower by 3 % there.
RESOLVED = {"highest_frequency": 450.0}


def solid(mesh):
    """Solid of quadratic hexahedra."""
    return Solid(Basis(mesh, ElementVector(ElementHex2()), intorder=4), **MATERIAL)


def chosen(nodes, **places):
    """Indices of the nodes whose coordinates have these values, m."""
    found = np.ones(len(nodes), bool)
    for axis, place in places.items():
        found &= np.abs(nodes[:, "xyz".index(axis)] - place) < 1e-9
    return np.flatnonzero(found)


def quadratic_weights(nodes, *axes):
    """Integrals of the shape functions of a row, or face, of quadratic elements (Simpson's rule along each axis)."""
    weights = np.ones(len(nodes))
    for axis in axes:
        places, inverse = np.unique(np.round(nodes[:, "xyz".index(axis)], 12), return_inverse=True)
        ends, middles = places[::2], places[1::2]
        along = np.zeros(len(places))
        along[1::2] = 4 * (ends[1:] - ends[:-1]) / 6
        along[:-1:2] += (ends[1:] - ends[:-1]) / 6
        along[2::2] += (ends[1:] - ends[:-1]) / 6
        assert np.allclose((ends[1:] + ends[:-1]) / 2, middles)
        weights *= along[inverse]
    return weights


def mean(nodes, axes, held="position", **places):
    """Interface that moves as the mean of an edge or face."""
    found = chosen(nodes, **places)
    return Interface(found, weights=quadratic_weights(nodes[found], *axes), held=held)


def surface(mesh, nodes):
    """Triangles of the boundary: two for each face of an element, between its corners."""
    faces = mesh.facets[:, mesh.boundary_facets()].T
    # Nodes of the basis begin with those of the mesh.
    assert np.allclose(nodes[: mesh.nvertices], mesh.p.T)
    return np.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def bracket_solid():
    """Mesh and solid: 0.3 m along x, 0.2 m along -y, 40 mm wide, 8 mm thick."""
    length, height, width, thickness = 0.3, 0.2, 0.04, 0.008
    mesh = MeshHex.init_tensor(
        np.append(np.linspace(0, length - thickness, 11), length),
        np.append(np.linspace(-height, -thickness, 7), 0),
        np.linspace(-width / 2, width / 2, 3),
    )
    middle = mesh.p[:, mesh.t].mean(axis=1)
    mesh = mesh.restrict(np.flatnonzero((middle[0] > length - thickness) | (middle[1] > -thickness)))
    return mesh, solid(mesh)


def bracket(**options):
    """Reduced bracket: A1 and A2 are the means of the edges x = 0, z = -/+ 20 mm, B that of the end face y = -0.2 m."""
    mesh, made = bracket_solid()
    nodes = made.model.nodes
    interfaces = {
        "A1": mean(nodes, "y", x=0, z=-0.02),
        "A2": mean(nodes, "y", x=0, z=0.02),
        "B": mean(nodes, "xz", held="nothing", y=-0.2),
    }
    given = {"interfaces": interfaces, "quadratic_force": made.quadratic_force, "triangles": surface(mesh, nodes)}
    return made.model.reduce(**{**given, **RESOLVED, **options})


def blade_solid():
    """Mesh and solid: 0.4 x 0.03 x 0.006 m along x, y, z."""
    length, width, thickness = 0.4, 0.03, 0.006
    mesh = MeshHex.init_tensor(
        np.linspace(0, length, 13),
        np.linspace(-width / 2, width / 2, 2),
        np.linspace(-thickness / 2, thickness / 2, 2),
    )
    return mesh, solid(mesh)


def blade(**options):
    """Reduced blade: root is rigid, tip is the mean of the other end face."""
    mesh, made = blade_solid()
    nodes = made.model.nodes
    root = chosen(nodes, x=0)
    interfaces = {
        "root": Interface(root, weights=quadratic_weights(nodes[root], "y", "z"), kind="rigid", held="frame"),
        "tip": mean(nodes, "yz", held="nothing", x=0.4),
    }
    given = {"interfaces": interfaces, "quadratic_force": made.quadratic_force, "triangles": surface(mesh, nodes)}
    return made.model.reduce(**{**given, **RESOLVED, **options})


def main():
    """Writes both files and describes them."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    for make in (bracket, blade):
        body = make()
        path = body.save(folder / f"{make.__name__}.safetensors")
        print(f"{path}:\n{body.describe()}\n")


if __name__ == "__main__":
    main()
