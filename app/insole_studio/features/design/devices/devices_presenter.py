"""Presenter of the list of devices and findings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from insole_core.errors import InsoleError
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.messages import Message
from insole_studio.document.case import Case
from insole_studio.features.design.devices.device_choices import Choice, Kind, matching
from insole_studio.features.design.devices.devices_view import (
    ChoiceDetails,
    ChoiceRow,
    MenuEntry,
)
from insole_studio.texts import tr, translate_core_message


class DevicesPanel(Protocol):
    """The list as its presenter sees it, with the signals it emits."""

    search_edited: Any
    row_chosen: Any
    apply_requested: Any

    def show_rows(self, rows: Sequence[ChoiceRow], chosen: str) -> None: ...  # noqa: D102
    def show_details(self, details: ChoiceDetails) -> None: ...  # noqa: D102
    def show_entries(self, entries: Sequence[MenuEntry]) -> None: ...  # noqa: D102


class DevicesPresenter:
    """Filters the choices, and shows what the chosen one would change.

    Parameters
    ----------
    choices
        All that can be chosen.
    default
        Key of the clinic's default device.
    entries
        The menu for a choice.
    """

    def __init__(
        self,
        panel: DevicesPanel,
        case: Case,
        choices: Sequence[Choice],
        default: str,
        entries: Callable[[Choice | None], Sequence[MenuEntry]],
    ) -> None:
        self._panel = panel
        self._case = case
        self._choices = choices
        self._default = default
        self._entries = entries
        self._text = ""
        self._chosen = ""
        panel.search_edited.connect(self.search)
        panel.row_chosen.connect(self.choose)
        panel.apply_requested.connect(self.apply)
        self.search("")

    @property
    def chosen(self) -> Choice | None:
        """What is chosen."""
        return next((c for c in self._choices if c.key == self._chosen), None)

    def renew(self, choices: Sequence[Choice], default: str, chosen: str = "") -> None:
        """Show other choices: one was stored, or made the default."""
        self._choices, self._default = choices, default
        self._chosen = chosen or self._chosen
        self.search(self._text)

    def search(self, text: str) -> None:
        """Show what holds all typed words."""
        self._text = text
        rows: list[ChoiceRow] = []
        kind = None
        for choice in matching(self._choices, text):
            if choice.kind is not kind:
                kind = choice.kind
                rows.append(ChoiceRow("", _heading(kind)))
            rows.append(ChoiceRow(choice.key, choice.name, self._note(choice)))
        self._panel.show_rows(rows, self._chosen or self._default)

    def choose(self, key: str) -> None:
        """Show what a choice would change."""
        self._chosen = key
        choice, design = self.chosen, self._case.record.design
        self._panel.show_entries(self._entries(choice))
        if choice is None or design is None:
            nothing = tr("Nothing holds these words; type others.")
            self._panel.show_details(ChoiceDetails(nothing, may_apply=False))
            return
        try:
            changed = choice.apply(design)
        except InsoleError as error:
            why = translate_core_message(error.message)
            notes = (why, *choice.notes)
            self._panel.show_details(ChoiceDetails(choice.name, notes=notes, may_apply=False))
            return
        self._panel.show_details(_details(choice, design, changed))

    def apply(self, key: str) -> None:
        """Apply a choice as one undo step."""
        choice = next(c for c in self._choices if c.key == key)
        design = self._case.record.design
        if design is not None:
            sentence = _SENTENCES[choice.kind]().format(name=choice.name)
            self._case.apply(choice.apply(design), sentence)

    def _note(self, choice: Choice) -> str:
        notes = []
        if choice.key == self._default:
            notes.append(tr("default"))
        if choice.is_own:
            notes.append(tr("own"))
        return ", ".join(notes)


def _details(choice: Choice, design: InsoleDesign, changed: InsoleDesign) -> ChoiceDetails:
    lines = design_differences(design, changed)
    changes = tuple(_change(line) for line in lines)
    same = () if changes else (tr("The design is like this already; nothing would change."),)
    return ChoiceDetails(choice.name, changes, (*same, *choice.notes))


def _change(line: Message) -> tuple[str, str, str]:
    """Return a difference as label, before and after."""
    values = {key: translate_core_message(str(value)) for key, value in line.values.items()}
    if values.keys() >= {"what", "before", "after"}:
        return values["what"], values["before"], values["after"]
    label, _colon, rest = translate_core_message(line).partition(": ")
    return label, "", rest


def _heading(kind: Kind) -> str:
    return {
        Kind.DEVICE: tr("Devices"),
        Kind.FINDING: tr("Findings"),
        Kind.FORM: tr("Base forms"),
    }[kind]


_SENTENCES: dict[Kind, Callable[[], str]] = {
    Kind.DEVICE: lambda: tr("Device: {name}"),
    Kind.FINDING: lambda: tr("Finding: {name}"),
    Kind.FORM: lambda: tr("Base form: {name}"),
}
