"""Says to other stations which visit is open here, and here who else has it open.

The record knows stations and persons; two windows of one person at one station are told apart by
locks on this computer: each window that has a visit open holds one, the first that is free.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer

from insole_core.errors import InsoleError
from insole_core.files.atomic import make_output_folder
from insole_core.files.file_lock import FileLock
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.stations import Present

log = logging.getLogger(__name__)

_MOST_WINDOWS = 8
CHANNEL, NOTICE = "records-presence", "record-presence"
REFRESH_MS = 20_000


class VisitPresence(QObject):
    """Enters a visit when it is opened, and leaves it with the case; it hinders nobody."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._visit_id = ""
        self._lock: FileLock | None = None
        self._place = _MOST_WINDOWS
        """Which lock of the visit that is."""
        self._told: tuple[str, ...] = ()
        self._timer = QTimer(self)
        self._timer.setInterval(REFRESH_MS)
        self._timer.timeout.connect(self._enter)
        services.case.opened.connect(self._follow)
        services.case.saved_changed.connect(self._follow)  # it may be kept as another visit

    def close(self) -> None:
        """Leave the visit at the end of the program."""
        self._timer.stop()
        is_last = self._let_go(self._visit_id)
        if is_last and self._visit_id and self._clinic.is_open:
            try:
                self._clinic.ask_now(lambda records: records.presence.leave(self._visit_id))
            except InsoleError as error:  # others see soon enough that this station is silent
                log.warning("the visit is not left: %s", error)

    def is_in_another_window(self, visit_id: str) -> bool:
        """Return whether another window of this computer has a visit open."""
        own = _name(visit_id, self._place) if visit_id == self._visit_id else ""
        locks = self._services.paths.locks_folder.glob(_name(visit_id))
        return any(self._is_held(path) for path in locks if path.name != own)

    def _follow(self) -> None:
        before, self._visit_id = self._visit_id, self._services.keeper.visit_id
        if before == self._visit_id:
            return
        self._told = ()
        if self._let_go(before) and before:
            self._clinic.write(
                lambda records: records.presence.leave(before), lambda _nothing: None, _ignore
            )
        if self._visit_id:
            self._timer.start()
            self._enter()
        else:
            self._timer.stop()

    def _let_go(self, visit_id: str) -> bool:
        """Free the visit for other windows here; return whether none of them has it open, too."""
        lock, self._lock, self._place = self._lock, None, _MOST_WINDOWS
        if lock is not None:
            lock.release()  # first, else two that close at once would each leave it to the other
        return not self.is_in_another_window(visit_id)

    def _hold(self, visit_id: str) -> None:
        """Take the first lock of the visit that is free, unless one is held."""
        folder = self._services.paths.locks_folder
        for place in range(self._place if self._lock is None else 0):
            lock = FileLock(folder / _name(visit_id, place))
            if self._try_lock(lock):
                self._lock, self._place = lock, place
                break

    def _is_held(self, path: Path) -> bool:
        lock = FileLock(path)
        is_free = self._try_lock(lock)
        lock.release()
        return not is_free

    def _try_lock(self, lock: FileLock) -> bool:
        """Take a lock unless another window has it; where none can be taken nobody is known to."""
        try:
            make_output_folder(self._services.paths.locks_folder)
            return lock.acquire()
        except InsoleError as error:
            log.warning("the visit is not locked: %s", error)
            return True

    def _enter(self) -> None:
        visit_id = self._visit_id
        self._hold(visit_id)
        is_elsewhere = self.is_in_another_window(visit_id)
        here = (tr("in another window of this computer"),) if is_elsewhere else ()
        if not self._clinic.is_writable:
            self._tell(visit_id, here)
            return

        def tell(others: Sequence[Present]) -> None:
            there = (f"{present.author}, {present.station}" for present in others)
            self._tell(visit_id, (*here, *there))

        self._clinic.ask(CHANNEL, lambda records: records.presence.enter(visit_id), tell, _ignore)

    def _tell(self, visit_id: str, who: tuple[str, ...]) -> None:
        if visit_id != self._visit_id or who == self._told:
            return
        self._told = who
        if who:
            sentence = tr("This visit is open elsewhere too: {who}. Nothing gets lost.")
            self._services.notices.put(NOTICE, sentence.format(who="; ".join(who)))
        else:
            self._services.notices.drop(NOTICE)


def _name(visit_id: str, place: int | str = "*") -> str:
    return f"visit-{visit_id}-{place}.lock"


def _ignore(error: Exception) -> None:
    """Let the next call try again; a fault is told."""
    if not isinstance(error, InsoleError):
        raise error
