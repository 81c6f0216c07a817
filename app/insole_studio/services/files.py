"""Files: their kinds and last folders, for file dialogs, and which were opened recently."""

from __future__ import annotations

import re
from enum import StrEnum
from pathlib import Path

from PySide6.QtCore import QObject, QStandardPaths, Signal

from insole_core.formats.file_formats import SCAN_SUFFIXES, patterns
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_studio.settings import Settings
from insole_studio.texts import tr

TEMPLATE_SUFFIX = ".insole-template"
DEVICE_SUFFIX = ".insole-device"
FINDING_SUFFIX = ".insole-findings"
MATERIALS_SUFFIX = ".insole-materials"
_WITH_ARCHIVES = patterns((".zip", *SCAN_SUFFIXES))


def case_kinds() -> str:
    """Return the filter for case files."""
    return tr("Insole Studio case") + f" (*{CASE_SUFFIX})"


def table_kinds() -> str:
    """Return the filter for tables of text."""
    return tr("Table") + " (*.csv *.txt *.tsv)"


def template_kinds() -> str:
    """Return the filter for template files."""
    return tr("Template of a prescription") + f" (*{TEMPLATE_SUFFIX})"


def device_kinds() -> str:
    """Return the filter for the files of devices."""
    return tr("Device of an insole") + f" (*{DEVICE_SUFFIX} *.json)"


def finding_kinds() -> str:
    """Return the filter for files of findings."""
    return tr("Findings") + f" (*{FINDING_SUFFIX} *.json)"


def material_kinds() -> str:
    """Return the filter for tables of materials."""
    return tr("Table of materials") + f" (*{MATERIALS_SUFFIX} *.json)"


def scan_kinds() -> str:
    """Return the filter for archives and meshes."""
    return tr("Session or mesh") + f" ({_WITH_ARCHIVES})"


def mesh_kinds() -> str:
    """Return the filter for meshes and archives with some."""
    return tr("Mesh or archive") + f" ({_WITH_ARCHIVES})"


def surface_kinds() -> str:
    """Return the filter for surfaces, such as lasts."""
    return tr("Surface") + f" ({patterns(SCAN_SUFFIXES)})"


def complete_name(typed: Path, kinds: str, chosen: str = "") -> Path:
    """Append a suffix to a typed name that has none of its kinds.

    What follows the last dot of a name need not be a suffix: "B. Name" is a name.

    Parameters
    ----------
    kinds
        Filter of the file dialog.
    chosen
        The part of the filter that the user has chosen; its first suffix is appended.
    """
    name = typed.name.lower()
    if any(name.endswith(suffix) and name != suffix for suffix in _suffixes(kinds)):
        return typed
    return typed.with_name(typed.name + (_suffixes(chosen) or _suffixes(kinds))[0])


def _suffixes(kinds: str) -> list[str]:
    return re.findall(r"\*(\.[^\s);]+)", kinds.lower())


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


class RecentFiles(QObject):
    """The list of recent files in the settings."""

    changed = Signal()

    def __init__(self, settings: Settings, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._settings = settings

    @property
    def names(self) -> list[str]:
        """Return the paths, the latest first."""
        return self._settings.recent

    def remember(self, path: Path) -> None:
        """Put a path at the head of the list."""
        self._settings.remember(path)
        self.changed.emit()
