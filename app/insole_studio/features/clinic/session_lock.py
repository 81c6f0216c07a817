"""Signing in, and the lock of the windows while nobody uses them: what it hides, when it falls."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QVBoxLayout, QWidget

from insole_core.errors import InsoleError
from insole_core.records.author import Author
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.clinic.accounts_dialog import read_lock_minutes
from insole_studio.features.clinic.sign_in_dialog import SignInDialog
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr
from insole_studio.widgets.text_fields import commit_typed_text

LOOK_EVERY_MS = 5000
_INPUT = frozenset(
    {
        QEvent.Type.KeyPress,
        QEvent.Type.MouseButtonPress,
        QEvent.Type.MouseMove,
        QEvent.Type.Wheel,
        QEvent.Type.TouchBegin,
        QEvent.Type.TouchUpdate,
        QEvent.Type.TabletPress,
        QEvent.Type.TabletMove,
    }
)
_LOCKED_OUT = frozenset(
    {
        QEvent.Type.KeyPress,
        QEvent.Type.KeyRelease,
        QEvent.Type.ShortcutOverride,
        QEvent.Type.Shortcut,
        QEvent.Type.MouseButtonPress,
        QEvent.Type.MouseButtonRelease,
        QEvent.Type.MouseButtonDblClick,
        QEvent.Type.MouseMove,
        QEvent.Type.Wheel,
        QEvent.Type.ContextMenu,
        QEvent.Type.TouchBegin,
        QEvent.Type.TabletPress,
        QEvent.Type.Drop,
        QEvent.Type.DragEnter,
        QEvent.Type.ToolTip,
    }
)
_CANNOT_LEAVE = (KeepState.REFUSED, KeepState.CONFLICT)
SECONDS_OF_MINUTE = 60


class IdleWatch(QObject):
    """Looks at the events of the application while it runs, and costs nothing otherwise."""

    idle = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._most_s = 0.0
        self._monotonic_s = self._clock_s = 0.0
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self._look)

    @property
    def is_running(self) -> bool:
        """Whether somebody's time runs."""
        return self._timer.isActive()

    def start(self, most_s: float) -> None:
        """Emit `idle` after so many seconds without input."""
        self.stop()
        self._most_s = most_s
        self._note_input()
        QCoreApplication.instance().installEventFilter(self)  # type: ignore[union-attr]
        self._timer.start()

    def stop(self) -> None:
        """Look no more."""
        if self._timer.isActive():
            self._timer.stop()
            QCoreApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Note input; none is withheld."""
        if event.type() in _INPUT and event.spontaneous():
            self._note_input()
        return False

    def _note_input(self) -> None:
        self._monotonic_s, self._clock_s = time.monotonic(), time.time()

    def _look(self) -> None:
        # The monotonic clock stands still while a computer sleeps, and the other one may jump.
        idle_s = max(time.monotonic() - self._monotonic_s, time.time() - self._clock_s)
        if idle_s >= self._most_s:
            self.stop()
            self.idle.emit()


class _LockCover(QObject):
    """Covers every window but the one that asks for a password, also windows that come later.

    Their titles, which name patients, are hidden too. `lift` shows everything as it was.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._dialog: QWidget | None = None
        self._words = ""
        self._covers: dict[QWidget, _Cover] = {}

    def put_over_all(self, words: str, *, but: QWidget) -> None:
        """Cover all windows but one.

        Parameters
        ----------
        words
            What the covers and titles say.
        """
        self._dialog, self._words = but, words
        _close_popups()
        for window in QApplication.topLevelWidgets():
            self._cover(window)
        QCoreApplication.instance().installEventFilter(self)  # type: ignore[union-attr]

    def lift(self) -> None:
        """Show the windows again."""
        QCoreApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]
        covers, self._covers = self._covers, {}
        for cover in covers.values():
            cover.lift()
        self._dialog = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Withhold input from all but the dialog; cover windows that are shown."""
        if self._dialog is None or not isinstance(watched, QWidget):
            return False
        if event.type() == QEvent.Type.Show and watched.isWindow():
            self._cover(watched)
        elif event.type() in _LOCKED_OUT:
            return watched.window() is not self._dialog
        return False

    def _cover(self, window: QWidget) -> None:
        if window is self._dialog or window in self._covers or not window.isVisible():
            return
        if window.windowType() in (Qt.WindowType.ToolTip, Qt.WindowType.Popup):
            window.hide()
            return
        cover = _Cover(window, self._words)
        self._covers[window] = cover
        cover.destroyed.connect(lambda: self._covers.pop(window, None))


class _Cover(QWidget):
    """Fills a window, and keeps its title."""

    def __init__(self, window: QWidget, words: str) -> None:
        super().__init__(window)
        self.setAutoFillBackground(True)
        label = QLabel(words)
        label.setObjectName("heading")
        label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        layout = QVBoxLayout(self)
        layout.addWidget(label)
        # Systems put the name behind a title that does not end with it.
        self._covering_title = f"{words} – Insole Studio"
        self._window = window
        self._title = window.windowTitle()
        self._hide_title()
        window.installEventFilter(self)
        self.setGeometry(window.rect())
        self.raise_()
        self.show()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the size of the window, and hide a new title of it."""
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._window.rect())
        elif event.type() == QEvent.Type.WindowTitleChange:
            self._hide_title()
        elif event.type() in (QEvent.Type.ChildPolished, QEvent.Type.LayoutRequest):
            self.raise_()
        return False

    def lift(self) -> None:
        """Show the window with its title again."""
        self._window.removeEventFilter(self)
        self._window.setWindowTitle(self._title)
        self.hide()
        self.deleteLater()

    def _hide_title(self) -> None:
        title = self._window.windowTitle()
        if title != self._covering_title:
            self._title = title
            self._window.setWindowTitle(self._covering_title)


def _close_popups() -> None:
    while (popup := QApplication.activePopupWidget()) is not None:
        if not popup.close():
            return


class SessionLock(QObject):
    """Asks for a sign-in where the record has accounts, and locks the windows after some minutes.

    The open case stays as it is while they are locked, and is saved as before.

    Parameters
    ----------
    keep_now
        Writes the copy of the open case that is on this computer.
    hide_patients
        Leaves the open case, closes all that shows a patient, and shows the start page, for
        somebody who may not see patients.
    """

    quit_requested = Signal()
    """Emitted when the program is to end though nobody has signed in; nothing is shown or asked."""
    restore_requested = Signal()
    """Emitted when a damaged record is to be restored before anybody has signed in."""

    def __init__(
        self,
        services: AppServices,
        keep_now: Callable[[], None],
        hide_patients: Callable[[], None],
    ) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._keep_now = keep_now
        self._hide_patients = hide_patients
        self._cover = _LockCover(self)
        self._idle = IdleWatch(self)
        self._idle.idle.connect(self.lock)
        self._author: Author | None = None
        self.lock_minutes = 0
        self._waits = False
        self.dialog: SignInDialog | None = None
        self._clinic.state_changed.connect(self._follow)

    @property
    def author(self) -> Author | None:
        """Who has signed in; None while accounts are off or nobody has."""
        return self._author

    def lock(self) -> None:
        """Cover the windows until somebody signs in; where nobody has yet, ask for it."""
        if not self._clinic.has_accounts or self.dialog is not None:
            return
        self._idle.stop()
        if self._author is not None:
            commit_typed_text()
            self._keep_now()
        self._ask()

    def ask_after(self, dialog: QDialog) -> None:
        """Ask for a sign-in only once a dialog that closes and opens the record is done."""
        self._waits = True
        dialog.finished.connect(self._wait_no_more)

    def set_lock_minutes(self, minutes: int) -> None:
        """Lock the windows after so many minutes without input; never after 0."""
        self.lock_minutes = minutes
        self._watch()

    def close(self) -> None:
        """Watch no more, and show the windows."""
        self._idle.stop()
        self._end_dialog()

    def _wait_no_more(self) -> None:
        self._waits = False
        self._follow()

    def _follow(self) -> None:
        state = self._clinic.state
        if state is RecordState.SIGNED_OUT:
            if self.dialog is None and not self._waits:
                self._ask()
        elif not self._clinic.has_accounts:
            self._author = None
            self._idle.stop()
            self._end_dialog()

    def _ask(self) -> None:
        is_lock = self._author is not None
        name = self._author.name if self._author is not None else ""
        self.dialog = SignInDialog(
            self._clinic, name, is_lock=is_lock, parent=self._services.window
        )
        self.dialog.setWindowModality(Qt.WindowModality.ApplicationModal)
        self.dialog.signed_in.connect(self._take)
        self.dialog.quit_requested.connect(self.quit_requested)
        self.dialog.restore_requested.connect(self.restore_requested)
        self.dialog.finished.connect(self._leave_dialog)
        words = tr("Locked") if is_lock else tr("Sign in")
        self._cover.put_over_all(words, but=self.dialog)
        self.dialog.open()

    def _take(self, author: Author) -> None:
        """Let the windows be those of whoever has signed in, once the work before is saved."""
        before = self._author
        keeper = self._services.keeper
        if before is None or before.name == author.name or keeper.state in _CANNOT_LEAVE:
            self._hand_over(author)
        else:
            hand_over = partial(self._hand_over, author)
            keeper.leave(hand_over, otherwise=hand_over)

    def _hand_over(self, author: Author) -> None:
        if not author.role.sees_patients and not self._has_hidden_patients():
            return
        self._author = author
        self._end_dialog()
        self._clinic.take_author(author)
        self._clinic.ask(
            "clinic-lock-minutes",
            read_lock_minutes,
            self.set_lock_minutes,
            self._services.messages.show_error,
        )

    def _has_hidden_patients(self) -> bool:
        """Leave the open visit while the windows are still covered; tell if that cannot be done."""
        try:
            self._hide_patients()
        except InsoleError as error:
            if self.dialog is not None:
                self.dialog.refuse(error)
            return False
        return True

    def _watch(self) -> None:
        self._idle.stop()
        if self._author is not None and self.dialog is None and self.lock_minutes > 0:
            self._idle.start(self.lock_minutes * SECONDS_OF_MINUTE)

    def _end_dialog(self) -> None:
        dialog = self.dialog
        if dialog is not None:
            self._forget_dialog()
            dialog.done(0)

    def _leave_dialog(self) -> None:
        """Go on with files alone; nothing of the record may be seen from now on."""
        if self.dialog is None:
            return
        if self._clinic.state is RecordState.SIGNED_OUT and self._services.keeper.is_keeping:
            try:
                self._hide_patients()
            except InsoleError as error:  # its journal cannot be written, so it stays covered
                self._forget_dialog()
                self._services.messages.show_error(error)
                self._ask()
                return
        self._forget_dialog()

    def _forget_dialog(self) -> None:
        self._cover.lift()
        self.dialog = None
