"""The foot that was not scanned is made by mirroring, and the window says so."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QLabel, QMenu

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import Posting
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.patient.measure_texts import measures_of
from insole_studio.widgets.side_badge import SideBadge

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
