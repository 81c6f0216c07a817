"""Results appear as a whole or not at all."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from insole_core.errors import OutputError
from insole_core.export.atomic import replacing_file, replacing_folder


def test_file_takes_its_place_at_the_end(tmp_path: Path) -> None:
    target = tmp_path / "foot.ply"
    target.write_text("old")
    with replacing_file(target) as beside:
        beside.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def test_file_has_ordinary_permissions(tmp_path: Path) -> None:
    with replacing_file(tmp_path / "a") as beside:
        beside.write_text("x")
    (tmp_path / "b").write_text("x")
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in "ab"}
    assert len(modes) == 1


@pytest.mark.parametrize("replacing", [replacing_file, replacing_folder])
def test_failure_keeps_what_was_there(tmp_path: Path, replacing: object) -> None:
    target = tmp_path / "result"
    if replacing is replacing_folder:
        target.mkdir()
        (target / "old").touch()
    else:
        target.write_text("old")
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(ZeroDivisionError), replacing(target):  # type: ignore[operator]
        raise ZeroDivisionError
    assert sorted(tmp_path.rglob("*")) == before


def test_folder_replaces_folder(tmp_path: Path) -> None:
    target = tmp_path / "session"
    target.mkdir()
    (target / "old").touch()
    with replacing_folder(target) as beside:
        (beside / "new").touch()
    assert sorted(tmp_path.rglob("*")) == [target, target / "new"]


def test_places_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    cases = [
        (replacing_file, tmp_path / "no" / "x.stl", "its folder does not exist"),
        (replacing_file, tmp_path / "folder", "a folder of that name is there"),
        (replacing_file, tmp_path / "file" / "x.stl", "a file is there where a folder is needed"),
        (replacing_folder, tmp_path / "file", "a file is there where a folder is needed"),
    ]
    for replacing, target, expected in cases:
        with pytest.raises(OutputError, match=expected), replacing(target):
            pytest.fail("nothing may be computed for a place that cannot be written")


@pytest.mark.parametrize(
    ("exists", "sentence"), [(True, "another program has it open"), (False, "you may not write")]
)
def test_place_that_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, exists: bool, sentence: str
) -> None:
    target = tmp_path / "insole.stl"
    if exists:
        target.write_text("old")

    def refuse(_self: Path, _target: Path) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(OutputError, match=sentence), replacing_file(target) as beside:
        beside.write_text("new")
    assert [p.read_text() for p in tmp_path.iterdir()] == ["old"] * exists


def write_to_full_disk(target: Path) -> None:
    with replacing_file(target), Path("/dev/full").open("wb") as full:
        full.write(b"x" * 100_000)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_full_disk_is_named(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="disk is full; free some space"):
        write_to_full_disk(tmp_path / "x")
    assert list(tmp_path.iterdir()) == []
