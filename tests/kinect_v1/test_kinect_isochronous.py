"""The engine's bookkeeping, on a stand-in for libusb's transfer functions."""

from __future__ import annotations

import ctypes
import errno
import importlib
from typing import Any

import pytest

from kinect_v1.errors import (
    BandwidthError,
    KinectError,
    MemoryLimitError,
    TransferError,
    UnpluggedError,
)
from kinect_v1.isochronous import IsochronousStream, QueueSize, StreamTarget
from kinect_v1.packets import PacketBlock

TARGET = StreamTarget(handle=0, endpoint=0x82, packet_bytes=1920, bus=7)
SIZE = QueueSize(packets=8, transfers=6, least=3)


class StandInLibusb:
    """Transfers in memory; the first `accepted` submissions succeed, the rest fail."""

    def __init__(self, accepted: int = 1 << 30, code: int = 0, number: int = 0) -> None:
        self.accepted, self.code, self.number = accepted, code, number
        self.memory: dict[int, Any] = {}
        self.submitted: list[int] = []
        self.freed = 0
        self.on_cancel: Any = None

    def libusb_alloc_transfer(self, packets: int) -> Any:
        buffer = ctypes.create_string_buffer(64 + 12 * packets)
        self.memory[ctypes.addressof(buffer)] = buffer
        return ctypes.cast(buffer, ctypes.POINTER(_transfer_type()))

    def libusb_submit_transfer(self, pointer: Any) -> int:
        if len(self.submitted) >= self.accepted:
            ctypes.set_errno(self.number)
            return self.code
        self.submitted.append(ctypes.addressof(pointer.contents))
        return 0

    def libusb_cancel_transfer(self, pointer: Any) -> int:
        self.on_cancel(pointer, 3)
        return 0

    def libusb_free_transfer(self, _pointer: Any) -> None:
        self.freed += 1


def _transfer_type() -> Any:
    return importlib.import_module("kinect_v1.isochronous")._Transfer


class StandInLoop:
    """Counts streams, as the event loop does."""

    def __init__(self, library: StandInLibusb) -> None:
        self.library = self.quick = library
        self.streams = 0

    def join_in(self) -> None:
        self.streams += 1

    def leave(self) -> None:
        self.streams -= 1


class Receiver:
    """Remembers what came."""

    def __init__(self) -> None:
        self.lengths: list[list[int]] = []
        self.reasons: list[KinectError] = []

    def receive(self, block: PacketBlock) -> None:
        self.lengths.append(block.lengths.tolist())

    def end(self, reason: KinectError) -> None:
        self.reasons.append(reason)


def start(library: StandInLibusb) -> tuple[Any, StandInLoop, Receiver]:
    loop, receiver = StandInLoop(library), Receiver()
    stream = IsochronousStream(loop, TARGET, receiver, SIZE)  # type: ignore[arg-type]

    def complete(pointer: Any, status: int) -> None:
        pointer.contents.status = status
        stream._callback(pointer)

    library.on_cancel = complete
    return stream, loop, receiver


def test_all_transfers_are_queued_requeued_cancelled_and_freed() -> None:
    library = StandInLibusb()
    stream, loop, receiver = start(library)
    assert (len(library.submitted), loop.streams) == (6, 1)
    slot = next(iter(stream._slots.values()))
    slot._descriptors[:, 1] = 5
    library.on_cancel(slot.pointer, 0)
    assert receiver.lengths == [[5] * 8]
    assert len(library.submitted) == 7
    assert slot._descriptors[:, 1].tolist() == [0] * 8  # nothing of the last round stays
    stream.stop()
    assert (library.freed, loop.streams) == (6, 0)
    stream.stop()
    assert loop.streams == 0
    assert receiver.reasons == []


@pytest.mark.parametrize(
    ("code", "number", "kind"),
    [
        (-1, errno.ENOSPC, BandwidthError),
        (-1, errno.ENOMEM, MemoryLimitError),
        (-11, 0, MemoryLimitError),
        (-4, 0, UnpluggedError),
        (-1, errno.EIO, TransferError),
    ],
)
def test_a_refused_start_says_why_and_leaves_nothing(
    code: int, number: int, kind: type[KinectError]
) -> None:
    library = StandInLibusb(accepted=0, code=code, number=number)
    loop = StandInLoop(library)
    with pytest.raises(kind) as caught:
        IsochronousStream(loop, TARGET, Receiver(), SIZE)  # type: ignore[arg-type]
    assert "bus 7" in str(caught.value) or kind is MemoryLimitError
    assert loop.streams == 0
    assert library.freed == len(library.memory)


def test_with_little_memory_a_stream_takes_what_it_gets() -> None:
    library = StandInLibusb(accepted=4, code=-1, number=errno.ENOMEM)
    stream, _loop, _receiver = start(library)
    assert len(library.submitted) == 4
    stream.stop()
    assert library.freed == len(library.memory)


def test_the_end_is_told_once() -> None:
    library = StandInLibusb()
    stream, _loop, receiver = start(library)
    for slot in list(stream._slots.values()):
        library.on_cancel(slot.pointer, 5)
    assert [type(reason) for reason in receiver.reasons] == [UnpluggedError]
    stream.stop()


def test_a_failed_requeue_ends_the_stream() -> None:
    library = StandInLibusb(accepted=6, code=-1, number=errno.EIO)
    stream, _loop, receiver = start(library)
    library.on_cancel(next(iter(stream._slots.values())).pointer, 0)
    assert [type(reason) for reason in receiver.reasons] == [TransferError]
    stream.stop()


def test_pyusb_still_has_what_the_engine_stands_on() -> None:
    backend = importlib.import_module("usb.backend.libusb1").get_backend()
    if backend is None:
        backend = importlib.import_module("libusb_package").get_libusb1_backend()
    assert isinstance(backend.lib._name, str)
    assert isinstance(backend.ctx, ctypes.c_void_p)
