"""Elastic solutions of an unconstrained model: static ones with inertia relief, and natural modes."""

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from flexbody._errors import Error

# Least shift over the first eigenvalue, and largest, with which a factorization is kept.
SHIFTS = (1e-4, 0.2)
# Shift over the first eigenvalue that is aimed at.
SHIFT = 1e-2
# Largest strain energy of a rigid motion, over that of a displacement field of the same size that deforms the body.
RIGID_ENERGY = 1e-6
# Strain energy of a motion, over the sum of its terms, below which it is roundoff.
ROUNDOFF = 1e-14
# Relative residual at which the refinement of a static solution ends, and most refinements.
RESIDUAL = 1e-12
REFINEMENTS = 40
# Displacement shapes whose part of mass 1 outside the others is below this are dropped as dependent.
DEPENDENT = 1e-9
# Share of the mass norm that must be left of a shape without its rigid part.
RIGID_SHARE = 1e-8
# Natural modes up to this number are found by a dense solver if they are most of them.
DENSE = 400


class ElasticModel:
    """Stiffness and mass of a free body, with its rigid motions and one factorization of the shifted stiffness.

    mass, stiffness: sparse matrices [dofs, dofs].
    rigid: rigid motions [dofs, 6], orthonormal in the mass.
    """

    def __init__(self, mass, stiffness, rigid, coordinates):
        """coordinates [dofs, 6]: twelve test fields are made of products of these displacement fields."""
        self.mass = mass
        self.stiffness = stiffness
        self.rigid = rigid
        self.moved = mass @ rigid
        self._check_rigid(coordinates)
        bound = self._bound(coordinates)
        self._factorize(SHIFT * bound)
        first = self._first()
        if not SHIFTS[0] * first <= self.shift <= SHIFTS[1] * first:
            self._factorize(SHIFT * first)

    def _check_rigid(self, fields):
        energy = np.einsum("dk,dk->k", self.rigid, self.stiffness @ self.rigid)
        other = self._of_unit_mass(fields)
        scale = np.einsum("dk,dk->k", other, self.stiffness @ other).max()
        if not np.abs(energy).max() < RIGID_ENERGY * scale:
            raise Error(
                "stiffness: expected a free body, whose rigid motions need no force; they do: is it supported, are its "
                "degrees of freedom in another order, or its nodes elsewhere?"
            )

    def _bound(self, fields):
        """An upper bound of the first eigenvalue, by smooth displacement fields (Ritz)."""
        basis = self.orthonormal(self._of_unit_mass(fields), 1e-6)
        return scipy.linalg.eigvalsh(basis.T @ (self.stiffness @ basis))[0]

    def _of_unit_mass(self, fields):
        """Fields without rigid motions, scaled to mass 1; those that are rigid are dropped."""
        masses = np.einsum("dk,dk->k", fields, self.mass @ fields)
        elastic = self.without_rigid(fields)
        left = np.einsum("dk,dk->k", elastic, self.mass @ elastic)
        kept = left > RIGID_SHARE * masses
        return elastic[:, kept] / np.sqrt(left[kept])

    def _first(self):
        """First eigenvalue of the free body, about, by inverse iteration of a block."""
        random = np.random.default_rng(0).standard_normal((self.mass.shape[0], 8))
        last = np.inf
        for _ in range(30):
            basis = self.orthonormal(self._of_unit_mass(random), 1e-12)
            values, vectors = scipy.linalg.eigh(basis.T @ (self.stiffness @ basis))
            random = self.solve(self.mass @ (basis @ vectors))
            if abs(last - values[0]) < 0.05 * abs(values[0]):
                break
            last = values[0]
        lowest = np.abs(basis @ vectors[:, 0])
        if values[0] <= ROUNDOFF * (lowest @ (abs(self.stiffness) @ lowest)):
            raise Error(
                f"stiffness: expected a body with six rigid motions, found another motion without stiffness "
                f"(eigenvalue {values[0]:.3g}): "
                "is it in several parts, is there a mechanism?"
            )
        return values[0]

    def _factorize(self, shift):
        self.shift = shift
        matrix = (self.stiffness + shift * self.mass).tocsc()
        try:
            self.factors = splu(
                matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
            )
        except RuntimeError as wrong:
            raise Error(
                f"stiffness: expected a positive matrix with a shift by the mass, found a singular one ({wrong})"
            ) from None

    def solve(self, loads):
        """Solves (stiffness + shift mass) x = loads."""
        return self.factors.solve(np.ascontiguousarray(loads))

    def without_rigid(self, displacements):
        """Removes rigid motions from displacements [dofs, columns], orthogonally in the mass."""
        displacements = displacements - self.rigid @ (self.moved.T @ displacements)
        return displacements - self.rigid @ (self.moved.T @ displacements)

    def static(self, loads):
        """Static displacements under loads with inertia relief.

        loads: forces [dofs, columns]; inertia forces of the rigid acceleration that they cause balance them.

        Returns displacements [dofs, columns] orthogonal to rigid motions in the mass.
        """
        balanced = loads - self.moved @ (self.rigid.T @ loads)
        found = self.without_rigid(self.solve(balanced))
        for _ in range(REFINEMENTS):
            change = self.without_rigid(self.solve(balanced - self.stiffness @ found))
            found = found + change
            norms = np.linalg.norm(found, axis=0)
            if (np.linalg.norm(change, axis=0) <= RESIDUAL * np.where(norms > 0, norms, 1)).all():
                break
        return found

    def held_modes(self, rows, count):
        """Natural modes of the body whose rows are held (modes with fixed interfaces of Craig and Bampton).

        rows: sparse matrix [rows, dofs].
        count: how many modes, beside those that are rigid motions.

        Returns displacements [dofs, count] without their rigid parts. Motions that the rows leave free are dropped.
        """
        size = self.mass.shape[0]
        rank = int(np.linalg.matrix_rank(rows @ self.rigid)) if rows.shape[0] else 0
        wanted = min(count + 6 - rank, size - rows.shape[0] - 1)
        inverse = self._held_inverse(rows)
        if size <= DENSE or wanted > size // 3:
            vectors = self._held_dense(rows)[:, :wanted]
        else:
            start = np.random.default_rng(1).standard_normal(size)
            _, vectors = eigsh(
                self.stiffness,
                wanted,
                self.mass,
                sigma=-self.shift,
                OPinv=LinearOperator((size, size), matvec=inverse, dtype=float),
                v0=inverse(self.mass @ start),
                tol=1e-11,
            )
        elastic = self.without_rigid(vectors)
        left = np.einsum("dk,dk->k", elastic, self.mass @ elastic)
        return elastic[:, left > RIGID_SHARE][:, :count]

    def _held_inverse(self, rows):
        """Solves with the shifted stiffness while rows are held by multipliers."""
        if not rows.shape[0]:
            return self.solve
        flexible = self.solve(rows.T.toarray())
        values, vectors = scipy.linalg.eigh(rows @ flexible)
        kept = values > 1e-12 * values[-1]
        pseudo = vectors[:, kept] / values[kept] @ vectors[:, kept].T

        def inverse(load):
            free = self.solve(load)
            return free - flexible @ (pseudo @ (rows @ free))

        return inverse

    def _held_dense(self, rows):
        """All modes with held rows of a small model, in order of frequency."""
        free = scipy.linalg.null_space(rows.toarray()) if rows.shape[0] else np.eye(self.mass.shape[0])
        stiffness, mass = free.T @ (self.stiffness @ free), free.T @ (self.mass @ free)
        if self.mass.diagonal().min() > 0:
            _, vectors = scipy.linalg.eigh(stiffness, mass)
        else:
            # Nodes of lumped masses have no rotary inertia: the inverse problem has a positive matrix.
            values, vectors = scipy.linalg.eigh(mass, stiffness + self.shift * mass)
            kept = values > ROUNDOFF * values[-1]
            vectors = (vectors[:, kept] / np.sqrt(values[kept]))[:, ::-1]
        return free @ vectors

    def orthonormal(self, shapes, dependent=DEPENDENT):
        """Basis of the span of shapes [dofs, columns] of mass 1, orthonormal in the mass, without dependent ones."""
        for tolerance in (dependent, 1e-3):
            values, vectors = scipy.linalg.eigh(shapes.T @ (self.mass @ shapes))
            kept = values > tolerance
            shapes = shapes @ (vectors[:, kept] / np.sqrt(values[kept]))
        return shapes

    def natural(self, shapes):
        """Natural modes within the span of shapes [dofs, columns].

        Returns eigenvalues [n] in (rad/s)^2, ascending, and modes [dofs, n], orthonormal in the mass and orthogonal to
        rigid motions.
        """
        basis = self.without_rigid(self.orthonormal(self._of_unit_mass(shapes)))
        values, vectors = scipy.linalg.eigh(basis.T @ (self.stiffness @ basis), basis.T @ (self.mass @ basis))
        return values, with_signs(basis @ vectors)


def with_signs(modes):
    """Modes [dofs, n] with signs that do not depend on roundoff: symmetric modes have two largest components."""
    signs = np.cos(np.arange(len(modes))) @ (modes / np.abs(modes).max(axis=0))
    return modes * np.where(signs < 0, -1.0, 1.0)


def rigid_sets(model, interfaces):
    """Map from the coordinates of a model with rigid node sets to its degrees of freedom: sparse matrix [dofs,
    coordinates].

    Columns of a rigid set are an orthonormal basis of its rigid motions, so that sets on a line need no special case.
    """
    free = np.ones(model.size, bool)
    blocks = []
    motions = model.rigid_motions(model.nodes.mean(axis=0))
    for interface in interfaces:
        if interface.kind != "rigid":
            continue
        own = model.columns[interface.nodes]
        own = own[own >= 0]
        if not free[own].all():
            raise Error(f"interfaces[{interface.name!r}].nodes: expected nodes in one rigid set, found some in two")
        free[own] = False
        basis, values, _ = np.linalg.svd(
            motions[own] / np.abs(motions[own]).max(axis=0, initial=1e-300), full_matrices=False
        )
        blocks.append((own, basis[:, values > 1e-9 * values[0]]))
    single = np.flatnonzero(free)
    rows, columns, values = [single], [np.arange(len(single))], [np.ones(len(single))]
    size = len(single)
    for own, basis in blocks:
        row, column = np.meshgrid(own, size + np.arange(basis.shape[1]), indexing="ij")
        rows.append(row.ravel())
        columns.append(column.ravel())
        values.append(basis.ravel())
        size += basis.shape[1]
    data = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return sparse.coo_array(data, shape=(model.size, size)).tocsc()
