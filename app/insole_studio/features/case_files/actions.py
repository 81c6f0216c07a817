"""Actions that open, save and create cases."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.case_files.case_files import CaseFiles


CASE_FILE_ACTIONS: tuple[ActionRecord[CaseFiles], ...] = (
    ActionRecord(
        "new_case",
        lambda: tr("New case"),
        lambda: tr("Begin with an empty case"),
        lambda files, _on: files.opener.new_case(),
        shortcut="Ctrl+N",
    ),
    ActionRecord(
        "open",
        lambda: tr("Open case…"),
        lambda: tr("Open a case that was saved"),
        lambda files, _on: files.opener.ask_open_case(),
        icon="open",
        shortcut="Ctrl+O",
    ),
    ActionRecord(
        "open_session",
        lambda: tr("Open session…"),
        lambda: tr("Open the folder of a recorded session and reconstruct its foot"),
        lambda files, _on: files.opener.ask_open_session(),
        icon="session",
        shortcut="Ctrl+Shift+O",
    ),
    ActionRecord(
        "open_archive",
        lambda: tr("Import a scan…"),
        lambda: tr("Open the scan of another program, or a recorded session in one file"),
        lambda files, _on: files.opener.ask_open_mesh(),
        icon="mesh",
        shortcut="Ctrl+M",
    ),
    ActionRecord(
        "open_example",
        lambda: tr("Open the example"),
        lambda: tr("Open the case that comes with Insole Studio"),
        lambda files, _on: files.opener.open_example(),
    ),
    ActionRecord(
        "save",
        lambda: tr("Save"),
        lambda: tr("Save the case"),
        lambda files, _on: files.saver.save(),
        icon="save",
        shortcut="Ctrl+S",
    ),
    ActionRecord(
        "save_as",
        lambda: tr("Save as…"),
        lambda: tr("Save the case under another name"),
        lambda files, _on: files.saver.ask_save(),
        shortcut="Ctrl+Shift+S",
    ),
)
