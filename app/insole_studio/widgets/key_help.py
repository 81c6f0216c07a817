"""A searchable list of keyboard shortcuts under headings."""

from __future__ import annotations

import re
from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QHeaderView,
    QLineEdit,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr

_SIZE = (560, 640)
Line = tuple[str, str]
"""What the keys do, and the keys."""


class KeyHelp(QDialog):
    """A non-modal window listing keyboard shortcuts; deleted when closed."""

    def __init__(self, sections: Iterable[tuple[str, list[Line]]], parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(tr("Keys"))
        self.resize(*_SIZE)
        self._search = QLineEdit()
        self._search.setPlaceholderText(tr("Search"))
        self._search.setClearButtonEnabled(True)
        self._search.textChanged.connect(self._filter)
        self._sections: list[tuple[QTreeWidgetItem, list[QTreeWidgetItem]]] = []
        self._list = QTreeWidget()
        self._list.setColumnCount(2)
        self._list.setHeaderHidden(True)
        self._list.setRootIsDecorated(False)
        self._list.setWordWrap(True)
        self._list.header().setStretchLastSection(False)
        self._list.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self._list.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        for title, lines in sections:
            self._add(title, lines)
        layout = QVBoxLayout(self)
        layout.addWidget(self._search)
        layout.addWidget(self._list)

    def _add(self, title: str, lines: list[Line]) -> None:
        section = QTreeWidgetItem([title, ""])
        font = section.font(0)
        font.setBold(True)
        section.setFont(0, font)
        items = [QTreeWidgetItem([text, _native(keys)]) for text, keys in lines]
        section.addChildren(items)
        self._list.addTopLevelItem(section)
        section.setExpanded(True)
        self._sections.append((section, items))

    def _filter(self, wanted: str) -> None:
        """Show only the lines that contain the search text."""
        for section, lines in self._sections:
            for line in lines:
                words = f"{line.text(0)} {line.text(1)}".casefold()
                line.setHidden(wanted.casefold() not in words)
            section.setHidden(all(line.isHidden() for line in lines))


def _native(keys: str) -> str:
    """Return the keys of a line in the platform's notation and the language of the window."""
    return re.sub(r"[^\s,]+", lambda found: _native_key(found[0]), keys)


def _native_key(key: str) -> str:
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText) or key
