"""Finite element models of the ready scenes with reduced bodies.

    python scenes/make_containers.py [FOLDER]

writes bracket.safetensors, crank.safetensors and panel.safetensors beside the scenes. Needs `pip install "flexbody[fe]"
scikit-fem`.
"""

import sys
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import numpy as np
from flexbody.reduction import Interface
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex2, ElementVector, MeshHex

# Pa, 1, kg/m^3.
STEEL = {"youngs_modulus": 2.1e11, "poissons_ratio": 0.3, "density": 7850.0}
# A sandwich of aluminium skins and honeycomb, as a uniform plate of the same bending stiffness and mass.
SANDWICH = {"youngs_modulus": 4.1e9, "poissons_ratio": 0.3, "density": 150.0}
# Local coordinates of corners, middles of edges and of faces, and of the centre of a hexahedron.
PLACES = np.array(list(product([0.0, 0.5, 1.0], repeat=3))).T


@dataclass
class Part:
    """A solid with its interfaces, before it is reduced.

    mesh: hexahedra. material: arguments of `Solid`. interfaces: `Interface` by name. modes: number of natural modes with
    held interfaces. stress: points [3] by name where stress is wanted, m. A part with such points has stress on its
    surface.
    """

    name: str
    mesh: MeshHex
    material: dict
    modes: int
    interfaces: object
    stress: dict = field(default_factory=dict)

    def __post_init__(self):
        """Assembles the solid of quadratic hexahedra."""
        self.element = ElementVector(ElementHex2())
        self.solid = Solid(Basis(self.mesh, self.element, intorder=4), **self.material)
        self.nodes = self.solid.model.nodes
        self.interfaces = self.interfaces(self.nodes)

    def reduce(self):
        """Reduces the solid."""
        return self.solid.model.reduce(
            self.interfaces,
            modes=self.modes,
            quadratic_force=self.solid.quadratic_force,
            triangles=self.triangles(),
            stress={name: self.stress_rows(point) for name, point in self.stress.items()},
            nodal_stress=self.solid.nodal_stress() if self.stress else None,
            source=f"{self.name} of scenes/make_containers.py",
        )

    def triangles(self):
        """Triangles of the boundary: two for each face of an element, between its corners."""
        faces = self.mesh.facets[:, self.mesh.boundary_facets()].T
        # Nodes of the solid begin with the corners.
        assert np.allclose(self.nodes[: self.mesh.nvertices], self.mesh.p.T)
        return np.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])

    def stress_rows(self, point):
        """Matrix [6, dofs] of the stress xx yy zz xy xz yz at the node that is nearest to a point."""
        places = self.solid.basis.mapping.F(PLACES)
        distance = np.linalg.norm(places - np.reshape(point, (3, 1, 1)), axis=0)
        element, place = np.unravel_index(distance.argmin(), distance.shape)
        at = Basis(self.mesh, self.element, elements=np.array([element]), quadrature=(PLACES[:, [place]], np.ones(1)))
        rows = np.zeros((6, at.N))
        first, shear = self.solid.lame
        for number in range(at.Nbfun):
            gradient = at.basis[number][0].grad[:, :, 0, 0]
            stress = shear * (gradient + gradient.T) + first * np.trace(gradient) * np.eye(3)
            rows[:, at.element_dofs[number, 0]] += stress[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        return rows


def within(nodes, low, high):
    """Indices of the nodes in a box; None leaves a side open."""
    found = np.ones(len(nodes), bool)
    for axis, (least, most) in enumerate(zip(low, high, strict=True)):
        found &= True if least is None else nodes[:, axis] > least - 1e-9
        found &= True if most is None else nodes[:, axis] < most + 1e-9
    return np.flatnonzero(found)


# Bracket: x away from the wall, z upwards.
REACH, DROP, WIDTH, THICKNESS, BEND = 0.25, 0.12, 0.06, 0.005, 0.015


def bracket():
    """A bent steel sheet: a leg on the wall below the corner, and an arm.

    `upper` and `lower` are clamped by bolts, `tip` is the end of the arm. The stress is that on the inner side of the
    bend.
    """
    leg = np.array([-DROP, -0.11, -0.09, -0.06, -0.04, -BEND])
    arm = np.linspace(BEND, REACH, 7)
    # Along the sheet: leg, a quarter of a circle in three parts, arm.
    length = np.concatenate([leg, [-BEND / 3, BEND / 3], arm])
    mesh = MeshHex.init_tensor(length, np.linspace(-WIDTH / 2, WIDTH / 2, 4), [0.0, THICKNESS])
    along, across, deep = mesh.p
    angle = np.pi / 2 * (1 - (np.clip(along, -BEND, BEND) / BEND + 1) / 2) + np.pi / 2
    radius = BEND - deep
    x = BEND + radius * np.cos(angle) + np.maximum(along - BEND, 0)
    z = -BEND + radius * np.sin(angle) + np.minimum(along + BEND, 0)
    mesh = MeshHex(np.array([x, across, z]), mesh.t)
    middle = BEND - (BEND - THICKNESS) / np.sqrt(2)

    def interfaces(nodes):
        def bolt(z):
            return within(nodes, (None, -WIDTH / 6, z - 0.01), (THICKNESS, WIDTH / 6, z + 0.01))

        return {
            "upper": Interface(bolt(-0.05), kind="rigid", held="frame"),
            "lower": Interface(bolt(-0.1), kind="rigid"),
            "tip": Interface(within(nodes, (REACH, None, None), (None, None, None))),
        }

    return Part("bracket", mesh, STEEL, 2, interfaces, {"fillet": (middle, 0.0, -middle)})


# Crank: x along its axis.
THROW, JOURNAL, PIN, HALF = 0.04, 0.015, 0.015, 0.1


def crank():
    """A steel crank between two bearings, with octagonal journals and pin, and counterweights.

    `front` takes the torque, `rear` is the other bearing, `pin` the middle of the crankpin.
    """
    x = np.array([-HALF, -0.06, -0.04, -0.02, 0.0, 0.02, 0.04, 0.06, HALF])
    y = np.array([-0.06, -0.035, -JOURNAL, 0.0, JOURNAL, THROW - PIN, THROW, THROW + PIN, THROW + PIN + 0.01])
    z = np.array([-0.03, -JOURNAL, 0.0, JOURNAL, 0.03])
    mesh = MeshHex.init_tensor(x, y, z)
    middle = mesh.p[:, mesh.t].mean(axis=1)
    at, high, wide = np.abs(middle[0]), middle[1], np.abs(middle[2])
    is_web = (at > 0.02) & (at < 0.06)
    is_journal = (at > 0.06) & (np.abs(high) < JOURNAL) & (wide < JOURNAL)
    is_pin = (at < 0.02) & (np.abs(high - THROW) < PIN) & (wide < JOURNAL)
    mesh = mesh.restrict(np.flatnonzero(is_web | is_journal | is_pin))
    # Corners of the squares move to circles.
    places = mesh.p.copy()
    for centre in (0.0, THROW):
        is_corner = np.isclose(np.abs(places[1] - centre), JOURNAL) & np.isclose(np.abs(places[2]), JOURNAL)
        scaled = centre + (places[1, is_corner] - centre) / np.sqrt(2)
        mesh.p[1, is_corner], mesh.p[2, is_corner] = scaled, places[2, is_corner] / np.sqrt(2)

    def interfaces(nodes):
        def slice_of(at):
            return within(nodes, (at, None, None), (at, None, None))

        return {
            "front": Interface(slice_of(-HALF), kind="rigid", held="frame"),
            "rear": Interface(slice_of(HALF)),
            "pin": Interface(slice_of(0.0)),
        }

    return Part("crank", MeshHex(mesh.p, mesh.t), STEEL, 2, interfaces)


def panel():
    """A solar panel of 3 x 1 m that begins at its edge `root`."""
    length, width, thickness = 3.0, 1.0, 0.02
    mesh = MeshHex.init_tensor(
        np.linspace(0, length, 9),
        np.linspace(-width / 2, width / 2, 4),
        np.linspace(-thickness / 2, thickness / 2, 2),
    )

    def interfaces(nodes):
        return {
            "root": Interface(within(nodes, (None, None, None), (0, None, None)), kind="rigid", held="frame"),
            "tip": Interface(within(nodes, (length, None, None), (None, None, None)), held="nothing"),
        }

    return Part("panel", mesh, SANDWICH, 6, interfaces)


PARTS = (bracket, crank, panel)


def main():
    """Writes the files and describes them."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    for part in PARTS:
        body = part().reduce()
        path = body.save(folder / f"{part.__name__}.safetensors")
        print(f"{path}: {path.stat().st_size} bytes\n{body.describe()}\n")


if __name__ == "__main__":
    main()
