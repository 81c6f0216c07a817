"""The language of what a command writes for people."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from insole_studio.languages import LANGUAGES

if TYPE_CHECKING:
    from insole_core.workflows.records.person_summary import Wording


def add_language(parser: argparse.ArgumentParser) -> None:
    """Add the option that chooses a language."""
    parser.add_argument(
        "--language",
        choices=list(LANGUAGES),
        help="of what is written (default: that of the window)",
    )


def wording_of(arguments: argparse.Namespace) -> Wording:
    """Return the language that was chosen, else that of the window."""
    from insole_core.workflows.records.person_summary import Wording
    from insole_studio.settings import load_settings
    from insole_studio.texts import language_code, translation_into
    from insole_studio.user_paths import UserPaths

    language = arguments.language or load_settings(UserPaths.of_user().settings_file).language
    return Wording(language_code(language), translation_into(language))
