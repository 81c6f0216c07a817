"""What the window remembers between two starts; a bad entry costs a warning, never the start."""

from __future__ import annotations

import json
import logging
import sys
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

from insole_core.export.atomic import replacing_file
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS

log = logging.getLogger(__name__)

RECENT_COUNT = 8

Theme = Literal["system", "light", "dark"]
Language = Literal["system", "en", "sv"]


@dataclass
class Settings:
    """All settings of the window, with their defaults.

    `window_geometry` and `window_docks` are Qt's own packed states in base64; `capture_views` says
    which sensor gives which view (``left=SERIAL``). A view whose pose is worse than the largest
    residuals and displacement is refused.
    """

    theme: Theme = "system"
    linked_views: bool = True
    language: Language = "system"
    touch: bool = False
    tour_seen: bool = False
    author: str = ""
    recent: list[str] = field(default_factory=list)
    window_geometry: str = ""
    window_docks: str = ""
    capture_views: list[str] = field(default_factory=list)
    largest_residual_mm: float = DEFAULT_LIMITS.residual_mm
    largest_reprojection_px: float = DEFAULT_LIMITS.reprojection_px
    largest_displacement_mm: float = DEFAULT_LIMITS.displacement_mm

    def remember(self, path: Path) -> None:
        """Put `path` at the head of the recent files."""
        others = [name for name in self.recent if name != str(path)]
        self.recent = [str(path), *others][:RECENT_COUNT]


def load_settings(path: Path) -> Settings:
    """Read the settings, keeping the default of everything that is absent or not understood."""
    return Settings(**understood(read_remembered(path), Settings, path))


def save_settings(settings: Settings, path: Path) -> None:
    """Write the settings.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing_file(path) as beside:
        beside.write_text(json.dumps(asdict(settings), indent=1), encoding="utf-8")


def read_remembered(path: Path) -> dict[str, Any]:
    """Read the entries of a file that the window wrote; one that is damaged has none."""
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, RecursionError) as error:
        log.warning("%s cannot be read, defaults are used: %s", path, error)
        return {}
    if isinstance(stored, dict):
        return stored
    log.warning("%s holds no JSON object {…}, defaults are used", path)
    return {}


def understood(stored: dict[str, Any], kind: type[Any], path: Path) -> dict[str, Any]:
    """Keep the entries that are fields of a dataclass and of their type; warn of a wrong type.

    Parameters
    ----------
    stored
        The entries of a file.
    kind
        Its fields may be texts, numbers, flags, literals, lists of these, or None.
    path
        Of the file, for the warning.
    """
    hints = get_type_hints(kind)
    known = {key: value for key, value in stored.items() if key in hints}
    for key in [key for key, value in known.items() if not _fits(value, hints[key])]:
        log.warning("%s: %s is not understood: %r", path, key, known.pop(key))
    return known


def _fits(value: Any, kind: Any) -> bool:
    of = get_args(kind)
    if get_origin(kind) is Literal:
        return value in of
    if get_origin(kind) is list:
        return isinstance(value, list) and all(_fits(one, of[0]) for one in value)
    if of:
        return any(_fits(value, one) for one in of)
    if kind is float:
        return type(value) in (int, float) and abs(value) <= sys.float_info.max
    return type(value) is kind  # isinstance would take true for a whole number
