"""Overlapping isochronous transfers on libusb, which pyusb does not support.

pyusb's own `iso_read` keeps one transfer in flight and loses the packets' lengths. Here many
transfers are queued on pyusb's library, context and handle; one thread per context handles events,
and every transfer is resubmitted from its callback.

The interpreter lock is what endangers streams: a thread that releases it while another thread is
busy waits 5 ms to get it back. So the event thread waits for libusb's file descriptors without the
lock, and then handles everything that is ready in one call that keeps it (`ctypes.PyDLL`);
libusb's own threads never wait for Python while holding a lock that such a call needs.
"""

from __future__ import annotations

import ctypes
import errno
import itertools
import select
import sys
import threading
from dataclasses import dataclass
from typing import Any

import numpy as np

from kinect_v1.errors import (
    BandwidthError,
    KinectError,
    MemoryLimitError,
    TransferError,
    UnpluggedError,
)
from kinect_v1.packets import PacketBlock, PacketReceiver

_ISOCHRONOUS = 1
_COMPLETED, _CANCELLED, _NO_DEVICE = 0, 3, 5
_ERROR_NO_DEVICE, _ERROR_NO_MEMORY = -4, -11
_EVENT_WAIT_MS = 50
_CANCEL_LIMIT_S = 5.0
_NO_MEMORY = (
    "The system grants no memory for another USB stream; raise it with: "
    "echo 64 > /sys/module/usbcore/parameters/usbfs_memory_mb"
)


@dataclass(frozen=True)
class QueueSize:
    """The number of queued transfers and their packets.

    64 packets (8 ms) per transfer survive a busy interpreter lock; 16 transfers bridge 128 ms.
    If the system grants less memory, as many transfers are queued as fit, but at least `least`.
    """

    packets: int = 64
    transfers: int = 16
    least: int = 4


@dataclass(frozen=True)
class StreamTarget:
    """The endpoint to read.

    Parameters
    ----------
    handle
        libusb's device handle.
    endpoint
        Its address.
    packet_bytes
        Largest packet of one microframe.
    bus
        The controller's number, for messages.
    """

    handle: Any
    endpoint: int
    packet_bytes: int
    bus: int


class _Transfer(ctypes.Structure):
    """struct libusb_transfer; pyusb's own declares user_data as a Python object."""


_Callback = ctypes.CFUNCTYPE(None, ctypes.POINTER(_Transfer))
_Transfer._fields_ = [
    ("handle", ctypes.c_void_p),
    ("flags", ctypes.c_uint8),
    ("endpoint", ctypes.c_uint8),
    ("type", ctypes.c_uint8),
    ("timeout", ctypes.c_uint),
    ("status", ctypes.c_int),
    ("length", ctypes.c_int),
    ("actual_length", ctypes.c_int),
    ("callback", _Callback),
    ("user_data", ctypes.c_void_p),
    ("buffer", ctypes.c_void_p),
    ("packet_count", ctypes.c_int),
]
# The packet descriptors follow the last field without padding.
_DESCRIPTORS_OFFSET = _Transfer.packet_count.offset + ctypes.sizeof(ctypes.c_int)


class _TimeValue(ctypes.Structure):
    _fields_ = [("seconds", ctypes.c_long), ("microseconds", ctypes.c_long)]


class _PollFile(ctypes.Structure):
    _fields_ = [("number", ctypes.c_int), ("events", ctypes.c_short)]


def load_library(name: str, *, keep_lock: bool = False) -> Any:
    """Load a separate copy of the bindings, so that argument types do not clash with pyusb's.

    Parameters
    ----------
    name
        File of the library.
    keep_lock
        Whether calls keep the interpreter lock.
    """
    windows = "WinDLL" if sys.platform == "win32" else "CDLL"
    library = getattr(ctypes, "PyDLL" if keep_lock else windows)(name, use_errno=True)
    pointer = ctypes.POINTER(_Transfer)
    library.libusb_alloc_transfer.restype = pointer
    library.libusb_alloc_transfer.argtypes = [ctypes.c_int]
    for function in ("submit", "cancel", "free"):
        getattr(library, f"libusb_{function}_transfer").argtypes = [pointer]
    library.libusb_free_transfer.restype = None
    library.libusb_interrupt_event_handler.argtypes = [ctypes.c_void_p]
    library.libusb_handle_events_timeout_completed.argtypes = [
        ctypes.c_void_p,
        ctypes.POINTER(_TimeValue),
        ctypes.c_void_p,
    ]
    library.libusb_get_pollfds.restype = ctypes.POINTER(ctypes.POINTER(_PollFile))
    library.libusb_get_pollfds.argtypes = [ctypes.c_void_p]
    library.libusb_free_pollfds.argtypes = [ctypes.POINTER(ctypes.POINTER(_PollFile))]
    return library


class EventLoop:
    """The one thread that handles the events of a libusb context while any stream runs.

    Parameters
    ----------
    name
        File of the library.
    """

    def __init__(self, name: str, context: ctypes.c_void_p) -> None:
        self.library = load_library(name)
        self.quick = load_library(name, keep_lock=sys.platform != "win32")
        self._context = context
        self._lock = threading.Lock()
        self._streams = 0
        self._thread: threading.Thread | None = None

    def join_in(self) -> None:
        """Register a stream; the first starts the thread."""
        with self._lock:
            self._streams += 1
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="kinect-usb", daemon=True)
                self._thread.start()

    def leave(self) -> None:
        """Unregister a stream; the last ends the thread."""
        with self._lock:
            self._streams -= 1
            if self._streams == 0 and self._thread is not None:
                self.library.libusb_interrupt_event_handler(self._context)
                self._thread.join()
                self._thread = None

    def _run(self) -> None:
        while self._streams:
            waited = self._wait()
            library, wait_us = (self.quick, 0) if waited else (self.library, _EVENT_WAIT_MS * 1000)
            library.libusb_handle_events_timeout_completed(
                self._context, ctypes.byref(_TimeValue(0, wait_us)), None
            )

    def _wait(self) -> bool:
        """Wait until libusb has events; return False if it has no file descriptors to wait for."""
        files = self.library.libusb_get_pollfds(self._context)
        if not files:
            return False
        poll = select.poll()
        for i in itertools.count():
            if not files[i]:
                break
            poll.register(files[i].contents.number, files[i].contents.events)
        self.library.libusb_free_pollfds(files)
        poll.poll(_EVENT_WAIT_MS)
        return True


class _Slot:
    """One transfer, its buffer, and views of both as arrays."""

    def __init__(self, library: Any, packets: int, packet_bytes: int) -> None:
        self.pointer = library.libusb_alloc_transfer(packets)
        if not self.pointer:
            raise MemoryLimitError(_NO_MEMORY)
        self.buffer = np.zeros((packets, packet_bytes), np.uint8)
        address = ctypes.addressof(self.pointer.contents) + _DESCRIPTORS_OFFSET
        raw = (ctypes.c_uint32 * (3 * packets)).from_address(address)
        self._descriptors = np.ctypeslib.as_array(raw).reshape(packets, 3)
        self._descriptors[:, 0] = packet_bytes

    def block(self) -> PacketBlock:
        """Return a view of the packets that arrived."""
        return PacketBlock(self.buffer, self._descriptors[:, 1], self._descriptors[:, 2] == 0)

    def clear(self) -> None:
        """Clear the lengths of the last round, which a controller that skips a packet leaves."""
        self._descriptors[:, 1:] = 0


class IsochronousStream:
    """A queue of transfers on one endpoint, running from construction to `stop`.

    Parameters
    ----------
    loop
        Event loop of the context that the target's handle belongs to.
    receiver
        Receives the packets.

    Raises
    ------
    BandwidthError, MemoryLimitError, UnpluggedError, TransferError
        When the transfers cannot be queued.
    """

    def __init__(
        self,
        loop: EventLoop,
        target: StreamTarget,
        receiver: PacketReceiver,
        size: QueueSize = QueueSize(),
    ) -> None:
        self._loop = loop
        self._receiver = receiver
        self._target = target
        self._callback = _Callback(self._completed)  # must outlive the transfers
        self._changed = threading.Condition(threading.RLock())
        self._stopping = False
        self._ended = False
        self._slots: dict[int, _Slot] = {}
        self._under_way: set[int] = set()
        loop.join_in()
        try:
            for _ in range(size.transfers):
                key = self._prepare(size.packets)
                error = self._submit(key)
                if isinstance(error, MemoryLimitError) and len(self._under_way) >= size.least:
                    break
                if error is not None:
                    raise error
        except KinectError:
            self.stop()
            raise

    def stop(self) -> None:
        """Cancel all transfers, wait for every callback, free them, and end the thread."""
        library = self._loop.library
        with self._changed:
            if self._stopping:
                return
            self._stopping = True
            for key in tuple(self._under_way):
                library.libusb_cancel_transfer(self._slots[key].pointer)
            if not self._changed.wait_for(lambda: not self._under_way, _CANCEL_LIMIT_S):
                raise TransferError(
                    f"USB transfers on bus {self._target.bus} do not end; unplug the sensor and "
                    "restart the program."
                )
        for slot in self._slots.values():
            library.libusb_free_transfer(slot.pointer)
        self._slots.clear()
        self._loop.leave()

    def _prepare(self, packets: int) -> int:
        slot = _Slot(self._loop.library, packets, self._target.packet_bytes)
        transfer = slot.pointer.contents
        transfer.handle = self._target.handle
        transfer.endpoint = self._target.endpoint
        transfer.type = _ISOCHRONOUS
        transfer.buffer = slot.buffer.ctypes.data
        transfer.length = slot.buffer.nbytes
        transfer.packet_count = packets
        transfer.callback = self._callback
        key = ctypes.addressof(transfer)
        self._slots[key] = slot
        return key

    def _submit(self, key: int) -> KinectError | None:
        """Submit a transfer; to be called before the callbacks start, or with their lock held."""
        with self._changed:
            self._under_way.add(key)
            ctypes.set_errno(0)
            code = self._loop.quick.libusb_submit_transfer(self._slots[key].pointer)
            if code == 0:
                return None
            self._under_way.discard(key)
            return _submit_error(code, ctypes.get_errno(), self._target.bus)

    def _completed(self, pointer: Any) -> None:
        """Pass on a transfer's packets and queue it again; called by libusb."""
        transfer = pointer.contents
        key, status = ctypes.addressof(transfer), transfer.status
        slot = self._slots[key]
        if status not in (_CANCELLED, _NO_DEVICE):
            self._receiver.receive(slot.block())
        reason = self._requeue(key, slot, status)
        if reason is not None:
            self._receiver.end(reason)

    def _requeue(self, key: int, slot: _Slot, status: int) -> KinectError | None:
        """Resubmit a transfer; return why the stream ends here, the first time only."""
        with self._changed:
            self._under_way.discard(key)
            error: KinectError | None = None
            if status == _NO_DEVICE:
                error = unplugged(self._target.bus)
            elif not (self._stopping or self._ended):
                slot.clear()
                error = self._submit(key)
            self._changed.notify_all()
            if error is None or self._stopping or self._ended:
                return None
            self._ended = True
            return error


def unplugged(bus: int) -> UnpluggedError:
    """Return the error that a device has left its bus."""
    return UnpluggedError(
        f"A sensor on USB bus {bus} was unplugged or lost its power; check its plugs, then "
        "capture again."
    )


def _submit_error(code: int, number: int, bus: int) -> KinectError:
    """Return the error that explains why a transfer could not be queued.

    Parameters
    ----------
    code
        libusb's error code.
    number
        The system's errno.
    """
    if code == _ERROR_NO_DEVICE:
        return unplugged(bus)
    if number == errno.ENOSPC:
        return bandwidth_full(bus)
    if code == _ERROR_NO_MEMORY or number == errno.ENOMEM:
        return MemoryLimitError(_NO_MEMORY)
    return TransferError(
        f"The stream of a sensor on USB bus {bus} cannot be started (libusb {code}, system error "
        f"{number}); give each sensor a USB controller of its own."
    )


def bandwidth_full(bus: int) -> BandwidthError:
    """Return the error that a controller is full, with the remedy."""
    return BandwidthError(
        f"The USB controller of bus {bus} is full and cannot carry another stream; plug this "
        "sensor into a controller of its own (for example a PCIe USB card), or stop the other "
        "sensor on that bus first."
    )
