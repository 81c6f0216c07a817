"""The folders that file dialogs start in: where things of that kind were last opened or saved."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path

from PySide6.QtCore import QStandardPaths

from insole_studio.settings import Settings


class Kept(StrEnum):
    """What is kept in a folder; the value is the folder's name in the settings."""

    CASES = "cases_folder"
    SCANS = "scans_folder"
    EXPORTS = "exports_folder"
    PAPERS = "papers_folder"
    PICTURES = "pictures_folder"
    BACKUPS = "backups_parent_folder"
    RECORDS = "records_parent_folder"


class LastFolders:
    """The last folder of each kind, kept in the settings."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings

    def of(self, kept: Kept) -> Path:
        """Return the last folder; while there is none, or it is gone, that of the documents."""
        last = getattr(self._settings, kept)
        if last and Path(last).is_dir():
            return Path(last)
        place = QStandardPaths.StandardLocation.DocumentsLocation
        documents = Path(QStandardPaths.writableLocation(place))
        return documents if documents.is_dir() else Path.home()

    def remember(self, kept: Kept, folder: Path) -> None:
        """Start the next dialog of this kind in a folder, unless its name is no text."""
        try:
            str(folder).encode()
        except UnicodeEncodeError:
            return
        setattr(self._settings, kept, str(folder))
