"""Files of cases, sessions and scans: opened, saved, monitored for changes; and the actions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from insole_studio.document.autosave import Autosave
from insole_studio.features.case_files.case_guard import CaseGuard
from insole_studio.features.case_files.open_actions import ImportScan, OpenActions
from insole_studio.features.case_files.recovery import Recovery
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.features.case_files.scan_monitor import ScanMonitor
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

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


@dataclass(frozen=True, eq=False)
class CaseFiles:
    """The actions for opening and saving, the recovery of unsaved work, and the case's lock."""

    opener: OpenActions
    saver: SaveActions
    recovery: Recovery
    guard: CaseGuard

    def close(self) -> None:
        """Leave the open case, and recovered ones, to other windows."""
        self.guard.release()
        self.recovery.close()


def make_case_files(
    services: AppServices,
    autosave: Autosave,
    reconstruct: Callable[[Path], None],
    import_scan: ImportScan,
) -> CaseFiles:
    """Construct the feature.

    Parameters
    ----------
    services
        Services shared by all features.
    autosave
        Autosave of the open case.
    reconstruct
        Called with the path of a session to be reconstructed.
    import_scan
        Called with a scan that is no session.
    """
    ScanMonitor(services, services.window)
    guard = CaseGuard(services.case, services.paths.locks_folder, services.window)
    saver = SaveActions(services, guard)
    opener = OpenActions(services, saver, guard, reconstruct, import_scan)
    recovery = Recovery(services, saver, guard, autosave, opener.open_path)
    return CaseFiles(opener, saver, recovery, guard)
