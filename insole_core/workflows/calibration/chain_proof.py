"""Prove the whole chain with captures of an object of known form, and keep what follows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

from insole_core.errors import CalibrationError, UsageError
from insole_core.evaluation.chain import (
    CORRECTIONS,
    Capture,
    ChainEvaluation,
    Correction,
    evaluate_chain,
)
from insole_core.evaluation.chain_section import Verdict, judge
from insole_core.evaluation.known_object import KnownObject, KnownPlaced
from insole_core.evaluation.printed_markers import check_print
from insole_core.geometry.side import BOTH
from insole_core.given_file import check_once
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS
from insole_core.reconstruct.result import Reconstruction
from insole_core.workflows.calibration.correction_choice import CorrectionChoices, Decision
from insole_core.workflows.make_foot import (
    MeasuredSession,
    measure_session,
    open_session,
    reconstruct_session,
)


@dataclass(frozen=True, eq=False)
class ChainProof:
    """A proof, and what follows for its sensors.

    Parameters
    ----------
    evaluation
    verdict
    serials
        Of the sensors, sorted.
    notes
        Views that could not be used, a sentence each.
    is_learnt
        Whether there is a learnt correction for any of the sensors, so that there is a choice.
    """

    evaluation: ChainEvaluation
    verdict: Verdict
    serials: tuple[str, ...]
    notes: tuple[str, ...]
    is_learnt: bool = True

    def keep(self, choices: CorrectionChoices) -> Path:
        """Make the verdict the default for sessions of these sensors.

        Raises
        ------
        InputError
            When the file of the choices cannot be read, or is of a newer version.
        OutputError
            When the place cannot be written.
        """
        now = datetime.now(UTC).isoformat(timespec="seconds")
        corrected = self.verdict.use == "learnt"
        return choices.keep(
            Decision(frozenset(self.serials), corrected, now, str(self.verdict.reason))
        )


def prove_chain(
    paths: Sequence[Path], known: KnownObject, progress: Progress = SILENT
) -> ChainProof:
    """Reconstruct captures of an object with and without correction, and compare with the truth.

    Parameters
    ----------
    paths
        Sessions of the same sensors, at least one; each shows the object in the place of one foot.
    known
        What is known of the object.

    Raises
    ------
    UsageError
        When a session is named twice, or the sessions are of different sensors or of both feet.
    InputError
        When a session violates the format.
    ReconstructionError
        When no view of a session can be used.
    CalibrationError
        When the object is not found, is not what was said, or carries other markers.
    Cancelled
    """
    check_once(paths)
    sessions = [open_session(path) for path in paths]
    serials = _common_serials(sessions)
    choice = sessions[0].correction
    captures: list[Capture] = []
    for path, part in zip(paths, progress.part(0.0, 0.8).parts(len(paths)), strict=True):
        opened = _among_markers(measure_session(path, part.part(0.0, 0.4)), known)
        captures.append(_captured(opened, part.part(0.4, 1.0)))
    progress.step(0.8, "Comparing with the truth")
    evaluation = evaluate_chain(known, captures)
    notes = tuple(note for capture in captures for note in _notes(capture))
    verdict = judge(evaluation) if choice.is_learnt else Verdict("none", True, choice.reason)
    return ChainProof(evaluation, verdict, serials, notes, choice.is_learnt)


def _common_serials(sessions: Sequence[MeasuredSession]) -> tuple[str, ...]:
    """Return the serial numbers of the sensors of all sessions, sorted."""
    for opened in sessions:
        if opened.session.manifest.side == BOTH:
            raise UsageError(
                "{path} was recorded with both feet; capture the object alone, in the place of one "
                "foot.",
                path=opened.path,
            )
    first, *others = (opened.session.serials for opened in sessions)
    for opened, serials in zip(sessions[1:], others, strict=True):
        if serials != first:
            raise UsageError(
                "{first} was captured with the sensors {serials}, but {other} with {others}; prove "
                "each set of sensors on its own.",
                first=sessions[0].path,
                serials=joined(first),
                other=opened.path,
                others=joined(serials),
            )
    return first


def _among_markers(opened: MeasuredSession, known: KnownObject) -> MeasuredSession:
    """Return a session with the markers of the object itself, where it carries any, as printed.

    Raises
    ------
    CalibrationError
        When it was captured among others, or the print is another one than was told.
    """
    if not isinstance(known, KnownPlaced):
        return opened
    manifest = opened.session.manifest
    if manifest.reference_system.name != known.system.name:
        raise CalibrationError(
            "{path} was captured with the reference system {own}, but the body carries that of "
            "{needed}; choose it before the capture, and stand the body alone before the sensors.",
            path=opened.path,
            own=manifest.reference_system.name,
            needed=known.system.name,
        )
    printed = replace(manifest, reference_system=known.system)
    among = replace(opened, session=replace(opened.session, manifest=printed))
    views = [among.placed(view.name, DEFAULT_LIMITS) for view in among.session.views]
    check_print(known, views, opened.path.name)
    return among


def _captured(opened: MeasuredSession, progress: Progress) -> Capture:
    results: dict[Correction, Reconstruction] = {}
    for correction, part in zip(CORRECTIONS, progress.parts(len(CORRECTIONS)), strict=True):
        results[correction] = reconstruct_session(
            opened, progress=part, corrected=correction == "learnt"
        )
    return Capture(
        opened.path.name,
        results,
        {name: measured.points for name, measured in opened.measured.items()},
        opened.box,
    )


def _notes(capture: Capture) -> list[str]:
    return [
        Message("View {view}: {warning}", view=view.name, warning=view.reason)
        for view in capture.reconstructed["none"].views
        if view.reason
    ]
