"""Files of cases, sessions and scans: opened, saved, and monitored for changes."""

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
from insole_studio.services.app_services import AppServices


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
