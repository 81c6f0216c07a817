"""An emulated USB bus as a pyusb backend: sensors that play frames, without libusb or devices."""

from __future__ import annotations

import errno
import itertools
import threading
import time
from array import array
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import TypeVar

from kinect_v1.emulation.descriptors import parse_configuration, parse_device
from kinect_v1.emulation.device import (
    EmulatedFunction,
    EmulatedKinect,
    SilentError,
    StallError,
)
from kinect_v1.emulation.packet_source import MICROFRAMES_PER_S
from kinect_v1.isochronous import unplugged
from kinect_v1.packets import PacketBlock, PacketReceiver
from kinect_v1.usb_bus import RunningStream, StreamingBackend, UsbError

_BLOCK = 64
_ENDPOINTS_PER_CONTROLLER = 2
"""Bandwidth of an EHCI controller."""
_Answer = TypeVar("_Answer")


@dataclass(eq=False)
class _Plugged:
    """A USB function that is plugged into a port."""

    function: EmulatedFunction
    kinect: EmulatedKinect
    bus: int
    address: int
    ports: tuple[int, ...]
    present: bool = True
    kernel_driver: bool = False
    claimed_by: object = None


@dataclass(eq=False)
class _Handle:
    """A USB function that was opened."""

    plugged: _Plugged


class EmulatedBus(StreamingBackend):
    """A pyusb backend with emulated sensors; pass it to `UsbBus`.

    Parameters
    ----------
    kinects
        The sensors that are plugged in.
    controllers
        The bus number of each sensor; by default each has a controller of its own.
    speed
        Factor on the sensors' clock; 1 = real time, inf = no waiting.
    """

    def __init__(
        self,
        kinects: Sequence[EmulatedKinect],
        controllers: Sequence[int] | None = None,
        speed: float = 1.0,
    ) -> None:
        super().__init__()
        self._speed = speed
        self._addresses = itertools.count(2)
        self._plugged: list[_Plugged] = []
        self._reserved: set[tuple[_Plugged, int]] = set()
        self._lock = threading.RLock()
        self.denied = False
        for kinect, number in zip(kinects, controllers or range(1, len(kinects) + 1), strict=True):
            self.plug(kinect, number)

    def plug(self, kinect: EmulatedKinect, controller: int) -> None:
        """Plug a sensor into a controller, on a hub of its own.

        Parameters
        ----------
        controller
            Its bus number.
        """
        with self._lock:
            hub = 1 + max((p.ports[0] for p in self._plugged if p.bus == controller), default=0)
            for port, function in enumerate(kinect.functions(), start=1):
                address = next(self._addresses)
                taken = function.kernel_driver is not None
                self._plugged.append(
                    _Plugged(function, kinect, controller, address, (hub, port), True, taken)
                )

    def unplug(self, kinect: EmulatedKinect) -> None:
        """Unplug a sensor; its streams end and its registers are lost."""
        with self._lock:
            gone = [p for p in self._plugged if p.kinect is kinect]
            self._plugged = [p for p in self._plugged if p.kinect is not kinect]
            self._reserved = {r for r in self._reserved if r[0] not in gone}
            for plugged in gone:
                plugged.present = False
            kinect.camera.reset()

    def enumerate_devices(self) -> list[_Plugged]:
        """List what is plugged in."""
        with self._lock:
            return list(self._plugged)

    def get_parent(self, dev: _Plugged) -> None:
        """Return None, as hubs are not listed."""

    def get_device_descriptor(self, dev: _Plugged) -> SimpleNamespace:
        """Return the device descriptor, and where the device is."""
        descriptor = parse_device(dev.function.device_descriptor)
        descriptor.bus, descriptor.address, descriptor.speed = dev.bus, dev.address, 3
        descriptor.port_numbers, descriptor.port_number = dev.ports, dev.ports[-1]
        return descriptor

    def get_configuration_descriptor(self, dev: _Plugged, config: int) -> SimpleNamespace:
        """Return the only configuration."""
        if config:
            raise IndexError("there is one configuration")
        return parse_configuration(dev.function.configuration_descriptor)

    def get_interface_descriptor(
        self, dev: _Plugged, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        """Return an alternate setting; IndexError past the last."""
        configuration = self.get_configuration_descriptor(dev, config)
        setting: SimpleNamespace = configuration.interfaces[intf][alt]
        return setting

    def get_endpoint_descriptor(
        self, dev: _Plugged, ep: int, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        """Return an endpoint by its index in the alternate setting."""
        setting = self.get_interface_descriptor(dev, intf, alt, config)
        endpoint: SimpleNamespace = setting.endpoints[ep]
        return endpoint

    def open_device(self, dev: _Plugged) -> _Handle:
        """Open a device."""
        if not dev.present:
            raise _failure(errno.ENODEV)
        if self.denied:
            raise _failure(errno.EACCES)
        return _Handle(dev)

    def close_device(self, dev_handle: _Handle) -> None:
        """Close a device; the interfaces it had claimed are free again."""
        if dev_handle.plugged.claimed_by is dev_handle:
            dev_handle.plugged.claimed_by = None

    def set_configuration(self, dev_handle: _Handle, config_value: int) -> None:
        """Accept the only configuration."""

    def get_configuration(self, dev_handle: _Handle) -> int:
        """Return the active configuration."""
        return 1

    def is_kernel_driver_active(self, dev_handle: _Handle, intf: int) -> bool:
        """Return whether the kernel's driver holds the interface."""
        return dev_handle.plugged.kernel_driver

    def detach_kernel_driver(self, dev_handle: _Handle, intf: int) -> None:
        """Detach the kernel's driver from the interface."""
        dev_handle.plugged.kernel_driver = False

    def claim_interface(self, dev_handle: _Handle, intf: int) -> None:
        """Claim an interface, unless another handle holds it."""
        plugged = dev_handle.plugged
        if not plugged.present:
            raise _failure(errno.ENODEV)
        if plugged.kernel_driver or plugged.claimed_by not in (None, dev_handle):
            raise _failure(errno.EBUSY)
        plugged.claimed_by = dev_handle

    def release_interface(self, dev_handle: _Handle, intf: int) -> None:
        """Release an interface; like EHCI, keep its bandwidth reserved."""
        self.close_device(dev_handle)

    def set_interface_altsetting(self, dev_handle: _Handle, intf: int, altsetting: int) -> None:
        """Select an alternate setting, which frees reserved bandwidth."""
        plugged = dev_handle.plugged
        self._ask(plugged, lambda: plugged.function.select_alternate(altsetting))
        with self._lock:
            self._reserved = {r for r in self._reserved if r[0] is not plugged}

    def ctrl_transfer(  # noqa: PLR0917 - pyusb's signature
        self,
        dev_handle: _Handle,
        bmRequestType: int,
        bRequest: int,
        wValue: int,
        wIndex: int,
        data: array[int],
        timeout: int,
    ) -> int:
        """Pass a control transfer to the device."""
        plugged, function = dev_handle.plugged, dev_handle.plugged.function
        if not bmRequestType & 0x80:
            sent = data.tobytes()
            self._ask(plugged, lambda: function.control_out(bmRequestType, bRequest, wValue, sent))
            return len(sent)
        answer = self._ask(
            plugged, lambda: function.control_in(bmRequestType, bRequest, wValue, len(data))
        )
        return _fill(data, answer)

    def bulk_write(
        self, dev_handle: _Handle, ep: int, intf: int, data: array[int], timeout: int
    ) -> int:
        """Pass a bulk transfer to the device."""
        sent = data.tobytes()
        self._ask(dev_handle.plugged, lambda: dev_handle.plugged.function.bulk_out(sent))
        return len(sent)

    def bulk_read(
        self, dev_handle: _Handle, ep: int, intf: int, buff: array[int], timeout: int
    ) -> int:
        """Pass a bulk transfer from the device."""
        return _fill(buff, self._ask(dev_handle.plugged, dev_handle.plugged.function.bulk_in))

    def start_stream(
        self,
        place: tuple[int, int],
        endpoint: int,
        packet_bytes: int,
        receiver: PacketReceiver,
    ) -> RunningStream:
        """Reserve bandwidth and start to play an endpoint.

        Parameters
        ----------
        place
            Bus and address of the device.
        packet_bytes
            Largest packet of one microframe.
        """
        with self._lock:
            plugged = next((p for p in self._plugged if (p.bus, p.address) == place), None)
            if plugged is None:
                raise _failure(errno.ENODEV)
            if plugged.function.alternate != plugged.kinect.model.streaming_alternate:
                raise _failure(errno.ENOENT)
            self._reserve(plugged, endpoint)
        return _PlayingStream(plugged, endpoint, packet_bytes, receiver, self._speed)

    def _reserve(self, plugged: _Plugged, endpoint: int) -> None:
        beside = {r for r in self._reserved if r[0].bus == plugged.bus} - {(plugged, endpoint)}
        refused = plugged.kinect.camera.refuses_stream(endpoint)
        if refused or len(beside) >= _ENDPOINTS_PER_CONTROLLER:
            raise _failure(errno.ENOSPC)
        self._reserved.add((plugged, endpoint))

    def _ask(self, plugged: _Plugged, request: Callable[[], _Answer]) -> _Answer:
        """Let the device answer one request at a time."""
        with self._lock:
            if not plugged.present:
                raise _failure(errno.ENODEV)
            try:
                return request()
            except StallError as error:
                raise _failure(errno.EPIPE) from error
            except SilentError as error:
                raise _failure(errno.ETIMEDOUT) from error


class _PlayingStream:
    """One endpoint, played by a thread."""

    def __init__(
        self,
        plugged: _Plugged,
        endpoint: int,
        packet_bytes: int,
        receiver: PacketReceiver,
        speed: float,
    ) -> None:
        self._plugged = plugged
        self._endpoint = endpoint
        self._receiver = receiver
        self._block_s = _BLOCK / (MICROFRAMES_PER_S * speed)
        self._packet_bytes = packet_bytes
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._play, name="kinect-emulated", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop; no packet arrives after this returns."""
        self._stopping.set()
        self._thread.join()

    def _play(self) -> None:
        due_s = time.monotonic()
        while not self._stopping.wait(max(0.0, due_s - time.monotonic())):
            if not self._plugged.present:
                self._receiver.end(unplugged(self._plugged.bus))
                return
            self._receiver.receive(self._next_block())
            due_s += self._block_s

    def _next_block(self) -> PacketBlock:
        return self._plugged.function.block(self._endpoint, _BLOCK, self._packet_bytes)


def _fill(data: array[int], answer: bytes) -> int:
    data[: len(answer)] = array("B", answer)
    return len(answer)


def _failure(number: int) -> Exception:
    text = errno.errorcode[number]
    failure: Exception = UsbError(text, None, number)
    return failure
