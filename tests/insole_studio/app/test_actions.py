from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QLineEdit, QTreeWidget

from insole_studio.app.actions import ACTIONS
from insole_studio.app.bootstrap import Application
from insole_studio.app.key_reference import key_sections
from insole_studio.app.menus import MAPS, MENUS, PADS, RECENT, SEPARATOR, TOOLBAR
from insole_studio.texts import load_language
from insole_studio.widgets.key_help import KeyHelp

KEYS = [record.key for record in ACTIONS]
OF_ONE_TEXT = {"tool_posting", "add_posting"}
"""The tool of the posting, and what it adds: no two other actions are called alike."""


def test_keys_texts_and_shortcuts_are_unique() -> None:
    for values in (
        KEYS,
        [record.text() for record in ACTIONS if record.key not in OF_ONE_TEXT],
        [s for record in ACTIONS for s in (record.shortcut, record.other_shortcut) if s],
    ):
        assert [value for value, count in Counter(values).items() if count > 1] == []
    texts = Counter(record.text() for record in ACTIONS)
    posting = next(record.text() for record in ACTIONS if record.key == "tool_posting")
    assert texts[posting] == len(OF_ONE_TEXT)


def test_every_action_is_in_exactly_one_menu() -> None:
    listed = [key for _, keys in MENUS for key in keys if key not in (SEPARATOR, RECENT, PADS)]
    assert sorted(listed) == sorted(KEYS)


def test_toolbar_actions_exist_and_have_icons() -> None:
    records = {record.key: record for record in ACTIONS}
    assert all(records[key].icon for part in TOOLBAR for key in part if key != MAPS)


def test_every_action_explains_itself() -> None:
    assert all(record.tip() for record in ACTIONS)


def test_icons_are_drawn(app: Application) -> None:
    for record in ACTIONS:
        if record.icon:
            assert not app.window.actions_by_key[record.key].icon().isNull(), record.key


def test_without_a_foot_nothing_that_needs_one_is_offered(app: Application) -> None:
    enabled = {key for key, action in app.window.actions_by_key.items() if action.isEnabled()}
    assert enabled.isdisjoint({r.key for r in ACTIONS if r.needs_foot} | {"undo", "redo"})
    assert {"open_session", "open_archive", "open"} <= enabled


def test_exactly_one_tool_is_checked(opened: Application) -> None:
    for record in ACTIONS:
        if record.group == "tools":
            opened.window.actions_by_key[record.key].trigger()
            checked = [
                r.key
                for r in ACTIONS
                if r.group == "tools" and opened.window.actions_by_key[r.key].isChecked()
            ]
            assert checked == [record.key]
            assert record.key == f"tool_{opened.stage.tool_controller.tool.key}"


@pytest.mark.parametrize("language", ["en", "sv"])
def test_the_manual_lists_every_key_and_no_other(qapp: QApplication, language: str) -> None:
    page = "keyboard.md" if language == "en" else f"{language}/keyboard.md"
    text = (Path(__file__).parents[3] / "docs/manual" / page).read_text("utf-8")
    listed = [row for row in text.partition("\n### ")[2].splitlines() if row.startswith("| ")]
    load_language(qapp, language)
    lines = [f"| {text} | {keys} |" for _, lines in key_sections() for text, keys in lines]
    load_language(qapp, "en")
    headings = ("| What | Keys |", "| Vad | Tangenter |")
    assert [row for row in listed if row not in headings] == lines


def test_the_help_shows_every_key_and_finds_it(app: Application) -> None:
    app.window.actions_by_key["keys"].trigger()
    (shown,) = app.window.findChildren(KeyHelp)
    tree, search = shown.findChild(QTreeWidget), shown.findChild(QLineEdit)
    assert isinstance(tree, QTreeWidget)
    assert isinstance(search, QLineEdit)
    count = sum(len(lines) for _, lines in key_sections())
    assert _visible_lines(tree) == count
    search.setText("pelott")
    assert 0 < _visible_lines(tree) < count
    shown.close()


def test_the_help_names_keys_in_the_language_of_the_window(
    app: Application, qapp: QApplication
) -> None:
    load_language(qapp, "sv")
    shown = KeyHelp(key_sections(), app.window)
    load_language(qapp, "en")
    tree = shown.findChild(QTreeWidget)
    assert isinstance(tree, QTreeWidget)
    sections = [tree.invisibleRootItem().child(i) for i in range(tree.topLevelItemCount())]
    keys = [s.child(i).text(1) for s in sections for i in range(s.childCount())]
    assert "Tab  Skift+Tab" in keys
    assert [key for key in keys if re.search(r"Shift|\bDown|Space|Home", key)] == []
    shown.close()


def _visible_lines(tree: QTreeWidget) -> int:
    sections = [tree.invisibleRootItem().child(i) for i in range(tree.topLevelItemCount())]
    return sum(not s.child(i).isHidden() for s in sections for i in range(s.childCount()))
