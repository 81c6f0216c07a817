"""What is written is what is read."""

from __future__ import annotations

import errno
import shutil
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.errors import OutputError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.recording.writer import write_session
from insole_core.sensing.sensor import Sensor


def contents(sensor: Sensor) -> dict[str, Any]:
    values = vars(sensor).copy()
    correction = values.pop("correction")
    return values | (vars(correction) if correction else {})


def assert_same(read: Session, written: Session) -> None:
    assert read.manifest == written.manifest
    for view, original in zip(read.views, written.views, strict=True):
        assert view.name == original.name
        assert (view.depth_count, view.color_count) == (original.depth_count, original.color_count)
        np.testing.assert_equal(contents(view.sensor), contents(original.sensor))
        for index in range(view.depth_count):
            np.testing.assert_array_equal(view.read_depth(index), original.read_depth(index))
        np.testing.assert_array_equal(view.read_color(0), original.read_color(0))


@pytest.mark.parametrize("name", ["copy", "copy.zip"])
def test_session_survives_the_disk(session: Session, tmp_path: Path, name: str) -> None:
    write_session(session, tmp_path / name)
    assert_same(read_session(tmp_path / name), session)
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_archive_with_one_top_folder(session: Session, folder: Path, tmp_path: Path) -> None:
    archive = shutil.make_archive(str(tmp_path / "packed"), "zip", tmp_path, "session")
    assert_same(read_session(Path(archive)), session)


def test_other_files_are_ignored(session: Session, folder: Path) -> None:
    (folder / "notes.txt").write_text("held by the assistant")
    (folder / "views" / "left" / "depth_preview.png").write_bytes(b"")
    (folder / "views" / "spare").mkdir()
    assert_same(read_session(folder), session)


def test_truth_is_written_with_a_simulated_session(session: Session, tmp_path: Path) -> None:
    triangle = TriangleMesh(np.eye(3) * 10, np.array([[0, 1, 2]], np.int32))
    write_session(session, tmp_path / "s.zip", triangle, {"left": np.eye(4), "top": np.eye(4)})
    with zipfile.ZipFile(tmp_path / "s.zip") as archive:
        assert {"truth.ply", "truth_poses.json"} <= set(archive.namelist())


def test_existing_session_is_replaced_as_a_whole(session: Session, folder: Path) -> None:
    left = folder / "views" / "left"
    shutil.copy(left / "depth_000.png", left / "depth_002.png")  # of another recording
    write_session(session, folder)
    assert_same(read_session(folder), session)
    assert [path.name for path in folder.parent.iterdir()] == ["session"]


@pytest.mark.parametrize("name", ["session", "s.zip"])
def test_failure_leaves_nothing_behind(
    session: Session, tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_path: Path, _data: bytes) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", fail)
    with pytest.raises(OutputError, match="the disk is full; free some space"):
        write_session(session, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_target_without_folder(session: Session, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="its folder does not exist"):
        write_session(session, tmp_path / "no" / "such" / "place")
    assert list(tmp_path.iterdir()) == []
