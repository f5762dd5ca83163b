"""Finite element models reduced to modes: needs the extra `flexbody[fe]`."""

from flexbody.reduction.body import InterfaceMotion, ReducedBody, Surface
from flexbody.reduction.interface import Interface
from flexbody.reduction.modal import ModalModel
from flexbody.reduction.model import FiniteElementModel
from flexbody.reduction.craig_bampton import reduce

__all__ = ["FiniteElementModel", "Interface", "InterfaceMotion", "ModalModel", "ReducedBody", "Surface", "reduce"]
