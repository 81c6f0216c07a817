"""Descriptors as objects with named fields, as pyusb expects them from a backend."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from types import SimpleNamespace

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
