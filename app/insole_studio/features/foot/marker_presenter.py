"""Presenter of the colour image of a view, of the marks on it and of their corrections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from insole_core.geometry.arrays import ByteArray
from insole_core.reconstruct import MarkerObservation, ViewResult
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.recording.hand_edits import NamedSpot, Pixel, Region, ViewEdits
from insole_core.workflows.session_editor import SessionEditor
from insole_studio.features.foot.rows import Mark, MarkState
from insole_studio.texts import tr

_SAME_PX = 1.0
_SPOT_SHARE = 14 / 1280
"""Half the width of the region ignored around a blue spot, as a share of the image width."""


def marks_of(measured: MeasuredView, result: ViewResult, edits: ViewEdits) -> tuple[Mark, ...]:
    """Return the marks of a view, markers first.

    Without a pose only manually placed markers are known.

    Parameters
    ----------
    measured
        The detections in the view.
    result
        The estimated pose, if any, and its residuals.
    edits
        The manual corrections of the view.
    """
    marks = [
        Mark(
            fix.id,
            fix.pixel,
            fix.projected,
            _state(fix),
            fix.by_hand,
            fix.reprojection_px,
            fix.residual_mm,
        )
        for fix in result.fixes
    ]
    known = {mark.id for mark in marks}
    marks += [
        Mark(spot.id, spot.pixel, None, "unused", by_hand=True)
        for spot in edits.named
        if spot.id not in known
    ]
    taken = np.array([mark.pixel for mark in marks]).reshape(-1, 2)
    spots = [
        Mark("", (float(u), float(v)), None, "spot")
        for u, v in measured.blobs.centroids
        if not (np.abs(taken - [u, v]).max(axis=1) < _SAME_PX).any()
    ]
    return (*marks, *spots)


def _state(fix: MarkerObservation) -> MarkState:
    if fix.excluded:
        return "excluded"
    return "used" if fix.used else "unused"


class ImagePanel(Protocol):
    """The image panel as its presenter sees it, with the signals it emits."""

    marker_toggled: Any
    marker_named: Any
    marker_released: Any
    marker_moved: Any
    marker_dropped: Any
    spot_ignored: Any
    region_ignored: Any
    region_searched: Any
    regions_cleared: Any

    def show_picture(self, picture: ByteArray) -> None: ...  # noqa: D102
    def show_markers(  # noqa: D102
        self, marks: Sequence[Mark], ids: Sequence[str], edits: ViewEdits
    ) -> None: ...


class MarkerPresenter:
    """Shows one view at a time, and corrects its markers."""

    def __init__(self, panel: ImagePanel) -> None:
        self._panel = panel
        self._work: SessionEditor | None = None
        self.selected = ""
        """Name of the view being shown."""
        panel.marker_toggled.connect(self.toggle_marker)
        panel.marker_named.connect(self.name_marker)
        panel.marker_released.connect(self.release_marker)
        panel.marker_moved.connect(self.move_marker)
        panel.marker_dropped.connect(self.drop_marker)
        panel.spot_ignored.connect(self.ignore_spot)
        panel.region_ignored.connect(self.ignore_region)
        panel.region_searched.connect(self.search_region)
        panel.regions_cleared.connect(self.clear_regions)

    def take(self, work: SessionEditor | None) -> None:
        """Start on another session; show the first view that needs correction."""
        self._work, self.selected = work, ""
        if work is not None:
            troubled = (name for name in work.names if not work.results[name].used)
            self.choose_view(next(troubled, work.names[0]))

    def choose_view(self, name: str) -> None:
        """Show the image of another view."""
        work = self._work
        if work is not None and name != self.selected and name in work.results:
            self.selected = name
            if name in work.opened.measured:
                self._panel.show_picture(work.opened.measured[name].color)
            self.show()

    def toggle_marker(self, marker: str) -> None:
        """Exclude a marker, or include it again."""
        if marker in self._edits.excluded:
            self._apply(self._edits.with_included(marker), tr("Include {id}").format(id=marker))
        else:
            self._apply(self._edits.with_excluded(marker), tr("Exclude {id}").format(id=marker))

    def name_marker(self, marker: str, pixel: Pixel, exact: bool) -> None:
        """Assign a marker to a detected spot, or place it.

        Parameters
        ----------
        marker
            Id of the marker.
        pixel
            Position in the image.
        exact
            Whether this is the marker's centre; otherwise the centre of the blue spot there is.
        """
        edits = self._edits.with_named(NamedSpot(marker, pixel, exact))
        self._apply(edits, tr("Point at {id}").format(id=marker))

    def release_marker(self, marker: str) -> None:
        """Undo the manual placement of a marker, so that it is detected again."""
        edits = self._edits.without_name(marker).with_included(marker)
        self._apply(edits, tr("Search for {id}").format(id=marker))

    def move_marker(self, marker: str, pixel: Pixel) -> None:
        """Show the residual of a marker while it is dragged."""
        if self._work is not None:
            edits = self._edits.with_named(NamedSpot(marker, pixel, exact=True))
            self._work.preview(self.selected, edits)

    def drop_marker(self, marker: str, pixel: Pixel) -> None:
        """Place a marker where it was dropped."""
        self.name_marker(marker, pixel, exact=True)

    def ignore_spot(self, pixel: Pixel) -> None:
        """Mark a blue spot as no marker."""
        if self._work is not None:
            half = _SPOT_SHARE * self._work.opened.measured[self.selected].color.shape[1]
            u, v = pixel
            corners = ((-half, -half), (half, -half), (half, half), (-half, half))
            region = tuple((u + du, v + dv) for du, dv in corners)
            self._apply(self._edits.with_ignored(region), tr("Ignore a blue spot"))

    def ignore_region(self, region: Region) -> None:
        """Ignore all spots in a region."""
        self._apply(self._edits.with_ignored(region), tr("Ignore a region"))

    def search_region(self, region: Region) -> None:
        """Search for markers in a region only."""
        self._apply(replace(self._edits, searched=region), tr("Search in a region"))

    def clear_regions(self) -> None:
        """Search the whole image again."""
        edits = replace(self._edits, searched=None, ignored=())
        self._apply(edits, tr("Search the whole image"))

    def show(self) -> None:
        """Show the current markers of the view."""
        work = self._work
        if work is None or self.selected not in work.opened.measured:
            return
        measured = work.opened.measured[self.selected]
        system = work.opened.session.manifest.reference_system
        ids = [marker.id for marker in system.facing(measured.view.sensor.faces)]
        marks = marks_of(measured, work.results[self.selected], self._edits)
        self._panel.show_markers(marks, ids, self._edits)

    @property
    def _edits(self) -> ViewEdits:
        return ViewEdits() if self._work is None else self._work.edits.of(self.selected)

    def _apply(self, edits: ViewEdits, sentence: str) -> None:
        if self._work is not None:
            self._work.apply(self._work.edits.with_view(self.selected, edits), sentence)
