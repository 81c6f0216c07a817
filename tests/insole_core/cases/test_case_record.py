from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, Variant
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign

SOURCE = ScanSource("mesh", "/clinic/foot.ply", "0" * 64)


def foot_record(side: Side) -> FootRecord:
    corners = TriangleMesh(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32))
    return FootRecord.begun(Foot(side, corners, np.eye(4), 250.0), SOURCE)


def test_the_views_of_a_record_are_those_of_the_foot_at_hand() -> None:
    record = CaseRecord().with_foot(foot_record(Side.RIGHT)).with_foot(foot_record(Side.LEFT))
    assert [foot.side for foot in record.feet] == [Side.LEFT, Side.RIGHT]
    assert record.side is Side.LEFT
    right = record.at(Side.RIGHT)
    assert right.foot is record.feet[1].foot
    assert right.other is record.feet[0]
    assert right.design == InsoleDesign(Side.RIGHT)
    assert right.holds_the_same(record)
    assert record.at(Side.LEFT) is record


def test_a_side_that_is_not_there_cannot_come_to_hand() -> None:
    record = CaseRecord.of_foot(foot_record(Side.LEFT))
    assert record.at(Side.RIGHT) is record
    assert record.other is None
    empty = CaseRecord()
    assert (empty.foot, empty.design, empty.source, empty.side) == (None, None, None, None)
    assert empty.annotations == Annotations()


def test_a_design_goes_into_the_chosen_variant() -> None:
    first = foot_record(Side.LEFT)
    softer = replace(first.design, thickness_mm=5.0)
    both = first.with_variant(Variant("softer", softer))
    assert both.design is softer
    changed = both.with_design(replace(softer, thickness_mm=6.0))
    assert changed.variant("A").design is first.design
    assert changed.design.thickness_mm == 6.0


def test_variants_are_renamed_and_left_out() -> None:
    three = foot_record(Side.LEFT)
    for name in ("B", "C"):
        three = three.with_variant(Variant(name, three.design))
    named = three.with_name("C", "high arch")
    assert named.chosen == "high arch"
    assert named.with_name("high arch", "high arch") is named
    assert [v.name for v in named.without_variant("A").variants] == ["B", "high arch"]
    assert named.without_variant("high arch").chosen == "B"
    assert replace(named, chosen="A").without_variant("A").chosen == "B"


@pytest.mark.parametrize(("name", "sentence"), [("A", "variant A already"), ("", "needs a name")])
def test_a_name_is_its_own(name: str, sentence: str) -> None:
    foot = foot_record(Side.LEFT)
    with pytest.raises(DesignError, match=sentence):
        foot.with_variant(Variant(name, foot.design))
    both = foot.with_variant(Variant("B", foot.design))
    with pytest.raises(DesignError, match=sentence):
        both.with_name("B", name)


def test_the_only_variant_stays() -> None:
    with pytest.raises(DesignError, match="only variant"):
        foot_record(Side.LEFT).without_variant("A")
