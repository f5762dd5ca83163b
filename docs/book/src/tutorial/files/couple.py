"""Couples the crane with a controller of the trolley's speed: python couple.py STEP"""

import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


class Unit:
    """An FMU that runs, its variables by name."""

    def __init__(self, file, **start):
        description = read_model_description(file)
        self.numbers = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(file),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        for name, value in start.items():
            self.set(name, value)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, name):
        return self.fmu.getReal([self.numbers[name]])[0]

    def set(self, name, value):
        self.fmu.setReal([self.numbers[name]], [value])


step = float(sys.argv[1])
crane = Unit("crane.fmu")
controller = Unit("partners/pi_controller.fmu", reference=0.5, proportional_gain=600.0, integral_gain=400.0)

for number in range(round(2.0 / step)):
    # All inputs first, then all steps: the scheme of Jacobi.
    controller.set("measured", crane.get("trolley.centre.velocity[1]"))
    crane.set("trolley.centre.force[1]", controller.get("command"))
    for unit in (crane, controller):
        unit.fmu.doStep(number * step, step)

for name in ("trolley.centre.position[1]", "trolley.centre.velocity[1]", "crate.centre.position[1]"):
    print(name, crane.get(name))
