"""Nothing assumes POSIX: what only such systems have is not asked for where there is another way.

Windows itself is not here. Its lack is made up by `without_posix.py`, and the tests of files,
cases, locks and sessions run that way; ``make test-without-posix`` runs the whole pure part. That
text is read and
written in a named encoding is a rule of `make lint` (PLW1514).
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from tests.names_of_posix import MODULES, NAMES
from tests.patience import PATIENCE_S

HERE = Path(__file__).parent
ROOT = HERE.parent
PRODUCT = ("app", "insole_core", "drivers/kinect")
TESTS = (
    "insole_core/cases/test_case_file.py",
    "insole_core/files/test_atomic.py",
    "insole_core/files/test_file_lock.py",
    "insole_core/recording/test_session_layout.py",
    "insole_core/recording/test_round_trip.py",
)
GUARDED = {
    ("drivers/kinect/kinect_v1/isochronous.py", "select.poll"),  # libusb has no files there
    ("insole_core/files/file_lock.py", "import fcntl"),  # else msvcrt
    ("insole_core/files/temporary.py", "os.getuid"),  # there all files are the user's
    ("insole_core/files/file_safety.py", "os.chown"),  # there all groups are 0
    ("insole_core/records/author.py", "import pwd"),  # else the access token
    ("insole_core/records/author.py", "os.getuid"),
    ("insole_core/records/backup/backup_folder.py", "os.posix_fadvise"),  # where it exists
    ("insole_core/records/backup/backup_folder.py", "os.POSIX_FADV_DONTNEED"),
}
"""What is used only where it is there, and why."""
OF_POSIX = re.compile(
    rf"^\s*(?:import|from) (?:{'|'.join(MODULES)})\b|"
    + "|".join(rf"\b{module}\.(?:{'|'.join(names.split())})\b" for module, names in NAMES.items()),
    re.MULTILINE,
)
FOLDER = re.compile(r"""["']/(?:tmp|var|home|proc|sys|dev|etc|usr|opt)/""")


def sources() -> Iterator[tuple[str, str]]:
    for folder in PRODUCT:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield path.relative_to(ROOT).as_posix(), path.read_text("utf-8")


def test_what_posix_alone_has_is_used_only_behind_a_guard() -> None:
    used = {(name, hit.strip()) for name, text in sources() for hit in OF_POSIX.findall(text)}
    assert used == GUARDED


def test_lines_of_files_end_the_same_on_every_system() -> None:
    def writes(call: ast.Call) -> bool:
        if not isinstance(call.func, ast.Attribute):
            return False
        if call.func.attr == "write_text":
            return not isinstance(call.func.value, ast.Call) and len(call.args) < 3
        modes = [*call.args, *(word.value for word in call.keywords if word.arg == "mode")]
        is_text = any(isinstance(m, ast.Constant) and m.value in ("w", "x", "a") for m in modes)
        return call.func.attr == "open" and is_text and "encoding" in words(call)

    def words(call: ast.Call) -> set[str | None]:
        return {word.arg for word in call.keywords}

    assert [
        f"{name}:{node.lineno}"
        for name, text in sources()
        if "write_text" in text or "open(" in text  # to parse the others takes a second
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and writes(node) and "newline" not in words(node)
    ] == []


def test_no_folder_of_posix_is_named() -> None:
    named = {name for name, text in sources() if FOLDER.search(text)}
    assert named == {
        "app/insole_studio/acquisition/examined_sensors.py",  # udev, on Linux only
        "insole_core/files/temporary.py",  # what only Linux tells of a process
    }


NAME_OF_NOBODY = """
import os
import tests.without_posix
os.getlogin = lambda: os.stat("/nowhere")  # an OSError, as without a terminal
from insole_core.records.author import Author
print(Author.of_user().name)
"""


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=ROOT, capture_output=True, text=True, check=False, timeout=PATIENCE_S,
    )  # fmt: skip


def test_the_pure_part_works_without_the_modules_of_posix() -> None:
    tests = [str(HERE / test) for test in TESTS]
    plugin = ("-p", "tests.without_posix")
    done = run("-m", "pytest", *plugin, "-q", "-x", "-m", "not slow and not shared", *tests)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]


def test_a_user_without_a_name_is_somebody() -> None:
    done = run("-c", NAME_OF_NOBODY)
    assert done.stdout == "?\n", done.stderr[-2000:]
