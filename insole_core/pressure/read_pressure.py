"""Reads a map of plantar pressure of any device that is known, by its content."""

from __future__ import annotations

from pathlib import Path

from insole_core.errors import InputError
from insole_core.foreign_files import HEAD_BYTES, UNREAD_DEVICES, pressure_device
from insole_core.pressure.emed import is_emed, read_emed
from insole_core.pressure.export_text import read_text
from insole_core.pressure.footscan import is_footscan, read_footscan
from insole_core.pressure.grid_text import read_grid
from insole_core.pressure.pedar import is_pedar, read_pedar
from insole_core.pressure.recording import PITCH_MM, PressureRecording
from insole_core.pressure.tekscan import is_tekscan, read_tekscan
from insole_core.pressure.xsensor import is_xsensor, read_xsensor

SUFFIXES = (".lst", ".asf", ".asc", ".csv", ".txt", ".tsv")
_READERS = (
    (is_emed, read_emed), (is_tekscan, read_tekscan), (is_pedar, read_pedar),
    (is_xsensor, read_xsensor), (is_footscan, read_footscan),
)  # fmt: skip


def read_pressure(path: Path) -> tuple[PressureRecording, ...]:
    """Read all feet of a file.

    Returns
    -------
    tuple of PressureRecording
        One or more; what the file does not say, their `questions` tell.

    Raises
    ------
    InputError
        When it is no map of pressures, is cut off or damaged.
    """
    text = read_text(path)
    device = pressure_device(text[:HEAD_BYTES].encode())
    if device in UNREAD_DEVICES:
        raise InputError(
            "{path} is an export of {device}, a device that is not read; save the map as a table "
            "with a row of numbers for each row of sensors, and open that.",
            path=path,
            device=device,
        )
    reader = next((read for is_it, read in _READERS if is_it(text)), read_grid)
    recordings = reader(path, text)
    for recording in recordings:
        for pitch in recording.pitch_mm or ():
            if not PITCH_MM[0] <= pitch <= PITCH_MM[1]:
                raise InputError(
                    "{path} says that its sensors are {pitch:g} mm apart, and they are {low:g} to "
                    "{high:g} mm apart; export it again.",
                    path=path,
                    pitch=pitch,
                    low=PITCH_MM[0],
                    high=PITCH_MM[1],
                )
    return recordings
