"""Every field of Design, Foot and Check & export says in a sentence what it does."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QCheckBox,
    QComboBox,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QSlider,
    QWidget,
)

from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.resources import resource_path
from insole_studio.app.actions import ACTIONS
from insole_studio.app.bootstrap import Application
from insole_studio.features.export.order_form import OrderForm
from insole_studio.features.foot.view import FootStageView
from insole_studio.widgets.form_parts import Fold
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

FIELDS = (QAbstractSpinBox, QComboBox, QCheckBox, QLineEdit, QPlainTextEdit, QSlider)
PLAIN = {"Name", "Born", "Visit", "Notes", "Patient", "Body weight"}
"""Labels that say all there is to say."""
FOREIGN = ("flank", "median", "grid", "deviation", "margin", "reproj", "sigma", "residual")
"""Words that only a manual explains."""
CORRECTIONS = (
    Pelott(centre_mm=(0.0, 150.0)), Posting(rearfoot_deg=4.0), ForefootTwist(angle_deg=2.0),
    HeelSkive(), HeelLift(), ArchRaise(apex_mm=(20.0, 110.0)), HeelCup(), Rocker(),
    BrushStroke(points_mm=((0.0, 50.0),)),
)  # fmt: skip


def fields(within: QWidget) -> Iterator[QWidget]:
    """Give the fields of a panel; not the parts that a field consists of."""
    for kind in FIELDS:
        for field in within.findChildren(kind):
            if not isinstance(field.parentWidget(), FIELDS):
                yield field


def label_of(field: QWidget) -> str:
    window = field.window()
    labels = [label for label in window.findChildren(QLabel) if label.buddy() is field]
    return labels[0].text().replace("&", "") if labels else field.accessibleName()


def unexplained(within: QWidget) -> set[str]:
    """Return the labels of fields without a sentence; their type where they have no label."""
    return {
        label_of(field) or type(field).__name__
        for field in fields(within)
        if len(field.toolTip()) < 10 and label_of(field) not in PLAIN
    }


def foreign(within: QWidget) -> set[str]:
    names = [label for label in within.findChildren(QLabel) if label.buddy() is not None]
    texts = [label.text() for label in names] + [field.accessibleName() for field in fields(within)]
    texts += [box.text() for box in within.findChildren(QCheckBox)]
    return {text for text in texts if any(word in text.lower() for word in FOREIGN)}


@pytest.fixture
def designed(opened: Application, settle: Callable[[], None]) -> Application:
    """A shell with every kind of correction."""
    device = read_device(resource_path("devices/functional-three-quarter.json"))
    design = opened.case.record.design
    assert design is not None
    for correction in CORRECTIONS:
        design = design.with_added(correction)
    opened.case.apply(apply_device(device, design), "All")
    settle()
    return opened


def test_design_has_no_field_without_a_sentence(
    designed: Application, settle: Callable[[], None]
) -> None:
    panels = designed.stage.parameters, designed.stage.patient
    found: set[str] = set()
    for record in ACTIONS:
        if record.group == "tools":
            designed.window.actions_by_key[record.key].trigger()
            settle()
            found |= {text for panel in panels for text in unexplained(panel) | foreign(panel)}
    designed.window.actions_by_key["tool_orbit"].trigger()
    for correction in CORRECTIONS:
        designed.case.select(correction.id)
        found |= unexplained(designed.stage.parameters) | foreign(designed.stage.parameters)
    assert found == set()


def test_check_and_export_has_no_field_without_a_sentence(
    designed: Application, settle: Callable[[], None]
) -> None:
    designed.window.actions_by_key["export"].trigger()
    settle()
    stage = designed.features.export.stage
    assert stage is not None
    assert isinstance(stage.findChild(OrderForm), OrderForm)
    assert len(stage.findChildren(NumberField)) > 10
    assert unexplained(stage) | foreign(stage) == set()


def test_the_foot_stage_has_no_field_without_a_sentence(qapp) -> None:
    view = FootStageView(dark=False)
    assert unexplained(view) | foreign(view) == set()
    view.close_scene()
    view.deleteLater()


def test_values_for_experts_are_folded_away_and_stay_open_once_opened(
    opened: Application, settle: Callable[[], None]
) -> None:
    panel = opened.stage.parameters

    def is_shown() -> bool:
        return any(
            field.property("key") == "insole.grid_mm" and field.isVisibleTo(panel)
            for field in panel.findChildren(NumberField)
        )

    assert not is_shown()
    (fold,) = (f for f in panel.findChildren(Fold) if f.text() == "Expert" and f.isVisibleTo(panel))
    QTest.mouseClick(fold, Qt.MouseButton.LeftButton)
    assert is_shown()
    opened.window.actions_by_key["tool_posting"].trigger()
    settle()
    assert is_shown()
