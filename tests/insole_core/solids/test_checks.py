"""Checks before export: each finds its fault with number and place, and its policy decides."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import manifold3d
import numpy as np
import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.primitives.height_field import HeightField
from insole_core.resources import resource_path
from insole_core.solids.checks import Finding, Override, check_solid, require_export
from insole_core.solids.export_rules import CHECK_NAMES, ExportRules, read_rules
from insole_core.solids.prism import Faces, Prism
from insole_core.solids.simplification import from_manifold, to_manifold
from insole_core.solids.solid import insole_solid
from insole_core.solids.solid_outline import outline_distance
from insole_core.solids.trimmed_grid import trim

SQUARE = np.array([(-30.0, -60), (30, -60), (30, 60), (-30, 60)])


def plate(heights, draft_deg=0.0, step=1.0, outline=SQUARE) -> TriangleMesh:
    """A plate of 60 x 120 mm whose upper side is heights(x, y)."""
    x, y = np.meshgrid(np.arange(-40, 40.1, step), np.arange(-70, 70.1, step))
    top = heights(x, y) + np.zeros_like(x)
    field = HeightField(-40.0, -70.0, step, top)
    distance = outline_distance(outline, field, 8.0)
    body = Prism(trim(distance.inside_mm), field, distance, draft_deg)
    return body.between(Faces(top, np.zeros_like(top)))


def findings(mesh: TriangleMesh) -> dict[str, Finding]:
    return {finding.name: finding for finding in check_solid(mesh, read_rules())}


def finding_of(name: str, mesh: TriangleMesh) -> Finding:
    """What one check finds; the others are not made."""
    (finding,) = check_solid(mesh, read_rules().only((name,)))
    return finding


def test_plain_plate_passes_everything():
    found = findings(plate(lambda _x, _y: 8.0, draft_deg=3))
    assert set(found) == set(CHECK_NAMES)
    for finding in found.values():
        assert finding.passed, finding.sentence
    assert found["thickness"].value == pytest.approx(8, abs=0.01)
    assert found["shoe_height"].value == pytest.approx(8, abs=0.01)


def test_thin_place_is_named():
    dent = plate(lambda x, y: 8 - 7.4 * np.exp(-((x - 10) ** 2 + (y + 20) ** 2) / 60), step=0.5)
    finding = finding_of("thickness", dent)
    assert not finding.passed
    assert finding.value == pytest.approx(0.6, abs=0.05)
    assert finding.place_mm == pytest.approx((10, -20, 0.6), abs=1)


@pytest.mark.slow
@pytest.mark.parametrize(("radius", "passes"), [(3.0, False), (12.0, True)])
def test_groove_against_the_cutter(radius, passes):
    """A round groove along y, 2 mm deep: a ball of 5 mm radius fits 12 mm, not 3 mm."""

    def groove(x, _y):
        depth = np.sqrt(np.clip(radius**2 - x**2, 0, None)) - (radius - 2)
        return 10 - np.clip(depth, 0, None)

    finding = finding_of("cutter", plate(groove, step=0.5))
    assert finding.passed is passes
    if not passes:
        # The ball rests on the edges, half a groove apart: half = sqrt(3² - 1²).
        reached = 5 - np.sqrt(25 - 8)
        assert finding.value == pytest.approx(2 - reached, abs=0.2)
        assert finding.place_mm is not None
        assert abs(finding.place_mm[0]) < 1


def test_step_is_measured():
    finding = finding_of("step", plate(lambda x, _y: np.where(x < 5, 6.0, 12.0), step=0.5))
    assert not finding.passed
    assert finding.value == pytest.approx(6, abs=0.01)
    assert finding.place_mm is not None
    assert finding.place_mm[0] == pytest.approx(5, abs=1)


@pytest.mark.slow
def test_walls_that_lean_inwards_are_undercut():
    assert undercut(plate(lambda _x, _y: 8.0, draft_deg=5)).passed
    finding = undercut(plate(lambda _x, _y: 8.0, draft_deg=-10))
    assert not finding.passed
    assert finding.value == pytest.approx(360 * 8 / np.cos(np.radians(10)), rel=0.05)


DEVICES = ("functional-three-quarter", "dress-three-quarter", "ucbl-child", "sport-full-length")


def shell_of(foot: Foot, key: str) -> TriangleMesh:
    device = read_device(resource_path("devices") / f"{key}.json")
    return insole_solid(build_insole(foot, apply_device(device, InsoleDesign(foot.side))))


def undercut(mesh: TriangleMesh) -> Finding:
    return finding_of("undercut", mesh)


@pytest.mark.parametrize("key", DEVICES)
def test_a_sound_cupped_shell_has_no_undercut(left_foot: Foot, key: str):
    finding = undercut(shell_of(left_foot, key))
    assert (finding.passed, finding.value) == (True, 0.0)
    assert "turned over" in finding.sentence


def test_a_slot_in_the_wall_of_a_cupped_shell_is_an_undercut(left_foot: Foot):
    shell = shell_of(left_foot, "ucbl-child")
    (low_x, _, _), (high_x, _, _) = shell.vertices.min(axis=0), shell.vertices.max(axis=0)
    slot = manifold3d.Manifold.cube([high_x - low_x, 20.0, 1.0]).translate([low_x, 30.0, 8.0])
    finding = undercut(from_manifold(to_manifold(shell) - slot))
    assert not finding.passed
    assert 2 * 2 * 20 * 2.0 < finding.value < 2 * 2 * 20 * 20.0  # floor and roof, both walls
    assert finding.place_mm is not None
    assert finding.place_mm[1] == pytest.approx(40, abs=10.01)
    assert finding.place_mm[2] == pytest.approx(8.5, abs=0.51)
    assert "nor from below" in finding.sentence


def test_a_slot_in_the_wall_on_a_flat_bottom_is_an_undercut():
    slot = manifold3d.Manifold.cube([10.0, 20.0, 2.0]).translate([25.0, 0.0, 3.0])
    finding = undercut(from_manifold(to_manifold(plate(lambda _x, _y: 8.0)) - slot))
    assert finding.value == pytest.approx(5 * 20, abs=1)
    assert "turned over" not in finding.sentence


@pytest.mark.parametrize("wider", [1 - 1e-12, 1 + 1e-12])
def test_an_outline_through_nodes_is_not_decided_by_last_bits(wider):
    plain, other = (
        plate(lambda _x, _y: 8.0, outline=outline) for outline in (SQUARE, wider * SQUARE)
    )
    np.testing.assert_array_equal(other.triangles, plain.triangles)
    np.testing.assert_allclose(other.vertices, plain.vertices, rtol=0, atol=1e-6)


@pytest.mark.slow
def test_block_and_shoe_that_are_too_small():
    high = plate(lambda _x, _y: 41.0)
    assert finding_of("block", high).value == pytest.approx(1, abs=0.01)
    assert not finding_of("shoe_height", high).passed
    turned = plate(lambda _x, _y: 30.0)
    along_x = replace(turned, vertices=turned.vertices[:, [1, 0, 2]] * [1, -1, 1])
    assert finding_of("block", along_x).passed


@pytest.mark.slow
def test_open_solid_blocks_until_somebody_answers_for_it():
    solid = plate(lambda _x, _y: 8.0)
    found = check_solid(replace(solid, triangles=solid.triangles[1:]), read_rules())
    with pytest.raises(DesignError, match="open or inside out"):
        require_export(found)
    with pytest.raises(DesignError, match="override the rule with a reason"):
        require_export(found, Override("A. Berg", " ", "2026-11-20T10:00:00Z"))
    record = require_export(found, Override("A. Berg", "closed by hand", "2026-11-20T10:00:00Z"))
    assert json.loads(json.dumps(record))["override"]["reason"] == "closed by hand"
    sound = require_export(check_solid(solid, read_rules()), Override("A", "b", "c"))
    assert sound["override"] is None


def test_check_that_is_off_is_not_made():
    rules = ExportRules({"watertight": "off", "shoe_height": "blocking"}, {"shoe_height": 5.0})
    found = check_solid(plate(lambda _x, _y: 8.0), rules)
    assert [finding.name for finding in found] == ["shoe_height"]
    assert found[0].blocks


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"format": "x"}, "format is 'x', but must be \"insole-export-rules\""),
        ({"version": 2}, "version 2, which is newer"),
        ({"rules": {"colour": {}}}, "rules.colour is no check; those are watertight, thickness"),
        ({"rules": {"step": 3}}, "rules.step must be an object"),
        ({"rules": {"step": {"policy": "never"}}}, 'rules.step.policy is "never", but must be'),
        ({"rules": {"step": {"policy": "warning"}}}, "rules.step.limit is missing"),
        (
            {"rules": {"step": {"policy": "warning", "limit": -1}}},
            "rules.step.limit is -1, but must lie between 0 and 1000",
        ),
        (
            {"rules": {"block": {"policy": "warning", "size_mm": [1]}}},
            "rules.block.size_mm has 1 numbers, but must have 3",
        ),
        (
            {"rules": {"block": {"policy": "warning", "size_mm": [1, -1, 1]}}},
            r"rules.block.size_mm\[1\] is -1, but must lie between 0 and 1000",
        ),
    ],
)
def test_bad_rules(tmp_path: Path, change, sentence):
    path = tmp_path / "rules.json"
    path.write_text(
        json.dumps({"format": "insole-export-rules", "version": 1, "rules": {}} | change)
    )
    with pytest.raises(InputError, match=rf"rules\.json.*{sentence}"):
        read_rules(path)


def test_default_insole_can_leave_the_house(left_foot):
    from insole_core.insole.build import build_insole
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.solids.solid import insole_solid

    solid = insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT)))
    found = {finding.name: finding for finding in check_solid(solid, read_rules())}
    require_export(tuple(found.values()))
    assert found["thickness"].value > 0.3
    assert found["undercut"].passed


@pytest.mark.parametrize("bottom", ["flat", "following"])
@pytest.mark.parametrize("thickness", [3.0, 4.5, 6.0])
def test_least_thickness_is_that_of_the_material_not_of_the_rim(left_foot, bottom, thickness):
    from insole_core.insole.build import build_insole
    from insole_core.insole.elements import Posting
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.solids.solid import insole_solid

    posting = Posting(rearfoot_deg=4)
    design = InsoleDesign(Side.LEFT, (posting,), thickness_mm=thickness, bottom=bottom)
    finding = finding_of("thickness", insole_solid(build_insole(left_foot, design)))
    assert finding.value == pytest.approx(thickness, abs=0.11)
    assert finding.sentence.startswith(f"{finding.value:g} mm thick at ")


@pytest.mark.parametrize("name", ["thickness", "shoe_height", "step", "block"])
@pytest.mark.parametrize("off", [-0.3, -0.04, 0.04, 0.3])
def test_what_is_printed_is_what_was_compared(name, off):
    """A value that is printed as its limit meets it."""
    heights = {"thickness": 1.0, "shoe_height": 35.0, "block": 40.0}
    height_mm = heights.get(name, 6.0) + off

    def top(x, _y):
        return np.where(x < 5, 2.0, 2.0 + 4.0 + off) if name == "step" else height_mm

    finding = finding_of(name, plate(top, step=0.5 if name == "step" else 1.0))
    assert finding.passed is (off > -0.1 if name == "thickness" else off < 0.1)
    number = re.search(r"[0-9.]+(?= mm,)" if name == "block" else r"[0-9.]+", finding.sentence)
    assert number is not None
    assert finding.passed is (
        float(number[0].split(" × ")[-1]) >= 1.0
        if name == "thickness"
        else float(number[0]) <= {"block": 40.0, "shoe_height": 35.0, "step": 4.0}[name]
    )
    assert (len(finding.spots_mm) == 0) is finding.passed or name == "block"
