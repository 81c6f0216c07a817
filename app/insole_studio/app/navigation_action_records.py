"""The actions that lead the keys from place to place."""

from __future__ import annotations

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

NAVIGATION_ACTIONS: tuple[ActionRecord, ...] = (
    ActionRecord(
        "next_correction",
        lambda: tr("Select the next correction"),
        lambda: tr("Select what stands below in the list"),
        lambda rooms, _on: rooms.navigating.select_next(1),
        shortcut="Ctrl+PgDown",
        needs_foot=True,
    ),
    ActionRecord(
        "previous_correction",
        lambda: tr("Select the correction before"),
        lambda: tr("Select what stands above in the list"),
        lambda rooms, _on: rooms.navigating.select_next(-1),
        shortcut="Ctrl+PgUp",
        needs_foot=True,
    ),
    ActionRecord(
        "edit_values",
        lambda: tr("Type the values"),
        lambda: tr("Go to the numbers of what is selected"),
        lambda rooms, _on: rooms.navigating.edit_values(),
        shortcut="F2",
        needs_foot=True,
    ),
    ActionRecord(
        "next_panel",
        lambda: tr("Next panel"),
        lambda: tr("Lead the keys to the next panel"),
        lambda rooms, _on: rooms.navigating.go_to_panel(1),
        shortcut="F6",
    ),
    ActionRecord(
        "previous_panel",
        lambda: tr("Panel before"),
        lambda: tr("Lead the keys to the panel before"),
        lambda rooms, _on: rooms.navigating.go_to_panel(-1),
        shortcut="Shift+F6",
    ),
    ActionRecord(
        "keys",
        lambda: tr("Keys…"),
        lambda: tr("All that the keys do"),
        lambda rooms, _on: rooms.guide.show_keys(),
        shortcut="Shift+F1",
    ),
)
