"""Presenter of the patient panel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date
from functools import partial
from typing import Any, Protocol

from insole_core.cases.case_record import Annotations, CaseRecord
from insole_core.cases.days import DAY_FIELDS, read_day
from insole_core.cases.sample import SAMPLE_KEEPS_NAME
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_studio.document.case import Case
from insole_studio.document.case_names import choose_variant
from insole_studio.features.design.correction_names import describe, device_name, name_of
from insole_studio.features.design.patient.measure_texts import distances_of, measures_of
from insole_studio.features.design.rows import CorrectionRow, Measure
from insole_studio.texts import tr, translate_core_message


class PatientPanel(Protocol):
    """The patient panel as its presenter sees it, with the signals it emits."""

    field_edited: Any
    side_chosen: Any
    variant_chosen: Any
    device_selected: Any
    correction_selected: Any
    correction_toggled: Any
    correction_removed: Any
    correction_moved: Any
    correction_copied: Any

    def show_fields(self, values: dict[str, str]) -> None: ...  # noqa: D102
    def forget_typed(self) -> None: ...  # noqa: D102
    def show_refusal(self, key: str, sentence: str) -> None: ...  # noqa: D102
    def show_feet(self, at_hand: Side | None, present: Sequence[Side]) -> None: ...  # noqa: D102
    def show_variants(self, names: Sequence[str], chosen: str) -> None: ...  # noqa: D102
    def show_measures(self, measures: Sequence[Measure]) -> None: ...  # noqa: D102
    def show_device(self, text: str, selected: bool) -> None: ...  # noqa: D102
    def show_corrections(self, rows: Sequence[CorrectionRow]) -> None: ...  # noqa: D102


class PatientPresenter:
    """Shows the record, and turns the user's edits into undo steps."""

    def __init__(self, panel: PatientPanel, case: Case) -> None:
        self._panel = panel
        self._case = case
        self._measured: tuple[object, list[Measure]] | None = None
        panel.field_edited.connect(self.edit_field)
        panel.side_chosen.connect(case.take_foot)
        panel.variant_chosen.connect(partial(choose_variant, case))
        panel.device_selected.connect(partial(case.select, None))
        panel.correction_selected.connect(case.select)
        panel.correction_toggled.connect(self.toggle)
        panel.correction_removed.connect(self.remove)
        panel.correction_moved.connect(self.move)
        panel.correction_copied.connect(self.copy)
        case.opened.connect(self.show_opened)
        case.changed.connect(self.show)
        case.selection_changed.connect(self._show_corrections)
        self.show()

    def show_opened(self) -> None:
        """Show another case."""
        self._panel.forget_typed()
        self.show()

    def show(self) -> None:
        """Show the whole panel."""
        self._panel.show_fields(vars(self._case.record.patient))
        record = self._case.record
        self._panel.show_feet(record.at_hand, [foot.side for foot in record.feet])
        foot = record.current
        names = [] if foot is None else [variant.name for variant in foot.variants]
        self._panel.show_variants(names, "" if foot is None else foot.chosen)
        self._panel.show_measures(self._measures())
        self._show_corrections()

    def edit_field(self, key: str, text: str) -> None:
        """Set a field of the patient; a date that is none is refused, and the old one stays."""
        patient, value = self._case.record.patient, text.strip()
        if key == "name" and patient.is_sample and value != patient.name:
            self._refuse(key, InputError(SAMPLE_KEEPS_NAME))
            return
        if key in DAY_FIELDS and value != getattr(patient, key):
            try:
                value = read_day(key, value, date.today())
            except InputError as error:
                self._refuse(key, error)
                return
        self._case.apply(replace(patient, **{key: value}), tr("Edit the patient's fields"))
        self._panel.show_fields(vars(self._case.record.patient))

    def _refuse(self, key: str, error: InputError) -> None:
        kept = getattr(self._case.record.patient, key)
        said = translate_core_message(error.message)
        if kept:
            said = f"{said} {tr('It stays {before}.').format(before=kept)}"
        self._panel.show_refusal(key, said)
        self._panel.show_fields(vars(self._case.record.patient))

    def toggle(self, correction_id: str) -> None:
        """Enable or disable a correction."""
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
        """Move a pad or stroke before or after its neighbour in the order of application."""
        design = self._case.record.design
        if design is None:
            return
        order = list(design.corrections)
        places = [i for i, c in enumerate(order) if has_order(c)]
        start = next(n for n, i in enumerate(places) if order[i].id == correction_id)
        end = min(max(start + by, 0), len(places) - 1)
        a, b = places[start], places[end]
        order[a], order[b] = order[b], order[a]
        moved = replace(design, corrections=tuple(order))
        self._case.apply(moved, tr("Change the order of the corrections"))

    def copy(self, correction_id: str) -> None:
        """Duplicate a correction; the copy of a pad lies beside the original."""
        design = self._case.record.design
        correction = design.correction(correction_id) if design is not None else None
        if design is None or correction is None:
            return
        fresh = self._case.stamped(correction.copied())
        sentence = tr("Copy: {name}").format(name=name_of(fresh))
        self._case.apply(design.with_added(fresh), sentence)
        self._case.select(fresh.id)

    def remove(self, correction_id: str) -> None:
        """Remove a correction from the design."""
        design = self._case.record.design
        if design is not None:
            self._case.apply(design.with_removed(correction_id), tr("Remove a correction"))

    def _measures(self) -> list[Measure]:
        record = self._case.record
        if self._measured is None or self._measured[0] != _marked(record):
            self._measured = (_marked(record), measures_of(record))
        return [*self._measured[1], *distances_of(record)]

    def _show_corrections(self) -> None:
        design = self._case.record.design
        if design is None:
            self._panel.show_device("", selected=False)
            self._panel.show_corrections([])
            return
        device = tr("Device: {name}").format(name=device_name(design))
        self._panel.show_device(device, selected=self._case.selection is None)
        self._panel.show_corrections(
            [
                CorrectionRow(
                    c.id,
                    design.side,
                    describe(c),
                    c.enabled,
                    selected=c.id == self._case.selection,
                    ordered=has_order(c),
                )
                for c in design.corrections
            ]
        )


def _marked(record: CaseRecord) -> list[tuple[Foot, Annotations]]:
    """Return what the measures depend on."""
    return [(foot.foot, foot.annotations) for foot in record.feet]


def has_order(correction: Correction) -> bool:
    """Return whether the order matters; corrections of the whole shape have a fixed one."""
    return correction.stage == "pad"
