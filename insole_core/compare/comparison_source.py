"""Surfaces to compare: a mesh file, a recorded foot, or a mould or insole seen in one view."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.compare.comparison import PickedPoints
from insole_core.compare.foot_measures import recorded_foot_measures, surface_measures
from insole_core.compare.one_view import one_view_surface
from insole_core.errors import InputError, ReconstructionError
from insole_core.foot.measure_table import Measured
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import BOTH, Side
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import is_session, read_session
from insole_core.recording.session import Session
from insole_core.scans.mesh_file import read_mesh

MIRROR = (-1.0, 1.0, 1.0)
"""Factors of the coordinates that make a left foot of a right one."""


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
        Of a foot, by the names in `DEFINITIONS`; None for anything else.
    side
        The foot that it shows or is for; None where that is not known.
    is_mirrored
        Whether it was mirrored in x to be compared with one of the other side.
    """

    name: str
    mesh: TriangleMesh
    notes: tuple[str, ...] = ()
    measures: Measured | None = None
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

    def points_like(self, picked: PickedPoints) -> PickedPoints:
        """Return points picked on another surface and on this one before it was mirrored."""
        return (picked[0], picked[1] * MIRROR) if self.is_mirrored else picked


def read_source(
    path: Path,
    progress: Progress = SILENT,
    is_corrected: Callable[[Session], bool] = lambda _: True,
) -> ComparisonSource:
    """Read a surface from a mesh file or a session.

    A session of one view without the reference system in its picture is taken for a mould or a
    finished insole on a table.

    Parameters
    ----------
    is_corrected
        Whether the learnt error of the matching is subtracted for the sensors of a session.

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
        return _recorded_foot(path.name, mesh, side)
    try:
        part = progress.part(0.0, 0.5)
        mesh = reconstruct(session, "fused", part, corrected=corrected).mesh
    except ReconstructionError:
        mesh = one_view_surface(session.views[0], progress.part(0.5, 1.0))
    else:
        return _recorded_foot(path.name, mesh, side)
    return ComparisonSource(
        path.name, mesh, ("One view without a reference system: taken as a thing on a table.",)
    )


def _recorded_foot(name: str, mesh: TriangleMesh, side: Side) -> ComparisonSource:
    return ComparisonSource(name, mesh, measures=recorded_foot_measures(mesh, side), side=side)
