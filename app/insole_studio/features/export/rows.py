"""Values shown by the export panel."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.messages import Message
from insole_core.solids.checks import Finding
from insole_core.solids.export_rules import CheckName, ExportRules, Policy
from insole_core.solids.nesting import Nest
from insole_core.solids.order import CHECKS_OF, Part
from insole_core.solids.solid import Kind
from insole_core.workflows.make_order import OrderChoice, ordered_material
from insole_studio.texts import fill, tr, translate_core_message

ToldOnPapers: TypeAlias = Callable[[CaseRecord], Mapping[Side, tuple[Message, ...]]]
"""Returns what stands on the papers of a case beside its designs, by the feet."""


def nothing_told(_record: CaseRecord) -> Mapping[Side, tuple[Message, ...]]:
    """Return nothing for the papers."""
    return {}


class CheckState(StrEnum):
    """The outcome of a check."""

    PASSED = "passed"
    WARNING = "warning"
    BLOCKING = "blocking"
    OFF = "off"
    OPEN = "open"


@dataclass(frozen=True)
class CheckRow:
    """One check: its title, outcome and policy.

    Parameters
    ----------
    limit, unit
        None and "" for a check without a limit.
    leads
        Whether its location can be shown.
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
    """Which buttons are enabled, and whether a reason is required."""

    export: bool = False
    cancel: bool = False
    reason: bool = False


@dataclass(frozen=True)
class OrderedFoot:
    """What an order makes of one foot.

    Parameters
    ----------
    material
        As the shop calls it; empty if nobody has named one.
    walls
        Draft and chamfer in words where the prescription's shell sets them; empty where the order
        does.
    """

    side: Side
    material: str
    walls: str = ""


TITLES: dict[CheckName, Callable[[], str]] = {
    "watertight": lambda: tr("Closed solid"),
    "thickness": lambda: tr("Least thickness"),
    "cutter": lambda: tr("Hollows for the cutter"),
    "undercut": lambda: tr("Undercut"),
    "step": lambda: tr("Height of step"),
    "block": lambda: tr("Fits the block"),
    "shoe_height": lambda: tr("Height in the shoe"),
    "grid": lambda: tr("Close enough points"),
}
TIPS: dict[CheckName, Callable[[], str]] = {
    "thickness": lambda: tr("How thick the insole must be at least"),
    "cutter": lambda: tr("How much material may be left in hollows too narrow for the cutter"),
    "undercut": lambda: tr("How much of the surface may lie where no tool comes from above"),
    "step": lambda: tr("How steep the surface may rise over 1 mm"),
    "shoe_height": lambda: tr("How high the insole may be in the shoe"),
    "grid": lambda: tr("How far apart the points may lie at which the surface is computed"),
}
"""What the limit of a check means."""
UNITS: dict[CheckName, str] = {
    "thickness": "mm", "cutter": "mm", "undercut": "mm²", "step": "mm", "shoe_height": "mm",
    "grid": "mm",
}  # fmt: skip
_SENTENCES: dict[CheckName, Callable[[], str]] = {
    "thickness": lambda: tr("{value:.1f} mm at the thinnest place"),
    "cutter": lambda: tr("{value:.2f} mm of material is left in hollows"),
    "undercut": lambda: tr("{value:.0f} mm² cannot be reached by the cutter"),
    "step": lambda: tr("{value:.1f} mm of rise over 1 mm"),
    "shoe_height": lambda: tr("{value:.1f} mm at the highest place"),
    "grid": lambda: tr("{value:g} mm between the points of the surface"),
}


def state_of(finding: Finding) -> CheckState:
    """Return the outcome of a check."""
    if finding.passed:
        return CheckState.PASSED
    return CheckState.BLOCKING if finding.blocks else CheckState.WARNING


def sentence_of(finding: Finding) -> str:
    """Return the measured value as a translated sentence."""
    if finding.name == "watertight":
        return tr("closed") if finding.passed else tr("open or inside out")
    if finding.name == "block":
        text = tr("{value:.1f} mm to spare") if finding.passed else tr("{value:.1f} mm too large")
        return fill(text, value=abs(finding.value))
    return fill(_SENTENCES[finding.name](), value=finding.value)


def check_row(
    name: CheckName,
    rules: ExportRules,
    kind: Kind,
    finding: Finding | None,
    *,
    waiting: bool,
    has_block: bool,
) -> CheckRow:
    """Return the row of one check.

    Parameters
    ----------
    name
        The check.
    rules
        The clinic's policies and limits.
    kind
        Kind of part; not all checks apply to all kinds.
    finding
        Result of the check; None before it has run.
    waiting
        Whether it is running.
    has_block
        Whether a block is chosen.
    """
    policy = rules.policies.get(name, "off")
    state, sentence = CheckState.OPEN, tr("is being checked") if waiting else tr("not checked")
    if policy == "off":
        state, sentence = CheckState.OFF, tr("not checked")
    elif name == "block" and not has_block:
        state, sentence = CheckState.OFF, tr("no block is chosen")
    elif finding is None and name not in CHECKS_OF[kind]:
        state, sentence = CheckState.OFF, tr("does not apply to this piece")
    elif finding is not None:
        state, sentence = state_of(finding), sentence_of(finding)
        if name == "thickness" and finding.limit > rules.limits[name]:
            needed = tr("{value:.1f} mm is the least of its material")
            sentence = f"{sentence}; {fill(needed, value=finding.limit)}"
    placed = finding is not None and finding.place_mm is not None
    limit, unit = rules.limits.get(name), UNITS.get(name, "")
    return CheckRow(name, TITLES[name](), state, sentence, policy, limit, unit, placed)


def summary_of(part: Part) -> str:
    """Return size, volume and number of triangles of a part, and how far the triangles deviate."""
    width, length, height = part.solid.bounds_mm[1] - part.solid.bounds_mm[0]
    said = fill(
        tr("{length:.0f} × {width:.0f} × {height:.1f} mm, {volume:.0f} cm³, {count} triangles"),
        length=float(length), width=float(width), height=float(height),
        volume=part.solid.volume_mm3 / 1000, count=len(part.solid.triangles),
    )  # fmt: skip
    if part.deviation_mm == 0:
        return said
    deviation = tr("They deviate by {deviation:.3f} mm at most.")
    return f"{said}. {fill(deviation, deviation=part.deviation_mm)}"


def summary_of_nest(nest: Nest) -> str:
    """Return what a pair needs of its block."""
    width, length, height = nest.size_mm
    text = tr("Both need {length:.0f} × {width:.0f} × {height:.1f} mm of the block")
    return fill(text, length=float(length), width=float(width), height=float(height))


def notes_of(parts: Sequence[Part]) -> list[str]:
    """Return what is unusual about the design of each part, and what is made otherwise."""
    return [
        f"{_side(part)}: {note}" if len(parts) > 1 else note
        for part in parts
        for note in map(translate_core_message, (*part.warnings, *part.notes))
    ]


def side_text(part: Part) -> str:
    """Return the name of the part's side, with a symbol for a failed check or a warning."""
    text = _side(part)
    if any(finding.blocks for finding in part.findings):
        return f"{text}  ✗"
    is_usual = all(finding.passed for finding in part.findings) and not part.warnings
    return text if is_usual else f"{text}  !"


def _side(part: Part) -> str:
    return tr("Left") if part.side is Side.LEFT else tr("Right")


def patient_text(patient: Patient) -> str:
    """Return the text that identifies the patient; shown in the window only, never exported."""
    words = (
        patient.name or tr("Patient without a name"),
        tr("born {date}").format(date=patient.born) if patient.born else "",
        tr("visit {date}").format(date=patient.visit) if patient.visit else "",
    )
    return "  ·  ".join(word for word in words if word)


def ordered_foot(choice: OrderChoice, design: InsoleDesign) -> OrderedFoot:
    """Return what an order makes of the foot of a design."""
    material, shell = ordered_material(choice, design), design.shell
    if shell is None or choice.kind != "insole":
        return OrderedFoot(design.side, material)
    medial, lateral = shell.draft_medial_deg, shell.draft_lateral_deg
    both = tr("draft {medial:g}° medial, {lateral:g}° lateral")
    draft = fill(both, medial=medial, lateral=lateral)
    if medial == lateral:
        draft = fill(tr("draft {degrees:g}°"), degrees=medial)
    chamfer = fill(tr("chamfer {mm:g} mm"), mm=shell.chamfer_mm)
    return OrderedFoot(design.side, material, f"{draft}, {chamfer}")
