"""What changes between two designs, in words: exact, complete, translatable."""

from __future__ import annotations

from dataclasses import replace

import pytest

from insole_core.geometry.side import Side
from insole_core.insole.elements import ArchRaise, FullLift, HeelSkive, Pelott, Posting, Rocker
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.messages import Message
from insole_core.resources import resource_path

PLAIN = InsoleDesign(Side.LEFT)
FLAT = Form(
    name="Flat",
    length_mm=250,
    ball_width_mm=95,
    along_shares=(0, 0.3, 0.6, 1),
    across_shares=(0, 0.3, 0.6, 1),
    heights_mm=((0.0,) * 4,) * 4,
)
PAD = Pelott(id="pad", centre_mm=(0, 0), height_mm=4)
STATION = RimStation(border="medial", along=0.0, height_mm=12)
TOES = RimStation(border="medial", along=0.8, height_mm=2, over="toes")
FINISH = Finish(rim=(STATION, TOES))
ONE_LINE = [
    (PLAIN, replace(PLAIN, device="Flat"), "Device: none → Flat"),
    (PLAIN, replace(PLAIN, thickness_mm=4.5), "Thickness: 3 mm → 4.5 mm"),
    (
        PLAIN,
        PLAIN.with_added(ArchRaise(target_mm=28.0)),
        "Added: arch raise, 28 mm over the floor, 100 mm long",
    ),
    (
        PLAIN,
        PLAIN.with_added(FullLift()),
        "Added: full-length lift, 8 mm, 50 % of it at the heads",
    ),
    (PLAIN, PLAIN.with_added(Rocker()), "Added: rocker, 5 mm behind the heads"),
    (
        PLAIN,
        PLAIN.with_added(Rocker(behind_heads_mm=-7.5)),
        "Added: rocker, 7.5 mm ahead of the heads",
    ),
    (PLAIN, replace(PLAIN, bottom="following"), "Underside: flat → cupped"),
    (PLAIN, replace(PLAIN, base=BaseForm(form=FLAT)), "Base: from the foot → the form Flat"),
    (
        PLAIN,
        replace(PLAIN, base=BaseForm(form=FLAT, contact_share=0.25)),
        "Base: from the foot → the form Flat, 25 % from the foot",
    ),
    (
        PLAIN,
        replace(PLAIN, outline=Outline(extent="three_quarter")),
        "Extent: full length → three-quarter",
    ),
    (
        PLAIN,
        replace(PLAIN, outline=Outline(width_mm=0.0)),
        "Outline, Width: from the foot → 0 mm from the bisection of the 1st metatarsal",
    ),
    (PLAIN, replace(PLAIN, layers=Layers(cover_mm=3)), "Cover: 0 mm → 3 mm"),
    (
        replace(PLAIN, finish=FINISH),
        replace(PLAIN, finish=replace(FINISH, arch_fill_mm=3.2)),
        "Arch fill: 0 mm → 3.2 mm",
    ),
    (
        replace(PLAIN, finish=FINISH),
        replace(PLAIN, finish=replace(FINISH, rim=(STATION, replace(TOES, height_mm=3)))),
        "Medial rim, from heel to toes: 12 mm, 2 mm over the toes → 12 mm, 3 mm over the toes",
    ),
    (
        replace(PLAIN, shell=Shell()),
        replace(PLAIN, shell=Shell(posts=(Post(angle_deg=4, length_mm=60),))),
        "Rearfoot post: none → 4° medial, 60 mm long, edge 4 mm",
    ),
    (
        replace(PLAIN, shell=Shell()),
        replace(PLAIN, shell=Shell(taper_mm=2)),
        "Shell, Front edge: 1 mm → 2 mm",
    ),
    (
        replace(PLAIN, shell=Shell()),
        replace(PLAIN, shell=Shell(taper_length_mm=20)),
        "Shell, Taper length: 18 mm → 20 mm",
    ),
    (
        replace(PLAIN, finish=FINISH),
        replace(PLAIN, finish=replace(FINISH, expansion_mm=2)),
        "Soft tissue expansion: 0 mm → 2 mm",
    ),
    (
        replace(PLAIN, finish=FINISH),
        replace(PLAIN, finish=replace(FINISH, toe_zone="crest")),
        "Toe zone: flat → toe crest",
    ),
    (
        PLAIN,
        replace(PLAIN, outline=Outline(points_mm=((0, 0), (1, 0), (1, 1), (0, 1)))),
        "Drawn outline: none → 4 places",
    ),
    (
        PLAIN,
        replace(PLAIN, layers=Layers(cover_is_taken_off=True)),
        "Layers, Cover is: made with it → glued on later",
    ),
    (PLAIN, replace(PLAIN, grid_mm=2), "Insole, Computed every: 1 mm → 2 mm"),
    (PLAIN, PLAIN.with_added(PAD), "Added: pelott, 4 mm, 60 mm long"),
    (PLAIN.with_added(PAD), PLAIN, "Removed: pelott"),
    (
        PLAIN.with_added(PAD),
        PLAIN.with_added(replace(PAD, height_mm=6)),
        "Changed: pelott, 4 mm, 60 mm long → 6 mm, 60 mm long",
    ),
    (
        PLAIN.with_added(PAD),
        PLAIN.with_added(replace(PAD, centre_mm=(3, 0))),
        "Moved or reshaped: pelott",
    ),
    (
        PLAIN,
        PLAIN.with_added(Posting(rearfoot_deg=4, forefoot_deg=-2)),
        "Added: posting, 4° medial at the rearfoot, 2° lateral at the forefoot",
    ),
    (PLAIN, PLAIN.with_added(HeelSkive(depth_mm=3)), "Added: heel skive, medial, 3 mm"),
    (
        PLAIN.with_added(PAD),
        PLAIN.with_added(replace(PAD, enabled=False)),
        "Changed: pelott, 4 mm, 60 mm long → 4 mm, 60 mm long, switched off",
    ),
]


@pytest.mark.parametrize(("old", "new", "line"), ONE_LINE, ids=[line for _, _, line in ONE_LINE])
def test_one_change_is_one_line(old, new, line):
    assert [str(told) for told in design_differences(old, new)] == [line]


def test_equal_designs_have_no_differences():
    signed = PLAIN.with_added(replace(PAD, author="Dr A", created_at="2026-11-22"))
    assert design_differences(PLAIN.with_added(PAD), signed) == ()
    for path in resource_path("devices").glob("*.json"):
        made = apply_device(read_device(path), PLAIN)
        assert design_differences(made, made) == ()


def test_a_cup_is_told_by_its_depth():
    deeper = replace(FINISH, rim=(replace(STATION, height_mm=20), TOES))
    lines = design_differences(replace(PLAIN, finish=FINISH), replace(PLAIN, finish=deeper))
    assert str(lines[0]) == "Heel cup: 12 mm → 20 mm"
    assert len(lines) == 2  # and the rim that holds it


def test_heights_of_the_rim_are_told_as_the_window_shows_them():
    scaled = replace(FINISH, rim=(replace(STATION, height_mm=19.16), replace(TOES, height_mm=2.04)))
    (line,) = (
        line
        for line in design_differences(replace(PLAIN, finish=FINISH), replace(PLAIN, finish=scaled))
        if "rim" in line
    )
    assert line.endswith("→ 19.2 mm, 2 mm over the toes")


def test_a_device_is_told_from_as_scanned():
    device = read_device(resource_path("devices/functional-three-quarter.json"))
    lines = [str(line) for line in design_differences(PLAIN, apply_device(device, PLAIN))]
    for line in (
        "Device: none → Functional, three-quarter",
        "Underside: flat → cupped",
        "Extent: full length → three-quarter",
        "Heel cup: as scanned → 12 mm",
        "Arch fill: as scanned → 3.2 mm",
        "Toe zone: as scanned → flat",
        "Rearfoot post: none → 0°, edge 4 mm",
    ):
        assert line in lines
    back = [str(line) for line in design_differences(apply_device(device, PLAIN), PLAIN)]
    assert len(back) == len(lines)
    assert "Heel cup: 12 mm → as scanned" in back


def test_lines_can_be_translated():
    line = design_differences(PLAIN, replace(PLAIN, thickness_mm=4))[0]
    assert isinstance(line, Message)
    assert line.template == "{what}: {before} → {after}"
    assert line.values["what"] == "Thickness"


def test_lines_have_one_order_whichever_design_lacks_a_part():
    without, whole = replace(PLAIN, shell=Shell()), replace(PLAIN, finish=FINISH, shell=Shell())
    thick = replace(whole, shell=Shell(chamfer_mm=1.0))
    there = [str(line).split(":")[0] for line in design_differences(without, thick)]
    back = [str(line).split(":")[0] for line in design_differences(thick, without)]
    assert there == back
    assert there[-1] == "Chamfer"
