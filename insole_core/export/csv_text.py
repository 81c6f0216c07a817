"""Tables for a spreadsheet: the one writer of CSV, whose cells are never formulas.

What stands in a cell may come from a file of anybody, and a spreadsheet runs ``=cmd|…``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

_FORMULA = re.compile(r"\s*[=+\-@＝＋－＠]|[\t\r\n]")
"""Beginning of what some spreadsheet takes for a formula, or for the end of the cell before."""
_NUMBER = re.compile(r"[+-]?\d+(\.\d+)?")
_SPLITS = '";\t\r\n'
"""Where spreadsheets of some country begin another cell, unless it is in quotes."""


def csv_text(rows: Iterable[Iterable[str]], delimiter: str = ",") -> str:
    """Return rows of cells as text, a line each; a formula in a cell becomes plain text.

    Parameters
    ----------
    delimiter
        Between two cells: a comma or a tab.
    """
    splits = delimiter + _SPLITS
    return "".join(delimiter.join(_cell(cell, splits) for cell in row) + "\n" for row in rows)


def _cell(text: str, splits: str) -> str:
    if _FORMULA.match(text) and not _NUMBER.fullmatch(text):
        text = f"'{text}"
    is_split = any(character in splits for character in text)
    return '"' + text.replace('"', '""') + '"' if is_split else text
