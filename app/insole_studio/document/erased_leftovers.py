"""What this computer still holds of somebody whom the record has erased."""

from __future__ import annotations

import logging
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from insole_studio.document.journal import Recovered, find_recovered
from insole_studio.settings import Settings, folder_names, save_settings
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_core.records.traces import Traces

log = logging.getLogger(__name__)


def forget_leftovers(traces: Traces, paths: UserPaths, settings: Settings) -> None:
    """Remove unsaved work, copies of captures and papers, and names of the person's files.

    What another window is writing is its own: it is dropped when that hands it over to the record.

    Raises
    ------
    OutputError
        When the settings cannot be written.
    """
    for journal in find_recovered(paths.autosave_folder):
        if _is_about(journal, traces):
            journal.discard()
        else:
            journal.release()
    for copy in paths.fetched_folder.glob("*-????????.*"):
        if any(capture.startswith(copy.stem[-8:]) for capture in traces.capture_ids):
            _remove(copy)
    shutil.rmtree(paths.papers_folder, ignore_errors=True)
    settings.recent = [name for name in settings.recent if not traces.are_in(name)]
    for name in folder_names():
        if traces.are_in(getattr(settings, name)):
            setattr(settings, name, "")
    save_settings(settings, paths.settings_file)


def _is_about(journal: Recovered, traces: Traces) -> bool:
    visit = journal.visit
    if visit is not None:
        return visit.visit_id in traces.visit_ids
    return traces.are_of(journal.record.patient)


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        log.warning("%s cannot be removed: %s", path, error)
