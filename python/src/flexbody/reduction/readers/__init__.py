"""Readers of finite element models. Most return a `FiniteElementModel`, each says what."""

from flexbody.reduction.readers.abaqus import read_abaqus
from flexbody.reduction.readers.calculix import read_calculix
from flexbody.reduction.readers.exudyn import read_exudyn, read_exudyn_modes
from flexbody.reduction.readers.matrix_market import read_matrix_market
from flexbody.reduction.readers.nastran import read_nastran, read_nastran_modes
from flexbody.reduction.readers.sid_fem import read_sid_fem

__all__ = [
    "read_abaqus",
    "read_calculix",
    "read_exudyn",
    "read_exudyn_modes",
    "read_matrix_market",
    "read_nastran",
    "read_nastran_modes",
    "read_sid_fem",
]
