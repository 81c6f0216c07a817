"""Manual corrections of a recorded session, as a value."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from insole_core.geometry.side import Side
from insole_core.messages import Message, joined
from insole_core.recording.box import Box

Pixel = tuple[float, float]
"""(u, v) in a view's colour image, px."""
Region = tuple[Pixel, ...]
"""Corners of a polygon in a view's colour image, three or more."""


@dataclass(frozen=True)
class NamedSpot:
    """A marker whose position the user pointed at.

    Parameters
    ----------
    id
        Of the marker.
    exact
        Whether the marker's centre is exactly there; otherwise it is that of the blue spot there.
    """

    id: str
    pixel: Pixel
    exact: bool = False


@dataclass(frozen=True)
class ViewEdits:
    """Corrections of one view.

    Parameters
    ----------
    excluded
        Ids of markers that do not determine the pose.
    named
        At most one for each marker; they override the automatic assignment.
    ignored
        Regions in which no blue spot is a marker.
    searched
        The region outside of which no blue spot is a marker; None for the whole image.
    off
        Whether the view is left out.
    """

    excluded: tuple[str, ...] = ()
    named: tuple[NamedSpot, ...] = ()
    ignored: tuple[Region, ...] = ()
    searched: Region | None = None
    off: bool = False

    def with_excluded(self, marker: str) -> ViewEdits:
        """Exclude a marker from the pose."""
        return replace(self, excluded=(*self.with_included(marker).excluded, marker))

    def with_included(self, marker: str) -> ViewEdits:
        """Include a marker in the pose again."""
        return replace(self, excluded=tuple(other for other in self.excluded if other != marker))

    def with_named(self, spot: NamedSpot) -> ViewEdits:
        """Set the position of a marker, replacing earlier ones of this marker or this pixel."""
        others = tuple(o for o in self.named if o.id != spot.id and o.pixel != spot.pixel)
        return replace(self.with_included(spot.id), named=(*others, spot))

    def without_name(self, marker: str) -> ViewEdits:
        """Return a marker to the automatic assignment."""
        return replace(self, named=tuple(other for other in self.named if other.id != marker))

    def with_ignored(self, region: Region) -> ViewEdits:
        """Add a region that shows no marker."""
        return replace(self, ignored=(*self.ignored, region))

    @property
    def corrects_markers(self) -> bool:
        """Whether any correction affects the pose."""
        return replace(self, off=False) != NO_VIEW_EDITS

    def summary(self) -> str:
        """Return the corrections as a phrase."""
        parts: list[str] = []
        if self.excluded:
            parts.append(Message("{markers} excluded", markers=joined(self.excluded)))
        if self.named:
            named = joined(spot.id for spot in self.named)
            parts.append(Message("{markers} pointed at", markers=named))
        if self.searched is not None or self.ignored:
            parts.append("the search limited to a region")
        return joined(parts)


NO_VIEW_EDITS = ViewEdits()


@dataclass(frozen=True)
class HandEdits:
    """Corrections of one session.

    Parameters
    ----------
    views
        By the name of the view; views without corrections are absent.
    volume_of_interest
        Replaces that of the manifest.
    volumes
        Replace those of the reference system where both feet were captured; each in the foot's
        own frame.
    side
        Which foot a recording of one foot shows, whatever was said as it was made; None for that.
    """

    views: dict[str, ViewEdits] = field(default_factory=dict)
    volume_of_interest: Box | None = None
    volumes: dict[Side, Box] = field(default_factory=dict)
    side: Side | None = None

    def of(self, view: str) -> ViewEdits:
        """Return the corrections of a view."""
        return self.views.get(view, NO_VIEW_EDITS)

    def with_view(self, view: str, edits: ViewEdits) -> HandEdits:
        """Replace the corrections of a view."""
        others = {name: other for name, other in self.views.items() if name != view}
        return replace(self, views=others if edits == NO_VIEW_EDITS else {**others, view: edits})

    def with_volume(self, side: Side, box: Box | None) -> HandEdits:
        """Replace the volume of one of two feet; None for that of the reference system."""
        others = {other: kept for other, kept in self.volumes.items() if other is not side}
        return replace(self, volumes=others if box is None else {**others, side: box})


NO_EDITS = HandEdits()
