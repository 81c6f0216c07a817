"""The clinic's record: opened in the background, asked in jobs, watched for changes."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InsoleError, Unreachable
from insole_core.progress import Progress
from insole_studio.jobs import Jobs

if TYPE_CHECKING:
    from insole_core.records.author import Author
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

Result = TypeVar("Result")
OPEN, WATCH, WRITE = "record", "record-changes", "record-write"
WATCH_MS, RETRY_MS = 1000, 3000
LOCK_SETTING, USUAL_LOCK_MIN = "lock_after_minutes", 10.0


class RecordState(Enum):
    """Whether the record can be asked."""

    CLOSED = auto()
    OPENING = auto()
    LOCKED = auto()
    """Accounts are on, and nobody is signed in."""
    OPEN = auto()
    AWAY = auto()
    """It was open, and the database does not answer at the moment."""
    REFUSED = auto()
    """It cannot be opened: damaged, locked, of a newer version, or missing."""


class ClinicRecord(QObject):
    """Opens the clinic's record in a job, and runs every question to it in one.

    The database's library is imported in that job too: the window does not wait for it.

    Parameters
    ----------
    folder
        Of the record on this computer; made with the record at the first start.
    jobs
        Jobs of the record alone, so that no long computation keeps a save waiting.
    """

    state_changed = Signal()
    changed = Signal()
    """Somebody has changed the record, here or at another station."""

    def __init__(self, folder: Path, jobs: Jobs, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._folder = folder
        self.jobs = jobs
        self._records: Records | None = None
        self._unsigned: Records | None = None
        """The record before somebody has signed in, which answers nothing else."""
        self.lock_after_min = 0.0
        """Minutes without input after which somebody has to sign in again."""
        self._writes = 0
        self._mark = 0
        self._watch = QTimer(self)
        self._watch.setInterval(WATCH_MS)
        self._watch.timeout.connect(self._look_for_changes)
        self.state = RecordState.CLOSED
        self.trouble = ""
        """Why the record cannot be asked; empty while it can."""

    @property
    def is_open(self) -> bool:
        """Whether the record can be asked."""
        return self.state is RecordState.OPEN

    @property
    def author(self) -> Author | None:
        """Whose changes these are; None before the record is open."""
        return None if self._records is None else self._records.who

    @property
    def is_read_only(self) -> bool:
        """Whether nothing can be changed, as in a damaged database."""
        return self._records is not None and self._records.is_read_only

    def open(self) -> None:
        """Open the record in a job; make it where there is none."""
        if self.state in (RecordState.CLOSED, RecordState.REFUSED):
            self._set_state(RecordState.OPENING)
            folder = self._folder
            self.jobs.start(OPEN, lambda _progress: _open(folder), self._take, self._refuse)

    def ask(
        self,
        channel: str,
        question: Callable[[Records], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Ask the record in a job; a later question of the same channel replaces this one.

        Parameters
        ----------
        question
            Called in another thread.
        failed
            Called with the error, also if the record is not open.
        """
        records = self._records
        if records is None:
            failed(InsoleError("The clinic's record is not open."))
            return

        def ask(_progress: Progress) -> Result:
            return question(records)

        def told(result: Result) -> None:
            self._note_answer()
            done(result)

        def missed(error: Exception) -> None:
            self.note_failure(error)
            failed(error)

        self.jobs.start(channel, ask, told, missed)

    def write(
        self,
        change: Callable[[Records], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Change the record in a job that no other one replaces; its answer always arrives."""
        self._writes += 1

        def told(result: Result) -> None:
            done(result)
            self._look_for_changes()

        self.ask(f"{WRITE}-{self._writes}", change, told, failed)

    def start_work(
        self,
        jobs: Jobs,
        channel: str,
        work: Callable[[Records, Progress], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Start long work with the open record in other jobs, which end before it is closed."""
        records = self._records
        if records is not None:
            jobs.start(channel, lambda progress: work(records, progress), done, failed)

    def ask_now(self, question: Callable[[Records], Result]) -> Result:
        """Ask in the calling thread, as the program ends.

        Raises
        ------
        InsoleError
            When the record is not open or does not answer.
        """
        if self._records is None:
            raise InsoleError("The clinic's record is not open.")
        return question(self._records)

    def note_failure(self, error: Exception) -> None:
        """Look out for the record to come back if an error says that it does not answer."""
        if isinstance(error, Unreachable) and self.state is RecordState.OPEN:
            self.trouble = str(error)
            self._watch.setInterval(RETRY_MS)
            self._set_state(RecordState.AWAY)

    def close(self) -> None:
        """Stop watching and close the record, after the jobs have ended."""
        self._watch.stop()
        self.jobs.close()
        for records in (self._records, self._unsigned):
            if records is not None:
                records.close()
        self._records = self._unsigned = None
        self.state = RecordState.CLOSED

    def lock(self) -> None:
        """Ask for a name and a password again; what is being saved goes on."""
        if self.state in (RecordState.OPEN, RecordState.AWAY):
            self._watch.stop()
            self._set_state(RecordState.LOCKED)

    def sign_in(self, name: str, password: str, failed: Callable[[Exception], None]) -> None:
        """Sign in, in a job.

        Parameters
        ----------
        failed
            Called with the error if name or password are wrong, or the record does not answer.
        """
        records = self._records or self._unsigned
        if records is None:
            return
        asked = records

        def sign_in(_progress: Progress) -> _Opened:
            return _signed_in(asked, name, password)

        self.jobs.start(OPEN, sign_in, self._take, failed)

    def _take(self, opened: _Opened) -> None:
        self._mark, self.lock_after_min = opened.mark, opened.lock_after_min
        self.trouble = ""
        if opened.needs_sign_in:
            self._unsigned = opened.records
            self._set_state(RecordState.LOCKED)
            return
        self._records, self._unsigned = opened.records, None
        self._set_state(RecordState.OPEN)
        self._watch.start()

    def _refuse(self, error: Exception) -> None:
        if not isinstance(error, InsoleError):
            log.error("the record cannot be opened", exc_info=error)
        self.trouble = str(error)
        self._set_state(RecordState.REFUSED)

    def _look_for_changes(self) -> None:
        """Ask what has changed, here or at another station, unless the last answer is to come."""
        if self.jobs.is_running(WATCH):
            return
        mark = self._mark

        def look(records: Records) -> tuple[int, bool]:
            changes = records.changes_since(mark)
            return changes.mark, bool(changes.changes)

        self.ask(WATCH, look, self._note_changes, lambda _error: None)

    def _note_changes(self, found: tuple[int, bool]) -> None:
        self._mark, is_changed = found
        if is_changed:
            self.changed.emit()

    def _note_answer(self) -> None:
        if self.state is RecordState.AWAY:
            self.trouble = ""
            self._watch.setInterval(WATCH_MS)
            self._set_state(RecordState.OPEN)

    def _set_state(self, state: RecordState) -> None:
        self.state = state
        self.state_changed.emit()


@dataclass(frozen=True, eq=False)
class _Opened:
    """A record that was opened.

    Parameters
    ----------
    mark
        After which changes are to be noticed.
    """

    records: Records
    mark: int
    needs_sign_in: bool
    lock_after_min: float


def _open(folder: Path) -> _Opened:
    from insole_core.records.author import Author
    from insole_core.records.open import open_records
    from insole_core.records.place import RecordsPlace

    records = open_records(RecordsPlace.local(folder), Author.of_user())
    return _Opened(records, records.mark(), records.accounts.are_on, _lock_after_min(records))


def _signed_in(records: Records, name: str, password: str) -> _Opened:
    """Return the record as that of an account.

    Raises
    ------
    NotAllowed
        When name or password are wrong, or the account is locked.
    """
    from insole_core.records.records import Records

    author = records.accounts.sign_in(name, password)
    signed = Records(records.context.database, records.contents, author)
    return _Opened(signed, signed.mark(), False, _lock_after_min(signed))


def _lock_after_min(records: Records) -> float:
    """Return the minutes to the lock, never so few that nobody could work."""
    minutes = records.clinic.get(LOCK_SETTING, USUAL_LOCK_MIN)
    return max(float(minutes), 1.0) if isinstance(minutes, int | float) else USUAL_LOCK_MIN
