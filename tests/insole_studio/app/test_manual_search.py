"""The search of the manual shows where on a page the searched words are, and marks them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtQml import QJSEngine
from PySide6.QtWidgets import QApplication

SCRIPT = Path(__file__).parents[3] / "docs" / "search_excerpts.js"
STEM = "word => word.replace(/(ing|e|s)$/, '')"
PAGE = (
    "The heel cup holds the heel. " + "Nothing of interest stands here. " * 20 + "A cup of 18 "
    "(deep cups, for a heel that tilts) is calibrated in a session; " + "more follows. " * 40
)


@pytest.fixture(scope="module")
def script(qapp: QApplication) -> QJSEngine:
    engine = QJSEngine()
    read = engine.evaluate(SCRIPT.read_text("utf-8"), SCRIPT.name)
    assert not read.isError(), read.toString()
    return engine


def excerpt(script: QJSEngine, text: str, *stems: str) -> list[tuple[str, bool]]:
    call = f"JSON.stringify(excerptOf({json.dumps(text)}, new Set({json.dumps(stems)}), {STEM}))"
    found = script.evaluate(call)
    assert not found.isError(), found.toString()
    return [(piece, marked) for piece, marked in json.loads(found.toString())]


def test_the_words_are_marked_in_every_form(script: QJSEngine) -> None:
    pieces = excerpt(script, PAGE, "calibrated", "cup", "tilt")
    marked = [piece for piece, is_marked in pieces if is_marked]
    assert marked == ["cup", "cups", "tilts", "calibrated"]
    text = "".join(piece for piece, _ in pieces)
    assert text.startswith("… ")
    assert text.endswith(" …")
    assert text.strip("… ") in PAGE
    assert len(text) < 300


def test_a_page_without_the_word_gets_no_excerpt(script: QJSEngine) -> None:
    assert excerpt(script, PAGE, "pelott") == []
    assert excerpt(script, "", "heel") == []


def test_the_beginning_and_letters_of_any_language_are_shown(script: QJSEngine) -> None:
    assert excerpt(script, "Hälsporre: urgröpning.", "hälsporr") == [
        ("Hälsporre", True),
        (": urgröpning.", False),
    ]
    assert excerpt(script, "<b>heel</b> & more", "heel") == [
        ("<b>", False),
        ("heel", True),
        ("</b> & more", False),
    ]
