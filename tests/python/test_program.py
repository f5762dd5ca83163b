"""Scenes handed to the program."""

import json
import subprocess
import sys
import zipfile

import flexbody
import pytest
from conftest import NAME, ROOT
from flexbody import _program
from flexbody.scene import Scene


def test_columns_are_what_the_program_writes(program, swing, tmp_path):
    table = tmp_path / "outputs.csv"
    options = ["--stop-time", "0.3", "--set", "rod.density=6000.0", "--set", "rod.elements=3"]
    subprocess.run([program, "simulate", swing, "--output", table, *options], check=True)
    given = {"stop_time": 0.3, "values": {"rod.density": 6000, "rod.elements": 3}}
    columns = flexbody.simulate(Scene.from_file(swing), **given)
    assert columns == flexbody.simulate(swing, **given)
    names, *rows = [line.split(",") for line in table.read_text(encoding="utf-8").splitlines()]
    assert list(columns) == names
    assert list(zip(*columns.values(), strict=True)) == [tuple(map(float, row)) for row in rows]
    assert columns["time"][-1] == 0.3


def test_inputs_vary_in_time(program, swing):
    pull = {"time": [0.0, 1.0], "rod.tip.force[1]": [0.0, 0.0], "rod.tip.force[2]": [0.0, 2.0]}
    pulled = flexbody.simulate(swing, stop_time=0.5, step=0.1, input=pull)
    free = flexbody.simulate(swing, stop_time=0.5, step=0.1)
    assert len(free["time"]) == 6
    assert pulled["rod.tip.position[2]"][-1] > free["rod.tip.position[2]"][-1]


def test_errors_are_the_programs_own(program, swing, tmp_path):
    scene = Scene.from_file(swing)
    scene.joints[0].markers = ["ground", "rod.rot"]
    with pytest.raises(flexbody.Error) as wrong:
        flexbody.simulate(scene)
    message = str(wrong.value)
    assert message.startswith("swing.json: joints[0].markers[1]: expected a marker") and "rod.rot" in message
    with pytest.raises(flexbody.Error, match="no variable of this name"):
        flexbody.simulate(swing, values={"rod.densty": 1.0})
    with pytest.raises(flexbody.Error, match=r"none\.json"):
        flexbody.simulate(tmp_path / "none.json")


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for the program is a script of sh")
def test_progress_is_no_part_of_an_error(tmp_path, monkeypatch):
    stand_in = tmp_path / "flexbody"
    stand_in.write_text("#!/bin/sh\necho '... planning for 10 s' >&2\necho 'flexbody: no start' >&2\nexit 1\n")
    stand_in.chmod(0o755)
    monkeypatch.setenv(_program.PROGRAM, str(stand_in))
    with pytest.raises(flexbody.Error) as told:
        _program.run("plan")
    assert str(told.value) == "no start"


def test_scenes_become_pages(program, swing, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = flexbody.view(Scene.from_file(swing), open=False)
    assert page.name == "swing.html"
    assert (tmp_path / page).read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


def test_scenes_become_fmus(program, swing, fmu, tmp_path, monkeypatch):
    commands = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    if "package" not in commands:
        pytest.skip("this program packages nothing")
    monkeypatch.chdir(tmp_path)
    path = flexbody.package(Scene.from_file(swing), animation=False)
    assert path.name == "swing.fmu"
    with zipfile.ZipFile(tmp_path / path) as made, zipfile.ZipFile(fmu) as expected:
        assert {name for name in made.namelist() if name.startswith("binaries")}
        # The same scene, whoever wrote it.
        for name in ["resources/scene.json", "modelDescription.xml"]:
            assert made.read(name) == expected.read(name), name


def test_the_program_is_found_where_it_lies(tmp_path, monkeypatch):
    for variable in ["FLEXBODY_PROGRAM", "PATH"]:
        monkeypatch.delenv(variable, raising=False)
    product = tmp_path / "package" / "product"
    monkeypatch.setattr(_program, "PRODUCT", product)
    with pytest.raises(flexbody.Error, match="neither in .* nor named by FLEXBODY_PROGRAM nor on PATH"):
        flexbody.program()
    places = [tmp_path / "path", tmp_path / "named", product]
    variables = ["PATH", "FLEXBODY_PROGRAM", None]
    for place, variable in zip(places, variables, strict=True):
        place.mkdir(parents=True)
        program = place / NAME
        program.touch(mode=0o755)
        if variable:
            monkeypatch.setenv(variable, str(place if variable == "PATH" else program))
        assert flexbody.program() == program
    program.unlink()
    monkeypatch.setenv("FLEXBODY_PROGRAM", str(tmp_path / "nothing"))
    with pytest.raises(flexbody.Error, match="FLEXBODY_PROGRAM: .* does not exist"):
        flexbody.program()


def test_the_command_is_the_program(program):
    command = [sys.executable, "-m", "flexbody", "schema"]
    found = subprocess.run(command, capture_output=True, text=True, check=True, encoding="utf-8").stdout
    schema = (ROOT / "scenes" / "scene.schema.json").read_text(encoding="utf-8")
    assert json.loads(found) == json.loads(schema)
    wrong = subprocess.run([sys.executable, "-m", "flexbody", "simulate"], capture_output=True, check=False)
    assert wrong.returncode == 2
