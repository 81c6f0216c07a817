"""The scan that the capture stage works on: its draft on the disk, and how far its views are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from insole_studio.acquisition.messages import CaptureStatus, ViewStatus
from insole_studio.acquisition.unfinished_captures import HeldDraft, read_unfinished


class Scan:
    """A draft and its views; a view that is captured again counts until the new one is complete.

    Parameters
    ----------
    draft
        Held by this window.
    order
        All requested views in order.
    views
        Those that are finished.
    """

    def __init__(
        self, draft: HeldDraft, order: tuple[str, ...], views: Iterable[ViewStatus] = ()
    ) -> None:
        self._draft = draft
        self.order = order
        self._finished = {view.view: view for view in views}

    @property
    def folder(self) -> Path:
        """Return the folder of the draft."""
        return self._draft.folder

    @property
    def finished(self) -> tuple[str, ...]:
        """Return the names of the finished views."""
        return tuple(self._finished)

    @property
    def is_whole(self) -> bool:
        """Whether every requested view is finished."""
        return bool(self._finished) and set(self.order) <= set(self._finished)

    def take(self, status: CaptureStatus) -> None:
        """Add the views that a capture has finished."""
        self._finished |= {view.view: view for view in status.views if view.finished}

    def look_on_disk(self) -> None:
        """Add the views that are on the disk, of a capture that could not tell of its last one."""
        found = read_unfinished(self.folder)
        for view in found.views if found is not None else ():
            self._finished.setdefault(view.view, view)

    def views(self, status: CaptureStatus | None) -> tuple[ViewStatus, ...]:
        """Return all views that are finished or under way.

        Parameters
        ----------
        status
            Of the last capture; the frames of a view that it did not finish were discarded.
        """
        running = status.views if status is not None else ()
        if status is not None and status.phase.is_end:
            running = tuple(view if view.finished else replace(view, frames=0) for view in running)
            running = tuple(v for v in running if v.finished or v.view not in self._finished)
        return tuple({**self._finished, **{view.view: view for view in running}}.values())

    def release(self) -> None:
        """Leave the draft to others."""
        self._draft.release()
