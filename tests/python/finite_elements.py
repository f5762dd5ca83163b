"""Finite element models with answers in closed form, for several tests."""

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from flexbody.reduction import FiniteElementModel
from flexbody.reduction.readers.scikit_fem import Solid
from skfem import Basis, ElementHex1, ElementVector, MeshHex

# Roots of cos b cosh b = 1, of a free uniform rod that bends.
FREE_ROD = np.array([4.730040745, 7.853204624, 10.995607838, 14.137165491, 17.278759657, 20.420352251])


def block(elements=3):
    """A small solid away from the origin, with three degrees of freedom a node, one node after the other."""
    sides = np.linspace(0, 0.06 * elements, elements + 1), np.linspace(0, 0.03, 2), np.linspace(0, 0.01, 2)
    mesh = MeshHex.init_tensor(*sides).translated((0.1, -0.2, 0.05))
    solid = Solid(Basis(mesh, ElementVector(ElementHex1())), youngs_modulus=2.1e11, poissons_ratio=0.3, density=7850)
    order = np.lexsort((solid.model.dofs[:, 1], solid.model.dofs[:, 0]))
    matrices = [sparse.csc_array(matrix)[order][:, order] for matrix in (solid.model.mass, solid.model.stiffness)]
    return FiniteElementModel(*matrices, solid.model.nodes)


def free_frequencies(model):
    """All frequencies of a small free model that deform it, by scipy, Hz."""
    values = scipy.linalg.eigvalsh(model.stiffness.toarray(), model.mass.toarray())
    return np.sqrt(values[6:]) / (2 * np.pi)


def tensor(six):
    xx, yy, zz, xy, xz, yz = np.moveaxis(np.asarray(six), -1, 0)
    return np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), (0, 1), (-2, -1))


def beam(elements, length=1.3, modulus=2e11, density=7800.0, width=0.02, height=0.01, poissons_ratio=0.3):
    """Uniform rod along x of Euler-Bernoulli elements with six degrees of freedom a node."""
    area, step = width * height, length / elements
    polar = width * height * (width**2 + height**2) / 12
    # Bending towards y, and towards z, with rotations about z, and about -y.
    moments = {1: height * width**3 / 12, 2: width * height**3 / 12}
    size = 6 * (elements + 1)
    mass, stiffness = sparse.lil_array((size, size)), sparse.lil_array((size, size))
    line_stiffness, line_mass = np.array([[1, -1], [-1, 1]]), np.array([[2, 1], [1, 2]]) / 6
    bending = np.array(
        [[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]],
        float,
    )
    inertia = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420
    shear = modulus / (2 * (1 + poissons_ratio))
    for element in range(elements):
        first, second = 6 * element, 6 * element + 6
        for component, rigidity, inert in [(0, modulus * area, density * area), (3, shear * polar, density * polar)]:
            at = np.ix_(*[[first + component, second + component]] * 2)
            stiffness[at] += rigidity / step * line_stiffness
            mass[at] += inert * step * line_mass
        for across, moment in moments.items():
            rotation, sign = {1: (5, 1), 2: (4, -1)}[across]
            at = np.ix_(*[[first + across, first + rotation, second + across, second + rotation]] * 2)
            scale = np.array([1, sign * step, 1, sign * step])
            scale = np.outer(scale, scale)
            stiffness[at] += modulus * moment / step**3 * bending * scale
            mass[at] += density * area * step * inertia * scale
    nodes = np.zeros((elements + 1, 3))
    nodes[:, 0] = np.linspace(0, length, elements + 1)
    dofs = np.array([(node, component) for node in range(elements + 1) for component in range(6)])
    return FiniteElementModel(mass.tocsc(), stiffness.tocsc(), nodes, dofs)


def bent_frame():
    """Two rods at a right angle with masses at their nodes only, as most programs lump them."""
    rod = beam(5)
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    turn = sparse.kron(sparse.eye_array(12), quarter).tocsc()
    stiffness = np.zeros((66, 66))
    stiffness[:36, :36] += rod.stiffness.toarray()
    stiffness[30:, 30:] += (turn @ rod.stiffness @ turn.T).toarray()
    nodes = np.vstack([rod.nodes, rod.nodes[1:] @ quarter.T + rod.nodes[-1]])
    dofs = np.array([(node, component) for node in range(11) for component in range(6)])
    masses = np.where(np.isin(np.arange(11), [0, 10]), 0.5, 1.0)[dofs[:, 0]] * (dofs[:, 1] < 3)
    return FiniteElementModel(sparse.diags_array(masses).tocsc(), sparse.csc_array(stiffness), nodes, dofs)
