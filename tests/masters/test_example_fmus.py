"""The partners' FMUs themselves."""

from zipfile import ZipFile

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

PARTNERS = ["mass", "spring_damper", "pi_controller", "hydraulic_cylinder"]


@pytest.mark.parametrize("name", PARTNERS)
def test_a_partner_is_valid_and_promises_everything(systems, name):
    path = systems.partners / f"{name}.fmu"
    assert validate_fmu(str(path)) == []
    promised = read_model_description(path).coSimulation
    assert promised.canInterpolateInputs and promised.providesDirectionalDerivative
    assert promised.canSerializeFMUstate and promised.maxOutputDerivativeOrder == 2
    names = ZipFile(path).namelist()
    assert {f"documentation/licenses/{name}" for name in ("license.txt", "crates.txt", "LICENSE-MIT")} <= set(names)
