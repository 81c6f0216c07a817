"""Atomic writing of a session, and which files make one, so that nothing else is overwritten."""

from __future__ import annotations

import json
import os
import re
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from insole_core.files.atomic import replacing_file, replacing_folder, scratch_folder
from insole_core.files.temporary import is_left
from insole_core.files.transaction import any_file, check_file, check_folder
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.progress import SILENT, Progress
from insole_core.recording.hand_edits import NO_EDITS
from insole_core.recording.hand_edits_file import NAME as EDITS
from insole_core.recording.hand_edits_file import edits_json, edits_path
from insole_core.recording.images import encode_png
from insole_core.recording.manifest_json import FORMAT, manifest_json
from insole_core.recording.sensor_folder import (
    CORRECTION_FILE,
    REFERENCE_FILE,
    SENSOR_FILE,
    write_sensor,
)
from insole_core.recording.session import Session, View
from insole_core.recording.store import MAX_FILE_BYTES, FolderStore, ZipStore

MANIFEST = "manifest.json"
_TRUTHS = ("truth.ply", "truth_left.ply", "truth_right.ply")
_IN_SESSION = (MANIFEST, EDITS, *_TRUTHS, "truth_poses.json")
_IN_VIEW = re.compile(
    rf"(?:(?:depth|color|infrared|infrared_left|infrared_right)_\d{{3,}}\.png|{re.escape(SENSOR_FILE)}"
    rf"|{re.escape(CORRECTION_FILE)}|{re.escape(REFERENCE_FILE)})"
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


def write_session(
    session: Session,
    path: Path,
    truth: TriangleMesh | Mapping[Side, TriangleMesh] | None = None,
    sensor2reference: dict[str, FloatArray] | None = None,
    progress: Progress = SILENT,
) -> None:
    """Write a session as a folder, or as a zip archive where `path` ends in ``.zip``.

    Parameters
    ----------
    truth : mm, reference frame, optional
        The true surface of a simulated session; of both feet, each in its own reference frame.
    sensor2reference
        The true poses of a simulated session, (4, 4), mm, by the name of the view.

    Raises
    ------
    OutputError
        When the place cannot be written, or is a folder that holds anything but a session; what
        was there before is untouched.
    Cancelled
    """
    if path.suffix.lower() == ".zip":
        with replacing_file(path) as beside, scratch_folder(path) as parts:
            _write_parts(session, parts, truth, sensor2reference, progress)
            pack_session(parts, beside)
    else:
        with replacing_folder(path, foreign_in_session) as folder:
            _write_parts(session, folder, truth, sensor2reference, progress)


def _write_parts(
    session: Session,
    folder: Path,
    truth: TriangleMesh | Mapping[Side, TriangleMesh] | None,
    sensor2reference: dict[str, FloatArray] | None,
    progress: Progress,
) -> None:
    metric = any(view.sensor.depth_unit_mm is not None for view in session.views)
    manifest = replace(session.manifest, metric=metric)
    _write_json(folder / "manifest.json", manifest_json(manifest))
    if session.edits != NO_EDITS:
        _write_json(folder / EDITS, edits_json(session.edits))
    for index, view in enumerate(session.views):
        progress.step(index / len(session.views), "Writing view {view}", view=view.name)
        _write_view(view, folder / "views" / view.name)
    if isinstance(truth, TriangleMesh):
        write_ply(truth, folder / "truth.ply")
    elif truth is not None:
        for side, mesh in truth.items():
            write_ply(mesh, folder / f"truth_{side}.ply")
    if sensor2reference is not None:
        poses = {name: pose.tolist() for name, pose in sensor2reference.items()}
        _write_json(folder / "truth_poses.json", {"sensor2reference": poses})


def _write_view(view: View, folder: Path) -> None:
    folder.mkdir(parents=True)
    dots = view.dots
    write_sensor(view.sensor, folder, view.times, dots)
    for index in range(view.depth_count):
        (folder / f"depth_{index:03d}.png").write_bytes(encode_png(view.read_depth(index)))
    for index in range(view.color_count):
        (folder / f"color_{index:03d}.png").write_bytes(encode_png(view.read_color(index)))
    infrared = dict(view.infrared)
    if dots is not None and dots.pictures is not None:
        infrared["infrared"] = dots.pictures
    for kind, pictures in infrared.items():
        for index in range(pictures.count):
            picture = pictures.read(index)
            stored = picture.astype(np.uint8) if pictures.bits == 8 else picture
            (folder / f"{kind}_{index:03d}.png").write_bytes(encode_png(stored))


def _write_json(path: Path, values: dict[str, Any]) -> None:
    path.write_text(
        json.dumps(values, indent=1, ensure_ascii=False) + "\n", encoding="utf-8", newline="\n"
    )


def pack_session(folder: Path, archive: Path) -> None:
    """Write the files of a session folder, as they are, into an archive of a session.

    Parameters
    ----------
    archive
        An unfinished file, such as one of `replacing_file`.

    Raises
    ------
    OSError
        When a file cannot be read, or the archive not be written.
    """
    # PNG and npz are already compressed.
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_STORED) as opened:
        for name in FolderStore(folder).names():
            opened.write(folder / name, name)


def pack_corrected(session: Path, archive: Path) -> None:
    """Write the archive of a session once more, with the corrections that lie beside it inside.

    Parameters
    ----------
    archive
        As for `pack_session`.

    Raises
    ------
    InputError
        When a file of the session cannot be read.
    OSError
        When the corrections cannot be read, or the archive not be written.
    """
    store = ZipStore(session)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_STORED) as opened:
        for name in store.names():
            if name != EDITS:
                opened.writestr(zipfile.ZipInfo(name), store.read(name))
        opened.writestr(zipfile.ZipInfo(EDITS), edits_path(session).read_bytes())
