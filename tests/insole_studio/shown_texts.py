"""All that the windows show, line by line, to compare one state of them with another."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDockWidget,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QProgressBar,
    QWidget,
)

from insole_studio.app.bootstrap import Application
from insole_studio.widgets.section_chart import SectionChart

SHARED = ("_section", "_rim", "_view", "ask_text")
"""What tools hold that other panels hold as well, or that asks."""


def shown(app: Application) -> list[str]:
    """All that the windows show, line by line, in the order of their widgets."""
    lines = [f"status {app.window.statusBar().currentMessage()}"]
    for window in sorted(QApplication.topLevelWidgets(), key=lambda w: w.windowTitle()):
        if window.isVisible() and window.windowTitle():
            lines.append(f"window {window.windowTitle()} {window.isWindowModified()}")
            lines += _widgets_of(window)
    for key, action in app.window.actions_by_key.items():
        lines.append(f"action {key} {action.text()} {action.isEnabled()} {action.isChecked()}")
    for subject, view in (("foot", app.stage.foot), ("insole", app.stage.insole)):
        camera = view.scene.camera
        focal = [round(x, 2) for x in camera.focal_mm]
        lines.append(f"{subject} camera {camera.preset} {focal} {camera.height_mm:.2f}")
        lines.append(f"{subject} turned {camera.azimuth_deg} {camera.elevation_deg}")
        lines.append(f"{subject} handles {[handle.name for handle in view.scene.handles]}")
        if app.case.foot is not None:
            lines.append(f"{subject} drawn {sorted(view.scene.painter.shown)}")
    tools = app.stage.tool_controller
    for key, tool in tools.tools.items():
        own = {name: value for name, value in vars(tool).items() if name not in SHARED}
        if "template" in own:
            own["template"] = replace(own["template"], id="")
        lines.append(f"tool {key} {own}")
    lines.append(f"tool {tools.tool.key} beside {app.stage.counterpart.kind}")
    lines.append(f"section {app.stage.cut.plane} selection {app.case.selection}")
    lines.append(f"station {app.stage.rim_model.selected}")
    lines.append(f"notices {[notice.text for notice in app.services.notices.notices]}")
    return lines


def _widgets_of(window: QWidget) -> Iterator[str]:
    for widget in window.findChildren(QWidget):
        if widget.isVisible() and not widget.objectName().startswith("qt_"):
            name, tip = type(widget).__name__, widget.toolTip()
            yield f"{name} {widget.objectName()} {_text_of(widget)!r} {tip!r} {widget.isEnabled()}"


def _text_of(widget: QWidget) -> str:
    text = ""
    match widget:
        case QLabel() | QLineEdit() | QAbstractSpinBox() | QProgressBar():
            text = widget.text()
        case QPlainTextEdit():
            text = widget.toPlainText()
        case QAbstractButton():
            text = f"{widget.text()} {widget.isChecked()}"
        case QComboBox():
            text = f"{widget.currentText()} {[widget.itemText(i) for i in range(widget.count())]}"
        case QDockWidget():
            text = widget.windowTitle()
        case SectionChart():
            text = f"{widget._sentence} {widget._top is None}"
    return text


def differences(one: list[str], other: list[str]) -> tuple[list[str], list[str]]:
    """What only the one shows, and what only the other shows."""
    a, b = Counter(one), Counter(other)
    return sorted((a - b).elements()), sorted((b - a).elements())
