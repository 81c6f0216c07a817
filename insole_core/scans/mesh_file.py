"""Read surfaces from files of other programs, in any usual unit or with a known size."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.errors import InputError
from insole_core.formats.raw_surface import RawSurface
from insole_core.formats.reading import read_raw
from insole_core.formats.units import MM_PER_UNIT, UNIT_NAMES, Unit, UnitError
from insole_core.geometry.far_away import coordinate_step, far_origin
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_resolution import thinned
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.messages import Message, counted
from insole_core.scans.cleaning import (
    INSIDE_OUT,
    faces_outwards,
    merged,
    without_double_triangles,
    without_flat_triangles,
    without_spikes,
)
from insole_core.scans.length_unit import checked_length, stated_or_likely_unit
from insole_core.scans.point_surface import even_points, surface_through, without_outliers
from insole_core.scans.scale import KnownSize, provisional_mm_per_unit
from insole_core.scans.scan_folder import ScanPart, part_content, scan_parts

__all__ = ["ReadMesh", "Unit", "UnitError", "read_mesh", "read_part"]

_MOST_AREA_MM2 = 3e6  # ten times a foot with its lower leg
_LEAST_DEPTH_MM = 4.0  # anything flatter has no shape to design on
_MOST_TRIANGLES = 4_000_000
_LEAST_POINTS, _MOST_POINTS = 1000, 10_000_000
_SAMPLED_TRIANGLES = 200_000
_FINE_TRIANGLES = 600_000  # more of them show the scanner's noise, not the foot
_MOST_CUBES = 2**20  # along an axis, so that their numbers stay below 2**63
_MOST_COORDINATE = 2e10  # in any unit, such as mm of a map; beyond it they are no lengths
_FINE_STEP_MM, _MOST_STEP = 0.1, 0.005  # of coordinates far away; the latter of the extent
_THIN_VERTICES = 100_000  # of a thinned scan: 0.9 mm apart on a foot, < 0.01 mm off where it bends


@dataclass(frozen=True, eq=False)
class ReadMesh:
    """A surface read from a file, converted to mm.

    Parameters
    ----------
    mesh : mm, the file's own frame
    unit
        Of the file, as given or concluded from the size; mm where a known size gave the scale.
    mm_per_unit
        What the file's numbers were multiplied with, by their unit or by a known size.
    scale_note
        What its scale follows from.
    corrections
        What else was assumed or corrected, a sentence each.
    was_turned
        Whether the triangles face the other way in the file; `INSIDE_OUT` is one of the corrections
        then.
    part
        Where it was read from.
    second
        The other scan of a folder or archive with both feet.
    stated
        The unit that the file or its format states.
    is_unit_said
        Whether the user has said the unit, or a size in its place.
    warnings
        What the user has to know of it although nothing has to be decided, a sentence each.
    """

    mesh: TriangleMesh
    unit: Unit
    mm_per_unit: float
    scale_note: str
    corrections: tuple[str, ...] = ()
    was_turned: bool = False
    part: ScanPart | None = None
    second: ReadMesh | None = None
    stated: Unit | None = None
    is_unit_said: bool = False
    warnings: tuple[Message, ...] = ()

    def scaled(self, factor: float) -> ReadMesh:
        """Correct the scale of a scan whose foot has been found and is of a known length."""
        mesh = _in_mm(self.mesh, factor)
        return replace(self, mesh=mesh, mm_per_unit=factor * self.mm_per_unit)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was assumed or corrected, a sentence each."""
        return (self.scale_note, *self.corrections)

    @property
    def extent_note(self) -> Message:
        """How long all of the surface is, for where no foot is found in it."""
        return Message(
            "The surface is {length_mm:.0f} mm long.",
            length_mm=float(np.ptp(self.mesh.vertices, axis=0).max()),
        )


def read_mesh(
    path: Path,
    unit: Unit | None = None,
    *,
    known_size: KnownSize | None = None,
    side: Side | None = None,
) -> ReadMesh:
    """Read the surface of a foot from a file, or from a folder or zip archive with scans.

    Parameters
    ----------
    unit
        Of the coordinates in the file; None to conclude it from the size.
    known_size
        In place of a unit.
    side
        Which of two scans is meant, if their names tell; without it both are read.

    Raises
    ------
    UnitError
        When the surface is not of a foot's size.
    InputError
        When the file cannot be read, or holds no surface.
    """
    parts = scan_parts(path)
    if len(parts) == 1:
        return read_part(parts[0], unit, known_size)
    of_side = [part for part in parts if side is not None and part.side is side]
    if len(of_side) == 1:
        return read_part(of_side[0], unit, known_size)
    first, second = (read_part(part, unit, known_size) for part in parts)
    return replace(first, second=second)


def read_part(
    part: ScanPart, unit: Unit | None = None, known_size: KnownSize | None = None
) -> ReadMesh:
    """Read one scan of a file, folder or archive, as `read_mesh` does."""
    raw, path = _checked(_raw(part), part.path), part.path
    origin = far_origin(raw.vertices)
    raw = raw.moved(-origin)
    step = _checked_step(raw, path) if origin.any() else 0.0
    count = len(raw.triangles)
    cloud_notes: tuple[Message, ...] = ()
    if count:
        surface, pitch = _sound_surface(raw, path)
    else:
        raw, cloud_notes = _even_cloud(raw, path)
        surface, pitch = TriangleMesh(raw.vertices, raw.triangles, raw.colors), 0.0
    is_said = known_size is not None or unit is not None
    unit, mm_per_unit = _scale(surface, raw, unit, known_size, path)
    spikes = 0
    if count:
        mesh, spikes = without_spikes(_in_mm(surface, mm_per_unit))
        _check_area(mesh, path)
    else:
        mesh = _through_points(raw, mm_per_unit, path)
    scale_note = _scale_note(unit, is_known=known_size is not None)
    corrections = [
        *raw.notes,
        *cloud_notes,
        *_mesh_notes(mesh, count, pitch * mm_per_unit, spikes),
    ]
    was_turned = not faces_outwards(mesh)
    if was_turned:
        mesh = mesh.flipped()
        corrections.append(Message(INSIDE_OUT))
    return ReadMesh(
        mesh.transformed(rigid(np.eye(3), origin * mm_per_unit)) if origin.any() else mesh,
        unit,
        mm_per_unit,
        scale_note,
        tuple(corrections),
        was_turned=was_turned,
        part=part,
        stated=None if raw.is_unit_remark and raw.unit != unit else raw.unit,
        is_unit_said=is_said,
        warnings=tuple(_step_warnings(step * mm_per_unit)),
    )


def _raw(part: ScanPart) -> RawSurface:
    """Read what a file holds; its bytes are freed before anything is made of it."""
    return read_raw(part_content(part))


def _in_mm(mesh: TriangleMesh, mm_per_unit: float) -> TriangleMesh:
    if mm_per_unit == 1.0:
        return mesh
    touches = None if mesh.touches is None else mesh.touches.scaled(mm_per_unit)
    return replace(mesh, vertices=mesh.vertices * mm_per_unit, touches=touches)


def _checked(raw: RawSurface, path: Path) -> RawSurface:
    """Refuse what is no valid surface or cloud of points, or too large."""
    if len(raw.triangles) > _MOST_TRIANGLES or len(raw.vertices) > 3 * _MOST_TRIANGLES:
        raise _too_large(path)
    if len(raw.triangles) == 0:
        if len(raw.vertices) < _LEAST_POINTS:
            raise _no_surface(path)
        if len(raw.vertices) > _MOST_POINTS:
            raise _too_large(path)
    elif raw.triangles.min() < 0 or raw.triangles.max() >= len(raw.vertices):
        raise InputError(
            "{path} names corners that it does not hold; it is damaged, so export it again.",
            path=path,
        )
    if not _are_numbers(raw):
        raise InputError(
            "{path} holds coordinates that are not numbers; it is damaged, so export it again.",
            path=path,
        )
    return raw


def _are_numbers(raw: RawSurface) -> bool:
    """Return whether all coordinates are lengths; vertices without triangle do not count."""
    least, greatest = raw.vertices.min(), raw.vertices.max()  # not a number if one of them is none
    if least > -_MOST_COORDINATE and greatest < _MOST_COORDINATE:
        return True
    is_number = np.asarray((np.abs(raw.vertices) < _MOST_COORDINATE).all(axis=1))
    return len(raw.triangles) > 0 and bool(is_number[raw.triangles].all())


def _no_surface(path: Path) -> InputError:
    return InputError(
        "{path} holds no surface that can be read, as if it were cut off or held points in a few "
        "places only; export it again as a triangle mesh.",
        path=path,
    )


def _too_large(path: Path) -> InputError:
    return InputError(
        "{path} is too large for a foot (more than {millions} million triangles or {points} "
        "million points); reduce it in the program that made it.",
        path=path,
        millions=_MOST_TRIANGLES // 1_000_000,
        points=_MOST_POINTS // 1_000_000,
    )


def _sound_surface(raw: RawSurface, path: Path) -> tuple[TriangleMesh, float]:
    """Return the surface without what is no triangle, and at which pitch it was thinned, or 0."""
    surface = merged(TriangleMesh(raw.vertices, raw.triangles, raw.colors, raw.touches))
    pitch = 0.0
    if len(surface.triangles) > _FINE_TRIANGLES:
        pitch = max(
            float(np.sqrt(_about_area(surface) / _THIN_VERTICES)),
            float(np.ptp(surface.vertices, axis=0).max()) / _MOST_CUBES,
        )
    if pitch > 0:
        surface = thinned(surface, pitch)
    surface = without_double_triangles(without_flat_triangles(surface))
    if not len(surface.triangles):
        raise InputError("{path} holds only triangles without area; export it again.", path=path)
    return surface, pitch


def _about_area(mesh: TriangleMesh) -> float:
    """Return the area of a fine mesh within a percent or so, by a part of its triangles."""
    step = len(mesh.triangles) // _SAMPLED_TRIANGLES
    return step * replace(mesh, triangles=mesh.triangles[::step]).area_mm2


def _even_cloud(raw: RawSurface, path: Path) -> tuple[RawSurface, tuple[Message, ...]]:
    """Return the points that a surface is laid through, and what was left out."""
    even = raw.at_points(even_points(raw.vertices))
    if len(even.vertices) < _LEAST_POINTS:
        raise _no_surface(path)
    kept = even.at_points(np.flatnonzero(without_outliers(even.vertices)))
    notes = [Message("A surface was laid through {points} points.", points=len(kept.vertices))]
    if far := len(even.vertices) - len(kept.vertices):
        notes.append(
            counted(
                far,
                "One point far from all others was left out.",
                "{count} points far from all others were left out.",
            )
        )
    if more := len(raw.vertices) - len(even.vertices):
        notes.append(
            counted(
                more,
                "One point was left out that lies close beside another.",
                "{count} points were left out that lie close beside others.",
            )
        )
    return kept, tuple(notes)


def _scale(
    whole: TriangleMesh, raw: RawSurface, unit: Unit | None, known: KnownSize | None, path: Path
) -> tuple[Unit, float]:
    """Return the unit and the mm in one unit of the file; refuse what is no foot or flat."""
    extent = float(np.ptp(whole.vertices, axis=0).max())
    if known is not None:
        found: tuple[Unit, float] = ("mm", provisional_mm_per_unit(known, extent))
    else:
        unit = stated_or_likely_unit(whole, raw.unit, path) if unit is None else unit
        found = (unit, MM_PER_UNIT[unit])
    checked_length(whole, found[1], path, None if known is not None else found[0])
    if _depth(whole) * found[1] < _LEAST_DEPTH_MM:
        raise InputError(
            "{path} is flat, which is no surface of a foot; export it again.", path=path
        )
    return found


def _checked_step(raw: RawSurface, path: Path) -> float:
    """Return the step to which coordinates far away are rounded; refuse one that is no foot's."""
    step = coordinate_step(raw.vertices)
    if step > _MOST_STEP * float(np.ptp(raw.vertices, axis=0).max()):
        raise InputError(
            "{path} lies so far from the origin that the last digits of its coordinates are lost: "
            "they are rounded to steps of {step:g}; export it near the origin.",
            path=path,
            step=step,
        )
    return step


def _step_warnings(step_mm: float) -> Iterator[Message]:
    if step_mm > _FINE_STEP_MM:
        yield Message(
            "The scan lies so far from the origin that its coordinates are rounded to steps of "
            "{step_mm:.2f} mm; export it near the origin.",
            step_mm=step_mm,
        )


def _through_points(raw: RawSurface, mm_per_unit: float, path: Path) -> TriangleMesh:
    try:
        return surface_through(raw.vertices * mm_per_unit, raw.normals, raw.colors)
    except ValueError as error:
        raise InputError(
            "The points of {path} give no surface ({reason}); export it as a triangle mesh.",
            path=path,
            reason=str(error),
        ) from error


def _check_area(mesh: TriangleMesh, path: Path) -> None:
    if mesh.area_mm2 > _MOST_AREA_MM2:
        raise InputError(
            "{path} has triangles of {area_m2:.0f} m² together, far more than a leg and a foot; "
            "their corners are mixed up, so export it again.",
            path=path,
            area_m2=mesh.area_mm2 / 1e6,
        )


def _scale_note(unit: Unit, *, is_known: bool) -> Message:
    if is_known:
        return Message("Scaled by the size that is known.")
    return Message("Read in {unit}.", unit=UNIT_NAMES[unit])


def _mesh_notes(mesh: TriangleMesh, count: int, pitch_mm: float, spikes: int) -> Iterator[Message]:
    if spikes:
        yield counted(
            spikes,
            "One point stuck out of the surface as a spike and was drawn back.",
            "{count} points stuck out of the surface as spikes and were drawn back.",
        )
    if not mesh.is_closed:
        yield Message("The surface is open; where nothing was measured it is continued smoothly.")
    if count > _FINE_TRIANGLES:
        yield Message(
            "The scan is finer than a foot needs ({millions:.1f} million triangles); it was "
            "thinned out to one point every {pitch_mm:.1f} mm.",
            millions=count / 1e6,
            pitch_mm=pitch_mm,
        )


def _depth(mesh: TriangleMesh) -> float:
    """Return the extent along the flattest direction."""
    centred = mesh.vertices - mesh.vertices.mean(axis=0)
    flattest = np.linalg.eigh(centred.T @ centred)[1][:, 0]
    return float(np.ptp(centred @ flattest))
