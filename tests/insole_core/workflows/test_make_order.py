"""What goes to the workshop: a pair checked as it is nested, places in the file, and no name."""

from __future__ import annotations

import json
import re
import zipfile
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from read_pdf import bytes_of_pdf, text_of_pdf
from reportlab.pdfgen.canvas import Canvas

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.export.shop_order import OrderTerms, Release
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import ArchRaise, Pelott, Posting
from insole_core.insole.elements.words import number_message
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.materials import read_materials
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.prescription_lines import correction_lines
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.resources import resource_path
from insole_core.scans.mesh_file import read_mesh
from insole_core.solids.checks import Override
from insole_core.solids.export_job import ExportJob
from insole_core.solids.export_rules import ExportRules, read_rules
from insole_core.solids.nesting import closest_nest
from insole_core.solids.order import Part
from insole_core.solids.order_number import new_order_number
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.workflows.clinic_tables import ClinicBlocks, require_names
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.make_order import (
    OrderChoice,
    files_of,
    letters_told,
    make_parts,
    mark_of,
    write_order,
)
from insole_core.workflows.nameless import require_nameless

SHOP = read_shop()
NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
PATIENT = Patient("Ottilia Bergqvist", "1970-02-28", "2026-11-20", "Ottilia limps")
RESPONSIBLE = Responsible("A. Ek", "Foot Clinic", "Sula AB", "Gatan 1, Lund")
SMALL = Block("small", (300.0, 150.0, 40.0))
RULES = ExportRules(
    {"watertight": "blocking", "block": "warning", "shoe_height": "warning"},
    {"shoe_height": 10.0},
)


@pytest.fixture(scope="module")
def record(left_foot: Foot, right_foot: Foot) -> CaseRecord:
    pad = Pelott(centre_mm=(12.0, 150.0), author="A. Ek", created_at="2026-11-20")
    feet = tuple(
        FootRecord.begun(foot, NOWHERE, InsoleDesign(foot.side, (pad,), grid_mm=2.0))
        for foot in (left_foot, right_foot)
    )
    return CaseRecord(PATIENT, feet, Side.LEFT)


def block_of(name: str) -> Block:
    return next(block for block in SHOP.blocks if block.name == name)


def findings_of(record: CaseRecord, **order: object) -> list[dict[str, object]]:
    parts = make_parts(record, OrderChoice(**order), RULES)  # type: ignore[arg-type]
    return [{f.name: f for f in part.findings} for part in parts]


def test_without_a_block_none_is_checked(record: CaseRecord) -> None:
    (alone,) = findings_of(record)
    assert set(alone) == {"watertight", "shoe_height"}
    (alone,) = findings_of(record, block=block_of("EVA single"))
    assert alone["block"].passed  # type: ignore[attr-defined]


def test_a_pair_is_checked_as_it_is_nested(record: CaseRecord) -> None:
    """Each insole alone fits a block of 150 mm, and both together do not."""
    (alone,) = findings_of(record, block=SMALL)
    assert alone["block"].passed  # type: ignore[attr-defined]
    for found in findings_of(record, both=True, block=SMALL):
        finding = found["block"]
        assert finding.blocks  # type: ignore[attr-defined]
        assert "The pair needs a block of" in finding.sentence  # type: ignore[attr-defined]


def test_lot_and_serial_number_stand_on_paper_and_by_choice_on_the_piece(
    record: CaseRecord, tmp_path: Path
) -> None:
    release = Release("26-7KQ4M", 2)
    choice = OrderChoice(
        pseudonym="P-17", relief="engraved", numbered=True, release=release, prescription=True,
        terms=OrderTerms(quantity=3, lot="L-42/7", remarks="Soft under the heel"),
        most_triangles=None,
    )  # fmt: skip
    (part,) = make_parts(record, choice, ExportRules({}, {}))
    assert part.order.mark[-2:] == ("SN 26-7KQ4M-P-17-2-L", "LOT L-42/7")
    assert not choice.makes_alike(replace(choice, release=Release("26-7KQ4M", 3)))
    assert not choice.makes_alike(replace(choice, terms=replace(choice.terms, lot="L-43")))
    bare = replace(choice, numbered=False)
    assert not [line for line in mark_of(bare, Side.LEFT) if "L-42" in line or "SN" in line]
    assert bare.makes_alike(replace(bare, release=Release("26-7KQ4M", 3)))
    write_order(
        [part], choice, tmp_path / "o.stl",
        shop=SHOP, patient=PATIENT, responsible=RESPONSIBLE, release=release,
    )  # fmt: skip
    for paper in ("job-sheet", "prescription"):
        text = text_of_pdf(tmp_path / f"o-left-{paper}.pdf")
        assert "L-42/7" in text
        assert "26-7KQ4M-P-17-2-L/1" in text
        on_pages = {"job-sheet": 2, "prescription": 0}[paper]
        assert text.count("Soft under the heel") == on_pages, "on the drawing and on the sheet"
    with pytest.raises(InputError, match="26-7KQ4M-P-17-2-L, and it is 26-8HT2C-P-17-2-L"):
        write_order(
            [part], choice, tmp_path / "p.stl",
            shop=SHOP, patient=PATIENT, responsible=RESPONSIBLE, release=Release("26-8HT2C", 2),
        )  # fmt: skip


def test_a_name_from_right_to_left_is_drawn_in_its_order(
    record: CaseRecord, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the title block, which turned it round twice, as well as in the tables."""
    drawn: list[str] = []
    draw = Canvas.drawString

    def note(canvas: Canvas, x: float, y: float, text: str, **how: object) -> None:
        drawn.append(text)
        draw(canvas, x, y, text, **how)

    monkeypatch.setattr(Canvas, "drawString", note)
    name = "שרה לוי"
    choice = OrderChoice(pseudonym="P-17", most_triangles=None)
    (part,) = make_parts(record, choice, ExportRules({}, {}))
    write_order(
        [part], choice, tmp_path / "o.stl",
        shop=SHOP, patient=PATIENT, release=Release("26-7", by=name),
    )  # fmt: skip
    assert name[::-1] in drawn
    assert name not in drawn


@pytest.mark.parametrize(
    ("name", "missing"),
    [("Ottilia Bergqvist", ""), ("שרה לוי", ""), ("王小明 Wang", "王小明"), ("สมชาย", "สมชาย")],
)
def test_letters_that_no_paper_can_show_are_told_before_printing(name: str, missing: str) -> None:
    choice = OrderChoice(prescription=True)
    told = letters_told(choice, Patient(name), RESPONSIBLE)
    assert ("" if told is None else told.values["missing"]) == missing
    assert letters_told(replace(choice, prescription=False), Patient(name), RESPONSIBLE) is None
    in_remarks = replace(choice, prescription=False, terms=OrderTerms(remarks="軟"))
    assert letters_told(in_remarks, Patient(name), RESPONSIBLE) is not None


def inside_of_a_shoe() -> Shoe:
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    places = zip(46 * np.sin(turn), 135 - 135 * np.cos(turn), strict=True)
    return Shoe(name="42", inside_mm=tuple((float(x), float(y)) for x, y in places))


@pytest.mark.parametrize("block", [None, "EVA pair"])
def test_outlines_are_those_of_the_solids(
    record: CaseRecord, block: str | None, tmp_path: Path
) -> None:
    """In mm, a layer each, in the frame of the file; marked by order and side, not by name."""
    shoes = (inside_of_a_shoe(), None)
    feet = tuple(
        FootRecord.begun(foot.foot, NOWHERE, replace(foot.design, outline=Outline(shoe=shoe)))
        for foot, shoe in zip(record.feet, shoes, strict=True)
    )
    choice = OrderChoice(
        both=True, outlines=True, job_sheet=False, pseudonym="26-7KQ4M", most_triangles=None,
        block=None if block is None else block_of(block),
    )  # fmt: skip
    parts = make_parts(replace(record, feet=feet), choice, ExportRules({}, {}))
    write_order(parts, choice, tmp_path / "o.stl", shop=SHOP, patient=PATIENT)
    drawings = sorted(tmp_path.glob("*.dxf"))
    assert [path.name for path in drawings] == (
        ["o-left.dxf", "o-right.dxf"] if block is None else ["o-pair.dxf"]
    )
    layers: list[str] = []
    marks: list[str] = []
    for path in drawings:
        drawing = ezdxf.readfile(path)
        assert drawing.units == 4
        lines = list(drawing.modelspace().query("LWPOLYLINE"))
        assert all(line.closed for line in lines)
        points = np.concatenate(
            [list(line.get_points("xy")) for line in lines if line.dxf.layer == "INSOLE"]
        )
        solid = read_mesh(path.with_suffix(".stl")).mesh.bounds_mm[:, :2]
        assert np.stack([points.min(axis=0), points.max(axis=0)]) == pytest.approx(solid, abs=0.05)
        layers += [line.dxf.layer for line in lines]
        marks += [text.dxf.text for text in drawing.modelspace().query("TEXT")]
    assert Counter(layers) == {
        "INSOLE": 2, "COVER": 2, "SHOE": 1, **({} if block is None else {"BLOCK": 1})
    }  # fmt: skip
    assert marks == ["26-7KQ4M left", "26-7KQ4M right"]


def test_what_the_design_warns_of_stands_on_both_papers(record: CaseRecord, tmp_path: Path) -> None:
    """A pelott ahead of the heads, a relief deeper than the material, a transition without room."""
    pad = Pelott(centre_mm=(0.0, 185.0))
    relief = Pelott(
        centre_mm=(-15.0, 120.0), shape="cut_out", length_mm=22, width_mm=20, height_mm=-6
    )
    device = read_device(resource_path("devices/functional-three-quarter.json"))
    cupped = apply_device(device, InsoleDesign(Side.LEFT, (pad, relief), grid_mm=2.0))
    wide = replace(cupped.finish or Finish(), arch_blend_mm=25.0)
    foot = FootRecord.begun(record.feet[0].foot, NOWHERE, replace(cupped, finish=wide))
    choice = OrderChoice(prescription=True, checks=True, pseudonym="26-7KQ4M")
    shown = design_warnings(
        build_insole(foot.foot, foot.design), landmarks_of(foot), load_rules(), read_materials()
    )
    (part,) = make_parts(CaseRecord(PATIENT, (foot,), Side.LEFT), choice, ExportRules({}, {}))
    assert part.warnings == tuple(warning.sentence for warning in shown)
    written = " ".join(part.warnings)
    for words in ("ahead of the line of the heads", "the surface is raised", "transition"):
        assert words in written
    write_order(
        [part], choice, tmp_path / "o.stl", shop=SHOP, patient=PATIENT, responsible=RESPONSIBLE
    )
    for paper in ("job-sheet", "prescription"):
        text = "".join(text_of_pdf(tmp_path / f"o-left-{paper}.pdf").split())
        assert [said for said in part.warnings if "".join(said.split()) not in text] == []


@pytest.mark.parametrize("kind", ["insole", "block"])
def test_the_stock_has_a_block_for_an_ordinary_pair(record: CaseRecord, kind: str) -> None:
    for found in findings_of(record, both=True, kind=kind, block=block_of("EVA pair")):
        assert found["block"].passed  # type: ignore[attr-defined]


@pytest.mark.slow
@pytest.mark.fine
def test_places_of_a_nested_pair_are_those_of_the_file(record: CaseRecord, tmp_path: Path) -> None:
    feet = tuple(
        FootRecord.begun(each.foot, NOWHERE, InsoleDesign(each.foot.side, each.design.corrections))
        for each in record.feet
    )
    assert [each.design.grid_mm for each in feet] == [1.0, 1.0]
    choice = OrderChoice(
        both=True, block=block_of("EVA pair"), checks=True, pseudonym="26-7KQ4M",
        most_triangles=None,
    )  # fmt: skip
    parts = make_parts(replace(record, feet=feet), choice, RULES)
    write_order(parts, choice, tmp_path / "o.stl", shop=SHOP, patient=PATIENT)
    vertices = read_mesh(tmp_path / "o-pair.stl").mesh.vertices
    checks = json.loads((tmp_path / "o-pair-checks.json").read_text())
    for side in ("left", "right"):
        (worst,) = (f for f in checks[side]["findings"] if f["name"] == "shoe_height")
        x, y, z = worst["place_mm"]
        assert f"x = {x:.0f} mm, y = {y:.0f} mm" in worst["sentence"]
        near = np.linalg.norm(vertices[:, :2] - [x, y], axis=1) < 3
        assert vertices[near, 2].max() == pytest.approx(z, abs=0.5)
    text = text_of_pdf(tmp_path / "o-pair-job-sheet.pdf")
    x, y, _ = worst["place_mm"]
    assert f"x = {x:.0f} mm, y = {y:.0f} mm" in text.replace("\n", " ")
    sides = re.findall(r"EVA pair, (\d+) \S+ (\d+) ", text.replace("\n", " "))
    assert sides == 3 * [("340", "260")], "the page of the block, and the sheets of both sides"
    nest = closest_nest(*(part.solid for part in parts))
    left, _ = nest.in_middle_of(block_of("EVA pair").size_mm).meshes
    (low, _, _), (high, _, _) = left.bounds_mm
    assert f"x {low:.1f} " in text
    assert f" {high:.1f}, y" in text


def test_a_turned_part_says_so() -> None:
    finding = make_finding()
    half_turn = np.diag([-1.0, -1.0, 1.0, 1.0])
    half_turn[:3, 3] = (100.0, 300.0, 0.0)
    moved = finding.moved(half_turn)
    assert moved.place_mm == (90.0, 280.0, 5.0)
    assert "x = 90 mm, y = 280 mm" in moved.sentence
    assert moved.moved(np.linalg.inv(half_turn)).sentence == finding.sentence


def make_finding():
    from insole_core.messages import Message
    from insole_core.solids.checks import Finding

    place = Message("x = {x_mm:.0f} mm, y = {y_mm:.0f} mm", x_mm=10.0, y_mm=20.0)
    sentence = Message("{value:.2f} mm high at {place}", value=40.0, place=place)
    return Finding(
        "shoe_height", "warning", False, 40.0, 35.0, "mm high", sentence, (10.0, 20.0, 5.0)
    )


@pytest.fixture(params=[".stl", ".3mf", ".obj", ".ply", "text"])
def suffix(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def bytes_of(path: Path) -> bytes:
    """Every byte that whoever gets the file can read, and its name."""
    content = path.name.encode() + path.read_bytes()
    if path.suffix == ".pdf":
        content += bytes_of_pdf(path)
    if path.suffix == ".3mf":
        with zipfile.ZipFile(path) as archive:
            content += b"".join(archive.read(name) for name in archive.namelist())
            content += "".join(archive.namelist()).encode()
    return content


NUMBER = new_order_number(date(2026, 11, 22))
NAMELESS = OrderChoice(
    both=True, block=block_of("EVA pair"), checks=True, prescription=True, pseudonym=NUMBER,
    relief="engraved", most_triangles=None,
)  # fmt: skip


@pytest.fixture(scope="module")
def nameless_parts(record: CaseRecord) -> tuple[Part, ...]:
    return make_parts(record, NAMELESS, RULES)


@pytest.mark.slow
def test_the_shop_never_gets_the_name(
    nameless_parts: tuple[Part, ...], tmp_path: Path, suffix: str
) -> None:
    number, parts = NUMBER, nameless_parts
    is_text = suffix == "text"
    choice = replace(NAMELESS, suffix=".stl" if is_text else suffix, ascii_stl=is_text)
    path = tmp_path / f"{number}{choice.suffix}"
    write_order(parts, choice, path, shop=SHOP, patient=PATIENT, responsible=RESPONSIBLE)
    files = files_of(parts, choice, path, False)
    own = tmp_path / f"{number}-pair-prescription.pdf"
    assert set(files) == set(tmp_path.iterdir())
    for file in set(files) - {own}:
        held = bytes_of(file).lower()
        for word in (b"ottilia", b"bergqvist", b"1970-02-28", b"limps"):
            assert word not in held, file
        assert number.encode() in bytes_of(file)
    solid = bytes_of(path.with_name(f"{number}-pair{choice.suffix}"))
    if suffix == ".stl":
        assert number.encode() in solid.split(b"Insole Studio")[1][:80]
    if suffix == ".3mf":
        assert f'<metadata name="Title">Insole {number}</metadata>'.encode() in solid
    assert "Ottilia Bergqvist" in text_of_pdf(own)


def test_order_numbers_tell_nothing_and_differ() -> None:
    numbers = {new_order_number(date(2026, 11, 22)) for _ in range(200)}
    assert len(numbers) == 200
    assert all(re.fullmatch(r"26-[2-9B-DF-HJ-NP-TV-Y]{5}", number) for number in numbers)


@pytest.mark.parametrize(
    ("what", "change"),
    [
        ("pseudonym", {"pseudonym": "Bergqvist"}),
        ("text on the bottom", {"relief": "engraved", "text": "O. BERGQVIST\nleft"}),
        ("name of the material", {"material": "EVA for bergqvist"}),
    ],
)
def test_a_name_typed_for_the_shop_is_refused(
    record: CaseRecord, tmp_path: Path, what: str, change: dict[str, str]
) -> None:
    choice = OrderChoice(most_triangles=None)
    parts = make_parts(record, choice, RULES)
    with pytest.raises(InputError, match=f"The {what} holds the patient's name"):
        write_order(
            parts, replace(choice, **change), tmp_path / "o.stl", shop=SHOP, patient=PATIENT
        )
    with pytest.raises(InputError, match="The file name holds the patient's name"):
        write_order(parts, choice, tmp_path / "Bergqvist.stl", shop=SHOP, patient=PATIENT)
    with pytest.raises(InputError, match="The reason for the export holds the patient's name"):
        write_order(
            parts, choice, tmp_path / "o.stl", shop=SHOP, patient=PATIENT,
            override=Override("A. Ek", "Mrs Bergqvist wants it", "now"),
        )  # fmt: skip
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "text", "holds"),
    [
        ("Anna Berg", "anna-left", False),
        ("Anna Berg", "berg_left", True),
        ("Berg, Anna", "Berg", True),
        ("Berg, Anna", "Anna", False),
        ("Eva Ek", "EVA, Shore A 35", False),
        ("Madonna", "madonna left", True),
        ("Åsa Öberg", "ÖBERG", True),
        ("Anna B.", "B left", False),
        ("", "anything", False),
    ],
)
def test_what_counts_as_the_name(name: str, text: str, holds: bool) -> None:
    if not holds:
        require_nameless(Patient(name), {"text": text})
        return
    with pytest.raises(InputError, match="must not get"):
        require_nameless(Patient(name), {"text": text})


def test_each_foot_is_ordered_in_the_material_of_its_prescription(
    record: CaseRecord, tmp_path: Path
) -> None:
    left = record.feet[0]
    shelled = replace(left.design, shell=Shell(), bottom="following")
    record = record.with_foot(left.with_design(shelled))
    choice = OrderChoice(both=True, material="Felt", pseudonym="26-7KQ4M")
    for ordered, words in (
        (choice, ("polypropylene", "Felt")),
        (replace(choice, own_materials={Side.LEFT: "Carbon"}), ("Carbon", "Felt")),
    ):
        parts = make_parts(record, ordered, RULES)
        write_order(parts, ordered, tmp_path / "o.stl", shop=SHOP, patient=PATIENT)
        for side, word in zip(("left", "right"), words, strict=True):
            (sheet,) = tmp_path.glob(f"o-{side}*.pdf")
            text = text_of_pdf(sheet)
            assert re.search(rf"Material\n{word}", text)
            assert f"Material\n{', '.join(words)}\n" in text  # where both feet are drawn
            assert "–" not in "".join(re.findall(r"Material\n(.*)", text))


@pytest.fixture
def prescribe(record: CaseRecord, tmp_path: Path) -> Callable[..., str]:
    choice = OrderChoice(
        prescription=True, job_sheet=False, pseudonym="26-7KQ4M", most_triangles=None
    )
    parts = make_parts(record, choice, RULES)

    def write(patient: Patient = PATIENT, responsible: Responsible = RESPONSIBLE) -> str:
        write_order(
            parts, choice, tmp_path / "o.stl", shop=SHOP, patient=patient, responsible=responsible
        )
        return text_of_pdf(tmp_path / "o-left-prescription.pdf")

    return write


def test_the_prescription_names_author_and_maker(prescribe: Callable[..., str]) -> None:
    text = prescribe()
    for words in ("A. Ek", "Foot Clinic", "Sula AB", "Gatan 1, Lund", "1970-02-28", "26-7KQ4M"):
        assert words in text
    assert "{" not in text


@pytest.mark.parametrize(
    ("change", "missing"),
    [
        ({"prescriber": " "}, "the prescriber"),
        ({"maker": ""}, "the maker"),
        ({"maker_address": ""}, "the maker's address"),
    ],
)
def test_a_prescription_is_not_written_without_what_it_states(
    prescribe: Callable[..., str], tmp_path: Path, change: dict[str, str], missing: str
) -> None:
    with pytest.raises(InputError, match=f"cannot be written without {missing}"):
        prescribe(responsible=replace(RESPONSIBLE, **change))
    assert list(tmp_path.iterdir()) == []


def test_a_prescription_with_a_nonsense_date_is_not_written(
    prescribe: Callable[..., str], tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="1970-02-30 is no date"):
        prescribe(patient=replace(PATIENT, born="1970-02-30"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [
        (1.92154, 1, "1.9"), (-0.0, 1, "0"), (-0.04, 1, "0"), (6.0, 1, "6"), (0.25, 2, "0.25"),
        (1e7, 1, "10000000"), (100.0, 0, "100"), (-4.5, 1, "-4.5"),
    ],
)  # fmt: skip
def test_numbers_on_paper_have_the_precision_of_the_tool(
    value: float, decimals: int, text: str
) -> None:
    assert number_message(value, decimals) == text


def test_a_prescription_prints_no_needless_digits() -> None:
    pad = Pelott(centre_mm=(12.3456, -0.0), height_mm=1.92154, turn_deg=-0.0, egg_ratio=1 / 3)
    (line,) = correction_lines(InsoleDesign(Side.LEFT, (pad,)))
    assert "Height 1.9 mm" in line
    assert "12.3 mm medial of the axis, 0 mm from the heel" in line
    assert "Turn 0°" in line
    assert "Taper 33.3 %" in line


def test_a_prescription_names_an_element_and_the_height_of_an_arch() -> None:
    relief = Pelott(
        centre_mm=(-9, 186), shape="cut_out", kind="relief_head_3", length_mm=22, width_mm=20,
        height_mm=-2,
    )  # fmt: skip
    own = replace(relief, id="own", kind="felt_pad")
    arch = ArchRaise(target_mm=28.0, apex_mm=(16.0, 120.0))
    lines = correction_lines(InsoleDesign(Side.LEFT, (relief, own, arch)))
    assert lines[0].startswith("Relief under the 3rd head: Shape cut-out; Depth 2 mm;")
    assert "9 mm lateral of the axis, 186 mm from the heel" in lines[0]
    assert lines[1].startswith("Felt pad: Shape cut-out;")
    assert lines[2] == (
        "Arch raise: Finished height 28 mm; Length 100 mm; Width 50 mm; "
        "16 mm medial of the axis, 120 mm from the heel"
    )


def test_a_prescription_says_which_edge_is_raised_and_where() -> None:
    posting = Posting(rearfoot_deg=-9.2, forefoot_deg=4.0)
    (line,) = correction_lines(InsoleDesign(Side.LEFT, (posting,)))
    assert line == (
        "Posting: Rearfoot 9.2° lateral; Forefoot 4° medial; Kind extrinsic; "
        "Rearfoot up to 25 % of the length; Forefoot from 65 % of the length"
    )


def test_the_clinics_own_blocks_are_kept(tmp_path: Path) -> None:
    store = ClinicBlocks(tmp_path / "settings" / "blocks.json")
    assert store.load() == ()
    blocks = (Block("Our pair", (350.0, 270.0, 45.0)), Block("Cork", (300.0, 120.0, 20.0)))
    store.save(blocks)
    assert store.load() == blocks
    require_names(blocks, SHOP.blocks)
    for wrong in ("", "eva PAIR", "Cork"):
        with pytest.raises(InputError, match="name"):
            require_names((*blocks, Block(wrong, (1.0, 1.0, 1.0))), SHOP.blocks)


def test_a_nested_job_of_the_command_line_is_that_of_the_window(record: CaseRecord) -> None:
    choice = OrderChoice(both=True, block=block_of("EVA pair"), most_triangles=None)
    parts = make_parts(record, choice, read_rules().only(("watertight",)))
    job = ExportJob(parts, SHOP, block=choice.block)
    nest = closest_nest(*(part.solid for part in parts)).in_middle_of(block_of("EVA pair").size_mm)
    for placed, a2b in zip(job.placed(), nest.insole2block, strict=True):
        np.testing.assert_allclose(placed.insole2file, a2b)
