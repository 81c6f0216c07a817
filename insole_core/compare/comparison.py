"""Surfaces to compare, and their comparison: align one with the other, then measure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np

from insole_core.compare.best_fit import Fit, badness, best_fit, find_dots, fit_dots, fit_points
from insole_core.compare.difference import Difference, measure_difference
from insole_core.compare.one_view import one_view_surface
from insole_core.compare.seen_surface import SeenMesh, facing, is_one_sided
from insole_core.errors import InputError, ReconstructionError
from insole_core.foot.foot_placement import SideMismatchError, place_foot, recognised_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.spread import Limits, MeasuredFoot, measure_foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import BOTH, Side
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import is_session, read_session
from insole_core.recording.session import Session
from insole_core.scans.mesh_file import read_mesh

_PickedPoints: TypeAlias = tuple[FloatArray, FloatArray]
Alignment: TypeAlias = Literal["best", "none", "dots"] | _PickedPoints
_FIXED_PITCH_MM, _MOVED_PITCH_MM = 1.0, 2.0
_GOOD_SHARE = 0.75
MIRROR = (-1.0, 1.0, 1.0)
"""Factors of the coordinates that make a left foot of a right one."""


def compare_surfaces(
    a: TriangleMesh,
    b: TriangleMesh,
    alignment: Alignment = "best",
    *,
    median_pixels: int = 1,
    progress: Progress = SILENT,
) -> Difference:
    """Measure the difference of two surfaces, a minus b, in the frame of a.

    Parameters
    ----------
    a, b : mm
        Each in its own frame.
    alignment
        "best" fits b to a; "none" takes both as they lie; "dots" uses four black dots found on
        both; or points picked on a and on b.
    median_pixels
        Kernel of the spatial median filter; 1 for none, 6 as in thesis 8.3.

    Returns
    -------
    Difference
        In the frame of a, mm.

    Raises
    ------
    InputError
        If the two do not overlap or cannot be aligned.
    """
    progress.step(0.0, "Looking at both surfaces")
    seen_a, seen_b = SeenMesh(a), SeenMesh(b)
    fit, looks_b = _aligned(seen_a, seen_b, alignment, progress.part(0.1, 0.8))
    progress.step(0.8, "Measuring the difference")
    return measure_difference(seen_a, seen_b, fit, looks_b, median_pixels=median_pixels)


def _aligned(
    a: SeenMesh, b: SeenMesh, alignment: Alignment, progress: Progress
) -> tuple[Fit, FloatArray]:
    """Return the fit of b to a, and the viewing direction of b's seen side, in b's frame."""
    if alignment == "best":
        return _best(a, b, progress)
    if alignment == "none":
        return Fit(np.eye(4), float("nan"), 1.0), facing(b.mesh)
    if alignment == "dots":
        return fit_dots(
            find_dots(a.mesh, "the first surface"), find_dots(b.mesh, "the second surface")
        ), facing(b.mesh)
    return fit_points(*alignment), facing(b.mesh)


def _best(a: SeenMesh, b: SeenMesh, progress: Progress) -> tuple[Fit, FloatArray]:
    """Fit the seen sides; if they meet poorly, try b from all sides: its frame may be foreign."""
    target = a.points(facing(a.mesh), _FIXED_PITCH_MM)
    fits: list[tuple[Fit, FloatArray]] = []
    for number, looks in enumerate([facing(b.mesh), *np.eye(3), *-np.eye(3)]):
        part = progress.part(number / 7, (number + 1) / 7)
        fit = best_fit(target, b.points(looks, _MOVED_PITCH_MM), part)
        if fit is not None:
            fits.append((fit, looks))
        if number == 0 and fit is not None and fit.share >= _GOOD_SHARE:
            break
    if not fits:
        raise InputError(
            "The two surfaces do not overlap in any pose, so they cannot be compared;"
            " check that both show the same side of the same foot."
        )
    return min(fits, key=lambda found: badness(found[0]))


def _recorded_foot_measures(
    mesh: TriangleMesh, side: Side, repeated: Limits
) -> MeasuredFoot | None:
    """Measure the foot of a session.

    Parameters
    ----------
    mesh : mm, reference frame
    side
        As the session says.
    repeated
        By the repeat test of its sensors.

    Returns
    -------
    MeasuredFoot or None
        None when it is not a foot of that side.
    """
    try:
        foot = place_foot(mesh, side, frame="reference")
    except (InputError, SideMismatchError):
        return None
    return measure_foot(foot, find_landmarks(foot), is_recorded=True, repeated=repeated)


def surface_measures(mesh: TriangleMesh) -> tuple[Side | None, MeasuredFoot | None]:
    """Measure a surface of which nothing is known, if it is a foot, and tell which one.

    Parameters
    ----------
    mesh : mm, any frame

    Returns
    -------
    side : Side or None
    measures : MeasuredFoot or None
        None for insoles, moulds, and what looks like no foot.
    """
    if not is_one_sided(mesh) and facing(mesh)[2] > 0:
        return None, None
    foot = recognised_foot(mesh)
    if foot is None:
        return None, None
    is_recorded = mesh.touches is not None
    return foot.side, measure_foot(foot, find_landmarks(foot), is_recorded=is_recorded)


@dataclass(frozen=True, eq=False)
class ComparisonSource:
    """A surface to compare.

    Parameters
    ----------
    name
        For pictures and reports.
    mesh : mm
        In its own frame.
    notes
        Assumptions that were made, one sentence each.
    measures
        Of a foot; None for anything else.
    side
        The foot that it shows or is for; None where that is not known.
    is_mirrored
        Whether it was mirrored in x to be compared with one of the other side.
    """

    name: str
    mesh: TriangleMesh
    notes: tuple[str, ...] = ()
    measures: MeasuredFoot | None = None
    side: Side | None = None
    is_mirrored: bool = False

    def like(self, other: ComparisonSource) -> ComparisonSource:
        """Return it as it is compared with another one: mirrored, and saying so, if of both feet.

        A surface of which the side is not known stays as it is.
        """
        if self.side is None or other.side is None or self.side is other.side:
            return self
        note = Message("{name} is of the other foot, so that it is mirrored.", name=self.name)
        return replace(self, mesh=self.mesh.mirrored(), notes=(*self.notes, note), is_mirrored=True)

    def points_like(self, picked: _PickedPoints) -> _PickedPoints:
        """Return points picked on another surface and on this one before it was mirrored."""
        return (picked[0], picked[1] * MIRROR) if self.is_mirrored else picked


def read_source(
    path: Path,
    progress: Progress = SILENT,
    is_corrected: Callable[[Session], bool] = lambda _: True,
    repeated: Callable[[Session], Limits] = lambda _: {},
) -> ComparisonSource:
    """Read a surface from a mesh file or a session.

    A session of one view without the reference system in its picture is taken for a mould or a
    finished insole on a table.

    Parameters
    ----------
    is_corrected
        Whether the learnt error of the matching is subtracted for the sensors of a session.
    repeated
        What a repeat test of the sensors of a session found.

    Raises
    ------
    InputError
        If it cannot be read.
    ReconstructionError
        If no surface can be reconstructed from a session.
    """
    progress.step(0.0, "Reading {file}", file=path.name)
    if not is_session(path):
        read = read_mesh(path)
        side, measures = surface_measures(read.mesh)
        return ComparisonSource(path.name, read.mesh, tuple(read.notes), measures, side)
    session = read_session(path)
    if session.manifest.side == BOTH:
        raise InputError(
            "{path} was recorded with both feet, but one surface is compared; reconstruct its feet "
            "and give the mesh of one.",
            path=path,
        )
    side, corrected = session.manifest.one_side, is_corrected(session)
    if len(session.views) > 1:
        mesh = reconstruct(session, "fused", progress, corrected=corrected).mesh
        return _recorded_foot(path.name, mesh, side, repeated(session))
    try:
        part = progress.part(0.0, 0.5)
        mesh = reconstruct(session, "fused", part, corrected=corrected).mesh
    except ReconstructionError:
        mesh = one_view_surface(session.views[0], progress.part(0.5, 1.0))
    else:
        return _recorded_foot(path.name, mesh, side, repeated(session))
    return ComparisonSource(
        path.name, mesh, ("One view without a reference system: taken as a thing on a table.",)
    )


def _recorded_foot(name: str, mesh: TriangleMesh, side: Side, repeated: Limits) -> ComparisonSource:
    measures = _recorded_foot_measures(mesh, side, repeated)
    return ComparisonSource(name, mesh, measures=measures, side=side)
