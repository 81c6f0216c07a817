"""An order becomes a part, a pair, a file with layers, and papers."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from read_pdf import text_of_pdf

from insole_core.errors import DesignError, InputError, UsageError
from insole_core.export.lettering import as_written, font_path, missing_letters
from insole_core.export.paper import JobSheet
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.prescription_lines import correction_lines
from insole_core.messages import Message
from insole_core.resources import resource_path
from insole_core.scans.mesh_file import read_mesh
from insole_core.solids.checks import Override
from insole_core.solids.drawn_part import drawn_part
from insole_core.solids.export_job import ExportJob, ExportPaths, outputs, run_export_job
from insole_core.solids.export_rules import ExportRules, read_rules, write_rules
from insole_core.solids.order import Order, Part, make_part
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.solids.simplification import to_manifold

SHOP = read_shop()
RESPONSIBLE = Responsible("A. Ek", "Foot Clinic", "Sula AB", "Gatan 1, Lund")
PAIR_BLOCK = Block("pair", (340.0, 240.0, 40.0))


def insole_of(foot, **design) -> Insole:
    return build_insole(foot, InsoleDesign(foot.side, grid_mm=2.0, **design))


@pytest.fixture(scope="module")
def layered(left_foot) -> Insole:
    return insole_of(left_foot, layers=Layers(cover_mm=2.0, shell_mm=3.0, base_mm=1.0))


def part_of(insole: Insole, rules: ExportRules | None = None, **order) -> Part:
    return make_part(insole, Order(**order), rules or read_rules().only(("watertight",)))


@pytest.mark.parametrize(("extent", "front"), [("full", "ball"), ("three_quarter", "front edge")])
def test_sections_of_the_drawing_lie_at_landmarks_of_the_foot(left_foot, extent, front):
    part = part_of(insole_of(left_foot, outline=Outline(extent=extent)))
    drawn = drawn_part(part)
    assert drawn is not None
    y_mm = {name: mark.point[1] for name, mark in part.landmarks.items()}
    heads_mm = (y_mm["metatarsal_head_1"] + y_mm["metatarsal_head_5"]) / 2
    front_mm = drawn.lengthwise.ends_mm[1]
    places = {section.name: section.at_mm for section in drawn.sections.values()}
    assert list(drawn.sections) == ["A", "B", "C"]
    assert list(places) == [front, "arch", "heel"]
    assert places["heel"] == pytest.approx(y_mm["heel_centre"], abs=0.5)
    assert places["arch"] == pytest.approx((heads_mm + y_mm["heel_centre"]) / 2, abs=0.5)
    wanted_mm = heads_mm if extent == "full" else front_mm - 5
    assert (heads_mm < front_mm) == (extent == "full")
    assert places[front] == pytest.approx(wanted_mm, abs=0.5)


@pytest.mark.slow
def test_layers_are_the_insole_cut_in_three(layered):
    part = part_of(layered, layered=True)
    layers = part.layers(SHOP)
    assert [layer.name for layer in layers] == [
        "left insole, cover", "left insole, shell", "left insole, base",
    ]  # fmt: skip
    assert len({layer.color for layer in layers}) == 3
    assert [layer.density_percent for layer in layers] == [20, 60, 35]
    for layer in layers:
        assert layer.mesh.is_closed
    volumes = [layer.mesh.volume_mm3 for layer in layers]
    assert sum(volumes) == pytest.approx(part.solid.volume_mm3, rel=1e-6)
    cover, shell, base = (to_manifold(layer.mesh) for layer in layers)
    assert (cover ^ shell).volume() == pytest.approx(0, abs=1e-3)
    assert (cover ^ base).volume() == pytest.approx(0, abs=1e-3)
    # The cover is 2 mm thick, less at the rim, where the walls cut it.
    assert 1.7 < volumes[0] / top_area(layered, part) < 2.0


def top_area(insole: Insole, part: Part) -> float:
    up = part.solid.triangle_normals[:, 2] > 0.1
    corners = part.solid.vertices[part.solid.triangles[up]]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(cross, axis=1).sum() / 2)


def test_insole_without_layers_is_one_base(left_foot):
    (layer,) = part_of(insole_of(left_foot), layered=True).layers(SHOP)
    assert layer.name == "left insole, base"


def test_layers_are_one_thing_in_the_file(layered, tmp_path: Path):
    delivery = ExportJob((part_of(layered, layered=True),), SHOP)
    write(delivery, ExportPaths(tmp_path / "insole.3mf"))
    model = zipfile.ZipFile(tmp_path / "insole.3mf").read("3D/3dmodel.model").decode()
    assert re.findall(r'<component objectid="(\d+)"', model) == ["2", "3", "4"]
    assert re.findall(r'<item objectid="(\d+)"', model) == ["5"]
    assert re.findall(r"density_percent[^>]*>(\d+)<", model) == ["20", "60", "35"]


@pytest.mark.parametrize(("suffix", "objects"), [(".3mf", 3), (".amf", 1)])
def test_layers_open_in_a_slicer_with_the_right_size(layered, suffix, objects, tmp_path: Path):
    if shutil.which("prusa-slicer") is None:
        pytest.skip("the program prusa-slicer is not installed")
    part = part_of(layered, layered=True)
    path = tmp_path / f"insole{suffix}"
    write(ExportJob((part,), SHOP), ExportPaths(path))
    call = ["prusa-slicer", "--info", str(path)]
    said = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    assert re.findall(r"manifold = (\w+)", said) == ["yes"] * objects
    assert sum(map(int, re.findall(r"number_of_parts = +(\d+)", said))) == 3
    low, high = (
        np.array([re.findall(rf"{end}_{axis} = (\S+)", said) for axis in "xyz"], float)
        for end in ("min", "max")
    )
    size = high.max(axis=1) - low.min(axis=1)
    assert size == pytest.approx(np.ptp(part.solid.vertices, axis=0), abs=0.01)


def write(delivery: ExportJob, places: ExportPaths) -> None:
    with outputs(places) as beside:
        run_export_job(delivery, places, beside)


def dress_shell(foot: Foot) -> Insole:
    """A tapered short shell, whose lowest place was ahead of it or in its taper."""
    dress = read_device(resource_path("devices") / "dress-three-quarter.json")
    return build_insole(foot, apply_device(dress, InsoleDesign(foot.side)))


def test_a_short_shell_stands_on_the_ground_in_the_file(left_foot, tmp_path: Path):
    part = part_of(dress_shell(left_foot))
    assert part.solid.bounds_mm[0, 2] > 0.05
    write(ExportJob((part,), SHOP), ExportPaths(tmp_path / "dress.stl"))
    written = read_mesh(tmp_path / "dress.stl").mesh
    assert abs(written.bounds_mm[0, 2]) < 1e-6
    lowered = part.solid.bounds_mm - [0.0, 0.0, part.solid.bounds_mm[0, 2]]
    assert written.bounds_mm == pytest.approx(lowered, abs=1e-4)


@pytest.mark.shared
def test_a_shell_of_a_scan_stands_on_the_ground_in_the_file(real_foot, tmp_path: Path):
    foot = real_foot("plantar_scan.obj", Side.RIGHT)
    write(ExportJob((part_of(dress_shell(foot)),), SHOP), ExportPaths(tmp_path / "dress.3mf"))
    (written,) = trimesh.load(tmp_path / "dress.3mf").geometry.values()
    assert abs(written.bounds[0, 2]) < 1e-6


def test_a_pair_stands_on_the_ground_of_its_block(left_foot, right_foot):
    parts = part_of(dress_shell(left_foot)), part_of(dress_shell(right_foot))
    for placed in ExportJob(parts, SHOP, block=PAIR_BLOCK).placed():
        assert abs(placed.objects(SHOP)[0].mesh.bounds_mm[0, 2]) < 1e-6


def test_the_height_in_the_shoe_counts_from_where_the_insole_stands(left_foot):
    part = part_of(dress_shell(left_foot), read_rules().only(("shoe_height",)))
    low, high = part.solid.bounds_mm[:, 2]
    assert part.findings[0].value == pytest.approx(high - low, abs=0.11)  # seen every 1 mm


def test_one_least_thickness_on_all_papers(left_foot, tmp_path: Path, monkeypatch):
    sheets: list[JobSheet] = []
    monkeypatch.setattr(
        "insole_core.export.paper.write_job_sheet",
        lambda made, *_others, **_named: sheets.extend(made),
    )
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, thickness_mm=4.5))
    part = part_of(insole, read_rules().only(("thickness",)))
    paths = ExportPaths(tmp_path / "i.stl", tmp_path / "c.json", tmp_path / "j.pdf")
    run_export_job(ExportJob((part,), SHOP), paths, paths)
    (sheet,) = sheets
    assert sheet.make["prescribed thickness"] == "4.5 mm"
    (finding,) = json.loads((tmp_path / "c.json").read_text())["findings"]
    least = finding["value"]
    assert 4.5 <= least <= 4.6
    assert sheet.measures["least thickness, without the rim"] == f"{least} mm"
    assert sheet.checks[0].startswith(f"✓ {least} mm thick at ")


@pytest.mark.slow
def test_pair_in_one_block_with_its_papers(left_foot, right_foot, tmp_path: Path):
    parts = tuple(part_of(insole_of(foot)) for foot in (left_foot, right_foot))
    told = Message("Heel: ticked.")
    parts = (replace(parts[0], told=(told,)), parts[1])
    places = ExportPaths(*(tmp_path / name for name in ("pair.3mf", "c.json", "j.pdf", "p.pdf")))
    write(
        ExportJob(
            parts, SHOP, block=PAIR_BLOCK, identification={"pseudonym": "7"},
            responsible=RESPONSIBLE,
        ),
        places,
    )  # fmt: skip
    model = zipfile.ZipFile(tmp_path / "pair.3mf").read("3D/3dmodel.model").decode()
    assert re.findall(r'<object id="\d" name="([^"]+)"', model) == ["left insole", "right insole"]
    assert set(json.loads((tmp_path / "c.json").read_text())) == {"left", "right"}
    for name in ("j.pdf", "p.pdf"):
        assert text_of_pdf(tmp_path / name).count(told) == 1


def test_pair_that_does_not_fit_leaves_nothing(left_foot, right_foot, tmp_path: Path):
    parts = tuple(part_of(insole_of(foot)) for foot in (left_foot, right_foot))
    small = Block("small", (300.0, 110.0, 30.0))
    with pytest.raises(DesignError, match="The pair needs a block of"):
        write(ExportJob(parts, SHOP, block=small), ExportPaths(tmp_path / "pair.stl"))
    assert list(tmp_path.iterdir()) == []


def test_override_is_recorded(layered, tmp_path: Path):
    strict = ExportRules({"shoe_height": "blocking"}, {"shoe_height": 5.0})
    part, places = part_of(layered, strict), ExportPaths(tmp_path / "i.stl", tmp_path / "c.json")
    with pytest.raises(DesignError, match="override the rule with a reason"):
        write(ExportJob((part,), SHOP), places)
    write(ExportJob((part,), SHOP, override=Override("A. Berg", "high boot", "now")), places)
    record = json.loads((tmp_path / "c.json").read_text())
    assert record["override"]["reason"] == "high boot"
    assert record["findings"][0]["value"] > 5


def test_spots_are_where_the_limit_is_broken(layered):
    (finding,) = part_of(
        layered, ExportRules({"shoe_height": "warning"}, {"shoe_height": 15.0})
    ).findings
    assert len(finding.spots_mm) > 0
    assert finding.spots_mm[:, 2].min() > 15.0
    (calm,) = part_of(
        layered, ExportRules({"shoe_height": "warning"}, {"shoe_height": 90.0})
    ).findings
    assert len(calm.spots_mm) == 0


def test_letters_below_the_bottom_are_no_undercut(left_foot):
    plain = insole_of(left_foot)
    rules = read_rules().only(("undercut",))
    for relief in ("engraved", "raised"):
        order = Order(mark=("7 left",), relief=relief)
        (finding,) = make_part(plain, order, rules).findings
        assert finding.value == 0


def test_letters_that_the_font_lacks_are_named(left_foot):
    part = part_of(insole_of(left_foot), mark=("Ł 足 7",))
    assert "足" in part.notes[0]
    with pytest.raises(DesignError, match="none of the letters of “足”"):
        part_of(insole_of(left_foot), mark=("足",))


@pytest.mark.parametrize("text", ["Å. Öberg", "Иванов", "محمد", "אברהם"])
def test_names_of_many_scripts_are_engraved(left_foot, text):
    assert missing_letters(text) == ""
    assert part_of(insole_of(left_foot), mark=(text,)).solid.is_closed


def test_letters_that_run_from_the_right_are_joined_and_turned():
    assert as_written("محمد 7") == "7 ﺪﻤﺤﻣ"
    assert as_written("אב") == "בא"
    assert font_path().exists()


def test_prescription_names_every_number_and_its_author():
    pad = Pelott(centre_mm=(12.0, 150.0), height_mm=6.0, author="A. Berg", created_at="2026-11-20T")
    off = replace(pad, id="off", enabled=False)
    (line,) = correction_lines(InsoleDesign(Side.LEFT, corrections=(pad, off)))
    assert line.startswith("Pelott: Height 6 mm; Turn 0°; Length 60 mm; Width 40 mm; Taper 50 %; ")
    assert "12 mm medial of the axis, 150 mm from the heel" in line
    assert line.endswith("(A. Berg 2026-11-20)")


@pytest.mark.parametrize("diameter_mm", [0.0, 41.0])
def test_a_cutter_that_no_router_has_is_refused(diameter_mm: float) -> None:
    with pytest.raises(InputError, match=f"cutter of {diameter_mm:g} mm .* must be 1 to 40 mm"):
        read_rules().with_cutter(diameter_mm)


def test_rules_survive_writing(tmp_path: Path):
    rules = read_rules().with_rule("step", "blocking", 3.0).with_rule("watertight", "warning")
    write_rules(rules, tmp_path / "rules.json")
    assert read_rules(tmp_path / "rules.json") == rules


@pytest.mark.parametrize(
    ("key", "value", "sentence"),
    [
        ("format", "x", "insole-shop"),
        ("blocks", [{"name": "a", "size_mm": [1, 2]}], "must have 3"),
        ("blocks", [{"name": "a", "size_mm": [1, 2, 0]}], "above 0"),
        ("layers", {}, "cover is missing"),
    ],
)
def test_shop_that_cannot_be_read(tmp_path: Path, key: str, value: object, sentence: str):
    from insole_core.resources import resource_path

    content = json.loads(resource_path("rules/shop.json").read_text())
    path = tmp_path / "shop.json"
    path.write_text(json.dumps({**content, key: value}))
    with pytest.raises(InputError, match=sentence):
        read_shop(path)
    with pytest.raises(InputError, match="cannot be read"):
        read_shop(tmp_path / "none.json")


def test_paper_with_a_wrong_suffix(tmp_path: Path):
    with (
        pytest.raises(UsageError, match=r"written as \.pdf"),
        outputs(ExportPaths(tmp_path / "i.stl", prescription=tmp_path / "p.doc")),
    ):
        pass
