"""Readers of finite element models. Each returns a `FiniteElementModel`."""

from flexbody.reduction.readers.abaqus import read_abaqus
from flexbody.reduction.readers.calculix import read_calculix
from flexbody.reduction.readers.matrix_market import read_matrix_market

__all__ = ["read_abaqus", "read_calculix", "read_matrix_market"]
