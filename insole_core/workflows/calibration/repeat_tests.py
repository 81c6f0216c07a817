"""The repeat tests of a place: how far measures scatter when a foot is captured again and again.

Stored beside the calibrated sensors, because a test holds for those that captured together.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from insole_core.errors import InputError
from insole_core.evaluation.repeat import Repeated
from insole_core.files.atomic import make_output_folder, write_text
from insole_core.foot.spread import Limits
from insole_core.json_object import JsonObject
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
    serials
        Of the sensors that captured together.
    tested_at
        ISO 8601, UTC.
    captures
    measures
        By the names in `insole_core.foot.measures.DEFINITIONS`.
    """

    serials: frozenset[str]
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

    def of(self, serials: Iterable[str]) -> RepeatTest | None:
        """Return the test of exactly these sensors; None where there is none.

        Raises
        ------
        InputError
            When the file cannot be read, or is of a newer version.
        """
        wanted = frozenset(serials)
        tests = map(_test, self._tests())
        return next((test for test in tests if wanted and test.serials == wanted), None)

    def keep(self, test: RepeatTest) -> Path:
        """Store a test in place of the earlier one of the same sensors; all else stays.

        Raises
        ------
        InputError
            When the file that is there cannot be read, or is of a newer version; it stays as it is.
        OutputError
            When the place cannot be written.
        """
        others = [
            item.values
            for item in self._tests()
            if frozenset(item.texts("serials")) != test.serials
        ]
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
        return root.objects("tests")


def repeated_limits(serials: Iterable[str], sensors: Path | None = None) -> Limits:
    """Return what the repeat test of a set of sensors found; nothing where there is none.

    A file that cannot be read is told in the log: the ± by simulation counts then, and says so.

    Parameters
    ----------
    sensors
        Folder of the calibrated sensors, by default this user's.
    """
    try:
        test = RepeatTests(sensors or sensors_folder_of_user()).of(serials)
    except InputError as error:
        log.warning("the repeat tests cannot be read: %s", error)
        return {}
    return {} if test is None else test.limits


def repeated_limits_of(session: Session) -> Limits:
    """Return what the repeat test of the sensors of a session found."""
    return repeated_limits(session.serials)


def _is_of(item: JsonObject, serials: frozenset[str]) -> bool:
    return frozenset(item.texts("serials")) == serials


def _to_json(test: RepeatTest) -> dict[str, Any]:
    return {
        "serials": sorted(test.serials),
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
        frozenset(item.texts("serials")),
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
