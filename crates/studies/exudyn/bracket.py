"""Writes the reduced bodies of the chart `reduced`, the bracket of the Python package's examples with several numbers of modes, with
second-order displacements and without: `bracket.py FOLDER COUNT ...`."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).parents[3]
sys.path[:0] = [str(ROOT / "python" / name) for name in ("src", "examples")]

from reduced_bodies import bracket

# Static shapes of what is held: the stretch between the two points.
STATIC = 1


def main():
    folder, *counts = sys.argv[1:]
    for count in map(int, counts):
        options = {"modes": count - STATIC, "triangles": None}
        bracket(**options).save(pathlib.Path(folder) / f"bracket_{count}.safetensors")
        bracket(**options, quadratic_force=None).save(pathlib.Path(folder) / f"bracket_{count}_linear.safetensors")


if __name__ == "__main__":
    main()
