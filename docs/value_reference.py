"""The directive ``values`` of the manual: every value of a prescription, as it is declared."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import MISSING, fields
from typing import TYPE_CHECKING, Any, NamedTuple

from docutils import nodes
from docutils.parsers.rst import Directive

from insole_core.insole.elements import in_order
from insole_core.insole.elements.words import worded
from insole_core.insole.fields import (
    Choice,
    Declared,
    Number,
    Pair,
    Place,
    Range,
    Spot,
    declared,
    types_of,
)
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.messages import Message, Translate, joined
from insole_studio.texts import translation_into, with_capital

if TYPE_CHECKING:
    from sphinx.application import Sphinx

PARTS: tuple[tuple[str, type[Any]], ...] = (
    ("Insole", InsoleDesign),
    ("Outline", Outline),
    ("Layers", Layers),
    ("Device", Finish),
    ("Rim", RimStation),
    ("Shell", Shell),
    ("Post", Post),
)
"""The parts of a prescription beside its corrections, with their names."""
WIDTHS = (22, 24, 14, 60, 18)
NONE = "–"


class Row(NamedTuple):
    """What is said of one value: its name, range, default, effect, and key in a file."""

    label: str
    range: str
    usual: str
    tip: str
    key: str


class ValueReference(Directive):
    """A section with a table for every correction, then for every other part.

    Its content are the headings of the columns, a line each.
    """

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the sections, in the language of the site."""
        say = translation_into(self.state.document.settings.env.config.language)
        return [
            _section(title, tip, _table(self.content, rows_of(kind, say)), say)
            for title, tip, kind in each_part()
        ]


def each_part() -> Iterator[tuple[str, str, type[Any]]]:
    """Yield name, effect and class of all parts of a prescription that have values."""
    yield from ((kind.name, kind.tip, kind) for kind in in_order())
    yield from ((title, "", kind) for title, kind in PARTS)


def rows_of(kind: type[Any], say: Translate) -> Iterator[Row]:
    """Yield what a part declares of its values, translated."""
    defaults = {one.name: one.default for one in fields(kind)}
    for key, found in declared(kind).items():
        usual = _usual(found, defaults[key], kind, say)
        each = (
            found.each
            if isinstance(found, Pair | Spot)
            else ((found.label, found.tip or found.effect),)
        )
        for label, tip in each:
            yield Row(say(label), _allowed(found, types_of(kind)[key], say), usual, say(tip), key)


def _usual(found: Declared, value: Any, kind: type[Any], say: Translate) -> str:
    if value is MISSING or value is None or isinstance(value, tuple):
        return NONE
    return with_capital(say(worded(found, value)))


def _allowed(found: Declared, held: Any, say: Translate) -> str:
    """Return what a value may be."""
    if isinstance(found, Choice):
        return say(joined(Message(word) for word in found.words.values()))
    allowed = found.range
    if allowed is None or held not in (float, int, Place):
        return NONE
    if isinstance(found, Number):
        least, greatest = (found.factor * end for end in (allowed.least, allowed.greatest))
        allowed = Range(least, greatest, "%" if found.shown_unit == "%" else found.unit)
    return say(str(allowed))


def _section(title: str, tip: str, table: nodes.table, say: Translate) -> nodes.section:
    name = say(title)
    section = nodes.section(
        "",
        nodes.title(text=name),
        ids=[nodes.make_id(f"values-{title}")],
        names=[nodes.fully_normalize_name(f"values {title}")],
    )
    if tip:
        section += nodes.paragraph(text=f"{say(tip)}.")
    section += table
    return section


def _table(headings: Iterable[str], rows: Iterable[Row]) -> nodes.table:
    group = nodes.tgroup("", *(nodes.colspec(colwidth=width) for width in WIDTHS), cols=len(WIDTHS))
    group += nodes.thead("", _row(headings))
    group += nodes.tbody("", *(_row(row) for row in rows))
    return nodes.table("", group)


def _row(cells: Iterable[str]) -> nodes.row:
    return nodes.row("", *(nodes.entry("", nodes.paragraph(text=cell)) for cell in cells))


def setup(app: Sphinx) -> dict[str, bool]:
    """Make the directive known."""
    app.add_directive("values", ValueReference)
    return {"parallel_read_safe": True}
