"""The rounded edge of every device, measured from its STL; and what is told where it is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks._rim_sections import rim_sections
from insole_core.foot.foot import Foot
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.shell import Shell
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, make_part
from insole_core.solids.solid import edge_notes, insole_solid
from insole_core.workflows.clinic_devices import clinic_devices
from tests.insole_core.solids.soundness import faults

DEVICES = {
    key: device
    for key, device in clinic_devices(Path("/nowhere")).load().items.items()
    if device.values.shell is not None
}
SQUARE = np.array([(-20.0, 60), (20, 60), (20, 160), (-20, 160)])


def insole_of(foot: Foot, key: str) -> Insole:
    return build_insole(foot, apply_device(DEVICES[key], InsoleDesign(foot.side, grid_mm=2.0)))


@pytest.mark.parametrize("key", DEVICES)
def test_the_rim_is_a_full_round_of_the_stated_radius(key: str, left_foot: Foot, tmp_path: Path):
    insole = insole_of(left_foot, key)
    path = tmp_path / "insole.stl"
    write_stl(insole_solid(insole), path)
    asked_mm = insole.design.shell.edge_radius_mm
    sections = list(rim_sections(path, asked_mm))
    assert len(sections) > 70
    assert [section for section in sections if not section.is_asked(asked_mm)] == []
    full = [section for section in sections if section.thickness_mm > 2 * asked_mm]
    assert len(full) > 0.6 * len(sections)


def test_a_smaller_radius_and_a_lower_rim_are_told(left_foot: Foot):
    assert edge_notes(insole_of(left_foot, "eva-full-length")) == ()
    thin, lowered = edge_notes(insole_of(left_foot, "ucbl-child"))
    assert thin.startswith("The edge is rounded by 0.7 mm instead of 1 mm where the insole is too")
    assert lowered.startswith("Rounding a steep rim takes up to 2.2 mm off its height")
    insole = insole_of(left_foot, "functional-three-quarter")
    part = make_part(insole, Order(), read_rules().only(()))
    assert part.notes[0].startswith("The edge is rounded by 0.5 mm instead of 1 mm")
    mould = make_part(insole, Order(kind="positive"), read_rules().only(()))
    assert mould.notes == ()


def test_a_radius_is_at_most_half_of_the_thickness_and_leaves_the_rim(left_foot: Foot):
    insole = insole_of(left_foot, "ucbl-child")
    shells = (replace(insole.design.shell, edge_radius_mm=radius) for radius in (0.0, 5.0))
    sharp, rounded = (
        insole_solid(replace(insole, design=replace(insole.design, shell=shell)))
        for shell in shells
    )
    assert faults(rounded) == []
    highest = [solid.vertices[:, 2].max() for solid in (sharp, rounded)]
    assert 1.0 < highest[0] - highest[1] < 4.0
    assert rounded.volume_mm3 > 0.9 * sharp.volume_mm3


@pytest.mark.parametrize("draft_deg", [15.0, -10.0])
@pytest.mark.parametrize("slope", [0.0, 1.2, -0.4])
def test_a_round_meets_an_inclined_wall(left_foot: Foot, draft_deg: float, slope: float):
    shell = Shell(
        edge_radius_mm=2.0, draft_medial_deg=draft_deg, draft_lateral_deg=draft_deg,
        taper_length_mm=5.0,
    )  # fmt: skip
    design = InsoleDesign(Side.LEFT, thickness_mm=10.0, grid_mm=2.0, shell=shell)
    insole = build_insole(left_foot, design)
    field = insole.contact
    roof = 20 + slope * (np.abs(field.x_mm) - 20) + 0 * field.y_mm[:, None]
    solid = insole_solid(replace(insole, contact=replace(field, heights_mm=roof)), outline=SQUARE)
    assert faults(solid) == []
    ends = solid.vertices[: len(solid.vertices) // 2]
    ends = ends[(ends[:, 0] > 20 - 1.0) & (np.abs(ends[:, 1] - 110) < 20)]
    known = np.column_stack([2 * ends[:, [0, 2]], np.ones(len(ends))])
    x, z, rest = np.linalg.lstsq(known, (ends[:, [0, 2]] ** 2).sum(axis=1), rcond=None)[0]
    assert np.sqrt(rest + x * x + z * z) == pytest.approx(2.0, rel=0.05)
    # The circle touches the roof, and the wall or the vertical line above a wall that leans in.
    roof_mm = (20 + slope * (x - 20) - z) / np.hypot(1, slope)
    tilt = np.radians(max(draft_deg, 0.0))
    wall_mm = (20 - x) * np.cos(tilt) + (20 - z) * np.sin(tilt)
    assert (roof_mm, wall_mm) == pytest.approx((2.0, 2.0), abs=0.06)
