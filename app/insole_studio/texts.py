"""Translation: every text and every number of the window passes through this module."""

from __future__ import annotations

from datetime import datetime
from functools import partial
from pathlib import Path
from string import Formatter

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from insole_core.messages import Message, Translate, shown_value
from insole_core.resources import resource_path

CONTEXT = "insole_studio"
"""One for the window and the core: a text has one translation, whoever says it."""


class _Text(str):
    """A text of the window; what is filled into it may come from anywhere, and is made visible."""

    def format(self, *values: object, **named: object) -> str:
        """Fill the placeholders."""
        shown = {name: shown_value(value) for name, value in named.items()}
        return super().format(*map(shown_value, values), **shown)


def tr(text: str) -> str:
    """Return `text` in the language of the window."""
    return _Text(QCoreApplication.translate(CONTEXT, text))


class _Localised(Formatter):
    """Fills placeholders; numbers get the decimal sign of a language, by default the window's."""

    def __init__(self, locale: QLocale | None = None) -> None:
        self._locale = QLocale() if locale is None else locale

    def format_field(self, value: object, format_spec: str) -> str:
        text: str = super().format_field(value, format_spec)
        return text.replace(".", self._locale.decimalPoint()) if isinstance(value, float) else text


def fill(template: str, **values: object) -> str:
    """Fill the placeholders of a translated text, with numbers as the language writes them."""
    shown = {name: shown_value(value) for name, value in values.items()}
    return _Localised().vformat(template, (), shown)


def localised(value: float, spec: str = "z.1f") -> str:
    """Write a number as the language of the window does; `spec` as for `format`: no "-0.0"."""
    return _Localised().format_field(float(value), spec)


def moment_text(moment: datetime | str) -> str:
    """Return a time as the clock of this computer shows it.

    Parameters
    ----------
    moment
        With its time zone, or ISO 8601 as the record writes it.
    """
    if isinstance(moment, str):
        try:
            moment = datetime.fromisoformat(moment)
        except ValueError:
            return str(moment)
    return moment.astimezone().strftime("%Y-%m-%d %H:%M")


def with_capital(text: str) -> str:
    """Return a text as it begins a line."""
    return text[:1].upper() + text[1:]


def translate_core_message(sentence: str) -> str:
    """Return a message of the core in the language of the window, with its values translated too.

    What is in no catalogue stays as it is: numbers, names, and texts of the window itself.
    """
    return _translated(sentence, partial(QCoreApplication.translate, CONTEXT), QLocale())


def _translated(sentence: str, look_up: Translate, locale: QLocale) -> str:
    if not isinstance(sentence, Message) or not sentence.values:
        return look_up(str(sentence))
    values = {
        name: _translated(value, look_up, locale) if isinstance(value, str) else value
        for name, value in sentence.values.items()
    }
    return _Localised(locale).vformat(look_up(sentence.template), (), values)


def translation_into(language: str) -> Translate:
    """Return what translates messages of the core, whatever the window's language is.

    Parameters
    ----------
    language
        As for `load_language`.
    """
    code = language_code(language)
    translators = [QTranslator() for _ in _catalogues(code)]
    for translator, catalogue in zip(translators, _catalogues(code), strict=True):
        translator.load(str(catalogue))

    def look_up(text: str) -> str:
        found = (translator.translate(CONTEXT, text) for translator in translators)
        return next(filter(None, found), text)

    locale = QLocale(code)
    return lambda sentence: _translated(sentence, look_up, locale)


def language_code(language: str) -> str:
    """Return the code of a language that has texts: "en" for all others.

    Parameters
    ----------
    language
        A code such as "sv", or "system".
    """
    wanted = QLocale.system().name()[:2] if language == "system" else language
    return wanted if _catalogues(wanted) else "en"


def _catalogues(code: str) -> list[Path]:
    return sorted((resource_path("translations") / code).glob("*.qm"))


def load_language(application: QCoreApplication, language: str) -> None:
    """Set the window's language: "en", "sv" or "system"; texts already shown stay.

    A language is a folder in resources/translations; a language without one falls back to English.
    Qt's own texts (of its file dialogs) come with Qt.
    """
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.deleteLater()
    wanted = language_code(language)
    catalogues = _catalogues(wanted)
    QLocale.setDefault(QLocale(wanted))
    if catalogues:
        own = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))
        catalogues.append(own / f"qtbase_{wanted}.qm")
    for catalogue in catalogues:
        translator = QTranslator(application)
        translator.load(str(catalogue))
        application.installTranslator(translator)
