"""What a prescription says of places moves with the foot that is laid anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.insole.elements import ArchRaise, BrushStroke, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.workflows.foot_landmarks import lying_anew

PLACES = ((30.0, 150.0), (0.0, 160.0), (-30.0, 155.0), (-20.0, 20.0))


def test_every_place_of_a_prescription_moves_with_the_foot(left_foot: Foot) -> None:
    design = InsoleDesign(
        left_foot.side,
        (
            Pelott(centre_mm=(5.0, 150.0)),
            ArchRaise(apex_mm=(16.0, 120.0)),
            BrushStroke(points_mm=PLACES[:2]),
        ),
        outline=Outline(source="drawn", points_mm=PLACES),
        shell=Shell(trim_mm=PLACES[:3]),
    )
    shift = np.eye(4)
    shift[:2, 3] = 2.0, -3.0
    record = FootRecord.begun(left_foot, ScanSource("mesh", "foot.ply", "0" * 64), design)
    moved = lying_anew(record, replace(left_foot, source2insole=shift @ left_foot.source2insole))
    pad, arch, stroke = moved.design.corrections
    assert isinstance(pad, Pelott)
    assert isinstance(arch, ArchRaise)
    assert isinstance(stroke, BrushStroke)
    assert moved.design.shell is not None
    assert pad.centre_mm == pytest.approx((7.0, 147.0))
    assert arch.apex_mm == pytest.approx((18.0, 117.0))
    for before, after in (
        (PLACES[:2], stroke.points_mm),
        (PLACES, moved.design.outline.points_mm),
        (PLACES[:3], moved.design.shell.trim_mm),
    ):
        assert np.array(after) == pytest.approx(np.add(before, (2.0, -3.0)))
