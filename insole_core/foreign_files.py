"""What a file is that is handed in for something else, by its first bytes or by its name's end."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from insole_core.errors import InputError
from insole_core.messages import Message

HEAD_BYTES: Final = 4096
_LFS_POINTER = b"version https://git-lfs.github.com/spec/"
_KINDS: Final = (
    (rb"\s*<(!doctype html|html)", Message("a web page, as it is saved when a download fails")),
    (rb"%PDF", Message("a PDF")),
    (rb"\x89PNG|\xff\xd8\xff", Message("a picture")),
    (rb"\x1f\x8b|7z\xbc\xaf\x27\x1c|Rar!", Message("a packed archive; unpack it first")),
    (rb"ISO-10303-21", Message("a STEP model of a CAD program")),
    (rb"3D Geometry File Format", Message("a model of Rhino")),
    (rb"# \.PCD", Message("a point cloud of PCL (PCD)")),
)
_CLOUD = Message("a point cloud; save it as .ply")
_CAD = Message("a model of a CAD program; export its mesh as .stl or .ply")
_SCENE = Message("a scene of a graphics program; export the foot as .glb or .obj")
_TABLE = Message("a table or a text; points of a scan are read as .xyz, a pressure map by Tools")
_ENDINGS: Final = {
    ".pcd": Message("a point cloud of PCL; save it as .ply"),
    ".3dm": Message("a model of Rhino; export its mesh as .stl or .ply"),
    **dict.fromkeys((".e57", ".las", ".laz"), _CLOUD),
    **dict.fromkeys((".step", ".stp", ".igs", ".iges"), _CAD),
    **dict.fromkeys((".blend", ".ztl", ".fbx", ".usdz", ".wrl"), _SCENE),
    **dict.fromkeys((".csv", ".tsv", ".txt", ".lst", ".asf"), _TABLE),
    ".mtl": Message("the list of materials beside an .obj; open that"),
    ".dcm": Message("a slice of a tomography; export the surface of the skin as .stl"),
}
_PRESSURE_DEVICES: Final = {
    "pliance": (b"mat type", b"time[secs]"),
    "StappOne": (b"sole_id", b"pressure_01"),
    "pedar": (b"mask definition", b"sensor type"),
}
"""What stands in the heads of their exports."""
UNREAD_DEVICES: Final = frozenset({"pliance", "StappOne"})


def check_no_pointer(path: Path, head: bytes) -> None:
    """Refuse what Git has in place of a large file.

    Raises
    ------
    InputError
    """
    if head.startswith(_LFS_POINTER):
        raise InputError(
            "{path} is a pointer of Git LFS, three lines that stand for the file; fetch the file "
            "itself (git lfs pull), and open that.",
            path=path,
        )


def check_no_other_kind(path: Path, head: bytes) -> None:
    """Refuse a file that holds something else than any scan or map by its first bytes.

    Raises
    ------
    InputError
    """
    check_no_pointer(path, head)
    for pattern, kind in _KINDS:
        if re.match(pattern, head, re.IGNORECASE):
            raise InputError(
                "{path} holds something else than its name says: {kind}. Choose another file.",
                path=path,
                kind=kind,
            )


def kind_by_ending(path: Path) -> Message | None:
    """Return what a file is by the end of its name, and what to do; None where that says nothing.

    Only of files that are no scans.
    """
    return _ENDINGS.get(path.suffix.lower())


def pressure_device(head: bytes) -> str | None:
    """Return the device whose export of pressures this is; None for anything else."""
    return next(
        (name for name, words in _PRESSURE_DEVICES.items() if all(word in head for word in words)),
        None,
    )
