"""Designs of tests that begin with a coarse grid: a quarter of the work of the product's."""

from __future__ import annotations

from inspect import Parameter, signature

import pytest

from insole_core.insole.prescription.design import InsoleDesign

COARSE_MM = 2.0
"""The coarsest of which no check warns."""
_DEFAULTS_OF_THE_PRODUCT = InsoleDesign.__init__.__defaults__


def begin_coarse(patch: pytest.MonkeyPatch) -> None:
    """Let designs begin with a coarse grid; one that a prescription names stays."""
    begun, given = InsoleDesign.__init__, signature(InsoleDesign).parameters.values()
    defaults = {p.name: p.default for p in given if p.default is not Parameter.empty}
    defaults["grid_mm"] = COARSE_MM
    patch.setattr(begun, "__defaults__", tuple(defaults.values()))


def begin_fine(patch: pytest.MonkeyPatch) -> None:
    """Let designs begin with the grid of the product again."""
    patch.setattr(InsoleDesign.__init__, "__defaults__", _DEFAULTS_OF_THE_PRODUCT)
