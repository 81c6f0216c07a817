"""A link is as readable as the text around it, in either theme."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_studio.app.theme import DARK, LIGHT, apply_theme
from insole_studio.widgets.form_parts import LinkLabel


def test_a_link_takes_the_colour_of_the_text_and_follows_the_theme(
    qapp: QApplication, qtbot: QtBot
) -> None:
    plain, warning = LinkLabel("Length < 3", "length"), LinkLabel("Too high", "0")
    warning.setObjectName("warning")
    for label in (plain, warning):
        qtbot.addWidget(label)
        label.show()
    for dark, colors in ((True, DARK), (False, LIGHT)):
        apply_theme(qapp, dark)
        QApplication.processEvents()
        assert f"color: {colors.text}" in plain.text()
        assert f"color: {colors.on_warning}" in warning.text()


def test_words_are_words_and_no_mark_up(qtbot: QtBot) -> None:
    label = LinkLabel("Length < 3 & more", "length", underlined=False)
    qtbot.addWidget(label)
    assert 'href="length"' in label.text()
    assert "Length &lt; 3 &amp; more" in label.text()
    assert "text-decoration: none" in label.text()
