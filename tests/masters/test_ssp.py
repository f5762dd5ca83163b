"""Archives of the coupled systems are what SSP 1.0 says; masters run them in `test_masters.py`."""

from pathlib import Path

import pytest
from fmpy.ssp.ssd import read_ssd
from ssp import archive

HERE = Path(__file__).parent


@pytest.mark.parametrize("name", [path.stem for path in sorted(HERE.glob("systems/*.json"))])
def test_the_structure_is_valid(systems, tmp_path, name):
    system = systems.resolved(name)
    step = system["steps"][-1]
    description = read_ssd(str(archive({**system, "step": step}, tmp_path / f"{name}.ssp", name)), validate=True)
    assert description.version == "1.0"
    assert {element.name for element in description.system.elements} == set(system["units"])
    assert len(description.system.connections) == len(system["connections"])
