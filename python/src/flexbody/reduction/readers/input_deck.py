"""Nodes of input files of Abaqus and CalculiX."""

import numpy as np

from flexbody._errors import Error

# Most levels of files that include each other.
INCLUDES = 10


def read_nodes(path):
    """Reads the nodes of an input file: lines of `*NODE`, also in files that `*INCLUDE` names.

    path: path of the file.

    Returns coordinates [3] by number of the node, in the units of the file. Raises `flexbody.Error` if there are none.
    Nodes of parts that an assembly moves are not moved: write a flat input file for these.
    """
    nodes = {}
    for keyword, line in _data_lines(path, INCLUDES):
        if keyword != "NODE":
            continue
        words = [word.strip() for word in line.split(",")]
        try:
            # Coordinates that are left out are zero.
            place = [float(word) if word else 0.0 for word in words[1:4]]
            nodes[int(words[0])] = np.array(place + [0.0] * (3 - len(place)))
        except ValueError:
            raise Error(f"{path}: expected the number of a node and three coordinates, found {line!r}") from None
    if not nodes:
        raise Error(f"{path}: expected nodes (*NODE), found none")
    return nodes


def _data_lines(path, levels):
    """Lines of data with the keyword that they belong to, in capitals."""
    keyword = ""
    # Paths of included files are relative to the file that names them.
    folder = path.parent
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        text = line.strip()
        if text.startswith("**") or not text:
            continue
        if not text.startswith("*"):
            yield keyword, text
            continue
        keyword, *options = [part.strip() for part in text[1:].split(",")]
        keyword = keyword.upper()
        for option in options:
            name, _, value = option.partition("=")
            if name.strip().upper() == "INPUT" and keyword in ("INCLUDE", "NODE"):
                if not levels:
                    raise Error(f"{path}: expected at most {INCLUDES} levels of included files, found more")
                included = folder / value.strip().strip('"')
                if keyword == "INCLUDE":
                    yield from _data_lines(included, levels - 1)
                else:
                    yield from (("NODE", line) for _, line in _data_lines(included, levels - 1))
