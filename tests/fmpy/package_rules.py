"""Rules of FMI 2.0 section 2.3 for the archive, and for the library in it.

They read an FMU and nothing else of the project. A rule takes an `Archive` and yields what is wrong.
"""

import re
import struct
import zipfile
from collections import Counter
from io import BytesIO

from lxml import etree
from rules import Description
from rules import problems as problems_of_description

FOLDERS = {"binaries", "documentation", "extra", "resources", "sources", "terminalsAndIcons"}
EXTENSIONS = {"linux": ".so", "win": ".dll", "darwin": ".dylib", "windows": ".dll"}
PLATFORM = re.compile(r"(linux|win|darwin)(32|64)|(?:x86_64|x86|aarch64|aarch32)-(linux|windows|darwin)")
# Largest "version needed to extract" that FMI 2.0 allows; zip64 needs 45.
MOST_VERSION = 20
# Bits of the flags of an entry.
ENCRYPTED, SIZE_FOLLOWS = 0b100_0001, 0b1000
ZIP64_FIELD, ZIP64_LOCATOR = 0x0001, b"PK\x06\x07"
SYMBOLIC_LINK = 0o120000
LOCAL_HEADER = struct.Struct("<4s5H3L2H")
FUNCTIONS = """
    GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance
    SetupExperiment EnterInitializationMode ExitInitializationMode Terminate Reset
    GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString
    GetFMUstate SetFMUstate FreeFMUstate
    SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate
    GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives
    DoStep CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus
""".split()
# Section types of ELF, and the section number of a symbol that is only wanted.
DYNAMIC_SYMBOLS, UNDEFINED = 11, 0


class Archive:
    """The bytes of an FMU and what is in it."""

    def __init__(self, content):
        self.content = content
        self.zip = zipfile.ZipFile(BytesIO(content))
        self.entries = self.zip.infolist()
        self.names = [entry.orig_filename for entry in self.entries]

    def binaries(self):
        return [name for name in self.names if name.startswith("binaries/") and not name.endswith("/")]

    def xml(self, name):
        """An XML file of the archive, parsed; None where there is none."""
        return etree.fromstring(self.zip.read(name)) if name in self.zip.namelist() else None

    def identifier(self):
        root = self.xml("modelDescription.xml")
        slave = None if root is None else root.find("CoSimulation")
        return None if slave is None else slave.get("modelIdentifier")


def entries(archive):
    """Methods, versions and flags that every importer knows."""
    for entry in archive.entries:
        told = entry.orig_filename
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            yield f"{told}: compression method {entry.compress_type}"
        if entry.extract_version > MOST_VERSION:
            yield f"{told}: version {entry.extract_version} is needed to extract"
        if entry.flag_bits & ENCRYPTED:
            yield f"{told} is encrypted"
        if entry.flag_bits & SIZE_FOLLOWS and entry.compress_type != zipfile.ZIP_DEFLATED:
            yield f"{told} is stored and its size follows"
        if (entry.external_attr >> 16) & 0o170000 == SYMBOLIC_LINK:
            yield f"{told} is a link"
        yield from local_header(archive, entry)


def local_header(archive, entry):
    """What stands before the data must be what the directory at the end says."""
    fields = LOCAL_HEADER.unpack_from(archive.content, entry.header_offset)
    signature, version, flags, method, length = *fields[:4], fields[9]
    start = entry.header_offset + LOCAL_HEADER.size
    name = archive.content[start : start + length]
    expected = (b"PK\x03\x04", entry.flag_bits, entry.compress_type, entry.orig_filename.encode())
    if (signature, flags, method, name) != expected or version > MOST_VERSION:
        yield f"{entry.orig_filename}: the header before the data is another"


def no_zip64(archive):
    if ZIP64_LOCATOR in archive.content[-200:]:
        yield "a zip64 directory"
    for entry in archive.entries:
        fields = entry.extra
        while len(fields) >= 4:
            kind, size = struct.unpack_from("<2H", fields)
            if kind == ZIP64_FIELD:
                yield f"{entry.orig_filename}: a zip64 field"
            fields = fields[4 + size :]


def paths(archive):
    """Unique, relative, with slashes; folders that the standard knows."""
    yield from (f"{name} comes {n} times" for name, n in Counter(archive.names).items() if n > 1)
    for name in archive.names:
        parts = name.split("/")
        if "\\" in name or ".." in parts or name.startswith("/") or ":" in name:
            yield f"{name} is no path"
        if len(parts) > 1 and parts[0] not in FOLDERS:
            yield f"{name}: {parts[0]} is no folder of an FMU"
    if "modelDescription.xml" not in archive.names:
        yield "there is no modelDescription.xml at the root"
    if any(name.startswith("documentation/") for name in archive.names):
        if "documentation/index.html" not in archive.names:
            yield "documentation without index.html"


def libraries(archive):
    """Folders and names by which importers find them."""
    found = archive.binaries()
    if not found:
        yield "there is no library"
    for name in found:
        _, platform, *rest = name.split("/")
        known = PLATFORM.fullmatch(platform)
        if known is None:
            yield f"{name}: {platform} is no platform"
        elif rest != [f"{archive.identifier()}{EXTENSIONS[known[1] or known[3]]}"]:
            yield f"{name} is not named after the model"


def symbols(archive):
    """Every function is exported, whether its capability is offered or not [2.1.2]; of ELF libraries."""
    for name in archive.binaries():
        library = archive.zip.read(name)
        if library.startswith(b"\x7fELF"):
            missing = [f"fmi2{f}" for f in FUNCTIONS if f"fmi2{f}" not in exported(library)]
            if missing:
                yield f"{name} does not export {', '.join(missing)}"


def exported(library):
    """Names that a 64-bit little-endian ELF library defines for others."""
    (table,) = struct.unpack_from("<Q", library, 0x28)
    size, count = struct.unpack_from("<2H", library, 0x3A)
    sections = [struct.unpack_from("<2I4Q2I2Q", library, table + i * size) for i in range(count)]
    (dynamic,) = [section for section in sections if section[1] == DYNAMIC_SYMBOLS]
    strings = sections[dynamic[6]][4]
    found = set()
    for at in range(dynamic[4], dynamic[4] + dynamic[5], dynamic[9]):
        name, _, _, section = struct.unpack_from("<I2BH", library, at)
        if section != UNDEFINED:
            start = strings + name
            found.add(library[start : library.index(b"\0", start)].decode())
    return found


RULES = (no_zip64, paths, libraries, symbols)


def problems(content):
    """What is wrong with an FMU, by the rules of this file and those of `rules`."""
    archive = Archive(content)
    unreadable = [f"entries: {text}" for text in entries(archive)]
    if unreadable:
        return unreadable
    found = [f"{rule.__name__}: {text}" for rule in RULES for text in rule(archive)]
    root = archive.xml("modelDescription.xml")
    if root is not None:
        terminals = archive.xml("terminalsAndIcons/terminalsAndIcons.xml")
        found += problems_of_description(Description(root, terminals))
    return found
