"""Locations of the bundled files, in a checkout, a wheel and a frozen build."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def resource_path(name: str) -> Path:
    """Return the path of a bundled resource, for example ``reference_systems/lego-20.json``.

    Raises
    ------
    FileNotFoundError
        When the installation does not contain it.
    """
    for root in (_PACKAGE / "_resources", _PACKAGE.parent / "resources"):
        path = root / name
        if path.exists():
            return path
    raise FileNotFoundError(f"the resource {name} is missing from this installation")
