"""Which scans a file, a folder or a zip archive holds, and of which foot each is by its name."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from insole_core.errors import InputError
from insole_core.formats.file_formats import SCAN_SUFFIXES, check_scan_suffix, read_rank
from insole_core.formats.scan_content import ScanContent, archive_content, file_content
from insole_core.geometry.side import Side
from insole_core.messages import joined
from insole_core.regular_file import is_folder
from insole_core.zip_archive import ZipArchive

_MOST_FILES = 2000
_DEPTH = 2
_MANIFEST = "manifest.json"  # of a session
_WORD = re.compile(r"[A-Z]?[a-zäöüéÄÖ]+|[A-ZÄÖ]+(?![a-zäöü])")
_LEFT = {"left", "lf", "lt", "links", "linker", "linke", "vänster", "vanster", "gauche",
         "izquierdo", "izquierda", "izq", "sinistro", "sinistra", "sx", "leftfoot"}  # fmt: skip
_RIGHT = {"right", "rf", "rt", "rechts", "rechter", "rechte", "höger", "hoger", "droit",
          "droite", "derecho", "derecha", "destro", "destra", "dx", "rightfoot"}  # fmt: skip


@dataclass(frozen=True)
class ScanPart:
    """One scan of a file, a folder or an archive.

    Parameters
    ----------
    place
        The file, the folder or the archive.
    name
        Of the scan in it, with forward slashes; empty for the file itself.
    side
        By its name, or by that of its folder where there are two, one of either side; None where
        they say neither or both.
    """

    place: Path
    name: str
    side: Side | None

    @property
    def path(self) -> Path:
        """The file of the scan; inside of an archive there is none by this path."""
        return self.place / self.name if self.name else self.place


def scan_parts(path: Path) -> tuple[ScanPart, ...]:
    """Return the scan of a file, or the one or two of a folder or zip archive.

    Where the same foot is there in several formats, one of them is taken.

    Raises
    ------
    InputError
        When it holds none, or more than two that its names do not tell apart.
    """
    if is_folder(path):
        return _chosen(path, _names_in_folder(path))
    if path.suffix.lower() == ".zip":
        return _chosen(path, _scans_among(ZipArchive(str(path), path).names))
    check_scan_suffix(path)
    if not path.exists():
        raise InputError("{path} does not exist; check the name of the file.", path=path)
    return (ScanPart(path, "", side_of_name(path.stem)),)


def part_content(part: ScanPart) -> ScanContent:
    """Read the bytes of a scan.

    Raises
    ------
    InputError
        When they cannot be read.
    """
    if part.name and not is_folder(part.place):
        return archive_content(part.place, ZipArchive(str(part.place), part.place), part.name)
    return file_content(part.path)


def side_of_name(name: str) -> Side | None:
    """Return the foot that a name tells, such as ``Left foot 2`` or ``scan_R``; None otherwise.

    A single letter counts as the last word only: elsewhere it may be an initial of the patient.
    """
    named = _sides_of_name(name)
    return next(iter(named)) if len(named) == 1 else None


def _sides_of_name(name: str) -> set[Side]:
    words = [word.lower() for word in _WORD.findall(name)]
    last = words[-1] if words else ""
    is_left = last == "l" or not _LEFT.isdisjoint(words)
    is_right = last == "r" or not _RIGHT.isdisjoint(words)
    return {side for side, is_named in zip(Side, (is_left, is_right), strict=True) if is_named}


def _names_in_folder(path: Path) -> list[str]:
    names: list[str] = []
    try:
        for depth in range(1, _DEPTH + 1):
            for found in path.glob("/".join(["*"] * depth)):
                names.append(found.relative_to(path).as_posix())
                if len(names) > _MOST_FILES:
                    raise InputError(
                        "{path} holds more than {count} files; choose the folder of one visit.",
                        path=path,
                        count=_MOST_FILES,
                    )
    except OSError as error:
        raise InputError(
            "{path} cannot be read: {reason}; check the name of the folder.",
            path=path,
            reason=str(error.strerror),
        ) from error
    return [name for name in _scans_among(names) if (path / name).is_file()]


def _scans_among(names: list[str]) -> list[str]:
    return sorted(
        name
        for name in names
        if PurePosixPath(name).suffix.lower() in SCAN_SUFFIXES
        and not PurePosixPath(name).name.startswith("._")
        and "__MACOSX" not in PurePosixPath(name).parts
    )


def _chosen(path: Path, names: list[str]) -> tuple[ScanPart, ...]:
    names = _one_format_each(names)
    by_folder = _sides_of_folders(names)
    parts = [ScanPart(path, name, _side_of(name, by_folder)) for name in names]
    if not parts:
        raise InputError(
            "{path} holds no scan; hand in a file of one of the formats {suffixes}, or a folder or "
            "zip archive with the scans of one person.",
            path=path,
            suffixes=joined(SCAN_SUFFIXES),
        )
    if len(parts) > 2:
        raise InputError(
            "{path} holds {count} scans ({names} …), and one foot or both are expected; open the "
            "one that is meant.",
            path=path,
            count=len(parts),
            names=joined([part.name for part in parts[:3]]),
        )
    if len(parts) == 2 and parts[0].side == parts[1].side and parts[0].side is not None:
        raise InputError(
            "{path} holds two scans of the {side} foot by their names ({first}, {second}); open "
            "the one that is meant.",
            path=path,
            side=parts[0].side,
            first=parts[0].name,
            second=parts[1].name,
        )
    return tuple(sorted(parts, key=lambda part: (part.side is Side.RIGHT, part.name)))


def _side_of(name: str, by_folder: dict[str, Side]) -> Side | None:
    """Return the foot that a scan's own name tells; if that is silent, its folder's."""
    stem = PurePosixPath(name).stem
    return side_of_name(stem) if _sides_of_name(stem) else by_folder.get(name)


def _sides_of_folders(names: list[str]) -> dict[str, Side]:
    """Return the foot of each of two scans whose folders are a left and a right one.

    A single folder may be named after a patient or a shoe, and tells nothing of the foot in it.
    """
    sides = {name: side_of_name(PurePosixPath(name).parent.name) for name in names}
    known = {name: side for name, side in sides.items() if side is not None}
    return known if len(names) == 2 and set(known.values()) == set(Side) else {}


def _one_format_each(names: list[str]) -> list[str]:
    best: dict[str, str] = {}
    for name in names:
        stem = str(PurePosixPath(name).with_suffix(""))
        rank = read_rank(PurePosixPath(name))
        if stem not in best or rank < read_rank(PurePosixPath(best[stem])):
            best[stem] = name
    return list(best.values())


def holds_scans(path: Path) -> bool:
    """Return whether a folder or zip archive holds scans of other programs, and no session."""
    try:
        if is_folder(path):
            names = _names_in_folder(path)
            return bool(names) and not (path / _MANIFEST).is_file()
        if path.suffix.lower() != ".zip" or not path.is_file():
            return False
        inside = ZipArchive(str(path), path).names
    except InputError:
        return False  # whoever opens it says what is wrong
    has_manifest = any(PurePosixPath(name).name == _MANIFEST for name in inside)
    return bool(_scans_among(inside)) and not has_manifest
