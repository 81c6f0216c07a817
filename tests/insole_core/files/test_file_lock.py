"""A lock is held by one, and ends with its process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from insole_core.errors import OutputError
from insole_core.files.file_lock import FileLock
from tests.patience import PATIENCE_S

HOLD = """
import sys
from pathlib import Path
from insole_core.files.file_lock import FileLock
print(FileLock(Path(sys.argv[1])).acquire(), flush=True)
sys.stdin.readline()
"""


def test_one_holds_it_until_it_is_released(tmp_path: Path) -> None:
    path = tmp_path / "draft.lock"
    one, other = FileLock(path), FileLock(path)
    assert one.acquire()
    assert one.acquire()
    assert not other.acquire()
    one.release()
    assert list(tmp_path.iterdir()) == []
    with other:
        assert other.acquire()
        assert not one.acquire()
    assert not other.held


def test_a_file_that_was_left_is_no_lock(tmp_path: Path) -> None:
    (tmp_path / "draft.lock").write_bytes(b"")
    with FileLock(tmp_path / "draft.lock") as lock:
        assert lock.acquire()


def test_a_lock_ends_when_its_process_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "draft.lock"
    with subprocess.Popen(
        [sys.executable, "-c", HOLD, str(path)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        assert process.stdout.readline() == "True\n"
        lock = FileLock(path)
        assert not lock.acquire()
        process.kill()
        process.wait(PATIENCE_S)
        assert lock.acquire()
        lock.release()


def test_a_file_that_its_holder_removed_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The holder removes the file between our opening it and locking it."""
    path = tmp_path / "draft.lock"
    first, second, third = FileLock(path), FileLock(path), FileLock(path)
    assert first.acquire()
    monkeypatch.setattr(
        "insole_core.files.file_lock._try_lock", lambda _handle: (first.release(), undo())
    )
    undo = monkeypatch.undo
    assert second.acquire()
    assert path.exists()
    assert not third.acquire()
    second.release()


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="its folder does not exist"):
        FileLock(tmp_path / "nowhere" / "draft.lock").acquire()


def test_a_lock_is_free_again_also_where_its_file_cannot_be_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Path, missing_ok: bool = False) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    lock, other = (FileLock(tmp_path / "draft.lock") for _ in range(2))
    assert lock.acquire()
    monkeypatch.setattr(Path, "unlink", refuse)
    lock.release()
    assert other.acquire()
    monkeypatch.undo()
    other.release()
