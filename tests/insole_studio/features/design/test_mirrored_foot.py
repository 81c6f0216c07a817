"""The foot that was not scanned is made by mirroring, and the window says so."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from canned_questions import CannedQuestions
from hands import MANUAL_SIZE
from PySide6.QtWidgets import QLabel, QMenu, QToolButton
from pytestqt.qtbot import QtBot

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Posting
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.app.bootstrap import Application
from insole_studio.app.scripted import wait_for
from insole_studio.features.design.patient.measure_texts import measures_of
from insole_studio.services.questions import SameSide
from insole_studio.widgets.side_switch import SideBadge

SAID = "The right foot was not scanned: foot and insole are mirrored from the left foot."


def badges(app: Application) -> set[str]:
    views = (app.stage.foot, app.stage.insole)
    return {badge.text() for view in views for badge in view.findChildren(SideBadge)}


def test_the_missing_foot_is_offered_as_mirror_image_and_says_so(
    opened: Application, settle: Callable[[], None]
) -> None:
    design = opened.case.record.design
    assert design is not None
    opened.case.apply(design.with_added(Posting(rearfoot_deg=4.0)), "Post")
    before = [measure.values for measure in measures_of(opened.case.record)]
    menus = opened.stage.patient.findChildren(QMenu)
    (entry,) = [a for m in menus for a in m.actions() if a.data() == "mirror_foot"]
    entry.trigger()
    settle()
    assert opened.case.side is Side.RIGHT
    assert [type(c) for c in opened.case.record.design.corrections] == [Posting]
    assert badges(opened) == {"RIGHT · mirrored from left"}
    shown = [label.text() for label in opened.stage.patient.findChildren(QLabel)]
    assert any(SAID in text for text in shown)
    assert [measure.values for measure in measures_of(opened.case.record)] == before
    opened.window.actions_by_key["foot_left"].trigger()
    settle()
    assert badges(opened) == {"LEFT"}
    opened.window.actions_by_key["mirror_foot"].trigger()
    (dialog,) = opened.services.messages.dialogs
    assert "already" in dialog.text()
    dialog.done(0)
    opened.window.actions_by_key["undo"].trigger()
    assert opened.case.record.other is None


def test_the_longest_badge_leaves_the_buttons_of_the_views_their_room(
    app: Application,
    settle: Callable[[], None],
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> None:
    app.window.resize(*MANUAL_SIZE)
    foot = replace(make_foot(Side.RIGHT), mirrored=True, scanned_on="2026-05-04")
    app.case.open_foot(foot, ScanSource("mesh", "/nowhere/right.ply", "1" * 64))
    settle()
    for view in (app.stage.foot, app.stage.insole):
        (badge,) = view.findChildren(SideBadge)
        assert badge.text() == "RIGHT · mirrored from left · scan of 2026-05-04"
        presets = [b for b in view.findChildren(QToolButton) if b.property("preset")]
        assert len(presets) == 4
        qtbot.waitUntil(lambda shown=presets: all(button.isVisible() for button in shown))
        left_px = presets[0].mapTo(view, presets[0].rect().topLeft()).x()
        assert badge.geometry().right() < left_px
        assert badge.height() >= badge.heightForWidth(badge.width())
    app.window.actions_by_key["export"].trigger()
    settle()
    stage = app.features.export.stage
    assert stage is not None
    wait_for(stage.jobs)
    (badge,) = stage.findChildren(SideBadge)
    assert badge.text() == "RIGHT · mirrored from left · scan of 2026-05-04"
    stage.close()


def test_a_scan_of_the_missing_foot_takes_the_place_of_the_mirror_image(
    opened: Application,
    settle: Callable[[], None],
    questions: CannedQuestions,
    make_foot: Callable[[Side], Foot],
) -> None:
    opened.window.actions_by_key["mirror_foot"].trigger()
    settle()
    source = ScanSource("mesh", "/nowhere/right.ply", "1" * 64)
    questions.same_side = SameSide.REPLACE
    scanned = ScannedFoot(make_foot(Side.RIGHT), source)
    opened.features.case_files.opener.take_scan(scanned)
    settle()
    record = opened.case.record
    assert record.side is Side.RIGHT
    assert [(foot.side, foot.foot.mirrored) for foot in record.feet] == [
        (Side.LEFT, False),
        (Side.RIGHT, False),
    ]
    assert badges(opened) == {"RIGHT"}
