"""Example units give their reference results, with nothing known but the files beside them."""

import numpy as np
import pytest
from cross_check import SCENES, example
from fmpy import simulate_fmu
from fmpy.util import read_csv, read_ref_opt_file
from project import ROOT


@pytest.mark.parametrize("name", SCENES)
def test_an_example_gives_its_reference(tmp_path, name):
    folder = example(ROOT / "scenes" / f"{name}.json", tmp_path)
    options = read_ref_opt_file(str(folder / f"{name}_ref.opt"))
    reference = read_csv(str(folder / f"{name}_ref.csv"))
    result = simulate_fmu(
        str(folder / f"{name}.fmu"),
        start_time=options["StartTime"],
        stop_time=options["StopTime"],
        output_interval=options["StepSize"],
        relative_tolerance=options["RelTol"],
        output=[column for column in reference.dtype.names if column != "time"],
    )
    assert result.dtype.names == reference.dtype.names
    assert len(result) == len(reference)
    for column in reference.dtype.names:
        size = np.max(np.abs(reference[column]))
        assert np.max(np.abs(result[column] - reference[column])) <= 1e-3 * size + 1e-9, column
