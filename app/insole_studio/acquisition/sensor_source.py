"""Where captures come from: the sensors of this computer, or those that a session plays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_studio.acquisition.capture_plan import CaptureStep
from insole_studio.acquisition.capture_setup import (
    CaptureSetup,
    SensorFiles,
    own_setup,
    recorded_setup,
)
from insole_studio.acquisition.driver_values import translating
from insole_studio.acquisition.emulated_rig import EmulatedRig, emulated_bursts, emulated_views
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.warm_up import WarmUps
from kinect_v1.usb_bus import UsbBus, system_bus


@dataclass(frozen=True)
class SensorSource:
    """Creates rig and capture setup; small enough to be passed to another process.

    Parameters
    ----------
    stored
        Calibrations kept on this computer.
    emulate
        A recorded session whose frames are played as live sensors; None for real ones.
    system_file
        File of the reference system; None selects the bundled one.
    warm_up_file
        Where it is kept how long each sensor has been on; None keeps nothing.
    """

    stored: SensorFiles
    emulate: Path | None = None
    system_file: Path | None = None
    warm_up_file: Path | None = None

    @cached_property
    def session(self) -> Session | None:
        """Return the emulated session, if any."""
        return None if self.emulate is None else read_session(self.emulate)

    @cached_property
    def emulated_rig(self) -> EmulatedRig | None:
        """Return the emulated sensors, if any."""
        return None if self.session is None else EmulatedRig(self.session)

    def rig(self) -> Rig:
        """Find the sensors' bus, or create the emulated one.

        Raises
        ------
        InputError
            When the session cannot be read.
        SensorError
            When libusb is missing.
        """
        warm_ups = WarmUps(self.warm_up_file)
        if self.emulated_rig is not None:
            return Rig(UsbBus(self.emulated_rig.bus), warm_ups)
        with translating():
            return Rig(system_bus(), warm_ups)

    def setup(self) -> CaptureSetup:
        """Return the capture setup.

        Raises
        ------
        InputError
        """
        if self.session is not None:
            return recorded_setup(self.stored, self.session)
        return own_setup(self.stored, self.system_file)

    def usual_views(self) -> tuple[tuple[str, str], ...]:
        """Return view and serial number of each emulated view; empty for real sensors."""
        return () if self.session is None else emulated_views(self.session)

    def usual_bursts(self) -> int:
        """Return the number of bursts per view of emulated sensors; one for real sensors."""
        return 1 if self.session is None else emulated_bursts(self.session)

    def put(self, step: CaptureStep) -> None:
        """Move emulated sensors to the positions of a step; the user has moved real ones."""
        if self.emulated_rig is not None:
            for shot in step.shots:
                self.emulated_rig.put(shot.serial, shot.place)
