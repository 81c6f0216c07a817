"""Between the patient panel and the case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

from insole_core.geometry.side import Side
from insole_studio.stages.design.measure_texts import measures_of
from insole_studio.stages.design.rows import CorrectionRow, Measure
from insole_studio.texts import tr
from insole_studio.tools.correction_names import describe
from insole_studio.tools.key_point import distances
from insole_studio.workbench.case import Case


class PatientPanel(Protocol):
    """What the patient panel shows, and the intents it emits."""

    field_edited: Any
    correction_selected: Any
    correction_toggled: Any
    correction_removed: Any
    correction_moved: Any

    def show_fields(self, values: dict[str, str]) -> None: ...  # noqa: D102
    def show_side(self, side: Side | None) -> None: ...  # noqa: D102
    def show_measures(self, measures: Sequence[Measure]) -> None: ...  # noqa: D102
    def show_corrections(self, rows: Sequence[CorrectionRow]) -> None: ...  # noqa: D102


class PatientPresenter:
    """Shows the record, and turns intents into steps of undo."""

    def __init__(self, panel: PatientPanel, case: Case) -> None:
        self._panel = panel
        self._case = case
        self._measured: tuple[object, list[Measure]] | None = None
        panel.field_edited.connect(self.edit_field)
        panel.correction_selected.connect(case.select)
        panel.correction_toggled.connect(self.toggle)
        panel.correction_removed.connect(self.remove)
        panel.correction_moved.connect(self.move)
        case.opened.connect(self.show)
        case.changed.connect(self.show)
        case.selection_changed.connect(self._show_corrections)
        self.show()

    def show(self) -> None:
        """Show the whole panel."""
        self._panel.show_fields(vars(self._case.record.patient))
        self._panel.show_side(self._case.side)
        self._panel.show_measures(self._measures())
        self._show_corrections()

    def edit_field(self, key: str, text: str) -> None:
        """Take what was typed."""
        patient = replace(self._case.record.patient, **{key: text.strip()})
        self._case.apply(patient, tr("Edit the patient's fields"))

    def toggle(self, correction_id: str) -> None:
        """Switch a correction on or off."""
        design = self._case.record.design
        correction = design.correction(correction_id) if design is not None else None
        if design is None or correction is None:
            return
        switched = replace(correction, enabled=not correction.enabled)
        sentence = (
            tr("Switch a correction on") if switched.enabled else tr("Switch a correction off")
        )
        self._case.apply(design.with_changed(switched), sentence)

    def move(self, correction_id: str, by: int) -> None:
        """Let a correction act before or after its neighbour."""
        design = self._case.record.design
        if design is None:
            return
        order = list(design.corrections)
        start = next(i for i, c in enumerate(order) if c.id == correction_id)
        end = min(max(start + by, 0), len(order) - 1)
        order.insert(end, order.pop(start))
        moved = replace(design, corrections=tuple(order))
        self._case.apply(moved, tr("Change the order of the corrections"))

    def remove(self, correction_id: str) -> None:
        """Take a correction out of the design."""
        design = self._case.record.design
        if design is not None:
            self._case.apply(design.with_removed(correction_id), tr("Remove a correction"))

    def _measures(self) -> list[Measure]:
        record = self._case.record
        if self._measured is None or self._measured[0] != (record.foot, record.annotations):
            self._measured = ((record.foot, record.annotations), measures_of(record))
        between = [
            Measure(f"{a} – {b}", f"{distance:.1f} mm")
            for a, b, distance in distances(record.annotations)
        ]
        return [*self._measured[1], *between]

    def _show_corrections(self) -> None:
        design = self._case.record.design
        if design is None:
            self._panel.show_corrections([])
            return
        self._panel.show_corrections(
            [
                CorrectionRow(
                    c.id, design.side, describe(c), c.enabled, c.id == self._case.selection
                )
                for c in design.corrections
            ]
        )
