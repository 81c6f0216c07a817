"""Every text of the window can be read in Swedish."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtWidgets import QApplication

import insole_studio
from insole_core.insole.prescription.clinic_rules import SENTENCES
from insole_core.resources import resource_path
from insole_studio.texts import load_language, tr

SWEDISH = resource_path("translations/sv")
DESIGN_PARTS = (
    "shell",
    "stages/calibrate",
    "stages/capture",
    "stages/compare",
    "stages/design",
    "stages/export",
    "stages/reconstruct",
    "tools",
    "widgets",
    "scene",
    "workbench",
)


def texts_of_the_code() -> Iterator[str]:
    root = Path(insole_studio.__file__).parent
    for part in DESIGN_PARTS:
        for path in (root / part).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "tr":
                    (text,) = node.args
                    assert isinstance(text, ast.Constant), f"{path}:{node.lineno}"
                    yield str(text.value)


def catalogue() -> dict[str, str]:
    return {
        message.findtext("source", ""): message.findtext("translation", "")
        for path in SWEDISH.glob("*.ts")
        for message in ElementTree.parse(path).iter("message")
    }


def test_every_text_has_a_swedish_one() -> None:
    translated = catalogue()
    assert [text for text in set(texts_of_the_code()) if not translated.get(text)] == []


def test_every_warning_of_the_rules_has_a_swedish_sentence() -> None:
    translated = catalogue()
    assert [sentence for sentence in SENTENCES if not translated.get(sentence)] == []


def test_names_in_braces_stay_what_they_are() -> None:
    for source, translation in catalogue().items():
        for part in source.split("{")[1:]:
            assert "{" + part.split("}")[0] + "}" in translation


def test_the_compiled_catalogues_are_those_of_the_texts(qapp: QApplication) -> None:
    load_language(qapp, "sv")
    wrong = {text for text, swedish in catalogue().items() if tr(text) != swedish}
    load_language(qapp, "en")
    assert wrong == set()


@pytest.mark.parametrize(("language", "text"), [("sv", "Häl"), ("en", "Heel")])
def test_the_window_speaks_the_language(qapp: QApplication, language: str, text: str) -> None:
    load_language(qapp, language)
    assert tr("Heel") == text
    load_language(qapp, "en")
