"""What the manual says of keys in its prose is what they do in the window."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from insole_studio.app.actions import ACTIONS
from insole_studio.app.key_reference import key_sections
from insole_studio.texts import load_language, tr

MANUAL = Path(__file__).parents[3] / "docs" / "manual"
ONE_KEY = r"(?:(?:Ctrl|Shift|Alt)\+)*(?:F\d{1,2}|[A-Z]\b)"
NAMED = re.compile(rf"(?<!\*)\*{{1,2}}([^*\n]+)\*{{1,2}}\s\(({ONE_KEY})")
"""A name and its keys: "**Contour lines** (N)"."""
COMBINED = re.compile(r"(?<![\w+])(?:(?:Ctrl|Shift|Alt)\+)+[A-Za-z0-9]+|\bF\d{1,2}\b")
OF_STAGES = {"F5": ("The sensor stands", "Capture")}
"""Keys of a button of a stage, which takes several names in turn."""
OF_DIALOGS = {"F4", "F5", "Alt+Down", "Shift+Tab"}
OF_SYSTEM = {"Shift+F10", "Alt+F"}


@pytest.fixture(params=["en", "sv"])
def prose(request: pytest.FixtureRequest, qapp: QApplication) -> Iterator[list[tuple[str, str]]]:
    """Pages of a language with their texts, while the window speaks it."""
    folder = MANUAL if request.param == "en" else MANUAL / request.param
    load_language(qapp, request.param)
    yield [(page.name, page.read_text("utf-8")) for page in sorted(folder.glob("*.md"))]
    load_language(qapp, "en")


def names_by_key() -> dict[str, set[str]]:
    """Return the names that the window has for what a key does."""
    names: dict[str, set[str]] = {key: set(map(tr, texts)) for key, texts in OF_STAGES.items()}
    for record in ACTIONS:
        texts = {record.text(), record.text() if record.short is None else record.short()}
        for key in filter(None, (record.shortcut, record.other_shortcut)):
            names[key] = {text.replace("&&", "&").rstrip("…") for text in texts}
    return names


def test_the_name_before_a_key_is_that_of_its_action(prose: list[tuple[str, str]]) -> None:
    names = names_by_key()
    claims = [
        (page, re.split("[▸›]", name)[-1].strip().rstrip("…"), key)
        for page, text in prose
        for name, key in NAMED.findall(" ".join(text.split()))
    ]
    assert len(claims) > 20
    assert [claim for claim in claims if claim[1] not in names.get(claim[2], ())] == []


def test_every_combination_of_keys_is_one_of_the_window(prose: list[tuple[str, str]]) -> None:
    listed = {
        key
        for _, lines in key_sections()
        for _, keys in lines
        for key in re.split(r",\s|\s+", keys)
    }
    known = listed | OF_DIALOGS | OF_SYSTEM
    claims = {
        (page, key.replace("Retur", "Enter"))
        for page, text in prose
        for key in COMBINED.findall(text)
    }
    assert len(claims) > 20
    assert sorted(claim for claim in claims if claim[1] not in known) == []
