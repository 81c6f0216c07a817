"""The status bar: pointer position, hint, and progress of the current job."""

from __future__ import annotations

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QLabel, QProgressBar, QStatusBar, QToolButton, QWidget

from insole_studio.jobs import JobProgress, Jobs
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.icons import give_icon

SHOW_AFTER_MS = 300
LEAST_SENTENCE_PX = 56


class StatusBar(QStatusBar):
    """The status bar; of several jobs it shows the one that reported last."""

    cancel_requested = Signal(str)

    def __init__(self, jobs: Jobs, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._channel = ""
        self._place = QLabel()
        self._place.setMinimumWidth(228)
        self._place.setContentsMargins(4, 0, 0, 0)
        self._hint = ElidedLabel("")
        self._hint.setObjectName("quiet")
        self._work = ElidedLabel("")
        for sentence in (self._hint, self._work):  # none may widen the window
            sentence.setMinimumWidth(LEAST_SENTENCE_PX)
        self._bar = QProgressBar()
        self._bar.setFixedSize(144, 12)
        self._bar.setTextVisible(False)
        self._cancel = QToolButton()
        give_icon(self._cancel, "remove")
        self._cancel.setToolTip(tr("Cancel"))
        self._cancel.setAutoRaise(True)
        self._cancel.clicked.connect(self._request_cancel)
        self.addWidget(self._place)
        self.addWidget(self._hint, 1)
        for widget in (self._work, self._bar, self._cancel):
            self.addPermanentWidget(widget)
            widget.hide()
        self._kept = QLabel()
        self._kept.setContentsMargins(8, 0, 8, 0)
        self.addPermanentWidget(self._kept)
        self._user = QLabel()
        self._user.setObjectName("quiet")
        self._user.setContentsMargins(8, 0, 8, 0)
        self.addPermanentWidget(self._user)
        self._user.hide()
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.setInterval(SHOW_AFTER_MS)
        self._patience.timeout.connect(self._show_work)
        self.follow(jobs)

    def follow(self, jobs: Jobs) -> None:
        """Show the progress of these jobs, too."""
        jobs.progressed.connect(self._progressed)
        jobs.ended.connect(self._ended)
        self.cancel_requested.connect(jobs.cancel)

    def show_place(self, text: str) -> None:
        """Show the position of the pointer."""
        self._place.setText(text)

    def show_hint(self, text: str) -> None:
        """Show what the user can do next."""
        self._hint.setText(text)

    def show_tool_texts(self, shown: bool) -> None:
        """Show position and hint beside the panels; a page that takes their place has no tool."""
        self._place.setVisible(shown)
        self._hint.setVisible(shown)

    def show_kept(self, text: str, tip: str, *, warns: bool) -> None:
        """Show whether the open case is in the clinic's record; empty for a case of a file."""
        self._kept.setText(text)
        self._kept.setToolTip(tip)
        self._kept.setVisible(bool(text))
        self._kept.setObjectName("warning" if warns else "quiet")
        self._kept.style().polish(self._kept)  # the style sheet depends on the name

    @property
    def kept_text(self) -> str:
        """What is said of the open visit."""
        return self._kept.text()

    def show_user(self, text: str) -> None:
        """Show who has signed in; empty where nobody has to."""
        self._user.setText(text)
        self._user.setVisible(bool(text))

    def _progressed(self, news: JobProgress) -> None:
        self._channel = news.channel
        self._bar.setRange(0, 100)
        self._bar.setValue(round(100 * news.fraction))
        self._work.setText(_describe(news))
        if not self._bar.isVisible() and not self._patience.isActive():
            self._patience.start()

    def _show_work(self) -> None:
        for widget in (self._work, self._bar, self._cancel):
            widget.show()

    def _ended(self, channel: str) -> None:
        if channel != self._channel:
            return
        self._patience.stop()
        for widget in (self._work, self._bar, self._cancel):
            widget.hide()

    def _request_cancel(self) -> None:
        self.cancel_requested.emit(self._channel)


def _describe(news: JobProgress) -> str:
    text = f"{translate_core_message(news.text)}…" if news.text else ""
    if news.left_s is not None and news.left_s > 1:
        text += "  " + tr("{seconds} s left").format(seconds=round(news.left_s))
    return text
