import math
import shutil

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


def columns(path, count):
    """Rows of numbers of a table of CalculiX."""
    with open(path, encoding="ascii") as file:
        rows = [line.split() for line in file]
    return [[float(word) for word in row] for row in rows if len(row) == count and row[0].isdigit()]


# What CalculiX found: rows of number, eigenvalue, rad/s, Hz, and the mean of the displacements at the tip.
expected = [row[3] for row in columns("clamped.dat", 5)[:5]]
tip = columns("loaded.dat", 4)
deflection = 1e-3 * sum(row[3] for row in tip) / len(tip)

description = read_model_description("lever.fmu")
folder = extract("lever.fmu")
references = {variable.name: variable.valueReference for variable in description.modelVariables}
unit = FMU2Slave(
    guid=description.guid,
    unzipDirectory=folder,
    modelIdentifier=description.coSimulation.modelIdentifier,
    instanceName="lever",
)
unit.instantiate()
unit.setupExperiment(startTime=0.0)
unit.enterInitializationMode()
unit.exitInitializationMode()


def value(name):
    return unit.getReal([references[name]])[0]


print("     CalculiX         unit    difference")
for number, known in enumerate(expected, 1):
    found = value(f"natural_frequency[{number}]") / (2 * math.pi)
    print(f"{known:10.4f} Hz {found:10.4f} Hz {abs(found / known - 1):8.0e}")
found = value("lever.tip.position[3]")
print(f"{1e3 * deflection:10.6f} mm {1e3 * found:10.6f} mm {abs(found / deflection - 1):8.0e}")

# The force is let go: the lever vibrates at its first frequency, 1 % damped.
unit.setReal([references[f"lever.tip.force[{axis}]"] for axis in (1, 2, 3)], [0.0, 0.0, 0.0])
for step in range(100):
    unit.doStep(step * 1e-3, 1e-3)
print(f"at 0.1 s: {1e3 * value('lever.tip.position[3]'):.6f} mm")
unit.terminate()
unit.freeInstance()
shutil.rmtree(folder)
