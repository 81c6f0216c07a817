"""Says to other stations which visit is open here, and here who else has it open."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer

from insole_core.errors import InsoleError
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.stations import Present

log = logging.getLogger(__name__)

CHANNEL, NOTICE = "records-presence", "record-presence"
REFRESH_MS = 20_000


class VisitPresence(QObject):
    """Enters a visit when it is opened, and leaves it with the case; it hinders nobody."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._visit_id = ""
        self._told: tuple[str, ...] = ()
        self._timer = QTimer(self)
        self._timer.setInterval(REFRESH_MS)
        self._timer.timeout.connect(self._enter)
        services.case.opened.connect(self._follow)
        services.case.saved_changed.connect(self._follow)  # it may be kept as another visit

    def close(self) -> None:
        """Leave the visit at the end of the program."""
        self._timer.stop()
        if self._visit_id and self._clinic.is_open:
            try:
                self._clinic.ask_now(lambda records: records.presence.leave(self._visit_id))
            except InsoleError as error:  # others see soon enough that this station is silent
                log.warning("the visit is not left: %s", error)

    def _follow(self) -> None:
        before, self._visit_id = self._visit_id, self._services.keeper.visit_id
        if before == self._visit_id:
            return
        self._told = ()
        if before:
            self._clinic.write(
                lambda records: records.presence.leave(before), lambda _nothing: None, _ignore
            )
        if self._visit_id:
            self._timer.start()
            self._enter()
        else:
            self._timer.stop()

    def _enter(self) -> None:
        visit_id = self._visit_id
        if not self._clinic.is_writable:
            return
        self._clinic.ask(
            CHANNEL,
            lambda records: records.presence.enter(visit_id),
            lambda others: self._tell(visit_id, others),
            _ignore,
        )

    def _tell(self, visit_id: str, others: Sequence[Present]) -> None:
        who = tuple(f"{present.author}, {present.station}" for present in others)
        if visit_id != self._visit_id or who == self._told:
            return
        self._told = who
        if who:
            sentence = tr("This visit is open elsewhere too: {who}. Nothing gets lost.")
            self._services.notices.put(NOTICE, sentence.format(who="; ".join(who)))
        else:
            self._services.notices.drop(NOTICE)


def _ignore(error: Exception) -> None:
    """Let the next call try again; a fault is told."""
    if not isinstance(error, InsoleError):
        raise error
