"""The formats: what each is called, how it is read and written, what it can carry, its role.

This is the only list of them. Commands, dialogs, orders and a person's export ask it, so a new one
is a module beside this one and an entry below. Readers and writers are named here and imported when
they are used: the window and every command load this table as they start.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias

from insole_core.errors import InputError, UsageError
from insole_core.foreign_files import kind_by_ending
from insole_core.messages import joined

if TYPE_CHECKING:
    from insole_core.formats.raw_surface import RawSurface
    from insole_core.formats.scan_content import ScanContent
    from insole_core.formats.solid_content import SolidContent

FileRole: TypeAlias = Literal["solid", "gcode", "job_sheet", "checks", "other"]
"""Of a file in an order."""
Carried: TypeAlias = Literal["unit", "colour", "bodies", "print settings"]
"""What a written file can hold beside its surface."""


@dataclass(frozen=True, kw_only=True)
class FileFormat:
    """A kind of file that an order may hold.

    Parameters
    ----------
    name
        By which users know it.
    endings
        Of the names of its files, in small letters; the first one is written.
    role
        In an order.
    names_nobody
        Whether its files hold nothing of the patient, so that they are in a pseudonymous export
        (decision 0066).
    """

    name: str
    endings: tuple[str, ...]
    role: FileRole
    names_nobody: bool = False

    @property
    def ending(self) -> str:
        """How the names of its written files end."""
        return self.endings[0]

    @property
    def patterns(self) -> str:
        """Its files, as the filter of a dialog names them."""
        return patterns(self.endings)


@dataclass(frozen=True, kw_only=True)
class MeshFormat(FileFormat):
    """A format of surfaces.

    Parameters
    ----------
    reader, writer, text_writer
        Module of this folder and function: ``stl.read_stl``. Empty for none; a text writer is the
        form for machines that read no other.
    begins_with
        First bytes that only files of this format have.
    is_archive
        Whether it is a zip archive, or may be one.
    carries
        When it is written.
    rank
        Of files with one scan in several formats, that of the least rank is read: the one that
        says most of the surface, in the best known way.
    """

    role: FileRole = "other"
    reader: str = ""
    writer: str = ""
    text_writer: str = ""
    begins_with: tuple[bytes, ...] = ()
    is_archive: bool = False
    carries: frozenset[Carried] = frozenset()
    rank: int = 100

    def read(self, source: ScanContent) -> RawSurface:
        """Read what a file holds.

        Raises
        ------
        InputError, ValueError, LookupError, TypeError
            When it is damaged; `read_raw` makes one sentence of it.
        """
        surface: RawSurface = _function(self.reader)(source)
        return surface

    def write(self, solid: SolidContent, path: Path, *, as_text: bool = False) -> None:
        """Write a file, atomically.

        Parameters
        ----------
        as_text
            In the form for machines that read no other, where there is one.

        Raises
        ------
        OutputError
            When the place cannot be written; a file that was there before is untouched.
        """
        _function(self.text_writer if as_text and self.text_writer else self.writer)(solid, path)


def _function(name: str) -> Callable[..., Any]:
    module, _, function = name.partition(".")
    found: Callable[..., Any] = getattr(import_module(f"insole_core.formats.{module}"), function)
    return found


MESH_FORMATS: Final = (
    MeshFormat(
        name="STL", endings=(".stl",), role="solid", names_nobody=True, rank=2,
        begins_with=(b"solid ",),
        reader="stl.read_stl", writer="stl.write_parts", text_writer="stl.write_parts_as_text",
    ),
    MeshFormat(
        name="3MF", endings=(".3mf",), role="solid", names_nobody=True, rank=6, is_archive=True,
        reader="three_mf.read_three_mf", writer="three_mf.write_parts",
        carries=frozenset({"unit", "colour", "bodies", "print settings"}),
    ),
    MeshFormat(
        name="PLY", endings=(".ply",), role="solid", names_nobody=True, rank=1,
        begins_with=(b"ply\n", b"ply\r\n"),
        reader="ply.read_ply", writer="ply.write_parts", carries=frozenset({"colour"}),
    ),
    MeshFormat(
        name="OBJ", endings=(".obj",), role="solid", names_nobody=True, rank=5,
        reader="obj.read_obj", writer="obj.write_parts", carries=frozenset({"colour"}),
    ),
    MeshFormat(
        name="AMF", endings=(".amf",), role="solid", names_nobody=True, rank=8, is_archive=True,
        reader="amf.read_amf", writer="amf.write_parts",
        carries=frozenset({"unit", "colour", "bodies"}),
    ),
    MeshFormat(
        name="GLB", endings=(".glb", ".gltf"), rank=3, begins_with=(b"glTF",),
        reader="gltf.read_gltf",
    ),
    MeshFormat(
        name="USDZ", endings=(".usdz",), rank=10, is_archive=True, reader="usd.read_usdz"
    ),
    MeshFormat(name="COLLADA", endings=(".dae",), rank=4, reader="dae.read_dae"),
    MeshFormat(
        name="OFF", endings=(".off",), role="solid", names_nobody=True, rank=7,
        begins_with=(b"OFF\n",), reader="off.read_off", writer="off.write_parts",
    ),
    MeshFormat(
        name="XYZ", endings=(".xyz", ".asc", ".pts"), rank=9, reader="point_text.read_point_text"
    ),
)  # fmt: skip

PROGRAM: Final = FileFormat(
    name="G-code", endings=(".nc", ".ngc", ".gcode", ".tap", ".cnc"), role="gcode"
)  # programs of other makers tell the path of the drawing, so they may name somebody
OUTLINES: Final = FileFormat(name="DXF", endings=(".dxf",), role="other", names_nobody=True)
JOB_SHEET: Final = FileFormat(
    name="PDF", endings=("-job-sheet.pdf",), role="job_sheet", names_nobody=True
)
SETUP_SHEET: Final = FileFormat(
    name="PDF", endings=("-setup-sheet.pdf",), role="other", names_nobody=True
)
NEST_SHEET: Final = FileFormat(
    name="PDF", endings=("-pieces.pdf",), role="other", names_nobody=True
)
PIN_HOLES: Final = FileFormat(
    name="G-code", endings=("-pin-holes.nc",), role="other", names_nobody=True
)
"""Of the spoil board, from which no insole is made."""
CHECKS: Final = FileFormat(name="JSON", endings=("-checks.json",), role="checks", names_nobody=True)

_FORMATS: Final[tuple[FileFormat, ...]] = (
    *MESH_FORMATS, PIN_HOLES, PROGRAM, OUTLINES, JOB_SHEET, SETUP_SHEET, NEST_SHEET, CHECKS
)  # fmt: skip
_BY_SUFFIX: Final = {end: form for form in MESH_FORMATS for end in form.endings}
SCAN_SUFFIXES: Final = tuple(end for form in MESH_FORMATS if form.reader for end in form.endings)
"""Of all scans that are read."""
SOLID_FORMATS: Final = tuple(form for form in MESH_FORMATS if form.writer)
"""In which insoles are written."""
SOLID_SUFFIXES: Final = tuple(form.ending for form in SOLID_FORMATS)


def format_of(name: str) -> FileFormat | None:
    """Return the format of a file by the ending of its name; None for any other file."""
    small = name.lower()
    return next((form for form in _FORMATS if small.endswith(form.endings)), None)


def mesh_format(suffix: str) -> MeshFormat:
    """Return the format of surfaces with a suffix, in small letters.

    Raises
    ------
    LookupError
        When there is none.
    """
    return _BY_SUFFIX[suffix]


def role_of(name: str) -> FileRole:
    """Return the role of a file in an order, by its name."""
    form = format_of(name)
    return "other" if form is None else form.role


def names_nobody(name: str) -> bool:
    """Return whether a file of an order is of a kind that holds nothing of the patient."""
    form = format_of(name)
    return form is not None and form.names_nobody


def can_carry(suffix: str, what: Carried) -> bool:
    """Return whether a file with a suffix can hold something beside its surface."""
    return any(form.ending == suffix.lower() for form in carriers(what))


def carriers(what: Carried) -> tuple[MeshFormat, ...]:
    """Return the formats in which insoles are written and that can hold something."""
    return tuple(form for form in SOLID_FORMATS if what in form.carries)


def patterns(endings: tuple[str, ...]) -> str:
    """Return endings as the filter of a file dialog names them."""
    return " ".join(f"*{ending}" for ending in endings)


def check_scan_suffix(path: Path) -> None:
    """Refuse a file that is none of the formats of scans by its name.

    Raises
    ------
    InputError
        When it is; what it is instead is said where its name tells.
    """
    if path.suffix.lower() in SCAN_SUFFIXES:
        return
    kind = kind_by_ending(path)
    if kind is not None:
        raise InputError("{path} is no scan that can be read: {kind}.", path=path, kind=kind)
    raise InputError(
        "{path} is no scan that can be read; hand in a file of one of the formats {suffixes}.",
        path=path,
        suffixes=joined(SCAN_SUFFIXES),
    )


def check_solid_suffix(path: Path, what: str = "the insole") -> None:
    """Check that the suffix of a name is a format of solids.

    Parameters
    ----------
    what
        The object in the message.

    Raises
    ------
    UsageError
        When it is not.
    """
    if path.suffix.lower() not in SOLID_SUFFIXES:
        raise UsageError(
            "{path} names no format that {what} is written as; choose {formats}.",
            path=path,
            what=what,
            formats=", ".join(SOLID_SUFFIXES),
        )


def read_rank(name: PurePath) -> tuple[int, int]:
    """Return the rank of a file among those of one scan, of which that of the least is read."""
    suffix = name.suffix.lower()
    form = mesh_format(suffix)
    return form.rank, form.endings.index(suffix)
