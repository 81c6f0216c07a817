"""The factory calibration stored in a sensor: its values, and their byte encoding."""

from __future__ import annotations

import struct
from dataclasses import asdict, astuple, dataclass
from typing import Any

from kinect_v1.errors import ProtocolError

RGB_DISTANCE_CM = 2.4
"""Replaces the 2.3 that devices report; libfreenect does the same, and it fits better."""

_ZERO_PLANE = struct.Struct("<4f")
_ZERO_PLANE_OFFSET = 92
"""Offset in the data after the error word; 94 in the payload."""
_REGISTRATION = struct.Struct("<29i")
_PADDING = struct.Struct("<3H")
_SHIFT = struct.Struct("<H")


@dataclass(frozen=True)
class ZeroPlane:
    """Geometry of the depth camera, in cm as the device reports it.

    Parameters
    ----------
    emitter_distance_cm
        Baseline from the infrared camera to its projector.
    rgb_distance_cm
        Distance from the infrared to the colour camera.
    reference_distance_cm
        Distance of the plane that the reference pattern was recorded on.
    reference_pixel_cm
        Size of one pixel of a 1280 px wide image on that plane.
    """

    emitter_distance_cm: float
    rgb_distance_cm: float
    reference_distance_cm: float
    reference_pixel_cm: float


@dataclass(frozen=True)
class RegistrationInfo:
    """Coefficients of the two cubic polynomials from depth to colour pixels, as transmitted."""

    dx_center: int
    ax: int
    bx: int
    cx: int
    dx: int
    dx_start: int
    ay: int
    by: int
    cy: int
    dy: int
    dy_start: int
    dx_beta_start: int
    dy_beta_start: int
    rollout_blank: int
    rollout_size: int
    dx_beta_inc: int
    dy_beta_inc: int
    dxdx_start: int
    dxdy_start: int
    dydx_start: int
    dydy_start: int
    dxdxdx_start: int
    dydxdx_start: int
    dxdxdy_start: int
    dydxdy_start: int
    back_comp1: int
    dydydx_start: int
    back_comp2: int
    dydydy_start: int


@dataclass(frozen=True)
class Padding:
    """Number of lines by which the colour image is shifted."""

    start_lines: int
    end_lines: int
    cropping_lines: int


@dataclass(frozen=True)
class Calibration:
    """Everything that the factory measured on one device."""

    zero_plane: ZeroPlane
    registration: RegistrationInfo
    padding: Padding
    constant_shift: int

    @property
    def focal_length_px(self) -> float:
        """Focal length of the 640 px wide depth image."""
        plane = self.zero_plane
        return plane.reference_distance_cm / (2 * plane.reference_pixel_cm)

    def as_dict(self) -> dict[str, Any]:
        """Return plain numbers, for JSON."""
        return asdict(self)


def decode_zero_plane(data: bytes) -> ZeroPlane:
    """Decode the reply to the command for fixed parameters, without its error word."""
    emitter, _rgb, distance, pixel = _unpack(_ZERO_PLANE, data, _ZERO_PLANE_OFFSET)
    return ZeroPlane(emitter, RGB_DISTANCE_CM, distance, pixel)


def decode_registration(data: bytes) -> RegistrationInfo:
    """Decode the 29 numbers of the registration."""
    return RegistrationInfo(*_unpack(_REGISTRATION, data))


def decode_padding(data: bytes) -> Padding:
    """Decode the three line counts."""
    return Padding(*_unpack(_PADDING, data))


def decode_constant_shift(data: bytes) -> int:
    """Decode the constant shift, in quarter pixels of the wide image."""
    (shift,) = _unpack(_SHIFT, data)
    return int(shift)


def _unpack(layout: struct.Struct, data: bytes, offset: int = 0) -> tuple[Any, ...]:
    if len(data) < offset + layout.size:
        raise ProtocolError(
            f"The sensor sent only {len(data)} bytes of its calibration; unplug the sensor and "
            "plug it in again."
        )
    return layout.unpack_from(data, offset)


def encode_zero_plane(plane: ZeroPlane, total_bytes: int) -> bytes:
    """Encode what `decode_zero_plane` decodes; `total_bytes` counts the error word too.

    Parameters
    ----------
    total_bytes
        Length of the reply, error word included; it depends on the model.
    """
    data = bytearray(total_bytes - 2)
    _ZERO_PLANE.pack_into(data, _ZERO_PLANE_OFFSET, *astuple(plane))
    return bytes(data)


def encode_registration(info: RegistrationInfo) -> bytes:
    """Encode what `decode_registration` decodes."""
    return _REGISTRATION.pack(*astuple(info))


def encode_padding(padding: Padding) -> bytes:
    """Encode what `decode_padding` decodes."""
    return _PADDING.pack(*astuple(padding))


def encode_constant_shift(shift: int) -> bytes:
    """Encode what `decode_constant_shift` decodes."""
    return _SHIFT.pack(shift)
