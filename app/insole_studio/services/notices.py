"""The current notices, and what their buttons do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from PySide6.QtCore import QObject

from insole_studio.widgets.notice_bar import Notice, NoticeBar

Offer: TypeAlias = tuple[str, Callable[[], object]]
"""Label of a button, and what it does."""


@dataclass(frozen=True)
class _Shown:
    notice: Notice
    offers: tuple[Offer, ...]
    stays: bool
    on_pages: bool


class Notices(QObject):
    """Maintains the notice bar; a notice replaces an earlier one with the same key."""

    def __init__(self, bar: NoticeBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bar = bar
        self._shown: dict[str, _Shown] = {}
        self._on_page = False
        bar.taken.connect(self.take)
        bar.dismissed.connect(self.drop)

    @property
    def notices(self) -> list[Notice]:
        """Return the shown notices."""
        return [
            shown.notice
            for shown in self._shown.values()
            if shown.stays or shown.on_pages or not self._on_page
        ]

    def put(
        self, key: str, text: str, *offers: Offer, stays: bool = False, on_pages: bool = False
    ) -> None:
        """Show a notice, with a button for each offer.

        Parameters
        ----------
        key
            A later notice with the same key replaces this one.
        offers
            Label and action of each button.
        stays
            Whether it outlives the open case, because it does not concern it.
        on_pages
            Whether it is shown on the pages of the record too, though it goes with the open case;
            what stays always is.
        """
        labels = tuple(label for label, _ in offers)
        self._shown[key] = _Shown(Notice(key, text, labels), offers, stays, on_pages)
        self._bar.show_notices(self.notices)

    def hide_of_case(self, hidden: bool) -> None:
        """Hide what concerns the open case while a page of the record takes its place."""
        self._on_page = hidden
        self._bar.show_notices(self.notices)

    def drop(self, key: str) -> None:
        """Remove a notice."""
        if self._shown.pop(key, None) is not None:
            self._bar.show_notices(self.notices)

    def clear(self) -> None:
        """Remove all notices that concern the open case."""
        self._shown = {key: shown for key, shown in self._shown.items() if shown.stays}
        self._bar.show_notices(self.notices)

    def drop_all(self) -> None:
        """Remove all notices."""
        self._shown.clear()
        self._bar.show_notices([])

    def take(self, key: str, number: int = 0) -> None:
        """Remove a notice, and carry out one of its offers."""
        _, run = self._shown[key].offers[number]
        self.drop(key)
        run()
