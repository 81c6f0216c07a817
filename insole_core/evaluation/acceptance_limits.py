"""Limits for acceptance: data that a clinic may change."""

from __future__ import annotations

from pathlib import Path

from insole_core.errors import InputError
from insole_core.evaluation.report import ReportSection, with_limits
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

Limits = dict[str, dict[str, float]]
"""Largest absolute value by section key and number key."""


def bundled_limits_path() -> Path:
    """Return the path of the limits shipped with the product."""
    return resource_path("limits/kinect-v1.json")


def load_limits(path: Path) -> Limits:
    """Read a file of limits.

    Raises
    ------
    InputError
        Naming the file and the key of the first violation.
    """
    sections = JsonObject.read(path).object("limits")
    return {
        key: {name: item.number(name, 0) for name in item.values}
        for key in sections.values
        for item in [sections.object(key)]
    }


def judged(section: ReportSection, limits: Limits) -> ReportSection:
    """Return a section judged by its limits.

    Parameters
    ----------
    limits
        May hold limits of other sections too.

    Raises
    ------
    InputError
        If a limit refers to a number that the section lacks: it could not be checked.
    """
    named = limits.get(section.key, {})
    missing = named.keys() - {number.key for number in section.numbers}
    if missing:
        known = ", ".join(number.key for number in section.numbers)
        raise InputError(
            'The limit "{key}" has no number to judge in this evaluation; take it out, or use one '
            "of {known}.",
            key=min(missing),
            known=known,
        )
    return with_limits(section, named)
