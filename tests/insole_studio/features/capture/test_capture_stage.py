"""The capture stage with its window, its process, and emulated sensors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from insole_core.geometry.side import Side
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.features.capture.rows import CaptureOptions
from insole_studio.features.capture.sensor_card import MIME, SensorCard
from insole_studio.features.capture.stage import CaptureStage, first_options


@pytest.fixture
def remembered() -> list[object]:
    return []


@pytest.fixture
def stage(
    qtbot: QtBot, tmp_path: Path, small_session: Path, remembered: list[object]
) -> Iterator[CaptureStage]:
    source = SensorSource(SensorStore(tmp_path / "sensors"), small_session)
    opened = CaptureStage(
        source=source,
        assignment=(),
        folder=tmp_path,
        remember=remembered.append,
        ask=lambda _stage, _sentence: False,
    )
    opened.show()
    yield opened
    opened.end()
    opened.deleteLater()


def cards(stage: CaptureStage) -> list[SensorCard]:
    found = stage.findChildren(SensorCard)
    return sorted(found, key=lambda card: card.x())


def button(stage: CaptureStage, text: str) -> QPushButton:
    return next(b for b in stage.findChildren(QPushButton) if b.text() == text)


def test_emulated_sensors_are_captured_as_they_were_recorded(
    tmp_path: Path, small_session: Path
) -> None:
    recorded = read_session(small_session)
    views = tuple(
        replace(view, name=name, sensor=replace(view.sensor, serial=serial))
        for view, name, serial in zip(
            recorded.views, ("left", "left_2", "right"), ("A", "A", "A"), strict=True
        )
    )
    manifest = replace(recorded.manifest, side=Side.RIGHT, views=("left", "left_2", "right"))
    write_session(replace(recorded, manifest=manifest, views=views), tmp_path / "moved")
    store = SensorStore(tmp_path / "sensors")
    assert first_options(SensorSource(store, tmp_path / "moved")) == CaptureOptions(
        Side.RIGHT, mode="moved", views=("left", "right")
    )
    assert first_options(SensorSource(store)) == CaptureOptions()


def test_a_card_is_dropped_on_another(
    stage: CaptureStage, qtbot: QtBot, remembered: list[object]
) -> None:
    qtbot.waitUntil(lambda: len(cards(stage)) == 3)
    first, second, third = cards(stage)
    data = QMimeData()
    data.setData(MIME, third.serial.encode())
    event = QDropEvent(
        QPointF(5, 5), Qt.DropAction.MoveAction, data, Qt.MouseButton.LeftButton,
        Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    first.dropEvent(event)
    assert dict(remembered[-1]) == {  # type: ignore[call-overload]
        "left": third.serial, "right": second.serial, "top": first.serial,
    }  # fmt: skip


def test_closing_in_mid_capture_keeps_finished_views(
    stage: CaptureStage, qtbot: QtBot, tmp_path: Path
) -> None:
    qtbot.waitUntil(lambda: len(cards(stage)) == 3)
    button(stage, "Capture").click()
    qtbot.waitUntil(lambda: bool(stage.presenter._finished))
    stage.close()
    (draft,) = (tmp_path / "captures").iterdir()
    assert read_session(draft).manifest.views[0] == "left"
