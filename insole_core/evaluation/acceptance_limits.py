"""Limits that an acceptance judges by: data that a clinic may change."""

from __future__ import annotations

from pathlib import Path

from insole_core.errors import InputError
from insole_core.evaluation.report import ReportSection, with_limits
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

Limits = dict[str, dict[str, float]]
"""Section key to number key to largest absolute value."""


def bundled_limits_path() -> Path:
    """Give the limits that come with the product."""
    return resource_path("limits/kinect-v1.json")


def load_limits(path: Path) -> Limits:
    """Read a file of limits.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    sections = JsonObject.read(path).object("limits")
    return {
        key: {name: item.number(name, 0) for name in item.values}
        for key in sections.values
        for item in [sections.object(key)]
    }


def judged(section: ReportSection, limits: Limits) -> ReportSection:
    """Judge a section; a limit without its number is an error, since it cannot have been kept.

    Raises
    ------
    InputError
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
