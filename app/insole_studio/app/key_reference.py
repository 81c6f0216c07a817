"""The list of keyboard shortcuts: those of actions, views and fields."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from insole_studio.app.actions import ACTIONS
from insole_studio.app.menus import MENUS
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr
from insole_studio.widgets.key_help import Line

VIEW_KEYS: tuple[tuple[Callable[[], str], str], ...] = (
    (lambda: tr("Move what is selected by 0.5 mm; Shift 5 mm, Ctrl 0.05 mm"), "← → ↑ ↓"),
    (lambda: tr("Raise or lower what is selected; with Ctrl finely. Else zoom"), "+  −"),
    (
        lambda: tr("Choose the next or previous handle or landmark; arrows drag it"),
        "PgDn  PgUp",
    ),
    (lambda: tr("Click where the cross is; end the drag; confirm the chosen landmark"), "Enter"),
    (lambda: tr("Press and hold where the cross is, or let go: draw, brush"), "Space"),
    (lambda: tr("The cross to where the tool is usually used"), "Home"),
    (lambda: tr("What can be done here"), "Shift+F10"),
    (lambda: tr("Remove what is chosen, else the selected correction"), "Del"),
    (lambda: tr("Undo the drag; nothing chosen; nothing selected; the Orbit tool"), "Esc"),
    (lambda: tr("Turn the view; with Shift, shift it"), "Alt+← → ↑ ↓"),
)
RIM_KEYS: tuple[tuple[Callable[[], str], str], ...] = (
    (lambda: tr("Choose the next or previous station"), "PgDn  PgUp"),
    (lambda: tr("Raise or lower it by 0.5 mm; Shift 5 mm, Ctrl 0.05 mm"), "↑ ↓"),
    (lambda: tr("Move it along the edge"), "← →"),
    (lambda: tr("Add a station midway to the next"), "Ins"),
    (lambda: tr("Remove it"), "Del"),
    (lambda: tr("Undo the drag; back to the view"), "Esc"),
)
PAGE_KEYS: tuple[tuple[Callable[[], str], str], ...] = (
    (lambda: tr("Open the first of the found patients"), "Enter"),
    (lambda: tr("From the search line into the list"), "↓"),
    (lambda: tr("Open the row of a list"), "Enter"),
    (lambda: tr("Empty the search line"), "Esc"),
    (lambda: tr("Choose a date in the calendar"), "F4, Alt+Down"),
)
FIELD_KEYS: tuple[tuple[Callable[[], str], str], ...] = (
    (lambda: tr("One step more or less; with Shift ten, with Ctrl a tenth"), "↑ ↓"),
    (lambda: tr("Take the number that was typed"), "Enter"),
    (lambda: tr("Leave the number as it was; back to the view"), "Esc"),
    (lambda: tr("The next field, the one before"), "Tab  Shift+Tab"),
)
WINDOW_KEYS: tuple[tuple[Callable[[], str], str], ...] = (
    (lambda: tr("Open a menu by its underlined letter"), "Alt+…"),
    (lambda: tr("Close the window of a stage"), "Ctrl+W"),
    (lambda: tr("Back from Check & export and Compare; first stop what is being made"), "Esc"),
    (lambda: tr("Go on from a stage: to the design; export"), "Ctrl+Enter"),
)


def key_sections() -> Iterator[tuple[str, list[Line]]]:
    """Yield the lines of the list, grouped under their headings."""
    yield tr("In the views"), [(text(), keys) for text, keys in VIEW_KEYS]
    yield tr("In the graph of the rim"), [(text(), keys) for text, keys in RIM_KEYS]
    yield tr("In the fields"), [(text(), keys) for text, keys in FIELD_KEYS]
    yield tr("On the pages of the record"), [(text(), keys) for text, keys in PAGE_KEYS]
    yield tr("In every window"), [(text(), keys) for text, keys in WINDOW_KEYS]
    records = {record.key: record for record in ACTIONS}
    for title, menu in MENUS:
        shown = [records[key] for key in menu if key in records and records[key].shortcut]
        yield title().replace("&", ""), [(r.text().replace("&&", "&"), _keys(r)) for r in shown]


def _keys(record: ActionRecord[Any]) -> str:
    return ", ".join(filter(None, (record.shortcut, record.other_shortcut)))
