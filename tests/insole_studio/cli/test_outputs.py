"""What the commands write: nothing else is lost for it, whatever is asked and whatever happens."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.simulate import FootShape, build_foot
from insole_studio.cli.main import run
from insole_studio.stop_signals import STOP_SIGNALS

SMALL_SESSION = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


def contents(folder: Path) -> dict[str, bytes]:
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.fixture
def documents(tmp_path: Path) -> Path:
    """A folder of somebody's own work, in which there is also a session."""
    folder = tmp_path / "docs"
    folder.mkdir()
    (folder / "thesis.txt").write_text("mine")
    shutil.unpack_archive(SMALL_SESSION, folder)
    return folder


WRITING_FOLDERS = {
    "simulate": ["simulate", "{docs}"],
    "calibrate session": ["calibrate", "session", str(SMALL_SESSION), "--out", "{docs}"],
    "capture": ["capture", "--emulate", str(SMALL_SESSION), "--out", "{docs}"],
    "import-fakenect": ["import-fakenect", "a", "b", "c", "--out", "{docs}"],
}


@pytest.mark.parametrize("command", WRITING_FOLDERS)
def test_a_folder_of_other_files_is_never_replaced(
    command: str, documents: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents(documents.parent)
    assert run([word.format(docs=documents) for word in WRITING_FOLDERS[command]]) == 1
    assert (
        "docs is not replaced: it holds thesis.txt, which is not part of an earlier result"
        in last_line(capsys)
    )
    assert contents(documents.parent) == before


@pytest.mark.parametrize("name", [".", "..", "{docs}", "../{docs.name}"])
def test_the_folder_one_works_in_is_never_replaced(
    name: str, documents: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (documents / "thesis.txt").unlink()
    monkeypatch.chdir(documents)
    before = contents(documents.parent)
    assert run(["simulate", name.format(docs=documents)]) == 1
    assert "is the folder that you work in, or holds it" in last_line(capsys)
    assert contents(documents.parent) == before


SIMULATE = "simulate {} --ideal --color-size 640x480"


@pytest.mark.slow
@pytest.mark.usefixtures("simulated_once")
def test_an_earlier_session_is_replaced(documents: Path) -> None:
    (documents / "thesis.txt").unlink()
    before = contents(documents)
    assert run(SIMULATE.format(documents).split()) == 0
    after = contents(documents)
    assert before["manifest.json"] != after["manifest.json"]
    assert [path.name for path in documents.parent.iterdir()] == ["docs"]


@pytest.fixture(scope="module")
def right_foot() -> TriangleMesh:
    return build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(1), cell_mm=6.0).mesh


@pytest.fixture
def inputs(tmp_path: Path, right_foot: TriangleMesh) -> Path:
    """A folder with a file of every kind that commands read."""
    write_ply(right_foot, tmp_path / "f.ply")
    shutil.unpack_archive(SMALL_SESSION, tmp_path / "s")
    shutil.copy(SMALL_SESSION, tmp_path / "s.zip")
    for name in ("d.json", "r.json", "shop.json", "p.json", "limits.json", "system.json"):
        (tmp_path / name).write_text("{}")
    (tmp_path / "link.ply").symlink_to(tmp_path / "f.ply")
    os.link(tmp_path / "f.ply", tmp_path / "hard.ply")
    return tmp_path


OVERWRITING = [
    "design f.ply --side right --out f.ply",
    "design f.ply --side right --out link.ply",
    "design link.ply --side right --out f.ply",
    "design f.ply --side right --out hard.ply",
    "design f.ply --side right --out s/../f.ply",
    "design f.ply --side right --out i.stl --prescription d.json --checks d.json",
    "design f.ply --side right --out i.stl --rules r.json --checks r.json",
    "design f.ply --side right --out i.stl --shop shop.json --checks shop.json",
    "design s --out i.stl --checks s/manifest.json",
    "design f.ply --side right --pair link.ply --block b --out hard.ply",
    "reconstruct s --out s/truth.ply",
    "reconstruct s --out foot.ply --report s/views/left/sensor.json",
    "reconstruct s.zip --out foot.ply --report s.marker_edits.json",
    "measure s --report s/marker_edits.json",
    "measure f.ply --other s --report s/manifest.json --side right",
    "compare f.ply s --report d.json --surface f.ply",
    "compare f.ply s --report p.json --align p.json",
    "evaluate wall s --limits limits.json --report r.html limits.json",
    "evaluate noise s --report s/views/left/sensor.json",
    "calibrate reference system.json --report system.json",
    "calibrate reference system.json --sessions s --length A B 3 --out system.json",
    "calibrate session s --out s",
    "calibrate session s.zip --out s.zip",
    "capture --emulate s.zip --out s.zip",
    "capture --emulate s --resume s --out s",
]


@pytest.mark.parametrize("line", OVERWRITING)
def test_a_result_that_is_an_input_is_refused(
    line: str, inputs: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(inputs)
    before = contents(inputs)
    assert run(line.split()) == 2
    assert "is read to make the result, which would replace it" in last_line(capsys)
    assert contents(inputs) == before


THROUGH_A_LINK = {
    "report": "measure f.ply --side right --report {link}.json",
    "table": "measure f.ply --side right --report m.json --csv {link}.csv",
    "page": "calibrate reference --report {link}.html",
    "mesh": "reconstruct s --out {link}.ply",
    "solid": "design f.ply --side right --out {link}.stl",
    "paper": "design f.ply --side right --out i.stl --job-sheet {link}.pdf",
    "order": "order create f.ply --side right --out {link}",
    "order as zip": "order create f.ply --side right --out {link}.zip",
    "session": "simulate {link} --seed 1",
    "capture": "capture --emulate s.zip --out {link}",
    "capture as zip": "capture --emulate s.zip --out {link}.zip",
    "sensor": "calibrate session s --out {link}",
    "steps": "self-test --report {link}.txt",
}


@pytest.mark.parametrize("target", ["a file", "a folder", "nothing"])
@pytest.mark.parametrize("kind", THROUGH_A_LINK)
def test_no_result_goes_through_a_link(
    kind: str,
    target: str,
    inputs: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(inputs)
    (inputs / "a file").write_text("mine")
    (inputs / "a folder").mkdir()
    words = [word.format(link="out") for word in THROUGH_A_LINK[kind].split()]
    link = next(Path(word) for word in words if word.startswith("out"))
    link.symlink_to(target)
    before = contents(inputs)
    assert run(words) == 1
    assert f"{link} is a link to {inputs / target}" in last_line(capsys)
    assert contents(inputs) == before
    assert link.is_symlink()
    assert list((inputs / "a folder").iterdir()) == []


SAME_TWICE = [
    "reconstruct s --out x.ply --report x.ply",
    "design f.ply --side right --out i.stl --job-sheet a.pdf --prescription-paper a.pdf",
    "design f.ply --side right --out i.stl --job-sheet a.pdf --prescription-paper s/../A.pdf",
    "calibrate reference --report a.html a.html",
]


@pytest.mark.parametrize("line", SAME_TWICE)
def test_one_place_for_two_results_is_refused(
    line: str, inputs: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(inputs)
    before = contents(inputs)
    assert run(line.split()) == 2
    assert "is named for two results" in last_line(capsys)
    assert contents(inputs) == before


KILLED = """
import itertools, os, signal, sys
told = os.dup(1)
os.dup2(2, 1)
from insole_studio.cli.main import run
def dying(real, left):
    def step(*arguments, **more):
        if next(left) == 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return real(*arguments, **more)
    return step
run(sys.argv[1:])  # what it loads, its children have
os.write(told, b"ready\\n")
for line in sys.stdin:
    child = os.fork()
    if child == 0:
        left = itertools.count(int(line), -1)
        for name in ("replace", "rename", "link"):
            setattr(os, name, dying(getattr(os, name), left))
        os._exit(run(sys.argv[1:]))
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    os.write(told, f"{status}\\n".encode())
"""
"""Runs a command in processes that die in the place of the renaming of a number, line by line."""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
def test_a_command_killed_between_two_renames_is_settled_by_the_next(
    inputs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(inputs.parent / "state"))
    names = ("m.json", "n.json")
    call = ["calibrate", "reference", "--report", *(str(inputs / name) for name in names)]
    outcomes = []
    with subprocess.Popen(
        [sys.executable, "-c", KILLED, *call],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    ) as process:  # fmt: skip
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        for steps in range(20):
            for name in names:
                (inputs / name).write_text("old")
            print(steps, file=process.stdin, flush=True)
            status = int(process.stdout.readline())
            assert run(["sensors", "--emulate", str(SMALL_SESSION)]) == 0  # any command settles it
            new = {name: (inputs / name).read_text() != "old" for name in names}
            assert len(set(new.values())) == 1, new
            outcomes.append(new["m.json"])
            if status == 0:
                break
            assert status == -signal.SIGKILL
    assert outcomes[0] is False
    assert outcomes[-1] is True
    assert len(outcomes) >= 5


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGHUP")
def test_nohup_is_heeded(tmp_path: Path) -> None:
    code = (
        "import os, signal\n"
        "from insole_studio.cli.stopping import StopRequest\n"
        "StopRequest().heed_signals()\n"
        "os.kill(os.getpid(), signal.SIGHUP)\n"
    )
    call = ["nohup", sys.executable, "-c", code]
    assert subprocess.run(call, check=False, capture_output=True, cwd=tmp_path).returncode == 0


def test_a_disk_that_fails_is_not_an_error_in_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("insole_core.workflows.make_foot.open_session", broken)
    assert run(["reconstruct", str(SMALL_SESSION), "--out", str(tmp_path / "f.ply")]) == 1
    said = capsys.readouterr().err
    assert "failed to read or write ([Errno 5] Input/output error)" in said.splitlines()[-1]
    assert "in broken" in said  # where it comes from, for whoever is asked
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
def test_what_is_printed_to_a_full_disk_is_told_in_one_sentence() -> None:
    """Also as the program ends, where Python writes what it still has."""
    call = [sys.executable, "-m", "insole_studio", "devices"]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(call, check=False, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith("The disk is full, so not all could be written; free some space")


def test_a_file_of_the_program_that_is_missing_leaves_a_trace(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def missing(*_arguments: object) -> None:
        (tmp_path / "weights.npz").read_bytes()

    monkeypatch.setattr("insole_studio.cli.sensors.run", missing)
    assert run(["sensors"]) == 1
    *trace, last = capsys.readouterr().err.splitlines()
    assert "in missing" in "\n".join(trace)
    assert "weights.npz cannot be used: No such file or directory" in last
    assert last.endswith("report it with the lines above.")


def broken(*_arguments: object, **_named: object) -> None:
    raise OSError(5, "Input/output error")


@pytest.mark.parametrize(
    ("argument", "name"), [("--rules", "folder"), ("--shop", "none.json"), ("--prescription", "x")]
)
def test_what_cannot_be_read_is_named(
    argument: str, name: str, inputs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (inputs / "folder").mkdir()
    call = ["design", str(inputs / "f.ply"), "--side", "right", "--out", str(inputs / "i.stl")]
    assert run([*call, argument, str(inputs / name)]) == 1
    assert f"{name} cannot be" in (line := last_line(capsys))
    assert "i.stl" not in line


@pytest.fixture
def full_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 64 KiB with 4 of them free; it is slow to fill nothing else."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(disk)]
    done = subprocess.run(mount, check=False, capture_output=True)
    if sys.platform != "linux" or done.returncode:
        pytest.skip("only root makes a small disk, and not in every container")
    (disk / "ballast").write_bytes(bytes(60 * 1024))
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


FILLING = {
    "r.ply": f"reconstruct {SMALL_SESSION} --method thesis --out disk/r.ply",
    "m.json": "measure f.ply --side right --report disk/m.json",
    "i.stl": "design f.ply --side right --out disk/i.stl",
    "sheet.pdf": "design f.ply --side right --out i.stl --job-sheet disk/sheet.pdf",
    "d.png": "compare f.ply f.ply --report c.json --picture disk/d.png",
    "c.ply": "compare f.ply f.ply --report c.json --surface disk/c.ply",
    "s.zip": SIMULATE.format("disk/s.zip"),
    "session": SIMULATE.format("disk/session"),
    "system.pdf": "calibrate reference --report disk/system.pdf",
}


@pytest.mark.slow
@pytest.mark.usefixtures("simulated_once")
@pytest.mark.parametrize("name", FILLING)
def test_a_full_disk_names_the_file_that_was_asked_for(
    name: str,
    full_disk: Path,
    inputs: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(inputs)
    before = sorted(inputs.rglob("*"))
    assert run(FILLING[name].split()) == 1
    assert last_line(capsys) == (
        f"disk/{name} cannot be written: the disk is full; free some space and try again."
    )
    assert sorted(inputs.rglob("*")) == before


@pytest.mark.slow
def test_the_window_ends_alike_on_every_signal() -> None:
    code = (
        "import os, signal, sys\n"
        "from PySide6.QtCore import QTimer\n"
        "from insole_studio.app.bootstrap import _quit_on_signals, qt_application\n"
        "qt = qt_application()\n"
        "for number in map(int, sys.argv[1:]):\n"
        "    signal.signal(number, signal.SIG_DFL)\n"
        "    _quit_on_signals(qt)\n"
        "    QTimer.singleShot(0, lambda: os.kill(os.getpid(), number))\n"
        "    print(number, qt.exec(), flush=True)\n"
    )
    call = [sys.executable, "-c", code, *(str(int(number)) for number in STOP_SIGNALS)]
    done = subprocess.run(call, check=False, capture_output=True, text=True)
    ends = [f"{int(number)} {128 + number}" for number in STOP_SIGNALS]
    assert done.stdout.splitlines() == ends, done.stderr
    assert done.returncode == 0, done.stderr
