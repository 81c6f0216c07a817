"""Random sequences of edits, drags and undos of a case, and what its window shows of them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pyvista as pv
from PySide6.QtCore import QCoreApplication
from scipy.spatial import KDTree

from benchmarks._random_designs import random_design, random_finish, random_shell
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.insole.build import build_insole
from insole_core.insole.elements import BrushStroke, ForefootTwist, Pelott, Posting, Rocker
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.solids.solid import insole_solid
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.jobs import Jobs
from insole_studio.scene.painter import Painter

EDITS = 12
"""Of a sequence."""
_PATIENCE_S = 60
_Edit = Callable[[InsoleDesign, np.random.Generator], InsoleDesign]


@dataclass(frozen=True)
class Seen:
    """How far what is drawn differs from what is exported.

    Parameters
    ----------
    apart_mm
        Largest distance of a drawn vertex from that of the export.
    turned_deg
        Largest angle between a drawn normal and that of the surface.
    """

    apart_mm: float
    turned_deg: float


class EditedCase:
    """A case with its preview and what draws it, as in the window."""

    def __init__(self, foot: Foot, design: InsoleDesign) -> None:
        self.foot = foot
        self.case, self.jobs = Case(), Jobs()
        self.preview = InsolePreview(self.case, self.jobs)
        self._plotter = pv.Plotter(off_screen=True)
        self.painter = Painter(self._plotter)
        self.preview.changed.connect(self._draw)
        self.case.open_foot(foot, ScanSource("mesh", "/nowhere/foot.ply", "0" * 64), design)

    def close(self) -> None:
        self.jobs.close()
        self._plotter.close()

    @property
    def design(self) -> InsoleDesign:
        design = self.case.record.design
        assert design is not None
        return design

    def settle(self) -> None:
        """Wait until nothing is being built any more."""
        limit_s = time.monotonic() + _PATIENCE_S
        while self.jobs.is_running():
            assert time.monotonic() < limit_s
            QCoreApplication.processEvents()

    def edit(self, rng: np.random.Generator) -> None:
        """Do one thing: an edit, a drag, an undo or a redo; the next one waits or does not."""
        what = rng.random()
        if what < 0.25:
            self.case.undo()
        elif what < 0.35:
            self.case.redo()
        elif what < 0.65:
            self._drag(rng)
        else:
            self.case.apply(_edited(self.design, rng), "Edit")
        if rng.random() < 0.5:
            self.settle()

    def seen(self) -> Seen | None:
        """Compare what is drawn with the export; None of a design that cannot be made."""
        self.settle()
        if self.preview.problem:
            return None
        surface = self.painter._surface
        assert surface is not None
        made = insole_solid(build_insole(self.foot, self.design)).vertices
        apart = np.asarray(KDTree(made).query(np.asarray(surface.points, dtype=float))[0])
        mesh = self.preview.mesh
        assert mesh is not None
        normals = mesh.moved(mesh.vertices).vertex_normals
        cosine = (surface.point_data["Normals"] * normals).sum(axis=1)[normals.any(axis=1)]
        turned = np.degrees(np.arccos(np.clip(cosine.min(), -1.0, 1.0)))
        return Seen(float(apart.max()), float(turned))

    def _draw(self) -> None:
        """Draw as the presenter of the insole does."""
        mesh, normals = self.preview.mesh, self.preview.normals
        if mesh is None or normals is None:
            return
        if not self.painter.move_surface(mesh, normals, self.preview.moved):
            self.painter.show_surface(mesh)

    def _drag(self, rng: np.random.Generator) -> None:
        drag = _DRAGS[rng.integers(len(_DRAGS))]
        dragged = before = self.design
        for _ in range(4):
            dragged = drag(dragged, rng)
            self.case.preview(dragged)
        if rng.random() < 0.2:
            self.case.end_preview()
        else:
            self.case.apply(dragged if rng.random() < 0.8 else drag(before, rng), "Drag")


def _edited(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    return _EDITS[rng.integers(len(_EDITS))](design, rng)


def _place(rng: np.random.Generator) -> tuple[float, float]:
    return float(rng.uniform(-25, 25)), float(rng.uniform(20, 200))


def _with_pad(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    height_mm = float(rng.uniform(-1.0, 6.0))
    return design.with_added(Pelott(centre_mm=_place(rng), height_mm=height_mm))


def _with_moved_pad(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    pads = [c for c in design.corrections if isinstance(c, Pelott)]
    if not pads:
        return _with_pad(design, rng)
    pad = pads[rng.integers(len(pads))]
    (x, y), (dx, dy) = pad.centre_mm, rng.normal(0, 6, 2)
    return design.with_changed(replace(pad, centre_mm=(x + float(dx), y + float(dy))))


def _with_stroke(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    """Add a stroke, or let the last one go on."""
    last = design.corrections[-1] if design.corrections else None
    step = rng.normal(0, 8, 2)
    if isinstance(last, BrushStroke) and len(last.points_mm) < 6:
        (x, y) = last.points_mm[-1]
        points = (*last.points_mm, (x + float(step[0]), y + float(step[1])))
        return design.with_changed(replace(last, points_mm=points))
    mode = str(rng.choice(["push", "pull", "smooth"]))
    stroke = BrushStroke(mode=mode, points_mm=(_place(rng),), strength=float(rng.uniform(0.2, 1)))
    return design.with_added(stroke)


def _with_other_rim(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    finish = design.finish
    if finish is None:
        return replace(design, finish=random_finish(rng))
    rim = list(finish.rim)
    number = int(rng.integers(len(rim)))
    rim[number] = replace(rim[number], height_mm=rim[number].height_mm + float(rng.uniform(0, 1)))
    return replace(design, finish=replace(finish, rim=tuple(rim)))


def _without_one(design: InsoleDesign, rng: np.random.Generator) -> InsoleDesign:
    if not design.corrections:
        return design
    chosen = design.corrections[rng.integers(len(design.corrections))]
    if rng.random() < 0.5:
        return design.with_removed(chosen.id)
    return design.with_changed(replace(chosen, enabled=not chosen.enabled))


_DRAGS: tuple[_Edit, ...] = (_with_moved_pad, _with_stroke, _with_other_rim)
_EDITS: tuple[_Edit, ...] = (
    *_DRAGS,
    _with_pad,
    _with_stroke,
    _without_one,
    lambda design, rng: replace(design, thickness_mm=float(rng.uniform(3, 8))),
    lambda design, rng: replace(design, bottom=str(rng.choice(["flat", "following"]))),
    lambda design, rng: replace(design, finish=random_finish(rng)),
    lambda design, rng: replace(design, finish=None),
    lambda design, rng: replace(design, shell=replace(random_shell(rng), posts=())),
    lambda design, rng: replace(design, shell=None),
    lambda design, rng: replace(
        design, outline=Outline(extent=str(rng.choice(["full", "three_quarter"])))
    ),
    lambda design, rng: replace(
        design, layers=Layers(cover_mm=2.0, cover_is_taken_off=bool(rng.random() < 0.5))
    ),
    lambda design, rng: design.with_added(Posting(rearfoot_deg=float(rng.uniform(-5, 5)))),
    lambda design, rng: design.with_added(ForefootTwist(angle_deg=float(rng.uniform(-3, 3)))),
    lambda design, _rng: design.with_added(Rocker()),
    lambda design, _rng: replace(design, corrections=design.corrections[::-1]),
)


def random_sequence(foot: Foot, seed: int, edits: int = EDITS) -> Seen | None:
    """Edit a case at random, and compare what is drawn with what is exported."""
    rng = np.random.default_rng(seed)
    grid_mm = 2.0 if rng.random() < 0.7 else 1.0
    edited = EditedCase(foot, replace(random_design(foot, rng), grid_mm=grid_mm))
    try:
        for _ in range(edits):
            edited.edit(rng)
        return edited.seen()
    finally:
        edited.close()
