"""Kills and full disks: every writing command, stopped at any moment, leaves old or new, and whole.

Each command first writes its results; then it runs again in a copy of that folder, and is killed

- at a random moment, or
- just before each of its renames, links and removals, and after the last one, or
- finds the disk full after so many bytes.

After the next start of the product all results must be there, whole, and all of the earlier run or
all of the later one, and nothing else in the folder may have changed. Unfinished results may stay
beside them within the grace time of the product; once they are older, the next result that is
written there must sweep them. The faults must be 0.

``KILLS=50`` asks for fewer random kills, ``KILLS_ONLY=design,capture`` for some commands. Whatever
was not tried after nine minutes is counted as a fault too.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import random
import resource
import shutil
import signal
import tempfile
import time
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_mutations import entries_of
from benchmarks._fuzz_pool import fingerprint, preload, run_command, stay_within
from benchmarks._measure import print_table
from insole_core.errors import InsoleError
from insole_core.files.atomic import write_text
from insole_core.files.temporary import GRACE_S, is_temporary
from insole_core.formats.ply import write_ply
from insole_studio.acquisition.unfinished_captures import holding_target

FAULTS = (
    "lost", "half-written", "mixed", "others changed", "left over", "not swept", "traceback",
    "hang", "wrongly accepted", "not tried",
)  # fmt: skip
_KINDS = ("random", "step", "full")
_LONGEST_S = 60.0
_MOST_S = 540.0
_STEPS = ("replace", "rename", "link", "unlink", "rmdir")
_BYTES = (0, 1000, 20_000, 100_000)
_DONE, _REFUSED, _TRACEBACK = 0, 1, 3
_OWN = {"said.txt", "steps.txt"}


@dataclass(frozen=True)
class Command:
    """A writing command; its words name files of a folder, and `outputs` what it writes there."""

    words: str
    outputs: tuple[str, ...]


COMMANDS = {
    "simulate": Command("simulate simulated --seed 1 --ideal", ("simulated",)),
    "capture": Command("--emulate s.zip capture --out captured --frames 1", ("captured",)),
    "capture zip": Command(
        "--emulate s.zip capture --out captured.zip --frames 1", ("captured.zip",)
    ),
    "design": Command(
        "design foot.ply --side left --out i.stl --checks c.json --job-sheet s.pdf --prescription "
        "d.json --prescription-paper p.pdf --prescriber A --maker B --maker-address C",
        ("i.stl", "c.json", "s.pdf", "p.pdf"),
    ),
    "reconstruct": Command("reconstruct s.zip --out f.ply --report r.json", ("f.ply", "r.json")),
    "measure": Command(
        "measure foot.ply --side left --report m.json --csv m.csv", ("m.json", "m.csv")
    ),
    "compare": Command(
        "compare foot.ply foot.ply --report c.json --surface c.ply --picture c.png --paper c.pdf "
        "--align none",
        ("c.json", "c.ply", "c.png", "c.pdf"),
    ),
    "import-fakenect": Command("import-fakenect recording --out imported", ("imported",)),
    "calibrate session": Command(
        "calibrate session s.zip --out session --sensors sensors", ("session",)
    ),
    "calibrate session zip": Command(
        "calibrate session s.zip --out t.zip --sensors sensors", ("t.zip",)
    ),
    "calibrate distortion": Command(
        "calibrate distortion walls --serial {serial} --sensors sensors --report w.html w.json",
        ("sensors/{serial}", "w.html", "w.json"),
    ),
    "calibrate reference": Command(
        "calibrate reference --report r.html r.json", ("r.html", "r.json")
    ),
    "evaluate noise": Command(
        "evaluate noise walls/1 --report n.html n.json", ("n.html", "n.json")
    ),
}


def main() -> None:
    seed = int(os.environ.get("FUZZ_SEED", "1"))
    only = [name for name in os.environ.get("KILLS_ONLY", "").split(",") if name]
    names = [name for name in COMMANDS if not only or name in only]
    kills = -(-int(os.environ.get("KILLS", "200")) // len(names))
    started = time.monotonic()
    counts: Counter[tuple[str, str]] = Counter()
    slowest: dict[str, float] = {}
    with tempfile.TemporaryDirectory(prefix="kills-") as root:
        stay_within(Path(root))
        preload()
        with ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
            jobs = {
                name: pool.submit(_tried, name, Path(root), kills, seed, started + _MOST_S)
                for name in names
            }
            for name, job in jobs.items():
                slowest[name], tried = job.result()
                for key, number in tried.items():
                    counts[name, key] += number
                print(f"{name}: tried, {time.monotonic() - started:.0f} s", flush=True)
    head = ["command", *_KINDS, "old", "new", *FAULTS]
    rows = [[name, *(counts[name, key] for key in head[1:])] for name in names]
    total = ["all", *(sum(int(str(row[column])) for row in rows) for column in range(1, len(head)))]
    seconds = [*(f"{slowest[name]:.1f}" for name in names), ""]
    print_table([*head, "seconds"], [[*r, s] for r, s in zip([*rows, total], seconds, strict=True)])
    print(f"seed {seed}, {time.monotonic() - started:.0f} s")
    if any(counts[name, fault] for name in names for fault in FAULTS):
        raise SystemExit(1)


def _tried(
    name: str, root: Path, kills: int, seed: int, until: float
) -> tuple[float, Counter[str]]:
    """Try one command; return how long it takes undisturbed, and count kinds and outcomes."""
    counts: Counter[str] = Counter()
    stay_within(root / name)
    before, seconds, attempts = _prepared(name, root / name, kills, random.Random(f"{seed} {name}"))
    for kind, what, attempt in attempts:
        if time.monotonic() > until:
            counts["not tried"] += 1
            continue
        outcome, said = attempt()
        counts[kind] += 1
        counts[outcome] += 1
        if outcome in FAULTS:
            print(f"{outcome}: {name}: {kind}: {what}: {said}", flush=True)
    shutil.rmtree(before.parent)
    return seconds, counts


Attempt = Callable[[], tuple[str, str]]


def _prepared(
    name: str, root: Path, kills: int, rng: random.Random
) -> tuple[Path, float, list[tuple[str, str, Attempt]]]:
    """Return the folder after a first run, the time of a second one, and all ways to disturb it.

    They are in random order, so that a lack of time leaves out none of a kind.
    """
    command = _named(COMMANDS[name])
    before = root / "before"
    _fill(before)
    first = _run(command, before, _nothing)
    if first.code != _DONE:
        raise RuntimeError(f"{name} failed by itself: {first.said}")
    for output in command.outputs:
        _age(before / output)
    with _copy(before) as folder:
        seconds = _run(command, folder, _count_steps).seconds
        steps = int((folder / "steps.txt").read_text())

    def attempt(trap: Callable[[], None], after_s: float | None = None) -> Attempt:
        return lambda: _outcome(command, before, trap, after_s)

    attempts: list[tuple[str, str, Attempt]] = []
    for number in range(kills):
        moment = seconds * (rng.uniform(0.0, 1.0) if number % 2 else rng.uniform(0.85, 1.05))
        what = f"{moment:.2f} s of {seconds:.2f} s"
        attempts.append(("random", what, attempt(_nothing, moment)))
    attempts += [
        ("step", f"{step} of {steps}", attempt(_trap(step, False))) for step in range(1, steps + 1)
    ]
    attempts.append(("step", f"{steps} of {steps} done", attempt(_trap(steps, True))))
    attempts += [("full", f"{most} bytes", attempt(_full_disk(most))) for most in _BYTES]
    rng.shuffle(attempts)
    return before, seconds, attempts


def _named(command: Command) -> Command:
    serial = samples.session_values("views/left/sensor.json")["serial"]
    return Command(
        command.words.format(serial=serial),
        tuple(output.format(serial=serial) for output in command.outputs),
    )


def _fill(folder: Path) -> None:
    """Write the inputs of all commands, and a file of somebody else."""
    from benchmarks.fuzz import write_recording

    folder.mkdir()
    (folder / "keep.txt").write_text("of somebody else")
    (folder / "s.zip").write_bytes(samples.SESSION)
    (folder / "d.json").write_text(json.dumps(samples.design_values()))
    write_ply(samples.foot_mesh(), folder / "foot.ply")
    write_recording(None, None, folder)
    _write_sensors(folder / "sensors")
    _write_walls(folder / "walls")


def _write_sensors(store: Path) -> None:
    """Write the calibrations that the session was recorded with, as if they were made here."""
    entries = dict(entries_of(samples.SESSION))
    for name, content in entries.items():
        folder, _, file = name.rpartition("/")
        if file in ("sensor.json", "correction.npz"):
            serial = json.loads(entries[f"{folder}/sensor.json"])["serial"]
            (store / serial).mkdir(parents=True, exist_ok=True)
            (store / serial / file).write_bytes(content)


def _write_walls(folder: Path) -> None:
    """Write raw depth of walls at several distances, with noise."""
    import cv2

    noise = np.random.default_rng(1)
    rows, columns = np.mgrid[-1:1:480j, -1:1:640j]
    for number, raw in enumerate((560, 620, 680, 740, 800, 860)):
        wall = folder / str(number)
        wall.mkdir(parents=True)
        for frame in range(2):
            depth = raw + 9 * rows + 5 * columns + noise.normal(0, 0.6, rows.shape)
            cv2.imwrite(str(wall / f"depth_{frame:03d}.png"), np.round(depth).astype(np.uint16))


def _age(path: Path) -> None:
    """Make an earlier result differ from a later one, which may be the same to the last byte."""
    names = ("manifest.json", "sensor.json")
    found = (path / name for name in names) if path.is_dir() else [path]
    with next(file for file in found if file.exists()).open("ab") as file:
        file.write(b"\n")


@contextmanager
def _copy(before: Path) -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="kill-", dir=before.parent) as name:
        folder = Path(name) / "work"
        shutil.copytree(before, folder)
        yield folder


@dataclass(frozen=True)
class _Ended:
    code: int
    seconds: float
    said: str = ""


def _run(
    command: Command, folder: Path, trap: Callable[[], None], kill_after_s: float | None = None
) -> _Ended:
    """Run the command in a process of its own."""
    started = time.monotonic()
    killed = False
    pid = os.fork()
    if pid == 0:
        _work(command, folder, trap)
    while True:
        done, status = os.waitpid(pid, os.WNOHANG)
        passed = time.monotonic() - started
        if done:
            said = (folder / "said.txt").read_text(errors="replace").strip()
            code = os.waitstatus_to_exitcode(status)
            return _Ended(code, passed, "hang" if killed and kill_after_s is None else said)
        if not killed and passed > (_LONGEST_S if kill_after_s is None else kill_after_s):
            os.kill(pid, signal.SIGKILL)
            killed = True
        time.sleep(0.002)


def _work(command: Command, folder: Path, trap: Callable[[], None]) -> None:
    """Be the process of a command: never returns."""
    code = _TRACEBACK
    try:
        os.chdir(folder)
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        said = os.open("said.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        trap()
        try:
            run_command(command.words.split())
            code = _DONE
        except InsoleError as error:
            code = _REFUSED
            _tell(said, str(error))
        except BaseException as error:  # noqa: BLE001 - whatever it is, it is what is looked for
            _tell(said, repr(error))
        if _taken:
            Path("steps.txt").write_text(str(_taken[0]))
    finally:
        os._exit(code)


def _tell(said: int, sentence: str) -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (resource.getrlimit(resource.RLIMIT_FSIZE)[1],) * 2)
    os.write(said, sentence.encode(errors="replace"))


_taken: list[int] = []
"""How many steps this process has taken; empty where they are not counted."""


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
            if "dir_fd" in named and original.__name__ == "unlink":
                return original(*given, **named)  # one of many files of a folder on its way out
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
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

    return arm


def _outcome(
    command: Command, before: Path, trap: Callable[[], None], after_s: float | None
) -> tuple[str, str]:
    """Disturb the command, start the product anew, and judge what is there."""
    with _copy(before) as folder:
        ended = _run(command, folder, trap, after_s)
        if ended.code == _TRACEBACK:
            return "traceback", ended.said
        if ended.said == "hang":
            return "hang", ""
        _next_start(folder)
        outcome = _verdict(command, before, folder)
        if outcome == "old" and ended.code == _DONE:
            return "wrongly accepted", "it said that it was done"
        if outcome not in FAULTS and not _swept(folder):
            return "not swept", str(sorted(set(fingerprint(folder)) - set(fingerprint(before))))
        return outcome, str(sorted(set(fingerprint(folder)) ^ set(fingerprint(before)))[:9])


def _verdict(command: Command, before: Path, folder: Path) -> str:
    old, now = (_visible(fingerprint(place)) for place in (before, folder))
    states = set()
    for output in command.outputs:
        then = {path: content for path, content in old.items() if _is_of(path, output)}
        here = {path: content for path, content in now.items() if _is_of(path, output)}
        if not here:
            return "lost"
        if here == then:
            states.add("old")
        elif then.keys() == here.keys() and all(_is_whole(before / p, folder / p) for p in here):
            states.add("new")
        else:
            return "half-written"
    rest, rest_now = (
        {p: c for p, c in found.items() if not any(_is_of(p, o) for o in command.outputs)}
        for found in (old, now)
    )
    if {path: content for path, content in rest_now.items() if path in rest} != rest:
        return "others changed"
    if set(rest_now) - set(rest):
        return "left over"
    return states.pop() if len(states) == 1 else "mixed"


def _visible(found: dict[str, str]) -> dict[str, str]:
    """Leave out what is unfinished by its name, which may stay for a while, and notes of ours."""
    return {
        path: content
        for path, content in found.items()
        if path not in _OWN and not any(_is_unfinished(part) for part in Path(path).parts)
    }


def _is_unfinished(name: str) -> bool:
    """Tell whether a name is one that the product gives to what may stay for the grace time."""
    return is_temporary(name) or name.startswith(".insole-studio-capture-")


def _is_of(path: str, output: str) -> bool:
    return path == output or path.startswith(f"{output}/")


_ENDS = {".pdf": b"%%EOF", ".html": b"</html>", ".png": b"IEND"}


def _is_whole(before: Path, path: Path) -> bool:
    """Tell whether a later result is complete: readable, and about as long as the earlier one."""
    if path.is_dir():
        return True
    content = path.read_bytes()
    if path.suffix == ".json":
        return isinstance(json.loads(content), dict)
    if path.suffix in (".zip", ".npz"):
        with zipfile.ZipFile(path) as archive:
            return archive.testzip() is None
    if path.suffix in _ENDS:
        return _ENDS[path.suffix] in content[-32:]
    return len(content) > 0.95 * before.stat().st_size


def _next_start(folder: Path) -> None:
    """Start the product once more, as it would be to look at what was written."""
    ended = _run(Command("calibrate reference", ()), folder, _nothing)
    if ended.code != _DONE:
        raise RuntimeError(f"The next start failed: {ended.said}")


def _swept(folder: Path) -> bool:
    """Let the grace time of what is unfinished pass, write beside it, and look for it again."""
    passed = time.time() - GRACE_S - 60

    def unfinished() -> list[Path]:
        return [path for path in folder.rglob("*") if _is_unfinished(path.name)]

    for place in {path.parent for path in unfinished()}:
        for path in unfinished():
            os.utime(path, (passed, passed))
        with holding_target(place / "later.txt"):
            write_text("", place / "later.txt")
        (place / "later.txt").unlink()
    return not unfinished()
