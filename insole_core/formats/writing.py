"""Writing of solids in the format that the suffix of the file name selects."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from insole_core.formats.file_formats import check_solid_suffix, mesh_format
from insole_core.formats.solid_content import SolidContent, SolidPart


def write_solids(
    parts: Sequence[SolidPart],
    path: Path,
    *,
    as_text: bool = False,
    label: str = "",
    note: str = "",
) -> None:
    """Write parts in the format that the suffix of `path` selects.

    Formats that carry bodies keep the parts separate; in others they are shells of one mesh.

    Parameters
    ----------
    parts : mm
        In a common frame.
    as_text
        Whether STL is written in text.
    label, note
        As for `SolidContent`.

    Raises
    ------
    UsageError
        When the format is not known.
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    check_solid_suffix(path)
    content = SolidContent(parts, label, note)
    mesh_format(path.suffix.lower()).write(content, path, as_text=as_text)
