"""Atomic writing of a session."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from insole_core.files.atomic import replacing_file, replacing_folder, scratch_folder
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.progress import SILENT, Progress
from insole_core.recording.hand_edits import NO_EDITS
from insole_core.recording.hand_edits_file import NAME as EDITS
from insole_core.recording.hand_edits_file import edits_json
from insole_core.recording.images import encode_png
from insole_core.recording.manifest_json import manifest_json
from insole_core.recording.sensor_folder import write_sensor
from insole_core.recording.session import Session, View
from insole_core.recording.session_layout import foreign_in_session
from insole_core.recording.store import FolderStore


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
    _write_json(folder / "manifest.json", manifest_json(session.manifest))
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
    write_sensor(view.sensor, folder)
    for index in range(view.depth_count):
        (folder / f"depth_{index:03d}.png").write_bytes(encode_png(view.read_depth(index)))
    for index in range(view.color_count):
        (folder / f"color_{index:03d}.png").write_bytes(encode_png(view.read_color(index)))


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
