"""The foot stage in a window of its own: from a session to a foot of the open case."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from insole_core.cases.case_record import CaseRecord
from insole_core.geometry.side import Side
from insole_core.reconstruct.poses.pose_quality import RegistrationLimits
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.services.app_services import AppServices
from insole_studio.services.questions import OtherFoot
from insole_studio.services.stage_window import StageWindow

if TYPE_CHECKING:
    from insole_studio.features.foot.stage import FootStage


class FootWindow(StageWindow["FootStage"]):
    """Opens the foot stage for a session."""

    foot_made = Signal(object)
    """Emitted with a `ScannedFoot` for the design stage."""
    unreadable = Signal(object)
    closed = Signal()

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services

    @property
    def shown_stage(self) -> FootStage | None:
        """The stage, unless it is hidden while the foot is still being made."""
        return self.stage if self.stage is not None and self.stage.isVisible() else None

    def open_session(self, path: Path, hand_over: bool = True) -> None:
        """Show the stage with a session; one that is already open is kept.

        Parameters
        ----------
        path
            Folder of the session.
        hand_over
            Whether to pass the foot on to the design stage when it is made.
        """
        if self.stage is not None and self.stage.path == path and not hand_over:
            self.open()
            return
        self.open()
        assert self.stage is not None
        self.stage.open_session(path, hand_over)

    def make_stage(self) -> FootStage:
        """Create the stage with the limits used last."""
        from insole_studio.features.foot.stage import FootStage

        settings = self._services.settings
        return FootStage(
            jobs=self._services.jobs,
            limits=RegistrationLimits(
                residual_mm=settings.largest_residual_mm,
                reprojection_px=settings.largest_reprojection_px,
                displacement_mm=settings.largest_displacement_mm,
            ),
            remember=self._remember_limits,
            ask=self._ask_to_open,
            ask_alone=self._ask_alone,
            ask_side=self._ask_side,
            dark=self._services.dark,
            touch=settings.touch,
        )

    def connect_stage(self, stage: FootStage) -> None:
        """Pass on the feet that the stage makes."""
        stage.foot_made.connect(self.foot_made)
        stage.unreadable.connect(self.unreadable)
        stage.closed.connect(self.closed)

    def note_declined(self, scanned: ScannedFoot) -> None:
        """Tell the stage that a foot which it made was not wanted."""
        if self.stage is not None:
            self.stage.presenter.note_declined(scanned)

    def end_merging(self) -> None:
        """Let the next correction be an undo step of its own."""
        if self.stage is not None:
            self.stage.presenter.end_merging()

    def leave_case(self, coming: CaseRecord) -> bool:
        """Close the stage, whose foot belongs to the case that is left.

        Parameters
        ----------
        coming
            The next case.

        Returns
        -------
        bool
            False if the foot belongs to the next case as well, which it may begin.
        """
        path = None if self.stage is None else self.stage.path
        if any(Path(foot.source.path) == path for foot in coming.feet):
            return False
        self.close()
        return True

    def _remember_limits(self, limits: RegistrationLimits) -> None:
        settings = self._services.settings
        settings.largest_residual_mm = limits.residual_mm
        settings.largest_reprojection_px = limits.reprojection_px
        settings.largest_displacement_mm = limits.displacement_mm

    def _ask_to_open(self, sentence: str) -> bool:
        assert self.stage is not None
        return self._services.messages.questions.on(self.stage).open_anyway(sentence)

    def _ask_side(self, sentence: str, shown: Side) -> OtherFoot:
        assert self.stage is not None
        return self._services.messages.questions.on(self.stage).about_other_foot(sentence, shown)

    def _ask_alone(self, sentence: str, side: Side) -> bool:
        assert self.stage is not None
        return self._services.messages.questions.on(self.stage).make_alone(sentence, side)
