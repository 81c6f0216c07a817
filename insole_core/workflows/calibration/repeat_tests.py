"""The repeat tests of a place: how far measures scatter when a foot is captured again and again.

Stored beside the calibrated sensors, because a test holds for those that captured together.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from insole_core.errors import InputError
from insole_core.evaluation.repeat import Repeated
from insole_core.files.atomic import make_output_folder, write_text
from insole_core.foot.spread import Limits
from insole_core.json_object import JsonObject
from insole_core.recording.capture_place import CapturePlace, place_from_json, place_to_json
from insole_core.recording.session import Session
from insole_core.workflows.calibration.sensor_store import sensors_folder_of_user

REPEAT_TESTS_FILE = "repeat_tests.json"
_FORMAT = "insole-repeat-tests"
_MOST = 1e6
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class RepeatTest:
    """What a repeat test of a set of sensors found.

    Parameters
    ----------
    place
        Of the captures; it says nothing of others.
    tested_at
        ISO 8601, UTC.
    captures
    measures
        By the names in `insole_core.foot.measures.DEFINITIONS`.
    """

    place: CapturePlace
    tested_at: str
    captures: int
    measures: Mapping[str, Repeated]

    @property
    def limits(self) -> Limits:
        """The ± of each measure."""
        return {name: measure.limits_95 for name, measure in self.measures.items()}


class RepeatTests:
    """Storage of the repeat tests, in one file in the folder of the calibrated sensors.

    Parameters
    ----------
    folder
        Of the sensors.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / REPEAT_TESTS_FILE

    def of(self, place: CapturePlace) -> RepeatTest | None:
        """Return the test of exactly these sensors, calibrated so, in this frame; else None.

        Raises
        ------
        InputError
            When the file cannot be read, or is of a newer version.
        """
        tests = map(_test, self._tests())
        return next((test for test in tests if test.place == place), None)

    def keep(self, test: RepeatTest) -> Path:
        """Store a test in place of the earlier one of the same sensors; all else stays.

        Raises
        ------
        InputError
            When the file that is there cannot be read, or is of a newer version; it stays as it is.
        OutputError
            When the place cannot be written.
        """
        sensors = test.place.sensors
        others = [one.values for one in self._tests() if _place(one).sensors != sensors]
        root = JsonObject.read(self.path).values if self.path.exists() else {}
        values = {**root, "format": _FORMAT, "version": 1, "tests": [*others, _to_json(test)]}
        make_output_folder(self.path.parent)
        write_text(json.dumps(values, indent=1, ensure_ascii=False) + "\n", self.path)
        return self.path

    def _tests(self) -> list[JsonObject]:
        if not self.path.exists():
            return []
        root = JsonObject.read(self.path)
        root.check_format(_FORMAT)
        return [test for test in root.objects("tests") if test.has("place")]  # others hold nowhere


def repeated_limits(place: CapturePlace | None, sensors: Path | None = None) -> Limits:
    """Return what the repeat test of a place found; nothing where there is none.

    It holds until one of the sensors is calibrated again, and for its frame of markers only. A file
    that cannot be read is told in the log: the ± by simulation counts then, and says so.

    Parameters
    ----------
    place
        None where it is not known.
    sensors
        Folder of the calibrated sensors, by default this user's.
    """
    if place is None:
        return {}
    try:
        test = RepeatTests(sensors or sensors_folder_of_user()).of(place)
    except InputError as error:
        log.warning("the repeat tests cannot be read: %s", error)
        return {}
    return {} if test is None else test.limits


def repeated_limits_of(session: Session) -> Limits:
    """Return what the repeat test of the place of a session found."""
    return repeated_limits(session.place)


def _place(item: JsonObject) -> CapturePlace:
    return place_from_json(item.object("place"))


def _to_json(test: RepeatTest) -> dict[str, Any]:
    return {
        "place": place_to_json(test.place),
        "tested_at": test.tested_at,
        "captures": test.captures,
        "measures": {
            name: {
                "deviation": round(one.deviation, 4),
                "limits_95": round(one.limits_95, 4),
                "captures": one.captures,
            }
            for name, one in test.measures.items()
        },
    }


def _test(item: JsonObject) -> RepeatTest:
    measures = item.object("measures")
    found = {name: measures.object(name) for name in measures.values}
    return RepeatTest(
        _place(item),
        item.date("tested_at"),
        item.integer("captures", 2, 1000),
        {
            name: Repeated(
                one.number("deviation", 0, _MOST),
                one.number("limits_95", 0, _MOST),
                one.integer("captures", 2, 1000),
            )
            for name, one in found.items()
        },
    )
