"""Only an earlier session makes room for a new one."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from insole_core.errors import OutputError
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.recording.session import Session
from insole_core.recording.writer import foreign_in_session, write_session


def test_a_session_with_all_that_belongs_to_it_is_no_stranger(folder: Path) -> None:
    write_edits(HandEdits().with_view("left", ViewEdits(off=True)), folder)
    (folder / "truth.ply").write_bytes(b"ply\n")
    (folder / "truth_poses.json").write_text("{}")
    (folder / "views" / ".DS_Store").write_bytes(b"of the desktop")
    left = f".insole-studio-{2**22 - 1}-0123456789ab"
    (folder / f"{left}.json").write_text("of a command that was killed")
    (folder / "views" / left / "views").mkdir(parents=True)
    assert foreign_in_session(folder) is None


def test_an_empty_folder_is_no_stranger(tmp_path: Path) -> None:
    assert foreign_in_session(tmp_path) is None


FOREIGN: dict[str, tuple[Callable[[Path], object], str]] = {
    "a text": (lambda f: (f / "thesis.txt").write_text("mine"), "thesis.txt"),
    "a text deep within": (lambda f: (f / "views/left/a.txt").write_text("mine"), "a.txt"),
    "a folder": (lambda f: (f / "photos").mkdir(), "photos"),
    "a folder of no view": (lambda f: (f / "views" / "My Photos").mkdir(), "My Photos"),
    "a frame that is none": (lambda f: (f / "views/left/depth_007.png").write_text("x"), "depth"),
    "a manifest of another program": (
        lambda f: (f / "manifest.json").write_text('{"name": "my web page"}'),
        "manifest.json",
    ),
    "a manifest that is no text": (
        lambda f: (f / "manifest.json").write_bytes(b"\xff\x00"),
        "manifest.json",
    ),
    "no manifest": (lambda f: (f / "manifest.json").unlink(), "views"),
    "a link to a file": (
        lambda f: (f / "views/left/depth_007.png").symlink_to(f / "views/left/depth_000.png"),
        "depth_007",
    ),
    "a link to a folder": (lambda f: (f / "views/spare").symlink_to(f / "views/left"), "spare"),
    "another session within": (
        lambda f: shutil.copytree(f / "views" / "top", f / "views" / "left" / "top"),
        "top",
    ),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_nothing_unknown_is_removed(session: Session, folder: Path, name: str) -> None:
    change, found = FOREIGN[name]
    change(folder)
    before = {path: path.lstat().st_ino for path in folder.parent.rglob("*")}
    with pytest.raises(
        OutputError, match=f"holds .*{found}.*, which is not part of an earlier result"
    ):
        write_session(session, folder)
    assert {path: path.lstat().st_ino for path in folder.parent.rglob("*")} == before
