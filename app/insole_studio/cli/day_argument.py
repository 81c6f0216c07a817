"""An argument that is a day."""

from __future__ import annotations

import argparse
from datetime import date

from insole_core.cases.written_dates import read_date
from insole_core.errors import InputError


def day(text: str) -> date:
    """Convert an argument to a day."""
    try:
        return date.today() if text == "today" else read_date(text, None)
    except InputError as error:
        raise argparse.ArgumentTypeError(
            f"{text} is no day; write it as 2026-11-20, or today"
        ) from error
