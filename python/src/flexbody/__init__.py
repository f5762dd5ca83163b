"""Flexible bodies as FMI co-simulation units.

Scenes are written with the models of `flexbody.scene`; the functions here hand them to the program `flexbody`, which
checks what the models cannot know and says what is wrong (`flexbody.Error`).

`flexbody.reduce` and `flexbody.reduction` turn finite element models into reduced bodies. They need numpy and scipy
(`pip install "flexbody[fe]"`), which are imported when one of them is first used.
"""

from importlib import import_module

from flexbody._errors import Error
from flexbody._program import Columns, FlexbodyWarning, package, program, run, simulate, view

# Without `reduce` and `reduction`: a star import must not need numpy.
__all__ = ["Columns", "Error", "FlexbodyWarning", "package", "program", "run", "simulate", "view"]


def __getattr__(name):
    """Imports what needs numpy and scipy when it is asked for."""
    if name not in ("reduce", "reduction"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        reduction = import_module("flexbody.reduction")
    except ModuleNotFoundError as missing:
        if missing.name not in ("numpy", "scipy"):
            raise
        raise ImportError(f'flexbody.{name}: expected {missing.name}; pip install "flexbody[fe]"') from None
    return reduction if name == "reduction" else reduction.reduce
