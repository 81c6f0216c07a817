"""Kills and full disks: every writing command, stopped at any moment, leaves old or new, and whole.

Each command first writes its results; then it runs again in a copy of that folder, and is killed

- at a random moment, or
- just before or after one of its renames, links and removals (each once), or
- finds the disk full after so many bytes.

After the next start of the product all results must be there, whole, and all of the earlier run or
all of the later one, and nothing else in the folder may have changed. The numbers must be 0.
``KILLS=50`` asks for fewer random kills.
"""

from __future__ import annotations

import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_pool import fingerprint, run_command
from benchmarks._measure import print_table

FAULTS = ("lost", "half-written", "mixed", "others changed", "left over")
_LONGEST_S = 120.0
_STEPS = ("replace", "rename", "link", "unlink", "rmdir")
_BYTES = (0, 1000, 20_000, 100_000)


@dataclass(frozen=True)
class Command:
    """A writing command; its words name files of a folder, and `outputs` what it writes there."""

    name: str
    words: tuple[str, ...]
    outputs: tuple[str, ...]


COMMANDS = (
    Command(
        "design",
        (
            "design",
            "foot.ply",
            "--side",
            "left",
            "--out",
            "i.stl",
            "--checks",
            "c.json",
            "--job-sheet",
            "s.pdf",
            "--prescription",
            "d.json",
            "--prescription-paper",
            "p.pdf",
        ),
        ("i.stl", "c.json", "s.pdf", "p.pdf"),
    ),
    Command(
        "reconstruct",
        ("reconstruct", "s.zip", "--out", "f.ply", "--report", "r.json"),
        ("f.ply", "r.json"),
    ),
    Command(
        "measure",
        ("measure", "foot.ply", "--side", "left", "--report", "m.json", "--csv", "m.csv"),
        ("m.json", "m.csv"),
    ),
    Command(
        "compare",
        (
            "compare",
            "foot.ply",
            "foot.ply",
            "--report",
            "c.json",
            "--surface",
            "c.ply",
            "--picture",
            "c.png",
            "--align",
            "none",
        ),
        ("c.json", "c.ply", "c.png"),
    ),
    Command(
        "calibrate session", ("calibrate", "session", "s.zip", "--out", "session"), ("session",)
    ),
    Command(
        "calibrate session zip", ("calibrate", "session", "s.zip", "--out", "t.zip"), ("t.zip",)
    ),
    Command(
        "import-fakenect", ("import-fakenect", "recording", "--out", "imported"), ("imported",)
    ),
    Command(
        "capture",
        ("--emulate", "s.zip", "capture", "--out", "captured", "--frames", "1"),
        ("captured",),
    ),
    Command(
        "capture zip",
        ("--emulate", "s.zip", "capture", "--out", "captured.zip", "--frames", "1"),
        ("captured.zip",),
    ),
    Command(
        "calibrate reference",
        ("calibrate", "reference", "--report", "r.html", "r.json"),
        ("r.html", "r.json"),
    ),
    Command("simulate", ("simulate", "simulated", "--seed", "1", "--ideal"), ("simulated",)),
)


def main() -> None:
    rng = random.Random(int(os.environ.get("FUZZ_SEED", "1")))
    per_command = -(-int(os.environ.get("KILLS", "200")) // len(COMMANDS))
    counts: Counter[tuple[str, str]] = Counter()
    with tempfile.TemporaryDirectory(prefix="kills-") as name:
        for command in COMMANDS:
            before = _first_run(command, Path(name))
            for what, outcome in _attempts(command, before, per_command, rng):
                counts[command.name, what.split(":")[0]] += 1
                counts[command.name, outcome] += 1
                if outcome in FAULTS:
                    print(f"{outcome}: {command.name}: {what}", flush=True)
    head = ["command", "random", "step", "full", "old", "new", *FAULTS]
    rows = [[c.name, *(counts[c.name, key] for key in head[1:])] for c in COMMANDS]
    total = ["all", *(sum(row[column] for row in rows) for column in range(1, len(head)))]
    print_table(head, [*rows, total])
    if any(counts[c.name, fault] for c in COMMANDS for fault in FAULTS):
        raise SystemExit(1)


def _first_run(command: Command, root: Path) -> Path:
    folder = root / command.name
    folder.mkdir()
    (folder / "keep.txt").write_text("of somebody else")
    (folder / "s.zip").write_bytes(samples.SESSION)
    (folder / "d.json").write_text(json.dumps(samples.design_values()))
    from benchmarks.fuzz import _recording
    from insole_core.export.ply import write_ply

    write_ply(samples.foot_mesh(), folder / "foot.ply")
    _recording(None, None, folder)
    code, _ = _run(command, folder, _nothing)
    if code != 0:
        raise RuntimeError(f"{command.name} failed by itself: {(folder / 'said.txt').read_text()}")
    for output in command.outputs:
        _age(folder / output)
    return folder


def _age(path: Path) -> None:
    """Make an earlier result differ from a later one, which may be the same to the last byte."""
    with (path / "manifest.json" if path.is_dir() else path).open("ab") as file:
        file.write(b"\n")


def _attempts(
    command: Command, before: Path, count: int, rng: random.Random
) -> Iterator[tuple[str, str]]:
    def attempt(
        what: str, trap: Callable[[], None], after_s: float | None = None
    ) -> tuple[str, str]:
        with _copy(before) as folder:
            _run(command, folder, trap, after_s)
            return what, _verdict(command, before, folder)

    with _copy(before) as folder:
        _code, seconds = _run(command, folder, _count_steps)
        steps = int((folder / "steps.txt").read_text())
    for number in range(count):
        moment = seconds * (rng.uniform(0.0, 1.0) if number % 2 else rng.uniform(0.85, 1.05))
        yield attempt(f"random: {moment:.2f} s of {seconds:.2f} s", _nothing, moment)
    for step in range(1, steps + 1):
        for late in (False, True):
            yield attempt(f"step: {step} of {steps}{' done' if late else ''}", _trap(step, late))
    for most in _BYTES:
        yield attempt(f"full: after {most} bytes", _full_disk(most))


@contextmanager
def _copy(before: Path) -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="kill-", dir=before.parent) as name:
        folder = Path(name) / "work"
        shutil.copytree(before, folder)
        yield folder


def _run(
    command: Command, folder: Path, trap: Callable[[], None], kill_after_s: float | None = None
) -> tuple[int, float]:
    """Run the command in a process of its own; return its exit code and how long it took."""
    started = time.monotonic()
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            os.setpgid(0, 0)
            os.chdir(folder)
            os.environ["XDG_DATA_HOME"] = str(folder.parent / "data")
            said = os.open("said.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(said, 1)
            os.dup2(said, 2)
            trap()
            run_command(list(command.words))
            code = 0
        except BaseException as error:  # noqa: BLE001 - the exit code tells it
            os.write(2, repr(error).encode(errors="replace")) if trap is _nothing else None
        finally:
            if _taken:
                Path("steps.txt").write_text(str(_taken[0]))
            os._exit(code)
    while True:
        done, status = os.waitpid(pid, os.WNOHANG)
        passed = time.monotonic() - started
        if done:
            return os.waitstatus_to_exitcode(status), passed
        if passed > (_LONGEST_S if kill_after_s is None else kill_after_s):
            os.kill(pid, signal.SIGKILL)
        time.sleep(0.002)


_taken: list[int] = []


def _nothing() -> None:
    """Let the command work undisturbed."""


def _count_steps() -> None:
    _taken.append(0)
    _before_and_after(lambda: None)


def _trap(step: int, late: bool) -> Callable[[], None]:
    def arm() -> None:
        _taken.append(0)
        _before_and_after(lambda: _die(step), late)

    return arm


def _die(step: int) -> None:
    if _taken[0] == step:
        os.kill(os.getpid(), signal.SIGKILL)


def _before_and_after(act: Callable[[], None], late: bool = False) -> None:
    for name in _STEPS:
        original = getattr(os, name)

        def step(
            *given: object, original: Callable[..., object] = original, **named: object
        ) -> object:
            _taken[0] += 1
            if not late:
                act()
                return original(*given, **named)
            done = original(*given, **named)
            act()
            return done

        setattr(os, name, step)


def _full_disk(most: int) -> Callable[[], None]:
    """Return a trap that lets no file grow larger, as a disk that is full."""

    def arm() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

    return arm


def _verdict(command: Command, before: Path, folder: Path) -> str:
    _next_start(folder)
    own = {"said.txt", "steps.txt"}
    old, now = fingerprint(before), fingerprint(folder)
    states = set()
    for output in command.outputs:
        then = {path: content for path, content in old.items() if _is_of(path, output)}
        here = {path: content for path, content in now.items() if _is_of(path, output)}
        if not here:
            return "lost"
        if here == then:
            states.add("old")
        elif _is_whole(folder / output, then, here):
            states.add("new")
        else:
            return "half-written"
    outputs = command.outputs
    rest = [
        {p: c for p, c in found.items() if p not in own and not any(_is_of(p, o) for o in outputs)}
        for found in (old, now)
    ]
    if {p: c for p, c in rest[1].items() if p in rest[0]} != rest[0]:
        return "others changed"
    if set(rest[1]) - set(rest[0]):
        return "left over"
    return states.pop() if len(states) == 1 else "mixed"


def _is_of(path: str, output: str) -> bool:
    return path == output or path.startswith(f"{output}/")


def _is_whole(path: Path, then: dict[str, str], here: dict[str, str]) -> bool:
    if path.is_dir():
        return here.keys() == then.keys()
    content = path.read_bytes()
    if path.suffix == ".json":
        return isinstance(json.loads(content), dict)
    if path.suffix == ".zip":
        with zipfile.ZipFile(path) as archive:
            return archive.testzip() is None
    ends = {".pdf": b"%%EOF", ".html": b"</html>", ".png": b"IEND"}
    return ends[path.suffix] in content[-32:] if path.suffix in ends else len(content) > 0


def _next_start(folder: Path) -> None:
    """Start the product once more, as it would be to look at what was written."""
    environment = {**os.environ, "XDG_DATA_HOME": str(folder.parent / "data")}
    subprocess.run(
        [sys.executable, "-m", "insole_studio", "calibrate", "reference"],
        check=True,
        cwd=folder,
        env=environment,
        capture_output=True,
    )
