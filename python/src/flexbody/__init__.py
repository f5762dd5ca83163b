"""Flexible bodies as FMI co-simulation units.

Scenes are written with the models of `flexbody.scene`; the functions here hand them to the program `flexbody`, which
checks what the models cannot know and says what is wrong (`flexbody.Error`).
"""

from flexbody._errors import Error
from flexbody._program import Columns, FlexbodyWarning, package, program, run, simulate, view

__all__ = ["Columns", "Error", "FlexbodyWarning", "package", "program", "run", "simulate", "view"]
