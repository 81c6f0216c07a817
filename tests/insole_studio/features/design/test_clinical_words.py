"""The fields of a prescription speak of the foot: units, sides, per cent, and a tooltip on each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QWidget

from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    FullLift,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.correction_names import describe
from insole_studio.features.design.parameters.correction_fields import (
    editables,
    field_specs,
    with_value,
)
from insole_studio.features.design.patient.measure_grid import MeasureGrid
from insole_studio.features.design.patient.measure_texts import measures_of
from insole_studio.features.design.rows import FieldSpec
from insole_studio.widgets.form_parts import Fold
from insole_studio.widgets.number_field import NumberField

PAD = Pelott(centre_mm=(-3.0, 153.3), sigma_mm=(20.0, 30.0))
FREE_PAD = Pelott(
    centre_mm=(-3.0, 153.3), shape="flat_outline",
    outline_mm=((-14.0, -22.0), (16.0, -25.0), (12.0, 24.0), (-18.0, 20.0)),
)  # fmt: skip
PARTS = (
    PAD, FREE_PAD, Posting(rearfoot_deg=4.0), ForefootTwist(angle_deg=-2.0), HeelSkive(),
    HeelLift(), FullLift(),
    ArchRaise(apex_mm=(20.0, 110.0)), HeelCup(), Rocker(), BrushStroke(points_mm=((0.0, 50.0),)),
    InsoleDesign(Side.RIGHT), Layers(), Outline(source="shoe_size", shoe_size_eu=42.0),
)  # fmt: skip


def kind_of(part: Any) -> str:
    return type(part).__name__


OF_THE_PROGRAM = ("sigma", "egg", "blend", "apex", " x", " y")
WITHOUT_FIELD = {
    "Pelott": ["shape", "kind", "blend_mm", "outline_mm"],
    "BrushStroke": ["points_mm"],
    "InsoleDesign": ["margin_mm"],
    "Outline": ["points_mm"],
    "Finish": ["arch_fill_mm"],
    "Layers": ["cover_material", "shell_material", "base_material"],
    "Shell": ["material", "body_weight_kg", "least_mm", "least_edge_mm", "trim_mm"],
    "Post": ["region", "length_mm", "edge_radius_mm"],
}
"""What is drawn, chosen in another way, or the device's: no tip, and so no field of its own."""


@pytest.mark.parametrize("part", [*PARTS, Finish(), Shell(), Post()], ids=kind_of)
def test_every_field_says_in_plain_words_what_it_does(part: Any) -> None:
    shown = [editable for editable in editables(part) if editable.found.tip]
    unshown = [editable.key for editable in editables(part) if not editable.found.tip]
    assert unshown == WITHOUT_FIELD.get(kind_of(part), [])
    assert all(10 < len(editable.found.tip) < 80 for editable in shown)
    for editable in editables(part):
        assert not any(word in editable.found.label.lower() for word in OF_THE_PROGRAM)


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("part", PARTS, ids=lambda part: type(part).__name__)
def test_what_a_field_shows_is_what_it_sets(part: Any, side: Side) -> None:
    specs = [s for expert in (False, True) for s in field_specs(part, "p", side, expert=expert)]
    assert len(specs) >= 2
    for spec in specs:
        assert spec.tip
        same = with_value(part, spec.key.removeprefix("p."), spec.value, side)
        assert same == part
        if isinstance(spec, FieldSpec):
            assert spec.least <= spec.value <= spec.greatest


@pytest.mark.parametrize(
    ("mode", "unit", "greatest", "tip"),
    [
        ("push", "mm", 10, "How much the stroke raises or lowers"),
        ("pull", "mm", 10, "How much the stroke raises or lowers"),
        ("smooth", "%", 100, "100 % smooths out all that a stroke can"),
    ],
)
def test_the_strength_of_a_stroke_is_explained_in_its_unit(
    mode: str, unit: str, greatest: float, tip: str
) -> None:
    stroke = BrushStroke(points_mm=((0.0, 50.0),), mode=mode)
    spec = shown(stroke, Side.LEFT, "strength")
    assert (spec.unit, spec.greatest, spec.tip) == (unit, greatest, tip)


def shown(part: Any, side: Side, key: str, *, expert: bool = False) -> FieldSpec:
    specs = field_specs(part, "p", side, expert=expert)
    (spec,) = (s for s in specs if s.key == f"p.{key}" and isinstance(s, FieldSpec))
    return spec


@pytest.mark.parametrize(("side", "x_mm"), [(Side.LEFT, -3.0), (Side.RIGHT, 3.0)])
def test_a_place_is_medial_above_0_on_either_foot(side: Side, x_mm: float) -> None:
    assert shown(PAD, side, "centre_mm.0").value == x_mm
    moved = with_value(PAD, "centre_mm.0", 5.0, side)
    assert moved.centre_mm == (5.0 * side.medial_sign, 153.3)


@pytest.mark.parametrize(
    ("part", "key", "percent"),
    [(Posting(), "blend_end", 65), (HeelLift(), "fade_start", 25), (PAD, "egg_ratio", 50)],
)
def test_shares_are_in_per_cent_and_for_experts(part: Any, key: str, percent: float) -> None:
    spec = shown(part, Side.LEFT, key, expert=True)
    assert (spec.value, spec.unit, spec.decimals) == (pytest.approx(percent), "%", 0)
    assert getattr(with_value(part, key, 55.0, Side.LEFT), key) == pytest.approx(0.55)


def field(app: Application, key: str) -> NumberField:
    fields = app.stage.parameters.findChildren(NumberField)
    (found,) = (f for f in fields if f.property("key") == key)
    return found


def test_the_zone_of_a_posting_is_typed_in_per_cent_under_expert(opened: Application) -> None:
    design = opened.case.record.design
    assert design is not None
    posting = Posting(rearfoot_deg=4.0)
    opened.case.apply(design.with_added(posting), "Post")
    opened.case.select(posting.id)
    zone = field(opened, "posting.blend_end")
    group = zone.parentWidget()
    assert group is not None
    whole = group.parentWidget()
    assert isinstance(whole, QWidget)
    fold = whole.findChild(Fold)
    assert isinstance(fold, Fold)
    assert fold.text() == "Expert"
    QTest.mouseClick(fold, Qt.MouseButton.LeftButton)
    assert "forefoot angle" in zone.toolTip()
    opened.stage.parameters.ensureWidgetVisible(zone)
    QTest.mouseDClick(zone.lineEdit(), Qt.MouseButton.LeftButton)
    zone.selectAll()
    QTest.keyClicks(zone, "70")
    QTest.keyClick(zone, Qt.Key.Key_Return)
    changed = opened.case.record.design
    assert changed is not None
    assert changed.correction(posting.id) == replace(posting, blend_end=0.7)


@pytest.mark.parametrize(
    ("correction", "text"),
    [
        (HeelLift(height_mm=6.92154), "Heel lift 6.9 mm"),
        (FullLift(), "Full-length lift 8 mm"),
        (replace(PAD, height_mm=4.96), "Pelott 5 mm (60 × 40)"),
        (ForefootTwist(angle_deg=-3.0), "Forefoot twist 3° lateral"),
        (Posting(rearfoot_deg=-9.2, forefoot_deg=0.01), "Posting 9.2° lateral / 0°"),
        (ArchRaise(target_mm=28.04), "Arch raise to 28 mm"),
        (
            replace(PAD, shape="cut_out", kind="relief_toe_2", height_mm=-2.0),
            "Relief under the 2nd toe 2 mm deep (60 × 40)",
        ),
        (replace(PAD, kind="felt_pad", height_mm=3.0), "felt pad 3 mm (60 × 40)"),
        (Rocker(slope_deg=8.0), "Rocker 8°"),
    ],
)
def test_the_list_has_the_precision_of_the_fields_and_no_signs(correction: Any, text: str) -> None:
    assert describe(correction) == text


@pytest.mark.parametrize(
    ("angle", "text"), [(-9.2, "9.2 ± ?° varus"), (3.04, "3.0 ± ?° valgus"), (0.04, "0.0 ± ?°")]
)
def test_the_rearfoot_is_in_varus_or_valgus(
    opened: Application, monkeypatch: pytest.MonkeyPatch, angle: float, text: str
) -> None:
    monkeypatch.setattr(
        "insole_core.foot.spread.measure",
        lambda _foot, _landmarks: {"foot_length": 250.0, "rearfoot_angle_deg": angle},
    )
    measures = measures_of(opened.case.record)
    assert {m.key: m.values for m in measures}["rearfoot_angle_deg"] == (text,)
    grid = MeasureGrid(opened.window)
    grid.show_measures(measures)
    assert text in [label.text() for label in grid.findChildren(QLabel)]


def test_a_swedish_angle_leans_to_its_side(
    opened: Application, swedish: Callable[[str], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "insole_core.foot.spread.measure",
        lambda _foot, _landmarks: {"achilles_lean_deg": -3.04, "rearfoot_angle_deg": 2.0},
    )
    said = {m.key: m.values for m in measures_of(opened.case.record)}
    assert said["achilles_lean_deg"] == ("3,0 ± ?° lateralt",)
    assert said["rearfoot_angle_deg"] == ("2,0 ± ?° valgus",)
    assert swedish("lateral") == "lateral"
