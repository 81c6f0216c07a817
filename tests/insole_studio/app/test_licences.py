"""Help ▸ Licences, in a bundle and from the sources."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from insole_core import resources
from insole_studio.app.bootstrap import Application
from insole_studio.app.help_actions import licence_text, licences
from insole_studio.app.text_dialog import TextDialog


def test_the_list_of_the_bundle_is_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "_resources" / "licences"
    folder.mkdir(parents=True)
    part = {"version": "1", "licence": "MIT", "texts": [{"name": "COPYING", "text": "Do."}]}
    listed = {
        "program": {"name": "Insole Studio", "version": "2", "licence": "BSD", "text": "May."},
        "replacing_qt": "Replace it so.",
        "components": [{"name": "numpy", **part}],
    }
    (folder / "licences.json").write_text(json.dumps(listed), encoding="utf-8")
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path)
    text = licence_text(*licences())
    assert text.startswith("Insole Studio 2: BSD\nnumpy 1: MIT\n")
    assert "Replace it so." in text
    assert "COPYING\n\nDo." in text


def test_from_the_sources_the_window_shows_the_installed_packages(
    app: Application, qtbot: QtBot
) -> None:
    app.window.actions_by_key["licences"].trigger()
    dialog = next(d for d in app.window.findChildren(TextDialog) if d.isVisible())
    qtbot.waitUntil(lambda: "numpy" in dialog.text.toPlainText())
    dialog.close()
