"""Keeps SciPy from loading what NumPy itself loads on demand only.

SciPy's layer for other kinds of arrays copies every name that NumPy lists, and so loads the tools
for Fortran, for tests and for C, which nobody here uses: about 0.07 s of every command.
"""

from __future__ import annotations

import numpy as np

_ON_DEMAND = frozenset({"ctypeslib", "f2py", "polynomial", "testing"})


def unlist_parts_on_demand() -> None:
    """Take these parts off NumPy's lists of names; whoever asks for one still gets it."""
    listed = np.__dir__()
    np.__all__ = [name for name in np.__all__ if name not in _ON_DEMAND]
    vars(np)["__dir__"] = lambda: [name for name in listed if name not in _ON_DEMAND]
