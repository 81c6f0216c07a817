"""The one door through which every text of the window goes, so that it can be translated."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QLocale, QTranslator

from insole_core.resources import resource_path
from insole_studio.phrasebook import Phrasebook

CONTEXT = "studio"
_books = {"core": Phrasebook({})}


def tr(text: str) -> str:
    """Give `text` in the language of the window."""
    return QCoreApplication.translate(CONTEXT, text)


def translated(sentence: str) -> str:
    """Give a sentence of the core in the language of the window; its catalogue is tested."""
    return QCoreApplication.translate(CONTEXT, sentence)


def translate_core_message(sentence: str) -> str:
    """Give a sentence with values that the core has written, in the language of the window."""
    return _books["core"].say(sentence)


def load_language(application: QCoreApplication, language: str) -> None:
    """Let the window speak "en", "sv" or that of the "system"; texts that stand already stay.

    A language is a folder of resources/translations; one without a folder is English.
    """
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    wanted = QLocale.system().name()[:2] if language == "system" else language
    folder = resource_path("translations") / wanted
    _books["core"] = Phrasebook.read(folder / "sentences.json")
    for catalogue in sorted(folder.glob("*.qm")):
        translator = QTranslator(application)
        translator.load(str(catalogue))
        application.installTranslator(translator)
