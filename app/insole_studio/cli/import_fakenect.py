"""``insole-studio import-fakenect``: turn recordings of libfreenect into a session."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.recording.session import View

NAME = "import-fakenect"
HELP = "make a session from recordings in libfreenect's folder format, one for each view"
_VIEW = re.compile(r"(?:([a-z0-9_]{1,32})=)?(.+)")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "recordings", nargs="+", metavar="[VIEW=]DIR",
        help="a folder with INDEX.txt; by default the views are named left, right, top",
    )  # fmt: skip
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="SESSION", help="folder or .zip"
    )
    parser.add_argument("--side", choices=["left", "right"], help="of the foot (left)")
    parser.add_argument(
        "--reference", type=Path, metavar="system.json", help="another reference system"
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the recordings and write the session."""
    from insole_core.calibration.markers.reference_file import load_reference_system
    from insole_core.geometry.side import Side
    from insole_core.recording.session import Manifest, Session
    from insole_core.recording.writer import check_session_target, write_session
    from insole_core.resources import resource_path
    from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM
    from insole_studio.acquisition.fakenect_recordings import read_view, recorded_at

    check_session_target(arguments.out)
    named = _named(arguments.recordings)
    if arguments.side is None:
        print("No side is given; the session says left (--side right changes it).", file=sys.stderr)
    progress.step(0.0, "Reading the recordings")
    system = load_reference_system(arguments.reference or resource_path(DEFAULT_SYSTEM))
    views: tuple[View, ...] = tuple(read_view(name, path, system) for name, path in named)
    manifest = Manifest(
        recorded_at(named[0][1]), Side(arguments.side or "left"), system, tuple(n for n, _ in named)
    )
    session = Session(manifest, views, str(named[0][1]))
    write_session(session, arguments.out, progress=progress.part(0.1, 1.0))
    progress.step(1.0, f"Done: {arguments.out}")


def _named(texts: list[str]) -> list[tuple[str, Path]]:
    """Return view and folder of each recording."""
    usual = iter(("left", "right", "top"))
    named: list[tuple[str, Path]] = []
    for text in texts:
        match = _VIEW.fullmatch(text)
        name = match[1] if match else None
        name = name or next(usual, None)
        if match is None or name is None or name in (given for given, _ in named):
            raise UsageError(f'"{text}" needs the name of its view, for example heel={text}.')
        named.append((name, Path(match[2])))
    return named
