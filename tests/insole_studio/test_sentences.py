"""What the core says is read in Swedish: progress, and every error that a user can meet."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

import insole_core
import insole_studio
from insole_core import errors
from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.plausibility import USUAL_DEPTH, find_misfit
from insole_core.errors import CalibrationError, InputError
from insole_core.foot.mesh_file import read_mesh
from insole_core.resources import resource_path
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.nominal_kinect import nominal_kinect
from insole_studio.phrasebook import Phrasebook
from insole_studio.texts import load_language, translate_core_message

CORE = Path(insole_core.__file__).parent
WORKBENCH = Path(insole_studio.__file__).parent / "workbench"
BOOK: dict[str, str] = json.loads(
    (resource_path("translations") / "sv/sentences.json").read_text("utf-8")
)
TRANSLATED = (
    "calibration", "cases", "compare", "evaluation", "export", "foot", "geometry", "insole",
    "recording", "reconstruct", "sensing", "simulate", "solids", "json_object.py",
)  # fmt: skip
"""Rooms whose errors the window shows."""
REMARKS = (
    "calibration/applying.py", "calibration/distortion.py", "calibration/intrinsics.py",
    "calibration/plausibility.py",
    "cases/scan.py", "compare/sources.py", "export/atomic.py", "foot/mesh_file.py",
    "foot/measures.py", "foot/placing.py", "foot/side_check.py", "reconstruct/assignment.py",
    "reconstruct/coverage.py", "reconstruct/image_assignment.py", "reconstruct/picture.py",
    "reconstruct/pose_quality.py", "reconstruct/registration.py", "reconstruct/remarks.py",
)  # fmt: skip
"""Files that write warnings and reasons of their own."""
STEPS = ("calibration_steps.py", "camera_step.py", "stereo_steps.py", "wall_steps.py")
"""Files of the application that tell commands and window alike how a calibration went."""
ERRORS = {name for name in vars(errors) if name.endswith("Error")}


def template(node: ast.expr) -> str | None:
    """Give a sentence with numbered holes for its values; None where it is put together."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if not isinstance(node, ast.JoinedStr):
        return None
    parts, holes = [], 0
    for part in node.values:
        if isinstance(part, ast.Constant):
            parts.append(str(part.value))
        else:
            parts.append(f"{{{holes}}}")
            holes += 1
    return "".join(parts)


def calls(path: Path) -> Iterator[tuple[str, list[ast.expr]]]:
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            yield name, node.args


def sentences(path: Path, wanted: Callable[[str, list[ast.expr]], ast.expr | None]) -> set[str]:
    found = (wanted(name, args) for name, args in calls(path))
    texts = (template(node) for node in found if node is not None)
    return {text for text in texts if text is not None}


def of_errors(name: str, args: list[ast.expr]) -> ast.expr | None:
    if name in ERRORS and args:
        return args[0]
    return args[1] if name == "fail" and len(args) == 2 else None


def of_progress(name: str, args: list[ast.expr]) -> ast.expr | None:
    return args[1] if name == "step" and len(args) == 2 else None


def files(part: str) -> list[Path]:
    return [CORE / part] if part.endswith(".py") else sorted((CORE / part).rglob("*.py"))


def test_every_progress_sentence_has_a_swedish_one() -> None:
    found = {text for path in CORE.rglob("*.py") for text in sentences(path, of_progress)}
    assert len(found) > 40
    assert sorted(found - set(BOOK)) == []


@pytest.mark.parametrize("part", TRANSLATED)
def test_every_error_has_a_swedish_one(part: str) -> None:
    found = {text for path in files(part) for text in sentences(path, of_errors)}
    assert found
    assert sorted(found - set(BOOK)) == []


def test_every_remark_about_a_scan_has_a_swedish_one() -> None:
    found = {text for part in REMARKS for text in said_by(CORE / part)}
    assert len(found) > 30
    assert sorted(found - set(BOOK)) == []


def test_every_sentence_of_a_calibration_has_a_swedish_one() -> None:
    found = {text for name in STEPS for text in said_by(WORKBENCH / name)}
    assert len(found) > 20
    assert sorted(found - set(BOOK)) == []


def said_by(path: Path) -> Iterator[str]:
    """All that looks like a sentence: four words and more that are no documentation."""
    tree = ast.parse(path.read_text("utf-8"))
    silent = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    silent |= {
        id(v) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for v in node.values
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant | ast.JoinedStr) and id(node) not in silent:
            text = template(node)
            if text is not None and len(text.split()) > 3:
                yield text


def test_holes_stay_what_they_are() -> None:
    for text, said in BOOK.items():
        holes = [f"{{{number}}}" for number in range(9)]
        assert [h for h in holes if h in text] == [h for h in holes if h in said], text


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


def test_a_reason_within_a_sentence_is_said_as_well() -> None:
    book = Phrasebook(BOOK)
    reason = "the markers that are seen lie almost on one line, so the sensor's place is uncertain"
    said = book.say(
        f"No foot can be made from s.zip, because none of its views can be used ({reason})."
    )
    assert said == (
        "Ingen fot kan göras av s.zip, eftersom ingen av dess vyer kan användas"
        " (markörerna som syns ligger nästan på en linje, så sensorns plats är osäker)."
    )


def test_what_does_not_fit_a_kinect_is_said_as_well() -> None:
    wide = LinearInverseDisparity(USUAL_DEPTH.a * 1.25, USUAL_DEPTH.b * 1.25)
    said = Phrasebook(BOOK).say(find_misfit(nominal_kinect("A1"), 30.0, wide))
    assert said == (
        "Resultatet passar inte en Kinect v1: djupets a är 3.915 (vanligt: 3.038 till 3.226), "
        "djupets b är -0.00359 (vanligt: -0.00296 till -0.00279); brädets ruta är troligare "
        "37.5 mm än 30 mm, så mät den och ange dess verkliga sida."
    )


def test_the_reason_why_no_picture_of_a_board_can_be_used_is_said_as_well() -> None:
    grey = np.full((480, 640), 90, np.uint8)
    with pytest.raises(CalibrationError) as caught:
        Chequerboard(9, 6, 30).find("color_000.png", grey)
    said = Phrasebook(BOOK).say(f"None of the 3 pictures can be used: {caught.value}")
    assert said == (
        "Ingen av de 3 bilderna kan användas: color_000.png: inget schackbräde med 9×6 inre hörn"
        " syns; visa hela brädet, plant och väl belyst."
    )


def test_a_list_of_words_is_said_word_by_word() -> None:
    said = Phrasebook(BOOK).say(
        "The board was hardly seen in these parts: upper left, lower right."
    )
    assert said == "Brädet syntes knappt i dessa delar: uppe till vänster, nere till höger."
    sides = Phrasebook(BOOK | {"Turn it: {0}.": "Vrid det: {0}."}).say(
        "Turn it: 4 × right, 3 × up."
    )
    assert sides == "Vrid det: 4 × åt höger, 3 × uppåt."


@pytest.mark.parametrize("unknown", ["", "Nobody has said this.", "{0} [a-z]+ (", "x" * 300])
def test_what_is_not_in_the_book_stays_english(unknown: str) -> None:
    assert Phrasebook(BOOK).say(unknown) == unknown


def test_a_value_with_braces_is_left_alone() -> None:
    book = Phrasebook({"{0} is no name.": "{0} är inget namn."})
    assert book.say("{1} is no name.") == "{1} är inget namn."


def test_a_language_without_a_book_is_english(tmp_path: Path) -> None:
    assert Phrasebook.read(tmp_path / "none.json").say("The foot is ready") == "The foot is ready"
