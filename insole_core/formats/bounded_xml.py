"""XML of unknown origin: walked through once, and never unfolded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final
from xml.parsers import expat

from insole_core.errors import InputError
from insole_core.formats.scan_content import ScanContent

SEPARATOR: Final = "\n"
"""Between the namespace and the name of an attribute that has one."""


def walk_xml(
    content: bytes,
    source: ScanContent,
    start: Callable[[str, dict[str, str]], None],
    end: Callable[[str], None] | None = None,
    text: Callable[[str], None] | None = None,
) -> None:
    """Tell of every element of a document, by its name without namespace.

    Parameters
    ----------
    source
        What the document is of, for messages.
    start
        Takes the name of an element and its attributes.
    end
        Takes the name of an element that ends.
    text
        Takes a part of the text between two tags; long ones come in several parts.

    Raises
    ------
    InputError
        When it declares a type or entities, which could unfold without end; no scan has any.
    expat.ExpatError
        When it is no XML, or cut off.
    """
    parser = expat.ParserCreate(namespace_separator=SEPARATOR)
    parser.buffer_text = True

    def refuse(*_: object) -> None:
        raise InputError(
            "{path} declares entities or a type of its document, which no scan does; do not use "
            "it.",
            path=source.path,
        )

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = lambda name, attributes: start(_local(name), attributes)
    if end is not None:
        parser.EndElementHandler = lambda name: end(_local(name))
    if text is not None:
        parser.CharacterDataHandler = text
    parser.Parse(content, True)


def _local(name: str) -> str:
    return name.rpartition(SEPARATOR)[2]
