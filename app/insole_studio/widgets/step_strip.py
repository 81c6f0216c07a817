"""The workflow from patient to insole, always visible: steps done, current and open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from insole_studio.widgets.elided_label import ElidedLabel


class StepState(StrEnum):
    """The state of a step."""

    DONE = "done"
    CURRENT = "current"
    OPEN = "open"


@dataclass(frozen=True)
class WorkflowStep:
    """One step: its key, its text, and its state."""

    key: str
    text: str
    state: StepState


LEAST_LINE_PX = 6
_MARKS = {StepState.DONE: "●", StepState.CURRENT: "◉", StepState.OPEN: "○"}


class StepStrip(QWidget):
    """A row of clickable steps, with the patient and the side at the right."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons: dict[str, QToolButton] = {}
        self._whose = ElidedLabel("")
        self._steps = QHBoxLayout()
        self._steps.setSpacing(0)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 0, 8, 0)
        row.addLayout(self._steps)
        row.addStretch(1)
        row.addWidget(self._whose)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_steps(self, steps: Sequence[WorkflowStep]) -> None:
        """Show the steps."""
        for step in steps:
            if step.key not in self._buttons:
                self._add(step)
            button = self._buttons[step.key]
            button.setText(f"{_MARKS[step.state]}  {step.text}")
            if button.property("state") != step.state.value:
                button.setProperty("state", step.state.value)
                button.style().polish(button)  # the style sheet depends on the state

    def let_choose(self, keys: Sequence[str] | None, why_not: str) -> None:
        """Let only some steps be chosen, all by default; the others say why not."""
        for key, button in self._buttons.items():
            button.setEnabled(keys is None or key in keys)
            button.setToolTip("" if button.isEnabled() else why_not)

    def show_whose(self, text: str) -> None:
        """Show whose case is open, and which foot."""
        self._whose.setText(text)

    def _add(self, step: WorkflowStep) -> None:
        if self._buttons:
            line = QLabel("───")
            line.setObjectName("quiet")
            line.setMinimumWidth(LEAST_LINE_PX)  # a narrow window keeps the words
            self._steps.addWidget(line)
        button = QToolButton()
        button.setObjectName("step")
        button.setAutoRaise(True)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.setProperty("key", step.key)
        button.clicked.connect(self._choose)
        self._buttons[step.key] = button
        self._steps.addWidget(button)

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("key"))
