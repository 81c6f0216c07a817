"""What somebody corrected by hand before a session is reconstructed, as a value."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from insole_core.messages import Message, joined

if TYPE_CHECKING:
    from insole_core.recording.session import Box

Pixel = tuple[float, float]
"""(u, v) in a view's colour image, px."""
Region = tuple[Pixel, ...]
"""Corners of a polygon in a view's colour image, three or more."""


@dataclass(frozen=True)
class NamedSpot:
    """A marker that somebody pointed at.

    Parameters
    ----------
    id
        Of the marker.
    pixel
    exact
        The marker's centre is this very place; otherwise that of the blue spot which lies there.
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
        Ids of markers that must not determine the pose.
    named
        At most one for each marker; the automatic assignment yields to them.
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
        """Leave a marker out of the pose."""
        return replace(self, excluded=(*self.with_included(marker).excluded, marker))

    def with_included(self, marker: str) -> ViewEdits:
        """Let a marker determine the pose again."""
        return replace(self, excluded=tuple(other for other in self.excluded if other != marker))

    def with_named(self, spot: NamedSpot) -> ViewEdits:
        """Say where a marker is; whatever was said of it, or of that place, before is forgotten."""
        others = tuple(o for o in self.named if o.id != spot.id and o.pixel != spot.pixel)
        return replace(self.with_included(spot.id), named=(*others, spot))

    def without_name(self, marker: str) -> ViewEdits:
        """Leave a marker to the automatic assignment."""
        return replace(self, named=tuple(other for other in self.named if other.id != marker))

    def with_ignored(self, region: Region) -> ViewEdits:
        """Say that a region shows no marker."""
        return replace(self, ignored=(*self.ignored, region))

    @property
    def corrects_markers(self) -> bool:
        """Whether anything was corrected that bears on the pose."""
        return replace(self, off=False) != NO_VIEW_EDITS

    def summary(self) -> str:
        """Say what was corrected, as a part of a sentence."""
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
        Instead of the manifest's.
    """

    views: dict[str, ViewEdits] = field(default_factory=dict)
    volume_of_interest: Box | None = None

    def of(self, view: str) -> ViewEdits:
        """Give the corrections of a view."""
        return self.views.get(view, NO_VIEW_EDITS)

    def with_view(self, view: str, edits: ViewEdits) -> HandEdits:
        """Correct a view otherwise."""
        others = {name: other for name, other in self.views.items() if name != view}
        return replace(self, views=others if edits == NO_VIEW_EDITS else {**others, view: edits})


NO_EDITS = HandEdits()
