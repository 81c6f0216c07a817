"""The assembler: whatever happens on the way, no wrong pixel is delivered."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kinect_v1.emulation.packet_source import Fault, FaultPlan, PacketSource
from kinect_v1.modes import BAYER_1280, DEPTH_11, MODES, VIDEO, StreamMode
from kinect_v1.packets import FrameAssembler, PacketBlock

SMALL = replace(
    DEPTH_11, name="small", width=16, height=8, kind=replace(DEPTH_11.kind, payload_bytes=20)
)
"""176 bytes in 9 packets, the last one short."""
ROUND = replace(SMALL, name="round", kind=replace(SMALL.kind, payload_bytes=11))
"""16 packets, a divisor of the sequence's 256."""
LONG = replace(SMALL, name="long", height=256, kind=replace(VIDEO, payload_bytes=16))
"""352 packets: more than the sequence can count."""


def make_block(packets: list[bytes]) -> PacketBlock:
    buffer = np.full((len(packets), 1920), 0xEE, np.uint8)
    for row, packet in zip(buffer, packets, strict=True):
        row[: len(packet)] = np.frombuffer(packet, np.uint8)
    lengths = np.array([len(packet) for packet in packets], np.uint32)
    return PacketBlock(buffer, lengths, np.ones(len(packets), bool))


def make_frames(mode: StreamMode, count: int) -> list[bytes]:
    generator = np.random.default_rng(7)
    return [generator.bytes(mode.frame_bytes) for _ in range(count)]


def make_packets(mode: StreamMode, frames: list[bytes], *faults: Fault) -> list[bytes]:
    """All packets of the frames after an incomplete first one, without idle microframes."""
    plan = FaultPlan()
    for fault in faults:
        plan.inject(fault)
    source = PacketSource(replace(mode, fps=100_000.0), frames, plan)
    wanted = mode.packets - mode.packets // 2 + mode.packets * len(frames)
    return source.microframes(wanted)


def assemble(
    mode: StreamMode, packets: list[bytes], cuts: list[int]
) -> tuple[list[bytes], FrameAssembler]:
    assembler = FrameAssembler(mode)
    got = []
    edges = [0, *sorted(cuts), len(packets)]
    for start, stop in pairwise(edges):
        got += [f.data.tobytes() for f in assembler.feed(make_block(packets[start:stop]))]
    return got, assembler


@pytest.mark.parametrize("mode", MODES.values(), ids=MODES)
def test_every_mode_comes_through_bit_for_bit(mode: StreamMode) -> None:
    frames = make_frames(mode, 2)
    got, assembler = assemble(mode, make_packets(mode, frames), [100, 333])
    assert got == frames
    assert (assembler.discarded, assembler.lost_packets) == (0, 0)


def test_geometry_is_that_of_the_device() -> None:
    sizes = {m.name: (m.frame_bytes, m.packets, m.last_payload_bytes) for m in MODES.values()}
    assert sizes == {
        "depth-11": (422_400, 242, 1132),
        "depth-10": (384_000, 220, 1188),
        "bayer-640x480": (307_200, 162, 12),
        "bayer-1280x1024": (1_310_720, 687, 1832),
        "ir-640x488": (390_400, 205, 1168),
        "ir-1280x1024": (1_638_400, 859, 1336),
    }


@pytest.mark.parametrize("count", range(1, 21))
@pytest.mark.parametrize("mode", [DEPTH_11, BAYER_1280], ids=["depth", "colour"])
def test_lost_packets_cost_exactly_their_frame(mode: StreamMode, count: int) -> None:
    frames = make_frames(mode, 4)
    first = mode.packets - mode.packets // 2 + mode.packets  # of the second frame
    fault = Fault("lost", "depth", at=first + 50, count=count)
    got, assembler = assemble(mode, make_packets(mode, frames, fault), [])
    assert got == [frames[0], frames[2], frames[3]]
    assert (assembler.discarded, assembler.lost_packets) == (1, count)


@pytest.mark.parametrize("kind", ["packet magic", "flag", "short", "repeated"])
@pytest.mark.parametrize("place", [0, 1, 100, -1])
def test_a_damaged_packet_costs_exactly_its_frame(kind: str, place: int) -> None:
    frames = make_frames(DEPTH_11, 4)
    first = DEPTH_11.packets - DEPTH_11.packets // 2 + DEPTH_11.packets
    at = first + place % DEPTH_11.packets
    packets = make_packets(DEPTH_11, frames, Fault(kind, "depth", at))
    got, assembler = assemble(DEPTH_11, packets, [])
    assert got == [frames[0], frames[2], frames[3]]
    begun = 2 if (kind, place) == ("repeated", 1) else 1  # a first packet twice: two beginnings
    assert assembler.discarded == begun


@pytest.mark.parametrize("place", [0, -1])
def test_a_lost_first_or_last_packet(place: int) -> None:
    frames = make_frames(DEPTH_11, 4)
    first = DEPTH_11.packets - DEPTH_11.packets // 2 + DEPTH_11.packets
    fault = Fault("lost", "depth", first + place % DEPTH_11.packets)
    got, assembler = assemble(DEPTH_11, make_packets(DEPTH_11, frames, fault), [])
    assert got == [frames[0], frames[2], frames[3]]
    assert assembler.discarded == 1


def test_a_gap_over_a_frame_end_costs_both_frames() -> None:
    frames = make_frames(DEPTH_11, 4)
    first = DEPTH_11.packets - DEPTH_11.packets // 2 + 2 * DEPTH_11.packets
    fault = Fault("lost", "depth", first - 5, count=10)
    got, assembler = assemble(DEPTH_11, make_packets(DEPTH_11, frames, fault), [])
    assert got == [frames[0], frames[3]]
    assert assembler.discarded == 2


def test_packets_the_controller_reports_as_bad_are_not_used() -> None:
    frames = make_frames(SMALL, 2)
    block = make_block(make_packets(SMALL, frames))
    block.good[SMALL.packets] = False  # in the first whole frame
    assembler = FrameAssembler(SMALL)
    assert [frame.data.tobytes() for frame in assembler.feed(block)] == [frames[1]]


def test_an_interruption_discards_the_frame_in_progress() -> None:
    frames = make_frames(SMALL, 2)
    packets = make_packets(SMALL, frames)
    assembler = FrameAssembler(SMALL)
    assert not assembler.feed(make_block(packets[:10]))
    assembler.interrupt()
    rest = assembler.feed(make_block(packets[10:]))
    assert [frame.data.tobytes() for frame in rest] == [frames[1]]
    assert assembler.discarded == 1


def test_idle_and_tiny_packets_are_ignored() -> None:
    frames = make_frames(SMALL, 2)
    packets = [p for packet in make_packets(SMALL, frames) for p in (b"", packet, b"RB\0")]
    assert assemble(SMALL, packets, [7])[0] == frames


def renumber(packets: list[bytes], sequence: int, time: int) -> list[bytes]:
    """Let sequence and device time begin elsewhere; both wrap."""
    return [
        packet[:5]
        + bytes(((packet[5] + sequence) & 0xFF,))
        + packet[6:8]
        + ((int.from_bytes(packet[8:12], "little") + time) & 0xFFFFFFFF).to_bytes(4, "little")
        + packet[12:]
        for packet in packets
    ]


@settings(max_examples=150, deadline=None)
@given(
    st.sampled_from([SMALL, ROUND, LONG]),
    st.lists(st.integers(0, 10_000), max_size=8),
    st.integers(0, 255),
    st.sampled_from([0, 0xFFFFFFFF, 0xFFFFFFFF - 100_000]),
)
def test_any_split_and_any_start_gives_the_same_frames(
    mode: StreamMode, cuts: list[int], sequence: int, time: int
) -> None:
    frames = make_frames(mode, 4)
    packets = renumber(make_packets(mode, frames), sequence, time)
    assert assemble(mode, packets, [cut % len(packets) for cut in cuts])[0] == frames


@st.composite
def disturbances(draw: st.DrawFn) -> list[tuple[str, int, int]]:
    """Losses, repeats and moves: (what, where, how many or how far)."""
    what = st.sampled_from(["lose", "repeat", "move"])
    return draw(st.lists(st.tuples(what, st.integers(0, 10_000), st.integers(1, 255)), max_size=6))


def disturb(packets: list[bytes], disturbance: list[tuple[str, int, int]]) -> list[bytes]:
    packets = list(packets)
    for what, place, size in disturbance:
        at = place % len(packets)
        if what == "lose":
            packets[at : at + size] = packets[at : at + 1][:0]
        elif what == "repeat":
            packets[at:at] = packets[at : at + size]
        else:
            packets.insert((at + size) % len(packets), packets.pop(at))
        if not packets:
            return [b""]
    return packets


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(
    st.sampled_from([SMALL, ROUND, LONG]),
    disturbances(),
    st.lists(st.integers(0, 10_000), max_size=4),
)
def test_no_wrong_pixel_is_ever_delivered(
    mode: StreamMode, disturbance: list[tuple[str, int, int]], cuts: list[int]
) -> None:
    frames = make_frames(mode, 5)
    packets = disturb(make_packets(mode, frames), disturbance)
    got, _ = assemble(mode, packets, [cut % len(packets) for cut in cuts])
    assert set(got) <= set(frames)


@settings(max_examples=150, deadline=None)
@given(st.binary(min_size=1, max_size=2000), st.integers(0, 60))
def test_garbage_never_makes_a_frame_nor_an_error(garbage: bytes, at: int) -> None:
    frames = make_frames(SMALL, 4)
    packets = make_packets(SMALL, frames)
    packets[at % len(packets)] = garbage[:1920]
    got, _ = assemble(SMALL, packets, [])
    assert set(got) <= set(frames)
