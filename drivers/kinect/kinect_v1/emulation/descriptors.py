"""USB descriptors of a Kinect's functions: as bytes, and as objects that pyusb expects."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from types import SimpleNamespace

from kinect_v1.models import VENDOR

ISOCHRONOUS, BULK = 0x01, 0x02
ISO_PACKET_SIZE = 0x0BC0
"""2 transactions of 960 bytes a microframe."""
MANUFACTURER = "Microsoft"
_DEVICE = (
    "<BBHBBBBHHHBBBB",
    "bLength bDescriptorType bcdUSB bDeviceClass bDeviceSubClass bDeviceProtocol bMaxPacketSize0 "
    "idVendor idProduct bcdDevice iManufacturer iProduct iSerialNumber bNumConfigurations",
)
_PARTS = {
    2: (
        "<BBHBBBBB",
        "bLength bDescriptorType wTotalLength bNumInterfaces bConfigurationValue iConfiguration "
        "bmAttributes bMaxPower",
    ),
    4: (
        "<9B",
        "bLength bDescriptorType bInterfaceNumber bAlternateSetting bNumEndpoints bInterfaceClass "
        "bInterfaceSubClass bInterfaceProtocol iInterface",
    ),
    5: (
        "<BBBBHB",
        "bLength bDescriptorType bEndpointAddress bmAttributes wMaxPacketSize bInterval",
    ),
}


@dataclass(frozen=True)
class Endpoint:
    """A USB endpoint: address, transfer type, wMaxPacketSize."""

    address: int
    attributes: int
    packet_size: int

    def encode(self) -> bytes:
        """Return its descriptor."""
        return struct.pack("<BBBBHB", 7, 5, self.address, self.attributes, self.packet_size, 1)


Interface = tuple[tuple[Endpoint, ...], ...]
"""The endpoints of each alternate setting."""

CAMERA_ENDPOINTS = (
    Endpoint(0x81, ISOCHRONOUS, ISO_PACKET_SIZE),
    Endpoint(0x82, ISOCHRONOUS, ISO_PACKET_SIZE),
)
AUDIO_ENDPOINTS = (Endpoint(0x01, BULK, 512), Endpoint(0x81, BULK, 512))


def device_descriptor(product: int, release: int, *, has_serial: bool = True) -> bytes:
    """Return a device descriptor; strings 1 to 3 are product, manufacturer and serial number.

    Parameters
    ----------
    product, release
        idProduct and bcdDevice.
    """
    return struct.pack(
        "<BBHBBBBHHHBBBB",
        *(18, 1, 0x0200, 0, 0, 0, 64, VENDOR, product, release, 2, 1, 3 if has_serial else 0, 1),
    )


def configuration_descriptor(interfaces: tuple[Interface, ...], power_ma: int) -> bytes:
    """Return the only configuration with all its interfaces and endpoints."""
    body = b""
    for number, alternates in enumerate(interfaces):
        for alternate, endpoints in enumerate(alternates):
            body += bytes((9, 4, number, alternate, len(endpoints), 0xFF, 0xFF, 0xFF, 0))
            body += b"".join(endpoint.encode() for endpoint in endpoints)
    head = (9, 2, 9 + len(body), len(interfaces), 1, 0, 0xC0, power_ma // 2)
    return struct.pack("<BBHBBBBB", *head) + body


def string_descriptor(strings: tuple[str, ...], index: int) -> bytes | None:
    """Return string `index`, counted from 1; 0 lists the languages; None = there is none.

    Parameters
    ----------
    strings
        Product, manufacturer and serial number.
    """
    if index > len(strings):
        return None
    text = struct.pack("<H", 0x0409) if index == 0 else strings[index - 1].encode("utf-16-le")
    return bytes((len(text) + 2, 3)) + text


def _parse(layout: tuple[str, str], raw: bytes) -> SimpleNamespace:
    values = struct.unpack_from(layout[0], raw)
    names = layout[1].split()
    return SimpleNamespace(**dict(zip(names, values, strict=True)), extra_descriptors=[])


def parse_device(raw: bytes) -> SimpleNamespace:
    """Parse a device descriptor."""
    return _parse(_DEVICE, raw)


def _parts(raw: bytes) -> Iterator[SimpleNamespace]:
    while raw:
        yield _parse(_PARTS[raw[1]], raw)
        raw = raw[raw[0] :]


def parse_configuration(raw: bytes) -> SimpleNamespace:
    """Parse a configuration; its `interfaces[number][alternate].endpoints[i]` hold the rest."""
    configuration, *rest = _parts(raw)
    configuration.interfaces = []
    for part in rest:
        if part.bDescriptorType == 4:
            if part.bAlternateSetting == 0:
                configuration.interfaces.append([])
            part.endpoints = []
            configuration.interfaces[-1].append(part)
        else:
            part.bRefresh = part.bSynchAddress = 0
            configuration.interfaces[-1][-1].endpoints.append(part)
    return configuration
