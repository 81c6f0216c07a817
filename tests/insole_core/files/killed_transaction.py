"""Kill a transaction at every moment: run as a program, one process for each moment.

Prints a line for each: the exit status of the killed process, and what was in the places before and
after the next start.
"""

from __future__ import annotations

import errno
import itertools
import json
import os
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from insole_core.files.journal import settle_interrupted
from insole_core.files.temporary import state_folder_of_user
from insole_core.files.transaction import Transaction, nothing_foreign

STEPS = ("replace", "rename", "link", "unlink", "rmdir", "fsync")


def prepare(place: Path) -> None:
    """Make what the transaction replaces: all but the new file."""
    shutil.rmtree(place, ignore_errors=True)
    (place / "session").mkdir(parents=True)
    (place / "other disk").mkdir()
    (place / "session" / "manifest.json").write_text("old")
    (place / "insole.stl").write_text("old")
    (place / "other disk" / "sheet.pdf").write_text("old")


def write(place: Path) -> None:
    """Replace two files and a folder, and add a file, together."""
    with Transaction() as outputs:
        outputs.file(place / "insole.stl").write_text("new")
        (outputs.folder(place / "session", nothing_foreign) / "view.png").write_text("new")
        outputs.file(place / "other disk" / "sheet.pdf").write_text("new")
        outputs.file(place / "checks.json").write_text("new")


def contents(place: Path) -> dict[str, str]:
    """Return the texts of all files by their paths, hidden ones included."""
    files = sorted(path for path in place.rglob("*") if path.is_file())
    return {str(path.relative_to(place)): path.read_text() for path in files}


def die_after(steps: int) -> None:
    """Kill this process in the place of the step after so many."""
    left = itertools.count(steps, -1)

    def dying(real: Callable[..., Any]) -> Callable[..., Any]:
        def step(*arguments: Any, **more: Any) -> Any:
            if next(left) == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return real(*arguments, **more)

        return step

    for name in STEPS:
        setattr(os, name, dying(getattr(os, name)))


def killed_after(steps: int, work: Callable[[], None]) -> int:
    """Do some work in a process that dies after so many steps; return its status."""
    child = os.fork()
    if child == 0:
        die_after(steps)
        work()
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def refuse_links(*_arguments: object) -> None:
    """Answer like a disk whose files have one name each."""
    raise OSError(errno.EPERM, os.strerror(errno.EPERM))


def main(place: Path) -> None:
    """Kill the transaction at every step, then the start that settles it, then start again."""
    for steps in itertools.count():
        prepare(place)
        status = killed_after(steps, lambda: write(place))
        left = contents(place)
        killed_after(steps % 7, lambda: settle_interrupted(state_folder_of_user()))
        settle_interrupted(state_folder_of_user())
        print(json.dumps([status, left, contents(place)]))
        if status == 0:
            return


if __name__ == "__main__":
    if "--without-links" in sys.argv:
        os.link = refuse_links
    main(Path(sys.argv[1]))
