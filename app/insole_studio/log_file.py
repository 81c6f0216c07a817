"""A log of trouble with sensors and the database, for whoever looks after the station.

It tells no patients' data: only what speaks of machines, in modules that know nothing else, is
written in full. Of all other messages it keeps the fixed words, and of errors the kind and where
they come from.
"""

from __future__ import annotations

import logging
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from logging.handlers import RotatingFileHandler
from pathlib import Path
from typing import Final

from insole_core.errors import InsoleError
from insole_core.files.atomic import make_output_folder
from insole_core.files.file_safety import PRIVATE_FILE
from insole_core.messages import Message

log = logging.getLogger(__name__)

MOST_BYTES: Final = 1_000_000
FILES: Final = 5
_OF_MACHINES: Final = (
    "insole_core.records.database_errors",
    "insole_studio.acquisition.driver_values",
    "kinect_v1",
)
_OWN: Final = ("insole_core", "insole_studio", "kinect_v1")
_PARTS: Final = 3


@contextmanager
def log_to(path: Path) -> Iterator[None]:
    """Write warnings to a file meanwhile, which is rotated; failing to costs only a warning."""
    try:
        make_output_folder(path.parent)
        path.touch(PRIVATE_FILE)
        handler = RotatingFileHandler(
            path, maxBytes=MOST_BYTES, backupCount=FILES - 1, encoding="utf-8"
        )
    except (OSError, InsoleError) as error:
        log.warning("no log is kept: %s", error)
        yield
        return
    handler.setLevel(logging.WARNING)
    handler.setFormatter(_Formatter())
    handler.addFilter(lambda record: record.name.partition(".")[0] in _OWN)
    handler.addFilter(_OnceInARow())
    root = logging.getLogger()
    root.addHandler(handler)
    try:
        yield
    finally:
        root.removeHandler(handler)
        handler.close()


class _OnceInARow(logging.Filter):
    """Drops what was just said: a database that is away is asked every few seconds."""

    _last = ""

    def filter(self, record: logging.LogRecord) -> bool:
        text = f"{record.name} {_words(record)}"
        is_new, self._last = text != self._last, text
        return is_new


class _Formatter(logging.Formatter):
    """A line for each message: when, how bad, from where, and what may be told."""

    def format(self, record: logging.LogRecord) -> str:
        moment = self.formatTime(record)
        return f"{moment} {record.levelname} {record.name}: {_words(record)}"


def _words(record: logging.LogRecord) -> str:
    """Return a message without what may be about a patient, in one line."""
    if record.name.startswith(_OF_MACHINES):
        text = record.getMessage()
    else:
        text = record.msg.template if isinstance(record.msg, Message) else str(record.msg)
    error = record.exc_info[1] if record.exc_info else None
    if error is not None:
        text = f"{text} ({_place_of(error)})"
    return "".join(letter if letter.isprintable() else " " for letter in text)


def _place_of(error: BaseException) -> str:
    """Return the kind of an error and where in the program it comes from."""
    frames = traceback.extract_tb(error.__traceback__)
    places = [f"{'/'.join(Path(f.filename).parts[-_PARTS:])}:{f.lineno}" for f in frames]
    return " < ".join((type(error).__name__, *reversed(places)))
