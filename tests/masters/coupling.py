"""What coupling costs in accuracy: measures for the chart `coupling` and writes its CSV files into a folder.

Two masses have closed forms for all that is measured. The beam and the mass at its tip have the
scene that holds both, which is compared with the closed form of its undamped modes."""

import csv
import sys
import tempfile
from pathlib import Path

import numpy as np
from conftest import Systems, package, xtask
from coupled import FIGURES, WAYS, BeamAndMass, TwoMasses, mass_scene
from fmpy.fmi1 import FMICallException
from masters import ecco, libcosimpy
from schemes import Asking, Extrapolating, RollbackMaster, interface, largest_stable_step

# Masters by name on the chart, with their degree.
MASTERS = {
    **{("Jacobi", d): lambda system, d=d: Extrapolating(interface(system), d) for d in (0, 1, 2)},
    **{("Gauss-Seidel", d): lambda system, d=d: Extrapolating(interface(system), d, "two") for d in (0, 1, 2)},
    **{("output derivatives", d): lambda system, d=d: Asking(interface(system), d) for d in (1, 2)},
    **{("rollback", d): lambda system, d=d: RollbackMaster(interface(system), d) for d in (1, 2)},
}
SCHEMES = {"J": "Jacobi", "GS": "Gauss-Seidel"}
# Those that no figures are known of.
OTHERS = [(way, *master) for way in WAYS for master in MASTERS if master[0] not in SCHEMES.values()]


def told(text):
    print(text, file=sys.stderr, flush=True)


def curve(make, step, stop, output, reference):
    """Largest error of an output over a run, and attempts a step; nothing where it swings beyond all bounds."""
    master = make()
    name, variable = output.split(".", 1)
    unit = master.interface.units[name]
    count, error = round(stop / step), 0.0
    try:
        for number in range(count):
            master.step(number * step, step)
            error = max(error, abs(unit.getReal([unit.numbers[variable]])[0] - reference((number + 1) * step)))
            if not error < reference.size:
                return None
    except (FMICallException, RuntimeError):
        # A unit or the master gave up: nothing is left to follow.
        return None
    finally:
        for unit in master.interface.units.values():
            unit.freeInstance()
    return error / reference.size, getattr(master, "attempts", count) / count


def curves(system, steps, stop, reference):
    """Errors of all masters at all steps; those of ECCO at its mean step."""
    rows = []

    def add(master, degree, step, error, attempts):
        rows.append({"master": master, "degree": degree, "step": step, "error": error, "attempts": attempts})

    for (master, degree), make in MASTERS.items():
        for step in steps:
            found = curve(lambda: make(system), step, stop, system["outputs"][0], reference)
            if found:
                add(master, degree, step, *found)
        told(f"  errors of {master}, degree {degree}")
    for level in range(6):
        settings = {"step": steps[0] / 2**level, "energy_tolerance": 10.0**-level}
        times, values = libcosimpy({**system, "stop": stop}, ecco(settings))[0]
        error = max(abs(value - reference(time)) for time, value in zip(times, values) if time <= stop)
        if error < reference.size:
            add("ECCO", 0, times[-1] / len(times), error / reference.size, 1.0)
    told("  errors of ECCO")
    return rows


def limits(system, rows, lowest, highest, **run):
    """Largest stable steps by way of coupling, master and degree."""
    found = []
    for way, master, degree in rows:
        known = system(way)
        make = MASTERS[master, degree]
        step = largest_stable_step(lambda: make(known), known["outputs"][0], lowest, highest, **run)
        found.append({"coupling": way, "master": master, "degree": degree, "step": step})
        told(f"  largest stable step with {way}, {master}, degree {degree}: {step}")
    return found


class Exact:
    """Position of the first mass."""

    size = 1.0

    def __init__(self, masses):
        self.masses = masses

    def __call__(self, time):
        return self.masses.exact(time)[0]


def two_masses(partners, block):
    """The figures measured anew with partners and with scenes; what other masters do."""
    figures = FIGURES["limits"]["rows"]
    rows = [(way, SCHEMES[scheme], degree) for way, scheme, degree, _ in figures]
    masses = TwoMasses(partners)
    result = {"units": {}, "figures": [row[3] for row in figures], "period": 2 * np.pi / np.abs(masses.roots.imag).max()}
    for units, made, count in (("partners", masses, 600), ("scenes", TwoMasses(partners, block), 400)):
        told(f"two masses, {units}")
        result["units"][units] = limits(made.system, rows, 0.02, 2.0, count=count)
    result["limits"] = limits(masses.system, OTHERS, 0.02, 2.0, count=300, precision=0.01)
    steps = [0.2 / 2**k for k in range(8)]
    result["curves"] = curves(masses.system("FD"), steps, 5.0, Exact(masses))
    return result


class Scenes:
    """FMUs of scenes, each packaged once."""

    def __init__(self, systems):
        self.systems = systems
        self.fmus = {}

    def __call__(self, scene, *key):
        name = "_".join([scene.__name__, *map(str, key)])
        if name not in self.fmus:
            path = self.systems.write(name, scene(*key))
            self.fmus[name] = package(path, path.with_suffix(".fmu"))
        return self.fmus[name]


class Whole:
    """Position of the tip in a run of the scene that holds the beam and the mass."""

    def __init__(self, systems, stop, is_damped):
        path = systems.write(f"whole_{is_damped}", BeamAndMass.whole_scene(is_damped))
        table = path.with_suffix(".csv")
        xtask("simulate", path, "--stop-time", stop, "--step", stop / 4000, "--output", table)
        rows = np.genfromtxt(table, delimiter=",", names=True, deletechars="")
        self.times, self.positions, self.velocities = (
            rows[name] for name in ("time", "beam.tip.position[2]", "beam.tip.velocity[2]")
        )
        self.size = np.abs(self.positions).max()

    def __call__(self, time):
        """By Hermite's cubic between the points of the run."""
        step = self.times[1]
        left = min(int(time / step + 1e-6), len(self.times) - 2)
        s = time / step - left
        x, v = self.positions[left : left + 2], self.velocities[left : left + 2] * step
        return (
            (1 + 2 * s) * (1 - s) ** 2 * x[0] + s * (1 - s) ** 2 * v[0] + s**2 * (3 - 2 * s) * x[1] + s**2 * (s - 1) * v[1]
        )


def beam(systems, package):
    """The beam and the mass: how far its reference is from the closed form, stable steps, errors."""
    told("beam and mass")
    both = BeamAndMass(systems.partners, lambda has_spring: package(BeamAndMass.beam_scene, has_spring))
    stop = 0.4
    undamped = Whole(systems, stop, is_damped=False)
    closed = BeamAndMass.closed_form(stop)
    rows = [("FD", *master) for master in MASTERS]
    rows += [(way, "Jacobi", degree) for way in ("FD'", "FF") for degree in (0, 1, 2)]
    return {
        "period": BeamAndMass.period,
        "closed_form": abs(undamped(stop) - closed[0]) / undamped.size,
        "limits": limits(both.system, rows, 1e-3, 0.05, count=150, least=1.0, precision=0.02),
        "curves": curves(both.system("FD"), [0.02 / 2**k for k in range(8)], stop, Whole(systems, stop, is_damped=True)),
    }


def write(folder, name, header, rows):
    """A CSV file; nothing is an empty field."""
    with open(Path(folder) / f"{name}.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def written(folder, masses, beam):
    """What was measured, in three files."""
    rows = [
        [name, row["master"], row["degree"], f"{row['step']:.6e}", f"{row['error']:.4e}", f"{row['attempts']:.2f}"]
        for name, system in (("two_masses", masses), ("beam", beam))
        for row in system["curves"]
    ]
    write(folder, "coupling", ["system", "master", "degree", "step_s", "error", "attempts"], rows)
    shown = lambda step: "" if step is None else f"{step:.5f}"
    rows = [
        [system, units, row["coupling"], row["master"], row["degree"], shown(row["step"]), shown(figure)]
        for system, units, found, figures in (
            *(("two_masses", units, found, masses["figures"]) for units, found in masses["units"].items()),
            ("two_masses", "partners", masses["limits"], [None] * len(masses["limits"])),
            ("beam", "scene and partner", beam["limits"], [None] * len(beam["limits"])),
        )
        for row, figure in zip(found, figures)
    ]
    write(folder, "coupling_limits", ["system", "units", "coupling", "master", "degree", "largest_stable_step_s", "figure_s"], rows)
    rows = [["two_masses", f"{masses['period']:.4e}", ""], ["beam", f"{beam['period']:.4e}", f"{beam['closed_form']:.1e}"]]
    write(folder, "coupling_systems", ["system", "period_s", "closed_form"], rows)


def main():
    with tempfile.TemporaryDirectory() as folder:
        systems = Systems(Path(folder))
        package = Scenes(systems)
        block = lambda has_spring, position: package(mass_scene, has_spring, position)
        written(sys.argv[1], two_masses(systems.partners, block), beam(systems, package))


if __name__ == "__main__":
    main()
