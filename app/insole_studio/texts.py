"""Translation: every text and every number of the window passes through this module."""

from __future__ import annotations

from pathlib import Path
from string import Formatter

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from insole_core.messages import Message
from insole_core.resources import resource_path

CONTEXT = "studio"
CORE_CONTEXT = "core"


def tr(text: str) -> str:
    """Return `text` in the language of the window."""
    return QCoreApplication.translate(CONTEXT, text)


class _Localised(Formatter):
    """Fills placeholders; numbers get the decimal sign of the window's language."""

    def format_field(self, value: object, format_spec: str) -> str:
        text: str = super().format_field(value, format_spec)
        return text.replace(".", QLocale().decimalPoint()) if isinstance(value, float) else text


def fill(template: str, **values: object) -> str:
    """Fill the placeholders of a translated text, with numbers as the language writes them."""
    return _Localised().vformat(template, (), values)


def localised(value: float, spec: str = ".1f") -> str:
    """Write a number as the language of the window does; `spec` as for `format`."""
    return _Localised().format_field(float(value), spec)


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
    return fill(template, **values)


def load_language(application: QCoreApplication, language: str) -> None:
    """Set the window's language: "en", "sv" or "system"; texts already shown stay.

    A language is a folder in resources/translations; a language without one falls back to English.
    Qt's own texts (of its file dialogs) come with Qt.
    """
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    wanted = QLocale.system().name()[:2] if language == "system" else language
    catalogues = sorted((resource_path("translations") / wanted).glob("*.qm"))
    QLocale.setDefault(QLocale(wanted if catalogues else "en"))
    if catalogues:
        own = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))
        catalogues.append(own / f"qtbase_{wanted}.qm")
    for catalogue in catalogues:
        translator = QTranslator(application)
        translator.load(str(catalogue))
        application.installTranslator(translator)
