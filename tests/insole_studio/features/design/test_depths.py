"""A relief is told by its depth, in its name and at the axis of its dose."""

from __future__ import annotations

import pytest
from pytestqt.qtbot import QtBot

from insole_core.contact.dose import DoseCurve
from insole_core.insole.elements import Pelott
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.features.design.correction_names import pad_text
from insole_studio.features.design.load.dose_chart import DoseChart


@pytest.mark.parametrize(("height_mm", "told"), [(0.0, "mm, 0 mm deep"), (3.0, "mm, 3 mm high")])
def test_a_recess_that_is_not_deep_is_told_apart_from_its_size(height_mm: float, told: str) -> None:
    template = Pelott(
        kind="relief_head_3", centre_mm=(0, 0), length_mm=20, width_mm=10, height_mm=height_mm
    )
    assert pad_text(LibraryPad("", "relief_head_3", "", template, "heel")).endswith(
        f"20 × 10 {told}"
    )


def test_the_axis_of_a_relief_tells_depths(qtbot: QtBot) -> None:
    chart = DoseChart()
    qtbot.addWidget(chart)
    curve = DoseCurve((0.0, -4.0, -8.0), (0.0, -10.0, -40.0))
    chart.show_curve(curve, -20.0, -1.0)
    assert [chart.dose_text(dose) for dose in (0.0, -8.0)] == ["0.0 mm", "8.0 mm"]
    chart.show_curve(curve, -20.0)
    assert chart.dose_text(-8.0) == "-8.0 mm"
