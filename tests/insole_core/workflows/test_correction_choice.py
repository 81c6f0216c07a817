"""What a proof of the chain decided for sensors is kept, and nothing else is lost."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.errors import InputError
from insole_core.recording.reader import read_session
from insole_core.workflows.calibration.correction_choice import (
    BY_DEFAULT,
    CHOICES_FILE,
    NOT_LEARNT,
    CorrectionChoices,
    Decision,
    choice_for,
)

SESSION = Path(__file__).parents[2] / "data" / "sessions" / "both_small.zip"
ABC, AB = frozenset("ABC"), frozenset("AB")


def decided(serials: frozenset[str], corrected: bool, reason: str = "It does harm.") -> Decision:
    return Decision(serials, corrected, "2026-11-23T08:00:00+00:00", reason)


def test_nothing_decided(tmp_path: Path) -> None:
    assert CorrectionChoices(tmp_path / "none").of("AB") == BY_DEFAULT
    assert BY_DEFAULT.corrected


def test_a_decision_holds_for_its_sensors_and_for_some_of_them(tmp_path: Path) -> None:
    choices = CorrectionChoices(tmp_path / "new")
    choices.keep(decided(ABC, corrected=False))
    chosen = choices.of("CBA")
    assert not chosen.corrected
    assert "A, B, C" in chosen.note
    assert "2026-11-23" in chosen.note
    assert chosen.json() == {"used": "none", "chosen_by": "proof", "reason": "It does harm."}
    assert not choices.of("A").corrected
    assert choices.of("ABCD") == BY_DEFAULT
    choices.keep(decided(AB, corrected=True))
    assert choices.of("A").corrected
    assert not choices.of("AC").corrected
    choices.keep(decided(ABC, corrected=True))
    assert choices.of("AC").corrected
    assert choices.of("AC").note == ""
    assert len(json.loads(choices.path.read_text())["sets"]) == 2


def test_there_is_no_choice_where_nothing_is_learnt(tmp_path: Path) -> None:
    session = read_session(SESSION)
    views = tuple(
        replace(view, sensor=replace(view.sensor, depth_unit_mm=0.1, baseline_mm=55.0))
        for view in session.views
    )
    stereo = replace(session, views=views)
    serials = frozenset(view.sensor.serial for view in views)
    CorrectionChoices(tmp_path).keep(decided(serials, corrected=True))
    chosen = choice_for(stereo, tmp_path)
    assert chosen == chosen.called(None) == NOT_LEARNT
    assert chosen.note == ""
    asked = chosen.called(True)
    assert not asked.corrected
    assert asked.note == asked.json()["reason"] != ""
    assert asked.json() | {"reason": ""} == {"used": "none", "chosen_by": "default", "reason": ""}
    mixed = replace(session, views=(views[0], *session.views[1:]))
    assert choice_for(mixed, tmp_path).called(True).json()["used"] == "learnt"


def test_what_others_wrote_stays(tmp_path: Path) -> None:
    path = tmp_path / CHOICES_FILE
    CorrectionChoices(tmp_path).keep(decided(AB, corrected=True))
    values = json.loads(path.read_text())
    values["clinic"] = "north"
    values["sets"][0]["by"] = "Kim"
    path.write_text(json.dumps(values))
    CorrectionChoices(tmp_path).keep(decided(ABC, corrected=False))
    again = json.loads(path.read_text())
    assert again["clinic"] == "north"
    assert again["sets"][0]["by"] == "Kim"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"format": "insole-correction-choices", "version": 2, "sets": {}}', "newer than this"),
        ("{", CHOICES_FILE),
        ('{"format": "insole-correction-choices", "version": 1, "sets": [{}]}', "serials"),
    ],
)
def test_a_file_of_another_version_survives(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / CHOICES_FILE
    path.write_text(text)
    choices = CorrectionChoices(tmp_path)
    chosen = choices.of("AB")
    assert chosen.corrected
    assert said in chosen.note
    with pytest.raises(InputError, match=said):
        choices.keep(decided(AB, corrected=False))
    assert path.read_text() == text
