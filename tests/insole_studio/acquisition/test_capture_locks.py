"""Commands and windows that capture at the same time leave each other's work alone."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from pathlib import Path

import pytest

from insole_core.errors import InputError
from insole_core.files.file_lock import FileLock
from insole_core.recording.reader import read_session
from insole_studio.acquisition.capture_plan import PlanRequest
from insole_studio.acquisition.draft import is_abandoned
from insole_studio.acquisition.unfinished_captures import (
    Drafts,
    UnfinishedCapture,
    hold_draft,
    hold_unfinished,
    holding_target,
)
from tests.patience import PATIENCE_S, wait_for

pytestmark = pytest.mark.slow


class Commands:
    """Runs ``insole-studio capture`` in processes of its own, with a data folder of its own."""

    def __init__(self, folder: Path, session: Path) -> None:
        self.drafts = folder / "data" / "insole-studio" / "captures"
        self._call = [sys.executable, "-m", "insole_studio", "capture", "--emulate", str(session)]
        self._environment = {**os.environ, "XDG_DATA_HOME": str(folder / "data")}

    @contextmanager
    def started(self, out: Path, *options: str) -> Iterator[subprocess.Popen[str]]:
        process = subprocess.Popen(
            [*self._call, "--out", str(out), *options],
            env=self._environment, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        try:
            yield process
        finally:
            process.kill()
            process.communicate()

    def killed_after_a_view(self, out: Path) -> Path:
        """Return the draft of a capture that was killed after its first view."""
        with self.started(out):
            self.wait_for_view()
        (draft,) = self.folders()
        return draft

    def wait_for_view(self) -> None:
        wait_for(lambda: list(self.drafts.glob("*/manifest.json")))

    def folders(self) -> list[Path]:
        return [path for path in self.drafts.iterdir() if path.is_dir()]


@contextmanager
def stopped_with(lock: Path, process: subprocess.Popen[str]) -> Iterator[None]:
    """Stop a process once it holds a lock, so that it does not end before another has begun."""
    wait_for(lambda: lock.exists() and stops_with(lock, process))
    try:
        yield
    finally:
        process.send_signal(signal.SIGCONT)


def stops_with(lock: Path, process: subprocess.Popen[str]) -> bool:
    """Stop a process; let it go on if it has made the file of a lock, but does not hold it yet."""
    process.send_signal(signal.SIGSTOP)
    os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
    with FileLock(lock) as probe:
        if not probe.acquire():
            return True
    process.send_signal(signal.SIGCONT)
    return False


def ended(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Exit code and last line of a command."""
    _out, said = process.communicate(timeout=PATIENCE_S)
    return process.returncode, said.strip().splitlines()[-1]


@pytest.fixture
def commands(tmp_path: Path, small_session: Path) -> Commands:
    return Commands(tmp_path, small_session)


def test_a_running_capture_is_not_offered_but_a_killed_one_is(
    commands: Commands, tmp_path: Path
) -> None:
    drafts = Drafts(commands.drafts)
    with commands.started(tmp_path / "session"):
        commands.wait_for_view()
        assert drafts.left() == []
        drafts.sweep()
    (left,) = drafts.left()
    assert left.views[0].frames == left.views[0].wanted == 10


def test_of_two_that_resume_one_draft_one_succeeds(commands: Commands, tmp_path: Path) -> None:
    draft = commands.killed_after_a_view(tmp_path / "session")
    lock = draft.with_name(f"{draft.name}.lock")
    lock.unlink()  # which the killed one left
    with commands.started(tmp_path / "a", "--resume", str(draft)) as first:
        with (
            stopped_with(lock, first),
            commands.started(tmp_path / "b", "--resume", str(draft)) as second,
        ):
            assert ended(second) == (
                1,
                f"{draft} is in use by another window or command; finish or close that one first.",
            )
        assert ended(first)[0] == 0
    assert not (tmp_path / "b").exists()
    assert read_session(tmp_path / "a").manifest.views == ("left", "right", "top")
    assert list(commands.drafts.iterdir()) == []


@pytest.mark.parametrize("name", ["session", "session.zip"])
def test_of_two_captures_to_one_place_the_second_is_refused(
    name: str, commands: Commands, tmp_path: Path
) -> None:
    out = tmp_path / name
    (tmp_path / "folder").mkdir()
    same = tmp_path / "folder" / ".." / name
    lock = tmp_path / f".insole-studio-capture-{name}.lock"
    with commands.started(out, "--notes", "the first") as first:
        with (
            stopped_with(lock, first),
            commands.started(same, "--notes", "the second") as second,
        ):
            assert ended(second) == (
                1,
                f"Another capture is to be written to {same}; wait until it has ended, or choose "
                "another name.",
            )
        assert ended(first)[0] == 0
    condition = read_session(out).manifest.capture_condition
    assert condition is not None
    assert condition.notes == "the first"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["data", "folder", name]


def test_the_lock_of_a_killed_capture_is_swept_at_once(tmp_path: Path) -> None:
    left, somebodys = tmp_path / ".insole-studio-capture-a.lock", tmp_path / "capture-a.lock"
    for path in (left, somebodys):
        path.touch()
    with holding_target(tmp_path / "session"):
        pass
    assert list(tmp_path.iterdir()) == [somebodys]


def test_a_lock_that_is_held_is_never_swept(tmp_path: Path) -> None:
    with holding_target(tmp_path / "session"):
        (lock,) = tmp_path.iterdir()
        os.utime(lock, (0, 0))
        with holding_target(tmp_path / "other"):
            assert lock.exists()
        with pytest.raises(InputError), holding_target(tmp_path / "session"):
            pytest.fail("another capture is writing there")


def test_what_a_killed_capture_held_is_free(commands: Commands, tmp_path: Path) -> None:
    out = tmp_path / "session"
    draft = commands.killed_after_a_view(out)
    with commands.started(out, "--resume", str(draft)) as again:
        assert ended(again) == (0, f"100%  Done: {out}")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["data", "session"]
    assert list(commands.drafts.iterdir()) == []


def test_what_is_killed_before_its_first_view_is_swept(commands: Commands, tmp_path: Path) -> None:
    with commands.started(tmp_path / "session"):
        wait_for(lambda: list(commands.drafts.glob("*/.taking-*")))
    (mine := commands.drafts / "mine").mkdir()
    (mine / "letter.txt").write_text("not a draft")
    Drafts(commands.drafts).sweep()
    assert commands.folders() == [mine]


def test_a_draft_is_held_by_one(tmp_path: Path) -> None:
    drafts = Drafts(tmp_path)
    first, second = drafts.begin("today-left"), drafts.begin("today-left")
    assert [held.folder.name for held in (first, second)] == ["today-left", "today-left-2"]
    first.folder.mkdir()
    with pytest.raises(InputError, match="in use by another window or command"):
        hold_draft(first.folder)
    first.release()
    with pytest.raises(InputError, match="holds no unfinished capture"):
        hold_unfinished(first.folder)
    with pytest.raises(InputError, match="holds no unfinished capture"):
        hold_draft(tmp_path / "gone")
    assert drafts.begin("today-left").folder.name == "today-left-3"
    second.release()


def test_what_is_swept_is_held_meanwhile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A window that is about to go on with a draft gets it, or is told that it is gone."""
    held = Drafts(tmp_path).begin("today-left")
    (held.folder / "views").mkdir(parents=True)
    held.release()

    def remove(folder: Path, **options: bool) -> None:
        with pytest.raises(InputError, match="in use by another window"):
            hold_draft(folder)
        rmtree(folder, **options)

    rmtree = shutil.rmtree
    monkeypatch.setattr("insole_studio.acquisition.unfinished_captures.shutil.rmtree", remove)
    Drafts(tmp_path).sweep()
    assert list(tmp_path.iterdir()) == []


def test_a_draft_that_goes_while_it_is_looked_at_is_none(
    tmp_path: Path, small_session: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another window discards or sweeps it at the same moment."""
    (tmp_path / "today-left" / "views").mkdir(parents=True)
    manifest = read_session(small_session).manifest
    offered = UnfinishedCapture(tmp_path / "gone", manifest, PlanRequest(()))
    assert offered.kept_until > date.today()

    def removed_before(folder: Path) -> bool:
        shutil.rmtree(folder)
        return is_abandoned(folder)

    monkeypatch.setattr(
        "insole_studio.acquisition.unfinished_captures.is_abandoned", removed_before
    )
    assert Drafts(tmp_path).sweep() == 0


@pytest.mark.parametrize("error", [OSError(5, "Input/output error"), KeyboardInterrupt()], ids=repr)
def test_a_draft_that_cannot_be_read_is_not_held(
    tmp_path: Path, error: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_folder: Path) -> None:
        raise error

    (tmp_path / "today-left").mkdir()
    with monkeypatch.context() as patch:
        patch.setattr("insole_studio.acquisition.unfinished_captures.read_session", broken)
        with pytest.raises(type(error)):
            hold_unfinished(tmp_path / "today-left")
    hold_draft(tmp_path / "today-left").release()
