"""Sentences for the user that can be translated after their values are filled in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import PurePath
from typing import Any, TypeAlias, TypeVar

from insole_core.visible_text import visible, visible_value

_T = TypeVar("_T")
Translate: TypeAlias = Callable[[str], str]
"""Returns a message in another language; `str` leaves it in English."""
Value: TypeAlias = str | float | PurePath
"""Value of a placeholder; no objects that hold arrays or tracebacks, which it would keep alive."""


class Message(str):
    """An English sentence that keeps its template and values, so that it can be translated.

    It is an ordinary `str`: printed, compared and stored as the finished sentence. As in gettext
    and Qt, the English text with named placeholders is the key of its translation. Operations that
    make a new string of it (an f-string, ``+``, ``str.join``) lose template and values; combine
    messages with `joined`, or pass them as values of another message.

    Parameters
    ----------
    template
        The sentence, with placeholders as in `str.format`: ``"Known within {error_mm:.1f} mm."``
        Without values it is taken literally, and braces in it are only braces.
    values
        Of the placeholders. Strings among them, messages included, are translated as well. What
        is no message may come from anywhere, and is kept as it may be shown (`visible_value`).
    """

    template: str
    values: Mapping[str, Value]

    def __new__(cls, template: str, /, **values: Value) -> Message:
        """Fill the placeholders; a message without further values is returned as it is."""
        if isinstance(template, cls) and not values:
            return template
        template = visible(template)
        shown = {name: shown_value(value) for name, value in values.items()}
        message = super().__new__(cls, template.format(**shown) if values else template)
        message.template = str(template)
        message.values = shown
        return message

    def __str__(self) -> str:
        """Return the message itself, so that ``str(error)`` keeps template and values."""
        return self

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, Any]]:
        """Copy and pickle by template and values; `str` would fill the finished sentence again."""
        return (self.template,), dict(self.values)


def counted(count: int, one: str, several: str, /, **values: Value) -> Message:
    """Return what there is to say of a number of things.

    Parameters
    ----------
    one, several
        Templates for one thing, and for any other number, which is the `{count}` of the latter.
    """
    if count == 1:
        return Message(one, **values)
    return Message(several, count=count, **values)


def shown_value(value: _T) -> _T | str:
    """Return a value as it may stand in a sentence: a text or a path of anybody as `visible_value`.

    Whatever is harmless comes back as the same object.
    """
    if isinstance(value, Message) or not isinstance(value, str | PurePath):
        return value
    text = str(value)
    seen = visible_value(text)
    return value if seen == text else seen


def joined(parts: Iterable[str], between: str = ", ") -> Message:
    """Join messages into one, such as the items of a list or the sentences of a note.

    Parameters
    ----------
    between
        Separator; it is part of the template and must not hold braces.
    """
    values = {f"part_{number}": part for number, part in enumerate(parts)}
    return Message(between.join(f"{{{name}}}" for name in values), **values)
