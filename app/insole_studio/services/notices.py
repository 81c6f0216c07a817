"""The current notices, and what their buttons do."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject

from insole_studio.widgets.notice_bar import Notice, NoticeBar


class Notices(QObject):
    """Maintains the notice bar; a notice replaces an earlier one with the same key."""

    def __init__(self, bar: NoticeBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bar = bar
        self._shown: dict[str, tuple[Notice, Callable[[], object] | None]] = {}
        bar.taken.connect(self.take)
        bar.dismissed.connect(self.drop)

    @property
    def notices(self) -> list[Notice]:
        """Return the shown notices."""
        return [notice for notice, _ in self._shown.values()]

    def put(
        self, key: str, text: str, offer: str = "", run: Callable[[], object] | None = None
    ) -> None:
        """Show a notice, with a button labelled `offer` that calls `run`.

        Parameters
        ----------
        key
            A later notice with the same key replaces this one.
        offer
            Label of the button; without one there is no button.
        """
        self._shown[key] = Notice(key, text, offer), run
        self._bar.show_notices(self.notices)

    def drop(self, key: str) -> None:
        """Remove a notice."""
        if self._shown.pop(key, None) is not None:
            self._bar.show_notices(self.notices)

    def clear(self) -> None:
        """Remove all notices."""
        self._shown.clear()
        self._bar.show_notices([])

    def take(self, key: str) -> None:
        """Carry out what a notice offers, and remove it."""
        _, run = self._shown[key]
        self.drop(key)
        if run is not None:
            run()
