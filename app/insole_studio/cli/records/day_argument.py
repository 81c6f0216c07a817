"""An argument that is a day."""

from __future__ import annotations

import argparse
from datetime import date


def day(text: str) -> date:
    """Convert an argument to a day."""
    try:
        return date.today() if text == "today" else date.fromisoformat(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text} is no day; write it as 2026-11-20, or today"
        ) from None
