"""``insole-studio self-test``: try the whole program on this computer."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import platform
import shutil
import sys
import tempfile
from contextlib import ExitStack
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from insole_core.files.transaction import check_file
from insole_core.files.write_errors import output_errors
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_studio.cli.self_test_steps import StepResult

NAME = "self-test"
HELP = "try the whole program on a recorded session; 0 if all of it works here, else 1"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--report", action=OutputPath, metavar="FILE", help="write the lines to a file as well"
    )
    parser.add_argument(
        "--out", action=OutputPath, metavar="DIR",
        help="keep what is written in a folder; without it, it is removed",
    )  # fmt: skip
    parser.add_argument(
        "--session", type=Path, metavar="SESSION",
        help="a recorded session to play in place of a simulated one",
    )  # fmt: skip


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Try all steps, a line each, and end with 0 or 1."""
    from insole_studio.app.screen import has_screen

    if not has_screen():
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    with ExitStack() as held:
        files = [sys.stdout]
        if arguments.report is not None:
            with output_errors(arguments.report):
                check_file(arguments.report)
                arguments.report.unlink(missing_ok=True)  # another name of the file keeps it
                report = arguments.report.open("x", encoding="utf-8", newline="\n")
            files.append(held.enter_context(report))
        folder = arguments.out
        if folder is None:
            with output_errors(Path(tempfile.gettempdir())):
                temporary = tempfile.TemporaryDirectory(
                    prefix="insole-studio-self-test-", ignore_cleanup_errors=True
                )
            folder = Path(held.enter_context(temporary))
        passed = _run(folder, arguments.session, files, is_temporary=arguments.out is None)
    sys.exit(0 if passed else 1)


def _run(folder: Path, session: Path | None, files: list[TextIO], *, is_temporary: bool) -> bool:
    def write(line: str) -> None:
        for file in files:  # at once: who crashes has still told how far it came
            print(line, file=file, flush=True)

    def tell(result: StepResult) -> None:
        write(result.line)

    def give_up(result: StepResult) -> None:
        """End the process, because nothing can end the thread that hangs."""
        write(f"{result.line}\n\n{result.trace}")
        write(f"The self-test was given up at “{result.name}”.")
        for process in multiprocessing.active_children():
            process.terminate()
        if is_temporary:
            shutil.rmtree(folder, ignore_errors=True)
        os._exit(1)

    from insole_studio.cli.self_test_steps import SelfTest

    write(f"Insole Studio {version('insole-studio')} on {platform.platform()}")
    results = SelfTest(folder, session, tell, give_up).run()
    for result in results:
        if result.trace:
            write(f"\n{result.name}:\n{result.trace}")
    failed = [result.name for result in results if result.problem]
    took_s = sum(result.seconds or 0.0 for result in results)
    if failed:
        write(f"The self-test failed after {took_s:.0f} s, first at “{failed[0]}”.")
    else:
        write(f"The self-test passed: {len(results)} steps in {took_s:.0f} s.")
    return not failed
