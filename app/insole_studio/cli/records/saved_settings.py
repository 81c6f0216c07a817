"""What belongs to a backup besides the record."""

from __future__ import annotations

from pathlib import Path

from insole_studio.user_paths import UserPaths


def saved_settings() -> dict[str, Path]:
    """Return the folders of the program's settings and calibrated sensors, by name."""
    return UserPaths.of_user().backed_up_folders
