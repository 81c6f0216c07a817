"""Sentences for the user that can still be translated after their values are filled in."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import PurePath
from typing import Any, TypeAlias

Value: TypeAlias = str | float | PurePath
"""What fills a hole; whatever holds arrays or a traceback would be kept alive by the message."""


class Message(str):
    """An English sentence that remembers how it was made, so that it can be said in others.

    It is a `str` like any other: printed, compared and stored as the finished sentence. As in
    gettext and Qt the English text with named holes is the key of its translation. Whatever makes
    a new string of it (an f-string, ``+``, ``str.join``) loses template and values; put messages
    together by `joined`, or as values of another message.

    Parameters
    ----------
    template
        The sentence, with holes as in `str.format`: ``"Known within {error_mm:.1f} mm."`` Without
        values it is taken as it stands, and braces in it are only braces.
    values
        What fills the holes. Those that are text, messages among them, are translated as well.
    """

    template: str
    values: Mapping[str, Value]

    def __new__(cls, template: str, /, **values: Value) -> Message:
        """Fill the holes; a message without further values stays what it is, as in `str`."""
        if isinstance(template, cls) and not values:
            return template
        message = super().__new__(cls, template.format(**values) if values else template)
        message.template = str(template)
        message.values = values
        return message

    def __str__(self) -> str:
        """Stay a message, so that ``str(error)`` does as well."""
        return self

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, Any]]:
        """Copy and pickle by template and values: `str` would fill the finished sentence again."""
        return (self.template,), dict(self.values)


def joined(parts: Iterable[str], between: str = ", ") -> Message:
    """Put messages side by side, such as the words of a list or the sentences of a note."""
    values = {f"part_{number}": part for number, part in enumerate(parts)}
    return Message(between.join(f"{{{name}}}" for name in values), **values)
