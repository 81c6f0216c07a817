"""How much of a USB controller the streams of a camera take, known before they start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from realsense_d400.errors import BandwidthError

USABLE_MB_S = 360.0
"""Of a controller with 5 Gbit/s: 500 MB/s after its encoding, less the protocol and a reserve."""


@dataclass(frozen=True)
class StreamSize:
    """One stream as it passes the cable.

    Parameters
    ----------
    width, height
        px.
    fps
        Pictures per second.
    bytes_per_px
        Two of depth and of colour (YUYV), one of infrared.
    """

    width: int
    height: int
    fps: int
    bytes_per_px: int = 2

    @property
    def mb_s(self) -> float:
        """Return what it takes, MB/s."""
        return self.width * self.height * self.bytes_per_px * self.fps / 1e6


def check_controller(serial: str, wanted: float, taken: Sequence[float]) -> None:
    """Check that a controller has room for a camera.

    Parameters
    ----------
    serial
        Of the camera.
    wanted
        What its streams take, MB/s.
    taken
        What the other cameras of the controller take, MB/s each.

    Raises
    ------
    BandwidthError
    """
    if sum(taken) + wanted <= USABLE_MB_S:
        return
    most = int(USABLE_MB_S // wanted)
    raise BandwidthError(
        f"The USB controller of RealSense {serial} carries {len(taken)} cameras already, and has "
        f"no room for another one: each sends {wanted:.0f} MB/s, so that {most} fit. Plug it into "
        "a port of another controller, for example of an additional USB card."
    )
