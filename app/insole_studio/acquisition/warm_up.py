"""How long each sensor has been on, also across restarts of the program.

A sensor keeps its own power when a window closes, so its warm-up goes on where it stopped. It
begins anew after the loss of power, which gives it another address on its bus, after a restart of
the computer, and after a pause in which it cools down.
"""

from __future__ import annotations

import json
import logging
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from insole_core.errors import InputError, OutputError
from insole_core.files.atomic import make_output_folder, write_text
from insole_core.json_object import JsonObject
from insole_studio.acquisition.messages import WARM_UP_S

log = logging.getLogger(__name__)

WARM_UP_FILE = "warm_up.json"
"""Beside the calibrated sensors."""
_SAME_BOOT_S = 60.0
"""The clock of the computer is set by less than this."""
_MOST_S = 1e10


@dataclass(frozen=True)
class _Warmth:
    """When a sensor was on.

    Parameters
    ----------
    bus, address
        Where it was plugged in.
    booted_s
        When the computer was started, `time.time()`.
    since_s, seen_s
        The span in which it was on, `time.monotonic()`, which all programs share.
    """

    bus: int
    address: int
    booted_s: float
    since_s: float
    seen_s: float


class WarmUps:
    """Keeps the warm-up of every sensor in a file.

    Parameters
    ----------
    path
        A JSON file; None keeps nothing.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path

    def since_s(self, serial: str, place: tuple[int, int]) -> float:
        """Return since when a sensor that is opened now has been on, `time.monotonic()`.

        Parameters
        ----------
        place
            Its bus and address.
        """
        now_s, before = time.monotonic(), self._read().get(serial)
        if before is None or (before.bus, before.address) != place:
            return now_s
        pause_s = now_s - before.seen_s
        is_same_boot = abs(before.booted_s - _booted_s()) < _SAME_BOOT_S
        if not is_same_boot or not 0 <= pause_s <= WARM_UP_S:
            return now_s
        return before.since_s + pause_s

    def keep(self, serial: str, place: tuple[int, int], since_s: float) -> None:
        """Note that a sensor is on."""
        if self._path is None:
            return
        warmth = _Warmth(*place, _booted_s(), since_s, time.monotonic())
        known = {key: asdict(value) for key, value in (self._read() | {serial: warmth}).items()}
        try:
            make_output_folder(self._path.parent)
            write_text(json.dumps({"sensors": known}, indent=1) + "\n", self._path)
        except OutputError as error:
            log.warning("the warm-up is not kept: %s", error)

    def _read(self) -> dict[str, _Warmth]:
        if self._path is None or not self._path.exists():
            return {}
        try:
            sensors = JsonObject.read(self._path).object("sensors")
            return {serial: _warmth(sensors.object(serial)) for serial in sensors.values}
        except InputError as error:
            log.warning("the warm-up begins anew: %s", error)
            return {}


def _warmth(item: JsonObject) -> _Warmth:
    return _Warmth(
        item.integer("bus", 0, 10_000),
        item.integer("address", 0, 10_000),
        *(item.number(key, 0, _MOST_S) for key in ("booted_s", "since_s", "seen_s")),
    )


def _booted_s() -> float:
    return time.time() - time.monotonic()
