"""The languages that the program speaks, by their codes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal

Language = Literal["system", "en", "sv"]
"""What can be chosen."""
LANGUAGES: Final[Mapping[Language, str]] = {"en": "English", "sv": "Svenska"}
"""As each calls itself."""
