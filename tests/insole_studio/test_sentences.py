"""What the core says is read in Swedish: every sentence of it is a message with a translation."""

from __future__ import annotations

import ast
import builtins
import string
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

import insole_core
import insole_studio
from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.plausibility import USUAL_DEPTH, find_misfit
from insole_core.errors import CalibrationError, InputError
from insole_core.export.paper import paper_texts
from insole_core.foot.measures import DEFINITIONS
from insole_core.geometry.side import Side
from insole_core.insole.elements import CORRECTION_TYPES, HeelSkive, Pelott
from insole_core.insole.fields import Choice, Declared, Number, declared
from insole_core.insole.pads.pad_form import PAD_NAMES, PAD_SHAPES
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.materials import read_materials
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.shoes.shoe_sizes import read_shoe_table
from insole_core.messages import Message, joined
from insole_core.records.order import Order
from insole_core.records.person import Person
from insole_core.records.record_field import fields_of, typed_fields
from insole_core.records.visit import FollowUp, Visit
from insole_core.resources import resource_path
from insole_core.scans.mesh_file import read_mesh
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.sensor import nominal_kinect
from insole_core.solids.shop import read_shop
from insole_core.workflows.clinic_devices import clinic_devices, clinic_forms
from insole_core.workflows.clinic_findings import ClinicFindings
from insole_core.workflows.pad_library import load_pads
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.parameters.device_fields import shell_group
from insole_studio.features.design.rows import ChoiceSpec
from insole_studio.texts import load_language, translate_core_message

CORE = Path(insole_core.__file__).parent
STUDIO = Path(insole_studio.__file__).parent
CATALOGUE = {
    message.findtext("source", ""): message.findtext("translation", "")
    for message in ElementTree.parse(resource_path("translations/sv/core.ts")).iter("message")
}
PAPERS = (
    "compare/comparison_report.py", "evaluation/calibration_sections.py",
    "evaluation/chain_section.py", "evaluation/evaluation_sections.py",
    "evaluation/repeat_section.py", "evaluation/report.py",
    "evaluation/report_files.py", "evaluation/wall.py", "export/paper.py", "formats/amf.py",
    "formats/obj.py", "formats/off.py", "formats/ply.py", "formats/slicer_3mf.py",
    "formats/stl.py", "formats/three_mf.py", "insole/prescription/prescription_lines.py",
    "records/fhir.py", "records/statement.py", "milling/gcode.py", "simulate/simulation.py",
    "solids/export_job.py", "workflows/calibration/reference_foot_paper.py",
)  # fmt: skip
"""Files that write reports, papers and meshes, in English; what they refuse is said in Swedish."""
PUT_TOGETHER = {"shoe height"} | {
    f"{row} {column}"
    for row in ("upper", "middle", "lower")
    for column in ("left", "centre", "right")
}
"""Words of the catalogue that the core makes of parts."""
PAPER_TEXTS = {
    text
    for paper in ("job_sheet", "person_summary", "prescription", "setup_sheet", "words")
    for text in paper_texts(paper).values()
}
"""Texts of the papers that are written in the language of the program."""
SHOES = {system.name for system in read_shoe_table().systems} | read_shoe_table().widths_mm.keys()
"""Names in the table of shoe sizes."""
PRESCRIBED = (
    {name[0].upper() + name[1:] for name in PAD_NAMES.values()}
    | {kind.name[0].lower() + kind.name[1:] for kind in CORRECTION_TYPES.values()}
    | {word.replace("_", " ") for word in (*PAD_SHAPES, *DEFINITIONS)}
    | {name.removesuffix("_deg").replace("_", " ") for name in DEFINITIONS}
    | {"rearfoot post", "forefoot post", "medial rim", "lateral rim", "depth camera"}
)
"""Words of a prescription, of measures, and of calibrations that are made of identifiers."""
SHOP = read_shop()
STOCK = {block.name for block in SHOP.blocks} | set(SHOP.materials)
"""What the shop that comes with the product has in stock."""
NOWHERE = Path("/nowhere")
DEVICES = clinic_devices(NOWHERE).load().items.values()
FORMS = clinic_forms(NOWHERE).load().items.values()
FINDINGS = ClinicFindings(NOWHERE).load().items.values()
DESIGN = InsoleDesign(Side.LEFT)
PARTS = (InsoleDesign, Outline, Layers, Finish, Shell, Post, RimStation, Shoe, Form, BaseForm)
LIBRARY = (
    {text for item in (*DEVICES, *FORMS, *FINDINGS) for text in (item.name, item.source)}
    | {word for item in (*DEVICES, *FINDINGS) for word in item.keywords}
    | {finding.advice for finding in FINDINGS}
)
"""What the devices, forms and findings of the product are called and advise, and come from."""
MATERIALS = {text for m in read_materials().materials for text in (m.name, m.source)}


def speaking_files() -> list[Path]:
    """All files whose sentences reach the window; the command line speaks English only."""
    return [
        *(path for path in sorted(CORE.rglob("*.py")) if path != CORE / "messages.py"),
        *(path for path in sorted(STUDIO.rglob("*.py")) if STUDIO / "cli" not in path.parents),
    ]


class Text(NamedTuple):
    """A text that reads like a sentence."""

    words: str
    is_f_string: bool


class Read(NamedTuple):
    """What is looked for in a file; all syntax trees together would take 200 MB."""

    classes: tuple[tuple[str, set[str]], ...]
    """Names, each with those of its bases."""
    calls: tuple[tuple[str, Said], ...]
    """What may say something, by the name of what is called."""
    prose: dict[str, Text]
    """Texts that read like a sentence, by their place; of files without prose, none."""
    constants: set[str]


@cache
def files() -> dict[Path, Read]:
    """Read all of them, once."""
    prose = set(in_prose())
    return {path: read(path, path in prose) for path in speaking_files()}


def read(path: Path, is_prose: bool) -> Read:
    tree = ast.parse(path.read_text("utf-8"))
    nodes = list(ast.walk(tree))
    texts = texts_of(nodes) if is_prose else ()
    return Read(
        tuple((node.name, bases(node)) for node in nodes if isinstance(node, ast.ClassDef)),
        tuple(calls_in(path, nodes)),
        {
            f"{path}:{node.lineno}:{node.col_offset}": text
            for node in texts
            if (text := sentence_of(node)).words
        },
        {n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)},
    )


@cache
def names_of_errors() -> set[str]:
    """Name `InsoleError` and all classes that come of it."""
    classes = [each for file in files().values() for each in file.classes]
    found = {"InsoleError"}
    while more := {name for name, bases in classes if found & bases} - found:
        found |= more
    return found


def bases(node: ast.ClassDef) -> set[str]:
    return {base.id for base in node.bases if isinstance(base, ast.Name)}


class Said(NamedTuple):
    """A place where a sentence is raised, reported, or made."""

    where: str
    sentence: ast.expr
    values: set[str]
    open_ended: bool
    """Whether values are handed on by ``**``."""

    @property
    def template(self) -> str | None:
        constant = self.sentence
        if isinstance(constant, ast.Constant) and isinstance(constant.value, str):
            return constant.value
        return None


@cache
def all_said() -> tuple[Said, ...]:
    speaking = {"step", "fail", "Message", "counted", *names_of_errors()}
    calls = [call for file in files().values() for call in file.calls]
    return tuple(said for name, said in calls if name in speaking)


def calls_in(path: Path, nodes: Iterable[ast.AST]) -> Iterator[tuple[str, Said]]:
    """Find the calls that say something, if what they call is an error or a message."""
    for call in (node for node in nodes if isinstance(node, ast.Call)):
        name = getattr(call.func, "id", getattr(call.func, "attr", ""))
        is_step = name in ("step", "fail")
        place = 1 if is_step else 0
        if name == "counted":  # says one thing, or several
            keys = {key.arg for key in call.keywords if key.arg}
            where = f"{path.name}:{call.lineno}"
            for sentence, more in zip(call.args[1:], (set(), {"count"}), strict=True):
                yield name, Said(where, sentence, keys | more, open_ended=False)
        elif (is_step or name[:1].isupper()) and len(call.args) > place:
            keys = {key.arg for key in call.keywords}
            where = f"{path.name}:{call.lineno}"
            yield name, Said(where, call.args[place], {k for k in keys if k}, None in keys)


def holes(template: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(template) if name}


def is_finished(node: ast.expr) -> bool:
    """Tell whether a sentence was put together before anybody could translate it."""
    method = node.func if isinstance(node, ast.Call) else None
    return isinstance(node, ast.JoinedStr | ast.BinOp) or (
        isinstance(method, ast.Attribute) and method.attr in ("format", "join")
    )


def texts_of(nodes: list[ast.AST]) -> Iterator[ast.Constant | ast.JoinedStr]:
    """Find the texts of a file that are no documentation, f-strings as one."""
    silent = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    silent |= {id(part) for part in parts_of_f_strings(nodes)} | {
        id(text) for text in told_to_programmers(nodes)
    }
    for node in nodes:
        if isinstance(node, ast.Constant | ast.JoinedStr) and id(node) not in silent:
            yield node


def parts_of_f_strings(nodes: Iterable[ast.AST]) -> Iterator[ast.AST]:
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            yield from (part for part in ast.walk(node) if part is not node)


def told_to_programmers(nodes: Iterable[ast.AST]) -> Iterator[ast.AST]:
    """Find what built-in errors, assertions and the log say, and what looks for words."""
    for node in nodes:
        if isinstance(node, ast.Assert) and node.msg is not None:
            yield node.msg
        if isinstance(node, ast.Call):
            name = getattr(node.func, "id", "")
            owner = getattr(getattr(node.func, "value", None), "id", "")
            is_error = hasattr(builtins, name) and name.endswith("Error")
            is_sql = name == "text" or getattr(node.func, "attr", "") == "exec_driver_sql"
            if is_error or is_sql or owner in ("log", "re"):
                yield from node.args


def sentence_of(node: ast.Constant | ast.JoinedStr) -> Text:
    """Give the fixed words of a text if there are four or more, as in a sentence; else nothing."""
    parts = node.values if isinstance(node, ast.JoinedStr) else [node]
    words = "".join(str(p.value) if isinstance(p, ast.Constant) else " " for p in parts)
    is_text = isinstance(node, ast.JoinedStr) or isinstance(node.value, str)
    is_sentence = is_text and len(words.split()) > 3
    return Text(words if is_sentence else "", isinstance(node, ast.JoinedStr))


def in_prose() -> list[Path]:
    papers = {CORE / name for name in PAPERS}
    spoken = speaking_files()
    acquisition = [path for path in spoken if STUDIO / "acquisition" in path.parents]
    papers |= set((CORE / "records" / "migrations").rglob("*.py"))  # which speak SQL
    papers |= {CORE / "records" / name for name in ("marks.py", "schema.py")}  # reasons to keep
    return [path for path in spoken if CORE in path.parents and path not in papers] + acquisition


def prose() -> dict[str, Text]:
    """Give the texts that read like a sentence, by where they are."""
    return {where: text for file in files().values() for where, text in file.prose.items()}


def test_sentences_are_found_where_they_are_said() -> None:
    assert {"SideMismatchError", "PoseRefusedError", "NoSensorFoundError"} <= names_of_errors()
    assert len({said.template for said in all_said()}) > 380


def test_no_sentence_is_finished_before_it_is_a_message() -> None:
    assert [said.where for said in all_said() if is_finished(said.sentence)] == []


def test_no_sentence_is_put_together_elsewhere() -> None:
    assert prose()
    assert [where for where, text in prose().items() if text.is_f_string] == []


def test_every_message_has_a_swedish_one() -> None:
    templates = {said.template for said in all_said()} - {None, ""}
    assert sorted(text for text in templates if text and not CATALOGUE.get(text)) == []


def test_every_other_sentence_has_a_swedish_one() -> None:
    assert sorted({text.words for text in prose().values()} - set(CATALOGUE)) == []


def test_every_hole_has_its_value() -> None:
    filled = [s for s in all_said() if s.template is not None and (s.values or s.open_ended)]
    assert [s.where for s in filled if not s.values <= holes(str(s.template))] == []
    whole = [s for s in filled if not s.open_ended]
    assert [s.where for s in whole if s.values != holes(str(s.template))] == []


def test_holes_stay_what_they_are() -> None:
    filled = {s.template for s in all_said() if s.template and (s.values or s.open_ended)}
    for text in filled | {text for text in CATALOGUE if text.startswith("{part_")}:
        assert fields(text) == fields(CATALOGUE[text]), text


def fields(template: str) -> set[tuple[str | None, str | None, str | None]]:
    return {field[1:] for field in string.Formatter().parse(template) if field[1] is not None}


def test_the_stock_of_the_shop_has_swedish_names() -> None:
    alike = {"EVA, Shore A 35", "EVA, Shore A 45"}
    assert STOCK - CATALOGUE.keys() == alike


def test_devices_forms_and_findings_are_swedish_throughout() -> None:
    assert LIBRARY - CATALOGUE.keys() - {""} == set()


def test_materials_are_offered_by_their_swedish_names(swedish: Callable[[str], str]) -> None:
    assert MATERIALS - CATALOGUE.keys() == {"EVA", "EVA, Shore A 35", "EVA, Shore A 45"}
    fields = shell_group(InsoleDesign(Side.LEFT, shell=Shell()), read_materials()).fields
    (material,) = (field for field in fields if field.key == "shell.material")
    assert isinstance(material, ChoiceSpec)
    assert ("polypropylene", "Polypropen") in material.options


def test_every_word_of_a_prescription_has_a_swedish_one() -> None:
    nouns = {kind.name[:1].lower() + kind.name[1:] for kind in CORRECTION_TYPES.values()}
    words = (
        nouns
        | {kind.name for kind in CORRECTION_TYPES.values()}
        | {pad.template.noun for pad in load_pads()}
    )
    kinds = (*CORRECTION_TYPES.values(), *PARTS)
    fields = [found for kind in kinds for found in declared(kind).values()]
    words |= {word for found in fields for word in words_of(found)} - {""}
    assert words - CATALOGUE.keys() == set()


def test_sides_and_pads_have_the_form_that_their_sentence_asks_for(
    swedish: Callable[[str], str],
) -> None:
    (skived,) = design_differences(DESIGN, DESIGN.with_added(HeelSkive(border="lateral")))
    assert swedish(skived) == "Nytt: hälskivning, lateral, 3 mm"
    assert [swedish(word) for word in ("medial", "lateral")] == ["medial", "lateral"]
    cut = Pelott(centre_mm=(0, 0), kind="first_ray_cut_out", shape="cut_out", height_mm=-2)
    assert swedish(cut.noun) == "urtag första strålen"
    assert name_of(cut) == "Urtag första strålen"


@pytest.mark.usefixtures("swedish")
def test_a_pad_that_is_new_in_the_core_is_named_in_the_language_of_the_window(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(PAD_NAMES, "new_kind", "cuboid raise")
    assert name_of(Pelott(centre_mm=(0, 0), kind="new_kind")) == "Kuboidstöd"


def test_every_field_of_the_record_has_swedish_words() -> None:
    kinds = (Person, Visit, Order, FollowUp)
    words = {field.noun for kind in kinds for field in fields_of(kind).values()}
    words |= {field.label for kind in kinds for field in typed_fields(kind).values()}
    assert words - CATALOGUE.keys() == set()


def words_of(found: Declared) -> Iterator[str]:
    yield from (found.label, found.tip, found.within, found.main or "")
    if isinstance(found, Number):
        yield found.template
    yield from (word for pair in getattr(found, "each", ()) for word in pair)
    yield from (name for _, name in getattr(found, "offers", ()))
    if isinstance(found, Choice):
        yield from found.words.values()


def test_nothing_is_translated_that_nobody_says() -> None:
    constants = {text for file in files().values() for text in file.constants}
    unused = CATALOGUE.keys() - constants - PUT_TOGETHER - STOCK - LIBRARY - MATERIALS
    unused -= PAPER_TEXTS | PRESCRIBED | SHOES
    assert sorted(text for text in unused if not text.startswith("{part_")) == []


def test_a_real_error_is_said_in_swedish(qapp: QApplication, tmp_path: Path) -> None:
    path = tmp_path / "foot.ply"
    with pytest.raises(InputError) as caught:
        read_mesh(path)
    load_language(qapp, "sv")
    assert (
        translate_core_message(str(caught.value)) == f"{path} finns inte; kontrollera filens namn."
    )
    load_language(qapp, "en")
    assert translate_core_message(str(caught.value)) == str(caught.value)


def test_the_reason_why_a_scan_cannot_be_read_is_said_in_swedish(
    swedish: Callable[[str], str], tmp_path: Path
) -> None:
    path = tmp_path / "foot.off"
    path.write_text("points")
    with pytest.raises(InputError) as caught:
        read_mesh(path)
    assert "(den börjar inte med ”OFF” och antalet" in swedish(str(caught.value))


def test_a_reason_within_a_sentence_is_said_as_well(swedish: Callable[[str], str]) -> None:
    reason = "the markers that are seen lie almost on one line, so the sensor's place is uncertain"
    message = Message(
        "No foot can be made from {session}, because none of its views can be used ({reasons}).",
        session="s.zip",
        reasons=joined([Message("view {view}: {reason}", view="left", reason=reason)], "; "),
    )
    assert swedish(message) == (
        "Ingen fot kan göras av s.zip, eftersom ingen av dess vyer kan användas"
        " (vyn vänster: markörerna som syns ligger nästan på en linje, så sensorns plats är"
        " osäker)."
    )


def test_what_does_not_fit_a_kinect_is_said_as_well(swedish: Callable[[str], str]) -> None:
    wide = LinearInverseDisparity(USUAL_DEPTH.a * 1.25, USUAL_DEPTH.b * 1.25)
    said = swedish(find_misfit(nominal_kinect("A1"), 30.0, wide))
    assert said == (
        "Resultatet passar inte en Kinect v1: djupets a är 3.915 (vanligt: 3.038 till 3.226), "
        "djupets b är -0.00359 (vanligt: -0.00296 till -0.00279); brädets ruta är troligare "
        "37.5 mm än 30 mm, så mät den och ange dess verkliga sida."
    )


def test_the_reason_why_no_picture_of_a_board_can_be_used_is_said_as_well(
    swedish: Callable[[str], str],
) -> None:
    grey = np.full((480, 640), 90, np.uint8)
    with pytest.raises(CalibrationError) as caught:
        Chequerboard(9, 6, 30).find("color_000.png", grey)
    message = Message(
        "None of the {count} pictures can be used: {reason}", count=3, reason=caught.value.message
    )
    assert swedish(message) == (
        "Ingen av de 3 bilderna kan användas: color_000.png: inget schackbräde med 9×6 inre hörn"
        " syns; visa hela brädet, plant och väl belyst."
    )


def test_a_list_of_words_is_said_word_by_word(swedish: Callable[[str], str]) -> None:
    parts = joined(["upper left", "lower right"])
    message = Message("The board was hardly seen in these parts: {parts}.", parts=parts)
    assert swedish(message) == (
        "Brädet syntes knappt i dessa delar: uppe till vänster, nere till höger."
    )
    assert swedish(joined(["left", "right"], " and ")) == "vänster och höger"


def test_numbers_keep_the_form_of_the_template(swedish: Callable[[str], str]) -> None:
    message = Message("The distance is known within {error_mm:.1f} mm.", error_mm=0.26)
    assert swedish(message) == "Avståndet är känt inom 0,3 mm."


@pytest.mark.parametrize(
    "unknown",
    ["", "Nobody has said this.", "{0} [a-z]+ (", Message("{a} of nobody {b}", a="{b}", b=1)],
)
def test_what_is_in_no_catalogue_stays_english(swedish: Callable[[str], str], unknown: str) -> None:
    assert swedish(unknown) == unknown


def test_a_value_with_braces_is_left_alone(swedish: Callable[[str], str]) -> None:
    message = Message("{path} does not exist; check the name.", path="{reason}.zip")
    assert swedish(message) == "{reason}.zip finns inte; kontrollera namnet."


def test_a_path_is_no_word(swedish: Callable[[str], str]) -> None:
    message = Message("{path} does not exist; check the name.", path=Path("left"))
    assert swedish(message) == "left finns inte; kontrollera namnet."


def test_a_language_without_a_catalogue_is_english(qapp: QApplication) -> None:
    load_language(qapp, "fr")
    assert translate_core_message("The foot is ready") == "The foot is ready"
    load_language(qapp, "en")
