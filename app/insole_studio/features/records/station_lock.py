"""Hides everything until somebody signs in: at the start, and after minutes without input."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer, Signal
from PySide6.QtWidgets import QWidget

from insole_studio.document.clinic_record import ClinicRecord, RecordState
from insole_studio.features.records.sign_in_page import SignInPage

_INPUT = (
    QEvent.Type.KeyPress,
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
    QEvent.Type.TabletPress,
)
_MINUTE_MS = 60_000


class StationLock(QObject):
    """Follows whether somebody is signed in; while accounts are off it does nothing.

    What was open stays open behind the page, and is saved as the work of who did it.
    """

    locked = Signal(QWidget)
    """Emitted with the page that is to hide everything else."""
    unlocked = Signal()

    def __init__(self, clinic: ClinicRecord, parent: QObject) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self.page: SignInPage | None = None
        self._is_locked = False
        self._idle = QTimer(self)
        self._idle.setSingleShot(True)
        self._idle.timeout.connect(clinic.lock)
        clinic.state_changed.connect(self._follow)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Begin to count the minutes anew with every input; none is withheld."""
        if event.type() in _INPUT and not self._is_locked:
            self._idle.start()
        return False

    def close(self) -> None:
        """Stop following the input."""
        self._idle.stop()
        self._listen(False)

    def _follow(self) -> None:
        is_locked = self._clinic.state is RecordState.LOCKED
        if is_locked == self._is_locked:
            return
        self._is_locked = is_locked
        self._listen(not is_locked)
        if is_locked:
            self._idle.stop()
            self.locked.emit(self._shown_page())
            self._shown_page().begin()
        else:
            self._idle.setInterval(round(self._clinic.lock_after_min * _MINUTE_MS))
            self._idle.start()
            self.unlocked.emit()

    def _listen(self, on: bool) -> None:
        application = QCoreApplication.instance()
        if application is not None:
            application.removeEventFilter(self)
            if on:
                application.installEventFilter(self)

    def _shown_page(self) -> SignInPage:
        if self.page is None:
            self.page = SignInPage()
            self.page.sign_in_requested.connect(self._sign_in)
        return self.page

    def _sign_in(self, name: str, password: str) -> None:
        self._clinic.sign_in(name, password, self._refuse)

    def _refuse(self, error: Exception) -> None:
        self._shown_page().show_refusal(str(error))
