"""Translation: every text of the window passes through this module."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QLocale, QTranslator

from insole_core.messages import Message
from insole_core.resources import resource_path

CONTEXT = "studio"
CORE_CONTEXT = "core"


def tr(text: str) -> str:
    """Return `text` in the language of the window."""
    return QCoreApplication.translate(CONTEXT, text)


def translate_core_message(sentence: str) -> str:
    """Return a message of the core in the language of the window, with its values translated too.

    What is in no catalogue stays as it is: numbers, names, and texts of the window itself.
    """
    if not isinstance(sentence, Message) or not sentence.values:
        return QCoreApplication.translate(CORE_CONTEXT, str(sentence))
    template = QCoreApplication.translate(CORE_CONTEXT, sentence.template)
    values = {
        name: translate_core_message(value) if isinstance(value, str) else value
        for name, value in sentence.values.items()
    }
    return template.format(**values)


def load_language(application: QCoreApplication, language: str) -> None:
    """Set the window's language: "en", "sv" or "system"; texts already shown stay.

    A language is a folder in resources/translations; a language without one falls back to English.
    """
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    wanted = QLocale.system().name()[:2] if language == "system" else language
    folder = resource_path("translations") / wanted
    for catalogue in sorted(folder.glob("*.qm")):
        translator = QTranslator(application)
        translator.load(str(catalogue))
        application.installTranslator(translator)
