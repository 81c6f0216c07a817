"""Zones of other density: bodies, dialects of the slicers, and what a real slicer makes of them."""

from __future__ import annotations

import errno
import json
import math
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import manifold3d
import numpy as np
import pytest

from benchmarks._printed_density import BED_MM, sliced
from insole_core.errors import DesignError, InputError, OutputError, UsageError
from insole_core.formats.slicer_3mf import (
    PRINTERS,
    Infill,
    Modifier,
    PrintedPart,
    Printer,
    write_slicer_3mf,
)
from insole_core.formats.three_mf import CORE
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.layers import Layers
from insole_core.pressure.laid_map import Placement, PressureMap
from insole_core.solids.export_job import standing
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, Part, make_part
from insole_core.solids.print_density import printed_densities
from insole_core.solids.print_presets import read_print_presets
from insole_core.solids.print_zones import PrintPlan, Zone, plan_of, read_zones, require_printable
from insole_core.solids.simplification import from_manifold, to_manifold
from insole_core.solids.zone_bodies import OVERLAP_MM, cut_by_zones, placed_print, zoned_part
from insole_studio.texts import translation_into

PLAIN = Infill(20, "grid")
LAYERS = Layers(cover_mm=2.0, shell_mm=3.0)


def part_of(foot, *pads: Pelott, **order) -> Part:
    design = InsoleDesign(
        foot.side, pads, thickness_mm=10, grid_mm=2.0, max_height_mm=12, layers=LAYERS
    )
    rules = read_rules().only(("watertight",))
    return make_part(build_insole(foot, design), Order(**order), rules)


@pytest.fixture(scope="module")
def part(left_foot) -> Part:
    return part_of(left_foot, Pelott(centre_mm=(0, 0.5 * left_foot.length_mm), shape="egg"))


def plan(*zones: Zone) -> PrintPlan:
    return PrintPlan(2, 3, 3, PLAIN, zones)


def zone(kind, density_percent: float = 15, **more) -> Zone:
    return Zone(kind, Infill(density_percent, "grid"), **more)


def test_thirds_of_the_foot_are_closed_bodies_that_reach_over_the_whole_part(part):
    printed = zoned_part(part, plan(zone("heel"), zone("arch", 40), zone("forefoot", 25))).printed
    assert [each.name for each in printed.modifiers] == ["heel 15 %", "arch 40 %", "forefoot 25 %"]
    bodies = [to_manifold(each.mesh) for each in printed.modifiers]
    inside = sum((body ^ to_manifold(part.solid)).volume() for body in bodies)
    assert inside == pytest.approx(part.solid.volume_mm3, rel=1e-3)
    low, high = part.solid.bounds_mm
    corners = np.array([each.mesh.bounds_mm for each in printed.modifiers])
    assert corners[:, 0].min(axis=0) == pytest.approx(low - OVERLAP_MM)
    assert corners[:, 1].max(axis=0) == pytest.approx(high + OVERLAP_MM)


@pytest.mark.slow
def test_layers_together_are_the_insole(part):
    zones = zoned_part(part, plan(*map(zone, ("cover", "shell", "base")))).printed.modifiers
    solid = to_manifold(part.solid)
    volumes = [(to_manifold(each.mesh) ^ solid).volume() for each in zones]
    assert sum(volumes) == pytest.approx(part.solid.volume_mm3, rel=1e-3)
    assert volumes[1] / volumes[0] == pytest.approx(1.5, rel=0.2)


def test_zone_of_pressure_lies_where_the_pressure_is(part):
    kpa = np.full((30, 12), 50.0)
    kpa[20:25, 4:8] = 260.0
    length = part.insole.foot.length_mm
    laid = PressureMap(kpa, (10.0, 10.0), Placement(x_mm=0.0, y_mm=length / 2))
    asked = zone("pressure", kpa=(200.0, np.inf))
    modifier = zoned_part(part, plan(asked), laid).printed.modifiers[0]
    assert modifier.name == "from 200 kPa 15 %"
    spots = laid.placement.to_insole(laid.centres_mm[kpa > 200])
    assert modifier.mesh.bounds_mm.mean(axis=0)[:2] == pytest.approx(spots.mean(axis=0), abs=1)
    with pytest.raises(DesignError, match="lies nowhere from 400 kPa"):
        zoned_part(part, plan(zone("pressure", kpa=(400.0, np.inf))), laid)


def test_of_two_zones_that_overlap_the_later_one_is_obeyed_and_told(part):
    notes = zoned_part(part, plan(zone("heel"), zone("pad", 40), zone("cover"))).notes
    assert notes == ("The zones “pads” and “cover” overlap; there, “cover” is obeyed.",)


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        (zone("pad", pad="cut-out"), "The left insole has no pad “cut-out”; its pads are: pelott."),
        (zone("pressure", kpa=(200.0, np.inf)), "needs a map of pressures under the left foot"),
    ],
)
def test_zone_that_is_not_there(part, asked, sentence):
    with pytest.raises(DesignError, match=sentence):
        zoned_part(part, plan(asked))


def test_zone_thinner_than_two_walls_or_beside_the_insole(left_foot):
    thin = Pelott(centre_mm=(0, 120), shape="bar", length_mm=30, width_mm=30)
    part = part_of(left_foot, replace(thin, outline_mm=None))
    narrow = replace(part.insole, design=replace(part.insole.design, layers=Layers(cover_mm=0.5)))
    with pytest.raises(DesignError, match="“cover” is thinner than two walls"):
        zoned_part(replace(part, insole=narrow), plan(zone("cover")))
    with pytest.raises(DesignError, match="“shell” is a layer that the design does not have"):
        zoned_part(replace(part, insole=narrow), plan(zone("shell")))
    away = replace(thin, centre_mm=(500.0, 120.0))
    moved = replace(part.insole, design=replace(part.insole.design, corrections=(away,)))
    with pytest.raises(DesignError, match="does not lie on the left insole"):
        zoned_part(replace(part, insole=moved), plan(zone("pad")))


def test_only_insoles_have_zones(part):
    with pytest.raises(DesignError, match="for insoles only"):
        zoned_part(replace(part, order=Order(kind="block")), plan(zone("heel")))


def test_cut_by_zones_the_surface_stays_whole(part):
    asked = plan(zone("heel"), zone("arch", 40), zone("pad", 70))
    printed = zoned_part(part, asked).printed
    surface, zones = cut_by_zones(printed)
    assert surface.area_mm2 == pytest.approx(part.solid.area_mm2)
    assert set(zones) == {-1, 0, 1, 2}
    length = part.insole.foot.length_mm
    for x, share, asked_there in ((0, 0.15, 0), (0, 0.5, 2), (30, 0.5, 1), (0, 0.85, -1)):
        away = surface.vertices[:, :2] - [x, share * length]
        assert zones[np.hypot(*away.T).argmin()] == asked_there  # the later zone: pad in arch


def test_sentences_name_zones_in_the_language_of_the_reader(part):
    with pytest.raises(DesignError) as caught:
        zoned_part(part, plan(zone("pressure", kpa=(200.0, math.inf))))
    swedish = translation_into("sv")(caught.value.message)
    assert "”från 200 kPa”" in swedish
    (overlap,) = zoned_part(part, plan(zone("heel"), zone("pad"), zone("cover"))).notes
    assert "”överdrag”" in translation_into("sv")(overlap)


def test_denser_with_the_body_weight():
    for preset in read_print_presets():
        light, heavy = (plan_of(preset, kg).zones for kg in (50, 130))
        assert [each.kind for each in light] == ["heel", "arch", "forefoot"]
        for a, b in zip(light, heavy, strict=True):
            assert a.infill.density_percent <= b.infill.density_percent


def zones_file(path: Path, **changes) -> Path:
    content = {"format": "insole-zones", "version": 1, "preset": "TPU, Shore 85", "zones": []}
    path.write_text(json.dumps({**content, **changes}))
    return path


def test_zones_file(tmp_path):
    zones = [
        {"zone": "heel", "density_percent": 10},
        {"zone": "pad", "pad": "pelott", "density_percent": 40, "pattern": "grid", "side": "left"},
    ]
    rest = {"density_percent": 30}
    read = read_zones(zones_file(tmp_path / "z.json", walls=4, rest=rest, zones=zones, graded=True))
    assert (read.graded, read.layer_mm, read.g_per_cm3) == (True, 0.2, 1.2)
    assert (read.walls, read.rest) == (4, Infill(30, "gyroid"))
    assert [each.name for each in read.zones] == ["arch", "forefoot", "heel", "pelott"]
    assert read.zones[3] == Zone("pad", Infill(40, "grid"), pad="pelott", side=Side.LEFT)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"preset": "PLA"}, 'preset is "PLA", but must be'),
        ({"zones": [{"zone": "toe", "density_percent": 20}]}, 'zone is "toe", but must be'),
        ({"zones": [{"zone": "heel", "density_percent": 0}]}, "density_percent"),
        ({"zones": [{"zone": "heel", "density_percent": 101}]}, "density_percent"),
        ({"zones": [{"zone": "heel", "density": 20}]}, "density.* is no key"),
        ({"zones": [{"zone": "heel", "density_percent": 20}] * 2}, 'names "heel" twice'),
        (
            {"zones": [{"zone": "pressure", "from_kpa": 9, "to_kpa": 9, "density_percent": 20}]},
            "to_kpa must be above from_kpa",
        ),
        (
            {"zones": [{"zone": "pad", "pad": f"{n}", "density_percent": 9} for n in range(51)]},
            "has 51 zones, and a print may have 50",
        ),
        ({"weight_kg": 3}, "weight_kg"),
    ],
)
def test_bad_zones_file(tmp_path, changes, sentence):
    with pytest.raises(InputError, match=sentence):
        read_zones(zones_file(tmp_path / "z.json", **changes))


def test_more_than_a_hundred_zones_have_their_densities():
    boxes = [
        from_manifold(manifold3d.Manifold.cube((3, 12, 3)).translate((3 * n, -1, -1)))
        for n in range(150)
    ]
    body = from_manifold(manifold3d.Manifold.cube((450, 10, 1)))
    zones = tuple(Modifier(box, f"{n}", PLAIN) for n, box in enumerate(boxes))
    found = printed_densities(PrintedPart(body, "P", 1, 0, 0, PLAIN, zones), 0.5, 1.2).zones
    assert [each.name for each in found[-150:]] == [f"{n}" for n in range(150)]


def test_pattern_that_a_slicer_does_not_have():
    comb = replace(plan(), rest=Infill(20, "honeycomb"))
    require_printable(comb, "orca")
    with pytest.raises(UsageError, match="Cura has no pattern honeycomb"):
        require_printable(comb, "cura")


@pytest.fixture(scope="module")
def files(part, tmp_path_factory) -> dict[Printer, Path]:
    folder = tmp_path_factory.mktemp("prints")
    printed = zoned_part(part, plan(zone("heel", 15), zone("arch", 100))).printed
    for printer in PRINTERS:
        write_slicer_3mf([printed, printed], folder / f"{printer}.3mf", printer, "Å & Ö")
    return {printer: folder / f"{printer}.3mf" for printer in PRINTERS}


def test_full_disk_leaves_nothing_half_written(part, tmp_path, monkeypatch):
    def full(_archive: zipfile.ZipFile, name: str, *_rest: object) -> None:
        if name.startswith("Metadata/"):
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(zipfile.ZipFile, "writestr", full)
    printed = zoned_part(part, plan(zone("heel"))).printed
    path = tmp_path / "i.3mf"
    path.write_text("old")
    with pytest.raises(OutputError, match="the disk is full; free some space and try again"):
        write_slicer_3mf([printed], path, "orca")
    assert [each.name for each in tmp_path.iterdir()] == ["i.3mf"]
    assert path.read_text() == "old"


def xml_of(path: Path, name: str) -> ElementTree.Element:
    with zipfile.ZipFile(path) as archive:
        return ElementTree.fromstring(archive.read(name))


def model_of(path: Path) -> ElementTree.Element:
    return xml_of(path, "3D/3dmodel.model")


def settings_of(element: ElementTree.Element) -> dict[str, str]:
    return {each.attrib["key"]: each.attrib["value"] for each in element.findall("metadata")}


def test_prusaslicer_reads_volumes_by_their_triangles(files):
    config = xml_of(files["prusaslicer"], "Metadata/Slic3r_PE_model.config")
    meshes = model_of(files["prusaslicer"]).findall(f".//{{{CORE}}}triangles")
    for each, mesh in zip(config.findall("object"), meshes, strict=True):
        assert settings_of(each)["perimeters"] == "2"
        volumes = each.findall("volume")
        spans = [(int(v.attrib["firstid"]), int(v.attrib["lastid"])) for v in volumes]
        assert [first for first, _ in spans] == [0, *(last + 1 for _, last in spans[:-1])]
        assert spans[-1][1] == len(mesh) - 1
        heel, arch = map(settings_of, volumes[1:])
        assert heel["volume_type"] == "ParameterModifier"
        assert (heel["name"], heel["fill_density"]) == ("heel 15 %", "15%")
        assert (arch["fill_density"], arch["fill_pattern"]) == ("100%", "rectilinear")


def test_orca_reads_parts_by_the_ids_of_components(files):
    config = xml_of(files["orca"], "Metadata/model_settings.config")
    model = model_of(files["orca"])
    objects = {each.attrib["id"]: each for each in model.findall(f".//{{{CORE}}}object")}
    built = [each.attrib["objectid"] for each in model.findall(f".//{{{CORE}}}item")]
    assert [each.attrib["id"] for each in config.findall("object")] == built
    for each in config.findall("object"):
        components = objects[each.attrib["id"]].findall(f".//{{{CORE}}}component")
        parts = each.findall("part")
        assert [c.attrib["objectid"] for c in components] == [p.attrib["id"] for p in parts]
        assert [p.attrib["subtype"] for p in parts] == ["normal_part", *["modifier_part"] * 2]
        assert settings_of(parts[1])["sparse_infill_density"] == "15%"
        assert settings_of(each)["wall_loops"] == "2"


def test_cura_reads_settings_of_each_body(files):
    objects = model_of(files["cura"]).findall(f".//{{{CORE}}}object[{{{CORE}}}mesh]")
    read = [
        {entry.attrib["name"]: entry.text for entry in each.iter(f"{{{CORE}}}metadata")}
        for each in objects
    ]
    assert [each.get("cura:infill_mesh") for each in read] == [None, "True", "True"] * 2
    assert [each["cura:infill_sparse_density"] for each in read[:3]] == ["20", "15", "100"]
    assert [each["cura:infill_pattern"] for each in read[:3]] == ["grid", "grid", "lines"]


def test_prusaslicer_prints_each_zone_at_its_density(left_foot, tmp_path):
    """Two boxes in heel and arch: the plastic of the infill fills as much of them as asked.

    At half the size and coarse, for an insole of full length takes ten seconds to slice.
    """
    part = part_of(left_foot, most_triangles=2500, most_deviation_mm=2)
    printed = zoned_part(part, plan(zone("heel", 15), zone("arch", 40))).printed
    printed = replace(printed, infill=Infill(5, "grid"), walls=1, top_layers=1, bottom_layers=1)
    path = tmp_path / "zones.3mf"
    half = np.diag([0.5, 0.5, 0.5, 1.0])
    placed = placed_print(printed, half @ standing(part.solid))
    write_slicer_3mf([placed], path, "prusaslicer")
    result = sliced(path, tmp_path, layer_mm=0.35)
    if result is None:
        pytest.skip("the program prusa-slicer is not installed")
    assert result.complaints == ()
    told = printed_densities(placed, 0.35, 1.0)
    mass_mm3 = 1000 * sum(each.mass_g for each in told.zones)
    assert mass_mm3 == pytest.approx(result.plastic_mm3.sum(), rel=0.05)
    middle = part.solid.bounds_mm.mean(axis=0)[:2]
    for share, asked in ((0.15, 15), (0.45, 40)):
        at = (np.array([0.0, share * left_foot.length_mm]) - middle) / 2 + BED_MM / 2
        density = result.density_percent([*(at - 6), 0.8], [*(at + 6), 3.8])
        assert density == pytest.approx(asked, rel=0.15)
    # No wall stands on the border between two zones, where the patient would feel it.
    walls, _ = result.of("erimeter").pieces()
    border_mm = (np.array([0.0, 0.31 * left_foot.length_mm]) - middle) / 2 + BED_MM / 2
    beside = np.abs(walls[:, :2] - border_mm) < [8.0, 2.0]
    assert len(walls) > 1000
    assert not (beside.all(axis=1) & (walls[:, 2] > 0.8) & (walls[:, 2] < 3.8)).any()


@pytest.mark.parametrize("printer", PRINTERS)
def test_every_file_of_the_archive_has_its_type_and_zones_have_no_walls(files, printer):
    types = xml_of(files[printer], "[Content_Types].xml")
    known = {each.attrib["Extension"] for each in types}
    with zipfile.ZipFile(files[printer]) as archive:
        names = archive.namelist()
        texts = [archive.read(name).decode() for name in names if name.startswith("Metadata/")]
    assert {name.rsplit(".", 1)[-1] for name in names[1:]} <= known
    for text in texts:
        zones = text.split("heel 15 %")[1:]
        assert len(zones) == 2
        assert not any("wall_loops" in each.split("</object>")[0] for each in zones)
        assert not any("perimeters" in each.split("</object>")[0] for each in zones)


def test_graded_borders_are_strips_between_the_densities(part):
    zones = (zone("heel", 20), zone("arch", 40))
    printed = zoned_part(part, replace(plan(*zones), graded=True)).printed
    names = [str(each.name) for each in printed.modifiers]
    assert names == [
        "heel 20 %", "heel to arch 25 %", "heel to arch 30 %", "heel to arch 35 %", "arch 40 %",
    ]  # fmt: skip
    heel, *strips, arch = (to_manifold(each.mesh) for each in printed.modifiers)
    reach = [arch.bounding_box()[1] - strip.bounding_box()[1] for strip in strips]
    assert reach == pytest.approx([12.0, 8.0, 4.0], abs=0.1)
    assert all((strip - heel).volume() < 1 for strip in strips)
    alike = zoned_part(part, replace(plan(zone("heel", 20), zone("arch", 24)), graded=True))
    assert len(alike.printed.modifiers) == 2
