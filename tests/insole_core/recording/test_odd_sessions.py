"""Sessions as other programs pack them, and limits of what a session may hold."""

from __future__ import annotations

import io
import json
import shutil
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from odd_archives import encrypted, with_backslashes, zip_of

from insole_core.errors import InputError
from insole_core.recording import reader
from insole_core.recording.manifest_json import MOST_MARKERS
from insole_core.recording.reader import read_session

Entries = list[tuple[str, bytes]]


def entries_of(archive: Path) -> Entries:
    with zipfile.ZipFile(archive) as opened:
        return [(name, opened.read(name)) for name in opened.namelist()]


MAC = [("__MACOSX/._manifest.json", b"\0\5\26\7"), ("__MACOSX/session/._views", b"\0\5\26\7")]
PACKED: dict[str, Callable[[Entries], bytes]] = {
    "by macOS": lambda entries: zip_of(*entries, *MAC),
    "by macOS, with its folder": lambda entries: zip_of(
        *((f"session/{name}", content) for name, content in entries), *MAC
    ),
    "on Windows": lambda entries: with_backslashes(zip_of(*entries)),
}


@pytest.mark.parametrize("how", PACKED)
def test_archives_of_other_programs_are_read(session_archive: Path, how: str) -> None:
    session_archive.write_bytes(PACKED[how](entries_of(session_archive)))
    assert [view.name for view in read_session(session_archive).views] == ["left", "top"]


@pytest.mark.parametrize(
    ("packed", "words"),
    [
        (lambda entries: encrypted(zip_of(*entries)), "is encrypted"),
        (lambda entries: zip_of(*entries, entries[0]), "holds .* twice"),
    ],
)
def test_archives_that_are_ambiguous_are_refused(
    session_archive: Path, packed: Callable[[Entries], bytes], words: str
) -> None:
    session_archive.write_bytes(packed(entries_of(session_archive)))
    with pytest.raises(InputError, match=words):
        read_session(session_archive)


def test_the_directory_of_an_archive_is_read_once(
    session_archive: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[bool] = []
    usual = zipfile.ZipFile.__init__

    def counted(self: zipfile.ZipFile, file: Any, *given: Any) -> None:
        opened.append(isinstance(file, io.BytesIO))  # a correction, which is an archive too
        usual(self, file, *given)

    monkeypatch.setattr(zipfile.ZipFile, "__init__", counted)
    for view in read_session(session_archive).views:
        view.read_depth(0)
    assert opened.count(False) == 1


@pytest.mark.slow
def test_frames_beyond_the_thousandth_are_counted(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    frames = folder / "views/left"
    for number in range(2, 1002):
        shutil.copy(frames / "depth_000.png", frames / f"depth_{number:03d}.png")
    with pytest.raises(InputError, match="holds 1002 depth frames, but a view has at most 1000"):
        read_session(folder)
    monkeypatch.setattr(reader, "MOST_FRAMES", 2000)
    assert read_session(folder).views[0].depth_count == 1002
    (frames / "depth_1000.png").unlink()
    with pytest.raises(InputError, match=r"depth_1000\.png is missing"):
        read_session(folder)


def test_errors_say_in_which_session(folder: Path, session_archive: Path) -> None:
    (folder / "manifest.json").write_text("{")
    session_archive.write_bytes(zip_of(("manifest.json", b"{")))
    for path in (folder, session_archive):
        with pytest.raises(InputError) as caught:
            read_session(path)
        assert str(caught.value).startswith(str(path))


def test_a_whole_disk_is_no_session(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deep = tmp_path / "somewhere" / "else"
    deep.mkdir(parents=True)
    visited: list[Path] = []
    usual = Path.is_file
    monkeypatch.setattr(Path, "is_file", lambda path: visited.append(path) or usual(path))
    (deep / "file").touch()
    with pytest.raises(InputError, match=r"holds no manifest\.json"):
        read_session(tmp_path)
    assert deep / "file" not in visited


def with_markers(count: int) -> Callable[[dict[str, Any]], None]:
    def change(manifest: dict[str, Any]) -> None:
        (first, *_) = manifest["reference_frame"]["markers"]
        manifest["reference_frame"]["markers"] = [
            {**first, "id": f"M{number}"} for number in range(count)
        ]

    return change


def far_away(manifest: dict[str, Any]) -> None:
    manifest["reference_frame"]["markers"][0]["position_mm"][2] = 1e308


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (with_markers(MOST_MARKERS + 1), "has 101 markers, but a reference system has at most"),
        (far_away, r"position_mm\[2\] is 1e\+308, but must lie between -10000 and 10000"),
        (lambda m: m["capture_condition"].update(notes=5), "notes must be a text"),
        (lambda m: m["volume_of_interest_mm"]["max"].__setitem__(0, 1e30), "must lie between"),
    ],
)
def test_numbers_that_no_capture_has(
    folder: Path, change: Callable[[dict[str, Any]], None], words: str
) -> None:
    manifest = json.loads((folder / "manifest.json").read_text())
    change(manifest)
    (folder / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(InputError, match=words):
        read_session(folder)
