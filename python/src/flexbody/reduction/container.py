"""The file of a reduced body: named arrays in the layout of safetensors.

Eight bytes are the length of the header (little endian), then comes the header (JSON), then the arrays. Numbers are
little endian, arrays row by row. Source of the layout: https://github.com/huggingface/safetensors, section Format.
"""

import json
import math

import numpy as np

from flexbody._errors import Error

FORMAT = "flexbody reduced body"
VERSION = "1"
TYPES = {"F64": np.dtype("<f8"), "F32": np.dtype("<f4"), "U32": np.dtype("<u4")}
# Longest header that is read, bytes.
LONGEST_HEADER = 10_000_000


def write_arrays(path, arrays, metadata):
    """Writes named arrays and metadata.

    path: path of the file.
    arrays: arrays of 64 or 32 bit floats or unsigned 32 bit integers by name.
    metadata: texts by name.
    """
    names = {kind: name for name, kind in TYPES.items()}
    header = {"__metadata__": metadata}
    data = []
    start = 0
    for name, array in arrays.items():
        array = np.ascontiguousarray(array)
        little = array.dtype.newbyteorder("<")
        data.append(array.astype(little).tobytes())
        end = start + len(data[-1])
        header[name] = {"dtype": names[little], "shape": list(array.shape), "data_offsets": [start, end]}
        start = end
    text = json.dumps(header, separators=(",", ":")).encode()
    # Arrays begin at a multiple of eight bytes.
    text += b" " * (-len(text) % 8)
    with open(path, "wb") as file:
        file.write(len(text).to_bytes(8, "little"))
        file.write(text)
        file.writelines(data)


def read_arrays(path):
    """Reads named arrays and metadata.

    path: path of the file.

    Returns arrays by name, and texts by name. Raises `flexbody.Error` if the file is not of this layout.
    """
    with open(path, "rb") as file:
        content = file.read()
    length = int.from_bytes(content[:8], "little")
    if len(content) < 8 or length > min(LONGEST_HEADER, len(content) - 8):
        raise Error(f"{path}: expected the length of a header within the file of {len(content)} bytes, found {length}")
    try:
        header = json.loads(content[8 : 8 + length])
        metadata = header.pop("__metadata__", {})
        return {name: _array(path, name, entry, content[8 + length :]) for name, entry in header.items()}, metadata
    except (ValueError, KeyError, TypeError, AttributeError) as wrong:
        raise Error(
            f"{path}: expected a header of JSON with dtype, shape and data_offsets of each array, found {wrong}"
        ) from None


def _array(path, name, entry, data):
    if entry["dtype"] not in TYPES:
        raise Error(f"{path}: {name}: expected one of the types {', '.join(TYPES)}, found {entry['dtype']!r}")
    kind = TYPES[entry["dtype"]]
    start, end = entry["data_offsets"]
    size = math.prod(entry["shape"]) * kind.itemsize
    if not 0 <= start <= end <= len(data) or end - start != size:
        raise Error(
            f"{path}: {name}: expected {size} bytes within {len(data)}, found offsets {start} to {end}: is the "
            f"file complete?"
        )
    return np.frombuffer(data[start:end], kind).reshape(entry["shape"]).astype(kind.newbyteorder("="))
