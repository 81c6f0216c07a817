"""Reading and writing of marker_edits.json, the manual corrections of a session."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from insole_core.files.atomic import write_text
from insole_core.files.write_errors import output_errors
from insole_core.geometry.side import BOTH, Side
from insole_core.json_object import JsonObject
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import (
    NO_EDITS,
    HandEdits,
    NamedSpot,
    Region,
    ViewEdits,
)
from insole_core.recording.manifest_json import box_json, parse_box
from insole_core.recording.session import Manifest
from insole_core.recording.store import ZipStore

FORMAT = "insole-marker-edits"
VERSION = 1
NAME = "marker_edits.json"
_MOST_PX = 1e5
_MOST_CORNERS = 10_000


def edits_path(session: Path) -> Path:
    """Return the path of the corrections: in the session's folder, or beside its archive."""
    if session.suffix.lower() == ".zip":
        return session.with_name(f"{session.stem}.{NAME}")
    return session / NAME


def write_edits(edits: HandEdits, session: Path) -> None:
    """Write the corrections of a session.

    Without corrections the file is removed. Beside an archive with corrections inside, a file
    without entries is written instead, since it overrides those.

    Parameters
    ----------
    session
        Folder or zip archive.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    path = edits_path(session)
    if edits == NO_EDITS and not _is_archive_with_edits(session):
        with output_errors(path):
            path.unlink(missing_ok=True)
        return
    write_text(json.dumps(edits_json(edits), indent=1) + "\n", path)


def edits_json(edits: HandEdits) -> dict[str, Any]:
    """Return the JSON form of corrections."""
    values: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "views": {name: _view_json(view) for name, view in edits.views.items()},
    }
    if (box := edits.volume_of_interest) is not None:
        values["volume_of_interest_mm"] = box_json(box)
    if edits.side is not None:
        values["side"] = edits.side.value
    if edits.volumes:
        values["feet"] = {
            side.value: {"volume_of_interest_mm": box_json(box)}
            for side, box in edits.volumes.items()
        }
    return values


def parse_edits(file: str, text: bytes, manifest: Manifest) -> HandEdits:
    """Read corrections.

    Parameters
    ----------
    file
        Name of the file, for messages.
    manifest
        Of the session; the corrections may name only its views and markers.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    root = JsonObject.parse(file, text)
    root.check_format(FORMAT, VERSION)
    views = root.object("views")
    unknown = [name for name in views.values if name not in manifest.views]
    if unknown:
        raise views.fail(unknown[0], "is no view of this session")
    one_foot = manifest.side != BOTH
    return HandEdits(
        {name: _view(views.object(name), manifest) for name in views.values},
        parse_box(root) if one_foot and root.has("volume_of_interest_mm") else None,
        {} if one_foot or not root.has("feet") else _volumes(root.object("feet")),
        root.choice("side", list(Side)) if one_foot and root.has("side") else None,
    )


def _volumes(feet: JsonObject) -> dict[Side, Box]:
    return {side: parse_box(feet.object(side.value)) for side in Side if feet.has(side.value)}


def _is_archive_with_edits(session: Path) -> bool:
    return session.is_file() and NAME in ZipStore(session).names()


def _view_json(view: ViewEdits) -> dict[str, Any]:
    return {
        "off": view.off,
        "excluded": list(view.excluded),
        "named": [
            {"id": spot.id, "pixel": list(spot.pixel), "exact": spot.exact} for spot in view.named
        ],
        "ignored": [[list(corner) for corner in region] for region in view.ignored],
        "searched": None if view.searched is None else [list(corner) for corner in view.searched],
    }


def _view(root: JsonObject, manifest: Manifest) -> ViewEdits:
    known = [marker.id for marker in manifest.reference_system.markers]
    excluded = root.items("excluded")
    for marker in excluded:
        if marker not in known:
            raise root.fail(
                "excluded", "names {marker!r}, which no marker of this session is", marker=marker
            )
    named = tuple(
        NamedSpot(spot.choice("id", known), spot.pair("pixel", _MOST_PX), spot.flag("exact"))
        for spot in root.objects("named")
    )
    if len({spot.id for spot in named}) < len(named):
        raise root.fail("named", "names a marker twice")
    ignored = root.listed("ignored")
    return ViewEdits(
        excluded=tuple(excluded),
        named=named,
        ignored=tuple(_region(ignored, number) for number in ignored.values),
        searched=None if root.value("searched") is None else _region(root, "searched"),
        off=root.flag("off"),
    )


def _region(root: JsonObject, key: str) -> Region:
    corners = root.listed(key)
    if len(corners.values) < 3:
        raise root.fail(key, "must be a list of three corners or more")
    if len(corners.values) > _MOST_CORNERS:
        raise root.fail(key, "has more than {most} corners", most=_MOST_CORNERS)
    return tuple(corners.pair(number, _MOST_PX) for number in corners.values)
