"""The table of materials, and what of a shell is warned about."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.materials import (
    Material,
    MaterialTable,
    ThicknessStep,
    check_materials,
    proposed_thickness,
    read_materials,
    with_least_thickness,
)
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.prescription_lines import make_facts
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.solids.solid import insole_solid
from insole_core.workflows.clinic_tables import ClinicMaterials

SHORT = Outline(extent="three_quarter")
THIN = Pelott(centre_mm=(0.0, 38.0), height_mm=-5.0, length_mm=30, width_mm=25)


@pytest.mark.parametrize(
    ("weight_kg", "thickness_mm"),
    [(5, 3.2), (77, 3.2), (77.1, 4.0), (95, 4.0), (113, 4.8), (114, 6.4), (250, 6.4)],
)
def test_polypropylene_by_weight(weight_kg: float, thickness_mm: float):
    assert proposed_thickness("polypropylene", weight_kg) == thickness_mm
    assert proposed_thickness(" Polypropylene ", weight_kg) == thickness_mm


@pytest.mark.parametrize(
    ("material", "weight_kg", "reason"),
    [
        ("polypropylene", None, "without the body weight; put in the weight"),
        ("polypropylene", 0.0, "0 kg cannot be right: it must be 5 to 250 kg"),
        ("polypropylene", 700.0, "700 kg cannot be right"),
        ("polypropylene", float("nan"), "nan kg cannot be right"),
        ("", 70.0, "without a material; choose one of polypropylene, "),
        ("granite", 70.0, "No thickness is known for the material granite; choose one of"),
    ],
)
def test_what_is_missing_or_absurd_is_said(material: str, weight_kg: float | None, reason: str):
    with pytest.raises(DesignError, match=reason):
        proposed_thickness(material, weight_kg)


def a_table(**changes: object) -> dict[str, object]:
    known = {"name": "cork", "least_mm": 2.5, "least_edge_mm": 1.5, "thickness": [{"mm": 5}]}
    materials = [{**known, **changes}]
    return {"format": "insole-materials", "version": 1, "materials": materials}


def test_a_clinic_has_a_table_of_its_own(tmp_path: Path):
    path = tmp_path / "materials.json"
    path.write_text(json.dumps(a_table()))
    table = read_materials(path)
    assert table.names == ("cork",)
    assert proposed_thickness("Cork", 80, table) == 5
    with pytest.raises(DesignError, match="polypropylene; choose one of cork"):
        proposed_thickness("polypropylene", 80, table)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"least_mm": -1}, r"materials\[0\].least_mm"),
        ({"thickness": []}, "must go from light to heavy"),
        ({"thickness": [{"up_to_kg": 80, "mm": 3}]}, "end with a step without up_to_kg"),
        ({"thickness": [{"up_to_kg": 90, "mm": 3}, {"up_to_kg": 80, "mm": 4}, {"mm": 5}]}, "light"),
        ({"thickness": [{"mm": 900}]}, "mm"),
    ],
)
def test_a_wrong_table_is_refused(tmp_path: Path, changes: dict[str, object], reason: str):
    path = tmp_path / "materials.json"
    path.write_text(json.dumps(a_table(**changes)))
    with pytest.raises(InputError, match=reason):
        read_materials(path)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ({**a_table(), "rows": 3}, "rows is no key of a table of materials"),
        ({**a_table(), "materials": []}, "holds no material"),
        (a_table(lest_mm=2), r"lest_mm is no key"),
        (a_table(thickness=[{"mm": 3, "kg": 80}]), "kg is no key"),
        (a_table(name="  "), "not empty"),
        (a_table(thickness=[{"up_to_kg": 900, "mm": 3}, {"mm": 4}]), "up_to_kg"),
    ],
)
def test_a_table_is_read_strictly(tmp_path: Path, content: dict[str, object], reason: str):
    path = tmp_path / "materials.json"
    path.write_text(json.dumps(content))
    with pytest.raises(InputError, match=reason):
        read_materials(path)


CARBON = Material("carbon", 1.2, 0.8, (ThicknessStep(90, 1.5), ThicknessStep(math.inf, 2.0)), "us")


def test_a_clinic_keeps_a_table_and_gets_that_of_the_product_back(tmp_path: Path):
    stored = ClinicMaterials(tmp_path)
    assert stored.load() == (read_materials(), None)
    stored.save((*read_materials().materials, CARBON))
    table, problem = stored.load()
    assert problem is None
    assert table.materials == (*read_materials().materials, CARBON)
    stored.save(read_materials().materials)
    assert stored.load()[0].materials == read_materials().materials


def test_a_broken_table_is_told_and_kept(tmp_path: Path):
    path = tmp_path / "materials.json"
    path.write_text("half a fi")
    table, problem = ClinicMaterials(tmp_path).load()
    assert table is read_materials()
    assert "materials.json is not valid JSON" in str(problem)
    ClinicMaterials(tmp_path).save([CARBON])
    assert [f.read_text() for f in tmp_path.glob("*.broken-1")] == ["half a fi"]


@pytest.mark.parametrize(
    ("rows", "reason"),
    [
        ([], "at least one material"),
        ([replace(CARBON, name=" ")], "needs a name"),
        ([CARBON, replace(CARBON, name="Carbon")], "There is a material Carbon already"),
        ([replace(CARBON, steps=(ThicknessStep(90, 1), ThicknessStep(80, 2)))], "light to heavy"),
    ],
)
def test_what_is_wrong_in_edited_rows_is_said(rows: list[Material], reason: str):
    check_materials([CARBON])
    with pytest.raises(InputError, match=reason):
        check_materials(rows)


def test_a_design_keeps_what_its_material_needs(left_foot: Foot):
    table = MaterialTable([CARBON, replace(CARBON, name="EVA", least_mm=5.0, least_edge_mm=2.0)])
    design = with_least_thickness(shelled(material="EVA"), table)
    assert design.shell is not None
    assert (design.shell.least_mm, design.shell.least_edge_mm) == (5.0, None)
    assert design_from_json(design_to_json(design)) == design
    plain, strong = (
        insole_solid(build_insole(left_foot, replace(d, bottom="following"))).volume_mm3
        for d in (shelled(material="EVA"), design)
    )
    assert strong > 1.2 * plain, "3 mm are asked for, and 5 mm made"
    assert with_least_thickness(design, read_materials()) == shelled(material="EVA")


def test_a_material_that_no_table_holds_keeps_its_limits(said):
    design = shelled(material="carbon", least_mm=2.5, least_edge_mm=1.5)
    assert with_least_thickness(design, read_materials()) is design
    (told,) = [text for text in said(design) if text.startswith("Nothing is known")]
    assert "2.5 mm thick, 1.5 mm at the front edge" in told


def test_names_with_commas_are_told_apart(said):
    (told,) = [text for text in said(shelled(material="carbon")) if text.startswith("Nothing is")]
    names = told.rpartition("choose one of ")[2].rstrip(".").split(" / ")
    assert names == list(read_materials().names)
    assert "PA12, printed" in names


@pytest.fixture
def said(left_foot: Foot) -> Callable[[InsoleDesign], list[str]]:
    """What is warned about an insole of the left foot, without what its pads give rise to."""
    marks, rules = find_landmarks(left_foot), load_rules()
    return lambda design: [
        str(warning.sentence)
        for warning in design_warnings(build_insole(left_foot, design), marks, rules)
    ]


def shelled(**shell: object) -> InsoleDesign:
    return InsoleDesign(Side.LEFT, outline=SHORT, shell=Shell(**shell))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("design", "start"),
    [
        (shelled(material="granite"), "Nothing is known of the material “granite”: the insole is"),
        (shelled(material="EVA", taper_mm=0.5), "The front edge is to taper to 0.5 mm, and EVA "),
        (
            shelled(body_weight_kg=100.0),
            "For 100 kg of body weight, polypropylene is usually 4.8 mm thick, and this insole is "
            "3 mm.",
        ),
        (shelled(edge_radius_mm=2.0), "An edge radius of 2 mm is more than half of the thickness"),
        (shelled(chamfer_mm=4.0), "A chamfer of 4 mm is more than half of the thickness; where "),
        (
            replace(shelled(), corrections=(THIN,)),
            "Only 1.",
        ),
        (
            replace(shelled(), corrections=(Pelott(centre_mm=(5.0, 160.0)),)),
            "The trim line runs through the pelott; move the line ahead of it, or the pad behind",
        ),
        (
            replace(
                shelled(),
                corrections=(Pelott(centre_mm=(20.0, 215.0), length_mm=30, width_mm=20),),
            ),
            "The pelott lies ahead of the trim line and is not made; move the line ahead of it",
        ),
    ],
)
def test_what_is_made_otherwise_is_said(said, design: InsoleDesign, start: str):
    assert len([text for text in said(design) if text.startswith(start)]) == 1


def test_a_taper_is_no_longer_than_half_of_a_small_shell(said):
    trim = ((38.0, 92.0), (-30.0, 90.0))
    texts = said(shelled(trim_mm=trim, taper_length_mm=60.0))
    assert any(text.startswith("A taper over 60 mm is too long for an insole of") for text in texts)
    assert not any("taper" in text for text in said(shelled(trim_mm=trim)))


def test_a_usual_shell_needs_no_warning(said):
    design = replace(shelled(body_weight_kg=70.0), thickness_mm=3.2)
    pelott = Pelott(centre_mm=(5.0, 130.0))
    shell_words = ("trim line", "taper", "radius", "material", "thick")
    texts = said(replace(design, corrections=(pelott,)))
    assert not any(word in text for text in texts for word in shell_words)
    assert not any(
        word in text
        for text in said(InsoleDesign(Side.LEFT, (pelott,), outline=SHORT))
        for word in shell_words
    )


def test_the_papers_name_the_shell():
    posts = (Post(angle_deg=4.0), Post(region="forefoot", angle_deg=-2.0, length_mm=30))
    design = InsoleDesign(
        Side.LEFT,
        device="Functional, three-quarter",
        outline=replace(SHORT, width_mm=-3.2),
        layers=Layers(cover_mm=2.0, cover_is_taken_off=True),
        shell=Shell(
            posts=posts, heel_pitch_mm=15, trim_mm=((30, 150), (0, 160), (-30, 150)),
            draft_medial_deg=5.0, body_weight_kg=82.0,
        ),
    )  # fmt: skip
    facts = make_facts(design)
    assert facts["device"] == "Functional, three-quarter"
    assert facts["prescribed thickness"] == "3 mm"
    assert facts["layers"].endswith("Cover is glued on later")
    assert facts["shell"] == (
        "Material polypropylene; Body weight 82 kg; Heel pitch 15 mm; Front edge 1 mm; "
        "Taper length 18 mm; Edge radius 1 mm; Medial draft 5°; Lateral draft 0°; Chamfer 0 mm; "
        "Trim line through 3 points, 60 × 10 mm, its middle at x = 0, y = 153.33 mm"
    )
    assert facts["rearfoot post"] == "Angle 4° medial; Edge radius 4 mm"
    assert facts["forefoot post"] == "Angle 2° lateral; Length 30 mm; Edge radius 4 mm"
    assert "Width -3.2 mm from the bisection of the 1st metatarsal" in facts["outline"]
    assert "rearfoot post" not in make_facts(InsoleDesign(Side.LEFT))


def test_papers_name_what_the_finish_prescribes():
    rim = (
        RimStation(border="medial", along=0.0, height_mm=14.0),
        RimStation(border="medial", along=0.45, height_mm=18.5),
    )
    design = InsoleDesign(Side.LEFT, finish=Finish(rim=rim, arch_fill_mm=1.6, toe_zone="sulcus"))
    facts = make_facts(design)
    assert facts["heel cup"] == "14 mm"
    assert facts["medial flange"] == "18.5 mm"
    assert "Toe zone sulcus" in facts["finish"]
    assert "Arch fill 1.6 mm" in facts["finish"]
    assert "finish" not in make_facts(InsoleDesign(Side.LEFT))
