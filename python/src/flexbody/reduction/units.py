"""Unit systems of finite element models, and their conversion to SI."""

from dataclasses import dataclass

from flexbody._errors import Error

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
# A slinch is accelerated by one inch per second squared by one pound-force.
MASSES = {"kg": 1.0, "t": 1e3, "g": 1e-3, "lb": 0.45359237, "slug": 14.593902937206365, "slinch": 175.12683524647638}
TIMES = {"s": 1.0, "ms": 1e-3}


@dataclass(frozen=True)
class UnitSystem:
    """Base units of a consistent unit system, in SI units.

    length: m.
    mass: kg.
    time: s.
    """

    length: float
    mass: float
    time: float

    @property
    def energy(self):
        """Unit of energy, J."""
        return self.mass * self.length**2 / self.time**2

    @property
    def stress(self):
        """Unit of stress, Pa."""
        return self.mass / (self.length * self.time**2)


def unit_system(text):
    """Reads a unit system from text such as `m-kg-s`, `mm-t-s` (N, MPa), `mm-kg-ms` (kN, GPa) or `in-slinch-s` (lbf,
    psi).

    text: length, mass and time, separated by hyphens.

    Returns a `UnitSystem`. Raises `flexbody.Error` if a unit is unknown.
    """
    parts = text.split("-")
    if len(parts) != 3:
        raise Error(f"units: expected length-mass-time such as mm-t-s, found {text!r}")
    for part, known, what in zip(parts, (LENGTHS, MASSES, TIMES), ("length", "mass", "time"), strict=True):
        if part not in known:
            raise Error(f"units: expected a unit of {what} ({', '.join(known)}), found {part!r} in {text!r}")
    return UnitSystem(LENGTHS[parts[0]], MASSES[parts[1]], TIMES[parts[2]])
