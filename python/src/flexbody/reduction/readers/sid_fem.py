"""Standard input data of flexible bodies (SID_FEM): text files of FEMBS, SIMPACK, DLR FlexibleBodies and EMBSlib.

Source: Wallrapp, Standard Input Data of Flexible Members in Multibody Systems (1993); Schwertassek and Wallrapp,
Dynamik flexibler Mehrkoerpersysteme (1999), table 6.9. Where writers differ, the order of columns follows from the
numbers.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flexbody._errors import Error
from flexbody.reduction.body import InterfaceMotion
from flexbody.reduction.interface import cross_matrix
from flexbody.reduction.mean_axes import FrameIntegrals, body_in_mean_axes
from flexbody.reduction.units import unit_system

# Matrices of a body, and those of a node.
BODY = ("mdCM", "J", "Ct", "Cr", "Me", "Gr", "Ge", "Oe", "ksigma", "Ke", "De")
NODE = ("origin", "phi", "psi", "AP", "sigma")
# Values of `structure`: nothing, diagonal, symmetric, full, identity.
ZERO, DIAGONAL, SYMMETRIC, FULL, UNIT = range(5)
# Largest difference between integrals that follow from each other, over the largest of them.
DIFFERENCE = 1e-3
# What is smaller than this, over what it is compared with, is roundoff of twelve digits.
ROUNDOFF = 1e-9
# Rows and columns of the components of a symmetric tensor: of `J`, and of `Oe` by the standard and by some writers.
TENSOR = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
QUADRATIC = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


@dataclass
class Taylor:
    """A matrix by amplitudes of modes, to first order.

    order: 0 or 1. zeroth: [rows, columns]. first: [rows, modes, columns]; zero where the order is 0.
    """

    order: int
    zeroth: np.ndarray
    first: np.ndarray


@dataclass
class StandardInputData:
    """What a file of standard input data contains, in its units.

    path: name of the file, for messages.
    mass: mass of the body.
    modes: how many modes there are.
    matrices: `Taylor` by name.
    nodes: `Taylor` by name, by number of the node.
    """

    path: str
    mass: float
    modes: int
    matrices: dict
    nodes: dict


def read_sid_fem(path, interfaces, *, units="m-kg-s"):
    """Reads a body from a file of standard input data (SID_FEM).

    path: path of the file.
    interfaces: number of a node of the file, by name. Names are those of the markers of a scene.
    units: consistent unit system of the file.

    Returns a `ReducedBody`: frame and modes are changed to mean axes at the centre of mass and natural modes of the
    free body, whatever frame the file has. Where the file has geometric stiffness (`phi` of order 1, or stiffening
    parts of `Ct` or `Cr`), interfaces have second-order displacements. Stiffening in `Oe` is part of `inertia_2` either
    way. Cubic terms of the strain energy are not in such files, and are zero. Damping (`De`), rotations to second order
    and stress (`sigma`) are left out: scenes give `damping_ratio`.

    Raises `flexbody.Error` if the file is not of this format, lacks a matrix, has initial stresses, or has integrals
    that contradict each other.
    """
    data = parse_sid_fem(path)
    scale = unit_system(units)
    integrals, second_order = _integrals(data, scale)
    points = {}
    if not hasattr(interfaces, "items") or not interfaces:
        raise Error(f"interfaces: expected numbers of nodes by name, found {interfaces!r}")
    for name, number in interfaces.items():
        if not re.fullmatch(r"[A-Za-z0-9_]+", name) or name in ("surface", "stress"):
            raise Error(f"interfaces: expected a name of letters, digits and underscores, found {name!r}")
        points[name] = _point(data, number, scale.length)
    if any(point.second is not None for point in points.values()):
        second_order = True
    try:
        return body_in_mean_axes(
            integrals,
            _matrix(data, "Ke", (data.modes, data.modes)).zeroth * scale.energy,
            points,
            second_order=second_order,
            source=f"SID_FEM: {Path(path).name}",
        )
    except Error as wrong:
        raise Error(f"{path}: {wrong}") from None


def parse_sid_fem(path):
    """Parses a file of standard input data: a `StandardInputData`.

    path: path of the file. Raises `flexbody.Error` with the line that is wrong.
    """
    try:
        text = Path(path).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        raise Error(f"{path}: expected a file of standard input data, found none") from None
    parser = _Parser(path, text.splitlines())
    data = StandardInputData(str(path), 0.0, 0, {}, {})
    node = None
    # The first line is a comment with the numbers of nodes and modes.
    for name, value in parser.statements():
        if name == "mass":
            data.mass = parser.number(value)
        elif name == "nelastq":
            data.modes = parser.integer(value)
        elif name == "new node":
            node = data.nodes.setdefault(parser.integer(value), {})
        elif name == "end node":
            node = None
        elif name == "rframe" and value.lower() not in ("body ref", "body_ref", ""):
            parser.fail("nodes in the frame `body ref`", value)
        elif name in BODY and not value:
            data.matrices[name] = parser.taylor(name)
        elif name in NODE and not value and node is not None:
            node[name] = parser.taylor(name)
    if not data.modes > 0:
        raise Error(f"{path}: expected the number of modes (nelastq) of standard input data, found none")
    return data


class _Parser:
    """Statements of a file: a name, or a name and a value with `=` between them."""

    def __init__(self, path, lines):
        self.path = path
        self.lines = lines
        self.line = 0

    def statements(self):
        """Names and values, one after the other, with empty values where there is no `=`."""
        while self.line < len(self.lines):
            text = self.lines[self.line]
            self.line += 1
            name, _, value = text.partition("=")
            name = " ".join(name.split())
            if name:
                yield name, value.strip()

    def fail(self, expected, found):
        """Raises an error that names the line read last."""
        raise Error(f"{self.path}: line {self.line}: expected {expected}, found {found!r:.80}")

    def number(self, text):
        """A number with `D` or `E` before its exponent."""
        try:
            value = float(re.sub("[dD]", "e", text))
        except ValueError:
            self.fail("a number", text)
        if not np.isfinite(value):
            self.fail("a finite number", text)
        return value

    def integer(self, text):
        """An integer from zero."""
        if not text.isdigit():
            self.fail("a whole number", text)
        return int(text)

    def taylor(self, name):
        """A matrix up to its line `end`."""
        sizes = {}
        zeroth = first = None
        for key, value in self.statements():
            if key == f"end {name}":
                if zeroth is None:
                    self.fail(f"order, nrow, ncol, nq and structure of {name}", key)
                return self._completed(sizes, zeroth, first)
            if key in ("order", "nrow", "ncol", "nq", "nqn", "structure"):
                sizes[key] = self.integer(value)
            elif zeroth is None:
                self.fail(f"order, nrow, ncol, nq and structure of {name}", key)
            else:
                self._set(name, key, value, zeroth, first)
            if zeroth is None and {"order", "nrow", "ncol", "nq", "structure"} <= set(sizes):
                if max(sizes["nrow"], sizes["ncol"]) * max(sizes["nq"], 1) > 10_000_000:
                    self.fail("a matrix of at most ten million numbers", sizes)
                zeroth = np.zeros((sizes["nrow"], sizes["ncol"]))
                first = np.zeros((sizes["nrow"], sizes["nq"], sizes["ncol"]))
        return self.fail(f"end {name}", "the end of the file")

    def _set(self, name, key, value, zeroth, first):
        """Sets an entry `m0(row, column)` or `m1(row, mode, column)`."""
        match = re.fullmatch(r"m([01])\s*\(\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+)\s*)?\)", key)
        if match is None or (match[1] == "1") != (match[4] is not None):
            self.fail(f"m0(row, column) or m1(row, mode, column) of {name}, or end {name}", key)
        matrix = zeroth if match[1] == "0" else first
        place = tuple(int(part) - 1 for part in match.groups()[1:] if part is not None)
        if any(not 0 <= at < size for at, size in zip(place, matrix.shape, strict=True)):
            self.fail(
                f"indices up to {list(matrix.shape)} (row, {'column' if matrix.ndim == 2 else 'mode, column'})", key
            )
        matrix[place] = self.number(value)

    def _completed(self, sizes, zeroth, first):
        structure = sizes["structure"]
        if structure == UNIT:
            zeroth = np.eye(*zeroth.shape)
        elif structure == SYMMETRIC:
            # One triangle, or both.
            if zeroth.shape[0] != zeroth.shape[1]:
                self.fail("a square matrix of structure 2", list(zeroth.shape))
            zeroth = np.where(zeroth == 0, zeroth.T, zeroth)
            first = np.where(first == 0, first.transpose(2, 1, 0), first)
        elif structure not in (ZERO, DIAGONAL, FULL):
            self.fail("a structure from 0 to 4", structure)
        return Taylor(sizes["order"], zeroth, first)


def _matrix(data, name, shape, required=True):
    """A matrix of the body, with its shape checked; zeros of order 0 where it is not there and need not be."""
    if name not in data.matrices:
        if required:
            raise Error(f"{data.path}: expected the matrix {name}, found {', '.join(data.matrices) or 'none'}")
        return Taylor(0, np.zeros(shape), np.zeros((shape[0], data.modes, shape[1])))
    found = data.matrices[name]
    if found.zeroth.shape != shape:
        raise Error(f"{data.path}: {name}: expected {shape[0]} rows and {shape[1]} columns, found {found.zeroth.shape}")
    if found.order == 0:
        return Taylor(0, found.zeroth, np.zeros((shape[0], data.modes, shape[1])))
    if found.first.shape[1] != data.modes:
        raise Error(f"{data.path}: {name}: expected nq = {data.modes} modes, found {found.first.shape[1]}")
    return found


def _integrals(data, units):
    """`FrameIntegrals` in SI units, and whether the file has displacements of second order."""
    count = data.modes
    if np.abs(_matrix(data, "ksigma", (count, 1), required=False).zeroth).max() > 0:
        raise Error(f"{data.path}: ksigma: expected a body without initial stresses, found some")
    inertia, inertia_1 = _inertia(data)
    translation, rotation = (_matrix(data, name, (count, 3)) for name in ("Ct", "Cr"))
    first = _first(data, inertia_1, rotation.zeroth)
    inertia_1 = _turned_first(first)
    by_spin = _matrix(data, "Oe", (count, 6))
    if by_spin.order == 0:
        raise Error(
            f"{data.path}: Oe: expected order 1, found order 0: the centrifugal forces on deformed bodies are missing"
        )
    inertia_2 = _quadratic_forms(by_spin.first, _columns(data, by_spin.zeroth, inertia_1))
    second_translation = _symmetric(translation.first)
    second_rotation = _symmetric(rotation.first)
    coupling = (rotation.first.transpose(1, 0, 2) - rotation.first) / 2
    if rotation.order == 0:
        coupling = _coupling_of_ge(data)
    mass, length = units.mass, units.length
    area, natural = mass * length**2, np.abs(translation.zeroth).max() + np.abs(coupling).max()
    stiffening = max(np.abs(second_translation).max(), np.abs(second_rotation).max())
    products = np.trace(inertia_2, axis1=2, axis2=3)[:, :, None, None] * np.eye(3) / 2 - inertia_2
    return (
        FrameIntegrals(
            mass=data.mass * mass,
            moment=_matrix(data, "mdCM", (3, 1)).zeroth[:, 0] * mass * length,
            moments=(np.trace(inertia) / 2 * np.eye(3) - inertia) * area,
            translation=translation.zeroth * mass * length,
            first=first * area,
            modal_mass=_matrix(data, "Me", (count, count)).zeroth * area,
            products=products * area,
            coupling=coupling * area,
            second_translation=second_translation * mass * length,
            second_rotation=second_rotation * area,
        ),
        bool(stiffening > ROUNDOFF * natural),
    )


def _inertia(data):
    """Inertia about the origin [3, 3] and its change by amplitudes [n, 3, 3], or None where the file lacks it."""
    given = data.matrices.get("J")
    if given is not None and given.zeroth.shape == (6, 1):
        found = _matrix(data, "J", (6, 1))
        return _tensor(found.zeroth[:, 0], TENSOR), None if found.order == 0 else _tensor(
            found.first[:, :, 0].T, TENSOR
        )
    found = _matrix(data, "J", (3, 3))
    return found.zeroth, None if found.order == 0 else _symmetric_tensor(found.first.transpose(1, 0, 2))


def _tensor(values, order):
    """Symmetric tensors [..., 3, 3] of six components [..., 6]."""
    values = np.asarray(values)
    found = np.zeros((*values.shape[:-1], 3, 3))
    for at, (row, column) in enumerate(order):
        found[..., row, column] = found[..., column, row] = values[..., at]
    return found


def _symmetric_tensor(tensors):
    return (tensors + tensors.swapaxes(-1, -2)) / 2


def _symmetric(values):
    """Symmetric part of values by two modes [n, n, ...]."""
    return (values + values.transpose(1, 0, 2)) / 2


def _turned_first(first):
    """Change of inertia by amplitudes [n, 3, 3] from the integrals of phi_k r^T."""
    traces = np.trace(first, axis1=1, axis2=2)
    return 2 * traces[:, None, None] * np.eye(3) - first - first.transpose(0, 2, 1)


def _first(data, inertia_1, rotation):
    """Integrals of phi_k r^T [n, 3, 3]: the symmetric part from `J`, or `Gr`, the other from `Cr`."""
    if inertia_1 is None:
        # Gr_k = 2 (tr(C) I - C) with C = integral of phi_k r^T.
        blocks = _matrix(data, "Gr", (3, 3 * data.modes)).zeroth.reshape(3, data.modes, 3).transpose(1, 0, 2)
        inertia_1 = _symmetric_tensor(blocks)
    traces = np.trace(inertia_1, axis1=1, axis2=2) / 4
    skew = np.array([cross_matrix(vector) for vector in rotation]) / 2
    return traces[:, None, None] * np.eye(3) - inertia_1 / 2 + skew


def _quadratic_forms(values, order):
    """Tensors [..., 3, 3] of minus the quadratic forms of spins whose coefficients are given [..., 6]."""
    weights = np.array([1.0 if row == column else 0.5 for row, column in order])
    return _tensor(-values * weights, order)


def _columns(data, values, inertia_1):
    """Order of the columns of `Oe`: minus half of the change of inertia must follow from its constant part."""
    wanted = inertia_1 / 2
    scale = np.abs(wanted).max()
    differences = {order: np.abs(_quadratic_forms(values, order) - wanted).max() for order in (QUADRATIC, TENSOR)}
    order = min(differences, key=differences.get)
    if differences[order] > DIFFERENCE * scale:
        raise Error(
            f"{data.path}: Oe: expected centrifugal forces that are half the change of inertia J by amplitudes, found "
            f"differences of {differences[order]:.3g} beside {scale:.3g}: is the file complete?"
        )
    return order


def _coupling_of_ge(data):
    """Integrals of phi_k x phi_l [n, n, 3] from `Ge`, in the order of columns that is antisymmetric."""
    given = _matrix(data, "Ge", (data.modes, 3 * data.modes)).zeroth
    # Ge_ij = 2 * integral of phi_j x phi_i.
    orders = [given.reshape(-1, data.modes, 3), given.reshape(-1, 3, data.modes).transpose(0, 2, 1)]
    found = min(orders, key=lambda blocks: np.abs(blocks + blocks.transpose(1, 0, 2)).max())
    if np.abs(found + found.transpose(1, 0, 2)).max() > DIFFERENCE * np.abs(found).max():
        raise Error(f"{data.path}: Ge: expected an array that is antisymmetric in the modes, found another")
    return (found.transpose(1, 0, 2) - found) / 4


def _point(data, number, length):
    """Motion of a node in the frame of the file, in SI units."""
    if number not in data.nodes:
        known = ", ".join(str(one) for one in list(data.nodes)[:10])
        raise Error(f"{data.path}: expected the number of a node ({known}), found {number!r}")
    node = data.nodes[number]
    for name, columns in (("origin", 1), ("phi", data.modes)):
        if name not in node or node[name].zeroth.shape != (3, columns):
            raise Error(f"{data.path}: node {number}: expected {name} with 3 rows and {columns} columns")
    psi = node.get("psi")
    has_rotation = psi is not None and psi.zeroth.shape == (3, data.modes) and np.abs(psi.zeroth).max() > 0
    second = None
    if node["phi"].order > 0 and np.abs(node["phi"].first).max() > 0:
        second = node["phi"].first * length
        second = (second + second.transpose(0, 2, 1)) / 2
    return InterfaceMotion(
        node["origin"].zeroth[:, 0] * length,
        node["phi"].zeroth * length,
        psi.zeroth if has_rotation else None,
        second,
    )
