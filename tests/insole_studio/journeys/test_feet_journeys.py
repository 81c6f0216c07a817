"""Two feet and several variants, by real mouse and key events in the real window."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from asked_scan import insist_on
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton, QToolButton
from pytestqt.qtbot import QtBot
from round_foot import round_foot

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot import measure_table
from insole_core.foot.foot import Foot
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.resources import resource_path
from insole_core.workflows.open_scan import open_scan
from insole_studio.app.bootstrap import Application
from insole_studio.document.journal import find_recovered
from insole_studio.document.side_by_side import foot_difference, insole_difference
from insole_studio.scene.guide_lines import NameLabel
from insole_studio.services.questions import SameSide
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.elided_label import ElidedLabel

pytestmark = [pytest.mark.slow, pytest.mark.one_window]

LEFT_BUTTON = Qt.MouseButton.LeftButton
Settle = Callable[[], None]
MakeFoot = Callable[[Side], Foot]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def press(app: Application, key: Qt.Key, *modifiers: Qt.KeyboardModifier) -> None:
    held = Qt.KeyboardModifier.NoModifier
    for modifier in modifiers:
        held |= modifier
    QTest.keyClick(app.stage.insole.scene.surface, key, held)


def click_side(app: Application, side: Side) -> None:
    QTest.mouseClick(app.stage.patient.sides.buttons[side], LEFT_BUTTON)


def design(app: Application) -> InsoleDesign:
    found = app.case.record.design
    assert found is not None
    return found


def add_pad(app: Application, x_mm: float = 8.0) -> Pelott:
    pad = Pelott(centre_mm=(x_mm, 150.0), turn_deg=10.0)
    app.case.apply(design(app).with_added(pad), "Place a pelott")
    return pad


def notices(app: Application) -> list[str]:
    return [notice.key for notice in app.services.notices.notices]


def opened_notices(app: Application, key: str) -> list[str]:
    return [notice.text for notice in app.services.notices.notices if notice.key == key]


def take_notice(app: Application) -> None:
    (button,) = [
        b for b in app.stage.notices.findChildren(QPushButton) if b.isVisible() and b.text()
    ]
    QTest.mouseClick(button, LEFT_BUTTON)


@pytest.fixture
def scan(app: Application, make_foot: MakeFoot, tmp_path: Path) -> Callable[[Side], Path]:
    """A mesh file of a foot as simple as a plate."""

    def write(side: Side) -> Path:
        path = tmp_path / f"{side}.ply"
        write_ply(make_foot(side).mesh, path)
        return path

    return write


@pytest.fixture
def two_feet(opened: Application, make_foot: MakeFoot, settle: Settle) -> Application:
    """The application with a left foot, and a right one added and at hand."""
    right = FootRecord.begun(make_foot(Side.RIGHT), ScanSource("mesh", "/nowhere.ply", "0" * 64))
    opened.case.apply(right, "Add the right foot")
    settle()
    return opened


def test_a_second_scan_of_the_other_side_joins_the_case(
    opened: Application, scan: Callable[[Side], Path], settle: Settle
) -> None:
    pad = add_pad(opened)
    opened.services.messages.questions.path = scan(Side.RIGHT)  # type: ignore[attr-defined]
    press(opened, Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier)
    settle()
    insist_on(opened, settle, Side.RIGHT)
    assert [foot.side for foot in opened.case.record.feet] == [Side.LEFT, Side.RIGHT]
    assert opened.case.side is Side.RIGHT
    assert design(opened).corrections == ()
    assert opened.stage.preview.mesh is not None
    press(opened, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert opened.case.side is Side.LEFT
    assert design(opened).corrections == (pad,)


def test_the_sides_are_switched_by_mouse_and_key(two_feet: Application, settle: Settle) -> None:
    right = two_feet.case.foot
    click_side(two_feet, Side.LEFT)
    settle()
    assert two_feet.case.side is Side.LEFT
    assert two_feet.stage.insole.scene.side is Side.LEFT
    press(two_feet, Qt.Key.Key_X)
    assert two_feet.case.foot is right
    press(two_feet, Qt.Key.Key_1, Qt.KeyboardModifier.ControlModifier)
    assert two_feet.case.side is Side.LEFT
    press(two_feet, Qt.Key.Key_2, Qt.KeyboardModifier.ControlModifier)
    assert two_feet.case.side is Side.RIGHT
    assert len(two_feet.case.history) == 1


def test_a_missing_foot_is_offered_by_its_button(opened: Application) -> None:
    button = opened.stage.patient.sides.buttons[Side.RIGHT]
    assert button.text().startswith("+")
    menu = button.menu()
    assert [action.data() for action in menu.actions()] == [
        "open_session",
        "open_archive",
        "capture",
        "mirror_foot",
    ]
    press(opened, Qt.Key.Key_X)
    (dialog,) = opened.services.messages.dialogs
    assert "no right foot yet" in dialog.text()


def test_the_prescription_is_copied_mirrored(two_feet: Application, settle: Settle) -> None:
    click_side(two_feet, Side.LEFT)
    pad = add_pad(two_feet)
    act(two_feet, "add_posting")
    held = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
    press(two_feet, Qt.Key.Key_X, *held)
    settle()
    assert two_feet.case.side is Side.RIGHT
    mirrored, posting = design(two_feet).corrections
    assert isinstance(mirrored, Pelott)
    assert isinstance(posting, Posting)
    assert mirrored.id != pad.id
    assert mirrored.centre_mm == pytest.approx((-8.0, 150.0), abs=0.1)
    assert mirrored.turn_deg == pytest.approx(-10.0)
    press(two_feet, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert two_feet.case.side is Side.RIGHT
    assert design(two_feet).corrections == ()


def test_one_correction_is_copied_mirrored(two_feet: Application) -> None:
    add_pad(two_feet, -5.0)
    act(two_feet, "add_posting")
    two_feet.case.select(design(two_feet).corrections[0].id)
    act(two_feet, "copy_selected_to_other")
    assert two_feet.case.side is Side.LEFT
    (mirrored,) = design(two_feet).corrections
    assert isinstance(mirrored, Pelott)
    assert mirrored.centre_mm == pytest.approx((5.0, 150.0), abs=0.1)
    assert two_feet.case.selection == mirrored.id


@pytest.mark.parametrize("model", ["insole", "foot"])
def test_the_names_of_two_feet_stand_clear_of_the_word_for_the_toes(
    two_feet: Application, model: str, settle: Settle, monkeypatch: pytest.MonkeyPatch
) -> None:
    panel = getattr(two_feet.stage, model)
    names: list[NameLabel] = []
    monkeypatch.setattr(panel, "show_names", names.extend)
    act(two_feet, "beside_foot")
    settle()
    look = panel.scene.look
    places, words = panel.scene.painter._directions
    (toes,) = look.pixels_of(places[words.index("Toes")])
    assert len(names) == 2
    for name in names:
        (middle,) = look.pixels_of(name.place_mm)
        assert toes[1] - middle[1] >= 22, "half of a name and half of a word, px"
        assert middle[1] > 13, "the whole name is in the picture"


def test_no_direction_stands_between_two_variants_of_one_insole(
    opened: Application, settle: Settle
) -> None:
    """Beside the one it would be read as that of the other, on whose other side it is."""
    presenter = opened.stage.insole_presenter
    painter = opened.stage.insole.scene.painter

    def beyond(box: FloatArray) -> bool:
        where = dict(zip(painter._directions[1], painter._directions[0], strict=True))
        (low, *_), (high, *_) = box
        across = sorted((where["Medial"][0], where["Lateral"][0]))
        return bool(across[0] < low and high < across[1])

    act(opened, "variant_duplicate")
    act(opened, "beside_variant")
    settle()
    own, companion = presenter.bounds_mm, presenter.companion
    assert companion is not None
    assert beyond(own)
    assert beyond(companion.bounds_mm)
    act(opened, "beside_nothing")
    settle()
    assert beyond(own)
    assert not beyond(companion.bounds_mm)


def test_undo_goes_across_the_feet(two_feet: Application, settle: Settle) -> None:
    add_pad(two_feet)
    click_side(two_feet, Side.LEFT)
    add_pad(two_feet)
    click_side(two_feet, Side.RIGHT)
    press(two_feet, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    settle()
    assert two_feet.case.side is Side.LEFT
    assert design(two_feet).corrections == ()
    press(two_feet, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert two_feet.case.side is Side.RIGHT
    assert design(two_feet).corrections == ()


def test_both_feet_stay_whole_in_the_picture_through_undo_and_redo(
    two_feet: Application, settle: Settle
) -> None:
    """Whichever of the two is active stays in its place, and the other one comes beside it."""
    act(two_feet, "beside_foot")
    settle()
    add_pad(two_feet)
    click_side(two_feet, Side.LEFT)
    add_pad(two_feet)
    for key in ("undo", "undo", "redo", "redo", "undo"):
        act(two_feet, key)
        settle()
        for model in ("foot", "insole"):
            view = getattr(two_feet.stage, model).scene
            whole = getattr(two_feet.stage, f"{model}_presenter").whole_bounds_mm
            seen = view.look.pixels_of(whole)
            assert (seen >= 0).all(), f"{model} after {key}"
            assert (seen <= view.look.size_px).all(), f"{model} after {key}"


def test_variants_are_made_named_chosen_and_deleted(
    opened: Application, settle: Settle, export: Callable[[Path], Path], tmp_path: Path
) -> None:
    pad = add_pad(opened)
    duplicate = [
        b
        for b in opened.stage.patient.variants.findChildren(QToolButton)
        if b.property("action") == "variant_duplicate"
    ]
    QTest.mouseClick(duplicate[0], LEFT_BUTTON)
    opened.case.apply(design(opened).with_changed(replace(pad, height_mm=8.0)), "Raise")
    opened.services.messages.questions.typed = "higher"  # type: ignore[attr-defined]
    act(opened, "variant_name")
    assert opened.case.record.current is not None
    assert [v.name for v in opened.case.record.current.variants] == ["A", "higher"]
    press(opened, Qt.Key.Key_V)
    settle()
    assert opened.case.record.current.chosen == "A"
    assert design(opened).corrections == (pad,)
    first = export(tmp_path / "a.stl")
    press(opened, Qt.Key.Key_V)
    settle()
    higher = export(tmp_path / "higher.stl")
    assert first.read_bytes() != higher.read_bytes()
    act(opened, "variant_delete")
    assert opened.case.record.current.chosen == "A"
    press(opened, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert opened.case.record.current.chosen == "higher"


def test_the_only_variant_is_not_deleted(opened: Application) -> None:
    act(opened, "variant_delete")
    (dialog,) = opened.services.messages.dialogs
    assert "only variant" in dialog.text()


def test_a_new_scan_of_the_same_foot_repeats_the_last_design_in_one_click(
    opened: Application, scan: Callable[[Side], Path], settle: Settle
) -> None:
    before = add_pad(opened)
    questions = opened.services.messages.questions
    questions.same_side = SameSide.REPLACE  # type: ignore[attr-defined]
    opened.features.case_files.opener.open_path(scan(Side.LEFT), Side.LEFT)
    settle()
    insist_on(opened, settle, Side.LEFT)
    assert design(opened).corrections == ()
    assert "repeat" in notices(opened)
    take_notice(opened)
    (pad,) = design(opened).corrections
    assert isinstance(pad, Pelott)
    assert (pad.height_mm, pad.length_mm) == (before.height_mm, before.length_mm)
    assert pad.id != before.id
    assert "repeat" not in notices(opened)
    assert opened.case.history.undo_sentence == "Repeat the last design"


def test_a_dismissed_offer_stays_away(
    opened: Application, scan: Callable[[Side], Path], settle: Settle
) -> None:
    add_pad(opened)
    questions = opened.services.messages.questions
    questions.same_side = SameSide.REPLACE  # type: ignore[attr-defined]
    opened.features.case_files.opener.open_path(scan(Side.LEFT), Side.LEFT)
    settle()
    insist_on(opened, settle, Side.LEFT)
    *_, dismiss = opened.stage.notices.findChildren(QToolButton)
    QTest.mouseClick(dismiss, LEFT_BUTTON)
    opened.case.apply(replace(design(opened), thickness_mm=4.0), "Thicken")
    assert "repeat" not in notices(opened)
    act(opened, "repeat_last")
    assert len(design(opened).corrections) == 1


def test_a_second_scan_may_begin_a_new_case(
    opened: Application, scan: Callable[[Side], Path], settle: Settle
) -> None:
    add_pad(opened)
    opened.case.apply(Patient(name="Anna"), "Name")
    questions = opened.services.messages.questions
    questions.same_side = SameSide.NEW_CASE  # type: ignore[attr-defined]
    opened.features.case_files.opener.open_path(scan(Side.LEFT), Side.LEFT)
    settle()
    insist_on(opened, settle, Side.LEFT)
    assert opened.case.record.patient == Patient()
    assert len(opened.case.history) == 0


def test_an_earlier_case_of_the_patient_is_found(
    opened: Application, make_foot: MakeFoot, settle: Settle, tmp_path: Path
) -> None:
    path = tmp_path / "last-visit.insole"
    prescribed = InsoleDesign(
        Side.LEFT, (Pelott(centre_mm=(8.0, 150.0), created_at="2026-05-01T08:00:00"),)
    )
    foot = FootRecord.begun(make_foot(Side.LEFT), ScanSource("mesh", "x.ply", "0" * 64), prescribed)
    write_case(CaseRecord.of_foot(foot, Patient("Anna  Berg", "1971-04-02")), path)
    opened.settings.remember(path)
    opened.case.apply(Patient("anna berg", "1971-04-02"), "Name")
    settle()
    (notice,) = opened.services.notices.notices
    assert "2026-05-01" in notice.text
    take_notice(opened)
    (pad,) = design(opened).corrections
    assert isinstance(pad, Pelott)
    assert pad.centre_mm == pytest.approx((8.0, 150.0), abs=0.1)


def test_a_case_of_two_feet_survives_saving_and_opening(
    two_feet: Application, settle: Settle, tmp_path: Path
) -> None:
    add_pad(two_feet)
    act(two_feet, "variant_duplicate")
    two_feet.features.case_files.saver.save_to(tmp_path / "both.insole")
    settle()
    click_side(two_feet, Side.LEFT)
    assert not two_feet.case.has_unsaved_changes
    record = read_case(tmp_path / "both.insole")
    assert record.at_hand is Side.RIGHT
    two_feet.features.case_files.opener.open_path(tmp_path / "both.insole")
    settle()
    assert [foot.side for foot in two_feet.case.record.feet] == [Side.LEFT, Side.RIGHT]
    assert two_feet.case.record.current is not None
    assert two_feet.case.record.current.chosen == "B"


def test_both_feet_stand_side_by_side(two_feet: Application, settle: Settle) -> None:
    press(two_feet, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier)
    settle()
    foot, insole = two_feet.stage.foot_presenter, two_feet.stage.insole_presenter
    for presenter in (foot, insole):
        assert presenter.companion is not None
        assert presenter.mesh is not None
        # The right foot is at hand: the left one stands to its left, and does not touch it.
        assert presenter.companion.bounds_mm[1, 0] < presenter.mesh.bounds_mm[0, 0] - 30
    assert two_feet.window.actions_by_key["beside_foot"].isChecked()
    click_side(two_feet, Side.LEFT)
    settle()
    assert foot.companion is not None
    assert foot.mesh is not None
    assert foot.companion.bounds_mm[0, 0] > foot.mesh.bounds_mm[1, 0] + 30


def test_a_double_click_takes_the_foot_that_stands_beside(
    two_feet: Application, settle: Settle
) -> None:
    act(two_feet, "beside_foot")
    settle()
    companion = two_feet.stage.foot_presenter.companion
    assert companion is not None
    scene = two_feet.stage.foot.scene
    x, y = scene.look.pixels_of(companion.bounds_mm.mean(axis=0))[0]
    QTest.mouseDClick(scene.surface, LEFT_BUTTON, pos=QPoint(round(x), round(y)))
    assert two_feet.case.side is Side.LEFT


def test_the_feet_are_compared_mirrored(two_feet: Application, settle: Settle) -> None:
    """The made-up feet are mirror images: only the pad of the right one differs."""
    pad = Pelott(centre_mm=(-8.0, 150.0), height_mm=6.0)
    two_feet.case.apply(design(two_feet).with_added(pad), "Place")
    press(two_feet, Qt.Key.Key_J)
    settle()
    counterpart = two_feet.features.design.side_by_side.counterpart
    over = insole_difference(two_feet.stage.preview, counterpart)
    assert over is not None
    assert two_feet.stage.preview.mesh is not None
    assert np.nanmax(over) == pytest.approx(6.0, abs=0.05)
    highest = two_feet.stage.preview.mesh.vertices[np.nanargmax(over), :2]
    assert highest == pytest.approx([-8.0, 150.0], abs=1.5)
    assert np.nanquantile(np.abs(over), 0.5) < 0.05
    sole = foot_difference(two_feet.case.record.feet[1].foot, counterpart)
    assert sole is not None
    assert np.nanmax(np.abs(sole)) < 0.3
    assert "RIGHT − LEFT mirrored" in two_feet.stage.insole.numbers.text()
    assert "max 6.0" in two_feet.stage.insole.numbers.text()


def test_two_variants_are_compared(opened: Application, settle: Settle) -> None:
    pad = add_pad(opened)
    act(opened, "variant_duplicate")
    opened.case.apply(design(opened).with_changed(replace(pad, height_mm=9.0)), "Raise")
    press(
        opened,
        Qt.Key.Key_B,
        Qt.KeyboardModifier.ControlModifier,
        Qt.KeyboardModifier.ShiftModifier,
    )
    press(opened, Qt.Key.Key_J)
    settle()
    counterpart = opened.features.design.side_by_side.counterpart
    over = insole_difference(opened.stage.preview, counterpart)
    assert over is not None
    assert np.nanmax(over) == pytest.approx(3.0, abs=0.05)
    assert np.nanmin(over) == pytest.approx(0.0, abs=1e-6)
    assert opened.stage.insole.numbers.text().startswith("B − A")
    assert opened.stage.foot_presenter.companion is None
    press(opened, Qt.Key.Key_V)
    settle()
    over = insole_difference(opened.stage.preview, counterpart)
    assert over is not None
    assert np.nanmin(over) == pytest.approx(-3.0, abs=0.05)
    assert opened.stage.insole.numbers.text().startswith("A − B")
    press(
        opened,
        Qt.Key.Key_0,
        Qt.KeyboardModifier.ControlModifier,
        Qt.KeyboardModifier.ShiftModifier,
    )
    assert opened.stage.insole_presenter.companion is None
    assert opened.window.actions_by_key["map_none"].isChecked()


@pytest.mark.shared
def test_equal_variants_of_a_real_foot_differ_by_nothing_and_two_millimetres_by_two(
    app: Application, settle: Settle, shared_data: Path
) -> None:
    """A milled insole with pelott and posting: real flanks, a rim and a posted surface."""
    foot = open_scan(shared_data / "feet" / "dupontgu" / "right_foot.stl", Side.RIGHT).foot
    eva = read_device(resource_path("devices") / "eva-full-length.json")
    pad = Pelott(centre_mm=(-8.0, 165.0), height_mm=4.0)
    plain = replace(apply_device(eva, InsoleDesign(Side.RIGHT)), grid_mm=2.0)
    posted = plain.with_added(pad).with_added(Posting(rearfoot_deg=4.0))
    app.case.open_foot(foot, ScanSource("mesh", "/nowhere/foot.stl", "0" * 64), posted)
    settle()
    press(app, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    held = (Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier)
    press(app, Qt.Key.Key_B, *held)
    press(app, Qt.Key.Key_J)
    settle()
    shown = app.stage.insole.numbers
    assert shown.text().endswith("mean +0.00   95 % 0.00   max 0.00 mm")
    app.case.apply(design(app).with_changed(replace(pad, height_mm=6.0)), "Raise")
    settle()
    assert shown.text().endswith("max 2.00 mm")
    over = insole_difference(app.stage.preview, app.features.design.side_by_side.counterpart)
    assert over is not None
    assert np.nanmin(over) == pytest.approx(0.0, abs=0.005)


def test_nothing_to_compare_with_is_said(opened: Application) -> None:
    for key in ("beside_foot", "beside_variant", "map_difference"):
        act(opened, key)
    sentences = [dialog.text() for dialog in opened.services.messages.dialogs]
    assert ["one foot only" in s or "one variant only" in s for s in sentences] == [True] * 3
    assert opened.window.actions_by_key["beside_nothing"].isChecked()
    assert opened.window.actions_by_key["map_none"].isChecked()


def test_the_other_foot_is_there_at_once_the_second_time(
    two_feet: Application, settle: Settle
) -> None:
    click_side(two_feet, Side.LEFT)
    settle()
    left = two_feet.stage.preview.mesh
    assert left is not None
    click_side(two_feet, Side.RIGHT)
    assert two_feet.stage.preview.is_current  # without waiting
    assert not two_feet.jobs.is_running("insole")
    click_side(two_feet, Side.LEFT)
    assert two_feet.stage.preview.mesh is not None
    assert two_feet.stage.preview.mesh.vertices == pytest.approx(left.vertices)


def test_a_foot_without_design_is_offered_that_of_the_other(two_feet: Application) -> None:
    click_side(two_feet, Side.LEFT)
    add_pad(two_feet)
    click_side(two_feet, Side.RIGHT)
    assert notices(two_feet) == ["mirror"]
    take_notice(two_feet)
    assert two_feet.case.side is Side.RIGHT
    (pad,) = design(two_feet).corrections
    assert isinstance(pad, Pelott)
    assert pad.centre_mm == pytest.approx((-8.0, 150.0), abs=0.1)
    assert notices(two_feet) == []


def test_feet_of_unlike_sizes_are_noticed(
    opened: Application, make_foot: MakeFoot, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The foot of the tests has no toes, so that its length would be a guess.
    monkeypatch.setattr(measure_table, "is_length_seen", lambda _landmarks: True)
    right = make_foot(Side.RIGHT)
    longer = replace(right, length_mm=right.length_mm + 25)
    foot = FootRecord.begun(longer, ScanSource("mesh", "/nowhere.ply", "0" * 64))
    opened.case.apply(foot, "Add the right foot")
    (notice,) = opened.services.notices.notices
    assert "250 mm long and the right one 275 mm" in notice.text
    opened.case.undo()
    assert notices(opened) == []


def test_a_scan_that_is_gone_is_noticed_when_the_case_is_opened(
    two_feet: Application, settle: Settle, tmp_path: Path
) -> None:
    two_feet.features.case_files.saver.save_to(tmp_path / "both.insole")
    settle()
    two_feet.features.case_files.opener.open_path(tmp_path / "both.insole")
    settle()
    (notice,) = opened_notices(two_feet, "sources")
    assert notice.count("not there any more") == 2
    assert two_feet.stage.preview.mesh is not None
    dismiss = two_feet.stage.notices.findChildren(QToolButton)[-1]
    QTest.mouseClick(dismiss, LEFT_BUTTON)
    assert opened_notices(two_feet, "sources") == []


def test_a_case_of_two_feet_survives_a_crash(two_feet: Application, paths: UserPaths) -> None:
    act(two_feet, "variant_duplicate")
    two_feet.autosave.write_now()
    (copy,) = paths.autosave_folder.glob("*.insole")
    record = read_case(copy)
    assert [foot.side for foot in record.feet] == [Side.LEFT, Side.RIGHT]
    assert record.feet[1].chosen == "B"
    gone = copy.with_stem("of-a-window-that-is-gone")
    gone.write_bytes(copy.read_bytes())
    (crashed,) = find_recovered(paths.autosave_folder)
    two_feet.case.open(CaseRecord(), None)
    two_feet.features.case_files.recovery.offer([crashed])
    assert two_feet.case.record.feet[1].chosen == "B"
    assert two_feet.case.has_unsaved_changes


def test_the_author_is_stamped_and_remembered(opened: Application) -> None:
    opened.services.messages.questions.typed = "Dr Ek"  # type: ignore[attr-defined]
    act(opened, "author")
    act(opened, "add_posting")
    (posting,) = design(opened).corrections
    assert posting.author == "Dr Ek"
    assert opened.settings.author == "Dr Ek"


def test_the_table_shows_both_feet(app: Application) -> None:
    for side in Side:
        source = ScanSource("mesh", "/nowhere.ply", "0" * 64)
        app.case.apply(FootRecord.begun(round_foot(side), source), "Add")
    act(app, "copy_measures")
    head, first, *_ = QApplication.clipboard().text().splitlines()
    assert head.startswith("measure,unit,left,right,difference,percent,positive,left_limits_95,")
    left, right = (float(number) for number in first.split(",")[2:4])
    assert left == pytest.approx(right, abs=0.05)


def test_a_mirrored_prescription_makes_the_mirrored_insole(make_foot: MakeFoot) -> None:
    from insole_core.insole.prescription.template import mirrored

    left = make_foot(Side.LEFT)
    flipped = TriangleMesh(left.mesh.vertices * [-1, 1, 1], left.mesh.triangles[:, ::-1].copy())
    right = Foot(Side.RIGHT, flipped, np.eye(4), left.length_mm)
    prescribed = InsoleDesign(Side.LEFT, (Pelott(centre_mm=(8.0, 150.0)), Posting(rearfoot_deg=4)))
    a = build_insole(left, prescribed).contact
    b = build_insole(right, mirrored(prescribed)).contact
    nodes = a.nodes
    assert b.height_at(nodes[:, :2] * [-1, 1]) == pytest.approx(nodes[:, 2], abs=1e-3)


def test_the_foot_stays_in_sight_beside_two_variants(
    opened: Application, settle: Callable[[], None]
) -> None:
    opened.window.resize(1366, 728)
    opened.services.messages.questions.typed = "B"  # type: ignore[attr-defined]
    opened.window.actions_by_key["variant_duplicate"].trigger()
    opened.window.actions_by_key["beside_variant"].trigger()
    settle()
    view = opened.stage.foot.scene
    assert opened.case.foot is not None
    middle = opened.case.foot.mesh.bounds_mm.mean(axis=0)
    assert abs(view.camera.focal_mm[0] - middle[0]) < 5.0
    insole = opened.stage.insole.scene
    lead_from = insole.camera
    insole.set_camera(lead_from.centred(np.array(lead_from.focal_mm) + np.array([10.0, 0, 0])))
    insole.camera_changed.emit(insole.camera)
    assert view.camera.focal_mm[0] - middle[0] == pytest.approx(10.0, abs=5.0)


def test_a_wider_window_widens_both_views(
    opened: Application, settle: Callable[[], None], qtbot: QtBot
) -> None:
    window = opened.window
    window.resize(1366, 728)
    settle()
    window.arrange()
    settle()
    foot, insole = opened.stage.foot.width(), opened.stage.insole.width()
    window.resize(1900, 728)

    def is_shared() -> bool:
        gained = opened.stage.foot.width() - foot, opened.stage.insole.width() - insole
        return sum(gained) > 400 and min(gained) > 0.3 * sum(gained)

    qtbot.waitUntil(is_shared)


@pytest.mark.parametrize("page", ["patients", "orders"])
def test_what_is_said_of_the_open_case_waits_while_a_page_of_the_record_is_shown(
    app: Application,
    scan: Callable[[Side], Path],
    settle: Settle,
    qtbot: QtBot,
    page: str,
) -> None:
    def said() -> list[bool]:
        """Return whether the sentence on the scan and the one on the program are shown."""
        labels = app.stage.notices.findChildren(ElidedLabel)
        shown = [label.text() for label in labels if label.isVisible()]
        return [any(text in s for s in shown) for text in ("The heel is missing", "New here?")]

    app.main.help.offer_tour()
    app.features.case_files.opener.open_path(scan(Side.LEFT), Side.LEFT)
    settle()
    insist_on(app, settle, Side.LEFT)
    qtbot.waitUntil(lambda: said() == [True, True])
    app.window.actions_by_key[page].trigger()
    qtbot.waitUntil(lambda: app.window.page is not None)
    qtbot.waitUntil(lambda: said() == [False, True])
    step = next(b for b in app.stage.steps.findChildren(QToolButton) if "Design" in b.text())
    QTest.mouseClick(step, LEFT_BUTTON)
    qtbot.waitUntil(lambda: app.window.page is None)
    qtbot.waitUntil(lambda: said() == [True, True])
