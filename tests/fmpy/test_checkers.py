"""Every checker on the FMU of every scene, and on planted faults: a checker that notices nothing proves nothing.

The XSDs, fmpy and our own rules here; fmi-rs on the same scenes and faults in `crates/fmi-rs-checker/`.
"""

import json
import zipfile
from io import BytesIO
from pathlib import Path

import fmpy
import package_rules
import pytest
import rules
from conftest import ROOT, all_scenes, place_of
from fmpy.validation import validate_fmu
from lxml import etree

CHECKERS = ROOT / "tests" / "checkers"
GOOD = (CHECKERS / "good.xml").read_text(encoding="utf-8")
TERMINALS = (CHECKERS / "terminals.xml").read_text(encoding="utf-8")
FAULTS = json.loads((CHECKERS / "faults.json").read_text(encoding="utf-8"))


def schema(path):
    return etree.XMLSchema(etree.parse(Path(fmpy.__file__).parent / "schema" / path))


DESCRIPTION_SCHEMA = schema("fmi2/fmi2ModelDescription.xsd")
# FMI 2.0.4 takes terminals over from FMI 3.0.
TERMINALS_SCHEMA = schema("fmi3/fmi3TerminalsAndIcons.xsd")


def against(xsd, root):
    """What a schema says about a parsed file."""
    xsd.validate(root)
    return [error.message for error in xsd.error_log]


@pytest.mark.parametrize("path", all_scenes(), ids=place_of)
def test_nothing_is_wrong_with_any_scene(path, fmu_of):
    fmu = fmu_of(path)
    archive = package_rules.Archive(fmu.path.read_bytes())
    terminals = archive.xml("terminalsAndIcons/terminalsAndIcons.xml")
    assert against(DESCRIPTION_SCHEMA, archive.xml("modelDescription.xml")) == []
    assert terminals is None or against(TERMINALS_SCHEMA, terminals) == []
    assert validate_fmu(str(fmu.path)) == []
    assert package_rules.problems(archive.content) == []


def noticing(description, terminals, folder):
    """Names of checkers and rules that notice something, and all that is said."""
    root, ports = etree.fromstring(description.encode()), etree.fromstring(terminals.encode())
    (folder / "modelDescription.xml").write_text(description, encoding="utf-8")
    said = {
        "xsd": against(DESCRIPTION_SCHEMA, root) + against(TERMINALS_SCHEMA, ports),
        "fmpy": validate_fmu(str(folder)),
    }
    for problem in rules.problems(rules.Description(root, ports)):
        said.setdefault(problem.split(":")[0], []).append(problem)
    return {name for name, problems in said.items() if problems}, said


def test_nothing_is_wrong_with_the_good_description(tmp_path):
    found, said = noticing(GOOD, TERMINALS, tmp_path)
    assert found == set(), said


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault["fault"])
def test_a_planted_fault_is_noticed_as_the_table_says(fault, tmp_path):
    assert GOOD.count(fault["old"]) == 1
    found, said = noticing(GOOD.replace(fault["old"], fault["new"]), TERMINALS, tmp_path)
    assert fault["rule"] in found, said
    outside = {"xsd", "fmpy"}
    assert found & outside == set(fault["noticed_by"]) & outside, said


@pytest.mark.parametrize(
    ("old", "new", "checker"),
    [
        ('variableName="velocity"', 'variableName="speed"', "terminals"),
        ('name="other"', 'name="end"', "terminals"),
        ('memberName="force"', 'memberName="velocity"', "terminals"),
        (' memberName="force"', "", "terminals"),
        ('matchingRule="bus"', 'matchingRule="wish"', "terminals"),
        (' matchingRule="bus"', "", "xsd"),
        (' variableName="velocity"', "", "xsd"),
        ('fmiVersion="3.0"', 'fmiVersion="2.0"', "xsd"),
    ],
)
def test_a_fault_of_terminals_is_noticed(old, new, checker, tmp_path):
    assert TERMINALS.count(old) == 1
    found, said = noticing(GOOD, TERMINALS.replace(old, new), tmp_path)
    assert checker in found, said


def repacked(content, change):
    """The archive again after a function has changed its entries, a list of `[ZipInfo, data]`."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        entries = [[entry, archive.read(entry)] for entry in archive.infolist()]
    change(entries)
    target = BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry, data in entries:
            archive.writestr(entry, data)
    return target.getvalue()


def place(entries, part):
    (found,) = [entry for entry in entries if part in entry[0].filename]
    return found


def renamed(old, new):
    def change(entries):
        for entry, _ in entries:
            entry.filename = entry.filename.replace(old, new)

    return lambda content: repacked(content, change)


def marked(part, **attributes):
    def change(entries):
        for name, value in attributes.items():
            setattr(place(entries, part)[0], name, value)

    return lambda content: repacked(content, change)


def data_replaced(part, old, new):
    def change(entries):
        entry = place(entries, part)
        assert old in entry[1]
        entry[1] = entry[1].replace(old, new)

    return lambda content: repacked(content, change)


def twice(content):
    with pytest.warns(UserWarning, match="Duplicate name"):
        return repacked(content, lambda entries: entries.append(place(entries, "scene.json")))


def flagged(content, flag):
    """A bit of the flags set in the directory, and in the header before the data of the first entry."""
    changed = bytearray(content)
    changed[changed.index(b"PK\x01\x02") + 8] |= flag
    changed[6] |= flag
    return bytes(changed)


ARCHIVE_FAULTS = {
    "a backslash": (renamed("resources/", "resources\\"), "paths"),
    "a path out of the archive": (renamed("resources/", "resources/../"), "paths"),
    "a folder that no FMU has": (renamed("resources/", "resource/"), "paths"),
    "everything in a folder": (renamed("", "swing/"), "paths"),
    "a documentation nobody finds": (renamed("index.html", "start.html"), "paths"),
    "an entry twice": (twice, "paths"),
    "a link": (marked("scene.json", external_attr=0o120777 << 16), "entries"),
    "bzip2": (marked("scene.json", compress_type=zipfile.ZIP_BZIP2), "entries"),
    "a version above 2.0": (marked("scene.json", extract_version=45), "entries"),
    "encryption": (lambda content: flagged(content, 1), "entries"),
    "a header that says otherwise": (lambda content: content[:6] + b"\x02" + content[7:], "entries"),
    "a zip64 field": (marked("scene.json", extra=b"\x01\x00\x00\x00"), "no_zip64"),
    "a library of another name": (renamed("flexbody.", "libflexbody."), "libraries"),
    "an unknown platform": (renamed("binaries/", "binaries/my"), "libraries"),
    "no library": (renamed("binaries/", "extra/"), "libraries"),
    "a function missing": (data_replaced("binaries/", b"fmi2CancelStep\0", b"fmi2CancelStop\0"), "symbols"),
}


@pytest.mark.parametrize("fault", ARCHIVE_FAULTS)
def test_a_fault_of_the_archive_is_noticed(fault, swing):
    plant, rule = ARCHIVE_FAULTS[fault]
    found = package_rules.problems(plant(swing.path.read_bytes()))
    assert rule in {problem.split(":")[0] for problem in found}, found
