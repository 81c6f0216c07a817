"""A search as the start page makes it: from the last key to the rows in the list."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication

from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_location import RecordLocation
from insole_studio.features.records.start_page import StartPage
from insole_studio.features.records.start_presenter import StartPresenter
from insole_studio.jobs import Jobs

_REPEATS = 9
_PATIENCE_S = 30.0


def searches_in_window(folder: Path, typed: Sequence[str]) -> Iterator[tuple[str, list[float]]]:
    """Type each text and wait for the list; yield the text and milliseconds from its last key.

    Parameters
    ----------
    folder
        Of a record of this computer.
    """
    qt = QApplication([])
    clinic = ClinicRecord(RecordLocation(folder), Jobs())
    page = StartPage()
    presenter = StartPresenter(page, clinic)
    page.show()
    clinic.open()
    _wait(qt, lambda: clinic.is_open and not clinic.jobs.is_running())
    for text in typed:
        times = []
        for _ in range(_REPEATS):
            page.search.setText(text[:-1])  # its answer is overtaken by that of the last key
            started = time.perf_counter()
            page.search.setText(text)
            _wait(qt, lambda: not clinic.jobs.is_running("records-search"))
            times.append(1000 * (time.perf_counter() - started))
        yield text, times
    del presenter
    page.close()
    clinic.close()


def _wait(qt: QApplication, is_done: Callable[[], bool]) -> None:
    until = time.monotonic() + _PATIENCE_S
    while not is_done():
        qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents, 5)
        if time.monotonic() > until:
            raise TimeoutError("the window does not answer")
