"""The colour image of one view, with tools to correct its markers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QToolButton, QVBoxLayout, QWidget

from insole_core.geometry.arrays import ByteArray
from insole_core.recording.hand_edits import Pixel, Region, ViewEdits
from insole_studio.features.foot.marker_picture import ENLARGED, MarkerPicture
from insole_studio.features.foot.rows import Mark
from insole_studio.texts import tr


class MarkerPanel(QWidget):
    """Shows the markers of a view; a click on one opens a menu of corrections."""

    marker_toggled = Signal(str)
    marker_named = Signal(str, object, bool)
    marker_released = Signal(str)
    spot_ignored = Signal(object)
    region_ignored = Signal(object)
    region_searched = Signal(object)
    regions_cleared = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.picture = MarkerPicture()
        self.picture.mark_chosen.connect(self._offer)
        self.picture.mark_toggled.connect(self.marker_toggled)
        self.picture.region_drawn.connect(self._take_region)
        self.menu = QMenu(self)
        self._marks: tuple[Mark, ...] = ()
        self._ids: tuple[str, ...] = ()
        self.search = _tool(tr("Search only here"), tr("Draw the region that shows the markers"))
        self.ignore = _tool(tr("Ignore a region"), tr("Draw a region that shows no marker"))
        self.clear = QToolButton()
        self.clear.setText(tr("Whole image"))
        self.clear.setToolTip(tr("Search the whole image again"))
        self.clear.clicked.connect(self.regions_cleared)
        for button, other in ((self.search, self.ignore), (self.ignore, self.search)):
            button.toggled.connect(partial(self._draw, other))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        layout.setSpacing(4)
        layout.addLayout(self._header())
        layout.addWidget(self.picture, 1)

    def show_nothing(self) -> None:
        """Show no image and no marks."""
        self._marks, self._ids = (), ()
        self.picture.show_nothing()

    def show_picture(self, picture: ByteArray) -> None:
        """Show the image of another view."""
        self.picture.show_picture(picture)

    def show_markers(self, marks: Sequence[Mark], ids: Sequence[str], edits: ViewEdits) -> None:
        """Show the marks, and enable the corrections that apply.

        Parameters
        ----------
        marks
            The marks on the image.
        ids
            Ids of all markers, for the menu.
        edits
            The manual corrections of the view.
        """
        self._marks, self._ids = tuple(marks), tuple(ids)
        self.picture.show_marks(marks)
        self.picture.show_regions(edits.ignored, edits.searched)
        self.clear.setEnabled(bool(edits.ignored) or edits.searched is not None)

    def fill_menu(self, marker: str, pixel: Pixel) -> None:
        """Fill the menu of corrections for a place in the image.

        Parameters
        ----------
        marker
            Id of the marker there; empty if there is none.
        pixel
            Position in the image.
        """
        self.menu.clear()
        mark = next((mark for mark in self._marks if mark.pixel == pixel), None)
        if marker:
            is_out = mark is not None and mark.state == "excluded"
            text = tr("Include {id}") if is_out else tr("Exclude {id}")
            self._add(text.format(id=marker), partial(self.marker_toggled.emit, marker))
            if is_out or (mark is not None and mark.by_hand):
                text = tr("Search for {id}").format(id=marker)
                self._add(text, partial(self.marker_released.emit, marker))
        if mark is not None and not mark.by_hand:
            self._add(tr("This is no marker"), partial(self.spot_ignored.emit, pixel))
        self.menu.addSeparator()
        names = self.menu.addMenu(tr("This is") if mark is not None else tr("Add a marker here"))
        for other in self._ids:
            if other != marker:
                action = names.addAction(other)
                action.triggered.connect(
                    partial(self._name, other, pixel, mark is None or mark.by_hand)
                )

    def _name(self, marker: str, pixel: Pixel, exact: bool, _checked: bool = False) -> None:
        self.marker_named.emit(marker, pixel, exact)

    def _offer(self, marker: str, pixel: Pixel) -> None:
        self.fill_menu(marker, pixel)
        self.menu.popup(QCursor.pos())

    def _add(self, text: str, run: Callable[[], None]) -> None:
        self.menu.addAction(text).triggered.connect(lambda _checked: run())

    def _take_region(self, region: Region) -> None:
        signal = self.region_searched if self.search.isChecked() else self.region_ignored
        self.search.setChecked(False)
        self.ignore.setChecked(False)
        signal.emit(region)

    def _draw(self, other: QToolButton, on: bool) -> None:
        if on:
            other.setChecked(False)
        self.picture.draw_region(self.search.isChecked() or self.ignore.isChecked())

    def _header(self) -> QHBoxLayout:
        header = QHBoxLayout()
        header.setSpacing(4)
        for button in (self.search, self.ignore, self.clear):
            header.addWidget(button)
        header.addStretch(1)
        scale = QLabel(
            tr("Red: how far a marker is off, {number} times enlarged").format(number=ENLARGED)
        )
        scale.setObjectName("quiet")
        header.addWidget(scale)
        return header


def _tool(text: str, tip: str) -> QToolButton:
    button = QToolButton()
    button.setText(text)
    button.setToolTip(tip)
    button.setCheckable(True)
    return button
