"""Progress travels into parts, and cancelling ends the work."""

from __future__ import annotations

import pytest

from insole_core.progress import SILENT, Cancelled, Progress


def test_parts_report_their_share_of_the_whole() -> None:
    seen: list[tuple[float, str]] = []
    whole = Progress(lambda fraction, text: seen.append((fraction, text)))
    second_half = whole.part(0.5, 1.0)
    second_half.part(0.0, 0.5).step(0.5, "deep")
    second_half.step(1.0, "end")
    assert seen == [(0.625, "deep"), (1.0, "end")]


def test_each_message_says_what_it_is_about() -> None:
    seen: list[tuple[float, str]] = []
    whole = Progress(lambda fraction, text: seen.append((fraction, text)))
    right = whole.part(0.5, 1.0).about("The {side} foot: {step}", side="right")
    right.part(0.0, 0.5).step(0.5, "Placing the view {view}", view="left")
    assert seen == [(0.625, "The right foot: Placing the view left")]


def test_cancelling_stops_at_the_next_step() -> None:
    progress = Progress(is_cancelled=lambda: True)
    with pytest.raises(Cancelled):
        progress.part(0.1, 0.2).step(0.0, "Fusing")


def test_silent_goes_on() -> None:
    SILENT.step(0.5, "nobody listens")
