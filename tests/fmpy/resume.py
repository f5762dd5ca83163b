"""Continues a serialized state in a process of its own, with the fewest calls a master can make.

No resources, no memory callbacks; only fmi2Instantiate, fmi2DeSerializeFMUstate, fmi2SetFMUstate
and fmi2DoStep (and fmi2GetReal to print the outputs).

usage: resume.py FMU STATE START_TIME STOP_TIME STEP
"""

import json
import sys
import tempfile
from pathlib import Path

from instance import Fmu, Instance


def resuming(fmu):
    return Instance(fmu, memory=False, resources=False)


def main():
    path, blob = sys.argv[1:3]
    start_time, stop_time, step = map(float, sys.argv[3:6])
    with tempfile.TemporaryDirectory() as folder, resuming(Fmu(path, folder)) as instance:
        state = instance.slave.deSerializeFMUstate(Path(blob).read_bytes())
        instance.slave.setFMUstate(state)
        print(json.dumps(instance.run(stop_time, step, start_time)))


if __name__ == "__main__":
    main()
