"""The log tells of sensors and the database, and nothing of patients."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from insole_core.errors import InputError, Unreachable
from insole_core.messages import Message
from insole_core.records.author import Author
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_studio import log_file
from insole_studio.acquisition.driver_values import translating
from insole_studio.acquisition.sensor_port import SensorError
from insole_studio.cli.main import run
from insole_studio.log_file import FILES, log_to
from kinect_v1.errors import KinectError

NAME = "Zaphodina"
log = logging.getLogger("insole_studio.test")


def test_a_database_and_a_sensor_in_trouble_are_told(tmp_path: Path) -> None:
    path = tmp_path / "logs" / "log"
    place = RecordsPlace.of_url(f"postgresql://clinic@/records?host={tmp_path}", tmp_path)
    with log_to(path):
        for _ in range(3):  # which is said once
            with pytest.raises(Unreachable):
                open_records(place, Author.of_user())
        with pytest.raises(SensorError), translating():
            raise KinectError("Sensor A001 does not answer; plug it in again.")
    database, sensor = path.read_text("utf-8").splitlines()
    assert "ocalhost/records does not answer (connecting: " in database
    assert "No such file or directory" in database
    assert "{" not in database
    assert "Sensor A001 does not answer" in sensor


def test_no_value_of_another_message_is_written(tmp_path: Path) -> None:
    path = tmp_path / "log"
    with log_to(path):
        log.warning("%s cannot be read: %s", f"{NAME}.stl", InputError("{who}", who=NAME))
        log.warning(Message("{who} is in two rows.", who=NAME))
        try:
            raise ValueError(NAME)
        except ValueError as error:
            log.error("a step failed", exc_info=error)
        logging.getLogger("somebody.else").error(NAME)
    text = path.read_text("utf-8")
    assert NAME not in text
    assert "%s cannot be read: %s" in text
    assert "a step failed (ValueError < tests/insole_studio/test_log_file.py:" in text
    log.warning("nothing is written any more")
    assert path.read_text("utf-8") == text


def test_it_is_rotated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(log_file, "MOST_BYTES", 1000)
    with log_to(tmp_path / "log"):
        for number in range(500):
            log.warning(f"sentence {number} of a long day")
    files = list(tmp_path.iterdir())
    assert len(files) == FILES
    assert all(file.stat().st_size <= 1000 for file in files)
    assert "sentence 499 " in (tmp_path / "log").read_text("utf-8")


def test_a_log_that_cannot_be_kept_costs_nothing(tmp_path: Path) -> None:
    (tmp_path / "logs").write_text("a file in its place")
    with log_to(tmp_path / "logs" / "log"):
        log.warning("goes on")


def test_commands_of_the_record_keep_the_log(tmp_path: Path) -> None:
    before = logging.getLogger().handlers.copy()
    assert run(["records", "list", "--record", str(tmp_path / "nothing")]) == 2
    assert logging.getLogger().handlers == before
