"""The reduced body: what is stored, written, read and described."""

import math
from dataclasses import dataclass, field

import numpy as np

from flexbody._errors import Error
from flexbody.reduction.container import FORMAT, VERSION, read_arrays, write_arrays


@dataclass
class InterfaceMotion:
    """Motion of an interface of a reduced body.

    position: undeformed position [3] in the axes and from the origin of the finite element model, m.
    modes: displacement by modes [3, n].
    rotation: small rotation vector by modes [3, n], or None.
    second: second-order displacements [3, m2, m2], or None.
    """

    position: np.ndarray
    modes: np.ndarray
    rotation: np.ndarray | None = None
    second: np.ndarray | None = None


@dataclass
class Surface:
    """Surface of a reduced body, for pictures.

    points: undeformed positions [points, 3], m.
    modes: displacement of points by modes [points, 3, n].
    triangles: indices of points [triangles, 3].
    stress: stress of points by modes [points, 6, n], Pa, or None; colours the surface.
    """

    points: np.ndarray
    modes: np.ndarray
    triangles: np.ndarray
    stress: np.ndarray | None = None


@dataclass
class ReducedBody:
    """A flexible body as modes orthonormal in the mass and orthogonal to rigid motions, in SI units.

    Axes and origin are those of the finite element model. Symmetric tensors have the components xx yy zz xy xz yz.

    mass: kg.
    centre: centre of mass [3], m.
    inertia: inertia about the centre of mass [6], kg m^2.
    eigenvalues: squares of angular frequencies [n], (rad/s)^2, ascending.
    inertia_1: change of inertia by amplitudes [n, 6].
    inertia_2: change of inertia by products of amplitudes [n, n, 6].
    coupling: integral of density times cross products of modes [n, n, 3].
    cubic: cubic coefficients of the strain energy [n, m2, m2], or None.
    interfaces: `InterfaceMotion` by name.
    surface: a `Surface`, or None.
    stress: stress by modes [6, n] by name, Pa.
    source: where the model comes from.
    highest_frequency: highest frequency that the mesh resolves, Hz, or None.
    shapes: modes [dofs, n] of the finite element model in SI units where the body was just reduced, else None. They are
        not in the file.
    """

    mass: float
    centre: np.ndarray
    inertia: np.ndarray
    eigenvalues: np.ndarray
    inertia_1: np.ndarray
    inertia_2: np.ndarray
    coupling: np.ndarray
    cubic: np.ndarray | None = None
    interfaces: dict = field(default_factory=dict)
    surface: Surface | None = None
    stress: dict = field(default_factory=dict)
    source: str = ""
    highest_frequency: float | None = None
    shapes: np.ndarray | None = field(default=None, repr=False, compare=False)

    @property
    def frequencies(self):
        """Natural frequencies of the free body [n], Hz."""
        return np.sqrt(self.eigenvalues) / (2 * math.pi)

    def cut(self, count):
        """Leaves the stiffest modes out.

        count: how many modes are kept.

        Returns a `ReducedBody`. What its second-order displacements lose by the modes left out is given back to them.
        Raises `flexbody.Error` if there are fewer modes.
        """
        size = len(self.eigenvalues)
        if not 0 < count <= size:
            raise Error(f"count: expected 1 to {size} modes, found {count}")
        kept = slice(0, count)
        second = self.inertia_2.copy()
        lost = None
        if self.cubic is not None:
            pairs = self.cubic.shape[1]
            lost = self.cubic[count:] / self.eigenvalues[count:, None, None]
            second[:pairs, :pairs] -= np.einsum("mkl,mc->klc", lost, self.inertia_1[count:])
        pairs = slice(0, min(count, 0 if self.cubic is None else self.cubic.shape[1]))
        interfaces = {}
        for name, motion in self.interfaces.items():
            at = motion.second
            if at is not None:
                at = (at - 2 * np.einsum("am,mkl->akl", motion.modes[:, count:], lost))[:, pairs, pairs]
            rotation = None if motion.rotation is None else motion.rotation[:, kept]
            interfaces[name] = InterfaceMotion(motion.position, motion.modes[:, kept], rotation, at)
        surface = self.surface
        if surface is not None:
            at = None if surface.stress is None else surface.stress[:, :, kept]
            surface = Surface(surface.points, surface.modes[:, :, kept], surface.triangles, at)
        return ReducedBody(
            mass=self.mass,
            centre=self.centre,
            inertia=self.inertia,
            eigenvalues=self.eigenvalues[kept],
            inertia_1=self.inertia_1[kept],
            inertia_2=second[kept, kept],
            coupling=self.coupling[kept, kept],
            cubic=None if self.cubic is None else self.cubic[kept, pairs, pairs],
            interfaces=interfaces,
            surface=surface,
            stress={name: rows[:, kept] for name, rows in self.stress.items()},
            source=self.source,
            highest_frequency=self.highest_frequency,
            shapes=None if self.shapes is None else self.shapes[:, kept],
        )

    def save(self, path):
        """Writes the file that the key `file` of a reduced body in a scene names.

        path: path of the file, usually `<name>.safetensors`.

        Returns the path.
        """
        arrays = {
            "mass": np.array([self.mass]),
            "centre": self.centre,
            "inertia": self.inertia,
            "eigenvalues": self.eigenvalues,
            "inertia_1": self.inertia_1,
            "inertia_2": self.inertia_2,
            "coupling": self.coupling,
        }
        if self.cubic is not None:
            arrays["cubic"] = self.cubic
        for name, motion in self.interfaces.items():
            for part in ("position", "modes", "rotation", "second"):
                if getattr(motion, part) is not None:
                    arrays[f"{name}.{part}"] = getattr(motion, part)
        for name, rows in self.stress.items():
            arrays[f"stress.{name}"] = rows
        arrays = {name: np.asarray(array, np.float64) for name, array in arrays.items()}
        if self.surface is not None:
            arrays["surface.points"] = np.asarray(self.surface.points, np.float64)
            arrays["surface.modes"] = np.asarray(self.surface.modes, np.float32)
            if self.surface.stress is not None:
                arrays["surface.stress"] = np.asarray(self.surface.stress, np.float32)
            arrays["surface.triangles"] = np.asarray(self.surface.triangles, np.uint32)
        metadata = {"format": FORMAT, "version": VERSION, "source": self.source}
        if self.highest_frequency is not None:
            metadata["highest_frequency"] = repr(float(self.highest_frequency))
        write_arrays(path, arrays, metadata)
        return path

    @classmethod
    def load(cls, path):
        """Reads a file that `save` wrote.

        path: path of the file.

        Returns a `ReducedBody`. Raises `flexbody.Error` if the file is none of a reduced body.
        """
        arrays, metadata = read_arrays(path)
        found = {key: metadata.get(key) for key in ("format", "version")}
        if found != {"format": FORMAT, "version": VERSION}:
            raise Error(f"{path}: expected the format {FORMAT!r} in version {VERSION}, found {found}")
        required = ["mass", "centre", "inertia", "eigenvalues", "inertia_1", "inertia_2", "coupling"]
        missing = [name for name in required if name not in arrays]
        if missing:
            raise Error(f"{path}: expected the arrays {', '.join(required)}; missing: {', '.join(missing)}")
        groups = {}
        for name, array in arrays.items():
            group, _, part = name.rpartition(".")
            groups.setdefault(group, {})[part] = array
        own = groups.pop("")
        surface, stress = groups.pop("surface", None), groups.pop("stress", {})
        highest = metadata.get("highest_frequency")
        try:
            return cls(
                mass=float(own.pop("mass")[0]),
                interfaces={name: InterfaceMotion(**parts) for name, parts in groups.items()},
                surface=None if surface is None else Surface(**surface),
                stress=stress,
                source=metadata.get("source", ""),
                highest_frequency=None if highest is None else float(highest),
                **own,
            )
        except (TypeError, ValueError) as wrong:
            raise Error(f"{path}: expected the arrays of a reduced body, found {wrong}") from None

    def describe(self):
        """Describes the body as text: mass, modes, interfaces."""
        frequencies = self.frequencies
        orders = "no second-order terms" if self.cubic is None else f"second-order terms of {self.cubic.shape[1]} modes"
        size = max(np.abs(place).max() for place in [self.centre, *(at.position for at in self.interfaces.values())])
        lines = [
            f"source: {self.source or 'not said'}",
            f"mass: {self.mass:.6g} kg, centre of mass: {_vector(self.centre, size)} m",
            f"inertia about it (xx yy zz xy xz yz): {_vector(self.inertia)} kg m^2",
            f"modes: {len(frequencies)}, {orders}",
            "frequencies of the free body: " + ", ".join(f"{value:.5g}" for value in frequencies) + " Hz",
        ]
        if self.highest_frequency is not None:
            lines.append(f"highest frequency that the mesh resolves: {self.highest_frequency:.5g} Hz")
        for name, motion in self.interfaces.items():
            what = "position" if motion.rotation is None else "position and orientation"
            lines.append(f"interface {name}: {what}, at {_vector(motion.position, size)} m")
        if self.surface is not None:
            stress = "" if self.surface.stress is None else ", with stress"
            lines.append(f"surface: {len(self.surface.points)} points, {len(self.surface.triangles)} triangles{stress}")
        lines += [f"stress {name}" for name in self.stress]
        return "\n".join(lines)


def _vector(values, size=0.0):
    """Text of a vector, with zero for what is roundoff beside its largest component, or beside a size."""
    values = np.where(np.abs(values) < 1e-9 * max(np.abs(values).max(), size), 0.0, values)
    return "(" + ", ".join(f"{value:.6g}" for value in values) + ")"
