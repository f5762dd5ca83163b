"""Writes bracket.safetensors (needs the extra `fe` of the Python package, and scikit-fem)."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parents[2] / "python" / "examples"))

from reduced_bodies import bracket  # noqa: E402

bracket(modes=4, triangles=None).save(HERE / "bracket.safetensors")
