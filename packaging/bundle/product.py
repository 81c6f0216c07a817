"""Names that every bundle uses, whatever the system."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
"""The checkout."""
PACKAGING = ROOT / "packaging"
DIST = ROOT / "dist"
BUILD = ROOT / "build"

NAME = "Insole Studio"
COMMAND = "insole-studio"
"""Name of the command, the package, the folder and the file of the menu entry."""
WINDOW_COMMAND = "Insole Studio"
"""On Windows the window has a program of its own, since that of the command opens a console."""
IDENTIFIER = "org.insole-studio.InsoleStudio"
CASE_SUFFIX = ".insole"
CASE_MIME_TYPE = "application/x-insole-studio-case"
SUMMARY = "Custom insoles from scans of the foot"
UDEV_RULES = tuple(sorted((ROOT / "resources" / "sensors").glob("70-*.rules")))
FROZEN = DIST / COMMAND
"""The folder with the program and everything it needs."""
