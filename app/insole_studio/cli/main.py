"""The command line: without arguments the window, and commands that need no display.

Progress goes to stderr; on failure the last line there says what is wrong, where, and what to do.
Exit codes: 0 success, 2 usage error, 128 + n stopped by signal n, 1 any other error.
"""

from __future__ import annotations

import argparse
import logging
import os
import sys
import traceback
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TextIO

from insole_core.errors import InsoleError, UsageError
from insole_core.files.journal import settle_interrupted
from insole_core.files.temporary import state_folder_of_user
from insole_core.files.write_errors import FULL
from insole_core.progress import Progress
from insole_core.visible_text import VisibleRecord, visible, visible_line
from insole_studio.cli import (
    calibrate,
    capture,
    compare,
    design,
    devices,
    doctor,
    evaluate,
    import_fakenect,
    inspect_scan,
    measure,
    order,
    pressure,
    pressure_change,
    reconstruct,
    self_test,
    sensors,
    simulate,
    window,
)
from insole_studio.cli.argument_parser import Command, Parser, PrintVersion
from insole_studio.cli.path_arguments import check_paths, check_texts
from insole_studio.cli.records import command as records
from insole_studio.cli.stopping import Stopped, StopRequest
from insole_studio.missing_library import missing_library_error
from insole_studio.native_heap import share_one_heap

COMMANDS: tuple[Command, ...] = (
    window,
    sensors,
    capture,
    import_fakenect,
    calibrate,
    evaluate,
    reconstruct,
    inspect_scan,
    design,
    order,
    devices,
    measure,
    pressure,
    pressure_change,
    compare,
    records,
    simulate,
    self_test,
    doctor,
)

_SIGPIPE = 13  # Windows has no signal of this name


class _VisibleStream:
    """A text stream that writes `visible` text; all else is that of the stream itself.

    What its encoding lacks, as that of a pipe on Windows does, is written as plain text: a command
    that has done its work must not fail by a sign.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write a text; return its length."""
        shown, encoding = visible(text), self._stream.encoding or "utf-8"
        try:
            shown.encode(encoding)
        except UnicodeEncodeError:
            plain = shown.replace("−", "-").encode(encoding, "backslashreplace")
            shown = plain.decode(encoding)
        self._stream.write(shown)
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        """Write each of some texts."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def _visible_streams() -> Iterator[None]:
    """Let all that is printed meanwhile, tracebacks and warnings included, be visible text."""
    streams: tuple[Any, Any] = sys.stdout, sys.stderr
    # A program without a console has none.
    sys.stdout, sys.stderr = (stream and _VisibleStream(stream) for stream in streams)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = streams


def run(arguments: list[str]) -> int:
    """Run one command and return its exit code."""
    stop = StopRequest()
    stop.heed_signals()
    share_one_heap()
    logging.setLogRecordFactory(VisibleRecord)
    with _visible_streams():
        return _exit_code(arguments, stop)


def _exit_code(arguments: list[str], stop: StopRequest) -> int:
    try:
        _run(arguments, stop)
    except InsoleError as error:
        print(visible_line(str(error)), file=sys.stderr)
        return 2 if isinstance(error, UsageError) else 1
    except Stopped as stopped:
        print(f"Stopped on request; {stopped.outcome}", file=sys.stderr)
        return stopped.exit_code
    except BrokenPipeError:
        return _left_by_reader()
    except OSError as error:
        return _disk_is_full() if error.errno in FULL else _report(error, _reason(error))
    except Exception as error:  # noqa: BLE001 - the last line must be a sentence, whatever happened
        return _report_unexpected(error)
    return 0


def _run(arguments: list[str], stop: StopRequest) -> None:
    words = _with_command(arguments)
    parsed = command_parser(words).parse_args(words)
    check_texts(parsed)
    check_paths(parsed)
    settle_interrupted(state_folder_of_user())

    def print_progress(fraction: float, text: str) -> None:
        if fraction < 1:  # the last step tells what has been written
            stop.check()
        print(f"{fraction:4.0%}  {visible_line(text)}", file=sys.stderr, flush=True)

    # NumPy takes long to import, and wrong arguments are reported before.
    from insole_studio.lean_numpy import unlist_parts_on_demand

    unlist_parts_on_demand()
    parsed.command.run(parsed, Progress(print_progress))
    sys.stdout.flush()


def _with_command(arguments: list[str]) -> list[str]:
    """Let a file that stands in the place of a command be opened, as a desktop hands it over."""
    first = arguments[0] if arguments else "-"
    is_command = first.startswith("-") or any(first == command.NAME for command in COMMANDS)
    is_file = bool(Path(first).suffix) or os.path.lexists(first)
    return [window.NAME, *arguments] if is_file and not is_command else arguments


def _left_by_reader() -> int:
    """End as other programs do when the reader of a pipe, such as head, has read enough."""
    _drop_output()
    return 128 + _SIGPIPE


def _disk_is_full() -> int:
    """Tell it, as what is printed may go to a disk as well; nobody has to report that."""
    try:
        sys.stdout.flush()
    except OSError:
        _drop_output()
    print("The disk is full, so not all could be written; free some space and try again.",
          file=sys.stderr)  # fmt: skip
    return 1


def _drop_output() -> None:
    """Let what is not printed yet go nowhere, for the flush at the exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _reason(error: OSError) -> str:
    """Say what may be wrong with a file, a disk or the network: no reader or writer expected it."""
    if error.filename is None:
        return (
            f"The computer failed to read or write ({error}); check the disk and the network, try "
            "again, and if that does not help, report it"
        )
    return (
        f"{error.filename} cannot be used: {error.strerror}; check that it is there, and that you "
        "may read and write there, and if that does not help, report it"
    )


def _report_unexpected(error: Exception) -> int:
    lacking = missing_library_error(error) if isinstance(error, ImportError) else None
    if lacking is not None:
        print(lacking, file=sys.stderr)
        return 1
    return _report(error, f"An error in the program itself ({error}); please report it")


def _report(error: Exception, request: str) -> int:
    """Print where an unexpected error comes from, and ask the user to report it."""
    traceback.print_exception(error)
    print(visible_line(f"{request} with the lines above."), file=sys.stderr)
    return 1


def command_parser(words: Collection[str] | None = None) -> argparse.ArgumentParser:
    """Return the parser of all commands, which the manual describes too.

    Parameters
    ----------
    words
        What it is to parse: a command that is not among them needs no arguments, which are many.
    """
    parser = Parser(
        prog="insole-studio",
        description="Custom insoles from scans of the foot. Without a command the window opens.",
    )
    parser.add_argument("--version", action=PrintVersion)
    parser.add_argument(
        "--emulate", type=Path, metavar="SESSION",
        help="play a recorded session as live sensors, in the window and in sensors and capture",
    )  # fmt: skip
    parser.set_defaults(command=window, path=None)
    commands = parser.add_subparsers(metavar="COMMAND")
    for command in COMMANDS:
        sub = commands.add_parser(command.NAME, help=command.HELP, description=command.HELP)
        sub.set_defaults(command=command)
        if words is None or command.NAME in words:
            command.add_arguments(sub)
    return parser
