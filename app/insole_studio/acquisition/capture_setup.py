"""The setup of a capture: reference system, volume of interest and sensor calibrations."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, Protocol

from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.calibration.stored_correction import apply_correction
from insole_core.errors import InputError
from insole_core.geometry.side import BOTH, Sides
from insole_core.messages import Message
from insole_core.recording.box import Box
from insole_core.recording.sensor_folder import REFERENCE_FILE
from insole_core.recording.session import DotPictures, ReferenceSystem, Session
from insole_core.resources import resource_path
from insole_core.sensing.infrared_reference import USUAL_SHIFT_PX, InfraredReference, check_owner
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import view_faces
from insole_studio.acquisition.messages import Capability
from insole_studio.acquisition.sensor_port import OpenSensor

DEFAULT_SYSTEM = "reference_systems/lego-20.json"
SYSTEM_FOR_BOTH = "reference_systems/lego-40.json"

Origin = Literal["settings", "recording", "factory"]


class SensorFiles(Protocol):
    """The store of calibrated sensors by serial number."""

    def load(self, serial: str) -> Sensor | None:
        """Read a sensor; None if it was never saved."""
        ...

    def reference(self, serial: str) -> InfraredReference | None:
        """Read the pattern of dots of a sensor; None if it was never learnt."""
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
    dots
        Its pattern of dots, and the shift of its infrared pictures; None if it was never learnt,
        so that no infrared pictures are taken.
    """

    sensor: Sensor
    origin: Origin
    warnings: tuple[str, ...] = ()
    dots: DotPictures | None = None


@dataclass(frozen=True, eq=False)
class CaptureSetup:
    """The surroundings of a capture that are known beforehand.

    Parameters
    ----------
    system
        The markers around the foot, or around both feet.
    stored
        Calibrations kept on this computer.
    volume_of_interest
        Reference frame; None lets the reconstruction find it.
    recorded
        Sensors of the emulated session, by view.
    recorded_dots
        Pattern of dots and shift of the emulated session's pictures, by serial number.
    other
        The system that stands ready for the other number of feet; None where there is none.
    """

    system: ReferenceSystem
    stored: SensorFiles
    volume_of_interest: Box | None = None
    recorded: dict[str, Sensor] = field(default_factory=dict)
    other: ReferenceSystem | None = None
    recorded_dots: dict[str, DotPictures] = field(default_factory=dict)

    def of_side(self, side: Sides) -> CaptureSetup:
        """Return the setup with the reference system for one foot, or for both.

        Raises
        ------
        InputError
            When there is only a system for the other number of feet.
        """
        if (side == BOTH) == bool(self.system.feet):
            return self
        if self.other is not None:
            return replace(self, system=self.other, other=self.system)
        if side == BOTH:
            raise InputError(
                'The reference system "{system}" has a place for one foot only; choose a foot, or '
                "set up the one for two feet, {pair}.",
                system=self.system.name,
                pair=Path(SYSTEM_FOR_BOTH).stem,
            )
        raise InputError(
            'The reference system "{system}" is for both feet; capture both, or set up the one '
            "for one foot, {single}.",
            system=self.system.name,
            single=Path(DEFAULT_SYSTEM).stem,
        )

    def calibrated(self, opened: OpenSensor, view: str, *, learning: bool = False) -> Calibrated:
        """Return the calibration of a sensor for a view: the stored one, else the device's own.

        Parameters
        ----------
        view
            Determines which markers the sensor sees.
        learning
            Whether infrared pictures are taken to learn the pattern of dots.

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
            _check_kind(known.sensor, opened)
        else:
            sensor = opened.factory_sensor(view_faces(view, self.system))
            known = Calibrated(sensor, "factory", (_uncalibrated(sensor),))
        if learning:
            recorded = self.recorded_dots.get(opened.serial)
            shift_px = USUAL_SHIFT_PX if recorded is None else recorded.shift_px
            return replace(known, dots=DotPictures(shift_px=shift_px))
        return self._with_dots(known) if Capability.INFRARED in opened.capabilities else known

    def _with_dots(self, known: Calibrated) -> Calibrated:
        """Add the pattern of dots, or why it cannot be used."""
        serial = known.sensor.serial
        try:
            reference = self.stored.reference(serial)
            if reference is None:
                dots = self.recorded_dots.get(serial)
                return replace(known, dots=dots) if dots and dots.reference else known
            check_owner(REFERENCE_FILE, reference, serial)
        except InputError as error:
            sentence = Message(
                "{reason} No infrared pictures of sensor {serial} were taken; its own depth is "
                "used.",
                reason=error.message,
                serial=serial,
            )
            return replace(known, warnings=(*known.warnings, sentence))
        return replace(
            known, dots=DotPictures(reference=reference, shift_px=reference.record.shift_px)
        )

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


def _check_kind(known: Sensor, opened: OpenSensor) -> None:
    """Check that a calibration is for the frames that a sensor sends.

    Raises
    ------
    InputError
        When it is that of a sensor of another kind with the same serial number.
    """
    sends = opened.factory_sensor(known.faces)
    one, other = ((s.depth_unit_mm, _depth_size(s)) for s in (known, sends))
    if one != other:
        raise InputError(
            "Sensor {serial} is a {model}, but what is stored under its number was calibrated for "
            "a {stored} with other depth pictures; undo that calibration, then calibrate the "
            "sensor.",
            serial=opened.serial,
            model=opened.model,
            stored=known.model,
        )


def _depth_size(sensor: Sensor) -> tuple[int, int]:
    return sensor.depth_camera.width, sensor.depth_camera.height


def _uncalibrated(sensor: Sensor) -> Message:
    if sensor.depth_unit_mm is None:
        return Message(
            "Sensor {serial} is not calibrated; the numbers of its factory are used, which are "
            "several millimetres less exact.",
            serial=sensor.serial,
        )
    return Message(
        "Sensor {serial} is used as its factory calibrated it, with waves of some tenths of a "
        "millimetre on flat surfaces; calibrate the distortion of its depth with walls.",
        serial=sensor.serial,
    )


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
        File of the reference system; None selects the bundled ones, for one foot and for both.

    Raises
    ------
    InputError
    """
    if system_file is not None:
        return CaptureSetup(load_reference_system(system_file), stored)
    single, pair = (
        load_reference_system(resource_path(name)) for name in (DEFAULT_SYSTEM, SYSTEM_FOR_BOTH)
    )
    return CaptureSetup(single, stored, other=pair)


def recorded_setup(
    stored: SensorFiles, session: Session, system_file: Path | None = None
) -> CaptureSetup:
    """Return the setup in which a session was recorded, for its emulated sensors.

    Parameters
    ----------
    stored
        Calibrations kept on this computer.
    session
        The emulated session.
    system_file
        File of another reference system, which has a frame of its own: what lies in the recorded
        one, the box around the foot and the faces that a view sees, is not taken over.

    Raises
    ------
    InputError
        When the file cannot be read.
    """
    manifest = session.manifest
    recorded = {view.name: view.sensor for view in session.views}
    dots = {
        view.sensor.serial: DotPictures(
            reference=None if view.dots.fault else view.dots.reference, shift_px=view.dots.shift_px
        )
        for view in session.views
        if view.dots is not None
    }
    setup = CaptureSetup(
        manifest.reference_system,
        stored,
        manifest.volume_of_interest,
        recorded,
        recorded_dots=dots,
    )
    if system_file is None:
        return setup
    system = load_reference_system(system_file)
    faces = {name: replace(one, faces=view_faces(name, system)) for name, one in recorded.items()}
    return replace(setup, system=system, volume_of_interest=None, recorded=faces)
