"""What the export panel shows, as values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from insole_core.solids.checks import Finding
from insole_core.solids.rules import CheckName, Policy
from insole_studio.texts import tr


class CheckState(StrEnum):
    """How a check came out."""

    PASSED = "passed"
    WARNING = "warning"
    BLOCKING = "blocking"
    OFF = "off"
    OPEN = "open"


@dataclass(frozen=True)
class CheckRow:
    """One check: what it is, how it came out, how strictly it is taken.

    Parameters
    ----------
    limit, unit
        None and "" where there is nothing to set.
    leads
        Whether a place can be looked at.
    """

    name: CheckName
    title: str
    state: CheckState
    sentence: str
    policy: Policy
    limit: float | None = None
    unit: str = ""
    leads: bool = False


@dataclass(frozen=True)
class Buttons:
    """What can be pressed, and whether a reason is asked for."""

    export: bool = False
    cancel: bool = False
    reason: bool = False


TITLES: dict[CheckName, Callable[[], str]] = {
    "watertight": lambda: tr("Closed solid"),
    "thickness": lambda: tr("Least thickness"),
    "cutter": lambda: tr("Hollows for the cutter"),
    "undercut": lambda: tr("Undercut from above"),
    "step": lambda: tr("Height of step"),
    "block": lambda: tr("Fits the block"),
    "shoe_height": lambda: tr("Fits the shoe"),
}
UNITS: dict[CheckName, str] = {
    "thickness": "mm", "cutter": "mm", "undercut": "mm²", "step": "mm", "shoe_height": "mm",
}  # fmt: skip
_SENTENCES: dict[CheckName, Callable[[], str]] = {
    "thickness": lambda: tr("{value:.2f} mm at the thinnest place"),
    "cutter": lambda: tr("{value:.2f} mm of material is left in hollows"),
    "undercut": lambda: tr("{value:.0f} mm² cannot be reached from above"),
    "step": lambda: tr("{value:.1f} mm of rise over 1 mm"),
    "shoe_height": lambda: tr("{value:.1f} mm at the highest place"),
}


def state_of(finding: Finding) -> CheckState:
    """Say how a check came out."""
    if finding.passed:
        return CheckState.PASSED
    return CheckState.BLOCKING if finding.blocks else CheckState.WARNING


def sentence_of(finding: Finding) -> str:
    """Say in the language of the window what was measured."""
    if finding.name == "watertight":
        return tr("closed") if finding.passed else tr("open or inside out")
    if finding.name == "block":
        text = tr("{value:.1f} mm to spare") if finding.passed else tr("{value:.1f} mm too large")
        return text.format(value=abs(finding.value))
    return _SENTENCES[finding.name]().format(value=finding.value)
