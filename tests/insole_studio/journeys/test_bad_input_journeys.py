"""What goes wrong in the window is one clear sentence each, and nothing is lost."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from asked_scan import asked_scan, insist_on
from pointing import LEFT, drag, pixel
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.elements import BrushStroke, Posting
from insole_core.resources import resource_path
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.tools.key_point_tool import shown_points
from insole_studio.widgets.form_parts import ComboBox, Fold
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

Settle = Callable[[], None]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def warnings(app: Application) -> list[QLabel]:
    QApplication.processEvents()  # a new line of a panel is shown by the next event
    labels = app.stage.patient.findChildren(QLabel, "warning")
    return [label for label in labels if label.isVisibleTo(app.stage.patient)]


def field(app: Application, key: str) -> NumberField:
    fields = app.stage.parameters.findChildren(NumberField)
    return next(f for f in fields if f.property("key") == key and f.isVisible())


def type_number(app: Application, key: str, text: str) -> NumberField:
    found = field(app, key)
    found.setFocus()
    found.selectAll()
    QTest.keyClicks(found, text)
    QTest.keyClick(found, Qt.Key.Key_Return)
    return found


def said(app: Application) -> str:
    """The one sentence of the one dialog."""
    (dialog,) = app.services.messages.dialogs
    return dialog.text()


def move_landmark(app: Application, name: str, onto: tuple[float, float]) -> None:
    view = app.stage.foot.scene
    start = shown_points(app.case)[name]
    drag(view, pixel(view, *start), pixel(view, *onto, start[2]))


@pytest.mark.parametrize(
    ("name", "beyond", "step_mm", "named"),
    [
        ("metatarsal_head_5", "metatarsal_head_1", (5.0, -6.0), "1st head and 5th head"),
        ("heel_centre", "metatarsal_head_2", (0.0, 10.0), "heel centre and 1st head"),
    ],
)
def test_landmarks_in_an_impossible_order_are_warned_of_until_they_are_back(
    opened: Application,
    settle: Settle,
    name: str,
    beyond: str,
    step_mm: tuple[float, float],
    named: str,
) -> None:
    act(opened, "tool_key_point")
    x, y, _ = shown_points(opened.case)[beyond]
    move_landmark(opened, name, (x + step_mm[0], y + step_mm[1]))
    settle()
    (warning,) = warnings(opened)
    assert f"The landmarks {named} stand in an order that no foot has" in warning.text()
    assert opened.services.messages.dialogs == []
    warning.linkActivated.emit(warning.text().split('"')[1])
    focus = opened.stage.foot.scene.camera.focal_mm
    assert focus[:2] == pytest.approx(shown_points(opened.case)[name][:2], abs=3.0)
    act(opened, "undo")
    settle()
    assert warnings(opened) == []


def test_what_needs_the_landmarks_says_that_they_stand_wrong(
    opened: Application, tmp_path: Path
) -> None:
    act(opened, "tool_key_point")
    x, y, _ = shown_points(opened.case)["metatarsal_head_1"]
    move_landmark(opened, "metatarsal_head_5", (x + 5.0, y - 6.0))
    record = opened.case.record
    opened.services.messages.questions.path = tmp_path / "t.insole-template"  # type: ignore[attr-defined]
    act(opened, "save_template")
    assert "1st metatarsal head lies lateral of the 5th" in said(opened)
    assert list(tmp_path.glob("*.insole-template")) == []
    assert opened.case.record is record


def test_a_number_beyond_its_range_changes_nothing_and_is_said_at_the_field(
    opened: Application,
) -> None:
    act(opened, "tool_posting")
    for key, text, range_text in (
        ("posting.rearfoot_deg", "40", "-15.0 to 15.0 °"),
        ("insole.thickness_mm", "-3", "0.5 to 40.0 mm"),
    ):
        typed = type_number(opened, key, text)
        assert f"put in {range_text}." in typed.refusal.text()
        assert typed.refusal.isVisible()
    assert len(opened.case.history) == 0


def test_a_zone_cannot_end_before_it_begins(opened: Application, settle: Settle) -> None:
    act(opened, "tool_posting")
    type_number(opened, "posting.rearfoot_deg", "4")
    folds = opened.stage.parameters.findChildren(Fold)
    QTest.mouseClick(next(f for f in folds if f.text() == "Expert" and f.isVisible()), LEFT)
    typed = type_number(opened, "posting.blend_start", "90")
    assert "cannot be taken" in typed.refusal.text()
    least = type_number(opened, "posting.blend_end", "50").value()
    type_number(opened, "posting.blend_start", f"{least - 5:.0f}")
    settle()
    posting = design_of(opened)[0]
    assert isinstance(posting, Posting)
    assert (posting.blend_start, posting.blend_end) == pytest.approx((0.45, 0.5))
    assert not opened.stage.insole._warning.isVisible()


def test_a_strong_stroke_that_becomes_smoothing_is_weakened(
    opened: Application, settle: Settle
) -> None:
    stroke = BrushStroke(points_mm=((0.0, 100.0),), strength=3.0, radius_mm=15.0, mode="push")
    design = opened.case.record.design
    assert design is not None
    opened.case.apply(design.with_added(stroke), "Brush")
    opened.case.select(stroke.id)
    choices = opened.stage.parameters.findChildren(ComboBox)
    (mode,) = [choice for choice in choices if choice.property("key") == "correction.mode"]
    mode.edited.emit("smooth")
    settle()
    smoothed = design_of(opened)[0]
    assert isinstance(smoothed, BrushStroke)
    assert (smoothed.mode, smoothed.strength) == ("smooth", 1.0)
    strength = field(opened, "correction.strength")
    assert (strength.value(), strength.maximum()) == (100, 100)  # in per cent
    assert not opened.stage.insole._warning.isVisible()


def design_of(app: Application) -> tuple[object, ...]:
    assert app.case.record.design is not None
    return app.case.record.design.corrections


def newer_case(path: Path, record: CaseRecord, what: str) -> None:
    """A case as a later version of the program would write it: its own format, or its designs."""
    old = path.with_suffix(".old")
    write_case(record, old)
    with zipfile.ZipFile(old) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name.endswith(".json"):
                content = json.dumps(newer(json.loads(content), what)).encode()
            target.writestr(name, content)


def newer(content: object, what: str) -> object:
    if isinstance(content, list):
        return [newer(item, what) for item in content]
    if not isinstance(content, dict):
        return content
    changed = {key: newer(value, what) for key, value in content.items()}
    if changed.get("format") == what:
        changed["version"] = 99
    return changed


@pytest.mark.parametrize("what", ["insole-case", "insole-design"])
def test_a_case_of_a_newer_version_is_one_sentence(
    opened: Application, settle: Settle, tmp_path: Path, what: str
) -> None:
    before = opened.case.record
    path = tmp_path / "newer.insole"
    newer_case(path, before, what)
    opened.features.case_files.opener.open_path(path)
    settle()
    assert "newer Insole Studio" in said(opened)
    assert opened.case.record is before


def test_a_template_of_a_newer_version_is_one_sentence(opened: Application, tmp_path: Path) -> None:
    path = tmp_path / "t.insole-template"
    questions = opened.services.messages.questions
    questions.path = path  # type: ignore[attr-defined]
    act(opened, "save_template")
    path.write_text(path.read_text().replace('"version": 1', '"version": 99'))
    before = opened.case.record
    act(opened, "apply_template")
    assert "install a newer Insole Studio" in said(opened)
    assert opened.case.record is before


@pytest.fixture(scope="module")
def real_foot() -> TriangleMesh:
    current = read_case(resource_path("example/example.insole")).current
    assert current is not None
    return current.foot.mesh


def part(mesh: TriangleMesh, first_mm: float, last_mm: float) -> TriangleMesh:
    """What lies between two places along the foot."""
    y = mesh.vertices[:, 1]
    keep = (y >= first_mm) & (y <= last_mm)
    number = np.cumsum(keep) - 1
    inside = mesh.triangles[keep[mesh.triangles].all(axis=1)]
    return TriangleMesh(mesh.vertices[keep], number[inside].astype(np.int32))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("first_mm", "last_mm", "sentence"),
    [(-50.0, 185.0, "The toes seem to be missing"), (50.0, 400.0, "The heel is missing")],
)
def test_a_scan_without_toes_or_heel_is_opened_and_said(
    app: Application,
    settle: Settle,
    real_foot: TriangleMesh,
    tmp_path: Path,
    first_mm: float,
    last_mm: float,
    sentence: str,
) -> None:
    path = tmp_path / "part.ply"
    write_ply(part(real_foot, first_mm, last_mm), path)
    app.features.case_files.opener.open_path(path, Side.RIGHT)
    settle()
    told = [n.text for n in app.services.notices.notices]
    dialog = asked_scan(app)
    if dialog is not None:  # the length of a foot without toes is a guess
        told.append(dialog.doubts.text())
        insist_on(app, settle, Side.RIGHT)
    assert any(sentence in text for text in told)
    assert app.services.messages.dialogs == []
    assert app.stage.preview.mesh is not None
    act(app, "add_posting")
    settle()
    assert app.stage.preview.is_current
