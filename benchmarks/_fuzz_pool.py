"""Run trials of bad input in forked processes, each bounded in time and memory, and judge them."""

from __future__ import annotations

import contextlib
import hashlib
import importlib
import io
import json
import math
import os
import pkgutil
import re
import resource
import select
import shutil
import signal
import stat
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from insole_core.errors import InsoleError
from insole_core.visible_text import is_control

Expected = Literal["refused", "accepted", "any"]

MOST_SECONDS = 10.0
"""Of processor time; waiting for other processes of a busy machine does not count."""
MOST_SECONDS_WITH_PROGRESS = 60.0
MOST_BYTES = 2 * 2**30
_GUARD_BYTES = 5 * 2**30
"""Address space above that of the parent: the machine is protected, and the excess measured."""


@dataclass(frozen=True)
class Trial:
    """One bad input and what reads it.

    Parameters
    ----------
    make
        Writes the input into an empty folder.
    read
        Reads it; raises `InsoleError` to refuse it. What it writes goes to a second folder.
    most_seconds
        Longer where the reading reports its progress, and can be stopped.
    expected
        Of the reading; "any" where only a crash would be wrong.
    """

    family: str
    name: str
    make: Callable[[Path], None]
    read: Callable[[Path, Path], None]
    expected: Expected = "any"
    most_seconds: float = MOST_SECONDS


@dataclass(frozen=True)
class Outcome:
    """How a trial ended; `faults` is empty where it ended well."""

    trial: Trial
    verdict: str
    sentence: str
    seconds: float
    peak_bytes: int
    faults: tuple[str, ...]


@dataclass
class _Running:
    trial: Trial
    folder: Path
    pipe: int
    started: float
    said: bytearray = field(default_factory=bytearray)


def preload() -> None:
    """Import now what every process would import for itself."""
    import insole_core
    import insole_studio.acquisition
    import insole_studio.cli

    for package in (insole_core, insole_studio.acquisition, insole_studio.cli):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if ".migrations." not in module.name:  # which only Alembic runs
                importlib.import_module(module.name)
    for name in ("matplotlib.pyplot", "trimesh.exchange.load", "scipy.spatial", "reportlab.pdfgen"):
        importlib.import_module(name)


def stay_within(root: Path) -> None:
    """Let the product keep its own files and temporary ones below a folder, not in the user's."""
    for variable in (
        "HOME",
        "TMPDIR",
        *(f"XDG_{kind}_HOME" for kind in ("CONFIG", "DATA", "STATE")),
    ):
        folder = root / "user" / variable
        folder.mkdir(parents=True)
        os.environ[variable] = str(folder)
    tempfile.tempdir = os.environ["TMPDIR"]


def run_trials(
    trials: Iterable[Trial], at_once: int = 2, until: float = math.inf
) -> Iterator[Outcome]:
    """Run trials in processes forked from this one, which has imported all they need.

    Parameters
    ----------
    until
        Time of the monotonic clock after which no other trial is begun.
    """
    waiting, running = iter(trials), dict[int, _Running]()
    base = _peak_bytes(resource.RUSAGE_SELF)
    while True:
        while len(running) < at_once and (trial := next(waiting, None)) is not None:
            if time.monotonic() > until:
                yield Outcome(trial, "none", "", 0, 0, ("not tried",))
                continue
            pid, one = _fork(trial)
            running[pid] = one
        if not running:
            return
        _listen(running.values())
        for pid in list(running):
            one = running[pid]
            done, status, usage = os.wait4(pid, os.WNOHANG)
            seconds = time.monotonic() - one.started
            if not done and seconds > 6 * one.trial.most_seconds:
                os.kill(pid, signal.SIGKILL)
            if done:
                del running[pid]
                yield _judge(one, status, usage, base)


def _fork(trial: Trial) -> tuple[int, _Running]:
    folder = Path(tempfile.mkdtemp(prefix="fuzz-"))
    ends = os.pipe()
    sys.stdout.flush()
    sys.stderr.flush()
    pid = os.fork()
    if pid == 0:
        os.close(ends[0])
        code = 3
        try:
            _child(trial, folder, ends[1])
            code = 0
        finally:
            os._exit(code)
    os.close(ends[1])
    os.set_blocking(ends[0], False)
    return pid, _Running(trial, folder, ends[0], time.monotonic())


def _child(trial: Trial, folder: Path, pipe: int) -> None:
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    os.dup2(silence, 2)
    given, made = folder / "in", folder / "out"
    given.mkdir()
    made.mkdir()
    trial.make(given)
    before = fingerprint(given)
    space = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (space + _GUARD_BYTES,) * 2)
    # Time spent on making the input counts too, so that it is kept small.
    resource.setrlimit(
        resource.RLIMIT_CPU, (int(trial.most_seconds) + 1, int(trial.most_seconds) + 2)
    )
    verdict, sentence = "accepted", ""
    try:
        trial.read(given, made)
    except InsoleError as error:
        verdict, sentence = "refused", str(error)
    except BaseException:  # noqa: BLE001 - whatever it is, it is what the trial is about
        verdict, sentence = "traceback", traceback.format_exc(limit=-4)
    answer = [verdict, sentence[:2000], before == fingerprint(given)]
    os.write(pipe, json.dumps(answer).encode())


def _listen(running: Iterable[_Running]) -> None:
    by_pipe = {one.pipe: one for one in running}
    for pipe in select.select(list(by_pipe), [], [], 0.02)[0]:
        by_pipe[pipe].said += os.read(pipe, 65536)
    time.sleep(0.002)


def _judge(one: _Running, status: int, usage: resource.struct_rusage, base_bytes: int) -> Outcome:
    with contextlib.suppress(BlockingIOError):
        while more := os.read(one.pipe, 65536):
            one.said += more
    os.close(one.pipe)
    shutil.rmtree(one.folder, ignore_errors=True)
    seconds = usage.ru_utime + usage.ru_stime
    peak = usage.ru_maxrss * 1024 - base_bytes
    faults = []
    if one.said:
        verdict, sentence, kept = json.loads(one.said)
    else:
        killed_by = os.waitstatus_to_exitcode(status)
        verdict, sentence, kept = "died", f"exit code {killed_by}", True
        faults.append("hang" if killed_by in (-signal.SIGXCPU, -signal.SIGKILL) else "traceback")
    if verdict == "traceback":
        faults.append("memory" if "MemoryError" in sentence else "traceback")
    if peak > MOST_BYTES and "memory" not in faults:
        faults.append("memory")
    if seconds > one.trial.most_seconds and "hang" not in faults:
        faults.append("hang")
    if not kept:
        faults.append("input changed")
    wanted = one.trial.expected
    if wanted == "refused" and verdict == "accepted":
        faults.append("wrongly accepted")
    if wanted == "accepted" and verdict == "refused":
        faults.append("wrongly refused")
    return Outcome(one.trial, verdict, sentence, seconds, peak, tuple(faults))


def _peak_bytes(who: int) -> int:
    return resource.getrusage(who).ru_maxrss * 1024


def fingerprint(folder: Path) -> dict[str, str]:
    """Return the content of every file below a folder, by its path."""
    found = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        is_file = stat.S_ISREG(mode)
        found[str(path.relative_to(folder))] = (
            hashlib.sha256(path.read_bytes()).hexdigest() if is_file else str(stat.S_IFMT(mode))
        )
    return found


def run_command(arguments: list[str]) -> None:
    """Run a command of the product in this process; raise what it says on failure.

    Raises
    ------
    InsoleError
        With its last line.
    RuntimeError
        With all it said, where that is no sentence with a remedy.
    """
    from insole_studio.cli.main import run

    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        try:
            code = run(arguments)
        except SystemExit as error:
            code = int(error.code or 0)
    lines = said.getvalue().strip().splitlines() or [""]
    is_steered = any(is_control(letter) and letter not in "\n\t" for letter in said.getvalue())
    if is_steered or re.search(r"[a-z]Warning: ", said.getvalue()):
        raise RuntimeError(f"a warning, or a control character: {said.getvalue()[-600:]!a}")
    if code == 0:
        return
    if "Traceback" in said.getvalue() or code not in (1, 2):
        raise RuntimeError("\n".join(lines[-12:]))
    if not is_helpful(lines[-1]):
        raise RuntimeError(f"no sentence with a remedy: {lines[-1]}")
    raise InsoleError("{sentence}", sentence=lines[-1])


def is_helpful(sentence: str) -> bool:
    """Return whether a sentence has an end, and is long enough to name a remedy."""
    ends = sentence.rstrip().endswith((".", "]", "?"))
    return bool((ends or " --" in sentence) and len(sentence) > 20)
