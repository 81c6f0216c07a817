"""A session whose sensor carries the correction of another device says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import CorrectionRecord

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"


def corrected_by(session: Session, owner: str) -> Session:
    """The session whose left view is corrected by what was measured on another sensor."""
    left, *others = session.views
    assert left.sensor.correction is not None
    correction = replace(left.sensor.correction, record=CorrectionRecord(owner))
    left = replace(left, sensor=replace(left.sensor, correction=correction))
    return replace(session, views=(left, *others))


@pytest.mark.slow
def test_a_correction_of_another_sensor_in_a_session_is_told(tmp_path: Path) -> None:
    session = read_session(SMALL)
    own = session.views[0].sensor.serial
    write_session(corrected_by(session, "B2"), tmp_path / "session")
    found = reconstruct(read_session(tmp_path / "session"), "thesis")
    sentence = (
        f"the distortion of the depth is corrected by what was measured on sensor B2, not on {own}"
    )
    assert [text for text in found.warnings if text.startswith(f"In the view left {sentence}")]
    assert sentence in found.views[0].reason
    for view in found.views[1:]:
        assert "corrected by what was measured" not in view.reason


@pytest.mark.slow
@pytest.mark.parametrize("owner", ["", None])
def test_the_own_correction_and_one_of_an_unknown_sensor_are_used(owner: str | None) -> None:
    session = read_session(SMALL)
    own = session.views[0].sensor.serial
    found = reconstruct(corrected_by(session, own if owner is None else owner), "thesis")
    assert not [text for text in found.warnings if "was measured on" in text]
