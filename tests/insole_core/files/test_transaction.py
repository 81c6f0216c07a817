"""The results of one command take their places together, whatever interrupts it."""

from __future__ import annotations

import errno
import itertools
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import killed_transaction
import pytest

from insole_core.errors import InputError, OutputError, UsageError
from insole_core.files import journal, temporary
from insole_core.files.atomic import copy_into, replacing_file, replacing_folder, write_text
from insole_core.files.journal import settle_interrupted
from insole_core.files.temporary import started, state_folder_of_user, this_computer
from insole_core.files.transaction import Transaction, nothing_foreign

OLD = {
    "insole.stl": "old",
    "other disk/sheet.pdf": "old",
    "session/manifest.json": "old",
}
NEW = {
    "checks.json": "new",
    "insole.stl": "new",
    "other disk/sheet.pdf": "new",
    "session/view.png": "new",
}


@pytest.fixture(autouse=True)
def state_folder(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's folder of journals."""
    folder = tmp_path_factory.mktemp("state") / "insole-studio"
    monkeypatch.setattr(temporary.platformdirs, "user_state_path", lambda *_a, **_k: folder)
    return folder


@pytest.fixture
def place(tmp_path: Path) -> Path:
    killed_transaction.prepare(tmp_path / "exports")
    return tmp_path / "exports"


def visible(contents: dict[str, str]) -> dict[str, str]:
    return {name: text for name, text in contents.items() if ".insole-studio-" not in name}


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
@pytest.mark.parametrize("disk", [(), ("--without-links",)], ids=["links", "no links"])
def test_killed_at_any_step_all_is_old_or_all_is_new_after_the_next_start(
    tmp_path: Path, disk: tuple[str, ...]
) -> None:
    done = subprocess.run(
        [sys.executable, str(killed_transaction.__file__), str(tmp_path / "exports"), *disk],
        capture_output=True, text=True, check=True,
        env={**os.environ, "XDG_STATE_HOME": str(tmp_path / "state")},
    )  # fmt: skip
    outcomes = [json.loads(line) for line in done.stdout.splitlines()]
    statuses = [status for status, _, _ in outcomes]
    assert statuses == [-signal.SIGKILL] * (len(outcomes) - 1) + [0]
    for _, left, settled in outcomes:
        assert visible(settled) in (OLD, NEW)
        # A file is never absent, not even for the moment; a folder may be.
        assert {"insole.stl", "other disk/sheet.pdf"} <= left.keys()
        assert not any("old-" in name for name in settled)
    assert visible(outcomes[0][2]) == OLD
    assert outcomes[-1][2] == outcomes[-1][1] == NEW
    mixed = [left for _, left, _ in outcomes if visible(left) not in (OLD, NEW)]
    assert len(mixed) >= 4  # else the kills have missed the moments that matter
    assert list((tmp_path / "state" / "insole-studio").iterdir()) == []


def failing_at(
    number: int, error: BaseException, monkeypatch: pytest.MonkeyPatch
) -> Callable[[], int]:
    """Let the n-th renaming fail; return how many there were."""
    calls = 0

    def failing(real: Callable[..., Any]) -> Callable[..., Any]:
        def call(source: Any, target: Any, **more: Any) -> Any:
            nonlocal calls
            calls += 1
            if calls == number:
                raise error
            return real(source, target, **more)

        return call

    for name in ("replace", "rename", "link"):
        monkeypatch.setattr(os, name, failing(getattr(os, name)))
    return lambda: calls


@pytest.mark.parametrize(
    "interruption", [OSError(errno.EACCES, "no"), KeyboardInterrupt()], ids=repr
)
def test_failure_of_any_rename_leaves_all_as_it_was(
    place: Path, interruption: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = OutputError if isinstance(interruption, OSError) else KeyboardInterrupt
    failures = 0
    for number in range(1, 30):
        killed_transaction.prepare(place)
        with monkeypatch.context() as patch:
            count = failing_at(number, interruption, patch)
            try:
                killed_transaction.write(place)
            except expected:
                failures += 1
                assert killed_transaction.contents(place) == OLD
            else:  # also without a journal, or without a second name of a file
                assert killed_transaction.contents(place) == NEW
            if count() < number:
                break
    assert failures >= 4
    assert list(state_folder_of_user().iterdir()) == []


def test_the_place_that_refused_is_named(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.replace

    def refuse(source: Any, target: Any) -> None:
        if Path(target).name == "sheet.pdf":
            raise PermissionError(errno.EACCES, "no", str(source), None, str(target))
        real(source, target)

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OutputError, match=r"sheet\.pdf cannot be written: you may not"):
        killed_transaction.write(place)
    assert killed_transaction.contents(place) == OLD


def test_what_cannot_be_taken_back_is_settled_by_the_next_start(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        real = os.replace

        def refuse(source: Any, target: Any) -> None:
            if Path(target).name in ("sheet.pdf", "session") and Path(target).parent != Path():
                raise PermissionError(errno.EACCES, "open in another program")
            real(source, target)

        patch.setattr(os, "replace", refuse)
        with pytest.raises(OutputError):
            killed_transaction.write(place)
    assert not (place / "session").exists()
    settle_interrupted(state_folder_of_user())
    assert killed_transaction.contents(place) == NEW


@pytest.fixture
def not_begun(place: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where a transaction could neither make its moves nor take them back."""

    def refuse(_move: journal.Move) -> None:
        raise PermissionError(errno.EACCES, "no")

    with monkeypatch.context() as patch:
        patch.setattr(journal.Move, "make", refuse)
        patch.setattr(journal.Move, "take_back", refuse)
        with pytest.raises(OutputError):
            killed_transaction.write(place)
    return place


def test_a_journal_waits_for_a_disk_that_is_not_there(not_begun: Path) -> None:
    place = not_begun
    away = (place / "other disk").rename(place.parent / "away")
    settle_interrupted(state_folder_of_user())
    assert visible(killed_transaction.contents(place)) == {
        n: t for n, t in OLD.items() if "disk" not in n
    }
    away.rename(place / "other disk")
    settle_interrupted(state_folder_of_user())
    assert killed_transaction.contents(place) == NEW


def test_what_took_a_place_after_the_kill_is_kept(not_begun: Path) -> None:
    (not_begun / "checks.json").write_text("newer")
    settle_interrupted(state_folder_of_user())
    assert visible(killed_transaction.contents(not_begun)) == {**OLD, "checks.json": "newer"}
    assert list(state_folder_of_user().iterdir()) == []


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, SystemExit])
def test_taking_back_is_completed_before_an_interruption_ends_the_work(
    place: Path, interruption: type[BaseException], monkeypatch: pytest.MonkeyPatch
) -> None:
    ended = 0
    for number in itertools.count(1):
        killed_transaction.prepare(place)
        with monkeypatch.context() as patch:
            count = interrupted_while_taking_back(number, interruption(), patch)
            with pytest.raises((interruption, OutputError)) as told:
                killed_transaction.write(place)
        ended += told.type is interruption
        assert visible(killed_transaction.contents(place)) == OLD
        settle_interrupted(state_folder_of_user())
        assert visible(killed_transaction.contents(place)) in (OLD, NEW)
        assert list(state_folder_of_user().iterdir()) == []
        if count() < number:
            break
    assert ended >= 8


def interrupted_while_taking_back(
    number: int, interruption: BaseException, monkeypatch: pytest.MonkeyPatch
) -> Callable[[], int]:
    """Let the last move fail, and interrupt the n-th step after that; return their number."""
    calls = 0
    failed = False

    def noted(real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **more: Any) -> Any:
            nonlocal calls, failed
            if not failed and real is replace and Path(arguments[-1]).name == "checks.json":
                failed = True
                raise PermissionError(errno.EACCES, "no")
            calls += failed
            if calls == number and failed:
                calls += 1
                raise interruption
            return real(*arguments, **more)

        return call

    replace = os.replace
    for name in ("replace", "rename", "unlink", "fsync"):
        monkeypatch.setattr(os, name, noted(getattr(os, name)))
    return lambda: calls


def test_work_that_is_interrupted_again_and_again_is_settled_by_the_next_start(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = journal.Move.take_back

    def interrupted(move: journal.Move) -> None:
        real(move)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(journal, "_sync_folders", interrupt)
        patch.setattr(journal.Move, "take_back", interrupted)
        with pytest.raises(KeyboardInterrupt):
            killed_transaction.write(place)
    assert visible(killed_transaction.contents(place)) not in (OLD, NEW)
    settle_interrupted(state_folder_of_user())
    assert killed_transaction.contents(place) == NEW


def interrupt(_moves: object) -> None:
    raise KeyboardInterrupt


def writing_before(
    name: str, target: Path, real: Callable[..., Any], write: Callable[[], None]
) -> Callable[..., Any]:
    """Let somebody else write once, just before the result takes its place."""
    waiting = [write]

    def call(source: Any, destination: Any, **more: Any) -> Any:
        if Path(destination) == target and waiting:
            waiting.pop()()
        return real(source, destination, **more)

    call.__name__ = name
    return call


@pytest.fixture
def no_links(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "link", killed_transaction.refuse_links)


@pytest.mark.usefixtures("no_links")
def test_without_links_the_place_of_a_file_is_never_empty(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []

    def look() -> None:
        seen.append((place / "insole.stl").read_text())

    monkeypatch.setattr(
        os, "replace", writing_before("replace", place / "insole.stl", os.replace, look)
    )
    killed_transaction.write(place)
    assert seen == ["old"]
    assert killed_transaction.contents(place) == NEW


@pytest.mark.usefixtures("no_links")
def test_without_links_what_is_replaced_and_what_came_meanwhile_both_stay(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = journal.sync

    def write_after_the_copy(path: Path) -> None:
        real(path)
        if path.name.startswith(".insole-studio-old-"):
            (place / "insole.stl").write_text("newer")

    monkeypatch.setattr(journal, "sync", write_after_the_copy)
    with pytest.raises(OutputError):
        killed_transaction.write(place)
    assert killed_transaction.contents(place) == {**OLD, "insole.stl": "newer"}


def test_a_folder_that_came_meanwhile_stays_beside_the_one_it_replaced(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write() -> None:
        (place / "session").mkdir()
        (place / "session" / "notes.txt").write_text("newer")

    monkeypatch.setattr(
        os, "replace", writing_before("replace", place / "session", os.replace, write)
    )
    with pytest.raises(OutputError):
        killed_transaction.write(place)
    assert killed_transaction.contents(place) == {
        "insole.stl": "old",
        "other disk/sheet.pdf": "old",
        "session/notes.txt": "newer",
        "session (2)/manifest.json": "old",
    }
    assert list(state_folder_of_user().iterdir()) == []


def test_what_was_written_over_a_result_is_not_taken_back_with_it(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write_and_fail() -> None:
        (place / "insole.stl").write_text("newer")
        os.utime(place / "insole.stl", (1, 1))
        raise PermissionError(errno.EACCES, "no")

    monkeypatch.setattr(
        os, "replace", writing_before("replace", place / "checks.json", os.replace, write_and_fail)
    )
    with pytest.raises(OutputError):
        killed_transaction.write(place)
    assert killed_transaction.contents(place) == {**OLD, "insole.stl": "newer"}


def refusing(real: Callable[..., Any], is_refused: Callable[[str], bool]) -> Callable[..., Any]:
    def call(path: Any, *more: Any, **named: Any) -> Any:
        if is_refused(Path(path).name):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return real(path, *more, **named)

    return call


def test_what_was_replaced_and_resists_does_not_fail_the_results(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(os, "unlink", refusing(os.unlink, lambda name: "-old-" in name))
        killed_transaction.write(place)
    left = killed_transaction.contents(place)
    assert visible(left) == NEW
    assert sum("-old-" in name for name in left) == 2
    (place / "checks.json").unlink()  # by its user, who knows it as done
    settle_interrupted(state_folder_of_user())
    assert killed_transaction.contents(place) == {n: t for n, t in NEW.items() if n[0] != "c"}
    assert list(state_folder_of_user().iterdir()) == []


def test_a_journal_that_cannot_be_removed_does_not_fail_the_results(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        is_journal = lambda name: name.endswith((".journal", ".made"))  # noqa: E731
        patch.setattr(os, "unlink", refusing(os.unlink, is_journal))
        killed_transaction.write(place)
    assert killed_transaction.contents(place) == NEW
    settle_interrupted(state_folder_of_user())
    assert killed_transaction.contents(place) == NEW
    assert list(state_folder_of_user().iterdir()) == []


def test_the_first_error_is_told_and_all_is_cleaned_up_that_can_be(
    place: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    opened: list[Path] = []

    def work() -> None:
        with Transaction() as outputs:
            opened.extend(outputs.file(place / f"{number}.stl") for number in range(3))
            raise ZeroDivisionError

    with monkeypatch.context() as patch:
        is_second = lambda name: name == opened[1].name  # noqa: E731
        patch.setattr(os, "unlink", refusing(os.unlink, is_second))
        with pytest.raises(ZeroDivisionError):
            work()
    assert [path.exists() for path in opened] == [False, True, False]
    assert not any(map(temporary.is_unfinished, opened))
    assert opened[1].name in caplog.text


def test_a_full_disk_is_told_though_its_folder_is_gone(place: Path) -> None:
    def work() -> None:
        with Transaction() as outputs:
            outputs.file(place / "session" / "insole.stl")
            shutil.rmtree(place / "session")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.raises(OutputError, match="the disk is full"):
        work()


@pytest.fixture
def other_user() -> Iterator[None]:
    """The user of the tests, but never root, who may read everything."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="this system has no modes of files")
@pytest.mark.usefixtures("other_user")
def test_a_folder_that_may_be_written_but_not_read_takes_results() -> None:
    with tempfile.TemporaryDirectory() as name:  # of pytest's, other users enter none
        folder = Path(name, "inbox")
        folder.mkdir()
        (folder / "sheet.pdf").write_text("old")
        (folder / "sheet.pdf").chmod(0o200)
        folder.chmod(0o300)
        try:
            with Transaction() as outputs:
                outputs.file(folder / "insole.stl").write_text("new")
                outputs.file(folder / "sheet.pdf").write_text("new")
            write_text("new", folder / "checks.json")
        finally:
            folder.chmod(0o700)
        (folder / "sheet.pdf").chmod(0o600)
        assert killed_transaction.contents(folder) == {
            "checks.json": "new", "insole.stl": "new", "sheet.pdf": "new",
        }  # fmt: skip


def test_without_a_place_for_the_journal_the_work_is_done(
    place: Path, state_folder: Path, caplog: pytest.LogCaptureFixture
) -> None:
    state_folder.write_text("in the way")
    killed_transaction.write(place)
    assert killed_transaction.contents(place) == NEW
    assert "Without a journal" in caplog.text


def test_journals_that_may_not_be_looked_for_stop_nothing(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Path) -> Iterator[Path]:
        raise PermissionError(errno.EACCES, "Permission denied", str(path))

    monkeypatch.setattr(Path, "iterdir", refuse)
    settle_interrupted(state_folder_of_user())
    write_text("new", place / "insole.stl")
    assert (place / "insole.stl").read_text() == "new"


@pytest.fixture
def half_done(tmp_path: Path, state_folder: Path) -> Path:
    """Two files of a program that was killed hours ago, after it had replaced the first."""
    folder, ours = tmp_path, f".insole-studio-{os.getpid()}-"
    moves = [
        {
            "beside": str(folder / f"{ours}00000000000{number}"),
            "path": str(folder / name),
            "old": str(folder / f".insole-studio-old-00000000000{number}"),
            "replaces": True,
        }
        for number, name in enumerate(("insole.stl", "sheet.pdf"))
    ]
    for move in moves:
        Path(move["path"]).write_text("old")
        os.link(move["path"], move["old"])
        Path(move["beside"]).write_text("new")
        os.utime(move["beside"], (1, 1))
    Path(moves[0]["beside"]).replace(moves[0]["path"])
    state_folder.mkdir()
    (state_folder / f"{ours}0123456789ab.journal").write_text(json.dumps(moves))
    return folder


def test_what_a_journal_needs_is_not_swept(half_done: Path) -> None:
    write_text("", half_done / "other.txt")
    assert (half_done / "insole.stl").read_text() == "new"
    assert (half_done / "sheet.pdf").read_text() == "new"


def test_moves_whose_result_somebody_else_swept_are_taken_back(half_done: Path) -> None:
    for left in half_done.glob(f".insole-studio-{os.getpid()}-*"):
        left.unlink()
    settle_interrupted(state_folder_of_user())
    assert (half_done / "insole.stl").read_text() == "old"
    assert (half_done / "sheet.pdf").read_text() == "old"


def test_the_journal_of_a_process_that_runs_is_left_alone(state_folder: Path) -> None:
    state_folder.mkdir()
    running = state_folder / f".insole-studio-{os.getppid()}-0123456789ab.journal"
    running.write_text("[")
    settle_interrupted(state_folder)
    assert running.exists()


@pytest.mark.parametrize("text", ["[", "[1]", '[{"beside": "x"}]', "{}"])
def test_a_damaged_journal_does_not_keep_the_program_from_starting(
    state_folder: Path, text: str
) -> None:
    state_folder.mkdir()
    (state_folder / f".insole-studio-{os.getpid()}-0123456789ab.journal").write_text(text)
    settle_interrupted(state_folder)


SPELLINGS = {
    "same": lambda path: path,
    "other spelling": lambda path: path.parent / "." / ".." / path.parent.name / path.name,
    "capitals": lambda path: path.with_name("INSOLE.STL"),
    "symlink": lambda path: linked(path, os.symlink),
    "hard link": lambda path: linked(path, os.link),
}


def linked(path: Path, link: Callable[[Path, Path], None]) -> Path:
    link(path, path.with_name("link.stl"))
    return path.with_name("link.stl")


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_two_results_of_one_place_are_refused(place: Path, spelling: str) -> None:
    path = place / "insole.stl"
    other = SPELLINGS[spelling](path)
    before = killed_transaction.contents(place)
    with pytest.raises(UsageError, match="named for two results"), Transaction() as outputs:
        list(map(outputs.file, (path, other)))
    assert killed_transaction.contents(place).keys() == before.keys()


@pytest.mark.parametrize("name", [".", "..", "{folder}"])
def test_the_folder_that_one_works_in_is_not_replaced(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "here" / "below"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    with (
        pytest.raises(OutputError, match="the folder that you work in"),
        replacing_folder(Path(name.format(folder=folder)), nothing_foreign),
    ):
        pytest.fail("nothing may be computed for a place that cannot be written")
    assert list(tmp_path.iterdir()) == [folder.parent]
    assert list(folder.parent.iterdir()) == [folder]


def test_a_folder_with_anything_in_it_is_not_replaced(place: Path) -> None:
    with (
        pytest.raises(
            OutputError, match=r"holds manifest\.json, which is not part of an earlier result"
        ),
        replacing_folder(place / "session"),
    ):
        pytest.fail("nothing may be computed for a place that cannot be written")
    assert killed_transaction.contents(place) == OLD


def test_what_came_into_a_folder_meanwhile_is_kept(tmp_path: Path) -> None:
    (tmp_path / "session").mkdir()
    with pytest.raises(OutputError, match=r"holds thesis\.txt"):
        replace_while_somebody_writes(tmp_path / "session")
    assert killed_transaction.contents(tmp_path) == {"session/thesis.txt": "mine"}


def replace_while_somebody_writes(folder: Path) -> None:
    with replacing_folder(folder) as beside:
        (beside / "new").touch()
        (folder / "thesis.txt").write_text("mine")


DEAD = 2**22 - 1  # no process: the largest number of Linux, beyond that of macOS


def name_of(process: int, start: str = "0") -> str:
    """Return a name that a process of this computer would have given to something unfinished."""
    return f".insole-studio-{process}-{this_computer()}-{start}-0123456789ab"


def left_file(folder: Path, process: int, age_s: float) -> Path:
    """Leave a file as another computer would, or a version of before that named none."""
    path = folder / f".insole-studio-{process}-0123456789ab.stl"
    path.write_text("half")
    os.utime(path, (time.time() - age_s, time.time() - age_s))
    return path


@pytest.mark.parametrize(
    ("process", "age_s", "stays"),
    [
        (DEAD, 2 * temporary.GRACE_S, False),
        (os.getpid(), 2 * temporary.GRACE_S, False),  # an earlier process of the same number
        (DEAD, 0.0, True),
        (os.getppid(), 2 * temporary.GRACE_S, True),
    ],
    ids=["of a dead one", "of its own number", "young", "of a living one"],
)
def test_what_killed_programs_left_is_swept_where_one_writes(
    tmp_path: Path, process: int, age_s: float, stays: bool
) -> None:
    left = left_file(tmp_path, process, age_s)
    write_text("new", tmp_path / "insole.stl")
    assert left.exists() == stays


def test_a_computer_is_the_same_for_all_processes_whatever_it_shows(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A container without a network card, and without the files of its system."""
    drawn = iter(range(1 << 40, (1 << 40) + 9))
    monkeypatch.setattr("uuid.getnode", lambda: next(drawn))
    monkeypatch.setattr(temporary, "_BOOT", tmp_path / "nothing")
    of_each_process = {this_computer.__wrapped__() for _ in range(2)}
    assert len(of_each_process) == 1
    monkeypatch.setattr("uuid.getnode", lambda: 0x001122334455)
    assert this_computer.__wrapped__() not in of_each_process


@pytest.mark.parametrize("kind", ["file", "folder"])
@pytest.mark.parametrize(
    ("name", "stays"),
    [
        (name_of(DEAD), False),
        (name_of(os.getpid(), "1"), False),
        (name_of(os.getppid(), "1"), False),  # which has got the number of one that ended
        (name_of(os.getppid(), started(os.getppid())), True),
        (name_of(os.getppid()), True),
        (name_of(DEAD).replace(this_computer(), "01234567"), True),
    ],
    ids=["dead", "own number", "number of another", "living", "maybe living", "elsewhere"],
)
def test_what_is_known_to_be_of_a_dead_process_goes_at_once(
    tmp_path: Path, name: str, stays: bool, kind: str
) -> None:
    left = tmp_path / f"{name}.insole"
    if kind == "file":
        left.write_text("half")
    else:
        (left / "views").mkdir(parents=True)
    write_text("new", tmp_path / "insole.stl")
    assert left.exists() == stays


KILLED = """
import os, signal, sys
from pathlib import Path
from insole_core.files.atomic import replacing_file, replacing_folder, scratch_folder
replacing = {"file": replacing_file, "folder": replacing_folder, "parts": scratch_folder}
with replacing[sys.argv[1]](Path(sys.argv[2])) as beside:
    assert beside.exists()
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
@pytest.mark.parametrize("kind", ["file", "folder", "parts"])
def test_the_next_start_removes_what_a_killed_run_left_wherever_it_wrote(
    tmp_path: Path, kind: str
) -> None:
    (tmp_path / "exports").mkdir()
    environment = {**os.environ, "XDG_STATE_HOME": str(tmp_path)}
    call = [sys.executable, "-c", KILLED, kind, str(tmp_path / "exports" / "result")]
    assert subprocess.run(call, check=False, env=environment).returncode == -signal.SIGKILL
    assert len(list((tmp_path / "exports").iterdir())) == 1
    settle_interrupted(tmp_path / "insole-studio")
    assert list((tmp_path / "exports").iterdir()) == []
    assert list((tmp_path / "insole-studio").iterdir()) == []


def test_a_note_names_nothing_but_what_it_was_made_for(tmp_path: Path, state_folder: Path) -> None:
    state_folder.mkdir()
    note = state_folder / f"{name_of(DEAD)}.place"
    for named in (tmp_path / "diary.txt", tmp_path / f"{name_of(DEAD, '1')}.stl"):
        named.write_text("mine")
        note.write_bytes(os.fsencode(named))
        settle_interrupted(state_folder)
        assert named.exists()
        assert not note.exists()


def test_a_note_waits_for_its_disk(tmp_path: Path, state_folder: Path) -> None:
    state_folder.mkdir()
    note = state_folder / f"{name_of(DEAD)}.place"
    note.write_bytes(os.fsencode(tmp_path / "stick" / name_of(DEAD)))
    settle_interrupted(state_folder)
    assert note.exists()
    (tmp_path / "stick" / name_of(DEAD)).mkdir(parents=True)
    settle_interrupted(state_folder)
    assert list((tmp_path / "stick").iterdir()) == list(state_folder.iterdir()) == []


@pytest.mark.parametrize("holder", [DEAD, os.getppid()], ids=["waits for a disk", "being settled"])
def test_what_a_journal_moves_is_not_swept_before(
    tmp_path: Path, state_folder: Path, holder: int
) -> None:
    left = tmp_path / f"{name_of(DEAD)}.stl"
    left.write_text("new")
    move = {"path": str(tmp_path / "absent" / "x.stl"), "old": "o", "replaces": False}
    state_folder.mkdir()
    journal_of_it = state_folder / f"{name_of(holder)}.journal"
    journal_of_it.write_text(json.dumps([{"beside": str(left), **move}]))
    write_text("", tmp_path / "other.txt")
    assert left.exists()


def test_a_folder_that_was_left_is_swept(tmp_path: Path) -> None:
    folder = tmp_path / f".insole-studio-{DEAD}-0123456789ab"
    (folder / "views").mkdir(parents=True)
    os.utime(folder, (0, 0))
    write_text("new", tmp_path / "insole.stl")
    assert not folder.exists()


def test_what_was_left_is_not_copied(tmp_path: Path) -> None:
    source, target = tmp_path / "draft", tmp_path / "session"
    (source / "views" / f".insole-studio-{DEAD}-0123456789ab").mkdir(parents=True)
    left_file(source, DEAD, 0.0)
    (source / "manifest.json").write_text("m")
    target.mkdir()
    copy_into(target, source)
    found = {path.relative_to(target).as_posix() for path in target.rglob("*")}
    assert found == {"manifest.json", "views"}


@pytest.mark.parametrize(
    "name", [".insole-studio-old-0123456789ab", f".insole-studio-{DEAD}-mine", ".notes", "a.tmp"]
)
def test_only_own_names_are_swept(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("mine")
    os.utime(tmp_path / name, (0, 0))
    write_text("new", tmp_path / "insole.stl")
    assert (tmp_path / name).exists()


@pytest.fixture
def order(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    """What was synced and renamed, in order."""
    seen: list[tuple[str, str]] = []
    fsync, replace = os.fsync, os.replace

    def note_sync(handle: int) -> None:
        seen.append(("sync", str(Path(f"/proc/self/fd/{handle}").readlink())))
        fsync(handle)

    def note_replace(source: Any, target: Any) -> None:
        seen.append(("rename", str(target)))
        replace(source, target)

    monkeypatch.setattr(os, "fsync", note_sync)
    monkeypatch.setattr(os, "replace", note_replace)
    return seen


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="files are named by /proc")
def test_content_is_synced_before_and_the_folder_after_the_rename(
    tmp_path: Path, order: list[tuple[str, str]]
) -> None:
    with replacing_file(tmp_path / "insole.stl") as beside:
        beside.write_text("new")
    assert order == [
        ("sync", str(beside)),
        ("rename", str(tmp_path / "insole.stl")),
        ("sync", str(tmp_path)),
    ]


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="files are named by /proc")
def test_everything_in_a_folder_is_synced(tmp_path: Path, order: list[tuple[str, str]]) -> None:
    with replacing_folder(tmp_path / "session") as beside:
        (beside / "views").mkdir()
        (beside / "views" / "a.png").write_text("a")
        (beside / "manifest.json").write_text("m")
    synced = [name for kind, name in order if kind == "sync"]
    parts = (beside / "manifest.json", beside / "views" / "a.png", beside / "views", beside)
    assert set(synced[:-1]) == {str(part) for part in parts}
    assert order[-2:] == [("rename", str(tmp_path / "session")), ("sync", str(tmp_path))]


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="files are named by /proc")
def test_the_journal_is_on_the_disk_before_the_first_rename(
    place: Path, state_folder: Path, order: list[tuple[str, str]]
) -> None:
    killed_transaction.write(place)
    first = next(i for i, (kind, name) in enumerate(order) if name == str(place / "insole.stl"))
    assert ("sync", str(state_folder)) in order[:first]


@pytest.fixture
def full_disk(tmp_path: Path) -> Iterator[Path]:
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(disk)]
    if (
        sys.platform != "linux"
        or subprocess.run(mount, check=False, capture_output=True).returncode
    ):
        pytest.skip("only root makes a small disk, and not in every container")
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


def test_a_disk_that_runs_full_names_the_file_that_was_asked_for(full_disk: Path) -> None:
    (full_disk / "insole.stl").write_text("old")
    with pytest.raises(OutputError, match=r"disk/sheet\.pdf cannot be written: the disk is full"):
        fill(full_disk)
    assert killed_transaction.contents(full_disk) == {"insole.stl": "old"}


def fill(disk: Path) -> None:
    with Transaction() as outputs:
        outputs.file(disk.parent / "roomy.stl").write_text("new")
        outputs.file(disk / "insole.stl").write_text("new")
        write_text("x" * 200_000, outputs.file(disk / "sheet.pdf"))


def test_a_full_disk_without_a_name_is_that_with_the_least_room(full_disk: Path) -> None:
    with pytest.raises(OutputError, match=r"disk/insole\.stl cannot be written: the disk is full"):
        fill_unnamed(full_disk)


def fill_unnamed(disk: Path) -> None:
    with Transaction() as outputs:
        outputs.file(disk.parent / "roomy.stl").write_text("new")
        outputs.file(disk / "insole.stl").write_text("x" * 200_000)


@pytest.mark.parametrize("name", ["none.json", "folder"])
def test_what_cannot_be_read_is_not_blamed_on_the_result(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match=f"{name} cannot be read"):
        copy(tmp_path / name, tmp_path / "insole.stl")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def copy(source: Path, target: Path) -> None:
    with replacing_file(target) as beside:
        beside.write_bytes(source.read_bytes())
