"""The setup of a capture: reference system, volume of interest and sensor calibrations."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, Protocol

from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.calibration.stored_correction import apply_correction
from insole_core.messages import Message
from insole_core.recording.box import Box
from insole_core.recording.session import ReferenceSystem, Session
from insole_core.resources import resource_path
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import view_faces
from insole_studio.acquisition.rig import OpenSensor

DEFAULT_SYSTEM = "reference_systems/lego-20.json"

Origin = Literal["settings", "recording", "factory"]


class SensorFiles(Protocol):
    """The store of calibrated sensors by serial number."""

    def load(self, serial: str) -> Sensor | None:
        """Read a sensor; None if it was never saved."""
        ...


@dataclass(frozen=True, eq=False)
class Calibrated:
    """A calibrated sensor, ready for a session.

    Parameters
    ----------
    origin
        Where its calibration comes from: stored on this computer, the recording that an
        emulated sensor plays, or the device itself.
    warnings
        Sentences shown to the user.
    """

    sensor: Sensor
    origin: Origin
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class CaptureSetup:
    """The surroundings of a capture that are known beforehand.

    Parameters
    ----------
    system
        The markers around the foot.
    stored
        Calibrations kept on this computer.
    volume_of_interest
        Reference frame; None lets the reconstruction find it.
    recorded
        Sensors of the emulated session, by view.
    """

    system: ReferenceSystem
    stored: SensorFiles
    volume_of_interest: Box | None = None
    recorded: dict[str, Sensor] = field(default_factory=dict)

    def calibrated(self, opened: OpenSensor, view: str) -> Calibrated:
        """Return the calibration of a sensor for a view: the stored one, else the device's own.

        Parameters
        ----------
        view
            Determines which markers the sensor sees.

        Returns
        -------
        Calibrated
            With the warnings for the user.

        Raises
        ------
        InputError, CalibrationError
            When the stored calibration cannot be used.
        """
        known = self.known(opened.serial, view)
        if known is not None:
            return known
        faces = view_faces(view, self.system)
        sentence = Message(
            "Sensor {serial} is not calibrated; the numbers of its factory are used, which are "
            "several millimetres less exact.",
            serial=opened.serial,
        )
        return Calibrated(opened.factory_sensor(faces), "factory", (sentence,))

    def known(self, serial: str, view: str) -> Calibrated | None:
        """Return the calibration for a serial number and view; None where this setup has none.

        Parameters
        ----------
        view
            Determines which markers the sensor sees.

        Returns
        -------
        Calibrated or None
            None if nothing is stored or recorded.

        Raises
        ------
        InputError, CalibrationError
        """
        stored = self.stored.load(serial)
        if stored is not None:
            return _checked(replace(stored, faces=view_faces(view, self.system)))
        recorded = self._recorded(serial, view)
        return None if recorded is None else Calibrated(recorded, "recording")

    def _recorded(self, serial: str, view: str) -> Sensor | None:
        """Return the sensor of a recorded view; for another view, with the markers it sees."""
        same = self.recorded.get(view)
        if same is not None and same.serial == serial:
            return same
        other = next((s for s in self.recorded.values() if s.serial == serial), None)
        return other and replace(other, faces=view_faces(view, self.system))


def _checked(sensor: Sensor) -> Calibrated:
    if sensor.correction is None:
        return Calibrated(sensor, "settings")
    corrected = apply_correction(sensor, sensor.correction, datetime.now(UTC))
    return Calibrated(corrected.sensor, "settings", corrected.warnings)


def own_setup(stored: SensorFiles, system_file: Path | None = None) -> CaptureSetup:
    """Return the capture setup of this computer.

    Parameters
    ----------
    stored
        Calibrations kept on this computer.
    system_file
        File of the reference system; None selects the bundled one.

    Raises
    ------
    InputError
    """
    system = load_reference_system(system_file or resource_path(DEFAULT_SYSTEM))
    return CaptureSetup(system, stored)


def recorded_setup(stored: SensorFiles, session: Session) -> CaptureSetup:
    """Return the setup in which a session was recorded, for its emulated sensors.

    Parameters
    ----------
    stored
        Calibrations kept on this computer.
    session
        The emulated session.
    """
    manifest = session.manifest
    recorded = {view.name: view.sensor for view in session.views}
    return CaptureSetup(manifest.reference_system, stored, manifest.volume_of_interest, recorded)
