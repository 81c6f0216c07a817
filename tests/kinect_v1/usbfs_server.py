"""An emulated usbfs with Kinects on it, for the real libusb; see emulated_usbfs.py.

Run by the distribution's own Python, because umockdev's bindings live there; so nothing but the
standard library, GObject, and the emulated device is imported. Reads a scenario (JSON) and prints
the testbed's folder once everything is plugged in. Commands on standard input, one a line: ``unplug
SERIAL``, ``plug SERIAL``, ``end SERIAL`` (of the program that holds it); end of input ends it all.
"""

from __future__ import annotations

import errno
import itertools
import json
import struct
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gi

gi.require_version("UMockdev", "1.0")
from flawed_kinects import build_kinect  # noqa: E402
from gi.repository import GLib, UMockdev  # noqa: E402

from kinect_v1.emulation.device import (  # noqa: E402
    EmulatedCamera,
    EmulatedFunction,
    EmulatedKinect,
    SilentError,
    StallError,
)

ISOCHRONOUS, CONTROL, BULK = 0, 2, 3
CAPABILITIES = 0x15
URB_BYTES, URB_BUFFER, ISO_BYTES = 56, 16, 12
IDLE_MS = 1
ENDPOINTS_PER_CONTROLLER = 2


def _code(direction: int, number: int, size: int) -> int:
    return direction << 30 | size << 16 | ord("U") << 8 | number


REQUESTS = {
    _code(2, 4, 8): "set_interface",
    _code(2, 5, 4): "accept",  # set configuration
    _code(2, 8, 260): "get_driver",
    _code(1, 8, 260): "get_driver",
    _code(2, 10, 56): "submit",
    _code(1, 10, 56): "submit",
    _code(0, 11, 0): "discard",
    _code(1, 12, 8): "reap",
    _code(2, 12, 8): "reap",
    _code(1, 13, 8): "reap",
    _code(2, 13, 8): "reap",
    _code(1, 15, 4): "claim",
    _code(2, 15, 4): "claim",
    _code(1, 16, 4): "release",
    _code(2, 16, 4): "release",
    _code(3, 18, 16): "detach",
    _code(0, 20, 0): "accept",  # reset
    _code(1, 21, 4): "accept",  # clear halt
    _code(2, 21, 4): "accept",
    _code(1, 26, 4): "capabilities",
}


class Urb:
    """A transfer under way, and its memory in the client."""

    def __init__(self, arg: Any) -> None:
        pointer = bytes(arg.retrieve())
        self.address = struct.unpack("<Q", pointer)[0]
        self.memory = arg.resolve(0, URB_BYTES)
        head = struct.unpack("<BBxxiI4xQiiiiiIQ", bytes(self.memory.retrieve()))
        self.kind, self.endpoint = head[0], head[1]
        self.length, self.packet_count = head[5], head[8]
        if self.kind == ISOCHRONOUS:
            arg.reload()  # it would give the short block again
            arg.update(0, pointer)
            self.memory = arg.resolve(0, URB_BYTES + ISO_BYTES * self.packet_count)
        self.buffer = self.memory.resolve(URB_BUFFER, self.length) if self.length else None

    def complete(self, status: int, data: bytes = b"", offset: int = 0) -> Urb:
        """Fill in the result of a control or bulk transfer."""
        if data:
            self.buffer.update(offset, data)
        self._set(status, len(data))
        return self

    def complete_packets(self, packets: list[bytes]) -> Urb:
        """Fill in the result of an isochronous transfer."""
        stride = self.length // self.packet_count
        table = b"".join(struct.pack("<IIi", stride, len(packet), 0) for packet in packets)
        self.memory.update(URB_BYTES, table)
        self.buffer.update(0, b"".join(packet.ljust(stride, b"\0") for packet in packets))
        self._set(0, sum(map(len, packets)))
        return self

    def _set(self, status: int, length: int) -> None:
        self.memory.update(4, struct.pack("<i", status))
        self.memory.update(28, struct.pack("<i", length))


class Controller:
    """Which endpoints hold bandwidth; EHCI keeps it until an alternate setting is selected."""

    def __init__(self) -> None:
        self.reserved: set[tuple[Node, int]] = set()

    def reserve(self, node: Node, endpoint: int) -> bool:
        wanted = self.reserved | {(node, endpoint)}
        if len(wanted) > ENDPOINTS_PER_CONTROLLER or node.refuses(endpoint):
            return False
        self.reserved = wanted
        return True

    def release(self, node: Node) -> None:
        self.reserved = {pair for pair in self.reserved if pair[0] is not node}


class Node:
    """One device node, served."""

    def __init__(self, function: EmulatedFunction, controller: Controller) -> None:
        self.function = function
        self.controller = controller
        self.present = True
        self.kernel_driver = function.kernel_driver
        self.handler = UMockdev.IoctlBase()
        self.handler.connect("handle-ioctl", self.handle)
        self.owner: Any = None
        self.clients: dict[Any, list[Urb]] = {}
        self.breath: dict[Any, bool] = {}

    def refuses(self, endpoint: int) -> bool:
        return isinstance(self.function, EmulatedCamera) and self.function.refuses_stream(endpoint)

    def handle(self, _handler: Any, client: Any) -> bool:
        name = REQUESTS.get(client.get_request() & 0xFFFFFFFF)
        if name is None:
            return False
        urbs = self.clients.setdefault(client, [])
        if not self.present and not (name == "reap" and urbs):
            client.complete(-1, errno.ENODEV)
            return True
        action: Callable[[Any, Any, list[Urb]], int] = getattr(self, name)
        number = action(client, client.get_arg(), urbs)
        if number == errno.EAGAIN:
            GLib.timeout_add(IDLE_MS, lambda: client.complete(-1, errno.EAGAIN))
        else:
            client.complete(-1 if number else 0, number)
        return True

    def accept(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        return 0

    def capabilities(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        arg.resolve(0, 4).update(0, struct.pack("<I", CAPABILITIES))
        return 0

    def get_driver(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        if self.kernel_driver is None:
            return errno.ENODATA
        arg.resolve(0, 260).update(4, self.kernel_driver.encode() + b"\0")
        return 0

    def detach(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        self.kernel_driver = None
        return 0

    def claim(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        others = self.owner is not None and self.owner != client and self.owner.get_connected()
        if self.kernel_driver or others:  # who has ended, however it ended, owns nothing any more
            return errno.EBUSY
        self.owner = client
        return 0

    def release(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        if self.owner == client:
            self.owner = None
        return 0

    def set_interface(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        _interface, alternate = struct.unpack("<II", bytes(arg.resolve(0, 8).retrieve()))
        self.function.select_alternate(alternate)
        self.controller.release(self)
        return 0

    def submit(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        urb = Urb(arg)
        if urb.kind == ISOCHRONOUS and not self.controller.reserve(self, urb.endpoint):
            return errno.ENOSPC
        urb.done = False
        if urb.kind != ISOCHRONOUS:
            try:
                self.transfer(urb)
                urb.done = True
            except StallError:
                urb.complete(-errno.EPIPE)
                urb.done = True
            except SilentError:
                urb.done = False  # until the client gives up
        urbs.append(urb)
        return 0

    def transfer(self, urb: Urb) -> None:
        if urb.kind == BULK and urb.endpoint & 0x80:
            urb.complete(0, self.function.bulk_in())
            return
        data = bytes(urb.buffer.retrieve())
        if urb.kind == BULK:
            self.function.bulk_out(data)
            urb.complete(0)
            urb.memory.update(28, struct.pack("<i", len(data)))
            return
        kind, request, value, _index, length = struct.unpack_from("<BBHHH", data)
        if kind & 0x80:
            urb.complete(0, self.function.control_in(kind, request, value, length), 8)
        else:
            self.function.control_out(kind, request, value, data[8:])
            urb.complete(0)
            urb.memory.update(28, struct.pack("<i", length))

    def discard(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        address = struct.unpack("<Q", bytes(arg.retrieve()))[0]
        for urb in urbs:
            if urb.address == address and not urb.done:
                urb.complete(-errno.ENOENT)
                urb.done = True
                return 0
        return errno.EINVAL

    def reap(self, client: Any, arg: Any, urbs: list[Urb]) -> int:
        urb = self.next_finished(client, urbs)
        if urb is None:
            return errno.EAGAIN
        urbs.remove(urb)
        arg.resolve(0, 8).set_ptr(0, urb.memory)
        return 0

    def next_finished(self, client: Any, urbs: list[Urb]) -> Urb | None:
        """The oldest that is done; else an isochronous one, but let the client breathe between."""
        for urb in urbs:
            if urb.done:
                return urb
        running = [urb for urb in urbs if urb.kind == ISOCHRONOUS]
        if not self.present:
            return urbs[0].complete(-errno.ESHUTDOWN) if urbs else None
        self.breath[client] = not self.breath.get(client, False)
        if not running or not self.breath[client]:
            return None
        first = running[0]
        # Both endpoints keep pace: the one that is less far on comes first.
        return first.complete_packets(self.function.microframes(first.endpoint, first.packet_count))


class Testbed:
    """The emulated /sys and /dev."""

    def __init__(self, scenario: dict[str, Any]) -> None:
        self.testbed = UMockdev.Testbed.new()
        self.scenario = {kinect["serial"]: kinect for kinect in scenario["kinects"]}
        self.controllers: dict[int, Controller] = {}
        self.addresses = itertools.count(2)
        self.hubs: set[str] = set()
        self.plugged: dict[str, list[tuple[str, str, Node]]] = {}
        for serial in self.scenario:
            self.plug(serial)

    def plug(self, serial: str) -> None:
        settings = self.scenario[serial]
        bus = settings["controller"]
        controller = self.controllers.get(bus)
        if controller is None:
            controller = self.controllers[bus] = Controller()
            self.add_device(f"/devices/usb{bus}", f"usb{bus}", bus, 1, hub_descriptors())
        hub = 1 + list(self.scenario).index(serial)
        hub_path = f"/devices/usb{bus}/{bus}-{hub}"
        if hub_path not in self.hubs:
            self.add_device(hub_path, f"{bus}-{hub}", bus, next(self.addresses), hub_descriptors())
            self.hubs.add(hub_path)
        kinect: EmulatedKinect = build_kinect(settings)
        self.plugged[serial] = []
        for port, function in enumerate(kinect.functions(), start=1):
            address = next(self.addresses)
            raw = function.device_descriptor + function.configuration_descriptor
            path = f"{hub_path}/{bus}-{hub}.{port}"
            self.add_device(path, f"{bus}-{hub}.{port}", bus, address, raw)
            node = Node(function, controller)
            name = f"/dev/bus/usb/{bus:03}/{address:03}"
            self.testbed.attach_ioctl(name, node.handler)
            self.testbed.uevent("/sys" + path, "add")
            self.plugged[serial].append((path, name, node))

    def unplug(self, serial: str) -> None:
        for path, _name, node in self.plugged.pop(serial):
            node.present = False
            node.controller.release(node)
            self.testbed.uevent("/sys" + path, "remove")
            self.testbed.remove_device("/sys" + path)

    def end(self, serial: str) -> None:
        """The program that held the sensor was killed; a kernel would know by itself."""
        for _path, _name, node in self.plugged[serial]:
            node.owner = None

    def add_device(self, path: str, name: str, bus: int, address: int, raw: bytes) -> None:
        vendor, product, release = struct.unpack_from("<HHH", raw, 8)
        self.testbed.add_from_string(
            f"P: {path}\n"
            f"N: bus/usb/{bus:03}/{address:03}\n"
            f"E: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM={bus:03}\nE: DEVNUM={address:03}\n"
            f"E: DEVNAME=/dev/bus/usb/{bus:03}/{address:03}\n"
            f"A: busnum={bus}\\n\nA: devnum={address}\\n\nA: speed=480\\n\n"
            f"A: bConfigurationValue=1\\n\nA: bNumInterfaces={raw[22]:2}\\n\n"
            f"A: idVendor={vendor:04x}\\n\nA: idProduct={product:04x}\\n\n"
            f"A: bcdDevice={release:04x}\\n\n"
            f"H: descriptors={raw.hex().upper()}\n"
        )


def hub_descriptors() -> bytes:
    device = struct.pack(
        "<BBHBBBBHHHBBBB", 18, 1, 0x200, 9, 0, 1, 64, 0x1D6B, 0x0002, 0x0510, 0, 0, 0, 1
    )
    head = struct.pack("<BBHBBBBB", 9, 2, 25, 1, 1, 0, 0xE0, 0)
    interface = bytes((9, 4, 0, 0, 1, 9, 0, 0, 0))
    return device + head + interface + struct.pack("<BBBBHB", 7, 5, 0x81, 3, 4, 12)


def serve(scenario_file: str) -> None:
    testbed = Testbed(json.loads(Path(scenario_file).read_text(encoding="utf-8")))
    loop = GLib.MainLoop()

    def obey(source: Any, _condition: Any) -> bool:
        line = source.readline()
        if not line:
            loop.quit()
            return False
        verb, serial = line.split()
        getattr(testbed, verb)(serial)
        print("done", flush=True)
        return True

    GLib.io_add_watch(sys.stdin, GLib.IO_IN | GLib.IO_HUP, obey)
    print(testbed.testbed.get_root_dir(), flush=True)
    loop.run()


if __name__ == "__main__":
    serve(sys.argv[1])
