"""Rows for a terminal or for other programs."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence

Row = Mapping[str, str]


def print_rows(rows: Sequence[Row], *, as_json: bool) -> None:
    """Print rows with their headings, cells apart by tabs, or as JSON."""
    from insole_core.export.csv_text import csv_text

    if as_json:
        json.dump(rows, sys.stdout, indent=1, ensure_ascii=False)
        print()
        return
    lines = [tuple(rows[0]), *(tuple(row.values()) for row in rows)] if rows else []
    print(csv_text(lines, delimiter="\t"), end="")
