"""Read surfaces from files of other programs: .ply, .stl and .obj, in any usual unit."""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.contour_constraints import PLY_ELEMENT, ContourConstraints
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.thinning import thinned
from insole_core.messages import Message
from insole_core.scans.mesh_content import check_text, read_binary_stl

if TYPE_CHECKING:
    import trimesh

Unit = Literal["mm", "cm", "m", "inch"]

_SUFFIXES = (".ply", ".stl", ".obj")
_MM_PER_UNIT: dict[Unit, float] = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4}
_UNIT_NAMES: dict[Unit, str] = {
    "mm": "millimetres", "cm": "centimetres", "m": "metres", "inch": "inches",
}  # fmt: skip
_LENGTH_MM = (80.0, 600.0)  # of a foot or a part of it, with or without the lower leg
_FOOT_MM = (140.0, 330.0)  # of a whole foot; no number is one of these in two units
_MOST_AREA_MM2 = 3e6  # ten times a foot with its lower leg
_LEAST_DEPTH_MM = 4.0  # anything flatter has no shape to design on
_MOST_BYTES = 600_000_000
_MOST_TRIANGLES = 4_000_000
_FINE_TRIANGLES = 600_000  # more of them show the scanner's noise, not the foot
_THIN_VERTICES = 100_000  # of a thinned scan: 0.9 mm apart on a foot, < 0.01 mm off where it bends
_MIX = np.uint64(0x9E3779B97F4A7C15)  # odd and without pattern (Knuth's multiplicative hashing)
_UNREADABLE = (
    ValueError, LookupError, TypeError, AttributeError, struct.error, EOFError, OSError,
    NotImplementedError, MemoryError,
)  # fmt: skip

INSIDE_OUT = "The surface was inside out and has been turned."


class UnitError(InputError):
    """The surface is as large as a foot in no unit, or not in the one that was given."""


@dataclass(frozen=True, eq=False)
class ReadMesh:
    """A surface read from a file, converted to mm.

    Parameters
    ----------
    mesh : mm, the file's own frame
    unit
        Of the file, as given or concluded from the size.
    mm_per_unit
        What the file's numbers were multiplied with, by their unit or by a known size.
    notes
        What was assumed or corrected, a sentence each.
    was_turned
        Whether the triangles face the other way in the file; `INSIDE_OUT` is one of the notes then.
    """

    mesh: TriangleMesh
    unit: Unit
    mm_per_unit: float
    notes: tuple[str, ...]
    was_turned: bool = False


def read_mesh(path: Path, unit: Unit | None = None) -> ReadMesh:
    """Read the surface of a foot from a file.

    Parameters
    ----------
    unit
        Of the coordinates in the file; None to conclude it from the size.

    Raises
    ------
    UnitError
        When the surface is not of a foot's size.
    InputError
        When the file cannot be read, or holds no surface.
    """
    mesh = _without_waste(_load(path), path)
    unit = _unit(mesh, unit, path)
    mesh = _in_mm(mesh, _MM_PER_UNIT[unit])
    if mesh.area_mm2 > _MOST_AREA_MM2:
        raise InputError(
            "{path} has triangles of {area_m2:.0f} m² together, far more than a leg and a foot; "
            "their corners are mixed up, so export it again.",
            path=path,
            area_m2=mesh.area_mm2 / 1e6,
        )
    extent = np.ptp(mesh.vertices, axis=0).max()
    notes: list[str] = [
        Message(
            "Read in {unit}: the surface is {length_mm:.0f} mm long.",
            unit=_UNIT_NAMES[unit],
            length_mm=extent,
        )
    ]
    if not mesh.is_closed:
        notes.append("The surface is open; where nothing was measured it is continued smoothly.")
    if len(mesh.triangles) > _FINE_TRIANGLES:
        pitch_mm = float(np.sqrt(mesh.area_mm2 / _THIN_VERTICES))
        notes.append(
            Message(
                "The scan is finer than a foot needs ({millions:.1f} million triangles); it was "
                "thinned out to one point every {pitch_mm:.1f} mm.",
                millions=len(mesh.triangles) / 1e6,
                pitch_mm=pitch_mm,
            )
        )
        mesh = thinned(mesh, pitch_mm)
    was_turned = _outward_flux(mesh) < 0
    if was_turned:
        mesh = mesh.flipped()
        notes.append(INSIDE_OUT)
    return ReadMesh(mesh, unit, _MM_PER_UNIT[unit], tuple(notes), was_turned)


def _in_mm(mesh: TriangleMesh, mm_per_unit: float) -> TriangleMesh:
    touches = None if mesh.touches is None else mesh.touches.scaled(mm_per_unit)
    return replace(mesh, vertices=mesh.vertices * mm_per_unit, touches=touches)


def _load(path: Path) -> TriangleMesh:
    if path.suffix.lower() not in _SUFFIXES:
        raise InputError(
            "{path} is no mesh file that can be read; hand in a .ply, .stl or .obj file.", path=path
        )
    if not path.is_file():
        raise InputError("{path} does not exist; check the name of the file.", path=path)
    if path.stat().st_size > _MOST_BYTES:
        raise InputError(_too_large(path))
    if path.suffix.lower() == ".stl" and (solid := read_binary_stl(path)) is not None:
        if len(solid.triangles) > _MOST_TRIANGLES:
            raise InputError(_too_large(path))
        return _checked(solid, path)
    import trimesh  # it takes 0.3 s and 40 MB, which most never need

    check_text(path)
    try:
        loaded = _loaded(path)
        vertices = np.array(loaded.vertices, dtype=float)
        triangles = np.array(loaded.faces, dtype=np.int32)
        colors = _vertex_colors(loaded)
        touches = _touches(loaded)
    except (*_UNREADABLE, trimesh.exchange.stl.HeaderError) as error:
        raise InputError(
            "{path} cannot be read as a {format} mesh ({reason}); it may be damaged or cut off, "
            "so export it again.",
            path=path,
            format=path.suffix.lower()[1:].upper(),
            reason=_first_line(error),
        ) from error
    if len(triangles) > _MOST_TRIANGLES:
        raise InputError(_too_large(path))
    return _checked(TriangleMesh(vertices, triangles, colors, touches), path)


def _loaded(path: Path) -> trimesh.Trimesh:
    import trimesh
    from trimesh.exchange import ply, stl

    loaders = {".stl": stl.load_stl, ".ply": ply.load_ply}
    loader = loaders.get(path.suffix.lower())
    if loader is None:
        return trimesh.load_mesh(path, process=False, skip_materials=True)
    # trimesh.load_mesh makes a scene first, which copies the mesh three times.
    with path.open("rb") as file:
        return trimesh.Trimesh(**loader(file, skip_materials=True), process=False)


def _too_large(path: Path) -> str:
    return Message(
        "{path} is too large for a foot (more than {millions} million triangles or 600 "
        "MB); reduce it in the program that made it.",
        path=path,
        millions=_MOST_TRIANGLES // 1000000,
    )


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0].rstrip(".")[:120]


def _vertex_colors(loaded: trimesh.Trimesh) -> ByteArray | None:
    if loaded.visual.kind != "vertex":
        return None
    return np.array(loaded.visual.vertex_colors[:, :3], dtype=np.uint8)


def _touches(loaded: trimesh.Trimesh) -> ContourConstraints | None:
    """Return the contour constraints that a foot reconstructed by this program holds."""
    element = loaded.metadata.get("_ply_raw", {}).get(PLY_ELEMENT)
    if element is None:
        return None
    rows = element["data"]
    columns = [np.asarray(rows[name], dtype=float) for name in ("x", "y", "z", "nx", "ny", "nz")]
    values = np.column_stack(columns)
    values = values[np.isfinite(values).all(axis=1)]
    return ContourConstraints(values[:, :3], values[:, 3:])


def _checked(mesh: TriangleMesh, path: Path) -> TriangleMesh:
    """Refuse what is not a valid triangle mesh."""
    if len(mesh.triangles) == 0:
        raise InputError(
            "{path} holds no surface that can be read, as if it were cut off or held points only; "
            "export it again as a triangle mesh.",
            path=path,
        )
    if mesh.triangles.min() < 0 or mesh.triangles.max() >= len(mesh.vertices):
        raise InputError(
            "{path} names corners that it does not hold; it is damaged, so export it again.",
            path=path,
        )
    is_number = np.asarray(np.isfinite(mesh.vertices).all(axis=1))
    if not is_number[mesh.triangles].all():
        raise InputError(
            "{path} holds coordinates that are not numbers; it is damaged, so export it again.",
            path=path,
        )
    return mesh


def _without_waste(mesh: TriangleMesh, path: Path) -> TriangleMesh:
    """Merge equal vertices; drop triangles without area and vertices without triangle."""
    first, merged = _equal_vertices(mesh)
    mesh = TriangleMesh(
        mesh.vertices[first],
        merged[mesh.triangles],
        None if mesh.colors is None else mesh.colors[first],
        mesh.touches,
    )
    solid = mesh.triangle_areas_mm2 > 0
    if not solid.any():
        raise InputError("{path} holds only triangles without area; export it again.", path=path)
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.triangles[solid]] = True
    if solid.all() and used.all():
        return mesh
    return replace(mesh, triangles=mesh.triangles[solid]).part(used)


def _equal_vertices(mesh: TriangleMesh) -> tuple[IntArray, IndexArray]:
    """Return the first vertex of each kind (position and colour), and every vertex's kind.

    The vertices are sorted by a hash, which is several times faster than by their coordinates.
    """
    columns = list(mesh.vertices.T) + ([] if mesh.colors is None else list(mesh.colors.T))
    order = _ordered(_hash(columns))
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = False
    for column in columns:
        is_new[1:] |= np.diff(column[order]) != 0
    first = np.minimum.reduceat(order, np.flatnonzero(is_new))
    rank = np.empty(len(first), dtype=np.int32)
    rank[np.argsort(first)] = np.arange(len(first))
    kind = np.empty(len(order), dtype=np.int32)
    kind[order] = rank[np.cumsum(is_new) - 1]
    return np.sort(first), kind


def _ordered(hashes: npt.NDArray[np.uint64]) -> IntArray:
    """Return the order (n,) in which equal hashes follow each other.

    The index of each takes the place of its lowest bits, so that plain numbers are sorted, which is
    several times faster than to sort indices. Hashes that differ in these bits only are put right.
    """
    bits = np.uint64(len(hashes).bit_length())
    low = (np.uint64(1) << bits) - np.uint64(1)
    keys = np.sort((hashes & ~low) | np.arange(len(hashes), dtype=np.uint64))
    order = (keys & low).astype(np.int64)
    high, in_order = keys >> bits, hashes[order]
    mixed = (high[1:] == high[:-1]) & (in_order[1:] != in_order[:-1])
    if mixed.any():
        rows = np.flatnonzero(np.isin(high, high[1:][mixed]))
        order[rows] = order[rows][np.argsort(in_order[rows], kind="stable")]
    return order


def _hash(columns: list[FloatArray | ByteArray]) -> npt.NDArray[np.uint64]:
    """Mix the columns (n,) to one number a row; equal rows have equal ones."""
    total = np.zeros(len(columns[0]), dtype=np.uint64)
    for column in columns:
        bits = (column + 0.0).view(np.uint64)  # + 0.0 makes -0.0 and bytes into floats like 0.0
        total = (total ^ bits) * _MIX
        total ^= total >> np.uint64(29)
    return total


def _unit(mesh: TriangleMesh, given: Unit | None, path: Path) -> Unit:
    """Return the unit in which the surface is as large as a foot, and refuse what is flat."""
    extent = float(np.ptp(mesh.vertices, axis=0).max())
    unit = _likely_unit(extent, path) if given is None else given
    length_mm = extent * _MM_PER_UNIT[unit]
    if not _LENGTH_MM[0] <= length_mm <= _LENGTH_MM[1]:
        raise UnitError(
            "{path} is {length_mm:.0f} mm long if it is read in {unit}, which is no foot; "
            "choose another unit.",
            path=path,
            length_mm=length_mm,
            unit=_UNIT_NAMES[unit],
        )
    if _depth(mesh) * _MM_PER_UNIT[unit] < _LEAST_DEPTH_MM:
        raise InputError(
            "{path} is flat, which is no surface of a foot; export it again.", path=path
        )
    return unit


def _likely_unit(extent: float, path: Path) -> Unit:
    """Return the unit in which the extent is a foot's, or else a foot with its leg or a part."""
    for least_mm, greatest_mm in (_FOOT_MM, _LENGTH_MM):
        for unit, factor in _MM_PER_UNIT.items():
            if least_mm <= extent * factor <= greatest_mm:
                return unit
    raise UnitError(
        "{path} measures {length:g} in its longest direction, which is no foot in millimetres, "
        "centimetres, metres or inches; check the unit of the export.",
        path=path,
        length=extent,
    )


def _depth(mesh: TriangleMesh) -> float:
    """Return the extent along the flattest direction."""
    centred = mesh.vertices - mesh.vertices.mean(axis=0)
    flattest = np.linalg.eigh(centred.T @ centred)[1][:, 0]
    return float(np.ptp(centred @ flattest))


def _outward_flux(mesh: TriangleMesh) -> float:
    """Compute the flux of the vectors from the middle; > 0 if triangles face outwards, open or not.

    For a closed surface it is three times the volume, wherever the middle lies.
    """
    areas_mm2 = mesh.triangle_areas_mm2
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    middle = areas_mm2 @ centres / mesh.area_mm2
    return float(np.einsum("i,ij,ij->", areas_mm2, mesh.triangle_normals, centres - middle))
