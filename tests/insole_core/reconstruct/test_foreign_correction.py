"""A session whose sensor carries the correction of another device says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.reconstruct import reconstruct
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import CorrectionRecord


def corrected_by(session: Session, owner: str) -> Session:
    """The session whose left view is corrected by what was measured on another sensor."""
    left, *others = session.views
    assert left.sensor.correction is not None
    correction = replace(left.sensor.correction, record=CorrectionRecord(owner))
    left = replace(left, sensor=replace(left.sensor, correction=correction))
    return replace(session, views=(left, *others))


def with_heel_alone(session: Session) -> Session:
    """Bound what is joined: what is told here is told of each view before."""
    heel = Box((-50.0, -150.0, -25.0), (50.0, -90.0, 60.0))
    return replace(session, edits=HandEdits(volume_of_interest=heel))


@pytest.mark.slow
def test_a_correction_of_another_sensor_in_a_session_is_told(
    session: Session, tmp_path: Path
) -> None:
    own = session.views[0].sensor.serial
    write_session(corrected_by(session, "B2"), tmp_path / "session")
    found = reconstruct(with_heel_alone(read_session(tmp_path / "session")))
    sentence = (
        f"the distortion of the depth is corrected by what was measured on sensor B2, not on {own}"
    )
    assert [text for text in found.warnings if text.startswith(f"In the view left {sentence}")]
    assert sentence in found.views[0].reason
    for view in found.views[1:]:
        assert "corrected by what was measured" not in view.reason


@pytest.mark.slow
@pytest.mark.parametrize("owner", ["", None])
def test_the_own_correction_and_one_of_an_unknown_sensor_are_used(
    session: Session, owner: str | None
) -> None:
    own = session.views[0].sensor.serial
    found = reconstruct(with_heel_alone(corrected_by(session, own if owner is None else owner)))
    assert not [text for text in found.warnings if "was measured on" in text]
