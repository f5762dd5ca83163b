"""The project's own commands, for tests that start from a scene."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def xtask(*arguments):
    """Runs `cargo xtask`, by the program that started the tests if there is one."""
    own = os.environ.get("FLEXBODY_XTASK")
    command = [own] if own else ["cargo", "xtask"]
    command += map(str, arguments)
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(command)}:\n{result.stdout}{result.stderr}")


def package(scene, output, *options, animation=False):
    """Packages a scene; its page stands still unless that is what is tested, so that nothing is simulated."""
    xtask("package", scene, "--output", output, *options, *([] if animation else ["--no-animation"]))
    return output
