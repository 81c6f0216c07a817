"""Reports of errors in the program itself, offered at the next start.

A report tells where in the program it happened, and no more: neither the message of the error nor
the values of variables, for they may name a patient or a file. Unsaved work is recovered apart
from it (`features/case_files/recovery.py`).
"""

from __future__ import annotations

import faulthandler
import logging
import os
import platform
import re
import time
import traceback
from datetime import UTC, datetime
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import TextIO

from PySide6.QtWidgets import QWidget

from insole_core.errors import InsoleError
from insole_core.files.atomic import make_output_folder, write_text
from insole_studio.app.text_dialog import TextDialog
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

log = logging.getLogger(__name__)

NOTICE = "crash"
MOST_REPORTS = 20
_FAULT, _REPORT = "fault-*.log", "error-*.txt"
_KEPT_EMPTY_S = 30 * 86400.0
"""How long the empty log of a process stays that was killed, or is still running."""
_FILE = re.compile(r'File "([^"]+)"')
_PARTS = 3


class CrashReports:
    """Writes the reports of one process, and finds those of earlier ones.

    Parameters
    ----------
    folder
        Where they are kept; made when it is needed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._fault: TextIO | None = None
        self._written = 0

    def begin(self) -> None:
        """Let a crash of a library, which Python cannot catch, leave the stacks of all threads."""
        if faulthandler.is_enabled():  # whoever has asked for them elsewhere gets them there
            return
        try:
            make_output_folder(self._folder)
            self._fault = (self._folder / f"fault-{os.getpid()}.log").open(
                "w", encoding="utf-8", newline="\n"
            )
        except (OSError, InsoleError) as error:
            log.warning("a crash will leave no report: %s", error)
            return
        faulthandler.enable(self._fault)

    def end(self) -> None:
        """Stop; a process that ends as it should leaves no log."""
        if self._fault is None:
            return
        faulthandler.disable()
        fault, self._fault = self._fault, None
        fault.close()
        Path(fault.name).unlink(missing_ok=True)

    def write(self, error: BaseException) -> None:
        """Write a report of an error that nobody has handled; failing to costs only a warning."""
        if self._written == MOST_REPORTS:  # one that comes again and again
            return
        self._written += 1
        made = datetime.now(UTC).strftime("%Y%m%dT%H%M%S")
        name = f"error-{made}-{os.getpid()}-{self._written}.txt"
        try:
            make_output_folder(self._folder)
            write_text(report_of(error), self._folder / name)
        except InsoleError as failed:
            log.warning("no report of an error: %s", failed)

    def left(self) -> list[Path]:
        """Return the reports of earlier processes, the newest first."""
        own = None if self._fault is None else Path(self._fault.name)
        found: list[tuple[float, Path]] = []
        for path in (*self._folder.glob(_REPORT), *self._folder.glob(_FAULT)):
            try:
                status = path.stat()
            except OSError:  # another window has just removed it
                continue
            if status.st_size and path != own:
                found.append((status.st_mtime, path))
            elif path != own and time.time() - status.st_mtime > _KEPT_EMPTY_S:
                path.unlink(missing_ok=True)
        return [path for _time, path in sorted(found, reverse=True)]

    def offer(self, services: AppServices) -> None:
        """Tell that there are reports, to look at or to remove."""
        left = self.left()
        if not left:
            return
        services.notices.put(
            NOTICE,
            tr(
                "Insole Studio met an error of its own last time. A report of it is kept; it holds "
                "no patients' data."
            ),
            (tr("Look at the report"), lambda: self._show(services)),
            (tr("Remove it"), lambda: _remove(left)),
            stays=True,
        )

    def _show(self, services: AppServices) -> None:
        left = self.left()
        text = "\n\n".join(filter(None, map(_readable, left)))
        if not text:
            services.messages.say(tr("The report was removed by another window."))
            return
        dialog = ReportDialog(text, services, services.window)
        dialog.removed.clicked.connect(lambda: _remove(left))
        dialog.show()


class ReportDialog(TextDialog):
    """The reports, which can be copied, saved, or removed."""

    def __init__(self, text: str, services: AppServices, parent: QWidget) -> None:
        super().__init__(
            tr("Report of an error"), "insole-studio-error.txt", services.messages, parent
        )
        self.removed = self.add_button(tr("Remove it"), self.close)
        self.buttons.insertWidget(2, self.removed)
        self.show_html(f"<pre>{escape(text)}</pre>", text)


def report_of(error: BaseException) -> str:
    """Return version, kind of the error, and where in the program it comes from."""
    lines = [_program()]
    cause: BaseException | None = error
    while cause is not None:
        lines.append(f"{type(cause).__module__}.{type(cause).__name__}")
        lines += [
            f'  File "{_short(frame.filename)}", line {frame.lineno}, in {frame.name}'
            for frame in traceback.extract_tb(cause.__traceback__)
        ]
        cause = cause.__cause__
    return "\n".join(lines) + "\n"


def _program() -> str:
    return f"Insole Studio {version('insole-studio')}, {platform.platform()}"


def _readable(path: Path) -> str:
    """Return a report with paths that name no user; nothing of one that is gone."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
        made = datetime.fromtimestamp(path.stat().st_mtime, UTC).isoformat(" ", "minutes")
    except FileNotFoundError:  # another window has just removed it
        return ""
    return f"{made}\n" + _FILE.sub(lambda found: f'File "{_short(found[1])}"', text)


def _short(name: str) -> str:
    """Return the last parts of the path of a source file."""
    return "/".join(Path(name).parts[-_PARTS:])


def _remove(paths: list[Path]) -> None:
    for path in paths:
        path.unlink(missing_ok=True)
