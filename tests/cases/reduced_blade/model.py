"""Writes blade.safetensors (needs the extra `fe` of the Python package, and scikit-fem)."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parents[2] / "python" / "examples"))

from reduced_bodies import blade  # noqa: E402

blade(modes=8, triangles=None).save(HERE / "blade.safetensors")
