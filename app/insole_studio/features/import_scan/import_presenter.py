"""Presenter of the import dialog: what the program found, and what the user says of it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject

from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError, InsoleError
from insole_core.foot.foot_candidate import FootCandidate, FoundFoot, PoseClicks
from insole_core.formats.units import Unit
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.imprints.form import Form
from insole_core.progress import Progress
from insole_core.scans.scale import KnownDistance, KnownFootLength
from insole_core.workflows.import_scan import take_foot
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.features.import_scan.found_scan import (
    CLICKS,
    FoundScan,
    candidate_text,
    click_name,
    click_sentence,
    find_scan,
    finding_text,
    foot_text,
    unit_text,
)
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.texts import tr

FIND, TAKE = "find scan", "take scan"
_TO_CLICK_ON = KnownFootLength(250.0)
"""What a scan of unknown size is shown at until its two points are clicked."""


class ImportPresenter(QObject):
    """Lets the user say what a scan is, and makes its feet.

    Parameters
    ----------
    dialog
        Shows the scan.
    jobs
        Runs what takes long.
    path
        Of the scan.
    found
        What is known of it so far.
    take
        Called with the feet once they are made.
    failed
        Called when the file cannot be read any more.
    """

    def __init__(
        self,
        dialog: ImportDialog,
        jobs: Jobs,
        path: Path,
        found: FoundScan,
        *,
        take: Callable[[Sequence[ScannedFoot]], None],
        failed: Callable[[Exception], None],
    ) -> None:
        super().__init__(dialog)
        self._dialog, self._jobs, self._path = dialog, jobs, path
        self._take, self._failed = take, failed
        self._found = found
        self._chosen: list[FootCandidate | None] = []
        self._said: dict[int, Side] = {}
        """Which foot each one is, where the user has said it."""
        self._said_of = len(found.feet)
        """Number of the feet of which it was said."""
        self._told: set[str] = set()
        """The warnings that were shown; they are not said a second time with the foot."""
        dialog.show_reading(found.choice)
        self._size_said = dialog.size_fields.said
        self._shown = 0
        self._clicks: list[FloatArray] = []
        """What has been clicked, mm, source frame."""
        self._force = False
        dialog.side_chosen.connect(self.choose_side)
        dialog.candidate_chosen.connect(self.choose_candidate)
        dialog.foot_shown.connect(self.show_foot)
        dialog.feet_marked.connect(self._show_opening)
        dialog.reading_changed.connect(self.read_anew)
        dialog.unit_chosen.connect(self.choose_unit)
        dialog.point_picked.connect(self.click)
        dialog.clicks_wanted.connect(self.ask_clicks)
        dialog.click_taken_back.connect(self.take_click_back)
        dialog.open_wanted.connect(self.open)
        dialog.finished.connect(self._end)
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._hide_progress)
        self._show_found(found)

    def choose_side(self, side: Side) -> None:
        """Take the shown foot as a left or a right one."""
        foot = self._foot
        if foot is not None:
            self._said[self._shown] = side
            self._choose(foot.best(side))

    def choose_candidate(self, number: int) -> None:
        """Take the shown foot as another of its candidates of the same side."""
        ways = self._ways
        if 0 <= number < len(ways):
            self._choose(ways[number])

    def show_foot(self, number: int) -> None:
        """Show another foot of the scan."""
        if 0 <= number < len(self._chosen) and not self._wants_distance:
            self._shown = number
            self._show_chosen(anew=True)
        else:
            self._show_chosen()  # the points are clicked on the first foot

    def choose_unit(self, unit: Unit) -> None:
        """Read the scan in the unit that was asked for."""
        self._dialog.size_fields.show_size(unit, None)
        self.read_anew()

    def read_anew(self) -> None:
        """Read the scan in the unit and the form that are chosen now."""
        size, form = self._dialog.size_fields, self._dialog.form.currentData()
        choice = replace(self._found.choice, form=Form(form) if form else None)
        is_same_size, self._size_said = size.said == self._size_said, size.said
        if not is_same_size:
            known = _TO_CLICK_ON if size.distance_mm is not None else size.known
            choice = replace(choice, unit=size.unit, known_size=known, pose=None)
        self._find(choice, keep_surface=is_same_size)

    def ask_clicks(self, on: bool) -> None:
        """Begin to click the three points that tell how the foot lies, or give it up."""
        self._clicks = []
        self._show_clicks(is_on=on)

    def click(self, place_mm: FloatArray) -> None:
        """Take a clicked point (3,), mm, in the frame that is shown."""
        self._clicks.append(transform(inverse(self._source2shown), place_mm[None, :])[0])
        distance_mm = self._dialog.size_fields.distance_mm if self._wants_distance else None
        if distance_mm is not None and len(self._clicks) == 2:
            self._find(replace(self._found.choice, known_size=self._distance(distance_mm)))
        elif distance_mm is None and len(self._clicks) == len(CLICKS):
            as_read = np.array(self._clicks) / self._found.mm_per_read_mm
            heel, toe, sole = (tuple(map(float, place)) for place in as_read)
            clicks = PoseClicks(heel, toe, sole)  # type: ignore[arg-type]
            self._find(replace(self._found.choice, pose=clicks), keep_surface=True)
        else:
            self._show_clicks()

    def take_click_back(self) -> None:
        """Forget the last clicked point."""
        if self._clicks:
            self._clicks.pop()
            self._show_clicks()

    def open(self) -> None:
        """Make the marked feet."""
        examination = self._found.examination
        if examination is None:
            return
        choice = replace(self._found.choice, force=self._force)
        wanted = [
            (foot, candidate)
            for number, (foot, candidate) in enumerate(
                zip(examination.feet, self._chosen, strict=True)
            )
            if candidate is not None and self._dialog.is_marked(number)
        ]

        def make(progress: Progress) -> list[ScannedFoot]:
            made = []
            for number, (foot, candidate) in enumerate(wanted):
                progress.step(number / len(wanted), "Finding heel and toes")
                made.append(take_foot(examination, foot, candidate, choice))
            return made

        self._jobs.start(TAKE, make, self._taken, self._refused)
        self._show_opening()

    @property
    def _foot(self) -> FoundFoot | None:
        feet = self._found.feet
        return feet[self._shown] if feet else None

    @property
    def _candidate(self) -> FootCandidate | None:
        return self._chosen[self._shown] if self._chosen else None

    @property
    def _ways(self) -> list[FootCandidate]:
        """The candidates of the shown foot's side; none while the unit is asked for."""
        foot, chosen = self._foot, self._candidate
        if foot is None or chosen is None or foot.unit_readings:
            return []
        return [one for one in foot.candidates if one.side is chosen.side]

    @property
    def _source2shown(self) -> FloatArray:
        foot, read = self._foot, self._found.read
        if foot is not None:
            return (self._candidate or foot.candidates[0]).source2insole
        return np.eye(4) if read is None else _lying(read.mesh)

    @property
    def _notes(self) -> tuple[str, ...]:
        """How the shown foot was read, and what was left out."""
        examination, foot, read = self._found.examination, self._foot, self._found.read
        if examination is None or foot is None:
            return () if read is None else (read.extent_note, *read.notes)
        of_file = examination.notes if examination.read.second is None else foot.notes
        return (*of_file, *examination.left_out)

    @property
    def _wants_distance(self) -> bool:
        """Whether the points of a known distance are still to be clicked."""
        is_known = isinstance(self._found.choice.known_size, KnownDistance)
        return self._dialog.size_fields.distance_mm is not None and not is_known

    @property
    def _unmarked(self) -> int | None:
        """The foot that is not wanted, where a side was asked for and there are two."""
        wanted = self._found.choice.side
        if wanted is None or len(self._chosen) < 2:
            return None
        sides = [None if one is None else one.side for one in self._chosen]
        return sides.index(wanted.other) if wanted.other in sides else None

    def _shown_mesh(self) -> TriangleMesh | None:
        foot, read = self._foot, self._found.read
        mesh = foot.mesh if foot is not None else None if read is None else read.mesh
        return None if mesh is None else mesh.transformed(self._source2shown)

    def _find(self, choice: ImportChoice, *, keep_surface: bool = False) -> None:
        choice = replace(choice, force=False)
        read = self._found.read if keep_surface else None
        self._jobs.cancel(TAKE)
        self._jobs.start(
            FIND,
            lambda progress: find_scan(self._path, choice, read, progress),
            self._show_found,
            self._fail,
        )
        self._show_opening()

    def _show_found(self, found: FoundScan) -> None:
        self._found = found
        self._force = bool(found.refusal)
        self._clicks = []
        if found.feet and len(found.feet) != self._said_of:  # other feet; none in a wrong unit
            self._said, self._said_of = {}, len(found.feet)
        numbers = range(len(found.feet))
        self._chosen = [found.proposed(number, self._said.get(number)) for number in numbers]
        self._shown = min(self._shown, max(len(found.feet) - 1, 0))
        self._show_clicks()
        self._show_chosen(anew=True)

    def _choose(self, candidate: FootCandidate | None) -> None:
        self._chosen[self._shown] = candidate
        self._found, self._force = replace(self._found, refusal=""), False
        self._show_chosen()

    def _show_chosen(self, *, anew: bool = False) -> None:
        dialog, chosen = self._dialog, self._candidate
        mesh = self._shown_mesh()
        dialog.show_surface(mesh, anew=anew)
        side = None if chosen is None else chosen.side
        dialog.show_side(side, mesh, can_be_chosen=self._foot is not None)
        rows = [foot_text(*pair) for pair in zip(self._found.feet, self._chosen, strict=True)]
        dialog.show_feet(rows, self._shown, self._unmarked)
        ways = self._ways
        dialog.show_candidates(
            list(map(candidate_text, ways)), ways.index(chosen) if chosen in ways else -1
        )
        foot = self._foot
        dialog.finding.say("" if foot is None else finding_text(foot, chosen))
        readings = () if foot is None else foot.unit_readings
        dialog.show_units({one.unit: unit_text(one) for one in readings})
        told = () if foot is None else (*foot.doubts, *foot.warnings)
        self._told.update(map(str, told))
        doubts = [self._found.refusal, *told]
        dialog.doubts.say_all([doubt for doubt in doubts if doubt])
        dialog.notes.say_all(self._notes)
        self._show_opening()

    def _show_opening(self) -> None:
        marked = [
            candidate
            for number, candidate in enumerate(self._chosen)
            if self._dialog.is_marked(number)
        ]
        sides = [None if one is None else one.side for one in marked]
        why_not = _hindrance(sides) if len(self._chosen) > 1 else ""
        is_clear = bool(sides) and None not in sides and not why_not
        is_busy = self._jobs.is_running(FIND) or self._jobs.is_running(TAKE)
        insists = self._force and bool(marked)
        text = tr("Open anyway") if insists else tr("Open")
        is_unit_known = not any(foot.unit_readings for foot in self._found.feet)
        is_enabled = is_clear and not is_busy and not self._wants_distance and is_unit_known
        self._dialog.show_opening(text, is_enabled=is_enabled, insists=insists, why_not=why_not)

    def _show_clicks(self, *, is_on: bool | None = None) -> None:
        wants_distance = self._wants_distance
        on = bool(self._clicks) or wants_distance if is_on is None else is_on
        hint = ""
        if wants_distance:
            hint = tr("Click two points of the scan that are as far apart as this.")
        elif on:
            hint = click_sentence(len(self._clicks))
        shown = transform(self._source2shown, np.reshape(self._clicks, (-1, 3)))
        names = ["", ""] if wants_distance else [click_name(n) for n in range(len(CLICKS))]
        points = [
            MarkedPoint(name, (float(x), float(y), float(z)))
            for name, (x, y, z) in zip(names, shown, strict=False)
        ]
        self._dialog.show_clicks(hint, points, is_on=on)

    def _distance(self, distance_mm: float) -> KnownDistance:
        assert self._found.read is not None
        mm_per_unit = self._found.read.mm_per_unit * self._found.mm_per_read_mm
        first, second = (tuple(map(float, place / mm_per_unit)) for place in self._clicks)
        return KnownDistance(first, second, distance_mm)  # type: ignore[arg-type]

    def _taken(self, feet: list[ScannedFoot]) -> None:
        self._dialog.accept()
        self._take([_not_told_again(scanned, self._told) for scanned in feet])

    def _refused(self, error: Exception) -> None:
        """Tell what speaks against it; the user may insist."""
        if not isinstance(error, InsoleError):
            raise error
        self._found, self._force = replace(self._found, refusal=error.message), True
        self._show_chosen()

    def _fail(self, error: Exception) -> None:
        """Tell what is wrong with what was said, or leave where the file cannot be read."""
        if isinstance(error, InputError) and self._wants_distance:
            self._show_found(replace(self._found, refusal=error.message))
        else:
            self._dialog.done(0)
            self._failed(error)

    def _end(self) -> None:
        for channel in (FIND, TAKE):
            self._jobs.cancel(channel)
        self._jobs.progressed.disconnect(self._show_progress)
        self._jobs.ended.disconnect(self._hide_progress)

    def _show_progress(self, news: JobProgress) -> None:
        if news.channel in (FIND, TAKE):
            self._dialog.progress.show_work(news.fraction, news.text)

    def _hide_progress(self, channel: str) -> None:
        if channel in (FIND, TAKE):
            self._dialog.progress.show_work(0, "")
            self._show_opening()


def _not_told_again(scanned: ScannedFoot, told: Collection[str]) -> ScannedFoot:
    return replace(scanned, warnings=tuple(w for w in scanned.warnings if w not in told))


def _lying(mesh: TriangleMesh) -> FloatArray:
    """Return the transform that lays a surface down along its main directions."""
    centre = mesh.vertices.mean(axis=0)
    across, along, up = np.linalg.eigh(np.cov((mesh.vertices - centre).T))[1].T[[1, 2, 0]]
    rotation = np.stack([across, along, up])
    if np.linalg.det(rotation) < 0:
        rotation[2] *= -1
    return rigid(rotation, -rotation @ centre)


def _hindrance(sides: Sequence[Side | None]) -> str:
    """Return why several feet cannot be opened as they are marked; empty where they can."""
    if not sides:
        return tr("Mark the feet that are to be opened.")
    known = [side for side in sides if side is not None]
    if len(set(known)) < len(known):
        return tr(
            "Two marked feet are of the same side; choose the other side for one, or take its "
            "mark away."
        )
    return ""
