"""Coupled systems under every master, against what they must do as a whole."""

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
SYSTEMS = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(HERE.glob("systems/*.json"))}
# Masters that step all units from one communication point, with the inputs of that point; the first
# stands for all where they must agree.
JACOBI = ["libcosimpy_fixed", "libcosimpy_ssp", "ecospy_local", "ecospy_proxy", "container_threaded"]
# Those with ways of their own: the first step without inputs, one unit after the other.
OWN_WAYS = ["fmpy_ssp", "container_sequential"]


@pytest.fixture(scope="session")
def run(systems, tmp_path_factory):
    """Outputs at the end, by a process of its own, once a session."""
    ends = {}
    # Some masters leave files where they run.
    folder = tmp_path_factory.mktemp("runs")

    def run(master, name, step):
        key = (master, name, step)
        if key not in ends:
            text = json.dumps({**systems.resolved(name), "step": step})
            command = [sys.executable, str(HERE / "masters.py"), master]
            result = subprocess.run(
                command, input=text, capture_output=True, text=True, check=False, timeout=120, cwd=folder
            )
            assert result.returncode == 0, f"{key}: {result.stderr[-2000:]}"
            ends[key] = json.loads(result.stdout)
        return ends[key]

    return run


# Masters that pass derivatives of outputs on to inputs.
DERIVATIVES = ["fmpy_lines", "fmpy_parabolas"]


def error(found, expected):
    """Greatest difference, relative to the greatest value expected."""
    return max(abs(f - e) for f, e in zip(found, expected, strict=True)) / max(map(abs, expected))


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("master", [JACOBI[0], *OWN_WAYS])
def test_errors_shrink_with_the_step(systems, run, master, name):
    claim = SYSTEMS[name]
    if master in claim.get("without", {}):
        pytest.skip(claim["without"][master])
    steps = claim["steps"][-2:]
    errors = [error(run(master, name, step), systems.end(name)) for step in steps]
    order = math.log(errors[0] / errors[1]) / math.log(steps[0] / steps[1])
    print(f"{name}, {master}: errors {errors[0]:.2e}, {errors[1]:.2e} at {steps} s, order {order:.2f}")
    assert errors[1] < claim["tolerance"]
    assert 0.7 < order < 1.4


@pytest.mark.parametrize("name", [name for name, claim in SYSTEMS.items() if "worth" in claim])
@pytest.mark.parametrize("master", DERIVATIVES)
def test_derivatives_are_worth_what_is_claimed(systems, run, master, name):
    """How many times smaller the error is than with held inputs, at the smaller step."""
    step = SYSTEMS[name]["steps"][-1]
    held, moved = (error(run(m, name, step), systems.end(name)) for m in (JACOBI[0], master))
    print(f"{name}, {master}: error {moved:.2e}, held inputs {held:.2e}, {held / moved:.0f} times")
    assert moved < held / SYSTEMS[name]["worth"][master]


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("master", JACOBI[1:])
def test_jacobi_masters_agree(systems, run, master, name):
    step = SYSTEMS[name]["steps"][-1]
    assert error(run(master, name, step), run(JACOBI[0], name, step)) < 1e-6


@pytest.mark.parametrize("name", [name for name, claim in SYSTEMS.items() if "limit" in claim])
def test_the_reference_is_near_its_limit(systems, name):
    """What is known of the system where springs between its units are stiff."""
    limit = SYSTEMS[name]["limit"]
    assert error(systems.end(name), limit["outputs"]) < limit["tolerance"]


@pytest.mark.parametrize("master", JACOBI)
def test_a_jacobi_master_makes_the_error_of_its_scheme(systems, run, master):
    """Exact units and a known error: masters, partners and figures confirm each other."""
    claim = SYSTEMS["two_mass"]
    for step, figure in zip(claim["steps"], claim["jacobi"]["errors"], strict=True):
        found = abs(run(master, "two_mass", step)[0] - systems.end("two_mass")[0])
        assert found == pytest.approx(figure, rel=1e-8), step


@pytest.mark.parametrize("name", [name for name, claim in SYSTEMS.items() if "bonds" in claim])
def test_ecco_halves_the_error_of_fixed_steps(systems, run, name):
    step = SYSTEMS[name]["steps"][-1]
    ecco, fixed = (error(run(master, name, step), systems.end(name)) for master in ("libcosimpy_ecco", JACOBI[0]))
    print(f"{name}: ECCO {ecco:.2e}, fixed steps {fixed:.2e}")
    assert ecco < 0.5 * fixed
