"""Claims of cases in tests/cases, through the packaged FMU."""

import json

import claims
import pytest
from conftest import FEW, case_files, meant_cases


def claim_list():
    """One test a claim."""
    found = []
    for path in meant_cases():
        case = json.loads(path.read_text(encoding="utf-8"))
        for index, claim in enumerate(case.get("claims", [])):
            name = f"{path.parent.name}-{index}-{claim.get('kind')}"
            found.append(pytest.param(path.parent, case, claim, id=name))
    return found


@pytest.mark.parametrize("path", case_files(), ids=lambda path: path.parent.name)
def test_case_names_its_source(path):
    claims.check_case(json.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize(("folder", "case", "claim"), claim_list())
def test_claim(folder, case, claim, fmu_of):
    scene = folder / claim.get("scene", case.get("scene", "scene.json"))
    try:
        claims.check(claim, folder, fmu_of(scene), case)
    except Exception as error:
        error.add_note(f"claim: {json.dumps(claim)}")
        raise


def test_the_few_cases_are_there():
    assert set(FEW) <= {path.parent.name for path in case_files()}


def test_a_claim_nobody_checks_is_refused():
    with pytest.raises(AssertionError, match="kind: expected one of"):
        claims.check({"kind": "faith"}, None, None)
    with pytest.raises(AssertionError, match="found tolerence"):
        claims.check({"kind": "values", "values": {}, "relative": 1.0, "tolerence": 1.0}, None, None)


def test_a_case_without_a_source_is_refused():
    with pytest.raises(AssertionError, match="source: expected a sentence"):
        claims.check_case({"purpose": "to pass", "claims": [{}]})
