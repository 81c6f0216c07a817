"""The user opens a scan whose file does not tell how it is to be read."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from asked_scan import asked_scan
from pointing import pixel
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel
from read_pdf import text_of_pdf

from insole_core.cases.case_record import Patient
from insole_core.formats.ply import write_ply
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.simulate.foam_box import DOUBLE_MM, FoamBox, press_feet, pressing
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.solids.export_rules import ExportRules
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import read_shop
from insole_core.workflows.make_order import OrderChoice, make_parts, write_order
from insole_studio.app.bootstrap import Application
from insole_studio.features.import_scan.import_dialog import ImportDialog, SizeFields
from insole_studio.services.questions import SameSide

pytestmark = pytest.mark.one_window

LEFT = Qt.MouseButton.LeftButton
Open = Callable[[TriangleMesh], ImportDialog | None]


@pytest.fixture(scope="module")
def right_foot() -> TriangleMesh:
    return build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(2), cell_mm=4.0).mesh


@pytest.fixture(scope="module")
def far_foot(right_foot: TriangleMesh) -> TriangleMesh:
    """A foot of which the scan is warned: its file has it 2 km away."""
    return replace(right_foot, vertices=right_foot.vertices + np.array([2e6, 0, 0]))


@pytest.fixture(scope="module")
def box(right_foot: TriangleMesh) -> TriangleMesh:
    """A foam box into which both feet were pressed."""
    left_foot = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(2), cell_mm=4.0).mesh
    pressed = [
        foot.transformed(pressing(28.0, (x_mm, 0.0)))
        for foot, x_mm in ((left_foot, -80.0), (right_foot, 80.0))
    ]
    return press_feet(pressed, FoamBox(DOUBLE_MM, cell_mm=2.0), np.random.default_rng(1))


@pytest.fixture
def open_scan(app: Application, settle: Callable[[], None], tmp_path: Path) -> Open:
    """Open a surface as the file of another scanner, and return the dialog if one is asked."""

    def open_it(mesh: TriangleMesh, side: Side | None = None) -> ImportDialog | None:
        path = tmp_path / "scan.ply"
        write_ply(mesh, path)
        app.features.case_files.opener.open_path(path, side)
        settle()
        return asked_scan(app)

    return open_it


def choose_size(fields: SizeFields, kind: str) -> None:
    fields.kind.setFocus()
    fields.kind.setCurrentIndex(fields.kind.findData(kind))
    fields.kind.activated.emit(fields.kind.currentIndex())


def test_escape_leaves_all_as_it_was_and_return_takes_the_side_that_the_shape_tells(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    record = app.case.record
    dialog = open_scan(right_foot)
    assert dialog is not None
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert asked_scan(app) is None
    assert app.case.record is record
    assert not app.jobs.is_running()
    dialog = open_scan(right_foot)
    assert dialog is not None
    assert "right foot by its shape" in dialog.finding.text()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.side is Side.RIGHT
    assert asked_scan(app) is None


def test_the_other_side_outlives_another_reading_and_is_opened_only_if_the_user_insists(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(right_foot)
    assert dialog is not None
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    choose_size(dialog.size_fields, "mm")
    assert not dialog.open_button.isEnabled()
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    assert not dialog.open_button.isEnabled()  # what is shown is being read anew
    settle()
    assert dialog.open_button.isEnabled()
    assert dialog.sides[Side.LEFT].isChecked()
    QTest.mouseClick(dialog.open_button, LEFT)
    settle()
    assert app.case.foot is None
    assert "looks like a right foot" in dialog.doubts.text()
    assert "--" not in dialog.doubts.text()
    assert dialog.open_button.text() == "Open anyway"
    # The second click of a double-click, and Enter, are meant for the button that was there.
    at = QPointF(dialog.open_button.rect().center())
    for kind in (QEvent.Type.MouseButtonDblClick, QEvent.Type.MouseButtonRelease):
        pressed = LEFT if kind is QEvent.Type.MouseButtonDblClick else Qt.MouseButton.NoButton
        everywhere = dialog.open_button.mapToGlobal(at)
        event = QMouseEvent(kind, at, everywhere, LEFT, pressed, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(dialog.open_button, event)
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is None
    assert asked_scan(app) is dialog
    QTest.mouseClick(dialog.open_button, LEFT)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.side is Side.LEFT


def test_what_spoke_against_a_side_is_said_again_when_the_scan_is_opened_once_more(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(right_foot)
    assert dialog is not None
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    for _ in range(2):
        QTest.mouseClick(dialog.open_button, LEFT)
        settle()
    assert app.case.side is Side.LEFT
    dialog = open_scan(right_foot)
    assert dialog is not None
    assert dialog.sides[Side.LEFT].isChecked()
    assert "looks like a right foot" in dialog.doubts.text()
    assert dialog.open_button.text() == "Open anyway"
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    assert not dialog.doubts.isVisible()
    assert dialog.open_button.text() == "Open"
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    QTest.mouseClick(dialog.open_button, LEFT)
    settle()
    assert "looks like a right foot" in dialog.doubts.text()  # insisting is for one choice


def test_a_side_that_was_insisted_on_is_warned_of_until_the_shop_has_it(
    app: Application,
    open_scan: Open,
    settle: Callable[[], None],
    right_foot: TriangleMesh,
    tmp_path: Path,
) -> None:
    said = "The left foot has the shape of a right one; check which foot was scanned"
    dialog = open_scan(right_foot)
    assert dialog is not None
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    for _ in range(2):
        QTest.mouseClick(dialog.open_button, LEFT)
        settle()
    labels = app.stage.patient.findChildren(QLabel, "warning")
    assert [label.text().startswith(said) for label in labels if said in label.text()] == [True]
    choice = OrderChoice(prescription=True, checks=True, pseudonym="26-7KQ4M")
    parts = make_parts(app.case.record, choice, ExportRules({}, {}))
    write_order(
        parts, choice, tmp_path / "o.stl",
        shop=read_shop(), patient=Patient("Ö"), responsible=Responsible("Ö", "Ö", "Ö", "Ö"),
    )  # fmt: skip
    for paper in ("job-sheet", "prescription"):
        (path,) = tmp_path.glob(f"o*{paper}.pdf")
        assert said in " ".join(text_of_pdf(path).split()), paper
    (path,) = tmp_path.glob("o*.json")
    assert any(w.startswith(said) for w in json.loads(path.read_text())["warnings"])


def test_a_contradicted_side_is_put_right_with_one_press(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(right_foot, Side.LEFT)  # type: ignore[call-arg]
    assert dialog is not None
    assert "looks like a right foot" in dialog.doubts.text()
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    assert not dialog.doubts.isVisible()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.side is Side.RIGHT


@pytest.mark.slow
def test_nothing_is_asked_of_a_known_side_and_the_file_at_another_size_is_another_foot(
    app: Application,
    questions: Any,
    open_scan: Open,
    settle: Callable[[], None],
    right_foot: TriangleMesh,
) -> None:
    assert open_scan(right_foot, Side.RIGHT) is None  # type: ignore[call-arg]
    before = app.case.foot
    assert before is not None
    dialog = open_scan(right_foot)
    assert dialog is not None
    choose_size(dialog.size_fields, "shoe")
    field = dialog.size_fields.numbers["shoe"]
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "46")
    QTest.keyClick(field, Qt.Key.Key_Tab)
    settle()
    QTest.mouseClick(dialog.open_button, LEFT)
    questions.same_side = SameSide.REPLACE
    settle()
    assert app.case.foot is not None
    assert app.case.foot.length_mm == pytest.approx(46 * 20 / 3 - 15, abs=12.0)
    assert app.case.history.undo_sentence == "Put a new scan into the place of the old"


def test_two_scans_opened_one_after_the_other_show_the_newer(
    app: Application,
    settle: Callable[[], None],
    right_foot: TriangleMesh,
    tmp_path: Path,
) -> None:
    turn = rigid(rotation_about(np.array([1.0, 1.0, 0.0]), 70.0), np.array([5.0, 0.0, 300.0]))
    for name, mesh in (("first", right_foot), ("second", right_foot.transformed(turn))):
        write_ply(mesh, tmp_path / f"{name}.ply")
        app.features.case_files.opener.open_path(tmp_path / f"{name}.ply")
    settle()
    dialogs = [dialog for dialog in app.window.findChildren(ImportDialog) if dialog.isVisible()]
    assert [dialog.windowTitle() for dialog in dialogs] == ["Open the scan second.ply"]


def test_a_unit_that_makes_no_foot_is_refused_and_another_one_taken(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(replace(right_foot, vertices=right_foot.vertices / 25.4))
    assert dialog is not None
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    choose_size(dialog.size_fields, "mm")
    settle()
    assert "read in millimetres" in dialog.doubts.text()
    assert not dialog.open_button.isEnabled()
    choose_size(dialog.size_fields, "inch")
    settle()
    assert dialog.sides[Side.LEFT].isChecked()  # what the user has said stays said
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is not None
    length_mm = np.ptp(right_foot.vertices[:, 1])
    assert np.ptp(app.case.foot.mesh.vertices[:, 1]) == pytest.approx(length_mm, rel=0.03)


def test_what_is_no_foot_is_not_opened_at_the_first_press(
    app: Application, open_scan: Open, settle: Callable[[], None]
) -> None:
    angles = np.linspace(0, 2 * np.pi, 60)
    rings = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    tube = np.concatenate([np.column_stack([60 * rings, np.full(60, z)]) for z in (0.0, 250.0)])
    n = np.arange(59)
    triangles = np.concatenate(
        [np.stack([n, n + 1, n + 60], 1), np.stack([n + 1, n + 61, n + 60], 1)]
    )
    dialog = open_scan(TriangleMesh(tube, triangles.astype(np.int32)))
    assert dialog is not None
    if dialog.feet.count():
        QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
        QTest.mouseClick(dialog.open_button, LEFT)
        settle()
    assert dialog.doubts.isVisible()
    assert app.case.foot is None


def test_what_the_dialog_warns_of_is_not_said_again_once_the_scan_is_open(
    app: Application, open_scan: Open, settle: Callable[[], None], far_foot: TriangleMesh
) -> None:
    dialog = open_scan(far_foot)
    assert dialog is not None
    assert "so far from the origin" in dialog.doubts.text()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is not None
    assert app.services.messages.dialogs == []


def test_a_warning_of_a_scan_that_is_opened_without_the_dialog_is_said(
    app: Application, open_scan: Open, far_foot: TriangleMesh
) -> None:
    assert open_scan(far_foot, Side.RIGHT) is None  # type: ignore[call-arg]
    (said,) = app.services.messages.dialogs
    assert "so far from the origin" in said.text()


@pytest.mark.slow
def test_of_both_feet_only_the_one_that_was_asked_for_is_marked(
    app: Application, open_scan: Open, settle: Callable[[], None], box: TriangleMesh
) -> None:
    dialog = open_scan(box, Side.RIGHT)  # type: ignore[call-arg]
    assert dialog is not None
    assert [dialog.is_marked(number) for number in range(2)] == [False, True]
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert [foot.side for foot in app.case.record.feet] == [Side.RIGHT]


@pytest.mark.slow
def test_both_feet_of_a_box_are_opened_at_once_and_of_the_reopened_case_read_as_before(
    app: Application, settle: Callable[[], None], tmp_path: Path, box: TriangleMesh
) -> None:
    def open_file(path: Path) -> ImportDialog | None:
        app.features.case_files.opener.open_path(path)
        settle()
        return asked_scan(app)

    scan, moved, case = tmp_path / "box.ply", tmp_path / "of the record.ply", tmp_path / "a.insole"
    write_ply(box, scan)
    dialog = open_file(scan)
    assert dialog is not None
    assert dialog.feet.count() == 2
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    assert not dialog.open_button.isEnabled()  # both would be of one side
    assert "the other side for one" in dialog.why_not.text()
    for number in range(2):
        dialog.feet.item(number).setCheckState(Qt.CheckState.Unchecked)
    assert not dialog.open_button.isEnabled()
    assert "Mark the feet" in dialog.why_not.text()
    for number in range(2):
        dialog.feet.item(number).setCheckState(Qt.CheckState.Checked)
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    assert not dialog.why_not.isVisible()
    QTest.keyClick(dialog.feet, Qt.Key.Key_Down)
    assert "right foot" in dialog.finding.text()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    before = app.case.record.feet
    assert [foot.side for foot in before] == [Side.LEFT, Side.RIGHT]
    app.features.case_files.saver.save_to(case)
    settle()
    app.features.case_files.opener.new_case()
    scan.rename(moved)
    open_file(case)
    dialog = open_file(moved)
    assert dialog is not None
    assert dialog.size_fields.unit == "mm"  # without saying it again
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    after = app.case.record.feet
    assert app.case.history.undo_sentence == "Reconstruct the foot again"
    assert [foot.source.path for foot in after] == [str(moved.resolve())] * 2
    assert len(before) == len(after) == 2
    for one, again in zip(before, after, strict=True):
        assert (one.side, one.foot.notes) == (again.side, again.foot.notes)
        np.testing.assert_array_equal(one.foot.mesh.vertices, again.foot.mesh.vertices)


def test_heel_toes_and_sole_are_clicked_where_the_pose_is_not_found(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(right_foot)
    assert dialog is not None
    QTest.mouseClick(dialog.clicks, LEFT)
    assert "heel" in dialog.hint.text()
    QTest.mouseClick(dialog.clicks, LEFT)
    assert not dialog.hint.isVisible()
    QTest.mouseClick(dialog.clicks, LEFT)
    scene = dialog.model.scene
    for y_mm in (20.0, 230.0, 120.0):
        assert dialog.hint.isVisible()
        QTest.mouseClick(scene.surface, LEFT, pos=pixel(scene, 0.0, y_mm))
    settle()
    assert not dialog.hint.isVisible()
    assert not dialog.clicks.isChecked()
    QTest.mouseClick(dialog.open_button, LEFT)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.side is Side.RIGHT
    assert app.case.foot.length_mm == pytest.approx(np.ptp(right_foot.vertices[:, 1]), rel=0.02)


@pytest.mark.slow
def test_a_shoe_size_or_two_clicked_points_give_the_scale_of_a_scan_without_unit(
    app: Application, open_scan: Open, settle: Callable[[], None], right_foot: TriangleMesh
) -> None:
    dialog = open_scan(replace(right_foot, vertices=right_foot.vertices * 0.003))
    assert dialog is not None
    assert not dialog.open_button.isEnabled()
    choose_size(dialog.size_fields, "shoe")
    settle()
    assert dialog.open_button.isEnabled()
    told = re.search(r"(\d+) mm long", dialog.finding.text())
    assert told is not None
    assert int(told[1]) == pytest.approx(40 * 20 / 3 - 15, abs=12.0)
    choose_size(dialog.size_fields, "distance")
    settle()
    length_mm = float(np.ptp(right_foot.vertices[:, 1]))
    shown_mm = 250.0  # what it is shown at, so that it can be clicked on
    field = dialog.size_fields.numbers["distance"]
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, f"{(180 - 20) * length_mm / shown_mm:.1f}")
    QTest.keyClick(field, Qt.Key.Key_Tab)
    settle()
    assert "two points" in dialog.hint.text()
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    assert not dialog.open_button.isEnabled()  # at a size that nobody has said
    scene = dialog.model.scene
    for y_mm in (20.0, 180.0):
        QTest.mouseClick(scene.surface, LEFT, pos=pixel(scene, 0.0, y_mm))
    settle()
    assert not dialog.hint.isVisible()
    QTest.mouseClick(dialog.sides[Side.RIGHT], LEFT)
    QTest.mouseClick(dialog.open_button, LEFT)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.length_mm == pytest.approx(length_mm, rel=0.02)


def test_the_unit_is_asked_by_what_each_would_give(
    app: Application, right_foot: TriangleMesh, tmp_path: Path, settle: Callable[[], None]
) -> None:
    path = tmp_path / "small.stl"
    scale = 14.0 / float(np.ptp(right_foot.vertices, axis=0).max())
    write_stl(right_foot.moved(right_foot.vertices * scale), path)
    app.features.case_files.opener.open_path(path, Side.RIGHT)
    settle()
    dialog = asked_scan(app)
    assert dialog is not None
    assert list(dialog.units) == ["cm", "inch"]
    assert "Centimetres: a foot of 140 mm (a child's, EU 2" in dialog.units["cm"].text()
    assert "mm (no foot)" in dialog.units["inch"].text()
    assert "mm" not in dialog.finding.text()
    assert not dialog.open_button.isEnabled()
    QTest.mouseClick(dialog.units["cm"], LEFT)
    settle()
    assert (dialog.units, dialog.size_fields.unit) == ({}, "cm")
    assert "140 mm long" in dialog.finding.text()
    assert "mm long" not in dialog.notes.text()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    settle()
    assert app.case.foot is not None
    assert app.case.foot.length_mm == pytest.approx(140, abs=1)


def test_ways_to_lie_are_told_by_their_lengths_once_the_unit_is_known(
    open_scan: Open, settle: Callable[[], None]
) -> None:
    egg = trimesh.creation.icosphere(3)
    vertices = np.asarray(egg.vertices) * (2.52, 7.0, 1.68)
    dialog = open_scan(TriangleMesh(vertices, np.asarray(egg.faces, np.int32)))
    assert dialog is not None
    QTest.mouseClick(dialog.sides[Side.LEFT], LEFT)
    assert dialog.sides[Side.LEFT].isChecked()
    assert not dialog.candidates.isVisible()
    QTest.mouseClick(dialog.units["cm"], LEFT)
    settle()
    rows = [dialog.candidates.item(number).text() for number in range(dialog.candidates.count())]
    assert dialog.candidates.isVisible()
    assert all("139 mm long" in row for row in rows)
