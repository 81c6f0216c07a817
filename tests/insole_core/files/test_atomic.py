"""Results appear as a whole or not at all."""

from __future__ import annotations

import errno
import os
import shutil
import stat
import subprocess
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest

from insole_core.errors import OutputError
from insole_core.files.atomic import (
    make_private_folder,
    replacing_file,
    replacing_folder,
    write_private,
    write_text,
)
from insole_core.files.transaction import nothing_foreign
from insole_core.files.write_errors import describe


def test_file_takes_its_place_at_the_end(tmp_path: Path) -> None:
    target = tmp_path / "foot.ply"
    target.write_text("old")
    with replacing_file(target) as beside:
        beside.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def mode_of(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.fixture(params=[0o000, 0o022], ids=oct)
def umask(request: pytest.FixtureRequest) -> Iterator[int]:
    before = os.umask(request.param)
    yield request.param
    os.umask(before)


def test_new_file_is_private_from_the_first_byte(tmp_path: Path, umask: int) -> None:
    with replacing_file(tmp_path / "anna.insole") as beside:
        assert mode_of(beside) == 0o600
        beside.write_text("x")
    assert mode_of(tmp_path / "anna.insole") == 0o600


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o644], ids=oct)
def test_replaced_file_keeps_its_mode(tmp_path: Path, umask: int, mode: int) -> None:
    target = tmp_path / "anna.insole"
    target.touch()
    target.chmod(mode)
    with replacing_file(target) as beside:
        beside.write_text("x")
        assert mode_of(beside) == 0o600
    assert mode_of(target) == mode


@pytest.mark.skipif(getattr(os, "geteuid", int)() != 0, reason="only root gives away")
def test_replaced_file_keeps_its_group(tmp_path: Path) -> None:
    target = tmp_path / "anna.insole"
    target.touch()
    os.chown(target, -1, 4321)
    with replacing_file(target) as beside:
        beside.write_text("x")
    assert target.stat().st_gid == 4321


def test_a_group_that_cannot_be_kept_gets_no_access(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "anna.insole"
    target.touch()
    target.chmod(0o640)

    def refuse(*_arguments: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    kept = Path.stat

    def of_another_group(path: Path, **more: bool) -> os.stat_result:
        found = list(kept(path, **more))
        found[stat.ST_GID] += path == target
        return os.stat_result(found)

    monkeypatch.setattr(os, "chown", refuse)
    monkeypatch.setattr(Path, "stat", of_another_group)
    with replacing_file(target) as beside:
        beside.write_text("x")
    monkeypatch.undo()
    assert mode_of(target) == 0o600


@pytest.mark.parametrize("mode", [None, 0o700, 0o750, 0o755], ids=str)
def test_folder_and_its_content_are_private_or_as_before(
    tmp_path: Path, umask: int, mode: int | None
) -> None:
    target = tmp_path / "session"
    if mode is not None:
        target.mkdir()
        target.chmod(mode)
    with replacing_folder(target) as beside:
        assert mode_of(beside) == 0o700
        (beside / "views").mkdir()
        (beside / "views" / "depth.png").touch()
    expected = 0o700 if mode is None else mode
    assert mode_of(target) == mode_of(target / "views") == expected
    assert mode_of(target / "views" / "depth.png") == expected & 0o666


def test_nothing_touches_the_umask() -> None:
    """The umask belongs to the whole process: changing it opens the files of other threads."""
    root = Path(__file__).parents[3]
    sources = [p for top in ("app", "insole_core", "drivers") for p in (root / top).rglob("*.py")]
    assert [p for p in sources if "umask" in p.read_text(encoding="utf-8")] == []


replacing_own_folder = partial(replacing_folder, find_foreign=nothing_foreign)


@pytest.mark.parametrize("replacing", [replacing_file, replacing_own_folder])
def test_failure_keeps_what_was_there(tmp_path: Path, replacing: object) -> None:
    target = tmp_path / "result"
    if replacing is replacing_own_folder:
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
    with replacing_own_folder(target) as beside:
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


def refusing(error: OSError) -> Callable[..., None]:
    def refuse(*_arguments: object) -> None:
        raise error

    return refuse


@pytest.mark.parametrize("exists", [True, False])
@pytest.mark.parametrize(
    ("code", "sentence"),
    [
        (errno.EACCES, "you may not write there; choose another place"),
        (errno.EPERM, "it or its folder is protected against changes"),
        (errno.EROFS, "this disk can only be read"),
        (errno.ENOSPC, "the disk is full"),
        (errno.EDQUOT, "the disk is full"),
        (errno.EBUSY, "another program has it open"),
        (errno.ETXTBSY, "another program has it open"),
        (errno.ENAMETOOLONG, "the name is too long"),
        (errno.EIO, "Input/output error; choose another place"),
    ],
)
def test_place_that_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, exists: bool, code: int, sentence: str
) -> None:
    target = tmp_path / "insole.stl"
    if exists:
        target.write_text("old")
    monkeypatch.setattr(Path, "replace", refusing(OSError(code, os.strerror(code))))
    with pytest.raises(OutputError, match=sentence), replacing_file(target) as beside:
        beside.write_text("new")
    assert [p.read_text() for p in tmp_path.iterdir()] == ["old"] * exists


@pytest.mark.parametrize(
    ("exists", "sentence"), [(True, "another program has it open"), (False, "you may not write")]
)
def test_a_file_that_is_open_on_windows(tmp_path: Path, exists: bool, sentence: str) -> None:
    target = tmp_path / "insole.stl"
    if exists:
        target.touch()
    error = PermissionError(errno.EACCES, "Access is denied")
    error.winerror = 5  # type: ignore[attr-defined, unused-ignore]
    assert sentence in describe(target, error)


def set_immutable(path: Path, wanted: bool) -> None:
    call = ["chattr", "+i" if wanted else "-i", str(path)]
    if not shutil.which("chattr") or subprocess.run(call, check=False).returncode:
        pytest.skip("only root protects files, and not on every file system")


@pytest.fixture
def immutable(tmp_path: Path) -> Iterator[Path]:
    path = tmp_path / "anna.insole"
    path.write_text("old")
    set_immutable(path, True)
    yield path
    set_immutable(path, False)


def test_an_immutable_file_is_named_before_anything_is_computed(immutable: Path) -> None:
    with (
        pytest.raises(OutputError, match="protected against changes"),
        replacing_file(immutable),
    ):
        pytest.fail("nothing may be computed for a place that cannot be written")
    assert [path.read_text() for path in immutable.parent.iterdir()] == ["old"]


@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0, reason="root may write everywhere")
def test_a_file_without_permission_is_not_replaced(tmp_path: Path) -> None:
    target = tmp_path / "anna.insole"
    target.write_text("old")
    target.chmod(0o400)
    with pytest.raises(OutputError, match="you may not write there"), replacing_file(target):
        pytest.fail("nothing may be computed for a place that cannot be written")


def test_a_pipe_is_not_replaced(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OutputError, match="a device or a pipe"), replacing_file(tmp_path / "pipe"):
        pytest.fail("nothing may be computed for a place that cannot be written")
    assert (tmp_path / "pipe").is_fifo()


def test_a_pipe_that_was_made_meanwhile_is_not_replaced(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="a device or a pipe"), replacing_file(tmp_path / "pipe"):
        os.mkfifo(tmp_path / "pipe")
    assert [path.is_fifo() for path in tmp_path.iterdir()] == [True]


def write_to_full_disk(target: Path) -> None:
    with replacing_file(target), Path("/dev/full").open("wb") as full:
        full.write(b"x" * 100_000)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_full_disk_is_named(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="disk is full; free some space"):
        write_to_full_disk(tmp_path / "x")
    assert list(tmp_path.iterdir()) == []


def test_private_folder_and_file(tmp_path: Path, umask: int) -> None:
    tmp_path.chmod(0o755)
    make_private_folder(tmp_path / "a" / "b")
    write_private(tmp_path / "a" / "b" / "depth.png", b"x")
    parts = [tmp_path / "a", tmp_path / "a" / "b", tmp_path / "a" / "b" / "depth.png"]
    assert [mode_of(part) for part in parts] == [0o700, 0o700, 0o600]
    assert mode_of(tmp_path) == 0o755


def link_to(target: Path, link: Path) -> Path:
    link.symlink_to(target)
    return link


LINKS = {
    "a file": lambda home: link_to(home / "diary.txt", home / "link"),
    "nothing": lambda home: link_to(home / "nothing", home / "link"),
    "itself": lambda home: link_to(home / "link", home / "link"),
    "an empty folder": lambda home: link_to(home / "empty", home / "link"),
    "a link": lambda home: link_to(link_to(home / "diary.txt", home / "first"), home / "link"),
    "a device": lambda home: link_to(Path(os.devnull), home / "link"),
}


@pytest.fixture
def home(tmp_path: Path) -> Path:
    (tmp_path / "diary.txt").write_text("mine")
    (tmp_path / "empty").mkdir()
    return tmp_path


@pytest.mark.parametrize("replacing", [replacing_file, replacing_own_folder])
@pytest.mark.parametrize("kind", LINKS)
def test_a_link_is_no_place_for_a_result(home: Path, replacing: Callable, kind: str) -> None:
    link = LINKS[kind](home)
    before = sorted(home.rglob("*"))
    with pytest.raises(OutputError, match=r"link is a link to .*name .* itself"), replacing(link):
        pytest.fail("nothing may be computed for a place that is not taken")
    assert sorted(home.rglob("*")) == before
    assert link.is_symlink()
    assert (home / "diary.txt").read_text() == "mine"


@pytest.mark.parametrize("replacing", [replacing_file, replacing_own_folder])
def test_a_link_that_takes_the_place_meanwhile_is_not_followed(
    home: Path, replacing: Callable
) -> None:
    with pytest.raises(OutputError, match="is a link to"), replacing(home / "result"):
        (home / "result").symlink_to(home / "diary.txt")
    assert (home / "diary.txt").read_text() == "mine"
    assert (home / "result").is_symlink()
    assert len(list(home.iterdir())) == 3


def test_links_on_the_way_to_a_place_are_followed(home: Path) -> None:
    write_text("new", link_to(home / "empty", home / "share") / "insole.stl")
    assert (home / "empty" / "insole.stl").read_text() == "new"


def test_another_name_of_what_is_replaced_keeps_what_it_was(home: Path) -> None:
    os.link(home / "diary.txt", home / "insole.stl")
    write_text("new", home / "insole.stl")
    assert (home / "insole.stl").read_text() == "new"
    assert (home / "diary.txt").read_text() == "mine"
