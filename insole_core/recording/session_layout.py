"""Which files make a session, so that nothing else is overwritten or removed with one."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

from insole_core.files.temporary import is_left
from insole_core.files.transaction import any_file, check_file, check_folder
from insole_core.recording.hand_edits_file import NAME as EDITS
from insole_core.recording.manifest_json import FORMAT
from insole_core.recording.sensor_folder import CORRECTION_FILE, SENSOR_FILE
from insole_core.recording.store import MAX_FILE_BYTES

MANIFEST = "manifest.json"
_TRUTHS = ("truth.ply", "truth_left.ply", "truth_right.ply")
_IN_SESSION = (MANIFEST, EDITS, *_TRUTHS, "truth_poses.json")
_IN_VIEW = re.compile(
    rf"(?:depth_\d{{3,}}\.png|color_\d{{3,}}\.png|{re.escape(SENSOR_FILE)}"
    rf"|{re.escape(CORRECTION_FILE)})"
)
_FILE = re.compile(
    rf"(?:{'|'.join(map(re.escape, _IN_SESSION))}|views/[a-z0-9_]{{1,32}}/{_IN_VIEW.pattern})"
)
_FOLDER = re.compile(r"views(?:/[a-z0-9_]{1,32})?")
_BEGINNINGS = {".png": b"\x89PNG", ".npz": b"PK", ".ply": b"ply", ".json": b"{"}
_OF_THE_DESKTOP = (".DS_Store", "Thumbs.db", "desktop.ini")
"""What file managers leave in every folder that they show."""


def is_input_name(name: str) -> bool:
    """Return whether a file of this name is read wherever it lies in a folder of recordings."""
    return name in _IN_SESSION or _IN_VIEW.fullmatch(name) is not None


def foreign_in_session(folder: Path) -> str | None:
    """Return the path of a file within a folder that no session has; None for a whole session.

    An empty folder has none; without a manifest nothing in it is of a session.
    """
    if not (folder / MANIFEST).is_file():
        return any_file(folder)
    for place, folders, files in os.walk(folder):
        within = Path(place).relative_to(folder)
        folders[:] = [name for name in folders if not is_left(name)]
        for name in sorted(folders):
            inner = within / name
            if not _FOLDER.fullmatch(inner.as_posix()) or Path(place, name).is_symlink():
                return str(inner)
        for name in sorted(files):
            ours = name in _OF_THE_DESKTOP or is_left(name)
            if not ours and not _is_of_session(folder, within / name):
                return str(within / name)
    return None


def _is_of_session(folder: Path, inner: Path) -> bool:
    path = folder / inner
    if not _FILE.fullmatch(inner.as_posix()) or path.is_symlink() or not path.is_file():
        return False
    if inner.as_posix() == MANIFEST:
        return _is_manifest(path)
    beginning = _BEGINNINGS[inner.suffix]
    with path.open("rb") as file:
        return file.read(len(beginning)) == beginning


def _is_manifest(path: Path) -> bool:
    if path.stat().st_size > MAX_FILE_BYTES:
        return False
    try:
        values = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        return False
    return isinstance(values, dict) and values.get("format") == FORMAT


def check_session_target(path: Path) -> None:
    """Check that a session may be written to a folder or a ``.zip``, before it is made.

    Raises
    ------
    OutputError
        When the place cannot be written, or is a folder that holds anything but a session.
    """
    if path.suffix.lower() == ".zip":
        check_file(path)
    else:
        check_folder(path, foreign_in_session)
