"""Opens the change of the pressure, and keeps its table in step with the insole."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from insole_core.contact.change import PressureChange
from insole_core.contact.change_report import REGION_WORDS, signed
from insole_core.contact.dose import Dose, DoseCurve
from insole_core.contact.fit import Fitted
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Number
from insole_studio.document.case_names import variant_heading
from insole_studio.document.load_view import LoadView, Target
from insole_studio.document.side_by_side import Beside
from insole_studio.features.design.actions.view_actions import SideBySideActions
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.services.app_services import AppServices
from insole_studio.texts import fill, localised, tr, translate_core_message
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.row_table import TableRow

if TYPE_CHECKING:
    from insole_studio.features.design.load.load_dialog import LoadDialog


class LoadActions:
    """Shows how load moves: as colours in both views, and as a table in a window beside them."""

    def __init__(
        self,
        services: AppServices,
        load: LoadView,
        side_by_side: SideBySideActions,
        view: ModelView,
    ) -> None:
        """Connect to what is told.

        Parameters
        ----------
        view
            At whose left edge the window opens.
        """
        self._services, self._case = services, services.case
        self._load, self._side_by_side, self._view = load, side_by_side, view
        self._dialog: LoadDialog | None = None
        self._is_beside = False
        """Whether a variant stands beside because both are told."""
        self._weight_kg = 0.0
        """What was put in for this case; 0 while nothing was."""
        self._prescribed_kg: dict[Side, float] = {}
        """What the design of each of its feet said then."""
        load.told.connect(self._show_told)
        self._case.changed.connect(self._show_variants)
        self._case.changed.connect(self._follow_weight)
        self._case.selection_changed.connect(self._aim)

    def leave_case(self) -> None:
        """Close the window before another case comes: its weight is that of this person."""
        if self._dialog is not None:
            self._dialog.reject()
        self._weight_kg, self._prescribed_kg = 0.0, {}

    def show(self) -> None:
        """Open the window, and colour both views once something is asked."""
        from insole_studio.features.design.load.load_dialog import LoadDialog

        self._side_by_side.show_map(MapKind.LOAD)
        if self._dialog is None:
            is_read = self._services.settings.pressure_change_read
            self._dialog = dialog = LoadDialog(is_read=is_read, parent=self._services.window)
            dialog.weight.show_value(self._newly_prescribed_kg() or self._weight_kg)
            dialog.papers.setChecked(self._load.is_on_papers)
            dialog.papers.toggled.connect(self._load.put_on_papers)
            dialog.asked.connect(self._ask)
            dialog.finished.connect(self._close)
            dialog.offer_regions(_regions())
            self._show_variants()
            dialog.covered.connect(self._view.leave_room)
            dialog.show_beside(self._view)
            self._ask()
        self._dialog.raise_()

    def _newly_prescribed_kg(self) -> float:
        """Return the weight that the shown foot's design says since this was asked last, else 0."""
        record, before = self._case.record, self._prescribed_kg
        self._prescribed_kg = {
            foot.side: foot.design.shell.body_weight_kg or 0.0
            for foot in record.feet
            if foot.design.shell is not None
        }
        side = None if record.current is None else record.current.side
        if side is None or self._prescribed_kg.get(side) == before.get(side):
            return 0.0
        return self._prescribed_kg.get(side, 0.0)

    def _follow_weight(self) -> None:
        """Take over the weight that the design says from now on: it is of the same person."""
        if self._dialog is not None and (weight_kg := self._newly_prescribed_kg()):
            self._dialog.weight.show_value(weight_kg)
            self._ask()

    def _ask(self) -> None:
        assert self._dialog is not None
        if self._dialog.is_read and not self._services.settings.pressure_change_read:
            self._services.settings.pressure_change_read = True
            self._services.save_settings()
        self._load.ask(self._dialog.question)
        self._show_beside()
        self._aim()
        self._show_told()

    def _show_beside(self) -> None:
        """Show the variant beside that is told beside, and none that was shown for that alone."""
        question = None if self._dialog is None else self._dialog.question
        if question is not None and question.is_both:
            counterpart = self._side_by_side.counterpart
            if (counterpart.kind, counterpart.variant) != (Beside.VARIANT, question.variant):
                self._is_beside = True
                self._side_by_side.show_beside(Beside.VARIANT, question.variant)
        elif self._is_beside:
            self._is_beside = False
            self._side_by_side.show_beside(Beside.NOTHING)

    def _aim(self) -> None:
        """Aim at the target, by the selected pad, or else by the first of the design."""
        dialog, design = self._dialog, self._case.record.design
        if dialog is None or design is None:
            return
        pads = design.of(Pelott)
        pad = design.found(self._case.selection, Pelott) or (pads[0] if pads else None)
        region = dialog.region.currentData()
        if pad is None or not region or not dialog.is_read:
            self._load.aim(None)
        else:
            self._load.aim(Target(pad.id, region, dialog.percent.value()))
        self._show_told()

    def _show_dose(self, dialog: LoadDialog) -> None:
        """Say which dose of the pad reaches the target, and show the curve."""
        design, target = self._case.record.design, self._load.target
        curve = None if target is None else self._load.curve
        untold = translate_core_message(self._load.untold_target)
        pad = None if target is None or design is None else design.found(target.pad_id, Pelott)
        factor = 1.0 if pad is None else _height_of(pad).factor
        dialog.chart.show_curve(curve, dialog.percent.value(), factor)
        if design is not None and dialog.region.currentData() and not design.of(Pelott):
            dialog.dose.say(tr("The design has no pad whose height could be varied."))
        elif untold:
            dialog.dose.say(fill(tr("No height can be told: {reason}"), reason=untold))
        elif curve is None or target is None or pad is None:
            dialog.dose.say("")
        elif self._load.dose is None:
            text = tr("No height of the pad that was tried reaches it: it makes {low} to {high}.")
            dialog.dose.say(_span_text(text, curve))
        elif curve.is_within(self._load.dose.told):
            text = tr("The height of this pad hardly matters there: it makes {low} to {high}.")
            dialog.dose.say(_span_text(text, curve))
        else:
            dialog.dose.say(_dose_text(self._load.dose, pad, target.percent))

    def _close(self) -> None:
        assert self._dialog is not None
        self._weight_kg = self._dialog.weight.value()
        self._dialog = None
        self._view.leave_room(0)
        self._load.aim(None)
        self._load.ask(None)
        self._show_beside()
        if self._side_by_side.map_kind is MapKind.LOAD:
            self._side_by_side.show_map(MapKind.NONE)
            self._load.told.emit()

    def _show_variants(self) -> None:
        foot = self._case.record.current
        if self._dialog is not None and foot is not None:
            names = [one.name for one in foot.variants if one.name != foot.chosen]
            both = self._dialog.both.isChecked()
            self._dialog.show_variants(
                names, self._side_by_side.counterpart.variant if both else ""
            )
            self._dialog.offer_fit(foot.plantar.pressure is not None)
            self._load.ask(self._dialog.question)
            self._show_beside()

    def _show_told(self) -> None:
        dialog, load = self._dialog, self._load
        if dialog is None:
            return
        if dialog.question is None and dialog.is_read:
            dialog.problem.say(tr("Put in the body weight; nothing is assumed."))
        else:
            dialog.problem.say(load.problem)
        dialog.assumed.say_all(load.notes)
        dialog.fitted.say(_fit_text(load.fitted))
        self._show_dose(dialog)
        if load.change is None:
            dialog.show_rows([], "")
            dialog.reasons.say("")
            return
        told = [load.limits, load.limits_beside] if load.is_both else [load.limits]
        pair = self._pair(dialog) if load.is_both else ()
        names = dialog.shortened(pair) or [""]
        # Before the rows, which make room for all.
        dialog.reasons.say_all(_all_reasons(told, names))
        rows = [_row(name, text, told, load.problem) for name, text in _regions().items()]
        areas = [_area_text(one, name) for one, name in zip(told, names, strict=True)]
        dialog.show_rows(rows, "\n".join(filter(None, areas)), pair)

    def _pair(self, dialog: LoadDialog) -> tuple[str, str]:
        """Return what both variants are called that are told."""
        foot = self._case.record.current
        names = "" if foot is None else foot.chosen, dialog.against.currentData()
        own, beside = map(variant_heading, names)
        return own, beside


def _area_text(told: PressureChange | None, name: str) -> str:
    """Return the area of contact before and after; empty until it is told.

    Parameters
    ----------
    name
        Of the variant, where two are told.
    """
    if told is None:
        return ""
    old, new = (localised(mm2 / 100, ".0f") for mm2 in told.change.areas_mm2)
    text = fill(tr("Contact {old} → {new} cm²"), old=old, new=new)
    return f"{name}: {text}" if name else text


def _fit_text(fitted: Fitted | None) -> str:
    """Return how well the model, fitted to the map, tells regions that the fit did not see."""
    if fitted is None or fitted.error_percent is None:
        return ""
    names = ", ".join(_regions()[name] for name in fitted.held_out)
    error = localised(fitted.error_percent, ".0f")
    return fill(
        tr("Fitted to the map. Where the fit did not look ({names}), it is off by {error} %."),
        error=error,
        names=names,
    )


def _span_text(text: str, curve: DoseCurve) -> str:
    """Return a sentence with the changes that the heights of a curve make."""
    low, high = map(_percent, curve.span)
    return fill(text, low=low, high=high)


def _height_of(pad: Pelott) -> Number:
    found = pad.declared("height_mm")
    assert isinstance(found, Number)
    return found


def _dose_text(dose: Dose, pad: Pelott, percent: float) -> str:
    """Return which height reaches a change, with its own limits or why there are none."""
    texts = {
        "dose": localised(_height_of(pad).factor * dose.height_mm),  # as its field has it
        "pad": name_of(pad),
        "percent": _percent(percent),
    }
    told = dose.told
    if told.reason or told.limits is None:
        return fill(
            tr("{pad}: by the model {dose} mm reach {percent}, but it cannot tell: {reason}"),
            reason=translate_core_message(told.reason),
            **texts,
        )
    low, high = (_percent(limit) for limit in told.limits)
    return fill(
        tr("{pad}: by the model {dose} mm reach {percent}, between {low} and {high} (95 %)."),
        low=low,
        high=high,
        **texts,
    )


def _row(name: str, text: str, told: Sequence[PressureChange | None], problem: str) -> TableRow:
    """Return what is told of a region, of one insole or two."""
    cells, tips = zip(*(_cell(name, one, problem) for one in told), strict=True)
    filled = [*cells, *[""] * (2 - len(cells))]
    return TableRow(name, (text, *filled), tip="\n".join(filter(None, tips)))


def _cell(name: str, limits: PressureChange | None, problem: str) -> tuple[str, str]:
    """Return a change with its limits, and why there is none; no figure without its limits."""
    if limits is None:
        return (tr("cannot tell"), problem) if problem else ("…", "")
    told = limits.regions[name]
    if told.reason or told.percent is None or told.limits is None:
        return tr("cannot tell"), translate_core_message(told.reason)
    low, high = map(signed, told.limits)
    return f"{_percent(told.percent)} ({low} … {high})", ""


def _all_reasons(told: Sequence[PressureChange | None], names: Sequence[str]) -> list[str]:
    """Return why nothing is told of some regions; of one of two insoles under its name."""
    lines = [_reasons(one) for one in told]
    of_all = [line for line in lines[0] if all(line in some for some in lines)]
    own = [
        f"{name} – {line}"
        for name, some in zip(names, lines, strict=True)
        for line in some
        if line not in of_all
    ]
    return [*of_all, *own]


def _reasons(told: PressureChange | None) -> list[str]:
    """Return why nothing is told of some regions, a line for each reason."""
    regions: dict[str, list[str]] = {}
    for name, text in _regions().items():
        if told is not None and told.regions[name].reason:
            reason = translate_core_message(told.regions[name].reason)
            regions.setdefault(reason, []).append(text)
    return [f"{', '.join(names)}: {reason}" for reason, names in regions.items()]


def _percent(percent: float) -> str:
    return f"{signed(percent)}\N{NO-BREAK SPACE}%"


def _regions() -> dict[str, str]:
    """Return the words for the regions, in the order of the table."""
    return {name: translate_core_message(word) for name, word in REGION_WORDS.items()}
