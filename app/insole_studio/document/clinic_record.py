"""The clinic's record: opened in the background, asked in jobs, watched for changes."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InsoleError, Unreachable
from insole_core.progress import Progress
from insole_core.records.author import Author
from insole_studio.document.record_location import RecordLocation
from insole_studio.jobs import Jobs
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.messages import Message
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

Result = TypeVar("Result")
OPEN, WATCH, WRITE, SIGN_IN = "record", "record-changes", "record-write", "record-sign-in"
WATCH_MS, RETRY_MS = 1000, 3000


class RecordState(Enum):
    """Whether the record can be asked."""

    CLOSED = auto()
    OPENING = auto()
    OPEN = auto()
    AWAY = auto()
    """It was open, and the database does not answer at the moment."""
    REFUSED = auto()
    """It cannot be opened: damaged, locked, of a newer version, or missing."""
    SIGNED_OUT = auto()
    """It has accounts, and nobody has signed in yet."""


@dataclass(frozen=True)
class _Opened:
    """An open record, and what the window has to know of it.

    Parameters
    ----------
    mark
        After which changes are to be noticed.
    """

    records: Records
    mark: int
    has_accounts: bool


class ClinicRecord(QObject):
    """Opens the clinic's record in a job, and runs every question to it in one.

    The database's library is imported in that job too: the window does not wait for it.

    Parameters
    ----------
    location
        Where the record is; on this computer, it is made at the first start.
    jobs
        Jobs of the record alone, so that no long computation keeps a save waiting.
    had_accounts
        Whether it had accounts when it was open last, as far as this computer knows.
    """

    state_changed = Signal()
    changed = Signal()
    """Somebody has changed the record, here or at another station."""
    author_changed = Signal()
    """Somebody else has signed in: what is shown already, they see from now on."""
    upgraded = Signal(object)
    """Emitted with the `Message` that the record was brought up to date, and what was kept."""

    def __init__(
        self,
        location: RecordLocation,
        jobs: Jobs,
        parent: QObject | None = None,
        *,
        had_accounts: bool = False,
    ) -> None:
        super().__init__(parent)
        self.location = location
        self.jobs = jobs
        self._records: Records | None = None
        self._writes = 0
        self._mark = 0
        self._watch = QTimer(self)
        self._watch.setInterval(WATCH_MS)
        self._watch.timeout.connect(self._look_for_changes)
        self._retry = QTimer(self)
        self._retry.setSingleShot(True)
        self._retry.setInterval(RETRY_MS)
        self._retry.timeout.connect(self._start_opening)
        self.had_accounts = had_accounts
        self.state = RecordState.CLOSED
        self.trouble = ""
        """Why the record cannot be asked; empty while it can."""
        self.has_accounts = False
        """Whether somebody has to sign in before the record can be asked."""

    @property
    def is_open(self) -> bool:
        """Whether the record can be asked."""
        return self.state is RecordState.OPEN

    @property
    def author(self) -> Author | None:
        """Whose changes these are; None before the record is open."""
        return None if self._records is None else self._records.who

    @property
    def may_show_patients(self) -> bool:
        """Whether whoever works here may see patients, as those who treat them."""
        author = self.author
        return author is None or author.role.sees_patients

    @property
    def hides_patients(self) -> bool:
        """Whether no patient may come up unasked: nobody has signed in who may see them."""
        if self.state is RecordState.SIGNED_OUT:
            return True
        return self.had_accounts if self._records is None else not self.may_show_patients

    @property
    def is_read_only(self) -> bool:
        """Whether nothing can be changed, as in a damaged database."""
        return self._records is not None and self._records.is_read_only

    @property
    def is_writable(self) -> bool:
        """Whether the record can be asked, and changed."""
        return self.is_open and not self.is_read_only

    @property
    def why_not_change(self) -> str:
        """Why nothing can be changed, for what is grey then; empty where it can."""
        return "" if self.is_writable else tr("Nothing can be changed in the record at the moment.")

    @property
    def why_read_only(self) -> str:
        """The same of a record that is open and cannot be changed, as a damaged one."""
        return self.why_not_change if self.is_read_only else ""

    @property
    def problem(self) -> Message | None:
        """Why an open record cannot be changed, such as damage; None where it can."""
        return None if self._records is None else self._records.problem

    def open(self) -> None:
        """Open the record in a job; make it where there is none."""
        if self.state in (RecordState.CLOSED, RecordState.REFUSED):
            self._retry.stop()
            self._set_state(RecordState.OPENING)
            self._start_opening()

    def _start_opening(self) -> None:
        location = self.location
        self.jobs.start(OPEN, lambda _progress: _open(location), self._take, self._refuse)

    def reopen(self, location: RecordLocation | None = None) -> None:
        """Open the record again, or another one; whoever has signed in has to do so again."""
        self.let_go()
        self.location = location or self.location
        self.open()

    def let_go(self) -> None:
        """Close the record, so that another one can take its place; `open` opens it again."""
        self._watch.stop()
        self._retry.stop()
        for channel in self.jobs.running:
            self.jobs.cancel(channel)
        if self._records is not None:
            self._records.close()
            self._records = None
        self.has_accounts = False
        self._set_state(RecordState.CLOSED)

    def sign_in(
        self,
        name: str,
        password: str,
        done: Callable[[Author], None],
        failed: Callable[[Exception], None],
        *,
        own: str = "",
    ) -> None:
        """Check name and password in a job; `take_author` then makes them the author.

        Parameters
        ----------
        own
            Password that takes the place of a first one; empty for none.
        """
        records = self._records
        if records is None:
            failed(_not_open())
            return
        accounts = records.accounts

        def sign_in(_progress: Progress) -> Author:
            if own:
                return accounts.change_password(name, password, own)
            return accounts.sign_in(name, password)

        self.jobs.start(SIGN_IN, sign_in, done, failed)

    def take_author(self, author: Author) -> None:
        """Let all changes from now on be those of somebody who has signed in."""
        assert self._records is not None
        before = self._records.who
        self._records = self._records.for_author(author)
        if self.state is RecordState.SIGNED_OUT:
            self._set_state(RecordState.OPEN)
            self._watch.start()
        else:
            self.state_changed.emit()
        if author.name != before.name:
            self.author_changed.emit()
        self.changed.emit()

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
            failed(_not_open())
            return

        def ask(_progress: Progress) -> Result:
            return question(records)

        def missed(error: Exception) -> None:
            self.note_failure(error)
            failed(error)

        self.jobs.start(channel, ask, done, missed)

    def write(
        self,
        change: Callable[[Records], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Change the record in a job that no other one replaces.

        Its answer arrives, unless the record is closed before.
        """
        self._writes += 1

        def told(result: Result) -> None:
            done(result)
            if self.state is RecordState.OPEN:
                self._look_for_changes()

        self.ask(f"{WRITE}-{self._writes}", change, told, failed)

    def ask_now(self, question: Callable[[Records], Result]) -> Result:
        """Ask in the calling thread, as the program ends.

        Raises
        ------
        InsoleError
            When the record is not open or does not answer.
        """
        if self._records is None:
            raise _not_open()
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
        self._retry.stop()
        self.jobs.close()
        if self._records is not None:
            self._records.close()
            self._records = None
        self.state = RecordState.CLOSED

    def _take(self, opened: _Opened) -> None:
        self._records, self._mark = opened.records, opened.mark
        self.has_accounts = self.had_accounts = opened.has_accounts
        self.trouble = ""
        if opened.records.upgrade is not None:
            self.upgraded.emit(opened.records.upgrade)
        if self.has_accounts:
            self._set_state(RecordState.SIGNED_OUT)
        else:
            self._set_state(RecordState.OPEN)
            self._watch.start()

    def _refuse(self, error: Exception) -> None:
        """Tell why the record cannot be opened; try again if it only does not answer."""
        if not isinstance(error, InsoleError):
            log.error("the record cannot be opened", exc_info=error)
        if isinstance(error, Unreachable):
            self._retry.start()
        if (self.state, self.trouble) != (RecordState.REFUSED, str(error)):
            self.trouble = str(error)
            self._set_state(RecordState.REFUSED)

    def _look_for_changes(self) -> None:
        """Ask what has changed, here or at another station, unless the last answer is to come."""
        if self.jobs.is_running(WATCH):
            return
        mark = self._mark

        def look(records: Records) -> tuple[int, bool, bool]:
            changes = records.changes_since(mark)
            is_changed = bool(changes.changes)
            return changes.mark, is_changed, is_changed and records.accounts.are_on

        self.ask(WATCH, look, self._note_changes, lambda _error: None)

    def _note_changes(self, found: tuple[int, bool, bool]) -> None:
        self._note_answer()
        self._mark, is_changed, has_accounts = found
        if is_changed:
            self._note_accounts(has_accounts)
            self.changed.emit()

    def _note_accounts(self, has_accounts: bool) -> None:
        """Ask for a sign-in once accounts were switched on, here or at another station."""
        if has_accounts is self.has_accounts:
            return
        self.has_accounts = self.had_accounts = has_accounts
        if has_accounts:
            self._watch.stop()
            self._set_state(RecordState.SIGNED_OUT)
        else:
            self.state_changed.emit()

    def _note_answer(self) -> None:
        """Note that a record which was away is back, as only the watch finds out, now and then.

        Else whoever saves at once when it is back would save without end while only reading works.
        """
        if self.state is RecordState.AWAY:
            self.trouble = ""
            self._watch.setInterval(WATCH_MS)
            self._set_state(RecordState.OPEN)

    def _set_state(self, state: RecordState) -> None:
        self.state = state
        self.state_changed.emit()


def _not_open() -> InsoleError:
    return InsoleError("The clinic's record is not open.")


def _open(location: RecordLocation) -> _Opened:
    from insole_core.records.records import open_records

    records = open_records(location.place(), Author.of_user())
    try:
        return _Opened(records, records.mark(), records.accounts.are_on)
    except BaseException:
        records.close()
        raise
