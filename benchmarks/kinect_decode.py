"""CPU cost of three Kinects with depth and large colour in the driver, beside libfreenect.

First the driver alone, from the completed USB transfer to the unpacked image, on packets prepared
in memory: CPU time for each second of streaming (limit: 20 % of one core). Then the same streams in
real time, in a separate process as in the application, while a thread keeps the application's
interpreter busy: a stream drops packets if more transfers wait than are queued (limit: no drop).
Then the same with the busy thread in the driver's own process. Finally both drivers on the same
emulated bus, where both figures include the emulated kernel's share.
"""

from __future__ import annotations

import ctypes
import json
import resource
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import numpy as np

from benchmarks._measure import print_table
from kinect_v1.emulation.packet_source import MICROFRAMES_PER_S, FaultPlan, PacketSource
from kinect_v1.emulation.playback import make_footage
from kinect_v1.isochronous import EventLoop, IsochronousStream, QueueSize, StreamTarget
from kinect_v1.models import Model
from kinect_v1.modes import BAYER_1280, DEPTH_11, StreamMode
from kinect_v1.streams import Stream

SENSORS = 3
SECONDS = 4
SIZE = QueueSize()
PACKET_BYTES = 1920
BLOCKS_PER_S = MICROFRAMES_PER_S / SIZE.packets
LIMIT_PERCENT = 20
HARNESS = Path(__file__).resolve().parents[1] / "tests" / "kinect_v1"


class PreparedLibusb:
    """Replaces libusb: every submitted transfer completes as soon as requested."""

    def __init__(self) -> None:
        self.memory: list[Any] = []

    def libusb_alloc_transfer(self, packets: int) -> Any:
        from kinect_v1.isochronous import _Transfer

        self.memory.append(ctypes.create_string_buffer(256 + 12 * packets))
        return ctypes.cast(self.memory[-1], ctypes.POINTER(_Transfer))

    def libusb_submit_transfer(self, _transfer: Any) -> int:
        return 0


class PreparedLoop:
    """Replaces the event loop: this benchmark decides when a transfer completes."""

    def __init__(self) -> None:
        self.library = self.quick = PreparedLibusb()

    def join_in(self) -> None:
        return None


class PreparedStream:
    """One endpoint with a second of packets, to be completed transfer by transfer."""

    def __init__(self, mode: StreamMode, frames: list[bytes]) -> None:
        self.stream = Stream(mode, lambda _frame: None)
        target = StreamTarget(0, mode.kind.endpoint, PACKET_BYTES, bus=1)
        self.engine = IsochronousStream(cast(EventLoop, PreparedLoop()), target, self.stream, SIZE)
        address = ctypes.cast(self.engine._callback, ctypes.c_void_p).value
        assert address is not None
        self.call_back = ctypes.PYFUNCTYPE(None, ctypes.c_void_p)(address)  # keeps the lock
        source = PacketSource(mode, frames, FaultPlan())
        self.blocks = [self._layout(source) for _ in range(int(BLOCKS_PER_S) * SECONDS)]
        self.slots = list(self.engine._slots.values())

    def _layout(self, source: PacketSource) -> tuple[bytes, Any]:
        packets = source.microframes(SIZE.packets)
        lengths = np.array([len(packet) for packet in packets], np.uint32)
        return b"".join(packet.ljust(PACKET_BYTES, b"\0") for packet in packets), lengths

    def fill(self, number: int) -> Any:
        """Put packets into the transfer's memory, as the controller does."""
        data, lengths = self.blocks[number % len(self.blocks)]
        slot = self.slots[number % len(self.slots)]
        slot.buffer.reshape(-1)[:] = np.frombuffer(data, np.uint8)
        slot._descriptors[:, 1] = lengths
        return slot.pointer

    def complete(self, pointer: Any) -> None:
        """Call the callback, as libusb does."""
        self.call_back(pointer)


def prepare_streams() -> list[PreparedStream]:
    generator = np.random.default_rng(1)
    depth = [generator.integers(0, 2048, (480, 640), np.uint16) for _ in range(3)]
    colour = [generator.integers(0, 256, (1024, 1280), np.uint8) for _ in range(3)]
    footage = make_footage(depth, colour)
    modes = (DEPTH_11, BAYER_1280)
    return [PreparedStream(m, footage[m.name]) for m in modes for _ in range(SENSORS)]


def measure_cost(streams: list[PreparedStream]) -> float:
    """Return the CPU time, s, of one second of streaming, without the controller's share."""
    spent = 0.0
    for number in range(len(streams[0].blocks)):
        for stream in streams:
            pointer = stream.fill(number)
            start = time.thread_time()
            stream.complete(pointer)
            spent += time.thread_time() - start
    return spent / SECONDS


@contextmanager
def busy_thread() -> Iterator[None]:
    """Keep this process's interpreter lock busy within a context."""
    stop = threading.Event()

    def keep_busy() -> None:
        while not stop.is_set():
            sum(range(1000))

    thread = threading.Thread(target=keep_busy)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()


def measure_backlog(streams: list[PreparedStream]) -> tuple[int, int]:
    """Stream in real time; return the longest queue, and the number of dropped transfers."""
    start = time.monotonic()
    longest = drops = done = 0
    total = len(streams[0].blocks)
    while done < total:
        due = min(total, int((time.monotonic() - start) * BLOCKS_PER_S))
        longest = max(longest, due - done)
        drops += max(0, due - done - SIZE.transfers)
        for number in range(done, due):
            for stream in streams:
                stream.complete(stream.fill(number))
        done = due
        time.sleep(0.001)
    return longest, drops


def measure_own_process() -> tuple[int, int]:
    """Stream in a child process while this one is busy."""
    call = "import benchmarks.kinect_decode as b; print(*b.measure_backlog(b.prepare_streams()))"
    command = [sys.executable, "-c", call]
    with busy_thread():
        done = subprocess.run(command, check=True, capture_output=True, text=True)
    longest, drops = map(int, done.stdout.split())
    return longest, drops


def measure_processes() -> list[list[str]]:
    """Let both drivers read the same emulated bus; return the CPU time of each per frame pair."""
    sys.path.insert(0, str(HARNESS))
    from emulated_usbfs import SYSTEM_PYTHON, describe_kinect, emulated_usbfs, missing_libfreenect
    from kinect_samples import SERIALS, make_image

    from kinect_v1.pixels import encode_image

    reason = missing_libfreenect()
    if reason:
        print(f"Side by side with libfreenect: skipped, {reason}.")
        return []
    modes = (DEPTH_11, BAYER_1280)
    images = {m.name: [encode_image(make_image(m, i), m) for i in range(3)] for m in modes}
    frames = 10
    clients = {
        "kinect_v1 (this driver)": [sys.executable, HARNESS / "driver_client.py", "stream"],
        "libfreenect": [SYSTEM_PYTHON, HARNESS / "freenect_client.py"],
    }
    rows = []
    for name, command in clients.items():
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            kinects = [
                describe_kinect(folder, Model.XBOX_1414, serial, {serial: images}, controller=i + 1)
                for i, serial in enumerate(SERIALS)
            ]
            cpu_s = []
            with emulated_usbfs(folder, *kinects) as usbfs:
                for wanted in (1, frames):
                    names = {"depth": modes[0].name, "video": modes[1].name}
                    asked = {"frames": wanted, "turns": [dict.fromkeys(SERIALS, names)]}
                    (folder / "request.json").write_text(json.dumps(asked), encoding="utf-8")
                    before = resource.getrusage(resource.RUSAGE_CHILDREN)
                    usbfs.run(*command, folder / "request.json", folder).check_returncode()
                    after = resource.getrusage(resource.RUSAGE_CHILDREN)
                    cpu_s.append(_cpu_s(after) - _cpu_s(before))
        each_ms = 1000 * (cpu_s[1] - cpu_s[0]) / (frames - 1) / SENSORS
        rows.append([name, f"{each_ms:.1f}"])
    return rows


def _cpu_s(usage: resource.struct_rusage) -> float:
    return usage.ru_utime + usage.ru_stime


def main() -> None:
    streams = prepare_streams()
    percent = 100 * measure_cost(streams)
    longest, drops = measure_own_process()
    with busy_thread():
        shared = measure_backlog(streams)
    print_table(
        ["three sensors, depth 30 fps + colour 1280 × 1024", "measured", "limit"],
        [
            ["CPU, % of one core", f"{percent:.1f}", f"{LIMIT_PERCENT}"],
            ["application busy: transfers waiting at most", longest, SIZE.transfers],
            ["application busy: transfers dropped", drops, 0],
            ["driver's own process busy: waiting at most", shared[0], "-"],
            ["driver's own process busy: dropped", shared[1], "-"],
        ],
    )
    rows = measure_processes()
    if rows:
        print_table(["on the emulated bus", "CPU ms a colour frame with three of depth"], rows)
    if percent > LIMIT_PERCENT or drops:
        raise SystemExit(1)
