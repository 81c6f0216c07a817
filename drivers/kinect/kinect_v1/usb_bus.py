"""The USB side of the driver: the only file that uses pyusb.

A `UsbBus` finds the functions of sensors; a `UsbFunction` is one of them, opened and claimed. Both
use a pyusb backend that can also run isochronous streams: libusb's, or the emulated bus.
"""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import usb.backend
import usb.backend.libusb1
import usb.control
import usb.core
import usb.util

from kinect_v1.errors import (
    BandwidthError,
    InUseError,
    KinectError,
    LibusbMissingError,
    NoAnswerError,
    NoPermissionError,
    TransferError,
    UnsupportedError,
)
from kinect_v1.isochronous import (
    EventLoop,
    IsochronousStream,
    StreamTarget,
    bandwidth_full,
    unplugged,
)
from kinect_v1.models import PRODUCTS, VENDOR, function_name
from kinect_v1.packets import PacketReceiver

UsbError = usb.core.USBError
"""Raised by backends, including the emulated bus."""

_DEFAULT_PACKET_BYTES = 1920
_TIMEOUT_MS = 1000
_INTERFACE = 0


class RunningStream(Protocol):
    """An isochronous stream that can be stopped."""

    def stop(self) -> None:
        """Stop; no packet arrives after this returns."""
        ...


class StreamingBackend(usb.backend.IBackend):  # type: ignore[misc] # pyusb is untyped
    """A pyusb backend that also runs isochronous streams."""

    def start_stream(
        self,
        place: tuple[int, int],
        endpoint: int,
        packet_bytes: int,
        receiver: PacketReceiver,
    ) -> RunningStream:
        """Start to read an endpoint of the open device at `place` = (bus, address).

        Parameters
        ----------
        packet_bytes
            Largest packet of one microframe.
        """
        raise NotImplementedError


class LibusbBackend:
    """pyusb's libusb backend, which records who claimed what so that streams can use it."""

    def __init__(self, backend: Any) -> None:
        self._backend = backend
        self._loop = EventLoop(backend.lib._name, backend.ctx)
        self._places: dict[Any, tuple[int, int]] = {}
        self._claimed: dict[tuple[int, int], Any] = {}

    def __getattr__(self, name: str) -> Any:
        return getattr(self._backend, name)

    def open_device(self, device: Any) -> Any:
        """Open a device (pyusb's signature)."""
        handle = self._backend.open_device(device)
        descriptor = self._backend.get_device_descriptor(device)
        self._places[handle] = (descriptor.bus, descriptor.address)
        return handle

    def claim_interface(self, handle: Any, interface: int) -> None:
        """Claim an interface (pyusb's signature)."""
        self._backend.claim_interface(handle, interface)
        self._claimed[self._places[handle]] = handle

    def close_device(self, handle: Any) -> None:
        """Close it again (pyusb's signature)."""
        place = self._places.pop(handle)
        if self._claimed.get(place) is handle:
            del self._claimed[place]
        self._backend.close_device(handle)

    def start_stream(
        self,
        place: tuple[int, int],
        endpoint: int,
        packet_bytes: int,
        receiver: PacketReceiver,
    ) -> RunningStream:
        """Queue overlapped transfers.

        Parameters
        ----------
        place
            Bus and address of the device.
        packet_bytes
            Largest packet of one microframe.
        """
        handle = self._claimed[place].handle
        target = StreamTarget(handle, endpoint, packet_bytes, bus=place[0])
        return IsochronousStream(self._loop, target, receiver)


def _load_libusb() -> Any:
    """Load the system's libusb-1.0, else that of the package libusb-package."""
    backend = usb.backend.libusb1.get_backend()
    if backend is not None:
        return backend
    try:
        import libusb_package  # noqa: PLC0415 - only if the system has none
    except ImportError:
        return None
    return libusb_package.get_libusb1_backend()


class UsbBus:
    """All the Kinect functions that a backend can see.

    Parameters
    ----------
    backend
        `LibusbBackend`, or the emulated bus.
    """

    def __init__(self, backend: LibusbBackend | StreamingBackend) -> None:
        self._backend = backend

    def functions(self) -> list[UsbFunction]:
        """Return the cameras, motors and audio functions that are plugged in now."""
        found = usb.core.find(find_all=True, backend=self._backend, idVendor=VENDOR)
        return [UsbFunction(d, self._backend) for d in found if d.idProduct in PRODUCTS]

    def places(self) -> frozenset[tuple[int, int]]:
        """Return bus and address of each function; replugging a sensor changes them."""
        return frozenset((function.bus, function.address) for function in self.functions())


def system_bus() -> UsbBus:
    """Return the real bus of this computer.

    Raises
    ------
    LibusbMissingError
        When there is no libusb-1.0.
    """
    backend = _load_libusb()
    if backend is None:
        raise LibusbMissingError(
            "libusb is missing on this computer; install libusb-1.0 or: pip install libusb-package"
        )
    return UsbBus(LibusbBackend(backend))


class UsbFunction:
    """One USB function of a sensor: its camera, its motor, or its audio function.

    Attributes
    ----------
    product, release
        idProduct and bcdDevice.
    bus, address
        Where it is now; both change when it is plugged in again.
    ports : tuple of int
        The path from the root hub.
    """

    def __init__(self, device: Any, backend: LibusbBackend | StreamingBackend) -> None:
        self._device = device
        self._backend = backend
        self.product: int = device.idProduct
        self.release: int = device.bcdDevice
        self.bus: int = device.bus
        self.address: int = device.address
        self.ports: tuple[int, ...] = tuple(device.port_numbers or ())

    def serial(self) -> str | None:
        """Read the serial number; None if the function has none."""
        index = self._device.iSerialNumber
        if not index:
            return None
        with _translating(self):
            languages = self._read_string(0, 0)
            return self._read_string(index, int.from_bytes(languages[:2], "little")).decode(
                "utf-16-le"
            )

    def _read_string(self, index: int, language: int) -> bytes:
        """Read a string descriptor without its header; pyusb's reader hides the cause of errors."""
        raw = usb.control.get_descriptor(
            self._device, 255, usb.util.DESC_TYPE_STRING, index, language
        )
        return bytes(raw[2 : raw[0]])

    @property
    def place(self) -> str:
        """Port path as the kernel writes it: bus-port.port."""
        return f"{self.bus}-{'.'.join(map(str, self.ports)) or '?'}"

    @property
    def interface_count(self) -> int:
        """Number of interfaces in the active configuration; one in audio without firmware."""
        with _translating(self):
            return int(self._device[0].bNumInterfaces)

    def claim(self) -> None:
        """Claim the function, detaching the kernel's driver."""
        with _translating(self):
            self._detach_kernel_driver()
            self._claim()

    def check_free(self) -> None:
        """Check that no other program holds the function; the kernel's driver may keep it.

        Raises
        ------
        InUseError
        """
        with _translating(self):
            if not self._kernel_driver_active():
                self._claim()
                usb.util.release_interface(self._device, _INTERFACE)

    def _claim(self) -> None:
        try:
            usb.util.claim_interface(self._device, _INTERFACE)
        except UsbError as error:
            if error.errno != errno.ENOENT:
                raise
            raise BandwidthError(
                f"{self._name} could not be set up by the system, most often because its USB "
                "controller is full; plug the sensor into a controller of its own."
            ) from error

    def _kernel_driver_active(self) -> bool:
        """Return whether the kernel's driver holds it; False if the system cannot say."""
        return bool(_where_possible(self._device.is_kernel_driver_active))

    def _detach_kernel_driver(self) -> None:
        if self._kernel_driver_active():
            _where_possible(self._device.detach_kernel_driver)

    def select_alternate(self, alternate: int) -> None:
        """Select an alternate setting; selecting it again frees reserved bandwidth."""
        with _translating(self):
            self._device.set_interface_altsetting(_INTERFACE, alternate)

    def control_out(self, request: int, value: int = 0, data: bytes = b"") -> None:
        """Send a vendor request."""
        with _translating(self):
            sent = self._device.ctrl_transfer(0x40, request, value, 0, data, _TIMEOUT_MS)
        if sent != len(data):
            raise TransferError(f"Only {sent} of {len(data)} bytes reached {self._name}; {_REPLUG}")

    def control_in(self, request: int, length: int) -> bytes:
        """Request at most `length` bytes."""
        with _translating(self):
            return bytes(self._device.ctrl_transfer(0xC0, request, 0, 0, length, _TIMEOUT_MS))

    def bulk_out(self, endpoint: int, data: bytes, timeout_ms: int) -> None:
        """Write to a bulk endpoint."""
        with _translating(self):
            self._device.write(endpoint, data, timeout_ms)

    def bulk_in(self, endpoint: int, length: int, timeout_ms: int) -> bytes:
        """Read from a bulk endpoint.

        Returns
        -------
        bytes
            At most `length`.
        """
        with _translating(self):
            return bytes(self._device.read(endpoint, length, timeout_ms))

    def start_stream(
        self, endpoint: int, alternate: int, receiver: PacketReceiver
    ) -> RunningStream:
        """Start to read an isochronous endpoint."""
        with _translating(self):
            size = self._packet_bytes(endpoint, alternate)
            return self._backend.start_stream((self.bus, self.address), endpoint, size, receiver)

    def _packet_bytes(self, endpoint: int, alternate: int) -> int:
        """Return the bytes per microframe: bits 11 and 12 count additional transactions."""
        interface = self._device[0][(_INTERFACE, alternate)]
        for candidate in interface:
            if candidate.bEndpointAddress == endpoint:
                size = int(candidate.wMaxPacketSize)
                return (size & 0x7FF) * (1 + (size >> 11 & 3)) or _DEFAULT_PACKET_BYTES
        raise UnsupportedError(
            f"{self._name} has no endpoint 0x{endpoint:02x}, so it is no Kinect v1 camera; "
            "unplug it."
        )

    def close(self) -> None:
        """Release the function; does nothing if it is closed or gone already."""
        try:
            usb.util.dispose_resources(self._device)
        except UsbError as error:
            if error.errno != errno.ENODEV:
                raise _translated(error, self) from error

    @property
    def _name(self) -> str:
        return f"The {function_name(self.product)} of the Kinect on USB bus {self.bus}"


_REPLUG = "unplug the sensor and plug it in again."


@contextmanager
def _translating(function: UsbFunction) -> Iterator[None]:
    """Convert pyusb's errors to this driver's."""
    try:
        yield
    except UsbError as error:
        raise _translated(error, function) from error
    except NotImplementedError as error:
        raise TransferError(
            f"{function._name} cannot do this under this operating system; use another computer."
        ) from error


def _where_possible(ask: Callable[[int], object]) -> object:
    """Query the kernel's driver; None if the system cannot, as claiming will show."""
    try:
        return ask(_INTERFACE)
    except (NotImplementedError, UsbError) as error:
        if getattr(error, "errno", None) in (errno.ENODEV, errno.EACCES):
            raise
        return None


def _translated(error: Any, function: UsbFunction) -> KinectError:
    """Return the error that explains a USB error and its remedy in one sentence."""
    name = function._name
    if error.errno in (errno.EACCES, errno.EPERM):
        return NoPermissionError(
            f"{name} may not be opened by this user; copy 70-kinect-v1.rules, which comes with the "
            "program, to /etc/udev/rules.d and plug the sensor in again."
        )
    if error.errno == errno.EBUSY:
        return InUseError(f"{name} is used by another program; close that program first.")
    if error.errno == errno.ENODEV:
        return unplugged(function.bus)
    if error.errno == errno.ENOSPC:
        return bandwidth_full(function.bus)
    if error.errno == errno.ETIMEDOUT:
        return NoAnswerError(f"{name} does not answer; {_REPLUG}")
    return TransferError(f"{name} failed ({error.strerror}); {_REPLUG}")
