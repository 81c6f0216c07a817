"""Which cameras are plugged in, as the USB bus tells it: quickly, and without their library."""

from __future__ import annotations

from typing import Any, NamedTuple

import usb.backend.libusb1
import usb.core

_INTEL = 0x8086
PRODUCTS = frozenset({
    0x0AD1, 0x0AD2, 0x0AD3, 0x0AD4, 0x0AD5, 0x0AD6, 0x0AF6, 0x0B03, 0x0B07, 0x0B0C, 0x0B3A, 0x0B4D,
    0x0B5B, 0x0B5C, 0x1155, 0x1156,
})  # fmt: skip
"""Products of the series: D400 to D455, and D421 and D421i."""


class UsbPlace(NamedTuple):
    """Where a camera is plugged in.

    Parameters
    ----------
    bus, address
        As the operating system counts them; another plugging in has another address.
    """

    bus: int
    address: int


def plugged_in() -> frozenset[UsbPlace]:
    """Return where cameras are plugged in; nowhere if the bus cannot be looked at."""
    backend = _libusb()
    if backend is None:
        return frozenset()
    found = usb.core.find(find_all=True, idVendor=_INTEL, backend=backend) or ()
    return frozenset(
        UsbPlace(device.bus, device.address) for device in found if device.idProduct in PRODUCTS
    )


def _libusb() -> Any:
    """Return the system's libusb, else the one that comes with the program; None without any."""
    backend = usb.backend.libusb1.get_backend()
    if backend is not None:
        return backend
    try:
        import libusb_package  # noqa: PLC0415 - only if the system has none
    except ImportError:
        return None
    return libusb_package.get_libusb1_backend()
