"""Carry out a repeat test: captures of one foot or cast, taken off and put back, and keep it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import combinations
from pathlib import Path

import numpy as np

from insole_core.errors import UsageError
from insole_core.evaluation.repeat import (
    LEAST_CAPTURES,
    MOST_CAPTURES,
    RepeatedCapture,
    RepeatEvaluation,
    evaluate_repeat,
)
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import measure
from insole_core.geometry.side import BOTH
from insole_core.given_file import check_once
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.recording.capture_place import CapturePlace
from insole_core.workflows.calibration.repeat_tests import RepeatTest
from insole_core.workflows.make_foot import MeasuredSession, make_foot, open_session


@dataclass(frozen=True, eq=False)
class RepeatedCaptures:
    """A repeat test that was carried out.

    Parameters
    ----------
    evaluation
    place
        Of all of them.
    warnings
        Of the reconstructions, a sentence each.
    """

    evaluation: RepeatEvaluation
    place: CapturePlace
    warnings: tuple[str, ...]

    @property
    def test(self) -> RepeatTest:
        """What the place keeps of it."""
        return RepeatTest(
            self.place,
            datetime.now(UTC).isoformat(timespec="seconds"),
            len(self.evaluation.captures),
            self.evaluation.measures,
        )


def repeat_captures(paths: Sequence[Path], progress: Progress = SILENT) -> RepeatedCaptures:
    """Make a foot of each capture, and compare the feet.

    Parameters
    ----------
    paths
        Sessions of one foot with the same sensors and markers, three to ten.

    Raises
    ------
    UsageError
        When there are too few or too many, one is named twice or is a copy of another one, or they
        are of two sides, of both feet, or of two places.
    InputError
        When a session violates the format, or the shape is that of the other foot.
    ReconstructionError
        When no view of a session can be used.
    CalibrationError
        When the captures show two different feet.
    Cancelled
    """
    if not LEAST_CAPTURES <= len(paths) <= MOST_CAPTURES:
        raise UsageError(
            "A repeat test takes {least} to {most} captures of the same foot, each taken after the "
            "foot was taken off and put back; {count} are named.",
            least=LEAST_CAPTURES,
            most=MOST_CAPTURES,
            count=len(paths),
        )
    check_once(paths)
    opened = [open_session(path) for path in paths]
    place = opened[0].session.place
    if place is None:
        raise UsageError(
            "{path} does not say the serial numbers of its sensors, so that a test of them would "
            "hold for any; capture with sensors that tell theirs.",
            path=paths[0],
        )
    for other in opened[1:]:
        _check_alike(opened[0], other)
    _check_own(opened)
    captures, warnings = [], []
    for session, part in zip(opened, progress.part(0.0, 0.8).parts(len(opened)), strict=True):
        scan = make_foot(session, progress=part).scan
        measures = measure(scan.foot, find_landmarks(scan.foot))
        captures.append(RepeatedCapture(session.path.name, scan.foot, measures))
        warnings += [
            Message("{name}: {warning}", name=session.path.name, warning=warning)
            for warning in scan.warnings
        ]
    evaluation = evaluate_repeat(captures, progress.part(0.8, 1.0))
    return RepeatedCaptures(evaluation, place, tuple(warnings))


def _check_alike(first: MeasuredSession, other: MeasuredSession) -> None:
    """Check that two sessions are of one side and of one place."""
    manifests = first.session.manifest, other.session.manifest
    for opened, manifest in zip((first, other), manifests, strict=True):
        if manifest.side == BOTH:
            raise UsageError(
                "{path} was recorded with both feet; a repeat test takes one foot.",
                path=opened.path,
            )
    if manifests[0].side != manifests[1].side:
        raise UsageError(
            "{first} is of a {side} foot, but {other} of a {others} one; a repeat test takes the "
            "same foot each time.",
            first=first.path,
            side=str(manifests[0].side),
            other=other.path,
            others=str(manifests[1].side),
        )
    if first.session.serials != other.session.serials:
        raise UsageError(
            "{first} was captured with the sensors {serials}, but {other} with {others}; test each "
            "place on its own.",
            first=first.path,
            serials=joined(first.session.serials),
            other=other.path,
            others=joined(other.session.serials),
        )
    if manifests[0].reference_system != manifests[1].reference_system:
        raise UsageError(
            "{first} and {other} were captured in two different frames of markers; test each place "
            "on its own.",
            first=first.path,
            other=other.path,
        )
    if first.session.place != other.session.place:
        raise UsageError(
            "A sensor was calibrated between {first} and {other}; capture them anew with one "
            "calibration.",
            first=first.path,
            other=other.path,
        )


def _check_own(sessions: Sequence[MeasuredSession]) -> None:
    """Check that no session is a copy: two frames of a sensor are never alike."""
    frames = [[view.read_depth(0) for view in one.session.views] for one in sessions]
    for (one, mine), (other, theirs) in combinations(zip(sessions, frames, strict=True), 2):
        if any(map(np.array_equal, mine, theirs)):
            raise UsageError(
                "{other} is a copy of {one}; take the foot off, put it back, and capture it anew.",
                other=other.path,
                one=one.path,
            )
