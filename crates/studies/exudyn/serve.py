"""Answers requests line by line, each in JSON: what charts run Exudyn by."""

import json
import sys

import exudyn as exu


def serve(run):
    """Prints an answer of `run` for each line of input, or why there is none."""
    exu.SetWriteToConsole(False)
    for line in sys.stdin:
        try:
            answer = run(json.loads(line))
        except Exception as failure:
            answer = {"good": False, "failure": f"{type(failure).__name__}: {failure}"[:300]}
        print(json.dumps(answer), flush=True)
