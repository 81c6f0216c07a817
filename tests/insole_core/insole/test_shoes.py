"""An insole in a shoe: sizes, lasts, where it is wider, and trimming."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.outline.insole_outline import insole_outline, shoe_inside
from insole_core.insole.outline.shoe_fit import fit_in
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.template import mirrored
from insole_core.insole.primitives.outline_curve import closed_curve
from insole_core.insole.shoes.last import last_outline
from insole_core.insole.shoes.shoe_sizes import read_shoe_table, said_size
from insole_core.insole.warnings.shoe_warnings import shoe_warnings
from insole_core.resources import resource_path
from insole_core.solids.solid import SolidOptions, make_solid

TABLE = read_shoe_table()


def shoe(size: str = "EU 39", width_mm: float | None = 80.0) -> Shoe:
    return TABLE.shoe(*said_size(size, TABLE), width_mm=width_mm)


def design(foot: Foot, **shoe_values: object) -> InsoleDesign:
    worn = replace(shoe(), **shoe_values)  # type: ignore[arg-type]
    return InsoleDesign(foot.side, outline=Outline(shoe=worn))


def last(side: Side = Side.LEFT, height_mm: float = 70.0) -> TriangleMesh:
    """A last that stands on a bowed sole: its sections shrink upwards."""
    edge = closed_curve(shoe("EU 40").inside_mm)[::4] * [side.medial_sign, 1.0]
    middle = np.array([0.0, edge[:, 1].mean()])
    rings = [
        np.column_stack([(edge - middle) * scale + middle, np.full(len(edge), z)])
        for scale, z in ((1.0, 0.0), (1.03, 8.0), (1.0, 25.0), (0.6, height_mm))
    ]
    rings[0][:, 2] += 6 * (np.maximum(edge[:, 1] / edge[:, 1].max() - 0.6, 0) / 0.4) ** 2
    count = len(edge)
    ends = [np.append(middle, ring[:, 2].mean())[None] for ring in (rings[0], rings[-1])]
    points = np.concatenate([*rings, *ends])
    here = np.arange(count)
    there = (here + 1) % count
    sides = [
        np.stack(corners, -1)
        for k in range(3)
        for corners in (
            (here + k * count, there + k * count, there + (k + 1) * count),
            (here + k * count, there + (k + 1) * count, here + (k + 1) * count),
        )
    ]
    bottom = np.stack([there, here, np.full(count, 4 * count)], -1)
    top = np.stack([here + 3 * count, there + 3 * count, np.full(count, 4 * count + 1)], -1)
    mesh = TriangleMesh(points, np.concatenate([*sides, bottom, top]).astype(np.int32))
    return mesh if mesh.volume_mm3 > 0 else mesh.flipped()


@pytest.mark.parametrize(
    ("size", "length_mm"),
    [("EU 42", 280.0), ("UK 8", 279.4), ("US men 9", 279.4), ("US women 10", 279.4),
     ("mondopoint 265", 280.0), ("UK child 10", 186.27)],
)  # fmt: skip
def test_sizes_are_the_lengths_of_their_systems(size: str, length_mm: float) -> None:
    worn = TABLE.shoe(*said_size(size, TABLE))
    assert np.ptp(closed_curve(worn.inside_mm)[:, 1]) == pytest.approx(length_mm, abs=0.5)
    assert worn.name == f"{size}, regular"


def test_a_width_is_that_of_the_ball() -> None:
    regular, wide, measured = (
        np.ptp(closed_curve(worn.inside_mm)[:, 0])
        for worn in (
            TABLE.shoe(*said_size("EU 42", TABLE)),
            TABLE.shoe(*said_size("EU 42", TABLE), "wide"),
            shoe("EU 42", 100.0),
        )
    )
    assert regular == pytest.approx(93.0, abs=1.0)
    assert wide - regular == pytest.approx(4.0, abs=0.1)
    assert measured == pytest.approx(100.0, abs=1.0)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: said_size("42", TABLE), '"42" is no shoe size'),
        (lambda: said_size("EU big", TABLE), "no shoe size"),
        (lambda: said_size("ES 42", TABLE), "there are EU, UK"),
        (lambda: TABLE.shoe(TABLE.system("EU"), 60), "goes from 16 to 50"),
        (lambda: TABLE.shoe(TABLE.system("eu"), 42, "huge"), "narrow, regular"),
        (lambda: TABLE.shoe(TABLE.system("EU"), 42, width_mm=400), "40 to 140 mm wide"),
    ],
)
def test_what_is_no_size_is_told(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()


@pytest.mark.parametrize("key", ["systems", "widths", "shape", "ball"])
def test_a_table_that_lacks_something_is_refused(key: str, tmp_path: Path) -> None:
    content = json.loads(resource_path("shoes/sizes.json").read_text())
    del content[key]
    (tmp_path / "sizes.json").write_text(json.dumps(content))
    with pytest.raises(InputError, match=key):
        read_shoe_table(tmp_path / "sizes.json")


def test_an_insole_is_wider_where_the_shoe_is_narrow(left_foot: Foot) -> None:
    asked = design(left_foot)
    inside = shoe_inside(left_foot, asked.outline)
    assert inside is not None
    outline = insole_outline(left_foot, asked, {})
    np.testing.assert_array_equal(
        outline, insole_outline(left_foot, InsoleDesign(Side.LEFT), {})
    )  # not trimmed unless asked
    fit = fit_in(outline, inside)
    assert 0.5 < fit.most_over_mm < 15
    roomy = design(left_foot, **vars(shoe("EU 46", 125.0)))
    wide = shoe_inside(left_foot, roomy.outline)
    assert wide is not None
    assert fit_in(outline, wide).most_over_mm == 0
    trimmed = replace(roomy.outline, shoe=replace(shoe("EU 46", 125.0), trim=True))
    kept = insole_outline(left_foot, replace(roomy, outline=trimmed), {})
    np.testing.assert_array_equal(kept, outline)


@settings(max_examples=30)
@given(width_mm=st.floats(68, 95), clearance_mm=st.floats(0, 3))
def test_a_trimmed_insole_lies_within_its_shoe(
    left_foot: Foot, width_mm: float, clearance_mm: float
) -> None:
    worn = replace(shoe("EU 38", width_mm), trim=True, clearance_mm=clearance_mm)
    asked = InsoleDesign(Side.LEFT, outline=Outline(shoe=worn))
    inside = shoe_inside(left_foot, asked.outline)
    assert inside is not None
    outline = insole_outline(left_foot, asked, {})
    before = insole_outline(left_foot, InsoleDesign(Side.LEFT), {})
    assert fit_in(outline, inside).over_mm.max() <= 0.3 - clearance_mm
    assert _area(before) * 0.5 < _area(outline) <= _area(before)


def _area(curve: FloatArray) -> float:
    x, y = curve.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def test_the_mirrored_foot_has_the_mirrored_insole(left_foot: Foot, right_foot: Foot) -> None:
    left = design(left_foot, trim=True)
    right = mirrored(left)
    assert right.outline.shoe == left.outline.shoe
    assert _area(insole_outline(right_foot, right, {})) == pytest.approx(
        _area(insole_outline(left_foot, left, {})), rel=1e-3
    )
    one, other = (
        shoe_inside(foot, asked.outline) for foot, asked in ((left_foot, left), (right_foot, right))
    )
    assert one is not None
    assert other is not None
    assert one[:, 0].max() == pytest.approx(-other[:, 0].min(), abs=0.05)
    assert one[:, 0].max() != pytest.approx(-one[:, 0].min(), abs=0.5), "a shoe has two sides"


@pytest.mark.parametrize("extent", ["full", "three_quarter"])
def test_the_solid_ends_at_the_trimmed_edge(left_foot: Foot, extent: str) -> None:
    wide = InsoleDesign(Side.LEFT, outline=Outline(extent=extent), grid_mm=2.0)
    narrow = replace(wide, outline=replace(wide.outline, shoe=replace(shoe(), trim=True)))
    inside = shoe_inside(left_foot, narrow.outline)
    assert inside is not None
    upright = SolidOptions(draft_deg=0.0)
    solid = make_solid(build_insole(left_foot, narrow), "insole", upright)
    assert fit_in(solid.vertices[:, :2], inside).over_mm.max() < 0.3 - 0.5
    whole = make_solid(build_insole(left_foot, wide), "insole", upright)
    assert solid.volume_mm3 < whole.volume_mm3


def test_a_shoe_is_kept_with_the_design_and_told(left_foot: Foot) -> None:
    asked = design(left_foot, trim=True)
    assert design_from_json(json.loads(json.dumps(design_to_json(asked)))) == asked
    said = [str(line) for line in design_differences(InsoleDesign(Side.LEFT), asked)]
    assert said == ["Shoe: none → EU 39, 80 mm, trimmed to it"]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"inside_mm": ((0.0, 0.0),) * 3}, "inside_mm of shoe has 3 places"),
        ({"clearance_mm": 9.0}, "clearance_mm of shoe is 9"),
        ({"inside_mm": tuple((x / 9, y / 9) for x, y in shoe().inside_mm)}, "as no shoe is"),
        ({"name": " "}, "A name must have"),
    ],
)
def test_a_shoe_that_is_none_is_refused(
    left_foot: Foot, values: dict[str, object], said: str
) -> None:
    with pytest.raises(DesignError, match=said):
        build_insole(left_foot, design(left_foot, **values))


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("seed", range(3))
def test_a_last_is_recognised_however_it_lies(side: Side, seed: int) -> None:
    rng = np.random.default_rng(seed)
    standing = last(side)
    turn = rotation_about(rng.standard_normal(3), rng.uniform(0, 360))
    lying = TriangleMesh(
        standing.vertices @ turn.T + 100 * rng.standard_normal(3), standing.triangles
    )
    found = last_outline(lying, "last.stl")
    assert found.side is side
    curve = closed_curve(found.shoe("last", side).inside_mm)
    true = closed_curve(shoe("EU 40").inside_mm)
    off = np.abs(fit_in(curve, true).over_mm)
    assert np.quantile(off, 0.95) < 4.5  # its sections grow by 3 % above the sole
    assert off.mean() < 2.5


def test_a_last_of_the_other_side_is_told() -> None:
    found = last_outline(last(Side.RIGHT), "last.stl")
    with pytest.raises(InputError, match="last for the right foot, and the insole is for the left"):
        found.shoe("last.stl", Side.LEFT)


def test_what_is_no_last_is_told(left_mesh: TriangleMesh) -> None:
    ball = TriangleMesh(
        left_mesh.vertices / np.ptp(left_mesh.vertices, axis=0) * 100, left_mesh.triangles
    )
    with pytest.raises(InputError, match=r"ball\.stl does not look like a last"):
        last_outline(ball, "ball.stl")


def _said(foot: Foot, asked: InsoleDesign) -> list[str]:
    insole = build_insole(foot, replace(asked, grid_mm=2.0))
    return [str(one.sentence) for one in shoe_warnings(insole, find_landmarks(foot))]


def test_a_user_is_told_where_the_insole_is_wider(left_foot: Foot) -> None:
    (wider,) = _said(left_foot, design(left_foot, **vars(shoe("EU 41", 74.0))))
    assert wider.startswith("The insole is up to ")
    assert "wider than the shoe EU 41, 74 mm" in wider
    assert "mm from the heel on the" in wider
    assert _said(left_foot, design(left_foot, **vars(shoe("EU 42", 114.0)))) == []
    assert _said(left_foot, design(left_foot, trim=True)) == []


def test_a_user_is_told_of_a_short_shoe_and_a_cut_pad(left_foot: Foot) -> None:
    short = replace(shoe("EU 36"), trim=True)
    pad = Pelott(centre_mm=(38.0, 165.0), length_mm=40, width_mm=40, height_mm=4)
    asked = InsoleDesign(Side.LEFT, corrections=(pad,), outline=Outline(shoe=short))
    longer, cut = _said(left_foot, asked)
    assert longer == "The foot is 8 mm longer than the shoe EU 36, 80 mm is inside; check the size."
    assert "beyond the shoe EU 36, 80 mm and is cut there" in cut
