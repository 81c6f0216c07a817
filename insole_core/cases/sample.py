"""The invented patient to try the program with: what marks it wherever it goes."""

from __future__ import annotations

from typing import Final

from insole_core.messages import Message

SAMPLE_PSEUDONYM: Final = "SAMPLE"
"""It stands on all that leaves for the shop; a record holds at most one of each pseudonym."""
SAMPLE_KEEPS_NAME: Final = Message(
    "The sample patient keeps its name and pseudonym, so that nobody takes it for a real patient."
)
