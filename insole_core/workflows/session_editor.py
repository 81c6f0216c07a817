"""Manual corrections of a session with undo, and the resulting poses of its sensors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from insole_core.errors import OutputError
from insole_core.geometry.side import Side
from insole_core.history import History
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import RegistrationLimits, ViewResult
from insole_core.reconstruct.parallel import for_views
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.workflows.make_foot import MeasuredSession


class SessionEditor:
    """The corrections of one session, saved beside it after every step.

    Parameters
    ----------
    limits
        Beyond which the pose of a view is refused.
    changed
        Called with the names of the views whose pose may have changed.
    """

    def __init__(
        self,
        opened: MeasuredSession,
        limits: RegistrationLimits,
        changed: Callable[[frozenset[str]], None],
        progress: Progress = SILENT,
    ) -> None:
        self.opened = opened
        self.limits = limits
        self.history: History[HandEdits] = History()
        self.trouble = ""
        """Why the corrections could not be saved; empty when they are."""
        self.results: dict[str, ViewResult] = {}
        self._changed = changed

        def place(name: str) -> ViewResult:
            done = self.names.index(name) / len(self.names)
            progress.step(done, "Finding the markers of the view {view}", view=name)
            return opened.placed(name, limits)

        self.results.update(zip(self.names, for_views(place, self.names), strict=True))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the views, in the session's order."""
        return tuple(view.name for view in self.opened.session.views)

    @property
    def edits(self) -> HandEdits:
        """The current corrections."""
        return self.opened.edits

    @property
    def box(self) -> Box:
        """Volume of interest, reference frame."""
        return self.opened.box

    def take_as(self, side: Side) -> None:
        """Take the session of one foot as that of this side, also when it is opened again.

        It is no step of undo: none of the other corrections leads back to the wrong foot.
        """
        self.opened = self.opened.taken_as(side)
        self._save()

    def apply(self, edits: HandEdits, sentence: str, merge_key: str = "") -> None:
        """Replace the corrections, save them and update the poses.

        Parameters
        ----------
        sentence
            Description of the change, for undo.
        merge_key
            Consecutive changes with the same non-empty key are one step of undo.
        """
        if edits != self.edits:
            self.history.push(self.edits, edits, sentence, merge_key)
            self._set(edits)

    def preview(self, view: str, edits: ViewEdits) -> None:
        """Update the pose of a view as if it had these corrections; record and save nothing."""
        shown = self.opened.with_edits(self.edits.with_view(view, edits))
        self.results[view] = shown.placed(view, self.limits)
        self._changed(frozenset([view]))

    def undo(self) -> None:
        """Undo the last correction."""
        self._step_to(self.history.undo())

    def redo(self) -> None:
        """Redo the last undone correction."""
        self._step_to(self.history.redo())

    def set_limits(self, limits: RegistrationLimits) -> None:
        """Change the limits beyond which poses are refused, and update all poses."""
        self.limits = limits
        self._place(frozenset(self.names))

    def _step_to(self, edits: HandEdits | None) -> None:
        if edits is not None:
            self._set(replace(edits, side=self.edits.side))

    def _set(self, edits: HandEdits) -> None:
        before, self.opened = self.opened, self.opened.with_edits(edits)
        self._save()
        self._place(frozenset(n for n in self.names if edits.of(n) != before.edits.of(n)))

    def _save(self) -> None:
        self.trouble = ""
        try:
            write_edits(self.edits, self.opened.path)
        except OutputError as error:
            self.trouble = str(error)

    def _place(self, names: frozenset[str]) -> None:
        for name in names:
            self.results[name] = self.opened.placed(name, self.limits)
        self._changed(names)
