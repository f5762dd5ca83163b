"""The command `flexbody`: the program of the package in place of this process."""

import os
import subprocess
import sys

from flexbody._errors import Error
from flexbody._program import environment, program


def main():
    try:
        command = [str(program()), *sys.argv[1:]]
    except Error as error:
        print(f"flexbody: {error}", file=sys.stderr)
        return 1
    if os.name == "posix":
        os.execve(command[0], command, environment())
    return subprocess.run(command, env=environment()).returncode


if __name__ == "__main__":
    sys.exit(main())
